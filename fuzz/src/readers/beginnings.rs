//! Runs that begin: overrides of a case, and a few steps from there.

use study::case::builtin;
use study::run::Run;

use super::run_states::advanced;
use super::{ReadOutcome, Reader, cases};

/// Beginnings of runs.
pub const BEGINNINGS: Reader = Reader {
    name: "beginnings",
    about: "runs of cases with --set, and three steps of each",
    corpus: cases::OVERRIDES.corpus,
    dictionary: cases::OVERRIDES.dictionary,
    read: begin,
};

fn begin(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let set: Vec<String> = text.lines().map(str::to_owned).collect();
    // What is wrong with the text is for the reader `overrides`.
    let Ok(case) = builtin::case_with("vdrun_toe_out_0.2_psi_0.012", &set) else {
        return ReadOutcome::NO_TEXT;
    };
    match Run::new(&case) {
        Ok(run) => advanced(run, |_| ()),
        Err(error) => ReadOutcome::refused_with(&error.to_string()),
    }
}
