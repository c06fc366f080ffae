//! The stored energies of a state, without other derived quantities.

use super::{Linear, System, scales};
use crate::energy::Energies;
use crate::link::RelativeMotion;
use crate::vector::Vector;

impl System {
    /// Returns the stored energies at `time` (s) and state `x`, J: the same bits as in [`System::observe`],
    /// without all the rest, and without allocation if there are no connections.
    #[must_use]
    pub fn energies(&mut self, time: f64, x: &[f64]) -> Energies {
        self.update_kinematics(time, x);
        let mut energies = Energies::default();
        for free in &self.free {
            if let Some(linear) = &free.linear {
                let (coordinates, rate) = (&self.positions[free.body], &self.rates[free.body]);
                linear.add_energies(&free.free, coordinates, rate, &mut energies);
                continue;
            }
            let (body, frame) = (&self.bodies[free.body], &self.frames[free.body].motion);
            let kinematics = &self.kinematics[free.body];
            let center = kinematics.point_position(frame, Vector(body.center_of_gravity));
            energies.kinetic += kinematics.kinetic_energy(body, frame);
            energies.gravity -= body.mass * self.gravity.dot::<f64, f64>(center);
        }
        let [_, _, internal, _] = self.layout.split(x);
        for mounted in &self.faces {
            let face = &mounted.element;
            let relative: RelativeMotion<f64> =
                mounted.relative_frame.relative(&self.kinematics[mounted.body]);
            let deflections = &internal[mounted.first_internal..][..mounted.internal_count];
            // By face first, in the order of the sums of `observe`.
            let (mut contact, mut bristle) = (0.0, 0.0);
            for (i, point) in face.points.iter().enumerate() {
                let gap = face.geometry(point, &relative).gap;
                let own = face.stored(point, gap, deflections.get(2 * i..2 * i + 2));
                contact += own[0];
                bristle += own[1];
            }
            energies.contact += contact;
            energies.bristle += bristle;
        }
        for mounted in &self.coils {
            let relative: RelativeMotion<f64> =
                mounted.relative_frame.relative(&self.kinematics[mounted.body]);
            let coil = mounted.element.on_body(&relative);
            energies.coil += mounted.element.stored_energy(coil.length);
        }
        for mounted in &self.elements {
            energies.element += self.element_energy(mounted, internal);
        }
        if !self.connections.is_empty() {
            let coordinates = (&self.positions[..], &self.rates[..]);
            self.connections
                .states(&self.bodies, coordinates, internal, &mut energies);
        }
        energies
    }

    /// Returns the energy by which errors of the speeds of all free bodies as large as their
    /// [scales] would change the kinetic energy to first order, J: the sum of `m |v|` times the scale of
    /// velocities and of `|I ω|` times that of angular velocities. Times the relative tolerance it is what
    /// the integrator may err by in a step. No element's state matters, and it allocates nothing.
    pub fn energy_of_speed_errors(&mut self, time: f64, x: &[f64]) -> f64 {
        self.update_kinematics(time, x);
        let mut energy = 0.0;
        for free in &self.free {
            if let Some(linear) = &free.linear {
                let rate = &self.rates[free.body];
                for (inertia, &k) in linear.inertia.iter().zip(&free.free) {
                    let scale = if k < 3 {
                        scales::VELOCITY
                    } else {
                        scales::ANGULAR_VELOCITY
                    };
                    energy += scale * inertia * rate[k].abs();
                }
                continue;
            }
            let (body, frame) = (&self.bodies[free.body], &self.frames[free.body].motion);
            let kinematics = &self.kinematics[free.body];
            let (velocity, omega) = kinematics.absolute(frame, Vector(body.center_of_gravity));
            let w: Vector<f64> = kinematics.orientation.rotation.apply_transposed(omega);
            let spin = Vector([0, 1, 2].map(|k| body.inertia[k] * w.0[k]));
            energy += scales::VELOCITY * body.mass * velocity.dot::<f64, f64>(velocity).sqrt();
            energy += scales::ANGULAR_VELOCITY * spin.dot::<f64, f64>(spin).sqrt();
        }
        energy
    }
}

impl Linear {
    /// Adds the kinetic energy of a body with linearized kinematics, and that in the gravity field, which is
    /// zero in the drawn layout.
    pub(super) fn add_energies(
        &self,
        free: &[usize],
        coordinates: &[f64; 6],
        rate: &[f64; 6],
        energies: &mut Energies,
    ) {
        for (j, &k) in free.iter().enumerate() {
            energies.kinetic += 0.5 * self.inertia[j] * rate[k] * rate[k];
            energies.gravity -= self.weight[j] * coordinates[k];
        }
    }
}
