//! Time to load meshes that are extreme in one thing, each at one size and at four times that: it may
//! grow with the size, not with its square.
//!
//! `cargo bench -p wheatstone-golden --bench growth`; it fails if a time grows eightfold or more.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::Instant;
use wheatstone_golden::scene;

const ROUNDS: usize = 5;
/// Largest ratio of the times for the larger and the smaller file; linear growth gives 4.
const LIMIT: f64 = 8.0;

type Failure = Box<dyn std::error::Error>;
/// Makes a mesh of a size.
type Make = fn(usize) -> String;

fn main() -> Result<(), Failure> {
    let folder = tempfile::tempdir()?;
    let materials: String =
        (0..100_000).fold(String::new(), |text, n| text + &format!("newmtl m{n}\nKd 1 0 0\n"));
    fs::write(folder.path().join("m.mtl"), materials)?;
    let cases: [(&str, usize, Make); 8] = [
        ("lines that name one library", 5_000, |n| "mtllib m.mtl\n".repeat(n) + TRIANGLE),
        ("lines that name missing libraries", 2_500, missing),
        ("corners of one face", 25_000, polygon),
        ("corners of one concave face", 25_000, star),
        ("corners of one tangled face", 25_000, tangle),
        ("changes of material", 7_500, changes),
        ("faces round one vertex", 10_000, fan),
        ("faces of a grid", 50_000, grid),
    ];
    println!("{:<36}{:>9}{:>12}{:>12}{:>8}", "loading", "of", "time", "of 4 times", "ratio");
    let mut quadratic = Vec::new();
    for (name, size, make) in cases {
        let [time, longer] = [size, 4 * size].map(|size| load(folder.path(), &make(size)));
        let (time, longer) = (time?, longer?);
        let ratio = longer / time;
        println!("{name:<36}{size:>9}{:>9.1} ms{:>9.1} ms{ratio:>8.1}", time * 1e3, longer * 1e3);
        if ratio >= LIMIT {
            quadratic.push(name);
        }
    }
    if quadratic.is_empty() {
        return Ok(());
    }
    Err(format!("time grows faster than the file: {}", quadratic.join(", ")).into())
}

/// The shortest time to load a mesh and to make polygons of it, in seconds.
fn load(folder: &Path, mesh: &str) -> Result<f64, Failure> {
    let file = folder.join("mesh.obj");
    fs::write(&file, mesh)?;
    let name = file.display().to_string();
    let mut least = f64::MAX;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        scene::open(&name, None, None)?;
        least = least.min(start.elapsed().as_secs_f64());
    }
    Ok(least)
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";

fn missing(count: usize) -> String {
    let names = (0..count).fold(String::new(), |text, n| text + &format!("mtllib gone{n}.mtl\n"));
    names + TRIANGLE
}

/// Vertices on a circle.
fn circle(count: usize) -> String {
    let mut text = String::new();
    for n in 0..count {
        let angle = n as f64 / count as f64 * std::f64::consts::TAU;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {} {} {}", angle.cos(), angle.sin(), 0);
    }
    text
}

/// A face of vertices in an order.
fn face(vertices: String, order: impl Iterator<Item = usize>) -> String {
    let indices = order.fold("f".to_string(), |text, n| text + &format!(" {n}"));
    vertices + &indices + "\n"
}

fn polygon(corners: usize) -> String {
    face(circle(corners), 1..=corners)
}

/// Every other corner is half as far out.
fn star(corners: usize) -> String {
    let mut text = String::new();
    for (n, line) in circle(corners).lines().enumerate() {
        let far = if n % 2 == 0 { 1.0 } else { 2.0 };
        // The fourth number of a vertex divides the others.
        let _ = writeln!(text, "{line} {far}");
    }
    face(text, 1..=corners)
}

/// Chords of a circle: all cross each other.
fn tangle(corners: usize) -> String {
    face(circle(corners), (0..corners).map(|n| n * (corners / 2 - 1) % corners + 1))
}

fn changes(count: usize) -> String {
    let mut text = format!("mtllib m.mtl\n{TRIANGLE}");
    for n in 0..count {
        let _ = writeln!(text, "usemtl m{n}\nf 1 2 3");
    }
    text
}

fn fan(count: usize) -> String {
    let mut text = circle(count) + "v 0 0 1\n";
    for n in 0..count {
        let _ = writeln!(text, "f {} {} {}", n + 1, (n + 1) % count + 1, count + 1);
    }
    text
}

fn grid(faces: usize) -> String {
    let side = (faces as f64).sqrt() as usize;
    let mut text = String::new();
    for n in 0..(side + 1) * (side + 1) {
        let (x, y) = (n % (side + 1), n / (side + 1));
        let _ = writeln!(text, "v {x} {y} {}", (x * y % 7) as f64 / 10.0);
    }
    for n in 0..side * side {
        let first = n / side * (side + 1) + n % side + 1;
        let _ = writeln!(text, "f {first} {} {} {}", first + 1, first + side + 2, first + side + 1);
    }
    text
}
