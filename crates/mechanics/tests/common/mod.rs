//! Shared by several test files: random numbers, differences, small models, integration.
#![allow(dead_code, missing_docs, clippy::unwrap_used, clippy::expect_used)]

use integrate::{Integrator, Method, Options, Problem};
use mechanics::body::Body;
use mechanics::coil::{Coil, CoilLaw};
use mechanics::contact::{ContactFace, ContactPoint, Interface};
use mechanics::frame::Frame;
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::surface::Plane;
use mechanics::system::{EnergyTermKind, Model, System};
use mechanics::vector::Vector;

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }
    pub fn vector<const N: usize>(&mut self, size: f64) -> [f64; N] {
        std::array::from_fn(|_| self.between(-size, size))
    }
}

pub const ALL: [bool; 6] = [true; 6];

pub fn body(
    name: &str,
    mass: f64,
    inertia: [f64; 3],
    center_of_gravity: [f64; 3],
    free: [bool; 6],
    initial: [f64; 6],
) -> Body {
    Body {
        name: name.to_owned(),
        mass,
        inertia,
        center_of_gravity,
        frame: Frame::fixed([0.0; 3], [0.0; 3]),
        free,
        initial,
        linearized: false,
    }
}

pub fn ground() -> Body {
    Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]))
}

pub fn face(
    name: &str,
    points: &[[f64; 3]],
    stiffness: f64,
    damping: f64,
    coefficient: f64,
    law: FrictionLaw,
) -> ContactFace<Plane> {
    let share = 1.0 / points.len() as f64;
    ContactFace {
        name: name.to_owned(),
        points: points
            .iter()
            .map(|position| ContactPoint {
                position: Vector(*position),
                stiffness,
                damping,
                share,
            })
            .collect(),
        surface: Plane,
        coefficient,
        law,
    }
}

pub fn coil(end: [f64; 3], acts_at: [f64; 3], stiffness: f64, free_length: f64) -> Coil {
    Coil {
        end: Vector(end),
        acts_at: Vector(acts_at),
        law: CoilLaw::Linear { stiffness },
        free_length,
        damping: 0.0,
        rotational_damping: 0.0,
        pulls: true,
    }
}

/// Angles of a marker whose normal (its x axis) points up (+z of the body).
pub const UP: [f64; 3] = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];

pub fn rates(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let mut dx = vec![f64::NAN; x.len()];
    system.derivative(time, x, &mut dx);
    dx
}

/// Derivative at zero of a function of one variable: central differences of fourth order with two steps,
/// extrapolated to sixth order.
pub fn difference(h: f64, mut f: impl FnMut(f64) -> Vec<f64>) -> Vec<f64> {
    let [a, b, c, d, e, g] = [0.5 * h, -0.5 * h, h, -h, 2.0 * h, -2.0 * h].map(&mut f);
    (0..a.len())
        .map(|i| {
            let coarse = (8.0 * (c[i] - d[i]) - (e[i] - g[i])) / (12.0 * h);
            let fine = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (6.0 * h);
            fine + (fine - coarse) / 15.0
        })
        .collect()
}

pub fn options(method: Method, relative_tolerance: f64) -> Options {
    Options {
        method,
        relative_tolerance,
        ..Options::default()
    }
}

/// Integrates to `end`; `each` sees the integrator after every step.
pub fn integrate(
    mut system: System,
    options: Options,
    x: &[f64],
    end: f64,
    mut each: impl FnMut(&mut Integrator<System>),
) -> Integrator<System> {
    system.next_time_discontinuity(0.0);
    let mut integrator = Integrator::new(system, options, 0.0, x).unwrap();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
        each(&mut integrator);
    }
    integrator
}

/// The terms of the energy balance.
#[derive(Clone, Debug)]
pub struct Ledger {
    pub stored: f64,
    pub work: f64,
    pub guide: f64,
    pub losses: Vec<(EnergyTermKind, f64)>,
}

impl Ledger {
    pub fn at(system: &mut System, time: f64, x: &[f64]) -> Self {
        let observation = system.observe(time, x);
        let mut ledger = Self {
            stored: observation.energies.total(),
            work: 0.0,
            guide: 0.0,
            losses: Vec::new(),
        };
        for (energy_term, value) in system.energy_terms().iter().zip(&observation.quadratures) {
            match energy_term.kind {
                EnergyTermKind::MotionWork => ledger.work += value,
                EnergyTermKind::CoilGuideWork => ledger.guide += value,
                kind => ledger.losses.push((kind, *value)),
            }
        }
        ledger
    }
    /// Energy that came from nowhere since `start`, with the losses counted that `counts` accepts.
    pub fn residual(&self, start: &Self, counts: impl Fn(EnergyTermKind) -> bool) -> f64 {
        let lost = |ledger: &Self| -> f64 {
            let counted = ledger.losses.iter().filter(|(kind, _)| counts(*kind));
            counted.map(|(_, value)| value).sum()
        };
        (self.stored - start.stored) - (self.work - start.work) - (self.guide - start.guide)
            + (lost(self) - lost(start))
    }
}

pub fn model(bodies: Vec<Body>, gravity: [f64; 3]) -> Model {
    Model {
        bodies,
        gravity,
        faces: Vec::new(),
        coils: Vec::new(),
        ..Model::default()
    }
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}

pub fn times(a: [f64; 3], factor: f64) -> [f64; 3] {
    a.map(|v| v * factor)
}

pub fn norm(a: &[f64]) -> f64 {
    a.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Rotation about `axis` (any length) by `angle`, applied to `v` (Rodrigues).
pub fn rodrigues(axis: [f64; 3], angle: f64, v: [f64; 3]) -> [f64; 3] {
    let n = times(axis, 1.0 / norm(&axis));
    let (s, c) = angle.sin_cos();
    let along = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    let across = cross(n, v);
    std::array::from_fn(|k| v[k] * c + across[k] * s + n[k] * along * (1.0 - c))
}

/// Total linear momentum and angular momentum about the fixed origin.
pub fn momenta(system: &mut System, time: f64, x: &[f64]) -> Vec<f64> {
    let observation = system.observe(time, x);
    let (mut p, mut l) = ([0.0; 3], [0.0; 3]);
    for (body, state) in system.bodies().iter().zip(&observation.bodies) {
        let r = state.rotation.0;
        let arm: [f64; 3] =
            std::array::from_fn(|i| (0..3).map(|j| r[i][j] * body.center_of_gravity[j]).sum());
        let w = state.angular_velocity.0;
        let v = add(state.velocity.0, cross(w, arm));
        let momentum = times(v, body.mass);
        p = add(p, momentum);
        l = add(l, cross(add(state.origin.0, arm), momentum));
        for k in 0..3 {
            let own: f64 = (0..3).map(|i| r[i][k] * w[i]).sum::<f64>() * body.inertia[k];
            for i in 0..3 {
                l[i] += r[i][k] * own;
            }
        }
    }
    [p, l].concat()
}

/// Returns a free body with points (body axes) over a surface whose normal points up at the origin.
pub fn over(points: &[[f64; 3]], interface: Interface, law: FrictionLaw, initial: [f64; 6]) -> Model {
    let block = body("block", 2.0, [0.3, 0.4, 0.5], [0.0; 3], ALL, initial);
    let mut model = model(vec![ground(), block], [0.0, 0.0, -10.0]);
    let points = face("face", points, 1e6, 0.0, 0.4, law);
    model.faces.push((1, 0, Marker::new([0.0; 3], UP), points));
    model.interfaces.push((0, interface));
    model
}
