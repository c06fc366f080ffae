//! Rows of the Jacobian by plain elements: those whose neighbour is prescribed and does not turn, nor the frame of their body.
//!
//! A coordinate moves the body's origin along a column of the sight's rotation, or turns the body about the axis of an angle; what the
//! element does then is in its [`crate::link::Response`].

use integrate::lanes::Lanes;
use integrate::partitioned::Partitioned;

use super::forces::Element;
use super::{FrameState, FreeBody, Mounted};
use crate::body::Kinematics;
use crate::contact::ContactFace;
use crate::link::{Relative, Responses, Sight, Turning, combined};
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
    pub(super) fn rates_in_time(&self, on: &FrameState, d_internal: &mut [f64]) {
        let Some(translation) = &self.translation else {
            return;
        };
        let (speed, acceleration) = (self.sight.velocity.0[0], translation.acceleration(on.jets()));
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

/// What becomes of a force along the mount's axes: its components along the axes of the body's reference frame, and the work that the
/// mount's velocity does against it.
struct Onward([Lanes; 3]);

impl Onward {
    #[inline(always)]
    fn new(sight: &Sight<f64>) -> Self {
        let row = |i: usize| {
            let [x, y, z] = sight.rotation.0[i];
            Lanes::new([x, y, z, sight.mount_velocity.0[i]])
        };
        Self([row(0), row(1), row(2)])
    }

    /// Of the force that a change begins with.
    #[inline(always)]
    fn of(&self, change: &Responses) -> Lanes {
        let [x, y, z, _] = change[0].to_array();
        self.0[0] * x + self.0[1] * y + self.0[2] * z
    }
}

/// How the load on a body changes with its coordinates (first) and their rates, by coordinate: force (axes of the reference frame), and
/// moments about the axes of its free angles, each with a fourth number of no meaning.
pub(super) type Columns = [[[Lanes; 2]; 6]; 2];

/// Adds them to the body's blocks.
#[inline(always)]
pub(super) fn add_columns(columns: &Columns, free: &FreeBody, jacobian: &mut Partitioned) {
    let n = free.free.len();
    let (stiffness, damping) = jacobian.blocks_mut(free.pair);
    for (row, &k) in free.free.iter().enumerate() {
        let (part, component) = if row < free.translations {
            (0, k)
        } else {
            (1, row - free.translations)
        };
        for (block, columns) in [&mut *stiffness, &mut *damping].into_iter().zip(columns) {
            for (entry, column) in block[row * n..][..n].iter_mut().zip(columns) {
                *entry += column[part].at(component);
            }
        }
    }
}

impl<E> Mounted<E> {
    /// Adds the derivatives of the load on its body to `columns`, and keeps those of its powers.
    #[inline(always)]
    pub(super) fn add_rows(&self, free: &FreeBody, columns: &mut Columns, jacobian: &mut Partitioned) {
        let (sight, response) = (&self.sight, &self.response);
        let onward = Onward::new(sight);
        for (rates, columns) in columns.iter_mut().enumerate() {
            let (along, about) = if rates == 0 {
                (&response.place, &response.angle)
            } else {
                (&response.velocity, &response.angle_rate)
            };
            let mut powers = [[0.0; 6]; 3];
            for (j, &k) in free.free.iter().enumerate() {
                let change = if k < 3 {
                    combined(along, sight.rotation.column(k))
                } else {
                    about[j - free.translations]
                };
                let own = onward.of(&change);
                let [force, moments] = &mut columns[j];
                *force += own;
                *moments += change[1];
                powers[0][j] = change[0].at(3);
                powers[1][j] = change[1].at(3);
                powers[2][j] = own.at(3);
            }
            for (row, powers) in self.rows[0].iter().zip(&powers) {
                if let Some(row) = row {
                    let (by_position, by_speed) = jacobian.row_mut(*row);
                    let row = if rates == 0 { by_position } else { by_speed };
                    row.copy_from_slice(&powers[..free.free.len()]);
                }
            }
        }
    }

    /// Adds the derivatives by time.
    #[inline(always)]
    pub(super) fn in_time(
        &self,
        free: &FreeBody,
        on: &FrameState,
        (load, moments): &mut (Vector<f64>, [f64; 3]),
        d_quadratures: &mut [f64],
    ) {
        let Some(translation) = &self.translation else {
            return;
        };
        let (sight, response) = (&self.sight, &self.response);
        let acceleration = translation.acceleration(on.jets());
        let (places, velocities) = (
            combined(&response.place, sight.velocity),
            combined(&response.velocity, acceleration),
        );
        let change = [places[0] + velocities[0], places[1] + velocities[1]];
        let [x, y, z, work] = Onward::new(sight).of(&change).to_array();
        *load += Vector([x, y, z]);
        for (slot, k) in free.free[free.translations..].iter().enumerate() {
            moments[k - 3] += change[1].at(slot);
        }
        for (channel, power) in self.channels.iter().zip([change[0].at(3), change[1].at(3)]) {
            if let Some(channel) = channel {
                d_quadratures[*channel] += power;
            }
        }
        if self.driven {
            d_quadratures[0] += work - acceleration.dot::<f64, f64>(self.force);
        }
    }
}
