//! The quantities of the truck.

use mechanics::body::COORDINATES;
use mechanics::system::{EnergyTermKind, System};

use super::WEDGES;
use crate::element::{Entries, QuantityEntry};
use crate::system::{accumulated, deflection, kinds, ledger, load, motions};
use crate::wedge::entries::NEIGHBOURS;

fn parameters() -> Vec<QuantityEntry> {
    let positions = COORDINATES.iter().enumerate().map(|(k, name)| {
        let text =
            format!("{name} of the loaded bolster's center of gravity at the start, from the drawn position");
        QuantityEntry::of(kinds(k).0, format!("body_{name}_start"), text).starting(0.0)
    });
    let rates = COORDINATES.iter().enumerate().map(|(k, name)| {
        let text = format!("rate of body_{name} at the start");
        QuantityEntry::of(kinds(k).1, format!("body_{name}_rate_start"), text).starting(0.0)
    });
    positions.chain(rates).collect()
}

fn inputs() -> Vec<QuantityEntry> {
    let mut inputs = Vec::new();
    for wedge in WEDGES {
        for on in NEIGHBOURS {
            let text = format!(
                "the {} from the wedge at the {}, in that wedge's axes, about the point whose \
                 displacements are given",
                on.replace('_', " "),
                wedge.replace('_', " ")
            );
            inputs.extend((0..6).map(|k| load(&format!("{wedge}_"), on, k, &text)));
        }
    }
    let text = "the loaded bolster from outside, at its center of gravity";
    inputs.extend((0..6).map(|k| load("", "body", k, text)));
    inputs
}

fn outputs() -> Vec<QuantityEntry> {
    let mut outputs = Vec::new();
    for wedge in WEDGES {
        for name in NEIGHBOURS {
            let words = format!(
                "{} at the wedge {}",
                name.replace('_', " "),
                wedge.replace('_', " ")
            );
            let own = format!("{wedge}_{name}");
            let axes = || COORDINATES.iter().enumerate();
            outputs.extend(axes().map(|(k, axis)| {
                let text = format!("{axis} of the {words}, in that wedge's axes");
                QuantityEntry::of(kinds(k).0, format!("{own}_{axis}"), text)
            }));
            outputs.extend(axes().map(|(k, axis)| {
                let text = format!("rate of {own}_{axis}");
                QuantityEntry::of(kinds(k).1, format!("{own}_{axis}_rate"), text)
            }));
        }
    }
    outputs
}

fn states(system: &System) -> Vec<QuantityEntry> {
    let names = ["ground", "body", "left_side_frame", "right_side_frame"];
    let mut states = motions(system, |body| {
        names.get(body).copied().unwrap_or("body").to_owned()
    });
    for number in 0..system.layout().internals {
        let name = format!("bearing_friction_deflection_{}", number + 1);
        states.push(deflection(
            name,
            "deflection of the friction of a bearing adapter",
        ));
    }
    for energy_term in system.energy_terms() {
        let text = match energy_term.kind {
            EnergyTermKind::MotionWork => "work of prescribed motions: there are none",
            _ => "energy lost",
        };
        states.push(accumulated(energy_term.kind.name(), text));
    }
    states.push(accumulated(
        "load_work",
        "work of all loads from outside and from the wedges on the truck",
    ));
    states
}

/// Returns all quantities.
pub(super) fn entries(system: &System) -> Entries {
    let layout = system.layout();
    Entries {
        parameters: parameters(),
        inputs: inputs(),
        outputs: outputs(),
        outputs_of_states: true,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states: states(system),
        columns: ledger(
            "energy that came from nowhere: what is stored and lost since the start less the work of the \
             loads",
        ),
        ..Entries::default()
    }
}
