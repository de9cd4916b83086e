//! Input that is damaged: files of every kind that the program reads, each with the command that reads it.

use crate::program::run;
use std::fs;
use std::io::{self, Cursor};
use std::path::Path;
use std::process::Command;

/// A kind of input.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// The files of a run. Those that end in what [`Kind::damaged`] says are damaged, one at a time.
    pub files: Vec<(String, Vec<u8>)>,
    /// The end of the names of what is damaged; none where the command line is.
    pub damaged: Option<&'static str>,
    /// The command line.
    pub line: &'static str,
}

const OBJ: &str = "# A square and a triangle\nmtllib m.mtl\no first\nv -1 -1 0 1 0 0\nv 1 -1 0\nv 1 1 0\nv -1 1 -0.5\n\
vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl red\ng a b\ns 1\nf 1/1/1 2/2/1 3/3/1 4\nusemtl picture\nf -4//1 -3//1 -2//1\n\
l 1 3\np 1\n";
const MESH: &str = "v -1 -1 0\nv 1 -1 0\nv 0 1 -1\nf 1 2 3\n";
const MTL: &str =
    "newmtl red\nKd 1 0.2 0.1\nKa 0 0 0\nNs 10\nd 0.5\nillum 2\nnewmtl picture\nTr 0\n\
map_Kd -s 2 2 1 -o 0.5 0 0 t.png\nmap_d -mm 0 1 t.png\n";
const SCENE: &str = r#"{"format": "stereo-scene/1", "width": 24, "height": 16, "pixels_per_unit": 5,
"eye_separation": 0.6, "viewing_distance": 5, "background": [0, 0, 10],
"vertices": [[-1, -1, 0], [1, -1, 0], [0, 1, 1]],
"colors": [[255, 0, 0], [0, 255, 0], [0, 0, 255]], "triangles": [[0, 1, 2]]}"#;
const RIG: &str = r#"{"eye_separation": 0.6, "viewing_distance": 5, "projection": "shear",
"placement": {"rotation": [0, 30, 5], "offset": [0, 0, -0.5], "fit": 2, "relief": null},
"light": {"direction": [0, 1, 2], "colour": [1, 1, 1], "ambient": [0.2, 0.2, 0.2]}}"#;
const GRID: &str = "# Heights\n1 2 3 4\n2 3.5 4e0 5\n3 4 -9 6\n";
/// One pixel, blue, green, red, 24 bits.
const BMP: &[u8] = b"BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x18\0\0\0\0\0\x04\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10\x20\x30\0";
/// One pixel of true colour.
const TGA: &[u8] = b"\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x18\0\x10\x20\x30";
/// One pixel without loss.
const WEBP: &[u8] =
    b"RIFF\x1a\0\0\0WEBPVP8L\x0d\0\0\0\x2f\0\0\0\x10\x07\x10\x11\x11\x88\x88\xfe\x07\0";

/// Every kind; `program` writes the packs that are damaged, in `folder`; `workspace` has the Verilog.
pub fn all(program: &Path, workspace: &Path, folder: &Path) -> io::Result<Vec<Kind>> {
    let mut kinds = vec![
        scene("obj", &[("s.obj", OBJ), ("m.mtl", MTL)], ".obj", Some(("t.png", png()?))),
        scene("mtl", &[("s.obj", OBJ), ("m.mtl", MTL)], ".mtl", Some(("t.png", png()?))),
        scene("json", &[("s.json", SCENE)], ".json", None),
        scene("grid", &[("s.txt", GRID)], ".txt", None),
        scene("png grid", &[], ".png", Some(("s.png", heights()?))),
        Kind {
            line: "rig --scene s.obj --rig r.json --at 1,2 --out out",
            ..scene("rig", &[("r.json", RIG), ("s.obj", MESH)], "r.json", None)
        },
    ];
    let pictures = [
        ("png", png()?),
        ("png", png_with_palette()?),
        ("jpg", jpeg()?),
        ("bmp", BMP.into()),
        ("bmp", bmp_with_palette(1, 0, &[0x40, 0, 0, 0, 0x80, 0, 0, 0])),
        ("bmp", bmp_with_palette(4, 0, &[0x10, 0, 0, 0, 0x01, 0, 0, 0])),
        ("bmp", bmp_with_palette(8, 0, &[1, 0, 0, 0, 0, 1, 0, 0])),
        // A run and, of at least three, single pixels; ends of lines and of the picture.
        ("bmp", bmp_with_palette(8, 1, &[2, 1, 0, 0, 0, 3, 1, 0, 1, 0, 0, 1])),
        ("bmp", bmp_with_palette(4, 2, &[2, 0x11, 0, 0, 0, 3, 0x10, 0x10, 0, 1])),
        ("tga", TGA.into()),
        ("webp", WEBP.into()),
    ];
    for (end, bytes) in pictures {
        let (name, file) = match end {
            "png" => ("png picture", "t.png"),
            "jpg" => ("jpeg picture", "t.jpg"),
            "bmp" => ("bmp picture", "t.bmp"),
            "tga" => ("tga picture", "t.tga"),
            _ => ("webp picture", "t.webp"),
        };
        let library = MTL.replace("t.png", file);
        kinds.push(scene(name, &[("s.obj", OBJ), ("m.mtl", &library)], file, Some((file, bytes))));
    }
    kinds.extend(packs(program, folder)?);
    kinds.extend(OPTIONS.iter().map(|line| Kind {
        name: "options",
        files: vec![("s.obj".into(), MESH.into()), ("r.json".into(), RIG.into())],
        damaged: None,
        line,
    }));
    kinds.push(verilog(workspace)?);
    Ok(kinds)
}

/// Command lines that are damaged.
const OPTIONS: [&str; 6] = [
    "render --scene s.obj --rig r.json --size 24x16 --method direct --stereo anaglyph,wiggle --dpi 100 --out out",
    "render --scene s.obj --config paper --param filter=2 --cull back --wire --projection shear --out out",
    "rig --scene s.obj --rig r.json --at 1,2.5 --projection piecewise --json out.json",
    "vectors filter --seed 3 --beats 5 --config paper --param filter=3 --out out",
    "compare --scene s.obj --size 24x16 --wire --param sampling=average --out out --json out.json",
    "list --json",
];

/// A scene that is drawn.
fn scene(
    name: &'static str,
    files: &[(&str, &str)],
    damaged: &'static str,
    picture: Option<(&str, Vec<u8>)>,
) -> Kind {
    let mut all: Vec<(String, Vec<u8>)> =
        files.iter().map(|(name, text)| ((*name).into(), text.as_bytes().to_vec())).collect();
    all.extend(picture.map(|(name, bytes)| (name.to_owned(), bytes)));
    let line = match all[0].0.as_str() {
        "s.obj" => "render --scene s.obj --size 24x16 --method direct --out out",
        "s.json" => "render --scene s.json --size 24x16 --method direct --out out",
        "s.txt" => "render --scene s.txt --size 24x16 --method direct --out out",
        _ => "render --scene s.png --size 24x16 --method direct --out out",
    };
    Kind { name, files: all, damaged: Some(damaged), line }
}

fn png() -> io::Result<Vec<u8>> {
    encoded(image::ImageFormat::Png)
}

/// A picture of two colours.
fn png_with_palette() -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Four);
    encoder.set_palette(vec![255, 0, 0, 0, 255, 0]);
    let mut writer = encoder.write_header().map_err(io::Error::other)?;
    writer.write_image_data(&[0x10, 0x01]).map_err(io::Error::other)?;
    writer.finish().map_err(io::Error::other)?;
    Ok(bytes)
}

/// A picture of two colours, of 2 x 2 pixels.
fn bmp_with_palette(bits: u8, compression: u8, data: &[u8]) -> Vec<u8> {
    let mut bytes = b"BM\0\0\0\0\0\0\0\0\x3e\0\0\0\x28\0\0\0".to_vec();
    bytes.extend([2, 0, 0, 0, 2, 0, 0, 0, 1, 0, bits, 0, compression, 0, 0, 0]);
    bytes.extend([data.len() as u8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0]);
    bytes.extend([0, 0, 255, 0, 0, 255, 0, 0]);
    [&bytes, data].concat()
}

fn jpeg() -> io::Result<Vec<u8>> {
    encoded(image::ImageFormat::Jpeg)
}

/// A small picture of heights.
fn heights() -> io::Result<Vec<u8>> {
    let picture = image::GrayImage::from_fn(6, 4, |x, y| image::Luma([(x * 30 + y) as u8]));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).map_err(io::Error::other)?;
    Ok(bytes.into_inner())
}

/// A small picture.
fn encoded(format: image::ImageFormat) -> io::Result<Vec<u8>> {
    let picture =
        image::RgbImage::from_fn(8, 6, |x, y| image::Rgb([x as u8 * 30, y as u8 * 40, 99]));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).map_err(io::Error::other)?;
    Ok(bytes.into_inner())
}

/// Packs that are damaged: of random beats, and of a scene, whose manifest has every field.
const PACKS: [&str; 2] =
    ["vectors sampler --beats 8 --out", "vectors hybrid --scene ramp --beats 8 --out"];

/// Packs as the program writes them: their manifests, and their other files.
fn packs(program: &Path, folder: &Path) -> io::Result<Vec<Kind>> {
    let mut all = Vec::new();
    for (n, line) in PACKS.into_iter().enumerate() {
        let out = folder.join(n.to_string());
        let output = run("wheatstone", Command::new(program).args(line.split(' ')).arg(&out))?;
        if !output.succeeded() {
            return Err(io::Error::other(output.said()));
        }
        let mut files = Vec::new();
        for pack in fs::read_dir(&out)? {
            for entry in fs::read_dir(pack?.path())? {
                let path = entry?.path();
                let name = path.strip_prefix(&out).unwrap_or(&path).to_string_lossy();
                files.push((format!("packs/{name}"), fs::read(&path)?));
            }
        }
        files.sort();
        all.push(files);
    }
    let kinds = [("manifest", "manifest.json"), ("pack", "")].into_iter();
    let of = |(name, damaged)| {
        let kind = move |files: &Vec<_>| Kind {
            name,
            files: files.clone(),
            damaged: Some(damaged),
            line: "check packs",
        };
        all.iter().map(kind).collect::<Vec<_>>()
    };
    Ok(kinds.flat_map(of).collect())
}

/// The Verilog of a unit: what Verilator makes of its ports is compared with what they should be.
fn verilog(workspace: &Path) -> io::Result<Kind> {
    let mut files = Vec::new();
    for name in ["sam_sampler.v", "sam_formats.vh", "sam_formal.vh"] {
        files.push((format!("v/{name}"), fs::read(workspace.join("rtl").join(name))?));
    }
    let line = "cosim sampler --beats 20 --rtl v";
    Ok(Kind { name: VERILOG, files, damaged: Some("sampler.v"), line })
}

/// The kind that takes a second for each input.
pub const VERILOG: &str = "verilog";
