//! Wrenches of the elements on the bodies with marker A, along fixed axes, without other derived quantities.
//!
//! [`System::observe`] gives the same for every point, and all energies, at four times the cost. Nothing is
//! allocated after the first use of [`SystemLoads`].

use super::forces::Mountable;
use super::observe::{BodyState, CoilState, FaceState};
use super::{CLOSING_GAP, ContactState, Mounted, STICK_LOAD, System};
use crate::body::Kinematics;
use crate::contact::{ContactFace, Interface};
use crate::link::RelativeMotion;
use crate::vector::Vector;

/// Wrench of a face on the body with its points (SI, fixed axes).
#[derive(Clone, Copy, Debug)]
pub struct FaceLoad {
    /// Normal force.
    pub normal: Vector<f64>,
    /// Friction force.
    pub friction: Vector<f64>,
    /// Moment of both about the body's center of gravity.
    pub moment: Vector<f64>,
    /// Position of the face's origin.
    pub origin: Vector<f64>,
}

/// Wrench of a coil on the body with its end (SI, fixed axes).
#[derive(Clone, Copy, Debug)]
pub struct CoilLoad {
    /// The spring's part of the force.
    pub spring: Vector<f64>,
    /// The force.
    pub force: Vector<f64>,
    /// The moment about the body's origin.
    pub moment: Vector<f64>,
}

/// States of all bodies, and the wrenches on those with marker A.
#[derive(Clone, Debug, Default)]
pub struct SystemLoads {
    /// All bodies.
    pub bodies: Vec<BodyState>,
    /// All faces.
    pub faces: Vec<FaceLoad>,
    /// All coils.
    pub coils: Vec<CoilLoad>,
    /// Rates of the internal states of a face, which are discarded.
    rates: Vec<f64>,
}

impl FaceState {
    /// Returns the same as [`System::loads`], by sums over the points; `center` is the center of gravity of
    /// the carried body.
    #[must_use]
    pub fn load(&self, center: Vector<f64>) -> FaceLoad {
        let mut load = FaceLoad {
            normal: Vector::zero(),
            friction: Vector::zero(),
            moment: Vector::zero(),
            origin: self.origin,
        };
        let forces = self.normal_forces.iter().zip(&self.friction_forces);
        for (position, (normal, friction)) in self.point_positions.iter().zip(forces) {
            let (force, arm): (Vector<f64>, Vector<f64>) = (*normal + *friction, *position - center);
            load.normal += *normal;
            load.friction += *friction;
            load.moment += arm.cross(force);
        }
        load
    }

    /// Returns the state of the whole face without a history: it slips where one of its points does, else
    /// sticks where one does.
    #[must_use]
    pub fn contact_state(&self) -> ContactState {
        let mut pressed = self
            .points
            .iter()
            .filter(|point| point.gap < CLOSING_GAP)
            .peekable();
        if pressed.peek().is_none() {
            ContactState::Open
        } else if pressed.any(|point| point.friction.load >= STICK_LOAD[1]) {
            ContactState::Slip
        } else {
            ContactState::Stick
        }
    }
}

impl CoilState {
    /// Returns the same as [`System::loads`].
    #[must_use]
    pub fn load(&self) -> CoilLoad {
        CoilLoad {
            spring: self.spring_force,
            force: self.force,
            moment: self.moment,
        }
    }
}

impl System {
    /// Computes the wrenches of all elements on the bodies with marker A at `time` and state `x`.
    pub fn loads(&mut self, time: f64, x: &[f64], out: &mut SystemLoads) {
        self.update_kinematics(time, x);
        self.body_states(x, &mut out.bodies);
        let [_, _, internal, _] = self.layout.split(x);
        out.faces.clear();
        for number in 0..self.faces.len() {
            let mounted = &mut self.faces[number];
            let kinematics = &self.kinematics[mounted.body];
            let internal = &internal[mounted.first_internal..][..mounted.internal_count];
            out.rates.clear();
            out.rates.resize(mounted.internal_count, 0.0);
            let wrench = if mounted.plain {
                let ends = (&mounted.relative_frame, kinematics);
                mounted
                    .element
                    .body_wrench_of_frame(&mut mounted.points, ends, internal, &mut out.rates)
            } else {
                let relative: RelativeMotion<f64> = mounted.relative_frame.relative(kinematics);
                mounted
                    .element
                    .body_wrench(&mut mounted.points, &relative, internal, &mut out.rates)
            };
            let (mounted, kinematics) = (&self.faces[number], &self.kinematics[self.faces[number].body]);
            let [normal, first, second] = wrench.force.0;
            let (normal, friction) = if mounted.points.is_curved() {
                let normal = normal_force(mounted, kinematics, internal);
                (normal, wrench.force - normal)
            } else {
                (Vector([normal, 0.0, 0.0]), Vector([0.0, first, second]))
            };
            let normal = self.along_fixed_axes(mounted, normal);
            let friction = self.along_fixed_axes(mounted, friction);
            let body = &out.bodies[mounted.body];
            let lever: Vector<f64> = body.center_of_gravity - body.origin;
            let moment: Vector<f64> = body.rotation.apply(wrench.moment);
            let (frame, seat) = (&self.frames[mounted.on].motion, &self.kinematics[mounted.on]);
            out.faces.push(FaceLoad {
                normal,
                friction,
                moment: moment - lever.cross::<f64, f64>(normal + friction),
                origin: seat.point_position(frame, mounted.marker.origin),
            });
        }
        self.points_updated = true;
        out.coils.clear();
        for mounted in &self.coils {
            let relative: RelativeMotion<f64> =
                mounted.relative_frame.relative(&self.kinematics[mounted.body]);
            let coil = mounted.element.on_body(&relative);
            out.coils.push(CoilLoad {
                spring: self.along_fixed_axes(mounted, coil.spring_force),
                force: self.along_fixed_axes(mounted, coil.force),
                moment: self.along_fixed_axes(mounted, coil.moment),
            });
        }
    }

    /// Returns a vector in fixed axes, given in the axes of an element's marker B.
    #[inline(always)]
    fn along_fixed_axes<E>(&self, mounted: &Mounted<E>, vector: Vector<f64>) -> Vector<f64> {
        let own: Vector<f64> = mounted.relative_frame.rotation.apply_transposed(vector);
        self.frames[mounted.body].motion.rotation.apply(own)
    }
}

/// Returns the sum of the normal forces of a face whose normals differ from point to point, marker axes.
fn normal_force(
    mounted: &Mounted<ContactFace<Interface>>,
    kinematics: &Kinematics<f64>,
    deflections: &[f64],
) -> Vector<f64> {
    let face = &mounted.element;
    let relative: RelativeMotion<f64> = mounted.relative_frame.relative(kinematics);
    let mut sum = Vector::zero();
    face.evaluate(&relative, deflections, |_, contact| {
        sum += face
            .surface
            .shape
            .compose(contact.position, [contact.normal, 0.0, 0.0]);
    });
    sum
}
