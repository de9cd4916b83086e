//! The builder of models.

use super::failure::Failure;
use super::folders::cache_folder;
use crate::tools::Toolchain;
use crate::{workspace, Builder};

/// A builder of models that tells on the terminal what it does.
pub(super) fn builder(quiet: bool) -> Result<Builder, Failure> {
    let builder = Builder::new(
        Toolchain::find()?,
        cache_folder(workspace::find(), Builder::CACHE, |name| std::env::var_os(name)),
    );
    Ok(builder.on_progress(move |progress| {
        if !quiet {
            tell!("{progress}");
        }
    }))
}
