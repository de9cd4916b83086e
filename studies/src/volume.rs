//! The space that a rig shows: eyes and screen, perceived distances of those in the scene, disparities, and fields of
//! view (NASA 1992, table I and figures 5 to 7; Duvanenko and Robbins 1993, "Transforming Interocular Distance").

use crate::plot::{self, Series};
use serde::Serialize;
use serde_json::{json, Value};
use std::path::{Path, PathBuf};
use wheatstone_golden::files::WriteError;
use wheatstone_golden::projection::{Clipping, Device, FieldOfView, Kind, Range, Screen, Viewer};
use wheatstone_golden::scene::vector::turn;
use wheatstone_golden::scene::{Extent, Rig, Scene, SceneError};

mod table;

/// Distances that are the same but for rounding.
fn same(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= 1e-9 * a.abs().min(b.abs())
}

/// The volume that a rig shows, with one scene in it.
#[derive(Clone, Debug)]
pub struct Volume {
    size: [u32; 2],
    rig: Rig,
    viewer: Viewer,
    device: Option<Device>,
    ranges: Vec<Range>,
    extent: Extent,
}

/// A distance from the eyes in the scene, and what becomes of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Place {
    /// Name of the place; empty for a distance like any other.
    pub what: String,
    /// In the scene's unit.
    pub distance: f64,
    /// In the screen's unit; none where nothing is drawn.
    pub perceived: Option<f64>,
    /// Offset of the right eye's image from the left eye's, along the line of the eyes, in pixels: negative before the
    /// screen, positive behind it.
    pub disparity: Option<f64>,
}

/// Fields of view at a perceived distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Name of the distance.
    pub what: String,
    /// In the screen's unit.
    pub perceived: f64,
    /// Angles.
    pub seen: FieldOfView,
}

/// A length of the viewer or of the screen in all units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Length {
    /// Name of the length.
    pub what: &'static str,
    /// In the unit of the rig file's display, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub display: Option<f64>,
    /// In dots, which are pixels.
    pub dots: f64,
    /// In the screen's unit, which is the scene's unless the projection has a screen distance of its own.
    pub units: f64,
}

impl Volume {
    /// The volume of a scene's rig; `device` is the display that it follows from, if any.
    pub fn of(scene: &Scene, device: Option<Device>) -> Result<Volume, SceneError> {
        let rig = scene.rig.clone();
        let device = device.filter(|_| rig.projection.kind() == Kind::Translate);
        Ok(Volume {
            extent: scene.extent()?,
            size: [scene.width, scene.height],
            viewer: rig.viewer(),
            ranges: rig.ranges(),
            device,
            rig,
        })
    }

    /// The chain from physical lengths over dots to units.
    pub fn lengths(&self) -> [Length; 5] {
        let ppu = self.rig.pixels_per_unit;
        let [width, height] = self.size.map(f64::from);
        let dots = [
            ("dot pitch", 1.0),
            ("between the eyes", ppu * self.viewer.eye_distance),
            ("eyes to screen", ppu * self.viewer.screen_distance),
            ("width of the screen", width),
            ("height of the screen", height),
        ];
        dots.map(|(what, dots)| {
            let display = self.device.map(|device| dots * device.dot_pitch);
            Length { what, display, dots, units: dots / ppu }
        })
    }

    /// Name of a range.
    fn name(&self, index: usize) -> String {
        let one = self.rig.projection.kind() != Kind::Piecewise;
        if one {
            "drawn".into()
        } else {
            format!("partition {}", index + 1)
        }
    }

    fn disparity(&self, perceived: f64) -> f64 {
        self.rig.pixels_per_unit * self.viewer.disparity(perceived)
    }

    /// A distance seen through a range, or not seen.
    fn place(&self, what: impl Into<String>, distance: f64, range: Option<&Range>) -> Place {
        let perceived = range.map(|range| range.map.perceived(distance));
        let disparity = perceived.map(|perceived| self.disparity(perceived));
        Place { what: what.into(), distance, perceived, disparity }
    }

    /// The range that has a distance; where two meet, the farther one.
    fn range_at(&self, distance: f64) -> Option<&Range> {
        let holds = |range: &&Range| range.near <= distance && distance <= range.far;
        self.ranges.iter().rev().find(holds)
    }

    /// The ends of every range, as they are perceived.
    pub fn ends(&self) -> Vec<[Place; 2]> {
        let end = |(n, range): (usize, &Range)| {
            [("near", range.near), ("far", range.far)].map(|(end, distance)| {
                self.place(format!("{}, {end}", self.name(n)), distance, Some(range))
            })
        };
        self.ranges.iter().enumerate().map(end).collect()
    }

    /// The nearest and the farthest point of the scene.
    pub fn scene_ends(&self) -> Option<[Place; 2]> {
        let [nearest, farthest] = self.extent.distances?;
        let of = |what: &str, distance| self.place(what, distance, self.range_at(distance));
        Some([of("scene, nearest", nearest), of("scene, farthest", farthest)])
    }

    /// The place of the screen itself, if it is one distance.
    fn at_screen(&self) -> Option<Place> {
        let at = |range: &Range| {
            let distance = range.map.scene(self.viewer.screen_distance);
            let inside = range.map.slope > 0.0 && range.near < distance && distance < range.far;
            inside.then(|| self.place("screen", distance, Some(range)))
        };
        self.ranges.iter().find_map(at)
    }

    /// The distance map: ends of ranges, the screen, the scene, some distances between, and those
    /// that are asked for.
    pub fn map(&self, asked: &[f64]) -> Vec<Place> {
        let mut places = self.ends().concat();
        places.extend(self.at_screen());
        places.extend(self.scene_ends().into_iter().flatten());
        let limits = [self.ranges[0].near, self.ranges[self.ranges.len() - 1].far];
        for distance in asked.iter().copied().chain(round_between(limits)) {
            if !places.iter().any(|place| same(place.distance, distance)) {
                places.push(self.place("", distance, self.range_at(distance)));
            }
        }
        places.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        places
    }

    /// The screen as the eyes are beside each other before it.
    fn screen(&self) -> Screen {
        let across = turn(self.rig.head_tilt / 360.0)[0].abs();
        Screen {
            width: f64::from(self.size[0]) / self.rig.pixels_per_unit,
            distance: self.viewer.screen_distance,
            eye_distance: across * self.viewer.eye_distance,
        }
    }

    fn clipping(&self) -> Clipping {
        match self.rig.projection.kind() {
            Kind::Symmetric => Clipping::Symmetric,
            _ => Clipping::Asymmetric,
        }
    }

    /// Horizontal fields of view where both eyes begin to see the same, at the ends of the ranges,
    /// at the screen and at infinity, the nearest first.
    pub fn fields(&self) -> Vec<Field> {
        let (screen, clipping) = (self.screen(), self.clipping());
        let mut found: Vec<(String, f64)> = Vec::new();
        let mut add = |what: String, perceived: f64| match found
            .iter_mut()
            .find(|(_, other)| same(*other, perceived))
        {
            Some((known, _)) => *known = format!("{known}; {what}"),
            None => found.push((what, perceived)),
        };
        for (n, range) in self.ranges.iter().enumerate() {
            let [near, far] = range.perceived();
            let name = self.name(n);
            if same(near, far) {
                add(name, near);
            } else {
                add(format!("{name}, near"), near);
                add(format!("{name}, far"), far);
            }
        }
        add("screen".into(), screen.distance);
        add("infinity".into(), f64::INFINITY);
        let nearest = screen.nearest(clipping);
        if nearest > 0.0 {
            add("nearest for both eyes".into(), nearest);
        }
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        let field = |(what, perceived): (String, f64)| Field {
            what,
            perceived,
            seen: screen.field_of_view(clipping, perceived),
        };
        found.into_iter().map(field).collect()
    }

    /// All of it as JSON; `null` is an infinite distance, or nothing where nothing is drawn.
    pub fn json(&self, asked: &[f64]) -> Value {
        let fields = self.fields().into_iter().map(|field| {
            let Field { what, perceived, seen } = field;
            json!({ "what": what, "perceived": perceived, "left": seen.left, "stereo": seen.stereo,
                "right": seen.right, "total": seen.total() })
        });
        let Extent { polygons, undrawn, partly, .. } = self.extent;
        json!({
            "width": self.size[0],
            "height": self.size[1],
            "projection": self.rig.projection.kind().name(),
            "pixels_per_unit": self.rig.pixels_per_unit,
            "head_tilt": self.rig.head_tilt,
            "lengths": self.lengths(),
            "ranges": self.ends(),
            "scene_ends": self.scene_ends(),
            "polygons": { "all": polygons, "undrawn": undrawn, "partly": partly },
            "map": self.map(asked),
            "fields_of_view": fields.collect::<Vec<_>>(),
            "notes": self.notes(),
        })
    }

    /// Writes plots of the distance map and of the fields of view into a folder.
    pub fn plots(&self, folder: &Path) -> Result<Vec<PathBuf>, WriteError> {
        let files = ["distance_map.svg", "fields_of_view.svg"].map(|name| folder.join(name));
        let kind = self.rig.projection.kind().name();
        let map = [Series::new("perceived distance", self.curve()), self.screen_line()];
        let axes = ["distance in the scene", "perceived distance"];
        plot::lines(&files[0], &format!("Distance map, {kind}"), axes, &map)?;
        let (screen, clipping) = (self.screen(), self.clipping());
        let nearest = screen.nearest(clipping).max(screen.distance / 1000.0);
        let last = 4.0 * screen.distance.max(nearest);
        let steps = || (0..=300).map(|n| nearest + (last - nearest) * f64::from(n) / 300.0);
        let series = |name: &str, part: fn(&FieldOfView) -> f64| {
            let point = |d| (d, part(&screen.field_of_view(clipping, d)));
            Series::new(name, steps().map(point).collect())
        };
        let fields = [
            series("both eyes", |seen| seen.stereo),
            series("one eye at the left, and at the right", |seen| seen.left),
            // Where neither eye sees more than the other it lies on the first.
            series("total", FieldOfView::total).dashed(),
        ];
        let axes = ["perceived distance", "horizontal field of view / degrees"];
        plot::lines(&files[1], &format!("Fields of view, {kind}"), axes, &fields)?;
        Ok(files.into())
    }

    /// Distance at which the plot of the map ends: it shows the screen, the scene, and the beginning of the last
    /// partition.
    fn plotted(&self) -> f64 {
        let last = &self.ranges[self.ranges.len() - 1];
        let screen = self.at_screen().map_or(self.rig.viewing_distance, |place| place.distance);
        let scene = self.extent.distances.map_or(0.0, |[_, farthest]| 1.1 * farthest);
        last.far.min((3.0 * screen).max(1.5 * last.near).max(scene))
    }

    fn curve(&self) -> Vec<(f64, f64)> {
        // Far beyond the screen a curve would leave nothing of the rest to see.
        let most = 20.0 * self.viewer.screen_distance;
        let mut points = Vec::new();
        for range in &self.ranges {
            let [near, far] = [range.near, range.far.min(self.plotted())];
            let steps = (0..=200).map(|n| near + (far - near) * f64::from(n) / 200.0);
            points.extend(
                steps.map(|d| (d, range.map.perceived(d))).take_while(|&(_, seen)| seen <= most),
            );
            points.push((f64::NAN, f64::NAN));
        }
        points
    }

    fn screen_line(&self) -> Series {
        let at = self.viewer.screen_distance;
        Series::new("screen", vec![(self.ranges[0].near, at), (self.plotted(), at)])
    }
}

/// 1, 2 and 5 times the powers of ten between two positive numbers.
fn round_between([least, most]: [f64; 2]) -> impl Iterator<Item = f64> {
    let decades = least.log10().floor() as i32..=most.log10().floor() as i32;
    let all = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|n| n * 10f64.powi(decade)));
    all.filter(move |n| (least..=most).contains(n))
}
