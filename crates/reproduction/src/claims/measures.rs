//! The verbs of predicates: what is made of a quantity over a time. Every value is noted, so that a page can
//! show it.
//!
//! Where there are no rows, a value is NaN and the claim cannot be decided.

use mechanics::coil::CoilLaw;
use quantity::Kind;

use super::evidence::ClaimView;
use super::words::{ClaimQuantity, When};

/// Values of a quantity at the rows of a time.
fn chosen(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> Vec<f64> {
    (quantity.series)(run)
        .into_iter()
        .zip((when.rows)(run))
        .filter_map(|(value, counts)| counts.then_some(value))
        .collect()
}

fn average(values: &[f64]) -> f64 {
    if values.is_empty() {
        f64::NAN
    } else {
        values.iter().sum::<f64>() / values.len() as f64
    }
}

fn noted(run: ClaimView<'_>, what: &str, quantity: ClaimQuantity, when: When, value: f64) -> f64 {
    let label = format!("{what}{}, {}, {}", quantity.name, run.name(), when.name);
    run.note(label, value, quantity.kind)
}

/// Mean.
pub(super) fn mean(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let value = average(&chosen(run, quantity, when));
    noted(run, "mean ", quantity, when, value)
}

/// Size of the mean, whatever its sign.
pub(super) fn size(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let value = average(&chosen(run, quantity, when)).abs();
    noted(run, "size of the mean ", quantity, when, value)
}

/// Mean of the size, whatever the sign.
pub(super) fn mean_size(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let sizes: Vec<f64> = chosen(run, quantity, when).iter().map(|v| v.abs()).collect();
    noted(run, "mean size of ", quantity, when, average(&sizes))
}

/// Greatest size, whatever the sign.
pub(super) fn peak(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let values = chosen(run, quantity, when);
    let most = values.iter().fold(f64::NAN, |most, value| value.abs().max(most));
    noted(run, "peak ", quantity, when, most)
}

fn least_and_greatest(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::NAN, f64::NAN), |(least, most), v| {
        (v.min(least), v.max(most))
    })
}

/// Least value.
pub(super) fn least(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let (least, _) = least_and_greatest(&chosen(run, quantity, when));
    noted(run, "least ", quantity, when, least)
}

/// Greatest value.
pub(super) fn greatest(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let (_, most) = least_and_greatest(&chosen(run, quantity, when));
    noted(run, "greatest ", quantity, when, most)
}

/// Greatest less least value.
pub(super) fn range(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let (least, most) = least_and_greatest(&chosen(run, quantity, when));
    noted(run, "range of ", quantity, when, most - least)
}

/// Mean size of the second difference between rows that follow each other: how rough a curve is.
pub(super) fn roughness(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let (values, rows) = ((quantity.series)(run), (when.rows)(run));
    let bends: Vec<f64> = values
        .windows(3)
        .zip(rows.windows(3))
        .filter(|(_, rows)| rows.iter().all(|counts| *counts))
        .map(|(v, _)| (v[2] - 2.0 * v[1] + v[0]).abs())
        .collect();
    noted(run, "roughness of ", quantity, when, average(&bends))
}

/// Returns the number of peaks of a curve: rises after which it falls again by more than 2 % of its greatest
/// size.
pub(super) fn peaks(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let values = chosen(run, quantity, when);
    let most = values.iter().fold(f64::NAN, |most, value| value.abs().max(most));
    let threshold = 0.02 * most;
    let (mut count, mut rising) = (0.0, false);
    let mut extreme = values.first().copied().unwrap_or(f64::NAN);
    for value in values {
        if rising {
            extreme = extreme.max(value);
            if value < extreme - threshold {
                (count, rising, extreme) = (count + 1.0, false, value);
            }
        } else {
            extreme = extreme.min(value);
            if value > extreme + threshold {
                (rising, extreme) = (true, value);
            }
        }
    }
    let count = if most.is_nan() { f64::NAN } else { count };
    let label = format!("peaks of the {}, {}, {}", quantity.name, run.name(), when.name);
    run.note(label, count, Kind::Count)
}

/// Share of a time in which something is so.
pub(super) fn share(run: ClaimView<'_>, so: When, when: When) -> f64 {
    let so = (so.rows, so.name);
    let rows = (when.rows)(run);
    let marks: Vec<f64> = (so.0)(run)
        .into_iter()
        .zip(rows)
        .filter_map(|(so, counts)| counts.then_some(f64::from(u8::from(so))))
        .collect();
    let label = format!("share of time {}, {}, {}", so.1, run.name(), when.name);
    run.note(label, average(&marks), Kind::Dimensionless)
}

/// Returns the value of another quantity where one has its peak.
pub(super) fn at_peak(run: ClaimView<'_>, quantity: ClaimQuantity, when: When, other: ClaimQuantity) -> f64 {
    let values = chosen(run, quantity, when);
    let others = chosen(run, other, when);
    let (_, value) = values
        .iter()
        .zip(&others)
        .fold((f64::NEG_INFINITY, f64::NAN), |found, (v, other)| {
            if v.abs() > found.0 {
                (v.abs(), *other)
            } else {
                found
            }
        });
    let label = format!(
        "{} at the peak of the {}, {}, {}",
        other.name,
        quantity.name,
        run.name(),
        when.name
    );
    run.note(label, value, other.kind)
}

/// Returns whether something is so where a quantity has its peak: 1 or 0.
pub(super) fn so_at_peak(run: ClaimView<'_>, quantity: ClaimQuantity, when: When, so: When) -> bool {
    let values = chosen(run, quantity, when);
    let marks: Vec<bool> = (so.rows)(run)
        .into_iter()
        .zip((when.rows)(run))
        .filter_map(|(so, counts)| counts.then_some(so))
        .collect();
    let (size, found) = values
        .iter()
        .zip(marks)
        .fold((f64::NEG_INFINITY, false), |found, (v, so)| {
            if v.abs() > found.0 { (v.abs(), so) } else { found }
        });
    let value = if size.is_finite() {
        f64::from(u8::from(found))
    } else {
        f64::NAN
    };
    let label = format!(
        "{} at the peak of the {} (1: yes), {}",
        so.name,
        quantity.name,
        run.name()
    );
    run.note(label, value, Kind::Count) == 1.0
}

/// Friction energy per cycle at the side frame, as the summary has it.
pub(super) fn energy_per_cycle(run: ClaimView<'_>) -> f64 {
    run.note(
        format!("energy per cycle at the side frame, {}", run.name()),
        run.energy_per_cycle(),
        Kind::Energy,
    )
}

/// Root mean square of the difference between a quantity and itself one period later, over that of the
/// quantity.
pub(super) fn change_between_cycles(run: ClaimView<'_>, quantity: ClaimQuantity) -> f64 {
    let values = (quantity.series)(run);
    let times = run.column("time");
    let period = run.cycle().period();
    let (mut change, mut all, mut row) = (0.0, 0.0, 0);
    for (time, value) in times.iter().zip(&values) {
        if *time <= 0.5 * period {
            continue;
        }
        while row + 1 < times.len() && times[row + 1] < time + period {
            row += 1;
        }
        let (Some(next), true) = (times.get(row + 1), times[row] <= time + period) else {
            break;
        };
        let part = (time + period - times[row]) / (next - times[row]);
        let later = values[row] + part * (values[row + 1] - values[row]);
        change += (later - value) * (later - value);
        all += value * value;
    }
    let value = if all > 0.0 {
        (change / all).sqrt()
    } else {
        f64::NAN
    };
    let label = format!(
        "change of the {} from cycle to cycle, over its size, {}",
        quantity.name,
        run.name()
    );
    run.note(label, value, Kind::Dimensionless)
}

/// Frequency (rad/s) with which a quantity crosses its mean.
pub(super) fn ringing_frequency(run: ClaimView<'_>, quantity: ClaimQuantity, when: When) -> f64 {
    let (values, rows, times) = ((quantity.series)(run), (when.rows)(run), run.column("time"));
    let middle = average(&chosen(run, quantity, when));
    let (mut crossings, mut time) = (0.0, 0.0);
    for row in 1..values.len().min(rows.len()).min(times.len()) {
        if rows[row - 1] && rows[row] {
            time += times[row] - times[row - 1];
            if (values[row - 1] - middle) * (values[row] - middle) < 0.0 {
                crossings += 1.0;
            }
        }
    }
    let value = if time > 0.0 {
        std::f64::consts::PI * crossings / time
    } else {
        f64::NAN
    };
    let label = format!(
        "ringing frequency of the {}, {}, {}",
        quantity.name,
        run.name(),
        when.name
    );
    run.note(label, value, Kind::Frequency)
}

/// Natural frequency of the free wedge on its coil (rad/s).
pub(super) fn natural_frequency(run: ClaimView<'_>) -> f64 {
    let parameters = &run.case().parameters;
    let value = match &parameters.coil.law {
        CoilLaw::Linear { stiffness } => (stiffness / parameters.wedge.mass).sqrt(),
        CoilLaw::Table(_) | CoilLaw::Given { .. } => f64::NAN,
    };
    let label = format!("natural frequency of the wedge on its coil, {}", run.name());
    run.note(label, value, Kind::Frequency)
}

/// Returns the first of some times (s) at which something is so.
pub(super) fn first_time(run: ClaimView<'_>, so: When, when: When) -> f64 {
    let rows = (so.rows)(run).into_iter().zip((when.rows)(run));
    let value = run
        .column("time")
        .iter()
        .zip(rows)
        .find(|(_, (so, counts))| *so && *counts)
        .map_or(f64::NAN, |(time, _)| *time);
    run.note(
        format!("first time {}, {}, {}", so.name, run.name(), when.name),
        value,
        Kind::Time,
    )
}

/// Returns the largest yaw moment that the face's normal forces could give with all of them at one edge: peak
/// longitudinal force times half the face's width.
pub(super) fn yaw_limit(run: ClaimView<'_>) -> f64 {
    let values = chosen(run, super::words::longitudinal_force, super::words::settled);
    let most = values.iter().fold(f64::NAN, |most, value| value.abs().max(most));
    let label = format!(
        "peak longitudinal force times half the face's width, {}",
        run.name()
    );
    run.note(
        label,
        0.5 * run.case().parameters.wedge.width * most,
        Kind::Moment,
    )
}

/// Amplitude of the bolster's vertical motion.
pub(super) fn amplitude(run: ClaimView<'_>) -> f64 {
    run.cycle().amplitude
}

/// Relative residual of the energy ledger.
pub(super) fn ledger_residual(run: ClaimView<'_>) -> f64 {
    let value = run.ledger_residual().abs();
    let label = format!("relative residual of the energy ledger, {}", run.name());
    run.note(label, value, Kind::Dimensionless)
}

/// Returns the correlation of two runs' curves: the correlation of a quantity's values at the rows that both
/// have.
pub(super) fn correlation(
    one: ClaimView<'_>,
    other: ClaimView<'_>,
    quantity: ClaimQuantity,
    when: When,
) -> f64 {
    let times = |run: ClaimView<'_>| -> Vec<f64> {
        let rows = (when.rows)(run).into_iter();
        let times = run.column("time").iter().copied();
        times
            .zip(rows)
            .filter_map(|(time, counts)| counts.then_some(time))
            .collect()
    };
    let (a, b) = (chosen(one, quantity, when), chosen(other, quantity, when));
    let (a_times, b_times) = (times(one), times(other));
    let mut pairs = Vec::new();
    let mut rows = b_times.iter().zip(&b).peekable();
    for (time, a) in a_times.iter().zip(&a) {
        while rows.next_if(|(own, _)| **own < time - 1e-6).is_some() {}
        if let Some((_, b)) = rows.next_if(|(own, _)| (**own - time).abs() <= 1e-6) {
            pairs.push((*a, *b));
        }
    }
    let count = pairs.len() as f64;
    let (mean_a, mean_b) = pairs.iter().fold((0.0, 0.0), |(sum_a, sum_b), (a, b)| {
        (sum_a + a / count, sum_b + b / count)
    });
    let (ab, aa, bb) = pairs.iter().fold((0.0, 0.0, 0.0), |(ab, aa, bb), (a, b)| {
        let (a, b) = (a - mean_a, b - mean_b);
        (ab + a * b, aa + a * a, bb + b * b)
    });
    // Without rows, or where one does not change, this is not a number.
    let value = ab / (aa * bb).sqrt();
    let label = format!(
        "correlation of the {}, {} with {}, {}",
        quantity.name,
        one.name(),
        other.name(),
        when.name
    );
    one.note(label, value, Kind::Dimensionless)
}

/// Returns whether a run's table lacks what the stand-alone wedge has in this column.
pub(super) fn lacks(run: ClaimView<'_>, column: &str) -> bool {
    let label = format!("columns {column}, {}", run.name());
    run.note(label, f64::from(u8::from(run.has(column))), Kind::Count) == 0.0
}

/// Returns whether all are true; all are evaluated, so that all values are shown.
pub(super) fn all<const N: usize>(parts: [bool; N]) -> bool {
    parts.iter().all(|part| *part)
}

/// So for every one of some runs; all are evaluated.
pub(super) fn every<T, const N: usize>(runs: [T; N], so: impl Fn(T) -> bool) -> bool {
    all(runs.map(so))
}

/// Each greater than the next.
pub(super) fn descending<const N: usize>(values: [f64; N]) -> bool {
    values.windows(2).all(|pair| pair[0] > pair[1])
}

/// Each greater than the next by more than this share of itself.
pub(super) fn descending_by<const N: usize>(share: f64, values: [f64; N]) -> bool {
    values.windows(2).all(|pair| pair[0] * (1.0 - share) > pair[1])
}

/// Returns whether the least and the greatest differ by no more than this share of the greatest.
pub(super) fn within<const N: usize>(share: f64, values: [f64; N]) -> bool {
    let (least, most) = least_and_greatest(&values.map(f64::abs));
    most - least <= share * most
}
