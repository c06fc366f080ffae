//! The files of `wedgelab stability --vary`: vibrations of a car over a parameter of its case, as CSV and
//! figure.

use std::io::{self, Write};

use quantity::{Kind, Number, System as Units};
use study::locus::{Locus, LocusBranch};

use crate::csv::rounded;
use crate::output_table::OutputTable;
use crate::stability_files::{add_mode, roots};
use drawing::{Figure, Panel, PlotCurve, distinct};

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
    let modes = found.branches.iter().flat_map(|branch| {
        let modes = found.values.iter().zip(&branch.modes);
        modes.flat_map(move |(value, modes)| modes.iter().map(move |mode| (*value, branch.kind, mode)))
    });
    let mut table = OutputTable::new(modes, Units::Si);
    table.text("parameter", |_| &found.key);
    table.rounded("value", Kind::Count, |(value, ..)| *value);
    table.text("unit", |_| &found.unit);
    table.text("friction", |(_, kind, _)| kind.name());
    add_mode(&mut table, |(.., mode)| mode);
    table.write_csv(out)
}

/// Returns the figure: the root locus with friction stuck and absent, one curve a vibration, and the growth
/// of the vibration that grows most over the value.
#[must_use]
pub fn figure(case: &str, found: &Locus, units: Units) -> Figure {
    let [stuck, absent] = &found.branches;
    let title = |letter: &str, own: &LocusBranch| format!("{letter} root locus, {}", own.kind.words());
    let speed = Number(rounded(found.speed * Kind::TravelSpeed.from_si(units)));
    let speed = format!("{speed} {}", Kind::TravelSpeed.label(units));
    Figure::new(
        format!("{case}: vibrations over {} at {speed}", found.key),
        "(a), (b) Growth and frequency of the vibrations about steady running that grow most, from \
                  the first to the last value, each named by its frequency there; positive growth is \
                  hunting. (c) Growth of the vibration that grows most.",
        [
            roots(title("(a)", stuck), &stuck.modes),
            roots(title("(b)", absent), &absent.modes),
            Panel::new(
                "(c) largest growth",
                labelled(&found.key, &found.unit),
                "growth (1/s)",
                [largest(stuck, found, 6), largest(absent, found, 7)],
            ),
        ],
    )
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
    let growth = |number| branch.most(number).map_or(f64::NAN, |own| own.growth);
    let points = found.values.iter().enumerate();
    PlotCurve::new(
        branch.kind.words(),
        distinct(style),
        points.map(|(number, value)| (*value, growth(number))),
    )
}
