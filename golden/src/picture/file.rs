//! Files that are either whole or not there.

use super::{RgbImage, Views};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Why a file was not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {source}", .file.display())]
pub struct WriteError {
    /// The file.
    pub file: PathBuf,
    /// Why.
    pub source: std::io::Error,
}

/// Writes a file: under a temporary name beside it, then renamed. Folders that are missing are made, so that
/// nobody loses what took long for want of one.
///
/// If anything fails, or the program is killed, a file of that name is as it was before, or not
/// there. Only a kill can leave the temporary file, `.NAME.XXXXXX.part`.
pub fn write_file(file: &Path, content: &[u8]) -> Result<(), WriteError> {
    let write = || -> std::io::Result<()> {
        let folder = match file.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let Some(name) = file.file_name() else {
            return Err(std::io::Error::other("not the name of a file"));
        };
        std::fs::create_dir_all(folder)?;
        let mut builder = tempfile::Builder::new();
        let prefix = format!(".{}.", name.to_string_lossy());
        builder.prefix(&prefix).suffix(".part");
        #[cfg(unix)]
        {
            // As for any new file: the umask decides.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut temporary = builder.tempfile_in(folder)?;
        temporary.write_all(content)?;
        temporary.flush()?;
        temporary.persist(file).map_err(|e| e.error)?;
        Ok(())
    };
    write().map_err(|source| WriteError { file: file.to_owned(), source })
}

/// Writes a PNG file, as [`write_file`] does.
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
    write_file(file, &encode().map_err(|e| encoding(file, e))?)
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
    write_file(file, &encode().map_err(|e| encoding(file, e))?)
}

fn encoding(file: &Path, error: impl std::error::Error + Send + Sync + 'static) -> WriteError {
    WriteError { file: file.to_owned(), source: std::io::Error::other(error) }
}
