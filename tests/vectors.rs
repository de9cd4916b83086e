//! Vector packs: they replay in Icarus without Rust, catch bugs there, and are refused when damaged.

use serde_json::{json, Value};
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases::{self, Case};
use wheatstone_testbench::pack::{self, Manifest, Origin};
use wheatstone_tests::*;

/// Writes the pack of a case.
fn write(case: &Case, out: &Path) -> Manifest {
    let hash = pack::rtl_hash(&rtl(), case.target.module()).expect("the Verilog");
    pack::write(case, &Origin::random(1), &hash, out)
        .unwrap_or_else(|error| panic!("{error}"))
        .manifest
}

/// Runs the command that the documentation gives, in a folder with the packs and a link to the
/// Verilog. Whether it ended well, and what it said.
fn replay(folder: &Path, rtl: &Path, target: Target) -> (bool, String) {
    // Names a missing program, and how to install it.
    let (_, _) = (tool("iverilog"), tool("vvp"));
    let link = folder.join("rtl");
    if !link.exists() {
        symlink(fs::canonicalize(rtl).expect("a folder"), &link).expect("a link");
    }
    let pack = target.name();
    let command = format!("iverilog -g2005 -I {pack} -o t {pack}/replay.v rtl/*.v && vvp t");
    said(Command::new("sh").arg("-c").arg(&command).current_dir(folder))
}

/// Runs what the command compiled once more, without stalls.
fn replay_without_stalls(folder: &Path) -> (bool, String) {
    said(tool("vvp").args(["t", "+stall=0"]).current_dir(folder))
}

/// Writes, checks and replays a case.
fn passes(case: &Case, without_stalls_too: bool) {
    let folder = folder();
    let manifest = write(case, folder.path());
    let checked = pack::check(&folder.path().join(case.target.name()));
    assert_eq!(checked.unwrap_or_else(|error| panic!("{error}"))[0].manifest, manifest);
    let stalled = replay(folder.path(), &rtl(), case.target);
    let freely = without_stalls_too.then(|| replay_without_stalls(folder.path()));
    for (passed, text) in [stalled].into_iter().chain(freely) {
        assert!(passed, "{text}");
        let mut lines = text.lines().rev();
        assert_eq!(lines.next(), Some("PASS"), "{} {}:\n{text}", case.target.name(), case.name);
        let outputs = manifest.ports.iter().filter(|port| port.direction == "output");
        for port in outputs {
            let (name, crc, beats) = (&port.name, &port.crc32, port.beats);
            let line = format!("crc {name} {crc}, expected {crc}, {beats} of {beats} beats");
            assert!(text.lines().any(|l| l == line), "“{line}” is not in:\n{text}");
        }
    }
}

#[test]
fn random_packs_replay_in_icarus() {
    for target in Target::ALL {
        passes(&cases::random(target, &Config::DEFAULT, 3, 400), true);
    }
}

/// Bad setups and stray beats.
#[test]
fn directed_packs_of_the_systems_replay_in_icarus() {
    for target in Target::ALL.into_iter().filter(|target| target.is_system()) {
        // What is there for the sake of the test bench's stalls is long.
        let directed = cases::directed(target, &Config::DEFAULT);
        directed.iter().filter(|case| !case.all_stalls).for_each(|case| passes(case, false));
    }
}

#[test]
fn random_packs_of_the_paper_configuration_replay_in_icarus() {
    for target in Target::ALL {
        passes(&cases::random(target, &Config::PAPER, 3, 200), false);
    }
}

#[test]
fn random_packs_of_the_full_configuration_replay_in_icarus() {
    for target in Target::ALL {
        passes(&cases::random(target, &Config::FULL, 3, 200), false);
    }
}

#[test]
fn a_replay_on_wrong_verilog_says_fail() {
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
        (Target::Hybrid, "sam_slot_queue.v", "D] < response", "D] > response"),
        (Target::Minimal, "sam_redirect.v", "slot_eye_i ^ ~left_primary", "slot_eye_i"),
    ] {
        let (folder, copy) = (folder(), copy_of_rtl());
        plant(copy.path(), file, find, to);
        write(&cases::random(target, &Config::DEFAULT, 3, 400), folder.path());
        let (passed, text) = replay(folder.path(), copy.path(), target);
        assert!(!passed, "the exit status says so too: {text}");
        let last = text.lines().last().unwrap_or("");
        assert!(last.starts_with("FAIL ("), "{file}: {find} → {to}:\n{text}");
        assert!(!text.contains("PASS"), "{text}");
    }
}

/// The other command of the documentation, on the files that the filter is of.
#[test]
fn verilator_replays_too_and_its_exit_status_says_fail() {
    tool("verilator");
    for wrong in [false, true] {
        let (folder, copy) = (folder(), copy_of_rtl());
        if wrong {
            plant(copy.path(), "sam_filter.v", "(so_many == 0) |", "(so_many != 0) |");
        }
        write(&cases::random(Target::Filter, &Config::DEFAULT, 3, 400), folder.path());
        symlink(copy.path(), folder.path().join("rtl")).expect("a link");
        let command =
            "verilator --binary -Wno-fatal -O0 --top-module replay -Ifilter filter/replay.v \
            rtl/sam_filter.v rtl/sam_filter_division.v >log 2>&1 && obj_dir/Vreplay";
        let mut shell = Command::new("sh");
        let (passed, text) = said(shell.arg("-c").arg(command).current_dir(folder.path()));
        let log = fs::read_to_string(folder.path().join("log")).unwrap_or_default();
        assert!(folder.path().join("obj_dir/Vreplay").exists(), "{log}");
        assert_eq!(passed, !wrong, "{text}");
        assert_eq!(text.contains("\nPASS"), !wrong, "{text}");
        assert_eq!(text.contains("\nFAIL ("), wrong, "{text}");
    }
}

/// A small sound pack that a test may damage.
struct Sound {
    _folder: tempfile::TempDir,
    pack: PathBuf,
}

impl Sound {
    fn new() -> Sound {
        let folder = folder();
        write(&cases::random(Target::Filter, &Config::DEFAULT, 1, 60), folder.path());
        let pack = folder.path().join("filter");
        Sound { _folder: folder, pack }
    }

    /// Changes the bytes of a file.
    fn edit(&self, file: &str, change: impl FnOnce(&mut Vec<u8>)) {
        let path = self.pack.join(file);
        let mut bytes = fs::read(&path).expect("a file of the pack");
        change(&mut bytes);
        fs::write(path, bytes).expect("written");
    }

    /// Changes the manifest.
    fn manifest(&self, change: impl FnOnce(&mut Value)) {
        self.edit("manifest.json", |bytes| {
            let mut value = serde_json::from_slice(bytes).expect("JSON");
            change(&mut value);
            *bytes = value.to_string().into_bytes();
        });
    }

    fn error(&self) -> String {
        pack::check(&self.pack).expect_err("it is damaged").to_string()
    }
}

/// Asserts that a damaged pack is refused with all of these words, in one line.
fn refused(what: &str, words: &[&str], damage: impl FnOnce(&Sound)) {
    let sound = Sound::new();
    damage(&sound);
    let error = sound.error();
    for word in words {
        assert!(error.contains(word), "{what}: “{error}” does not say “{word}”");
    }
    assert_eq!(error.lines().count(), 1, "{what}: {error}");
}

#[test]
fn damaged_files_are_refused_by_name_and_field() {
    for (file, field) in [
        ("beat.bin", "ports.beat.bin.blake3"),
        ("beat.mem", "ports.beat.mem.blake3"),
        ("pixel.bin", "ports.pixel.bin.blake3"),
        ("pixel.mem", "ports.pixel.mem.blake3"),
        ("vec.vh", "bench.vec.vh.blake3"),
        ("replay.v", "bench.replay.v.blake3"),
        ("sam_formats.vh", "bench.sam_formats.vh.blake3"),
    ] {
        let path = format!("filter/{file}");
        refused("a flipped bit", &[&path, field], |p| p.edit(file, |b| b[7] ^= 4));
        refused("truncated", &[&path, field], |p| p.edit(file, |b| b.truncate(b.len() - 1)));
        refused("empty", &[&path, field, "0 bytes"], |p| p.edit(file, Vec::clear));
        refused("longer", &[&path, field], |p| p.edit(file, |b| b.push(b'\n')));
        refused("missing", &[&path, "No such file"], |p| {
            fs::remove_file(p.pack.join(file)).expect("removed");
        });
    }
}

#[test]
fn a_damaged_manifest_is_refused_by_line() {
    let manifest = ["filter/manifest.json", "line 1"];
    refused("empty", &manifest, |p| p.edit("manifest.json", Vec::clear));
    refused("no JSON", &manifest, |p| p.edit("manifest.json", |b| *b = b"PASS\n".to_vec()));
    refused("truncated", &["filter/manifest.json: line ", "EOF"], |p| {
        p.edit("manifest.json", |b| b.truncate(b.len() / 2));
    });
    refused("no text", &["filter/manifest.json"], |p| p.edit("manifest.json", |b| b[9] = 0xff));
    refused("unknown field", &["manifest.json: line ", "unknown field `colour`"], |p| {
        p.manifest(|m| m["colour"] = json!("red"));
    });
    refused("unknown field below", &["manifest.json: line ", "unknown field `x`"], |p| {
        p.manifest(|m| m["ports"][0]["fields"][0]["x"] = json!(1));
    });
    refused("missing field", &["manifest.json: line ", "missing field `beats`"], |p| {
        p.manifest(|m| drop(m["ports"][1].as_object_mut().expect("a port").remove("beats")));
    });
    refused("another type", &["manifest.json: line ", "invalid type"], |p| {
        p.manifest(|m| m["ports"][0]["beats"] = json!("many"));
    });
    refused("no object", &["manifest.json", "field format"], |p| {
        p.edit("manifest.json", |b| *b = b"[]".to_vec());
    });
    let missing = folder();
    let error = pack::check(missing.path()).expect_err("nothing is there").to_string();
    assert!(
        error.contains("no vector pack here") && error.contains("wheatstone vectors"),
        "{error}"
    );
    let error = pack::check(&missing.path().join("gone")).expect_err("nor here").to_string();
    assert!(error.contains("gone: No such file"), "{error}");
}

#[test]
fn a_manifest_that_contradicts_its_files_is_refused_by_field() {
    // Where, the wrong value, and what the error must say.
    let cases: &[(&str, Value, &[&str])] = &[
        ("/format", json!("vectors"), &["field format", "wheatstone-vectors"]),
        ("/schema", json!(3), &["field schema: 3", "a newer pack needs a newer wheatstone"]),
        ("/schema", json!(1), &["field schema: 1, expected 2", "write it again with wheatstone"]),
        ("/schema", json!("1"), &["field schema: \"1\""]),
        ("/schema", json!(-1), &["field schema: -1"]),
        ("/target", json!("warp"), &["field target: warp", "wheatstone list"]),
        ("/target", json!("sampler"), &["field module: sam_filter, expected sam_sampler"]),
        ("/module", json!("sam_blend"), &["field module: sam_blend, expected sam_filter"]),
        ("/ports/0/name", json!("pulse"), &["field ports: pulse, pixel, expected beat, pixel"]),
        ("/ports", json!([]), &["field ports: , expected beat, pixel"]),
        ("/ports/0/direction", json!("output"), &["field ports.beat.direction: output"]),
        ("/ports/0/answers", json!("pixel"), &["field ports.beat.answers: pixel"]),
        ("/ports/0/beats", json!(61), &["field ports.beat.beats"]),
        ("/ports/1/beats", json!(u64::MAX), &["field ports.pixel.beats"]),
        ("/ports/0/bits", json!(36), &["field ports.beat.bits: 36, expected 35"]),
        ("/ports/0/bytes", json!(4), &["field ports.beat.bytes: 4, expected 5"]),
        ("/ports/0/bytes", json!(0), &["field ports.beat.bytes: 0, expected 5"]),
        ("/ports/1/crc32", json!("00000000"), &["field ports.pixel.crc32: 00000000"]),
        ("/ports/0/fields/1/lsb", json!(2), &["field ports.beat.fields.end.lsb: 2, expected 1"]),
        ("/ports/0/fields/1/bits", json!(0), &["field ports.beat.fields.end.bits: 0"]),
        ("/ports/0/fields/3/bits", json!(65), &["field ports.beat.fields.rgba.bits: 65"]),
        ("/ports/0/fields/0/name", json!("last"), &["field ports.beat.fields: last, end"]),
        ("/ports/0/fields", json!([]), &["field ports.beat.fields"]),
        ("/ports/0/bin/file", json!("../filter/beat.bin"), &["field ports.beat.bin", "../filter"]),
        ("/ports/0/mem/file", json!("/etc/passwd"), &["field ports.beat.mem", "/etc/passwd"]),
        ("/ports/0/mem/file", json!("..\\x"), &["field ports.beat.mem", "expected beat.mem"]),
        ("/ports/0/bin/file", json!(".."), &["field ports.beat.bin: .., expected beat.bin"]),
        (
            "/ports/0/bin/blake3",
            json!("f".repeat(64)),
            &["field ports.beat.bin.blake3", "expected fff"],
        ),
        (
            "/ports/0/mem/blake3",
            json!("ff"),
            &["field ports.beat.mem.blake3: ff", "64 hexadecimal"],
        ),
        ("/ports/0/fields/3/signed", json!(true), &["field ports.beat.fields.rgba.signed: true"]),
        ("/ports/0/fields/3/fraction", json!(2), &["field ports.beat.fields.rgba.fraction: 2"]),
        ("/ports/0/fields/0/doc", json!("or not"), &["field ports.beat.fields.first.doc: or not"]),
        ("/parameters/0/value", json!(7), &["field parameters.FILTER_TERMS: 7, expected 0"]),
        ("/parameters/0/name", json!("TERMS"), &["field parameters: TERMS, expected FILTER_TERMS"]),
        ("/parameters", json!([]), &["field parameters: , expected"]),
        ("/statics", json!([{"name": "width", "value": 1}]), &["field statics: width"]),
        ("/flags", json!([{"name": "error", "value": 0}]), &["field flags: error"]),
        // What nothing else in the pack contradicts.
        ("/build/1/value", json!("2"), &["field parameters.FILTER_TERMS: 0, expected 2"]),
        ("/build/1/value", json!("4"), &["field build.filter: 4, expected exact or 2 or 3"]),
        ("/build/1/name", json!("terms"), &["field build: subpixel_bits, terms"]),
        ("/config", json!("mine"), &["field config: mine, expected default or paper or full"]),
        ("/config", json!("paper"), &["field hash"]),
        ("/stimulus", json!("noise"), &["field stimulus: noise, expected random, directed"]),
        ("/seed", json!(2), &["field hash"]),
        ("/case", json!("a scene"), &["field hash"]),
        ("/generator", json!("wheatstone 9.9.9"), &["field hash"]),
        ("/rtl_blake3", json!("00"), &["field rtl_blake3: 00", "64 hexadecimal digits"]),
        ("/rtl_blake3", json!("0".repeat(64)), &["field hash"]),
        ("/hash", json!(""), &["field hash"]),
    ];
    for (at, value, words) in cases {
        let what = format!("{at} = {value}");
        // A wrong hash is a matter of the file that has another.
        let file = if at.ends_with("/bin/blake3") { "beat.bin" } else { "manifest.json" };
        refused(&what, &[&[file], *words].concat(), |p| {
            p.manifest(|m| match m.pointer_mut(at) {
                Some(field) => *field = value.clone(),
                None => m["ports"][0]["answers"] = value.clone(),
            });
        });
    }
}

/// Someone has made the hash fit: the files still say what the vectors are.
#[test]
fn a_manifest_that_contradicts_the_bench_is_refused_by_line() {
    let with_hash = |p: &Sound, at: &str, value: Value| {
        p.manifest(|m| {
            *m.pointer_mut(at).expect("a field") = value;
            let manifest: Manifest = serde_json::from_value(m.clone()).expect("a manifest");
            m["hash"] = json!(manifest.digest());
        });
    };
    let words = ["manifest.json: field bench.vec.vh", "vec.vh differs at line 8"];
    refused("parameters", &words, |p| {
        p.manifest(|m| m["build"][1]["value"] = json!("2"));
        with_hash(p, "/parameters/0/value", json!(2));
    });
    refused(
        "replay.v",
        &["manifest.json: field bench.replay.v", "replay.v differs at line 7"],
        |p| {
            p.edit("replay.v", |bytes| {
                let text = String::from_utf8(bytes.clone()).expect("text");
                *bytes = text.replacen("vec.vh", "cev.vh", 1).into_bytes();
            });
            let content = fs::read(p.pack.join("replay.v")).expect("the bench");
            let hash = blake3::hash(&content).to_hex().to_string();
            with_hash(p, "/bench/1/blake3", json!(hash));
        },
    );
    refused("elsewhere", &["field bench: ../vec.vh, replay.v", "expected vec.vh, replay.v"], |p| {
        with_hash(p, "/bench/0/file", json!("../vec.vh"));
    });
    refused(
        "fewer files",
        &["field bench: vec.vh, replay.v, expected vec.vh, replay.v, sam"],
        |p| {
            let manifest = fs::read_to_string(p.pack.join("manifest.json")).expect("the manifest");
            let manifest: Value = serde_json::from_str(&manifest).expect("JSON");
            with_hash(p, "/bench", json!(&manifest["bench"].as_array().expect("files")[..2]));
        },
    );
}

#[test]
fn a_static_input_has_no_more_than_its_bits() {
    let folder = folder();
    write(&cases::random(Target::Display, &Config::DEFAULT, 1, 20), folder.path());
    let path = folder.path().join("display/manifest.json");
    let mut manifest: Manifest =
        serde_json::from_slice(&fs::read(&path).expect("the manifest")).expect("JSON");
    manifest.statics[0].value = 1 << 20;
    fs::write(&path, serde_json::to_string(&manifest).expect("JSON")).expect("written");
    let error = pack::check(folder.path()).expect_err("too wide").to_string();
    assert!(error.contains("field statics.width: 1048576, expected 12 bits at most"), "{error}");
}

#[test]
fn beats_that_differ_between_the_two_files_are_named_by_line() {
    // The hash in the manifest is the new file's: only the beats themselves are wrong.
    refused("edited", &["field ports.pixel.mem", "pixel.mem differs", "at line 3"], |p| {
        p.edit("pixel.mem", |bytes| {
            let line = bytes.split(|b| *b == b'\n').take(2).map(|l| l.len() + 1).sum::<usize>();
            bytes[line] = if bytes[line] == b'0' { b'1' } else { b'0' };
        });
        let content = fs::read(p.pack.join("pixel.mem")).expect("the beats");
        let hash = blake3::hash(&content).to_hex().to_string();
        p.manifest(|m| m["ports"][1]["mem"]["blake3"] = json!(hash));
    });
}

/// The hash in the manifest is the new file's.
#[test]
fn bits_beyond_a_beat_are_zeros() {
    refused("padding", &["field ports.beat.bin: beat 2 of beat.bin has ones beyond its 35"], |p| {
        p.edit("beat.bin", |bytes| bytes[14] |= 1 << 3);
        let content = fs::read(p.pack.join("beat.bin")).expect("the beats");
        let hash = blake3::hash(&content).to_hex().to_string();
        p.manifest(|m| m["ports"][0]["bin"]["blake3"] = json!(hash));
    });
}

#[test]
fn a_manifest_is_text_as_any_other() {
    let sound = Sound::new();
    sound.edit("manifest.json", |bytes| drop(bytes.splice(0..0, *b"\xef\xbb\xbf")));
    pack::check(&sound.pack).expect("a mark is dropped");
    refused("UTF-16", &["manifest.json", "UTF-16 (little-endian) text; save it as UTF-8"], |p| {
        p.edit("manifest.json", |bytes| {
            let text = String::from_utf8(bytes.clone()).expect("text");
            *bytes = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        });
    });
}

/// A pack in which nothing is compared looks like one that is equal.
#[test]
fn a_pack_has_something_to_compare() {
    let words = "nothing in it is compared: no output beat and no flag; write it with more --beats";
    refused("no beats", &[words], |p| {
        for file in ["beat.bin", "beat.mem", "pixel.bin", "pixel.mem"] {
            p.edit(file, Vec::clear);
        }
        p.edit("vec.vh", |bytes| {
            let text = String::from_utf8(bytes.clone()).expect("text");
            let emptied = |line: &str| match line.rsplit_once(' ') {
                Some((name, _)) if name.ends_with("_BEATS") => format!("{name} 0\n"),
                Some((name, _)) if name.ends_with("_CRC") => format!("{name} 32'h00000000\n"),
                _ => format!("{line}\n"),
            };
            *bytes = text.lines().map(emptied).collect::<String>().into_bytes();
        });
        let hash = |file: &str| {
            let content = fs::read(p.pack.join(file)).expect("a file");
            json!(blake3::hash(&content).to_hex().to_string())
        };
        p.manifest(|m| {
            for port in [0, 1] {
                let port = &mut m["ports"][port];
                (port["beats"], port["crc32"]) = (json!(0), json!("00000000"));
                (port["bin"]["blake3"], port["mem"]["blake3"]) =
                    (hash("beat.bin"), hash("beat.mem"));
            }
            m["bench"][0]["blake3"] = hash("vec.vh");
            let manifest: Manifest = serde_json::from_value(m.clone()).expect("a manifest");
            m["hash"] = json!(manifest.digest());
        });
    });
    let mut case = cases::random(Target::Filter, &Config::DEFAULT, 1, 60);
    case.outputs[0] = Default::default();
    let error = pack::write(&case, &Origin::random(1), "", folder().path()).expect_err("nothing");
    assert!(error.to_string().contains(words), "{error}");
    // Flags of systems are compared in any case.
    let units = Target::ALL.into_iter().filter(|target| !target.is_system());
    for target in units {
        for config in [Config::DEFAULT, Config::PAPER, Config::FULL] {
            let packs = cases::for_packs(target, &config, 1, 50).into_iter().map(|(_, case)| case);
            let random = (1..10).map(|seed| cases::random(target, &config, seed, 50));
            for case in packs.chain(random).chain(cases::directed(target, &config)) {
                let compared: usize = case.outputs.iter().map(|table| table.len()).sum();
                assert!(compared > 0, "{} {}", target.name(), case.name);
            }
        }
    }
}

#[test]
fn a_pack_replaces_an_older_one_and_nothing_else() {
    let folder = folder();
    let case = cases::random(Target::Display, &Config::DEFAULT, 1, 20);
    write(&case, folder.path());
    write(&cases::random(Target::Display, &Config::DEFAULT, 2, 30), folder.path());
    assert_eq!(pack::check(folder.path()).expect("sound").len(), 1);
    let entries = fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(entries, 1, "nothing temporary is left");
    // A folder of that name that is no pack is somebody's work.
    let other = folder.path().join("blend");
    fs::create_dir(&other).expect("a folder");
    fs::write(other.join("notes.txt"), "keep me").expect("written");
    let case = cases::random(Target::Blend, &Config::DEFAULT, 1, 20);
    let error = pack::write(&case, &Origin::random(1), "", folder.path())
        .expect_err("not a pack")
        .to_string();
    assert!(error.contains("blend: exists and is no vector pack"), "{error}");
    assert_eq!(fs::read_to_string(other.join("notes.txt")).expect("kept"), "keep me");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
}
