//! Resultants of the forces on the wedge and of the reactions on its neighbors.

use mechanics::system::{BodyState, CoilLoad, FaceLoad, Observation, System, SystemLoads};
use mechanics::vector::Vector;

use crate::assemble::{COLUMN, SLOPE, WEDGE};
use crate::parameters::Damping;

/// Resultants of the contact forces and of the coil at one instant, fixed axes, SI.
#[derive(Clone, Copy, Debug)]
pub struct Resultants {
    /// Normal forces of the column along x, N: the column `longitudinal_wedge_force`.
    pub longitudinal: f64,
    /// Column friction as it acts on the side frame, positive up, N: `vertical_wedge_force`.
    pub vertical: f64,
    /// The same less the spring force of a coil on the side frame, N: `vertical_force_on_side_frame`.
    pub vertical_on_side_frame: f64,
    /// Moments of the contact forces of each face on the wedge, about its center of gravity, N·m.
    pub moments: [Vector<f64>; 2],
    /// Net force and moment on the side frame, about the center of its column, N and N·m.
    pub on_side_frame: (Vector<f64>, Vector<f64>),
    /// Net force and moment on the bolster, about the center of its pocket, N and N·m.
    pub on_bolster: (Vector<f64>, Vector<f64>),
}

impl Resultants {
    /// Returns the resultants of [`System::loads`].
    #[must_use]
    pub fn of(damping: Damping, loads: &SystemLoads) -> Self {
        let faces = [COLUMN, SLOPE].map(|face| loads.faces[face]);
        Self::new(damping, &loads.bodies[WEDGE], faces, &loads.coils[0])
    }

    /// Returns the resultants of [`System::observe`].
    #[must_use]
    pub fn of_observation(damping: Damping, observation: &Observation) -> Self {
        let wedge = &observation.bodies[WEDGE];
        let faces = [COLUMN, SLOPE].map(|face| observation.faces[face].load(wedge.center_of_gravity));
        Self::new(damping, wedge, faces, &observation.coils[0].load())
    }

    fn new(damping: Damping, wedge: &BodyState, faces: [FaceLoad; 2], coil: &CoilLoad) -> Self {
        let vertical = -faces[COLUMN].friction.0[2];
        // The neighbor that the coil stands on.
        let (on_frame, seat) = match damping {
            Damping::Variable => (coil.spring.0[2], COLUMN),
            Damping::Constant => (0.0, SLOPE),
        };
        let [on_side_frame, on_bolster] = [COLUMN, SLOPE].map(|index| {
            let face = &faces[index];
            let about = |force, moment, from| System::reaction_about(force, moment, from, face.origin);
            let (force, moment) = about(face.normal + face.friction, face.moment, wedge.center_of_gravity);
            if index != seat {
                return (force, moment);
            }
            let (coil_force, coil_moment) = about(coil.force, coil.moment, wedge.origin);
            (force + coil_force, moment + coil_moment)
        });
        Self {
            longitudinal: faces[COLUMN].normal.0[0],
            vertical,
            vertical_on_side_frame: vertical - on_frame,
            moments: faces.map(|face| face.moment),
            on_side_frame,
            on_bolster,
        }
    }
}
