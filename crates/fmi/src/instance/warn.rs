//! Warnings about what is doubtful, for the importer's logger: each kind once.

use std::mem::{Discriminant, discriminant};

use mechanics::plausibility::FindingKind;
use quantity::{SixDigits, System as Units};

use super::{Instance, Values};
use crate::element::Interface;
use crate::extrapolate::{KEPT_POINTS, Point, Understanding};
use crate::watch::{contradiction, too_fast};
use crate::{Category, Severity};

/// Attempted steps in one call, and in a second of its time, above which a call is said to take much work:
/// fifty times what wedges and cars of ordinary cases take, and seconds of computing for a car.
const EFFORT: [f64; 2] = [5_000.0, 50_000.0];

/// The kinds of warnings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Warned {
    /// A position and its rate contradict each other.
    Contradiction,
    /// An input moves too fast.
    Speed,
    /// A wheel has left its rail.
    Derailed,
    /// A step takes much work.
    Effort,
    /// Something in the model is implausible.
    Finding(Discriminant<FindingKind>),
}

impl Values {
    /// Keeps the inputs of a point for the steps that follow.
    pub(super) fn keep(&mut self, point: Point) {
        let surplus = (self.past.len() + 1).saturating_sub(KEPT_POINTS);
        self.past.drain(..surplus);
        self.past.push(point);
    }
}

impl Instance {
    fn warn_once(&mut self, kind: Warned, text: impl FnOnce() -> String) {
        if !self.warned.contains(&kind) {
            self.warned.push(kind);
            self.say(Severity::Warning, Category::Warning, text());
        }
    }

    /// Looks at the inputs of a point; `length` (s) is that of the step in which they are reached, and `how`
    /// says which rates are found from positions: none at an instant of model exchange.
    pub(super) fn watch_inputs(&mut self, point: &Point, length: f64, how: Option<Understanding>) {
        // Then a system follows motions of its own.
        if self.option("motion") {
            return;
        }
        let Some(before) = self.values.past.last().cloned() else {
            return;
        };
        let points = [&before, point];
        let description = self.description.clone();
        let entries = &description.entries.inputs;
        let passed = point.time - before.time;
        if let Some(text) = too_fast(entries, points, if passed > 0.0 { passed } else { length }) {
            self.warn_once(Warned::Speed, || text);
        }
        if passed <= 0.0 {
            return;
        }
        let Values { doubts, set, .. } = &mut self.values;
        let is_used = |position, rate| !how.is_some_and(|how| how.derives(set, position, rate));
        let Some((position, rate, text)) = contradiction(entries, doubts, points, is_used) else {
            return;
        };
        let name = |input: usize| &entries[input].name;
        let advice = if !set[position] {
            format!(
                "`{}` has never been set since the start: connect it too",
                name(position)
            )
        } else if self.interface == Interface::CoSimulation {
            "connect the rate that belongs to the position, or no rate, or set the parameter `derive_rates`: \
             then it is found from the position"
                .to_owned()
        } else if !set[rate] {
            format!(
                "`{}` has never been set since the start, and at an instant it cannot be found from the \
                 position: connect it, or use co-simulation",
                name(rate)
            )
        } else {
            "connect the rate that belongs to the position".to_owned()
        };
        self.warn_once(Warned::Contradiction, || {
            format!("{text}; forces are wrong: {advice}")
        });
    }

    /// Looks at the number of steps that the integrator has attempted in a call, of a length (s) to a time
    /// (s).
    pub(super) fn watch_effort(&mut self, attempts: u64, length: f64, time: f64) {
        let [in_call, per_second] = EFFORT;
        let count = attempts as f64;
        if count > in_call && count > per_second * length {
            self.warn_once(Warned::Effort, || {
                format!(
                    "the step of {} s to {} s took {attempts} steps of the integrator, where ordinary \
                     motion takes some {} a second: calls like this may compute for minutes; look for \
                     inputs that jump or chatter, and for a tolerance that is too small",
                    SixDigits(length),
                    SixDigits(time),
                    per_second / 50.0
                )
            });
        }
    }

    /// Looks at what the element has reached.
    pub(super) fn watch_element(&mut self) {
        let Some(element) = &mut self.element else {
            return;
        };
        let derailed = element.derailed();
        let findings = element.findings();
        if let Some(what) = derailed {
            self.warn_once(Warned::Derailed, || {
                format!("derailed: {what}; what follows means nothing")
            });
        }
        for finding in findings {
            let kind = Warned::Finding(discriminant(&finding.kind));
            let place = self
                .element
                .as_ref()
                .map(|element| element.place(finding.location));
            let words = || {
                let words = finding.words(&place.unwrap_or_default(), Units::Si);
                format!("implausible: {words}; {}", finding.kind.advice())
            };
            self.warn_once(kind, words);
        }
    }
}
