//! A text that was read, and excerpts of it.

use std::ops::Range;
use std::sync::OnceLock;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use crate::limits;
use crate::shorten::is_hidden;

/// A text with a name. As a [`SourceCode`] it shows at most [`limits::EXCERPT`] bytes on either side of a
/// place, so that messages about long lines stay short; the printer of messages cannot place a mark beyond
/// column 65,535.
#[derive(Debug)]
pub struct Text {
    name: String,
    text: String,
    lines: OnceLock<Vec<usize>>,
    /// The same bytes without what would move a terminal's cursor; nothing if there is no such thing.
    printable: OnceLock<Option<String>>,
}

impl Text {
    /// Returns a text and the name that messages give it: a file as the user named it, or `--set`.
    #[must_use]
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            text: text.into(),
            lines: OnceLock::new(),
            printable: OnceLock::new(),
        }
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns all of it.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Returns a piece of it; an empty one if the range is not one of this text.
    #[must_use]
    pub fn slice(&self, range: Range<usize>) -> &str {
        self.text.get(range).unwrap_or("")
    }

    /// Returns line and column of a byte, from 1; columns count characters.
    #[must_use]
    pub fn line_and_column(&self, byte: usize) -> (usize, usize) {
        let byte = self.text.floor_char_boundary(byte);
        let (line, start) = self.line_of(byte);
        (line + 1, self.slice(start..byte).chars().count() + 1)
    }

    /// Returns the part of a range that a message marks: its beginning, at most [`limits::EXCERPT`] bytes.
    #[must_use]
    pub fn mark(&self, range: Range<usize>) -> SourceSpan {
        let start = self.text.floor_char_boundary(range.start);
        let end = range.end.clamp(start, self.text.len());
        let end = self.text.floor_char_boundary(end.min(start + limits::EXCERPT));
        (start, end - start).into()
    }

    /// Returns the text as it may be shown: control characters and those that turn the direction of writing
    /// replaced, byte by byte, so that places stay.
    fn printable(&self) -> &str {
        let printable = self.printable.get_or_init(|| {
            let hidden = |letter: char| is_hidden(letter) && !matches!(letter, '\n' | '\t');
            self.text.contains(hidden).then(|| {
                let mut text = String::with_capacity(self.text.len());
                for letter in self.text.chars() {
                    match letter {
                        // Most of them end a line, together with what follows.
                        '\r' => text.push(' '),
                        letter if hidden(letter) => text.extend(std::iter::repeat_n('?', letter.len_utf8())),
                        letter => text.push(letter),
                    }
                }
                text
            })
        });
        printable.as_deref().unwrap_or(&self.text)
    }

    /// Returns the starts of lines, in bytes.
    fn lines(&self) -> &[usize] {
        self.lines.get_or_init(|| {
            let ends = self.text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
            std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect()
        })
    }

    /// Returns the line of a byte, from 0, and where it starts.
    fn line_of(&self, byte: usize) -> (usize, usize) {
        let line = self
            .lines()
            .partition_point(|start| *start <= byte)
            .saturating_sub(1);
        (line, self.lines()[line])
    }

    fn start_of(&self, line: usize) -> usize {
        self.lines().get(line).copied().unwrap_or(self.text.len())
    }
}

impl SourceCode for Text {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let end = span.offset().saturating_add(span.len());
        if end > self.text.len() {
            return Err(MietteError::OutOfBounds);
        }
        let first = self.line_of(span.offset()).0.saturating_sub(before);
        let last = self.line_of(end).0 + after;
        // Without lines before it the caller asks for the place of the span itself.
        let line_start = if before == 0 {
            span.offset()
        } else {
            self.start_of(first)
        };
        let start = line_start.max(span.offset().saturating_sub(limits::EXCERPT));
        let start = self.text.ceil_char_boundary(start);
        let stop = self.start_of(last + 1).min(end.saturating_add(limits::EXCERPT));
        let stop = self.text.floor_char_boundary(stop).max(start);
        let (line, own) = self.line_of(start);
        let contents = MietteSpanContents::new_named(
            self.name.clone(),
            &self.printable().as_bytes()[start..stop],
            (start, stop - start).into(),
            line,
            self.slice(own..start).chars().count(),
            self.line_of(stop).0 - line + 1,
        );
        Ok(Box::new(contents))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_places_are_lines_and_columns_in_characters() {
        let text = Text::new("name", "äb\nc\r\nd");
        assert_eq!(text.line_and_column(0), (1, 1));
        assert_eq!(text.line_and_column(2), (1, 2));
        assert_eq!(text.line_and_column(4), (2, 1));
        assert_eq!(text.line_and_column(7), (3, 1));
        assert_eq!(text.line_and_column(1000), (3, 2));
        assert_eq!(text.slice(0..1), "");
    }

    #[test]
    #[allow(clippy::unwrap_used)]
    fn limits_excerpts_hold_nothing_that_moves_the_cursor() {
        let text = Text::new("name", "a = \"\u{1b}[31m\u{202e}é\u{9b}\"\tb\rc\r\n");
        let seen = text.read_span(&(0, 1).into(), 1, 1).unwrap();
        assert_eq!(seen.data(), "a = \"?[31m???é??\"\tb c \n".as_bytes());
        assert_eq!(text.slice(5..6), "\u{1b}");
    }

    #[test]
    #[allow(clippy::unwrap_used)]
    fn limits_excerpts_of_long_lines_are_cut_around_the_place() {
        let long = format!("{}\u{e9}x{}\nnext", "\u{e9}".repeat(50_000), "y".repeat(50_000));
        let text = Text::new("name", long);
        let at = 100_002;
        let seen = text.read_span(&(at, 1).into(), 1, 1).unwrap();
        assert!(seen.data().len() <= 2 * limits::EXCERPT + 1);
        assert!(std::str::from_utf8(seen.data()).unwrap().contains('x'));
        assert_eq!(seen.line(), 0);
        assert_eq!(seen.column(), text.line_and_column(seen.span().offset()).1 - 1);
        assert_eq!(text.mark(at..at + 70_000).len(), limits::EXCERPT);
    }
}
