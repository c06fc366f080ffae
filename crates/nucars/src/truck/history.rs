//! Histories as motions.

use mechanics::motion::{Motion, Piece, RampProfile};

use super::build::BuildError;
use super::choices::{Bend, Choices};
use super::units::FOOT;
use crate::tree::{Argument, History, HistoryShape, Segment};

/// Returns the motion of a history in the file's units times `factor`, `delay` seconds late.
pub(super) fn motion(
    history: &History,
    choices: &Choices,
    factor: f64,
    delay: f64,
) -> Result<Motion, BuildError> {
    // A foot of a distance-based history, in seconds.
    let scale = match *history.argument {
        Argument::Time => 1.0,
        Argument::Distance => {
            let speed = choices.speed.ok_or(BuildError::NoSpeed {
                what: format!("history {} goes by distance", history.number),
            })?;
            FOOT / speed
        }
    };
    let mut pieces = Vec::new();
    let mut start = 0.0;
    for segment in &history.segments {
        let end = *segment.end * scale;
        pieces.push(Piece {
            start: start + delay,
            motion: shape(segment, choices, scale, end - start).scaled(factor),
        });
        start = end;
    }
    Ok(match pieces.as_slice() {
        [] => Motion::Constant(0.0),
        [only] if only.start == 0.0 => only.motion.clone(),
        _ => Motion::Sequence(pieces),
    })
}

/// Returns the motion of a segment, its time counted from its start, in the file's units of amplitude.
fn shape(segment: &Segment, choices: &Choices, scale: f64, length: f64) -> Motion {
    let [c1, c2] = [*segment.coefficients[0], *segment.coefficients[1]];
    let amplitude = *segment.amplitude;
    let angular = |frequency: f64| 2.0 * std::f64::consts::PI * frequency / scale;
    let shape = match *segment.shape {
        HistoryShape::Null => None,
        HistoryShape::Sin => Some(sine(amplitude, angular(c1))),
        HistoryShape::Ssin if c1 == c2 => Some(sine(amplitude, angular(c1))),
        HistoryShape::Ssin => Some(Motion::SweptSine {
            amplitude,
            start: angular(c1),
            end: angular(c2),
            duration: length,
        }),
        HistoryShape::Bend => Some(bend(choices.bend, amplitude, c1 * scale, c2 * scale, length)),
        HistoryShape::Cusp => Some(Motion::Cusps {
            amplitude,
            decay: c1 * scale,
            spacing: c2 * scale,
        }),
    };
    let [from, to] = [*segment.base[0], *segment.base[1]];
    let mut parts: Vec<Motion> = shape.into_iter().collect();
    if from != 0.0 {
        parts.push(Motion::Constant(from));
    }
    if from != to {
        parts.push(Motion::Ramp {
            amplitude: to - from,
            start: 0.0,
            duration: length,
            profile: RampProfile::Linear,
        });
    }
    match parts.len() {
        0 => Motion::Constant(0.0),
        1 => parts.swap_remove(0),
        _ => Motion::Sum(parts),
    }
}

fn sine(amplitude: f64, angular_frequency: f64) -> Motion {
    Motion::Sine {
        amplitude,
        angular_frequency,
        phase: 0.0,
    }
}

/// Returns a rise that is held, again and again from zero if the spacing is shorter than the segment.
fn bend(profile: Bend, amplitude: f64, rise: f64, spacing: f64, length: f64) -> Motion {
    const MOST: f64 = 10_000.0;
    let one = Motion::Ramp {
        amplitude,
        start: 0.0,
        duration: rise,
        profile: match profile {
            Bend::HalfCosine => RampProfile::HalfCosine,
            Bend::Linear => RampProfile::Linear,
        },
    };
    if !(spacing > 0.0 && spacing < length && length / spacing <= MOST) {
        return one;
    }
    let count = (length / spacing).ceil() as usize;
    let pieces = (0..count).map(|number| Piece {
        start: number as f64 * spacing,
        motion: one.clone(),
    });
    Motion::Sequence(pieces.collect())
}
