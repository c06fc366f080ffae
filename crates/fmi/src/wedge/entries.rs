//! The quantities of a wedge.

use mechanics::body::COORDINATES;
use mechanics::system::{EnergyTermKind, System, scales};
use quantity::Kind;
use study::case::Case;
use wedge::inputs::Neighbours;
use wedge::outputs::{CORNERS, FACES, Outputs, PointNames};
use wedge::parameters::Start as StartOfRun;
use wedge::{WEDGE, Wedge};

use super::parameters;
use crate::element::{Entries, QuantityEntry, rate_of, relative_residual};
use crate::unit::Unit;

/// Neighbours, in the order of the inputs.
pub(crate) const NEIGHBOURS: [&str; 2] = ["bolster", "side_frame"];
/// Inputs of positions and rates: for each neighbour six positions, then six rates.
pub(crate) const PLACES: usize = 24;
/// The input with the coil's stiffness.
pub(crate) const COIL_STIFFNESS: usize = PLACES;
/// The input with the coil's force.
pub(crate) const COIL_FORCE: usize = PLACES + 1;
/// Options, in their order.
pub(crate) const OPTIONS: [&str; 4] = ["coil_mode", "start", "derive_rates", "inputs_at_end"];

fn unit(kind: Kind) -> Option<Unit> {
    Some(Unit::Of(kind))
}

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
    let (system, outputs) = (&wedge.system, Outputs::new(&wedge.parameters));
    let points = PointNames::new(&case.parameters);
    let states = states(system, &points);
    Entries {
        parameters: parameters::entries(&case.parameters),
        options: options(case),
        inputs: inputs(&Neighbours::of(&case.parameters, 0.0)),
        outputs: self::outputs(),
        outputs_of_states: false,
        accumulators: system.layout().quadratures,
        kinematic: (0..system.layout().speeds)
            .map(|q| (q, q + system.layout().speeds))
            .collect(),
        states,
        columns: column_numbers(&outputs)
            .into_iter()
            .map(|number| {
                let column = &outputs.columns()[number];
                let about = match &*column.reference {
                    "" => String::new(),
                    reference => format!(" ({reference})"),
                };
                QuantityEntry::real(
                    &column.name,
                    unit(column.kind),
                    None,
                    format!("{}{about}", column.text),
                )
            })
            .chain([relative_residual()])
            .collect(),
        modes: of_points(&points, "_state", |point| {
            QuantityEntry::integer(
                "",
                None,
                [0, 2],
                format!("contact state of the {point}: 0 open, 1 stick, 2 slip"),
            )
        }),
        indicators: of_points(&points, "_event_indicator", |point| {
            QuantityEntry::real(
                "",
                None,
                None,
                format!("event indicator: positive while the contact state of the {point} lasts"),
            )
        }),
    }
}

fn of_points(points: &PointNames, ending: &str, entry: impl Fn(&str) -> QuantityEntry) -> Vec<QuantityEntry> {
    let mut entries = Vec::new();
    for (number, face) in FACES.into_iter().enumerate() {
        for (i, point) in points.of(number).iter().enumerate() {
            let kind = if i < CORNERS.len() { " corner" } else { "" };
            let mut entry = entry(&format!("{face}'s {}{kind}", point.replace('_', " ")));
            entry.name = format!("{face}_{point}{ending}");
            entries.push(entry);
        }
    }
    entries
}

/// Options of a wedge.
pub(crate) fn options(case: &Case) -> Vec<QuantityEntry> {
    let start = match case.parameters.start {
        StartOfRun::Rest => 0,
        StartOfRun::Touching => 1,
        StartOfRun::Equilibrium => 2,
    };
    vec![
        QuantityEntry::integer(
            OPTIONS[0],
            Some(0),
            [0, 2],
            "where the coil's spring force comes from: 0 the coil of the case, 1 coil_stiffness_input times \
             coil_compression, 2 coil_force_input",
        ),
        QuantityEntry::integer(
            OPTIONS[1],
            Some(start),
            [0, 2],
            "the wedge at the start: 0 nominal position, 1 the same with column and pocket moved apart \
             until nothing penetrates, 2 frictionless static equilibrium",
        ),
        QuantityEntry::boolean(
            OPTIONS[2],
            false,
            "co-simulation: rates of bolster and side frame are found from their positions, the inputs \
             *_rate are not read",
        ),
        QuantityEntry::boolean(
            OPTIONS[3],
            false,
            "co-simulation: inputs are those of the end of a communication step (else of its beginning, and \
             continued)",
        ),
    ]
}

fn inputs(start: &Neighbours) -> Vec<QuantityEntry> {
    let mut inputs = Vec::new();
    for (name, place) in NEIGHBOURS.into_iter().zip([&start.bolster, &start.side_frame]) {
        let first = inputs.len();
        let words = name.replace('_', " ");
        for (k, axis) in COORDINATES.into_iter().enumerate() {
            let (kind, text) = if k < 3 {
                let axis = ["longitudinal", "lateral", "vertical"][k];
                (
                    Kind::Length,
                    format!("{axis} displacement of the {words}'s turning center from its nominal position"),
                )
            } else {
                (Kind::Angle, format!("{axis} angle of the {words}"))
            };
            let mut entry = QuantityEntry::real(
                format!("{name}_{axis}"),
                unit(kind),
                Some(place.position[k]),
                text,
            );
            entry.rate = Some(first + 6 + k);
            inputs.push(entry);
        }
        for (k, axis) in COORDINATES.into_iter().enumerate() {
            let kind = if k < 3 { Kind::Speed } else { Kind::AngularSpeed };
            inputs.push(QuantityEntry::real(
                format!("{name}_{axis}_rate"),
                unit(kind),
                // At rest: held positions do not move.
                Some(0.0),
                rate_of(&format!("{name}_{axis}")),
            ));
        }
    }
    inputs.push(QuantityEntry::real(
        "coil_stiffness_input",
        unit(Kind::Stiffness),
        Some(0.0),
        "stiffness of the coil, read if coil_mode = 1",
    ));
    inputs.push(QuantityEntry::real(
        "coil_force_input",
        unit(Kind::Force),
        Some(0.0),
        "spring force of the coil, positive pushes, read if coil_mode = 2",
    ));
    inputs
}

fn outputs() -> Vec<QuantityEntry> {
    let mut outputs = Vec::new();
    for name in NEIGHBOURS {
        let words = name.replace('_', " ");
        for axis in ["x", "y", "z"] {
            outputs.push(QuantityEntry::real(
                format!("force_on_{name}_{axis}"),
                unit(Kind::Force),
                None,
                format!("force of wedge and coil on the {words}, {axis} axis of the fixed frame"),
            ));
        }
        for (moment, axis) in [("roll", "x"), ("pitch", "y"), ("yaw", "z")] {
            outputs.push(QuantityEntry::real(
                format!("moment_on_{name}_{moment}"),
                unit(Kind::Moment),
                None,
                format!(
                    "moment of wedge and coil on the {words} about its turning center, {axis} axis of the \
                     fixed frame"
                ),
            ));
        }
    }
    outputs.push(QuantityEntry::real(
        "coil_compression",
        unit(Kind::Length),
        None,
        "compression of the coil: free length less length",
    ));
    outputs.push(QuantityEntry::real(
        "coil_force",
        unit(Kind::Force),
        None,
        "spring force of the coil, positive pushes",
    ));
    for face in FACES {
        outputs.push(QuantityEntry::real(
            format!("{face}_normal_force"),
            unit(Kind::Force),
            None,
            format!("sum of the {face}'s normal forces"),
        ));
    }
    for face in FACES {
        outputs.push(QuantityEntry::real(
            format!("{face}_friction_loss_power"),
            unit(Kind::Power),
            None,
            format!("power lost in friction at the {face}, never negative"),
        ));
    }
    outputs
}

/// Names, units and nominal values of the states.
fn states(system: &System, points: &PointNames) -> Vec<QuantityEntry> {
    let layout = system.layout();
    let mut states = Vec::with_capacity(layout.len());
    let free: Vec<usize> = (0..6)
        .filter(|k| system.position_of(WEDGE, *k).is_some())
        .collect();
    let mut add = |name: String, kind: Kind, nominal: f64, text: String| {
        let mut entry = QuantityEntry::real(name, unit(kind), None, text);
        entry.nominal = Some(nominal);
        states.push(entry);
    };
    for &k in &free {
        let name = format!("wedge_{}", COORDINATES[k]);
        if k < 3 {
            let text = "displacement of the wedge frame's origin from its nominal position".to_owned();
            add(name, Kind::Length, scales::DISPLACEMENT, text);
        } else {
            add(name, Kind::Angle, scales::ANGLE, "angle of the wedge".to_owned());
        }
    }
    for &k in &free {
        let name = format!("wedge_{}_rate", COORDINATES[k]);
        let text = format!("rate of wedge_{}", COORDINATES[k]);
        if k < 3 {
            add(name, Kind::Speed, scales::VELOCITY, text);
        } else {
            add(name, Kind::AngularSpeed, scales::ANGULAR_VELOCITY, text);
        }
    }
    for (number, (face, mounted)) in FACES.iter().zip(system.faces()).enumerate() {
        for internal in 0..mounted.internal_count {
            let point = &points.of(number)[internal / 2];
            add(
                format!("{face}_{point}_bristle_{}", internal % 2 + 1),
                Kind::Length,
                scales::DEFLECTION,
                format!(
                    "deflection of the friction bristle of the {face}'s corner, direction {}",
                    internal % 2 + 1
                ),
            );
        }
    }
    for energy_term in system.energy_terms() {
        let side = if energy_term.element == FACES[0] {
            "side_frame"
        } else {
            "bolster"
        };
        let (name, text, nominal) = match energy_term.kind {
            EnergyTermKind::MotionWork => (
                "motion_work".to_owned(),
                "work that bolster and side frame have done on the wedge".to_owned(),
                scales::ENERGY,
            ),
            EnergyTermKind::FrictionLoss => (
                format!("{side}_friction_loss"),
                format!("energy lost in friction at the {}", energy_term.element),
                scales::ENERGY,
            ),
            EnergyTermKind::ContactDampingLoss => (
                format!("{}_contact_damping_loss", energy_term.element),
                format!("energy lost in contact damping at the {}", energy_term.element),
                scales::CONTACT_DAMPING_LOSS,
            ),
            EnergyTermKind::CoilDampingLoss => (
                "coil_damping_loss".to_owned(),
                "energy lost in the coil's damping".to_owned(),
                scales::ENERGY,
            ),
            EnergyTermKind::CoilGuideWork => (
                "coil_guide_work".to_owned(),
                "work of the couple that guides the coil's force".to_owned(),
                scales::ENERGY,
            ),
            other => (other.name().to_owned(), "energy lost".to_owned(), scales::ENERGY),
        };
        add(name, Kind::Energy, nominal, text);
    }
    states
}
