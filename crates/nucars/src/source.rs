//! Texts that were read, and places in them.

use std::fmt;
use std::ops::{Deref, Range};
use std::sync::Arc;

use input::Text;
use input::structure::{self, Excess};
use miette::{MietteError, SourceCode, SourceSpan, SpanContents};
use thiserror::Error;

/// A piece of a text, in bytes of [`SourceText::text`]; texts are far below 4 GiB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One after the last byte.
    pub end: u32,
}

impl Span {
    pub(crate) fn new(start: usize, end: usize) -> Self {
        // Sources are shorter than u32::MAX, so nothing is cut off.
        Span {
            start: start as u32,
            end: end as u32,
        }
    }

    /// Returns the piece from the start of this one to the end of the other one.
    pub fn to(self, other: Span) -> Span {
        Span {
            start: self.start,
            end: other.end.max(self.start),
        }
    }

    /// Returns the piece as a range of indices.
    pub fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// A value with the place it was read from.
///
/// Two of them are equal if their values are: places do not count, so that trees from differently laid out
/// files can be compared.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spanned<T> {
    /// The value as typed, in the file's units.
    pub value: T,
    /// Its place in the file.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// Returns a value at a place.
    pub fn new(value: T, span: Span) -> Self {
        Spanned { value, span }
    }
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T> Deref for Spanned<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> From<T> for Spanned<T> {
    /// Returns a value that was not read from a text.
    fn from(value: T) -> Self {
        Spanned::new(value, Span::default())
    }
}

impl<T: fmt::Display> fmt::Display for Spanned<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(out)
    }
}

/// The place of a record. All of them are equal, so that trees from differently laid out files can be
/// compared.
#[derive(Clone, Copy, Debug, Default)]
pub struct At(pub Span);

impl PartialEq for At {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// The reason why a text cannot be read at all.
#[derive(Clone, Debug, Error)]
#[error("{name}: {excess}")]
pub struct SourceError {
    /// The file.
    pub name: String,
    /// The excess over the limits of readers.
    pub excess: Excess,
}

/// A file's text.
#[derive(Debug)]
pub struct SourceText {
    text: Text,
    latin1: bool,
}

impl SourceText {
    /// Returns the text of a file: UTF-8, with or without byte order mark, UTF-16 with one, or else Latin-1.
    /// Lines end with `\n`, `\r\n` or `\r`.
    ///
    /// # Errors
    /// It, or one of its lines, is longer than [`input::limits`] allow.
    pub fn from_bytes(name: impl Into<String>, bytes: Vec<u8>) -> Result<Arc<Self>, SourceError> {
        let name = name.into();
        let (mut text, latin1) = match utf16(&bytes).map_or_else(|| String::from_utf8(bytes), Ok) {
            Ok(text) => (text, false),
            Err(error) => (
                error.as_bytes().iter().map(|byte| char::from(*byte)).collect(),
                true,
            ),
        };
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        if !text.contains('\n') && text.contains('\r') {
            text = text.replace('\r', "\n");
        }
        if let Err(excess) = structure::lines(&text) {
            return Err(SourceError { name, excess });
        }
        Ok(Arc::new(SourceText {
            text: Text::new(name, text),
            latin1,
        }))
    }

    /// Returns a text that is not from a file.
    ///
    /// # Errors
    /// As [`SourceText::from_bytes`].
    pub fn from_text(name: impl Into<String>, text: impl Into<String>) -> Result<Arc<Self>, SourceError> {
        SourceText::from_bytes(name, text.into().into_bytes())
    }

    /// Returns the file as the user named it.
    pub fn name(&self) -> &str {
        self.text.name()
    }

    /// Returns the text, without byte order mark.
    pub fn text(&self) -> &str {
        self.text.text()
    }

    /// Returns whether the file is no UTF-8 and was taken as Latin-1.
    pub fn is_latin1(&self) -> bool {
        self.latin1
    }

    /// Returns the text of a piece; empty if it is not one of this text.
    pub fn slice(&self, span: Span) -> &str {
        self.text.slice(span.range())
    }

    /// Line and column of a byte, from 1; columns count characters.
    pub fn line_and_column(&self, byte: u32) -> (usize, usize) {
        self.text.line_and_column(byte as usize)
    }

    /// Returns the part of a piece that a message marks.
    pub(crate) fn mark(&self, span: Span) -> SourceSpan {
        self.text.mark(span.range())
    }
}

/// Returns the text of UTF-16 with a byte order mark.
fn utf16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return None,
    };
    let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
    char::decode_utf16(units).collect::<Result<String, _>>().ok()
}

impl SourceCode for SourceText {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        self.text.read_span(span, before, after)
    }
}

/// A piece of a source.
#[derive(Clone, Debug)]
pub struct SourceLocation {
    /// The text.
    pub source: Arc<SourceText>,
    /// The piece of it.
    pub span: Span,
}

impl SourceLocation {
    /// Returns the text of the piece.
    pub fn text(&self) -> &str {
        self.source.slice(self.span)
    }

    /// Line and column of its start, from 1; columns count characters.
    pub fn line_and_column(&self) -> (usize, usize) {
        self.source.line_and_column(self.span.start)
    }
}
