//! An upper bound of the spectral radius of the Jacobian matrix, by which the integrator detects stiffness.
//!
//! With b the mobility of a point (how much a force there accelerates it), the springs' part of the
//! eigenvalues is at most `√(Σ k (1 + μ) b)`, since friction feeds the normal force's stiffness into the
//! tangents; that of dampers at most `Σ c b`, where friction counts as the steepest damper of its law,
//! `μN/max(|v|, v0)`. Sums over all points: an upper bound, some times too large.

use numerics::scalar::Dual;

use super::System;
use crate::body::Body;
use crate::friction::FrictionLaw;
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// From here on (1/s) no step that is worth making is explicit; explicit steps of no length would only hide
/// that a run cannot go on.
const LARGEST_RADIUS: f64 = 1e9;

/// Returns a bound of the mobility of a point of a body (body axes), 1/kg: `1/m + |r|²/I` with the least
/// inertia of the free angles.
pub(super) fn mobility(body: &Body, point: Vector<f64>) -> f64 {
    let arm = point - Vector(body.center_of_gravity);
    let least = (0..3)
        .filter(|k| body.free[3 + k])
        .map(|k| body.inertia[k])
        .fold(f64::INFINITY, f64::min);
    1.0 / body.mass + arm.dot::<f64, f64>(arm) / least
}

impl System {
    /// Returns the bound at the state of the last [`System::update_kinematics`], 1/s. Returns infinity if it
    /// is unknown.
    pub(super) fn spectral_radius(&mut self) -> f64 {
        self.update_points();
        let (mut springs, mut dampers) = (0.0, 0.0);
        for face in &self.faces {
            let element = &face.element;
            let slowest = match element.law {
                FrictionLaw::Tanh { reference_speed } => reference_speed,
                FrictionLaw::Bristle { .. } => return f64::INFINITY,
            };
            let friction = element.coefficient;
            face.points.motions(|i, gap, [a, b]| {
                if gap < 0.0 {
                    let (point, mobility) = (&element.points[i], face.mobilities[i]);
                    let slip = (a * a + b * b).sqrt();
                    let drag = friction * point.stiffness * -gap / slip.max(slowest);
                    springs += point.stiffness * (1.0 + friction) * mobility;
                    dampers += (drag + point.damping * (1.0 + friction)) * mobility;
                }
            });
        }
        for coil in &self.coils {
            let relative: RelativeMotion<f64> = coil.relative_frame.relative(&self.kinematics[coil.body]);
            let (element, mobility) = (&coil.element, coil.mobilities[0]);
            let length = element.on_body(&relative).length;
            let [slope] = element.spring(Dual::<1>::variable(length, 0)).derivative;
            springs += slope.abs() * mobility;
            dampers += element.damping * mobility;
        }
        let bound = dampers + springs.sqrt();
        if bound < LARGEST_RADIUS {
            bound
        } else {
            f64::INFINITY
        }
    }
}
