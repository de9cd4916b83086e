//! Netlists of gates against the Verilog that they were made of: the same for ever, by induction over
//! the registers, which synthesis leaves their names.

use super::prover::Prover;
use super::verdict::tenths;
use crate::flow::{self, FlowError};
use crate::tools::YOSYS;
use serde::{Deserialize, Serialize};
use wheatstone_golden::config::Config;
use wheatstone_golden::targets::Target;

/// The result of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equivalence {
    /// Signals of both that were compared; 0 if the prover was stopped.
    pub points: u32,
    /// Signals that were not proved equal.
    pub open: u32,
    /// Processor time.
    pub seconds: f64,
}

impl Equivalence {
    /// True if the netlist was proved.
    pub fn closes(&self) -> bool {
        self.points > 0 && self.open == 0
    }

    /// True if the comparison came to its end and did not prove it.
    pub fn differs(&self) -> bool {
        self.open > 0
    }
}

impl Prover {
    /// Compares the netlist of generic gates of a target with its Verilog.
    pub fn equivalence(&self, target: Target, config: &Config) -> Result<Equivalence, FlowError> {
        let interface = target.interface(config);
        let module = interface.module;
        let sources = self.sources(target.name())?;
        let yosys = YOSYS.find()?;
        let script = script(&flow::read_commands(&sources, module, &interface.parameters), module);
        let limit = format!("{:?}", self.limit);
        let inputs = [&yosys.text, &script, &limit].map(|text| text.as_bytes());
        let keep = |found: &Equivalence| found.points > 0;
        flow::cached(&self.cache, module, &sources, &inputs, keep, |folder| {
            let mut command = folder.command(&yosys);
            let output = folder.limited(&YOSYS, command.args(["-q", "-p", &script]), self.limit)?;
            let (points, open) = if output.is_stopped {
                (0, 0)
            } else if output.succeeded() {
                let stat = folder.read(&YOSYS, "stat")?;
                points(&stat).ok_or_else(|| folder.failed(&YOSYS, &stat))?
            } else {
                return Err(folder.failed(&YOSYS, &output.said()));
            };
            Ok(Equivalence { points, open, seconds: tenths(output.processor) })
        })
    }
}

/// Yosys commands: the Verilog elaborated, the netlist of generic gates, both compared.
fn script(read: &str, module: &str) -> String {
    format!(
        "{read}hierarchy -top {module}; design -save rtl; \
         synth -flatten -top {module}; rename {module} gate; design -stash gate; \
         design -load rtl; prep -flatten -top {module}; memory_map; opt_clean; \
         rename {module} gold; design -stash gold; \
         design -copy-from gold -as gold gold; design -copy-from gate -as gate gate; \
         equiv_make gold gate equal; hierarchy -top equal; clean; \
         equiv_struct; equiv_simple -undef; equiv_induct -undef -seq 4; \
         tee -q -o stat equiv_status"
    )
}

/// The number of points that were compared, and of those that are open.
fn points(stat: &str) -> Option<(u32, u32)> {
    let words = |line: &str| line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let numbers: Vec<u32> = stat.lines().find(|line| line.contains("are proven")).map(words)?;
    let [proved, open] = numbers[..] else { return None };
    Some((proved + open, open))
}

#[cfg(test)]
mod tests {
    #[test]
    fn points_are_read() {
        let stat =
            "Found 7 $equiv cells in equal:\n  Of those cells 5 are proven and 2 are unproven.\n";
        assert_eq!(super::points(stat), Some((7, 2)));
        assert_eq!(super::points("nothing"), None);
    }
}
