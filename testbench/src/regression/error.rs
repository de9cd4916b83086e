//! Errors of the regression.

use crate::waves::WaveError;
use crate::{BuildError, JobError, LoadError, TraceError};
use std::path::PathBuf;
use std::sync::Arc;
use thiserror::Error;

/// The regression could not run.
#[derive(Debug, Error)]
pub enum RegressionError {
    /// A model could not be built; all cases that need it have this one error.
    #[error(transparent)]
    Build(#[from] Arc<BuildError>),
    /// A model could not be loaded.
    #[error(transparent)]
    Load(#[from] LoadError),
    /// A case does not fit its model.
    #[error(transparent)]
    Job(#[from] JobError),
    /// A waveform could not be written.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// The view of a waveform could not be written.
    #[error(transparent)]
    Wave(#[from] WaveError),
    /// A file could not be written.
    #[error("{path}: {source}")]
    File {
        /// Which one.
        path: PathBuf,
        /// The cause.
        source: std::io::Error,
    },
    /// The worker threads could not be started.
    #[error("cannot start worker threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}

impl From<BuildError> for RegressionError {
    fn from(error: BuildError) -> RegressionError {
        RegressionError::Build(Arc::new(error))
    }
}
