//! Conditions in which a car is assessed, as data: values laid over its case.
//!
//! ```toml
//! [conditions.worn]
//! title = "worn wedges and columns"
//! [conditions.worn.set]
//! truck.condition = "worn"
//! ```

use std::path::Path;
use std::sync::LazyLock;

use input::file::{Expected, read_text};
use input::{FileType, limits};
use quantity::nearest;

use super::CarCase;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::Section;
use crate::case::tree::{self, Table, Value};
use crate::case::{CaseError, name};
use crate::design::settings;

const HELP: &str =
    "write [conditions.NAME] with a title, and below [conditions.NAME.set] keys of a car's case";
const FILE: Expected = Expected {
    what: "file of conditions",
    types: &[FileType::Case, FileType::Study],
    most: limits::TEXT_FILE,
};

/// The built-in conditions as a file.
pub const BUILT_IN: &str = include_str!("../../regimes/conditions.toml");

static ALL: LazyLock<Vec<Condition>> = LazyLock::new(|| {
    // That they can be read, a test holds.
    parse("conditions.toml", BUILT_IN).unwrap_or_default()
});

/// A condition.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// Its name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// What it sets, as `--set` takes it.
    pub set: Vec<String>,
}

impl Condition {
    /// Returns the built-in conditions; the first one sets nothing.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &ALL
    }

    /// Returns those that texts name: built-in ones by their names, or all of a file.
    ///
    /// # Errors
    /// There are none of this name, or something in a file is wrong.
    pub fn chosen(texts: &[String]) -> Result<Vec<Self>, CaseError> {
        let mut chosen: Vec<Self> = Vec::new();
        for text in texts {
            let path = Path::new(text);
            let built_in = Self::all().iter().find(|own| own.name == *text);
            let found = match built_in {
                Some(own) if !path.is_file() => vec![own.clone()],
                _ if path.exists() || path.extension().is_some() => read(path)?,
                _ => return Err(unknown(text)),
            };
            for own in found {
                if chosen.iter().any(|other| other.name == own.name) {
                    let problem = Problem::new(format!("the condition {} is named twice", own.name));
                    return Err(problem.help("name each condition once").into());
                }
                chosen.push(own);
            }
        }
        Ok(chosen)
    }
}

fn unknown(text: &str) -> CaseError {
    let names = Condition::all().iter().map(|own| own.name.as_str());
    let help = match nearest(text, names.clone()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!(
            "there are {}; or name a file",
            names.collect::<Vec<_>>().join(", ")
        ),
    };
    let problem = Problem::new(format!("there is no condition \"{text}\""));
    problem.help(help).into()
}

/// Reads a file of conditions, and tries each on the car of which nothing is given.
fn read(path: &Path) -> Result<Vec<Condition>, CaseError> {
    let text = read_text(path, &FILE).map_err(|error| {
        let help = "`wedgelab regime --show conditions` prints conditions to begin with";
        Problem::new(error.to_string()).help(error.help().unwrap_or_else(|| help.to_owned()))
    })?;
    parse(&path.display().to_string(), &text)
}

/// Reads conditions from a text that `source` names in messages.
///
/// # Errors
/// Something is wrong: all mistakes are reported together.
pub fn parse(source: &str, text: &str) -> Result<Vec<Condition>, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("file of conditions");
    let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
    let mut problems = Problems::new();
    let found = conditions(&tree, &mut problems);
    if !problems.is_empty() {
        return Err(failed(problems));
    }
    for own in &found {
        CarCase::parse("car.toml", "model = \"car\"", Path::new(""), &own.set).map_err(|error| {
            let key = format!("conditions.{}.set", own.name);
            CaseError::new(error.into_problems().map(|problem| {
                let path = problem.set_path().map(|path| format!("{key}.{path}"));
                let place = path.and_then(|path| tree.place_of(&path)).or(tree.place_of(&key));
                match place {
                    Some(place) => problem.moved_to(place),
                    None => problem,
                }
            }))
        })?;
    }
    Ok(found)
}

fn conditions(tree: &Table, problems: &mut Problems) -> Vec<Condition> {
    let top = Section {
        path: String::new(),
        table: tree,
        place: None,
    };
    top.allow_in(&["conditions"], &[], "a file of conditions", problems);
    if top.require("conditions", HELP, problems).is_none() {
        return Vec::new();
    }
    let Some(section) = top.section("conditions", problems) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for entry in &section.table.entries {
        let Value::Table(table) = &entry.node.value else {
            let message = format!("`conditions.{}` is {}", entry.key, entry.node.value.describe());
            let problem = Problem::new(message).at(&entry.node.place);
            problems.push(problem.label("a table is expected").help(HELP));
            continue;
        };
        if let Some(problem) = name::problem(&entry.key) {
            problems.push(problem.at(&entry.key_place));
        }
        let own = Section {
            path: format!("conditions.{}", entry.key),
            table,
            place: Some(entry.key_place.clone()),
        };
        own.allow(&["title", "set"], &[], problems);
        let title = own.text("title", problems).map_or("", |(text, _)| text);
        let set = match table.entry("set") {
            Some(_) => own
                .section("set", problems)
                .map(|section| settings(section.table)),
            None => None,
        };
        found.push(Condition {
            name: entry.key.clone(),
            title: title.to_owned(),
            set: set.unwrap_or_default(),
        });
    }
    found
}
