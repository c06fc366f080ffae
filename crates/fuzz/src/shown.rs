//! Errors as the program shows them, and what they must keep to.

use std::fmt;

use miette::{
    Diagnostic, MietteHandler, MietteHandlerOpts, NarratableReportHandler, ReportHandler, Severity,
};

use crate::limits::{LONGEST_MESSAGE, MOST_MISTAKES};

thread_local! {
    /// As into a file or a pipe.
    static PLAIN: MietteHandler = options().color(false).wrap_lines(false).build();
    /// As on a terminal.
    static TERMINAL: MietteHandler = options().color(true).unicode(true).width(80).build();
}

/// What the command line sets in every case.
fn options() -> MietteHandlerOpts {
    MietteHandlerOpts::new()
        .context_lines(1)
        .terminal_links(false)
        .force_graphical(true)
}

/// An error through a printer.
struct Shown<'e>(&'e dyn Diagnostic, &'e dyn ReportHandler);

impl fmt::Debug for Shown<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.1.debug(self.0, out)
    }
}

/// How an error is printed into a file or a pipe.
#[must_use]
pub fn plain(error: &dyn Diagnostic) -> String {
    PLAIN.with(|handler| format!("{:?}", Shown(error, handler)))
}

/// Prints an error in every way in which it may be printed, and checks places, lengths and the number of mistakes. Returns the
/// bytes of the longest text.
///
/// # Panics
/// It breaks a promise.
pub fn check(error: &dyn Diagnostic) -> usize {
    let told = error.related().map_or(1, Iterator::count);
    check_count(told);
    check_places(error);
    let texts = [
        plain(error),
        TERMINAL.with(|handler| format!("{:?}", Shown(error, handler))),
        format!("{:?}", Shown(error, &NarratableReportHandler::new())),
    ];
    let bytes = texts.iter().map(String::len).max().unwrap_or(0);
    check_length(bytes, told);
    bytes
}

/// As [`check`] for mistakes that are told one after the other; the texts count together. All of them are printed as into a
/// file, some in every way.
///
/// # Panics
/// As [`check`].
pub fn check_all<'e>(errors: impl Iterator<Item = &'e (dyn Diagnostic + 'e)>) -> usize {
    const EVERY_WAY: usize = 3;
    let (mut told, mut bytes) = (0, 0);
    for (place, error) in errors.enumerate() {
        told += usize::from(error.severity() == Some(Severity::Error));
        check_places(error);
        bytes += plain(error).len();
        if place < EVERY_WAY {
            check(error);
        }
    }
    check_count(told);
    check_length(bytes, told);
    bytes
}

/// Checks a text that is told as it is, and returns its bytes.
///
/// # Panics
/// It is too long.
pub fn check_text(text: &str) -> usize {
    check_length(text.len(), 1);
    text.len()
}

fn check_length(bytes: usize, told: usize) {
    if told > 1 {
        assert!(
            bytes <= LONGEST_MESSAGE,
            "messages too long: {bytes} bytes for {told} mistakes"
        );
    }
    assert!(
        bytes <= LONGEST_MESSAGE,
        "message too long: {bytes} bytes for one mistake"
    );
}

fn check_count(told: usize) {
    if let Some(most) = MOST_MISTAKES {
        assert!(told <= most, "too many mistakes: {told} are told");
    }
}

/// Every place of an error, and of those that it holds, lies in its text.
fn check_places(error: &dyn Diagnostic) {
    for inside in error.related().into_iter().flatten() {
        check_places(inside);
    }
    let (Some(source), Some(labels)) = (error.source_code(), error.labels()) else {
        return;
    };
    for label in labels {
        let read = source.read_span(label.inner(), 0, 0);
        assert!(
            read.is_ok(),
            "place outside: {label:?} of {:?}",
            error.to_string()
        );
    }
}
