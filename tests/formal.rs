//! Formal proofs: the short set holds as recorded; every property has a sentence, a record and a bug that
//! it catches; what is proved without registers is not proved of a bug; netlists are their Verilog.

use std::path::Path;
use std::time::Duration;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::prove::record::{Extent, Proved, Record};
use wheatstone_testbench::prove::{properties, Bug, Catch, Effort, Prover, Verdict, BUGS};
use wheatstone_testbench::tools::PYTHON_TOOLS;
use wheatstone_tests::*;

fn prover(rtl: &Path) -> Prover {
    Prover::new(rtl, workspace().join(Prover::CACHE))
}

fn record() -> Record {
    Record::read(workspace()).unwrap_or_else(|error| panic!("{error}"))
}

/// The first build of a module, with the effort of the short set.
fn proved(prover: &Prover, module: &str) -> Proved {
    let effort =
        Effort::quick(module).unwrap_or_else(|| panic!("{module} is not in the short set"));
    let builds = prover.builds(module).unwrap_or_else(|error| panic!("{error}"));
    let proof = prover.prove(&builds[0], effort);
    Proved::of(&builds[0], proof.unwrap_or_else(|error| panic!("{module}: {error}")))
}

#[test]
fn the_short_set_holds() {
    let prover = prover(&rtl());
    let modules = prover.modules().unwrap_or_else(|error| panic!("{error}"));
    let quick = modules.iter().filter(|module| Effort::quick(module).is_some());
    let all: Vec<Proved> = quick.map(|module| proved(&prover, module)).collect();
    assert!(all.len() >= 12, "the short set has {} modules", all.len());
    let failed: Vec<&Proved> = all.iter().filter(|p| p.proof.failed().next().is_some()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    let faults = record().faults(&all, Extent::Short);
    assert!(
        faults.is_empty(),
        "{}\nif this is meant: wheatstone prove --record",
        faults.join("\n")
    );
}

/// A prover with a fake `yosys-smtbmc`: a shell script that sees its arguments in `$*`.
fn prover_with(fake: &str, [tools, cache]: [&Path; 2]) -> Prover {
    let program = format!("case \" $* \" in *--help*) echo fake; exit;; esac\n{fake}");
    script(tools, "yosys-smtbmc", &program);
    let usual = std::env::var_os("PATH").unwrap_or_default();
    let own = workspace().join(PYTHON_TOOLS).join("bin");
    let path = [tools.to_owned()].into_iter().chain(std::env::split_paths(&usual)).chain([own]);
    let path = std::env::join_paths(path).expect("a list of folders");
    Prover::new(rtl(), cache).with(path, Duration::from_millis(100))
}

/// A prover is stopped when it has used up its processor time: what it leaves open is told as stopped, whatever
/// another one has proved of so many clocks, and is not kept.
#[test]
fn what_was_cut_short_is_told_and_not_kept() {
    let (tools, cache) = (folder(), folder());
    let kept = || {
        let entries = std::fs::read_dir(cache.path()).expect("the cache");
        entries.filter(|entry| entry.as_ref().is_ok_and(|entry| entry.path().is_file())).count()
    };
    let induction = "case \" $* \" in *' -i '*) while :; do :; done;; esac";
    let [passes, hangs] = ["echo Status: PASSED", "while :; do :; done"];
    for (fake, clocks) in [(format!("{induction}\n{passes}"), 4), (hangs.to_owned(), 0)] {
        let prover = prover_with(&fake, [tools.path(), cache.path()]);
        let stopped = proved(&prover, "stage");
        assert_eq!(stopped.verdict("data"), Some(Verdict::Stopped(clocks)), "{stopped:?}");
        assert!(stopped.proof.was_stopped() && stopped.proof.seconds > 0.1, "{stopped:?}");
        assert_eq!(kept(), 0);
        let faults = record().faults(&[stopped], Extent::Short).join("\n");
        let told = "stage (default, paper, full): p_data: stopped";
        assert!(faults.contains(told) && !faults.contains("always"), "{faults}");
    }
    // Nothing of it is believed later.
    let whole = proved(&Prover::new(rtl(), cache.path()), "stage");
    assert_eq!(whole.verdict("data"), Some(Verdict::Induction(2)), "{whole:?}");
    assert_eq!(kept(), 1);
}

/// All properties together may be too much for as many clocks as each of them is tried for alone: nothing is lost
/// where they then are.
#[test]
fn what_is_tried_again_alone_was_not_cut_short() {
    let (tools, cache) = (folder(), folder());
    let together = tools.path().join("together");
    let fake = format!(
        "case \" $* \" in *' -i '*) echo Status: FAILED; exit 1;; esac\n\
         test -e '{0}' && {{ echo Status: PASSED; exit; }}\n: >'{0}'; while :; do :; done",
        together.display()
    );
    let found = proved(&prover_with(&fake, [tools.path(), cache.path()]), "stage");
    assert_eq!(found.verdict("data"), Some(Verdict::Bounded(4)), "{found:?}");
    assert!(!found.proof.was_stopped() && together.exists(), "{found:?}");
}

/// A solver that fails is no prover that was stopped.
#[test]
fn a_prover_that_fails_is_an_error() {
    let (tools, cache) = (folder(), folder());
    let prover = prover_with(
        "echo Unexpected EOF response from solver.; exit 1",
        [tools.path(), cache.path()],
    );
    let builds = prover.builds("stage").expect("builds");
    let error = prover.prove(&builds[0], Effort::of("stage")).unwrap_err().to_string();
    assert!(error.contains("yosys-smtbmc failed on sam_stage"), "{error}");
    assert!(error.contains("Unexpected EOF"), "{error}");
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
    assert_eq!(record.proofs.iter().find(|proved| proved.proof.failed().next().is_some()), None);
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
