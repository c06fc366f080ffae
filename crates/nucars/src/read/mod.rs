//! Reading files into trees.
//!
//! Reading is lenient: a mistake costs its record at most, and the rest is read; all mistakes are reported,
//! each at its place. [`Read::strict`] gives the tree only if there are none.

mod data;
mod fields;
mod input;
mod law;
mod run;
mod sections;
mod system;

use std::fmt;
use std::sync::Arc;

use crate::finding::{FileErrors, Findings};
use crate::source::SourceText;
use crate::tree::{DataFile, InputFile, RunFile, SystemFile};

pub use data::read_data;
pub use input::read_input;
pub use run::read_run;
pub use system::read_system;

/// A tree, the text it was read from, and what was found on the way.
#[derive(Clone, Debug)]
pub struct Read<T> {
    /// The tree as far as it could be read.
    pub tree: T,
    /// The text.
    pub source: Arc<SourceText>,
    /// Mistakes and remarks, in the order of the text.
    pub findings: Findings,
}

impl<T> Read<T> {
    /// Returns the tree, if the file was read without errors.
    ///
    /// # Errors
    /// All errors of the file.
    pub fn strict(self) -> Result<T, FileErrors> {
        match FileErrors::of(&self.findings) {
            Some(errors) => Err(errors),
            None => Ok(self.tree),
        }
    }
}

/// The four kinds of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// `.SYS`.
    System,
    /// `.INP`.
    Input,
    /// `.DAT`.
    Data,
    /// `.RUN`.
    Run,
}

impl FileKind {
    /// All of them.
    pub const ALL: [FileKind; 4] = [FileKind::System, FileKind::Input, FileKind::Data, FileKind::Run];

    /// Returns its ending, in capitals.
    pub fn ending(self) -> &'static str {
        match self {
            FileKind::System => "SYS",
            FileKind::Input => "INP",
            FileKind::Data => "DAT",
            FileKind::Run => "RUN",
        }
    }

    /// Returns its sections, without `\`.
    pub fn keywords(self) -> &'static [&'static str] {
        match self {
            FileKind::System => system::KEYWORDS,
            FileKind::Input => input::KEYWORDS,
            FileKind::Data => data::KEYWORDS,
            FileKind::Run => run::KEYWORDS,
        }
    }

    /// Returns the kind by the ending of the name, or else by the first section that belongs to one kind.
    pub fn of(source: &SourceText) -> Option<Self> {
        let ending = source.name().rsplit_once('.').map_or("", |(_, ending)| ending);
        let by_name = FileKind::ALL
            .into_iter()
            .find(|kind| ending.eq_ignore_ascii_case(kind.ending()));
        by_name.or_else(|| {
            let sections = sections::split(source);
            sections.iter().find_map(|section| {
                FileKind::ALL
                    .into_iter()
                    .find(|kind| kind.keywords().contains(&section.keyword.as_str()))
            })
        })
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            FileKind::System => "system file",
            FileKind::Input => "input file",
            FileKind::Data => "data file",
            FileKind::Run => "run file",
        })
    }
}

/// A file of any kind.
#[derive(Clone, Debug)]
pub enum AnyFile {
    /// `.SYS`.
    System(Box<Read<SystemFile>>),
    /// `.INP`.
    Input(Box<Read<InputFile>>),
    /// `.DAT`.
    Data(Box<Read<DataFile>>),
    /// `.RUN`.
    Run(Box<Read<RunFile>>),
}

/// Reads a file of the given kind.
pub fn read(source: &Arc<SourceText>, kind: FileKind) -> AnyFile {
    match kind {
        FileKind::System => AnyFile::System(Box::new(read_system(source))),
        FileKind::Input => AnyFile::Input(Box::new(read_input(source))),
        FileKind::Data => AnyFile::Data(Box::new(read_data(source))),
        FileKind::Run => AnyFile::Run(Box::new(read_run(source))),
    }
}
