//! Pictures as textures: PNG, JPEG, BMP, TGA and WebP, told apart by their content.

use super::super::error::{read, reading};
use super::palette;
use crate::formats::Rgba;
use crate::guard::guarded;
use crate::texture::Texture;
use image::{ImageFormat, ImageReader, Limits, RgbImage, RgbaImage};
use std::collections::HashMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

/// Largest width and height of a texture.
pub const TEXTURE_LIMIT: u32 = 4096;
/// Most texels of all textures of a scene: 64 of 1024 x 1024.
pub const TEXELS_LIMIT: usize = 1 << 26;
/// The formats that are read.
const FORMATS: &str = "PNG, JPEG, BMP, TGA or WebP";

/// A picture that has been read.
struct Picture {
    texels: RgbaImage,
    /// The damage, if the picture could be read nevertheless.
    damage: Option<String>,
}

/// The textures of a scene, each picture once.
#[derive(Default)]
pub struct Pictures {
    /// The textures.
    pub textures: Vec<Texture>,
    texels: usize,
    /// Index and damage, or why there is none.
    known: HashMap<PathBuf, Result<(u32, Option<String>), String>>,
}

impl Pictures {
    /// Index of the texture of a file, and what is damaged of it; or why there is none.
    pub fn index(&mut self, file: &Path) -> Result<(u32, Option<String>), String> {
        if let Some(known) = self.known.get(file) {
            return known.clone();
        }
        let loaded = self.load(file);
        self.known.insert(file.into(), loaded.clone());
        loaded
    }

    fn load(&mut self, file: &Path) -> Result<(u32, Option<String>), String> {
        let _reading = reading(file);
        let bytes = read(file).map_err(|error| error.to_string())?;
        let extension = file.extension().map(|e| e.to_string_lossy().to_lowercase());
        let is_tga = extension.as_deref() == Some("tga");
        let Picture { texels, damage } = guarded(|| decode(&bytes, is_tga))??;
        let sum = self.texels + texels.len() / 4;
        if sum > TEXELS_LIMIT {
            return Err(format!("more than {TEXELS_LIMIT} texels in all textures"));
        }
        self.texels = sum;
        self.textures.push(Texture {
            width: texels.width(),
            height: texels.height(),
            texels: texels.pixels().map(|p| Rgba(p.0)).collect(),
        });
        Ok((self.textures.len() as u32 - 1, damage))
    }
}

/// Decodes a picture; TGA has no mark of its own in front.
fn decode(bytes: &[u8], is_tga: bool) -> Result<Picture, String> {
    let guessed = image::guess_format(bytes).ok().or(is_tga.then_some(ImageFormat::Tga));
    let format = match guessed {
        Some(ImageFormat::Jpeg) => return decode_jpeg(bytes),
        Some(format) if format.reading_enabled() => format,
        _ => return Err(format!("expected {FORMATS}")),
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_image_width = Some(TEXTURE_LIMIT);
    limits.max_image_height = Some(TEXTURE_LIMIT);
    reader.limits(limits);
    let picture = reader.decode().map_err(|error| match error {
        image::ImageError::Limits(_) => too_large(),
        error => error.to_string(),
    })?;
    Ok(Picture { texels: picture.into_rgba8(), damage: palette::damage(bytes, format) })
}

fn too_large() -> String {
    format!("expected at most {TEXTURE_LIMIT} pixels a side")
}

/// Decodes a JPEG picture strictly; one that fails so is damaged, but most of it may be there.
fn decode_jpeg(bytes: &[u8]) -> Result<Picture, String> {
    match jpeg_pixels(bytes, true) {
        Ok(texels) => {
            let damage = jpeg_damage(bytes, &texels).map(String::from);
            Ok(Picture { texels, damage })
        }
        Err(strict) => match jpeg_pixels(bytes, false) {
            Ok(texels) => Ok(Picture { texels, damage: Some(strict) }),
            Err(error) => Err(error),
        },
    }
}

fn jpeg_pixels(bytes: &[u8], strict: bool) -> Result<RgbaImage, String> {
    let options = DecoderOptions::default()
        .set_strict_mode(strict)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX))
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("no size")?;
    let most = TEXTURE_LIMIT as usize;
    if width > most || height > most {
        return Err(too_large());
    }
    let pixels = decoder.decode().map_err(|error| error.to_string())?;
    let picture = RgbImage::from_raw(width as u32, height as u32, pixels);
    let picture = picture.ok_or("not as many pixels as its size says")?;
    Ok(image::DynamicImage::ImageRgb8(picture).into_rgba8())
}

/// The damage of a JPEG picture that decodes to these texels. Decoders do not miss the mark of the end, and go on with
/// zeros where the data before it ends early: with other bits there they make another picture.
fn jpeg_damage(bytes: &[u8], texels: &RgbaImage) -> Option<&'static str> {
    /// No mark, and neither all zeros nor all ones.
    const FILL: [u8; 16] = [0x5a; 16];
    let Some(end) = jpeg_end(bytes) else { return Some("it ends early") };
    let filled = [&bytes[..end], &FILL, &bytes[end..]].concat();
    let same = jpeg_pixels(&filled, false).is_ok_and(|other| other == *texels);
    (!same).then_some("a part of its data is missing")
}

/// Walks over the segments of a JPEG file to the mark of its end.
fn jpeg_end(bytes: &[u8]) -> Option<usize> {
    // Behind the mark of the start.
    let mut at = 2;
    loop {
        // Segments begin with 0xff and may be filled up with more of them.
        let from = at + bytes.get(at..)?.iter().position(|&b| b == 0xff)?;
        at = from + bytes[from..].iter().position(|&b| b != 0xff)?;
        match bytes[at] {
            0xd9 => return Some(from),
            // Stuffed and restart marks stand in the data of a scan, which has no length.
            0 | 1 | 0xd0..=0xd8 => at += 1,
            _ => {
                let length = bytes.get(at + 1..at + 3)?;
                at += 1 + usize::from(u16::from_be_bytes([length[0], length[1]])).max(2);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, Rgba as Pixel};

    /// A picture with something in every block.
    fn picture() -> DynamicImage {
        let pixel = |x: u32, y: u32| Pixel([(x * 5) as u8, (y * 7) as u8, (x * y) as u8, 255]);
        DynamicImage::ImageRgba8(RgbaImage::from_fn(50, 34, pixel))
    }

    fn encoded(format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        let opaque = DynamicImage::ImageRgb8(picture().into_rgb8());
        opaque.write_to(&mut bytes, format).expect("encoded");
        bytes.into_inner()
    }

    #[test]
    fn every_format_is_read() {
        let expected = picture().into_rgba8();
        for format in [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tga, ImageFormat::WebP] {
            let bytes = encoded(format);
            let read = decode(&bytes, format == ImageFormat::Tga).expect("well-formed");
            assert!(read.texels == expected && read.damage.is_none(), "{format:?}");
        }
        let read = decode(&encoded(ImageFormat::Jpeg), false).expect("well-formed");
        assert_eq!((read.texels.dimensions(), read.damage), ((50, 34), None));
    }

    #[test]
    fn no_picture_that_ends_early_is_taken_for_a_whole_one() {
        for format in [ImageFormat::Jpeg, ImageFormat::Bmp, ImageFormat::Tga] {
            let bytes = encoded(format);
            for length in 0..bytes.len() {
                let read = decode(&bytes[..length], format == ImageFormat::Tga);
                let told = read.is_err() || read.is_ok_and(|picture| picture.damage.is_some());
                assert!(told, "{format:?}: {length} of {}", bytes.len());
            }
        }
        // What follows the pixels of these need not be there.
        for (format, spare) in [(ImageFormat::Png, 4), (ImageFormat::WebP, 1)] {
            let bytes = encoded(format);
            for length in 0..bytes.len() - spare {
                assert!(decode(&bytes[..length], false).is_err(), "{format:?}: {length}");
            }
        }
    }

    #[test]
    fn most_of_a_damaged_jpeg_is_there() {
        let whole = encoded(ImageFormat::Jpeg);
        let cut = decode(&whole[..whole.len() * 3 / 4], false).expect("most of it");
        assert_eq!(cut.texels.dimensions(), (50, 34));
        // What follows the end does not matter.
        let longer = [&whole[..], b"\0\xff\xd8"].concat();
        assert_eq!(decode(&longer, false).expect("whole").damage, None);
        let without_end = decode(&whole[..whole.len() - 2], false).expect("all of it");
        assert_eq!(without_end.damage.as_deref(), Some("it ends early"));
        // The end is there, the data before it not.
        let end = whole.len() - 2;
        for cut in [end * 3 / 4, end - 20, end - 3] {
            let bytes = [&whole[..cut], &whole[end..]].concat();
            let found = decode(&bytes, false).expect("most of it").damage;
            assert_eq!(found.as_deref(), Some("a part of its data is missing"), "{cut} of {end}");
        }
    }

    #[test]
    fn other_and_larger_files_are_refused() {
        for bytes in [&b""[..], b"x", b"GIF89a\x01\0\x01\0\0\0\0", b"DDS |\0\0\0"] {
            let error = decode(bytes, false).err();
            assert_eq!(error.as_deref(), Some("expected PNG, JPEG, BMP, TGA or WebP"), "{bytes:?}");
        }
        for format in [ImageFormat::Png, ImageFormat::Jpeg] {
            let wide = DynamicImage::ImageRgb8(RgbImage::new(TEXTURE_LIMIT + 1, 1));
            let mut bytes = Cursor::new(Vec::new());
            wide.write_to(&mut bytes, format).expect("encoded");
            let error = decode(&bytes.into_inner(), false).err().expect("too wide");
            assert_eq!(error, "expected at most 4096 pixels a side");
        }
    }
}
