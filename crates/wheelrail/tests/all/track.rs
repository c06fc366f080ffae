//! Track: closed forms of arcs and clothoids, continuity, projection, mid-chord offsets, what is refused.

use std::f64::consts::PI;

use wheelrail::track::chord::{CHORDS, offset, transfer};
use wheelrail::track::{CenterLine, CurveElements, Segment, SpiralForm, TrackError};

const RAILS: f64 = 59.5 * 0.0254;

fn curve(radius: f64, superelevation: f64) -> CurveElements {
    CurveElements {
        curvature: 1.0 / radius,
        superelevation,
    }
}

fn line() -> CenterLine {
    let left = curve(250.0, 0.1);
    let right = curve(-400.0, -0.05);
    CenterLine::new(
        &[
            Segment::Tangent(50.0),
            Segment::Spiral(60.0, SpiralForm::Clothoid),
            Segment::Curve(150.0, left),
            Segment::Spiral(90.0, SpiralForm::Clothoid),
            Segment::Curve(100.0, right),
            Segment::Spiral(40.0, SpiralForm::Clothoid),
            Segment::Tangent(30.0),
        ],
        RAILS,
        &[[100.0, 0.0], [200.0, 0.01], [400.0, 0.01]],
    )
    .unwrap()
}

/// Degrees of curve and their radii in feet (100 ft chord).
#[test]
fn analytic_degrees_of_curve() {
    for (degree, radius) in [(7.5, 764.5), (10.0, 573.7), (12.0, 478.3)] {
        let found = 1.0 / CurveElements::of_degree(f64::to_radians(degree), 0.0).curvature / 0.3048;
        assert!((found - radius).abs() < 0.05, "{degree}°: {found} ft");
    }
}

#[test]
fn analytic_a_full_circle_closes() {
    let radius = 300.0;
    let length = 2.0 * PI * radius;
    let circle = CenterLine::new(&[Segment::Curve(length, curve(radius, 0.0))], RAILS, &[]).unwrap();
    let end = circle.at(length);
    assert!(
        end.position[0].abs() < 1e-9 && end.position[1].abs() < 1e-9,
        "{:?}",
        end.position
    );
    assert!((end.heading - 2.0 * PI).abs() < 1e-12);
    let quarter = circle.at(0.25 * length).position;
    assert!((quarter[0] - radius).abs() < 1e-9 && (quarter[1] - radius).abs() < 1e-9);
}

/// A clothoid from a tangent against the series of Fresnel's integrals.
#[test]
fn analytic_a_spiral_is_a_clothoid() {
    let (length, radius) = (120.0, 150.0);
    let segments = [
        Segment::Tangent(10.0),
        Segment::Spiral(length, SpiralForm::Clothoid),
        Segment::Curve(10.0, curve(radius, 0.1)),
    ];
    let track = CenterLine::new(&segments, RAILS, &[]).unwrap();
    for t in [10.0, 60.0, 120.0] {
        // x + i y = ∫ exp(i s²/(2 R L)) ds
        let angle: f64 = t * t / (2.0 * radius * length);
        let (mut x, mut y, mut term) = (0.0, 0.0, t);
        for n in 0..30 {
            let part = term / (2.0 * f64::from(n) + 1.0);
            match n % 4 {
                0 => x += part,
                1 => y += part,
                2 => x -= part,
                _ => y -= part,
            }
            term *= angle / f64::from(n + 1);
        }
        let found = track.at(10.0 + t);
        assert!((found.position[0] - 10.0 - x).abs() < 1e-10 && (found.position[1] - y).abs() < 1e-10);
        assert!((found.heading - angle).abs() < 1e-14);
        assert!((found.superelevation[0] - 0.1 * t / length).abs() < 1e-14);
    }
    let roll = track.at(135.0).roll;
    assert!((roll + (0.1 / RAILS).asin()).abs() < 1e-14);
}

/// Position, heading and curvature are continuous, the derivatives are those of differences.
#[test]
fn limits_what_a_train_meets_is_continuous() {
    let track = line();
    let h = 1e-6;
    for i in -10..540 {
        let s = f64::from(i) + 0.000_001_3;
        let (down, here, up) = (track.at(s - h), track.at(s), track.at(s + h));
        let rate = |k: usize| (up.position[k] - down.position[k]) / (2.0 * h);
        assert!((rate(0) - here.heading.cos()).abs() < 1e-7, "{s}");
        assert!((rate(1) - here.heading.sin()).abs() < 1e-7, "{s}");
        assert!((rate(2) - here.grade).abs() < 1e-7, "{s}");
        assert!(
            ((up.heading - down.heading) / (2.0 * h) - here.curvature[0]).abs() < 1e-8,
            "{s}"
        );
        assert!((up.curvature[0] - down.curvature[0]).abs() < 1e-8, "{s}");
        assert!(
            (up.superelevation[0] - down.superelevation[0]).abs() < 1e-7,
            "{s}"
        );
    }
    assert!((track.at(600.0).position[2] - track.at(500.0).position[2] - 1.0).abs() < 1e-12);
}

/// A point beside the track has the distance at which it stands beside it.
#[test]
fn analytic_projection() {
    let track = line();
    for s in [-5.0, 20.0, 80.0, 200.0, 300.0, 400.0, 515.0, 530.0] {
        let station = track.at(s);
        for across in [-40.0, 0.0, 0.75, 60.0] {
            let [x, y, _] = station.position;
            let (sine, cosine) = station.heading.sin_cos();
            let point = [x - across * sine, y + across * cosine];
            let found = track.project(point, s + 3.0);
            assert!((found - s).abs() < 1e-9, "{s}, {across}: {found}");
        }
    }
}

/// An offset of a sine is the sine times 1 - cos(πL/λ): 0.72 of 39 ft with a chord of 62 ft.
#[test]
fn analytic_mid_chord_offsets_of_sines() {
    for chord in CHORDS {
        for wavelength in [8.0, 11.8872, 25.0, 60.0] {
            let sine = |s: f64| 0.01 * (2.0 * PI * s / wavelength).sin();
            for s in [0.0, 1.7, 33.0] {
                let expected = transfer(wavelength, chord) * sine(s);
                assert!((offset(sine, s, chord) - expected).abs() < 1e-15);
            }
        }
    }
    assert!((transfer(39.0, 62.0) - 0.72).abs() < 0.005);
    assert!((transfer(62.0, 62.0) - 2.0).abs() < 1e-15);
}

#[test]
fn input_tracks_that_cannot_be_are_refused_with_the_segment() {
    let new = |segments: &[Segment]| CenterLine::new(segments, RAILS, &[]).unwrap_err();
    assert_eq!(new(&[]), TrackError::Empty);
    for (segments, word) in [
        (vec![Segment::Tangent(-1.0)], "segment 1"),
        (vec![Segment::Tangent(f64::NAN)], "positive"),
        (
            vec![Segment::Tangent(10.0), Segment::Curve(10.0, curve(300.0, 0.0))],
            "put a spiral between",
        ),
        (
            vec![
                Segment::Spiral(10.0, SpiralForm::Clothoid),
                Segment::Tangent(10.0),
            ],
            "at the start",
        ),
        (
            vec![
                Segment::Tangent(10.0),
                Segment::Spiral(10.0, SpiralForm::Clothoid),
            ],
            "before the end",
        ),
        (vec![Segment::Curve(10.0, curve(300.0, 2.0))], "rails are"),
    ] {
        let message = new(&segments).to_string();
        assert!(message.contains(word), "{message}");
    }
    let grades = CenterLine::new(&[Segment::Tangent(9.0)], RAILS, &[[5.0, 0.0], [5.0, 0.1]]);
    assert!(grades.unwrap_err().to_string().contains("grade 2"));
}
