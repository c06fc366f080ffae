//! Runs: columns, ledger, saved states, derailment.

use std::ops::ControlFlow;
use std::path::PathBuf;

use quantity::System;
use study::car::CarCase;
use study::car::columns::CarTable;
use study::car::run::CarResult;
use study::case::Tables;
use study::design::{Study, StudySource};
use study::models::CaseSource;
use study::outcome::Outcome;
use study::records::{self, Status};
use study::run::Run;
use study::summary::RunSummary;

fn case(lines: &str) -> CarCase {
    let text = format!("model = \"car\"\nstart.settle = \"0 s\"\n{lines}");
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

fn run(case: &CarCase) -> CarResult {
    Run::new(case).unwrap().finish(|_| ())
}

const JOINT: &str = "speed.value = \"40 mph\"\n[[track.segments]]\ntangent = \"500 ft\"\n\
                     [[track.irregularities]]\nshape = \"dip\"\nrails = \"left\"\n\
                     direction = \"vertical\"\ndepth = \"0.3 in\"\nlength = \"10 ft\"\nstart = \"48 ft\"\n";

/// The fixed columns stand first, in their order and with their units.
#[test]
fn input_fixed_columns_have_their_names() {
    let result = run(&case("simulation.duration = \"0.02 s\""));
    let names: Vec<String> = result
        .columns
        .iter()
        .map(|own| own.full_name(System::Us))
        .collect();
    let mut wanted: Vec<String> = ["time_s", "distance_ft", "speed_mph"].map(str::to_owned).to_vec();
    for axle in 1..=4 {
        for side in ["left", "right"] {
            for what in ["vertical_lbf", "lateral_lbf", "l_over_v"] {
                wanted.push(format!("axle_{axle}_{side}_{what}"));
            }
        }
        wanted.push(format!("axle_{axle}_lateral_in"));
        wanted.push(format!("axle_{axle}_yaw_rad"));
    }
    wanted.push("body_roll_rad".to_owned());
    for truck in 1..=2 {
        for direction in ["lateral", "vertical"] {
            wanted.push(format!("body_at_truck_{truck}_{direction}_acceleration_g"));
        }
    }
    wanted.extend([1, 2].map(|truck| format!("truck_{truck}_warp_angle_rad")));
    wanted.push("truck_1_left_nest_vertical_force_lbf".to_owned());
    wanted.push("truck_1_right_nest_vertical_force_lbf".to_owned());
    wanted.push("truck_1_leading_left_column_normal_lbf".to_owned());
    assert_eq!(&names[..wanted.len()], wanted.as_slice());
    assert!(names.contains(&"truck_2_trailing_right_yaw_rad".to_owned()));
    assert!(names.contains(&"axle_4_right_l_over_v_filtered".to_owned()));
    let si: Vec<String> = result
        .columns
        .iter()
        .map(|own| own.full_name(System::Si))
        .collect();
    assert!(si.contains(&"distance_m".to_owned()) && si.contains(&"speed_m_per_s".to_owned()));
    // A run that is too short for statistics says so, and has none.
    assert!(result.summary.complete);
}

/// On straight perfect track nothing happens: wheels carry their static loads, and the sum is the car's
/// weight.
#[test]
fn analytic_static_loads_on_perfect_track() {
    let own = case("speed.value = \"30 mph\"\nsimulation.duration = \"0.3 s\"");
    let result = run(&own);
    let mut sum = 0.0;
    for axle in 1..=4 {
        for side in ["left", "right"] {
            let name = format!("axle_{axle}_{side}");
            let wanted = result.summary.static_loads[&name].value * 4.448_221_615_260_5;
            sum += wanted;
            let column = result.column(&format!("{name}_vertical")).unwrap();
            for load in column {
                assert!((load / wanted - 1.0).abs() < 2e-3, "{name}: {load} {wanted}");
            }
        }
    }
    assert!((sum / own.parameters.weight() - 1.0).abs() < 1e-12);
    let roll = result.column("body_roll").unwrap();
    assert!(roll.iter().all(|own| own.abs() < 1e-6));
    let distance = result.column("distance").unwrap();
    let way = distance[distance.len() - 1] - distance[0];
    assert!((way / (30.0 * 0.447_04 * 0.3) - 1.0).abs() < 1e-4, "{way}");
    assert!(
        result.summary.warnings.is_empty(),
        "{:?}",
        result.summary.warnings
    );
}

/// Over a dip of one rail: the ledger closes with a method that does not damp the blow, the left wheels
/// respond to it, and statistics agree with the columns.
#[test]
fn energy_the_ledger_closes_over_a_dip() {
    let simulation = "[simulation]\nduration = \"0.6 s\"\nmethod = \"rodas5p\"\n";
    let result = run(&case(&format!("{JOINT}{simulation}")));
    let summary = &result.summary;
    assert!(summary.complete && summary.failed.is_none());
    let residual = summary.ledger.largest_relative_residual;
    assert!(residual < 1e-3, "{residual}");
    let vertical = result.column("axle_1_left_vertical").unwrap();
    let least = vertical.iter().fold(f64::INFINITY, |least, own| least.min(*own));
    let static_load = summary.static_loads["axle_1_left"].value * 4.448_221_615_260_5;
    let reported = summary.statistics["axle_1_left_least_load"]
        .raw
        .as_ref()
        .unwrap()
        .value;
    assert!(
        reported < 99.0 && (reported - 100.0 * least / static_load).abs() < 1e-6,
        "{reported}"
    );
    // Entries of the ledger as columns: what is put in is stored or lost.
    let last = |name: &str| *result.column(name).unwrap().last().unwrap();
    let losses = [
        "creep_loss",
        "friction_loss",
        "contact_damping_loss",
        "element_loss",
    ]
    .map(last);
    let rest = last("drive_work") + last("contact_work")
        - losses.iter().sum::<f64>()
        - last("stored_energy_change")
        - last("ledger_residual");
    let scale = losses.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    assert!(rest.abs() < 1e-9 * scale, "{rest} {scale}");
    where_the_energy_went(
        &result,
        losses.iter().sum(),
        last("creep_loss"),
        last("ledger_residual"),
    );
}

/// Energies of the run as a whole say what the ledger's columns say: all losses (J), those of the wheels, and
/// the residual; each group is the sum of its elements, and one that is left out is noticed.
fn where_the_energy_went(result: &CarResult, lost: f64, creep: f64, residual: f64) {
    const INCH_POUND: f64 = 4.448_221_615_260_5 * 0.0254;
    let energy = &result.summary.energy;
    let near = |reported: f64, wanted: f64| {
        assert!(
            (reported * INCH_POUND - wanted).abs() < 1e-9 * lost,
            "{reported} {wanted}"
        );
    };
    near(energy.loss.as_ref().unwrap().value, lost);
    near(energy.residual.as_ref().unwrap().value, residual);
    near(energy.balance(), residual);
    let wheels = &energy.losses["wheel_loss"];
    near(wheels.total.as_ref().unwrap().value, creep);
    assert_eq!(wheels.by_point.len(), 8);
    assert_eq!(energy.losses["column_friction_loss"].by_point.len(), 8);
    assert_eq!(energy.losses["adapter_friction_loss"].by_point.len(), 8);
    for (name, own) in energy.losses.iter().filter(|(_, own)| !own.by_point.is_empty()) {
        let sum: f64 = own.by_point.values().map(|own| own.value).sum();
        let total = own.total.as_ref().unwrap().value;
        assert!((sum - total).abs() <= 1e-12 * total.abs(), "{name}");
    }
    let column = result.column("distance").unwrap();
    let gone = column[column.len() - 1] - column[0];
    let distance = energy.distance.as_ref().unwrap();
    assert_eq!(distance.unit, "ft");
    assert!((distance.value * 0.3048 / gone - 1.0).abs() < 1e-12);
    // As a force: what it takes to make up for the loss.
    let resistance = energy
        .by_distance(energy.loss.as_ref().unwrap().value, System::Us)
        .unwrap();
    assert!((resistance.value * 4.448_221_615_260_5 * gone / lost - 1.0).abs() < 1e-12);
    let mut without = energy.clone();
    without.losses.remove("column_friction_loss");
    let total = energy.losses["column_friction_loss"]
        .total
        .as_ref()
        .unwrap()
        .value;
    assert!(total > 0.0 && (without.balance() - energy.balance() - total).abs() < 1e-9 * total);
}

/// A run that is saved and goes on gives the same bits from there on.
#[test]
fn reproducible_a_saved_run_goes_on_with_the_same_bits() {
    let own = case(&format!("{JOINT}[simulation]\nduration = \"0.3 s\"\n"));
    let whole = run(&own);
    let mut first = Run::new(&own).unwrap();
    while first.time() < 0.15 {
        first.advance().unwrap();
    }
    let state = serde_json::from_str(&serde_json::to_string(&first.state()).unwrap()).unwrap();
    let second = Run::resume(&own, state).unwrap().finish(|_| ());
    let (rows, all) = (second.rows(), whole.rows());
    assert!(rows > 10 && rows < all);
    for name in [
        "axle_1_left_vertical",
        "body_roll",
        "truck_2_leading_left_column_normal",
        "ledger_residual",
    ] {
        let (a, b) = (whole.column(name).unwrap(), second.column(name).unwrap());
        assert_eq!(&a[all - rows..], b, "{name}");
    }
    // The summary is that of the whole run: nothing about rows before the state is left to be said.
    assert_eq!(second.summary.warnings, whole.summary.warnings);
    assert_eq!(second.summary.statistics, whole.summary.statistics);
}

/// A run that is stopped keeps what it has.
#[test]
fn limits_a_stopped_run_keeps_its_rows() {
    let own = case("simulation.duration = \"2 s\"");
    let result = Run::new(&own).unwrap().finish_while(|time| match time > 0.1 {
        true => ControlFlow::Break("enough".to_owned()),
        false => ControlFlow::Continue(()),
    });
    assert!(!result.summary.complete && result.rows() > 15);
    assert_eq!(result.summary.stopped.as_ref().unwrap().reason, "enough");
}

/// Returns an empty car whose rails jump sideways within this length, ft.
fn jog(length: f64) -> CarCase {
    case(&jog_lines(length))
}

fn jog_lines(length: f64) -> String {
    format!(
        "lading.kind = \"empty\"\nspeed.value = \"60 mph\"\n[[track.segments]]\ntangent = \"600 ft\"\n\
         [[track.irregularities]]\nshape = \"jog\"\nrails = \"both\"\ndirection = \"lateral\"\n\
         offset = \"5 in\"\nlength = \"{length} ft\"\nstart = \"50 ft\"\n[simulation]\n\
         duration = \"0.4 s\"\n"
    )
}

/// Rails that jump sideways under a wheel: it leaves its rail, which is a result with its place, but no
/// complete run; a track that only leads to the side is followed.
#[test]
fn issue_047_a_derailment_is_a_result_that_is_not_complete() {
    let result = run(&jog(3.0));
    let summary = &result.summary;
    let derailed = summary.derailed.as_ref().unwrap();
    assert!(!summary.complete && summary.stopped.is_none());
    let outcome = summary.outcome();
    let end = outcome.end().unwrap();
    assert_eq!((outcome.word(), end.time), ("derailed", derailed.time));
    let reached = result.column("distance").unwrap().last().unwrap() / 0.3048;
    assert!((end.distance.as_ref().unwrap().value - reached).abs() < 1e-9);
    let told = outcome.told().unwrap();
    assert!(
        told.starts_with("derailed at 0.") && told.contains("is incomplete"),
        "{told}"
    );
    assert!(outcome.numbers().unwrap().contains(&end.place()));
    assert_eq!((derailed.axle, derailed.distance.unit.as_str()), (1, "ft"));
    assert!((50.0..60.0).contains(&derailed.distance.value), "{derailed:?}");
    assert!(told.contains("left its rail at"), "{told}");
    // The row that shows it is kept.
    assert_eq!(result.column("time").unwrap().last(), Some(&derailed.time));
    let followed = run(&jog(400.0));
    assert!(followed.summary.derailed.is_none() && followed.summary.complete);
    assert_eq!(followed.summary.outcome(), Outcome::Complete);
}

/// A variant that derails is a record of its own kind, with its reason and its measures; a variant beside it
/// is complete.
#[test]
fn issue_047_a_study_tells_which_variants_derailed() {
    let text = "case = \"car.toml\"\nsampling = \"list\"\n[[variants]]\n\
                simulation.duration = \"0.4 s\"\n[[variants]]\nsimulation.duration = \"0.02 s\"\n";
    let study = Study::of_source(StudySource {
        name: "study.toml".to_owned(),
        text: text.to_owned(),
        folder: PathBuf::new(),
        case: CaseSource::File {
            name: "car.toml".to_owned(),
            text: format!("model = \"car\"\nstart.settle = \"0 s\"\n{}", jog_lines(3.0)),
            folder: PathBuf::new(),
        },
    })
    .unwrap();
    let [gone, whole] = [0, 1].map(|number| records::run(&study, number));
    assert_eq!(
        (gone.status, whole.status),
        (Status::Derailed, Status::Complete),
        "{whole:?}"
    );
    assert_eq!(gone.status.name(), "derailed");
    assert!(
        gone.reason.starts_with("at 0.") && gone.reason.contains("left its rail"),
        "{}",
        gone.reason
    );
    let derailed = [&gone, &whole].map(|own| study.measures().get(&own.measures, "derailed"));
    assert_eq!(derailed, [Some(1.0), Some(0.0)]);
    let mut bytes = Vec::new();
    gone.write(study.fingerprint(), &mut bytes);
    let [again] = &records::read(study.fingerprint(), &bytes).records[..] else {
        panic!("one record");
    };
    assert_eq!((again.status, &again.reason), (gone.status, &gone.reason));
}

/// The industry's wedges in a curve: it ends, without warnings, and tells which wedges it has.
#[test]
fn limits_massless_wedges_run_in_a_curve() {
    let own = case(
        "simulation.duration = \"6 s\"\nspeed.value = \"25 mph\"\ntruck.wedge.kind = \"massless\"\n\
         truck.warp_spring.kind = \"new\"\n[[track.segments]]\ntangent = \"100 ft\"\n\
         [[track.segments]]\nspiral = \"60 ft\"\n[[track.segments]]\ncurve = \"300 ft\"\n\
         degree = \"7.5 deg\"\nsuperelevation = \"3 in\"\n",
    );
    let summary = run(&own).summary;
    assert!(
        summary.complete && summary.failed.is_none(),
        "{:?}",
        summary.stopped
    );
    assert!(summary.warnings.is_empty(), "{:?}", summary.warnings);
    let reported = summary
        .assumptions
        .iter()
        .any(|line| line.contains("8 of 8 wedges have no mass"));
    assert!(reported, "{:?}", summary.assumptions);
}

/// A car that comes nearly to rest starts there, with a warning that says so.
#[test]
fn issue_048_a_start_that_is_nearly_at_rest_is_a_warning() {
    let lading = "lading.kind = \"masses\"\nlading.masses = [{ weight = \"200 kip\", place = [\"280 in\", \
                  \"20 in\", \"150 in\"], \
                  inertia = [\"1e6 lbf in s^2\", \"1e6 lbf in s^2\", \"1e6 lbf in s^2\"] }]\n\
                  simulation.duration = \"0.02 s\"";
    let summary = run(&case(lading)).summary;
    let warnings = summary.warnings.join("\n");
    assert!(warnings.contains("the start is nearly at rest"), "{warnings}");
    let usual = run(&case("simulation.duration = \"0.02 s\"")).summary;
    assert!(
        !usual.warnings.join("\n").contains("nearly at rest"),
        "{:?}",
        usual.warnings
    );
}

/// The height of the accelerometers is a key; left out, no number changes.
#[test]
fn issue_048_the_height_of_the_accelerometers_is_a_key() {
    let values = |line: &str| {
        let result = run(&case(&format!(
            "{line}
simulation.duration = \"0.3 s\"
{JOINT}"
        )));
        let column = result.column("body_at_truck_1_lateral_acceleration").unwrap();
        (column.to_vec(), result.columns)
    };
    let (usual, columns) = values("");
    assert_eq!(usual, values("car.accelerometer_height = \"30 in\"").0);
    assert_ne!(usual, values("car.accelerometer_height = \"80 in\"").0);
    let own = columns
        .iter()
        .find(|own| own.name == "body_at_truck_1_lateral_acceleration")
        .unwrap();
    for part in [
        "car.accelerometer_height",
        "30 in above the rails",
        "gravity's part by roll and superelevation",
    ] {
        assert!(own.text.contains(part), "{}", own.text);
    }
}

/// Side bearings with hysteresis have columns of their force and of its part; without it there are none, and
/// 0 lbf is without.
#[test]
fn input_hysteresis_of_side_bearings_has_columns() {
    let columns = |lines: &str| -> Vec<String> {
        let case = case(&format!("lading.kind = \"empty\"\n{lines}"));
        let table = CarTable::new(&case.parameters).unwrap();
        let names = table.columns().iter().map(|own| own.name.clone());
        names.filter(|name| name.contains("side_bearing")).collect()
    };
    let none = columns("truck.side_bearing.hysteresis = \"0 lbf\"");
    assert!(columns("").is_empty() && none.is_empty(), "{none:?}");
    let some = columns("truck.side_bearing.hysteresis = \"600 lbf\"");
    let expected = [1, 2].map(|truck| {
        ["left", "right"].map(|side| {
            ["force", "hysteresis"].map(|what| format!("truck_{truck}_{side}_side_bearing_{what}"))
        })
    });
    assert_eq!(some, expected.as_flattened().as_flattened());
}

/// A body that twists has a column of its twist, a rigid one none.
#[test]
fn input_a_body_that_twists_has_a_column() {
    let has = |lines: &str| {
        let table = CarTable::new(&case(lines).parameters).unwrap();
        table.columns().iter().any(|own| own.name == "body_twist")
    };
    assert!(!has("") && has("car.torsion_stiffness = \"1e8 lbf in\""));
}
