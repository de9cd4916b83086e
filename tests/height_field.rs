//! Height fields: counts, normals, shading, viewing transformation, and what rig files do to them.

use fastrand::Rng;
use std::fs;
use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::scene::height_field::*;
use wheatstone_golden::scene::place::{Placement, Viewpoint};
use wheatstone_golden::scene::vector::{cross, dot, outward, sub, unit, Vec3};
use wheatstone_golden::scene::{open, Camera, Colours, Lighting, Scene};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_tests::folder;

fn grid(columns: usize, heights: &[f64]) -> HeightGrid {
    HeightGrid::new(columns, heights.to_vec()).expect("a legal grid")
}

fn random_grid(columns: usize, rows: usize, rng: &mut Rng) -> HeightGrid {
    let heights: Vec<f64> = (0..columns * rows).map(|_| rng.f64() * 4.0 - 2.0).collect();
    grid(columns, &heights)
}

#[test]
fn a_grid_of_200_squared_has_79_202_triangles() {
    let atoms = atoms();
    assert_eq!(atoms.size(), [200, 200]);
    let mesh = atoms.mesh();
    assert_eq!((mesh.positions.len(), mesh.triangles.len()), (40_000, 79_202));
    assert_eq!(atoms.normals().count(), 79_202);
    let scene = open("atoms", None, None).unwrap();
    assert_eq!(scene.meshes[0].triangles.len(), 79_202);
    // 2.5 inches and 18 inches in dots of 0.021 inches.
    let rig = physical_rig(640, 480);
    let dots = [rig.eye_separation, rig.viewing_distance].map(|n| n * rig.pixels_per_unit);
    assert_eq!(dots.map(f64::round), [119.0, 857.0]);
}

#[test]
fn normals_are_those_of_the_triangles() {
    let mut rng = Rng::with_seed(1);
    for _ in 0..1000 {
        let dx = rng.f64() + 0.1;
        let [z, a, b, c] = [(); 4].map(|()| rng.f64() * 3.0 - 1.5);
        // Rows go down: y falls from a row to the next.
        let corners = [[0.0, -dx, a], [dx, -dx, b], [dx, 0.0, c]];
        let by_products = [cross(corners[0], corners[1]), cross(corners[1], corners[2])];
        for (normal, product) in
            normals(dx, dx * dx, [z, z + a, z + b, z + c]).into_iter().zip(by_products)
        {
            assert!(sub(normal, product).iter().all(|n| n.abs() < 1e-12), "{normal:?} {product:?}");
        }
    }
    let field = random_grid(9, 6, &mut rng);
    let mesh = field.mesh();
    assert_eq!(field.normals().count(), mesh.triangles.len());
    for (normal, triangle) in field.normals().zip(&mesh.triangles) {
        let [a, b, c] = triangle.map(|n| mesh.positions[n as usize]);
        let expected = unit(outward(a, b, c));
        assert!(dot(normal, expected) > 1.0 - 1e-12, "{normal:?} {expected:?}");
        assert!(normal[2] < 0.0, "heights point to the viewer");
    }
}

fn frontal() -> Placement {
    let view = Some(Viewpoint { eye: [0.0, 0.0, 1.0], up: [0.0, 1.0, 0.0] });
    Placement { view, relief: None, ..Placement::default() }
}

#[test]
fn shade_is_the_clamped_cosine_to_the_light() {
    let shade = |grid: &HeightGrid, direction: Vec3| {
        let mut empty = empty_scene(640, 480);
        let Some(Lighting { lights, .. }) = &mut empty.lighting else { panic!("a light") };
        lights[0].source = wheatstone_golden::scene::Source::Direction(direction);
        let scene = scene(grid, empty, &frontal());
        let Colours::Face(colours) = &scene.meshes[0].colours else { panic!("flat") };
        colours.clone()
    };
    let flat = grid(3, &[1.0; 9]);
    assert_eq!(shade(&flat, [0.0, 0.0, -5.0]), [[255; 3]; 8]);
    assert_eq!(shade(&flat, [0.0, 3.0, -4.0]), [[204; 3]; 8]);
    assert_eq!(shade(&flat, [0.0, 3.0, 4.0]), [[0; 3]; 8], "from behind");
    // Rising by 3/4 to the right it faces left: cosine 0.8 to the viewer, 0.6 to the left.
    let slope = grid(3, &[0.0, 0.75, 1.5, 0.0, 0.75, 1.5]);
    assert_eq!(shade(&slope, [0.0, 0.0, -1.0]), [[204; 3]; 4]);
    assert_eq!(shade(&slope, [-1.0, 0.0, 0.0]), [[153; 3]; 4]);
    assert_eq!(shade(&slope, [1.0, 0.0, 0.0]), [[0; 3]; 4]);
    // Rising downward it faces up.
    let rising = grid(2, &[0.0, 0.0, 0.75, 0.75]);
    assert_eq!(shade(&rising, [0.0, 1.0, 0.0]), [[153; 3]; 2]);
}

/// The viewing transformation by angles, as Listing Two has it: about y, then x, then z.
fn by_rotations(view: &Viewpoint, p: Vec3) -> Vec3 {
    let turn_y = |[x, y, z]: Vec3, [c, s]: [f64; 2]| [c * x + s * z, y, -s * x + c * z];
    let turn_x = |[x, y, z]: Vec3, [c, s]: [f64; 2]| [x, c * y - s * z, s * y + c * z];
    let turn_z = |[x, y, z]: Vec3, [c, s]: [f64; 2]| [c * x - s * y, s * x + c * y, z];
    let sight = view.eye.map(|n| -n);
    let flat = (sight[0] * sight[0] + sight[2] * sight[2]).sqrt();
    let about_y = [-sight[2] / flat, sight[0] / flat];
    let length = dot(sight, sight).sqrt();
    let turned = turn_y(sight, about_y);
    let about_x = [-turned[2] / length, -turned[1] / length];
    let up = turn_x(turn_y(view.up, about_y), about_x);
    let height = (up[0] * up[0] + up[1] * up[1]).sqrt();
    let about_z = [up[1] / height, up[0] / height];
    turn_z(turn_x(turn_y(p, about_y), about_x), about_z)
}

#[test]
fn the_view_is_that_of_the_listing_and_defined_on_the_y_axis() {
    let mut rng = Rng::with_seed(2);
    let mut random = || [(); 3].map(|()| rng.f64() * 2.0 - 1.0);
    for _ in 0..1000 {
        let (view, p) = (Viewpoint { eye: random(), up: random() }, random());
        let axes = view.axes().expect("in general position");
        let seen = axes.map(|axis| dot(axis, p));
        let expected = by_rotations(&view, p);
        assert!(
            sub(seen, expected).iter().all(|n| n.abs() < 1e-9),
            "{view:?}: {seen:?} {expected:?}"
        );
    }
    // Where the listing divides nought by nought.
    for y in [-3.0, 1e-9, 2.0] {
        let view = Viewpoint { eye: [0.0, y, 0.0], up: [0.0, 0.0, 1.0] };
        assert!(by_rotations(&view, [1.0, 2.0, 3.0]).iter().all(|n| n.is_nan()));
        let axes = view.axes().expect("defined");
        assert_eq!(axes, [[-y.signum(), 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, y.signum(), 0.0]]);
    }
    let along = |eye, up| Viewpoint { eye, up }.axes();
    assert_eq!(along([0.0, 2.0, 0.0], [0.0, -1.0, 0.0]), None);
    assert_eq!(along([0.0; 3], [0.0, 1.0, 0.0]), None);
    assert_eq!(along([1.0, 2.0, 3.0], [2.0, 4.0, 6.0]), None);
}

fn opened(file: &Path, rig: Option<&Path>) -> Result<Scene, String> {
    open(&file.display().to_string(), None, rig).map_err(|e| e.to_string())
}

#[test]
fn rig_files_place_fields() {
    let folder = folder();
    let [file, rig] = ["grid.txt", "rig.json"].map(|name| folder.path().join(name));
    fs::write(&file, "0 0 0 0 0\n0 0 9 0 0\n0 0 0 0 0\n").unwrap();
    let placed = |text: &str| {
        fs::write(&rig, text).unwrap();
        opened(&file, Some(&rig)).map(|scene| {
            let p = &scene.meshes[0].positions;
            let extent = |k: usize| {
                let values = || p.iter().map(|p| p[k]);
                values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
            };
            [0, 1, 2].map(extent)
        })
    };
    let near = |found: Vec3, expected: Vec3| {
        assert!(sub(found, expected).iter().all(|n| n.abs() < 1e-9), "{found:?} {expected:?}");
    };
    let above = r#""view": {"eye": [0, 0, 5], "up": [0, 1, 0]}"#;
    // The screen is 480 dots of 0.021 inches high; the field 4 units wide and 2 high.
    let side = 480.0 * DOT_PITCH;
    let found = placed(&format!(r#"{{"placement": {{{above}, "fit": 0.5, "relief": 0.25}}}}"#));
    near(found.unwrap(), [side / 2.0, side / 4.0, side / 8.0]);
    let found = placed(&format!(r#"{{"placement": {{{above}}}}}"#)).unwrap();
    near(found, [1.15 * side, 0.575 * side, 0.115 * side]);
    let found = placed(&format!(r#"{{"placement": {{{above}, "fit": null, "relief": null}}}}"#));
    near(found.unwrap(), [4.0, 2.0, 9.0]);
    let turned = format!(r#"{{"placement": {{{above}, "fit": null, "rotation": [0, 0, 90]}}}}"#);
    near(placed(&turned).unwrap(), [2.0, 4.0, 0.4]);
    // From an eye on the y axis: nothing special.
    let level = r#"{"placement": {"view": {"eye": [0, -3, 0], "up": [0, 0, 1]}, "fit": null}}"#;
    near(placed(level).unwrap(), [4.0, 0.4, 2.0]);
    let refused = |placement: &str, message: &str| {
        let error = placed(&format!("{{\n\"placement\": {{\n{placement}}}}}")).unwrap_err();
        assert!(error.contains("rig.json:3: ") && error.contains(message), "{error}");
    };
    let view = |eye: &str, up: &str| format!(r#""view": {{"eye": {eye}, "up": {up}}}"#);
    refused(&view("[0, 3, 0]", "[0, 1, 0]"), "placement.view.up: expected a direction across");
    refused(&view("[0, 3, 0]", "[0, 0, 0]"), "placement.view.up: expected a direction across");
    refused(&view("[0, 0, 0]", "[0, 1, 0]"), "placement.view.eye: expected a point other than");
    refused(&view("[0, 0, 1e10]", "[0, 1, 0]"), "placement.view.eye: expected three numbers");
    refused(r#""view": {"eye": [0, 0, 1]}"#, "placement.view.up: expected a value");
    refused(r#""relief": -1"#, "placement.relief: expected 0 to 1000 or null, found -1");
    refused(r#""relief": "high""#, "placement.relief");
}

#[test]
fn a_rig_file_lights_a_field() {
    let folder = folder();
    let [file, rig] = ["grid.txt", "rig.json"].map(|name| folder.path().join(name));
    fs::write(&file, "0 0\n0 0\n").unwrap();
    let view = r#""placement": {"view": {"eye": [0, 0, 1], "up": [0, 1, 0]}}"#;
    let light =
        r#""light": {"direction": [0, 3, -4], "colour": [1, 0.5, 0], "ambient": [0, 0.1, 0.2]}"#;
    fs::write(&rig, format!("{{{view}, {light}}}")).unwrap();
    let scene = opened(&file, Some(&rig)).unwrap();
    assert_eq!(scene.meshes[0].colours, Colours::Face(vec![[204, 128, 51]; 2]));
}

#[test]
fn screen_positions_follow_the_clean_formulas() {
    // Viewing coordinates: eyes at (∓e/2, 0, 0) looking down -z, screen at z = -D.
    let scene = open("atoms", None, None).unwrap();
    let camera =
        Camera::new(&scene.rig, scene.width, scene.height, &Formats::new(&Config::DEFAULT));
    let (e, d, ppu) =
        (scene.rig.eye_separation, scene.rig.viewing_distance, scene.rig.pixels_per_unit);
    for p in scene.meshes[0].positions.iter().step_by(17) {
        let (x, y, z) = (p[0], p[1], -d - p[2]);
        for (eye, s) in [(Eye::Left, -e / 2.0), (Eye::Right, e / 2.0)] {
            let [across, up] = [s + (x - s) * d / -z, y * d / -z];
            let [column, row] = camera.pixel(*p, eye);
            assert!((column - 320.0 - ppu * across).abs() < 1e-9);
            assert!((row - 240.0 + ppu * up).abs() < 1e-9);
        }
        let parallax = camera.pixel(*p, Eye::Right)[0] - camera.pixel(*p, Eye::Left)[0];
        assert!((parallax - ppu * e * (1.0 - d / -z)).abs() < 1e-9);
    }
}

#[test]
fn the_atoms_are_drawn_as_directly() {
    let scene = open("atoms", Some([320, 240]), None).unwrap();
    let config = Config::DEFAULT;
    let geometry = scene.geometry(&Formats::new(&config), &Default::default()).unwrap();
    let job = Job::of(&geometry, config, Options::new(&config), Lookup::Nearest);
    let direct = job.direct();
    let covered = direct[0].id.iter().filter(|&&id| id != u32::MAX).count();
    assert!(covered > 20_000, "{covered}");
    assert!(job.derived(false).0.eyes == direct);
}
