//! Plots as SVG.

use plotters::element::DashedPathElement;
use plotters::prelude::*;
use std::path::Path;
use wheatstone_golden::files::{self, WriteError};

/// Width and height of a plot in pixels.
const SIZE: (u32, u32) = (800, 500);
/// Colours of the series, told apart by readers who do not see red and green too (M. Okabe and
/// K. Ito, "Color Universal Design", 2002), darkest first.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(60, 60, 60),
];
/// A curve of more points has no markers.
const MOST_MARKERS: usize = 100;
/// Pixels of a dash, and between two.
const DASH: u32 = 7;
const GAP: u32 = 5;
const LEGEND_COLUMNS: usize = 2;
/// Height of a line of the legend in pixels.
const LEGEND_ROW: u32 = 20;
const FONT: &str = "sans-serif";
const INK: RGBColor = RGBColor(40, 40, 40);
const GRID: RGBColor = RGBColor(222, 222, 222);
/// Space around the data, as part of its range.
const MARGIN: f64 = 0.05;

/// A named curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// Its points in the order they are joined; the line is interrupted where one is not finite.
    pub points: Vec<(f64, f64)>,
    /// True if its line is dashed, so that another that lies under it can be seen.
    pub dashed: bool,
}

impl Series {
    /// A series of that name.
    pub fn new(name: impl Into<String>, points: Vec<(f64, f64)>) -> Series {
        Series { name: name.into(), points, dashed: false }
    }

    /// The series with a dashed line.
    pub fn dashed(self) -> Series {
        Series { dashed: true, ..self }
    }
}

/// Draws lines, with markers at up to 100 points each, into an SVG file; `axes` are what stands at
/// the horizontal and at the vertical axis.
pub fn lines(
    file: &Path,
    title: &str,
    axes: [&str; 2],
    series: &[Series],
) -> Result<(), WriteError> {
    let mut picture = String::new();
    draw(&mut picture, title, axes, series).map_err(|error| WriteError {
        file: file.to_owned(),
        source: std::io::Error::other(error.to_string()),
    })?;
    // It says nothing, and there are programs that fill curves for it.
    files::write(file, picture.replace(" opacity=\"1\"", "").as_bytes())
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(picture: &mut String, title: &str, axes: [&str; 2], series: &[Series]) -> Drawn {
    let root = SVGBackend::with_string(picture, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let rows = series.len().div_ceil(LEGEND_COLUMNS) as u32;
    let (area, legend) = root.split_vertically(SIZE.1 - rows * LEGEND_ROW - 8);
    let points = || series.iter().flat_map(|s| &s.points).filter(|p| is_finite(p));
    let mut chart = ChartBuilder::on(&area)
        .caption(title, (FONT, 22).into_font().color(&INK))
        .margin(12)
        .x_label_area_size(56)
        .y_label_area_size(74)
        .build_cartesian_2d(range(points().map(|p| p.0)), range(points().map(|p| p.1)))?;
    chart
        .configure_mesh()
        .x_desc(axes[0])
        .y_desc(axes[1])
        .axis_desc_style(text_style())
        .label_style(text_style())
        .x_label_formatter(&|n| number(*n))
        .y_label_formatter(&|n| number(*n))
        .axis_style(INK)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    for (n, Series { name, points, dashed }) in series.iter().enumerate() {
        let colour = COLOURS[n % COLOURS.len()];
        for run in points.split(|p| !is_finite(p)).filter(|run| run.len() > 1) {
            let (run, style) = (run.iter().copied(), colour.stroke_width(2));
            if *dashed {
                chart.draw_series(DashedLineSeries::new(run, DASH, GAP, style))?;
            } else {
                chart.draw_series(LineSeries::new(run, style))?;
            }
        }
        if points.len() <= MOST_MARKERS {
            let at = points.iter().filter(|p| is_finite(p));
            chart.draw_series(at.map(|p| Circle::new(*p, 3, colour.filled())))?;
        }
        // Beneath the plot, where it hides nothing.
        let x = 90 + (n % LEGEND_COLUMNS) as i32 * (SIZE.0 as i32 - 100) / LEGEND_COLUMNS as i32;
        let y = (n / LEGEND_COLUMNS) as i32 * LEGEND_ROW as i32 + 6;
        let (line, style) = ([(x, y), (x + 24, y)], colour.stroke_width(3));
        if *dashed {
            legend.draw(&DashedPathElement::new(line, DASH, GAP, style))?;
        } else {
            legend.draw(&PathElement::new(line, style))?;
        }
        legend.draw(&Text::new(name.as_str(), (x + 32, y - 7), text_style()))?;
    }
    root.present()?;
    Ok(())
}

fn text_style() -> TextStyle<'static> {
    (FONT, 17).into_font().color(&INK)
}

fn is_finite(point: &(f64, f64)) -> bool {
    point.0.is_finite() && point.1.is_finite()
}

/// A range that holds all values and some space around them.
fn range(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let [least, most] = values
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], n| [least.min(n), most.max(n)]);
    if least > most {
        return 0.0..1.0;
    }
    let space = (most - least) * MARGIN;
    let space = if space > 0.0 { space } else { (most.abs() * MARGIN).max(0.5) };
    least - space..most + space
}

/// A number at a tick: no more digits than it has, and an exponent where it is very large or small.
fn number(n: f64) -> String {
    // Ticks are sums of steps; what is left of one at zero is rounding.
    let n = if n.abs() < 1e-12 { 0.0 } else { n };
    if n != 0.0 && !(1e-3..1e6).contains(&n.abs()) {
        return format!("{n:e}");
    }
    let text = format!("{n:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plots_are_drawn_whatever_the_points() {
        let folder = std::env::temp_dir().join(format!("wheatstone-plot-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("plot.svg");
        let series = [
            Series::new("squares", (0..10).map(|n| (f64::from(n), f64::from(n * n))).collect()),
            Series::new("a < b & c", vec![(0.0, f64::NAN), (1.0, 5.0), (2.0, f64::INFINITY)]),
            Series::new("none", vec![]),
        ];
        for some in [&series[..], &series[2..], &[]] {
            lines(&file, "A title", ["x / m", "y / s"], some).unwrap();
            let text = std::fs::read_to_string(&file).unwrap();
            assert!(text.starts_with("<svg width=\"800\" height=\"500\""), "{text}");
            assert!(text.contains("A title") && text.contains("x / m") && text.contains("y / s"));
            assert!(!text.contains("NaN") && !text.contains("inf"));
            assert!(some
                .iter()
                .all(|s| text.contains(&s.name.replace('&', "&amp;").replace('<', "&lt;"))));
            let markers = some.iter().flat_map(|s| &s.points).filter(|p| is_finite(p)).count();
            assert_eq!(text.matches("<circle").count(), markers);
        }
        assert!(lines(&file.join("plot.svg"), "", ["", ""], &[]).is_err(), "a file is no folder");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn ticks_have_the_digits_they_need() {
        let texts = [0.0, -1e-17, 0.5, 20.0, -0.25, 300.0 / 1000.0, 1e-7, 2.5e9].map(number);
        assert_eq!(texts, ["0", "0", "0.5", "20", "-0.25", "0.3", "1e-7", "2.5e9"]);
        assert_eq!(range([3.0].into_iter()), 2.5..3.5);
        assert_eq!(range([f64::NAN; 0].into_iter()), 0.0..1.0);
    }
}
