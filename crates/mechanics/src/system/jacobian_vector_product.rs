//! Jacobian-vector products: derivatives of the rates and of the element evaluation along a direction of
//! states, prescribed motions and coil forces. They come from the functions that compute the values, with
//! dual numbers of one derivative.

use integrate::Problem;
use nalgebra::{DMatrix, DVector};
use numerics::scalar::Dual;

use super::System;
use super::evaluation::{ElementEvaluation, EvaluationInputs};
use crate::body::Kinematics;
use crate::frame::FrameMotion;
use crate::motion::Jet;
use crate::vector::Vector;

/// A change of a body's prescribed motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionChange {
    /// The body's number.
    pub body: usize,
    /// Changes of x, y, z (m), roll, pitch, yaw (rad).
    pub position: [f64; 6],
    /// Changes of their rates.
    pub rate: [f64; 6],
}

/// A direction.
#[derive(Clone, Copy, Debug, Default)]
pub struct StateDirection<'d> {
    /// Changes of the states; empty: none of them changes.
    pub state: &'d [f64],
    /// Changes of prescribed motions.
    pub motions: &'d [MotionChange],
    /// Changes of the spring force of each coil at its present length, N; empty: none.
    pub coil_forces: &'d [f64],
}

/// Derivatives along a direction.
#[derive(Clone, Debug, Default)]
pub struct JacobianVectorProduct {
    /// Of the rates of all states.
    pub rates: Vec<f64>,
    /// Element evaluation: values and derivatives.
    pub evaluation: ElementEvaluation<Dual<1>>,
}

fn dual(value: f64, change: f64) -> Dual<1> {
    Dual {
        value,
        derivative: [change],
    }
}

impl System {
    /// Returns the derivatives along a direction at `time` and state `x`; `None` if the direction does not
    /// have the state's length, or if there are bodies with linearized kinematics, carriers or connections,
    /// which are not supported.
    ///
    /// At a discontinuity of the derivative (a corner that just touches, a bristle at its limit) they are
    /// one-sided, on the side to which the state is assigned.
    pub fn jacobian_vector_product(
        &mut self,
        time: f64,
        x: &[f64],
        direction: &StateDirection<'_>,
    ) -> Option<JacobianVectorProduct> {
        let n = x.len();
        let linearized = self.free.iter().any(|free| free.linear.is_some());
        let carried = self.free.iter().any(|free| free.carrier.is_some());
        let supported = !linearized && !carried && self.connections.is_empty();
        if !supported || n != self.layout.len() || !(direction.state.is_empty() || direction.state.len() == n)
        {
            return None;
        }
        let mut dx = vec![0.0; n];
        self.derivative(time, x, &mut dx);
        let no_change = vec![0.0; n];
        let change = if direction.state.is_empty() {
            &no_change[..]
        } else {
            direction.state
        };

        let frames: Vec<FrameMotion<Dual<1>>> = (0..self.bodies.len())
            .map(|body| self.frame_derivative(body, time, direction))
            .collect();
        let kinematics: Vec<Kinematics<Dual<1>>> = (0..self.bodies.len())
            .map(|body| self.kinematics_derivative(body, x, change))
            .collect();
        let [_, speed_change, internal_change, _] = self.layout.split(change);
        let [_, _, internal, _] = self.layout.split(x);
        let internal: Vec<Dual<1>> = internal
            .iter()
            .zip(internal_change)
            .map(|(value, change)| dual(*value, *change))
            .collect();
        let mut evaluation = ElementEvaluation::default();
        let inputs = EvaluationInputs {
            frames: &|body| frames[body],
            kinematics: &kinematics,
            internal: &internal,
            coil_change: &|coil| dual(0.0, direction.coil_forces.get(coil).copied().unwrap_or(0.0)),
        };
        self.evaluate_elements_at(&inputs, &mut evaluation);

        let mut rates = vec![0.0; n];
        let [d_positions, d_speeds, d_internal, d_quadratures] = self.layout.split_mut(&mut rates);
        d_positions.copy_from_slice(speed_change);
        for (target, rate) in d_internal.iter_mut().zip(&evaluation.internal_rates) {
            *target = rate.derivative[0];
        }
        for (target, power) in d_quadratures.iter_mut().zip(&evaluation.powers) {
            *target = power.derivative[0];
        }
        for number in 0..self.free.len() {
            self.acceleration_derivatives(number, &dx, &frames, &kinematics, &evaluation, d_speeds);
        }
        Some(JacobianVectorProduct { rates, evaluation })
    }

    fn frame_derivative(
        &self,
        body: usize,
        time: f64,
        direction: &StateDirection<'_>,
    ) -> FrameMotion<Dual<1>> {
        let frame = &self.bodies[body].frame;
        let mut jets: [Jet<Dual<1>>; 6] =
            std::array::from_fn(|k| frame.motions[k].evaluate(time, self.reference).map(Dual::from));
        for motion in direction.motions.iter().filter(|motion| motion.body == body) {
            for (k, jet) in jets.iter_mut().enumerate() {
                jet[0].derivative[0] += motion.position[k];
                jet[1].derivative[0] += motion.rate[k];
            }
        }
        frame.moved(&jets)
    }

    fn kinematics_derivative(&self, body: usize, x: &[f64], change: &[f64]) -> Kinematics<Dual<1>> {
        let mut coordinates = self.bodies[body].initial.map(Dual::from);
        let mut speeds = [Dual::from(0.0); 6];
        if let Some(number) = self.free_number[body] {
            let free = &self.free[number];
            for (j, &k) in free.free.iter().enumerate() {
                let (q, u) = (free.offset + j, self.layout.speeds + free.offset + j);
                coordinates[k] = dual(x[q], change[q]);
                speeds[k] = dual(x[u], change[u]);
            }
        }
        Kinematics::new(coordinates, speeds, self.bodies[body].rolls())
    }

    /// `M δu˙ = δ(Q - b - M u˙)` at fixed u˙.
    fn acceleration_derivatives(
        &self,
        number: usize,
        dx: &[f64],
        frames: &[FrameMotion<Dual<1>>],
        kinematics: &[Kinematics<Dual<1>>],
        evaluation: &ElementEvaluation<Dual<1>>,
        d_speeds: &mut [f64],
    ) {
        let free = &self.free[number];
        let (body, kinematics) = (&self.bodies[free.body], &kinematics[free.body]);
        let frame = &frames[free.body];
        let mut accelerations = [0.0; 6];
        for (j, &k) in free.free.iter().enumerate() {
            accelerations[k] = dx[self.layout.speeds + free.offset + j];
        }
        let (force, moment) = kinematics.inertia(
            &free.rigid,
            frame,
            !self.frames[free.body].fixed,
            self.gravity,
            &accelerations,
        );
        let load = &evaluation.loads[free.body];
        let force = frame.rotation.apply_transposed::<Dual<1>, Dual<1>>(load.force) - force;
        let carried: Vector<Dual<1>> = frame.rotation.apply_transposed(load.moment);
        let moment = kinematics
            .orientation
            .rotation
            .apply_transposed::<Dual<1>, Dual<1>>(carried)
            - moment;
        let n = free.free.len();
        let mut mass = vec![0.0; n * n];
        self.kinematics[free.body].mass_matrix(body, &free.free, &mut mass);
        let residual = free
            .free
            .iter()
            .map(|&k| kinematics.generalized(k, &force, &moment).derivative[0]);
        let right = DVector::from_iterator(n, residual);
        let solved = DMatrix::from_row_slice(n, n, &mass)
            .cholesky()
            .map(|m| m.solve(&right));
        for j in 0..n {
            d_speeds[free.offset + j] = solved.as_ref().map_or(f64::NAN, |solved| solved[j]);
        }
    }
}
