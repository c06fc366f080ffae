//! The hidden folders in which files are written until all of them are whole.
//!
//! A program holds a lock on a file inside its hidden folder. The system releases the lock when the program
//! ends, however it ends: a hidden folder whose lock can be taken belongs to nobody and may be removed. This
//! module knows all hidden folders of this program, so that [`abandon`] can remove them when the program is
//! told to end.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::{FileError, Folder};

/// The prefix of the names of hidden folders.
pub const PREFIX: &str = ".wedgelab-";
/// Number of letters and digits that follow.
const RANDOM: usize = 6;
/// The locked file in a hidden folder.
const LOCK: &str = "lock";
/// The folder for the files of the result. The hidden one is private to the user, results are not.
const RESULT: &str = "result";
/// A hidden folder without a lock, as earlier versions made them, is left over when it is older than this.
const OLD: Duration = Duration::from_secs(24 * 3600);
/// Largest number of times that a hidden folder is made anew when another program that looks for leftovers
/// takes it.
const ATTEMPTS: u32 = 20;

/// The folders that this program is writing, and the one written last.
struct Register {
    open: Vec<Open>,
    placed: Option<PathBuf>,
}

struct Open {
    hidden: PathBuf,
    /// The folder whose files are written here; none while a folder is only tried.
    folder: Option<Folder>,
}

static REGISTER: Mutex<Register> = Mutex::new(Register {
    open: Vec::new(),
    placed: None,
});

fn register() -> MutexGuard<'static, Register> {
    REGISTER.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A hidden folder that this program holds; it is removed when it is dropped.
pub(super) struct Staging {
    path: PathBuf,
    lock: Option<File>,
}

impl Staging {
    /// Makes a hidden folder in the folder `beside`, for the files of `folder`, or only to try whether it can
    /// be made.
    pub fn new(beside: &Path, folder: Option<&Folder>) -> Result<Self, FileError> {
        let failed = |reason: io::Error| FileError::Unwritable {
            folder: beside.to_owned(),
            reason: plain(&reason),
        };
        // Held all the time: no hidden folder comes into being that `abandon` does not know.
        let mut register = register();
        for _ in 0..ATTEMPTS {
            let made = tempfile::Builder::new()
                .prefix(PREFIX)
                .rand_bytes(RANDOM)
                .tempdir_in(beside)
                .map_err(failed)?;
            if let Some(lock) = hold(made.path()).map_err(failed)? {
                let path = made.keep();
                register.open.push(Open {
                    hidden: path.clone(),
                    folder: folder.cloned(),
                });
                let lock = Some(lock);
                return Ok(Self { path, lock });
            }
        }
        Err(failed(io::Error::other(
            "another program removes what is written there",
        )))
    }

    /// Makes the folder for the files of the result.
    pub fn result(&self) -> io::Result<PathBuf> {
        let result = self.path.join(RESULT);
        fs::create_dir(&result)?;
        Ok(result)
    }

    /// Puts the files in their place by `place`, undisturbed by [`abandon`].
    pub fn place(folder: &Path, place: impl FnOnce() -> Result<(), FileError>) -> Result<(), FileError> {
        let mut register = register();
        place()?;
        register.placed = Some(folder.to_owned());
        Ok(())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let mut register = register();
        // Some systems remove no file that is open.
        self.lock = None;
        remove(&self.path);
        register.open.retain(|open| open.hidden != self.path);
    }
}

/// Locks the file in a new hidden folder; `None` if another program has taken the folder for a leftover
/// meanwhile.
fn hold(hidden: &Path) -> io::Result<Option<File>> {
    let path = hidden.join(LOCK);
    let lock = match File::create_new(&path) {
        Ok(lock) => lock,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error),
    };
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => Ok(None),
        // A file system without locks has leftovers that are old.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(path.exists().then_some(lock)),
    }
}

/// Removes a hidden folder of this program, in which another thread may be writing.
fn remove(hidden: &Path) {
    for _ in 0..ATTEMPTS {
        // Fails if a file is added meanwhile; with the folder `result` gone no more are added.
        if remove_all(hidden).is_ok() || !hidden.exists() {
            return;
        }
    }
}

/// Removes a hidden folder with all that is in it, the lock last: when this is cut short, what is there
/// belongs to nobody.
fn remove_all(hidden: &Path) -> io::Result<()> {
    match fs::remove_dir_all(hidden.join(RESULT)) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    fs::remove_dir_all(hidden)
}

/// The end of all writing of this program: while this lives, no file is begun and none is put in its place.
pub struct Abandoned {
    register: MutexGuard<'static, Register>,
}

impl Abandoned {
    /// Returns the folder that this program has put files into last, if it has put any into their place.
    #[must_use]
    pub fn placed(&self) -> Option<&Path> {
        self.register.placed.as_deref()
    }
}

/// Gives up all files that are not in their place yet and removes their hidden folders. For a program that
/// ends at once: it keeps what is returned until then.
#[must_use = "files may be written again when this is dropped"]
pub fn abandon() -> Abandoned {
    let mut register = register();
    for open in std::mem::take(&mut register.open) {
        remove(&open.hidden);
        if let Some(folder) = open.folder {
            folder.remove_empty();
        }
    }
    Abandoned { register }
}

/// Removes the hidden folders that killed programs left where the files of these folders are written, and
/// returns their paths. What a living program holds is not touched.
#[must_use = "the user should know what was removed"]
pub fn remove_left_over<'f>(folders: impl IntoIterator<Item = &'f Folder>) -> Vec<PathBuf> {
    let places: BTreeSet<PathBuf> = folders
        .into_iter()
        .flat_map(|folder| [&folder.path, super::parent(&folder.path), &folder.existing].map(Path::to_owned))
        .collect();
    let mut removed = Vec::new();
    for place in places {
        let Ok(entries) = fs::read_dir(&place) else {
            continue;
        };
        for entry in entries.flatten() {
            if entry.file_name().to_str().is_some_and(is_hidden) && remove_if_nobodys(&entry.path()) {
                removed.push(entry.path());
            }
        }
    }
    removed
}

/// Returns whether a name is one of those that hidden folders have, or the files of earlier versions, which
/// end with `.tmp`.
fn is_hidden(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX);
    let random = random.map(|rest| rest.strip_suffix(".tmp").unwrap_or(rest));
    random.is_some_and(|random| {
        random.len() == RANDOM && random.bytes().all(|sign| sign.is_ascii_alphanumeric())
    })
}

/// Removes what has the name of a hidden folder unless it may be in use; tells whether it did.
fn remove_if_nobodys(path: &Path) -> bool {
    let Ok(found) = fs::symlink_metadata(path) else {
        return false;
    };
    // A clock that was set back makes nothing old.
    let age = found.modified().ok().and_then(|time| time.elapsed().ok());
    let old = age.is_some_and(|age| age > OLD);
    if !found.is_dir() {
        return found.is_file() && old && fs::remove_file(path).is_ok();
    }
    match OpenOptions::new().write(true).open(path.join(LOCK)) {
        Ok(lock) => {
            let free = match lock.try_lock() {
                Ok(()) => true,
                Err(TryLockError::WouldBlock) => false,
                Err(TryLockError::Error(_)) => old,
            };
            // Locked until it is gone, so that whoever is about to lock it makes another one.
            free && remove_all(path).is_ok()
        }
        // An empty one may have been made at this moment: its program makes another one then.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            fs::remove_dir(path).is_ok() || old && remove_all(path).is_ok()
        }
        Err(_) => false,
    }
}

/// Returns the system's error without the name of the hidden folder, which means nothing to anybody.
fn plain(error: &io::Error) -> io::Error {
    let text = error.to_string();
    let own = text.split(" at path ").next().unwrap_or_default();
    io::Error::new(error.kind(), own.to_owned())
}
