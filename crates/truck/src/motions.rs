//! Poses of the parts of a truck, and forces of its wedges' faces, for pictures of it, beyond
//! [`crate::Loads`].

use mechanics::system::{ContactState, FaceState, Observation};
use mechanics::vector::Vector;

use crate::assemble::{BOLSTER, SIDE_FRAMES};
use crate::elements::WedgePlace;
use crate::mounted::{MountedTruck, TruckFrame, TruckView};

/// The force of a face on its wedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceForce {
    /// Sum of the normal forces, N.
    pub normal: f64,
    /// Sum of the friction forces, axes of the truck, N.
    pub friction: [f64; 3],
    /// It slips where one of its points does, else sticks where one does.
    pub state: ContactState,
}

/// Parts of a truck, SI: displacements of centers of gravity from their nominal places and roll, pitch, yaw,
/// in the axes of the truck.
#[derive(Clone, Debug, PartialEq)]
pub struct Motions {
    /// The bolster.
    pub bolster: [f64; 6],
    /// The side frames, left and right.
    pub side_frames: [[f64; 6]; 2],
    /// Column and slope of each wedge or half of one, in the order of
    /// [`Parameters::wedge_parts`](crate::Parameters::wedge_parts).
    pub faces: Vec<[FaceForce; 2]>,
}

impl MountedTruck {
    /// Returns the poses of the parts at an observation of the system in which the truck is, in the axes of a
    /// frame.
    #[must_use]
    pub fn motions(&self, seen: &Observation, frame: &TruckFrame) -> Motions {
        let view = TruckView::new(self, seen, Some(*frame));
        let part = |number: usize| {
            let moved = view.place(view.body(number).center_of_gravity) - self.part_places[number - BOLSTER];
            let ([x, y, z], [roll, pitch, yaw]) = (moved.0, view.angles(number));
            [x, y, z, roll, pitch, yaw]
        };
        Motions {
            bolster: part(BOLSTER),
            side_frames: [part(SIDE_FRAMES), part(SIDE_FRAMES + 1)],
            faces: self.faces(&view),
        }
    }

    fn faces(&self, view: &TruckView<'_>) -> Vec<[FaceForce; 2]> {
        let pair = |column: usize| [column, column + 1].map(|face| of_face(&view.seen.faces[face], view));
        let whole = (0..).zip(&self.added.wedges).map(|(number, place)| match *place {
            // Of a split wedge column and slope of the outboard half, then those of the inboard one.
            WedgePlace::Body { column } | WedgePlace::Split { column } => pair(column),
            WedgePlace::Massless { connection } => self.massless(number, connection, view),
        });
        let inboard = self.added.wedges.iter().filter_map(|place| match *place {
            WedgePlace::Split { column } => Some(pair(column + 2)),
            _ => None,
        });
        whole.chain(inboard).collect()
    }

    /// Returns the faces of a wedge without mass.
    fn massless(&self, number: usize, connection: usize, view: &TruckView<'_>) -> [FaceForce; 2] {
        let connection = &view.seen.connections[connection];
        let inside = connection.wedge.unwrap_or_default();
        let state = connection.contact_state.unwrap_or(ContactState::Open);
        let state_of = |normal: f64| if normal > 0.0 { state } else { ContactState::Open };
        let ahead = if number < 2 { 1.0 } else { -1.0 };
        // The column's friction lies along the column, the slope's along the slope.
        let (toe_sine, toe_cosine) = libm::sincos(ahead * self.toes[number]);
        let (sine, cosine) = libm::sincos(self.angles[number]);
        let (up, along) = (inside.column_friction, inside.slope_friction);
        [
            FaceForce {
                normal: inside.column_normal,
                friction: [-up * toe_sine, -inside.lateral_friction, up * toe_cosine],
                state: state_of(inside.column_normal),
            },
            FaceForce {
                normal: inside.slope_normal,
                friction: [ahead * along * sine, 0.0, along * cosine],
                state: state_of(inside.slope_normal),
            },
        ]
    }
}

fn of_face(face: &FaceState, view: &TruckView<'_>) -> FaceForce {
    let sum = |sum: Vector<f64>, force: &Vector<f64>| sum + *force;
    let friction = face.friction_forces.iter().fold(Vector::zero(), sum);
    FaceForce {
        normal: face.points.iter().map(|point| point.normal).sum(),
        friction: view.vector(friction).0,
        state: face.contact_state(),
    }
}
