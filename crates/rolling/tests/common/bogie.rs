//! Cooperrider's bogie with linear wheels through the elements on the core.

use std::f64::consts::TAU;
use std::sync::Arc;

use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::link::Marker;
use mechanics::system::{Model, System};
use rolling::linear::LinearOnTrack;
use rolling::wheelset::{WheelsetBody, WheelsetPlace, coordinate, marker};
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{CreepCoefficients, LinearWheelset};
use wheelrail::track::{RailLines, Segment};

use super::bushing::Bushing;
use super::{bisection, track};

/// Radius, half the gauge, half the wheelbase, lateral places of springs, heights below and above the frame's
/// center, m.
const R: f64 = 0.4572;
const A: f64 = 0.716;
const B: f64 = 1.074;
const D: [f64; 2] = [0.620, 0.680];
const H: [f64; 2] = [0.0762, 0.6584];

fn bogie(speed: f64) -> (System, Vec<f64>) {
    let lines = Arc::new(RailLines::new(
        track(&[Segment::Tangent(100.0)], Vec::new()),
        [0.75; 2],
    ));
    let creep = 6.563e6;
    let geometry = LinearGeometry {
        roll_coefficient: 0.0,
        ..LinearGeometry::of_cones(0.05, A, R)
    };
    let wheels = LinearOnTrack {
        name: "wheels".to_owned(),
        lines,
        wheelset: LinearWheelset {
            geometry,
            creep: CreepCoefficients {
                f11: creep / 0.602_52,
                f22: creep / 0.542_19,
                f23: 0.0,
                f33: 0.0,
            },
            spin: false,
            axle_load: 0.0,
        },
        support: [1e9, 1e9],
        slowest: 0.01,
    };
    let wheelset = WheelsetBody {
        mass: 1022.0,
        about_axle: 80.0,
        about_diameter: 678.0,
    };
    let middle = 50.0;
    let (height, roll) = (R + H[0], coordinate::ROLL);
    let mut bodies = vec![Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]))];
    for (name, ahead) in [("front", B), ("rear", -B)] {
        let place = WheelsetPlace {
            position: [middle + ahead, 0.0, R],
            ..WheelsetPlace::default()
        };
        let mut body = wheelset.body(name, &place);
        // Held, as in the model of the literature.
        body.free[roll] = false;
        bodies.push(body);
    }
    let mut frame = Body::free("frame", 2918.0, [6780.0; 3], [middle, 0.0, height, 0.0, 0.0, 0.0]);
    frame.free = [true, true, false, true, false, true];
    bodies.push(frame);
    let mut model = Model::new(bodies, [0.0; 3]);
    let at = |origin: [f64; 3]| Marker::new(origin, [0.0; 3]);
    let [k1, k2, k3, k4, k5, k6] = [1823e3, 3646e3, 3646e3, 182.3e3, 333.3e3, 2710e3];
    let [d1, d2] = [20e3, 29.2e3];
    for (body, ahead) in [(1, B), (2, -B)] {
        model.add(wheels.clone(), (body, marker(0.0)), (0, at([0.0; 3])));
        let primary = Bushing {
            along: [2.0 * k2, 2.0 * k1, 0.0],
            about: [0.0, 0.0, 2.0 * k2 * D[0] * D[0]],
            damping: [0.0; 3],
            turning: [0.0; 3],
        };
        model.add(primary, (body, marker(0.0)), (3, at([ahead, 0.0, -H[0]])));
    }
    // To a car body that runs along: no longitudinal part, so that the ground serves.
    let secondary = Bushing {
        along: [0.0, 2.0 * k4, 0.0],
        about: [2.0 * k5 * D[1] * D[1] + 4.0 * k3 * D[0] * D[0], 0.0, k6],
        damping: [0.0, 2.0 * d2, 0.0],
        turning: [2.0 * d1 * D[1] * D[1], 0.0, 0.0],
    };
    model.add(
        secondary,
        (3, at([0.0, 0.0, H[1]])),
        (0, at([middle, 0.0, height + H[1]])),
    );
    let system = System::new(model).unwrap();
    let mut x = system.initial_state();
    let speeds = system.layout().speeds;
    for (body, own, rate) in [
        (1, coordinate::FORWARD, speed),
        (1, coordinate::SPIN, speed / R),
        (2, coordinate::FORWARD, speed),
        (2, coordinate::SPIN, speed / R),
        (3, 0, speed),
    ] {
        x[speeds + system.position_of(body, own).unwrap()] = rate;
    }
    (system, x)
}

/// Returns the least damped vibration between 1 and 10 Hz.
pub fn least(speed: f64) -> [f64; 2] {
    let (mut system, x) = bogie(speed);
    let found = system.eigenvalues(0.0, &x, 20.0).unwrap();
    *found
        .iter()
        .find(|[_, imaginary]| (TAU..10.0 * TAU).contains(imaginary))
        .expect("a vibration")
}

/// Critical speed (m/s) and frequency (Hz).
pub fn critical() -> [f64; 2] {
    let found = bisection([50.0, 90.0], |speed| least(speed)[0]);
    [found, least(found)[1] / TAU]
}
