//! Tables on the terminal.

use std::io::{self, Write};

/// A table: two lines of head (names and units), rows; the first column to the left, all others to the right.
#[derive(Debug)]
pub struct TerminalTable {
    rows: Vec<Vec<String>>,
    left: usize,
}

impl TerminalTable {
    /// Returns a table with the names and units of its columns; the first `left` ones are words.
    #[must_use]
    pub fn new(left: usize, head: &[(&str, &str)]) -> Self {
        let line = |of: fn(&(&str, &str)) -> String| head.iter().map(of).collect();
        Self {
            rows: vec![
                line(|(name, _)| (*name).to_owned()),
                line(|(_, unit)| (*unit).to_owned()),
            ],
            left,
        }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// Writes it.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in self
            .rows
            .iter()
            .filter(|row| row.iter().any(|cell| !cell.is_empty()))
        {
            let mut line = String::new();
            for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
                if column > 0 {
                    line.push_str("   ");
                }
                line.push_str(&if column < self.left {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                });
            }
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}
