//! Spirals by their names: offsets in closed form, an independent quadrature, ends, and what cannot be.

use std::f64::consts::PI;

use wheelrail::track::{CenterLine, CurveElements, Segment, SpiralForm, TrackError};

const LENGTH: f64 = 100.0;
const RADIUS: f64 = 1000.0;
type Law = fn(f64) -> f64;
const LAWS: [(SpiralForm, Law); 5] = [
    (SpiralForm::Clothoid, |u| u),
    (SpiralForm::Bloss, |u| u * u * (3.0 - 2.0 * u)),
    (SpiralForm::Sine, |u| u - (2.0 * PI * u).sin() / (2.0 * PI)),
    (SpiralForm::Cosine, |u| 0.5 * (1.0 - (PI * u).cos())),
    (SpiralForm::Helmert, |u| match u < 0.5 {
        true => 2.0 * u * u,
        false => 1.0 - 2.0 * (1.0 - u) * (1.0 - u),
    }),
];

fn left(radius: f64, superelevation: f64) -> CurveElements {
    CurveElements {
        curvature: 1.0 / radius,
        superelevation,
    }
}

/// A tangent of 30 m, the spiral, a curve of 50 m.
fn track(form: SpiralForm, length: f64, radius: f64) -> Result<CenterLine, TrackError> {
    let segments = [
        Segment::Tangent(30.0),
        Segment::Spiral(length, form),
        Segment::Curve(50.0, left(radius, 0.1)),
    ];
    CenterLine::new(&segments, 1.5, &[])
}

/// Offsets at the end of 100 m into 1000 m: L²/R times the integral of (1 - u) f(u), to 0.2 %.
#[test]
fn analytic_offsets_of_spirals_in_closed_form() {
    for (form, share, rounded) in [
        (SpiralForm::Clothoid, 1.0 / 6.0, 1.6667),
        (SpiralForm::Bloss, 0.15, 1.5),
        (SpiralForm::Cosine, 0.25 - 1.0 / (PI * PI), 1.4868),
        (SpiralForm::Sine, 1.0 / 6.0 - 0.25 / (PI * PI), 1.4134),
        (SpiralForm::Helmert, 7.0 / 48.0, 1.4583),
        // The first two terms of its series in L/R.
        (
            SpiralForm::CubicParabola,
            (1.0 + 13.0 / 40.0 * 0.01) / 6.0,
            1.6721,
        ),
    ] {
        let expected = share * LENGTH * LENGTH / RADIUS;
        assert!((expected - rounded).abs() < 1e-4, "{form:?}");
        let offset = track(form, LENGTH, RADIUS).unwrap().at(30.0 + LENGTH).position[1];
        assert!(
            (offset / expected - 1.0).abs() < 2e-3,
            "{form:?}: {offset} {expected}"
        );
    }
}

/// Curvature, superelevation, heading and place along the whole spiral against Simpson's rule over the laws,
/// large angles included (100 m into 150 m), also from a curve to a reverse curve.
#[test]
fn analytic_spirals_against_a_quadrature() {
    for (form, law) in LAWS {
        for [from, to] in [
            [0.0, 1.0 / RADIUS],
            [0.0, 1.0 / 150.0],
            [1.0 / 400.0, -1.0 / 250.0],
        ] {
            let curve = |curvature, superelevation| CurveElements {
                curvature,
                superelevation,
            };
            let segments = [
                Segment::Curve(10.0, curve(from, -0.02)),
                Segment::Spiral(LENGTH, form),
                Segment::Curve(50.0, curve(to, 0.1)),
            ];
            let line = CenterLine::new(&segments, 1.5, &[]).unwrap();
            let begin = line.at(10.0);
            let steps = 4000;
            let step = LENGTH / f64::from(steps);
            let curvature = |s: f64| from + (to - from) * law(s / LENGTH);
            let simpson =
                |f: &dyn Fn(f64) -> f64, s: f64| step / 6.0 * (f(s) + 4.0 * f(s + 0.5 * step) + f(s + step));
            let (mut heading, mut place) = (begin.heading, [begin.position[0], begin.position[1]]);
            for k in 0..steps {
                let s = f64::from(k) * step;
                // Heading within the step by Simpson's rule over its halves.
                let half = |s: f64| {
                    0.5 * step / 6.0
                        * (curvature(s) + 4.0 * curvature(s + 0.25 * step) + curvature(s + 0.5 * step))
                };
                let middle = heading + half(s);
                let end = heading + simpson(&curvature, s);
                for (own, f) in place.iter_mut().zip([f64::cos, f64::sin]) {
                    *own += step / 6.0 * (f(heading) + 4.0 * f(middle) + f(end));
                }
                heading = end;
                if k % 371 == 0 || k + 1 == steps {
                    let found = line.at(10.0 + s + step);
                    let share = law((s + step) / LENGTH);
                    let pairs = [
                        (found.curvature[0], curvature(s + step), 1e-14),
                        (found.superelevation[0], -0.02 + 0.12 * share, 1e-13),
                        (found.heading, heading, 1e-11),
                        (found.position[0], place[0], 1e-9),
                        (found.position[1], place[1], 1e-9),
                    ];
                    for (found, expected, tolerance) in pairs {
                        assert!(
                            (found - expected).abs() < tolerance,
                            "{form:?} {s}: {found} {expected}"
                        );
                    }
                }
            }
        }
    }
}

/// Rates are the derivatives of their values, and zero at both ends of all but the clothoid and the parabola.
#[test]
fn analytic_rates_of_spirals() {
    for (form, _) in LAWS {
        let line = track(form, LENGTH, RADIUS).unwrap();
        for s in [31.0, 47.0, 79.0, 81.0, 128.0] {
            let h = 1e-4;
            let [before, own, after] = [s - h, s, s + h].map(|s| line.at(s));
            let pairs = [
                (after.curvature[0] - before.curvature[0], own.curvature[1], 1e-5),
                (
                    after.superelevation[0] - before.superelevation[0],
                    own.superelevation[1],
                    1e-3,
                ),
            ];
            for (difference, rate, scale) in pairs {
                assert!(
                    (difference / (2.0 * h) - rate).abs() < 1e-5 * scale,
                    "{form:?} {s}"
                );
            }
        }
        if form != SpiralForm::Clothoid {
            for s in [30.0, 130.0 - 1e-9] {
                assert!(line.at(s).curvature[1].abs() < 1e-13, "{form:?} {s}");
            }
        }
    }
}

/// All places of a cubic parabola have y = c x³ over the tangent, its arc is as long as stated, its curvature
/// is that of the curve at the end; it is not a clothoid.
#[test]
fn analytic_a_cubic_parabola_is_one() {
    for (length, radius) in [(LENGTH, RADIUS), (100.0, 300.0), (130.0, 200.0)] {
        let line = track(SpiralForm::CubicParabola, length, radius).unwrap();
        let end = line.at(30.0 + length);
        let c = end.position[1] / (end.position[0] - 30.0).powi(3);
        let mut arc = 0.0;
        let mut before = [30.0, 0.0];
        for k in 1..=20_000 {
            let [x, y, _] = line.at(30.0 + length * f64::from(k) / 20_000.0).position;
            assert!((y - c * (x - 30.0).powi(3)).abs() < 1e-8, "{radius} {k}: {y}");
            arc += (x - before[0]).hypot(y - before[1]);
            before = [x, y];
        }
        assert!((arc / length - 1.0).abs() < 1e-8);
        assert!((end.curvature[0] * radius - 1.0).abs() < 1e-9);
        let x = end.position[0] - 30.0;
        let exact = 6.0 * c * x / (1.0 + 9.0 * c * c * x.powi(4)).powf(1.5);
        assert!((exact * radius - 1.0).abs() < 1e-7, "{exact}");
        assert!((end.heading - (3.0 * c * x * x).atan()).abs() < 1e-9);
        // Backward, from the curve to the tangent: the same from the other side.
        let segments = [
            Segment::Curve(50.0, left(radius, 0.1)),
            Segment::Spiral(length, SpiralForm::CubicParabola),
            Segment::Tangent(30.0),
        ];
        let back = CenterLine::new(&segments, 1.5, &[]).unwrap();
        for s in [0.1, 0.37, 0.9].map(|share| share * length) {
            let (there, here) = (back.at(50.0 + s), line.at(30.0 + length - s));
            assert!((there.curvature[0] - here.curvature[0]).abs() < 1e-12);
            assert!((there.curvature[1] + here.curvature[1]).abs() < 1e-12);
            assert!((there.superelevation[0] - here.superelevation[0]).abs() < 1e-12);
        }
    }
    // What the page of spirals says of the difference to a clothoid, in parts of the curve's curvature.
    for (share, largest) in [(0.1, 0.006), (1.0 / 3.0, 0.06)] {
        let [parabola, clothoid] = [SpiralForm::CubicParabola, SpiralForm::Clothoid]
            .map(|form| track(form, share * RADIUS, RADIUS).unwrap());
        let difference = (1..1000).map(|k| {
            let s = 30.0 + share * f64::from(k);
            (parabola.at(s).curvature[0] - clothoid.at(s).curvature[0]).abs() * RADIUS
        });
        let most = difference.fold(0.0, f64::max);
        assert!(most < largest && most > 0.1 * largest, "{share}: {most}");
    }
}

#[test]
fn input_cubic_parabolas_that_cannot_be_are_refused() {
    let error = track(SpiralForm::CubicParabola, 100.0, 140.0)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("segment 2") && error.contains("at most 97."),
        "{error}"
    );
    assert!(track(SpiralForm::CubicParabola, 97.0, 140.0).is_ok());
    let segments = [
        Segment::Curve(50.0, left(500.0, 0.1)),
        Segment::Spiral(50.0, SpiralForm::CubicParabola),
        Segment::Curve(50.0, left(300.0, 0.1)),
    ];
    let error = CenterLine::new(&segments, 1.5, &[]).unwrap_err().to_string();
    assert!(error.contains("tangent on one side"), "{error}");
}
