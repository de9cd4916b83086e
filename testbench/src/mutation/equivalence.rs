//! Proofs that a mutant behaves as its target does, for whoever keeps the rules of streams.
//!
//! Both get the same beats, stalls and static inputs. A beat offered stays until it is taken; static
//! inputs do not change; there is one reset, at any time, before which anything may have happened and
//! after which outputs are compared: `valid` and flags on every clock, payloads where they are valid, `ready`
//! where a beat is offered. ABC proves for all time that no difference shows, by merging
//! registers that are equal and property-directed reachability, or finds a sequence that shows one. What
//! is slower by a clock counts as different.

use super::netlist::{Mutant, Netlist, DESIGN};
use crate::synth::SynthError;
use crate::tools::{YOSYS, YOSYS_ABC};
use std::fmt::Write;
use std::time::Duration;
use wheatstone_golden::interface::{Direction, Field, Interface, Stream};

/// Processor time that a proof may take, merging included.
const LIMIT: Duration = Duration::from_secs(120);

/// Result of the comparison of a mutant with its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No beats show a difference.
    Equal,
    /// Some beats do.
    Different,
    /// Neither was proved in the time allowed.
    Open,
}

impl Netlist {
    /// Compares a mutant with its target.
    pub fn compare(&self, mutant: &Mutant) -> Result<Verdict, SynthError> {
        let abc = YOSYS_ABC.find()?;
        let number = self.mutants.iter().position(|m| m == mutant).unwrap_or_default();
        let [verilog, file] = ["v", "aig"].map(|end| format!("miter{number}.{end}"));
        self.work.write(&verilog, miter(&self.interface).as_bytes())?;
        let (module, change) = (self.interface.module, &mutant.change);
        // Registers hold 0 at first; whatever they may hold before the reset follows from there.
        let script = format!(
            "read_rtlil {DESIGN}; rename {module} gold; \
             read_rtlil {DESIGN}; mutate {change}; rename {module} gate; \
             read_verilog {verilog}; prep -flatten -top miter; memory_map; \
             setundef -zero -undriven -init; opt -full; techmap; opt -fast; dffunmap; \
             abc -g AND -fast; opt_clean; aigmap; write_aiger {file}"
        );
        let mut command = self.work.command(&self.yosys);
        self.work.run(&YOSYS, command.args(["-q", "-p", &script]), &[&file])?;
        let proof = format!("read_aiger {file}; strash; lcorr; scorr; pdr; print_status");
        // Registers alone first: where those of both are the same, so are their multipliers.
        let mut command = self.work.command(&abc);
        command.args(["-c", &proof]);
        let output = self.work.limited(&YOSYS_ABC, &mut command, LIMIT)?;
        if output.is_stopped {
            return Ok(Verdict::Open);
        }
        let text = String::from_utf8_lossy(&output.stdout);
        let status = text.lines().rev().find_map(|line| line.trim().strip_prefix("Status ="));
        match status.and_then(|rest| rest.split_whitespace().next()) {
            Some("1") => Ok(Verdict::Equal),
            Some("0") => Ok(Verdict::Different),
            Some("-1") => Ok(Verdict::Open),
            _ => Err(self.work.failed(&YOSYS_ABC, &text)),
        }
    }
}

/// The Verilog of a module that has a target, `gold`, and its mutant, `gate`, and one output: whether a
/// difference shows. Its inputs are free.
fn miter(interface: &Interface) -> String {
    let mut miter = Miter::default();
    interface.statics.iter().for_each(|field| miter.add_static(field));
    interface.flags.iter().for_each(|field| miter.add_flag(field));
    for stream in &interface.streams {
        match stream.direction {
            Direction::Input => miter.add_input(stream),
            Direction::Output => miter.add_output(stream),
        }
    }
    miter.text()
}

#[derive(Default)]
struct Miter {
    /// Free inputs.
    ports: String,
    body: String,
    /// Connections of both instances; `@` stands for the instance's name.
    connections: String,
    differences: Vec<String>,
}

impl Miter {
    fn add_port(&mut self, name: &str, bits: u32) {
        // Writing to a string cannot fail.
        let _ = write!(self.ports, ", input wire [{}:0] {name}", bits - 1);
    }

    /// Declares a wire of each instance.
    fn add_wires(&mut self, name: &str, bits: u32) {
        let _ = writeln!(self.body, "wire [{}:0] {name}_gold, {name}_gate;", bits - 1);
    }

    fn connect(&mut self, port: &str, to: &str) {
        let _ = write!(self.connections, ", .{port}({to})");
    }

    fn add_static(&mut self, Field { name, bits, .. }: &Field) {
        self.add_port(&format!("{name}_free"), *bits);
        let _ = writeln!(
            self.body,
            "reg [{0}:0] {name}_q = 0; wire [{0}:0] {name} = running_q ? {name}_q : {name}_free;\n\
             always @(posedge clk_i) {name}_q <= {name};",
            bits - 1
        );
        self.connect(&format!("{name}_i"), name);
    }

    fn add_flag(&mut self, Field { name, bits, .. }: &Field) {
        self.add_wires(name, *bits);
        self.connect(&format!("{name}_o"), &format!("{name}_@"));
        self.differences.push(format!("({name}_gold != {name}_gate)"));
    }

    /// Connects the fields of a stream to parts of a word, and gives the word's width.
    fn connect_fields(&mut self, stream: &Stream, end: &str, word: &str) -> u32 {
        let mut low = 0;
        for Field { name, bits, .. } in &stream.fields {
            let high = low + bits - 1;
            self.connect(
                &format!("{}_{name}_{end}", stream.name),
                &format!("{word}[{high}:{low}]"),
            );
            low += bits;
        }
        low
    }

    fn add_input(&mut self, stream: &Stream) {
        let s = stream.name;
        self.connect(&format!("{s}_valid_i"), &format!("{s}_valid"));
        self.connect(&format!("{s}_ready_o"), &format!("{s}_ready_@"));
        let bits = self.connect_fields(stream, "i", &format!("{s}_beat"));
        self.add_port(&format!("{s}_valid_free"), 1);
        self.add_port(&format!("{s}_free"), bits);
        self.add_wires(&format!("{s}_ready"), 1);
        let _ = writeln!(
            self.body,
            "reg {s}_waits_q = 0; reg [{0}:0] {s}_beat_q = 0;\n\
             wire {s}_valid = {s}_waits_q | {s}_valid_free;\n\
             wire [{0}:0] {s}_beat = {s}_waits_q ? {s}_beat_q : {s}_free;\n\
             always @(posedge clk_i) begin {s}_waits_q <= running & {s}_valid & ~{s}_ready_gold; \
             {s}_beat_q <= {s}_beat; end",
            bits - 1
        );
        self.differences.push(format!("({s}_valid & ({s}_ready_gold ^ {s}_ready_gate))"));
    }

    fn add_output(&mut self, stream: &Stream) {
        let s = stream.name;
        self.connect(&format!("{s}_valid_o"), &format!("{s}_valid_@"));
        self.connect(&format!("{s}_ready_i"), &format!("{s}_ready_free"));
        let bits = self.connect_fields(stream, "o", &format!("{s}_beat_@"));
        self.add_port(&format!("{s}_ready_free"), 1);
        self.add_wires(&format!("{s}_valid"), 1);
        self.add_wires(&format!("{s}_beat"), bits);
        self.differences.push(format!("({s}_valid_gold ^ {s}_valid_gate)"));
        self.differences.push(format!("({s}_valid_gold & ({s}_beat_gold != {s}_beat_gate))"));
    }

    fn text(&self) -> String {
        let Miter { ports, body, connections, differences } = self;
        let instance = |name: &str| {
            let connections = connections.replace('@', name);
            format!("{name} {name}(.clk_i(clk_i), .rst_i(rst_free & ~running_q){connections});\n")
        };
        format!(
            "module miter(input wire clk_i, input wire rst_free{ports}, output wire differs_o);\n\
             reg reset_q = 0; reg running_q = 0;\n\
             wire running = running_q | (reset_q & ~rst_free);\n\
             always @(posedge clk_i) begin reset_q <= reset_q | rst_free; running_q <= running; end\n\
             {body}{}{}assign differs_o = running & ({});\nendmodule\n",
            instance("gold"),
            instance("gate"),
            differences.join(" | "),
        )
    }
}
