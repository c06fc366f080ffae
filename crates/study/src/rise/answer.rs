//! What a survey's runs say: of each question the rise at which its limit is reached.

use std::collections::BTreeMap;

use super::bracket::{Bracket, Point, Rise};
use super::{Known, OfLimit, OfRun, Question, Survey, Wanted, inches, mph};

/// The answer to a question in a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The numbers of the levels; none: the car itself.
    pub state: Vec<usize>,
    /// The question.
    pub question: Question,
    /// The speed at which the limit is reached at the lowest rise, or that leaves least at the highest
    /// one, if it is not reached; hundredths of a mile an hour.
    pub speed: u32,
    /// Between which rises it is reached at this speed.
    pub bracket: Bracket,
    /// The rise at which it is reached if margins are straight between both, in sixteenths of an inch.
    pub straight: Option<f64>,
    /// Speeds that were looked at, each with its bracket.
    pub speeds: Vec<(u32, Bracket)>,
    /// Runs that gave no value, by name.
    pub missing: Vec<String>,
}

impl Answer {
    /// Returns it in words for a table: `between 1 and 1 1/16 in`.
    #[must_use]
    pub fn words(&self, top: Rise) -> String {
        match (self.bracket.kept, self.bracket.exceeded) {
            (_, Some(0)) => "exceeded without rise".to_owned(),
            (Some(kept), Some(exceeded)) => {
                let (kept, exceeded) = (inches(kept), inches(exceeded));
                format!("between {} and {exceeded}", kept.trim_end_matches(" in"))
            }
            (None, Some(exceeded)) => format!("below {}", inches(exceeded)),
            (Some(kept), None) if kept >= top => format!("not reached up to {}", inches(top)),
            (Some(kept), None) => format!("kept up to {}, not looked at above", inches(kept)),
            (None, None) => "unknown: no run has a value".to_owned(),
        }
    }
}

/// A margin of a run for a question; none if it has none.
fn margin(run: &OfRun, limit: &str) -> Option<f64> {
    if run.derailed {
        return Some(f64::NEG_INFINITY);
    }
    of_limit(run, limit)?.margin
}

/// Returns what a run says of a limit.
#[must_use]
pub fn of_limit<'r>(run: &'r OfRun, limit: &str) -> Option<&'r OfLimit> {
    run.limits.iter().find(|own| own.limit == limit)
}

impl Survey {
    /// Returns the runs of a regime in a state.
    pub fn runs_of<'k>(
        &self,
        known: &'k Known,
        state: &[usize],
        regime: usize,
    ) -> impl Iterator<Item = (&'k Wanted, &'k OfRun)> {
        known
            .iter()
            .filter(move |(own, _)| own.state == state && own.regime == regime)
    }

    /// Returns the points of a question over rise, by speed.
    #[must_use]
    pub fn points(&self, known: &Known, state: &[usize], question: Question) -> BTreeMap<u32, Vec<Point>> {
        let limit = &self.limit(question).name;
        let mut points: BTreeMap<u32, Vec<Point>> = BTreeMap::new();
        for (own, run) in self.runs_of(known, state, question.regime) {
            if let Some(margin) = margin(run, limit) {
                points.entry(own.speed).or_default().push((own.rise, margin));
            }
        }
        points
    }

    /// Returns the answer to a question in a state; none if no run of it is known.
    #[must_use]
    pub fn answer(&self, known: &Known, state: &[usize], question: Question) -> Option<Answer> {
        let points = self.points(known, state, question);
        let limit = &self.limit(question).name;
        let missing = self.runs_of(known, state, question.regime);
        let missing = missing.filter(|(_, run)| margin(run, limit).is_none());
        let missing: Vec<String> = missing.map(|(own, _)| self.name_of(own)).collect();
        let brackets = points.iter().map(|(speed, own)| (*speed, Bracket::of(own)));
        let brackets: Vec<(u32, Bracket)> = brackets.collect();
        let reached = brackets.iter().filter(|own| own.1.exceeded.is_some());
        // Of equal ones that with the lowest rise that is kept: the cautious one.
        let first = reached.min_by_key(|(_, own)| (own.exceeded, own.kept));
        // Not reached: where least is left at the highest rise.
        let highest = |own: &Vec<Point>| own.iter().max_by_key(|own| own.0).copied().unwrap_or_default();
        let least = || {
            points.iter().min_by(|a, b| {
                let ((rise, margin), (other, least)) = (highest(a.1), highest(b.1));
                other.cmp(&rise).then(margin.total_cmp(&least))
            })
        };
        let speed = first.map(|own| own.0).or_else(|| least().map(|own| *own.0));
        let speed = match speed {
            Some(own) => own,
            None if missing.is_empty() => return None,
            None => self.runs_of(known, state, question.regime).next()?.0.speed,
        };
        let own = points.get(&speed).map(Vec::as_slice).unwrap_or_default();
        let bracket = Bracket::of(own);
        Some(Answer {
            state: state.to_vec(),
            question,
            speed,
            bracket,
            straight: bracket.straight(own),
            speeds: brackets,
            missing,
        })
    }

    /// Returns the answers of all states and questions that have one: the car itself first.
    #[must_use]
    pub fn answers(&self, known: &Known) -> Vec<Answer> {
        let mut states: Vec<&[usize]> = known.keys().map(|own| own.state.as_slice()).collect();
        states.sort_by_key(|own| (own.len(), own.to_vec()));
        states.dedup();
        let questions = self.questions();
        let all = states
            .iter()
            .flat_map(|state| questions.iter().map(move |own| (*state, *own)));
        all.filter_map(|(state, question)| self.answer(known, state, question))
            .collect()
    }

    /// Returns the value of a question's measure over the rise at a speed, in the limit's unit, with the
    /// limit.
    #[must_use]
    pub fn curve(&self, known: &Known, state: &[usize], question: Question, speed: u32) -> Vec<[f64; 3]> {
        let limit = &self.limit(question).name;
        let runs = self.runs_of(known, state, question.regime);
        let runs = runs.filter(|(own, run)| own.speed == speed && !run.derailed);
        let mut points: Vec<[f64; 3]> = runs
            .filter_map(|(own, run)| {
                let found = of_limit(run, limit)?;
                Some([f64::from(own.rise) / 16.0, found.value?, found.limit_value?])
            })
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    }

    /// Returns the title of a question: the limit's quantity and its regime.
    #[must_use]
    pub fn title(&self, question: Question) -> String {
        let regime = self.regimes[question.regime].name.replace('_', " ");
        format!("{} ({regime})", self.limit(question).quantity)
    }

    /// Returns the speed of an answer as text.
    #[must_use]
    pub fn at_speed(&self, answer: &Answer) -> String {
        format!("{} mph", mph(answer.speed))
    }
}
