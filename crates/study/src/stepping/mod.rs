//! The wedge as an element of somebody else's simulation: the caller moves bolster and side frame step by
//! step, and reads the forces on them.
//!
//! [`SteppedWedge`] integrates itself from one call to the next. Coordinates, axes and reference points are
//! those of [`wedge::inputs`]. SI units.
//!
//! ```
//! use study::case::Case;
//! use study::stepping::{SteppedWedge, Neighbours};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let case = Case::parse("case.toml", "[wedge]\ndamping = \"constant\"\n", std::path::Path::new(""), &[])?;
//! let mut wedge = SteppedWedge::new(&case)?;
//! let mut place = *wedge.neighbours();
//! for _ in 0..20 {
//!     place.bolster.position[2] += 50e-6; // the bolster rises by 0.05 m/s
//!     place.bolster.rate[2] = 0.05;
//!     wedge.step(&place, 0.001)?;
//! }
//! assert!(wedge.reading()?.on_side_frame.force.0[2] > 0.0, "it drags the side frame up");
//! # Ok(())
//! # }
//! ```

mod error;
mod state;

pub use error::SteppingError;
pub use state::{MOST_STATE_BYTES, STEPPED_STATE_VERSION, SteppedState};
pub use wedge::inputs::{CoilInput, NeighbourState, Neighbours, Reading};

use std::fmt;

use integrate::{Integrator, Options, Statistics};
use mechanics::output::Column;
use mechanics::system::{ElementEvaluation, Observation, System};

use crate::case::{Case, Simulation};
use crate::progress::{self, Pace};
use error::{check_coil, check_friction, check_neighbours};
use wedge::inputs::COIL;
use wedge::outputs::{Ledger, Outputs};
use wedge::{COLUMN, Parameters, SLOPE, Wedge};

/// A step must be longer, s: below, times are rounding.
const SHORTEST_STEP: f64 = 1e-15;
/// The largest path of the neighbours against each other in one step, m: several times what a truck's springs
/// travel.
pub const LARGEST_PATH: f64 = 1.0;

/// A wedge whose neighbours are moved by the caller, and which integrates itself.
///
/// During a step each coordinate of a neighbour is the cubic through its values and rates at both ends. Steps
/// may have any lengths; a smooth motion does not restart the integrator.
pub struct SteppedWedge {
    /// The wedge, its neighbours being where they are.
    wedge: Wedge,
    /// The parameters with the motions of the case.
    parameters: Parameters,
    outputs: Outputs,
    integrator: Integrator<System>,
    options: Options,
    start: Neighbours,
    start_energy: f64,
    neighbours: Neighbours,
    coil: CoilInput,
    friction: [f64; 2],
    failed: bool,
    evaluation: ElementEvaluation<f64>,
}

impl fmt::Debug for SteppedWedge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SteppedWedge")
            .field("time", &self.time())
            .field("states", &self.states())
            .field("neighbours", &self.neighbours)
            .finish_non_exhaustive()
    }
}

impl SteppedWedge {
    /// Returns the wedge of a case at time zero, its neighbours where the case's motions begin.
    ///
    /// # Errors
    /// The parameters make no wedge, or the integrator refuses the start.
    pub fn new(case: &Case) -> Result<Self, SteppingError> {
        let start = Neighbours::of(&case.parameters, 0.0);
        Self::starting(case, &start)
    }

    /// Returns the same with the neighbours elsewhere at the start.
    ///
    /// # Errors
    /// As [`SteppedWedge::new`], and values that are not finite.
    pub fn starting(case: &Case, start: &Neighbours) -> Result<Self, SteppingError> {
        Self::with(&case.parameters, options(&case.simulation), start)
    }

    fn with(parameters: &Parameters, options: Options, start: &Neighbours) -> Result<Self, SteppingError> {
        check_neighbours(start)?;
        let wedge = Wedge::new(parameters.with_inputs(start))?;
        let x = &wedge.initial_state;
        // The number of steps is bounded by the rule of `progress`, for each step of the neighbours.
        let options = Options {
            maximum_steps: u64::MAX,
            ..options
        };
        let integrator = Integrator::new(wedge.system.clone(), options.clone(), 0.0, x)?;
        Ok(Self {
            outputs: Outputs::new(&wedge.parameters),
            start_energy: wedge.system.clone().observe(0.0, x).energies.total(),
            parameters: parameters.clone(),
            integrator,
            options,
            start: *start,
            neighbours: *start,
            coil: CoilInput::Internal,
            friction: [
                parameters.column_friction.coefficient,
                parameters.slope_friction.coefficient,
            ],
            failed: false,
            evaluation: ElementEvaluation::default(),
            wedge,
        })
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// Returns the states reached (SI): free coordinates, their rates, bristles, work and losses.
    #[must_use]
    pub fn states(&self) -> &[f64] {
        self.integrator.x()
    }

    /// Returns the system, as it is built for this wedge.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.wedge.system
    }

    /// Returns the places of the neighbors.
    #[must_use]
    pub fn neighbours(&self) -> &Neighbours {
        &self.neighbours
    }

    /// Returns the evaluation of all corners and the coil.
    pub fn evaluation(&mut self) -> &ElementEvaluation<f64> {
        let (time, x) = (self.integrator.time(), self.integrator.x());
        self.wedge.system.evaluate_elements(time, x, &mut self.evaluation);
        &self.evaluation
    }

    /// Returns the wrenches of the wedge on its neighbors, and the forces of coil and faces.
    ///
    /// # Errors
    /// Never, with a wedge that was built here.
    pub fn reading(&mut self) -> Result<Reading<f64>, SteppingError> {
        self.evaluation();
        Reading::of(&self.evaluation, &self.wedge.system, &self.wedge.parameters).ok_or(SteppingError::Failed)
    }

    /// Everything that the state says.
    #[must_use]
    pub fn observe(&mut self) -> Observation {
        let (time, x) = (self.integrator.time(), self.integrator.x());
        self.wedge.system.observe(time, x)
    }

    /// Returns the ledger since the start, J. Work of a coil from outside is in its residual.
    #[must_use]
    pub fn ledger(&mut self) -> Ledger {
        let seen = self.observe();
        Outputs::ledger(&self.wedge.system, &seen, self.start_energy)
    }

    /// Returns the columns of [`SteppedWedge::row`].
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.outputs.columns()
    }

    /// Returns a row of the table that a run writes, SI.
    #[must_use]
    pub fn row(&mut self) -> Vec<f64> {
        let seen = self.observe();
        let mut row = Vec::with_capacity(self.outputs.columns().len());
        let contact_states = self.integrator.discrete_states();
        self.outputs.values(
            &self.wedge.system,
            &seen,
            contact_states,
            self.start_energy,
            &mut row,
        );
        row
    }

    /// Returns the counters of the integrator so far.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        self.integrator.statistics()
    }

    /// Makes one step: within `duration` (s) the neighbours go from where they are to `end`.
    ///
    /// # Errors A duration that is not positive, values that are not finite, or neighbours that part by more
    /// than [`LARGEST_PATH`]; or the integrator cannot go on: the wedge then takes no further step until a
    /// state is restored.
    pub fn step(&mut self, end: &Neighbours, duration: f64) -> Result<(), SteppingError> {
        if !self.failed {
            check_neighbours(end)?;
            self.check_path(end)?;
        }
        self.step_to(end, self.time() + duration)
    }

    /// Refuses a step in which the neighbours move against each other by more than a wedge can follow.
    fn check_path(&self, end: &Neighbours) -> Result<(), SteppingError> {
        let start = self.neighbours();
        for (coordinate, name) in mechanics::body::COORDINATES.into_iter().enumerate().take(3) {
            let apart =
                |at: &Neighbours| at.bolster.position[coordinate] - at.side_frame.position[coordinate];
            let path = apart(end) - apart(start);
            if path.abs() > LARGEST_PATH {
                return Err(SteppingError::TooFar {
                    coordinate: name,
                    path,
                });
            }
        }
        Ok(())
    }

    /// Makes the same step with the time (s) at its end, however far the neighbours move.
    ///
    /// # Errors
    /// As [`SteppedWedge::step`], but for the last.
    pub fn step_to(&mut self, end: &Neighbours, time: f64) -> Result<(), SteppingError> {
        if self.failed {
            return Err(SteppingError::Failed);
        }
        let start = self.time();
        let duration = time - start;
        if !(duration > SHORTEST_STEP && duration.is_finite()) {
            return Err(SteppingError::NoStep {
                step: duration,
                time: start,
            });
        }
        check_neighbours(end)?;
        let result = self.advance(end, start, duration, time);
        self.failed = result.is_err();
        result
    }

    fn advance(
        &mut self,
        end: &Neighbours,
        start: f64,
        duration: f64,
        time: f64,
    ) -> Result<(), SteppingError> {
        let from = self.neighbours;
        from.set_between(self.integrator.problem_mut(), start, duration, end)?;
        self.integrator.reevaluate();
        let mut pace = Pace::of(&self.integrator);
        while self.integrator.time() < time {
            let name = |state| progress::state_name(&self.wedge.system, [&[], &[]], state);
            if let Err(error) = self.integrator.step_to(time) {
                return Err(SteppingError::Step(progress::describe(&error, name)));
            }
            pace.check(&self.integrator, duration)
                .map_err(|stalled| SteppingError::TooLong {
                    step: duration,
                    time: start,
                    why: stalled.describe(name),
                })?;
        }
        self.follow(end)
    }

    /// Puts the neighbours where they are now.
    fn follow(&mut self, at: &Neighbours) -> Result<(), SteppingError> {
        self.neighbours = *at;
        // Straight through the place that was given: whoever begins here from a saved state sees the same.
        at.set_at(&mut self.wedge.system, self.integrator.time())?;
        Ok(())
    }

    /// Sets the source of the coil's force from now on.
    ///
    /// # Errors
    /// Values that are not finite, or a negative stiffness.
    pub fn set_coil(&mut self, coil: CoilInput) -> Result<(), SteppingError> {
        check_coil(&coil)?;
        for system in [&mut self.wedge.system, self.integrator.problem_mut()] {
            system.set_coil_law(COIL, coil.law(&self.parameters))?;
        }
        self.coil = coil;
        Ok(())
    }

    /// Sets the coefficients of friction of column and slope, from now on.
    ///
    /// # Errors
    /// Values that are not finite, or negative.
    pub fn set_friction(&mut self, friction: [f64; 2]) -> Result<(), SteppingError> {
        check_friction(friction)?;
        for system in [&mut self.wedge.system, self.integrator.problem_mut()] {
            for (face, coefficient) in [COLUMN, SLOPE].into_iter().zip(friction) {
                system.set_friction(face, coefficient)?;
            }
        }
        self.friction = friction;
        Ok(())
    }

    /// Returns all that is needed to go on with the same bits, also in another process.
    #[must_use]
    pub fn state(&self) -> SteppedState {
        SteppedState {
            version: STEPPED_STATE_VERSION,
            fingerprint: state::fingerprint(&self.parameters, &self.options),
            start: self.start,
            neighbours: self.neighbours,
            coil: self.coil,
            friction: self.friction,
            failed: self.failed,
            integrator: self.integrator.state(),
        }
    }

    /// Goes back (or on) to a saved state of a wedge of the same case.
    ///
    /// # Errors
    /// The state is of another version or another case, or damaged; nothing has changed then.
    pub fn restore(&mut self, state: &SteppedState) -> Result<(), SteppingError> {
        if state.version != STEPPED_STATE_VERSION {
            return Err(SteppingError::Version {
                found: state.version,
                expected: STEPPED_STATE_VERSION,
            });
        }
        if state.fingerprint != state::fingerprint(&self.parameters, &self.options) {
            return Err(SteppingError::OtherCase);
        }
        state.check()?;
        // Refused before anything changes.
        self.integrator.check_state(&state.integrator)?;
        if state.start != self.start {
            *self = Self::with(&self.parameters, self.options.clone(), &state.start)?;
        }
        self.set_coil(state.coil)?;
        self.set_friction(state.friction)?;
        let time = state.integrator.time;
        state.neighbours.set_at(self.integrator.problem_mut(), time)?;
        self.integrator.restore(&state.integrator)?;
        self.failed = state.failed;
        self.follow(&state.neighbours)
    }
}

/// Returns the options of a case's integration.
#[must_use]
pub fn options(simulation: &Simulation) -> Options {
    Options {
        method: simulation.method,
        relative_tolerance: simulation.relative_tolerance,
        ..Options::default()
    }
}
