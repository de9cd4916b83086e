//! Textures painted in code. They repeat without a seam.

use crate::formats::Rgba;
use crate::texture::Texture;

type Colour = [f64; 3];

fn paint(size: u32, colour: impl Fn(f64, f64) -> Colour) -> Texture {
    let texel = |n: u32| {
        let part = |n: u32| (f64::from(n) + 0.5) / f64::from(size);
        let [r, g, b] = colour(part(n % size), part(n / size)).map(|c| c.clamp(0.0, 255.0) as u8);
        Rgba([r, g, b, 255])
    };
    Texture { width: size, height: size, texels: (0..size * size).map(texel).collect() }
}

/// A number from 0 to 1 for each point of a lattice, always the same one.
fn hash(x: i64, y: i64, seed: u64) -> f64 {
    let mut n = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f)
        ^ seed.wrapping_mul(0x1656_67b1_9e37_79f9);
    n = (n ^ (n >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    n = (n ^ (n >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (n >> 40) as f64 / f64::from(1 << 24)
}

/// Smooth noise from 0 to 1 on a lattice of `across` × `down` cells that wraps round.
fn noise(u: f64, v: f64, across: i64, down: i64, seed: u64) -> f64 {
    let (x, y) = (u * across as f64, v * down as f64);
    let (column, row) = (x.floor() as i64, y.floor() as i64);
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (s, t) = (ease(x - x.floor()), ease(y - y.floor()));
    let at =
        |i: i64, j: i64| hash((column + i).rem_euclid(across), (row + j).rem_euclid(down), seed);
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    mix(mix(at(0, 0), at(1, 0), s), mix(at(0, 1), at(1, 1), s), t)
}

fn shade(colour: Colour, factor: f64) -> Colour {
    colour.map(|c| c * factor)
}

/// Two by two tiles of stone with grey joints.
pub fn tiles(light: Colour, dark: Colour) -> Texture {
    paint(128, |u, v| {
        let (x, y) = (u * 2.0, v * 2.0);
        let edge = |n: f64| (n - n.floor()).min(1.0 - (n - n.floor()));
        if edge(x) < 0.02 || edge(y) < 0.02 {
            return [96.0, 92.0, 88.0];
        }
        let tile = if (x as u32 + y as u32).is_multiple_of(2) { light } else { dark };
        let grain = noise(u, v, 16, 16, 1) * 0.6 + noise(u, v, 48, 48, 2) * 0.4;
        shade(tile, 0.86 + 0.22 * grain)
    })
}

/// Boards of wood, four to a repeat, their grain along u.
pub fn wood(colour: Colour) -> Texture {
    paint(128, |u, v| {
        let board = (v * 4.0).floor();
        let across = v * 4.0 - board;
        if !(0.025..=0.975).contains(&across) {
            return shade(colour, 0.42);
        }
        let seed = 10 + board as u64;
        let bend = noise(u, v, 3, 8, seed) * 1.5;
        let rings = noise(u, (v + bend * 0.04).fract(), 2, 64, seed + 10);
        let fibre = noise(u, v, 12, 128, seed + 20);
        shade(colour, 0.72 + 0.1 * hash(board as i64, 7, 3) + 0.22 * rings + 0.12 * fibre)
    })
}

/// Bricks in a running bond, eight courses to a repeat.
pub fn bricks() -> Texture {
    paint(256, |u, v| {
        let course = (v * 8.0).floor();
        let x = u * 4.0 + if course % 2.0 == 0.0 { 0.0 } else { 0.5 };
        let brick = x.floor().rem_euclid(4.0);
        let (s, t) = (x - x.floor(), v * 8.0 - course);
        let grain = noise(u, v, 64, 64, 5);
        if !(0.025..=0.975).contains(&s) || !(0.06..=0.94).contains(&t) {
            return shade([190.0, 184.0, 172.0], 0.85 + 0.15 * grain);
        }
        let tone = hash(brick as i64, course as i64, 4);
        shade([172.0 + 24.0 * tone, 82.0 + 26.0 * tone, 62.0 + 14.0 * tone], 0.78 + 0.26 * grain)
    })
}

/// A landscape to hang on a wall: hills, a lake and a low sun.
pub fn picture() -> Texture {
    paint(256, |u, v| {
        let hill = |base: f64, height: f64, cells: i64, seed: u64| {
            base - height * noise(u, 0.5, cells, 1, seed)
        };
        let sun = ((u - 0.68).powi(2) + (v - 0.3).powi(2)).sqrt();
        let sky = [250.0 - 60.0 * (0.5 - v), 176.0 + 60.0 * (0.4 - v), 120.0 + 240.0 * (0.45 - v)];
        if v > hill(0.62, 0.12, 9, 33) {
            let ripple = 0.85 + 0.3 * noise(u, v, 10, 64, 34);
            return shade([70.0, 96.0, 132.0], ripple * (1.25 - (v - 0.6)));
        }
        if v > hill(0.56, 0.2, 6, 32) {
            return shade([66.0, 84.0, 62.0], 0.9 + 0.2 * noise(u, v, 40, 40, 36));
        }
        if v > hill(0.5, 0.3, 4, 31) {
            return [112.0, 108.0, 132.0];
        }
        if sun < 0.07 {
            [255.0, 244.0, 200.0]
        } else {
            shade(sky, 1.0 + 0.15 * (0.2 - sun).max(0.0))
        }
    })
}

/// A woven carpet with a border; it is meant to be shown once.
pub fn carpet() -> Texture {
    paint(256, |u, v| {
        let edge = u.min(1.0 - u).min(v.min(1.0 - v));
        let weave = 0.88 + 0.12 * noise(u, v, 128, 128, 8);
        let (x, y) = ((u * 8.0).fract() - 0.5, (v * 8.0).fract() - 0.5);
        let figure = x.abs() + y.abs();
        let colour = if edge < 0.03 || (0.1..0.12).contains(&edge) {
            [214.0, 190.0, 140.0]
        } else if edge < 0.1 {
            [34.0, 44.0, 84.0]
        } else if figure < 0.16 {
            [222.0, 196.0, 146.0]
        } else if figure < 0.34 {
            [40.0, 56.0, 104.0]
        } else {
            [138.0, 32.0, 40.0]
        };
        shade(colour, weave)
    })
}

/// A beach ball of eight segments.
pub fn segments() -> Texture {
    paint(128, |u, v| {
        let palette = [
            [236.0, 232.0, 222.0],
            [214.0, 52.0, 46.0],
            [236.0, 232.0, 222.0],
            [36.0, 96.0, 186.0],
        ];
        if !(0.06..=0.94).contains(&v) {
            [240.0, 200.0, 60.0]
        } else {
            palette[(u * 4.0) as usize % 4]
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn textures_vary_and_repeat_without_a_seam() {
        let all = [
            tiles([220.0; 3], [60.0; 3]),
            wood([180.0, 120.0, 70.0]),
            bricks(),
            picture(),
            carpet(),
            segments(),
        ];
        for texture in all {
            assert_eq!(texture.texels.len(), (texture.width * texture.height) as usize);
            let colours: std::collections::HashSet<_> = texture.texels.iter().collect();
            assert!(colours.len() >= 4);
        }
        for seed in 0..4 {
            let edge = |u: f64, v: f64| noise(u, v, 5, 3, seed);
            assert!((edge(0.0, 0.3) - edge(1.0 - 1e-9, 0.3)).abs() < 1e-6);
            assert!((edge(0.7, 0.0) - edge(0.7, 1.0 - 1e-9)).abs() < 1e-6);
        }
    }
}
