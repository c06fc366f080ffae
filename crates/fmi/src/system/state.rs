//! The saved state of a system behind the variables.

use integrate::{Integrator, Problem};
use mechanics::system::ContactState;

use super::SystemElement;
use super::inputs::place;
use crate::Error;
use crate::element::Element;
use crate::element_state::{ElementState, SystemState};
use crate::error::{check_finite, check_lengths, damaged};

impl SystemElement {
    /// Checks whether a state can be one of this element; its integrator is checked by the element's.
    fn check(&self, state: &ElementState, own: &SystemState) -> Result<(), Error> {
        state.check(self.states.len(), self.inputs.len())?;
        let inputs = self.plant.check_inputs(&state.inputs);
        inputs.map_err(|error| Error::new(format!("the saved state is damaged: {error}")))?;
        let count = own.contact_states.len();
        check_lengths([("the system's contact states", count, self.modes().len())])?;
        let numbers = [&own.start_energy, &own.piece_start];
        check_finite("the system's start energy and start of the piece", numbers)?;
        if own.piece_start > state.time {
            let expected = format!("at most the time, {} s", state.time);
            return Err(damaged("the start of the piece", own.piece_start, expected));
        }
        let integrated = own.integrator.iter().flat_map(|state| &state.discrete_states);
        let mut contact_states = own.contact_states.iter().chain(integrated);
        match contact_states.find(|state| **state > ContactState::Slip as u8) {
            Some(state) => Err(damaged(
                "a contact state of the system",
                state,
                "0 (open), 1 (stick) or 2 (slip)",
            )),
            None => Ok(()),
        }
    }

    /// Returns all that is needed to go on with the same bits.
    pub(super) fn saved(&self) -> ElementState {
        ElementState {
            time: self.time,
            states: self.states.clone(),
            inputs: self.inputs.clone(),
            system: Some(SystemState {
                contact_states: self.modes().to_vec(),
                start_energy: self.start_energy,
                piece_start: self.piece_start,
                integrator: self.integrator.as_ref().map(Integrator::state),
            }),
        }
    }

    /// Goes back to a saved state.
    ///
    /// # Errors
    /// The state cannot be one of this element; nothing has changed then.
    pub(super) fn go_back(&mut self, state: &ElementState) -> Result<(), Error> {
        let own = state.system.as_ref();
        let own = own.ok_or_else(|| Error::new("the saved state belongs to another model"))?;
        self.check(state, own)?;
        self.loads.set(&self.plant.ports, &state.inputs);
        match (&mut self.integrator, &own.integrator) {
            (None, None) => {
                self.plant.system.next_time_discontinuity(own.piece_start);
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
            contacts.states.copy_from_slice(&own.contact_states);
        }
        self.start_energy = own.start_energy;
        self.piece_start = own.piece_start;
        self.time = state.time;
        self.states.copy_from_slice(&state.states);
        self.inputs.copy_from_slice(&state.inputs);
        self.put_inputs()
    }
}
