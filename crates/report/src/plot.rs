//! A figure of any columns of a table against another, or of the power spectral density of one.

use std::io::{self, Write};

use study::signal::Spectrum;

use crate::figures::digits;
use crate::output_table::{Cell, Content, OutputTable};
use crate::overlay::{self, Axes};
use crate::table::{ResultTable, TableColumn, TableError};
use drawing::Figure;

/// Returns the figure of the columns `ys` over the column `x`, in the table's units; one panel a unit.
///
/// # Errors
/// One of the columns is not in the table.
pub fn figure(table: &ResultTable, label: &str, x: &str, ys: &[String]) -> Result<Figure, TableError> {
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

/// Returns the unit of a power spectral density of values in a unit.
#[must_use]
pub fn density_unit(unit: &str) -> String {
    match unit {
        "" => "1/Hz".to_owned(),
        unit if unit.contains(['·', '/', '^', ' ']) => format!("({unit})²/Hz"),
        unit => format!("{unit}²/Hz"),
    }
}

/// Returns the power spectral density of a column, in the column's units, in decibels over one unit.
#[must_use]
pub fn density_figure(table: &ResultTable, label: &str, column: &TableColumn, spectrum: &Spectrum) -> Figure {
    let words = overlay::words(&column.name);
    let unit = density_unit(column.kind.label(table.units));
    let pairs = spectrum.frequencies.iter().zip(&spectrum.density);
    // The mean was taken out: nothing stands at zero.
    let points = pairs
        .filter(|(frequency, density)| **frequency > 0.0 && **density > 0.0)
        .map(|(frequency, density)| (*frequency, 10.0 * libm::log10(*density)))
        .collect();
    let caption = format!(
        "One-sided power spectral density of {words} of the result {label}, in decibels over 1 {unit}, by \
         Welch's method: {} segments of {} rows that overlap by half, less their means, under Hann's window; \
         lines {} Hz apart.",
        spectrum.segments,
        spectrum.rows,
        digits(spectrum.resolution()),
    );
    let axes = Axes {
        x_label: "frequency (Hz)".to_owned(),
        y_label: format!("power spectral density (dB re 1 {unit})"),
        curves: vec![(words, points)],
    };
    overlay::figure(label.to_owned(), caption, vec![axes])
}

/// Writes a power spectral density as CSV: `frequency_Hz`, and the density under the column's name with the
/// square of its unit per Hz, such as `wedge_z_psd_in_squared_per_Hz`.
///
/// # Errors
/// The writer's.
pub fn write_density(
    table: &ResultTable,
    column: &TableColumn,
    spectrum: &Spectrum,
    out: &mut dyn Write,
) -> io::Result<()> {
    let unit = match column.kind.suffix(table.units) {
        "" => "1".to_owned(),
        suffix => format!("{suffix}_squared"),
    };
    let rows = spectrum.frequencies.iter().zip(&spectrum.density);
    let name = format!("{}_psd_{unit}_per_Hz", column.name);
    let mut table = OutputTable::new(rows, table.units);
    table.column(["frequency_Hz", "", ""], Content::Number, |(own, _)| {
        Cell::Number(**own)
    });
    table.column([&name, "", ""], Content::Number, |(_, own)| Cell::Number(**own));
    table.write_csv(out)
}

/// Returns a column's name as the name of a file, without ending: of others' names only letters, digits, `_`
/// and `-` are kept.
#[must_use]
pub fn file_name(column: &str) -> String {
    let plain = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '-');
    let signs = column.chars();
    signs.map(|sign| if plain(sign) { sign } else { '_' }).collect()
}

/// Returns a kind's name without its article.
fn bare(name: &str) -> &str {
    name.split_once(' ').map_or(name, |(_, bare)| bare)
}
