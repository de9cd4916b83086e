//! The netlist with all mutants of a target in it, and the list of them.

use crate::flow::Folder;
use crate::sources;
use crate::synth::{Design, SynthError};
use crate::tools::{Found, YOSYS};
use serde::Serialize;
use std::fmt;
use std::path::{Path, PathBuf};
use wheatstone_golden::files::WriteError;
use wheatstone_golden::interface::{Field, Interface, Kind};

/// The input that chooses the mutant, and its width.
const SELECT: &str = "mutsel";
const SELECT_BITS: u32 = 16;

/// The folder, in the working folder, with nothing but the netlist.
const NETLIST: &str = "netlist";
/// The design before mutation, in the working folder.
pub(super) const DESIGN: &str = "design.il";

/// A change of one bit at one cell.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mutant {
    /// Options of the command `mutate` of Yosys that makes the change.
    pub change: String,
    /// File and lines of the Verilog.
    pub place: String,
}

impl Mutant {
    /// Reads a line of Yosys's list; none for the one that changes nothing.
    fn parse(line: &str) -> Option<Mutant> {
        let (_, change) = line.split_once("-mode ")?;
        let (change, sources) = change.split_once(" -src ").unwrap_or((change, ""));
        // The last source is that of the cell; those before are of the wire.
        let place = sources.rsplit(" -src ").next().unwrap_or_default().to_owned();
        (change != "none").then(|| Mutant { change: format!("-mode {change}"), place })
    }

    /// The value of an option.
    fn option(&self, name: &str) -> Option<&str> {
        let mut words = self.change.split(' ').skip_while(|word| *word != name);
        words.nth(1)
    }
}

impl fmt::Display for Mutant {
    /// For example: `sam_display.v:59.9-62.12 $procmux$13.B[0] const1 (x_q[0])`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let option = |name| self.option(name).unwrap_or_default();
        let (cell, port, bit) = (option("-cell"), option("-port"), option("-portbit"));
        write!(f, "{} {cell}.{port}[{bit}] {}", self.place, option("-mode"))?;
        if let Some(control) = self.option("-ctrlbit") {
            write!(f, " by [{control}]")?;
        }
        match self.option("-wire") {
            Some(wire) => write!(f, " ({wire}[{}])", option("-wirebit")),
            None => Ok(()),
        }
    }
}

/// A target's netlist with its mutants.
pub(super) struct Netlist {
    /// The interface of the target.
    pub interface: Interface,
    /// The interface of the netlist: no parameters, and the choice of the mutant as last static input.
    pub mutated: Interface,
    /// The mutants; the first one has number 1.
    pub mutants: Vec<Mutant>,
    /// The folder in which the tools work.
    pub work: Folder,
    /// Yosys.
    pub yosys: Found,
}

impl Netlist {
    /// Makes it.
    pub fn new(
        rtl: &Path,
        cache: &Path,
        interface: &Interface,
        count: u32,
        seed: u64,
    ) -> Result<Netlist, SynthError> {
        let yosys = YOSYS.find()?;
        let sources = sources::read(rtl, interface.module)
            .map_err(|e| SynthError::Read { path: e.path, source: e.source })?;
        let design = Design { interface, sources: &sources, cache };
        let work = Folder::of(cache, design.module(), &sources)?;
        let module = interface.module;
        // What is beyond a table reads as 0 everywhere: left open, simulation and proof would differ.
        // The count includes the mutant that changes nothing.
        let script = format!(
            "{}prep -flatten -top {module}; chtype -set $shift t:$shiftx; write_rtlil {DESIGN}; \
             mutate -list {} -seed {seed} -none -ctrl {SELECT}_i {SELECT_BITS} 0 -o list; script list; \
             splitnets -driver; write_verilog -noattr {NETLIST}/{module}.v",
            design.read_commands(),
            count + 1,
        );
        let folder = work.path().join(NETLIST);
        std::fs::create_dir(&folder).map_err(|source| WriteError { file: folder, source })?;
        let made = format!("{NETLIST}/{module}.v");
        let mut command = work.command(&yosys);
        work.run(&YOSYS, command.args(["-q", "-p", &script]), &[DESIGN, &made])?;
        let mutants = work.read(&YOSYS, "list")?.lines().filter_map(Mutant::parse).collect();
        let mut mutated = interface.clone();
        mutated.parameters.clear();
        mutated.statics.push(Field {
            name: SELECT,
            bits: SELECT_BITS,
            kind: Kind::Number { signed: false, fraction: 0 },
            doc: "the mutant, 0 for none",
        });
        Ok(Netlist { interface: interface.clone(), mutated, mutants, work, yosys })
    }

    /// The folder of the Verilog.
    pub fn folder(&self) -> PathBuf {
        self.work.path().join(NETLIST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_of_yosys_is_read() {
        let line = "mutate -ctrl mutsel_i 16 6 -mode cnot1 -module m -cell $add$m.v:44$2 -port A \
                    -portbit 4 -ctrlbit 0 -wire width_i -wirebit 4 -src m.v:15.56-15.63 \
                    -src m.v:44.31-44.58";
        let mutant = Mutant::parse(line).unwrap();
        let told = "m.v:44.31-44.58 $add$m.v:44$2.A[4] cnot1 by [0] (width_i[4])";
        assert_eq!(mutant.to_string(), told);
        assert!(
            mutant.change.starts_with("-mode cnot1 -module m") && !mutant.change.contains("src")
        );
        assert_eq!(Mutant::parse("mutate -ctrl mutsel_i 16 0 -mode none"), None);
    }
}
