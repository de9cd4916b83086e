//! The program as a user meets it: exit statuses, messages, and what a run leaves behind.

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;

/// The program, in a folder.
fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).env("NO_COLOR", "1");
    command
}

fn run(folder: &Path, line: &str) -> Output {
    program(folder).args(line.split_whitespace()).output().expect("the program runs")
}

fn said(output: &Output) -> String {
    let [out, err] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text));
    format!("{out}{err}")
}

/// A folder with files in it.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

/// Names of all files under a folder.
fn files(folder: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path.to_string_lossy().into_owned());
        }
    }
    found
}

/// A workspace of its own: a copy of the Verilog, and a cache without models.
struct Workspace {
    folder: tempfile::TempDir,
    _cache: tempfile::TempDir,
}

impl Workspace {
    fn new() -> Workspace {
        let (folder, cache) = (folder(&[]), common::fresh_cache());
        let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rtl");
        fs::create_dir(folder.path().join("rtl")).expect("a folder");
        for entry in fs::read_dir(rtl).expect("the Verilog") {
            let entry = entry.expect("an entry");
            fs::copy(entry.path(), folder.path().join("rtl").join(entry.file_name()))
                .expect("copied");
        }
        fs::create_dir_all(folder.path().join("target/wheatstone")).expect("a folder");
        let models = folder.path().join("target/wheatstone/models");
        std::os::unix::fs::symlink(cache.path(), models).expect("a link");
        Workspace { folder, _cache: cache }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Copies the Verilog into another folder, with one text in it replaced.
    fn plant(&self, copy: &str, file: &str, find: &str, replace: &str) {
        let copy = self.path().join(copy);
        fs::create_dir(&copy).expect("a folder");
        for entry in fs::read_dir(self.path().join("rtl")).expect("the Verilog") {
            let entry = entry.expect("an entry");
            fs::copy(entry.path(), copy.join(entry.file_name())).expect("copied");
        }
        let text = fs::read_to_string(copy.join(file)).expect("a module");
        assert_eq!(text.matches(find).count(), 1, "{file}: {find}");
        fs::write(copy.join(file), text.replace(find, replace)).expect("written");
    }

    /// Runs a shell's command.
    fn shell(&self, command: &str) -> Output {
        let mut shell = Command::new("sh");
        shell.current_dir(self.path()).args(["-c", command]).output().expect("sh")
    }
}

/// The lines of that name in reports of mismatches.
fn told(output: &Output, name: &str) -> Vec<String> {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let (_, reports) = text.split_once("MISMATCH\n").expect("a report");
    let lines = reports.lines().filter_map(|line| line.trim_start().strip_prefix(name));
    lines.map(|line| line.trim().to_owned()).collect()
}

/// Names of the entries of a folder that begin with a point.
fn hidden(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_hidden =
        |path: &PathBuf| path.file_name().is_some_and(|n| n.to_string_lossy().starts_with('.'));
    entries.filter(is_hidden).collect()
}

/// Starts the program and kills it as soon as `ready`.
fn kill_when(folder: &Path, line: &str, ready: impl Fn() -> bool) {
    let mut command = program(folder);
    command.args(line.split_whitespace()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().expect("started");
    while !ready() {
        assert!(child.try_wait().expect("a child").is_none(), "{line} ended too soon");
        std::thread::sleep(Duration::from_millis(1));
    }
    // Where a child of the program does the work, that one.
    let id = child.id();
    let children = fs::read_to_string(format!("/proc/{id}/task/{id}/children")).expect("Linux");
    let worker = children.split_whitespace().next().map_or(id.to_string(), str::to_owned);
    assert!(Command::new("kill").args(["-KILL", &worker]).status().expect("kill").success());
    child.wait().expect("ended");
}

/// A triangle in the scene format, with one text in it replaced.
fn scene(find: &str, replace: &str) -> String {
    let text = r#"{"format": "stereo-scene/1", "width": 64, "height": 48,
"pixels_per_unit": 10, "eye_separation": 0.6, "viewing_distance": 5,
"background": [0, 0, 0],
"vertices": [[-1, -1, 0], [1, -1, 0], [0, 1, 1]],
"colors": [[255, 0, 0], [0, 255, 0], [0, 0, 255]],
"triangles": [[0, 1, 2]]}"#;
    assert!(find.is_empty() || text.contains(find), "{find}");
    text.replace(find, replace)
}

const OBJ: &str = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n";

/// Options, files given, and words of the message.
type Refused<'a> = (&'a str, &'a [(&'a str, &'a str)], &'a [&'a str]);

/// Bad input, and what the message must say of it.
#[test]
fn bad_input_is_told_by_file_place_and_expectation() {
    let empty = folder(&[]);
    let table: &[Refused] = &[
        ("--scene a.obj", &[("a.obj", "v 0 0 0\nv 1 0\nf 1 1 1\n")], &["a.obj:2", "expected"]),
        ("--scene a.obj", &[("a.obj", "v 0 0 0\nv 1 0 x\n")], &["a.obj:2", "number", "found x"]),
        ("--scene a.obj", &[("a.obj", "v 0 0 nan\nf 1 1 1\n")], &["a.obj:1", "expected"]),
        ("--scene a.obj", &[("a.obj", "v 0 0 1e400\nf 1 1 1\n")], &["a.obj:1", "expected"]),
        ("--scene a.obj", &[("a.obj", "v 0 0 0\nf 1 2 3\n")], &["a.obj:2", "expected"]),
        ("--scene a.obj", &[("a.obj", "")], &["a.obj", "expected"]),
        ("--scene a.obj", &[], &["a.obj", "cannot be read"]),
        ("--strict --scene a.obj", &[("a.obj", OBJ)], &["a.obj:1", "m.mtl", "no such library"]),
        (
            "--strict --scene a.obj",
            &[("a.obj", OBJ), ("m.mtl", "newmtl a\nKd 1 0\n")],
            &["m.mtl:2", "Kd"],
        ),
        (
            "--strict --scene a.obj",
            &[("a.obj", OBJ), ("m.mtl", "newmtl a\nmap_Kd none.png\n")],
            &["m.mtl:2", "none.png", "no such picture"],
        ),
        (
            "--strict --scene a.obj",
            &[("a.obj", OBJ), ("m.mtl", "newmtl a\nmap_Kd t.png\n"), ("t.png", "no picture")],
            &["t.png"],
        ),
        ("--scene s.json", &[("s.json", "{\"format\"")], &["s.json:1", "expected"]),
        ("--scene s.json", &[("s.json", &scene("/1", "/2"))], &["s.json:1", "stereo-scene/1"]),
        ("--scene s.json", &[("s.json", &scene("64", "0"))], &["s.json:1", "width", "found 0"]),
        ("--scene s.json", &[("s.json", &scene("64", "2049"))], &["s.json:1", "width", "2049"]),
        ("--scene s.json", &[("s.json", &scene("1, 2]]", "1, 3]]"))], &["s.json:6", "triangles"]),
        ("--scene s.json", &[("s.json", &scene("255, 0, 0", "256, 0, 0"))], &["s.json:5", "256"]),
        ("--scene s.json", &[("s.json", &scene("[0, 1, 1]", "[0, 1]"))], &["s.json:4", "vertices"]),
        ("--scene s.json", &[("s.json", &scene("0.6", "-1"))], &["s.json:2", "eye_separation"]),
        ("--scene s.json", &[("s.json", &scene("0.6", "1e999"))], &["s.json:2", "expected"]),
        ("--scene s.json", &[("s.json", &scene("\"width\": 64,", ""))], &["s.json", "width"]),
        ("--scene s.json", &[("s.json", &scene("{\"f", "{\"q\": 1, \"f"))], &["s.json", "q"]),
        ("--scene ramp --rig r.json", &[], &["r.json", "cannot be read"]),
        ("--scene ramp --rig r.json", &[("r.json", "{\"near\": -1}")], &["r.json:1", "near"]),
        ("--scene ramp --rig r.json", &[("r.json", "{\"eyes\": 2}")], &["r.json:1", "eyes"]),
        ("--scene nothing", &[], &["nothing", "teapot", ".obj"]),
        ("--scene ramp --size 0x5", &[], &["0x5", "each from 1 to 2048"]),
        ("--scene ramp --size 5x2049", &[], &["5x2049", "each from 1 to 2048"]),
        ("--scene ramp --size 641x480 --config paper", &[], &["641x480", "640x640"]),
        ("--scene ramp --size 64", &[], &["64", "640x480"]),
        ("--scene ramp --param speed=9", &[], &["speed=9", "subpixel_bits"]),
        ("--scene ramp --param slots=3", &[], &["slots", "2, 4, 8"]),
        ("--scene ramp --param slots", &[], &["NAME=VALUE"]),
        ("--scene ramp --config huge", &[], &["huge", "default, paper, full"]),
        ("--scene ramp --method magic", &[], &["magic", "direct"]),
        ("--scene ramp --stereo purple", &[], &["purple", "anaglyph"]),
    ];
    for (arguments, given, words) in table {
        let folder = folder(given);
        let method = if arguments.contains("--method") { "" } else { "--method hybrid" };
        let line = format!("render {arguments} {method} --out pictures");
        let output = run(folder.path(), &line);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        for word in *words {
            assert!(text.contains(word), "{line}: no “{word}” in: {text}");
        }
        assert!(!text.contains("panicked"), "{line}: {text}");
        let pictures = folder.path().join("pictures");
        assert!(!pictures.exists() || files(&pictures).is_empty(), "{line} left files");
    }
    for line in
        ["cosim warp", "cosim --beats 0", "check nowhere", "frob", "waves", "waves filter hybrid"]
    {
        let output = run(empty.path(), line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
    }
}

#[test]
fn triangles_without_area_are_legal_and_draw_nothing() {
    let flat = scene("[0, 1, 1]", "[1, -1, 0]");
    let folder = folder(&[("s.json", &flat)]);
    for method in ["direct", "minimal", "hybrid"] {
        let output =
            run(folder.path(), &format!("render --scene s.json --method {method} --out p"));
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        let ids = image::open(folder.path().join("p/left_ids.png")).expect("a picture").to_rgb8();
        assert!(ids.pixels().all(|p| p.0 == [0; 3]));
    }
}

#[test]
fn pictures_have_ids_of_the_triangles() {
    let folder = folder(&[("s.json", &scene("", ""))]);
    let output =
        run(folder.path(), "render --scene s.json --method direct --out p --stereo anaglyph");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("would draw 1 polygon, 1 derived"), "{}", said(&output));
    for eye in ["left", "right"] {
        let ids =
            image::open(folder.path().join(format!("p/{eye}_ids.png"))).expect("ids").to_rgb8();
        assert_eq!(ids.dimensions(), (64, 48));
        assert_eq!(ids.get_pixel(32, 24).0, [0, 0, 1], "triangle 0 is drawn as 1");
        assert_eq!(ids.get_pixel(0, 0).0, [0; 3]);
    }
    assert!(folder.path().join("p/anaglyph.png").exists());
}

/// A limit to the size of files breaks off a write in its middle, as a full disk does.
#[test]
fn a_write_that_fails_half_way_is_an_error_and_leaves_nothing() {
    for line in [
        "render --scene room --method direct --size 320x240 --out p",
        "vectors filter --beats 2000 --out p",
    ] {
        let folder = folder(&[]);
        let program = env!("CARGO_BIN_EXE_wheatstone");
        let limited = format!("trap '' XFSZ; ulimit -f 8; exec {program} {line}");
        let mut shell = Command::new("sh");
        let output = shell.current_dir(folder.path()).args(["-c", &limited]).output().expect("sh");
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        assert!(text.contains("File too large") && text.contains('p'), "{line}: {text}");
        let left = files(folder.path());
        assert!(left.iter().all(|file| image::open(file).is_ok()), "{line} left {left:?}");
    }
}

#[test]
fn a_killed_run_leaves_no_half_written_file() {
    for (n, wait) in [5, 40, 120, 250].into_iter().enumerate() {
        let folder = folder(&[]);
        let line = "render --scene room --method hybrid --out p --stereo anaglyph,wiggle";
        let mut child = program(folder.path())
            .args(line.split_whitespace())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("started");
        std::thread::sleep(Duration::from_millis(wait));
        child.kill().expect("killed");
        child.wait().expect("ended");
        for file in files(folder.path()).iter().filter(|file| !file.ends_with(".part")) {
            assert!(image::open(file).is_ok(), "run {n}: {file} is half-written");
        }
    }
}

#[test]
fn a_killed_build_does_not_disturb_the_next() {
    let workspace = Workspace::new();
    let models = workspace.path().join("target/wheatstone/models");
    let line = "cosim display --beats 100";
    // The compiler is at work, and goes on when nobody waits for it any more.
    kill_when(workspace.path(), line, || {
        hidden(&models).iter().any(|folder| folder.join("cpp/model.cpp").exists())
    });
    assert_eq!(hidden(&models).len(), 1);
    let output = run(workspace.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(hidden(&models), Vec::<PathBuf>::new());
}

#[test]
fn a_killed_writer_of_packs_leaves_nothing_for_good() {
    let folder = folder(&[]);
    let packs = folder.path().join("p");
    kill_when(folder.path(), "vectors sampler --beats 300000 --out p", || {
        !hidden(&packs).is_empty()
    });
    assert_eq!(hidden(&packs).len(), 1);
    let output = run(folder.path(), "vectors display --beats 10 --out p");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert_eq!(fs::read_dir(&packs).expect("packs").count(), 1, "{:?}", hidden(&packs));
}

/// Three cases fail side by side; their folders' names need quoting.
#[test]
fn every_failing_case_has_waves_of_its_own_and_a_command_that_repeats_it() {
    let workspace = Workspace::new();
    let program = env!("CARGO_BIN_EXE_wheatstone");
    workspace.plant("it's $RTL", "sam_display.v", "width_i + ~point_x_i", "width_i - ~point_x_i");
    let options =
        r#"display --rtl "it's \$RTL" --out "o u t" --config paper --beats 40000 --jobs 3"#;
    let output = workspace.shell(&format!("{program} cosim {options} --json 'a report'"));
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let (what, waves) = (told(&output, "what"), told(&output, "waveforms"));
    let repeat = told(&output, "repeat with");
    assert_eq!([what.len(), waves.len(), repeat.len()], [3; 3], "{}", said(&output));
    assert!(waves.iter().any(|file| *file == "o u t/display-random-seed1-run1.fst"), "{waves:?}");
    for (n, file) in waves.iter().enumerate() {
        assert!(!waves[..n].contains(file), "{waves:?}");
        for end in ["fst", "gtkw", "sucl"] {
            let file = workspace.path().join(file).with_extension(end);
            assert!(fs::metadata(&file).is_ok_and(|f| f.len() > 100), "{}", file.display());
        }
    }
    assert_eq!(hidden(&workspace.path().join("o u t")), Vec::<PathBuf>::new());

    let report = fs::read_to_string(workspace.path().join("a report")).expect("the report");
    for (command, what) in repeat.iter().zip(&what) {
        let again = workspace.shell(command);
        assert_eq!(again.status.code(), Some(1), "{command}: {}", said(&again));
        assert_eq!(told(&again, "what"), [what.as_str()], "{command}");
        assert_eq!(told(&again, "repeat with"), [command.as_str()]);
    }
    let same = fs::read_to_string(workspace.path().join("a report")).expect("the report");
    assert!(report == same, "a repetition leaves the report alone");

    let output = workspace.shell(&format!("{program} cosim display --case rndom"));
    let text = said(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(
        text.contains("there are: “every mode, width 1”") && text.contains("“random”"),
        "{text}"
    );
}

/// A mismatch is told whatever becomes of the waveforms; without one it is an error.
#[test]
fn waves_without_room_are_told_and_leave_nothing() {
    let workspace = Workspace::new();
    workspace.plant("bug", "sam_display.v", "width_i + ~point_x_i", "width_i - ~point_x_i");
    let cosim = "cosim display --beats 1000 --out o";
    let run = |limit: &str, line: &str| {
        let program = env!("CARGO_BIN_EXE_wheatstone");
        workspace.shell(&format!("{limit} exec {program} {line}"))
    };
    // In units of 512 bytes: room for the copy of the model that is loaded, not for a dump.
    let limit = "trap '' XFSZ; ulimit -f 8192;";
    let bug = format!("{cosim} --rtl bug --case random");
    let (free, full) = (run("", &format!("{bug} --waves never")), run(limit, &bug));
    assert_eq!([free.status.code(), full.status.code()], [Some(1); 2], "{}", said(&full));
    assert_eq!(told(&free, "what"), told(&full, "what"));
    let [line] = told(&full, "waveforms").try_into().expect("a line about the waveforms");
    assert!(line.starts_with("failed because no room for waveforms in /"), "{line}");

    // A device takes no bytes only when they come.
    let unwritten = run("", &format!("{bug} --waves never --json /dev/full --junit r"));
    assert_eq!(unwritten.status.code(), Some(1), "{}", said(&unwritten));
    assert_eq!(told(&free, "what"), told(&unwritten, "what"));
    assert!(said(&unwritten).contains("/dev/full: cannot be written"), "{}", said(&unwritten));

    let always = format!("{cosim} --waves always");
    let output = run("", &always);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let made = files(&workspace.path().join("o"));
    assert_eq!(made.iter().filter(|file| file.ends_with(".fst")).count(), 3, "{made:?}");
    fs::remove_dir_all(workspace.path().join("o")).expect("removed");

    for line in [always.as_str(), "waves display --out o/p"] {
        let output = run(limit, line);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        assert!(text.contains("no room for waveforms in /"), "{line}: {text}");
        assert!(!workspace.path().join("o").exists(), "{line} left a folder");
    }
}

#[test]
fn a_viewer_that_does_not_open_is_an_error_of_one_line() {
    let refuses = "echo 'Could not initialize GTK!' >&2; echo 'Usage: gtkwave' >&2; exit 0";
    for (script, status) in [(refuses, 2), ("exit 7", 2), ("exec sleep 3", 0)] {
        // Written by a process that ends before it is run: one that is open cannot be run.
        let (folder, write) =
            (folder(&[]), r##"printf '#!/bin/sh\n%s\n' "$1" >gtkwave; chmod +x gtkwave"##);
        let mut shell = Command::new("sh");
        shell.current_dir(folder.path()).args(["-c", write, "sh", script]);
        assert!(shell.status().expect("sh").success());
        let path = std::env::var("PATH").expect("a path");
        let output = program(folder.path())
            .args(["waves", "display", "--open", "--out", "."])
            .env("PATH", format!("{}:{path}", folder.path().display()))
            .output()
            .expect("the program runs");
        let text = said(&output);
        assert_eq!(output.status.code(), Some(status), "{script}: {text}");
        let errors = text.lines().filter(|line| line.starts_with("error: ")).count();
        assert_eq!(errors, usize::from(status == 2), "{text}");
        assert_eq!(text.contains("Could not initialize GTK!"), script == refuses, "{text}");
        assert!(!text.contains("Usage"), "{text}");
    }
}

/// From wherever the program is called, its models are where the workspace has them.
#[test]
fn no_models_are_left_where_the_program_is_called() {
    let folder = folder(&[]);
    let output = run(folder.path(), "cosim display --beats 100");
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let output = run(folder.path(), "waves display --scene ramp --pixel left,0,0");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

#[test]
fn a_unit_takes_no_scene() {
    let folder = folder(&[]);
    for (line, unit) in [
        ("cosim hybrid filter --scene ties", "filter"),
        ("cosim filter --scene teapot", "filter"),
        ("cosim hybrid display --scene ties", "display"),
    ] {
        let output = run(folder.path(), line);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        assert!(text.contains(&format!("--scene: {unit} draws no scenes")), "{line}: {text}");
    }
}

/// A record is of this Verilog and of the measurement that everybody repeats.
#[test]
fn a_record_is_of_nothing_unusual() {
    // Of its own: what is not refused writes the record.
    let workspace = Workspace::new();
    for (command, options) in [
        ("synth --record", &["--rtl r", "--param slots=4"][..]),
        ("baseline --record", &["--rtl r", "--scene ties", "--size 64x48"]),
        ("mutate --record", &["--rtl r", "--count 5", "--seed 2", "--beats 10"]),
        ("cover --record", &["--rtl r", "--seed 2", "--beats 10", "filter"]),
        ("replay --record", &["--rtl r", "--seed 2", "--beats 10", "--packs p"]),
        ("prove --record", &["--rtl r", "--quick", "--bugs"]),
        ("synth --check", &["--record", "--param slots=4"]),
        ("baseline --check", &["--record", "--scene ties", "--size 64x48"]),
        ("mutate --check", &["--record", "--count 5", "--seed 2", "--beats 10"]),
        ("cover --check", &["--record", "--seed 2", "--beats 10", "filter"]),
        ("replay --check", &["--record", "--seed 2", "--beats 10", "--packs p"]),
    ] {
        for option in options {
            let output = run(workspace.path(), &format!("{command} {option}"));
            let text = said(&output);
            assert_eq!(output.status.code(), Some(2), "{command} {option}: {text}");
            assert!(text.contains("cannot be used with"), "{command} {option}: {text}");
        }
    }
}

#[test]
fn a_bad_scene_is_told_before_models_are_built() {
    let workspace = Workspace::new();
    let output = run(workspace.path(), "baseline --scene nosuch");
    let text = said(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.starts_with("error: scene nosuch: "), "{text}");
    assert!(!text.contains("building"), "{text}");
}

#[test]
fn a_list_of_reviewed_mutants_that_cannot_be_read_is_told_as_what_it_is() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path().join("synth")).expect("a folder");
    let list = workspace.path().join("synth/mutants_reviewed.json");
    fs::write(&list, "[{}]").expect("written");
    let output = run(workspace.path(), "mutate display");
    let text = said(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains("missing field `target`") && text.contains("written by hand"), "{text}");
    assert!(!text.contains("write it with"), "{text}");
}

#[test]
fn a_closed_pipe_is_no_panic() {
    let folder = folder(&[]);
    let mut child = program(folder.path())
        .args(["cosim", "display", "--beats", "1000", "--jobs", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    drop(child.stdout.take());
    drop(child.stderr.take());
    assert_eq!(child.wait().expect("ended").code(), Some(0));
}

#[test]
fn reports_say_what_was_compared() {
    let folder = folder(&[]);
    let line = "cosim redirect --beats 1000 --json r.json --junit r.xml --seed 7";
    let output = run(folder.path(), line);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let json = fs::read_to_string(folder.path().join("r.json")).expect("the report");
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let text = json.to_string();
    assert!(text.contains("redirect") && text.contains("mismatch"), "{text}");
    let junit = fs::read_to_string(folder.path().join("r.xml")).expect("the report");
    assert!(junit.contains("<testsuite") && junit.contains("redirect"), "{junit}");
}

/// Without the simulator the program says how to install it, and exits with 3.
#[test]
fn a_missing_simulator_is_named_with_its_remedy() {
    let folder = folder(&[]);
    let output = program(folder.path())
        .args(["cosim", "filter", "--beats", "10"])
        .env("PATH", folder.path())
        .output()
        .expect("the program runs");
    let text = said(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("verilator") && text.contains("apt"), "{text}");
}

/// Golden models have mutants without a simulator: it is not what is missing.
#[test]
fn mutants_of_golden_models_need_no_simulator() {
    let workspace = Workspace::new();
    fs::create_dir(workspace.path().join("synth")).expect("a folder");
    fs::write(workspace.path().join("synth/mutants_reviewed.json"), "[]").expect("written");
    let output = program(workspace.path())
        .args(["mutate", "--golden", "filter"])
        .env("PATH", workspace.path())
        .output()
        .expect("the program runs");
    let text = said(&output);
    // Whether cargo mutants is installed or not: there is no golden model here.
    let is_told = [(3, "cargo-mutants"), (2, "there is no golden/src/pipeline/filter.rs")];
    let is_it =
        |(status, what): (i32, &str)| output.status.code() == Some(status) && text.contains(what);
    assert!(is_told.into_iter().any(is_it) && !text.contains("verilator"), "{text}");
}

/// The pictures of a run belong together: none is left of one that showed something else.
#[test]
fn pictures_replace_those_of_an_older_run_together() {
    let folder = folder(&[]);
    let render = |line: &str| {
        run(folder.path(), &format!("render --method direct --size 64x48 --out p {line}"))
    };
    assert_eq!(render("--scene ramp --stereo anaglyph,parallel").status.code(), Some(0));
    let older = fs::read(folder.path().join("p/left.png")).expect("a picture");
    assert_eq!(render("--scene ties --stereo crossed").status.code(), Some(0));
    assert_ne!(fs::read(folder.path().join("p/left.png")).expect("a picture"), older);
    let mut names: Vec<String> = files(&folder.path().join("p"));
    names.sort();
    let names: Vec<&str> = names.iter().filter_map(|name| name.rsplit('/').next()).collect();
    assert_eq!(names, ["crossed.png", "left.png", "left_ids.png", "right.png", "right_ids.png"]);
}
