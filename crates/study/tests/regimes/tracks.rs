//! The tracks: amplitudes beside the table that is remembered, and that cars pass the whole test zone.

use study::car::regime::Regime;
use wheelrail::track::shape::Shape;
use wheelrail::track::{Irregularity, RailLines};

use super::case;

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

/// Returns the irregularities of a regime's track foot by foot, in: of the left and the right rail, to the
/// left and up.
fn foot_by_foot(regime: &str) -> Vec<[[f64; 2]; 2]> {
    let own = case(
        regime,
        "loaded",
        Regime::named(regime).unwrap().speeds[0].text(),
        &[],
    );
    let track = own.parameters.track;
    let feet = (track.center_line.length() / FOOT) as usize;
    let rails = RailLines::new(track, [0.75, 0.75]);
    (0..=4 * feet)
        .map(|place| rails.irregularities(0.25 * place as f64 * FOOT))
        .map(|both| both.map(|rail| rail.map(|own| own / INCH)))
        .collect()
}

/// Returns the greatest value less the least.
fn peak_to_peak(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), own| {
        (low.min(own), high.max(own))
    });
    high - low
}

/// The amplitudes that are remembered: 0.75 in of cross level in twist and roll and of both rails in pitch
/// and bounce, 1.25 in of alignment in yaw and sway with parallel rails, 0.5 in of cross level and 1 in of
/// gauge, outward at the outer rail alone, in dynamic curving. The tips of cusps are rounded within 1 ft to
/// each side, which takes π/78 of their depth.
#[test]
fn analytic_amplitudes_are_those_remembered() {
    let rounded = 1.0 - std::f64::consts::PI / 78.0;
    let near = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 0.01, "{found} {wanted}");
    let twist = foot_by_foot("twist_and_roll");
    let cross_level = || twist.iter().map(|[left, right]| left[1] - right[1]);
    // A joint of one rail stands at the middle of the other's length of rail.
    near(cross_level().fold(0.0, f64::max), 0.75 * rounded);
    near(peak_to_peak(cross_level()), 1.5 * rounded);
    let bounce = foot_by_foot("pitch_and_bounce");
    near(
        peak_to_peak(bounce.iter().map(|[left, _]| left[1])),
        0.75 * rounded,
    );
    assert!(
        bounce
            .iter()
            .all(|[left, right]| (left[1] - right[1]).abs() < 1e-12)
    );
    let sway = foot_by_foot("yaw_and_sway");
    near(peak_to_peak(sway.iter().map(|[left, _]| left[0])), 1.25);
    assert!(
        sway.iter()
            .all(|[left, right]| (left[0] - right[0]).abs() < 1e-12 && left[1] == 0.0)
    );
    let waves = sway.windows(2).filter(|two| {
        let middle = -0.625;
        two[0][0][0] > middle && two[1][0][0] <= middle
    });
    assert_eq!(waves.count(), 5);
    let wide = case("yaw_and_sway", "loaded", "50 mph", &[]);
    assert!(wide.to_toml().contains("gauge = \"57.5 in\""));
    let curving = foot_by_foot("dynamic_curving");
    near(
        curving
            .iter()
            .map(|[left, right]| (left[1] - right[1]).abs())
            .fold(0.0, f64::max),
        0.5 * rounded,
    );
    near(
        curving
            .iter()
            .map(|[left, right]| left[0] - right[0])
            .fold(0.0, f64::max),
        rounded,
    );
    for [left, right] in &curving {
        assert!(left[0] == 0.0 && right[0] <= 1e-5, "{left:?} {right:?}");
        // Where the outer rail stands outward, it is low too.
        assert!((right[1] - 0.5 * right[0]).abs() < 1e-5);
    }
}

/// Flat-topped bumps and dips: height, length of ramp and level, by points of `h (1 - cos)/2`, on the rails
/// that are meant; the right rail is the outer one.
#[test]
fn analytic_bumps_and_dips_are_flat_topped() {
    let zones: [(&str, [f64; 2], [f64; 2], f64); 3] = [
        ("single_bump", [1.0, 1.0], [7.0, 20.0], 180.0),
        ("curve_with_bump", [0.0, 2.0], [6.0, 12.0], 240.0),
        ("curve_with_dip", [-2.0, 0.0], [6.0, 12.0], 240.0),
    ];
    for (name, sizes, [ramp, level], start) in zones {
        let rails = foot_by_foot(name);
        let whole = 2.0 * ramp + level;
        for (share_of_height, place) in [
            (0.0, 0.0),
            (0.5, 0.5 * ramp),
            (0.25, ramp / 3.0),
            (1.0, ramp),
            (1.0, ramp + 0.5 * level),
            (1.0, ramp + level),
            (0.5, whole - 0.5 * ramp),
            (0.0, whole),
        ] {
            let own = rails[(4.0 * (start + place)).round() as usize];
            // Rails are splines through samples; a third of a ramp of 7 ft is no whole quarter of a foot.
            let near = if (4.0 * place).fract() == 0.0 { 5e-4 } else { 0.05 };
            for (rail, size) in own.iter().zip(sizes) {
                assert_eq!(rail[0], 0.0);
                assert!(
                    (rail[1] - size * share_of_height).abs() < near,
                    "{name} {place}: {own:?}"
                );
            }
        }
        let beyond = rails.iter().skip((4.0 * (start + whole)) as usize + 1);
        assert!(beyond.flatten().all(|rail| rail[1].abs() < 5e-4), "{name}");
    }
}

/// Ranges and speeds of curves are 3 in of cant about balance, by E = 0.0007 D V² (in, deg, mph), the formula
/// of 49 CFR 213.57.
#[test]
fn analytic_curves_are_run_to_three_inches_of_cant() {
    for (name, degree, cant, excess) in [
        ("constant_curve", 7.5, 4.0, 3.0),
        ("constant_curve_10", 10.0, 4.0, 3.0),
        ("constant_curve_12", 12.0, 5.0, 3.0),
        ("dynamic_curving", 10.0, 4.0, 3.0),
        ("spiral", 7.5, 4.5, 4.5),
        ("bunched_spiral", 7.5, 4.5, 4.5),
        ("lean", 4.0, 3.0, 3.0),
    ] {
        let regime = Regime::named(name).unwrap();
        let [least, greatest] = regime.range.each_ref().map(|own| own.to_si() / 0.447_04);
        let deficiency = |speed: f64| 0.0007 * degree * speed * speed - cant;
        assert!(
            deficiency(greatest) < 3.05 && deficiency(greatest) > 2.8,
            "{name}"
        );
        assert!(
            deficiency(least) >= -excess - 0.05,
            "{name}: {}",
            deficiency(least)
        );
        // The default speeds reach both sides of balance, and within half an inch of the range's upper end.
        let [first, last] = [0, 5].map(|at| regime.speeds[at].to_si() / 0.447_04);
        assert!(deficiency(first) < -2.0 && deficiency(last) > 2.5, "{name}");
        let line = &case(name, "loaded", regime.speeds[0].text(), &[])
            .parameters
            .track
            .center_line;
        let feet = 0..(line.length() / FOOT) as usize;
        let tightest = feet
            .map(|foot| line.at(foot as f64 * FOOT))
            .fold([0.0_f64; 2], |most, own| {
                [most[0].max(own.curvature[0]), most[1].max(own.superelevation[0])]
            });
        // The degree is the angle of a chord of 100 ft.
        let chord = 2.0 / tightest[0] * (0.5 * f64::to_radians(degree)).sin();
        assert!((chord / (100.0 * FOOT) - 1.0).abs() < 1e-6, "{name}: {chord}");
        assert!((tightest[1] / (cant * INCH) - 1.0).abs() < 1e-6, "{name}");
    }
}

/// The bunched spiral: the curvature rises evenly over 200 ft, the superelevation within its middle 100 ft.
#[test]
fn analytic_the_bunched_spiral_is_bunched() {
    let line = case("bunched_spiral", "loaded", "20 mph", &[])
        .parameters
        .track
        .center_line;
    let curvature = |foot: f64| line.at(foot * FOOT).curvature[0];
    let height = |foot: f64| line.at(foot * FOOT).superelevation[0] / INCH;
    let full = curvature(600.0);
    for share in [0.1, 0.25, 0.4, 0.5, 0.75, 0.9] {
        let own = curvature(300.0 + 200.2 * share) / full;
        assert!((own - share).abs() < 0.002, "{share}: {own}");
    }
    for (foot, wanted) in [
        (345.0, 0.0),
        (375.1, 1.125),
        (400.1, 2.25),
        (425.1, 3.375),
        (455.0, 4.5),
    ] {
        assert!((height(foot) - wanted).abs() < 0.01, "{foot}: {}", height(foot));
    }
}

/// Where a steady state is looked at, the rear axle has been in the full curve for 60 ft before statistics
/// begin, and the car is in it until the end.
#[test]
fn analytic_steady_curves_are_entered_before_statistics() {
    for name in ["lean", "static_curve"] {
        for speed in &Regime::named(name).unwrap().range {
            let own = case(name, "loaded", speed.text(), &[]);
            let (start, reach) = (own.parameters.start.distance, own.parameters.reach());
            let line = &own.parameters.track.center_line;
            let rear = start - reach + own.speed() * own.parameters.start.settle - 60.0 * FOOT;
            let front = start + reach + own.speed() * own.simulation.duration;
            let full = |place: f64| line.at(place).curvature;
            assert_eq!(full(rear), full(front), "{name} {speed}");
            assert!(
                full(rear)[0] > 0.0 && full(rear)[1] == 0.0 && front < line.length(),
                "{name}"
            );
        }
    }
}

/// Statistics begin before the front axle enters the test zone, and the run ends when the rear axle has left
/// it, at every speed: zones end with the last shape.
#[test]
fn analytic_test_zones_are_passed_whole() {
    for name in [
        "twist_and_roll",
        "pitch_and_bounce",
        "yaw_and_sway",
        "dynamic_curving",
        "single_bump",
        "curve_with_bump",
        "curve_with_dip",
    ] {
        for speed in &Regime::named(name).unwrap().range {
            let own = case(name, "loaded", speed.text(), &[]);
            let (mut begin, mut end) = (f64::INFINITY, 0.0_f64);
            for placed in &own.parameters.track.irregularities {
                let [from, to] = match &placed.irregularity {
                    Irregularity::Shape(Shape::Joints {
                        spacing,
                        joints,
                        start,
                        ..
                    }) => [start - 0.5 * spacing, start + (*joints as f64 - 0.5) * spacing],
                    Irregularity::Shape(
                        Shape::Dip { start, length, .. } | Shape::Jog { start, length, .. },
                    ) => [*start, start + length],
                    other => panic!("{other:?}"),
                };
                (begin, end) = (begin.min(from), end.max(to));
            }
            let (start, reach) = (own.parameters.start.distance, own.parameters.reach());
            let front = start + reach + own.speed() * own.parameters.start.settle;
            let rear = start - reach + own.speed() * own.simulation.duration;
            assert!(
                front <= begin && front > begin - 20.0 * FOOT,
                "{name} {front} {begin}"
            );
            assert!(rear > end + 25.0 * FOOT, "{name} {rear} {end}");
        }
    }
}
