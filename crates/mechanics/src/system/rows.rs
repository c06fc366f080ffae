//! Rows of the Jacobian by plain elements: those whose neighbour is prescribed and does not turn, nor the frame of their body.
//!
//! A coordinate moves the body's origin along a column of the sight's rotation, or turns the body about the axis of an angle; what the
//! element does then is in its [`crate::link::Response`].

use integrate::partitioned::Partitioned;

use super::forces::Element;
use super::{FreeBody, Mounted};
use crate::body::Kinematics;
use crate::contact::ContactFace;
use crate::frame::FrameMotion;
use crate::link::{Relative, Responses, Turning};
use crate::surface::Plane;
use crate::vector::Vector;

/// Differentiates a plain element; its moment (body axes).
#[inline(always)]
pub(super) fn respond<E: Element>(
    mounted: &mut Mounted<E>,
    kinematics: &Kinematics<f64>,
    turning: &Turning,
    free: &FreeBody,
) -> Vector<f64> {
    let relative: Relative<f64> = mounted.sight.relative(kinematics);
    let (element, points, response) = (&mounted.element, &mounted.points, &mut mounted.response);
    let rates = &mut mounted.rate_responses[..];
    let (force, moment) = match free.angles() {
        0 => element.respond::<0>(points, &relative, turning, response, rates),
        1 => element.respond::<1>(points, &relative, turning, response, rates),
        2 => element.respond::<2>(points, &relative, turning, response, rates),
        _ => element.respond::<3>(points, &relative, turning, response, rates),
    };
    mounted.force = force;
    moment
}

impl Mounted<ContactFace<Plane>> {
    /// The derivatives of the rates of internal states.
    #[inline(always)]
    pub(super) fn add_rates(&self, free: &FreeBody, jacobian: &mut Partitioned) {
        let n = free.free.len();
        for (point, response) in self.rate_responses.iter().enumerate() {
            let [g_q, g_u, _] = jacobian.side_mut(self.first_internal / 2 + point, 0);
            for (j, &k) in free.free.iter().enumerate() {
                for row in 0..2 {
                    (g_q[row * n + j], g_u[row * n + j]) = if k < 3 {
                        let [x, y, z] = self.sight.rotation.column(k).0;
                        let velocity = response.velocity.map(|rates| rates[row]);
                        (
                            response.gap[row] * x,
                            velocity[0] * x + velocity[1] * y + velocity[2] * z,
                        )
                    } else {
                        let slot = j - free.translations;
                        (response.angle[slot][row], response.angle_rate[slot][row])
                    };
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

impl FreeBody {
    /// How many angles are free.
    #[inline(always)]
    pub(super) fn angles(&self) -> usize {
        self.free.len() - self.translations
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

/// How the load on a body changes with its coordinates (first) and their rates, by coordinate: force (axes of the reference frame) and
/// moments about the axes of its free angles.
pub(super) type Columns = [[[f64; 6]; 6]; 2];

/// Adds them to the body's blocks.
#[inline(always)]
pub(super) fn add_columns(columns: &Columns, free: &FreeBody, jacobian: &mut Partitioned) {
    let n = free.free.len();
    let (stiffness, damping) = jacobian.blocks_mut(free.pair);
    for (row, &k) in free.free.iter().enumerate() {
        let component = if row < free.translations {
            k
        } else {
            3 + row - free.translations
        };
        for (j, entry) in stiffness[row * n..][..n].iter_mut().enumerate() {
            *entry += columns[0][j][component];
        }
        for (j, entry) in damping[row * n..][..n].iter_mut().enumerate() {
            *entry += columns[1][j][component];
        }
    }
}

impl<E> Mounted<E> {
    /// Adds the derivatives of the load on its body to `columns`, and keeps those of its powers.
    #[inline(always)]
    pub(super) fn add_rows(&self, free: &FreeBody, columns: &mut Columns, jacobian: &mut Partitioned) {
        let (sight, response) = (&self.sight, &self.response);
        for (rates, columns) in columns.iter_mut().enumerate() {
            let (along, about) = if rates == 0 {
                (&response.place, &response.angle)
            } else {
                (&response.velocity, &response.angle_rate)
            };
            for (j, &k) in free.free.iter().enumerate() {
                let change = if k < 3 {
                    combined(along, sight.rotation.column(k))
                } else {
                    about[j - free.translations]
                };
                let own: Vector<f64> = sight.rotation.apply_transposed(force(&change));
                let column = &mut columns[j];
                for c in 0..3 {
                    column[c] += own.0[c];
                    column[3 + c] += change[3 + c];
                }
                let work = sight.mount_velocity.dot::<f64, f64>(force(&change));
                for (row, power) in self.rows[0].iter().zip([change[6], change[7], work]) {
                    if let Some(row) = row {
                        let (by_position, by_speed) = jacobian.row_mut(*row);
                        let row = if rates == 0 { by_position } else { by_speed };
                        row[j] = power;
                    }
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
        for (sum, term) in change.iter_mut().zip(combined(&response.velocity, acceleration)) {
            *sum += term;
        }
        *load += sight.rotation.apply_transposed(force(&change));
        for (slot, k) in free.free[free.translations..].iter().enumerate() {
            moments[k - 3] += change[3 + slot];
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
