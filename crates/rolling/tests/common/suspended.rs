//! Suspended wheelsets with linear wheels: critical speeds by linearization and by time steps.

use std::f64::consts::TAU;

use integrate::{Integrator, Options};
use rolling::rig::{Rig, RigStart, Setup};

use super::{bisection, linear};

pub const START: RigStart = RigStart {
    distance: 50.0,
    lateral: 0.0,
    yaw: 0.0,
};

/// Returns the least damped vibration whose frequency lies in a range (rad/s): real and imaginary part.
pub fn hunting(setup: &Setup, range: [f64; 2], shift: f64) -> [f64; 2] {
    let mut rig = Rig::new(setup, START).unwrap();
    let start = rig.start.clone();
    let found = rig.system.eigenvalues(0.0, &start, shift).unwrap();
    *found
        .iter()
        .find(|[_, imaginary]| (range[0]..range[1]).contains(imaginary))
        .expect("a vibration in the range")
}

/// Two suspended wheelsets: parameters, critical speed (m/s) and frequency (Hz) by the closed form.
pub type Suspended = ([f64; 4], [f64; 2], [f64; 3], [f64; 2]);
pub const SUSPENDED: [Suspended; 2] = [
    (
        [1250.0, 700.0, 2.5e5, 2.5e6],
        [1e7, 1e7],
        [0.05, 0.45, 0.7452],
        [117.1532, 6.92422],
    ),
    (
        [1568.0, 656.0, 4e5, 1.5e6],
        [9.43e6, 10.2e6],
        [0.05, 0.4572, 0.7465],
        [90.7235, 5.43344],
    ),
];

/// Critical speed (m/s) and frequency (Hz) by linearization.
pub fn critical_speed((suspension, creep, geometry): &([f64; 4], [f64; 2], [f64; 3])) -> [f64; 2] {
    let at = |speed: f64| hunting(&linear(*suspension, *creep, *geometry, speed), [5.0, 300.0], 20.0);
    let found = bisection([50.0, 200.0], |speed| at(speed)[0]);
    [found, at(found)[1] / TAU]
}

/// Growth (1/s) of the vibration of a frequency (Hz) by time steps, from the excursions early and late.
pub fn growth_by_steps(setup: &Setup, frequency: f64) -> f64 {
    let mut rig = Rig::new(
        setup,
        RigStart {
            lateral: 1e-4,
            ..START
        },
    )
    .unwrap();
    let options = Options {
        relative_tolerance: 1e-7,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    // Largest excursions in three periods, early and late.
    let mut peak = |from: f64| {
        let until = from + 3.0 / frequency;
        let mut largest = (0.0_f64, from);
        while integrator.time() < until {
            integrator.step_to(until).unwrap();
            if integrator.time() < from {
                continue;
            }
            let seen = rig.system.observe(integrator.time(), integrator.x());
            let lateral = rig.relative(&setup.lines, &seen)[1].abs();
            if lateral > largest.0 {
                largest = (lateral, integrator.time());
            }
        }
        largest
    };
    let (early, late) = (peak(1.5), peak(5.0));
    libm::log(late.0 / early.0) / 3.5
}
