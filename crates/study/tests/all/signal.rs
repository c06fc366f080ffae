//! Filters and statistics of sampled values against closed forms.

use std::f64::consts::{PI, SQRT_2};

use proptest::prelude::*;
use study::signal::{
    BandPass, Instability, LowPass, Spectrum, SpectrumError, Stretch, TooCoarse, largest_deviation,
    largest_mean, largest_range, largest_rms, largest_rmst, percentile, sliding_means, sustained,
};

fn times(interval: f64, count: usize) -> Vec<f64> {
    (0..count).map(|row| row as f64 * interval).collect()
}

fn sine(times: &[f64], frequency: f64) -> Vec<f64> {
    times.iter().map(|t| (2.0 * PI * frequency * t).sin()).collect()
}

/// A sine comes out with the closed form of the gain and without delay, far from the ends.
#[test]
fn analytic_a_sine_passes_with_the_filters_gain_and_no_delay() {
    let filter = LowPass::new(0.005, 15.0).unwrap();
    assert!((filter.gain(15.0) - 1.0 / SQRT_2).abs() < 1e-12);
    assert!((filter.gain(0.0) - 1.0).abs() < 1e-15);
    // Fourth order: 24 dB an octave far above the cutoff, a little more by the bilinear transform.
    assert!(filter.gain(90.0) / filter.gain(45.0) < 1.0 / 16.0);
    let t = times(0.005, 4000);
    for frequency in [1.0, 5.0, 15.0, 30.0, 60.0] {
        let own = sine(&t, frequency);
        let filtered = filter.apply(&own);
        let gain = filter.gain(frequency);
        for row in 500..3500 {
            let error = filtered[row] - gain * own[row];
            assert!(error.abs() < 1e-9, "{frequency} Hz, row {row}: {error}");
        }
    }
}

/// A constant and a straight line pass unchanged, to the ends; no value, one value, two values are no
/// trouble.
#[test]
fn limits_lines_pass_a_filter_to_their_ends() {
    let filter = LowPass::new(0.005, 10.0).unwrap();
    let line: Vec<f64> = times(0.005, 1000).iter().map(|t| 3.0 - 2.0 * t).collect();
    let filtered = filter.apply(&line);
    // What the start of the reflected values excites decays over three periods of the cutoff.
    assert!(line.iter().zip(&filtered).all(|(a, b)| (a - b).abs() < 2e-6));
    assert!(filter.apply(&[]).is_empty());
    assert!((filter.apply(&[2.0])[0] - 2.0).abs() < 1e-12);
    let two = filter.apply(&[2.0, 2.0]);
    assert!(two.iter().all(|value| (value - 2.0).abs() < 1e-12));
}

proptest! {
    /// A filtered value is the same to the last bit whether the values end as far behind it as it looks
    /// ahead, or anywhere later.
    #[test]
    fn issue_047_a_filter_looks_a_bounded_number_of_rows_ahead(
        values in prop::collection::vec(-1e6..1e6_f64, 2..600),
        cut in 0.0..1.0_f64,
        cutoff in 5.0..50.0_f64,
        interval in 0.001..0.005_f64,
    ) {
        let filter = LowPass::new(interval, cutoff).unwrap();
        let rows = 1 + (cut * (values.len() - 1) as f64) as usize;
        let seen = (rows + filter.rows_ahead()).min(values.len());
        let (whole, part) = (filter.apply(&values), filter.apply(&values[..seen]));
        prop_assert_eq!(whole.len(), values.len());
        for row in 0..rows {
            prop_assert_eq!(whole[row].to_bits(), part[row].to_bits(), "row {} of {}", row, rows);
        }
    }
}

/// The blocks of the backward pass cannot be seen: one pass from end to end has the same values to rounding.
#[test]
fn analytic_blocks_of_a_filter_are_one_pass() {
    let (interval, cutoff) = (0.005, 15.0);
    let filter = LowPass::new(interval, cutoff).unwrap();
    let values: Vec<f64> = (0..3000).map(|row| f64::from(row * row % 1009) - 500.0).collect();
    // Butterworth's filter of second order, forward, then over the turned values.
    let k = (PI * cutoff * interval).tan() / (SQRT_2 - 1.0).sqrt().sqrt();
    let scale = 1.0 / (1.0 + SQRT_2 * k + k * k);
    let (b, a1, a2) = (
        k * k * scale,
        2.0 * (k * k - 1.0) * scale,
        (1.0 - SQRT_2 * k + k * k) * scale,
    );
    let pass = |x: &[f64]| {
        let mut y = vec![x[0]; x.len()];
        for row in 2..x.len() {
            y[row] = b * (x[row] + 2.0 * x[row - 1] + x[row - 2]) - a1 * y[row - 1] - a2 * y[row - 2];
        }
        y.reverse();
        y
    };
    let one = pass(&pass(&values));
    let filtered = filter.apply(&values);
    for row in 500..2500 {
        let error = (filtered[row] - one[row]).abs();
        assert!(error < 1e-10 * 500.0, "row {row}: {error}");
    }
}

#[test]
fn input_a_filter_refuses_rows_that_are_too_far_apart() {
    let refused = LowPass::new(0.02, 15.0).unwrap_err();
    assert_eq!(
        refused,
        TooCoarse {
            interval: 0.02,
            cutoff: 15.0
        }
    );
    assert!(refused.to_string().contains("0.0166"), "{refused}");
    assert!(LowPass::new(1.0 / 60.0, 15.0).is_ok());
    assert!(LowPass::new(0.0, 15.0).is_err());
}

/// A half sine of amplitude A and duration T stays above `A cos(πτ/2T)` for the time τ.
#[test]
fn analytic_the_level_that_a_half_sine_holds_for_50_ms() {
    let interval = 0.0005;
    let t = times(interval, 4001);
    let (amplitude, duration, start) = (1.2, 0.2, 0.7);
    let pulse = |time: f64| {
        let phase = (time - start) / duration;
        if (0.0..=1.0).contains(&phase) {
            amplitude * (PI * phase).sin()
        } else {
            0.0
        }
    };
    let values: Vec<f64> = t.iter().map(|time| pulse(*time)).collect();
    for held in [0.02, 0.05, 0.15] {
        let found = sustained(&t, &values, held).unwrap();
        let level = amplitude * (0.5 * PI * held / duration).cos();
        assert!(
            (found.value - level).abs() < 2e-5,
            "{held}: {} {level}",
            found.value
        );
        let begin = start + 0.5 * (duration - held);
        assert!((found.start - begin).abs() < 1e-3);
    }
}

/// A plateau that is shorter than the length does not count, one that is as long does; and straight flanks
/// between rows are taken as straight.
#[test]
fn limits_an_exceedance_of_exactly_the_length_counts() {
    let t = times(0.01, 201);
    let plateau = |rows: std::ops::Range<usize>| -> Vec<f64> {
        (0..201)
            .map(|row| f64::from(u8::from(rows.contains(&row))))
            .collect()
    };
    // Rows 50 to 55: a plateau of 0.05 s.
    let long = sustained(&t, &plateau(50..56), 0.05).unwrap();
    assert!((long.value - 1.0).abs() < 1e-12 && (long.start - 0.5).abs() < 1e-9);
    // A plateau of 0.04 s with flanks of 0.01 s: over 0.05 s it is above one half.
    let short = sustained(&t, &plateau(50..55), 0.05).unwrap();
    assert!((short.value - 0.5).abs() < 1e-9, "{}", short.value);
    // A constant holds everywhere; a run that is too short has no answer.
    assert_eq!(sustained(&t, &vec![0.3; 201], 2.0).unwrap().value, 0.3);
    assert!(sustained(&t, &vec![0.3; 201], 2.1).is_none());
    assert!(sustained(&[], &[], 0.05).is_none());
}

/// Exceedance over a distance with uneven places: a ramp of slope one from 0 to 10 holds 10 - L over L at its
/// end.
#[test]
fn analytic_a_ramp_over_uneven_places_holds_its_end_less_the_length() {
    let places: Vec<f64> = (0..=100).map(|i| 10.0 * (f64::from(i) / 100.0).powi(2)).collect();
    let found = sustained(&places, &places, 3.0).unwrap();
    assert!((found.value - 7.0).abs() < 1e-9);
    assert!((found.start - 7.0).abs() < 1e-9);
}

#[test]
fn analytic_percentiles_of_a_uniform_row() {
    let values: Vec<f64> = (0..=100).rev().map(f64::from).collect();
    assert_eq!(percentile(&values, 0.95), Some(95.0));
    assert_eq!(percentile(&values, 1.0), Some(100.0));
    assert_eq!(percentile(&[1.0, 2.0], 0.25), Some(1.25));
    assert_eq!(percentile(&[], 0.95), None);
}

/// A sine that lasts for a part of the run: over a stretch within it, deviation and rms are `a/√2`; with a
/// mean, the rms has it and the deviation has not.
#[test]
fn analytic_deviation_and_rms_of_a_sine_within_a_run() {
    let t = times(0.01, 2001);
    let values: Vec<f64> = t
        .iter()
        .map(|t| {
            let inside = (5.0..12.0).contains(t);
            1.0 + if inside { 0.4 * (2.0 * PI * t).sin() } else { 0.0 }
        })
        .collect();
    let deviation = largest_deviation(&t, &values, 4.0).unwrap();
    assert!(
        (deviation.value - 0.4 / SQRT_2).abs() < 1e-9,
        "{}",
        deviation.value
    );
    assert!((4.9..8.1).contains(&deviation.start) && deviation.length == 4.0);
    let swing: Vec<f64> = values.iter().map(|own| own - 1.0).collect();
    let rms = largest_rms(&t, &swing, 4.0).unwrap();
    assert!((rms.value - 0.4 / SQRT_2).abs() < 1e-9, "{}", rms.value);
    // A run that is shorter than the stretch is taken whole, and says so.
    let short = largest_rms(&t[..101], &values[..101], 4.0).unwrap();
    assert!((short.length - 1.0).abs() < 1e-12 && (short.value - 1.0).abs() < 1e-12);
}

/// Small changes on a large mean keep their digits.
#[test]
fn limits_deviation_on_a_large_mean() {
    let t = times(0.01, 1000);
    let values: Vec<f64> = sine(&t, 1.0).iter().map(|own| 1e6 + 1e-3 * own).collect();
    let found = largest_deviation(&t, &values, 5.0).unwrap();
    assert!(
        (found.value / (1e-3 / SQRT_2) - 1.0).abs() < 1e-5,
        "{}",
        found.value
    );
}

/// A sine of amplitude A has the variance A²/2; under Hann's window its density stands within two lines of
/// its frequency, of which the middle one is A²/2 over 1.5 lines if the frequency is one of them.
#[test]
fn analytic_issue_036_the_density_of_a_sine_is_its_variance() {
    let (interval, amplitude) = (0.005, 3.0);
    let t = times(interval, 8192);
    for frequency in [12.5, 20.3, 77.7] {
        let values: Vec<f64> = sine(&t, frequency)
            .iter()
            .map(|own| 100.0 + amplitude * own)
            .collect();
        let spectrum = Spectrum::welch(&t, &values, None).unwrap();
        assert_eq!((spectrum.rows, spectrum.segments), (1024, 15));
        assert!((spectrum.resolution() - 200.0 / 1024.0).abs() < 1e-12);
        let variance = amplitude * amplitude / 2.0;
        let error = spectrum.variance() / variance - 1.0;
        assert!(error.abs() < 2e-3, "{frequency} Hz: {error}");
        assert!(
            (spectrum.peak() - frequency).abs() <= spectrum.resolution(),
            "{frequency} Hz"
        );
        // Twenty lines off, Hann's window lets through (1/(20 π (20² - 1)))² = 1.6e-9 of the peak. The mean
        // over a broken cycle stands at the first lines.
        let far = spectrum.frequencies.iter().zip(&spectrum.density).skip(3);
        let far = far.filter(|(own, _)| (**own - frequency).abs() > 20.0 * spectrum.resolution());
        let most = far.map(|(_, density)| *density).fold(0.0, f64::max);
        assert!(most < 1e-7 * variance, "{frequency} Hz leaks: {most}");
    }
    let values: Vec<f64> = sine(&t, 12.5).iter().map(|own| amplitude * own).collect();
    let spectrum = Spectrum::welch(&t, &values, None).unwrap();
    let middle = spectrum.density[64];
    let expected = amplitude * amplitude / 2.0 / (1.5 * spectrum.resolution());
    assert!((middle / expected - 1.0).abs() < 1e-9, "{middle} {expected}");
}

/// White noise of variance s² at a rate f has the density 2 s²/f at all frequencies: the mean over 511 lines
/// of 255 segments has a standard deviation of about 0.4 %, a single line one of about 8 %.
#[test]
fn analytic_issue_036_white_noise_is_flat() {
    let (interval, rows) = (0.01, 1 << 17);
    let mut state = 1_u64;
    // Marsaglia's xorshift; uniform between -1 and 1 with the variance 1/3.
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let values: Vec<f64> = (0..rows).map(|_| next()).collect();
    let t = times(interval, rows);
    let spectrum = Spectrum::welch(&t, &values, Some(100.0 / 1024.0)).unwrap();
    assert_eq!((spectrum.rows, spectrum.segments), (1024, 255));
    let expected = 2.0 / 3.0 * interval;
    let inner = &spectrum.density[2..512];
    let mean = inner.iter().sum::<f64>() / inner.len() as f64;
    assert!((mean / expected - 1.0).abs() < 0.015, "{mean} {expected}");
    for density in inner {
        assert!((density / expected - 1.0).abs() < 0.4, "{density} {expected}");
    }
}

#[test]
fn input_issue_036_spectra_need_even_rows_and_enough_of_them() {
    let t = times(0.01, 100);
    let values = sine(&t, 5.0);
    let mut uneven = t.clone();
    uneven[50] += 0.002;
    let found = Spectrum::welch(&uneven, &values, None).unwrap_err();
    assert!(matches!(found, SpectrumError::Uneven { .. }), "{found}");
    for (rows, resolution) in [(4, None), (100, Some(0.5)), (100, Some(1.0 - 1e-3))] {
        let found = Spectrum::welch(&t[..rows], &values[..rows], resolution).unwrap_err();
        assert!(matches!(found, SpectrumError::TooShort { .. }), "{found}");
    }
    for resolution in [0.0, -1.0, f64::NAN, 50.0] {
        let found = Spectrum::welch(&t, &values, Some(resolution)).unwrap_err();
        assert!(matches!(found, SpectrumError::Resolution { .. }), "{found}");
    }
    assert_eq!(Spectrum::welch(&t, &values, Some(2.0)).unwrap().rows, 64);
}

/// The band-pass has -3 dB at both ends, and sines of 0.5 g come out with its gain and no delay.
#[test]
fn analytic_a_band_passes_with_its_gain() {
    let interval = 0.005;
    let filter = BandPass::new(interval, [0.5, 10.0]).unwrap();
    // The gain of the other end is within 1e-5 of one there.
    assert!((filter.gain(0.5) - 1.0 / SQRT_2).abs() < 1e-5);
    assert!((filter.gain(10.0) - 1.0 / SQRT_2).abs() < 1e-5);
    // The high-pass as it is written down: 1/(1 + c (tan f1 / tan f)^4).
    let tangent = |frequency: f64| (PI * frequency * interval).tan();
    for frequency in [0.1, 0.2, 0.5, 1.0, 3.0] {
        let high = 1.0 / (1.0 + (SQRT_2 - 1.0) * (tangent(0.5) / tangent(frequency)).powi(4));
        let low = LowPass::new(interval, 10.0).unwrap().gain(frequency);
        assert!((filter.gain(frequency) - high * low).abs() < 1e-12);
    }
    let t = times(interval, 12_000);
    for (frequency, rms) in [(3.0, 0.354), (0.2, 0.0206)] {
        let own: Vec<f64> = sine(&t, frequency).iter().map(|own| 0.5 * own).collect();
        let filtered = filter.apply(&own);
        for row in 3000..9000 {
            let error = filtered[row] - filter.gain(frequency) * own[row];
            assert!(error.abs() < 1e-7, "{frequency} Hz, row {row}: {error}");
        }
        if frequency > 1.0 {
            // Any 2 s are six periods.
            let found = largest_rms(&t[3000..9000], &filtered[3000..9000], 2.0).unwrap();
            assert!((found.value - rms).abs() < 2e-3, "{}", found.value);
        } else {
            let most = filtered[3000..9000]
                .iter()
                .fold(0.0, |most: f64, own| most.max(own.abs()));
            assert!(most < 0.1 && (most / SQRT_2 - rms).abs() < 1e-3, "{most}");
        }
    }
    assert!(BandPass::new(0.03, [0.5, 10.0]).is_err());
}

/// Means of a straight line are its values in the middles of the windows, whatever the rows; a triangle has
/// its area over the window.
#[test]
fn analytic_sliding_means() {
    let places: Vec<f64> = (0..200)
        .map(|row| 0.1 * f64::from(row) + 0.03 * f64::from(row % 3))
        .collect();
    let line: Vec<f64> = places.iter().map(|x| 4.0 - 0.7 * x).collect();
    let means = sliding_means(&places, &line, 1.234);
    assert!(means.len() > 180);
    for (mean, x) in means.iter().zip(&places) {
        assert!((mean - (4.0 - 0.7 * (x + 0.617))).abs() < 1e-12);
    }
    let own: Vec<f64> = (0..400)
        .map(|row| -(1.0 - (0.05 * f64::from(row) - 10.0).abs()).max(0.0))
        .collect();
    let found = largest_mean(&times(0.05, 400), &own, 4.0).unwrap();
    assert!((found.value - 0.25).abs() < 1e-12, "{found:?}");
    assert!(found.start <= 9.0 && found.start >= 7.0 - 1e-9);
    assert_eq!(largest_mean(&times(0.05, 10), &own[..10], 4.0), None);
}

/// About a line a ramp has nothing; a sine over n whole periods has `a² (1/2 - 3 cos²φ/(πn)²)`, φ its phase
/// in the middle, and at the best phase a/√2.
#[test]
fn analytic_rms_about_a_line() {
    let t = times(0.001, 4001);
    let ramp: Vec<f64> = t.iter().map(|t| 3.0 + 20.0 * t).collect();
    assert!(largest_rmst(&t, &ramp, 2.0).unwrap().value < 1e-5);
    for periods in [1.0, 2.0, 5.0] {
        for phase in [0.0, 0.4, 1.2, PI / 2.0] {
            let own: Vec<f64> = t
                .iter()
                .map(|t| 7.0 + 3.0 * (2.0 * PI * periods * (t - 2.0) / 4.0 + phase).sin() - 5.0 * t)
                .collect();
            let found = largest_rmst(&t, &own, 4.0).unwrap();
            let taken = 3.0 * (phase.cos() / (PI * periods)).powi(2);
            // Chords between rows have (2 + cos ωΔ)/3 of a sine's mean square.
            let chords = (2.0 + (2.0 * PI * periods / 4000.0).cos()) / 3.0;
            let expected = 3.0 * (0.5 * chords - taken).sqrt();
            assert!(
                (found.value - expected).abs() < 1e-6,
                "{periods} {phase}: {found:?} {expected}"
            );
            assert!((found.length - 4.0).abs() < 1e-12 && found.start == 0.0);
        }
    }
    let long = times(0.005, 4000);
    let found = largest_rmst(&long, &sine(&long, 1.0), 4.0).unwrap();
    assert!((found.value - 1.0 / SQRT_2).abs() < 2e-4, "{found:?}");
    // Shorter rows: all of them.
    let found = largest_rmst(&t, &ramp, 10.0).unwrap();
    assert!((found.length - 4.0).abs() < 1e-12);
}

/// Pulses of 40 ms leave no trace at a hold time of 50 ms, those of 60 ms do; a ramp has `k (T - 2h)`, a sine
/// `2 a cos(π f h)`.
#[test]
fn analytic_range_without_short_peaks() {
    let interval = 0.002;
    let t = times(interval, 5001);
    let pulse = |length: f64, size: f64| -> Vec<f64> {
        // Edges of one row outside of the pulse.
        let inside = |t: f64| (3.0 - 1e-9..=3.0 + length + 1e-9).contains(&t);
        t.iter().map(|t| if inside(*t) { size } else { 0.0 }).collect()
    };
    let range = |values: &[f64]| largest_range(&t, values, 1.0, 0.05).unwrap();
    // The straight edges of 2 ms add to the length: of 40 ms, at the height zero, 44 ms.
    assert!(range(&pulse(0.04, 1.0)).value < 1e-12);
    assert!(range(&pulse(0.04, -1.0)).value < 1e-12);
    assert!((range(&pulse(0.06, 1.0)).value - 1.0).abs() < 1e-12);
    assert!((range(&pulse(0.06, -1.0)).value - 1.0).abs() < 1e-12);
    // At 48 ms the edges hold for 50 ms at half of the height.
    assert!((range(&pulse(0.048, 1.0)).value - 0.5).abs() < 1e-9);
    let ramp: Vec<f64> = t.iter().map(|t| 0.3 * t).collect();
    assert!(
        (range(&ramp).value - 0.3 * 0.9).abs() < 1e-9,
        "{:?}",
        range(&ramp)
    );
    let own = sine(&t, 2.5);
    assert!((range(&own).value - 2.0 * (PI * 2.5 * 0.05).cos()).abs() < 1e-3);
    // A swing of 40 ms up and 40 ms down holds nothing.
    assert!(range(&sine(&t, 12.5)).value < 1e-9);
    assert_eq!(largest_range(&t[..10], &own[..10], 1.0, 0.05), None);
    let short = largest_range(&t[..250], &ramp[..250], 1.0, 0.05).unwrap();
    assert!((short.length - 0.498).abs() < 1e-12 && (short.value - 0.3 * 0.398).abs() < 1e-9);
}

proptest! {
    /// Ranges against their definition on a fine grid of places.
    #[test]
    fn analytic_ranges_are_those_of_their_definition(
        values in prop::collection::vec(-1.0..1.0_f64, 8..30),
        steps in prop::collection::vec(0.5..1.5_f64, 30),
        hold in 0.3..2.5_f64,
        length in 3.0..6.0_f64,
    ) {
        let mut places = vec![0.0];
        for step in &steps[..values.len() - 1] {
            places.push(places[places.len() - 1] + step);
        }
        let last = places[places.len() - 1];
        let length = length.min(last);
        let at = |x: f64| {
            let row = places.partition_point(|own| *own <= x).clamp(1, places.len() - 1);
            let share = (x - places[row - 1]) / (places[row] - places[row - 1]);
            values[row - 1] + (values[row] - values[row - 1]) * share
        };
        let grid = 0.01;
        let fine: Vec<f64> = (0..=(last / grid) as usize).map(|k| at(k as f64 * grid)).collect();
        let (held, reach) = ((hold / grid).ceil() as usize, ((length - hold) / grid).floor() as usize);
        let ends: Vec<[f64; 2]> = fine.windows(held + 1).map(|own| {
            own.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(*v), high.max(*v)])
        }).collect();
        let mut expected = 0.0_f64;
        for window in ends.windows((reach + 1).min(ends.len())) {
            let top = window.iter().map(|own| own[0]).fold(f64::NEG_INFINITY, f64::max);
            let bottom = window.iter().map(|own| own[1]).fold(f64::INFINITY, f64::min);
            expected = expected.max(top - bottom);
        }
        let found = largest_range(&places, &values, length, hold).unwrap();
        // Slopes are at most 4. The grid misses rows between its places, by a step at the top and one at the
        // bottom; it shortens windows and lengthens the hold time by up to two steps each.
        prop_assert!(found.value >= expected - 4.0 * 2.0 * grid, "{} {}", found.value, expected);
        prop_assert!(found.value <= expected + 4.0 * 6.0 * grid, "{} {}", found.value, expected);
    }
}

/// A triangle above a level, a line above a level that falls, and what is above at both ends.
#[test]
fn analytic_the_longest_stretch_above_a_level() {
    let x = times(0.5, 41);
    let triangle: Vec<f64> = x.iter().map(|x| 5.0 - (x - 10.0).abs()).collect();
    let found = Stretch::longest_above(&x, &triangle, &[2.2; 41]).unwrap();
    assert!(
        (found.start - 7.2).abs() < 1e-12 && (found.length - 5.6).abs() < 1e-12,
        "{found:?}"
    );
    // The level falls from 6 by 0.2 x, and the triangle is above from where 5 - (10 - x) = 6 - 0.2 x.
    let falling: Vec<f64> = x.iter().map(|x| 6.0 - 0.2 * x).collect();
    let found = Stretch::longest_above(&x, &triangle, &falling).unwrap();
    let (from, to) = (11.0 / 1.2, 9.0 / 0.8);
    assert!(
        (found.start - from).abs() < 1e-9 && (found.length - (to - from)).abs() < 1e-9,
        "{found:?}"
    );
    let middle = found.mean(&x, &x).unwrap();
    assert!((middle - 0.5 * (from + to)).abs() < 1e-9);
    let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
    let whole = Stretch {
        start: 0.0,
        length: 20.0,
    };
    // Between rows x² is a chord: h²/6 more.
    assert!((whole.mean(&x, &squares).unwrap() - (400.0 / 3.0 + 0.25 / 6.0)).abs() < 1e-9);
    assert_eq!(
        Stretch::longest_above(&x, &triangle, &[-99.0; 41])
            .unwrap()
            .length,
        20.0
    );
    assert_eq!(
        Stretch::longest_above(&x, &triangle, &[99.0; 41]).unwrap().length,
        0.0
    );
    assert_eq!(Stretch::longest_above(&[], &[], &[]), None);
}

/// Hunting of 2.7 Hz beside the force of a curve: the rms of the hunting alone.
#[test]
fn analytic_the_rms_about_the_dominant_frequency() {
    // It ends where the sine is zero, so that its reflection goes on with it.
    let t = times(0.005, 8001);
    let places: Vec<f64> = t.iter().map(|t| 25.0 * t).collect();
    let own: Vec<f64> = t
        .iter()
        .map(|t| 2.0 * (2.0 * PI * 2.7 * t).sin() + 40.0 / (1.0 + (-(t - 20.0)).exp()))
        .collect();
    let found = Instability::of(&t, &places, &own, 100.0).unwrap();
    assert!((found.frequency - 2.7).abs() < 0.15, "{found:?}");
    let gain = BandPass::new(0.005, [found.frequency - 2.0, found.frequency + 2.0])
        .unwrap()
        .gain(2.7);
    assert!((found.rms.value - gain * SQRT_2).abs() < 0.01, "{found:?}");
    assert!((found.rms.length - 100.0).abs() < 1e-9);
    assert!(Instability::of(&t[..5], &places[..5], &own[..5], 100.0).is_err());
}
