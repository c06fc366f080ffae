//! A route: a car on several tracks, in seasons, over many miles, with wheels and wedges that wear.
//!
//! Tracks and seasons have shares of the distance. Every track in every season is a run of the car; the
//! damage of a mile is the mean by their shares. The service is cut into steps: after each, wheels have the
//! profiles and wedges the depths that the step has worn, and all runs are made again.
//!
//! Limits: steps are explicit, so that a step must wear little of what it depends on; wear of a run stands
//! for that of all passages of its track. Rails keep their profiles: other cars wear them too.

mod read;
mod sum;
mod worn;

use std::path::{Path, PathBuf};

pub use sum::{OfRun, RouteStep, RouteSummary, RouteTrack, RouteWear, WedgeDepth};
pub use worn::{Worn, WornMap, WornProfile, WornWedge};

use wedge::outputs::FACES;

use crate::car::CarCase;
use crate::case::{CaseError, Problem};
use crate::models::CaseSource;

/// The profiles of wheels that wear.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WheelWear {
    /// All wheels by the mean of all: cars run both ways round.
    Mean,
    /// Each wheel by its own.
    Each,
    /// None.
    Nothing,
}

/// A track or a season: what it sets, and its share of the distance.
#[derive(Clone, Debug, PartialEq)]
pub struct RoutePart {
    /// Its name.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// Its share.
    pub share: f64,
    /// Its settings, as `--set` takes them.
    pub set: Vec<String>,
}

/// A route.
#[derive(Clone, Debug)]
pub struct Route {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The distance of service, m.
    pub service: f64,
    /// Number of steps of wear.
    pub steps: u32,
    /// The profiles that wear.
    pub wheels: WheelWear,
    /// Settings of the law by which wedges wear; none if they do not.
    pub wedges: Option<Vec<String>>,
    /// Settings of all runs.
    pub set: Vec<String>,
    /// The tracks.
    pub tracks: Vec<RoutePart>,
    /// The seasons; one without a name if there are none.
    pub seasons: Vec<RoutePart>,
    source: CaseSource,
}

/// A run of a route: a track in a season.
#[derive(Clone, Debug, PartialEq)]
pub struct RouteRun {
    /// Numbers of the track and of the season.
    pub of: [usize; 2],
    /// Its name: that of the track, and after a dot that of the season.
    pub name: String,
    /// Its share of the distance.
    pub share: f64,
}

impl Route {
    /// Reads a route from a file.
    ///
    /// # Errors
    /// It cannot be read, or something in it is wrong: all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        read::file(path)
    }

    /// Reads a route from a text that `file` names in messages; cases and tables are looked for in `folder`.
    ///
    /// # Errors
    /// Something in it is wrong: all mistakes are reported together.
    pub fn parse(file: &str, text: &str, folder: &Path) -> Result<Self, CaseError> {
        read::text(file, text, folder)
    }

    /// Returns the runs of a step.
    #[must_use]
    pub fn runs(&self) -> Vec<RouteRun> {
        let tracks = self.tracks.iter().enumerate();
        let runs = tracks.flat_map(|(t, track)| {
            self.seasons.iter().enumerate().map(move |(s, season)| RouteRun {
                of: [t, s],
                name: match season.name.is_empty() {
                    true => track.name.clone(),
                    false => format!("{}.{}", track.name, season.name),
                },
                share: track.share * season.share,
            })
        });
        runs.collect()
    }

    /// Returns the case of a run, of a car that is worn so.
    ///
    /// # Errors
    /// The worn car is none.
    pub fn case(&self, [track, season]: [usize; 2], worn: &[String]) -> Result<CarCase, CaseError> {
        let (track, season) = (&self.tracks[track], &self.seasons[season]);
        let law = self.wedges.as_deref().unwrap_or_default();
        let all = [law, &self.set, &track.set, &season.set, worn].concat();
        car_of(&self.source, &all)
    }

    /// Returns the settings with which wheels have these profiles, files in a folder, and wedges these
    /// depths.
    #[must_use]
    pub fn worn_settings(&self, worn: &Worn, folder: &Path) -> Vec<String> {
        let mut set = Vec::new();
        let placed = |file: &str| {
            std::path::absolute(folder.join(file)).unwrap_or_else(|_| PathBuf::from(file.to_owned()))
        };
        for own in &worn.profiles {
            let path = placed(&own.file());
            // A literal string of TOML: what is in it stands for itself.
            let wheel = match own.wheel.is_empty() {
                true => String::new(),
                false => format!("{}.", own.wheel),
            };
            set.push(format!("wheels.{wheel}profile='{}'", path.display()));
        }
        for own in &worn.wedges {
            for (face, depth) in FACES.into_iter().zip(own.depths) {
                set.push(format!("{}.{face}_wear=\"{:e} mm\"", own.key(), 1e3 * depth));
            }
            for map in own.maps() {
                set.push(format!(
                    "{}.{}_face.{}='{}'",
                    own.key(),
                    map.face,
                    map.key,
                    placed(&map.file).display()
                ));
            }
        }
        set
    }
}

fn car_of(source: &CaseSource, set: &[String]) -> Result<CarCase, CaseError> {
    let case = source.case(set)?;
    match case.car() {
        Some(car) => Ok((**car).clone()),
        None => {
            let message = format!("`case` is a {}; a route is one of a car", case.model());
            Err(Problem::new(message)
                .help("name the case of a car: model = \"car\"")
                .into())
        }
    }
}
