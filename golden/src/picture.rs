//! Pictures: stereo composites, comparisons, and files that are either whole or not there.

use crate::formats::Rgba;
use crate::frame::Frame;
pub use image::{Rgb, RgbImage};
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

/// Writes a file: under a temporary name beside it, then renamed.
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
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).map_err(|e| encoding(file, e))?;
    write_file(file, bytes.get_ref())
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

/// The pictures of the two eyes.
#[derive(Clone, Copy, Debug)]
pub struct Views<'a> {
    /// What the left eye sees.
    pub left: &'a RgbImage,
    /// What the right eye sees; of the same size.
    pub right: &'a RgbImage,
}

/// A way to show two views in one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composite {
    /// Red and cyan by Dubois's least-squares method: for glasses, the red one on the left eye.
    Anaglyph,
    /// Side by side, left eye on the left: look through the picture.
    Parallel,
    /// Side by side, left eye on the right: cross the eyes.
    Crossed,
    /// Even rows, counted from 0 at the top, for the left and odd ones for the right eye: for
    /// row-polarised screens.
    Interleaved,
    /// One after the other; an animation.
    Wiggle,
}

impl Composite {
    /// All of them.
    pub const ALL: [Composite; 5] = [
        Composite::Anaglyph,
        Composite::Parallel,
        Composite::Crossed,
        Composite::Interleaved,
        Composite::Wiggle,
    ];

    /// Name on the command line and of the file, which ends in `.png`.
    pub fn name(self) -> &'static str {
        match self {
            Composite::Anaglyph => "anaglyph",
            Composite::Parallel => "parallel",
            Composite::Crossed => "crossed",
            Composite::Interleaved => "interleaved",
            Composite::Wiggle => "wiggle",
        }
    }

    /// The composite of that name.
    pub fn named(name: &str) -> Option<Composite> {
        Composite::ALL.into_iter().find(|c| c.name() == name)
    }

    /// Writes the composite of two views to a PNG file.
    pub fn write(self, file: &Path, views: &Views) -> Result<(), WriteError> {
        let Views { left, right } = *views;
        match self {
            Composite::Anaglyph => write_png(file, &anaglyph(views)),
            Composite::Parallel => write_png(file, &side_by_side(left, right)),
            Composite::Crossed => write_png(file, &side_by_side(right, left)),
            Composite::Interleaved => write_png(file, &interleaved(views)),
            Composite::Wiggle => write_wiggle(file, views, 150),
        }
    }
}

/// Two pictures beside each other.
pub fn side_by_side(first: &RgbImage, second: &RgbImage) -> RgbImage {
    let height = first.height().max(second.height());
    let mut both = RgbImage::new(first.width() + second.width(), height);
    image::imageops::replace(&mut both, first, 0, 0);
    image::imageops::replace(&mut both, second, first.width().into(), 0);
    both
}

/// Even rows of the left and odd rows of the right view.
pub fn interleaved(views: &Views) -> RgbImage {
    let mut picture = views.left.clone();
    for (x, y, pixel) in views.right.enumerate_pixels().filter(|(_, y, _)| y % 2 == 1) {
        if x < picture.width() && y < picture.height() {
            picture.put_pixel(x, y, *pixel);
        }
    }
    picture
}

/// Weights of the left view's red, green and blue, then the right one's, in each channel of a
/// red-cyan anaglyph (E. Dubois, "A projection method to generate anaglyph stereo images", 2001;
/// the published matrix for common screens and glasses), for linear light.
const DUBOIS: [[f64; 6]; 3] = [
    [0.456_100, 0.500_484, 0.176_381, -0.043_470_6, -0.087_938_8, -0.001_555_29],
    [-0.040_082_2, -0.037_824_6, -0.015_758_9, 0.378_476, 0.733_64, -0.018_450_3],
    [-0.015_216_1, -0.020_597_1, -0.005_468_56, -0.072_152_7, -0.112_961, 1.226_4],
];

/// A red-cyan anaglyph, computed in linear light.
pub fn anaglyph(views: &Views) -> RgbImage {
    let linear: Vec<f64> = (0..=255u8).map(|n| to_linear(f64::from(n) / 255.0)).collect();
    let black = Rgb([0; 3]);
    RgbImage::from_fn(views.left.width(), views.left.height(), |x, y| {
        let Rgb([r, g, b]) = *views.left.get_pixel(x, y);
        let Rgb([r2, g2, b2]) = *views.right.get_pixel_checked(x, y).unwrap_or(&black);
        let light = [r, g, b, r2, g2, b2].map(|n| linear[usize::from(n)]);
        Rgb(DUBOIS.map(|weights| {
            let sum: f64 = weights.iter().zip(light).map(|(w, n)| w * n).sum();
            (from_linear(sum.clamp(0.0, 1.0)) * 255.0).round() as u8
        }))
    })
}

/// Light of an sRGB value, both from 0 to 1.
fn to_linear(n: f64) -> f64 {
    if n <= 0.040_45 {
        n / 12.92
    } else {
        ((n + 0.055) / 1.055).powf(2.4)
    }
}

/// The inverse of [`to_linear`].
fn from_linear(n: f64) -> f64 {
    if n <= 0.003_130_8 {
        n * 12.92
    } else {
        1.055 * n.powf(1.0 / 2.4) - 0.055
    }
}

/// The colour that stands for a polygon in id pictures: 1 + id as red << 16 | green << 8 | blue,
/// and black for the background. Ids are below 2^24 - 1.
pub fn id_colour(id: Option<u32>) -> Rgb<u8> {
    let [_, r, g, b] = id.map_or(0, |id| id.wrapping_add(1)).to_be_bytes();
    Rgb([r, g, b])
}

/// The polygon that a colour of an id picture stands for.
pub fn id_of_colour(colour: Rgb<u8>) -> Option<u32> {
    let Rgb([r, g, b]) = colour;
    u32::from_be_bytes([0, r, g, b]).checked_sub(1)
}

/// An id picture; `id` is asked for every pixel.
pub fn id_picture(width: u32, height: u32, id: impl Fn(u32, u32) -> Option<u32>) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| id_colour(id(x, y)))
}

/// A picture of colours given row by row; alpha is left out. Missing ones are black.
pub fn colour_picture(width: u32, height: u32, colours: &[Rgba]) -> RgbImage {
    let mut picture = RgbImage::new(width, height);
    for (pixel, colour) in picture.pixels_mut().zip(colours) {
        *pixel = Rgb(colour.rgb());
    }
    picture
}

/// The colours of a frame.
pub fn frame_picture(frame: &Frame) -> RgbImage {
    let colours: Vec<Rgba> = frame.colour.iter().map(|&[r, g, b]| Rgba([r, g, b, 255])).collect();
    colour_picture(frame.width, frame.height, &colours)
}

/// Absolute differences of two pictures of one size, each multiplied by `gain`.
pub fn difference(a: &RgbImage, b: &RgbImage, gain: u8) -> RgbImage {
    let mut picture = a.clone();
    for (pixel, other) in picture.pixels_mut().zip(b.pixels()) {
        for (channel, other) in pixel.0.iter_mut().zip(other.0) {
            *channel = channel.abs_diff(other).saturating_mul(gain);
        }
    }
    picture
}

/// Peak signal-to-noise ratio of two pictures of one size over all channels, in dB; infinite
/// where they are equal, none where their sizes differ.
pub fn psnr(a: &RgbImage, b: &RgbImage) -> Option<f64> {
    if a.dimensions() != b.dimensions() {
        return None;
    }
    let square = |(a, b): (&u8, &u8)| u64::from(a.abs_diff(*b)).pow(2);
    let sum: u64 = a.as_raw().iter().zip(b.as_raw()).map(square).sum();
    let mean = sum as f64 / a.as_raw().len().max(1) as f64;
    Some(10.0 * (255.0 * 255.0 / mean).log10())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(seed: u64) -> RgbImage {
        let mut random = fastrand::Rng::with_seed(seed);
        RgbImage::from_fn(17, 9, |_, _| Rgb([random.u8(..), random.u8(..), random.u8(..)]))
    }

    #[test]
    fn composites_put_pixels_where_they_say() {
        let (left, right) = (noise(1), noise(2));
        let views = Views { left: &left, right: &right };
        let parallel = side_by_side(&left, &right);
        assert_eq!(parallel.dimensions(), (34, 9));
        assert_eq!(parallel.get_pixel(20, 5), right.get_pixel(3, 5));
        let rows = interleaved(&views);
        assert_eq!(rows.get_pixel(4, 6), left.get_pixel(4, 6));
        assert_eq!(rows.get_pixel(4, 7), right.get_pixel(4, 7));
        assert!(Composite::ALL.iter().all(|c| Composite::named(c.name()) == Some(*c)));
        assert_eq!(Composite::named("red"), None);
    }

    #[test]
    fn anaglyphs_keep_greys_and_separate_the_eyes() {
        let grey = |n| RgbImage::from_pixel(1, 1, Rgb([n; 3]));
        let mixed = |left: u8, right: u8| {
            let (left, right) = (grey(left), grey(right));
            anaglyph(&Views { left: &left, right: &right }).get_pixel(0, 0).0
        };
        assert_eq!(mixed(0, 0), [0; 3]);
        assert!(mixed(255, 255).iter().all(|n| *n >= 254));
        assert!(mixed(128, 128).iter().all(|n| n.abs_diff(128) <= 2), "{:?}", mixed(128, 128));
        let [r, g, b] = mixed(255, 0);
        assert!(r > 250 && g == 0 && b == 0);
        let [r, g, b] = mixed(0, 255);
        assert!(r == 0 && g > 250 && b > 250);
    }

    #[test]
    fn linear_light_there_and_back() {
        for n in 0..=255u8 {
            let back = from_linear(to_linear(f64::from(n) / 255.0)) * 255.0;
            assert!((back - f64::from(n)).abs() < 1e-3);
        }
    }

    #[test]
    fn ids_are_colours() {
        assert_eq!(id_colour(None), Rgb([0; 3]));
        assert_eq!(id_colour(Some(0)), Rgb([0, 0, 1]));
        assert_eq!(id_colour(Some(0x12_3455)), Rgb([0x12, 0x34, 0x56]));
        for id in [None, Some(0), Some(255), Some(65_535), Some((1 << 24) - 2)] {
            assert_eq!(id_of_colour(id_colour(id)), id);
        }
        let picture = id_picture(3, 2, |x, y| (x == 1 && y == 1).then_some(6));
        assert_eq!(picture.get_pixel(1, 1), &Rgb([0, 0, 7]));
        assert_eq!(picture.get_pixel(1, 0), &Rgb([0; 3]));
        let picture = colour_picture(2, 2, &[Rgba([1, 2, 3, 4]), Rgba([5, 6, 7, 8])]);
        assert_eq!(picture.get_pixel(1, 0), &Rgb([5, 6, 7]));
        assert_eq!(picture.get_pixel(1, 1), &Rgb([0; 3]));
    }

    #[test]
    fn psnr_of_known_differences() {
        let (a, mut b) = (RgbImage::new(10, 10), RgbImage::new(10, 10));
        assert_eq!(psnr(&a, &b), Some(f64::INFINITY));
        b.pixels_mut().for_each(|p| p.0 = [1; 3]);
        assert!((psnr(&a, &b).unwrap() - 48.130_8).abs() < 1e-3);
        assert_eq!(difference(&a, &b, 50).get_pixel(3, 3), &Rgb([50; 3]));
        assert_eq!(psnr(&a, &RgbImage::new(10, 11)), None);
    }
}
