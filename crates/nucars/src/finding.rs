//! Findings: mistakes and doubts about a file, with place and advice.

use std::fmt;
use std::sync::Arc;

use input::{bounded, limits};
use miette::{Diagnostic, LabeledSpan, SourceCode};
use thiserror::Error;

use crate::source::{SourceLocation, SourceText, Span};

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; nothing to do.
    Note,
    /// The file can be used, but perhaps does not say what its author means.
    Warning,
    /// The file cannot be used.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        })
    }
}

/// One thing found: what, where, and what to write instead.
#[derive(Clone, Debug)]
pub struct Finding {
    severity: Severity,
    code: &'static str,
    message: String,
    label: String,
    help: String,
    place: SourceLocation,
}

impl Finding {
    pub(crate) fn new(
        severity: Severity,
        code: &'static str,
        source: &Arc<SourceText>,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Finding {
            severity,
            code,
            message: bounded(message.into()),
            label: String::new(),
            help: String::new(),
            place: SourceLocation {
                source: Arc::clone(source),
                span,
            },
        }
    }

    pub(crate) fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = bounded(help.into());
        self
    }

    /// Returns the severity.
    pub fn severity(&self) -> Severity {
        self.severity
    }

    /// Returns a short name for this kind of finding, in lower case with hyphens, such as `count`.
    pub fn code_name(&self) -> &'static str {
        self.code
    }

    /// Returns the message: what was found and what was expected.
    pub fn message(&self) -> &str {
        &self.message
    }

    /// Returns the advice: what to write instead, or why it matters.
    pub fn advice(&self) -> Option<&str> {
        (!self.help.is_empty()).then_some(self.help.as_str())
    }

    /// Returns its place in the files.
    pub fn place(&self) -> &SourceLocation {
        &self.place
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)
    }
}

impl std::error::Error for Finding {}

impl Diagnostic for Finding {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(format!("nucars::{}", self.code)))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Note => miette::Severity::Advice,
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.help.is_empty()).then(|| Box::new(&self.help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&*self.place.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = if self.label.is_empty() {
            "here"
        } else {
            &self.label
        };
        let marked = self.place.source.mark(self.place.span);
        let span = LabeledSpan::new_with_span(Some(label.to_owned()), marked);
        Some(Box::new(std::iter::once(span)))
    }
}

/// Findings of one file.
#[derive(Clone, Debug)]
pub struct Findings {
    source: Arc<SourceText>,
    list: Vec<Finding>,
    /// Number of findings of each severity.
    found: [usize; 3],
}

impl Findings {
    pub(crate) fn new(source: &Arc<SourceText>) -> Self {
        Findings {
            source: Arc::clone(source),
            list: Vec::new(),
            found: [0; 3],
        }
    }

    /// Counts an error that is not kept.
    pub(crate) fn skip(&mut self) {
        self.found[Severity::Error as usize] += 1;
    }

    /// Returns whether no more errors are kept.
    pub(crate) fn is_full(&self) -> bool {
        self.is_full_of(Severity::Error)
    }

    /// Returns whether no more of this severity are kept.
    pub(crate) fn is_full_of(&self, severity: Severity) -> bool {
        self.found[severity as usize] >= limits::MISTAKES
    }

    pub(crate) fn source(&self) -> &Arc<SourceText> {
        &self.source
    }

    /// Adds a finding; `with` gives it label and help.
    pub(crate) fn add(
        &mut self,
        severity: Severity,
        code: &'static str,
        span: Span,
        message: impl Into<String>,
        with: impl FnOnce(Finding) -> Finding,
    ) {
        let full = self.is_full_of(severity);
        self.found[severity as usize] += 1;
        if full {
            return;
        }
        let finding = Finding::new(severity, code, &self.source, span, message);
        self.list.push(with(finding));
    }

    /// Gives the last finding another help.
    pub(crate) fn help_last(&mut self, help: String) {
        let all_kept = self.not_kept() == [0; 3];
        if let Some(last) = self.list.last_mut().filter(|_| all_kept) {
            last.help = help;
        }
    }

    pub(crate) fn error(&mut self, code: &'static str, span: Span, message: String, help: impl Into<String>) {
        self.add(Severity::Error, code, span, message, |finding| finding.help(help));
    }

    pub(crate) fn warning(
        &mut self,
        code: &'static str,
        span: Span,
        message: String,
        help: impl Into<String>,
    ) {
        self.add(Severity::Warning, code, span, message, |finding| {
            finding.help(help)
        });
    }

    pub(crate) fn note(&mut self, code: &'static str, span: Span, message: String, help: impl Into<String>) {
        self.add(Severity::Note, code, span, message, |finding| finding.help(help));
    }

    /// Adds findings about the same text, without those that follow from an error at the same place.
    pub(crate) fn join(&mut self, other: Findings) {
        let beyond = other.not_kept();
        for (own, others) in self.found.iter_mut().zip(beyond) {
            *own += others;
        }
        for finding in other.list {
            let span = finding.place.span;
            let known = |had: &Finding| {
                had.place.span == span && (had.severity == Severity::Error || had.message == finding.message)
            };
            if self.list.iter().any(known) {
                continue;
            }
            let severity = finding.severity;
            if self.kept(severity) < limits::MISTAKES {
                self.list.push(finding);
            }
            self.found[severity as usize] += 1;
        }
    }

    /// Puts them into the order of the text.
    pub(crate) fn sort(&mut self) {
        self.list.sort_by_key(|finding| finding.place.span.start);
    }

    pub(crate) fn sorted(mut self) -> Self {
        self.sort();
        self
    }

    /// Returns the findings; of each severity the first [`limits::MISTAKES`] are kept.
    pub fn list(&self) -> &[Finding] {
        &self.list
    }

    /// Returns the number of findings of a severity in the list.
    fn kept(&self, severity: Severity) -> usize {
        let own = |finding: &&Finding| finding.severity == severity;
        self.list.iter().filter(own).count()
    }

    /// Returns the number of findings of each severity beyond those in the list: notes, warnings, errors.
    pub fn not_kept(&self) -> [usize; 3] {
        let severities = [Severity::Note, Severity::Warning, Severity::Error];
        severities.map(|severity| self.count(severity) - self.kept(severity))
    }

    /// Returns the number of findings of this severity.
    pub fn count(&self, severity: Severity) -> usize {
        self.found[severity as usize]
    }

    /// Returns whether the file cannot be used.
    pub fn has_errors(&self) -> bool {
        self.count(Severity::Error) > 0
    }
}

/// A file that cannot be used: all errors in it, at least one.
#[derive(Clone, Debug, Error)]
#[error("{name} has {} error(s); the first: {first}", errors.len())]
pub struct FileErrors {
    /// The file.
    pub name: String,
    first: String,
    errors: Vec<Finding>,
}

impl FileErrors {
    pub(crate) fn of(findings: &Findings) -> Option<Self> {
        let errors: Vec<Finding> = findings
            .list
            .iter()
            .filter(|finding| finding.severity == Severity::Error)
            .cloned()
            .collect();
        Some(FileErrors {
            name: findings.source.name().to_owned(),
            first: errors.first()?.message.clone(),
            errors,
        })
    }

    /// Returns the errors.
    pub fn errors(&self) -> &[Finding] {
        &self.errors
    }
}

impl Diagnostic for FileErrors {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.errors.iter().map(|error| error as &dyn Diagnostic)))
    }
}
