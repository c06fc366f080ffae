//! Comparison of the Jacobian matrix and of the derivative by time with differences of the right-hand side.

use integrate::Problem;
use mechanics::coil::CoilLaw;
use mechanics::system::{Model, System};
use nalgebra::DMatrix;

use super::common::{Random, difference, rates};

/// Returns the smooth branches, which must not change within a difference: on which piece every law is.
fn pieces(system: &mut System, time: f64, x: &[f64]) -> Vec<i64> {
    let observation = system.observe(time, x);
    let mut out = Vec::new();
    for (mounted, face) in system.faces().iter().zip(&observation.faces) {
        let bristle = mounted.internal_count > 0;
        for point in &face.points {
            out.push(i64::from(point.gap < 0.0));
            out.push(i64::from(point.normal > 0.0));
            out.push(i64::from(bristle && point.friction.load <= 1.0));
        }
    }
    for (mounted, coil) in system.coils().iter().zip(&observation.coils) {
        out.push(i64::from(coil.coil.spring > 0.0));
        if let CoilLaw::Table(table) = &mounted.element.law {
            let compression = mounted.element.free_length - coil.coil.length;
            out.push(table.points().iter().filter(|p| p[0] <= compression).count() as i64);
        }
    }
    out
}

fn norm(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Returns the inverse, by Gauss-Jordan elimination with row exchange.
fn inverse(mut a: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = a.len();
    let mut b: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs()))
            .unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        let p = a[k][k];
        for j in 0..n {
            a[k][j] /= p;
            b[k][j] /= p;
        }
        for i in 0..n {
            let factor = a[i][k];
            if i != k && factor != 0.0 {
                for j in 0..n {
                    a[i][j] -= factor * a[k][j];
                    b[i][j] -= factor * b[k][j];
                }
            }
        }
    }
    b
}

/// Counts of cases in a comparison, so that a test can demand that the cases it is about occurred.
#[derive(Default)]
pub struct Counts {
    pub states: usize,
    pub closed: usize,
    pub open: usize,
    pub lifted: usize,
    pub stick: usize,
    pub slip: usize,
    /// The fastest eigenvalue over its bound, where there is a bound.
    pub bounds: Vec<f64>,
}

/// Returns the matrix by differences: `rows[i][j] = ∂f_i/∂x_j`.
pub fn by_differences(system: &mut System, time: f64, x: &[f64], h: f64) -> Vec<Vec<f64>> {
    let n = x.len();
    let mut rows = vec![vec![0.0; n]; n];
    for j in 0..n {
        let column = difference(h, |d| {
            let mut y = x.to_vec();
            y[j] += d;
            rates(system, time, &y)
        });
        for i in 0..n {
            rows[i][j] = column[i];
        }
    }
    rows
}

/// The matrix as the system keeps it: `J = shift I - (shift I - J)⁻¹⁻¹`, entry by entry, and the solution of
/// `(shift I - J) y = b`, for several shifts.
pub fn check_matrix(system: &mut System, time: f64, x: &[f64], expected: &[Vec<f64>], random: &mut Random) {
    let n = x.len();
    let dx = rates(system, time, x);
    let mut df_dt = vec![0.0; n];
    system.linearize(time, x, &dx, &mut df_dt);
    let largest = expected.iter().map(|row| norm(row)).fold(0.0, f64::max);
    // A shift near the size of the matrix keeps it well conditioned.
    for shift in [largest.max(1.0), 3.7 * largest.max(1.0)] {
        system.factor(shift).unwrap();
        let mut columns = Vec::new();
        for j in 0..n {
            let mut b = vec![0.0; n];
            b[j] = 1.0;
            system.solve(&mut b);
            columns.push(b);
        }
        let solved = (0..n).map(|i| (0..n).map(|j| columns[j][i]).collect()).collect();
        let back = inverse(solved);
        for i in 0..n {
            let size = norm(&expected[i]).max(1.0);
            for j in 0..n {
                let value = if i == j { shift } else { 0.0 } - back[i][j];
                let error = (value - expected[i][j]).abs();
                assert!(
                    error <= 3e-8 * size + 1e-11 * shift,
                    "entry ({i}, {j}) of {n}: {value} instead of {} (largest of the row {size})",
                    expected[i][j]
                );
            }
        }
    }
    for shift in [20.0, 1e3, 1e5] {
        system.factor(shift).unwrap();
        let b: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
        let mut y = b.clone();
        system.solve(&mut y);
        for i in 0..n {
            let (mut left, mut size) = (shift * y[i], (shift * y[i]).abs() + b[i].abs());
            for j in 0..n {
                left -= expected[i][j] * y[j];
                size += (expected[i][j] * y[j]).abs() + norm(&expected[i]) * y[j].abs();
            }
            assert!(
                (left - b[i]).abs() <= 1e-7 * size,
                "row {i} of {n}, shift {shift}: {left} instead of {}",
                b[i]
            );
        }
    }
}

/// Compares matrix and time derivative at random states; passes over states with a discontinuity within the
/// difference.
pub fn compare(model: &Model, seed: u64, wanted: usize, spread: [f64; 3]) -> Counts {
    let mut system = System::new(model.clone()).unwrap();
    let layout = system.layout();
    let n = layout.len();
    let mut random = Random(seed);
    let mut counts = Counts::default();
    let h = 5e-4;
    for _ in 0..200 * wanted {
        if counts.states == wanted {
            break;
        }
        let time = random.between(0.3, 1.9);
        system.next_time_discontinuity(time);
        let mut x = system.initial_state();
        for value in &mut x[..layout.speeds] {
            *value += random.between(-spread[0], spread[0]);
        }
        for value in &mut x[layout.speeds..2 * layout.speeds] {
            *value = random.between(-spread[1], spread[1]);
        }
        for value in &mut x[2 * layout.speeds..n - layout.quadratures] {
            *value = random.between(-spread[2], spread[2]);
        }
        let here = pieces(&mut system, time, &x);
        let smooth = (0..n - layout.quadratures).all(|j| {
            [-2.5, 2.5].iter().all(|d| {
                let mut y = x.clone();
                y[j] += d * h;
                pieces(&mut system, time, &y) == here
            })
        }) && [-2.5, 2.5]
            .iter()
            .all(|d| pieces(&mut system, time + d * h, &x) == here);
        if !smooth {
            continue;
        }
        counts.states += 1;
        let observation = system.observe(time, &x);
        for (face, state) in model.faces.iter().zip(&observation.faces) {
            for point in &state.points {
                counts.open += usize::from(point.gap >= 0.0);
                counts.closed += usize::from(point.normal > 0.0);
                counts.lifted += usize::from(point.gap < 0.0 && point.normal == 0.0);
                if face.3.state_count() > 0 && point.normal > 0.0 {
                    counts.stick += usize::from(point.friction.load <= 1.0);
                    counts.slip += usize::from(point.friction.load > 1.0);
                }
            }
        }
        let expected = by_differences(&mut system, time, &x, h);
        check_matrix(&mut system, time, &x, &expected, &mut random);
        let bound = system.spectral_radius_bound(time, &x);
        if bound < f64::INFINITY {
            let moving = 2 * layout.speeds;
            let matrix = DMatrix::from_fn(moving, moving, |i, j| expected[i][j]);
            let fastest = matrix
                .complex_eigenvalues()
                .iter()
                .fold(0.0_f64, |most, value| most.max(value.norm()));
            // A turning body's own eigenvalues, of the size of its angular velocity, are left out of the
            // bound.
            let rotating = norm(&x[layout.speeds..moving]);
            assert!(
                fastest <= bound + 5.0 * rotating,
                "{fastest} 1/s, bound {bound}, turning {rotating}"
            );
            if bound > 20.0 * rotating {
                counts.bounds.push(fastest / bound);
            }
        }
        let dx = rates(&mut system, time, &x);
        let mut df_dt = vec![0.0; n];
        system.linearize(time, &x, &dx, &mut df_dt);
        let in_time = difference(h, |d| rates(&mut system, time + d, &x));
        let size = norm(&in_time).max(1.0);
        for i in 0..n {
            assert!(
                (df_dt[i] - in_time[i]).abs() <= 1e-7 * size,
                "time derivative of state {i} of {n}: {} instead of {}",
                df_dt[i],
                in_time[i]
            );
        }
        assert_eq!(
            dx,
            rates(&mut system, time, &x),
            "linearize must leave nothing behind"
        );
    }
    assert_eq!(counts.states, wanted, "too few smooth states");
    counts
}
