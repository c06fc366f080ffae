//! The files of a comparison by sections: both tables, and a figure for each column.

use std::io::{self, Write};

use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use quantity::Kind;
use study::sections::SectionQuantity;

use super::sections::{SectionComparison, SectionRow};
use super::{ComparedResult, free_name};
use crate::output_table::{Cell, Content, OutputTable};
use crate::overlay;
use crate::plot;

/// The table with the values of each section.
pub const SECTIONS: &str = "sections.csv";
/// The table of the differences over all sections.
pub const STATISTICS: &str = "section_statistics.csv";

impl SectionComparison {
    fn table<'t, R>(
        &self,
        entries: &'t [ComparedResult],
        rows: impl IntoIterator<Item = R>,
        of: impl Fn(&R) -> &SectionRow + Copy + 't,
    ) -> OutputTable<'t, R> {
        let label = |index: usize| match entries.get(index) {
            Some(entry) => Cell::Text(entry.label.clone().into()),
            None => Cell::Missing,
        };
        let mut table = OutputTable::new(rows, self.units);
        table.text("column", move |own| of(own).column.as_str());
        table.text("unit", move |own| of(own).unit);
        table.text("quantity", move |own| of(own).quantity.name());
        table.column(["result", "", ""], Content::Text, move |own| {
            label(of(own).result)
        });
        table.column(["compared_with", "", ""], Content::Text, move |_| label(0));
        table
    }

    /// Writes the values of each section.
    ///
    /// # Errors
    /// The writer's.
    pub fn write_sections(&self, entries: &[ComparedResult], out: &mut dyn Write) -> io::Result<()> {
        let rows = self
            .rows
            .iter()
            .flat_map(|own| (0..own.values.len()).map(move |section| (own, section)));
        let mut table = self.table(entries, rows, |(own, _)| *own);
        table.number("section", Kind::Count, |(_, section)| (section + 1) as f64);
        for (place, name) in ["from", "to"].into_iter().enumerate() {
            table.rounded(name, self.along.kind(), move |(_, section)| {
                self.sections[*section][place]
            });
        }
        table.number("value_of_compared_with", Kind::Count, |(own, section)| {
            own.values[*section][0]
        });
        table.number("value", Kind::Count, |(own, section)| own.values[*section][1]);
        table.number("difference", Kind::Count, |(own, section)| {
            own.values[*section][1] - own.values[*section][0]
        });
        table.write_csv(out)
    }

    /// Writes the statistics of the differences.
    ///
    /// # Errors
    /// The writer's.
    pub fn write_statistics(&self, entries: &[ComparedResult], out: &mut dyn Write) -> io::Result<()> {
        let mut table = self.table(entries, &self.rows, |own| *own);
        let percent =
            |own: &SectionRow, place: usize| own.differences.percent().map_or(f64::NAN, |p| p[place]);
        table.number("sections", Kind::Count, |own| own.differences.sections as f64);
        table.number("mean_size_of_compared_with", Kind::Count, |own| {
            own.differences.measured
        });
        table.number("mean_difference", Kind::Count, |own| own.differences.mean);
        table.number("mean_percent", Kind::Count, move |own| percent(own, 0));
        table.number("standard_deviation", Kind::Count, |own| own.differences.deviation);
        table.number("standard_deviation_percent", Kind::Count, move |own| {
            percent(own, 1)
        });
        table.number("limit_of_standard_deviation", Kind::Count, |own| {
            own.verdict.map_or(f64::NAN, |(limit, _)| limit)
        });
        table.text("verdict", |own| own.verdict.map_or("", |(_, own)| own.words()));
        table.write_csv(out)
    }

    /// Returns the figures with their file names: one a column, with the values of all results over those of
    /// the first one, a panel a quantity.
    #[must_use]
    pub fn figures(&self, entries: &[ComparedResult]) -> Vec<(String, Figure)> {
        let mut figures: Vec<(String, Figure)> = Vec::new();
        let mut columns: Vec<&str> = self.rows.iter().map(|own| own.column.as_str()).collect();
        columns.dedup();
        for name in columns {
            let own: Vec<&SectionRow> = self.rows.iter().filter(|own| own.column == name).collect();
            let panels = SectionQuantity::ALL.map(|quantity| panel(entries, &own, quantity));
            let words = overlay::words(name);
            let caption = format!(
                "Mean, larger of the 0.15 % and 99.85 % percentiles in size, and rms about the mean of \
                 {words} in {} sections. Each cross is a section: the value of the result over that of {}. \
                 On the line both are equal.",
                self.sections.len(),
                entries.first().map_or("the first", |first| first.label.as_str()),
            );
            let file = free_name(format!("sections_{}.svg", plot::file_name(name)), &figures);
            figures.push((file, Figure::new(format!("Sections: {words}"), caption, panels)));
        }
        figures
    }
}

/// Returns the panel of a quantity of a column.
fn panel(entries: &[ComparedResult], rows: &[&SectionRow], quantity: SectionQuantity) -> Panel {
    let label = |index: usize| entries.get(index).map_or("", |entry| entry.label.as_str());
    let own: Vec<&&SectionRow> = rows.iter().filter(|own| own.quantity == quantity).collect();
    let values = own.iter().flat_map(|own| own.values.iter().flatten());
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(*value), high.max(*value)]
    });
    // Values that are all equal are still drawn in the middle of a line.
    let spread = if high > low {
        high - low
    } else {
        low.abs().max(1.0)
    };
    let (low, high) = (low - 0.05 * spread, high + 0.05 * spread);
    let mut curves = vec![PlotCurve::new(
        "equal",
        (Colour::Grey, Line::Dashed),
        [(low, low), (high, high)],
    )];
    for own in &own {
        let (colour, _) = distinct(own.result - 1);
        let crosses = own
            .values
            .iter()
            .flat_map(|[x, y]| cross((*x, *y), 0.01 * (high - low)));
        curves.push(PlotCurve::new(label(own.result), (colour, Line::Solid), crosses));
    }
    let unit = own.first().map_or("", |own| own.unit);
    let unit = if unit.is_empty() {
        String::new()
    } else {
        format!(" ({unit})")
    };
    let x_label = format!("{}{unit}", label(0));
    Panel::new(quantity.name(), x_label, format!("result{unit}"), curves)
}

/// Returns the two strokes of a cross, with a gap behind each.
fn cross((x, y): (f64, f64), half: f64) -> [(f64, f64); 6] {
    const GAP: (f64, f64) = (f64::NAN, f64::NAN);
    [
        (x - half, y),
        (x + half, y),
        GAP,
        (x, y - half),
        (x, y + half),
        GAP,
    ]
}
