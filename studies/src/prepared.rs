//! A scene ready to be drawn.

use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
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
        Job::of(&self.geometry, self.config, self.options, self.lookup)
    }
}
