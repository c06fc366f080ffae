//! How long values exceed a level.

/// A stretch of places.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stretch {
    /// Its beginning.
    pub start: f64,
    /// Its length.
    pub length: f64,
}

impl Stretch {
    /// Returns the longest stretch in which values exceed levels without interruption; both are straight
    /// lines between rows, and cross where their difference is zero. The first of those that are as long; of
    /// length zero, at the first place, where nothing is exceeded; `None` without values. Levels are finite;
    /// places grow.
    #[must_use]
    pub fn longest_above(places: &[f64], values: &[f64], levels: &[f64]) -> Option<Self> {
        let excess: Vec<f64> = values
            .iter()
            .zip(levels)
            .map(|(own, level)| own - level)
            .collect();
        let first = *places.first()?;
        let mut best = Self {
            start: first,
            length: 0.0,
        };
        let mut begin = (*excess.first()? > 0.0).then_some(first);
        let mut end = |begin: Option<f64>, to: f64| {
            if let Some(start) = begin
                && to - start > best.length
            {
                best = Self {
                    start,
                    length: to - start,
                };
            }
        };
        for (x, v) in places.windows(2).zip(excess.windows(2)) {
            let crossing = || x[0] + (x[1] - x[0]) * v[0] / (v[0] - v[1]);
            match (v[0] > 0.0, v[1] > 0.0) {
                (false, true) => begin = Some(crossing()),
                (true, false) => end(begin.take(), crossing()),
                _ => {}
            }
        }
        end(begin, places[excess.len() - 1]);
        Some(best)
    }

    /// Returns the mean over the stretch of values that are straight lines between places; the value at its
    /// beginning where it has no length. `None` without values.
    #[must_use]
    pub fn mean(&self, places: &[f64], values: &[f64]) -> Option<f64> {
        let end = self.start + self.length;
        let at = |place: f64| {
            let next = places.partition_point(|own| *own <= place);
            match (next.checked_sub(1), places.get(next)) {
                (Some(row), Some(to)) => {
                    let share = (place - places[row]) / (to - places[row]);
                    Some(values[row] + (values[next] - values[row]) * share)
                }
                (Some(row), None) => values.get(row).copied(),
                (None, _) => values.first().copied(),
            }
        };
        let mut before = [self.start, at(self.start)?];
        if self.length <= 0.0 {
            return Some(before[1]);
        }
        let mut sum = 0.0;
        let inside = places.iter().zip(values);
        let inside = inside.filter(|(place, _)| **place > self.start && **place < end);
        for [x, v] in inside.map(|(x, v)| [*x, *v]).chain([[end, at(end)?]]) {
            sum += 0.5 * (before[1] + v) * (x - before[0]);
            before = [x, v];
        }
        Some(sum / self.length)
    }
}
