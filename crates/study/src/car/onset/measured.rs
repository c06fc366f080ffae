//! The measures of a run that its statistics do not have.

use quantity::Kind;
use wheelrail::track::RailLines;

use super::CarCase;
use crate::car::hunting::WINDOW;
use crate::car::run::CarResult;
use crate::car::statistics::Rules;
use crate::car::worst::Worst;
use crate::signal::{LowPass, largest_deviation};

/// Time between two rows, s.
pub(super) const INTERVAL: f64 = 0.005;

/// Returns the standard deviation of the body's lateral acceleration, m/s²; zero of a run that derailed
/// before its statistics began.
pub(super) fn deviation(case: &CarCase, result: &CarResult) -> f64 {
    let worst = Worst::named("lateral_acceleration_deviation");
    let found = worst.and_then(|own| own.of(&result.summary.statistics));
    found.map_or(0.0, |own| {
        own.value.value / Kind::RideAcceleration.from_si(case.simulation.output_units)
    })
}

/// The rows of a run from its settling time on.
pub(super) struct Settled<'r> {
    result: &'r CarResult,
    times: &'r [f64],
    first: usize,
}

impl<'r> Settled<'r> {
    pub(super) fn of(result: &'r CarResult, settle: f64) -> Self {
        let times = result.column("time").unwrap_or_default();
        // The last row may stand nearer to the one before it.
        let times = &times[..times.len().saturating_sub(1)];
        Self {
            result,
            times,
            first: times.partition_point(|own| *own < settle * (1.0 - 1e-12)),
        }
    }

    /// Returns a column up to its last even row.
    fn column(&self, name: &str) -> &'r [f64] {
        let values = self.result.column(name).unwrap_or_default();
        &values[..values.len().min(self.times.len())]
    }

    /// Returns the largest rms about the mean of filtered values of all rows.
    fn rms(&self, values: &[f64]) -> f64 {
        let (Some(times), Some(values)) = (self.times.get(self.first..), values.get(self.first..)) else {
            return 0.0;
        };
        largest_deviation(times, values, Rules::default().rms_time).map_or(0.0, |own| own.value)
    }

    pub(super) fn body_rms(&self) -> f64 {
        let ends = [1, 2].map(|truck| {
            self.rms(self.column(&format!("body_at_truck_{truck}_lateral_acceleration_filtered")))
        });
        ends[0].max(ends[1])
    }

    pub(super) fn truck_rms(&self) -> f64 {
        // Rows of this interval are near enough for the filter.
        let Ok(filter) = LowPass::new(INTERVAL, Rules::default().acceleration_filter) else {
            return 0.0;
        };
        let trucks = [[1, 2], [3, 4]].map(|axles| {
            let [front, rear] = axles.map(|axle| self.column(&format!("axle_{axle}_lateral")));
            let middle: Vec<f64> = front.iter().zip(rear).map(|(a, b)| 0.5 * (a + b)).collect();
            self.rms(&filter.apply(&second_rates(&middle)))
        });
        trucks[0].max(trucks[1])
    }

    /// Returns the largest amplitude of the axles, each that of its windows which half of them reach.
    pub(super) fn amplitude(&self, case: &CarCase, rails: &RailLines) -> f64 {
        let distances = self.column("distance");
        let Some(start) = distances.first() else {
            return 0.0;
        };
        let parameters = &case.parameters;
        let rows = (WINDOW / INTERVAL).round() as usize;
        let mut largest = 0.0_f64;
        for axle in 0..4 {
            let (truck, way) = (axle / 2, [1.0, -1.0]);
            let ahead = 0.5 * way[truck] * parameters.truck_distance
                + way[axle % 2] * parameters.trucks[truck].geometry.axle();
            let places = self.column(&format!("axle_{}_lateral", axle + 1));
            let own: Vec<f64> = places
                .iter()
                .zip(distances)
                .skip(self.first)
                .map(|(lateral, distance)| {
                    let at = parameters.start.distance + (distance - start) + ahead;
                    let [left, right] = rails.irregularities(at);
                    lateral - 0.5 * (left[0] + right[0])
                })
                .collect();
            let windows = own.chunks_exact(rows.min(own.len()).max(1));
            let mut swings: Vec<f64> = windows.map(swing).collect();
            swings.sort_by(f64::total_cmp);
            largest = largest.max(swings.get(swings.len() / 2).copied().unwrap_or_default());
        }
        largest
    }
}

/// Returns half of greatest less least of values.
fn swing(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    0.5 * (most - least)
}

/// Returns second derivatives of values at rows by differences; the first and the last row have those of
/// their neighbors.
fn second_rates(values: &[f64]) -> Vec<f64> {
    let inner = values
        .windows(3)
        .map(|own| (own[0] - 2.0 * own[1] + own[2]) / (INTERVAL * INTERVAL));
    let mut rates = vec![0.0];
    rates.extend(inner);
    rates.push(0.0);
    if let [first, second, .., before, last] = rates.as_mut_slice() {
        (*first, *last) = (*second, *before);
    }
    rates.truncate(values.len());
    rates
}
