//! Display: where a secondary pixel goes on the display (paper, section 5.2).

use crate::beat;
use crate::formats::*;

beat! {
    /// A secondary pixel in its view.
    pub struct DisplayPoint {
        /// secondary x
        x: PixelX,
        /// display row before an exchange
        y: Coordinate,
        /// exchange x and y
        swap: bool,
        /// count x from the right
        mirror: bool,
    }
}

beat! {
    /// A pixel on the display.
    pub struct DisplayPixel {
        /// display x
        x: Coordinate,
        /// display y
        y: Coordinate,
    }
}

/// Display position of a point; `width` is that of the view.
#[inline]
pub fn display(point: &DisplayPoint, width: u32, formats: &Formats) -> DisplayPixel {
    let x = point.x.raw();
    let x = if point.mirror { i64::from(width) - 1 - x } else { x };
    let (x, y) = (Coordinate::wrap(x, formats), point.y);
    if point.swap {
        DisplayPixel { x: y, y: x }
    } else {
        DisplayPixel { x, y }
    }
}
