//! The files of `wedgelab stability --vary`: vibrations of a car over a parameter of its case, as CSV and
//! figure.

use std::io::{self, Write};

use quantity::{Kind, Number, System as Units};
use study::car::locus::{Locus, LocusBranch};

use crate::csv::{RowWriter, rounded};
use crate::drawing::{Figure, Panel, PlotCurve, distinct};
use crate::stability_files::{roots, write_mode};

/// The table of vibrations: the root locus over the parameter.
pub const TABLE: &str = "locus.csv";
/// The figure.
pub const FIGURE: &str = "locus.svg";
/// The same as a picture.
pub const PICTURE: &str = "locus.png";
/// All of them.
pub const NAMES: [&str; 3] = [TABLE, FIGURE, PICTURE];

/// Writes all vibrations: the key, its value and unit as typed, friction, growth, frequency, damping ratio,
/// what moves.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &Locus, out: &mut dyn Write) -> io::Result<()> {
    let mut table = RowWriter::new(out);
    table
        .texts([
            "parameter",
            "value",
            "unit",
            "friction",
            "growth_per_s",
            "frequency_hz",
            "damping_ratio",
            "motion",
        ])
        .end()?;
    for branch in &found.branches {
        for (value, modes) in found.values.iter().zip(&branch.modes) {
            for mode in modes {
                table.text(&found.key).plain(*value).text(&found.unit);
                table.text(branch.kind.name());
                write_mode(&mut table, mode)?;
            }
        }
    }
    Ok(())
}

/// Returns the figure: the root locus with friction stuck and absent, one curve a vibration, and the growth
/// of the vibration that grows most over the value.
#[must_use]
pub fn figure(case: &str, found: &Locus, units: Units) -> Figure {
    let [stuck, absent] = &found.branches;
    let title = |letter: &str, own: &LocusBranch| format!("{letter} root locus, {}", own.kind.words());
    let speed = Number(rounded(found.speed * Kind::TravelSpeed.from_si(units)));
    let speed = format!("{speed} {}", Kind::TravelSpeed.label(units));
    Figure {
        title: format!("{case}: vibrations over {} at {speed}", found.key),
        caption: "(a), (b) Growth and frequency of the vibrations about steady running that grow most, from \
                  the first to the last value, each named by its frequency there; positive growth is \
                  hunting. (c) Growth of the vibration that grows most."
            .to_owned(),
        panels: vec![
            roots(title("(a)", stuck), &stuck.modes),
            roots(title("(b)", absent), &absent.modes),
            Panel {
                title: "(c) largest growth".to_owned(),
                x_label: labelled(&found.key, &found.unit),
                y_label: "growth (1/s)".to_owned(),
                curves: vec![largest(stuck, found, 6), largest(absent, found, 7)],
                ..Panel::default()
            },
        ],
        ..Figure::default()
    }
}

/// Returns a name with its unit, if it has one.
fn labelled(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} ({unit})"),
    }
}

/// Returns growth over the value of the vibration that grows most, in this style of [`distinct`].
fn largest(branch: &LocusBranch, found: &Locus, style: usize) -> PlotCurve {
    let (colour, line) = distinct(style);
    let growth = |number| branch.most(number).map_or(f64::NAN, |own| own.growth);
    let points = found.values.iter().enumerate();
    PlotCurve {
        label: branch.kind.words().to_owned(),
        colour,
        line,
        points: points.map(|(number, value)| (*value, growth(number))).collect(),
    }
}
