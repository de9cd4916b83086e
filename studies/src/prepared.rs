//! A scene ready to be drawn.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::{Formats, Rgba};
use wheatstone_golden::frame::Frame;
use wheatstone_golden::picture::{colour_picture, RgbImage};
use wheatstone_golden::scene::{self, Geometry, Scene, SceneError};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;

/// A scene with its polygons, and how they are drawn.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The scene: eyes, meshes, light.
    pub scene: Scene,
    /// Its polygons, snapped.
    pub geometry: Geometry,
    /// Build parameters of the hardware that is modelled.
    pub config: Config,
    /// Choices of setup.
    pub options: Options,
    /// How textures are sampled.
    pub lookup: Lookup,
}

impl Prepared {
    /// Lights, projects, clips and snaps a scene for the default configuration.
    pub fn new(scene: Scene) -> Result<Prepared, SceneError> {
        let config = Config::DEFAULT;
        let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default())?;
        let (options, lookup) = (Options::new(&config), Lookup::Nearest);
        Ok(Prepared { scene, geometry, config, options, lookup })
    }

    /// The job that draws it.
    pub fn job(&self) -> Job<'_> {
        Job {
            config: self.config,
            options: self.options,
            width: self.geometry.width,
            height: self.geometry.height,
            background: self.geometry.background.rgb(),
            polygons: &self.geometry.polygons,
            textures: &self.geometry.textures,
            lookup: self.lookup,
        }
    }
}

/// The colours of a frame.
pub fn picture(frame: &Frame) -> RgbImage {
    let colours: Vec<Rgba> = frame.colour.iter().map(|&[r, g, b]| Rgba([r, g, b, 255])).collect();
    colour_picture(frame.width, frame.height, &colours)
}
