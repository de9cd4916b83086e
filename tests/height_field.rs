//! Height fields: counts, normals, shading, viewing transformation, files, and what is said of broken
//! ones.

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

fn write_grey(file: &Path, columns: u32, depth: png::BitDepth, kind: png::ColorType, data: &[u8]) {
    let samples = match kind {
        png::ColorType::Grayscale => 1,
        png::ColorType::GrayscaleAlpha => 2,
        _ => 3,
    };
    let bits = columns * samples * depth as u32;
    let rows = data.len() as u32 / bits.div_ceil(8);
    let mut encoder = png::Encoder::new(fs::File::create(file).unwrap(), columns, rows);
    encoder.set_color(kind);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(data).unwrap();
}

#[test]
fn pictures_and_text_hold_the_same_grid() {
    use png::{BitDepth, ColorType};
    let folder = folder();
    let [text, narrow, wide] = ["a.txt", "b.png", "C.PNG"].map(|name| folder.path().join(name));
    fs::write(&text, "# a comment\n\n0 1\t255 # another\n 3,  4.0, 5e0\r\n").unwrap();
    write_grey(&narrow, 3, BitDepth::Eight, ColorType::Grayscale, &[0, 1, 255, 3, 4, 5]);
    let words = [0u16, 1, 255, 3, 4, 5].map(u16::to_be_bytes).concat();
    write_grey(&wide, 3, BitDepth::Sixteen, ColorType::Grayscale, &words);
    let expected = grid(3, &[0.0, 1.0, 255.0, 3.0, 4.0, 5.0]);
    for file in [&text, &narrow, &wide] {
        assert_eq!(load(file).unwrap(), expected);
        assert_eq!(opened(file, None).unwrap().meshes[0].triangles.len(), 4);
    }
    write_grey(&wide, 2, BitDepth::Sixteen, ColorType::Grayscale, &[0, 0, 0xff, 0xff, 1, 0, 0, 1]);
    assert_eq!(load(&wide).unwrap().heights(), [0.0, 65_535.0, 256.0, 1.0]);
}

#[test]
fn broken_grids_are_refused_by_line_and_column() {
    let wide = format!("{}\n", "1 ".repeat(GRID_LIMIT + 1)).repeat(2);
    let tall = "1 2\n".repeat(GRID_LIMIT + 1);
    let size = "grid: expected 2 to 1024 columns and rows, found";
    let cases: &[(&str, &str)] = &[
        ("1 2\n3 x\n", ":2: column 2: expected a height, a finite number of at most 1e9, found x"),
        ("1 2\n\n# c\nNaN 4\n", ":4: column 1: expected a height, a finite number"),
        ("1 inf\n3 4\n", ":1: column 2: expected a height, a finite number"),
        ("1 2\n3 1e999\n", ":2: column 2: expected a height, a finite number"),
        ("1 2\n3 -2e9\n", "found -2e9"),
        (
            "1,2\n3,\n",
            ":2: column 2: expected a height, a finite number of at most 1e9, found nothing",
        ),
        ("1 2 3\n\n4 5\n", ":3: row 2: expected 3 heights, as in line 1, found 2"),
        ("\n1 2\n3 4\n5 6 7", ":4: row 3: expected 2 heights, as in line 2, found 3"),
        ("", &format!(": {size} 0 x 0")),
        ("# nothing\n", &format!(": {size} 0 x 0")),
        ("1\n2\n3\n", &format!(": {size} 1 x 3")),
        ("1 2 3\n", &format!(": {size} 3 x 1")),
        (&wide, &format!("{size} 1025 x 1")),
        (&tall, &format!("{size} 2 x 1025")),
    ];
    let folder = folder();
    for name in ["grid.txt", "grid.grid"] {
        let file = folder.path().join(name);
        for (text, message) in cases {
            fs::write(&file, text).unwrap();
            let error = opened(&file, None).expect_err(text);
            let shown = text.chars().take(40).collect::<String>();
            assert!(error.contains(message), "{shown:?}: {error}");
            assert!(
                error.starts_with(&*file.to_string_lossy()) && !error.contains('\n'),
                "{error}"
            );
        }
        fs::write(&file, b"1 2\n3 \xff\n").unwrap();
        assert!(opened(&file, None).unwrap_err().contains(":2: file: expected UTF-8 text"));
    }
    let missing = opened(Path::new("/none/grid.txt"), None).unwrap_err();
    assert!(missing.starts_with("/none/grid.txt: cannot be read: "), "{missing}");
}

#[test]
fn broken_pictures_are_refused() {
    use png::{BitDepth, ColorType};
    let folder = folder();
    let file = folder.path().join("grid.png");
    let refused = |message: &str| {
        let error = opened(&file, None).expect_err(message);
        assert!(error.starts_with(&*file.to_string_lossy()) && !error.contains('\n'), "{error}");
        assert!(error.contains(message), "{error}");
    };
    let grey = "file: expected a grey PNG picture of 8 or 16 bits a pixel, found";
    write_grey(&file, 2, BitDepth::Eight, ColorType::Rgb, &[0; 12]);
    refused(&format!("{grey} Rgb of 8 bits a channel"));
    write_grey(&file, 2, BitDepth::Sixteen, ColorType::GrayscaleAlpha, &[0; 16]);
    refused(&format!("{grey} GrayscaleAlpha of 16 bits a channel"));
    write_grey(&file, 8, BitDepth::One, ColorType::Grayscale, &[0; 8]);
    refused(&format!("{grey} Grayscale of 1 bits a channel"));
    write_grey(&file, 1, BitDepth::Eight, ColorType::Grayscale, &[0; 8]);
    refused("grid: expected 2 to 1024 columns and rows, found 1 x 8");
    write_grey(&file, 2, BitDepth::Eight, ColorType::Grayscale, &[0; 2050]);
    refused("found 2 x 1025");
    write_grey(&file, 40, BitDepth::Eight, ColorType::Grayscale, &[7; 1600]);
    let whole = fs::read(&file).unwrap();
    for length in [0, 10, 40, whole.len() / 2] {
        fs::write(&file, &whole[..length]).unwrap();
        refused(grey);
    }
    fs::write(&file, "1 2\n3 4\n").unwrap();
    refused(grey);
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
