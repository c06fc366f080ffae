//! analytic, convergence, limits: rails in space, their sections, the foot of a point.

use numerics::scalar::{Dual, Real};
use wheelrail::track::spectrum::{Realization, Spectrum};
use wheelrail::track::{
    CenterLine, CurveElements, Direction, Irregularity, Line, Placed, RailLines, Rails, Segment, SpiralForm,
    Track, TrackSection,
};

const DISTANCE: f64 = 1.51;
const OFFSETS: [f64; 2] = [0.755, 0.756];

fn irregular() -> RailLines {
    let curve = CurveElements {
        curvature: 1.0 / 175.0,
        superelevation: 0.1,
    };
    let segments = [
        Segment::Tangent(50.0),
        Segment::Spiral(60.0, SpiralForm::Clothoid),
        Segment::Curve(400.0, curve),
    ];
    let center_line = CenterLine::new(&segments, DISTANCE, &[[20.0, 0.0], [60.0, 0.01]]).unwrap();
    let placed = |rails, direction, spectrum, seed| Placed {
        rails,
        direction,
        irregularity: Irregularity::Spectrum(
            Realization::new(spectrum, [1.5, 90.0], 200, 20.0, seed).unwrap(),
        ),
    };
    let irregularities = vec![
        placed(Rails::Both, Direction::Lateral, Spectrum::FraLateral(4), 1),
        placed(Rails::Against, Direction::Lateral, Spectrum::FraCrossLevel(4), 2),
        placed(Rails::Both, Direction::Vertical, Spectrum::FraVertical(4), 3),
    ];
    RailLines::new(
        Track {
            center_line,
            irregularities,
        },
        OFFSETS,
    )
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// Returns the point with these coordinates in a section.
fn point(section: &TrackSection<f64>, own: [f64; 3]) -> [f64; 3] {
    let arm = section.fixed(own);
    [0, 1, 2].map(|i| section.origin[i] + arm[i])
}

/// A point of a section has its foot there; axes are orthonormal; the tangent is the derivative of the place.
#[test]
fn analytic_points_of_a_section_have_their_foot_there() {
    let lines = irregular();
    for line in [Line::Left, Line::Right, Line::Center] {
        for k in 0..60 {
            let distance = -5.0 + 9.3 * f64::from(k);
            let section = lines.section_at(line, distance);
            for (i, a) in section.axes.iter().enumerate() {
                for (j, b) in section.axes.iter().enumerate() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    assert!((dot(*a, *b) - expected).abs() < 1e-14);
                }
            }
            let own = [0.0, 0.013, 0.457];
            let found = lines.section(line, point(&section, own));
            assert!(
                (found.distance - distance).abs() < 1e-9,
                "{line:?} {distance}: {}",
                found.distance
            );
            let h = 1e-4;
            let [low, high] = [-h, h].map(|h| lines.section_at(line, distance + h).origin);
            let leads = [0, 1, 2].map(|i| (high[i] - low[i]) / (2.0 * h));
            let size = dot(leads, leads).sqrt();
            for (leads, tangent) in leads.iter().zip(section.axes[0]) {
                assert!((leads / size - tangent).abs() < 1e-6, "{line:?} {distance}");
            }
        }
    }
}

/// Derivatives of a section by the point agree with differences.
#[test]
fn analytic_derivatives_of_a_section_by_the_point() {
    let lines = irregular();
    for (line, distance) in [
        (Line::Left, 30.0),
        (Line::Right, 83.3),
        (Line::Left, 250.0),
        (Line::Center, 100.2),
    ] {
        let place = point(&lines.section_at(line, distance), [0.0, 0.004, 0.457]);
        let section = lines.section(line, [0, 1, 2].map(|i| Dual::<3>::variable(place[i], i)));
        let h = 1e-5;
        for k in 0..3 {
            let [low, high] = [-h, h].map(|h| {
                let mut moved = place;
                moved[k] += h;
                lines.section(line, moved)
            });
            let close = |found: Dual<3>, low: f64, high: f64| {
                let expected = (high - low) / (2.0 * h);
                assert!(
                    (found.derivative[k] - expected).abs() < 1e-6,
                    "{line:?} {distance} {k}: {found:?} {expected}"
                );
            };
            close(section.distance, low.distance, high.distance);
            for i in 0..3 {
                close(section.origin[i], low.origin[i], high.origin[i]);
                for j in 0..3 {
                    close(section.axes[i][j], low.axes[i][j], high.axes[i][j]);
                }
            }
        }
    }
}

/// Between the points of the table irregularities are those of their definition.
#[test]
fn convergence_interpolated_irregularities_are_the_exact_ones() {
    let curve = CenterLine::new(&[Segment::Tangent(200.0)], DISTANCE, &[]).unwrap();
    let realization = Realization::new(Spectrum::FraLateral(1), [1.5, 90.0], 500, 20.0, 5).unwrap();
    let track = Track {
        center_line: curve,
        irregularities: vec![Placed {
            rails: Rails::Both,
            direction: Direction::Lateral,
            irregularity: Irregularity::Spectrum(realization.clone()),
        }],
    };
    let lines = RailLines::new(track, [0.0; 2]);
    for k in 0..500 {
        let distance = 0.397 * f64::from(k);
        let [value, slope, _] = realization.at(distance);
        let section = lines.section_at(Line::Left, distance);
        assert!((section.origin[1] - value).abs() < 1e-9);
        let found = section.axes[0][1] / section.axes[0][0];
        assert!((found - slope).abs() < 2e-8, "{distance}: {found} {slope}");
    }
}

/// Feet from the point alone: before the start, beyond the end, on a circle with the first lap, and far away.
#[test]
fn limits_feet_before_beyond_and_on_laps() {
    let straight = |length| {
        let center_line = CenterLine::new(&[Segment::Tangent(length)], DISTANCE, &[]).unwrap();
        RailLines::new(
            Track {
                center_line,
                irregularities: Vec::new(),
            },
            OFFSETS,
        )
    };
    let lines = straight(100.0);
    for x in [-300.0, -3.0, 0.0, 0.4, 99.9, 104.0, 5000.0] {
        let found = lines.section(Line::Left, [x, 0.76, 0.5]).distance;
        assert!((found - x).abs() < 1e-9, "{x}: {found}");
    }
    let radius = 175.0;
    let curve = CurveElements {
        curvature: 1.0 / radius,
        superelevation: 0.0,
    };
    let center_line = CenterLine::new(&[Segment::Curve(2500.0, curve)], DISTANCE, &[]).unwrap();
    let lines = RailLines::new(
        Track {
            center_line,
            irregularities: Vec::new(),
        },
        OFFSETS,
    );
    for k in 0..200 {
        let angle = 0.0314 * f64::from(k);
        let (sine, cosine) = libm::sincos(angle);
        let point = [(radius - 0.5) * sine, radius - (radius - 0.5) * cosine, 0.5];
        let found = lines.section(Line::Center, point).distance;
        assert!((found - radius * angle).abs() < 1e-8, "{angle}: {found}");
    }
    // Nonsense gives numbers, or none, but ends.
    for point in [[f64::NAN, 0.0, 0.0], [1e300, 0.0, 0.0], [0.0, 175.0, 0.0]] {
        let found = lines.section(Line::Center, point);
        assert!(found.distance.value().is_nan() || found.axes[0][0].abs() <= 1.0 + 1e-9);
    }
}
