//! Studies: what the publications print, computed anew, and ways to make the second view compared.
//!
//! An experiment is a function that returns a [`Report`]: tables of what is printed, what is correct
//! and what comes out here, with plots and pictures. [`EXPERIMENTS`] lists them.

pub mod plot;
pub mod report;
pub mod timing;
pub mod village;

pub use report::{Check, Report, Row, Table, Verdict};

use std::path::Path;
use thiserror::Error;
use wheatstone_golden::picture::WriteError;
use wheatstone_golden::scene::SceneError;
use wheatstone_golden::visibility::renderer::RendererError;
use wheatstone_golden::visibility::VisibilityError;

/// An experiment that `wheatstone reproduce` can run.
#[derive(Clone, Copy, Debug)]
pub struct Experiment {
    /// Its name on the command line.
    pub name: &'static str,
    /// What it computes, in one line.
    pub description: &'static str,
    /// Runs it; pictures and plots go into the folder, which exists.
    pub run: fn(&Path) -> Result<Report, StudyError>,
}

/// All experiments, in the order they are run.
pub const EXPERIMENTS: &[Experiment] = &[Experiment {
    name: "village",
    description: "hidden surfaces for both views at once: BSP/z-buffer, scan line, village",
    run: village::run,
}];

/// Why an experiment could not be finished.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A scene cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
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
