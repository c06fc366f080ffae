//! Friction that holds: an elastic bristle in series with a Coulomb slider, in rate form.
//!
//! Equations, with the bristle's deflection e as a state, trial force `T = K e + C v`:
//! - stick, while `|T| ≤ μN`: `F_t = -T`, `ė = v`;
//! - slip: `F_t = -μN d`, `d = T/|T|`, `ė = (μN d - K e)/C`.
//!
//! Both forms agree where `|T| = μN`, so the right-hand side is continuous; its derivative is discontinuous
//! there. Losses: the dashpot's `C |ė|²` always, and in slip the slider's `μN d·(v - ė) = μN (|T| - μN)/C`;
//! both are never negative. The stored energy `K e²/2` is recoverable. An open contact (N = 0) lets its
//! bristle relax: `ė = -K e/C`.
//!
//! Source: the force accumulators (stiffness and damping) of the industry's wedge elements, in the rate form
//! of a Maxwell-slip element. Units: N, m, s. Defect: under a held load the contact deflects elastically by
//! F/K (no creep); limit: one bristle a point, no Stribeck effect, no rate dependence.

use numerics::scalar::{Number, choose};

use super::{Friction, dot};

/// Returns the friction of a point with the friction limit `limit` = μN (N, not negative), tangential
/// velocity (m/s) and bristle deflection (m); `stiffness` in N/m, `damping` in N·s/m.
#[inline(always)]
#[must_use]
pub fn friction<S: Number>(
    limit: S,
    stiffness: S::Plain,
    damping: S::Plain,
    velocity: [S; 2],
    deflection: [S; 2],
) -> Friction<S> {
    let elastic = [deflection[0].by(stiffness), deflection[1].by(stiffness)];
    let flow = S::Plain::from(1.0) / damping;
    let open = || {
        let rate = [elastic[0].by(-flow), elastic[1].by(-flow)];
        Friction {
            rate,
            loss: dot(rate, rate).by(damping),
            ..Friction::none()
        }
    };
    let closed = || {
        let trial = [
            elastic[0] + velocity[0].by(damping),
            elastic[1] + velocity[1].by(damping),
        ];
        let square = dot(trial, trial);
        let size = square.plain().sqrt();
        let load = size / limit.plain();
        let stick = || Friction {
            force: [-trial[0], -trial[1]],
            rate: velocity,
            loss: dot(velocity, velocity).by(damping),
            load,
        };
        let slip = || {
            let length = square.sqrt();
            let pull = limit / length;
            let slider = [trial[0] * pull, trial[1] * pull];
            let rate = [
                (slider[0] - elastic[0]).by(flow),
                (slider[1] - elastic[1]).by(flow),
            ];
            Friction {
                force: [-slider[0], -slider[1]],
                rate,
                loss: (limit * (length - limit)).by(flow) + dot(rate, rate).by(damping),
                load,
            }
        };
        choose(size.at_most(limit.plain()), stick, slip)
    };
    choose(limit.at_most(S::Plain::zero()), open, closed)
}
