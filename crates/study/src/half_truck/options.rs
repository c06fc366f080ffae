//! The choices as typed: `NAME=VALUE`.

use input::shortened;
use mechanics::connection::{Branch, GapTension, NegativeRise};
use mechanics::contact::FrictionDirections;
use nucars::truck::{Bend, Choices, Wedges};
use quantity::{Kind, Quantity, nearest};
use thiserror::Error;

/// Names and what is expected of each.
const OPTIONS: [(&str, &str); 15] = [
    ("bend", "half_cosine or linear"),
    ("speed", "a speed along the track, such as \"60 mph\""),
    ("plain_toe_angle", "an angle, such as \"0.2 deg\""),
    (
        "branch",
        "friction_force, or for a branch by velocity its reference speed, such as \"0.1 in/s\"",
    ),
    ("rise_in_slip", "true or false"),
    ("negative_rise", "extend or stop"),
    ("accumulator_damping", "a number, 1 for the files' damping"),
    ("gap_tension", "never or allowed"),
    ("wedges", "massless or bodies"),
    ("wedge_mass", "a mass, such as \"50 lb\""),
    ("wedge_height", "a length, such as \"6.125 in\""),
    ("wedge_width", "a length, such as \"10.5 in\""),
    (
        "wedge_contact_stiffness",
        "a stiffness of each corner, such as \"2.5e5 lbf/in\"",
    ),
    (
        "wedge_contact_damping",
        "a damping of each corner, such as \"25 lbf*s/in\"",
    ),
    ("wedge_friction_directions", "two or one"),
];

/// A choice that cannot be taken.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum OptionError {
    /// There is no `=`.
    #[error("`{0}` is not of the form NAME=VALUE; names are {names}", names = names())]
    Form(String),
    /// There is no such option.
    #[error("there is no option `{name}`; {hint}")]
    Unknown {
        /// As typed.
        name: String,
        /// The nearest name, or all.
        hint: String,
    },
    /// The value is none of its kind.
    #[error("`{value}` is no value of {name}: {expected} is expected")]
    Value {
        /// The option.
        name: &'static str,
        /// As typed.
        value: String,
        /// The admissible values.
        expected: &'static str,
    },
}

fn names() -> String {
    OPTIONS.map(|(name, _)| name).join(", ")
}

/// Names of all options and what is expected of each.
pub fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    OPTIONS.into_iter()
}

/// Takes one choice as typed.
///
/// # Errors
/// It is no option or no value of it.
pub fn set(choices: &mut Choices, typed: &str) -> Result<(), OptionError> {
    let (name, value) = typed
        .split_once('=')
        .map(|(name, value)| (name.trim(), value.trim().trim_matches('"')))
        .ok_or_else(|| OptionError::Form(shortened(typed)))?;
    let Some((name, expected)) = OPTIONS.into_iter().find(|(own, _)| *own == name) else {
        let hint = match nearest(name, OPTIONS.iter().map(|(name, _)| *name)) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("names are {}", names()),
        };
        return Err(OptionError::Unknown {
            name: shortened(name),
            hint,
        });
    };
    let wrong = || OptionError::Value {
        name,
        value: shortened(value),
        expected,
    };
    let measure = |kind: Kind| -> Result<f64, OptionError> {
        let value = Quantity::parse_as(value, kind).map_err(|_| wrong())?.to_si();
        Some(value).filter(|value| value.is_finite()).ok_or_else(wrong)
    };
    let positive = |value: f64| Some(value).filter(|value| *value > 0.0).ok_or_else(wrong);
    let (elements, body) = (&mut choices.elements, &mut choices.wedge_body);
    match (name, value) {
        ("bend", "half_cosine") => choices.bend = Bend::HalfCosine,
        ("bend", "linear") => choices.bend = Bend::Linear,
        ("speed", _) => choices.speed = Some(positive(measure(Kind::Speed)?)?),
        ("plain_toe_angle", _) => elements.plain_toe_angle = measure(Kind::Angle)?,
        ("branch", "friction_force") => elements.branch = Branch::FrictionForce,
        ("branch", _) => {
            let reference_speed = positive(measure(Kind::Speed)?)?;
            elements.branch = Branch::Velocity { reference_speed };
        }
        ("rise_in_slip", _) => elements.rise_in_slip = value.parse().map_err(|_| wrong())?,
        ("negative_rise", "extend") => elements.negative_rise = NegativeRise::Extend,
        ("negative_rise", "stop") => elements.negative_rise = NegativeRise::Stop,
        ("accumulator_damping", _) => {
            let number = value.parse().map_err(|_| wrong())?;
            elements.accumulator_damping = positive(number)
                .and_then(|number: f64| Some(number).filter(|number| number.is_finite()).ok_or_else(wrong))?;
        }
        ("gap_tension", "never") => elements.gap_tension = GapTension::Never,
        ("gap_tension", "allowed") => elements.gap_tension = GapTension::Allowed,
        ("wedges", "massless") => choices.wedges = Wedges::Massless,
        ("wedges", "bodies") => choices.wedges = Wedges::Bodies,
        ("wedge_mass", _) => body.mass = Some(positive(measure(Kind::Mass)?)?),
        ("wedge_height", _) => body.height = Some(positive(measure(Kind::Length)?)?),
        ("wedge_width", _) => body.width = Some(positive(measure(Kind::Length)?)?),
        ("wedge_contact_stiffness", _) => {
            body.contact_stiffness = Some(positive(measure(Kind::Stiffness)?)?);
        }
        ("wedge_contact_damping", _) => {
            let damping = Some(measure(Kind::Damping)?).filter(|damping| *damping >= 0.0);
            body.contact_damping = Some(damping.ok_or_else(wrong)?);
        }
        ("wedge_friction_directions", "two") => body.friction_directions = Some(FrictionDirections::Two),
        ("wedge_friction_directions", "one") => body.friction_directions = Some(FrictionDirections::One),
        _ => return Err(wrong()),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use nucars::truck::WedgeBody;

    use super::*;

    #[test]
    fn every_field_can_be_chosen() {
        let mut choices = Choices::default();
        for typed in [
            "bend=linear",
            "speed=10 m/s",
            "plain_toe_angle=0.5 deg",
            "branch = 2 mm/s",
            "rise_in_slip=true",
            "negative_rise=stop",
            "accumulator_damping=0.1",
            "gap_tension=allowed",
            "wedges=bodies",
            "wedge_mass=40 lb",
            "wedge_height=150 mm",
            "wedge_width=11 in",
            "wedge_contact_stiffness=1e6 lbf/in",
            "wedge_contact_damping=0 lbf*s/in",
            "wedge_friction_directions=one",
        ] {
            let before = choices.clone();
            set(&mut choices, typed).unwrap();
            assert_ne!(before, choices, "{typed}");
        }
        assert_eq!(choices.speed, Some(10.0));
        assert_eq!(
            choices.elements.branch,
            Branch::Velocity {
                reference_speed: 0.002
            }
        );
        for typed in [
            "bend=half_cosine",
            "branch=friction_force",
            "rise_in_slip=false",
            "negative_rise=extend",
            "gap_tension=never",
            "accumulator_damping=1",
            "plain_toe_angle=0 deg",
            "wedges=massless",
        ] {
            set(&mut choices, typed).unwrap();
        }
        choices.speed = None;
        choices.wedge_body = WedgeBody::default();
        assert_eq!(choices, Choices::default());
    }

    #[test]
    fn wrong_choices_say_what_would_do() {
        for (typed, text) in [
            ("bend", "NAME=VALUE"),
            ("bent=linear", "did you mean bend?"),
            ("zzzzzzzzzz=1", "names are bend"),
            ("bend=round", "half_cosine or linear"),
            ("speed=60", "such as \"60 mph\""),
            ("speed=-1 m/s", "a speed along the track"),
            ("branch=velocity", "its reference speed"),
            ("rise_in_slip=yes", "true or false"),
            ("accumulator_damping=0", "a number"),
            ("accumulator_damping=inf", "a number"),
            ("wedges=heavy", "massless or bodies"),
            ("wedge_mass=0 lb", "such as \"50 lb\""),
            ("wedge_contact_damping=-1 lbf*s/in", "a damping"),
        ] {
            let error = set(&mut Choices::default(), typed).unwrap_err().to_string();
            assert!(error.contains(text), "{error}");
        }
    }
}
