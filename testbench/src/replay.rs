//! Vector packs replayed outside the co-simulation: in Icarus, in cocotb, and on gate-level netlists.

use crate::pack::{self, Checked, PackError, Port};
use crate::room;
use crate::sources;
use crate::synth::{Cells, SynthError, Synthesiser};
use crate::tools::{self, Found, Tool, ToolError, COCOTB, ICARUS, VVP};
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::{self, Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};
use thiserror::Error;
use wheatstone_golden::files::Scratch;
use wheatstone_golden::text::printable_path;
use wheatstone_process::{Output, Process, ProcessError};

/// A way to replay a pack.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The Verilog in Icarus, by the bench in the pack.
    Icarus,
    /// The Verilog in Icarus, by `scripts/replay.py` in cocotb.
    Cocotb,
    /// A netlist of gates and flip-flops in Icarus, by the bench in the pack.
    Gates,
    /// A netlist of OSU 0.35 µm standard cells in Icarus, by the bench in the pack.
    Osu035,
}

impl Way {
    /// All of them, in the order of tables.
    pub const ALL: [Way; 4] = [Way::Icarus, Way::Cocotb, Way::Gates, Way::Osu035];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Way::Icarus => "icarus",
            Way::Cocotb => "cocotb",
            Way::Gates => "gates",
            Way::Osu035 => "osu035",
        }
    }
}

/// The result of a replay.
#[derive(Clone, Debug)]
pub struct Replayed {
    /// True if every output was equal in every bit.
    pub passed: bool,
    /// Output of the bench: the first differences, the CRC of every output stream, the verdict.
    pub said: String,
    /// Time of compilation and simulation, synthesis left out.
    pub time: Duration,
}

/// A pack could not be replayed.
#[derive(Debug, Error)]
pub enum ReplayError {
    /// A tool is missing.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// There is no netlist.
    #[error(transparent)]
    Synth(#[from] SynthError),
    /// The pack is not to be trusted.
    #[error(transparent)]
    Pack(#[from] PackError),
    /// The pack is another one than was checked before.
    #[error("{}: changed since it was checked; try again", printable_path(.0))]
    Changed(PathBuf),
    /// A file or folder could not be read or written.
    #[error("{}: {source}", printable_path(.path))]
    File {
        /// Which one.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A tool did not run, or not to its end.
    #[error(transparent)]
    Process(#[from] ProcessError),
    /// A tool refused what it was given, or gave no verdict.
    #[error("{tool} failed on {}:\n{said}", printable_path(.pack))]
    Failed {
        /// Which tool.
        tool: &'static str,
        /// Which pack.
        pack: PathBuf,
        /// The first lines of its output.
        said: String,
    },
}

impl ReplayError {
    fn at(path: &Path) -> impl FnOnce(io::Error) -> ReplayError + '_ {
        move |source| ReplayError::File { path: path.to_owned(), source }
    }
}

/// The Python that replays a pack.
const SCRIPT: &str = include_str!("../../scripts/replay.py");

/// Replays packs.
#[derive(Debug)]
pub struct Replayer {
    /// Makes the netlists; knows the Verilog.
    pub synthesiser: Synthesiser,
}

impl Replayer {
    /// Replays a pack that was found sound. It is checked again as it is copied into a folder of this process
    /// alone, and replayed from there under plain names, wherever it lies.
    pub fn replay(&self, pack: &Checked, way: Way) -> Result<Replayed, ReplayError> {
        let cache = &self.synthesiser.cache;
        fs::create_dir_all(cache).map_err(ReplayError::at(cache))?;
        let scratch = Scratch::new(cache).map_err(ReplayError::at(cache))?;
        let copy = pack::copy(&pack.folder, &scratch.path().join(PACK))?;
        if copy.manifest != pack.manifest {
            return Err(ReplayError::Changed(pack.folder.clone()));
        }
        let run = Run { replayer: self, pack, folder: scratch.path() };
        match way {
            Way::Icarus => run.icarus(&[], &run.verilog()?),
            Way::Cocotb => run.cocotb(),
            Way::Gates => run.netlist(Cells::Generic),
            Way::Osu035 => run.netlist(Cells::Osu035),
        }
    }
}

/// Name of the copy of a pack in the folder of a run, and of the copies of its Verilog.
const PACK: &str = "pack";
const VERILOG: &str = "rtl";
/// Folder of the temporary files of its tools.
const TEMPORARY: &str = "tmp";
/// File that Icarus compiles to.
const COMPILED: &str = "replay.vvp";

/// One replay in a folder of its own.
struct Run<'a> {
    replayer: &'a Replayer,
    /// The pack, as messages name it.
    pack: &'a Checked,
    folder: &'a Path,
}

impl Run<'_> {
    /// Copies the Verilog that the pack's module uses; the names of the copies in the folder of the run.
    fn verilog(&self) -> Result<Vec<PathBuf>, ReplayError> {
        let rtl = &self.replayer.synthesiser.rtl;
        let files = sources::read(rtl, &self.pack.manifest.module)
            .map_err(|e| ReplayError::File { path: e.path, source: e.source })?;
        let folder = self.folder.join(VERILOG);
        fs::create_dir(&folder).map_err(ReplayError::at(&folder))?;
        for (name, content) in &files {
            let path = folder.join(name);
            fs::write(&path, content).map_err(ReplayError::at(&path))?;
        }
        let modules = files.keys().filter(|name| name.ends_with(".v"));
        Ok(modules.map(|name| Path::new(VERILOG).join(name)).collect())
    }

    /// Compiles the pack's bench with other files and runs it.
    fn icarus(&self, options: &[&str], files: &[PathBuf]) -> Result<Replayed, ReplayError> {
        let (iverilog, vvp) = (ICARUS.find()?, VVP.find()?);
        let start = Instant::now();
        let mut command = Command::new(&iverilog.program);
        command.args(["-g2005", "-s", "replay"]).args(options).args(["-I", PACK]);
        command.args(["-o", COMPILED]).arg(Path::new(PACK).join("replay.v")).args(files);
        let said = self.run(&ICARUS, &mut command)?;
        if !self.folder.join(COMPILED).is_file() {
            let why = format!("it ended well, but wrote no {COMPILED}\n{said}");
            return Err(self.failed(&ICARUS, &why));
        }
        let output = self.process(&VVP, Command::new(&vvp.program).arg(COMPILED))?;
        self.verdict(&VVP, &output, start)
    }

    /// The same with a netlist in the module's place.
    fn netlist(&self, cells: Cells) -> Result<Replayed, ReplayError> {
        let netlist = self.replayer.synthesiser.netlist(&self.pack.interface, cells)?;
        let mut files = vec![self.write("netlist.v", &netlist)?];
        let mut options = vec!["-DNETLIST"];
        if cells == Cells::Osu035 {
            files.push(self.write("start.v", &start(&netlist))?);
            files.push(tools::osu035("v")?);
            options.extend(["-s", "start"]);
        }
        self.icarus(&options, &files)
    }

    /// Runs the script in the Python that has cocotb.
    fn cocotb(&self) -> Result<Replayed, ReplayError> {
        let (Found { program, .. }, _) = (COCOTB.find()?, ICARUS.find()?);
        self.write("replay.py", SCRIPT)?;
        self.verilog()?;
        let start = Instant::now();
        let mut command = Command::new(program.with_file_name("python3"));
        // It need not look after what it starts: that is done here.
        command.args(["replay.py", "--supervised", "--checked", PACK, "--rtl", VERILOG]);
        let output = self.process(&COCOTB, &mut command)?;
        self.verdict(&COCOTB, &output, start)
    }

    fn write(&self, name: &str, text: &str) -> Result<PathBuf, ReplayError> {
        let path = self.folder.join(name);
        fs::write(&path, text).map_err(ReplayError::at(&path))?;
        Ok(name.into())
    }

    /// Runs a command that must succeed; returns what it said.
    fn run(&self, tool: &'static Tool, command: &mut Command) -> Result<String, ReplayError> {
        let output = self.process(tool, command)?;
        match output.succeeded() {
            true => Ok(output.said()),
            false => Err(self.failed(tool, &output.said())),
        }
    }

    fn process(&self, tool: &'static Tool, command: &mut Command) -> Result<Output, ReplayError> {
        let pack = self.pack.folder.display().to_string();
        // What it leaves there when it is killed goes with the folder of the run.
        let temporary = path::absolute(self.folder.join(TEMPORARY))
            .and_then(|folder| fs::create_dir_all(&folder).map(|()| folder))
            .map_err(ReplayError::at(self.folder))?;
        command.env("TMPDIR", temporary);
        Ok(Process::new(tool.program, command.current_dir(self.folder)).on(pack).run()?)
    }

    /// The verdict in the bench's last line, and the exit status with it.
    fn verdict(
        &self,
        tool: &'static Tool,
        output: &Output,
        start: Instant,
    ) -> Result<Replayed, ReplayError> {
        let said = output.said();
        let passed = match said.lines().last() {
            Some("PASS") if output.succeeded() && self.compared_all(&said) => true,
            Some(line) if line.starts_with("FAIL (") && !output.succeeded() => false,
            _ => return Err(self.failed(tool, &said)),
        };
        Ok(Replayed { passed, said, time: start.elapsed() })
    }

    /// True if all beats of every output are said to have been compared: a module can print PASS too.
    fn compared_all(&self, said: &str) -> bool {
        let mut outputs = self.pack.manifest.ports.iter().filter(|port| port.direction == "output");
        outputs.all(|Port { name, crc32, beats, .. }| {
            let line = format!("crc {name} {crc32}, expected {crc32}, {beats} of {beats} beats");
            said.lines().any(|said| said == line)
        })
    }

    fn failed(&self, tool: &'static Tool, said: &str) -> ReplayError {
        if let Some(source) = room::lacking(self.folder, said) {
            return ReplayError::at(&self.replayer.synthesiser.cache)(source);
        }
        let said = said.lines().take(8).collect::<Vec<_>>().join("\n");
        let said = sources::named_from(&self.replayer.synthesiser.rtl, &said);
        ReplayError::Failed { tool: tool.program, pack: self.pack.folder.clone(), said }
    }
}

/// Puts every flip-flop of a netlist of OSU cells at a random value, as it has after power-up: an
/// unknown one would spread through gates whose outputs do not depend on it.
fn start(netlist: &str) -> String {
    let mut text = String::from("module start;\n  initial begin\n");
    let cells = netlist.lines().filter_map(|line| line.trim().strip_prefix("DFFPOSX1 "));
    for name in cells.filter_map(|rest| rest.split(' ').next()) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "    $deposit(replay.dut.{name} .DS0000, $random);");
    }
    text + "  end\nendmodule\n"
}
