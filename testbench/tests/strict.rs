//! Warnings of a mesh on the command line, and `--strict`.

use std::path::Path;
use std::process::{Command, Output};

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
