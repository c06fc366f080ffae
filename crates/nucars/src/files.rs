//! Finding files by the names other files give them.

use std::fs;
use std::path::{Path, PathBuf};

use quantity::nearest;
use thiserror::Error;

/// There is no file of this name.
#[derive(Clone, Debug, Error)]
#[error("there is no file `{name}` in {}", place(folder))]
pub struct NotFound {
    /// The name.
    pub name: String,
    /// The folder in which it was looked for.
    pub folder: PathBuf,
    /// The nearest name there.
    pub nearest: Option<String>,
    /// Other names there with the same ending.
    pub alike: Vec<String>,
}

fn place(folder: &Path) -> String {
    if folder == Path::new(".") {
        "the working folder".to_owned()
    } else {
        format!("the folder {}", folder.display())
    }
}

/// Returns the file of this name in or below a folder. `\` is taken as `/`; if there is none spelt so, one
/// that differs in capitals only will do.
///
/// # Errors
/// There is none; with the nearest name.
pub fn locate(folder: &Path, name: &str) -> Result<PathBuf, NotFound> {
    let exact = folder.join(name);
    if exact.is_file() {
        return Ok(exact);
    }
    let slashes = folder.join(name.trim().replace('\\', "/"));
    if slashes.is_file() {
        return Ok(slashes);
    }
    let inside = match slashes.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    let wanted = slashes
        .file_name()
        .map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default();
    let entries = fs::read_dir(&inside).into_iter().flatten().flatten();
    let files = entries.filter(|entry| entry.path().is_file());
    let mut names: Vec<String> = files
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    names.sort();
    if let Some(found) = names
        .iter()
        .find(|file| file.to_lowercase() == wanted.to_lowercase())
    {
        return Ok(slashes.with_file_name(found));
    }
    // Of a folder's files those with the same ending come first.
    let ending = |name: &str| name.rsplit_once('.').map(|(_, ending)| ending.to_lowercase());
    let mut alike: Vec<String> = names
        .iter()
        .filter(|file| ending(file) == ending(&wanted))
        .cloned()
        .collect();
    let near = nearest(&wanted, alike.iter().map(String::as_str));
    let near = near.or_else(|| nearest(&wanted, names.iter().map(String::as_str)));
    let near = near.map(str::to_owned);
    alike.retain(|file| Some(file) != near.as_ref());
    Err(NotFound {
        name: name.to_owned(),
        nearest: near,
        alike,
        folder: inside,
    })
}
