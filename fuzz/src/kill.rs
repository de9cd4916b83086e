//! The program killed: at every call by which it changes files, and at random ones of the programs that it calls.
//!
//! `strace` kills. A run is first counted, then made again once for each call, and killed there. Afterwards its output must
//! be whole, the old one or the new one or none, and the next run must work and give what an undisturbed one gives. No file
//! that the program itself writes may get its name before it is on the disk: no kill shows that, but the log of its calls.

use crate::log::{early, places, Point};
use crate::program::run;
use fastrand::Rng;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use wheatstone_process::Output;

/// Calls that change files or folders; those with `?` are not on every machine.
const CALLS: &str = "openat,?creat,write,pwrite64,writev,?truncate,ftruncate,?rename,?renameat,renameat2,?link,linkat,\
?unlink,unlinkat,?mkdir,mkdirat,?rmdir,fsync,fdatasync,copy_file_range,?sendfile";

/// A command that is run and killed.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its name.
    pub name: &'static str,
    /// The command line.
    pub line: &'static str,
    /// A command line whose output is there before, if any.
    pub before: Option<&'static str>,
    /// The folder with the output.
    pub out: &'static str,
    /// True if it calls other programs.
    pub calls: bool,
}

/// All of them: packs and pictures, new and in the place of older ones, and a regression with a cold cache.
pub const CASES: [Case; 5] = [
    Case { name: "vectors", line: PACK, before: None, out: "packs", calls: false },
    Case {
        name: "vectors again",
        line: PACK,
        before: Some("vectors sampler --seed 2 --beats 30 --out packs"),
        out: "packs",
        calls: false,
    },
    Case { name: "render", line: PICTURES, before: None, out: "pictures", calls: false },
    Case {
        name: "render again",
        line: PICTURES,
        before: Some(
            "render --scene ratio --size 40x30 --method direct --stereo anaglyph --out pictures",
        ),
        out: "pictures",
        calls: false,
    },
    Case {
        name: "cosim",
        line: "cosim display --beats 50 --json report/report.json",
        before: None,
        out: "report",
        calls: true,
    },
];
const PACK: &str = "vectors sampler --seed 1 --beats 30 --out packs";
const PICTURES: &str =
    "render --scene ramp --size 48x32 --method direct --stereo anaglyph,wiggle --out pictures";

const PROGRAM: &str = "wheatstone";
const STRACE: &str = "strace";

/// A folder tree: path and content of each file. Names that begin with a dot are not output.
type Tree = BTreeMap<PathBuf, Vec<u8>>;

/// Kills a program.
#[derive(Debug)]
pub struct Killer {
    /// The program.
    pub program: PathBuf,
    /// The workspace whose Verilog it reads.
    pub workspace: PathBuf,
    /// Folder for what is kept from one run to the next.
    pub scratch: PathBuf,
}

impl Killer {
    /// Kills a case everywhere, and at so many random places of the programs that it calls; what was wrong, and the
    /// number of kills.
    pub fn run(&self, case: &Case, children: usize, seed: u64) -> io::Result<(Vec<String>, usize)> {
        let whole = self.folder(case)?;
        let old = self.tree(case, whole.path())?;
        let output = run(PROGRAM, &mut self.command(case.line, whole.path()))?;
        if !output.status.success() {
            return Err(io::Error::other(format!(
                "{} fails undisturbed: {}",
                case.name,
                said(&output)
            )));
        }
        let new = self.tree(case, whole.path())?;
        let mut faults = Vec::new();
        let (points, early) = self.points(case, &["-b", "execve"])?;
        faults.extend(early);
        for point in &points {
            let fault = self.kill(case, point, &["-b", "execve"], [&old, &new])?;
            faults.extend(fault.map(|what| format!("{} {}: {what}", point.0, point.1)));
        }
        let mut killed = points.len();
        if children > 0 {
            let own: BTreeSet<Point> = points.into_iter().collect();
            let (all, _) = self.points(case, &[])?;
            let others: Vec<Point> = all.into_iter().filter(|point| !own.contains(point)).collect();
            let mut rng = Rng::with_seed(seed);
            for _ in 0..if others.is_empty() { 0 } else { children } {
                let point = &others[rng.usize(0..others.len())];
                let fault = self.kill(case, point, &[], [&old, &new])?;
                faults.extend(fault.map(|what| format!("child, {} {}: {what}", point.0, point.1)));
                killed += 1;
            }
        }
        Ok((faults, killed))
    }

    /// A workspace of its own, with a cold cache, for a run.
    fn folder(&self, case: &Case) -> io::Result<tempfile::TempDir> {
        let folder = tempfile::tempdir()?;
        std::os::unix::fs::symlink(self.workspace.join("rtl"), folder.path().join("rtl"))?;
        let before = case.before.map(|line| run(PROGRAM, &mut self.command(line, folder.path())));
        match before.transpose()? {
            Some(output) if !output.status.success() => Err(io::Error::other(said(&output))),
            _ => Ok(folder),
        }
    }

    fn command(&self, line: &str, folder: &Path) -> Command {
        let mut command = Command::new(&self.program);
        command.args(line.split(' '));
        self.at_home(&mut command, folder);
        command
    }

    /// Works in a folder, with a compiler that does not optimise, and compiles Verilator's runtime once.
    fn at_home(&self, command: &mut Command, folder: &Path) {
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders = [self.scratch.join("bin")].into_iter().chain(std::env::split_paths(&path));
        command.env("PATH", std::env::join_paths(folders).unwrap_or(path)).current_dir(folder);
    }

    /// Puts the compiler where [`Killer::at_home`] looks for it.
    ///
    /// # Errors
    /// Also where strace is missing.
    pub fn prepare(&self) -> io::Result<()> {
        run(STRACE, Command::new(STRACE).arg("--version"))
            .map_err(|error| io::Error::other(format!("{error}; run scripts/setup strace")))?;
        let bin = self.scratch.join("bin");
        fs::create_dir_all(&bin)?;
        let text = "#!/bin/sh\nout=; last=\nfor word; do [ \"$last\" = -o ] && out=$word; last=$word; done\n\
             kept=$(dirname \"$0\")/kept-$(basename \"$out\")\n\
             case \"$out\" in verilated*.o) [ -f \"$kept\" ] && exec cp \"$kept\" \"$out\" ;; esac\n\
             /usr/bin/g++ \"$@\" -O0 || exit\n\
             case \"$out\" in verilated*.o) cp \"$out\" \"$kept.$$\" && mv \"$kept.$$\" \"$kept\" ;; esac\n";
        fs::write(bin.join("g++"), text)?;
        let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
        fs::set_permissions(bin.join("g++"), mode)
    }

    /// strace with these options, of the case's command. The program would do its work in a child of its own, which
    /// strace lets go as it does all programs that are called: so it is told that it is that child, of strace.
    fn strace(&self, case: &Case, options: &[&str], folder: &Path) -> Command {
        let mut command = Command::new("sh");
        let record = self.scratch.join("record");
        let script = "exec 9<>\"$0\"; WHEATSTONE_RECORD=/proc/$$/fd/9 exec strace \"$@\"";
        command
            .args(["-c", script])
            .arg(record)
            .args(["-f", "-qq"])
            .args(options)
            .arg(&self.program)
            .args(case.line.split(' '));
        self.at_home(&mut command, folder);
        command
    }

    /// The places where a case can be killed, and the files that got their names too early.
    fn points(&self, case: &Case, options: &[&str]) -> io::Result<(Vec<Point>, Vec<String>)> {
        let folder = self.folder(case)?;
        let log = self.scratch.join("log");
        let trace = format!("trace={CALLS}");
        let file = log.to_string_lossy();
        let options = [options, &["-y", "-e", &trace, "-o", &file]].concat();
        let output = run(STRACE, &mut self.strace(case, &options, folder.path()))?;
        if !output.status.success() {
            return Err(io::Error::other(format!("strace: {}", said(&output))));
        }
        let log = String::from_utf8_lossy(&fs::read(&log)?).into_owned();
        Ok((places(&log), early(&log, &fs::canonicalize(folder.path())?)))
    }

    /// Kills a run at a point; what is wrong then.
    fn kill(
        &self,
        case: &Case,
        (call, number): &Point,
        options: &[&str],
        [old, new]: [&Tree; 2],
    ) -> io::Result<Option<String>> {
        let folder = self.folder(case)?;
        let [trace, inject] =
            [format!("trace={call}"), format!("inject={call}:signal=KILL:when={number}")];
        let options = [options, &["-o", "/dev/null", "-e", &trace, "-e", &inject]].concat();
        let killed = run(STRACE, &mut self.strace(case, &options, folder.path()))?;
        let left = self.tree(case, folder.path())?;
        if left != *old && left != *new {
            return Ok(Some(format!("neither the old output nor the new one: {}", names(&left))));
        }
        if killed.status.success() && left != *new {
            return Ok(Some("it passed without its output".into()));
        }
        let again = run(PROGRAM, &mut self.command(case.line, folder.path()))?;
        if !again.status.success() {
            return Ok(Some(format!("the next run fails: {}", said(&again))));
        }
        let made = self.tree(case, folder.path())?;
        Ok((made != *new).then(|| format!("the next run gives something else: {}", names(&made))))
    }

    fn tree(&self, case: &Case, folder: &Path) -> io::Result<Tree> {
        let mut tree = Tree::new();
        let out = folder.join(case.out);
        if out.is_dir() {
            add(&out, &out, &mut tree)?;
        }
        Ok(tree)
    }
}

fn add(root: &Path, folder: &Path, tree: &mut Tree) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let path = entry.path();
        if entry.file_name().as_encoded_bytes().starts_with(b".") {
            continue;
        }
        if entry.file_type()?.is_dir() {
            add(root, &path, tree)?;
        } else {
            let name = path.strip_prefix(root).unwrap_or(&path).to_owned();
            tree.insert(name, without_times(fs::read(&path)?));
        }
    }
    Ok(())
}

/// The lines of a report but for the times that things took.
fn without_times(content: Vec<u8>) -> Vec<u8> {
    let lines = content.split_inclusive(|&byte| byte == b'\n');
    let is_time = |line: &[u8]| line.trim_ascii_start().starts_with(b"\"seconds\":");
    lines.filter(|line| !is_time(line)).flatten().copied().collect()
}

fn names(tree: &Tree) -> String {
    let names: Vec<String> =
        tree.iter().map(|(name, bytes)| format!("{} ({})", name.display(), bytes.len())).collect();
    names.join(", ")
}

fn said(output: &Output) -> String {
    output.said().lines().take(6).collect::<Vec<_>>().join("\n")
}
