//! Adelson et al. 1991, "Simultaneous Generation of Stereoscopic Views": its Table 1 and its
//! counts. The rows of hidden surfaces and of the village belong to another experiment.

pub(crate) mod table_1;
mod work;

use crate::errata::{self, TOWER};
use crate::timing::{at_least, least_speed_up, Ratio};
use crate::{Check, Experiment, Report, Row, StudyError, Table};
use std::path::Path;
use table_1::{Printed, FACES, FLAT, GOURAUD, LINES, POLYGONS, PROJECTION};
use wheatstone_golden::work::{counted, Counted, Operations, Work};
use work::{time, work, Drawing, Faces, Lines, Polygons, Projection};

/// Things of each kind that are worked on.
const ITEMS: usize = 1000;
/// Rounds of timing.
const ROUNDS: usize = 101;

/// A triangle of 11 rows with 22 edge and 211 interior pixels.
const FLAT_TRIANGLE: [[f64; 2]; 3] = [[10.0, 21.0], [51.5, 21.0], [21.0, 10.0]];
/// A tower of 29 rows with 58 edge and 105 interior pixels.
const TOWER_SHAPE: [[f64; 2]; 4] = [[10.0, 10.0], [14.25, 10.0], [17.0, 39.0], [10.0, 39.0]];
/// 50 rows of two pixels.
const TWO_PIXELS_WIDE: [[f64; 2]; 4] = [[10.0, 10.0], [12.0, 10.0], [12.0, 60.0], [10.0, 60.0]];
/// A large square.
const SQUARE: [[f64; 2]; 4] = [[10.0, 10.0], [240.0, 10.0], [240.0, 240.0], [10.0, 240.0]];

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "adelson",
    description: "both views at once: Adelson et al., Table 1 but for hidden surfaces",
    run,
};

/// Runs the experiment.
fn run(_: &Path) -> Result<Report, StudyError> {
    Ok(Report {
        experiment: "adelson".into(),
        publication: "Adelson, Bentley, Chong, Hodges, Winograd 1991".into(),
        tables: vec![savings(), operations(), interpolations(), times()],
        files: Vec::new(),
    })
}

/// The part of the work done separately that is saved.
fn saved([separately, together]: [Work; 2], count: impl Fn(&Work) -> u64) -> f64 {
    1.0 - count(&together) as f64 / count(&separately) as f64
}

/// Checks of a saving of work against the printed ones.
fn checks(printed: &Printed, check: fn(f64) -> Check) -> [Check; 3] {
    [printed.i, printed.ii, printed.corrected].map(check)
}

/// To the digits that are printed.
fn digits(_: f64) -> Check {
    Check::Digits
}

/// The flat triangle's measures: its interpolations save 4.58 %.
fn flat_triangle(saving: f64) -> [Row; 3] {
    let [first, second, third] =
        GOURAUD[0].rows("Gouraud polygon, flat triangle", saving, [Check::Digits; 3]);
    [first.corrected(4.6, errata::FLAT_TRIANGLE), second, third]
}

fn savings() -> Table {
    let arithmetic = |work: &Work| work.operations.arithmetic();
    let upkeep = |work: &Work| work.edge_updates + work.interpolations;
    let fill = |work: &Work| upkeep(work) + work.pixels_written;
    let interpolations = |work: &Work| work.interpolations;
    let clips = |work: &Work| work.boundary_clips;
    let all = |work: &Work| work.operations.all();

    let projection = saved(work(&Projection::<Counted>::new(ITEMS)), arithmetic);
    let few_sides = saved(work(&Drawing::<0>::of(&SQUARE)), fill);
    let many_sides = saved(work(&Drawing::<0>::random(ITEMS, 15, 60.0)), upkeep);
    let triangle = saved(work(&Drawing::<3>::of(&FLAT_TRIANGLE)), interpolations);
    let narrow = saved(work(&Drawing::<3>::of(&TWO_PIXELS_WIDE)), interpolations);
    let lines = saved(work(&Lines::<f64>::new(ITEMS, true)), clips);
    let polygons = saved(work(&Polygons::<Counted>::new(ITEMS)), all);
    let faces = saved(work(&Faces::<Counted>::new(ITEMS)), arithmetic);
    let least = Check::AtLeast;
    let rows = |what: &str, printed: &Printed, saving: f64, check: fn(f64) -> Check| {
        printed.rows(what, saving, checks(printed, check))
    };
    // Less than 1 % saved is up to 1.01 times as fast.
    let slightly = [Check::AtMost(1.0), Check::AtMost(1.0), Check::AtMost(1.01)];
    let rows = [
        rows("projection", &PROJECTION, projection, digits),
        Printed::less_than_1().rows("flat polygon, 4 sides", few_sides, slightly),
        rows("flat polygon, 15 sides, edges", &FLAT, many_sides, least),
        flat_triangle(triangle),
        rows("Gouraud polygon, narrow", &GOURAUD[1], narrow, digits),
        rows("line clipping", &LINES, lines, digits),
        rows("polygon clipping", &POLYGONS, polygons, least),
        rows("back faces", &FACES, faces, digits),
    ];
    let title =
        "Table 1, savings of work by measures I, II and III; hidden surfaces: experiment village";
    Table { title: title.into(), rows: rows.into_iter().flatten().collect() }
}

/// A number of operations for one thing that is worked on.
fn each(what: &str, count: u64) -> Row {
    Row::new(what, count as f64 / ITEMS as f64, 0, Check::Digits)
}

/// Rows of additions, and of multiplications and divisions, which the publication counts together;
/// their sum follows.
fn arithmetic(what: &str, done: &Operations, [additions, multiplications]: [f64; 2]) -> [Row; 3] {
    let products = done.multiplications + done.divisions;
    [
        each(&format!("{what}, additions"), done.additions).printed(additions),
        each(&format!("{what}, multiplications"), products).printed(multiplications),
        each(&format!("{what}, arithmetic"), done.arithmetic())
            .expected(additions + multiplications),
    ]
}

fn operations() -> Table {
    let [separately, together] =
        work(&Projection::<Counted>::new(ITEMS)).map(|work| work.operations);
    let mut rows = arithmetic("projection, separately", &separately, [4.0, 8.0]).to_vec();
    rows.extend(arithmetic("projection, together", &together, [3.0, 5.0]));
    let faces = Faces::<Counted>::new(ITEMS);
    let [separately, together] = work(&faces).map(|work| work.operations);
    rows.extend(arithmetic("back faces, separately", &separately, [6.0, 6.0]));
    rows.push(each("back faces, separately, comparisons", separately.comparisons).printed(2.0));
    rows.extend(arithmetic("back faces, together", &together, [4.0, 4.0]));
    let mut deciding = faces.clone();
    let ((), decided) = counted(|| deciding.decided());
    let comparisons = (decided.comparisons as f64 / ITEMS as f64).ceil();
    let decided = decided.all() as f64 / ITEMS as f64;
    let most = |what: &str, n: f64, most: f64| Row::new(what, n, 1, Check::AtMost(most));
    rows.extend([
        Row::new("back faces, by decisions, comparisons at most", comparisons, 0, Check::Digits)
            .printed(3.0),
        each("back faces, separately, all", separately.all()).expected(14.0),
        Row::new("back faces, by decisions, all, at most", decided.ceil(), 0, Check::Digits)
            .expected(11.0),
        most("back faces, by decisions, all", decided, 11.0),
        most("back faces, together, all", together.all() as f64 / ITEMS as f64, 10.0),
    ]);
    let [separately, together] = work(&Lines::<f64>::new(ITEMS, true));
    let random = work(&Lines::<f64>::new(ITEMS, false));
    let saved_at_random = 100.0 * saved(random, |work| work.boundary_clips);
    let [random_separately, random_together] =
        random.map(|work| work.boundary_clips as f64 / ITEMS as f64);
    rows.extend([
        each("line within the window, boundary clips, separately", separately.boundary_clips)
            .printed(8.0),
        each("line within the window, boundary clips, together", together.boundary_clips)
            .printed(6.0),
        Row::new(
            "random line, boundary clips, separately",
            random_separately,
            2,
            Check::AtMost(8.0),
        ),
        Row::new("random line, boundary clips, together", random_together, 2, Check::AtMost(6.0)),
        Row::new("random lines, boundary clips saved", saved_at_random, 1, Check::AtLeast(25.0))
            .printed(25.0)
            .unit("%"),
        Row::new("random lines, boundary clips saved, at most", saved_at_random, 1, {
            Check::AtMost(28.5)
        })
        .unit("%"),
    ]);
    Table { title: "Operations for one point, plane or line".into(), rows }
}

/// Interpolations of a polygon, and its edge and interior pixels in each view.
struct Interpolations {
    separately: u64,
    together: u64,
    edge: u64,
    interior: u64,
}

impl Interpolations {
    fn of(corners: &[[f64; 2]]) -> Interpolations {
        let done = work(&Drawing::<3>::of(corners)).map(|work| work.interpolations);
        let [separately, together] = done;
        // 2(4E + 3I) less 5E + 6I are 3E.
        let edge = (separately - together) / 3;
        Interpolations { separately, together, edge, interior: (together - 5 * edge) / 6 }
    }
}

fn interpolations() -> Table {
    let count = |what: &str, count: u64, printed: u64| {
        Row::new(what, count as f64, 0, Check::Digits).printed(printed as f64)
    };
    let triangle = Interpolations::of(&FLAT_TRIANGLE);
    let tower = Interpolations::of(&TOWER_SHAPE);
    let narrow = Interpolations::of(&TWO_PIXELS_WIDE);
    let percent = |what: &str, of: &Interpolations| {
        let saved = 100.0 * (1.0 - of.together as f64 / of.separately as f64);
        Row::new(what, saved, 1, Check::Digits).unit("%")
    };
    // Edge pixels come in pairs: no polygon has 29 of them.
    let [edge, interior] = [29, 105];
    let rows = vec![
        count("flat triangle, edge pixels", triangle.edge, 22),
        count("flat triangle, interior pixels", triangle.interior, 211),
        count("flat triangle, separately", triangle.separately, 1442),
        count("flat triangle, together", triangle.together, 1376),
        count("tower, edge pixels", tower.edge, 58),
        count("tower, interior pixels", tower.interior, 105),
        count("tower, separately", tower.separately, 862).corrected(1094.0, TOWER),
        count("tower, together", tower.together, 775).corrected(920.0, TOWER),
        count("29 edge pixels by the formula, separately", 2 * (4 * edge + 3 * interior), 862),
        count("29 edge pixels by the formula, together", 5 * edge + 6 * interior, 775),
        percent("flat triangle, saved", &triangle)
            .printed(4.5)
            .corrected(4.6, errata::FLAT_TRIANGLE),
        percent("tower, saved", &tower).printed(10.0).corrected(15.9, TOWER),
        percent("two pixels wide, saved", &narrow).printed(37.5),
    ];
    Table { title: "Interpolations of Gouraud polygons in both views".into(), rows }
}

/// Time separately : time together, of the same data whose saving of work is counted: above 10 % it
/// must be faster.
fn times() -> Table {
    let mut rows = Vec::new();
    let mut add = |what: &str, printed: Option<Printed>, saving: f64, ratio: Ratio| {
        let check = at_least(least_speed_up(saving));
        rows.push(match printed {
            Some(printed) => printed.speed_up(what, ratio.of_shortest(), check),
            None => Row::new(what, ratio.of_shortest(), 2, check),
        });
    };
    let counts = |work: &Work| work.edge_updates + work.interpolations + work.pixels_written;
    let projection = Projection::<f64>::new(ITEMS);
    add("projection", Some(PROJECTION), 1.0 / 3.0, time(ROUNDS, &projection));
    for sides in [4, 8, 15, 32] {
        for (size, count, reach) in [("small", 500, 10.0), ("large", 50, 60.0)] {
            let what = format!("flat polygons, {size}, {sides} sides");
            let drawing = Drawing::<0>::random(count, sides, reach);
            let counted = saved(work(&drawing), counts);
            // A quarter is printed for 15 sides and more, whatever the pixels.
            let (printed, saving) =
                if sides < 15 { (None, counted) } else { (Some(FLAT), counted.max(0.25)) };
            add(&what, printed, saving, time(ROUNDS, &drawing));
        }
    }
    for sides in [4, 8, 15, 32] {
        for (size, count, reach) in [("small", 200, 10.0), ("large", 20, 60.0)] {
            let what = format!("Gouraud polygons, {size}, {sides} sides");
            let drawing = Drawing::<3>::random(count, sides, reach);
            let saving = saved(work(&drawing), |work| work.interpolations);
            add(&what, None, saving, time(ROUNDS, &drawing));
        }
    }
    for (what, corners, printed) in [
        ("Gouraud, flat triangle", &FLAT_TRIANGLE[..], Some(GOURAUD[0])),
        ("Gouraud, tower", &TOWER_SHAPE, None),
        ("Gouraud, two pixels wide", &TWO_PIXELS_WIDE, Some(GOURAUD[1])),
    ] {
        let drawing = Drawing::<3>::of(corners);
        let saving = saved(work(&drawing), |work| work.interpolations);
        add(what, printed, saving, time(ROUNDS, &drawing));
    }
    let lines = Lines::<f64>::new(ITEMS, false);
    let saving = saved(work(&lines), |work| work.boundary_clips);
    add("line clipping", Some(LINES), saving, time(ROUNDS, &lines));
    let polygons = Polygons::<f64>::new(ITEMS);
    let saving = saved(work(&Polygons::<Counted>::new(ITEMS)), |work| work.operations.all());
    add("polygon clipping", Some(POLYGONS), saving, time(ROUNDS, &polygons));
    add("back faces", Some(FACES), 1.0 / 3.0, time(ROUNDS, &Faces::<f64>::new(ITEMS)));
    Table { title: "Time separately : time together, measure III".into(), rows }
}
