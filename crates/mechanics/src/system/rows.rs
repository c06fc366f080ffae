//! Rows of the Jacobian by plain elements: those whose neighbour is prescribed and does not turn, nor the frame of their body.
//!
//! A coordinate moves the body's origin along a column of the sight's rotation, or turns the body about the axis of an angle; what the
//! element does then is in its [`Response`].

use integrate::partitioned::Partitioned;

use super::{FreeBody, Mounted};
use crate::body::Kinematics;
use crate::coil::Coil;
use crate::contact::ContactFace;
use crate::frame::FrameMotion;
use crate::link::{Relative, Responses, Turning};
use crate::surface::Plane;
use crate::vector::Vector;

impl Mounted<ContactFace<Plane>> {
    /// Differentiates the face; its moment (body axes).
    #[inline(always)]
    pub(super) fn respond(
        &mut self,
        kinematics: &Kinematics<f64>,
        turning: &Turning,
        free: &FreeBody,
    ) -> Vector<f64> {
        let relative: Relative<f64> = self.sight.relative(kinematics);
        let (points, response, rates) = (&self.points, &mut self.response, &mut self.rate_responses[..]);
        let (force, moment) = match free.angles() {
            0 => points.respond::<0>(&relative, turning, response, rates),
            1 => points.respond::<1>(&relative, turning, response, rates),
            2 => points.respond::<2>(&relative, turning, response, rates),
            _ => points.respond::<3>(&relative, turning, response, rates),
        };
        self.force = force;
        moment
    }

    /// The derivatives of the rates of internal states.
    #[inline(always)]
    pub(super) fn add_rates(&self, free: &FreeBody, jacobian: &mut Partitioned) {
        let n = free.free.len();
        for (point, response) in self.rate_responses.iter().enumerate() {
            let [g_q, g_u, _] = jacobian.side_mut(self.first_internal / 2 + point, 0);
            for (j, way) in free.ways().enumerate() {
                for row in 0..2 {
                    let (by_position, by_speed) = match way {
                        Way::Along(k) => {
                            let [x, y, z] = self.sight.rotation.column(k).0;
                            let velocity = response.velocity.map(|rates| rates[row]);
                            (
                                response.gap[row] * x,
                                velocity[0] * x + velocity[1] * y + velocity[2] * z,
                            )
                        }
                        Way::About(slot) => (response.angle[slot][row], response.angle_rate[slot][row]),
                    };
                    g_q[row * n + j] = by_position;
                    g_u[row * n + j] = by_speed;
                }
            }
        }
    }

    /// Their derivatives by time.
    #[inline(always)]
    pub(super) fn rates_in_time(&self, on: &FrameMotion<f64>, d_internal: &mut [f64]) {
        let Some(translation) = &self.translation else {
            return;
        };
        let (speed, acceleration) = (self.sight.velocity.0[0], translation.acceleration(on));
        for (target, response) in d_internal.chunks_exact_mut(2).zip(&self.rate_responses) {
            for row in 0..2 {
                let velocity = Vector(response.velocity.map(|rates| rates[row]));
                target[row] = response.gap[row] * speed + velocity.dot::<f64, f64>(acceleration);
            }
        }
    }
}

impl Mounted<Coil> {
    /// Differentiates the coil; its moment (body axes).
    #[inline(always)]
    pub(super) fn respond(
        &mut self,
        kinematics: &Kinematics<f64>,
        turning: &Turning,
        free: &FreeBody,
    ) -> Vector<f64> {
        let relative: Relative<f64> = self.sight.relative(kinematics);
        let (coil, response) = (&self.element, &mut self.response);
        let (force, moment) = match free.angles() {
            0 => coil.respond::<0>(&relative, turning, response),
            1 => coil.respond::<1>(&relative, turning, response),
            2 => coil.respond::<2>(&relative, turning, response),
            _ => coil.respond::<3>(&relative, turning, response),
        };
        self.force = force;
        moment
    }
}

/// What a free coordinate does.
#[derive(Clone, Copy)]
enum Way {
    /// It moves the origin along this axis of the reference frame.
    Along(usize),
    /// It turns the body: the slot of the angle.
    About(usize),
}

impl FreeBody {
    /// How many angles are free.
    #[inline(always)]
    pub(super) fn angles(&self) -> usize {
        self.free.iter().filter(|k| **k >= 3).count()
    }

    #[inline(always)]
    fn ways(&self) -> impl Iterator<Item = Way> + '_ {
        let translations = self.free.len() - self.angles();
        self.free.iter().enumerate().map(move |(j, &k)| {
            if k < 3 {
                Way::Along(k)
            } else {
                Way::About(j - translations)
            }
        })
    }
}

/// `Σ_i weights_i columns_i`.
#[inline(always)]
fn combined(columns: &[Responses; 3], weights: Vector<f64>) -> Responses {
    let mut out = [0.0; 8];
    for o in 0..8 {
        out[o] = columns[0][o] * weights.0[0] + columns[1][o] * weights.0[1] + columns[2][o] * weights.0[2];
    }
    out
}

/// The force along the mount's axes.
#[inline(always)]
fn force(change: &Responses) -> Vector<f64> {
    Vector([change[0], change[1], change[2]])
}

impl<E> Mounted<E> {
    /// Adds the derivatives of generalized forces and powers by the coordinates of its body and their rates.
    #[inline(always)]
    pub(super) fn add_rows(&self, free: &FreeBody, jacobian: &mut Partitioned) {
        let n = free.free.len();
        let (sight, response) = (&self.sight, &self.response);
        for (j, way) in free.ways().enumerate() {
            let (by_position, by_speed) = match way {
                Way::Along(k) => {
                    let direction = sight.rotation.column(k);
                    (
                        combined(&response.place, direction),
                        combined(&response.velocity, direction),
                    )
                }
                Way::About(slot) => (response.angle[slot], response.angle_rate[slot]),
            };
            let (stiffness, damping) = jacobian.blocks_mut(free.pair);
            for (row, way) in free.ways().enumerate() {
                let (k, d) = match way {
                    Way::Along(k) => {
                        let direction = sight.rotation.column(k);
                        (
                            direction.dot::<f64, f64>(force(&by_position)),
                            direction.dot::<f64, f64>(force(&by_speed)),
                        )
                    }
                    Way::About(slot) => (by_position[3 + slot], by_speed[3 + slot]),
                };
                stiffness[row * n + j] += k;
                damping[row * n + j] += d;
            }
            let work = |change: &Responses| sight.mount_velocity.dot::<f64, f64>(force(change));
            let powers = [
                [by_position[6], by_speed[6]],
                [by_position[7], by_speed[7]],
                [work(&by_position), work(&by_speed)],
            ];
            for (row, [by_position, by_speed]) in self.rows[0].iter().zip(powers) {
                if let Some(row) = row {
                    let (p_q, p_u) = jacobian.row_mut(*row);
                    (p_q[j], p_u[j]) = (by_position, by_speed);
                }
            }
        }
    }

    /// Adds the derivatives by time.
    #[inline(always)]
    pub(super) fn in_time(
        &self,
        free: &FreeBody,
        on: &FrameMotion<f64>,
        (load, moments): &mut (Vector<f64>, [f64; 3]),
        d_quadratures: &mut [f64],
    ) {
        let Some(translation) = &self.translation else {
            return;
        };
        let (sight, response) = (&self.sight, &self.response);
        let acceleration = translation.acceleration(on);
        let mut change = combined(&response.place, sight.velocity);
        for (sum, term) in change
            .iter_mut()
            .zip(combined(&response.velocity, acceleration))
        {
            *sum += term;
        }
        *load += sight.rotation.apply_transposed(force(&change));
        for (way, k) in free.ways().zip(&free.free) {
            if let Way::About(slot) = way {
                moments[k - 3] += change[3 + slot];
            }
        }
        for (channel, power) in self.channels.iter().zip([change[6], change[7]]) {
            if let Some(channel) = channel {
                d_quadratures[*channel] += power;
            }
        }
        if self.driven {
            d_quadratures[0] += sight.mount_velocity.dot::<f64, f64>(force(&change))
                - acceleration.dot::<f64, f64>(self.force);
        }
    }
}
