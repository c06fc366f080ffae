//! Irregularities in track files: on which rails, in which direction, and shapes.

use quantity::{Kind, nearest};
use wheelrail::track::shape::Shape;
use wheelrail::track::{Direction, Irregularity, Placed, Rails};

use super::{length, optional, optional_length, spectrum};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names, Range};

const RAILS: Names<Rails> = &[
    ("left", Rails::Left),
    ("right", Rails::Right),
    ("both", Rails::Both),
    ("against", Rails::Against),
];
const DIRECTIONS: Names<Direction> = &[("lateral", Direction::Lateral), ("vertical", Direction::Vertical)];
const SHAPES: [&str; 4] = ["joints", "sine", "dip", "jog"];
/// Rail length in North America, m.
const RAIL: f64 = 39.0 * 0.3048;

/// Returns an irregularity; `end` is the length of the track, m.
pub(super) fn irregularity(
    section: &CaseSection<'_>,
    end: Option<f64>,
    problems: &mut Problems,
) -> Option<Placed> {
    let (shape, spectrum) = (section.table.get("shape"), section.table.get("spectrum"));
    let irregularity = match (shape, spectrum) {
        (Some(_), None) => shaped(section, problems).map(Irregularity::Shape),
        (None, Some(_)) => spectrum::realized(section, end, problems).map(Irregularity::Spectrum),
        _ => {
            let message = format!("`{}` must have one of `shape`, `spectrum`, `table`", section.path);
            let help = format!(
                "shapes are {}; spectra are {}; a table is a file of measured track",
                SHAPES.join(", "),
                spectrum::SPECTRA.join(", ")
            );
            let problem = Problem::new(message).label("which one?").help(help);
            problems.push(match &section.place {
                Some(place) => problem.at(place),
                None => problem,
            });
            None
        }
    };
    let rails = optional(section, "rails", Rails::Both, |section| {
        section.choice("rails", RAILS, problems)
    });
    let direction = section.choice("direction", DIRECTIONS, problems);
    Some(Placed {
        rails: rails?,
        direction: direction?,
        irregularity: irregularity?,
    })
}

/// Returns the text of a name among others.
pub(super) fn named<'t>(
    section: &CaseSection<'t>,
    key: &str,
    names: &[&str],
    problems: &mut Problems,
) -> Option<&'t str> {
    let (text, node) = section.text(key, problems)?;
    if names.contains(&text) {
        return Some(text);
    }
    let all = format!("write one of \"{}\"", names.join("\", \""));
    let help = match nearest(text, names.iter().copied()) {
        Some(near) => format!("did you mean \"{near}\"? {all}"),
        None => all,
    };
    let problem = Problem::new(format!("`{}` cannot be \"{text}\"", section.path_of(key)));
    problems.push(problem.at(&node.place).label("not one of the choices").help(help));
    None
}

/// Returns a whole number.
pub(super) fn whole(
    section: &CaseSection<'_>,
    key: &str,
    default: u64,
    problems: &mut Problems,
) -> Option<u64> {
    if section.table.get(key).is_none() {
        return Some(default);
    }
    let range = Range::UpTo(1e9, "a whole number, 0 to 1e9");
    let number = section.number(key, range, "1", problems)?;
    if number.fract() == 0.0 {
        return Some(number as u64);
    }
    let problem = Problem::new(format!(
        "`{}` is {number}; a whole number is expected",
        section.path_of(key)
    ));
    problems.push(match section.table.place_of(key) {
        Some(place) => problem.at(place).label("not whole"),
        None => problem,
    });
    None
}

/// Returns an amplitude, depth or offset, m: either sign.
fn size(section: &CaseSection<'_>, key: &str, problems: &mut Problems) -> Option<f64> {
    let range = Range::Between(-1.0, 1.0, "below 1 m");
    section
        .quantity(key, Kind::Length, range, problems)
        .map(|size| size.to_si())
}

fn shaped(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Shape> {
    let shape = named(section, "shape", &SHAPES, problems)?;
    let common = ["shape", "rails", "direction", "start"];
    let own: &[&str] = match shape {
        "joints" => &["depth", "spacing", "joints", "rounding"],
        "sine" => &["amplitude", "wavelength", "cycles"],
        "dip" => &["depth", "length"],
        _ => &["offset", "length"],
    };
    let keys: Vec<&str> = common.iter().chain(own).copied().collect();
    section.allow_in(&keys, &[], "a track", problems);
    let start = length(section, "start", true, problems);
    Some(match shape {
        "joints" => {
            let depth = size(section, "depth", problems);
            let spacing = optional_length(section, "spacing", RAIL, problems);
            let rounding = optional_length(section, "rounding", 0.3048, problems);
            let joints = whole(section, "joints", 10, problems);
            let (spacing, rounding) = (spacing?, rounding?);
            if 2.0 * rounding >= spacing {
                let problem = Problem::new(format!(
                    "`{}.rounding` is half the spacing of joints or more",
                    section.path
                ));
                problems.push(match section.table.place_of("rounding") {
                    Some(place) => problem.at(place).label("too long"),
                    None => problem,
                });
                return None;
            }
            Shape::Joints {
                depth: depth?,
                spacing,
                joints: joints? as usize,
                rounding,
                start: start?,
            }
        }
        "sine" => {
            let amplitude = size(section, "amplitude", problems);
            let wavelength = optional_length(section, "wavelength", RAIL, problems);
            let cycles = whole(section, "cycles", 5, problems);
            Shape::Sine {
                amplitude: amplitude?,
                wavelength: wavelength?,
                cycles: cycles? as usize,
                start: start?,
            }
        }
        "dip" => {
            let depth = size(section, "depth", problems);
            let along = length(section, "length", false, problems);
            Shape::Dip {
                depth: depth?,
                length: along?,
                start: start?,
            }
        }
        _ => {
            let offset = size(section, "offset", problems);
            let along = length(section, "length", false, problems);
            Shape::Jog {
                offset: offset?,
                length: along?,
                start: start?,
            }
        }
    })
}
