//! Coverage: the regression covers all of a unit, a few beats and random registers do not, and every waiver can be
//! read.

use wheatstone_golden::targets::Target;
use wheatstone_testbench::cover::{self, Counts, Report, Waiver};
use wheatstone_testbench::regression::Plan;
use wheatstone_tests::*;

const TARGETS: [Target; 2] = [Target::Filter, Target::Blend];

fn waivers() -> Vec<Waiver> {
    let text = std::fs::read_to_string(workspace().join(cover::WAIVERS)).expect("the waivers");
    Waiver::parse(&text).unwrap_or_else(|error| panic!("{error}"))
}

fn measure(plan: Plan) -> Counts {
    let measured = cover::measure(builder(), &[plan], &|_| ());
    measured.unwrap_or_else(|error| panic!("{error}")).0
}

#[test]
fn the_regression_covers_every_line_and_bit_of_a_unit() {
    let counts = measure(plan(&TARGETS, settings("default", &[]), cover::BEATS));
    let report = Report::new(&counts, &waivers());
    let files: Vec<&str> = report.files.keys().map(String::as_str).collect();
    assert_eq!(files, ["sam_blend.v", "sam_filter.v", "sam_filter_division.v"]);
    assert!(report.missing.is_empty(), "{:#?}", report.missing);
    for file in report.files.values() {
        assert_eq!(file.toggles.covered, file.toggles.points, "nothing is waived there");
    }
    assert!(!report.stale.is_empty(), "waivers of other files are not needed here");
}

#[test]
fn what_is_not_run_is_missing() {
    let case = Some("random".to_owned());
    let counts = measure(Plan { case, ..plan(&TARGETS, settings("default", &[]), 3) });
    let report = Report::new(&counts, &[]);
    let names: Vec<&str> = report.missing.iter().map(|point| point.name.as_str()).collect();
    assert!(names.contains(&"count_q[3]"), "three beats do not count to 8: {names:?}");
}

#[test]
fn what_registers_begin_with_is_not_stimulus() {
    let counts = measure(plan(&[Target::Primary], settings("default", &[]), 2_000));
    let report = Report::new(&counts, &[]);
    let names: Vec<&str> = report.missing.iter().map(|point| point.name.as_str()).collect();
    assert!(names.contains(&"alpha_low[0]"), "planes have no dropped bits, only zeros are stored");
    assert!(!names.contains(&"alpha[20]"), "colours change");
}

#[test]
fn every_waiver_has_a_file() {
    for waiver in waivers() {
        assert!(rtl().join(&waiver.file).exists(), "{}: no such file", waiver.file);
    }
}
