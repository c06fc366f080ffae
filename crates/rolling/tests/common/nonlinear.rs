//! Hunting of a suspended wheelset on profiles with flanges: where the equilibrium loses its stability, and
//! where the limit cycle ends.

use integrate::{Integrator, Method, Options};
use rolling::rig::{Rig, RigStart, Setup};
use wheelrail::track::Segment;

use super::suspended::{growth_by_steps, hunting};
use super::{POLACH, bisection, freight, on_rails, track};

/// Returns a wheelset of an empty car on lateral and yaw springs, on nominal wheels and rails, at a speed
/// (m/s).
pub fn suspended(speed: f64) -> Setup {
    let line = track(&[Segment::Tangent(100.0 + 20.0 * speed)], Vec::new());
    let mut setup = on_rails(&freight(), line, POLACH, speed);
    setup.carriage.stiffness = [1.5e5, 8e5];
    setup.carriage.damping = [0.0; 2];
    setup.carriage.load = 58e3;
    setup
}

/// Critical speed (m/s) and frequency (rad/s) by linearization.
pub fn critical() -> [f64; 2] {
    let at = |speed: f64| hunting(&suspended(speed), [5.0, 100.0], 20.0);
    let found = bisection([10.0, 120.0], |speed| at(speed)[0]);
    [found, at(found)[1]]
}

/// Returns the lateral amplitude (m) in the last two seconds of a run at a speed (m/s) from a lateral start
/// (m).
pub fn amplitude(speed: f64, start: f64, duration: f64) -> f64 {
    let setup = suspended(speed);
    let start = RigStart {
        distance: 50.0,
        lateral: start,
        yaw: 0.0,
    };
    let mut rig = Rig::new(&setup, start).unwrap();
    let options = Options {
        relative_tolerance: 1e-5,
        ..Options::of(Method::Esdirk3)
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    let mut largest = 0.0_f64;
    while integrator.time() < duration {
        integrator.step_to(duration).unwrap();
        if integrator.time() > duration - 2.0 {
            let seen = rig.system.observe(integrator.time(), integrator.x());
            largest = largest.max(rig.relative(&setup.lines, &seen)[1].abs());
        }
    }
    largest
}

/// Returns the speed (m/s) at which the growth of runs from 0.1 mm is zero, from runs 1 % below and above the
/// critical speed by linearization (m/s, rad/s).
pub fn by_steps([speed, turning]: [f64; 2]) -> f64 {
    let frequency = turning / std::f64::consts::TAU;
    let growth = [0.99, 1.01].map(|factor| growth_by_steps(&suspended(factor * speed), frequency));
    speed * (0.99 - 0.02 * growth[0] / (growth[1] - growth[0]))
}
