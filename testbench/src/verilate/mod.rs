//! Builds models: Verilog to C++ by Verilator, C++ to a shared object by g++, cached by content.
//!
//! A model's folder in the cache is named after a hash of everything that goes into it: the
//! versions of both tools, all flags, every Verilog file that the module can use, and the
//! generated C++. The files are read once; what was hashed is what is compiled. A model is built in a
//! temporary folder of the process and then renamed, under a file lock: neither a second process nor
//! a killed one leaves half a model, nor do the compilers that outlive a killed one.

mod builder;
mod runtime;

pub use builder::{Builder, Progress, Spec};

use crate::build_error::{verilog, BuildError, LoadError};
use crate::kept::{self, entry, short, Kept};
use crate::layout::Layout;
use crate::model::Library;
use crate::ports;
use crate::shim::{self, PREFIX};
use crate::sources::{self, Sources};
use builder::{is_folder, persist, run, write, VERILATOR_FLAGS};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// The file with a model.
const OBJECT: &str = "model.so";

impl Builder {
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

fn create_folder(path: &Path) -> Result<(), BuildError> {
    fs::create_dir_all(path).map_err(|source| BuildError::Cache { path: path.to_owned(), source })
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
