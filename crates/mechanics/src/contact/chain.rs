//! How a face's resultant changes with any motion of the two bodies: the chain rule of points on a rigid body.
//!
//! With a small change δp of the body's origin, θ of its rotation, δv and δω of its velocities, all in mount axes, and r from the origin
//! to a point,
//!
//! ```text
//! δr = θ × r,   δg = (δp + δr)·n,   δv_P = δv + δω × r + ω × δr,   δM = r × δF + δr × F
//! ```
//!
//! For elements between two free bodies and on turning ones; the others have [`super::work`].

use integrate::lanes::{LANES, Lanes};
use integrate::scalar::{Dual, Number};

use super::FaceResultant;
use super::quads::{OUTPUTS, Points, Slopes};
use crate::link::Relative;
use crate::vector::{Matrix, Vector};

/// Sums of forces and powers in lanes.
#[derive(Clone, Copy)]
struct Sums {
    force: Vector<Lanes>,
    moment: Vector<Lanes>,
    losses: [Lanes; 2],
}

impl Sums {
    #[inline(always)]
    fn none() -> Self {
        Self {
            force: Vector::zero(),
            moment: Vector::zero(),
            losses: [Lanes::zero(); 2],
        }
    }

    #[inline(always)]
    fn add(&mut self, force: Vector<Lanes>, moment: Vector<Lanes>, losses: [Lanes; 2]) {
        self.force += force;
        self.moment += moment;
        self.losses[0] += losses[0];
        self.losses[1] += losses[1];
    }

    #[inline(always)]
    fn over_lanes(&self) -> FaceResultant<f64> {
        let ([fx, fy, fz], [mx, my, mz]) = (self.force.0, self.moment.0);
        let [fx, fy, fz, mx] = Lanes::sums([fx, fy, fz, mx]).to_array();
        let [my, mz, friction_loss, damping_loss] =
            Lanes::sums([my, mz, self.losses[0], self.losses[1]]).to_array();
        FaceResultant {
            force: Vector([fx, fy, fz]),
            moment: Vector([mx, my, mz]),
            friction_loss,
            damping_loss,
        }
    }
}

impl Points {
    /// The resultant with its derivatives along a relative motion, where the law was differentiated; `rates` sees those of the rates of
    /// the internal states, if there are any (`internal`).
    #[inline(always)]
    pub fn change<const N: usize>(
        &self,
        relative: &Relative<Dual<N>>,
        internal: bool,
        mut rates: impl FnMut(usize, [[f64; 2]; N]),
    ) -> FaceResultant<Dual<N>> {
        let columns = Column::all(relative);
        let (rotation, spin) = (relative.rotation.value(), relative.angular_velocity.value());
        let mut values = Sums::none();
        let mut changes = [Sums::none(); N];
        for (number, (quad, slopes)) in self.quads.iter().zip(&self.slopes).enumerate() {
            if !slopes.active {
                continue;
            }
            let (arm, force) = (rotation.apply(quad.position), Vector(slopes.force));
            values.add(force, arm.cross(force), slopes.losses);
            let mut rate = [[[0.0; LANES]; 2]; N];
            for k in 0..N {
                let own = slopes.along(&columns[k], arm, spin, internal, &mut changes[k]);
                rate[k] = own.map(Lanes::to_array);
            }
            if internal {
                for i in 0..quad.count {
                    rates(
                        LANES * number + i,
                        std::array::from_fn(|k| rate[k].map(|lanes| lanes[i])),
                    );
                }
            }
        }
        let value = values.over_lanes();
        let mut sum = FaceResultant {
            force: Vector::<Dual<N>>::lift(value.force),
            moment: Vector::lift(value.moment),
            friction_loss: Dual::from(value.friction_loss),
            damping_loss: Dual::from(value.damping_loss),
        };
        for k in 0..N {
            let change = changes[k].over_lanes();
            for c in 0..3 {
                sum.force.0[c].derivative[k] = change.force.0[c];
                sum.moment.0[c].derivative[k] = change.moment.0[c];
            }
            sum.friction_loss.derivative[k] = change.friction_loss;
            sum.damping_loss.derivative[k] = change.damping_loss;
        }
        sum
    }
}

/// A small change of a body's motion, mount axes.
#[derive(Clone, Copy, Debug)]
struct Column {
    /// Of position (δp) and rotation (θ); none: only the velocities change.
    pose: Option<(Vector<f64>, Vector<f64>)>,
    velocity: Vector<f64>,
    spin: Vector<f64>,
}

impl Column {
    /// No change.
    const NONE: Self = Self {
        pose: None,
        velocity: Vector([0.0; 3]),
        spin: Vector([0.0; 3]),
    };

    /// All changes of a relative motion.
    #[inline(always)]
    fn all<const N: usize>(relative: &Relative<Dual<N>>) -> [Self; N] {
        let mut columns = [Self::NONE; N];
        for (k, column) in columns.iter_mut().enumerate() {
            *column = Self::new(relative, k);
        }
        columns
    }

    #[inline(always)]
    fn new<const N: usize>(relative: &Relative<Dual<N>>, k: usize) -> Self {
        let part =
            |v: &Vector<Dual<N>>| Vector([v.0[0].derivative[k], v.0[1].derivative[k], v.0[2].derivative[k]]);
        let Matrix(r) = &relative.rotation;
        // δR Rᵀ is the skew matrix of θ.
        let entry = |i: usize, j: usize| {
            r[i][0].derivative[k] * r[j][0].value
                + r[i][1].derivative[k] * r[j][1].value
                + r[i][2].derivative[k] * r[j][2].value
        };
        let (place, turn) = (
            part(&relative.position),
            Vector([entry(2, 1), entry(0, 2), entry(1, 0)]),
        );
        Self {
            pose: (place != Vector::zero() || turn != Vector::zero()).then_some((place, turn)),
            velocity: part(&relative.velocity),
            spin: part(&relative.angular_velocity),
        }
    }
}

impl Slopes {
    /// Adds the change of the resultant along a change of the motion; the rates of the internal states.
    #[inline(always)]
    fn along(
        &self,
        column: &Column,
        own_arm: Vector<Lanes>,
        spin: Vector<f64>,
        internal: bool,
        sums: &mut Sums,
    ) -> [Lanes; 2] {
        let swing: Vector<Lanes> = column.spin.cross(own_arm);
        let mut velocity: Vector<Lanes> = column.velocity + swing;
        let mut moment = Vector::zero();
        let mut out = [Lanes::zero(); OUTPUTS];
        let outputs = if internal { OUTPUTS } else { OUTPUTS - 2 };
        if let Some((place, turn)) = column.pose {
            let arm: Vector<Lanes> = turn.cross(own_arm);
            let carried: Vector<Lanes> = spin.cross(arm);
            velocity += carried;
            moment = arm.cross(Vector(self.force));
            let gap = arm.0[0] + place.0[0];
            for (out, by) in out[..outputs].iter_mut().zip(&self.by_gap) {
                *out = *by * gap;
            }
        }
        let [normal, slip1, slip2] = velocity.0;
        for o in 0..outputs {
            out[o] += self.by_rate[o] * normal;
            // Neither the normal force nor the loss in contact damping depend on slip.
            if o != 0 && o != 4 {
                out[o] += self.by_slip[0][o] * slip1 + self.by_slip[1][o] * slip2;
            }
        }
        let force = Vector([out[0], out[1], out[2]]);
        moment += own_arm.cross(force);
        sums.add(force, moment, [out[3], out[4]]);
        [out[5], out[6]]
    }
}
