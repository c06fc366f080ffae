//! A wedge.

use std::io::{self, Write};
use std::time::Duration;

use quantity::Kind;
use study::case::Case;
use study::models::{AnyCase, AnySummary};
use study::result::RunResult;
use study::run::Run;
use study::summary::{Averages, Summary, SummaryValue};
use wedge::face::Grid;
use wedge::parameters::Damping;

use super::{CYCLE, GoOn, Loop, LoopAxis, ReportCase, ReportSummary, joules};
use crate::figures::side_by_side::Wanted;
use crate::figures::{CaseOutcome, pressure_figure};
use crate::output_table::RunTable;
use crate::run_files::{PRESSURE_FILE_NAME, RunFiles};
use crate::run_folder::key_numbers::{KeyNumber, branch_window, cycles, extremes};
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};
use crate::{mat, page};

impl ReportSummary for Summary {
    fn key_numbers(&self, case: Option<&AnyCase>) -> Vec<KeyNumber> {
        key_numbers(
            self,
            case.and_then(AnyCase::wedge).map(|case| case.parameters.damping),
        )
    }

    fn overlays(&self, _: &ResultTable) -> Vec<Wanted> {
        vec![
            Wanted::new(
                "wedge_loop",
                "Force over travel",
                "Vertical wedge force (friction of the column on the side frame, positive up) over the \
                 bolster's vertical displacement, positive up.",
                "bolster_vertical",
                &[("vertical_wedge_force", "")],
            )
            .looped(),
            Wanted::new(
                "wedge_forces",
                "Forces over time",
                "Forces of wedge and coil.",
                "time",
                &[
                    ("vertical_wedge_force", "(a) vertical wedge force"),
                    (
                        "vertical_force_on_side_frame",
                        "(b) with the coil, where it stands there",
                    ),
                    ("longitudinal_wedge_force", "(c) longitudinal wedge force"),
                    ("coil_force", "(d) coil"),
                ],
            ),
            Wanted::new(
                "wedge_motion",
                "Motion over time",
                "Displacements of bolster and wedge.",
                "time",
                &[
                    ("bolster_vertical", "(a) bolster, vertical"),
                    ("wedge_z", "(b) wedge, vertical"),
                    ("wedge_x", "(c) wedge, longitudinal"),
                    ("wedge_yaw", "(d) wedge, yaw"),
                ],
            ),
        ]
    }

    fn in_short(&self) -> AnySummary {
        let mut summary = self.clone();
        summary.events.listed.clear();
        summary.into()
    }
}

impl ReportCase for Case {
    type Along = ();
    type Shown = CaseOutcome;

    const EXPLORED: Detail = Detail::Full;

    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (RunResult, ()) {
        (run.finish_while(go_on), ())
    }

    fn shown(self, result: RunResult, (): ()) -> CaseOutcome {
        (self, result)
    }

    fn parts((case, result): &CaseOutcome) -> (&Self, &RunResult) {
        (case, result)
    }

    fn recording(shown: &CaseOutcome, detail: Detail) -> Recording {
        Recording::of_wedge(shown, detail)
    }

    fn page(shown: &CaseOutcome) -> Result<String, serde_json::Error> {
        page::wedge_run::render(shown)
    }

    fn in_words(summary: &Summary, wall: Duration) -> (TerminalTable, String) {
        (table([(summary, wall)]), TABLE_NOTE.to_owned())
    }

    fn shown_loop(&self, result: &RunResult) -> Loop {
        let averages = &result.summary.averages;
        let energy = averages.energy_per_cycle.get("side_frame");
        Loop {
            title: "Vertical wedge force over the bolster's travel",
            x: LoopAxis::new("bolster_vertical", "bolster, vertical"),
            y: LoopAxis::new("vertical_wedge_force", "vertical force on the side frame"),
            energy_of: "Energy lost in friction at the side frame",
            energy_per: CYCLE,
            energy: energy.map(|energy| joules(energy.value, result.summary.units)),
            missing: averages.missing.clone(),
        }
    }
}

impl RunFiles for Case {
    fn figure_name(&self) -> Option<&'static str> {
        let faces = [&self.parameters.column_face, &self.parameters.slope_face];
        let pressure = faces.iter().any(|face| face.grid != Grid::default());
        pressure.then_some(PRESSURE_FILE_NAME)
    }

    fn figure(&self, result: &RunResult) -> Option<String> {
        Some(pressure_figure(self, result)?.to_svg())
    }

    /// The thesis's variables, whatever the columns of other tables.
    fn write_mat(&self, result: &RunResult, _table: &RunTable<'_>, out: &mut dyn Write) -> io::Result<()> {
        mat::write(self, result, out)
    }
}

/// Returns the key numbers of a run; without its damping the window of means is told in general.
pub(crate) fn key_numbers(own: &Summary, damping: Option<Damping>) -> Vec<KeyNumber> {
    let averages = &own.averages;
    let over = format!("{} after the first half period", cycles(averages.cycles));
    let mut numbers = Vec::new();
    for (branch, means) in [("up", &averages.up), ("down", &averages.down)] {
        if let Some(value) = means.get("vertical_wedge_force") {
            numbers.push(KeyNumber::new(
                format!("mean vertical wedge force, bolster going {branch}"),
                branch_window(damping),
                value,
                Kind::Force,
            ));
        }
    }
    for (place, what) in [
        ("side_frame", "friction energy at the side frame per cycle"),
        ("bolster", "friction energy at the bolster per cycle"),
    ] {
        if let Some(value) = averages.energy_per_cycle.get(place) {
            numbers.push(KeyNumber::new(what, &over, value, Kind::Energy));
        }
    }
    let singles = [
        (
            "equivalent damping of the side-frame friction",
            &averages.equivalent_damping,
            Kind::Damping,
        ),
        (
            "equivalent stiffness on the bolster",
            &averages.equivalent_stiffness,
            Kind::Stiffness,
        ),
        (
            "equivalent damping on the bolster",
            &averages.equivalent_damping_on_bolster,
            Kind::Damping,
        ),
    ];
    for (what, value, kind) in singles {
        numbers.extend(value.iter().map(|value| KeyNumber::new(what, &over, value, kind)));
    }
    let column = format!("vertical_wedge_force_{}", Kind::Force.suffix(own.units));
    numbers.extend(extremes(
        own.extremes.get(&column),
        ("least vertical wedge force", "largest vertical wedge force"),
        Kind::Force,
        own.units,
    ));
    numbers
}

/// Returns the table of runs; all of them in the same units.
pub fn table<'d>(runs: impl IntoIterator<Item = (&'d Summary, Duration)> + Clone) -> TerminalTable {
    let unit = |of: fn(&Averages) -> Option<&SummaryValue>| {
        let found = runs
            .clone()
            .into_iter()
            .find_map(|(summary, _)| of(&summary.averages));
        found.map_or(String::new(), |measure| measure.unit.clone())
    };
    let mut table = TerminalTable::new(
        2,
        &[
            ("run", ""),
            ("window", "of mean force"),
            ("mean force, up", &unit(Averages::force_up)),
            ("mean force, down", &unit(Averages::force_down)),
            ("energy per cycle", &unit(Averages::side_frame_energy)),
            ("ledger residual", "relative"),
            ("wall time", "s"),
        ],
    );
    for (summary, wall) in runs {
        let cell = |measure: Option<&SummaryValue>| {
            measure.map_or("-".to_owned(), |measure| format!("{:.1}", measure.value))
        };
        table.row([
            summary.name.clone(),
            summary.averages.window.clone(),
            cell(summary.averages.force_up()),
            cell(summary.averages.force_down()),
            cell(summary.averages.side_frame_energy()),
            format!("{:.1e}", summary.ledger.largest_relative_residual),
            format!("{:.2}", wall.as_secs_f64()),
        ]);
    }
    table
}

/// The note on the columns of the table.
pub const TABLE_NOTE: &str = "\
Mean force: vertical wedge force (column friction on the side frame, positive up), averaged while the \
bolster goes up or down, over
the output times after the first half period in the window: mid stroke (constant damping), the bolster \
faster than 0.9 of its peak
speed; lower stroke (variable damping), faster than 0.25 of it, and lower than 0.3 of its amplitude below \
its middle. Energy per
cycle: lost in friction at the side frame. Ledger residual: the largest at any output time, over the largest \
of work, losses and
change of stored energy.";
