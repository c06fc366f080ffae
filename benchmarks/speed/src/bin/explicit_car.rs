//! `explicit_car [SECONDS]`: the explicit program of `benchmarks::explicit` on one core, loaded and empty, on
//! smooth and on rough track.
//!
//! CPU time a second of the car, the least of three runs; then, as a sign that it is the same kind of car,
//! largest size of the body's vertical acceleration, roll of the body (greatest less least) and least load of
//! a wheel.

use std::process::ExitCode;

use benchmarks::exit;
use benchmarks::explicit::parts::{Faces, Lading, Losses, rough};
use benchmarks::explicit::{Car, GRAVITY, STEP};
use cpu_time::ThreadTime;

/// m/s: 50 mph.
const SPEED: f64 = 22.352;

fn main() -> ExitCode {
    exit(measure_all())
}

fn measure_all() -> Result<(), String> {
    let seconds = std::env::args().nth(1);
    let seconds = seconds.as_deref().unwrap_or("10");
    let duration: f64 = seconds
        .parse()
        .map_err(|_| format!("`{seconds}` is no number of seconds"))?;
    println!(
        "{:26} {:>6} {:>8} {:>8} {:>9} {:>14} {:>9} {:>12}",
        "run", "s", "CPU s/s", "steps/s", "µs/rhs", "vertical, g", "roll, mrad", "least load, %"
    );
    let (four, many) = (Faces::Corners, Faces::Crowned);
    let (loaded, empty) = (Lading::Loaded, Lading::Empty);
    for (track, waves) in [("smooth", Vec::new()), ("rough", rough())] {
        for (name, lading, faces) in [
            ("loaded", loaded, four),
            ("empty", empty, four),
            ("loaded, 18 points", loaded, many),
            ("empty, 18 points", empty, many),
        ] {
            let mut settled = Car::new(lading, Losses::All, faces, SPEED, waves.clone());
            settled.settle(2.0);
            let mut least = f64::INFINITY;
            let mut seen = [0.0; 3];
            for _ in 0..3 {
                let mut car = settled.clone();
                let start = ThreadTime::now();
                seen = run(&mut car, duration);
                least = least.min(start.elapsed().as_secs_f64());
            }
            let [vertical, roll, load] = seen;
            println!(
                "{:26} {duration:6.1} {:8.3} {:8.0} {:9.2} {vertical:14.3} {:9.1} {:12.1}",
                format!("{track}, {name}"),
                least / duration,
                1.0 / STEP,
                1e6 * least / (4.0 * duration / STEP),
                1e3 * roll,
                100.0 * load
            );
        }
    }
    Ok(())
}

/// Runs a car; returns the largest size of the vertical acceleration (g), greatest less least roll (rad), and
/// the least share of the static load of a wheel.
fn run(car: &mut Car, duration: f64) -> [f64; 3] {
    let share = car.weight() / 8.0;
    let (mut vertical, mut least) = (0.0_f64, f64::INFINITY);
    let mut roll = [f64::INFINITY, f64::NEG_INFINITY];
    while car.time < duration {
        car.step();
        vertical = vertical.max((car.acceleration[2] / GRAVITY).abs());
        let own = car.roll(0);
        roll = [roll[0].min(own), roll[1].max(own)];
        least = car
            .loads
            .iter()
            .flatten()
            .fold(least, |least, load| least.min(load / share));
    }
    [vertical, roll[1] - roll[0], least]
}
