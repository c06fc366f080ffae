//! The toe of a column: an angle with its direction in words.

use quantity::{Kind, Quantity};

use super::field::{Input, Reach, TypedNumber, Written, quoted};
use super::page::TURN;
use super::problem::{Problem, Problems, TomlLocation};
use super::section::{self, CaseSection, Range, inner_place, unit_problem};
use super::tree::{NodeValue, TreeNode};
use crate::reader::CaseReader;
use crate::reader::schema::Form;

/// Toes that make sense, rad.
const TOE: Range = Range::Between(
    -std::f64::consts::FRAC_PI_2 / 4.0,
    std::f64::consts::FRAC_PI_2 / 4.0,
    "below 22.5 deg",
);

/// The direction in which the gap between column and bolster opens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Direction {
    /// It closes downwards.
    In,
    /// It opens downwards.
    Out,
}

impl Direction {
    fn name(self) -> &'static str {
        match self {
            Self::In => "in",
            Self::Out => "out",
        }
    }
}

/// The toe angle of a column, as typed.
pub(crate) struct Toe {
    /// Its size, never negative.
    angle: Quantity,
    /// Its direction; may be left out for a toe of zero.
    direction: Option<Direction>,
}

impl Toe {
    /// Reads `toe` of the current section over an angle (rad, positive out). Returns the angle.
    pub fn read(r: &mut CaseReader<'_>, usual: f64) -> f64 {
        let degrees = usual.to_degrees();
        let direction = match degrees {
            _ if degrees > 0.0 => Some(Direction::Out),
            _ if degrees < 0.0 => Some(Direction::In),
            _ => None,
        };
        let Ok(angle) = Quantity::new(degrees.abs(), "deg") else {
            return usual;
        };
        let comment = "of the column; out: the gap between column and bolster opens downwards; in: it closes";
        let usual = Self { angle, direction };
        r.other(
            "toe",
            Form::Quantity(Kind::Angle),
            comment,
            usual,
            read,
            Self::written,
        )
        .to_si()
    }

    /// Returns the angle in rad, positive for toe out (eq. 5-1 of the thesis).
    fn to_si(&self) -> f64 {
        match self.direction {
            Some(Direction::In) => -self.angle.to_si(),
            _ => self.angle.to_si(),
        }
    }

    fn written(&self) -> Written {
        let mut number = TypedNumber::of(&self.angle, Kind::Angle, Reach::Signed(TURN));
        let text = match self.direction {
            Some(direction) => format!("{} {}", self.angle, direction.name()),
            None => self.angle.to_string(),
        };
        if self.direction == Some(Direction::In) {
            number.value = -number.value;
            number.si = -number.si;
        }
        number.signs = Some([Direction::In, Direction::Out].map(Direction::name));
        Written {
            toml: quoted(&text),
            input: Input::Number(number),
        }
    }
}

/// Reads a toe: a text such as `0.2 deg out`, or a number in rad, positive out, from a program.
fn read(s: &CaseSection<'_>, problems: &mut Problems) -> Option<Toe> {
    const HELP: &str = "write for example \"0.2 deg out\" (the gap between column and bolster opens \
                        downwards), \"0.2 deg in\", or \"0 deg\"";
    let node = s.require("toe", HELP, problems)?;
    let path = s.path_of("toe");
    if let NodeValue::Number(angle) = node.value
        && node.place.source.bare_numbers_are_si
    {
        return signed_toe(angle, node, &path, problems);
    }
    let NodeValue::Text(text) = &node.value else {
        let message = format!(
            "`{path}` is {}; an angle with its direction is expected",
            node.value.describe()
        );
        problems.push(
            Problem::new(message)
                .at(&node.place)
                .label("an angle in quotes")
                .help(HELP),
        );
        return None;
    };
    let trimmed = text.trim_end();
    let (angle, direction) = match trimmed.rsplit_once(char::is_whitespace) {
        Some((angle, "out")) => (angle, Some(Direction::Out)),
        Some((angle, "in")) => (angle, Some(Direction::In)),
        _ => (trimmed, None),
    };
    let mut bad = |problem: Problem, place: &TomlLocation, label: &str| {
        problems.push(problem.at(place).label(label).help(HELP));
        None
    };
    let angle = match Quantity::parse_as(angle.trim(), Kind::Angle) {
        Ok(angle) => angle,
        Err(error) => {
            let place = inner_place(node, &error);
            return bad(
                unit_problem(&error, &path, Kind::Angle, &place),
                &place,
                "an angle with its direction",
            );
        }
    };
    if angle.to_si() < 0.0 {
        let message = format!("`{path}` is negative; its direction is said in words");
        return bad(Problem::new(message), &node.place, "no sign is expected");
    }
    if direction.is_none() && angle.to_si() != 0.0 {
        return bad(
            Problem::new(format!("`{path}` does not say in or out")),
            &node.place,
            "the direction is missing",
        );
    }
    if let Some(problem) = section::out_of_range(&angle, &path, Kind::Angle, TOE) {
        return bad(problem, &node.place, "too large");
    }
    Some(Toe { angle, direction })
}

/// Returns a toe that a program gives: a number in rad, positive out.
fn signed_toe(angle: f64, node: &TreeNode, path: &str, problems: &mut Problems) -> Option<Toe> {
    let mut size = node.clone();
    size.value = NodeValue::Number(angle.abs());
    Some(Toe {
        angle: section::quantity(&size, path, Kind::Angle, TOE, problems)?,
        direction: match angle {
            _ if angle > 0.0 => Some(Direction::Out),
            _ if angle < 0.0 => Some(Direction::In),
            _ => None,
        },
    })
}
