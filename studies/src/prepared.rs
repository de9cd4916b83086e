//! A scene ready to be drawn.

use std::sync::OnceLock;
use wheatstone_golden::config::Config;
use wheatstone_golden::formats::Formats;
use wheatstone_golden::scene::{self, Geometry, Scene, SceneError};
use wheatstone_golden::setup::Options;
use wheatstone_golden::stereo::Job;
use wheatstone_golden::texture::Lookup;
use wheatstone_golden::visibility::bsp::Tree;
use wheatstone_golden::visibility::Surfaces;

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
    /// Method of texture sampling.
    pub lookup: Lookup,
    tree: OnceLock<Tree>,
}

impl Prepared {
    /// Lights, projects, clips and snaps a scene for the default configuration.
    pub fn new(scene: Scene) -> Result<Prepared, SceneError> {
        let config = Config::DEFAULT;
        let geometry = scene.geometry(&Formats::new(&config), &scene::Options::default())?;
        Ok(Prepared::of(scene, geometry, config, Options::new(&config), Lookup::Nearest))
    }

    /// A scene, its polygons, and how to draw them.
    pub fn of(
        scene: Scene,
        geometry: Geometry,
        config: Config,
        options: Options,
        lookup: Lookup,
    ) -> Prepared {
        Prepared { scene, geometry, config, options, lookup, tree: OnceLock::new() }
    }

    /// The BSP tree of its polygons; made when it is first asked for.
    pub fn tree(&self, surfaces: &Surfaces) -> &Tree {
        self.tree.get_or_init(|| Tree::new(surfaces))
    }

    /// The job that draws it.
    pub fn job(&self) -> Job<'_> {
        Job::of(&self.geometry, self.config, self.options, self.lookup)
    }
}
