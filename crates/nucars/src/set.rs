//! Single values laid over what files say: `PATH=VALUE`, as the option `--set` and studies take them.
//!
//! | path | value |
//! |---|---|
//! | `body.NUMBER.x`, `.y`, `.z` | center of gravity, a length |
//! | `body.NUMBER.mass`, `.roll_inertia`, `.pitch_inertia`, `.yaw_inertia` | a mass, moments of inertia |
//! | `connection.NUMBER.x`, `.y`, `.z` | the point where it acts, a length |
//! | `characteristic.NUMBER.QUANTITY` | a value of this characteristic, such as `column_friction` |
//! | `wedges.QUANTITY` | the same of all characteristics of wedges |
//! | `function.NUMBER.factor` | a pure number that all ordinates of the function are multiplied with |
//! | `history.NUMBER.factor` | a pure number that amplitudes and base lines of the history are multiplied with |
//! | `history.NUMBER.frequency` | the frequency of its sines |
//!
//! Numbers are those of the files. Values with a dimension need a unit, in any system; trees keep the files'
//! units.

use input::shortened;
use quantity::{Kind, Quantity, nearest};
use thiserror::Error;

use crate::source::Spanned;
use crate::tree::{HistoryShape, InputFile, Law, SystemFile, Toe};
use crate::truck::units::{DEGREE, INCH, INERTIA, MASS, MOMENT, POUND};

/// A value that cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SetError {
    /// The path leads nowhere.
    #[error("`{path}` cannot be set: {reason}")]
    Path {
        /// As typed.
        path: String,
        /// The reason, and the admissible names.
        reason: String,
    },
    /// The value is none of its kind.
    #[error("`{value}` is no value of `{path}`; expected: {expected}")]
    Value {
        /// The path.
        path: String,
        /// As typed.
        value: String,
        /// The admissible values.
        expected: String,
    },
}

/// The possible first parts of a path.
pub const SECTIONS: [&str; 6] = [
    "body",
    "connection",
    "characteristic",
    "wedges",
    "function",
    "history",
];

/// The targets of overrides.
enum Target<'t> {
    /// A number in the file's unit.
    Number(&'t mut Spanned<f64>, &'static Expected),
    /// A number that is multiplied.
    Factor(&'t mut Spanned<f64>),
    /// The direction of a toe.
    Toe(&'t mut Spanned<Toe>),
}

/// The admissible numbers.
struct Expected {
    /// The kinds that they may have, with the factors from the file's units to SI.
    kinds: &'static [(Kind, f64)],
    /// The least of them, in the file's unit.
    least: f64,
    /// In words.
    text: &'static str,
}

const fn expected(kinds: &'static [(Kind, f64)], least: f64, text: &'static str) -> Expected {
    Expected { kinds, least, text }
}

const ANY: f64 = f64::NEG_INFINITY;
static LENGTH: Expected = expected(&[(Kind::Length, INCH)], ANY, "a length, such as \"3 in\"");
static BODY_MASS: Expected = expected(
    &[(Kind::Mass, MASS)],
    f64::MIN_POSITIVE,
    "a positive mass, such as \"2000 lb\"",
);
static BODY_INERTIA: Expected = expected(
    &[(Kind::Inertia, INERTIA)],
    f64::MIN_POSITIVE,
    "a positive moment of inertia, such as \"2000 lbf*in*s^2\"",
);
static FORCE: Expected = expected(
    &[(Kind::Force, POUND)],
    0.0,
    "a force from zero on, such as \"3000 lbf\"",
);
static COIL_FORCE: Expected = expected(&[(Kind::Force, POUND)], ANY, "a force, such as \"-3700 lbf\"");
static LIMIT: Expected = expected(
    &[(Kind::Force, POUND), (Kind::Moment, MOMENT)],
    ANY,
    "a force or a moment, such as \"3000 lbf\"",
);
static GAP: Expected = expected(
    &[(Kind::Length, INCH), (Kind::Angle, 1.0)],
    ANY,
    "a length or an angle, such as \"0.25 in\"",
);
static ANGLE: Expected = expected(&[(Kind::Angle, DEGREE)], ANY, "an angle, such as \"32 deg\"");
static STIFFNESS: Expected = expected(
    &[(Kind::Stiffness, POUND / INCH)],
    f64::MIN_POSITIVE,
    "a positive stiffness, such as \"1e5 lbf/in\"",
);
static DAMPING: Expected = expected(
    &[(Kind::Damping, POUND / INCH)],
    0.0,
    "a damping from zero on, such as \"100 lbf*s/in\"",
);
static FRICTION: Expected = expected(
    &[(Kind::Dimensionless, 1.0)],
    0.0,
    "a number from zero on, such as 0.4",
);
static FREQUENCY: Expected = expected(
    // Inside an angular frequency, rad/s.
    &[(Kind::Frequency, 2.0 * std::f64::consts::PI)],
    f64::MIN_POSITIVE,
    "a positive frequency, such as \"0.5 Hz\"",
);

/// Returns the quantities of a characteristic that can be set, by their names.
fn quantities(law: &mut Law) -> Vec<(&'static str, Target<'_>)> {
    use Target::{Number, Toe};
    match law {
        Law::Limits {
            extension,
            compression,
            ..
        } => vec![
            ("extension_limit", Number(extension, &LIMIT)),
            ("compression_limit", Number(compression, &LIMIT)),
        ],
        Law::Gap { high, low, .. } => vec![("gap_high", Number(high, &GAP)), ("gap_low", Number(low, &GAP))],
        Law::ViscousWedge {
            angle,
            force,
            viscosity,
            friction,
            ..
        } => vec![
            ("wedge_angle", Number(angle, &ANGLE)),
            ("coil_force", Number(force, &COIL_FORCE)),
            ("viscosity", Number(viscosity, &DAMPING)),
            ("friction", Number(friction, &FRICTION)),
        ],
        Law::ViscousToeWedge {
            angle,
            force,
            viscosity,
            slope_friction,
            column_friction,
            toe,
            ..
        } => vec![
            ("wedge_angle", Number(angle, &ANGLE)),
            ("coil_force", Number(force, &COIL_FORCE)),
            ("viscosity", Number(viscosity, &DAMPING)),
            ("slope_friction", Number(slope_friction, &FRICTION)),
            ("column_friction", Number(column_friction, &FRICTION)),
            ("toe", Toe(toe)),
        ],
        Law::SurfaceFriction {
            stiffness,
            bristle_damping,
            friction,
            ..
        } => vec![
            ("stiffness", Number(stiffness, &STIFFNESS)),
            ("damping", Number(bristle_damping, &DAMPING)),
            ("friction", Number(friction, &FRICTION)),
        ],
        Law::StickSlipWedge {
            angle,
            force,
            stiffness,
            bristle_damping,
            slope_friction,
            column_friction,
            toe,
            normal_limit,
            ..
        } => vec![
            ("wedge_angle", Number(angle, &ANGLE)),
            ("coil_force", Number(force, &COIL_FORCE)),
            ("stiffness", Number(stiffness, &STIFFNESS)),
            ("damping", Number(bristle_damping, &DAMPING)),
            ("slope_friction", Number(slope_friction, &FRICTION)),
            ("column_friction", Number(column_friction, &FRICTION)),
            ("normal_limit", Number(normal_limit, &FORCE)),
            ("toe", Toe(toe)),
        ],
        Law::StickSlipWedge3d {
            angle,
            stiffness,
            bristle_damping,
            slope_friction,
            column_friction,
            normal_limit,
            ..
        } => vec![
            ("wedge_angle", Number(angle, &ANGLE)),
            ("stiffness", Number(stiffness, &STIFFNESS)),
            ("damping", Number(bristle_damping, &DAMPING)),
            ("slope_friction", Number(slope_friction, &FRICTION)),
            ("column_friction", Number(column_friction, &FRICTION)),
            ("normal_limit", Number(normal_limit, &FORCE)),
        ],
        Law::Unused { .. } => Vec::new(),
    }
}

fn is_wedge(law: &Law) -> bool {
    matches!(
        law,
        Law::ViscousWedge { .. }
            | Law::ViscousToeWedge { .. }
            | Law::StickSlipWedge { .. }
            | Law::StickSlipWedge3d { .. }
    )
}

/// Sets a value in the trees of the files; `value` may have quotes.
///
/// # Errors
/// The path leads nowhere, or the value is none of its kind; nothing has changed then.
pub fn set(
    system: &mut SystemFile,
    input: Option<&mut InputFile>,
    path: &str,
    value: &str,
) -> Result<(), SetError> {
    let value = value.trim().trim_matches(['"', '\'']);
    let parts: Vec<&str> = path.split('.').collect();
    let wrong = |reason: String| SetError::Path {
        path: shortened(path),
        reason,
    };
    match parts.as_slice() {
        ["wedges", name] => {
            let laws = system
                .characteristics
                .iter_mut()
                .map(|characteristic| &mut characteristic.law);
            let targets = laws.filter(|law| is_wedge(law)).flat_map(quantities);
            let (found, others): (Vec<_>, Vec<_>) = targets.partition(|(target, _)| target == name);
            if found.is_empty() {
                let known: Vec<&str> = others.iter().map(|(target, _)| *target).collect();
                return Err(wrong(choose(name, known, "the wedges of these files have")));
            }
            let mut targets = found.into_iter();
            targets.try_for_each(|(_, target)| put(target, path, value))
        }
        [section, number, name] if SECTIONS.contains(section) && *section != "wedges" => {
            let number = number
                .parse()
                .map_err(|_| wrong(format!("`{}` is no number of a {section}", shortened(number))))?;
            let known = numbers(system, input.as_deref(), section);
            let targets = targets(system, input, section, number).ok_or_else(|| {
                let there = listed(known.iter().map(u32::to_string));
                wrong(format!("there is no {section} {number}; there are: {there}"))
            })?;
            let names: Vec<&str> = targets.iter().map(|(target, _)| *target).collect();
            let mut found = targets
                .into_iter()
                .filter(|(target, _)| target == name)
                .peekable();
            if found.peek().is_none() {
                let has = format!("{section} {number} has");
                return Err(wrong(choose(name, names, &has)));
            }
            // A factor, or a frequency of several segments, sets several values.
            found.try_for_each(|(_, target)| put(target, path, value))
        }
        [section, ..] => Err(wrong(match nearest(section, SECTIONS) {
            Some(near) if !SECTIONS.contains(section) => format!("did you mean {near}?"),
            _ => format!(
                "write for example characteristic.301.column_friction, wedges.column_friction or \
                 body.2.mass; paths begin with {}",
                SECTIONS.join(", ")
            ),
        })),
        [] => Err(wrong("it is empty".to_owned())),
    }
}

/// Returns the numbers of the records of a section.
fn numbers(system: &SystemFile, input: Option<&InputFile>, section: &str) -> Vec<u32> {
    match section {
        "body" => system.bodies.iter().map(|body| *body.id).collect(),
        "connection" => system
            .connections
            .iter()
            .map(|connection| *connection.id)
            .collect(),
        "characteristic" => system
            .characteristics
            .iter()
            .map(|characteristic| *characteristic.id)
            .collect(),
        "function" => system
            .piecewise_linear
            .iter()
            .map(|function| *function.id)
            .collect(),
        _ => input.map_or(Vec::new(), |input| {
            input.histories.iter().map(|history| *history.number).collect()
        }),
    }
}

/// Returns the targets of settings in a record of a section, by names; `None` if there is no such record.
fn targets<'t>(
    system: &'t mut SystemFile,
    input: Option<&'t mut InputFile>,
    section: &str,
    number: u32,
) -> Option<Vec<(&'static str, Target<'t>)>> {
    use Target::{Factor, Number};
    let point = |[x, y, z]: &'t mut [Spanned<f64>; 3]| {
        vec![
            ("x", Number(x, &LENGTH)),
            ("y", Number(y, &LENGTH)),
            ("z", Number(z, &LENGTH)),
        ]
    };
    Some(match section {
        "body" => {
            let body = system.bodies.iter_mut().find(|body| *body.id == number)?;
            let [roll, pitch, yaw] = &mut body.inertia;
            let mut all = point(&mut body.position);
            all.extend([
                ("mass", Number(&mut body.mass, &BODY_MASS)),
                ("roll_inertia", Number(roll, &BODY_INERTIA)),
                ("pitch_inertia", Number(pitch, &BODY_INERTIA)),
                ("yaw_inertia", Number(yaw, &BODY_INERTIA)),
            ]);
            all
        }
        "connection" => {
            let connection = system
                .connections
                .iter_mut()
                .find(|connection| *connection.id == number)?;
            point(&mut connection.position)
        }
        "characteristic" => {
            let found = system
                .characteristics
                .iter_mut()
                .find(|characteristic| *characteristic.id == number)?;
            quantities(&mut found.law)
        }
        "function" => {
            let function = system
                .piecewise_linear
                .iter_mut()
                .find(|function| *function.id == number)?;
            let ordinates = function.ordinates.iter_mut();
            ordinates.map(|ordinate| ("factor", Factor(ordinate))).collect()
        }
        _ => {
            let history = input?
                .histories
                .iter_mut()
                .find(|history| *history.number == number)?;
            let mut all = Vec::new();
            for segment in &mut history.segments {
                let [from, to] = &mut segment.base;
                all.extend([from, to, &mut segment.amplitude].map(|value| ("factor", Factor(value))));
                let [first, last] = &segment.coefficients;
                let sine = match *segment.shape {
                    HistoryShape::Sin => true,
                    HistoryShape::Ssin => first == last,
                    HistoryShape::Null | HistoryShape::Cusp | HistoryShape::Bend => false,
                };
                if sine {
                    let both = segment.coefficients.iter_mut();
                    all.extend(both.map(|value| ("frequency", Number(value, &FREQUENCY))));
                }
            }
            all
        }
    })
}

fn put(target: Target<'_>, path: &str, value: &str) -> Result<(), SetError> {
    let wrong = |expected: &str| SetError::Value {
        path: shortened(path),
        value: shortened(value),
        expected: expected.to_owned(),
    };
    match target {
        Target::Toe(toe) => {
            toe.value = match value {
                "out" => Toe::Out,
                "in" => Toe::In,
                _ => return Err(wrong("\"out\" or \"in\"")),
            };
        }
        Target::Factor(target) => {
            let factor: f64 = value.parse().map_err(|_| wrong("a number, such as 1.2"))?;
            if !factor.is_finite() {
                return Err(wrong("a finite number"));
            }
            target.value *= factor;
        }
        Target::Number(target, expected) => {
            let measured = expected.kinds.iter().find_map(|(kind, factor)| {
                let si = match kind {
                    Kind::Dimensionless => value.parse().ok()?,
                    kind => Quantity::parse_as(value, *kind).ok()?.to_si(),
                };
                Some(si / factor)
            });
            let admissible = |number: &f64| number.is_finite() && *number >= expected.least;
            target.value = measured.filter(admissible).ok_or_else(|| wrong(expected.text))?;
        }
    }
    Ok(())
}

/// Returns the advice on a name that is not there, among those that are.
fn choose(name: &str, names: Vec<&str>, has: &str) -> String {
    let mut known: Vec<&str> = Vec::new();
    for name in names {
        if !known.contains(&name) {
            known.push(name);
        }
    }
    if known.is_empty() {
        return format!("{has} nothing that can be set");
    }
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!("{has} {}", listed(known.iter().map(|name| (*name).to_owned()))),
    }
}

/// Returns the first texts of a list, separated by commas.
fn listed(texts: impl ExactSizeIterator<Item = String>) -> String {
    const MOST: usize = 20;
    let more = texts.len().saturating_sub(MOST);
    let mut list = texts.take(MOST).collect::<Vec<_>>().join(", ");
    if more > 0 {
        list.push_str(&format!(" and {more} more"));
    }
    list
}
