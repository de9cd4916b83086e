//! Adelson et al. 1991, "Simultaneous Generation of Stereoscopic Views": its Table 1 and its
//! counts. The rows of hidden surfaces and of the village belong to another experiment.

mod work;

use crate::{Check, Experiment, Report, Row, StudyError, Table};
use std::path::Path;
use wheatstone_golden::work::{counted, Counted, Work};
use work::{time, work, Drawing, Faces, Lines, Polygons, Projection};

/// Errata, at length in `docs/errata.md`.
const COLUMN_III: &str = "column III is printed as 1 + II; by its own definition it is 1/(1 − I)";
const TOWER: &str = "862 and 775 follow from 29 edge pixels; the tower has 58";

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

/// What a printed saving is held to.
enum Bound {
    /// It is met to the digits that are printed.
    Digits,
    /// It is reached or exceeded.
    Least,
    /// It is not exceeded.
    Most,
}

/// Measures I, II and III of one algorithm: printed ones, the corrected III, and a saving.
fn measures(what: &str, printed: [f64; 3], speed_up: f64, saving: f64, bound: Bound) -> [Row; 3] {
    let check = |reference: f64| match bound {
        Bound::Digits => Check::Digits,
        Bound::Least => Check::AtLeast(reference),
        Bound::Most => Check::AtMost(reference),
    };
    let percent = |measure: &str, printed: f64, here: f64| {
        let digits = usize::from(printed.fract() != 0.0);
        let what = format!("{what}, {measure}");
        Row::new(what, 100.0 * here, digits, check(printed)).printed(printed).unit("%")
    };
    let row = Row::new(format!("{what}, III"), 1.0 / (1.0 - saving), 2, check(speed_up));
    let third = row.printed(printed[2]);
    [
        percent("I", printed[0], saving),
        percent("II", printed[1], 2.0 * saving),
        if speed_up == printed[2] { third } else { third.corrected(speed_up, COLUMN_III) },
    ]
}

/// The flat triangle's measures: its interpolations save 4.58 %.
fn flat_triangle(saving: f64) -> [Row; 3] {
    let [first, second, third] =
        measures("Gouraud polygon, flat", [4.5, 9.0, 1.1], 1.05, saving, Bound::Digits);
    let first = Row { digits: 1, ..first }.corrected(4.6, "1442 to 1376 is a saving of 4.58 %");
    [first, second, third]
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
    let rows = [
        measures("projection", [33.0, 67.0, 1.67], 1.5, projection, Bound::Digits),
        measures("flat polygon, 4 sides", [1.0, 1.0, 1.0], 1.01, few_sides, Bound::Most),
        measures(
            "flat polygon, 15 sides, edges",
            [25.0, 50.0, 1.5],
            1.33,
            many_sides,
            Bound::Least,
        ),
        flat_triangle(triangle),
        measures("Gouraud polygon, narrow", [37.5, 75.0, 1.75], 1.6, narrow, Bound::Digits),
        measures("line clipping", [25.0, 50.0, 1.5], 1.33, lines, Bound::Digits),
        measures("polygon clipping", [1.0, 1.0, 1.0], 1.0, polygons, Bound::Least),
        measures("back faces", [33.0, 67.0, 1.67], 1.5, faces, Bound::Digits),
    ];
    let title = "Table 1, savings of work by measures I, II and III";
    Table { title: title.into(), rows: rows.into_iter().flatten().collect() }
}

/// A number of operations for one thing that is worked on.
fn each(what: &str, count: u64, printed: f64) -> Row {
    Row::new(what, count as f64 / ITEMS as f64, 0, Check::Digits).printed(printed)
}

fn operations() -> Table {
    let [separately, together] = work(&Projection::<Counted>::new(ITEMS));
    let mut rows = vec![
        each("projection, separately", separately.operations.all(), 12.0),
        each("projection, together", together.operations.all(), 8.0),
    ];
    let faces = Faces::<Counted>::new(ITEMS);
    let [separately, together] = work(&faces).map(|work| work.operations);
    let mut deciding = faces.clone();
    let ((), decided) = counted(|| deciding.decided());
    let decided = decided.all() as f64 / ITEMS as f64;
    rows.extend([
        each("back faces, arithmetic, separately", separately.arithmetic(), 12.0),
        each("back faces, arithmetic, together", together.arithmetic(), 8.0),
        each("back faces with comparisons, separately", separately.all(), 14.0),
        Row::new("back faces with comparisons, at most", decided.ceil(), 0, Check::Digits)
            .printed(11.0),
        Row::new("back faces with comparisons, by decisions", decided, 1, Check::AtMost(11.0)),
        Row::new(
            "back faces with comparisons, together",
            together.all() as f64 / ITEMS as f64,
            0,
            Check::AtMost(10.0),
        ),
    ]);
    let [separately, together] = work(&Lines::<f64>::new(ITEMS, true));
    let random = work(&Lines::<f64>::new(ITEMS, false));
    let [random_separately, random_together] =
        random.map(|work| work.boundary_clips as f64 / ITEMS as f64);
    rows.extend([
        each("line within the window, boundary clips, separately", separately.boundary_clips, 8.0),
        each("line within the window, boundary clips, together", together.boundary_clips, 6.0),
        Row::new(
            "random line, boundary clips, separately",
            random_separately,
            2,
            Check::AtMost(8.0),
        ),
        Row::new("random line, boundary clips, together", random_together, 2, Check::AtMost(6.0)),
        Row::new(
            "random lines, boundary clips saved",
            100.0 * saved(random, |work| work.boundary_clips),
            1,
            Check::AtLeast(25.0),
        )
        .printed(25.0)
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
    let limit = 100.0 * (1.0 - narrow.together as f64 / narrow.separately as f64);
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
        Row::new("two pixels wide, saved", limit, 1, Check::Digits).printed(37.5).unit("%"),
    ];
    Table { title: "Interpolations of Gouraud polygons in both views".into(), rows }
}

fn times() -> Table {
    let mut rows = Vec::new();
    // Printed and corrected measure III, where the publication has one for just this.
    let mut add = |what: &str, iii: Option<[f64; 2]>, least: f64, ratio: crate::timing::Ratio| {
        // Range checks of a debug build are no part of the algorithms.
        let check = if cfg!(debug_assertions) { Check::Trend } else { Check::AtLeast(least) };
        let row = Row::new(what, ratio.median, 2, check);
        rows.push(match iii {
            Some([printed, corrected]) if printed == corrected => row.printed(printed),
            Some([printed, corrected]) => row.printed(printed).corrected(corrected, COLUMN_III),
            None => row,
        });
    };
    // Never slower by more than 2 %, and faster where more than 10 % of the work is saved.
    let (not_slower, faster) = (0.981, 1.0);
    add("projection", Some([1.67, 1.5]), faster, time(ROUNDS, &Projection::<f64>::new(ITEMS)));
    for sides in [4, 8, 15, 32] {
        let (least, iii) =
            if sides < 15 { (not_slower, None) } else { (faster, Some([1.5, 1.33])) };
        for (size, count, reach) in [("small", 500, 10.0), ("large", 50, 60.0)] {
            let what = format!("flat polygons, {size}, {sides} sides");
            add(&what, iii, least, time(ROUNDS, &Drawing::<0>::random(count, sides, reach)));
        }
    }
    for sides in [4, 8, 15, 32] {
        for (size, count, reach) in [("small", 200, 10.0), ("large", 20, 60.0)] {
            let what = format!("Gouraud polygons, {size}, {sides} sides");
            add(&what, None, not_slower, time(ROUNDS, &Drawing::<3>::random(count, sides, reach)));
        }
    }
    let mut shade = |what: &str, corners: &[[f64; 2]], iii: Option<[f64; 2]>, least: f64| {
        add(what, iii, least, time(ROUNDS, &Drawing::<3>::of(corners)));
    };
    shade("Gouraud, flat triangle", &FLAT_TRIANGLE, Some([1.1, 1.05]), not_slower);
    shade("Gouraud, tower", &TOWER_SHAPE, None, faster);
    shade("Gouraud, two pixels wide", &TWO_PIXELS_WIDE, Some([1.75, 1.6]), faster);
    let lines = Lines::<f64>::new(ITEMS, false);
    add("line clipping", Some([1.5, 1.33]), faster, time(ROUNDS, &lines));
    let polygons = Polygons::<f64>::new(ITEMS);
    add("polygon clipping", Some([1.0, 1.0]), not_slower, time(ROUNDS, &polygons));
    add("back faces", Some([1.67, 1.5]), faster, time(ROUNDS, &Faces::<f64>::new(ITEMS)));
    Table { title: "Time separately : time together, measure III".into(), rows }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_counted_holds() {
        let tables = vec![savings(), operations(), interpolations()];
        let report = Report { tables, ..Report::default() };
        let differing: Vec<_> = report.differing().collect();
        assert!(differing.is_empty(), "{differing:?}");
    }
}
