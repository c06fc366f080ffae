//! The saved state of a system behind the variables.

use integrate::{Integrator, Problem};
use mechanics::system::ContactState;

use super::SystemElement;
use super::inputs::place;
use crate::Error;
use crate::element::Element;
use crate::element_state::SystemState;
use crate::error::{check_finite, damaged};

impl SystemState {
    /// Checks whether it can be a state of this element; its integrator is checked by the element's.
    fn check(&self, element: &SystemElement) -> Result<(), Error> {
        for (member, found, own) in [
            ("the system's states", self.states.len(), element.states.len()),
            ("the system's inputs", self.inputs.len(), element.inputs.len()),
            (
                "the system's contact states",
                self.contact_states.len(),
                element.modes().len(),
            ),
        ] {
            if found != own {
                let (found, own) = (format!("a list of {found}"), format!("a list of {own}"));
                return Err(damaged(member, found, own));
            }
        }
        check_finite("the system's states", &self.states)?;
        check_finite("the system's inputs", &self.inputs)?;
        let inputs = element.plant.check_inputs(&self.inputs);
        inputs.map_err(|error| Error::new(format!("the saved state is damaged: {error}")))?;
        let times = [&self.time, &self.start_energy, &self.piece_start];
        check_finite("the system's time, start energy and start of the piece", times)?;
        if self.piece_start > self.time {
            let expected = format!("at most the time, {} s", self.time);
            return Err(damaged("the start of the piece", self.piece_start, expected));
        }
        let integrated = self.integrator.iter().flat_map(|state| &state.discrete_states);
        let mut contact_states = self.contact_states.iter().chain(integrated);
        match contact_states.find(|state| **state > ContactState::Slip as u8) {
            Some(state) => Err(damaged(
                "a contact state of the system",
                state,
                "0 (open), 1 (stick) or 2 (slip)",
            )),
            None => Ok(()),
        }
    }
}

impl SystemElement {
    /// Returns all that is needed to go on with the same bits.
    pub(super) fn saved(&self) -> SystemState {
        SystemState {
            time: self.time,
            states: self.states.clone(),
            inputs: self.inputs.clone(),
            contact_states: self.modes().to_vec(),
            start_energy: self.start_energy,
            piece_start: self.piece_start,
            integrator: self.integrator.as_ref().map(Integrator::state),
        }
    }

    /// Goes back to a saved state.
    ///
    /// # Errors
    /// The state cannot be one of this element; nothing has changed then.
    pub(super) fn go_back(&mut self, state: &SystemState) -> Result<(), Error> {
        state.check(self)?;
        self.loads.set(&self.plant.ports, &state.inputs);
        match (&mut self.integrator, &state.integrator) {
            (None, None) => {
                self.plant.system.next_time_discontinuity(state.piece_start);
            }
            (Some(integrator), Some(saved)) => {
                if let Err(error) = integrator.check_state(saved) {
                    self.loads.set(&self.plant.ports, &self.inputs);
                    return Err(Error::of(error));
                }
                let system = integrator.problem_mut();
                self.loads.put(system)?;
                if self.plant.driven {
                    place(system, &self.plant.ports, &state.inputs, saved.time)?;
                }
                integrator.restore(saved).map_err(Error::of)?;
                self.plant.system.segment_like(integrator.problem());
            }
            _ => {
                self.loads.set(&self.plant.ports, &self.inputs);
                return Err(Error::new(
                    "the saved state belongs to the other kind of interface (model exchange or \
                     co-simulation)",
                ));
            }
        }
        if let Some(contacts) = &mut self.contacts {
            contacts.states.copy_from_slice(&state.contact_states);
        }
        self.start_energy = state.start_energy;
        self.piece_start = state.piece_start;
        self.time = state.time;
        self.states.copy_from_slice(&state.states);
        self.inputs.copy_from_slice(&state.inputs);
        self.put_inputs()
    }
}
