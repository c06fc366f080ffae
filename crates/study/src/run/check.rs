//! Whether a saved state can be one of a case's run: all that could lead a run astray is looked at before it goes on.

use integrate::MAXIMUM_COUNT;
use mechanics::system::ContactState;
use wedge::outputs::{CORNERS, FACES};

use super::{Counts, EVENT_CAP, RunError, RunState, probe_times};
use crate::case::Case;
use crate::result::ContactEvent;
use crate::rows::Rows;

fn damaged<T>(member: &'static str, found: impl ToString, expected: impl ToString) -> Result<T, RunError> {
    Err(RunError::Damaged {
        member,
        found: found.to_string(),
        expected: expected.to_string(),
    })
}

fn check_length(member: &'static str, found: usize, expected: usize) -> Result<(), RunError> {
    if found == expected {
        return Ok(());
    }
    damaged(
        member,
        format!("a list of {found}"),
        format!("a list of {expected}"),
    )
}

fn check_size(member: &'static str, value: f64) -> Result<(), RunError> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    damaged(member, value, "zero or positive, and finite")
}

fn check_finite(member: &'static str, value: f64) -> Result<(), RunError> {
    if value.is_finite() {
        return Ok(());
    }
    damaged(member, value, "finite")
}

/// Returns that what was seen for the plausibility of a run cannot be.
pub(super) fn implausible() -> RunError {
    RunError::Damaged {
        member: "plausibility",
        found: "something that no run of this case can have seen".to_owned(),
        expected: "finite values, zero or positive, as many as the case has places".to_owned(),
    }
}

impl RunState {
    /// Whether it can be one of this case's run, whose wedge has so many contact points. What the integrator has is looked at by
    /// the integrator.
    pub(super) fn check(&self, case: &Case, points: usize) -> Result<(), RunError> {
        let (time, end) = (self.integrator.time, case.simulation.duration);
        if !(0.0..=end).contains(&time) {
            return damaged(
                "integrator.time",
                time,
                format!("between 0 and the duration, {end} s"),
            );
        }
        if self.integrator.interval_start < 0.0 {
            return damaged(
                "integrator.segment_start",
                self.integrator.interval_start,
                "zero or positive",
            );
        }
        if let Some(contact_state) = self
            .integrator
            .discrete_states
            .iter()
            .find(|contact_state| **contact_state > ContactState::Slip as u8)
        {
            return damaged(
                "integrator.modes",
                contact_state,
                "0 (open), 1 (stick) or 2 (slip) at every corner",
            );
        }
        let rows = Rows::of(&case.simulation);
        let next = self.next_row;
        let written = (1..=rows.count).contains(&next) && rows.time(next - 1) <= time;
        if !written || (next < rows.count && rows.time(next) <= time) {
            let expected = format!(
                "the number of the first row after the time {time} s, at most {}",
                rows.count
            );
            return damaged("next_row", next, expected);
        }
        if self.counts.pace.time > time {
            return damaged(
                "counts.pace.time",
                self.counts.pace.time,
                format!("at most the time, {time} s"),
            );
        }
        let probes = probe_times(case).iter().filter(|probe| **probe <= time).count();
        self.counts.check(points, probes)
    }
}

impl Counts {
    fn check(&self, points: usize, probes: usize) -> Result<(), RunError> {
        check_length("counts.crept", self.crept.len(), points)?;
        check_length("counts.creep_speeds", self.creep_speeds.len(), points)?;
        check_length("counts.events", self.events.len(), FACES.len())?;
        check_length("counts.probes", self.probes.len(), probes)?;
        check_finite("counts.start_energy", self.start_energy)?;
        let balance = &self.energy_balance;
        for (member, value) in [
            ("counts.energy_balance.stored_at_start", balance.stored_at_start),
            (
                "counts.energy_balance.largest_stored_change",
                balance.largest_stored_change,
            ),
            ("counts.energy_balance.largest_residual", balance.largest_residual),
            (
                "counts.energy_balance.largest_residual_time",
                balance.largest_residual_time,
            ),
            ("counts.pace.time", self.pace.time),
        ] {
            check_size(member, value)?;
        }
        check_finite("counts.energy_balance.work", balance.work)?;
        check_finite("counts.energy_balance.losses", balance.losses)?;
        self.crept
            .iter()
            .try_for_each(|value| check_size("counts.crept", *value))?;
        self.creep_speeds
            .iter()
            .try_for_each(|value| check_size("counts.creep_speeds", *value))?;
        self.probes
            .iter()
            .flatten()
            .try_for_each(|value| check_finite("counts.probes", *value))?;
        let counters = self.events.iter().flatten();
        let counters = counters.chain([&self.event_total, &self.pace.attempts]);
        if let Some(count) = counters.copied().find(|count| *count > MAXIMUM_COUNT) {
            return damaged(
                "counts.events, counts.event_total or counts.pace.attempts",
                count,
                format!("at most {MAXIMUM_COUNT}"),
            );
        }
        if self.listed.len() > EVENT_CAP {
            let found = format!("a list of {}", self.listed.len());
            return damaged("counts.listed", found, format!("a list of at most {EVENT_CAP}"));
        }
        self.listed.iter().try_for_each(check_event)
    }
}

fn check_event(event: &ContactEvent) -> Result<(), RunError> {
    check_finite("counts.listed.time", event.time)?;
    let contact_states =
        [ContactState::Open, ContactState::Stick, ContactState::Slip].map(ContactState::name);
    let (face, corner, from, to) = (&*event.face, &*event.corner, &*event.from, &*event.to);
    for (member, found, known) in [
        ("counts.listed.face", face, &FACES[..]),
        ("counts.listed.corner", corner, &CORNERS[..]),
        ("counts.listed.from", from, &contact_states[..]),
        ("counts.listed.to", to, &contact_states[..]),
    ] {
        if !known.contains(&found) {
            return damaged(
                member,
                format!("\"{}\"", input::shortened(found)),
                format!("one of {}", known.join(", ")),
            );
        }
    }
    Ok(())
}
