//! Reading the files a command names, and saying what was found in them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use miette::Report;
use nucars::files::locate;
use nucars::read::FileKind;
use nucars::source::Source;
use nucars::{Finding, Findings};

use crate::failure::{Message, say};

/// The file a user named: as spelt, or with other capitals.
pub fn find(path: &Path) -> Result<PathBuf, Message> {
    if path.is_dir() {
        return Err(Message::new(
            format!("{} is a folder", path.display()),
            "name a file, such as half_truck.sys",
        ));
    }
    let text = path.to_string_lossy();
    locate(Path::new(""), &text).map_err(|missing| {
        let help = match &missing.nearest {
            Some(near) => format!("did you mean {}?", path.with_file_name(near).display()),
            None => "the name of a .SYS, .INP, .DAT or .RUN file is expected".to_owned(),
        };
        Message::new(format!("there is no file {}", path.display()), help)
    })
}

/// The text of a file that is there.
pub fn load(path: &Path) -> Result<Arc<Source>, Message> {
    let bytes = fs::read(path)
        .map_err(|error| Message::new(format!("{} cannot be read: {error}", path.display()), ""))?;
    Source::from_bytes(path.display().to_string(), bytes)
        .map_err(|error| Message::new(error.to_string(), "cut it into several files"))
}

/// The kind of a file, by its ending or its keywords.
pub fn kind(source: &Source) -> Result<FileKind, Message> {
    FileKind::of(source).ok_or_else(|| {
        Message::new(
            format!("{} is no file of NUCARS", source.name()),
            "names end with .SYS, .INP, .DAT or .RUN; or the file holds a keyword such as `\\BODY DATA` at the \
             beginning of a line",
        )
    })
}

/// Shows findings on the standard error.
pub fn tell<'a>(findings: &'a Findings, which: impl Fn(&&'a Finding) -> bool) {
    for finding in findings.list().iter().filter(which) {
        say(&format!("{:?}", Report::new(finding.clone())));
    }
    if findings.not_kept() > 0 {
        say(&format!("... and {} more", findings.not_kept()));
    }
}
