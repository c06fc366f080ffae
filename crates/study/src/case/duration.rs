//! Checks of a run's duration against its output interval and its tables.

use input::limits;
use quantity::Quantity;

use super::document::NeighbourSection;
use super::problem::{Problem, Problems};
use super::section::CaseSection;
use super::tables::Tables;
use super::tree::TableNode;
use super::{defaults, motion};

/// Notes an output interval that is longer than the run, or gives too many rows.
pub(crate) fn check_rows(
    s: &CaseSection<'_>,
    duration: &Quantity,
    interval: &Quantity,
    problems: &mut Problems,
) {
    let problem = if interval.to_si() > duration.to_si() {
        let message =
            format!("`simulation.output_interval` ({interval}) is longer than the duration ({duration})");
        let help = "write an interval that is shorter, for example \"0.01 s\", or a longer duration";
        Some(Problem::new(message).label("longer than the run").help(help))
    } else if duration.to_si() / interval.to_si() >= limits::OUTPUT_ROWS as f64 {
        let most = limits::OUTPUT_ROWS;
        let message = format!("{duration} in steps of {interval} are more than {most} output times");
        let least = duration.to_si() / (most / 2) as f64;
        let help = format!("write a longer interval, for example \"{least:.1e} s\"");
        Some(Problem::new(message).label("too short").help(help))
    } else {
        None
    };
    // Shown where the user wrote one of the two, not in the thesis's values.
    let mut places = ["output_interval", "duration"]
        .into_iter()
        .filter_map(|key| s.table.place_of(key));
    let place = places.find(|place| place.source.name() != defaults::SOURCE);
    problems.extend(problem.map(|problem| match place {
        Some(place) => problem.at(place),
        None => problem,
    }));
}

/// Notes tables of motions that do not last as long as the run.
pub(super) fn check_cover(
    section: &str,
    neighbour: &NeighbourSection,
    duration: &Quantity,
    tree: &TableNode,
    tables: Tables<'_>,
    problems: &mut Problems,
) {
    for (key, motion) in NeighbourSection::COORDINATES.iter().zip(&neighbour.coordinates) {
        check_motion_covers(
            &format!("{section}.{key}"),
            motion,
            duration,
            tree,
            tables,
            problems,
        );
    }
}

/// Notes a table in a motion that does not last as long as the run.
pub(crate) fn check_motion_covers(
    path: &str,
    motion: &motion::CaseMotion,
    duration: &Quantity,
    tree: &TableNode,
    tables: Tables<'_>,
    problems: &mut Problems,
) {
    for table in motion.tables() {
        let (Some([first, _]), Some([last, _])) = (table.rows.first(), table.rows.last()) else {
            continue;
        };
        if first.to_si() <= 0.0 && last.to_si() >= duration.to_si() {
            continue;
        }
        let message = match &table.file {
            Some(file) if !tables.may_quote() => {
                format!("`{path}`: {file} does not last from 0 to {duration}, as the run does")
            }
            _ => format!("`{path}` is given from {first} to {last}, but the run lasts from 0 to {duration}"),
        };
        let help = "add rows to the table, or shorten simulation.duration";
        let problem = Problem::new(message).label("does not cover the run").help(help);
        problems.push(match tree.place_of(path) {
            Some(place) => problem.at(place),
            None => problem,
        });
    }
}
