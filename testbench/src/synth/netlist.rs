//! Gate-level netlists in Verilog.

use super::design::Design;
use crate::flow::FlowError;
use crate::tools::{self, YOSYS};
use wheatstone_golden::files;

/// The cells of a netlist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// Gates and flip-flops in plain Verilog.
    Generic,
    /// The OSU 0.35 µm standard cells.
    Osu035,
}

/// Synthesises a design into cells; nothing of its hierarchy is left, nor are parameters.
pub(super) fn make(design: &Design<'_>, cells: Cells) -> Result<String, FlowError> {
    let yosys = YOSYS.find()?;
    let library = match cells {
        Cells::Generic => None,
        Cells::Osu035 => Some(tools::osu035("lib")?),
    };
    let library = library.map_or(Ok(Vec::new()), |path| {
        files::read(&path, files::OWN_LIMIT).map_err(|e| FlowError::Read { path, source: e.source })
    })?;
    let map = match cells {
        // Flip-flops begin at random values, as real ones do: an unknown one would spread through
        // gates whose outputs do not depend on it.
        Cells::Generic => "setundef -init -random 1",
        Cells::Osu035 => "dfflibmap -liberty cells.lib; abc -liberty cells.lib",
    };
    let script = format!(
        "{}synth -flatten -top {}; {map}; opt_clean -purge; write_verilog -noattr netlist.v",
        design.read_commands(),
        design.module()
    );
    design.cached(&[yosys.text.as_bytes(), script.as_bytes(), &library], |folder| {
        folder.write("cells.lib", &library)?;
        folder.run(&YOSYS, folder.command(&yosys).args(["-q", "-p", &script]), &[])?;
        folder.read(&YOSYS, "netlist.v")
    })
}
