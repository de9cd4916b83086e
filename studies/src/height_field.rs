//! The height field (Duvanenko & Robbins, "Algorithms for Stereoscopic Imaging", Dr. Dobb's
//! Journal, 1993): counts, the physical chain, the two projections, and the pictures.
//!
//! Viewing coordinates are the authors': the eyes at (∓e/2, 0, 0), looking down −z, the screen at
//! z = −D. A point (x, y, z) is seen by the eye at s at
//! x' = s + (x − s)·D/(−z), y' = y·D/(−z); its parallax is e(1 − D/(−z)).

use crate::errata::{DEPTH, TRIANGLES, WHICH_EYE};
use crate::prepared::Prepared;
use crate::{Check, Experiment, Report, Row, StudyError, Table};
use std::path::{Path, PathBuf};
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::picture::{frame_picture, print_resolution, Composite, Views};
use wheatstone_golden::scene::height_field::{self, HeightGrid, EYE_SEPARATION};
use wheatstone_golden::scene::vector::Vec3;
use wheatstone_golden::scene::{self, builtin, Camera};
use wheatstone_golden::work::{counted, Counted, Operations, Real};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "height-field",
    description: "Duvanenko & Robbins' height field: counts, eyes and screen in dots, projections",
    run,
};

fn run(out: &Path) -> Result<Report, StudyError> {
    let grid = height_field::atoms();
    let prepared = Prepared::new(scene::open(builtin::ATOMS, None, None)?)?;
    let tables =
        vec![counts(&grid), chain(&prepared), projections(&prepared), second_view(&prepared)];
    Ok(Report {
        experiment: EXPERIMENT.name.into(),
        publication: "Duvanenko & Robbins 1993".into(),
        tables,
        files: pictures(&prepared, out)?,
    })
}

fn count(what: &str, n: f64) -> Row {
    Row::new(what, n, 0, Check::Digits)
}

/// Samples, triangles, and the arithmetic for them.
fn counts(grid: &HeightGrid) -> Table {
    let heights: Vec<Counted> = grid.heights().iter().map(|&h| Counted::of(h)).collect();
    let (dx, square) = (Counted::of(1.0), Counted::of(1.0));
    let short = || {
        grid.cells().for_each(|cell| {
            std::hint::black_box(height_field::normals(dx, square, cell.map(|n| heights[n])));
        })
    };
    let position = |n: usize| {
        let [columns, _] = grid.size();
        [(n % columns) as f64, -((n / columns) as f64), grid.heights()[n]].map(Counted::of)
    };
    let general = || {
        grid.cells().for_each(|[p11, p21, p22, p12]| {
            for triangle in [[p11, p21, p22], [p11, p22, p12]] {
                std::hint::black_box(normal(triangle.map(position)));
            }
        })
    };
    let matrix = [[Counted::of(0.5); 4]; 4];
    let transform = || {
        (0..heights.len()).for_each(|n| {
            let [x, y, z] = position(n);
            std::hint::black_box(product([x, y, z, Counted::of(1.0)], &matrix));
        })
    };
    let of = |code: &dyn Fn()| -> Operations { counted(code).1 };
    let [transform, general, short] = [of(&transform), of(&general), of(&short)];
    let ratio = |what: &str, general: u64, short: u64| {
        Row::new(what, general as f64 / short as f64, 1, Check::Digits)
    };
    Table {
        title: "200 x 200 samples".into(),
        rows: vec![
            count("samples", grid.heights().len() as f64).printed(40_000.0),
            count("triangles", grid.mesh().triangles.len() as f64)
                .printed(80_000.0)
                .corrected(79_202.0, TRIANGLES),
            count("transformation, multiplications", transform.multiplications as f64)
                .printed(640_000.0),
            count("transformation, additions", transform.additions as f64).printed(480_000.0),
            count("normals by cross products, subtractions", general.additions as f64)
                .printed(720_000.0)
                .corrected(9.0 * 79_202.0, TRIANGLES),
            count("normals by cross products, multiplications", general.multiplications as f64)
                .printed(480_000.0)
                .corrected(6.0 * 79_202.0, TRIANGLES),
            count("normals of the grid, subtractions", short.additions as f64)
                .printed(200_000.0)
                .corrected(5.0 * 39_601.0, TRIANGLES),
            count("normals of the grid, multiplications", short.multiplications as f64)
                .printed(160_000.0)
                .corrected(4.0 * 39_601.0, TRIANGLES),
            ratio("subtractions, ratio", general.additions, short.additions).printed(3.6),
            ratio("multiplications, ratio", general.multiplications, short.multiplications)
                .printed(3.0),
        ],
    }
}

/// The outer product of two edges of a triangle.
fn normal<T: Real>([a, b, c]: [[T; 3]; 3]) -> [T; 3] {
    let edge = |to: [T; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
    let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

/// A row vector times a matrix.
fn product<T: Real>(p: [T; 4], matrix: &[[T; 4]; 4]) -> [T; 4] {
    std::array::from_fn(|k| {
        p[0] * matrix[0][k] + p[1] * matrix[1][k] + p[2] * matrix[2][k] + p[3] * matrix[3][k]
    })
}

/// From inches through dots to units of the view.
fn chain(prepared: &Prepared) -> Table {
    let rig = &prepared.scene.rig;
    let dots = |inches: f64| inches * rig.pixels_per_unit;
    Table {
        title: "Eyes and screen (\"Transforming Interocular Distance\")".into(),
        rows: vec![
            count("distance between the eyes", dots(rig.eye_separation))
                .printed(119.0)
                .unit("dots"),
            count("viewing distance", dots(rig.viewing_distance)).expected(857.0).unit("dots"),
        ],
    }
}

/// The authors' matrices and formulas against the projection that the scene is drawn with.
fn projections(prepared: &Prepared) -> Table {
    let rig = &prepared.scene.rig;
    let [e, d] = [rig.eye_separation, rig.viewing_distance];
    let [width, height] = [prepared.scene.width, prepared.scene.height];
    let camera = Camera::new(rig, width, height, &Formats::new(&prepared.config));
    // Where an eye sees a point on the screen, in units from the middle.
    let drawn = |p: Vec3, eye: Eye| {
        let [x, y] = camera.pixel(p, eye);
        let from_middle = [x - f64::from(width) / 2.0, f64::from(height) / 2.0 - y];
        from_middle.map(|n| n / rig.pixels_per_unit)
    };
    let points = || {
        let positions = prepared.scene.meshes.iter().flat_map(|mesh| &mesh.positions);
        positions.map(|&p| (p, [p[0], p[1], -d - p[2]]))
    };
    let largest = |differences: &mut dyn Iterator<Item = f64>| {
        differences.map(f64::abs).fold(0.0, f64::max) * rig.pixels_per_unit
    };
    let difference = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let eyes = [(Eye::Left, -e / 2.0), (Eye::Right, e / 2.0)];
    let formulas = largest(&mut points().flat_map(|(p, [x, y, z])| {
        eyes.map(|(eye, s)| difference(drawn(p, eye), [s + (x - s) * d / -z, y * d / -z]))
    }));
    let parallax = largest(&mut points().map(|(p, [_, _, z])| {
        drawn(p, Eye::Right)[0] - drawn(p, Eye::Left)[0] - e * (1.0 - d / -z)
    }));
    // The listing translates by -e/2, projects and translates back for what it calls left.
    let left = translate_project_translate(-e / 2.0, -d);
    let right = translate_project_translate(e / 2.0, -d);
    let seen = |p: Vec3, matrix: &[[f64; 4]; 4]| {
        let [x, y, z, w] = product([p[0], p[1], p[2], 1.0], matrix);
        [x / w, y / w, z / w]
    };
    let flat = |[x, y, _]: Vec3| [x, y];
    let swapped = largest(&mut points().flat_map(|(p, view)| {
        [(Eye::Right, &left), (Eye::Left, &right)]
            .map(|(eye, matrix)| difference(drawn(p, eye), flat(seen(view, matrix))))
    }));
    let depths = points().map(|(_, view)| seen(view, &left)[2]);
    let [least, most] = depths.fold([f64::MAX, f64::MIN], |[a, b], z| [a.min(z), b.max(z)]);
    let kept = points().map(|(p, _)| camera.depth(p));
    let kept: std::collections::BTreeSet<u32> = kept.collect();
    let pixels = |what: &str, n: f64| Row::new(what, n, 9, Check::AtMost(1e-9)).unit("dots");
    Table {
        title: "Projection of 40,000 points for both eyes".into(),
        rows: vec![
            pixels("clean formulas, largest difference", formulas),
            pixels("parallax e(1 - D/(-z)), largest difference", parallax),
            pixels("Listing One's left matrix for the right eye, and the other way", swapped)
                .expected(0.0)
                .because(WHICH_EYE),
            Row::new("range of Listing One's depths", most - least, 9, Check::AtMost(1e-9))
                .because(DEPTH),
            Row::new("different depths here", kept.len() as f64, 0, Check::AtLeast(20_000.0)),
        ],
    }
}

/// Listing One's matrix for one eye: translation by `shift`, projection onto z = `plane`,
/// translation back.
fn translate_project_translate(shift: f64, plane: f64) -> [[f64; 4]; 4] {
    let identity: [[f64; 4]; 4] =
        std::array::from_fn(|row| std::array::from_fn(|k| f64::from(u8::from(row == k))));
    let translation = |by: f64| {
        let mut matrix = identity;
        matrix[3][0] = by;
        matrix
    };
    let mut projection = identity;
    projection[2][3] = 1.0 / plane;
    projection[3][3] = 0.0;
    let times = |a: [[f64; 4]; 4], b: [[f64; 4]; 4]| a.map(|row| product(row, &b));
    times(times(translation(shift), projection), translation(-shift))
}

/// The hybrid's pictures against direct rendering.
fn second_view(prepared: &Prepared) -> Table {
    let job = prepared.job();
    let direct = job.direct();
    let (derived, drawn) = job.derived(false);
    let wrong = |eye: Eye| {
        let [a, b] = [&derived.eyes[eye as usize], &direct[eye as usize]];
        let pairs = a.colour.iter().zip(&b.colour).zip(a.id.iter().zip(&b.id));
        pairs.filter(|((a, b), (i, j))| a != b || i != j).count() as f64
    };
    let none = |what: &str, n: f64| Row::new(what, n, 0, Check::AtMost(0.0));
    Table {
        title: "The pair at 640 x 480 by the hybrid".into(),
        rows: vec![
            none("left view, pixels that differ from direct rendering", wrong(Eye::Left)),
            none("right view, pixels that differ from direct rendering", wrong(Eye::Right)),
            Row::new("triangles derived", drawn.derived as f64, 0, Check::Trend),
            Row::new("beats", drawn.beats() as f64, 0, Check::Trend),
        ],
    }
}

fn pictures(prepared: &Prepared, out: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let [left, right] = prepared.job().direct().map(|frame| frame_picture(&frame));
    let views = Views { left: &left, right: &right };
    let rig = &prepared.scene.rig;
    let far = rig.eye_separation * rig.pixels_per_unit;
    let resolution = print_resolution(left.width(), far, EYE_SEPARATION);
    let mut files = Vec::new();
    for composite in
        [Composite::Parallel, Composite::Crossed, Composite::Triplet, Composite::FrameSequential]
    {
        let file = out.join(format!("{}.png", composite.name()));
        composite.write(&file, &views, composite.is_side_by_side().then_some(resolution))?;
        files.push(file);
    }
    Ok(files)
}
