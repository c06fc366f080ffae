//! The files of `wedgelab stability`: vibrations of a car over speed, as CSV, JSON and figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::CarCase;
use study::car::stability::{Branch, FRICTION, Mode, Stability, left_out};

use crate::csv::{RowWriter, rounded};
use crate::drawing::{Figure, Panel, PlotCurve, distinct};
use crate::figures::axis;
use crate::summary::write_json;

/// The table.
pub const TABLE: &str = "stability.csv";
/// Critical speeds.
pub const NUMBERS: &str = "stability.json";
/// The figure.
pub const FIGURE: &str = "stability.svg";
/// The same as a picture.
pub const PICTURE: &str = "stability.png";
/// All of them.
pub const NAMES: [&str; 4] = [TABLE, NUMBERS, FIGURE, PICTURE];
/// The schema of [`NUMBERS`].
pub const SCHEMA: &str = "wedgelab.car_stability/1";

/// Returns a branch's name.
fn name(branch: &Branch) -> &'static str {
    let found = FRICTION.iter().find(|(own, _)| *own == branch.friction);
    found.map_or("", |(_, name)| name)
}

/// Writes all vibrations: speed, friction, growth, frequency, damping ratio.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let mut table = RowWriter::new(out);
    table.text(&format!("speed_{}", Kind::TravelSpeed.suffix(units)));
    table
        .texts(["friction", "growth_per_s", "frequency_hz", "damping_ratio"])
        .end()?;
    for branch in &found.branches {
        for (speed, modes) in found.speeds.iter().zip(&branch.modes) {
            for mode in modes {
                let angular_frequency = 2.0 * std::f64::consts::PI * mode.frequency;
                let ratio = -mode.growth / libm::hypot(mode.growth, angular_frequency);
                table
                    .plain(speed * Kind::TravelSpeed.from_si(units))
                    .text(name(branch));
                table
                    .shown(mode.growth)
                    .shown(mode.frequency)
                    .shown(ratio)
                    .end()?;
            }
        }
    }
    Ok(())
}

#[derive(Serialize)]
struct Document<'d> {
    schema: &'static str,
    name: &'d str,
    complete: bool,
    speed_unit: &'static str,
    speeds: Vec<f64>,
    branches: Vec<BranchDocument>,
    about: &'static str,
    /// What of the case does not count.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<&'static str>,
}

#[derive(Serialize)]
struct BranchDocument {
    friction: &'static str,
    /// Lowest of the speeds from which on a vibration grows; none if none does.
    critical_speed: Option<f64>,
    critical_frequency_hz: Option<f64>,
    /// Of the vibration that grows most, at each speed.
    largest_growth_per_s: Vec<Option<f64>>,
    its_frequency_hz: Vec<Option<f64>>,
}

/// Writes critical speeds, and the vibration that grows most at each speed.
///
/// # Errors
/// The writer's.
pub fn write_numbers(case: &CarCase, found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let speed = |si: f64| rounded(si * Kind::TravelSpeed.from_si(units));
    let document = Document {
        schema: SCHEMA,
        name: &case.name,
        complete: found.complete,
        speed_unit: Kind::TravelSpeed.label(units),
        speeds: found.speeds.iter().map(|own| speed(*own)).collect(),
        branches: found
            .branches
            .iter()
            .map(|branch| BranchDocument {
                friction: name(branch),
                critical_speed: branch.critical.map(|own| speed(own.speed)),
                critical_frequency_hz: branch.critical.map(|own| own.frequency),
                largest_growth_per_s: first(branch, |mode| mode.growth),
                its_frequency_hz: first(branch, |mode| mode.frequency),
            })
            .collect(),
        about: "Vibrations of 0.05 to 30 Hz about steady running on straight track. Friction stuck: \
                bristles are springs; absent: no friction in wedges, plates, adapters, side bearings.",
        left_out: left_out(case),
    };
    write_json(&document, out)
}

fn first(branch: &Branch, of: impl Fn(&Mode) -> f64) -> Vec<Option<f64>> {
    branch.modes.iter().map(|modes| modes.first().map(&of)).collect()
}

/// Returns the figure: growth and frequency of the vibration that grows most, over speed.
#[must_use]
pub fn figure(case: &str, found: &Stability, units: Units) -> Figure {
    let panel = |title: &str, y: &str, of: fn(&Mode) -> f64| Panel {
        title: title.to_owned(),
        x_label: axis("speed", Kind::TravelSpeed, units),
        y_label: y.to_owned(),
        curves: found
            .branches
            .iter()
            .enumerate()
            .map(|(number, branch)| {
                let (colour, line) = distinct(number);
                let values = first(branch, of);
                let pairs = found.speeds.iter().zip(values);
                PlotCurve {
                    label: format!("friction {}", name(branch)),
                    colour,
                    line,
                    points: pairs
                        .filter_map(|(speed, value)| Some((speed * Kind::TravelSpeed.from_si(units), value?)))
                        .collect(),
                }
            })
            .collect(),
        ..Panel::default()
    };
    Figure {
        title: format!("{case}: linear stability"),
        caption: "The vibration that grows most about steady running on straight track: positive growth is \
                  hunting. Friction stuck: bristles are springs; absent: no friction in wedges, plates, \
                  adapters, side bearings."
            .to_owned(),
        panels: vec![
            panel("(a) growth", "growth (1/s)", |mode| mode.growth),
            panel("(b) frequency", "frequency (Hz)", |mode| mode.frequency),
        ],
        ..Figure::default()
    }
}
