//! Tables that are written: each column is described once, with its name, unit, meaning and its cell of a
//! row, and all files (CSV, Parquet, MAT-file) are made of this description.

use std::borrow::Cow;
use std::io::{self, Write};

use mechanics::output::Column;
use quantity::{Kind, System as Units};
use serde::Serialize;

use crate::csv::{self, rounded};
use crate::mat5;
use crate::parquet::{Storage, TableWriter, plain};

/// The contents of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// Whole numbers.
    Integer,
    /// Numbers; may be missing.
    Number,
    /// Texts; may be missing.
    Text,
}

/// The description of a column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Description {
    /// Its name, with the unit.
    pub name: String,
    /// Its unit, such as `lbf·in`; empty for pure numbers and texts.
    pub unit: String,
    /// The kind of quantity; a count, where it is none.
    #[serde(skip)]
    pub kind: Kind,
    /// The description, a few words.
    pub text: String,
    /// Its values.
    pub content: Content,
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell<'c> {
    /// A whole number.
    Integer(i64),
    /// A number; in texts with an exponent where that is shorter.
    Number(f64),
    /// A number; in texts without an exponent, and missing if it is infinite.
    Decimal(f64),
    /// A text.
    Text(Cow<'c, str>),
    /// Nothing.
    Missing,
}

impl<'c> From<&'c str> for Cell<'c> {
    /// Returns the text, or nothing if it is empty.
    fn from(text: &'c str) -> Self {
        match text {
            "" => Self::Missing,
            text => Self::Text(Cow::Borrowed(text)),
        }
    }
}

/// The cell of a column in a row.
type Reader<'t, R> = Box<dyn for<'r> Fn(&'r R) -> Cell<'r> + 't>;

/// A table with rows of type `R`.
pub struct OutputTable<'t, R> {
    rows: Vec<R>,
    units: Units,
    descriptions: Vec<Description>,
    readers: Vec<Reader<'t, R>>,
}

/// The table of a run; its rows are numbers of output times.
pub type RunTable<'t> = OutputTable<'t, usize>;

impl<'t> RunTable<'t> {
    /// Returns the table of columns of a run with their values (SI).
    ///
    /// # Errors
    /// The columns differ in length.
    pub fn of_run(
        columns: impl IntoIterator<Item = (&'t Column, &'t Vec<f64>)>,
        units: Units,
    ) -> io::Result<Self> {
        let columns: Vec<_> = columns.into_iter().collect();
        let rows = columns.first().map_or(0, |(_, values)| values.len());
        if columns.iter().any(|(_, values)| values.len() != rows) {
            return Err(io::Error::other("the columns of the result differ in length"));
        }
        let mut table = Self::new(0..rows, units);
        for (column, values) in columns {
            table.quantity([&column.name, &column.text], column.kind, move |row, factor| {
                Cell::Number(values[*row] * factor)
            });
        }
        Ok(table)
    }
}

impl<'t, R> OutputTable<'t, R> {
    /// Returns a table without columns.
    pub fn new(rows: impl IntoIterator<Item = R>, units: Units) -> Self {
        Self {
            rows: rows.into_iter().collect(),
            units,
            descriptions: Vec::new(),
            readers: Vec::new(),
        }
    }

    /// Adds a column.
    pub fn add(&mut self, description: Description, of: impl for<'r> Fn(&'r R) -> Cell<'r> + 't) {
        self.descriptions.push(description);
        self.readers.push(Box::new(of));
    }

    /// Adds a column of no kind, given by its full name, unit and meaning.
    pub fn column(
        &mut self,
        about: [&str; 3],
        content: Content,
        of: impl for<'r> Fn(&'r R) -> Cell<'r> + 't,
    ) {
        let [name, unit, text] = about.map(str::to_owned);
        let kind = Kind::Count;
        self.add(
            Description {
                name,
                unit,
                kind,
                text,
                content,
            },
            of,
        );
    }

    /// Adds a column of a kind, given by its name without the unit and its meaning; `of` also takes the
    /// factor that converts an SI value.
    pub fn quantity(
        &mut self,
        [name, text]: [&str; 2],
        kind: Kind,
        of: impl for<'r> Fn(&'r R, f64) -> Cell<'r> + 't,
    ) {
        let description = Description {
            name: match kind.suffix(self.units) {
                "" => name.to_owned(),
                suffix => format!("{name}_{suffix}"),
            },
            unit: kind.label(self.units).to_owned(),
            kind,
            text: text.to_owned(),
            content: Content::Number,
        };
        let factor = kind.from_si(self.units);
        self.add(description, move |row| of(row, factor));
    }

    /// Adds a column of texts; an empty one is missing.
    pub fn text(&mut self, name: &str, of: impl for<'r> Fn(&'r R) -> &'r str + 't) {
        self.column([name, "", ""], Content::Text, move |row| Cell::from(of(row)));
    }

    /// Adds a column of SI values, which are shown in the units of the table; one that is not finite is
    /// missing.
    pub fn number(&mut self, name: &str, kind: Kind, of: impl Fn(&R) -> f64 + 't) {
        self.quantity([name, ""], kind, move |row, factor| {
            Cell::Decimal(of(row) * factor)
        });
    }

    /// Adds a column of SI values, which are shown without the errors of a conversion: to twelve digits.
    pub fn rounded(&mut self, name: &str, kind: Kind, of: impl Fn(&R) -> f64 + 't) {
        self.quantity([name, ""], kind, move |row, factor| {
            Cell::Decimal(rounded(of(row) * factor))
        });
    }

    /// Returns the descriptions of the columns.
    #[must_use]
    pub fn descriptions(&self) -> &[Description] {
        &self.descriptions
    }

    /// Returns the cells of a row, which need not be one of the table's.
    pub fn cells<'r>(&'r self, row: &'r R) -> impl Iterator<Item = Cell<'r>> {
        self.readers.iter().map(move |of| of(row))
    }

    /// Writes the table as CSV.
    ///
    /// # Errors
    /// The writer's.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut lines = csv::Lines::new(&self.descriptions, out)?;
        self.rows.iter().try_for_each(|row| lines.row(self.cells(row)))
    }

    /// Writes the table as a Parquet file; `metadata` are further keys with their values.
    ///
    /// # Errors
    /// The writer's.
    pub fn write_parquet(
        &self,
        storage: Storage,
        metadata: (&str, String),
        out: &mut (dyn Write + Send),
    ) -> io::Result<()> {
        let columns = self.descriptions.clone();
        let mut table = TableWriter::new(out, columns, storage, &[metadata]).map_err(plain)?;
        for row in &self.rows {
            table.row(self.cells(row)).map_err(plain)?;
        }
        table.finish().map_err(plain)
    }

    /// Writes the columns of numbers as matrices of a MAT-file, and appends a line on each to `about`.
    ///
    /// # Errors
    /// The writer's.
    pub fn write_mat(&self, about: &mut String, out: &mut dyn Write) -> io::Result<()> {
        for (
            Description {
                name,
                unit,
                kind,
                text,
                ..
            },
            of,
        ) in self.descriptions.iter().zip(&self.readers)
        {
            let number = |row| match of(row) {
                Cell::Integer(value) => value as f64,
                Cell::Number(value) | Cell::Decimal(value) => value,
                Cell::Text(_) | Cell::Missing => f64::NAN,
            };
            let values: Vec<f64> = self.rows.iter().map(number).collect();
            mat5::matrix(name, &[&values], out)?;
            let unit = match kind {
                Kind::Count => String::new(),
                _ => format!(" ({unit})"),
            };
            about.push_str(&format!("{name}{unit}: {text}\n"));
        }
        Ok(())
    }
}
