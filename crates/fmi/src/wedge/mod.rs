//! The wedge with mass, as data of [`crate::system`].
//!
//! Inputs move bolster and side frame, and are the coil's force if an option says so; coefficients of friction
//! may change on the way. Outputs are what the elements do to both neighbours.

pub(crate) mod entries;
pub(crate) mod parameters;

use mechanics::body::COORDINATES;
use study::case::Case;
use wedge::inputs::{COIL, CoilInput, NeighbourState, Neighbours};
use wedge::outputs::Outputs;
use wedge::parameters::Start;
use wedge::{BOLSTER, COLUMN, Parameters, SIDE_FRAME, SLOPE, Wedge};

use crate::Error;
use crate::element::{Entries, Setting};
use crate::system::{
    CoilPort, CoilSource, FrictionPort, MotionPort, Plant, Ports, Reading, StartState, SystemElement,
};
use entries::{COIL_FORCE, COIL_STIFFNESS};

/// Returns all quantities of the wedge of a case.
///
/// # Errors
/// The case makes no wedge.
pub fn entries(case: &Case) -> Result<Entries, Error> {
    let start = Neighbours::of(&case.parameters, 0.0);
    Ok(entries::entries(
        case,
        &made(&case.parameters, &start, CoilInput::Internal)?,
    ))
}

/// Returns the wedge of a case under these settings, at its start.
///
/// # Errors
/// Values outside their reach, or with which the number of states would be another one; or the integrator
/// refuses the start.
pub fn element(case: &Case, entries: &Entries, setting: &Setting) -> Result<SystemElement, Error> {
    let mut parameters = parameters::apply(&case.parameters, &setting.parameters);
    let option = |index: usize| setting.options.get(index).copied().unwrap_or(0);
    parameters.start = match option(1) {
        1 => Start::Touching,
        2 => Start::Equilibrium,
        _ => Start::Rest,
    };
    let input = |index: usize| setting.inputs.get(index).copied().unwrap_or(0.0);
    let neighbour = |first: usize| NeighbourState {
        position: std::array::from_fn(|k| input(first + k)),
        rate: std::array::from_fn(|k| input(first + COORDINATES.len() + k)),
    };
    let start = Neighbours {
        bolster: neighbour(0),
        side_frame: neighbour(2 * COORDINATES.len()),
    };
    let (coil, source) = match option(0) {
        1 => (
            CoilInput::Stiffness(input(COIL_STIFFNESS)),
            Some((COIL_STIFFNESS, CoilSource::Stiffness)),
        ),
        2 => (
            CoilInput::Force(input(COIL_FORCE)),
            Some((COIL_FORCE, CoilSource::Force)),
        ),
        _ => (CoilInput::Internal, None),
    };
    let wedge = made(&parameters, &start, coil)?;
    let (found, own) = (wedge.initial_state.len(), entries.states.len());
    if found != own {
        return Err(Error::new(format!(
            "with these parameters the wedge has {found} states, but the FMU was made with {own}: a damping \
             that was zero stays zero, and one that was not stays so; export another FMU"
        )));
    }
    let coils = source.map(|(input, source)| CoilPort {
        coil: COIL,
        input,
        source,
    });
    let ports = Ports {
        coils: coils.into_iter().collect(),
        ..ports(entries)
    };
    SystemElement::new(
        plant(case, entries, wedge, ports),
        setting,
        StartState::Initial,
        true,
    )
}

/// Returns a wedge whose neighbours inputs move, at its start.
fn made(parameters: &Parameters, start: &Neighbours, coil: CoilInput) -> Result<Wedge, Error> {
    let mut own = parameters.with_inputs(start);
    own.coil.law = coil.law(parameters);
    Wedge::new(own).map_err(|error| Error::new(error.to_string()))
}

/// Returns the plant of a wedge; `ports` read no table yet.
fn plant(case: &Case, entries: &Entries, wedge: Wedge, mut ports: Ports) -> Plant {
    let (outputs, system) = (Outputs::new(&wedge.parameters), wedge.system.clone());
    ports.columns = entries::column_numbers(&outputs);
    ports.columns.push(outputs.columns().len());
    let start_energy = system.clone().observe(0.0, &wedge.initial_state).energies.total();
    // Columns of contact states are no variables: these have their own.
    let contact_states = vec![0; system.faces().iter().map(|face| face.element.points.len()).sum()];
    let options = study::stepping::options(&case.simulation);
    Plant {
        table: Some(Box::new(move |seen, _, row| {
            let ledger = outputs.values(&system, seen, &contact_states, start_energy, row);
            row.push(ledger.entries().relative_residual());
        })),
        initial: Some(wedge.initial_state),
        ..Plant::new(wedge.system, entries.clone(), ports, options)
    }
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
