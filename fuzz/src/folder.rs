//! A folder for files that are written often: in memory, where there is such a place.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

/// The names of the folders.
const NAME: &str = "wedgelab-fuzz-";
/// The file that is locked while a folder is used.
const LOCK: &str = ".lock";

/// A folder that goes with this value. What a program leaves that is killed, the next one removes.
pub struct Folder {
    folder: TempDir,
    /// Kept locked; the system unlocks it when the program ends, however it ends.
    _lock: File,
}

impl Folder {
    /// Makes a folder, and removes those that nobody uses any more.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn make() -> io::Result<Self> {
        let place = place();
        remove_left_over(&place);
        let folder = tempfile::Builder::new().prefix(NAME).tempdir_in(place)?;
        let lock = File::create(folder.path().join(LOCK))?;
        lock.lock()?;
        Ok(Self { folder, _lock: lock })
    }

    /// Returns the path.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }
}

fn place() -> PathBuf {
    let memory = Path::new("/dev/shm");
    match memory.is_dir() {
        true => memory.to_owned(),
        false => std::env::temp_dir(),
    }
}

fn remove_left_over(place: &Path) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let ours = entry
            .file_name()
            .to_str()
            .is_some_and(|name| name.starts_with(NAME));
        // One without a lock is being made.
        let lock = File::open(entry.path().join(LOCK));
        if ours && lock.is_ok_and(|lock| lock.try_lock().is_ok()) {
            let _ = fs::remove_dir_all(entry.path());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_left_is_removed_and_what_is_used_is_not() {
        let place = tempfile::tempdir().unwrap();
        let [left, used, other] =
            ["wedgelab-fuzz-1", "wedgelab-fuzz-2", "other"].map(|name| place.path().join(name));
        let lock = |folder: &Path| {
            fs::create_dir(folder).unwrap();
            File::create(folder.join(LOCK)).unwrap()
        };
        drop([lock(&left), lock(&other)]);
        let held = lock(&used);
        held.lock().unwrap();
        remove_left_over(place.path());
        assert!(!left.exists() && used.exists() && other.exists());
    }
}
