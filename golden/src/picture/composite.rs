//! Two views in one picture: for glasses, for free viewing, for print, and as displays store them.

use super::{write_png_at, write_wiggle, Rgb, RgbImage, Views};
use crate::files::WriteError;
use std::path::Path;

/// A way to show two views in one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composite {
    /// Red and cyan by Dubois's least-squares method: for glasses, the red one on the left eye.
    Anaglyph,
    /// Side by side, left eye on the left: look through the picture.
    Parallel,
    /// Side by side, left eye on the right: cross the eyes.
    Crossed,
    /// Left, right, left: look through the first two or cross the eyes at the last two (Bauer, in
    /// Duvanenko & Robbins 1993).
    Triplet,
    /// Even rows, counted from 0 at the top, for the left and odd ones for the right eye: for
    /// row-polarised screens, and field-sequential storage (Heo et al. 1998, section 1, figure 2).
    Interleaved,
    /// The whole left and, after it, the whole right frame, as frame-sequential storage has them
    /// (Heo et al. 1998, section 1).
    FrameSequential,
    /// One after the other; an animation.
    Wiggle,
}

impl Composite {
    /// All of them.
    pub const ALL: [Composite; 7] = [
        Composite::Anaglyph,
        Composite::Parallel,
        Composite::Crossed,
        Composite::Triplet,
        Composite::Interleaved,
        Composite::FrameSequential,
        Composite::Wiggle,
    ];

    /// Name on the command line and of the file, which ends in `.png`.
    pub fn name(self) -> &'static str {
        match self {
            Composite::Anaglyph => "anaglyph",
            Composite::Parallel => "parallel",
            Composite::Crossed => "crossed",
            Composite::Triplet => "triplet",
            Composite::Interleaved => "interleaved",
            Composite::FrameSequential => "frame-sequential",
            Composite::Wiggle => "wiggle",
        }
    }

    /// The composite of that name; `field-sequential` is another one for `interleaved`.
    pub fn named(name: &str) -> Option<Composite> {
        let name = if name == "field-sequential" { "interleaved" } else { name };
        Composite::ALL.into_iter().find(|c| c.name() == name)
    }

    /// True if the views stand side by side, to be looked at without glasses.
    pub fn is_side_by_side(self) -> bool {
        matches!(self, Composite::Parallel | Composite::Crossed | Composite::Triplet)
    }

    /// Writes the composite of two views to a PNG file, which says how large it is in print if
    /// `dots_per_inch` are given; an animation is not for print.
    pub fn write(
        self,
        file: &Path,
        views: &Views,
        dots_per_inch: Option<f64>,
    ) -> Result<(), WriteError> {
        let Views { left, right } = *views;
        let picture = match self {
            Composite::Anaglyph => anaglyph(views),
            Composite::Parallel => side_by_side(&[left, right]),
            Composite::Crossed => side_by_side(&[right, left]),
            Composite::Triplet => side_by_side(&[left, right, left]),
            Composite::Interleaved => interleaved(views),
            Composite::FrameSequential => frame_sequential(views),
            Composite::Wiggle => return write_wiggle(file, views, 150),
        };
        write_png_at(file, &picture, dots_per_inch)
    }
}

/// Dots per inch at which neighbouring views `width` pixels wide can be looked through in print:
/// points at infinity, whose disparity is `far` pixels, are then as far apart as the eyes,
/// `eye_separation` inches, and nothing makes the eyes diverge.
pub fn print_resolution(width: u32, far: f64, eye_separation: f64) -> f64 {
    (f64::from(width) + far) / eye_separation
}

/// Pictures beside each other, from the left.
pub fn side_by_side(pictures: &[&RgbImage]) -> RgbImage {
    let width = pictures.iter().map(|p| p.width()).sum();
    let height = pictures.iter().map(|p| p.height()).max().unwrap_or(0);
    let mut all = RgbImage::new(width, height);
    let mut x = 0;
    for picture in pictures {
        image::imageops::replace(&mut all, *picture, x, 0);
        x += i64::from(picture.width());
    }
    all
}

/// The left frame and, in the rows after it, the right one.
pub fn frame_sequential(views: &Views) -> RgbImage {
    let Views { left, right } = *views;
    let width = left.width().max(right.width());
    let mut both = RgbImage::new(width, left.height() + right.height());
    image::imageops::replace(&mut both, left, 0, 0);
    image::imageops::replace(&mut both, right, 0, left.height().into());
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
        let parallel = side_by_side(&[&left, &right]);
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
}
