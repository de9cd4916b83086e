//! NASA's depth-viewing volume (1992): fields of view, projection matrices, distance maps, and one scene
//! in every projection.
//!
//! Perceived distances are not computed from the maps but triangulated from pixels: where the lines of
//! sight from both eyes through a point's two images meet. Distances in the scene are in feet, on the
//! viewer's side in inches.

use crate::errata::{LINEAR, ROW_4, SIMILAR_TRIANGLES, SUBTRACT, WHOLE_DEGREES, WIDTH};
use crate::plot::{self, Series};
use crate::{Check, Experiment, Report, Row, StudyError, Table};
use std::path::{Path, PathBuf};
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::picture::{frame_picture, Composite, Views};
use wheatstone_golden::projection::{
    multiply, transform, Asymptotic, Clipping, Kind, Partition, Piecewise, Projection,
    ProjectionMatrix, Screen, Viewer,
};
use wheatstone_golden::scene::{self, open_projected, Camera, Rig};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// Inches: the distance of the screen, that between the eyes, and half of the screen's field of view.
const SD: f64 = 19.0;
const IPD: f64 = 2.5;
const HALF_FIELD: f64 = 20.0;
/// The example of an asymptotic projection: 150 ft at the screen (figure 6), and the least and the greatest
/// distance perceived.
const SI: f64 = 150.0;
const MIND: f64 = 14.0;
const MAXD: f64 = 43.0;
/// A far clipping plane in feet.
const FCP: f64 = 6000.0;
/// Pixels of the views across and down in which distances are measured.
const PIXELS: [u32; 2] = [640, 480];

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "nasa",
    description:
        "NASA 1992: table I, projection matrices, distance maps, the scene in every projection",
    run,
};

/// Runs the experiment.
fn run(folder: &Path) -> Result<Report, StudyError> {
    let tables = vec![
        fields_of_view(),
        matrices("Appendix A: the asymptotic matrix (A9)", &asymptotic()),
        matrices("Appendix B: the piecewise matrix (B9), first partition", &piecewise()),
        asymptotic_map(),
        figure_7(),
    ];
    let mut files = plots(folder)?;
    for kind in Kind::ALL {
        files.push(picture(folder, kind)?);
    }
    Ok(Report {
        experiment: "nasa".into(),
        publication: "NASA 1992, depth-viewing volume".into(),
        tables,
        files,
    })
}

/// The screen of table I: as wide as its field of view says.
fn screen() -> Screen {
    let width = 2.0 * SD * HALF_FIELD.to_radians().tan();
    Screen { width, distance: SD, eye_distance: IPD }
}

fn fields_of_view() -> Table {
    let screen = screen();
    let mut rows = vec![Row::new("width of the screen", screen.width, 2, Check::Digits)
        .printed(12.4)
        .corrected(13.83, WIDTH)
        .unit("in")];
    // Left monocular, stereo, right monocular, total.
    let printed = [
        (Clipping::Symmetric, "nearest", [30.8, 0.0, 30.8, 61.6]),
        (Clipping::Symmetric, "screen", [7.0, 26.0, 7.0, 40.0]),
        (Clipping::Symmetric, "infinity", [0.0, 33.2, 0.0, 33.2]),
        (Clipping::Asymmetric, "nearest", [36.0, 0.0, 36.0, 72.0]),
        (Clipping::Asymmetric, "screen", [0.0, 40.0, 0.0, 40.0]),
        (Clipping::Asymmetric, "infinity", [6.65, 33.2, 6.65, 46.5]),
    ];
    for (clipping, place, cells) in printed {
        let distance = match place {
            "nearest" => screen.nearest(clipping),
            "screen" => SD,
            _ => f64::INFINITY,
        };
        if place == "nearest" {
            let expected = if clipping == Clipping::Symmetric { 4.192 } else { 2.909 };
            let what = format!("{clipping:?}, nearest distance");
            rows.push(Row::new(what, distance, 3, Check::Digits).expected(expected).unit("in"));
        }
        let seen = screen.field_of_view(clipping, distance);
        let parts = [
            ("left", seen.left),
            ("stereo", seen.stereo),
            ("right", seen.right),
            ("total", seen.total()),
        ];
        for ((part, here), cell) in parts.into_iter().zip(cells) {
            let what = format!("{clipping:?}, {place}, {part}");
            rows.push(cell_of(&what, here.abs(), cell));
        }
    }
    Table { title: "Table I: perceived horizontal field of view".into(), rows }
}

/// A cell of table I. Those printed to whole degrees have their next digit corrected.
fn cell_of(what: &str, here: f64, printed: f64) -> Row {
    let exact = [(7.0, 6.9), (26.0, 26.2), (36.0, 36.1), (72.0, 72.1)];
    let digits = if printed == 6.65 { 2 } else { 1 };
    let row = Row::new(what, here, digits, Check::Digits).printed(printed).unit("deg");
    match exact.into_iter().find(|(whole, _)| *whole == printed) {
        Some((_, corrected)) => row.corrected(corrected, WHOLE_DEGREES),
        None => row,
    }
}

/// The asymptotic example.
fn asymptotic() -> Rig {
    rig(Projection::Asymptotic(Asymptotic {
        screen_intercept: Some(SI),
        screen_distance: Some(SD),
        max_distance: Some(MAXD),
        min_distance: Some(MIND),
        eye_distance: Some(IPD),
    }))
}

/// The four partitions of figure 7, whose distances are not printed: stereo, flat at the screen, stereo,
/// flat at the far limit.
fn partitions() -> Vec<Partition> {
    let borders = [(50.0, 100.0, MIND, SD), (100.0, 150.0, SD, SD), (150.0, 300.0, SD, MAXD)];
    let last = (300.0, FCP, MAXD, MAXD);
    let partition = |(near, far, min_distance, max_distance)| Partition {
        near,
        far,
        min_distance,
        max_distance,
    };
    borders.into_iter().chain([last]).map(partition).collect()
}

fn piecewise() -> Rig {
    rig(Projection::Piecewise(Piecewise {
        screen_distance: Some(SD),
        eye_distance: Some(IPD),
        partitions: partitions(),
    }))
}

fn rig(projection: Projection) -> Rig {
    Rig {
        pixels_per_unit: f64::from(PIXELS[0]) / screen().width,
        viewing_distance: SI,
        far: Some(FCP),
        projection,
        ..Rig::default()
    }
}

/// A rig's camera, and what the eyes make of its pictures.
struct Observer {
    camera: Camera,
    viewer: Viewer,
    rig: Rig,
}

impl Observer {
    fn new(rig: Rig) -> Observer {
        let formats = Formats::new(&Config::DEFAULT);
        let viewer = rig.viewer();
        Observer { camera: Camera::new(&rig, PIXELS[0], PIXELS[1], &formats), viewer, rig }
    }

    /// Perceived distance of a point straight ahead, from the pixels of its images.
    fn seen(&self, distance: f64) -> f64 {
        let p = [0.0, 0.0, distance - self.rig.viewing_distance];
        self.met(Eye::BOTH.map(|eye| self.camera.pixel(p, eye)[0]))
    }

    /// Distance at which lines of sight through columns of the two pictures meet.
    fn met(&self, [left, right]: [f64; 2]) -> f64 {
        let disparity = (right - left) / self.rig.pixels_per_unit;
        let Viewer { eye_distance, screen_distance } = self.viewer;
        screen_distance * eye_distance / (eye_distance - disparity)
    }
}

fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |largest, n| largest.max(n.abs()))
}

/// A projection matrix against its eight steps, against points, and against the camera.
fn matrices(title: &str, rig: &Rig) -> Table {
    let observer = Observer::new(rig.clone());
    let range = rig.ranges()[0];
    let [width, height] = PIXELS.map(|n| f64::from(n) / rig.pixels_per_unit);
    let (viewer, map) = (observer.viewer, range.map);
    let projection =
        ProjectionMatrix { viewer, map, near: range.near, far: range.far, width, height };
    let mut worst = [0.0f64; 3];
    for eye in Eye::BOTH {
        let matrix = projection.matrix(eye);
        let [first, rest @ ..] = projection.steps(eye);
        let product = rest.iter().fold(first, |product, step| multiply(&product, step));
        let cells = matrix.iter().flatten().zip(product.iter().flatten());
        worst[0] = worst[0].max(largest(cells.map(|(a, b)| a - b)));
        for n in 0..1000 {
            let part = f64::from(n) / 1000.0;
            let distance = 1.0 / ((1.0 - part) / range.near + part / range.far);
            let [x, y] = [0.3 * distance * (part - 0.5), 0.2 * distance * (0.5 - part)];
            let seen = transform([x, y, -distance], &matrix);
            let point = projection.point([x, y, distance], eye);
            worst[1] = worst[1].max(largest((0..3).map(|k| seen[k] - point[k])));
            let [column, row] = observer.camera.pixel([x, y, distance - rig.viewing_distance], eye);
            let [half_width, half_height] = PIXELS.map(|n| f64::from(n) / 2.0);
            let pixels =
                [column - half_width * (1.0 + seen[0]), row - half_height * (1.0 - seen[1])];
            worst[2] = worst[2].max(largest(pixels.into_iter()));
        }
    }
    let matrix = projection.matrix(Eye::Left);
    let seen = |distance: f64| transform([0.0, 0.0, -distance], &matrix);
    let near = viewer.disparity(map.perceived(range.near)) / width;
    let row = |what: &str, here| Row::new(what, here, 4, Check::Digits);
    let rows = vec![
        Row::new("matrix - product of its steps, largest", worst[0], 16, Check::AtMost(1e-12)),
        Row::new("matrix - point formulas, largest", worst[1], 16, Check::AtMost(1e-12)),
        Row::new("matrix - camera, largest", worst[2], 16, Check::AtMost(1e-9)).unit("px"),
        row("z at NCP", seen(range.near)[2]).corrected(-1.0, ROW_4),
        row("z at FCP", seen(range.far)[2]).corrected(1.0, ROW_4),
        row("x at NCP, left eye", seen(range.near)[0]).corrected(-near, ROW_4),
    ];
    Table { title: title.into(), rows }
}

fn asymptotic_map() -> Table {
    let rig = asymptotic();
    let near = rig.near();
    let observer = Observer::new(rig);
    let of = |max_distance: f64| {
        let parameters = Asymptotic {
            screen_intercept: Some(SD),
            screen_distance: Some(SD),
            max_distance: Some(max_distance),
            eye_distance: Some(IPD),
            ..Asymptotic::default()
        };
        Observer::new(Rig { far: None, ..self::rig(Projection::Asymptotic(parameters)) })
    };
    let row = |what: &str, here| Row::new(what, here, 4, Check::Digits).unit("in");
    // What the publication's formulas give; it prints no distances.
    let ncp = (SI * MIND * MAXD - SI * SD * MIND) / (SD * MAXD - SD * MIND);
    let map = |d: f64| d * SD * MAXD / (d * SD + SI * MAXD - SI * SD);
    let pot = observer.viewer.projection_offset(&observer.rig.ranges()[0].map);
    let triangle = SD / (IPD / 2.0 * (SD / MIND - SD / MAXD));
    let rows = vec![
        row("MIND: d at NCP", observer.seen(near)).expected(MIND),
        row("SD: d at SI", observer.seen(SI)).expected(SD),
        row("MAXD: d at infinity", observer.seen(1e12)).expected(MAXD),
        row("d at 100 ft", observer.seen(100.0)).expected(map(100.0)),
        row("d at 600 ft", observer.seen(600.0)).expected(map(600.0)),
        row("NCP", near).expected(ncp).unit("ft"),
        row("SI = SD: d at 100 in", of(MAXD).seen(100.0))
            .corrected(100.0 * MAXD / (100.0 + MAXD - SD), SUBTRACT),
        row("SI = SD, no MAXD: d at 100 in", of(f64::INFINITY).seen(100.0)).expected(100.0),
        row("SD/(VPT - y) = NCP/POT", near / pot).corrected(triangle, SIMILAR_TRIANGLES).unit(""),
    ];
    let title = format!("Appendix A: distance map, SI {SI} ft, MIND {MIND} in, MAXD {MAXD} in");
    Table { title, rows }
}

fn figure_7() -> Table {
    let observer = Observer::new(piecewise());
    let flat = |partition: &&Partition| partition.min_distance == partition.max_distance;
    let count = |what: &str, n: usize| Row::new(what, n as f64, 0, Check::Digits);
    let mut rows = vec![
        count("partitions", observer.camera.lenses().len()).expected(4.0),
        count("flat partitions", partitions().iter().filter(flat).count()).expected(2.0),
    ];
    for (n, (partition, lens)) in partitions().iter().zip(observer.camera.lenses()).enumerate() {
        let Partition { near, far, min_distance, max_distance } = *partition;
        let seen = |distance: f64| {
            let p = [0.0, 0.0, distance - SI];
            observer.met(Eye::BOTH.map(|eye| lens.pixel(p, eye)[0]))
        };
        let row = |what: String, here, expected| {
            let row = Row::new(format!("partition {}: {what}", n + 1), here, 4, Check::Digits);
            row.expected(expected).unit("in")
        };
        rows.push(row(format!("d at NCP, {near} ft"), seen(near), min_distance));
        rows.push(row(format!("d at FCP, {far} ft"), seen(far), max_distance));
        if min_distance < max_distance {
            let middle = (near + far) / 2.0;
            let inverse = 1.0 / middle;
            let part = (1.0 / near - inverse) / (1.0 / near - 1.0 / far);
            let exact = 1.0 / ((1.0 - part) / min_distance + part / max_distance);
            let half_way = row(format!("d at {middle} ft"), seen(middle), exact);
            rows.push(half_way.because(LINEAR));
        }
    }
    let proportional =
        Partition { near: 50.0, far: 100.0, min_distance: SD, max_distance: 2.0 * SD };
    let parameters = Piecewise {
        screen_distance: Some(SD),
        eye_distance: Some(IPD),
        partitions: vec![proportional],
    };
    let linear = Observer::new(rig(Projection::Piecewise(parameters)));
    let row = Row::new("FCP MIND = NCP MAXD: d at 75 ft", linear.seen(75.0), 4, Check::Digits);
    rows.push(row.expected(1.5 * SD).unit("in"));
    Table { title: "Figure 7: four partitions, two of them flat".into(), rows }
}

/// Plots of the maps and of the fields of view.
fn plots(folder: &Path) -> Result<Vec<PathBuf>, StudyError> {
    let (asymptotic, piecewise) = (Observer::new(asymptotic()), Observer::new(piecewise()));
    let curve = |observer: &Observer, from: f64| -> Vec<(f64, f64)> {
        let steps = (0..=300).map(|n| from + (600.0 - from) * f64::from(n) / 300.0);
        steps.map(|distance| (distance, observer.seen(distance))).collect()
    };
    let axes = ["distance in the scene / ft", "perceived distance / in"];
    let [map, pieces, fields] = ["distance_map.svg", "piecewise_map.svg", "fields_of_view.svg"]
        .map(|name| folder.join(name));
    let name = format!("asymptotic: {SI} ft at the screen, infinity at {MAXD} in");
    let asymptotic = Series::new(name, curve(&asymptotic, asymptotic.rig.near()));
    let limit =
        |name: &str, d: f64| Series::new(format!("{name}, {d} in"), vec![(0.0, d), (600.0, d)]);
    let limits = [limit("MIND", MIND), limit("SD", SD), limit("MAXD", MAXD)];
    let series = [std::slice::from_ref(&asymptotic), &limits[..]].concat();
    plot::lines(&map, "Asymptotic projection", axes, &series)?;
    let four = Series::new("four partitions", curve(&piecewise, 50.0));
    plot::lines(&pieces, "Piecewise projection", axes, &[four, asymptotic])?;

    let screen = screen();
    let mut series = Vec::new();
    for clipping in [Clipping::Symmetric, Clipping::Asymmetric] {
        let nearest = screen.nearest(clipping);
        let field = |distance: f64| screen.field_of_view(clipping, distance);
        let distances = || (0..=300).map(|n| nearest + (60.0 - nearest) * f64::from(n) / 300.0);
        let stereo = distances().map(|d| (d, field(d).stereo)).collect();
        let total = distances().map(|d| (d, field(d).total())).collect();
        let both = [("stereo", stereo), ("total", total)];
        let both = both.map(|(part, points)| Series::new(format!("{clipping:?}: {part}"), points));
        // With symmetric clipping the total is that of one of these on either side of the screen.
        let over = clipping == Clipping::Asymmetric;
        series.extend(both.map(|series| if over { series.dashed() } else { series }));
    }
    let axes = ["perceived distance / in", "horizontal field of view / degrees"];
    plot::lines(&fields, "Fields of view", axes, &series)?;
    Ok(vec![map, pieces, fields])
}

/// The room through a projection, both views side by side.
fn picture(folder: &Path, kind: Kind) -> Result<PathBuf, StudyError> {
    let scene = open_projected("room", Some([400, 300]), None, Some(kind))?;
    let config = Config::DEFAULT;
    let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default())?;
    let job = Job::of(&geometry, config, Options::new(&config), Lookup::Bilinear);
    let [left, right] = job.direct().map(|frame| frame_picture(&frame));
    let file = folder.join(format!("room_{}.png", kind.name()));
    Composite::Parallel.write(&file, &Views { left: &left, right: &right }, None)?;
    Ok(file)
}
