//! Warnings of a mesh on the command line, and `--strict`; pipes and devices in place of its files.

use std::path::Path;
use std::process::{Command, Output};
use std::time::Duration;
use wheatstone_process::Process;

fn run(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).args(line.split(' ')).output().expect("the program runs")
}

#[test]
fn what_is_not_followed_is_told_or_with_strict_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n".to_string();
    std::fs::write(folder.path().join("a.obj"), mesh + &"p 1\n".repeat(12)).unwrap();
    std::fs::write(folder.path().join("b.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").unwrap();
    let warnings = |output: &Output| {
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let count = text.lines().filter(|line| line.starts_with("warning: a.obj")).count();
        (text, count)
    };
    for command in ["rig", "render --size 64x48 --out drawn"] {
        let output = run(folder.path(), &format!("{command} --scene a.obj"));
        let (text, count) = warnings(&output);
        assert_eq!(output.status.code(), Some(0), "{text}");
        assert!(text.contains("warning: a.obj:1: mtllib gone.mtl: no such library"), "{text}");
        assert!(text.contains("other files: and 2 more") && count == 12, "{text}");

        let output = run(folder.path(), &format!("{command} --strict --scene a.obj"));
        let (text, count) = warnings(&output);
        assert_eq!((output.status.code(), count), (Some(2), 12), "{text}");
        let error = "error: a.obj: warnings, which --strict makes an error; ";
        assert!(text.lines().last().is_some_and(|line| line.starts_with(error)), "{text}");
        // Nothing to refuse.
        let output = run(folder.path(), &format!("{command} --strict --scene b.obj"));
        assert_eq!(output.status.code(), Some(0));
    }
    let output = run(folder.path(), "vectors filter --strict --out packs");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.code() == Some(2) && text.contains("--strict: no scene is drawn"),
        "{text}"
    );
}

/// Runs the program, which must not wait for what nobody writes or for what has no end.
fn run_to_its_end(folder: &Path, line: &str) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
    command.current_dir(folder).args(line.split(' '));
    let process = Process::new("wheatstone", &mut command).within(Duration::from_secs(300));
    let output = process.run().expect("it ends");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn pipes_and_devices_are_no_files_to_read() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for name in ["pipe.mtl", "pipe.png", "pipe.json", "pipe.obj"] {
        assert!(Command::new("mkfifo").arg(folder.join(name)).status().unwrap().success());
    }
    for name in ["zero.obj", "zero.json", "zero.png", "zero.grid"] {
        std::os::unix::fs::symlink("/dev/zero", folder.join(name)).unwrap();
    }
    let face = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
    std::fs::write(folder.join("m.mtl"), "newmtl m\nmap_Kd pipe.png\n").unwrap();
    let render = "render --size 64x48 --method direct --out drawn --scene";
    for (library, warning) in [
        ("pipe.mtl", "warning: a.obj:1: mtllib pipe.mtl: no readable library; "),
        ("m.mtl", "warning: m.mtl:2: map_Kd pipe.png: the picture cannot be used; "),
    ] {
        std::fs::write(folder.join("a.obj"), format!("mtllib {library}\n{face}")).unwrap();
        let (status, text) = run_to_its_end(folder, &format!("{render} a.obj"));
        assert_eq!(status, Some(0), "{text}");
        let told =
            text.contains(warning) && text.contains("expected a regular file, found a pipe (FIFO)");
        assert!(told, "{text}");
    }
    let pipe = "cannot be read: expected a regular file, found a pipe (FIFO)";
    let device = "cannot be read: expected a regular file, found a device";
    let ways = ["zero.obj", "zero.json", "zero.png", "zero.grid"].map(|name| (name, device));
    let ways = ways.into_iter().chain([
        ("pipe.obj", pipe),
        ("ramp --rig pipe.json", pipe),
        ("ramp --rig zero.json", device),
        ("/dev/zero", "expected a file ending in .obj"),
    ]);
    for (words, error) in ways {
        let (status, text) = run_to_its_end(folder, &format!("{render} {words}"));
        let name = words.rsplit(' ').next().unwrap();
        assert_eq!(status, Some(2), "{words}: {text}");
        assert!(text.starts_with("error: ") && text.contains(name), "{words}: {text}");
        assert!(text.contains(error), "{words}: {text}");
    }
}
