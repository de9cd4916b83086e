//! Errors of scenes, and their places.

use super::locate::Locator;
use crate::files::{self, ReadError};
use crate::progress::Stage;
use crate::projection::shown;
pub use crate::projection::{RigError, COORDINATE_LIMIT};
use crate::text::{self, printable, printable_path, TextError};
use std::fmt;
use std::path::{Path, PathBuf};

/// Largest width and height of a view that any configuration draws, in pixels.
pub const SIZE_LIMIT: u32 = 2048;
/// Most triangles and faces of a scene: id pictures hold one more than an id in 24 bits.
pub const ID_LIMIT: usize = (1 << 24) - 1;
/// Most corners of polygons and points of lines in a file, so that what is made of them has room in 2 GB, whatever
/// attributes they have.
pub const CORNER_LIMIT: usize = 4_000_000;
/// Most lines of a file or a wire frame: one takes a kilobyte.
pub const LINE_LIMIT: usize = 1 << 20;
/// Largest file of a scene, in bytes: some ten times what the largest mesh takes that is drawn in
/// reasonable time.
pub const FILE_LIMIT: u64 = 256 << 20;

/// A wrong value in an input file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{}: {field}: expected {expected}, found {found}", printable_path(.file), Line(*.line))]
pub struct InputError {
    /// The file.
    pub file: PathBuf,
    /// Line in the file, from 1, where it is known.
    pub line: Option<usize>,
    /// The value's name, in the file's own words.
    pub field: String,
    /// The allowed values.
    pub expected: String,
    /// The value found.
    pub found: String,
}

struct Line(Option<usize>);

impl fmt::Display for Line {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |line| write!(f, ":{line}"))
    }
}

impl InputError {
    /// An error at a line of a file.
    pub fn new(
        file: &Path,
        line: impl Into<Option<usize>>,
        field: impl Into<String>,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> InputError {
        InputError {
            file: file.to_owned(),
            line: line.into(),
            field: printable(&field.into()),
            expected: printable(&expected.into()),
            found: printable(&found.into()),
        }
    }
}

impl RigError {
    /// The error at its field in a JSON file of this text.
    pub(super) fn within(&self, file: &Path, text: &str) -> InputError {
        let line = Locator::new(text).line_of(&self.field);
        InputError::new(file, line, &self.field, &self.expected, shown(self.found))
    }
}

/// The reason why there is no scene, or nothing to draw of it.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// A value in a file is wrong.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A file cannot be read.
    #[error("{}: cannot be read: {source}", printable_path(.file))]
    Read {
        /// The file.
        file: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// Neither a built-in scene nor a file of a known kind.
    #[error("scene {}: expected a file ending in .obj, .json, .png, .txt or .grid, or one of: {}", printable(.name), .builtin.join(", "))]
    Unknown {
        /// The name that was asked for.
        name: String,
        /// Names of the built-in scenes.
        builtin: Vec<&'static str>,
    },
    /// The views are empty or larger than the configuration allows.
    #[error("size {width}x{height}: expected 1x1 to {limit}x{limit} pixels; give another --size, or another width and height in the rig or scene file")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest width and height.
        limit: u32,
    },
    /// A value of the rig makes no sense.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A wire frame has too many lines.
    #[error("cannot draw the wire frame: the scene has more than {LINE_LIMIT} edges; try a mesh with fewer faces")]
    Edges,
    /// A scene made in code contradicts itself.
    #[error("mesh {mesh}: {field}: {problem}")]
    Mesh {
        /// Index of the mesh.
        mesh: usize,
        /// The part that is wrong.
        field: &'static str,
        /// The fault.
        problem: String,
    },
}

/// Refuses views that are empty or larger than `limit`.
pub fn check_size(width: u32, height: u32, limit: u32) -> Result<(), SceneError> {
    if width == 0 || height == 0 || width > limit || height > limit {
        return Err(SceneError::Size { width, height, limit });
    }
    Ok(())
}

/// The bytes of a file of at most [`FILE_LIMIT`] bytes.
pub fn read(file: &Path) -> Result<Vec<u8>, SceneError> {
    let _reading = reading(file);
    files::read(file, FILE_LIMIT)
        .map_err(|ReadError { file, source }| SceneError::Read { file, source })
}

/// Notes that a file is read, until this is dropped.
pub(super) fn reading(file: &Path) -> Stage {
    Stage::new(format!("reading {}", printable_path(file)))
}

/// The text of a file in UTF-8.
pub fn read_text(file: &Path) -> Result<String, SceneError> {
    Ok(text::decode(&read(file)?).map_err(|error| no_text(file, error))?)
}

/// A file that holds no text.
pub(super) fn no_text(file: &Path, error: TextError) -> InputError {
    InputError::new(file, error.line(), "file", "UTF-8 text", error.to_string())
}
