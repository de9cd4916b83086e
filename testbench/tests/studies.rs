//! `wheatstone reproduce` and `wheatstone compare` as a user meets them.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).args(arguments).output().expect("the program runs")
}

fn status(output: &Output) -> Option<i32> {
    output.status.code()
}

fn said(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    format!("{out}{err}")
}

fn json(file: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(file).expect("a file")).expect("JSON")
}

#[test]
fn an_experiment_is_reproduced() {
    let folder = tempfile::tempdir().unwrap();
    let output =
        run(folder.path(), &["reproduce", "filter", "--out", "found", "--json", "all.json"]);
    let text = said(&output);
    assert_eq!(status(&output), Some(0), "{text}");
    assert!(text.contains("printed") && text.contains("corrected") && text.contains("here"));
    let summary = text.lines().find(|line| line.contains(" figures: ")).expect("a summary");
    assert!(summary.contains(" 0 differ, "), "{summary}");
    for name in ["report.json", "tables.txt", "errors.svg"] {
        assert!(folder.path().join("found/filter").join(name).exists(), "{name}");
    }
    let all = json(&folder.path().join("all.json"));
    assert_eq!(all, json(&folder.path().join("found/reproduce.json")));
    assert_eq!(all["summary"]["differs"], 0);
    assert_eq!(all["experiments"][0], json(&folder.path().join("found/filter/report.json")));
}

#[test]
fn bad_input_of_reproduce_has_status_2() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("taken"), "").unwrap();
    let refused = |arguments: &[&str], message: &str| {
        let output = run(folder.path(), arguments);
        assert_eq!(status(&output), Some(2), "{arguments:?}");
        assert!(said(&output).contains(message), "{arguments:?}: {}", said(&output));
    };
    let names = "no such experiment; there are: filter, adelson, village";
    refused(&["reproduce", "filters", "--out", "found"], names);
    refused(&["reproduce", "filter"], "--out");
    refused(
        &["reproduce", "filter", "--out", "taken"],
        "--out taken: a file, where a folder is expected",
    );
    refused(&["reproduce", "filter", "--out", "/proc/found"], "cannot be written");
    let json = ["reproduce", "filter", "--out", "found", "--json", "taken/all.json"];
    refused(&json, "taken/all.json: cannot be written");
}

#[test]
fn methods_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["compare", "--scene", "exclusive", "--size", "120x90"];
    let more = ["--out", "errors", "--json", "compare.json"];
    let output = run(folder.path(), &[&arguments[..], &more[..]].concat());
    let text = said(&output);
    assert_eq!(status(&output), Some(0), "{text}");
    let compared = json(&folder.path().join("compare.json"));
    let methods = compared["methods"].as_array().expect("methods");
    assert_eq!((&compared["width"], &compared["height"]), (&120.into(), &90.into()));
    for method in methods {
        let name = method["method"].as_str().expect("a name");
        assert!(text.contains(name), "{name}");
        let drawn = folder.path().join("errors").join(format!("{name}.png")).exists();
        assert!(drawn || method["unsuited"].is_string(), "{name}");
    }
    for (arguments, message) in [
        (&["compare", "--scene", "none"][..], "scene none: expected"),
        (&["compare", "--rig", "none.json"], "none.json: cannot be read"),
        (&["compare", "--param", "display=rotated"], "each on its own display"),
        (&["compare", "--out", "compare.json"], "--out compare.json: a file, where a folder"),
    ] {
        let output = run(folder.path(), arguments);
        assert_eq!(status(&output), Some(2), "{arguments:?}");
        assert!(said(&output).contains(message), "{arguments:?}: {}", said(&output));
    }
}
