//! Inputs and outputs of a wedge whose neighbors a caller moves: their motions, and the loads on them.
//!
//! Coordinates of a neighbor are those of [`NeighbourMotion`]: x, y, z of its turning center from the nominal
//! position along fixed axes (m), roll, pitch, yaw (rad; see [`mechanics::orientation`]), and their rates.
//! Force and moment on a neighbor are given along fixed axes, the moment about the neighbor's turning center
//! where that is at the time: so, with small angles, force and moment times the rates are the power that the
//! neighbor takes up.

use mechanics::coil::CoilLaw;
use mechanics::motion::Motion;
use mechanics::system::{ElementEvaluation, InputError, Load, System};
use numerics::scalar::Real;
use serde::{Deserialize, Serialize};

use crate::assemble::{BOLSTER, COLUMN, SIDE_FRAME};
use crate::parameters::{NeighbourMotion, Parameters};

/// The number of the control coil among the coils.
pub const COIL: usize = 0;

/// Displacements and rates of a neighbor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NeighbourState {
    /// x, y, z (m), roll, pitch, yaw (rad).
    pub position: [f64; 6],
    /// Their rates (m/s, rad/s).
    pub rate: [f64; 6],
}

/// Both neighbors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Neighbours {
    /// The side frame.
    pub side_frame: NeighbourState,
    /// The bolster.
    pub bolster: NeighbourState,
}

/// The source of the coil's spring force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoilInput {
    /// From the parameters.
    #[default]
    Internal,
    /// A stiffness (N/m), by which the compression is multiplied; a caller finds it from the compression.
    Stiffness(f64),
    /// A force (N), positive when it pushes.
    Force(f64),
}

impl NeighbourState {
    /// Returns displacements and rates of a prescribed motion at a time (s).
    #[must_use]
    pub fn of(motion: &NeighbourMotion, time: f64) -> Self {
        let mut place = Self::default();
        for (k, motion) in motion.coordinates.iter().enumerate() {
            // The piece that begins at this time.
            let reference = match motion.next_break(time) {
                Some(end) => 0.5 * (time + end),
                None => time + 1.0,
            };
            let [value, rate, _] = motion.evaluate(time, reference);
            (place.position[k], place.rate[k]) = (value, rate);
        }
        place
    }

    /// Returns the state after `duration` (s) if only displacements are known: rates are the mean rates.
    #[must_use]
    pub fn reached(&self, position: [f64; 6], duration: f64) -> Self {
        Self {
            position,
            rate: std::array::from_fn(|k| (position[k] - self.position[k]) / duration),
        }
    }

    /// Returns whether all values are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.position
            .iter()
            .chain(&self.rate)
            .all(|value| value.is_finite())
    }

    /// Returns the motions at constant rates through this state at a time (s).
    #[must_use]
    pub fn lines(&self, time: f64) -> [Motion; 6] {
        std::array::from_fn(|k| Motion::line(time, [self.position[k], self.rate[k]]))
    }

    /// Returns the cubic motions from this state at `start` (s) to another one `duration` (s) later.
    #[must_use]
    pub fn cubics(&self, start: f64, duration: f64, end: &Self) -> [Motion; 6] {
        std::array::from_fn(|k| {
            let from = [self.position[k], self.rate[k]];
            Motion::between(start, duration, from, [end.position[k], end.rate[k]])
        })
    }
}

impl Neighbours {
    /// Returns the states of both neighbors under the prescribed motions of these parameters at a time (s).
    #[must_use]
    pub fn of(parameters: &Parameters, time: f64) -> Self {
        Self {
            side_frame: NeighbourState::of(&parameters.side_frame, time),
            bolster: NeighbourState::of(&parameters.bolster, time),
        }
    }

    /// Returns whether all values are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.side_frame.is_finite() && self.bolster.is_finite()
    }

    /// Returns the states after `duration` (s) if only displacements are known, see
    /// [`NeighbourState::reached`].
    #[must_use]
    pub fn reached(&self, side_frame: [f64; 6], bolster: [f64; 6], duration: f64) -> Self {
        Self {
            side_frame: self.side_frame.reached(side_frame, duration),
            bolster: self.bolster.reached(bolster, duration),
        }
    }

    /// Sets the motions of both neighbors: from here at a time (s), at constant rates.
    ///
    /// # Errors
    /// The system is no wedge with prescribed neighbors.
    pub fn set_at(&self, system: &mut System, time: f64) -> Result<(), InputError> {
        system.set_motions(SIDE_FRAME, self.side_frame.lines(time))?;
        system.set_motions(BOLSTER, self.bolster.lines(time))
    }

    /// Sets the motions of both neighbors: cubics from here to another state within `duration` (s).
    ///
    /// # Errors
    /// The system is no wedge with prescribed neighbors.
    pub fn set_between(
        &self,
        system: &mut System,
        start: f64,
        duration: f64,
        end: &Self,
    ) -> Result<(), InputError> {
        system.set_motions(
            SIDE_FRAME,
            self.side_frame.cubics(start, duration, &end.side_frame),
        )?;
        system.set_motions(BOLSTER, self.bolster.cubics(start, duration, &end.bolster))
    }
}

impl CoilInput {
    /// Returns whether its value is valid.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        match self {
            Self::Internal => true,
            Self::Stiffness(stiffness) => *stiffness >= 0.0 && stiffness.is_finite(),
            Self::Force(force) => force.is_finite(),
        }
    }

    /// Returns the law of the coil under it.
    #[must_use]
    pub fn law(&self, parameters: &Parameters) -> CoilLaw {
        match self {
            Self::Internal => parameters.coil.law.clone(),
            Self::Stiffness(stiffness) => CoilLaw::Linear {
                stiffness: *stiffness,
            },
            Self::Force(force) => CoilLaw::Given { force: *force },
        }
    }
}

impl Parameters {
    /// Returns the same wedge with neighbors that a caller moves, starting from these states.
    #[must_use]
    pub fn with_inputs(&self, start: &Neighbours) -> Self {
        let mut wedge = self.clone();
        wedge.side_frame.coordinates = start.side_frame.lines(0.0);
        wedge.bolster.coordinates = start.bolster.lines(0.0);
        wedge
    }
}

/// Loads on the neighbors, and forces of coil and faces.
#[derive(Clone, Copy, Debug)]
pub struct Reading<S> {
    /// Force and moment on the side frame, about its turning center.
    pub on_side_frame: Load<S>,
    /// Force and moment on the bolster, about its turning center.
    pub on_bolster: Load<S>,
    /// Compression of the coil: free length less length, m.
    pub coil_compression: S,
    /// Spring force of the coil, N: positive when it pushes.
    pub coil_force: S,
    /// Sum of the normal forces of column and slope, N.
    pub normal_forces: [S; 2],
    /// Power lost in friction at column and slope, W.
    pub friction_losses: [S; 2],
}

impl<S: Real> Reading<S> {
    /// Returns the reading of an element evaluation; `None` if it is not that of a wedge.
    #[must_use]
    pub fn of(evaluation: &ElementEvaluation<S>, system: &System, parameters: &Parameters) -> Option<Self> {
        let coil = evaluation.coils.get(COIL)?;
        let mut normal_forces = [S::zero(); 2];
        let mut friction_losses = [S::zero(); 2];
        let mut first = 0;
        for (index, face) in system.faces().iter().take(2).enumerate() {
            let count = face.element.points.len();
            for point in evaluation.points.get(first..first + count)? {
                normal_forces[index] += point.normal;
            }
            if let Some(loss) = face.energy_terms[0] {
                friction_losses[index] = *evaluation.powers.get(loss)?;
            }
            first += count;
        }
        debug_assert_eq!(COLUMN, 0);
        Some(Self {
            on_side_frame: *evaluation.loads.get(SIDE_FRAME)?,
            on_bolster: *evaluation.loads.get(BOLSTER)?,
            coil_compression: -coil.length + parameters.coil.free_length,
            coil_force: coil.spring,
            normal_forces,
            friction_losses,
        })
    }
}
