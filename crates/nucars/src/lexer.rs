//! Words, quoted texts and lines.
//!
//! Inside a section the files are free-format as in Fortran's list-directed input: values are separated by
//! blanks, tabs, commas and line ends. `!` begins a comment that ends with the line, `'...'` protects it; a
//! doubled quotation mark stands for itself. Left out of Fortran's rules: repeat counts (`3*0.0`), empty
//! values between commas, and `/` as the end of a record. Where one stands, the reader finds a text where a
//! number belongs.

use crate::source::Span;

/// A word or a quoted text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    pub kind: TokenKind,
    /// With the quotation marks.
    pub span: Span,
    /// True if it is the first one in its line.
    pub begins_line: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    Word,
    Quoted,
    /// Its line ends before the second quotation mark.
    Unclosed,
}

/// A place in a text from which tokens are taken, up to an end.
#[derive(Clone, Copy, Debug)]
pub struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
    end: usize,
    /// No token was taken from this line yet.
    line_is_new: bool,
}

fn is_blank(byte: u8) -> bool {
    // Also the mark of the end of a file in DOS, and the zero bytes some programs fill up with.
    matches!(byte, b' ' | b'\t' | b'\r' | b',' | 0x0b | 0x0c | 0x1a | 0x00)
}

impl<'a> Cursor<'a> {
    /// Returns a cursor over a piece of a text; begins in the middle of a line unless `at` is the start of
    /// one.
    pub fn new(text: &'a str, at: usize, end: usize) -> Self {
        Cursor {
            text: text.as_bytes(),
            at,
            end: end.min(text.len()),
            line_is_new: true,
        }
    }

    pub fn position(&self) -> usize {
        self.at
    }

    pub fn remaining(&self) -> usize {
        self.end - self.at
    }

    /// Returns its end, as an empty piece after the tokens taken.
    pub fn here(&self) -> Span {
        Span::new(self.at, self.at)
    }

    pub fn peek(&self) -> Option<Token> {
        let mut ahead = *self;
        ahead.next()
    }

    /// Returns the next token, across lines.
    #[allow(clippy::should_implement_trait)]
    pub fn next(&mut self) -> Option<Token> {
        while self.at < self.end {
            match self.text[self.at] {
                b'\n' => {
                    self.line_is_new = true;
                    self.at += 1;
                }
                b'!' => self.at = self.end_of_line(),
                byte if is_blank(byte) => self.at += 1,
                quote @ (b'\'' | b'"') => return Some(self.quoted(quote)),
                _ => return Some(self.word()),
            }
        }
        None
    }

    /// Returns the next token if it is in the same line.
    pub fn next_in_line(&mut self) -> Option<Token> {
        let mut ahead = *self;
        let token = ahead.next().filter(|token| !token.begins_line)?;
        *self = ahead;
        Some(token)
    }

    /// Returns the number of tokens of the line from here on, or `most + 1` if they are more than `most`.
    pub fn tokens_in_line(&self, most: usize) -> usize {
        let mut ahead = *self;
        let Some(_) = ahead.next() else { return 0 };
        let mut count = 1;
        while count <= most && ahead.next_in_line().is_some() {
            count += 1;
        }
        count
    }

    /// Goes to the start of the next line.
    pub fn skip_line(&mut self) {
        self.at = (self.end_of_line() + 1).min(self.end);
        self.line_is_new = true;
    }

    /// Goes to the start of the line after the next token's.
    pub fn skip_past_line(&mut self) {
        if self.next().is_some() {
            self.skip_line();
        }
    }

    fn end_of_line(&self) -> usize {
        let rest = &self.text[self.at..self.end];
        rest.iter()
            .position(|byte| *byte == b'\n')
            .map_or(self.end, |length| self.at + length)
    }

    fn token(&mut self, kind: TokenKind, start: usize) -> Token {
        let begins_line = std::mem::replace(&mut self.line_is_new, false);
        Token {
            kind,
            span: Span::new(start, self.at),
            begins_line,
        }
    }

    fn word(&mut self) -> Token {
        let start = self.at;
        while self.at < self.end {
            let byte = self.text[self.at];
            if is_blank(byte) || matches!(byte, b'\n' | b'!' | b'\'' | b'"') {
                break;
            }
            self.at += 1;
        }
        self.token(TokenKind::Word, start)
    }

    fn quoted(&mut self, quote: u8) -> Token {
        let start = self.at;
        self.at += 1;
        loop {
            match self.text.get(self.at).filter(|_| self.at < self.end) {
                Some(byte) if *byte == quote => {
                    self.at += 1;
                    if self.at >= self.end || self.text[self.at] != quote {
                        return self.token(TokenKind::Quoted, start);
                    }
                    self.at += 1;
                }
                None | Some(b'\n') => {
                    return self.token(TokenKind::Unclosed, start);
                }
                Some(_) => self.at += 1,
            }
        }
    }
}

/// Returns the text between the quotation marks.
pub fn unquote(text: &str) -> String {
    let Some(quote) = text.chars().next() else {
        return String::new();
    };
    let inner = &text[quote.len_utf8()..];
    let inner = inner.strip_suffix(quote).unwrap_or(inner).trim_end_matches('\r');
    if inner.contains(quote) {
        inner.replace(&format!("{quote}{quote}"), &quote.to_string())
    } else {
        inner.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(&str, TokenKind, bool)> {
        let mut cursor = Cursor::new(text, 0, text.len());
        let mut found = Vec::new();
        while let Some(token) = cursor.next() {
            found.push((&text[token.span.range()], token.kind, token.begins_line));
        }
        found
    }

    #[test]
    fn blanks_comments_and_quotes() {
        use TokenKind::{Quoted, Unclosed, Word};
        assert_eq!(
            words("1\t'a ! b',2!c 'd\r\n ! only\n\n 3'e''f'\r\n'g\n4"),
            [
                ("1", Word, true),
                ("'a ! b'", Quoted, false),
                ("2", Word, false),
                ("3", Word, true),
                ("'e''f'", Quoted, false),
                ("'g", Unclosed, true),
                ("4", Word, true),
            ]
        );
        assert_eq!(unquote("'e''f'"), "e'f");
        assert_eq!(unquote("'g\r"), "g");
        assert_eq!(unquote("'"), "");
    }

    #[test]
    fn lines_are_counted_and_skipped() {
        let text = "1 2 3\n4 5";
        let mut cursor = Cursor::new(text, 0, text.len());
        assert_eq!(cursor.tokens_in_line(9), 3);
        assert_eq!(cursor.tokens_in_line(1), 2);
        cursor.skip_line();
        assert_eq!(cursor.tokens_in_line(9), 2);
        cursor.skip_line();
        assert_eq!(cursor.next(), None);
        assert_eq!(cursor.remaining(), 0);
    }
}
