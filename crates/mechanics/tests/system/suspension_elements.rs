//! Elements of suspensions: closed forms, both ends' derivatives against differences, the energy ledger,
//! momentum of free bodies.

use crate::common::Random;
use integrate::{Integrator, Options, Problem};
use mechanics::body::Body;
use mechanics::curve::Curve;
use mechanics::element::Element;
use mechanics::elements::{DraftGear, RadialStop, ShearSpring, Solid, Stop, TableSpring};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::system::{Model, System};
use mechanics::vector::{Matrix, Vector};

fn motion(position: [f64; 3], velocity: [f64; 3]) -> RelativeMotion<f64> {
    RelativeMotion {
        position: Vector(position),
        rotation: Matrix::identity(),
        velocity: Vector(velocity),
        angular_velocity: Vector::zero(),
    }
}

fn spring() -> ShearSpring {
    ShearSpring {
        name: "spring".to_owned(),
        preload: 2000.0,
        stiffness: 1e5,
        shear_stiffness: 7e4,
        damping: 300.0,
        solid: Some(Solid {
            at: -0.03,
            stiffness: 4e6,
        }),
    }
}

fn table_spring() -> TableSpring {
    let points = vec![[-0.03, 8000.0], [-0.01, 3000.0], [0.0, 2000.0], [0.02, -100.0]];
    let mut spring = TableSpring::new("table_spring", &Curve::new(points).unwrap());
    spring.shear_stiffness = 7e4;
    spring.tilt_stiffness = 300.0;
    spring.damping = 200.0;
    spring
}

fn stop() -> Stop {
    Stop {
        name: "stop".to_owned(),
        clearances: [0.004, 0.006],
        stiffness: 2e6,
        damping: 500.0,
    }
}

fn rim() -> RadialStop {
    RadialStop {
        name: "rim".to_owned(),
        clearance: 0.005,
        stiffness: 2e6,
        damping: 500.0,
    }
}

#[test]
fn analytic_a_spring_pushes_shears_goes_solid_and_lifts_off() {
    let spring = spring();
    let force = |position, velocity| spring.evaluate(&motion(position, velocity)).force.0;
    let close = |found: [f64; 3], expected: [f64; 3]| {
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-9 * (1.0 + expected.abs()),
                "{found} {expected}"
            );
        }
    };
    close(force([0.0; 3], [0.0; 3]), [0.0, 0.0, 2000.0]);
    close(force([0.01, -0.02, 0.005], [0.0; 3]), [-700.0, 1400.0, 1500.0]);
    close(force([0.0; 3], [0.1, 0.2, -0.3]), [-30.0, -60.0, 2090.0]);
    // 0.01 m beyond solid.
    close(force([0.0, 0.0, -0.04], [0.0; 3]), [0.0, 0.0, 6000.0 + 40_000.0]);
    // Half of the last 5 % of the preload: half of the shear and of the damping. The shear's 3.5 J fade
    // along 1 mm, with 15/8 of the mean rate in the middle.
    close(
        force([0.01, 0.0, 0.0195], [0.0, 0.0, 1.0]),
        [-350.0, 0.0, 50.0 - 150.0 + 1.875 * 3500.0],
    );
    close(force([0.01, 0.02, 0.021], [1.0, 2.0, 3.0]), [0.0; 3]);
}

/// Loads of the table, never negative; shear and damping act without load too; a tilt is pushed back by `k_t
/// sin`.
#[test]
fn analytic_a_table_spring_pushes_by_its_table_and_rights_its_body() {
    let spring = table_spring();
    for (z, load) in [
        (0.0, 2000.0),
        (-0.02, 5500.0),
        (-0.05, 13_000.0),
        (0.01, 950.0),
        (0.03, 0.0),
    ] {
        let force = spring
            .evaluate(&motion([0.01, -0.02, z], [0.0, 0.0, 0.1]))
            .force
            .0;
        for (found, expected) in force.iter().zip([-700.0, 1400.0, load - 20.0]) {
            assert!(
                (found - expected).abs() < 1e-9 * (1.0 + expected.abs()),
                "{z}: {force:?}"
            );
        }
    }
    let (sine, cosine) = 0.3_f64.sin_cos();
    let mut tilted = motion([0.0; 3], [0.0; 3]);
    // About x: the z axis goes towards -y.
    tilted.rotation = Matrix([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]]);
    let moment = spring.evaluate(&tilted).moment.0;
    assert!((moment[0] + 300.0 * sine).abs() < 1e-12 && moment[1] == 0.0 && moment[2] == 0.0);
    assert!((spring.energy(&tilted) - 300.0 * (1.0 - cosine)).abs() < 1e-12);
    let about_z = Matrix([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]);
    tilted.rotation = about_z;
    assert!(spring.evaluate(&tilted).moment.0.iter().all(|own| *own == 0.0));
}

#[test]
fn analytic_stops_leave_their_clearance_and_never_pull() {
    let stop = stop();
    let force = |x: f64, v: f64| stop.evaluate(&motion([x, 0.1, -0.2], [v, 3.0, 4.0])).force.0;
    assert_eq!(force(0.0059, 1.0), [0.0; 3]);
    assert_eq!(force(-0.0039, -1.0), [0.0; 3]);
    assert!((force(0.007, 0.1)[0] + 2050.0).abs() < 1e-6);
    assert!((force(-0.005, -0.1)[0] - 2050.0).abs() < 1e-6);
    assert_eq!(force(0.007, -10.0), [0.0; 3]);
    let open = Stop {
        clearances: [f64::INFINITY, 0.0],
        ..stop.clone()
    };
    assert_eq!(
        open.evaluate(&motion([-5.0, 0.0, 0.0], [0.0; 3])).force.0,
        [0.0; 3]
    );
    let rim = rim();
    let force = rim.evaluate(&motion([0.0048, 0.0064, 0.3], [0.0; 3])).force.0;
    // 0.008 m from the axis: 6000 N along (-0.6, -0.8).
    for (found, expected) in force.iter().zip([-3600.0, -4800.0, 0.0]) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    assert_eq!(rim.evaluate(&motion([0.0; 3], [1.0; 3])).force.0, [0.0; 3]);
}

/// The power of the force is minus the rate of the stored energy, less the power lost.
#[test]
fn energy_rate_and_loss_of_each_law_make_its_power() {
    fn check(law: &impl Element, random: &mut Random, size: f64) {
        let mut acted = 0;
        for _ in 0..2000 {
            let (position, velocity) = (random.vector::<3>(size), random.vector::<3>(1.0));
            let wrench = law.evaluate(&motion(position, velocity));
            let h = 1e-8;
            let at = |sign: f64| {
                let moved = std::array::from_fn(|i| position[i] + sign * h * velocity[i]);
                law.energy(&motion(moved, velocity))
            };
            let rate = (at(1.0) - at(-1.0)) / (2.0 * h);
            let power: f64 = wrench.force.dot::<f64, f64>(Vector(velocity));
            let size = 1.0 + power.abs() + rate.abs();
            assert!(
                (power + rate + wrench.powers[0]).abs() < 1e-4 * size,
                "{position:?} {velocity:?}"
            );
            acted += usize::from(power != 0.0);
        }
        assert!(
            acted > 100,
            "{} acted in {acted} of 2000 motions only",
            law.name()
        );
    }
    let mut random = Random(7);
    check(&spring(), &mut random, 0.05);
    check(&table_spring(), &mut random, 0.05);
    check(&stop(), &mut random, 0.05);
    check(&rim(), &mut random, 0.02);
}

/// Returns two free bodies, every element between them at turned markers.
fn pair(random: &mut Random) -> System {
    let body = |name, at| Body::free(name, 20.0, [0.3, 0.5, 0.4], at);
    let first = [0.0, 0.0, 0.3, 0.01, -0.02, 0.03];
    let mut model = Model::new(vec![body("seat", [0.0; 6]), body("carried", first)], [0.0; 3]);
    let turned = |angles| Marker::new([0.0, 0.05, 0.3], angles);
    let at = Marker::new([0.001, 0.049, -0.002], [0.0; 3]);
    model.add(spring(), (1, at), (0, turned(random.vector(0.1))));
    model.add(table_spring(), (1, at), (0, turned(random.vector(0.3))));
    model.add(stop(), (1, at), (0, turned(random.vector(3.0))));
    model.add(rim(), (1, at), (0, turned(random.vector(3.0))));
    System::new(model).unwrap()
}

#[test]
fn analytic_derivatives_of_both_ends_against_differences() {
    for seed in 0..12 {
        let mut random = Random(seed);
        let mut system = pair(&mut random);
        let mut x = system.initial_state();
        let n = x.len();
        for value in &mut x[..12] {
            *value += random.between(-0.008, 0.008);
        }
        for value in &mut x[12..24] {
            *value = random.between(-0.5, 0.5);
        }
        let direction = random.vector::<24>(1.0);
        let h = 1e-8;
        let mut value = |sign: f64| {
            let mut moved = x.clone();
            for (x, y) in moved.iter_mut().zip(direction) {
                *x += sign * h * y;
            }
            let mut dx = vec![0.0; n];
            system.derivative(0.0, &moved, &mut dx);
            dx
        };
        let (up, down) = (value(1.0), value(-1.0));
        let dx = value(0.0);
        system.linearize(0.0, &x, &dx, &mut vec![0.0; n]);
        let shift = 1000.0;
        system.factor(shift).unwrap();
        let mut right: Vec<f64> = (0..n)
            .map(|i| shift * direction.get(i).unwrap_or(&0.0) - (up[i] - down[i]) / (2.0 * h))
            .collect();
        system.solve(&mut right);
        for (found, expected) in right.iter().zip(direction) {
            assert!((found - expected).abs() < 1e-3, "{found} {expected}, seed {seed}");
        }
    }
}

#[test]
fn energy_and_momentum_of_two_free_bodies_are_kept() {
    let mut system = pair(&mut Random(3));
    let mut x = system.initial_state();
    x[12..24].copy_from_slice(&[0.3, -0.2, 0.1, 1.0, -2.0, 0.5, -0.4, 0.2, -0.6, -1.0, 1.5, 0.7]);
    let momentum = |system: &mut System, time: f64, x: &[f64]| -> [f64; 6] {
        let observation = system.observe(time, x);
        let mut sum = [0.0; 6];
        for body in &observation.bodies {
            let own: Vector<f64> = body.rotation.apply_transposed(body.angular_velocity);
            let spin = Vector([0.3 * own.0[0], 0.5 * own.0[1], 0.4 * own.0[2]]);
            let spin: Vector<f64> = body.rotation.apply(spin);
            let linear: Vector<f64> = body.velocity.scale(20.0);
            let orbital: Vector<f64> = body.center_of_gravity.cross(linear);
            for k in 0..3 {
                sum[k] += linear.0[k];
                sum[3 + k] += orbital.0[k] + spin.0[k];
            }
        }
        sum
    };
    let before = momentum(&mut system, 0.0, &x);
    let start = system.observe(0.0, &x).energies.total();
    let options = Options {
        relative_tolerance: 1e-10,
        ..Options::default()
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &x).unwrap();
    while integrator.time() < 0.5 {
        integrator.step_to(0.5).unwrap();
    }
    let after = momentum(&mut system, 0.5, integrator.x());
    for (before, after) in before.iter().zip(after) {
        assert!((before - after).abs() < 1e-8, "{before} {after}");
    }
    let observation = system.observe(0.5, integrator.x());
    let residual = observation.residual(start);
    assert!(
        observation.losses > 0.01 * start,
        "{} of {start} J lost",
        observation.losses
    );
    assert!(residual.abs() < 1e-5 * start, "residual {residual} of {start} J");
}

/// The rating of Miner's TF-880: 2.93 in, 566,000 lbf, 45,520 ft lbf (product page), by a curve of the
/// power 2.04 in twelve pieces.
fn draft_gear() -> DraftGear {
    let (travel, reaction) = (2.93 * 0.0254, 566e3 * 4.448_221_615_260_5);
    let points = (0..=12).map(|k| {
        let share = f64::from(k) / 12.0;
        [share * travel, share.powf(2.04) * reaction]
    });
    DraftGear {
        name: "gear".to_owned(),
        length: 1.5,
        slack: [0.01, 0.0],
        loading: Curve::new(points.collect()).unwrap(),
        returned: 0.2,
        reference_speed: 1e-3,
    }
}

/// The capacity of the usual curve is that of the rating; a slow cycle loses the share that is not
/// returned, in buff and in draft, each beyond its slack.
#[test]
fn analytic_a_draft_gear_takes_its_rated_energy() {
    let own = draft_gear();
    let (travel, speed) = (2.93 * 0.0254, 0.05);
    let capacity = own.loading.integral(travel);
    let rated = 45_520.0 * 0.3048 * 4.448_221_615_260_5;
    assert!((capacity / rated - 1.0).abs() < 0.02, "{capacity} J, {rated} J");
    for (sign, slack) in [(1.0, 0.0), (-1.0, 0.01)] {
        let steps = 20_000;
        let (mut work, mut lost) = (0.0, 0.0);
        for way in [1.0, -1.0] {
            for k in 0..steps {
                let share = (f64::from(k) + 0.5) / f64::from(steps);
                let pressed = travel * if way > 0.0 { share } else { 1.0 - share };
                let [push, loss] = own.push(sign * (pressed + slack), sign * way * speed);
                assert!(loss >= 0.0 && push * sign >= 0.0);
                work += push * sign * way * travel / f64::from(steps);
                lost += loss * travel / speed / f64::from(steps);
            }
        }
        assert!(
            (work / (0.8 * capacity) - 1.0).abs() < 1e-6,
            "{work} J of {capacity} J"
        );
        assert!((lost / work - 1.0).abs() < 1e-9, "{lost} J of {work} J");
    }
    assert_eq!(own.push(-0.009, 0.5), [0.0, 0.0]);
}

/// Two cars of 30 t meet at 2 m/s, uncoupled: their momentum stays, and what is lost is in the ledger.
#[test]
fn energy_a_draft_gear_stops_two_cars() {
    let mass = 30e3;
    let body = |name: &str, x: f64| {
        let mut own = Body::free(name, mass, [mass; 3], [0.0; 6]);
        own.frame.origin = [x, 0.0, 0.0];
        own
    };
    let mut model = Model::new(vec![body("front", 1.6), body("rear", 0.0)], [0.0; 3]);
    let at = Marker::new([0.0; 3], [0.0; 3]);
    let own = DraftGear {
        reference_speed: 0.01,
        slack: [10.0, 0.0],
        ..draft_gear()
    };
    model.add(own, (0, at), (1, at));
    let mut system = System::new(model).unwrap();
    let mut state = system.initial_state();
    let speeds = system.layout().speeds;
    let [front, rear] = [0, 1].map(|body| speeds + system.position_of(body, 0).unwrap());
    (state[front], state[rear]) = (-1.0, 1.0);
    let start = system.observe(0.0, &state).energies.total();
    let options = Options {
        relative_tolerance: 1e-8,
        ..Options::default()
    };
    let mut integrator = Integrator::new(system.clone(), options, 0.0, &state).unwrap();
    while integrator.time() < 1.0 {
        integrator.step_to(1.0).unwrap();
    }
    let x = integrator.x();
    assert!((x[front] + x[rear]).abs() < 1e-9);
    let seen = system.observe(1.0, x);
    assert!(
        seen.residual(start).abs() < 1e-6 * start,
        "{} J",
        seen.residual(start)
    );
    // They part with the share that is returned of the energy that they met with, but for what tanh takes.
    let kept = seen.energies.kinetic / start;
    assert!((kept - 0.2).abs() < 0.02, "{kept}");
}
