//! Stability of a wheelset over speed: its lateral vibrations about steady rolling on straight perfect track.

use std::ops::ControlFlow;

use rolling::rig::{Rig, RigStart, Setup};

use super::summary::Hunting;
use super::{Wheelset, WheelsetError, check, setup};
use crate::track::TrackFile;

/// Frequencies of hunting, rad/s, and a number of their size, 1/s.
const HUNTING: [f64; 2] = [0.5, 300.0];
const SHIFT: f64 = 20.0;
/// Length of the straight track, and where on it the wheelset is, m.
const LENGTH: f64 = 100.0;
const PLACE: f64 = 50.0;
/// Relative distance of the speeds that the critical one lies between.
const REFINED: f64 = 1e-4;

/// The findings.
#[derive(Clone, Debug)]
pub struct WheelsetStability {
    /// The speeds, m/s; fewer where the user stopped it.
    pub speeds: Vec<f64>,
    /// The least damped lateral vibration at each; none if there is none of the frequencies that wheelsets
    /// hunt with.
    pub vibrations: Vec<Option<Hunting>>,
    /// The lowest speed (m/s) from which on it grows, with its vibration; the lowest of all speeds if it
    /// grows there already.
    pub critical: Option<(f64, Hunting)>,
    /// True if all was computed.
    pub complete: bool,
}

impl WheelsetStability {
    /// Returns whether it grows at the lowest speed already.
    #[must_use]
    pub fn grows_at_once(&self) -> bool {
        let first = self.speeds.first().copied();
        self.critical.is_some_and(|(speed, _)| Some(speed) == first)
    }
}

/// Returns the least damped vibration at these speeds (m/s, rising), and the critical speed. The wheelset's
/// own track, speed and start do not count; the support of its rails does. `go_on` receives the share that is
/// done.
///
/// # Errors
/// The wheelset cannot be made.
pub fn stability(
    wheelset: &Wheelset,
    speeds: &[f64],
    mut go_on: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<WheelsetStability, WheelsetError> {
    check(wheelset)?;
    let mut own = on_straight_track(wheelset)?;
    let mut at = |speed: f64| {
        own.carriage.speed = speed;
        vibration(&own)
    };
    let mut found = WheelsetStability {
        speeds: Vec::new(),
        vibrations: Vec::new(),
        critical: None,
        complete: false,
    };
    let grows = |own: &Option<Hunting>| own.is_some_and(|own| own.growth_per_s > 0.0);
    for (number, speed) in speeds.iter().enumerate() {
        let own = at(*speed)?;
        if let (None, true, Some(own)) = (found.critical, grows(&own), own) {
            found.critical = Some((*speed, own));
            if let Some(mut low) = found.speeds.last().copied() {
                let mut high = (*speed, own);
                while high.0 - low > REFINED * high.0 {
                    let middle = 0.5 * (low + high.0);
                    match at(middle)? {
                        Some(own) if own.growth_per_s > 0.0 => high = (middle, own),
                        _ => low = middle,
                    }
                }
                found.critical = Some((0.5 * (low + high.0), high.1));
            }
        }
        found.speeds.push(*speed);
        found.vibrations.push(own);
        if go_on((number + 1) as f64 / speeds.len() as f64).is_break() {
            return Ok(found);
        }
    }
    found.complete = true;
    Ok(found)
}

/// Returns the least damped lateral vibration of a wheelset at its speed on straight perfect track; none if
/// there is none of the frequencies that wheelsets hunt with.
pub(super) fn hunting(wheelset: &Wheelset) -> Option<Hunting> {
    vibration(&on_straight_track(wheelset).ok()?).ok()?
}

/// Returns the model on straight perfect track.
fn on_straight_track(wheelset: &Wheelset) -> Result<Setup, WheelsetError> {
    setup(wheelset, TrackFile::straight(LENGTH)?.track)
}

/// Returns the least damped lateral vibration of a model on straight track, of the frequencies that wheelsets
/// hunt with.
fn vibration(setup: &Setup) -> Result<Option<Hunting>, WheelsetError> {
    let start = RigStart {
        distance: PLACE,
        ..RigStart::default()
    };
    let mut rig = Rig::new(setup, start)?;
    let Ok(found) = rig.system.eigenvalues(0.0, &rig.start.clone(), SHIFT) else {
        return Ok(None);
    };
    let [low, high] = HUNTING;
    let own = found.into_iter().find(|[_, own]| (low..high).contains(own));
    Ok(own.map(Hunting::of))
}
