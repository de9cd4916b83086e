//! Studies: what the publications print, computed anew, and ways to make the second view compared.
//!
//! An experiment is a function that returns a [`Report`]: tables of what is printed, what is correct
//! and what comes out here, with plots and pictures. [`EXPERIMENTS`] lists them.

pub mod adelson;
pub mod compare;
mod errata;
mod experiment;
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

pub use experiment::{Experiment, StudyError};
pub use report::{Check, Report, Row, Table, Verdict};

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
