//! What is seen of a vehicle: numbers with names, units and meanings, each a function of an observation.

use std::borrow::Cow;

use mechanics::channel::{self, Sight};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::output::Column;
use mechanics::system::{Observation, System};
use mechanics::vector::{Matrix, Vector};
use quantity::Kind;

/// A state of a vehicle, as channels see it.
#[derive(Clone, Copy, Debug)]
pub struct View<'v> {
    /// The observation.
    pub seen: &'v Observation,
    /// Rates of the state there (`integrate::Problem::derivative`), of which accelerations are read.
    pub rates: &'v [f64],
    /// The system.
    pub system: &'v System,
}

/// The sight of vehicles: [`View`].
#[derive(Debug)]
pub struct Whole;

impl Sight for Whole {
    type At<'v> = View<'v>;
}

/// Channels of a vehicle.
pub type Channels = channel::Channels<Whole>;

/// Returns a column whose components are along the fixed axes.
pub(crate) fn column(name: String, kind: Kind, text: String) -> Column {
    Column {
        reference: Cow::Borrowed("nominal layout"),
        ..Column::new(name, kind, "fixed: x forward, y to the left, z up", text)
    }
}

impl View<'_> {
    /// Returns the pose of a marker in fixed axes: place (m) and axes.
    fn pose(&self, (body, marker): (usize, Marker)) -> (Vector<f64>, Matrix<f64>, Vector<f64>) {
        let own = &self.seen.bodies[body];
        let arm: Vector<f64> = own.rotation.apply(marker.origin);
        (own.origin + arm, own.rotation.times(marker.rotation), arm)
    }

    /// Returns the motion of marker A relative to marker B, as elements see it.
    #[must_use]
    pub fn relative(&self, a: (usize, Marker), b: (usize, Marker)) -> RelativeMotion<f64> {
        let [(place_a, axes_a, arm_a), (place_b, axes_b, arm_b)] = [self.pose(a), self.pose(b)];
        let velocity = |body: usize, arm: Vector<f64>| {
            let own = &self.seen.bodies[body];
            own.velocity + own.angular_velocity.cross::<f64, f64>(arm)
        };
        let spin = self.seen.bodies[b.0].angular_velocity;
        let way = place_a - place_b;
        let closing = velocity(a.0, arm_a) - velocity(b.0, arm_b) - spin.cross::<f64, f64>(way);
        let turning = self.seen.bodies[a.0].angular_velocity - spin;
        RelativeMotion {
            position: axes_b.apply_transposed(way),
            rotation: axes_b.transpose().times(axes_a),
            velocity: axes_b.apply_transposed(closing),
            angular_velocity: axes_b.apply_transposed(turning),
        }
    }

    /// Returns the acceleration of a body's free coordinate (0 to 5), m/s² or rad/s²; zero of others.
    #[must_use]
    pub fn acceleration(&self, body: usize, coordinate: usize) -> f64 {
        let place = self.system.position_of(body, coordinate);
        place.map_or(0.0, |place| self.rates[self.system.layout().speeds + place])
    }
}
