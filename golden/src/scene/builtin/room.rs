//! A textured room with glossy things, on both sides of the screen.

use super::empty::desk;
use super::paint;
use super::shapes::{append, cuboid, panel, sphere, torus, turned};
use super::teapot::teapot;
use crate::scene::vector::{add, rotate, scale, unit, Vec3};
use crate::scene::{Environment, Light, Lighting, Material, Mesh, Panel, Scene, Source};
use crate::texture::Texture;

/// Adds meshes with their materials and textures.
struct Furnisher(Scene);

impl Furnisher {
    fn texture(&mut self, texture: Texture) -> Option<u32> {
        self.0.textures.push(texture);
        Some(self.0.textures.len() as u32 - 1)
    }

    fn put(&mut self, mut mesh: Mesh, material: Material) {
        mesh.material = self.0.materials.len() as u32;
        self.0.materials.push(material);
        self.0.meshes.push(mesh);
    }
}

fn white() -> Material {
    Material { diffuse: [1.0; 3], ..Material::default() }
}

fn glossy(diffuse: Vec3, specular: f64, exponent: u32) -> Material {
    Material { diffuse, specular: [specular; 3], exponent, ..Material::default() }
}

/// The room: behind the screen, but for what stands at the front of the table.
pub fn scene(width: u32, height: u32) -> Scene {
    let mut room = Furnisher(Scene {
        background: [18, 18, 22],
        lighting: Some(Lighting {
            ambient: [0.34, 0.34, 0.37],
            lights: vec![
                Light { source: Source::Point([-16.0, 17.0, 2.0]), colour: [0.6, 0.56, 0.48] },
                Light { source: Source::Point([20.0, 10.0, -40.0]), colour: [0.2, 0.22, 0.28] },
            ],
        }),
        environment: Environment {
            zenith: [0.56, 0.55, 0.54],
            horizon: [0.74, 0.62, 0.52],
            ground: [0.24, 0.15, 0.09],
            panels: vec![
                Panel { towards: unit([-1.6, 1.5, -1.0]), edge: [0.93, 0.88], colour: [0.8; 3] },
                Panel {
                    towards: unit([2.0, 0.8, -1.6]),
                    edge: [0.97, 0.9],
                    colour: [0.3, 0.36, 0.5],
                },
            ],
        },
        ..desk(width, height)
    });
    // A little closer than a viewer's eyes: the far wall stays comfortable to look at.
    room.0.rig.eye_separation = 4.5;
    walls(&mut room);
    table(&mut room);
    things(&mut room);
    // Seen slightly from above, about the middle of the table.
    let tilted = |p: Vec3| rotate(p, 0, -8.0);
    let moved = |p: Vec3| add(tilted(add(p, [0.0, 3.0, -14.0])), [0.0, -2.0, 14.0]);
    room.0.meshes.iter_mut().for_each(|mesh| mesh.transform(moved, tilted));
    for light in &mut room.0.lighting.iter_mut().flat_map(|l| &mut l.lights) {
        if let Source::Point(place) = &mut light.source {
            *place = moved(*place);
        }
    }
    room.0
}

fn walls(room: &mut Furnisher) {
    let (left, right, floor, ceiling) = (-34.0, 34.0, -22.0, 30.0);
    let (front, back) = (-4.0, 70.0);
    let (across, up, deep) = (right - left, ceiling - floor, back - front);
    let texture = room.texture(paint::tiles([222.0, 212.0, 192.0], [122.0, 92.0, 76.0]));
    let ground = panel(
        [left, floor, back],
        [across, 0.0, 0.0],
        [0.0, 0.0, -deep],
        [4.0, deep / across * 4.0],
        [8, 10],
    );
    room.put(ground, Material { texture, ..white() });
    let texture = room.texture(paint::bricks());
    let wall =
        panel([left, ceiling, back], [across, 0.0, 0.0], [0.0, -up, 0.0], [3.0, 2.4], [8, 6]);
    room.put(wall, Material { texture, ..white() });
    let texture = room.texture(paint::wood([206.0, 178.0, 138.0]));
    let mut panels =
        panel([left, ceiling, front], [0.0, 0.0, deep], [0.0, -up, 0.0], [3.0, 2.0], [8, 6]);
    append(
        &mut panels,
        &panel([right, ceiling, back], [0.0, 0.0, -deep], [0.0, -up, 0.0], [3.0, 2.0], [8, 6]),
    );
    room.put(panels, Material { texture, ..white() });
    // A picture in a frame on the far wall, and a carpet before it.
    let frame = cuboid([9.0, 9.0, back - 0.6], [28.0, 20.0, 1.2], 10.0);
    room.put(frame, glossy([0.36, 0.22, 0.12], 0.3, 20));
    let texture = room.texture(paint::picture());
    let canvas =
        panel([-3.0, 17.0, back - 1.3], [24.0, 0.0, 0.0], [0.0, -16.0, 0.0], [1.0, 1.0], [2, 2]);
    room.put(canvas, Material { texture, ..white() });
    let texture = room.texture(paint::carpet());
    let rug =
        panel([-22.0, floor + 0.1, 62.0], [44.0, 0.0, 0.0], [0.0, 0.0, -34.0], [1.0, 1.0], [6, 6]);
    room.put(rug, Material { texture, ..white() });
    // A window in the left wall: light of its own, and its bars.
    let pane =
        panel([left + 0.1, 22.0, 40.0], [0.0, 0.0, 24.0], [0.0, -22.0, 0.0], [1.0, 1.0], [1, 1]);
    room.put(pane, Material { diffuse: [0.0; 3], emission: [0.74, 0.86, 0.97], ..white() });
    let mut bars = Mesh::default();
    for z in [40.0, 52.0, 64.0] {
        append(&mut bars, &cuboid([left + 0.5, 11.0, z], [1.0, 22.0, 1.2], 10.0));
    }
    for y in [0.0, 11.0, 22.0] {
        append(&mut bars, &cuboid([left + 0.5, y, 52.0], [1.0, 1.2, 25.2], 10.0));
    }
    room.put(bars, glossy([0.9, 0.88, 0.84], 0.2, 16));
}

fn table(room: &mut Furnisher) {
    let texture = room.texture(paint::wood([196.0, 128.0, 74.0]));
    let top = cuboid([0.0, -7.6, 10.0], [30.0, 1.2, 28.0], 16.0);
    room.put(top, Material { texture, ..glossy([1.0; 3], 0.12, 12) });
    let mut legs = Mesh::default();
    for (x, z) in [(-13.0, 22.5), (13.0, 22.5)] {
        append(&mut legs, &cuboid([x, -15.1, z], [1.6, 13.8, 1.6], 8.0));
    }
    room.put(legs, glossy([0.45, 0.27, 0.14], 0.2, 16));
}

fn things(room: &mut Furnisher) {
    const TOP: f64 = -7.0;
    // The teapot in the middle of the table, mirroring the room.
    let mut pot = teapot(8);
    let turn = |p: Vec3| rotate(p, 1, -24.0);
    pot.transform(|p| add(scale(turn(p), 2.5), [-1.0, TOP, 15.0]), turn);
    let chrome = Material { reflection: [0.72, 0.74, 0.78], ..glossy([0.5, 0.52, 0.56], 0.6, 60) };
    room.put(pot, chrome);
    // Before the screen: a red ball and a marbled one at the table's edge.
    room.put(sphere([6.4, TOP + 2.4, 1.5], 2.4, 40), glossy([0.8, 0.12, 0.1], 0.7, 50));
    room.put(sphere([9.7, TOP + 1.3, -1.6], 1.3, 28), glossy([0.1, 0.34, 0.72], 0.7, 40));
    // A golden ring that leans on the red ball.
    let mut ring = torus([0.0; 3], 2.6, 0.75, 44);
    let lean = |p: Vec3| rotate(rotate(p, 0, 16.0), 1, 28.0);
    ring.transform(|p| add(lean(p), [-8.6, TOP + 3.2, -0.5]), lean);
    room.put(
        ring,
        Material { reflection: [0.42, 0.32, 0.12], ..glossy([0.86, 0.62, 0.2], 0.6, 40) },
    );
    // A vase at the back of the table, a ball on the floor behind.
    let profile = [
        [1.5, 9.0],
        [1.1, 8.3],
        [0.95, 7.4],
        [1.3, 6.2],
        [2.2, 4.6],
        [2.6, 3.2],
        [2.4, 1.8],
        [1.7, 0.6],
        [1.4, 0.0],
    ];
    let mut vase = turned([11.0, TOP, 19.0], &profile, 28);
    vase.texture_coordinates.clear();
    vase.crease_normals(0.7);
    room.put(vase, glossy([0.16, 0.5, 0.42], 0.6, 30));
    let texture = room.texture(paint::segments());
    room.put(
        sphere([-19.0, -15.6, 42.0], 6.4, 40),
        Material { texture, ..glossy([1.0; 3], 0.25, 20) },
    );
    // A bubble that floats well before the screen.
    let film = Material { alpha: 0.45, reflection: [0.5; 3], ..glossy([0.5, 0.8, 0.86], 0.9, 60) };
    room.put(sphere([3.4, 3.6, -15.0], 1.7, 32), film);
}
