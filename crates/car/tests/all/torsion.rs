//! A car body that twists: mass properties, frequency, statics on twisted rails, the limit of a stiff spring.

use std::f64::consts::TAU;

use car::{Car, FrictionState, Mass, Parameters, SteadyCar, Torsion};
use mechanics::linear::{Equivalent, LinearMode, SliderPlace};
use mechanics::motion::Motion;
use mechanics::orientation::fixed;
use mechanics::vector::{Matrix, Vector};
use nalgebra::{DMatrix, DVector};
use rolling::wheelset::coordinate;

use crate::common::{INCH, MPH, POUND_FORCE, at_start, curve, empty, loaded, run, tangent};

/// A body that twists with this stiffness, N·m/rad.
fn twisting(mut parameters: Parameters, stiffness: f64) -> Parameters {
    parameters.torsion = Some(Torsion {
        stiffness,
        damping: 0.02,
    });
    parameters
}

/// Mass, first moment and tensor of inertia about the origin of bodies in the nominal layout.
fn moments(car: &Car, numbers: &[usize]) -> (f64, Vector<f64>, [[f64; 3]; 3]) {
    let (mut mass, mut first, mut tensor) = (0.0, Vector([0.0; 3]), [[0.0; 3]; 3]);
    for number in numbers {
        let body = &car.system.bodies()[*number];
        let place = Vector(body.frame.origin);
        let axes: Matrix<f64> = fixed(body.frame.orientation);
        mass += body.mass;
        first += place.scale::<f64, f64>(body.mass);
        let square = place.dot::<f64, f64>(place);
        for (i, row) in tensor.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                let own: f64 = (0..3)
                    .map(|k| axes.0[i][k] * body.inertia[k] * axes.0[j][k])
                    .sum();
                let diagonal = if i == j { square } else { 0.0 };
                *value += own + body.mass * (diagonal - place.0[i] * place.0[j]);
            }
        }
    }
    (mass, first, tensor)
}

/// Both halves together have mass, center of gravity and inertia of the rigid body, also of one whose lading
/// lies to a side and forward; each has inertias that a body can have.
#[test]
fn analytic_the_halves_are_the_whole() {
    let mut aside = loaded(tangent(60.0), 0.0);
    aside.lading.push(Mass {
        name: "beside".to_owned(),
        mass: 5e3,
        place: [2.0, 0.5, 2.5],
        inertia: [1e3; 3],
    });
    for parameters in [loaded(tangent(60.0), 0.0), empty(tangent(60.0), 0.0), aside] {
        let rigid = Car::new(&parameters).unwrap();
        assert_eq!(rigid.numbers.rear_half, None);
        let halves = Car::new(&twisting(parameters, 1e7)).unwrap();
        let (front, rear) = (halves.numbers.body, halves.numbers.rear_half.unwrap());
        let (mass, first, tensor) = moments(&rigid, &[rigid.numbers.body]);
        let (both, of_both, tensor_of_both) = moments(&halves, &[front, rear]);
        assert!((both / mass - 1.0).abs() < 1e-12, "{both} {mass}");
        for (a, b) in first.0.into_iter().zip(of_both.0) {
            assert!((a - b).abs() < 1e-9 * mass, "{a} {b}");
        }
        let size = tensor[1][1];
        for (a, b) in tensor.as_flattened().iter().zip(tensor_of_both.as_flattened()) {
            assert!((a - b).abs() < 1e-9 * size, "{a} {b}");
        }
        for number in [front, rear] {
            let [a, b, c] = halves.system.bodies()[number].inertia;
            let can_be = a > 0.0 && b > 0.0 && c > 0.0 && a < b + c && b < a + c && c < a + b;
            assert!(can_be, "{a} {b} {c}");
        }
    }
}

/// Free halves twist against each other at ω² = 4 K/I: the part of the stiffness that is the spring's, over
/// the mass matrix of both halves, has this one eigenvalue.
#[test]
fn analytic_frequency_of_two_inertias_on_a_spring() {
    let parameters = loaded(tangent(300.0), 10.0);
    let (low, high) = (1e7, 3e7);
    let mut found = [low, high].map(|stiffness| {
        let mut car = SteadyCar::new(&twisting(parameters.clone(), stiffness)).unwrap();
        let model = car.model(20.0).unwrap().without_friction;
        let system = &car.car().system;
        let parts = car.car().numbers.body_parts();
        let places: Vec<usize> = parts
            .flat_map(|body| (0..6).map(move |k| system.position_of(body, k).unwrap()))
            .collect();
        let of = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(places.len(), places.len(), |i, j| matrix[(places[i], places[j])])
        };
        [of(&model.mass), of(&model.stiffness)]
    });
    let [_, stiffer] = std::mem::take(&mut found[1]);
    let [mass, softer] = std::mem::take(&mut found[0]);
    // The only eigenvalue that is not zero is the trace; the stiffness is that of forces, ∂Q/∂q.
    let square = (mass.try_inverse().unwrap() * (softer - stiffer)).trace();
    let rigid = Car::new(&parameters).unwrap();
    let inertia = rigid.system.bodies()[rigid.numbers.body].inertia[0];
    let expected = 4.0 * (high - low) / inertia;
    assert!((square / expected - 1.0).abs() < 1e-3, "{square} {expected}");
    let told = twisting(parameters, high - low).torsion_frequency().unwrap();
    assert!((TAU * told / expected.sqrt() - 1.0).abs() < 1e-9, "{told}");
}

/// What the body's twist t (rad) and the moments that wheelsets take (front less rear, N·m) become where the
/// axles are rolled by ±`roll`/2 (rad) under the trucks: linear statics about the settled car. Wedges have no
/// friction, plates and adapters hold; wheelsets are where they are put.
fn on_rolled_axles(parameters: &Parameters, roll: f64) -> [f64; 2] {
    let mut steady = SteadyCar::new(parameters).unwrap();
    let model = steady.model(20.0).unwrap();
    let (car, system) = (steady.car(), &steady.car().system);
    let sliders = model.sliders.iter().map(|own| match own.place {
        SliderPlace::Point { face, .. } => {
            let name = &system.faces()[face].element.name;
            let of_wedge = ["_column", "_slope"].iter().any(|end| name.ends_with(end));
            if of_wedge {
                Equivalent::NONE
            } else {
                own.slider.stuck()
            }
        }
        SliderPlace::Connection(_) => Equivalent::NONE,
    });
    // Of forces: ∂Q/∂q.
    let stiffness = model.with(sliders).stiffness;
    let n = stiffness.nrows();
    let mut put = vec![None; n];
    for (w, number) in car.numbers.wheelsets.into_iter().enumerate() {
        for k in 0..6 {
            if let Some(place) = system.position_of(number, k) {
                let rolled = if w < 2 { 0.5 * roll } else { -0.5 * roll };
                put[place] = Some(if k == coordinate::ROLL { rolled } else { 0.0 });
            }
        }
    }
    let free: Vec<usize> = (0..n).filter(|place| put[*place].is_none()).collect();
    let given = DVector::from_fn(n, |place, _| put[place].unwrap_or(0.0));
    let pushed = &stiffness * &given;
    let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| stiffness[(free[i], free[j])]);
    let right = DVector::from_fn(free.len(), |i, _| -pushed[free[i]]);
    let found = matrix.lu().solve(&right).unwrap();
    let mut all = given;
    for (place, value) in free.iter().zip(found.iter()) {
        all[*place] = *value;
    }
    let forces = &stiffness * &all;
    let taken = car.numbers.wheelsets.into_iter().enumerate().map(|(w, number)| {
        let own = forces[system.position_of(number, coordinate::ROLL).unwrap()];
        if w < 2 { own } else { -own }
    });
    let taken = taken.sum();
    let [front, rear] = [0, 1].map(|end| {
        let place = system.position_of(car.numbers.body_at(end), 3);
        all[place.unwrap()]
    });
    [front - rear, taken]
}

/// Axles rolled by ±φ/2 under trucks of roll stiffness k twist a body of stiffness K by t. Each half leans by
/// t/2, against its axles by (φ - t)/2; gravity tips it by g t/2:
///
/// ```text
/// k (φ - t)/2 + g t/2 = K t,   so φ/t = 1 + (2 K - g)/k,   M = k (φ - t)/2
/// ```
///
/// of springs in series. So φ/t is linear in K with the slope 2/k, and each truck's moment is less than that
/// under a rigid body by k t/2. Both give the same k, which is that of the coils of both nests.
#[test]
fn analytic_rolled_axles_and_springs_in_series() {
    let parameters = loaded(tangent(300.0), 10.0);
    let roll = 1e-3;
    let [none, rigid] = on_rolled_axles(&parameters, roll);
    assert_eq!(none, 0.0);
    let bodies = [4e6, 1e7, 1.6e7];
    let found = bodies.map(|body| on_rolled_axles(&twisting(parameters.clone(), body), roll));
    let [soft, middle, hard] = found.map(|[twist, _]| roll / twist);
    let [from_soft, from_hard] = [middle - soft, hard - middle];
    assert!(
        (from_soft / from_hard - 1.0).abs() < 1e-3,
        "{from_soft} {from_hard}"
    );
    let by_slope = 2.0 * (bodies[2] - bodies[0]) / (hard - soft);
    let by_moments = found.map(|[twist, moments]| (moments - rigid).abs() / twist);
    let truck = &parameters.trucks[0];
    let nest = 0.5 * truck.geometry.nest_distance;
    for own in by_moments {
        assert!((own / by_slope - 1.0).abs() < 1e-3, "{own} {by_slope}");
    }
    // Control coils stand beside the load coils, adapters and plates under and over both.
    let coils = by_slope / (truck.load_stiffness() * nest * nest);
    assert!((1.0..1.15).contains(&coils), "{coils}");
    // Gravity tips half of the body, whose center lies 1.4 m above its plate, by less than that.
    let gravity = by_slope * (1.0 - soft) + 2.0 * bodies[0];
    let lever = gravity / (0.5 * parameters.carried_mass() * parameters.gravity);
    assert!((0.0..1.4).contains(&lever), "{lever} m");
}

/// With a stiff spring the body is rigid, but for its joint: wheel loads at rest, and vibrations below 4 Hz.
#[test]
fn limits_a_stiff_body_is_rigid() {
    let rigid = loaded(tangent(300.0), 10.0);
    let stiff = twisting(rigid.clone(), 1e10);
    let [a, b] = [&rigid, &stiff].map(|own| at_start(&Car::new(own).unwrap()));
    for (a, b) in a.wheels.as_flattened().iter().zip(b.wheels.as_flattened()) {
        assert!(
            (a.vertical / b.vertical - 1.0).abs() < 1e-5,
            "{} {}",
            a.vertical,
            b.vertical
        );
    }
    let mut found = [&rigid, &stiff].map(|own| {
        let mut car = SteadyCar::new(own).unwrap();
        let mut modes = car.vibrations(40.0 * MPH, FrictionState::Stuck).unwrap();
        modes.retain(|own| own.frequency() < 4.0);
        modes
    });
    let with = std::mem::take(&mut found[1]);
    assert!(found[0].len() >= 4, "{}", found[0].len());
    for own in &found[0] {
        let scale = own.growth().hypot(TAU * own.frequency());
        let apart = |other: &LinearMode| {
            (own.growth() - other.growth()).hypot(TAU * (own.frequency() - other.frequency()))
        };
        let nearest = with.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(
            nearest < 5e-3 * scale,
            "{} Hz: {nearest} of {scale}",
            own.frequency()
        );
    }
}

/// A soft body into a curve with 200,000 lbf of buff on its halves: the ledger closes, the body twists, and
/// its parts are where those of a rigid one are.
#[test]
fn energy_closes_with_a_body_that_twists() {
    let mut parameters = twisting(loaded(curve(7.5, 1.0, 4.0 * INCH, 200.0), 11.0), 5e6);
    for end in &mut parameters.couplers.ends {
        end.course = car::Course::Time(Motion::Constant(5e4 * POUND_FORCE));
    }
    let ran = run(&parameters, 9.0, 0.05, 1e-6);
    assert!(ran.residual < 1e-4, "{}", ran.residual);
    let most = ran
        .loads
        .iter()
        .map(|(_, own)| own.body_twist.abs())
        .fold(0.0, f64::max);
    // In the spiral the rails roll by 4 in of 59.5 in over 60 m, 12.3 m of it between the trucks.
    let rails = 4.0 / 59.5 * 12.3 / 60.0;
    assert!((0.2 * rails..rails).contains(&most), "{most} of {rails} rad");
    let last = ran.last();
    let buff = last.couplers[0].unwrap().force;
    assert!((buff / (5e4 * POUND_FORCE) - 1.0).abs() < 1e-6, "{buff}");
    assert!(
        last.ends.iter().all(|own| own.vertical.abs() < 0.05),
        "{:?}",
        last.ends
    );
}
