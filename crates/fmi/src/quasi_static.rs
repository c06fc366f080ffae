//! The quasi-static wedge behind the variables. Its only states are what it accumulates: work and losses.

use mechanics::plausibility::{
    FindingKind, LARGEST_COMPRESSION_SHARE, LIFTED_SHARE, Location, PlausibilityFinding,
};
use numerics::scalar::{Dual, Real};
use study::case::Case;
use wedge::Parameters;
use wedge::inputs::CoilInput;
use wedge::outputs::FACES;
use wedge::quasi_static::{Jams, PlanePlace, PlaneReading, massless, read};

use crate::Error;
use crate::element::{Element, Entries, QuantityEntry, Setting, Slopes};
use crate::element_state::ElementState;
use crate::source::{Made, Model};
use crate::wedge::entries::{coil, friction_loss, inputs, motion_work, options, outputs};
use crate::wedge::{COIL_MODE, CONVENTIONS, parameters};

/// Inputs of positions and rates: for each neighbour x, z, and their rates.
const PLACES: usize = 8;
const COIL_STIFFNESS: usize = PLACES;
const COIL_FORCE: usize = PLACES + 1;
/// Number of parts of a step to accumulate work and losses (Simpson's rule on each).
const PARTS: usize = 8;
/// Work and losses.
const STATES: usize = 3;

/// A quasi-static wedge behind the variables.
#[derive(Clone, Debug)]
struct QuasiStaticElement {
    parameters: Parameters,
    coil_mode: i32,
    time: f64,
    states: Vec<f64>,
    inputs: Vec<f64>,
    /// The parameters that an importer may set.
    known: Vec<QuantityEntry>,
}

/// A quasi-static wedge.
pub(crate) struct QuasiStaticModel;

impl Model for QuasiStaticModel {
    type Origin = Case;

    const NAME: &'static str = "FrictionWedgeQS";
    const TEXT: &'static str =
        "Friction wedge of a three-piece truck between bolster and side frame: quasi-static, without mass";
    const CONVENTIONS: &'static str = CONVENTIONS;
    const HAS_DERIVATIVES: bool = true;

    fn made(case: &Case, setting: Option<&Setting>) -> Result<Made, Error> {
        let entries = entries(case);
        let element = setting.map(|setting| QuasiStaticElement::new(case, &entries, setting));
        let element = element.transpose()?;
        Ok((
            entries,
            element.map(|element| Box::new(element) as Box<dyn Element>),
        ))
    }
}

/// Returns all quantities of the quasi-static wedge of a case.
fn entries(case: &Case) -> Entries {
    let parameters = parameters::entries(&case.parameters).into_iter();
    let options = options(case).into_iter();
    let losses = FACES.map(friction_loss);
    Entries {
        parameters: parameters.filter(|entry| is_used(&entry.name)).collect(),
        options: options.filter(|entry| entry.name != "start").collect(),
        inputs: inputs(case, &[0, 2], ""),
        outputs: outputs(&[0, 2], false),
        accumulators: STATES,
        states: std::iter::once(motion_work()).chain(losses).collect(),
        ..Entries::default()
    }
}

/// Returns whether a parameter of the wedge means anything without mass and elasticity.
fn is_used(name: &str) -> bool {
    [
        "wedge_angle",
        "wedge_mass",
        "column_wear",
        "slope_wear",
        "coil_stiffness",
        "coil_free_length",
        "coil_nominal_length",
        "column_friction",
        "slope_friction",
        "column_reference_speed",
        "toe",
        "gravity",
    ]
    .contains(&name)
}

/// Returns the readings that are outputs, in their order.
fn outputs_of<S: Real>(reading: &PlaneReading<S>) -> [S; 10] {
    let [bx, bz] = reading.on_bolster;
    let [sx, sz] = reading.on_side_frame;
    let [column, slope] = reading.normal_forces;
    let [column_loss, slope_loss] = reading.friction_losses;
    [
        bx,
        bz,
        sx,
        sz,
        reading.coil_compression,
        reading.coil_force,
        column,
        slope,
        column_loss,
        slope_loss,
    ]
}

/// Checks parameters, and whether the wedge slides both ways with them, whatever part of the friction is
/// mobilized.
fn check(parameters: &Parameters) -> Result<(), Error> {
    parameters.validate().map_err(Error::of)?;
    let wedge = massless(parameters);
    let slides = |mobilized: f64| wedge.normal_forces(mobilized, 1.0).is_some();
    if [-1.0, 0.0, 1.0].into_iter().all(slides) {
        Ok(())
    } else {
        Err(Error::of(Jams))
    }
}

impl QuasiStaticElement {
    /// Returns the quasi-static wedge of a case under these settings, at its start.
    ///
    /// # Errors
    /// Values outside their reach, or the wedge jams.
    fn new(case: &Case, entries: &Entries, setting: &Setting) -> Result<Self, Error> {
        let known = entries.parameters.clone();
        let parameters = parameters::apply(&case.parameters, &known, &setting.parameters);
        let mut element = Self {
            parameters,
            known,
            coil_mode: setting.option(COIL_MODE),
            time: setting.start_time,
            states: vec![0.0; STATES],
            inputs: setting.inputs.clone(),
        };
        check(&element.parameters)?;
        element.set_inputs(&setting.inputs)?;
        Ok(element)
    }

    fn coil(&self, inputs: &[f64]) -> CoilInput {
        coil(self.coil_mode, inputs.get(PLACES..).unwrap_or(&[]))
    }

    fn read<S: Real>(
        &self,
        inputs: &[f64],
        place: impl Fn(usize) -> S,
        coil_change: S,
    ) -> Result<PlaneReading<S>, Error> {
        let plane = |first: usize| PlanePlace {
            position: [place(first), place(first + 1)],
            rate: [place(first + 2), place(first + 3)],
        };
        read(
            &self.parameters,
            &plane(0),
            &plane(4),
            &self.coil(inputs),
            coil_change,
        )
        .map_err(Error::of)
    }

    fn here(&self) -> Result<PlaneReading<f64>, Error> {
        self.at(&self.inputs)
    }

    fn at(&self, inputs: &[f64]) -> Result<PlaneReading<f64>, Error> {
        self.read(inputs, |k| inputs.get(k).copied().unwrap_or(0.0), 0.0)
    }

    /// Power of the motions, and the losses.
    fn powers(&self, inputs: &[f64]) -> Result<[f64; STATES], Error> {
        let reading = self.at(inputs)?;
        let [column, slope] = reading.friction_losses;
        Ok([reading.motion_power, column, slope])
    }
}

impl Element for QuasiStaticElement {
    fn states(&self) -> &[f64] {
        &self.states
    }

    fn set_states(&mut self, time: f64, states: &[f64]) -> Result<(), Error> {
        if states.len() != STATES || !states.iter().chain([&time]).all(|value| value.is_finite()) {
            return Err(Error::new(format!(
                "time and {STATES} finite states are expected"
            )));
        }
        self.time = time;
        self.states.copy_from_slice(states);
        Ok(())
    }

    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error> {
        if let Some(bad) = inputs.iter().find(|value| !value.is_finite()) {
            return Err(Error::new(format!("an input is {bad}; it must be finite")));
        }
        if !self.coil(inputs).is_valid() {
            return Err(Error::new(
                "the coil's stiffness is negative; it must be zero or positive".to_owned(),
            ));
        }
        self.inputs.copy_from_slice(inputs);
        Ok(())
    }

    fn tune(&mut self, parameters: &[f64]) -> Result<(), Error> {
        let tuned = parameters::apply(&self.parameters, &self.known, parameters);
        check(&tuned)?;
        self.parameters = tuned;
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        let start = self.inputs.clone();
        let length = time - self.time;
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::new(format!("a step of {length} s is none")));
        }
        self.set_inputs(end)?;
        // Cubics between both ends, as for the wedge with mass; the coil's input holds within the step.
        let cubics: Vec<_> = [0, 1, 4, 5]
            .into_iter()
            .map(|k| {
                let motion = mechanics::motion::Motion::between(
                    0.0,
                    length,
                    [start[k], start[k + 2]],
                    [end[k], end[k + 2]],
                );
                (k, motion)
            })
            .collect();
        let mut inputs = end.to_vec();
        let mut sums = [0.0; STATES];
        for number in 0..=2 * PARTS {
            let weight = match number {
                0 => 1.0,
                last if last == 2 * PARTS => 1.0,
                odd if odd % 2 == 1 => 4.0,
                _ => 2.0,
            };
            for (k, motion) in &cubics {
                let [value, rate, _] = motion.evaluate(length * number as f64 / (2 * PARTS) as f64, 0.0);
                (inputs[*k], inputs[k + 2]) = (value, rate);
            }
            for (sum, power) in sums.iter_mut().zip(self.powers(&inputs)?) {
                *sum += weight * power;
            }
        }
        for (state, sum) in self.states.iter_mut().zip(sums) {
            *state += sum * length / (6 * PARTS) as f64;
        }
        self.time = time;
        Ok(())
    }

    fn rates(&mut self, out: &mut [f64]) -> Result<(), Error> {
        out.copy_from_slice(&self.powers(&self.inputs)?);
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
        for (target, value) in out.iter_mut().zip(outputs_of(&self.here()?)) {
            *target = value;
        }
        Ok(())
    }

    fn columns(&mut self, _: &mut [f64]) {}

    fn findings(&mut self) -> Vec<PlausibilityFinding> {
        let Ok(reading) = self.here() else {
            return Vec::new();
        };
        let (compression, coil) = (reading.coil_compression, &self.parameters.coil);
        let lifted = FindingKind::Lifted { pulls: coil.pulls };
        let solid = (FindingKind::Solid, compression, LARGEST_COMPRESSION_SHARE);
        let checks = [solid, (lifted, -compression, LIFTED_SHARE)];
        let is_inside = self.coil_mode != 2;
        let found = checks.into_iter().filter_map(|(kind, value, share)| {
            let limit = share * coil.free_length;
            (value > limit && is_inside).then_some(PlausibilityFinding {
                kind,
                location: Location::Coil(0),
                time: Some(self.time),
                since: None,
                value,
                limit,
            })
        });
        found.collect()
    }

    fn place(&self, _: Location) -> String {
        "the coil of the wedge".to_owned()
    }

    fn jacobian_vector_product(&mut self, _: &[f64], inputs: &[f64]) -> Result<Slopes, Error> {
        let change = |k: usize| inputs.get(k).copied().unwrap_or(0.0);
        let dual = |value: f64, change: f64| Dual::<1> {
            value,
            derivative: [change],
        };
        let compression = self.here()?.coil_compression;
        let coil_change = match self.coil(&self.inputs) {
            CoilInput::Internal => 0.0,
            CoilInput::Stiffness(_) => change(COIL_STIFFNESS) * compression,
            CoilInput::Force(_) => change(COIL_FORCE),
        };
        let here = &self.inputs;
        let place = |k: usize| dual(here.get(k).copied().unwrap_or(0.0), change(k));
        let reading = self.read(here, place, dual(0.0, coil_change))?;
        let slope = |value: Dual<1>| value.derivative[0];
        let [column, slope_loss] = reading.friction_losses;
        Ok(Slopes {
            rates: [reading.motion_power, column, slope_loss].map(slope).to_vec(),
            outputs: outputs_of(&reading).map(slope).to_vec(),
        })
    }

    fn save(&self) -> ElementState {
        ElementState {
            time: self.time,
            states: self.states.clone(),
            inputs: self.inputs.clone(),
            system: None,
        }
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        if state.system.is_some() {
            return Err(Error::new("the saved state belongs to another model"));
        }
        state.check(STATES, self.inputs.len())?;
        let inputs = self.set_inputs(&state.inputs);
        inputs.map_err(|error| Error::new(format!("the saved state is damaged: {error}")))?;
        self.set_states(state.time, &state.states)
    }
}
