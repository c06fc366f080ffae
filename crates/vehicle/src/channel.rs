//! What is seen of a vehicle: numbers with names, units and meanings, each a function of an observation.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

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

/// Channels that are read together: their columns, and how their values are read, SI.
#[derive(Clone)]
pub struct Channels {
    /// Of each its name, kind, axes, meaning.
    pub columns: Vec<Column>,
    read: Arc<Reading>,
}

/// Appends the values of channels.
type Reading = dyn Fn(&View<'_>, &mut Vec<f64>) + Send + Sync;

impl fmt::Debug for Channels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Channels")
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

impl Channels {
    /// Returns channels of which one reading appends the values, in the order of the columns.
    pub fn new(
        columns: Vec<Column>,
        read: impl Fn(&View<'_>, &mut Vec<f64>) + Send + Sync + 'static,
    ) -> Self {
        Self {
            columns,
            read: Arc::new(read),
        }
    }

    /// Returns one channel by itself.
    pub fn single(column: Column, read: impl Fn(&View<'_>) -> f64 + Send + Sync + 'static) -> Self {
        Self::new(vec![column], move |view, row| row.push(read(view)))
    }

    /// Appends the values, SI.
    pub fn read(&self, view: &View<'_>, row: &mut Vec<f64>) {
        (self.read)(view, row);
    }
}

/// Returns a column whose components are along the fixed axes.
pub(crate) fn column(name: String, kind: Kind, text: String) -> Column {
    Column {
        name,
        kind,
        frame: Cow::Borrowed("fixed: x forward, y to the left, z up"),
        reference: Cow::Borrowed("nominal layout"),
        text,
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
