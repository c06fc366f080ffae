//! Saved states of runs, and whether one can be that of a case's run: all that could lead a run astray is
//! looked at before it goes on.

use integrate::State;
use mechanics::energy_balance::EnergyBalance;
use mechanics::plausibility::PlausibilityRecord;
use mechanics::system::ContactState;
use serde::{Deserialize, Serialize};

use super::{RunCase, RunError};
use crate::progress::Pace;
use crate::rows::Rows;
use crate::run_error::{RUN_STATE_VERSION, check_count, check_finite, check_size, damaged};

/// Everything needed to continue a run with the same bits; `N` is what the case's recorder has counted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunState<N> {
    /// [`RUN_STATE_VERSION`].
    pub version: u32,
    /// States, quadratures, contact states and controller memory.
    pub integrator: State,
    /// The next row to be written.
    pub next_row: u64,
    /// Stored energy at the start, J.
    pub start_energy: f64,
    /// The energy balance at the output times.
    pub energy_balance: EnergyBalance,
    /// The plausibility record of the run.
    pub plausibility: PlausibilityRecord,
    /// The time reached, and the number of steps.
    pub pace: Pace,
    /// The recorder's counts so far.
    pub counts: N,
}

impl<N> RunState<N> {
    /// Checks all but what the recorder has counted and what the integrator has, which they check themselves.
    pub(super) fn check<C: RunCase>(&self, case: &C) -> Result<(), RunError> {
        if self.version != RUN_STATE_VERSION {
            return Err(RunError::Version { found: self.version });
        }
        let [end, interval] = case.duration_and_interval();
        let time = self.integrator.time;
        if !(0.0..=end).contains(&time) {
            return damaged(
                "integrator.time",
                time,
                format!("between 0 and the duration, {end} s"),
            );
        }
        if self.integrator.interval_start < 0.0 {
            return damaged(
                "integrator.interval_start",
                self.integrator.interval_start,
                "zero or positive",
            );
        }
        let states = &self.integrator.discrete_states;
        if let Some(state) = states.iter().find(|state| **state > ContactState::Slip as u8) {
            return damaged(
                "integrator.discrete_states",
                state,
                "0 (open), 1 (stick) or 2 (slip) at every contact",
            );
        }
        let rows = Rows::new(end, interval);
        let next = self.next_row;
        let written = (1..=rows.count).contains(&next) && rows.time(next - 1) <= time;
        if !written || (next < rows.count && rows.time(next) <= time) {
            let expected = format!(
                "the number of the first row after the time {time} s, at most {}",
                rows.count
            );
            return damaged("next_row", next, expected);
        }
        check_finite("start_energy", self.start_energy)?;
        self.check_balance()?;
        check_size("pace.time", self.pace.time)?;
        if self.pace.time > time {
            return damaged("pace.time", self.pace.time, format!("at most the time, {time} s"));
        }
        check_count("pace.attempts", self.pace.attempts)
    }

    fn check_balance(&self) -> Result<(), RunError> {
        let balance = &self.energy_balance;
        check_size("energy_balance.stored_at_start", balance.stored_at_start)?;
        check_size(
            "energy_balance.largest_stored_change",
            balance.largest_stored_change,
        )?;
        check_size("energy_balance.largest_residual", balance.largest_residual)?;
        check_size(
            "energy_balance.largest_residual_time",
            balance.largest_residual_time,
        )?;
        check_size("energy_balance.admissible", balance.admissible)?;
        for since in &balance.since {
            check_size("energy_balance.since.time", since.time)?;
            check_size(
                "energy_balance.since.largest_stored_change",
                since.largest_stored_change,
            )?;
            check_size("energy_balance.since.largest_growth", since.largest_growth)?;
            for entry in since.entries {
                check_finite("energy_balance.since.entries", entry)?;
            }
        }
        check_finite("energy_balance.work", balance.work)?;
        check_finite("energy_balance.losses", balance.losses)
    }
}
