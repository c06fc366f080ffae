//! Runs of one wheelset under a carriage on a track.
//!
//! [`Wheelset`] is what a user says: profiles, a track file, speed, load, springs. [`WheelsetCase`] is the
//! model made of it, [`run`](mod@run) runs it, [`columns`] has its table, [`summary`] its numbers,
//! [`stability`](mod@stability) how it hunts.

pub mod columns;
pub mod run;
pub mod stability;
pub mod summary;

use std::collections::BTreeMap;
use std::sync::Arc;

use quantity::{STANDARD_GRAVITY, System as Units};
use rolling::carriage::Carriage;
use rolling::rig::{Rig, RigError, RigStart, Setup, Wheels};
use rolling::wheel::Search;
use rolling::wheelset::WheelsetBody;
use thiserror::Error;
use wheelrail::contact::{ContactLaw, ContactTable, CreepLaw, PatchForm, WheelForm};
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::profile::{Profile, ProfileError, SlicedProfile};
use wheelrail::track::{RailLines, Track, TrackError};
use wheelrail::wheelset::{Layout, RigidWheelset};

use crate::car::assumptions::{of_profile, of_support};
use crate::car::not_round;
use crate::track::{Support, TrackFile};

/// Damping α of the normal forces, s/m, on rigid and on sprung track; guesses.
const DAMPING: [f64; 2] = [2.0, 0.3];
/// Smallest reference speed of creepages, m/s.
const SLOWEST: f64 = 0.1;
/// Force of the drive by the speed's error, N·s/m.
const DRIVE: f64 = 1e4;
/// Overlap of the rigid profiles at which contact tables are made, m.
const TABLE_OVERLAP: f64 = 1e-4;
/// Distance before the end of the track at which a run ends, m.
const BEFORE_THE_END: f64 = 1.0;

/// The search for contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SearchMode {
    /// By the search at every evaluation.
    Search,
    /// By tables made beforehand.
    Table,
}

/// The parameters of a wheelset on a track as given; SI.
#[derive(Clone, Debug)]
pub struct Wheelset {
    /// Name of the run.
    pub name: String,
    /// Profiles of the left and the right wheel.
    pub wheels: [Profile; 2],
    /// Profiles of the left and the right rail.
    pub rails: [Profile; 2],
    /// The left and the right rail, where their sections change along the track.
    pub rails_over: [Option<Arc<SlicedProfile>>; 2],
    /// The left and the right wheel, where they are not round.
    pub forms: [Option<WheelForm>; 2],
    /// Nominal radii of the left and the right wheel, m.
    pub radii: [f64; 2],
    /// Distances of wheels and rails.
    pub layout: Layout,
    /// Material of wheels and rails.
    pub material: Material,
    /// The track.
    pub track: TrackFile,
    /// The wheelset's mass properties.
    pub body: WheelsetBody,
    /// Load of the axle on both rails, its own weight included, N.
    pub axle_load: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Lateral (N/m) and yaw stiffness (N·m/rad) of the carriage's springs.
    pub stiffness: [f64; 2],
    /// Lateral (N·s/m) and yaw damping (N·m·s/rad).
    pub damping: [f64; 2],
    /// Friction on both rails.
    pub friction: Friction,
    /// The creep law.
    pub creep: CreepLaw,
    /// The search for contact.
    pub search: SearchMode,
    /// What patches are taken for; tables hold ellipses.
    pub patch: PatchForm,
    /// Its start on the track.
    pub start: RigStart,
    /// Duration of the run, s; none: to the end of the track.
    pub duration: Option<f64>,
    /// Time between two rows, s.
    pub interval: f64,
    /// Relative tolerance of the integrator.
    pub relative_tolerance: f64,
    /// Units of the results.
    pub units: Units,
    /// The given values by name, in words: the summary repeats it.
    pub given: BTreeMap<String, String>,
}

/// A wheelset's run to be made.
#[derive(Clone, Debug)]
pub struct WheelsetCase {
    /// The description from which it was made.
    pub wheelset: Wheelset,
    /// The model.
    pub setup: Setup,
    /// Duration of the run, s.
    pub duration: f64,
}

/// A wheelset's run cannot be made.
#[derive(Debug, Error)]
pub enum WheelsetError {
    /// Profiles or distances do not fit.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The straight track of the stability analysis cannot be made.
    #[error(transparent)]
    Track(#[from] TrackError),
    /// A number is not admissible.
    #[error("{what} is {value}; it must be {must}")]
    Number {
        /// Its name, with its unit.
        what: &'static str,
        /// Its value, SI.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
    /// The run leaves the track.
    #[error(
        "from {start:.1} m a run of {duration:.2} s at {speed:.2} m/s ends at {end:.1} m, but the track \
         `{track}` is {length:.1} m long"
    )]
    BeyondTrack {
        /// Name of the track.
        track: String,
        /// Its length, m.
        length: f64,
        /// The distance along the track at which the run begins, m.
        start: f64,
        /// The distance at which it ends, m.
        end: f64,
        /// Its duration, s.
        duration: f64,
        /// Its speed, m/s.
        speed: f64,
    },
    /// A wheelset at rest has no end of the track.
    #[error("at a speed of zero the wheelset never reaches the end of the track")]
    NoDuration,
    /// The wheelset does not stand at its start.
    #[error(transparent)]
    Rig(#[from] RigError),
}

impl WheelsetError {
    /// Returns the advice.
    #[must_use]
    pub fn remedy(&self) -> String {
        let words = match self {
            Self::Profile(error) => return error.remedy(),
            Self::Track(_) => "look at the track file",
            Self::Number { .. } => "give a number in that range",
            Self::BeyondTrack { .. } => {
                "lengthen its last segment, or give a shorter duration or an earlier start"
            }
            Self::NoDuration => "give a duration",
            Self::Rig(_) => "look at the start's distance, lateral place and yaw, and at the load",
        };
        words.to_owned()
    }
}

impl Wheelset {
    /// Returns the longest step (s) that does not miss a flat or a wave of a wheel; infinite of round wheels.
    #[must_use]
    pub fn longest_step(&self) -> f64 {
        let forms = self.forms.iter().flatten().map(WheelForm::finest);
        forms.fold(f64::INFINITY, f64::min) / self.speed
    }

    /// Returns the mean of the nominal radii, m.
    #[must_use]
    pub fn nominal_radius(&self) -> f64 {
        0.5 * (self.radii[0] + self.radii[1])
    }
}

impl WheelsetCase {
    /// Returns the run of a wheelset.
    ///
    /// # Errors
    /// [`WheelsetError`].
    pub fn new(wheelset: Wheelset) -> Result<Self, WheelsetError> {
        check(&wheelset)?;
        let length = wheelset.track.track.center_line.length();
        let (start, speed) = (wheelset.start.distance, wheelset.speed);
        let duration = match wheelset.duration {
            Some(duration) => duration,
            None if speed == 0.0 => return Err(WheelsetError::NoDuration),
            None => (length - BEFORE_THE_END - start) / speed,
        };
        let end = start + speed * duration;
        if !(start >= 0.0 && end <= length && duration > 0.0) {
            return Err(WheelsetError::BeyondTrack {
                track: wheelset.track.name.clone(),
                length,
                start,
                end,
                duration,
                speed,
            });
        }
        let setup = setup(&wheelset, wheelset.track.track.clone())?;
        // What is missing there is reported before anything is written.
        Rig::new(&setup, wheelset.start)?;
        Ok(Self {
            wheelset,
            setup,
            duration,
        })
    }

    /// Returns the assumptions in words.
    #[must_use]
    pub fn assumptions(&self) -> Vec<String> {
        let own = &self.wheelset;
        let mut words = Vec::new();
        for (what, profiles) in [("wheel", &own.wheels), ("rail", &own.rails)] {
            let [left, right] = profiles;
            if left == right {
                let typed = own.given.get(what).map_or(left.name(), String::as_str);
                words.push(of_profile(&format!("the {what}s"), typed, left));
            } else {
                for (side, profile) in [("left", left), ("right", right)] {
                    words.push(of_profile(&format!("the {side} {what}"), profile.name(), profile));
                }
            }
        }
        words.extend(crate::car::rails::over_in_words(&own.rails_over));
        words.extend(not_round::of_wheelset(&own.forms, "the wheelset"));
        words.push(
            "One wheelset under a carriage that follows the track: its springs are lateral and yaw springs \
             to the track's direction, its load acts square to the track, its drive holds the speed; no car \
             body, no truck."
                .to_owned(),
        );
        let support = self.setup.support.as_ref();
        let sprung = "Each wheel has its own piece of sprung rail";
        words.push(of_support(support, sprung, STANDARD_GRAVITY));
        words.push(format!(
            "Normal forces are damped with {} s/m (Hunt and Crossley), a guess.",
            DAMPING[usize::from(support.is_some())]
        ));
        words.push(
            "Normal forces are Hertz's with curvatures averaged over each patch; up to three areas of \
             contact a wheel."
                .to_owned(),
        );
        words
    }
}

fn check(wheelset: &Wheelset) -> Result<(), WheelsetError> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let not_negative = |value: f64| value >= 0.0 && value.is_finite();
    let [lateral, yaw] = wheelset.stiffness;
    let [lateral_damping, yaw_damping] = wheelset.damping;
    let body = &wheelset.body;
    let weight = body.mass * STANDARD_GRAVITY;
    let wrong_friction = wheelset.friction.inadmissible();
    let positives = [
        ("the mass of the wheelset (kg)", body.mass),
        ("the moment of inertia about the axle (kg m²)", body.about_axle),
        (
            "the moment of inertia about a diameter (kg m²)",
            body.about_diameter,
        ),
        ("the interval (s)", wheelset.interval),
        ("the duration (s)", wheelset.duration.unwrap_or(1.0)),
    ];
    let others = [
        ("the speed (m/s)", wheelset.speed),
        ("the lateral stiffness (N/m)", lateral),
        ("the yaw stiffness (N m/rad)", yaw),
        ("the lateral damping (N s/m)", lateral_damping),
        ("the yaw damping (N m s/rad)", yaw_damping),
    ];
    let ranges = [
        (
            "the coefficient of friction",
            wrong_friction.unwrap_or_default(),
            wrong_friction.is_none(),
            "between 0 and 2",
        ),
        (
            "the relative tolerance",
            wheelset.relative_tolerance,
            (1e-10..=1e-2).contains(&wheelset.relative_tolerance),
            "between 1e-10 and 1e-2",
        ),
        (
            "the axle load (N), its own weight included,",
            wheelset.axle_load,
            wheelset.axle_load >= weight && wheelset.axle_load.is_finite(),
            "at least the weight of the wheelset",
        ),
    ];
    let positives = positives.map(|(what, value)| (what, value, positive(value), "positive"));
    let others = others.map(|(what, value)| (what, value, not_negative(value), "zero or positive"));
    let mut all = positives.into_iter().chain(others).chain(ranges);
    match all.find(|(_, _, holds, _)| !holds) {
        None => Ok(()),
        Some((what, value, _, must)) => Err(WheelsetError::Number { what, value, must }),
    }
}

/// Returns the rig of a wheelset on a track.
fn setup(wheelset: &Wheelset, track: Track) -> Result<Setup, WheelsetError> {
    let rigid = RigidWheelset::new(
        wheelset.wheels.each_ref(),
        wheelset.radii,
        wheelset.rails.each_ref(),
        wheelset.layout,
        wheelset.material,
    )?;
    rigid.check_reach()?;
    let rigid = rigid.with_patches(wheelset.patch);
    let lines = Arc::new(RailLines::new(track, rigid.rail_origins()));
    let over = rigid.rails_over(wheelset.rails_over.each_ref().map(Option::as_deref))?;
    let search = |index: usize| -> Result<Search, WheelsetError> {
        let mut pair = rigid.pairs()[index].clone();
        if let Some(rail) = &over[index] {
            pair = pair.on(rail.clone());
        }
        if let Some(form) = &wheelset.forms[index] {
            pair = pair.under(form.clone());
        }
        Ok(match wheelset.search {
            SearchMode::Search => Search::Exact(Arc::new(pair)),
            SearchMode::Table => Search::Table(Arc::new(ContactTable::new(pair, TABLE_OVERLAP)?)),
        })
    };
    let support = match &wheelset.track.support {
        Support::Rigid => None,
        Support::Sprung(rail) => Some(rail.clone()),
    };
    Ok(Setup {
        body: wheelset.body,
        wheels: Wheels::OnRails {
            search: [search(0)?, search(1)?],
            tape_distance: wheelset.layout.tape_distance,
            law: ContactLaw {
                friction: wheelset.friction.clone(),
                damping: DAMPING[usize::from(support.is_some())],
                creep: wheelset.creep,
                slowest: SLOWEST,
            },
        },
        carriage: Carriage {
            name: "carriage".to_owned(),
            lines: lines.clone(),
            stiffness: wheelset.stiffness,
            damping: wheelset.damping,
            load: wheelset.axle_load - wheelset.body.mass * STANDARD_GRAVITY,
            speed: wheelset.speed,
            drive: DRIVE,
        },
        lines,
        support,
        gravity: STANDARD_GRAVITY,
        heading: 0.0,
    })
}
