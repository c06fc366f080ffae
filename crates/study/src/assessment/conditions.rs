//! Conditions in which a car is assessed, as data: values laid over its case.
//!
//! ```toml
//! [conditions.worn_out]
//! title = "wedges that stand 1.2 in high in their pockets, and columns that shine"
//! [conditions.worn_out.set]
//! truck.wedge.rise = "1.2 in"
//! truck.friction.column = 0.2
//! ```

use std::path::Path;
use std::sync::LazyLock;

use input::FileType;
use input::limits::CONDITIONS as MOST;

use crate::car::named::{self, BuiltInOrFile, find, try_on_car};
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::CaseSection;
use crate::case::tree::{self, NodeValue, TableNode};
use crate::case::{CaseError, name};
use crate::design::settings;

const HELP: &str =
    "write [conditions.NAME] with a title, and below [conditions.NAME.set] keys of a car's case";
/// An older name of a condition, which is read, and its name.
const BEFORE: [&str; 2] = ["worn", "mu_0.25"];
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
    /// Its settings, as `--set` takes them.
    pub set: Vec<String>,
}

impl Condition {
    /// Returns the built-in conditions; the first one sets nothing.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &ALL
    }

    /// Returns those that texts name: built-in ones by their names, or all of a file, which is tried on a car
    /// if they are for one: a vehicle has keys by the names of its parts.
    ///
    /// # Errors
    /// There are none of this name, or something in a file is wrong.
    pub fn chosen(texts: &[String], for_car: bool) -> Result<Vec<Self>, CaseError> {
        let mut chosen: Vec<Self> = Vec::new();
        for text in texts {
            let text = if text == BEFORE[0] { BEFORE[1] } else { text };
            let found = match find("there is no condition", text, Self::all(), |own| &own.name)? {
                BuiltInOrFile::BuiltIn(own) => vec![own.clone()],
                BuiltInOrFile::File(path) => read(path, for_car)?,
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

/// Reads a file of conditions, and tries each on the car of which nothing is given if they are for a car;
/// mistakes are shown in the file.
fn read(path: &Path, for_car: bool) -> Result<Vec<Condition>, CaseError> {
    let help = "`wedgelab regime --show conditions` prints conditions to begin with";
    let text = named::read(path, "file of conditions", &[FileType::Conditions], help)?;
    let source = path.display().to_string();
    let found = parse(&source, &text)?;
    let tree = tree::parse(&TomlSource::new(source, text.as_str())).map_err(CaseError::new)?;
    for own in found.iter().filter(|_| for_car) {
        let key = format!("conditions.{}.set", own.name);
        try_on_car(&own.set, |path| {
            let path = path.map(|path| format!("{key}.{path}"));
            path.and_then(|path| tree.place_of(&path)).or(tree.place_of(&key))
        })?;
    }
    Ok(found)
}

/// Reads conditions from a text that `source` names in messages. Whether a car takes them is not tried.
///
/// # Errors
/// Something is wrong: all mistakes are reported together.
pub fn parse(source: &str, text: &str) -> Result<Vec<Condition>, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("file of conditions");
    let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
    let mut problems = Problems::new();
    let found = conditions(&tree, &mut problems);
    match problems.is_empty() {
        true => Ok(found),
        false => Err(failed(problems)),
    }
}

fn conditions(tree: &TableNode, problems: &mut Problems) -> Vec<Condition> {
    let top = CaseSection {
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
    let count = section.table.entries.len();
    if count > MOST {
        let message = format!("`conditions` has {count} conditions; at most {MOST} are read");
        let problem = Problem::new(message).help("write several files, and an assessment with each");
        problems.push(match section.place {
            Some(place) => problem.at(&place).label("too many"),
            None => problem,
        });
        return Vec::new();
    }
    let mut found = Vec::new();
    for entry in &section.table.entries {
        let NodeValue::Table(table) = &entry.node.value else {
            let message = format!("`conditions.{}` is {}", entry.key, entry.node.value.describe());
            let problem = Problem::new(message).at(&entry.node.place);
            problems.push(problem.label("a table is expected").help(HELP));
            continue;
        };
        if let Some(problem) = name::problem(&entry.key) {
            problems.push(problem.at(&entry.key_place));
        }
        let own = CaseSection {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_more_conditions_than_can_be_tried_are_refused() {
        let file = |count: usize| -> String {
            let one = |k| format!("[conditions.c{k}]\ntitle = \"one\"\n");
            (0..count).map(one).collect()
        };
        assert_eq!(parse("many.toml", &file(MOST)).unwrap().len(), MOST);
        let error = parse("many.toml", &file(MOST + 1)).unwrap_err();
        let [problem] = error.problems() else {
            unreachable!("{error}");
        };
        assert!(problem.message().contains("at most 100"), "{problem}");
        assert!(problem.advice().is_some());
    }
}
