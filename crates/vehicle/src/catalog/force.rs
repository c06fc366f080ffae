//! Forces over time on a body.
//!
//! A force along the fixed axes at a place of a body acts on its coordinates as the force at the body's
//! origin and the moment `r × F` with the arm of the nominal layout, about the axes of its angles. Units: N,
//! m. Limits: the arm does not turn with the body; what falls on a held coordinate is carried by what holds
//! it. The other end has nothing of it: such a force comes from outside.

use mechanics::motion::Motion;
use mechanics::orientation::fixed;
use mechanics::system::AppliedLoad;
use mechanics::vector::Vector;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A force along a fixed direction over time, on end A.
#[derive(Clone, Debug, PartialEq)]
pub struct AppliedForce {
    /// Its direction, of length 1.
    pub direction: [f64; 3],
    /// Its value over time, N.
    pub course: Motion,
}

impl CatalogElement for AppliedForce {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let (body, at) = place.ends[0];
        let own = &place.model.bodies[body];
        if own.is_prescribed() {
            return Err(format!(
                "{} has a prescribed motion, so that a force on it has no effect; free its coordinates",
                own.name
            ));
        }
        let arm: [f64; 3] = std::array::from_fn(|k| at[k] - own.frame.origin[k]);
        let [x, y, z] = self.direction;
        let moment = [
            arm[1] * z - arm[2] * y,
            arm[2] * x - arm[0] * z,
            arm[0] * y - arm[1] * x,
        ];
        let free = own.free;
        // Coordinates are those of its reference frame, which is turned on a track.
        let axes = fixed(own.frame.orientation);
        let [force, moment] = [[x, y, z], moment].map(|own| {
            let turned: Vector<f64> = axes.apply_transposed(Vector(own));
            turned.0
        });
        for (coordinate, factor) in force.into_iter().chain(moment).enumerate() {
            if factor != 0.0 && free[coordinate] {
                place.model.loads.push(AppliedLoad {
                    body,
                    coordinate,
                    course: self.course.scaled(factor),
                });
            }
        }
        Ok(())
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}
