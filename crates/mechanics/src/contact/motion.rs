//! The motion of a body with the points of a face relative to the surface that they touch, for four points at
//! a time.

use numerics::lanes::Lanes;

use super::blocks::PointBlock;
use super::{PointForce, PointKinematics};
use crate::body::Kinematics;
use crate::link::{RelativeFrame, RelativeMotion};
use crate::surface::Bend;
use crate::vector::{Matrix, Vector};

/// The motion that gives four points their contact kinematics, and the body the wrench of their forces.
pub(crate) trait FaceMotion {
    /// Returns the contact kinematics of four points, and writes the local geometry of a curved surface
    /// there.
    fn kinematics(&self, block: &PointBlock, bend: Option<&mut Bend<Lanes>>) -> PointKinematics<Lanes>;
    /// Returns the wrench on the body: forces along the marker's axes, moments (body axes), losses in
    /// friction and in contact damping.
    fn push(&self, block: &PointBlock, bend: Option<&Bend<Lanes>>, forces: &PointForce<Lanes>) -> [Lanes; 8];
}

/// A plane and its motion in the axes of the body: gap, gap rate and slip are linear in the coordinates of
/// points. As a [`super::CurvedMotion`] a wedge takes 18 % more instructions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneMotion {
    distance: f64,
    normal: Vector<f64>,
    speeds: [f64; 3],
    /// Gradients of the velocity components with the position.
    growth: [Vector<f64>; 3],
    /// From body axes to marker axes.
    rotation: Matrix<f64>,
    /// See [`super::Interface::first_arm`].
    first_arm: f64,
}

impl PlaneMotion {
    /// Returns the plane's motion if marker B does not rotate: `v_i = c_i + (e_i × ω)·r` with ω in body axes.
    /// With [`PlaneMotion::new`] instead a wedge takes 1 to 3 % more instructions (such shares:
    /// decision 0077).
    #[inline(always)]
    pub fn of(relative_frame: &RelativeFrame<f64>, body: &Kinematics<f64>, first_arm: f64) -> Self {
        let rotation: Matrix<f64> = relative_frame.rotation.times(body.orientation.rotation);
        let position: Vector<f64> = relative_frame.rotation.apply(body.position);
        let velocity: Vector<f64> = relative_frame.rotation.apply(body.velocity);
        let [n, t1, t2] = rotation.0.map(Vector);
        let mut speeds = relative_frame.velocity + velocity;
        if first_arm != 0.0 {
            speeds.0[1] += first_arm * t2.dot::<f64, f64>(body.spin);
        }
        Self {
            distance: relative_frame.position.0[0] + position.0[0],
            normal: n,
            speeds: speeds.0,
            growth: [n.cross(body.spin), t1.cross(body.spin), t2.cross(body.spin)],
            rotation,
            first_arm,
        }
    }

    /// Returns distance and normal alone, as in [`PlaneMotion::of`], for [`super::Points::update_if_open`].
    #[inline(always)]
    pub fn distance_and_normal(
        relative_frame: &RelativeFrame<f64>,
        body: &Kinematics<f64>,
    ) -> (f64, Vector<f64>) {
        let normal = Vector(relative_frame.rotation.0[0]);
        (
            relative_frame.position.0[0] + normal.dot::<f64, f64>(body.position),
            body.orientation.rotation.apply_transposed(normal),
        )
    }

    /// Returns the plane's motion if marker B may rotate.
    #[inline(always)]
    pub fn new(relative: &RelativeMotion<f64>, first_arm: f64) -> Self {
        let Matrix([n, t1, t2]) = relative.rotation;
        let [w0, w1, w2] = relative.angular_velocity.0;
        let mix = |a: f64, x: [f64; 3], b: f64, y: [f64; 3]| {
            Vector([a * x[0] - b * y[0], a * x[1] - b * y[1], a * x[2] - b * y[2]])
        };
        let [x, y, z] = relative.velocity.0;
        Self {
            first_arm,
            distance: relative.position.0[0],
            normal: Vector(n),
            speeds: [x, y + first_arm * w2, z],
            growth: [mix(w1, t2, w2, t1), mix(w2, n, w0, t2), mix(w0, t1, w1, n)],
            rotation: relative.rotation,
        }
    }
}

impl FaceMotion for PlaneMotion {
    #[inline(always)]
    fn kinematics(&self, block: &PointBlock, _: Option<&mut Bend<Lanes>>) -> PointKinematics<Lanes> {
        let position = block.position;
        let speed = |i: usize| -> Lanes { self.growth[i].dot::<Lanes, Lanes>(position) + self.speeds[i] };
        PointKinematics {
            gap: self.normal.dot::<Lanes, Lanes>(position) + self.distance,
            gap_rate: speed(0),
            slip: [speed(1), speed(2)],
        }
    }

    #[inline(always)]
    fn push(&self, block: &PointBlock, _: Option<&Bend<Lanes>>, forces: &PointForce<Lanes>) -> [Lanes; 8] {
        let position = block.position;
        let [t1, t2] = forces.friction.force;
        let force = Vector([forces.normal, t1, t2]);
        let own: Vector<Lanes> = self.rotation.transpose().apply(force);
        let mut moment: Vector<Lanes> = position.cross(own);
        if self.first_arm != 0.0 {
            for (sum, axis) in moment.0.iter_mut().zip(self.rotation.0[2]) {
                *sum += t1 * (self.first_arm * axis);
            }
        }
        let ([f1, f2, f3], [m1, m2, m3]) = (force.0, moment.0);
        [f1, f2, f3, m1, m2, m3, forces.friction.loss, forces.damping_loss]
    }
}
