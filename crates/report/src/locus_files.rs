//! The files of `wedgelab stability --vary`: vibrations of a car over a parameter of its case, as CSV and
//! figure.

use std::io::{self, Write};

use quantity::{Kind, Number, System as Units};
use study::car::locus::{Locus, LocusBranch};

use crate::csv::{RowWriter, rounded};
use crate::drawing::{Figure, Panel, PlotCurve, distinct};
use crate::stability_files::{DRAWN, FASTEST, write_mode};

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

/// Returns the figure: the root locus with friction stuck and absent, one curve a value, and the growth of
/// the vibration that grows most over the value.
#[must_use]
pub fn figure(case: &str, found: &Locus, units: Units) -> Figure {
    let [stuck, absent] = &found.branches;
    let speed = Number(rounded(found.speed * Kind::TravelSpeed.from_si(units)));
    let speed = format!("{speed} {}", Kind::TravelSpeed.label(units));
    Figure {
        title: format!("{case}: vibrations over {} at {speed}", found.key),
        caption:
            "(a), (b) Growth and frequency of vibrations about steady running, one curve a value: positive \
                  growth is hunting. (c) Growth of the vibration that grows most."
                .to_owned(),
        panels: vec![
            roots("(a)", stuck, found),
            roots("(b)", absent, found),
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

/// Returns growth and frequency of the slow vibrations of first, middle and last value, a curve a value.
fn roots(letter: &str, branch: &LocusBranch, found: &Locus) -> Panel {
    let last = found.values.len().saturating_sub(1);
    let mut shown = vec![0, last / 2, last];
    shown.dedup();
    let own = shown
        .into_iter()
        .filter_map(|number| Some((found.values.get(number)?, branch.modes.get(number)?)));
    let curves = own.enumerate().map(|(place, (value, modes))| {
        let (colour, line) = distinct(place);
        let slow = modes
            .iter()
            .filter(|mode| mode.growth > DRAWN && mode.frequency < FASTEST);
        let mut points: Vec<(f64, f64)> = slow.map(|mode| (mode.growth, mode.frequency)).collect();
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        PlotCurve {
            label: format!("{} {}", Number(rounded(*value)), found.unit)
                .trim_end()
                .to_owned(),
            colour,
            line,
            points,
        }
    });
    Panel {
        title: format!("{letter} root locus, {}", branch.kind.words()),
        x_label: "growth (1/s)".to_owned(),
        y_label: "frequency (Hz)".to_owned(),
        curves: curves.collect(),
        ..Panel::default()
    }
}
