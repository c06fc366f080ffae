//! The folder `resources` of an unpacked FMU: what it is made of.

use std::path::{Path, PathBuf};

use crate::source::{FmuModel, Source};
use crate::{Error, limits};

/// The file with the name of the model.
pub const MODEL: &str = "model.txt";

/// Reads the source of an unpacked FMU.
///
/// # Errors
/// The folder is not one of an FMU of this program, or its case or run is damaged.
pub fn read(folder: &Path) -> Result<Source, Error> {
    let text = |file: &str, most: u64| {
        limits::read_text(&folder.join(file), most).map_err(|error| {
            Error::new(format!(
                "{error}; the folder given to the instance must be the FMU's unpacked `resources`"
            ))
        })
    };
    let name = text(MODEL, limits::MODEL_FILE)?;
    let unknown = || {
        let shown: String = name.trim().chars().take(40).collect();
        Error::new(format!(
            "`{shown}` in {} is no model of this library: take the FMU's `resources` as they were unpacked",
            folder.join(MODEL).display()
        ))
    };
    FmuModel::of(name.trim())
        .ok_or_else(unknown)?
        .source(folder, text)
}

/// Returns the folder that an URI of FMI 2.0 names: `file:///folder`, `file:/folder`,
/// `file://localhost/folder`; a plain path is taken too.
///
/// # Errors
/// The URI is of another scheme or host.
pub fn folder_of_uri(uri: &str) -> Result<PathBuf, Error> {
    let refused = || {
        Error::new(format!(
            "`{uri}` is no URI of a folder on this machine (file:///...)"
        ))
    };
    let Some((scheme, rest)) = uri.split_once(':').filter(|(scheme, _)| scheme.len() > 1) else {
        return Ok(PathBuf::from(uri));
    };
    if !scheme.eq_ignore_ascii_case("file") {
        return Err(refused());
    }
    let path = match rest.strip_prefix("//") {
        Some(after) => {
            let (host, path) = after
                .find('/')
                .map(|slash| after.split_at(slash))
                .ok_or_else(refused)?;
            if !(host.is_empty() || host.eq_ignore_ascii_case("localhost")) {
                return Err(refused());
            }
            path
        }
        None => rest,
    };
    let path = unescape(path).ok_or_else(refused)?;
    // On Windows `/C:/folder` is `C:/folder`.
    let drive = path.as_bytes();
    let starts_with_drive =
        drive.len() > 2 && drive[0] == b'/' && drive[2] == b':' && drive[1].is_ascii_alphabetic();
    let path = if starts_with_drive { &path[1..] } else { &path[..] };
    Ok(PathBuf::from(path))
}

/// Resolves `%20` and the like.
fn unescape(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((first, tail)) = rest.split_first() {
        if *first == b'%' {
            let code = std::str::from_utf8(tail.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(code, 16).ok()?);
            rest = tail.get(2..)?;
        } else {
            bytes.push(*first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_uris_of_all_importers_are_understood() {
        for (uri, folder) in [
            ("file:///data/a b/resources", "/data/a b/resources"),
            ("file:///data/a%20b/r%C3%A9s", "/data/a b/rés"),
            ("file:/data/x", "/data/x"),
            ("file://localhost/data/x", "/data/x"),
            ("FILE:///C:/Data/x", "C:/Data/x"),
            ("/data/x", "/data/x"),
            ("C:/x", "C:/x"),
        ] {
            assert_eq!(folder_of_uri(uri).unwrap(), PathBuf::from(folder), "{uri}");
        }
        for uri in [
            "http://x/y",
            "file://host/y",
            "file://",
            "file:///a%2",
            "file:///a%zz",
        ] {
            assert!(folder_of_uri(uri).is_err(), "{uri}");
        }
    }
}
