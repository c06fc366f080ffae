//! The losses of a whole run in which nothing repeats: a car on track.
//!
//! Works and losses are the terms of the energy ledger from the start to the end of the run. Terms of one
//! kind on elements that differ only in where they are (axle, truck, side, end) stand together, with what
//! each of these elements lost beside them, so that a vehicle of a hundred elements is described in a dozen
//! lines; which elements there are is not asked.

use std::collections::BTreeMap;

use mechanics::system::{EnergyTerm, EnergyTermKind, System};
use quantity::{Kind, System as Units};

use super::summary::EnergySummary;
use super::{LossSplit, STORED, stored};
use crate::summary_value::SummaryValue;

/// Words of elements' names that tell where one is, as numbers do.
const PLACES: [&str; 9] = [
    "truck", "leading", "trailing", "front", "rear", "left", "right", "inboard", "outboard",
];

/// Returns the name without the words that tell where an element is.
fn anywhere(name: &str) -> String {
    let words = name.split('_');
    let kept: Vec<&str> = words
        .filter(|word| !PLACES.contains(word) && word.parse::<u32>().is_err())
        .collect();
    kept.join("_")
}

/// Returns the name under which a term stands together with others.
fn group(term: &EnergyTerm) -> String {
    match term.kind {
        EnergyTermKind::ElementLoss => format!("{}_loss", anywhere(&term.element)),
        EnergyTermKind::ElementWork => format!("{}_work", anywhere(&term.element)),
        _ => anywhere(&term.name()),
    }
}

impl EnergySummary {
    /// Returns the energies of a run from its start to its end (time in s and state of each), along which it
    /// went a distance (m).
    pub(crate) fn of_whole_run(
        system: &mut System,
        ends: [(f64, &[f64]); 2],
        distance: f64,
        units: Units,
    ) -> Self {
        let energy = |value: f64| SummaryValue::new(value, Kind::Energy, units);
        let quadratures = ends.map(|(_, x)| system.layout().split(x)[3].to_vec());
        let [before, after] = ends.map(|(time, x)| stored(&system.energies(time, x)));
        let mut summary = Self {
            distance: Some(SummaryValue::new(distance, Kind::Distance, units)),
            window: ends.map(|(time, _)| time),
            ..Self::default()
        };
        let mut works: BTreeMap<String, f64> = BTreeMap::new();
        let mut losses: BTreeMap<String, LossSplit> = BTreeMap::new();
        let (mut lost, mut residual) = (0.0, 0.0);
        for (place, term) in system.energy_terms().iter().enumerate() {
            let value = quadratures[1][place] - quadratures[0][place];
            let group = group(term);
            if term.kind.is_work() {
                residual += value;
                *works.entry(group).or_default() += value;
            } else if value != 0.0 {
                residual -= value;
                lost += value;
                let split = losses.entry(group).or_default();
                term.kind.name().clone_into(&mut split.kind);
                let own = split.by_point.entry(term.element.clone());
                own.or_insert_with(|| energy(0.0)).value += energy(value).value;
            }
        }
        summary.supplied = works
            .into_iter()
            .map(|(name, work)| (name, energy(work)))
            .collect();
        for split in losses.values_mut() {
            let values = split.by_point.values().map(|own| own.value);
            let unit = Kind::Energy.label(units).to_owned();
            let value = values.sum();
            split.total = Some(SummaryValue { value, unit });
            if split.by_point.len() == 1 {
                split.by_point.clear();
            }
        }
        summary.losses = losses;
        for (name, (before, after)) in STORED.iter().zip(before.iter().zip(after)) {
            let change = after - before;
            residual -= change;
            if change != 0.0 {
                summary.stored_change.insert((*name).to_owned(), energy(change));
            }
        }
        summary.loss = Some(energy(lost));
        summary.residual = Some(energy(residual));
        summary
    }
}
