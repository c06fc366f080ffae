//! The wedge as an element of somebody else's simulation: the caller moves bolster and side frame, step by
//! step or instant by instant, and reads the forces on them.
//!
//! [`SteppedWedge`] integrates itself from one call to the next; [`Equations`] gives rates, margins and
//! derivatives for a solver of the caller's. Coordinates, axes and reference points are those of
//! [`wedge::inputs`]. SI units.
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

mod equations;
mod state;

pub use equations::{Equations, SteppingError};
pub use state::{MOST_STATE_BYTES, STEPPED_STATE_VERSION, SteppedState};
pub use wedge::inputs::{CoilInput, NeighbourState, Neighbours, Reading};

use integrate::{Integrator, Options, Statistics};
use mechanics::output::Column;
use mechanics::plausibility::PlausibilityFinding;
use mechanics::system::{ElementEvaluation, Energies, JacobianVectorProduct, System};

use crate::case::{Case, Simulation};
use crate::progress::{self, Pace};
use wedge::Parameters;
use wedge::inputs::COIL;
use wedge::outputs::Ledger;

/// A step must be longer, s: below, times are rounding.
const SHORTEST_STEP: f64 = 1e-15;
/// The largest path of the neighbours against each other in one step, m: several times what a truck's springs
/// travel.
pub const LARGEST_PATH: f64 = 1.0;

/// A wedge whose neighbours are moved by the caller, and which integrates itself.
///
/// During a step each coordinate of a neighbour is the cubic through its values and rates at both ends. Steps
/// may have any lengths; a smooth motion does not restart the integrator.
#[derive(Debug)]
pub struct SteppedWedge {
    equations: Equations,
    integrator: Integrator<System>,
    options: Options,
    failed: bool,
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
        Self::with(
            &case.parameters,
            options(&case.simulation),
            start,
            CoilInput::Internal,
        )
    }

    /// Returns the same of parameters, options of the integrator (the number of steps is bounded by the rule
    /// of [`progress`], for each step of the neighbours) and a coil that may be outside.
    ///
    /// # Errors
    /// As [`SteppedWedge::starting`].
    pub fn with(
        parameters: &Parameters,
        options: Options,
        start: &Neighbours,
        coil: CoilInput,
    ) -> Result<Self, SteppingError> {
        let equations = Equations::new(parameters, start, coil)?;
        let options = Options {
            maximum_steps: u64::MAX,
            ..options
        };
        let integrator = Integrator::new(
            equations.system().clone(),
            options.clone(),
            equations.time(),
            equations.states(),
        )?;
        Ok(Self {
            equations,
            integrator,
            options,
            failed: false,
        })
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.equations.time()
    }

    /// Returns the places of the neighbors.
    #[must_use]
    pub fn neighbours(&self) -> &Neighbours {
        self.equations.neighbours()
    }

    /// Returns the state reached.
    #[must_use]
    pub fn equations(&self) -> &Equations {
        &self.equations
    }

    /// Returns the wrenches of the wedge on its neighbors, and the forces of coil and faces.
    ///
    /// # Errors
    /// Never, with a wedge that was built here.
    pub fn reading(&mut self) -> Result<Reading<f64>, SteppingError> {
        self.equations.reading()
    }

    /// Returns the evaluation of all corners and the coil.
    pub fn evaluation(&mut self) -> &ElementEvaluation<f64> {
        self.equations.evaluation()
    }

    /// Returns what has been implausible so far, see [`Equations::findings`].
    pub fn findings(&mut self) -> Vec<PlausibilityFinding> {
        self.equations.findings()
    }

    /// Writes the rates of the states, see [`Equations::rates`].
    ///
    /// # Errors
    /// `out` does not have the length of the states.
    pub fn rates(&mut self, out: &mut [f64]) -> Result<(), SteppingError> {
        self.equations.rates(out)
    }

    /// Returns the margins of the contact states, see [`Equations::margins`].
    pub fn margins(&mut self) -> &[f64] {
        self.equations.margins()
    }

    /// Returns the columns of [`SteppedWedge::row`].
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.equations.columns()
    }

    /// Returns a row of the table that a run writes, SI.
    #[must_use]
    pub fn row(&mut self) -> Vec<f64> {
        self.equations.row()
    }

    /// Stored energies and the ledger since the start, see [`Equations::energies`].
    #[must_use]
    pub fn energies(&mut self) -> (Energies, Ledger) {
        self.equations.energies()
    }

    /// Derivatives along a direction, see [`Equations::jacobian_vector_product`].
    ///
    /// # Errors
    /// A wrong number of states.
    pub fn jacobian_vector_product(
        &mut self,
        states: &[f64],
        neighbours: &Neighbours,
        coil_force: f64,
    ) -> Result<JacobianVectorProduct, SteppingError> {
        self.equations
            .jacobian_vector_product(states, neighbours, coil_force)
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
            equations::check_neighbours(end)?;
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
        equations::check_neighbours(end)?;
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
        let from = *self.equations.neighbours();
        from.set_between(self.integrator.problem_mut(), start, duration, end)?;
        self.integrator.reevaluate();
        let mut pace = Pace::of(&self.integrator);
        while self.integrator.time() < time {
            let name = |state| progress::state_name(self.equations.system(), [&[], &[]], state);
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
        self.equations
            .follow(time, self.integrator.x(), self.integrator.discrete_states(), end)
    }

    /// Sets the source of the coil's force from now on.
    ///
    /// # Errors
    /// Values that are not finite, or a negative stiffness.
    pub fn set_coil(&mut self, coil: CoilInput) -> Result<(), SteppingError> {
        if coil == *self.equations.coil() {
            return Ok(());
        }
        self.equations.set_coil(coil)?;
        let law = coil.law(self.equations.parameters());
        self.integrator.problem_mut().set_coil_law(COIL, law)?;
        Ok(())
    }

    /// Sets the coefficients of friction of column and slope, from now on.
    ///
    /// # Errors
    /// Values that are not finite, or negative.
    pub fn set_friction(&mut self, friction: [f64; 2]) -> Result<(), SteppingError> {
        if friction == self.equations.friction() {
            return Ok(());
        }
        self.equations.set_friction(friction)?;
        for (face, coefficient) in friction.into_iter().enumerate() {
            self.integrator.problem_mut().set_friction(face, coefficient)?;
        }
        Ok(())
    }

    /// Returns all that is needed to go on with the same bits, also in another process.
    #[must_use]
    pub fn state(&self) -> SteppedState {
        SteppedState {
            version: STEPPED_STATE_VERSION,
            fingerprint: state::fingerprint(self.equations.parameters(), &self.options),
            start: *self.equations.start(),
            start_coil: self.equations.start_coil(),
            neighbours: *self.equations.neighbours(),
            coil: *self.equations.coil(),
            friction: self.equations.friction(),
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
        if state.fingerprint != state::fingerprint(self.equations.parameters(), &self.options) {
            return Err(SteppingError::OtherCase);
        }
        state.check()?;
        // Refused before anything changes.
        self.integrator.check_state(&state.integrator)?;
        let mut fresh = None;
        if (state.start, state.start_coil) != (*self.equations.start(), self.equations.start_coil()) {
            let parameters = self.equations.parameters().clone();
            fresh = Some(Self::with(
                &parameters,
                self.options.clone(),
                &state.start,
                state.start_coil,
            )?);
        }
        if let Some(fresh) = fresh {
            *self = fresh;
        }
        self.set_coil(state.coil)?;
        self.set_friction(state.friction)?;
        let time = state.integrator.time;
        state.neighbours.set_at(self.integrator.problem_mut(), time)?;
        self.integrator.restore(&state.integrator)?;
        self.failed = state.failed;
        self.equations.follow(
            time,
            self.integrator.x(),
            self.integrator.discrete_states(),
            &state.neighbours,
        )
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
