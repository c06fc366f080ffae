//! The control coil.

use super::*;
use crate::contact::seen_from_origin;

// Coil

fn stiff_table() -> CoilLaw {
    let points = vec![[-0.02, -10.0], [0.0, 5.0], [0.05, 60.0], [0.06, 260.0]];
    CoilLaw::Table(Characteristic::new(points).unwrap())
}

/// Force along the coil at a length.
fn push(coil: &Coil, length: f64) -> f64 {
    let relative = seen_from_origin([0.6 * length, 0.0, 0.8 * length], [0.0; 3], [0.0; 3]);
    let force = coil.on_body(&relative);
    close(force.length, length, 1e-15);
    close(force.force.0[0], 0.6 * force.spring, 1e-11);
    close(force.force.0[2], 0.8 * force.spring, 1e-11);
    force.spring
}

#[test]
fn force_of_a_coil_is_the_slope_of_its_energy() {
    for law in [CoilLaw::Linear { stiffness: 4000.0 }, stiff_table()] {
        for pulls in [true, false] {
            let mut one = coil([0.0; 3], [0.0; 3], 0.0, 0.3);
            (one.law, one.pulls) = (law.clone(), pulls);
            // From beyond the table on one side to beyond it on the other; not on its corners.
            for i in 0..60 {
                let length = 0.2 + 0.003_11 * f64::from(i);
                let slope = difference(1e-7, |d| vec![one.stored_energy(length + d)])[0];
                close(push(&one, length), -slope, 1e-5);
                if !pulls {
                    assert!(push(&one, length) >= 0.0);
                }
            }
            if matches!(law, CoilLaw::Linear { .. }) || pulls {
                close(one.stored_energy(0.3), 0.0, 1e-15);
            }
            // Energy is continuous, and never below that of the slack coil.
            let slack = one.stored_energy(0.5);
            for i in 0..2000 {
                let length = 0.2 + 0.0001 * f64::from(i);
                let step = one.stored_energy(length + 0.0001) - one.stored_energy(length);
                // The largest force is 260 + 20000 · 0.04 N.
                assert!(step.abs() <= 0.0001 * 1060.0);
                if !pulls {
                    assert!(one.stored_energy(length) >= slack - 1e-12);
                }
            }
        }
    }
}

#[test]
fn coil_forces_in_numbers() {
    let linear = coil([0.0; 3], [0.0; 3], 4000.0, 0.3);
    close(push(&linear, 0.25), 200.0, 1e-10);
    close(push(&linear, 0.35), -200.0, 1e-10);
    close(linear.stored_energy(0.25), 5.0, 1e-12);
    let mut table = linear.clone();
    table.law = stiff_table();
    // Compressions -0.04 (beyond: 15/0.02 = 750 N/m), -0.01, 0.02, 0.055, 0.08 (beyond: 20000 N/m)
    for (compression, force) in [
        (-0.04, -25.0),
        (-0.01, -2.5),
        (0.02, 27.0),
        (0.055, 160.0),
        (0.08, 660.0),
    ] {
        close(push(&table, 0.3 - compression), force, 1e-9);
    }
    // Trapezoids: 0.05 (5+60)/2, and from there on 0.01 (60+260)/2
    close(table.stored_energy(0.25), 1.625, 1e-12);
    close(table.stored_energy(0.24), 1.625 + 1.6, 1e-12);
    close(table.stored_energy(0.32), 0.05, 1e-12);
    let mut slack = linear.clone();
    slack.pulls = false;
    close(push(&slack, 0.35), 0.0, 0.0);
    close(push(&slack, 0.25), 200.0, 1e-10);
    let mut slack_table = table.clone();
    slack_table.pulls = false;
    close(push(&slack_table, 0.32), 0.0, 0.0);
    // The force comes to zero at a compression of -1/150; what it stores up to zero compression is
    // 5²/(2·750).
    close(slack_table.stored_energy(0.4), -25.0 / 1500.0, 1e-12);
}

#[test]
fn damping_and_line_of_action_of_a_coil() {
    let mut random = Random(9);
    for _ in 0..200 {
        let (end, cg): ([f64; 3], [f64; 3]) = (random.vector(0.3), random.vector(0.3));
        let position = add(random.vector(0.3), [0.0, 0.0, 2.0]);
        let (velocity, omega): ([f64; 3], [f64; 3]) = (random.vector(1.0), random.vector(1.0));
        let relative = seen_from_origin(position, velocity, omega);
        let mut at_end = coil(end, end, 4000.0, 1.9);
        (at_end.damping, at_end.rotational_damping) = (70.0, 9.0);
        let mut through_cg = at_end.clone();
        through_cg.acts_at = Vector(cg);
        let d = add(position, end);
        let rate = add(velocity, cross(omega, end));
        let expected: [f64; 3] =
            std::array::from_fn(|k| 4000.0 * (1.9 - norm(&d)) * d[k] / norm(&d) - 70.0 * rate[k]);
        for (one, at) in [(&at_end, end), (&through_cg, cg)] {
            let got = one.on_body(&relative);
            // No moment about the point where it acts, but for the brake.
            let moment = add(cross(at, expected), times(omega, -9.0));
            for k in 0..3 {
                close(got.force.0[k], expected[k], 1e-10);
                close(got.moment.0[k], moment[k], 1e-10);
            }
            let spring_power =
                -4000.0 * (norm(&d) - 1.9) * (0..3).map(|k| d[k] * rate[k]).sum::<f64>() / norm(&d);
            close(
                got.loss,
                70.0 * norm(&rate).powi(2) + 9.0 * norm(&omega).powi(2),
                1e-10,
            );
            // Power on the body = spring's - loss + guide's.
            let power: f64 = (0..3)
                .map(|k| got.force.0[k] * velocity[k] + got.moment.0[k] * omega[k])
                .sum();
            close(power, spring_power - got.loss + got.guide_power, 1e-9);
        }
        assert_eq!(at_end.on_body(&relative).guide_power, 0.0);
    }
}

/// A table whose rows are next to each other was taken, and its stiffness was infinite.
#[test]
fn issue_029_points_too_close_to_each_other_make_no_characteristic() {
    let found = Characteristic::new(vec![[0.0, 0.0], [1e-310, 900.0], [1.0, 1979.0]]);
    let steep = mechanics::characteristic::CharacteristicError::Steep { index: 2 };
    assert_eq!(found, Err(steep));
}
