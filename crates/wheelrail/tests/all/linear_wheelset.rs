//! reproduction, analytic: a wheelset on springs with linear geometry and creep; agreement with the contact
//! search.

use numerics::scalar::Dual;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{
    ContactLaw, CreepCoefficients, CreepLaw, LinearWheelset, Side, WheelMotion, WheelPose,
};
use wheelrail::creep::Patch;
use wheelrail::friction::Friction;
use wheelrail::hertz::{Hertz, Material};
use wheelrail::profile::nominal;
use wheelrail::wheelset::{Layout, RigidWheelset};

/// Mass, moment of inertia, lateral and yaw stiffness of a suspension.
struct Suspended {
    wheelset: LinearWheelset,
    mass: f64,
    inertia: f64,
    stiffness: [f64; 2],
}

fn suspended(
    [mass, inertia, lateral, yaw]: [f64; 4],
    [f11, f22]: [f64; 2],
    [conicity, radius, half_distance]: [f64; 3],
) -> Suspended {
    Suspended {
        wheelset: LinearWheelset {
            geometry: LinearGeometry::of_cones(conicity, half_distance, radius),
            creep: CreepCoefficients {
                f11,
                f22,
                f23: 0.0,
                f33: 0.0,
            },
            spin: false,
            axle_load: 0.0,
        },
        mass,
        inertia,
        stiffness: [lateral, yaw],
    }
}

impl Suspended {
    /// Hurwitz's determinant of the characteristic polynomial of `M q'' = F(q, q')` at a speed: positive if
    /// stable.
    fn hurwitz(&self, speed: f64) -> f64 {
        let at = |i: usize| Dual::<4>::variable(0.0, i);
        let forces = self.wheelset.forces([at(0), at(1)], [at(2), at(3)], speed);
        let inverse = [1.0 / self.mass, 1.0 / self.inertia];
        // Stiffness and damping over mass.
        let k: [[f64; 2]; 2] = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let spring = if row == column { self.stiffness[row] } else { 0.0 };
                (spring - forces[row].derivative[column]) * inverse[row]
            })
        });
        let c: [[f64; 2]; 2] = std::array::from_fn(|row| {
            std::array::from_fn(|column| -forces[row].derivative[2 + column] * inverse[row])
        });
        // det(s² + c s + k) = s⁴ + a1 s³ + a2 s² + a3 s + a4.
        let a1 = c[0][0] + c[1][1];
        let a2 = k[0][0] + k[1][1] + c[0][0] * c[1][1] - c[0][1] * c[1][0];
        let a3 = c[0][0] * k[1][1] + k[0][0] * c[1][1] - c[0][1] * k[1][0] - k[0][1] * c[1][0];
        let a4 = k[0][0] * k[1][1] - k[0][1] * k[1][0];
        a1 * a2 * a3 - a3 * a3 - a1 * a1 * a4
    }

    fn critical_speed(&self) -> f64 {
        let (mut low, mut high) = (1.0, 1000.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            *(if self.hurwitz(middle) > 0.0 {
                &mut low
            } else {
                &mut high
            }) = middle;
        }
        low
    }
}

/// Critical speeds of two wheelsets from another program's eigenvalues, to their digits; a free wheelset is
/// unstable at any speed.
#[test]
fn reproduction_critical_speeds_of_a_wheelset() {
    let first = suspended([1250.0, 700.0, 2.5e5, 2.5e6], [1e7, 1e7], [0.05, 0.45, 0.7452]);
    let second = suspended(
        [1568.0, 656.0, 4e5, 1.5e6],
        [9.43e6, 10.2e6],
        [0.05, 0.4572, 0.7465],
    );
    for (wheelset, expected) in [(first, 117.1532), (second, 90.7235)] {
        let found = wheelset.critical_speed();
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
    let free = suspended([1250.0, 700.0, 0.0, 0.0], [1e7, 1e7], [0.05, 0.45, 0.7452]);
    for speed in [0.1, 1.0, 10.0] {
        assert!(free.hurwitz(speed) < 0.0);
    }
}

/// Spin leads and gravity holds: signs and sizes of their terms, one by one.
#[test]
fn analytic_terms_of_spin_and_gravity() {
    let mut wheelset = suspended([1.0; 4], [1e7, 1e7], [0.05, 0.45, 0.75]).wheelset;
    wheelset.creep.f23 = 2e4;
    wheelset.creep.f33 = 30.0;
    let plain = wheelset.forces([1e-3, 2e-3], [0.01, 0.02], 20.0);
    let lateral = 0.01 / 20.0 - 2e-3;
    assert!((plain[0] + 2e7 * lateral).abs() < 1e-9);
    let rate = wheelset.geometry.contact_angle_rate;
    wheelset.spin = true;
    let spinning = wheelset.forces([1e-3, 2e-3], [0.01, 0.02], 20.0);
    let spin = 0.02 / 20.0 - rate * 1e-3 / 0.45;
    assert!((spinning[0] - plain[0] + 2.0 * 2e4 * spin).abs() < 1e-9);
    assert!((spinning[1] - plain[1] - 2.0 * 2e4 * lateral + 2.0 * 30.0 * spin).abs() < 1e-9);
    wheelset.spin = false;
    wheelset.axle_load = 1e5;
    let heavy = wheelset.forces([1e-3, 2e-3], [0.01, 0.02], 20.0);
    assert!((heavy[0] - plain[0] + 1e5 * rate * 1e-3).abs() < 1e-9);
    assert!((heavy[1] - plain[1] - 1e5 * 0.75 * 2e-3 * 0.05f64.atan().sin()).abs() < 1e-9);
}

/// Forces of both wheels by the contact search with Kalker's linear law, differentiated about straight
/// rolling, against linear geometry and creep: lateral force and yaw moment by yaw and by the rates of shift
/// and yaw.
#[test]
fn analytic_linear_geometry_is_the_limit_of_the_contact_search() {
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.28,
    };
    let (wheel, rail) = (
        nominal::cone(0.05, 0.05).unwrap(),
        nominal::cylinder(0.3, 0.035).unwrap(),
    );
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.5 + 2.0 * rail.gauge_point(0.001),
        gauge_depth: 0.001,
    };
    let wheelset = RigidWheelset::new([&wheel; 2], [0.46; 2], [&rail; 2], layout, steel).unwrap();
    let geometry = LinearGeometry::of(&wheelset, 1e-3).unwrap();
    let (speed, load) = (20.0, 8e4);
    let cosine = geometry.contact_angle.cos();
    let hertz = Hertz::new(steel, cosine / geometry.radius, 1.0 / 0.3).unwrap();
    let patch = Patch::new(&hertz, load, 0.4);
    let linear = LinearWheelset {
        geometry,
        creep: CreepCoefficients::of(&patch),
        spin: true,
        axle_load: 2.0 * load * cosine,
    };
    let law = ContactLaw {
        friction: Friction::constant(0.4),
        damping: 0.0,
        creep: CreepLaw::Linear,
        slowest: 0.0,
    };
    let middle = wheelset.position(0.0, 0.0).unwrap();
    let height = middle.height - hertz.approach(load) / cosine;
    // Sum over both wheels of the lateral force and of the moment about the vertical axis through the center.
    let total = |yaw: f64, shift_rate: f64, yaw_rate: f64| {
        let mut sum = [0.0; 2];
        for (side, pair) in [Side::Left, Side::Right].into_iter().zip(wheelset.pairs()) {
            let pose: WheelPose<f64> = wheelset.pose(side, [0.0, height], yaw, 0.0);
            let (sine, cosine) = yaw.sin_cos();
            let sign = if side == Side::Left { 1.0 } else { -1.0 };
            let arm = [-sign * 0.75 * sine, sign * 0.75 * cosine];
            let spin = speed / geometry.radius;
            let motion = WheelMotion {
                velocity: [speed - yaw_rate * arm[1], shift_rate + yaw_rate * arm[0], 0.0],
                angular_velocity: [-spin * sine, spin * cosine, yaw_rate],
            };
            let forces = law.on_wheel(pair, side, &pose, &motion, |_, _| {});
            sum[0] += forces.force[1];
            sum[1] += forces.moment[2] + arm[0] * forces.force[1] - arm[1] * forces.force[0];
        }
        sum
    };
    for (what, [yaw, shift_rate, yaw_rate]) in [
        ("yaw", [1e-5, 0.0, 0.0]),
        ("shift rate", [0.0, 1e-4, 0.0]),
        ("yaw rate", [0.0, 0.0, 1e-4]),
    ] {
        let [up, down] = [1.0, -1.0].map(|sign| total(sign * yaw, sign * shift_rate, sign * yaw_rate));
        let expected = linear.forces([0.0, yaw], [shift_rate, yaw_rate], speed);
        let largest = expected.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        for i in 0..2 {
            let found = 0.5 * (up[i] - down[i]);
            assert!(
                (found - expected[i]).abs() < 0.01 * largest,
                "{what} {i}: {found} {}",
                expected[i]
            );
        }
    }
}
