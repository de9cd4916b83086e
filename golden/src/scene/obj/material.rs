//! Material libraries, and what becomes of their materials.

use super::super::error::{no_text, read};
use super::super::vector::{scale, Vec3};
use super::super::warning::Warnings;
use super::super::Material;
use super::find::{library_names, unquoted, Finder};
use super::parse::Name;
use super::picture::Pictures;
use super::statement::{each, is_one_of, number, without_comment, Statement};
use crate::text::decode_with_latin1;
use std::collections::{HashMap, HashSet};
use std::convert::Infallible;
use std::path::{Path, PathBuf};

/// Statements that name a picture, beside those that begin with `map_`.
const MAPS: &str = "bump disp decal refl norm";

/// Statements that are known to change nothing that is drawn here.
const SILENT: &str = "ka tf ni sharpness km kt pr pm ps pc pcr aniso anisor";

/// Position of a texture on a surface: texture points times `scale`, plus `offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    scale: [f64; 2],
    offset: [f64; 2],
}

impl Pattern {
    /// Coordinates, in repeats of the texture, v downward, of a texture point, whose v goes upward.
    pub fn at(&self, point: [f64; 2]) -> [f64; 2] {
        let [u, v] = [0, 1].map(|k| point[k] * self.scale[k] + self.offset[k]);
        [u, 1.0 - v]
    }
}

/// Appearance of a face.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Index of the material in the scene.
    pub material: u32,
    /// Position of its texture, if it has one.
    pub pattern: Option<Pattern>,
    /// It is that of faces without material.
    pub is_default: bool,
}

/// A `map_Kd` statement.
#[derive(Clone, Debug)]
struct Map {
    line: usize,
    statement: String,
    name: String,
    pattern: Pattern,
}

/// A material as its library has it.
#[derive(Clone, Debug, Default)]
struct Definition {
    library: PathBuf,
    diffuse: Option<Vec3>,
    specular: Option<Vec3>,
    emission: Option<Vec3>,
    exponent: Option<f64>,
    illumination: Option<f64>,
    dissolve: Option<f64>,
    /// Of `Tr`, with its line.
    transparency: Option<(f64, usize)>,
    map: Option<Map>,
}

/// The materials of all libraries.
#[derive(Default)]
pub struct Library {
    definitions: Vec<Definition>,
    /// Indices of the definitions by their names.
    names: HashMap<String, usize>,
    /// The same of names without what looks like a comment behind them, each the first.
    bare_names: HashMap<String, usize>,
    /// Not all libraries are there.
    incomplete: bool,
    finder: Finder,
}

impl Library {
    /// Reads the libraries that an OBJ file names; of materials of one name the first counts.
    pub fn read(file: &Path, libraries: &[Name], warnings: &mut Warnings) -> Library {
        let mut all = Library::default();
        let folder = file.parent().unwrap_or(Path::new(""));
        let mut read = HashSet::new();
        for Name { line, text } in libraries {
            let names = match all.finder.find(folder, text) {
                Some(_) => vec![text.clone()],
                None => library_names(text),
            };
            for name in names {
                let path = all.finder.find(folder, &name);
                let problem = match &path {
                    Some(path) if !read.insert(path.clone()) => Ok(()),
                    Some(path) => all.add(path, warnings),
                    None => Err(("no such library; its materials are light grey", String::new())),
                };
                if let Err((problem, detail)) = problem {
                    all.incomplete = true;
                    warnings.add(file, *line, &format!("mtllib {name}"), problem, &detail);
                }
            }
        }
        all
    }
}

/// Text of a warning, and more about this one.
type Problem = (&'static str, String);

impl Library {
    /// Adds the materials of one file.
    fn add(&mut self, file: &Path, warnings: &mut Warnings) -> Result<(), Problem> {
        let unread = |error: String| ("no readable library; its materials are light grey", error);
        let bytes = read(file).map_err(|error| unread(error.to_string()))?;
        let text =
            decode_with_latin1(&bytes).map_err(|error| unread(no_text(file, error).to_string()))?;
        // Index of the material that statements belong to.
        let mut current = None;
        // The first statement before any material, and how many there are.
        let (mut early, mut count) = (None, 0);
        let taken: Result<(), Infallible> = each(file, &text, |statement| {
            if statement.keyword == "newmtl" {
                current = Some(self.definitions.len());
                self.definitions.push(Definition { library: file.into(), ..Definition::default() });
                let name = unquoted(statement.rest);
                if self.names.contains_key(name) {
                    statement.warn(warnings, "the material is there already; the first counts");
                } else {
                    self.names.insert(name.into(), self.definitions.len() - 1);
                }
                let bare = unquoted(without_comment(statement.rest)).to_owned();
                if !bare.is_empty() {
                    self.bare_names.entry(bare).or_insert(self.definitions.len() - 1);
                }
            } else if let Some(current) = current {
                self.definitions[current].statement(statement, warnings);
            } else {
                early.get_or_insert_with(|| (statement.line, statement.text.to_owned()));
                count += 1;
            }
            Ok(())
        });
        let Ok(()) = taken;
        let Some((line, text)) = early else { return Ok(()) };
        if current.is_none() {
            let what = "no library of materials, as it has no newmtl; drawn light grey";
            return Err((what, format!("{count} other statements")));
        }
        let more = if count > 1 { format!("as {} more", count - 1) } else { String::new() };
        warnings.add(file, line, &text, "newmtl comes first; left out", &more);
        Ok(())
    }

    fn named(&self, name: &str) -> Option<usize> {
        let [whole, bare] = [name, without_comment(name)].map(unquoted);
        let named = self.names.get(whole).or_else(|| self.names.get(bare));
        named.or_else(|| self.bare_names.get(bare)).copied()
    }

    /// The looks of the materials of these names, and of none; adds their materials to those of a
    /// scene. What is not used is none.
    pub fn looks(
        &mut self,
        file: &Path,
        names: &[Option<&Name>],
        materials: &mut Vec<Material>,
        pictures: &mut Pictures,
        warnings: &mut Warnings,
    ) -> Vec<Look> {
        let mut known: HashMap<usize, Look> = HashMap::new();
        let mut look = |name: &Name| {
            let Some(index) = self.named(&name.text) else {
                // Blender names none for faces without material.
                if !name.text.is_empty() && !self.incomplete {
                    let statement = format!("usemtl {}", name.text);
                    let problem = "no such material in the libraries; drawn light grey";
                    warnings.add(file, name.line, &statement, problem, "");
                }
                return None;
            };
            let look = *known.entry(index).or_insert_with(|| {
                let definition = &self.definitions[index];
                let (material, pattern) = definition.drawn(&mut self.finder, pictures, warnings);
                materials.push(material);
                Look { material: materials.len() as u32 - 1, pattern, is_default: false }
            });
            Some(look)
        };
        let found: Vec<Option<Look>> = names.iter().map(|name| look((*name)?)).collect();
        let default = Look { material: materials.len() as u32, pattern: None, is_default: true };
        materials.push(Material::default());
        found.into_iter().chain([None]).map(|look| look.unwrap_or(default)).collect()
    }
}

impl Definition {
    fn statement(&mut self, statement: &Statement, warnings: &mut Warnings) {
        match statement.keyword.as_ref() {
            "kd" => set(&mut self.diffuse, colour(statement, warnings)),
            "ks" => set(&mut self.specular, colour(statement, warnings)),
            "ke" => set(&mut self.emission, colour(statement, warnings)),
            "ns" => set(&mut self.exponent, finite(statement, warnings)),
            "illum" => set(&mut self.illumination, finite(statement, warnings)),
            "d" => set(&mut self.dissolve, part(statement, warnings)),
            "tr" => {
                let part = part(statement, warnings).map(|part| (part, statement.line));
                set(&mut self.transparency, part);
            }
            word if word.starts_with("map_") || is_one_of(MAPS, word) => {
                if statement.rest.is_empty() {
                    statement.warn(warnings, "no picture is named; left out");
                } else if word == "map_kd" {
                    self.map = map(statement, warnings);
                } else if word == "map_d" {
                    statement.warn(warnings, "not drawn: opacity is that of the picture of map_Kd");
                }
            }
            word if is_one_of(SILENT, word) => {}
            _ => statement.warn(warnings, "no statement of MTL files; left out"),
        }
    }

    /// The material, and how its texture lies.
    fn drawn(
        &self,
        finder: &mut Finder,
        pictures: &mut Pictures,
        warnings: &mut Warnings,
    ) -> (Material, Option<Pattern>) {
        let folder = self.library.parent().unwrap_or(Path::new(""));
        let texture = self.map.as_ref().and_then(|map| {
            let mut warn = |problem, detail: &str| {
                warnings.add(&self.library, map.line, &map.statement, problem, detail);
            };
            let Some(path) = finder.find(folder, &map.name) else {
                warn("no such picture; drawn in the colour of Kd", "");
                return None;
            };
            match pictures.index(&path) {
                Ok((index, damage)) => {
                    if let Some(damage) = damage {
                        warn("the picture is damaged; drawn as far as it can be read", &damage);
                    }
                    Some((index, map.pattern))
                }
                Err(error) => {
                    warn("the picture cannot be used; drawn in the colour of Kd", &error);
                    None
                }
            }
        });
        let alpha = match (self.dissolve, self.transparency) {
            (Some(dissolve), _) => dissolve,
            (None, Some((1.0, line))) => {
                let problem = "taken for opaque, which programs mean by it; d 0 is invisible";
                warnings.add(&self.library, line, "Tr 1", problem, "");
                1.0
            }
            (None, Some((transparency, _))) => 1.0 - transparency,
            (None, None) => 1.0,
        };
        let diffuse = self.diffuse.unwrap_or([0.8; 3]);
        let illumination = self.illumination.unwrap_or(2.0);
        let exponent = self.exponent.unwrap_or(32.0);
        let specular = self.specular.filter(|_| illumination >= 2.0).unwrap_or_default();
        let specular = scale(specular, gloss(exponent));
        let material = Material {
            // Some programs write black and mean the texture alone.
            diffuse: if texture.is_some() && diffuse == [0.0; 3] { [1.0; 3] } else { diffuse },
            specular,
            exponent: exponent.clamp(1.0, 10_000.0).round() as u32,
            emission: self.emission.unwrap_or_default(),
            reflection: if illumination < 3.0 { [0.0; 3] } else { scale(specular, 0.5) },
            alpha,
            texture: texture.map(|(index, _)| index),
        };
        (material, texture.map(|(_, pattern)| pattern))
    }
}

/// Part of `Ks` that is left with an exponent of highlights. Programs write 0 with a bright `Ks` for what is rough;
/// a highlight of exponent 1 would cover and bleach it.
fn gloss(exponent: f64) -> f64 {
    ((exponent - 1.0) / 9.0).clamp(0.0, 1.0)
}

/// Replaces a value if there is a new one.
fn set<T>(old: &mut Option<T>, new: Option<T>) {
    *old = new.or(old.take());
}

/// One or three finite numbers, clamped to 0 to 1.
fn colour(statement: &Statement, warnings: &mut Warnings) -> Option<Vec3> {
    let numbers: Option<Vec<f64>> =
        statement.words().map(|word| number(word).filter(|n| n.is_finite())).collect();
    let colour = match numbers.as_deref() {
        Some(&[grey]) => [grey; 3],
        Some(&[red, green, blue, ..]) => [red, green, blue],
        _ => {
            statement.warn(warnings, "neither one nor three finite numbers; left out");
            return None;
        }
    };
    Some(colour.map(|n| n.clamp(0.0, 1.0)))
}

/// The last word as a finite number; `d` may have `-halo` before it.
fn finite(statement: &Statement, warnings: &mut Warnings) -> Option<f64> {
    let found = statement.words().last().and_then(number).filter(|n| n.is_finite());
    if found.is_none() {
        statement.warn(warnings, "no finite number; left out");
    }
    found
}

/// A number from 0 to 1.
fn part(statement: &Statement, warnings: &mut Warnings) -> Option<f64> {
    let found = finite(statement, warnings)?;
    if !(0.0..=1.0).contains(&found) {
        statement.warn(warnings, "not from 0 to 1; the nearer of these is used");
    }
    Some(found.clamp(0.0, 1.0))
}

/// Reads the options before a picture's name by the number of words that follow each.
fn map(statement: &Statement, warnings: &mut Warnings) -> Option<Map> {
    let mut rest = statement.rest;
    let mut pattern = Pattern { scale: [1.0; 2], offset: [0.0; 2] };
    while let Some((written, after)) = option(rest) {
        rest = after;
        let mut numbers = Vec::new();
        let option = written.to_ascii_lowercase();
        match option.as_str() {
            "-s" | "-o" | "-t" => {
                // One to three, but the name may be a number too.
                while let Some((value, after)) = next_number(rest).filter(|_| numbers.len() < 3) {
                    numbers.push(value);
                    rest = after;
                }
            }
            "-mm" => rest = skipped(rest, 2),
            _ => rest = skipped(rest, 1),
        }
        match (option.as_str(), &numbers[..]) {
            ("-s", &[u]) => pattern.scale = [u, 1.0],
            ("-s", &[u, v, ..]) => pattern.scale = [u, v],
            ("-o", &[u]) => pattern.offset = [u, 0.0],
            ("-o", &[u, v, ..]) => pattern.offset = [u, v],
            _ => {
                let Statement { file, line, text, .. } = *statement;
                warnings.add(file, line, text, "an option that is not followed", written);
            }
        }
    }
    if rest.is_empty() {
        statement.warn(warnings, "no picture is named; left out");
        return None;
    }
    let (line, text) = (statement.line, statement.text.to_string());
    Some(Map { line, statement: text, name: rest.into(), pattern })
}

/// The first word of a map statement and what follows it, if it is an option.
fn option(text: &str) -> Option<(&str, &str)> {
    let (word, rest) = text.split_once(char::is_whitespace)?;
    let named = word.strip_prefix('-').is_some_and(|name| name.starts_with(char::is_alphabetic));
    named.then_some((word, rest.trim_start()))
}

/// A finite number and what follows it, if something does.
fn next_number(text: &str) -> Option<(f64, &str)> {
    let (word, rest) = text.split_once(char::is_whitespace)?;
    Some((number(word).filter(|n| n.is_finite())?, rest.trim_start()))
}

/// The text after so many words, but the last word at least.
fn skipped(text: &str, words: usize) -> &str {
    (0..words).fold(text, |text, _| {
        text.split_once(char::is_whitespace).map_or(text, |(_, rest)| rest.trim_start())
    })
}
