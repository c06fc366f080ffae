//! The section `[track]`: what a track file says, or the name of one.

use std::path::Path;

use wheelrail::track::Track;

use crate::case::Tables;
use crate::case::field::quoted;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::CaseSection;
use crate::case::tree::{self, NodeValue, TableNode};
use crate::reader::CaseReader;
use crate::track::{Notes, ReadTrack, Support, TrackFile, of_section, text_of};

/// Length of a track that is not given, ft.
const USUAL: f64 = 5000.0;

/// Returns a straight track without irregularities of a length (m).
pub(crate) fn tangent(length: f64) -> Option<Track> {
    Some(TrackFile::straight(length).ok()?.track)
}

/// Reads the track.
pub(crate) fn track(r: &mut CaseReader<'_>) -> Option<ReadTrack> {
    r.section(
        "track",
        "The track: the keys of a track file, or file = \"my_track.toml\". Rails are at rest; what they lie \
         on is track.support.",
    );
    let Some(section) = r.given() else {
        // As it is written where it is given.
        let segments = format!("[\n    {{ tangent = \"{USUAL} ft\" }},\n]");
        r.write("segments", [segments.clone(), segments], meaning("segments"));
        return Some(ReadTrack {
            track: tangent(USUAL * 0.3048)?,
            support: Support::usual(),
            class: None,
            notes: Notes::default(),
        });
    };
    // Its keys are read by the reader of track files.
    r.known_elsewhere();
    if let Some(entry) = section.table.entry("file") {
        for own in section.table.entries.iter().filter(|own| own.key != "file") {
            let message = format!(
                "`track.{}` has no effect: `track.file` is the whole track",
                own.key
            );
            let problem = Problem::new(message).at(&own.key_place).label("not used");
            let help = "leave out one of the two, or write this into the track file";
            r.problems.push(problem.help(help));
        }
        let NodeValue::Text(file) = &entry.node.value else {
            let message = format!(
                "`track.file` is {}; a name is expected",
                entry.node.value.describe()
            );
            r.problem("track.file", Problem::new(message).label("not text"));
            return None;
        };
        let (table, found) = from_file(r, file)?;
        r.write_typed("file", quoted(file), "a track file");
        for own in &table.entries {
            r.write_embedded(&own.key, own.node.value.to_toml(), meaning(&own.key));
        }
        return Some(found);
    }
    let found = of_section(&section, r.tables(), r.problems);
    for own in &section.table.entries {
        let toml = own.node.value.to_toml();
        r.write(&own.key, [toml.clone(), toml], meaning(&own.key));
    }
    found
}

/// Returns the meaning of a key of a track file, in short.
fn meaning(key: &str) -> &'static str {
    match key {
        "segments" => "one after the other: tangent, spiral, curve",
        "irregularities" => {
            "shapes, spectra, measured tables; `start` is the distance of the lowest point of the first \
             joint, and of the beginning of a sine, dip or jog"
        }
        "support" => "what the rails lie on: rigid or sprung",
        "name" => "of the track",
        "class" => "the class that the track is said to have (49 CFR 213); `wedgelab track show` compares",
        _ => "as in a track file",
    }
}

/// Reads a track file; measured tables that it names are looked for from its folder. Of one that must not be
/// quoted, messages tell the place and the kind of a mistake.
fn from_file(r: &mut CaseReader<'_>, file: &str) -> Option<(TableNode, ReadTrack)> {
    let tables = r.tables();
    let mut found = Problems::new();
    let read = read_file(tables, file, &mut found);
    let place = r.at("track.file").map(|node| node.place.clone());
    let shown = tables.shown(file);
    r.problems.append(found.map(|problem| match &place {
        Some(place) if !tables.may_quote() => problem.without_quoting(&shown, "track.file", place),
        Some(place) if problem.line_and_column().is_none() => problem.moved_to(place),
        _ => problem,
    }));
    read
}

fn read_file(tables: Tables<'_>, file: &str, problems: &mut Problems) -> Option<(TableNode, ReadTrack)> {
    let shown = tables.shown(file);
    let path = match tables.locate(file) {
        Ok(path) => path,
        Err(refused) => {
            let problem = Problem::new(format!("`track.file`: {shown} {}", refused.reason));
            problems.push(problem.label("this file").help(refused.help));
            return None;
        }
    };
    let text = match text_of(&path) {
        Ok(text) => text,
        Err(error) => {
            match tables.may_quote() {
                true => problems.append(error.into_problems()),
                false => problems.push(Problem::of_unquoted("track.file", &shown, None, "no track file")),
            }
            return None;
        }
    };
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let tree = match tree::parse(&TomlSource::new(&shown, text)) {
        Ok(tree) => tree,
        Err(own) => {
            problems.append(own);
            return None;
        }
    };
    let top = CaseSection {
        path: String::new(),
        table: &tree,
        place: None,
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let found = of_section(&top, tables.beside(folder), problems)?;
    Some((tree, found))
}
