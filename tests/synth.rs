//! Synthesis: gates are those of the committed record and, of units in the paper's configuration, no
//! more than published; a unit that grows is noticed.

use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::synth::record::{published, Entry, Record, FLOORS};
use wheatstone_testbench::synth::{Figure, Synthesiser, Tech};
use wheatstone_tests::*;

/// The gates of a target whose Verilog is in `rtl`.
fn gates(rtl: &Path, target: Target, config: &str) -> Entry {
    let cache = workspace().join(Synthesiser::CACHE);
    let synthesiser = Synthesiser { rtl: rtl.to_owned(), cache };
    let built = Config::named(config).expect("a named configuration");
    let figures = synthesiser.measure(target, &built, Tech::Gates);
    let figures = figures.unwrap_or_else(|error| panic!("{error}"));
    Entry { target: target.name().into(), config: config.into(), tech: Tech::Gates, figures }
}

fn record() -> Record {
    Record::read(workspace()).unwrap_or_else(|error| panic!("{error}"))
}

/// Units, and the smaller systems: the larger ones take minutes, and `wheatstone synth --check` in scripts/long.
fn is_small(target: &Target) -> bool {
    !matches!(target, Target::Hybrid | Target::Mono | Target::Stereo)
}

/// No target of these is worse than recorded in a configuration.
fn assert_as_recorded(config: &str, targets: impl Fn(&Target) -> bool) {
    let targets = Target::ALL.into_iter().filter(targets);
    let entries: Vec<Entry> = targets.map(|target| gates(&rtl(), target, config)).collect();
    let faults = record().faults(&entries);
    let renew = "if this is meant: wheatstone synth --record, then wheatstone generate";
    assert!(faults.is_empty(), "{}\n{renew}", faults.join("\n"));
}

#[test]
fn gates_of_the_default_configuration_are_as_recorded() {
    assert_as_recorded("default", is_small);
}

#[test]
fn gates_of_the_full_configuration_are_as_recorded() {
    assert_as_recorded("full", is_small);
}

#[test]
fn gates_of_the_paper_configuration_are_as_recorded_and_as_few_as_published() {
    assert_as_recorded("paper", |target| is_small(target) || *target == Target::Hybrid);
    for target in Target::ALL {
        let Some(allowed) = published(target) else { continue };
        let gates = gates(&rtl(), target, "paper").figures[&Figure::Osu035];
        assert!(
            gates <= f64::from(allowed),
            "{}: {gates} gates, published {allowed}",
            target.name()
        );
    }
}

/// Figures of place and route are compared with the record by `wheatstone synth --check`; the record with [`FLOORS`]
/// here.
#[test]
fn the_recorded_clocks_are_those_of_a_board() {
    for (target, config, tech, floor) in FLOORS {
        let clock = record().figure(target, config, tech, Figure::Fmax);
        assert!(clock.is_some_and(|mhz| mhz >= floor), "{target:?} on {tech:?}: {clock:?} MHz");
    }
}

#[test]
fn a_unit_that_grows_is_noticed() {
    let copy = copy_of_rtl();
    plant(
        copy.path(),
        "sam_blend.v",
        "factor_background_q <= pixel_background_i",
        "factor_background_q <= pixel_background_i + pixel_rgb_i",
    );
    let faults = record().faults(&[gates(copy.path(), Target::Blend, "paper")]);
    assert_eq!(faults.len(), 2, "one in each library: {faults:?}");
    assert!(faults[0].starts_with("blend paper gates: OSU 0.35 µm"), "{faults:?}");
}

#[test]
fn what_yosys_refuses_is_told() {
    let copy = copy_of_rtl();
    plant(copy.path(), "sam_blend.v", "colour_tag_o   = colour", "colour_tag_o   = = colour");
    let cache = folder();
    let synthesiser = Synthesiser { rtl: copy.path().into(), cache: cache.path().into() };
    let error = synthesiser.measure(Target::Blend, &Config::PAPER, Tech::Gates).unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("yosys failed on sam_blend:\nsam_blend.v:"), "{text}");
    let left = std::fs::read_dir(cache.path()).expect("the cache").count();
    assert_eq!(left, 0, "nothing half done is left");
}
