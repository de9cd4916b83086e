//! Reads the statements of an OBJ file.

use super::super::cut::Crossing;
use super::super::error::{InputError, SceneError, COORDINATE_LIMIT, CORNER_LIMIT, LINE_LIMIT};
use super::super::vector::{unit, Vec3};
use super::super::warning::Warnings;
use super::statement::{each, is_one_of, Statement};
use crate::text::{printable, printable_within};
use std::collections::HashMap;
use std::num::{IntErrorKind, ParseIntError};
use std::path::Path;

/// Statements that are known to change nothing that is drawn here.
const SILENT: &str =
    "g o s mg vp deg bmat step cstype parm trim hole scrv sp end con bevel c_interp d_interp lod \
    shadow_obj trace_obj ctech t vw";

/// Statements that draw what is not drawn here, or bring it from elsewhere.
const NOT_DRAWN: &str = "p curv curv2 surf stech call csh usemap maplib bzp bsp cdc cdp res";

/// No material, texture point or normal.
pub const NONE: u32 = u32::MAX;
/// The index of what no file has.
const AWAY: u32 = u32::MAX - 1;

/// A corner of a face or a point of a line: indices of [`Parsed`], from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Vertex.
    pub vertex: u32,
    /// Texture point and normal, or [`NONE`].
    pub attributes: [u32; 2],
}

/// A face or a line: some corners in a row.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Line of the file, from 1.
    pub line: usize,
    /// Its first corner.
    pub first: usize,
    /// Corners, at least 3 of a face and 2 of a line.
    pub count: usize,
    /// Index of its material's name, or [`NONE`].
    pub material: u32,
}

/// A name and the line where it comes first.
#[derive(Clone, Debug)]
pub struct Name {
    /// Line of the file, from 1.
    pub line: usize,
    /// The name as it stands there.
    pub text: String,
}

/// An OBJ file.
#[derive(Debug, Default)]
pub struct Parsed {
    /// Vertices, left-handed: z is turned round.
    pub positions: Vec<Vec3>,
    /// Colours of the vertices; empty if none has one.
    pub colours: Vec<Option<[u8; 3]>>,
    /// Texture points; v goes upward. None where the file has no finite ones.
    pub texture: Vec<Option<[f64; 2]>>,
    /// Unit normals, left-handed. None where the file has no direction.
    pub normals: Vec<Option<Vec3>>,
    /// Corners of faces and lines.
    pub corners: Vec<Corner>,
    /// Faces in the order of the file.
    pub faces: Vec<Element>,
    /// Lines in the order of the file.
    pub lines: Vec<Element>,
    /// Libraries, each once.
    pub libraries: Vec<Name>,
    /// Materials that are chosen, each once.
    pub materials: Vec<Name>,
}

impl Parsed {
    /// The names of the materials, in place of those that no face and no line has none.
    pub fn used(&self) -> Vec<Option<&Name>> {
        let mut used = vec![None; self.materials.len()];
        let elements = self.faces.iter().chain(&self.lines);
        for element in elements.filter(|element| element.material != NONE) {
            let index = element.material as usize;
            used[index] = Some(&self.materials[index]);
        }
        used
    }

    /// Adds a corner where the edge between two others is crossed.
    pub fn cross(&mut self, crossing: &Crossing, ends: [Corner; 2]) {
        fn both<T: Copy>(all: &[Option<T>], ends: [u32; 2]) -> Option<[T; 2]> {
            let [from, to] = ends.map(|k| all.get(k as usize).copied().flatten());
            Some([from?, to?])
        }
        let vertices = ends.map(|corner| corner.vertex);
        let position = crossing.between(vertices.map(|k| self.positions[k as usize]));
        if !self.colours.is_empty() {
            let mix = |ends: [[u8; 3]; 2]| {
                crossing.between(ends.map(|c| c.map(f64::from))).map(|n| n.round_ties_even() as u8)
            };
            self.colours.push(both(&self.colours, vertices).map(mix));
        }
        let [points, normals] = [0, 1].map(|kind| ends.map(|corner| corner.attributes[kind]));
        let mut attributes = [NONE; 2];
        if points[0] != NONE {
            attributes[0] = self.texture.len() as u32;
            let ends = both(&self.texture, points);
            self.texture.push(ends.map(|ends| crossing.between(ends)));
        }
        if normals[0] != NONE {
            attributes[1] = self.normals.len() as u32;
            let ends = both(&self.normals, normals);
            let normal = ends.map(|ends| unit(crossing.between(ends)));
            self.normals.push(normal.filter(|n| *n != [0.0; 3]));
        }
        self.corners.push(Corner { vertex: self.positions.len() as u32, attributes });
        self.positions.push(position);
    }

    /// The corners of a face or a line.
    pub fn corners(&self, element: &Element) -> &[Corner] {
        &self.corners[element.first..element.first + element.count]
    }
}

/// Reads an OBJ file's text.
pub fn parse(file: &Path, text: &str, warnings: &mut Warnings) -> Result<Parsed, SceneError> {
    let (parsed, known) = Default::default();
    let mut reader = Reader {
        file,
        warnings,
        parsed,
        material: NONE,
        known,
        segments: 0,
        short: None,
        odd: None,
    };
    each(file, text, |statement| reader.statement(statement))?;
    reader.finish()
}

/// Said of indices that the file has not.
const NOT_THERE: [&str; 2] = [
    "no such texture point in the file; drawn without texture",
    "no such normal in the file; drawn without normals",
];
/// Said of faces of which some corners have what the others lack.
const MIXED: [&str; 2] = [
    "texture points at some corners alone; drawn without texture",
    "normals at some corners alone; drawn without them",
];

/// Takes the texture points (0) or normals (1) from all corners of a face if some have none, or
/// one beyond the `count` of the file; returns what to say of it.
fn settle(corners: &mut [Corner], kind: usize, count: usize) -> Option<&'static str> {
    let indices = || corners.iter().map(|corner| corner.attributes[kind]);
    let away = |index: u32| index != NONE && index as usize >= count;
    let problem = if indices().any(away) { NOT_THERE[kind] } else { MIXED[kind] };
    let lacking = indices().filter(|&index| index == NONE || away(index)).count();
    if lacking > 0 {
        corners.iter_mut().for_each(|corner| corner.attributes[kind] = NONE);
    }
    (lacking > 0 && (lacking < corners.len() || problem == NOT_THERE[kind])).then_some(problem)
}

/// Index of the name in a statement among those known so far.
fn intern(known: &mut HashMap<String, u32>, names: &mut Vec<Name>, statement: &Statement) -> u32 {
    if let Some(&index) = known.get(statement.rest) {
        return index;
    }
    let index = names.len() as u32;
    known.insert(statement.rest.into(), index);
    names.push(Name { line: statement.line, text: statement.rest.into() });
    index
}

struct Reader<'a> {
    file: &'a Path,
    warnings: &'a mut Warnings,
    parsed: Parsed,
    /// Index of the material that is chosen, or [`NONE`].
    material: u32,
    /// Indices of names of materials and libraries.
    known: [HashMap<String, u32>; 2],
    /// Straight pieces of lines so far.
    segments: usize,
    /// The first face or line with too few points to be drawn.
    short: Option<Short>,
    /// Line and first word of the first statement that is none of OBJ files.
    odd: Option<(usize, String)>,
}

/// True if what is no 64-bit number is one of more bits.
fn is_overflow(error: &ParseIntError) -> bool {
    matches!(error.kind(), IntErrorKind::PosOverflow | IntErrorKind::NegOverflow)
}

/// A statement with too few points to be drawn.
struct Short {
    line: usize,
    keyword: &'static str,
    least: &'static str,
    found: usize,
}

impl Reader<'_> {
    fn statement(&mut self, statement: &Statement) -> Result<(), SceneError> {
        match statement.keyword.as_ref() {
            "v" => self.vertex(statement)?,
            "vt" => self.texture_point(statement)?,
            "vn" => self.normal(statement)?,
            // `fo` is what faces were called at first.
            "f" | "fo" => self.face(statement)?,
            "l" => self.line(statement)?,
            "usemtl" => {
                self.material = intern(&mut self.known[0], &mut self.parsed.materials, statement);
            }
            "mtllib" if statement.rest.is_empty() => {
                statement.warn(self.warnings, "no library is named");
            }
            "mtllib" => {
                intern(&mut self.known[1], &mut self.parsed.libraries, statement);
            }
            word if is_one_of(SILENT, word) => {}
            word if is_one_of(NOT_DRAWN, word) => {
                statement.warn(self.warnings, "not drawn: points, curves, surfaces, other files");
            }
            word => {
                let odd = || (statement.line, printable_within(word, 40));
                self.odd.get_or_insert_with(odd);
                statement.warn(self.warnings, "no statement of OBJ files; left out");
            }
        }
        Ok(())
    }

    fn vertex(&mut self, statement: &Statement) -> Result<(), InputError> {
        let numbers = statement.numbers(3)?;
        let legal = |n: &f64| n.abs() <= COORDINATE_LIMIT;
        if let Some(at) = numbers[..3].iter().position(|n| !legal(n)) {
            let expected = format!("finite coordinates of at most {COORDINATE_LIMIT:e}");
            return Err(statement.wrong(expected, statement.words().nth(at).unwrap_or_default()));
        }
        let mut position = [numbers[0], numbers[1], -numbers[2]];
        match numbers.len() {
            3 => {}
            4 => {
                let divided = position.map(|n| n / numbers[3]);
                if divided.iter().all(legal) {
                    position = divided;
                } else {
                    statement.warn(self.warnings, "w makes the place infinite; w is ignored");
                }
            }
            // A seventh is opacity, which materials have alone.
            6 | 7 if numbers[3..6].iter().all(|n| n.is_finite()) => {
                let byte = |k: usize| (numbers[k].clamp(0.0, 1.0) * 255.0).round_ties_even() as u8;
                self.parsed.colours.resize(self.parsed.positions.len(), None);
                self.parsed.colours.push(Some([3, 4, 5].map(byte)));
            }
            6 | 7 => statement.warn(self.warnings, "the colour is not finite; left out"),
            _ => statement.warn(self.warnings, "neither 3, 4, 6 nor 7 numbers; the first 3 count"),
        }
        self.parsed.positions.push(position);
        Ok(())
    }

    fn texture_point(&mut self, statement: &Statement) -> Result<(), InputError> {
        let numbers = statement.numbers(1)?;
        let point = [numbers[0], numbers.get(1).copied().unwrap_or(0.0)];
        let finite = point.iter().all(|n| n.is_finite());
        if !finite {
            statement.warn(self.warnings, "not finite; faces with it are drawn without texture");
        }
        self.parsed.texture.push(finite.then_some(point));
        Ok(())
    }

    fn normal(&mut self, statement: &Statement) -> Result<(), InputError> {
        let numbers = statement.numbers(3)?;
        let normal = [numbers[0], numbers[1], -numbers[2]];
        let finite = normal.iter().all(|n| n.is_finite());
        if !finite {
            statement.warn(self.warnings, "not finite; the face's own normal is used");
        }
        self.parsed.normals.push(Some(unit(normal)).filter(|_| finite && normal != [0.0; 3]));
        Ok(())
    }

    fn face(&mut self, statement: &Statement) -> Result<(), InputError> {
        let element = self.element(statement)?;
        if element.count < 3 {
            self.too_short(&element, "f", "at least three corners");
            statement.warn(self.warnings, "fewer than three corners; not drawn");
            return Ok(());
        }
        self.parsed.faces.push(element);
        Ok(())
    }

    fn line(&mut self, statement: &Statement) -> Result<(), InputError> {
        let element = self.element(statement)?;
        if element.count < 2 {
            self.too_short(&element, "l", "at least two points");
            statement.warn(self.warnings, "fewer than two points; not drawn");
            return Ok(());
        }
        self.segments += element.count - 1;
        if self.segments > LINE_LIMIT {
            let expected = format!("at most {LINE_LIMIT} straight pieces of lines");
            return Err(statement.wrong(expected, "more; cut the file in two"));
        }
        self.parsed.lines.push(element);
        Ok(())
    }

    /// Leaves out a face or a line.
    fn too_short(&mut self, element: &Element, keyword: &'static str, least: &'static str) {
        self.parsed.corners.truncate(element.first);
        let short = Short { line: element.line, keyword, least, found: element.count };
        self.short.get_or_insert(short);
    }

    /// Reads corners; whether the file has them shows at its end.
    fn element(&mut self, statement: &Statement) -> Result<Element, InputError> {
        let first = self.parsed.corners.len();
        for word in statement.words() {
            let mut parts = word.split('/');
            let mut index = |kind| match parts.next() {
                None | Some("") => Ok(NONE),
                Some(part) => self.index(statement, part, kind),
            };
            let [vertex, attributes @ ..] = [index(0)?, index(1)?, index(2)?];
            if parts.next().is_some() {
                return Err(statement.wrong("vertex/texture/normal", word));
            }
            if vertex == NONE {
                return Err(statement.wrong("the index of a vertex", word));
            }
            if self.parsed.corners.len() == CORNER_LIMIT {
                let expected =
                    format!("at most {CORNER_LIMIT} corners of faces and points of lines");
                return Err(statement.wrong(expected, "more; cut the file in two"));
            }
            self.parsed.corners.push(Corner { vertex, attributes });
        }
        let count = self.parsed.corners.len() - first;
        Ok(Element { line: statement.line, first, count, material: self.material })
    }

    /// Index, from 0, of a vertex (0), texture point (1) or normal (2); it may be beyond the last.
    fn index(&self, statement: &Statement, part: &str, kind: usize) -> Result<u32, InputError> {
        let parsed = &self.parsed;
        let count = [parsed.positions.len(), parsed.texture.len(), parsed.normals.len()][kind];
        let absolute = match part.parse::<i64>() {
            Ok(n) if n < 0 => (count as i64).saturating_add(n),
            Ok(n) => n - 1,
            // Larger than any.
            Err(error) if is_overflow(&error) => i64::MAX,
            Err(_) => return Err(statement.wrong("whole numbers as indices", part)),
        };
        match u32::try_from(absolute).ok().filter(|&index| index < AWAY) {
            Some(index) => Ok(index),
            None if kind == 0 => {
                let expected = format!("an index of the {count} vertices so far");
                let large = if absolute < i64::from(AWAY) { "" } else { ", which is too large" };
                Err(statement.wrong(expected, format!("{}{large}", printable(part))))
            }
            None => Ok(AWAY),
        }
    }

    /// Checks what corners refer to.
    fn finish(mut self) -> Result<Parsed, SceneError> {
        let parsed = &mut self.parsed;
        if !parsed.colours.is_empty() {
            parsed.colours.resize(parsed.positions.len(), None);
        }
        let count = parsed.positions.len();
        let counts = [parsed.texture.len(), parsed.normals.len()];
        for (field, elements) in [("f", &parsed.faces), ("l", &parsed.lines)] {
            for element in elements {
                let corners = &mut parsed.corners[element.first..element.first + element.count];
                if let Some(far) = corners.iter().find(|c| c.vertex as usize >= count) {
                    let expected = format!("an index of the {count} vertices");
                    let found = (u64::from(far.vertex) + 1).to_string();
                    return Err(
                        InputError::new(self.file, element.line, field, expected, found).into()
                    );
                }
                for kind in [0, 1] {
                    if let Some(problem) = settle(corners, kind, counts[kind]) {
                        self.warnings.add(self.file, element.line, field, problem, "");
                    }
                }
            }
        }
        if self.parsed.faces.is_empty() && self.parsed.lines.is_empty() {
            if let Some(Short { line, keyword, least, found }) = self.short {
                let found = format!("{found}, and the file has nothing else to draw");
                return Err(InputError::new(self.file, line, keyword, least, found).into());
            }
            let found = match count {
                0 => "neither vertices nor faces".into(),
                _ => format!("{count} vertices and no face of three corners; points are not drawn"),
            };
            let error = match self.odd {
                Some((line, word)) => {
                    let found = format!("another word, and in the whole file {found}");
                    InputError::new(self.file, line, word, "a statement of OBJ files", found)
                }
                None => InputError::new(self.file, None, "f", "at least one face", found),
            };
            return Err(error.into());
        }
        Ok(self.parsed)
    }
}
