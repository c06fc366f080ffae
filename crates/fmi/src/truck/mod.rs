//! The half-truck without its wedges behind the variables: with four FMUs of wedges it is the truck.
//!
//! Its wedges' forces are inputs, held within a communication step; the motions of the points where the wedges are, are outputs.
//! These depend on states alone, so that truck and wedges make no algebraic loop.

mod body;
mod entries;

use integrate::{Integrator, Options, Problem, State};
use mechanics::energy_balance;
use mechanics::system::{ContactState, System};
use serde::{Deserialize, Serialize};
use study::case::Case;
use study::progress::{self, Pace};

use crate::Error;
use crate::element::{Element, ElementState, Entries, Interface, Setting, Slopes};
use crate::instance::{check_finite, damaged};
use body::{BODY, Loaded, Six};
pub use body::{FILE, WEDGES};
use entries::{LOADS, MOTIONS, START};

/// All quantities of the truck that has room for a case's wedges.
///
/// # Errors
/// Never, with the built-in file.
pub fn entries(case: &Case) -> Result<Entries, Error> {
    Ok(entries::entries(&Loaded::new(&case.parameters)?))
}

/// The saved state of a truck.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TruckState {
    pub(crate) time: f64,
    states: Vec<f64>,
    inputs: Vec<f64>,
    start_energy: f64,
    integrator: Option<State>,
}

/// The truck behind the variables.
pub struct TruckElement {
    truck: Loaded,
    integrator: Option<Integrator<System>>,
    time: f64,
    /// Those of the system, then the work of the loads.
    states: Vec<f64>,
    inputs: Vec<f64>,
    /// Stored energy at the start, J.
    start_energy: f64,
}

fn six(values: &[f64], first: usize) -> Six {
    std::array::from_fn(|k| values.get(first + k).copied().unwrap_or(0.0))
}

/// Puts the loads that the inputs say on a truck.
fn put_loads(truck: &mut Loaded, inputs: &[f64]) -> Result<(), Error> {
    let wedges = std::array::from_fn(|wedge| [0, 6].map(|first| six(inputs, LOADS * wedge + first)));
    truck.set_loads(&wedges, six(inputs, LOADS * WEDGES.len()))
}

impl TruckElement {
    /// The truck under these settings, at its start.
    ///
    /// # Errors
    /// Values that are not finite; or the integrator refuses the start.
    pub fn new(case: &Case, setting: &Setting) -> Result<Self, Error> {
        let mut truck = Loaded::new(&case.parameters)?;
        put_loads(&mut truck, &setting.inputs)?;
        let mut states = truck.system.initial_state();
        let speeds = truck.system.layout().speeds;
        for coordinate in 0..6 {
            if let Some(place) = truck.system.position_of(BODY, coordinate) {
                let start = |index: usize| setting.parameters.get(index).copied().unwrap_or(0.0);
                states[place] = start(coordinate);
                states[speeds + place] = start(START / 2 + coordinate);
            }
        }
        truck.system.next_time_discontinuity(setting.start_time);
        let start_energy = truck.system.observe(setting.start_time, &states).energies.total();
        let integrator = match setting.interface {
            Interface::ModelExchange => None,
            Interface::CoSimulation => {
                let simulation = study::stepping::options(&case.simulation);
                let options = Options {
                    relative_tolerance: setting
                        .tolerance
                        .unwrap_or(simulation.relative_tolerance)
                        .clamp(1e-12, 1e-3),
                    ..Options::default()
                };
                let made = Integrator::new(truck.system.clone(), options, setting.start_time, &states);
                Some(made.map_err(|error| Error::new(error.to_string()))?)
            }
        };
        states.push(0.0);
        Ok(Self {
            truck,
            integrator,
            time: setting.start_time,
            states,
            inputs: setting.inputs.clone(),
            start_energy,
        })
    }

    fn dimension(&self) -> usize {
        self.truck.system.layout().len()
    }
}

impl Element for TruckElement {
    fn states(&self) -> &[f64] {
        &self.states
    }

    fn set_states(&mut self, time: f64, states: &[f64]) -> Result<(), Error> {
        if states.len() != self.states.len() || !states.iter().chain([&time]).all(|value| value.is_finite()) {
            return Err(Error::new(format!(
                "time and {} finite states are expected",
                self.states.len()
            )));
        }
        self.time = time;
        self.states.copy_from_slice(states);
        Ok(())
    }

    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error> {
        if inputs.len() != self.inputs.len() || !inputs.iter().all(|value| value.is_finite()) {
            return Err(Error::new("an input is not finite"));
        }
        self.inputs.copy_from_slice(inputs);
        put_loads(&mut self.truck, &self.inputs)
    }

    fn tune(&mut self, _: &[f64]) -> Result<(), Error> {
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        self.set_inputs(end)?;
        let dimension = self.dimension();
        let speeds = self.truck.system.layout().speeds;
        let Some(integrator) = &mut self.integrator else {
            return Err(Error::new("a step belongs to co-simulation"));
        };
        self.truck.put_loads(integrator.problem_mut())?;
        integrator.reevaluate();
        let before = self.states[..speeds].to_vec();
        let length = time - integrator.time();
        let mut pace = Pace::of(integrator);
        while integrator.time() < time {
            let name = |state| progress::truck_state_name(&self.truck.system, [&[], &[]], state);
            if let Err(error) = integrator.step_to(time) {
                return Err(Error::new(progress::describe(&error, name)));
            }
            pace.check(integrator, length).map_err(|stalled| {
                Error::new(format!(
                    "the step of {length} s to {time} s cannot be finished: {}; make it shorter, or look for inputs that are far out",
                    stalled.describe(name)
                ))
            })?;
        }
        self.time = time;
        self.states[..dimension].copy_from_slice(integrator.x());
        let ways = self.states[..speeds]
            .iter()
            .zip(&before)
            .map(|(after, before)| after - before);
        let work = self.truck.work(ways);
        self.states[dimension] += work;
        Ok(())
    }

    fn rates(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let dimension = self.dimension();
        if out.len() != dimension + 1 {
            return Err(Error::new("the rates have another number"));
        }
        let (rates, power) = out.split_at_mut(dimension);
        self.truck
            .system
            .derivative(self.time, &self.states[..dimension], rates);
        let speeds = self.truck.system.layout().speeds;
        power[0] = self.truck.work(self.states[speeds..2 * speeds].iter().copied());
        Ok(())
    }

    fn indicators(&mut self, _: &mut [f64]) {}

    fn modes(&self) -> &[u8] {
        &[]
    }

    fn update_modes(&mut self) -> bool {
        false
    }

    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let speeds = self.truck.system.layout().speeds;
        let (positions, rates) = self.states[..2 * speeds].split_at(speeds);
        for (number, values) in out.chunks_mut(MOTIONS / 4).enumerate() {
            // For each wedge and neighbour positions, then rates.
            let (wedge, neighbour) = (number / 4, number / 2 % 2);
            let of = if number % 2 == 0 { positions } else { rates };
            let motion = self.truck.neighbour(wedge, neighbour, of);
            values.copy_from_slice(motion.get(..values.len()).unwrap_or(&motion));
        }
        Ok(())
    }

    fn columns(&mut self, out: &mut [f64]) {
        let dimension = self.dimension();
        let seen = self.truck.system.observe(self.time, &self.states[..dimension]);
        let change = seen.energies.total() - self.start_energy;
        let residual = seen.residual(self.start_energy) - self.states[dimension];
        let ledger = energy_balance::Entries {
            work: self.states[dimension],
            losses: seen.quadratures.iter().skip(1).sum(),
            stored_change: change,
            residual,
        };
        for (target, value) in out.iter_mut().zip([change, residual, ledger.relative_residual()]) {
            *target = value;
        }
    }

    fn jacobian_vector_product(&mut self, _: &[f64], _: &[f64]) -> Result<Slopes, Error> {
        Err(Error::new("the truck gives no directional derivatives"))
    }

    fn save(&self) -> ElementState {
        ElementState::Truck(Box::new(TruckState {
            time: self.time,
            states: self.states.clone(),
            inputs: self.inputs.clone(),
            start_energy: self.start_energy,
            integrator: self.integrator.as_ref().map(Integrator::state),
        }))
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        let ElementState::Truck(state) = state else {
            return Err(Error::new("the saved state belongs to another model"));
        };
        for (member, found, own) in [
            ("the truck's states", state.states.len(), self.states.len()),
            ("the truck's inputs", state.inputs.len(), self.inputs.len()),
        ] {
            if found != own {
                let (found, own) = (format!("a list of {found}"), format!("a list of {own}"));
                return Err(damaged(member, found, own));
            }
        }
        check_finite("the truck's states", &state.states)?;
        check_finite("the truck's inputs", &state.inputs)?;
        check_finite(
            "the truck's time and start energy",
            [&state.time, &state.start_energy],
        )?;
        match (&mut self.integrator, &state.integrator) {
            (None, None) => {}
            (Some(integrator), Some(saved)) => {
                integrator
                    .check_state(saved)
                    .map_err(|error| Error::new(error.to_string()))?;
                let modes = &saved.discrete_states;
                if let Some(mode) = modes.iter().find(|mode| **mode > ContactState::Slip as u8) {
                    let expected = "0 (open), 1 (stick) or 2 (slip)";
                    return Err(damaged("a contact state of the truck", mode, expected));
                }
                put_loads(&mut self.truck, &state.inputs)?;
                self.truck.put_loads(integrator.problem_mut())?;
                integrator
                    .restore(saved)
                    .map_err(|error| Error::new(error.to_string()))?;
            }
            _ => {
                return Err(Error::new(
                    "the saved state belongs to the other kind of interface (model exchange or co-simulation)",
                ));
            }
        }
        self.start_energy = state.start_energy;
        self.set_states(state.time, &state.states)?;
        self.set_inputs(&state.inputs)
    }
}
