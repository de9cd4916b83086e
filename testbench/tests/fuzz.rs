//! Damaged input of every kind, a little of it; `wheatstone-fuzz` runs as much as is asked for.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_fuzz::{kinds, mutate, Kind, Plan};
use wheatstone_golden::targets::Target;
use wheatstone_testbench::baseline::Recorded;
use wheatstone_testbench::generated::Generated;
use wheatstone_testbench::mutation::record::{Reviews, Scores};
use wheatstone_testbench::{cover, prove, synth, verification};

/// Inputs of each kind. `WHEATSTONE_FUZZ` has another number for records.
const INPUTS: usize = 12;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

#[test]
fn damaged_input_is_refused_or_read() {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_wheatstone"));
    let folder = tempfile::tempdir().expect("a folder");
    let mut all = kinds::all(&program, &workspace(), folder.path()).expect("all kinds");
    // It takes a second for each input.
    all.retain(|kind: &Kind| kind.name != kinds::VERILOG);
    let plan = Plan { program, inputs: INPUTS, seed: 1, keep: None };
    let tally = plan.run(&all).unwrap_or_else(|error| panic!("{error}"));
    assert!(tally.inputs > 100 && tally.read > 0, "{tally:?}");
    assert!(tally.findings.is_empty(), "{:#?}", tally.findings);
}

/// Path of a record of a workspace, and the function that reads it, with its error.
type Reader = (&'static str, fn(&Path) -> Result<(), String>);

fn said<T>(result: Result<T, impl Display>) -> Result<(), String> {
    result.map(drop).map_err(|error| error.to_string())
}

/// Pages with tables of records.
const PAGES: [Generated; 5] = [
    Generated::Page(Target::Stereo),
    Generated::Formal,
    Generated::Cost,
    Generated::Mutation,
    Generated::Verification,
];

#[test]
fn damaged_records_are_refused_or_read() {
    let readers: [Reader; 6] = [
        (prove::record::FILE, |root| said(prove::record::Record::read(root))),
        (synth::record::FILE, |root| said(synth::record::Record::read(root))),
        ("synth/mutation.json", |root| said(Scores::read(root))),
        ("synth/mutants_reviewed.json", |root| said(Reviews::read(root))),
        (verification::FILE, |root| said(verification::Record::read(root))),
        ("synth/baseline.json", |root| said(Recorded::read(root))),
    ];
    let inputs = std::env::var("WHEATSTONE_FUZZ").ok().and_then(|n| n.parse().ok());
    let folder = tempfile::tempdir().expect("a folder");
    let waivers = fs::read(workspace().join(cover::WAIVERS)).expect("waivers");
    let whole = readers.map(|(file, _)| fs::read(workspace().join(file)).expect("a record"));
    for ((file, _), whole) in readers.iter().zip(&whole) {
        let path = folder.path().join(file);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(&path, whole).expect("written");
    }
    // The page of proofs has what their modules say.
    let rtl = std::path::absolute(workspace().join("rtl")).expect("a path");
    std::os::unix::fs::symlink(rtl, folder.path().join("rtl")).expect("a link");
    let present =
        PAGES.map(|page| fs::read_to_string(workspace().join(page.path())).expect("a page"));
    let mut made = 0;
    for (number, ((file, read), whole)) in readers.into_iter().zip(&whole).enumerate() {
        let path = folder.path().join(file);
        for input in 0..inputs.unwrap_or(INPUTS) {
            let mut rng = fastrand::Rng::with_seed((number << 32 | input) as u64);
            fs::write(&path, mutate(whole, &waivers, &mut rng)).expect("written");
            match read(folder.path()) {
                Err(text) => assert!(text.contains(file), "{file}, input {input}: {text}"),
                Ok(()) => made += 1,
            }
            // What is read is shown too.
            for (page, present) in PAGES.iter().zip(&present) {
                if let Err(error) = page.renewed(present, folder.path()) {
                    let text = error.to_string();
                    assert!(text.contains(file), "{file}, input {input}: {text}");
                }
            }
            let text = mutate(&waivers, whole, &mut rng);
            let _ = cover::Waiver::parse(&String::from_utf8_lossy(&text));
        }
        fs::write(&path, whole).expect("written");
    }
    assert!(made > 0, "none was read");
}
