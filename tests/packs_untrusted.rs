//! Packs from strangers: nothing of them reaches a tool that this version would not have written, nothing
//! outside the folder is read, nothing is waited for, and what is replayed is what was checked.

use serde_json::{json, Value};
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Table;
use wheatstone_golden::targets::Target;
use wheatstone_testbench::cases::{self, Case};
use wheatstone_testbench::pack::{self, Manifest, Origin, PackError};
use wheatstone_testbench::replay::{Replayer, Way};
use wheatstone_testbench::synth::Synthesiser;
use wheatstone_tests::*;

fn filter(seed: u64) -> Case {
    cases::random(Target::Filter, &Config::DEFAULT, seed, 60)
}

fn write(case: &Case, seed: u64, out: &Path) -> PathBuf {
    let hash = pack::rtl_hash(&rtl(), case.target.module()).expect("the Verilog");
    let written = pack::write(case, &Origin::random(seed), &hash, out);
    written.unwrap_or_else(|error| panic!("{error}")).folder
}

/// A sound pack that an attacker changes, who also makes the hashes of the manifest fit.
struct Attack {
    _folder: tempfile::TempDir,
    pack: PathBuf,
}

impl Attack {
    fn new() -> Attack {
        let folder = folder();
        let pack = write(&filter(1), 1, folder.path());
        Attack { _folder: folder, pack }
    }

    fn manifest(&self, change: impl FnOnce(&mut Value)) {
        let path = self.pack.join(pack::MANIFEST);
        let mut value =
            serde_json::from_slice(&fs::read(&path).expect("a manifest")).expect("JSON");
        change(&mut value);
        if let Ok(manifest) = serde_json::from_value::<Manifest>(value.clone()) {
            value["hash"] = json!(manifest.digest());
        }
        fs::write(path, value.to_string()).expect("written");
    }

    /// Replaces the content of a file that the manifest vouches for.
    fn replace(&self, file: &str, at: &str, content: &[u8]) {
        fs::write(self.pack.join(file), content).expect("written");
        let hash = blake3::hash(content).to_hex().to_string();
        self.manifest(|m| {
            *m.pointer_mut(at).expect("a field") = json!({"file": file, "blake3": hash})
        });
    }

    /// The pack is refused, soon, in a line that says all of these words.
    fn is_refused(&self, words: &[&str]) {
        let error = pack::check(&self.pack).expect_err("an attack").to_string();
        for word in words {
            assert!(error.contains(word), "“{error}” does not say “{word}”");
        }
        assert!(error.chars().count() < 1500, "{error}");
        assert!(!error.chars().any(|c| c.is_control()), "{error:?}");
        let copy = folder();
        assert!(pack::copy(&self.pack, &copy.path().join("copy")).is_err());
    }
}

#[test]
fn text_of_a_manifest_is_one_printable_line() {
    let verilog = "x\n`define VEC_MODULE evil\n//";
    for (at, text, words) in [
        ("/generator", verilog, &["field generator", "wheatstone and a version"][..]),
        ("/generator", "wheatstone 1 `include", &["field generator"]),
        ("/case", verilog, &["field case", "printable ASCII characters in one line"]),
        ("/case", "caf\u{e9}", &["field case", "printable ASCII"]),
        ("/case", "\u{202e}\u{1b}[2J", &["field case", "printable ASCII"]),
        ("/config", verilog, &["field config"]),
        ("/stimulus", verilog, &["field stimulus"]),
        ("/module", verilog, &["field module"]),
        ("/parameters/0/name", verilog, &["field parameters"]),
        ("/ports/0/name", verilog, &["field ports"]),
        ("/ports/1/crc32", "0; $system", &["field ports.pixel.crc32"]),
        ("/ports/0/fields/0/name", "first, end", &["field ports.beat.fields"]),
        ("/rtl_blake3", verilog, &["field rtl_blake3"]),
        ("/bench/0/blake3", verilog, &["field bench.vec.vh.blake3"]),
    ] {
        let attack = Attack::new();
        attack.manifest(|m| *m.pointer_mut(at).expect("a field") = json!(text));
        attack.is_refused(words);
    }
    let attack = Attack::new();
    attack.manifest(|m| m["case"] = json!("x".repeat(201)));
    attack.is_refused(&["field case", "at most 200 characters"]);
}

/// Two names in one look the same in a list that is told, and are not.
#[test]
fn lists_have_their_entries_one_by_one() {
    let attack = Attack::new();
    attack.manifest(|m| {
        let names: Vec<String> = ["first", "end", "include"].map(String::from).to_vec();
        let fields = m["ports"][0]["fields"].as_array_mut().expect("fields");
        fields.drain(0..2);
        fields[0]["name"] = json!(names.join(", "));
    });
    attack.is_refused(&["field ports.beat.fields"]);
}

#[test]
fn a_bench_is_what_this_version_generates() {
    for (n, file) in ["vec.vh", "replay.v", "sam_formats.vh"].into_iter().enumerate() {
        let attack = Attack::new();
        let text = fs::read_to_string(attack.pack.join(file)).expect("the bench");
        let evil = text + "\ninitial $display(\"PASS\");\n";
        attack.replace(file, &format!("/bench/{n}"), evil.as_bytes());
        attack.is_refused(&[&format!("field bench.{file}"), "differs at line", "what wheatstone"]);
    }
}

#[test]
fn files_have_the_names_that_the_bench_reads() {
    let attack = Attack::new();
    for kind in ["mem", "bin"] {
        let [from, to] = ["", "good_"].map(|p| attack.pack.join(format!("{p}beat.{kind}")));
        fs::copy(from, to).expect("a copy");
    }
    fs::write(attack.pack.join("beat.mem"), "0\n").expect("other beats");
    attack.manifest(|m| m["ports"][0]["mem"]["file"] = json!("good_beat.mem"));
    attack.is_refused(&["field ports.beat.mem: good_beat.mem, expected beat.mem"]);
    for name in
        ["../filter/beat.bin", "/etc/passwd", "../../../../../../etc/passwd", "beat.bin\n", ""]
    {
        let attack = Attack::new();
        attack.manifest(|m| m["ports"][0]["bin"]["file"] = json!(name));
        attack.is_refused(&["field ports.beat.bin", "expected beat.bin"]);
    }
}

#[test]
fn a_pack_has_its_own_files_and_no_others() {
    for extra in ["evil.vpi", "sam_filter.v", ".hidden"] {
        let attack = Attack::new();
        fs::write(attack.pack.join(extra), "").expect("written");
        attack.is_refused(&[extra, "is no file of this pack; remove it"]);
    }
    let attack = Attack::new();
    fs::create_dir(attack.pack.join("sub")).expect("a folder");
    attack.is_refused(&["sub is no file of this pack"]);
}

#[test]
fn nothing_but_regular_files_is_read() {
    for file in ["beat.bin", "beat.mem", "vec.vh", "manifest.json"] {
        let attack = Attack::new();
        let path = attack.pack.join(file);
        let elsewhere = attack.pack.parent().expect("a folder").join("elsewhere");
        fs::rename(&path, &elsewhere).expect("moved");
        symlink(&elsewhere, &path).expect("a link");
        attack.is_refused(&[file, "a symbolic link; a pack has files only"]);
        fs::remove_file(&path).expect("removed");
        assert!(Command::new("mkfifo").arg(&path).status().expect("mkfifo").success());
        attack.is_refused(&[file, "not a regular file"]);
        fs::remove_file(&path).expect("removed");
        fs::create_dir(&path).expect("a folder");
        attack.is_refused(&[file, "not a regular file"]);
    }
    let attack = Attack::new();
    fs::remove_file(attack.pack.join("beat.bin")).expect("removed");
    symlink("/dev/zero", attack.pack.join("beat.bin")).expect("a link");
    attack.is_refused(&["beat.bin", "a symbolic link"]);
}

#[test]
fn sizes_and_numbers_are_bounded() {
    for (file, size) in [("beat.bin", 1 << 40), ("pixel.mem", 1 << 33), ("manifest.json", 2 << 20)]
    {
        let attack = Attack::new();
        File::options()
            .write(true)
            .open(attack.pack.join(file))
            .and_then(|file| file.set_len(size))
            .expect("a sparse file");
        attack.is_refused(&[file, "bytes, the most it may have"]);
    }
    for (at, value, word) in [
        ("/ports/0/beats", json!(u64::MAX), "ports.beat.beats"),
        ("/ports/0/beats", json!(0), "ports.beat.beats"),
        ("/ports/0/beats", json!(-1), "line 1"),
        ("/ports/0/beats", json!(1e300), "line 1"),
        ("/ports/0/bytes", json!(u32::MAX), "ports.beat.bytes"),
        ("/parameters/0/value", json!(u64::MAX), "parameters.FILTER_TERMS"),
        ("/seed", json!("1; rm"), "line 1"),
    ] {
        let attack = Attack::new();
        attack.manifest(|m| *m.pointer_mut(at).expect("a field") = value);
        attack.is_refused(&[word]);
    }
    // Depth without end.
    let attack = Attack::new();
    fs::write(attack.pack.join("manifest.json"), "[".repeat(500_000)).expect("written");
    let said = "recursion limit exceeded; get the pack again, or write it again with";
    attack.is_refused(&["manifest.json: line 1, column ", said]);
}

#[test]
fn numbers_of_frame_buffers_are_bounded() {
    let folder = folder();
    let (_, case) = cases::for_packs(Target::Hybrid, &Config::DEFAULT, 1, 40).remove(0);
    let pack = write(&case, 1, folder.path());
    let attack = Attack { _folder: folder, pack };
    let sound = fs::read(attack.pack.join("manifest.json")).expect("a manifest");
    for (at, value, word) in [
        ("/frames/width", json!(0), "frames.width"),
        ("/frames/height", json!(1_000_000), "frames.height"),
        ("/frames/depth", json!(5), "frames.depth: 5, expected 16777215"),
        ("/frames/open/1/1", json!(4_000), "frames.open"),
        ("/frames", json!(null), "frames: nothing"),
        ("/frames/colour", json!([1, 2, 256]), "line 1"),
        ("/scene", json!({}), "line 1"),
    ] {
        attack.manifest(|m| match m.pointer_mut(at) {
            Some(field) => *field = value,
            None => m["scene"] = value,
        });
        attack.is_refused(&[word]);
        fs::write(attack.pack.join("manifest.json"), &sound).expect("written");
    }
    pack::check(&attack.pack).expect("sound again");
}

#[test]
fn the_rig_file_of_a_scene_is_one() {
    let folder = folder();
    let pack = crate::docs::pack_of_a_file(folder.path()).folder;
    let attack = Attack { _folder: folder, pack };
    let checked = pack::check(&attack.pack).expect("sound").remove(0);
    let scene = checked.manifest.scene.expect("a scene");
    assert_eq!(scene.rig_file.as_deref(), Some(r#"{"light":{"colour":[1,0.50,0]}}"#));
    for (text, said) in [
        ("[1]", "scene.rig_file.file: a list, expected an object in braces"),
        (
            r#"{"light":{"colour":[1,-1,0]}}"#,
            "scene.rig_file.light.colour: [1.0, -1.0, 0.0], expected",
        ),
        (r#"{"lamp":1}"#, "scene.rig_file.lamp"),
        ("{}\u{1b}", "scene.rig_file: other characters"),
        ("{ }", "scene.rig_file: other characters, or blanks between the parts"),
        (r#"{"eye_separation":-5}"#, "scene.rig_file.eye_separation: -5, expected a number"),
        (r#"{"near":-1,"far":-2}"#, "scene.rig_file.near: -1, expected a number"),
        (r#"{"eye_separation":50}"#, "scene.rig.eye_separation: "),
    ] {
        attack.manifest(|m| m["scene"]["rig_file"] = json!(text));
        attack.is_refused(&[said]);
    }
    attack.manifest(|m| m["scene"]["rig_file"] = json!(scene.rig_file));
    pack::check(&attack.pack).expect("sound again");
    let sound = fs::read(attack.pack.join(pack::MANIFEST)).expect("a manifest");
    // Each alone is a value that there may be.
    for (at, value, said) in [
        ("/scene/rig/1/value", json!("-1"), "scene.rig.eye_separation: -1, expected"),
        ("/scene/rig/2/value", json!("inf"), "scene.rig.viewing_distance: inf, expected"),
        ("/scene/rig/6/value", json!("7"), "scene.rig.eye_distance: 7, expected"),
        ("/scene/projection", json!("piecewise"), "scene.r"),
        ("/scene/ranges/0/0", json!("9"), "scene.ranges[0]: 9, "),
        ("/scene/width", json!(1), ""),
        ("/scene/polygons_of", json!(scene.polygons), "scene.beats_of: "),
        ("/scene/file_blake3", Value::Null, "scene.file_blake3: nothing, expected"),
        ("/seed", json!(5), "seed: 5, expected 0"),
        ("/frames/open/0/1", json!(1), "frames.open: "),
        ("/frames/height", json!(1), "frames."),
    ] {
        attack.manifest(|m| *m.pointer_mut(at).unwrap_or(&mut Value::Null) = value);
        assert!(pack::check(&attack.pack).is_err(), "{at}");
        attack.is_refused(&[said]);
        fs::write(attack.pack.join(pack::MANIFEST), &sound).expect("written");
    }
}

/// A case is named after what may be a file of any name.
#[test]
fn names_of_scenes_do_no_harm() {
    for name in
        ["a\"b`include.obj", "x\\", "x\n$finish;\n", "\u{e9}t\u{e9}.obj", &"long/".repeat(100)]
    {
        let folder = folder();
        let case = Case { name: name.to_owned(), ..filter(1) };
        let pack = write(&case, 1, folder.path());
        let checked = pack::check(&pack).unwrap_or_else(|error| panic!("{error}")).remove(0);
        assert!(checked.manifest.case.len() <= 200);
        let plain = write(&filter(1), 1, &folder.path().join("plain"));
        for file in ["vec.vh", "replay.v"] {
            let [a, b] = [&pack, &plain].map(|p| fs::read(p.join(file)).expect("the bench"));
            assert_eq!(a, b, "no name is in {file}");
        }
    }
}

fn replayer() -> Replayer {
    let cache = workspace().join(Synthesiser::CACHE);
    Replayer { synthesiser: Synthesiser { rtl: rtl(), cache } }
}

#[test]
fn what_is_replayed_is_what_was_checked() {
    let attack = Attack::new();
    let checked = pack::check(&attack.pack).expect("sound").remove(0);
    // A sound one in its place, as a writer puts there.
    write(&filter(2), 2, attack.pack.parent().expect("a folder"));
    let error = replayer().replay(&checked, Way::Icarus).expect_err("another").to_string();
    assert!(error.contains("changed since it was checked"), "{error}");
    fs::write(attack.pack.join("beat.mem"), "evil").expect("written");
    let error = replayer().replay(&checked, Way::Icarus).expect_err("damaged").to_string();
    assert!(error.contains("beat.mem"), "{error}");
}

/// Wherever it lies: Icarus cannot open files with such names itself.
#[test]
fn packs_replay_from_folders_of_any_name() {
    let folder = folder();
    for name in ["caf\u{e9} \u{65e5}", "back\\tslash", "quote\"d $HOME"] {
        let out = folder.path().join(name);
        let pack = write(&filter(1), 1, &out);
        let checked = pack::check(&pack).unwrap_or_else(|error| panic!("{error}")).remove(0);
        let replayed = replayer().replay(&checked, Way::Icarus);
        let replayed = replayed.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(replayed.passed, "{name}: {}", replayed.said);
        if name.contains('"') {
            // Icarus does not get as far as the vectors, and says so.
            continue;
        }
        // The command of the documentation says that it has no vectors, and is no mismatch.
        let rtl = rtl();
        let mut command = tool("iverilog");
        command.args(["-g2005", "-o", "t", "-I"]).arg(&pack).arg(pack.join("replay.v"));
        command.args(modules().iter().map(|m| rtl.join(m).with_extension("v")));
        let (compiled, text) = said(command.current_dir(folder.path()));
        assert!(compiled, "{text}");
        let (passed, text) = said(tool("vvp").arg(folder.path().join("t")));
        let told = text.contains("error: no vectors in ") && text.contains("+pack=.");
        assert!(passed == text.ends_with("PASS") && (passed || told), "{name}: {text}");
        assert!(!text.contains("FAIL"), "{name}: {text}");
        // As it says.
        let (passed, text) =
            said(tool("vvp").arg(folder.path().join("t")).arg("+pack=.").current_dir(&pack));
        assert!(passed && text.ends_with("PASS"), "{name}: {text}");
    }
}

#[test]
fn temporary_folders_and_links_are_no_packs() {
    let folder = folder();
    let pack = write(&filter(1), 1, folder.path());
    let part = folder.path().join(".wheatstone-1.part");
    fs::create_dir(&part).expect("a folder");
    fs::write(part.join("manifest.json"), "half of").expect("written");
    symlink(&part, folder.path().join("link")).expect("a link");
    assert_eq!(pack::check(folder.path()).expect("one pack").len(), 1);
    assert!(part.join("manifest.json").exists() && pack.exists());
    // One without a manifest is.
    let other = write(&cases::random(Target::Sampler, &Config::DEFAULT, 1, 10), 1, folder.path());
    fs::remove_file(other.join("manifest.json")).expect("removed");
    let error = pack::check(folder.path()).expect_err("a pack without manifest").to_string();
    assert!(error.contains("sampler/manifest.json"), "{error}");
}

/// Writers at once: each of them ends well, and the pack is at all times a whole one.
#[test]
fn a_pack_is_replaced_as_a_whole() {
    let folder = folder();
    let out = folder.path();
    let pack = write(&filter(0), 0, out);
    std::thread::scope(|scope| {
        let writers = [0, 10].map(|first| {
            scope.spawn(move || {
                (first..first + 10).for_each(|seed| drop(write(&filter(seed), seed, out)))
            })
        });
        while writers.iter().any(|writer| !writer.is_finished()) {
            assert!(pack.join("manifest.json").exists(), "at no time is there none");
            let copies = tempfile::tempdir().expect("a folder");
            match pack::copy(&pack, &copies.path().join("copy")) {
                Ok(copy) => assert_eq!(pack::check(&copy.folder).expect("sound").len(), 1),
                // The one that it has begun to read is gone.
                Err(error) => assert!(error.to_string().contains("No such file"), "{error}"),
            }
        }
    });
    assert_eq!(pack::check(out).expect("sound").len(), 1);
    assert_eq!(fs::read_dir(out).expect("a folder").count(), 1, "nothing temporary is left");
}

/// A place that holds anything but a pack is not replaced, not even a file or a link to a pack.
#[test]
fn nothing_but_a_pack_is_replaced() {
    let folder = folder();
    let place = folder.path().join("filter");
    let elsewhere = write(&filter(1), 1, &folder.path().join("elsewhere"));
    let hash = "0".repeat(64);
    let refused = || {
        let written = pack::write(&filter(2), &Origin::random(2), &hash, folder.path());
        let error = written.expect_err("no pack").to_string();
        assert!(error.contains("filter: exists and is no vector pack"), "{error}");
    };
    symlink(&elsewhere, &place).expect("a link");
    refused();
    fs::remove_file(&place).expect("removed");
    fs::write(&place, "notes").expect("written");
    refused();
    assert_eq!(fs::read_to_string(&place).expect("kept"), "notes");
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
}

#[test]
fn a_pack_that_is_not_written_leaves_no_new_folder() {
    let folder = folder();
    let out = folder.path().join("new/packs");
    let vain = Case { outputs: vec![Table::default()], ..filter(1) };
    let written = pack::write(&vain, &Origin::random(1), &"0".repeat(64), &out);
    assert!(matches!(written, Err(PackError::Vain { .. })), "{written:?}");
    assert!(!folder.path().join("new").exists());
}
