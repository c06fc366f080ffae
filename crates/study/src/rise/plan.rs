//! Which runs a survey makes next, given those that are known.
//!
//! Stages, each of which ends before the next one begins; after each batch the first one with something to
//! do comes again:
//!
//! 1. no rise and the highest one, at all speeds of each regime;
//! 2. the grid of rises at the speeds that leave least to a limit there (all speeds if the whole grid is
//!    asked for);
//! 3. brackets: at the speed that reaches a limit first, rises between down to a sixteenth of an inch; at
//!    others that may reach it lower, the rise just below;
//! 4. speeds half way to those beside the worst one, at the rise that is just kept, or that leaves least
//!    where less than half of the limit is left;
//! 5. each other level alone, on the [`GOVERNING`] questions whose limits are reached first, to an eighth
//!    of an inch;
//! 6. the worst two levels of different factors together, on the first of these.
//!
//! The numbers are choices. Runs that cannot begin count, so that none is asked for twice.

use std::collections::BTreeSet;

use super::bracket::{Rise, between, search};
use super::{Known, Question, STEP, Survey, Wanted};

/// Questions on which other levels are looked at.
pub const GOVERNING: usize = 2;
/// Runs that are left for the worst two levels together.
const FOR_PAIR: usize = 6;
/// Speeds of a regime on the grid of rises, and speeds that are added about the worst one.
const SPEEDS: usize = 3;
const MORE_SPEEDS: usize = 4;
/// Distance of speeds at which nothing more is looked at between: 2 mph, in hundredths.
const NEAR: u32 = 200;
/// Margin, in parts of the limit, below which other speeds are looked at though none reaches the limit.
const LITTLE: f64 = 0.5;
/// Steps of a search for another level: a quarter of an inch, then an eighth.
const SEARCH: [Rise; 2] = [STEP, 2];

type Stage = fn(&Survey, &Known) -> Vec<Wanted>;

/// The stages, each with words for people, and the runs that it leaves to later ones.
const STAGES: [(&str, Stage, usize); 6] = [
    ("no rise and the highest", Survey::ends, 0),
    ("rises at the worst speeds", Survey::grid, 0),
    ("rises at which limits are reached", Survey::brackets, 0),
    ("other speeds", Survey::more_speeds, 0),
    ("other conditions", Survey::others, FOR_PAIR),
    ("the worst two conditions together", Survey::pair, 0),
];

/// The next batch of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Batch {
    /// What it looks at.
    pub about: &'static str,
    /// The runs, each once.
    pub runs: Vec<Wanted>,
}

impl Survey {
    /// Returns the next runs; none if all is known that is asked for, or no run is left.
    #[must_use]
    pub fn next(&self, known: &Known) -> Option<Batch> {
        let left = self.request.most.saturating_sub(known.len());
        for (about, stage, kept_back) in STAGES {
            let wanted: BTreeSet<Wanted> = stage(self, known).into_iter().collect();
            let new = wanted.into_iter().filter(|own| !known.contains_key(own));
            let runs: Vec<Wanted> = new.take(left.saturating_sub(kept_back)).collect();
            if !runs.is_empty() {
                return Some(Batch { about, runs });
            }
        }
        None
    }

    /// Returns what is left to look at if no run is left; none if all is known.
    #[must_use]
    pub fn left(&self, known: &Known) -> Vec<&'static str> {
        let open = STAGES
            .iter()
            .filter(|(_, stage, _)| stage(self, known).iter().any(|own| !known.contains_key(own)));
        open.map(|own| own.0).collect()
    }

    fn ends(&self, _: &Known) -> Vec<Wanted> {
        let all = (0..self.regimes.len()).flat_map(|regime| {
            let speeds = self.speeds(regime).into_iter();
            speeds.flat_map(move |speed| [0, self.top].map(|rise| self.wanted(&[], regime, speed, rise)))
        });
        all.collect()
    }

    /// Returns the speeds of a regime that leave least to a limit, without rise or at the highest one.
    fn worst_speeds(&self, known: &Known, regime: usize) -> Vec<u32> {
        let asked = self.speeds(regime);
        let mut worst: Vec<u32> = Vec::new();
        for rise in [self.top, 0] {
            for question in self.questions().into_iter().filter(|own| own.regime == regime) {
                let points = self.points(known, &[], question);
                let of = |(speed, own): (&u32, &Vec<(Rise, f64)>)| {
                    let margin = own.iter().find(|own| own.0 == rise)?.1;
                    asked.contains(speed).then_some((*speed, margin))
                };
                let least = points.iter().filter_map(of).min_by(|a, b| a.1.total_cmp(&b.1));
                worst.extend(least.map(|own| own.0).filter(|own| !worst.contains(own)));
            }
        }
        worst.truncate(SPEEDS);
        worst
    }

    fn grid(&self, known: &Known) -> Vec<Wanted> {
        let all = (0..self.regimes.len()).flat_map(|regime| {
            let speeds = match self.request.full {
                true => self.speeds(regime),
                false => self.worst_speeds(known, regime),
            };
            let runs = speeds.into_iter().flat_map(move |speed| {
                let rises = self.rises().into_iter();
                rises.map(move |rise| self.wanted(&[], regime, speed, rise))
            });
            runs.collect::<Vec<_>>()
        });
        all.collect()
    }

    fn brackets(&self, known: &Known) -> Vec<Wanted> {
        let mut wanted = Vec::new();
        for question in self.questions() {
            let Some(answer) = self.answer(known, &[], question) else {
                continue;
            };
            let Some(exceeded) = answer.bracket.exceeded else {
                continue;
            };
            let at = |speed, rise| self.wanted(&[], question.regime, speed, rise);
            if let Some(rise) = between(&answer.bracket, 1) {
                wanted.push(at(answer.speed, rise));
                continue;
            }
            // A wide gap at another speed may hide a lower rise.
            let below = exceeded.saturating_sub(1);
            let hides = |own: &&(u32, super::bracket::Bracket)| {
                own.1.is_open(1) && own.1.kept.is_none_or(|kept| kept < below) && own.0 != answer.speed
            };
            wanted.extend(answer.speeds.iter().filter(hides).map(|own| at(own.0, below)));
        }
        wanted
    }

    fn more_speeds(&self, known: &Known) -> Vec<Wanted> {
        let mut wanted = Vec::new();
        for question in self.questions() {
            let Some(answer) = self.answer(known, &[], question) else {
                continue;
            };
            let rise = match (answer.bracket.kept, answer.bracket.exceeded) {
                (Some(kept), Some(_)) => Some(kept),
                (_, None) => self.near_rise(known, question, answer.speed),
                (None, Some(_)) => None,
            };
            let Some(rise) = rise else { continue };
            let speeds: BTreeSet<u32> = self
                .runs_of(known, &[], question.regime)
                .map(|own| own.0.speed)
                .collect();
            if speeds.len() >= self.speeds(question.regime).len() + MORE_SPEEDS {
                continue;
            }
            let speed = answer.speed;
            let beside = [
                speeds.range(..speed).next_back(),
                speeds.range(speed + 1..).next(),
            ];
            let far = beside
                .into_iter()
                .flatten()
                .filter(|own| own.abs_diff(speed) > NEAR);
            // Hundredths that are whole halves of a mile an hour.
            let middle = far.map(|own| (own + speed) / 2 / 50 * 50);
            wanted.extend(middle.map(|own| self.wanted(&[], question.regime, own, rise)));
        }
        wanted
    }

    /// Returns the rise that leaves least to a limit at a speed, if little is left: a resonance between
    /// two speeds may take the rest.
    fn near_rise(&self, known: &Known, question: Question, speed: u32) -> Option<Rise> {
        let points = self.points(known, &[], question);
        let least = points.get(&speed)?.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        (least.1 < LITTLE).then_some(least.0)
    }

    /// Returns the questions on which other levels are looked at, each with the speed and the rise at
    /// which the car itself reaches its limit: those that it reaches first, of different regimes.
    #[must_use]
    pub fn governing(&self, known: &Known) -> Vec<(Question, u32, Rise)> {
        let mut all: Vec<(u8, Rise, f64, Question, u32)> = Vec::new();
        for question in self.questions() {
            let Some(answer) = self.answer(known, &[], question) else {
                continue;
            };
            let points = self.points(known, &[], question);
            let own = points.get(&answer.speed).map(Vec::as_slice).unwrap_or_default();
            let least = own.iter().map(|own| own.1).fold(f64::INFINITY, f64::min);
            let (rank, rise) = match (answer.bracket.kept, answer.bracket.exceeded) {
                (Some(kept), Some(_)) => (0, kept),
                (Some(kept), None) => (1, kept),
                _ => (2, 0),
            };
            all.push((rank, rise, least, question, answer.speed));
        }
        all.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        let mut found: Vec<(Question, u32, Rise)> = Vec::new();
        for (_, rise, _, question, speed) in all {
            if found.len() < GOVERNING && found.iter().all(|own| own.0.regime != question.regime) {
                found.push((question, speed, rise));
            }
        }
        found
    }

    /// Returns the next rise for a question in a state.
    fn sought(
        &self,
        known: &Known,
        state: &[usize],
        (question, speed, from): (Question, u32, Rise),
        steps: [Rise; 2],
    ) -> Option<Wanted> {
        let points = self.points(known, state, question);
        let own = points.get(&speed).map(Vec::as_slice).unwrap_or_default();
        let from = from / steps[0] * steps[0];
        let rise = search(own, from, steps, self.top)?;
        Some(self.wanted(state, question.regime, speed, rise))
    }

    fn others(&self, known: &Known) -> Vec<Wanted> {
        for question in self.governing(known) {
            let levels = 0..self.levels.len();
            let wanted = levels.filter_map(|level| self.sought(known, &[level], question, SEARCH));
            let wanted: Vec<Wanted> = wanted.filter(|own| !known.contains_key(own)).collect();
            if !wanted.is_empty() {
                return wanted;
            }
        }
        Vec::new()
    }

    /// Returns the worst two levels of different factors for a question; none if fewer lower its rise.
    #[must_use]
    pub fn worst_two(
        &self,
        known: &Known,
        (question, speed, _): (Question, u32, Rise),
    ) -> Option<[usize; 2]> {
        let rank = |state: &[usize]| {
            let points = self.points(known, state, question);
            let own = points.get(&speed)?;
            let bracket = super::bracket::Bracket::of(own);
            let least = own.iter().map(|own| own.1).fold(f64::INFINITY, f64::min);
            Some((bracket.exceeded.unwrap_or(Rise::MAX), least))
        };
        let mut levels: Vec<(Rise, f64, usize)> = (0..self.levels.len())
            .filter_map(|level| rank(&[level]).map(|own| (own.0, own.1, level)))
            .collect();
        levels.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let first = levels.first()?.2;
        let other = levels
            .iter()
            .find(|own| self.levels[own.2].factor != self.levels[first].factor)?;
        Some([first.min(other.2), first.max(other.2)])
    }

    fn pair(&self, known: &Known) -> Vec<Wanted> {
        let Some(question) = self.governing(known).first().copied() else {
            return Vec::new();
        };
        let Some(state) = self.worst_two(known, question) else {
            return Vec::new();
        };
        self.sought(known, &state, question, SEARCH).into_iter().collect()
    }
}
