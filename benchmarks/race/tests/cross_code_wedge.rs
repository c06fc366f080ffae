//! Agreement with an independent code: the second derivation of the equations of motion
//! (`wedge/tests/common/plain.rs`), integrated by diffsol's implicit Runge-Kutta methods, against the wedge
//! as it is.
//!
//! Two yawed cases, over the release from the start, its ringing, and sliding under load (with variable
//! damping the bolster goes down first here: going up it would leave the wedge free).
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

#[path = "../../../crates/wedge/tests/common/mod.rs"]
mod common;

use common::plain::Plain;
use common::{INCH, LBF, TOE, YAW, column_forces, run};
use diffsol::{NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};
use mechanics::motion::Motion;
use wedge::parameters::Damping;
use wedge::{WEDGE, Wedge, thesis};

/// x, z (in), pitch, yaw (rad), longitudinal and vertical force (lbf).
type Row = [f64; 6];

const INTERVAL: f64 = 0.05;
const UNTIL: f64 = 0.6;

/// Returns the independent code's rows.
fn independent(plain: &Plain, tolerance: f64) -> Vec<Row> {
    let rates = |t: f64, x: &[f64], y: &mut [f64]| {
        let (q, u) = (std::array::from_fn(|i| x[i]), std::array::from_fn(|i| x[4 + i]));
        let answer = plain.evaluate(t, &q, &u);
        y[..4].copy_from_slice(&u);
        y[4..].copy_from_slice(&answer.accelerations);
    };
    let mut problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([
            tolerance,
            tolerance,
            tolerance,
            tolerance,
            1e2 * tolerance,
            1e2 * tolerance,
            1e2 * tolerance,
            1e2 * tolerance,
        ])
        .rhs_implicit(
            |x: &[f64], _: &[f64], t: f64, y: &mut [f64]| rates(t, x, y),
            |x: &[f64], _: &[f64], t: f64, v: &[f64], y: &mut [f64]| {
                // Differences: a step of 1e-7 in stays on one side of the contacts, and far below the
                // reference speed.
                let size = v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                if size == 0.0 {
                    y.fill(0.0);
                    return;
                }
                let h = 1e-7 / size;
                let at = |h: f64| -> Vec<f64> { x.iter().zip(v).map(|(x, v)| x + h * v).collect() };
                let mut back = vec![0.0; 8];
                rates(t, &at(h), y);
                rates(t, &at(-h), &mut back);
                for (y, back) in y.iter_mut().zip(back) {
                    *y = (*y - back) / (2.0 * h);
                }
            },
        )
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.fill(0.0), 8)
        .build()
        .unwrap();
    // Newton's method fails now and then where a corner opens or closes, and the Jacobian changes fast.
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    problem.ode_options.max_error_test_failures = 1000;
    problem.ode_options.update_jacobian_after_steps = 1;
    problem.ode_options.update_rhs_jacobian_after_steps = 1;
    let mut solver = problem.esdirk34::<NalgebraLU<f64>>().unwrap();
    let row = |t: f64, x: &[f64]| {
        let (q, u) = (std::array::from_fn(|i| x[i]), std::array::from_fn(|i| x[4 + i]));
        let answer = plain.evaluate(t, &q, &u);
        [x[0], x[1], x[2], x[3], answer.longitudinal, answer.vertical]
    };
    let mut rows = vec![row(0.0, &[0.0; 8])];
    for k in 1..=(UNTIL / INTERVAL).round() as u32 {
        let time = f64::from(k) * INTERVAL;
        solver.set_stop_time(time).unwrap();
        while !matches!(solver.step().unwrap(), OdeSolverStopReason::TstopReached) {}
        rows.push(row(time, &solver.state().y.clone_as_vec()));
    }
    println!("{} steps", solver.get_statistics().number_of_steps);
    rows
}

fn own(damping: Damping, toe: f64, amplitude: f64, tolerance: f64) -> Vec<Row> {
    let mut parameters = thesis::parameters(damping, toe, YAW);
    parameters.bolster.coordinates[2] = Motion::Sine {
        amplitude: amplitude * INCH,
        angular_frequency: 2.0,
        phase: 0.0,
    };
    let wedge = Wedge::new(parameters).unwrap();
    let mut rows = Vec::new();
    run(&wedge, tolerance, (UNTIL, INTERVAL), |observation, _| {
        let q = observation.bodies[WEDGE].coordinates;
        let (longitudinal, vertical) = column_forces(observation);
        rows.push([
            q[0] / INCH,
            q[2] / INCH,
            q[4],
            q[5],
            longitudinal / LBF,
            vertical / LBF,
        ]);
    });
    rows
}

/// Largest differences: displacements (in), angles (rad), forces (lbf).
fn differences(a: &[Row], b: &[Row]) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for (a, b) in a.iter().zip(b) {
        for i in 0..6 {
            worst[i / 2] = worst[i / 2].max((a[i] - b[i]).abs());
        }
    }
    worst
}

/// The independent code carries an error of 1e-7 in a step, which a face of 1e6 lbf/in makes 0.1 lbf; its
/// result at ten times that tells how far these errors add up. The wedge's own run at 1e-9 must lie within
/// that band around the independent one; and the band is narrow.
#[test]
fn yawed_cases_agree() {
    for (damping, toe, amplitude) in [(Damping::Variable, TOE, -1.0), (Damping::Constant, TOE, 1.0)] {
        let mut plain = Plain::thesis(damping == Damping::Variable, toe, YAW);
        plain.amplitude = amplitude;
        let clock = std::time::Instant::now();
        let (coarse, fine) = (independent(&plain, 1e-6), independent(&plain, 1e-7));
        println!("{:?}", clock.elapsed());
        let found = own(damping, toe, amplitude, 1e-9);
        let band = differences(&coarse, &fine);
        let worst = differences(&found, &fine);
        println!("{damping:?}: independent code {band:?}, against it {worst:?}");
        assert_eq!(found.len(), fine.len());
        for (worst, band) in worst.iter().zip(band) {
            assert!(*worst < band, "{worst:e} {band:e}");
        }
        let limits = [1e-5, 1e-5, 5.0];
        assert!(worst.iter().zip(limits).all(|(w, l)| *w < l), "{worst:?}");
        // There is something to agree on.
        let force = found.iter().fold(0.0_f64, |m, row| m.max(row[5].abs()));
        assert!(force > 700.0, "{force}");
    }
}
