//! Height fields: a grid of heights as two flat-shaded triangles a cell, as a scanning tunnelling
//! microscope measures them (Duvanenko & Robbins 1993: `docs/errata.md` says where we differ).
//!
//! A grid of n × m heights has (n − 1)(m − 1) cells and twice as many triangles; the first of a
//! cell's two has its lower left corner, the second its upper right one. In a field's own,
//! right-handed coordinates x goes right along a row, y up from the last row to the first, and
//! height is z; neighbouring samples are one unit apart. The scene is
//!
//! - placed as [`super::rig_file`] says, seen from [`VIEW`] if it does not say from where;
//! - shaded with clamp(n·l, 0, 1) of white, n the normal of the triangle and l the direction to
//!   the light, without ambient light (section "Shading"; a rig file may change the light);
//! - looked at as by the authors: [`physical_rig`].

use super::error::{read, read_text, reading, InputError, SceneError, COORDINATE_LIMIT};
use super::light::{Light, Point, Source};
use super::place::{place, Placement, Viewpoint};
use super::rig::Rig;
use super::vector::{turn, unit, Vec3};
use super::{Colours, Lighting, Material, Mesh, Scene};
use crate::guard::guarded;
use crate::work::Real;
use std::path::Path;

/// Most heights in a row or column of a grid that is read.
pub const GRID_LIMIT: usize = 1024;
/// From where a field is seen: from the lower left, at about 38 degrees above its plane.
pub const VIEW: Viewpoint = Viewpoint { eye: [-0.45, -1.0, 0.85], up: [0.0, 0.0, 1.0] };
/// Longest side of a placed field, in smaller sides of the screen, where nothing else is said: it
/// lies, so that the screen's larger side holds it.
pub const FIT: f64 = 1.15;
/// Heights a side of [`atoms`], as of the authors' samples.
pub const ATOMS: usize = 200;

/// Distance between the eyes in inches ("Transforming Interocular Distance").
pub const EYE_SEPARATION: f64 = 2.5;
/// Distance from the eyes to the screen in inches.
pub const VIEWING_DISTANCE: f64 = 18.0;
/// Width of a dot of the authors' screen in inches.
pub const DOT_PITCH: f64 = 0.021;

/// The authors' viewer and screen, in inches: eyes [`EYE_SEPARATION`] apart and
/// [`VIEWING_DISTANCE`] from a screen of which 640 × 480 dots of [`DOT_PITCH`], or as many as fit,
/// fill views of this size.
pub fn physical_rig(width: u32, height: u32) -> Rig {
    let dots = (f64::from(width) / 640.0).min(f64::from(height) / 480.0);
    Rig {
        pixels_per_unit: dots / DOT_PITCH,
        eye_separation: EYE_SEPARATION,
        viewing_distance: VIEWING_DISTANCE,
        ..Rig::default()
    }
}

/// A grid of heights.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightGrid {
    columns: usize,
    heights: Vec<f64>,
}

/// Normals, not of unit length, of the two triangles of a cell (Listing Three). `heights` are
/// those of its upper left, lower left, lower right and upper right corner, `dx` is the distance
/// of neighbouring samples and `square` its square.
pub fn normals<T: Real>(dx: T, square: T, heights: [T; 4]) -> [[T; 3]; 2] {
    let [z11, z21, z22, z12] = heights;
    let [a, b, c] = [z21 - z11, z22 - z11, z12 - z11];
    [[dx * (a - b), dx * a, square], [-dx * c, dx * (b - c), square]]
}

impl HeightGrid {
    /// A grid of rows of this many columns, from the top; none if there are not at least two of
    /// each, all full, and at most [`GRID_LIMIT`], or a height is not finite or beyond 10^9.
    pub fn new(columns: usize, heights: Vec<f64>) -> Option<HeightGrid> {
        let sizes = 2..=GRID_LIMIT;
        let whole = sizes.contains(&columns)
            && heights.len().is_multiple_of(columns)
            && sizes.contains(&(heights.len() / columns));
        let legal = heights.iter().all(|h| h.abs() <= COORDINATE_LIMIT);
        (whole && legal).then_some(HeightGrid { columns, heights })
    }

    /// Heights in a row, and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.columns, self.heights.len() / self.columns]
    }

    /// The heights, row by row from the top.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Multiplies the heights so that the highest and the lowest differ by this part of the grid's
    /// longer side. A flat grid stays flat.
    pub fn stretched(&self, relief: f64) -> HeightGrid {
        let lowest = self.heights.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = self.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let [columns, rows] = self.size();
        let side = (columns.max(rows) - 1) as f64;
        let range = highest - lowest;
        let factor = if range > 0.0 { relief * side / range } else { 1.0 };
        let stretched = |h: f64| match factor.is_finite() {
            true => (h - lowest) * factor,
            // They are so close that the factor is beyond all doubles, but not its products.
            false => (h - lowest) / range * (relief * side),
        };
        let heights = self.heights.iter().map(|&h| stretched(h)).collect();
        HeightGrid { columns: self.columns, heights }
    }

    /// The two triangles of every cell, row by row.
    pub fn mesh(&self) -> Mesh {
        let [columns, rows] = self.size();
        let middle = [columns, rows].map(|n| (n - 1) as f64 / 2.0);
        // Scenes have z away from the viewer, whom heights point to.
        let point = |n: usize| {
            let [x, y] = [(n % columns) as f64 - middle[0], middle[1] - (n / columns) as f64];
            [x, y, -self.heights[n]]
        };
        let triangles = self.cells().flat_map(|corners| {
            let [upper_left, lower_left, lower_right, upper_right] = corners.map(|n| n as u32);
            [[upper_left, lower_left, lower_right], [upper_left, lower_right, upper_right]]
        });
        Mesh {
            positions: (0..self.heights.len()).map(point).collect(),
            triangles: triangles.collect(),
            ..Mesh::default()
        }
    }

    /// Unit normals of the triangles of [`HeightGrid::mesh`], on the side that heights point to.
    pub fn normals(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.cells().flat_map(|corners| {
            normals(1.0, 1.0, corners.map(|n| self.heights[n])).map(|normal| {
                let [x, y, z] = unit(normal);
                [x, y, -z]
            })
        })
    }

    /// Indices of the upper left, lower left, lower right and upper right height of every cell.
    pub fn cells(&self) -> impl Iterator<Item = [usize; 4]> {
        let [columns, rows] = self.size();
        let starts = (0..rows - 1)
            .flat_map(move |row| (0..columns - 1).map(move |column| row * columns + column));
        starts.map(move |n| [n, n + columns, n + columns + 1, n + 1])
    }
}

/// The scene that a field is put into: [`physical_rig`] and one white light.
pub fn empty_scene(width: u32, height: u32) -> Scene {
    let source = Source::Direction([-3.0, 4.0, -2.0]);
    let light = Light { source, colour: [1.0; 3] };
    Scene {
        width,
        height,
        rig: physical_rig(width, height),
        background: [24, 26, 32],
        lighting: Some(Lighting { ambient: [0.0; 3], lights: vec![light] }),
        ..Scene::default()
    }
}

/// Puts a field into a scene that has nothing yet, in whose light it is shaded once and for all:
/// clamp(n·l, 0, 1) for each light, and the ambient light.
pub fn scene(grid: &HeightGrid, mut scene: Scene, placement: &Placement) -> Scene {
    let placement = Placement {
        view: placement.view.or(Some(VIEW)),
        fit: placement.fit.or(Some(Some(FIT))),
        ..placement.clone()
    };
    let stretched = placement.relief.map(|relief| grid.stretched(relief));
    let grid = stretched.as_ref().unwrap_or(grid);
    // Lit here and not as other meshes are, because that would light a triangle whose back is seen
    // from behind.
    let light = scene.lighting.take().unwrap_or_default();
    let white = Material { diffuse: [1.0; 3], ..Material::default() };
    let colours = grid.normals().map(|normal| {
        let normal = placement.turn(normal);
        let point = Point { position: [0.0; 3], normal, base: white.diffuse };
        let [colour, _] = light.shade(&point, &white, &scene.environment, [[0.0, 0.0, -1.0]; 2]);
        colour.map(|n| n.clamp(0.0, 255.0).round() as u8)
    });
    let colours = Colours::Face(colours.collect());
    scene.meshes.push(Mesh { colours, ..grid.mesh() });
    scene.materials.push(white);
    place(&mut scene, &placement);
    scene
}

/// A made-up sample: atoms of a hexagonal lattice on two terraces, one atom missing, and a few
/// others on top.
pub fn atoms() -> HeightGrid {
    const LATTICE: f64 = 13.0;
    /// Column, row and height of what was added.
    const ADDED: [[f64; 3]; 5] = [
        [60.0, 52.0, 5.0],
        [71.0, 60.0, 5.0],
        [134.0, 96.0, 6.0],
        [52.0, 142.0, 4.0],
        [150.0, 154.0, -5.0],
    ];
    let height = |n: usize| {
        let [x, y] = [(n % ATOMS) as f64, (n / ATOMS) as f64];
        // Waves in three directions; their sum has its maxima on a hexagonal lattice.
        let waves = [0.0, 1.0, 2.0].map(|k| {
            let [across, up] = turn(k / 3.0 + 0.02);
            turn((x * across + y * up) / LATTICE)[0]
        });
        let terrace = ((x + 0.6 * y - 170.0) / 10.0).clamp(-1.0, 1.0);
        let step = 2.0 * terrace * (1.5 - 0.5 * terrace * terrace);
        let added = ADDED.map(|[column, row, height]| {
            let square = (x - column) * (x - column) + (y - row) * (y - row);
            height / ((1.0 + square / 60.0) * (1.0 + square / 60.0))
        });
        waves.iter().sum::<f64>() + step + added.iter().sum::<f64>()
    };
    HeightGrid { columns: ATOMS, heights: (0..ATOMS * ATOMS).map(height).collect() }
}

/// True if files with this ending hold height grids.
pub fn is_grid(extension: &str) -> bool {
    ["png", "txt", "grid"].contains(&extension)
}

/// Reads a grid: a grey PNG picture with 8 or 16 bits a pixel, or text with a row a line, its
/// numbers separated by blanks or commas; `#` begins a comment. The first row is the top one.
pub fn load(file: &Path) -> Result<HeightGrid, SceneError> {
    let _reading = reading(file);
    let picture = file.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if !picture {
        return Ok(read_grid(file, &read_text(file)?)?);
    }
    let bytes = read(file)?;
    let failed = |cause| InputError::new(file, None, "file", "an undamaged PNG picture", cause);
    Ok(guarded(|| read_png(file, &bytes)).map_err(failed)??)
}

/// Reads a PNG picture; `file` is its name in messages.
pub fn read_png(file: &Path, bytes: &[u8]) -> Result<HeightGrid, InputError> {
    const BEGINNING: &[u8] = b"\x89PNG\r\n\x1a\n";
    let wrong = |field: &str, expected: &str, found: String| {
        InputError::new(file, None, field, expected, found)
    };
    let cut = || wrong("file", "a whole PNG picture", format!("the first {} bytes", bytes.len()));
    if bytes.is_empty() || !bytes.starts_with(&BEGINNING[..bytes.len().min(BEGINNING.len())]) {
        let found = if bytes.is_empty() { "nothing" } else { "something else" };
        return Err(wrong("file", "a PNG picture", found.into()));
    }
    let damaged = |error: png::DecodingError| match error {
        png::DecodingError::IoError(_) => cut(),
        error => wrong("file", "an undamaged PNG picture", chunk_by_name(&error.to_string())),
    };
    let size = header(bytes);
    size.map_or(Ok(()), |[columns, rows]| check_size(file, columns, rows))?;
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().map_err(damaged)?;
    let (kind, depth) = reader.output_color_type();
    let wide = depth == png::BitDepth::Sixteen;
    if kind != png::ColorType::Grayscale {
        let found = format!("{} of {} bits", in_words(kind), depth as u8);
        return Err(wrong("colour type", "grey, of 8 or 16 bits", found));
    }
    if !(wide || depth == png::BitDepth::Eight) {
        return Err(wrong("bit depth", "8 or 16 bits", (depth as u8).to_string()));
    }
    let [columns, rows] = [reader.info().width, reader.info().height].map(|n| n as usize);
    let mut pixels = vec![0; columns * rows * if wide { 2 } else { 1 }];
    reader.next_frame(&mut pixels).map_err(damaged)?;
    reader.finish().map_err(damaged)?;
    let heights = if wide {
        pixels.chunks_exact(2).map(|n| f64::from(u16::from_be_bytes([n[0], n[1]]))).collect()
    } else {
        pixels.iter().map(|&n| f64::from(n)).collect()
    };
    Ok(HeightGrid { columns, heights })
}

/// Columns and rows that a PNG picture says in its header, if that comes first, as it must.
fn header(bytes: &[u8]) -> Option<[usize; 2]> {
    let size =
        |at: usize| Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?) as usize);
    (bytes.get(12..16)? == b"IHDR").then_some([size(16)?, size(20)?])
}

/// A decoder's message with just the name of a chunk where it shows all its attributes.
fn chunk_by_name(message: &str) -> String {
    let parts = message.split_once("ChunkType { type: ").and_then(|(before, chunk)| {
        let (chunk, after) = chunk.split_once(" }")?;
        Some(format!("{before}{}{after}", chunk.split(',').next()?))
    });
    parts.as_deref().unwrap_or(message).trim_end_matches('.').into()
}

fn in_words(kind: png::ColorType) -> &'static str {
    match kind {
        png::ColorType::Grayscale => "grey",
        png::ColorType::GrayscaleAlpha => "grey with transparency",
        png::ColorType::Rgb => "red, green and blue",
        png::ColorType::Rgba => "red, green and blue with transparency",
        png::ColorType::Indexed => "a palette",
    }
}

/// Reads text; `file` is its name in messages.
pub fn read_grid(file: &Path, text: &str) -> Result<HeightGrid, InputError> {
    let mut heights = Vec::new();
    // Number of columns, and the line that said so.
    let mut first = None;
    let mut rows = 0;
    for (line, content) in rows_of(text) {
        let before = heights.len();
        for (n, word) in words(content).enumerate() {
            let height: Option<f64> = word.parse().ok();
            heights.push(height.filter(|h| h.abs() <= COORDINATE_LIMIT).ok_or_else(|| {
                let expected = "a height, a finite number of at most 1e9";
                let found = if word.is_empty() { "nothing" } else { word };
                InputError::new(file, line, format!("column {}", n + 1), expected, found)
            })?);
        }
        rows += 1;
        let count = heights.len() - before;
        let (columns, at) = *first.get_or_insert((count, line));
        if count != columns {
            let expected = format!("{columns} heights, as in line {at}");
            let field = format!("row {rows}");
            return Err(InputError::new(file, line, field, expected, count.to_string()));
        }
        if columns.max(rows) > GRID_LIMIT {
            // The rest is not read, but counted.
            check_size(file, columns, rows_of(text).count())?;
        }
    }
    let columns = first.map_or(0, |(columns, _)| columns);
    check_size(file, columns, rows)?;
    Ok(HeightGrid { columns, heights })
}

/// Lines that hold heights, with their numbers, without comments.
fn rows_of(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = (1..).zip(text.lines());
    let lines = lines.map(|(n, line)| (n, line.split('#').next().unwrap_or_default().trim()));
    lines.filter(|(_, content)| !content.is_empty())
}

/// The numbers of a line: between commas if there are any, else between blanks.
fn words(line: &str) -> impl Iterator<Item = &str> {
    let commas = line.contains(',');
    line.split(move |c: char| if commas { c == ',' } else { c.is_whitespace() })
        .map(str::trim)
        .filter(move |word| commas || !word.is_empty())
}

fn check_size(file: &Path, columns: usize, rows: usize) -> Result<(), InputError> {
    let sizes = 2..=GRID_LIMIT;
    if sizes.contains(&columns) && sizes.contains(&rows) {
        return Ok(());
    }
    let expected = format!("2 to {GRID_LIMIT} columns and rows");
    Err(InputError::new(file, None, "grid", expected, format!("{columns} x {rows}")))
}
