//! Waveforms and their views: for every dump a save file of GTKWave and a command file of Surfer, with
//! the signals grouped by stream and shown as what they are.
//!
//! Verilog has no fractions and no names for codes; a viewer shows them only if told for each
//! signal. The tables of the interface know them.
//!
//! A dump is written in a temporary folder and put in its place with its views when it is complete.

use crate::job::TraceWindow;
use crate::layout::Probe;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::io::{self, Read as _, Write as _};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use thiserror::Error;
use wheatstone_golden::files::{Scratch, Set, WriteError};
use wheatstone_golden::interface::{Direction, Field, Interface, Kind, Stream};
use wheatstone_golden::text::printable_path;

/// Room that a dump must have while it is written; the largest take a hundredth of it.
const ROOM: usize = 32 << 20;
/// Folder in which the C library makes unnamed temporary files, whatever the environment says.
const UNNAMED: &str = "/tmp";

/// The contents of a view.
#[derive(Clone, Copy, Debug)]
pub struct View<'a> {
    /// The module that was simulated.
    pub interface: &'a Interface,
    /// Units inside it, each with the streams to be shown.
    pub units: &'a [Probe],
    /// A cycle to be marked, with a name for the marker.
    pub marker: Option<(u64, &'a str)>,
}

/// The files written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViewFiles {
    /// Save file of GTKWave: `gtkwave FILE` opens the dump with it.
    pub gtkwave: PathBuf,
    /// Command file of Surfer: `surfer -c FILE`.
    pub surfer: PathBuf,
    /// Signals shown.
    pub signals: usize,
    /// Signals of the tables that the dump does not have.
    pub missing: Vec<String>,
}

/// A view could not be made.
#[derive(Debug, Error)]
pub enum WaveError {
    /// The dump could not be read.
    #[error("cannot read the waveform {}: {why}", printable_path(.path))]
    Dump {
        /// The dump.
        path: PathBuf,
        /// The cause.
        why: String,
    },
    /// The dump has no values: it was never completed, or its window was never reached.
    #[error("the waveform {} is empty", printable_path(.0))]
    Empty(PathBuf),
    /// There is no room to write a dump.
    #[error("no room for waveforms in {} ({} MiB are wanted): {source}", printable_path(.folder), ROOM >> 20)]
    Room {
        /// The temporary folder.
        folder: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}: {source}", printable_path(.path))]
    Write {
        /// The file.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}

/// A signal with its place in the dump.
struct Line {
    /// Name in the dump, with the range of a vector.
    name: String,
    kind: Kind,
    bits: u32,
}

/// Paths of files, and what is to be in them.
type Files = Vec<(PathBuf, Vec<u8>)>;

/// Signals under a title.
struct Group {
    title: String,
    lines: Vec<Line>,
}

/// A dump under way.
///
/// Verilator's writer maps its files into memory, where a full disk is a deadly signal and no error:
/// there must be room before it begins.
pub(crate) struct Dump {
    folder: Scratch,
    cycles: RangeInclusive<u64>,
}

impl Dump {
    /// A dump of some cycles, in a temporary folder that has room for it.
    pub fn new(cycles: RangeInclusive<u64>) -> Result<Dump, WaveError> {
        let folder = std::env::temp_dir();
        let at = |folder: &Path| {
            let folder = folder.to_owned();
            |source| WaveError::Room { folder, source }
        };
        for folder in BTreeSet::from([&folder, Path::new(UNNAMED)]) {
            probe(folder).map_err(at(folder))?;
        }
        Ok(Dump { folder: Scratch::new(&folder).map_err(at(&folder))?, cycles })
    }

    /// The part of the run that the simulation writes.
    pub fn window(&self) -> TraceWindow {
        let path = self.folder.path().join("dump.fst");
        TraceWindow { path, from_cycle: *self.cycles.start(), to_cycle: *self.cycles.end() }
    }

    /// Puts the dump, now complete, and its views in their place: all of them, or none.
    pub fn deliver(self, place: &Path, view: &View<'_>) -> Result<(), WaveError> {
        let dump = self.window().path;
        let content = files(&dump, place, view)?.1;
        put(place, &content, Some(&dump))
    }
}

/// Writes as much as a dump could need into a folder; real bytes, as a file with a hole takes no room.
fn probe(folder: &Path) -> io::Result<()> {
    let mut file = tempfile::tempfile_in(folder)?;
    let block = [0x5a; 1 << 16];
    (0..ROOM / block.len()).try_for_each(|_| file.write_all(&block))
}

/// Writes the views of a dump, and with them the dump if it is not in its place yet: all appear, or none.
fn put(place: &Path, views: &Files, dump: Option<&Path>) -> Result<(), WaveError> {
    let error = |error: WriteError| WaveError::Write { path: error.file, source: error.source };
    let set = Set::new(place.parent().unwrap_or(Path::new("."))).map_err(error)?;
    let to = |path: &Path| set.path().join(path.file_name().unwrap_or_default());
    for (path, content) in views {
        fs::write(to(path), content)
            .map_err(|e| WaveError::Write { path: path.clone(), source: e })?;
    }
    if let Some(dump) = dump {
        fs::copy(dump, to(place))
            .map_err(|source| WaveError::Write { path: place.to_owned(), source })?;
    }
    let main = place.file_name().unwrap_or_default().to_string_lossy();
    let codes = place.with_extension("codes");
    let codes = codes.file_name().unwrap_or_default().to_string_lossy();
    set.finish(&main, |name| name.strip_prefix(&*codes).is_some_and(|n| n.ends_with(".txt")))
        .map_err(error)
}

/// Writes the views `<dump>.gtkw` and `<dump>.sucl` beside a dump.
pub fn write_views(dump: &Path, view: &View<'_>) -> Result<ViewFiles, WaveError> {
    let (views, content) = files(dump, dump, view)?;
    put(dump, &content, None)?;
    Ok(views)
}

/// The views of a dump that is going to be in a place, and all files that belong to them.
fn files(dump: &Path, place: &Path, view: &View<'_>) -> Result<(ViewFiles, Files), WaveError> {
    let names = names(dump)?;
    let mut missing = Vec::new();
    let groups = groups(view, &names, &mut missing);
    let place = std::path::absolute(place).unwrap_or_else(|_| place.to_owned());
    let views = ViewFiles {
        gtkwave: place.with_extension("gtkw"),
        surfer: place.with_extension("sucl"),
        signals: groups.iter().map(|group| group.lines.len()).sum(),
        missing,
    };
    let (filters, mut files) = filters(&place, &groups);
    let save = gtkwave(&place, &views.gtkwave, view, &groups, &filters);
    files.push((views.gtkwave.clone(), save.into_bytes()));
    files.push((views.surfer.clone(), surfer(&place, view, &groups).into_bytes()));
    Ok((views, files))
}

/// The signals of a dump: path to path with range.
fn names(dump: &Path) -> Result<BTreeMap<String, String>, WaveError> {
    let error = |why: String| WaveError::Dump { path: dump.to_owned(), why };
    // A dump that was never closed has an unfinished header, on which its reader stumbles: the
    // last number of the header counts the blocks of values.
    let mut header = [0u8; 73];
    let mut file = fs::File::open(dump).map_err(|e| error(e.to_string()))?;
    if file.read_exact(&mut header).is_err() || header[65..] == [0; 8] {
        return Err(WaveError::Empty(dump.to_owned()));
    }
    let waveform = wellen::simple::read(dump).map_err(|e| error(e.to_string()))?;
    // Without any value the writer leaves one time, 0; every cycle has two.
    if waveform.time_table().len() < 2 {
        return Err(WaveError::Empty(dump.to_owned()));
    }
    let hierarchy = waveform.hierarchy();
    let name = |var: &wellen::Var| {
        let path = var.full_name(hierarchy);
        let range = var.index().map(|range| format!("[{}:{}]", range.msb(), range.lsb()));
        (path.clone(), path + &range.unwrap_or_default())
    };
    Ok(hierarchy.iter_vars().map(name).collect())
}

/// The groups of a view: clock and statics, the module's streams, its flags, then the units.
fn groups(
    view: &View<'_>,
    names: &BTreeMap<String, String>,
    missing: &mut Vec<String>,
) -> Vec<Group> {
    let top = format!("TOP.{}", view.interface.module);
    let mut group = |title: String, scope: &str, signals: Vec<(String, Kind, u32)>| {
        let mut lines = Vec::new();
        for (name, kind, bits) in signals {
            let path = format!("{scope}.{name}");
            match names.get(&path) {
                Some(name) => lines.push(Line { name: name.clone(), kind, bits }),
                None => missing.push(path),
            }
        }
        Group { title, lines }
    };
    let field =
        |field: &Field, suffix: &str| (format!("{}_{suffix}", field.name), field.kind, field.bits);
    let mut first: Vec<_> =
        ["clk_i", "rst_i"].map(|name| (name.to_owned(), Kind::Flag, 1)).to_vec();
    first.extend(view.interface.statics.iter().map(|f| field(f, "i")));
    first.extend(view.interface.flags.iter().map(|f| field(f, "o")));
    let mut groups = vec![group(view.interface.module.to_owned(), &top, first)];
    for stream in &view.interface.streams {
        groups.push(group(stream.name.to_owned(), &top, signals(stream)));
    }
    for unit in view.units {
        let scope = format!("{top}.{}", unit.instance);
        for stream in &unit.streams {
            let title = format!("{}.{}", unit.instance, stream.name);
            groups.push(group(title, &scope, signals(stream)));
        }
    }
    groups.retain(|group| !group.lines.is_empty());
    groups
}

/// The ports of a stream: handshake, then fields.
fn signals(stream: &Stream) -> Vec<(String, Kind, u32)> {
    let (forth, back) = match stream.direction {
        Direction::Input => ("i", "o"),
        Direction::Output => ("o", "i"),
    };
    let name = stream.name;
    let mut signals = vec![
        (format!("{name}_valid_{forth}"), Kind::Flag, 1),
        (format!("{name}_ready_{back}"), Kind::Flag, 1),
    ];
    let fields = stream.fields.iter();
    signals.extend(fields.map(|f| (format!("{name}_{}_{forth}", f.name), f.kind, f.bits)));
    signals
}

/// One file for each set of names: a line a code, in binary.
fn filters(place: &Path, groups: &[Group]) -> (BTreeMap<Codes, PathBuf>, Files) {
    let (mut filters, mut files) = (BTreeMap::new(), Files::new());
    for line in groups.iter().flat_map(|group| &group.lines) {
        let Kind::Code(names) = line.kind else { continue };
        let codes = (names, line.bits);
        if filters.contains_key(&codes) {
            continue;
        }
        let path = place.with_extension(format!("codes{}.txt", filters.len()));
        let mut text = String::new();
        for (code, name) in names.iter().enumerate() {
            let _ = writeln!(text, "{code:0width$b} {name}", width = line.bits as usize);
        }
        files.push((path.clone(), text.into_bytes()));
        filters.insert(codes, path);
    }
    (filters, files)
}

/// Names of codes, and their width.
type Codes = (&'static [&'static str], u32);

fn gtkwave(
    dump: &Path,
    save: &Path,
    view: &View<'_>,
    groups: &[Group],
    filters: &BTreeMap<Codes, PathBuf>,
) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "[*] {}, written by wheatstone", view.interface.module);
    let _ = writeln!(text, "[dumpfile] \"{}\"\n[savefile] \"{}\"", dump.display(), save.display());
    let marker = view.marker.map(|(cycle, name)| (TraceWindow::time(cycle), name));
    let (time, named) = marker.map_or((0, "-1".to_owned()), |(time, _)| (time, time.to_string()));
    // About 15 clocks across the window, the marked one at two thirds.
    let _ =
        writeln!(text, "[timestart] {}\n[size] 1600 1000\n[pos] -1 -1", time.saturating_sub(105));
    let main = if marker.is_some() { time.to_string() } else { "-1".to_owned() };
    let _ = writeln!(text, "*-4.7 {main} {named}{}", " -1".repeat(25));
    if let Some((_, name)) = marker {
        let _ = writeln!(text, "[markername_long] A {name}");
    }
    let _ = writeln!(text, "[treeopen] TOP.\n[sst_expanded] 0\n[signals_width] 360");
    for group in groups {
        let _ = writeln!(text, "@200\n-{}", group.title);
        for line in &group.lines {
            let format = match line.kind {
                Kind::Flag => "@28".to_owned(),
                Kind::Colour => "@22".to_owned(),
                Kind::Code(names) => match filters.get(&(names, line.bits)) {
                    Some(path) => format!("@2028\n^1 {}", path.display()),
                    None => "@28".to_owned(),
                },
                Kind::Number { signed: false, fraction: 0 } => "@24".to_owned(),
                Kind::Number { signed: true, fraction: 0 } => "@420".to_owned(),
                Kind::Number { signed, fraction } => {
                    let flags = if signed { "@40000420" } else { "@40000024" };
                    format!("{flags}\n[fpshift_count] {fraction}")
                }
            };
            let _ = writeln!(text, "{format}\n{}", line.name);
        }
    }
    text
}

fn surfer(dump: &Path, view: &View<'_>, groups: &[Group]) -> String {
    let mut text = format!("load_file {}\n", dump.display());
    let mut item = 0;
    for group in groups {
        let _ = writeln!(text, "divider_add {}", group.title);
        item += 1;
        for line in &group.lines {
            let name = line.name.split('[').next().unwrap_or(&line.name);
            let format = match line.kind {
                Kind::Flag => None,
                Kind::Colour => Some("Hexadecimal"),
                Kind::Number { signed: true, .. } => Some("Signed"),
                Kind::Number { .. } | Kind::Code(_) => Some("Unsigned"),
            };
            let _ = writeln!(text, "variable_add {name}");
            if let Some(format) = format {
                let _ = writeln!(text, "item_focus {}\nitem_set_format {format}", letters(item));
            }
            item += 1;
        }
    }
    text.push_str("item_unfocus\n");
    if let Some((cycle, name)) = view.marker {
        let time = TraceWindow::time(cycle);
        let name = name.replace(' ', "_");
        let _ = writeln!(text, "cursor_set {time}\nmarker_set {name} {time}\ngoto_cursor");
    }
    text
}

/// Surfer numbers its items with letters: a, b, … z, ba, bb, ….
fn letters(mut number: usize) -> String {
    let mut letters = Vec::new();
    loop {
        letters.push(char::from(b'a' + (number % 26) as u8));
        number /= 26;
        if number == 0 {
            return letters.into_iter().rev().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_appear_all_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a.fst");
        let file = |name: &str| (folder.path().join(name), name.as_bytes().to_vec());
        let older = ["a.gtkw", "a.codes0.txt", "a.codes1.txt"].map(file).to_vec();
        put(&place, &older, Some(Path::new(file!()).with_extension("none").as_path())).unwrap_err();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        let dump = tempfile::NamedTempFile::new().unwrap();
        put(&place, &older, Some(dump.path())).unwrap();
        assert!(older.iter().all(|(path, content)| fs::read(path).unwrap() == *content));
        put(&place, &older[..2].to_vec(), Some(dump.path())).unwrap();
        assert!(!older[2].0.exists(), "codes that no view names");
        fs::create_dir(folder.path().join("b.gtkw")).unwrap();
        let views = ["b.codes0.txt", "b.gtkw"].map(file).to_vec();
        let error = put(&folder.path().join("b.fst"), &views, Some(dump.path())).unwrap_err();
        let expected = format!("cannot write {}", folder.path().join("b.gtkw").display());
        assert!(error.to_string().starts_with(&expected), "{error}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 4);
    }

    #[test]
    fn surfer_counts_with_letters() {
        assert_eq!([0, 1, 25, 26, 27, 52].map(letters), ["a", "b", "z", "ba", "bb", "ca"]);
    }
}
