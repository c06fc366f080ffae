//! Linear vibrations of a vehicle about its rest.

use mechanics::linear::NoVibration;
use rolling::wheelset::coordinate;

use crate::assemble::Vehicle;

/// A vibration: an eigenvalue of the linearized equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration {
    /// Growth of its amplitude, 1/s: negative if it dies out.
    pub growth: f64,
    /// Angular frequency, rad/s.
    pub frequency: f64,
}

impl Vibration {
    /// Returns the damping ratio: negative if it grows.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        -self.growth / libm::hypot(self.growth, self.frequency)
    }
}

/// A number of the size of the frequencies that matter, 1/s.
const SHIFT: f64 = 20.0;
/// Frequencies below this are none, rad/s.
const SLOWEST: f64 = 1e-6;

impl Vehicle {
    /// Returns its vibrations about its rest, or about the nominal layout if it starts there, the slowest
    /// first: those of all eigenvalues that have a frequency. Elements act as they do there: what is open or
    /// has clearance does not count. What bodies say of their start has no part in it.
    ///
    /// # Errors
    /// The equations cannot be linearized there.
    pub fn vibrations(&mut self) -> Result<Vec<Vibration>, NoVibration> {
        let state = self.rest.clone();
        self.vibrations_about(&state)
    }

    /// Takes a state in which it rolls steadily as that about which it vibrates: with the displacements of
    /// `x` and with wheels rolling as there; all bodies move forward as at its rest before, and nothing else
    /// moves; bristles are undeflected.
    pub fn settle(&mut self, x: &[f64]) {
        let layout = self.system.layout();
        let before = std::mem::replace(&mut self.rest, x.to_vec());
        let states = self.system.element_states(x);
        self.rest[layout.speeds..].fill(0.0);
        self.system.set_element_states(&states, &mut self.rest);
        let rate_of = |body: usize, k: usize| Some(layout.speeds + self.system.position_of(body, k)?);
        for (body, forward) in &self.running {
            if let Some(rate) = rate_of(*body, *forward) {
                self.rest[rate] = before[rate];
            }
        }
        for axle in &self.axles {
            let rates = [coordinate::FORWARD, coordinate::SPIN].map(|k| rate_of(axle.body, k));
            if let [Some(forward), Some(spin)] = rates {
                self.rest[spin] = x[spin] * before[forward] / x[forward];
            }
        }
    }

    /// Returns its vibrations where it rolls steadily at another speed, by so many times that of its rest.
    ///
    /// # Errors
    /// As [`Vehicle::vibrations`].
    pub fn vibrations_at(&mut self, times: f64) -> Result<Vec<Vibration>, NoVibration> {
        let mut state = self.rest.clone();
        let speeds = self.system.layout().speeds;
        for rate in &mut state[speeds..2 * speeds] {
            *rate *= times;
        }
        self.vibrations_about(&state)
    }

    fn vibrations_about(&mut self, state: &[f64]) -> Result<Vec<Vibration>, NoVibration> {
        let found = self.system.eigenvalues(0.0, state, SHIFT)?;
        let own = found.into_iter().filter(|[_, frequency]| *frequency > SLOWEST);
        let mut own: Vec<Vibration> = own
            .map(|[growth, frequency]| Vibration { growth, frequency })
            .collect();
        own.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        Ok(own)
    }
}
