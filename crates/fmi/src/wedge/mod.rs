//! The wedge with mass, as data of [`crate::system`].
//!
//! Inputs move bolster and side frame, and are the coil's force if an option says so; coefficients of
//! friction may change on the way. Outputs are what the elements do to both neighbours.

pub(crate) mod entries;
pub(crate) mod parameters;

use study::case::Case;
use wedge::inputs::{COIL, CoilInput, Neighbours};
use wedge::outputs::Outputs;
use wedge::parameters::Start;
use wedge::{BOLSTER, COLUMN, Parameters, SIDE_FRAME, SLOPE, Wedge};

use crate::Error;
use crate::element::{Entries, Setting};
use crate::source::{Made, Model};
use crate::system::{CoilPort, CoilSource, FrictionPort, MotionPort, Plant, Ports, Reading};
use entries::PLACES;

/// Places of options.
pub(crate) const COIL_MODE: usize = 0;
const START: usize = 1;

/// A wedge with mass.
pub(crate) struct WedgeModel;

impl Model for WedgeModel {
    type Origin = Case;

    const NAME: &'static str = "FrictionWedge";
    const TEXT: &'static str = "Friction wedge of a three-piece truck between bolster and side frame: rigid \
                                body with mass, unilateral contact at eight corners, stick-slip friction";
    const CONVENTIONS: &'static str = CONVENTIONS;
    const HAS_DERIVATIVES: bool = true;

    fn made(case: &Case, setting: Option<&Setting>) -> Result<Made, Error> {
        plant(case, setting)?.made(setting)
    }
}

/// Frames and signs of wedges.
pub(crate) const CONVENTIONS: &str = "Fixed frame: x longitudinal, positive from the column towards the \
                                      bolster; y lateral; z up. Angles turn by R = Ry(pitch) Rz(yaw) \
                                      Rx(roll). Forces act on the named neighbour, along the fixed axes; \
                                      moments are taken about the neighbour's turning center, the point \
                                      whose displacements are the inputs.";

/// Returns the wedge of a case under these settings.
///
/// # Errors
/// The case makes no wedge, or values are outside their reach.
pub fn plant(case: &Case, setting: Option<&Setting>) -> Result<Plant, Error> {
    let mut parameters = case.parameters.clone();
    let mut start = Neighbours::of(&parameters, 0.0);
    let (mut coil, mut source) = (CoilInput::Internal, None);
    if let Some(setting) = setting {
        parameters = parameters::apply(
            &parameters,
            &parameters::entries(&parameters),
            &setting.parameters,
        );
        parameters.start = match setting.option(START) {
            1 => Start::Touching,
            2 => Start::Equilibrium,
            _ => Start::Rest,
        };
        start = entries::neighbours(&setting.inputs);
        coil = entries::coil(
            setting.option(COIL_MODE),
            setting.inputs.get(PLACES..).unwrap_or(&[]),
        );
        source = match coil {
            CoilInput::Internal => None,
            CoilInput::Stiffness(_) => Some((PLACES, CoilSource::Stiffness)),
            CoilInput::Force(_) => Some((PLACES + 1, CoilSource::Force)),
        };
    }
    let wedge = made(&parameters, &start, coil)?;
    let entries = entries::entries(case, &wedge);
    let outputs = Outputs::new(&wedge.parameters);
    let mut ports = ports(&entries);
    ports.coils.extend(source.map(|(input, source)| CoilPort {
        coil: COIL,
        input,
        source,
    }));
    ports.columns = entries::column_numbers(&outputs);
    ports.columns.push(outputs.columns().len());
    let system = wedge.system.clone();
    let start_energy = system.clone().observe(0.0, &wedge.initial_state).energies.total();
    // Columns of contact states are no variables: these have their own.
    let contact_states = vec![0; entries.modes.len()];
    let options = study::stepping::options(&case.simulation);
    Ok(Plant {
        table: Some(Box::new(move |seen, _, row| {
            let ledger = outputs.values(&system, seen, &contact_states, start_energy, row);
            row.push(ledger.entries().relative_residual());
        })),
        initial: Some(wedge.initial_state),
        ..Plant::new(wedge.system, entries, ports, options)
    })
}

/// Returns a wedge whose neighbours inputs move, at its start.
fn made(parameters: &Parameters, start: &Neighbours, coil: CoilInput) -> Result<Wedge, Error> {
    let mut own = parameters.with_inputs(start);
    own.coil.law = coil.law(parameters);
    Wedge::new(own).map_err(Error::of)
}

/// For each neighbour six positions and their rates are inputs, force and moment outputs.
fn ports(entries: &Entries) -> Ports {
    let bodies = [BOLSTER, SIDE_FRAME];
    let inputs = bodies
        .into_iter()
        .flat_map(|body| (0..6).map(move |coordinate| (body, coordinate)));
    let positions = (0..)
        .zip(&entries.inputs)
        .filter_map(|(place, entry)| Some((place, entry.rate?)));
    let motions = inputs.zip(positions);
    let loads = bodies
        .into_iter()
        .flat_map(|body| (0..6).map(move |k| Reading::Load(body, k)));
    let faces = [COLUMN, SLOPE];
    let others = [Reading::CoilCompression(COIL), Reading::CoilForce(COIL)];
    let others = others.into_iter().chain(faces.map(Reading::NormalForce));
    let place = |name: &str| entries.parameters.iter().position(|entry| entry.name == name);
    let frictions = [("column_friction", COLUMN), ("slope_friction", SLOPE)];
    Ports {
        motions: motions
            .map(|((body, coordinate), (position, rate))| MotionPort {
                body,
                coordinate,
                position,
                rate,
            })
            .collect(),
        frictions: frictions
            .into_iter()
            .filter_map(|(name, face)| {
                Some(FrictionPort {
                    parameter: place(name)?,
                    face,
                })
            })
            .collect(),
        outputs: loads
            .chain(others)
            .chain(faces.map(Reading::FrictionLoss))
            .collect(),
        ..Ports::default()
    }
}
