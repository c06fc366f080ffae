//! Mistakes in words.

use study::case::Problem;

/// Returns the messages of mistakes, each with its help.
pub fn in_words(problems: &[Problem]) -> String {
    let all = problems.iter().map(|problem| {
        let help = miette::Diagnostic::help(problem).map(|help| help.to_string());
        format!("{problem}\n{}\n", help.unwrap_or_default())
    });
    all.collect()
}
