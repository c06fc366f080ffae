//! Helpers of the tests of bad input.

#![allow(clippy::unwrap_used, dead_code)]

use std::path::Path;
use study::case::{Case, CaseError, Problem};

/// Returns the problems of a text.
pub fn errors(text: &str) -> CaseError {
    Case::parse("case.toml", text, Path::new(""), &[]).unwrap_err()
}

/// Returns the only mistake in a text.
pub fn only(error: &CaseError) -> &Problem {
    let [problem] = error.problems() else {
        panic!("{:#?}", error.problems())
    };
    problem
}

/// A case of one bad line in one section: message, marked text, help; the place is always right.
#[track_caller]
pub fn check(section: &str, line: &str, message: &str, marked: &str, help: &str) {
    let text = format!("# a case\n[{section}]\n{line}\n");
    let error = errors(&text);
    let problem = only(&error);
    assert!(
        problem.message().contains(message),
        "message: {}",
        problem.message()
    );
    assert_eq!(problem.marked_text(), Some(marked), "{}", problem.message());
    let column = line.find(marked).unwrap() + 1;
    assert_eq!(
        problem.line_and_column(),
        Some((3, column)),
        "{}",
        problem.message()
    );
    assert_eq!(problem.source_name(), Some("case.toml"));
    assert!(
        problem.advice().unwrap_or("").contains(help),
        "help: {:?}",
        problem.advice()
    );
}
