//! The motions of the files, and motions that inputs give, against the run of the same files.

use fmi::element::Interface;
use fmi::half_truck::HalfTruck;
use mechanics::body::COORDINATES;
use mechanics::motion::Motion;
use quantity::Kind;
use study::half_truck::HalfTruckResult;
use study::half_truck::files::Settings;
use study::half_truck::run::run;

use super::{NAME, Part, half_truck, settings};

const DURATION: f64 = 1.0;
const INTERVAL: f64 = 0.01;
const TOLERANCE: f64 = 1e-7;
/// The largest difference from a run, over the largest value of the same kind: two integrations whose steps
/// end elsewhere differ by their errors, which friction and stiff springs make this many times larger.
const BOUND: f64 = 500.0 * TOLERANCE;

fn with_tolerance(name: &str) -> HalfTruck {
    let settings = Settings {
        relative_tolerance: TOLERANCE,
        ..settings(DURATION)
    };
    HalfTruck::built_in(name, &settings).unwrap()
}

fn the_run(name: &str) -> HalfTruckResult {
    run(with_tolerance(name).case(), |_| {}).unwrap()
}

/// Returns for each output and each displacement the largest difference from the column of the run, over the
/// largest value of all columns of the same kind (of angles at least 1 mrad: in a straight run they are
/// zero). `before_step` receives the time at the end of a step.
fn differences(
    part: &mut Part,
    result: &HalfTruckResult,
    mut before_step: impl FnMut(&mut Part, f64),
) -> Vec<(String, f64)> {
    let outputs = part.description.entries.outputs.iter();
    let mut names: Vec<String> = outputs.map(|output| output.name.clone()).collect();
    let bodies = result.columns.iter().map(|column| &column.name);
    names.extend(bodies.filter(|name| name.starts_with("body_")).cloned());
    let columns: Vec<&[f64]> = names.iter().map(|name| result.column(name).unwrap()).collect();
    let mut worst = vec![0.0_f64; names.len()];
    let rows = result.summary.rows;
    for row in 0..rows {
        if row > 0 {
            let end = part.instance.time() + INTERVAL;
            before_step(part, end);
            part.step(INTERVAL);
        }
        for ((name, column), worst) in names.iter().zip(&columns).zip(&mut worst) {
            *worst = worst.max((part.get(name) - column[row]).abs());
        }
    }
    // By kind: what is zero by symmetry has no size of its own.
    let kind = |name: &str| {
        result
            .columns
            .iter()
            .find(|column| column.name == name)
            .unwrap()
            .kind
    };
    let size = |name: &str| {
        let alike = names
            .iter()
            .zip(&columns)
            .filter(|(other, _)| kind(other) == kind(name));
        let least = if kind(name) == Kind::Angle { 1e-3 } else { 0.0 };
        alike
            .flat_map(|(_, column)| *column)
            .fold(least, |most: f64, value| most.max(value.abs()))
    };
    let relative: Vec<f64> = names
        .iter()
        .zip(&worst)
        .map(|(name, worst)| worst / size(name))
        .collect();
    names.into_iter().zip(relative).collect()
}

fn check(found: &[(String, f64)], counts: impl Fn(&str) -> bool) {
    let own = found
        .iter()
        .filter(|(name, _)| !name.ends_with("_jammed") && counts(name));
    let worst = own.clone().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    println!(
        "{} columns, the largest difference: {worst:?}",
        own.clone().count()
    );
    assert!(worst.1 < BOUND, "{worst:?}");
    // Columns that do not move say nothing.
    assert!(own.count() > 20);
}

#[test]
fn the_motions_of_the_files_give_the_columns_of_the_run() {
    let mut part = Part::of(with_tolerance(NAME), Interface::CoSimulation);
    part.choose("motion", 1);
    part.begin();
    check(&differences(&mut part, &the_run(NAME), |_, _| {}), |_| true);
    let relative = part.get("ledger_relative_residual");
    assert!(relative < 1e-5, "{relative}");
}

/// The yaw rises from 0 to 0.1 s; its side frames rattle sideways, so that only what holds the truck up is
/// the same.
#[test]
fn motions_with_discontinuities_give_the_forces_of_the_run() {
    let name = "nucars_68_variable_toe_in_yaw";
    let mut part = Part::of(with_tolerance(name), Interface::CoSimulation);
    part.choose("motion", 1);
    part.begin();
    check(&differences(&mut part, &the_run(name), |_, _| {}), |name| {
        let holds = ["_friction", "_force", "_power"];
        holds.iter().any(|ending| name.ends_with(ending)) && !name.contains("lateral")
    });
}

#[test]
fn inputs_that_move_as_the_files_give_the_columns_of_the_run() {
    let half_truck = with_tolerance(NAME);
    let bodies = half_truck.case().truck.model.bodies.clone();
    let mut part = Part::of(half_truck, Interface::CoSimulation);
    let ports: Vec<(String, Motion)> = part
        .description
        .entries
        .inputs
        .iter()
        .filter(|input| input.rate.is_some())
        .map(|input| {
            let (number, coordinate) = input.name["body_".len()..].split_once('_').unwrap();
            let coordinate = COORDINATES.iter().position(|name| *name == coordinate).unwrap();
            let place = part.number_of_body(number.parse().unwrap());
            (
                input.name.clone(),
                bodies[place].frame.motions[coordinate].clone(),
            )
        })
        .collect();
    assert!(!ports.is_empty());
    let reference = part.reference("inputs_at_end");
    part.instance.set_boolean(reference, true).unwrap();
    for (name, motion) in &ports {
        let [_, rate, _] = motion.evaluate(0.0, 0.0);
        part.set(&format!("{name}_rate"), rate);
    }
    part.begin();
    let found = differences(&mut part, &the_run(NAME), |part, end| {
        for (name, motion) in &ports {
            let [value, rate, _] = motion.evaluate(end, end);
            part.set(name, value);
            part.set(&format!("{name}_rate"), rate);
        }
    });
    check(&found, |_| true);
    // The work of the inputs is in the ledger.
    let relative = part.get("ledger_relative_residual");
    let work = part.get("input_work");
    assert!(relative < 1e-5 && work.abs() > 1.0, "{relative} {work}");
}

#[test]
fn time_events_are_the_discontinuities_of_the_files() {
    let name = "nucars_68_variable_toe_in_yaw";
    let event = |motion: i32| {
        let mut part = Part::of(half_truck(name, DURATION), Interface::ModelExchange);
        part.choose("motion", motion);
        part.begin();
        let first = part.instance.update_discrete_states().unwrap().next_time;
        first.map(|time| {
            part.instance.enter_continuous_time_mode().unwrap();
            part.instance.set_time(time).unwrap();
            part.instance.enter_event_mode().unwrap();
            let second = part.instance.update_discrete_states().unwrap().next_time;
            (time, second)
        })
    };
    let (first, second) = event(1).unwrap();
    let model = half_truck(name, DURATION).case().truck.model.clone();
    let next = |time| {
        let breaks = model.bodies.iter().filter_map(|body| body.frame.next_break(time));
        breaks.min_by(f64::total_cmp)
    };
    assert_eq!(Some(first), next(0.0));
    assert_eq!(second, next(first));
    assert_eq!(event(0), None);
}
