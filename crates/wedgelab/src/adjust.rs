//! Adjustments of tables of results before they are used: a span of time, other names of columns.

use clap::Args;
use quantity::{Kind, Quantity};
use report::table::ResultTable;

use crate::failure::{Failure, Message};

/// Columns by other names.
#[derive(Debug, Args)]
pub struct Names {
    /// Column OTHER of a result counts as NAME; for several, repeat it
    #[arg(long, value_name = "NAME=OTHER", num_args = 1..)]
    map: Vec<String>,
}

impl Names {
    /// Renames columns in these tables.
    ///
    /// # Errors
    /// A pair is not understood, no table has the column, or the one that has it has NAME too.
    pub fn apply<'t>(&self, tables: impl IntoIterator<Item = &'t mut ResultTable>) -> Result<(), Failure> {
        let mut tables: Vec<&mut ResultTable> = tables.into_iter().collect();
        for pair in &self.map {
            let parts = pair
                .split_once('=')
                .map(|(name, other)| (name.trim(), other.trim()));
            let Some((name, other)) = parts.filter(|(name, other)| !name.is_empty() && !other.is_empty())
            else {
                let message = format!("--map {pair}: two names with `=` between them are expected");
                return Err(Message::new(message, "write --map wedge_z=uplift").into());
            };
            let mut found = false;
            for table in tables.iter_mut().filter(|table| table.find(other).is_some()) {
                found = true;
                if table.find(name).is_some() {
                    let message = format!("--map {pair}: `{}` has both columns", table.file.display());
                    return Err(Message::new(message, format!("leave the pair out: {name} is there")).into());
                }
                table.rename(other, name);
            }
            if let (false, Some(last)) = (found, tables.last()) {
                // Says which names are near.
                last.column(other)?;
            }
        }
        Ok(())
    }
}

/// A span of time.
#[derive(Debug, Args)]
pub struct TimeSpan {
    /// Leave out the values before this time, s
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    from: Option<f64>,
    /// Leave out the values after this time, s
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    to: Option<f64>,
}

impl TimeSpan {
    /// Leaves out the rows beyond the span.
    ///
    /// # Errors
    /// Fewer than two rows are left.
    pub fn apply(&self, table: &mut ResultTable) -> Result<(), Failure> {
        keep(table, self.from, self.to)
    }
}

/// A time in seconds: a number, or with its unit.
pub fn seconds(text: &str) -> Result<f64, String> {
    let seconds = match text.trim().parse() {
        Ok(number) => number,
        Err(_) => Quantity::parse_as(text, Kind::Time)
            .map_err(|error| error.to_string())?
            .to_si(),
    };
    match seconds.is_finite() {
        true => Ok(seconds),
        false => Err("a time is expected, for example 2, \"2 s\" or \"200 ms\"".to_owned()),
    }
}

/// Keeps the rows from one time to another (s), as far as they are given.
///
/// # Errors
/// Fewer than two rows are left.
pub fn keep(table: &mut ResultTable, from: Option<f64>, to: Option<f64>) -> Result<(), Failure> {
    if from.is_none() && to.is_none() {
        return Ok(());
    }
    let ends = [table.times().first(), table.times().last()].map(|time| time.copied().unwrap_or(0.0));
    let (from, to) = (from.unwrap_or(f64::NEG_INFINITY), to.unwrap_or(f64::INFINITY));
    if table.keep(from, to) >= 2 {
        return Ok(());
    }
    let message = format!(
        "`{}` has not two rows from {} s to {} s",
        table.file.display(),
        from.max(ends[0]),
        to.min(ends[1])
    );
    let advice = format!(
        "it goes from {} s to {} s: change --from or --to",
        ends[0], ends[1]
    );
    Err(Message::new(message, advice).into())
}
