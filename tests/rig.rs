//! Figures of `wheatstone rig` against triangulation, publications and points of the scene.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::projection::{
    Asymptotic, Device, Kind, Partition, Piecewise, Projection, Viewer,
};
use wheatstone_golden::scene::{builtin, open_projected, Camera, Rig, Scene};
use wheatstone_studies::volume::{Field, Place, Volume};
use wheatstone_tests::folder;

const SIZE: [u32; 2] = [640, 480];

fn part([near, far]: [f64; 2], [min_distance, max_distance]: [f64; 2]) -> Partition {
    Partition { near, far, min_distance, max_distance }
}

fn piecewise(partitions: Vec<Partition>) -> Projection {
    Projection::Piecewise(Piecewise { partitions, ..Piecewise::default() })
}

fn scene(rig: Rig) -> Scene {
    rig.check().expect("a legal rig");
    let room = open_projected("room", Some(SIZE), None, None).expect("built in");
    Scene { rig, ..room }
}

fn volume(rig: Rig) -> Volume {
    Volume::of(&scene(rig), None).expect("a legal scene")
}

/// NASA's screen: 40 degrees at 19 inches, eyes 2.5 inches apart.
fn nasa(projection: Projection, viewing_distance: f64) -> Rig {
    let width = 2.0 * 19.0 * 20f64.to_radians().tan();
    Rig {
        pixels_per_unit: 640.0 / width,
        eye_separation: 2.5,
        viewing_distance,
        projection,
        ..Rig::default()
    }
}

fn asymptotic() -> Rig {
    let parameters = Asymptotic {
        screen_intercept: Some(150.0),
        screen_distance: Some(19.0),
        max_distance: Some(43.0),
        min_distance: Some(14.0),
        eye_distance: Some(2.5),
    };
    nasa(Projection::Asymptotic(parameters), 150.0)
}

fn field(fields: &[Field], what: &str) -> [f64; 4] {
    let found = fields.iter().find(|f| f.what.split("; ").any(|part| part == what));
    let seen = found.unwrap_or_else(|| panic!("{what}: {fields:?}")).seen;
    [seen.left, seen.stereo, seen.right, seen.total()]
}

#[test]
fn fields_of_view_are_nasas() {
    for (kind, rows) in [
        // NASA 1992, table I, with the digits of its own geometry: docs/errata.md.
        (
            Kind::Symmetric,
            [[30.8, 0.0, 30.8, 61.6], [6.9, 26.2, 6.9, 40.0], [0.0, 33.2, 0.0, 33.2]],
        ),
        (
            Kind::TwoCentres,
            [[36.1, 0.0, 36.1, 72.1], [0.0, 40.0, 0.0, 40.0], [6.65, 33.2, 6.65, 46.5]],
        ),
    ] {
        let fields = volume(nasa(kind.into(), 19.0)).fields();
        for (what, row) in ["nearest for both eyes", "screen", "infinity"].into_iter().zip(rows) {
            for (here, printed) in field(&fields, what).into_iter().zip(row) {
                assert!((here - printed).abs() < 0.051, "{kind:?} {what}: {here} {printed}");
            }
        }
        assert!(fields.windows(2).all(|pair| pair[0].perceived < pair[1].perceived));
    }
}

#[test]
fn a_partition_has_its_own_fields_of_view() {
    let fields = volume(Rig { projection: Kind::Piecewise.into(), ..Rig::default() }).fields();
    let names = ["partition 1, near", "partition 2", "partition 3, far", "partition 4"];
    for (name, perceived) in names.into_iter().zip([45.0, 60.0, 90.0, 90.0]) {
        let [left, stereo, right, total] = field(&fields, name);
        // Rays from the eyes at ∓3.25 past the edges of a screen 32 wide and 60 away.
        let tangent = |eye: f64, edge: f64| (eye + (edge - eye) * perceived / 60.0) / perceived;
        let degrees = |t: f64| t.atan().to_degrees();
        let ends = [-3.25, 3.25].map(|eye| [-16.0, 16.0].map(|edge| degrees(tangent(eye, edge))));
        let [first, last] =
            [0, 1].map(|k| (ends[0][k].min(ends[1][k]), ends[0][k].max(ends[1][k])));
        let expected = [first.1 - first.0, last.0 - first.1, last.1 - last.0, last.1 - first.0];
        for (here, expected) in [left, stereo, right, total].into_iter().zip(expected) {
            assert!((here - expected).abs() < 1e-9, "{name}: {here} {expected}");
        }
    }
}

#[test]
fn the_chain_is_duvanenkos() {
    let folder = folder();
    let file = folder.path().join("rig.json");
    let text = r#"{"projection": "translate", "pixels_per_unit": 4,
        "translate": {"eye_distance": 2.5, "viewing_distance": 18, "dot_pitch": 0.021}}"#;
    std::fs::write(&file, text).expect("written");
    let scene = open_projected("teapot", Some(SIZE), Some(&file), None).expect("well-formed");
    let lengths = Volume::of(&scene, Some(Device::LEX_90)).expect("legal").lengths();
    let row = |what: &str| *lengths.iter().find(|l| l.what == what).expect("a length");
    let [eyes, screen] = ["between the eyes", "eyes to screen"].map(row);
    assert_eq!([eyes.dots.round(), screen.dots.round()], [119.0, 857.0]);
    for (length, inches) in [(eyes, 2.5), (screen, 18.0), (row("dot pitch"), 0.021)] {
        assert!((length.display.expect("a display") - inches).abs() < 1e-12);
        assert!((length.units - inches / 0.021 / 4.0).abs() < 1e-9);
    }
    // No other projection follows from the display.
    let other = Scene { rig: Rig::default(), ..scene };
    assert_eq!(Volume::of(&other, Some(Device::LEX_90)).expect("legal").lengths()[0].display, None);
}

/// Distance at which the viewer's lines of sight through a point's two images meet, and that between the images, in
/// pixels.
fn triangulated(rig: &Rig, distance: f64) -> [f64; 2] {
    let camera = Camera::new(rig, SIZE[0], SIZE[1], &Formats::new(&Config::DEFAULT));
    let p = [0.0, 0.0, distance - rig.viewing_distance];
    let [left, right] = Eye::BOTH.map(|eye| camera.pixel(p, eye)[0]);
    let Viewer { eye_distance, screen_distance } = rig.viewer();
    let apart = (right - left) / rig.pixels_per_unit;
    [screen_distance * eye_distance / (eye_distance - apart), right - left]
}

#[test]
fn the_map_is_what_the_eyes_triangulate() {
    let rigs = Kind::ALL.map(|kind| Rig { projection: kind.into(), ..Rig::default() });
    let gaps = vec![part([40.0, 55.0], [50.0, 60.0]), part([70.0, 200.0], [60.0, f64::INFINITY])];
    let apart = Rig { projection: piecewise(gaps), ..Rig::default() };
    for rig in rigs.into_iter().chain([asymptotic(), apart]) {
        let asked = [45.0, 61.5, 100.0, 199.0];
        let map = volume(rig.clone()).map(&asked);
        assert!(map.windows(2).all(|pair| pair[0].distance <= pair[1].distance));
        assert!(asked.iter().all(|d| map.iter().any(|place| place.distance == *d)));
        let ranges = rig.ranges();
        let mut seen = 0;
        for place in &map {
            let drawn = ranges.iter().any(|r| (r.near..=r.far).contains(&place.distance));
            assert_eq!(drawn, place.perceived.is_some(), "{place:?}");
            // Where partitions meet, the camera takes the farther one.
            if let (false, Some(perceived), Some(disparity)) =
                (place.what.ends_with(", far"), place.perceived, place.disparity)
            {
                let [met, apart] = triangulated(&rig, place.distance);
                assert!((1.0 / met - 1.0 / perceived).abs() < 1e-9, "{place:?}: {met}");
                assert!((apart - disparity).abs() < 1e-6, "{place:?}: {apart}");
                seen += 1;
            }
        }
        assert!(seen >= 7, "{seen}");
    }
    let map = volume(asymptotic()).map(&[]);
    let of = |what: &str| map.iter().find(|p| p.what == what).cloned().expect("a place");
    let Place { distance, perceived, .. } = of("drawn, near");
    // NCP = SI MIND (MAXD − SD)/(SD (MAXD − MIND)), appendix A.
    assert!((distance - 150.0 * 14.0 * (43.0 - 19.0) / (19.0 * (43.0 - 14.0))).abs() < 1e-9);
    assert!((perceived.expect("drawn") - 14.0).abs() < 1e-9);
    assert!((of("screen").distance - 150.0).abs() < 1e-9);
}

#[test]
fn what_runs_backward_is_told() {
    let told = |partitions: Vec<Partition>| {
        let rig = Rig { projection: piecewise(partitions), far: Some(1e4), ..Rig::default() };
        volume(rig).notes().into_iter().find(|note| note.contains("backward"))
    };
    let back = vec![part([20.0, 60.0], [20.0, 60.0]), part([60.0, 500.0], [40.0, 80.0])];
    let expected = "perceived distances run backward from partition 1 to partition 2: \
        60 is seen at 60, but 60 at 40";
    assert_eq!(told(back).as_deref(), Some(expected));
    let from_infinity =
        vec![part([20.0, 60.0], [20.0, f64::INFINITY]), part([70.0, 500.0], [50.0, 50.0])];
    assert!(told(from_infinity)
        .is_some_and(|note| note.contains("60 is seen at infinity, but 70 at 50")));
    let forward = [20.0, 60.0, 90.0, 500.0];
    let pairs = forward.windows(2).map(|w| part([w[0], w[1]], [w[0] / 3.0, w[1] / 3.0]));
    assert_eq!(told(pairs.collect()), None);
    assert!(volume(Rig::default()).notes().is_empty());
}

#[test]
fn what_no_partition_has_is_counted() {
    let gaps = vec![part([40.0, 55.0], [40.0, 55.0]), part([66.0, 80.0], [66.0, 80.0])];
    let mut told = 0;
    for builtin in &builtin::SCENES {
        for partitions in [None, Some(gaps.clone())] {
            let kind = Some(Kind::Piecewise);
            let mut scene =
                open_projected(builtin.name, Some([64, 48]), None, kind).expect("built in");
            if let Some(partitions) = partitions {
                scene.rig.projection = piecewise(partitions);
            }
            let ranges = scene.rig.ranges();
            let drawn = |w: f64| ranges.iter().any(|r| r.near <= w && w <= r.far);
            let d = scene.rig.viewing_distance;
            let [mut polygons, mut undrawn, mut partly] = [0; 3];
            for mesh in &scene.meshes {
                let triangles = mesh.triangles.iter().map(|t| t.to_vec());
                for corners in triangles.chain(mesh.faces.iter().cloned()) {
                    // Between two neighbouring borders and corners all is drawn, or nothing.
                    let mut z: Vec<f64> =
                        corners.iter().map(|&n| mesh.positions[n as usize][2] + d).collect();
                    z.sort_by(f64::total_cmp);
                    let [near, far] = [z[0], z[z.len() - 1]];
                    z.extend(ranges.iter().flat_map(|r| [r.near, r.far]));
                    z.retain(|w| (near..=far).contains(w));
                    z.sort_by(f64::total_cmp);
                    let pairs = z.windows(2).filter(|w| near == far || w[1] - w[0] > 1e-9);
                    let parts: Vec<bool> = pairs.map(|w| drawn((w[0] + w[1]) / 2.0)).collect();
                    polygons += 1;
                    undrawn += usize::from(parts.iter().all(|part| !part));
                    partly += usize::from(parts.iter().any(|&p| p) && parts.iter().any(|p| !p));
                }
            }
            let extent = scene.extent().expect("legal");
            let found = (extent.polygons, extent.undrawn, extent.partly);
            assert_eq!(found, (polygons, undrawn, partly), "{}", builtin.name);
            let some = undrawn + partly;
            let notes = Volume::of(&scene, None).expect("legal").warnings();
            let note = notes.iter().find(|note| note.contains("only in part"));
            let counts = format!("{undrawn} are not drawn and {partly} only in part");
            assert_eq!(note.is_some(), some > 0);
            assert!(note.is_none_or(|note| note.contains(&counts)), "{note:?}");
            told += usize::from(some > 0);
        }
    }
    assert!(told > 10, "{told}");
}
