//! The thesis's statements over the parameters that the thesis leaves open: the points are computed, kept,
//! and judged.

use std::collections::BTreeMap;
use std::path::Path;

use nucars::truck::Choices;
use rayon::prelude::*;
use reproduction::agreement::TruckOutcome;
use reproduction::claims::needs_truck;
use reproduction::sensitivity::{
    self, FILE_NAME, FOLDER, PointOutcome, PointPlace, PointsFile, PointsFileError, Sensitivity, Space,
};
use study::half_truck::catalog;

use super::Arguments;
use super::trucks::DURATION;
use crate::execute::compute;
use crate::failure::{Failure, Message};
use crate::interrupt;
use crate::progress::{Progress, Steady};

impl From<PointsFileError> for Failure {
    fn from(error: PointsFileError) -> Self {
        match error {
            PointsFileError::File { .. } => Self::Failed(error.into()),
            PointsFileError::Changed { .. } | PointsFileError::Busy { .. } => Self::Input(error.into()),
        }
    }
}

/// Computes the points that are not kept yet, as many at a time as the pool has threads, and says what all of
/// them say.
///
/// Points come before the runs of the report, so that the same command goes on when it was stopped.
pub fn explore(arguments: &Arguments, points: u64, pool: &rayon::ThreadPool) -> Result<Sensitivity, Failure> {
    let space = Space::default();
    let folder = arguments.out.join(FOLDER);
    let kept = PointsFile::open(&folder, &space, arguments.force)?;
    let places = space.places(points);
    let missing = kept.missing(&places);
    let before = places.len() - missing.len();
    interrupt::stops(
        "stopping: the points under way are finished and kept (once more: ends at once)",
        &stopped(&folder),
    );
    let mut found: BTreeMap<PointPlace, PointOutcome> = places
        .iter()
        .filter_map(|place| Some((*place, kept.found(*place)?.clone())))
        .collect();
    if !missing.is_empty() {
        let trucks = pool.install(half_trucks)?;
        let progress = Steady::new("points", places.len() as u64, before as u64, arguments.quiet);
        let one = |place: PointPlace| -> Result<Option<(PointPlace, PointOutcome)>, Failure> {
            if interrupt::wanted() {
                return Ok(None);
            }
            let found = sensitivity::compute(&space.set(place), &trucks);
            kept.keep(&space, place, &found)?;
            progress.done();
            Ok(Some((place, found)))
        };
        let computed: Vec<Result<Option<(PointPlace, PointOutcome)>, Failure>> =
            pool.install(|| missing.into_par_iter().with_max_len(1).map(one).collect());
        progress.finish();
        for computed in computed {
            found.extend(computed?);
        }
    }
    if interrupt::wanted() {
        let kept = found.len();
        let message = format!(
            "{}: {kept} of {} points are kept in {}",
            interrupt::REASON,
            places.len(),
            folder.display()
        );
        let advice = "the same command goes on from there";
        return Err(Failure::Interrupted(Message::new(message, advice).into()));
    }
    Ok(Sensitivity::of(&space, points, &found))
}

/// Returns the message about the points kept when the program ends at once.
fn stopped(folder: &Path) -> String {
    let folder = folder.display();
    format!("the points that ended are kept in {folder}. The same command goes on from there.")
}

/// Returns the runs of the half-truck that statements are decided from. They have nothing of what is open.
fn half_trucks() -> Result<Vec<TruckOutcome>, Failure> {
    let progress = Progress::new(0, true);
    let entries = catalog::entries();
    let needed = entries.into_par_iter().with_max_len(1).filter(needs_truck);
    needed
        .map(|entry| {
            let case = entry.case(&Choices::default(), DURATION).map_err(|error| {
                let message = format!("the files of {} make no model: {error}", entry.name());
                Failure::Failed(Message::new(message, "").into())
            })?;
            Ok((entry, compute(&case, &progress)?.result))
        })
        .collect()
}

/// Returns the findings in short.
pub fn in_short(found: &Sensitivity) -> String {
    let [always, mostly, seldom, never, open] = found.extents;
    let mut text = format!(
        "Over {} points of what the thesis leaves open, {always} statements hold always, {mostly} mostly, \
         {seldom} seldom, {never} never; {open} cannot be decided: {FILE_NAME}.",
        found.points
    );
    if !found.unsound.is_empty() {
        let runs: usize = found.unsound.values().map(Vec::len).sum();
        text += &format!(
            " {runs} runs at {} points failed or stopped; statements that need them are not decided there.",
            found.unsound.len()
        );
    }
    text
}
