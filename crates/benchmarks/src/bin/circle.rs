//! `circle [TOLERANCE [METHOD]]`: a free body once round a circle of track, in coordinates of several kinds.
//!
//! Circle: how far it came, in turns. Force: the largest deviation of the lateral force of the bushing from `m ω² r` after a quarter of the
//! circle, relative. Residual: of the energy ledger, over the kinetic energy.

use std::f64::consts::TAU;
use std::process::ExitCode;

use benchmarks::circle::{
    Carried, Coordinates, HEADING_RATE, MASS, Order, RADIUS, SPIN, STIFFNESS, on_core, travel,
};
use integrate::Method;

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

/// The lateral force in the steady state: m ω² (R + d), where it stretches the bushing by d.
fn steady() -> f64 {
    let inertia = MASS * HEADING_RATE * HEADING_RATE;
    inertia * RADIUS * STIFFNESS / (STIFFNESS - inertia)
}

fn line(name: &str, turns: f64, steps: u64, rejected: u64, force: f64, residual: f64) {
    println!("{name:36} {turns:8.3} {steps:8} {rejected:8} {force:10.1e} {residual:10.1e}");
}

fn carried(name: &str, body: Carried, by: (Method, f64)) -> Result<(), String> {
    let start = body.start();
    let energy = body.energy(0.0, &start);
    let mut worst = 0.0_f64;
    let mut done = None;
    // In 64 parts, to look at the force between them.
    for part in 16..=64 {
        let end = f64::from(part) / 64.0 * TAU / HEADING_RATE;
        let (integrator, stopped) =
            travel(body.problem(), &start, by, end).map_err(|error| error.to_string())?;
        let x: [f64; 14] = std::array::from_fn(|k| integrator.x()[k]);
        let time = integrator.time();
        if stopped.is_none() {
            let force = body.loads(time, &x).force.0[1];
            worst = worst.max((force / steady() - 1.0).abs());
        }
        let residual = (body.energy(time, &x) - energy - x[12] + x[13]) / energy;
        let statistics = integrator.statistics();
        let ended = stopped.is_some();
        done = Some((time, statistics.steps, statistics.rejected(), residual));
        if ended {
            break;
        }
    }
    if let Some((time, steps, rejected, residual)) = done {
        line(name, time * HEADING_RATE / TAU, steps, rejected, worst, residual);
    }
    Ok(())
}

fn core(name: &str, coordinates: Coordinates, by: (Method, f64)) -> Result<(), String> {
    let (system, x) = on_core(coordinates)?;
    let mut observer = system.clone();
    let energy = observer.observe(0.0, &x).energies.total();
    let (mut worst, mut done) = (0.0_f64, None);
    for part in 16..=64 {
        let end = f64::from(part) / 64.0 * TAU / HEADING_RATE;
        let (integrator, stopped) = travel(system.clone(), &x, by, end).map_err(|error| error.to_string())?;
        let time = integrator.time();
        observer.segment_like(integrator.problem());
        let seen = observer.observe(time, integrator.x());
        if stopped.is_none() {
            // The two coils across, in the seat's axes: those of the guide.
            let force = seen.coils[2].coil.force.0[1] + seen.coils[3].coil.force.0[1];
            worst = worst.max((force / steady() - 1.0).abs());
        }
        let work = seen.quadratures[0];
        let losses: f64 = seen.quadratures[1..].iter().sum();
        let residual = (seen.energies.total() - energy - work + losses) / energy;
        let statistics = integrator.statistics();
        done = Some((time, statistics.steps, statistics.rejected(), residual));
        if stopped.is_some() {
            break;
        }
    }
    if let Some((time, steps, rejected, residual)) = done {
        line(name, time * HEADING_RATE / TAU, steps, rejected, worst, residual);
    }
    Ok(())
}
