//! The freight car behind the variables: the columns of its run, rails that inputs move, loads, saved states,
//! what is refused.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::source::Source;
use study::car::CarCase;
use study::car::columns::CarTable;
use study::car::run::CarResult;
use study::case::Tables;
use study::run::Run;

use crate::part::Part;

const INTERVAL: f64 = 0.005;

fn case(lines: &str) -> CarCase {
    let text = format!("model = \"car\"\nstart.settle = \"0 s\"\n{lines}");
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

fn run(case: &CarCase) -> CarResult {
    Run::new(case).unwrap().finish(|_| ())
}

fn part(case: CarCase, interface: Interface) -> Part {
    let source = Source::Car(Box::new(case));
    Part::new(source, Version::Three, interface, INTERVAL)
}

const TRACK: &str = "simulation.duration = \"0.2 s\"\nspeed.value = \"40 mph\"\n[[track.segments]]\n\
                     tangent = \"500 ft\"\n";
/// Under the leading wheels, which start 53 ft from the beginning of the track.
const DIP: &str = "[[track.irregularities]]\nshape = \"dip\"\nrails = \"both\"\ndirection = \"vertical\"\n\
                   depth = \"0.1 in\"\nlength = \"10 ft\"\nstart = \"54 ft\"\n";

/// With inputs left alone the FMU does what the run does: it starts moving, and is integrated by the method
/// of its case. Steps end at communication points too, so that not all bits are the same.
fn gives_the_columns_of_its_run(lines: &str, more: &[&str]) {
    let own = case(lines);
    let result = run(&own);
    let mut part = part(own, Interface::CoSimulation);
    part.begin();
    let names = [
        "distance",
        "speed",
        "axle_1_left_vertical",
        "axle_1_right_lateral",
        "body_at_truck_1_vertical_acceleration",
        "truck_1_left_nest_vertical_force",
        "truck_1_leading_left_column_normal",
        "truck_2_trailing_right_slope_normal",
    ];
    let names = [&names[..], more].concat();
    let mut worst = vec![0.0_f64; names.len()];
    for row in 0..result.rows() {
        if row > 0 {
            part.step();
        }
        for (name, worst) in names.iter().zip(&mut worst) {
            *worst = worst.max((part.get(name) - result.column(name).unwrap()[row]).abs());
        }
    }
    for (name, worst) in names.iter().zip(worst) {
        let column = result.column(name).unwrap();
        let size = column.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        assert!(size > 0.0 && worst < 1e-5 * size, "{name}: {worst:e} of {size:e}");
    }
    // Its ledger closes as that of the run.
    let relative = part.get("ledger_relative_residual");
    let wanted = result.summary.ledger.largest_relative_residual;
    assert!(relative.abs() < 2.0 * wanted, "{relative} {wanted}");
}

#[test]
fn cross_code_a_car_gives_the_columns_of_its_run() {
    gives_the_columns_of_its_run(
        &format!("simulation.relative_tolerance = 1e-5\n{TRACK}{DIP}"),
        &[],
    );
}

/// The same with hysteresis in the side bearings, whose sliders are connections with states.
#[test]
fn cross_code_side_bearings_with_hysteresis() {
    let bearing = "truck.side_bearing = { kind = \"constant_contact\", hysteresis = \"600 lbf\" }\n";
    let lines = format!("simulation.relative_tolerance = 1e-6\n{bearing}{TRACK}{DIP}");
    gives_the_columns_of_its_run(&lines, &["truck_1_left_side_bearing_hysteresis"]);
}

/// On rails that do not give way, a wheel over a dip has the forces of a wheel whose rail is moved by the
/// dip's depth at its place; but for the slope, along which a wheel's normal force pushes a little backward.
#[test]
fn cross_code_moved_rails_do_what_the_same_irregularity_does() {
    let rigid = |more: &str| case(&format!("track.support.kind = \"rigid\"\n{TRACK}{more}"));
    let dipped = rigid(DIP);
    let result = run(&dipped);
    let lines = CarTable::new(&dipped.parameters).unwrap().car().lines.clone();
    let mut part = part(rigid(""), Interface::CoSimulation);
    let reference = part.reference("inputs_at_end");
    part.instance.set_boolean(reference, true).unwrap();
    part.begin();
    let axles: Vec<f64> = {
        let own = &dipped.parameters;
        let (half, axle) = (0.5 * own.truck_distance, own.trucks[0].geometry.axle());
        [half + axle, half - axle, -half + axle, -half - axle]
            .map(|x| own.start.distance + x)
            .to_vec()
    };
    let speed = dipped.speed();
    let name = "axle_1_left_vertical";
    let wanted = result.column(name).unwrap();
    let mut found = vec![part.get(name)];
    for row in 1..result.rows() {
        let time = row as f64 * INTERVAL;
        for (number, start) in (1..).zip(&axles) {
            for (side, word) in ["left", "right"].into_iter().enumerate() {
                let at = |time: f64| lines.irregularities(start + speed * time)[side][1];
                let stem = format!("rail_bed_{number}_{word}_z_motion");
                part.set(&stem, at(time));
                part.set(
                    &format!("{stem}_rate"),
                    (at(time + 1e-6) - at(time - 1e-6)) / 2e-6,
                );
            }
        }
        part.step();
        found.push(part.get(name));
    }
    let span = wanted
        .iter()
        .fold(0.0, |most: f64, value| most.max((value - wanted[0]).abs()));
    let worst = wanted
        .iter()
        .zip(&found)
        .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    assert!(span > 5e3 && worst < 0.01 * span, "{worst} N of {span} N");
    let (work, relative) = (part.get("motion_work"), part.get("ledger_relative_residual"));
    assert!(work.abs() > 1.0 && relative.abs() < 1e-2, "{work} J, {relative}");
}

/// A saved car goes on with the same bits, and a load on the body does its work.
#[test]
fn reproducible_a_saved_car_goes_on_with_the_same_bits() {
    let mut part = part(case(&format!("{TRACK}{DIP}")), Interface::CoSimulation);
    part.set("force_on_car_body_y", 20e3);
    part.begin();
    for _ in 0..8 {
        part.step();
    }
    let saved = part.instance.save();
    let on = |part: &mut Part| {
        for _ in 0..4 {
            part.step();
        }
        [
            "axle_1_left_vertical",
            "truck_1_leading_left_column_normal",
            "load_work",
        ]
        .map(|name| part.get(name).to_bits())
    };
    let first = on(&mut part);
    part.instance.restore(&saved).unwrap();
    assert_eq!(on(&mut part), first);
    // To the left, and up by the spirals of no curve: the body's place to the left is minus its third
    // coordinate.
    let (work, way) = (part.get("load_work"), -part.get("car_body_minus_y"));
    assert!(
        work > 0.0 && (work - 20e3 * way).abs() < 1e-6 * work,
        "{work} J along {way} m"
    );
}

/// Two cars that coast, and a program of a train: a locomotive pulls the first one, and a spring with a
/// damper between the pivots of both is the draft gear. It comes to carry what accelerates the second
/// car, half of the pull, and both gain the speed that the pull gives their masses.
#[test]
fn analytic_a_train_program_drives_the_couplers() {
    const PULL: f64 = 60e3;
    let car = |start: &str| {
        case(&format!(
            "lading.kind = \"empty\"\nspeed.kind = \"coasting\"\nspeed.value = \"20 mph\"\n\
             start.distance = \"{start}\"\nsimulation.duration = \"3 s\"\n[[track.segments]]\n\
             tangent = \"500 ft\"\n"
        ))
    };
    let own = car("100 ft").parameters;
    // Wheelsets turn as they gain speed.
    let turning = own.wheelset.about_axle / own.wheel_radius().powi(2);
    let mass = own.weight() / 9.80665 + 4.0 * turning;
    let mut cars = ["153.0833333 ft", "100 ft"].map(|start| part(car(start), Interface::CoSimulation));
    for own in &mut cars {
        own.begin();
    }
    let [first, second] = &mut cars;
    let both = 2.0 * 29.25 * 0.0254;
    let before = first.get("coupler_leading_speed");
    let (mut force, mut late) = (0.0, Vec::new());
    for step in 0..500 {
        let gap = first.get("coupler_trailing_distance") - second.get("coupler_leading_distance") - both;
        let parting = first.get("coupler_trailing_speed") - second.get("coupler_leading_speed");
        force = -(4e6 * gap + 2e5 * parting);
        first.set("force_of_coupler_leading", -PULL);
        first.set("force_of_coupler_trailing", force);
        second.set("force_of_coupler_leading", force);
        first.step();
        second.step();
        if step >= 300 {
            late.push(force);
        }
    }
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    assert!((mean / (-0.5 * PULL) - 1.0).abs() < 0.03, "{mean} N");
    assert!((second.get("coupler_leading_force") - force).abs() < 1e-6 * PULL);
    let time = 500.0 * INTERVAL;
    for own in [first, second] {
        let gained = own.get("coupler_leading_speed") - before;
        let wanted = PULL / (2.0 * mass) * time;
        assert!((gained / wanted - 1.0).abs() < 0.01, "{gained} m/s, {wanted} m/s");
        let relative = own.get("ledger_relative_residual");
        assert!(relative.abs() < 1e-2, "{relative}");
    }
}

/// A lateral force at the pivot pushes the car body to the left, wherever its coupler points.
#[test]
fn limits_lateral_forces_of_couplers_push_to_the_left() {
    let mut own = part(case(TRACK), Interface::CoSimulation);
    own.set("lateral_force_of_coupler_trailing", 5e3);
    own.begin();
    for _ in 0..20 {
        own.step();
    }
    assert!((own.get("coupler_trailing_lateral_force") - 5e3).abs() < 1.0);
    assert!(own.get("coupler_trailing_force").abs() < 50.0);
    // To the left, and the rear end first: its yaw is to the right.
    assert!(own.get("car_body_minus_y") < 0.0);
    assert!(own.get("coupler_trailing_angle").abs() < 0.01);
}

#[test]
fn limits_every_variable_has_a_value_in_model_exchange() {
    let mut part = part(case(TRACK), Interface::ModelExchange);
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
    // It rolls along the track, which begins along x: forward at its speed, and wheels turn.
    let speed = 40.0 * 0.44704;
    for (name, wanted) in [
        ("car_body_x_rate", speed),
        ("wheelset_1_x_rate", speed),
        ("wheelset_1_pitch_rate", speed / 0.4572),
    ] {
        let found = part.get(name);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{name}: {found}");
    }
    // Rails under eight wheels, each along three axes with rates, the load, and two forces of each coupler.
    assert_eq!(entries.inputs.len(), 8 * 3 * 2 + 3 + 4);
}

#[test]
fn input_what_an_fmu_cannot_take_is_refused() {
    let massless = case(&format!("truck.wedge.kind = \"massless\"\n{TRACK}"));
    let error = Description::new(&Source::Car(Box::new(massless))).unwrap_err();
    assert!(error.to_string().contains("take wedge bodies"), "{error}");
    let twisting = case(&format!("car.torsion_stiffness = \"1e8 lbf in\"\n{TRACK}"));
    let error = Description::new(&Source::Car(Box::new(twisting))).unwrap_err();
    assert!(error.to_string().contains("car.torsion_stiffness out"), "{error}");
}

/// Profiles and measured tables go into the resources, and what is made of these has the same token and
/// start.
#[test]
fn issue_048_an_fmu_takes_profiles_and_measured_track_along() {
    let folder = tempfile::tempdir().unwrap();
    let beside = folder.path().join("tracks");
    std::fs::create_dir(&beside).unwrap();
    let wheel = include_str!("../../../wheelrail/tests/data/manchester/MBench_S1002_v3.prw");
    std::fs::write(folder.path().join("My wheel.PRW"), wheel).unwrap();
    let rows: String = (0..600)
        .map(|at| format!("{at},{}\n", 0.05 * f64::from(at % 7)))
        .collect();
    std::fs::write(beside.join("car.csv"), format!("distance_ft,profile_in\n{rows}")).unwrap();
    let track = "segments = [{ tangent = \"500 ft\" }]\n[[irregularities]]\ntable = \"car.csv\"\nsigns = \
                 \"usual\"\nform = \"space_curve\"\n";
    std::fs::write(beside.join("line.toml"), track).unwrap();
    let text = "model = \"car\"\nwheels.profile = \"My wheel.PRW\"\ntrack.file = \
                \"tracks/line.toml\"\nsimulation.duration = \"5 s\"\n";
    let own = CarCase::parse("case.toml", text, folder.path(), &[]).unwrap();
    let description = Description::new(&Source::Car(Box::new(own))).unwrap();
    let names: Vec<&str> = description.files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        ["case.toml", "files/1_table.csv", "files/2_wheels_profile.prw"]
    );

    let resources = tempfile::tempdir().unwrap();
    std::fs::create_dir(resources.path().join("files")).unwrap();
    for (name, bytes) in &description.files {
        std::fs::write(resources.path().join(name), bytes).unwrap();
    }
    std::fs::write(resources.path().join("model.txt"), description.model.name()).unwrap();
    drop(folder);
    let unpacked = fmi::resources::read(resources.path()).unwrap();
    let again = Description::new(&unpacked).unwrap();
    assert_eq!(
        String::from_utf8_lossy(&again.files[0].1),
        String::from_utf8_lossy(&description.files[0].1)
    );
    for version in [Version::Two, Version::Three] {
        assert_eq!(again.token(version), description.token(version));
    }
    assert_eq!(again.files, description.files);
}
