//! Speeds between those of a regime: about the one at which the least is left to a limit.
//!
//! A resonance is narrower than the steps of a regime's speeds. A car in twist and roll shows 3.7° at 20 mph
//! and 4.0° at 18: a verdict on the given speeds alone hangs on their grid. So more runs are made of each
//! regime in each condition, at most [`MOST`], where the worst speed and the ones beside it are more than
//! [`FINEST`] apart: half way to the farther one (both count as at most [`WIDE`] away, so that a regime's
//! coarse end does not draw all runs; of equal ones to the worse). They end early where all runs are within 2
//! % of the limit, or both neighbors some 2 mph away are. The numbers are choices.
//!
//! Limits: of each limit one worst speed is looked at, of that with the least margin first; a second
//! resonance between two other speeds stays unseen. A regime in which a wheel leaves its rail is not refined:
//! no limit is kept there.

use quantity::{Kind, Quantity};

use super::{Assessed, Assessment};
use crate::case::CaseError;
use crate::models::AnyCase;
use crate::records::{self, Status};

/// Most runs that a regime in a condition is given.
pub const MOST: usize = 6;
/// Distance of speeds at which it ends: 0.5 mph, m/s.
pub const FINEST: f64 = 0.5 * MILE_PER_HOUR;
/// Largest distance of speeds that counts: 4 mph, m/s.
pub const WIDE: f64 = 4.0 * MILE_PER_HOUR;
/// Difference of margins that is none, in parts of the limit, between speeds nearer than 2.1 mph, m/s.
const SAME: f64 = 0.02;
const NEAR: f64 = 2.1 * MILE_PER_HOUR;
/// Share of a speed by which distances are taken for equal.
const ROUNDING: f64 = 1e-6;
const MILE_PER_HOUR: f64 = 0.447_04;

/// A speed (m/s) and the least margin of a run at it, in parts of the limit.
pub type Known = (f64, f64);

/// Returns the next speed to look at, m/s; `known` are in order of their speeds. `None` if there is nothing
/// more to see.
#[must_use]
pub fn next(known: &[Known]) -> Option<f64> {
    if known.iter().any(|(_, margin)| *margin == f64::NEG_INFINITY) {
        return None;
    }
    let worst = (0..known.len()).min_by(|a, b| known[*a].1.total_cmp(&known[*b].1))?;
    let (speed, margin) = known[worst];
    let beside = [worst.checked_sub(1), Some(worst + 1)].map(|place| known.get(place?).copied());
    let gap = |own: Option<Known>| own.map_or(0.0, |(other, _)| (other - speed).abs());
    let gaps = beside.map(gap);
    let same = |own: &Known| (own.1 - margin).abs() < SAME;
    let near = gaps.iter().all(|own| *own < NEAR);
    if known.iter().all(same) || near && beside.iter().flatten().all(same) {
        return None;
    }
    let wide = gaps.map(|own| own.min(WIDE));
    let same = (wide[0] - wide[1]).abs() < ROUNDING * speed;
    let towards = match same {
        true => {
            let margins = beside.map(|own| own.map_or(f64::INFINITY, |(_, margin)| margin));
            usize::from(margins[1] < margins[0])
        }
        false => usize::from(wide[1] > wide[0]),
    };
    let step = 0.5 * wide[towards];
    let sign = [-1.0, 1.0][towards];
    (wide[towards] > FINEST * (1.0 + ROUNDING)).then_some(speed + sign * step)
}

/// A run at a speed that no regime names.
#[derive(Clone, Debug)]
pub struct Refined {
    /// Its car.
    pub case: AnyCase,
    /// What came of it.
    pub assessed: Assessed,
}

impl Assessment {
    /// Returns the speeds that the regimes in their conditions are to be looked at next (regime, condition,
    /// speed in m/s), `runs` being known.
    #[must_use]
    pub fn next_speeds(&self, runs: &[Assessed]) -> Vec<(usize, usize, f64)> {
        let mut next_ones = Vec::new();
        for regime in 0..self.regimes.len() {
            for condition in 0..self.conditions.len() {
                let own = || {
                    let own = runs.iter();
                    own.filter(move |run| run.regime == regime && run.condition == condition)
                };
                let whole = own().all(|run| run.derailed || run.status == Status::Complete.name());
                if !whole || own().filter(|run| run.refined).count() >= MOST {
                    continue;
                }
                // The limit of which least is left comes first.
                let mut known: Vec<Vec<Known>> = vec![Vec::new(); self.limits.limits.len()];
                for run in own() {
                    for check in &run.checks {
                        let margin = if run.derailed {
                            Some(f64::NEG_INFINITY)
                        } else {
                            check.margin
                        };
                        known[check.limit].extend(margin.map(|margin| (run.speed_si, margin)));
                    }
                }
                let least = |own: &Vec<Known>| own.iter().map(|own| own.1).fold(f64::INFINITY, f64::min);
                known.sort_by(|a, b| least(a).total_cmp(&least(b)));
                let speed = known.iter_mut().find_map(|own| {
                    own.sort_by(|a, b| a.0.total_cmp(&b.0));
                    next(own)
                });
                next_ones.extend(speed.map(|speed| (regime, condition, speed)));
            }
        }
        next_ones
    }

    /// Runs a regime in a condition at a speed (m/s); the run has no number yet.
    ///
    /// # Errors
    /// The car cannot pass the regime at this speed.
    pub fn run_at(&self, (regime, condition, speed): (usize, usize, f64)) -> Result<Refined, CaseError> {
        // Hundredths of a mile an hour are more than a speed has.
        let speed = format!("{} mph", (speed / MILE_PER_HOUR * 100.0).round() / 100.0);
        let mut request = self.request.clone();
        request.speeds = Quantity::parse_as(&speed, Kind::TravelSpeed)
            .into_iter()
            .collect();
        let alone = Self::with(
            request,
            // The car is that of the other runs, whatever its file has become meanwhile.
            (self.study.source().case.clone(), self.base.clone()),
            self.limits.clone(),
            (
                vec![self.regimes[regime].clone()],
                vec![self.conditions[condition].clone()],
            ),
        )?;
        let case = alone.study.case(0)?;
        let record = records::run_case(&alone.study, 0, &case);
        let mut assessed = alone.assess(&alone.study.values(0), &record);
        (assessed.regime, assessed.condition) = (regime, condition);
        assessed.refined = true;
        Ok(Refined { case, assessed })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks at a margin over the speed (mph) from these speeds on; returns the worst speed, its margin, and
    /// the number of runs that were added.
    fn refined(from: &[f64], margin: impl Fn(f64) -> f64) -> (f64, f64, usize) {
        let mut known: Vec<Known> = from
            .iter()
            .map(|own| (own * MILE_PER_HOUR, margin(*own)))
            .collect();
        let mut added = 0;
        while let Some(speed) = next(&known).filter(|_| added < MOST) {
            known.push((speed, margin(speed / MILE_PER_HOUR)));
            known.sort_by(|a, b| a.0.total_cmp(&b.0));
            added += 1;
        }
        let worst = known.iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        (worst.0 / MILE_PER_HOUR, worst.1, added)
    }

    /// Resonances of 1.5 mph half width and more, wherever they stand between the speeds of twist and roll:
    /// the peak within 5 %, its speed within a quarter of a mile an hour, with twelve runs.
    #[test]
    fn analytic_a_resonance_between_the_speeds_is_found() {
        let speeds = [12.0, 16.0, 20.0, 30.0, 50.0, 70.0];
        for width in [1.5, 3.0] {
            for step in 0..=16 {
                let peak = 14.0 + 0.375 * f64::from(step);
                let roll = |speed: f64| 1.0 + 5.0 / (1.0 + ((speed - peak) / width).powi(2));
                let (speed, margin, added) = refined(&speeds, |speed| 1.0 - roll(speed) / 6.0);
                let found = 6.0 * (1.0 - margin);
                assert!(added <= MOST, "{added}");
                assert!(found > 0.95 * 6.0, "{width} {peak}: {found} at {speed}");
                assert!((speed - peak).abs() <= 0.26, "{width} {peak}: {speed}");
            }
        }
    }

    #[test]
    fn limits_nothing_to_see() {
        // Flat, one speed, derailed, the worst at an end.
        assert_eq!(refined(&[20.0, 40.0, 60.0], |_| 0.5).2, 0);
        assert_eq!(refined(&[20.0], |_| 0.5).2, 0);
        assert_eq!(next(&[(1.0, 0.2), (2.0, f64::NEG_INFINITY)]), None);
        assert_eq!(next(&[]), None);
        let (speed, _, added) = refined(&[20.0, 40.0, 60.0], |speed| 1.0 - speed / 60.0);
        assert_eq!(speed, 60.0);
        assert!((1..=MOST).contains(&added), "{added}");
    }
}
