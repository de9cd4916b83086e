//! The Verilog that a module can use: its own file and, transitively, every file of the same
//! folder that one of them names.
//!
//! A file counts as named when its stem (for `.v`: the module) or its whole name (for headers
//! and data) occurs as a word. That finds more than is used, in comments for example, and
//! never less, because modules are found by file name (`-y`) and headers by `-I`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use wheatstone_golden::files;

/// The line from which on a file has properties, which provers alone read, up to the next `` `endif ``.
pub(crate) const FORMAL: &str = "`ifdef FORMAL\n";

/// Bytes of a file; none comes near.
pub(crate) const LIMIT: u64 = 64 << 20;

/// Files by name, with their content.
pub(crate) type Sources = BTreeMap<String, Vec<u8>>;

/// A file or folder could not be read.
pub(crate) struct Unreadable {
    /// Which one.
    pub path: PathBuf,
    /// Why.
    pub source: io::Error,
}

/// Reads everything that `module` can use from the folder `rtl`.
pub(crate) fn read(rtl: &Path, module: &str) -> Result<Sources, Unreadable> {
    let at = |path: &Path| {
        let path = path.to_owned();
        move |source| Unreadable { path, source }
    };
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(rtl).map_err(at(rtl))? {
        let entry = entry.map_err(at(rtl))?;
        if let (true, Ok(name)) = (entry.path().is_file(), entry.file_name().into_string()) {
            names.insert(name);
        }
    }
    let mut sources = Sources::new();
    let mut wanted = vec![format!("{module}.v")];
    while let Some(name) = wanted.pop() {
        if sources.contains_key(&name) {
            continue;
        }
        let path = rtl.join(&name);
        let content = files::read(&path, LIMIT)
            .map_err(|error| Unreadable { path: error.file, source: error.source })?;
        let text = String::from_utf8_lossy(&content);
        let is_word = |c: char| c.is_ascii_alphanumeric() || "_$.".contains(c);
        for word in text.split(|c: char| !is_word(c)) {
            let stem = word.split('.').next().unwrap_or(word);
            for name in [word.to_owned(), format!("{word}.v"), format!("{stem}.v")] {
                if names.contains(&name) && !sources.contains_key(&name) {
                    wanted.push(name);
                }
            }
        }
        sources.insert(name, content);
    }
    Ok(sources)
}

/// What is hardware of it: without the properties.
pub(crate) fn hardware(mut sources: Sources) -> Sources {
    for content in sources.values_mut() {
        let text = String::from_utf8_lossy(content);
        let parts = text.split_once(FORMAL);
        let parts = parts.and_then(|(before, rest)| Some((before, rest.split_once("`endif\n")?.1)));
        if let Some((before, after)) = parts {
            *content = [before, after].concat().into_bytes();
        }
    }
    sources
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closure_is_transitive_and_leaves_the_rest_alone() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [
            ("top.v", "module top; `include \"formats.vh\"\n unit #(.A(1)) u(.b(c)); endmodule"),
            ("unit.v", "module unit; leaf u(); initial $readmemh(\"table.mem\", m); endmodule"),
            ("leaf.v", "module leaf; endmodule"),
            ("formats.vh", "`define ROM rom"),
            ("rom.v", "module rom; endmodule"),
            ("table.mem", "00"),
            ("other.v", "module other; top u(); endmodule"),
        ] {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let sources = read(folder.path(), "top").map_err(|e| e.source).unwrap();
        let names: Vec<&str> = sources.keys().map(String::as_str).collect();
        assert_eq!(names, ["formats.vh", "leaf.v", "rom.v", "table.mem", "top.v", "unit.v"]);
    }

    #[test]
    fn properties_are_no_hardware() {
        let only = |text: &str| Sources::from([("unit.v".to_owned(), text.as_bytes().to_vec())]);
        let with = "module unit;\n`ifdef FORMAL\nassert (1);\n`endif\nendmodule\n";
        assert_eq!(hardware(only(with)), only("module unit;\nendmodule\n"));
        let without = "`ifdef OTHER\n`endif\n";
        assert_eq!(hardware(only(without)), only(without));
    }
}
