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

/// A parameter that stands at one place of [`Parameters`].
macro_rules! at {
    ($name:literal, $kind:ident, $text:literal, $($place:tt)+) => {
        Access {
            name: $name,
            kind: Kind::$kind,
            text: $text,
            get: |p| Some(p.$($place)+),
            set: |p, v| p.$($place)+ = v,
            tunable: false,
        }
    };
}

/// A coefficient of friction, which may change while the simulation runs.
macro_rules! friction {
    ($name:literal, $text:literal, $face:ident) => {
        Access {
            tunable: true,
            ..at!($name, Dimensionless, $text, $face.coefficient)
        }
    };
}

/// The reference speed of a face whose law of friction has one.
macro_rules! reference_speed {
    ($name:literal, $text:literal, $face:ident) => {
        Access {
            name: $name,
            kind: Kind::Speed,
            text: $text,
            get: |p| reference_speed(&p.$face),
            set: |p, v| set_reference_speed(&mut p.$face, v),
            tunable: false,
        }
    };
}

const ALL: &[Access] = &[
    at!(
        "wedge_angle",
        Angle,
        "wedge angle between the vertical and the slope",
        wedge.angle
    ),
    at!(
        "wedge_height",
        Length,
        "height of the vertical face",
        wedge.height
    ),
    at!("wedge_width", Length, "lateral width", wedge.width),
    at!("wedge_mass", Mass, "mass of the wedge", wedge.mass),
    at!(
        "wedge_inertia_roll",
        Inertia,
        "moment of inertia about the center of gravity, longitudinal axis",
        wedge.inertia[0]
    ),
    at!(
        "wedge_inertia_pitch",
        Inertia,
        "moment of inertia about the center of gravity, lateral axis",
        wedge.inertia[1]
    ),
    at!(
        "wedge_inertia_yaw",
        Inertia,
        "moment of inertia about the center of gravity, vertical axis",
        wedge.inertia[2]
    ),
    at!(
        "column_wear",
        Length,
        "depth of wear of the column and the wedge's vertical face together",
        wear.column
    ),
    at!(
        "slope_wear",
        Length,
        "depth of wear of the pocket's slope and the wedge's slope face together",
        wear.slope
    ),
    Access {
        name: "coil_stiffness",
        kind: Kind::Stiffness,
        text: "stiffness of the control coil (coil_mode = 0)",
        get: |p| match p.coil.law {
            CoilLaw::Linear { stiffness } => Some(stiffness),
            _ => None,
        },
        set: |p, v| p.coil.law = CoilLaw::Linear { stiffness: v },
        tunable: false,
    },
    at!(
        "coil_free_length",
        Length,
        "free length of the control coil",
        coil.free_length
    ),
    at!(
        "coil_nominal_length",
        Length,
        "length of the control coil in the nominal position",
        coil.nominal_length
    ),
    at!(
        "coil_damping",
        Damping,
        "damping of the control coil, in all modes of the coil",
        coil.damping
    ),
    at!(
        "coil_rotational_damping",
        RotationalDamping,
        "damping of rotations by the control coil",
        coil.rotational_damping
    ),
    at!(
        "contact_stiffness",
        Stiffness,
        "normal stiffness of each corner",
        contact.stiffness
    ),
    at!(
        "contact_damping",
        Damping,
        "normal damping of each corner",
        contact.damping
    ),
    friction!(
        "column_friction",
        "coefficient of friction of the column",
        column_friction
    ),
    friction!(
        "slope_friction",
        "coefficient of friction of the slope",
        slope_friction
    ),
    reference_speed!(
        "column_reference_speed",
        "reference speed of the tanh law of friction at the column",
        column_friction
    ),
    reference_speed!(
        "slope_reference_speed",
        "reference speed of the tanh law of friction at the slope",
        slope_friction
    ),
    at!("toe", Angle, "toe angle of the column, positive is toe out", toe),
    at!("gravity", Acceleration, "gravity, downwards", gravity),
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
