//! Statistics of made-up runs with known answers.

use std::collections::BTreeMap;
use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

use ::car::ClimbLimits;
use quantity::System;
use study::car::CarCase;
use study::car::columns::parts_of;
use study::car::figures::CarFigures;
use study::car::limits::{self, LimitSet};
use study::car::statistics::{Histories, Parts, Rules, Statistics};
use study::car::worst::Worst;
use study::case::Tables;
use study::signal::{BandPass, LowPass};

const FOOT: f64 = 0.3048;
const GRAVITY: f64 = 9.806_65;
const INTERVAL: f64 = 0.005;

/// Wheels of AAR-1B, whose flanges have 75°, on rails with a friction of 0.5 on the left and 0.3 on the
/// right.
static CLIMB: LazyLock<ClimbLimits> = LazyLock::new(|| ClimbLimits::of(&car(0.5, 0.3).parameters).unwrap());

/// The parts of a car whose wheels carry 100 kN each, axles beside its middle.
static PARTS: LazyLock<Parts> = LazyLock::new(|| {
    let mut parts = parts_of(&car(0.5, 0.3).parameters, [[100e3; 2]; 4]);
    for axle in &mut parts.axles {
        axle.place = 0.0;
    }
    parts
});

fn car(left: f64, right: f64) -> CarCase {
    let text = format!(
        "model = \"car\"\n[wheels]\nfriction = {left}\n[friction.right]\ntread = {right}\n\
                        gauge_face = {right}\n"
    );
    CarCase::parse("made_up.toml", &text, Tables::nowhere(), &[]).unwrap()
}

/// Returns a run of 40 s at 30 m/s: every wheel carries 100 kN, nothing else happens.
fn quiet() -> BTreeMap<String, Vec<f64>> {
    let rows = 8001;
    let mut columns = BTreeMap::new();
    let time: Vec<f64> = (0..rows).map(|row: u32| f64::from(row) * INTERVAL).collect();
    columns.insert(
        "distance".to_owned(),
        time.iter().map(|t| 10.0 + 30.0 * t).collect(),
    );
    for axle in 1..=4 {
        for side in ["left", "right"] {
            columns.insert(format!("axle_{axle}_{side}_vertical"), vec![100e3; rows as usize]);
            columns.insert(format!("axle_{axle}_{side}_lateral"), vec![0.0; rows as usize]);
        }
    }
    columns.insert("body_roll".to_owned(), vec![0.0; rows as usize]);
    for axle in 1..=4 {
        columns.insert(format!("axle_{axle}_yaw"), vec![0.0; rows as usize]);
        for side in ["left", "right"] {
            columns.insert(format!("axle_{axle}_{side}_lift"), vec![0.0; rows as usize]);
        }
    }
    for truck in 1..=2 {
        for part in ["bolster", "left_side_frame", "right_side_frame"] {
            let name = format!("truck_{truck}_{part}_lateral_acceleration");
            columns.insert(name, vec![0.0; rows as usize]);
        }
    }
    for end in 1..=2 {
        for direction in ["lateral", "vertical"] {
            let name = format!("body_at_truck_{end}_{direction}_acceleration");
            columns.insert(name, vec![0.0; rows as usize]);
        }
    }
    columns.insert("time".to_owned(), time);
    columns
}

fn statistics(columns: &BTreeMap<String, Vec<f64>>, rules: &Rules) -> Statistics {
    let histories = Histories {
        column: &|name| columns.get(name).map_or(&[][..], Vec::as_slice),
        rows: columns["time"].len(),
        interval: INTERVAL,
        begin: 2.0,
        parts: &PARTS,
        climb: Some(&*CLIMB),
        in_curve: &|distance| distance > 500.0,
    };
    Statistics::of(&histories, rules, System::Us)
}

fn set(columns: &mut BTreeMap<String, Vec<f64>>, name: &str, value: impl Fn(f64) -> f64) {
    let time = columns["time"].clone();
    columns.insert(name.to_owned(), time.iter().map(|t| value(*t)).collect());
}

fn value(statistics: &Statistics, name: &str) -> [f64; 2] {
    let own = &statistics.values[name];
    [&own.raw, &own.filtered].map(|own| own.as_ref().map_or(f64::NAN, |own| own.value))
}

/// A lateral force that lasts for a time: wheel, axle sum and truck side have their own lengths; what happens
/// while the car settles does not count.
#[test]
fn analytic_ratios_that_last() {
    let mut columns = quiet();
    // 60 kN for 0.2 s, 6 m: longer than all; before settling 90 kN.
    let pulse = |t: f64| if (20.0..20.2).contains(&t) { 60e3 } else { 0.0 };
    set(&mut columns, "axle_1_left_lateral", |t| {
        if t < 1.5 { 90e3 } else { pulse(t) }
    });
    set(&mut columns, "axle_1_right_lateral", |t| -0.5 * pulse(t));
    let statistics = statistics(&columns, &Rules::default());
    let [raw, filtered] = value(&statistics, "axle_1_left_l_over_v_time");
    assert!((raw - 0.6).abs() < 1e-9, "{raw}");
    // In the middle of the pulse the filter has settled to within its overshoot.
    assert!((filtered - 0.6).abs() < 0.03, "{filtered}");
    assert!((value(&statistics, "axle_1_left_l_over_v_distance")[0] - 0.6).abs() < 1e-9);
    // The right wheel is pressed outwards nowhere; the sum takes sizes.
    assert!(value(&statistics, "axle_1_right_l_over_v_time")[0].abs() < 1e-9);
    assert!((value(&statistics, "axle_1_sum_l_over_v_time")[0] - 0.9).abs() < 1e-9);
    // Of the left side of the front truck one of two wheels is pressed.
    assert!((value(&statistics, "truck_1_left_side_l_over_v")[0] - 0.3).abs() < 1e-9);
    assert!(value(&statistics, "truck_2_left_side_l_over_v")[0].abs() < 1e-9);
    let time = statistics.values["axle_1_left_l_over_v_time"].time.unwrap();
    assert!((19.9..20.2).contains(&time), "{time}");
}

/// A force of 0.03 s lasts over no 0.05 s, but over 0.9 m.
#[test]
fn limits_short_peaks_do_not_last() {
    let mut columns = quiet();
    set(&mut columns, "axle_2_left_lateral", |t| {
        if (20.0..20.036).contains(&t) { 60e3 } else { 0.0 }
    });
    let statistics = statistics(&columns, &Rules::default());
    assert!(value(&statistics, "axle_2_left_l_over_v_time")[0].abs() < 1e-9);
    assert!((value(&statistics, "axle_2_left_l_over_v_distance")[0] - 0.6).abs() < 1e-9);
}

/// A load that swings by a sine: its least share, and the least that lasts, `1 - a cos(π τ f)`.
#[test]
fn analytic_least_wheel_load_of_a_sine() {
    let mut columns = quiet();
    let frequency = 2.0;
    set(&mut columns, "axle_3_right_vertical", |t| {
        100e3 * (1.0 - 0.8 * (2.0 * PI * frequency * t).sin())
    });
    let statistics = statistics(&columns, &Rules::default());
    let [raw, filtered] = value(&statistics, "axle_3_right_least_load");
    assert!((raw - 20.0).abs() < 0.01, "{raw}");
    let gain = study::signal::LowPass::new(INTERVAL, 15.0)
        .unwrap()
        .gain(frequency);
    assert!((filtered - (100.0 - 80.0 * gain)).abs() < 0.01);
    let [raw, _] = value(&statistics, "axle_3_right_least_load_time");
    assert!(
        (raw - (100.0 - 80.0 * (PI * 0.05 * frequency).cos())).abs() < 0.01,
        "{raw}"
    );
    assert_eq!(
        statistics.values["axle_3_right_least_load"]
            .raw
            .as_ref()
            .unwrap()
            .unit,
        "%"
    );
}

/// Percentile in curves: a ramp of L/V over the curve's rows; wheels without load have no ratio.
#[test]
fn analytic_percentile_in_curves() {
    let mut columns = quiet();
    // In the curve from 500 m on: from (500 - 10)/30 s to 40 s, a ramp from 0 to 1.
    let begin = 490.0 / 30.0;
    set(&mut columns, "axle_1_left_lateral", |t| {
        100e3 * ((t - begin) / (40.0 - begin)).max(0.0)
    });
    set(&mut columns, "axle_4_left_lateral", |_| 100e3);
    set(&mut columns, "axle_4_left_vertical", |_| 500.0);
    let statistics = statistics(&columns, &Rules::default());
    assert!((value(&statistics, "axle_1_left_l_over_v_in_curves")[0] - 0.95).abs() < 2e-3);
    assert_eq!(value(&statistics, "axle_4_left_l_over_v_time")[0], 0.0);
}

/// Accelerations: a sine of 1 Hz of 0.3 g in a part of the run.
#[test]
fn analytic_accelerations_of_a_sine() {
    let mut columns = quiet();
    let amplitude = 0.3 * GRAVITY;
    set(&mut columns, "body_at_truck_1_lateral_acceleration", |t| {
        amplitude * (2.0 * PI * t).sin()
    });
    let statistics = statistics(&columns, &Rules::default());
    let gain = study::signal::LowPass::new(INTERVAL, 10.0).unwrap().gain(1.0);
    let of = |ending: &str| {
        value(
            &statistics,
            &format!("body_at_truck_1_lateral_acceleration_{ending}"),
        )
    };
    let [raw, filtered] = of("peak_to_peak");
    assert!(
        (raw - 0.6).abs() < 1e-4 && (filtered - 0.6 * gain).abs() < 1e-3,
        "{raw} {filtered}"
    );
    let [raw, filtered] = of("rms");
    assert!((raw - 0.3 / SQRT_2).abs() < 1e-6 && (filtered - 0.3 / SQRT_2 * gain).abs() < 1e-3);
    // 2,000 ft are 20.32 s: not whole periods, so nearly.
    assert!((of("deviation")[0] - 0.3 / SQRT_2).abs() < 3e-3);
    assert!(
        statistics.values["body_at_truck_1_lateral_acceleration_deviation"]
            .remark
            .is_empty()
    );
    assert_eq!(
        statistics.values["body_at_truck_1_lateral_acceleration_rms"]
            .raw
            .as_ref()
            .unwrap()
            .unit,
        "g"
    );
    // Over more than the run: the whole run, and that is said.
    let rules = Rules {
        deviation_distance: 20_000.0 * FOOT,
        ..Rules::default()
    };
    let statistics = self::statistics(&columns, &rules);
    let remark = &statistics.values["body_at_truck_1_lateral_acceleration_deviation"].remark;
    assert!(remark.contains("not over 20000 ft"), "{remark}");
}

/// Limits: the worst of each, with its margin.
#[test]
fn analytic_limits_name_the_worst_statistic() {
    let mut columns = quiet();
    set(&mut columns, "body_roll", |t| {
        (1.5_f64).to_radians() * (2.0 * PI * 0.5 * t).sin()
    });
    set(&mut columns, "axle_2_right_lateral", |_| 40e3);
    set(&mut columns, "axle_3_left_vertical", |_| 60e3);
    let statistics = statistics(&columns, &Rules::default());
    let limits = limits::of(
        &LimitSet::built_in()[0],
        (&CarFigures::with(&[], None), &statistics.values),
        (&Rules::default(), System::Us),
    );
    let of = |quantity: &str| {
        limits
            .iter()
            .find(|own| own.quantity.starts_with(quantity))
            .unwrap()
    };
    let roll = of("body roll");
    assert!((roll.value - 3.0).abs() < 1e-3 && (roll.margin - 0.5).abs() < 1e-3);
    let wheel = of("wheel L/V lasting 50 ms");
    assert_eq!(wheel.statistic, "axle_2_right_l_over_v_time");
    assert!((wheel.value - 0.4).abs() < 1e-6 && (wheel.margin - 0.6).abs() < 1e-6);
    let load = of("least wheel load");
    assert_eq!(load.statistic, "axle_3_left_least_load_time");
    assert!((load.value - 60.0).abs() < 1e-6 && (load.margin - 50.0 / 90.0).abs() < 1e-6);
}

/// Rows too far apart for a filter: raw values stay, and what is missing is said. A run that only settles has
/// none.
#[test]
fn limits_coarse_rows_and_short_runs_are_reported() {
    let columns = quiet();
    let rules = Rules {
        wheel_filter: 60.0,
        ..Rules::default()
    };
    let statistics = statistics(&columns, &rules);
    assert!(
        statistics.remarks.iter().any(|own| own.contains("60 Hz")),
        "{:?}",
        statistics.remarks
    );
    assert!(statistics.values["axle_1_left_least_load"].filtered.is_none());
    assert!((value(&statistics, "axle_1_left_least_load")[0] - 100.0).abs() < 1e-9);
    let short: BTreeMap<String, Vec<f64>> = columns
        .into_iter()
        .map(|(name, values)| (name, values[..300].to_vec()))
        .collect();
    let statistics = self::statistics(&short, &Rules::default());
    assert!(statistics.values.is_empty() && statistics.remarks[0].contains("settling"));
    // Its filtered columns are there all the same, as those of a longer run are.
    assert!(statistics.filtered.len() == 20 && statistics.filtered.iter().all(|own| own.values.len() == 300));
}

/// Nadal's limit of a flange of 75 degrees, derived once more: tan(75° - arctan μ).
fn nadal(friction: f64) -> f64 {
    (75_f64.to_radians() - friction.atan()).tan()
}

/// The value of a measure, in US units, and the statistic it comes from.
fn worst(statistics: &Statistics, name: &str) -> (f64, String) {
    let own = Worst::named(name).unwrap().of(&statistics.values).unwrap();
    (own.value.value, own.statistic.to_owned())
}

/// Shares of Nadal's and Weinstock's limits: each wheel has the friction of its own rail, and the axle that
/// of the flange that bears and of the other tread.
#[test]
fn analytic_shares_of_nadal_and_weinstock() {
    let mut columns = quiet();
    set(&mut columns, "axle_1_left_lateral", |_| 60e3);
    set(&mut columns, "axle_1_right_lateral", |_| -20e3);
    set(&mut columns, "axle_4_right_lateral", |_| 50e3);
    set(&mut columns, "axle_4_left_lateral", |_| 30e3);
    let statistics = statistics(&columns, &Rules::default());
    let near = |name: &str, expected: f64| {
        let [raw, filtered] = value(&statistics, name);
        assert!((raw - expected).abs() < 1e-6, "{name}: {raw}, not {expected}");
        assert!(
            (filtered - expected).abs() < 1e-6,
            "{name}: {filtered}, not {expected}"
        );
    };
    near("axle_1_left_nadal_share_time", 0.6 / nadal(0.5));
    near("axle_1_right_nadal_share_time", -0.2 / nadal(0.3));
    near("axle_4_right_nadal_share_time", 0.5 / nadal(0.3));
    near("axle_1_weinstock_share_time", 0.8 / (nadal(0.5) + 0.3));
    near("axle_4_weinstock_share_time", 0.8 / (nadal(0.3) + 0.5));
    let (share, name) = worst(&statistics, "nadal_share_time");
    assert_eq!(name, "axle_1_left_nadal_share_time");
    assert!((share - 0.6 / nadal(0.5)).abs() < 1e-6);
    let figures = CarFigures::of(&car(0.5, 0.3).parameters);
    assert!((figures.least_flange_angle.to_degrees() - 75.0).abs() < 1e-6);
    assert!((figures.flange_friction - 0.5).abs() < 1e-12);
}

/// L/V that rises and falls as a triangle to 2 climbs over the share of its base above the limit; the yaw
/// that rises along the track has its value in the middle as mean. The angle of the measure is that of the
/// wheel that climbs farthest, not the largest one.
#[test]
fn analytic_climb_of_a_triangle() {
    let mut columns = quiet();
    // From 20 to 22 s, 60 m, the peak in the middle.
    let triangle = |t: f64| (1.0 - (t - 21.0).abs()).max(0.0);
    set(&mut columns, "axle_2_right_lateral", |t| 200e3 * triangle(t));
    set(&mut columns, "axle_2_yaw", |t| -0.001 * t);
    set(&mut columns, "axle_3_left_lateral", |t| 120e3 * triangle(t));
    set(&mut columns, "axle_3_yaw", |_| 0.5);
    let statistics = statistics(&columns, &Rules::default());
    let length = 60.0 * (1.0 - nadal(0.3) / 2.0);
    let [raw, filtered] = value(&statistics, "axle_2_right_climb_distance");
    assert!((raw * FOOT - length).abs() < 1e-6, "{raw}");
    assert!((filtered * FOOT - length).abs() < 1e-3, "{filtered}");
    let [angle, _] = value(&statistics, "axle_2_right_climb_angle_of_attack");
    assert!((angle - 0.021).abs() < 1e-9, "{angle}");
    let start = statistics.values["axle_2_right_climb_distance"].time.unwrap();
    assert!((start - (20.0 + nadal(0.3) / 2.0)).abs() < 0.01, "{start}");
    let [other, _] = value(&statistics, "axle_3_left_climb_distance");
    assert!(
        (other * FOOT - 60.0 * (1.0 - nadal(0.5) / 1.2)).abs() < 1e-6,
        "{other}"
    );
    let (_, name) = worst(&statistics, "climb_distance");
    assert_eq!(name, "axle_2_right_climb_distance");
    let (angle, _) = worst(&statistics, "climb_angle_of_attack");
    assert!((angle - 0.021).abs() < 1e-4, "{angle}");
    assert_eq!(value(&statistics, "axle_1_left_climb_distance")[0], 0.0);
    assert_eq!(value(&statistics, "axle_1_left_climb_angle_of_attack")[0], 0.0);
}

/// Forces of an axle: net over the static load, largest mean over 2 m, and what hunts.
#[test]
fn analytic_lateral_forces_of_an_axle() {
    let mut columns = quiet();
    let (frequency, amplitude) = (3.125, 10e3);
    set(&mut columns, "axle_2_left_lateral", |t| {
        30e3 + amplitude * (2.0 * PI * frequency * t).sin()
    });
    set(&mut columns, "axle_2_right_lateral", |_| 50e3);
    let statistics = statistics(&columns, &Rules::default());
    // 30 + 10 sin - 50: from -30 to -10 kN, held for 3 ft at 30 m/s.
    let held = |distance: f64| 20e3 + amplitude * (PI * frequency * distance / 30.0).cos();
    let [raw, _] = value(&statistics, "axle_2_net_l_over_v");
    assert!((raw - held(3.0 * FOOT) / 200e3).abs() < 1e-4, "{raw}");
    let pound = 4.448_221_615_260_5;
    let angle = PI * frequency * 2.0 / 30.0;
    let [raw, _] = value(&statistics, "axle_2_lateral_force_mean");
    let expected = 20e3 + amplitude * angle.sin() / angle;
    // Chords between rows and windows that begin at rows leave out parts of second order: of the mean's sine
    // (ωΔ)²/12 and, half a row from its peak, (ωΔ/2)²/2.
    let turn = 2.0 * PI * frequency * INTERVAL;
    let left_out = (turn * turn / 12.0 + turn * turn / 8.0) * amplitude * angle.sin() / angle;
    let error = expected - raw * pound;
    assert!((0.0..left_out).contains(&error), "{raw} {expected}");
    let (rms, name) = worst(&statistics, "axle_lateral_force_instability");
    assert_eq!(name, "axle_2_lateral_force_instability");
    let gain = BandPass::new(INTERVAL, [frequency - 2.0, frequency + 2.0])
        .unwrap()
        .gain(frequency);
    // 100 m are 10.4 periods: the rms of a part of one is off by 1/(4π 10.4) at most.
    let expected = gain * amplitude / SQRT_2;
    assert!((rms * pound / expected - 1.0).abs() < 0.02, "{rms}");
    assert!(
        statistics.values[&name].remark.contains("about 3.1"),
        "{}",
        statistics.values[&name].remark
    );
}

/// Loads: of a wheel over 3 ft, of a side over 6 ft, a wheel that lifts.
#[test]
fn analytic_loads_that_last_over_a_distance() {
    let mut columns = quiet();
    // 1.2 m at 30 m/s: more than 3 ft, less than 6 ft. Rows 15 cm apart.
    set(&mut columns, "axle_1_left_vertical", |t| {
        if (20.0..20.04).contains(&t) { 40e3 } else { 100e3 }
    });
    set(&mut columns, "axle_3_right_vertical", |t| {
        if (20.0..20.2).contains(&t) { 50e3 } else { 100e3 }
    });
    set(&mut columns, "axle_4_left_lift", |t| {
        2e-3 * (-(t - 30.0) * (t - 30.0)).exp()
    });
    let statistics = statistics(&columns, &Rules::default());
    assert!((value(&statistics, "axle_1_left_least_load_distance")[0] - 40.0).abs() < 1e-9);
    assert!((value(&statistics, "truck_2_right_least_side_load")[0] - 75.0).abs() < 1e-9);
    assert!(value(&statistics, "truck_1_left_least_side_load")[0] > 75.0);
    let (lift, name) = worst(&statistics, "wheel_lift");
    assert_eq!(name, "axle_4_left_lift_largest");
    assert!((lift * 0.0254 - 2e-3).abs() < 1e-12, "{lift}");
}

/// Windows of accelerations: a ramp has no rms about a line, and the range of what is held; a sine has its
/// levels. Trucks are not the body, and are filtered in their band.
#[test]
fn analytic_windows_of_accelerations() {
    let mut columns = quiet();
    let gravity = GRAVITY;
    set(&mut columns, "body_at_truck_1_lateral_acceleration", |t| {
        0.4 * gravity * (2.0 * PI * 2.0 * t).sin()
    });
    set(&mut columns, "body_at_truck_2_vertical_acceleration", |t| {
        0.01 * gravity * t
    });
    set(
        &mut columns,
        "truck_2_left_side_frame_lateral_acceleration",
        |t| 0.5 * gravity * (2.0 * PI * 3.0 * t).sin(),
    );
    set(&mut columns, "truck_1_bolster_lateral_acceleration", |t| {
        0.5 * gravity * (2.0 * PI * 0.2 * t).sin()
    });
    let statistics = statistics(&columns, &Rules::default());
    let gain = LowPass::new(INTERVAL, 10.0).unwrap().gain(2.0);
    let [raw, filtered] = value(&statistics, "body_at_truck_1_lateral_acceleration_range");
    let expected = 0.8 * (PI * 2.0 * 0.05).cos();
    assert!((raw - expected).abs() < 1e-3, "{raw}");
    assert!((filtered - gain * expected).abs() < 1e-3, "{filtered}");
    let [raw, _] = value(&statistics, "body_at_truck_1_lateral_acceleration_rmst");
    assert!((raw - 0.4 / SQRT_2).abs() < 1e-3, "{raw}");
    let [raw, _] = value(&statistics, "body_at_truck_2_vertical_acceleration_range");
    assert!((raw - 0.01 * (1.0 - 0.1)).abs() < 1e-9, "{raw}");
    let [raw, _] = value(&statistics, "body_at_truck_2_vertical_acceleration_rmst");
    assert!(raw < 1e-6, "{raw}");
    let (own, name) = worst(&statistics, "truck_lateral_acceleration_rms");
    assert_eq!(name, "truck_2_left_side_frame_lateral_acceleration_rms");
    let band = BandPass::new(INTERVAL, [0.5, 10.0]).unwrap();
    assert!((own - band.gain(3.0) * 0.5 / SQRT_2).abs() < 1e-3, "{own}");
    assert!((own - 0.354).abs() < 2e-3, "{own}");
    let [_, slow] = value(&statistics, "truck_1_bolster_lateral_acceleration_rms");
    assert!(slow < 0.1, "{slow}");
    let (rmst, _) = worst(&statistics, "truck_lateral_acceleration_rmst");
    assert!((rmst - own).abs() < 2e-3, "{rmst}");
    // That of the body is of the body alone.
    let (body, name) = worst(&statistics, "lateral_acceleration_rms");
    assert_eq!(name, "body_at_truck_1_lateral_acceleration_rms");
    assert!((body - 0.4 * gain / SQRT_2).abs() < 1e-3);
    let (largest, _) = worst(&statistics, "lateral_acceleration_largest");
    assert!((largest - 0.4 * gain).abs() < 1e-3);
}

/// Steps from section to section: percentiles are the steps, and mean and deviation follow.
#[test]
fn analytic_sections_of_steps() {
    let mut columns = quiet();
    // Settling ends at 70 m; the run ends at 1,210 m: eleven sections of 100 m.
    let steps = [12.0, -40.0, 20.0, 36.0, 28.0, 16.0, -24.0, 32.0, 8.0, 44.0, 48.0];
    let step = |t: f64| {
        let section = ((30.0 * t - 60.0) / 100.0 + 1e-9).floor().clamp(0.0, 10.0);
        1e3 * steps[section as usize]
    };
    set(&mut columns, "axle_3_left_lateral", step);
    set(&mut columns, "axle_1_right_vertical", |t| 100e3 + step(t).abs());
    let rules = Rules::default();
    let statistics = statistics(&columns, &rules);
    let sizes: Vec<f64> = steps.iter().map(|own: &f64| own.abs()).collect();
    let mean = sizes.iter().sum::<f64>() / 11.0;
    let deviation = (sizes.iter().map(|own| (own - mean).powi(2)).sum::<f64>() / 10.0).sqrt();
    let of = |factor: f64| 1e3 * (mean + factor * deviation);
    let pound = 4.448_221_615_260_5;
    let [raw, _] = value(&statistics, "axle_3_lateral_force_sections");
    assert!((raw * pound - of(3.0)).abs() < 1e-6 * of(3.0), "{raw}");
    let [raw, _] = value(&statistics, "axle_3_left_l_over_v_sections");
    assert!((raw - of(3.0) / 100e3).abs() < 1e-9, "{raw}");
    let [raw, _] = value(&statistics, "axle_1_right_vertical_force_sections");
    assert!((raw * pound - (100e3 + of(2.2))).abs() < 1e-6 * of(2.2), "{raw}");
    let own = &statistics.values["axle_3_lateral_force_sections"];
    assert_eq!(own.remark, "of 11 sections of 100 m");
    // The last section has the largest step.
    assert!(
        (own.time.unwrap() - (2.0 + 1000.0 / 30.0)).abs() < 0.01,
        "{own:?}"
    );
    // One section: its own value; none: nothing.
    for (length, expected) in [
        (800.0, "of one section of 800 m"),
        (2000.0, "are no section of 2000 m"),
    ] {
        let rules = Rules {
            section_length: length,
            ..rules
        };
        let own = &self::statistics(&columns, &rules).values["axle_3_left_l_over_v_sections"];
        assert!(own.remark.contains(expected), "{own:?}");
        assert_eq!(own.raw.is_some(), length < 1000.0);
    }
}

/// Quasi-static forces: medians of two curves, to either side, are not mixed.
#[test]
fn analytic_quasi_static_forces_of_two_curves() {
    let mut columns = quiet();
    // Curves from 300 m to 500 m and from 700 m to 1,000 m; spikes do not count.
    let curve = |t: f64| match 10.0 + 30.0 * t {
        s if (300.0..500.0).contains(&s) => 1.0,
        s if (700.0..1000.0).contains(&s) => -1.0,
        _ => 0.0,
    };
    let spike = |t: f64| {
        if ((t * 10.0) as usize).is_multiple_of(50) {
            5.0
        } else {
            1.0
        }
    };
    set(&mut columns, "axle_1_left_lateral", |t| {
        20e3 * spike(t) * curve(t) * if curve(t) > 0.0 { 1.0 } else { 0.5 }
    });
    set(&mut columns, "axle_2_right_vertical", |t| {
        100e3 * (1.0 + 0.3 * curve(t))
    });
    let histories = Histories {
        column: &|name| columns.get(name).map_or(&[][..], Vec::as_slice),
        rows: columns["time"].len(),
        interval: INTERVAL,
        begin: 2.0,
        parts: &PARTS,
        climb: None,
        in_curve: &|own| (300.0..500.0).contains(&own) || (700.0..1000.0).contains(&own),
    };
    let statistics = Statistics::of(&histories, &Rules::default(), System::Si);
    assert!((value(&statistics, "axle_1_left_lateral_force_in_curves")[0] - 20e3).abs() < 1e-6);
    assert!((value(&statistics, "axle_2_right_vertical_force_in_curves")[0] - 130e3).abs() < 1e-6);
    assert!((value(&statistics, "axle_2_right_quasi_static_load")[0] - 70.0).abs() < 1e-9);
    assert!((worst(&statistics, "least_quasi_static_load").0 - 70.0).abs() < 0.5);
    // Without flanges nothing is said of climbing.
    assert!(
        !statistics
            .values
            .keys()
            .any(|name| name.contains("nadal") || name.contains("climb"))
    );
}
