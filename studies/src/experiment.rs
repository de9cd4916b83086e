//! Experiments and why they fail.

use crate::opengl::OpenGlError;
use crate::report::Report;
use std::path::Path;
use thiserror::Error;
use wheatstone_golden::files::WriteError;
use wheatstone_golden::scene::SceneError;
use wheatstone_golden::visibility::renderer::RendererError;
use wheatstone_golden::visibility::VisibilityError;

/// An experiment that `wheatstone reproduce` can run.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name on the command line.
    pub name: &'static str,
    /// Its line in `wheatstone list`.
    pub description: &'static str,
    /// Runs it; pictures and plots go into the folder, which exists.
    pub run: fn(&Path) -> Result<Report, StudyError>,
}

/// The reason why an experiment could not be finished.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A scene cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Nothing could be drawn with OpenGL.
    #[error(transparent)]
    OpenGl(#[from] OpenGlError),
    /// A scene is not for the simple renderer.
    #[error(transparent)]
    Renderer(#[from] RendererError),
    /// Hidden surfaces of a scene cannot be resolved for both views at once.
    #[error(transparent)]
    Visibility(#[from] VisibilityError),
    /// A picture, a plot or a table could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
