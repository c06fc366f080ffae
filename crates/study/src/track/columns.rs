//! Recordings in track files: whose columns are which, in which direction they ran, station equations.

use wheelrail::track::stations::place_of;
use wheelrail::track::{ColumnKind, NamedColumn, Running, StationEquation};

use super::length;
use super::measured::FORMS;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names};
use crate::case::tree::NodeValue;

/// Keys that say how a recording is read: of each table, or of the track file for all of its tables.
pub(super) const KEYS: [&str; 4] = ["columns", "direction", "sides", "station_equations"];

const DIRECTIONS: Names<bool> = &[("rising", false), ("falling", true)];
const SIDES: Names<bool> = &[("rising", false), ("running", true)];
const MILE: f64 = 1609.344;

/// How recordings are read.
#[derive(Clone, Debug, Default)]
pub(super) struct RecordingKeys {
    pub columns: Vec<NamedColumn>,
    pub running: Running,
    pub equations: Vec<StationEquation>,
}

impl RecordingKeys {
    /// Reads the keys of a section; what it leaves out is as `usual` has it.
    pub(super) fn read(section: &CaseSection<'_>, usual: &Self, problems: &mut Problems) -> Option<Self> {
        let given = |key: &str| section.table.get(key).is_some();
        let columns = match given("columns") {
            true => columns(section, problems),
            false => Some(usual.columns.clone()),
        };
        let running = match (given("direction"), given("sides")) {
            (false, false) => Some(usual.running),
            (falling, own) => {
                let falling = match falling {
                    true => section.choice("direction", DIRECTIONS, problems),
                    false => Some(usual.running != Running::Rising),
                };
                let own = match own {
                    true => section.choice("sides", SIDES, problems),
                    false => Some(false),
                };
                Some(match (falling?, own?) {
                    (false, _) => Running::Rising,
                    (true, false) => Running::Falling,
                    (true, true) => Running::FallingOwnSides,
                })
            }
        };
        let equations = match given("station_equations") {
            true => section
                .tables("station_equations", problems)
                .iter()
                .map(|own| equation(own, problems))
                .collect(),
            false => Some(usual.equations.clone()),
        };
        Some(Self {
            columns: columns?,
            running: running?,
            equations: equations?,
        })
    }
}

fn columns(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Vec<NamedColumn>> {
    let own = section.section("columns", problems)?;
    let mut found = Vec::new();
    for entry in &own.table.entries {
        let mut refuse = |message: String, help: String| {
            let problem = Problem::new(message).at(&entry.key_place).label("this column");
            problems.push(problem.help(help));
        };
        let NodeValue::Table(_) = entry.node.value else {
            let path = own.path_of(&entry.key);
            refuse(
                format!("`{path}` is {}; a table is expected", entry.node.value.describe()),
                format!(
                    "write for example {} = {{ name = \"Gage\", unit = \"in\" }}",
                    entry.key
                ),
            );
            continue;
        };
        let column = own.section(&entry.key, problems)?;
        found.push(named_column(&column, &entry.key, problems));
    }
    if found.is_empty() {
        let problem = Problem::new(format!("`{}` names no column", own.path));
        problems.push(match &own.place {
            Some(place) => problem.at(place).label("empty"),
            None => problem,
        });
        return None;
    }
    found.into_iter().collect()
}

fn named_column(column: &CaseSection<'_>, quantity: &str, problems: &mut Problems) -> Option<NamedColumn> {
    column.allow_in(
        &["name", "unit", "sign", "kind", "chord"],
        &[],
        "a track",
        problems,
    );
    let help = "write name = \"...\", the title of the column in the recording";
    column.require("name", help, problems)?;
    let (name, _) = column.text("name", problems)?;
    let mut word = |key: &str| match column.table.get(key) {
        Some(_) => column.text(key, problems).map(|(text, _)| Some(text)),
        None => Some(None),
    };
    let (unit, sign) = (word("unit")?, word("sign")?);
    let kind = match column.table.get("kind") {
        None => ColumnKind::Unstated,
        Some(_) => match super::irregularity::named(column, "kind", &FORMS, problems)? {
            "mid_chord" => ColumnKind::MidChord(length(column, "chord", false, problems)?),
            _ => ColumnKind::SpaceCurve,
        },
    };
    if let (Some(entry), false) = (
        column.table.entry("chord"),
        matches!(kind, ColumnKind::MidChord(_)),
    ) {
        let problem = Problem::new(format!("`{}` has no effect", column.path_of("chord")));
        let problem = problem.at(&entry.key_place).label("not used");
        problems.push(problem.help("write kind = \"mid_chord\" beside it, or leave it out"));
    }
    NamedColumn::new(quantity, name, unit, sign, kind)
        .map_err(|[found, help]| {
            let problem = Problem::new(format!("`{}`: {found}", column.path)).help(help);
            problems.push(match &column.place {
                Some(place) => problem.at(place).label("this column"),
                None => problem,
            });
        })
        .ok()
}

fn equation(section: &CaseSection<'_>, problems: &mut Problems) -> Option<StationEquation> {
    section.allow_in(&["back", "ahead"], &[], "a track", problems);
    let mut place = |key: &str| {
        let help = format!("write for example {key} = \"MP 100 + 5341 ft\"");
        let node = section.require(key, &help, problems)?;
        let (text, _) = section.text(key, problems)?;
        let found = place_of(text, MILE);
        if found.is_none() {
            let problem = Problem::new(format!("`{}` cannot be \"{text}\"", section.path_of(key)));
            problems.push(problem.at(&node.place).label("no place along a track").help(help));
        }
        found
    };
    let (back, ahead) = (place("back"), place("ahead"));
    Some(StationEquation {
        back: back?,
        ahead: ahead?,
    })
}
