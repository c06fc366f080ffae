//! The files of `wedgelab wheelrail stability`: the least damped vibration of a wheelset over speed, as CSV
//! and figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use study::wheelset::stability::WheelsetStability;
use study::wheelset::summary::Hunting;

use crate::figures::axis;
use crate::output_table::OutputTable;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "stability.csv";
/// The figure.
pub const FIGURE: &str = "stability.svg";
/// The same as a picture.
pub const PICTURE: &str = "stability.png";
/// All of them.
pub const NAMES: [&str; 3] = [TABLE, FIGURE, PICTURE];

/// Writes the vibration at each speed; empty cells: there is none.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &WheelsetStability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let rows = found.speeds.iter().zip(&found.vibrations);
    let mut table = OutputTable::new(rows, units);
    table.rounded("speed", Kind::TravelSpeed, |(speed, _)| **speed);
    let value = |own: &Option<Hunting>, of: fn(&Hunting) -> f64| own.as_ref().map_or(f64::NAN, of);
    table.number("growth_per_s", Kind::Count, move |(_, own)| {
        value(own, |own| own.growth_per_s)
    });
    table.number("frequency_hz", Kind::Count, move |(_, own)| {
        value(own, |own| own.frequency_hz)
    });
    table.number("damping_ratio", Kind::Count, move |(_, own)| {
        value(own, |own| own.damping_ratio)
    });
    table.write_csv(out)
}

/// Returns the figure: growth and frequency over speed.
#[must_use]
pub fn figure(title: &str, found: &WheelsetStability, units: Units) -> Figure {
    let panel = |title: &str, y_label: &str, of: fn(&Hunting) -> f64| {
        let points = found.speeds.iter().zip(&found.vibrations);
        let points = points
            .filter_map(|(speed, own)| Some((speed * Kind::TravelSpeed.from_si(units), of(own.as_ref()?))));
        Panel::new(
            title,
            axis("speed", Kind::TravelSpeed, units),
            y_label,
            [PlotCurve::new("", (Colour::Blue, Line::Solid), points)],
        )
    };
    Figure::new(
        format!("a wheelset, {title}: linear stability"),
        "The least damped lateral vibration about steady rolling on straight perfect track; \
                  positive growth is hunting.",
        [
            panel("(a) growth", "growth (1/s)", |own| own.growth_per_s),
            panel("(b) frequency", "frequency (Hz)", |own| own.frequency_hz),
        ],
    )
}
