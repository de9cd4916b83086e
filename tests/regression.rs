//! The regression passes in every configuration and with every single parameter changed, and says so.

use std::collections::BTreeMap;
use wheatstone_golden::config::{Config, PARAMETERS};
use wheatstone_golden::targets::Target;
use wheatstone_testbench::regression::{self, Entry};
use wheatstone_tests::*;

/// Random beats of a target here; the program runs a million for a unit.
const BEATS: u64 = 60_000;

fn all_pass(entries: &[Entry], what: &str) {
    for entry in entries {
        if let Some(failure) = &entry.failure {
            panic!("{what}: {} {}:\n{failure}", entry.target.name(), entry.name);
        }
    }
}

/// All targets, directed and random cases, in a named configuration.
fn configuration(name: &str) {
    let mut plan = plan(&Target::ALL, settings(name, &[]), BEATS);
    plan.jobs = 2;
    let entries = run(&plan, &builder());
    all_pass(&entries, name);
    for target in Target::ALL {
        let of_target = || entries.iter().filter(|entry| entry.target == target);
        let beats: u64 = of_target().filter(|e| e.name == "random").map(|e| e.beats).sum();
        assert!(beats >= BEATS, "{} {name}: only {beats} random beats", target.name());
        assert!(of_target().count() >= 2, "{} {name}: no directed case", target.name());
        assert!(of_target().all(|e| e.compared > 0 && e.clocks > 0));
    }
    let json: serde_json::Value =
        serde_json::from_str(&regression::json(&entries, "test")).expect("JSON");
    assert_eq!(json["mismatches"], 0);
    assert_eq!(json["entries"].as_array().map(Vec::len), Some(entries.len()));
    let table = regression::table(&entries);
    assert!(table.ends_with("mismatches 0\n"), "{table}");
}

#[test]
fn the_default_configuration_passes() {
    configuration("default");
}

#[test]
fn the_paper_configuration_passes() {
    configuration("paper");
}

#[test]
fn the_full_configuration_passes() {
    configuration("full");
}

/// Both systems with each single build parameter changed from the default.
#[test]
fn every_single_parameter_passes() {
    let builder = quick_builder();
    for parameter in &PARAMETERS {
        let others = parameter.values.iter().filter(|v| **v != Config::DEFAULT.value(parameter));
        for value in others {
            let words = format!("{}={value}", parameter.name);
            let mut plan =
                plan(&[Target::Minimal, Target::Hybrid], settings("default", &[&words]), 20_000);
            plan.jobs = 2;
            all_pass(&run(&plan, &builder), &words);
        }
    }
}

/// The counts of a run, without the times.
fn counts(entries: &[Entry]) -> BTreeMap<(&'static str, String), [u64; 4]> {
    let count =
        |e: &Entry| ((e.target.name(), e.name.clone()), [e.runs, e.beats, e.compared, e.clocks]);
    entries.iter().map(count).collect()
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let targets = [Target::XInterpolator, Target::Filter, Target::Redirect, Target::Hybrid];
    let with = |jobs: usize| {
        let mut plan = plan(&targets, settings("default", &[]), 30_000);
        (plan.jobs, plan.seed) = (jobs, 7);
        let entries = run(&plan, &builder());
        all_pass(&entries, "default");
        let order: Vec<Target> = entries.iter().map(|e| e.target).collect();
        (order, counts(&entries))
    };
    let one = with(1);
    assert_eq!(with(3), one);
    assert!(one.0.is_sorted_by_key(|t| Target::ALL.iter().position(|a| a == t)));
}
