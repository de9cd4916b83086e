//! The loop is nearly as fast as one in C++ that checks nothing.

mod common;

use common::*;
use wheatstone_testbench::{compare_speed, Job, Pattern, Stalls};

#[test]
#[ignore]
fn speed() {
    let sums = sums(1_000_000, 1);
    for (label, interface, probes, sum) in [
        ("adder", adder(0), vec![], &sums.sum),
        ("chain", chain(0), vec![], &sums.second_sum),
        ("chain, probed", chain(0), probes(), &sums.second_sum),
    ] {
        let library = model(&interface, &probes);
        let watched =
            [Some(&sums.term), Some(&sums.sum), Some(&sums.second_term), Some(&sums.second_sum)];
        for watch in [false, true] {
            if watch && probes.is_empty() {
                continue;
            }
            for pattern in [Pattern::None, Pattern::Random50] {
                let stalls = Stalls { idle: pattern, back_pressure: pattern, seed: 1 };
                let tables = [Some(&sums.term), Some(sum)];
                let job = Job {
                    statics: &[BIAS],
                    tables: &tables,
                    stalls,
                    probes: if watch { &watched } else { &[] },
                    ..Job::default()
                };
                let speed = compare_speed(&library, &job, 7).unwrap();
                println!(
                    "{label} watched {watch} {}: rust {:.1} M/s, C++ {:.1} M/s, ratio {:.2}",
                    pattern.name(),
                    speed.rust / 1e6,
                    speed.cpp / 1e6,
                    speed.ratio()
                );
            }
        }
    }
}
