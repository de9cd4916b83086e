//! Flows of open tools on the Verilog of a module: in a temporary folder, with results kept by content.

use crate::kept::{self, entry, short, Kept};
use crate::room;
use crate::sources::Sources;
use crate::tools::{self, Found, Tool, ToolError};
use serde::{de::DeserializeOwned, Serialize};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use thiserror::Error;
use wheatstone_golden::files::{self, Scratch, WriteError};
use wheatstone_golden::text::printable_path;
use wheatstone_process::{Output, Process, ProcessError};

/// A flow of open tools came to no result.
#[derive(Debug, Error)]
pub enum FlowError {
    /// A tool is missing.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// A file could not be read.
    #[error("cannot read {}: {source}", printable_path(.path))]
    Read {
        /// Which one.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A tool did not run, or not to its end.
    #[error(transparent)]
    Process(#[from] ProcessError),
    /// A tool refused the design, or does not say what it is expected to.
    #[error("{tool} failed on {module}:\n{lines}")]
    Failed {
        /// Which tool.
        tool: &'static str,
        /// Which module.
        module: String,
        /// The first lines of its output.
        lines: String,
    },
    /// An entry of the list of planted bugs is wrong.
    #[error("planted bug of {what}: {why}")]
    Bug {
        /// Which one.
        what: String,
        /// The cause.
        why: String,
    },
}

/// Yosys commands that read the Verilog and set the parameters of `module`.
pub(crate) fn read_commands(
    sources: &Sources,
    module: &str,
    parameters: &[(impl AsRef<str>, u32)],
) -> String {
    let files = sources.keys().filter(|name| name.ends_with(".v"));
    let files: String = files.map(|name| format!(" {name}")).collect();
    format!("read_verilog -I .{files}; {}", set_parameters(module, parameters))
}

/// The Yosys command that sets parameters, if there are any.
pub(crate) fn set_parameters(module: &str, parameters: &[(impl AsRef<str>, u32)]) -> String {
    let set = parameters.iter().map(|(name, value)| format!(" -set {} {value}", name.as_ref()));
    match set.collect::<String>() {
        set if set.is_empty() => set,
        set => format!("chparam{set} {module}; "),
    }
}

/// The result of `find` for a module, kept in the folder `cache` under a hash of the sources and of `inputs`:
/// everything else that the result depends on. A result that `keep` refuses is not kept: that of a tool which
/// was stopped depends on how busy the machine was.
pub(crate) fn cached<T: Serialize + DeserializeOwned>(
    cache: &Path,
    module: &str,
    sources: &Sources,
    inputs: &[&[u8]],
    keep: impl FnOnce(&T) -> bool,
    find: impl FnOnce(&Folder) -> Result<T, FlowError>,
) -> Result<T, FlowError> {
    let mut hash = blake3::Hasher::new();
    for (name, content) in sources {
        entry(&mut hash, name.as_bytes(), content);
    }
    inputs.iter().for_each(|input| entry(&mut hash, b"input", input));
    let file = cache.join(format!("{module}-{}.result", short(&hash)));
    let key = hash.finalize().to_hex();
    if let Some(kind) = files::irregular(&file) {
        let source = io::Error::other(format!("expected a regular file, found {kind}; delete it"));
        return Err(FlowError::Read { path: file, source });
    }
    let known = match kept::text(&file, &key) {
        Kept::Sound(text) => serde_json::from_str(&text).ok(),
        Kept::Absent => None,
        Kept::Damaged => {
            wheatstone_process::tell(&format!(
                "{} is not as it was kept: {module} is measured anew",
                file.display()
            ));
            None
        }
    };
    if let Some(found) = known {
        return Ok(found);
    }
    let found = find(&Folder::of(cache, module, sources)?)?;
    // What is no JSON could not be read again.
    if let (true, Ok(text)) = (keep(&found), serde_json::to_string(&found)) {
        kept::write_text(&file, &key, text)?;
    }
    Ok(found)
}

/// A temporary folder with the sources of a design.
pub(crate) struct Folder {
    folder: Scratch,
    module: String,
}

impl Folder {
    /// A folder below `cache`.
    pub fn of(cache: &Path, module: &str, sources: &Sources) -> Result<Folder, FlowError> {
        let folder = Folder { folder: Scratch::below(cache)?, module: module.to_owned() };
        for (name, content) in sources {
            folder.write(name, content)?;
        }
        Ok(folder)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), FlowError> {
        Ok(files::write(&self.folder.path().join(name), content)?)
    }

    /// The text of a file that a tool has written.
    pub fn read(&self, tool: &'static Tool, name: &str) -> Result<String, FlowError> {
        let content = files::read(&self.folder.path().join(name), kept::LIMIT);
        let text = content.map_err(|error| match error.source.kind() {
            io::ErrorKind::NotFound => self.lacks(tool, name, ""),
            _ => self.failed(tool, &format!("{name} cannot be read: {}", error.source)),
        })?;
        String::from_utf8(text)
            .map_err(|error| self.failed(tool, &format!("{name} cannot be read: {error}")))
    }

    /// A command of a tool that works in this folder and finds the programs that it calls.
    pub fn command(&self, tool: &Found) -> Command {
        let mut command = Command::new(&tool.program);
        let folder = self.folder.path();
        command.current_dir(folder).env("PATH", tools::search_path());
        // What is left there by one that is killed goes with the folder.
        command.env("TMPDIR", std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned()));
        // Tools from PyPI compile themselves at their first call and keep that here.
        if let Some(cache) = tools::python_cache() {
            command.env("YOWASP_CACHE_DIR", cache);
        }
        command
    }

    /// Runs a command, of which the files `made` come; what it said, where it failed, becomes the error.
    pub fn run(
        &self,
        tool: &'static Tool,
        command: &mut Command,
        made: &[&str],
    ) -> Result<(), FlowError> {
        let output = Process::new(tool.program, command).on(&self.module).run()?;
        if !output.succeeded() {
            return Err(self.failed(tool, &output.said()));
        }
        let lacking = made.iter().find(|name| !self.folder.path().join(name).is_file());
        lacking.map_or(Ok(()), |name| Err(self.lacks(tool, name, &output.said())))
    }

    /// The error of a tool that ended well without its file.
    fn lacks(&self, tool: &'static Tool, name: &str, said: &str) -> FlowError {
        self.failed(tool, &format!("ERROR: it ended well, but wrote no {name}\n{said}"))
    }

    /// Output and end of a command; it is stopped when it and all that it has started have used so much
    /// processor time together, see [`Output::is_stopped`].
    pub fn limited(
        &self,
        tool: &'static Tool,
        command: &mut Command,
        limit: Duration,
    ) -> Result<Output, FlowError> {
        Ok(Process::new(tool.program, command).on(&self.module).processor(limit).run()?)
    }

    /// The error of a tool that said `text`.
    pub fn failed(&self, tool: &'static Tool, text: &str) -> FlowError {
        if let Some(source) = room::lacking(self.folder.path(), text) {
            let file = self.folder.path().parent().unwrap_or(self.folder.path()).to_owned();
            return WriteError { file, source }.into();
        }
        let all: Vec<&str> = text.lines().collect();
        let first = all.iter().position(|line| line.contains("ERROR")).unwrap_or(0);
        let lines = all[first..].iter().take(8).copied().collect::<Vec<_>>().join("\n");
        FlowError::Failed { tool: tool.program, module: self.module.clone(), lines }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_tool_that_writes_nothing_and_says_that_all_is_well_is_told() {
        let cache = tempfile::tempdir().unwrap();
        let folder = Folder::of(cache.path(), "sam_x", &Sources::new()).unwrap();
        let lacks = "yosys failed on sam_x:\nERROR: it ended well, but wrote no stat";
        let run = folder.run(&tools::YOSYS, &mut Command::new("true"), &["stat"]).unwrap_err();
        assert!(run.to_string().starts_with(lacks), "{run}");
        let full = folder.failed(&tools::YOSYS, "ABC: No space left on device").to_string();
        let start = format!("{}: cannot be written: No space", cache.path().display());
        assert!(full.starts_with(&start), "{full}");
        let read = folder.read(&tools::YOSYS, "stat").unwrap_err();
        assert!(read.to_string().starts_with(lacks), "{read}");
        fs::create_dir(folder.path().join("stat")).unwrap();
        let read = folder.read(&tools::YOSYS, "stat").unwrap_err().to_string();
        assert!(
            read.ends_with("stat cannot be read: expected a regular file, found a folder"),
            "{read}"
        );
    }

    #[test]
    fn a_kept_result_that_was_changed_is_measured_anew() {
        let cache = tempfile::tempdir().unwrap();
        let sources = Sources::from([("sam_x.v".into(), b"module".to_vec())]);
        let measured = std::cell::Cell::new(0);
        let measure = |keep: bool| {
            let find = |_: &Folder| {
                measured.set(measured.get() + 1);
                Ok(120_u32)
            };
            cached(cache.path(), "sam_x", &sources, &[b"yosys"], |_| keep, find).unwrap()
        };
        assert_eq!([measure(false), measure(true), measure(true)], [120; 3]);
        assert_eq!(measured.get(), 2, "what is not to be kept is not");
        let file = fs::read_dir(cache.path()).unwrap().next().unwrap().unwrap().path();
        let text = fs::read_to_string(&file).unwrap();
        assert!(text.ends_with("\n120"), "{text}");
        fs::write(&file, text.replace("\n120", "\n121")).unwrap();
        assert_eq!([measure(true), measure(true)], [120; 2]);
        assert_eq!(measured.get(), 3);
        fs::remove_file(&file).unwrap();
        fs::create_dir(&file).unwrap();
        let error = cached(cache.path(), "sam_x", &sources, &[b"yosys"], |_| true, |_| Ok(0));
        let error = error.unwrap_err().to_string();
        assert!(error.ends_with("expected a regular file, found a folder; delete it"), "{error}");
        fs::remove_dir(&file).unwrap();
        std::os::unix::fs::symlink(&file, &file).unwrap();
        let error = cached(
            cache.path(),
            "sam_x",
            &sources,
            &[b"yosys"],
            |_| true,
            |_| {
                measured.set(0);
                Ok(0)
            },
        );
        let error = error.unwrap_err().to_string();
        assert!(
            error.ends_with("found a symbolic link that leads to itself; delete it"),
            "{error}"
        );
        assert_eq!(measured.get(), 3, "that is seen before the work");
    }
}
