//! Onset of hunting by stated measures: a car held at each of a list of speeds, on perfect track and on
//! irregular one.
//!
//! | track | what disturbs the car |
//! |---|---|
//! | perfect | all wheelsets start 0.4 in to the left |
//! | class 4 | irregularities of the regime `fra_class_4`: its spectra and seeds |
//!
//! Both are straight; the car runs as far as in the regime `hunting`: 600 ft to settle, then 2,000 ft of
//! statistics. Measures, each the largest of both trucks or of all wheelsets:
//!
//! | measure | how | limit |
//! |---|---|---|
//! | deviation | standard deviation of the body's lateral acceleration at a truck center over 2,000 ft, below 10 Hz: the statistic of [`super::statistics`] | 0.13 g, remembered of AAR M-1001, chapter XI |
//! | truck's rms | root of the mean square about the mean, over 2 s, of a truck's lateral acceleration below 10 Hz: that of the middle between its axles | 0.30 g, remembered of 49 CFR 213.333 of 2013; that of 1998 has 0.4 g (source: 63 FR 34029) |
//! | amplitude | half of greatest less least place of a wheelset against the middle of the rails within 1.5 s, the median of such windows | 0.38 in, a guess: a little less than the clearance of 0.41 in of the built-in wheels |
//!
//! 49 CFR 213.333 measures on the truck's frame, from 0.5 to 10 Hz; three-piece trucks have no frame, and the
//! slow part is left out by the mean over 2 s alone. It is set for track of class 6 and above.
//!
//! The onset is the lowest speed from which on, among the speeds tried, the measure is above its limit: by
//! linear interpolation between the last speed below it and the next one. A car whose wheel leaves its rail
//! is above every limit.

use std::num::NonZero;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use quantity::{INCH, Kind, Quantity, STANDARD_GRAVITY, SixDigits};
use thiserror::Error;

use super::CarCase;
use crate::outcome::Outcome;
use crate::run::RunError;

mod measured;
mod runs;

use runs::{Report, Runs};

/// The track that a car runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnsetTrack {
    /// Without irregularities; wheelsets start to the left.
    Perfect,
    /// With irregularities of FRA class 4 by spectra.
    Class4,
}

/// Both tracks.
pub const TRACKS: [OnsetTrack; 2] = [OnsetTrack::Perfect, OnsetTrack::Class4];

impl OnsetTrack {
    /// Returns its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Perfect => "perfect",
            Self::Class4 => "fra_class_4",
        }
    }

    /// Returns it in words: "perfect track".
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Perfect => "perfect track",
            Self::Class4 => "class 4 track",
        }
    }
}

/// What tells hunting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Standard deviation of the body's lateral acceleration over 2,000 ft.
    Deviation,
    /// Rms of a truck's lateral acceleration over 2 s, about its mean.
    TruckRms,
    /// Lateral amplitude of a wheelset between the rails.
    Amplitude,
}

/// All measures.
pub const MEASURES: [Measure; 3] = [Measure::Deviation, Measure::TruckRms, Measure::Amplitude];

impl Measure {
    /// Returns its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Deviation => "body_deviation",
            Self::TruckRms => "truck_rms",
            Self::Amplitude => "axle_amplitude",
        }
    }

    /// Returns it in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Deviation => "the body's standard deviation over 2,000 ft",
            Self::TruckRms => "a truck's rms over 2 s",
            Self::Amplitude => "a wheelset's amplitude",
        }
    }

    /// Returns its kind of quantity.
    #[must_use]
    pub fn kind(self) -> Kind {
        match self {
            Self::Deviation | Self::TruckRms => Kind::RideAcceleration,
            Self::Amplitude => Kind::Length,
        }
    }

    /// Returns the limit above which it tells hunting, m/s² or m.
    #[must_use]
    pub fn limit(self) -> f64 {
        match self {
            Self::Deviation => 0.13 * STANDARD_GRAVITY,
            Self::TruckRms => 0.30 * STANDARD_GRAVITY,
            Self::Amplitude => 0.38 * INCH,
        }
    }
}

/// The measures at a speed.
#[derive(Clone, Debug)]
pub struct OnsetPoint {
    /// The speed, m/s.
    pub speed: f64,
    /// Standard deviation of the body's lateral acceleration over 2,000 ft, the larger one of both truck
    /// centers, m/s².
    pub deviation: f64,
    /// Largest rms of that acceleration over 2 s about its mean, m/s²; it has no limit here.
    pub body_rms: f64,
    /// Largest rms of a truck's lateral acceleration over 2 s about its mean, m/s².
    pub truck_rms: f64,
    /// Largest lateral amplitude of a wheelset between the rails, the median of windows of 1.5 s, m.
    pub amplitude: f64,
    /// The outcome of its run. Of one that derailed the measures are of the part before.
    pub outcome: Outcome,
    /// Warnings about its numbers: what the run lacks to be complete, warnings of the run.
    pub warnings: Vec<String>,
}

impl OnsetPoint {
    /// Returns a measure, m/s² or m; of a car that derailed, of the part before.
    #[must_use]
    pub fn raw(&self, measure: Measure) -> f64 {
        match measure {
            Measure::Deviation => self.deviation,
            Measure::TruckRms => self.truck_rms,
            Measure::Amplitude => self.amplitude,
        }
    }

    /// Returns a measure (m/s² or m); `None` of a car that derailed, which is above every limit.
    #[must_use]
    pub fn value(&self, measure: Measure) -> Option<f64> {
        let derailed = matches!(self.outcome, Outcome::Derailed(_));
        (!derailed).then(|| self.raw(measure))
    }
}

/// The speed from which on a measure is above its limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OnsetSpeed {
    /// From this speed on, m/s.
    From(f64),
    /// At all speeds tried; this is the lowest, m/s.
    AllFrom(f64),
    /// Not at the highest speed tried, m/s.
    NoneUpTo(f64),
}

impl OnsetSpeed {
    /// Returns the onset over speeds (m/s, rising), each with its measure (`None`: above every limit) and a
    /// limit in the measure's unit; `None` without speeds. Where one of two neighbors has no measure, the
    /// onset is halfway between them.
    #[must_use]
    pub fn of(points: &[(f64, Option<f64>)], limit: f64) -> Option<Self> {
        let below = |(_, value): &(f64, Option<f64>)| value.is_some_and(|own| own <= limit);
        let (lowest, highest) = (points.first()?.0, points.last()?.0);
        let Some(last) = points.iter().rposition(below) else {
            return Some(Self::AllFrom(lowest));
        };
        let Some((above, value)) = points.get(last + 1) else {
            return Some(Self::NoneUpTo(highest));
        };
        let (under, least) = points[last];
        let share = match (least, value) {
            (Some(least), Some(value)) => (limit - least) / (value - least),
            _ => 0.5,
        };
        Some(Self::From(under + share * (above - under)))
    }
}

/// The findings on a track.
#[derive(Clone, Debug)]
pub struct OnTrack {
    /// The track.
    pub track: OnsetTrack,
    /// The speeds that were run to their ends, rising.
    pub points: Vec<OnsetPoint>,
}

impl OnTrack {
    /// Returns the onset by a measure; `None` if no speed was run.
    #[must_use]
    pub fn onset(&self, measure: Measure) -> Option<OnsetSpeed> {
        let points = self.points.iter().map(|own| (own.speed, own.value(measure)));
        OnsetSpeed::of(&points.collect::<Vec<_>>(), measure.limit())
    }
}

/// The findings.
#[derive(Clone, Debug)]
pub struct Onset {
    /// The speeds asked for, m/s, rising.
    pub speeds: Vec<f64>,
    /// On perfect track, and on track of class 4.
    pub tracks: [OnTrack; 2],
    /// True if all was computed.
    pub complete: bool,
}

impl Onset {
    /// Returns the first run whose energy ledger does not close: track, speed (m/s), reason. Do not use its
    /// numbers.
    #[must_use]
    pub fn failed(&self) -> Option<(OnsetTrack, f64, &str)> {
        let points = self
            .tracks
            .iter()
            .flat_map(|own| own.points.iter().map(|point| (own.track, point)));
        points
            .filter_map(|(track, point)| match &point.outcome {
                Outcome::Failed(reason) => Some((track, point.speed, reason.as_str())),
                _ => None,
            })
            .next()
    }
}

/// Reasons why there is none.
#[derive(Debug, Error)]
pub enum OnsetError {
    /// Linear wheels have no limit cycle.
    #[error(
        "wheels.geometry is \"linear\": linear wheels have neither flanges nor saturation, and so no limit \
         cycle; take wheels.geometry = \"profiles\""
    )]
    LinearWheels,
    /// The speeds are no list of speeds.
    #[error("speeds of {what}: at least one is expected, all positive and rising, m/s; give others")]
    Speeds {
        /// The speeds, or that there are none.
        what: String,
    },
    /// The distances make no run.
    #[error(
        "a run of {distance} m of which {settle} m settle has no statistics: the first must be positive and \
         above the second"
    )]
    Distances {
        /// The distance, m.
        distance: f64,
        /// What settles, m.
        settle: f64,
    },
    /// A regime that the tracks come from cannot be used.
    #[error("the regime {name}, by which the tracks are made, cannot be used: {reason}")]
    Regime {
        /// Its name.
        name: &'static str,
        /// The reason.
        reason: String,
    },
    /// A run cannot begin.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A run ended before its time.
    #[error(
        "the run on {} at {speed} m/s stopped at {} s: {reason}; leave this speed out, or try another \
         simulation.method",
        track.words(),
        SixDigits(*time)
    )]
    Stopped {
        /// The track.
        track: OnsetTrack,
        /// The speed, m/s.
        speed: f64,
        /// The time, s.
        time: f64,
        /// The reason.
        reason: String,
    },
}

/// How far each run goes, and how many run at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnsetSettings {
    /// Distance of a run, m.
    pub distance: f64,
    /// What statistics leave out of it, m.
    pub settle: f64,
    /// Number of threads; results are the same for any number, bit for bit.
    pub threads: usize,
}

impl OnsetSettings {
    /// Returns the distances of the regime `hunting`, 2,620 ft and 600 ft, and as many threads as there are
    /// processors.
    ///
    /// # Errors
    /// There is no such regime.
    pub fn usual() -> Result<Self, OnsetError> {
        let hunting = runs::regime("hunting")?;
        Ok(Self {
            distance: hunting.distance.to_si(),
            settle: hunting.settle.as_ref().map_or(0.0, Quantity::to_si),
            threads: thread::available_parallelism().map_or(1, NonZero::get),
        })
    }
}

/// Returns the onset of hunting of a car among these speeds (m/s, rising). `go_on` receives the share that is
/// done; where it breaks, with a reason, the runs that came to their ends come back as incomplete.
///
/// # Errors
/// [`OnsetError`].
pub fn onset(
    case: &CarCase,
    speeds: &[f64],
    go_on: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<Onset, OnsetError> {
    onset_with(case, speeds, OnsetSettings::usual()?, go_on)
}

/// As [`onset`], over other distances. Measures over less than 2,000 ft or 2 s are those of the whole run
/// after settling.
///
/// # Errors
/// [`OnsetError`].
pub fn onset_with(
    case: &CarCase,
    speeds: &[f64],
    settings: OnsetSettings,
    mut go_on: impl FnMut(f64) -> ControlFlow<String>,
) -> Result<Onset, OnsetError> {
    let runs = Runs::new(case, speeds, settings)?;
    let all: f64 = runs.jobs().map(|(_, speed)| runs.duration(speed)).sum();
    let count = runs.jobs().count();
    let mut reached = vec![0.0; count];
    let mut points: Vec<Option<OnsetPoint>> = vec![None; count];
    let mut failed = None;
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..settings.threads.clamp(1, count) {
            let sender = sender.clone();
            scope.spawn(|| runs.work(&next, &stop, sender));
        }
        // The channel ends with the last worker.
        drop(sender);
        for report in receiver {
            match report {
                Report::Reached(job, time) => reached[job] = time,
                Report::Done(job, point) => points[job] = Some(*point),
                Report::Failed(error) => {
                    failed.get_or_insert(*error);
                    stop.store(true, Ordering::Relaxed);
                }
            }
            let share = (reached.iter().sum::<f64>() / all).min(1.0);
            if !stop.load(Ordering::Relaxed) && go_on(share).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
        }
    });
    if let Some(error) = failed {
        return Err(error);
    }
    let complete = points.iter().all(Option::is_some);
    let mut points = points.into_iter().zip(runs.jobs());
    let tracks = TRACKS.map(|track| OnTrack {
        track,
        points: points
            .by_ref()
            .take(speeds.len())
            .filter_map(|(own, _)| own)
            .collect(),
    });
    Ok(Onset {
        speeds: speeds.to_vec(),
        tracks,
        complete,
    })
}
