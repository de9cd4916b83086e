//! The builder: its tools and their flags, its cache, and runs of the tools.

use crate::build_error::BuildError;
use crate::coverage::Collector;
use crate::kept::{self, entry};
use crate::layout::Probe;
use crate::room;
use crate::shim::{self, PREFIX};
use crate::tools::Toolchain;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;
use wheatstone_golden::files::{self, publish, Lock, Scratch};
use wheatstone_golden::interface::Interface;
use wheatstone_process::Process;

/// Flags of every translation; `-fno-…` against wrong code of Verilator 5.006 (its issue #4832).
pub(super) const VERILATOR_FLAGS: &[&str] = &[
    "--cc",
    "--prefix",
    PREFIX,
    "--x-assign",
    "unique",
    "--x-initial",
    "unique",
    "--assert",
    "-fno-const-bit-op-tree",
    "-fno-expand",
    "-Wno-fatal",
    "-Irtl",
    "-y",
    "rtl",
];

/// Flags of every compilation. TLS descriptors spare `eval` four calls into the loader.
const GXX_FLAGS: &[&str] = &[
    "-std=gnu++17",
    "-fPIC",
    "-pthread",
    "-fvisibility=hidden",
    "-fno-gnu-unique",
    #[cfg(target_arch = "x86_64")]
    "-mtls-dialect=gnu2",
    "-DVL_USER_FINISH",
    "-DVL_USER_STOP",
    "-DVL_USER_FATAL",
    "-DVL_PRINTF=wheatstone_print",
    "-DVM_TRACE_FST=1",
    "-DVM_TRACE_VCD=0",
    "-DVM_SC=0",
];

/// Flags of models that count their own code and its signals, however wide these are. `-fno-gate`: or a net at a port
/// shares a counter with the signal behind it, which is one for all instances of a module.
const COVERAGE_FLAGS: &[&str] =
    &["--coverage-line", "--coverage-toggle", "--coverage-max-width", "65536", "-fno-gate"];

/// Levels of optimisation: for fast models, for fast builds, for models that count their coverage.
const OPTIMISED: &str = "-O3";
const UNOPTIMISED: &str = "-O0";
const COVERING: &str = "-O1";

/// A model to be built.
#[derive(Clone, Copy, Debug)]
pub struct Spec<'a> {
    /// The module, its parameters and its streams.
    pub interface: &'a Interface,
    /// The folder with `<module>.v` and everything that it uses.
    pub rtl: &'a Path,
    /// Units inside the module whose streams are watched.
    pub probes: &'a [Probe],
}

/// A step of a build, for a progress display. Nothing is said about a model found in the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress<'a> {
    /// Verilator's runtime is compiled: once a machine, some seconds.
    Runtime,
    /// An entry of the cache is not as it was built; it is built anew.
    Damaged(&'a str),
    /// A model is being built.
    Building(&'a str),
    /// A model is ready.
    Built(&'a str, Duration),
}

impl fmt::Display for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Progress::Runtime => write!(f, "building Verilator's runtime ..."),
            Progress::Damaged(what) => write!(f, "{what} in the cache is damaged"),
            Progress::Building(module) => write!(f, "building {module} ..."),
            Progress::Built(module, time) => {
                write!(f, "built {module} in {:.1} s", time.as_secs_f64())
            }
        }
    }
}

type Callback = Box<dyn Fn(Progress<'_>) + Send + Sync>;

/// Builds models and keeps them in a cache.
pub struct Builder {
    pub(super) tools: Toolchain,
    pub(super) cache: PathBuf,
    optimisation: &'static str,
    pub(super) coverage: Option<Arc<Collector>>,
    pub(super) progress: Callback,
}

impl Builder {
    /// The cache that the programs of this workspace use, seen from the workspace's folder.
    pub const CACHE: &'static str = "target/wheatstone/models";

    /// A builder that keeps its models in the folder `cache`, created when needed.
    pub fn new(tools: Toolchain, cache: impl Into<PathBuf>) -> Builder {
        let (cache, progress) = (cache.into(), Box::new(|_: Progress<'_>| ()));
        Builder { tools, cache, optimisation: OPTIMISED, coverage: None, progress }
    }

    /// Builds three to eight times as fast what then runs a tenth as fast and writes no waveforms: for models that are
    /// run once.
    pub fn unoptimised(mut self) -> Builder {
        self.optimisation = UNOPTIMISED;
        self
    }

    /// Builds models that count what is run of their code; the counts are added up in `collector`.
    /// They are large: more than a little optimisation costs more time than it spares.
    pub fn covering(mut self, collector: Arc<Collector>) -> Builder {
        self.optimisation = COVERING;
        self.coverage = Some(collector);
        self
    }

    /// Calls `report` on every step of a build, possibly from several threads.
    pub fn on_progress(mut self, report: impl Fn(Progress<'_>) + Send + Sync + 'static) -> Builder {
        self.progress = Box::new(report);
        self
    }

    /// A lock between all that build into this cache.
    pub(super) fn lock(&self, name: &str) -> Result<Lock, BuildError> {
        Lock::take(&self.cache.join(name)).map_err(|error| match error.source.kind() {
            io::ErrorKind::TimedOut => BuildError::Lock(error),
            _ => BuildError::Cache { path: error.file, source: error.source },
        })
    }

    /// A temporary folder in the cache.
    pub(super) fn scratch(&self) -> Result<Scratch, BuildError> {
        let at = |source| BuildError::Cache { path: self.cache.clone(), source };
        Scratch::new(&self.cache).map_err(at)
    }

    /// g++ with the flags of every compilation, working in `folder`.
    pub(super) fn compiler(&self, folder: &Path) -> Command {
        let mut command = self.tools.command(&self.tools.gxx);
        // What is left there by one that is killed goes with the folder.
        command.current_dir(folder).env("TMPDIR", absolute(folder));
        command.arg(self.optimisation).args(GXX_FLAGS);
        command.args(self.macros());
        command.arg("-I").arg(&self.tools.include).arg("-I").arg(self.tools.include.join("vltstd"));
        command
    }

    /// Flags of the translation beside those of every one.
    pub(super) fn own_flags(&self) -> Vec<&'static str> {
        let coverage = self.coverage.iter().flat_map(|_| COVERAGE_FLAGS).copied();
        coverage.chain(self.has_waves().then_some("--trace-fst")).collect()
    }

    /// The same flags as macros of the runtime.
    fn macros(&self) -> [&'static str; 2] {
        [
            if self.coverage.is_some() { "-DVM_COVERAGE=1" } else { "-DVM_COVERAGE=0" },
            if self.has_waves() { "-DVM_TRACE=1" } else { "-DVM_TRACE=0" },
        ]
    }

    /// True if models can write waveforms. The code for them is half of a model's.
    fn has_waves(&self) -> bool {
        self.optimisation != UNOPTIMISED
    }

    /// A hash of the tools and their flags.
    pub(super) fn tool_hash(&self) -> blake3::Hasher {
        let mut hash = blake3::Hasher::new();
        let tools = [&self.tools.verilator, &self.tools.gxx];
        for tool in tools {
            entry(&mut hash, tool.program.as_os_str().as_encoded_bytes(), tool.text.as_bytes());
        }
        let own = [self.own_flags(), self.macros().to_vec(), vec![self.optimisation]].concat();
        for flag in VERILATOR_FLAGS.iter().chain(GXX_FLAGS).chain(&own) {
            entry(&mut hash, b"flag", flag.as_bytes());
        }
        for header in [shim::PRINT_HEADER, shim::MODEL_HEADERS] {
            entry(&mut hash, b"header", header.as_bytes());
        }
        hash
    }
}

pub(super) fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// True if something is kept in a folder of the cache; an error if there is something else in its place.
pub(super) fn is_folder(path: &Path) -> Result<bool, BuildError> {
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => Ok(true),
        Err(_) if files::irregular(path).is_none() => Ok(false),
        _ => {
            let source = io::Error::other(format!(
                "expected a folder, found {}; delete it",
                files::irregular(path).unwrap_or("a file")
            ));
            Err(BuildError::Cache { path: path.to_owned(), source })
        }
    }
}

/// Runs a tool and returns the content of the file `made` that comes of it. What the tool says goes to `log`, which
/// stays only if it failed, or made no such file.
pub(super) fn run(
    mut command: Command,
    tool: &'static str,
    module: &str,
    log: &Path,
    made: &Path,
    is_whole: impl Fn(&[u8]) -> bool,
) -> Result<Vec<u8>, BuildError> {
    let output = Process::new(tool, &mut command).on(module).run()?;
    let mut text = output.said();
    if output.succeeded() {
        let name = made.file_name().unwrap_or_default().display();
        let why = match files::read(made, kept::LIMIT) {
            Ok(content) if is_whole(&content) => return Ok(content),
            Ok(_) => format!("wrote only a part of {name}"),
            Err(_) if !made.exists() => format!("wrote no {name}"),
            Err(error) => format!("{name} cannot be read: {}", error.source),
        };
        text = format!("error: it ended well, but {why}\n{text}");
    }
    let folder = log.parent().unwrap_or(Path::new("."));
    if let Some(source) = room::lacking(folder, &text) {
        return Err(BuildError::Cache { path: folder.to_owned(), source });
    }
    files::write(log, text.as_bytes())
        .map_err(|e| BuildError::Cache { path: e.file, source: e.source })?;
    let all: Vec<&str> = text.lines().collect();
    let first = all.iter().position(|line| line.contains("rror")).unwrap_or(0);
    let lines = all[first..].iter().take(8).copied().collect::<Vec<_>>().join("\n");
    Err(BuildError::Failed { tool, module: module.to_owned(), lines, log: log.to_owned() })
}

pub(super) fn write(path: &Path, content: &[u8]) -> Result<(), BuildError> {
    File::create(path)
        .and_then(|mut file| file.write_all(content))
        .map_err(|source| BuildError::Cache { path: path.to_owned(), source })
}

pub(super) fn persist(temporary: Scratch, key: &str, to: &Path) -> Result<(), BuildError> {
    kept::seal(temporary.path(), key)
        .map_err(|source| BuildError::Cache { path: to.to_owned(), source })?;
    publish(temporary, to).map_err(|e| BuildError::Cache { path: e.file, source: e.source })
}
