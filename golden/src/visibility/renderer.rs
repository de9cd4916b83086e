//! A simple renderer, for one view or for both at once: illumination, perspective projection,
//! back-face removal, scan-line hidden surfaces and Gouraud shading.
//!
//! Adelson et al. 1991, "Performance of a Simple Stereo Renderer". For one view all of it is done
//! for that view. For both at once vertices are lit once; of their projections, 1 + z/d, y and
//! depth are computed once; edges are put into one list, and depth and colour along them are
//! computed once.

use super::scan_line::{self, Line, Seen};
use super::Items;
use crate::formats::{Eye, Formats, Rgba, DEPTH_MAX};
use crate::picture::{Rgb, RgbImage};
use crate::projection::Projection;
use crate::scene::light::Point;
use crate::scene::vector::Vec3;
use crate::scene::{Colours, Cull, Lighting, Material, Options, Rig, Scene, SceneError};
use crate::setup::Vertex;
use crate::work::{Meter, Real};
use thiserror::Error;

/// The reason why a scene is not for this renderer.
#[derive(Debug, Error)]
pub enum RendererError {
    /// The eyes are not two centres of projection.
    #[error("the simple renderer draws the projection two-centres only, found {0}")]
    Projection(&'static str),
    /// The scene cannot be drawn at all.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A mesh has what the renderer does not know.
    #[error("mesh {mesh}: expected triangles of a dull, opaque material without texture")]
    Mesh {
        /// Its position in the scene.
        mesh: usize,
    },
    /// Without light there is nothing to shade.
    #[error("the scene has no light")]
    Dark,
    /// The views would not share their rows.
    #[error("head_tilt: expected 0, found {0}")]
    Tilted(f64),
    /// Something would have to be clipped.
    #[error("{0} triangles leave the guard band, or the space between near and far plane")]
    Outside(usize),
}

/// A scene as the renderer takes it.
#[derive(Clone, Debug)]
pub struct Model {
    points: Vec<Point>,
    /// Material of each point.
    materials: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    palette: Vec<Material>,
    lighting: Lighting,
    rig: Rig,
    size: [u32; 2],
    background: u32,
    formats: Formats,
}

/// Output of the renderer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Views<const EYES: usize> {
    /// The triangle that each pixel shows.
    pub items: [Items; EYES],
    /// Colours, row by row from the top: red << 16 | green << 8 | blue.
    pub colours: [Vec<u32>; EYES],
}

impl<const EYES: usize> Views<EYES> {
    /// The picture of a view.
    pub fn picture(&self, view: usize) -> RgbImage {
        let Items { width, height, .. } = self.items[view];
        RgbImage::from_fn(width, height, |x, y| {
            let [_, r, g, b] = self.colours[view][(y * width + x) as usize].to_be_bytes();
            Rgb([r, g, b])
        })
    }
}

impl Model {
    /// A model of a scene of dull, opaque triangles that need no clipping.
    pub fn new(scene: &Scene, formats: &Formats) -> Result<Model, RendererError> {
        let options = Options { cull: Cull::Back, ..Options::default() };
        let counts = scene.geometry(formats, &options)?.counts;
        if scene.rig.projection != Projection::TwoCentres {
            return Err(RendererError::Projection(scene.rig.projection.kind().name()));
        }
        if scene.rig.head_tilt != 0.0 {
            return Err(RendererError::Tilted(scene.rig.head_tilt));
        }
        if counts.clipped + counts.guard_band > 0 {
            return Err(RendererError::Outside(counts.clipped + counts.guard_band));
        }
        let [r, g, b] = scene.background;
        let mut model = Model {
            points: Vec::new(),
            materials: Vec::new(),
            triangles: Vec::new(),
            palette: scene.materials.clone(),
            lighting: scene.lighting.clone().ok_or(RendererError::Dark)?,
            rig: scene.rig.clone(),
            size: [scene.width, scene.height],
            background: u32::from_be_bytes([0, r, g, b]),
            formats: *formats,
        };
        for (number, mesh) in scene.meshes.iter().enumerate() {
            let material = &scene.materials[mesh.material as usize];
            let Material { specular, reflection, alpha, texture, .. } = material;
            let dull = [*specular, *reflection] == [[0.0; 3]; 2] && *alpha == 1.0;
            let base: Box<dyn Fn(usize) -> Vec3> = match &mesh.colours {
                Colours::Material => Box::new(|_| material.diffuse),
                Colours::Vertex(colours) => {
                    Box::new(|n| colours[n].map(|channel| f64::from(channel) / 255.0))
                }
                Colours::Face(_) => return Err(RendererError::Mesh { mesh: number }),
            };
            if !dull || texture.is_some() || !mesh.faces.is_empty() || mesh.lines {
                return Err(RendererError::Mesh { mesh: number });
            }
            let first = model.points.len() as u32;
            model.points.extend((0..mesh.positions.len()).map(|n| Point {
                position: mesh.positions[n],
                normal: mesh.normals[n],
                base: base(n),
            }));
            model.materials.resize(model.points.len(), mesh.material);
            model.triangles.extend(mesh.triangles.iter().map(|t| t.map(|n| n + first)));
        }
        Ok(model)
    }

    /// Empty views.
    pub fn views<const EYES: usize>(&self) -> Views<EYES> {
        let [width, height] = self.size;
        let colours = vec![self.background; width as usize * height as usize];
        Views {
            items: [(); EYES].map(|()| Items::new(width, height)),
            colours: [(); EYES].map(|()| colours.clone()),
        }
    }

    /// Triangles.
    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// Draws what some eyes see.
    pub fn draw<T: Real, const EYES: usize>(
        &self,
        eyes: [Eye; EYES],
        views: &mut Views<EYES>,
        meter: &mut impl Meter,
    ) {
        let vertices = self.vertices::<T, EYES>(eyes);
        self.scan::<T, EYES>(eyes, &vertices, views, meter);
    }

    /// The corners of the triangles, lit, as some eyes see them.
    pub fn vertices<T: Real, const EYES: usize>(&self, eyes: [Eye; EYES]) -> Vec<Vertex> {
        let vertex = |n| Vertex { colour: [self.light(n); 2], ..self.project::<T, EYES>(n, eyes) };
        (0..self.points.len()).map(vertex).collect()
    }

    /// Removes back faces and hidden surfaces, and shades what is left.
    pub fn scan<T: Real, const EYES: usize>(
        &self,
        eyes: [Eye; EYES],
        vertices: &[Vertex],
        views: &mut Views<EYES>,
        meter: &mut impl Meter,
    ) {
        let triangles = self.triangles.iter().map(|triangle| {
            let corners = triangle.map(|n| &vertices[n as usize]);
            (eyes.map(|eye| is_front(corners, eye)), corners.into_iter())
        });
        let values = |v: &Vertex| {
            let [r, g, b, _] = v.colour[0].0.map(|n| T::of(f64::from(n)));
            [T::of(f64::from(v.depth)), r, g, b]
        };
        let Views { items, colours } = views;
        let width = self.size[0] as usize;
        let paint = |seen: Seen<T, EYES, 4>, meter: &mut _| {
            let start = seen.row as usize * width;
            let row = &mut colours[seen.view][start..start + width];
            row.fill(self.background);
            seen.runs(|columns, lines| {
                Meter::note(meter, |work| {
                    work.interpolations += 3 * columns.len() as u64;
                    work.pixels_written += columns.len() as u64;
                });
                shade(&mut row[columns], lines);
            });
        };
        scan_line::draw(triangles, eyes, &self.formats, values, items, meter, paint);
    }

    /// Colour of a point.
    fn light(&self, point: usize) -> Rgba {
        let material = &self.palette[self.materials[point] as usize];
        let colour = self.lighting.dull(&self.points[point], material);
        let [r, g, b] = colour.map(|n| (n * 255.0).clamp(0.0, 255.0).round_ties_even() as u8);
        Rgba([r, g, b, 255])
    }

    /// A point as some eyes see it: x = (x ∓ z·e/(2d))/(1 + z/d), y = y/(1 + z/d), to the nearest
    /// subpixel. Adelson et al., "Differences and Similarities Between The Views".
    fn project<T: Real, const EYES: usize>(&self, point: usize, eyes: [Eye; EYES]) -> Vertex {
        let [x, y, z] = self.points[point].position.map(T::of);
        let Rig { pixels_per_unit, eye_separation, viewing_distance, .. } = self.rig;
        let [ppu, e, d] = [pixels_per_unit, eye_separation, viewing_distance].map(T::of);
        let [across, down] = self.size.map(|n| T::of(f64::from(n) / 2.0));
        let subpixels = self.formats.one_pixel() as f64;
        let snap = |n: T| (n.value() * subpixels).round_ties_even() as i32;
        let w = T::of(1.0) + z / d;
        let shift = z * e / T::of(2.0 * viewing_distance);
        let mut vertex = Vertex {
            y: [snap(down - ppu * y / w); 2],
            depth: self.depth(z + d),
            ..Vertex::default()
        };
        for eye in eyes {
            let shifted = if eye == Eye::Left { x - shift } else { x + shift };
            vertex.x[eye as usize] = snap(across + ppu * shifted / w);
        }
        vertex
    }

    /// Depth at a distance from the eyes: affine in its inverse, 0 at the near plane.
    fn depth<T: Real>(&self, w: T) -> u32 {
        let [near, far] = [self.rig.near(), self.rig.far()];
        let part = T::of(far) * (w - T::of(near)) / (w * T::of(far - near));
        (part.value() * f64::from(DEPTH_MAX)).round_ties_even() as u32
    }
}

/// True if an eye sees a triangle counter-clockwise; y is downward.
fn is_front(corners: [&Vertex; 3], eye: Eye) -> bool {
    let [[x0, y0], [x1, y1], [x2, y2]] =
        corners.map(|v| [v.x[eye as usize], v.y[eye as usize]].map(i64::from));
    (x2 - x0) * (y1 - y0) > (x1 - x0) * (y2 - y0)
}

/// Interpolates colours over a run, to the nearest level, with 16 fraction bits. At pixel centres
/// between the edges they do not leave the range of the corners by more than rounding. Not inlined, so
/// that one view and both have the same code for pixels.
#[inline(never)]
fn shade<T: Real>(row: &mut [u32], lines: [Line<T>; 3]) {
    const ONE: f64 = 65536.0;
    let mut level = lines.map(|line| (line.first.value() * ONE + ONE / 2.0) as i32);
    let slope = lines.map(|line| (line.slope.value() * ONE) as i32);
    for pixel in row {
        let [r, g, b] = level.map(|level| (level >> 16) as u32);
        *pixel = r << 16 | g << 8 | b;
        // Steep colours wrap beyond the end of a short span, where nobody looks.
        level = std::array::from_fn(|k| level[k].wrapping_add(slope[k]));
    }
}
