//! Names of cases, which are also names of folders.

use super::problem::Problem;

/// Names that Windows keeps for itself, whatever their ending.
const RESERVED: [&str; 4] = ["con", "prn", "aux", "nul"];
const LONGEST: usize = 100;

/// Why a name cannot be a folder's on every system; still without a place.
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
