//! The folder of the project that the program is called in.

use std::path::{Path, PathBuf};

/// The file by which a workspace is known.
pub(crate) const MARK: &str = "rtl/sam_formats.vh";

/// The workspace that the program is called in, or else the one that it was built from.
pub(crate) fn find() -> Option<PathBuf> {
    let here = std::env::current_dir().unwrap_or_default();
    let source = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = here.ancestors().chain(source.ancestors());
    folders.find(|folder| folder.join(MARK).exists()).map(Path::to_path_buf)
}
