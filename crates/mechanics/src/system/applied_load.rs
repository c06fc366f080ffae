//! Loads over time on free coordinates, in place of prescribed motions.

use super::FreeBody;
use super::model::ModelError;
use crate::body::{Body, COORDINATES};
use crate::motion::Motion;
use crate::parts::Parts;

/// A load over time on a free coordinate of a body: a force along x, y or z of its reference frame at the
/// body's origin, or a moment about the axis of an angle. Its work counts as that of the motions.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedLoad {
    /// The body's number.
    pub body: usize,
    /// The coordinate, 0 to 5: x, y, z, roll, pitch, yaw.
    pub coordinate: usize,
    /// N or N·m over time.
    pub course: Motion,
}

/// An applied load in a system.
#[derive(Clone, Debug)]
pub(super) struct MountedLoad {
    pub applied: AppliedLoad,
    /// The number of its coordinate among the speeds.
    pub speed: usize,
    /// Its value with rate and second derivative.
    pub jet: [f64; 3],
    /// The row of the work by the body's states.
    pub row: usize,
}

impl AppliedLoad {
    /// Returns the load in its place.
    pub(super) fn mount(
        self,
        bodies: &[Body],
        free: &mut [FreeBody],
        free_number: &[Option<usize>],
        parts: &mut Parts,
    ) -> Result<MountedLoad, ModelError> {
        let Self { body, coordinate, .. } = self;
        let Some(own) = bodies.get(body) else {
            let count = bodies.len();
            return Err(ModelError::NoSuchBody { number: body, count });
        };
        let place = free_number[body].and_then(|number| {
            let slot = free[number].free.iter().position(|k| *k == coordinate)?;
            Some((number, slot))
        });
        let Some((number, slot)) = place else {
            return Err(ModelError::HeldUnderLoad {
                body: own.name.clone(),
                coordinate: COORDINATES
                    .get(coordinate)
                    .copied()
                    .unwrap_or("a seventh coordinate"),
            });
        };
        free[number].loaded = true;
        parts.quadrature_bodies.push((0, number));
        Ok(MountedLoad {
            speed: free[number].offset + slot,
            jet: self.course.evaluate(0.0, 0.0),
            row: parts.quadrature_bodies.len() - 1,
            applied: self,
        })
    }
}
