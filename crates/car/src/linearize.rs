//! Motions about steady running on straight track: growth, frequency and shape, with friction stuck, absent,
//! or at an amplitude.
//!
//! A car with profiled wheels runs for a second, so that creep forces and loads agree; then all its bodies
//! move forward and its wheels roll, and nothing else moves. With steady running all forces depend on
//! creepages alone: the state of another speed has the same displacements. Cars on linear wheels are taken as
//! they start. Distance and spin stand in no force and give eigenvalues of zero. The car coasts: a control of
//! its speed would damp its pitch.
//!
//! What friction does in wedges, plates, adapters and side bearings decides: bristles that stick are springs;
//! without friction these parts are free where nothing else holds them; at an amplitude each slider has the
//! stiffness and damping of its describing function ([`mechanics::linear::Slider`]). Wheels keep their creep.

use integrate::{Integrator, Method, Options, SetupError, StepError};
use mechanics::linear::{Equivalent, LinearMode, LinearModel, NoVibration};
use nalgebra::Complex;
use rolling::wheelset::coordinate;
use thiserror::Error;

use crate::assemble::Car;
use crate::error::BuildError;
use crate::parameters::{Drive, Parameters, Start, StartKind, Wheels};

/// Friction in the linearization about steady running.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionState {
    /// Everything sticks: bristles are springs.
    Stuck,
    /// There is none.
    Absent,
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
}

/// Vibrations slower than this are drifts, those faster than this are of contacts, not of the car; Hz.
pub const VIBRATIONS: [f64; 2] = [0.05, 30.0];
/// Time that a car runs before it is linearized, s, and its speed, m/s.
const SETTLED: f64 = 1.0;
const SETTLING_SPEED: f64 = 20.0;
/// About which eigenvalues are found best, 1/s, and the steps in which they are looked for.
const SHIFT: f64 = 20.0;
const STEPS: usize = 110;

/// A car in steady running on straight track.
#[derive(Clone, Debug)]
pub struct SteadyCar {
    car: Car,
    state: Vec<f64>,
    /// The speed of the state, m/s.
    speed: f64,
    start: Start,
    /// Places of the coordinates that are held.
    held: Vec<usize>,
}

impl SteadyCar {
    /// Returns the car in steady running; it starts where its start says, which must be on straight track
    /// without irregularities for a second of running at 20 m/s.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn new(parameters: &Parameters) -> Result<Self, LinearizeError> {
        let mut running = parameters.clone();
        running.drive = Drive::Coasting;
        running.couplers = running.couplers.idle();
        running.start.speed = SETTLING_SPEED;
        running.start.wheelset_shifts = [0.0; 4];
        running.start.body_shift = 0.0;
        let car = Car::new(&running)?;
        let mut state = car.initial_state.clone();
        if matches!(running.wheels, Wheels::OnRails(_)) {
            let options = Options {
                relative_tolerance: 1e-6,
                ..Options::of(Method::Esdirk3)
            };
            let mut integrator = Integrator::new(car.system.clone(), options, 0.0, &state)?;
            while integrator.time() < SETTLED {
                integrator.step_to(SETTLED)?;
            }
            state.copy_from_slice(integrator.x());
        }
        Ok(Self {
            car,
            state,
            speed: SETTLING_SPEED,
            start: running.start,
            held: Vec::new(),
        })
    }

    /// Returns a car of the same bodies and sliders with other forces in the same state.
    ///
    /// # Errors
    /// The parameters make no car.
    pub fn with(&self, parameters: &Parameters) -> Result<Self, LinearizeError> {
        let mut other = parameters.clone();
        other.drive = Drive::Coasting;
        other.couplers = other.couplers.idle();
        other.start = Start {
            kind: StartKind::Nominal,
            ..self.start.clone()
        };
        Ok(Self {
            car: Car::new(&other)?,
            state: self.state.clone(),
            speed: self.speed,
            start: self.start.clone(),
            held: self.held.clone(),
        })
    }

    /// Holds the car's body in its steady motion, so that each truck runs alone under a mass without end.
    pub fn hold_body(&mut self) {
        let system = &self.car.system;
        let parts = self.car.numbers.body_parts();
        let places = parts.flat_map(|body| (0..6).filter_map(move |k| system.position_of(body, k)));
        self.held = places.collect();
    }

    /// Returns the car.
    #[must_use]
    pub fn car(&self) -> &Car {
        &self.car
    }

    /// Returns its state at a speed (m/s): that of the run, with nothing moving but forward, and wheels that
    /// roll as they do at its end.
    #[must_use]
    pub fn state(&self, speed: f64) -> Vec<f64> {
        let system = &self.car.system;
        let layout = system.layout();
        let mut state = self.state.clone();
        state[layout.speeds..].fill(0.0);
        system.set_element_states(&system.element_states(&self.state), &mut state);
        let start = &self.car.initial_state;
        let rates = (0..system.bodies().len()).flat_map(|body| (0..6).map(move |k| (body, k)));
        let rate_of = |body: usize, k: usize| Some(layout.speeds + system.position_of(body, k)?);
        for rate in rates.filter_map(|(body, k)| rate_of(body, k)) {
            state[rate] = start[rate] * speed / self.speed;
        }
        // What carries a wheelset has its coordinates, so that wheels come last. They roll as they settled,
        // by the way that they then made.
        for wheelset in self.car.numbers.wheelsets {
            let own = [coordinate::FORWARD, coordinate::SPIN].map(|k| rate_of(wheelset, k));
            if let [Some(forward), Some(spin)] = own {
                state[spin] = self.state[spin] * state[forward] / self.state[forward];
            }
        }
        state
    }

    /// Returns the linear model at a speed (m/s).
    ///
    /// # Errors
    /// The speed is not positive.
    pub fn model(&mut self, speed: f64) -> Result<LinearModel, LinearizeError> {
        if !(speed > 0.0 && speed.is_finite()) {
            return Err(LinearizeError::Speed(speed));
        }
        let state = self.state(speed);
        let mut model = self.car.system.linear_model(0.0, &state);
        model.hold(&self.held);
        Ok(model)
    }
}

/// Returns the vibrations of a model ([`VIBRATIONS`]) with these sliders, by falling growth.
///
/// # Errors
/// They are not found.
pub fn vibrations(
    model: &LinearModel,
    sliders: impl IntoIterator<Item = Equivalent>,
) -> Result<Vec<LinearMode>, NoVibration> {
    let mut modes = model.with(sliders).modes(SHIFT, STEPS)?;
    let [slowest, fastest] = VIBRATIONS;
    modes.retain(|mode| (slowest..=fastest).contains(&mode.frequency()));
    Ok(modes)
}

/// A motion about steady running.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// Growth, 1/s: negative where it dies away.
    pub growth: f64,
    /// Frequency, Hz.
    pub frequency: f64,
}

/// A speed from which on a vibration grows.
#[derive(Clone, Debug, PartialEq)]
pub struct CriticalSpeed {
    /// The speed, m/s.
    pub speed: f64,
    /// Frequency of the vibration there, Hz.
    pub frequency: f64,
    /// Its shape, in the order of the positions.
    pub shape: Vec<Complex<f64>>,
}

/// Growth below this is none, 1/s: that of undamped vibrations in rounding.
const NONE: f64 = 1e-5;

/// Returns the vibration that grows, if one does.
#[must_use]
pub fn growing(modes: &[LinearMode]) -> Option<&LinearMode> {
    modes.first().filter(|mode| mode.growth() > NONE)
}

impl FrictionState {
    /// Returns what stands for the sliders of a model.
    #[must_use]
    pub fn of(self, model: &LinearModel) -> Vec<Equivalent> {
        let own = model.sliders.iter().map(|own| match self {
            Self::Stuck => own.slider.stuck(),
            Self::Absent => Equivalent::NONE,
        });
        own.collect()
    }
}

impl SteadyCar {
    /// Returns the vibrations at a speed (m/s), by falling growth.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn vibrations(
        &mut self,
        speed: f64,
        friction: FrictionState,
    ) -> Result<Vec<LinearMode>, LinearizeError> {
        let model = self.model(speed)?;
        Ok(vibrations(&model, friction.of(&model))?)
    }

    /// Returns the critical speed between a speed at which nothing grows and one at which a vibration does
    /// (m/s), within a thousandth.
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn critical_speed(
        &mut self,
        [low, high]: [f64; 2],
        friction: FrictionState,
    ) -> Result<Option<CriticalSpeed>, LinearizeError> {
        let mut worst = |speed: f64| -> Result<Option<LinearMode>, LinearizeError> {
            Ok(self.vibrations(speed, friction)?.into_iter().next())
        };
        let growth =
            |own: &Option<LinearMode>| own.as_ref().map_or(f64::NEG_INFINITY, |own| own.growth() - NONE);
        let (mut before, mut after) = ((low, growth(&worst(low)?)), (high, worst(high)?));
        while after.0 - before.0 > 1e-3 * after.0 {
            // Between a tenth and nine tenths: a secant that cannot stall.
            let share = -before.1 / (growth(&after.1) - before.1);
            let share = if share.is_finite() {
                share.clamp(0.1, 0.9)
            } else {
                0.5
            };
            let speed = before.0 + share * (after.0 - before.0);
            let own = worst(speed)?;
            if growth(&own) > 0.0 {
                after = (speed, own);
            } else {
                before = (speed, growth(&own));
            }
        }
        let share = -before.1 / (growth(&after.1) - before.1);
        let share = if share.is_finite() { share } else { 1.0 };
        Ok(after.1.map(|mode| CriticalSpeed {
            speed: before.0 + share * (after.0 - before.0),
            frequency: mode.frequency(),
            shape: mode.shape,
        }))
    }
}

impl Parameters {
    /// Returns growth and frequency of the vibrations about steady running at a speed (m/s), by falling
    /// growth; see [`SteadyCar::new`].
    ///
    /// # Errors
    /// [`LinearizeError`].
    pub fn modes(&self, speed: f64, friction: FrictionState) -> Result<Vec<Mode>, LinearizeError> {
        let modes = SteadyCar::new(self)?.vibrations(speed, friction)?;
        let modes = modes.into_iter().map(|mode| Mode {
            growth: mode.growth(),
            frequency: mode.frequency(),
        });
        Ok(modes.collect())
    }
}
