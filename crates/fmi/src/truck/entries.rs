//! The quantities of the truck.

use mechanics::body::COORDINATES;
use mechanics::system::EnergyTermKind;
use mechanics::system::scales;
use quantity::Kind;

use super::body::{Loaded, WEDGES};
use crate::element::{Entries, Entry};
use crate::unit::Unit;
use crate::wedge::entries::{NEIGHBOURS, relative_residual};

/// Inputs of one wedge: force and moment on both neighbours.
pub(super) const LOADS: usize = 12;
/// Outputs of one wedge: positions and rates of both neighbours.
pub(super) const MOTIONS: usize = 24;
/// Parameters: positions of the body at the start, then its rates.
pub(super) const START: usize = 12;

fn unit(kind: Kind) -> Option<Unit> {
    Some(Unit::Of(kind))
}

/// Kinds of a position and of its rate.
fn kinds(coordinate: usize) -> (Kind, Kind) {
    if coordinate < 3 {
        (Kind::Length, Kind::Speed)
    } else {
        (Kind::Angle, Kind::AngularSpeed)
    }
}

fn parameters() -> Vec<Entry> {
    let positions = COORDINATES.iter().enumerate().map(|(k, name)| {
        Entry::real(
            format!("body_{name}_start"),
            unit(kinds(k).0),
            Some(0.0),
            format!("{name} of the loaded bolster's center of gravity at the start, from the drawn position"),
        )
    });
    let rates = COORDINATES.iter().enumerate().map(|(k, name)| {
        Entry::real(
            format!("body_{name}_rate_start"),
            unit(kinds(k).1),
            Some(0.0),
            format!("rate of body_{name} at the start"),
        )
    });
    positions.chain(rates).collect()
}

/// Force and moment under these names.
fn load(prefix: &str, on: &str, text: &str) -> Vec<Entry> {
    let forces = ["x", "y", "z"].map(|axis| {
        Entry::real(
            format!("{prefix}force_on_{on}_{axis}"),
            unit(Kind::Force),
            Some(0.0),
            format!("force on {text}, {axis} axis"),
        )
    });
    let moments = [("roll", "x"), ("pitch", "y"), ("yaw", "z")].map(|(moment, axis)| {
        Entry::real(
            format!("{prefix}moment_on_{on}_{moment}"),
            unit(Kind::Moment),
            Some(0.0),
            format!("moment on {text}, {axis} axis"),
        )
    });
    forces.into_iter().chain(moments).collect()
}

fn inputs() -> Vec<Entry> {
    let mut inputs = Vec::new();
    for wedge in WEDGES {
        for on in NEIGHBOURS {
            let text = format!(
                "the {} from the wedge at the {}, in that wedge's axes, about the point whose displacements are given",
                on.replace('_', " "),
                wedge.replace('_', " ")
            );
            inputs.extend(load(&format!("{wedge}_"), on, &text));
        }
    }
    inputs.extend(load(
        "",
        "body",
        "the loaded bolster from outside, at its center of gravity",
    ));
    inputs
}

fn outputs() -> Vec<Entry> {
    let mut outputs = Vec::new();
    for wedge in WEDGES {
        for name in NEIGHBOURS {
            let words = format!(
                "{} at the wedge {}",
                name.replace('_', " "),
                wedge.replace('_', " ")
            );
            for (k, axis) in COORDINATES.iter().enumerate() {
                outputs.push(Entry::real(
                    format!("{wedge}_{name}_{axis}"),
                    unit(kinds(k).0),
                    None,
                    format!("{axis} of the {words}, in that wedge's axes"),
                ));
            }
            for (k, axis) in COORDINATES.iter().enumerate() {
                outputs.push(Entry::real(
                    format!("{wedge}_{name}_{axis}_rate"),
                    unit(kinds(k).1),
                    None,
                    format!("rate of {wedge}_{name}_{axis}"),
                ));
            }
        }
    }
    outputs
}

fn states(truck: &Loaded) -> Vec<Entry> {
    let names = ["ground", "body", "left_side_frame", "right_side_frame"];
    let mut states = Vec::new();
    for rate in [false, true] {
        for (body, k) in truck.coordinates() {
            let name = format!("{}_{}", names.get(body).unwrap_or(&"body"), COORDINATES[k]);
            let (kind, nominal, name) = match (rate, k < 3) {
                (false, true) => (kinds(k).0, scales::DISPLACEMENT, name),
                (false, false) => (kinds(k).0, scales::ANGLE, name),
                (true, true) => (kinds(k).1, scales::VELOCITY, format!("{name}_rate")),
                (true, false) => (kinds(k).1, scales::ANGULAR_VELOCITY, format!("{name}_rate")),
            };
            let text = if rate {
                "rate of the position of the same name".to_owned()
            } else {
                "displacement of the center of gravity, or angle, from the drawn position, in the truck's axes".to_owned()
            };
            let mut entry = Entry::real(name, unit(kind), None, text);
            entry.nominal = Some(nominal);
            states.push(entry);
        }
    }
    for number in 0..truck.system.layout().internals {
        let mut entry = Entry::real(
            format!("bearing_friction_deflection_{}", number + 1),
            unit(Kind::Length),
            None,
            "deflection of the friction of a bearing adapter",
        );
        entry.nominal = Some(scales::DEFLECTION);
        states.push(entry);
    }
    let mut add = |name: &str, text: &str| {
        let mut entry = Entry::real(name, unit(Kind::Energy), None, text);
        entry.nominal = Some(scales::ENERGY);
        states.push(entry);
    };
    for energy_term in truck.system.energy_terms() {
        let text = match energy_term.kind {
            EnergyTermKind::MotionWork => "work of prescribed motions: there are none",
            _ => "energy lost",
        };
        add(energy_term.kind.name(), text);
    }
    add(
        "load_work",
        "work of all loads from outside and from the wedges on the truck",
    );
    states
}

fn columns() -> Vec<Entry> {
    [
        ("stored_energy_change", "kinetic, elastic and gravity energy since the start"),
        (
            "ledger_residual",
            "energy that came from nowhere: what is stored and lost since the start less the work of the loads",
        ),
    ]
    .map(|(name, text)| Entry::real(name, unit(Kind::Energy), None, text))
    .into_iter()
    .chain([relative_residual()])
    .collect()
}

/// All quantities.
pub(super) fn entries(truck: &Loaded) -> Entries {
    let layout = truck.system.layout();
    Entries {
        parameters: parameters(),
        inputs: inputs(),
        outputs: outputs(),
        outputs_of_states: true,
        accumulators: layout.quadratures + 1,
        kinematic: (0..layout.speeds).map(|q| (q, q + layout.speeds)).collect(),
        states: states(truck),
        columns: columns(),
        ..Entries::default()
    }
}
