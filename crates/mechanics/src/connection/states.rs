//! Modes of the friction elements: open, stick, slip; when they change.
//!
//! Modes are recorded, they do not change the forces. Thresholds with hysteresis keep rounding from counting as events:
//! - an element closes where what presses it (normal force of a surface, coil force of a wedge) grows to
//!   [`CLOSING_FORCE`], and opens where it falls to [`OPENING_FORCE`];
//! - it starts to slip where the load |T|/limit of its accumulator rises to [`SLIP_LOAD`], and sticks again where it falls
//!   to [`STICK_LOAD`], the values of bristles elsewhere in this program.

use super::accumulator::Friction;
use super::forces::{Places, SpatialLaw, deflection_at};
use super::{Connections, Grip, Spatial};
use crate::system::{Mode, SLIP_LOAD, STICK_LOAD};

/// An element closes at this normal (or coil) force, N.
pub const CLOSING_FORCE: f64 = 2e-3;
/// An element opens at this normal (or coil) force, N.
pub const OPENING_FORCE: f64 = 1e-3;
/// Bristles, in the tables of thresholds.
const BRISTLE: usize = 1;

/// What presses an element (N) and the load of its accumulator: the signs of its switch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signs {
    normal: f64,
    load: f64,
}

/// Signs of an element.
pub(crate) const SIGNS: usize = 2;

impl Signs {
    /// Those of one element among the signs of all.
    pub(crate) fn of(signs: &[f64], index: usize) -> Self {
        Self {
            normal: signs[SIGNS * index],
            load: signs[SIGNS * index + 1],
        }
    }

    /// Positive while the mode lasts.
    pub(crate) fn margin(self, mode: Mode) -> f64 {
        let stays_closed = (self.normal - OPENING_FORCE) / OPENING_FORCE;
        // An element without force says nothing about friction; `min` passes over NaN.
        let load = if self.normal > 0.0 { self.load } else { f64::NAN };
        match mode {
            Mode::Open => (CLOSING_FORCE - self.normal) / CLOSING_FORCE,
            Mode::Stick => (SLIP_LOAD[BRISTLE] - load).min(stays_closed),
            Mode::Slip => (load - STICK_LOAD[BRISTLE]).min(stays_closed),
        }
    }

    /// The mode that follows one that must be left.
    pub(crate) fn next(self, mode: Mode) -> Mode {
        match mode {
            Mode::Open => self.closed(),
            _ if self.normal <= OPENING_FORCE => Mode::Open,
            Mode::Stick if self.load >= SLIP_LOAD[BRISTLE] => Mode::Slip,
            Mode::Slip if self.load <= STICK_LOAD[BRISTLE] => Mode::Stick,
            same => same,
        }
    }

    fn closed(self) -> Mode {
        if self.load < SLIP_LOAD[BRISTLE] {
            Mode::Stick
        } else {
            Mode::Slip
        }
    }
}

impl Friction {
    /// The mode without a history.
    pub(crate) fn mode(&self) -> Mode {
        if self.normal > OPENING_FORCE {
            let (normal, load) = (self.normal, self.load);
            Signs { normal, load }.closed()
        } else {
            Mode::Open
        }
    }
}

/// Friction of one element.
fn friction<L: SpatialLaw>(
    element: &Spatial<L>,
    (positions, rates): Places<'_>,
    internal: &[f64],
) -> Friction {
    let site = &element.site;
    let (strokes, rates) = (site.strokes(positions), site.strokes(rates));
    let deflection = deflection_at(element.internal, internal);
    element.law.act(strokes, rates, deflection, Grip::Law).friction
}

impl Connections {
    /// Friction of every connection with friction.
    #[inline(always)]
    fn frictions(&self, places: Places<'_>, internal: &[f64], mut each: impl FnMut(usize, Friction)) {
        for surface in &self.surfaces {
            each(surface.switch, friction(surface, places, internal));
        }
        for wedge in &self.wedges {
            each(wedge.switch, friction(wedge, places, internal));
        }
    }

    /// Writes the contact states without a history.
    pub fn find_modes(&self, places: Places<'_>, internal: &[f64], modes: &mut [u8]) {
        self.frictions(places, internal, |i, friction| modes[i] = friction.mode() as u8);
    }

    /// Writes what presses each connection with friction (N) and the load of its accumulator.
    pub fn signs(&self, places: Places<'_>, internal: &[f64], signs: &mut [f64]) {
        self.frictions(places, internal, |i, friction| {
            signs[SIGNS * i..][..SIGNS].copy_from_slice(&[friction.normal, friction.load]);
        });
    }
}
