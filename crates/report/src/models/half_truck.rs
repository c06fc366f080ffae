//! A half-truck from files of NUCARS.

use std::io::{self, Write};
use std::time::Duration;

use quantity::Kind;
use study::contacts::ContactTable;
use study::half_truck::{HalfTruckCase, HalfTruckResult, HalfTruckSummary};
use study::models::AnyCase;
use study::run::{Run, RunError};

use super::{GoOn, ReportCase, ReportSummary};
use crate::figures::side_by_side::Wanted;
use crate::output_table::RunTable;
use crate::run_files::RunFiles;
use crate::run_folder::key_numbers::{ALL_TIMES, KeyNumber, branch_window};
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};
use crate::{half_truck_files, page};

impl ReportSummary for HalfTruckSummary {
    fn key_numbers(&self, _: Option<&AnyCase>) -> Vec<KeyNumber> {
        let mut numbers = Vec::new();
        let over = "whole cycles after the first half period";
        for (number, wedge) in &self.wedges {
            let rows = [
                (
                    "mean column friction, bolster going up",
                    branch_window(None),
                    &wedge.up,
                    Kind::Force,
                ),
                (
                    "mean column friction, bolster going down",
                    branch_window(None),
                    &wedge.down,
                    Kind::Force,
                ),
                (
                    "friction energy at the column per cycle",
                    over,
                    &wedge.energy_per_cycle,
                    Kind::Energy,
                ),
                (
                    "largest normal force of the column",
                    ALL_TIMES,
                    &wedge.largest_normal_force,
                    Kind::Force,
                ),
            ];
            for (what, window, value, kind) in rows {
                let what = format!("wedge {number}: {what}");
                numbers.extend(
                    value
                        .iter()
                        .map(|value| KeyNumber::new(&what, window, value, kind)),
                );
            }
        }
        numbers
    }

    fn overlays(&self, _: &ResultTable) -> Vec<Wanted> {
        let numbers: Vec<&str> = self.wedges.keys().map(String::as_str).collect();
        let panels = |x: &dyn Fn(&str) -> String, what: &str| -> Vec<[String; 3]> {
            let of = |number: &&str| {
                [
                    x(number),
                    format!("wedge_{number}_{what}"),
                    format!("wedge {number}"),
                ]
            };
            numbers.iter().map(of).collect()
        };
        let stroke = |number: &str| format!("wedge_{number}_stroke");
        let named = |name: &str, title: &str, caption: &str, panels: Vec<[String; 3]>, loops: bool| Wanted {
            panels,
            loops,
            ..Wanted::new(name, title, caption, "", &[])
        };
        vec![
            named(
                "half_truck_loops",
                "Column friction over stroke",
                "Friction of each column on the side frame, positive up, over the vertical stroke of the \
                 bolster against the side frame.",
                panels(&stroke, "column_friction"),
                true,
            ),
            named(
                "half_truck_normals",
                "Normal forces of the columns",
                "Normal force of each wedge at its column.",
                panels(&|_| "time".to_owned(), "column_normal_force"),
                false,
            ),
        ]
    }
}

impl ReportCase for HalfTruckCase {
    /// The corners of wedges that are bodies.
    type Along = Option<ContactTable>;
    type Shown = (Self, HalfTruckResult, Option<ContactTable>);

    fn start(&self) -> Result<Run<Self>, RunError> {
        Run::with_contacts(self)
    }

    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (HalfTruckResult, Self::Along) {
        run.finish_with_contacts(go_on)
    }

    fn shown(self, result: HalfTruckResult, along: Self::Along) -> Self::Shown {
        (self, result, along)
    }

    fn parts((case, result, _): &Self::Shown) -> (&Self, &HalfTruckResult) {
        (case, result)
    }

    fn recording((case, result, contacts): &Self::Shown, detail: Detail) -> Recording {
        Recording::of_truck(case, result, contacts.as_ref(), detail)
    }

    fn page((case, result, contacts): &Self::Shown) -> Result<String, serde_json::Error> {
        page::half_truck_run::render(case, result, contacts.as_ref())
    }

    fn in_words(summary: &HalfTruckSummary, _: Duration) -> (TerminalTable, String) {
        (table(summary), TABLE_NOTE.to_owned())
    }
}

impl RunFiles for HalfTruckCase {
    fn write_mat(
        &self,
        result: &HalfTruckResult,
        _table: &RunTable<'_>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        half_truck_files::write_mat(self, result, self.script_interval, out)
    }
}

/// The note that explains the columns of the table.
const TABLE_NOTE: &str = "\
Mean force: column friction on the side frame, positive up, averaged while the input goes up or down, over \
the output times after
the first half period in the window: mid stroke (constant damping), the input faster than 0.9 of its peak \
speed; lower stroke
(variable damping), faster than 0.25 of it, and lower than 0.3 of its amplitude. Energy per cycle: lost in \
friction at the column.
Jammed: share of the output times without steady sliding, held by the limit alone.";

/// Returns the table of wedges.
fn table(summary: &HalfTruckSummary) -> TerminalTable {
    let units = summary.units;
    let (force, energy) = (Kind::Force.label(units), Kind::Energy.label(units));
    let mut table = TerminalTable::new(
        2,
        &[
            ("wedge", ""),
            ("window", "of mean force"),
            ("mean force, up", force),
            ("mean force, down", force),
            ("energy per cycle", energy),
            ("largest normal force", force),
            ("jammed", "%"),
        ],
    );
    for (number, wedge) in &summary.wedges {
        let cell = |measure: &Option<study::summary::SummaryValue>| {
            let value = measure.as_ref().map(|measure| format!("{:.1}", measure.value));
            value.unwrap_or_else(|| "-".to_owned())
        };
        table.row([
            number.clone(),
            wedge.window.clone(),
            cell(&wedge.up),
            cell(&wedge.down),
            cell(&wedge.energy_per_cycle),
            cell(&wedge.largest_normal_force),
            format!("{:.1}", 100.0 * wedge.jammed),
        ]);
    }
    table
}
