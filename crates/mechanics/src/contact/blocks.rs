//! The points of a face four at a time: forces in SIMD lanes, and derivatives of the law by the contact
//! kinematics.
//!
//! Point by point, with [`ContactFace::evaluate`], a wedge takes 7 to 22 % more instructions. That serves all
//! that is not called at each step: outputs, losses, derivatives along a direction.
//!
//! A curved surface is evaluated point by point ([`super::curved`]), the plane in the axes of the body, in
//! which the points rest: with the rows n, t1, t2 of the rotation Q from body to marker axes, d and c the
//! position and velocity of its origin and ω the relative angular velocity (marker axes), a point r has
//!
//! ```text
//! g = d·e_n + n·r,   v_i = c_i + (Qᵀ(e_i × ω))·r,   F = Qᵀ(N, T1, T2),   M = Σ r × F
//! ```
//!
//! so that gap, gap rate and slip of all points are linear in their coordinates. The laws are those of
//! [`ContactFace`].

use std::ops::Range;

use numerics::lanes::{LANES, LaneDual, LaneMask, Lanes};
use numerics::scalar::{Mask, Number};

use super::motion::{FaceMotion, PlaneMotion};
use super::{ContactFace, ContactPoint, Interface, PointKinematics, PointProperties};
use crate::body::Kinematics;
use crate::link::{BodyWrench, RelativeFrame};
use crate::surface::{Bend, compose};
use crate::vector::Vector;

/// Four points; missing ones are open.
#[derive(Clone, Debug)]
pub(crate) struct PointBlock {
    pub position: Vector<Lanes>,
    pub properties: PointProperties<Lanes>,
    present: LaneMask,
    pub count: usize,
}

/// The law's outputs: force along the normal and two tangents, losses in friction and in contact damping,
/// rates of the bristle.
pub(super) const OUTPUTS: usize = 7;

/// The derivatives of the law at four points.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointDerivatives {
    /// True if any derivative differs from zero. If those of open points were computed too, runs would take
    /// 0 to 4 % more instructions.
    pub active: bool,
    /// Forces along the normal and two tangents.
    pub force: [Lanes; 3],
    pub by_gap: [Lanes; OUTPUTS],
    pub by_slip: [[Lanes; OUTPUTS]; 2],
    /// Zero without contact damping.
    pub by_rate: [Lanes; OUTPUTS],
    /// Zero without internal states.
    pub by_deflection: [[Lanes; OUTPUTS]; 2],
}

/// The points of a face, ready for evaluation: contact kinematics at the last call of [`Points::update`], and
/// derivatives of the law at the last call of [`ContactFace::linearize`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Points {
    pub(super) blocks: Vec<PointBlock>,
    pub(super) kinematics: Vec<PointKinematics<Lanes>>,
    /// The bend of a curved surface at the points; none for a plane.
    pub(super) bends: Vec<Bend<Lanes>>,
    /// True if all were open at the last evaluation of the forces; never with internal states.
    open: bool,
    /// See [`Interface::first_arm`].
    pub(super) first_arm: f64,
    pub(super) derivatives: Vec<PointDerivatives>,
}

impl Points {
    /// Returns the points of a face.
    pub fn new(face: &ContactFace<Interface>) -> Self {
        let mut blocks: Vec<PointBlock> = face.points.chunks(LANES).map(PointBlock::new).collect();
        let factors = &face.surface.friction_factors;
        for (block, own) in blocks.iter_mut().zip(factors.chunks(LANES)) {
            let lane = |i: usize| own.get(i).copied().unwrap_or(1.0);
            block.properties.factor = Lanes::new(std::array::from_fn(lane));
        }
        let curved = !face.surface.shape.is_flat();
        let flat = Bend {
            gap: Lanes::ZERO,
            axes: [[Lanes::ZERO; 3]; 3],
            curvature: [Lanes::ZERO; 3],
            twist: [Lanes::ZERO; 2],
        };
        let nowhere = PointKinematics {
            gap: Lanes::ZERO,
            gap_rate: Lanes::ZERO,
            slip: [Lanes::ZERO; 2],
        };
        Self {
            kinematics: vec![nowhere; blocks.len()],
            bends: vec![flat; if curved { blocks.len() } else { 0 }],
            open: false,
            first_arm: face.surface.first_arm,
            derivatives: vec![PointDerivatives::NONE; blocks.len()],
            blocks,
        }
    }

    /// Updates the gaps if all points were open at the last evaluation of the forces. Returns whether all are
    /// still open; otherwise the contact kinematics are unknown. Velocities of open points without internal
    /// states are not needed. Valid only if marker B does not rotate and the surface is a plane. Without it
    /// a wedge that lifts off takes 4 to 5 % more instructions.
    #[inline(always)]
    pub fn update_if_open(&mut self, relative_frame: &RelativeFrame<f64>, body: &Kinematics<f64>) -> bool {
        if !self.open {
            return false;
        }
        let (distance, normal) = PlaneMotion::distance_and_normal(relative_frame, body);
        for (block, kinematics) in self.blocks.iter().zip(&mut self.kinematics) {
            kinematics.gap = normal.dot::<Lanes, Lanes>(block.position) + distance;
        }
        self.kinematics.iter().all(is_open)
    }

    /// Updates the contact kinematics of the points.
    #[inline(always)]
    pub fn update<M: FaceMotion>(&mut self, motion: &M) {
        for (number, (block, kinematics)) in self.blocks.iter().zip(&mut self.kinematics).enumerate() {
            *kinematics = motion.kinematics(block, self.bends.get_mut(number));
        }
    }

    /// Returns whether the surface is curved.
    #[inline(always)]
    pub fn is_curved(&self) -> bool {
        !self.bends.is_empty()
    }

    /// Returns whether the law has derivatives other than zero at any point; it has none if all are open.
    #[inline(always)]
    pub fn are_active(&self) -> bool {
        self.derivatives.iter().any(|derivatives| derivatives.active)
    }

    /// Gap and slip of every point.
    #[inline(always)]
    pub fn motions(&self, mut each: impl FnMut(usize, f64, [f64; 2])) {
        for (number, (block, at)) in self.blocks.iter().zip(&self.kinematics).enumerate() {
            let (gap, slip) = (at.gap.to_array(), at.slip.map(Lanes::to_array));
            for i in 0..block.count {
                each(LANES * number + i, gap[i], [slip[0][i], slip[1][i]]);
            }
        }
    }
}

impl PointBlock {
    fn new(points: &[ContactPoint]) -> Self {
        // Missing points are copies of the first one that are never closed.
        let lanes = |value: &dyn Fn(&ContactPoint) -> f64| {
            Lanes::new(std::array::from_fn(|i| {
                value(points.get(i).unwrap_or(&points[0]))
            }))
        };
        Self {
            position: Vector([0, 1, 2].map(|k| lanes(&move |point| point.position.0[k]))),
            properties: PointProperties {
                stiffness: lanes(&|point| point.stiffness),
                damping: lanes(&|point| point.damping),
                damped: points.iter().any(|point| point.damping > 0.0),
                share: lanes(&|point| point.share),
                factor: Lanes::from(1.0),
            },
            present: LaneMask::new(std::array::from_fn(|i| i < points.len())),
            count: points.len(),
        }
    }

    /// Returns the deflections of the block that begins with point `first`: zero where there are none.
    #[inline(always)]
    fn deflection(&self, deflections: &[f64], first: usize) -> [Lanes; 2] {
        let Some(own) = deflections.get(2 * first..2 * (first + self.count)) else {
            return [Lanes::zero(); 2];
        };
        let mut out = [[0.0; LANES]; 2];
        for (i, e) in own.chunks_exact(2).enumerate() {
            (out[0][i], out[1][i]) = (e[0], e[1]);
        }
        out.map(Lanes::new)
    }
}

/// Returns whether four points are open, each of them, and not just touching. (Missing ones are copies of the
/// first.)
#[inline(always)]
fn is_open(at: &PointKinematics<Lanes>) -> bool {
    Lanes::zero().below(at.gap).all()
}

#[inline(always)]
fn closed(block: &PointBlock, at: &PointKinematics<Lanes>) -> LaneMask {
    at.gap.below(Lanes::zero()).and(block.present)
}

impl ContactFace<Interface> {
    /// Returns the wrench of all points on their body; `rates` receives the rates of the internal states.
    #[inline(always)]
    pub(crate) fn wrench_on_body<M: FaceMotion>(
        &self,
        points: &mut Points,
        motion: &M,
        deflections: &[f64],
        rates: &mut [f64],
    ) -> BodyWrench {
        points.update(motion);
        let mut sums = [Lanes::zero(); 8];
        points.open = true;
        for (number, (block, at)) in points.blocks.iter().zip(&points.kinematics).enumerate() {
            let closed = closed(block, at);
            // Without this a wedge that lifts off takes 6 to 8 % more instructions.
            if closed.none() && deflections.is_empty() {
                continue;
            }
            points.open = false;
            let first = LANES * number;
            let deflection = block.deflection(deflections, first);
            let forces = self.point_force(&block.properties, closed, at, deflection);
            let bend = points.bends.get(number);
            for (sum, term) in sums.iter_mut().zip(motion.push(block, bend, &forces)) {
                *sum += term;
            }
            if !deflections.is_empty() {
                let rate = forces.friction.rate.map(Lanes::to_array);
                for i in 0..block.count {
                    rates[2 * (first + i)] = rate[0][i];
                    rates[2 * (first + i) + 1] = rate[1][i];
                }
            }
        }
        let [f1, f2, f3, m1, m2, m3, friction, damping] = sums;
        let [f1, f2, f3, m1] = Lanes::sums([f1, f2, f3, m1]).to_array();
        let [m2, m3, friction, damping] = Lanes::sums([m2, m3, friction, damping]).to_array();
        BodyWrench {
            force: Vector([f1, f2, f3]),
            moment: Vector([m1, m2, m3]),
            powers: [friction, damping],
        }
    }

    /// Writes the deflections at the end of an implicit stage of this duration (s) in place of those from
    /// which it begins.
    #[inline(always)]
    pub(crate) fn settle<M: FaceMotion>(
        &self,
        points: &mut Points,
        motion: &M,
        deflections: &mut [f64],
        duration: f64,
    ) {
        points.update(motion);
        for (number, (block, at)) in points.blocks.iter().zip(&points.kinematics).enumerate() {
            let first = LANES * number;
            let base = block.deflection(deflections, first);
            let own = self.settled(&block.properties, closed(block, at), at, (base, duration));
            let own = own.map(Lanes::to_array);
            for i in 0..block.count {
                deflections[2 * (first + i)] = own[0][i];
                deflections[2 * (first + i) + 1] = own[1][i];
            }
        }
    }

    /// Calls `each` with gap and friction load of four points at a time. The load of open points has no
    /// meaning.
    #[inline(always)]
    pub(crate) fn event_variables(
        &self,
        points: &Points,
        deflections: &[f64],
        mut each: impl FnMut(Range<usize>, Lanes, Lanes),
    ) {
        for (number, (block, at)) in points.blocks.iter().zip(&points.kinematics).enumerate() {
            let first = LANES * number;
            // The slip of open points may be that of an earlier state ([`Points::update_if_open`]).
            let load = if is_open(at) {
                Lanes::zero()
            } else {
                let deflection = block.deflection(deflections, first);
                let forces = self.point_force(&block.properties, closed(block, at), at, deflection);
                forces.friction.load
            };
            each(first..first + block.count, at.gap, load);
        }
    }

    /// Differentiates the law at every point.
    pub(crate) fn linearize(&self, points: &mut Points, deflections: &[f64]) {
        let blocks = points.blocks.iter().zip(&points.kinematics);
        for (number, ((block, at), derivatives)) in blocks.zip(&mut points.derivatives).enumerate() {
            let closed = closed(block, at);
            derivatives.active = !(closed.none() && deflections.is_empty());
            if !derivatives.active {
                continue;
            }
            let deflection = block.deflection(deflections, LANES * number);
            match (block.properties.damped, deflections.is_empty()) {
                (false, true) => self.differentiate::<3>(block, closed, at, deflection, derivatives),
                (true, true) => self.differentiate::<4>(block, closed, at, deflection, derivatives),
                _ => self.differentiate::<6>(block, closed, at, deflection, derivatives),
            }
        }
    }

    /// The law's derivatives by the first `N` of gap, slip (2), gap rate, deflection (2): with all 6
    /// always a wedge takes 1 to 3 % more instructions.
    #[inline(always)]
    fn differentiate<const N: usize>(
        &self,
        block: &PointBlock,
        closed: LaneMask,
        at: &PointKinematics<Lanes>,
        deflection: [Lanes; 2],
        derivatives: &mut PointDerivatives,
    ) {
        let seed = |value: Lanes, index: usize| {
            if index < N {
                LaneDual::<N>::variable(value, index)
            } else {
                LaneDual::lift(value)
            }
        };
        let seeded = PointKinematics {
            gap: seed(at.gap, 0),
            slip: [seed(at.slip[0], 1), seed(at.slip[1], 2)],
            gap_rate: seed(at.gap_rate, 3),
        };
        let deflection = [seed(deflection[0], 4), seed(deflection[1], 5)];
        let forces = self.point_force::<LaneDual<N>>(&block.properties, closed, &seeded, deflection);
        let ([t1, t2], [r1, r2]) = (forces.friction.force, forces.friction.rate);
        let outputs = [
            forces.normal,
            t1,
            t2,
            forces.friction.loss,
            forces.damping_loss,
            r1,
            r2,
        ];
        derivatives.force = [forces.normal.value, t1.value, t2.value];
        let [slip1, slip2] = &mut derivatives.by_slip;
        let [deflection1, deflection2] = &mut derivatives.by_deflection;
        let by = [
            &mut derivatives.by_gap,
            slip1,
            slip2,
            &mut derivatives.by_rate,
            deflection1,
            deflection2,
        ];
        for (input, by) in by.into_iter().enumerate().take(N) {
            for (by, output) in by.iter_mut().zip(&outputs) {
                *by = output.derivative[input];
            }
        }
    }
}

impl PointDerivatives {
    /// No derivatives.
    const NONE: Self = {
        let none = Lanes::ZERO;
        Self {
            active: false,
            force: [none; 3],
            by_gap: [none; OUTPUTS],
            by_slip: [[none; OUTPUTS]; 2],
            by_rate: [none; OUTPUTS],
            by_deflection: [[none; OUTPUTS]; 2],
        }
    };
}

impl Points {
    /// For every point with internal states, calls `each` with the derivatives by them: of their rates
    /// (row-major), the forces at the point (marker axes, with its position in body axes) and the friction
    /// loss.
    pub fn internal_derivatives(&self, mut each: impl FnMut(usize, &InternalDerivatives)) {
        for (number, (block, derivatives)) in self.blocks.iter().zip(&self.derivatives).enumerate() {
            let by = derivatives.by_deflection.map(|row| row.map(Lanes::to_array));
            let position = block.position.0.map(Lanes::to_array);
            let along = |components: [Lanes; 3]| match self.bends.get(number) {
                Some(bend) => compose(&bend.axes, components).0,
                None => components,
            };
            let forces = derivatives
                .by_deflection
                .map(|by| along([by[0], by[1], by[2]]).map(Lanes::to_array));
            for i in 0..block.count {
                each(
                    LANES * number + i,
                    &InternalDerivatives {
                        rate: [by[0][5][i], by[1][5][i], by[0][6][i], by[1][6][i]],
                        force: [0, 1].map(|e| Vector([0, 1, 2].map(|c| forces[e][c][i]))),
                        position: Vector(position.map(|lanes| lanes[i])),
                        loss: [by[0][3][i], by[1][3][i]],
                    },
                );
            }
        }
    }
}

/// The derivatives of a point's law by its two internal states.
pub(crate) struct InternalDerivatives {
    /// Of their rates, row-major.
    pub rate: [f64; 4],
    /// Of the force, by each of them.
    pub force: [Vector<f64>; 2],
    /// From the body's origin to the point, body axes.
    pub position: Vector<f64>,
    /// Of the friction loss.
    pub loss: [f64; 2],
}
