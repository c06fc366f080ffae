//! Linear stability of a vehicle on straight perfect track over the speed.
//!
//! From its equilibrium the vehicle rolls for a second at 20 m/s, so that creep forces and loads agree; with
//! steady running all forces depend on creepages alone, so that other speeds have the same displacements.
//! Its equations are linearized there, all friction stuck: bristles are springs. The critical speed is the
//! lowest of the speeds asked for from which on a vibration of 0.05 to 30 Hz grows, refined by halving
//! between it and the speed below.
//!
//! Limits: nothing about amplitudes (a car has them, [`crate::car::stability`]); what is open or has
//! clearance at rest does not hold; motions without a frequency are left out.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use ::car::VIBRATIONS;
use ::vehicle::{Vehicle, VehicleError, Vibration};
use integrate::{Integrator, Method, Options, SetupError, StepError};
use mechanics::linear::NoVibration;
use quantity::{Kind, System as Units};

use super::VehicleCase;

/// Time that a vehicle runs before it is linearized, s, and its speed, m/s.
const SETTLED: f64 = 1.0;
const SETTLING_SPEED: f64 = 20.0;
/// Growth below this is none, 1/s: that of undamped vibrations in rounding.
const NONE: f64 = 1e-5;
/// The critical speed is known to this part.
const PART: f64 = 1e-4;

/// The findings.
#[derive(Clone, Debug, PartialEq)]
pub struct VehicleStability {
    /// The speeds, m/s.
    pub speeds: Vec<f64>,
    /// Vibrations at each of them, by falling growth; fewer where the user stopped it.
    pub vibrations: Vec<Vec<Vibration>>,
    /// The critical speed; none if nothing grows.
    pub critical: Option<CriticalVibration>,
}

/// What begins to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalVibration {
    /// The speed, m/s.
    pub speed: f64,
    /// Frequency, Hz.
    pub frequency: f64,
    /// True if it grows at the lowest speed that was asked for already: the critical speed is not above.
    pub at_lowest: bool,
}

/// Returns the vibrations of a vehicle at these speeds (m/s, rising), and its critical speed. `go_on`
/// receives the share that is done.
///
/// # Errors
/// It has no equilibrium, or its equations cannot be linearized.
pub fn over_speed(
    case: &VehicleCase,
    speeds: &[f64],
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<VehicleStability, VehicleStabilityError> {
    let vehicle = &mut steady(case)?;
    let mut found = VehicleStability {
        speeds: speeds.to_vec(),
        vibrations: Vec::new(),
        critical: None,
    };
    let mut first = None;
    for (number, speed) in speeds.iter().enumerate() {
        let own = vibrations(vehicle, *speed)?;
        if let (None, Some(grows)) = (first, growing(&own)) {
            first = Some((number, grows));
        }
        found.vibrations.push(own);
        if go_on((number + 1) as f64 / speeds.len() as f64).is_break() {
            return Ok(found);
        }
    }
    let Some((number, mut grows)) = first else {
        return Ok(found);
    };
    let mut above = speeds[number];
    let below = number.checked_sub(1).map(|before| speeds[before]);
    if let Some(mut below) = below {
        while above - below > PART * above {
            let middle = 0.5 * (below + above);
            match growing(&vibrations(vehicle, middle)?) {
                Some(own) => (above, grows) = (middle, own),
                None => below = middle,
            }
        }
    }
    found.critical = Some(CriticalVibration {
        speed: above,
        frequency: grows.frequency / (2.0 * PI),
        at_lowest: below.is_none(),
    });
    Ok(found)
}

impl VehicleStability {
    /// Returns what has been found in a sentence.
    #[must_use]
    pub fn verdict(&self, units: Units) -> String {
        let speed = |si: f64| {
            let unit = Kind::TravelSpeed.label(units);
            format!("{:.1} {unit}", si * Kind::TravelSpeed.from_si(units))
        };
        let fastest = self.speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
        match &self.critical {
            None => format!("Small motions die away up to {}.", speed(fastest)),
            Some(own) => {
                let from = if own.at_lowest { "already at" } else { "from" };
                format!(
                    "Small motions grow, {from} {} on, at {:.2} Hz.",
                    speed(own.speed),
                    own.frequency
                )
            }
        }
    }
}

/// Returns a vehicle in steady running at [`SETTLING_SPEED`].
fn steady(case: &VehicleCase) -> Result<Vehicle, VehicleStabilityError> {
    let mut vehicle = Vehicle::rolling(&case.description, SETTLING_SPEED, 2.0 * SETTLED * SETTLING_SPEED)?;
    let options = Options {
        relative_tolerance: 1e-6,
        ..Options::of(Method::Esdirk3)
    };
    let mut integrator = Integrator::new(vehicle.system.clone(), options, 0.0, &vehicle.rest)?;
    while integrator.time() < SETTLED {
        integrator.step_to(SETTLED)?;
    }
    vehicle.settle(integrator.x());
    Ok(vehicle)
}

/// The reason why there is nothing to be found.
#[derive(Debug, thiserror::Error)]
pub enum VehicleStabilityError {
    /// It has no equilibrium on straight track.
    #[error(transparent)]
    Vehicle(#[from] VehicleError),
    /// It does not run.
    #[error("it does not run steadily: {0}")]
    Running(#[from] StepError),
    /// It cannot begin to run.
    #[error("it cannot begin to run: {0}")]
    Setup(#[from] SetupError),
    /// Its equations cannot be linearized.
    #[error(transparent)]
    Linear(#[from] NoVibration),
}

fn vibrations(vehicle: &mut Vehicle, speed: f64) -> Result<Vec<Vibration>, NoVibration> {
    let [slowest, fastest] = VIBRATIONS.map(|hertz| 2.0 * PI * hertz);
    let mut own = vehicle.vibrations_at(speed / SETTLING_SPEED)?;
    own.retain(|own| (slowest..=fastest).contains(&own.frequency));
    own.sort_by(|a, b| b.growth.total_cmp(&a.growth));
    Ok(own)
}

fn growing(all: &[Vibration]) -> Option<Vibration> {
    all.first().filter(|own| own.growth > NONE).copied()
}
