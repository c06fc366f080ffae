//! Contacts, and the places of prescribed bodies.

use super::*;
use crate::motions::sine;

// Contact

pub fn seen_from_origin(position: [f64; 3], velocity: [f64; 3], omega: [f64; 3]) -> RelativeMotion<f64> {
    RelativeMotion {
        position: Vector(position),
        rotation: Matrix::identity(),
        velocity: Vector(velocity),
        angular_velocity: Vector(omega),
    }
}

#[test]
fn normal_force_of_a_contact() {
    let (k, c) = (5e4, 300.0);
    let mut random = Random(6);
    let (mut lifted, mut open, mut pushed) = (0, 0, 0);
    let law = FrictionLaw::Tanh {
        reference_speed: 0.01,
    };
    for damping in [0.0, c] {
        let one = face("f", &[[0.0; 3]], k, damping, 0.3, law);
        for _ in 0..2000 {
            let gap = random.between(-0.01, 0.005);
            let velocity: [f64; 3] = random.vector(2.0);
            let relative = seen_from_origin([gap, 0.3, -0.2], velocity, [0.0; 3]);
            let mut contacts = Vec::new();
            let sum = one.clone().refined(Interface::default()).evaluate::<f64, f64>(
                &relative,
                &[],
                |_, contact| contacts.push(*contact),
            );
            let [contact] = contacts[..] else {
                panic!("one point")
            };
            assert_eq!(contact.gap, gap);
            if gap >= 0.0 {
                open += 1;
                assert_eq!((contact.normal, contact.friction.force), (0.0, [0.0; 2]));
                assert_eq!(sum.force.0, [0.0; 3]);
                continue;
            }
            let normal = (-k * gap - damping * velocity[0]).max(0.0);
            close(contact.normal, normal, 1e-11);
            assert!(contact.normal >= 0.0, "contact must not pull");
            close(sum.force.0[0], normal, 1e-11);
            close(
                norm(&contact.friction.force),
                0.3 * normal * (norm(&velocity[1..]) / 0.01).tanh(),
                1e-9,
            );
            // Power of the normal force = - d/dt (k g²/2) - loss, and nothing is won.
            let stored = k * gap * velocity[0];
            close(
                normal * velocity[0],
                -stored - contact.damping_loss,
                1e-12 * (stored.abs() + (normal * velocity[0]).abs()),
            );
            assert!(contact.damping_loss >= 0.0);
            if damping == 0.0 {
                assert_eq!(contact.damping_loss, 0.0);
            }
            lifted += i32::from(normal == 0.0);
            pushed += i32::from(normal > 0.0);
        }
    }
    assert!(lifted > 50 && open > 500 && pushed > 500);
}

#[test]
fn moment_of_a_contact_about_the_body() {
    let mut random = Random(7);
    let law = FrictionLaw::Tanh {
        reference_speed: 0.01,
    };
    let points = [[0.1, 0.2, 0.3], [-0.1, 0.4, -0.2], [0.05, -0.3, 0.1]];
    let one = face("f", &points, 1e4, 10.0, 0.3, law);
    for _ in 0..50 {
        let relative = seen_from_origin([-0.5, 0.1, 0.2], random.vector(1.0), random.vector(1.0));
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        let sum =
            one.clone()
                .refined(Interface::default())
                .evaluate::<f64, f64>(&relative, &[], |i, contact| {
                    let f = [
                        contact.normal,
                        contact.friction.force[0],
                        contact.friction.force[1],
                    ];
                    force = add(force, f);
                    moment = add(moment, cross(points[i], f));
                    // Velocity of a point of the body: v + ω × r.
                    let v = add(relative.velocity.0, cross(relative.angular_velocity.0, points[i]));
                    close(contact.gap_rate, v[0], 1e-14);
                    close(contact.slip[0], v[1], 1e-14);
                    close(contact.slip[1], v[2], 1e-14);
                    close(contact.gap, -0.5 + points[i][0], 1e-15);
                });
        assert!(norm(&force) > 1.0);
        for k in 0..3 {
            close(sum.force.0[k], force[k], 1e-10);
            close(sum.moment.0[k], moment[k], 1e-10);
        }
    }
}

/// A plate that turns at a constant rate about an arbitrary axis, under a body that turns and moves: place,
/// gap rate and slip of a point.
#[test]
fn surface_velocity_of_a_turning_plate() {
    let mut random = Random(8);
    for case in 0..40 {
        let spin = random.between(-5.0, 5.0);
        let angles: [f64; 3] = random.vector(1.0);
        // The base's z axis is the axis of rotation: Ry(pitch) Rz(yaw) Rx(roll) z.
        let turned = |v: [f64; 3]| {
            let v = rodrigues([1.0, 0.0, 0.0], angles[0], v);
            let v = rodrigues([0.0, 0.0, 1.0], angles[2], v);
            rodrigues([0.0, 1.0, 0.0], angles[1], v)
        };
        let axis = turned([0.0, 0.0, 1.0]);
        let origin: [f64; 3] = random.vector(1.0);
        let drift = random.between(-1.0, 1.0);
        let mut frame = Frame::fixed(origin, angles);
        let straight = |rate: f64| Motion::Ramp {
            amplitude: 1000.0 * rate,
            start: 0.0,
            duration: 1000.0,
            profile: RampProfile::Linear,
        };
        frame.motions[5] = straight(spin);
        frame.motions[0] = straight(drift);
        let plate = Body::prescribed("plate", frame);
        let initial: [f64; 6] = random.vector(0.5);
        let probe = body("probe", 1.0, [1.0; 3], [0.0; 3], ALL, initial);
        let tip: [f64; 3] = random.vector(0.5);
        let marker: [f64; 3] = random.vector(0.4);
        let mut parts = model(vec![plate, probe], [0.0; 3]);
        let law = FrictionLaw::Tanh {
            reference_speed: 0.01,
        };
        // Half of the cases: the plate's normal is the axis of rotation.
        let marker_angles = if case % 2 == 0 { UP } else { random.vector(1.0) };
        parts.faces.push((
            1,
            0,
            Marker::new(marker, marker_angles),
            face("f", &[tip], 1e3, 0.0, 0.5, law),
        ));
        let mut system = System::new(parts).unwrap();
        let time = 0.7;
        system.next_time_discontinuity(time);
        let mut x = system.initial_state();
        let yaw_rate = random.between(-2.0, 2.0);
        let glide: [f64; 3] = random.vector(1.0);
        x[6..9].copy_from_slice(&glide);
        x[11] = yaw_rate;
        let observation = system.observe(time, &x);
        // In closed form. The probe turns about Ry(pitch) z.
        let own = rodrigues([1.0, 0.0, 0.0], initial[3], tip);
        let own = rodrigues([0.0, 0.0, 1.0], initial[5], own);
        let arm = rodrigues([0.0, 1.0, 0.0], initial[4], own);
        let position = add([initial[0], initial[1], initial[2]], arm);
        let yaw_axis = rodrigues([0.0, 1.0, 0.0], initial[4], [0.0, 0.0, 1.0]);
        let velocity = add(glide, cross(times(yaw_axis, yaw_rate), arm));
        let moved = add(origin, times(turned([1.0, 0.0, 0.0]), drift * time));
        let from_axis = add(position, times(moved, -1.0));
        let surface = add(
            times(turned([1.0, 0.0, 0.0]), drift),
            cross(times(axis, spin), from_axis),
        );
        let expected = add(velocity, times(surface, -1.0));
        let state = &observation.faces[0];
        let point = &state.points[0];
        let got = state
            .axes
            .apply::<f64, f64>(Vector([point.gap_rate, point.slip[0], point.slip[1]]));
        for k in 0..3 {
            close(got.0[k], expected[k], 1e-13);
            close(state.point_positions[0].0[k], position[k], 1e-13);
        }
        if case % 2 == 0 {
            let along: f64 = (0..3).map(|k| expected[k] * axis[k]).sum();
            close(point.gap_rate, along, 1e-13);
            close(
                norm(&point.slip),
                norm(&add(expected, times(axis, -along))),
                1e-13,
            );
        }
    }
}

/// Slip speed of a fixed point above a spinning disc: Ω times the distance from the axis.
#[test]
fn slip_speed_on_a_disc() {
    let mut frame = Frame::fixed([0.0; 3], [0.0; 3]);
    frame.motions[5] = Motion::Ramp {
        amplitude: 3000.0,
        start: 0.0,
        duration: 1000.0,
        profile: RampProfile::Linear,
    };
    let mut parts = model(
        vec![
            body(
                "probe",
                1.0,
                [1.0; 3],
                [0.0; 3],
                [false, false, true, false, false, false],
                [0.3, 0.4, -0.01, 0.0, 0.0, 0.0],
            ),
            Body::prescribed("disc", frame),
        ],
        [0.0; 3],
    );
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    parts.faces.push((
        0,
        1,
        Marker::new([0.0; 3], UP),
        face("f", &[[0.0; 3]], 1e3, 0.0, 0.5, law),
    ));
    let mut system = System::new(parts).unwrap();
    system.next_time_discontinuity(0.0);
    let x = system.initial_state();
    for time in [0.0, 0.4, 1.3] {
        let observation = system.observe(time, &x);
        close(norm(&observation.faces[0].points[0].slip), 3.0 * 0.5, 1e-13);
        close(observation.faces[0].points[0].gap, -0.01, 1e-15);
        // Friction takes the point along with the disc: ω × r = 3 (-0.4, 0.3).
        let force = observation.faces[0].friction_forces[0].0;
        close(force[0], -0.8 * 0.5 * 10.0, 1e-12);
        close(force[1], 0.6 * 0.5 * 10.0, 1e-12);
        // The disc's motor delivers what friction loses: μN v.
        let dx = common::rates(&mut system, time, &x);
        close(dx[2], 5.0 * 1.5, 1e-12);
        close(dx[3], 5.0 * 1.5, 1e-12);
    }
}

#[test]
fn places_and_masses_of_prescribed_bodies() {
    // A prescribed body's mass has no effect: also not on the energies.
    let mut frame = Frame::fixed([1.0, 2.0, 3.0], [0.0; 3]);
    frame.motions[0] = sine();
    let light = Body::prescribed("base", frame);
    let heavy = Body {
        mass: 50.0,
        inertia: [1.0, 2.0, 3.0],
        ..light.clone()
    };
    let probe = body("probe", 1.0, [1.0; 3], [0.0; 3], ALL, [0.0; 6]);
    let [without, with] = [light, heavy].map(|base| {
        let mut system = System::new(model(vec![probe.clone(), base, ground()], [0.0, 0.0, -9.8])).unwrap();
        system.next_time_discontinuity(0.0);
        let x = system.initial_state();
        let observation = system.observe(0.4, &x);
        close(
            observation.bodies[1].travel.0[0],
            0.7 * (2.3f64 * 0.4 + 0.4).sin(),
            1e-15,
        );
        observation.energies
    });
    assert_eq!(without, with);
}
