//! Two wedges in one system, the second turned by 180° about the vertical axis through the bolster's center:
//! both give what one gives. Side frame and bolster are shared bodies; the second wedge's markers on them are
//! turned.

use crate::common;
use common::{INCH, LBF, TOE, YAW, bristle, run, run_system};
use mechanics::body::Body;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::system::{Model, Observation, System};
use mechanics::vector::{Matrix, Vector};
use std::f64::consts::PI;
use wedge::parameters::{Damping, Parameters};
use wedge::{BOLSTER, SIDE_FRAME, WEDGE, Wedge, thesis};

/// The bolster's center is far enough away that the two wedges do not overlap.
const CENTER: f64 = 10.0 * INCH;

fn parameters(damping: Damping) -> Parameters {
    let mut parameters = thesis::parameters(damping, TOE, YAW);
    let middle = parameters.coil.nominal_length + 0.5 * parameters.wedge.height;
    parameters.bolster.center = Some([CENTER, 0.0, middle]);
    parameters
}

/// Returns the system of one wedge and its image.
fn doubled(one: &Wedge) -> System {
    let system = &one.system;
    let half_turn = mechanics::orientation::fixed([0.0, 0.0, PI]);
    let turn_point = |p: [f64; 3]| [2.0 * CENTER - p[0], -p[1], p[2]];
    let mut bodies = system.bodies().to_vec();
    let second: Body = {
        let mut body = bodies[WEDGE].clone();
        body.name = "second wedge".to_owned();
        body.frame.origin = turn_point(body.frame.origin);
        body.frame.orientation = [0.0, 0.0, PI];
        body
    };
    bodies.push(second);
    let turned = |on: usize, marker: &Marker| {
        let origin = bodies[on].frame.origin;
        let place: [f64; 3] = std::array::from_fn(|k| origin[k] + marker.origin.0[k]);
        let place = turn_point(place);
        let rotation: Matrix<f64> = half_turn.times(marker.rotation);
        Marker {
            origin: Vector(std::array::from_fn(|k| place[k] - origin[k])),
            rotation,
        }
    };
    let (mut faces, mut coils) = (Vec::new(), Vec::new());
    for mounted in system.faces() {
        faces.push((WEDGE, mounted.on, mounted.marker, mounted.element.plain()));
    }
    for mounted in system.faces() {
        faces.push((
            3,
            mounted.on,
            turned(mounted.on, &mounted.marker),
            mounted.element.plain(),
        ));
    }
    for mounted in system.coils() {
        coils.push((WEDGE, mounted.on, mounted.marker, mounted.element.clone()));
    }
    for mounted in system.coils() {
        coils.push((
            3,
            mounted.on,
            turned(mounted.on, &mounted.marker),
            mounted.element.clone(),
        ));
    }
    let gravity = [0.0, 0.0, -one.parameters.gravity];
    System::new(Model {
        bodies,
        gravity,
        faces,
        coils,
        ..Model::default()
    })
    .unwrap()
}

/// Returns the observation of one wedge of a system, in its own frame (the second is looked at from the other
/// side): coordinates, then for each corner the gap, the normal force and the friction force, then the coil.
/// m, rad, N.
fn seen_by(observation: &Observation, number: usize) -> Vec<f64> {
    let (body, side) = if number == 0 { (WEDGE, 1.0) } else { (3, -1.0) };
    let own = |f: &Vector<f64>| [side * f.0[0], side * f.0[1], f.0[2]];
    let mut out = observation.bodies[body].coordinates.to_vec();
    out.extend(observation.bodies[body].speeds);
    for face in &observation.faces[2 * number..2 * number + 2] {
        for (i, point) in face.points.iter().enumerate() {
            out.extend([point.gap, point.normal]);
            out.extend(own(&face.normal_forces[i]));
            out.extend(own(&face.friction_forces[i]));
        }
    }
    let coil = &observation.coils[number];
    out.extend(own(&coil.force));
    out.push(coil.coil.length);
    out
}

/// Largest difference, with coordinates in inches and forces in lbf.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    // 12 coordinates and rates; then gaps are followed by seven forces; the coil: three forces, a length.
    let unit = |i: usize| {
        if i < 12 || (i < 76 && (i - 12).is_multiple_of(8)) || i == 79 {
            INCH
        } else {
            LBF
        }
    };
    a.iter()
        .zip(b)
        .enumerate()
        .fold(0.0_f64, |m, (i, (a, b))| m.max((a - b).abs() / unit(i)))
}

/// At one state both wedges have the same forces, to rounding.
#[test]
fn the_same_state_gives_the_same_forces() {
    use integrate::Problem;
    let mut random = common::Random(21);
    for damping in [Damping::Variable, Damping::Constant] {
        let one = Wedge::new(parameters(damping)).unwrap();
        let (mut single, mut double) = (one.system.clone(), doubled(&one));
        for _ in 0..50 {
            let time = random.between(0.0, 3.0);
            let mut x = single.initial_state();
            for value in &mut x[..4] {
                *value = random.between(-2e-3, 2e-3);
            }
            x[1] += (2.0 * time).sin() * INCH;
            for value in &mut x[4..8] {
                *value = random.spread(1e-6, 0.1);
            }
            let mut both = double.initial_state();
            for wedge in 0..2 {
                both[4 * wedge..][..4].copy_from_slice(&x[..4]);
                both[8 + 4 * wedge..][..4].copy_from_slice(&x[4..8]);
            }
            let (mut dx, mut both_dx) = (x.clone(), both.clone());
            single.derivative(time, &x, &mut dx);
            double.derivative(time, &both, &mut both_dx);
            let scale = dx[4..8].iter().fold(0.0_f64, |s, a| s.max(a.abs()));
            for wedge in 0..2 {
                for i in 0..4 {
                    let (a, b) = (dx[4 + i], both_dx[8 + 4 * wedge + i]);
                    assert!((a - b).abs() < 1e-10 * scale, "wedge {wedge}: {dx:?} {both_dx:?}");
                }
            }
            // The powers of both add up.
            let powers = |system: &System, dx: &[f64]| -> f64 {
                let first = dx.len() - system.energy_terms().len();
                dx[first..].iter().sum()
            };
            let (a, b) = (powers(&single, &dx), powers(&double, &both_dx));
            let largest = dx[8..].iter().fold(1e-9_f64, |m, p| m.max(p.abs()));
            assert!((2.0 * a - b).abs() < 1e-9 * largest, "{a} {b}");
        }
    }
}

/// Over two seconds of yawed cases, with the release, sliding, and a reversal. (With variable damping the
/// bolster goes down first: a free wedge would strike the pocket, and remember every rounding.)
///
/// The two wedges of one system take the same steps and differ by rounding alone: the half turn is exact to
/// 1.2e-16, positions to 1e-17 m, that is 1e-9 lbf at 1e6 lbf/in; friction forgets, so a thousand times that
/// is the limit. A wedge alone takes other steps after a while, and agrees as the tolerance says: 1e-8 of the
/// scale of displacements a step, which the stiffness of a face (1e6 lbf/in) makes a force; ringing carries
/// some of it on.
#[test]
fn a_reversed_wedge_gives_what_one_gives() {
    for damping in [Damping::Variable, Damping::Constant] {
        for law in [None, Some(bristle())] {
            let mut parameters = parameters(damping);
            if let Some(law) = law {
                parameters = common::with_law(parameters, law);
            }
            if damping == Damping::Variable {
                parameters.bolster.coordinates[2] = Motion::Sine {
                    amplitude: -INCH,
                    angular_frequency: 2.0,
                    phase: 0.0,
                };
            }
            let one = Wedge::new(parameters).unwrap();
            let rows = (2.0, 0.02);
            let mut alone = Vec::new();
            let end = run(&one, 1e-8, rows, |observation, _| {
                alone.push(seen_by(observation, 0))
            });
            let double = doubled(&one);
            let (mut between, mut against) = (0.0_f64, 0.0_f64);
            let mut row = 0;
            let both = run_system(&double, &double.initial_state(), 1e-8, rows, |observation, _| {
                let (first, second) = (seen_by(observation, 0), seen_by(observation, 1));
                between = between.max(difference(&first, &second));
                against = against.max(difference(&first, &alone[row]));
                row += 1;
            });
            println!(
                "{damping:?} {law:?}: between the two {between:.1e}, against one {against:.1e} (in, lbf), \
                 steps {} {}",
                end.steps, both.steps
            );
            assert_eq!(row, alone.len());
            assert!((both.ledger.motion_work / end.ledger.motion_work - 2.0).abs() < 1e-5);
            assert!(between < 1e-6, "{damping:?}, {law:?}: {between:e}");
            let limit = 25.0 * 1e-8 * mechanics::system::scales::DISPLACEMENT / INCH * 1e6;
            assert!(against < limit, "{damping:?}, {law:?}: {against:e}");
            // The image stands on the other side, and faces it.
            let mut observer = double.clone();
            let observation = observer.observe(both.time, &both.x);
            assert!(observation.bodies[3].origin.0[0] > observation.bodies[BOLSTER].origin.0[0]);
            assert!(observation.bodies[WEDGE].origin.0[0] < observation.bodies[BOLSTER].origin.0[0]);
            assert_eq!(
                observation.faces[2].origin.0[0] > CENTER,
                observation.faces[0].origin.0[0] < CENTER
            );
            assert_eq!(observation.bodies[SIDE_FRAME].speeds, [0.0; 6]);
        }
    }
}
