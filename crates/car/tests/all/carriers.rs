//! Adapters that pitch with their side frames: the moment of longitudinal forces is carried.

use crate::common;
use car::{Car, Course, Parameters};
use common::{POUND_FORCE, loaded, tangent};
use integrate::{Integrator, Method, Options, Problem};
use mechanics::motion::Motion;
use truck::Adapter;

/// Mean moments about the lateral axis at the rails below the body's center of gravity, N·m, and the mean
/// of the load that the car transfers.
struct Balance {
    /// Of wheel loads and weights: the transfer.
    transferred: f64,
    /// Of forces from outside and inertia.
    wanted: f64,
}

/// Runs a car, with a torque on each wheelset (N·m, positive forward), and compares moments in the last
/// second.
fn balance(parameters: &Parameters, torque: f64) -> Balance {
    const SETTLED: f64 = 7.0;
    const END: f64 = 10.0;
    let mut car = Car::new(parameters).unwrap();
    for number in car.numbers.wheelsets {
        car.system
            .set_load(number, [0.0, 0.0, 0.0, torque, 0.0, 0.0])
            .unwrap();
    }
    let mut system = car.system.clone();
    let options = Options {
        relative_tolerance: 1e-6,
        ..Options::of(Method::Esdirk3)
    };
    let mut integrator = Integrator::new(car.system.clone(), options, 0.0, &car.initial_state).unwrap();
    let mut buffer = car.initial_state.clone();
    let mut rates = vec![0.0; buffer.len()];
    let numbers = [
        vec![car.numbers.body],
        car.numbers.bolsters.to_vec(),
        car.numbers.side_frames.concat(),
        car.numbers.wedges.concat(),
        car.numbers.wheelsets.to_vec(),
    ]
    .concat();
    let (mut rows, mut transferred, mut others) = (0.0, 0.0, 0.0);
    // Angular momentum about the lateral axis, at rest along the track's x: first and last.
    let mut momentum = Vec::new();
    let mut next = SETTLED;
    while integrator.time() < END {
        integrator.step_to(END).unwrap();
        while next <= integrator.time() && next <= END {
            integrator.interpolate(next, &mut buffer);
            let seen = system.observe(next, &buffer);
            system.derivative(next, &buffer, &mut rates);
            let loads = car.loads(&seen, &rates);
            let [origin, ..] = seen.bodies[car.numbers.body].center_of_gravity.0;
            let mut sum = 0.0;
            let mut own = 0.0;
            for number in &numbers {
                let (state, body) = (&seen.bodies[*number], &system.bodies()[*number]);
                let [x, _, z] = state.center_of_gravity.0;
                let [vx, _, vz] = state.velocity.0;
                sum += body.mass * parameters.gravity * (x - origin);
                // Pitch is nose down: z p_x - x p_z + I ω_y; the origin moves forward with the car.
                let [.., lateral] = body.inertia;
                let about = if car.numbers.wheelsets.contains(number) {
                    body.inertia[0]
                } else {
                    lateral
                };
                own += body.mass * (z * vx - (x - origin) * vz) + about * state.angular_velocity.0[1];
            }
            for (w, number) in car.numbers.wheelsets.into_iter().enumerate() {
                let [x, ..] = seen.bodies[number].origin.0;
                let carried: f64 = loads.wheels[w].iter().map(|wheel| wheel.vertical).sum();
                sum -= (x - origin) * carried;
            }
            momentum.push((next, own));
            let mut outside = 4.0 * torque;
            for (w, wheels) in loads.wheels.iter().enumerate() {
                // Rails that give way let longitudinal forces act lower.
                let sunk = [0, 1].map(|side| car.rail(&seen, w, side).0[2]);
                outside -= wheels[0].longitudinal * sunk[0] + wheels[1].longitudinal * sunk[1];
            }
            for (end, coupler) in loads.couplers.iter().enumerate() {
                if let Some(own) = coupler {
                    let height = parameters.couplers.height;
                    let sinks = car.statics(&seen).couplers[end] - height;
                    outside -= [1.0, -1.0][end] * own.force * (height + sinks);
                }
            }
            transferred += sum;
            others += outside;
            rows += 1.0;
            next += 0.01;
        }
    }
    // Its rate by least squares.
    let mean = momentum.iter().fold([0.0; 2], |sum, own| {
        [sum[0] + own.0 / rows, sum[1] + own.1 / rows]
    });
    let both = momentum.iter().fold([0.0; 2], |sum, own| {
        let time = own.0 - mean[0];
        [sum[0] + time * (own.1 - mean[1]), sum[1] + time * time]
    });
    Balance {
        transferred: transferred / rows,
        wanted: both[0] / both[1] - others / rows,
    }
}

fn coasting(adapter: Adapter) -> Parameters {
    let mut own = loaded(tangent(400.0), 20.0);
    own.drive = car::Drive::Coasting;
    for truck in &mut own.trucks {
        truck.wheelsets.as_mut().unwrap().adapter = adapter;
    }
    own
}

/// Traction and braking by torques on the axles, and draft at one end: what wheels and weights transfer
/// is the moment of inertia and of forces from outside, to 0.1 %.
#[test]
fn analytic_longitudinal_forces_of_adapters_leave_no_moment() {
    for adapter in [Adapter::friction(), Adapter::pad()] {
        for torque in [4e3, -4e3] {
            let own = balance(&coasting(adapter), torque);
            let error = (own.transferred - own.wanted).abs();
            assert!(
                error < 1e-3 * own.wanted.abs() && own.wanted.abs() > 3e4,
                "{torque} N m: {} N m of {} N m",
                own.transferred,
                own.wanted
            );
        }
        let mut pulled = coasting(adapter);
        pulled.couplers.ends[0].course = Course::Time(Motion::Constant(-25e3 * POUND_FORCE));
        let own = balance(&pulled, 0.0);
        let error = (own.transferred - own.wanted).abs();
        assert!(
            error < 1e-3 * own.wanted.abs(),
            "draft: {} N m of {} N m",
            own.transferred,
            own.wanted
        );
    }
}
