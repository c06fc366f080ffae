//! The summary of a run, from its table and counts.

use std::collections::BTreeMap;

use integrate::Family;
use mechanics::friction::FrictionLaw;
use mechanics::system::scales;
use quantity::Kind;
use wedge::face::FaceProperties;
use wedge::outputs::{FACES, Outputs};

use super::{EVENT_CAP, Run, findings, pressed};
use crate::assumptions;
use crate::case::Case;
use crate::closed_form;
use crate::energy;
use crate::geometry;
use crate::jam::{self, JamMargins};
use crate::losses::{EnergySummary, Equivalent};
use crate::metrics::{Cycle, FirstHarmonic, first_harmonic, mean, window_of};
use crate::plausibility;
use crate::summary::{
    Averages, Events, FrictionSummary, LedgerSummary, SCHEMA, Solver, Stopped, Summary, SummaryValue,
};

/// Number of columns at the beginning of the table with fixed names; their extremes are reported.
const FIXED_COLUMNS: usize = 18;
const EVENT_KINDS: [&str; 4] = ["opens", "closes", "sticks", "slips"];
const BRANCH_COLUMNS: [&str; 5] = [
    "vertical_wedge_force",
    "vertical_force_on_side_frame",
    "longitudinal_wedge_force",
    "side_frame_dissipation",
    "bolster_dissipation",
];

pub(super) fn summary(run: &mut Run<Case>, stopped: Option<Stopped>) -> Summary {
    let units = run.case.simulation.output_units;
    let damped = run.case.simulation.method.tableau().family == Family::DiagonallyImplicit;
    let ended = run.ended(stopped, &run.recorder.rows, what_to_do(damped));
    let extremes = run.recorder.rows.extremes_of_first(FIXED_COLUMNS, units);
    let ledger = ledger(run);
    let on_bolster = on_bolster(run);
    let parameters = &run.case.parameters;
    let (massless, yaw) = (closed_form::wedge(parameters), closed_form::yaw(parameters));
    Summary {
        warnings: warnings(run, damped, ended.warnings),
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: run.case.name.clone(),
        title: run.case.title.clone(),
        units,
        complete: ended.complete,
        stopped: ended.stopped,
        failed: ended.failed,
        rows: ended.rows,
        averages: averages(run, on_bolster),
        extremes,
        events: events(run),
        friction: friction(run),
        jam: Some(JamMargins::new(&massless, yaw, units)),
        ledger,
        energy: energies(run, on_bolster),
        solver: solver(run),
        assumptions: assumptions::of(&run.recorder.wedge),
    }
}

/// Returns the warnings: first of all that about the method, then those that all runs have.
fn warnings(run: &Run<Case>, damped: bool, common: Vec<String>) -> Vec<String> {
    let mut warnings = Vec::new();
    if damped {
        warnings.push(format!(
            "{} damps the vibrations of contacts: read averages, not single values",
            run.case.simulation.method.tableau().name
        ));
    }
    warnings.extend(common);
    warnings.extend(findings::warnings(run));
    let parameters = &run.case.parameters;
    let faces = [&parameters.column_face, &parameters.slope_face];
    let (columns, values) = (run.recorder.rows.columns(), run.recorder.rows.values());
    let few = faces.into_iter().enumerate();
    warnings.extend(few.filter_map(|(face, own)| pressed::warning(face, own, columns, values)));
    warnings.extend(jam::expelled(
        &closed_form::wedge(parameters),
        closed_form::yaw(parameters),
    ));
    warnings.extend(geometry::of_angle(parameters.wedge.angle));
    if run.case.nothing_given {
        warnings.push(plausibility::NOTHING_GIVEN.to_owned());
    }
    if run.integrator.statistics().events_unresolved > 0 {
        warnings.push(format!(
            "{} steps held more contact events than could be resolved: contact states are doubtful there",
            run.integrator.statistics().events_unresolved
        ));
    }
    warnings
}

/// Returns the advice on a ledger that does not close.
fn what_to_do(damped: bool) -> &'static str {
    if damped {
        energy::WHAT_TO_DO_WHERE_DAMPED
    } else {
        energy::WHAT_TO_DO
    }
}

fn averages(run: &Run<Case>, on_bolster: Option<FirstHarmonic>) -> Averages {
    let units = run.case.simulation.output_units;
    let duration = run.case.simulation.duration;
    let missing = |why: &str| Averages {
        missing: why.to_owned(),
        ..Averages::default()
    };
    let Some(cycle) = Cycle::of(&run.case.parameters) else {
        return missing("the bolster's vertical motion is not one sine or triangle");
    };
    let mut averages = Averages::default();
    match (cycle.window(duration), run.recorder.counts.probes.as_slice()) {
        (Some((_, _, cycles)), [start, end]) => {
            averages.cycles = cycles;
            for (side, neighbour) in ["side_frame", "bolster"].into_iter().enumerate() {
                let energy = (end[side] - start[side]) / f64::from(cycles);
                averages.energy_per_cycle.insert(
                    neighbour.to_owned(),
                    SummaryValue::new(energy, Kind::Energy, units),
                );
                if side == 0 {
                    let damping = cycle.equivalent_damping(energy);
                    averages.equivalent_damping = Some(SummaryValue::new(damping, Kind::Damping, units));
                }
            }
        }
        _ => averages.missing = "no whole cycle after the first half period".to_owned(),
    }
    let column = |name: &str| column(run, name);
    if let Some(on_bolster) = on_bolster {
        averages.equivalent_stiffness = Some(SummaryValue::new(on_bolster.stiffness, Kind::Stiffness, units));
        averages.equivalent_damping_on_bolster =
            Some(SummaryValue::new(on_bolster.damping, Kind::Damping, units));
    }
    let (times, positions, speeds) = (
        run.recorder.rows.column("time"),
        column("bolster_vertical"),
        column("bolster_vertical_rate"),
    );
    let mut rows = [Vec::new(), Vec::new()];
    for (row, ((time, position), speed)) in times.iter().zip(positions).zip(speeds).enumerate() {
        if let Some(up) = cycle.branch(run.case.parameters.damping, *time, *position, *speed) {
            rows[usize::from(up)].push(row);
        }
    }
    averages.window = window_of(run.case.parameters.damping).to_owned();
    for (rows, target) in rows.iter().zip([&mut averages.down, &mut averages.up]) {
        for name in BRANCH_COLUMNS {
            let kind = if name.ends_with("dissipation") {
                Kind::Power
            } else {
                Kind::Force
            };
            if let Some(mean) = mean(column(name), rows) {
                target.insert(name.to_owned(), SummaryValue::new(mean, kind, units));
            }
        }
    }
    averages
}

/// Returns the values of a column that [`reads`] has.
fn column<'r>(run: &'r Run<Case>, name: &str) -> &'r [f64] {
    run.recorder.rows.column(name)
}

/// Returns whether the summary of a case reads a column row by row.
pub(super) fn reads(case: &Case, name: &str) -> bool {
    let parameters = &case.parameters;
    let faces = FACES
        .iter()
        .zip([&parameters.column_face, &parameters.slope_face]);
    let of_face = |(face, own): (&&str, &FaceProperties)| {
        pressed::curved(own).is_some() && name.starts_with(*face) && name.ends_with("_pressure")
    };
    matches!(
        name,
        "bolster_vertical" | "bolster_vertical_rate" | "net_force_on_bolster_z"
    ) || BRANCH_COLUMNS.contains(&name)
        || faces.into_iter().any(of_face)
}

/// Returns stiffness and damping of the first harmonic of the vertical force on the bolster.
fn on_bolster(run: &Run<Case>) -> Option<FirstHarmonic> {
    let cycle = Cycle::of(&run.case.parameters)?;
    let (start, end, _) = cycle.window(run.case.simulation.duration)?;
    first_harmonic(
        run.recorder.rows.column("time"),
        column(run, "bolster_vertical"),
        column(run, "net_force_on_bolster_z"),
        cycle.angular_frequency,
        (start, end),
    )
}

/// Returns the losses of a cycle.
fn energies(run: &Run<Case>, on_bolster: Option<FirstHarmonic>) -> EnergySummary {
    let units = run.case.simulation.output_units;
    let Some(cycle) = Cycle::of(&run.case.parameters) else {
        let held = run.case.parameters.bolster.coordinates[2].is_constant();
        return EnergySummary::none(if held {
            "the bolster does not move up and down: nothing cycles"
        } else {
            "the bolster's vertical motion is not one sine or triangle"
        });
    };
    let points = &run.recorder.points;
    let names: Vec<String> = (0..run.system.point_count())
        .map(|point| {
            let (face, name) = points.face_and_name(point);
            format!("{}_{name}", FACES[face])
        })
        .collect();
    match run.recorder.losses.summary(&run.system, &names, units) {
        Some((summary, lost)) => EnergySummary {
            equivalent: Some(Equivalent::new(lost, &cycle, on_bolster, units)),
            ..summary
        },
        None if cycle.window(run.case.simulation.duration).is_some() => {
            EnergySummary::none("the run stopped before its last whole cycle ended")
        }
        None => EnergySummary::none("no whole cycle after the first half period"),
    }
}

fn events(run: &Run<Case>) -> Events {
    let statistics = run.integrator.statistics();
    let counts = FACES
        .iter()
        .zip(&run.recorder.counts.events)
        .map(|(face, counts)| {
            let kinds = EVENT_KINDS
                .iter()
                .zip(counts)
                .map(|(kind, count)| ((*kind).to_owned(), *count))
                .collect();
            ((*face).to_owned(), kinds)
        })
        .collect();
    Events {
        total: run.recorder.counts.event_total,
        counts,
        unresolved: statistics.events_unresolved,
        motion_breaks: statistics.restarts,
        thresholds: vec![
            "a corner closes where it is pressed in by 1e-11 in (2.54e-13 m), and opens where its normal \
             force ends"
                .to_owned(),
            "tanh: slip begins at |v| = 2 v0 (96 % of the friction limit), stick at |v| = v0 (76 %)"
                .to_owned(),
            "bristle: slip begins at |T| = μN, stick at |T| = 0.999 μN".to_owned(),
        ],
        listed: run.recorder.counts.listed.clone(),
        cap: EVENT_CAP,
    }
}

fn friction(run: &Run<Case>) -> BTreeMap<String, FrictionSummary> {
    let units = run.case.simulation.output_units;
    let parameters = &run.case.parameters;
    let faces = [
        parameters.column_face.friction(&parameters.column_friction),
        parameters.slope_face.friction(&parameters.slope_friction),
    ];
    FACES
        .iter()
        .zip(faces)
        .enumerate()
        .map(|(number, (name, face))| {
            let crept = &run.recorder.counts.crept[run.recorder.points.range(number)];
            let law = match face.law {
                FrictionLaw::Tanh { .. } => "tanh",
                FrictionLaw::Bristle { .. } => "bristle",
            };
            let crept = crept.iter().fold(0.0, |most: f64, crept| most.max(*crept));
            let summary = FrictionSummary {
                law: law.to_owned(),
                coefficient: face.coefficient,
                creep_speed_at_half_load: SummaryValue::new(face.law.creep_speed(0.5), Kind::Speed, units),
                crept_while_stuck: SummaryValue::new(crept, Kind::Length, units),
            };
            ((*name).to_owned(), summary)
        })
        .collect()
}

fn ledger(run: &mut Run<Case>) -> LedgerSummary {
    let units = run.case.simulation.output_units;
    run.system.segment_like(run.integrator.problem());
    let seen = run.system.observe(run.integrator.time(), run.integrator.x());
    let ledger = Outputs::ledger(&run.system, &seen, run.start_energy);
    let measure = |value: f64| SummaryValue::new(value, Kind::Energy, units);
    let entries = [
        ("motion_work", ledger.motion_work),
        ("coil_guide_work", ledger.coil_guide_work),
        ("stored", ledger.stored),
        ("side_frame_friction_loss", ledger.side_frame_friction_loss),
        ("bolster_friction_loss", ledger.bolster_friction_loss),
        ("contact_damping_loss", ledger.contact_damping_loss),
        ("coil_damping_loss", ledger.coil_damping_loss),
        ("residual", ledger.residual),
    ];
    let entries = entries.map(|(name, value)| (name.to_owned(), measure(value)));
    LedgerSummary::new(entries.into(), run.start_energy, &run.energy_balance, units)
}

fn solver(run: &Run<Case>) -> Solver {
    let scale = |value: f64, unit: &str| format!("{value} {unit}");
    Solver {
        method: run.case.simulation.method.to_string(),
        relative_tolerance: run.case.simulation.relative_tolerance,
        scales: [
            ("displacement", scale(scales::DISPLACEMENT, "m")),
            ("angle", scale(scales::ANGLE, "rad")),
            ("velocity", scale(scales::VELOCITY, "m/s")),
            ("angular_velocity", scale(scales::ANGULAR_VELOCITY, "rad/s")),
            ("bristle_deflection", scale(scales::DEFLECTION, "m")),
            ("energy", scale(scales::ENERGY, "J")),
            ("contact_damping_loss", scale(scales::CONTACT_DAMPING_LOSS, "J")),
        ]
        .into_iter()
        .map(|(name, scale)| (name.to_owned(), scale))
        .collect(),
        statistics: run.integrator.statistics().clone(),
    }
}
