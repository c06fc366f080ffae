//! Statistics of sections: how far a model is from measurements, section by section.
//!
//! Two results, a measured and a computed one, are cut into the same sections. Each section gives one value
//! of each [`SectionQuantity`] of a signal; the differences of these values over all sections give their mean
//! and their standard deviation ([`Differences`]). A mean says that the model is off, a deviation that it is
//! off here in one way and there in another.
//!
//! The method is that of the project DynoTRAIN: O. Polach, A. Böttcher and others, Validation of simulation
//! models in the context of railway vehicle acceptance, Proceedings of the Institution of Mechanical
//! Engineers, Part F, 2015 (abstract read in November 2026: values by analogy with EN 14363, limits for a
//! set of deviations between simulation and measurement). From memory, to be checked against EN 14363:2016:
//! at least [`FEWEST`] sections, the percentiles of [`SectionQuantity::Maximum`], and acceptance by
//! [`Acceptance`]'s rule.
//!
//! Limits: signals are taken as they are. Whoever compares peaks filters both alike before.

mod acceptance;
mod cut;

pub use acceptance::{Acceptance, MEAN_SHARE, SectionVerdict};
pub use cut::{Along, Cut, CutError, SectionRequest};

/// The fewest sections from which statistics are drawn without a warning (remembered, EN 14363:2016).
pub const FEWEST: usize = 12;

/// The share of a section that lies beyond each percentile of [`SectionQuantity::Maximum`].
const TAIL: f64 = 0.0015;

/// A value of a signal over a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionQuantity {
    /// The mean, with its sign: what is quasi-static.
    Mean,
    /// The larger in size of the levels below which 0.15 % and 99.85 % of the section lie, as a size.
    Maximum,
    /// The root of the mean square about the mean: the standard deviation within the section.
    Rms,
}

impl SectionQuantity {
    /// All of them, in the order of [`section_values`].
    pub const ALL: [Self; 3] = [Self::Mean, Self::Maximum, Self::Rms];

    /// Returns its name in tables and files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Maximum => "max",
            Self::Rms => "rms",
        }
    }
}

/// A piece of a section over which a signal is a straight line.
#[derive(Clone, Copy)]
struct Piece {
    length: f64,
    ends: [f64; 2],
}

impl Piece {
    /// Returns the length over which the line is at or below a level.
    fn below(&self, level: f64) -> f64 {
        let [low, high] = self.range();
        if level >= high {
            self.length
        } else if level < low {
            0.0
        } else {
            self.length * (level - low) / (high - low)
        }
    }

    fn range(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        [a.min(b), a.max(b)]
    }
}

/// Returns mean, maximum and rms ([`SectionQuantity::ALL`]) of a signal over the section `[from, to]`, in the
/// signal's unit. The signal is the straight line through `values` at `places`, which rise; a `held` one
/// keeps each value until the next place. Means and percentiles are over the length of the section, whatever
/// the distances of the rows. `None` if the places do not reach over the whole section.
#[must_use]
pub fn section_values(places: &[f64], values: &[f64], held: bool, [from, to]: [f64; 2]) -> Option<[f64; 3]> {
    let covered = places.first().is_some_and(|first| *first <= from)
        && places.last().is_some_and(|last| *last >= to)
        && to > from;
    if !covered {
        return None;
    }
    let first = places.partition_point(|place| *place <= from) - 1;
    let mut pieces = Vec::new();
    for row in first..places.len() - 1 {
        let (x, v) = ([places[row], places[row + 1]], [values[row], values[row + 1]]);
        let (start, end) = (x[0].max(from), x[1].min(to));
        if start >= to {
            break;
        }
        let at = |place: f64| match place {
            _ if held || place == x[0] => v[0],
            _ if place == x[1] => v[1],
            _ => v[0] + (v[1] - v[0]) * (place - x[0]) / (x[1] - x[0]),
        };
        pieces.push(Piece {
            length: end - start,
            ends: [at(start), at(end)],
        });
    }
    let length = to - from;
    let mean = pieces
        .iter()
        .map(|own| own.length * 0.5 * (own.ends[0] + own.ends[1]));
    let mean = mean.sum::<f64>() / length;
    let square = pieces.iter().map(|own| {
        let [a, b] = own.ends.map(|value| value - mean);
        own.length * (a * a + a * b + b * b) / 3.0
    });
    let rms = libm::sqrt(square.sum::<f64>() / length);
    let [low, high] = [TAIL, 1.0 - TAIL].map(|share| level(&pieces, share * length));
    Some([mean, low.abs().max(high.abs()), rms])
}

/// Returns the lowest level at or below which the pieces have at least this length.
fn level(pieces: &[Piece], length: f64) -> f64 {
    let mut open = pieces.to_vec();
    let [mut low, mut high] = open.iter().map(Piece::range).fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[low, high], [least, most]| [low.min(least), high.max(most)],
    );
    let mut below = 0.0;
    // Each step halves the range: after 60 it is within rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let found = below + open.iter().map(|own| own.below(middle)).sum::<f64>();
        if found < length {
            low = middle;
        } else {
            high = middle;
        }
        open.retain(|own| {
            let [least, most] = own.range();
            let done = most <= low;
            if done {
                below += own.length;
            }
            !done && least < high
        });
    }
    high
}

/// The differences of a model from a measurement over sections, in the unit of their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Number of sections.
    pub sections: usize,
    /// Mean of model less measurement.
    pub mean: f64,
    /// Standard deviation of model less measurement about their mean, of a sample: over n - 1.
    pub deviation: f64,
    /// Mean size of the measured values.
    pub measured: f64,
}

impl Differences {
    /// Returns the differences of pairs of measured and computed values; `None` of fewer than two.
    #[must_use]
    pub fn of(pairs: &[[f64; 2]]) -> Option<Self> {
        let sections = pairs.len();
        if sections < 2 {
            return None;
        }
        let count = sections as f64;
        let mean = pairs
            .iter()
            .map(|[measured, model]| model - measured)
            .sum::<f64>()
            / count;
        let squares = pairs.iter().map(|[measured, model]| {
            let own = model - measured - mean;
            own * own
        });
        Some(Self {
            sections,
            mean,
            deviation: libm::sqrt(squares.sum::<f64>() / (count - 1.0)),
            measured: pairs.iter().map(|[measured, _]| measured.abs()).sum::<f64>() / count,
        })
    }

    /// Returns mean and deviation in % of the mean size of the measured values; `None` if that is zero.
    #[must_use]
    pub fn percent(&self) -> Option<[f64; 2]> {
        let parts = [self.mean, self.deviation].map(|own| 100.0 * own / self.measured);
        parts.iter().all(|own| own.is_finite()).then_some(parts)
    }
}
