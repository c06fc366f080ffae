//! Measured tables in track files: irregularities, and the center line.

use wheelrail::track::{CenterLine, Form, LONGEST_GAP, MeasuredError, MeasuredTable, Placed, Reading};

use super::irregularity::named;
use super::{Notes, length, optional_length};
use crate::case::Tables;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Names};
use crate::case::tables::NamedFile;

const FORMS: [&str; 2] = ["space_curve", "mid_chord"];
const SIGNS: Names<bool> = &[("row", false), ("usual", true)];
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

/// Returns the table that a section names, beside the track file.
fn table(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<MeasuredTable> {
    let (text, _) = section.text("table", problems)?;
    let signs_known = match section.table.get("signs") {
        Some(_) => section.choice("signs", SIGNS, problems)?,
        None => false,
    };
    let longest_gap = optional_length(section, "gaps", LONGEST_GAP, problems)?;
    let path = match tables.locate(text) {
        Ok(path) => path,
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
            return None;
        }
    };
    let reading = Reading {
        signs_known,
        longest_gap,
    };
    let table = MeasuredTable::read(&path, reading);
    notes.files.push(NamedFile {
        key: "table",
        typed: text.to_owned(),
        path,
    });
    table
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()
}

/// Returns the irregularities of a measured table; `end` is the length of the track, m.
pub(super) fn irregularities(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    end: Option<f64>,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<Vec<Placed>> {
    let keys = [
        "table", "form", "signs", "gaps", "chord", "shortest", "longest", "taper", "start", "beyond",
    ];
    section.allow_in(&keys, &[], "a track", problems);
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
    let start = match section.table.get("start") {
        Some(_) => length(section, "start", true, problems),
        None => Some(0.0),
    };
    let taper = optional_length(section, "taper", 30.0, problems);
    let level = match section.table.get("beyond") {
        Some(_) => section.choice("beyond", BEYOND, problems),
        None => Some(false),
    };
    let table = table(section, tables, notes, problems)?;
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
    table
        .irregularities(form, start, taper)
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()
}

/// Returns the center line of a measured table.
pub(super) fn center_line(
    section: &CaseSection<'_>,
    tables: Tables<'_>,
    rail_distance: f64,
    notes: &mut Notes,
    problems: &mut Problems,
) -> Option<CenterLine> {
    section.allow_in(&["table", "signs", "gaps"], &[], "a track", problems);
    let table = table(section, tables, notes, problems)?;
    notes.doubts.extend(table.filled());
    table
        .center_line(rail_distance)
        .map_err(|error| problems.push(wrong(section, tables, &error)))
        .ok()
}
