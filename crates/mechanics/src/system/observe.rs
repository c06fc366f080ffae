//! Derived quantities of a state, for outputs.

use integrate::Problem;

use super::{EnergyTermKind, Mounted, System};
use crate::coil::CoilForce;
use crate::connection::ConnectionState;
use crate::contact::PointContact;
use crate::element::Marked;
use crate::energy::Energies;
use crate::energy_balance::Entries;
use crate::link::RelativeMotion;
use crate::vector::{Matrix, Vector};

/// Pose and motion of a body, in the fixed frame (SI).
#[derive(Clone, Copy, Debug)]
pub struct BodyState {
    /// All six coordinates, relative to the body's reference frame.
    pub coordinates: [f64; 6],
    /// Their rates.
    pub speeds: [f64; 6],
    /// Accelerations of the coordinates of a body with linearized kinematics; zero for others.
    pub accelerations: [f64; 6],
    /// Position of the body's origin.
    pub origin: Vector<f64>,
    /// Displacement of the body's origin from its position at zero motion and zero coordinates.
    pub travel: Vector<f64>,
    /// From body axes to fixed axes.
    pub rotation: Matrix<f64>,
    /// Velocity of the body's origin.
    pub velocity: Vector<f64>,
    /// Angular velocity.
    pub angular_velocity: Vector<f64>,
    /// Position of the center of gravity.
    pub center_of_gravity: Vector<f64>,
}

impl BodyState {
    /// Returns the state of a body with linearized kinematics from its center of gravity in the drawn layout,
    /// coordinates and rates.
    fn linearized(layout: Vector<f64>, coordinates: [f64; 6], speeds: [f64; 6]) -> Self {
        let [x, y, z, roll, pitch, yaw] = coordinates;
        let travel = Vector([x, y, z]);
        Self {
            coordinates,
            speeds,
            accelerations: [0.0; 6],
            origin: layout + travel,
            travel,
            rotation: crate::orientation::fixed([roll, pitch, yaw]),
            velocity: Vector([speeds[0], speeds[1], speeds[2]]),
            angular_velocity: Vector([speeds[3], speeds[4], speeds[5]]),
            center_of_gravity: layout + travel,
        }
    }
}

/// A contact face in the fixed frame's axes (SI).
#[derive(Clone, Debug)]
pub struct FaceState {
    /// Its points, in marker axes.
    pub points: Vec<PointContact<f64>>,
    /// From marker axes to fixed axes.
    pub axes: Matrix<f64>,
    /// Position of the marker's origin.
    pub origin: Vector<f64>,
    /// Position of each point.
    pub point_positions: Vec<Vector<f64>>,
    /// Normal force on the carried body at each point.
    pub normal_forces: Vec<Vector<f64>>,
    /// Friction force on the carried body at each point.
    pub friction_forces: Vec<Vector<f64>>,
    /// Σ F_t·v of the friction forces, W; positive when bristles give back.
    pub friction_power: f64,
    /// Power lost in friction, W; never negative.
    pub friction_loss: f64,
    /// Energy in the contact springs, J.
    pub normal_energy: f64,
    /// Energy in the bristles, J.
    pub bristle_energy: f64,
}

/// A coil.
#[derive(Clone, Copy, Debug)]
pub struct CoilState {
    /// The number of the carried body.
    pub body: usize,
    /// The number of the body with the seat.
    pub on: usize,
    /// Its force and moment, marker axes.
    pub coil: CoilForce<f64>,
    /// Force on the carried body, fixed axes, N.
    pub force: Vector<f64>,
    /// The spring's part of it.
    pub spring_force: Vector<f64>,
    /// The moment about the carried body's origin, fixed axes, N·m.
    pub moment: Vector<f64>,
    /// Stored energy, J.
    pub energy: f64,
}

/// A force element of another kind.
#[derive(Clone, Copy, Debug)]
pub struct ElementState {
    /// Force on the body with marker A, fixed axes, N.
    pub force: Vector<f64>,
    /// The moment about that body's origin, fixed axes, N·m.
    pub moment: Vector<f64>,
    /// Stored energy, J.
    pub energy: f64,
    /// Its internal states, m: zeros of one without.
    pub states: [f64; 2],
}

/// All derived quantities of a state.
#[derive(Clone, Debug)]
pub struct Observation {
    /// Time, s.
    pub time: f64,
    /// All bodies.
    pub bodies: Vec<BodyState>,
    /// All faces.
    pub faces: Vec<FaceState>,
    /// All coils.
    pub coils: Vec<CoilState>,
    /// All other force elements.
    pub elements: Vec<ElementState>,
    /// All connections.
    pub connections: Vec<ConnectionState>,
    /// Energies.
    pub energies: Energies,
    /// Values of the quadratures, J, in the order of [`System::energy_terms`].
    pub quadratures: Vec<f64>,
    /// Work put in, J: of prescribed motions, of the coils' guiding couples, and of elements that do work.
    pub work: f64,
    /// Losses, J.
    pub losses: f64,
}

impl Observation {
    /// Returns the energy that came from nowhere since a start with the stored energy `start` (J) and
    /// quadratures at zero: work of the motions less stored and lost energy. Zero but for the errors of the
    /// integration.
    #[must_use]
    pub fn residual(&self, start: f64) -> f64 {
        self.energies.total() - start - self.work + self.losses
    }
}

impl System {
    /// Returns the energies of an observation for the energy balance of a run, where the stored energy at the
    /// start was `start` (J).
    #[must_use]
    pub fn ledger_entries(&self, seen: &Observation, start: f64) -> Entries {
        let mut entries = Entries {
            work: 0.0,
            losses: 0.0,
            stored_change: seen.energies.total() - start,
            residual: -seen.residual(start),
            admissible: 0.0,
            exchanged: 0.0,
        };
        for (energy_term, value) in self.energy_terms.iter().zip(&seen.quadratures) {
            match energy_term.kind {
                kind if kind.is_work() => entries.work += value,
                // An entry of either sign, which is neither.
                EnergyTermKind::WedgeKinematics => {}
                _ => entries.losses += value,
            }
        }
        entries
    }

    /// Returns all derived quantities of the state `x` at `time`.
    #[must_use]
    pub fn observe(&mut self, time: f64, x: &[f64]) -> Observation {
        self.update_kinematics(time, x);
        let mut bodies = Vec::with_capacity(self.bodies.len());
        self.body_states(x, &mut bodies);
        let mut energies = Energies::default();
        self.observe_linearized(time, x, &mut bodies, &mut energies);
        for (number, (body, body_state)) in self.bodies.iter().zip(&bodies).enumerate() {
            if self.free_number[number].is_some() && !body.linearized {
                let (frame, kinematics) = (&self.frames[number].motion, &self.kinematics[number]);
                energies.kinetic += kinematics.kinetic_energy(body, frame);
                energies.gravity -= body.mass * self.gravity.dot::<f64, f64>(body_state.center_of_gravity);
            }
        }
        let [_, _, internal, quadratures] = self.layout.split(x);
        let faces: Vec<FaceState> = (0..self.faces.len())
            .map(|i| self.face_state(i, internal))
            .collect();
        for face in &faces {
            energies.contact += face.normal_energy;
            energies.bristle += face.bristle_energy;
        }
        let mut coils = Vec::with_capacity(self.coils.len());
        for mounted in &self.coils {
            let relative: RelativeMotion<f64> =
                mounted.relative_frame.relative(&self.kinematics[mounted.body]);
            let coil = mounted.element.on_body(&relative);
            let (axes, _) = self.marker_pose(mounted.on, &mounted.marker);
            let energy = mounted.element.stored_energy(coil.length);
            energies.coil += energy;
            coils.push(CoilState {
                body: mounted.body,
                on: mounted.on,
                coil,
                force: axes.apply(coil.force),
                spring_force: axes.apply(coil.spring_force),
                moment: axes.apply(coil.moment),
                energy,
            });
        }
        let elements = self.elements.iter().map(|own| self.element_state(own, internal));
        let elements: Vec<ElementState> = elements.collect();
        for element in &elements {
            energies.element += element.energy;
        }
        let coordinates = (&self.positions[..], &self.rates[..]);
        let connections = self
            .connections
            .states(&self.bodies, coordinates, internal, &mut energies);
        let (mut work, mut losses) = (0.0, 0.0);
        for (energy_term, value) in self.energy_terms.iter().zip(quadratures) {
            match energy_term.kind {
                kind if kind.is_work() => work += value,
                _ => losses += value,
            }
        }
        Observation {
            work,
            losses,
            time,
            bodies,
            faces,
            coils,
            elements,
            connections,
            energies,
            quadratures: quadratures.to_vec(),
        }
    }

    /// The accelerations of bodies with linearized kinematics, and their kinetic energy and that in the
    /// gravity field, which is zero in the drawn layout.
    fn observe_linearized(
        &mut self,
        time: f64,
        x: &[f64],
        bodies: &mut [BodyState],
        energies: &mut Energies,
    ) {
        if self.free.iter().all(|free| free.linear.is_none()) {
            return;
        }
        let mut dx = vec![0.0; x.len()];
        self.derivative(time, x, &mut dx);
        let [_, accelerations, ..] = self.layout.split(&dx);
        for (body, body_state) in bodies.iter_mut().enumerate() {
            if self.bodies[body].linearized {
                body_state.accelerations = self.accelerations[body];
            }
        }
        for free in &self.free {
            let Some(linear) = &free.linear else { continue };
            let (coordinates, rate) = (&self.positions[free.body], &self.rates[free.body]);
            linear.add_energies(&free.free, coordinates, rate, energies);
            for (j, &k) in free.free.iter().enumerate() {
                bodies[free.body].accelerations[k] = accelerations[free.offset + j];
            }
        }
    }

    /// Calls `each` with the number of each massless wedge's connection and the power of its friction on the
    /// column at `time` and state `x`, W, as in [`System::observe`].
    pub fn column_powers(&mut self, time: f64, x: &[f64], each: impl FnMut(usize, f64)) {
        self.update_kinematics(time, x);
        let coordinates = (&self.positions[..], &self.rates[..]);
        self.connections
            .column_powers(coordinates, self.internal(x), each);
    }

    /// Writes the states of all bodies; the kinematics must be up to date at state `x`.
    pub(super) fn body_states(&self, x: &[f64], out: &mut Vec<BodyState>) {
        out.clear();
        for (number, body) in self.bodies.iter().enumerate() {
            let (frame, kinematics) = (&self.frames[number].motion, &self.kinematics[number]);
            if body.linearized {
                out.push(BodyState::linearized(
                    Vector(body.frame.origin),
                    self.positions[number],
                    self.rates[number],
                ));
                continue;
            }
            let (coordinates, speeds) = match self.free_number[number] {
                Some(free) => self.coordinates(&self.free[free], x),
                None => (body.initial, [0.0; 6]),
            };
            let origin = kinematics.point_position(frame, Vector::zero());
            let (velocity, omega) = kinematics.absolute(frame, Vector::zero());
            out.push(BodyState {
                coordinates,
                speeds,
                accelerations: [0.0; 6],
                origin,
                travel: origin - Vector(body.frame.origin),
                rotation: kinematics.orientation(frame),
                velocity: frame.rotation.apply(velocity),
                angular_velocity: frame.rotation.apply(omega),
                center_of_gravity: kinematics.point_position(frame, Vector(body.center_of_gravity)),
            });
        }
    }

    fn element_state(&self, mounted: &Mounted<Marked>, internal: &[f64]) -> ElementState {
        let body: RelativeMotion<f64> = mounted.relative_frame.relative(&self.kinematics[mounted.body]);
        let states = mounted.states(internal);
        let (wrench, _) = mounted.element.on_body(&body, states);
        let (axes, _) = self.marker_pose(mounted.on, &mounted.marker);
        let (mut force, mut moment): (Vector<f64>, Vector<f64>) =
            (axes.apply(wrench.force), axes.apply(wrench.moment));
        if mounted.element.reversed {
            let origin =
                |body: usize| self.kinematics[body].point_position(&self.frames[body].motion, Vector::zero());
            let arm = origin(mounted.body) - origin(mounted.on);
            (force, moment) = (-force, -(moment + arm.cross::<f64, f64>(force)));
        }
        ElementState {
            force,
            moment,
            energy: self.element_energy(mounted, internal),
            states,
        }
    }

    /// Returns the energy stored in an element of another kind, J.
    pub(super) fn element_energy(&self, mounted: &Mounted<Marked>, internal: &[f64]) -> f64 {
        let body: RelativeMotion<f64> = mounted.relative_frame.relative(&self.kinematics[mounted.body]);
        let marked = &mounted.element;
        marked
            .element
            .energy(&marked.of_marker(&body), mounted.states(internal))
    }

    fn face_state(&self, index: usize, internal: &[f64]) -> FaceState {
        let mounted = &self.faces[index];
        let face = &mounted.element;
        let relative: RelativeMotion<f64> = mounted.relative_frame.relative(&self.kinematics[mounted.body]);
        let deflections = &internal[mounted.first_internal..][..mounted.internal_count];
        let mut points = Vec::with_capacity(face.points.len());
        let sum = face.evaluate(&relative, deflections, |_, contact| points.push(*contact));
        let (axes, origin) = self.marker_pose(mounted.on, &mounted.marker);
        let mut state = FaceState {
            axes,
            origin,
            point_positions: points
                .iter()
                .map(|point| origin + axes.apply::<f64, f64>(point.position))
                .collect(),
            normal_forces: Vec::new(),
            friction_forces: Vec::new(),
            friction_power: 0.0,
            friction_loss: sum.friction_loss,
            normal_energy: 0.0,
            bristle_energy: 0.0,
            points,
        };
        for (i, (contact, point)) in state.points.iter().zip(&face.points).enumerate() {
            let [t1, t2] = contact.friction.force;
            let normal = face
                .surface
                .shape
                .compose(contact.position, [contact.normal, 0.0, 0.0]);
            let friction = face.surface.shape.compose(contact.position, [0.0, t1, t2]);
            state.normal_forces.push(axes.apply(normal));
            state.friction_forces.push(axes.apply(friction));
            state.friction_power += t1 * contact.slip[0] + t2 * contact.slip[1];
            let [pressed, bristle] = face.stored(point, contact.gap, deflections.get(2 * i..2 * i + 2));
            state.normal_energy += pressed;
            state.bristle_energy += bristle;
        }
        state
    }

    /// Returns the axes and origin of a marker in the fixed frame.
    fn marker_pose(&self, on: usize, marker: &crate::link::Marker) -> (Matrix<f64>, Vector<f64>) {
        let (frame, kinematics) = (&self.frames[on].motion, &self.kinematics[on]);
        let orientation: Matrix<f64> = kinematics.orientation(frame);
        (
            orientation.times(marker.rotation),
            kinematics.point_position(frame, marker.origin),
        )
    }

    /// Returns the reaction of an element on the body that it stands on: force and moment about `point`
    /// (fixed frame).
    #[must_use]
    pub fn reaction_about(
        force: Vector<f64>,
        moment: Vector<f64>,
        from: Vector<f64>,
        point: Vector<f64>,
    ) -> (Vector<f64>, Vector<f64>) {
        let lever: Vector<f64> = from - point;
        (-force, -(moment + lever.cross::<f64, f64>(force)))
    }
}
