//! The loop finds what it should: passes, differences, broken protocol, models that hang.

mod common;

use common::*;
use wheatstone_golden::interface::Table;
use wheatstone_testbench::{
    Bench, Fault, Job, JobError, Mismatch, Outcome, Pattern, Responder, Stalls,
};

fn back_pressure(pattern: Pattern) -> Stalls {
    Stalls { idle: Pattern::None, back_pressure: pattern, seed: 5 }
}

fn mismatch(outcome: Outcome) -> Mismatch {
    match outcome {
        Outcome::Mismatch(mismatch) => *mismatch,
        other => panic!("expected a mismatch, got: {other}"),
    }
}

#[test]
fn a_good_model_passes_under_every_stall() {
    let sums = sums(3_000, 1);
    for stalls in Stalls::crossed(9) {
        let outcome = run_adder(0, &sums, stalls);
        let counts = outcome.passed().unwrap_or_else(|| panic!("{stalls:?}: {outcome}"));
        assert_eq!(counts.compared(), 3_000);
        assert_eq!(counts.stream("term").unwrap().accepted, 3_000);
        if stalls.idle == Pattern::None && stalls.back_pressure == Pattern::None {
            assert_eq!(counts.clocks, 3_001, "one beat a clock, latency 1");
            assert_eq!(counts.stream("term").unwrap().throughput(), 1.0);
            assert_eq!(counts.stream("sum").unwrap().first, Some(1));
        }
    }
}

#[test]
fn a_wrong_value_is_found_on_its_beat_field_and_cycle() {
    let sums = sums(500, 2);
    let found = mismatch(run_adder(1, &sums, Stalls::NONE));
    assert_eq!((&found.fault, found.place.to_string().as_str()), (&Fault::Value, "sum"));
    assert_eq!((found.beat, found.cycle), (100, 101));
    let [difference] = &found.differences[..] else { panic!("{found}") };
    assert_eq!(difference.field.name, "value");
    assert_eq!(difference.expected ^ difference.actual, 0x20);
    assert_eq!(found.expected, sums.sum.row(100));
    // The beat is the same whatever the stalls; the cycle is not.
    let stalled = mismatch(run_adder(1, &sums, back_pressure(Pattern::Random75)));
    assert_eq!((stalled.beat, &stalled.differences), (100, &found.differences));
    assert!(stalled.cycle > 101);
}

#[test]
fn a_model_that_stops_taking_beats_hangs() {
    let sums = sums(500, 3);
    let Outcome::Hung(hung) = run_adder(2, &sums, Stalls::NONE) else { panic!("not hung") };
    assert_eq!((hung.streams[0].done, hung.streams[0].total), (100, Some(500)));
    assert!(hung.streams[0].valid && !hung.streams[0].ready && !hung.streams[1].valid);
    let text = hung.to_string();
    assert!(text.contains("term 100/500 (valid 1, ready 0), sum 100/500"), "{text}");
}

#[test]
fn a_lost_beat_is_a_difference_and_at_the_end_a_hang() {
    let found = mismatch(run_adder(8, &sums(500, 3), Stalls::NONE));
    assert_eq!(found.beat, 100);
    let outcome = run_adder(8, &sums(101, 3), Stalls::NONE);
    let Outcome::Hung(hung) = outcome else { panic!("{outcome}") };
    assert_eq!((hung.streams[0].done, hung.streams[1].done), (101, 100));
}

#[test]
fn finish_assertions_and_endless_loops_end_the_run_not_the_process() {
    for (bug, text) in [(3, "$finish at "), (7, "count is 100"), (9, "converge")] {
        let found = mismatch(run_adder(bug, &sums(500, 4), Stalls::NONE));
        let Fault::Stopped(why) = &found.fault else { panic!("{found}") };
        assert!(why.contains(text) && why.contains("sam_adder.v:"), "{why}");
        assert!((99..103).contains(&found.cycle), "{found}");
    }
}

#[test]
fn a_payload_that_changes_while_it_waits_is_found() {
    let found = mismatch(run_adder(4, &sums(500, 5), back_pressure(Pattern::Bursts)));
    assert_eq!(found.fault, Fault::Unstable);
    assert!(found.beat >= 100, "{found}");
    assert_eq!(found.differences[0].field.name, "rgba");
}

#[test]
fn a_beat_that_is_taken_back_is_found() {
    let found = mismatch(run_adder(5, &sums(500, 6), back_pressure(Pattern::Bursts)));
    assert_eq!(found.fault, Fault::Withdrawn);
    assert!(found.beat >= 100, "{found}");
}

#[test]
fn an_output_that_waits_for_ready_hangs() {
    let sums = sums(500, 6);
    let patient = run_adder(11, &sums, back_pressure(Pattern::Random75));
    assert!(patient.passed().is_some(), "no beat shows it: {patient}");
    let Outcome::Hung(hung) = run_adder(11, &sums, back_pressure(Pattern::UntilValid)) else {
        panic!("not hung")
    };
    assert_eq!((hung.streams[1].done, hung.streams[1].valid), (100, false));
}

#[test]
fn a_beat_too_many_is_found() {
    let found = mismatch(run_adder(6, &sums(100, 7), Stalls::NONE));
    assert_eq!((&found.fault, found.beat), (&Fault::Surplus, 100));
    assert!(found.expected.is_empty());
}

#[test]
fn a_wrong_flag_is_found_at_the_end() {
    let found = mismatch(run_adder(10, &sums(500, 8), Stalls::NONE));
    assert_eq!((&found.fault, found.place.to_string().as_str()), (&Fault::Flag, "error"));
    assert_eq!((found.differences[0].expected, found.differences[0].actual), (1, 0));
}

#[test]
fn a_unit_inside_a_system_is_named() {
    let sums = sums(500, 9);
    let watched =
        [Some(&sums.term), Some(&sums.sum), Some(&sums.second_term), Some(&sums.second_sum)];
    let run = |bug| {
        let library = model(&chain(bug), &probes());
        let mut bench = Bench::new(&library, 1).unwrap();
        let stalls = Stalls { idle: Pattern::Gaps, back_pressure: Pattern::Random50, seed: 3 };
        let job = Job {
            statics: &[BIAS],
            tables: &[Some(&sums.term), Some(&sums.second_sum)],
            flags: &[sums.error],
            probes: &watched,
            stalls,
            ..Job::default()
        };
        bench.run(&job).unwrap()
    };
    let outcome = run(0);
    let counts = outcome.passed().unwrap_or_else(|| panic!("{outcome}"));
    assert_eq!((counts.compared(), counts.probed), (500, 2_000));
    let found = mismatch(run(1));
    assert_eq!(found.place.to_string(), "u_first.sum");
    assert_eq!((found.beat, found.differences[0].field.name), (100, "value"));
    let outcome = run(2);
    let Outcome::Hung(hung) = &outcome else { panic!("{outcome}") };
    assert_eq!(hung.streams.len(), 6);
    let text = outcome.to_string();
    assert!(text.contains("u_first.term 100/500 (valid 1, ready 0)"), "{text}");
}

/// Answers a read of address x with 3 x, some clocks later.
struct Memory {
    due: std::collections::VecDeque<(u64, u64)>,
    pixels: u64,
}

impl Responder for Memory {
    fn accepted(&mut self, stream: usize, cycle: u64, row: &[u64]) {
        match stream {
            1 => self.due.push_back((cycle + 5 + row[0] % 4, 3 * row[0])),
            _ => self.pixels += 1,
        }
    }

    fn respond(&mut self, stream: usize, cycle: u64, row: &mut [u64]) -> bool {
        assert_eq!(stream, 2);
        let ready = self.due.front().is_some_and(|(when, _)| *when <= cycle);
        if ready {
            row[0] = self.due.pop_front().map_or(0, |(_, data)| data);
        }
        ready
    }
}

#[test]
fn requests_are_answered_by_a_table_or_by_a_memory() {
    let interface = reader();
    let library = model(&interface, &[]);
    let mut tables: Vec<Table> =
        interface.streams.iter().map(|stream| Table::new(&stream.fields)).collect();
    let mut random = fastrand::Rng::with_seed(11);
    for _ in 0..2_000 {
        let x = random.u64(..4096);
        tables[0].push_row(&[x]);
        tables[1].push_row(&[x]);
        tables[2].push_row(&[3 * x]);
        tables[3].push_row(&[x, 3 * x]);
    }
    for stalls in Stalls::crossed(4) {
        let given: Vec<Option<&Table>> = tables.iter().map(Some).collect();
        let mut bench = Bench::new(&library, 2).unwrap();
        let outcome = bench.run(&Job { tables: &given, stalls, ..Job::default() }).unwrap();
        let counts = outcome.passed().unwrap_or_else(|| panic!("{stalls:?}: {outcome}"));
        let answers = (counts.stream("request").unwrap(), counts.stream("response").unwrap());
        assert!(answers.0.first < answers.1.first, "an answer came before its request");

        let mut memory = Memory { due: Default::default(), pixels: 0 };
        let mut given = given;
        given[2] = None;
        let job = Job { tables: &given, stalls, ..Job::default() };
        let outcome = bench.run_with(&job, &mut memory).unwrap();
        assert!(outcome.passed().is_some(), "{stalls:?}: {outcome}");
        assert_eq!((memory.pixels, memory.due.len()), (2_000, 0));
        assert_eq!(bench.run(&job), Err(JobError::NoStimulus("response")));

        // Nothing compared: the memory still gets what was sent.
        let job = Job { tables: &[Some(&tables[0]), None, None, None], stalls, ..Job::default() };
        let mut memory = Memory { due: Default::default(), pixels: 0 };
        assert!(bench.run_with(&job, &mut memory).unwrap().passed().is_some());
        assert_eq!((memory.pixels, memory.due.len()), (2_000, 0));
    }
}

#[test]
fn runs_follow_one_another_and_a_reset_can_come_at_any_time() {
    let sums = sums(300, 12);
    let library = model(&adder(0), &[]);
    let mut bench = Bench::new(&library, 3).unwrap();
    let tables = [Some(&sums.term), Some(&sums.sum)];
    let stalls = Stalls { idle: Pattern::None, back_pressure: Pattern::Random50, seed: 1 };
    let job = Job { statics: &[BIAS], tables: &tables, stalls, ..Job::default() };
    let first = bench.run(&job).unwrap();
    assert!(first.passed().is_some());
    assert!(bench.cycle() > 300);
    assert!(bench.run(&job).unwrap().passed().is_some(), "a second part without a reset");
    // A wrong table leaves the model in the middle of its work.
    let wrong = common::sums(300, 13);
    let tables = [Some(&sums.term), Some(&wrong.sum)];
    assert!(bench.run(&Job { tables: &tables, ..job }).unwrap().passed().is_none());
    bench.reset();
    assert!(bench.run(&job).unwrap().passed().is_some(), "after a reset");
}

#[test]
fn a_job_that_does_not_fit_is_refused() {
    let sums = sums(3, 1);
    let library = model(&adder(0), &[]);
    let mut bench = Bench::new(&library, 3).unwrap();
    let tables = [Some(&sums.term), Some(&sums.sum)];
    let job = Job { statics: &[BIAS], tables: &tables, ..Job::default() };
    let error = bench.run(&Job { statics: &[], ..job }).unwrap_err();
    assert_eq!(error.to_string(), "static inputs: 0 given, the interface has 1");
    let error = bench.run(&Job { tables: &tables[1..], ..job }).unwrap_err();
    assert_eq!(error.to_string(), "tables of streams: 1 given, the interface has 2");
    let error = bench.run(&Job { tables: &[Some(&sums.sum), None], ..job }).unwrap_err();
    assert_eq!(error.to_string(), "table of stream term has 5 fields, the interface has 6");
    assert_eq!(
        bench.run(&Job { probes: &[None], ..job }).unwrap_err().to_string(),
        "tables of probes: 1 given, the interface has 0"
    );
}

#[test]
fn models_are_independent_and_reproducible() {
    let sums = sums(2_000, 14);
    let library = model(&adder(1), &[]);
    let run = |seed: u64| {
        let mut bench = Bench::new(&library, seed).unwrap();
        let stalls = Stalls { idle: Pattern::Random50, back_pressure: Pattern::Random50, seed };
        let state = bench.model().port("sum_value_o").unwrap();
        let tables = [Some(&sums.term), Some(&sums.sum)];
        let job = Job { statics: &[BIAS], tables: &tables, stalls, ..Job::default() };
        (state, bench.run(&job).unwrap())
    };
    let alone: Vec<_> = (0..8).map(run).collect();
    let distinct: std::collections::BTreeSet<u64> = alone.iter().map(|(state, _)| *state).collect();
    assert!(distinct.len() > 6, "registers do not start from random values: {distinct:?}");
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|seed| scope.spawn(move || run(seed))).collect();
        for (thread, alone) in threads.into_iter().zip(&alone) {
            assert_eq!(&thread.join().unwrap(), alone);
        }
    });
    // Two models that stop, in one thread, do not take each other's message.
    let finish = model(&adder(3), &[]);
    let mut stopped = Bench::new(&finish, 1).unwrap();
    let mut other = Bench::new(&finish, 2).unwrap();
    let tables = [Some(&sums.term), None];
    let job = Job { statics: &[BIAS], tables: &tables, ..Job::default() };
    assert!(stopped.run(&job).unwrap().passed().is_none());
    assert!(stopped.model().stopped().is_some() && other.model().stopped().is_none());
    assert!(stopped.run(&job).unwrap().passed().is_none(), "a stopped model stays stopped");
    drop(stopped);
    assert_eq!(
        mismatch(other.run(&job).unwrap()).cycle,
        mismatch(run_adder(3, &sums, Stalls::NONE)).cycle
    );
}
