//! Light and material: the colour of a vertex as each eye sees it.
//!
//! Colours are added and multiplied as they are stored, without linearisation, in doubles. For a
//! vertex with unit normal n, directions l to a light, v to an eye, and h half-way between them:
//!
//! ```text
//! lit    = emission + base · (ambient + Σ light · max(0, n·l)) + specular · Σ light · (n·h)^exponent
//! colour = lit · (1 − reflection) + environment(2 (n·v) n − v) · reflection
//! ```
//!
//! Only the terms with v differ between the eyes. Lights behind the surface have no highlight.
//! A texture multiplies the result.

use super::vector::{add, dot, scale, sub, unit, Vec3};

/// Reflection and emission of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Base colour of meshes that have none of their own, 0 to 1.
    pub diffuse: Vec3,
    /// Colour of highlights, 0 to 1.
    pub specular: Vec3,
    /// Sharpness of highlights; a whole number, so that its power is the same on every machine.
    pub exponent: u32,
    /// Light of its own, 0 to 1.
    pub emission: Vec3,
    /// Part of the colour that is a reflection of the environment, a channel each, 0 to 1.
    pub reflection: Vec3,
    /// Opacity, 0 to 1.
    pub alpha: f64,
    /// Index of a texture of the scene.
    pub texture: Option<u32>,
}

impl Default for Material {
    /// Dull light grey.
    fn default() -> Material {
        Material {
            diffuse: [0.8; 3],
            specular: [0.0; 3],
            exponent: 1,
            emission: [0.0; 3],
            reflection: [0.0; 3],
            alpha: 1.0,
            texture: None,
        }
    }
}

/// Origin of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// From infinitely far in this direction.
    Direction(Vec3),
    /// From this point, without loss on the way.
    Point(Vec3),
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Its direction or position.
    pub source: Source,
    /// Its colour, 1 for white.
    pub colour: Vec3,
}

/// All light of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// Light that comes from everywhere.
    pub ambient: Vec3,
    /// The lights.
    pub lights: Vec<Light>,
}

impl Default for Lighting {
    /// One white light of strength 0.8 from above, to the left of and behind the viewer, in the
    /// direction (−2, 4, −3), and ambient light of 0.25.
    fn default() -> Lighting {
        let source = Source::Direction([-2.0, 4.0, -3.0]);
        Lighting { ambient: [0.25; 3], lights: vec![Light { source, colour: [0.8; 3] }] }
    }
}

/// A soft bright spot in the environment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Panel {
    /// Its direction, a unit vector.
    pub towards: Vec3,
    /// Cosine of the angle at which it begins to fade, and of that at which it is gone.
    pub edge: [f64; 2],
    /// Its colour, added to what is behind it.
    pub colour: Vec3,
}

/// Surroundings that polished surfaces reflect: a sky, a horizon and a ground that blend softly, and bright panels.
/// They are infinitely far away.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Straight up.
    pub zenith: Vec3,
    /// All round.
    pub horizon: Vec3,
    /// Straight down.
    pub ground: Vec3,
    /// Windows and lamps.
    pub panels: Vec<Panel>,
}

impl Default for Environment {
    /// A bright sky over brown ground, and a window up on the left.
    fn default() -> Environment {
        let towards = unit([-2.0, 3.0, -3.0]);
        Environment {
            zenith: [0.35, 0.55, 0.9],
            horizon: [0.85, 0.9, 0.95],
            ground: [0.25, 0.2, 0.15],
            panels: vec![Panel { towards, edge: [0.95, 0.85], colour: [0.9; 3] }],
        }
    }
}

impl Environment {
    /// Colour in a direction given as a unit vector, 0 to 1 and possibly above.
    pub fn colour(&self, direction: Vec3) -> Vec3 {
        let height = direction[1];
        let end = if height > 0.0 { self.zenith } else { self.ground };
        // The ground begins abruptly, the sky gradually, as outdoors.
        let share = if height > 0.0 { smooth(height) } else { smooth((-height * 2.5).min(1.0)) };
        let behind = add(scale(self.horizon, 1.0 - share), scale(end, share));
        self.panels.iter().fold(behind, |colour, panel| {
            let [full, none] = panel.edge;
            let share = (dot(panel.towards, direction) - none) / (full - none);
            add(colour, scale(panel.colour, smooth(share.clamp(0.0, 1.0))))
        })
    }
}

/// 0 to 1 with level ends.
fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}

/// A whole power by repeated squaring, always in the same order.
fn power(mut base: f64, mut exponent: u32) -> f64 {
    let mut result = 1.0;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result *= base;
        }
        base *= base;
        exponent >>= 1;
    }
    result
}

fn times(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

/// A point of a surface to be lit.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Its place.
    pub position: Vec3,
    /// Unit normal on the side that is seen.
    pub normal: Vec3,
    /// Base colour, 0 to 1.
    pub base: Vec3,
}

impl Lighting {
    /// The lights before a surface, the directions to them and the cosines of their angles.
    fn facing<'a>(&'a self, point: &'a Point) -> impl Iterator<Item = (&'a Light, Vec3, f64)> {
        self.lights.iter().filter_map(|light| {
            let towards = match light.source {
                Source::Direction(direction) => unit(direction),
                Source::Point(place) => unit(sub(place, point.position)),
            };
            let facing = dot(point.normal, towards);
            (facing > 0.0).then_some((light, towards, facing))
        })
    }

    /// The part of a point's colour that is the same for every viewer, channels from 0 to 1, not
    /// clamped.
    pub fn dull(&self, point: &Point, material: &Material) -> Vec3 {
        let diffuse = self
            .facing(point)
            .fold(self.ambient, |sum, (light, _, facing)| add(sum, scale(light.colour, facing)));
        add(material.emission, times(point.base, diffuse))
    }

    /// Colours of a point for each of two eyes, channels from 0 to 255, not clamped.
    pub fn shade(
        &self,
        point: &Point,
        material: &Material,
        environment: &Environment,
        eyes: [Vec3; 2],
    ) -> [Vec3; 2] {
        let normal = point.normal;
        let views = eyes.map(|eye| unit(sub(eye, point.position)));
        let mut specular = [[0.0; 3]; 2];
        if material.specular != [0.0; 3] {
            for (light, towards, _) in self.facing(point) {
                for (sum, view) in specular.iter_mut().zip(views) {
                    let half = dot(normal, unit(add(towards, view))).max(0.0);
                    *sum = add(*sum, scale(light.colour, power(half, material.exponent)));
                }
            }
        }
        let dull = self.dull(point, material);
        [0, 1].map(|eye| {
            let lit = add(dull, times(material.specular, specular[eye]));
            let colour = if material.reflection == [0.0; 3] {
                lit
            } else {
                let view = views[eye];
                let direction = sub(scale(normal, 2.0 * dot(normal, view)), view);
                let seen = environment.colour(direction);
                let kept = material.reflection.map(|r| 1.0 - r);
                add(times(lit, kept), times(seen, material.reflection))
            };
            scale(colour, 255.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYES: [Vec3; 2] = [[-3.0, 0.0, -60.0], [3.0, 0.0, -60.0]];

    fn facing() -> Point {
        Point { position: [0.0; 3], normal: [0.0, 0.0, -1.0], base: [0.5; 3] }
    }

    #[test]
    fn a_dull_surface_has_one_colour() {
        let lighting = Lighting {
            ambient: [0.25; 3],
            lights: vec![Light { source: Source::Direction([0.0, 3.0, -4.0]), colour: [1.0; 3] }],
        };
        let [left, right] =
            lighting.shade(&facing(), &Material::default(), &Environment::default(), EYES);
        assert_eq!(left, right);
        // 255 · 0.5 · (0.25 + 0.8)
        assert!((left[0] - 133.875).abs() < 1e-9);
    }

    #[test]
    fn a_highlight_is_brightest_for_the_eye_it_is_mirrored_to() {
        // Mirrored at z = 0, a light behind the left eye is seen by the right one.
        let lighting = Lighting {
            ambient: [0.0; 3],
            lights: vec![Light { source: Source::Point([-3.0, 0.0, -60.0]), colour: [1.0; 3] }],
        };
        let shiny = Material { specular: [1.0; 3], exponent: 500, ..Material::default() };
        let [left, right] = lighting.shade(&facing(), &shiny, &Environment::default(), EYES);
        assert!(right[0] > left[0] + 20.0, "{left:?} {right:?}");
    }

    #[test]
    fn a_mirror_shows_each_eye_another_part_of_the_environment() {
        let towards = unit([3.0, 0.0, -60.0]);
        let panels = vec![Panel { towards, edge: [1.0, 0.99], colour: [1.0; 3] }];
        let environment = Environment { panels, ..Environment::default() };
        let dark = Lighting { ambient: [0.0; 3], lights: vec![] };
        let mirror = Material { reflection: [0.5; 3], ..Material::default() };
        let [left, right] = dark.shade(&facing(), &mirror, &environment, EYES);
        // The panel is where the left eye's view is mirrored to.
        assert!((left[0] - right[0]) > 50.0);
        assert!((left[0] - 255.0 * 0.5 * (0.85 + 1.0)).abs() < 1e-9);
    }

    #[test]
    fn powers() {
        assert_eq!(power(0.5, 0), 1.0);
        assert_eq!(power(0.5, 10), 1.0 / 1024.0);
        assert_eq!(power(3.0, 13), 1594323.0);
    }
}
