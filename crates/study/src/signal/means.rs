//! Means over sliding windows, and the root of the mean square about a straight line.
//!
//! Between two rows a value is a straight line; windows begin at rows, end anywhere, and are integrated
//! exactly: of a stretch from (x₀, v₀) to (x₁, v₁) with h = x₁ - x₀,
//! `∫v = h (v₀ + v₁)/2`, `∫v² = h (v₀² + v₀v₁ + v₁²)/3`, `∫xv = h (x₀(2v₀ + v₁) + x₁(v₀ + 2v₁))/6`.
//! Sums up to each row make that one pass over the rows, whatever the window's length.
//!
//! **About a straight line** (RMSt). The line of least squares in a window of length T with τ from its middle
//! is `⟨v⟩ + 12 ⟨τv⟩/T² τ`, and what remains has the mean square `⟨v²⟩ - ⟨v⟩² - 12 ⟨τv⟩²/T²`. A ramp has
//! none. A sine of amplitude a over n whole periods, of phase φ at the middle, has `a² (1/2 - 3
//! cos²φ/(πn)²)`: the best line takes a part of it, none where φ is 90°.
//!
//! Limits: a largest value between two windows that begin at rows is missed by a part of second order of the
//! rows' distance.

use super::WindowValue;

/// Integrals from the first row to each, of values less their mean, over places from the first row.
struct Integrals<'v> {
    places: &'v [f64],
    values: &'v [f64],
    shift: f64,
    /// ∫v, ∫xv, ∫v².
    sums: Vec<[f64; 3]>,
}

/// Integrals over a window.
struct Window {
    /// ∫v, ∫xv, ∫v²
    sums: [f64; 3],
    /// Its beginning and end from the first row.
    ends: [f64; 2],
}

impl<'v> Integrals<'v> {
    fn new(places: &'v [f64], values: &'v [f64]) -> Self {
        let shift = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let mut own = Self {
            places,
            values,
            shift,
            sums: Vec::with_capacity(values.len()),
        };
        let mut sum = [0.0; 3];
        for row in 0..values.len() {
            if row > 0 {
                sum = add(sum, stretch(own.at(row - 1), own.at(row)));
            }
            own.sums.push(sum);
        }
        own
    }

    /// Place and value of a row.
    fn at(&self, row: usize) -> [f64; 2] {
        [self.places[row] - self.places[0], self.values[row] - self.shift]
    }

    /// Gives the first row of each window of a length that ends within the rows, and the window, to `take`.
    fn windows(&self, length: f64, mut take: impl FnMut(usize, &Window)) {
        let count = self.values.len();
        // The row at the window's end, or before it.
        let mut before = 0;
        for from in 0..count {
            let [begin, _] = self.at(from);
            let end = begin + length;
            while before + 1 < count && self.at(before + 1)[0] <= end {
                before += 1;
            }
            let [x, v] = self.at(before);
            let mut sums = add(self.sums[before], self.sums[from].map(|own| -own));
            match (before + 1 < count).then(|| self.at(before + 1)) {
                Some([next, other]) => {
                    let last = [end, v + (other - v) * (end - x) / (next - x)];
                    sums = add(sums, stretch([x, v], last));
                }
                // Rounding may put the end of the last window behind the last row.
                None if end - x > 1e-9 * length => break,
                None => {}
            }
            let ends = [begin, end];
            take(from, &Window { sums, ends });
        }
    }

    /// The window of all rows.
    fn whole(&self) -> Option<Window> {
        let last = self.values.len().checked_sub(1)?;
        Some(Window {
            sums: self.sums[last],
            ends: [0.0, self.at(last)[0]],
        })
    }
}

impl Window {
    fn length(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// The root of the mean square about the straight line of least squares.
    fn about_line(&self) -> f64 {
        let length = self.length();
        let [mean, moment, square] = self.sums.map(|own| own / length);
        let tilt = moment - 0.5 * (self.ends[0] + self.ends[1]) * mean;
        libm::sqrt((square - mean * mean - 12.0 * (tilt / length) * (tilt / length)).max(0.0))
    }
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Integrals over a straight line between two points.
fn stretch([x0, v0]: [f64; 2], [x1, v1]: [f64; 2]) -> [f64; 3] {
    let h = x1 - x0;
    [
        h * (v0 + v1) / 2.0,
        h * (x0 * (2.0 * v0 + v1) + x1 * (v0 + 2.0 * v1)) / 6.0,
        h * (v0 * v0 + v0 * v1 + v1 * v1) / 3.0,
    ]
}

/// Returns the means of the values over windows of this length (in the unit of the places, which grow), one
/// for each row at which a window begins that ends within the rows.
#[must_use]
pub fn sliding_means(places: &[f64], values: &[f64], length: f64) -> Vec<f64> {
    let integrals = Integrals::new(places, values);
    let mut means = Vec::with_capacity(values.len());
    integrals.windows(length, |_, own| {
        means.push(own.sums[0] / own.length() + integrals.shift);
    });
    means
}

/// Returns the size of the sliding mean ([`sliding_means`]) that is largest in size. `None` if the places do
/// not reach so far.
#[must_use]
pub fn largest_mean(places: &[f64], values: &[f64], length: f64) -> Option<WindowValue> {
    let sizes = sliding_means(places, values, length).into_iter().map(f64::abs);
    let own = sizes.zip(places).map(|(value, start)| WindowValue {
        value,
        start: *start,
        length,
    });
    own.reduce(|most, own| if own.value > most.value { own } else { most })
}

/// Returns the largest root of the mean square of the values about a straight line, within windows of this
/// length; of all rows where there are fewer, whose length is then returned. `None` with fewer than two rows.
#[must_use]
pub fn largest_rmst(places: &[f64], values: &[f64], length: f64) -> Option<WindowValue> {
    let integrals = Integrals::new(places, values);
    let mut best: Option<WindowValue> = None;
    let mut see = |from: usize, own: &Window| {
        let value = own.about_line();
        if best.is_none_or(|best| value > best.value) {
            best = Some(WindowValue {
                value,
                start: places[from],
                length: own.length(),
            });
        }
    };
    let whole = integrals.whole().filter(|own| own.length() > 0.0)?;
    if whole.length() < length * (1.0 - 1e-9) {
        see(0, &whole);
    } else {
        integrals.windows(length, see);
    }
    best
}
