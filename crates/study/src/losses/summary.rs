//! The energy of a cycle in the summary of a run.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use mechanics::system::{ContactState, System};
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use super::stroke::PARTS;
use super::{KINDS, LossRecorder, STORED};
use crate::metrics::{Cycle, FirstHarmonic};
use crate::summary_value::SummaryValue;

/// The contact states, by number.
pub const STATES: [&str; 3] = ["open", "stick", "slip"];

/// Sources and sinks of the energy of a cycle, as means over whole cycles; or those of a whole run along a
/// distance.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergySummary {
    /// The reason if there are no energies, else empty.
    pub missing: String,
    /// Number of whole cycles; zero where the energies are those of the whole run.
    pub cycles: u32,
    /// Distance along which the whole run went: a vehicle's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<SummaryValue>,
    /// Beginning and end of these cycles or of the run, s.
    pub window: [f64; 2],
    /// Work put in each cycle, by name.
    pub supplied: BTreeMap<String, SummaryValue>,
    /// Growth of the stored energy each cycle, by kind.
    pub stored_change: BTreeMap<String, SummaryValue>,
    /// Energy lost each cycle, by dissipation term of the ledger; without those that lose nothing at all.
    pub losses: BTreeMap<String, LossSplit>,
    /// All of it.
    pub loss: Option<SummaryValue>,
    /// All of it by part of the stroke.
    pub by_stroke: BTreeMap<String, SummaryValue>,
    /// Work less growth of the stored energy and losses.
    pub residual: Option<SummaryValue>,
    /// By how much the powers of the contact points, integrated step by step, differ from the ledger: the
    /// largest difference in a term over all that is lost.
    pub largest_correction: f64,
    /// Equivalent viscous damping of all that is lost, where something vertical moves.
    pub equivalent: Option<Equivalent>,
}

/// The energy lost each cycle in one dissipation term; the values of each division sum to the total.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LossSplit {
    /// Its kind, such as `friction_loss`.
    pub kind: String,
    /// All of it.
    pub total: Option<SummaryValue>,
    /// By contact point; empty for what is no contact face. Of a whole run by element, where several stand
    /// together.
    pub by_point: BTreeMap<String, SummaryValue>,
    /// By contact state; empty for what is no contact face.
    pub by_state: BTreeMap<String, SummaryValue>,
    /// By part of the stroke.
    pub by_stroke: BTreeMap<String, SummaryValue>,
}

/// A linear damper that loses as much each cycle, and the damping ratio of an oscillator of one degree of
/// freedom with it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equivalent {
    /// Amplitude A of the vertical motion.
    pub amplitude: SummaryValue,
    /// Its frequency, Hz.
    pub frequency: f64,
    /// Equivalent viscous damping ΔW/(π ω A²) of the energy ΔW lost each cycle.
    pub damping: SummaryValue,
    /// Equivalent stiffness k: in-phase part of the first harmonic of the force, per displacement.
    pub stiffness: Option<SummaryValue>,
    /// Largest energy W = k A²/2 stored in a spring of this stiffness.
    pub stored_energy: Option<SummaryValue>,
    /// Damping ratio ΔW/(4π W); none without a stiffness above zero.
    pub damping_ratio: Option<f64>,
}

impl Equivalent {
    /// Returns that of a loss each cycle (J) over a cycle, with the stiffness of the first harmonic.
    #[must_use]
    pub fn new(loss: f64, cycle: &Cycle, harmonic: Option<FirstHarmonic>, units: Units) -> Self {
        let stiffness = harmonic.map(|harmonic| harmonic.stiffness);
        let positive = stiffness.filter(|stiffness| *stiffness > 0.0);
        let stored = positive.map(|stiffness| 0.5 * stiffness * cycle.amplitude * cycle.amplitude);
        let value = |value: f64, kind: Kind| SummaryValue::new(value, kind, units);
        Self {
            amplitude: value(cycle.amplitude, Kind::Length),
            frequency: cycle.angular_frequency / (2.0 * PI),
            damping: value(cycle.equivalent_damping(loss), Kind::Damping),
            stiffness: stiffness.map(|stiffness| value(stiffness, Kind::Stiffness)),
            stored_energy: stored.map(|stored| value(stored, Kind::Energy)),
            damping_ratio: stored.map(|stored| loss / (4.0 * PI * stored)),
        }
    }
}

impl EnergySummary {
    /// Returns one that says why there are no energies.
    #[must_use]
    pub fn none(why: &str) -> Self {
        Self {
            missing: why.to_owned(),
            ..Self::default()
        }
    }

    /// Returns whether there are energies.
    #[must_use]
    pub fn is_some(&self) -> bool {
        self.cycles > 0
    }

    /// Returns the losses with their totals (in their unit), the largest first.
    #[must_use]
    pub fn by_size(&self) -> Vec<(&str, &LossSplit, f64)> {
        let losses = self.losses.iter();
        let mut losses: Vec<_> = losses
            .filter_map(|(name, own)| Some((name.as_str(), own, own.total.as_ref()?.value)))
            .collect();
        losses.sort_by(|a, b| b.2.total_cmp(&a.2));
        losses
    }

    /// Returns of what the energies are: `cycle` or `run`.
    #[must_use]
    pub fn whole(&self) -> &'static str {
        match self.distance {
            Some(_) => "run",
            None => "cycle",
        }
    }

    /// Returns over what they are taken, in words.
    #[must_use]
    pub fn span(&self) -> String {
        let [start, end] = self.window;
        let Some(distance) = &self.distance else {
            return format!("mean of {} whole cycles, {start:.3} s to {end:.3} s", self.cycles);
        };
        let SummaryValue { value, unit } = distance;
        format!("the whole run, {start:.3} s to {end:.3} s, {value:.1} {unit}")
    }

    /// Returns an energy of a whole run (in the unit of the summary) by the distance gone: a mean force
    /// against the motion, such as the resistance that a loss makes. `None` where nothing went a distance.
    #[must_use]
    pub fn by_distance(&self, energy: f64, units: Units) -> Option<SummaryValue> {
        let si = |value: f64, kind: Kind| value / kind.from_si(units);
        let distance = si(self.distance.as_ref()?.value, Kind::Distance);
        let force = si(energy, Kind::Energy) / distance;
        (distance > 0.0).then(|| SummaryValue::new(force, Kind::Force, units))
    }

    /// Returns the inflow less the stored and lost energy, from the entries alone, in their unit. If an entry
    /// is left out it is as large as that.
    #[must_use]
    pub fn balance(&self) -> f64 {
        let sum = |values: &BTreeMap<String, SummaryValue>| values.values().map(|own| own.value).sum::<f64>();
        let losses = self.losses.values().filter_map(|loss| loss.total.as_ref());
        let lost: f64 = losses.map(|total| total.value).sum();
        sum(&self.supplied) - sum(&self.stored_change) - lost
    }
}

/// Dividing what was lost.
struct Shares<'r> {
    recorder: &'r LossRecorder,
    names: &'r [String],
    cycles: f64,
    units: Units,
}

impl LossRecorder {
    /// Returns the energies of a cycle, with the names of the contact points, and all that is lost each
    /// cycle, J; `None` if the whole cycles have not been passed.
    pub fn summary(&self, system: &System, names: &[String], units: Units) -> Option<(EnergySummary, f64)> {
        let window = self.window?;
        let [before, after] = self.counts.stored.as_slice() else {
            return None;
        };
        let shares = Shares {
            recorder: self,
            names,
            cycles: f64::from(window.cycles),
            units,
        };
        let mut summary = EnergySummary {
            cycles: window.cycles,
            window: window.ends,
            ..EnergySummary::default()
        };
        let (mut lost, mut by_stroke, mut corrections) = (0.0, [0.0; PARTS.len()], 0.0_f64);
        let mut residual = 0.0;
        for (term, own) in system.energy_terms().iter().enumerate() {
            let parts = shares.parts(term);
            let total: f64 = parts.iter().sum();
            if own.kind.is_work() {
                residual += total;
                summary.supplied.insert(own.name(), shares.energy(total));
                continue;
            }
            if parts == [0.0; PARTS.len()] {
                continue;
            }
            residual -= total;
            lost += total;
            for (sum, part) in by_stroke.iter_mut().zip(&parts) {
                *sum += part;
            }
            let (split, correction) = shares.split(system, term, own.kind.name(), &parts);
            corrections = corrections.max(correction);
            summary.losses.insert(own.name(), split);
        }
        for (name, (before, after)) in STORED.iter().zip(before.iter().zip(after)) {
            let change = (after - before) / shares.cycles;
            residual -= change;
            // Kinds of energy that the system does not have.
            if *before != 0.0 || *after != 0.0 {
                summary
                    .stored_change
                    .insert((*name).to_owned(), shares.energy(change));
            }
        }
        summary.loss = Some(shares.energy(lost));
        summary.by_stroke = shares.named(PARTS.iter().zip(by_stroke));
        summary.residual = Some(shares.energy(residual));
        summary.largest_correction = if lost > 0.0 { corrections / lost } else { 0.0 };
        Some((summary, lost))
    }
}

impl Shares<'_> {
    fn energy(&self, value: f64) -> SummaryValue {
        SummaryValue::new(value, Kind::Energy, self.units)
    }

    fn named<'n>(
        &self,
        values: impl Iterator<Item = (&'n (impl ToString + 'n + ?Sized), f64)>,
    ) -> BTreeMap<String, SummaryValue> {
        values
            .map(|(name, value)| (name.to_string(), self.energy(value)))
            .collect()
    }

    /// Returns the increments of a term each cycle, J, by part of the stroke.
    fn parts(&self, term: usize) -> [f64; PARTS.len()] {
        let LossRecorder { counts, terms, .. } = self.recorder;
        std::array::from_fn(|part| counts.terms[part * terms + term] / self.cycles)
    }

    /// Divides a term, and returns by how much (J) the powers of its points differ from it.
    fn split(
        &self,
        system: &System,
        term: usize,
        kind: &str,
        parts: &[f64; PARTS.len()],
    ) -> (LossSplit, f64) {
        let mut split = LossSplit {
            kind: kind.to_owned(),
            total: Some(self.energy(parts.iter().sum())),
            by_stroke: self.named(PARTS.iter().zip(parts.iter().copied())),
            ..LossSplit::default()
        };
        let mut first = 0;
        for mounted in system.faces() {
            let points = first..first + mounted.element.points.len();
            first = points.end;
            let Some(kind) = mounted.energy_terms.iter().position(|own| *own == Some(term)) else {
                continue;
            };
            let (by_point, by_state, difference) = self.divide(points.clone(), kind.min(KINDS - 1), parts);
            split.by_point = self.named(self.names[points].iter().zip(by_point));
            split.by_state = self.named(STATES.iter().zip(by_state));
            return (split, difference);
        }
        (split, 0.0)
    }

    /// Divides the increments of a term over the points of its face and over contact states, by the integrals
    /// of the powers; where there is no power, over the open points alike.
    fn divide(
        &self,
        points: std::ops::Range<usize>,
        kind: usize,
        parts: &[f64; PARTS.len()],
    ) -> (Vec<f64>, [f64; STATES.len()], f64) {
        const CONTACT_STATES: [ContactState; STATES.len()] =
            [ContactState::Open, ContactState::Stick, ContactState::Slip];
        let mut by_point = vec![0.0; points.len()];
        let mut by_state = [0.0; STATES.len()];
        let mut difference = 0.0;
        for (part, increment) in parts.iter().enumerate() {
            let power = |point: usize, state: ContactState| {
                let first = self.recorder.first_power(part, point, state);
                self.recorder.counts.powers[first + kind] / self.cycles
            };
            let all = points
                .clone()
                .flat_map(|point| CONTACT_STATES.map(|state| power(point, state)));
            let sum: f64 = all.sum();
            difference += (sum - increment).abs();
            for (own, point) in by_point.iter_mut().zip(points.clone()) {
                for (place, state) in CONTACT_STATES.into_iter().enumerate() {
                    let share = if sum > 0.0 {
                        power(point, state) / sum
                    } else if state == ContactState::Open {
                        1.0 / points.len() as f64
                    } else {
                        0.0
                    };
                    *own += share * increment;
                    by_state[place] += share * increment;
                }
            }
        }
        (by_point, by_state, difference)
    }
}
