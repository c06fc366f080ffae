//! Reading the toe of a column: an angle with its direction in words.

use quantity::{Kind, Quantity};

use super::document::{Toe, ToeDirection};
use super::problem::{Problem, Problems, TomlLocation};
use super::section::{self, CaseSection, Range, inner_place, unit_problem};
use super::tree::{NodeValue, TreeNode};

/// Toes that make sense, rad.
const TOE: Range = Range::Between(
    -std::f64::consts::FRAC_PI_2 / 4.0,
    std::f64::consts::FRAC_PI_2 / 4.0,
    "below 22.5 deg",
);

/// Reads a toe: a text such as `0.2 deg out`, or a number in rad, positive out, from a program.
/// Reads the height of the point about which toe turns the column; the middle of the face if it is left out.
pub(crate) fn read_toe_pivot(s: &CaseSection<'_>, problems: &mut Problems) -> Option<Quantity> {
    match s.table.get("toe_pivot") {
        Some(_) => s.quantity("toe_pivot", Kind::Length, Range::Any, problems),
        None => Quantity::new(0.0, "in").ok(),
    }
}

pub(crate) fn read_toe(s: &CaseSection<'_>, problems: &mut Problems) -> Option<Toe> {
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
        Some((angle, "out")) => (angle, Some(ToeDirection::Out)),
        Some((angle, "in")) => (angle, Some(ToeDirection::In)),
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
            _ if angle > 0.0 => Some(ToeDirection::Out),
            _ if angle < 0.0 => Some(ToeDirection::In),
            _ => None,
        },
    })
}
