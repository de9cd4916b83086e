//! Mutation: the regression of a small unit notices its mutants, what is proved equivalent is, and a
//! regression that does little scores low; the record is whole and its scores are high. All units:
//! `wheatstone mutate`.

use std::path::PathBuf;
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Table;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::mutation::record::{Reviews, Score, Scores};
use wheatstone_testbench::mutation::{
    golden, is_usual, regression, usual_config, Fate, Mutated, MutationError, Run, Verdict, COUNT,
    SEED,
};
use wheatstone_testbench::synth::Synthesiser;
use wheatstone_tests::*;

const TARGET: Target = Target::Display;
const CONFIG: Config = Config::DEFAULT;

fn scores() -> Scores {
    Scores::read(workspace()).unwrap_or_else(|error| panic!("{error}"))
}

fn mutated(rtl: PathBuf) -> Mutated {
    let cache = workspace().join(Synthesiser::CACHE);
    let mutated = Mutated::new(&builder(), [rtl, cache], (TARGET, &CONFIG), (COUNT, SEED));
    mutated.unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_regression_notices_mutants_and_as_many_as_recorded() {
    let mutated = mutated(rtl());
    let reviews = Reviews::read(workspace()).unwrap_or_else(|error| panic!("{error}"));
    let reason = |mutant: &_| reviews.reason(TARGET, "default", mutant);
    let tested = mutated.test(regression(TARGET, &CONFIG, None), reason).expect("it runs");
    let score = Score::new(TARGET, "default", SEED, &tested);
    assert!(score.passes() && score.mutants() == COUNT as usize, "{score:?}");
    assert_eq!(reviews.stale(TARGET, "default", &tested), [] as [&_; 0]);
    assert!(
        scores().all().contains(&score),
        "wheatstone mutate --record, then generate: {score:?}"
    );
    // The proof and the simulation agree on those that the simulation killed.
    let killed = tested.iter().filter(|t| matches!(t.fate, Fate::Killed(_)));
    for tested in killed.step_by(12) {
        let verdict = mutated.compare(&tested.mutant).expect("ABC runs");
        assert_eq!(verdict, Verdict::Different, "{}", tested.mutant);
    }
}

#[test]
fn the_record_has_every_usual_target_and_every_golden_unit() {
    let usual = Target::ALL.into_iter().filter(|t| is_usual(*t)).map(|t| (t, usual_config(t)));
    let units =
        Target::ALL.into_iter().filter(|t| golden::is_unit(*t)).map(|t| (t, golden::CONFIG));
    for (target, config) in usual.chain(units) {
        let is_it = |score: &&Score| score.target == target.name() && score.config == config;
        let rows = scores().all().iter().filter(is_it).count();
        assert_eq!(
            rows,
            1,
            "{} {config}: run wheatstone mutate --record, with --golden or without",
            target.name()
        );
    }
}

#[test]
fn the_recorded_scores_are_high_and_of_many_mutants() {
    for score in scores().all() {
        let is_golden = score.config == golden::CONFIG;
        assert!(is_golden || score.mutants() >= COUNT as usize, "{score:?}: so few mutants");
        assert_eq!(score.low(), None);
    }
}

#[test]
fn a_regression_without_beats_scores_low() {
    let mutated = mutated(rtl());
    let runs = regression(TARGET, &CONFIG, Some(0)).map(|mut run: Run| {
        let tables = run.case.inputs.iter_mut().chain(&mut run.case.outputs);
        let fields = TARGET.interface(&CONFIG).streams.into_iter().map(|stream| stream.fields);
        tables.zip(fields).for_each(|(table, fields)| *table = Table::new(&fields));
        run
    });
    let killed = mutated.kill(runs).expect("it runs").iter().flatten().count();
    assert!((1..COUNT as usize / 10).contains(&killed), "killed {killed}");
}

#[test]
fn a_target_that_fails_by_itself_is_told() {
    let copy = copy_of_rtl();
    plant(copy.path(), "sam_display.v", "width_i + ~point_x_i", "width_i - point_x_i");
    let error = mutated(copy.path().into()).kill(regression(TARGET, &CONFIG, None)).unwrap_err();
    assert!(matches!(&error, MutationError::Unsound { .. }), "{error}");
    let told = "the netlist of display fails without a mutant, in the case every mode, width 1: ";
    assert!(error.to_string().starts_with(told), "{error}");
}
