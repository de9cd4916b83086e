//! Pictures whose pixels are numbers of colours: a number that has no colour is damage, for which decoders take
//! black without a word.

use image::codecs::bmp::BmpDecoder;
use image::{ImageDecoder, ImageFormat};
use std::io::Cursor;

/// The damage that a picture, which can be decoded, has in this way.
pub fn damage(bytes: &[u8], format: ImageFormat) -> Option<String> {
    let (colours, highest) = match format {
        ImageFormat::Png => png(bytes)?,
        ImageFormat::Bmp => bmp(bytes)?,
        // Of the others none has a palette, or one that decoders do not look at.
        _ => return None,
    };
    let beyond = usize::from(highest) >= colours;
    beyond.then(|| {
        format!("a pixel has colour {highest}, counted from 0, of {colours} in its palette")
    })
}

/// Colours of a palette, and the highest number of a pixel.
fn png(bytes: &[u8]) -> Option<(usize, u8)> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    let info = reader.info();
    let colours = info.palette.as_ref()?.len() / 3;
    if info.color_type != png::ColorType::Indexed {
        return None;
    }
    let (width, bits) = (info.width as usize, info.bit_depth as usize);
    let mut pixels = vec![0; reader.output_buffer_size()?];
    reader.next_frame(&mut pixels).ok()?;
    let mask = u8::MAX >> (8 - bits);
    let number = |line: &[u8], x: usize| line[x * bits / 8] >> (8 - bits - x * bits % 8) & mask;
    let lines = pixels.chunks_exact((width * bits).div_ceil(8));
    let highest = lines.flat_map(|line| (0..width).map(move |x| number(line, x))).max()?;
    Some((colours, highest))
}

/// As [`png`], of a BMP picture that says how many colours it has. Numbers of other than 8 bits, and compressed ones,
/// are not looked at: the decoder cannot give them.
fn bmp(bytes: &[u8]) -> Option<(usize, u8)> {
    let word = |at: usize| Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?));
    let (bits, compression) = (word(26)? >> 16, word(30)?);
    if (bits, compression) != (8, 0) {
        return None;
    }
    // The oldest header does not say it.
    let colours = word(46).filter(|_| word(14).is_some_and(|header| header >= 40))?;
    let mut decoder = BmpDecoder::new(Cursor::new(bytes)).ok()?;
    decoder.get_palette().filter(|_| colours > 0)?;
    decoder.set_indexed_color(true);
    let mut pixels = vec![0; usize::try_from(decoder.total_bytes()).ok()?];
    decoder.read_image(&mut pixels).ok()?;
    Some((colours as usize, pixels.into_iter().max()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 5 x 2 pixels, all of colour 0 but the last.
    fn png_with(depth: png::BitDepth, colours: usize, last: u8) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 5, 2);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(depth);
        encoder.set_palette(vec![200; 3 * colours]);
        let bits = depth as usize;
        let line = (5 * bits).div_ceil(8);
        let mut pixels = vec![0; 2 * line];
        pixels[line + 4 * bits / 8] = last << (8 - bits - 4 * bits % 8);
        let mut writer = encoder.write_header().expect("a header");
        writer.write_image_data(&pixels).expect("pixels");
        writer.finish().expect("an end");
        bytes
    }

    #[test]
    fn a_pixel_beyond_the_palette_of_a_png_is_damage() {
        use png::BitDepth::{Eight, Four, One, Two};
        for (depth, colours) in [(One, 1), (Two, 3), (Four, 9), (Eight, 200)] {
            let at = |last: usize| damage(&png_with(depth, colours, last as u8), ImageFormat::Png);
            assert_eq!(at(colours - 1), None, "{depth:?}");
            let found = at(colours).expect("damage");
            let said = format!("has colour {colours}, counted from 0, of {colours} in");
            assert!(found.contains(&said), "{depth:?}: {found}");
        }
    }

    #[test]
    fn a_pixel_beyond_the_palette_of_a_bmp_is_damage() {
        let mut bytes = Vec::new();
        let mut encoder = image::codecs::bmp::BmpEncoder::new(&mut bytes);
        let (pixels, palette) = ([0, 1, 2, 3], [[200; 3]; 4]);
        let eight = image::ExtendedColorType::L8;
        encoder.encode_with_palette(&pixels, 2, 2, eight, Some(&palette)).expect("encoded");
        assert_eq!(damage(&bytes, ImageFormat::Bmp), None);
        // The data follow the palette.
        bytes[46] = 3;
        let found = damage(&bytes, ImageFormat::Bmp).expect("damage");
        assert!(found.contains("has colour 3, counted from 0, of 3 in"), "{found}");
    }

    /// A picture of two colours; of 2 x 2 pixels, or of 8 x 2 if it has one bit for each.
    fn bmp_with(bits: u8, compression: u8, data: &[u8]) -> Vec<u8> {
        let width = if bits == 1 { 8 } else { 2 };
        let mut bytes = b"BM\0\0\0\0\0\0\0\0\x3e\0\0\0\x28\0\0\0".to_vec();
        bytes.extend([width, 0, 0, 0, 2, 0, 0, 0, 1, 0, bits, 0, compression, 0, 0, 0]);
        bytes.extend([data.len() as u8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0]);
        bytes.extend([0, 0, 255, 0, 0, 255, 0, 0]);
        [&bytes, data].concat()
    }

    #[test]
    fn bmp_pictures_of_every_kind_of_palette_are_undamaged() {
        const RLE: [u8; 8] = [2, 0, 0, 0, 2, 1, 0, 1];
        let kinds: [(u8, u8, &[u8]); 5] = [
            (1, 0, &[0x55, 0, 0, 0, 0xaa, 0, 0, 0]),
            (4, 0, &[0x10, 0, 0, 0, 0x01, 0, 0, 0]),
            (8, 0, &[1, 0, 0, 0, 0, 1, 0, 0]),
            (8, 1, &RLE),
            (4, 2, &RLE),
        ];
        for (bits, compression, data) in kinds {
            let bytes = bmp_with(bits, compression, data);
            let picture = image::load_from_memory(&bytes).expect("a picture");
            assert_eq!(picture.height(), 2);
            assert_eq!(damage(&bytes, ImageFormat::Bmp), None, "{bits} bits, {compression}");
        }
        let beyond = bmp_with(8, 0, &[1, 2, 0, 0, 0, 1, 0, 0]);
        assert!(damage(&beyond, ImageFormat::Bmp).is_some());
    }
}
