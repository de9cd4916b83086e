//! Reports of a regression: a table, JSON, JUnit XML.

use super::entry::{Entry, SceneEntry};
use super::failure::Failure;
use crate::numbers::counted;
use comfy_table::presets::UTF8_HORIZONTAL_ONLY;
use comfy_table::{Cell, CellAlignment, Table};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::PathBuf;
use wheatstone_golden::formats::Eye;
use wheatstone_golden::primary::Counts as Drawn;
use wheatstone_golden::text::Grouped;

/// The table of targets, cases, what was compared, and mismatches.
pub fn table(entries: &[Entry]) -> String {
    let mut table = Table::new();
    table.load_preset(UTF8_HORIZONTAL_ONLY);
    table.set_header([
        "target",
        "case",
        "runs",
        "beats",
        "compared",
        "pixels",
        "Mclocks/s",
        "mismatches",
    ]);
    for n in 2..8 {
        if let Some(column) = table.column_mut(n) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    for entry in entries {
        let rate = entry.clocks as f64 / entry.time.as_secs_f64().max(1e-9) / 1e6;
        table.add_row([
            Cell::new(entry.target.name()),
            Cell::new(&entry.name),
            Cell::new(entry.runs),
            Cell::new(Grouped(entry.beats)),
            Cell::new(Grouped(entry.compared)),
            Cell::new(
                entry.scene.as_ref().map_or(String::new(), |s| Grouped(s.pixels).to_string()),
            ),
            Cell::new(format!("{rate:.2}")),
            Cell::new(u8::from(!entry.passed())),
        ]);
    }
    let mut text = format!("{table}\n");
    for entry in entries {
        if let Some(scene) = &entry.scene {
            text += &format!("{} {}: {}\n", entry.target.name(), entry.name, scene_line(scene));
        }
    }
    let failed = entries.iter().filter(|e| !e.passed()).count();
    let compared: u64 = entries.iter().map(|e| e.compared).sum();
    let pixels: u64 = entries.iter().filter_map(|e| e.scene.as_ref()).map(|s| s.pixels).sum();
    text + &format!(
        "{}, {} and {} compared, mismatches {failed}\n",
        counted(entries.len() as u64, "case"),
        counted(compared, "beat"),
        counted(pixels, "pixel")
    )
}

/// The figures of a scene, in a line.
fn scene_line(scene: &SceneEntry) -> String {
    format!(
        "{}; {}, beats on {:.2} % of them; pixels left {}, right {}",
        drawn_line(&scene.drawn),
        counted(scene.clocks, "clock"),
        100.0 * scene.acceptance,
        Grouped(scene.written[0]),
        Grouped(scene.written[1]),
    )
}

/// Counts of polygons, by the way in which they were drawn, in a line.
pub fn drawn_line(drawn: &Drawn) -> String {
    let mut parts =
        vec![counted(drawn.polygons, "polygon"), format!("{} derived", Grouped(drawn.derived))];
    let reasons: Vec<String> = drawn
        .monocular
        .iter()
        .map(|(reason, n)| format!("{} {}", Grouped(*n), reason.name()))
        .collect();
    let monocular: u64 = drawn.monocular.values().sum();
    let why = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join(", ")) };
    parts.push(format!("{} monocular{why}", Grouped(monocular)));
    parts.push(format!("{} covering nothing", Grouped(drawn.nothing)));
    if drawn.beats() > 0 {
        parts.push(counted(drawn.beats(), "beat"));
    }
    parts.join(", ")
}

#[derive(Serialize)]
struct JsonEntry<'a> {
    target: &'static str,
    case: &'a str,
    runs: u64,
    beats: u64,
    compared: u64,
    clocks: u64,
    seconds: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    scene: Option<JsonScene>,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<&'a Failure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    waves: Option<&'a PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    waves_error: Option<String>,
}

#[derive(Serialize)]
struct JsonScene {
    polygons: u64,
    derived: u64,
    monocular: BTreeMap<&'static str, u64>,
    nothing: u64,
    beats: u64,
    clocks: u64,
    acceptance: f64,
    pixels_compared: u64,
    pixels_written: BTreeMap<&'static str, u64>,
}

/// The regression as JSON.
pub fn json(entries: &[Entry], command: &str) -> String {
    let scene = |s: &SceneEntry| JsonScene {
        polygons: s.drawn.polygons,
        derived: s.drawn.derived,
        monocular: s.drawn.monocular.iter().map(|(r, n)| (r.name(), *n)).collect(),
        nothing: s.drawn.nothing,
        beats: s.drawn.beats(),
        clocks: s.clocks,
        acceptance: s.acceptance,
        pixels_compared: s.pixels,
        pixels_written: Eye::BOTH.iter().map(|e| (e.name(), s.written[*e as usize])).collect(),
    };
    let entry = |e: &'_ Entry| -> serde_json::Value {
        let entry = JsonEntry {
            target: e.target.name(),
            case: &e.name,
            runs: e.runs,
            beats: e.beats,
            compared: e.compared,
            clocks: e.clocks,
            seconds: e.time.as_secs_f64(),
            scene: e.scene.as_ref().map(scene),
            failure: e.failure.as_ref(),
            waves: e.waves.as_ref(),
            waves_error: e.waves_error.as_ref().map(ToString::to_string),
        };
        serde_json::to_value(entry).unwrap_or_default()
    };
    let value = serde_json::json!({
        "format": "wheatstone-cosim/1",
        "version": env!("CARGO_PKG_VERSION"),
        "command": command,
        "mismatches": entries.iter().filter(|e| !e.passed()).count(),
        "entries": entries.iter().map(entry).collect::<Vec<_>>(),
    });
    format!("{value:#}\n")
}

/// The regression as JUnit XML: a suite a target, a test a case.
pub fn junit(entries: &[Entry]) -> Result<String, quick_junit::SerializeError> {
    let mut report = Report::new("wheatstone cosim");
    let mut suites: Vec<TestSuite> = Vec::new();
    for entry in entries {
        let status = match &entry.failure {
            None if entry.is_vain() => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
                status.set_message("nothing was compared");
                status
            }
            None => TestCaseStatus::success(),
            Some(failure) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                status.set_message(failure.what.clone()).set_type("mismatch");
                status.set_description(failure.to_string());
                status
            }
        };
        let mut case = TestCase::new(entry.name.clone(), status);
        case.set_classname(entry.target.name()).set_time(entry.time);
        case.set_system_out(format!(
            "{}, {} compared",
            counted(entry.beats, "beat"),
            entry.compared
        ));
        match suites.last_mut().filter(|s| s.name.as_str() == entry.target.name()) {
            Some(suite) => {
                suite.add_test_case(case);
            }
            None => {
                let mut suite = TestSuite::new(entry.target.name());
                suite.add_test_case(case);
                suites.push(suite);
            }
        }
    }
    report.add_test_suites(suites);
    report.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use wheatstone_golden::targets::Target;

    #[test]
    fn an_entry_is_counted_with_what_it_compared() {
        let mut entry = Entry::new(Target::Display, "random");
        assert!(junit(&[Entry::new(Target::Display, "random")])
            .is_ok_and(|xml| xml.contains("errors=\"1\"") && xml.contains("nothing was compared")));
        entry.compared = 1;
        assert!(!entry.is_vain());
        let text = table(&[entry]);
        assert!(text.ends_with("1 case, 1 beat and 0 pixels compared, mismatches 0\n"), "{text}");
        let drawn = Drawn { polygons: 1, ..Drawn::default() };
        assert!(drawn_line(&drawn).starts_with("1 polygon, 0 derived"));
    }
}
