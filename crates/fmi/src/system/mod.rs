//! Any system of bodies and elements behind the variables, through named ports.
//!
//! A [`Plant`] is the data: a system, its quantities, and what its inputs do and its outputs read. Loads and
//! forces of coils are constant within a communication step; prescribed bodies follow cubics through values
//! and rates at both ends of it, and the integrator is not restarted
//! (`docs/decisions/0014-driven-motions-are-cubics-without-restart.md`). With constant loads Q the work that
//! comes in is `Q · Δq`, exactly: it is the last state, if there is one for it. The work of the prescribed
//! motions is in the system's own ledger.

mod entries;
mod inputs;
mod ports;
mod state;

use integrate::{Integrator, Options, Problem};
use mechanics::energy_balance::LOOSEST;
use mechanics::plausibility::{FindingKind, Location, Plausibility, PlausibilityFinding};
use mechanics::system::{
    Contacts, ElementEvaluation, MotionChange, Observation, StateDirection, StaticFriction, System,
};
use study::progress::{self, Pace};

use crate::Error;
use crate::element::{Element, Interface, Setting, Slopes};
use crate::element_state::ElementState;
pub(crate) use entries::{
    Inputs, accumulated, accumulators, all_states, contact, contacts, deflection, internals, kinds, ledger,
    load, motion_state, motions, motions_along_axes, options, steps,
};
pub(crate) use inputs::release;
use inputs::{InputLoads, lead, place};
pub(crate) use ports::is_driven;
pub use ports::{
    CoilPort, CoilSource, DerailmentWatch, FrictionPort, LoadPort, MotionPort, Plant, PortDirection, Ports,
    Reading, Six, StartPort, StartState, TableReader,
};

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

/// A system behind the variables.
pub struct SystemElement {
    pub(crate) plant: Plant,
    integrator: Option<Integrator<System>>,
    loads: InputLoads,
    /// The contact states, if they are variables.
    contacts: Option<Contacts>,
    time: f64,
    /// Those of the system, then the work of the loads if that is a state.
    states: Vec<f64>,
    inputs: Vec<f64>,
    /// Stored energy at the start, J.
    start_energy: f64,
    /// The start of the smooth piece of the prescribed motions (s), where an importer integrates.
    piece_start: f64,
    /// The values of the table.
    row: Vec<f64>,
    /// What the elements do, for outputs.
    elements: ElementEvaluation<f64>,
    /// Rates of the states, for the table.
    table_rates: Vec<f64>,
    plausibility: Plausibility,
}

impl SystemElement {
    /// Returns the system of a plant under these settings, at its start.
    ///
    /// # Errors
    /// Values that are not finite, no equilibrium, or the integrator refuses the start.
    pub fn new(mut plant: Plant, setting: &Setting) -> Result<Self, Error> {
        let time = setting.start_time;
        plant.check_inputs(&setting.inputs)?;
        let mut loads = InputLoads::new(&plant.system, &plant.ports);
        loads.set(&plant.ports, &setting.inputs);
        loads.put(&mut plant.system)?;
        if plant.driven {
            place(&mut plant.system, &plant.ports, &setting.inputs, time)?;
        }
        plant.system.next_time_discontinuity(time);
        let initial = plant.initial.clone();
        let mut states = initial.unwrap_or_else(|| plant.system.initial_state());
        if plant.start == StartState::Equilibrium {
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
                let asked = setting
                    .tolerance
                    .map(|tolerance| tolerance.clamp(TOLERANCES[0], TOLERANCES[1]));
                let options = Options {
                    relative_tolerance: asked.unwrap_or(own.relative_tolerance),
                    ..own
                };
                let made = Integrator::new(plant.system.clone(), options, time, &states);
                Some(made.map_err(Error::of)?)
            }
        };
        let reports_contacts = !plant.entries.modes.is_empty();
        let contacts = reports_contacts.then(|| Contacts::new(&mut plant.system, time, &states));
        let plausibility = Plausibility::new(&mut plant.system, time, &states);
        states.resize(plant.entries.states.len(), 0.0);
        Ok(Self {
            plant,
            integrator,
            loads,
            contacts,
            time,
            states,
            inputs: setting.inputs.clone(),
            start_energy,
            piece_start: time,
            row: Vec::new(),
            elements: ElementEvaluation::default(),
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
        if self.plant.driven {
            place(&mut self.plant.system, &self.plant.ports, &self.inputs, self.time)?;
        }
        Ok(())
    }

    fn observe(&mut self) -> Observation {
        let dimension = self.dimension();
        self.plant.system.observe(self.time, &self.states[..dimension])
    }

    /// Evaluates what the elements do.
    fn evaluate(&mut self) {
        let dimension = self.dimension();
        let states = &self.states[..dimension];
        self.plant
            .system
            .evaluate_elements(self.time, states, &mut self.elements);
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
        let time = discontinuity_at(&self.plant.system, self.plant.driven, point, length).unwrap_or(point);
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
        if let Some(sum) = self.states.get_mut(dimension) {
            *sum += work;
        }
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
        self.plant.check_inputs(inputs)?;
        self.inputs.copy_from_slice(inputs);
        self.put_inputs()
    }

    fn tune(&mut self, parameters: &[f64]) -> Result<(), Error> {
        let frictions = self.plant.ports.frictions.iter();
        let tuned = frictions.filter_map(|port| Some((port, *parameters.get(port.parameter)?)));
        if let Some((port, value)) = tuned
            .clone()
            .find(|(_, value)| !(*value >= 0.0 && value.is_finite()))
        {
            let name = &self.plant.entries.parameters[port.parameter].name;
            return Err(Error::new(format!(
                "`{name}` is {value}; it must be zero or positive, and finite"
            )));
        }
        for (port, value) in tuned {
            let integrated = self.integrator.as_mut().map(Integrator::problem_mut);
            for system in std::iter::once(&mut self.plant.system).chain(integrated) {
                system.set_friction(port.face, value).map_err(Error::of)?;
            }
        }
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        self.plant.check_inputs(end)?;
        let Some(integrator) = &mut self.integrator else {
            return Err(Error::new("a step belongs to co-simulation"));
        };
        let ports = &self.plant.ports;
        let moved = self.plant.driven && !ports.motions.is_empty();
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
        if out.len() != self.states.len() {
            return Err(Error::new("the rates have another number"));
        }
        let (rates, power) = out.split_at_mut(dimension);
        let system = &mut self.plant.system;
        system.derivative(self.time, &self.states[..dimension], rates);
        let speeds = system.layout().speeds;
        power.fill(self.loads.work(self.states[speeds..2 * speeds].iter().copied()));
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
        if self.integrator.is_some() {
            return None;
        }
        self.piece_start = self.time;
        let next = self.plant.system.next_time_discontinuity(self.time);
        next.is_finite().then_some(next)
    }

    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let mut readings = self.plant.ports.outputs.iter();
        let seen = if readings.all(Reading::is_of_elements) {
            None
        } else {
            let seen = self.observe();
            self.read_table(&seen);
            Some(seen)
        };
        let mut readings = self.plant.ports.outputs.iter();
        if readings.any(Reading::is_of_elements) {
            self.evaluate();
        }
        for (target, reading) in out.iter_mut().zip(&self.plant.ports.outputs) {
            let of_elements = reading.of_elements(&self.elements, &self.plant.system);
            let value = of_elements.or_else(|| reading.of_observation(seen.as_ref()?, &self.row));
            *target = value.unwrap_or(f64::NAN);
        }
        Ok(())
    }

    fn columns(&mut self, out: &mut [f64]) {
        let seen = self.observe();
        self.read_table(&seen);
        let own = &self.plant.ports.columns;
        for (target, number) in out.iter_mut().zip(own) {
            *target = self.row.get(*number).copied().unwrap_or(f64::NAN);
        }
        let Some(balance) = out.get_mut(own.len()..).filter(|rest| !rest.is_empty()) else {
            return;
        };
        let load_work = self.states.get(self.dimension()).copied().unwrap_or(0.0);
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
        let values = [ledger.stored_change, ledger.residual, ledger.relative_residual()];
        for (target, value) in balance.iter_mut().zip(values) {
            *target = value;
        }
    }

    fn findings(&mut self) -> Vec<PlausibilityFinding> {
        let dimension = self.dimension();
        let (system, states) = (&mut self.plant.system, &self.states[..dimension]);
        self.plausibility.note(system, self.time, states);
        let mut findings = self.plausibility.present(system);
        // What runs along a track leaves its place.
        findings.retain(|own| !(self.plant.rolls && own.kind == FindingKind::Displacement));
        findings
    }

    fn derailed(&mut self) -> Option<String> {
        self.plant.derailed.as_ref()?;
        let seen = self.observe();
        self.plant.derailed.as_ref()?(&seen)
    }

    fn place(&self, location: Location) -> String {
        location.describe(&self.plant.system)
    }

    fn jacobian_vector_product(&mut self, states: &[f64], inputs: &[f64]) -> Result<Slopes, Error> {
        let none = || Error::new("there are no directional derivatives of bodies with linearized kinematics");
        let ports = &self.plant.ports;
        if !(ports.loads.is_empty()
            && ports.factors.is_empty()
            && ports.outputs.iter().all(Reading::is_of_elements))
        {
            return Err(none());
        }
        self.evaluate();
        let dimension = self.dimension();
        let change = |number: usize| inputs.get(number).copied().unwrap_or(0.0);
        let (system, ports) = (&mut self.plant.system, &self.plant.ports);
        let motions = ports.motions.iter().map(|port| {
            let at = |value: f64| std::array::from_fn(|k| if k == port.coordinate { value } else { 0.0 });
            MotionChange {
                body: port.body,
                position: at(change(port.position)),
                rate: at(change(port.rate)),
            }
        });
        let motions: Vec<MotionChange> = motions.collect();
        let mut coil_forces = vec![0.0; system.coils().len()];
        for port in &ports.coils {
            let compression = Reading::CoilCompression(port.coil).of_elements(&self.elements, system);
            let input = [self.inputs[port.input], change(port.input)];
            coil_forces[port.coil] = port.force_change(system, compression.unwrap_or(0.0), input);
        }
        let direction = StateDirection {
            state: states.get(..dimension).unwrap_or(&[]),
            motions: &motions,
            coil_forces: &coil_forces,
        };
        let product = system.jacobian_vector_product(self.time, &self.states[..dimension], &direction);
        let mut product = product.ok_or_else(none)?;
        product.rates.resize(self.states.len(), 0.0);
        let outputs = ports.outputs.iter();
        let outputs = outputs.map(|reading| {
            let slope = reading.of_elements(&product.evaluation, system);
            slope.map_or(f64::NAN, |slope| slope.derivative[0])
        });
        Ok(Slopes {
            outputs: outputs.collect(),
            rates: product.rates,
        })
    }

    fn save(&self) -> ElementState {
        self.saved()
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        self.go_back(state)
    }
}
