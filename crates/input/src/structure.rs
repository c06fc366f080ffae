//! The structure of TOML, checked before it is parsed: the parser recurses, and where it recovers from
//! mistakes its time grows with the square of the nesting.

use std::ops::Range;

use thiserror::Error;
use toml_parser::Source;
use toml_parser::lexer::TokenKind;

use crate::limits;

/// Reasons why a text is not parsed at all.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Excess {
    /// The text is too long.
    #[error("the text has {found} bytes; at most {} are read", limits::TEXT_FILE)]
    Length {
        /// Its length.
        found: usize,
    },
    /// A line is too long.
    #[error("this line has {found} bytes; at most {} are read", limits::LINE)]
    Line {
        /// Its length.
        found: usize,
        /// The place at which it begins.
        at: usize,
    },
    /// Lists, tables or keys are nested too deeply.
    #[error("lists, tables and keys are nested more than {} deep", limits::NESTING)]
    Nesting {
        /// The place at which it becomes too deep.
        at: usize,
    },
    /// There are too many values.
    #[error("there are more than {} values", limits::VALUES)]
    Values {
        /// The first value too many.
        at: usize,
    },
}

impl Excess {
    /// Returns the place, in bytes.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::Length { .. } => 0..0,
            Self::Line { at, .. } | Self::Nesting { at } | Self::Values { at } => *at..*at + 1,
        }
    }

    /// Returns the advice.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::Length { .. } => {
                "look whether this is the file you mean; long tables belong into CSV files beside the case"
            }
            Self::Line { .. } => "break the line: a list may go over many lines",
            Self::Nesting { .. } => {
                "look for brackets that are not closed; nothing in a case or a study is nested so deeply"
            }
            Self::Values { .. } => "put long tables into CSV files beside the case",
        }
    }
}

/// Checks the length of a text and of its lines.
///
/// # Errors
/// It, or one of its lines, is too long.
pub fn lines(text: &str) -> Result<(), Excess> {
    if text.len() as u64 > limits::TEXT_FILE {
        return Err(Excess::Length { found: text.len() });
    }
    if text.len() <= limits::LINE {
        return Ok(());
    }
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.len() > limits::LINE {
            return Err(Excess::Line {
                found: line.len(),
                at,
            });
        }
        at += line.len();
    }
    Ok(())
}

/// Checks length, nesting and number of values of a TOML text.
///
/// A closing bracket closes an open one of its kind only, and only the innermost: one that fits nothing
/// closes nothing, since the parser stays inside and recurses further. So the depth found here is at least
/// the parser's.
///
/// # Errors
/// One of them is beyond its limit.
pub fn toml(text: &str) -> Result<(), Excess> {
    lines(text)?;
    let mut open = Vec::with_capacity(limits::NESTING + 1);
    let (mut values, mut dots) = (0_usize, 0_usize);
    for token in Source::new(text).lex() {
        match token.kind() {
            bracket @ (TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket) => {
                open.push(bracket);
                values += 1;
                dots = 0;
            }
            TokenKind::RightSquareBracket => {
                open.pop_if(|last| *last == TokenKind::LeftSquareBracket);
            }
            TokenKind::RightCurlyBracket => {
                open.pop_if(|last| *last == TokenKind::LeftCurlyBracket);
            }
            TokenKind::Dot => dots += 1,
            TokenKind::Comma | TokenKind::Equals => {
                values += 1;
                dots = 0;
            }
            TokenKind::Newline => dots = 0,
            _ => {}
        }
        let at = token.span().start();
        if open.len() > limits::NESTING || dots > limits::NESTING {
            return Err(Excess::Nesting { at });
        }
        if values > limits::VALUES {
            return Err(Excess::Values { at });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_strings_and_comments_do_not_count() {
        let brackets = "[".repeat(100);
        for text in [
            format!("# {brackets}\na = 1"),
            format!("a = \"{brackets}\\\"{brackets}\""),
            format!("a = '{brackets}'\nb = '''{brackets}\n{brackets}'''"),
            format!("a = \"\"\"{brackets}\n\"{brackets}\\\"\"\"\""),
            "a = [[1, 2], [3, 4]]\n".repeat(100),
            "[a.b]\nx = 1.5\n".repeat(100),
        ] {
            assert_eq!(toml(&text), Ok(()), "{text}");
        }
    }

    #[test]
    fn limits_deep_nesting_is_found_where_it_becomes_too_deep() {
        let at = limits::NESTING;
        assert_eq!(toml(&"[".repeat(30_000)), Err(Excess::Nesting { at }));
        let braces = format!("a={}", "{a=".repeat(30_000));
        assert_eq!(toml(&braces), Err(Excess::Nesting { at: 2 + 3 * at }));
        assert_eq!(
            toml(&"a.".repeat(30_000)),
            Err(Excess::Nesting { at: 2 * at + 1 })
        );
        // A string that is not closed ends with its line.
        let hidden = format!("a = \"\nb = {}", "[".repeat(100));
        assert!(matches!(toml(&hidden), Err(Excess::Nesting { .. })));
    }

    /// A bracket of the other kind closed what the parser kept open: the program was aborted by 280 kB of
    /// such lines.
    #[test]
    fn issue_029_brackets_of_the_other_kind_close_nothing() {
        for line in [
            "a={[]]\n",
            "r={f]\nd=[1]\n",
            "a=[{}}\n",
            "a=[\"\"\"x\"\"\"\",[\n]\n",
            "[a}\n",
        ] {
            let found = toml(&line.repeat(3000));
            assert!(matches!(found, Err(Excess::Nesting { .. })), "{line}: {found:?}");
        }
        // What is closed in order is at no depth, however often.
        assert_eq!(toml(&"a=[{b=[]}]\n[c]\n".repeat(3000)), Ok(()));
    }

    #[test]
    fn limits_values_lines_and_length() {
        let many = format!("a = [{}]", "1,".repeat(limits::VALUES));
        assert!(matches!(toml(&many), Err(Excess::Values { .. })));
        let long = format!("a = '{}'\n", "x".repeat(limits::LINE));
        assert!(matches!(toml(&long), Err(Excess::Line { at: 0, .. })));
        let large = "a\n".repeat(limits::TEXT_FILE as usize / 2 + 1);
        assert!(matches!(toml(&large), Err(Excess::Length { .. })));
    }
}
