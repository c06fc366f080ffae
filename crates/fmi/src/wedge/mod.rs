//! The wedge behind the variables.

pub(crate) mod entries;
pub(crate) mod parameters;

use integrate::Options;
use mechanics::plausibility::{Location, PlausibilityFinding};
use numerics::scalar::Dual;
use study::case::Case;
use study::stepping::{CoilInput, Equations, Reading, SteppedWedge};
use wedge::inputs::COIL;
use wedge::parameters::Start;

use crate::Error;
use crate::element::{Element, Entries, Interface, Setting, Slopes};
use crate::element_state::{ElementState, WedgeState};
use entries::{COIL_FORCE, COIL_STIFFNESS, neighbours};

/// Tolerances that an importer may ask for.
const TOLERANCES: [f64; 2] = [1e-12, 1e-3];

/// Returns all quantities of the wedge of a case.
///
/// # Errors
/// The case makes no wedge.
pub fn entries(case: &Case) -> Result<Entries, Error> {
    entries::entries(case)
}

/// A wedge, integrated by itself or by the importer.
enum Core {
    Driven(Box<SteppedWedge>),
    Equations(Box<Equations>),
}

/// A wedge behind the variables.
pub struct WedgeElement {
    core: Core,
    coil_mode: i32,
    /// Time of the experiment at which the wedge's own time is zero, s.
    start_time: f64,
    /// The numbers of the table's columns that are variables.
    columns: Vec<usize>,
    /// Places of the coefficients of friction among the parameters.
    friction: [Option<usize>; 2],
}

fn coil(mode: i32, inputs: &[f64]) -> CoilInput {
    let input = |index: usize| inputs.get(index).copied().unwrap_or(0.0);
    match mode {
        1 => CoilInput::Stiffness(input(COIL_STIFFNESS)),
        2 => CoilInput::Force(input(COIL_FORCE)),
        _ => CoilInput::Internal,
    }
}

impl WedgeElement {
    /// Returns the wedge of a case under these settings, at its start.
    ///
    /// # Errors
    /// Values outside their reach, or with which the number of states would be another one.
    pub fn new(case: &Case, entries: &Entries, setting: &Setting) -> Result<Self, Error> {
        let mut parameters = parameters::apply(&case.parameters, &setting.parameters);
        let option = |index: usize| setting.options.get(index).copied().unwrap_or(0);
        let coil_mode = option(0);
        parameters.start = match option(1) {
            1 => Start::Touching,
            2 => Start::Equilibrium,
            _ => Start::Rest,
        };
        let start = neighbours(&setting.inputs);
        let drive = coil(coil_mode, &setting.inputs);
        let core = match setting.interface {
            Interface::CoSimulation => {
                let options = study::stepping::options(&case.simulation);
                let relative_tolerance = match setting.tolerance {
                    Some(tolerance) => tolerance.clamp(TOLERANCES[0], TOLERANCES[1]),
                    None => options.relative_tolerance,
                };
                let options = Options {
                    relative_tolerance,
                    ..options
                };
                Core::Driven(Box::new(SteppedWedge::with(&parameters, options, &start, drive)?))
            }
            Interface::ModelExchange => {
                let mut equations = Equations::new(&parameters, &start, drive)?;
                let states = equations.states().to_vec();
                equations.set_states(setting.start_time, &states)?;
                Core::Equations(Box::new(equations))
            }
        };
        let friction =
            ["column_friction", "slope_friction"].map(|name| parameters::place(&case.parameters, name));
        let element = Self {
            coil_mode,
            start_time: setting.start_time,
            columns: entries::column_numbers(match &core {
                Core::Driven(wedge) => wedge.equations(),
                Core::Equations(equations) => equations,
            }),
            core,
            friction,
        };
        if element.states().len() != entries.states.len() {
            return Err(Error::new(format!(
                "with these parameters the wedge has {} states, but the FMU was made with {}: a damping \
                 that was zero stays zero, and one that was not stays so; export another FMU",
                element.states().len(),
                entries.states.len()
            )));
        }
        Ok(element)
    }

    fn equations(&self) -> &Equations {
        match &self.core {
            Core::Driven(wedge) => wedge.equations(),
            Core::Equations(equations) => equations,
        }
    }

    fn only_exchange(&mut self, what: &str) -> Result<&mut Equations, Error> {
        match &mut self.core {
            Core::Equations(equations) => Ok(equations),
            Core::Driven(_) => Err(Error::new(format!("{what} belongs to model exchange"))),
        }
    }
}

impl Element for WedgeElement {
    fn states(&self) -> &[f64] {
        self.equations().states()
    }

    fn set_states(&mut self, time: f64, states: &[f64]) -> Result<(), Error> {
        Ok(self.only_exchange("setting states")?.set_states(time, states)?)
    }

    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error> {
        let mode = self.coil_mode;
        let equations = self.only_exchange("setting inputs within a step")?;
        equations.set_neighbours(&neighbours(inputs))?;
        let drive = coil(mode, inputs);
        if drive != *equations.coil() {
            equations.set_coil(drive)?;
        }
        Ok(())
    }

    fn tune(&mut self, parameters: &[f64]) -> Result<(), Error> {
        let mut friction = self.equations().friction();
        for (value, place) in friction.iter_mut().zip(self.friction) {
            if let Some(tuned) = place.and_then(|place| parameters.get(place)) {
                *value = *tuned;
            }
        }
        match &mut self.core {
            Core::Driven(wedge) => wedge.set_friction(friction)?,
            Core::Equations(equations) => equations.set_friction(friction)?,
        }
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        let drive = coil(self.coil_mode, end);
        let Core::Driven(wedge) = &mut self.core else {
            return Err(Error::new("a step belongs to co-simulation"));
        };
        wedge.set_coil(drive)?;
        wedge.step_to(&neighbours(end), time - self.start_time)?;
        Ok(())
    }

    fn attempts(&self) -> u64 {
        match &self.core {
            Core::Equations(_) => 0,
            Core::Driven(wedge) => wedge.statistics().attempts(),
        }
    }

    fn rates(&mut self, out: &mut [f64]) -> Result<(), Error> {
        match &mut self.core {
            Core::Equations(equations) => equations.rates(out)?,
            Core::Driven(wedge) => wedge.rates(out)?,
        }
        Ok(())
    }

    fn indicators(&mut self, out: &mut [f64]) {
        let margins = match &mut self.core {
            Core::Equations(equations) => equations.margins(),
            Core::Driven(wedge) => wedge.margins(),
        };
        for (target, margin) in out.iter_mut().zip(margins) {
            // A margin of zero has been passed.
            *target = if *margin == 0.0 {
                -f64::MIN_POSITIVE
            } else {
                *margin
            };
        }
    }

    fn modes(&self) -> &[u8] {
        self.equations().contact_states()
    }

    fn update_modes(&mut self) -> bool {
        match &mut self.core {
            Core::Equations(equations) => equations.update_modes(),
            Core::Driven(_) => false,
        }
    }

    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error> {
        let reading = match &mut self.core {
            Core::Driven(wedge) => wedge.reading()?,
            Core::Equations(equations) => equations.reading()?,
        };
        let mut targets = out.iter_mut();
        for load in [reading.on_bolster, reading.on_side_frame] {
            for value in load.force.0.into_iter().chain(load.moment.0) {
                set(&mut targets, value);
            }
        }
        set(&mut targets, reading.coil_compression);
        set(&mut targets, reading.coil_force);
        for value in reading.normal_forces.into_iter().chain(reading.friction_losses) {
            set(&mut targets, value);
        }
        Ok(())
    }

    fn columns(&mut self, out: &mut [f64]) {
        let (row, (_, ledger)) = match &mut self.core {
            Core::Driven(wedge) => (wedge.row(), wedge.energies()),
            Core::Equations(equations) => (equations.row(), equations.energies()),
        };
        let columns = self.columns.iter();
        let values = columns.map(|number| row.get(*number).copied().unwrap_or(f64::NAN));
        let relative = ledger.entries().relative_residual();
        for (target, value) in out.iter_mut().zip(values.chain([relative])) {
            *target = value;
        }
    }

    fn findings(&mut self) -> Vec<PlausibilityFinding> {
        let (mut findings, zero) = match &mut self.core {
            Core::Driven(wedge) => (wedge.findings(), self.start_time),
            Core::Equations(equations) => (equations.findings(), 0.0),
        };
        for time in findings
            .iter_mut()
            .flat_map(|own| [&mut own.time, &mut own.since])
        {
            *time = time.map(|time| time + zero);
        }
        findings
    }

    fn place(&self, location: Location) -> String {
        location.describe(self.equations().system())
    }

    fn jacobian_vector_product(&mut self, states: &[f64], inputs: &[f64]) -> Result<Slopes, Error> {
        let change = neighbours(inputs);
        let input = |index: usize| inputs.get(index).copied().unwrap_or(0.0);
        let compression = match &mut self.core {
            Core::Driven(wedge) => wedge.reading()?,
            Core::Equations(equations) => equations.reading()?,
        }
        .coil_compression;
        let pulls = self.equations().parameters().coil.pulls;
        let force_change = match *self.equations().coil() {
            CoilInput::Internal => 0.0,
            CoilInput::Stiffness(_) if !pulls && compression <= 0.0 => 0.0,
            CoilInput::Stiffness(_) => input(COIL_STIFFNESS) * compression,
            CoilInput::Force(force) if !pulls && force <= 0.0 => 0.0,
            CoilInput::Force(_) => input(COIL_FORCE),
        };
        let product = match &mut self.core {
            Core::Driven(wedge) => wedge.jacobian_vector_product(states, &change, force_change)?,
            Core::Equations(equations) => equations.jacobian_vector_product(states, &change, force_change)?,
        };
        let equations = self.equations();
        let reading: Reading<Dual<1>> =
            Reading::of(&product.evaluation, equations.system(), equations.parameters())
                .ok_or_else(|| Error::new("the derivatives cannot be read"))?;
        let mut outputs = Vec::new();
        let slope = |value: Dual<1>| value.derivative[0];
        for load in [reading.on_bolster, reading.on_side_frame] {
            outputs.extend(load.force.0.into_iter().chain(load.moment.0).map(slope));
        }
        outputs.extend([reading.coil_compression, reading.coil_force].map(slope));
        outputs.extend(reading.normal_forces.map(slope));
        outputs.extend(reading.friction_losses.map(slope));
        debug_assert_eq!(COIL, 0);
        Ok(Slopes {
            rates: product.rates,
            outputs,
        })
    }

    fn save(&self) -> ElementState {
        let state = match &self.core {
            Core::Driven(wedge) => WedgeState::Driven(wedge.state()),
            Core::Equations(equations) => WedgeState::Equations {
                time: equations.time(),
                states: equations.states().to_vec(),
                modes: equations.contact_states().to_vec(),
                neighbours: *equations.neighbours(),
                start: *equations.start(),
                coil: *equations.coil(),
                start_coil: equations.start_coil(),
                friction: equations.friction(),
            },
        };
        ElementState::Wedge(Box::new(state))
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        let ElementState::Wedge(state) = state else {
            return Err(Error::new("the saved state belongs to another model"));
        };
        match (&mut self.core, &**state) {
            (Core::Driven(wedge), WedgeState::Driven(state)) => Ok(wedge.restore(state)?),
            (
                Core::Equations(equations),
                WedgeState::Equations {
                    time,
                    states,
                    modes,
                    neighbours,
                    start,
                    coil,
                    start_coil,
                    friction,
                },
            ) => {
                let mut fresh = Equations::new(equations.parameters(), start, *start_coil)?;
                fresh.set_coil(*coil)?;
                fresh.set_friction(*friction)?;
                fresh.set_states(*time, states)?;
                fresh.set_neighbours(neighbours)?;
                fresh.set_contact_states(modes)?;
                **equations = fresh;
                Ok(())
            }
            _ => Err(Error::new(
                "the saved state belongs to the other kind of interface (model exchange or co-simulation)",
            )),
        }
    }
}

fn set<'o>(targets: &mut impl Iterator<Item = &'o mut f64>, value: f64) {
    if let Some(target) = targets.next() {
        *target = value;
    }
}
