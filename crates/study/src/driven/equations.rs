//! The equations of a driven wedge at one instant: for solvers that bring their own integration, and for reading results.

use std::fmt;

use integrate::{EventGroup, Problem, SetupError};
use mechanics::output::Column;
use mechanics::system::{
    Along, Direction, DriveChange, DriveError, Energies, Mode, Observation, Sense, System,
};
use thiserror::Error;
use wedge::driven::{COIL, CoilDrive, Neighbours, Reading};
use wedge::outputs::{Ledger, Outputs};
use wedge::{BOLSTER, BuildError, COLUMN, Parameters, SIDE_FRAME, SLOPE, Wedge};

/// Why a driven wedge cannot begin, go on or go back.
#[derive(Debug, Error)]
pub enum DrivenError {
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
    Drive(#[from] DriveError),
    /// A step that is no step.
    #[error(
        "a step of {step} s from time {time} s is none: it must be positive, finite, and not lost against the time"
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
        /// What the value is.
        what: String,
        /// The value, SI.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// A list of states that does not have the right length.
    #[error("{found} states are given; this wedge has {expected}")]
    Length {
        /// How many there are.
        expected: usize,
        /// How many were given.
        found: usize,
    },
    /// A communication step hardly progresses ([`crate::progress`]).
    #[error(
        "the step of {step} s from time {time} s cannot be finished: {why}; make it shorter, or look for places or rates of the \
         neighbours that are far out"
    )]
    TooLong {
        /// The step, s.
        step: f64,
        /// The time at which it began, s.
        time: f64,
        /// How little it progresses, and where.
        why: String,
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
    start_coil: CoilDrive,
    start_energy: f64,
    outputs: Outputs,
    time: f64,
    x: Vec<f64>,
    modes: Vec<u8>,
    groups: Vec<EventGroup>,
    signs: Vec<f64>,
    margins: Vec<f64>,
    neighbours: Neighbours,
    coil: CoilDrive,
    friction: [f64; 2],
    /// What elements feel here, if it is known already.
    sense: Sense<f64>,
    sensed: bool,
}

impl fmt::Debug for Equations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Equations")
            .field("time", &self.time)
            .field("x", &self.x)
            .field("modes", &self.modes)
            .field("neighbours", &self.neighbours)
            .finish_non_exhaustive()
    }
}

impl Equations {
    /// The wedge at its start, time zero, its neighbours being at `start`.
    ///
    /// # Errors
    /// The parameters make no wedge, or places or coil are not finite.
    pub fn new(parameters: &Parameters, start: &Neighbours, coil: CoilDrive) -> Result<Self, DrivenError> {
        check_neighbours(start)?;
        check_coil(&coil)?;
        let mut driven = parameters.driven(start);
        driven.coil.law = coil.law(parameters);
        let mut wedge = Wedge::new(driven)?;
        let x = wedge.initial_state.clone();
        let start_energy = wedge.system.observe(0.0, &x).energies.total();
        let mut modes = vec![0; wedge.system.point_count()];
        wedge.system.initial_discrete_states(0.0, &x, &mut modes);
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
            groups: wedge.system.event_groups(),
            signs: vec![0.0; wedge.system.event_variable_count()],
            margins: vec![0.0; modes.len()],
            modes,
            x,
            neighbours: *start,
            coil,
            wedge,
            sense: Sense::default(),
            sensed: false,
        })
    }

    /// The parameters, with the motions of the case.
    #[must_use]
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
    /// The system, as it is built for this wedge.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.wedge.system
    }
    /// Where the neighbours were at time zero.
    #[must_use]
    pub fn start(&self) -> &Neighbours {
        &self.start
    }
    /// Where the coil's force came from at time zero.
    #[must_use]
    pub fn start_coil(&self) -> CoilDrive {
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
    /// The states (SI): free coordinates, their rates, bristles, work and losses.
    #[must_use]
    pub fn states(&self) -> &[f64] {
        &self.x
    }
    /// Contact states of the corners (see [`Mode`]), in the order of [`wedge::outputs::FACES`] and
    /// [`wedge::outputs::CORNERS`].
    #[must_use]
    pub fn modes(&self) -> &[u8] {
        &self.modes
    }
    /// Where the neighbours are.
    #[must_use]
    pub fn neighbours(&self) -> &Neighbours {
        &self.neighbours
    }
    /// Where the coil's force comes from.
    #[must_use]
    pub fn coil(&self) -> &CoilDrive {
        &self.coil
    }
    /// The coefficients of friction of column and slope.
    #[must_use]
    pub fn friction(&self) -> [f64; 2] {
        self.friction
    }

    /// Sets time (s) and states.
    ///
    /// # Errors
    /// A wrong number of states, or values that are not finite.
    pub fn set_states(&mut self, time: f64, x: &[f64]) -> Result<(), DrivenError> {
        if x.len() != self.x.len() {
            return Err(DrivenError::Length {
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
            self.neighbours.put(&mut self.wedge.system, time)?;
        }
        self.sensed = false;
        Ok(())
    }

    /// Puts the neighbours somewhere.
    ///
    /// # Errors
    /// Values that are not finite.
    pub fn set_neighbours(&mut self, neighbours: &Neighbours) -> Result<(), DrivenError> {
        check_neighbours(neighbours)?;
        self.neighbours = *neighbours;
        self.neighbours.put(&mut self.wedge.system, self.time)?;
        self.sensed = false;
        Ok(())
    }

    /// Says where the coil's force comes from.
    ///
    /// # Errors
    /// Values that are not finite, or a negative stiffness.
    pub fn set_coil(&mut self, coil: CoilDrive) -> Result<(), DrivenError> {
        check_coil(&coil)?;
        self.wedge.system.set_coil_law(COIL, coil.law(&self.parameters))?;
        self.coil = coil;
        self.sensed = false;
        Ok(())
    }

    /// Sets the coefficients of friction of column and slope.
    ///
    /// # Errors
    /// Values that are not finite, or negative.
    pub fn set_friction(&mut self, friction: [f64; 2]) -> Result<(), DrivenError> {
        check_friction(friction)?;
        for (face, coefficient) in [COLUMN, SLOPE].into_iter().zip(friction) {
            self.wedge.system.set_friction(face, coefficient)?;
        }
        self.friction = friction;
        self.sensed = false;
        Ok(())
    }

    /// Sets the contact states.
    ///
    /// # Errors
    /// Not one for each corner, or one that is none.
    pub fn set_modes(&mut self, modes: &[u8]) -> Result<(), DrivenError> {
        if modes.len() != self.modes.len() {
            return Err(DrivenError::Length {
                expected: self.modes.len(),
                found: modes.len(),
            });
        }
        check_modes(modes)?;
        self.modes.copy_from_slice(modes);
        Ok(())
    }

    /// Takes over what an integrator has reached.
    pub(super) fn follow(
        &mut self,
        time: f64,
        x: &[f64],
        modes: &[u8],
        at: &Neighbours,
    ) -> Result<(), DrivenError> {
        self.time = time;
        self.x.copy_from_slice(x);
        self.modes.copy_from_slice(modes);
        self.neighbours = *at;
        // Straight through the place that was given: whoever begins here from a saved state sees the same.
        self.neighbours.put(&mut self.wedge.system, time)?;
        self.sensed = false;
        Ok(())
    }

    /// The rates of the states, SI.
    ///
    /// # Errors
    /// `out` does not have the length of the states.
    pub fn rates(&mut self, out: &mut [f64]) -> Result<(), DrivenError> {
        if out.len() != self.x.len() {
            return Err(DrivenError::Length {
                expected: self.x.len(),
                found: out.len(),
            });
        }
        self.wedge.system.derivative(self.time, &self.x, out);
        Ok(())
    }

    /// For each corner a margin that is positive while its contact state lasts, and not positive when it must change.
    pub fn margins(&mut self) -> &[f64] {
        let system = &mut self.wedge.system;
        system.event_variables(self.time, &self.x, &mut self.signs);
        for number in 0..self.groups.len() {
            self.weigh(number);
        }
        &self.margins
    }

    /// Brings the margins of a group up to date with its signs and contact states.
    fn weigh(&mut self, number: usize) {
        let group = &self.groups[number];
        let (own, signs) = (
            group.discrete_states.clone(),
            &self.signs[group.variables.clone()],
        );
        let (modes, margins) = (&self.modes[own.clone()], &mut self.margins[own]);
        self.wedge
            .system
            .group_event_functions(number, signs, modes, margins);
    }

    /// Brings the contact states up to date; whether any has changed.
    pub fn update_modes(&mut self) -> bool {
        let mut changed = false;
        self.margins();
        for number in 0..self.groups.len() {
            let own = self.groups[number].discrete_states.clone();
            for corner in own.clone() {
                // A change may lead straight to the next one, open to stick to slip.
                for _ in 0..3 {
                    if self.margins[corner] > 0.0 {
                        break;
                    }
                    let signs = &self.signs[self.groups[number].variables.clone()];
                    let mode = self.modes[corner];
                    let index = corner - own.start;
                    let next = self.wedge.system.next_discrete_state(number, signs, index, mode);
                    if next == mode {
                        break;
                    }
                    self.modes[corner] = next;
                    self.weigh(number);
                    changed = true;
                }
            }
        }
        changed
    }

    /// What elements feel.
    pub fn sense(&mut self) -> &Sense<f64> {
        if !self.sensed {
            self.wedge.system.sense(self.time, &self.x, &mut self.sense);
            self.sensed = true;
        }
        &self.sense
    }

    /// What the wedge does to its neighbours, and what coil and faces feel.
    ///
    /// # Errors
    /// Never, with a wedge that [`Equations::new`] has built.
    pub fn reading(&mut self) -> Result<Reading<f64>, DrivenError> {
        self.sense();
        Reading::of(&self.sense, &self.wedge.system, &self.wedge.parameters).ok_or(DrivenError::Failed)
    }

    /// Derivatives along a direction: changes of the states (empty: none), of the neighbours, and of the coil's spring force at its
    /// present length (N).
    ///
    /// # Errors
    /// A wrong number of states.
    pub fn along(
        &mut self,
        states: &[f64],
        neighbours: &Neighbours,
        coil_force: f64,
    ) -> Result<Along, DrivenError> {
        let change = |body, place: &wedge::driven::Place| DriveChange {
            body,
            position: place.position,
            rate: place.rate,
        };
        let drives = [
            change(SIDE_FRAME, &neighbours.side_frame),
            change(BOLSTER, &neighbours.bolster),
        ];
        let direction = Direction {
            state: states,
            drives: &drives,
            coil_forces: &[coil_force],
        };
        let expected = self.x.len();
        self.wedge
            .system
            .along(self.time, &self.x, &direction)
            .ok_or(DrivenError::Length {
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

    /// The columns of a run's table.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.outputs.columns()
    }

    /// The values of all columns, SI: a row of the table that a run writes.
    #[must_use]
    pub fn row(&mut self) -> Vec<f64> {
        let seen = self.observe();
        let mut row = Vec::with_capacity(self.outputs.columns().len());
        self.outputs.values(
            &self.wedge.system,
            &seen,
            &self.modes,
            self.start_energy,
            &mut row,
        );
        row
    }

    /// Contact state of a corner (0 to 7), by name.
    #[must_use]
    pub fn mode_name(&self, corner: usize) -> &'static str {
        Mode::from_number(self.modes.get(corner).copied().unwrap_or(0)).name()
    }
}

fn finite(what: &str, value: f64) -> Result<(), DrivenError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(DrivenError::Value {
        what: what.to_owned(),
        value,
        expected: "finite",
    })
}

/// Whether all coordinates and rates are finite.
pub(super) fn check_neighbours(neighbours: &Neighbours) -> Result<(), DrivenError> {
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

/// Whether a coil's value is usable.
pub(super) fn check_coil(coil: &CoilDrive) -> Result<(), DrivenError> {
    match coil {
        CoilDrive::Stiffness(value) if !coil.is_valid() => Err(DrivenError::Value {
            what: "the coil's stiffness".to_owned(),
            value: *value,
            expected: "zero or positive, and finite",
        }),
        CoilDrive::Force(value) => finite("the coil's force", *value),
        _ => Ok(()),
    }
}

/// Whether numbers are those of contact states.
pub(super) fn check_modes(modes: &[u8]) -> Result<(), DrivenError> {
    let none = modes
        .iter()
        .enumerate()
        .find(|(_, mode)| **mode > Mode::Slip as u8);
    none.map_or(Ok(()), |(corner, mode)| {
        Err(DrivenError::Value {
            what: format!("the contact state of corner {corner} (counted from 0)"),
            value: f64::from(*mode),
            expected: "0 (open), 1 (stick) or 2 (slip)",
        })
    })
}

/// Whether coefficients of friction of column and slope are usable.
pub(super) fn check_friction(friction: [f64; 2]) -> Result<(), DrivenError> {
    for (name, value) in ["friction.column", "friction.slope"].into_iter().zip(friction) {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(DrivenError::Value {
                what: name.to_owned(),
                value,
                expected: "zero or positive, and finite",
            });
        }
    }
    Ok(())
}
