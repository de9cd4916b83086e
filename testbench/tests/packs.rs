//! Packs on the command line: what `vectors` takes and refuses, what a manifest says of a scene, and that
//! the script refuses what the program refuses.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use wheatstone_testbench::tools::COCOTB;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs the program in a folder, on a line whose words have no blanks, with the Verilog of the workspace.
fn run(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).args(line.split_whitespace());
    command.arg("--rtl").arg(workspace().join("rtl")).output().expect("the program runs")
}

fn said(output: &Output) -> String {
    [&output.stdout[..], &output.stderr].map(String::from_utf8_lossy).concat()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

fn manifest(pack: &Path) -> Value {
    let text = fs::read(pack.join("manifest.json")).expect("a manifest");
    serde_json::from_slice(&text).expect("JSON")
}

#[test]
fn options_that_make_no_difference_are_errors() {
    let folder = folder();
    for (line, words) in [
        ("vectors filter --size 64x48", "--size: no scene is drawn; name one with --scene"),
        ("vectors filter --wire", "--wire: no scene is drawn"),
        ("vectors hybrid --cull back", "--cull: no scene is drawn"),
        ("vectors hybrid --projection shear", "--projection: no scene is drawn"),
        ("vectors hybrid --param cost_rule=off", "--param cost_rule: no scene is drawn"),
        ("vectors hybrid --param latency=4", "--param latency: a pack has no clocks"),
        ("vectors hybrid --scene ramp --seed 2", "--seed: nothing of a scene is random"),
        (
            "vectors display filter --param slots=4",
            "--param slots: makes no difference to display, filter",
        ),
        (
            "vectors stereo --scene room --param texture=bilinear",
            "--param texture: makes no difference",
        ),
        (
            "vectors mono --scene room --param displays=1",
            "--param displays: makes no difference to mono",
        ),
        (
            "vectors traversal primary --scene room --param displays=1",
            "--param displays: makes no difference to traversal, primary",
        ),
        (
            "vectors primary mono --scene room --param sampling=nearest",
            "--param sampling: makes no difference to primary, mono",
        ),
        ("vectors hybrid --beats 1000001", "--beats: a pack has 1000000 at most"),
        ("vectors hybrid --beats 4294967296", "--beats: a pack has 1000000 at most"),
        ("vectors hybrid --case x --scene ramp", "cannot be used with"),
        ("vectors hybrid --case x --beats 5", "cannot be used with"),
        ("vectors hybrid --case x --seed 5", "cannot be used with"),
        ("cosim filter --size 64x48", "--size: no scene is drawn"),
        ("cosim display --wire", "--wire: no scene is drawn"),
        ("cosim display --param sampling=average", "--param sampling: no scene is drawn"),
        ("cosim display --param filter=2", "--param filter: makes no difference to display"),
        ("cosim hybrid --scene ramp --beats 5", "--beats: a scene is drawn whole"),
        ("cosim filter --param latency=4", "--param latency: makes no difference to filter"),
        ("cosim minimal --scene ramp --param filter=2", "--param filter: makes no difference"),
        ("vectors sampler --scene ramp --param slots=4", "--param slots: makes no difference"),
        ("synth filter --param latency=4", "--param latency: makes no difference to what is built"),
        ("synth filter --param slots=4", "--param slots: makes no difference to what is built"),
        ("mutate filter --param texture=nearest", "--param texture: makes no difference to what"),
        ("waves filter --cull back", "--cull: no scene is drawn"),
        ("waves filter --beats 5", "--beats: waveforms show the beats around"),
        ("replay filter --packs p --seed 2", "cannot be used with"),
    ] {
        let has_out = ["vectors", "cosim", "waves"].iter().any(|word| line.starts_with(word));
        let out = if has_out { " --out made" } else { "" };
        let output = run(folder.path(), &format!("{line}{out}"));
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        assert!(said(&output).contains(words), "{line}: no “{words}” in: {}", said(&output));
        assert!(!folder.path().join("made").exists(), "{line} made something");
    }
}

#[test]
fn directed_cases_are_written_by_name() {
    let folder = folder();
    let with = |case: &str, targets: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
        command.current_dir(folder.path()).args(["vectors", "--out", "p", "--case", case]);
        command.args(targets).arg("--rtl").arg(workspace().join("rtl"));
        command.output().expect("the program runs")
    };
    let output = with("bad setups", &["hybrid"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let manifest = manifest(&folder.path().join("p/hybrid"));
    assert_eq!(manifest["case"], "bad setups");
    assert_eq!(
        [&manifest["stimulus"], &manifest["seed"]],
        [&Value::from("directed"), &Value::from(0)]
    );
    assert_eq!(manifest["flags"][0]["value"], 1);
    let output = run(folder.path(), "check p");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let output = with("good setups", &["minimal"]);
    assert_eq!(output.status.code(), Some(2));
    for words in ["--case good setups: no such case of minimal; there are: ", "“bad setups”"] {
        assert!(said(&output).contains(words), "{}", said(&output));
    }
    let output = with("bad setups", &["filter"]);
    assert!(
        said(&output).contains("there are: “every count with every value”"),
        "{}",
        said(&output)
    );
}

/// A row of a stream's beats, by field.
fn beats(pack: &Path, stream: &str) -> Vec<Vec<(String, u64)>> {
    let manifest = manifest(pack);
    let ports = manifest["ports"].as_array().expect("ports");
    let port = ports.iter().find(|port| port["name"] == stream).expect("the stream");
    let bytes = fs::read(pack.join(format!("{stream}.bin"))).expect("beats");
    let field = |beat: &[u8], field: &Value| {
        let [lsb, bits] = ["lsb", "bits"].map(|name| field[name].as_u64().expect("a number"));
        let bit = |n: u64| u64::from(beat[n as usize / 8] >> (n % 8) & 1);
        let value = (0..bits).map(|n| bit(lsb + n) << n).sum();
        (field["name"].as_str().expect("a name").to_owned(), value)
    };
    let fields = port["fields"].as_array().expect("fields");
    let size = port["bytes"].as_u64().expect("a number") as usize;
    bytes.chunks(size).map(|beat| fields.iter().map(|f| field(beat, f)).collect()).collect()
}

#[test]
fn a_pack_of_a_scene_says_where_it_is_from() {
    let folder = folder();
    let path = folder.path();
    let mesh = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n";
    fs::write(path.join("mesh.obj"), mesh).expect("written");
    let options =
        "--size 64x48 --cull back --projection asymptotic --param sampling=average --beats 30";
    let output = run(path, &format!("vectors hybrid --scene mesh.obj --out p {options}"));
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let manifest = manifest(&path.join("p/hybrid"));
    let scene = &manifest["scene"];
    assert_eq!(scene["name"], "mesh.obj");
    let hash = blake3::hash(mesh.as_bytes()).to_hex().to_string();
    assert_eq!(scene["file_blake3"], hash);
    assert_eq!([&scene["width"], &scene["height"]], [64, 48].map(Value::from).each_ref());
    assert_eq!(scene["projection"], "asymptotic");
    let setting = |list: &Value, name: &str| {
        let list = list.as_array().expect("settings").iter();
        list.filter(|s| s["name"] == name).map(|s| s["value"].clone()).next().expect("a setting")
    };
    assert_eq!(setting(&scene["options"], "cull"), "back");
    assert_eq!(setting(&scene["options"], "wire"), "off");
    assert_eq!(setting(&scene["options"], "sampling"), "average");
    assert_eq!(setting(&scene["rig"], "viewing_distance"), "60");
    assert_eq!(scene["ranges"].as_array().map(Vec::len), Some(1));
    let number = |name: &str| scene[name].as_u64().expect("a number");
    assert!(number("polygons") < number("polygons_of"), "{scene}");
    assert!(number("beats") < number("beats_of"), "{scene}");
    assert_eq!(number("beats"), beats(&path.join("p/hybrid"), "beat").len() as u64);
    let first = "beats of the primary pipeline's ";
    assert!(said(&output).contains(first), "{}", said(&output));
    let frames = &manifest["frames"];
    assert_eq!([&frames["width"], &frames["depth"]], [64, 0xff_ffff].map(Value::from).each_ref());
    assert_eq!(frames["open"][0], serde_json::json!([0, 64, 0, 48]));
    // The whole of it, by name alone.
    let output = run(path, "vectors minimal --scene ramp --size 64x48 --beats 100000 --out p");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let scene = &self::manifest(&path.join("p/minimal"))["scene"];
    assert_eq!(scene["beats"], scene["beats_of"]);
    assert_eq!(scene["polygons"], scene["polygons_of"]);
    assert!(scene["file_blake3"].is_null());
}

/// Symmetric clipping closes columns: reads of them answer with what the picture shows there.
#[test]
fn closed_columns_answer_as_the_picture_shows_them() {
    let folder = folder();
    let options = "--projection symmetric --size 160x120 --beats 60000 --param cost_rule=off";
    let output = run(folder.path(), &format!("vectors hybrid --scene room --out p {options}"));
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let pack = folder.path().join("p/hybrid");
    let frames = &manifest(&pack)["frames"];
    let [open_left, open_right] = [0, 1].map(|eye| frames["open"][eye].clone());
    assert_eq!(open_left[0], 0);
    assert_eq!(open_right[1], frames["width"]);
    let [first, end] = [&open_right[0], &open_left[1]].map(|n| n.as_u64().expect("a number"));
    assert!(first > 0 && end < 160);
    let colour: Vec<u64> =
        frames["colour"].as_array().expect("a colour").iter().filter_map(Value::as_u64).collect();
    let clear = colour[0] | colour[1] << 8 | colour[2] << 16;
    let mut closed = 0;
    let answers = beats(&pack, "response");
    for (request, answer) in beats(&pack, "request").iter().zip(&answers) {
        let [eye, x] = [0, 1].map(|n| request[n].1);
        if (eye == 0 && x >= end) || (eye == 1 && x < first) {
            closed += 1;
            assert_eq!([answer[0].1, answer[1].1], [clear, 0xff_ffff], "{request:?}");
        }
    }
    assert!(closed > 100, "{closed} reads of closed columns");
}

/// Runs the script on a pack.
fn script(pack: &Path, options: &[&str]) -> (Option<i32>, String) {
    let python = COCOTB.find().expect("cocotb").program.with_file_name("python3");
    let mut command = Command::new(python);
    command.arg(workspace().join("scripts/replay.py")).arg(pack).args(options);
    let output = command.current_dir(workspace()).output().expect("Python");
    (output.status.code(), said(&output))
}

#[test]
fn the_script_refuses_what_the_program_refuses() {
    let folder = folder();
    let output = run(folder.path(), "vectors filter --beats 20 --out p");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let pack = folder.path().join("p/filter");
    let wheatstone = ["--wheatstone", env!("CARGO_BIN_EXE_wheatstone")];
    let (status, text) = script(&pack, &wheatstone);
    assert!(status == Some(0) && text.contains("PASS"), "{text}");
    let path = pack.join("manifest.json");
    let sound = fs::read_to_string(&path).expect("a manifest");
    let outside = "\"../../../../../../../etc/passwd\"";
    for (find, replace, words) in [
        ("\"beat.bin\"", outside, "ports.beat.bin"),
        ("\"value\": 0", "\"value\": \"0\\n-m evil\"", "invalid type"),
        ("\"FILTER_TERMS\"", "\"FILTER_TERMS\\n-mevil\"", "field parameters"),
        ("\"module\": \"sam_filter\"", "\"module\": \"../evil\"", "field module"),
        ("\"seed\": 1", "\"seed\": 2", "field hash"),
    ] {
        fs::write(&path, sound.replacen(find, replace, 1)).expect("written");
        let (status, text) = script(&pack, &wheatstone);
        assert!(status == Some(2) && text.contains(words), "{replace}: {text}");
        assert!(!text.contains("PASS") && text.lines().count() == 1, "{replace}: {text}");
    }
    fs::write(&path, sound).expect("written");
    fs::write(pack.join("evil.vpi"), "").expect("written");
    let (status, text) = script(&pack, &wheatstone);
    assert!(status == Some(2) && text.contains("evil.vpi is no file of this pack"), "{text}");
    fs::remove_file(pack.join("evil.vpi")).expect("removed");
    // That the Verilog is another one is told, and no reason to stop.
    let other = folder.path().join("other");
    fs::create_dir(&other).expect("a folder");
    fs::write(other.join("sam_filter.v"), "other\n").expect("written");
    let (status, text) =
        script(&pack, &[&wheatstone[..], &["--rtl", &other.display().to_string()]].concat());
    assert!(text.contains("sound, ") && text.contains("made for other Verilog"), "{text}");
    assert!(status == Some(2) && text.contains("iverilog refuses sam_filter"), "{text}");
    // What a check says that did not end well, and its status.
    for says in ["echo late >&2; exit 4", "kill -9 $$"] {
        let program = folder.path().join("program");
        fs::write(&program, format!("#!/bin/sh\n{says}\n")).expect("written");
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(&program, mode).expect("made executable");
        let (found, text) = script(&pack, &["--wheatstone", &program.display().to_string()]);
        assert_eq!(found, Some(4), "{says}: {text}");
        assert!(!text.trim().is_empty() && !text.contains("PASS"), "{says}: {text}");
    }
    let (status, text) = script(&pack, &["--wheatstone", "/no/wheatstone"]);
    assert!(status == Some(3) && text.contains("cargo build"), "{text}");
}

#[test]
fn a_copy_is_what_was_checked() {
    let folder = folder();
    assert!(run(folder.path(), "vectors display blend --beats 20 --out p").status.success());
    let output = run(folder.path(), "check p/display --copy copy");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let files = |path: &str| {
        let entries = fs::read_dir(folder.path().join(path)).expect("a folder");
        let mut files: Vec<_> = entries
            .map(|entry| entry.expect("an entry").path())
            .map(|path| (path.file_name().map(ToOwned::to_owned), fs::read(&path).expect("a file")))
            .collect();
        files.sort();
        files
    };
    assert_eq!(files("copy"), files("p/display"));
    // Never into a folder that is there, and one pack at a time; what is no folder is told as what it is.
    assert!(Command::new("mkfifo")
        .arg(folder.path().join("pipe"))
        .status()
        .expect("it runs")
        .success());
    for (line, words) in [
        ("check p/display --copy copy", "copy: is there already; name a folder that is not"),
        ("check p --copy other", "p/manifest.json: No such file"),
        ("check pipe", "pipe: a pipe (FIFO); name the folder of a pack"),
        ("check none", "none: No such file or directory"),
        ("check p/display/vec.vh", "vec.vh: a file; name the folder of a pack"),
        ("vectors blend --out p/display", "p/display is a vector pack, which has its own files"),
        (
            "vectors blend --out p/display/new",
            "p/display is a vector pack, which has its own files",
        ),
    ] {
        let output = run(folder.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        assert!(said(&output).contains(words), "{line}: {}", said(&output));
    }
    assert_eq!(files("copy"), files("p/display"));
}
