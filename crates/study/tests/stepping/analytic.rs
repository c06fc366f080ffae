//! Driven wedges against closed forms, balances and differences.

use numerics::scalar::Dual;
use study::stepping::{CoilInput, Equations, Neighbours, Reading, SteppedWedge};

use crate::common::{YAWED, at, case, value};

/// The power that the neighbours deliver, which the ledger integrates, is force and moment times the rates.
#[test]
fn force_and_moment_times_the_rates_are_the_power_of_the_motions() {
    let yaw = "bolster.yaw={ shape = \"ramp\", amplitude = \"0.012 rad\", duration = \"1 s\" }";
    let case = case(YAWED, &[yaw]);
    let mut wedge = SteppedWedge::new(&case).unwrap();
    for number in 1..=800 {
        let time = f64::from(number) * 1e-3;
        wedge
            .step_to(&Neighbours::of(&case.parameters, time), time)
            .unwrap();
        let at = *wedge.neighbours();
        let reading = wedge.reading().unwrap();
        let (mut sum, mut size) = (0.0, 0.0);
        for (place, load) in [
            (at.side_frame, reading.on_side_frame),
            (at.bolster, reading.on_bolster),
        ] {
            let forces = (0..3).map(|k| load.force.0[k] * place.rate[k]);
            // The bolster only yaws: its angular velocity is the rate of its yaw.
            for power in forces.chain([load.moment.0[2] * place.rate[5]]) {
                sum -= power;
                size += f64::abs(power);
            }
        }
        let expected = wedge.evaluation().powers[0];
        assert!((sum - expected).abs() < 1e-12 * size, "{time}: {sum} {expected}");
    }
    let (_, ledger) = wedge.energies();
    assert!(ledger.motion_work > 100.0, "{ledger:?}");
    assert!(ledger.residual.abs() < 1e-5 * ledger.motion_work, "{ledger:?}");
}

/// The sum of all forces on wedge and neighbours, and of their moments, is nothing.
#[test]
fn action_and_reaction_balance() {
    for name in [YAWED, "vdrun_toe_in_0.2_psi_0.012"] {
        let case = case(name, &[]);
        let mut wedge = at(&case, 2.2, 1e-3);
        let seen = {
            let parameters = case.parameters.clone();
            let mut equations = Equations::new(
                &parameters,
                &Neighbours::of(&parameters, 0.0),
                CoilInput::Internal,
            )
            .unwrap();
            equations
                .set_states(wedge.time(), wedge.equations().states())
                .unwrap();
            equations.set_neighbours(wedge.neighbours()).unwrap();
            equations.observe()
        };
        let evaluation = wedge.evaluation().clone();
        let largest = evaluation
            .loads
            .iter()
            .fold(0.0, |most: f64, load| most.max(load.force.0[2].abs()));
        assert!(largest > 1000.0);
        for k in 0..3 {
            let force: f64 = evaluation.loads.iter().map(|load| load.force.0[k]).sum();
            let moment: f64 = evaluation
                .loads
                .iter()
                .zip(&seen.bodies)
                .map(|(load, body)| load.moment.0[k] + body.origin.cross::<f64, f64>(load.force).0[k])
                .sum();
            assert!(force.abs() < 1e-9 * largest, "{name} {k}: {force}");
            assert!(moment.abs() < 1e-9 * largest, "{name} {k}: {moment}");
        }
        // And it is what a run's table says, about another point.
        for (load, body) in [
            (&evaluation.loads[0], "side_frame"),
            (&evaluation.loads[1], "bolster"),
        ] {
            for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
                let column = value(&mut wedge, &format!("net_force_on_{body}_{axis}"));
                assert!(
                    (column - load.force.0[k]).abs() < 1e-9 * largest,
                    "{name} {body} {axis}"
                );
            }
        }
    }
}

/// A coil whose stiffness or force is given as the parameters have it is the coil of the parameters.
#[test]
fn a_coil_from_outside_is_the_coil_inside() {
    let case = case("cdrun_toe_out_0.2_psi_0.012", &[]);
    let mut inside = at(&case, 0.2, 1e-3);
    let mut outside = SteppedWedge::new(&case).unwrap();
    let stiffness = match case.parameters.coil.law {
        mechanics::coil::CoilLaw::Linear { stiffness } => stiffness,
        _ => panic!("a linear coil"),
    };
    outside.set_coil(CoilInput::Stiffness(stiffness)).unwrap();
    crate::common::drive(&case, &mut outside, 0.2, 1e-3);
    assert_eq!(inside.row(), outside.row());

    let here = inside.reading().unwrap();
    assert!((here.coil_force - stiffness * here.coil_compression).abs() < 1e-9 * here.coil_force);
    outside.set_coil(CoilInput::Force(here.coil_force)).unwrap();
    let given = outside.reading().unwrap();
    assert_eq!(given.coil_force, here.coil_force);
    let error = given.on_bolster.force.0[2] - here.on_bolster.force.0[2];
    assert!(error.abs() < 1e-9 * here.coil_force, "{error}");
}

fn flat(reading: &Reading<f64>) -> Vec<f64> {
    let mut out = Vec::new();
    for load in [reading.on_side_frame, reading.on_bolster] {
        out.extend(load.force.0);
        out.extend(load.moment.0);
    }
    out.extend([reading.coil_compression, reading.coil_force]);
    out.extend(reading.normal_forces);
    out.extend(reading.friction_losses);
    out
}

fn slopes(reading: &Reading<Dual<1>>) -> Vec<f64> {
    let mut out = Vec::new();
    for load in [reading.on_side_frame, reading.on_bolster] {
        out.extend(load.force.0.map(|v| v.derivative[0]));
        out.extend(load.moment.0.map(|v| v.derivative[0]));
    }
    out.extend([reading.coil_compression, reading.coil_force].map(|v| v.derivative[0]));
    out.extend(reading.normal_forces.map(|v| v.derivative[0]));
    out.extend(reading.friction_losses.map(|v| v.derivative[0]));
    out
}

/// Every directional derivative of rates and readings against central differences, by each state and each
/// coordinate of the neighbours.
#[test]
fn derivatives_along_directions_are_those_of_the_rates_and_forces() {
    for overrides in [
        &[][..],
        &["friction.law=\"bristle\"", "contact.damping=\"50 lbf s/in\""][..],
    ] {
        let case = case(YAWED, overrides);
        let mut wedge = at(&case, 0.3, 1e-3);
        let (time, states) = (wedge.time(), wedge.equations().states().to_vec());
        let neighbours = *wedge.neighbours();
        let parameters = case.parameters.clone();
        let mut equations = Equations::new(
            &parameters,
            &Neighbours::of(&parameters, 0.0),
            CoilInput::Internal,
        )
        .unwrap();
        let n = states.len();
        let mut evaluate = |x: &[f64], at: &Neighbours| {
            equations.set_states(time, x).unwrap();
            equations.set_neighbours(at).unwrap();
            let mut rates = vec![0.0; n];
            equations.rates(&mut rates).unwrap();
            rates.extend(flat(&equations.reading().unwrap()));
            rates
        };
        let system = wedge.equations().system().clone();
        for direction in 0..n + 24 {
            let mut change = vec![0.0; n];
            let mut moved = Neighbours::default();
            // Far below the lengths over which the laws bend, far above rounding.
            let h = 3e-9;
            if direction < n {
                change[direction] = 1.0;
            } else {
                let k = direction - n;
                let place = if k < 12 {
                    &mut moved.side_frame
                } else {
                    &mut moved.bolster
                };
                let list = if k % 12 < 6 {
                    &mut place.position
                } else {
                    &mut place.rate
                };
                list[k % 6] = 1.0;
            }
            let product = wedge.jacobian_vector_product(&change, &moved, 0.0).unwrap();
            let reading = Reading::of(&product.evaluation, &system, &parameters).unwrap();
            let mut exact = product.rates;
            exact.extend(slopes(&reading));
            let shifted = |sign: f64| {
                let x: Vec<f64> = states
                    .iter()
                    .zip(&change)
                    .map(|(x, c)| x + sign * h * c)
                    .collect();
                let mut at = neighbours;
                for (place, moved) in [
                    (&mut at.side_frame, &moved.side_frame),
                    (&mut at.bolster, &moved.bolster),
                ] {
                    for k in 0..6 {
                        place.position[k] += sign * h * moved.position[k];
                        place.rate[k] += sign * h * moved.rate[k];
                    }
                }
                (x, at)
            };
            let ((xp, ap), (xm, am)) = (shifted(1.0), shifted(-1.0));
            let (plus, minus) = (evaluate(&xp, &ap), evaluate(&xm, &am));
            for (index, exact) in exact.iter().enumerate() {
                let difference = (plus[index] - minus[index]) / (2.0 * h);
                // What rounding leaves of a difference of values of this size.
                let noise = 1e-13 * plus[index].abs().max(1e5) / h;
                let error = (difference - exact).abs();
                assert!(
                    error < 1e-5 * exact.abs() + noise,
                    "direction {direction}, component {index}: {exact} against {difference}"
                );
            }
        }
    }
}
