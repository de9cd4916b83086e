//! Synthesis: what units and systems cost in gates and on two FPGAs, and how fast they are there.
//!
//! [`Synthesiser::measure`] runs the open tools on one target in one configuration; results are kept in
//! a cache by content. [`record`] has the figures that are committed, what may change against them and
//! the tables of the documentation.

mod fpga;
mod gates;
mod netlist;
pub mod record;

pub use crate::flow::FlowError as SynthError;
pub use netlist::Cells;

use crate::flow::{self, Folder};
use crate::sources::{self, Sources};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Interface;
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
        let sources = self.sources(&interface)?;
        let design = Design { interface: &interface, sources: &sources, cache: &self.cache };
        match tech {
            Tech::Gates => gates::measure(&design),
            Tech::Ice40 => fpga::measure(&design, &fpga::ICE40),
            Tech::Ecp5 => fpga::measure(&design, &fpga::ECP5),
        }
    }

    /// The gate-level netlist of a module with the parameters of its interface, as Verilog.
    pub fn netlist(&self, interface: &Interface, cells: Cells) -> Result<String, SynthError> {
        let sources = self.sources(interface)?;
        netlist::make(&Design { interface, sources: &sources, cache: &self.cache }, cells)
    }

    fn sources(&self, interface: &Interface) -> Result<Sources, SynthError> {
        sources::read(&self.rtl, interface.module)
            .map(sources::hardware)
            .map_err(|e| SynthError::Read { path: e.path, source: e.source })
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
    pub(crate) fn module(&self) -> &'static str {
        self.interface.module
    }

    /// Yosys commands that read the Verilog and set the parameters.
    pub fn read_commands(&self) -> String {
        flow::read_commands(self.sources, self.module(), &self.interface.parameters)
    }

    /// What `measure` finds, kept under a hash of the sources and of `inputs`: everything else that
    /// the result depends on.
    fn cached<T: Serialize + DeserializeOwned>(
        &self,
        inputs: &[&[u8]],
        measure: impl FnOnce(&Folder) -> Result<T, SynthError>,
    ) -> Result<T, SynthError> {
        flow::cached(self.cache, self.module(), self.sources, inputs, |_| true, measure)
    }
}
