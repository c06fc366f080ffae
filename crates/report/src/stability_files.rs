//! The files of `wedgelab stability`: vibrations of a car over speed, and critical speeds over amplitude, as
//! CSV, JSON and figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::CarCase;
use study::car::stability::{Branch, Critical, NamedMode, Stability, left_out};

use crate::csv::{RowWriter, rounded};
use crate::drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use crate::figures::axis;
use crate::summary::write_json;

/// The table of vibrations: the root locus over speed.
pub const TABLE: &str = "stability.csv";
/// The table of critical speeds over amplitude.
pub const CURVE: &str = "critical_speed.csv";
/// Critical speeds.
pub const NUMBERS: &str = "stability.json";
/// The figure.
pub const FIGURE: &str = "stability.svg";
/// The same as a picture.
pub const PICTURE: &str = "stability.png";
/// The page.
pub const PAGE: &str = "stability.html";
/// All of them.
pub const NAMES: [&str; 6] = [TABLE, CURVE, NUMBERS, FIGURE, PICTURE, PAGE];
/// The schema of [`NUMBERS`].
pub const SCHEMA: &str = "wedgelab.car_stability/2";

/// Growth below which a vibration is not drawn, 1/s: it is far from hunting.
const DRAWN: f64 = -6.0;
/// Vibrations that are followed over the speed.
const FOLLOWED: usize = 5;
/// Largest frequency drawn, Hz.
const FASTEST: f64 = 8.0;

/// Writes all vibrations: speed, friction, growth, frequency, damping ratio, what moves.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let mut table = RowWriter::new(out);
    table.text(&format!("speed_{}", Kind::TravelSpeed.suffix(units)));
    table
        .texts([
            "friction",
            "growth_per_s",
            "frequency_hz",
            "damping_ratio",
            "motion",
        ])
        .end()?;
    for branch in &found.branches {
        for (speed, modes) in found.speeds.iter().zip(&branch.modes) {
            for mode in modes {
                table
                    .plain(speed * Kind::TravelSpeed.from_si(units))
                    .text(branch.kind.name());
                write_mode(&mut table, mode)?;
            }
        }
    }
    Ok(())
}

/// Writes the cells of a vibration, and ends the row.
pub(crate) fn write_mode(table: &mut RowWriter<'_>, mode: &NamedMode) -> io::Result<()> {
    let angular_frequency = 2.0 * std::f64::consts::PI * mode.frequency;
    let ratio = -mode.growth / libm::hypot(mode.growth, angular_frequency);
    table.shown(mode.growth).shown(mode.frequency).shown(ratio);
    table.text(&mode.name).end()
}

/// Writes the critical speed over the lateral amplitude of the wheelset that moves most; empty cells: none.
///
/// # Errors
/// The writer's.
pub fn write_curve(found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let mut table = RowWriter::new(out);
    table
        .text(&format!("amplitude_{}", Kind::Length.suffix(units)))
        .text(&format!("critical_speed_{}", Kind::TravelSpeed.suffix(units)))
        .texts(["frequency_hz", "motion"])
        .end()?;
    for own in &found.curve {
        table.shown(own.amplitude * Kind::Length.from_si(units));
        match &own.critical {
            Some(own) => table
                .shown(own.speed * Kind::TravelSpeed.from_si(units))
                .shown(own.frequency)
                .text(&own.name),
            None => table.texts(["", "", ""]),
        };
        table.end()?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Document<'d> {
    schema: &'static str,
    name: &'d str,
    complete: bool,
    verdict: String,
    speed_unit: &'static str,
    length_unit: &'static str,
    speeds: Vec<f64>,
    branches: Vec<BranchDocument<'d>>,
    over_amplitude: Vec<CriticalDocument<'d>>,
    about: &'static str,
    /// What of the case does not count.
    #[serde(skip_serializing_if = "Option::is_none")]
    left_out: Option<&'static str>,
}

#[derive(Serialize)]
struct BranchDocument<'d> {
    friction: &'static str,
    /// Lowest of the speeds from which on a vibration grows; none if none does.
    #[serde(flatten)]
    critical: CriticalDocument<'d>,
    /// True if it grows at the lowest speed already.
    at_lowest: bool,
    /// Of the vibration that grows most, at each speed.
    largest_growth_per_s: Vec<Option<f64>>,
    its_frequency_hz: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct CriticalDocument<'d> {
    #[serde(skip_serializing_if = "Option::is_none")]
    amplitude: Option<f64>,
    critical_speed: Option<f64>,
    critical_frequency_hz: Option<f64>,
    motion: Option<&'d str>,
}

fn critical(of: Option<&Critical>, amplitude: Option<f64>, units: Units) -> CriticalDocument<'_> {
    CriticalDocument {
        amplitude: amplitude.map(|own| rounded(own * Kind::Length.from_si(units))),
        critical_speed: of.map(|own| rounded(own.speed * Kind::TravelSpeed.from_si(units))),
        critical_frequency_hz: of.map(|own| own.frequency),
        motion: of.map(|own| own.name.as_str()),
    }
}

/// Writes critical speeds, and the vibration that grows most at each speed.
///
/// # Errors
/// The writer's.
pub fn write_numbers(case: &CarCase, found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let branches = found.branches.iter().map(|branch| BranchDocument {
        friction: branch.kind.name(),
        critical: critical(branch.critical.as_ref(), None, units),
        at_lowest: branch.critical.as_ref().is_some_and(|own| own.at_lowest),
        largest_growth_per_s: first(branch, |mode| mode.growth),
        its_frequency_hz: first(branch, |mode| mode.frequency),
    });
    let over_amplitude = found.curve.iter();
    let over_amplitude =
        over_amplitude.map(|own| critical(own.critical.as_ref(), Some(own.amplitude), units));
    let document = Document {
        schema: SCHEMA,
        name: &case.name,
        complete: found.complete,
        verdict: found.verdict(units),
        speed_unit: Kind::TravelSpeed.label(units),
        length_unit: Kind::Length.label(units),
        speeds: found
            .speeds
            .iter()
            .map(|own| rounded(own * Kind::TravelSpeed.from_si(units)))
            .collect(),
        branches: branches.collect(),
        over_amplitude: over_amplitude.collect(),
        about: "Vibrations of 0.05 to 30 Hz about steady running on straight track. Friction stuck: \
                bristles are springs; absent: no friction in wedges, plates, adapters, side bearings; tied: \
                the linear benchmark. Over the amplitude: friction, conicity, gravitational stiffness and \
                creep by equivalent linearization at this lateral amplitude of the wheelset that moves most.",
        left_out: left_out(case),
    };
    write_json(&document, out)
}

fn first(branch: &Branch, of: impl Fn(&NamedMode) -> f64) -> Vec<Option<f64>> {
    branch.modes.iter().map(|modes| modes.first().map(&of)).collect()
}

/// Returns the figure: critical speed over amplitude, and the root locus over speed of each branch.
#[must_use]
pub fn figure(case: &str, found: &Stability, units: Units) -> Figure {
    let speed = |si: f64| si * Kind::TravelSpeed.from_si(units);
    let of_curve = found.curve.iter().filter_map(|own| {
        let critical = own.critical.as_ref()?;
        Some((own.amplitude * Kind::Length.from_si(units), speed(critical.speed)))
    });
    let mut curves = vec![PlotCurve {
        label: "critical speed".to_owned(),
        colour: Colour::Vermillion,
        line: Line::Solid,
        points: of_curve.collect(),
    }];
    let largest = found.curve.first().map_or(0.0, |own| own.amplitude) * Kind::Length.from_si(units);
    for (number, branch) in found.branches.iter().enumerate() {
        if let Some(own) = branch.critical.as_ref().filter(|own| !own.at_lowest) {
            let (_, line) = distinct(number + 1);
            curves.push(PlotCurve {
                label: branch.kind.words().to_owned(),
                colour: Colour::Grey,
                line,
                points: vec![(0.0, speed(own.speed)), (largest, speed(own.speed))],
            });
        }
    }
    let over_amplitude = Panel {
        title: "critical speed over amplitude, up to the flanges".to_owned(),
        x_label: axis("lateral amplitude of a wheelset", Kind::Length, units),
        y_label: axis("speed", Kind::TravelSpeed, units),
        curves,
        ..Panel::default()
    };
    // Nothing grows at any amplitude: there is no curve to draw.
    let drawn = over_amplitude.curves.iter().any(|own| !own.points.is_empty());
    let mut panels: Vec<Panel> = drawn.then_some(over_amplitude).into_iter().collect();
    panels.extend(found.branches.iter().map(|own| locus(own, &found.speeds, units)));
    Figure {
        title: format!("{case}: linear stability"),
        caption: "Beyond the curve over the amplitude a motion of this amplitude grows, by equivalent \
                          linearization. \
                  Root loci: growth and frequency of the vibrations about steady running that grow \
                  most, from the \
                  lowest to the highest speed, each named by its frequency there; positive growth is hunting."
            .to_owned(),
        panels,
        ..Figure::default()
    }
}

/// Returns the root locus of a branch over the speed.
fn locus(branch: &Branch, speeds: &[f64], units: Units) -> Panel {
    let speed = |own: Option<&f64>| own.copied().unwrap_or_default() * Kind::TravelSpeed.from_si(units);
    let title = format!(
        "{}, {:.0} to {:.0} {}",
        branch.kind.words(),
        speed(speeds.first()),
        speed(speeds.last()),
        Kind::TravelSpeed.label(units)
    );
    roots(title, &branch.modes)
}

/// Returns the root locus over what the lists of vibrations belong to: a curve for each of those that grow
/// most in the last list, followed to the others by the nearest root.
pub(crate) fn roots(title: String, all: &[Vec<NamedMode>]) -> Panel {
    let root = |mode: &NamedMode| (mode.growth, mode.frequency);
    let slow = |modes: &Vec<NamedMode>| -> Vec<(f64, f64)> {
        let own = modes.iter().map(root);
        own.filter(|(growth, frequency)| *growth > DRAWN && *frequency < FASTEST)
            .collect()
    };
    let last = all.last().map(slow).unwrap_or_default();
    let curves = last.into_iter().take(FOLLOWED).enumerate().map(|(number, end)| {
        let mut points = vec![end];
        let mut here = end;
        for modes in all.iter().rev().skip(1) {
            let apart = |own: &(f64, f64)| libm::hypot(own.0 - here.0, own.1 - here.1);
            let near = slow(modes)
                .into_iter()
                .min_by(|a, b| apart(a).total_cmp(&apart(b)));
            let Some(near) = near else { break };
            points.push(near);
            here = near;
        }
        points.reverse();
        let (colour, line) = distinct(number);
        PlotCurve {
            label: format!("{:.2} Hz", end.1),
            colour,
            line,
            points,
        }
    });
    Panel {
        title,
        x_label: "growth (1/s)".to_owned(),
        y_label: "frequency (Hz)".to_owned(),
        curves: curves.collect(),
        ..Panel::default()
    }
}
