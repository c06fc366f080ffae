//! Tables of numbers as text: the sign between their columns, decimal commas, gaps.

use thiserror::Error;

use crate::shortened;

/// The way in which a table of numbers is written: the sign between its columns, and that of decimals.
///
/// Semicolons and tabs leave the comma to decimals, as European spreadsheets write them: `0,25;-1,5` holds
/// 0.25
/// and -1.5. A table has either decimal points or decimal commas; one that has both is refused, since `1,234`
/// beside `0.5` may as well be a thousand.
///
/// ```
/// use input::{CellError, Separated};
///
/// let mut table = Separated::of("distance [m]; profile [mm]");
/// for (cell, number) in table.cells("0,25; -1,5").zip([0.25, -1.5]) {
///     assert_eq!(table.number(cell), Ok(number));
/// }
/// assert_eq!(table.number(""), Err(CellError::Gap));
/// assert!(matches!(table.number("0.5"), Err(CellError::TwoDecimalSigns { .. })));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Separated {
    separator: char,
    /// The sign of decimals, once a number has shown it.
    decimal: Option<char>,
}

/// Reasons why a cell holds no number.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CellError {
    /// Nothing was measured: the cell is empty, or says `nan`, `na`, `n/a` or `null`.
    #[error("a number is missing")]
    Gap,
    /// The cell is no number.
    #[error("{0} is no number")]
    NoNumber(String),
    /// Numbers of one table have decimal points and decimal commas.
    #[error("{cell} has a decimal {}, numbers before it have decimal {}s", sign(*.own), sign(*.before))]
    TwoDecimalSigns {
        /// The cell.
        cell: String,
        /// Its sign of decimals.
        own: char,
        /// That of earlier numbers.
        before: char,
    },
}

const fn sign(decimal: char) -> &'static str {
    match decimal {
        ',' => "comma",
        _ => "point",
    }
}

impl CellError {
    /// Returns the advice.
    #[must_use]
    pub const fn remedy(&self) -> &'static str {
        match self {
            Self::Gap => "measure what is missing, or leave out the row",
            Self::NoNumber(_) => {
                "write numbers such as -0.25, or -0,25 where semicolons or tabs stand between the columns"
            }
            Self::TwoDecimalSigns { .. } => {
                "write either decimal points or decimal commas in all columns, and no separators of thousands"
            }
        }
    }
}

impl Separated {
    /// Returns the way that the line of titles shows: the first of semicolon, tab and comma that it holds.
    #[must_use]
    pub fn of(titles: &str) -> Self {
        let separator = [';', '\t', ','].into_iter().find(|sign| titles.contains(*sign));
        Self {
            separator: separator.unwrap_or(','),
            decimal: None,
        }
    }

    /// Returns the cells of a line, without the spaces around them.
    pub fn cells<'l>(&self, line: &'l str) -> impl Iterator<Item = &'l str> + use<'l> {
        line.split(self.separator).map(str::trim)
    }

    /// Returns why a line has more cells than the titles, if it has; empty cells at its end do not count.
    #[must_use]
    pub fn surplus(&self, line: &str, titles: usize) -> Option<String> {
        let filled = self.cells(line).enumerate().filter(|(_, cell)| !cell.is_empty());
        let cells = filled.last().map_or(0, |(index, _)| index + 1);
        (cells > titles).then(|| {
            let decimal = match self.separator {
                ',' => "; where commas stand between columns, decimals are written with points",
                _ => "",
            };
            format!("there are {cells} cells under {titles} titles{decimal}")
        })
    }

    /// Returns the number in a cell.
    ///
    /// # Errors
    /// There is none.
    pub fn number(&mut self, cell: &str) -> Result<f64, CellError> {
        let cell = cell.trim();
        let gaps = ["", "nan", "na", "n/a", "null"];
        if gaps.iter().any(|gap| cell.eq_ignore_ascii_case(gap)) {
            return Err(CellError::Gap);
        }
        let no_number = || CellError::NoNumber(shortened(cell));
        let own = match (
            cell.contains('.'),
            self.separator != ',' && cell.matches(',').count() == 1,
        ) {
            (true, false) => Some('.'),
            (false, true) => Some(','),
            (false, false) => None,
            (true, true) => return Err(no_number()),
        };
        let number = match own {
            Some(',') => cell.replace(',', ".").parse(),
            _ => cell.parse(),
        };
        let number = number
            .ok()
            .filter(|number: &f64| number.is_finite())
            .ok_or_else(no_number)?;
        if let Some(own) = own {
            let before = *self.decimal.get_or_insert(own);
            if before != own {
                return Err(CellError::TwoDecimalSigns {
                    cell: shortened(cell),
                    own,
                    before,
                });
            }
        }
        Ok(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_decimal_commas_are_read_where_commas_separate_nothing() {
        for (titles, cell, number) in [
            ("a;b", "1,5", Ok(1.5)),
            ("a\tb", "-1,5e-3", Ok(-1.5e-3)),
            ("a;b", "7", Ok(7.0)),
            ("a,b", "1.5", Ok(1.5)),
            ("a;b", "1.234,5", Err(CellError::NoNumber("1.234,5".to_owned()))),
            ("a;b", "1,234,5", Err(CellError::NoNumber("1,234,5".to_owned()))),
            ("a;b", "inf", Err(CellError::NoNumber("inf".to_owned()))),
            ("a;b", " NaN ", Err(CellError::Gap)),
        ] {
            assert_eq!(Separated::of(titles).number(cell), number, "{titles} {cell}");
        }
    }

    #[test]
    fn issue_048_decimal_commas_between_commas_are_noticed() {
        let table = Separated::of("a, b");
        assert_eq!(table.surplus("1, 2, , ", 2), None);
        let found = table.surplus("0,0,0,314", 2).unwrap_or_default();
        assert!(
            found.contains("4 cells under 2 titles") && found.contains("points"),
            "{found}"
        );
    }
}
