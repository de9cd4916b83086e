//! Tools and models that hang, print without end, crash or end the program; signals; what is left then.

use std::fs;
use std::io::Read;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A workspace with Verilog, and a folder of tools that stands first in PATH.
struct Place(TempDir);

/// Answers that a Verilator must give before it is called for a model.
const ANSWERS: &str = "case $1 in
    --version) echo 'Verilator 5.006 2023-01-22'; exit;;
    --getenv) echo \"$(dirname \"$0\")/share\"; exit;;
esac\n";

impl Place {
    fn new() -> Place {
        let place = Place(tempfile::tempdir().expect("a folder"));
        let rtl = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("rtl");
        // Written by another program: no child of a test running beside this one may have a script open.
        place.shell(&format!("cp -r '{}' rtl && mkdir -p bin/share/include", rtl.display()));
        place.shell("cd bin/share/include && touch verilated.h verilated.cpp verilated_threads.cpp verilated_fst_c.cpp verilated_cov.cpp");
        place.shell("g++ -c -x c++ /dev/null -o bin/object");
        place.tool(
            "g++",
            "case $1 in -dumpfullversion) echo 12.2.0;; -E) echo /usr/include/zlib.h;; esac
            while [ $# -gt 0 ]; do [ \"$1\" = -o ] && cp \"$(dirname \"$0\")/object\" \"$2\"; shift; done",
        );
        place
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn shell(&self, script: &str) {
        let mut shell = Command::new("sh");
        let status = shell.current_dir(self.path()).args(["-ec", script]).status();
        assert!(status.expect("sh").success(), "{script}");
    }

    /// Puts a script in the place of a tool.
    fn tool(&self, name: &str, script: &str) {
        let mut shell = Command::new("sh");
        shell.current_dir(self.path()).env("TEXT", format!("#!/bin/sh\n{script}\n"));
        let write = format!("printf %s \"$TEXT\" > 'bin/{name}' && chmod +x 'bin/{name}'");
        assert!(shell.args(["-ec", &write]).status().expect("sh").success());
    }

    /// A Verilator that answers, and then does this.
    fn verilator(&self, script: &str) {
        self.tool("verilator", &format!("{ANSWERS}{script}"));
    }

    fn wheatstone(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_wheatstone"));
        let path = std::env::var("PATH").unwrap_or_default();
        command.current_dir(self.path()).args(line.split_whitespace());
        command.env("PATH", format!("{}:{path}", self.path().join("bin").display()));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, line: &str) -> (Option<i32>, String) {
        told(self.wheatstone(line).output().expect("the program runs"))
    }

    /// Starts the program and waits until a tool has said which process it is.
    fn start(&self, line: &str) -> (Child, String) {
        let mut child = self.wheatstone(line).spawn().expect("the program runs");
        let file = self.path().join("pid");
        let pid = || fs::read_to_string(&file).ok().filter(|text| text.ends_with('\n'));
        let is_over = soon(|| pid().is_some() || child.try_wait().is_ok_and(|end| end.is_some()));
        if pid().is_none() || !is_over {
            let _ = child.kill();
            panic!("{line}: no tool is called: {:?}", child.wait_with_output());
        }
        (child, pid().unwrap_or_default().trim().to_owned())
    }

    /// True if nothing temporary is left.
    fn is_tidy(&self) -> bool {
        parts(self.path()).is_empty()
    }
}

fn told(output: Output) -> (Option<i32>, String) {
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Temporary folders and files below a folder.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let below = |path: PathBuf| match path.extension() {
        Some(end) if end == "part" => vec![path],
        _ => parts(&path),
    };
    entries.flat_map(below).collect()
}

/// Waits for something that takes moments, and minutes on a machine that is busy.
fn soon(mut is_so: impl FnMut() -> bool) -> bool {
    let start = Instant::now();
    while !is_so() {
        if start.elapsed() > Duration::from_secs(600) {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    true
}

/// State and parent of a process, if it runs.
fn process(id: &str) -> Option<String> {
    let stat = fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    let rest = stat.rsplit_once(") ")?.1;
    (!rest.starts_with('Z')).then(|| rest.split(' ').nth(1).unwrap_or_default().to_owned())
}

/// The child of a process that is this program too.
fn child_of(id: u32) -> Option<String> {
    let entries = fs::read_dir("/proc").ok()?.flatten();
    let mut ids = entries.filter_map(|entry| entry.file_name().into_string().ok());
    ids.find(|child| process(child).is_some_and(|parent| parent == id.to_string()))
}

fn signal(name: &str, id: &str) {
    assert!(Command::new("kill").args(["-s", name, id]).status().expect("kill").success());
}

/// True if this test was started with a signal ignored, as HUP is under `nohup`.
fn is_ignored(name: &str) -> bool {
    let number = ["HUP", "INT"].iter().position(|n| *n == name).map_or(15, |n| n + 1);
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (number - 1) & 1 == 1
}

/// Waits for the end of a program; one that does not end fails the test.
fn end(child: &mut Child) -> ExitStatus {
    let is_over = soon(|| child.try_wait().is_ok_and(|end| end.is_some()));
    if !is_over {
        let _ = child.kill();
    }
    assert!(is_over, "it does not end");
    child.wait().expect("it has ended")
}

/// A tool that never ends, nor does what it has started.
const HANGS: &str = "sleep 1000 & echo $! > \"$(dirname \"$0\")/../pid\"; wait";

#[test]
fn a_tool_that_hangs_is_stopped_and_told() {
    let place = Place::new();
    place.verilator(HANGS);
    let (status, said) = place.run("cosim blend --case random --timeout 5");
    assert_eq!(status, Some(4), "{said}");
    for part in ["verilator on sam_blend did not end within 5 s", "--timeout SECONDS"] {
        assert!(said.contains(part), "no “{part}” in: {said}");
    }
    let pid = fs::read_to_string(place.path().join("pid")).expect("it was called");
    assert!(soon(|| process(pid.trim()).is_none()), "what it has started is left");
    assert!(place.is_tidy(), "{:?}", parts(place.path()));
}

#[test]
fn another_process_is_waited_for_and_told() {
    let place = Place::new();
    place.verilator(HANGS);
    place.shell("mkdir pictures packs");
    let held = ["pictures", "packs"].map(|name| {
        let folder = fs::File::open(place.path().join(name)).expect("a folder");
        folder.lock().map(|()| folder).expect("a lock")
    });
    let (mut builder, _) = place.start("cosim blend --case random");
    let worker = child_of(builder.id()).expect("the one that works");
    let waiting = [
        ("cosim blend --case random", format!("process {worker}, which has ")),
        ("vectors blend --beats 1 --out packs", "another process, which has packs locked".into()),
        (
            "render --scene ramp --size 16x16 --method direct --out pictures",
            format!("another process, which has {}", place.path().join("pictures").display()),
        ),
    ];
    let waiting = waiting.map(|(line, whom)| {
        (place.wheatstone(&format!("{line} --timeout 6")).spawn().expect("it runs"), line, whom)
    });
    for (child, line, whom) in waiting {
        let (status, said) = told(child.wait_with_output().expect("it ends"));
        assert_eq!(status, Some(4), "{line}: {said}");
        for part in [format!("waiting for {whom}"), format!("waited 6 s for {whom}")] {
            assert!(said.contains(&part), "{line}: no “{part}” in: {said}");
        }
    }
    drop(held);
    signal("TERM", &builder.id().to_string());
    end(&mut builder);
    assert!(place.is_tidy(), "{:?}", parts(place.path()));
}

#[test]
fn a_tool_that_does_not_say_its_version_is_told() {
    let place = Place::new();
    place.tool("verilator", HANGS);
    let (status, said) = place.run("cosim blend --timeout 1");
    assert_eq!(status, Some(3), "{said}");
    assert!(said.contains("verilator on --version did not end within 1 s"), "{said}");
}

#[test]
fn tools_that_say_too_much_or_nothing_are_told() {
    let place = Place::new();
    let leaves =
        "setsid sleep 1000 >/dev/null 2>&1 & echo $! > \"$(dirname \"$0\")/../pid\"; exit 3";
    for (script, expected, part) in [
        (
            "yes error",
            4,
            "verilator on sam_blend printed more than 258 MiB and was stopped; it began:\nerror",
        ),
        (leaves, 2, "verilator failed on sam_blend:\nit printed nothing (exit status: 3)"),
        ("kill -9 $$", 2, "it printed nothing (signal: 9 (SIGKILL))"),
        ("exit 0", 2, "it ended well, but wrote no"),
    ] {
        place.verilator(&format!("echo >> \"$(dirname \"$0\")/../calls\"\n{script}"));
        let (status, said) = place.run("cosim blend --jobs 4");
        assert_eq!(status, Some(expected), "{script}: {said}");
        assert!(said.contains(part), "{script}: no “{part}” in: {said}");
        assert!(place.is_tidy(), "{script}: {:?}", parts(place.path()));
        let calls = place.path().join("calls");
        assert_eq!(
            fs::read_to_string(&calls).expect("calls"),
            "\n",
            "{script}: it is not tried again"
        );
        fs::remove_file(calls).expect("removed");
    }
    let pid = fs::read_to_string(place.path().join("pid")).expect("it was called");
    assert!(soon(|| process(pid.trim()).is_none()), "what has left its group is left");
    // No cause is made up for a compiler that fails.
    place.shell("rm -r target");
    place.tool(
        "g++",
        "case $1 in -dumpfullversion) echo 12.2.0;; *) echo out of order; exit 1;; esac",
    );
    let (status, said) = place.run("cosim blend --jobs 4");
    assert_eq!(status, Some(3), "{said}");
    assert!(said.contains("zlib.h /dev/null: out of order; install it again with"), "{said}");
}

#[test]
fn signals_end_all_and_leave_nothing() {
    for (name, status, line) in [
        ("HUP", 129, "cosim blend --case random"),
        ("INT", 130, "prove filter --quick"),
        ("TERM", 143, "replay blend --beats 10 --with icarus"),
    ] {
        if is_ignored(name) {
            continue;
        }
        let place = Place::new();
        place.verilator(HANGS);
        // All but Verilator's answer to -V, --help and the like.
        let script = format!(
            "case $* in -V|--help|--version|'-c version') echo version 11.0; exit;; esac\n{HANGS}"
        );
        for tool in ["yosys", "yosys-smtbmc", "yosys-abc", "yices-smt2", "iverilog", "vvp"] {
            place.tool(tool, &script);
        }
        let (mut child, tool) = place.start(line);
        signal(name, &child.id().to_string());
        let ended = end(&mut child);
        let mut said = String::new();
        child.stderr.take().expect("a pipe").read_to_string(&mut said).expect("text");
        assert_eq!(ended.code(), Some(status), "{name}: {said}");
        assert!(!said.contains("rror"), "{name}: {said}");
        assert!(soon(|| process(&tool).is_none()), "{name}: the tool is left");
        assert!(place.is_tidy(), "{name}: {:?}", parts(place.path()));
    }
}

#[test]
fn a_signal_that_was_ignored_stays_so() {
    let place = Place::new();
    place.verilator(HANGS);
    let mut command = Command::new("nohup");
    let wheatstone = place.wheatstone("");
    command.arg(wheatstone.get_program()).args(["cosim", "blend", "--timeout", "5"]);
    command.current_dir(place.path()).stdin(Stdio::null()).stdout(Stdio::null());
    let set = wheatstone.get_envs().filter_map(|(name, value)| Some((name, value?)));
    command.envs(set);
    let mut child = command.stderr(Stdio::null()).spawn().expect("nohup");
    assert!(soon(|| place.path().join("pid").exists()));
    signal("HUP", &child.id().to_string());
    assert_eq!(end(&mut child).code(), Some(4), "it runs to its limit");
}

#[test]
fn the_death_of_either_process_ends_the_other_and_the_tools() {
    for of_parent in [true, false] {
        let place = Place::new();
        place.verilator(HANGS);
        let (mut parent, tool) = place.start("cosim blend --case random");
        let worker = child_of(parent.id()).expect("the one that works");
        signal("KILL", &if of_parent { parent.id().to_string() } else { worker.clone() });
        let ended = end(&mut parent);
        let mut said = String::new();
        parent.stderr.take().expect("a pipe").read_to_string(&mut said).expect("text");
        match of_parent {
            true => assert_eq!(ended.signal(), Some(9)),
            false => {
                assert_eq!(ended.code(), Some(4), "{said}");
                let part = "the run ended before its work was done (signal: 9 (SIGKILL))";
                assert!(said.contains(part), "no “{part}” in: {said}");
            }
        }
        assert!(soon(|| process(&tool).is_none()), "the tool is left");
        assert!(soon(|| process(&worker).is_none()), "the worker is left");
        // One that is killed cannot tidy up; the next run does.
        assert!(!of_parent || soon(|| place.is_tidy()), "{:?}", parts(place.path()));
    }
}

#[test]
fn a_model_that_ends_crashes_or_hangs_does_not_pass() {
    let place = Place::new();
    place.shell("rm -r bin && mkdir -p bin target/wheatstone");
    // Verilator's runtime takes long to compile: it is that of other tests.
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).with_file_name("target/wheatstone/models");
    fs::create_dir_all(&models).expect("a folder");
    std::os::unix::fs::symlink(models, place.path().join("target/wheatstone/models"))
        .expect("a link");
    let file = place.path().join("rtl/sam_blend.v");
    let text = fs::read_to_string(&file).expect("the module");
    let planted = r#"
    reg wheel = 1'b0;
    always @(posedge clk_i) if (!rst_i && pixel_valid_i) begin
        $c("if (getenv(\"MODEL_EXITS\")) exit(0);");
        $c("if (getenv(\"MODEL_LEAVES\")) syscall(231, 0);");
        $c("if (getenv(\"MODEL_CRASHES\")) *static_cast<volatile int*>(nullptr) = 0;");
        $c("if (getenv(\"MODEL_FORKS\")) fork();");
        $c("if (getenv(\"MODEL_SLEEPS\")) sleep(1000);");
        $c("if (getenv(\"MODEL_THROWS\")) throw 1;");
        $c("if (getenv(\"MODEL_GROWS\")) for (int n = 0;; ++n) n < 100000 ? ::operator new(1ull << 28) : throw 1;");
        while ($c("getenv(\"MODEL_HANGS\") != nullptr")) wheel = !wheel;
    end
endmodule"#;
    assert_eq!(text.matches("\nendmodule").count(), 1);
    fs::write(&file, text.replace("\nendmodule", planted)).expect("written");
    let line = "cosim blend --case random --beats 50 --waves never";
    assert_eq!(place.run(line).0, Some(0), "{}", place.run(line).1);
    let simulated = "while this was simulated: blend --case random";
    for (variable, expected, parts) in [
        (
            "MODEL_EXITS",
            4,
            [
                "the model calls exit(0)",
                "(signal: 6 (SIGABRT)), while this was simulated: blend --case random",
            ],
        ),
        ("MODEL_FORKS", 4, ["the model calls fork()", simulated]),
        (
            "MODEL_SLEEPS",
            4,
            ["blend --case random: the model has been asleep for 6 s on one clock", "--timeout"],
        ),
        ("MODEL_THROWS", 1, ["MISMATCH blend random", "the model throws an exception"]),
        ("MODEL_GROWS", 1, ["MISMATCH blend random", "an exception: std::bad_alloc"]),
        ("MODEL_LEAVES", 4, ["the run ended before its work was done (exit status: 0)", simulated]),
        (
            "MODEL_CRASHES",
            4,
            ["the run ended before its work was done (signal: 11 (SIGSEGV))", simulated],
        ),
        (
            "MODEL_HANGS",
            4,
            ["blend --case random: the model did not come to the end of a clock", "within 6 s"],
        ),
    ] {
        // It is built, so that the limit is that of the model alone.
        let mut command = place.wheatstone(&format!("{line} --timeout 6"));
        let (status, said) = told(command.env(variable, "1").output().expect("the program runs"));
        assert_eq!(status, Some(expected), "{variable}: {said}");
        for part in parts {
            assert!(said.contains(part), "{variable}: no “{part}” in: {said}");
        }
    }
}

#[test]
fn what_is_too_large_or_no_file_is_told() {
    let place = Place::new();
    for line in [
        "vectors blend --out p --beats 4294967296",
        "replay blend --beats 18446744073709551615",
        "cosim blend --beats 18446744073709551615",
        "cover blend --beats 18446744073709551615",
    ] {
        let (status, said) = place.run(line);
        assert_eq!(status, Some(2), "{line}: {said}");
        assert!(said.contains("1000000"), "{line}: {said}");
    }
    place.verilator("exit 1");
    place.tool("yosys", "echo Yosys 0.23");
    place.shell("rm rtl/sam_blend.v && mkfifo rtl/sam_blend.v");
    for line in ["cosim blend", "prove blend", "vectors blend --out p"] {
        let (status, said) = place.run(line);
        assert_eq!(status, Some(2), "{line}: {said}");
        let part = "sam_blend.v: expected a regular file, found a pipe (FIFO)";
        assert!(said.contains(part), "{line}: no “{part}” in: {said}");
    }
}

#[test]
fn every_exit_status_is_in_the_help() {
    let place = Place::new();
    let help = place.wheatstone("--help").output().expect("the program runs").stdout;
    let help = String::from_utf8_lossy(&help).into_owned();
    for status in ["0 ", "1 ", "2 ", "3 ", "4 ", "129, 130, 143"] {
        assert!(help.contains(&format!("\n  {status}")), "no {status} in: {help}");
    }
}
