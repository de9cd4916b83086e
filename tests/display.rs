//! Display: against its definition, and nothing of a view is lost or falls on something else.

use std::collections::BTreeSet;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::pipeline::display::{display, DisplayPoint};

#[test]
fn every_pixel_of_a_view_has_a_place_of_its_own() {
    for config in [Config::DEFAULT, Config::PAPER] {
        let f = &Formats::new(&config);
        let size = i64::from(f.max_size);
        for [width, height] in [[1, 1], [7, 3], [64, 48], [size, 2], [3, size]] {
            for (swap, mirror) in [(false, false), (false, true), (true, false), (true, true)] {
                let mut seen = BTreeSet::new();
                for y in 0..height {
                    for x in 0..width {
                        let point = DisplayPoint {
                            x: PixelX::new(x, f),
                            y: Coordinate::new(y, f),
                            swap,
                            mirror,
                        };
                        let place = display(&point, width as u32, f);
                        let place = [place.x.raw(), place.y.raw()];
                        let column = if mirror { width - 1 - x } else { x };
                        let expected = if swap { [y, column] } else { [column, y] };
                        assert_eq!(place, expected, "({x}, {y}) of {width} x {height}");
                        assert!(seen.insert(place));
                    }
                }
                let corner = if swap { [height - 1, width - 1] } else { [width - 1, height - 1] };
                assert_eq!(seen.last(), Some(&corner));
                assert_eq!(seen.len() as i64, width * height);
            }
        }
    }
}

#[test]
fn columns_outside_the_view_lose_their_sign() {
    let f = &Formats::new(&Config::DEFAULT);
    let point = DisplayPoint { x: PixelX::new(-1, f), ..DisplayPoint::default() };
    assert_eq!(display(&point, 640, f).x.raw(), 4095);
    let mirrored = DisplayPoint { mirror: true, ..point };
    assert_eq!(display(&mirrored, 640, f).x.raw(), 640);
}
