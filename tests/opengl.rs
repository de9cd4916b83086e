//! Direct rendering against an OpenGL implementation: coverage and visibility, pixel by pixel.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::scene;
use wheatstone_golden::setup::Polygon;
use wheatstone_studies::opengl::{self, Renderer};

fn renderer() -> Renderer {
    Renderer::build().unwrap_or_else(|error| panic!("{error}"))
}

/// Compares what each eye sees; returns pixels compared and ties.
fn compare(
    renderer: &Renderer,
    polygons: &[Polygon],
    size: [u32; 2],
    formats: Formats,
) -> [usize; 2] {
    let compared = opengl::compare_views(renderer, polygons, size, &formats, 1);
    let found = compared.unwrap_or_else(|error| panic!("{error}")).differences;
    assert_eq!(found.wrong, 0, "{}", found.first.unwrap_or_default());
    [found.pixels, found.ties]
}

#[test]
fn scenes_look_the_same() {
    let renderer = renderer();
    let formats = Formats::new(&Config::DEFAULT);
    for builtin in &scene::builtin::SCENES {
        let scene = scene::open(builtin.name, Some([640, 480]), None).expect("a built-in scene");
        let mut geometry =
            scene.geometry(&formats, &scene::Options::default()).expect("it is sound");
        // Everything opaque: ids, not colours, are compared.
        let opaque = |v: &mut wheatstone_golden::setup::Vertex| {
            v.colour.iter_mut().for_each(|c| c.0[3] = 255)
        };
        geometry.polygons.iter_mut().for_each(|p| p.vertices.iter_mut().for_each(opaque));
        // Polygons of more than three corners have a depth plane of their own: OpenGL's fans do not.
        geometry.polygons.retain(|p| p.vertices.len() == 3);
        let [pixels, ties] = compare(&renderer, &geometry.polygons, [640, 480], formats);
        println!("{}: {pixels} pixels, {ties} ties", builtin.name);
        assert!(ties * 20 <= pixels, "{}: {ties} ties", builtin.name);
    }
}

#[test]
fn random_triangles_look_the_same() {
    let renderer = renderer();
    let formats = Formats::new(&Config::DEFAULT);
    let size = [320, 240];
    for class in Class::ALL {
        let mut triangles = Triangles::new(class as u64, formats, size[0], size[1]);
        // Each at one depth: on slivers OpenGL's single-precision depths are off by far more than a
        // tie, and coverage is what is asked here.
        let mut triangle = || {
            let mut polygon = triangles.triangle(class);
            let depth = polygon.vertices[0].depth;
            polygon.vertices.iter_mut().for_each(|v| v.depth = depth);
            polygon
        };
        let polygons: Vec<Polygon> = (0..1500).map(|_| triangle()).collect();
        let [pixels, ties] = compare(&renderer, &polygons, size, formats);
        println!("{}: {pixels} pixels, {ties} ties", class.name());
        assert_eq!(ties, 0, "{class:?}");
    }
}
