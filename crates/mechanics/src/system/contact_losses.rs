//! Powers lost at single contact points, without other derived quantities.

use super::System;
use crate::link::RelativeMotion;

impl System {
    /// Writes the powers lost at each contact point at `time` (s) and state `x`, W: in friction, and in
    /// contact damping. Those of the points of a face sum to what the face's dissipation terms integrate
    /// ([`System::energy_terms`]), but for rounding.
    ///
    /// # Panics
    /// If `losses` is shorter than [`System::point_count`].
    pub fn contact_losses(&mut self, time: f64, x: &[f64], losses: &mut [[f64; 2]]) {
        self.update_kinematics(time, x);
        let [_, _, internal, _] = self.layout.split(x);
        for (number, face) in self.faces.iter().enumerate() {
            let target = &mut losses[self.points_of(number)];
            let relative: RelativeMotion<f64> = face.relative_frame.relative(&self.kinematics[face.body]);
            let deflections = &internal[face.first_internal..][..face.internal_count];
            face.element.evaluate(&relative, deflections, |point, contact| {
                target[point] = [contact.friction.loss, contact.damping_loss];
            });
        }
    }
}
