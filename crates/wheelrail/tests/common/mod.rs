//! Wheels on rails for the tests of contact.
#![allow(missing_docs, dead_code, clippy::unwrap_used)]

use numerics::scalar::Real;
use wheelrail::contact::{ContactLaw, ContactPair, CreepLaw, Side, WheelForces, WheelMotion, WheelPose};
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileKind, nominal};

pub const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};
pub const RADIUS: f64 = 0.4572;

pub fn inclined_rail() -> Profile {
    let rail = nominal::rail_136re().unwrap().inclined(nominal::INCLINATION);
    let [_, top] = rail.top();
    rail.moved([0.0, -top])
}

pub fn freight_pair() -> ContactPair {
    ContactPair::new(&nominal::aar_1b().unwrap(), RADIUS, &inclined_rail(), STEEL).unwrap()
}

/// Profiles that touch at several places of the rail's head: S1002 and UIC60.
pub fn conformal_pair() -> ContactPair {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/manchester");
    let read = |file: &str, kind| Profile::read(&folder.join(file), kind, 0.0).unwrap();
    let (wheel, rail) = (
        read("MBench_S1002_v3.prw", ProfileKind::Wheel),
        read("MBench_UIC60_v3.prr", ProfileKind::Rail),
    );
    ContactPair::new(&wheel, RADIUS, &rail, STEEL).unwrap()
}

pub fn law(creep: CreepLaw) -> ContactLaw {
    ContactLaw {
        friction: Friction::constant(0.4),
        damping: 0.3,
        creep,
        slowest: 0.1,
    }
}

/// Lateral place of the center, overlap, yaw, roll; velocities and angular velocities.
pub const POSES: [[f64; 4]; 5] = [
    [-3e-3, 1e-4, 0.0, 0.0],
    [-6e-3, 8e-5, 4e-3, 1e-3],
    [2e-3, 1.2e-4, -3e-3, -2e-3],
    [8.2e-3, 1e-4, 5e-3, 0.0],
    [1.1e-2, 2e-4, 1.5e-2, 5e-3],
];
pub const VELOCITIES: [f64; 6] = [15.0, 0.02, -0.01, 0.03, 32.8, 0.05];

/// Returns the height of the center at which the rigid profiles overlap by so much.
pub fn height(pair: &ContactPair, [lateral, overlap, yaw, roll]: [f64; 4]) -> f64 {
    let trial = RADIUS + 0.001;
    let pose = WheelPose::of(Side::Left, [lateral, trial], yaw, roll);
    trial + pair.touch(&pose).unwrap().overlap - overlap
}

pub fn motion<S: Real>(values: [S; 6]) -> WheelMotion<S> {
    let [x, y, z, p, q, r] = values;
    WheelMotion {
        velocity: [x, y, z],
        angular_velocity: [p, q, r],
    }
}

/// Forces and moments by lateral place, height, yaw, roll and six velocities.
pub fn forces<S: Real>(pair: &ContactPair, law: &ContactLaw, side: Side, values: [S; 10]) -> WheelForces<S> {
    let [y, z, yaw, roll, a, b, c, d, e, f] = values;
    let pose = WheelPose::of(side, [y, z], yaw, roll);
    law.on_wheel(pair, side, &pose, &motion([a, b, c, d, e, f]), |_, _| {})
}

pub fn values(pair: &ContactPair, pose: [f64; 4]) -> [f64; 10] {
    let [lateral, _, yaw, roll] = pose;
    let mut values = [0.0; 10];
    values[..4].copy_from_slice(&[lateral, height(pair, pose), yaw, roll]);
    values[4..].copy_from_slice(&VELOCITIES);
    values
}

pub fn six(forces: &WheelForces<f64>) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (forces.force, forces.moment);
    [a, b, c, d, e, f]
}
