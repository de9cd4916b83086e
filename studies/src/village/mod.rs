//! Adelson et al. 1991, the last rows of Table 1: BSP tree and one z-buffer, scan line, and the
//! simple renderer on a village.
//!
//! The printed times were measured on the authors' machine. Here both ways are timed side by side in one run, and their
//! work is counted. Counts are held to the printed saving; time is held to be saved at all, and the printed percentage
//! is shown beside it.

pub mod boxes;

use crate::adelson::table_1::{Printed, BSP, SCAN_LINE, VILLAGE};
use crate::report::{Check, Report, Row, Table};
use crate::timing::{at_least, least_speed_up, ratio};
use crate::{Experiment, StudyError};
use boxes::{boxes, TRIANGLES};
use std::path::Path;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Eye, Formats};
use wheatstone_golden::picture::{side_by_side, write_png};
use wheatstone_golden::scene::{self, Cull, Geometry, Scene};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::visibility::bsp::{self, Tree, ZBuffer};
use wheatstone_golden::visibility::renderer::Model;
use wheatstone_golden::visibility::{scan_line, Surfaces};
use wheatstone_golden::work::{counted, Counted, Unmetered, Work};

/// Size of the views. The authors do not tell theirs; the more pixels, the less is saved.
const SIZE: [u32; 2] = [320, 240];
/// Size of the views that are also timed.
const LARGE: [u32; 2] = [640, 480];
/// Times that each way is timed.
const ROUNDS: usize = 151;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "village",
    description: "hidden surfaces for both views at once: BSP/z-buffer, scan line, village",
    run,
};

/// The experiment.
fn run(folder: &Path) -> Result<Report, StudyError> {
    let village = scene::open("village", Some(SIZE), None)?;
    let model = Model::new(&village, &formats())?;
    let mut views = model.views();
    model.draw::<f64, 2>(Eye::BOTH, &mut views, &mut Unmetered);
    let file = folder.join("village.png");
    write_png(&file, &side_by_side(&[&views.picture(0), &views.picture(1)]))?;
    Ok(Report {
        experiment: "village".into(),
        publication: "Adelson et al. 1991".into(),
        tables: vec![trees()?, scan_lines(&village, &model)?, renderer(&model)?],
        files: vec![file],
    })
}

fn formats() -> Formats {
    Formats::new(&Config::DEFAULT)
}

/// The polygons of a scene; back faces have been removed beforehand, as the authors do it.
fn geometry(scene: &Scene, cull: Cull) -> Result<Geometry, StudyError> {
    Ok(scene.geometry(&formats(), &scene::Options { cull, ..scene::Options::default() })?)
}

fn surfaces(geometry: &Geometry) -> Result<Surfaces<'_>, StudyError> {
    let job = Job::of(geometry, Config::DEFAULT, Options::new(&Config::DEFAULT), Lookup::Nearest);
    Ok(Surfaces::new(&job)?)
}

/// Measures of the time of two views one by one by that of both at once, given as a ratio. With
/// nothing saved it is one.
fn time_rows(printed: &Printed, what: &str, ratio: f64) -> [Row; 3] {
    let checks = [Check::Trend, Check::Trend, at_least(least_speed_up(printed.i / 100.0))];
    printed.rows(&format!("{what}: time"), 1.0 - 1.0 / ratio, checks)
}

/// Part of the work that is saved, in per cent.
fn saved(what: String, twice: u64, both: u64, check: Check) -> Row {
    Row::new(what, 100.0 * (1.0 - both as f64 / twice as f64), 1, check).unit("%")
}

/// A row of a part of the work that has to be saved at least as the authors' time.
fn part(printed: &Printed, what: &str, twice: u64, both: u64) -> Row {
    saved(format!("{what} saved"), twice, both, Check::AtLeast(printed.i))
}

const ALL_WORK: &str = "not judged: the pixels' work is the same either way and is no part of what the \
    algorithm saves; less is saved of all than is printed (docs/studies.md, Savings of parts and of all)";

/// A row of all that is counted. Pixels are the same either way, so it falls short of its parts, and of
/// the authors' time where they are most of it.
fn total(what: &str, twice: &Work, both: &Work) -> Row {
    let all = |work: &Work| {
        work.operations.all()
            + work.edge_updates
            + work.interpolations
            + work.depth_tests
            + work.pixels_written
    };
    saved(format!("{what}: all work that is counted, saved"), all(twice), all(both), Check::Trend)
        .note(ALL_WORK)
}

/// A row that is 0 where both ways see the same.
fn differing(what: &str, pixels: usize) -> Row {
    Row::new(format!("{what}: pixels that differ"), pixels as f64, 0, Check::AtMost(0.0))
}

/// BSP tree, two traversals, against BSP tree and one z-buffer, one traversal.
fn trees() -> Result<Table, StudyError> {
    let mut rows = Vec::new();
    for polygons in [144, 480, 960] {
        let scene = boxes(polygons / TRIANGLES, SIZE[0], SIZE[1])?;
        let found = Traversals::of(&geometry(&scene, Cull::None)?)?;
        let name = format!("{polygons} polygons");
        rows.extend(time_rows(&BSP, &name, found.ratio));
        let (twice, once) = (found.twice.edge_updates, found.once.edge_updates);
        rows.push(part(&BSP, &format!("{name}: steps of edges"), twice, once));
        rows.push(total(&name, &found.twice, &found.once));
        let what = format!("{name}: pieces a polygon");
        rows.push(Row::new(what, found.pieces, 2, Check::Trend));
        rows.push(found.tests(&name));
        rows.push(differing(&format!("{name}, right view"), found.different[1]));
        // The left one may show another polygon of the same depth.
        let what = format!("{name}, left view: pixels that differ");
        rows.push(Row::new(what, found.different[0] as f64, 0, Check::AtMost(5.0)));
    }
    // The other extreme: most planes pass between the eyes. A tenth of the pixels is tested, which costs
    // several times as much as painting them in order, and few edges are there to be shared.
    let scene = scene::open("exclusive", Some(SIZE), None)?;
    let found = Traversals::of(&geometry(&scene, Cull::None)?)?;
    rows.push(found.tests("exclusive"));
    let what = "exclusive, planes between the eyes, not of the authors' kind: time, III";
    rows.push(Row::new(what, found.ratio, 2, Check::Trend));
    let title = format!("BSP/z-buffer compared to BSP (Table 1), views of {}", size(SIZE));
    Ok(Table { title, rows })
}

/// Two traversals of a tree beside one.
struct Traversals {
    /// Work of two traversals, and of one.
    twice: Work,
    once: Work,
    /// Time of two by that of one.
    ratio: f64,
    /// Pieces a polygon.
    pieces: f64,
    /// Pixels that differ in each view.
    different: [usize; 2],
}

impl Traversals {
    fn of(geometry: &Geometry) -> Result<Traversals, StudyError> {
        let surfaces = surfaces(geometry)?;
        let tree = Tree::new(&surfaces);
        let (mut twice, mut once) = (Work::default(), Work::default());
        let alone = Eye::BOTH.map(|eye| bsp::one(&surfaces, &tree, eye, &mut twice));
        let both = bsp::both(&surfaces, &tree, &mut once);
        let [mut left, mut right] = [(); 2].map(|()| ([surfaces.items()], ZBuffer::default()));
        let (mut items, mut z_buffer) = ([surfaces.items(), surfaces.items()], ZBuffer::default());
        let time = ratio(
            ROUNDS,
            || {
                for (eye, (items, unused)) in [(Eye::Left, &mut left), (Eye::Right, &mut right)] {
                    bsp::draw(&surfaces, &tree, [eye], items, unused, &mut Unmetered);
                }
            },
            || bsp::draw(&surfaces, &tree, Eye::BOTH, &mut items, &mut z_buffer, &mut Unmetered),
        );
        Ok(Traversals {
            twice,
            once,
            ratio: time.of_shortest(),
            pieces: tree.pieces() as f64 / surfaces.opaque.len() as f64,
            different: [0, 1].map(|n: usize| different(&alone[n].item, &both[n].item)),
        })
    }

    /// A row of how much depth decides.
    fn tests(&self, name: &str) -> Row {
        let tests = 100.0 * self.once.depth_tests as f64 / self.once.pixels_written as f64;
        let what = format!("{name}: pixels with a depth test");
        Row::new(what, tests, 2, Check::Trend).unit("%")
    }
}

/// Scan-line hidden surfaces, flat and with Gouraud shading.
fn scan_lines(village: &Scene, model: &Model) -> Result<Table, StudyError> {
    let geometry = geometry(village, Cull::Back)?;
    let surfaces = surfaces(&geometry)?;
    let count = |run: &dyn Fn(&mut Work)| {
        let mut work = Work::default();
        let ((), operations) = counted(|| run(&mut work));
        Work { operations, ..work }
    };
    let one = |eye| count(&|work: &mut Work| drop(scan_line::one::<Counted>(&surfaces, eye, work)));
    let twice = one(Eye::Left) + one(Eye::Right);
    let once = count(&|work: &mut Work| drop(scan_line::both::<Counted>(&surfaces, work)));
    let alone = Eye::BOTH.map(|eye| scan_line::one::<f64>(&surfaces, eye, &mut Unmetered));
    let both = scan_line::both::<f64>(&surfaces, &mut Unmetered);
    let pixels = (0..2).map(|n| different(&alone[n].item, &both[n].item)).sum();
    let [mut a, mut b] = [(); 2].map(|()| [surfaces.items()]);
    let mut items = [surfaces.items(), surfaces.items()];
    let time = ratio(
        ROUNDS,
        || {
            scan_line::draw_items::<f64, 1>(&surfaces, [Eye::Left], &mut a, &mut Unmetered);
            scan_line::draw_items::<f64, 1>(&surfaces, [Eye::Right], &mut b, &mut Unmetered);
        },
        || scan_line::draw_items::<f64, 2>(&surfaces, Eye::BOTH, &mut items, &mut Unmetered),
    );
    let mut rows = time_rows(&SCAN_LINE, "hidden surfaces", time.of_shortest()).to_vec();
    rows.push(part(
        &SCAN_LINE,
        "hidden surfaces: updates of edge lists",
        twice.edge_updates,
        once.edge_updates,
    ));
    let edges = |work: &Work| work.interpolations - work.depth_tests;
    rows.push(part(
        &SCAN_LINE,
        "hidden surfaces: interpolations along edges",
        edges(&twice),
        edges(&once),
    ));
    rows.push(total("hidden surfaces", &twice, &once));
    rows.push(differing("hidden surfaces", pixels));

    // Lit and projected beforehand.
    let vertices = model.vertices::<f64, 2>(Eye::BOTH);
    let [mut a, mut b] = [(); 2].map(|()| model.views::<1>());
    let mut views = model.views::<2>();
    let time = ratio(
        ROUNDS,
        || {
            model.scan::<f64, 1>([Eye::Left], &vertices, &mut a, &mut Unmetered);
            model.scan::<f64, 1>([Eye::Right], &vertices, &mut b, &mut Unmetered);
        },
        || model.scan::<f64, 2>(Eye::BOTH, &vertices, &mut views, &mut Unmetered),
    );
    // Only the percentage is printed, in the text.
    let what = "with Gouraud shading: time";
    let part = 100.0 * (1.0 - 1.0 / time.of_shortest());
    let row = Row::new(format!("{what}, I"), part, 0, Check::Trend).printed(17.0);
    rows.push(row.unit("%"));
    let check = at_least(least_speed_up(0.17));
    rows.push(Row::new(format!("{what}, III"), time.of_shortest(), 2, check).expected(1.2));
    let title = format!("Scan-line hidden surface (Table 1), village, views of {}", size(SIZE));
    Ok(Table { title, rows })
}

/// The simple renderer's work for two views one by one and for both at once, and pixels that differ.
fn draw(model: &Model) -> ([Work; 2], usize) {
    let [mut twice, mut once] = [Work::default(); 2];
    let [mut left, mut right] = [(); 2].map(|()| model.views::<1>());
    let mut both = model.views::<2>();
    let ((), operations) = counted(|| {
        model.draw::<Counted, 1>([Eye::Left], &mut left, &mut twice);
        model.draw::<Counted, 1>([Eye::Right], &mut right, &mut twice);
    });
    twice.operations = operations;
    let ((), operations) = counted(|| model.draw::<Counted, 2>(Eye::BOTH, &mut both, &mut once));
    once.operations = operations;
    let pixels = different(&left.colours[0], &both.colours[0])
        + different(&right.colours[0], &both.colours[1]);
    ([twice, once], pixels)
}

/// The simple renderer.
fn renderer(model: &Model) -> Result<Table, StudyError> {
    let ([twice, once], pixels) = draw(model);
    let mut rows = vec![
        Row::new("triangles", model.triangles() as f64, 0, Check::Within(0.05)).printed(1100.0)
    ];
    rows.extend(time_rows(&VILLAGE, "village", time(model)));
    rows.push(part(
        &VILLAGE,
        "village: arithmetic of projection, edges and spans",
        twice.operations.arithmetic(),
        once.operations.arithmetic(),
    ));
    rows.push(part(
        &VILLAGE,
        "village: updates of edge lists",
        twice.edge_updates,
        once.edge_updates,
    ));
    let what = "village: interpolations saved, those of pixels included";
    rows.push(saved(what.into(), twice.interpolations, once.interpolations, Check::Trend));
    rows.push(total("village", &twice, &once));
    rows.push(differing("village", pixels));
    let large = Model::new(&scene::open("village", Some(LARGE), None)?, &formats())?;
    let what = format!("village, {}", size(LARGE));
    rows.extend(time_rows(&VILLAGE, &what, time(&large)));
    let ([twice, once], pixels) = draw(&large);
    rows.push(total(&what, &twice, &once));
    rows.push(differing(&what, pixels));
    let title = format!("Simple renderer (Table 1), village, views of {}", size(SIZE));
    Ok(Table { title, rows })
}

/// Time of two runs for one view by that of one for both.
fn time(model: &Model) -> f64 {
    let [mut left, mut right] = [(); 2].map(|()| model.views::<1>());
    let mut both = model.views::<2>();
    let time = ratio(
        ROUNDS,
        || {
            model.draw::<f64, 1>([Eye::Left], &mut left, &mut Unmetered);
            model.draw::<f64, 1>([Eye::Right], &mut right, &mut Unmetered);
        },
        || model.draw::<f64, 2>(Eye::BOTH, &mut both, &mut Unmetered),
    );
    time.of_shortest()
}

/// Number of elements that differ.
fn different(a: &[u32], b: &[u32]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

fn size([width, height]: [u32; 2]) -> String {
    format!("{width} × {height}")
}
