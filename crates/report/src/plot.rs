//! A figure of any columns of a table against another.

use crate::drawing::Figure;
use crate::overlay::{self, Axes};
use crate::table::{Table, TableColumn, TableError};

/// The figure of the columns `ys` over the column `x`, in the table's units; one panel a unit.
///
/// # Errors
/// One of the columns is not in the table.
pub fn figure(table: &Table, label: &str, x: &str, ys: &[String]) -> Result<Figure, TableError> {
    let units = table.units;
    let abscissa = table.column(x)?;
    let columns = ys
        .iter()
        .map(|y| table.column(y))
        .collect::<Result<Vec<&TableColumn>, _>>()?;
    let mut panels: Vec<(&str, Vec<&TableColumn>)> = Vec::new();
    for column in columns {
        let unit = column.kind.label(units);
        match panels.iter_mut().find(|(other, _)| *other == unit) {
            Some((_, list)) => list.push(column),
            None => panels.push((unit, vec![column])),
        }
    }
    let points = |column: &TableColumn| {
        abscissa
            .written
            .iter()
            .copied()
            .zip(column.written.iter().copied())
            .collect()
    };
    let axes = panels.into_iter().map(|(unit, columns)| Axes {
        x_label: overlay::axis(abscissa, units),
        y_label: match columns.as_slice() {
            [one] => overlay::axis(one, units),
            _ if unit.is_empty() => "value".to_owned(),
            // The legend names them.
            several => format!("{} ({unit})", bare(several[0].kind.name())),
        },
        curves: columns
            .into_iter()
            .map(|column| (overlay::words(&column.name), points(column)))
            .collect(),
    });
    let names: Vec<String> = ys.iter().map(|y| overlay::words(y)).collect();
    let caption = format!(
        "{} of the result {label} over {}, all {} rows.",
        names.join(", "),
        overlay::words(&abscissa.name),
        abscissa.written.len()
    );
    Ok(overlay::figure(label.to_owned(), caption, axes.collect()))
}

/// A column's name as the name of a file, without ending: of others' names only letters, digits, `_` and `-`
/// are kept.
#[must_use]
pub fn file_name(column: &str) -> String {
    let plain = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '-');
    let signs = column.chars();
    signs.map(|sign| if plain(sign) { sign } else { '_' }).collect()
}

/// A kind's name without its article.
fn bare(name: &str) -> &str {
    name.split_once(' ').map_or(name, |(_, bare)| bare)
}
