//! The quantities of a half-truck, and its ports.

use mechanics::body::COORDINATES;
use mechanics::connection::Law;
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, System};
use study::half_truck::HalfTruckCase;

use super::start_option;
use crate::element::{Entries, QuantityEntry};
use crate::system::{Inputs, Ports, accumulated, contact, deflection, ledger, motions, options};

/// Returns all quantities of a half-truck and its ports; `table` are the columns of its results.
pub(super) fn all(case: &HalfTruckCase, system: &System, table: &[Column]) -> (Entries, Ports) {
    let mut inputs = Inputs::default();
    let bodies = case.truck.model.bodies.iter().enumerate();
    for (body, own) in bodies.clone().filter(|(_, own)| own.is_prescribed()) {
        // What the files hold stays where it is.
        for coordinate in (0..6).filter(|k| !own.frame.motions[*k].is_constant()) {
            let name = format!("body_{}_{}", case.truck.bodies[body], COORDINATES[coordinate]);
            let text = "displacement of the input body from the drawn position, or angle; read if motion = 0";
            inputs.add_motion((body, own), coordinate, &name, text);
        }
    }
    for (body, own) in bodies {
        let number = case.truck.bodies[body];
        inputs.add_loads((body, own), &format!("body_{number}"), &format!("body {number}"));
    }
    let (modes, indicators) = contacts(case, system);
    let own = Entries {
        options: options(
            "who moves the input bodies: 0 the inputs body_*, 1 the files",
            (
                start_option(case.start),
                "the half-truck at the start: 0 at rest in the drawn layout, 1 at rest in static \
                 equilibrium without friction",
            ),
        ),
        outputs_of_states: outputs_of_states(case),
        states: states(case, system),
        columns: ledger("work of the input bodies and of the loads less stored energy and losses"),
        modes,
        indicators,
        ..Entries::default()
    };
    inputs.finish(system, own, table, |_, column| column.name.starts_with("wedge_"))
}

fn states(case: &HalfTruckCase, system: &System) -> Vec<QuantityEntry> {
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
fn contacts(case: &HalfTruckCase, system: &System) -> (Vec<QuantityEntry>, Vec<QuantityEntry>) {
    let names = system.frictional_connections().iter();
    let names = names.map(|place| connection(case, *place));
    names.map(|name| contact(&name, &name.replace('_', " "))).unzip()
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
