//! Limits of reading files that others have written.
//!
//! The numbers are those of all readers ([`input::limits`]): far beyond what this program writes, and far
//! below what fills a memory.

use std::fmt::Display;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::Error;

pub use input::limits::{FMU_FILE, FMU_FILES, FMU_LIBRARY, FMU_UNPACKED, FMU_VALUES, RECORD_FILE, TEXT_FILE};

/// Most bytes of the file that names the model.
pub const MODEL_FILE: u64 = 1 << 10;

/// Numbers of bytes as texts show them.
pub(crate) fn shown(bytes: u64) -> String {
    match bytes {
        0 => "0 bytes".to_owned(),
        whole if whole.is_multiple_of(1 << 20) => format!("{} MiB", whole >> 20),
        whole if whole.is_multiple_of(1 << 10) => format!("{} KiB", whole >> 10),
        _ => format!("{bytes} bytes"),
    }
}

/// Opens a file of at most so many bytes, which must be a file and no folder, device or pipe.
///
/// # Errors
/// It is none, or has more bytes.
pub(crate) fn open(path: &Path, most: u64) -> Result<File, Error> {
    let refused = |why: &dyn Display| Error::new(format!("{} cannot be read: {why}", path.display()));
    let about = fs::metadata(path).map_err(|error| refused(&error))?;
    if !about.is_file() {
        return Err(refused(&"it is no file"));
    }
    if about.len() > most {
        let (own, most) = (shown(about.len()), shown(most));
        return Err(refused(&format!("it has {own}, and at most {most} are read")));
    }
    File::open(path).map_err(|error| refused(&error))
}

/// Returns the bytes of a file, if there are at most so many.
///
/// # Errors
/// As [`open`].
pub(crate) fn read(path: &Path, most: u64) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    // It may have grown since it was looked at.
    let done = open(path, most)?.take(most + 1).read_to_end(&mut bytes);
    let read = done.map_err(|error| Error::new(format!("{} cannot be read: {error}", path.display())))?;
    if read as u64 > most {
        let (path, most) = (path.display(), shown(most));
        return Err(Error::new(format!(
            "{path} cannot be read: it has more than {most}"
        )));
    }
    Ok(bytes)
}

/// Returns the text of a file, if it has at most so many bytes.
///
/// # Errors
/// As [`open`], and what is not UTF-8.
pub(crate) fn read_text(path: &Path, most: u64) -> Result<String, Error> {
    String::from_utf8(read(path, most)?)
        .map_err(|_| Error::new(format!("{} cannot be read: it is not UTF-8", path.display())))
}
