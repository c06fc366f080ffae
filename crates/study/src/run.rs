//! Runs of any model: a case being integrated, row by row, with a state that can be saved and continued.
//!
//! A [`RunCase`] is run: a wedge's [`Case`](crate::case::Case), a half-truck's
//! [`HalfTruckCase`](crate::half_truck::HalfTruckCase). [`Run`] has the one loop: a step of the integrator,
//! the output times that it reached, the energy balance, the rule for runs that hardly progress. The case's
//! [`Recorder`] takes from it what the results need: a table with counts, or measures alone.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use integrate::{Integrator, Options};
use mechanics::energy_balance::{EnergyBalance, Entries, LOOSEST};
use mechanics::plausibility::{Plausibility, PlausibilityFinding};
use mechanics::system::System;
use quantity::{Kind, System as Units};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::case::Simulation;
use crate::contacts;
use crate::plausibility;
use crate::progress::{self, INTERVALS, Pace};
use crate::rows::Rows;
pub use crate::run_error::{NotFinite, RUN_STATE_VERSION, RunError};
use crate::summary::{LedgerSummary, Stopped, SummaryValue};

mod check;
mod ended;
pub(crate) mod findings;
mod pressed;
mod row_table;
pub mod saved;
mod state;
mod summarize;
pub(crate) mod wedge_run;

pub(crate) use row_table::RowTable;
pub use row_table::SavedRows;
pub use state::RunState;
pub use wedge_run::{Counts, EVENT_CAP};

/// A case that can be run: a model with all that a run needs besides.
pub trait RunCase: Clone {
    /// The recorder of the run's results.
    type Recorder: Recorder;
    /// The results.
    type Output;

    /// Advice where a run cannot begin.
    const WHERE_TO_LOOK: &'static str;
    /// Advice where a run cannot go on.
    const WHAT_TO_TRY: &'static str;

    /// Returns the settings that every run has.
    fn settings(&self) -> RunSettings<'_>;
    /// Returns the name of the case.
    fn name(&self) -> &str {
        self.settings().name
    }
    /// Returns the end of the run and the time between two rows, s.
    fn duration_and_interval(&self) -> [f64; 2] {
        let RunSettings {
            duration, interval, ..
        } = self.settings();
        [duration, interval]
    }
    /// Returns the units of the results.
    fn units(&self) -> Units {
        self.settings().units
    }
    /// Returns the settings of the integrator.
    fn options(&self) -> Options {
        self.settings().options
    }
    /// Returns the equations, the state at time zero and the recorder.
    ///
    /// # Errors
    /// The case makes no system, or there is no such start.
    fn begin(&self) -> Result<Beginning<Self::Recorder>, RunError>;
    /// Returns how long after a row (s) the rows lie that its values depend on: those of filtered columns.
    fn look_ahead(&self) -> f64 {
        0.0
    }
    /// Returns the results of a run that has ended, or has stopped on its way.
    fn output(run: Run<Self>, stopped: Option<Stopped>) -> Self::Output;
}

/// The settings that every run has.
#[derive(Clone, Debug)]
pub struct RunSettings<'c> {
    /// Name of the case.
    pub name: &'c str,
    /// End of the run, s.
    pub duration: f64,
    /// Time between two rows, s.
    pub interval: f64,
    /// Units of the results.
    pub units: Units,
    /// Settings of the integrator.
    pub options: Options,
}

impl<'c> RunSettings<'c> {
    /// Returns those of a case with a name and the section `[simulation]`.
    pub(crate) fn of(name: &'c str, simulation: &Simulation) -> Self {
        Self {
            name,
            duration: simulation.duration,
            interval: simulation.output_interval,
            units: simulation.output_units,
            options: simulation.options(),
        }
    }

    /// Returns the same with steps no longer than this, s.
    pub(crate) fn with_steps_of(mut self, longest: f64) -> Self {
        self.options.maximum_step = self.options.maximum_step.min(longest);
        self
    }
}

/// The values with which a run begins.
#[derive(Debug)]
pub struct Beginning<R> {
    /// The equations of motion.
    pub system: System,
    /// The state at time zero.
    pub x: Vec<f64>,
    /// The recorder of the run's results.
    pub recorder: R,
    /// The warning of a start that is nearly at rest, where one at rest is asked for.
    pub start_warning: Option<String>,
}

/// Takes the results from a run.
pub trait Recorder {
    /// The counts along the run, saved with the run's state.
    type Counts: Clone + PartialEq + Serialize + DeserializeOwned;

    /// Returns the counts so far.
    fn counts(&self) -> Self::Counts;
    /// Goes on from what was counted until `time` (s), with rows at `times` (s).
    ///
    /// # Errors
    /// [`RunError::Damaged`]: no run of this case can have counted that.
    fn restore(&mut self, counts: Self::Counts, time: f64, times: &[f64]) -> Result<(), RunError>;
    /// Takes the recorder of the same run as it goes on: what it has seen as far as [`RunCase::look_ahead`].
    fn see_ahead(&mut self, _ahead: Self)
    where
        Self: Sized,
    {
    }
    /// Takes an accepted step. `system` has the integrator's smooth interval of time; `x` is scratch memory
    /// for a state.
    fn step(&mut self, _integrator: &Integrator<System>, _system: &mut System, _x: &mut [f64]) {}
    /// Takes an output time. Returns the entries of the energy ledger.
    ///
    /// # Errors
    /// A value is not finite, or the model has been torn apart; the row has not been taken.
    fn row(&mut self, system: &mut System, row: &Row<'_>) -> Result<Entries, RunError>;
    /// Returns the findings in words, with the places as the user knows them.
    fn describe(&self, system: &System, finding: &PlausibilityFinding, units: Units) -> String {
        plausibility::in_truck(system, finding, self.numbers(), units)
    }
    /// Returns these contact states in words, by contact.
    fn contacts(&self, system: &System, contact_states: &[u8]) -> BTreeMap<String, String> {
        contacts::in_words(system, contact_states)
    }
    /// Returns the numbers that the user's files give to bodies and connections, for messages; empty without
    /// such files.
    fn numbers(&self) -> [&[u32]; 2] {
        [&[], &[]]
    }
    /// Returns whether a wheel has left its rail: such a run has ended, though not at its end.
    fn has_derailed(&self) -> bool {
        false
    }
}

/// An output time of a run.
#[derive(Clone, Copy, Debug)]
pub struct Row<'r> {
    /// Time, s.
    pub time: f64,
    /// The state.
    pub x: &'r [f64],
    /// The contact states.
    pub contact_states: &'r [u8],
    /// Stored energy at the start, J.
    pub start_energy: f64,
}

/// A started run.
pub struct Run<C: RunCase> {
    pub(crate) case: C,
    pub(crate) system: System,
    pub(crate) recorder: C::Recorder,
    pub(crate) integrator: Integrator<System>,
    pub(crate) start_energy: f64,
    pub(crate) energy_balance: EnergyBalance,
    pub(crate) plausibility: Plausibility,
    /// See [`Beginning::start_warning`].
    pub(crate) start_warning: Option<String>,
    rows: Rows,
    next_row: u64,
    pace: Pace,
    /// Relative tolerance, as far as the ledger admits its errors.
    tolerance: f64,
    buffer: Vec<f64>,
    contact_states: Vec<u8>,
}

impl<C: RunCase> Run<C> {
    /// Returns a run at its start.
    ///
    /// # Errors
    /// The case makes no system, the integrator refuses the start, or a value at the start is not finite.
    pub fn new(case: &C) -> Result<Self, RunError> {
        let mut beginning = case.begin()?;
        let (system, x) = (&mut beginning.system, &beginning.x);
        let start_energy = system.energies(0.0, x).total();
        let plausibility = Plausibility::new(system, 0.0, x);
        let integrator = Integrator::new(system.clone(), case.options(), 0.0, x)?;
        let mut run = Self::assemble(case, beginning, integrator, plausibility, start_energy);
        run.emit_rows(true)?;
        Ok(run)
    }

    /// Returns a run that goes on from a saved state of the same case. Rows written before are not repeated;
    /// the summary is that of all rows.
    ///
    /// # Errors
    /// The state belongs to another version or another case, or is damaged.
    pub fn resume(case: &C, state: RunState<<C::Recorder as Recorder>::Counts>) -> Result<Self, RunError> {
        state.check(case)?;
        let mut beginning = case.begin()?;
        let time = state.integrator.time;
        let plausibility = Plausibility::resume(&mut beginning.system, 0.0, &beginning.x, state.plausibility);
        let plausibility = plausibility.ok_or_else(|| RunError::Damaged {
            member: "plausibility",
            found: "something that no run of this case can have seen".to_owned(),
            expected: "finite values, zero or positive, as many as the case has places".to_owned(),
        })?;
        let integrator = Integrator::resume(beginning.system.clone(), case.options(), state.integrator)?;
        let mut run = Self::assemble(case, beginning, integrator, plausibility, state.start_energy);
        run.next_row = state.next_row;
        let times: Vec<f64> = (0..run.next_row).map(|row| run.rows.time(row)).collect();
        run.recorder.restore(state.counts, time, &times)?;
        run.energy_balance = state.energy_balance;
        run.pace = state.pace;
        Ok(run)
    }

    fn assemble(
        case: &C,
        beginning: Beginning<C::Recorder>,
        integrator: Integrator<System>,
        plausibility: Plausibility,
        start_energy: f64,
    ) -> Self {
        let [duration, interval] = case.duration_and_interval();
        Self {
            case: case.clone(),
            system: beginning.system,
            recorder: beginning.recorder,
            rows: Rows::new(duration, interval),
            next_row: 0,
            start_energy,
            energy_balance: EnergyBalance::new(start_energy),
            plausibility,
            start_warning: beginning.start_warning,
            pace: Pace::of(&integrator),
            tolerance: case.options().relative_tolerance.min(LOOSEST),
            buffer: beginning.x,
            contact_states: integrator.discrete_states().to_vec(),
            integrator,
        }
    }

    /// Returns the case that is run.
    #[must_use]
    pub fn case(&self) -> &C {
        &self.case
    }

    /// Returns the time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.integrator.time()
    }

    /// Returns whether the end is reached.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.time() >= self.rows.end
    }

    /// Returns the state, to be continued by [`Run::resume`]. The results so far are those of a part if
    /// [`Run::look_ahead`] follows.
    #[must_use]
    pub fn state(&self) -> RunState<<C::Recorder as Recorder>::Counts> {
        RunState {
            version: RUN_STATE_VERSION,
            integrator: self.integrator.state(),
            next_row: self.next_row,
            start_energy: self.start_energy,
            energy_balance: self.energy_balance,
            plausibility: self.plausibility.record().clone(),
            pace: self.pace,
            counts: self.recorder.counts(),
        }
    }

    /// Looks ahead, where the values of rows depend on later ones: a copy of the run goes on until all values
    /// so far are known. The results of a run that was saved are then those of the same rows of a run that
    /// was not.
    ///
    /// # Errors
    /// The copy cannot begin.
    pub fn look_ahead(&mut self) -> Result<(), RunError> {
        let ahead = self.case.look_ahead();
        if ahead > 0.0 {
            let until = self.time() + ahead;
            let mut copy = Self::resume(&self.case, self.state())?;
            // Where it cannot go on, the run ends there, too.
            while !copy.is_finished() && copy.time() < until && copy.advance().is_ok() {}
            self.recorder.see_ahead(copy.recorder);
        }
        Ok(())
    }

    /// Makes one step of the integrator, with all rows and events that fall into it.
    ///
    /// # Errors
    /// The integrator cannot go on; what was computed is kept.
    pub fn advance(&mut self) -> Result<(), RunError> {
        let limit = self.rows.limit(self.next_row, &self.integrator);
        if let Err(error) = self.integrator.step_to(limit) {
            return Err(self.cannot_go_on(progress::describe(&error, |state| self.state_name(state))));
        }
        self.system.segment_like(self.integrator.problem());
        self.recorder
            .step(&self.integrator, &mut self.system, &mut self.buffer);
        self.emit_rows(false)?;
        let progresses = self.pace.check(&self.integrator, INTERVALS * self.rows.interval);
        progresses.map_err(|stalled| self.cannot_go_on(stalled.describe(|state| self.state_name(state))))
    }

    fn cannot_go_on(&self, reason: String) -> RunError {
        let words = self.contact_states().into_iter();
        let words: Vec<String> = words
            .map(|(contact, state)| format!("{contact} {state}"))
            .collect();
        let contacts = if words.is_empty() {
            "none".to_owned()
        } else {
            words.join(", ")
        };
        RunError::Step { reason, contacts }
    }

    fn state_name(&self, state: usize) -> String {
        progress::state_name(&self.system, self.recorder.numbers(), state)
    }

    /// Runs to the end. Returns the results; a run that cannot go on has incomplete results with the reason.
    #[must_use]
    pub fn finish(self, mut progress: impl FnMut(f64)) -> C::Output {
        self.finish_while(|time| {
            progress(time);
            ControlFlow::Continue(())
        })
    }

    /// As [`Run::finish`], but asks after each step, with the time reached, whether to go on. When not, it is
    /// told why, and the results are incomplete for that reason.
    #[must_use]
    pub fn finish_while(mut self, progress: impl FnMut(f64) -> ControlFlow<String>) -> C::Output {
        let stopped = self.go_on_while(progress);
        self.result(stopped)
    }

    /// Goes on to the end, as [`Run::finish_while`]. Returns the reason why the run stopped, if it did
    /// before.
    pub(crate) fn go_on_while(
        &mut self,
        mut progress: impl FnMut(f64) -> ControlFlow<String>,
    ) -> Option<Stopped> {
        let mut reason = None;
        while reason.is_none() && !self.is_finished() {
            reason = match self.advance() {
                Ok(()) => progress(self.time())
                    .break_value()
                    .filter(|_| !self.is_finished()),
                Err(error) => Some(error.to_string()),
            };
        }
        reason.map(|reason| self.stopped(reason))
    }

    /// Returns the results so far.
    #[must_use]
    pub fn result(self, stopped: Option<Stopped>) -> C::Output {
        C::output(self, stopped)
    }

    /// Returns the record of a run that stops at the present time.
    #[must_use]
    pub fn stopped(&self, reason: String) -> Stopped {
        Stopped {
            time: self.time(),
            reason,
            contacts: self.contact_states(),
        }
    }

    /// Returns the energy ledger at the time reached: losses and works by element, the stored energy, the
    /// residual.
    pub(crate) fn ledger(&mut self, units: Units) -> LedgerSummary {
        self.system.segment_like(self.integrator.problem());
        let seen = self.system.observe(self.integrator.time(), self.integrator.x());
        let measure = |value: f64| SummaryValue::new(value, Kind::Energy, units);
        let mut entries = BTreeMap::new();
        for (term, value) in self.system.energy_terms().iter().zip(&seen.quadratures) {
            entries.insert(term.name(), measure(*value));
        }
        entries.insert("stored".to_owned(), measure(seen.energies.total()));
        entries.insert("residual".to_owned(), measure(-seen.residual(self.start_energy)));
        LedgerSummary::new(entries, self.start_energy, &self.energy_balance, units)
    }

    /// Returns the contact states in words, by contact.
    #[must_use]
    pub fn contact_states(&self) -> BTreeMap<String, String> {
        self.recorder
            .contacts(&self.system, self.integrator.discrete_states())
    }

    /// Takes the rows whose time has been reached, with the contact states of that time, up to one that is
    /// not finite.
    fn emit_rows(&mut self, first: bool) -> Result<(), RunError> {
        let rows = self.rows;
        // Most steps reach no row.
        if rows.time(self.next_row) > self.integrator.time() {
            return Ok(());
        }
        self.contact_states.copy_from_slice(if first {
            self.integrator.discrete_states()
        } else {
            self.integrator.discrete_states_before_step()
        });
        let mut taken = 0;
        while self.next_row < rows.count {
            let time = rows.time(self.next_row);
            if time > self.integrator.time() {
                break;
            }
            let events = self.integrator.events().iter().skip(taken);
            for event in events.take_while(|event| event.time <= time && !first) {
                self.contact_states[event.index] = event.to;
                taken += 1;
            }
            if first {
                self.buffer.copy_from_slice(self.integrator.x());
            } else {
                self.integrator.interpolate(time, &mut self.buffer);
            }
            let row = Row {
                time,
                x: &self.buffer,
                contact_states: &self.contact_states,
                start_energy: self.start_energy,
            };
            let mut entries = self.recorder.row(&mut self.system, &row)?;
            entries.admissible = self.tolerance * self.system.energy_of_speed_errors(time, &self.buffer);
            self.energy_balance.note(time, &entries);
            if !first {
                self.plausibility.note(&mut self.system, time, &self.buffer);
            }
            self.next_row += 1;
        }
        Ok(())
    }
}
