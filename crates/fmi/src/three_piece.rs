//! A three-piece truck with wedge bodies, as data of [`crate::system`]: a case with `model = "truck"`.
//!
//! Bolster, side frames and wheelsets that are prescribed move as the inputs say, or as the case says. Outputs are
//! the fixed columns of its results: warp angle and moment, loads of nests, forces and places of wedges.

use std::collections::BTreeSet;

use mechanics::body::COORDINATES;
use mechanics::motion::Motion;
use mechanics::system::{EnergyTermKind, System};
use study::truck::TruckCase;
use study::truck::columns::TruckTable;
use wedge::parameters::Start as CaseStart;

use crate::Error;
use crate::element::{Entries, Entry, Setting};
use crate::system::{
    MotionPort, Plant, Ports, Reading, Start, SystemElement, accumulated, deflection, kinds, ledger, motions,
    unit,
};

/// The place of the option that says who moves prescribed bodies.
const MOTION: usize = 0;
/// The place of the option that says how the truck starts.
const START: usize = 1;

/// Returns the truck of a case; its prescribed bodies move as the case says, or are `driven`.
///
/// # Errors
/// The case makes no truck, or it settles first.
pub fn plant(case: &TruckCase, driven: bool) -> Result<Plant, Error> {
    if case.settle > 0.0 {
        return Err(Error::new(
            "`start.settle` is more than 0 s: an FMU starts where its case starts; let the importer settle it",
        ));
    }
    let moved = if driven { drivable(case) } else { case.clone() };
    let mut table = TruckTable::new(&moved).map_err(|error| Error::new(error.to_string()))?;
    let system = table.system().clone();
    let (entries, ports) = all(case, &system, &table);
    let start = system
        .clone()
        .observe(0.0, &system.initial_state())
        .energies
        .total();
    Ok(Plant {
        entries,
        ports,
        table: Some(Box::new(move |seen, row| table.read(seen, start, row))),
        numbers: [Vec::new(), Vec::new()],
        residual_of_stored: false,
        relative_tolerance: case.simulation.relative_tolerance,
        system,
    })
}

/// Returns the truck under these settings, at its start.
///
/// # Errors
/// As [`plant`]; or values that are not finite, no equilibrium, or the integrator refuses the start.
pub fn element(case: &TruckCase, setting: &Setting) -> Result<SystemElement, Error> {
    let option = |place: usize| setting.options.get(place).copied().unwrap_or(0);
    let start = match option(START) {
        0 => Start::Initial,
        _ => Start::Equilibrium,
    };
    let driven = option(MOTION) == 0;
    SystemElement::new(plant(case, driven)?, setting, start, driven)
}

/// Returns the same case with prescribed bodies that can be moved: a system takes what is held for fixed.
fn drivable(case: &TruckCase) -> TruckCase {
    let mut case = case.clone();
    let parameters = &mut case.parameters;
    let side_frames = parameters
        .side_frames
        .iter_mut()
        .map(|side_frame| &mut side_frame.motion);
    let wheelsets = parameters
        .wheelsets
        .iter_mut()
        .flat_map(|wheelsets| &mut wheelsets.motions);
    let bodies = std::iter::once(&mut parameters.bolster.motion)
        .chain(side_frames)
        .chain(wheelsets);
    for motion in bodies.flat_map(|body| &mut body.coordinates) {
        let [value, rate, _] = motion.evaluate(0.0, 0.0);
        *motion = Motion::line(0.0, [value, rate]);
    }
    case
}

fn all(case: &TruckCase, system: &System, table: &TruckTable) -> (Entries, Ports) {
    let layout = system.layout();
    let mut ports = Ports::default();
    let mut inputs = Vec::new();
    motion_inputs(case, system, &mut inputs, &mut ports.motions);
    let states = states(system);
    let (modes, indicators) = contacts(system);
    let mut known: BTreeSet<String> = states.iter().map(|state| state.name.clone()).collect();
    known.extend(modes.iter().map(|mode| mode.name.clone()));
    known.extend(inputs.iter().map(|input| input.name.clone()));
    known.extend(["time", "ledger_residual", "stored_energy_change"].map(str::to_owned));
    let (mut outputs, mut columns) = (Vec::new(), Vec::new());
    for (number, column) in table.columns().iter().enumerate() {
        if !known.insert(column.name.clone()) {
            continue;
        }
        let entry = Entry::real(
            &column.name,
            unit(column.kind),
            None,
            input::shortened(&column.text),
        );
        if number < table.fixed() {
            outputs.push(entry);
            ports.outputs.push(Reading::Table(number));
        } else {
            columns.push(entry);
            ports.columns.push(number);
        }
    }
    columns.extend(ledger(
        "work of the prescribed bodies less stored energy and losses",
    ));
    let entries = Entries {
        options: options(case),
        inputs,
        outputs,
        outputs_of_states: false,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states,
        columns,
        modes,
        indicators,
        ..Entries::default()
    };
    (entries, ports)
}

fn options(case: &TruckCase) -> Vec<Entry> {
    let equilibrium = case.parameters.start == CaseStart::Equilibrium;
    vec![
        Entry::integer(
            "motion",
            Some(0),
            [0, 1],
            "who moves prescribed bodies: 0 the inputs bolster_*, left_side_frame_*, ..., 1 the case",
        ),
        Entry::integer(
            "start",
            Some(i32::from(equilibrium)),
            [0, 1],
            "the truck at the start: 0 at rest in the nominal layout, 1 at rest in static equilibrium without friction",
        ),
        Entry::boolean(
            "derive_rates",
            false,
            "co-simulation: rates of prescribed bodies are found from their positions, the inputs *_rate are not read",
        ),
        Entry::boolean(
            "inputs_at_end",
            false,
            "co-simulation: inputs are those of the end of a communication step (else of its beginning, and continued)",
        ),
    ]
}

/// Value and rate of every coordinate of the prescribed bodies; they start where the case says.
fn motion_inputs(case: &TruckCase, system: &System, inputs: &mut Vec<Entry>, ports: &mut Vec<MotionPort>) {
    for (body, own) in system.bodies().iter().enumerate() {
        // Without adapters nothing stands on the wheelsets.
        let is_used = case.parameters.wheelsets.is_some() || !own.name.ends_with("wheelset");
        if !own.is_prescribed() || !is_used {
            continue;
        }
        for (coordinate, motion) in own.frame.motions.iter().enumerate() {
            let [value, rate, _] = motion.evaluate(0.0, 0.0);
            let name = format!("{}_{}_motion", own.name, COORDINATES[coordinate]);
            let (kind, rate_kind) = kinds(coordinate);
            let position = inputs.len();
            let text =
                "displacement of the prescribed body from its nominal place, or angle; read if motion = 0";
            let mut entry = Entry::real(&name, unit(kind), Some(value), text);
            entry.rate = Some(position + 1);
            inputs.push(entry);
            let text = format!("rate of {name}");
            inputs.push(Entry::real(
                format!("{name}_rate"),
                unit(rate_kind),
                Some(rate),
                text,
            ));
            ports.push(MotionPort {
                body,
                coordinate,
                position,
                rate: position + 1,
            });
        }
    }
}

/// Returns the name of a point of a face.
fn point(system: &System, face: usize, point: usize) -> String {
    format!("{}_point_{}", system.faces()[face].element.name, point + 1)
}

/// Returns face and number of all contact points, in the order of the contact states.
fn points(system: &System) -> Vec<(usize, usize)> {
    let faces = system.faces().iter().enumerate();
    faces
        .flat_map(|(face, own)| (0..own.element.points.len()).map(move |point| (face, point)))
        .collect()
}

fn states(system: &System) -> Vec<Entry> {
    let mut states = motions(system, |body| system.bodies()[body].name.clone());
    for state in &mut states {
        state.output = true;
    }
    let layout = system.layout();
    let mut names = vec![String::new(); layout.internals];
    for (face, own) in system.faces().iter().enumerate() {
        for internal in 0..own.internal_count {
            let name = format!(
                "{}_deflection_{}",
                point(system, face, internal / 2),
                internal % 2 + 1
            );
            if let Some(slot) = names.get_mut(own.first_internal + internal) {
                *slot = name;
            }
        }
    }
    for (number, name) in names.into_iter().enumerate() {
        let name = if name.is_empty() {
            format!("internal_{}", number + 1)
        } else {
            name
        };
        states.push(deflection(name, "deflection of the bristle of a contact point"));
    }
    for term in system.energy_terms() {
        let text = match term.kind {
            EnergyTermKind::MotionWork => "work of the prescribed bodies since the start",
            _ => "loss since the start",
        };
        states.push(accumulated(&term.name(), text));
    }
    states.push(accumulated(
        "load_work",
        "work of loads from outside since the start: there are none",
    ));
    states
}

/// Contact states and event indicators of all contact points.
fn contacts(system: &System) -> (Vec<Entry>, Vec<Entry>) {
    let points = points(system).into_iter();
    points
        .map(|(face, number)| {
            let name = point(system, face, number);
            let words = name.replace('_', " ");
            let state = Entry::integer(
                &format!("{name}_state"),
                None,
                [0, 2],
                format!("contact state of {words}: 0 open, 1 stick, 2 slip"),
            );
            let indicator = Entry::real(
                format!("{name}_event_indicator"),
                None,
                None,
                format!("event indicator: positive while the contact state of {words} lasts"),
            );
            (state, indicator)
        })
        .unzip()
}
