//! Trucks in models of others: two under a car, and one that is tilted and far away.

use crate::common;
use common::{INCH, POUND_FORCE};
use integrate::{Integrator, Method, Options};
use mechanics::body::Body;
use mechanics::frame::Frame;
use mechanics::system::{Held, Model, StaticFriction, System};
use truck::{
    BOLSTER, Bolster, ControlCoil, Lading, Mount, Parameters, SIDE_FRAMES, Truck, WEDGES, add_elements,
    bodies,
};
use wedge::parameters::{Damping, STANDARD_GRAVITY};

/// From the car's center to its trucks, m.
const TRUCKS: f64 = 243.0 * INCH;

/// Mass (kg), height of the center of gravity (m) and moments of inertia (kg·m²) of a loaded body with two
/// bolsters and, if they are rigid with it, eight wedges.
fn loaded_car(with_wedges: bool) -> (f64, f64, [f64; 3]) {
    let pounds = 0.453_592_37;
    let inertia = POUND_FORCE * INCH;
    // Weight lbf, place in, inertia lbf·in·s².
    let mut parts = vec![(243_460.0, [0.0, 0.0, 83.75], [1.81e6, 1.624e7, 1.624e7])];
    for x in [243.0, -243.0] {
        parts.push((1300.0, [x, 0.0, 22.0], [2915.0, 142.0, 2930.0]));
        for [end, side] in [[8.5, 39.5], [8.5, -39.5], [-8.5, 39.5], [-8.5, -39.5]]
            .into_iter()
            .filter(|_| with_wedges)
        {
            parts.push((50.0, [x + end, side, 18.0], [1.461, 0.3756, 1.295]));
        }
    }
    let mass: f64 = parts.iter().map(|(weight, ..)| weight * pounds).sum();
    let moment: f64 = parts
        .iter()
        .map(|(weight, place, _)| weight * pounds * place[2] * INCH)
        .sum();
    let height = moment / mass;
    let mut moments = [0.0; 3];
    for (weight, place, own) in parts {
        let [x, y, z] = [place[0] * INCH, place[1] * INCH, place[2] * INCH - height];
        let squares = [y * y + z * z, x * x + z * z, x * x + y * y];
        for k in 0..3 {
            moments[k] += own[k] * inertia + weight * pounds * squares[k];
        }
    }
    (mass, height, moments)
}

/// Returns the loaded car on two trucks without friction, side frames fixed; body 0 is the car. Wedges are
/// bodies, or rigid with the bolster, without contacts.
fn car(damping: Damping, wedges_move: bool) -> System {
    let mut parameters = Parameters {
        wheelsets: None,
        ..Parameters::new(damping).with_wedge_friction(0.0)
    };
    if !wedges_move {
        // A control coil holds its wedge sideways, and the wedge slides on the slope: the bolster does not
        // feel it.
        for wedge in &mut parameters.wedges {
            if let ControlCoil::Shear(coil) = &mut wedge.control_coil {
                coil.shear_stiffness = 0.0;
            }
        }
    }
    let (mass, height, inertia) = loaded_car(!wedges_move);
    let mut car = Body::free("car", mass, inertia, [0.0; 6]);
    car.frame = Frame::fixed([0.0, 0.0, height], [0.0; 3]);
    let mut all = vec![car];
    let mut mounts = Vec::new();
    for place in [TRUCKS, -TRUCKS] {
        let center = [place, 0.0, 0.0];
        let mut mount = Mount {
            center,
            ..Mount::ALONE
        };
        for (number, body) in bodies(&parameters, center).into_iter().enumerate() {
            if number == BOLSTER || (number >= WEDGES && !wedges_move) {
                mount.bodies[number] = 0;
                continue;
            }
            mount.bodies[number] = all.len();
            all.push(if (SIDE_FRAMES..WEDGES).contains(&number) {
                Body::prescribed(&body.name, body.frame)
            } else {
                body
            });
        }
        mounts.push(mount);
    }
    let mut model = Model::new(all, [0.0, 0.0, -STANDARD_GRAVITY]);
    for mount in &mounts {
        add_elements(&mut model, &parameters, mount);
    }
    if !wedges_move {
        model.faces.clear();
    }
    System::new(model).unwrap()
}

/// Frequencies (Hz, rising) of the six motions of the car.
fn car_frequencies(mut system: System) -> Vec<f64> {
    let x = system.initial_state();
    let rest = system.equilibrium(0.0, &x, StaticFriction::Without).unwrap();
    let modes = system.vibrations(0.0, &rest, Held::Nothing).unwrap().modes;
    // Twice the kinetic energy of a body at a unit frequency.
    let energy = |shape: &[f64], number: usize| -> f64 {
        let body = &system.bodies()[number];
        let [a, b, c] = body.inertia;
        let weights = [body.mass, body.mass, body.mass, a, b, c];
        let coordinates = (0..6).filter_map(|k| system.position_of(number, k).map(|place| (k, place)));
        coordinates
            .map(|(k, place)| weights[k] * shape[place] * shape[place])
            .sum()
    };
    let count = system.bodies().len();
    let is_of_car = |shape: &[f64]| {
        let others: f64 = (1..count).map(|number| energy(shape, number)).sum();
        energy(shape, 0) > 10.0 * others
    };
    let own = modes.iter().filter(|mode| is_of_car(&mode.shape));
    let mut found: Vec<f64> = own.map(|mode| mode.frequency).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Springs and coil shear alone: bounce, yaw, longitudinal motion with pitch (two) and sway with roll (two)
/// of the loaded car, with the moment of its weight: from a separate calculation.
#[test]
fn analytic_frequencies_of_the_loaded_car_on_its_springs() {
    for (damping, expected) in [
        (Damping::Constant, [0.793, 1.618, 2.027, 2.559, 2.996, 3.157]),
        (Damping::Variable, [0.771, 1.470, 2.006, 2.306, 2.746, 3.099]),
    ] {
        let found = car_frequencies(car(damping, false));
        assert_eq!(found.len(), 6, "{found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found / expected - 1.0).abs() < 2e-3,
                "{damping:?}: {found} Hz, {expected} Hz expected"
            );
        }
    }
}

/// Wedge bodies stiffen a truck along the track even without friction: a bolster that moves by x presses four
/// of its wedges down their columns by x cot θ and lets the four others rise, on coils of stiffness k: k cot²
/// θ each. With constant damping wedges do not take part in bounce and sway.
#[test]
fn analytic_wedge_bodies_stiffen_a_car_along_the_track() {
    let [springs, wedges] = [false, true].map(|move_| car_frequencies(car(Damping::Constant, move_)));
    assert_eq!(wedges.len(), 6, "{wedges:?}");
    for k in [0, 2, 4] {
        assert!(
            (wedges[k] / springs[k] - 1.0).abs() < 3e-3,
            "{wedges:?} {springs:?}"
        );
    }
    let angle = 37.5_f64.to_radians();
    let (shear, wedging) = (16.0 * 4450.0, 8.0 * 1979.0 / angle.tan().powi(2));
    // Pitch takes a part of the motion, and its frequency is far away.
    let expected = (1.0 + wedging / shear).sqrt();
    let found = wedges[1] / springs[1];
    assert!(
        (found / expected - 1.0).abs() < 0.05,
        "{found}, {expected} expected: {wedges:?} {springs:?}"
    );
}

/// Normal forces of all contact points of a dropped half car after `time` (s), in a model whose fixed frame
/// is tilted by a quarter turn about y and moved by a mile if `moved`.
fn dropped(moved: bool, time: f64) -> Vec<f64> {
    let parameters = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        lift: 0.5 * INCH,
        ..Parameters::new(Damping::Variable)
    };
    let mut model = Model::new(
        bodies(&parameters, Mount::ALONE.center),
        [0.0, 0.0, -parameters.gravity],
    );
    add_elements(&mut model, &parameters, &Mount::ALONE);
    if moved {
        for body in &mut model.bodies {
            let [x, y, z] = body.frame.origin;
            // A quarter turn about y leads x to -z and z to x.
            body.frame.origin = [z + 1609.344, y - 800.0, -x];
            body.frame.orientation = [0.0, std::f64::consts::FRAC_PI_2, 0.0];
        }
        model.gravity = [-parameters.gravity, 0.0, 0.0];
    }
    let mut system = System::new(model).unwrap();
    let x = system.initial_state();
    let options = Options {
        relative_tolerance: 1e-9,
        ..Options::of(Method::Rodas5P)
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &x).unwrap();
    while integrator.time() < time {
        integrator.step_to(time).unwrap();
    }
    let seen = system.observe(time, integrator.x());
    seen.faces
        .iter()
        .flat_map(|face| face.points.iter().map(|point| point.normal))
        .collect()
}

#[test]
fn limits_a_truck_that_is_tilted_and_a_mile_away_does_the_same() {
    for time in [0.2, 1.0] {
        let (here, there) = (dropped(false, time), dropped(true, time));
        let largest = here.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
        assert!(largest > 1e4, "{largest} N");
        for (here, there) in here.iter().zip(&there) {
            assert!(
                (here - there).abs() < 1e-6 * largest,
                "{time} s: {here} and {there} N"
            );
        }
    }
}

/// The mount of a truck alone gives the truck.
#[test]
fn limits_a_truck_on_a_mount_is_a_truck() {
    let parameters = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..Parameters::new(Damping::Constant)
    };
    let alone = Truck::new(&parameters).unwrap();
    let center = [10.0, 0.0, 0.0];
    let mut model = Model::new(bodies(&parameters, center), [0.0, 0.0, -parameters.gravity]);
    let mount = Mount {
        center,
        ..Mount::ALONE
    };
    add_elements(&mut model, &parameters, &mount);
    let mut system = System::new(model).unwrap();
    let mut other = alone.system.clone();
    let [a, b] = [&mut system, &mut other].map(|system| {
        let x = system.initial_state();
        system.observe(0.0, &x)
    });
    let forces = |seen: &mechanics::system::Observation| -> Vec<f64> {
        seen.faces
            .iter()
            .flat_map(|face| face.points.iter().map(|point| point.normal))
            .collect()
    };
    for (a, b) in forces(&a).iter().zip(forces(&b)) {
        assert!((a - b).abs() < 1e-3, "{a} and {b} N");
    }
    assert!((a.energies.total() - b.energies.total()).abs() < 1e-6 * b.energies.total().abs());
}
