//! The three-piece truck behind the variables: the columns of its run, inputs that move it, saved states,
//! what is refused.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::source::Source;
use study::run::Run;
use study::truck::builtin;
use study::truck::run::TruckResult;

use crate::part::Part;

const INTERVAL: f64 = 0.01;

fn source(name: &str, set: &[&str]) -> Source {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    Source::ThreePieceTruck(Box::new(builtin::case_with(name, &set).unwrap()))
}

fn truck(source: Source, interface: Interface) -> Part {
    Part::new(source, Version::Three, interface, INTERVAL)
}

const SET: [&str; 2] = ["simulation.duration=2.6 s", "simulation.relative_tolerance=1e-8"];

/// Largest difference of outputs from columns of the run, over the largest value of the column.
fn compare(
    part: &mut Part,
    result: &TruckResult,
    names: &[&str],
    mut before_step: impl FnMut(&mut Part, f64),
) {
    let mut worst = vec![0.0_f64; names.len()];
    for row in 0..result.rows() {
        if row > 0 {
            let end = part.instance.time() + INTERVAL;
            before_step(part, end);
            part.step();
        }
        for (name, worst) in names.iter().zip(&mut worst) {
            *worst = worst.max((part.get(name) - result.column(name).unwrap()[row]).abs());
        }
    }
    for (name, worst) in names.iter().zip(worst) {
        let column = result.column(name).unwrap();
        let size = column.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!(size > 0.0, "{name} says nothing");
        assert!(worst < 1e-5 * size, "{name}: {worst:e} of {size:e}");
    }
}

const NAMES: [&str; 5] = [
    "warp_angle",
    "warp_moment",
    "leading_left_column_normal",
    "trailing_right_slope_normal",
    "left_nest_vertical_force",
];

#[test]
fn cross_code_the_motions_of_the_case_give_the_columns_of_the_run() {
    let name = "truck_warp_nest_variable_rising";
    let result = Run::new(&builtin::case_with(name, &SET.map(str::to_owned)).unwrap())
        .unwrap()
        .finish(|_| ());
    let mut part = truck(source(name, &SET), Interface::CoSimulation);
    let reference = part.reference("motion");
    part.instance.set_integer(reference, 1).unwrap();
    part.begin();
    compare(&mut part, &result, &NAMES, |_, _| {});
    let relative = part.get("ledger_relative_residual");
    assert!(relative < 1e-5, "{relative}");
}

#[test]
fn cross_code_inputs_that_move_as_the_case_give_the_columns_of_the_run() {
    let name = "truck_vertical_variable";
    let set = ["simulation.duration=1.5 s", "simulation.relative_tolerance=1e-8"];
    let result = Run::new(&builtin::case_with(name, &set.map(str::to_owned)).unwrap())
        .unwrap()
        .finish(|_| ());
    let mut part = truck(source(name, &set), Interface::CoSimulation);
    let reference = part.reference("inputs_at_end");
    part.instance.set_boolean(reference, true).unwrap();
    part.set("bolster_z_motion_rate", 0.0254);
    part.begin();
    compare(&mut part, &result, &NAMES[2..], |part, end| {
        let (sine, cosine) = (2.0 * end).sin_cos();
        part.set("bolster_z_motion", 0.0127 * sine);
        part.set("bolster_z_motion_rate", 0.0254 * cosine);
    });
    let work = part.get("motion_work");
    assert!(work.abs() > 10.0, "{work} J");
}

/// A force on the half car as an input does what the same load of a case does; its work is in the ledger.
#[test]
fn cross_code_a_load_as_input_gives_the_columns_of_a_case_that_has_it() {
    let name = "truck_drop_variable";
    let [load, set @ ..] = [
        "bolster.load.vertical=-20000 N",
        "start.lift=0 in",
        "simulation.duration=0.6 s",
        "simulation.relative_tolerance=1e-8",
    ];
    let loaded = [&set[..], &[load]].concat();
    let case = builtin::case_with(
        name,
        &loaded.iter().map(|text| (*text).to_owned()).collect::<Vec<_>>(),
    )
    .unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    let mut part = truck(source(name, &set), Interface::CoSimulation);
    part.set("force_on_bolster_z", -20_000.0);
    part.begin();
    let names = [
        "bolster_z",
        "leading_left_column_normal",
        "left_nest_vertical_force",
    ];
    compare(&mut part, &result, &names, |_, _| {});
    let [work, relative, way] =
        ["load_work", "ledger_relative_residual", "bolster_z"].map(|name| part.get(name));
    assert!(
        (work + 20_000.0 * way).abs() < 1e-9 * work.abs() && work > 1.0,
        "{work} J along {way} m"
    );
    assert!(relative < 1e-5, "{relative}");
    // The case's own load is left out where inputs load, and acts where the case moves.
    let mut case_moves = truck(source(name, &loaded), Interface::CoSimulation);
    let reference = case_moves.reference("motion");
    case_moves.instance.set_integer(reference, 1).unwrap();
    case_moves.begin();
    compare(&mut case_moves, &result, &names, |_, _| {});
}

#[test]
fn reproducible_a_saved_truck_goes_on_with_the_same_bits() {
    let mut part = truck(source("truck_roll_variable", &SET), Interface::CoSimulation);
    let reference = part.reference("motion");
    part.instance.set_integer(reference, 1).unwrap();
    part.begin();
    for _ in 0..20 {
        part.step();
    }
    let saved = part.instance.save();
    let on = |part: &mut Part| {
        for _ in 0..20 {
            part.step();
        }
        [
            part.get("leading_left_column_normal"),
            part.get("left_nest_vertical_force"),
        ]
        .map(f64::to_bits)
    };
    let first = on(&mut part);
    part.instance.restore(&saved).unwrap();
    assert_eq!(on(&mut part), first);
}

#[test]
fn limits_every_variable_has_a_value_in_model_exchange() {
    let mut part = truck(source("truck_drop_variable", &[]), Interface::ModelExchange);
    part.begin();
    let entries = part.description.entries.clone();
    for list in [
        &entries.states,
        &entries.outputs,
        &entries.columns,
        &entries.indicators,
    ] {
        assert!(!list.is_empty());
        for entry in list {
            let value = part.get(&entry.name);
            assert!(value.is_finite(), "{}: {value}", entry.name);
        }
    }
    // Eight faces of four points and four adapters of two.
    assert_eq!(entries.modes.len(), 40);
}

#[test]
fn input_a_truck_that_settles_first_is_refused() {
    let source = source("truck_vertical_variable", &["start.settle=1 s"]);
    let error = Description::new(&source).unwrap_err();
    assert!(error.to_string().contains("start.settle"), "{error}");
}
