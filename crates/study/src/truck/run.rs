//! Running a truck.

use integrate::Integrator;
use mechanics::energy_balance::Entries;
use mechanics::motion::Motion;
use mechanics::output::Column;
use mechanics::quasi_static::QuasiStaticWedge;
use mechanics::system::{EnergyTermKind, System};
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::{ControlCoil, Mount, Parameters, Truck, WEDGE_NAMES, held};
use wedge::parameters::Start;

use super::TruckCase;
use super::columns::TruckTable;
use super::summary::{Cycles, SCHEMA, TruckSummary, warp_stiffnesses};
use crate::contacts::{ContactTable, TakesCorners};
use crate::energy;
use crate::finite::find;
use crate::jam::{self, JamMargins};
use crate::losses::stroke::Stroke;
use crate::losses::{EnergySummary, LossCounts, LossRecorder};
use crate::models::ModelCase;
use crate::progress::{self, ADVANCE, Pace};
use crate::reader::CaseText;
use crate::result::RunResult;
use crate::run::{
    Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, findings,
};
use crate::run_error::{check_finite, check_length, damaged};
use crate::summary::{Stopped, SummaryValue};
use crate::wear::mounted::{Over, SavedWork, WedgesWork};
use crate::{geometry, wedge_faces, wedge_rise};

/// The result of a run.
pub type TruckResult = RunResult<TruckSummary>;

const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Forces of faces, coils and stops above this tear a truck apart, N: 5 million lbf, forty times the weight
/// of a loaded half car.
const MOST_FORCE: f64 = 5e6 * POUND_FORCE;

/// The number of cycles of the wear of wedges.
const CYCLES: f64 = 1e6;
/// Columns that the summary reads row by row.
const KEPT: [&str; 7] = [
    "warp_angle",
    "warp_moment",
    "bolster_z",
    "left_side_frame_z",
    "right_side_frame_z",
    "left_nest_vertical_force",
    "right_nest_vertical_force",
];

/// Records a truck's run: its table, and the energies at both ends of the whole cycles.
pub struct TruckRecorder {
    table: TruckTable,
    rows: RowTable,
    /// The ends of the whole cycles, s, and their number.
    window: Option<([f64; 2], u32)>,
    counts: TruckCounts,
    /// The corners of the wedges, where they are asked for.
    contacts: Option<ContactTable>,
    /// The bodies of the wedges, and of their halves, with the areas of column and slope, m².
    wedges: Vec<(usize, [f64; 2])>,
    /// What wears the wedges, in the whole cycles.
    work: WedgesWork,
    /// The time of the row before.
    before: f64,
    pub(super) losses: LossRecorder,
}

/// The counts along a truck's run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TruckCounts {
    /// The quadratures at the ends of the whole cycles that were passed, J.
    pub quadratures: Vec<Vec<f64>>,
    /// Losses by point, contact state and part of the stroke.
    pub losses: LossCounts,
    /// The rows, as far as the summary needs them.
    pub table: SavedRows,
    /// What wears the wedges.
    #[serde(default)]
    pub work: SavedWork,
}

/// Returns period (s) and beginning (s) of a motion, if it is periodic or a part of it is.
#[must_use]
pub fn period_of(motion: &Motion) -> Option<[f64; 2]> {
    Stroke::of(motion).map(|stroke| [stroke.period, stroke.begin])
}

/// Returns period (s) and beginning (s) of the first periodic motion or load of a truck.
#[must_use]
pub fn period(parameters: &Parameters) -> Option<[f64; 2]> {
    super::energies::drive(parameters).map(|drive| [drive.stroke.period, drive.stroke.begin])
}

/// Returns the ends (s) and the number of the whole cycles after the first.
pub(crate) fn window(case: &TruckCase) -> Option<([f64; 2], u32)> {
    let [period, start] = period(&case.parameters)?;
    let first = start + period;
    let duration = case.simulation.duration;
    let cycles = ((duration - first) / period * (1.0 + 1e-12)).floor();
    (cycles >= 1.0).then(|| ([first, (first + cycles * period).min(duration)], cycles as u32))
}

impl RunCase for TruckCase {
    type Recorder = TruckRecorder;
    type Output = TruckResult;

    const WHERE_TO_LOOK: &'static str =
        "look for values that are out of proportion; `wedgelab case` has trucks that run";
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY;

    fn settings(&self) -> RunSettings<'_> {
        RunSettings::of(&self.name, &self.simulation)
    }

    fn begin(&self) -> Result<Beginning<TruckRecorder>, RunError> {
        let table = TruckTable::new(self)?;
        Ok(Beginning {
            system: table.system().clone(),
            x: self.settled(table.truck())?,
            start_warning: table.truck().start_warning.clone(),
            recorder: TruckRecorder {
                rows: RowTable::new(table.columns(), |name| KEPT.contains(&name)),
                window: window(self),
                counts: TruckCounts::default(),
                contacts: None,
                wedges: wedges(&self.parameters),
                work: WedgesWork::new(table.system(), &[("", &self.parameters.wedges)]),
                before: 0.0,
                losses: LossRecorder::new(table.system(), super::energies::window(self)),
                table,
            },
        })
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> TruckResult {
        output(run, stopped)
    }
}

impl ModelCase for TruckCase {
    type Summary = TruckSummary;

    const ENERGY: Option<fn(&TruckSummary) -> &EnergySummary> = Some(|own| &own.energy);

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        Ok(TruckTable::new(self)?.columns().to_vec())
    }

    fn text(&self) -> Option<&CaseText> {
        Some(&self.text)
    }
}

/// Returns the bodies of the wedges, and of their halves, with the areas of column and slope, m².
fn wedges(parameters: &Parameters) -> Vec<(usize, [f64; 2])> {
    let bodies = Mount::alone(parameters).bodies;
    let parts = parameters.wedge_parts().into_iter();
    parts
        .map(|part| (bodies[part.number], part.own.face_areas()))
        .collect()
}

impl TruckCase {
    /// Returns the state at time zero: the truck's start, after the motions have been held for
    /// [`TruckCase::settle`].
    fn settled(&self, truck: &Truck) -> Result<Vec<f64>, RunError> {
        if self.settle == 0.0 {
            return Ok(truck.initial_state.clone());
        }
        let still = Truck::new(&held(&self.parameters))?;
        let layout = still.system.layout();
        let mut integrator = Integrator::new(still.system, self.options(), 0.0, &truck.initial_state)?;
        let mut pace = Pace::of(&integrator);
        while integrator.time() < self.settle {
            let step = integrator.step_to(self.settle).map_err(|error| error.to_string());
            let progress = step.and_then(|_| {
                pace.check(&integrator, ADVANCE)
                    .map_err(|stalled| stalled.to_string())
            });
            progress.map_err(|reason| RunError::Step {
                reason: format!("while the truck settles: {reason}"),
                contacts: "not stated".to_owned(),
            })?;
        }
        let mut x = integrator.x().to_vec();
        let [_, _, _, quadratures] = layout.split_mut(&mut x);
        quadratures.fill(0.0);
        Ok(x)
    }
}

impl Run<TruckCase> {
    /// Returns the columns of the result.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.recorder.table.columns()
    }
}

impl Recorder for TruckRecorder {
    type Counts = TruckCounts;

    fn counts(&self) -> TruckCounts {
        TruckCounts {
            losses: self.losses.counts(),
            table: self.rows.saved(),
            work: self.work.saved(),
            ..self.counts.clone()
        }
    }

    fn restore(&mut self, mut counts: TruckCounts, time: f64, times: &[f64]) -> Result<(), RunError> {
        let ends = self.window.iter().flat_map(|(ends, _)| ends);
        let passed = ends.filter(|end| **end <= time).count();
        check_length("counts.quadratures", counts.quadratures.len(), passed)?;
        let terms = self.table.system().energy_terms().len();
        for quadratures in &counts.quadratures {
            check_length("counts.quadratures", quadratures.len(), terms)?;
            quadratures
                .iter()
                .try_for_each(|value| check_finite("counts.quadratures", *value))?;
        }
        self.losses.restore(counts.losses.clone(), time)?;
        self.rows.restore(std::mem::take(&mut counts.table), times)?;
        if !self.work.restore(std::mem::take(&mut counts.work)) {
            return damaged("counts.work", "sums of other wedges", "those of the case's");
        }
        self.before = times.last().copied().unwrap_or_default();
        self.counts = counts;
        Ok(())
    }

    fn step(&mut self, integrator: &Integrator<System>, system: &mut System, x: &mut [f64]) {
        self.losses.step(integrator, system, x);
        let Some((ends, _)) = self.window else { return };
        while let Some(end) = ends.get(self.counts.quadratures.len()) {
            if *end > integrator.time() {
                return;
            }
            integrator.interpolate_range(*end, 0, x);
            let [_, _, _, quadratures] = system.layout().split(x);
            self.counts.quadratures.push(quadratures.to_vec());
        }
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let observation = system.observe(row.time, row.x);
        let values = self.rows.begin_row();
        let loads = self.table.read(&observation, row.start_energy, values);
        let (number, force) = loads.largest;
        let mut largest = (self.table.truck().suspension_name(number), force);
        for (face, mounted) in observation.faces.iter().zip(system.faces()) {
            let force: f64 = face.points.iter().map(|point| point.normal).sum();
            if force > largest.1 {
                largest = (&mounted.element.name, force);
            }
        }
        if largest.1 > MOST_FORCE {
            return Err(RunError::TornApart {
                element: largest.0.to_owned(),
                force: largest.1 / POUND_FORCE,
                limit: MOST_FORCE / POUND_FORCE,
                time: row.time,
            });
        }
        self.rows.append(row.time)?;
        if let Some(contacts) = &mut self.contacts {
            contacts.take(&observation, row.contact_states);
        }
        if let Some(([start, end], _)) = self.window
            && (start..=end).contains(&row.time)
        {
            let [_, _, _, quadratures] = system.layout().split(row.x);
            let time = row.time - self.before.max(start);
            self.work.take(&observation, quadratures, [time, 0.0]);
        }
        self.before = row.time;
        Ok(system.ledger_entries(&observation, row.start_energy))
    }
}

impl TakesCorners for TruckRecorder {
    fn wedges(&self) -> Vec<usize> {
        self.wedges.iter().map(|(body, _)| *body).collect()
    }

    fn face_areas(&self) -> Vec<[f64; 2]> {
        self.wedges.iter().map(|(_, areas)| *areas).collect()
    }

    fn corners(&mut self) -> &mut Option<ContactTable> {
        &mut self.contacts
    }
}

fn output(mut run: Run<TruckCase>, stopped: Option<Stopped>) -> TruckResult {
    let units = run.case.simulation.output_units;
    let table = std::mem::take(&mut run.recorder.rows);
    let mut ended = run.ended(stopped, &table, energy::WHAT_TO_DO);
    let (ledger, cycles) = (run.last_ledger(&mut ended), cycles(&run));
    run.stop(&mut ended, find(&cycles.losses).map(|name| format!("`{name}`")));
    let mut warnings = ended.warnings;
    warnings.extend(findings::warnings_by_kind(&run));
    warnings.extend(surplus(&run.case, units));
    warnings.extend(without_coil(&run.case));
    warnings.extend(closed(run.recorder.table.truck(), units));
    warnings.extend(expelled(&run.case.parameters));
    warnings.extend(geometry::of_truck(&run.case.parameters, None));
    let risen = [(
        "",
        &run.case.parameters.wedges,
        run.recorder.table.wedges_at_start(),
    )];
    warnings.extend(wedge_rise::warnings(&risen, units));
    let wedge_rise = wedge_rise::summary(&risen, units);
    let named = wedge_faces::named(&[("", &run.case.parameters.wedges)]);
    warnings.extend(wedge_faces::warnings(&named));
    let wedge_wear = run.recorder.window.and_then(|([start, end], cycles)| {
        let over = Over::Cycles(CYCLES, (end - start) / f64::from(cycles));
        run.recorder.work.summary(&run.case.wear, (&over, units))
    });
    let column = |name: &str| table.column(name);
    let summary = TruckSummary {
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: run.case.name.clone(),
        title: run.case.title.clone(),
        units,
        complete: ended.complete,
        stopped: ended.stopped,
        failed: ended.failed,
        warnings,
        rows: ended.rows,
        cycles,
        warp_stiffness: warp_stiffnesses(column("warp_angle"), column("warp_moment"), units),
        jam: quasi_static(&run.case.parameters)
            .map(|(name, own)| (name.to_owned(), JamMargins::new(&own, 0.0, units)))
            .collect(),
        wedge_rise,
        wedge_wear,
        statics: run.recorder.table.static_table(units),
        extremes: table.summary_extremes(units),
        energy: super::energies::of(&run, &column),
        ledger,
        method: run.case.simulation.method.to_string(),
        relative_tolerance: run.case.simulation.relative_tolerance,
        statistics: ended.statistics,
        assumptions: super::assumptions::of(&run.case),
    };
    table.into_result(summary)
}

/// Returns the quasi-static wedges, with their names.
fn quasi_static(parameters: &Parameters) -> impl Iterator<Item = (&'static str, QuasiStaticWedge)> {
    WEDGE_NAMES
        .into_iter()
        .zip(&parameters.wedges)
        .map(|(name, wedge)| {
            let own = QuasiStaticWedge {
                angle: wedge.angle,
                toe: wedge.toe,
                column_friction: wedge.column_face.friction(&wedge.column_friction).coefficient,
                slope_friction: wedge.slope_face.friction(&wedge.slope_friction).coefficient,
            };
            (name, own)
        })
}

/// Returns the warnings about wedges between faces that do not close upwards.
fn expelled(parameters: &Parameters) -> impl Iterator<Item = String> {
    quasi_static(parameters)
        .filter_map(|(name, own)| Some(format!("wedge {name}: {}", jam::expelled(&own, 0.0)?)))
}

/// A truck that rises or sinks by less is not spoken of, m: the truck's own data close to a ten-thousandth of
/// that.
const SMALL_RISE: f64 = 0.05 * 0.0254;

/// Returns the warning about coils that do not carry what stands on them.
fn surplus(case: &TruckCase, units: Units) -> Option<String> {
    let surplus = case.parameters.surplus()?;
    let rise = surplus / case.parameters.load_stiffness();
    // A truck that settles first, or falls from a height down to where its coils carry it, is meant so.
    let falls = case.parameters.lift > 0.0 && rise > -SMALL_RISE && rise < case.parameters.lift;
    let meant = falls || case.parameters.start == Start::Equilibrium || case.settle > 0.0;
    if meant || rise.abs() < SMALL_RISE {
        return None;
    }
    let [force, length] = [(surplus, Kind::Force), (rise, Kind::Length)].map(|(value, kind)| {
        let value = SummaryValue::new(value.abs(), kind, units);
        format!("{:.4} {}", value.value, value.unit)
    });
    let coils = case.parameters.load_coils.iter().flatten();
    let solid = coils
        .filter_map(|coil| coil.spring.solid)
        .map(|[travel, _]| travel);
    let solid = if solid.fold(f64::INFINITY, f64::min) < -rise {
        ", where its load coils are solid"
    } else {
        ""
    };
    let (more, way) = if surplus > 0.0 {
        ("more", "rises")
    } else {
        ("less", "sinks")
    };
    Some(format!(
        "the coils carry {force} {more} than stands on them in the nominal layout: the truck {way} by about \
         {length}{solid}; set start.kind = \"equilibrium\" or start.lift, or mend the preloads"
    ))
}

/// Returns the warning about wedges that no coil presses.
fn without_coil(case: &TruckCase) -> Option<String> {
    let wedges = WEDGE_NAMES.iter().zip(&case.parameters.wedges);
    let names: Vec<&str> = wedges
        .filter(|(_, wedge)| match &wedge.control_coil {
            ControlCoil::Shear(coil) => coil.preload <= 0.0,
            // The thesis's truck has coils that begin at their free lengths.
            ControlCoil::Table(_) | ControlCoil::Thesis(..) => false,
            ControlCoil::Nothing => true,
        })
        .map(|(name, _)| *name)
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "no coil presses the wedges {} in the nominal layout: they lie loose between column and slope; \
             give control_coil.preload, unless their coils are meant to be broken",
            names.join(", ")
        )
    })
}

/// Returns the warning about stops that have no clearance left at the start.
fn closed(truck: &Truck, units: Units) -> Option<String> {
    let observation = truck.system.clone().observe(0.0, &truck.initial_state);
    let stops = truck.closed_stops(&observation);
    let words = |(name, depth): &(&str, f64)| {
        let depth = SummaryValue::new(*depth, Kind::Length, units);
        format!("{name} ({:.3} {})", depth.value, depth.unit)
    };
    let list: Vec<String> = stops.iter().take(4).map(words).collect();
    let more = match stops.len().saturating_sub(list.len()) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    (!stops.is_empty()).then(|| {
        format!(
            "gaps that are closed at the start, with how far their parts are pressed in: {}{more}; give \
             more clearance, or begin with motions at zero",
            list.join(", ")
        )
    })
}

fn cycles(run: &Run<TruckCase>) -> Cycles {
    let units = run.case.simulation.output_units;
    let missing = |why: &str| Cycles {
        missing: why.to_owned(),
        ..Cycles::default()
    };
    if period(&run.case.parameters).is_none() {
        return missing("no motion or load is a sine or a triangle");
    }
    let (Some((_, count)), [start, end]) = (run.recorder.window, run.recorder.counts.quadratures.as_slice())
    else {
        return missing("no whole cycle after the first one");
    };
    let mut cycles = Cycles {
        count,
        ..Cycles::default()
    };
    for ((term, start), end) in run.system.energy_terms().iter().zip(start).zip(end) {
        let value = SummaryValue::new((end - start) / f64::from(count), Kind::Energy, units);
        if term.kind == EnergyTermKind::MotionWork {
            cycles.work = Some(value);
        } else {
            cycles.losses.insert(term.name(), value);
        }
    }
    cycles
}
