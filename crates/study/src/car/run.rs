//! Running a car.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use car::{Loads, Parameters, Wheels};
use integrate::Problem;
use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::{ContactState, Observation, System};
use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};
use truck::{WEDGE_NAMES, Wedge};
use wheelrail::track::CenterLine;

use super::CarCase;
use super::checks::POUND_FORCE;
use super::columns::{CarTable, losses_of_wedge, points_of_wedges};
use super::figures::CarFigures;
use super::limits::{LimitCheck, LimitSet};
use super::motions::MotionTable;
use super::static_table::static_table;
use super::statistics::filtered::{filtered, look_ahead, with_filtered};
use super::statistics::{Histories, SIDES, Statistic, Statistics};
use super::summary::{CarSummary, Derailed, SCHEMA};
use super::{couplers, limits, locked_in, peaks};
use crate::damage::{Damage, SERVICE, SavedDamage, Weighed};
use crate::energy;
use crate::losses::EnergySummary;
use crate::metrics::Extremes;
use crate::models::ModelCase;
use crate::output_files::OutputFiles;
use crate::progress;
use crate::reader::CaseText;
use crate::result::RunResult;
use crate::run::{
    Beginning, Recorder, Row, RowTable, Run, RunCase, RunError, RunSettings, SavedRows, findings,
};
use crate::run_error::{check_length, damaged};
use crate::statics::StaticTable;
use crate::summary::{Stopped, SummaryValue};
use crate::wear::mounted::{Over, SavedWork, WedgesWork};
use crate::wedge_faces;
use crate::wedge_rise::{self, AtStart};

/// The result of a run.
pub type CarResult = RunResult<CarSummary>;

/// Normal forces above this tear a truck apart, N: 5 million lbf.
const MOST_FORCE: f64 = 5e6 * POUND_FORCE;

/// Records a car's run: its table, and where it derails.
pub struct CarRecorder {
    table: CarTable,
    rows: RowTable,
    /// The same rows and those after them that filtered values depend on, where the run has looked ahead.
    ahead: Option<RowTable>,
    derailed: Option<Derailed>,
    units: Units,
    /// Rates of the state.
    rates: Vec<f64>,
    /// Places of the points of each wedge among the contact states.
    points: Vec<(String, Vec<usize>)>,
    counts: CarCounts,
    /// The start of the statistics, s.
    settle: f64,
    /// Damage of wheels and rails; none with linear wheels.
    damage: Option<Damage>,
    /// What wears the wedges.
    wedges: WedgesWork,
    /// The time of the row before.
    before: f64,
    /// Poses of its bodies and forces of their faces, if asked for.
    motions: Option<MotionTable>,
}

/// The counts along a car's run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CarCounts {
    /// Rows after settling.
    rows: u64,
    /// Those in which no point of a wedge's faces slips, by wedge.
    locked: Vec<u64>,
    /// The rows themselves, as far as the summary needs them.
    table: SavedRows,
    /// Damage of wheels and rails.
    #[serde(default)]
    damage: SavedDamage,
    /// What wears the wedges.
    #[serde(default)]
    wedges: SavedWork,
}

impl RunCase for CarCase {
    type Recorder = CarRecorder;
    type Output = CarResult;

    const WHERE_TO_LOOK: &'static str =
        "look for values that are out of proportion; `wedgelab case` has cars that run";
    const WHAT_TO_TRY: &'static str = progress::WHAT_TO_TRY;

    fn settings(&self) -> RunSettings<'_> {
        RunSettings::of(&self.name, &self.simulation).with_steps_of(self.parameters.longest_step())
    }

    fn begin(&self) -> Result<Beginning<CarRecorder>, RunError> {
        let table = CarTable::new(&self.parameters)?;
        let (car, columns) = (table.car(), table.columns());
        let points = points_of_wedges(&car.system);
        let x = &car.initial_state;
        Ok(Beginning {
            system: car.system.clone(),
            x: car.initial_state.clone(),
            start_warning: car.start_warning.clone(),
            recorder: CarRecorder {
                rows: RowTable::new(columns, |name| couplers::need(name) || table.parts().need(name)),
                ahead: None,
                rates: vec![0.0; x.len()],
                motions: None,
                damage: damage_of(self),
                wedges: WedgesWork::new(&car.system, &wedges_of(&self.parameters)),
                before: 0.0,
                counts: CarCounts {
                    locked: vec![0; points.len()],
                    ..CarCounts::default()
                },
                points,
                settle: self.parameters.start.settle,
                derailed: None,
                units: self.simulation.output_units,
                table,
            },
        })
    }

    fn look_ahead(&self) -> f64 {
        look_ahead(&self.rules, self.simulation.output_interval)
    }

    fn output(run: Run<Self>, stopped: Option<Stopped>) -> CarResult {
        output(run, stopped)
    }
}

impl ModelCase for CarCase {
    type Summary = CarSummary;

    const ENERGY: Option<fn(&CarSummary) -> &EnergySummary> = Some(|own| &own.energy);

    fn columns(&self) -> Result<Vec<Column>, RunError> {
        columns(self)
    }

    fn output_files(&self) -> OutputFiles {
        self.output_files.clone()
    }

    fn text(&self) -> Option<&CaseText> {
        Some(&self.text)
    }
}

impl Run<CarCase> {
    /// Returns a run at its start that takes the motions of all bodies along.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn with_motions(case: &CarCase) -> Result<Self, RunError> {
        let mut run = Self::new(case)?;
        let mut table = MotionTable::new(&case.parameters);
        let seen = run.system.observe(run.integrator.time(), run.integrator.x());
        table.take(run.recorder.table.car(), &seen);
        run.recorder.motions = Some(table);
        Ok(run)
    }

    /// As [`Run::finish_while`], with the motions if the run takes them along.
    #[must_use]
    pub fn finish_with_motions(
        mut self,
        progress: impl FnMut(f64) -> ControlFlow<String>,
    ) -> (CarResult, Option<MotionTable>) {
        let stopped = self.go_on_while(progress);
        let motions = self.recorder.motions.take();
        (self.result(stopped), motions)
    }

    /// Returns the columns of the rows, without those that are filtered when the run has ended.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        self.recorder.table.columns()
    }
}

impl Recorder for CarRecorder {
    type Counts = CarCounts;

    fn counts(&self) -> CarCounts {
        CarCounts {
            table: self.rows.saved(),
            damage: self.damage.as_ref().map(Damage::saved).unwrap_or_default(),
            wedges: self.wedges.saved(),
            ..self.counts.clone()
        }
    }

    fn restore(&mut self, mut counts: CarCounts, _: f64, times: &[f64]) -> Result<(), RunError> {
        let settled = times.iter().filter(|time| **time >= self.settle).count() as u64;
        if counts.rows != settled {
            return damaged("counts.rows", counts.rows, settled);
        }
        check_length("counts.locked", counts.locked.len(), self.points.len())?;
        if let Some(own) = counts.locked.iter().find(|own| **own > settled) {
            return damaged("counts.locked", own, format!("at most {settled}"));
        }
        self.rows.restore(std::mem::take(&mut counts.table), times)?;
        let saved = std::mem::take(&mut counts.damage);
        if let Some(damage) = &mut self.damage
            && !damage.restore(&saved)
        {
            return damaged("counts.damage", "sums over other profiles", "those of the case's");
        }
        if !self.wedges.restore(std::mem::take(&mut counts.wedges)) {
            return damaged("counts.wedges", "sums of other wedges", "those of the case's");
        }
        self.before = times.last().copied().unwrap_or_default();
        self.counts = counts;
        Ok(())
    }

    fn see_ahead(&mut self, ahead: Self) {
        self.ahead = Some(ahead.rows);
    }

    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError> {
        let observation = system.observe(row.time, row.x);
        for (face, mounted) in observation.faces.iter().zip(system.faces()) {
            let force: f64 = face.points.iter().map(|point| point.normal).sum();
            if force > MOST_FORCE {
                return Err(RunError::TornApart {
                    element: mounted.element.name.clone(),
                    force: force / POUND_FORCE,
                    limit: MOST_FORCE / POUND_FORCE,
                    time: row.time,
                });
            }
        }
        system.derivative(row.time, row.x, &mut self.rates);
        let values = self.rows.begin_row();
        let loads = self
            .table
            .read(&observation, &self.rates, row.start_energy, values);
        self.rows.append(row.time)?;
        if let Some(motions) = &mut self.motions {
            motions.take(self.table.car(), &observation);
        }
        if row.time >= self.settle {
            let time = row.time - self.before.max(self.settle);
            self.wear(&observation, &loads, time);
            let [_, _, _, quadratures] = system.layout().split(row.x);
            self.wedges
                .take(&observation, quadratures, [time, loads.speed * time]);
            self.counts.rows += 1;
            for ((_, points), locked) in self.points.iter().zip(&mut self.counts.locked) {
                let slips = |place: &usize| row.contact_states[*place] == ContactState::Slip as u8;
                *locked += u64::from(!points.iter().any(slips));
            }
        }
        self.before = row.time;
        if let Some(own) = self.table.left(&loads) {
            let distance = SummaryValue::new(own.distance, Kind::Distance, self.units);
            let what = own.words(&format!("{:.1} {}", distance.value, distance.unit));
            self.derailed = Some(Derailed {
                time: row.time,
                distance,
                axle: own.axle + 1,
                side: SIDES[own.side].to_owned(),
                what: what.clone(),
            });
            return Err(RunError::Derailed { what });
        }
        Ok(system.ledger_entries(&observation, row.start_energy))
    }

    fn has_derailed(&self) -> bool {
        self.derailed.is_some()
    }
}

impl CarRecorder {
    /// Takes the damage along that a row stands for, which is so long (s).
    fn wear(&mut self, observation: &Observation, loads: &Loads, time: f64) {
        let Some(damage) = &mut self.damage else { return };
        damage.go(loads.speed * time);
        self.table.car().patches(observation, |wheelset, side, patch| {
            damage.take((wheelset, side), &patch, (time, loads.speed * time));
        });
    }
}

/// Returns the wedges of both trucks, with what precedes their names.
fn wedges_of(parameters: &Parameters) -> [(&'static str, &[Wedge; 4]); 2] {
    let [front, rear] = &parameters.trucks;
    [("truck_1_", &front.wedges), ("truck_2_", &rear.wedges)]
}

/// Returns damage of a case's wheels and rails, none so far; nothing with linear wheels.
fn damage_of(case: &CarCase) -> Option<Damage> {
    let Wheels::OnRails(own) = &case.parameters.wheels else {
        return None;
    };
    let wheels = own.geometry.iter().enumerate().map(|(w, geometry)| {
        let name = |side: usize| format!("axle_{}_{}", w + 1, SIDES[side]);
        [0, 1].map(|side| {
            let pair = &geometry.pairs()[side];
            (name(side), pair.nominal_radius(), pair.wheel_range())
        })
    });
    let rails = [0, 1].map(|side| own.geometry[0].pairs()[side].rail_range(0.0));
    Some(Damage::new(case.damage.clone(), wheels.collect(), rails))
}

fn output(mut run: Run<CarCase>, stopped: Option<Stopped>) -> CarResult {
    let units = run.case.simulation.output_units;
    let table = std::mem::take(&mut run.recorder.rows);
    let mut ended = run.ended(stopped, &table, energy::WHAT_TO_DO);
    let ledger = run.last_ledger(&mut ended);
    let mut warnings = ended.warnings;
    warnings.extend(findings::warnings_of_rolling(&run));
    warnings.extend(run.case.doubts.iter().cloned());
    let risen = wedges_at_start(&run);
    warnings.extend(wedge_rise::warnings(&risen, units));
    let wedge_rise = wedge_rise::summary(&risen, units);
    let named = super::assumptions::named(&run.case.parameters);
    warnings.extend(wedge_faces::warnings(&named));
    let method = run.case.simulation.method;
    if let Wheels::OnRails(_) = run.case.parameters.wheels {
        warnings.extend(peaks::warning(
            &table,
            run.recorder.table.parts(),
            (method, units),
        ));
    }
    warnings.extend(couplers::swung(&run.case.parameters, &table));
    let mut statistics = statistics_of(&run, &table);
    peaks::remark(&mut statistics.values, method);
    warnings.extend(statistics.remarks.iter().cloned());
    let column = |name: &str| table.column(name);
    let time = column("time");
    let mut extremes = table.summary_extremes(units);
    let mut filtered_columns = Vec::new();
    let of = (run.recorder.table.parts(), &run.case.rules);
    for (column, values) in filtered(&statistics, of, table.columns(), time.len()) {
        extremes.extend(Extremes::of(time, &values).map(|own| own.named(&column, units)));
        filtered_columns.push((column, values));
    }
    let ends = |name: &str, kind: Kind| {
        let values = column(name);
        [values.first(), values.last()]
            .map(|value| SummaryValue::new(value.copied().unwrap_or_default(), kind, units))
    };
    let (distance, speed) = (ends("distance", Kind::Distance), ends("speed", Kind::TravelSpeed));
    let mut static_loads = BTreeMap::new();
    for (axle, loads) in (1..).zip(run.recorder.table.static_loads()) {
        for (side, load) in SIDES.into_iter().zip(loads) {
            static_loads.insert(
                format!("axle_{axle}_{side}"),
                SummaryValue::new(load, Kind::Force, units),
            );
        }
    }
    let wedge_losses = losses(&mut run);
    let weight = run.case.parameters.weight();
    let damage = run.recorder.damage.as_ref();
    let damage = damage.and_then(|own| own.summary(Weighed { weight, units }));
    let over = Over::Distance(SERVICE);
    let law = &run.case.damage.wedges;
    let wedge_wear = run.recorder.wedges.summary(law, (&over, units));
    let counts = &run.recorder.counts;
    let shares = counts.locked.iter().map(|own| *own as f64 / counts.rows as f64);
    let wedges = run.recorder.points.iter().map(|(wedge, _)| wedge.clone());
    let wedge_locked = wedges.zip(shares).filter(|_| counts.rows > 0).collect();
    let reached = column("distance").last().copied();
    let energy = whole_run(&mut run, reached);
    let statics = static_table(&run.recorder.table, &run.case.parameters, units).unwrap_or_else(|error| {
        warnings.push(format!("there is no static table of the start: {error}"));
        StaticTable::default()
    });
    let summary = CarSummary {
        schema: SCHEMA.to_owned(),
        program: ended.program,
        name: run.case.name.clone(),
        title: run.case.title.clone(),
        units,
        complete: ended.complete,
        stopped: ended.stopped,
        derailed: run.recorder.derailed.take(),
        failed: ended.failed,
        warnings,
        rows: ended.rows,
        distance,
        speed,
        static_loads,
        limits_of: limits_of(&run.case),
        limits: checked(&run.case, &statistics.values, units),
        statistics: statistics.values,
        wedge_losses,
        wedge_locked,
        wedge_rise,
        start: locked_in::name(run.case.parameters.start.kind).to_owned(),
        locked_in: locked_in::summary(&run.recorder.table, units),
        statics,
        damage,
        wedge_wear,
        energy,
        extremes,
        ledger,
        method: run.case.simulation.method.to_string(),
        relative_tolerance: run.case.simulation.relative_tolerance,
        solver: ended.statistics,
        assumptions: super::assumptions::of(&run.case),
    };
    let before = table.before();
    let mut result = table.into_result(summary);
    for (column, mut values) in filtered_columns {
        result.columns.push(column);
        result.values.push(values.split_off(before));
    }
    result
}

/// Returns the wedges of both trucks at the start.
fn wedges_at_start(run: &Run<CarCase>) -> [AtStart<'_>; 2] {
    let loads = run.recorder.table.wedges_at_start();
    let wedges = wedges_of(&run.case.parameters);
    [0, 1].map(|truck| (wedges[truck].0, wedges[truck].1, &loads[truck]))
}

/// Returns whether a distance along a track (m) is in a full curve: its curvature does not change there.
pub(crate) fn in_curve(line: &CenterLine, distance: f64) -> bool {
    let [curvature, rate] = line.at(distance).curvature;
    curvature.abs() > 1e-6 && rate.abs() < 1e-9
}

fn statistics_of(run: &Run<CarCase>, table: &RowTable) -> Statistics {
    let line = &run.case.parameters.track.center_line;
    let in_curve = |distance: f64| in_curve(line, distance);
    let long = run.recorder.ahead.as_ref().unwrap_or(table);
    let histories = Histories {
        column: &|name| long.column(name),
        rows: table.column("time").len(),
        interval: run.case.simulation.output_interval,
        begin: run.case.parameters.start.settle,
        parts: run.recorder.table.parts(),
        climb: run.recorder.table.climb(),
        in_curve: &in_curve,
    };
    Statistics::of(&histories, &run.case.rules, run.case.simulation.output_units)
}

/// Returns the columns of a car's run, filtered ones included.
fn columns(case: &CarCase) -> Result<Vec<Column>, RunError> {
    let table = CarTable::new(&case.parameters)?;
    Ok(with_filtered(table.columns(), table.parts(), &case.rules))
}

/// Returns the losses of the run until it reached a distance along the track (m).
fn whole_run(run: &mut Run<CarCase>, reached: Option<f64>) -> EnergySummary {
    let units = run.case.simulation.output_units;
    let car = run.recorder.table.car();
    let start = car.initial_state.clone();
    // Where it started, which a run that goes on from a saved state has no row of.
    let seen = car.system.clone().observe(0.0, &start);
    let from = car.loads(&seen, &vec![0.0; start.len()]).distance;
    let ends = [
        (0.0, start.as_slice()),
        (run.integrator.time(), run.integrator.x()),
    ];
    EnergySummary::of_whole_run(&mut run.system, ends, reached.unwrap_or(from) - from, units)
}

/// Returns the loss in friction of each wedge by the end.
fn losses(run: &mut Run<CarCase>) -> BTreeMap<String, SummaryValue> {
    let units = run.case.simulation.output_units;
    let seen = run.system.observe(run.integrator.time(), run.integrator.x());
    let mut losses = BTreeMap::new();
    for truck in 1..=2 {
        for wedge in WEDGE_NAMES {
            let places = losses_of_wedge(&run.system, truck, wedge);
            let loss = places.iter().map(|place| seen.quadratures[*place]).sum();
            let loss = SummaryValue::new(loss, Kind::Energy, units);
            losses.insert(format!("truck_{truck}_{wedge}"), loss);
        }
    }
    losses
}

/// Returns the rule of a case's limits, with its source.
fn limits_of(case: &CarCase) -> String {
    limit_set(case).map_or_else(String::new, LimitSet::title_with_source)
}

/// Returns the limits of a case beside the statistics of its run.
fn checked(case: &CarCase, statistics: &BTreeMap<String, Statistic>, units: Units) -> Vec<LimitCheck> {
    let figures = CarFigures::of(&case.parameters);
    limit_set(case).map_or_else(Vec::new, |set| {
        limits::of(set, (&figures, statistics), (&case.rules, units))
    })
}

fn limit_set(case: &CarCase) -> Option<&LimitSet> {
    case.limits.as_deref().or(LimitSet::built_in().first())
}
