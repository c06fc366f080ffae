//! Mistakes in an input, with place and advice.

use input::{Text, bounded, limits};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A text that was read: a case file, a table, or what was given to `--set`.
#[derive(Debug)]
pub(crate) struct TomlSource {
    named: Text,
    /// True if a bare number where a quantity is expected is one in SI units.
    pub bare_numbers_are_si: bool,
}

impl TomlSource {
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self::of(name.into(), text.into(), false))
    }

    /// Returns a text that a program made, in which bare numbers are in SI units.
    pub fn in_si(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self::of(name.into(), text.into(), true))
    }

    fn of(name: String, text: String, bare_numbers_are_si: bool) -> Self {
        TomlSource {
            named: Text::new(name, text),
            bare_numbers_are_si,
        }
    }

    /// Returns the file as the user named it, or `--set`.
    pub fn name(&self) -> &str {
        self.named.name()
    }

    pub fn text(&self) -> &str {
        self.named.text()
    }
}

/// A piece of a source.
#[derive(Clone, Debug)]
pub(crate) struct TomlLocation {
    pub source: Arc<TomlSource>,
    /// In bytes.
    pub span: Range<usize>,
}

impl TomlLocation {
    pub fn text(&self) -> &str {
        self.source.named.slice(self.span.clone())
    }
}

/// One mistake: what was found, where, and what to write instead.
#[derive(Clone, Debug)]
pub struct Problem {
    message: String,
    label: String,
    help: Option<String>,
    place: Option<TomlLocation>,
}

impl Problem {
    /// Returns a mistake at no particular place.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Problem {
            message: bounded(message.into()),
            label: String::new(),
            help: None,
            place: None,
        }
    }

    pub(crate) fn at(mut self, place: &TomlLocation) -> Self {
        self.place = Some(place.clone());
        self
    }

    pub(crate) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(bounded(help.into()));
        self
    }

    /// Returns whether it is the same mistake of the same place.
    fn is_same_mistake(&self, other: &Problem) -> bool {
        let at = |own: &Problem| {
            own.place
                .as_ref()
                .map(|at| (Arc::as_ptr(&at.source), at.span.clone()))
        };
        self.place.is_some() && at(self) == at(other) && self.label == other.label && self.help == other.help
    }

    /// Returns the same mistake, shown where the text that led to it was written.
    pub(crate) fn moved_to(mut self, place: &TomlLocation) -> Self {
        if self.label.is_empty() {
            self.label = "this value".into();
        }
        self.place = Some(place.clone());
        self
    }

    /// Returns the same mistake in a file that must not be quoted: its place there and its kind, shown where
    /// the file was named. Labels, which tell the kind, never quote a text.
    pub(crate) fn without_quoting(self, file: &str, path: &str, named: &TomlLocation) -> Self {
        let inside = (self.place.as_ref()).is_some_and(|place| !Arc::ptr_eq(&place.source, &named.source));
        if !inside {
            return self;
        }
        let (line, column) = self.line_and_column().unwrap_or((1, 1));
        let kind = match self.label.as_str() {
            "" => "not a table",
            label => label,
        };
        let file = format!("{file}, line {line}, column {column}");
        Self::of_unquoted(path, &file, None, kind)
            .at(named)
            .label("this file")
    }

    /// Returns a mistake in a file that must not be quoted: at a line, if it has one, and of a kind.
    pub(crate) fn of_unquoted(path: &str, file: &str, line: Option<usize>, kind: &str) -> Self {
        let place = line.map_or(String::new(), |line| format!(", line {line}"));
        Problem::new(format!("`{path}`: {file}{place}: {kind}")).help(
            "the file is not quoted here; open it at that place, or see `wedgelab run`, which quotes it",
        )
    }

    /// Returns whether it is the key in front of `=` that is wrong in what was given to `--set`.
    pub(crate) fn is_about_key(&self) -> bool {
        let place = self.place.as_ref().filter(|_| self.set_path().is_some());
        place.is_some_and(|place| {
            let equals = place.source.text().find('=');
            equals.is_some_and(|equals| place.span.end <= equals)
        })
    }

    /// Shows it in an override as typed: at its value, or at its key.
    pub(crate) fn in_override(self, typed: &str, at_value: bool) -> Self {
        let equals = typed.find('=').unwrap_or(typed.len());
        let value = (equals + 1).min(typed.len());
        let span = if at_value { value..typed.len() } else { 0..equals };
        let source = TomlSource::new(super::overrides::SOURCE, typed);
        self.at(&TomlLocation { source, span })
    }

    /// Returns the message: what was found and what was expected.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Returns the advice: what to write instead.
    pub fn advice(&self) -> Option<&str> {
        self.help.as_deref()
    }

    /// Returns the file, or `--set`.
    pub fn source_name(&self) -> Option<&str> {
        self.place.as_ref().map(|place| place.source.name())
    }

    /// Returns the path that was set, if the mistake is in what was given to `--set`.
    pub fn set_path(&self) -> Option<&str> {
        let place = self.place.as_ref()?;
        let text = place.source.text();
        (place.source.name() == super::overrides::SOURCE)
            .then(|| text.split_once('=').map_or(text, |(path, _)| path).trim())
    }

    /// Returns the text the mistake is marked at.
    pub fn marked_text(&self) -> Option<&str> {
        self.place.as_ref().map(TomlLocation::text)
    }

    /// Line and column of the mistake, from 1; columns count characters.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        let place = self.place.as_ref()?;
        Some(place.source.named.line_and_column(place.span.start))
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Problem {}

impl Diagnostic for Problem {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help
            .as_ref()
            .map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.place
            .as_ref()
            .map(|place| &place.source.named as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.place.as_ref()?;
        let label = if self.label.is_empty() {
            "here".into()
        } else {
            self.label.clone()
        };
        let marked = place.source.named.mark(place.span.clone());
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(
            Some(label),
            marked,
        ))))
    }
}

/// Mistakes as they are found: the first [`limits::MISTAKES`] are kept, the others counted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Problems {
    kept: Vec<Problem>,
    more: usize,
}

impl Problems {
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a mistake, once: a value that several tables share is told at one of them.
    pub fn push(&mut self, problem: Problem) {
        if !self.kept.iter().any(|own| own.is_same_mistake(&problem)) {
            self.push_with(|| problem);
        }
    }

    /// Adds a mistake that is described only if it is kept.
    pub fn push_with(&mut self, problem: impl FnOnce() -> Problem) {
        if self.kept.len() < limits::MISTAKES {
            self.kept.push(problem());
        } else {
            self.more += 1;
        }
    }

    pub fn extend(&mut self, problems: impl IntoIterator<Item = Problem>) {
        for problem in problems {
            self.push(problem);
        }
    }

    /// Adds those of another input.
    pub fn append(&mut self, other: Problems) {
        self.extend(other.kept);
        self.more += other.more;
    }

    /// Returns the number of problems found.
    pub fn count(&self) -> usize {
        self.kept.len() + self.more
    }

    pub fn is_empty(&self) -> bool {
        self.kept.is_empty()
    }

    /// Returns whether a mistake was found exactly there.
    pub fn is_at(&self, place: &TomlLocation) -> bool {
        let same = |own: &TomlLocation| Arc::ptr_eq(&own.source, &place.source) && own.span == place.span;
        self.kept.iter().filter_map(|own| own.place.as_ref()).any(same)
    }

    pub fn kept(&self) -> &[Problem] {
        &self.kept
    }

    /// Returns the same mistakes, each changed.
    pub fn map(mut self, change: impl FnMut(Problem) -> Problem) -> Self {
        self.kept = self.kept.into_iter().map(change).collect();
        self
    }
}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Self {
        Self {
            kept: vec![problem],
            more: 0,
        }
    }
}

/// The mistakes in an input, in the order of the text: at most 20, and the number of others.
///
/// As a [`Diagnostic`] it shows each mistake in its text; [`CaseError::problems`] gives them one
/// by one.
#[derive(Clone, Debug)]
pub struct CaseError {
    problems: Problems,
    /// The kind that was read: `case`, `study`.
    subject: &'static str,
}

impl CaseError {
    /// `problems` must not be empty.
    pub(crate) fn new(mut problems: Problems) -> Self {
        problems.kept.sort_by_cached_key(|problem| {
            problem
                .place
                .as_ref()
                .map(|place| (place.source.name().to_owned(), place.span.start))
        });
        CaseError {
            problems,
            subject: "case",
        }
    }

    /// Returns the same of another kind of input, such as `study`.
    pub(crate) fn of(mut self, subject: &'static str) -> Self {
        self.subject = subject;
        self
    }

    /// Returns the mistakes in the list; at least one, at most 20.
    pub fn problems(&self) -> &[Problem] {
        self.problems.kept()
    }

    /// Returns the number of mistakes beyond those in the list.
    pub fn more(&self) -> usize {
        self.problems.more
    }

    pub(crate) fn into_problems(self) -> Problems {
        self.problems
    }

    fn only(&self) -> Option<&Problem> {
        match self.problems() {
            [problem] if self.more() == 0 => Some(problem),
            _ => None,
        }
    }
}

impl From<Problem> for CaseError {
    fn from(problem: Problem) -> Self {
        CaseError::new(problem.into())
    }
}

impl fmt::Display for CaseError {
    /// Writes the message of the only mistake, or the number of mistakes.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.only() {
            Some(problem) => problem.fmt(out),
            None => {
                write!(out, "the {} has {} mistakes", self.subject, self.problems.count())?;
                match self.more() {
                    0 => Ok(()),
                    _ => write!(out, "; the first {} are", self.problems().len()),
                }
            }
        }
    }
}

impl std::error::Error for CaseError {}

impl Diagnostic for CaseError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Diagnostic::help(self.only()?)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.only()?.source_code()
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.only()?.labels()
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        if self.only().is_some() {
            return None;
        }
        Some(Box::new(
            self.problems().iter().map(|problem| problem as &dyn Diagnostic),
        ))
    }
}
