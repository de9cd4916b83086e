//! Blend: C = S·t + (1 - t)·B, with t from coverage and alpha (paper, section 5.7).

use crate::beat;
use crate::formats::*;

beat! {
    /// A pixel and what lies behind it; the tag passes through.
    pub struct BlendPixel {
        /// colour S of the pixel
        rgb: [u8; 3],
        /// its alpha
        alpha: u8,
        /// its covered samples
        area: Area,
        /// background colour B
        background: [u8; 3],
        /// opaque companion
        tag: Tag,
    }
}

beat! {
    /// The blended pixel.
    pub struct BlendColour {
        /// colour C
        rgb: [u8; 3],
        /// the companion of the input
        tag: Tag,
    }
}

/// Blending factor of 256ths, 0 to 256: alpha (255 counts as 1) times the covered fraction.
#[inline]
pub fn factor(alpha: u8, area: Area, formats: &Formats) -> i32 {
    let alpha = i32::from(alpha) + i32::from(alpha >> 7);
    let area = area.raw() as i32;
    match formats.mask_bits {
        1 => alpha * area,
        _ => (alpha * area + 8) >> 4,
    }
}

/// One channel blended with factor `t`; exact for t = 0 and t = 256.
#[inline]
pub fn mix(colour: u8, background: u8, t: i32) -> u8 {
    let difference = i32::from(colour) - i32::from(background);
    (i32::from(background) + ((difference * t + 128) >> 8)) as u8
}

/// The blended colour of a pixel.
#[inline]
pub fn blend(pixel: &BlendPixel, formats: &Formats) -> BlendColour {
    let t = factor(pixel.alpha, pixel.area, formats);
    let rgb = core::array::from_fn(|n| mix(pixel.rgb[n], pixel.background[n], t));
    BlendColour { rgb, tag: pixel.tag }
}
