//! Pictures: files that are either whole or not there, stereo composites, comparisons.

mod composite;
mod file;

pub use composite::*;
pub use file::*;
pub use image::{Rgb, RgbImage};

use crate::formats::Rgba;
use crate::frame::Frame;

/// The pictures of the two eyes.
#[derive(Clone, Copy, Debug)]
pub struct Views<'a> {
    /// The left eye's view.
    pub left: &'a RgbImage,
    /// The right eye's view; of the same size.
    pub right: &'a RgbImage,
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
