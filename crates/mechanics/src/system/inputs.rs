//! Inputs of a system, which a caller may change between two steps: prescribed motions, coils, friction,
//! loads.
//!
//! A change makes the right-hand side discontinuous: the caller must call
//! [`integrate::Integrator::reevaluate`].

use thiserror::Error;

use super::System;
use crate::coil::CoilLaw;
use crate::motion::Motion;

/// Reasons why an input is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum InputError {
    /// There is no such body, coil or face.
    #[error("there is no {what} {number}; there are {count} (counted from 0)")]
    NoSuch {
        /// The kind of object.
        what: &'static str,
        /// Its number.
        number: usize,
        /// Their number.
        count: usize,
    },
    /// A load is given to a body without free coordinates.
    #[error("{body} takes no load: none of its coordinates is free")]
    NotFree {
        /// Its name.
        body: String,
    },
    /// The body was built with motions that do not move, or has free coordinates.
    #[error(
        "{body} cannot be driven: it must be prescribed, and its motions must be able to move from the \
         start on (all of them, unless its kinematics are linearized)"
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
    /// There is no such body, or it was not built with prescribed motions.
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
        let moves = match prescribed.linearized && frame.fixed {
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

    /// Sets loads on the coordinates of a body, constant until the next call: a force along the axes of its
    /// reference frame at its origin (N), and moments about the axes of its angles (N·m). Their work is no
    /// term of the energy ledger: with constant loads it is the load times the displacement. Loads over time
    /// with their work are [`crate::system::AppliedLoad`].
    ///
    /// # Errors
    /// There is no such body, or it has no free coordinates.
    pub fn set_load(&mut self, body: usize, load: [f64; 6]) -> Result<(), InputError> {
        let count = self.bodies.len();
        let Some(own) = self.bodies.get(body) else {
            return Err(InputError::NoSuch {
                what: "body",
                number: body,
                count,
            });
        };
        let Some(number) = self.free_number[body] else {
            let body = own.name.clone();
            return Err(InputError::NotFree { body });
        };
        self.free[number].loaded = true;
        self.given[body] = load;
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

    /// Replaces the factor of the wrench of an element that was built with one
    /// ([`crate::element::Placement::over_time`]), constant until the next call.
    ///
    /// # Errors
    /// There is no such element, or it has no factor.
    pub fn set_factor(&mut self, element: usize, value: f64) -> Result<(), InputError> {
        let count = self.elements.len();
        let found = self.factors.iter_mut().find(|(own, _)| *own == element);
        let Some((_, factor)) = found else {
            return Err(InputError::NoSuch {
                what: "element with a factor",
                number: element,
                count,
            });
        };
        *factor = Motion::Constant(value);
        self.elements[element].element.factor = [value, 0.0];
        self.invalidate_kinematics();
        Ok(())
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
