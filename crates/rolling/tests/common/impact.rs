//! A wheel that meets its rail at a velocity: loads by the elements, by two masses, by closed forms.

use integrate::{Integrator, Options};
use rolling::rig::{Rig, RigStart, Setup, WHEELSET};
use rolling::track::RailSupport;
use rolling::wheelset::coordinate;
use wheelrail::contact::{ContactLaw, CreepLaw, Side};
use wheelrail::track::shape::Shape;
use wheelrail::track::{Direction, Irregularity, Placed, Rails, Segment};

use super::{POLACH, cones, on_rails, track};

/// Unsprung mass a wheel, mass, stiffness and damping of the track under it: kg, N/m, N·s/m.
pub const UNSPRUNG: f64 = 1250.0;
pub const TRACK: [f64; 3] = [345.0, 80e6, 140e3];
/// Static load of a wheel, N.
pub const LOAD: f64 = 125e3;

/// Wheels over a track, with a damping of the contact (s/m, Hunt and Crossley).
pub fn setup(irregularities: Vec<Placed>, speed: f64, damping: f64) -> Setup {
    // Creep on coned treads would carry a part of the load.
    let law = ContactLaw {
        creep: CreepLaw::Frictionless,
        damping,
        ..POLACH
    };
    let mut setup = on_rails(
        &cones(0.05, 0.3),
        track(&[Segment::Tangent(200.0)], irregularities),
        law,
        speed,
    );
    setup.body.mass = 2.0 * UNSPRUNG;
    setup.carriage.load = 2.0 * (LOAD - UNSPRUNG * 9.81);
    setup.carriage.stiffness = [2e6, 2e6];
    setup.support = Some(RailSupport::default_support("rail", 9.81));
    setup
}

/// Loads of the left wheel (s, N) from a state.
pub fn loads(rig: &Rig, start: &[f64], end: f64) -> Vec<[f64; 2]> {
    let options = Options {
        relative_tolerance: 1e-6,
        // Peaks are to be met.
        maximum_step: 2e-5,
        ..Options::default()
    };
    let mut own = rig.clone();
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, start).unwrap();
    let mut found = Vec::new();
    while integrator.time() < end {
        integrator.step_to(end).unwrap();
        let seen = own.system.observe(integrator.time(), integrator.x());
        let mut load = 0.0;
        own.patches(&seen, |side, patch| {
            if side == Side::Left {
                load += patch.forces.normal * patch.patch.share * patch.normal.0[2];
            }
        });
        found.push([integrator.time(), load]);
    }
    found
}

/// Wheel and track as two masses, the wheel on Hertz's spring `k d^1.5`, that meet at a velocity: loads (s,
/// N) by the classical Runge-Kutta method.
pub fn two_masses(stiffness: f64, damping: f64, velocity: f64, end: f64) -> Vec<[f64; 2]> {
    let [mass, spring, damper] = TRACK;
    let rest = [(LOAD / stiffness).powf(2.0 / 3.0), LOAD / spring];
    let force = |x: &[f64; 4]| {
        let elastic = stiffness * (rest[0] + x[0] - x[1]).max(0.0).powf(1.5);
        elastic * (1.0 + 1.5 * damping * (x[2] - x[3]))
    };
    // Down positive, from rest: wheel, track, their velocities.
    let rates = |x: &[f64; 4]| {
        let load = force(x);
        [
            x[2],
            x[3],
            (LOAD - load) / UNSPRUNG,
            (load - LOAD - spring * x[1] - damper * x[3]) / mass,
        ]
    };
    let step = 1e-6;
    let mut x = [0.0, 0.0, velocity, 0.0];
    let mut found = Vec::new();
    for k in 0..(end / step) as usize {
        let add = |x: &[f64; 4], d: &[f64; 4], h: f64| [0, 1, 2, 3].map(|i| x[i] + h * d[i]);
        let a = rates(&x);
        let b = rates(&add(&x, &a, 0.5 * step));
        let c = rates(&add(&x, &b, 0.5 * step));
        let d = rates(&add(&x, &c, step));
        x = [0, 1, 2, 3].map(|i| x[i] + step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        found.push([step * (k + 1) as f64, force(&x)]);
    }
    found
}

pub fn largest(loads: &[[f64; 2]], from: f64, to: f64) -> f64 {
    let own = loads.iter().filter(|[time, _]| (from..to).contains(time));
    own.map(|[_, load]| load - LOAD).fold(0.0, f64::max)
}

pub fn closed_forms(velocity: f64, hertz: f64) -> [f64; 2] {
    let [mass, spring, damper] = TRACK;
    let together = UNSPRUNG + mass;
    let first = velocity * (hertz * mass / (1.0 + mass / UNSPRUNG)).sqrt();
    let damped = 1.0 - std::f64::consts::PI * damper / (4.0 * (spring * together).sqrt());
    let second = velocity * (UNSPRUNG / together).sqrt() * damped * (spring * UNSPRUNG).sqrt();
    [first, second]
}

/// Damping with which P2 is looked at, s/m: the contact's vibration is over when it comes.
const DAMPED: f64 = 6.0;

/// Returns the peaks P1 (without damping of the contact) and P2 (with it), N above the static load, of a
/// wheel that meets its rail at a velocity (m/s): by the elements, by two masses, by closed forms.
pub fn meeting(velocity: f64) -> [[f64; 2]; 3] {
    let [mut found, mut masses] = [[0.0; 2]; 2];
    let mut hertz = 0.0;
    let looks = [(0.0, 0.0, 1.5e-3), (DAMPED, 3e-3, 0.02)];
    for (number, (damping, from, to)) in looks.into_iter().enumerate() {
        let setup = setup(Vec::new(), 0.0, damping);
        let start = RigStart {
            distance: 100.0,
            ..RigStart::default()
        };
        let mut rig = Rig::new(&setup, start).unwrap();
        let mut stiffness = 0.0;
        let seen = rig.system.observe(0.0, &rig.start);
        rig.patches(&seen, |side, patch| {
            if side == Side::Left {
                stiffness = patch.patch.ellipse.stiffness;
            }
        });
        // At the start rails lie in their places; coned wheels spread them.
        let mut integrator =
            Integrator::new(rig.system.clone(), Options::default(), 0.0, &rig.start).unwrap();
        while integrator.time() < 1.0 {
            integrator.step_to(1.0).unwrap();
        }
        let mut x = integrator.x().to_vec();
        let down =
            rig.system.layout().speeds + rig.system.position_of(WHEELSET, coordinate::VERTICAL).unwrap();
        x[down] -= velocity;
        found[number] = largest(&loads(&rig, &x, to), from, to);
        masses[number] = largest(&two_masses(stiffness, damping, velocity, to), from, to);
        hertz = 1.5 * stiffness * (LOAD / stiffness).powf(1.0 / 3.0);
    }
    [found, masses, closed_forms(velocity, hertz)]
}

/// Returns the second peak (N above the static load) at a dipped joint with slopes ±α, at a speed (m/s).
pub fn joint(angle: f64, speed: f64) -> f64 {
    let (spacing, start) = (40.0, 60.0);
    let joint = Placed {
        rails: Rails::Both,
        direction: Direction::Vertical,
        irregularity: Irregularity::Shape(Shape::Joints {
            // Slopes of ±α at the joint.
            depth: angle * spacing / std::f64::consts::PI,
            spacing,
            joints: 1,
            rounding: 0.125,
            start,
        }),
    };
    let setup = setup(vec![joint], speed, DAMPED);
    let from = 50.0;
    let rig = Rig::new(
        &setup,
        RigStart {
            distance: from,
            ..RigStart::default()
        },
    )
    .unwrap();
    let at = (start - from) / speed;
    largest(&loads(&rig, &rig.start, at + 0.1), at, at + 0.05)
}
