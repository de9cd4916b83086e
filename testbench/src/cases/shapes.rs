//! Polygons of directed cases.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::*;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::setup::{Arrangement, Eyes, Options, Polygon, Vertex};

/// Gives each polygon another depth, nearer than those before it: where they are in one place, all are seen.
pub(super) fn at_depths(first: u32, polygons: impl IntoIterator<Item = Polygon>) -> Vec<Polygon> {
    let nearer = |(n, mut polygon): (u32, Polygon)| {
        polygon.vertices.iter_mut().for_each(|vertex| vertex.depth = first - 1_000 * n);
        Polygon { id: n, ..polygon }
    };
    (0..).zip(polygons).map(nearer).collect()
}

/// `times` each: polygons derived for either eye, one with more edges than the primary pipeline has, for one eye
/// (the minimal system has none to lend), and a triangle for the other. Each draws pixels in some rows, in
/// one part, so that every second one is spoilt.
pub(super) fn spoilable(minimal: bool, times: usize, f: &Formats) -> Vec<Polygon> {
    const TRIANGLE: &[[i32; 2]] = &[[2, 1], [9, 1], [2, 8]];
    const HEXAGON: &[[i32; 2]] = &[[4, 1], [8, 1], [10, 4], [8, 7], [4, 7], [2, 4]];
    let polygon = |corners: &[[i32; 2]], eyes, wider: Option<Eye>| {
        let vertex = |(n, &[x, y]): (u8, &[i32; 2])| {
            let mut xs = [x << f.subpixel_bits; 2];
            if let Some(eye) = wider {
                xs[eye as usize] += (x - 2) << (f.subpixel_bits - 1);
            }
            let colour = [Rgba([40 * n, 200, 90, 255]); 2];
            Vertex { x: xs, y: [y << f.subpixel_bits; 2], colour, ..Vertex::default() }
        };
        Polygon { vertices: (0..).zip(corners).map(vertex).collect(), eyes, ..Polygon::default() }
    };
    let many = if minimal { TRIANGLE } else { HEXAGON };
    let kinds = [
        polygon(TRIANGLE, Eyes::Both, Some(Eye::Left)),
        polygon(TRIANGLE, Eyes::Both, Some(Eye::Right)),
        polygon(many, Eyes::One(Eye::Left), None),
        polygon(TRIANGLE, Eyes::One(Eye::Right), None),
    ];
    kinds.into_iter().flat_map(|kind| vec![kind; times]).collect()
}

/// Arrangements in which a view's columns and rows run either way, along either side of the display.
pub(super) const PLACES: [(&str, Arrangement); 3] = [
    ("", Arrangement::Normal),
    (", flipped", Arrangement::Flipped),
    (", rotated", Arrangement::Rotated),
];

/// A view that is as wide or as high as it can be, with small polygons all over it.
pub(super) struct Large {
    /// Name of the shape.
    pub name: String,
    /// Width and height.
    pub size: [u32; 2],
    /// Polygons are derived, though that saves nothing.
    pub options: Options,
    /// The polygons.
    pub polygons: Vec<Polygon>,
}

/// Large views, so that every bit of width and height is 0 in one and 1 in another.
pub(super) fn largest(config: &Config) -> Vec<Large> {
    let f = Formats::new(config);
    let sizes = [[f.max_size, 12], [f.max_size - 1, 19]].into_iter();
    let sizes = sizes.flat_map(|[a, b]| [[a, b], [b, a]]);
    let of = |(size, (place, arrangement)): ([u32; 2], (&str, Arrangement))| {
        let mut triangles = Triangles::new(8, f, size[0], size[1]);
        Large {
            name: format!("a view of {} × {}{place}", size[0], size[1]),
            size,
            options: Options { arrangement, cost_rule: false, ..Options::new(config) },
            polygons: (0..200).map(|id| Polygon { id, ..triangles.triangle(Class::Px2) }).collect(),
        }
    };
    sizes.flat_map(|size| PLACES.map(|place| (size, place))).map(of).collect()
}

/// Polygons of every mode and, where a secondary is derived, every class of the mapping ratio with every triple
/// of edge signs.
pub(super) fn kinds(f: &Formats) -> Vec<Polygon> {
    let mut polygons = Vec::new();
    for eye in Eye::BOTH {
        for stretch in [1.0, 1.6, 5.0, 20.0] {
            for heights in HEIGHTS {
                let both = [false, true].map(|turn| stretched(eye, stretch, heights, turn, f));
                polygons.extend(both);
            }
        }
        let alone = stretched(eye, 1.6, HEIGHTS[0], false, f);
        polygons.push(Polygon { eyes: Eyes::One(eye), ..alone });
    }
    for (id, polygon) in (0..).zip(&mut polygons) {
        polygon.id = id;
    }
    polygons
}

/// Heights of three corners in half pixels: in every order, two of them equal or none.
pub(super) const HEIGHTS: [[i32; 3]; 12] = [
    [0, 2, 4],
    [0, 4, 2],
    [2, 0, 4],
    [2, 4, 0],
    [4, 0, 2],
    [4, 2, 0],
    [0, 3, 3],
    [3, 0, 3],
    [3, 3, 0],
    [3, 0, 0],
    [0, 3, 0],
    [0, 0, 3],
];

/// A triangle with corners at these heights, in either winding, whose pixels `eye` sees stretched by a
/// factor.
pub(super) fn stretched(
    eye: Eye,
    stretch: f64,
    heights: [i32; 3],
    turn: bool,
    f: &Formats,
) -> Polygon {
    let pixel = 1 << f.subpixel_bits;
    // With ratio 1 the left eye is primary unless its view is narrower, by so little that it is still 1.
    let narrower = stretch == 1.0 && eye == Eye::Right;
    let (width, less) = if narrower { (160, 1) } else { (3, 0) };
    // The third corner is above or below one of the others.
    let far = [false, true, heights[2] == heights[0]];
    let vertices = (0..3).map(|n| {
        let across = if far[n] != turn { width * pixel } else { 0 };
        let mut x = [2 * pixel + if across > 0 { across - less } else { 0 }; 2];
        x[eye as usize] = 2 * pixel + (f64::from(across) * stretch) as i32;
        let colour = [Rgba([40 * n as u8, 200, 90, 255]); 2];
        let y = [pixel + heights[n] * pixel / 2; 2];
        Vertex { x, y, depth: 1000, colour, ..Vertex::default() }
    });
    Polygon { vertices: vertices.collect(), ..Polygon::default() }
}

/// A polygon within the rows of the left eye's view that the right eye sees six pixels higher or
/// lower.
pub(super) fn raised(polygon: &Polygon, f: Formats, height: u32) -> Polygon {
    let mut polygon = polygon.clone();
    let (bottom, shift) = (i64::from(height) * f.one_pixel(), 6 * f.one_pixel());
    let shift = if polygon.id.is_multiple_of(2) { shift } else { -shift };
    for vertex in &mut polygon.vertices {
        let y = i64::from(vertex.y[0]).clamp(0, bottom);
        vertex.y = [y, y + shift].map(|y| y as i32);
    }
    polygon
}
