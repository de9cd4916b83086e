//! Checks of the program from outside: every reader against damaged input.
//!
//! Each input is read by the program itself, in a process and a folder of its own, with limits of memory and of processor
//! time. Whatever the input is, the program must end by itself, with a status that it documents; say what is wrong in
//! printable text that names the file; and leave whole output or none.

mod judge;
pub mod kill;
pub mod kinds;
mod log;
mod mutate;
pub mod program;

pub use kinds::Kind;
pub use mutate::mutate;

use fastrand::Rng;
use judge::{KILOBYTES, SECONDS};
use program::PATIENCE;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use wheatstone_process::Process;

/// A run on damaged inputs.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The program.
    pub program: PathBuf,
    /// Inputs of each kind.
    pub inputs: usize,
    /// Seed of all damage.
    pub seed: u64,
    /// Folder that keeps the inputs of what was found, if any.
    pub keep: Option<PathBuf>,
}

/// Something that must not be.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The kind of input.
    pub kind: &'static str,
    /// Its number.
    pub number: usize,
    /// The fault.
    pub what: String,
    /// Output of the program, its first 600 characters.
    pub said: String,
}

/// Results of the inputs of a kind.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Inputs.
    pub inputs: usize,
    /// Inputs that the program read.
    pub read: usize,
    /// Faults of the program, in order.
    pub findings: Vec<Finding>,
}

impl Plan {
    /// Runs all inputs of some kinds, as many at once as there are processors.
    pub fn run(&self, kinds: &[Kind]) -> io::Result<Tally> {
        // Kinds of the same name share their inputs.
        let mut tasks = Vec::new();
        for (index, kind) in kinds.iter().enumerate() {
            let same = kinds.iter().filter(|other| other.name == kind.name).count();
            tasks.extend((0..self.inputs.div_ceil(same)).map(|number| (index, number)));
        }
        for (index, kind) in kinds.iter().enumerate() {
            // What is refused without damage tests nothing.
            let (was_read, said, what) = self.input(kind, [index, 0], None)?;
            if !was_read || what.is_some() {
                let what = what.unwrap_or_default();
                let why = format!("{}, undamaged: {what}\n{said}", kind.name);
                return Err(io::Error::other(why));
            }
        }
        let (next, read) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let found = Mutex::new(Vec::new());
        let work = || -> io::Result<()> {
            while let Some(&(kind, number)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                let seed = self.seed ^ (kind as u64) << 32 ^ number as u64;
                let mut rng = Rng::with_seed(seed);
                let (was_read, said, what) =
                    self.input(&kinds[kind], [kind, number], Some(&mut rng))?;
                read.fetch_add(was_read.into(), Ordering::Relaxed);
                let name = kinds[kind].name;
                let finding = what.map(|what| Finding { kind: name, number, what, said });
                let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
                found.extend(finding.map(|finding| (kind, finding)));
            }
            Ok(())
        };
        std::thread::scope(|scope| {
            let workers = std::thread::available_parallelism().map_or(1, |n| n.get());
            let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
            threads.into_iter().try_for_each(|thread| match thread.join() {
                Ok(result) => result,
                Err(_) => Err(io::Error::other("a worker panicked")),
            })
        })?;
        let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        found.sort_by_key(|(kind, finding): &(usize, Finding)| (*kind, finding.number));
        let findings = found.into_iter().map(|(_, finding)| finding).collect();
        Ok(Tally { inputs: tasks.len(), read: read.into_inner(), findings })
    }

    /// Runs one input, damaged or not; whether the program read it, what it said, and what is wrong.
    fn input(
        &self,
        kind: &Kind,
        [index, number]: [usize; 2],
        rng: Option<&mut Rng>,
    ) -> io::Result<(bool, String, Option<String>)> {
        let folder = tempfile::tempdir()?;
        let words = self.prepare(kind, folder.path(), rng)?;
        let before = judge::files(folder.path())?;
        let mut command = Command::new("sh");
        let limits = format!("ulimit -v {KILOBYTES}; ulimit -t {SECONDS}; exec \"$0\" \"$@\"");
        command.arg("-c").arg(limits).arg(&self.program).args(words.iter().map(|word| to_os(word)));
        command.current_dir(folder.path());
        let run = Process::new("wheatstone", &mut command).on(kind.name).within(PATIENCE).run();
        let (was_read, what, said) = match run {
            Ok(output) => {
                let what = judge::fault(kind, &output, folder.path(), &before)?;
                (output.succeeded(), what, [output.stdout, output.stderr].concat())
            }
            Err(error) => (false, Some(error.to_string()), Vec::new()),
        };
        let said = String::from_utf8_lossy(&said).chars().take(600).collect();
        if let (Some(_), Some(keep)) = (&what, &self.keep) {
            let kept = keep.join(format!("{}-{index}-{number}", kind.name.replace(' ', "-")));
            fs::create_dir_all(&kept)?;
            copy(folder.path(), &kept)?;
            let words: Vec<_> = words.iter().map(|word| String::from_utf8_lossy(word)).collect();
            fs::write(kept.join("command"), words.join(" "))?;
        }
        Ok((was_read, said, what))
    }

    /// Writes the files of an input, one of them damaged, and gives the command line.
    fn prepare(
        &self,
        kind: &Kind,
        folder: &Path,
        rng: Option<&mut Rng>,
    ) -> io::Result<Vec<Vec<u8>>> {
        for (name, content) in &kind.files {
            let path = folder.join(name);
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            fs::write(path, content)?;
        }
        let words = || kind.line.split(' ').map(|word| word.as_bytes().to_vec()).collect();
        let Some(rng) = rng else { return Ok(words()) };
        let Some(end) = kind.damaged else { return Ok(mutate::mutate_line(kind.line, rng)) };
        let damaged: Vec<_> = kind.files.iter().filter(|(name, _)| name.ends_with(end)).collect();
        let (name, content) = damaged[rng.usize(0..damaged.len())];
        let other = &kind.files[rng.usize(0..kind.files.len())].1;
        fs::write(folder.join(name), mutate(content, other, rng))?;
        Ok(words())
    }
}

fn to_os(word: &[u8]) -> &std::ffi::OsStr {
    std::os::unix::ffi::OsStrExt::from_bytes(word)
}

/// Copies files and folders; links stay behind.
fn copy(from: &Path, to: &Path) -> io::Result<()> {
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let (kind, to) = (entry.file_type()?, to.join(entry.file_name()));
        if kind.is_dir() {
            fs::create_dir_all(&to)?;
            copy(&entry.path(), &to)?;
        } else if kind.is_file() {
            fs::copy(entry.path(), to)?;
        }
    }
    Ok(())
}
