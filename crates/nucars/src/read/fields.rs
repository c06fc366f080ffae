//! Taking the values of records one by one, and saying what is wrong with them.

use crate::finding::{Finding, Findings, Severity};
use crate::lexer::{Cursor, Token, TokenKind, unquote};
use crate::number;
use crate::source::{Span, Spanned};
use crate::tree::Dof;

/// The record cannot be read on; why was said already.
#[derive(Clone, Copy, Debug)]
pub struct Stop;

/// The point at which a record that goes on in the next line would begin a new one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrap {
    /// At a number followed by a name in quotation marks.
    NamedRecords,
    /// At a line with more values than the record still lacks.
    Counted,
}

/// Takes values from a section.
pub struct Fields<'a, 'f> {
    pub cursor: Cursor<'a>,
    /// The place after the token that was read last.
    ahead: Cursor<'a>,
    pub findings: &'f mut Findings,
    text: &'a str,
    wrap: Wrap,
    /// Number of values that the record still lacks.
    lacking: usize,
    /// The record's name in messages.
    record: &'static str,
    /// Its number once it is known, or else its place in the list, from 1.
    id: Option<u32>,
    index: u32,
    start: Option<Span>,
    end: Span,
    bad: bool,
}

impl<'a, 'f> Fields<'a, 'f> {
    pub fn new(cursor: Cursor<'a>, text: &'a str, wrap: Wrap, findings: &'f mut Findings) -> Self {
        Fields {
            end: cursor.here(),
            cursor,
            ahead: cursor,
            findings,
            text,
            wrap,
            lacking: 0,
            record: "",
            id: None,
            index: 0,
            start: None,
            bad: false,
        }
    }

    /// Returns the whole file.
    pub fn text(&self) -> &'a str {
        self.text
    }

    pub fn slice(&self, span: Span) -> &'a str {
        &self.text[span.range()]
    }

    /// The record goes on to here.
    pub fn extend_span(&mut self, span: Span) {
        self.end = span;
    }

    /// Returns the line of a byte, from 1.
    pub fn cursor_line(&self, byte: u32) -> usize {
        self.findings.source().line_and_column(byte).0
    }

    pub fn text_of(&self, token: Token) -> &'a str {
        &self.text[token.span.range()]
    }

    /// Begins a record of at least `values` values.
    pub fn begin(&mut self, record: &'static str, index: u32, values: usize) {
        self.record = record;
        self.id = None;
        self.index = index;
        self.lacking = values;
        self.start = None;
        self.bad = false;
    }

    /// Names the record once its number is known.
    pub fn identify(&mut self, id: u32) {
        self.id = Some(id);
    }

    /// Returns the record's name in messages.
    fn name(&self) -> String {
        match (self.id, self.index) {
            (Some(id), _) => format!("{} {id}", self.record),
            (None, 0) => self.record.to_owned(),
            (None, index) => format!("{} no. {index} in the list", self.record),
        }
    }

    /// The record has so many more values.
    pub fn expect_more(&mut self, values: u32) {
        self.lacking = self.lacking.saturating_add(values as usize);
    }

    /// Returns the span from the first value of the record to the last.
    pub fn span(&self) -> Span {
        self.start.unwrap_or(self.end).to(self.end)
    }

    /// Returns whether a value of the record was wrong and stands for another.
    pub fn is_bad(&self) -> bool {
        self.bad
    }

    fn error(&mut self, code: &'static str, span: Span, message: String, label: &str, help: String) {
        let dress = |finding: Finding| finding.label(label).help(help);
        self.findings.add(Severity::Error, code, span, message, dress);
    }

    /// Returns the token that is the next value.
    fn take(&mut self, what: &str) -> Result<Token, Stop> {
        self.ahead = self.cursor;
        let Some(token) = self.ahead.next() else {
            let message = format!("{} ends before its {what}", self.name());
            let end = if self.start.is_some() {
                self.end
            } else {
                self.cursor.here()
            };
            let help =
                "the section, or the file, ends here: add what is missing, or correct the counts before it";
            self.error(
                "ends-early",
                end,
                message,
                &format!("expected {what}"),
                help.to_owned(),
            );
            return Err(Stop);
        };
        if token.begins_line && self.start.is_some() && self.begins_record() {
            let message = format!("{} ends before its {what}", self.name());
            let help =
                "the next line begins another record: add what is missing, or correct the counts in this one";
            self.error(
                "ends-early",
                self.end,
                message,
                &format!("expected {what} after this"),
                help.to_owned(),
            );
            return Err(Stop);
        }
        Ok(token)
    }

    fn begins_record(&self) -> bool {
        match self.wrap {
            Wrap::Counted => self.cursor.tokens_in_line(self.lacking) > self.lacking,
            Wrap::NamedRecords => {
                let mut ahead = self.cursor;
                let number = ahead
                    .next()
                    .is_some_and(|token| number::whole(&self.text[token.span.range()]).is_some());
                let name = ahead
                    .next_in_line()
                    .is_some_and(|token| token.kind != TokenKind::Word);
                number && name
            }
        }
    }

    /// Advances past the token that was read.
    fn accept(&mut self, token: Token) {
        self.cursor = self.ahead;
        self.start.get_or_insert(token.span);
        self.end = token.span;
        self.lacking = self.lacking.saturating_sub(1);
    }

    /// Returns the next value as `read` understands it. A word it does not understand is a mistake and stands
    /// for `instead`; a quoted text ends the record.
    fn value<T>(
        &mut self,
        what: &str,
        expected: &str,
        instead: T,
        read: impl Fn(&str) -> Option<T>,
    ) -> Result<Spanned<T>, Stop> {
        let token = self.take(what)?;
        let text = self.text_of(token);
        let understood = if token.kind == TokenKind::Word {
            read(text)
        } else {
            None
        };
        if let Some(value) = understood {
            self.accept(token);
            return Ok(Spanned::new(value, token.span));
        }
        self.bad = true;
        if self.findings.is_full() {
            // Spares the messages nobody sees.
            self.findings.skip();
            return self.instead(token, instead);
        }
        let message = format!("`{}` is not {expected}", short(text));
        let label = format!("expected the {what} of {}", self.name());
        let help = self.advice(text, expected);
        self.error("value", token.span, message, &label, help);
        self.instead(token, instead)
    }

    fn instead<T>(&mut self, token: Token, instead: T) -> Result<Spanned<T>, Stop> {
        if token.kind == TokenKind::Word {
            self.accept(token);
            Ok(Spanned::new(instead, token.span))
        } else {
            Err(Stop)
        }
    }

    fn advice(&self, text: &str, expected: &str) -> String {
        if text.contains('*') && text.starts_with(|letter: char| letter.is_ascii_digit()) {
            "repeat counts such as 3*0.0 are not read: write the value out".to_owned()
        } else if text.starts_with('/') {
            "a `/` does not end a record here: write all values".to_owned()
        } else if number::real(text).is_some() {
            format!("{expected} belongs here")
        } else {
            format!("write {expected}; a comment begins with `!`")
        }
    }

    /// Returns a number.
    pub fn number(&mut self, what: &str) -> Result<Spanned<f64>, Stop> {
        self.value(what, "a number such as 12, 1.5, 1.0E6 or 1.D0", 0.0, number::real)
    }

    /// Returns a whole number.
    pub fn whole(&mut self, what: &str) -> Result<Spanned<u32>, Stop> {
        self.value(what, "a whole number such as 12", 0, number::whole)
    }

    /// Returns a whole number that must be understood, because others depend on it.
    pub fn key(&mut self, what: &str) -> Result<Spanned<u32>, Stop> {
        let was_bad = std::mem::replace(&mut self.bad, false);
        let value = self.whole(what)?;
        if self.bad {
            return Err(Stop);
        }
        self.bad = was_bad;
        Ok(value)
    }

    /// Returns a truth value.
    pub fn logical(&mut self, what: &str) -> Result<Spanned<bool>, Stop> {
        self.value(what, "`.T.` or `.F.`", false, number::logical)
    }

    /// Returns a degree of freedom.
    pub fn dof(&mut self, what: &str) -> Result<Spanned<Dof>, Stop> {
        self.value(
            what,
            "a degree of freedom, 1 to 9 (1 x, 2 y, 3 z, 4 roll, 5 pitch, 6 yaw, 7 to 9 flexible, 7.01 a \
             mode of 7)",
            crate::tree::DofKind::X.into(),
            number::dof,
        )
    }

    /// Any word that `read` understands.
    pub fn word<T>(
        &mut self,
        what: &str,
        expected: &str,
        instead: T,
        read: impl Fn(&str) -> Option<T>,
    ) -> Result<Spanned<T>, Stop> {
        self.value(what, expected, instead, read)
    }

    /// x, y, z.
    pub fn position(&mut self) -> Result<[Spanned<f64>; 3], Stop> {
        Ok([
            self.number("x (in)")?,
            self.number("y (in)")?,
            self.number("z (in)")?,
        ])
    }

    /// Returns a text in quotation marks.
    pub fn quoted(&mut self, what: &str) -> Result<Spanned<String>, Stop> {
        let token = self.take(what)?;
        let text = self.text_of(token);
        match token.kind {
            TokenKind::Quoted => {
                self.accept(token);
                Ok(Spanned::new(unquote(text), token.span))
            }
            TokenKind::Unclosed => {
                let message = format!(
                    "the quotation mark before `{}` has no second one in its line",
                    short(&unquote(text))
                );
                let help =
                    "close the text with the same mark; a mark inside a text is written twice".to_owned();
                self.error(
                    "quotation",
                    token.span,
                    message,
                    &format!("the {what} of {}", self.name()),
                    help,
                );
                self.cursor.next();
                Err(Stop)
            }
            TokenKind::Word => {
                let message = format!("`{}` is not a text in quotation marks", short(text));
                let help = format!("write '{}', with the quotation marks", short(text));
                self.error(
                    "value",
                    token.span,
                    message,
                    &format!("expected the {what} of {}", self.name()),
                    help,
                );
                self.bad = true;
                if number::real(text).is_some() {
                    // A number: the name itself is missing.
                    return Ok(Spanned::new(String::new(), token.span));
                }
                self.accept(token);
                Ok(Spanned::new(text.to_owned(), token.span))
            }
        }
    }

    /// Reads the rest of the record's last line: numbers there are a mistake or superfluous, words are a
    /// remark.
    pub fn end_of_record(&mut self, severity: Severity, help: &str) -> bool {
        let Some(token) = self.cursor.peek().filter(|token| !token.begins_line) else {
            return true;
        };
        let is_number = token.kind == TokenKind::Word && number::real(self.text_of(token)).is_some();
        if is_number {
            let message = format!("{} has more values than it should", self.name());
            self.findings
                .add(severity, "extra-values", token.span, message, |finding| {
                    finding.label("not expected").help(help)
                });
        }
        self.cursor.skip_line();
        !is_number
    }

    /// Skips at least the rest of this line, then lines until one begins a record.
    pub fn recover(&mut self, begins: impl Fn(&mut Cursor<'a>, &'a str) -> bool) {
        loop {
            // A record that was found incomplete at the start of a line keeps that line.
            match self.cursor.peek() {
                None => return,
                Some(token) if token.begins_line => {}
                Some(_) => self.cursor.skip_line(),
            }
            let mut ahead = self.cursor;
            if begins(&mut ahead, self.text) {
                return;
            }
            let before = self.cursor.position();
            let Some(token) = self.cursor.next() else { return };
            debug_assert!(token.span.end as usize > before);
            self.cursor.skip_line();
        }
    }
}

/// Returns the beginning of a text, for messages.
pub fn short(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut letters = text
        .chars()
        .map(|letter| if letter.is_control() { '?' } else { letter });
    let beginning: String = letters.by_ref().take(LONGEST).collect();
    if letters.next().is_some() {
        beginning + "..."
    } else {
        beginning
    }
}

/// Returns true for a line such as `12 'name' ...`.
pub fn begins_named(cursor: &mut Cursor<'_>, text: &str) -> bool {
    let number = cursor
        .next()
        .is_some_and(|token| number::whole(&text[token.span.range()]).is_some());
    number
        && cursor
            .next_in_line()
            .is_some_and(|token| token.kind == TokenKind::Quoted)
}

/// Returns true for a line such as `12 3 ...`, with at least `least` values, the first two whole numbers from
/// 1 on.
pub fn begins_numbered(cursor: &mut Cursor<'_>, text: &str, least: usize) -> bool {
    let enough = cursor.tokens_in_line(least) >= least;
    let whole = |token: Option<Token>| {
        token.is_some_and(|token| number::whole(&text[token.span.range()]).is_some_and(|value| value > 0))
    };
    enough && whole(cursor.next()) && whole(cursor.next_in_line())
}
