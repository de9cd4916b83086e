//! Tables of a volume, and what is to be said of it.

use super::{Extent, Place, Volume};
use comfy_table::{presets, CellAlignment, ContentArrangement, Table};
use std::fmt;
use wheatstone_golden::projection::{FieldOfView, Kind};

/// A number with six significant digits and no more than it has.
pub(super) fn figure(n: f64) -> String {
    if n.is_infinite() {
        return "infinity".into();
    }
    if n != 0.0 && !(1e-6..1e9).contains(&n.abs()) {
        return format!("{n:.4e}");
    }
    let digits = if n == 0.0 { 0 } else { 5 - n.abs().log10().floor() as i32 };
    let text = format!("{n:.*}", digits.clamp(0, 9) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

/// A disparity in pixels.
fn pixels(n: f64) -> String {
    let text = format!("{n:.1}");
    if text == "-0.0" {
        "0.0".into()
    } else {
        text
    }
}

const NOTHING: &str = "–";

fn cells(place: &Place) -> [String; 3] {
    let shown = |n: Option<f64>, text: fn(f64) -> String| n.map_or(NOTHING.into(), text);
    [figure(place.distance), shown(place.perceived, figure), shown(place.disparity, pixels)]
}

/// Left, stereo, right and total. Where both eyes' fields part, each sees its own, with a gap between.
fn angles(seen: &FieldOfView) -> [String; 4] {
    let degrees = |n: f64| format!("{:.2}", if n.abs() < 0.005 { 0.0 } else { n });
    let gap = seen.stereo.min(0.0);
    let stereo = if gap < -0.005 { format!("gap {}", degrees(-gap)) } else { degrees(seen.stereo) };
    [degrees(seen.left + gap), stereo, degrees(seen.right + gap), degrees(seen.total())]
}

/// A table whose numbers stand at the right.
fn plain(head: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_BORDERS_ONLY);
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(head);
    rows.for_each(|row| {
        table.add_row(row);
    });
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.to_string()
}

impl Volume {
    /// The tables as text, with the distances that are asked for.
    pub fn tables(&self, asked: &[f64]) -> String {
        [
            format!("Eyes and screen\n{}", self.chain()),
            format!("Limits: distances from the eyes, disparity right − left\n{}", self.limits()),
            format!("Distance map\n{}", self.distances(asked)),
            format!("Horizontal fields of view in degrees\n{}", self.angles()),
        ]
        .join("\n\n")
    }

    fn chain(&self) -> String {
        let device = self.device.is_some();
        let mut head = vec!["", "dots", "units"];
        if device {
            head.insert(1, "on the display");
        }
        let row = |length: &super::Length| {
            let mut row = vec![length.what.to_string()];
            row.extend(length.display.map(figure));
            row.extend([length.dots, length.units].map(figure));
            row
        };
        plain(&head, self.lengths().iter().map(row))
    }

    fn limits(&self) -> String {
        let head = ["", "near", "far", "perceived from", "to", "disparity / px from", "to", "runs"];
        let rows = self.ends().into_iter().enumerate().map(|(n, ends)| (self.name(n), ends));
        let scene = self.scene_ends().map(|ends| ("scene".into(), ends));
        let runs = |ends: &[Place; 2]| match ends.each_ref().map(|end| end.perceived) {
            [Some(near), Some(far)] if super::same(near, far) => "flat",
            [Some(near), Some(far)] if near > far => "BACKWARD",
            [Some(_), Some(_)] => "forward",
            _ => NOTHING,
        };
        let mut table: Vec<Vec<String>> = Vec::new();
        for (name, ends) in rows.chain(scene) {
            let [near, far] = [cells(&ends[0]), cells(&ends[1])];
            let mut row = vec![name];
            row.extend(near.into_iter().zip(far).flat_map(|(near, far)| [near, far]));
            row.push(runs(&ends).into());
            table.push(row);
        }
        plain(&head, table.into_iter())
    }

    fn distances(&self, asked: &[f64]) -> String {
        let row = |place: &Place| [vec![place.what.clone()], cells(place).into()].concat();
        let map = self.map(asked);
        plain(&["", "distance", "perceived at", "disparity / px"], map.iter().map(row))
    }

    fn angles(&self) -> String {
        let head = ["", "perceived at", "one eye, left", "both eyes", "one eye, right", "total"];
        let fields = self.fields();
        let rows = fields.iter().map(|field| {
            let start = vec![field.what.clone(), figure(field.perceived)];
            [start, angles(&field.seen).into()].concat()
        });
        plain(&head, rows)
    }

    /// Remarks for the user: a tilted head, polygons that are not drawn, perceived distances that run backward.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let tilt = self.rig.head_tilt;
        if tilt != 0.0 {
            notes.push(format!(
                "the head is tilted by {tilt} degrees: disparities are along the line of the eyes, fields \
                of view of the eyes' distance across"
            ));
        }
        notes.extend(self.warnings());
        notes
    }

    /// The notes that say that something may be wrong.
    pub fn warnings(&self) -> Vec<String> {
        let backward = |(n, pair): (usize, &[super::Range])| {
            let [near, far] = [&pair[0], &pair[1]];
            near.runs_back_to(far).then(|| {
                format!(
                    "perceived distances run backward from {} to {}: {} is seen at {}, but {} at {}",
                    self.name(n),
                    self.name(n + 1),
                    figure(near.far),
                    figure(near.perceived()[1]),
                    figure(far.near),
                    figure(far.perceived()[0]),
                )
            })
        };
        let mut notes: Vec<String> =
            self.ranges.windows(2).enumerate().filter_map(backward).collect();
        notes.extend(self.undrawn());
        notes
    }

    /// A note on polygons beside the distances that are drawn, if these are the projection's.
    fn undrawn(&self) -> Option<String> {
        let Extent { polygons, undrawn, partly, .. } = self.extent;
        let limited = matches!(self.rig.projection.kind(), Kind::Piecewise | Kind::Asymptotic);
        if !limited || undrawn + partly == 0 {
            return None;
        }
        let ranges = &self.ranges;
        let nearer = format!("nearer than {}", figure(ranges[0].near));
        let gaps = ranges
            .windows(2)
            .filter(|pair| pair[0].far < pair[1].near)
            .map(|pair| format!(", between {} and {}", figure(pair[0].far), figure(pair[1].near)));
        let gaps: String = gaps.collect();
        let farther = figure(ranges[ranges.len() - 1].far);
        Some(format!(
            "of {polygons} polygons {undrawn} are not drawn and {partly} only in part: what is \
             {nearer}{gaps} or farther than {farther} is not drawn with projection {}",
            self.rig.projection.kind().name()
        ))
    }
}

impl fmt::Display for Volume {
    /// Size of the views, projection and scale, in a line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size;
        let kind = self.rig.projection.kind().name();
        write!(f, "{width}x{height}, projection {kind}")?;
        write!(f, ", {} pixels to a unit", figure(self.rig.pixels_per_unit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_the_digits_they_need() {
        let texts =
            [0.0, 60.0, -0.05, 1.0 / 3.0, 123_456.7, 6e8, 2.5e-9, f64::INFINITY].map(figure);
        let expected =
            ["0", "60", "-0.05", "0.333333", "123457", "600000000", "2.5000e-9", "infinity"];
        assert_eq!(texts, expected);
        assert_eq!([pixels(-0.01), pixels(12.34)], ["0.0", "12.3"]);
    }

    #[test]
    fn parted_fields_have_a_gap() {
        let seen = FieldOfView { left: 40.0, stereo: -3.0, right: 40.0 };
        assert_eq!(angles(&seen), ["37.00", "gap 3.00", "37.00", "77.00"]);
        let seen = FieldOfView { left: 0.0, stereo: 30.0, right: -1e-15 };
        assert_eq!(angles(&seen), ["0.00", "30.00", "0.00", "30.00"]);
    }
}
