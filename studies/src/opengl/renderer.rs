//! Views drawn with OpenGL, compared with direct rendering pixel by pixel.
//!
//! The renderer is Mesa's llvmpipe, off screen, with 8 subpixel bits. It is given the snapped
//! corners, so that what is compared is scan conversion, the top-left rule and the depth test.

use std::path::PathBuf;
use std::process::Command;
use thiserror::Error;
use wheatstone_golden::direct::Direct;
use wheatstone_golden::files::Scratch;
use wheatstone_golden::formats::{Eye, Formats, DEPTH_MAX, FRACTION_BITS};
use wheatstone_golden::frame::{Frame, NO_ID};
use wheatstone_golden::setup::{Attributes, Polygon};
use wheatstone_golden::texture::Lookup;
use wheatstone_process::{Process, ProcessError, KEPT};

/// Pixels drawn around the view, as many as the guard band has.
const MARGIN: u32 = 1024;
/// Depths that count as a tie, in units of the 24-bit depth.
const TIE: i64 = 2;

/// The reason why nothing was drawn.
#[derive(Debug, Error)]
pub enum OpenGlError {
    /// There is no C compiler.
    #[error("no C compiler: apt-get install gcc ({0})")]
    Compiler(std::io::Error),
    /// The library that draws off screen is not installed.
    #[error("OSMesa is missing: apt-get install libosmesa6-dev")]
    Library,
    /// The renderer did not start, or ended with an error.
    #[error("the OpenGL renderer failed: {0}")]
    Failed(String),
}

/// A program that draws with OpenGL. It is removed with its folder when it is dropped.
#[derive(Debug)]
pub struct Renderer {
    folder: Scratch,
    /// Number of threads that it may draw with; as many as there are processors where none is given.
    pub threads: Option<u32>,
}

/// A picture drawn with OpenGL.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// For each pixel the index of its triangle, [`NO_ID`] for the background.
    pub triangles: Vec<u32>,
    /// Seconds that clearing and drawing took, in the shortest of the rounds.
    pub seconds: f64,
    /// Name of the renderer.
    pub name: String,
}

impl Renderer {
    /// Compiles the program.
    pub fn build() -> Result<Renderer, OpenGlError> {
        let failed = |error: std::io::Error| OpenGlError::Failed(error.to_string());
        let folder = Scratch::new(&std::env::temp_dir()).map_err(failed)?;
        let source = folder.path().join("opengl_ids.c");
        std::fs::write(&source, include_str!("opengl_ids.c")).map_err(failed)?;
        let renderer = Renderer { folder, threads: None };
        let mut command = Command::new("cc");
        command.args(["-O2", "-Wall", "-o"]).args([&renderer.program(), &source]).arg("-lOSMesa");
        match Process::new("cc", &mut command).on("opengl_ids.c").run() {
            Ok(output) if output.succeeded() => Ok(renderer),
            Ok(_) => Err(OpenGlError::Library),
            Err(ProcessError::Start { source, .. }) => Err(OpenGlError::Compiler(source)),
            Err(error) => Err(OpenGlError::Failed(error.to_string())),
        }
    }

    fn program(&self) -> PathBuf {
        self.folder.path().join("opengl_ids")
    }

    /// Draws triangles, `rounds` times, into a view of this size: x and y in pixels from the top left,
    /// depth from 0 to 1.
    pub fn draw(
        &self,
        size: [u32; 2],
        triangles: &[[[f64; 3]; 3]],
        rounds: u32,
    ) -> Result<Drawn, OpenGlError> {
        let input: Vec<u8> =
            triangles.iter().flatten().flatten().flat_map(|&n| (n as f32).to_le_bytes()).collect();
        let mut command = Command::new(self.program());
        command.args([size[0], size[1], MARGIN, rounds].map(|n| n.to_string()));
        if let Some(threads) = self.threads {
            // llvmpipe's threads beside the one that calls it.
            command.env("LP_NUM_THREADS", threads.saturating_sub(1).to_string());
        }
        let [width, height] = size.map(|n| n as usize);
        let output = Process::new("the OpenGL renderer", &mut command)
            .on(format!("{width} x {height} pixels"))
            .input(input)
            // Half of it is the beginning: a word a pixel.
            .keep(KEPT + 2 * 4 * width * height)
            .run()
            .map_err(|error| OpenGlError::Failed(error.to_string()))?;
        let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
        let mut lines = said.lines().rev();
        let seconds = lines.next().and_then(|line| line.parse().ok());
        let (Some(seconds), true) = (seconds, output.status.success()) else {
            return Err(OpenGlError::Failed(said));
        };
        let words = output.stdout.chunks_exact(4);
        let words = words.map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        Ok(Drawn {
            triangles: words.map(|id| id.wrapping_sub(1)).collect(),
            seconds,
            name: lines.next().unwrap_or_default().to_owned(),
        })
    }
}

/// Polygons that an eye sees, as triangles for OpenGL, and the index of each one's polygon.
fn triangles(polygons: &[Polygon], eye: Eye, formats: &Formats) -> (Vec<[[f64; 3]; 3]>, Vec<u32>) {
    let (mut triangles, mut owner) = (Vec::new(), Vec::new());
    for (index, polygon) in (0..).zip(polygons) {
        if !polygon.eyes.contains(eye) {
            continue;
        }
        let corner = |n: usize| {
            let v = polygon.vertices[n];
            let one = formats.one_pixel() as f64;
            let [x, y] = [v.x, v.y].map(|c| f64::from(c[eye as usize]) / one);
            [x, y, f64::from(v.depth) / f64::from(DEPTH_MAX)]
        };
        for k in 1..polygon.vertices.len() - 1 {
            triangles.push([corner(0), corner(k), corner(k + 1)]);
            owner.push(index);
        }
    }
    (triangles, owner)
}

/// For each pixel the polygon whose triangle was drawn there, [`NO_ID`] for the background.
fn owners(drawn: &Drawn, owner: &[u32]) -> Vec<u32> {
    let owner = |&triangle: &u32| owner.get(triangle as usize).copied().unwrap_or(NO_ID);
    drawn.triangles.iter().map(owner).collect()
}

/// Differences between a view drawn directly and the same one drawn with OpenGL.
#[derive(Clone, Debug, Default)]
pub struct Differences {
    /// Pixels compared.
    pub pixels: usize,
    /// Pixels where another polygon is seen that has the same depth, but for [`TIE`] units.
    pub ties: usize,
    /// Pixels that differ otherwise.
    pub wrong: usize,
    /// The first of them, in words.
    pub first: Option<String>,
}

impl Differences {
    fn plus(self, other: Differences) -> Differences {
        Differences {
            pixels: self.pixels + other.pixels,
            ties: self.ties + other.ties,
            wrong: self.wrong + other.wrong,
            first: self.first.or(other.first),
        }
    }
}

/// Both views drawn directly and with OpenGL.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Differences, of both views together.
    pub differences: Differences,
    /// Seconds that OpenGL takes for both views.
    pub seconds: f64,
    /// Name of the renderer.
    pub name: String,
}

/// Draws both views of polygons directly and with OpenGL and compares them. OpenGL draws `rounds`
/// times.
pub fn compare_views(
    renderer: &Renderer,
    polygons: &[Polygon],
    size: [u32; 2],
    formats: &Formats,
    rounds: u32,
) -> Result<Comparison, OpenGlError> {
    // Ids are positions in the list.
    let polygons: Vec<Polygon> =
        (0..).zip(polygons).map(|(id, p)| Polygon { id, ..p.clone() }).collect();
    let direct = Direct { formats: *formats, textures: &[], lookup: Lookup::Nearest };
    let mut all =
        Comparison { differences: Differences::default(), seconds: 0.0, name: String::new() };
    for eye in Eye::BOTH {
        let mut frame = Frame::new(size[0], size[1], [0; 3]);
        polygons.iter().for_each(|polygon| direct.draw(polygon, eye, &mut frame));
        let (triangles, owner) = triangles(&polygons, eye, formats);
        let drawn = renderer.draw(size, &triangles, rounds)?;
        let found = compare(&frame, &owners(&drawn, &owner), &polygons, eye, formats);
        all.differences = all.differences.plus(found);
        all.seconds += drawn.seconds;
        all.name = drawn.name;
    }
    Ok(all)
}

/// Compares a view with what OpenGL drew. The ids of the frame are positions in `polygons`, as
/// those of `theirs` are, see [`owners`].
fn compare(
    frame: &Frame,
    theirs: &[u32],
    polygons: &[Polygon],
    eye: Eye,
    formats: &Formats,
) -> Differences {
    let depth = |id: u32, x: i64, y: i64| {
        let attributes = Attributes::new(&polygons[id as usize], eye, formats);
        (attributes.depth.at(x, y) >> FRACTION_BITS).clamp(0, DEPTH_MAX.into())
    };
    let mut found = Differences { pixels: frame.id.len(), ..Differences::default() };
    for (n, (&ours, &theirs)) in frame.id.iter().zip(theirs).enumerate() {
        if ours == theirs {
            continue;
        }
        let [x, y] = [n as i64 % i64::from(frame.width), n as i64 / i64::from(frame.width)];
        let covered = ours != NO_ID && theirs != NO_ID;
        let apart =
            if covered { (depth(theirs, x, y) - depth(ours, x, y)).abs() } else { i64::MAX };
        if apart <= TIE {
            found.ties += 1;
            continue;
        }
        found.wrong += 1;
        found.first.get_or_insert_with(|| {
            let eye = eye.name();
            format!("{eye} eye, ({x}, {y}): OpenGL shows {theirs}, direct rendering {ours}")
        });
    }
    found
}
