//! `circle [TOLERANCE [METHOD]]`: a free body once round a circle of track, in coordinates of several kinds.
//!
//! Circle: how far it came, in turns. Force: the largest deviation of the lateral force of the bushing from
//! `m ω² r` at ends of steps after a quarter of the circle, relative. Residual: the relative residual of the
//! energy ledger, at the ends of steps.

use std::process::ExitCode;

use benchmarks::circle::{CIRCLE, Carried, Coordinates, Order, SPIN, on_core, states, steady_force, travel};
use benchmarks::ledger;
use integrate::{Integrator, Method, Problem};
use mechanics::energy_balance::EnergyBalance;

fn main() -> ExitCode {
    let Some(by) = arguments() else {
        eprintln!("usage: circle [TOLERANCE [METHOD]], such as 1e-6 tr-bdf2");
        return ExitCode::from(2);
    };
    println!(
        "{:36} {:>8} {:>8} {:>8} {:>10} {:>10}",
        "coordinates", "circle", "steps", "rejected", "force", "residual"
    );
    for (name, order, spin) in [
        ("absolute: pitch, yaw, roll", Order::PitchYawRoll, 0.0),
        ("absolute: yaw, pitch, roll", Order::YawPitchRoll, 0.0),
        ("absolute: yaw, pitch, roll; spin", Order::YawPitchRoll, SPIN),
        ("absolute: yaw, roll, pitch", Order::YawRollPitch, 0.0),
        ("absolute: yaw, roll, pitch; spin", Order::YawRollPitch, SPIN),
    ] {
        let body = Carried {
            order,
            heading: 0.0,
            spin,
        };
        if let Err(error) = carried(name, body, by) {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    }
    for (name, coordinates) in [
        ("core, absolute: pitch, yaw, roll", Coordinates::Absolute),
        ("core, relative to a moving frame", Coordinates::Relative),
    ] {
        if let Err(error) = core(name, coordinates, by) {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Method and relative tolerance.
fn arguments() -> Option<(Method, f64)> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let tolerance = arguments.first().map_or("1e-6", String::as_str);
    let method = arguments
        .get(1)
        .map_or(Ok(Method::default()), |name| name.parse());
    Some((method.ok()?, tolerance.parse().ok()?))
}

/// Prints how a run ended: `force` is the largest deviation, `residual` relative.
fn line<P: Problem>(name: &str, run: &Integrator<P>, force: f64, residual: f64) {
    let (turns, statistics) = (run.time() / CIRCLE, run.statistics());
    println!(
        "{name:36} {turns:8.3} {:8} {:8} {force:10.1e} {residual:10.1e}",
        statistics.steps,
        statistics.rejected()
    );
}

/// Returns the deviation of a lateral force at a time, relative to that of the steady state; zero in the
/// first quarter.
fn deviation(time: f64, force: f64) -> f64 {
    if time < 0.25 * CIRCLE {
        return 0.0;
    }
    (force / steady_force() - 1.0).abs()
}

fn carried(name: &str, body: Carried, by: (Method, f64)) -> Result<(), String> {
    let start = body.start();
    let energy = body.energy(0.0, &start);
    let (mut worst, mut balance) = (0.0_f64, EnergyBalance::new(energy));
    let (run, _) = travel(body.problem(), &start, by, CIRCLE, |run| {
        let (time, x) = (run.time(), states(run.x()));
        worst = worst.max(deviation(time, body.loads(time, &x).force.0[1]));
        balance.note(time, &body.ledger(time, &x, energy));
    })
    .map_err(|error| error.to_string())?;
    line(name, &run, worst, balance.relative_residual());
    Ok(())
}

fn core(name: &str, coordinates: Coordinates, by: (Method, f64)) -> Result<(), String> {
    let (system, x) = on_core(coordinates)?;
    let mut observer = system.clone();
    let energy = observer.observe(0.0, &x).energies.total();
    let (mut worst, mut balance) = (0.0_f64, EnergyBalance::new(energy));
    let (run, _) = travel(system, &x, by, CIRCLE, |run| {
        observer.segment_like(run.problem());
        let observation = observer.observe(run.time(), run.x());
        // The two coils across, in the seat's axes: those of the guide.
        let force = observation.coils[2].coil.force.0[1] + observation.coils[3].coil.force.0[1];
        worst = worst.max(deviation(run.time(), force));
        balance.note(run.time(), &ledger(&observation, energy));
    })
    .map_err(|error| error.to_string())?;
    line(name, &run, worst, balance.relative_residual());
    Ok(())
}
