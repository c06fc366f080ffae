//! Filters and statistics of sampled values, as rules for the assessment of cars use them.
//!
//! All take values at rows; between two rows a value is a straight line. Nothing here knows what a value is.

use std::f64::consts::{PI, SQRT_2};

use thiserror::Error;

pub use band::BandPass;
pub use instability::{Instability, InstabilityError};
pub use means::{largest_mean, largest_rmst, sliding_means};
pub use range::largest_range;
pub use spectrum::{FEWEST_ROWS, Spectrum, SpectrumError};
pub use stretch::Stretch;

mod band;
mod instability;
mod means;
mod range;
mod spectrum;
mod stretch;

/// A low-pass filter of fourth order without phase: Butterworth's filter of second order, forward and then
/// backward.
///
/// Its gain is `1 / (1 + (√2 - 1) (tan πfΔ / tan πf₀Δ)⁴)` with the time Δ between rows: `1/√2` (-3 dB) at the
/// cutoff f₀, without any delay, so that a peak stays where it is. The values are continued at both ends by
/// their reflection in the end point.
///
/// The backward pass goes block by block. Each begins so far behind its block that the beginning has died
/// away to rounding. A filtered value hence depends on rows no more than [`LowPass::rows_ahead`] after it, to
/// the last bit.
///
/// Limits: a real channel filters while it records and delays what it sees; one without phase uses what comes
/// later. Rows must be so near that nothing above half their rate is in the values: it would be taken for
/// something slower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    interval: f64,
    cutoff: f64,
    /// b₀ (b₁ is twice that, b₂ the same), a₁, a₂.
    coefficients: [f64; 3],
}

/// Rows are too far apart for a filter.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("rows {interval} s apart are too far from each other for a filter of {cutoff} Hz, which needs {} s \
         or less", LowPass::longest_interval(*.cutoff))]
pub struct TooCoarse {
    /// Time between rows, s.
    pub interval: f64,
    /// The cutoff, Hz.
    pub cutoff: f64,
}

impl LowPass {
    /// Rows a period of the cutoff, at least.
    pub const ROWS: f64 = 4.0;

    /// Returns the longest time between rows (s) for a cutoff (Hz).
    #[must_use]
    pub fn longest_interval(cutoff: f64) -> f64 {
        1.0 / (Self::ROWS * cutoff)
    }

    /// Returns the filter for rows `interval` apart (s) with this cutoff (Hz), both positive.
    ///
    /// # Errors
    /// [`TooCoarse`]: a period of the cutoff has fewer than four rows.
    pub fn new(interval: f64, cutoff: f64) -> Result<Self, TooCoarse> {
        let fine =
            interval > 0.0 && cutoff > 0.0 && interval <= Self::longest_interval(cutoff) * (1.0 + 1e-9);
        if !fine {
            return Err(TooCoarse { interval, cutoff });
        }
        // Both passes together are to have -3 dB at the cutoff.
        let k = libm::tan(PI * cutoff * interval) / libm::sqrt(libm::sqrt(SQRT_2 - 1.0));
        let scale = 1.0 / (1.0 + SQRT_2 * k + k * k);
        Ok(Self {
            interval,
            cutoff,
            coefficients: [
                k * k * scale,
                2.0 * (k * k - 1.0) * scale,
                (1.0 - SQRT_2 * k + k * k) * scale,
            ],
        })
    }

    /// Returns the gain for a sine of this frequency, Hz.
    #[must_use]
    pub fn gain(&self, frequency: f64) -> f64 {
        let ratio = libm::tan(PI * frequency * self.interval) / libm::tan(PI * self.cutoff * self.interval);
        1.0 / (1.0 + (SQRT_2 - 1.0) * libm::pow(ratio, 4.0))
    }

    /// Rows of a block of the backward pass: a period of the cutoff.
    fn block(&self) -> usize {
        (1.0 / (self.cutoff * self.interval)).ceil() as usize
    }

    /// Rows in which what a pass begins with dies away to rounding: the poles of the filter have a size of
    /// √a₂.
    fn memory(&self) -> usize {
        let [.., size] = self.coefficients;
        (libm::log(f64::EPSILON) / (0.5 * libm::log(size))).ceil() as usize
    }

    /// Returns the number of rows after a row on which its filtered value depends: about eight periods of the
    /// cutoff.
    #[must_use]
    pub fn rows_ahead(&self) -> usize {
        self.block() + self.memory()
    }

    /// Returns the filtered values.
    #[must_use]
    pub fn apply(&self, values: &[f64]) -> Vec<f64> {
        let (Some(first), Some(last)) = (values.first(), values.last()) else {
            return Vec::new();
        };
        // Three periods: by then what the ends excite has died away.
        let periods = 3.0 / (self.cutoff * self.interval);
        let pad = (periods.ceil() as usize).min(values.len() - 1);
        let mut long = Vec::with_capacity(values.len() + 2 * pad);
        long.extend(values[1..=pad].iter().rev().map(|value| 2.0 * first - value));
        long.extend(values);
        let before = values.len() - 1;
        long.extend(
            values[before - pad..before]
                .iter()
                .rev()
                .map(|value| 2.0 * last - value),
        );
        self.pass(long.iter_mut());
        let (block, ahead) = (self.block(), self.rows_ahead());
        let mut filtered = Vec::with_capacity(values.len());
        let mut part = Vec::with_capacity(ahead.min(long.len()));
        for start in (0..values.len()).step_by(block) {
            let from = if start + ahead <= values.len() {
                pad + start + ahead
            } else {
                long.len()
            };
            part.clear();
            part.extend(&long[pad + start..from]);
            self.pass(part.iter_mut().rev());
            filtered.extend(&part[..block.min(values.len() - start)]);
        }
        filtered
    }

    /// One pass, from the steady state of the first value.
    fn pass<'v>(&self, values: impl Iterator<Item = &'v mut f64>) {
        let [b, a1, a2] = self.coefficients;
        let mut state: Option<[f64; 2]> = None;
        for value in values {
            let x = *value;
            let [z1, z2] = state.unwrap_or([x * (1.0 - b), x * (b - a2)]);
            let y = b * x + z1;
            state = Some([2.0 * b * x - a1 * y + z2, b * x - a2 * y]);
            *value = y;
        }
    }
}

/// A value found within a stretch of rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowValue {
    /// The value.
    pub value: f64,
    /// The start of the stretch.
    pub start: f64,
    /// Its length.
    pub length: f64,
}

/// Returns the largest value that is reached or exceeded without interruption over a `length` of `places`
/// (both of one unit: time or distance; places grow). `None` if the places do not reach so far.
#[must_use]
pub fn sustained(places: &[f64], values: &[f64], length: f64) -> Option<WindowValue> {
    let (first, last) = (*places.first()?, *places.last()?);
    if last - first < length * (1.0 - 1e-12) {
        return None;
    }
    let [mut low, mut high] = range(values)?;
    let mut start = held_from(places, values, low, length)?;
    if let Some(all) = held_from(places, values, high, length) {
        (low, start) = (high, all);
    }
    // Each step halves the range: after 60 it is within rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match held_from(places, values, middle, length) {
            Some(place) => (low, start) = (middle, place),
            None => high = middle,
        }
    }
    Some(WindowValue {
        value: low,
        start,
        length,
    })
}

/// Returns the first place from which values stay at a level or above it over a length.
fn held_from(places: &[f64], values: &[f64], level: f64, length: f64) -> Option<f64> {
    let enough = |from: f64, to: f64| to - from >= length * (1.0 - 1e-12);
    let mut from = (*values.first()? >= level).then(|| places[0]);
    for (x, v) in places.windows(2).zip(values.windows(2)) {
        let crossing = || x[0] + (x[1] - x[0]) * (level - v[0]) / (v[1] - v[0]);
        if v[0] < level && v[1] >= level {
            from = Some(crossing());
        } else if v[0] >= level && v[1] < level {
            let to = crossing();
            if let Some(start) = from.filter(|start| enough(*start, to)) {
                return Some(start);
            }
            from = None;
        }
    }
    from.filter(|start| enough(*start, places[places.len() - 1]))
}

fn range(values: &[f64]) -> Option<[f64; 2]> {
    let first = *values.first()?;
    let wider = |[low, high]: [f64; 2], value: &f64| [low.min(*value), high.max(*value)];
    Some(values.iter().fold([first; 2], wider))
}

/// Returns the value below which a `share` (0 to 1) of the values lies, straight between two values; `None`
/// without values.
#[must_use]
pub fn percentile(values: &[f64], share: f64) -> Option<f64> {
    let place = share * values.len().checked_sub(1)? as f64;
    let at = (place.floor() as usize).min(values.len() - 1);
    let mut own = values.to_vec();
    let (_, below, beyond) = own.select_nth_unstable_by(at, f64::total_cmp);
    let below = *below;
    let above = beyond.iter().copied().min_by(f64::total_cmp).unwrap_or(below);
    Some(below + (place - at as f64) * (above - below))
}

/// Returns the largest standard deviation of the values within stretches of this length; of all rows where
/// there are fewer, whose length is then returned. `None` without values.
#[must_use]
pub fn largest_deviation(places: &[f64], values: &[f64], length: f64) -> Option<WindowValue> {
    largest(places, values, length, true)
}

/// Returns the largest root of the mean square of the values within stretches of this length, as
/// [`largest_deviation`].
#[must_use]
pub fn largest_rms(places: &[f64], values: &[f64], length: f64) -> Option<WindowValue> {
    largest(places, values, length, false)
}

fn largest(places: &[f64], values: &[f64], length: f64, about_mean: bool) -> Option<WindowValue> {
    let count = values.len();
    let shift = if about_mean {
        values.iter().sum::<f64>() / count.max(1) as f64
    } else {
        0.0
    };
    // Sums up to each row, about the mean of all: differences of large sums lose digits.
    let mut sums = vec![[0.0; 2]];
    for value in values {
        let [sum, square] = sums[sums.len() - 1];
        let own = value - shift;
        sums.push([sum + own, square + own * own]);
    }
    let of = |from: usize, to: usize| {
        let rows = (to - from) as f64;
        let [mean, square] = [0, 1].map(|k| (sums[to][k] - sums[from][k]) / rows);
        let taken = if about_mean { mean * mean } else { 0.0 };
        libm::sqrt((square - taken).max(0.0))
    };
    let (first, last) = (*places.first()?, *places.last()?);
    let mut best = WindowValue {
        value: of(0, count),
        start: first,
        length: last - first,
    };
    if last - first < length {
        return Some(best);
    }
    best.value = -1.0;
    let mut to = 0;
    for from in 0..count {
        // The row that ends the stretch is the first of the next one.
        while to < count && places[to] - places[from] < length * (1.0 - 1e-12) {
            to += 1;
        }
        if to == count {
            break;
        }
        let value = of(from, to);
        if value > best.value {
            best = WindowValue {
                value,
                start: places[from],
                length,
            };
        }
    }
    Some(best)
}
