//! The right-hand side of one system at several times and states at once, each in a lane as if it were a run of its own ([`Abreast`]).
//!
//! A step by collocation knows the places of all its points before it evaluates at any of them.

use integrate::Problem;
use integrate::lanes::Runs;

use super::{Abreast, System};

/// Room for a system's own stages side by side.
#[derive(Clone, Debug, Default)]
pub(super) enum Stages {
    /// Not asked for yet, or parameters have changed since.
    #[default]
    Unknown,
    /// This system cannot sit beside itself.
    Alone,
    /// It can.
    Abreast(Box<Abreast>),
}

impl System {
    /// Writes the rates at several times and states, see [`Problem::derivatives`].
    pub(super) fn forces_at(&mut self, times: &[f64], stride: usize, x: &[f64], dx: &mut [f64]) {
        let n = self.dimension();
        let mut stages = std::mem::take(&mut self.stages);
        if matches!(stages, Stages::Unknown) {
            stages = Abreast::of(self).map_or(Stages::Alone, |room| Stages::Abreast(Box::new(room)));
        }
        let lanes = times.chunks(Runs::COUNT);
        let places = x
            .chunks(Runs::COUNT * stride)
            .zip(dx.chunks_mut(Runs::COUNT * stride));
        for (times, (x, dx)) in lanes.zip(places) {
            let x = x.chunks(stride).map(|x| &x[..n]);
            let dx = dx.chunks_mut(stride).map(|dx| &mut dx[..n]);
            match &mut stages {
                // One alone is quicker by itself.
                Stages::Abreast(room) if times.len() > 1 => {
                    for (place, (time, x)) in times.iter().zip(x).enumerate() {
                        room.take(place, self, *time, x);
                    }
                    room.forces();
                    for (place, dx) in dx.enumerate() {
                        room.give(place, dx);
                    }
                }
                _ => {
                    for (time, (x, dx)) in times.iter().zip(x.zip(dx)) {
                        self.derivative(*time, x, dx);
                    }
                }
            }
        }
        self.stages = stages;
    }

    /// Parameters have changed: the room for stages is furnished anew when it is asked for next.
    pub(super) fn forget_stages(&mut self) {
        self.stages = Stages::Unknown;
    }
}
