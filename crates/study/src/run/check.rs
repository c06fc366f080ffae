//! Check that saved counts can be those of a wedge's run.

use mechanics::system::ContactState;
use wedge::outputs::{FACES, PointNames};

use super::{Counts, EVENT_CAP};
use crate::run_error::{RunError, check_count, check_finite, check_length, check_size, damaged};
use crate::summary::ContactEvent;

impl Counts {
    /// Checks them for a wedge with these contact points, and so many probes passed.
    pub(super) fn check(&self, names: &PointNames, probes: usize) -> Result<(), RunError> {
        let points = names.range(1).end;
        check_length("counts.crept", self.crept.len(), points)?;
        check_length("counts.creep_speeds", self.creep_speeds.len(), points)?;
        check_length("counts.events", self.events.len(), FACES.len())?;
        check_length("counts.probes", self.probes.len(), probes)?;
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
        let mut counters = self.events.iter().flatten();
        counters.try_for_each(|count| check_count("counts.events", *count))?;
        check_count("counts.event_total", self.event_total)?;
        if self.listed.len() > EVENT_CAP {
            let found = format!("a list of {}", self.listed.len());
            return damaged("counts.listed", found, format!("a list of at most {EVENT_CAP}"));
        }
        self.listed.iter().try_for_each(|event| check_event(event, names))
    }
}

fn check_event(event: &ContactEvent, names: &PointNames) -> Result<(), RunError> {
    check_finite("counts.listed.time", event.time)?;
    let contact_states =
        [ContactState::Open, ContactState::Stick, ContactState::Slip].map(ContactState::name);
    let (face, corner, from, to) = (&*event.face, &*event.corner, &*event.from, &*event.to);
    let points: Vec<&str> = (0..FACES.len())
        .flat_map(|face| names.of(face))
        .map(String::as_str)
        .collect();
    for (member, found, known) in [
        ("counts.listed.face", face, &FACES[..]),
        ("counts.listed.corner", corner, &points[..]),
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
