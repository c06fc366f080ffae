//! Wheelsets on tracks.
#![allow(dead_code, unused_imports, clippy::unwrap_used, clippy::expect_used)]

pub mod bogie;
pub mod bushing;
pub mod impact;
pub mod manchester;
pub mod nonlinear;
pub mod not_round;
pub mod suspended;

use std::sync::Arc;

use integrate::{Integrator, Options};
use rolling::beam::RailBeam;
use rolling::carriage::Carriage;
use rolling::rig::{Rig, RigStart, Setup, Wheels};
use rolling::track::RailSupport;
use rolling::wheel::Search;
use rolling::wheelset::WheelsetBody;
use wheelrail::conicity::LinearGeometry;
use wheelrail::contact::{ContactLaw, CreepCoefficients, CreepLaw, LinearWheelset};
use wheelrail::creep::polach;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::nominal;
use wheelrail::track::{CenterLine, Placed, RailLines, Segment, Track};
use wheelrail::wheelset::{Layout, RigidWheelset};

pub const INCH: f64 = 0.0254;
pub const STEEL: Material = Material {
    youngs_modulus: 207e9,
    poisson: 0.28,
};
pub const BODY: WheelsetBody = WheelsetBody {
    mass: 1250.0,
    about_axle: 150.0,
    about_diameter: 700.0,
};
pub const POLACH: ContactLaw = ContactLaw {
    friction: Friction::constant(0.4),
    damping: 2.0,
    creep: CreepLaw::Polach(polach::DRY),
    slowest: 0.1,
};

/// Nominal 1B wheels on nominal 136RE rails.
pub fn freight() -> (RigidWheelset, f64) {
    let wheel = nominal::aar_1b().unwrap();
    let rail = nominal::rail_136re().unwrap().inclined(nominal::INCLINATION);
    let layout = Layout {
        tape_distance: nominal::TAPE_DISTANCE,
        gauge: 56.5 * INCH,
        gauge_depth: nominal::GAUGE_DEPTH,
    };
    let wheels = RigidWheelset::new([&wheel; 2], [18.0 * INCH; 2], [&rail; 2], layout, STEEL).unwrap();
    (wheels, layout.tape_distance)
}

/// Cones on rails with crowns of a radius (m) whose tops are 1.5 m apart.
pub fn cones(slope: f64, crown: f64) -> (RigidWheelset, f64) {
    let wheel = nominal::cone(slope, 0.05).unwrap();
    let rail = nominal::cylinder(crown, 0.035).unwrap();
    let layout = Layout {
        tape_distance: 1.5,
        gauge: 1.5 + 2.0 * rail.gauge_point(0.001),
        gauge_depth: 0.001,
    };
    let wheels = RigidWheelset::new([&wheel; 2], [0.46; 2], [&rail; 2], layout, STEEL).unwrap();
    (wheels, 1.5)
}

pub fn track(segments: &[Segment], irregularities: Vec<Placed>) -> Track {
    Track {
        center_line: CenterLine::new(segments, 59.5 * INCH, &[]).unwrap(),
        irregularities,
    }
}

pub fn carriage(lines: &Arc<RailLines>, speed: f64) -> Carriage {
    Carriage {
        name: "carriage".to_owned(),
        lines: lines.clone(),
        stiffness: [2e6, 2e6],
        damping: [2e4, 2e3],
        load: 280e3,
        speed,
        drive: 1e4,
    }
}

/// Wheels with patches on a track, rigid rails, a carriage with an axle load of 292 kN.
pub fn on_rails(
    (wheels, tape_distance): &(RigidWheelset, f64),
    track: Track,
    law: ContactLaw,
    speed: f64,
) -> Setup {
    let lines = Arc::new(RailLines::new(track, wheels.rail_origins()));
    let search = [0, 1].map(|i| Search::Exact(Arc::new(wheels.pairs()[i].clone())));
    Setup {
        body: BODY,
        wheels: Wheels::OnRails {
            search,
            tape_distance: *tape_distance,
            law,
        },
        carriage: carriage(&lines, speed),
        lines,
        support: None,
        gravity: 9.81,
        heading: 0.0,
    }
}

/// Puts a setup on rails 136RE as beams on the default support.
pub fn on_beams(setup: Setup) -> Setup {
    let support = RailSupport {
        beam: Some(RailBeam::rail_136re()),
        ..RailSupport::default_support("rail", setup.gravity)
    };
    Setup {
        support: Some(support),
        ..setup
    }
}

/// Linear wheels on straight track under springs: mass, moment of inertia, lateral and yaw stiffness; f11,
/// f22; conicity, radius, half distance.
pub fn linear(
    [mass, inertia, lateral, yaw]: [f64; 4],
    [f11, f22]: [f64; 2],
    [conicity, radius, half_distance]: [f64; 3],
    speed: f64,
) -> Setup {
    let lines = Arc::new(RailLines::new(
        track(&[Segment::Tangent(100.0)], Vec::new()),
        [0.75; 2],
    ));
    let geometry = LinearGeometry {
        roll_coefficient: 0.0,
        ..LinearGeometry::of_cones(conicity, half_distance, radius)
    };
    Setup {
        body: WheelsetBody {
            mass,
            about_axle: 100.0,
            about_diameter: inertia,
        },
        wheels: Wheels::Linear {
            wheelset: LinearWheelset {
                geometry,
                creep: CreepCoefficients {
                    f11,
                    f22,
                    f23: 0.0,
                    f33: 0.0,
                },
                spin: false,
                axle_load: 0.0,
            },
            support: [1e9, 1e14],
        },
        carriage: Carriage {
            stiffness: [lateral, yaw],
            damping: [0.0; 2],
            load: 0.0,
            drive: 0.0,
            ..carriage(&lines, speed)
        },
        lines,
        support: None,
        gravity: 0.0,
        heading: 0.0,
    }
}

/// Returns the zero of a rising function between two numbers, to 1e-7.
pub fn bisection([mut low, mut high]: [f64; 2], rising: impl Fn(f64) -> f64) -> f64 {
    while high - low > 1e-7 {
        let middle = 0.5 * (low + high);
        *(if rising(middle) < 0.0 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// Returns a wheelset with cones on crowns of a radius (m) under a load alone, with linear creep, on straight
/// track at 2 m/s; and its wavelength by Klingel's formula, m.
pub fn coned_wheelset(slope: f64, crown: f64) -> (Setup, f64) {
    let law = ContactLaw {
        creep: CreepLaw::Linear,
        ..POLACH
    };
    let wheels = cones(slope, crown);
    let mut setup = on_rails(&wheels, track(&[Segment::Tangent(200.0)], Vec::new()), law, 2.0);
    setup.carriage.stiffness = [0.0; 2];
    setup.carriage.damping = [0.0; 2];
    setup.carriage.load = 50e3;
    let klingel = LinearGeometry::of(&wheels.0, 1e-3).unwrap().klingel_wavelength();
    (setup, klingel)
}

/// Runs to a time from a start; gives the rig, which begins there then, and its state.
pub fn after(setup: &Setup, start: RigStart, relative_tolerance: f64, time: f64) -> (Rig, Vec<f64>) {
    let mut rig = Rig::new(setup, start).unwrap();
    let options = Options {
        relative_tolerance,
        ..Options::default()
    };
    let mut integrator = Integrator::new(rig.system.clone(), options, 0.0, &rig.start).unwrap();
    while integrator.time() < time {
        integrator.step_to(time).unwrap();
    }
    let x = integrator.x().to_vec();
    rig.start.clone_from(&x);
    (rig, x)
}
