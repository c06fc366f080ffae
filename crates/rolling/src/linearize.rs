//! Free vibrations about steady rolling, on straight track and in curves of constant radius.
//!
//! On straight track the Jacobian matrix does not change along the track. In a curve it turns with the
//! heading, and its eigenvalues alone say nothing; in axes that turn along with the track it is constant, and
//! the rotation adds a term
//! ([`System::eigenvalues_turning`](mechanics::system::System::eigenvalues_turning)).
//!
//! Limits: the state must be one of steady rolling (in a curve: what remains of a run when nothing changes
//! any more); no irregularities, no spiral, no grade there.

use mechanics::linear::NoVibration;
use wheelrail::track::{Line, RailLines};

use crate::rig::{RAILS, Rig, WHEELSET};
use crate::wheelset::coordinate;

impl Rig {
    /// Returns the eigenvalues (real and imaginary part, 1/s) of the motion about steady rolling in a state
    /// at a time (s), by falling real part; `shift` (1/s) is a positive number of the size of those that
    /// matter.
    ///
    /// # Errors
    /// They are not found.
    pub fn vibrations(
        &mut self,
        lines: &RailLines,
        time: f64,
        x: &[f64],
        shift: f64,
    ) -> Result<Vec<[f64; 2]>, NoVibration> {
        let seen = self.system.observe(time, x);
        let body = &seen.bodies[WHEELSET];
        let place = self.in_track(body.origin);
        let section = lines.section(Line::Center, place.0);
        // The carriage's speed is that of the center line: steady rolling turns with the heading of the
        // track.
        let along = section.of(self.in_track(body.velocity).0)[0];
        let [_, lateral, _] = section.of([0, 1, 2].map(|i| place.0[i] - section.origin[i]));
        let rate = along * section.curvature / (1.0 - section.curvature * lateral);
        let system = &self.system;
        let pair = |body: usize, [x, y]: [usize; 2]| {
            Some([system.position_of(body, x)?, system.position_of(body, y)?])
        };
        let mut level: Vec<[usize; 2]> = pair(WHEELSET, [coordinate::FORWARD, coordinate::LATERAL])
            .into_iter()
            .collect();
        let rails = RAILS.into_iter().filter(|rail| *rail < seen.bodies.len());
        level.extend(rails.filter_map(|rail| pair(rail, [0, 1])));
        self.system.eigenvalues_turning(time, x, shift, rate, &level)
    }
}
