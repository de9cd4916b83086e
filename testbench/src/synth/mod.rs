//! Synthesis: what units and systems cost in gates and on two FPGAs, and how fast they are there.
//!
//! [`Synthesiser::measure`] runs the open tools on one target in one configuration; results are kept in
//! a cache by content. [`record`] has the figures that are committed, what may change against them and
//! the tables of the documentation.

mod fpga;
mod gates;
pub mod record;

use crate::scratch::Scratch;
use crate::sources::{self, Sources};
use crate::tools::{self, Found, Tool, ToolError};
use crate::verilate::{entry, short};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use thiserror::Error;
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Interface;
use wheatstone_golden::picture::{write_file, WriteError};
use wheatstone_golden::targets::Target;

/// What a target is synthesised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tech {
    /// NAND2-equivalent gates in two libraries.
    Gates,
    /// Lattice iCE40 HX8K.
    Ice40,
    /// Lattice ECP5-45, speed grade 6.
    Ecp5,
}

impl Tech {
    /// All of them, in the order of tables.
    pub const ALL: [Tech; 3] = [Tech::Gates, Tech::Ice40, Tech::Ecp5];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Tech::Gates => "gates",
            Tech::Ice40 => "ice40",
            Tech::Ecp5 => "ecp5",
        }
    }

    /// What its figures are, in the order of tables.
    pub fn figures(self) -> &'static [Figure] {
        match self {
            Tech::Gates => &[Figure::Osu035, Figure::Primitive],
            Tech::Ice40 | Tech::Ecp5 => {
                &[Figure::Luts, Figure::FlipFlops, Figure::Dsps, Figure::Memories, Figure::Fmax]
            }
        }
    }
}

/// A measured quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// NAND2 equivalents in the OSU 0.35 µm standard cells: cell area over the area of NAND2X1.
    Osu035,
    /// NAND2 equivalents in `synth/primitive.lib`.
    Primitive,
    /// Look-up tables of four inputs, those of carry chains included.
    Luts,
    /// Flip-flops.
    FlipFlops,
    /// Multipliers.
    Dsps,
    /// Memory blocks and, on ECP5, distributed memories of 16 times 4 bits.
    Memories,
    /// Highest clock in MHz: the median of three placements.
    Fmax,
}

impl Figure {
    /// Heading in a table.
    pub fn heading(self) -> &'static str {
        match self {
            Figure::Osu035 => "OSU 0.35 µm",
            Figure::Primitive => "INV, NAND2, NOR2",
            Figure::Luts => "LUT4",
            Figure::FlipFlops => "flip-flops",
            Figure::Dsps => "DSPs",
            Figure::Memories => "memories",
            Figure::Fmax => "MHz",
        }
    }
}

/// What was measured. Nothing, where the target does not fit on the chip.
pub type Figures = BTreeMap<Figure, f64>;

/// Why nothing could be measured.
#[derive(Debug, Error)]
pub enum SynthError {
    /// A tool is missing.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// A file could not be read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// Which one.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A tool refused the design, or does not say what it is expected to.
    #[error("{tool} failed on {module}:\n{lines}")]
    Failed {
        /// Which tool.
        tool: &'static str,
        /// Which module.
        module: &'static str,
        /// What it said.
        lines: String,
    },
}

/// Runs the tools and keeps what they find.
#[derive(Debug)]
pub struct Synthesiser {
    /// Folder of the Verilog.
    pub rtl: PathBuf,
    /// Folder of the cache, created when needed.
    pub cache: PathBuf,
}

impl Synthesiser {
    /// The cache that the programs of this workspace use, seen from the workspace's folder.
    pub const CACHE: &'static str = "target/wheatstone/synth";

    /// The figures of a target, from the cache or measured now.
    pub fn measure(
        &self,
        target: Target,
        config: &Config,
        tech: Tech,
    ) -> Result<Figures, SynthError> {
        let interface = target.interface(config);
        let sources = sources::read(&self.rtl, interface.module)
            .map_err(|e| SynthError::Read { path: e.path, source: e.source })?;
        let design = Design { interface: &interface, sources: &sources, cache: &self.cache };
        match tech {
            Tech::Gates => gates::measure(&design),
            Tech::Ice40 => fpga::measure(&design, &fpga::ICE40),
            Tech::Ecp5 => fpga::measure(&design, &fpga::ECP5),
        }
    }
}

/// A target with its parameters and all its Verilog.
pub(crate) struct Design<'a> {
    /// Module and parameters.
    pub interface: &'a Interface,
    /// Everything that the module can use.
    pub sources: &'a Sources,
    /// Where working folders are made.
    pub cache: &'a Path,
}

impl Design<'_> {
    fn module(&self) -> &'static str {
        self.interface.module
    }

    /// Yosys commands that read the Verilog and set the parameters.
    pub fn read_commands(&self) -> String {
        let files = self.sources.keys().filter(|name| name.ends_with(".v"));
        let files: String = files.map(|name| format!(" {name}")).collect();
        let parameters = &self.interface.parameters;
        let set: String = parameters.iter().map(|(n, v)| format!(" -set {n} {v}")).collect();
        let set = match set.is_empty() {
            true => set,
            false => format!("chparam{set} {}; ", self.module()),
        };
        format!("read_verilog -I .{files}; {set}")
    }

    /// What `measure` finds, kept under a hash of the sources and of `inputs`: everything else that
    /// the result depends on.
    fn cached(
        &self,
        inputs: &[&[u8]],
        measure: impl FnOnce(&Folder) -> Result<Figures, SynthError>,
    ) -> Result<Figures, SynthError> {
        let mut hash = blake3::Hasher::new();
        for (name, content) in self.sources {
            entry(&mut hash, name.as_bytes(), content);
        }
        inputs.iter().for_each(|input| entry(&mut hash, b"input", input));
        let file = self.cache.join(format!("{}-{}.json", self.module(), short(&hash)));
        let known = fs::read(&file).ok().and_then(|text| serde_json::from_slice(&text).ok());
        if let Some(figures) = known {
            return Ok(figures);
        }
        let figures = measure(&Folder::of(self)?)?;
        let text = serde_json::to_vec(&figures).unwrap_or_default();
        write_file(&file, &text)?;
        Ok(figures)
    }
}

/// A temporary folder with the sources of a design.
pub(crate) struct Folder {
    folder: Scratch,
    module: &'static str,
}

impl Folder {
    /// Made in the cache of the design.
    pub fn of(design: &Design<'_>) -> Result<Folder, SynthError> {
        let cache = design.cache;
        let at = |source| WriteError { file: cache.to_owned(), source };
        fs::create_dir_all(cache).map_err(at)?;
        let folder = Folder { folder: Scratch::new(cache).map_err(at)?, module: design.module() };
        for (name, content) in design.sources {
            folder.write(name, content)?;
        }
        Ok(folder)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a file.
    pub fn write(&self, name: &str, content: &[u8]) -> Result<(), SynthError> {
        Ok(write_file(&self.folder.path().join(name), content)?)
    }

    /// Reads a file.
    pub fn read(&self, name: &str) -> Result<String, SynthError> {
        let path = self.folder.path().join(name);
        fs::read_to_string(&path).map_err(|source| SynthError::Read { path, source })
    }

    /// A command of a tool that works in this folder.
    pub fn command(&self, tool: &Found) -> Command {
        let mut command = Command::new(&tool.program);
        command.current_dir(self.folder.path());
        // Tools from PyPI compile themselves at their first call and keep that here.
        if let Some(cache) = tools::python_cache() {
            command.env("YOWASP_CACHE_DIR", cache);
        }
        command
    }

    /// Runs a command; what it said, where it failed, becomes the error.
    pub fn run(&self, tool: &'static Tool, command: &mut Command) -> Result<(), SynthError> {
        let output = command
            .output()
            .map_err(|source| SynthError::Read { path: command.get_program().into(), source })?;
        if output.status.success() {
            return Ok(());
        }
        let text = [output.stdout, output.stderr].concat();
        Err(self.failed(tool, &String::from_utf8_lossy(&text)))
    }

    /// The error of a tool that said `text`.
    pub fn failed(&self, tool: &'static Tool, text: &str) -> SynthError {
        let all: Vec<&str> = text.lines().collect();
        let first = all.iter().position(|line| line.contains("ERROR")).unwrap_or(0);
        let lines = all[first..].iter().take(8).copied().collect::<Vec<_>>().join("\n");
        SynthError::Failed { tool: tool.program, module: self.module, lines }
    }
}
