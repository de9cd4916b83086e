//! From meshes to polygons: lighting, clipping, culling, projection and snapping.
//!
//! 1. Corners are lit for each eye, from the side that is seen. Faces that are not convex are cut into
//!    triangles.
//! 2. Polygons are cut at the near and far planes, in space; with several partitions at those of each,
//!    and what is left goes on in each by itself. What has a corner above or below the guard band is
//!    cut there too, alike for both eyes.
//! 3. A polygon that still leaves the guard band in either view is cut for each eye alone, and
//!    goes on as one polygon an eye.
//! 4. Corners are snapped. Culling looks at the snapped polygon of each eye.
//! 5. Polygons that were cut there go on as fans of triangles with the same id; so do polygons of more
//!    than three corners that snapping made concave.

use super::camera::{Camera, Lens, Snapped};
use super::clip::{clip_all, Corner};
use super::cut::{cut, is_convex_polygon, Crossing, Cut};
use super::error::{check_size, SceneError};
use super::geometry::{Counts, Cull, Geometry, Options};
use super::mesh::Mesh;
use super::rig::HalfSpace;
use super::shading::Shading;
use super::vector::{dot, extent, outward, sub, Vec3};
use super::Scene;
use crate::formats::{Eye, Formats, Rgba};
use crate::frame::Scissor;
use crate::progress::over;
use crate::setup::{Eyes, Polygon, Vertex};
use crate::texture::Texture;
use std::rc::Rc;

impl Scene {
    /// Lights, projects, clips and snaps the scene.
    ///
    /// Fails if the views exceed the formats or a mesh contradicts itself.
    pub fn geometry(&self, formats: &Formats, options: &Options) -> Result<Geometry, SceneError> {
        check_size(self.width, self.height, formats.max_size)?;
        self.check()?;
        let scissor = self.rig.scissor(self.width)?;
        let mut builder = Builder::new(self, formats, options);
        let mut first_id = 0;
        for mesh in &self.meshes {
            builder.mesh(mesh, first_id);
            first_id += mesh.id_count() as u32;
        }
        Ok(builder.finish(scissor))
    }
}

/// Properties that the polygons of a mesh have in common.
#[derive(Clone, Copy)]
struct Surface {
    id: u32,
    texture: Option<u32>,
    /// Lines have no back that could be culled.
    lines: bool,
}

/// A lens of the camera with the planes that polygons are cut by.
struct Partition {
    lens: Lens,
    depth_planes: [HalfSpace; 2],
    window_planes: [[HalfSpace; 4]; 2],
}

impl Partition {
    fn new(lens: &Lens) -> Partition {
        Partition {
            lens: *lens,
            depth_planes: lens.depth_planes(),
            window_planes: Eye::BOTH.map(|eye| lens.window_planes(eye)),
        }
    }

    /// True if any part of a polygon lies in it.
    fn reaches(&self, corners: &[Corner]) -> bool {
        self.lens.reaches(extent(corners.iter().map(|c| c.position[2])))
    }

    /// The part of a polygon in the half spaces. Rounding puts no corner before the near plane, where the projection
    /// would turn over.
    fn clip(&self, corners: Vec<Corner>, spaces: &[HalfSpace]) -> Vec<Corner> {
        let [near, far] = self.lens.depth_range();
        let mut kept = clip_all(corners, spaces);
        kept.iter_mut().for_each(|c| c.position[2] = c.position[2].clamp(near, far));
        kept
    }

    fn snap(&self, corners: &[Corner]) -> Vec<Snapped> {
        corners.iter().map(|c| self.lens.snap(c.position)).collect()
    }
}

/// Collects the polygons of a scene.
pub(super) struct Builder<'a> {
    scene: &'a Scene,
    options: &'a Options,
    camera: Camera,
    partitions: Rc<[Partition]>,
    /// Smallest and largest coordinate in the guard band, in subpixels, across and down.
    band: [[i64; 2]; 2],
    /// Size of a view in subpixels.
    size: [i64; 2],
    /// True for each texture of the scene that is translucent.
    translucent_textures: Vec<bool>,
    /// True for each that shows nothing.
    invisible_textures: Vec<bool>,
    opaque: Vec<Polygon>,
    translucent: Vec<Polygon>,
    counts: Counts,
}

impl<'a> Builder<'a> {
    /// No polygons yet.
    pub fn new(scene: &'a Scene, formats: &Formats, options: &'a Options) -> Builder<'a> {
        let camera = Camera::new(&scene.rig, scene.width, scene.height, formats);
        let one = formats.one_pixel();
        let size = [scene.width, scene.height].map(|n| i64::from(n) * one);
        let guard = i64::from(formats.guard_band) * one;
        Builder {
            scene,
            options,
            partitions: camera.lenses().iter().map(Partition::new).collect(),
            camera,
            band: size.map(|n| [-guard, n + guard]),
            size,
            translucent_textures: scene.textures.iter().map(Texture::is_translucent).collect(),
            invisible_textures: scene.textures.iter().map(Texture::is_invisible).collect(),
            opaque: Vec::new(),
            translucent: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// The polygons in order.
    pub fn finish(mut self, scissor: Scissor) -> Geometry {
        // 60 / n is whole for every number of corners.
        let far = |p: &Polygon| {
            let sum: u64 = p.vertices.iter().map(|v| u64::from(v.depth)).sum();
            core::cmp::Reverse(sum * 60 / p.vertices.len() as u64)
        };
        self.translucent.sort_by_key(far);
        self.opaque.append(&mut self.translucent);
        self.counts.polygons = self.opaque.len();
        let [r, g, b] = self.scene.background;
        Geometry {
            width: self.scene.width,
            height: self.scene.height,
            background: Rgba([r, g, b, 255]),
            polygons: self.opaque,
            textures: self.scene.textures.clone(),
            scissor,
            counts: self.counts,
        }
    }

    /// Adds a mesh whose ids begin at `first_id`.
    pub fn mesh(&mut self, mesh: &Mesh, first_id: u32) {
        let scene = self.scene;
        let material = &scene.materials[mesh.material as usize];
        let texture = material.texture.filter(|_| !mesh.texture_coordinates.is_empty());
        let partitions = Rc::clone(&self.partitions);
        let shading =
            |p: &Partition| Shading::new(scene, mesh, Eye::BOTH.map(|eye| p.lens.centre(eye)));
        let mut shadings: Vec<Shading> = partitions.iter().map(shading).collect();
        self.counts.triangles += mesh.triangles.len();
        self.counts.faces += mesh.faces.len();
        let triangles = over("projecting", "triangles", &mesh.triangles);
        for (n, triangle) in triangles.enumerate() {
            let texels = self.texels(mesh, triangle, texture);
            let corners = [0, 1, 2].map(|k| Corner {
                position: mesh.positions[triangle[k] as usize],
                texel: texels[k],
                ..Corner::default()
            });
            let id = first_id + mesh.triangle_ids.get(n).copied().unwrap_or(n as u32);
            self.partitioned(
                &corners,
                Surface { id, texture, lines: mesh.lines },
                |partition, corners| {
                    let colours = shadings[partition].triangle(n);
                    corners.iter_mut().zip(colours).for_each(|(c, colour)| c.colour = colour);
                },
            );
        }
        let first_face = first_id + mesh.triangle_id_count() as u32;
        for (n, face) in over("projecting", "faces", &mesh.faces).enumerate() {
            let corner =
                |&k: &u32| Corner { position: mesh.positions[k as usize], ..Corner::default() };
            let corners: Vec<Corner> = face.iter().map(corner).collect();
            let surface = Surface { id: first_face + n as u32, texture: None, lines: false };
            for piece in convex_pieces(corners) {
                self.partitioned(&piece, surface, |partition, corners| {
                    let colour = shadings[partition].face(n);
                    corners.iter_mut().for_each(|c| c.colour = colour);
                });
            }
        }
    }

    /// Draws a polygon in all partitions that it reaches, coloured as it is seen there.
    fn partitioned(
        &mut self,
        corners: &[Corner],
        surface: Surface,
        mut colour: impl FnMut(usize, &mut [Corner]),
    ) {
        let partitions = Rc::clone(&self.partitions);
        let mut reached = false;
        for (n, partition) in partitions.iter().enumerate().filter(|(_, p)| p.reaches(corners)) {
            reached = true;
            let mut corners = corners.to_vec();
            colour(n, &mut corners);
            self.polygon(partition, corners, surface);
        }
        if !reached {
            self.out_of_range(corners);
        }
    }

    /// Counts a polygon that lies at no distance that is drawn.
    fn out_of_range(&mut self, corners: &[Corner]) {
        let rig = &self.scene.rig;
        let distances = corners.iter().map(|c| c.position[2] + rig.viewing_distance);
        let [nearest, farthest] = extent(distances);
        let counts = &mut self.counts;
        let count = if farthest <= 0.0 {
            &mut counts.behind
        } else if farthest <= rig.near() {
            &mut counts.nearer
        } else if nearest >= rig.far() {
            &mut counts.farther
        } else {
            &mut counts.between
        };
        *count += 1;
    }

    /// Texture coordinates in texels, moved by whole repeats to near zero.
    fn texels(&self, mesh: &Mesh, triangle: &[u32; 3], texture: Option<u32>) -> [[f64; 2]; 3] {
        let Some(texture) = texture else {
            return [[0.0; 2]; 3];
        };
        let Texture { width, height, .. } = self.scene.textures[texture as usize];
        let corners = triangle.map(|n| mesh.texture_coordinates[n as usize]);
        let first = [0, 1].map(|k| corners.iter().fold(f64::MAX, |m, c| m.min(c[k])).floor());
        let size = [f64::from(width), f64::from(height)];
        corners.map(|c| [0, 1].map(|k| (c[k] - first[k]) * size[k]))
    }

    fn polygon(&mut self, partition: &Partition, mut corners: Vec<Corner>, surface: Surface) {
        let inside =
            |c: &Corner| partition.depth_planes.iter().all(|plane| plane.at(c.position) >= 0.0);
        let mut cut = false;
        if !corners.iter().all(inside) {
            cut = true;
            let kept = partition.clip(corners.clone(), &partition.depth_planes);
            if kept.is_empty() {
                return self.out_of_range(&corners);
            }
            corners = kept;
        }
        let mut points = partition.snap(&corners);
        if self.camera.is_level() && !points.iter().all(|p| self.in_band(p, Eye::Left, 1)) {
            cut = true;
            corners = partition.clip(corners, &partition.window_planes[0][2..]);
            points = partition.snap(&corners);
        }
        if corners.is_empty() {
            self.counts.outside += 1;
            return;
        }
        self.counts.clipped += usize::from(cut);
        let fits = |p: &Snapped| {
            Eye::BOTH.iter().all(|&eye| self.in_band(p, eye, 0) && self.in_band(p, eye, 1))
        };
        if points.iter().all(fits) {
            self.binocular(&corners, &points, cut, surface);
        } else {
            self.guard_band(partition, &corners, surface);
        }
    }

    fn in_band(&self, point: &Snapped, eye: Eye, axis: usize) -> bool {
        let [low, high] = self.band[axis];
        let n = if axis == 0 { point.x } else { point.y }[eye as usize];
        low <= n && n <= high
    }

    /// A polygon within the guard band of both views.
    fn binocular(&mut self, corners: &[Corner], points: &[Snapped], cut: bool, surface: Surface) {
        let culled = Eye::BOTH.map(|eye| self.is_culled(points, eye, surface));
        let eyes = match culled {
            [false, false] => Eyes::Both,
            [false, true] => Eyes::One(Eye::Left),
            [true, false] => Eyes::One(Eye::Right),
            [true, true] => {
                let edge_on = self.has_no_area(corners, points, &Eye::BOTH, surface.id);
                self.counts.culled += usize::from(!edge_on);
                return;
            }
        };
        self.counts.half_culled += usize::from(eyes != Eyes::Both);
        let whole = points.len() == 3
            || (!cut && Eye::BOTH.iter().all(|&eye| !eyes.contains(eye) || is_convex(points, eye)));
        let base = Polygon { id: surface.id, eyes, texture: surface.texture, ..Polygon::default() };
        self.emit(corners, points, whole, &base);
    }

    /// A polygon that leaves the guard band: cut and drawn for each eye alone.
    fn guard_band(&mut self, partition: &Partition, corners: &[Corner], surface: Surface) {
        self.counts.guard_band += 1;
        let mut culled = 0;
        for eye in Eye::BOTH {
            let planes = &partition.window_planes[eye as usize];
            let corners = partition.clip(corners.to_vec(), planes);
            let mut points = partition.snap(&corners);
            for point in &mut points {
                // Rounding may leave a corner a subpixel outside. The other eye is not concerned.
                let [x, y] = [(point.x, 0), (point.y, 1)]
                    .map(|(n, axis)| n[eye as usize].clamp(self.band[axis][0], self.band[axis][1]));
                *point = Snapped { x: [x; 2], y: [y; 2] };
            }
            if points.is_empty() {
                self.counts.outside += 1;
            } else if self.is_culled(&points, eye, surface) {
                culled += usize::from(!self.has_no_area(&corners, &points, &[eye], surface.id));
            } else {
                let base = Polygon {
                    id: surface.id,
                    eyes: Eyes::One(eye),
                    texture: surface.texture,
                    guard_band: true,
                    ..Polygon::default()
                };
                self.emit(&corners, &points, points.len() == 3, &base);
            }
        }
        self.counts.half_culled += usize::from(culled == 1);
        self.counts.culled += usize::from(culled == 2);
    }

    fn is_culled(&self, points: &[Snapped], eye: Eye, surface: Surface) -> bool {
        self.options.cull == Cull::Back && !surface.lines && doubled_area(points, eye) <= 0
    }

    /// Hands on a polygon, whole or as a fan of triangles.
    fn emit(&mut self, corners: &[Corner], points: &[Snapped], whole: bool, base: &Polygon) {
        if whole {
            return self.piece(corners, points, base);
        }
        for k in 1..corners.len() - 1 {
            let fan = [0, k, k + 1];
            self.piece(&fan.map(|n| corners[n]), &fan.map(|n| points[n]), base);
        }
    }

    fn piece(&mut self, corners: &[Corner], points: &[Snapped], base: &Polygon) {
        let mut eyes = Eye::BOTH.to_vec();
        eyes.retain(|&eye| base.eyes.contains(eye));
        if self.has_no_area(corners, points, &eyes, base.id) {
            return;
        }
        if eyes.iter().all(|&eye| self.is_outside(points, eye)) {
            self.counts.outside += 1;
            return;
        }
        let distances = corners.iter().map(|c| self.camera.distance(c.position));
        let nearest = distances.fold(f64::MAX, f64::min);
        let vertices = corners.iter().zip(points).map(|(c, p)| self.vertex(c, p, nearest));
        let mut polygon = Polygon { vertices: vertices.collect(), ..base.clone() };
        polygon.specular = polygon.vertices.iter().any(|v| {
            let [Rgba(left), Rgba(right)] = v.colour;
            left.iter().zip(right).any(|(l, r)| l.abs_diff(r) > self.options.specular_threshold)
        });
        let alpha = |value: u8| {
            polygon.vertices.iter().flat_map(|v| v.colour).all(|colour| colour.0[3] == value)
        };
        let hides = |texture: u32| self.invisible_textures[texture as usize];
        if alpha(0) || polygon.texture.is_some_and(hides) {
            self.counts.invisible += 1;
            return;
        }
        let shows_through = |texture: u32| self.translucent_textures[texture as usize];
        let opaque = alpha(255) && !polygon.texture.is_some_and(shows_through);
        if opaque { &mut self.opaque } else { &mut self.translucent }.push(polygon);
    }

    /// True if no eye sees an area of a polygon, which is then counted.
    fn has_no_area(
        &mut self,
        corners: &[Corner],
        points: &[Snapped],
        eyes: &[Eye],
        id: u32,
    ) -> bool {
        if eyes.iter().any(|&eye| doubled_area(points, eye) != 0) {
            return false;
        }
        let counts = &mut self.counts;
        let at = |k: usize| corners[k].position;
        let is_line = (2..corners.len()).all(|k| is_line(at(0), at(k - 1), at(k)));
        let is_small = |numbers: [i64; 2]| numbers[1] - numbers[0] <= 1;
        let range = |of: &dyn Fn(&Snapped) -> i64| {
            let numbers = points.iter().map(of);
            numbers.fold([i64::MAX, i64::MIN], |[least, most], n| [least.min(n), most.max(n)])
        };
        let is_point = |eye: &Eye| {
            let eye = *eye as usize;
            is_small(range(&|p| p.x[eye])) && is_small(range(&|p| p.y[eye]))
        };
        if is_line {
            counts.empty += 1;
            counts.first_empty.get_or_insert(id);
        } else if eyes.iter().all(is_point) {
            counts.small += 1;
        } else {
            counts.edge_on += 1;
        }
        true
    }

    /// True if a polygon lies beside a view.
    fn is_outside(&self, points: &[Snapped], eye: Eye) -> bool {
        let beside = |place: fn(&Snapped) -> [i64; 2], size: i64| {
            points.iter().all(|p| place(p)[eye as usize] <= 0)
                || points.iter().all(|p| place(p)[eye as usize] >= size)
        };
        beside(|p| p.x, self.size[0]) || beside(|p| p.y, self.size[1])
    }

    fn vertex(&self, corner: &Corner, point: &Snapped, nearest: f64) -> Vertex {
        let inverse = f64::from(1 << 24) * nearest / self.camera.distance(corner.position);
        Vertex {
            x: point.x.map(|n| n as i32),
            y: point.y.map(|n| n as i32),
            depth: self.camera.depth(corner.position),
            colour: corner.colour.map(|c| Rgba(c.map(|n| n.round_ties_even() as u8))),
            texel: corner.texel.map(|n| (n * 256.0).round_ties_even() as i32),
            inverse: inverse.round_ties_even() as u32,
        }
    }
}

/// A polygon as it is if it is convex, else in triangles.
fn convex_pieces(corners: Vec<Corner>) -> Vec<Vec<Corner>> {
    let places: Vec<Vec3> = corners.iter().map(|c| c.position).collect();
    if is_convex_polygon(&places) {
        return vec![corners];
    }
    let Cut { triangles, crossings } = cut(&places);
    let crossing = |c: &Crossing| Corner {
        position: c.between(c.edge.map(|k| places[k])),
        ..Corner::default()
    };
    let all: Vec<Corner> = corners.iter().copied().chain(crossings.iter().map(crossing)).collect();
    triangles.iter().map(|t| t.iter().map(|&k| all[k]).collect()).collect()
}

/// True if three points lie on a line, or so nearly that the rest is rounding.
fn is_line(a: Vec3, b: Vec3, c: Vec3) -> bool {
    let square = |v: Vec3| dot(v, v);
    let longest = [sub(b, a), sub(c, a), sub(c, b)].map(square).into_iter().fold(0.0, f64::max);
    square(outward(a, b, c)) <= 1e-24 * longest * longest
}

/// Twice the area of a polygon as an eye sees it, positive if counter-clockwise.
fn doubled_area(points: &[Snapped], eye: Eye) -> i64 {
    let at = |k: usize| (points[k].x[eye as usize], points[k].y[eye as usize]);
    let (x0, y0) = at(0);
    (1..points.len() - 1)
        .map(|k| {
            let ((x1, y1), (x2, y2)) = (at(k), at(k + 1));
            // Rows go downward, so this is the mathematical area with its sign turned.
            (x2 - x0) * (y1 - y0) - (x1 - x0) * (y2 - y0)
        })
        .sum()
}

/// True if no corner lies on the wrong side of any edge.
fn is_convex(points: &[Snapped], eye: Eye) -> bool {
    let sign = doubled_area(points, eye).signum();
    (0..points.len()).all(|k| {
        let edge = [points[k], points[(k + 1) % points.len()]];
        points.iter().all(|&p| doubled_area(&[edge[0], edge[1], p], eye).signum() * sign >= 0)
    })
}
