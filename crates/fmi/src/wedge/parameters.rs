//! The parameters of a wedge that an importer may set.

use mechanics::coil::CoilLaw;
use mechanics::friction::FrictionLaw;
use quantity::Kind;
use wedge::Parameters;
use wedge::parameters::FaceFriction;

use crate::element::QuantityEntry;
use crate::unit::Unit;

/// The access to one parameter.
struct Access {
    name: &'static str,
    kind: Kind,
    text: &'static str,
    get: fn(&Parameters) -> Option<f64>,
    set: fn(&mut Parameters, f64),
    tunable: bool,
}

const fn fixed(
    name: &'static str,
    kind: Kind,
    text: &'static str,
    get: fn(&Parameters) -> Option<f64>,
    set: fn(&mut Parameters, f64),
) -> Access {
    Access {
        name,
        kind,
        text,
        get,
        set,
        tunable: false,
    }
}

const ALL: &[Access] = &[
    fixed(
        "wedge_angle",
        Kind::Angle,
        "wedge angle between the vertical and the slope",
        |p| Some(p.wedge.angle),
        |p, v| p.wedge.angle = v,
    ),
    fixed(
        "wedge_height",
        Kind::Length,
        "height of the vertical face",
        |p| Some(p.wedge.height),
        |p, v| p.wedge.height = v,
    ),
    fixed(
        "wedge_width",
        Kind::Length,
        "lateral width",
        |p| Some(p.wedge.width),
        |p, v| {
            p.wedge.width = v;
        },
    ),
    fixed(
        "wedge_mass",
        Kind::Mass,
        "mass of the wedge",
        |p| Some(p.wedge.mass),
        |p, v| {
            p.wedge.mass = v;
        },
    ),
    fixed(
        "wedge_inertia_roll",
        Kind::Inertia,
        "moment of inertia about the center of gravity, longitudinal axis",
        |p| Some(p.wedge.inertia[0]),
        |p, v| p.wedge.inertia[0] = v,
    ),
    fixed(
        "wedge_inertia_pitch",
        Kind::Inertia,
        "moment of inertia about the center of gravity, lateral axis",
        |p| Some(p.wedge.inertia[1]),
        |p, v| p.wedge.inertia[1] = v,
    ),
    fixed(
        "wedge_inertia_yaw",
        Kind::Inertia,
        "moment of inertia about the center of gravity, vertical axis",
        |p| Some(p.wedge.inertia[2]),
        |p, v| p.wedge.inertia[2] = v,
    ),
    fixed(
        "column_wear",
        Kind::Length,
        "depth of wear of the column and the wedge's vertical face together",
        |p| Some(p.wear.column),
        |p, v| p.wear.column = v,
    ),
    fixed(
        "slope_wear",
        Kind::Length,
        "depth of wear of the pocket's slope and the wedge's slope face together",
        |p| Some(p.wear.slope),
        |p, v| p.wear.slope = v,
    ),
    fixed(
        "coil_stiffness",
        Kind::Stiffness,
        "stiffness of the control coil (coil_mode = 0)",
        |p| match p.coil.law {
            CoilLaw::Linear { stiffness } => Some(stiffness),
            _ => None,
        },
        |p, v| p.coil.law = CoilLaw::Linear { stiffness: v },
    ),
    fixed(
        "coil_free_length",
        Kind::Length,
        "free length of the control coil",
        |p| Some(p.coil.free_length),
        |p, v| p.coil.free_length = v,
    ),
    fixed(
        "coil_nominal_length",
        Kind::Length,
        "length of the control coil in the nominal position",
        |p| Some(p.coil.nominal_length),
        |p, v| p.coil.nominal_length = v,
    ),
    fixed(
        "coil_damping",
        Kind::Damping,
        "damping of the control coil, in all modes of the coil",
        |p| Some(p.coil.damping),
        |p, v| p.coil.damping = v,
    ),
    fixed(
        "coil_rotational_damping",
        Kind::RotationalDamping,
        "damping of rotations by the control coil",
        |p| Some(p.coil.rotational_damping),
        |p, v| p.coil.rotational_damping = v,
    ),
    fixed(
        "contact_stiffness",
        Kind::Stiffness,
        "normal stiffness of each corner",
        |p| Some(p.contact.stiffness),
        |p, v| p.contact.stiffness = v,
    ),
    fixed(
        "contact_damping",
        Kind::Damping,
        "normal damping of each corner",
        |p| Some(p.contact.damping),
        |p, v| p.contact.damping = v,
    ),
    Access {
        name: "column_friction",
        kind: Kind::Dimensionless,
        text: "coefficient of friction of the column",
        get: |p| Some(p.column_friction.coefficient),
        set: |p, v| p.column_friction.coefficient = v,
        tunable: true,
    },
    Access {
        name: "slope_friction",
        kind: Kind::Dimensionless,
        text: "coefficient of friction of the slope",
        get: |p| Some(p.slope_friction.coefficient),
        set: |p, v| p.slope_friction.coefficient = v,
        tunable: true,
    },
    fixed(
        "column_reference_speed",
        Kind::Speed,
        "reference speed of the tanh law of friction at the column",
        |p| reference_speed(&p.column_friction),
        |p, v| set_reference_speed(&mut p.column_friction, v),
    ),
    fixed(
        "slope_reference_speed",
        Kind::Speed,
        "reference speed of the tanh law of friction at the slope",
        |p| reference_speed(&p.slope_friction),
        |p, v| set_reference_speed(&mut p.slope_friction, v),
    ),
    fixed(
        "toe",
        Kind::Angle,
        "toe angle of the column, positive is toe out",
        |p| Some(p.toe),
        |p, v| p.toe = v,
    ),
    fixed(
        "gravity",
        Kind::Acceleration,
        "gravity, downwards",
        |p| Some(p.gravity),
        |p, v| {
            p.gravity = v;
        },
    ),
];

fn reference_speed(face: &FaceFriction) -> Option<f64> {
    match face.law {
        FrictionLaw::Tanh { reference_speed } => Some(reference_speed),
        FrictionLaw::Bristle { .. } => None,
    }
}

fn set_reference_speed(face: &mut FaceFriction, value: f64) {
    if let FrictionLaw::Tanh { reference_speed } = &mut face.law {
        *reference_speed = value;
    }
}

fn present(parameters: &Parameters) -> impl Iterator<Item = (&'static Access, f64)> + '_ {
    ALL.iter()
        .filter_map(|access| Some((access, (access.get)(parameters)?)))
}

/// Returns the parameters of a wedge that there are, with their values.
pub(crate) fn entries(parameters: &Parameters) -> Vec<QuantityEntry> {
    present(parameters)
        .map(|(access, value)| {
            let mut entry =
                QuantityEntry::real(access.name, Some(Unit::Of(access.kind)), Some(value), access.text);
            entry.tunable = access.tunable;
            entry
        })
        .collect()
}

/// Returns the parameters with other values, in the order of [`entries`]. What was not touched keeps its
/// bits.
pub(crate) fn apply(parameters: &Parameters, values: &[f64]) -> Parameters {
    let mut changed = parameters.clone();
    for ((access, before), value) in present(parameters).zip(values) {
        if before.to_bits() != value.to_bits() {
            (access.set)(&mut changed, *value);
        }
    }
    changed
}

/// Returns the place of a parameter in the list.
pub(crate) fn place(parameters: &Parameters, name: &str) -> Option<usize> {
    present(parameters).position(|(access, _)| access.name == name)
}
