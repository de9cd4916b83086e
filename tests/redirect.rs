//! Redirection: nothing is lost, nothing added, and the order is kept.

use fastrand::Rng;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::redirect::{redirect, Slot};
use wheatstone_golden::pipeline::Pixel;

/// A pixel that no other looks like.
fn pixel(rng: &mut Rng, f: &Formats, eye: Eye, blended: bool) -> Pixel {
    Pixel {
        eye,
        x: Coordinate::wrap(rng.i64(..), f),
        y: Coordinate::wrap(rng.i64(..), f),
        rgba: Rgba::from_word(rng.u32(..)),
        area: Area::wrap(rng.i64(..), f),
        depth: Depth::wrap(rng.i64(..), f),
        write: rng.bool(),
        blended,
    }
}

#[test]
fn every_pixel_leaves_by_its_stream_in_order() {
    let f = &Formats::new(&Config::FULL);
    let rng = &mut Rng::with_seed(2);
    for single in [false, true] {
        let (mut given, mut taken): ([Vec<Pixel>; 2], [Vec<Pixel>; 2]) = Default::default();
        for _ in 0..20_000 {
            let eye = Eye::BOTH[rng.usize(..2)];
            let primary = rng.bool().then(|| pixel(rng, f, eye, false));
            let blended = rng.bool();
            let secondary = rng.bool().then(|| pixel(rng, f, eye.other(), blended));
            for pixel in primary.iter().chain(&secondary) {
                // One display: everything to the left, the primary before its secondary.
                given[if single { 0 } else { pixel.eye as usize }].push(*pixel);
            }
            let [p, s] = [primary, secondary].map(Option::unwrap_or_default);
            let slot = Slot {
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
            };
            for (stream, pixel) in redirect(&slot, single) {
                taken[stream as usize].push(pixel);
            }
        }
        assert_eq!(given, taken, "single {single}");
        assert_eq!(single, taken[Eye::Right as usize].is_empty());
    }
}
