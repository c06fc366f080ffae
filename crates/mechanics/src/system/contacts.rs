//! Contact states of a system and their event functions, for callers that integrate it themselves.

use integrate::{EventGroup, Problem};

use super::System;

/// The contact states of a system that a caller integrates.
#[derive(Clone, Debug)]
pub struct Contacts {
    groups: Vec<EventGroup>,
    variables: Vec<f64>,
    /// For each contact state a number that is positive while the state lasts.
    functions: Vec<f64>,
    /// The states: 0 open, 1 stick, 2 slip.
    pub states: Vec<u8>,
}

impl Contacts {
    /// Returns those of a system at `time` (s) and state `x`.
    #[must_use]
    pub fn new(system: &mut System, time: f64, x: &[f64]) -> Self {
        let structure = system.structure();
        let mut states = vec![0; structure.discrete_states()];
        system.initial_discrete_states(time, x, &mut states);
        Self {
            variables: vec![0.0; structure.event_variables()],
            groups: structure.event_groups,
            functions: vec![0.0; states.len()],
            states,
        }
    }

    /// Returns the event function of each contact state at `time` (s) and state `x`: positive while it lasts,
    /// zero or negative if it must change.
    pub fn evaluate(&mut self, system: &mut System, time: f64, x: &[f64]) -> &[f64] {
        system.event_variables(None, time, x, &mut self.variables);
        for number in 0..self.groups.len() {
            self.evaluate_group(system, number);
        }
        &self.functions
    }

    fn evaluate_group(&mut self, system: &mut System, number: usize) {
        let group = &self.groups[number];
        let own = group.discrete_states.clone();
        let variables = &self.variables[group.variables.clone()];
        let (states, functions) = (&self.states[own.clone()], &mut self.functions[own]);
        system.event_functions(number, variables, states, functions);
    }

    /// Brings the states up to date; returns whether one has changed.
    pub fn update(&mut self, system: &mut System, time: f64, x: &[f64]) -> bool {
        self.evaluate(system, time, x);
        let mut changed = false;
        for number in 0..self.groups.len() {
            let own = self.groups[number].discrete_states.clone();
            for place in own.clone() {
                // A change may lead straight to the next one, open to stick to slip.
                for _ in 0..3 {
                    if self.functions[place] > 0.0 {
                        break;
                    }
                    let variables = &self.variables[self.groups[number].variables.clone()];
                    let state = self.states[place];
                    let next = system.next_discrete_state(number, variables, place - own.start, state);
                    if next == state {
                        break;
                    }
                    self.states[place] = next;
                    self.evaluate_group(system, number);
                    changed = true;
                }
            }
        }
        changed
    }
}
