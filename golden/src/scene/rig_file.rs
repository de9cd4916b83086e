//! Rig files: where the eyes are, how large the screen is, how a mesh is placed and lit.
//!
//! A rig file is a JSON object of at most 256 KiB. All fields are optional and replace those of the scene; others
//! than these are refused:
//!
//! | field | value | default for meshes |
//! | --- | --- | --- |
//! | `width`, `height` | size of each view in pixels, 1 to 2048 (both or neither) | 640, 480 |
//! | `pixels_per_unit` | pixels to a unit of length on the screen | 20 at 640 × 480, in proportion otherwise |
//! | `eye_separation` | distance between the eyes | 6.5 |
//! | `viewing_distance` | distance from the eyes to the screen | 60 |
//! | `near`, `far` | distances from the eyes to the planes that cut the scene | a hundredth and a hundred times the viewing distance, or what the projection says |
//! | `head_tilt` | degrees by which the right eye is turned up | 0 |
//! | `projection` | name of a projection, see `wheatstone list`; `--projection` goes before it | `"two-centres"` |
//! | `translate`, `asymptotic`, `piecewise` | objects with the parameters of these projections, see below; used where the projection is theirs | |
//! | `background` | `[red, green, blue]`, 0 to 255 | `[40, 44, 52]` |
//! | `placement` | object, see below; concerns meshes and height fields | |
//! | `light` | object, see below; concerns scenes that are lit | |
//!
//! `placement`: the mesh is turned by `rotation`, `[x, y, z]` in degrees, about its y axis first,
//! then x, then z (right-hand rule in the mesh's own, right-handed coordinates: z towards the
//! viewer; default `[0, 0, 0]`), then so that it is seen from the direction of the point `eye` in
//! these coordinates with the direction `up` upright, if there is
//! `"view": {"eye": [x, y, z], "up": [x, y, z]}`; its
//! bounding box is centred on the screen and its longest side scaled to `fit` (default 0.8, of a
//! height field 1.15) times the smaller side of the screen, and it is moved by `offset` (`[x, y, z]` in units, z away from
//! the viewer; default `[0, 0, 0]`). With `"fit": null` it is neither centred nor scaled.
//! The heights of a height field are first multiplied so that their range is `relief` (default 0.1;
//! `null` leaves them as they are) times its longer side.
//!
//! `translate`: the display from which `eye_separation` and `viewing_distance` follow, instead of
//! being given (a file that has `translate` and one of them is refused): `eye_distance`, `viewing_distance` and `dot_pitch` in inches or any other unit, all
//! three. A dot is a pixel.
//!
//! `asymptotic`: `screen_intercept` is the distance in the scene that is seen at the screen (default:
//! the viewing distance), `screen_distance` the distance of the screen (viewing distance),
//! `max_distance` where infinity is seen (twice `screen_distance`; `null` is infinity),
//! `min_distance` the nearest distance at which anything is seen (none; puts the near plane),
//! `eye_distance` that between the eyes (`eye_separation` in proportion to `screen_distance`).
//! All but the first are in the unit to which `pixels_per_unit` refers, which need not be the scene's.
//!
//! `piecewise`: `screen_distance` and `eye_distance` as above; `partitions` is a list of objects, the
//! nearest first and 1,000 at most, which may not overlap: what is at `near` to `far` in the scene is seen at
//! `min_distance` to `max_distance`, all four, equal ones for a flat partition. What is in none is not
//! drawn. Default, in viewing distances and screen distances: 0.5 to 1 at 0.75 to 1, 1 to 1.25 at
//! 1, 1.25 to 2 at 1 to 1.5, 2 to `far` (100) at 1.5.
//!
//! `light`: `direction` towards the light (`[x, y, z]`, z away; default `[-2, 4, -3]`), its
//! `colour` (default `[0.8, 0.8, 0.8]`; 1 is white) and the `ambient` light (default
//! `[0.25, 0.25, 0.25]`). What is not given takes its default, and all other lights go.

use super::error::{check_size, InputError, RigError, SceneError, COORDINATE_LIMIT, SIZE_LIMIT};
use super::json::{parse, Channel};
use super::light::{Light, Lighting, Source};
use super::locate::Locator;
use super::place::Placement;
use super::rig::Rig;
use super::vector::Vec3;
use super::Scene;
use crate::projection::{check_length, shown, Asymptotic, Device, Kind, Piecewise, Projection};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// Largest rig file, in bytes: some times what the most partitions take, and little enough for a pack to have it in
/// its manifest.
pub const RIG_LIMIT: usize = 256 << 10;

/// A rig file as it stands.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigFile {
    width: Option<u32>,
    height: Option<u32>,
    pixels_per_unit: Option<f64>,
    eye_separation: Option<f64>,
    viewing_distance: Option<f64>,
    near: Option<f64>,
    far: Option<f64>,
    head_tilt: Option<f64>,
    projection: Option<Kind>,
    translate: Option<Device>,
    asymptotic: Option<Asymptotic>,
    piecewise: Option<Piecewise>,
    background: Option<[Channel; 3]>,
    #[serde(default)]
    placement: Placement,
    light: Option<LightFile>,
    #[serde(skip)]
    file: PathBuf,
    #[serde(skip)]
    text: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LightFile {
    direction: Option<Vec3>,
    colour: Option<Vec3>,
    ambient: Option<Vec3>,
}

impl RigFile {
    /// Reads a rig file.
    pub fn load(file: &Path) -> Result<RigFile, SceneError> {
        let text = super::error::read_text(file)?;
        RigFile::read(file, text)
    }

    /// Reads a rig file's text; `file` is its name in messages.
    pub fn read(file: &Path, text: String) -> Result<RigFile, SceneError> {
        if text.len() > RIG_LIMIT {
            let (expected, found) =
                (format!("at most {RIG_LIMIT} bytes"), format!("{} bytes", text.len()));
            return Err(InputError::new(file, None, "file", expected, found).into());
        }
        let rig: RigFile = parse(file, &text)?;
        let rig = RigFile { file: file.to_owned(), text, ..rig };
        rig.check()?;
        Ok(rig)
    }

    /// A file that says nothing, for what has another `name` in messages.
    pub fn empty(name: &Path) -> RigFile {
        RigFile { file: name.to_owned(), ..RigFile::default() }
    }

    fn wrong(&self, field: &str, expected: &str, found: String) -> InputError {
        let line = Locator::new(&self.text).line_of(field);
        InputError::new(&self.file, line, field, expected, found)
    }

    fn check(&self) -> Result<(), SceneError> {
        if let (Some(n), None) | (None, Some(n)) = (self.width, self.height) {
            let field = if self.width.is_some() { "width" } else { "height" };
            let expected = "width and height, or neither";
            return Err(self.wrong(field, expected, format!("{n} alone")).into());
        }
        let beside =
            [("eye_separation", self.eye_separation), ("viewing_distance", self.viewing_distance)];
        if let (Some(_), Some((field, Some(n)))) =
            (self.translate, beside.into_iter().find(|(_, value)| value.is_some()))
        {
            let expected = "translate or this, not both: it follows from translate's lengths";
            return Err(self.wrong(field, expected, format!("{n} beside translate")).into());
        }
        for (field, value) in [("width", self.width), ("height", self.height)] {
            if value.is_some_and(|n| n == 0 || n > SIZE_LIMIT) {
                let found = value.unwrap_or_default().to_string();
                return Err(self.wrong(field, "1 to 2048 pixels", found).into());
            }
        }
        let limit = COORDINATE_LIMIT;
        let vector = |field: &str, value: Option<Vec3>, least: f64, most: f64| {
            let legal = value.is_none_or(|v| v.iter().all(|n| (least..=most).contains(n)));
            let expected = format!("three numbers from {least} to {most}");
            let found = || value.map(|v| format!("{v:?}")).unwrap_or_default();
            if legal {
                Ok(())
            } else {
                Err(self.wrong(field, &expected, found()))
            }
        };
        vector("placement.rotation", Some(self.placement.rotation), -360.0, 360.0)?;
        vector("placement.offset", Some(self.placement.offset), -limit, limit)?;
        if let Some(fit) =
            self.placement.fit.flatten().filter(|fit| !(0.001..=1000.0).contains(fit))
        {
            let expected = "0.001 to 1000 or null";
            return Err(self.wrong("placement.fit", expected, fit.to_string()).into());
        }
        if let Some(relief) = self.placement.relief.filter(|n| !(0.0..=1000.0).contains(n)) {
            let expected = "0 to 1000 or null";
            return Err(self.wrong("placement.relief", expected, relief.to_string()).into());
        }
        if let Some(view) = &self.placement.view {
            vector("placement.view.eye", Some(view.eye), -limit, limit)?;
            vector("placement.view.up", Some(view.up), -limit, limit)?;
            if view.eye == [0.0; 3] {
                let expected = "a point other than the origin, which is looked at";
                return Err(self.wrong("placement.view.eye", expected, "the origin".into()).into());
            }
            if view.axes().is_none() {
                let expected = format!("a direction across the line of sight to {:?}", view.eye);
                let found = format!("{:?}", view.up);
                return Err(self.wrong("placement.view.up", &expected, found).into());
            }
        }
        if let Some(light) = &self.light {
            vector("light.direction", light.direction, -limit, limit)?;
            if light.direction == Some([0.0; 3]) {
                let found = "a direction of length zero".into();
                return Err(self.wrong("light.direction", "a direction", found).into());
            }
            vector("light.colour", light.colour, 0.0, 100.0)?;
            vector("light.ambient", light.ambient, 0.0, 100.0)?;
        }
        // The rest is checked together with what it is combined with.
        Ok(())
    }

    /// Size of the views, if the file says it.
    pub fn size(&self) -> Option<[u32; 2]> {
        Some([self.width?, self.height?])
    }

    /// The display from which the rig of a [`Kind::Translate`] follows, if the file has one.
    pub fn device(&self) -> Option<Device> {
        self.translate
    }

    /// Placement of a mesh.
    pub fn placement(&self) -> Placement {
        self.placement.clone()
    }

    /// Changes a scene as the file says, and to views of `size` and a projection of `kind` if there
    /// are any.
    pub fn apply(
        &self,
        scene: &mut Scene,
        size: Option<[u32; 2]>,
        kind: Option<Kind>,
    ) -> Result<(), SceneError> {
        if let Some([width, height]) = size {
            scene.resize(width, height)?;
        }
        check_size(scene.width, scene.height, SIZE_LIMIT)?;
        let rig = &mut scene.rig;
        let replace = |old: &mut f64, new: Option<f64>| *old = new.unwrap_or(*old);
        replace(&mut rig.pixels_per_unit, self.pixels_per_unit);
        replace(&mut rig.eye_separation, self.eye_separation);
        replace(&mut rig.viewing_distance, self.viewing_distance);
        replace(&mut rig.head_tilt, self.head_tilt);
        rig.near = self.near.or(rig.near);
        rig.far = self.far.or(rig.far);
        self.project(rig, kind)
            .and_then(|()| rig.check())
            .and_then(|()| rig.scissor(scene.width))
            .map_err(|error| error.within(&self.file, &self.text))?;
        if let Some(background) = self.background {
            scene.background = background.map(|c| c.0);
        }
        if let (Some(light), Some(lighting)) = (&self.light, &mut scene.lighting) {
            *lighting = light.lighting();
        }
        Ok(())
    }
}

impl RigFile {
    /// Refuses a scene that was placed so far away that it cannot be drawn, which is this file's doing.
    pub(super) fn check_placed(&self, scene: &Scene) -> Result<(), SceneError> {
        let mut coordinates = scene.meshes.iter().flat_map(|mesh| mesh.positions.iter().flatten());
        if coordinates.all(|n| n.abs() <= COORDINATE_LIMIT) {
            return Ok(());
        }
        let Placement { fit, offset, .. } = &self.placement;
        let (field, found) = match (fit, self.pixels_per_unit) {
            (None | Some(Some(_)), Some(n)) => ("pixels_per_unit", shown(n)),
            (Some(fit), _) if *offset == [0.0; 3] => {
                ("placement.fit", fit.map_or("null".into(), |fit| fit.to_string()))
            }
            _ => ("placement.offset", format!("{offset:?}")),
        };
        let limit = COORDINATE_LIMIT;
        let expected = format!("what puts no coordinate of the mesh beyond {limit:e}");
        Err(self.wrong(field, &expected, found).into())
    }

    /// Gives a rig the projection of `kind`, or else the file's, with the file's parameters.
    fn project(&self, rig: &mut Rig, kind: Option<Kind>) -> Result<(), RigError> {
        let Some(kind) = kind.or(self.projection) else { return Ok(()) };
        rig.projection = match kind {
            Kind::Asymptotic => Projection::Asymptotic(self.asymptotic.unwrap_or_default()),
            Kind::Piecewise => Projection::Piecewise(self.piecewise.clone().unwrap_or_default()),
            kind => Projection::from(kind),
        };
        let Some(device) = self.translate.filter(|_| kind == Kind::Translate) else {
            return Ok(());
        };
        check_length("translate.eye_distance", device.eye_distance)?;
        check_length("translate.viewing_distance", device.viewing_distance)?;
        check_length("translate.dot_pitch", device.dot_pitch)?;
        check_length("pixels_per_unit", rig.pixels_per_unit)?;
        let view_units = |field: &str, length: f64| {
            let units = device.view_units(length, rig.pixels_per_unit);
            check_length(field, units).map(|()| units).map_err(|error| {
                let expected = "in units (length / dot_pitch / pixels_per_unit)";
                RigError { expected: format!("{}, {expected}", error.expected), ..error }
            })
        };
        rig.eye_separation = view_units("translate.eye_distance", device.eye_distance)?;
        rig.viewing_distance = view_units("translate.viewing_distance", device.viewing_distance)?;
        Ok(())
    }
}

impl LightFile {
    fn lighting(&self) -> Lighting {
        let mut lighting = Lighting::default();
        lighting.ambient = self.ambient.unwrap_or(lighting.ambient);
        for Light { source, colour } in &mut lighting.lights {
            *source = self.direction.map_or(*source, Source::Direction);
            *colour = self.colour.unwrap_or(*colour);
        }
        lighting
    }
}
