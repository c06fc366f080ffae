//! Programs, tests and examples share one build of every dependency: each has the same features for all.

use std::collections::BTreeMap;

use super::Outcome;
use crate::builds::SHARED;
use crate::shell::{self, Workspace};

/// Compares the features of dependencies in a user's build, and in the Python package's, with those in the
/// build of the tests.
pub fn check(workspace: &Workspace) -> Outcome {
    let users = features(workspace, &["--edges", "no-dev"])?;
    let python = features(workspace, &["--edges", "no-dev", "--package", "wedgelab-py"])?;
    let tests = features(workspace, &SHARED)?;
    let differing = [differences(&users, &tests), differences(&python, &tests)].concat();
    if differing.is_empty() {
        return Ok(Some(format!("{} dependencies", users.len())));
    }
    Err(format!(
        "These are compiled twice, with everything that depends on them: ask for the features in \
         [workspace.dependencies] or in the crate `features` too, or move what asks for them to a crate that \
         xtask/src/builds.rs builds apart.\n{}",
        differing.join("\n")
    ))
}

/// Returns the features of every package, by name and version, that these arguments of `cargo tree` select.
fn features(workspace: &Workspace, arguments: &[&str]) -> Result<BTreeMap<String, String>, String> {
    let mut tree = workspace.cargo(["tree", "--prefix", "none", "--format", "{p} [{f}]"]);
    let text = shell::output(tree.args(arguments)).ok_or("`cargo tree` failed")?;
    Ok(text.lines().filter_map(package).collect())
}

/// Reads a line of the tree: `name v1.0.0 (where) [features]`, and `(*)` if it was there before.
fn package(line: &str) -> Option<(String, String)> {
    let (package, rest) = line.split_once('[')?;
    let features = rest.split(']').next()?;
    let words: Vec<&str> = package.split_whitespace().take(2).collect();
    Some((words.join(" "), features.to_owned()))
}

/// Returns a sentence for every package that has other features in `tests` than in `users`.
fn differences(users: &BTreeMap<String, String>, tests: &BTreeMap<String, String>) -> Vec<String> {
    let other = |(package, users): (&String, &String)| {
        let tests = tests.get(package).filter(|tests| *tests != users)?;
        Some(format!(
            "{package}: a program is built with [{users}], tests with [{tests}]"
        ))
    };
    users.iter().filter_map(other).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_with_other_features_is_named() {
        let read = |text: &str| text.lines().filter_map(package).collect::<BTreeMap<_, _>>();
        let users = read("a v1.0.0 [std]\nb v0.1.0 (/b) []\nb v0.1.0 (/b) [] (*)");
        assert_eq!(users.len(), 2);
        assert!(differences(&users, &users).is_empty());
        let tests = read("a v1.0.0 [alloc,std]\na v2.0.0 []\nb v0.1.0 (/b) []");
        assert_eq!(
            differences(&users, &tests),
            ["a v1.0.0: a program is built with [std], tests with [alloc,std]"]
        );
    }
}
