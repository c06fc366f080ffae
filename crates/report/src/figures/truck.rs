//! Figures of one run of a truck: its loop, its warp, the states of its wedges' corners, its energies.

use ::study::contacts::ContactTable;
use ::study::truck::TruckCase;
use ::study::truck::WEDGE_NAMES;
use ::study::truck::loop_curve::LoopCurve;
use ::study::truck::run::TruckResult;
use ::study::truck::warp::WarpCurve;
use quantity::Kind;
use truck::HALVES;

use super::{Exhibit, axis, curve, lowered, power_flow};
use crate::warp_files::Tested;
use crate::{curves_files, warp_files};
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// A run of a truck.
#[derive(Clone, Debug)]
pub struct TruckRun {
    /// Its case.
    pub case: TruckCase,
    /// The outcome.
    pub result: TruckResult,
    /// The corners of its wedges, if the run took them along.
    pub contacts: Option<ContactTable>,
}

impl TruckRun {
    /// Returns the sentence about its warp, if it warps.
    #[must_use]
    pub fn warp(&self) -> Option<WarpCurve> {
        WarpCurve::of(&self.case, &self.result)
    }

    /// Returns its vertical or roll loop, if it has one.
    #[must_use]
    pub fn hysteresis(&self) -> Option<LoopCurve> {
        LoopCurve::of(&self.case, &self.result)
    }
}

/// Returns the figures of a run.
#[must_use]
pub fn exhibits(run: &TruckRun) -> Vec<Exhibit> {
    let name = run.case.name.as_str();
    let exhibit = |what: &str, figure: Figure| {
        Exhibit::new(
            format!("{name}_{what}"),
            Figure {
                title: format!("{name}: {}", lowered(&figure.title)),
                ..figure
            },
        )
    };
    let mut exhibits = Vec::new();
    if let Some(own) = run.hysteresis() {
        exhibits.push(exhibit(
            "loop",
            Figure {
                title: "Hysteresis loop".to_owned(),
                ..curves_files::figure(&[(String::new(), own)])
            },
        ));
    }
    if let Some(curve) = run.warp() {
        let tested = Tested {
            label: String::new(),
            result: run.result.clone(),
            curve,
        };
        exhibits.push(exhibit("warp", warp_files::figure(&[tested])));
    }
    exhibits.push(exhibit("wedges", wedges(run)));
    if let Some(contacts) = &run.contacts {
        exhibits.push(exhibit("contact_states", contact_states(run, contacts)));
    }
    exhibits.push(exhibit("energy_ledger", ledger(run)));
    if let Some(figure) = power_flow::figure(&run.result.summary.energy) {
        exhibits.push(exhibit("power_flow", figure));
    }
    exhibits
}

/// Forces of the wedges over time.
fn wedges(run: &TruckRun) -> Figure {
    let units = run.result.summary.units;
    let panel = |letter: char, title: &str, what: &str| {
        let curves = WEDGE_NAMES.into_iter().enumerate().map(|(number, wedge)| {
            let (colour, line) = distinct(number);
            let (label, name) = (wedge.replace('_', " "), format!("{wedge}_{what}"));
            curve(&run.result, "time", &name, (&label, colour, line))
        });
        Panel::new(
            format!("({letter}) {title}"),
            "time (s)",
            axis("force", Kind::Force, units),
            curves,
        )
    };
    Figure::new(
        "Forces of the wedges",
        "Wedge by wedge: normal force of the column, its friction on the side frame along z \
                  (positive up), normal force of the slope.",
        [
            panel('a', "column, normal", "column_normal"),
            panel('b', "column, friction", "column_friction_z"),
            panel('c', "slope, normal", "slope_normal"),
        ],
    )
}

/// For each wedge and face how many of its four corners are open, stick and slip.
fn contact_states(run: &TruckRun, contacts: &ContactTable) -> Figure {
    const STATES: [(&str, Colour, Line); 3] = [
        ("open", Colour::Sky, Line::Solid),
        ("stick", Colour::Black, Line::Solid),
        ("slip", Colour::Orange, Line::Solid),
    ];
    let times = run.result.column("time").unwrap_or_default();
    let mut panels = Vec::new();
    for face in ["column", "slope"] {
        for wedge in WEDGE_NAMES {
            let mut stems = vec![format!("{wedge}_{face}_")];
            stems.extend(HALVES.map(|half| format!("{wedge}_{half}_{face}_")));
            let is_own = |name: &str| stems.iter().any(|stem| name.starts_with(stem));
            let strips: Vec<&[f64]> = contacts
                .columns
                .iter()
                .zip(&contacts.values)
                .filter(|(column, _)| is_own(&column.name) && column.name.ends_with("_state"))
                .map(|(_, values)| values.as_slice())
                .collect();
            if strips.is_empty() {
                continue;
            }
            let curves = STATES
                .into_iter()
                .enumerate()
                .map(|(state, (label, colour, line))| {
                    let share = |row: usize| {
                        let own = strips
                            .iter()
                            .filter(|strip| strip.get(row).is_some_and(|own| *own == state as f64));
                        100.0 * own.count() as f64 / strips.len() as f64
                    };
                    // Steps: only where the share changes, held until then.
                    let mut points: Vec<(f64, f64)> = Vec::new();
                    for (row, time) in times.iter().enumerate() {
                        let now = share(row);
                        match points.last().copied() {
                            Some((_, before)) if before == now && row + 1 < times.len() => {}
                            Some((_, before)) => points.extend([(*time, before), (*time, now)]),
                            None => points.push((*time, now)),
                        }
                    }
                    PlotCurve::new(label, (colour, line), points)
                });
            panels.push(Panel::new(
                format!("{}, {face}", wedge.replace('_', " ")),
                "time (s)",
                "corners (%)",
                curves,
            ));
        }
    }
    Figure::new(
        "Contact states",
        "Of the corners (or points of a grid) of each wedge at column and slope, the share that is \
                  open, sticks, and slips. With bristles a corner slips where its friction has reached its \
                  limit.",
        panels,
    )
    .in_columns(4)
}

fn ledger(run: &TruckRun) -> Figure {
    const ENTRIES: [(&str, &str); 5] = [
        ("motion_work", "work of the motions"),
        ("friction_loss", "lost in friction"),
        ("stored_energy_change", "stored, less that at the start"),
        ("contact_damping_loss", "lost in contact damping"),
        ("element_loss", "lost in coils and stops"),
    ];
    let units = run.result.summary.units;
    let curve = |number: usize, name: &str, label: &str| {
        let (colour, line) = distinct(number);
        curve(&run.result, "time", name, (label, colour, line))
    };
    let panel = |title: &str, curves: Vec<PlotCurve>| {
        Panel::new(title, "time (s)", axis("energy", Kind::Energy, units), curves)
    };
    let entries = ENTRIES.into_iter().enumerate();
    let faces = ["column", "slope"]
        .into_iter()
        .flat_map(|face| WEDGE_NAMES.map(|wedge| (face, wedge)))
        .enumerate()
        .map(|(number, (face, wedge))| {
            let label = format!("{}, {face}", wedge.replace('_', " "));
            curve(number, &format!("{wedge}_{face}_friction_loss"), &label)
        });
    Figure::new(
        "Energy ledger",
        "(a) Work since the start and where it went; every loss is integrated from its own force \
                  and velocity. (b) What the friction of each wedge's faces took. (c) What does not add up: \
                  the work less stored energy and losses.",
        [
            panel(
                "(a) entries",
                entries
                    .map(|(number, (name, label))| curve(number, name, label))
                    .collect(),
            ),
            panel("(b) by wedge and face", faces.collect()),
            panel("(c) residual", vec![curve(1, "ledger_residual", "residual")]),
        ],
    )
}

/// Returns the figures of all rigs together, for the report: vertical and roll loops, warp loops, states of
/// the wedges.
#[must_use]
pub fn of_rigs(runs: &[TruckRun], smooth: Option<&TruckRun>) -> Vec<Exhibit> {
    let exhibit = |name: &str, title: &str, figure: Figure| {
        Exhibit::new(
            format!("truck_{name}"),
            Figure {
                title: title.to_owned(),
                ..figure
            },
        )
    };
    let loops = |stem: &str, empty: bool| -> Vec<(String, LoopCurve)> {
        let own = runs.iter().filter_map(|run| {
            let rest = run.case.name.strip_prefix(&format!("truck_{stem}_"))?;
            let short = rest.strip_suffix("_empty");
            (short.is_some() == empty).then(|| (short.unwrap_or(rest).replace('_', " "), run))
        });
        own.filter_map(|(short, run)| Some((short, run.hysteresis()?)))
            .collect()
    };
    let tested = |run: &TruckRun, label: String| {
        Some(Tested {
            label,
            result: run.result.clone(),
            curve: run.warp()?,
        })
    };
    let named = |name: &str| runs.iter().find(|run| run.case.name == name);
    let mut warps: Vec<Tested> = Vec::new();
    for (name, label) in [
        ("truck_warp_nest_constant_rising", "constant, new"),
        ("truck_warp_nest_variable_rising", "variable, new"),
        ("truck_warp_nest_constant_rising_empty", "constant, new, empty"),
        ("truck_warp_nest_variable_rising_empty", "variable, new, empty"),
    ] {
        warps.extend(named(name).and_then(|run| tested(run, label.to_owned())));
    }
    warps.extend(smooth.and_then(|run| tested(run, "constant, mu 0.25".to_owned())));
    let mut exhibits = Vec::new();
    for (stem, title) in [
        ("vertical", "Up and down: both nests"),
        ("roll", "Roll: both nests"),
    ] {
        for (empty, name, title) in [
            (false, format!("{stem}_loops"), title.to_owned()),
            (true, format!("{stem}_loops_empty"), format!("{title}, empty car")),
        ] {
            let own = loops(stem, empty);
            if !own.is_empty() {
                exhibits.push(exhibit(&name, &title, curves_files::figure(&own)));
            }
        }
    }
    if !warps.is_empty() {
        exhibits.push(exhibit(
            "warp_loops",
            "Warp of the nests",
            warp_files::figure(&warps),
        ));
    }
    for name in ["truck_vertical_variable", "truck_warp_nest_constant_rising"] {
        if let Some(run) = named(name)
            && let Some(contacts) = &run.contacts
        {
            let figure = contact_states(run, contacts);
            let title = format!("{name}: contact states");
            exhibits.push(Exhibit {
                name: format!("{name}_contact_states"),
                ..exhibit("", &title, figure)
            });
        }
    }
    exhibits
}
