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
//! [[irregularities]]
//! table = "measured.csv"      # foot by foot, see wheelrail::track::measured
//! form = "space_curve"
//! [columns]                   # if its titles are others
//! milepost = { name = "Milepost" }
//! left_profile = { name = "Left Prof 62", unit = "in" }
//! [support]
//! kind = "sprung"             # or rigid
//! ```

pub mod bands;
mod columns;
mod irregularity;
mod landxml;
mod measured;
mod spectrum;
mod support;

use std::path::Path;

use input::file::Expected;
use input::{FileType, limits};
use quantity::{Kind, Quantity};
use wheelrail::track::class_limits::HIGHEST_COVERED;
use wheelrail::track::{
    CLEARANCE, CenterLine, CurveElements, Placed, Segment, SpiralForm, Track, TrackError,
};

use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::{CaseSection, Names, Range};
use crate::case::tree::{self, NodeValue, TableNode};
use crate::case::{CASE_TABLES, CaseError, STUDY_KEYS, Tables, name, text_of_file};

use crate::case::tables::NamedFile;

use columns::RecordingKeys;
use irregularity::irregularity;
pub use support::Support;

/// A track with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackFile {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The track.
    pub track: Track,
    /// The support of its rails.
    pub support: Support,
    /// The class (49 CFR 213) that the track is said to have, from 1.
    pub class: Option<usize>,
    /// Warnings of reading, such as gaps of a recording that were filled.
    pub doubts: Vec<String>,
}

const KEYS: [&str; 13] = [
    "name",
    "title",
    "class",
    "rail_distance",
    "support",
    "center_line",
    "segments",
    "grades",
    "irregularities",
    "columns",
    "direction",
    "sides",
    "station_equations",
];
const TURNS: Names<f64> = &[("left", 1.0), ("right", -1.0)];
const SPIRALS: Names<SpiralForm> = &[
    ("clothoid", SpiralForm::Clothoid),
    ("bloss", SpiralForm::Bloss),
    ("cubic_parabola", SpiralForm::CubicParabola),
    ("sine", SpiralForm::Sine),
    ("cosine", SpiralForm::Cosine),
    ("helmert", SpiralForm::Helmert),
    // Older names, which elsewhere mean other spirals.
    ("linear", SpiralForm::Clothoid),
    ("cubic", SpiralForm::Bloss),
];
const FOOT: f64 = 0.3048;
/// The longest track, m.
const LONGEST: f64 = 1e6;

/// The expected track file.
const TRACK_FILE: Expected = Expected {
    what: "track file",
    // That a case or a study is none, the keys of its tree say.
    types: &[FileType::Track, FileType::Case, FileType::Study],
    most: limits::TEXT_FILE,
};

/// Returns the text of a track file.
///
/// # Errors
/// There is no such file, or it cannot be read, or it is something else, or too large.
pub(crate) fn text_of(path: &Path) -> Result<String, CaseError> {
    let missing = "check the path; docs/wheelrail.md has a track file to begin with";
    text_of_file(path, &TRACK_FILE, missing)
}

impl TrackFile {
    /// Returns straight perfect track of a length (m) on rigid rails.
    ///
    /// # Errors
    /// The length is not positive.
    pub fn straight(length: f64) -> Result<Self, TrackError> {
        Ok(Self {
            name: "straight".to_owned(),
            title: String::new(),
            track: Track {
                center_line: CenterLine::new(&[Segment::Tangent(length)], 59.5 * 0.0254, &[])?,
                irregularities: Vec::new(),
            },
            support: Support::Rigid,
            class: None,
            doubts: Vec::new(),
        })
    }

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
        let sections = CASE_TABLES.iter();
        let mut foreign = sections
            .chain(STUDY_KEYS.iter())
            .filter_map(|key| tree.entry(key));
        if let (None, Some(found)) = (tree.entry("segments"), foreign.next()) {
            let problem = Problem::new(format!("{source} is no track file, but a case or a study"));
            let problem = problem.at(&found.key_place).label("no track has this");
            let help = "a track file begins with [[segments]]; docs/wheelrail.md has one to begin with";
            return Err(problem.help(help).into());
        }
        let mut problems = Problems::new();
        let file = read(&tree, source, &mut problems);
        file.filter(|_| problems.is_empty())
            .ok_or_else(|| CaseError::new(problems))
    }
}

fn read(tree: &TableNode, source: &str, problems: &mut Problems) -> Option<TrackFile> {
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    let name = name::read(&top, name::of_source(source), problems);
    let title = match tree.get("title") {
        Some(_) => top.text("title", problems).map_or("", |(text, _)| text),
        None => "",
    };
    let folder = Path::new(source).parent().unwrap_or(Path::new(""));
    let read = of_section(&top, Tables::anywhere(folder), problems);
    let ReadTrack {
        track,
        support,
        class,
        notes,
    } = read?;
    Some(TrackFile {
        name: name?,
        title: title.to_owned(),
        track,
        support,
        class,
        doubts: notes.doubts,
    })
}

/// A track as it is read, with the support of its rails and the warnings of reading.
pub(crate) struct ReadTrack {
    pub track: Track,
    pub support: Support,
    /// The stated class.
    pub class: Option<usize>,
    pub notes: Notes,
}

/// What is found on the way through a track's keys.
#[derive(Default)]
pub(crate) struct Notes {
    /// Warnings of reading.
    pub doubts: Vec<String>,
    /// Measured tables that were read.
    pub files: Vec<NamedFile>,
}

/// Reads what a track file says of the track and of what its rails lie on, from the file or from a table of a
/// case; `tables` says where measured tables are looked for.
pub(crate) fn of_section(
    top: &CaseSection<'_>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<ReadTrack> {
    let mut notes = Notes::default();
    let tree = top.table;
    top.allow_in(&KEYS, &[], "a track", problems);
    let rail_distance = optional_length(top, "rail_distance", 59.5 * 0.0254, problems);
    let class = match tree.get("class") {
        Some(_) => track_class(top, problems).map(Some),
        None => Some(None),
    };
    let support = match tree.get("support") {
        Some(_) => top
            .section("support", problems)
            .and_then(|section| support::support(&section, problems)),
        None => Some(Support::usual()),
    };
    let recordings = RecordingKeys::read(top, &RecordingKeys::default(), problems)?;
    let measured = match (
        tree.get("center_line"),
        tree.entry("segments").or(tree.entry("grades")),
    ) {
        (Some(_), Some(second)) => {
            let problem = Problem::new("a track has either `center_line` or `segments` with `grades`");
            problems.push(
                problem
                    .at(&second.key_place)
                    .label("and these")
                    .help("leave one of them out"),
            );
            return None;
        }
        (Some(_), None) => {
            let section = top.section("center_line", problems)?;
            Some(measured::center_line(
                &section,
                tables,
                &recordings,
                rail_distance?,
                &mut notes,
                problems,
            )?)
        }
        (None, _) => None,
    };
    if measured.is_none() {
        let help = "write [[segments]] and below it tangent = \"500 ft\"";
        top.require("segments", help, problems)?;
    }
    let segments: Vec<Option<Segment>> = top
        .tables("segments", problems)
        .iter()
        .map(|section| segment(section, problems))
        .collect();
    let grades: Vec<Option<[f64; 2]>> = top
        .tables("grades", problems)
        .iter()
        .map(|section| {
            section.allow_in(&["distance", "grade"], &[], "a track", problems);
            let distance = length(section, "distance", true, problems);
            let range = Range::Between(-0.2, 0.2, "between -0.2 and 0.2: a rise by the distance");
            let grade = section.number("grade", range, "0.01", problems);
            Some([distance?, grade?])
        })
        .collect();
    let segments: Option<Vec<Segment>> = segments.into_iter().collect();
    let grades: Option<Vec<[f64; 2]>> = grades.into_iter().collect();
    let center_line = match (measured, segments, grades, rail_distance) {
        (Some(line), ..) => Some(line),
        (None, Some(segments), Some(grades), Some(rail_distance)) => {
            let made = CenterLine::new(&segments, rail_distance, &grades);
            made.map_err(|error| problems.push(impossible(tree, &error))).ok()
        }
        _ => None,
    };
    if let Some(distances) = center_line.as_ref().and_then(CenterLine::near_itself) {
        problems.push(near_itself(tree, distances));
    }
    let end = center_line.as_ref().map(CenterLine::length);
    let irregularities: Vec<Option<Vec<Placed>>> = top
        .tables("irregularities", problems)
        .iter()
        .map(|section| match section.table.get("table") {
            Some(_) => measured::irregularities(section, tables, &recordings, end, &mut notes, problems),
            None => irregularity(section, end, problems).map(|placed| vec![placed]),
        })
        .collect();
    if let (true, Some(unused)) = (
        notes.files.is_empty() && problems.is_empty(),
        columns::KEYS.iter().find_map(|key| tree.entry(key)),
    ) {
        let problem = Problem::new(format!(
            "`{}` has no effect: this track reads no table",
            unused.key
        ));
        problems.push(
            problem
                .at(&unused.key_place)
                .label("not used")
                .help("leave it out"),
        );
    }
    let irregularities: Vec<Vec<Placed>> = irregularities.into_iter().collect::<Option<_>>()?;
    let track = Track {
        center_line: center_line?,
        irregularities: irregularities.into_iter().flatten().collect(),
    };
    Some(ReadTrack {
        track,
        support: support?,
        class: class?,
        notes,
    })
}

/// Returns the class that a track is said to have.
fn track_class(top: &CaseSection<'_>, problems: &mut Problems) -> Option<usize> {
    let class = irregularity::whole(top, "class", 0, problems)? as usize;
    if (1..=HIGHEST_COVERED).contains(&class) {
        return Some(class);
    }
    let problem = Problem::new(format!(
        "`{}` is {class}; a class from 1 to {HIGHEST_COVERED} is expected",
        top.path_of("class")
    ));
    let problem = problem.label("no such class").help(
        "classes are those of 49 CFR 213; of classes 6 to 9 only the alinement is known here, and `wedgelab \
         track show` says which of them it keeps",
    );
    problems.push(match top.table.place_of("class") {
        Some(place) => problem.at(place),
        None => problem,
    });
    None
}

/// Returns a track that comes back near itself at two distances (m).
fn near_itself(tree: &TableNode, distances: [f64; 2]) -> Problem {
    let [first, second] = distances.map(|distance| format!("{:.0} ft ({distance:.0} m)", distance / FOOT));
    let problem = Problem::new(format!(
        "at {second} the track comes within {:.0} ft of where it lies at {first}",
        CLEARANCE / FOOT
    ));
    let lies = ["segments", "center_line"];
    let problem = match lies.into_iter().find_map(|key| tree.place_of(key)) {
        Some(place) => problem.at(place).label("this center line"),
        None => problem,
    };
    problem.help(
        "wheels find their rail by place, in plan, and would be taken to the first passage: end the track \
         before it comes back, or lead it past; a lap cannot be closed",
    )
}

/// Returns a track that cannot be, shown at its segments.
fn impossible(tree: &TableNode, error: &TrackError) -> Problem {
    let problem = Problem::new(error.to_string());
    let problem = match tree.place_of("segments") {
        Some(place) => problem.at(place).label("these segments"),
        None => problem,
    };
    problem.help("segments count from 0; put a spiral between a tangent and a curve, and between two curves")
}

/// Returns a length along a track, m: positive, or zero if it may be.
fn length(section: &CaseSection<'_>, key: &str, or_zero: bool, problems: &mut Problems) -> Option<f64> {
    let node = section.require(key, &format!("write for example {key} = \"100 ft\""), problems)?;
    let path = section.path_of(key);
    let text = match &node.value {
        NodeValue::Text(text) => text.clone(),
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

fn optional_length(
    section: &CaseSection<'_>,
    key: &str,
    default: f64,
    problems: &mut Problems,
) -> Option<f64> {
    match section.table.get(key) {
        Some(_) => length(section, key, false, problems),
        None => Some(default),
    }
}

fn optional<T>(
    section: &CaseSection<'_>,
    key: &str,
    default: T,
    read: impl FnOnce(&CaseSection<'_>) -> Option<T>,
) -> Option<T> {
    match section.table.get(key) {
        Some(_) => read(section),
        None => Some(default),
    }
}

fn segment(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Segment> {
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
        "spiral" => &["spiral", "form"],
        _ => &["tangent"],
    };
    section.allow_in(own, &[], "a track", problems);
    let along = length(section, kind, false, problems);
    match *kind {
        "tangent" => return Some(Segment::Tangent(along?)),
        "spiral" => {
            let form = optional(section, "form", SpiralForm::Clothoid, |section| {
                section.choice("form", SPIRALS, problems)
            });
            return Some(Segment::Spiral(along?, form?));
        }
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
