//! Waveforms are readable and their views show every signal.

mod common;

use common::*;
use std::fs;
use wheatstone_golden::interface::Interface;
use wheatstone_testbench::waves::{write_views, View, ViewFiles, WaveError};
use wheatstone_testbench::{Bench, Job, Outcome, Pattern, Probe, Stalls, TraceWindow};

/// Runs a module with a trace of cycles 90 to 130 and writes the views.
fn traced(folder: &std::path::Path, interface: &Interface, units: &[Probe]) -> ViewFiles {
    let sums = sums(500, 1);
    let library = model(interface, &[]);
    let mut bench = Bench::new(&library, 1).unwrap();
    let path = folder.join(format!("{}.fst", interface.target));
    let window = TraceWindow { path: path.clone(), from_cycle: 90, to_cycle: 130 };
    bench.trace(&window).unwrap();
    let expected = if interface.target == "adder" { &sums.sum } else { &sums.second_sum };
    let tables = [Some(&sums.term), Some(expected)];
    let job = Job { statics: &[BIAS], tables: &tables, ..Job::default() };
    let outcome = bench.run(&job).unwrap();
    drop(bench);
    let marker = match outcome {
        Outcome::Mismatch(mismatch) => Some(mismatch.cycle),
        _ => None,
    };
    let marker = marker.map(|cycle| (cycle, "first mismatch"));
    write_views(&path, &View { interface, units, marker }).unwrap()
}

#[test]
fn a_dump_has_the_window_and_the_values_of_the_tables() {
    let folder = tempfile::tempdir().unwrap();
    traced(folder.path(), &adder(0), &[]);
    let mut waveform = wellen::simple::read(folder.path().join("adder.fst")).unwrap();
    let times = waveform.time_table().to_vec();
    assert_eq!((times.first(), times.last()), (Some(&900), Some(&1305)));
    let hierarchy = waveform.hierarchy();
    let id = hierarchy.lookup_var(&["TOP", "sam_adder"], "sum_value_o").unwrap();
    let signal = hierarchy[id].signal_ref();
    waveform.load_signals(&[signal]);
    let signal = waveform.get_signal(signal).unwrap();
    let sums = sums(500, 1);
    for cycle in 90..=130u64 {
        let index = times.iter().position(|t| *t == TraceWindow::time(cycle)).unwrap();
        let offset = signal.get_offset(index as u32).unwrap();
        let bits = signal.get_value_at(&offset, 0).to_bit_string().unwrap();
        let value = u64::from_str_radix(&bits, 2).unwrap();
        // Without stalls and with a latency of one clock, beat n leaves in cycle n + 1.
        assert_eq!(value, sums.sum.row(cycle as usize - 1)[1], "cycle {cycle}");
    }
}

#[test]
fn views_group_the_streams_and_mark_the_mismatch() {
    let folder = tempfile::tempdir().unwrap();
    let files = traced(folder.path(), &chain(1), &probes());
    assert_eq!(files.missing, Vec::<String>::new());
    assert_eq!(files.signals, 4 + 3 * (8 + 7));
    let text = fs::read_to_string(&files.gtkwave).unwrap();
    for part in [
        "@200\n-sam_chain\n@28\nTOP.sam_chain.clk_i\n",
        "@40000420\n[fpshift_count] 14\nTOP.sam_chain.term_a_i[24:0]\n",
        "@200\n-g_second.u_adder.sum\n@28\nTOP.sam_chain.g_second.u_adder.sum_valid_o\n",
        "TOP.sam_chain.u_first.sum_rgba_o[31:0]\n",
        "[markername_long] A first mismatch\n",
        "*-4.7 1025 1025 -1",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    let filter = text.lines().find_map(|line| line.strip_prefix("^1 ")).unwrap();
    assert!(fs::read_to_string(filter).unwrap().starts_with("00 ADD\n01 SUBTRACT\n"));
    let text = fs::read_to_string(&files.surfer).unwrap();
    for part in ["divider_add u_first.term\n", "cursor_set 1025\nmarker_set first_mismatch 1025\n"]
    {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
}

#[test]
fn an_unfinished_or_empty_dump_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let library = model(&adder(0), &[]);
    let path = folder.path().join("x.fst");
    let interface = adder(0);
    let view = View { interface: &interface, units: &[], marker: None };
    assert!(matches!(write_views(&path, &view), Err(WaveError::Dump { .. })));
    let mut bench = Bench::new(&library, 1).unwrap();
    let window = TraceWindow { path: path.clone(), from_cycle: 90, to_cycle: 130 };
    bench.trace(&window).unwrap();
    assert!(matches!(write_views(&path, &view), Err(WaveError::Empty(_))), "not closed");
    bench.close_trace();
    assert!(matches!(write_views(&path, &view), Err(WaveError::Empty(_))), "never reached");
    let nowhere = TraceWindow { path: folder.path().join("no/x.fst"), ..window };
    let error = bench.trace(&nowhere).unwrap_err().to_string();
    assert!(error.contains("cannot write the waveform"), "{error}");
}

#[test]
fn a_trace_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let sums = sums(500, 3);
    let library = model(&chain(4), &probes());
    let run = |window: Option<TraceWindow>| {
        let mut bench = Bench::new(&library, 8).unwrap();
        if let Some(window) = window {
            bench.trace(&window).unwrap();
        }
        let tables = [Some(&sums.term), Some(&sums.second_sum)];
        let probes = [Some(&sums.term), None, None, Some(&sums.second_sum)];
        let stalls = Stalls { idle: Pattern::Gaps, back_pressure: Pattern::Random75, seed: 8 };
        let (statics, tables, probes) = (&[BIAS][..], &tables, &probes);
        bench.run(&Job { statics, tables, probes, stalls, ..Job::default() }).unwrap()
    };
    let untraced = run(None);
    assert!(matches!(untraced, Outcome::Mismatch(_)), "{untraced}");
    for (from_cycle, to_cycle) in [(0, u64::MAX), (300, 350)] {
        let path = folder.path().join(format!("{from_cycle}.fst"));
        assert_eq!(run(Some(TraceWindow { path, from_cycle, to_cycle })), untraced);
    }
}

#[test]
fn a_second_dump_of_the_same_bench_works() {
    let folder = tempfile::tempdir().unwrap();
    let sums = sums(100, 1);
    let library = model(&adder(0), &[]);
    let mut bench = Bench::new(&library, 1).unwrap();
    let tables = [Some(&sums.term), Some(&sums.sum)];
    let job = Job { statics: &[BIAS], tables: &tables, ..Job::default() };
    for name in ["a.fst", "b.fst"] {
        let from_cycle = bench.cycle();
        let path = folder.path().join(name);
        let window = TraceWindow { path: path.clone(), from_cycle, to_cycle: u64::MAX };
        bench.trace(&window).unwrap();
        assert!(bench.run(&job).unwrap().passed().is_some());
        bench.close_trace();
        let waveform = wellen::simple::read(&path).unwrap();
        assert_eq!(waveform.time_table().first(), Some(&(10 * from_cycle)));
    }
}
