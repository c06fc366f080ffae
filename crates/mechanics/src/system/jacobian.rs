//! The Jacobian, element by element, by forward differentiation of the same lines that give the forces.
//!
//! What enters the speed rows is the residual `Q(q, u) - M(q) u˙ - b(q, u)` at fixed accelerations, so that the change of M with the
//! coordinates is included. Inertia depends on angles alone where the reference frame stands still: one pass with derivatives by
//! them and their rates. Elements on prescribed neighbours that do not turn answer with their response ([`super::rows`]); for
//! the others one pass a free body, whose positions and speeds are seeded, everything else being constant, and one more, with a
//! single derivative, for the explicit dependence on time.

use integrate::lanes::Lanes;
use integrate::partitioned::Partitioned;
use integrate::scalar::{Dual, Real};

use super::forces::{Action, Element};
use super::rows::{Columns, add_columns, respond};
use super::{FrameState, FreeBody, Mounted, System};
use crate::body::{Body, Kinematics};
use crate::contact::ContactFace;
use crate::frame::FrameMotion;
use crate::link::{Relative, Sight};
use crate::surface::Plane;
use crate::vector::{Matrix, Vector};

/// What a pass needs to see.
struct Scene<'s> {
    bodies: &'s [Body],
    frames: &'s [FrameState],
    kinematics: &'s [Kinematics<f64>],
    free: &'s [FreeBody],
    free_number: &'s [Option<usize>],
    gravity: Vector<f64>,
}

impl System {
    /// The Jacobian (if `whole`; else without what inertia adds by the angles, some thousandth of what contacts add) at the state that [`System::place`] was called with, where the rates are `dx`.
    pub(super) fn differentiate(&mut self, x: &[f64], dx: &[f64], whole: bool) {
        let layout = self.layout;
        let [_, _, internal, _] = layout.split(x);
        self.meet();
        for free in &self.free {
            for (j, &k) in free.free.iter().enumerate() {
                self.accelerations[free.body][k] = dx[layout.speeds + free.offset + j];
            }
        }
        let scene = Scene {
            bodies: &self.bodies,
            frames: &self.frames,
            kinematics: &self.kinematics,
            free: &self.free,
            free_number: &self.free_number,
            gravity: self.gravity,
        };
        self.jacobian.clear();
        for face in &mut self.faces {
            let deflections = &internal[face.first_internal..][..face.internal_count];
            face.element.linearize(&mut face.points, deflections);
        }
        for (number, free) in self.free.iter().enumerate() {
            let kinematics = &self.kinematics[free.body];
            let mass = self.jacobian.mass_mut(number);
            kinematics.mass_matrix(&self.bodies[free.body], &free.free, mass);
            let turning = kinematics.turning(&free.free);
            let mut carried = Vector::zero();
            let mut columns: Columns = [[[Lanes::ZERO; 2]; 6]; 2];
            for &face in &free.faces {
                let face = &mut self.faces[face];
                if face.plain && face.points.are_active() {
                    carried += respond(face, kinematics, &turning, free);
                    face.add_rows(free, &mut columns, &mut self.jacobian);
                    face.add_rates(free, &mut self.jacobian);
                }
            }
            for &coil in &free.coils {
                let coil = &mut self.coils[coil];
                if coil.plain {
                    carried += respond(coil, kinematics, &turning, free);
                    coil.add_rows(free, &mut columns, &mut self.jacobian);
                }
            }
            add_columns(&columns, free, &mut self.jacobian);
            let coordinates = self.coordinates(free, x);
            let pass = Pass {
                scene: &scene,
                number,
                coordinates,
                accelerations: &self.accelerations[free.body],
                faces: &self.faces,
                coils: &self.coils,
            };
            let jacobian = &mut self.jacobian;
            if whole && scene.frames[free.body].fixed {
                match free.angles() {
                    0 => pass.inertia::<0>(&carried, jacobian),
                    1 => pass.inertia::<2>(&carried, jacobian),
                    2 => pass.inertia::<4>(&carried, jacobian),
                    _ => pass.inertia::<6>(&carried, jacobian),
                }
            }
            if !free.plain {
                match free.free.len() {
                    1 => pass.run::<2>(jacobian),
                    2 => pass.run::<4>(jacobian),
                    3 => pass.run::<6>(jacobian),
                    4 => pass.run::<8>(jacobian),
                    5 => pass.run::<10>(jacobian),
                    _ => pass.run::<12>(jacobian),
                }
            }
        }
        for face in &self.faces {
            if face.internal_count > 0 {
                differentiate_internal(face, &scene, &mut self.jacobian);
            }
        }
    }
}

/// One pass: the derivatives by one body's positions and speeds.
struct Pass<'s> {
    scene: &'s Scene<'s>,
    number: usize,
    coordinates: ([f64; 6], [f64; 6]),
    accelerations: &'s [f64; 6],
    faces: &'s [Mounted<ContactFace<Plane>>],
    coils: &'s [Mounted<crate::coil::Coil>],
}

/// Force and moment on the seeded body.
struct Load<const N: usize> {
    force: Vector<Dual<N>>,
    moment: Vector<Dual<N>>,
}

impl Pass<'_> {
    fn run<const N: usize>(&self, jacobian: &mut Partitioned) {
        let free = &self.scene.free[self.number];
        let body = &self.scene.bodies[free.body];
        let n = free.free.len();
        let mut coordinates = self.coordinates.0.map(Dual::<N>::from);
        let mut speeds = self.coordinates.1.map(Dual::<N>::from);
        for (j, &k) in free.free.iter().enumerate() {
            coordinates[k] = Dual::variable(self.coordinates.0[k], j);
            speeds[k] = Dual::variable(self.coordinates.1[k], n + j);
        }
        let kinematics = Kinematics::new(coordinates, speeds, body.rolls());
        let mut load = Load {
            force: Vector::zero(),
            moment: Vector::zero(),
        };
        for &face in &free.faces {
            if !self.faces[face].plain {
                self.element(&self.faces[face], &kinematics, &mut load, jacobian);
            }
        }
        for &coil in &free.coils {
            if !self.coils[coil].plain {
                self.element(&self.coils[coil], &kinematics, &mut load, jacobian);
            }
        }
        let frame = &self.scene.frames[free.body];
        if !frame.fixed {
            let gravity = self.scene.gravity;
            let (force, moment) =
                kinematics.inertia(&free.rigid, &frame.motion, true, gravity, self.accelerations);
            load.force += -force;
            load.moment += -moment;
        }
        let blocks = jacobian.blocks_mut(free.pair);
        add_rows(&kinematics, &free.free, n, &load.force, &load.moment, blocks);
    }

    /// The inertia of a body in a frame at rest, by its angles (half of the `D` derivatives) and their rates, with the moment of plain
    /// elements (body axes), the axes of which turn.
    fn inertia<const D: usize>(&self, carried: &Vector<f64>, jacobian: &mut Partitioned) {
        let free = &self.scene.free[self.number];
        let body = &self.scene.bodies[free.body];
        let mut coordinates = self.coordinates.0.map(Dual::<D>::from);
        let mut speeds = self.coordinates.1.map(Dual::<D>::from);
        let (n, angles) = (free.free.len(), D / 2);
        for (slot, &k) in free.free[free.translations..].iter().enumerate() {
            coordinates[k] = Dual::variable(self.coordinates.0[k], slot);
            speeds[k] = Dual::variable(self.coordinates.1[k], angles + slot);
        }
        let kinematics = Kinematics::new(coordinates, speeds, body.rolls());
        let frame = &self.scene.frames[free.body].motion;
        let (force, moment) =
            kinematics.inertia(&free.rigid, frame, false, self.scene.gravity, self.accelerations);
        let (force, moment) = (-force, Vector::<Dual<D>>::lift(*carried) - moment);
        let (stiffness, damping) = jacobian.blocks_mut(free.pair);
        for (row, &k) in free.free.iter().enumerate() {
            let component = kinematics.generalized(k, &force, &moment);
            for slot in 0..angles {
                let entry = row * n + free.translations + slot;
                stiffness[entry] += component.derivative[slot];
                damping[entry] += component.derivative[angles + slot];
            }
        }
    }

    /// Adds the derivatives of one element that touches the seeded body.
    #[inline(always)]
    fn element<E: Element, const N: usize>(
        &self,
        mounted: &Mounted<E>,
        seeded: &Kinematics<Dual<N>>,
        load: &mut Load<N>,
        jacobian: &mut Partitioned,
    ) {
        let scene = self.scene;
        let free = &scene.free[self.number];
        let n = free.free.len();
        let carries = mounted.body == free.body;
        let side = usize::from(!carries);
        let mut keep_rates = |point: usize, rates: [[f64; 2]; N]| {
            let [g_q, g_u, _] = jacobian.side_mut(mounted.first_internal / 2 + point, side);
            for row in 0..2 {
                for j in 0..n {
                    g_q[row * n + j] = rates[j][row];
                    g_u[row * n + j] = rates[n + j][row];
                }
            }
        };
        let action: Action<Dual<N>>;
        let drive;
        if carries {
            let sight = &mounted.sight;
            let relative = sight.relative(seeded);
            action = mounted
                .element
                .change(&mounted.points, &relative, &mut keep_rates);
            let (force, moment) = action.on_body(sight, seeded);
            load.force += force;
            load.moment += moment;
            if let (true, Some(on)) = (mounted.on_free, scene.free_number[mounted.on]) {
                let kinematics = &scene.kinematics[mounted.on];
                let (force, moment) = action.reaction(&relative, kinematics, &mounted.mount);
                let blocks = jacobian.blocks_mut(mounted.pairs[1]);
                add_rows(kinematics, &scene.free[on].free, n, &force, &moment, blocks);
            }
            drive = mounted.driven.then(|| action.drive_power(&relative, sight));
        } else {
            let (a, b) = (
                &scene.frames[mounted.body].motion,
                &scene.frames[mounted.on].motion,
            );
            let sight = Sight::new(&lift_frame(a), &lift_frame(b), seeded, &mounted.mount);
            let kinematics = &scene.kinematics[mounted.body];
            let relative = sight.relative(kinematics);
            action = mounted
                .element
                .change(&mounted.points, &relative, &mut keep_rates);
            let (force, moment) = action.on_body(&sight, kinematics);
            if let Some(number) = scene.free_number[mounted.body] {
                let blocks = jacobian.blocks_mut(mounted.pairs[0]);
                add_rows(kinematics, &scene.free[number].free, n, &force, &moment, blocks);
            }
            let (force, moment) = action.reaction(&relative, seeded, &mounted.mount);
            load.force += force;
            load.moment += moment;
            drive = None;
        }
        let powers = [Some(action.powers[0]), Some(action.powers[1]), drive];
        for (row, power) in mounted.rows[side].iter().zip(powers) {
            if let (Some(row), Some(power)) = (row, power) {
                let (p_q, p_u) = jacobian.row_mut(*row);
                p_q.copy_from_slice(&power.derivative[..n]);
                p_u.copy_from_slice(&power.derivative[n..2 * n]);
            }
        }
    }
}

/// Adds the derivatives of the generalized forces by the seeded body's `n` positions and speeds to a block pair.
#[inline(always)]
fn add_rows<K: Real, const N: usize>(
    kinematics: &Kinematics<K>,
    free: &[usize],
    n: usize,
    force: &Vector<Dual<N>>,
    moment: &Vector<Dual<N>>,
    (stiffness, damping): (&mut [f64], &mut [f64]),
) where
    Kinematics<K>: Generalize<Dual<N>>,
{
    for (row, &k) in free.iter().enumerate() {
        let component = kinematics.component(k, force, moment);
        let (k_row, d_row) = (&mut stiffness[row * n..][..n], &mut damping[row * n..][..n]);
        for j in 0..n {
            k_row[j] += component.derivative[j];
            d_row[j] += component.derivative[n + j];
        }
    }
}

/// Generalized forces of a force and a moment that carry derivatives.
trait Generalize<S> {
    fn component(&self, k: usize, force: &Vector<S>, moment: &Vector<S>) -> S;
}

impl<const N: usize> Generalize<Dual<N>> for Kinematics<Dual<N>> {
    #[inline(always)]
    fn component(&self, k: usize, force: &Vector<Dual<N>>, moment: &Vector<Dual<N>>) -> Dual<N> {
        self.generalized(k, force, moment)
    }
}

impl<const N: usize> Generalize<Dual<N>> for Kinematics<f64> {
    #[inline(always)]
    fn component(&self, k: usize, force: &Vector<Dual<N>>, moment: &Vector<Dual<N>>) -> Dual<N> {
        if k < 3 {
            force.0[k]
        } else {
            self.turn.axes[k - 3].dot(*moment)
        }
    }
}

/// The derivatives by the internal states of a face: of their own rates, of the forces, of the powers.
fn differentiate_internal(face: &Mounted<ContactFace<Plane>>, scene: &Scene<'_>, jacobian: &mut Partitioned) {
    let relative: Relative<f64> = face.sight.relative(&scene.kinematics[face.body]);
    face.points.internal_slopes(|point, slopes| {
        let group = face.first_internal / 2 + point;
        *jacobian.internal_mut(group) = slopes.rate;
        let row = face.first_internal_row + 2 * point;
        *jacobian.internal_row_mut(row) = slopes.loss;
        for e in 0..2 {
            let arm: Vector<f64> = relative.rotation.apply(slopes.place);
            let action = Action {
                force: slopes.force[e],
                moment: arm.cross(slopes.force[e]),
                powers: [0.0; 2],
            };
            let mut keep = |side: usize, number: usize, (force, moment): (Vector<f64>, Vector<f64>)| {
                let free = &scene.free[number];
                let kinematics = &scene.kinematics[free.body];
                let n = free.free.len();
                let [_, _, f_t] = jacobian.side_mut(group, side);
                for (target, &k) in f_t[e * n..][..n].iter_mut().zip(&free.free) {
                    *target = kinematics.generalized(k, &force, &moment);
                }
            };
            if let Some(number) = scene.free_number[face.body] {
                keep(
                    0,
                    number,
                    action.on_body(&face.sight, &scene.kinematics[face.body]),
                );
            }
            if let Some(number) = scene.free_number[face.on] {
                keep(
                    1,
                    number,
                    action.reaction(&relative, &scene.kinematics[face.on], &face.mount),
                );
            }
            if face.driven {
                jacobian.internal_row_mut(row + 1)[e] = action.drive_power(&relative, &face.sight);
            }
        }
    });
}

fn lift_frame<const N: usize>(motion: &FrameMotion<f64>) -> FrameMotion<Dual<N>> {
    FrameMotion {
        position: Vector::lift(motion.position),
        rotation: Matrix::lift(motion.rotation),
        velocity: Vector::lift(motion.velocity),
        angular_velocity: Vector::lift(motion.angular_velocity),
        acceleration: Vector::lift(motion.acceleration),
        angular_acceleration: Vector::lift(motion.angular_acceleration),
    }
}
