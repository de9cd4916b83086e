//! Rigs as a user meets them: `wheatstone rig`, and what every command says of one that makes no sense.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).args(line.split_whitespace()).output().expect("the program runs")
}

fn out(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Rig files that make no sense, and the error that each must give after the name of the file.
const WRONG: &[(&str, &str)] = &[
    ("{\"eye_separation\": 0}", "1: eye_separation: expected a number from 1e-9 to 1e9, found 0"),
    ("{\"eye_separation\": -1}", "1: eye_separation: expected a number from 1e-9 to 1e9, found -1"),
    ("{\"viewing_distance\": -60}", "1: viewing_distance: expected a number from 1e-9 to 1e9"),
    ("{\"near\": 9,\n\"far\": 8}", "2: far: expected more than near, which is 9, found 8"),
    ("{\"far\": 1e999}", "1: far: expected well-formed JSON, found number out of range"),
    ("{\"eye_separation\": NaN}", "1: eye_separation: expected a value, found something else"),
    ("{\"eye_separation\": 1e99}", "1: eye_separation: expected a number from 1e-9 to 1e9"),
    ("{\"eye_separation\": [1]}", "1: eye_separation: expected a number, found sequence"),
    ("{\"eyes\": 1}", "1: eyes: expected one of"),
    ("", "1: file: expected well-formed JSON, found EOF"),
    (
        "{\"projection\": \"asymptotic\", \"asymptotic\": {\"screen_distance\": 60, \"max_distance\": 60}}",
        "1: asymptotic.max_distance: expected more than the screen's distance, 60, found 60",
    ),
    (
        "{\"projection\": \"piecewise\", \"piecewise\": {\"partitions\": [
        {\"near\": 30, \"far\": 60, \"min_distance\": 30, \"max_distance\": 60},
        {\"near\": 59, \"far\": 90, \"min_distance\": 60, \"max_distance\": 90}]}}",
        "3: piecewise.partitions[1].near: expected at least 60, where partition 0 ends",
    ),
    (
        "{\"placement\": {\"view\": {\"eye\": [0, 3, 0], \"up\": [0, 1, 0]}}}",
        "1: placement.view.up: expected a direction across the line of sight",
    ),
];

#[test]
fn senseless_rigs_are_one_error_in_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rtl");
    let rtl = rtl.display();
    for (text, message) in WRONG {
        fs::write(folder.path().join("rig.json"), text).unwrap();
        for command in [
            "rig".to_string(),
            "render --out drawn".into(),
            "compare".into(),
            format!("cosim hybrid --out made --rtl {rtl}"),
            format!("vectors hybrid --out packs --rtl {rtl}"),
            format!("waves hybrid --out made --rtl {rtl}"),
        ] {
            let output = run(folder.path(), &format!("{command} --scene ramp --rig rig.json"));
            let said = err(&output);
            assert_eq!(output.status.code(), Some(2), "{command} {text}: {said}");
            let expected = format!("error: rig.json:{message}");
            assert!(said.starts_with(&expected), "{command}: “{said}”, not “{expected}”");
            assert_eq!((said.lines().count(), out(&output).as_str()), (1, ""), "{command}");
        }
    }
    // Where no scene is drawn, a rig would go unread.
    for line in ["vectors filter --out packs", "cosim filter", "waves filter"] {
        for option in ["--rig rig.json", "--projection shear"] {
            let output = run(folder.path(), &format!("{line} --rtl {rtl} {option}"));
            assert_eq!(output.status.code(), Some(2), "{line} {option}");
            let expected =
                format!("error: {}: no scene is drawn", option.split(' ').next().unwrap());
            assert!(err(&output).starts_with(&expected), "{line}: {}", err(&output));
        }
    }
}

#[test]
fn the_rig_is_told_in_tables_plots_and_json() {
    let folder = tempfile::tempdir().unwrap();
    let rig = r#"{"projection": "asymptotic", "viewing_distance": 150, "pixels_per_unit": 46.27,
        "asymptotic": {"screen_intercept": 150, "screen_distance": 19, "min_distance": 14,
        "max_distance": 43, "eye_distance": 2.5}}"#;
    fs::write(folder.path().join("rig.json"), rig).unwrap();
    let line = "rig --rig rig.json --at 100,600 --out plots --json rig-numbers.json";
    let output = run(folder.path(), line);
    let text = out(&output);
    assert_eq!((output.status.code(), err(&output).as_str()), (Some(0), ""), "{text}");
    let has = |words: &str| {
        let row =
            |line: &str| words.split(' ').all(|word| line.split_whitespace().any(|w| w == word));
        assert!(text.lines().any(row), "{words}: {text}");
    };
    // NASA 1992: 40 degrees at the screen, 6.65, 33.2 and 46.5 at infinity; 14 in at NCP.
    has("screen 19 0.00 40.00 0.00 40.00");
    has("infinity 6.65 33.21 46.51");
    has("drawn 91.4701 14");
    let json: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("rig-numbers.json")).unwrap())
            .unwrap();
    let found = |list: &str, key: &str, value: serde_json::Value| {
        let items = json[list].as_array().expect("a list").clone();
        items
            .into_iter()
            .find(|item| item[key] == value)
            .unwrap_or_else(|| panic!("{list} {value}"))
    };
    // Appendix A: d = d' SD MAXD/(d' SD + SI (MAXD − SD)).
    for distance in [100.0, 600.0] {
        let map = found("map", "distance", distance.into());
        let expected = distance * 19.0 * 43.0 / (distance * 19.0 + 150.0 * (43.0 - 19.0));
        assert!((map["perceived"].as_f64().unwrap() - expected).abs() < 1e-9, "{map}");
    }
    assert!(found("fields_of_view", "what", "infinity".into())["perceived"].is_null());
    assert_eq!(found("lengths", "what", "eyes to screen".into())["units"], 19.0);
    assert_eq!((&json["projection"], &json["scene"]), (&"asymptotic".into(), &"teapot".into()));
    for name in ["distance_map.svg", "fields_of_view.svg"] {
        let plot = fs::read_to_string(folder.path().join("plots").join(name)).unwrap();
        assert!(plot.starts_with("<svg") && text.contains(name), "{name}");
    }
    for (line, message) in [
        ("rig --at=-3", "expected distances from the eyes"),
        ("rig --at 1,x", "expected distances from the eyes"),
        ("rig --scene nothing", "scene nothing: expected"),
        ("rig --out /proc/none", "/proc/none"),
        ("rig --json /proc/none/r.json", "none/r.json: cannot be written"),
    ] {
        let output = run(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}");
        assert!(err(&output).contains(message), "{line}: {}", err(&output));
    }
}

#[test]
fn scenes_of_all_units_are_told_in_every_projection() {
    let folder = tempfile::tempdir().unwrap();
    let kinds = ["two-centres", "shear", "translate", "asymptotic", "piecewise", "symmetric"];
    for scene in ["teapot", "atoms", "office-1", "ratio"] {
        for kind in kinds {
            let output =
                run(folder.path(), &format!("rig --scene {scene} --projection {kind} --out p"));
            let text = out(&output);
            assert_eq!(output.status.code(), Some(0), "{scene} {kind}: {}", err(&output));
            assert!(!text.contains("NaN") && !text.contains("inf "), "{scene} {kind}: {text}");
        }
    }
}

#[test]
fn what_a_projection_leaves_out_is_told_by_every_command_that_draws() {
    let folder = tempfile::tempdir().unwrap();
    let view = "--scene room --projection piecewise --size 64x48";
    let counts = |text: &str| {
        let line = text.lines().find(|line| line.contains("only in part")).expect(text).to_string();
        line[line.find("of ").unwrap()..line.find(" (see").unwrap_or(line.len())].to_string()
    };
    let told = counts(&out(&run(folder.path(), "rig --scene windows --projection piecewise")));
    assert!(told.contains("nearer than 320 or farther than 64000 is not drawn"), "{told}");
    for command in ["render --method direct --out drawn", "compare", "render --wire --out drawn"] {
        let line = format!("{command} --scene windows --projection piecewise --size 64x48");
        let output = run(folder.path(), &line);
        assert_eq!(
            (output.status.code(), counts(&err(&output))),
            (Some(0), told.clone()),
            "{command}"
        );
        let whole = run(folder.path(), &line.replace("piecewise", "two-centres"));
        assert!(!err(&whole).contains("only in part"), "{command}");
    }
    let nothing = run(folder.path(), &format!("render --out drawn {view}"));
    assert_eq!(nothing.status.code(), Some(0));
    assert!(!err(&nothing).contains("warning"), "all of the room lies in partitions");
}

#[test]
fn what_places_a_mesh_too_far_away_is_named_with_its_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    for (text, field) in [
        ("{\n\"pixels_per_unit\": 1e-9}", "2: pixels_per_unit"),
        ("{\"placement\": {\"fit\": null,\n\"offset\": [1e9, 0, 0]}}", "2: placement.offset"),
    ] {
        fs::write(folder.path().join("rig.json"), text).unwrap();
        let output = run(folder.path(), "render --scene a.obj --rig rig.json --out drawn");
        let expected = format!("error: rig.json:{field}: expected what puts no coordinate");
        assert!(err(&output).starts_with(&expected), "{}", err(&output));
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn nothing_drawn_is_a_warning_of_pictures_and_an_error_of_comparisons() {
    let folder = tempfile::tempdir().unwrap();
    let floor = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nf 1 4 3 2\n";
    fs::write(folder.path().join("floor.obj"), floor).unwrap();
    let said = "floor.obj: nothing to draw: 2 seen edge-on; try: turn it with a rig file";
    let output = run(folder.path(), "render --scene floor.obj --size 40x30 --out drawn");
    assert!(err(&output).contains(&format!("warning: {said}\n")), "{}", err(&output));
    assert!(output.status.success() && folder.path().join("drawn/left.png").exists());
    let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rtl");
    let rtl = rtl.display();
    for command in [
        format!("cosim hybrid --rtl {rtl}"),
        format!("vectors hybrid --out packs --rtl {rtl}"),
        format!("waves hybrid --rtl {rtl}"),
        "compare".into(),
        format!("baseline --rtl {rtl}"),
    ] {
        let output = run(folder.path(), &format!("{command} --scene floor.obj"));
        assert_eq!(err(&output), format!("error: {said}\n"), "{command}");
        assert_eq!(output.status.code(), Some(2), "{command}");
    }
}
