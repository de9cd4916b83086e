//! Folders that commands read from and write to when none is named.

use super::failure::Failure;
use crate::workspace::{self, MARK};
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// The folder of the Verilog, if need be that of the workspace.
pub(super) fn rtl_folder(named: &Option<PathBuf>) -> Result<PathBuf, Failure> {
    if let Some(folder) = named {
        return Ok(folder.clone());
    }
    // As short as it can be: the name shows up in messages.
    if Path::new(MARK).exists() {
        return Ok("rtl".into());
    }
    workspace::find().map(|folder| folder.join("rtl")).ok_or_else(|| {
        Failure::Input(
            "no folder rtl with sam_formats.vh here or above; name it with --rtl DIR".into(),
        )
    })
}

/// The folder of the workspace; an error if there is none.
pub(super) fn root() -> Result<PathBuf, Failure> {
    workspace::find()
        .ok_or_else(|| Failure::Input(format!("no workspace here or above: no {MARK}")))
}

/// Folder for what is built: `name` in the workspace, or else in the user's cache.
pub(super) fn cache_folder(
    workspace: Option<PathBuf>,
    name: &str,
    variable: impl Fn(&str) -> Option<OsString>,
) -> PathBuf {
    if let Some(folder) = workspace {
        return folder.join(name);
    }
    let folder = |name: &str| variable(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let caches = folder("XDG_CACHE_HOME").or_else(|| Some(folder("HOME")?.join(".cache")));
    caches.unwrap_or_else(std::env::temp_dir).join("wheatstone")
}

/// Folder for what a command writes when no other is named.
pub(super) fn output_folder(name: &str) -> PathBuf {
    Path::new("target/wheatstone").join(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_kept_in_the_workspace_or_in_the_cache_of_the_user() {
        const CACHE: &str = "target/wheatstone/models";
        let folder = |workspace: Option<&str>, set: &[(&str, &str)]| {
            cache_folder(workspace.map(PathBuf::from), CACHE, |name| {
                set.iter().find(|(n, _)| *n == name).map(|(_, value)| value.into())
            })
        };
        let (cache, home) = (("XDG_CACHE_HOME", "/c"), ("HOME", "/home/w"));
        let models = PathBuf::from("/w/target/wheatstone/models");
        assert_eq!(folder(Some("/w"), &[cache, home]), models);
        assert_eq!(folder(None, &[cache, home]), PathBuf::from("/c/wheatstone"));
        let at_home = PathBuf::from("/home/w/.cache/wheatstone");
        assert_eq!(folder(None, &[home]), at_home);
        // As its standard says, a relative one does not count.
        assert_eq!(folder(None, &[("XDG_CACHE_HOME", "c"), home]), at_home);
        assert_eq!(folder(None, &[]), std::env::temp_dir().join("wheatstone"));
    }
}
