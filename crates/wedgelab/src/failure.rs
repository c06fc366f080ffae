//! Failures: messages and exit codes of the program.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use miette::{Diagnostic, MietteHandlerOpts, Report};
use nucars::file_sets::LoadError;
use report::comparison::ComparisonError;
use report::drawn::DrawError;
use report::page::assessment::AgainstError;
use report::run_folder::RunFolderError;
use report::table::TableError;
use staging::FileError;
use study::case::CaseError;
use study::run::saved::SavedStateError;
use thiserror::Error;

use crate::interrupt;

/// Exit code: a run could not finish, or something could not be written.
pub const FAILED: u8 = 1;
/// Exit code: the input is wrong.
pub const INPUT: u8 = 2;
/// Exit code: a wheel left its rail, where the run ended; its files are written.
pub const DERAILED: u8 = 3;

/// Reasons why the program stops.
#[derive(Debug)]
pub enum Failure {
    /// The input is wrong.
    Input(Report),
    /// A run could not finish, or something could not be written.
    Failed(Report),
    /// A wheel left its rail, where the run ended.
    Derailed(Report),
    /// A signal ended the command; this is what it leaves.
    Interrupted(Report),
    /// Nobody reads the output any more.
    NobodyReads,
}

impl Failure {
    /// Tells the user, and gives the exit code.
    pub fn report(self) -> ExitCode {
        let (report, code) = match self {
            Self::Input(report) => (report, INPUT),
            Self::Failed(report) => (report, FAILED),
            Self::Derailed(report) => (report, DERAILED),
            Self::Interrupted(report) => (report, interrupt::code().unwrap_or(FAILED)),
            Self::NobodyReads => return ExitCode::from(interrupt::code().unwrap_or(0)),
        };
        say(&format!("{report:?}"));
        ExitCode::from(code)
    }
}

impl From<CaseError> for Failure {
    fn from(error: CaseError) -> Self {
        Self::Input(error.into())
    }
}

impl From<DrawError> for Failure {
    fn from(error: DrawError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        Self::Input(error.into())
    }
}

impl From<RunFolderError> for Failure {
    fn from(error: RunFolderError) -> Self {
        Self::Input(error.into())
    }
}

impl From<SavedStateError> for Failure {
    fn from(error: SavedStateError) -> Self {
        Self::Input(error.into())
    }
}

impl From<AgainstError> for Failure {
    fn from(error: AgainstError) -> Self {
        Self::Input(error.into())
    }
}

impl From<ComparisonError> for Failure {
    fn from(error: ComparisonError) -> Self {
        Self::Input(error.into())
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        Self::Input(error.into())
    }
}

impl From<Message> for Failure {
    /// Messages of commands are about wrong input.
    fn from(message: Message) -> Self {
        Self::Input(message.into())
    }
}

impl From<io::Error> for Failure {
    /// Errors of the standard output.
    fn from(error: io::Error) -> Self {
        // A terminal that hung up cannot be written to.
        if error.kind() == io::ErrorKind::BrokenPipe || interrupt::code().is_some() {
            Self::NobodyReads
        } else {
            Self::Failed(Message::new(format!("cannot write the output: {error}"), "").into())
        }
    }
}

/// A message with advice.
#[derive(Debug, Error)]
#[error("{message}")]
pub struct Message {
    message: String,
    advice: String,
}

impl Message {
    /// Makes it of what is wrong, and what to do.
    pub fn new(message: impl Into<String>, advice: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            advice: advice.into(),
        }
    }
}

impl Diagnostic for Message {
    fn help<'a>(&'a self) -> Option<Box<dyn std::fmt::Display + 'a>> {
        (!self.advice.is_empty()).then(|| Box::new(&self.advice) as Box<dyn std::fmt::Display>)
    }
}

/// A line on the standard error; if nobody listens there is nothing to be done.
pub fn say(text: &str) {
    let _ = writeln!(io::stderr(), "{}", text.trim_end());
}

/// Errors with colours on a terminal, plain and in long lines elsewhere.
pub fn set_up() {
    let terminal = io::stderr().is_terminal();
    let set = miette::set_hook(Box::new(move |_| {
        let options = MietteHandlerOpts::new().context_lines(1).terminal_links(false);
        Box::new(if terminal {
            options.build()
        } else {
            options.color(false).wrap_lines(false).build()
        })
    }));
    debug_assert!(set.is_ok(), "the hook is set once");
}
