//! Inputs of a system, which a caller may change between two steps: prescribed motions, coils, friction,
//! loads.
//!
//! A change makes the right-hand side discontinuous: the caller must call
//! [`integrate::Integrator::reevaluate`].

use thiserror::Error;

use super::System;
use crate::coil::CoilLaw;
use crate::motion::Motion;

/// Why an input is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InputError {
    /// There is no such body, coil or face.
    #[error("there is no {what} {number}; there are {count} (counted from 0)")]
    NoSuch {
        /// The kind of object.
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
    /// The body was built with a frame that stands still or only translates, or has free coordinates.
    #[error(
        "{body} takes no other motions: it must be prescribed, and built with motions that can all move and rotate it"
    )]
    NotPrescribed {
        /// Its name.
        body: String,
    },
}

impl System {
    /// Replaces the motions of a prescribed body that was built with motions which can all move and turn it,
    /// such as [`Motion::line`]. States stay what they are; no memory is allocated for polynomials.
    ///
    /// # Errors
    /// There is no such body, or it was not built with prescribed motions.
    pub fn set_motions(&mut self, body: usize, motions: [Motion; 6]) -> Result<(), InputError> {
        let count = self.bodies.len();
        let Some(moved) = self.bodies.get_mut(body) else {
            return Err(InputError::NoSuch {
                what: "body",
                number: body,
                count,
            });
        };
        let frame = &self.frames[body];
        if frame.fixed || frame.keeps_orientation || self.free_number[body].is_some() {
            return Err(InputError::NotPrescribed {
                body: moved.name.clone(),
            });
        }
        moved.frame.motions = motions;
        self.invalidate_kinematics();
        Ok(())
    }

    /// Sets a force (N) and a moment (N·m, about the center of gravity) on a body with linearized kinematics,
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
