//! What a caller may change in a system between two steps: motions of prescribed bodies, coils, friction.
//!
//! After a change the right-hand side is another one: [`integrate::Integrator::reevaluate`] tells the
//! integrator so.

use thiserror::Error;

use super::System;
use crate::coil::CoilLaw;
use crate::motion::Motion;

/// Why a system cannot be driven so.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InputError {
    /// There is no such body, coil or face.
    #[error("there is no {what} {number}; there are {count} (counted from 0)")]
    NoSuch {
        /// What was asked for.
        what: &'static str,
        /// Its number.
        number: usize,
        /// How many there are.
        count: usize,
    },
    /// A load is given to a body whose kinematics are not linearized.
    #[error("{body} takes no given load: its kinematics are not linearized")]
    NotLinearized {
        /// Its name.
        body: String,
    },
    /// The body was built with motions that do not move, or has free coordinates.
    #[error(
        "{body} cannot be driven: it must be prescribed, and its motions must be able to move from the start on (all of \
         them, where its kinematics are not linearized)"
    )]
    NotPrescribed {
        /// Its name.
        body: String,
    },
}

impl System {
    /// Replaces the motions of a prescribed body that was built with motions which can move, such as
    /// [`Motion::line`]: at least one of a body with linearized kinematics; of another body one that moves
    /// and one that turns it. States stay what they are; no memory is allocated for polynomials. The work of
    /// the motions stays in the energy ledger.
    ///
    /// # Errors
    /// There is no such body, or it was not built to be driven.
    pub fn set_motions(&mut self, body: usize, motions: [Motion; 6]) -> Result<(), InputError> {
        let count = self.bodies.len();
        let Some(prescribed) = self.bodies.get_mut(body) else {
            return Err(InputError::NoSuch {
                what: "body",
                number: body,
                count,
            });
        };
        let frame = &self.frames[body];
        let moved = self.moved.iter_mut().find(|moved| moved.body == body);
        let moves = match prescribed.linearized {
            true => moved.is_some(),
            false => !frame.fixed && !frame.keeps_orientation && self.free_number[body].is_none(),
        };
        if !moves {
            return Err(InputError::NotPrescribed {
                body: prescribed.name.clone(),
            });
        }
        if let Some(moved) = moved {
            moved.motions.clone_from_slice(&motions);
        }
        prescribed.frame.motions = motions;
        self.invalidate_kinematics();
        Ok(())
    }

    /// Sets a force (N) and a moment (N·m, about the centre of gravity) on a body with linearized kinematics,
    /// constant until the next call. Their work is no term of the energy ledger: with constant loads it is
    /// the load times the displacement.
    ///
    /// # Errors
    /// There is no such body, or its kinematics are not linearized.
    pub fn set_load(&mut self, body: usize, load: [f64; 6]) -> Result<(), InputError> {
        let count = self.bodies.len();
        match self.bodies.get(body) {
            Some(own) if own.linearized => self.given[body] = load,
            Some(own) => {
                let body = own.name.clone();
                return Err(InputError::NotLinearized { body });
            }
            None => {
                return Err(InputError::NoSuch {
                    what: "body",
                    number: body,
                    count,
                });
            }
        }
        Ok(())
    }

    /// Replaces the law of a coil.
    ///
    /// # Errors
    /// There is no such coil.
    pub fn set_coil_law(&mut self, coil: usize, law: CoilLaw) -> Result<(), InputError> {
        let count = self.coils.len();
        match self.coils.get_mut(coil) {
            Some(mounted) => {
                mounted.element.law = law;
                Ok(())
            }
            None => Err(InputError::NoSuch {
                what: "coil",
                number: coil,
                count,
            }),
        }
    }

    /// Replaces the coefficient of friction of a face.
    ///
    /// # Errors
    /// There is no such face.
    pub fn set_friction(&mut self, face: usize, coefficient: f64) -> Result<(), InputError> {
        let count = self.faces.len();
        match self.faces.get_mut(face) {
            Some(mounted) => {
                mounted.element.coefficient = coefficient;
                Ok(())
            }
            None => Err(InputError::NoSuch {
                what: "face",
                number: face,
                count,
            }),
        }
    }
}
