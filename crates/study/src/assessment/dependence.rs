//! What a verdict depends on: the start of its run, the friction of wheel on rail, the speeds that are asked
//! for.
//!
//! **Start.** What wedges have locked in by friction lasts until they slip, so that a result near a limit may
//! hang on the start of its run. The run that keeps a limit least is computed once more where its margin is
//! within [`NEAR`]: from the equilibrium, or from the shaken car if its own start is another.
//!
//! **Friction.** The same run at the frictions of the request: all coefficients in proportion, so that the
//! greatest has that value. Between these runs the margin is taken as
//! straight; where it is zero the limit is reached. A friction beyond all runs is not guessed.
//!
//! **Speeds.** Beside the worst run of all stands that of the speeds of the regime alone
//! ([`refined`](super::refined) adds others).
//!
//! NEAR is a choice.

use car::{ProfiledWheels, StartKind, Wheels};
use serde::Serialize;
use wheelrail::contact::{ContactLaw, CreepLaw};

use super::{Assessment, LimitVerdict};
use crate::car::CarCase;
use crate::car::locked_in::name;
use crate::models::AnyCase;
use crate::records::{self, Record, Status};
use crate::vehicle::VehicleCase;

/// Margin, in parts of the limit, up to which a result is near it, kept or not.
pub const NEAR: f64 = 0.15;
/// Frictions that are no different.
const SAME: f64 = 0.02;

/// What a run has otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Another start.
    Start,
    /// Another friction of wheel on rail: the greatest coefficient.
    Friction(f64),
}

/// A run again, with one thing changed.
#[derive(Clone, Debug)]
pub struct Varied {
    /// Its number.
    pub run: u64,
    /// The changed thing, before and after.
    pub changed: Changed,
    /// What came of it.
    pub record: Record,
}

/// What is changed, before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Changed {
    /// The start, by its names.
    Start([&'static str; 2]),
    /// The greatest coefficient of friction.
    Friction([f64; 2]),
}

/// A value with the verdict on it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// The measured value, in the limit's unit; `None` if that run has none.
    pub value: Option<f64>,
    /// Its margin, in parts of the limit.
    pub margin: Option<f64>,
    /// `kept` or `exceeded`, `unknown` without a value.
    pub verdict: &'static str,
    /// The reason for a value that is missing, or the derailment; may be empty.
    pub note: String,
}

/// The same run from another start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherStart {
    /// The start of the run itself: `equilibrium`, `nominal` or `shaken`.
    pub own_start: String,
    /// The other one.
    pub start: String,
    /// What came of it.
    #[serde(flatten)]
    pub judged: Judged,
}

/// The same run at another friction of wheel on rail.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherFriction {
    /// The greatest coefficient.
    pub friction: f64,
    /// What came of it.
    #[serde(flatten)]
    pub judged: Judged,
}

/// A limit over the friction of wheel on rail.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OverFriction {
    /// The greatest coefficient of the run itself.
    pub own: f64,
    /// The run at others, rising.
    pub others: Vec<OtherFriction>,
    /// The friction at which the limit is reached, straight between runs; `None`: not between them.
    pub reached: Option<f64>,
}

/// What a verdict depends on.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Dependence {
    /// The worst run from another start, where it is near the limit.
    pub other_start: Option<OtherStart>,
    /// The worst run at other frictions.
    pub friction: Option<OverFriction>,
}

/// Returns the runs to compute again, each once with each change.
#[must_use]
pub fn wanted(verdicts: &[LimitVerdict], frictions: &[f64]) -> Vec<(u64, Change)> {
    let mut wanted = Vec::new();
    for (most, changes) in [
        (NEAR, vec![Change::Start]),
        (
            f64::INFINITY,
            frictions.iter().map(|own| Change::Friction(*own)).collect(),
        ),
    ] {
        let worst = verdicts.iter().filter_map(|own| own.worst.as_ref());
        let near = worst.filter(|own| own.margin.abs() <= most && !own.until_derailed);
        let mut runs: Vec<u64> = near.map(|own| own.run).collect();
        runs.sort_unstable();
        runs.dedup();
        for run in runs {
            wanted.extend(changes.iter().map(|change| (run, *change)));
        }
    }
    wanted
}

/// Gives wheels another friction, that of the rail where it is greatest; `None` if that changes nothing.
fn rubbed(wheels: &mut ProfiledWheels, other: f64) -> Option<Changed> {
    let creeps = |law: &ContactLaw| !matches!(law.creep, CreepLaw::Frictionless | CreepLaw::Linear);
    let own = wheels.laws.iter().filter(|law| creeps(law));
    let own = own.flat_map(|law| law.friction.all()).fold(0.0, f64::max);
    if own <= 0.0 || (own - other).abs() < SAME {
        return None;
    }
    for law in wheels.laws.iter_mut() {
        law.friction = law.friction.scaled(other / own);
    }
    Some(Changed::Friction([own, other]))
}

impl Assessment {
    /// Computes a run of it, by its number and its case, with a change; `None` where that changes nothing: a
    /// car on linear wheels has one start and no friction, a vehicle one start.
    #[must_use]
    pub fn varied(&self, run: u64, case: &AnyCase, change: Change) -> Option<Varied> {
        let (case, changed): (AnyCase, Changed) = match (case, change) {
            (AnyCase::Car(own), _) => {
                let mut case = CarCase::clone(own);
                let Wheels::OnRails(wheels) = &mut case.parameters.wheels else {
                    return None;
                };
                let changed = match change {
                    Change::Start => {
                        let own = case.parameters.start.kind;
                        let other = match own {
                            StartKind::Shaken => StartKind::Equilibrium,
                            StartKind::Equilibrium | StartKind::Nominal => StartKind::Shaken,
                        };
                        case.parameters.start.kind = other;
                        Changed::Start([own, other].map(name))
                    }
                    Change::Friction(other) => rubbed(wheels, other)?,
                };
                (case.into(), changed)
            }
            (AnyCase::Vehicle(own), Change::Friction(other)) => {
                let mut case = VehicleCase::clone(own);
                let changed = rubbed(&mut case.description.on_track.as_mut()?.wheels, other)?;
                (case.into(), changed)
            }
            _ => return None,
        };
        let record = records::run_case(&self.study, run, &case);
        Some(Varied { run, changed, record })
    }

    /// Notes what came of varied runs beside the verdicts whose worst runs they are.
    pub fn note(&self, verdicts: &mut [LimitVerdict], varied: &[Varied]) {
        for own in verdicts {
            let Some(worst) = own.worst.as_ref() else { continue };
            let again = varied.iter().filter(|varied| varied.run == worst.run);
            let mut over: Option<OverFriction> = None;
            for varied in again {
                let judged = self.judged(own.limit, &varied.record);
                match varied.changed {
                    Changed::Start(names) if worst.margin.abs() <= NEAR => {
                        let [own_start, start] = names.map(str::to_owned);
                        own.depends.other_start = Some(OtherStart {
                            own_start,
                            start,
                            judged,
                        });
                    }
                    Changed::Friction([own, friction]) => {
                        let over = over.get_or_insert_with(|| OverFriction {
                            own,
                            others: Vec::new(),
                            reached: None,
                        });
                        over.others.push(OtherFriction { friction, judged });
                    }
                    Changed::Start(_) => {}
                }
            }
            if let Some(over) = &mut over {
                over.others.sort_by(|a, b| a.friction.total_cmp(&b.friction));
                over.reached = over.reached(worst.margin);
            }
            own.depends.friction = over;
        }
    }

    /// Judges a record by a limit.
    fn judged(&self, limit: usize, record: &Record) -> Judged {
        let limit = &self.limits.limits[limit];
        let known = |name: &str| self.study.measures().get(&record.measures, name);
        let usable = matches!(record.status, Status::Complete | Status::Derailed);
        let measured = known(limit.measure.name).filter(|own| usable && own.is_finite());
        let value = measured.map(|own| limit.in_unit(own));
        let allowed = limit.number(&known);
        let margin = value
            .zip(allowed)
            .map(|(value, allowed)| limit.margin(value, allowed));
        Judged {
            value,
            margin,
            verdict: match (record.status, margin) {
                (Status::Derailed, _) => "exceeded",
                (_, Some(margin)) => verdict(margin),
                (_, None) => "unknown",
            },
            note: record.reason.clone(),
        }
    }
}

impl OverFriction {
    /// Returns the friction at which the limit is reached, of several the nearest one to that of the run,
    /// whose margin this is.
    fn reached(&self, margin: f64) -> Option<f64> {
        let others = self.others.iter();
        let mut points: Vec<[f64; 2]> = others
            .filter_map(|own| Some([own.friction, own.judged.margin?]))
            .collect();
        points.push([self.own, margin]);
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let pairs = points.windows(2).filter_map(|pair| {
            let ([x, y], [x1, y1]) = (pair[0], pair[1]);
            ((y < 0.0) != (y1 < 0.0)).then(|| x + (x1 - x) * y / (y - y1))
        });
        pairs.min_by(|a, b| (a - self.own).abs().total_cmp(&(b - self.own).abs()))
    }

    /// Returns the least and the greatest friction that was looked at.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        let others = || self.others.iter().map(|own| own.friction);
        [
            others().fold(self.own, f64::min),
            others().fold(self.own, f64::max),
        ]
    }

    /// Returns it in words; `word` is the verdict on the run itself.
    #[must_use]
    pub fn words(&self, word: &str) -> String {
        let from = self
            .others
            .iter()
            .map(|own| own.friction)
            .fold(self.own, f64::min);
        let to = self
            .others
            .iter()
            .map(|own| own.friction)
            .fold(self.own, f64::max);
        let derailed = self.others.iter().find(|own| own.judged.margin.is_none());
        match (self.reached, derailed) {
            (Some(reached), _) => format!("reached at a friction of {reached:.2}"),
            (None, Some(own)) => format!("{} at a friction of {}", own.judged.verdict, own.friction),
            (None, None) => format!("{word} at frictions from {from} to {to}"),
        }
    }
}

impl OtherStart {
    /// Returns it in words; `value` (of the run itself) and `unit` are those of the limit.
    #[must_use]
    pub fn words(&self, value: f64, unit: &str) -> String {
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        let judged = &self.judged;
        let other = match (judged.value, judged.margin) {
            (Some(value), Some(margin)) => {
                let margin = 100.0 * margin;
                format!("{value:.3}{unit} (margin {margin:.1} %, {})", judged.verdict)
            }
            _ => judged.verdict.to_owned(),
        };
        let note = match judged.note.as_str() {
            "" => String::new(),
            note => format!(": {note}"),
        };
        format!(
            "{value:.3}{unit} with start.kind = \"{}\", {other} with \"{}\"{note}",
            self.own_start, self.start
        )
    }
}

impl LimitVerdict {
    /// Returns what would turn the verdict, in words: the speeds, the start, the friction; none if nothing
    /// that was looked at does.
    #[must_use]
    pub fn turned_by(&self) -> Vec<&'static str> {
        let word = self.word();
        let mut by = Vec::new();
        if self.asked.as_ref().is_some_and(|own| verdict(own.margin) != word) {
            by.push("speeds");
        }
        let turns = |own: &str| own != word && own != "unknown";
        if self
            .depends
            .other_start
            .as_ref()
            .is_some_and(|own| turns(own.judged.verdict))
        {
            by.push("start");
        }
        let frictions = self.depends.friction.iter().flat_map(|own| &own.others);
        if frictions.into_iter().any(|own| turns(own.judged.verdict)) {
            by.push("friction");
        }
        by
    }
}

/// Returns the verdict on a margin.
fn verdict(margin: f64) -> &'static str {
    if margin >= 0.0 { "kept" } else { "exceeded" }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(own: f64, others: &[(f64, f64)]) -> OverFriction {
        let judged = |margin: f64| Judged {
            value: Some(0.0),
            margin: Some(margin),
            verdict: verdict(margin),
            note: String::new(),
        };
        let others = others.iter().map(|(friction, margin)| OtherFriction {
            friction: *friction,
            judged: judged(*margin),
        });
        OverFriction {
            own,
            others: others.collect(),
            reached: None,
        }
    }

    #[test]
    fn analytic_friction_at_which_a_limit_is_reached() {
        let own = over(0.4, &[(0.3, 0.3), (0.5, -0.05)]);
        assert!((own.reached(0.1).unwrap() - (0.4 + 0.1 * 0.1 / 0.15)).abs() < 1e-12);
        // Two places: the nearer one.
        let own = over(0.4, &[(0.1, -0.1), (0.3, 0.1), (0.5, -0.1)]);
        assert!((own.reached(0.1).unwrap() - 0.45).abs() < 1e-12);
        assert_eq!(over(0.4, &[(0.3, 0.3), (0.5, 0.01)]).reached(0.1), None);
        assert_eq!(over(0.4, &[]).reached(0.1), None);
    }
}
