//! The losses of a cycle: by dissipation term (so by face), by contact point, by contact state and by part of
//! the stroke.
//!
//! The dissipation terms of the energy ledger are integrated with the state: one a face for friction, one for
//! contact damping, one for each other element. Their increments over the four parts of the stroke
//! ([`stroke`]) are taken from the dense output at the ends of the parts, so they are the ledger's to
//! rounding. Points and contact states have no terms of their own: the power lost at each point is integrated
//! along the steps by Gauss's rule with two nodes, apart for each state that the point is in at the node; the
//! shares of points and states in a part of the stroke then divide the ledger's increment of their face. The
//! ledger and the sum of the powers are two integrals of one quantity:
//! [`EnergySummary::largest_correction`] tells by how much they differ. The states of the system stay as they
//! are, and so do the bits of a run.
//!
//! Defects: where events fall between the two nodes of a step, the boundary of states is as sharp as the
//! step.

pub mod flow;
pub mod stroke;
mod summary;
mod whole_run;

use integrate::Integrator;
use mechanics::system::{ContactState, Energies, System};
use serde::{Deserialize, Serialize};

use crate::run_error::{RunError, check_finite, check_length};
use stroke::{PARTS, Stroke};

pub use summary::{EnergySummary, Equivalent, LossSplit, STATES};

/// The two kinds of losses at a contact point: friction, and contact damping.
const KINDS: usize = 2;

/// Whole cycles of a stroke over which losses are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Beginning and end, s.
    pub ends: [f64; 2],
    /// The number of cycles.
    pub cycles: u32,
    /// The stroke.
    pub stroke: Stroke,
}

/// Takes the losses from the steps of a run.
#[derive(Debug)]
pub(crate) struct LossRecorder {
    window: Option<Window>,
    counts: LossCounts,
    points: usize,
    terms: usize,
    powers: Vec<[f64; KINDS]>,
    contact_states: Vec<u8>,
}

/// The losses so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LossCounts {
    /// The quadratures at the last end of a part of the stroke in the window, J; empty before the window.
    last: Vec<f64>,
    /// Increments of the quadratures, part by part, J; empty before the window.
    terms: Vec<f64>,
    /// Integrals of the powers by part, point, contact state and kind of loss, J; empty before the window.
    powers: Vec<f64>,
    /// The stored energies at the ends of the window, J, in the order of [`stored`], as far as it is passed.
    stored: Vec<[f64; STORED.len()]>,
}

/// The names of the stored energies.
const STORED: [&str; 7] = [
    "kinetic", "gravity", "coil", "contact", "bristle", "spring", "element",
];

/// Returns energies in the order of [`STORED`].
fn stored(energies: &Energies) -> [f64; STORED.len()] {
    let Energies {
        kinetic,
        gravity,
        coil,
        contact,
        bristle,
        spring,
        element,
    } = *energies;
    [kinetic, gravity, coil, contact, bristle, spring, element]
}

impl LossRecorder {
    /// Returns a recorder at the start of a run; without a window it takes nothing.
    pub fn new(system: &System, window: Option<Window>) -> Self {
        let points = system.point_count();
        Self {
            window,
            counts: LossCounts::default(),
            points,
            terms: system.energy_terms().len(),
            powers: vec![[0.0; KINDS]; points],
            contact_states: vec![0; points],
        }
    }

    /// Returns the losses so far.
    pub fn counts(&self) -> LossCounts {
        self.counts.clone()
    }

    /// Goes on from the losses until `time` (s).
    ///
    /// # Errors
    /// No run of this case can have lost that.
    pub fn restore(&mut self, counts: LossCounts, time: f64) -> Result<(), RunError> {
        let [start, end] = self.window.map_or([f64::INFINITY; 2], |window| window.ends);
        let started = time > start;
        let length = |full: usize| if started { full } else { 0 };
        check_length("counts.losses.last", counts.last.len(), length(self.terms))?;
        let terms = PARTS.len() * self.terms;
        check_length("counts.losses.terms", counts.terms.len(), length(terms))?;
        let powers = PARTS.len() * self.points * STATES.len() * KINDS;
        check_length("counts.losses.powers", counts.powers.len(), length(powers))?;
        let passed = usize::from(started) + usize::from(started && time >= end);
        check_length("counts.losses.stored", counts.stored.len(), passed)?;
        let values = counts.last.iter().chain(&counts.terms).chain(&counts.powers);
        let mut values = values.chain(counts.stored.iter().flatten());
        values.try_for_each(|value| check_finite("counts.losses", *value))?;
        self.counts = counts;
        Ok(())
    }

    /// Takes an accepted step; `x` is scratch memory for a state.
    pub fn step(&mut self, integrator: &Integrator<System>, system: &mut System, x: &mut [f64]) {
        let Some(window) = self.window else { return };
        let [start, end] = window.ends;
        let mut from = integrator.previous_time().max(start);
        let to = integrator.time().min(end);
        while from < to {
            if self.counts.last.is_empty() {
                self.begin(integrator, system, from, x);
            }
            let (part, part_end) = window.stroke.part(from);
            let until = part_end.min(to);
            self.integrate(integrator, system, part, [from, until], x);
            if until == part_end || until == end {
                integrator.interpolate_range(until, 0, x);
                self.end_part(system, part, x);
            }
            if until == end {
                self.counts.stored.push(stored(&system.energies(end, x)));
            }
            from = until;
        }
    }

    fn begin(&mut self, integrator: &Integrator<System>, system: &mut System, time: f64, x: &mut [f64]) {
        integrator.interpolate_range(time, 0, x);
        let [_, _, _, quadratures] = system.layout().split(x);
        self.counts = LossCounts {
            last: quadratures.to_vec(),
            terms: vec![0.0; PARTS.len() * self.terms],
            powers: vec![0.0; PARTS.len() * self.points * STATES.len() * KINDS],
            stored: vec![stored(&system.energies(time, x))],
        };
    }

    /// Adds the increments of the quadratures until the end of a part of the stroke.
    fn end_part(&mut self, system: &System, part: usize, x: &[f64]) {
        let [_, _, _, quadratures] = system.layout().split(x);
        let sums = &mut self.counts.terms[part * self.terms..][..self.terms];
        for ((sum, last), value) in sums.iter_mut().zip(&self.counts.last).zip(quadratures) {
            *sum += value - last;
        }
        self.counts.last.copy_from_slice(quadratures);
    }

    /// Returns the index of the first integral of the powers of a part, point and contact state.
    fn first_power(&self, part: usize, point: usize, state: ContactState) -> usize {
        ((part * self.points + point) * STATES.len() + state as usize) * KINDS
    }

    /// Adds the integrals of the powers over a piece of the last step.
    fn integrate(
        &mut self,
        integrator: &Integrator<System>,
        system: &mut System,
        part: usize,
        [from, until]: [f64; 2],
        x: &mut [f64],
    ) {
        // Gauss's nodes for the interval from -1 to 1; both weights are 1.
        const NODE: f64 = 0.577_350_269_189_625_8;
        let (middle, half) = (0.5 * (from + until), 0.5 * (until - from));
        let mut counts = std::mem::take(&mut self.counts.powers);
        for node in [-NODE, NODE] {
            let time = middle + node * half;
            integrator.interpolate_range(time, 0, x);
            system.contact_losses(time, x, &mut self.powers);
            self.contact_states
                .copy_from_slice(&integrator.discrete_states_before_step()[..self.points]);
            for event in integrator.events().iter().take_while(|event| event.time <= time) {
                if let Some(state) = self.contact_states.get_mut(event.index) {
                    *state = event.to;
                }
            }
            for (point, (powers, state)) in self.powers.iter().zip(&self.contact_states).enumerate() {
                let first = self.first_power(part, point, ContactState::from_number(*state));
                for (sum, power) in counts[first..][..KINDS].iter_mut().zip(powers) {
                    *sum += half * power;
                }
            }
        }
        self.counts.powers = counts;
    }
}
