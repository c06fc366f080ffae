//! The runs of an onset: both tracks, every speed, several at a time.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::Sender;

use car::{Drive, Start, Wheels};
use wheelrail::track::{Placed, RailLines, Track};

use super::measured::{INTERVAL, Settled, deviation};
use super::{CarCase, OnsetError, OnsetPoint, OnsetSettings, OnsetTrack, TRACKS};
use crate::car::hunting::{GAIN, SHIFT};
use crate::car::regime::Regime;
use crate::car::statistics::Rules;
use crate::car::track::tangent;
use crate::case::{CaseError, Tables};
use crate::outcome::Outcome;
use crate::run::Run;
use crate::summary::RunSummary;

/// Durations are whole multiples of it, s.
const DURATION_STEP: f64 = 0.05;
/// Simulated time between two reports of a run, s.
const REPORT: f64 = 0.05;

/// What a worker tells.
pub(super) enum Report {
    /// A run has come to a time, s.
    Reached(usize, f64),
    /// A run has come to its end.
    Done(usize, Box<OnsetPoint>),
    /// A run cannot be made.
    Failed(Box<OnsetError>),
}

/// What all runs have in common.
pub(super) struct Runs<'c> {
    case: &'c CarCase,
    speeds: &'c [f64],
    settings: OnsetSettings,
    /// Perfect track, and track of class 4.
    tracks: [Track; 2],
    /// The rails of both.
    rails: [RailLines; 2],
}

impl<'c> Runs<'c> {
    pub(super) fn new(
        case: &'c CarCase,
        speeds: &'c [f64],
        settings: OnsetSettings,
    ) -> Result<Self, OnsetError> {
        if matches!(case.parameters.wheels, Wheels::Linear { .. }) {
            return Err(OnsetError::LinearWheels);
        }
        let positive = speeds.iter().all(|own| *own > 0.0 && own.is_finite());
        let rising = speeds.windows(2).all(|pair| pair[0] < pair[1]);
        if speeds.is_empty() || !positive || !rising {
            let words: Vec<String> = speeds.iter().map(|own| format!("{own} m/s")).collect();
            let what = match words.as_slice() {
                [] => "an empty list".to_owned(),
                words => words.join(", "),
            };
            return Err(OnsetError::Speeds { what });
        }
        let OnsetSettings { distance, settle, .. } = settings;
        if !(settle >= 0.0 && distance > settle && distance.is_finite()) {
            return Err(OnsetError::Distances { distance, settle });
        }
        let length = 2.0 * case.parameters.reach() + 1.05 * distance + 20.0;
        let class_4 = irregularities("fra_class_4")?;
        let make = |irregularities: Vec<Placed>| {
            let track = tangent(length).ok_or_else(|| OnsetError::Regime {
                name: "hunting",
                reason: format!("there is no track of {length} m"),
            });
            track.map(|own| Track {
                irregularities,
                ..own
            })
        };
        let tracks = [make(Vec::new())?, make(class_4)?];
        // The rails' origins do not matter for irregularities.
        let rails = tracks.clone().map(|own| RailLines::new(own, [0.75; 2]));
        Ok(Self {
            case,
            speeds,
            settings,
            tracks,
            rails,
        })
    }

    /// Returns the runs: track by track, at rising speed.
    pub(super) fn jobs(&self) -> impl Iterator<Item = (usize, f64)> {
        (0..TRACKS.len()).flat_map(|track| self.speeds.iter().map(move |speed| (track, *speed)))
    }

    /// Returns the duration of a run at a speed (m/s), s.
    pub(super) fn duration(&self, speed: f64) -> f64 {
        (self.settings.distance / speed / DURATION_STEP).ceil() * DURATION_STEP
    }

    /// Makes one run after the other until there are no more.
    pub(super) fn work(&self, next: &AtomicUsize, stop: &AtomicBool, sender: Sender<Report>) {
        // Who listens does so until all workers have ended: nothing that is sent is lost.
        let tell = |report: Report| drop(sender.send(report));
        loop {
            let job = next.fetch_add(1, Ordering::Relaxed);
            let Some((track, speed)) = self.jobs().nth(job) else {
                return;
            };
            if stop.load(Ordering::Relaxed) {
                return;
            }
            let mut told = 0.0;
            let found = self.one(track, speed, |time| {
                if time >= told + REPORT {
                    told = time;
                    tell(Report::Reached(job, time));
                }
                match stop.load(Ordering::Relaxed) {
                    true => ControlFlow::Break("stopped".to_owned()),
                    false => ControlFlow::Continue(()),
                }
            });
            match found {
                Ok(Some(point)) => {
                    tell(Report::Done(job, Box::new(point)));
                    tell(Report::Reached(job, self.duration(speed)));
                }
                Ok(None) => return,
                Err(error) => tell(Report::Failed(Box::new(error))),
            }
        }
    }

    /// Returns the case on a track at a speed.
    fn case(&self, track: usize, speed: f64) -> CarCase {
        let mut own = self.case.clone();
        own.simulation.duration = self.duration(speed);
        own.simulation.output_interval = INTERVAL;
        own.rules = Rules::default();
        let parameters = &mut own.parameters;
        parameters.track = self.tracks[track].clone();
        parameters.start = Start {
            kind: parameters.start.kind,
            settle: self.settings.settle / speed,
            ..Start::at(parameters.reach() + 1.0, speed)
        };
        if TRACKS[track] == OnsetTrack::Perfect {
            parameters.start.wheelset_shifts = [SHIFT; 4];
        }
        parameters.drive = Drive::Held {
            gain: parameters.drive.gain().unwrap_or(GAIN),
        };
        own
    }

    /// Makes a run; `None` if it was told to stop.
    fn one(
        &self,
        track: usize,
        speed: f64,
        mut go_on: impl FnMut(f64) -> ControlFlow<String>,
    ) -> Result<Option<OnsetPoint>, OnsetError> {
        let case = self.case(track, speed);
        let mut interrupted = false;
        let result = Run::new(&case)?.finish_while(|time| {
            let next = go_on(time);
            interrupted |= next.is_break();
            next
        });
        if interrupted {
            return Ok(None);
        }
        let outcome = result.summary.outcome();
        if let Outcome::Stopped(end) = &outcome {
            return Err(OnsetError::Stopped {
                track: TRACKS[track],
                speed,
                time: end.time,
                reason: end.reason.clone(),
            });
        }
        let histories = Settled::of(&result, case.parameters.start.settle);
        Ok(Some(OnsetPoint {
            speed,
            deviation: deviation(&case, &result),
            body_rms: histories.body_rms(),
            truck_rms: histories.truck_rms(),
            amplitude: histories.amplitude(&case, &self.rails[track]),
            warnings: outcome
                .told()
                .into_iter()
                .chain(result.summary.warnings.iter().cloned())
                .collect(),
            outcome,
        }))
    }
}

/// Returns a built-in regime.
pub(super) fn regime(name: &'static str) -> Result<&'static Regime, OnsetError> {
    Regime::named(name).ok_or_else(|| OnsetError::Regime {
        name,
        reason: "there is none of this name".to_owned(),
    })
}

/// Returns the irregularities of a regime's track, which are those of any longer one.
fn irregularities(name: &'static str) -> Result<Vec<Placed>, OnsetError> {
    let regime = regime(name)?;
    let failed = |error: CaseError| OnsetError::Regime {
        name,
        reason: error.to_string(),
    };
    let [slowest, _] = &regime.range;
    let settings = regime.settings(slowest).map_err(failed)?;
    let case = CarCase::parse(name, "model = \"car\"", Tables::nowhere(), &settings);
    Ok(case.map_err(failed)?.parameters.track.irregularities)
}
