//! Vector packs replay in cocotb and on gate-level netlists, equal in every bit, and catch bugs there.

use std::path::Path;
use std::process::Command;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases;
use wheatstone_testbench::pack::{self, Checked, Origin};
use wheatstone_testbench::replay::{Replayed, Replayer, Way};
use wheatstone_testbench::synth::Synthesiser;
use wheatstone_testbench::tools::COCOTB;
use wheatstone_tests::*;

/// A pack of random beats in a folder.
fn pack(target: Target, config: &Config, beats: usize, out: &Path) -> Checked {
    let case = cases::random(target, config, 5, beats);
    let hash = pack::rtl_hash(&rtl(), target.module()).expect("the Verilog");
    let written = pack::write(&case, &Origin::random(5), &hash, out)
        .unwrap_or_else(|error| panic!("{error}"));
    pack::check(&written.folder).unwrap_or_else(|error| panic!("{error}")).remove(0)
}

fn replay(pack: &Checked, rtl: &Path, way: Way) -> Replayed {
    let (rtl, cache) = (rtl.to_owned(), workspace().join(Synthesiser::CACHE));
    let replayer = Replayer { synthesiser: Synthesiser { rtl, cache } };
    replayer.replay(pack, way).unwrap_or_else(|error| panic!("{error}"))
}

fn passes(target: Target, config: &Config, beats: usize) {
    let folder = folder();
    let pack = pack(target, config, beats, folder.path());
    for way in Way::ALL {
        let Replayed { passed, said, .. } = replay(&pack, &rtl(), way);
        assert!(passed, "{} {}:\n{said}", target.name(), way.name());
        for port in pack.manifest.ports.iter().filter(|port| port.direction == "output") {
            let (name, crc, beats) = (&port.name, &port.crc32, port.beats);
            let line = format!("crc {name} {crc}, expected {crc}, {beats} of {beats} beats");
            assert!(said.lines().any(|l| l == line), "{}: no “{line}” in:\n{said}", way.name());
        }
    }
}

#[test]
fn units_replay_in_every_way() {
    for target in [Target::XInterpolator, Target::Filter, Target::Blend, Target::Redirect] {
        passes(target, &Config::PAPER, 300);
    }
    passes(Target::YInterpolator, &Config::FULL, 300);
    passes(Target::Filter, &Config::DEFAULT, 300);
}

#[test]
fn a_system_replays_in_every_way() {
    passes(Target::Minimal, &Config::PAPER, 300);
}

#[test]
fn every_way_says_fail_on_wrong_verilog() {
    // A wrong value, a beat too many, and a stream that never ends.
    for (target, file, find, to) in [
        (Target::Filter, "sam_filter.v", "(so_many == 0) |", "(so_many != 0) |"),
        (
            Target::Sampler,
            "sam_sampler.v",
            "beat_valid_i & beat_end_i",
            "beat_valid_i | beat_end_i",
        ),
        (Target::XInterpolator, "sam_x_interpolator.v", "(last_q | beat_valid_i)", "last_q"),
    ] {
        let (folder, copy) = (folder(), copy_of_rtl());
        let pack = pack(target, &Config::DEFAULT, 300, folder.path());
        plant(copy.path(), file, find, to);
        for way in Way::ALL {
            let Replayed { passed, said, .. } = replay(&pack, copy.path(), way);
            assert!(!passed && said.contains("FAIL ("), "{file} {}:\n{said}", way.name());
        }
    }
}

/// Exit status and output of the script for a command line; with Python's own packages alone, or all.
fn script(own: bool, temporary: &Path, arguments: &[&Path]) -> (Option<i32>, String) {
    let mut python = Command::new(COCOTB.find().expect("cocotb").program.with_file_name("python3"));
    // Without site packages, among which cocotb is.
    python.args(own.then_some("-S")).arg(workspace().join("scripts/replay.py")).args(arguments);
    // The program checks packs in tests of its own.
    python.arg("--checked").env("TMPDIR", temporary);
    let output = python.current_dir(workspace()).output().expect("Python");
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&text).trim().to_owned())
}

#[test]
fn the_script_tells_what_it_cannot_replay_in_a_line() {
    let (temporary, folder) = (folder(), folder());
    let pack = pack(Target::Blend, &Config::PAPER, 20, folder.path()).folder;
    assert_eq!(script(false, temporary.path(), &[&pack]).0, Some(0));
    let told = |own, status, what: &str, arguments: &[&Path]| {
        let (found, text) = script(own, temporary.path(), arguments);
        assert_eq!(found, Some(status), "{text}");
        assert!(text.starts_with("error: ") && text.lines().count() == 1, "{text}");
        assert!(text.contains(what), "no “{what}” in: {text}");
    };
    told(true, 3, "run scripts/setup", &[&pack]);
    told(false, 2, "no Verilog there", &[&pack, Path::new("--rtl"), folder.path()]);
    told(false, 2, "wheatstone vectors", &[&folder.path().join("none")]);
    // Neither a file without an end nor a module that stops the clock holds it up, or leaves anything.
    let (pipe, endless) = (copy_of_rtl(), copy_of_rtl());
    let mkfifo = Command::new("mkfifo").arg(pipe.path().join("x.v")).status();
    assert!(mkfifo.expect("mkfifo").success());
    told(false, 2, "expected a regular file", &[&pack, Path::new("--rtl"), pipe.path()]);
    let file = endless.path().join("sam_blend.v");
    let endless_loop = "initial begin #100; forever begin end end\n`ifdef FORMAL";
    let text = std::fs::read_to_string(&file).expect("Verilog");
    std::fs::write(&file, text.replacen("`ifdef FORMAL", endless_loop, 1)).expect("written");
    let rtl = [Path::new("--rtl"), endless.path()];
    let limit = [Path::new("--timeout"), Path::new("2")];
    told(false, 4, "did not end within 2 s", &[&[pack.as_path()], &rtl[..], &limit].concat());
    let left = std::fs::read_dir(temporary.path()).expect("a folder").count();
    assert_eq!(left, 0, "temporary files are left");
    let manifest = pack.join(pack::MANIFEST);
    let sound = std::fs::read_to_string(&manifest).expect("a manifest");
    for (find, replace, what) in [
        ("\"module\"", "\"modul\"", "has no 'module'"),
        ("\"lsb\"", "\"lob\"", "has no 'lsb'"),
        (".bin", ".ban", "No such file"),
        ("{", "[", "delimiter"),
    ] {
        std::fs::write(&manifest, sound.replacen(find, replace, 1)).expect("written");
        told(false, 2, what, &[&pack]);
    }
}

/// The beats of a response wait for their requests in Python too: the hybrid gives no answer before.
#[test]
fn the_hybrid_replays_in_cocotb() {
    let folder = folder();
    let pack = pack(Target::Hybrid, &Config::DEFAULT, 1_000, folder.path());
    let Replayed { passed, said, .. } = replay(&pack, &rtl(), Way::Cocotb);
    assert!(passed, "{said}");
}
