//! Unit expressions: `lbf s/in`, `lb in^2`, `kN/mm`, `lbf/(in s)`.

use crate::error::UnitError;
use crate::units::{NamedUnit, SYNONYMS, UNITS, find};
use crate::{Dimension, System, nearest};
use input::{limits, shortened};
use std::ops::Range;

/// A unit, named or composed: its dimension and its size in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    factor: f64,
    dimension: Dimension,
    system: Option<System>,
}

impl Unit {
    /// Reads a unit expression.
    ///
    /// Products are written with a space, `*`, `·` or `-`, quotients with `/`, powers with `^2`,
    /// `²` or `³`. A quotient divides by one unit, or by a product in brackets: `lbf/in s` could
    /// be meant in two ways and is refused.
    ///
    /// # Errors
    /// [`UnitError::UnknownUnit`] or [`UnitError::BadExpression`], with places counted from the
    /// start of `text`.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        Self::parse_at(text, 0)
    }

    /// As [`Unit::parse`], with places counted from `offset`.
    pub(crate) fn parse_at(text: &str, offset: usize) -> Result<Self, UnitError> {
        let parser = Parser {
            text,
            at: 0,
            offset,
            depth: 0,
        };
        if text.len() > limits::QUANTITY {
            let reason = format!("it has more than {} characters", limits::QUANTITY);
            return Err(parser.bad(0..text.len(), &reason));
        }
        parser.expression()
    }

    /// Returns the factor of one of these to SI units.
    pub const fn factor(self) -> f64 {
        self.factor
    }

    /// Returns the dimension.
    pub const fn dimension(self) -> Dimension {
        self.dimension
    }

    /// Returns the system of units that it belongs to: none where both have it (`s`, `deg`), or where units
    /// of both are multiplied (`lbf/mm`).
    pub const fn system(self) -> Option<System> {
        self.system
    }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    offset: usize,
    /// Number of open brackets: the parser recurses at each of them.
    depth: usize,
}

/// Numerators and denominators are multiplied up apart and divided once, so that `N/mm` is not
/// rounded twice.
#[derive(Clone, Copy)]
struct Product {
    over: f64,
    under: f64,
    dimension: Dimension,
    /// Whether there are units of the US customary system, and of SI.
    systems: [bool; 2],
}

impl Product {
    const ONE: Product = Product {
        over: 1.0,
        under: 1.0,
        dimension: Dimension::NONE,
        systems: [false; 2],
    };

    fn times(mut self, unit: &NamedUnit, power: i8) -> Option<Product> {
        let raised = unit.factor.powi(i32::from(power.unsigned_abs()));
        self.dimension = self.dimension.times(unit.dimension, power)?;
        if power < 0 {
            self.under *= raised;
        } else {
            self.over *= raised;
        }
        if let Some(system) = unit.system {
            self.systems[system as usize] = true;
        }
        Some(self)
    }

    /// Returns the system that all its units belong to.
    const fn system(self) -> Option<System> {
        match self.systems {
            [true, false] => Some(System::Us),
            [false, true] => Some(System::Si),
            _ => None,
        }
    }
}

impl Parser<'_> {
    fn expression(mut self) -> Result<Unit, UnitError> {
        let product = self.product(1, false, Product::ONE)?;
        let (factor, dimension) = (product.over / product.under, product.dimension);
        if factor.is_normal() {
            Ok(Unit {
                factor,
                dimension,
                system: product.system(),
            })
        } else {
            Err(self.bad(
                0..self.text.len(),
                "this unit is too large or too small to compute with",
            ))
        }
    }

    /// Factors up to the end, or up to the closing bracket.
    fn product(&mut self, sign: i8, inside: bool, mut product: Product) -> Result<Product, UnitError> {
        let mut divides = false;
        let mut divided = false;
        let mut first = true;
        loop {
            let gap = self.at;
            self.skip_spaces();
            let before = self.at;
            let end = match self.peek() {
                None => true,
                Some(')') if inside => true,
                _ => false,
            };
            if end {
                if first || divides {
                    return Err(self.bad(before..before, "a unit is missing here"));
                }
                return Ok(product);
            }
            if !first {
                match self.peek() {
                    Some('/') => {
                        self.bump();
                        self.skip_spaces();
                        divides = true;
                    }
                    Some('*' | '·' | '⋅' | '-') => {
                        self.bump();
                        self.skip_spaces();
                        divides = false;
                    }
                    _ if before > gap => divides = false,
                    _ => {
                        let length = self.peek().map_or(0, char::len_utf8);
                        return Err(self.bad(before..before + length, "this does not belong in a unit"));
                    }
                }
                if divided && !divides {
                    let reason = "it is not clear whether this unit belongs above or below the \
                                  line: write `lbf s/in` or `lbf/(in s)`";
                    let end = self.text[self.at..]
                        .find([' ', '/', ')'])
                        .map_or(self.text.len(), |n| self.at + n);
                    return Err(self.bad(self.at..end, reason));
                }
            }
            divided |= divides;
            product = self.factor(if divides { -sign } else { sign }, first && !inside, product)?;
            divides = false;
            first = false;
        }
    }

    /// Reads one unit with its power, a product in brackets, or the `1` of `1/s`.
    fn factor(&mut self, sign: i8, may_be_one: bool, product: Product) -> Result<Product, UnitError> {
        let start = self.at;
        match self.peek() {
            Some('(') if self.depth == limits::NESTING => {
                let reason = format!("brackets are nested more than {} deep", limits::NESTING);
                Err(self.bad(start..start + 1, &reason))
            }
            Some('(') => {
                self.bump();
                self.depth += 1;
                let product = self.product(sign, true, product)?;
                self.depth -= 1;
                if self.peek() != Some(')') {
                    return Err(self.bad(start..start + 1, "this bracket is not closed"));
                }
                self.bump();
                Ok(product)
            }
            Some('1') if may_be_one && self.text[self.at + 1..].trim_start().starts_with('/') => {
                self.bump();
                Ok(product)
            }
            Some(letter) if is_letter(letter) => {
                while self.peek().is_some_and(|c| is_letter(c) || c.is_ascii_digit()) {
                    self.bump();
                }
                let name = &self.text[start..self.at];
                let Some(unit) = find(name) else {
                    return Err(self.unknown(start..self.at));
                };
                let power = self.power()?;
                product
                    .times(unit, sign * power)
                    .ok_or_else(|| self.bad(start..self.at, "the powers of this unit are too high"))
            }
            Some(')') => Err(self.bad(start..start + 1, "this bracket was not opened")),
            Some(c) => Err(self.bad(start..start + c.len_utf8(), "this does not belong in a unit")),
            None => Err(self.bad(start..start, "a unit is missing here")),
        }
    }

    /// Returns a power from 1 to 9 or -9 to -1, as `^2`, `^-1`, `²` or `³`; without one, 1.
    fn power(&mut self) -> Result<i8, UnitError> {
        let start = self.at;
        match self.peek() {
            Some('²') => {
                self.bump();
                Ok(2)
            }
            Some('³') => {
                self.bump();
                Ok(3)
            }
            Some('^') => {
                self.bump();
                if self.peek() == Some('-') {
                    self.bump();
                }
                while self.peek().is_some_and(|c| c.is_ascii_digit()) {
                    self.bump();
                }
                match self.text[start + 1..self.at].parse::<i8>() {
                    Ok(power) if (-9..=9).contains(&power) && power != 0 => Ok(power),
                    _ => Err(self.bad(start..self.at, "a power is a whole number such as ^2")),
                }
            }
            _ => Ok(1),
        }
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn bump(&mut self) {
        self.at += self.peek().map_or(0, char::len_utf8);
    }

    fn skip_spaces(&mut self) {
        while self.peek().is_some_and(char::is_whitespace) {
            self.bump();
        }
    }

    fn place(&self, span: Range<usize>) -> Range<usize> {
        span.start + self.offset..span.end + self.offset
    }

    fn bad(&self, span: Range<usize>, reason: &str) -> UnitError {
        UnitError::BadExpression {
            reason: reason.into(),
            span: self.place(span),
        }
    }

    fn unknown(&self, span: Range<usize>) -> UnitError {
        let name = &self.text[span.clone()];
        let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let synonym = SYNONYMS
            .iter()
            .find(|(typed, _)| typed.eq_ignore_ascii_case(name));
        let nearest = if base.len() < name.len() && find(base).is_some() {
            Some(format!("{base}^{}", &name[base.len()..]))
        } else if let Some((_, meant)) = synonym {
            Some((*meant).into())
        } else {
            nearest(name, UNITS.iter().map(|unit| unit.name)).map(String::from)
        };
        UnitError::UnknownUnit {
            unit: shortened(name),
            nearest,
            span: self.place(span.clone()),
        }
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '°' || c == '"' || c == '\'' || c == '%' || c == '#'
}
