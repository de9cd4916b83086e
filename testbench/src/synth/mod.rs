//! Synthesis: area of units and systems in gates and on two FPGAs, and their clocks there.
//!
//! [`Synthesiser::measure`] runs the open tools on one target in one configuration; results are kept in
//! a cache by content. [`record`] has the figures that are committed, what may change against them and
//! the tables of the documentation.

mod design;
mod fpga;
mod gates;
mod netlist;
pub mod record;
mod tech;

pub use crate::flow::FlowError as SynthError;
pub(crate) use design::Design;
pub use netlist::Cells;
pub use tech::{Figure, Figures, Tech};

use crate::sources::{self, Sources};
use std::path::PathBuf;
use wheatstone_golden::config::Config;
use wheatstone_golden::interface::Interface;
use wheatstone_golden::targets::Target;

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
