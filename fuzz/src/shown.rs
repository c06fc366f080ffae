//! Errors as the program shows them, and the rules for them.

use std::cell::RefCell;
use std::fmt;

use miette::{
    Diagnostic, MietteHandler, MietteHandlerOpts, NarratableReportHandler, ReportHandler, Severity,
};

use crate::limits::{LONGEST_MESSAGE, MOST_MISTAKES};

thread_local! {
    /// The messages of this thread, where somebody listens.
    static MESSAGES: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
    /// As into a file or a pipe.
    static PLAIN: MietteHandler = options().color(false).wrap_lines(false).build();
    /// As on a terminal.
    static TERMINAL: MietteHandler = options().color(true).unicode(true).width(80).build();
}

/// Returns the options that the command line always sets.
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

/// From now on the messages of this thread are kept for [`heard`].
pub fn listen() {
    MESSAGES.set(Some(Vec::new()));
}

/// Returns the messages of this thread since [`listen`], and stops listening.
#[must_use]
pub fn heard() -> Vec<String> {
    MESSAGES.take().unwrap_or_default()
}

fn keep(text: &str) {
    MESSAGES.with_borrow_mut(|messages| {
        if let Some(messages) = messages {
            messages.push(text.to_owned());
        }
    });
}

/// Returns an error as it is printed into a file or a pipe.
#[must_use]
pub fn plain(error: &dyn Diagnostic) -> String {
    PLAIN.with(|handler| format!("{:?}", Shown(error, handler)))
}

/// Returns an error as it may be printed: as into a file or a pipe first.
fn every_way(error: &dyn Diagnostic) -> [String; 3] {
    [
        plain(error),
        TERMINAL.with(|handler| format!("{:?}", Shown(error, handler))),
        format!("{:?}", Shown(error, &NarratableReportHandler::new())),
    ]
}

/// Prints an error in every way in which it may be printed, and checks places, lengths and the number of
/// mistakes. Returns the bytes of the longest text.
///
/// # Panics
/// It breaks a promise.
pub fn check(error: &dyn Diagnostic) -> usize {
    let mistakes = error.related().map_or(1, Iterator::count);
    check_count(mistakes);
    check_places(error);
    let texts = every_way(error);
    keep(&texts[0]);
    check_letters(&texts[0]);
    let lengths = texts.iter().map(|text| check_length(text.len(), mistakes, text));
    lengths.max().unwrap_or(0)
}

/// As [`check`] for mistakes that are printed one after the other; the texts count together. All of them are
/// printed as into a file, some in every way.
///
/// # Panics
/// As [`check`].
pub fn check_all<'e>(errors: impl Iterator<Item = &'e (dyn Diagnostic + 'e)>) -> usize {
    const EVERY_WAY: usize = 3;
    let (mut mistakes, mut bytes, mut longest) = (0, 0, String::new());
    for (place, error) in errors.enumerate() {
        mistakes += usize::from(error.severity() == Some(Severity::Error));
        check_places(error);
        if place < EVERY_WAY {
            for text in every_way(error) {
                check_length(text.len(), 1, &text);
            }
        }
        let text = plain(error);
        bytes += text.len();
        keep(&text);
        check_letters(&text);
        if text.len() > longest.len() {
            longest = text;
        }
    }
    check_count(mistakes);
    check_length(bytes, mistakes, &longest)
}

/// Checks a text that is printed as it is, and returns its bytes.
///
/// # Panics
/// It is too long.
pub fn check_text(text: &str) -> usize {
    keep(text);
    check_letters(text);
    check_length(text.len(), 1, text)
}

/// Checks the length of messages, and returns it; `text` is a part of it.
fn check_length(bytes: usize, mistakes: usize, text: &str) -> usize {
    if bytes > LONGEST_MESSAGE {
        let begin = beginning(text);
        assert!(
            mistakes > 1,
            "message too long: {bytes} bytes for one mistake: {begin}"
        );
        assert!(
            mistakes <= 1,
            "messages too long: {bytes} bytes for {mistakes} mistakes, one of them: {begin}"
        );
    }
    bytes
}

/// Nothing of the input moves the cursor or colors the terminal.
fn check_letters(text: &str) {
    let hidden = |letter: &char| {
        (letter.is_control() && *letter != '\n')
            || matches!(letter, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let found = text.chars().find(hidden);
    assert!(
        found.is_none(),
        "control character printed: {found:?} in {:?}",
        beginning(text)
    );
}

fn beginning(text: &str) -> String {
    const SHOWN: usize = 300;
    text.chars().take(SHOWN).collect()
}

fn check_count(mistakes: usize) {
    if let Some(most) = MOST_MISTAKES {
        assert!(mistakes <= most, "too many mistakes: {mistakes}");
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
