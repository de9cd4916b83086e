//! Storage of two views for displays and print: frame-sequential and field-sequential, pairs,
//! triplets, and their size on paper.

use std::fs;
use std::path::Path;
use wheatstone_golden::picture::{print_resolution, write_png_at, Composite, Rgb, RgbImage, Views};
use wheatstone_tests::folder;

const WIDTH: u32 = 34;
const HEIGHT: u32 = 25;

fn noise(seed: u64) -> RgbImage {
    let mut random = fastrand::Rng::with_seed(seed);
    RgbImage::from_fn(WIDTH, HEIGHT, |_, _| Rgb([random.u8(..), random.u8(..), random.u8(..)]))
}

/// A composite of two different views, as it comes back from its file, and the views.
fn stored(name: &str) -> (RgbImage, [RgbImage; 2]) {
    let folder = folder();
    let file = folder.path().join("picture.png");
    let [left, right] = [1, 2].map(noise);
    let composite = Composite::named(name).unwrap_or_else(|| panic!("{name}"));
    composite.write(&file, &Views { left: &left, right: &right }, None).expect("written");
    (image::open(&file).expect("a picture").into_rgb8(), [left, right])
}

/// Checks where every pixel of a composite comes from: eye, column, row.
fn check(name: &str, size: [u32; 2], from: impl Fn(u32, u32) -> (usize, u32, u32)) {
    let (picture, views) = stored(name);
    assert_eq!(picture.dimensions(), size.into(), "{name}");
    for (x, y, pixel) in picture.enumerate_pixels() {
        let (eye, column, row) = from(x, y);
        assert_eq!(pixel, views[eye].get_pixel(column, row), "{name} {x} {y}");
    }
}

#[test]
fn every_pixel_is_where_the_storage_has_it() {
    let [w, h] = [WIDTH, HEIGHT];
    // Rows of one frame, then rows of the other: in memory one frame after the other.
    check("frame-sequential", [w, 2 * h], |x, y| ((y / h) as usize, x, y % h));
    check("field-sequential", [w, h], |x, y| ((y % 2) as usize, x, y));
    check("interleaved", [w, h], |x, y| ((y % 2) as usize, x, y));
    check("parallel", [2 * w, h], |x, y| ((x / w) as usize, x % w, y));
    check("crossed", [2 * w, h], |x, y| (1 - (x / w) as usize, x % w, y));
    check("triplet", [3 * w, h], |x, y| ((x / w % 2) as usize, x % w, y));
    let (frames, [left, right]) = stored("frame-sequential");
    assert_eq!(*frames.as_raw(), [left.into_raw(), right.into_raw()].concat());
}

/// Dots per metre that a PNG file claims.
fn dots(file: &Path) -> Option<[u32; 2]> {
    let reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(file).unwrap()));
    let info = reader.read_info().expect("a PNG file");
    let dimensions = info.info().pixel_dims?;
    assert_eq!(dimensions.unit, png::Unit::Meter);
    Some([dimensions.xppu, dimensions.yppu])
}

#[test]
fn print_has_its_size() {
    let folder = folder();
    let file = folder.path().join("picture.png");
    write_png_at(&file, &noise(1), None).expect("written");
    assert_eq!(dots(&file), None);
    write_png_at(&file, &noise(1), Some(300.0)).expect("written");
    assert_eq!(dots(&file), Some([11_811; 2]));
    let [left, right] = [1, 2].map(noise);
    let views = Views { left: &left, right: &right };
    for composite in Composite::ALL.into_iter().filter(|c| *c != Composite::Wiggle) {
        composite.write(&file, &views, Some(100.0)).expect("written");
        assert_eq!(dots(&file), Some([3937; 2]), "{}", composite.name());
    }
}

#[test]
fn points_at_infinity_are_as_far_apart_as_the_eyes() {
    // A view 640 dots wide of the height field's rig: eyes 2.5 inches, 119 dots, apart.
    let eyes = 2.5;
    let far = eyes / 0.021;
    let resolution = print_resolution(640, far, eyes);
    // A point at infinity has the same place in the left view as one far/2 to the left in the
    // middle, in the right view it is as much to the right.
    let [left, right] = [320.0 - far / 2.0, 640.0 + 320.0 + far / 2.0];
    assert!(((right - left) / resolution - eyes).abs() < 1e-12);
    assert!((resolution - 303.6).abs() < 0.05, "{resolution}");
    // A point of the screen plane is nearer.
    assert!(640.0 / resolution < eyes);
}
