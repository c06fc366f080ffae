//! Coupler forces in curves: closed forms, steady running, energy.

use crate::common;
use std::sync::Arc;

use car::{Coupler, CouplerForce, CouplerPlace, Course, Direction, Loads, Parameters};
use common::{INCH, POUND_FORCE, Ran, curve, empty, run, run_by, tangent};
use integrate::Method;
use mechanics::curve::Curve;
use mechanics::element::Element;
use mechanics::link::RelativeMotion;
use mechanics::motion::Motion;
use mechanics::vector::{Matrix, Vector};
use numerics::scalar::Dual;
use wheelrail::track::{Line, RailLines};

const HALF_TRUCKS: f64 = 243.0 * INCH;
const FORCE: f64 = 200e3 * POUND_FORCE;

fn coupler(lines: &Arc<RailLines>, end: f64) -> Coupler {
    let own = car::Couplers::default();
    Coupler {
        name: "coupler".to_owned(),
        lines: lines.clone(),
        place: CouplerPlace {
            pivot: end * own.pivot(),
            height: own.height,
            length: own.length,
            truck_distance: 2.0 * HALF_TRUCKS,
        },
        direction: Direction::LikeNeighbor,
        course: None,
    }
}

fn lines(degree: f64, turn: f64) -> Arc<RailLines> {
    Arc::new(RailLines::new(curve(degree, turn, 0.0, 400.0), [30.0 * INCH; 2]))
}

/// Returns the motion of a pivot of a body that moves along its chord with its middle at a distance (m),
/// turned by a small yaw (rad) about the middle.
fn on_chord(lines: &RailLines, own: &Coupler, distance: f64, yaw: f64) -> RelativeMotion<f64> {
    let [front, rear] =
        [HALF_TRUCKS, -HALF_TRUCKS].map(|at| Vector(lines.section_at(Line::Center, distance + at).origin));
    let middle: Vector<f64> = (front + rear).scale(0.5);
    let [x, y, _] = (front - rear).0;
    let heading = y.atan2(x) + yaw;
    let (sine, cosine) = heading.sin_cos();
    let forward = Vector([cosine, sine, 0.0]);
    RelativeMotion {
        position: middle + forward.scale::<f64, f64>(own.place.pivot) + Vector([0.0, 0.0, own.place.height]),
        rotation: Matrix([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]),
        velocity: forward.scale(10.0),
        angular_velocity: Vector::zero(),
    }
}

/// Returns sine of the angle of the coupler to the body, positive to the left.
fn sine(own: &Coupler, motion: &RelativeMotion<f64>) -> f64 {
    own.line(motion).toward.dot(motion.rotation.column(1))
}

/// `R sin a = x_p cos a + c/2` with the body on its chord, R to its middle; `F (x_p + c/2)/R` within 0.5 %.
#[test]
fn analytic_couplers_point_to_a_like_neighbor() {
    for (degree, turn) in [(1.0, 1.0), (4.0, -1.0), (10.0, 1.0), (12.0, -1.0)] {
        let lines = lines(degree, turn);
        let radius = 1.0 / lines.center_line().at(200.0).curvature[0];
        for end in [1.0, -1.0] {
            let own = coupler(&lines, end);
            let motion = on_chord(&lines, &own, 250.0, 0.0);
            let found = sine(&own, &motion);
            let (x, half) = (own.place.pivot.abs(), own.place.length);
            let middle = (radius * radius - HALF_TRUCKS * HALF_TRUCKS).sqrt() * radius.signum();
            // Arcs stand for chords between truck centers: 1 mm of 6.2 m.
            let exact = (x * (1.0 - found * found).sqrt() + half) / middle;
            assert!(
                (found / exact - 1.0).abs() < 2e-4,
                "{degree} {end}: {found} {exact}"
            );
            let simple = (x + half) / radius;
            assert!(
                (found / simple - 1.0).abs() < 5e-3,
                "{degree} {end}: {found} {simple}"
            );
            // Buff pushes outward: against the side to which the curve turns.
            let force = own
                .evaluate(&motion)
                .force
                .dot::<f64, f64>(motion.rotation.column(1));
            assert!((force + found).abs() < 1e-12, "{force}");
        }
    }
}

/// On straight track the coupler lies along the body; a copy that yaws as the car does parts the pivots by
/// twice `x_p ψ`: `a = -ψ (2 x_p/c)` more to the body than `-ψ`, so that buff has a yaw stiffness of
/// `-4 F x_p²/c`.
#[test]
fn analytic_buff_lowers_the_stiffness_in_yaw() {
    let lines = Arc::new(RailLines::new(tangent(400.0), [30.0 * INCH; 2]));
    for end in [1.0, -1.0] {
        let own = coupler(&lines, end);
        let straight = on_chord(&lines, &own, 200.0, 0.0);
        assert!(sine(&own, &straight).abs() < 1e-12);
        let yaw = 1e-5;
        let turned = on_chord(&lines, &own, 200.0, yaw);
        let [_, lateral, _] = own.evaluate(&turned).force.0;
        let (x, both) = (own.place.pivot, 2.0 * own.place.length);
        // Force across the track times the arm: twice 2 x_p²/c for both ends.
        let expected = 2.0 * x * x / both * yaw;
        assert!(
            (x * lateral / expected - 1.0).abs() < 1e-6,
            "{end}: {lateral} {expected}"
        );
    }
}

/// At the ends of the track a neighbor stands beyond it; in a spiral the angle grows from straight to curve.
#[test]
fn limits_neighbors_in_spirals_and_beyond_the_track() {
    let lines = lines(10.0, 1.0);
    let own = coupler(&lines, 1.0);
    let angle = |at: f64| sine(&own, &on_chord(&lines, &own, at, 0.0));
    // A neighbor whose front truck is in the spiral swings its rear end outward first.
    assert!(angle(7.0).abs() < 1e-9 && angle(14.0) < 0.0 && angle(14.0) > -1e-3);
    for step in 0..30 {
        let at = 30.0 + 2.5 * f64::from(step);
        assert!(
            angle(at + 2.5) > angle(at) - 1e-9,
            "{at} m: {} {}",
            angle(at),
            angle(at + 2.5)
        );
    }
    let trailing = coupler(&lines, -1.0);
    assert!(sine(&trailing, &on_chord(&lines, &trailing, 7.5, 0.0)).abs() < 1e-9);
    let end = lines.center_line().length() - 7.5;
    let [inside, outside] = [end - 50.0, end].map(|at| sine(&own, &on_chord(&lines, &own, at, 0.0)));
    assert!((inside - outside).abs() < 1e-6, "{inside} {outside}");
}

/// The derivatives of the law are those of its values, through the search for the neighbor's place.
#[test]
fn convergence_derivatives_are_those_of_the_values() {
    let lines = lines(8.0, -1.0);
    let own = Coupler {
        course: Curve::new(vec![[0.0, 1e5], [100.0, 9e5]]).ok(),
        ..coupler(&lines, -1.0)
    };
    let motion = on_chord(&lines, &own, 75.0, 0.01);
    let dual = |v: Vector<f64>| Vector(v.0.map(Dual::<1>::from));
    for (axis, step) in [(0, 1e-3), (1, 1e-4), (2, 1e-4)] {
        let moved = |way: f64| {
            let mut other = motion;
            other.position.0[axis] += way;
            own.evaluate(&other).force
        };
        let mut position = dual(motion.position);
        position.0[axis] = Dual::variable(motion.position.0[axis], 0);
        let derivative = own.evaluate(&RelativeMotion {
            position,
            rotation: Matrix(motion.rotation.0.map(|row| row.map(Dual::<1>::from))),
            velocity: dual(motion.velocity),
            angular_velocity: dual(motion.angular_velocity),
        });
        let difference: Vector<f64> = (moved(step) - moved(-step)).scale(0.5 / step);
        for k in 0..3 {
            let found = derivative.force.0[k].derivative[0];
            let error = (found - difference.0[k]).abs();
            assert!(
                error < 20.0 + 1e-5 * difference.0[k].abs(),
                "{axis} {k}: {found} {difference:?}"
            );
        }
    }
}

fn coupled(mut parameters: Parameters, force: f64) -> Parameters {
    for end in &mut parameters.couplers.ends {
        end.course = Course::Time(Motion::Constant(force));
    }
    parameters
}

/// The last four seconds' mean.
fn late(ran: &Ran, of: impl Fn(&Loads) -> f64) -> f64 {
    let late = ran.loads.iter().rev().take(80);
    late.map(|(_, own)| of(own)).sum::<f64>() / 80.0
}

/// In a steady run through 10 deg the lateral part is F (x_p + c/2)/R within 3 % in the mean of both
/// ends, outward in buff, inward in draft, and the wheels carry the sum of both ends within 1 %. Yaw of
/// the body takes from one end what it gives to the other: F 2 x_p/c for each rad.
#[test]
fn analytic_wheels_carry_what_couplers_push_aside() {
    let steady = |force: f64| {
        let mut parameters = empty(curve(10.0, 1.0, 4.0 * INCH, 250.0), 10.7);
        parameters.start.distance = 12.0;
        run_by(Method::TrBdf2, &coupled(parameters, force), 22.0, 0.05, 1e-4)
    };
    let lateral = |loads: &Loads| -> f64 {
        let wheels = loads.wheels.iter();
        wheels.map(|[left, right]| left.lateral - right.lateral).sum()
    };
    let alone = late(&steady(0.0), lateral);
    for force in [FORCE, -FORCE] {
        let ran = steady(force);
        let ends = [0, 1].map(|end| late(&ran, |loads| loads.couplers[end].unwrap().lateral));
        let curvature = ran.car.lines.center_line().at(200.0).curvature[0];
        let simple = -force * 0.5 * 637.0 * INCH * curvature;
        let sum: f64 = ends.iter().sum();
        assert!(
            (0.5 * sum / simple - 1.0).abs() < 0.03,
            "{force}: {ends:?} N, {simple} N"
        );
        for own in ends {
            assert!((own / simple - 1.0).abs() < 0.08, "{force}: {own} N, {simple} N");
        }
        let carried = late(&ran, lateral) - alone;
        assert!(
            (carried / sum - 1.0).abs() < 0.01,
            "{force}: {carried} N, {sum} N"
        );
        assert!(
            (carried / (2.0 * simple) - 1.0).abs() < 0.03,
            "{carried} N, {simple} N"
        );
    }
}

/// Forces over time and over distance, one end more than the other: their work is in the ledger, which closes
/// with the tolerance.
#[test]
fn energy_the_work_of_couplers_is_in_the_ledger() {
    let mut parameters = empty(curve(10.0, -1.0, 4.0 * INCH, 200.0), 11.0);
    parameters.start.distance = 14.0;
    let wave = Motion::Sine {
        amplitude: 0.3 * FORCE,
        angular_frequency: 6.0,
        phase: 0.4,
    };
    let ramp = vec![[20.0, 0.0], [80.0, -FORCE], [120.0, 0.5 * FORCE]];
    parameters.couplers.ends = [
        CouplerForce {
            course: Course::Time(wave),
            direction: Direction::LikeNeighbor,
        },
        CouplerForce {
            course: Course::Distance(Curve::new(ramp).unwrap()),
            direction: Direction::Angle(0.03),
        },
    ];
    let [loose, tight] = [1e-5, 1e-6].map(|tolerance| run(&parameters, 9.0, 0.05, tolerance));
    assert!(
        tight.residual < 1e-4 && tight.residual < 0.3 * loose.residual,
        "{} {}",
        loose.residual,
        tight.residual
    );
    // Work by hand: ∫ F v dt of both ends by the trapezoidal rule, forces on the car against its speed.
    let power = |loads: &Loads| -> f64 {
        [1.0, -1.0]
            .iter()
            .zip(&loads.couplers)
            .map(|(sign, own)| {
                let own = own.unwrap();
                -sign * own.force * own.angle.cos() * own.speed
            })
            .sum()
    };
    let pairs = tight.loads.windows(2);
    let by_hand: f64 = pairs
        .map(|own| 0.5 * (own[1].0 - own[0].0) * (power(&own[0].1) + power(&own[1].1)))
        .sum();
    let mut system = tight.car.system.clone();
    let seen = system.observe(tight.time, &tight.state);
    let terms = system.energy_terms().iter().zip(&seen.quadratures);
    let work: f64 = terms
        .filter(|(term, _)| term.element.starts_with("coupler") && term.kind.is_work())
        .map(|(_, value)| *value)
        .sum();
    assert!(
        (work / by_hand - 1.0).abs() < 5e-3,
        "{work} J, {by_hand} J by hand"
    );
}
