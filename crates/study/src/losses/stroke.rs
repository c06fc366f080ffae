//! The stroke of a periodic motion or load: its period, and the four parts of it.

use std::f64::consts::PI;

use mechanics::motion::Motion;

/// The names of the four parts of a stroke, in their order from where the motion rises through its middle.
pub const PARTS: [&str; 4] = ["rising_upper", "falling_upper", "falling_lower", "rising_lower"];

/// A sine or triangle: when it begins, and when it is where. Each part of its stroke takes a quarter period:
/// it rises or falls in its upper or its lower half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Period, s.
    pub period: f64,
    /// The start of the motion, s.
    pub begin: f64,
    /// A time at which it rises through its middle, s.
    pub rises: f64,
}

impl Stroke {
    /// Returns that of a motion; of a sum or sequence that of the first periodic one. `None` if nothing in
    /// it is a sine or a triangle that moves.
    #[must_use]
    pub fn of(motion: &Motion) -> Option<Self> {
        match motion {
            Motion::Sine {
                amplitude,
                angular_frequency,
                phase,
            } => Self::sine(*amplitude, *angular_frequency, *phase),
            Motion::Triangle {
                amplitude,
                angular_frequency,
            } => Self::sine(*amplitude, *angular_frequency, 0.0),
            Motion::Sum(parts) => parts.iter().find_map(Self::of),
            Motion::Sequence(pieces) => pieces.iter().find_map(|piece| {
                let own = Self::of(&piece.motion)?;
                Some(Self {
                    begin: own.begin + piece.start,
                    rises: own.rises + piece.start,
                    ..own
                })
            }),
            _ => None,
        }
    }

    /// Returns that of `amplitude · sin(angular_frequency · t + phase)`.
    fn sine(amplitude: f64, angular_frequency: f64, phase: f64) -> Option<Self> {
        if amplitude == 0.0 || angular_frequency == 0.0 {
            return None;
        }
        let period = 2.0 * PI / angular_frequency;
        let half = if amplitude * angular_frequency < 0.0 {
            0.5
        } else {
            0.0
        };
        Some(Self {
            period: period.abs(),
            begin: 0.0,
            rises: -phase / angular_frequency + half * period.abs(),
        })
    }

    /// Returns the part of the stroke that begins at `time` (s) or has begun by then, as a number of
    /// [`PARTS`], and when it ends, s.
    #[must_use]
    pub fn part(&self, time: f64) -> (usize, f64) {
        /// Of a quarter: what begins so soon has begun.
        const SLACK: f64 = 1e-9;
        let quarter = 0.25 * self.period;
        let number = ((time - self.rises) / quarter + SLACK).floor();
        let end = self.rises + (number + 1.0) * quarter;
        (number.rem_euclid(4.0) as usize, end)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::{PARTS, Stroke};
    use mechanics::motion::{Motion, Piece};

    fn sine(amplitude: f64, phase: f64) -> Motion {
        Motion::Sine {
            amplitude,
            angular_frequency: 3.0,
            phase,
        }
    }

    /// In each part the motion is in the half and goes the way that the part's name says.
    #[test]
    fn analytic_parts_are_where_their_names_say() {
        for motion in [
            sine(0.2, 0.0),
            sine(-0.2, 0.0),
            sine(0.2, 1.234),
            sine(-0.2, -7.0),
            Motion::Triangle {
                amplitude: -0.1,
                angular_frequency: 3.0,
            },
            Motion::Sequence(vec![Piece {
                start: 0.77,
                motion: sine(0.2, 0.4),
            }]),
        ] {
            let stroke = Stroke::of(&motion).unwrap();
            for i in 0..400 {
                let time = 1.0 + 0.0123 * f64::from(i);
                let (part, end) = stroke.part(time);
                let [value, rate, _] = motion.evaluate(time, time);
                let way = if rate > 0.0 { "rising" } else { "falling" };
                let half = if value > 0.0 { "upper" } else { "lower" };
                assert_eq!(PARTS[part], format!("{way}_{half}"), "{motion:?} {time}");
                assert!(end > time && end < time + 0.26 * stroke.period);
                assert_eq!(stroke.part(end).0, (part + 1) % 4);
            }
        }
    }

    #[test]
    fn limits_what_does_not_move_has_no_stroke() {
        for motion in [Motion::Constant(1.0), sine(0.0, 1.0)] {
            assert_eq!(Stroke::of(&motion), None);
        }
    }
}
