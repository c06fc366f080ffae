//! Statistics of made-up runs with known answers.

use std::collections::BTreeMap;
use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

use quantity::System;
use study::car::CarCase;
use study::car::figures::ClimbLimits;
use study::car::limits::{self, LimitSet};
use study::car::statistics::{Histories, Rules, Statistics};

const FOOT: f64 = 0.3048;
const GRAVITY: f64 = 9.806_65;
const INTERVAL: f64 = 0.005;

/// Wheels of AAR-1B, whose flanges have 75°, on rails with a friction of 0.5 on the left and 0.3 on the right.
static CLIMB: LazyLock<ClimbLimits> = LazyLock::new(|| ClimbLimits::of(&car(0.5, 0.3).parameters).unwrap());

fn car(left: f64, right: f64) -> CarCase {
    let text = format!("[friction]\ncoefficient = {left}\n[friction.right]\ncoefficient = {right}\n");
    CarCase::parse("made_up.toml", &text, std::path::Path::new(""), &[]).unwrap()
}

/// Returns a run of 40 s at 30 m/s: every wheel carries 100 kN, nothing else happens.
fn quiet() -> BTreeMap<String, Vec<f64>> {
    let rows = 8001;
    let mut columns = BTreeMap::new();
    let time: Vec<f64> = (0..rows).map(|row| f64::from(row) * INTERVAL).collect();
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
        static_loads: &[[100e3; 2]; 4],
        trucks: &[vec![0, 1], vec![2, 3]],
        climb: Some(&*CLIMB),
        axle_places: &[0.0; 4],
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
        &statistics.values,
        &|_| None,
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
