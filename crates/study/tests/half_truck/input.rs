//! The runs that are built in.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::collections::BTreeSet;

use mechanics::connection::Law;
use mechanics::system::System;
use study::half_truck::HalfTruckStart;
use study::half_truck::catalog::{ToeCase, WedgeType, YawCase, entries, entry};
use study::half_truck::files::Settings;
use study::half_truck::run::run;

use crate::common::case;

#[test]
fn all_entries_make_systems_of_eighteen_coordinates_and_four_wedges() {
    let names: BTreeSet<String> = entries().iter().map(|own| own.name()).collect();
    assert_eq!(names.len(), 28);
    let of_the_table = entries().iter().filter(|own| own.yaw != YawCase::Printed).count();
    assert_eq!(of_the_table, 24);
    for own in entries() {
        assert_eq!(entry(&own.name()), Some(own));
        let case = case(&own.name(), 1.0);
        let connections = if own.yaw == YawCase::Intended { 48 } else { 50 };
        assert_eq!(case.truck.model.connections.len(), connections, "{}", case.name);
        assert_eq!(
            case.truck.left_out,
            if own.yaw == YawCase::Intended {
                vec![201, 221]
            } else {
                vec![]
            }
        );
        let system = System::new(case.truck.model.clone()).unwrap();
        assert_eq!(system.layout().speeds, 18);
        let wedges: Vec<u32> = case
            .truck
            .wedges()
            .map(|place| case.truck.connections[place])
            .collect();
        assert_eq!(wedges, [127, 128, 129, 130]);
    }
    assert_eq!(entry("nucars_67_constant_toe_out"), None);
}

/// Type 6.8 has no angle: no toe is its toe-out branch.
#[test]
fn no_toe_of_the_plain_type_is_toe_out() {
    for own in entries()
        .into_iter()
        .filter(|own| own.wedges == WedgeType::Plain && own.toe == ToeCase::None)
    {
        let other = own.name().replace("toe_none", "toe_out");
        let (one, other) = (case(&own.name(), 1.0).truck.model, case(&other, 1.0).truck.model);
        assert_eq!((one.bodies, one.connections), (other.bodies, other.connections));
    }
}

#[test]
fn the_same_run_gives_the_same_bits() {
    let case = case("nucars_69_variable_toe_out_yaw", 4.0);
    let (a, b) = (run(&case, |_| ()).unwrap(), run(&case, |_| ()).unwrap());
    for ((column, a), b) in a.columns.iter().zip(&a.values).zip(&b.values) {
        assert!(
            a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits()),
            "{}",
            column.name
        );
    }
}

#[test]
fn input_values_set_over_files_reach_model_run_and_assumptions() {
    let entry = entry("nucars_69_variable_toe_out").unwrap();
    let with = |set: &[&str]| {
        entry.case_with(&Settings {
            set: set.iter().map(|own| (*own).to_owned()).collect(),
            ..Settings::default()
        })
    };
    let case = with(&[
        "wedges.column_friction=0.25",
        "simulation.duration=1.5 s",
        "simulation.output_interval=\"0.05 s\"",
        "simulation.relative_tolerance=1e-6",
        "simulation.start=equilibrium",
        "simulation.output_units=si",
        "option.branch=0.1 in/s",
    ])
    .unwrap();
    assert_eq!((case.duration, case.interval), (1.5, 0.05));
    assert_eq!(case.relative_tolerance, 1e-6);
    assert_eq!(case.start, HalfTruckStart::Equilibrium);
    assert_eq!(case.units, quantity::System::Si);
    for place in case.truck.wedges() {
        match &case.truck.model.connections[place].law {
            Law::Wedge(wedge) => assert_eq!(wedge.column_friction, 0.25),
            other => panic!("{other:?}"),
        }
    }
    assert!(
        case.assumptions
            .iter()
            .any(|line| line.contains("wedges.column_friction=0.25"))
    );
    for (typed, text) in [
        ("wedges.column_friction", "PATH=VALUE"),
        ("simulation.durations=1 s", "did you mean duration?"),
        ("simulation.method=rodas", "it has duration"),
        ("simulation.duration=1", "a positive time"),
        ("simulation.relative_tolerance=1", "between 0 and 1"),
        ("option.bend=round", "half_cosine or linear"),
        ("wedges.colum_friction=1", "did you mean column_friction?"),
    ] {
        let error = with(&[typed]).unwrap_err().to_string();
        assert!(error.contains(text), "{typed}: {error}");
    }
}
