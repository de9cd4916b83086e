//! Table 1's times and figure 17: straight lines, break-even, and what the second view costs.

use super::measure::Measured;
use super::published::{FULL_LEFT, FULL_RIGHT, POLYGONS, P_BUFFER_LEFT, P_BUFFER_RIGHT, ROOMS};
use crate::errata::FIFTEEN_THOUSAND;
use crate::timing::{at_least, at_most};
use crate::{Check, Row, Table};

/// "1 room", "2 rooms".
pub(super) fn rooms(n: usize) -> String {
    format!("{} room{}", n + 1, if n == 0 { "" } else { "s" })
}

/// Table 1 beside the times here, on a scale on which the first of them is the printed one.
pub fn table(measured: &[Measured]) -> Table {
    let unit = measured[0].full[0];
    let rows = measured.iter().enumerate().flat_map(|(n, m)| {
        let row = |what: &str, printed: f64, here: f64| {
            let scaled = here / unit * FULL_RIGHT[0];
            let row = Row::new(format!("{}: {what}", rooms(n)), scaled, 2, Check::Trend);
            row.printed(printed).unit("s")
        };
        [
            row("full, right", FULL_RIGHT[n], m.full[0]),
            row("full, left", FULL_LEFT[n], m.full[1]),
            row("P-buffer, right", P_BUFFER_RIGHT[n], m.p_buffer[0]),
            row("P-buffer, left", P_BUFFER_LEFT[n], m.p_buffer[1]),
        ]
    });
    let title = format!(
        "Table 1: times; here {unit:.3} ms for the full pipeline's right view of one room stand for {} s",
        FULL_RIGHT[0]
    );
    Table { title, rows: rows.collect() }
}

/// A straight line by least squares: its value at 0 and its slope.
fn fit(points: &[(f64, f64)]) -> [f64; 2] {
    let count = points.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let product: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let square: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    [y - product / square * x, product / square]
}

/// Times of the four columns against the number of polygons.
pub struct Columns {
    pub full: [Vec<(f64, f64)>; 2],
    pub p_buffer: [Vec<(f64, f64)>; 2],
}

impl Columns {
    pub fn printed() -> Columns {
        let column = |times: [f64; ROOMS]| POLYGONS.map(f64::from).into_iter().zip(times).collect();
        Columns {
            full: [column(FULL_RIGHT), column(FULL_LEFT)],
            p_buffer: [column(P_BUFFER_RIGHT), column(P_BUFFER_LEFT)],
        }
    }

    pub fn here(measured: &[Measured]) -> Columns {
        let column = |time: &dyn Fn(&Measured) -> f64| {
            measured.iter().map(|m| (m.polygons as f64, time(m))).collect()
        };
        Columns {
            full: [column(&|m| m.full[0]), column(&|m| m.full[1])],
            p_buffer: [column(&|m| m.p_buffer[0]), column(&|m| m.p_buffer[1])],
        }
    }

    /// The number of polygons from which both views take less time with the P-buffer, between
    /// rows of the table; the first row's, and true, if they always do.
    fn break_even(&self) -> (f64, bool) {
        let gain = |n: usize| {
            let sum = |columns: &[Vec<(f64, f64)>; 2]| columns[0][n].1 + columns[1][n].1;
            sum(&self.full) - sum(&self.p_buffer)
        };
        let polygons = |n: usize| self.full[0][n].0;
        let Some(n) = (0..ROOMS).find(|&n| gain(n) >= 0.0) else { return (f64::INFINITY, false) };
        if n == 0 {
            return (polygons(0), true);
        }
        let part = gain(n - 1) / (gain(n - 1) - gain(n));
        (polygons(n - 1) + part * (polygons(n) - polygons(n - 1)), false)
    }

    /// Time for both views of the most rooms, full : P-buffer; and for the second view.
    fn gains(&self) -> [f64; 2] {
        let last = |column: &Vec<(f64, f64)>| column[ROOMS - 1].1;
        let [full, p_buffer] =
            [&self.full, &self.p_buffer].map(|both| both.iter().map(last).sum::<f64>());
        [full / p_buffer, last(&self.full[1]) / last(&self.p_buffer[1])]
    }
}

/// Time for one more polygon, in the column's unit.
fn slope(column: &[(f64, f64)]) -> f64 {
    fit(column)[1]
}

/// Figures that follow from the printed times.
pub fn lines() -> Table {
    let printed = Columns::printed();
    let seconds = |what: &str, column: &[(f64, f64)], expected: f64| {
        let row = Row::new(format!("{what}, at no polygons"), fit(column)[0], 2, Check::Digits);
        row.expected(expected).unit("s")
    };
    let each = |what: &str, column: &[(f64, f64)], expected: f64| {
        let row = Row::new(format!("{what}, a polygon"), 1e6 * slope(column), 0, Check::Digits);
        row.expected(expected).unit("µs")
    };
    let [both, second] = printed.gains();
    let (break_even, _) = printed.break_even();
    let rows = vec![
        seconds("full pipeline, right", &printed.full[0], 0.57),
        each("full pipeline, right", &printed.full[0], 47.0),
        seconds("P-buffer, right", &printed.p_buffer[0], 1.34),
        each("P-buffer, right", &printed.p_buffer[0], 46.0),
        seconds("P-buffer, left", &printed.p_buffer[1], 0.43),
        Row::new("both views of 15 rooms, full pipeline : P-buffer", both, 2, Check::Digits)
            .expected(1.52),
        Row::new("second view of 15 rooms, full pipeline : P-buffer", second, 1, Check::Digits)
            .expected(8.5),
        Row::new("polygons from which the P-buffer is faster", break_even, 0, Check::Digits)
            .printed(15_000.0)
            .corrected(14_155.0, FIFTEEN_THOUSAND),
    ];
    Table {
        title: "What follows from table 1's times; straight lines by least squares".into(),
        rows,
    }
}

/// The same of the times here.
pub fn ratios(measured: &[Measured]) -> Table {
    let (printed, here) = (Columns::printed(), Columns::here(measured));
    let row = |what: &str, of: &dyn Fn(&Columns) -> f64, digits: usize, check: Check| {
        Row::new(what, of(&here), digits, check).expected(of(&printed))
    };
    let growth = |view: usize| {
        move |columns: &Columns| slope(&columns.p_buffer[view]) / slope(&columns.full[view])
    };
    // What costs the same whatever there is to draw, as a number of polygons.
    let fixed = |columns: &Columns| {
        let [start, slope] = fit(&columns.full[0]);
        start / slope
    };
    let first = measured[ROOMS - 1].first_ratio;
    let (break_even, less) = here.break_even();
    let rows = vec![
        row("second view's growth, P-buffer : full pipeline", &growth(1), 3, at_most(0.02)),
        Row::new("first view of 15 rooms, P-buffer : full pipeline", first, 2, at_most(1.15))
            .expected(P_BUFFER_RIGHT[ROOMS - 1] / FULL_RIGHT[ROOMS - 1]),
        row("first view's growth, P-buffer : full pipeline", &growth(0), 2, Check::Trend),
        row("fixed cost of the full pipeline, in polygons", &fixed, 0, Check::Trend),
        row(
            "both views of 15 rooms, full pipeline : P-buffer",
            &|c| c.gains()[0],
            2,
            at_least(1.0),
        ),
        row(
            "second view of 15 rooms, full pipeline : P-buffer",
            &|c| c.gains()[1],
            1,
            at_least(1.0),
        ),
        Row::new("polygons from which the P-buffer is faster", break_even, 0, Check::Trend)
            .here_less(less)
            .expected(printed.break_even().0),
    ];
    let nanoseconds = 1e6 * slope(&here.full[0]);
    let title = format!(
        "Figure 17, times here; a polygon takes {nanoseconds:.0} ns; corrected: by table 1"
    );
    Table { title, rows }
}
