use super::*;
use crate::limits::on_tell;
use std::fs;
use std::sync::Mutex;

fn sh(script: &str) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", script]);
    command
}

/// True if a process lives; one that has ended and is not waited for does not.
fn lives(id: &str) -> bool {
    let stat = fs::read_to_string(format!("/proc/{}/stat", id.trim())).unwrap_or_default();
    stat.rsplit_once(") ").is_some_and(|(_, rest)| !rest.starts_with('Z'))
}

/// Waits for something that takes moments, and on a busy machine longer.
fn soon(mut is_so: impl FnMut() -> bool) -> bool {
    let start = Instant::now();
    while !is_so() {
        if start.elapsed() > Duration::from_secs(300) {
            return false;
        }
        thread::sleep(Duration::from_millis(1));
    }
    true
}

/// A name in the folder of temporary files that no other process uses.
fn own(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("wheatstone-{name}-{}", std::process::id()))
}

#[test]
fn what_a_program_says_and_how_it_ends_is_told() {
    let output = Process::new("t", &mut sh("cat; echo no >&2; exit 3")).run().unwrap();
    assert_eq!(
        (output.status.code(), &*output.stdout, &*output.stderr),
        (Some(3), &b""[..], &b"no\n"[..])
    );
    assert!(!output.succeeded());
    let input = vec![b'x'; 1 << 20];
    let output = Process::new("t", &mut sh("cat")).input(input.clone()).run().unwrap();
    assert!(output.succeeded() && output.stdout == input);
    let output = Process::new("t", &mut sh("kill -9 $$")).run().unwrap();
    assert!(output.said().contains("signal: 9"), "{}", output.said());
    let error = Process::new("g++", &mut Command::new("/nowhere/g++")).run().unwrap_err();
    assert!(error.to_string().starts_with("cannot run g++ (/nowhere/g++): No such file"));
}

#[test]
fn one_that_hangs_is_killed_with_all_that_it_has_started() {
    let file = own("hung");
    let script =
        format!("sleep 1000 & echo $! > '{0}.part'; mv '{0}.part' '{0}'; wait", file.display());
    // A busy machine may need long to come to the point where it hangs.
    let id = [1, 8, 64, 512].into_iter().find_map(|seconds| {
        let mut command = sh(&script);
        let process = Process::new("tool", &mut command).on("it");
        let text = process.within(Duration::from_secs(seconds)).run().unwrap_err().to_string();
        let expected = format!("tool on it did not end within {seconds} s; it was stopped");
        assert!(text.starts_with(&expected) && text.contains("--timeout"), "{text}");
        fs::read_to_string(&file).ok()
    });
    let id = id.expect("it hangs at last");
    fs::remove_file(&file).unwrap();
    assert!(soon(|| !lives(&id)), "the sleep of {id} is left");
}

#[test]
fn one_that_leaves_others_behind_ends_them() {
    let output = Process::new("t", &mut sh("sleep 1000 & echo $!")).run().unwrap();
    let id = String::from_utf8(output.stdout).unwrap();
    assert!(soon(|| !lives(&id)), "the sleep of {id} is left");
}

#[test]
fn processor_time_is_counted_of_all_of_the_group() {
    // The one that is waited for does nothing itself.
    let output = Process::new("t", &mut sh("echo on; (while :; do :; done) & wait"))
        .processor(Duration::from_millis(300))
        .run()
        .unwrap();
    assert!(output.is_stopped && !output.succeeded());
    assert!(output.processor >= Duration::from_millis(300), "{:?}", output.processor);
    assert_eq!(output.stdout, b"on\n");
    let idle = Process::new("t", &mut sh("sleep 1")).processor(Duration::from_millis(500)).run();
    assert!(idle.unwrap().succeeded(), "time that is slept is none");
}

#[test]
fn one_that_prints_for_ever_is_stopped() {
    let error = Process::new("tool", &mut sh("yes error")).on("it").run().unwrap_err();
    let text = error.to_string();
    assert!(text.starts_with("tool on it printed more than 258 MiB and was stopped"), "{text}");
    assert!(text.ends_with("it began:\nerror\nerror\nerror\nerror"), "{text}");
    let output = Process::new("t", &mut sh("seq 1000")).keep(100).run().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("1\n2\n") && text.ends_with("\n1000\n"), "{text}");
    assert!(text.contains("[3793 bytes left out]"), "{text}");
}

static TOLD: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Keeps what is told of the one that waits for it; at the second line it may end.
fn listen(line: &str) {
    if line.starts_with("waiting for tool on a pipe: ") {
        let mut told = TOLD.lock().unwrap();
        told.push(line.to_owned());
        if told.len() == 2 {
            // It reads what nobody else writes to.
            fs::write(own("told"), "\n").unwrap();
        }
    }
}

#[test]
fn who_waits_is_told_what_for() {
    on_tell(listen);
    let pipe = own("told");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let mut command = Command::new("cat");
    let mut process = Process::new("tool", command.arg(&pipe)).on("a pipe");
    process.patience = Duration::from_millis(50);
    let output = process.run();
    fs::remove_file(&pipe).unwrap();
    assert_eq!(output.unwrap().stdout, b"\n");
    // How much time has passed by then is the machine's affair.
    let told = TOLD.lock().unwrap();
    let end = " s so far; it is stopped after 3600 s, see --timeout";
    assert!(told.len() >= 2 && told.iter().all(|line| line.ends_with(end)), "{told:?}");
}
