//! Files of heights: what they become, and what is said of broken ones.

use fastrand::Rng;
use std::fs;
use std::path::Path;
use wheatstone_golden::scene::height_field::{load, HeightGrid, GRID_LIMIT};
use wheatstone_golden::scene::{open, Scene};
use wheatstone_tests::folder;

fn opened(file: &Path) -> Result<Scene, String> {
    open(&file.display().to_string(), None, None).map_err(|e| e.to_string())
}

fn write_grey(file: &Path, columns: u32, depth: png::BitDepth, kind: png::ColorType, data: &[u8]) {
    let samples = match kind {
        png::ColorType::Grayscale => 1,
        png::ColorType::GrayscaleAlpha => 2,
        _ => 3,
    };
    let bits = columns * samples * depth as u32;
    let rows = data.len() as u32 / bits.div_ceil(8);
    let mut encoder = png::Encoder::new(fs::File::create(file).unwrap(), columns, rows);
    encoder.set_color(kind);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(data).unwrap();
}

#[test]
fn pictures_and_text_hold_the_same_grid() {
    use png::{BitDepth, ColorType};
    let folder = folder();
    let [text, narrow, wide] = ["a.txt", "b.png", "C.PNG"].map(|name| folder.path().join(name));
    fs::write(&text, "# a comment\n\n0 1\t255 # another\n 3,  4.0, 5e0\r\n").unwrap();
    write_grey(&narrow, 3, BitDepth::Eight, ColorType::Grayscale, &[0, 1, 255, 3, 4, 5]);
    let words = [0u16, 1, 255, 3, 4, 5].map(u16::to_be_bytes).concat();
    write_grey(&wide, 3, BitDepth::Sixteen, ColorType::Grayscale, &words);
    let expected = HeightGrid::new(3, vec![0.0, 1.0, 255.0, 3.0, 4.0, 5.0]).expect("a legal grid");
    for file in [&text, &narrow, &wide] {
        assert_eq!(load(file).unwrap(), expected);
        assert_eq!(opened(file).unwrap().meshes[0].triangles.len(), 4);
    }
    write_grey(&wide, 2, BitDepth::Sixteen, ColorType::Grayscale, &[0, 0, 0xff, 0xff, 1, 0, 0, 1]);
    assert_eq!(load(&wide).unwrap().heights(), [0.0, 65_535.0, 256.0, 1.0]);
}

#[test]
fn heights_that_are_very_close_are_stretched_like_others() {
    let folder = folder();
    let [close, plain] = ["close.txt", "plain.txt"].map(|name| folder.path().join(name));
    fs::write(&close, "0 1e-320\n1e-320 0\n").unwrap();
    fs::write(&plain, "0 1\n1 0\n").unwrap();
    let [close, plain] = [close, plain].map(|file| opened(&file).unwrap().meshes);
    assert_eq!(close[0].positions, plain[0].positions);
}

#[test]
fn broken_grids_are_refused_by_line_and_column() {
    let wide = format!("{}\n", "1 ".repeat(GRID_LIMIT + 1)).repeat(2);
    let tall = "1 2\n".repeat(GRID_LIMIT + 1);
    let size = "grid: expected 2 to 1024 columns and rows, found";
    let cases: &[(&str, &str)] = &[
        ("1 2\n3 x\n", ":2: column 2: expected a height, a finite number of at most 1e9, found x"),
        ("1 2\n\n# c\nNaN 4\n", ":4: column 1: expected a height, a finite number"),
        ("1 inf\n3 4\n", ":1: column 2: expected a height, a finite number"),
        ("1 2\n3 1e999\n", ":2: column 2: expected a height, a finite number"),
        ("1 2\n3 -2e9\n", "found -2e9"),
        (
            "1,2\n3,\n",
            ":2: column 2: expected a height, a finite number of at most 1e9, found nothing",
        ),
        ("1 2 3\n\n4 5\n", ":3: row 2: expected 3 heights, as in line 1, found 2"),
        ("\n1 2\n3 4\n5 6 7", ":4: row 3: expected 2 heights, as in line 2, found 3"),
        ("", &format!(": {size} 0 x 0")),
        ("# nothing\n", &format!(": {size} 0 x 0")),
        ("1\n2\n3\n", &format!(": {size} 1 x 3")),
        ("1 2 3\n", &format!(": {size} 3 x 1")),
        (&wide, &format!("{size} 1025 x 2")),
        (&tall, &format!("{size} 2 x 1025")),
    ];
    let folder = folder();
    for name in ["grid.txt", "grid.grid"] {
        let file = folder.path().join(name);
        for (text, message) in cases {
            fs::write(&file, text).unwrap();
            let error = opened(&file).expect_err(text);
            let shown = text.chars().take(40).collect::<String>();
            assert!(error.contains(message), "{shown:?}: {error}");
            assert!(
                error.starts_with(&*file.to_string_lossy()) && !error.contains('\n'),
                "{error}"
            );
        }
        fs::write(&file, b"1 2\n3 \xff\n").unwrap();
        assert!(opened(&file).unwrap_err().contains(":2: file: expected UTF-8 text"));
    }
    let missing = opened(Path::new("/none/grid.txt")).unwrap_err();
    assert!(missing.starts_with("/none/grid.txt: cannot be read: "), "{missing}");
}

#[test]
fn broken_pictures_are_refused() {
    use png::{BitDepth, ColorType};
    let folder = folder();
    let file = folder.path().join("grid.png");
    let refused = |message: &str| {
        let error = opened(&file).expect_err(message);
        let expected = format!("{}: {message}", file.display());
        assert!(error.starts_with(&expected) && !error.contains('\n'), "{error}: {message}");
    };
    let kind = "colour type: expected grey, of 8 or 16 bits, found";
    write_grey(&file, 2, BitDepth::Eight, ColorType::Rgb, &[0; 12]);
    refused(&format!("{kind} red, green and blue of 8 bits"));
    write_grey(&file, 2, BitDepth::Sixteen, ColorType::GrayscaleAlpha, &[0; 16]);
    refused(&format!("{kind} grey with transparency of 16 bits"));
    write_palette(&file, BitDepth::Eight);
    refused(&format!("{kind} a palette of 8 bits"));
    write_palette(&file, BitDepth::Four);
    refused(&format!("{kind} a palette of 4 bits"));
    write_grey(&file, 8, BitDepth::One, ColorType::Grayscale, &[0; 8]);
    refused("bit depth: expected 8 or 16 bits, found 1");
    write_grey(&file, 1, BitDepth::Eight, ColorType::Grayscale, &[0; 8]);
    refused("grid: expected 2 to 1024 columns and rows, found 1 x 8");
    write_grey(&file, 2, BitDepth::Eight, ColorType::Grayscale, &[0; 2050]);
    refused("grid: expected 2 to 1024 columns and rows, found 2 x 1025");
    for other in ["1 2\n3 4\n", "\u{89}", "P"] {
        fs::write(&file, other).unwrap();
        refused("file: expected a PNG picture, found something else");
    }
    fs::write(&file, "").unwrap();
    refused("file: expected a PNG picture, found nothing");
}

fn write_palette(file: &Path, depth: png::BitDepth) {
    let mut encoder = png::Encoder::new(fs::File::create(file).unwrap(), 2, 2);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(depth);
    encoder.set_palette(vec![0, 0, 0, 255, 255, 255]);
    let data: &[u8] = if depth == png::BitDepth::Eight { &[0, 1, 1, 0] } else { &[0x01, 0x10] };
    encoder.write_header().unwrap().write_image_data(data).unwrap();
}

/// Begin and length of the content of each chunk of a PNG picture, with its name.
fn chunks(picture: &[u8]) -> Vec<(usize, usize, String)> {
    let mut found = Vec::new();
    let mut at = 8;
    while at < picture.len() {
        let length = u32::from_be_bytes(picture[at..at + 4].try_into().unwrap()) as usize;
        let name = String::from_utf8(picture[at + 4..at + 8].to_vec()).unwrap();
        found.push((at + 8, length, name));
        at += length + 12;
    }
    found
}

/// The checksum of PNG: CRC-32 of a chunk's name and content.
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

#[test]
fn damaged_pictures_are_refused() {
    use png::{BitDepth, ColorType};
    let folder = folder();
    let file = folder.path().join("grid.png");
    let mut random = Rng::with_seed(3);
    let data: Vec<u8> = (0..1600).map(|_| random.u8(..)).collect();
    write_grey(&file, 40, BitDepth::Eight, ColorType::Grayscale, &data);
    let whole = fs::read(&file).unwrap();
    let refused = |bytes: &[u8], message: &str| {
        fs::write(&file, bytes).unwrap();
        let error = opened(&file).expect_err(message);
        let expected = format!("{}: {message}", file.display());
        assert!(error.starts_with(&expected) && !error.contains('\n'), "{error}: {message}");
    };
    // Cut off anywhere, down to the last byte.
    for length in (1..200).chain((200..whole.len()).step_by(37)).chain([whole.len() - 1]) {
        let message = format!("file: expected a whole PNG picture, found the first {length} bytes");
        refused(&whole[..length], &message);
    }
    // A wrong checksum, and a wrong byte with the old one.
    let damaged = "file: expected an undamaged PNG picture, found CRC error";
    for (at, length, name) in chunks(&whole) {
        let sum = u32::from_be_bytes(whole[at + length..at + length + 4].try_into().unwrap());
        assert_eq!(checksum(&whole[at - 4..at + length]), sum, "{name}");
        for place in [at + length, at + length + 3].into_iter().chain((at..at + length).step_by(3))
        {
            let mut broken = whole.clone();
            broken[place] ^= 0x10;
            fs::write(&file, &broken).unwrap();
            let error = opened(&file).expect_err(&name);
            // A header may also say what is none, and a stream break before its end.
            let sound = error.contains("expected an undamaged PNG picture, found ")
                || (name == "IHDR" && error.contains(": expected "));
            assert!(sound && !error.contains('\n'), "{name} {place}: {error}");
        }
        let mut broken = whole.clone();
        broken[at + length] ^= 1;
        refused(&broken, damaged);
        fs::write(&file, &broken).unwrap();
        let error = opened(&file).expect_err(&name);
        assert!(error.ends_with(&format!("while decoding {name} chunk")), "{error}");
    }
    // A header with a sound checksum that says what is none.
    let with_header = |place: usize, bytes: &[u8]| {
        let mut broken = whole.clone();
        broken[16 + place..16 + place + bytes.len()].copy_from_slice(bytes);
        let sum = checksum(&broken[12..29]);
        broken[29..33].copy_from_slice(&sum.to_be_bytes());
        broken
    };
    let size = "grid: expected 2 to 1024 columns and rows, found";
    refused(&with_header(0, &[0; 4]), &format!("{size} 0 x 40"));
    refused(&with_header(4, &[0; 4]), &format!("{size} 40 x 0"));
    refused(&with_header(0, &[0x7f, 255, 255, 255]), &format!("{size} 2147483647 x 40"));
    // A palette of 16 bits does not exist.
    let none = "file: expected an undamaged PNG picture, found";
    refused(&with_header(8, &[16, 3]), &format!("{none} Invalid color/depth combination"));
    refused(&with_header(8, &[7, 0]), &format!("{none} Invalid bit depth 7"));
    refused(&with_header(8, &[8, 5]), &format!("{none} Invalid color type 5"));
    let mut headless = whole.clone();
    headless[12..16].copy_from_slice(b"IDAT");
    refused(&headless, &format!("{none} IDAT chunk appeared before IHDR chunk"));
    // More rows than there are data.
    refused(
        &with_header(4, &[0, 0, 0, 80]),
        &format!("{none} IDAT or fDAT chunk does not have enough"),
    );
}
