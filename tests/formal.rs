//! Formal proofs: the short set holds as recorded; every property has a sentence, a record and a bug that
//! it catches; what is proved without registers is not proved of a bug; netlists are their Verilog.

use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::prove::record::{Clocks, Proved, Record};
use wheatstone_testbench::prove::{properties, Bug, Catch, Effort, Prover, Verdict, BUGS};
use wheatstone_tests::*;

fn prover(rtl: &Path) -> Prover {
    Prover { rtl: rtl.to_owned(), cache: workspace().join(Prover::CACHE) }
}

fn record() -> Record {
    Record::read(workspace()).unwrap_or_else(|error| panic!("{error}"))
}

/// The first build of a module, with the effort of the short set.
fn proved(prover: &Prover, module: &str) -> Proved {
    let builds = prover.builds(module).unwrap_or_else(|error| panic!("{error}"));
    let proof = prover.prove(&builds[0], Effort::of(module).quick());
    Proved::of(&builds[0], proof.unwrap_or_else(|error| panic!("{module}: {error}")))
}

#[test]
fn the_short_set_holds() {
    let prover = prover(&rtl());
    let modules = prover.modules().unwrap_or_else(|error| panic!("{error}"));
    let quick = modules.iter().filter(|module| Effort::is_quick(module));
    let all: Vec<Proved> = quick.map(|module| proved(&prover, module)).collect();
    assert!(all.len() >= 12, "the short set has {} modules", all.len());
    let fails = |proved: &&Proved| {
        proved.proof.verdicts.values().any(|verdict| matches!(verdict, Verdict::Fails(_)))
    };
    let failed: Vec<&Proved> = all.iter().filter(fails).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let faults = record().faults(&all, Clocks::Ignore);
    assert!(
        faults.is_empty(),
        "{}\nif this is meant: wheatstone prove --record",
        faults.join("\n")
    );
}

#[test]
fn every_module_has_properties_with_sentences_a_record_and_bugs() {
    let prover = prover(&rtl());
    let record = record();
    let mut faults = Vec::new();
    for module in modules() {
        let module = module.strip_prefix("sam_").unwrap_or(&module).to_owned();
        let text = prover.text(&module).unwrap_or_else(|error| panic!("{error}"));
        let properties = properties(&text);
        if properties.is_empty() {
            faults.push(format!("{module} has no property"));
        }
        for property in properties {
            let name = &property.name;
            if property.sentence.is_empty() {
                faults.push(format!("{module}, {name}: no sentence"));
            }
            if !BUGS.iter().any(|bug| bug.module == module && bug.property == name) {
                faults.push(format!("{module}, {name}: no bug"));
            }
            let mut proofs = record.proofs.iter().filter(|proved| proved.module == module);
            if !proofs.any(|proved| proved.verdict(name).is_some()) {
                faults.push(format!("{module}, {name}: no record"));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    let fails = |proved: &&Proved| {
        proved.proof.verdicts.values().any(|verdict| matches!(verdict, Verdict::Fails(_)))
    };
    assert_eq!(record.proofs.iter().find(fails), None);
}

/// Bugs that show in no time; `wheatstone prove --bugs` plants all.
#[test]
fn properties_catch_their_bugs() {
    let prover = prover(&rtl());
    let few = |bug: &&Bug| ["x_interpolator", "redirect", "traversal"].contains(&bug.module);
    for bug in BUGS.iter().filter(few) {
        let caught = prover.catches(bug).unwrap_or_else(|error| panic!("{error}"));
        assert!(matches!(caught, Catch::At(_)), "not caught: {bug:?}");
    }
}

#[test]
fn a_text_without_a_bug_in_it_is_not_caught() {
    let bug = BUGS[0];
    let harmless = Bug { replace: bug.find, ..bug };
    let caught = prover(&rtl()).catches(&harmless).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(caught, Catch::Not);
    let absent = Bug { find: "nowhere in the file", ..bug };
    let error = prover(&rtl()).catches(&absent).unwrap_err().to_string();
    assert!(error.contains("the text occurs 0 times, not once"), "{error}");
}

/// Modules without registers are proved in a way of their own, which must not prove everything.
#[test]
fn what_has_no_registers_and_is_wrong_is_not_proved() {
    let copy = copy_of_rtl();
    plant(
        copy.path(),
        "sam_coverage.v",
        "coverage_centre_o = centre",
        "coverage_centre_o = ~centre",
    );
    let wrong = proved(&prover(copy.path()), "coverage");
    assert!(matches!(wrong.verdict("centre"), Some(Verdict::Fails(_))), "{wrong:?}");
    assert!(!matches!(wrong.verdict("area"), Some(Verdict::Fails(_))), "{wrong:?}");
}

#[test]
fn netlists_are_the_verilog() {
    for target in [Target::XInterpolator, Target::Redirect, Target::Filter] {
        let equivalence = prover(&rtl()).equivalence(target, &Config::PAPER);
        let equivalence = equivalence.unwrap_or_else(|error| panic!("{error}"));
        assert!(equivalence.closes(), "{}: {equivalence:?}", target.name());
    }
}
