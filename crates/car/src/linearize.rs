//! Linearization about steady running on straight track: growth and frequency of all motions, and the speed
//! from which one grows.
//!
//! A car whose friction sticks runs on its wheels for a second, so that creep forces and loads agree;
//! others are taken as they start, since nothing would damp what remains of the start. There its whole
//! Jacobian matrix is taken (`System::eigenvalues`). Distance and spin stand in no force and give
//! eigenvalues of zero. The car coasts: a control of its speed would damp its pitch. What friction does in
//! wedges, plates, adapters and side bearings is a choice, since it decides: bristles that stick are
//! springs; without friction these parts are free where nothing else holds them, and a car may buckle
//! slowly, which is no vibration.

use integrate::{Integrator, Method, Options, SetupError, StepError};
use mechanics::friction::FrictionLaw;
use mechanics::system::NoVibration;
use thiserror::Error;
use truck::{Adapter, SideBearing};
use wedge::parameters::FaceFriction;

use crate::assemble::Car;
use crate::error::BuildError;
use crate::parameters::{Drive, Parameters, StartKind, Wheels};

/// Friction in the linearization about steady running.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionState {
    /// Everything sticks: bristles are springs.
    Stuck,
    /// There is none.
    Absent,
}

/// A motion about steady running.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Growth, 1/s: negative where it dies away.
    pub growth: f64,
    /// Frequency, Hz; zero where it does not vibrate.
    pub frequency: f64,
}

/// A speed from which on a vibration grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CriticalSpeed {
    /// The speed, m/s.
    pub speed: f64,
    /// Frequency of the vibration there, Hz.
    pub frequency: f64,
}

/// Reasons why there is no linearization.
#[derive(Debug, Error)]
pub enum LinearizeError {
    /// There is no car.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// It does not run.
    #[error("the car does not run steadily: {0}")]
    Running(#[from] StepError),
    /// It cannot begin to run.
    #[error("the car cannot begin to run: {0}")]
    Setup(#[from] SetupError),
    /// There are no eigenvalues.
    #[error(transparent)]
    Eigenvalues(#[from] NoVibration),
    /// It stands still.
    #[error("the speed is {0} m/s; it must be positive: a car that stands has no steady running")]
    Speed(f64),
    /// Speeds make no range.
    #[error(
        "speeds from {low} to {high} m/s in steps of {step} m/s make no search: all must be positive and rise"
    )]
    Range {
        /// The lowest, m/s.
        low: f64,
        /// The highest, m/s.
        high: f64,
        /// Their distance, m/s.
        step: f64,
    },
}

/// Vibrations slower than this are drifts, Hz; those faster than this are of contacts, not of the car.
const SLOWEST: f64 = 0.05;
const FASTEST: f64 = 30.0;
/// Growth below this is none, 1/s: that of undamped vibrations in rounding.
const NONE: f64 = 1e-5;
/// Time that a car runs before it is linearized, s.
const SETTLED: f64 = 1.0;
/// About which eigenvalues are found best, 1/s.
const SHIFT: f64 = 20.0;

impl Parameters {
    /// Returns the same car without friction in wedges, plates, adapters and side bearings; wheels keep
    /// theirs.
    #[must_use]
    pub fn without_friction(&self) -> Self {
        let none = FaceFriction {
            coefficient: 0.0,
            law: FrictionLaw::Tanh { reference_speed: 1.0 },
        };
        let mut free = self.clone();
        for own in &mut free.trucks {
            for wedge in &mut own.wedges {
                (wedge.column_friction, wedge.slope_friction) = (none, none);
                wedge.split.friction = none;
            }
            if let Some(wheelsets) = &mut own.wheelsets
                && let Adapter::Friction(adapter) = &mut wheelsets.adapter
            {
                adapter.friction = none;
            }
            if let Some(body) = &mut own.car_body {
                body.center_plate.friction = none;
                if let SideBearing::ConstantContact { friction, .. } = &mut body.side_bearings.kind {
                    *friction = none;
                }
            }
        }
        free
    }

    /// Returns all motions about steady running at a speed (m/s), by falling growth; the car starts where
    /// its start says, which must be on straight track without irregularities for a second of running.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn modes(&self, speed: f64, friction: FrictionState) -> Result<Vec<Mode>, LinearizeError> {
        if !(speed > 0.0 && speed.is_finite()) {
            return Err(LinearizeError::Speed(speed));
        }
        let mut running = match friction {
            FrictionState::Stuck => self.clone(),
            FrictionState::Absent => self.without_friction(),
        };
        if friction == FrictionState::Absent && running.start.kind == StartKind::Shaken {
            // Without friction nothing is locked in.
            running.start.kind = StartKind::Equilibrium;
        }
        running.drive = Drive::Coasting;
        running.start.speed = speed;
        running.start.wheelset_shifts = [0.0; 4];
        running.start.body_shift = 0.0;
        let car = Car::new(&running)?;
        let mut system = car.system.clone();
        let mut state = car.initial_state.clone();
        if friction == FrictionState::Stuck && matches!(running.wheels, Wheels::OnRails(_)) {
            let options = Options {
                relative_tolerance: 1e-6,
                ..Options::of(Method::Esdirk3)
            };
            let mut integrator = Integrator::new(car.system, options, 0.0, &state)?;
            while integrator.time() < SETTLED {
                integrator.step_to(SETTLED)?;
            }
            state.copy_from_slice(integrator.x());
        }
        let values = system.eigenvalues(0.0, &state, SHIFT)?;
        let modes = values.into_iter().filter(|[_, imaginary]| *imaginary >= 0.0);
        let modes = modes.map(|[growth, imaginary]| Mode {
            growth,
            frequency: imaginary / (2.0 * std::f64::consts::PI),
        });
        Ok(modes.collect())
    }

    /// Returns the lowest speed (m/s) within a range from which on a vibration grows; speeds are tried in
    /// steps (m/s), the one between two steps is found by linear search within a thousandth. None: none
    /// grows at the speeds tried.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn critical_speed(
        &self,
        [low, high]: [f64; 2],
        step: f64,
        friction: FrictionState,
    ) -> Result<Option<CriticalSpeed>, LinearizeError> {
        if !(low > 0.0 && high >= low && step > 0.0 && high.is_finite()) {
            return Err(LinearizeError::Range { low, high, step });
        }
        let worst = |speed: f64| -> Result<Mode, LinearizeError> {
            let modes = self.modes(speed, friction)?;
            let none = Mode {
                growth: f64::NEG_INFINITY,
                frequency: 0.0,
            };
            let own = modes
                .into_iter()
                .find(|mode| (SLOWEST..FASTEST).contains(&mode.frequency));
            Ok(own.map_or(none, |mode| Mode {
                growth: mode.growth - NONE,
                ..mode
            }))
        };
        let mut before = (low, worst(low)?);
        if before.1.growth > 0.0 {
            return Ok(Some(CriticalSpeed {
                speed: low,
                frequency: before.1.frequency,
            }));
        }
        let count = ((high - low) / step).ceil() as usize;
        for k in 1..=count {
            let speed = (low + k as f64 * step).min(high);
            let mut after = (speed, worst(speed)?);
            if after.1.growth <= 0.0 {
                before = after;
                continue;
            }
            while after.0 - before.0 > 1e-3 * after.0 {
                // Between a tenth and nine tenths: a secant that cannot stall.
                let share = -before.1.growth / (after.1.growth - before.1.growth);
                let speed = before.0 + share.clamp(0.1, 0.9) * (after.0 - before.0);
                let own = (speed, worst(speed)?);
                *(if own.1.growth > 0.0 {
                    &mut after
                } else {
                    &mut before
                }) = own;
            }
            let share = -before.1.growth / (after.1.growth - before.1.growth);
            return Ok(Some(CriticalSpeed {
                speed: before.0 + share * (after.0 - before.0),
                frequency: after.1.frequency,
            }));
        }
        Ok(None)
    }
}
