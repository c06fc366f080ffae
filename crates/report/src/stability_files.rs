//! The files of `wedgelab stability`: vibrations of a car over speed, and critical speeds over amplitude, as
//! CSV, JSON and figure.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::CarCase;
use study::car::stability::{AtAmplitude, Branch, Critical, NamedMode, Stability, left_out};

use crate::csv::rounded;
use crate::figures::axis;
use crate::output_table::OutputTable;
use crate::summary::write_json;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

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
    let modes = found.branches.iter().flat_map(|branch| {
        let modes = found.speeds.iter().zip(&branch.modes);
        modes.flat_map(move |(speed, modes)| modes.iter().map(move |mode| (*speed, branch.kind, mode)))
    });
    let mut table = OutputTable::new(modes, units);
    table.rounded("speed", Kind::TravelSpeed, |(speed, ..)| *speed);
    table.text("friction", |(_, kind, _)| kind.name());
    add_mode(&mut table, |(.., mode)| mode);
    table.write_csv(out)
}

/// Adds the columns of a vibration.
pub(crate) fn add_mode<'t, R>(
    table: &mut OutputTable<'t, R>,
    mode: impl for<'r> Fn(&'r R) -> &'r NamedMode + Copy + 't,
) {
    table.number("growth_per_s", Kind::Count, move |row| mode(row).growth);
    table.number("frequency_hz", Kind::Count, move |row| mode(row).frequency);
    table.number("damping_ratio", Kind::Count, move |row| {
        let (growth, frequency) = (mode(row).growth, mode(row).frequency);
        -growth / libm::hypot(growth, 2.0 * std::f64::consts::PI * frequency)
    });
    table.text("motion", move |row| &mode(row).name);
}

/// Writes the critical speed over the lateral amplitude of the wheelset that moves most; empty cells: none.
///
/// # Errors
/// The writer's.
pub fn write_curve(found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let critical = |own: &&AtAmplitude, of: fn(&Critical) -> f64| own.critical.as_ref().map_or(f64::NAN, of);
    let mut table = OutputTable::new(&found.curve, units);
    table.number("amplitude", Kind::Length, |own| own.amplitude);
    table.number("critical_speed", Kind::TravelSpeed, move |own| {
        critical(own, |own| own.speed)
    });
    table.number("frequency_hz", Kind::Count, move |own| {
        critical(own, |own| own.frequency)
    });
    table.text("motion", |own| own.critical.as_ref().map_or("", |own| &own.name));
    table.write_csv(out)
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
    let mut curves = vec![PlotCurve::new(
        "critical speed",
        (Colour::Vermillion, Line::Solid),
        of_curve,
    )];
    let largest = found.curve.first().map_or(0.0, |own| own.amplitude) * Kind::Length.from_si(units);
    for (number, branch) in found.branches.iter().enumerate() {
        if let Some(own) = branch.critical.as_ref().filter(|own| !own.at_lowest) {
            let (_, line) = distinct(number + 1);
            curves.push(PlotCurve::new(
                branch.kind.words(),
                (Colour::Grey, line),
                [(0.0, speed(own.speed)), (largest, speed(own.speed))],
            ));
        }
    }
    let over_amplitude = Panel::new(
        "critical speed over amplitude, up to the flanges",
        axis("lateral amplitude of a wheelset", Kind::Length, units),
        axis("speed", Kind::TravelSpeed, units),
        curves,
    );
    // Nothing grows at any amplitude: there is no curve to draw.
    let drawn = over_amplitude.curves.iter().any(|own| !own.points.is_empty());
    let mut panels: Vec<Panel> = drawn.then_some(over_amplitude).into_iter().collect();
    panels.extend(found.branches.iter().map(|own| locus(own, &found.speeds, units)));
    Figure::new(
        format!("{case}: linear stability"),
        "Beyond the curve over the amplitude a motion of this amplitude grows, by equivalent \
         linearization. Root loci: growth and frequency of the vibrations about steady running that grow \
         most, from the lowest to the highest speed, each named by its frequency there; positive growth is \
         hunting.",
        panels,
    )
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
        PlotCurve::new(format!("{:.2} Hz", end.1), distinct(number), points)
    });
    Panel::new(title, "growth (1/s)", "frequency (Hz)", curves)
}
