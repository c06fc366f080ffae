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

/// A parameter that there is not.
const NONE: Access = Access {
    name: "",
    kind: Kind::Dimensionless,
    text: "",
    get: |_| None,
    set: |_, _| (),
    tunable: false,
};

/// A parameter that stands at one place of [`Parameters`].
macro_rules! fixed {
    ($($place:tt)+) => {
        Access {
            get: |p| Some(p.$($place)+),
            set: |p, v| p.$($place)+ = v,
            ..NONE
        }
    };
}

/// The same, which may change while the simulation runs.
macro_rules! tunable {
    ($($place:tt)+) => {
        Access {
            tunable: true,
            ..fixed!($($place)+)
        }
    };
}

/// The reference speed of a face whose law of friction has one.
macro_rules! reference_speed {
    ($face:ident) => {
        Access {
            get: |p| reference_speed(&p.$face),
            set: |p, v| set_reference_speed(&mut p.$face, v),
            ..NONE
        }
    };
}

/// The stiffness of a coil that has one.
macro_rules! coil_stiffness {
    () => {
        Access {
            get: |p| match p.coil.law {
                CoilLaw::Linear { stiffness } => Some(stiffness),
                _ => None,
            },
            set: |p, v| p.coil.law = CoilLaw::Linear { stiffness: v },
            ..NONE
        }
    };
}

/// Lists parameters: name, kind, access, description.
macro_rules! parameters {
    ($($name:ident: $kind:ident = $access:ident($($place:tt)*), $text:literal;)+) => {
        const ALL: &[Access] = &[$(
            Access {
                name: stringify!($name),
                kind: Kind::$kind,
                text: $text,
                ..$access!($($place)*)
            },
        )+];
    };
}

parameters! {
    wedge_angle: Angle = fixed(wedge.angle), "wedge angle between the vertical and the slope";
    wedge_height: Length = fixed(wedge.height), "height of the vertical face";
    wedge_width: Length = fixed(wedge.width), "lateral width";
    wedge_mass: Mass = fixed(wedge.mass), "mass of the wedge";
    wedge_inertia_roll: Inertia = fixed(wedge.inertia[0]),
        "moment of inertia about the center of gravity, longitudinal axis";
    wedge_inertia_pitch: Inertia = fixed(wedge.inertia[1]),
        "moment of inertia about the center of gravity, lateral axis";
    wedge_inertia_yaw: Inertia = fixed(wedge.inertia[2]),
        "moment of inertia about the center of gravity, vertical axis";
    column_wear: Length = fixed(wear.column),
        "depth of wear of the column and the wedge's vertical face together";
    slope_wear: Length = fixed(wear.slope),
        "depth of wear of the pocket's slope and the wedge's slope face together";
    coil_stiffness: Stiffness = coil_stiffness(), "stiffness of the control coil (coil_mode = 0)";
    coil_free_length: Length = fixed(coil.free_length), "free length of the control coil";
    coil_nominal_length: Length = fixed(coil.nominal_length),
        "length of the control coil in the nominal position";
    coil_damping: Damping = fixed(coil.damping), "damping of the control coil, in all modes of the coil";
    coil_rotational_damping: RotationalDamping = fixed(coil.rotational_damping),
        "damping of rotations by the control coil";
    contact_stiffness: Stiffness = fixed(contact.stiffness), "normal stiffness of each corner";
    contact_damping: Damping = fixed(contact.damping), "normal damping of each corner";
    column_friction: Dimensionless = tunable(column_friction.coefficient),
        "coefficient of friction of the column";
    slope_friction: Dimensionless = tunable(slope_friction.coefficient),
        "coefficient of friction of the slope";
    column_reference_speed: Speed = reference_speed(column_friction),
        "reference speed of the tanh law of friction at the column";
    slope_reference_speed: Speed = reference_speed(slope_friction),
        "reference speed of the tanh law of friction at the slope";
    toe: Angle = fixed(toe), "toe angle of the column, positive is toe out";
    gravity: Acceleration = fixed(gravity), "gravity, downwards";
}

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

/// Returns the parameters with other values of these. What was not touched keeps its bits.
pub(crate) fn apply(parameters: &Parameters, known: &[QuantityEntry], values: &[f64]) -> Parameters {
    let mut changed = parameters.clone();
    for (access, before) in present(parameters) {
        let place = known.iter().position(|entry| entry.name == access.name);
        match place.and_then(|place| values.get(place)) {
            Some(value) if value.to_bits() != before.to_bits() => (access.set)(&mut changed, *value),
            _ => {}
        }
    }
    changed
}
