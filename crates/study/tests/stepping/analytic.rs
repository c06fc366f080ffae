//! Driven wedges against closed forms, balances and differences.

use study::stepping::{CoilInput, Neighbours, SteppedWedge};

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
    let ledger = wedge.ledger();
    assert!(ledger.motion_work > 100.0, "{ledger:?}");
    assert!(ledger.residual.abs() < 1e-5 * ledger.motion_work, "{ledger:?}");
}

/// The sum of all forces on wedge and neighbours, and of their moments, is nothing.
#[test]
fn action_and_reaction_balance() {
    for name in [YAWED, "vdrun_toe_in_0.2_psi_0.012"] {
        let case = case(name, &[]);
        let mut wedge = at(&case, 2.2, 1e-3);
        let seen = wedge.observe();
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
