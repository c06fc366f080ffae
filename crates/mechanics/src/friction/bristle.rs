//! Friction that holds: an elastic bristle in series with a Coulomb slider, in rate form.
//!
//! Equations, with the bristle's deflection e as a state, trial force `T = K e + C v`:
//! - stick, while `|T| ≤ μN`: `F_t = -T`, `ė = v`;
//! - slip: `F_t = -μN d`, `d = T/|T|`, `ė = (μN d - K e)/C`.
//!
//! Both forms agree where `|T| = μN`, so the right-hand side is continuous; it has a kink there. Losses: the
//! dashpot's `C |ė|²` always, and in slip the slider's `μN d·(v - ė) = μN (|T| - μN)/C`; both are never negative.
//! The stored energy `K e²/2` is recoverable. An open contact (N = 0) lets its bristle relax: `ė = -K e/C`.
//!
//! Source: the force accumulators (stiffness and damping) of the industry's wedge elements, in the rate form of a
//! Maxwell-slip element. Units: N, m, s. Defect: under a held load the contact deflects elastically by
//! F/K (no creep); limit: one bristle a point, no Stribeck effect, no rate dependence.

use integrate::scalar::Real;

use super::{Friction, dot};

/// Friction of a point with the friction limit `limit` = μN (N, not negative), tangential velocity (m/s) and
/// bristle deflection (m); `stiffness` in N/m, `damping` in N·s/m.
#[inline(always)]
#[must_use]
pub fn friction<S: Real>(
    limit: S,
    stiffness: f64,
    damping: f64,
    velocity: [S; 2],
    deflection: [S; 2],
) -> Friction<S> {
    let elastic = [deflection[0] * stiffness, deflection[1] * stiffness];
    let flow = 1.0 / damping;
    if limit.value() <= 0.0 {
        let rate = [elastic[0] * -flow, elastic[1] * -flow];
        return Friction {
            rate,
            loss: dot(rate, rate) * damping,
            ..Friction::none()
        };
    }
    let trial = [
        elastic[0] + velocity[0] * damping,
        elastic[1] + velocity[1] * damping,
    ];
    let square = dot(trial, trial);
    let size = square.value().sqrt();
    if size <= limit.value() {
        return Friction {
            force: [-trial[0], -trial[1]],
            rate: velocity,
            loss: dot(velocity, velocity) * damping,
            sticks: true,
            load: size / limit.value(),
        };
    }
    let length = square.sqrt();
    let pull = limit / length;
    let slider = [trial[0] * pull, trial[1] * pull];
    let rate = [(slider[0] - elastic[0]) * flow, (slider[1] - elastic[1]) * flow];
    Friction {
        force: [-slider[0], -slider[1]],
        rate,
        loss: limit * (length - limit) * flow + dot(rate, rate) * damping,
        sticks: false,
        load: if limit.value() > 0.0 {
            size / limit.value()
        } else {
            f64::INFINITY
        },
    }
}
