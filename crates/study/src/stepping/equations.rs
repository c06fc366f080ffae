//! The equations of a driven wedge at one instant: for solvers that bring their own integration, and for
//! reading results.

use std::fmt;

use integrate::{Problem, SetupError};
use mechanics::output::Column;
use mechanics::plausibility::{Plausibility, PlausibilityFinding};
use mechanics::system::{
    ContactState, Contacts, ElementEvaluation, Energies, InputError, JacobianVectorProduct, MotionChange,
    Observation, StateDirection, System,
};
use quantity::Number;
use thiserror::Error;
use wedge::inputs::{COIL, CoilInput, Neighbours, Reading};
use wedge::outputs::{Ledger, Outputs};
use wedge::{BOLSTER, BuildError, COLUMN, Parameters, SIDE_FRAME, SLOPE, Wedge};

/// Reasons why a driven wedge cannot begin, go on or go back.
#[derive(Debug, Error)]
pub enum SteppingError {
    /// The parameters make no wedge.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The integrator refuses the state.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The integrator cannot go on.
    #[error("{0}; go back to a saved state, or begin anew with smaller steps of the neighbours")]
    Step(String),
    /// The system cannot be driven.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A step that is no step.
    #[error(
        "a step of {} s from time {} s is none: it must be positive, finite, and not lost against the time",
        Number(*step),
        Number(*time)
    )]
    NoStep {
        /// The step, s.
        step: f64,
        /// The time from which it was to be made, s.
        time: f64,
    },
    /// A value that is not finite, or outside its range.
    #[error("{what} is {value}; it must be {expected}")]
    Value {
        /// The name of the value.
        what: String,
        /// The value, SI.
        value: f64,
        /// The condition on it.
        expected: &'static str,
    },
    /// A list of states that does not have the right length.
    #[error("{found} states are given; this wedge has {expected}")]
    Length {
        /// Their number.
        expected: usize,
        /// The number given.
        found: usize,
    },
    /// A communication step hardly progresses ([`crate::progress`]).
    #[error(
        "the step of {step} s from time {time} s cannot be finished: {why}; make it shorter, or look for \
         places or rates of the neighbours that are far out"
    )]
    TooLong {
        /// The step, s.
        step: f64,
        /// The time at which it began, s.
        time: f64,
        /// The progress and its place.
        why: String,
    },
    /// Neighbours move far in one step.
    #[error(
        "in one step the bolster moves by {} m in {coordinate} against the side frame; at most {} m are \
         taken for a motion of a truck: give places in m or with their unit, or go there in several steps",
        Number(*path),
        super::LARGEST_PATH
    )]
    TooFar {
        /// The coordinate.
        coordinate: &'static str,
        /// The path, m.
        path: f64,
    },
    /// An earlier step failed.
    #[error("an earlier step failed; go back to a saved state, or begin anew")]
    Failed,
    /// A saved state that cannot be read.
    #[error("this is no saved state of a driven wedge: {0}")]
    State(String),
    /// A saved state of another version.
    #[error("the saved state has version {found}; this program reads version {expected}")]
    Version {
        /// The version found.
        found: u32,
        /// The version expected.
        expected: u32,
    },
    /// A saved state of a wedge with other parameters.
    #[error("the saved state belongs to a wedge with other parameters")]
    OtherCase,
}

/// A wedge between driven neighbours at one instant: time, states, places of the neighbours, coil.
pub struct Equations {
    wedge: Wedge,
    /// The parameters with the motions of the case.
    parameters: Parameters,
    start: Neighbours,
    start_coil: CoilInput,
    start_energy: f64,
    outputs: Outputs,
    time: f64,
    x: Vec<f64>,
    contacts: Contacts,
    neighbours: Neighbours,
    coil: CoilInput,
    friction: [f64; 2],
    plausibility: Plausibility,
    /// Evaluation of all elements here, if it is known already.
    evaluation: ElementEvaluation<f64>,
    evaluated: bool,
}

impl fmt::Debug for Equations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Equations")
            .field("time", &self.time)
            .field("x", &self.x)
            .field("modes", &self.contacts.states)
            .field("neighbours", &self.neighbours)
            .finish_non_exhaustive()
    }
}

impl Equations {
    /// Returns the wedge at its start, time zero, its neighbours being at `start`.
    ///
    /// # Errors
    /// The parameters make no wedge, or places or coil are not finite.
    pub fn new(parameters: &Parameters, start: &Neighbours, coil: CoilInput) -> Result<Self, SteppingError> {
        check_neighbours(start)?;
        check_coil(&coil)?;
        let mut wedge_parameters = parameters.with_inputs(start);
        wedge_parameters.coil.law = coil.law(parameters);
        let mut wedge = Wedge::new(wedge_parameters)?;
        let x = wedge.initial_state.clone();
        let start_energy = wedge.system.observe(0.0, &x).energies.total();
        let contacts = Contacts::new(&mut wedge.system, 0.0, &x);
        let plausibility = Plausibility::new(&mut wedge.system, 0.0, &x);
        Ok(Self {
            outputs: Outputs::new(&wedge.parameters),
            friction: [
                parameters.column_friction.coefficient,
                parameters.slope_friction.coefficient,
            ],
            parameters: parameters.clone(),
            start: *start,
            start_coil: coil,
            start_energy,
            time: 0.0,
            contacts,
            x,
            neighbours: *start,
            coil,
            wedge,
            plausibility,
            evaluation: ElementEvaluation::default(),
            evaluated: false,
        })
    }

    /// Returns the parameters, with the motions of the case.
    #[must_use]
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
    /// Returns the system, as it is built for this wedge.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.wedge.system
    }
    /// Returns the places of the neighbors at time zero.
    #[must_use]
    pub fn start(&self) -> &Neighbours {
        &self.start
    }
    /// Returns the source of the coil's force at time zero.
    #[must_use]
    pub fn start_coil(&self) -> CoilInput {
        self.start_coil
    }
    /// Stored energy at the start, J.
    #[must_use]
    pub fn start_energy(&self) -> f64 {
        self.start_energy
    }
    /// Time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
    /// Returns the states (SI): free coordinates, their rates, bristles, work and losses.
    #[must_use]
    pub fn states(&self) -> &[f64] {
        &self.x
    }
    /// Contact states of the corners (see [`ContactState`]), in the order of [`wedge::outputs::FACES`] and
    /// [`wedge::outputs::CORNERS`].
    #[must_use]
    pub fn contact_states(&self) -> &[u8] {
        &self.contacts.states
    }
    /// Returns the places of the neighbors.
    #[must_use]
    pub fn neighbours(&self) -> &Neighbours {
        &self.neighbours
    }
    /// Returns the source of the coil's force.
    #[must_use]
    pub fn coil(&self) -> &CoilInput {
        &self.coil
    }
    /// Returns the coefficients of friction of column and slope.
    #[must_use]
    pub fn friction(&self) -> [f64; 2] {
        self.friction
    }

    /// Returns what has been implausible so far, at the start, at the instants at which it was called, and
    /// here.
    pub fn findings(&mut self) -> Vec<PlausibilityFinding> {
        self.plausibility.note(&mut self.wedge.system, self.time, &self.x);
        self.plausibility.present(&self.wedge.system)
    }

    /// Sets time (s) and states.
    ///
    /// # Errors
    /// A wrong number of states, or values that are not finite.
    pub fn set_states(&mut self, time: f64, x: &[f64]) -> Result<(), SteppingError> {
        if x.len() != self.x.len() {
            return Err(SteppingError::Length {
                expected: self.x.len(),
                found: x.len(),
            });
        }
        finite("time", time)?;
        for (number, value) in x.iter().enumerate() {
            if !value.is_finite() {
                finite(&format!("state {number} (counted from 0)"), *value)?;
            }
        }
        self.x.copy_from_slice(x);
        if time != self.time {
            self.time = time;
            self.neighbours.set_at(&mut self.wedge.system, time)?;
        }
        self.evaluated = false;
        Ok(())
    }

    /// Puts the neighbours somewhere.
    ///
    /// # Errors
    /// Values that are not finite.
    pub fn set_neighbours(&mut self, neighbours: &Neighbours) -> Result<(), SteppingError> {
        check_neighbours(neighbours)?;
        self.neighbours = *neighbours;
        self.neighbours.set_at(&mut self.wedge.system, self.time)?;
        self.evaluated = false;
        Ok(())
    }

    /// Sets the source of the coil's force.
    ///
    /// # Errors
    /// Values that are not finite, or a negative stiffness.
    pub fn set_coil(&mut self, coil: CoilInput) -> Result<(), SteppingError> {
        check_coil(&coil)?;
        self.wedge.system.set_coil_law(COIL, coil.law(&self.parameters))?;
        self.coil = coil;
        self.evaluated = false;
        Ok(())
    }

    /// Sets the coefficients of friction of column and slope.
    ///
    /// # Errors
    /// Values that are not finite, or negative.
    pub fn set_friction(&mut self, friction: [f64; 2]) -> Result<(), SteppingError> {
        check_friction(friction)?;
        for (face, coefficient) in [COLUMN, SLOPE].into_iter().zip(friction) {
            self.wedge.system.set_friction(face, coefficient)?;
        }
        self.friction = friction;
        self.evaluated = false;
        Ok(())
    }

    /// Sets the contact states.
    ///
    /// # Errors
    /// Not one for each corner, or one that is none.
    pub fn set_contact_states(&mut self, contact_states: &[u8]) -> Result<(), SteppingError> {
        if contact_states.len() != self.contacts.states.len() {
            return Err(SteppingError::Length {
                expected: self.contacts.states.len(),
                found: contact_states.len(),
            });
        }
        check_contact_states(contact_states)?;
        self.contacts.states.copy_from_slice(contact_states);
        Ok(())
    }

    /// Takes over what an integrator has reached.
    pub(super) fn follow(
        &mut self,
        time: f64,
        x: &[f64],
        contact_states: &[u8],
        at: &Neighbours,
    ) -> Result<(), SteppingError> {
        self.time = time;
        self.x.copy_from_slice(x);
        self.contacts.states.copy_from_slice(contact_states);
        self.neighbours = *at;
        // Straight through the place that was given: whoever begins here from a saved state sees the same.
        self.neighbours.set_at(&mut self.wedge.system, time)?;
        self.evaluated = false;
        Ok(())
    }

    /// Writes the rates of the states, SI.
    ///
    /// # Errors
    /// `out` does not have the length of the states.
    pub fn rates(&mut self, out: &mut [f64]) -> Result<(), SteppingError> {
        if out.len() != self.x.len() {
            return Err(SteppingError::Length {
                expected: self.x.len(),
                found: out.len(),
            });
        }
        self.wedge.system.derivative(self.time, &self.x, out);
        Ok(())
    }

    /// For each corner a margin that is positive while its contact state lasts, and not positive when it must
    /// change.
    pub fn margins(&mut self) -> &[f64] {
        self.contacts.evaluate(&mut self.wedge.system, self.time, &self.x)
    }

    /// Brings the contact states up to date; whether any has changed.
    pub fn update_modes(&mut self) -> bool {
        self.contacts.update(&mut self.wedge.system, self.time, &self.x)
    }

    /// Returns the evaluation of all elements.
    pub fn evaluation(&mut self) -> &ElementEvaluation<f64> {
        if !self.evaluated {
            self.wedge
                .system
                .evaluate_elements(self.time, &self.x, &mut self.evaluation);
            self.evaluated = true;
        }
        &self.evaluation
    }

    /// Returns the wrenches of the wedge on its neighbors, and the forces of coil and faces.
    ///
    /// # Errors
    /// Never, with a wedge that [`Equations::new`] has built.
    pub fn reading(&mut self) -> Result<Reading<f64>, SteppingError> {
        self.evaluation();
        Reading::of(&self.evaluation, &self.wedge.system, &self.wedge.parameters).ok_or(SteppingError::Failed)
    }

    /// Derivatives along a direction: changes of the states (empty: none), of the neighbours, and of the
    /// coil's spring force at its present length (N).
    ///
    /// # Errors
    /// A wrong number of states.
    pub fn jacobian_vector_product(
        &mut self,
        states: &[f64],
        neighbours: &Neighbours,
        coil_force: f64,
    ) -> Result<JacobianVectorProduct, SteppingError> {
        let change = |body, place: &wedge::inputs::NeighbourState| MotionChange {
            body,
            position: place.position,
            rate: place.rate,
        };
        let motions = [
            change(SIDE_FRAME, &neighbours.side_frame),
            change(BOLSTER, &neighbours.bolster),
        ];
        let direction = StateDirection {
            state: states,
            motions: &motions,
            coil_forces: &[coil_force],
        };
        let expected = self.x.len();
        self.wedge
            .system
            .jacobian_vector_product(self.time, &self.x, &direction)
            .ok_or(SteppingError::Length {
                expected,
                found: states.len(),
            })
    }

    /// Everything that the state says.
    #[must_use]
    pub fn observe(&mut self) -> Observation {
        self.wedge.system.observe(self.time, &self.x)
    }

    /// Stored energies and the ledger since the start, J. Work of a coil from outside is in its residual.
    #[must_use]
    pub fn energies(&mut self) -> (Energies, Ledger) {
        let seen = self.observe();
        (
            seen.energies,
            Outputs::ledger(&self.wedge.system, &seen, self.start_energy),
        )
    }

    /// Returns the columns of a run's table.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.outputs.columns()
    }

    /// Returns the values of all columns, SI: a row of the table that a run writes.
    #[must_use]
    pub fn row(&mut self) -> Vec<f64> {
        let seen = self.observe();
        let mut row = Vec::with_capacity(self.outputs.columns().len());
        self.outputs.values(
            &self.wedge.system,
            &seen,
            &self.contacts.states,
            self.start_energy,
            &mut row,
        );
        row
    }

    /// Contact state of a corner (0 to 7), by name.
    #[must_use]
    pub fn mode_name(&self, corner: usize) -> &'static str {
        ContactState::from_number(self.contacts.states.get(corner).copied().unwrap_or(0)).name()
    }
}

fn finite(what: &str, value: f64) -> Result<(), SteppingError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(SteppingError::Value {
        what: what.to_owned(),
        value,
        expected: "finite",
    })
}

/// Checks whether all coordinates and rates are finite.
pub(super) fn check_neighbours(neighbours: &Neighbours) -> Result<(), SteppingError> {
    for (name, place) in [
        ("side frame", &neighbours.side_frame),
        ("bolster", &neighbours.bolster),
    ] {
        for (what, values) in [("", &place.position), ("rate of ", &place.rate)] {
            for (coordinate, value) in mechanics::body::COORDINATES.into_iter().zip(values) {
                if !value.is_finite() {
                    finite(&format!("the {what}{coordinate} of the {name}"), *value)?;
                }
            }
        }
    }
    Ok(())
}

/// Checks whether a coil's value is usable.
pub(super) fn check_coil(coil: &CoilInput) -> Result<(), SteppingError> {
    match coil {
        CoilInput::Stiffness(value) if !coil.is_valid() => Err(SteppingError::Value {
            what: "the coil's stiffness".to_owned(),
            value: *value,
            expected: "zero or positive, and finite",
        }),
        CoilInput::Force(value) => finite("the coil's force", *value),
        _ => Ok(()),
    }
}

/// Checks whether numbers are those of contact states.
pub(super) fn check_contact_states(contact_states: &[u8]) -> Result<(), SteppingError> {
    let none = contact_states
        .iter()
        .enumerate()
        .find(|(_, contact_state)| **contact_state > ContactState::Slip as u8);
    none.map_or(Ok(()), |(corner, contact_state)| {
        Err(SteppingError::Value {
            what: format!("the contact state of corner {corner} (counted from 0)"),
            value: f64::from(*contact_state),
            expected: "0 (open), 1 (stick) or 2 (slip)",
        })
    })
}

/// Checks whether coefficients of friction of column and slope are usable.
pub(super) fn check_friction(friction: [f64; 2]) -> Result<(), SteppingError> {
    for (name, value) in ["friction.column", "friction.slope"].into_iter().zip(friction) {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(SteppingError::Value {
                what: name.to_owned(),
                value,
                expected: "zero or positive, and finite",
            });
        }
    }
    Ok(())
}
