//! Studies: what the publications print, computed anew, and ways to make the second view compared.
//!
//! An experiment is a function that returns a [`Report`]: tables of what is printed, what is correct
//! and what comes out here, with plots and pictures. [`EXPERIMENTS`] lists them.

pub mod adelson;
pub mod compare;
mod errata;
pub mod filter;
pub mod height_field;
pub mod nasa;
pub mod opengl;
pub mod p_buffer;
pub mod plot;
pub mod prepared;
pub mod published;
pub mod report;
pub mod reproduce;
pub mod timing;
pub mod village;
pub mod volume;

pub use report::{Check, Report, Row, Table, Verdict};

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
    /// What it computes, in one line.
    pub description: &'static str,
    /// Runs it; pictures and plots go into the folder, which exists.
    pub run: fn(&Path) -> Result<Report, StudyError>,
}

/// All experiments, in the order they are run.
pub const EXPERIMENTS: &[Experiment] = &[
    filter::EXPERIMENT,
    adelson::EXPERIMENT,
    village::EXPERIMENT,
    p_buffer::EXPERIMENT,
    opengl::EXPERIMENT,
    nasa::EXPERIMENT,
    height_field::EXPERIMENT,
];

/// Why an experiment could not be finished.
#[derive(Debug, Error)]
pub enum StudyError {
    /// A scene cannot be drawn.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Nothing could be drawn with OpenGL.
    #[error(transparent)]
    OpenGl(#[from] opengl::OpenGlError),
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
