//! Projections in rig files: what they say, and what makes no sense.

use wheatstone_golden::projection::{Asymptotic, Device, Kind, Projection};
use wheatstone_golden::scene::{open, open_projected, Rig, RigFile};
use wheatstone_tests::folder;

const SIZE: [u32; 2] = [240, 180];

#[test]
fn the_display_makes_dots_of_inches() {
    let device = Device::LEX_90;
    assert_eq!(device.dots(device.eye_distance).round(), 119.0);
    assert_eq!(device.dots(device.viewing_distance).round(), 857.0);
    let folder = folder();
    let file = folder.path().join("rig.json");
    let text = r#"{"projection": "translate", "pixels_per_unit": 4,
        "translate": {"eye_distance": 2.5, "viewing_distance": 18, "dot_pitch": 0.021}}"#;
    std::fs::write(&file, text).expect("written");
    let scene = open("teapot", Some(SIZE), Some(&file)).expect("well-formed");
    assert!((scene.rig.eye_separation - 2.5 / 0.021 / 4.0).abs() < 1e-12);
    assert!((scene.rig.viewing_distance - 18.0 / 0.021 / 4.0).abs() < 1e-12);
    assert_eq!(scene.rig.projection, Projection::Translate);
    // Another projection has no use for them.
    let scene =
        open_projected("teapot", Some(SIZE), Some(&file), Some(Kind::Shear)).expect("it is");
    assert_eq!((scene.rig.eye_separation, scene.rig.projection), (6.5, Projection::Shear));
}

/// Wrong rig files, the words that the error must contain.
const WRONG: &[(&str, &[&str])] = &[
    ("{\n\"projection\": \"fisheye\"}", &["rig.json:2: projection: expected one of", "`two-centres`", "fisheye"]),
    ("{\"projection\": \"symmetric\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected a number from 1e-9 to 1e9, found 0"]),
    ("{\"projection\": \"asymptotic\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected a number from 1e-9 to 1e9, found 0"]),
    ("{\"projection\": \"piecewise\",\n\"eye_separation\": 0}", &["rig.json:2: eye_separation: expected a number from 1e-9 to 1e9, found 0"]),
    ("{\"projection\": \"symmetric\",\n\"head_tilt\": 5}", &["rig.json:2: head_tilt: expected 0 with projection symmetric", "found 5"]),
    ("{\"projection\": \"symmetric\",\n\"eye_separation\": 32}", &["rig.json:2: eye_separation: expected less than the width of the screen, 32, found 32"]),
    ("{\n\"viewing_distance\": -60}", &["rig.json:2: viewing_distance: expected a number from 1e-9", "found -60"]),
    ("{\n\"viewing_distance\": 1e999}", &["rig.json:2", "number out of range"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"screen_distance\": -19}}", &["rig.json:2: asymptotic.screen_distance: expected a number from", "found -19"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\"screen_distance\": 19,\n\"max_distance\": 19}}", &["rig.json:2: asymptotic.max_distance: expected more than the screen's distance, 19, found 19"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"screen_intercept\": 0}}", &["rig.json:2: asymptotic.screen_intercept", "found 0"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"min_distance\": 120}}", &["rig.json:2: asymptotic.min_distance: expected less than max_distance, 120, found 120"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"eye_distance\": 0}}", &["rig.json:2: asymptotic.eye_distance", "found 0"]),
    ("{\"projection\": \"asymptotic\", \"asymptotic\": {\n\"intercept\": 1}}", &["rig.json:2: asymptotic", "unknown field `intercept`"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5, \"viewing_distance\": 18,\n\"dot_pitch\": 0}}", &["rig.json:2: translate.dot_pitch", "found 0"]),
    ("{\"projection\": \"translate\", \"translate\": {\n\"eye_distance\": 0, \"viewing_distance\": 18, \"dot_pitch\": 1}}", &["rig.json:2: translate.eye_distance", "found 0"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5,\n\"dot_pitch\": 1}}", &["rig.json:2: translate.viewing_distance: expected a value, found nothing"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [\n{\"near\": 50, \"far\": 60, \"min_distance\": 55, \"max_distance\": 60},\n{\"near\": 59, \"far\": 70, \"min_distance\": 60, \"max_distance\": 65}]}}", &["rig.json:3: piecewise.partitions[1].near: expected at least 60, where partition 0 ends", "found 59"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5, \"viewing_distance\": 18, \"dot_pitch\": 1},\n\"eye_separation\": 6.5}", &["rig.json:2: eye_separation: expected translate or this, not both", "found 6.5 beside translate"]),
    ("{\"translate\": {\"eye_distance\": 2.5, \"dot_pitch\": 1,\n\"viewing_distance\": 18}, \n\"viewing_distance\": 60}", &["viewing_distance: expected translate or this, not both", "found 60 beside translate"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": []}}", &["rig.json:1: piecewise.partitions: expected 1 to 1000 partitions"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 70,\n\"far\": 70, \"min_distance\": 55, \"max_distance\": 60}]}}", &["rig.json:2: piecewise.partitions[0].far: expected more than near, which is 70, found 70"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 50, \"far\": 60, \"min_distance\": 55,\n\"max_distance\": 54}]}}", &["rig.json:2: piecewise.partitions[0].max_distance: expected at least min_distance, which is 55, found 54"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [{\"near\": 50, \"far\": 60,\n\"max_distance\": 54}]}}", &["rig.json:2: piecewise.partitions[0].min_distance: expected a value, found nothing"]),
    ("{\n\"eye_separation\": -6.5}", &["rig.json:2: eye_separation: expected a number from 1e-9 to 1e9, found -6.5"]),
    ("{\n\"eye_separation\": 1e300}", &["rig.json:2: eye_separation: expected a number from 1e-9 to 1e9, found 1e300"]),
    ("{\n\"eye_separation\": NaN}", &["rig.json:2: eye_separation: expected a value, found something else: not well-formed JSON"]),
    ("{\n\"eye_separation\": \"6.5\"}", &["rig.json:2: eye_separation: expected a number, found string"]),
    ("{\n\"eyes\": 2}", &["rig.json:2: eyes: expected one of", "`eye_separation`", "found unknown field `eyes`"]),
    ("{\n\"near\": 100, \"far\": 50}", &["rig.json:2: far: expected more than near, which is 100, found 50"]),
    ("{\n\"near\": 100, \"far\": 100}", &["rig.json:2: far: expected more than near, which is 100, found 100"]),
    ("{\n\"near\": 0}", &["rig.json:2: near: expected a number from 1e-9 to 1e9, found 0"]),
    ("{\n\"far\": 1e999}", &["rig.json:2: far: expected well-formed JSON, found number out of range"]),
    ("{\n\"projection\": 3}", &["rig.json:2: projection: expected a string, found integer `3`"]),
    ("{\n\"asymptotic\": 3}", &["rig.json:2: asymptotic: expected an object in braces, found integer `3`"]),
    ("", &["rig.json:1: file: expected well-formed JSON, found EOF"]),
    ("\n[6.5]", &["rig.json:2: file: expected an object in braces, found a list"]),
    ("\"x\"", &["rig.json:1: file: expected an object in braces, found string"]),
    ("{\n\"near\": 1", &["rig.json:2: file: expected well-formed JSON, found EOF while parsing an object"]),
    ("{\n\"placement\": {\"view\": {\"eye\": [0, 3, 0], \"up\": [0, 1, 0]}}}", &["rig.json:2: placement.view.up: expected a direction across the line of sight to [0.0, 3.0, 0.0], found [0.0, 1.0, 0.0]"]),
    ("{\"projection\": \"translate\", \"translate\": {\"eye_distance\": 2.5,\n\"viewing_distance\": 1e9, \"dot_pitch\": 1e-9}}", &["rig.json:2: translate.viewing_distance: expected a number from 1e-9 to 1e9, in units (length / dot_pitch / pixels_per_unit), found"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [\n{\"near\": 60, \"far\": 90, \"min_distance\": 60, \"max_distance\": 90},\n{\"near\": 30, \"far\": 60, \"min_distance\": 30, \"max_distance\": 60}]}}", &["rig.json:3: piecewise.partitions[1].near: expected at least 90, where partition 0 ends: partitions do not overlap, the nearest comes first, found 30"]),
    ("{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [\n{\"near\": 0, \"far\": 90, \"min_distance\": 60, \"max_distance\": 90}]}}", &["rig.json:2: piecewise.partitions[0].near: expected a number from 1e-9 to 1e9, found 0"]),
    ("{\"projection\": \"piecewise\", \"far\": 25, \"near\": 20}", &["rig.json:1: near: expected a partition between near and far, 25, found 20"]),
];

#[test]
fn senseless_rigs_give_one_clear_error() {
    let folder = folder();
    for (text, words) in WRONG {
        let file = folder.path().join("rig.json");
        std::fs::write(&file, text).expect("written");
        let error = open("teapot", None, Some(&file)).err().unwrap_or_else(|| panic!("{text}"));
        let error = error.to_string();
        for word in *words {
            assert!(error.contains(word), "{text}: “{error}” does not say “{word}”");
        }
        assert_eq!(error.lines().count(), 1, "{error}");
    }
    // What a vector pack has no room for.
    let partition = |n: usize| {
        let [near, far] = [n + 1, n + 2];
        format!("{{\"near\": {near}, \"far\": {far}, \"min_distance\": {near}, \"max_distance\": {far}}}")
    };
    let partitions = |count: usize| {
        let list = (0..count).map(partition).collect::<Vec<_>>().join(", ");
        format!("{{\"projection\": \"piecewise\", \"piecewise\": {{\"partitions\": [{list}]}}}}")
    };
    let read = |text: String| RigFile::read(std::path::Path::new("rig.json"), text).map(drop);
    let told = |text: String| read(text).map_err(|error| error.to_string());
    assert_eq!(told(partitions(1_000)), Ok(()));
    let expected =
        "rig.json:1: piecewise.partitions: expected 1 to 1000 partitions, found length 1001";
    assert_eq!(told(partitions(1_001)), Err(expected.into()));
    let padded = |bytes: usize| format!("{{{}}}", " ".repeat(bytes - 2));
    assert_eq!(told(padded(256 << 10)), Ok(()));
    let expected = "rig.json: file: expected at most 262144 bytes, found 262145 bytes";
    assert_eq!(told(padded((256 << 10) + 1)), Err(expected.into()));
    // Without a rig file it is the scene that does not fit.
    let flat = folder.path().join("flat.json");
    let scene = r#"{"format": "stereo-scene/1", "width": 8, "height": 8, "pixels_per_unit": 1,
        "eye_separation": 0, "viewing_distance": 9, "background": [0, 0, 0], "vertices": [],
        "colors": [], "triangles": []}"#;
    std::fs::write(&flat, scene).expect("written");
    let error = open(&flat.to_string_lossy(), None, None).expect_err("one eye");
    let expected = "flat.json:2: eye_separation: expected a number from 1e-9 to 1e9, found 0";
    assert!(error.to_string().ends_with(expected), "{error}");
    // In code, what is not finite.
    let check = |parameters| {
        Rig { projection: Projection::Asymptotic(parameters), ..Rig::default() }.check()
    };
    let nan = Asymptotic { max_distance: Some(f64::NAN), ..Asymptotic::default() };
    assert!(check(nan).is_err());
    let infinite = Asymptotic { screen_intercept: Some(f64::INFINITY), ..Asymptotic::default() };
    assert!(check(infinite).is_err());
    assert!(Rig { head_tilt: f64::NAN, ..Rig::default() }.check().is_err());
}
