//! The whole right-hand side against a second derivation that shares no code with it: Lagrange's equations
//! from a numeric kinetic energy, contacts corner by corner, inch and pound-force (`common/plain.rs`).

use crate::common;
use common::plain::{Answer, Plain};
use common::{INCH, LBF, LBF_IN, LBF_PER_IN, POUND, Random};
use integrate::Problem;
use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use wedge::parameters::{Damping, Parameters};
use wedge::{Wedge, thesis};

/// Returns the same wedge for the program, SI.
fn parameters(p: &Plain) -> Parameters {
    let damping = if p.variable {
        Damping::Variable
    } else {
        Damping::Constant
    };
    let mut s = thesis::parameters(damping, p.toe, p.yaw);
    s.wedge.angle = p.angle.to_radians();
    s.wedge.mass = p.weight * POUND;
    s.wedge.inertia = p.inertia.map(|i| i * POUND * INCH * INCH);
    s.wedge.center_of_gravity = p.cg.map(|c| c * INCH);
    s.coil.law = CoilLaw::Linear {
        stiffness: p.coil_stiffness * LBF_PER_IN,
    };
    s.coil.free_length = p.free_length * INCH;
    s.coil.nominal_length = p.nominal_length * INCH;
    s.coil.damping = p.coil_damping * LBF_PER_IN;
    s.coil.rotational_damping = p.turn_damping * LBF_IN;
    s.coil.pulls = p.pulls;
    s.coil.acts_at = if p.at_seat {
        CoilLine::Seat
    } else {
        CoilLine::CenterOfGravity
    };
    s.contact.stiffness = p.corner_stiffness * LBF_PER_IN;
    s.contact.damping = p.corner_damping * LBF_PER_IN;
    let law = FrictionLaw::Tanh {
        reference_speed: p.reference_speed * INCH,
    };
    (s.column_friction.coefficient, s.column_friction.law) = (p.friction[0], law);
    (s.slope_friction.coefficient, s.slope_friction.law) = (p.friction[1], law);
    s
}

/// Returns the program's state from (x, z, pitch, yaw) and rates in inches.
fn state(wedge: &Wedge, q: &[f64; 4], u: &[f64; 4]) -> Vec<f64> {
    let mut x = wedge.initial_state.clone();
    for (i, unit) in [INCH, INCH, 1.0, 1.0].into_iter().enumerate() {
        (x[i], x[4 + i]) = (q[i] * unit, u[i] * unit);
    }
    x
}

/// Returns a random state near the nominal position: corners from open to a tenth of an inch deep, speeds
/// from far below the reference speed to inches a second.
fn random_state(random: &mut Random, fast: bool) -> (f64, [f64; 4], [f64; 4]) {
    let t = random.between(0.0, 3.2);
    let q = [
        random.spread(1e-4, 5e-2),
        (2.0 * t).sin() + random.spread(1e-4, 0.1),
        random.spread(1e-5, 2e-2),
        random.spread(1e-5, 2e-2),
    ];
    let top = if fast { 10.0 } else { 1e-2 };
    let mut u = std::array::from_fn(|_| random.spread(1e-5, top));
    if !fast {
        // The wedge goes with the bolster: sticking corners.
        u[1] += 2.0 * (2.0 * t).cos();
    }
    (t, q, u)
}

/// Compares everything; returns the largest difference of an acceleration, relative to the largest in its
/// group.
fn compare(wedge: &mut Wedge, answer: &Answer, t: f64, x: &[f64]) -> f64 {
    let mut dx = vec![0.0; x.len()];
    wedge.system.derivative(t, x, &mut dx);
    let a: Vec<f64> = [INCH, INCH, 1.0, 1.0]
        .iter()
        .zip(&dx[4..8])
        .map(|(unit, a)| a / unit)
        .collect();
    let b = &answer.accelerations;
    let mut worst = 0.0_f64;
    // What one group of accelerations leaves in the other by rounding: the arm of the mass is inches.
    let all = 1e-4 * b.iter().fold(0.0_f64, |s, b| s.max(b.abs()));
    for group in [0..2, 2..4] {
        let scale = group.clone().fold(all, |s, i| s.max(b[i].abs()));
        for i in group {
            worst = worst.max((a[i] - b[i]).abs() / scale);
        }
    }
    let totals = wedge.system.observe(t, x);
    for (face, gaps) in totals.faces.iter().zip(answer.gaps.chunks(4)) {
        for (point, gap) in face.points.iter().zip(gaps) {
            assert!(
                (point.gap / INCH - gap).abs() < 2e-14,
                "{} {gap}",
                point.gap / INCH
            );
        }
    }
    let (longitudinal, vertical) = common::column_forces(&totals);
    let force = answer.longitudinal.max(1.0);
    assert!((longitudinal / LBF - answer.longitudinal).abs() < 1e-9 * force);
    assert!((vertical / LBF - answer.vertical).abs() < 1e-9 * force);
    // The rates of the quadratures, through the ledger.
    let mut powers = totals.clone();
    powers.quadratures = dx[8..].to_vec();
    let ledger = wedge::outputs::Outputs::ledger(&wedge.system, &powers, 0.0);
    let pairs = [
        (ledger.motion_work, answer.drive),
        (ledger.coil_guide_work, answer.guide),
        (ledger.side_frame_friction_loss, answer.friction_loss[0]),
        (ledger.bolster_friction_loss, answer.friction_loss[1]),
        (ledger.contact_damping_loss, answer.contact_damping_loss),
        (ledger.coil_damping_loss, answer.coil_damping_loss),
    ];
    let size = pairs.iter().fold(0.0_f64, |s, (_, p)| s.max(p.abs()));
    for (name, (power, plain)) in [
        "motion",
        "guide",
        "column",
        "slope",
        "contact damping",
        "coil damping",
    ]
    .iter()
    .zip(pairs)
    {
        assert!(
            (power / LBF_IN - plain).abs() < 1e-9 * size,
            "{name}: {} {plain}",
            power / LBF_IN
        );
    }
    worst
}

fn check(plain: &Plain, count: usize, seed: u64) -> [usize; 9] {
    let mut wedge = Wedge::new(parameters(plain)).unwrap();
    let mut random = Random(seed);
    let mut totals = [0; 9];
    for i in 0..count {
        let (t, q, u) = random_state(&mut random, i % 2 == 0);
        let answer = plain.evaluate(t, &q, &u);
        let x = state(&wedge, &q, &u);
        let worst = compare(&mut wedge, &answer, t, &x);
        assert!(worst < 1e-9, "state {i}: {worst:e}, {answer:?}");
        totals[answer.closed] += 1;
    }
    totals
}

#[test]
fn the_wedge_of_the_thesis() {
    let mut totals = [0; 9];
    for (k, variable) in [true, false].into_iter().enumerate() {
        for (i, toe) in [-1.0, 0.0, 1.0].into_iter().enumerate() {
            for (j, yaw) in [0.0, common::YAW].into_iter().enumerate() {
                let plain = Plain::thesis(variable, toe * common::TOE, yaw);
                let counts = check(&plain, 100, (100 * k + 10 * i + j) as u64);
                for (sum, count) in totals.iter_mut().zip(counts) {
                    *sum += count;
                }
            }
        }
    }
    // The states see everything from the free wedge to all eight corners at once.
    assert!(totals.iter().all(|count| *count > 4), "{totals:?}");
}

#[test]
fn other_wedges() {
    let mut random = Random(7);
    for k in 0..40 {
        let mut plain = Plain::thesis(k % 2 == 0, random.spread(1e-4, 2e-2), random.spread(1e-4, 3e-2));
        plain.angle = random.between(20.0, 55.0);
        plain.weight = random.between(20.0, 120.0);
        // A principal moment is at most the sum of the two others; all three differ, so that gyroscopic terms
        // show.
        plain.inertia = [
            random.between(400.0, 700.0),
            random.between(100.0, 300.0),
            random.between(450.0, 650.0),
        ];
        plain.cg = [
            random.between(-1.5, -0.5),
            random.between(-0.5, 0.5),
            random.between(1.0, 3.0),
        ];
        plain.coil_damping = random.between(0.0, 20.0);
        plain.turn_damping = random.between(0.0, 20.0);
        plain.at_seat = k % 4 < 2;
        plain.pulls = k % 3 > 0;
        plain.corner_damping = if k % 8 < 4 {
            random.between(0.0, 500.0)
        } else {
            0.0
        };
        plain.friction = [random.between(0.0, 0.7), random.between(0.0, 0.7)];
        plain.reference_speed = random.spread(1e-4, 1e-1).abs();
        check(&plain, 25, 1000 + k);
    }
}

/// Free flight: no corner closed, so that the inertia forces of fast turning are all there is besides coil
/// and weight.
#[test]
fn turning_fast_in_the_air() {
    let mut random = Random(11);
    for k in 0..100_u64 {
        let mut plain = Plain::thesis(true, 0.0, 0.0);
        plain.inertia = [600.0, 150.0, 500.0];
        plain.cg = [-1.0734, 0.4, 2.0417];
        plain.at_seat = k % 2 == 0;
        let mut wedge = Wedge::new(parameters(&plain)).unwrap();
        let q = [1.5, -5.0, random.between(-0.1, 0.1), random.between(-0.1, 0.1)];
        let u = std::array::from_fn(|_| random.between(-50.0, 50.0));
        let answer = plain.evaluate(0.0, &q, &u);
        assert_eq!(answer.closed, 0);
        let x = state(&wedge, &q, &u);
        let worst = compare(&mut wedge, &answer, 0.0, &x);
        assert!(worst < 1e-9, "state {k}: {worst:e}, {answer:?}");
    }
}

/// `(σ I - J) y = b` is solved with the derivative of the *second* derivation's accelerations.
#[test]
fn the_linear_systems_are_those_of_the_second_derivation() {
    let mut random = Random(5);
    for k in 0..60 {
        let plain = Plain::thesis(k % 2 == 0, common::TOE, common::YAW);
        let mut wedge = Wedge::new(parameters(&plain)).unwrap();
        let (t, q, u) = random_state(&mut random, false);
        let x = state(&wedge, &q, &u);
        let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        wedge.system.derivative(t, &x, &mut dx);
        wedge.system.linearize(t, &x, &dx, &mut df_dt);
        let shift = 1e4;
        wedge.system.factor(shift).unwrap();
        let b: Vec<f64> = (0..x.len())
            .map(|i| if i < 4 { 0.0 } else { random.between(-1.0, 1.0) })
            .collect();
        let mut y = b.clone();
        wedge.system.solve(&mut y);
        // The largest step along y that leaves no corner's side and stays far below the reference speed.
        let units = [INCH, INCH, 1.0, 1.0];
        let direction: Vec<f64> = (0..8).map(|i| y[i] / units[i % 4]).collect();
        let size = direction.iter().fold(0.0_f64, |s, d| s.max(d.abs()));
        let h = 1e-7 / size;
        let at = |h: f64, dt: f64| {
            let q: [f64; 4] = std::array::from_fn(|i| q[i] + h * direction[i]);
            let u: [f64; 4] = std::array::from_fn(|i| u[i] + h * direction[4 + i]);
            plain.evaluate(t + dt, &q, &u)
        };
        if at(h, 0.0).closed != at(-h, 0.0).closed {
            continue;
        }
        let (front, back) = (at(h, 0.0).accelerations, at(-h, 0.0).accelerations);
        let (later, before) = (at(0.0, 1e-7).accelerations, at(0.0, -1e-7).accelerations);
        let mut sizes = [0.0_f64; 2];
        let mut errors = [0.0_f64; 2];
        for i in 0..4 {
            let along = (front[i] - back[i]) / (2.0 * h) * units[i];
            errors[0] = errors[0].max((shift * y[4 + i] - along - b[4 + i]).abs());
            sizes[0] = sizes[0].max(along.abs()).max(shift * y[4 + i].abs());
            let rate = (later[i] - before[i]) / 2e-7 * units[i];
            errors[1] = errors[1].max((df_dt[4 + i] - rate).abs());
            sizes[1] = sizes[1].max(rate.abs());
        }
        for (what, (error, size)) in ["J", "df/dt"].iter().zip(errors.iter().zip(sizes)) {
            assert!(*error <= 1e-4 * size, "state {k}, {what}: {error:e} of {size:e}");
        }
    }
}
