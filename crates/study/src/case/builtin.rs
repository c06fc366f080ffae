//! The built-in cases, in groups: the thesis's twelve runs, and cases beyond them.
//!
//! Every case is the text of a case file, so that what runs is what `wedgelab case NAME` prints. A group has
//! a title and says in two sentences what to look at in its results; families (sweeps, depths of wear) are
//! one group each, their cases named by what changes.

mod beyond;
mod thesis;

pub use thesis::own_name;

use super::problem::Problem;
use super::{Case, CaseError};
use crate::models::ModelKeys;
use quantity::nearest;
use std::path::Path;
use std::sync::LazyLock;

/// Cases that together have all keys.
pub(crate) const KEYS: ModelKeys = ModelKeys {
    cases: &[
        ("vdrun_toe_0_psi_0", &[]),
        ("cdrun_toe_0_psi_0", &[]),
        ("cdrun_toe_0_psi_0", &["friction.law=bristle"]),
        (
            "cdrun_toe_0_psi_0",
            &[r#"control_coil.table=[["0 in", "0 lbf"], ["1 in", "3000 lbf"]]"#],
        ),
    ],
    alike: &[],
    known: Case::known_keys,
};

/// Cases that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseGroup {
    /// Its name, such as `warp`.
    pub name: &'static str,
    /// One line for people.
    pub title: &'static str,
    /// Two sentences: what to look at in the results.
    pub look_at: &'static str,
    /// Its cases.
    pub cases: Vec<BuiltIn>,
}

/// A built-in case.
#[derive(Clone, Debug, PartialEq)]
pub struct BuiltIn {
    /// Its name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Its case file.
    text: String,
}

impl BuiltIn {
    /// `body` is the case file without name and title.
    pub(crate) fn new(name: String, title: String, body: &str) -> Self {
        let text = format!("name = \"{name}\"\ntitle = \"{title}\"\n{body}");
        Self { name, title, text }
    }

    /// Returns its case file.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

static GROUPS: LazyLock<Vec<CaseGroup>> = LazyLock::new(|| {
    let mut groups = vec![thesis::group()];
    groups.extend(beyond::groups());
    groups
});

static CASES: LazyLock<Vec<&'static BuiltIn>> =
    LazyLock::new(|| GROUPS.iter().flat_map(|group| &group.cases).collect());

/// Returns the groups, the thesis's runs first.
pub fn groups() -> &'static [CaseGroup] {
    &GROUPS
}

/// Returns the group of this name.
pub fn group(name: &str) -> Option<&'static CaseGroup> {
    groups().iter().find(|group| group.name == name)
}

/// Returns the group that a built-in case belongs to.
pub fn group_of(case: &str) -> Option<&'static CaseGroup> {
    groups()
        .iter()
        .find(|group| group.cases.iter().any(|one| one.name == case))
}

/// Returns the names of all built-in cases, the thesis's first.
pub fn names() -> impl ExactSizeIterator<Item = &'static str> {
    CASES.iter().map(|case| case.name.as_str())
}

/// Returns the names of the thesis's twelve runs, variable damping first.
pub fn thesis_names() -> impl ExactSizeIterator<Item = &'static str> {
    let thesis = group(thesis::NAME).map_or(&[][..], |group| &group.cases);
    thesis.iter().map(|case| case.name.as_str())
}

/// Names and titles of all built-in cases.
pub fn list() -> impl ExactSizeIterator<Item = (&'static str, &'static str)> {
    CASES.iter().map(|case| (case.name.as_str(), case.title.as_str()))
}

/// Returns the built-in case of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest, or the thesis's.
pub fn case(name: &str) -> Result<Case, CaseError> {
    case_with(name, &[])
}

/// Returns the built-in case of this name with `--set` overrides (`path.key=value`).
///
/// # Errors
/// There is none of this name, or an override is wrong.
pub fn case_with(name: &str, overrides: &[String]) -> Result<Case, CaseError> {
    let name = own_name(name);
    Case::parse(&format!("{name}.toml"), text(&name)?, Path::new(""), overrides)
}

/// Returns the case file of the built-in case of this name.
///
/// # Errors
/// There is none of this name; the help names the nearest, or the thesis's.
pub fn text(name: &str) -> Result<&'static str, CaseError> {
    let own = own_name(name);
    if let Some(case) = CASES.iter().find(|case| case.name == own) {
        return Ok(&case.text);
    }
    let help = match nearest(name, names()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!(
            "`wedgelab case` lists all; the thesis's are {}",
            thesis_names().collect::<Vec<_>>().join(", ")
        ),
    };
    Err(Problem::new(format!("there is no built-in case \"{name}\""))
        .help(help)
        .into())
}

/// Returns the names of all cases of groups.
pub(crate) fn names_in(groups: &'static [CaseGroup]) -> impl Iterator<Item = &'static str> {
    let cases = groups.iter().flat_map(|group| &group.cases);
    cases.map(|case| case.name.as_str())
}

/// Returns the case file of this name in groups; `what` they have (a truck) is said where there is none.
///
/// # Errors
/// There is none of this name; the help names the nearest.
pub(crate) fn text_in(
    groups: &'static [CaseGroup],
    name: &str,
    what: &str,
) -> Result<&'static str, CaseError> {
    let mut cases = groups.iter().flat_map(|group| &group.cases);
    cases
        .find(|case| case.name == name)
        .map(BuiltIn::text)
        .ok_or_else(|| {
            let help = match nearest(name, names_in(groups)) {
                Some(near) => format!("did you mean {near}?"),
                None => "`wedgelab case` lists all".to_owned(),
            };
            Problem::new(format!("there is no built-in {what} \"{name}\""))
                .help(help)
                .into()
        })
}
