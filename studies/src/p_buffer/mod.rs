//! Heo, Jung and Wohn 1998: visible polygons, the cost of the second view, and what it shows wrongly.

pub mod measure;
mod perception;
mod pictures;
mod published;
mod times;
mod walk;

use crate::errata::COPIES;
use crate::plot::{self, Series};
use crate::{Check, Experiment, Report, Row, StudyError, Table};
use measure::{Measured, Office};
use published::{FULL_RIGHT, POLYGONS, ROOMS, VISIBLE};
use std::path::{Path, PathBuf};
use times::{rooms, Columns};
use walk::Walk;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "p-buffer",
    description: "visible polygons, the cost and the errors of P-buffer and image warping",
    run,
};

/// Runs the experiment.
fn run(folder: &Path) -> Result<Report, StudyError> {
    let measured = (1..=ROOMS)
        .map(|rooms| Ok(Office::of_rooms(rooms)?.measure()))
        .collect::<Result<Vec<Measured>, StudyError>>()?;
    let walk = walk::walk(ROOMS)?;
    let mut files = plots(folder, &measured, &walk)?;
    files.extend(pictures::write(folder)?);
    Ok(Report {
        experiment: "p-buffer".into(),
        publication: "Heo, Jung and Wohn 1998, Fast Generation of Stereoscopic Virtual Environment Display Using P-buffer".into(),
        tables: vec![
            polygons(&measured),
            times::table(&measured),
            times::lines(),
            times::ratios(&measured),
            work(&measured),
            wrong(&measured),
            moving(&measured, &walk),
            perception::tests(),
        ],
        files,
    })
}

const BOUND: &str =
    "the publication prints no figure: the limit is this project's own, from its own \
    measurements, so that a change for the worse is noticed";
const FURNITURE: &str =
    "the publication shows pictures and prints no figure; the share depends on what \
    stands how near in the rooms: offices furnished otherwise gave 8.7 to 15.4 %";

fn polygons(measured: &[Measured]) -> Table {
    let rows = measured.iter().enumerate().flat_map(|(n, m)| {
        let all = Row::new(rooms(n) + ": polygons", m.polygons as f64, 0, Check::Digits);
        let all = all.printed(POLYGONS[n].into());
        let copies = f64::from(POLYGONS[0]) * (n + 1) as f64;
        let all = if n == 0 { all } else { all.corrected(copies, COPIES) };
        let visible = Row::new(rooms(n) + ": visible", m.visible as f64, 0, Check::Within(0.06));
        [all, visible.printed(VISIBLE[n].into())]
    });
    Table { title: "Table 1: polygons and visible polygons".into(), rows: rows.collect() }
}

/// Says of a figure that is held to a limit where the limit comes from.
fn bounded(row: Row) -> Row {
    match row.check {
        Check::Trend => row,
        _ => row.note(BOUND),
    }
}

fn work(measured: &[Measured]) -> Table {
    let last = &measured[ROOMS - 1];
    let row = |what: &str, view: usize, of: fn(&Measured, usize) -> u64, check: Check| {
        let growth = of(last, view) as f64 / of(&measured[0], view) as f64;
        bounded(Row::new(format!("{what}, 15 rooms : 1 room"), growth, 2, check))
    };
    let polygons = |m: &Measured, view: usize| m.work[view].polygons;
    let tests = |m: &Measured, view: usize| m.work[view].depth_tests;
    let rows = vec![
        row("full pipeline: polygons scan-converted", 0, polygons, Check::Trend),
        row("full pipeline: depth tests", 0, tests, Check::Trend),
        row("P-buffer: polygons scan-converted", 1, polygons, Check::AtMost(2.25)),
        row("P-buffer: depth tests", 1, tests, Check::AtMost(1.1)),
    ];
    Table { title: "Work of the left view, counted".into(), rows }
}

/// The least and the most of a figure over all numbers of rooms.
fn range(measured: &[Measured], of: impl Fn(&Measured) -> f64) -> [f64; 2] {
    let values = measured.iter().map(of);
    values.fold([f64::MAX, f64::MIN], |[least, most], n| [least.min(n), most.max(n)])
}

fn wrong(measured: &[Measured]) -> Table {
    let faults = |of: fn(&Measured) -> usize| move |m: &Measured| m.faults.percent(of(m));
    let row = |what: &str, of: &dyn Fn(&Measured) -> f64, check: Check| {
        let [least, most] = range(measured, of);
        let least = Row::new(format!("{what}, least"), least, 2, Check::Trend).unit("%");
        [least, bounded(Row::new(format!("{what}, most"), most, 2, check).unit("%"))]
    };
    let [least, _] = range(measured, |m| m.faults.percent(m.faults.wrong()) / m.wrong);
    let [_, misordered] = range(measured, |m| m.misordered as f64);
    let rows = [
        row("P-buffer: wrong pixels", &|m| m.wrong, Check::AtMost(0.54)),
        row("warping: wrong pixels", &faults(|m| m.faults.wrong()), Check::AtMost(2.8)),
        row("warping: holes", &faults(|m| m.faults.holes), Check::AtMost(1.65)),
        row("warping: overlaps", &faults(|m| m.faults.overlaps), Check::AtMost(0.77)),
        row("warping: bad pixels", &faults(|m| m.faults.bad()), Check::AtMost(1.1)),
        row("of these something shows through", &faults(|m| m.faults.see_through), Check::Trend),
    ];
    let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
    let ratio = Row::new("warping : P-buffer, wrong pixels, least", least, 1, Check::AtLeast(5.0));
    rows.push(bounded(ratio));
    let order = "pixels that overwriting in the right order and a depth test leave differently";
    rows.push(Row::new(order, misordered, 0, Check::Digits).expected(0.0));
    Table { title: "Figures 5 and 7, from the right to the left view".into(), rows }
}

fn moving(measured: &[Measured], walk: &Walk) -> Table {
    let mut rows = Vec::new();
    for (direction, way) in ["right", "left"].into_iter().enumerate() {
        let what = |method: &str| format!("20 cm to the left, 3° to the {way}: {method}");
        for (method, name, check) in
            [(0, "P-buffer", Check::AtMost(1.6)), (1, "warping", Check::Trend)]
        {
            let [least, most] = range(measured, |m| m.moved[direction][method]);
            let name = what(name);
            rows.push(Row::new(format!("{name}, least"), least, 2, Check::Trend).unit("%"));
            let most = Row::new(format!("{name}, most"), most, 2, check).unit("%");
            rows.push(if method == 1 { most.note(FURNITURE) } else { bounded(most) });
        }
        let [least, _] = range(measured, |m| m.moved[direction][1] / m.moved[direction][0]);
        let name = what("warping : P-buffer, least");
        rows.push(bounded(Row::new(name, least, 1, Check::AtLeast(5.0))));
    }
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let row = |what: &str, here: f64, check| Row::new(what, here, 2, check).unit("%");
    rows.extend([
        row("walk: P-buffer, mean of all frames", mean(&walk.p_buffer), Check::Trend),
        row("walk: P-buffer, worst frame", most(&walk.p_buffer), Check::Trend),
        row("walk: warping, mean of all frames", mean(&walk.warping), Check::Trend),
        row("walk: warping, worst frame", most(&walk.warping), Check::Trend),
        row("walk: P-buffer of itself, after 1 frame", walk.chained[0], Check::Trend),
        row("walk: P-buffer of itself, after 5 frames", walk.chained[4], Check::Trend),
        row("walk: P-buffer of itself, after 20 frames", walk.chained[19], Check::Trend),
    ]);
    let ratio = mean(&walk.warping) / mean(&walk.p_buffer);
    let ratio = Row::new("walk: warping : P-buffer, wrong pixels", ratio, 1, Check::AtLeast(5.0));
    rows.push(bounded(ratio));
    Table { title: "Figures 3, 5 and 7, a viewer who moves: wrong pixels".into(), rows }
}

fn plots(folder: &Path, measured: &[Measured], walk: &Walk) -> Result<Vec<PathBuf>, StudyError> {
    let (printed, here) = (Columns::printed(), Columns::here(measured));
    let mut files = Vec::new();
    let mut save = |name: &str, title: &str, axes: [&str; 2], series: &[Series]| {
        let file = folder.join(name);
        plot::lines(&file, title, axes, series)?;
        files.push(file);
        Ok::<(), StudyError>(())
    };
    let scaled = |columns: &[&Vec<(f64, f64)>], unit: f64| -> Vec<(f64, f64)> {
        let sum = |n: usize| columns.iter().map(|column| column[n].1).sum::<f64>();
        (0..ROOMS).map(|n| (columns[0][n].0 / 1000.0, sum(n) / unit)).collect()
    };
    let units = [here.full[0][0].1, FULL_RIGHT[0]];
    for (name, title, views) in [
        ("p_buffer_figure_17a.svg", "Figure 17 (a): the right view", 0..1),
        ("p_buffer_figure_17b.svg", "Figure 17 (b): the left view", 1..2),
        ("p_buffer_figure_17c.svg", "Figure 17 (c): both views", 0..2),
    ] {
        let mut series = Vec::new();
        for (columns, unit, when) in [(&here, units[0], "here"), (&printed, units[1], "1998")] {
            for (columns, method) in
                [(&columns.full, "full pipeline"), (&columns.p_buffer, "P-buffer")]
            {
                let columns: Vec<_> = columns[views.clone()].iter().collect();
                let name = format!("{method}, {when}");
                series.push(Series::new(name, scaled(&columns, unit)));
            }
        }
        let axes = ["thousand polygons", "multiples of one room's right view, full pipeline"];
        save(name, title, axes, &series)?;
    }
    let frames = |values: &[f64]| (1..).zip(values).map(|(n, &y)| (f64::from(n), y)).collect();
    let series = [
        Series::new("warping", frames(&walk.warping)),
        Series::new("P-buffer", frames(&walk.p_buffer)),
        Series::new("P-buffer of itself", frames(&walk.chained)),
    ];
    save("p_buffer_walk.svg", "A walk through 15 rooms", ["frame", "wrong pixels, %"], &series)?;
    Ok(files)
}
