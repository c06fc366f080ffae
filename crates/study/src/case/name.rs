//! Names of cases, which are also names of folders.

use std::path::Path;

use super::problem::{Problem, Problems};
use super::section::CaseSection;

/// Names that Windows keeps for itself, whatever their ending.
const RESERVED: [&str; 4] = ["con", "prn", "aux", "nul"];
/// The longest name.
const LONGEST: usize = 100;

/// Returns the name of a case that has none: that of its file, if it can be a folder's.
pub(crate) fn of_source(source: &str) -> &str {
    of_source_or(source, "case")
}

/// Returns the name of what a file describes: that of the file, if it can be a folder's, else another one.
pub(crate) fn of_source_or<'n>(source: &'n str, other: &'n str) -> &'n str {
    let stem = Path::new(source).file_stem().and_then(|stem| stem.to_str());
    stem.filter(|stem| problem(stem).is_none()).unwrap_or(other)
}

/// Reads the name of a case.
pub(crate) fn read(top: &CaseSection<'_>, default: &str, problems: &mut Problems) -> Option<String> {
    if top.table.get("name").is_none() {
        return Some(default.to_owned());
    }
    let (text, node) = top.text("name", problems)?;
    let bad = problem(text);
    let valid = bad.is_none();
    problems.extend(bad.map(|problem| problem.at(&node.place)));
    valid.then(|| text.to_owned())
}

/// Returns the reason why a name cannot be a folder's on every system; still without a place.
pub(crate) fn problem(name: &str) -> Option<Problem> {
    let stem = name.split('.').next().unwrap_or("").trim_end().to_lowercase();
    let port = |prefix: &str| {
        stem.strip_prefix(prefix)
            .is_some_and(|n| n.len() == 1 && n.chars().all(|c| c.is_ascii_digit()))
    };
    let reason = if name.trim().is_empty() {
        "is empty"
    } else if name == "." || name == ".." {
        "means another folder"
    } else if name.chars().any(|c| c.is_control() || "/\\:*?\"<>|".contains(c)) {
        "holds a sign that folder names cannot have"
    } else if name.trim() != name || name.ends_with('.') {
        "begins or ends with a space, or ends with a point"
    } else if name.len() > LONGEST {
        "is too long"
    } else if RESERVED.contains(&stem.as_str()) || port("com") || port("lpt") {
        "is kept by Windows for a device"
    } else {
        return None;
    };
    let help = "results go into a folder of this name: write letters, digits, and . _ - within, \
                for example name = \"my_wedge\"";
    Some(
        Problem::new(format!("the name \"{name}\" {reason}"))
            .label("not a folder's name")
            .help(help),
    )
}
