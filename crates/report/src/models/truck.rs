//! A three-piece truck.

use std::time::Duration;

use quantity::Kind;
use study::contacts::ContactTable;
use study::metrics::Extremes;
use study::models::AnyCase;
use study::run::{Run, RunError};
use study::statics::StaticTable;
use study::summary::SummaryValue;
use study::truck::run::TruckResult;
use study::truck::summary::TruckSummary;
use study::truck::{TruckCase, WEDGE_NAMES};

use super::{CYCLE, GoOn, Loop, LoopAxis, ReportCase, ReportSummary, joules, range};
use crate::figures::digits;
use crate::figures::side_by_side::Wanted;
use crate::figures::truck::TruckRun;
use crate::overlay::words;
use crate::page;
use crate::run_files::RunFiles;
use crate::run_folder::key_numbers::{ALL_TIMES, KeyNumber, cycles, of_rise};
use crate::table::ResultTable;
use crate::terminal::TerminalTable;
use crate::view::run::{Detail, Recording};

impl ReportSummary for TruckSummary {
    fn key_numbers(&self, _: Option<&AnyCase>) -> Vec<KeyNumber> {
        let mut numbers = Vec::new();
        let over = format!("{} after the first", cycles(self.cycles.count));
        let energy = |value: f64| SummaryValue {
            value,
            unit: Kind::Energy.label(self.units).to_owned(),
        };
        if let Some(work) = &self.cycles.work {
            numbers.push(KeyNumber::new(
                "work of all motions per cycle",
                &over,
                work,
                Kind::Energy,
            ));
        }
        if let Some(loss) = self.cycles.loss_of_wedges(&WEDGE_NAMES) {
            numbers.push(KeyNumber::new(
                "friction energy of the four wedges per cycle",
                &over,
                &energy(loss),
                Kind::Energy,
            ));
        }
        if let Some(equivalent) = &self.energy.equivalent {
            let over = cycles(self.energy.cycles);
            numbers.push(KeyNumber::new(
                "equivalent damping of all losses",
                &over,
                &equivalent.damping,
                Kind::Damping,
            ));
            if let Some(ratio) = equivalent.damping_ratio {
                numbers.push(KeyNumber::plain("damping ratio of all losses", &over, ratio, ""));
            }
        }
        for (angle, value) in &self.warp_stiffness {
            numbers.push(KeyNumber::plain(
                format!("warp stiffness to {angle}"),
                "secant from rest to this angle",
                value.value,
                &value.unit,
            ));
        }
        let suffix = Kind::Force.suffix(self.units);
        let of = |wedge: &'static str| {
            Some((
                wedge,
                self.extremes.get(&format!("{wedge}_column_normal_{suffix}"))?,
            ))
        };
        let columns: Vec<(&str, &Extremes)> = WEDGE_NAMES.into_iter().filter_map(of).collect();
        let number = |what: &str, (wedge, value, time): (&str, f64, f64)| KeyNumber {
            what: what.to_owned(),
            window: format!(
                "{ALL_TIMES}; {} wedge at {} s",
                wedge.replace('_', " "),
                digits(time)
            ),
            value: SummaryValue {
                value,
                unit: Kind::Force.label(self.units).to_owned(),
            },
            kind: Some(Kind::Force),
        };
        let least = columns
            .iter()
            .min_by(|(_, a), (_, b)| a.minimum.total_cmp(&b.minimum));
        let largest = columns
            .iter()
            .max_by(|(_, a), (_, b)| a.maximum.total_cmp(&b.maximum));
        if let (Some((least, a)), Some((largest, b))) = (least, largest) {
            numbers.extend([
                number(
                    "least normal force of a column",
                    (least, a.minimum, a.minimum_time),
                ),
                number(
                    "largest normal force of a column",
                    (largest, b.maximum, b.maximum_time),
                ),
            ]);
        }
        numbers.extend(of_rise(&self.wedge_rise));
        numbers
    }

    fn overlays(&self, _: &ResultTable) -> Vec<Wanted> {
        let of_wedges = |what: &str| -> Vec<(String, String)> {
            let letters = ["(a)", "(b)", "(c)", "(d)"].into_iter();
            let wedges = WEDGE_NAMES.into_iter().zip(letters);
            wedges
                .map(|(wedge, letter)| (format!("{wedge}_{what}"), format!("{letter} {}", words(wedge))))
                .collect()
        };
        let wedges = |name: &str, title: &str, caption: &str, x: &str, what: &str| {
            let own = of_wedges(what);
            let own: Vec<(&str, &str)> = own
                .iter()
                .map(|(name, title)| (name.as_str(), title.as_str()))
                .collect();
            Wanted::new(name, title, caption, x, &own)
        };
        vec![
            Wanted::new(
                "nest_loops",
                "Nest force over travel",
                "Load of each nest with its wedges over the bolster's vertical displacement, positive up.",
                "bolster_z",
                &[
                    ("left_nest_vertical_force", "(a) left nest"),
                    ("right_nest_vertical_force", "(b) right nest"),
                ],
            )
            .looped(),
            Wanted::new(
                "warp_loop",
                "Warp moment over warp angle",
                "Warp moment on the bolster over the warp angle.",
                "warp_angle",
                &[("warp_moment", "")],
            )
            .looped(),
            wedges(
                "column_friction",
                "Column friction of the wedges",
                "Friction of each column on the side frame, positive up.",
                "time",
                "column_friction_z",
            ),
            wedges(
                "column_normals",
                "Normal forces of the columns",
                "Normal force of each wedge at its column.",
                "time",
                "column_normal",
            ),
            Wanted::new(
                "truck_motion",
                "Motion over time",
                "The bolster's displacement and roll, and the warp angle.",
                "time",
                &[
                    ("bolster_z", "(a) bolster, vertical"),
                    ("bolster_roll", "(b) bolster, roll"),
                    ("warp_angle", "(c) warp angle"),
                    ("warp_moment", "(d) warp moment"),
                ],
            ),
        ]
    }

    fn statics(&self) -> Option<&StaticTable> {
        Some(&self.statics)
    }
}

impl ReportCase for TruckCase {
    /// The corners of its wedges.
    type Along = Option<ContactTable>;
    type Shown = TruckRun;

    fn start(&self) -> Result<Run<Self>, RunError> {
        Run::with_contacts(self)
    }

    fn finish(run: Run<Self>, go_on: &mut GoOn<'_>) -> (TruckResult, Self::Along) {
        run.finish_with_contacts(go_on)
    }

    fn shown(self, result: TruckResult, contacts: Self::Along) -> TruckRun {
        TruckRun {
            case: self,
            result,
            contacts,
        }
    }

    fn parts(shown: &TruckRun) -> (&Self, &TruckResult) {
        (&shown.case, &shown.result)
    }

    fn recording(shown: &TruckRun, detail: Detail) -> Recording {
        Recording::of_three_piece_truck(&shown.case, &shown.result, shown.contacts.as_ref(), detail)
    }

    fn page(shown: &TruckRun) -> Result<String, serde_json::Error> {
        page::truck_run::render(shown)
    }

    fn in_words(summary: &TruckSummary, _: Duration) -> (TerminalTable, String) {
        (table(summary), NOTE.to_owned())
    }

    /// Returns the loop of warp where the truck warps, of roll where the bolster rolls, else of the vertical
    /// motion.
    fn shown_loop(&self, result: &TruckResult) -> Loop {
        let range = |name: &str| range(result.column(name));
        let (title, x, y) = if range("warp_angle") > 1e-3 {
            (
                "Warp moment over the warp angle",
                ("warp_angle", "warp angle"),
                ("warp_moment", "warp moment on the bolster"),
            )
        } else if range("bolster_roll") > 1e-3 {
            (
                "Roll moment over the bolster's roll",
                ("bolster_roll", "bolster, roll"),
                ("bolster_roll_moment", "roll moment on the bolster"),
            )
        } else {
            (
                "Load of the left nest over the bolster's travel",
                ("bolster_z", "bolster, vertical"),
                ("left_nest_vertical_force", "load of the left nest"),
            )
        };
        let cycles = &result.summary.cycles;
        // Lands are named after the wedges beside them.
        let is_of = |name: &str, wedge: &str| name.starts_with(wedge) && !name.contains("_land_");
        let of_wedges = |name: &str| WEDGE_NAMES.iter().any(|wedge| is_of(name, wedge));
        let losses = cycles.losses.iter().filter(|(name, _)| of_wedges(name));
        let sum: f64 = losses.map(|(_, loss)| loss.value).sum();
        Loop {
            title,
            x: LoopAxis::new(x.0, x.1),
            y: LoopAxis::new(y.0, y.1),
            energy_of: "Energy lost at the four wedges",
            energy_per: CYCLE,
            energy: (cycles.count > 0).then(|| joules(sum, result.summary.units)),
            missing: cycles.missing.clone(),
        }
    }
}

impl RunFiles for TruckCase {}

/// The note that explains the columns of a truck's table.
const NOTE: &str = "\
Column normal force: of each wedge, its least and largest at any output time. Energy per cycle: lost in \
friction at column and
slope, over whole cycles of the first periodic motion after the first one.";

/// Returns the table of a truck's wedges.
fn table(summary: &TruckSummary) -> TerminalTable {
    let [force, energy] = [Kind::Force, Kind::Energy].map(|kind| kind.label(summary.units));
    let mut table = TerminalTable::new(
        1,
        &[
            ("wedge", ""),
            ("column normal force, least", force),
            ("largest", force),
            ("energy per cycle", energy),
        ],
    );
    for name in WEDGE_NAMES {
        let column = format!("{name}_column_normal_{}", Kind::Force.suffix(summary.units));
        let extremes = summary.extremes.get(&column);
        let cell = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1}"));
        table.row([
            name.replace('_', " "),
            cell(extremes.map(|found| found.minimum)),
            cell(extremes.map(|found| found.maximum)),
            cell(summary.cycles.loss_of_wedges(&[name])),
        ]);
    }
    table
}
