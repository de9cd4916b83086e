//! Every figure that the publications print or that follows from them is recomputed by an experiment, and
//! holds.
//!
//! The figures stand here once more, apart from the rows that are held to them: a row that is lost, or
//! held to something else, is noticed.

use std::sync::OnceLock;
use wheatstone_golden::pipeline::filter_tables::TWO_TERM;
use wheatstone_studies::reproduce::{run, Summary};
use wheatstone_studies::{Report, Row, Verdict, EXPERIMENTS};
use wheatstone_tests::folder;

/// All experiments but the one that needs an OpenGL renderer, run once for all tests.
fn reports() -> &'static [Report] {
    static REPORTS: OnceLock<Vec<Report>> = OnceLock::new();
    REPORTS.get_or_init(|| {
        let folder = folder();
        let some: Vec<_> = EXPERIMENTS.iter().filter(|e| e.name != "opengl").copied().collect();
        let reports = run(&some, folder.path(), |_| ()).expect("they run");
        let files = || reports.iter().flat_map(|report| &report.files);
        assert!(files().count() > 20 && files().all(|file| file.exists()));
        reports
    })
}

/// The row of that name; names are unique within a table, and the first table has it.
fn row(experiment: &str, what: &str) -> &'static Row {
    let report = reports().iter().find(|report| report.experiment == experiment);
    let mut rows = report.expect(experiment).rows();
    rows.find(|row| row.what == what).unwrap_or_else(|| panic!("{experiment}: no row {what}"))
}

/// A figure that follows from a publication: it stands in the column "corrected", and holds.
fn derived(experiment: &str, what: &str, figure: f64) {
    let row = row(experiment, what);
    let half_a_digit = 0.5 * 0.1f64.powi(row.digits as i32);
    let reference = row.corrected.expect(what);
    assert!(
        (reference - figure).abs() <= half_a_digit * 1.001,
        "{what}: {reference}, not {figure}"
    );
    assert_eq!(row.verdict(), Verdict::Holds, "{experiment}, {what}: {}", row.here);
}

/// A figure as a publication prints it.
fn printed(experiment: &str, what: &str, figure: f64) {
    assert_eq!(row(experiment, what).printed, Some(figure), "{experiment}, {what}");
}

#[test]
fn every_experiment_holds() {
    for report in reports() {
        let wrong: Vec<_> = report.differing().map(|row| (&row.what, row.here)).collect();
        assert!(wrong.is_empty(), "{}: {wrong:?}", report.experiment);
        assert!(Summary::of(std::slice::from_ref(report)).holds > 10, "{}", report.experiment);
    }
}

#[test]
fn every_erratum_is_told_in_the_documentation() {
    let text = include_str!("../docs/errata.md");
    for row in reports().iter().flat_map(Report::rows) {
        if let Some(erratum) = row.erratum {
            let (name, told) = erratum.split_once(": ").expect("a short name and what it says");
            assert!(text.matches(&format!("- **{name}.** ")).count() == 1, "{name}");
            assert!(!told.is_empty(), "{name}");
        } else if row.printed.is_some() {
            assert_eq!(row.printed, row.corrected, "{}: a correction without erratum", row.what);
        }
    }
}

#[test]
fn the_filter_s_figures_are_covered() {
    // tests/filter.rs holds the exponents to the published ones.
    for (n, &(p, q)) in (0u32..).zip(&TWO_TERM).skip(1) {
        let sum = 0.5f64.powi(p as i32) + 0.5f64.powi(q as i32);
        let one = if p == q { format!(" = 1/2^{}", p - 1) } else { String::new() };
        let error = 100.0 * (f64::from(n) * sum - 1.0).abs();
        derived("filter", &format!("1/{n}: 1/2^{p} + 1/2^{q}{one}"), error);
    }
    for (what, figure) in [
        ("two terms, sum of errors, in 256ths", 305.0),
        ("two terms, largest error", 12.5),
        ("first n with the largest error", 9.0),
        ("last n with the largest error", 18.0),
        ("two terms, mean error, n = 1 … 29", 4.108_297_413_793_104),
        ("two terms, mean error, n = 2 … 29", 4.255022321428571),
        ("n for which white overflows 8 bits", 9.0),
        ("largest white, shifts cut", 286.0),
        ("three terms, largest error", 6.25),
        ("three terms, mean error", 1.27458),
        ("two terms, added or subtracted, largest error", 7.8125),
        ("two terms, added or subtracted, mean error", 2.90948),
        ("exact division, least shift", 18.0),
        ("hybrid system, sum", 22754.0),
    ] {
        derived("filter", what, figure);
    }
    for (k, n) in (1..).zip([9.0, 11.0, 13.0, 17.0, 18.0, 22.0, 23.0, 26.0, 29.0]) {
        derived("filter", &format!("n for which white overflows, {k} of 9"), n);
    }
    for (unit, gates) in [
        ("x interpolator", 2423.0),
        ("y interpolator", 392.0),
        ("edge interpolator", 2768.0),
        ("three edge interpolators", 8304.0),
        ("filter", 1873.0),
        ("coverage", 4000.0),
        ("blending", 4520.0),
        ("redirection", 1242.0),
        ("hybrid system, sum", 30000.0),
        ("two terms, mean error, n = 2 … 29", 4.26),
    ] {
        printed("filter", unit, gates);
    }
}

#[test]
fn adelson_s_figures_are_covered() {
    // Table 1: I, II and III as printed, and III as it should be.
    for (experiment, what, [i, ii, iii], corrected) in [
        ("adelson", "projection", [33.0, 67.0, 1.67], 1.5),
        ("adelson", "flat polygon, 4 sides", [1.0, 1.0, 1.0], 1.0),
        ("adelson", "flat polygon, 15 sides, edges", [25.0, 50.0, 1.5], 1.33),
        ("adelson", "Gouraud polygon, flat triangle", [4.5, 9.0, 1.1], 1.05),
        ("adelson", "Gouraud polygon, narrow", [37.5, 75.0, 1.75], 1.6),
        ("adelson", "line clipping", [25.0, 50.0, 1.5], 1.33),
        ("adelson", "polygon clipping", [1.0, 1.0, 1.0], 1.0),
        ("adelson", "back faces", [33.0, 67.0, 1.67], 1.5),
        ("village", "144 polygons: time", [17.0, 33.0, 1.33], 1.2),
        ("village", "480 polygons: time", [17.0, 33.0, 1.33], 1.2),
        ("village", "960 polygons: time", [17.0, 33.0, 1.33], 1.2),
        ("village", "hidden surfaces: time", [12.0, 24.0, 1.24], 1.14),
        ("village", "village: time", [18.8, 37.6, 1.38], 1.23),
    ] {
        for (measure, figure) in [("I", i), ("II", ii), ("III", iii)] {
            let what = format!("{what}, {measure}");
            printed(experiment, &what, figure);
            let less = figure == 1.0 && measure != "III";
            assert_eq!(row(experiment, &what).printed_less, less, "{what}");
        }
        let third = row(experiment, &format!("{what}, III"));
        assert_eq!(third.corrected, Some(corrected), "{what}");
        assert_eq!(third.erratum.is_some(), corrected != iii, "{what}");
    }
    printed("village", "with Gouraud shading: time, I", 17.0);
    printed("village", "triangles", 1100.0);
    for (what, figure) in [
        ("projection, separately, arithmetic", 12.0),
        ("projection, together, arithmetic", 8.0),
        ("flat triangle, separately", 1442.0),
        ("flat triangle, together", 1376.0),
        ("29 edge pixels by the formula, separately", 862.0),
        ("29 edge pixels by the formula, together", 775.0),
        ("tower, separately", 1094.0),
        ("tower, together", 920.0),
        ("tower, saved", 15.9),
        ("two pixels wide, saved", 37.5),
        ("line within the window, boundary clips, separately", 8.0),
        ("line within the window, boundary clips, together", 6.0),
        ("back faces, separately, arithmetic", 12.0),
        ("back faces, together, arithmetic", 8.0),
        ("back faces, separately, all", 14.0),
        ("back faces, by decisions, all, at most", 11.0),
    ] {
        derived("adelson", what, figure);
    }
}

#[test]
fn heo_s_figures_are_covered() {
    let visible =
        [301, 474, 536, 569, 584, 604, 617, 623, 626, 632, 634, 636, 638, 638, 640].map(f64::from);
    let surplus = [0, 4, 10, 16, 20, 20, 26, 32, 38, 44, 48, 54, 60, 66, 72];
    let columns = [
        (
            "full, right",
            [0.67, 1.0, 1.04, 1.27, 1.43, 1.59, 1.77, 2.01, 2.1, 2.36, 2.48, 2.53, 2.8, 2.96, 3.17],
        ),
        (
            "full, left",
            [
                0.67, 0.99, 1.04, 1.26, 1.42, 1.58, 1.76, 1.99, 2.06, 2.36, 2.48, 2.52, 2.77, 2.85,
                3.15,
            ],
        ),
        (
            "P-buffer, right",
            [1.14, 1.7, 1.94, 2.09, 2.35, 2.48, 2.5, 2.6, 2.91, 3.12, 3.15, 3.35, 3.56, 3.62, 3.79],
        ),
        (
            "P-buffer, left",
            [
                0.39, 0.45, 0.48, 0.39, 0.43, 0.37, 0.33, 0.41, 0.37, 0.43, 0.37, 0.44, 0.36, 0.37,
                0.37,
            ],
        ),
    ];
    for n in 1..=15 {
        let rooms = if n == 1 { "1 room".into() } else { format!("{n} rooms") };
        derived("p-buffer", &format!("{rooms}: polygons"), 3652.0 * n as f64);
        let polygons = 3652.0 * n as f64 + f64::from(surplus[n - 1]);
        printed("p-buffer", &format!("{rooms}: polygons"), polygons);
        derived("p-buffer", &format!("{rooms}: visible"), visible[n - 1]);
        for (column, seconds) in columns {
            printed("p-buffer", &format!("{rooms}: {column}"), seconds[n - 1]);
        }
    }
    for (what, figure) in [
        ("full pipeline, right, at no polygons", 0.57),
        ("full pipeline, right, a polygon", 47.0),
        ("P-buffer, right, at no polygons", 1.34),
        ("P-buffer, right, a polygon", 46.0),
        ("P-buffer, left, at no polygons", 0.43),
        ("both views of 15 rooms, full pipeline : P-buffer", 1.52),
        ("second view of 15 rooms, full pipeline : P-buffer", 8.5),
        ("polygons from which the P-buffer is faster", 14155.0),
        ("1, without the blue cylinder easier: confidence", 99.8769),
        ("2, with and without the centre the same: significance", 15.4537),
        ("3, walk, both methods the same: significance", 42.3338),
    ] {
        derived("p-buffer", what, figure);
    }
    printed("p-buffer", "polygons from which the P-buffer is faster", 15000.0);
}

#[test]
fn nasa_s_figures_are_covered() {
    printed("nasa", "width of the screen", 12.4);
    for (what, figure) in [
        ("width of the screen", 13.8309),
        ("Asymmetric, nearest distance", 2.909),
        ("Symmetric, nearest distance", 4.192),
        ("MIND: d at NCP", 14.0),
        ("SD: d at SI", 19.0),
        ("MAXD: d at infinity", 43.0),
        ("z at NCP", -1.0),
        ("z at FCP", 1.0),
        ("partitions", 4.0),
        ("flat partitions", 2.0),
    ] {
        derived("nasa", what, figure);
    }
    for (place, cells) in [
        ("Symmetric, nearest", [30.8, 0.0, 30.8, 61.6]),
        ("Symmetric, screen", [7.0, 26.0, 7.0, 40.0]),
        ("Symmetric, infinity", [0.0, 33.2, 0.0, 33.2]),
        ("Asymmetric, nearest", [36.0, 0.0, 36.0, 72.0]),
        ("Asymmetric, screen", [0.0, 40.0, 0.0, 40.0]),
        ("Asymmetric, infinity", [6.65, 33.2, 6.65, 46.5]),
    ] {
        for (part, cell) in ["left", "stereo", "right", "total"].into_iter().zip(cells) {
            let what = format!("{place}, {part}");
            printed("nasa", &what, cell);
            // Those of whole degrees by as much, the others to their digits.
            let row = row("nasa", &what);
            assert_eq!(row.verdict(), Verdict::Holds, "{what}");
            let near = if row.erratum.is_some() { 0.5 } else { 0.05 };
            assert!((row.here - cell).abs() <= near, "{what}: {}", row.here);
        }
    }
}

#[test]
fn duvanenko_and_robbins_figures_are_covered() {
    for (what, figure) in [
        ("triangles", 79202.0),
        ("distance between the eyes", 119.04761904761904),
        ("viewing distance", 857.1428571428571),
    ] {
        derived("height-field", what, figure);
    }
    printed("height-field", "triangles", 80000.0);
}
