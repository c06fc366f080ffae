//! Free rolling of a loaded wheelset: the spin of its axle at which the rails' forces exert no torque on it.
//!
//! An axle that nothing drives or brakes turns at that speed. Of a wheelset in the middle of the track it is
//! the speed over the rolling radius, where the wheels touch; of a shifted one the longitudinal forces of its
//! wheels are equal and opposite, as far as their radii are equal. Torque falls as the spin grows: faster
//! wheels push the rails backward.

use crate::contact::{ContactLaw, CreepLaw, Side};
use crate::loaded::{Attitude, LoadError, check};
use crate::wheelset::RigidWheelset;

/// Share of the spin by which the first interval reaches beyond it on both sides; it is doubled until its
/// ends have torques of both signs.
const FIRST: f64 = 0.005;
/// Largest such share.
const LAST: f64 = 0.9;
/// Torque that counts as none, as a share of load times nominal radius.
const NONE: f64 = 1e-9;
/// Most steps towards the zero.
const STEPS: usize = 80;

impl RigidWheelset {
    /// Returns the pitch rate (rad/s, negative forward) at which the wheelset rolls freely: the forces of
    /// both rails, each wheel under its vertical load (N), make no torque about the axle. The pitch rate of
    /// the attitude does not count.
    ///
    /// Without friction, or off both rails, every spin is free: it is then the speed over the nominal radius.
    ///
    /// # Errors
    /// As [`RigidWheelset::loaded`], or no spin within 90 % of the speed over the nominal radius is free.
    pub fn free_rolling(&self, attitude: &Attitude, load: f64, law: &ContactLaw) -> Result<f64, LoadError> {
        let at = |pitch_rate: f64| Attitude {
            pitch_rate,
            ..*attitude
        };
        check(&at(0.0), load, law)?;
        let usual = attitude.speed / self.nominal_radius();
        if law.friction.is_zero() || law.creep == CreepLaw::Frictionless {
            return Ok(-usual);
        }
        let torque = |spin: f64| -> Result<f64, LoadError> {
            let attitude = at(-spin);
            let left = self.loaded(Side::Left, &attitude, load, law)?;
            let right = self.loaded(Side::Right, &attitude, load, law)?;
            Ok(left.torque + right.torque)
        };
        let enough = NONE * load * self.nominal_radius();
        let mut share = FIRST;
        let (mut slow, mut fast) = loop {
            let [slow, fast] = [usual * (1.0 - share), usual * (1.0 + share)];
            let ends = ([slow, torque(slow)?], [fast, torque(fast)?]);
            let torques = [ends.1[1], ends.0[1]];
            if torques.iter().all(|own| own.abs() <= enough) {
                return Ok(-usual);
            }
            if torques[0] <= 0.0 && torques[1] >= 0.0 {
                break ends;
            }
            if share >= LAST {
                return Err(LoadError::NoFreeRolling {
                    fastest: -fast,
                    slowest: -slow,
                    torques,
                });
            }
            share = (2.0 * share).min(LAST);
        };
        // False position; where an end stays, its value is halved (Illinois), and every eighth step bisects.
        let mut found = usual;
        for step in 0..STEPS {
            found = match step % 8 == 7 {
                true => 0.5 * (slow[0] + fast[0]),
                false => slow[0] + (fast[0] - slow[0]) * slow[1] / (slow[1] - fast[1]),
            };
            let rest = torque(found)?;
            if rest.abs() <= enough || fast[0] - slow[0] < 1e-14 * usual {
                break;
            }
            if rest > 0.0 {
                slow = [found, rest];
                fast[1] *= 0.5;
            } else {
                fast = [found, rest];
                slow[1] *= 0.5;
            }
        }
        Ok(-found)
    }
}
