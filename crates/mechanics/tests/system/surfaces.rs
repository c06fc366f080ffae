//! Curved surfaces, and grids of points on them.

use crate::common::{Ledger, Random, coil, ground, integrate, norm, options, over, rates};
use integrate::Method;
use mechanics::contact::{FrictionDirections, Interface, Sliding};
use mechanics::depth_surface::DepthSurface;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::spline::Spline;
use mechanics::surface::{ProfileDirection, SurfaceProfile, SurfaceShape};
use mechanics::system::{EnergyTermKind, Model, ModelError, System};
use mechanics::vector::Vector;

const TANH: FrictionLaw = FrictionLaw::Tanh {
    reference_speed: 1e-3,
};
const BRISTLE: FrictionLaw = FrictionLaw::Bristle {
    stiffness: 1e6,
    damping: 3e3,
};

fn arc(radius: f64, direction: ProfileDirection) -> Interface {
    shaped(
        SurfaceProfile::Arc {
            curvature: 1.0 / radius,
        },
        direction,
    )
}

fn shaped(profile: SurfaceProfile, direction: ProfileDirection) -> Interface {
    Interface {
        shape: SurfaceShape {
            profile,
            direction,
            worn: None,
        },
        ..Interface::default()
    }
}

/// A profile along z of the marker runs along -x of the ground, along y along y: see [`UP`].
#[test]
fn analytic_a_point_on_a_cylinder_has_its_distance_and_normal() {
    let mut random = Random(1);
    for direction in [ProfileDirection::Y, ProfileDirection::Z] {
        for radius in [0.5, 3.0, -2.0] {
            for _ in 0..50 {
                let angle = random.between(-0.7, 0.7);
                let gap = random.between(-0.05, 0.1);
                // The center of the cylinder lies below the origin by the radius.
                let out = radius + gap;
                let (sine, cosine) = libm::sincos(angle);
                let (s, z) = (out * sine, out * cosine - radius);
                let place = match direction {
                    ProfileDirection::Y => [random.between(-1.0, 1.0), s, z],
                    ProfileDirection::Z => [-s, random.between(-1.0, 1.0), z],
                };
                let mut initial = [0.0; 6];
                initial[..3].copy_from_slice(&place);
                let built = over(&[[0.0; 3]], arc(radius, direction), TANH, initial);
                let mut system = System::new(built).unwrap();
                let mut x = system.initial_state();
                let speeds = system.layout().speeds;
                for value in &mut x[speeds..speeds + 3] {
                    *value = random.between(-1.0, 1.0);
                }
                let velocity = Vector([x[speeds], x[speeds + 1], x[speeds + 2]]);
                let seen = system.observe(0.0, &x);
                let point = &seen.faces[0].points[0];
                assert!(
                    (point.gap - gap).abs() < 1e-14,
                    "{radius} {angle}: {} {gap}",
                    point.gap
                );
                let normal = match direction {
                    ProfileDirection::Y => [0.0, sine, cosine],
                    ProfileDirection::Z => [-sine, 0.0, cosine],
                };
                let rate = velocity.dot::<f64, f64>(Vector(normal));
                assert!((point.gap_rate - rate).abs() < 1e-14);
                let slip = velocity - Vector(normal).scale::<f64, f64>(rate);
                assert!((norm(&point.slip) - norm(&slip.0)).abs() < 1e-14);
                if gap < 0.0 {
                    let force = seen.faces[0].normal_forces[0];
                    for k in 0..3 {
                        assert!((force.0[k] - 1e6 * -gap * normal[k]).abs() < 1e-8);
                    }
                }
            }
        }
    }
}

/// A table of a circle's depths is the circle as far as a spline is.
#[test]
fn convergence_a_table_of_a_circle_is_the_circle() {
    let radius = 2.0;
    let error = |points: i32| {
        let s: Vec<f64> = (0..points)
            .map(|i| 1.6 * f64::from(i) / f64::from(points - 1) - 0.8)
            .collect();
        let circle = SurfaceProfile::Arc {
            curvature: 1.0 / radius,
        };
        let depths = s.iter().map(|s| circle.depth(*s)[0]).collect();
        let table = SurfaceProfile::Table(Spline::new(s, depths).unwrap());
        let mut worst: f64 = 0.0;
        let mut random = Random(2);
        for _ in 0..200 {
            let mut initial = [0.0; 6];
            (initial[0], initial[2]) = (random.between(-0.7, 0.7), random.between(-0.2, 0.1));
            let of = |profile: &SurfaceProfile| {
                let built = over(
                    &[[0.0; 3]],
                    shaped(profile.clone(), ProfileDirection::Z),
                    TANH,
                    initial,
                );
                let mut system = System::new(built).unwrap();
                let x = system.initial_state();
                system.observe(0.0, &x).faces[0].points[0].gap
            };
            worst = worst.max((of(&circle) - of(&table)).abs());
        }
        worst
    };
    let [coarse, fine] = [9, 17].map(error);
    assert!(coarse < 4e-5 && fine < coarse / 10.0, "{coarse} {fine}");
}

#[test]
fn limits_an_arc_of_no_curvature_is_the_plane() {
    let points = [
        [0.3, 0.4, -0.2],
        [0.3, -0.4, -0.2],
        [-0.3, 0.4, -0.2],
        [-0.3, -0.4, -0.2],
        [0.0, 0.1, -0.2],
    ];
    let mut random = Random(3);
    for law in [TANH, BRISTLE] {
        let initial = [0.1, -0.2, 0.1995, 0.0, 0.0, 0.0];
        let flat = over(&points, Interface::default(), law, initial);
        let straight = over(
            &points,
            shaped(SurfaceProfile::Arc { curvature: 0.0 }, ProfileDirection::Y),
            law,
            initial,
        );
        let far = over(&points, arc(1e13, ProfileDirection::Z), law, initial);
        let mut systems = [flat, straight, far].map(|model| System::new(model).unwrap());
        for _ in 0..50 {
            let mut x = systems[0].initial_state();
            let (speeds, quadratures) = (systems[0].layout().speeds, systems[0].layout().quadratures);
            let count = x.len() - quadratures;
            for value in &mut x[..speeds] {
                *value += random.between(-1e-3, 1e-3);
            }
            for value in &mut x[speeds..2 * speeds] {
                *value = random.between(-1e-2, 1e-2);
            }
            for value in &mut x[2 * speeds..count] {
                *value = random.between(-1e-5, 1e-5);
            }
            let [plain, straight, far] = systems.each_mut().map(|system| rates(system, 0.0, &x));
            let size = norm(&plain);
            for (i, plain) in plain.iter().enumerate() {
                assert!(
                    (straight[i] - plain).abs() <= 1e-12 * size,
                    "{i}: {} {plain}",
                    straight[i]
                );
                assert!((far[i] - plain).abs() <= 1e-9 * size, "{i}: {} {plain}", far[i]);
            }
        }
    }
}

const RADIUS: f64 = 1.0;
/// Stiffness of the strip, N/m, and its half width, m.
const STRIP: (f64, f64) = (1e7, 0.3);

/// Returns the force of a flat strip with so many points of the trapezoidal rule on a cylinder, pressed in by
/// `depth`, its middle shifted and turned as a body that rolls: vertical force, and its place across the
/// strip.
fn pressed(count: usize, depth: f64, shift: f64) -> [f64; 2] {
    let (stiffness, half) = STRIP;
    let place = |i: usize| 2.0 * half * i as f64 / (count - 1) as f64 - half;
    let points: Vec<[f64; 3]> = (0..count).map(|i| [0.0, place(i), 0.0]).collect();
    let mut built = over(
        &points,
        arc(RADIUS, ProfileDirection::Y),
        TANH,
        [0.0, shift, -depth, 0.0, 0.0, 0.0],
    );
    for (i, point) in built.faces[0].3.points.iter_mut().enumerate() {
        let end = i == 0 || i == count - 1;
        point.stiffness = stiffness * if end { 0.5 } else { 1.0 } / (count - 1) as f64;
    }
    let mut system = System::new(built).unwrap();
    let x = system.initial_state();
    let seen = system.observe(0.0, &x);
    let (mut force, mut moment) = (0.0, 0.0);
    for (position, normal) in seen.faces[0]
        .point_positions
        .iter()
        .zip(&seen.faces[0].normal_forces)
    {
        force += normal.0[2];
        moment += position.0[1] * normal.0[2] - position.0[2] * normal.0[1];
    }
    [force, moment / force]
}

/// Returns the closed form: k ∫ (R - ρ)(R - d)/ρ dy with ρ² = (R - d)² + y² over the pressed part of the
/// strip.
fn closed_form(depth: f64) -> f64 {
    let (stiffness, half) = STRIP;
    let low = RADIUS - depth;
    let end = (RADIUS * RADIUS - low * low).sqrt().min(half);
    let density = stiffness / (2.0 * half);
    2.0 * density * low * (RADIUS * libm::asinh(end / low) - end)
}

/// With L spacings on the pressed part the force is off by at most 1/L², its stiffness by 1/L.
#[test]
fn convergence_a_cylinder_on_a_strip_meets_the_closed_form_of_distributed_springs() {
    // Nine points, all of them pressed.
    let deep = 0.075;
    let found = pressed(9, deep, 0.0)[0];
    assert!(
        (found / closed_form(deep) - 1.0).abs() < 0.01,
        "{found} {}",
        closed_form(deep)
    );
    let mut random = Random(5);
    for _ in 0..200 {
        let depth = random.between(0.002, 0.03);
        let count = 9 + (random.between(0.0, 80.0)) as usize;
        let half = (2.0 * RADIUS * depth).sqrt();
        let spacings = half / STRIP.1 * (count - 1) as f64;
        // Rolling and sliding: the strip lies elsewhere over the cylinder, by parts of a spacing.
        if spacings < 8.0 {
            continue;
        }
        let [force, _] = pressed(count, depth, 0.0);
        let bound = 1.1 / (spacings * spacings);
        assert!(
            (force / closed_form(depth) - 1.0).abs() < bound,
            "{count} {depth}"
        );
        let step = 1e-7;
        let slope = |f: &dyn Fn(f64) -> f64| (f(depth + step) - f(depth - step)) / (2.0 * step);
        let [own, exact] = [slope(&|d| pressed(count, d, 0.0)[0]), slope(&closed_form)];
        assert!(
            (own / exact - 1.0).abs() < 1.1 / spacings,
            "{count} {depth}: {own} {exact}"
        );
    }
    // 9, 17, 33, ... points: order 2.
    let errors: Vec<f64> = [9, 17, 33, 65, 129]
        .map(|count| (pressed(count, deep, 0.0)[0] / closed_form(deep) - 1.0).abs())
        .to_vec();
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.1, "{errors:?}");
    }
}

/// Wherever the strip slides to, the force stays over the top of the cylinder, where the two touch.
#[test]
fn convergence_the_place_of_contact_stays_while_the_strip_slides() {
    let depth = 0.005;
    let half = (2.0 * RADIUS * depth).sqrt();
    for count in [17, 33, 65, 129] {
        let spacings = half / STRIP.1 * (count - 1) as f64;
        for i in 0..20 {
            let [force, place] = pressed(count, depth, 0.13 * f64::from(i) / 20.0);
            assert!(
                place.abs() < 0.75 * half / spacings / spacings + 1e-12,
                "{count}: {place}"
            );
            assert!((force / closed_form(depth) - 1.0).abs() < 1.1 / (spacings * spacings));
        }
    }
}

/// Returns a block that slides and rocks over a crown, pressed on by a coil.
fn rocking(interface: Interface, law: FrictionLaw) -> Model {
    let points: Vec<[f64; 3]> = (0..15)
        .map(|i| [0.1 * f64::from(i % 5) - 0.2, 0.1 * f64::from(i / 5) - 0.1, -0.1])
        .collect();
    let mut model = over(&points, interface, law, [0.02, 0.01, 0.0999, 0.0, 0.0, 0.0]);
    model.faces[0]
        .3
        .points
        .iter_mut()
        .for_each(|point| point.damping = 30.0);
    let mut platform = ground();
    platform.frame.motions[1] = Motion::Sine {
        amplitude: 0.05,
        angular_frequency: 9.0,
        phase: 0.0,
    };
    platform.frame.motions[3] = Motion::Sine {
        amplitude: 0.02,
        angular_frequency: 7.0,
        phase: 0.3,
    };
    model.bodies.push(platform);
    model.faces[0].1 = 2;
    for x in [-0.1, 0.1] {
        model.coils.push((
            1,
            0,
            Marker::new([x, 0.02, 1.0], [0.0; 3]),
            coil([x, 0.0, 0.1], [x, 0.0, 0.1], 2000.0, 1.2),
        ));
    }
    model
}

#[test]
fn energy_closes_on_crowns_with_refined_friction() {
    let refined = |shape: SurfaceShape| Interface {
        shape,
        sliding: Sliding {
            ratio: 0.5,
            stribeck_speed: 0.1,
            half_load: 3000.0,
        },
        directions: FrictionDirections::One,
        friction_factors: (0..15).map(|i| 0.7 + 0.05 * f64::from(i)).collect(),
        hardening: Some(2e-4),
        first_arm: 0.0,
    };
    let table = Spline::new(vec![-0.5, -0.2, 0.1, 0.5], vec![0.03, 0.004, 0.002, 0.04]).unwrap();
    for (interface, law) in [
        (arc(2.0, ProfileDirection::Y), TANH),
        (refined(arc(1.5, ProfileDirection::Z).shape), TANH),
        (
            refined(shaped(SurfaceProfile::Table(table), ProfileDirection::Y).shape),
            BRISTLE,
        ),
        (
            worn(mapped(0.6, 7, |y, z| {
                0.3 * y * y + 0.2 * z * z + 0.25 * y * z + 0.002 * libm::sin(9.0 * z)
            })),
            BRISTLE,
        ),
    ] {
        let model = rocking(interface, law);
        let mut system = System::new(model).unwrap();
        let x = system.initial_state();
        let start = Ledger::at(&mut system, 0.0, &x);
        let end = integrate(system.clone(), options(Method::Rodas5P, 1e-8), &x, 1.0, |_| {});
        let last = Ledger::at(&mut system, 1.0, end.x());
        let lost: f64 = last.losses.iter().map(|(_, value)| value).sum();
        assert!(lost > 0.2, "{lost}");
        let residual = last.residual(&start, |_| true);
        assert!(residual.abs() < 1e-5 * lost, "{residual} of {lost}");
        // A loss of the face that is left out is noticed.
        for kind in [EnergyTermKind::FrictionLoss, EnergyTermKind::ContactDampingLoss] {
            let without = last.residual(&start, |own| own != kind);
            assert!(without.abs() > 1e-3 * lost, "{kind:?}: {without} of {lost}");
        }
    }
}

#[test]
fn input_an_interface_that_does_not_fit_its_face_is_refused() {
    let mut built = over(&[[0.0; 3]], Interface::default(), TANH, [0.0; 6]);
    built.interfaces[0].1.friction_factors = vec![1.0, 2.0];
    let error = System::new(built.clone()).unwrap_err();
    assert!(
        matches!(
            error,
            ModelError::Interface {
                face: 0,
                points: 1,
                factors: 2,
                ..
            }
        ),
        "{error}"
    );
    built.interfaces[0] = (3, Interface::default());
    let error = System::new(built).unwrap_err().to_string();
    assert!(error.contains("face 3 of 1"), "{error}");
}

/// Places and depths of a map over ±`half` with `count` places each way.
fn mapped(half: f64, count: usize, depth: impl Fn(f64, f64) -> f64) -> DepthSurface {
    let places: Vec<f64> = (0..count)
        .map(|i| half * (2.0 * i as f64 / (count - 1) as f64 - 1.0))
        .collect();
    let depths: Vec<f64> = places
        .iter()
        .flat_map(|z| places.iter().map(|y| depth(*y, *z)))
        .collect();
    DepthSurface::new(places.clone(), places, &depths).unwrap()
}

fn worn(worn: DepthSurface) -> Interface {
    let mut interface = shaped(SurfaceProfile::Flat, ProfileDirection::Z);
    interface.shape.worn = Some(worn);
    interface
}

/// A map of a sphere's depths has the sphere's distances and normals, as far as a spline is the sphere.
#[test]
fn convergence_a_map_of_a_sphere_is_the_sphere() {
    let radius = 2.0;
    let sphere = |y: f64, z: f64| radius - (radius * radius - y * y - z * z).sqrt();
    let errors: Vec<f64> = [9, 17, 33]
        .into_iter()
        .map(|count| {
            let shape = worn(mapped(1.0, count, sphere)).shape;
            let mut random = Random(3);
            let mut most: f64 = 0.0;
            for _ in 0..200 {
                let (y, z) = (random.between(-0.6, 0.6), random.between(-0.6, 0.6));
                let gap = random.between(-0.1, 0.3);
                let x = (radius * radius - y * y - z * z).sqrt();
                let out = [x, y, z].map(|part| part * (radius + gap) / radius);
                let point = Vector([out[0] - radius, out[1], out[2]]);
                most = most.max((shape.gap(point) - gap).abs());
                let normal = shape.compose(point, [1.0, 0.0, 0.0]);
                for k in 0..3 {
                    most = most.max((normal.0[k] - [x, y, z][k] / radius).abs());
                }
                // Three axes at right angles.
                let own = shape.resolve(point, Vector([0.3, -0.5, 0.8]));
                assert!((norm(&own) - norm(&[0.3, -0.5, 0.8])).abs() < 1e-14);
            }
            most
        })
        .collect();
    assert!(errors[2] < 1e-5, "{errors:?}");
    assert!(
        errors[1] < 0.25 * errors[0] && errors[2] < 0.25 * errors[1],
        "{errors:?}"
    );
}

/// A map of no depth is the plane, and one of a parabola along one tangent is the table of it.
#[test]
fn limits_maps_are_planes_and_tables() {
    let table = |direction| {
        let places = vec![-1.0, -0.5, 0.5, 1.0];
        let depths = places.iter().map(|s| 0.2 * s * s).collect();
        shaped(
            SurfaceProfile::Table(Spline::new(places, depths).unwrap()),
            direction,
        )
        .shape
    };
    let flat = worn(mapped(1.0, 5, |_, _| 0.0)).shape;
    let along_y = worn(mapped(1.0, 5, |y, _| 0.2 * y * y)).shape;
    let along_z = worn(mapped(1.0, 5, |_, z| 0.2 * z * z)).shape;
    let mut random = Random(4);
    for _ in 0..100 {
        let point = Vector([
            random.between(-0.1, 0.1),
            random.between(-0.8, 0.8),
            random.between(-0.8, 0.8),
        ]);
        assert_eq!(flat.gap(point), point.0[0]);
        let vector = Vector([0.4, 0.7, -0.2]);
        assert_eq!(flat.resolve(point, vector), vector.0);
        for (map, table) in [
            (&along_y, table(ProfileDirection::Y)),
            (&along_z, table(ProfileDirection::Z)),
        ] {
            assert!((map.gap(point) - table.gap(point)).abs() < 1e-14);
            let (one, other) = (map.resolve(point, vector), table.resolve(point, vector));
            for k in 0..3 {
                assert!((one[k] - other[k]).abs() < 1e-13, "{one:?} {other:?}");
            }
        }
    }
}
