//! Experiments: what is written and what is counted. That they hold: `figures.rs`.

use serde_json::Value;
use std::fs;
use std::path::Path;
use wheatstone_golden::files;
use wheatstone_studies::reproduce::{json, run, Event, Summary};
use wheatstone_studies::{Check, Experiment, Report, Row, StudyError, Table, EXPERIMENTS};
use wheatstone_tests::folder;

fn report(name: &str, rows: Vec<Row>) -> Report {
    let table = Table { title: "A table".into(), rows };
    Report { experiment: name.into(), tables: vec![table], ..Report::default() }
}

/// Two figures that hold, of which one has an erratum, one that differs, one that is a trend
/// and one that is quoted.
fn mixed(out: &Path) -> Result<Report, StudyError> {
    files::write(&out.join("plot.svg"), b"<svg/>")?;
    let rows = vec![
        Row::new("whole", 5.0, 0, Check::Digits).printed(5.0),
        Row::new("wrong in print", 1.5, 2, Check::Digits).printed(1.67).corrected(1.5, "1 + II"),
        Row::new("wrong here", 2.0, 1, Check::AtMost(1.0)),
        Row::new("seconds", 0.1, 2, Check::Trend).printed(9.0).unit("s").note("other machine"),
        Row::quoted("gates", 7.0),
    ];
    Ok(report("mixed", rows))
}

fn unwritable(out: &Path) -> Result<Report, StudyError> {
    files::write(&out.join("none"), b"")?;
    files::write(&out.join("none/plot.svg"), b"")?;
    unreachable!("a file is no folder")
}

const MIXED: Experiment = Experiment { name: "mixed", description: "a bit of all", run: mixed };

#[test]
fn every_experiment_leaves_its_tables_and_figures() {
    let folder = folder();
    let mut events = Vec::new();
    let reports = run(&[MIXED], folder.path(), |event| {
        events.push(match event {
            Event::Begin(experiment) => format!("begin {}", experiment.name),
            Event::End(report, _) => format!("end {}", report.experiment),
        })
    });
    let reports = reports.expect("it runs");
    assert_eq!(events, ["begin mixed", "end mixed"]);
    assert_eq!(Summary::of(&reports), Summary { holds: 2, differs: 1, trend: 1, quoted: 1 });
    let at = |name: &str| folder.path().join("mixed").join(name);
    assert!(at("plot.svg").exists());
    let text = fs::read_to_string(at("tables.txt")).expect("tables");
    assert!(text.contains("A table") && text.contains("[1] 1 + II") && text.contains("DIFFERS"));
    let value: Value =
        serde_json::from_str(&fs::read_to_string(at("report.json")).expect("a report")).unwrap();
    let rows = value["tables"][0]["rows"].as_array().expect("rows").clone();
    let verdicts: Vec<&Value> = rows.iter().map(|row| &row["verdict"]).collect();
    assert_eq!(verdicts, ["holds", "holds", "differs", "trend", "quoted"]);
    assert_eq!((&rows[1]["printed"], &rows[1]["corrected"]), (&1.67.into(), &1.5.into()));
    assert_eq!(rows[1]["erratum"], "1 + II");
    assert_eq!(rows[3]["note"], "other machine");
    assert_eq!(rows[2]["check"]["at_most"], 1.0);
    let all: Value = serde_json::from_str(&json(&reports, "a command")).unwrap();
    assert_eq!(
        all["summary"],
        serde_json::json!({ "holds": 2, "differs": 1, "trend": 1, "quoted": 1 })
    );
    assert_eq!(all["experiments"][0], value);
    assert_eq!(all["command"], "a command");
}

#[test]
fn what_cannot_be_written_is_an_error_that_names_the_file() {
    let folder = folder();
    let broken = Experiment { run: unwritable, ..MIXED };
    let error = run(&[broken], folder.path(), |_| ()).expect_err("no folder").to_string();
    assert!(error.contains("mixed/none/plot.svg: cannot be written"), "{error}");
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let mut begun = false;
    let error = run(&[MIXED], &file, |_| begun = true).expect_err("a file").to_string();
    assert!(error.contains("file/mixed: cannot be written"), "{error}");
    assert!(!begun, "before any work");
}

#[test]
fn experiments_have_names_of_their_own() {
    for (n, experiment) in EXPERIMENTS.iter().enumerate() {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(experiment.name.chars().all(plain) && experiment.name != "all");
        assert!(EXPERIMENTS[..n].iter().all(|e| e.name != experiment.name));
        assert!(!experiment.description.is_empty());
    }
}
