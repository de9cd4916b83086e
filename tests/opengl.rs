//! Direct rendering against an OpenGL implementation: coverage and visibility, pixel by pixel.
//!
//! The renderer is Mesa's llvmpipe, off screen, with 8 subpixel bits. It is given the snapped
//! corners, so that what is compared is scan conversion, the top-left rule and the depth test.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use wheatstone_golden::config::Config;
use wheatstone_golden::direct::Direct;
use wheatstone_golden::formats::{Eye, Formats, DEPTH_MAX, FRACTION_BITS};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::random::{Class, Triangles};
use wheatstone_golden::scene;
use wheatstone_golden::setup::{Attributes, Outline, Polygon};
use wheatstone_golden::texture::Lookup;

/// Pixels drawn around the views: OpenGL clips at the edge of its window and so moves the sides of
/// what it has cut, which Wheatstone does not within the guard band.
const MARGIN: u32 = 1024;
/// Depths that count as a tie, in units of the 24-bit depth.
const TIE: i64 = 2;

/// Builds the renderer once for all tests of this file.
fn renderer(folder: &Path) -> std::path::PathBuf {
    let program = folder.join("opengl_ids");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("opengl_ids.c");
    let built = Command::new("cc")
        .args(["-O2", "-Wall", "-Werror", "-o"])
        .args([&program, &source])
        .arg("-lOSMesa")
        .status();
    let built = built.expect("cc is missing: apt-get install gcc");
    assert!(built.success(), "OSMesa is missing: apt-get install libosmesa6-dev");
    program
}

/// Indices of the triangles that OpenGL shows; [`NO_ID`] for the background.
fn opengl(program: &Path, size: [u32; 2], triangles: &[[[f64; 3]; 3]]) -> Vec<u32> {
    let input: Vec<u8> =
        triangles.iter().flatten().flatten().flat_map(|&n| (n as f32).to_le_bytes()).collect();
    let mut child = Command::new(program)
        .args(size.map(|n| n.to_string()))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the renderer starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    let writer = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().expect("the renderer ends");
    writer.join().expect("no panic").expect("all of the input is read");
    assert!(output.status.success());
    let words = output.stdout.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    words.map(|id| id.wrapping_sub(1)).collect()
}

/// Compares what each eye sees; returns pixels compared and ties. Ids are positions in `polygons`.
fn compare(program: &Path, polygons: &[Polygon], size: [u32; 2], formats: Formats) -> [usize; 2] {
    let polygons: Vec<Polygon> =
        (0..).zip(polygons).map(|(id, p)| Polygon { id, ..p.clone() }).collect();
    let mut counts = [0, 0];
    for eye in Eye::BOTH {
        let direct = Direct { formats, textures: &[], lookup: Lookup::Nearest };
        let mut frame = Frame::new(size[0], size[1], [0; 3]);
        let (mut triangles, mut owner) = (Vec::new(), Vec::new());
        for polygon in &polygons {
            direct.draw(polygon, eye, &mut frame);
            if !polygon.eyes.contains(eye) {
                continue;
            }
            let corner = |n: usize| {
                let v = polygon.vertices[n];
                let one = formats.one_pixel() as f64;
                let [x, y] = [v.x, v.y].map(|c| f64::from(c[eye as usize]) / one);
                let margin = f64::from(MARGIN);
                [x + margin, y + margin, f64::from(v.depth) / f64::from(DEPTH_MAX)]
            };
            for k in 1..polygon.vertices.len() - 1 {
                triangles.push([corner(0), corner(k), corner(k + 1)]);
                owner.push(polygon.id);
            }
        }
        let wide = size.map(|n| n + 2 * MARGIN);
        let seen = opengl(program, wide, &triangles);
        let depth = |id: u32, x: i64, y: i64| {
            let polygon = &polygons[id as usize];
            assert_ne!(Outline::new(polygon, eye).doubled_area(), 0);
            let z = Attributes::new(polygon, eye, &formats).depth.at(x, y) >> FRACTION_BITS;
            z.clamp(0, DEPTH_MAX.into())
        };
        for (n, &ours) in frame.id.iter().enumerate() {
            counts[0] += 1;
            let [x, y] = [n as u32 % size[0], n as u32 / size[0]];
            let theirs = seen[((y + MARGIN) * wide[0] + x + MARGIN) as usize];
            let theirs = owner.get(theirs as usize).copied().unwrap_or(NO_ID);
            if theirs == ours {
                continue;
            }
            let (x, y) = (x.into(), y.into());
            let place = format!("{} eye, ({x}, {y}): OpenGL {theirs}, direct {ours}", eye.name());
            assert!(theirs != NO_ID && ours != NO_ID, "coverage differs: {place}");
            let apart = (depth(theirs, x, y) - depth(ours, x, y)).abs();
            assert!(apart <= TIE, "{place}, depths {apart} apart");
            counts[1] += 1;
        }
    }
    counts
}

#[test]
fn scenes_look_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = renderer(folder.path());
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
        let [pixels, ties] = compare(&program, &geometry.polygons, [640, 480], formats);
        println!("{}: {pixels} pixels, {ties} ties", builtin.name);
        assert!(ties * 20 <= pixels, "{}: {ties} ties", builtin.name);
    }
}

#[test]
fn random_triangles_look_the_same() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let program = renderer(folder.path());
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
        let [pixels, ties] = compare(&program, &polygons, size, formats);
        println!("{}: {pixels} pixels, {ties} ties", class.name());
        assert_eq!(ties, 0, "{class:?}");
    }
}
