//! Interfaces, models and stimulus of the fixtures.
#![allow(dead_code)]

use std::path::PathBuf;
use wheatstone_golden::interface::{Direction, Field, Interface, Kind, Stream, Table};
use wheatstone_testbench::tools::Toolchain;
use wheatstone_testbench::{Bench, Builder, Job, Library, Outcome, Probe, Spec, Stalls};

pub const BIAS: u64 = 0x1f_ff00;

fn field(name: &'static str, bits: u32, kind: Kind) -> Field {
    Field { name, bits, kind, doc: "" }
}

fn stream(
    name: &'static str,
    direction: Direction,
    fields: Vec<Field>,
    answers: Option<&'static str>,
) -> Stream {
    Stream { name, direction, fields, answers }
}

const FIXED: Kind = Kind::Number { signed: true, fraction: 14 };
const NUMBER: Kind = Kind::Number { signed: false, fraction: 0 };
const OP: Kind = Kind::Code(&["ADD", "SUBTRACT", "ADD_TOO", "RESERVED"]);

/// The adder; with `bug` 0 the good one.
pub fn adder(bug: u32) -> Interface {
    let rest = || {
        [field("tag", 40, NUMBER), field("rgba", 32, Kind::Colour), field("last", 1, Kind::Flag)]
    };
    let mut term = vec![field("op", 2, OP), field("a", 25, FIXED), field("b", 25, FIXED)];
    term.extend(rest());
    let mut sum = vec![field("op", 2, OP), field("value", 26, FIXED)];
    sum.extend(rest());
    Interface {
        target: "adder",
        module: "sam_adder",
        parameters: vec![("BUG", bug)],
        statics: vec![field("bias", 25, FIXED)],
        streams: vec![
            stream("term", Direction::Input, term, None),
            stream("sum", Direction::Output, sum, None),
        ],
        flags: vec![field("error", 1, Kind::Flag)],
    }
}

/// The system of two adders; the first has the bug.
pub fn chain(bug: u32) -> Interface {
    Interface { target: "chain", module: "sam_chain", ..adder(bug) }
}

/// Both adders of the chain.
pub fn probes() -> Vec<Probe> {
    vec![Probe::new("u_first", &adder(0)), Probe::new("g_second.u_adder", &adder(0))]
}

/// The reader of a memory.
pub fn reader() -> Interface {
    let x = || field("x", 12, NUMBER);
    let data = || field("data", 24, NUMBER);
    Interface {
        target: "reader",
        module: "sam_reader",
        parameters: Vec::new(),
        statics: Vec::new(),
        streams: vec![
            stream("point", Direction::Input, vec![x()], None),
            stream("request", Direction::Output, vec![x()], None),
            stream("response", Direction::Input, vec![data()], Some("request")),
            stream("pixel", Direction::Output, vec![x(), data()], None),
        ],
        flags: Vec::new(),
    }
}

pub fn fixtures() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

/// A builder with the cache of the workspace.
pub fn builder() -> Builder {
    let cache = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(Builder::CACHE);
    Builder::new(Toolchain::find().unwrap(), cache)
}

/// The model of an interface among the fixtures.
pub fn model(interface: &Interface, probes: &[Probe]) -> Library {
    builder().build(&Spec { interface, rtl: &fixtures(), probes }).unwrap()
}

fn table(fields: &[Field]) -> Table {
    Table::new(fields)
}

/// Beats for the adder and what it makes of them.
pub struct Sums {
    pub term: Table,
    pub sum: Table,
    /// Beats into and out of the second adder of the chain.
    pub second_term: Table,
    pub second_sum: Table,
    pub error: u64,
}

pub fn sums(beats: usize, seed: u64) -> Sums {
    let interface = adder(0);
    let [term, sum] = [0, 1].map(|i| table(&interface.streams[i].fields));
    let mut sums = Sums { second_term: term.clone(), second_sum: sum.clone(), term, sum, error: 0 };
    let mut random = fastrand::Rng::with_seed(seed);
    let signed = |v: u64| ((v << 39) as i64) >> 39;
    for _ in 0..beats {
        let [a, b, tag, rgba, last] = [0; 5].map(|_| random.u64(..));
        let op = random.u64(..16).min(3) & 3;
        sums.error |= u64::from(op == 3);
        let b_signed = if op == 1 { -signed(b) } else { signed(b) };
        let value = (signed(a) + b_signed + signed(BIAS)) as u64;
        sums.term.push_row(&[op, a, b, tag, rgba, last]);
        sums.sum.push_row(&[op, value, tag, rgba, last]);
        let tag = op << 38 | tag & ((1 << 38) - 1);
        sums.second_term.push_row(&[0, value, 3, tag, rgba, last]);
        sums.second_sum.push_row(&[0, (signed(value) + 3) as u64, tag, rgba, last]);
    }
    sums
}

/// Runs the adder with `bug` from the tables.
pub fn run_adder(bug: u32, sums: &Sums, stalls: Stalls) -> Outcome {
    let library = model(&adder(bug), &[]);
    let mut bench = Bench::new(&library, 1).unwrap();
    bench
        .run(&Job {
            statics: &[BIAS],
            tables: &[Some(&sums.term), Some(&sums.sum)],
            flags: &[sums.error],
            stalls,
            ..Job::default()
        })
        .unwrap()
}

/// An empty cache, but for Verilator's runtime, which takes long to compile.
pub fn fresh_cache() -> tempfile::TempDir {
    model(&adder(0), &[]);
    let folder = tempfile::tempdir().unwrap();
    let cache = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(Builder::CACHE);
    for entry in std::fs::read_dir(cache.canonicalize().unwrap()).unwrap() {
        let entry = entry.unwrap();
        let name = entry.file_name();
        if name.to_string_lossy().starts_with("runtime-") && entry.path().is_dir() {
            let copy = folder.path().join(name);
            std::fs::create_dir(&copy).unwrap();
            for file in std::fs::read_dir(entry.path()).unwrap() {
                let file = file.unwrap();
                std::fs::copy(file.path(), copy.join(file.file_name())).unwrap();
            }
        }
    }
    folder
}
