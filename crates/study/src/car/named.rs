//! Things chosen by the name of a built-in one, or by that of a file: regimes, conditions, limits.

use std::path::Path;

use input::file::{Expected, read_text};
use input::{FileType, limits};
use quantity::nearest;

use crate::case::CaseError;
use crate::case::problem::Problem;

/// The target of a name.
pub(crate) enum BuiltInOrFile<'a, T> {
    /// Something built in.
    BuiltIn(&'a T),
    /// A file.
    File(&'a Path),
}

/// Finds what a text names; `none` begins the message if there is neither: `there is no regime`.
pub(crate) fn find<'a, T>(
    none: &str,
    text: &'a str,
    all: &'a [T],
    name: fn(&T) -> &str,
) -> Result<BuiltInOrFile<'a, T>, CaseError> {
    let path = Path::new(text);
    if let (false, Some(own)) = (path.is_file(), all.iter().find(|own| name(own) == text)) {
        return Ok(BuiltInOrFile::BuiltIn(own));
    }
    if path.exists() || path.extension().is_some() {
        return Ok(BuiltInOrFile::File(path));
    }
    let names = all.iter().map(name);
    let help = match nearest(text, names.clone()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!(
            "there are {}; or name a file",
            names.collect::<Vec<_>>().join(", ")
        ),
    };
    let problem = Problem::new(format!("{none} \"{text}\""));
    Err(problem.help(help).into())
}

/// Reads such a file; `help` says where one to begin with is found.
pub(crate) fn read(
    path: &Path,
    what: &'static str,
    types: &'static [FileType],
    help: &str,
) -> Result<String, CaseError> {
    let expected = Expected {
        what,
        types,
        most: limits::TEXT_FILE,
    };
    read_text(path, &expected).map_err(|error| {
        let own = error.help().unwrap_or_else(|| help.to_owned());
        Problem::new(error.to_string()).help(own).into()
    })
}
