//! A scene ready to be drawn.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Formats, Rgba};
use wheatstone_golden::frame::Frame;
use wheatstone_golden::picture::{colour_picture, RgbImage};
use wheatstone_golden::scene::{self, Geometry, Scene, SceneError};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// A scene with its polygons, for the default configuration.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The scene: eyes, meshes, light.
    pub scene: Scene,
    /// Its polygons, snapped.
    pub geometry: Geometry,
}

impl Prepared {
    /// Build parameters of the hardware that is modelled.
    pub const CONFIG: Config = Config::DEFAULT;

    /// Lights, projects, clips and snaps a scene.
    pub fn new(scene: Scene) -> Result<Prepared, SceneError> {
        let formats = Formats::new(&Prepared::CONFIG);
        let geometry = scene.geometry(&formats, &scene::Options::default())?;
        Ok(Prepared { scene, geometry })
    }

    /// The job that draws it.
    pub fn job(&self) -> Job<'_> {
        Job {
            config: Prepared::CONFIG,
            options: Options::new(&Prepared::CONFIG),
            width: self.geometry.width,
            height: self.geometry.height,
            background: self.geometry.background.rgb(),
            polygons: &self.geometry.polygons,
            textures: &self.geometry.textures,
            lookup: Lookup::Nearest,
        }
    }
}

/// The colours of a frame.
pub fn picture(frame: &Frame) -> RgbImage {
    let colours: Vec<Rgba> = frame.colour.iter().map(|&[r, g, b]| Rgba([r, g, b, 255])).collect();
    colour_picture(frame.width, frame.height, &colours)
}
