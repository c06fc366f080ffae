//! Reference frames: where a body's coordinates are measured from. A frame may move in a prescribed way.

use numerics::scalar::Real;
use serde::{Deserialize, Serialize};

use crate::motion::{Jet, Motion};
use crate::orientation::Orientation;
use crate::vector::{Matrix, Vector};

/// A reference frame: a base pose in the fixed frame, and motions along and about the base's axes.
///
/// A body without free coordinates in a moving frame is a prescribed body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Origin at zero motion, in the fixed frame, m.
    pub origin: [f64; 3],
    /// Orientation at zero motion: roll, pitch, yaw, rad (see [`Orientation`]).
    pub orientation: [f64; 3],
    /// Motions of x, y, z (m), roll, pitch, yaw (rad), along and about the base's axes.
    pub motions: [Motion; 6],
}

/// Pose, velocity and acceleration of a frame, in axes of the fixed frame (SI).
#[derive(Clone, Copy, Debug)]
pub struct FrameMotion<S> {
    /// Position of the origin.
    pub position: Vector<S>,
    /// From frame axes to fixed axes.
    pub rotation: Matrix<S>,
    /// Velocity of the origin.
    pub velocity: Vector<S>,
    /// Angular velocity.
    pub angular_velocity: Vector<S>,
    /// Acceleration of the origin.
    pub acceleration: Vector<S>,
    /// Angular acceleration.
    pub angular_acceleration: Vector<S>,
}

impl Frame {
    /// Returns a frame at rest.
    #[must_use]
    pub fn fixed(origin: [f64; 3], orientation: [f64; 3]) -> Self {
        Self {
            origin,
            orientation,
            motions: std::array::from_fn(|_| Motion::Constant(0.0)),
        }
    }

    /// Returns whether the frame never moves.
    #[must_use]
    pub fn is_fixed(&self) -> bool {
        self.motions.iter().all(Motion::is_constant)
    }

    /// Returns whether the frame never turns.
    #[must_use]
    pub fn keeps_orientation(&self) -> bool {
        self.motions[3..].iter().all(Motion::is_constant)
    }

    /// Returns the first time after `time` at which a motion is not smooth.
    #[must_use]
    pub fn next_break(&self, time: f64) -> Option<f64> {
        self.motions
            .iter()
            .filter_map(|motion| motion.next_break(time))
            .min_by(f64::total_cmp)
    }

    /// Returns the frame's motion at `time`, on the smooth piece that holds `reference`.
    #[must_use]
    pub fn evaluate<S: Real>(&self, time: S, reference: f64) -> FrameMotion<S> {
        self.moved(&std::array::from_fn(|k| {
            self.motions[k].evaluate(time, reference)
        }))
    }

    /// Returns the frame where its six motions have these values, rates and second derivatives.
    #[must_use]
    pub fn moved<S: Real>(&self, jets: &[Jet<S>; 6]) -> FrameMotion<S> {
        let base: Matrix<S> = Matrix::lift(crate::orientation::fixed(self.orientation));
        let translation = |order: usize| Vector([jets[0][order], jets[1][order], jets[2][order]]);
        let angles = |order: usize| [jets[3][order], jets[4][order], jets[5][order]];
        let orientation = Orientation::new(angles(0), true);
        let rotation: Matrix<S> = base.times(orientation.rotation);
        FrameMotion {
            position: Vector::<S>::lift(Vector(self.origin)) + base.apply::<S, S>(translation(0)),
            rotation,
            velocity: base.apply(translation(1)),
            angular_velocity: rotation.apply(orientation.spin(angles(1), true)),
            acceleration: base.apply(translation(2)),
            angular_acceleration: rotation.apply(orientation.spin_rate(angles(1), angles(2), true)),
        }
    }
}
