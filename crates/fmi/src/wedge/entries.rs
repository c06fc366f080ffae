//! The quantities of a wedge.

use mechanics::body::COORDINATES;
use mechanics::system::{EnergyTermKind, System, scales};
use quantity::Kind;
use study::case::Case;
use wedge::inputs::{CoilInput, NeighbourState, Neighbours};
use wedge::outputs::{CORNERS, FACES, Outputs, PointNames};
use wedge::parameters::Start as StartOfRun;
use wedge::{WEDGE, Wedge};

use super::parameters;
use crate::element::{Entries, QuantityEntry, rate_input, relative_residual};
use crate::system::{accumulated, contact, deflection, kinds, motion_state, steps};

/// Neighbours, in the order of the inputs.
pub(crate) const NEIGHBOURS: [&str; 2] = ["bolster", "side_frame"];
/// Inputs of positions and rates: for each neighbour six positions, then six rates.
pub(crate) const PLACES: usize = 24;
/// Columns of a run's table that are worth looking at and are no variable yet.
const COLUMNS: [&str; 15] = [
    "longitudinal_wedge_force",
    "vertical_wedge_force",
    "vertical_force_on_side_frame",
    "side_frame_friction_power",
    "bolster_friction_power",
    "side_frame_dissipation",
    "bolster_dissipation",
    "coil_length",
    "kinetic_energy",
    "coil_energy",
    "contact_energy",
    "bristle_energy",
    "gravity_energy",
    "stored_energy_change",
    "ledger_residual",
];

/// Returns whether a column of a run's table becomes a variable.
fn is_column(name: &str) -> bool {
    let corner = ["column_", "slope_"].iter().any(|face| name.starts_with(face));
    COLUMNS.contains(&name) || corner && !name.ends_with("_state")
}

/// Returns the numbers of the columns that become variables.
pub(super) fn column_numbers(outputs: &Outputs) -> Vec<usize> {
    let columns = outputs.columns().iter().enumerate();
    columns
        .filter(|(_, column)| is_column(&column.name))
        .map(|(number, _)| number)
        .collect()
}

/// Returns all quantities of the wedge of a case.
pub(super) fn entries(case: &Case, wedge: &Wedge) -> Entries {
    let (system, table) = (&wedge.system, Outputs::new(&wedge.parameters));
    let points = PointNames::new(&case.parameters);
    let columns = column_numbers(&table).into_iter().map(|number| {
        let column = &table.columns()[number];
        let about = match &*column.reference {
            "" => String::new(),
            reference => format!(" ({reference})"),
        };
        QuantityEntry::of(column.kind, &column.name, format!("{}{about}", column.text))
    });
    let (modes, indicators) = contacts(&points);
    Entries {
        parameters: parameters::entries(&case.parameters),
        options: options(case),
        inputs: inputs(case, &[0, 1, 2, 3, 4, 5], "'s turning center"),
        outputs: outputs(&[0, 1, 2, 3, 4, 5], true),
        outputs_of_states: false,
        accumulators: system.layout().quadratures,
        kinematic: (0..system.layout().speeds)
            .map(|q| (q, q + system.layout().speeds))
            .collect(),
        states: states(system, &points),
        columns: columns.chain([relative_residual()]).collect(),
        modes,
        indicators,
    }
}

/// Returns contact states and event indicators of all points.
fn contacts(points: &PointNames) -> (Vec<QuantityEntry>, Vec<QuantityEntry>) {
    let all = FACES.into_iter().enumerate().flat_map(|(number, face)| {
        let points = points.of(number).iter().enumerate();
        points.map(move |(i, point)| {
            let kind = if i < CORNERS.len() { " corner" } else { "" };
            let words = format!("the {face}'s {}{kind}", point.replace('_', " "));
            contact(&format!("{face}_{point}"), &words)
        })
    });
    all.unzip()
}

/// Options of a wedge.
pub(crate) fn options(case: &Case) -> Vec<QuantityEntry> {
    let start = match case.parameters.start {
        StartOfRun::Rest => 0,
        StartOfRun::Touching => 1,
        StartOfRun::Equilibrium => 2,
    };
    let [derive_rates, inputs_at_end] = steps("bolster and side frame");
    vec![
        QuantityEntry::integer(
            "coil_mode",
            Some(0),
            [0, 2],
            "where the coil's spring force comes from: 0 the coil of the case, 1 coil_stiffness_input times \
             coil_compression, 2 coil_force_input",
        ),
        QuantityEntry::integer(
            "start",
            Some(start),
            [0, 2],
            "the wedge at the start: 0 nominal position, 1 the same with column and pocket moved apart \
             until nothing penetrates, 2 frictionless static equilibrium",
        ),
        derive_rates,
        inputs_at_end,
    ]
}

/// For each neighbour these coordinates of a point (`'s turning center`) where the case has them at the
/// start, then their rates; then stiffness and force of the coil.
pub(crate) fn inputs(case: &Case, coordinates: &[usize], point: &str) -> Vec<QuantityEntry> {
    let start = Neighbours::of(&case.parameters, 0.0);
    let mut inputs = Vec::new();
    for (name, place) in NEIGHBOURS.into_iter().zip([&start.bolster, &start.side_frame]) {
        let (first, words) = (inputs.len(), name.replace('_', " "));
        let named = coordinates.iter().map(|&k| (k, COORDINATES[k], kinds(k)));
        for (number, (k, axis, (kind, _))) in named.clone().enumerate() {
            let text = match ["longitudinal", "lateral", "vertical"].get(k) {
                Some(along) => {
                    format!("{along} displacement of the {words}{point} from its nominal position")
                }
                None => format!("{axis} angle of the {words}"),
            };
            inputs.push(QuantityEntry {
                rate: Some(first + coordinates.len() + number),
                ..QuantityEntry::of(kind, format!("{name}_{axis}"), text).starting(place.position[k])
            });
        }
        inputs.extend(named.map(|(_, axis, (_, kind))| rate_input(kind, &format!("{name}_{axis}"))));
    }
    for (kind, name, text) in [
        (
            Kind::Stiffness,
            "coil_stiffness_input",
            "stiffness of the coil, read if coil_mode = 1",
        ),
        (
            Kind::Force,
            "coil_force_input",
            "spring force of the coil, positive pushes, read if coil_mode = 2",
        ),
    ] {
        inputs.push(QuantityEntry::of(kind, name, text).starting(0.0));
    }
    inputs
}

/// Returns positions and rates of the neighbours from the inputs.
pub(super) fn neighbours(inputs: &[f64]) -> Neighbours {
    let input = |index: usize| inputs.get(index).copied().unwrap_or(0.0);
    let place = |first: usize| NeighbourState {
        position: std::array::from_fn(|k| input(first + k)),
        rate: std::array::from_fn(|k| input(first + 6 + k)),
    };
    Neighbours {
        bolster: place(0),
        side_frame: place(PLACES / 2),
    }
}

/// Returns the source of the coil's force in a mode, from the inputs that are stiffness and force.
pub(crate) fn coil(mode: i32, inputs: &[f64]) -> CoilInput {
    let input = |index: usize| inputs.get(index).copied().unwrap_or(0.0);
    match mode {
        1 => CoilInput::Stiffness(input(0)),
        2 => CoilInput::Force(input(1)),
        _ => CoilInput::Internal,
    }
}

/// For each neighbour force and moment by these coordinates; then compression and force of the coil, normal
/// forces and losses of both faces, which are sums over `corners` or not.
pub(crate) fn outputs(coordinates: &[usize], corners: bool) -> Vec<QuantityEntry> {
    let mut outputs = Vec::new();
    for name in NEIGHBOURS {
        let words = name.replace('_', " ");
        for &k in coordinates {
            let (axis, coordinate) = (["x", "y", "z"][k % 3], COORDINATES[k]);
            let (kind, load, about) = if k < 3 {
                (Kind::Force, "force", "")
            } else {
                (Kind::Moment, "moment", " about its turning center")
            };
            let text =
                format!("{load} of wedge and coil on the {words}{about}, {axis} axis of the fixed frame");
            outputs.push(QuantityEntry::of(
                kind,
                format!("{load}_on_{name}_{coordinate}"),
                text,
            ));
        }
    }
    let compression = "compression of the coil: free length less length";
    outputs.push(QuantityEntry::of(Kind::Length, "coil_compression", compression));
    let force = "spring force of the coil, positive pushes";
    outputs.push(QuantityEntry::of(Kind::Force, "coil_force", force));
    outputs.extend(FACES.map(|face| {
        let text = if corners {
            format!("sum of the {face}'s normal forces")
        } else {
            format!("normal force of the {face}")
        };
        QuantityEntry::of(Kind::Force, format!("{face}_normal_force"), text)
    }));
    outputs.extend(FACES.map(|face| {
        let never = if corners { ", never negative" } else { "" };
        let text = format!("power lost in friction at the {face}{never}");
        QuantityEntry::of(Kind::Power, format!("{face}_friction_loss_power"), text)
    }));
    outputs
}

/// Names, units and nominal values of the states.
fn states(system: &System, points: &PointNames) -> Vec<QuantityEntry> {
    let free = || (0..6).filter(|k| system.position_of(WEDGE, *k).is_some());
    let name = |k: usize| format!("wedge_{}", COORDINATES[k]);
    let positions = free().map(|k| {
        let text = if k < 3 {
            "displacement of the wedge frame's origin from its nominal position"
        } else {
            "angle of the wedge"
        };
        motion_state(&name(k), k, false, text)
    });
    let rates = free().map(|k| motion_state(&name(k), k, true, &format!("rate of {}", name(k))));
    let mut states: Vec<QuantityEntry> = positions.chain(rates).collect();
    for (number, (face, mounted)) in FACES.iter().zip(system.faces()).enumerate() {
        for internal in 0..mounted.internal_count {
            let (point, direction) = (&points.of(number)[internal / 2], internal % 2 + 1);
            let text =
                format!("deflection of the friction bristle of the {face}'s corner, direction {direction}");
            states.push(deflection(format!("{face}_{point}_bristle_{direction}"), &text));
        }
    }
    states.extend(system.energy_terms().iter().map(|term| {
        let (face, name) = (&*term.element, term.kind.name());
        match term.kind {
            EnergyTermKind::MotionWork => motion_work(),
            EnergyTermKind::FrictionLoss => friction_loss(face),
            EnergyTermKind::ContactDampingLoss => {
                let text = format!("energy lost in contact damping at the {face}");
                accumulated(&format!("{face}_contact_damping_loss"), &text)
                    .of_size(scales::CONTACT_DAMPING_LOSS)
            }
            EnergyTermKind::CoilDampingLoss => {
                accumulated("coil_damping_loss", "energy lost in the coil's damping")
            }
            EnergyTermKind::CoilGuideWork => {
                let text = "work of the couple that guides the coil's force";
                accumulated("coil_guide_work", text)
            }
            _ => accumulated(name, "energy lost"),
        }
    }));
    states
}

/// Returns the work of the neighbours.
pub(crate) fn motion_work() -> QuantityEntry {
    accumulated(
        "motion_work",
        "work that bolster and side frame have done on the wedge",
    )
}

/// Returns the loss in friction at a face.
pub(crate) fn friction_loss(face: &str) -> QuantityEntry {
    let side = if face == FACES[0] { "side_frame" } else { "bolster" };
    let text = format!("energy lost in friction at the {face}");
    accumulated(&format!("{side}_friction_loss"), &text)
}
