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
use wheatstone_golden::files::{self, irregular};

/// The line from which on a file has properties, which provers alone read, up to the next `` `endif ``.
pub(crate) const FORMAL: &str = "`ifdef FORMAL\n";

/// The folder in which tools that name it find the Verilog.
const FOLDER: &str = "rtl/";

/// Bytes of a file; none comes near.
pub(crate) const LIMIT: u64 = 64 << 20;

/// Files by name, with their content.
pub(crate) type Sources = BTreeMap<String, Vec<u8>>;

/// A file or folder could not be read.
pub(crate) struct Unreadable {
    /// Which one.
    pub path: PathBuf,
    /// The cause.
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
        // A folder, unless it has the name of a file, is none that is meant; anything else is read, or refused.
        let path = entry.path();
        let is_file = !path.is_dir() || path.extension().is_some();
        if let (true, Ok(name)) = (is_file, entry.file_name().into_string()) {
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
        check_named(rtl, &text).map_err(at(&path))?;
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

/// Refuses files that a text names and that no tool may read: what is included from elsewhere, which no cache would know
/// of, and what is no regular file, which may have no end.
fn check_named(rtl: &Path, text: &str) -> io::Result<()> {
    for keyword in ["`include", "$readmemh", "$readmemb"] {
        for rest in text.split(keyword).skip(1) {
            let rest = rest.trim_start_matches([' ', '\t', '\r', '\n', '(']);
            let name = rest.strip_prefix('"').and_then(|rest| rest.split('"').next());
            let Some(name) = name else { continue };
            let refuse = |why: &str| Err(io::Error::other(format!("{keyword} {name:?}: {why}")));
            let kind = [rtl, Path::new(".")].iter().find_map(|base| irregular(&base.join(name)));
            if let Some(kind) = kind {
                return refuse(&format!("expected a regular file, found {kind}"));
            }
            if keyword == "`include" && name.contains('/') {
                return refuse("only files of the same folder are read, by their bare names");
            }
        }
    }
    Ok(())
}

/// A text of a tool, which has its files in `rtl`, with the names of the folder that they were copied from.
pub(crate) fn named_from(rtl: &Path, text: &str) -> String {
    let mut parts = text.split(FOLDER);
    let mut named = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // Not at the end of a longer path.
        match named.ends_with(|c: char| c.is_alphanumeric() || "_-./".contains(c)) {
            true => named.push_str(FOLDER),
            false => named.push_str(&rtl.join("").display().to_string()),
        }
        named.push_str(part);
    }
    named
}

/// The hardware of it: without the properties.
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
    fn what_may_have_no_end_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let top = folder.path().join("top.v");
        let mkfifo = std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status();
        assert!(mkfifo.unwrap().success());
        fs::create_dir(folder.path().join("sub.v")).unwrap();
        fs::create_dir(folder.path().join("notes")).unwrap();
        for (text, expected) in [
            (
                "`include \"/dev/zero\"",
                "`include \"/dev/zero\": expected a regular file, found a device",
            ),
            (
                "$readmemh(\"/dev/zero\", m)",
                "$readmemh \"/dev/zero\": expected a regular file, found a device",
            ),
            (
                "`include \"pipe\"",
                "`include \"pipe\": expected a regular file, found a pipe (FIFO)",
            ),
            ("$readmemb( \"pipe\", m)", "found a pipe (FIFO)"),
            ("`include \"/etc/passwd\"", "only files of the same folder are read"),
            ("`include \"../x.vh\"", "only files of the same folder are read"),
            ("sub u();", "expected a regular file, found a folder"),
        ] {
            fs::write(&top, text).unwrap();
            let error = read(folder.path(), "top").map(drop).map_err(|e| e.source.to_string());
            assert!(error.as_ref().is_err_and(|e| e.contains(expected)), "{text}: {error:?}");
        }
        fs::write(&top, "// notes: `include none, $readmemh(FILE, m)").unwrap();
        assert!(read(folder.path(), "top").is_ok());
    }

    #[test]
    fn tools_speak_of_the_folder_of_the_user() {
        let named = |text| named_from(Path::new("/w/rtl"), text);
        assert_eq!(named("%Error: rtl/a.v:3: x"), "%Error: /w/rtl/a.v:3: x");
        assert_eq!(named("at rtl/a.v:3 and (rtl/b.vh)"), "at /w/rtl/a.v:3 and (/w/rtl/b.vh)");
        assert_eq!(named("/w/rtl/a.v my_rtl/b.v"), "/w/rtl/a.v my_rtl/b.v");
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
