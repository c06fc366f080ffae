//! Track files: what a user writes of a track, read with places and units.
//!
//! ```toml
//! [[segments]]
//! tangent = "500 ft"
//! [[segments]]
//! spiral = "200 ft"
//! [[segments]]
//! curve = "600 ft"
//! degree = "10 deg"           # or radius = "573.7 ft"
//! direction = "right"
//! superelevation = "4 in"     # of the outer rail
//! [[irregularities]]
//! shape = "joints"
//! rails = "left"
//! direction = "vertical"
//! depth = "0.75 in"
//! start = "519.5 ft"
//! ```

use std::path::Path;

use quantity::{Kind, Quantity, nearest};
use wheelrail::track::shape::Shape;
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{
    CenterLine, CurveElements, Direction, Irregularity, Placed, Rails, Segment, Track, TrackError,
};

use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::{Names, Range, Section};
use crate::case::tree::{self, Node, Table, Value};
use crate::case::{CaseError, name, text_of};

/// A track with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackFile {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The track.
    pub track: Track,
}

const KEYS: [&str; 6] = [
    "name",
    "title",
    "rail_distance",
    "segments",
    "grades",
    "irregularities",
];
const RAILS: Names<Rails> = &[
    ("left", Rails::Left),
    ("right", Rails::Right),
    ("both", Rails::Both),
    ("against", Rails::Against),
];
const DIRECTIONS: Names<Direction> = &[("lateral", Direction::Lateral), ("vertical", Direction::Vertical)];
const TURNS: Names<f64> = &[("left", 1.0), ("right", -1.0)];
const SHAPES: [&str; 4] = ["joints", "sine", "dip", "jog"];
const SPECTRA: [&str; 5] = [
    "fra_vertical",
    "fra_lateral",
    "fra_cross_level",
    "erri_vertical_low",
    "erri_vertical_high",
];
/// The longest track, m.
const LONGEST: f64 = 1e6;
/// Rail length in North America, m.
const RAIL: f64 = 39.0 * 0.3048;

impl TrackFile {
    /// Reads a track file.
    ///
    /// # Errors
    /// The file cannot be read, or something in it is wrong; all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let text = text_of(path)?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// As [`TrackFile::read`], from a text; `source` names it in messages.
    ///
    /// # Errors
    /// As [`TrackFile::read`].
    pub fn parse(source: &str, text: &str) -> Result<Self, CaseError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let tree = tree::parse(&TomlSource::new(source, text)).map_err(CaseError::new)?;
        let mut problems = Problems::new();
        let file = read(&tree, source, &mut problems);
        file.filter(|_| problems.is_empty())
            .ok_or_else(|| CaseError::new(problems))
    }
}

fn read(tree: &Table, source: &str, problems: &mut Problems) -> Option<TrackFile> {
    let top = Section {
        path: String::new(),
        table: tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a track", problems);
    let name = name::read(&top, name::of_source(source), problems);
    let title = match tree.get("title") {
        Some(_) => top.text("title", problems).map_or("", |(text, _)| text),
        None => "",
    };
    let rail_distance = optional_length(&top, "rail_distance", 59.5 * 0.0254, problems);
    let help = "write [[segments]] and below it tangent = \"500 ft\"";
    top.require("segments", help, problems)?;
    let segments: Vec<Option<Segment>> = tables(&top, "segments", problems)
        .iter()
        .map(|section| segment(section, problems))
        .collect();
    let grades: Vec<Option<[f64; 2]>> = tables(&top, "grades", problems)
        .iter()
        .map(|section| {
            section.allow_in(&["distance", "grade"], &[], "a track", problems);
            let distance = length(section, "distance", true, problems);
            let range = Range::Between(-0.2, 0.2, "between -0.2 and 0.2: a rise by the distance");
            let grade = section.number("grade", range, "0.01", problems);
            Some([distance?, grade?])
        })
        .collect();
    let irregularities: Vec<Option<Placed>> = tables(&top, "irregularities", problems)
        .iter()
        .map(|section| irregularity(section, problems))
        .collect();
    let segments: Vec<Segment> = segments.into_iter().collect::<Option<_>>()?;
    let grades: Vec<[f64; 2]> = grades.into_iter().collect::<Option<_>>()?;
    let irregularities: Vec<Placed> = irregularities.into_iter().collect::<Option<_>>()?;
    let center_line = CenterLine::new(&segments, rail_distance?, &grades).map_err(|error| {
        problems.push(impossible(tree, &error));
    });
    Some(TrackFile {
        name: name?,
        title: title.to_owned(),
        track: Track {
            center_line: center_line.ok()?,
            irregularities,
        },
    })
}

/// A track that cannot be, shown at its segments.
fn impossible(tree: &Table, error: &TrackError) -> Problem {
    let problem = Problem::new(error.to_string());
    let problem = match tree.place_of("segments") {
        Some(place) => problem.at(place).label("these segments"),
        None => problem,
    };
    problem.help("segments count from 0; put a spiral between a tangent and a curve, and between two curves")
}

/// The tables of a list, `[[key]]`.
fn tables<'t>(top: &Section<'t>, key: &str, problems: &mut Problems) -> Vec<Section<'t>> {
    let Some(node) = top.table.get(key) else {
        return Vec::new();
    };
    let not_a_list = |node: &Node, problems: &mut Problems| {
        let problem = Problem::new(format!(
            "`{key}` holds {}; tables are expected",
            node.value.describe()
        ));
        problems.push(
            problem
                .at(&node.place)
                .label("not a table")
                .help(format!("write [[{key}]] on a line of its own")),
        );
    };
    let Value::List(items) = &node.value else {
        not_a_list(node, problems);
        return Vec::new();
    };
    let mut found = Vec::new();
    for (number, item) in items.iter().enumerate() {
        match &item.value {
            Value::Table(table) => {
                let mut place = item.place.clone();
                // Its first bracket: the rest may be long.
                place.span.end = place.span.end.min(place.span.start + 1);
                found.push(Section {
                    path: format!("{key}[{number}]"),
                    table,
                    place: Some(place),
                });
            }
            _ => not_a_list(item, problems),
        }
    }
    found
}

/// A length along a track, m: positive, or zero if it may be.
fn length(section: &Section<'_>, key: &str, or_zero: bool, problems: &mut Problems) -> Option<f64> {
    let node = section.require(key, &format!("write for example {key} = \"100 ft\""), problems)?;
    let path = section.path_of(key);
    let text = match &node.value {
        Value::Text(text) => text.clone(),
        other => {
            let problem = Problem::new(format!(
                "`{path}` is {}; a length in quotes is expected",
                other.describe()
            ));
            problems.push(
                problem
                    .at(&node.place)
                    .label("a length")
                    .help(format!("write for example {key} = \"100 ft\"")),
            );
            return None;
        }
    };
    match Quantity::parse_as(&text, Kind::Length) {
        Ok(quantity) => {
            let value = quantity.to_si();
            if (value > 0.0 || (or_zero && value == 0.0)) && value <= LONGEST {
                return Some(value);
            }
            let must = if or_zero { "zero or positive" } else { "positive" };
            let problem = Problem::new(format!(
                "`{path}` is {quantity}; it must be {must}, at most 1000 km"
            ));
            problems.push(problem.at(&node.place).label(must));
        }
        Err(error) => {
            problems.push(crate::case::section::unit_problem(
                &error,
                &path,
                Kind::Length,
                &node.place,
            ));
        }
    }
    None
}

fn optional_length(section: &Section<'_>, key: &str, default: f64, problems: &mut Problems) -> Option<f64> {
    match section.table.get(key) {
        Some(_) => length(section, key, false, problems),
        None => Some(default),
    }
}

fn optional<T>(
    section: &Section<'_>,
    key: &str,
    default: T,
    read: impl FnOnce(&Section<'_>) -> Option<T>,
) -> Option<T> {
    match section.table.get(key) {
        Some(_) => read(section),
        None => Some(default),
    }
}

fn segment(section: &Section<'_>, problems: &mut Problems) -> Option<Segment> {
    let kinds = ["tangent", "spiral", "curve"];
    let given: Vec<&str> = kinds
        .into_iter()
        .filter(|kind| section.table.get(kind).is_some())
        .collect();
    let [kind] = given.as_slice() else {
        let message = format!(
            "`{}` must have one of tangent, spiral, curve with its length",
            section.path
        );
        let problem = Problem::new(message)
            .label("which one?")
            .help("write for example tangent = \"500 ft\"");
        problems.push(match &section.place {
            Some(place) => problem.at(place),
            None => problem,
        });
        return None;
    };
    let own: &[&str] = match *kind {
        "curve" => &["curve", "degree", "radius", "direction", "superelevation"],
        other => std::slice::from_ref(match other {
            "spiral" => &"spiral",
            _ => &"tangent",
        }),
    };
    section.allow_in(own, &[], "a track", problems);
    let along = length(section, kind, false, problems);
    match *kind {
        "tangent" => return Some(Segment::Tangent(along?)),
        "spiral" => return Some(Segment::Spiral(along?)),
        _ => {}
    }
    let turn = optional(section, "direction", 1.0, |section| {
        section.choice("direction", TURNS, problems)
    });
    let range = Range::Between(-0.5, 0.5, "below 0.5 m");
    let superelevation = match section.table.get("superelevation") {
        Some(_) => section
            .quantity("superelevation", Kind::Length, range, problems)
            .map(|height| height.to_si()),
        None => Some(0.0),
    };
    let curvature = match (section.table.get("degree"), section.table.entry("radius")) {
        (Some(_), Some(second)) => {
            let problem = Problem::new(format!("`{}` has both `degree` and `radius`", section.path));
            problems.push(
                problem
                    .at(&second.key_place)
                    .label("one of them")
                    .help("leave one of them out"),
            );
            None
        }
        (None, Some(_)) => length(section, "radius", false, problems).map(|radius| 1.0 / radius),
        _ => {
            let range = Range::Between(0.0, 1.0, "between 0 deg and 57 deg, for a chord of 100 ft");
            let degree = section.quantity("degree", Kind::Angle, range, problems);
            degree.map(|degree| CurveElements::of_degree(degree.to_si(), 0.0).curvature)
        }
    };
    let (turn, superelevation) = (turn?, superelevation?);
    let elements = CurveElements {
        curvature: turn * curvature?,
        // Of the outer rail: the right one in curves to the left.
        superelevation: turn * superelevation,
    };
    Some(Segment::Curve(along?, elements))
}

fn irregularity(section: &Section<'_>, problems: &mut Problems) -> Option<Placed> {
    let (shape, spectrum) = (section.table.get("shape"), section.table.get("spectrum"));
    let irregularity = match (shape, spectrum) {
        (Some(_), None) => shaped(section, problems).map(Irregularity::Shape),
        (None, Some(_)) => realized(section, problems).map(Irregularity::Spectrum),
        _ => {
            let message = format!("`{}` must have either `shape` or `spectrum`", section.path);
            let help = format!(
                "shapes are {}; spectra are {}",
                SHAPES.join(", "),
                SPECTRA.join(", ")
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

/// The text of a name among others.
fn named<'t>(section: &Section<'t>, key: &str, names: &[&str], problems: &mut Problems) -> Option<&'t str> {
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

/// A whole number.
fn whole(section: &Section<'_>, key: &str, default: u64, problems: &mut Problems) -> Option<u64> {
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

/// An amplitude, depth or offset, m: either sign.
fn size(section: &Section<'_>, key: &str, problems: &mut Problems) -> Option<f64> {
    let range = Range::Between(-1.0, 1.0, "below 1 m");
    section
        .quantity(key, Kind::Length, range, problems)
        .map(|size| size.to_si())
}

fn shaped(section: &Section<'_>, problems: &mut Problems) -> Option<Shape> {
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

fn realized(section: &Section<'_>, problems: &mut Problems) -> Option<Realization> {
    let spectrum = named(section, "spectrum", &SPECTRA, problems)?;
    let keys = [
        "spectrum",
        "class",
        "rails",
        "direction",
        "shortest",
        "longest",
        "terms",
        "taper",
        "seed",
    ];
    section.allow_in(&keys, &[], "a track", problems);
    let class = whole(section, "class", 4, problems)?.min(255) as u8;
    let spectrum = match spectrum {
        "fra_vertical" => Spectrum::FraVertical(class),
        "fra_lateral" => Spectrum::FraLateral(class),
        "fra_cross_level" => Spectrum::FraCrossLevel(class),
        "erri_vertical_low" => Spectrum::ErriVerticalLow,
        _ => Spectrum::ErriVerticalHigh,
    };
    let shortest = optional_length(section, "shortest", 1.5, problems);
    let longest = optional_length(section, "longest", 91.44, problems);
    let taper = optional_length(section, "taper", 30.0, problems);
    let terms = whole(section, "terms", 1000, problems);
    let seed = whole(section, "seed", 1, problems);
    let made = Realization::new(spectrum, [shortest?, longest?], terms? as usize, taper?, seed?);
    made.map_err(|error| {
        let problem = Problem::new(format!("`{}`: {error}", section.path));
        problems.push(match &section.place {
            Some(place) => problem.at(place).label("this spectrum"),
            None => problem,
        });
    })
    .ok()
}
