//! The Jacobian, element by element.
//!
//! The speed rows hold the residual `Q(q, u) - M(q) u˙ - b(q, u)` at fixed accelerations, so that the change
//! of M with the coordinates is included. Every element gives its tangent ([`crate::element::tangent`]), and
//! [`super::chain`] applies the chain rule for the coordinates of the bodies at its two ends. Inertia is
//! differentiated by dual numbers: by angles and their rates only, if the reference frame stands still.

use numerics::lanes::LANES;
use numerics::partitioned::Partitioned;
use numerics::scalar::Dual;

use super::chain::{Block, Chain, NO_BLOCK, Powers, Rows, add_block};
use super::forces::{Mountable, WORK};
use super::{FreeBody, Mounted, System};
use crate::body::Kinematics;
use crate::body::RotationAxes;
use crate::connection;
use crate::contact::{ContactFace, Interface};
use crate::element::Marked;
use crate::element::tangent::{Change, TangentColumns, force_of, moment_of};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// Derivatives that are summed for a free body while the elements are differentiated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gathered {
    rotation_axes: RotationAxes,
    block: Block,
    /// The moment of all elements, body axes.
    moment: Vector<f64>,
}

impl Gathered {
    pub const NONE: Self = Self {
        rotation_axes: RotationAxes::NONE,
        block: NO_BLOCK,
        moment: Vector([0.0; 3]),
    };
}

/// The bodies, for all elements.
struct Bodies<'s> {
    kinematics: &'s [Kinematics<f64>],
    free: &'s [FreeBody],
    free_number: &'s [Option<usize>],
    gathered_at: &'s [usize],
}

impl System {
    /// Computes the Jacobian at the state of the last [`System::update_kinematics`], where the rates are
    /// `dx`. Unless `whole`, the derivatives of inertia by the angles are left out; they are some thousandth
    /// of those of contacts.
    pub(super) fn differentiate(&mut self, x: &[f64], dx: &[f64], whole: bool) {
        let layout = self.layout;
        let [_, _, internal, _] = layout.split(x);
        self.update_points();
        self.jacobian.clear();
        for (free, gathered) in self.free.iter().zip(&mut self.gathered) {
            let kinematics = &self.kinematics[free.body];
            *gathered = Gathered {
                rotation_axes: kinematics.rotation_axes(&free.free),
                ..Gathered::NONE
            };
        }
        for free in &self.free {
            let Some(carrier) = free.carrier else { continue };
            let mut rotation_axes = self.kinematics[carrier].rotation_axes(&free.free);
            if free.free.contains(&3) {
                (rotation_axes.axes[0], rotation_axes.axis_rates[0]) = (Vector::zero(), Vector::zero());
            }
            self.gathered[self.gathered_at[carrier]] = Gathered {
                rotation_axes,
                ..Gathered::NONE
            };
        }
        let bodies = Bodies {
            kinematics: &self.kinematics,
            free: &self.free,
            free_number: &self.free_number,
            gathered_at: &self.gathered_at,
        };
        for face in &mut self.faces {
            let deflections = &internal[face.first_internal..][..face.internal_count];
            face.element.linearize(&mut face.points, deflections);
            if face.points.are_active() {
                differentiate_element(face, deflections, &bodies, &mut self.gathered, &mut self.jacobian);
            }
        }
        for coil in &mut self.coils {
            differentiate_element(coil, &[], &bodies, &mut self.gathered, &mut self.jacobian);
        }
        for element in &mut self.elements {
            let states = &internal[element.first_internal..][..element.internal_count];
            differentiate_element(element, states, &bodies, &mut self.gathered, &mut self.jacobian);
        }
        for number in 0..self.free.len() {
            let free = &self.free[number];
            if free.linear.is_some() {
                if free.touched {
                    let blocks = self.jacobian.blocks_mut(free.pair);
                    add_block(&self.gathered[number].block, free, free.free.len(), blocks);
                    if whole {
                        self.rotation_axes(number, x);
                    }
                }
                continue;
            }
            let kinematics = &self.kinematics[free.body];
            kinematics.mass_matrix(
                &self.bodies[free.body],
                &free.free,
                self.jacobian.mass_mut(number),
            );
            let accelerations = &mut self.accelerations[free.body];
            for (j, &k) in free.free.iter().enumerate() {
                accelerations[k] = dx[layout.speeds + free.offset + j];
            }
            let blocks = self.jacobian.blocks_mut(free.pair);
            add_block(&self.gathered[number].block, free, free.free.len(), blocks);
            if let Some(carrier) = free.carrier {
                let gathered = &self.gathered[self.gathered_at[carrier]];
                let (stiffness, damping) = self.jacobian.blocks_mut(free.pair);
                let n = free.free.len();
                add_block(&gathered.block, free, n, (&mut *stiffness, damping));
                // The axis of pitch turns with the yaw.
                let place = |k: usize| free.free.iter().position(|own| *own == k);
                if let (true, Some(pitch), Some(yaw)) = (whole, place(4), place(5)) {
                    let [sine, cosine, _] = self.kinematics[carrier].orientation.axes[1].0;
                    let [x, y, _] = gathered.moment.0;
                    stiffness[pitch * n + yaw] += cosine * x - sine * y;
                }
            }
            let (moves, angles) = (!self.frames[free.body].fixed, free.angles());
            match (whole, moves, angles) {
                (_, true, _) => self.inertia::<12>(number, x),
                (false, ..) | (_, _, 0) => {}
                (.., 1) => self.inertia::<2>(number, x),
                (.., 2) => self.inertia::<4>(number, x),
                _ => self.inertia::<6>(number, x),
            }
        }
    }

    /// Adds the derivatives of connections and of given loads, and writes those of quadratures and internal
    /// states by time; those of the loads stay in `loads`.
    pub(super) fn differentiate_loads(&mut self, x: &[f64], df_dt: &mut [f64]) {
        let [_, speeds, internal, _] = self.layout.split(x);
        let [_, _, d_internal, d_quadratures] = self.layout.split_mut(df_dt);
        for free in &self.free {
            self.loads[free.body] = [0.0; 6];
        }
        for load in &self.applied {
            let [value, rate, _] = load.jet;
            self.loads[load.applied.body][load.applied.coordinate] += rate;
            d_quadratures[WORK] += rate * speeds[load.speed];
            let (_, by_speed) = self.jacobian.row_mut(load.row);
            let first = self.free_number[load.applied.body].map_or(0, |number| self.free[number].offset);
            by_speed[load.speed - first] += value;
        }
        if self.connections.is_empty() {
            return;
        }
        let mut bodies = connection::JacobianInputs {
            positions: &self.positions,
            rates: &self.rates,
            accelerations: &self.accelerations,
            internal,
            jacobian: &mut self.jacobian,
            loads: &mut self.loads,
            d_internal,
            d_quadratures,
        };
        self.connections.differentiate(&mut bodies);
    }

    /// The generalized moments of a body with linearized kinematics by its angles, with which the axes turn
    /// that the moment of its elements is taken about.
    fn rotation_axes(&mut self, number: usize, x: &[f64]) {
        let free = &self.free[number];
        let (coordinates, _) = self.coordinates(free, x);
        let mut q = coordinates.map(Dual::<3>::from);
        for (slot, &k) in free.free[free.translations..].iter().enumerate() {
            q[k] = Dual::variable(coordinates[k], slot);
        }
        let rolls = self.bodies[free.body].rolls();
        let kinematics = Kinematics::new(q, [Dual::from(0.0); 6], rolls);
        let moment = Vector::<Dual<3>>::lift(self.gathered[number].moment);
        let n = free.free.len();
        let (stiffness, _) = self.jacobian.blocks_mut(free.pair);
        for (row, &k) in free.free.iter().enumerate() {
            let component = kinematics.generalized(k, &Vector::zero(), &moment);
            for slot in 0..free.angles() {
                stiffness[row * n + free.translations + slot] += component.derivative[slot];
            }
        }
    }

    /// The inertia of a body by its angles (half of the `D` derivatives) and their rates, with the moment of
    /// its elements, the axes of which turn; with 12 derivatives by all coordinates and rates, which count in
    /// a reference frame that moves.
    fn inertia<const D: usize>(&mut self, number: usize, x: &[f64]) {
        let free = &self.free[number];
        let body = &self.bodies[free.body];
        let (coordinates, speeds) = self.coordinates(free, x);
        let first = if D == 12 { 0 } else { free.translations };
        let seeded = D / 2;
        let (mut q, mut u) = (coordinates.map(Dual::<D>::from), speeds.map(Dual::<D>::from));
        for (slot, &k) in free.free[first..].iter().enumerate() {
            q[k] = Dual::variable(coordinates[k], slot);
            u[k] = Dual::variable(speeds[k], seeded + slot);
        }
        let kinematics = Kinematics::new(q, u, body.rolls());
        let frame = &self.frames[free.body];
        let (force, moment) = kinematics.inertia(
            &free.rigid,
            &frame.motion,
            !frame.fixed,
            self.gravity,
            &self.accelerations[free.body],
        );
        let (force, moment) = (
            -force,
            Vector::<Dual<D>>::lift(self.gathered[number].moment) - moment,
        );
        let n = free.free.len();
        let (stiffness, damping) = self.jacobian.blocks_mut(free.pair);
        for (row, &k) in free.free.iter().enumerate() {
            let component = kinematics.generalized(k, &force, &moment);
            for slot in 0..seeded.min(n - first) {
                let entry = row * n + first + slot;
                stiffness[entry] += component.derivative[slot];
                damping[entry] += component.derivative[seeded + slot];
            }
        }
    }
}

/// Adds the derivatives of one element to those of its bodies and its powers, and of its internal states.
#[inline(always)]
fn differentiate_element<E: Mountable>(
    mounted: &mut Mounted<E>,
    internal: &[f64],
    bodies: &Bodies<'_>,
    gathered: &mut [Gathered],
    jacobian: &mut Partitioned,
) {
    let body: RelativeMotion<f64> = mounted.relative_frame.relative(&bodies.kinematics[mounted.body]);
    let point = mounted.element.marker();
    let (arm, relative) = (body.rotation.apply(point), body.at(point));
    let rates = (&mut mounted.rate_tangents[..], &mut mounted.state_tangent);
    mounted.tangent = mounted
        .element
        .tangent(&mounted.points, &relative, internal, rates);
    let ends = [mounted.body, mounted.on].map(|body| bodies.free_number[body]);
    let [Some(a), b] = ends else {
        return;
    };
    let [at_a, at_b] = [mounted.body, mounted.on].map(|body| bodies.gathered_at[body]);
    let rotation_axes_b = b.map_or(RotationAxes::NONE, |_| gathered[at_b].rotation_axes);
    let rotation_axes_a = gathered[at_a].rotation_axes;
    let on = &bodies.kinematics[mounted.on];
    let chain = Chain::new(mounted, &relative, arm, [&rotation_axes_a, &rotation_axes_b], on);
    let (free_a, n_a) = (&bodies.free[a], bodies.free[a].free.len());
    gathered[at_a].moment += body.rotation.apply_transposed::<f64, f64>(chain.moment_on_a());

    let (mut powers, mut other) = (Powers::NONE, NO_BLOCK);
    chain.by_a(free_a, &mut gathered[at_a].block, &mut other, &mut powers);
    keep_powers(&mounted.rows[0], &powers, n_a, jacobian);
    if let Some(b) = b {
        let (free_b, n_b) = (&bodies.free[b], bodies.free[b].free.len());
        let moment = mounted.marker.rotation.apply(chain.moment_on_b());
        gathered[at_b].moment += moment;
        add_block(&other, free_b, n_a, jacobian.blocks_mut(mounted.pairs[1]));
        let (mut powers, mut other) = (Powers::NONE, NO_BLOCK);
        chain.by_b(free_b, &mut gathered[at_b].block, &mut other, &mut powers);
        add_block(&other, free_a, n_b, jacobian.blocks_mut(mounted.pairs[0]));
        keep_powers(&mounted.rows[1], &powers, n_b, jacobian);
    }
    if mounted.internal_count > 0 {
        for (side, end) in ends.into_iter().flatten().enumerate() {
            keep_rates(mounted, &chain, side, &bodies.free[end], jacobian);
        }
        let free = ends.map(|end| end.map(|end| &bodies.free[end]));
        E::differentiate_internal(mounted, &chain, &relative, &free, jacobian);
    }
}

/// Keeps the derivatives of the powers of an element's dissipation terms, and of the prescribed motion, by
/// one body.
#[inline(always)]
fn keep_powers(rows: &[Option<usize>; 3], powers: &Powers, n: usize, jacobian: &mut Partitioned) {
    for (power, row) in rows.iter().enumerate() {
        if let Some(row) = row {
            let (by_position, by_speed) = jacobian.row_mut(*row);
            let [positions, speeds] = powers.of(power);
            by_position.copy_from_slice(&positions[..n]);
            by_speed.copy_from_slice(&speeds[..n]);
        }
    }
}

/// Keeps the derivatives of the rates of internal states by one body.
#[inline(always)]
fn keep_rates<E>(
    mounted: &Mounted<E>,
    chain: &Chain<'_>,
    side: usize,
    free: &FreeBody,
    jacobian: &mut Partitioned,
) {
    let n = free.free.len();
    let points = mounted.internal_count / 2;
    for (number, columns) in mounted.rate_tangents.iter().enumerate() {
        for j in 0..n {
            let changes = chain
                .others(side, free, j, columns)
                .map(|change| change.map(|c| c.to_array()));
            for i in 0..LANES.min(points - LANES * number) {
                let group = mounted.first_internal / 2 + LANES * number + i;
                let [g_q, g_u, _] = jacobian.side_mut(group, side);
                for row in 0..2 {
                    g_q[row * n + j] = changes[0][row][i];
                    g_u[row * n + j] = changes[1][row][i];
                }
            }
        }
    }
}

/// Keeps the derivatives of the load on a body by an internal state, the first or the second of its pair.
#[inline(always)]
fn keep_force(
    rows: &Rows,
    free: &FreeBody,
    (group, side, state): (usize, usize, usize),
    jacobian: &mut Partitioned,
) {
    let n = free.free.len();
    let [_, _, f_t] = jacobian.side_mut(group, side);
    for (index, target) in f_t[state * n..][..n].iter_mut().enumerate() {
        let (part, component) = free.row(index);
        *target = rows[part].at(component);
    }
}

/// The derivatives by the internal states of a face: of their own rates, of the forces, of the powers.
pub(super) fn differentiate_internal(
    face: &Mounted<ContactFace<Interface>>,
    chain: &Chain<'_>,
    relative: &RelativeMotion<f64>,
    ends: &[Option<&FreeBody>; 2],
    jacobian: &mut Partitioned,
) {
    face.points.internal_derivatives(|point, slopes| {
        let group = face.first_internal / 2 + point;
        *jacobian.internal_mut(group) = slopes.rate;
        let row = face.first_internal_row + 2 * point;
        *jacobian.internal_row_mut(row) = slopes.loss;
        // A point that does not touch pushes nowhere.
        if slopes.force.iter().all(|force| force.0 == [0.0; 3]) {
            return;
        }
        let arm: Vector<f64> = relative.rotation.apply(slopes.position);
        for e in 0..2 {
            let force = slopes.force[e];
            let mut moment: Vector<f64> = arm.cross(force);
            moment.0[2] += face.element.surface.first_arm * force.0[1];
            for (side, free) in ends.iter().flatten().enumerate() {
                keep_force(&chain.load(side, force, moment), free, (group, side, e), jacobian);
            }
            if face.prescribed {
                jacobian.internal_row_mut(row + 1)[e] = face.prescribed_power(relative, force, moment);
            }
        }
    });
}

/// The derivatives by the pair of internal states of an element: of their own rates, of the forces, of the
/// powers.
pub(super) fn differentiate_states(
    mounted: &Mounted<Marked>,
    chain: &Chain<'_>,
    relative: &RelativeMotion<f64>,
    ends: &[Option<&FreeBody>; 2],
    jacobian: &mut Partitioned,
) {
    let (group, row, by) = (
        mounted.first_internal / 2,
        mounted.first_internal_row,
        &mounted.state_tangent,
    );
    let factor = mounted.element.factor[0];
    *jacobian.internal_mut(group) = by.own;
    for (e, column) in by.wrench.iter().enumerate() {
        let (force, moment) = (force_of(column).scale(factor), moment_of(column).scale(factor));
        for (side, free) in ends.iter().flatten().enumerate() {
            keep_force(&chain.load(side, force, moment), free, (group, side, e), jacobian);
        }
        jacobian.internal_row_mut(row)[e] = factor * column[0].at(3);
        if mounted.prescribed {
            jacobian.internal_row_mut(row + 1)[e] = mounted.prescribed_power(relative, force, moment);
        }
        if mounted.energy_terms[1].is_some() {
            jacobian.internal_row_mut(row + 2)[e] = factor * column[1].at(3);
        }
    }
}

impl<E> Mounted<E> {
    /// Returns the power that the prescribed motion of the body under the element delivers against a force
    /// and a moment about marker A, W.
    #[inline(always)]
    pub(super) fn prescribed_power(
        &self,
        relative: &RelativeMotion<f64>,
        force: Vector<f64>,
        moment: Vector<f64>,
    ) -> f64 {
        let about: Vector<f64> = moment + relative.position.cross::<f64, f64>(force);
        let relative_frame = &self.relative_frame;
        relative_frame.marker_velocity.dot::<f64, f64>(force)
            + relative_frame.marker_angular_velocity.dot::<f64, f64>(about)
    }
}

/// The derivatives of the rates of internal states along a change of the relative motion, by point.
pub(super) fn rates_along(rates: &[TangentColumns], change: &Change, d_internal: &mut [f64]) {
    for (columns, target) in rates.iter().zip(d_internal.chunks_mut(2 * LANES)) {
        let [first, second] = columns.along(change).map(|lanes| lanes.to_array());
        for (i, pair) in target.chunks_exact_mut(2).enumerate() {
            (pair[0], pair[1]) = (first[i], second[i]);
        }
    }
}
