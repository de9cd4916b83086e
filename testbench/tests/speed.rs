//! The loop, with all its checks, is nearly as fast as one in C++ that checks nothing.
//!
//! `cargo bench -p wheatstone-testbench` holds the figure that is promised, 0.8; the limit here
//! is lower, so that it fails for a slow loop and not for a busy machine.

use std::path::{Path, PathBuf};
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::{Direction, Table};
use wheatstone_golden::targets::Target;
use wheatstone_testbench::regression::model_probes;
use wheatstone_testbench::tools::Toolchain;
use wheatstone_testbench::{cases, compare_speed, Builder, Job, Pattern, Spec, Speed, Stalls};

/// Speeds of a target's model on random beats; a system with the streams of all its units.
fn measure(target: Target, beats: usize, pattern: Pattern) -> Speed {
    let workspace = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
    let builder = Builder::new(Toolchain::find().expect("tools"), workspace.join(Builder::CACHE));
    let config = Config::DEFAULT;
    let case = cases::random(target, &config, 1, beats);
    let (interface, units) = (case.interface(), model_probes(target, &config));
    let rtl: &Path = &workspace.join("rtl");
    let spec = Spec { interface: &interface, rtl, probes: &units };
    let library = builder.build(&spec).expect("a model");
    let (mut inputs, mut outputs) = (case.inputs.iter(), case.outputs.iter());
    let mut next = |direction| match direction {
        Direction::Input => inputs.next(),
        Direction::Output => outputs.next(),
    };
    let tables: Vec<Option<&Table>> =
        interface.streams.iter().map(|stream| next(stream.direction)).collect();
    let probes: Vec<Option<&Table>> = case.probes.iter().map(|(_, table)| Some(table)).collect();
    let stalls = Stalls { idle: pattern, back_pressure: pattern, seed: 1 };
    let (statics, flags) = (&case.statics[..], &case.flags[..]);
    let job = Job { statics, tables: &tables, flags, probes: &probes, stalls, ..Job::default() };
    // Short rounds, the best of many: other work on the machine disturbs most, not all.
    compare_speed(&library, &job, 60).expect("all beats equal")
}

#[test]
fn checking_everything_costs_little() {
    for (target, beats) in
        [(Target::XInterpolator, 40_000), (Target::Filter, 40_000), (Target::Hybrid, 6_000)]
    {
        for pattern in [Pattern::None, Pattern::Random50] {
            let speed = measure(target, beats, pattern);
            let (rust, cpp) = (speed.rust / 1e6, speed.cpp / 1e6);
            let (name, ratio) = (target.name(), speed.ratio());
            let stalls = pattern.name();
            println!("{name}, stalls {stalls}: {rust:.1} M clocks/s, C++ {cpp:.1}: {ratio:.2}");
            assert!(ratio >= 0.6, "{name}, stalls {stalls}: {ratio:.2} of the C++ loop");
        }
    }
}
