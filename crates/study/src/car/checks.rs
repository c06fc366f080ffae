//! Checks of several keys together: a lading that tips the car, a track that is too short, a curve that is
//! too tight.

use car::{Drive, Parameters, StartKind, Wheels};
use quantity::Number;
use truck::SideBearing;
use wheelrail::track::CenterLine;

use super::couplers;
use super::lading::LadingKind;
use super::{not_round, rails};
use crate::case::Simulation;
use crate::case::problem::Problem;
use crate::geometry;
use crate::reader::CaseReader;

const FOOT: f64 = 0.3048;
pub(super) const INCH: f64 = 0.0254;
pub(super) const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Frequencies of the free twist of a body beyond which it is doubtful, Hz.
const TWISTS: [f64; 2] = [0.5, 40.0];
/// Coils that rise or sink by less are not spoken of, m.
const SMALL_RISE: f64 = 0.05 * INCH;
/// The curve below whose radius no truck of this kind runs, m: 150 ft, the least that rules for the design of
/// cars name (remembered).
const LEAST_RADIUS: f64 = 150.0 * FOOT;

/// Notes the mistakes. Returns the doubts.
pub(super) fn all(
    r: &mut CaseReader<'_>,
    parameters: &Parameters,
    simulation: &Simulation,
    lading: LadingKind,
) -> Vec<String> {
    balance(r, parameters, lading);
    overlap(r, parameters);
    way(r, parameters, simulation);
    if let Wheels::OnRails(wheels) = &parameters.wheels {
        rails::begin_behind(r, wheels, parameters.start.distance + parameters.reach());
    }
    let reaches = reach(r, parameters);
    let shakes = shaking(r, parameters);
    if let (true, true, Err(error)) = (reaches, shakes, parameters.check()) {
        let problem = Problem::new(error.to_string());
        r.problems.push(match error.remedy() {
            Some(remedy) => problem.help(remedy),
            None => problem,
        });
    }
    let mut doubts = geometry::of_car(parameters);
    doubts.extend(height(parameters));
    doubts.extend(twist(parameters));
    doubts.extend(not_round::of_rows(parameters, simulation.output_interval));
    doubts.extend(couplers::checks(r, parameters, simulation.duration));
    doubts
}

/// Notes linear wheels of a car that shall be shaken; returns whether it can be.
fn shaking(r: &mut CaseReader<'_>, parameters: &Parameters) -> bool {
    let can = parameters.start.kind != StartKind::Shaken || matches!(parameters.wheels, Wheels::OnRails(_));
    if !can {
        let message = "`start.kind` is \"shaken\", but wheels.geometry is \"linear\": linear wheels are for \
                       small motions, and have no flanges on rough track";
        let help = "write start.kind = \"equilibrium\", or wheels.geometry = \"profiles\"";
        r.problem(
            "start.kind",
            Problem::new(message).label("cannot be shaken").help(help),
        );
    }
    can
}

/// Notes wheels that do not reach both rails; returns whether they do.
fn reach(r: &mut CaseReader<'_>, parameters: &Parameters) -> bool {
    let Wheels::OnRails(wheels) = &parameters.wheels else {
        return true;
    };
    let reaches = wheels.geometry.iter().map(|own| own.check_reach());
    match reaches.into_iter().find_map(Result::err) {
        None => true,
        Some(error) => {
            let problem = Problem::new(error.to_string()).label("too wide");
            r.problem("rails.gauge", problem.help(error.remedy()));
            false
        }
    }
}

/// Notes trucks or wheels that are in each other.
fn overlap(r: &mut CaseReader<'_>, parameters: &Parameters) {
    let wheel = 2.0 * parameters.wheel_radius();
    let bases = parameters.trucks.each_ref().map(|own| own.geometry.wheelbase);
    let between = parameters.truck_distance - 0.5 * (bases[0] + bases[1]);
    if between < wheel {
        let message = format!(
            "the trucks overlap: their centers are {:.1} in apart, so that the inner axles are {:.1} in \
             apart, and wheels have a diameter of {:.1} in",
            parameters.truck_distance / INCH,
            between / INCH,
            wheel / INCH
        );
        let help = "look at car.truck_distance and truck.wheelbase, and at their units";
        r.problem(
            "car.truck_distance",
            Problem::new(message).label("trucks overlap").help(help),
        );
    }
    let name = if r.has("front_truck") {
        "front_truck"
    } else {
        "truck"
    };
    let base = bases[0].min(bases[1]);
    if base < wheel {
        let message = format!(
            "the wheels of a truck overlap: its axles are {:.1} in apart, and wheels have a diameter of \
             {:.1} in",
            base / INCH,
            wheel / INCH
        );
        let problem = Problem::new(message).label("wheels overlap");
        let help = "the wheelbase is from axle to axle: 66 to 72 in are usual";
        r.problem(&format!("{name}.wheelbase"), problem.help(help));
    }
}

/// A center of gravity outside of what carries the body.
fn balance(r: &mut CaseReader<'_>, parameters: &Parameters, lading: LadingKind) {
    let [forward, left, _] = parameters.center_of_gravity();
    let key = lading.key();
    let half = 0.5 * parameters.truck_distance;
    if forward.abs() >= half {
        let message = format!(
            "the center of gravity of body and lading lies {:.1} in from the middle, beyond the {} truck, \
             {:.1} in from it: the car tips",
            forward.abs() / INCH,
            if forward > 0.0 { "front" } else { "rear" },
            half / INCH
        );
        let help = "move the masses of the lading between the trucks";
        r.problem(key, Problem::new(message).label("tips the car").help(help));
    }
    let bearing = parameters.side_bearing_distance();
    if left.abs() >= bearing {
        let message = format!(
            "the center of gravity of body and lading lies {:.1} in to the {} of the middle, beyond the \
             side bearings at {:.1} in: the body tips over them",
            left.abs() / INCH,
            if left > 0.0 { "left" } else { "right" },
            bearing / INCH
        );
        let help = "move the masses of the lading towards the middle, or set another beside them";
        r.problem(key, Problem::new(message).label("tips the body").help(help));
    }
    for (name, own) in ["front", "rear"].into_iter().zip(&parameters.trucks) {
        let Some(body) = &own.car_body else { continue };
        let share = 0.5 + if name == "front" { forward } else { -forward } / parameters.truck_distance;
        let carried = share * parameters.carried_mass() * parameters.gravity;
        if matches!(body.side_bearings.kind, SideBearing::ConstantContact { .. })
            && body.side_bearings.preload() > carried
        {
            let message = format!(
                "the side bearings of the {name} truck push with {:.0} lbf, more than the {:.0} lbf of the \
                 body that stand there: they lift it off the center plate",
                body.side_bearings.preload() / POUND_FORCE,
                carried / POUND_FORCE
            );
            let help = "lower side_bearing.preload of the truck, or load the car";
            r.problem(key, Problem::new(message).label("lifted").help(help));
        }
    }
}

/// Returns the warning about coils that do not carry in the nominal layout what stands on them.
fn height(parameters: &Parameters) -> Option<String> {
    let [forward, ..] = parameters.center_of_gravity();
    let mut worst: Option<(f64, &str, f64)> = None;
    for (name, own) in ["front", "rear"].into_iter().zip(&parameters.trucks) {
        let share = 0.5 + if name == "front" { forward } else { -forward } / parameters.truck_distance;
        let mut standing = own.clone();
        let body = standing.car_body.as_mut()?;
        body.body.mass = share * parameters.carried_mass();
        let rise = standing.surplus()? / own.load_stiffness();
        let travel = own.load_coils.iter().flatten();
        let travel = travel.filter_map(|coil| coil.spring.solid.map(|solid| solid[0]));
        let travel = travel.fold(f64::INFINITY, f64::min);
        if -rise > travel && worst.is_none_or(|(other, ..)| rise < other) {
            worst = Some((rise, name, travel));
        }
    }
    let (rise, name, travel) = worst.filter(|(rise, ..)| rise.abs() > SMALL_RISE)?;
    Some(format!(
        "the coils of the {name} truck would give by {:.2} in under what stands on them, but go solid after \
         {:.2} in: raise load_springs.preload of the truck, or carry less",
        -rise / INCH,
        travel / INCH
    ))
}

/// Returns the warning about a body that twists as none does.
fn twist(parameters: &Parameters) -> Option<String> {
    let frequency = parameters.torsion_frequency()?;
    let [low, high] = TWISTS;
    let what = format!("the body twists freely at {frequency:.2} Hz");
    if frequency < low {
        return Some(format!(
            "{what}, softer than any car's: look at the unit of car.torsion_stiffness, which is per rad"
        ));
    }
    (frequency > high).then(|| {
        format!(
            "{what}, as good as rigid, and near the joint of its halves, which gives way at 100 Hz: leave \
             car.torsion_stiffness out"
        )
    })
}

/// Checks the car's start, and that the track is long and wide enough for it.
fn way(r: &mut CaseReader<'_>, parameters: &Parameters, simulation: &Simulation) {
    let line = &parameters.track.center_line;
    let (start, reach) = (parameters.start.distance, parameters.reach());
    if start < reach {
        let message = format!(
            "the car starts at {:.1} ft with its rear axle {:.1} ft before the beginning of the track",
            start / FOOT,
            (reach - start) / FOOT
        );
        let help = format!("write start.distance = \"{} ft\" or more", (reach / FOOT).ceil());
        r.problem(
            "start.distance",
            Problem::new(message).label("before the track").help(help),
        );
        return;
    }
    let lead = straight_until(line);
    if start + reach > lead {
        let message = format!(
            "the car starts with its front axle at {:.1} ft, but the track is straight and level across \
             only until {:.1} ft: a run begins on tangent track",
            (start + reach) / FOOT,
            lead / FOOT
        );
        let help = format!(
            "make the first tangent {:.0} ft or longer",
            ((start + reach) / FOOT).ceil()
        );
        r.problem(
            "track",
            Problem::new(message).label("too short a lead-in").help(help),
        );
        return;
    }
    let run = way_of(parameters, simulation.duration);
    let end = start + reach + run;
    if end > line.length() {
        let room = line.length() - start - reach;
        let message = format!(
            "the track is {:.0} ft long, but the front axle comes to {:.0} ft in {} s",
            line.length() / FOOT,
            end / FOOT,
            Number(simulation.duration)
        );
        // The way grows with the time.
        let (mut enough, mut too_long) = (0.0, simulation.duration);
        for _ in 0..40 {
            let middle = 0.5 * (enough + too_long);
            *(if way_of(parameters, middle) > room {
                &mut too_long
            } else {
                &mut enough
            }) = middle;
        }
        let most = (10.0 * enough).floor() / 10.0;
        let help = format!("write simulation.duration = \"{most:.1} s\", or make the track longer");
        r.problem("track", Problem::new(message).label("too short").help(help));
    }
    let (mut tightest, mut place) = (0.0_f64, 0.0);
    let steps = (line.length() / FOOT).ceil() as usize;
    for step in 0..=steps {
        let distance = step as f64 * FOOT;
        let curvature = line.at(distance).curvature[0].abs();
        if curvature > tightest {
            (tightest, place) = (curvature, distance);
        }
    }
    if tightest * LEAST_RADIUS > 1.0 {
        let axle = parameters.trucks[0].geometry.axle();
        let turn = 0.5 * parameters.truck_distance * tightest;
        let bearings = parameters.trucks[0]
            .car_body
            .as_ref()
            .map_or(0.0, |own| own.side_bearings.distance);
        let message = format!(
            "the curve at {:.0} ft has a radius of {:.0} ft, tighter than the 150 ft that cars are built \
             for: the trucks would turn by {:.1} deg under the body, the side bearings would move by {:.1} \
             in, and between the axles of a truck the outer rail lies {:.2} in off the line through them, \
             where the flanges press",
            place / FOOT,
            1.0 / tightest / FOOT,
            turn.to_degrees(),
            turn * bearings / INCH,
            0.5 * axle * axle * tightest / INCH
        );
        r.problem(
            "track",
            Problem::new(message)
                .label("too tight")
                .help("choose a larger radius"),
        );
    }
}

/// Returns the distance at which the track first bends, or its first superelevation begins; its length if
/// nowhere.
fn straight_until(line: &CenterLine) -> f64 {
    let steps = (line.length() / FOOT).ceil() as usize;
    let bends = |distance: f64| {
        let station = line.at(distance);
        station.curvature[0].abs() > 1e-7 || station.superelevation[0].abs() > 1e-4
    };
    let first = (0..=steps)
        .map(|step| step as f64 * FOOT)
        .find(|distance| bends(*distance));
    first.unwrap_or(line.length())
}

/// Returns the distance that the car covers in a time (s) at the speeds that its drive asks for, m.
fn way_of(parameters: &Parameters, duration: f64) -> f64 {
    const STEPS: usize = 2000;
    let (start, step) = (parameters.start.distance, duration / STEPS as f64);
    match &parameters.drive {
        Drive::Held { .. } | Drive::Coasting => parameters.start.speed * duration,
        Drive::Over { speeds, .. } => {
            let end = (0..STEPS).fold(start, |distance, _| distance + step * speed_at(speeds, distance));
            end - start
        }
        Drive::History { speeds, .. } => {
            let middles = (0..STEPS).map(|k| (k as f64 + 0.5) * step);
            middles.map(|time| step * speed_at(speeds, time)).sum()
        }
    }
}

/// Returns a speed (m/s) at a distance (m) or time (s), straight between pairs.
pub(super) fn speed_at(speeds: &[[f64; 2]], distance: f64) -> f64 {
    let Some(after) = speeds.iter().position(|[own, _]| *own > distance) else {
        return speeds.last().map_or(0.0, |[_, speed]| *speed);
    };
    let Some(before) = after.checked_sub(1) else {
        return speeds[after][1];
    };
    let ([a, from], [b, to]) = (speeds[before], speeds[after]);
    from + (to - from) * (distance - a) / (b - a)
}
