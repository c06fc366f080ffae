//! The quantities of a half-truck, and its ports.

use std::collections::BTreeSet;

use mechanics::body::COORDINATES;
use mechanics::connection::Law;
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, System};
use study::half_truck::HalfTruckCase;

use super::start_option;
use crate::element::{Entries, Entry};
use crate::system::{
    Direction, LoadPort, MotionPort, Ports, Reading, accumulated, deflection, kinds, ledger, load, motions,
    unit,
};

/// The place of the option that says who moves the input bodies.
pub(super) const MOTION: usize = 0;
/// The place of the option that says how the run starts.
pub(super) const START: usize = 1;

/// Returns all quantities of a half-truck and its ports; `table` are the columns of its results.
pub(super) fn all(case: &HalfTruckCase, system: &System, table: &[Column]) -> (Entries, Ports) {
    let layout = system.layout();
    let mut ports = Ports::default();
    let mut inputs = Vec::new();
    motion_inputs(case, &mut inputs, &mut ports.motions);
    load_inputs(case, &mut inputs, &mut ports.loads);
    let states = states(case, system);
    let mut known: BTreeSet<String> = states.iter().map(|state| state.name.clone()).collect();
    let (modes, indicators) = contacts(case, system);
    known.extend(modes.iter().map(|mode| mode.name.clone()));
    known.extend(inputs.iter().map(|input| input.name.clone()));
    // The residual is another one here: it counts the work of the loads too.
    known.extend(["time", "ledger_residual"].map(str::to_owned));
    let (mut outputs, mut columns) = (Vec::new(), Vec::new());
    for (number, column) in table.iter().enumerate() {
        if !known.insert(column.name.clone()) {
            continue;
        }
        let entry = Entry::real(
            &column.name,
            unit(column.kind),
            None,
            input::shortened(&column.text),
        );
        if column.name.starts_with("wedge_") {
            outputs.push(entry);
            ports.outputs.push(Reading::Table(number));
        } else {
            columns.push(entry);
            ports.columns.push(number);
        }
    }
    columns.extend(ledger(
        "work of the input bodies and of the loads less stored energy and losses",
    ));
    let entries = Entries {
        options: options(case),
        inputs,
        outputs,
        outputs_of_states: outputs_of_states(case),
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

fn options(case: &HalfTruckCase) -> Vec<Entry> {
    vec![
        Entry::integer(
            "motion",
            Some(0),
            [0, 1],
            "who moves the input bodies: 0 the inputs body_*, 1 the files",
        ),
        Entry::integer(
            "start",
            Some(start_option(case.start)),
            [0, 1],
            "the half-truck at the start: 0 at rest in the drawn layout, 1 at rest in static \
             equilibrium without friction",
        ),
        Entry::boolean(
            "derive_rates",
            false,
            "co-simulation: rates of the input bodies are found from their positions, the inputs *_rate are \
             not read",
        ),
        Entry::boolean(
            "inputs_at_end",
            false,
            "co-simulation: inputs are those of the end of a communication step (else of its beginning, and \
             continued)",
        ),
    ]
}

/// Value and rate of every prescribed coordinate that the files move; they start where the files say.
fn motion_inputs(case: &HalfTruckCase, inputs: &mut Vec<Entry>, ports: &mut Vec<MotionPort>) {
    let truck = &case.truck;
    for (body, own) in truck.model.bodies.iter().enumerate() {
        for (coordinate, motion) in own.frame.motions.iter().enumerate() {
            if !own.is_prescribed() || motion.is_constant() {
                continue;
            }
            let [value, rate, _] = motion.evaluate(0.0, 0.0);
            let name = format!("body_{}_{}", truck.bodies[body], COORDINATES[coordinate]);
            let (kind, rate_kind) = kinds(coordinate);
            let position = inputs.len();
            let text = "displacement of the input body from the drawn position, or angle; read if motion = 0";
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

/// Force and moment along every free coordinate.
fn load_inputs(case: &HalfTruckCase, inputs: &mut Vec<Entry>, ports: &mut Vec<LoadPort>) {
    let truck = &case.truck;
    for (body, own) in truck.model.bodies.iter().enumerate() {
        let number = truck.bodies[body];
        let text = format!("body {number} from outside, at its center of gravity");
        for coordinate in (0..6).filter(|k| own.free[*k]) {
            ports.push(LoadPort {
                input: inputs.len(),
                direction: Direction::coordinate(body, coordinate),
            });
            inputs.push(load("", &format!("body_{number}"), coordinate, &text));
        }
    }
}

fn states(case: &HalfTruckCase, system: &System) -> Vec<Entry> {
    let truck = &case.truck;
    let mut states = motions(system, |body| format!("body_{}", truck.bodies[body]));
    for state in &mut states {
        state.output = true;
    }
    let layout = system.layout();
    for internal in 0..layout.internals {
        let state = 2 * layout.speeds + internal;
        let place = (0..truck.connections.len()).find_map(|place| {
            let first = system.deflection_of(place)?;
            (first..first + 2)
                .contains(&state)
                .then_some((place, state - first))
        });
        let (name, direction) = match place {
            Some((place, second)) => (connection(case, place), second + 1),
            None => (format!("state_{state}"), 1),
        };
        states.push(deflection(
            format!("{name}_deflection_{direction}"),
            "deflection of a force accumulator",
        ));
    }
    for energy_term in system.energy_terms() {
        let text = match energy_term.kind {
            EnergyTermKind::MotionWork => "work of the input bodies since the start",
            _ => "work or loss since the start",
        };
        states.push(accumulated(energy_term.kind.name(), text));
    }
    states.push(accumulated(
        "load_work",
        "work of all loads from outside since the start",
    ));
    states
}

/// Returns the name of a connection: wedges are called so.
fn connection(case: &HalfTruckCase, place: usize) -> String {
    let kind = match case.truck.model.connections[place].law {
        Law::Wedge(_) => "wedge",
        _ => "connection",
    };
    format!("{kind}_{}", case.truck.connections[place])
}

/// Contact states and event indicators of all connections with friction.
fn contacts(case: &HalfTruckCase, system: &System) -> (Vec<Entry>, Vec<Entry>) {
    let names = system.frictional_connections().iter();
    names
        .map(|place| {
            let name = connection(case, *place);
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

/// Returns whether no wedge acts on a body that inputs move.
fn outputs_of_states(case: &HalfTruckCase) -> bool {
    let truck = &case.truck;
    let is_driven = |body: usize| truck.model.bodies[body].is_moving_prescribed();
    truck.wedges().all(|place| {
        let own = &truck.model.connections[place];
        !is_driven(own.a) && !is_driven(own.b)
    })
}
