//! Files, read up to a size, after a check of their types.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::FileType;
use crate::file_type::HEAD;

/// The type of file that a command expects.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// Its name in messages, such as `case file`.
    pub what: &'static str,
    /// The types that it may have; files that say nothing of their type are read.
    pub types: &'static [FileType],
    /// Most bytes.
    pub most: u64,
}

/// The reason why a file was not read. It names the file.
#[derive(Debug, Error)]
#[error("{}", self.message())]
pub struct ReadError {
    /// The expected type.
    pub what: &'static str,
    /// The file as named.
    pub path: PathBuf,
    /// The reason.
    pub reason: Reason,
}

/// Reasons why a file was not read.
#[derive(Debug)]
pub enum Reason {
    /// There is none.
    NotFound,
    /// It is a folder.
    Folder,
    /// It is something else.
    WrongType(FileType),
    /// It is no text.
    NotText,
    /// It is larger than this many bytes.
    TooLarge(u64),
    /// The system does not give it.
    System(io::Error),
}

impl ReadError {
    fn message(&self) -> String {
        let Self { what, path, reason } = self;
        let path = path.display();
        match reason {
            Reason::NotFound => format!("there is no {what} {path}"),
            Reason::Folder => format!("{path} is a folder; a {what} is expected"),
            Reason::WrongType(FileType::Binary) | Reason::NotText => {
                format!("the {what} {path} is not text")
            }
            Reason::WrongType(found) => format!("{path} is {}; a {what} is expected", found.name()),
            Reason::TooLarge(most) => {
                format!(
                    "the {what} {path} is larger than {} MB; it is not read",
                    most >> 20
                )
            }
            Reason::System(error) => format!("the {what} {path} cannot be read: {error}"),
        }
    }

    /// Returns the advice, if it follows from the reason alone.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match &self.reason {
            Reason::WrongType(found) => Some(found.advice(&self.path.display().to_string())),
            Reason::NotText => Some("save it as UTF-8".to_owned()),
            Reason::TooLarge(_) => Some("look whether this is the file you mean".to_owned()),
            Reason::System(_) => Some("name a file that you may read".to_owned()),
            Reason::NotFound | Reason::Folder => None,
        }
    }
}

/// Reads a file: its beginning first, all of it only if it is of an expected type and not too large.
///
/// # Errors
/// See [`Reason`]; [`Reason::NotText`] comes from [`read_text`] alone.
pub fn read(path: &Path, expected: &Expected) -> Result<Vec<u8>, ReadError> {
    read_bytes(path, expected).map_err(|reason| error(path, expected, reason))
}

/// Reads a file of UTF-8 text; a byte order mark is taken away.
///
/// # Errors
/// See [`Reason`].
pub fn read_text(path: &Path, expected: &Expected) -> Result<String, ReadError> {
    let text = String::from_utf8(read(path, expected)?).ok();
    let mut text = text.ok_or_else(|| error(path, expected, Reason::NotText))?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

fn error(path: &Path, expected: &Expected, reason: Reason) -> ReadError {
    ReadError {
        what: expected.what,
        path: path.to_owned(),
        reason,
    }
}

fn read_bytes(path: &Path, expected: &Expected) -> Result<Vec<u8>, Reason> {
    let system = |error: io::Error| match error.kind() {
        io::ErrorKind::NotFound => Reason::NotFound,
        io::ErrorKind::IsADirectory => Reason::Folder,
        _ => Reason::System(error),
    };
    if path.is_dir() {
        return Err(Reason::Folder);
    }
    let mut file = File::open(path).map_err(system)?;
    let mut bytes = Vec::new();
    let mut head = (&mut file).take(HEAD as u64);
    head.read_to_end(&mut bytes).map_err(system)?;
    if let Some(found) = FileType::of(&bytes)
        && !expected.types.contains(&found)
    {
        return Err(Reason::WrongType(found));
    }
    // The length of a pipe or a device is not known before it is read.
    let length = file.metadata().map_or(0, |found| found.len());
    if length <= expected.most {
        let rest = (expected.most + 1).saturating_sub(bytes.len() as u64);
        file.take(rest).read_to_end(&mut bytes).map_err(system)?;
    }
    if length.max(bytes.len() as u64) > expected.most {
        return Err(Reason::TooLarge(expected.most));
    }
    Ok(bytes)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const CASE: Expected = Expected {
        what: "case file",
        types: &[FileType::Case],
        most: 100_000,
    };

    fn refused(name: &str, bytes: &[u8]) -> ReadError {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).unwrap();
        read_text(&file, &CASE).unwrap_err()
    }

    #[test]
    fn input_files_are_refused_with_reason_and_advice() {
        let study = refused("a.toml", b"[vary]\n");
        assert!(
            study
                .to_string()
                .contains("is a study file; a case file is expected"),
            "{study}"
        );
        assert!(study.help().unwrap().contains("wedgelab study "));
        assert!(
            refused("a", &[b'x'; 100_001])
                .to_string()
                .contains("is larger than 0 MB")
        );
        assert!(refused("a", b"a = \"\xe4\"").to_string().ends_with("is not text"));
        assert!(refused("a", &[0; 10]).to_string().ends_with("is not text"));
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(
            read(folder.path(), &CASE).unwrap_err().reason,
            Reason::Folder
        ));
        let none = folder.path().join("none");
        assert!(matches!(read(&none, &CASE).unwrap_err().reason, Reason::NotFound));
    }

    #[test]
    fn limits_a_file_of_the_largest_size_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("largest");
        std::fs::write(&file, vec![b'x'; 100_000]).unwrap();
        assert_eq!(read(&file, &CASE).unwrap().len(), 100_000);
    }

    #[cfg(unix)]
    #[test]
    fn limits_devices_are_not_read_to_their_end() {
        let zero = read(Path::new("/dev/zero"), &CASE).unwrap_err();
        assert!(matches!(zero.reason, Reason::WrongType(FileType::Binary)));
    }
}
