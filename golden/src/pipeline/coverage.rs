//! Coverage: which samples of a secondary pixel lie inside the three edges (paper, sections 5.3 and
//! 5.4).

use crate::beat;
use crate::formats::*;

beat! {
    /// The three edge functions at a secondary pixel.
    pub struct CoverageEdges {
        /// edge 0
        value0: EdgeValue,
        /// edge 0, one pixel to the right
        a0: Slope,
        /// edge 0, one pixel down
        b0: Slope,
        /// edge 0, dropped bits
        low0: LowBits,
        /// edge 1
        value1: EdgeValue,
        /// edge 1, one pixel to the right
        a1: Slope,
        /// edge 1, one pixel down
        b1: Slope,
        /// edge 1, dropped bits
        low1: LowBits,
        /// edge 2
        value2: EdgeValue,
        /// edge 2, one pixel to the right
        a2: Slope,
        /// edge 2, one pixel down
        b2: Slope,
        /// edge 2, dropped bits
        low2: LowBits,
    }
}

beat! {
    /// Coverage of a secondary pixel.
    pub struct CoveragePixel {
        /// covered samples
        mask: Mask,
        /// their number
        area: Area,
        /// the centre is covered
        centre: bool,
    }
}

/// Covered samples of a pixel.
#[inline]
pub fn coverage(edges: &CoverageEdges, formats: &Formats) -> CoveragePixel {
    let e = edges;
    let edge = [
        (e.value0, e.a0, e.b0, e.low0),
        (e.value1, e.a1, e.b1, e.low1),
        (e.value2, e.a2, e.b2, e.low2),
    ];
    let centre = edge.iter().all(|(value, ..)| value.raw() >= 0);
    if formats.mask_bits == 1 {
        let one = i64::from(centre);
        return CoveragePixel {
            mask: Mask::new(one, formats),
            area: Area::new(one, formats),
            centre,
        };
    }
    let mask = edge.iter().fold(0xffff, |mask, &(value, a, b, low)| {
        mask & edge_mask(8 * value.raw() + low.raw(), a.raw(), b.raw())
    });
    CoveragePixel {
        mask: Mask::new(mask.into(), formats),
        area: Area::new(mask.count_ones().into(), formats),
        centre,
    }
}

/// Samples inside one edge, whose function at the centre is `eighths` of a last place.
fn edge_mask(eighths: i64, a: i64, b: i64) -> u16 {
    // Far from the edge all samples agree.
    let reach = 3 * (a.abs() + b.abs());
    if eighths.abs() > reach {
        return if eighths < 0 { 0 } else { 0xffff };
    }
    (0..16).fold(0, |mask, n| {
        let [right, down] = [2 * (n & 3) - 3, 2 * (n >> 2) - 3];
        mask | u16::from(eighths + right * a + down * b >= 0) << n
    })
}
