//! Pictures as PNG files.

use super::{RgbImage, Views};
use crate::files::{write, WriteError};
use std::path::Path;

/// Writes a PNG file, as [`write()`] writes any file.
pub fn write_png(file: &Path, picture: &RgbImage) -> Result<(), WriteError> {
    write_png_at(file, picture, None)
}

/// Writes a PNG file that says how large it is in print, if `dots_per_inch` are given.
pub fn write_png_at(
    file: &Path,
    picture: &RgbImage,
    dots_per_inch: Option<f64>,
) -> Result<(), WriteError> {
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, picture.width(), picture.height());
        encoder.set_color(png::ColorType::Rgb);
        // PNG counts dots in a metre.
        encoder.set_pixel_dims(dots_per_inch.map(|dots| {
            let dots = (dots / 0.0254).round() as u32;
            png::PixelDimensions { xppu: dots, yppu: dots, unit: png::Unit::Meter }
        }));
        let mut writer = encoder.write_header()?;
        writer.write_image_data(picture.as_raw())?;
        writer.finish()?;
        Ok(bytes)
    };
    write(file, &encode().map_err(|e| encoding(file, e))?)
}

/// Writes an animated PNG file that shows the two pictures in turn, `milliseconds` each; programs
/// that do not know animation show the first one.
pub fn write_wiggle(file: &Path, views: &Views, milliseconds: u16) -> Result<(), WriteError> {
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, views.left.width(), views.left.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_animated(2, 0)?;
        encoder.set_frame_delay(milliseconds, 1000)?;
        let mut writer = encoder.write_header()?;
        writer.write_image_data(views.left.as_raw())?;
        writer.write_image_data(views.right.as_raw())?;
        writer.finish()?;
        Ok(bytes)
    };
    write(file, &encode().map_err(|e| encoding(file, e))?)
}

fn encoding(file: &Path, error: impl std::error::Error + Send + Sync + 'static) -> WriteError {
    WriteError { file: file.to_owned(), source: std::io::Error::other(error) }
}
