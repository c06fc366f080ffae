//! Contact states of the friction elements: open, stick, slip; when they change.
//!
//! Contact states are recorded. They do not change the forces. Thresholds with hysteresis keep rounding from
//! counting as events:
//! - an element closes where its normal force (of a wedge its coil force) grows to [`CLOSING_FORCE`], and
//!   opens where it falls to [`OPENING_FORCE`];
//! - it starts to slip where the load |T|/limit of its accumulator rises to [`SLIP_LOAD`], and sticks again
//!   where it falls to [`STICK_LOAD`], the values of bristles elsewhere in this program.

use super::accumulator::Friction;
use super::forces::{CoordinatesAndRates, SpatialLaw, deflection_at};
use super::{Connections, FrictionRule, Spatial};
use crate::contact_state::{ContactState, SLIP_LOAD, STICK_LOAD};

/// An element closes at this normal (or coil) force, N.
pub const CLOSING_FORCE: f64 = 2e-3;
/// An element opens at this normal (or coil) force, N.
pub const OPENING_FORCE: f64 = 1e-3;
/// Bristles, in the tables of thresholds.
const BRISTLE: usize = 1;

/// Normal (or coil) force of an element, N, and the load of its accumulator: its event variables.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrictionVariables {
    normal: f64,
    load: f64,
}

/// Number of event variables of an element.
pub(crate) const FRICTION_VARIABLES: usize = 2;

impl FrictionVariables {
    /// Returns the event variables of one element, out of those of all.
    pub(crate) fn of(variables: &[f64], index: usize) -> Self {
        Self {
            normal: variables[FRICTION_VARIABLES * index],
            load: variables[FRICTION_VARIABLES * index + 1],
        }
    }

    /// Returns the event function: positive while the contact state lasts.
    pub(crate) fn margin(self, contact_state: ContactState) -> f64 {
        let stays_closed = (self.normal - OPENING_FORCE) / OPENING_FORCE;
        // Without a force the load has no meaning; `min` ignores NaN.
        let load = if self.normal > 0.0 { self.load } else { f64::NAN };
        match contact_state {
            ContactState::Open => (CLOSING_FORCE - self.normal) / CLOSING_FORCE,
            ContactState::Stick => (SLIP_LOAD[BRISTLE] - load).min(stays_closed),
            ContactState::Slip => (load - STICK_LOAD[BRISTLE]).min(stays_closed),
        }
    }

    /// Returns the contact state after the event function has become zero.
    pub(crate) fn next(self, contact_state: ContactState) -> ContactState {
        match contact_state {
            ContactState::Open => self.closed(),
            _ if self.normal <= OPENING_FORCE => ContactState::Open,
            ContactState::Stick if self.load >= SLIP_LOAD[BRISTLE] => ContactState::Slip,
            ContactState::Slip if self.load <= STICK_LOAD[BRISTLE] => ContactState::Stick,
            same => same,
        }
    }

    fn closed(self) -> ContactState {
        if self.load < SLIP_LOAD[BRISTLE] {
            ContactState::Stick
        } else {
            ContactState::Slip
        }
    }
}

impl Friction {
    /// Returns the contact state without a history.
    pub(crate) fn contact_state(&self) -> ContactState {
        if self.normal > OPENING_FORCE {
            let (normal, load) = (self.normal, self.load);
            FrictionVariables { normal, load }.closed()
        } else {
            ContactState::Open
        }
    }
}

/// Returns the friction of one element.
fn friction<L: SpatialLaw>(
    element: &Spatial<L>,
    coordinates: CoordinatesAndRates<'_>,
    internal: &[f64],
) -> Friction {
    let motion = element.site.motion(coordinates);
    let deflection = deflection_at(element.internal, internal);
    element
        .law
        .force_at(motion.extensions, motion.rates, deflection, FrictionRule::Law)
        .friction
}

impl Connections {
    /// Friction of every connection with friction.
    #[inline(always)]
    fn frictions(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        mut each: impl FnMut(usize, Friction),
    ) {
        for surface in &self.surfaces {
            each(surface.discrete_state, friction(surface, coordinates, internal));
        }
        for wedge in &self.wedges {
            each(wedge.discrete_state, friction(wedge, coordinates, internal));
        }
    }

    /// Writes the contact states without a history.
    pub fn find_contact_states(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        contact_states: &mut [u8],
    ) {
        self.frictions(coordinates, internal, |i, friction| {
            contact_states[i] = friction.contact_state() as u8
        });
    }

    /// Writes the normal (or coil) force of each connection with friction, N, and the load of its
    /// accumulator.
    pub fn event_variables(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        variables: &mut [f64],
    ) {
        self.frictions(coordinates, internal, |i, friction| {
            variables[FRICTION_VARIABLES * i..][..FRICTION_VARIABLES]
                .copy_from_slice(&[friction.normal, friction.load]);
        });
    }
}
