//! The readers: each with a name, a corpus, a dictionary, and its rules.

mod assessments;
mod beginnings;
mod broken;
mod cases;
mod files;
mod fmus;
mod models;
mod nucars;
mod run_folders;
mod run_states;
mod sections;
mod small;
mod states;
mod studies;
mod tables;
mod trucks;

use std::path::Path;

use miette::Diagnostic;

use crate::shown;

/// A reader.
pub struct Reader {
    /// Its name on the command line.
    pub name: &'static str,
    /// A description of its inputs.
    pub about: &'static str,
    /// Inputs that it accepts.
    pub corpus: fn() -> Vec<Vec<u8>>,
    /// Pieces that mean something to it.
    pub dictionary: &'static [&'static [u8]],
    /// Reads any bytes. It panics if a promise is broken.
    pub read: fn(&[u8]) -> ReadOutcome,
}

/// All readers.
pub const ALL: [Reader; 44] = [
    cases::CASES,
    cases::VALUES,
    cases::OVERRIDES,
    trucks::TRUCKS,
    trucks::CARS,
    trucks::VEHICLES,
    trucks::TRACKS,
    trucks::MEASURED_TRACKS,
    trucks::ALIGNMENTS,
    trucks::PROFILES,
    studies::STUDIES,
    studies::ROUTES,
    studies::PLANS,
    studies::MANIFESTS,
    studies::RECORDS,
    studies::POINTS,
    small::UNITS,
    small::FREE,
    small::OPTIONS,
    nucars::SYSTEMS,
    nucars::INPUTS,
    nucars::DATA,
    nucars::RUNS,
    assessments::REGIMES,
    assessments::LIMITS,
    assessments::CONDITIONS,
    assessments::REQUESTS,
    assessments::ASSESSED_RUNS,
    assessments::ASSESSMENTS,
    tables::RESULTS,
    run_folders::RUN_FOLDERS,
    tables::TABLES,
    sections::SECTIONS,
    sections::ACCEPTED,
    states::DRIVEN,
    run_states::WEDGES,
    run_states::TRUCKS,
    run_states::HALF_TRUCKS,
    run_states::CARS,
    run_states::WHEELSETS,
    states::INSTANCES,
    fmus::FMU_RUNS,
    files::FILES,
    beginnings::BEGINNINGS,
];

/// Returns the reader of this name; `broken` is one that breaks, for trying out the program.
#[must_use]
pub fn find(name: &str) -> Option<&'static Reader> {
    static READERS: [Reader; ALL.len()] = ALL;
    static BROKEN: Reader = broken::BROKEN;
    let mut all = READERS.iter().chain([&BROKEN]);
    all.find(|reader| reader.name == name)
}

/// The outcome of reading an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadOutcome {
    /// True if it was accepted.
    pub accepted: bool,
    /// Bytes of the longest text in which it was refused; zero, if it was accepted.
    pub message: usize,
    /// Attempted steps of an integrator that it took, or that the rule of progress admits for them.
    pub attempts: u64,
}

impl ReadOutcome {
    /// Accepted.
    const ACCEPTED: Self = Self {
        accepted: true,
        message: 0,
        attempts: 0,
    };
    /// No UTF-8, which readers of text refuse before they read.
    const NO_TEXT: Self = Self {
        accepted: false,
        message: 0,
        attempts: 0,
    };

    /// Refused with this error.
    fn refused(error: &dyn Diagnostic) -> Self {
        Self::of_message(shown::check(error))
    }

    /// Refused with this text.
    fn refused_with(text: &str) -> Self {
        Self::of_message(shown::check_text(text))
    }

    fn of_message(message: usize) -> Self {
        Self {
            accepted: false,
            message,
            attempts: 0,
        }
    }

    /// Returns both of two readings of one input: accepted if one is.
    fn or(self, other: Self) -> Self {
        Self {
            accepted: self.accepted || other.accepted,
            message: self.message.max(other.message),
            attempts: self.attempts.max(other.attempts),
        }
    }
}

/// Returns the finding that an accepted input is refused once it is written.
#[allow(clippy::panic)]
fn refused_as_written(error: &dyn std::fmt::Display) -> ! {
    panic!("refused as written: {error}");
}

/// Returns a folder that is not there, so that inputs find no files.
fn nowhere() -> &'static Path {
    Path::new("no-such-folder")
}

/// Reads in a folder that goes again.
fn in_folder(read: impl FnOnce(&Path) -> ReadOutcome) -> ReadOutcome {
    match tempfile::tempdir() {
        Ok(folder) => read(folder.path()),
        Err(_) => ReadOutcome::NO_TEXT,
    }
}

/// Reads an input as a file of this name.
fn in_file(name: &str, input: &[u8], read: impl FnOnce(&Path) -> ReadOutcome) -> ReadOutcome {
    in_folder(|folder| {
        let file = folder.join(name);
        match std::fs::write(&file, input) {
            Ok(()) => read(&file),
            Err(_) => ReadOutcome::NO_TEXT,
        }
    })
}

/// Checks that a page is whole: what came from an input opens and ends no script.
fn check_page(page: &str) {
    let [opened, closed] = ["<script", "</script"].map(|mark| page.matches(mark).count());
    assert!(
        opened == closed && page.trim_end().ends_with("</html>"),
        "a broken page: {opened} scripts begin, {closed} end"
    );
}

/// The files of a folder of the corpus.
macro_rules! corpus {
    ($folder:literal: $($name:literal),* $(,)?) => {
        || vec![$(
            include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/", $folder, "/", $name)).to_vec()
        ),*]
    };
}
use corpus;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reader_accepts_its_corpus() {
        let mut refused = Vec::new();
        for reader in &ALL {
            let corpus = (reader.corpus)();
            assert!(!corpus.is_empty(), "{}", reader.name);
            for (number, entry) in corpus.iter().enumerate() {
                shown::listen();
                if !(reader.read)(entry).accepted {
                    refused.push(format!("{} {number}: {}", reader.name, shown::heard().join("\n")));
                }
            }
        }
        assert!(refused.is_empty(), "{}", refused.join("\n\n"));
    }

    #[test]
    fn every_file_of_the_corpus_belongs_to_a_reader() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
        let mut bytes = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let folder = entry.unwrap();
            let name = folder.file_name().into_string().unwrap();
            let corpus = (find(&name).expect(&name).corpus)();
            for file in std::fs::read_dir(folder.path()).unwrap() {
                let content = std::fs::read(file.unwrap().path()).unwrap();
                bytes += content.len();
                // Whole, or one entry a line.
                let mut lines = content
                    .split(|byte| *byte == b'\n')
                    .filter(|line| !line.is_empty());
                let known =
                    corpus.contains(&content) || lines.all(|line| corpus.iter().any(|entry| entry == line));
                assert!(known, "{name}");
            }
        }
        assert!(bytes < 300_000, "{bytes} bytes");
    }

    #[test]
    fn names_differ() {
        for (place, reader) in ALL.iter().enumerate() {
            assert!(ALL[..place].iter().all(|other| other.name != reader.name));
        }
    }
}
