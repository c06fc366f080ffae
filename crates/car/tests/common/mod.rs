//! Cars on tracks.
#![allow(dead_code, missing_docs, clippy::unwrap_used, clippy::expect_used)]

use std::sync::Arc;

use car::{Car, Loads, Parameters, Wheels};
use integrate::{Integrator, Method, Options, Problem};
use mechanics::energy_balance::EnergyBalance;
use truck::{Hysteresis, Lading, SideBearing, WedgeKind};
use wheelrail::hertz::Material;
use wheelrail::track::{CenterLine, CurveElements, Segment, SpiralForm, Track};
use wheelrail::wheelset::{Layout, RigidWheelset};

pub const INCH: f64 = 0.0254;
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
pub const MPH: f64 = 0.447_04;

pub fn track(segments: &[Segment]) -> Track {
    Track {
        center_line: CenterLine::new(segments, 59.5 * INCH, &[]).unwrap(),
        irregularities: Vec::new(),
    }
}

pub fn tangent(length: f64) -> Track {
    track(&[Segment::Tangent(length)])
}

/// Returns a curve of a degree, to the left or to the right, with a superelevation (m) of its outer rail,
/// behind 30 m of tangent and a spiral of 60 m.
pub fn curve(degree: f64, turn: f64, superelevation: f64, length: f64) -> Track {
    let own = CurveElements::of_degree(degree.to_radians(), superelevation);
    let own = CurveElements {
        curvature: turn * own.curvature,
        superelevation: turn * own.superelevation,
    };
    track(&[
        Segment::Tangent(30.0),
        Segment::Spiral(60.0, SpiralForm::Clothoid),
        Segment::Curve(length, own),
    ])
}

pub fn loaded(track: Track, speed: f64) -> Parameters {
    Parameters::new(Lading::Loaded, track, speed).unwrap()
}

pub fn empty(track: Track, speed: f64) -> Parameters {
    Parameters::new(Lading::Empty, track, speed).unwrap()
}

/// Returns the same car with the industry's wedges, which have no mass.
pub fn massless(mut parameters: Parameters) -> Parameters {
    for wedge in parameters.trucks.iter_mut().flat_map(|own| &mut own.wedges) {
        wedge.kind = WedgeKind::Massless;
    }
    parameters
}

/// Returns the same car with 600 lbf of hysteresis in its constant-contact side bearings.
pub fn with_hysteresis(mut parameters: Parameters) -> Parameters {
    for body in parameters.trucks.iter_mut().flat_map(|own| &mut own.car_body) {
        if let SideBearing::ConstantContact { hysteresis, .. } = &mut body.side_bearings.kind {
            *hysteresis = Some(Hysteresis {
                limit: 600.0 * POUND_FORCE,
                ..Hysteresis::default()
            });
        }
    }
    parameters
}

/// The outcome of a run.
pub struct Ran {
    pub car: Car,
    pub time: f64,
    pub state: Vec<f64>,
    pub loads: Vec<(f64, Loads)>,
    /// Relative residual of the energy ledger.
    pub residual: f64,
}

impl Ran {
    pub fn last(&self) -> &Loads {
        &self.loads.last().unwrap().1
    }
}

/// Runs a car; loads are seen each `every` (s).
pub fn run(parameters: &Parameters, duration: f64, every: f64, tolerance: f64) -> Ran {
    run_by(Method::Esdirk3, parameters, duration, every, tolerance)
}

pub fn run_by(method: Method, parameters: &Parameters, duration: f64, every: f64, tolerance: f64) -> Ran {
    let car = Car::new(parameters).unwrap();
    let mut system = car.system.clone();
    let start = system.observe(0.0, &car.initial_state).energies.total();
    let options = Options {
        relative_tolerance: tolerance,
        ..Options::of(method)
    };
    let mut integrator = Integrator::new(car.system.clone(), options, 0.0, &car.initial_state).unwrap();
    let mut balance = EnergyBalance::new(start);
    let mut rates = vec![0.0; car.initial_state.len()];
    let mut buffer = car.initial_state.clone();
    let mut loads = Vec::new();
    while integrator.time() < duration {
        integrator.step_to(duration).unwrap();
        while loads.len() as f64 * every <= integrator.time() {
            let time = loads.len() as f64 * every;
            integrator.interpolate(time, &mut buffer);
            system.segment_like(integrator.problem());
            let seen = system.observe(time, &buffer);
            balance.note(time, &system.ledger_entries(&seen, start));
            system.derivative(time, &buffer, &mut rates);
            loads.push((time, car.loads(&seen, &rates)));
        }
    }
    Ran {
        time: integrator.time(),
        state: integrator.x().to_vec(),
        residual: balance.relative_residual(),
        loads,
        car,
    }
}

/// Returns the loads at the start.
pub fn at_start(car: &Car) -> Loads {
    let mut system = car.system.clone();
    let mut rates = vec![0.0; car.initial_state.len()];
    system.derivative(0.0, &car.initial_state, &mut rates);
    let seen = system.observe(0.0, &car.initial_state);
    car.loads(&seen, &rates)
}

/// Puts a car's profiles on rails of a gauge (in), tape circles where they are.
pub fn put_on_gauge(parameters: &mut Parameters, gauge: f64) {
    let Wheels::OnRails(wheels) = &mut parameters.wheels else {
        panic!("profiles are expected");
    };
    let (wheel, rail) = (&*wheels.wheels[0][0], &*wheels.rails[0]);
    let layout = Layout {
        tape_distance: wheels.tape_distance,
        gauge: gauge * INCH,
        gauge_depth: 0.625 * INCH,
    };
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.27,
    };
    let made = RigidWheelset::new([wheel; 2], [18.0 * INCH; 2], [rail; 2], layout, steel);
    let made = Arc::new(made.unwrap());
    wheels.geometry = [0; 4].map(|_| made.clone());
}
