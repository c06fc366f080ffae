//! Constant-contact side bearings with hysteresis: the loop of force over travel.

use std::f64::consts::TAU;

use integrate::{Integrator, Method, Options};
use mechanics::energy_balance::EnergyBalance;
use mechanics::motion::Motion;
use mechanics::system::EnergyTermKind;
use truck::{CarBody, Hysteresis, Lading, Parameters, SideBearing, SideBearings, Truck};
use wedge::parameters::Damping;

use crate::common::{INCH, POUND_FORCE};

const PRELOAD: f64 = 6000.0 * POUND_FORCE;
const RATE: f64 = 6000.0 * POUND_FORCE / INCH;
const LIMIT: f64 = 800.0 * POUND_FORCE;

/// Side bearings under a body that is held, over a bolster that goes up and down.
struct Moved {
    /// Compression of the left bearing from the nominal layout, m, its force and that of its hysteresis, N.
    course: Vec<[f64; 3]>,
    /// What the left bearing's hysteresis lost in each cycle, J.
    lost: Vec<f64>,
    residual: f64,
}

fn hysteresis() -> Hysteresis {
    Hysteresis {
        limit: LIMIT,
        ..Hysteresis::default()
    }
}

/// `amplitude` in m, `frequency` in Hz.
fn moved(amplitude: f64, frequency: f64, cycles: usize) -> Moved {
    let mut bearings = SideBearings::constant_contact();
    if let SideBearing::ConstantContact { hysteresis: own, .. } = &mut bearings.kind {
        *own = Some(hysteresis());
    }
    let mut car = CarBody::new(Lading::Loaded, bearings);
    // Held but for its way along the track, along which nothing moves it.
    car.free = [true, false, false, false, false, false];
    let mut parameters = Parameters {
        car_body: Some(car),
        ..Parameters::new(Damping::Variable)
    };
    let motion = Motion::Sine {
        amplitude,
        angular_frequency: TAU * frequency,
        phase: 0.0,
    };
    parameters.bolster.motion.coordinates[2] = motion.clone();
    let truck = Truck::new(&parameters).unwrap();
    let mut observer = truck.system.clone();
    let x = observer.initial_state();
    let start = observer.observe(0.0, &x).energies.total();
    let options = Options {
        relative_tolerance: 1e-6,
        ..Options::of(Method::Rodas5P)
    };
    let term = observer
        .energy_terms()
        .iter()
        .position(|term| term.kind == EnergyTermKind::SurfaceFriction && term.element == "left_side_bearing");
    let term = term.unwrap();
    let mut integrator = Integrator::new(truck.system.clone(), options, 0.0, &x).unwrap();
    let mut balance = EnergyBalance::new(start);
    let (mut moved, mut before) = (
        Moved {
            course: Vec::new(),
            lost: Vec::new(),
            residual: 0.0,
        },
        0.0,
    );
    const A_CYCLE: usize = 200;
    for sample in 0..=A_CYCLE * cycles {
        let time = sample as f64 / (A_CYCLE as f64 * frequency);
        while integrator.time() < time {
            integrator.step_to(time).unwrap();
        }
        observer.segment_like(integrator.problem());
        let seen = observer.observe(time, integrator.x());
        balance.note(time, &observer.ledger_entries(&seen, start));
        let own = truck.loads(&seen).side_bearings[0];
        let [compression, ..] = motion.evaluate(time, 0.0);
        moved.course.push([compression, own.force, own.hysteresis]);
        if sample > 0 && sample % A_CYCLE == 0 {
            moved.lost.push(seen.quadratures[term] - before);
            before = seen.quadratures[term];
        }
    }
    moved.residual = balance.relative_residual();
    moved
}

/// A slider of limit F behind a spring K, moved by ±X, loses 4 F (X - F/K) in a cycle; the force on the way
/// in lies above that on the way out by 2 F, and their mean is that of the elastic bearing.
#[test]
fn analytic_a_cycle_loses_the_area_of_the_loop() {
    let amplitude = 0.25 * INCH;
    let moved = moved(amplitude, 0.1, 2);
    let held = LIMIT / hysteresis().stiffness;
    let area = 4.0 * LIMIT * (amplitude - held);
    let lost = moved.lost[1];
    assert!((lost / area - 1.0).abs() < 2e-3, "{lost} J, {area} J expected");
    // The first quarter begins with a spring that is relaxed.
    let first = area - LIMIT * held;
    let lost = moved.lost[0];
    assert!((lost / first - 1.0).abs() < 2e-3, "{lost} J, {first} J expected");
    // In the middle of the second cycle, on the way out and on the way in.
    for (sample, sign) in [(300, -1.0), (400, 1.0)] {
        let [compression, force, own] = moved.course[sample];
        assert!(compression.abs() < 1e-9, "{compression}");
        assert!((own / (sign * LIMIT) - 1.0).abs() < 1e-6, "{own}");
        let expected = PRELOAD + sign * LIMIT;
        assert!(
            (force / expected - 1.0).abs() < 1e-6,
            "{force} N, {expected} expected"
        );
    }
    assert!(moved.residual < 1e-5, "{}", moved.residual);
}

/// The loop does not depend on speed: twenty times as fast it loses as much, but for the damping of the
/// spring in series.
#[test]
fn limits_the_loop_does_not_depend_on_speed() {
    let [slow, fast] = [0.1, 2.0].map(|frequency| moved(0.25 * INCH, frequency, 2).lost[1]);
    assert!((fast / slow - 1.0).abs() < 0.02, "{slow} {fast}");
}

/// Within the travel in which the slider holds nothing is lost: the bearing is stiffer by K.
#[test]
fn limits_small_motions_are_elastic() {
    let own = hysteresis();
    let amplitude = 0.5 * own.limit / own.stiffness;
    let moved = moved(amplitude, 0.1, 1);
    assert!(moved.lost[0] < 1e-3 * own.limit * amplitude, "{}", moved.lost[0]);
    let [compression, force, _] = moved.course[50];
    let expected = PRELOAD + (RATE + own.stiffness) * compression;
    assert!(
        (force / expected - 1.0).abs() < 1e-4,
        "{force} N, {expected} expected"
    );
}

/// Where the bearing opens, 1 in above the nominal layout, its friction fades with the spring's force: the
/// whole never pulls, and an open bearing has no force.
#[test]
fn limits_a_bearing_that_opens_does_not_pull() {
    let moved = moved(1.2 * INCH, 0.2, 2);
    let mut opened = 0;
    for [compression, force, own] in moved.course {
        assert!(force >= -1e-6, "{force} N at {compression} m");
        if compression < -PRELOAD / RATE {
            assert!(force.abs() < 1e-6 && own == 0.0, "{force} {own}");
            opened += 1;
        }
    }
    assert!(opened > 20, "{opened}");
}
