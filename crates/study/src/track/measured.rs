//! Measured tables in track files: irregularities, and the center line.

use std::path::PathBuf;

use input::file::Expected;
use input::limits;
use quantity::{Kind, Quantity, SixDigits};
use wheelrail::track::{
    CenterLine, Form, Irregularity, LONGEST_GAP, MeasuredError, MeasuredTable, Placed, Reading,
};

use super::bands::{self, BANDS};
use super::columns::{self, RecordingKeys};
use super::irregularity::named;
use super::landxml;
use super::{Notes, length, optional_length};
use crate::case::Tables;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names};
use crate::case::tables::NamedFile;
use crate::case::tree::{NodeValue, TreeNode};

/// What the values of a column are.
pub(super) const FORMS: [&str; 2] = ["space_curve", "mid_chord"];
const SIGNS: Names<bool> = &[("row", false), ("usual", true)];
const CANT_UNITS: Names<f64> = &[
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("m", 1.0),
    ("in", 0.0254),
    ("ft", 0.3048),
];
const BEYOND: Names<bool> = &[("level", true)];

/// Returns a mistake in a measured table, shown where the track file names it.
fn wrong(section: &CaseSection<'_>, tables: Tables<'_>, error: &MeasuredError) -> Problem {
    let path = section.path_of("table");
    let problem = match tables.may_quote() {
        true => Problem::new(format!("`{path}`: {error}")).help(error.remedy()),
        false => Problem::of_unquoted(
            &path,
            "the table",
            error.line(),
            "no measured track as it is needed here",
        ),
    };
    match section.table.place_of("table") {
        Some(place) => problem.at(place).label("this table"),
        None => problem,
    }
}

/// Returns the place of the file that a section names as its table.
fn located(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    text: &str,
    problems: &mut Problems,
) -> Option<PathBuf> {
    match tables.locate(text) {
        Ok(path) => Some(path),
        Err(refused) => {
            let message = format!(
                "`{}`: {} {}",
                section.path_of("table"),
                tables.shown(text),
                refused.reason
            );
            let problem = Problem::new(message).help(refused.help);
            problems.push(match section.table.place_of("table") {
                Some(place) => problem.at(place).label("this table"),
                None => problem,
            });
            None
        }
    }
}

/// Returns the table that a section names, beside the track file.
fn table(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    usual: &RecordingKeys,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<MeasuredTable> {
    let (text, _) = section.text("table", problems)?;
    let keys = RecordingKeys::read(section, usual, problems)?;
    if let (Some(signs), false) = (section.table.entry("signs"), keys.columns.is_empty()) {
        let problem = Problem::new(format!("`{}` has no effect", section.path_of("signs")));
        let problem = problem.at(&signs.key_place).label("not used");
        problems.push(problem.help("each of the [columns] has its own sign; leave it out"));
        return None;
    }
    let signs_known = match section.table.get("signs") {
        Some(_) => section.choice("signs", SIGNS, problems)?,
        None => false,
    };
    let longest_gap = optional_length(section, "gaps", LONGEST_GAP, problems)?;
    let path = located(section, tables, text, problems)?;
    let reading = Reading {
        signs_known,
        longest_gap,
        columns: keys.columns,
        running: keys.running,
        equations: keys.equations,
    };
    let table = MeasuredTable::read(&path, &reading);
    notes.files.push(NamedFile {
        key: "table",
        typed: text.to_owned(),
        path,
        listed: Vec::new(),
    });
    table
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()
}

/// Returns the irregularities of a measured table; `end` is the length of the track, m.
pub(super) fn irregularities(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    usual: &RecordingKeys,
    end: Option<f64>,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<Vec<Placed>> {
    let keys = [
        "table", "form", "signs", "gaps", "chord", "shortest", "longest", "band", "taper", "start", "beyond",
    ];
    section.allow_in(&[&keys, &columns::KEYS[..]].concat(), &[], "a track", problems);
    let help = "write form = \"space_curve\" if the columns are the rails' own offsets; mid-chord offsets, \
                as track geometry cars and inspectors give them, are form = \"mid_chord\"";
    section.require("form", help, problems)?;
    let form = match named(section, "form", &FORMS, problems)? {
        "mid_chord" => {
            let chord = length(section, "chord", false, problems);
            let shortest = length(section, "shortest", false, problems);
            let longest = length(section, "longest", false, problems);
            Form::MidChord {
                chord: chord?,
                wavelengths: [shortest?, longest?],
            }
        }
        _ => Form::SpaceCurve,
    };
    let band = band(section, form, problems)?;
    let start = match section.table.get("start") {
        Some(_) => length(section, "start", true, problems),
        None => Some(0.0),
    };
    let taper = optional_length(section, "taper", 30.0, problems);
    let level = match section.table.get("beyond") {
        Some(_) => section.choice("beyond", BEYOND, problems),
        None => Some(false),
    };
    let table = table(section, tables, usual, notes, problems)?;
    let (start, taper) = (start?, taper?);
    let last = table.range()[1] + start;
    if let (Some(false), Some(end)) = (level, end)
        && last < end - 0.5
    {
        let problem = Problem::new(format!(
            "`{}` ends at {:.1} ft, but the track is {:.1} ft long",
            section.path_of("table"),
            last / 0.3048,
            end / 0.3048
        ))
        .help(
            "shorten the track, give a longer table, or write beyond = \"level\" for perfect rails after it",
        );
        problems.push(match section.table.place_of("table") {
            Some(place) => problem.at(place).label("shorter than the track"),
            None => problem,
        });
        return None;
    }
    level?;
    notes.doubts.extend(table.filled());
    let placed = table
        .irregularities(form, start, taper)
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()?;
    if let Some(band) = band {
        let name = section.text("table", problems)?.0;
        notes.doubts.extend(doubts_of_band(tables, name, band, &placed));
    }
    Some(placed)
}

/// Returns the wavelengths (m) to which space curves were filtered before they were written, if they were.
fn band(section: &CaseSection<'_>, form: Form, problems: &mut Problems) -> Option<Option<[f64; 2]>> {
    let Some(entry) = section.table.entry("band") else {
        return Some(None);
    };
    let path = section.path_of("band");
    let help = "write band = \"D1\" (3 m to 25 m), \"D2\" (25 m to 70 m), \"D3\" (70 m to 150 m), or \
                [\"3 m\", \"25 m\"]";
    let refuse = |message: String, label: &str, problems: &mut Problems| {
        problems.push(
            Problem::new(message)
                .at(&entry.node.place)
                .label(label)
                .help(help),
        );
        None
    };
    if form != Form::SpaceCurve {
        let message =
            format!("`{path}` is of space curves: offsets are inverted from `shortest` to `longest`");
        return refuse(message, "not used", problems);
    }
    match &entry.node.value {
        NodeValue::Text(text) => match BANDS.iter().find(|band| band.name == text) {
            Some(band) => Some(Some(band.wavelengths)),
            None => refuse(format!("`{path}` cannot be \"{text}\""), "no band", problems),
        },
        NodeValue::List(ends) => {
            let length = |node: &TreeNode| match &node.value {
                NodeValue::Text(text) => Quantity::parse_as(text, Kind::Length).ok(),
                _ => None,
            };
            let ends: Option<Vec<f64>> = ends.iter().map(|node| Some(length(node)?.to_si())).collect();
            match ends.as_deref() {
                Some(&[shortest, longest]) if shortest > 0.0 && shortest < longest && longest <= 1e4 => {
                    Some(Some([shortest, longest]))
                }
                _ => refuse(
                    format!("`{path}` is no band"),
                    "two lengths, the shorter one first",
                    problems,
                ),
            }
        }
        other => refuse(format!("`{path}` is {}", other.describe()), "no band", problems),
    }
}

/// Returns what filtered space curves lack, and whether they are filtered as stated.
fn doubts_of_band(
    tables: Tables<'_>,
    name: &str,
    [shortest, longest]: [f64; 2],
    placed: &[Placed],
) -> Vec<String> {
    /// Distance of the rows that are examined, m, and how many there are at most.
    const ROWS: (f64, f64) = (0.25, 4e6);
    /// Largest part of longer waves in values that were filtered.
    const FILTERED: f64 = 0.25;
    let name = tables.shown(name);
    let name_of_band = BANDS.iter().find(|band| band.wavelengths == [shortest, longest]);
    let band = name_of_band.map_or(String::new(), |band| format!("{}, ", band.name));
    let [short, long] = [shortest, longest].map(SixDigits);
    let mut doubts = vec![format!(
        "{name} holds waves of {band}{short} m to {long} m; the track has no others of it: a car meets \
         waves of {long} m {:.1} times a second at 60 mph",
        26.8224 / longest
    )];
    let beyond = placed.iter().filter_map(|own| match &own.irregularity {
        Irregularity::Samples(samples) => {
            let [first, last] = samples.range();
            let spacing = ROWS.0.max((last - first) / ROWS.1).min(longest);
            let rows = ((last - first) / spacing) as usize;
            let values: Vec<f64> = (0..=rows)
                .map(|k| samples.at(first + k as f64 * spacing)[0])
                .collect();
            bands::share_beyond(&values, spacing, longest)
        }
        _ => None,
    });
    let most = beyond.fold(0.0, f64::max);
    if most > FILTERED {
        doubts.push(format!(
            "{name} is said to end at {long} m, but {:.0} % of its standard deviation lies in waves longer \
             than {} m: state the band of its filter, or leave `band` out",
            100.0 * most,
            SixDigits(3.0 * longest)
        ));
    }
    doubts
}

/// Returns the center line of a measured table.
pub(super) fn center_line(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    usual: &RecordingKeys,
    rail_distance: f64,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<CenterLine> {
    if let Some((name, _)) = section.text("table", problems)
        && name.to_ascii_lowercase().ends_with(".xml")
    {
        return alignment(section, tables, name, rail_distance, notes, problems);
    }
    let keys = [&["table", "signs", "gaps"], &columns::KEYS[..]].concat();
    section.allow_in(&keys, &[], "a track", problems);
    let table = table(section, tables, usual, notes, problems)?;
    notes.doubts.extend(table.filled());
    table
        .center_line(rail_distance)
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()
}

/// Returns the center line of an alignment in LandXML.
fn alignment(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    file: &str,
    rail_distance: f64,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<CenterLine> {
    const ALIGNMENT: Expected = Expected {
        what: "alignment (LandXML)",
        types: &[],
        most: limits::TEXT_FILE,
    };
    section.allow_in(&["table", "alignment", "cant_unit"], &[], "a track", problems);
    let name = match section.table.get("alignment") {
        Some(_) => Some(section.text("alignment", problems)?.0),
        None => None,
    };
    let unit = match section.table.get("cant_unit") {
        Some(_) => Some(section.choice("cant_unit", CANT_UNITS, problems)?),
        None => None,
    };
    let path = located(section, tables, file, problems)?;
    let text = input::file::read_text(&path, &ALIGNMENT).map_err(|error| landxml::LandXmlError {
        line: 0,
        found: error.to_string(),
        remedy: "check the path and the file",
    });
    notes.files.push(NamedFile {
        key: "table",
        typed: file.to_owned(),
        path,
        listed: Vec::new(),
    });
    match text.and_then(|text| landxml::center_line(&text, name, unit, rail_distance)) {
        Ok(read) => {
            notes.doubts.extend(read.doubts);
            Some(read.line)
        }
        Err(error) => {
            let path = section.path_of("table");
            let line = Some(error.line).filter(|line| *line > 0);
            let problem = match tables.may_quote() {
                true => {
                    let line = line.map_or(String::new(), |line| format!(":{line}"));
                    let file = tables.shown(file);
                    Problem::new(format!("`{path}`: {file}{line}: {}", error.found)).help(error.remedy)
                }
                false => {
                    Problem::of_unquoted(&path, "the alignment", line, "no alignment as it is read here")
                }
            };
            problems.push(match section.table.place_of("table") {
                Some(place) => problem.at(place).label("this alignment"),
                None => problem,
            });
            None
        }
    }
}
