//! Redirection: sends primary and secondary pixels to their eyes (paper, section 5.8).

use super::Pixel;
use crate::beat;
use crate::formats::*;

beat! {
    /// Up to one primary and one secondary pixel.
    pub struct Slot {
        /// there is a primary pixel
        primary: bool,
        /// there is a secondary pixel
        secondary: bool,
        /// the primary's eye
        eye: Eye,
        /// primary x on the display
        primary_x: Coordinate,
        /// primary y on the display
        primary_y: Coordinate,
        /// primary colour, unblended
        primary_rgba: Rgba,
        /// primary covered samples
        primary_area: Area,
        /// primary depth
        primary_depth: Depth,
        /// primary depth is to be written
        primary_write: bool,
        /// secondary x on the display
        secondary_x: Coordinate,
        /// secondary y on the display
        secondary_y: Coordinate,
        /// secondary colour
        secondary_rgba: Rgba,
        /// secondary covered samples
        secondary_area: Area,
        /// secondary depth
        secondary_depth: Depth,
        /// secondary depth is to be written
        secondary_write: bool,
        /// secondary colour is final
        secondary_blended: bool,
    }
}

impl Slot {
    /// The slot of these pixels, as the hardware packs them.
    pub fn new(eye: Eye, primary: Option<Pixel>, secondary: Option<Pixel>) -> Slot {
        let (p, s) = (primary.unwrap_or_default(), secondary.unwrap_or_default());
        Slot {
            primary: primary.is_some(),
            secondary: secondary.is_some(),
            eye,
            primary_x: p.x,
            primary_y: p.y,
            primary_rgba: p.rgba,
            primary_area: p.area,
            primary_depth: p.depth,
            primary_write: p.write,
            secondary_x: s.x,
            secondary_y: s.y,
            secondary_rgba: s.rgba,
            secondary_area: s.area,
            secondary_depth: s.depth,
            secondary_write: s.write,
            secondary_blended: s.blended,
        }
    }

    /// The primary pixel.
    pub fn primary_pixel(&self) -> Option<Pixel> {
        self.primary.then_some(Pixel {
            eye: self.eye,
            x: self.primary_x,
            y: self.primary_y,
            rgba: self.primary_rgba,
            area: self.primary_area,
            depth: self.primary_depth,
            write: self.primary_write,
            blended: false,
        })
    }

    /// The secondary pixel.
    pub fn secondary_pixel(&self) -> Option<Pixel> {
        self.secondary.then_some(Pixel {
            eye: self.eye.other(),
            x: self.secondary_x,
            y: self.secondary_y,
            rgba: self.secondary_rgba,
            area: self.secondary_area,
            depth: self.secondary_depth,
            write: self.secondary_write,
            blended: self.secondary_blended,
        })
    }
}

/// The stream by which an eye's pixels leave; `single`: both eyes have one display.
#[inline]
pub fn route(eye: Eye, single: bool) -> Eye {
    if single {
        Eye::Left
    } else {
        eye
    }
}

/// The pixels of a slot in order, each with the stream it leaves by.
pub fn redirect(slot: &Slot, single: bool) -> impl Iterator<Item = (Eye, Pixel)> {
    let pixels = slot.primary_pixel().into_iter().chain(slot.secondary_pixel());
    pixels.map(move |pixel| (route(pixel.eye, single), pixel))
}
