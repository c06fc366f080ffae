//! Runs in parts: all parts together are the whole run, in every column of every model, wherever it is cut.

use std::fmt::Debug;

use crate::wheelsets::wheelset;
use rolling::rig::RigStart;
use serde::Serialize;
use serde_json::{Value, json};
use study::car::run::CarCounts;
use study::car::{self, CarCase};
use study::case::builtin;
use study::half_truck::catalog::entries;
use study::half_truck::files::Settings;
use study::result::RunResult;
use study::run::{Recorder, Run, RunCase, RunState};
use study::truck;
use study::wheelset::{Wheelset, WheelsetCase};

/// A fixed sequence of numbers between zero and one, another one for each name.
struct Sequence(u64);

impl Sequence {
    fn of(name: &str) -> Self {
        let bytes = name.bytes();
        Self(bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        }))
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn bits(values: &[Vec<f64>]) -> Vec<Vec<u64>> {
    let bits = |column: &Vec<f64>| column.iter().map(|value| value.to_bits()).collect();
    values.iter().map(bits).collect()
}

/// Runs a case in parts, each saved as text and read again; returns the rows of all and the summary of the
/// last.
fn in_parts<C, S>(case: &C, cuts: &[f64]) -> RunResult<S>
where
    C: RunCase<Output = RunResult<S>>,
    <C::Recorder as Recorder>::Counts: Debug,
{
    let mut run = Run::new(case).unwrap();
    let mut joined: Option<RunResult<S>> = None;
    for cut in cuts.iter().copied().chain([f64::INFINITY]) {
        let mut reason = None;
        while reason.is_none() && !run.is_finished() && run.time() < cut {
            reason = run.advance().err().map(|error| error.to_string());
        }
        let ended = run.is_finished() || reason.is_some();
        let state = run.state();
        if !ended {
            run.look_ahead().unwrap();
        }
        let stopped = reason.map(|reason| run.stopped(reason));
        let mut part = run.result(stopped);
        if let Some(before) = joined {
            assert_eq!(part.columns, before.columns);
            for (own, before) in part.values.iter_mut().zip(before.values) {
                own.splice(0..0, before);
            }
        }
        if ended {
            return part;
        }
        joined = Some(part);
        let text = serde_json::to_string(&state).unwrap();
        let read: RunState<_> = serde_json::from_str(&text).unwrap();
        assert_eq!(read, state);
        run = Run::resume(case, read).unwrap();
    }
    unreachable!("the last part has no end")
}

/// Checks that a case that is cut at shares of its duration has the rows and the summary of the whole.
fn check<C, S>(name: &str, case: &C, shares: &[f64])
where
    C: RunCase<Output = RunResult<S>>,
    <C::Recorder as Recorder>::Counts: Debug,
    S: Serialize,
{
    let [duration, _] = case.duration_and_interval();
    let cuts: Vec<f64> = shares.iter().map(|share| share * duration).collect();
    let whole = Run::new(case).unwrap().finish(|_| {});
    let parts = in_parts(case, &cuts);
    assert_eq!(whole.columns, parts.columns, "{name}");
    for ((column, whole), parts) in whole
        .columns
        .iter()
        .zip(bits(&whole.values))
        .zip(bits(&parts.values))
    {
        let differs = whole.iter().zip(&parts).position(|(a, b)| a != b);
        assert_eq!(
            differs, None,
            "{name}, cut at {cuts:?} s: {} differs at that row",
            column.name
        );
        assert_eq!(whole.len(), parts.len(), "{name}: rows of {}", column.name);
    }
    let summary = |summary: &S| {
        let mut value = serde_json::to_value(summary).unwrap();
        value["rows"] = Value::Null;
        value
    };
    let [whole, parts] = [&whole, &parts].map(|own| summary(&own.summary));
    for (key, value) in whole.as_object().unwrap() {
        assert_eq!(*value, parts[key], "{name}, cut at {cuts:?} s: {key}");
    }
}

/// Two places of a cut among the shares of a run.
fn two(name: &str) -> [f64; 2] {
    let mut sequence = Sequence::of(name);
    let mut cuts = [sequence.next(), sequence.next()];
    cuts.sort_by(f64::total_cmp);
    cuts
}

#[test]
fn issue_047_parts_of_wedges_are_the_whole() {
    for name in builtin::names() {
        let mut case = builtin::case(name).unwrap();
        // The last row is nearer than the others; of the thesis's runs one whole cycle ends before.
        case.simulation.duration = 0.804;
        check(name, &case, &two(name));
    }
}

#[test]
fn issue_047_parts_of_trucks_are_the_whole() {
    for name in truck::builtin::names() {
        let set = ["simulation.duration=0.404 s".to_owned()];
        check(name, &truck::builtin::case_with(name, &set).unwrap(), &two(name));
    }
    // Past a whole cycle: equivalent damping of the bounce, and warp stiffness from before the warp.
    for name in ["truck_vertical_variable", "truck_warp_nest_constant_rising"] {
        let set = ["simulation.duration=2.6 s".to_owned()];
        check(name, &truck::builtin::case_with(name, &set).unwrap(), &[0.4, 0.9]);
    }
}

#[test]
fn issue_047_parts_of_half_trucks_are_the_whole() {
    for entry in entries() {
        for wedges in ["massless", "bodies"] {
            let settings = Settings {
                duration: Some(0.404),
                set: vec![format!("option.wedges={wedges}")],
                ..Settings::default()
            };
            let name = format!("{} {wedges}", entry.name());
            check(&name, &entry.case_with(&settings).unwrap(), &two(&name));
        }
    }
}

#[test]
fn issue_047_parts_of_a_wheelset_are_the_whole() {
    let wheelset = Wheelset {
        start: RigStart {
            distance: 2.0,
            lateral: 0.003,
            ..RigStart::default()
        },
        duration: Some(0.304),
        ..wheelset("[[segments]]\ntangent = \"100 ft\"\n", 15.0)
    };
    check("wheelset", &WheelsetCase::new(wheelset).unwrap(), &[0.31, 0.7]);
}

/// Short runs of cars whose filters look ahead by a part of them; a last row nearer than the others.
/// Of a short run from the equilibrium: shaking a car takes ten times as long as the rest.
const SHORT: [&str; 6] = [
    "start.kind=equilibrium",
    "simulation.duration=0.1506 s",
    "simulation.output_interval=0.001 s",
    "start.settle=0.04 s",
    "output.wheel_filter=240 Hz",
    "output.acceleration_filter=200 Hz",
];

fn car(name: &str, more: &[&str]) -> CarCase {
    let set: Vec<String> = SHORT.iter().chain(more).map(|own| (*own).to_owned()).collect();
    car::builtin::case_with(name, &set).unwrap()
}

#[test]
fn issue_047_parts_of_cars_are_the_whole() {
    for name in car::builtin::names() {
        check(name, &car(name, &[]), &[Sequence::of(name).next()]);
    }
}

/// Cuts at the first step, in the filters' beginning, before the statistics begin, between two rows, one soon
/// after the other, before the last row.
#[test]
fn issue_047_a_car_may_be_cut_anywhere() {
    let name = "car_fra_class_2_empty";
    for shares in [
        &[1e-9, 0.01][..],
        &[0.1, 0.24, 0.2455],
        &[0.501, 0.505],
        &[0.97, 0.999],
    ] {
        check(name, &car(name, &[]), shares);
    }
    // Filters that look beyond the end, and a run that does not reach the statistics.
    let slow = ["output.wheel_filter=15 Hz", "start.settle=1 s"];
    check(name, &car(name, &slow), &[0.2, 0.8]);
    let without = ["output.filtered_columns=false", "start.kind=shaken"];
    check(name, &car(name, &without), &[0.5]);
}

#[test]
fn issue_047_rows_of_a_saved_state_that_no_run_has_are_refused_by_name() {
    let case = car("car_tangent_loaded", &[]);
    let mut run = Run::new(&case).unwrap();
    while run.time() < 0.05 {
        run.advance().unwrap();
    }
    let good = serde_json::to_value(run.state()).unwrap();
    let resume = |state: Value| {
        let state: RunState<CarCounts> = serde_json::from_value(state).unwrap();
        Run::resume(&case, state)
    };
    assert!(resume(good.clone()).is_ok());
    let mut short = good["counts"]["table"]["columns"]["distance"].clone();
    short.as_array_mut().unwrap().pop();
    for (place, value, member) in [
        ("/counts/table/columns/distance", short, "counts.table.columns"),
        (
            "/counts/table/columns/other",
            json!([0.0]),
            "counts.table.columns",
        ),
        ("/counts/table/extremes", json!([]), "counts.table.extremes"),
        (
            "/counts/table/extremes/3/minimum",
            json!(1e300),
            "counts.table.extremes",
        ),
        (
            "/counts/table/extremes/3/maximum_time",
            json!(7.0),
            "counts.table.extremes",
        ),
        ("/counts/rows", json!(5), "counts.rows"),
        ("/counts/locked", json!([0]), "counts.locked"),
    ] {
        let mut state = good.clone();
        let (parent, key) = place.rsplit_once('/').unwrap();
        state.pointer_mut(parent).unwrap()[key] = value;
        let reason = resume(state)
            .err()
            .unwrap_or_else(|| panic!("{place} was taken"))
            .to_string();
        assert!(
            reason.contains("damaged") && reason.contains(member),
            "{place}: {reason}"
        );
    }
    let mut without = good.clone();
    without["counts"]["table"]["columns"]
        .as_object_mut()
        .unwrap()
        .remove("speed");
    let reason = resume(without).err().unwrap().to_string();
    assert!(reason.contains("without `speed`"), "{reason}");
}
