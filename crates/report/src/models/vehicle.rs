//! A vehicle.

use std::time::Duration;

use quantity::Kind;
use study::models::AnyCase;
use study::run::Run;
use study::summary::RunSummary;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;
use study::vehicle::summary::VehicleSummary;

use super::{GoOn, ReportCase, ReportSummary, limits};
use crate::figures::side_by_side::Wanted;
use crate::overlay::words;
use crate::page;
use crate::run_files::RunFiles;
use crate::run_folder::key_numbers::KeyNumber;
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};

impl ReportSummary for VehicleSummary {
    fn key_numbers(&self, _: Option<&AnyCase>) -> Vec<KeyNumber> {
        let mut numbers = limits::key_numbers(self.limits());
        for (number, vibration) in (1..).zip(&self.vibrations).take(8) {
            let window = "about the rest";
            let what = format!("natural frequency {number}");
            numbers.push(KeyNumber::plain(what, window, vibration.frequency_hz, "Hz"));
            let what = format!("damping ratio {number}");
            numbers.push(KeyNumber::plain(what, window, vibration.damping_ratio, ""));
        }
        for (name, force) in &self.forces_at_start {
            let what = name.replace('_', " ");
            numbers.push(KeyNumber::new(what, "at the start", force, Kind::Force));
        }
        numbers
    }

    /// The displacements of a vehicle's bodies, and the forces of its elements.
    fn overlays(&self, table: &ResultTable) -> Vec<Wanted> {
        let of = |kind: Kind, ending: &str| -> Vec<(String, String)> {
            let own = table.columns().iter();
            let own = own.filter(|column| column.kind == kind && column.name.ends_with(ending));
            own.map(|column| (column.name.clone(), words(&column.name)))
                .take(6)
                .collect()
        };
        let wanted = |name: &str, title: &str, caption: &str, own: Vec<(String, String)>| {
            let own: Vec<(&str, &str)> = own.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
            Wanted::new(name, title, caption, "time", &own)
        };
        vec![
            wanted(
                "vehicle_motion",
                "Vertical motion over time",
                "Displacements of bodies upwards, the first six.",
                of(Kind::Length, "_z"),
            ),
            wanted(
                "vehicle_forces",
                "Forces over time",
                "Forces of elements, the first six.",
                of(Kind::Force, "_force"),
            ),
        ]
    }
}

impl ReportCase for VehicleCase {
    type Along = ();
    type Shown = (Self, VehicleResult);

    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (VehicleResult, ()) {
        (run.finish_while(go_on), ())
    }

    fn shown(self, result: VehicleResult, (): ()) -> Self::Shown {
        (self, result)
    }

    fn parts((case, result): &Self::Shown) -> (&Self, &VehicleResult) {
        (case, result)
    }

    fn recording((case, result): &Self::Shown, detail: Detail) -> Recording {
        Recording::of_vehicle(case, result, detail)
    }

    fn page((case, result): &Self::Shown) -> Result<String, serde_json::Error> {
        page::vehicle_run::render(case, result)
    }

    fn in_words(summary: &VehicleSummary, _: Duration) -> (TerminalTable, String) {
        match summary.by_rules() {
            Some(_) => limits::beside(summary),
            None => (table(summary), NOTE.to_owned()),
        }
    }
}

impl RunFiles for VehicleCase {}

const NOTE: &str = "\
Forces at the start and extremes over all output times. Natural vibrations, extremes of all columns and the
energy ledger stand in summary.json.";

/// Returns the table of the forces of a vehicle's elements.
fn table(summary: &VehicleSummary) -> TerminalTable {
    let units = summary.units;
    let unit = Kind::Force.label(units);
    let head = [
        ("force", ""),
        ("at the start", unit),
        ("least", unit),
        ("largest", unit),
    ];
    let mut table = TerminalTable::new(1, &head);
    for (name, own) in &summary.forces_at_start {
        let column = format!("{name}_{}", Kind::Force.suffix(units));
        let found = summary.extremes.get(&column);
        let cell = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1}"));
        table.row([
            name.replace('_', " "),
            cell(Some(own.value)),
            cell(found.map(|found| found.minimum)),
            cell(found.map(|found| found.maximum)),
        ]);
    }
    table
}
