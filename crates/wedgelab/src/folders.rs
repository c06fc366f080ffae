//! The folders that a command writes into, checked before it computes anything.

use std::path::{Path, PathBuf};

use report::files::{self, Folder};

use crate::failure::{Failure, say};

/// Returns a folder for these files, as [`Folder::check`] has it; tells what killed runs had left beside it
/// and is removed.
pub fn check(path: impl Into<PathBuf>, names: &[&str], force: bool) -> Result<Folder, Failure> {
    let folder = Folder::check(path, names, force).map_err(|error| Failure::Input(error.into()))?;
    tell_removed(&files::remove_left_over([&folder]));
    Ok(folder)
}

/// As [`check`], for several folders.
pub fn check_all<'n>(
    folders: impl IntoIterator<Item = (PathBuf, &'n [&'n str])>,
    force: bool,
) -> Result<Vec<Folder>, Failure> {
    let folders = files::check_all(folders, force).map_err(|error| Failure::Input(error.into()))?;
    tell_removed(&files::remove_left_over(&folders));
    Ok(folders)
}

/// Tells which hidden folders were removed.
pub fn tell_removed(removed: &[PathBuf]) {
    for path in removed {
        let path = path.strip_prefix(Path::new(".")).unwrap_or(path);
        say(&format!(
            "removed `{}`, left by a run that was killed",
            path.display()
        ));
    }
}
