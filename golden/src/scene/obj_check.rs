//! Checks OBJ and MTL files line by line before `tobj` reads them.
//!
//! `tobj` reports no lines, takes NaN for a number, panics at a colour of two components, and
//! mixes up vertices when some faces have normals or texture coordinates and others do not. What
//! is handed to it here is correct, has absolute indices, and begins a new group at every change
//! of layout; the rest of the file is left out.

use super::error::{no_text, read, InputError, SceneError, COORDINATE_LIMIT, ID_LIMIT};
use super::mesh::REPEAT_LIMIT;
use crate::text;
use std::collections::HashMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// A checked OBJ file.
#[derive(Debug, Default)]
pub struct Checked {
    /// The file as `tobj` is to see it.
    pub text: String,
    /// Material libraries as `tobj` is to see them, by the names that `text` gives them.
    pub libraries: HashMap<String, String>,
    /// Where the texture of a material is named.
    pub textures: HashMap<String, TextureName>,
}

/// A `map_Kd` line.
#[derive(Clone, Debug)]
pub struct TextureName {
    /// The material library.
    pub library: PathBuf,
    /// Line in it.
    pub line: usize,
    /// The picture.
    pub picture: PathBuf,
}

/// One line of a file, split into words.
struct Words<'a> {
    file: &'a Path,
    line: usize,
    keyword: &'a str,
    rest: &'a str,
}

impl<'a> Words<'a> {
    fn wrong(&self, expected: impl Into<String>, found: impl Into<String>) -> InputError {
        InputError::new(self.file, self.line, self.keyword, expected, found)
    }

    /// The words as numbers, of which there may be `least` to `most`.
    fn numbers(&self, least: usize, most: usize, limit: f64) -> Result<Vec<f64>, InputError> {
        let numbers: Vec<f64> = self
            .rest
            .split_whitespace()
            .map(|word| match word.parse::<f64>() {
                Ok(n) if n.abs() <= limit => Ok(n),
                Ok(_) => Err(self.wrong(format!("finite numbers of at most {limit:e}"), word)),
                Err(_) => Err(self.wrong("a number", word)),
            })
            .collect::<Result<_, _>>()?;
        if !(least..=most).contains(&numbers.len()) {
            let range =
                if least == most { least.to_string() } else { format!("{least} to {most}") };
            return Err(self.wrong(format!("{range} numbers"), numbers.len().to_string()));
        }
        Ok(numbers)
    }

    fn number(&self, least: f64, most: f64) -> Result<f64, InputError> {
        let n = self.numbers(1, 1, f64::MAX)?[0];
        if !(least..=most).contains(&n) {
            return Err(self.wrong(format!("a number from {least} to {most}"), self.rest));
        }
        Ok(n)
    }

    /// A name; it may contain spaces.
    fn name(&self) -> Result<&'a str, InputError> {
        if self.rest.is_empty() {
            return Err(self.wrong("a name", "nothing"));
        }
        Ok(self.rest)
    }
}

/// Lines of a file without comments; a line that ends in a backslash goes on in the next.
fn lines(text: &str) -> impl Iterator<Item = (usize, String)> + '_ {
    let mut lines = text.lines().enumerate();
    std::iter::from_fn(move || {
        let (number, first) = lines.next()?;
        let mut line = first.split('#').next().unwrap_or_default().trim_end().to_string();
        while line.ends_with('\\') {
            line.pop();
            let Some((_, more)) = lines.next() else { break };
            line.push(' ');
            line.push_str(more.split('#').next().unwrap_or_default().trim_end());
        }
        Some((number + 1, line))
    })
}

fn each_line(
    file: &Path,
    mut check: impl FnMut(&Words) -> Result<(), SceneError>,
) -> Result<(), SceneError> {
    let text = text::decode_with_latin1(&read(file)?).map_err(|error| no_text(file, error))?;
    for (line, words) in lines(&text) {
        let words = words.trim();
        let (keyword, rest) = words.split_once(char::is_whitespace).unwrap_or((words, ""));
        if !keyword.is_empty() {
            check(&Words { file, line, keyword, rest: rest.trim() })?;
        }
    }
    Ok(())
}

#[derive(Default)]
struct ObjChecker {
    checked: Checked,
    /// Vertices, texture coordinates, normals so far.
    counts: [usize; 3],
    coloured: Option<bool>,
    /// Which of texture coordinates and normals the last face had.
    layout: Option<[bool; 2]>,
    faces: usize,
    materials: Option<Vec<String>>,
}

/// Checks an OBJ file and the material libraries that it names.
pub fn check(file: &Path) -> Result<Checked, SceneError> {
    let mut checker = ObjChecker::default();
    each_line(file, |words| checker.line(words))?;
    if checker.faces == 0 {
        return Err(InputError::new(file, None, "f", "at least one face", "none").into());
    }
    Ok(checker.checked)
}

impl ObjChecker {
    fn line(&mut self, words: &Words) -> Result<(), SceneError> {
        match words.keyword {
            "v" => self.vertex(words)?,
            "vt" => {
                let mut numbers = words.numbers(1, 3, REPEAT_LIMIT)?;
                numbers.resize(2, 0.0);
                self.counts[1] += 1;
                self.write("vt", &numbers);
            }
            "vn" => {
                let numbers = words.numbers(3, 3, COORDINATE_LIMIT)?;
                self.counts[2] += 1;
                self.write("vn", &numbers);
            }
            "f" => self.face(words)?,
            "mtllib" => self.libraries(words)?,
            "usemtl" => {
                let name = words.name()?;
                // Without any library there are no materials to choose from.
                if let Some(materials) = &self.materials {
                    if !materials.iter().any(|m| m == name) {
                        let expected =
                            format!("a material of the library: {}", materials.join(", "));
                        return Err(words.wrong(expected, name).into());
                    }
                    self.checked.text += &format!("usemtl {name}\n");
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn write(&mut self, keyword: &str, numbers: &[f64]) {
        self.checked.text += keyword;
        for n in numbers {
            // Writing to a string cannot fail.
            let _ = write!(self.checked.text, " {n:?}");
        }
        self.checked.text.push('\n');
    }

    fn vertex(&mut self, words: &Words) -> Result<(), InputError> {
        let mut numbers = words.numbers(3, 6, COORDINATE_LIMIT)?;
        if numbers.len() == 5 {
            return Err(words.wrong("3, 4 or 6 numbers", "5"));
        }
        if numbers.len() == 4 {
            let w = numbers[3];
            numbers = numbers[..3].iter().map(|n| n / w).collect();
            if !numbers.iter().all(|n| n.abs() <= COORDINATE_LIMIT) {
                return Err(words.wrong("finite coordinates", words.rest));
            }
        }
        if numbers[3..].iter().any(|n| !(0.0..=1.0).contains(n)) {
            return Err(words.wrong("a colour of numbers from 0 to 1", words.rest));
        }
        if *self.coloured.get_or_insert(numbers.len() == 6) != (numbers.len() == 6) {
            return Err(words.wrong("a colour at every vertex or at none", words.rest));
        }
        self.counts[0] += 1;
        self.write("v", &numbers);
        Ok(())
    }

    fn face(&mut self, words: &Words) -> Result<(), InputError> {
        let mut layout = None;
        let mut corners = String::new();
        let mut count = 0;
        for word in words.rest.split_whitespace() {
            let mut indices = [None; 3];
            for (k, part) in word.split('/').enumerate() {
                if k == 3 {
                    return Err(words.wrong("vertex/texture/normal", word));
                }
                if !part.is_empty() {
                    indices[k] = Some(self.index(words, part, k)?);
                }
            }
            let [Some(vertex), texture, normal] = indices else {
                return Err(words.wrong("the index of a vertex", word));
            };
            let parts = [texture.is_some(), normal.is_some()];
            if *layout.get_or_insert(parts) != parts {
                return Err(words.wrong("corners that are all of one form", words.rest));
            }
            let part = |n: Option<usize>| n.map(|n| n.to_string()).unwrap_or_default();
            corners += &format!(" {vertex}/{}/{}", part(texture), part(normal));
            count += 1;
        }
        if count < 3 {
            return Err(words.wrong("three corners or more", count.to_string()));
        }
        self.faces += 1;
        if self.faces > ID_LIMIT {
            return Err(words.wrong(format!("at most {ID_LIMIT} faces"), "more"));
        }
        if self.layout != layout {
            self.layout = layout;
            self.checked.text += "g next\n";
        }
        self.checked.text += "f";
        self.checked.text += &corners;
        self.checked.text.push('\n');
        Ok(())
    }

    /// Absolute index, from 1, of a vertex (0), texture coordinate (1) or normal (2).
    fn index(&self, words: &Words, part: &str, kind: usize) -> Result<usize, InputError> {
        let count = self.counts[kind];
        let name = ["vertices", "texture coordinates", "normals"][kind];
        let Ok(n) = part.parse::<i64>() else {
            return Err(words.wrong("whole numbers as indices", part));
        };
        let absolute = if n < 0 { count as i64 + 1 + n } else { n };
        if absolute < 1 || absolute > count as i64 {
            return Err(words.wrong(format!("an index of the {count} {name} so far"), part));
        }
        Ok(absolute as usize)
    }

    fn libraries(&mut self, words: &Words) -> Result<(), SceneError> {
        let name = words.name()?;
        let folder = words.file.parent().unwrap_or(Path::new(""));
        // Several names, or one with spaces.
        let names: Vec<&str> = if beside(folder, name).is_file() {
            vec![name]
        } else {
            name.split_whitespace().collect()
        };
        for name in names {
            let path = beside(folder, name);
            if !path.is_file() {
                let found = format!("{}, which is not there", path.display());
                return Err(words.wrong("the name of a material library", found).into());
            }
            let library = check_library(&path, &mut self.checked.textures)?;
            let materials = self.materials.get_or_insert_default();
            materials
                .extend(library.lines().filter_map(|l| Some(l.strip_prefix("newmtl ")?.into())));
            let key = format!("library{}", self.checked.libraries.len());
            self.checked.text += &format!("mtllib {key}\n");
            self.checked.libraries.insert(key, library);
        }
        Ok(())
    }
}

/// The path of a file that is named relative to a folder; names from Windows are understood.
fn beside(folder: &Path, name: &str) -> PathBuf {
    let path = folder.join(name);
    if path.is_file() {
        path
    } else {
        folder.join(name.replace('\\', "/"))
    }
}

/// Checks a material library; what comes back is what `tobj` is to see.
fn check_library(
    file: &Path,
    textures: &mut HashMap<String, TextureName>,
) -> Result<String, SceneError> {
    let folder = file.parent().unwrap_or(Path::new(""));
    let mut material: Option<String> = None;
    let mut text = String::new();
    each_line(file, |words| {
        if words.keyword == "newmtl" {
            let name = words.name()?;
            text += &format!("newmtl {name}\n");
            material = Some(name.to_string());
            return Ok(());
        }
        let line = match words.keyword {
            "Kd" | "Ks" | "Ke" => {
                let n = words.numbers(1, 3, 1000.0)?;
                if n.iter().any(|n| *n < 0.0) || n.len() == 2 {
                    return Err(words.wrong("one or three numbers from 0", words.rest).into());
                }
                let last = n.len() - 1;
                format!("{} {:?} {:?} {:?}", words.keyword, n[0], n[last.min(1)], n[last])
            }
            "Ns" => format!("Ns {:?}", words.number(0.0, 1e6)?),
            "d" => format!("d {:?}", words.number(0.0, 1.0)?),
            "Tr" => format!("d {:?}", 1.0 - words.number(0.0, 1.0)?),
            "illum" => format!("illum {}", words.number(0.0, 10.0)? as u8),
            "map_Kd" => {
                let name = words.name()?;
                if name.starts_with('-') {
                    return Err(words.wrong("a file name without options", name).into());
                }
                let picture = beside(folder, name);
                let texture = TextureName { library: file.to_owned(), line: words.line, picture };
                textures.insert(material.clone().unwrap_or_default(), texture);
                "map_Kd texture".to_string()
            }
            _ => return Ok(()),
        };
        if material.is_none() {
            return Err(words.wrong("newmtl first", words.keyword).into());
        }
        text += &line;
        text.push('\n');
        Ok(())
    })?;
    Ok(text)
}
