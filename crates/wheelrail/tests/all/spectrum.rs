//! Irregularities from spectra: published root mean squares, variance and wavenumbers of realizations, seeds.

use std::f64::consts::TAU;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use wheelrail::track::spectrum::{Realization, Spectrum};

/// Root mean square (cm) of a range of wavelengths, by Simpson's rule in the logarithm of the wavenumber.
fn root_mean_square(spectrum: Spectrum, [shortest, longest]: [f64; 2]) -> f64 {
    let (low, high) = ((TAU / longest).ln(), (TAU / shortest).ln());
    let n = 2000;
    let h = (high - low) / f64::from(n);
    let sum: f64 = (0..=n)
        .map(|i| {
            let wavenumber = (low + f64::from(i) * h).exp();
            let weight = match i {
                0 => 1.0,
                _ if i == n => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * spectrum.density(wavenumber).unwrap() * wavenumber
        })
        .sum();
    100.0 * (sum * h / 3.0).sqrt()
}

/// Root mean squares of the FRA's classes, from a separate calculation with the units as published.
#[test]
fn reproduction_root_mean_squares_by_class() {
    let long = [3.76, 3.45, 2.82, 2.50, 1.56, 0.63];
    let short = [1.371, 1.258, 1.029, 0.914, 0.571, 0.230];
    for class in 1..=6_u8 {
        let index = usize::from(class) - 1;
        let found = root_mean_square(Spectrum::FraVertical(class), [1.524, 304.8]);
        assert!((found - long[index]).abs() < 0.006, "class {class}: {found} cm");
        let found = root_mean_square(Spectrum::FraVertical(class), [3.0, 50.0]);
        assert!((found - short[index]).abs() < 6e-4, "class {class}: {found} cm");
    }
}

fn class_4(seed: u64) -> Realization {
    Realization::new(Spectrum::FraVertical(4), [3.0, 50.0], 400, 30.0, seed).unwrap()
}

/// Over the length after which it repeats itself a realization has the variance of its spectrum.
#[test]
fn analytic_variance_and_wavenumbers_of_a_realization() {
    let realization = class_4(7);
    let step = (TAU / 3.0 - TAU / 50.0) / 400.0;
    // The shortest wave has eight points and more.
    let (start, length, n) = (100.0, 20.0 * TAU / step, 60_000);
    let at = |i: usize| start + length * i as f64 / n as f64;
    let variance = (0..n).map(|i| realization.at(at(i))[0].powi(2)).sum::<f64>() / n as f64;
    let found = 100.0 * variance.sqrt();
    assert!((found / 0.914 - 1.0).abs() < 0.01, "{found} cm");
    // The periodogram at the wavenumber of term 50 holds its amplitude.
    let wavenumber = TAU / 50.0 + 50.5 * step;
    let (mut cosine, mut sine) = (0.0, 0.0);
    for i in 0..n {
        let (s, c) = (wavenumber * at(i)).sin_cos();
        let value = realization.at(at(i))[0];
        cosine += value * c;
        sine += value * s;
    }
    let amplitude = 2.0 * cosine.hypot(sine) / n as f64;
    let density = amplitude * amplitude / (2.0 * step);
    let expected = Spectrum::FraVertical(4).density(wavenumber).unwrap();
    assert!((density / expected - 1.0).abs() < 0.05, "{density} {expected}");
}

/// The sum of all terms, each with its own sine and cosine, far along a track, where blocks of terms were
/// turned into each other many times; 403 terms fill no whole number of blocks.
#[test]
fn analytic_turned_blocks_are_the_sum_of_their_terms() {
    let (low, high, count) = (TAU / 91.44, TAU / 1.5, 403);
    let step = (high - low) / f64::from(count);
    let spectrum = Spectrum::FraLateral(4);
    let realization = Realization::new(spectrum, [1.5, 91.44], 403, 30.0, 9).unwrap();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(9);
    let terms: Vec<[f64; 3]> = (0..count)
        .map(|k| {
            let wavenumber = low + (f64::from(k) + 0.5) * step;
            let amplitude = (2.0 * spectrum.density(wavenumber).unwrap() * step).sqrt();
            let phase = TAU * ((random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64);
            [wavenumber, amplitude, phase]
        })
        .collect();
    for distance in [31.0, 123.4, 5_000.0] {
        let found = realization.at(distance);
        let expected = terms
            .iter()
            .fold([0.0; 3], |sum, [wavenumber, amplitude, phase]| {
                let (sine, cosine) = (wavenumber * distance + phase).sin_cos();
                [
                    sum[0] + amplitude * cosine,
                    sum[1] - amplitude * wavenumber * sine,
                    sum[2] - amplitude * wavenumber * wavenumber * cosine,
                ]
            });
        for (found, expected) in found.iter().zip(expected) {
            // Arguments of 2e4 rad have 4e-12 of rounding.
            assert!(
                (found - expected).abs() < 1e-12,
                "{distance} m: {found} {expected}"
            );
        }
    }
}

#[test]
fn limits_seeds_tapers_and_derivatives() {
    let (one, same, other) = (class_4(3), class_4(3), class_4(4));
    assert_eq!(one.at(123.4), same.at(123.4));
    assert!((one.at(123.4)[0] - other.at(123.4)[0]).abs() > 1e-6);
    assert_eq!(one.at(-1.0), [0.0; 3]);
    let h = 1e-5;
    for s in [1e-4, 3.0, 15.0, 29.9, 30.1, 500.0] {
        let (down, here, up) = (one.at(s - h), one.at(s), one.at(s + h));
        for order in 0..2 {
            let expected = (up[order] - down[order]) / (2.0 * h);
            assert!(
                (here[order + 1] - expected).abs() < 1e-7,
                "{s}: {} {expected}",
                here[order + 1]
            );
        }
    }
}

#[test]
fn input_what_cannot_be_realized() {
    let new = |spectrum, range, terms| {
        Realization::new(spectrum, range, terms, 30.0, 0)
            .unwrap_err()
            .to_string()
    };
    assert!(new(Spectrum::FraVertical(7), [3.0, 50.0], 10).contains("1 to 6"));
    assert!(new(Spectrum::FraLateral(0), [3.0, 50.0], 10).contains("class 0"));
    assert!(new(Spectrum::ErriVerticalLow, [50.0, 3.0], 10).contains("no range"));
    assert!(new(Spectrum::ErriVerticalHigh, [0.0, 3.0], 10).contains("positive"));
    assert!(new(Spectrum::FraCrossLevel(1), [3.0, 50.0], 0).contains("0 terms"));
}
