//! Times for which contacts are open, stuck and slipping, from the contact events.

use integrate::Event;
use mechanics::system::ContactState;

/// Counts times of contact along a run.
#[derive(Clone, Debug)]
pub(super) struct ContactTimeCounter {
    contact_states: Vec<u8>,
    /// Number of points of the column, which come first.
    of_column: usize,
    time: f64,
    /// Shares count from here to there, s.
    window: (f64, f64),
    /// Time without a touching point, by face, over the whole run, s.
    pub lift_off: [f64; 2],
    /// Time of touching points, added up, in the window, by face, s.
    pub touching: [f64; 2],
    /// The part of it in which they stick, s.
    pub sticking: [f64; 2],
}

impl ContactTimeCounter {
    /// Returns a counter at time zero for a column with so many points.
    pub fn new(window: (f64, f64), of_column: usize) -> Self {
        Self {
            contact_states: Vec::new(),
            of_column,
            time: 0.0,
            window,
            lift_off: [0.0; 2],
            touching: [0.0; 2],
            sticking: [0.0; 2],
        }
    }

    /// Takes the contact states at time zero.
    pub fn start(&mut self, contact_states: &[u8]) {
        self.contact_states = contact_states.to_vec();
    }

    /// A step to `end` with its events, in order of time.
    pub fn step(&mut self, events: &[Event], end: f64) {
        for event in events {
            self.count(event.time);
            if let Some(contact_state) = self.contact_states.get_mut(event.index) {
                *contact_state = event.to;
            }
        }
        self.count(end);
    }

    fn count(&mut self, to: f64) {
        let from = self.time;
        if to <= from {
            return;
        }
        self.time = to;
        let counted = (to.min(self.window.1) - from.max(self.window.0)).max(0.0);
        let (column, slope) = self
            .contact_states
            .split_at(self.of_column.min(self.contact_states.len()));
        for (face, points) in [column, slope].into_iter().enumerate() {
            let (mut touching, mut sticking) = (0_u32, 0_u32);
            for contact_state in points {
                touching += u32::from(*contact_state != ContactState::Open as u8);
                sticking += u32::from(*contact_state == ContactState::Stick as u8);
            }
            if touching == 0 {
                self.lift_off[face] += to - from;
            }
            self.touching[face] += f64::from(touching) * counted;
            self.sticking[face] += f64::from(sticking) * counted;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_times_of_a_written_down_course() {
        let event = |time, index, to| Event {
            time,
            index,
            from: 0,
            to,
        };
        // All open; corner 0 of the column touches and sticks from 1 s, slips from 3 s, leaves at 4 s.
        let mut contact_times = ContactTimeCounter::new((2.0, 10.0), 4);
        contact_times.start(&[0; 8]);
        contact_times.step(&[event(1.0, 0, 1)], 2.5);
        contact_times.step(&[event(3.0, 0, 2), event(4.0, 0, 0)], 10.0);
        assert_eq!(contact_times.lift_off, [1.0 + 6.0, 10.0]);
        assert_eq!(contact_times.touching, [2.0, 0.0]);
        assert_eq!(contact_times.sticking, [1.0, 0.0]);
    }
}
