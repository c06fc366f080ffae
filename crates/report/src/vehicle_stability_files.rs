//! The files of `wedgelab stability` of a vehicle on a track: its vibrations over the speed as CSV, JSON and
//! figure.

use std::f64::consts::PI;
use std::io::{self, Write};

use drawing::Figure;
use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::stability::NamedMode;
use study::vehicle::stability::VehicleStability;

use crate::csv::rounded;
use crate::output_table::OutputTable;
use crate::stability_files::{FIGURE, NUMBERS, PICTURE, TABLE, roots};
use crate::summary::write_json;

/// All of them.
pub const NAMES: [&str; 4] = [TABLE, NUMBERS, FIGURE, PICTURE];
/// The schema of [`NUMBERS`].
pub const SCHEMA: &str = "wedgelab.vehicle_stability/1";

/// Writes all vibrations: speed, growth, frequency, damping ratio.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &VehicleStability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let all = found.speeds.iter().zip(&found.vibrations);
    let rows = all.flat_map(|(speed, own)| own.iter().map(move |own| (*speed, *own)));
    let mut table = OutputTable::new(rows, units);
    table.rounded("speed", Kind::TravelSpeed, |(speed, _)| *speed);
    table.number("growth_per_s", Kind::Count, |(_, own)| own.growth);
    table.number("frequency_hz", Kind::Count, |(_, own)| own.frequency / (2.0 * PI));
    table.number("damping_ratio", Kind::Count, |(_, own)| own.damping_ratio());
    table.write_csv(out)
}

#[derive(Serialize)]
struct Document<'d> {
    schema: &'static str,
    name: &'d str,
    complete: bool,
    verdict: String,
    speed_unit: &'static str,
    speeds: Vec<f64>,
    critical_speed: Option<f64>,
    critical_frequency_hz: Option<f64>,
    /// True if it grows at the lowest speed already.
    at_lowest: bool,
    largest_growth_per_s: Vec<Option<f64>>,
    about: &'static str,
}

/// Writes the critical speed, and the largest growth at each speed.
///
/// # Errors
/// The writer's.
pub fn write_numbers(
    name: &str,
    found: &VehicleStability,
    units: Units,
    out: &mut dyn Write,
) -> io::Result<()> {
    let speed = |si: f64| rounded(si * Kind::TravelSpeed.from_si(units));
    let document = Document {
        schema: SCHEMA,
        name,
        complete: found.vibrations.len() == found.speeds.len(),
        verdict: found.verdict(units),
        speed_unit: Kind::TravelSpeed.label(units),
        speeds: found.speeds.iter().map(|own| speed(*own)).collect(),
        critical_speed: found.critical.map(|own| speed(own.speed)),
        critical_frequency_hz: found.critical.map(|own| own.frequency),
        at_lowest: found.critical.is_some_and(|own| own.at_lowest),
        largest_growth_per_s: found
            .vibrations
            .iter()
            .map(|own| own.first().map(|own| own.growth))
            .collect(),
        about: "Vibrations of 0.05 to 30 Hz about steady rolling on straight perfect track from the \
                equilibrium, friction stuck: bristles are springs.",
    };
    write_json(&document, out)
}

/// Returns the figure: the root locus over the speed.
#[must_use]
pub fn figure(name: &str, found: &VehicleStability, units: Units) -> Figure {
    let speed = |own: Option<&f64>| own.copied().unwrap_or_default() * Kind::TravelSpeed.from_si(units);
    let title = format!(
        "friction stuck, {:.0} to {:.0} {}",
        speed(found.speeds.first()),
        speed(found.speeds.last()),
        Kind::TravelSpeed.label(units)
    );
    let modes = found.vibrations.iter().map(|own| {
        let named = own.iter().map(|own| NamedMode {
            growth: own.growth,
            frequency: own.frequency / (2.0 * PI),
            name: String::new(),
        });
        named.collect()
    });
    Figure::new(
        format!("{name}: linear stability"),
        "Growth and frequency of the vibrations about steady rolling that grow most, from the lowest to the \
         highest speed, each named by its frequency there; positive growth is hunting.",
        vec![roots(title, &modes.collect::<Vec<_>>())],
    )
}
