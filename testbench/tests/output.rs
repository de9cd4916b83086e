//! Output of the program, and the places that it writes to: no error is lost, no device replaced, no terminal taken
//! over.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::FileTypeExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).stdin(Stdio::null());
    command
}

/// Runs the program with its standard output on a device.
fn into(device: &str, line: &str) -> Output {
    let device = File::options().write(true).open(device).expect("a device");
    let mut command = program(Path::new("."));
    command.args(line.split(' ')).stdout(device).output().expect("the program runs")
}

fn run(folder: &Path, words: &[&OsStr]) -> Output {
    program(folder).args(words).output().expect("the program runs")
}

fn line(folder: &Path, line: &str) -> Output {
    run(folder, &line.split(' ').map(OsStr::new).collect::<Vec<_>>())
}

fn said(output: &Output) -> String {
    String::from_utf8([&output.stdout[..], &output.stderr[..]].concat()).expect("text")
}

#[test]
fn a_result_that_cannot_be_printed_is_an_error() {
    for line in ["list", "list --json", "--help", "--version", "rig --scene ramp", "rig --help"] {
        let output = into("/dev/full", line);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{line}: {text}");
        assert_eq!(
            text.matches("standard output: cannot be written: No space").count(),
            1,
            "{text}"
        );
        assert_eq!(into("/dev/null", line).status.code(), Some(0), "{line}");
        // Nobody reads it any more.
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let mut command = program(Path::new("."));
        let output = command.args(line.split(' ')).stdout(writer).output().expect("it runs");
        assert_eq!((output.status.code(), said(&output)), (Some(0), String::new()), "{line}");
    }
}

/// The null device, which takes the place of a closed stream, is no place for results.
#[test]
fn a_closed_standard_output_is_an_error() {
    for (redirection, status) in [(">&-", 2), (">/dev/null", 0), ("1<>/dev/null", 0)] {
        let script = format!("exec {} list --json {redirection}", env!("CARGO_BIN_EXE_wheatstone"));
        let output = Command::new("sh").arg("-c").arg(&script).output().expect("it runs");
        assert_eq!(output.status.code(), Some(status), "{redirection}: {}", said(&output));
        let told = said(&output).contains("error: standard output is closed: ");
        assert_eq!(told, status == 2, "{redirection}: {}", said(&output));
    }
}

#[test]
fn a_report_goes_to_where_its_name_leads() {
    let folder = tempfile::tempdir().expect("a folder");
    let rig = |file: &str| line(folder.path(), &format!("rig --scene ramp --json {file}"));
    std::os::unix::fs::symlink("/dev/stdout", folder.path().join("link")).expect("a link");
    for file in ["/dev/stdout", "/proc/self/fd/1", "link"] {
        let output = rig(file);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(0), "{file}: {text}");
        assert!(text.starts_with("ramp, ") && text.trim_end().ends_with('}'), "{file}: {text}");
    }
    assert!(folder.path().join("link").is_symlink());
    // Standard output is a file: what was printed before stays.
    let file = File::create(folder.path().join("all")).expect("a file");
    let mut command = program(folder.path());
    command.args(["rig", "--scene", "ramp", "--json", "/dev/stdout"]).stdout(file);
    assert!(command.status().expect("it runs").success());
    let text = fs::read_to_string(folder.path().join("all")).expect("text");
    assert!(text.starts_with("ramp, ") && text.trim_end().ends_with('}'), "{text}");

    let mkfifo = Command::new("mkfifo").current_dir(folder.path()).arg("pipe").status();
    assert!(mkfifo.expect("it runs").success());
    let output = rig("pipe");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("pipe: cannot be written: no program reads from it"));
    let output = rig("/dev/full");
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).contains("/dev/full: cannot be written: No space left"));
    // Who may make devices may replace them.
    let node = folder.path().join("node");
    let mknod =
        Command::new("mknod").arg(&node).args(["c", "1", "3"]).stderr(Stdio::null()).status();
    if mknod.is_ok_and(|status| status.success()) && File::options().write(true).open(&node).is_ok()
    {
        assert_eq!(rig("node").status.code(), Some(0));
        assert!(fs::metadata(&node).expect("a device").file_type().is_char_device());
    }
    let left: Vec<_> = fs::read_dir(folder.path()).expect("a folder").flatten().collect();
    assert!(left.iter().all(|e| !e.file_name().to_string_lossy().ends_with(".part")), "{left:?}");
}

#[test]
fn places_that_cannot_be_written_are_named_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [("file", ""), ("r.json", "{}"), ("s.obj", "")] {
        fs::write(folder.path().join(name), text).expect("written");
    }
    fs::create_dir_all(folder.path().join("pack")).expect("a folder");
    let manifest = r#"{"format": "wheatstone-vectors"}"#;
    fs::write(folder.path().join("pack/manifest.json"), manifest).expect("written");
    for (words, told) in [
        ("render --scene ramp --method direct --out file/pictures", "--out file/pictures: "),
        ("vectors display --beats 10 --out file/packs", "--out file/packs: "),
        ("waves display --out file/waves", "--out file/waves: "),
        (
            "cosim display --json r --junit ./r",
            "--junit ./r: --json names it too; name another one",
        ),
        ("cosim display --json pack", "--json pack: a folder; name a file in it"),
        ("cosim display --junit new/", "--junit new/: the name of a folder; name a file"),
        ("cosim display --out /dev/null", "--out /dev/null: a device, where a folder is expected"),
        ("cosim display --out file", "--out file: a file, where a folder is expected"),
        ("cosim display --json x --out x", "--out x: --json names it too"),
        ("cover filter --json pack", "--json pack: a folder"),
        ("replay filter --json pack", "--json pack: a folder"),
        ("prove filter --json pack", "--json pack: a folder"),
        ("synth filter --json pack", "--json pack: a folder"),
        ("mutate filter --json pack", "--json pack: a folder"),
        ("baseline --json pack", "--json pack: a folder"),
        ("reproduce filter --out file", "--out file: a file"),
        ("compare --scene s.obj --json s.obj", "--json s.obj: --scene names it too"),
        ("rig --scene ramp --rig r.json --json pack/../r.json", "--rig names it too"),
        ("render --scene ramp --method direct --out pack/p", "pack is a vector pack, which has"),
        ("rig --scene ramp --json pack/r", "pack is a vector pack, which has its own files alone"),
    ] {
        let output = line(folder.path(), words);
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{words}: {text}");
        assert!(text.contains(told) && text.lines().count() == 1, "{words}: {text}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 4, "nothing was made");
}

#[test]
fn parameters_that_pictures_know_nothing_of_are_errors() {
    let folder = tempfile::tempdir().expect("a folder");
    for (words, told) in [
        (
            "render --method direct --param filter=2",
            "filter: makes no difference to pictures by --method direct",
        ),
        (
            "render --method direct --param latency=4",
            "latency: makes no difference to pictures by --method direct",
        ),
        (
            "render --method minimal --param depth=sampled",
            "depth: makes no difference to pictures by --method minimal",
        ),
        ("render --param slots=4", "slots: makes no difference to pictures by --method hybrid"),
        ("compare --param latency=4", "latency: makes no difference to views that no clock"),
    ] {
        let output = line(folder.path(), &format!("{words} --scene ramp --out p"));
        let text = said(&output);
        assert_eq!(output.status.code(), Some(2), "{words}: {text}");
        assert!(text.starts_with(&format!("error: --param {told}")), "{words}: {text}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}

/// Text that clears the screen, and text that turns the direction of writing.
const WILD: &str = "\u{1b}[2J\u{9b}1m\u{7f}\u{202e}\r";

fn is_tame(output: &Output) -> bool {
    let wild = |c: char| c != '\n' && (c.is_control() || c == '\u{202e}');
    !said(output).contains(wild)
}

#[test]
fn what_strangers_wrote_does_not_reach_the_terminal() {
    let folder = tempfile::tempdir().expect("a folder");
    let name = |end: &str| format!("{WILD}{end}");
    fs::write(folder.path().join(name("a.obj")), format!("v {WILD}\n")).expect("written");
    fs::write(folder.path().join(name("b.obj")), "v 0 0 0\n").expect("written");
    fs::write(folder.path().join(name("c.json")), format!("{{\"{WILD}\": 1}}")).expect("written");
    fs::write(folder.path().join(name("d.grid")), format!("1 {WILD}\n")).expect("written");
    let out = name("pictures");
    for scene in ["a.obj", "b.obj", "c.json", "d.grid", "none.obj", "none"].map(name) {
        let words = ["render", "--method", "direct", "--out", &out, "--scene", &scene];
        let output = run(folder.path(), &words.map(OsStr::new));
        assert!(is_tame(&output), "{scene:?}: {:?}", said(&output));
    }
    let long = "x".repeat(100_000);
    for words in [
        &["cosim", WILD][..],
        &["cosim", &long],
        &[WILD],
        &["render", "--out", "p", "--size", WILD],
        &["check", WILD],
        &["rig", "--rig", WILD],
        &["rig", "--json", WILD, "--out", WILD, "--scene", "ramp"],
        &["cosim", "display", "--case", WILD],
        &["cosim", "display", "--rtl", WILD],
        &["cosim", "--param", WILD],
    ] {
        let output = run(folder.path(), &words.iter().map(OsStr::new).collect::<Vec<_>>());
        let text = said(&output);
        assert!(is_tame(&output), "{words:?}: {text:?}");
        assert!(text.len() < 20_000, "{words:?}: {} bytes", text.len());
        assert!(!text.is_empty(), "{words:?}");
    }
}

#[test]
fn names_that_are_no_text_are_no_panic() {
    let folder = tempfile::tempdir().expect("a folder");
    let wild = OsStr::from_bytes(b"\xff\xfe");
    let report = folder.path().join("report");
    let words = ["rig", "--scene", "ramp", "--json"].map(OsStr::new);
    let words = [&words[..], &[report.as_os_str(), OsStr::new("--out"), wild]].concat();
    let output = run(folder.path(), &words);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(report.exists() && folder.path().join(wild).is_dir());
    let output = run(folder.path(), &[OsStr::new("rig"), OsStr::new("--scene"), wild]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(said(&output).starts_with("error: "), "{}", said(&output));
}
