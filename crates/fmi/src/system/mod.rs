//! Any system of bodies and elements behind the variables, through named ports.
//!
//! A [`Plant`] is the data: a system, its quantities, and what its inputs do and its outputs read. Loads are
//! constant within a communication step; prescribed bodies follow cubics through values and rates at both
//! ends of it, and the integrator is not restarted (`docs/decisions/0014-driven-motions.md`). With constant
//! loads Q the work that comes in is `Q · Δq`, exactly: it is the last state. The work of the prescribed
//! motions is in the system's own ledger.

mod entries;
mod inputs;
mod ports;
mod state;

use integrate::{Integrator, Options, Problem};
use mechanics::energy_balance::LOOSEST;
use mechanics::plausibility::{FindingKind, Location, Plausibility, PlausibilityFinding};
use mechanics::system::{Contacts, Observation, StaticFriction, System};
use study::progress::{self, Pace};

use crate::Error;
use crate::element::{Element, Interface, Setting, Slopes};
use crate::element_state::ElementState;
pub(crate) use entries::{
    accumulated, accumulators, add_loads, add_motion, add_table, contact, contacts, deflection, internals,
    kinds, ledger, load, motions, motions_along_axes, options, unit,
};
use inputs::{InputLoads, lead, place};
pub use ports::{LoadPort, MotionPort, Plant, PortDirection, Ports, Reading, Six, StartPort, TableReader};

/// The place of the option that says who moves prescribed bodies, in [`options`].
pub(crate) const MOTION: usize = 0;
/// The place of the option that says how a system starts.
pub(crate) const START: usize = 1;

/// Tolerances that an importer may ask for.
const TOLERANCES: [f64; 2] = [1e-12, 1e-3];

/// A communication point this near to a discontinuity of a prescribed motion, as a share of the time or of
/// the step, is taken for it: sums of steps and times in files differ by rounding, and a step of that size is
/// lost.
const SAME_TIME: f64 = 1e-12;

/// The start of a system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StartState {
    /// At its initial coordinates and at rest, or as its parameters say.
    Initial,
    /// In static equilibrium without friction, prescribed bodies being where they are.
    Equilibrium,
}

/// A system behind the variables.
pub struct SystemElement {
    pub(crate) plant: Plant,
    integrator: Option<Integrator<System>>,
    loads: InputLoads,
    /// The contact states, if they are variables.
    contacts: Option<Contacts>,
    /// True if inputs move prescribed bodies; else these follow motions of their own.
    driven: bool,
    time: f64,
    /// Those of the system, then the work of the loads.
    states: Vec<f64>,
    inputs: Vec<f64>,
    /// Stored energy at the start, J.
    start_energy: f64,
    /// The start of the smooth piece of the prescribed motions (s), where an importer integrates.
    piece_start: f64,
    /// The values of the table.
    row: Vec<f64>,
    /// Rates of the states, for the table.
    table_rates: Vec<f64>,
    plausibility: Plausibility,
}

impl SystemElement {
    /// Returns the system of a plant under these settings, at its start; `driven` says whether inputs move
    /// prescribed bodies.
    ///
    /// # Errors
    /// Values that are not finite, no equilibrium, or the integrator refuses the start.
    pub fn new(plant: Plant, setting: &Setting, start: StartState, driven: bool) -> Result<Self, Error> {
        let failed = |error: &dyn std::fmt::Display| Error::new(error.to_string());
        let mut plant = plant;
        let time = setting.start_time;
        check_inputs(&setting.inputs, plant.entries.inputs.len())?;
        let mut loads = InputLoads::new(&plant.system, &plant.ports);
        loads.set(&plant.ports, &setting.inputs);
        loads.put(&mut plant.system)?;
        if driven {
            place(&mut plant.system, &plant.ports, &setting.inputs, time)?;
        }
        plant.system.next_time_discontinuity(time);
        let initial = plant.initial.clone();
        let mut states = initial.unwrap_or_else(|| plant.system.initial_state());
        if start == StartState::Equilibrium {
            let drawn = states.clone();
            let found = plant.system.equilibrium(time, &drawn, StaticFriction::Without);
            states = found.map_err(|error| {
                Error::new(format!("there is no static equilibrium to start from: {error}"))
            })?;
        }
        let speeds = plant.system.layout().speeds;
        for (port, value) in plant.ports.starts.iter().zip(&setting.parameters) {
            if let Some(place) = plant.system.position_of(port.body, port.coordinate) {
                states[if port.rate { speeds + place } else { place }] = *value;
            }
        }
        let start_energy = plant.system.observe(time, &states).energies.total();
        let integrator = match setting.interface {
            Interface::ModelExchange => None,
            Interface::CoSimulation => {
                let own = plant.options.clone();
                let tolerance = setting.tolerance.unwrap_or(own.relative_tolerance);
                let options = Options {
                    relative_tolerance: tolerance.clamp(TOLERANCES[0], TOLERANCES[1]),
                    ..own
                };
                let made = Integrator::new(plant.system.clone(), options, time, &states);
                Some(made.map_err(|error| failed(&error))?)
            }
        };
        let reports_contacts = !plant.entries.modes.is_empty();
        let contacts = reports_contacts.then(|| Contacts::new(&mut plant.system, time, &states));
        let plausibility = Plausibility::new(&mut plant.system, time, &states);
        states.push(0.0);
        Ok(Self {
            plant,
            integrator,
            loads,
            contacts,
            driven,
            time,
            states,
            inputs: setting.inputs.clone(),
            start_energy,
            piece_start: time,
            row: Vec::new(),
            table_rates: Vec::new(),
            plausibility,
        })
    }

    /// Returns the dimension of the system.
    fn dimension(&self) -> usize {
        self.plant.system.layout().len()
    }

    /// Brings the copy of the system that is evaluated to inputs and time.
    fn put_inputs(&mut self) -> Result<(), Error> {
        self.loads.set(&self.plant.ports, &self.inputs);
        self.loads.put(&mut self.plant.system)?;
        if self.driven {
            place(&mut self.plant.system, &self.plant.ports, &self.inputs, self.time)?;
        }
        Ok(())
    }

    fn observe(&mut self) -> Observation {
        let dimension = self.dimension();
        self.plant.system.observe(self.time, &self.states[..dimension])
    }

    /// Evaluates the table.
    fn read_table(&mut self, seen: &Observation) {
        self.row.clear();
        let dimension = self.dimension();
        if let Some(table) = &mut self.plant.table {
            let rates = &mut self.table_rates;
            if self.plant.table_takes_rates {
                rates.resize(dimension, 0.0);
                self.plant
                    .system
                    .derivative(self.time, &self.states[..dimension], rates);
            }
            table(seen, rates, &mut self.row);
        }
    }

    /// Integrates to a communication point (s), inputs being in place.
    fn advance(&mut self, point: f64) -> Result<(), Error> {
        let Some(integrator) = &mut self.integrator else {
            return Err(Error::new("a step belongs to co-simulation"));
        };
        let length = point - integrator.time();
        let time = discontinuity_at(&self.plant.system, self.driven, point, length).unwrap_or(point);
        let mut pace = Pace::of(integrator);
        let numbers = [&*self.plant.numbers[0], &*self.plant.numbers[1]];
        while integrator.time() < time {
            let name = |state| progress::state_name(&self.plant.system, numbers, state);
            if let Err(error) = integrator.step_to(time) {
                return Err(Error::new(progress::describe(&error, name)));
            }
            pace.check(integrator, length).map_err(|stalled| {
                Error::new(format!(
                    "the step of {length} s to {time} s cannot be finished: {}; make it shorter, or \
                     look for inputs that are far out",
                    stalled.describe(name)
                ))
            })?;
        }
        Ok(())
    }

    /// Takes over what the integrator has reached at a communication point (s).
    fn follow(&mut self, point: f64) -> Result<(), Error> {
        let Some(integrator) = &self.integrator else {
            return Ok(());
        };
        let speeds = self.plant.system.layout().speeds;
        let after = integrator.x();
        let ways = after[..speeds].iter().zip(&self.states[..speeds]);
        let work = self.loads.work(ways.map(|(after, before)| after - before));
        let dimension = self.plant.system.layout().len();
        self.states[..dimension].copy_from_slice(after);
        self.states[dimension] += work;
        self.time = point;
        if let Some(contacts) = &mut self.contacts {
            contacts.states.copy_from_slice(integrator.discrete_states());
        }
        self.plant.system.segment_like(integrator.problem());
        self.put_inputs()
    }
}

/// Returns the discontinuity of the prescribed motions that a communication point at the end of a step of
/// this length (s) is taken for, if there is one.
fn discontinuity_at(system: &System, driven: bool, point: f64, length: f64) -> Option<f64> {
    if driven {
        return None;
    }
    let slack = SAME_TIME * point.abs().max(length);
    let breaks = system.bodies().iter();
    let breaks = breaks.filter_map(|body| body.frame.next_break(point - slack));
    breaks
        .min_by(f64::total_cmp)
        .filter(|time| *time <= point + slack)
}

/// Largest size of an input, SI: no motion and no load of a machine comes near it, and steps under larger
/// ones would be so short that they lead nowhere.
const LARGEST_INPUT: f64 = 1e15;

/// Checks the values of all inputs.
fn check_inputs(inputs: &[f64], count: usize) -> Result<(), Error> {
    if inputs.len() != count || !inputs.iter().all(|value| value.is_finite()) {
        return Err(Error::new("an input is not finite"));
    }
    match inputs.iter().find(|value| value.abs() > LARGEST_INPUT) {
        Some(value) => Err(Error::new(format!(
            "an input is {value:e}, out of all proportion: at most {LARGEST_INPUT:e} (SI units) is admissible"
        ))),
        None => Ok(()),
    }
}

impl Element for SystemElement {
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
        self.states.copy_from_slice(states);
        if time != self.time {
            self.time = time;
            self.put_inputs()?;
        }
        Ok(())
    }

    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error> {
        check_inputs(inputs, self.inputs.len())?;
        self.inputs.copy_from_slice(inputs);
        self.put_inputs()
    }

    fn tune(&mut self, _: &[f64]) -> Result<(), Error> {
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        check_inputs(end, self.inputs.len())?;
        let Some(integrator) = &mut self.integrator else {
            return Err(Error::new("a step belongs to co-simulation"));
        };
        let ports = &self.plant.ports;
        let moved = self.driven && !ports.motions.is_empty();
        let same = self
            .inputs
            .iter()
            .zip(end)
            .all(|(a, b)| a.to_bits() == b.to_bits());
        if moved {
            let start = integrator.time();
            let step = [start, time - start];
            lead(integrator.problem_mut(), ports, [&self.inputs, end], step)?;
        }
        if moved || !same {
            self.loads.set(ports, end);
            self.loads.put(integrator.problem_mut())?;
            integrator.reevaluate();
            self.inputs.copy_from_slice(end);
        }
        self.advance(time)?;
        self.follow(time)
    }

    fn attempts(&self) -> u64 {
        let made = self.integrator.as_ref();
        made.map_or(0, |integrator| integrator.statistics().attempts())
    }

    fn rates(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let dimension = self.dimension();
        if out.len() != dimension + 1 {
            return Err(Error::new("the rates have another number"));
        }
        let (rates, power) = out.split_at_mut(dimension);
        let system = &mut self.plant.system;
        system.derivative(self.time, &self.states[..dimension], rates);
        let speeds = system.layout().speeds;
        power[0] = self.loads.work(self.states[speeds..2 * speeds].iter().copied());
        Ok(())
    }

    fn indicators(&mut self, out: &mut [f64]) {
        let dimension = self.dimension();
        let Some(contacts) = &mut self.contacts else {
            return;
        };
        let functions = contacts.evaluate(&mut self.plant.system, self.time, &self.states[..dimension]);
        for (target, function) in out.iter_mut().zip(functions) {
            // One that is zero has been passed.
            *target = if *function == 0.0 {
                -f64::MIN_POSITIVE
            } else {
                *function
            };
        }
    }

    fn modes(&self) -> &[u8] {
        self.contacts.as_ref().map_or(&[], |contacts| &contacts.states)
    }

    fn update_modes(&mut self) -> bool {
        let dimension = self.dimension();
        let (system, states) = (&mut self.plant.system, &self.states[..dimension]);
        match (&mut self.contacts, &self.integrator) {
            (Some(contacts), None) => contacts.update(system, self.time, states),
            _ => false,
        }
    }

    fn next_time_event(&mut self) -> Option<f64> {
        if self.driven || self.integrator.is_some() {
            return None;
        }
        self.piece_start = self.time;
        let next = self.plant.system.next_time_discontinuity(self.time);
        next.is_finite().then_some(next)
    }

    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let seen = self.observe();
        self.read_table(&seen);
        for (target, reading) in out.iter_mut().zip(&self.plant.ports.outputs) {
            *target = match reading {
                Reading::Displacement(direction) => direction.value(&seen.bodies[direction.body].coordinates),
                Reading::Rate(direction) => direction.value(&seen.bodies[direction.body].speeds),
                Reading::Table(number) => self.row.get(*number).copied().unwrap_or(f64::NAN),
            };
        }
        Ok(())
    }

    fn columns(&mut self, out: &mut [f64]) {
        let seen = self.observe();
        self.read_table(&seen);
        let own = self.plant.ports.columns.iter();
        let own = own.map(|number| self.row.get(*number).copied().unwrap_or(f64::NAN));
        let load_work = self.states[self.dimension()];
        let of_stored = seen.residual(self.start_energy) - load_work;
        let mut ledger = self.plant.system.ledger_entries(&seen, self.start_energy);
        ledger.work += load_work;
        let options = self
            .integrator
            .as_ref()
            .map_or(&self.plant.options, Integrator::options);
        let (tolerance, dimension) = (options.relative_tolerance.min(LOOSEST), self.dimension());
        let system = &mut self.plant.system;
        ledger.admissible = tolerance * system.energy_of_speed_errors(self.time, &self.states[..dimension]);
        ledger.residual = if self.plant.residual_of_stored {
            of_stored
        } else {
            -of_stored
        };
        let balance = [ledger.stored_change, ledger.residual, ledger.relative_residual()];
        for (target, value) in out.iter_mut().zip(own.chain(balance)) {
            *target = value;
        }
    }

    fn findings(&mut self) -> Vec<PlausibilityFinding> {
        let (system, states) = (&mut self.plant.system, &self.states[..self.states.len() - 1]);
        self.plausibility.note(system, self.time, states);
        let mut findings = self.plausibility.present(system);
        // What runs along a track leaves its place.
        findings.retain(|own| !(self.plant.rolls && own.kind == FindingKind::Displacement));
        findings
    }

    fn derailed(&mut self) -> Option<String> {
        let watch = self.plant.derailed.as_ref()?;
        let states = &self.states[..self.states.len() - 1];
        watch(&self.plant.system.observe(self.time, states))
    }

    fn place(&self, location: Location) -> String {
        location.describe(&self.plant.system)
    }

    fn jacobian_vector_product(&mut self, _: &[f64], _: &[f64]) -> Result<Slopes, Error> {
        Err(Error::new(
            "there are no directional derivatives of bodies with linearized kinematics",
        ))
    }

    fn save(&self) -> ElementState {
        ElementState::System(Box::new(self.saved()))
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        match state {
            ElementState::System(state) => self.go_back(state),
            _ => Err(Error::new("the saved state belongs to another model")),
        }
    }
}
