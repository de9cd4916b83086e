//! The common parts of all models: Verilator's runtime, and the headers that models include.

use super::builder::{absolute, is_folder, persist, run, write, Builder, Progress};
use crate::build_error::BuildError;
use crate::kept::{self, short, Kept};
use crate::shim;
use std::fs;
use std::path::{Path, PathBuf};
use wheatstone_golden::files;

/// Sources of Verilator's runtime that every model is linked with.
const RUNTIME: [&str; 4] = ["verilated", "verilated_threads", "verilated_fst_c", "verilated_cov"];

/// The header of all models. It is compiled beside itself: reading it is most of a compiler's work that does not
/// optimise.
const HEADER: &str = "model.h";

/// A folder with the runtime, compiled once per compiler and flags.
pub(super) struct Runtime(PathBuf);

impl Runtime {
    /// The header that models include before all else.
    pub fn header(&self) -> PathBuf {
        absolute(&self.0.join(HEADER))
    }

    /// The objects that they are linked with.
    pub fn objects(&self) -> [PathBuf; RUNTIME.len()] {
        RUNTIME.map(|name| absolute(&self.0.join(format!("{name}.o"))))
    }
}

impl Builder {
    /// Verilator's runtime, which is compiled if it is not kept.
    pub(super) fn runtime(&self) -> Result<Runtime, BuildError> {
        let mut hash = self.tool_hash();
        let sources = RUNTIME.map(|name| format!("{name}.cpp"));
        for name in sources.iter().map(String::as_str).chain(["verilated.h"]) {
            let path = self.tools.include.join(name);
            let content = files::read(&path, files::OWN_LIMIT)
                .map_err(|e| BuildError::Source { path: e.file, source: e.source })?;
            hash.update(&content);
        }
        let key = short(&hash);
        let folder = self.cache.join(format!("runtime-{key}"));
        let is_sound = || matches!(kept::folder(&folder, &key), Kept::Sound(_));
        if is_sound() {
            return Ok(Runtime(folder));
        }
        let _lock = self.lock(&format!("runtime-{key}.lock"))?;
        if is_sound() {
            return Ok(Runtime(folder));
        }
        if is_folder(&folder)? {
            (self.progress)(Progress::Damaged("Verilator's runtime"));
        }
        self.tools.check_zlib()?;
        (self.progress)(Progress::Runtime);
        let temporary = self.scratch()?;
        let log = self.cache.join(format!("runtime-{key}.log"));
        self.compile_runtime(temporary.path(), &log)?;
        persist(temporary, &key, &folder)?;
        Ok(Runtime(folder))
    }

    fn compile_runtime(&self, folder: &Path, log: &Path) -> Result<(), BuildError> {
        let compile = |arguments: &[&str], made: &str, is_whole: fn(&[u8]) -> bool| {
            let mut command = self.compiler(folder);
            command.args(arguments).args(["-o", made]);
            run(command, "g++", "verilator's runtime", log, &folder.join(made), is_whole)
        };
        let (name, print) = ("print.h", folder.join("print.h"));
        write(&print, shim::PRINT_HEADER.as_bytes())?;
        for source in RUNTIME {
            let path = self.tools.include.join(format!("{source}.cpp"));
            let arguments = ["-include", name, "-c", &path.to_string_lossy()];
            compile(&arguments, &format!("{source}.o"), kept::is_whole_object)?;
        }
        fs::remove_file(&print).map_err(|source| BuildError::Cache { path: print, source })?;
        let header = [shim::PRINT_HEADER, shim::MODEL_HEADERS].concat();
        write(&folder.join(HEADER), header.as_bytes())?;
        let is_compiled = |content: &[u8]| !content.is_empty();
        compile(&["-x", "c++-header", HEADER], &format!("{HEADER}.gch"), is_compiled)?;
        Ok(())
    }
}
