//! Things chosen by the name of a built-in one, or by that of a file: regimes, conditions, limits.

use std::path::Path;

use input::file::{Expected, read_text};
use input::{FileType, limits};
use quantity::nearest;

use super::CarCase;
use crate::case::CaseError;
use crate::case::problem::{Problem, TomlLocation};

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

/// Tries settings, as `--set` takes them, on the car of which nothing is given; its mistakes are moved to the
/// places in the file of which the settings are, by the path of the key.
pub(crate) fn try_on_car<'t>(
    set: &[String],
    place: impl Fn(Option<&str>) -> Option<&'t TomlLocation>,
) -> Result<(), CaseError> {
    let tried = CarCase::parse("car.toml", "model = \"car\"", Path::new(""), set);
    let Err(error) = tried else { return Ok(()) };
    Err(CaseError::new(error.into_problems().map(|problem| {
        match place(problem.set_path()) {
            Some(place) => problem.moved_to(place),
            None => problem,
        }
    })))
}

/// The texts of built-in files of a folder of `regimes`, with their names.
macro_rules! built_in {
    ($folder:literal, $($name:literal),* $(,)?) => {
        [$((
            $name,
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/regimes/", $folder, $name, ".toml")),
        )),*]
    };
}
pub(crate) use built_in;
