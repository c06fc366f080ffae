//! Relative motions that elements see at a time and a state, for observers that need positions only,
//! without allocation.

use super::System;
use crate::link::RelativeMotion;

impl System {
    /// Brings all bodies and elements to `time` (s) and state `x`; the functions below then refer to them.
    pub(crate) fn place_at(&mut self, time: f64, x: &[f64]) {
        self.update_kinematics(time, x);
    }

    /// Returns the motion of the body with the points of a face relative to the face's surface.
    pub(crate) fn face_relative(&self, face: usize) -> RelativeMotion<f64> {
        let mounted = &self.faces[face];
        mounted.relative_frame.relative(&self.kinematics[mounted.body])
    }

    /// Returns the length of a coil, m.
    pub(crate) fn coil_length(&self, coil: usize) -> f64 {
        let mounted = &self.coils[coil];
        let relative: RelativeMotion<f64> = mounted.relative_frame.relative(&self.kinematics[mounted.body]);
        let place = relative.at(mounted.element.end).position;
        place.dot::<f64, f64>(place).sqrt()
    }

    /// Returns the weight of a body, N.
    pub(crate) fn weight(&self, body: usize) -> f64 {
        self.bodies[body].mass * self.gravity.dot::<f64, f64>(self.gravity).sqrt()
    }

    /// Returns the number of force elements of other kinds.
    pub(crate) fn element_count(&self) -> usize {
        self.elements.len()
    }

    /// Returns the name of a force element of another kind.
    pub(crate) fn element_name(&self, element: usize) -> &str {
        self.elements[element].element.element.name()
    }

    /// Returns the distance between the markers of a force element of another kind, m.
    pub(crate) fn element_distance(&self, element: usize) -> f64 {
        let mounted = &self.elements[element];
        let relative: RelativeMotion<f64> = mounted.relative_frame.relative(&self.kinematics[mounted.body]);
        let place = relative.at(mounted.element.marker.origin).position;
        place.dot::<f64, f64>(place).sqrt()
    }

    /// Returns the coordinates of a body with linearized kinematics, m and rad.
    pub(crate) fn linearized_coordinates(&self, body: usize) -> &[f64; 6] {
        &self.positions[body]
    }

    /// Calls `each` with the number of a connection with a coil behind a massless wedge, and the deflection
    /// of that coil, m (extension positive).
    pub(crate) fn wedge_coil_deflections(&self, x: &[f64], each: impl FnMut(usize, f64)) {
        let coordinates = (&self.positions[..], &self.rates[..]);
        self.connections
            .coil_deflections(coordinates, self.internal(x), each);
    }
}
