//! The files of `wedgelab stability --nonlinear`: amplitudes of a car's hunting over ramps of its speed, as
//! CSV, JSON and figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::hunting::{Boundary, Hunting, Point, Ramp};
use study::car::stability::{BranchKind, Stability};

use crate::csv::rounded;
use crate::figures::axis;
use crate::output_table::OutputTable;
use crate::summary::write_json;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "hunting.csv";
/// Speeds at which hunting ends and begins.
pub const NUMBERS: &str = "hunting.json";
/// The figure.
pub const FIGURE: &str = "hunting.svg";
/// The same as a picture.
pub const PICTURE: &str = "hunting.png";
/// All of them.
pub const NAMES: [&str; 4] = [TABLE, NUMBERS, FIGURE, PICTURE];
/// The schema of [`NUMBERS`].
pub const SCHEMA: &str = "wedgelab.car_hunting/1";

/// Returns the ramps with their names.
fn ramps(found: &Hunting) -> Vec<(&'static str, &Ramp)> {
    let mut own = vec![("falling", &found.falling)];
    own.extend(found.rising.as_ref().map(|ramp| ("rising", ramp)));
    own
}

/// Writes the amplitudes: ramp, time, speed, each wheelset's lateral amplitude, that of the body's lateral
/// acceleration.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &Hunting, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let ramps = ramps(found).into_iter();
    let points = ramps.flat_map(|(name, ramp)| ramp.points.iter().map(move |point| (name, point)));
    let mut table = OutputTable::new(points, units);
    table.text("ramp", |(name, _)| name);
    table.number("time", Kind::Time, |(_, point)| point.time);
    table.rounded("speed", Kind::TravelSpeed, |(_, point)| point.speed);
    for axle in 0..4 {
        let name = format!("axle_{}_lateral_amplitude", axle + 1);
        table.number(&name, Kind::Length, move |(_, point)| point.axles[axle]);
    }
    let name = "body_lateral_acceleration_amplitude";
    table.number(name, Kind::RideAcceleration, |(_, point)| point.acceleration);
    table.write_csv(out)
}

#[derive(Serialize)]
struct Document<'d> {
    schema: &'static str,
    name: &'d str,
    complete: bool,
    speed_unit: &'static str,
    speeds: [f64; 2],
    ramp_s: f64,
    length_unit: &'static str,
    threshold: f64,
    /// The speed at which hunting ends while the speed falls.
    falling: Outcome,
    /// The speed at which hunting begins while the speed rises.
    rising: Option<Outcome>,
    /// Critical speeds by linearization, by what friction does.
    linear_stuck: Option<f64>,
    linear_absent: Option<f64>,
    warnings: Vec<String>,
    about: &'static str,
}

#[derive(Serialize)]
struct Outcome {
    /// `at`, `everywhere`, `nowhere`, `derails_at`.
    hunting: &'static str,
    speed: Option<f64>,
    largest_amplitude: f64,
}

fn outcome(ramp: &Ramp, units: Units) -> Outcome {
    let (hunting, speed) = match ramp.boundary {
        Boundary::At(speed) => ("at", Some(speed)),
        Boundary::Everywhere => ("everywhere", None),
        Boundary::Nowhere => ("nowhere", None),
        Boundary::Derails(speed) => ("derails_at", Some(speed)),
    };
    let largest = ramp.points.iter().map(Point::amplitude).fold(0.0, f64::max);
    Outcome {
        hunting,
        speed: speed.map(|own| rounded(own * Kind::TravelSpeed.from_si(units))),
        largest_amplitude: largest * Kind::Length.from_si(units),
    }
}

/// Returns the critical speeds (m/s) by linearization, friction stuck and absent.
fn linear(stability: &Stability) -> [Option<f64>; 2] {
    [BranchKind::Stuck, BranchKind::Absent].map(|kind| {
        let own = stability.branches.iter().find(|own| own.kind == kind)?;
        own.critical.as_ref().map(|critical| critical.speed)
    })
}

/// Writes where hunting ends and begins, beside the critical speeds by linearization.
///
/// # Errors
/// The writer's.
pub fn write_numbers(
    case: &str,
    (found, stability): (&Hunting, &Stability),
    units: Units,
    out: &mut dyn Write,
) -> io::Result<()> {
    let speed = |si: f64| rounded(si * Kind::TravelSpeed.from_si(units));
    let [stuck, absent] = linear(stability);
    let warnings = ramps(found).into_iter().flat_map(|(name, ramp)| {
        let own = ramp.warnings.iter();
        own.map(move |warning| format!("{name} speed: {warning}"))
    });
    let document = Document {
        schema: SCHEMA,
        name: case,
        complete: found.complete,
        speed_unit: Kind::TravelSpeed.label(units),
        speeds: found.settings.speeds.map(speed),
        ramp_s: found.settings.ramp,
        length_unit: Kind::Length.label(units),
        threshold: rounded(found.settings.threshold * Kind::Length.from_si(units)),
        falling: outcome(&found.falling, units),
        rising: found.rising.as_ref().map(|ramp| outcome(ramp, units)),
        linear_stuck: stuck.map(speed),
        linear_absent: absent.map(speed),
        warnings: warnings.collect(),
        about: "Falling: the speed at which hunting dies after a lateral start at the highest speed. Rising: \
                the speed from which on small lateral dips of the rails grow into hunting. Amplitudes are \
                half of greatest less least lateral displacement of a wheelset within 1.5 s.",
    };
    write_json(&document, out)
}

/// Returns the figure: the largest lateral amplitude of the wheelsets, and the body's lateral acceleration,
/// over speed.
#[must_use]
pub fn figure(case: &str, found: &Hunting, stability: &Stability, units: Units) -> Figure {
    let speed = |si: f64| si * Kind::TravelSpeed.from_si(units);
    let panel = |title: &str, (name, kind): (&str, Kind), of: fn(&Point) -> f64| {
        let mut curves = Vec::new();
        let mut top = 0.0_f64;
        for (which, ramp) in ramps(found) {
            let (colour, line, label) = match which {
                "falling" => (Colour::Vermillion, Line::Solid, "speed falls: limit cycle"),
                _ => (Colour::Blue, Line::Dashed, "speed rises: from equilibrium"),
            };
            let points: Vec<(f64, f64)> = ramp
                .points
                .iter()
                .map(|point| (speed(point.speed), of(point) * kind.from_si(units)))
                .collect();
            top = points.iter().fold(top, |top, (_, value)| top.max(*value));
            curves.push(PlotCurve::new(label, (colour, line), points));
        }
        let marks = linear(stability).into_iter().zip([
            (
                "linear critical speed, friction stuck",
                Colour::Black,
                Line::DashDot,
            ),
            (
                "linear critical speed, friction absent",
                Colour::Grey,
                Line::Dotted,
            ),
        ]);
        let over_amplitude = stability.curve.iter().filter_map(|own| {
            let speed = own.critical.as_ref()?.speed;
            (speed <= found.settings.speeds[1]).then_some((speed, own.amplitude))
        });
        let over_amplitude: Vec<(f64, f64)> = over_amplitude
            .map(|(own, amplitude)| (speed(own), amplitude * Kind::Length.from_si(units)))
            .collect();
        if kind == Kind::Length && !over_amplitude.is_empty() {
            curves.push(PlotCurve::new(
                "equivalent linearization",
                (Colour::Green, Line::Dotted),
                over_amplitude,
            ));
        }
        // What grows at the lowest speed already has its critical speed below the figure.
        let lowest = stability.speeds.first().copied().unwrap_or_default();
        for (critical, (label, colour, line)) in marks {
            if let Some(critical) = critical.filter(|own| *own > lowest) {
                curves.push(PlotCurve::new(
                    label,
                    (colour, line),
                    [(speed(critical), 0.0), (speed(critical), top)],
                ));
            }
        }
        Panel::new(
            title,
            axis("speed", Kind::TravelSpeed, units),
            axis(name, kind, units),
            curves,
        )
    };
    Figure::new(
        format!("{case}: hunting over speed"),
        "Amplitudes within 1.5 s. Speed falls: from a lateral start at the highest speed. Speed \
                  rises: over lateral dips of the rails of 0.02 in every 200 ft. Where the curves differ the \
                  car runs quietly or hunts, after what disturbed it.",
        [
            panel(
                "(a) wheelsets, the largest",
                ("lateral amplitude", Kind::Length),
                Point::amplitude,
            ),
            panel(
                "(b) body at the truck centers",
                ("amplitude of lateral acceleration", Kind::RideAcceleration),
                |point| point.acceleration,
            ),
        ],
    )
}
