//! Poses of the bodies of a car on its track, for pictures of it, beyond [`crate::Loads`].
//!
//! Each is given in the axes of the track (forward, left, up) at the foot of a place on the center line:
//! the body at its center of gravity, a truck at that of its bolster. Displacements are those of centers of
//! gravity from the nominal layout.

use mechanics::system::Observation;
use mechanics::vector::{Matrix, Vector};
use rolling::wheelset::coordinate;
use truck::TruckFrame;
use wheelrail::track::TrackSection;

use crate::assemble::Car;
use crate::body::angles;

/// The body with its lading; of one that twists the mean of its halves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyMotion {
    /// Displacement forward, left, up (m), and roll, pitch, yaw (rad).
    pub coordinates: [f64; 6],
    /// Offsets to the left and up of the middle between the feet of both bolsters from the center line where
    /// the body is, m: that of the chord in a curve.
    pub chord: [f64; 2],
}

/// A truck.
#[derive(Clone, Debug, PartialEq)]
pub struct TruckMotion {
    /// Distance along the track of its bolster, m.
    pub distance: f64,
    /// Its parts.
    pub parts: truck::Motions,
}

/// The axes of a wheelset that do not spin, in the track's own axes (those of [`Car::lines`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelsetAxes {
    /// Its center, m.
    pub center: Vector<f64>,
    /// The axle, to the left.
    pub axle: Vector<f64>,
    /// The section of the track there.
    pub section: TrackSection<f64>,
    /// Angle of the spin, rad.
    pub spin: f64,
}

/// All of it, SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Motions {
    /// The body.
    pub body: BodyMotion,
    /// The trucks, front and rear.
    pub trucks: [TruckMotion; 2],
}

impl Car {
    /// Returns the poses of the bodies at an observation of [`Car::system`].
    #[must_use]
    pub fn motions(&self, seen: &Observation) -> Motions {
        let body = self.body_pose(seen);
        let frame = self.frame_at(body.place);
        let in_frame =
            |place: Vector<f64>| -> Vector<f64> { frame.axes.apply_transposed(place - frame.origin) };
        let [_, left, up] = in_frame(body.place).0;
        let turned: Matrix<f64> = frame.axes.transpose().times(body.rotation);
        let [roll, pitch, yaw] = angles(&turned);
        let [_, aside, height] = self.carried.center;
        let mut chord = Vector::zero();
        let trucks = [0, 1].map(|t| {
            let bolster = &seen.bodies[self.numbers.bolsters[t]];
            let own: TruckFrame = self.frame_at(bolster.center_of_gravity);
            chord += in_frame(own.origin).scale::<f64, f64>(0.5);
            TruckMotion {
                distance: self.section(bolster.center_of_gravity).distance,
                parts: self.trucks[t].motions(seen, &own),
            }
        });
        Motions {
            body: BodyMotion {
                coordinates: [0.0, left - aside, up - height, roll, pitch, yaw],
                chord: [chord.0[1], chord.0[2]],
            },
            trucks,
        }
    }

    /// Returns the displacement of a rail (of a wheelset from the front; left 0, right 1) at an observation
    /// of [`Car::system`], in the track's own axes, m.
    #[must_use]
    pub fn rail(&self, seen: &Observation, wheelset: usize, side: usize) -> Vector<f64> {
        self.own(seen.bodies[self.numbers.under(wheelset, side)].origin)
    }

    /// Returns the axes of a wheelset (0 to 3 from the front) at an observation of [`Car::system`].
    #[must_use]
    pub fn wheelset_axes(&self, seen: &Observation, wheelset: usize) -> WheelsetAxes {
        let state = &seen.bodies[self.numbers.wheelsets[wheelset]];
        WheelsetAxes {
            center: self.own(state.origin),
            axle: self.own(state.rotation.column(0)),
            section: self.section(state.origin),
            spin: state.coordinates[coordinate::SPIN],
        }
    }
}
