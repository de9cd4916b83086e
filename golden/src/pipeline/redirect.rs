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

/// The pixels of a slot in order, each with the stream it leaves by.
#[inline]
pub fn redirect(slot: &Slot, single: bool) -> impl Iterator<Item = (Eye, Pixel)> {
    let stream = move |eye: Eye| if single { Eye::Left } else { eye };
    let primary = slot.primary.then_some(Pixel {
        eye: slot.eye,
        x: slot.primary_x,
        y: slot.primary_y,
        rgba: slot.primary_rgba,
        area: slot.primary_area,
        depth: slot.primary_depth,
        write: slot.primary_write,
        blended: false,
    });
    let secondary = slot.secondary.then_some(Pixel {
        eye: slot.eye.other(),
        x: slot.secondary_x,
        y: slot.secondary_y,
        rgba: slot.secondary_rgba,
        area: slot.secondary_area,
        depth: slot.secondary_depth,
        write: slot.secondary_write,
        blended: slot.secondary_blended,
    });
    primary.into_iter().chain(secondary).map(move |pixel| (stream(pixel.eye), pixel))
}
