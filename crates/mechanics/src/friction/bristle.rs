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
//! **At the end of an implicit stage** of length h the deflection follows from velocity and friction limit
//! alone (a return map): with the deflection `b` from which the stage begins,
//! `e = b + h v` if that sticks; else `e = (b + a μN d)/(1 + a K)`, `a = h/C`, `d` along
//! `K b/(1 + a K) + C v`.
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

/// Returns the deflection (m) that solves `e = base + duration · ė` with the rate of [`friction`] at the
/// velocity; `duration` in s.
#[inline(always)]
pub(crate) fn settled<S: Number>(
    limit: S,
    stiffness: S::Plain,
    damping: S::Plain,
    velocity: [S; 2],
    base: [S; 2],
    duration: f64,
) -> [S; 2] {
    let one = S::Plain::from(1.0);
    let flow = S::Plain::from(duration) / damping;
    let shrinks = one / (one + flow * stiffness);
    let both = |of: &dyn Fn(usize) -> S| [of(0), of(1)];
    let stick = both(&|k| base[k] + velocity[k] * duration);
    let trial = both(&|k| stick[k].by(stiffness) + velocity[k].by(damping));
    let pull = both(&|k| base[k].by(stiffness * shrinks) + velocity[k].by(damping));
    let size = dot(pull, pull).sqrt();
    let sticks = dot(trial, trial).at_most((limit * limit).plain());
    // Where nothing pulls, the slider takes nothing.
    let pulled = S::Plain::zero().below(size.plain());
    let slider = S::blend(pulled, limit / size, S::zero());
    let slip = both(&|k| (base[k] + (pull[k] * slider).by(flow)).by(shrinks));
    both(&|k| S::blend(sticks, stick[k], slip[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deflection against the rate of the law there, where it sticks, slips, turns and is open.
    #[test]
    fn analytic_a_settled_deflection_solves_its_stage() {
        let (stiffness, damping, duration) = (4e7, 2e3, 1e-3);
        for (limit, velocity, base) in [
            (1e4, [0.01, 0.02], [1e-5, -2e-5]),
            (1e4, [0.5, -0.2], [1e-5, -2e-5]),
            (1e4, [-0.5, 0.0], [2e-4, 1e-4]),
            (0.0, [0.5, 0.1], [2e-4, 1e-4]),
            (1e4, [0.0, 0.0], [0.0, 0.0]),
            (1e4, [0.0, 0.0], [3e-4, 0.0]),
        ] {
            let found = settled(limit, stiffness, damping, velocity, base, duration);
            let rate = friction(limit, stiffness, damping, velocity, found).rate;
            for k in 0..2 {
                let residual = base[k] + duration * rate[k] - found[k];
                assert!(
                    residual.abs() < 1e-15,
                    "{limit} {velocity:?} {base:?}: {residual}"
                );
            }
        }
    }
}
