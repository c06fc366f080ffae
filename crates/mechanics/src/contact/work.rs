//! How what a face does changes with the motion of its body, where the surface stands still or translates: by virtual work.
//!
//! With n, t1, t2 the rows q_i of the rotation Q from body to mount axes, an angle about the axis a (body axes) moves a point r by
//! `h_i·r` along the mount's axes, `h_i = q_i × a`. The moment's part about a is `a·M = Σ F_i (h_i·r)`, by the same lengths; and with
//! ω the angular velocity (body axes) and ω' its change with the angle at fixed rates
//!
//! ```text
//! ∂g/∂angle = h_n·r,   ∂v_i/∂angle = (h_i × ω + q_i × ω')·r,   ∂v_i/∂rate = h_i·r,   ∂(a_k·M)/∂angle at fixed F_i = (F × a)·(a_k × r)
//! ```

use integrate::lanes::{LANES, Lanes};

use super::quads::{OUTPUTS, Points, Slopes};
use crate::link::{Relative, Response, Responses, Turning};
use crate::vector::{Matrix, Vector};

/// How the rates of a point's two internal states change; as [`Response`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RateResponse {
    pub gap: [f64; 2],
    pub velocity: [[f64; 2]; 3],
    pub angle: [[f64; 2]; 3],
    pub angle_rate: [[f64; 2]; 3],
}

/// What an angle does to the points.
#[derive(Clone, Copy)]
struct Turn {
    /// `h_i`.
    lengths: [Vector<f64>; 3],
    /// What the components of the velocity change by.
    swings: [Vector<f64>; 3],
}

impl Turn {
    #[inline(always)]
    fn new(rows: [Vector<f64>; 3], axis: Vector<f64>, drift: Vector<f64>, spin: Vector<f64>) -> Self {
        let lengths = rows.map(|row| row.cross::<f64, f64>(axis));
        let swing = |i: usize| lengths[i].cross::<f64, f64>(spin) + rows[i].cross::<f64, f64>(drift);
        Self {
            lengths,
            swings: [swing(0), swing(1), swing(2)],
        }
    }
}

/// What depends on slip: the tangential force and the loss in friction. (The normal force and the loss in contact damping do not.)
const BY_SLIP: std::ops::Range<usize> = 1..4;

impl Slopes {
    /// What the law's outputs change by with the slip; those of internal states too, if there are any.
    #[inline(always)]
    fn by_slips(&self, slip: [Lanes; 2], internal: bool) -> [Lanes; OUTPUTS] {
        let mut out = [Lanes::ZERO; OUTPUTS];
        let mut set = |o: usize| out[o] = self.by_slip[0][o] * slip[0] + self.by_slip[1][o] * slip[1];
        BY_SLIP.for_each(&mut set);
        if internal {
            (5..7).for_each(&mut set);
        }
        out
    }

    /// Adds what they change by with the gap or its rate.
    #[inline(always)]
    fn add(out: &mut [Lanes; OUTPUTS], by: &[Lanes; OUTPUTS], change: Lanes, all: bool) {
        let outputs = if all { OUTPUTS } else { 4 };
        for (out, by) in out[..outputs].iter_mut().zip(by) {
            *out += *by * change;
        }
    }
}

impl Points {
    /// The response of a face to the motion of its body with `R` free angles, where the law was differentiated, and that of the rates of
    /// internal states, as many as `rates` takes; with the face's force (mount axes) and moment (body axes).
    #[inline(always)]
    pub fn respond<const R: usize>(
        &self,
        relative: &Relative<f64>,
        turning: &Turning,
        response: &mut Response,
        rates: &mut [RateResponse],
    ) -> (Vector<f64>, Vector<f64>) {
        let internal = !rates.is_empty();
        let Matrix(rows) = relative.rotation;
        let rows = rows.map(Vector);
        let mut turns = [Turn {
            lengths: rows,
            swings: rows,
        }; R];
        for (l, turn) in turns.iter_mut().enumerate() {
            *turn = Turn::new(rows, turning.axes[l], turning.drifts[l], turning.spin);
        }
        let mut sums = [Lanes::ZERO; 8];
        *response = Response::NONE;
        for (number, (quad, slopes)) in self.quads.iter().zip(&self.slopes).enumerate() {
            if !slopes.active {
                continue;
            }
            let r = quad.position;
            let damped = quad.grade.damped;
            let along = |v: &Vector<f64>| -> Lanes { v.dot(r) };
            let mut lengths = [[Lanes::ZERO; 3]; R];
            for l in 0..R {
                for i in 0..3 {
                    lengths[l][i] = along(&turns[l].lengths[i]);
                }
            }
            let mut point_rates = [RateResponse::default(); LANES];
            let mut keep = |slot: &mut dyn FnMut(&mut RateResponse) -> &mut [f64; 2],
                            out: &[Lanes; OUTPUTS]| {
                let [a, b] = [out[5].to_array(), out[6].to_array()];
                for (i, point) in point_rates.iter_mut().enumerate() {
                    *slot(point) = [a[i], b[i]];
                }
            };
            // The effect as it is summed, with the moments about the axes by the forces along the mount's axes.
            let summed = |out: &[Lanes; OUTPUTS], work: [Lanes; 3]| -> Responses {
                let [w0, w1, w2] = work;
                [
                    Lanes::sums([out[0], out[1], out[2], out[3]]),
                    Lanes::sums([w0, w1, w2, out[4]]),
                ]
            };
            let pressed = |out: &[Lanes; OUTPUTS]| -> Responses {
                let mut work = [Lanes::ZERO; 3];
                for k in 0..R {
                    let [normal, t1, t2] = lengths[k];
                    work[k] = normal * out[0] + (t1 * out[1] + t2 * out[2]);
                }
                summed(out, work)
            };
            let slid = |out: &[Lanes; OUTPUTS]| -> Responses {
                let mut work = [Lanes::ZERO; 3];
                for k in 0..R {
                    work[k] = lengths[k][1] * out[1] + lengths[k][2] * out[2];
                }
                summed(out, work)
            };

            // The face's own force and moment, and how its moments change where the forces keep to the mount's axes.
            let own: Vector<Lanes> = relative.rotation.transpose().apply(Vector(slopes.force));
            let moment: Vector<Lanes> = r.cross(own);
            let radial: Lanes = r.dot(own);
            let ([f0, f1, f2], [m0, m1, m2]) = (slopes.force, moment.0);
            for (sum, term) in sums.iter_mut().zip([f0, f1, f2, m0, m1, m2]) {
                *sum += term;
            }

            add(&mut response.place[0], pressed(&slopes.by_gap));
            add(&mut response.velocity[1], slid(&slopes.by_slip[0]));
            add(&mut response.velocity[2], slid(&slopes.by_slip[1]));
            if damped {
                add(&mut response.velocity[0], pressed(&slopes.by_rate));
            }
            if internal {
                keep(&mut |point| &mut point.gap, &slopes.by_gap);
                keep(&mut |point| &mut point.velocity[0], &slopes.by_rate);
                keep(&mut |point| &mut point.velocity[1], &slopes.by_slip[0]);
                keep(&mut |point| &mut point.velocity[2], &slopes.by_slip[1]);
            }
            let all = damped || internal;
            for l in 0..R {
                let swings = &turns[l].swings;
                let mut out = slopes.by_slips([along(&swings[1]), along(&swings[2])], internal);
                Slopes::add(&mut out, &slopes.by_gap, lengths[l][0], all);
                if damped {
                    Slopes::add(&mut out, &slopes.by_rate, along(&swings[0]), true);
                }
                let mut change = pressed(&out);
                if internal {
                    keep(&mut |point| &mut point.angle[l], &out);
                }
                // (F × a)·(a_k × r) = (a_k·F)(a·r) - (a_k·a)(F·r)
                let axis = &turning.axes[l];
                let reach = along(axis);
                let mut turned = [Lanes::ZERO; LANES];
                for k in 0..R {
                    let other = &turning.axes[k];
                    let part: Lanes = other.dot(own);
                    turned[k] = part * reach - radial * other.dot::<f64, f64>(*axis);
                }
                change[1] += Lanes::sums(turned);
                add(&mut response.angle[l], change);

                let mut out = slopes.by_slips([lengths[l][1], lengths[l][2]], internal);
                let change = if damped {
                    Slopes::add(&mut out, &slopes.by_rate, lengths[l][0], true);
                    pressed(&out)
                } else {
                    slid(&out)
                };
                add(&mut response.angle_rate[l], change);
                if internal {
                    keep(&mut |point| &mut point.angle_rate[l], &out);
                }
            }
            if internal {
                for (target, point) in rates
                    .iter_mut()
                    .skip(LANES * number)
                    .zip(&point_rates[..quad.count])
                {
                    *target = *point;
                }
            }
        }
        let [f0, f1, f2, m0, m1, m2, ..] = sums;
        let [f0, f1, f2, m0] = Lanes::sums([f0, f1, f2, m0]).to_array();
        let [m1, m2, ..] = Lanes::sums([m1, m2, Lanes::ZERO, Lanes::ZERO]).to_array();
        (Vector([f0, f1, f2]), Vector([m0, m1, m2]))
    }
}

#[inline(always)]
fn add(sum: &mut Responses, term: Responses) {
    sum[0] += term[0];
    sum[1] += term[1];
}
