//! Every entry of the Jacobian matrix, and the derivative by time, against differences of the right-hand
//! side.

use integrate::Problem;
use mechanics::body::Body;
use mechanics::connection::{
    Accumulator, Branch, ColumnFace, GapDamper, Law, NegativeRise, Options, SpringDamper, SurfaceFriction,
    Wedge,
};
use mechanics::contact::FrictionDirections;
use mechanics::curve::Curve;
use mechanics::motion::Motion;
use mechanics::system::ContactState;
use mechanics::system::{Model, System};

use crate::common::Random;
use crate::models::{connection, model, rates};

fn norm(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Returns two bodies (one of them not free in all coordinates), one that moves, the ground, and every law
/// between them, in numbers near one.
fn everything(options: Options, accumulator: Accumulator) -> Model {
    let mut motions: [Motion; 6] = std::array::from_fn(|k| Motion::Sine {
        amplitude: 0.1 + 0.02 * k as f64,
        angular_frequency: 1.0 + 0.3 * k as f64,
        phase: 0.4 * k as f64,
    });
    motions[1] = Motion::Constant(0.05);
    let bodies = vec![
        Body::linearized("one", [0.1, 0.2, 0.3], [true; 6], 1.5, [0.7, 0.9, 1.1]),
        Body::linearized(
            "two",
            [-0.2, 0.3, 0.1],
            [true, true, true, false, true, false],
            2.5,
            [1.0; 3],
        ),
        Body::linearized_prescribed("mover", [0.3, -0.1, 0.2], motions),
        Body::ground(),
    ];
    let curve = |points: &[[f64; 2]]| Curve::mirrored_from_origin(points.to_vec()).unwrap();
    let spring = SpringDamper {
        spring: Some(curve(&[[0.0, 0.0], [0.3, 20.0], [0.5, 90.0]])),
        damper: Some(curve(&[[0.0, 0.0], [0.4, 3.0], [1.0, 4.0]])),
        compression_limit: -40.0,
        extension_limit: 30.0,
    };
    let gap = GapDamper {
        spring: Some(curve(&[[0.0, 0.0], [1.0, 30.0]])),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 8.0]])),
        low: -0.05,
        high: 0.1,
    };
    let surface = SurfaceFriction {
        clamped: false,
        directions: FrictionDirections::Two,
        coordinates: [2, 0, 1],
        spring: curve(&[[-1.0, -150.0], [0.0, -60.0], [0.2, 0.0], [1.0, 0.0]]),
        damper: Some(curve(&[[0.0, 0.0], [1.0, 4.0]])),
        coefficient: 0.5,
        accumulator,
    };
    let wedge = |coil_in_bolster: bool, column: ColumnFace| Wedge {
        angle: 0.6,
        coil: curve(&[[-1.0, -160.0], [0.0, -80.0], [1.0, -10.0], [2.0, 0.0]]),
        preload: 5.0,
        coil_in_bolster,
        column,
        slope_friction: 0.3,
        column_friction: 0.4,
        accumulator,
        normal_limit: 300.0,
    };
    let profile = |slope: f64, direction: f64| ColumnFace::Profile {
        depth: curve(&[[-1.0, -slope], [0.0, 0.0], [1.0, 1.5 * slope]]),
        direction,
    };
    let point = |x: f64| [x, 0.3 - x, 0.5 * x];
    let mut connections = Vec::new();
    for (i, (a, b)) in [(0, 1), (1, 2), (3, 0), (2, 0)].into_iter().enumerate() {
        let at = |shift: f64| point(0.2 * i as f64 + shift);
        let springs = (0..6).map(|k| (k, spring.clone())).collect();
        connections.push(connection(a, b, at(0.0), Law::Springs(springs)));
        connections.push(connection(a, b, at(0.1), Law::Gap(2, gap.clone())));
        connections.push(connection(a, b, at(0.2), Law::Surface(surface.clone())));
        let columns = [
            ColumnFace::Plain { toe_out: i % 2 == 0 },
            profile(-0.2, 1.0),
            profile(0.15, -1.0),
        ];
        for (j, column) in columns.into_iter().enumerate() {
            let law = wedge((i + j) % 2 == 0, column);
            connections.push(connection(a, b, at(0.3), Law::Wedge(law)));
        }
    }
    let mut model = model(bodies, connections);
    model.gravity[2] = -9.8;
    model.options = options;
    model
}

/// Returns the smooth branch that every law is on, which must not change within a difference. Second
/// differences find a discontinuity.
fn crosses_discontinuity(column: &[[f64; 5]], h: f64) -> bool {
    column.iter().any(|values| {
        let size = norm(values).max(1.0);
        // third differences of smooth functions are of the order h³
        let third = [
            values[3] - 3.0 * values[2] + 3.0 * values[1] - values[0],
            values[4] - 3.0 * values[3] + 3.0 * values[2] - values[1],
        ];
        norm(&third) > 1e-9 * size + 300.0 * h * h * h * size
    })
}

/// Returns the derivative of all rates by one argument, by a formula of fourth order; none at a
/// discontinuity.
fn difference(h: f64, mut f: impl FnMut(f64) -> Vec<f64>) -> Option<Vec<f64>> {
    let samples = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| f(k * h));
    let n = samples[0].len();
    let columns: Vec<[f64; 5]> = (0..n).map(|i| std::array::from_fn(|k| samples[k][i])).collect();
    if crosses_discontinuity(&columns, h) {
        return None;
    }
    let slope = |v: &[f64; 5]| (v[0] - 8.0 * v[1] + 8.0 * v[3] - v[4]) / (12.0 * h);
    Some(columns.iter().map(slope).collect())
}

#[derive(Default)]
pub struct Counts {
    pub columns: usize,
    open: usize,
    stick: usize,
    slip: usize,
    jammed: usize,
}

/// Compares at random states, column by column, leaving out columns with a discontinuity within the
/// difference.
pub fn compare(model: &Model, seed: u64) -> Counts {
    let mut system = System::new(model.clone()).unwrap();
    let layout = system.layout();
    let n = layout.len();
    let mut random = Random(seed);
    let mut counts = Counts::default();
    for _ in 0..60 {
        let time = random.between(0.3, 1.9);
        system.next_time_discontinuity(time);
        let mut x = system.initial_state();
        for (i, value) in x.iter_mut().enumerate().take(n - layout.quadratures) {
            let size = if i < layout.speeds {
                0.3
            } else if i < 2 * layout.speeds {
                0.5
            } else {
                0.06
            };
            *value = random.between(-size, size);
        }
        for state in system.observe(time, &x).connections {
            match state.contact_state {
                Some(ContactState::Open) => counts.open += 1,
                Some(ContactState::Stick) => counts.stick += 1,
                Some(ContactState::Slip) => counts.slip += 1,
                None => {}
            }
            counts.jammed += usize::from(state.wedge.is_some_and(|wedge| wedge.jammed));
        }
        let dx = rates(&mut system, time, &x);
        let mut df_dt = vec![0.0; n];
        system.linearize(time, &x, &dx, &mut df_dt);
        let h = 1e-4;
        let by_time = difference(h, |d| rates(&mut system, time + d, &x));
        if let Some(expected) = by_time {
            for i in 0..n {
                let error = (df_dt[i] - expected[i]).abs();
                let size = norm(&expected).max(norm(&dx));
                assert!(
                    error <= 1e-8 * size,
                    "df/dt {i}: {} instead of {}",
                    df_dt[i],
                    expected[i]
                );
            }
        }
        // the matrix column by column: (shift I - J) e_j, solved, must give e_j back
        let shift = 1e3;
        for j in 0..n {
            let moved = difference(h, |d| {
                let mut y = x.clone();
                y[j] += d;
                rates(&mut system, time, &y)
            });
            let Some(column) = moved else { continue };
            counts.columns += 1;
            system.linearize(time, &x, &dx, &mut df_dt);
            system.factor(shift).unwrap();
            let mut b: Vec<f64> = column.iter().map(|entry| -entry).collect();
            b[j] += shift;
            let size = norm(&b);
            system.solve(&mut b);
            for (i, value) in b.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!(
                    (value - expected).abs() <= 1e-8 * size / shift,
                    "column {j}, row {i} of {n} ({layout:?}): {value} instead of {expected}"
                );
            }
        }
    }
    counts
}

const BRISTLE: Accumulator = Accumulator::Bristle {
    stiffness: 900.0,
    damping: 30.0,
};

#[test]
fn agrees_with_differences() {
    let counts = compare(&everything(Options::default(), BRISTLE), 1);
    assert!(counts.columns > 1000, "{}", counts.columns);
    let counts = [counts.open, counts.stick, counts.slip, counts.jammed];
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn agrees_with_differences_for_other_options() {
    let options = Options {
        plain_toe_angle: 0.01,
        branch: Branch::Velocity { reference_speed: 0.3 },
        slope: mechanics::connection::SlopeDirection::Toe,
        rise_in_slip: true,
        negative_rise: NegativeRise::Stop,
        accumulator_damping: 0.7,
        gap_tension: mechanics::connection::GapTension::Allowed,
    };
    assert!(compare(&everything(options, BRISTLE), 2).columns > 1000);
    let options = Options {
        rise_in_slip: true,
        slope: mechanics::connection::SlopeDirection::OwnSlip { reference_speed: 0.3 },
        ..Options::default()
    };
    assert!(compare(&everything(options, BRISTLE), 3).columns > 1000);
}

#[test]
fn agrees_with_differences_for_viscous_elements() {
    let viscous = Accumulator::Viscous { damping: 60.0 };
    assert!(compare(&everything(Options::default(), viscous), 4).columns > 1000);
}
