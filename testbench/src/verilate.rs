//! Builds models: Verilog to C++ by Verilator, C++ to a shared object by g++, cached by content.
//!
//! A model's folder in the cache is named after a hash of everything that goes into it: the
//! versions of both tools, all flags, every Verilog file that the module can use, and the
//! generated C++. The files are read once; what was hashed is what is compiled. A model is built in a
//! temporary folder of the process and then renamed, under a file lock: neither a second process nor
//! a killed one leaves half a model, nor do the compilers that outlive a killed one.

mod runtime;

use crate::build_error::{verilog, BuildError, LoadError};
use crate::cover::Collector;
use crate::kept::{self, entry, short, Kept};
use crate::layout::{Layout, Probe};
use crate::model::Library;
use crate::ports;
use crate::room;
use crate::shim::{self, PREFIX};
use crate::sources::{self, Sources};
use crate::tools::Toolchain;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};
use wheatstone_golden::files::{self, publish, Lock, Scratch};
use wheatstone_golden::interface::Interface;
use wheatstone_process::Process;

/// Flags of every translation; `-fno-…` against wrong code of Verilator 5.006 (its issue #4832).
const VERILATOR_FLAGS: &[&str] = &[
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

/// What makes models fast, and what makes builds fast.
const OPTIMISED: &str = "-O3";
const UNOPTIMISED: &str = "-O0";
const COVERING: &str = "-O1";

/// The file with a model.
const OBJECT: &str = "model.so";

/// What is to be built.
#[derive(Clone, Copy, Debug)]
pub struct Spec<'a> {
    /// The module, its parameters and its streams.
    pub interface: &'a Interface,
    /// The folder with `<module>.v` and everything that it uses.
    pub rtl: &'a Path,
    /// Units inside the module whose streams are watched.
    pub probes: &'a [Probe],
}

/// What a build is doing, for a progress display. Nothing is said about a model found in the cache.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress<'a> {
    /// Verilator's runtime is compiled: once a machine, some seconds.
    Runtime,
    /// What is in the cache is not what was built; it is built anew.
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
    tools: Toolchain,
    cache: PathBuf,
    optimisation: &'static str,
    coverage: Option<Arc<Collector>>,
    progress: Callback,
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

    /// The model, from the cache or built now, loaded.
    pub fn build(&self, spec: &Spec<'_>) -> Result<Library, BuildError> {
        let module = spec.interface.module;
        let sources = sources::read(spec.rtl, module)
            .map_err(|e| BuildError::Source { path: e.path, source: e.source })?;
        let layout = Layout::new(spec.interface, spec.probes);
        let job = Job {
            builder: self,
            spec,
            control: shim::control_file(spec.probes, &layout),
            shim: shim::text(spec.interface, spec.probes, &layout),
            layout: &layout,
            sources: &sources,
        };
        let key = job.key();
        let folder = self.cache.join(format!("{module}-{key}"));
        let known = || match kept::folder(&folder, &key) {
            Kept::Sound(mut files) => files.remove(OBJECT),
            _ => None,
        };
        let load = |content: Vec<u8>| {
            let object = folder.join(OBJECT);
            Library::load(&object, &content, &key, spec.interface, spec.probes, layout.clone())
        };
        let library = match known() {
            Some(content) => load(content)?,
            None => {
                let _lock = self.lock(&format!("{module}-{key}.lock"))?;
                match known() {
                    Some(content) => load(content)?,
                    None => self.build_now(&job, &key, &folder, load)?,
                }
            }
        };
        let library = library.of_folder(spec.rtl);
        Ok(match &self.coverage {
            Some(collector) => library.covering(collector.clone()),
            None => library,
        })
    }

    /// Builds a model and puts it into the cache if it can be loaded.
    fn build_now(
        &self,
        job: &Job<'_>,
        key: &str,
        folder: &Path,
        load: impl FnOnce(Vec<u8>) -> Result<Library, LoadError>,
    ) -> Result<Library, BuildError> {
        let module = job.spec.interface.module;
        if is_folder(folder)? {
            (self.progress)(Progress::Damaged(module));
        }
        (self.progress)(Progress::Building(module));
        let start = Instant::now();
        let temporary = self.scratch()?;
        let content = job.build(key, temporary.path()).map_err(|e| e.named_from(job.spec.rtl))?;
        let library = load(content)?;
        persist(temporary, key, folder)?;
        (self.progress)(Progress::Built(module, start.elapsed()));
        Ok(library)
    }

    /// A lock between all that build into this cache.
    fn lock(&self, name: &str) -> Result<Lock, BuildError> {
        Lock::take(&self.cache.join(name)).map_err(|error| match error.source.kind() {
            io::ErrorKind::TimedOut => BuildError::Lock(error),
            _ => BuildError::Cache { path: error.file, source: error.source },
        })
    }

    /// A temporary folder in the cache.
    fn scratch(&self) -> Result<Scratch, BuildError> {
        let at = |source| BuildError::Cache { path: self.cache.clone(), source };
        Scratch::new(&self.cache).map_err(at)
    }

    /// g++ with the flags of every compilation, working in `folder`.
    fn compiler(&self, folder: &Path) -> Command {
        let mut command = self.tools.command(&self.tools.gxx);
        // What is left there by one that is killed goes with the folder.
        command.current_dir(folder).env("TMPDIR", absolute(folder));
        command.arg(self.optimisation).args(GXX_FLAGS);
        command.args(self.macros());
        command.arg("-I").arg(&self.tools.include).arg("-I").arg(self.tools.include.join("vltstd"));
        command
    }

    /// Flags of the translation beside those of every one.
    fn own_flags(&self) -> Vec<&'static str> {
        let coverage = self.coverage.iter().flat_map(|_| COVERAGE_FLAGS).copied();
        coverage.chain(self.has_waves().then_some("--trace-fst")).collect()
    }

    /// How the runtime is told of them.
    fn macros(&self) -> [&'static str; 2] {
        [
            if self.coverage.is_some() { "-DVM_COVERAGE=1" } else { "-DVM_COVERAGE=0" },
            if self.has_waves() { "-DVM_TRACE=1" } else { "-DVM_TRACE=0" },
        ]
    }

    /// Whether models can write waveforms. The code for them is half of a model's.
    fn has_waves(&self) -> bool {
        self.optimisation != UNOPTIMISED
    }

    /// A hash of the tools and their flags.
    fn tool_hash(&self) -> blake3::Hasher {
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

/// One model to be built.
struct Job<'a> {
    builder: &'a Builder,
    spec: &'a Spec<'a>,
    layout: &'a Layout,
    sources: &'a Sources,
    control: String,
    shim: String,
}

impl Job<'_> {
    fn key(&self) -> String {
        let mut hash = self.builder.tool_hash();
        for (name, value) in &self.spec.interface.parameters {
            entry(&mut hash, name.as_bytes(), value.to_string().as_bytes());
        }
        for (name, content) in self.sources {
            entry(&mut hash, name.as_bytes(), content);
        }
        entry(&mut hash, b"control", self.control.as_bytes());
        entry(&mut hash, b"shim", self.shim.as_bytes());
        short(&hash)
    }

    /// Builds `model.so` in a folder of its own, which holds nothing else at the end; returns its content.
    fn build(&self, key: &str, temporary: &Path) -> Result<Vec<u8>, BuildError> {
        let runtime = self.builder.runtime()?;
        let module = self.spec.interface.module;
        let log = self.builder.cache.join(format!("{module}-{key}.log"));
        create_folder(&temporary.join("rtl"))?;
        for (name, content) in self.sources {
            write(&temporary.join("rtl").join(name), content)?;
        }
        write(&temporary.join("probes.vlt"), self.control.as_bytes())?;

        let tools = &self.builder.tools;
        let mut command = tools.command(&tools.verilator);
        command.current_dir(temporary).args(VERILATOR_FLAGS).args(self.builder.own_flags());
        command.args(["--Mdir", "cpp", "--top-module", module]);
        for (name, value) in &self.spec.interface.parameters {
            command.arg(format!("-G{name}={value}"));
        }
        command.arg(format!("rtl/{module}.v")).arg("probes.vlt");
        let header = temporary.join("cpp").join(format!("{PREFIX}.h"));
        let text = run(command, "verilator", module, &log, &header, |text| !text.is_empty())?;
        let text = String::from_utf8_lossy(&text);
        ports::check(module, &self.layout.signals[..self.layout.ports], &text)
            .map_err(|source| BuildError::Port { file: verilog(self.spec.rtl, module), source })?;

        let files = cpp_files(&temporary.join("cpp"))?;
        let unit = shim::head(&files, key) + &self.shim;
        write(&temporary.join("cpp/model.cpp"), unit.as_bytes())?;
        let mut command = self.builder.compiler(temporary);
        command.arg("-include").arg(runtime.header());
        command.args(["-shared", "-Wl,-Bsymbolic", "-I", "cpp", "cpp/model.cpp"]);
        command.args(shim::REPLACED.map(|name| format!("-Wl,--wrap={name}")));
        command.args(runtime.objects());
        command.args(["-o", OBJECT, "-lz"]);
        let object = temporary.join(OBJECT);
        let content = run(command, "g++", module, &log, &object, kept::is_whole_object)?;
        for path in ["cpp", "rtl", "probes.vlt"].map(|part| temporary.join(part)) {
            let remove = if path.is_dir() { fs::remove_dir_all } else { fs::remove_file };
            remove(&path).map_err(|source| BuildError::Cache { path, source })?;
        }
        Ok(content)
    }
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// Whether something is kept in a folder of the cache; an error if there is something else in its place.
fn is_folder(path: &Path) -> Result<bool, BuildError> {
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

/// The C++ files that Verilator wrote, sorted.
fn cpp_files(folder: &Path) -> Result<Vec<String>, BuildError> {
    let at = |source| BuildError::Cache { path: folder.to_owned(), source };
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(at)? {
        let name = entry.map_err(at)?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".cpp") {
            files.push(name);
        }
    }
    files.sort();
    Ok(files)
}

/// Runs a tool and returns the content of the file `made` that comes of it. What the tool says goes to `log`, which
/// stays only if it failed, or made no such file.
fn run(
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

fn create_folder(path: &Path) -> Result<(), BuildError> {
    fs::create_dir_all(path).map_err(|source| BuildError::Cache { path: path.to_owned(), source })
}

fn write(path: &Path, content: &[u8]) -> Result<(), BuildError> {
    File::create(path)
        .and_then(|mut file| file.write_all(content))
        .map_err(|source| BuildError::Cache { path: path.to_owned(), source })
}

fn persist(temporary: Scratch, key: &str, to: &Path) -> Result<(), BuildError> {
    kept::seal(temporary.path(), key)
        .map_err(|source| BuildError::Cache { path: to.to_owned(), source })?;
    publish(temporary, to).map_err(|e| BuildError::Cache { path: e.file, source: e.source })
}
