//! Vehicles on a track behind the variables: the columns of their runs, rails that inputs move, loads and
//! their axes, derailments, files.

use std::path::Path;

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::source::Source;
use fmi::{Category, resources};
use study::models::built_in;
use study::run::Run;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;

use crate::part::Part;

const INTERVAL: f64 = 0.005;
/// Columns of a run that are another ledger in an FMU, which counts the work of its inputs too.
const LEDGER: [&str; 4] = ["work", "losses", "stored_energy_change", "energy_residual"];

fn case(name: &str, set: &[&str]) -> VehicleCase {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    VehicleCase::parse("case.toml", built_in(name).unwrap().text(), Path::new(""), &set)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn run(case: &VehicleCase) -> VehicleResult {
    Run::new(case).unwrap().finish(|_| ())
}

fn part(case: VehicleCase, version: Version, interface: Interface) -> Part {
    Part::new(Source::Vehicle(Box::new(case)), version, interface, INTERVAL)
}

/// Returns the largest difference of an output from the run's column of that name, over the column's span,
/// with the name.
fn compare(part: &mut Part, result: &VehicleResult) -> (f64, String) {
    let columns: Vec<&str> = result.columns.iter().map(|own| own.name.as_str()).collect();
    let names: Vec<&str> = columns
        .into_iter()
        .filter(|name| *name != "time" && !LEDGER.contains(name))
        .collect();
    let mut worst = vec![0.0_f64; names.len()];
    for row in 0..result.rows() {
        if row > 0 {
            part.step();
        }
        for (name, worst) in names.iter().zip(&mut worst) {
            *worst = worst.max((part.get(name) - result.column(name).unwrap()[row]).abs());
        }
    }
    let relative = names.iter().zip(worst).map(|(name, worst)| {
        let column = result.column(name).unwrap();
        let size = column.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        (worst / size.max(f64::MIN_POSITIVE), (*name).to_owned())
    });
    relative.max_by(|(a, _), (b, _)| a.total_cmp(b)).unwrap()
}

/// With inputs left alone the FMU does what the run does, in all columns, under a load of the case that
/// begins on the way.
#[test]
fn cross_code_a_wagon_gives_the_columns_of_its_run() {
    let set = [
        "simulation.duration=0.4 s",
        "simulation.relative_tolerance=1e-6",
        "output.filtered_columns=false",
        "bodies.body.load.lateral={shape=\"ramp\",amplitude=\"500 lbf\",start=\"0.1 s\",duration=\"0.1 s\"}",
    ];
    let own = case("vehicle_two_axles", &set);
    let result = run(&own);
    assert!(result.summary.complete);
    for version in [Version::Two, Version::Three] {
        let mut part = part(own.clone(), version, Interface::CoSimulation);
        part.begin();
        let (worst, name) = compare(&mut part, &result);
        assert!(worst < 1e-5, "{name}: {worst:e}");
        let relative = part.get("ledger_relative_residual");
        let wanted = result.summary.ledger.largest_relative_residual;
        assert!(relative.abs() < 2.0 * wanted, "{relative} {wanted}");
    }
}

/// The same of two trucks under a body, with wedges with mass and without.
#[test]
fn cross_code_trucks_give_the_columns_of_their_run() {
    for wedges in [&[][..], &["trucks.front.wedge.kind=\"massless\""]] {
        // It comes onto a dip of the left rail.
        let mut set = vec![
            "simulation.duration=0.1 s",
            "simulation.relative_tolerance=1e-7",
            "output.filtered_columns=false",
            "start.distance=75 ft",
        ];
        set.extend(wedges);
        let own = case("vehicle_car_empty", &set);
        let result = run(&own);
        let mut part = part(own, Version::Three, Interface::CoSimulation);
        part.begin();
        let (worst, name) = compare(&mut part, &result);
        assert!(worst < 1e-5, "{name}: {worst:e}");
    }
}

/// On rails that do not give way, a wheel over a dip has the forces of a wheel whose rail is moved by the
/// dip's depth at its place; but for the slope, along which a wheel's normal force pushes a little backward.
#[test]
fn cross_code_moved_rails_do_what_the_same_irregularity_does() {
    let (depth, from, length) = (0.1 * 0.0254, 8.0, 3.0);
    let dipped = format!(
        "track.irregularities=[{{shape=\"dip\",rails=\"both\",direction=\"vertical\",depth=\"{depth} m\",\
         length=\"{length} m\",start=\"{from} m\"}}]"
    );
    let common = [
        "simulation.duration=0.2 s",
        "simulation.output_interval=0.001 s",
        "simulation.relative_tolerance=1e-6",
        "track.support.kind=\"rigid\"",
    ];
    let with = |track: &str| case("vehicle_two_axles", &[&common[..], &[track]].concat());
    let result = run(&with(&dipped));
    let own = with("track.irregularities=[]");
    let speed = own.description.on_track.as_ref().unwrap().speed;
    let source = Source::Vehicle(Box::new(own));
    let mut part = Part::new(source, Version::Three, Interface::CoSimulation, 0.001);
    let reference = part.reference("inputs_at_end");
    part.instance.set_boolean(reference, true).unwrap();
    part.begin();
    // A dip is a haversine.
    let at = |distance: f64| -> [f64; 2] {
        let share = (distance - from) / length;
        if !(0.0..1.0).contains(&share) {
            return [0.0; 2];
        }
        let (sine, cosine) = (std::f64::consts::TAU * share).sin_cos();
        let slope = -0.5 * depth * std::f64::consts::TAU / length * sine;
        [-0.5 * depth * (1.0 - cosine), slope * speed]
    };
    let name = "leading_left_vertical_force";
    let wanted = result.column(name).unwrap();
    let starts = ["leading", "trailing"].map(|axle| {
        let start = part.get(&format!("{axle}_distance"));
        (axle, start)
    });
    let mut found = vec![part.get(name)];
    for row in 1..result.rows() {
        let way = speed * row as f64 * part.interval;
        for (axle, start) in starts {
            for side in ["left", "right"] {
                let [height, rate] = at(start + way);
                let stem = format!("{axle}_{side}_rail_bed_z_motion");
                part.set(&stem, height);
                part.set(&format!("{stem}_rate"), rate);
            }
        }
        part.step();
        found.push(part.get(name));
    }
    // The dip begins with a jump of the acceleration, which the cubics of inputs do not have: the wheelset
    // vibrates on its contacts for 30 ms.
    let jump = ((from - starts[0].1) / speed / part.interval) as usize;
    let (mut worst, mut span) = (0.0_f64, 0.0_f64);
    for (row, (wanted_here, found)) in wanted.iter().zip(&found).enumerate() {
        if !(jump..jump + 30).contains(&row) {
            worst = worst.max((wanted_here - found).abs());
            span = span.max((wanted_here - wanted[0]).abs());
        }
    }
    assert!(span > 1.5e3 && worst < 0.015 * span, "{worst} N of {span} N");
    let (work, relative) = (part.get("motion_work"), part.get("ledger_relative_residual"));
    assert!(work.abs() > 1.0 && relative.abs() < 1e-2, "{work} J, {relative}");
}

/// A load on a body accelerates it along and about the axis of its name: F/m and M/I.
#[test]
fn analytic_loads_act_along_the_fixed_axes() {
    let own = case("vehicle_two_axles", &["track.irregularities=[]"]);
    let body = own.description.bodies[0].clone();
    let [x, y, z] = body.inertia;
    let mut part = part(own, Version::Three, Interface::ModelExchange);
    part.begin();
    part.instance.enter_continuous_time_mode().unwrap();
    for (input, state, wanted) in [
        ("force_on_body_x", "body_fixed_x_rate", 1.0 / body.mass),
        ("force_on_body_y", "body_fixed_minus_y_rate", -1.0 / body.mass),
        ("force_on_body_z", "body_fixed_z_rate", 1.0 / body.mass),
        ("moment_on_body_roll", "body_fixed_roll_rate", 1.0 / x),
        ("moment_on_body_pitch", "body_fixed_minus_pitch_rate", -1.0 / y),
        ("moment_on_body_yaw", "body_fixed_yaw_rate", 1.0 / z),
    ] {
        let rate = format!("der({state})");
        let before = part.get(&rate);
        part.set(input, 1e5);
        let change = part.get(&rate) - before;
        part.set(input, 0.0);
        assert!((change / (1e5 * wanted) - 1.0).abs() < 1e-3, "{input}: {change}");
    }
}

/// A wheel that leaves its rail is told in the words of the run.
#[test]
fn limits_a_wagon_that_derails_is_warned_of_in_the_words_of_its_run() {
    let push = "bodies.body.load.lateral=\"90000 lbf\"";
    let track = [
        "track.irregularities=[]",
        "start.kind=\"nominal\"",
        "simulation.duration=3 s",
    ];
    let own = case("vehicle_two_axles", &[&track[..], &[push]].concat());
    let told = run(&own).summary.derailed.unwrap();
    let mut part = part(own, Version::Three, Interface::CoSimulation);
    part.begin();
    let warning = loop {
        assert!(part.instance.time() < told.time + INTERVAL, "nothing is told");
        part.step();
        let log = part.instance.take_log();
        let mut log = log.into_iter().filter(|own| own.category == Category::Warning);
        if let Some(own) = log.find(|own| own.text.starts_with("derailed: ")) {
            break own.text;
        }
    };
    assert!(
        warning.starts_with(&format!("derailed: {}", told.what)),
        "{warning} {}",
        told.what
    );
}

/// All variables have values in model exchange; a load of the case that bends on the way is a time event
/// though inputs move the rails.
#[test]
fn limits_every_variable_has_a_value_in_model_exchange() {
    let push =
        "bodies.body.load.lateral={shape=\"ramp\",amplitude=\"500 lbf\",start=\"0.1 s\",duration=\"0.1 s\"}";
    let mut part = part(
        case("vehicle_two_axles", &[push]),
        Version::Two,
        Interface::ModelExchange,
    );
    part.begin();
    let entries = part.description.entries.clone();
    for list in [&entries.states, &entries.outputs, &entries.columns] {
        assert!(!list.is_empty());
        for entry in list {
            let value = part.get(&entry.name);
            assert!(value.is_finite(), "{}: {value}", entry.name);
        }
    }
    let next = part.instance.update_discrete_states().unwrap().next_time;
    assert_eq!(next, Some(0.1));
    // Six loads on the body; rails under four wheels, each along three axes with rates.
    assert_eq!(entries.inputs.len(), 6 + 4 * 3 * 2);
}

/// Profiles, a list of sections and measured track go into the resources; what is made of these in another
/// folder has the same token and start.
#[test]
fn input_an_fmu_takes_the_files_of_a_vehicle_along() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "My worn wheel.PRW",
        include_str!("../../../wheelrail/tests/data/worn/worn_high_mileage.prw"),
    );
    let rail = include_str!("../../../wheelrail/tests/data/manchester/MBench_UIC60_v3.prr");
    std::fs::create_dir(folder.path().join("rails")).unwrap();
    write("rails/new.prr", rail);
    write("rails/old.prr", rail);
    write(
        "rails/line.slcs",
        "0 1000\n2\n0 0\n1\n0 'new.prr'\n 20.0 'old.prr'\n",
    );
    let rows: String = (0..600)
        .map(|at| format!("{at},{}\n", 0.05 * f64::from(at % 7)))
        .collect();
    write("measured.csv", &format!("distance_ft,profile_in\n{rows}"));
    let set = [
        "wheels.profile=\"My worn wheel.PRW\"",
        "wheels.datum=\"flange_back\"",
        "wheels.tape_from_back=\"3.0625 in\"",
        "rails.profile=\"rails/line.slcs\"",
        "rails.slices_from=\"30 m\"",
        "track.segments=[{tangent=\"500 ft\"}]",
        "track.irregularities=[{table=\"measured.csv\",signs=\"usual\",form=\"space_curve\"}]",
    ]
    .map(str::to_owned);
    let text = built_in("vehicle_two_axles").unwrap().text();
    let own = VehicleCase::parse("case.toml", text, folder.path(), &set);
    let own = own.unwrap_or_else(|error| panic!("{error}"));
    let made = part(own, Version::Three, Interface::CoSimulation);
    let description = made.description;
    let names: Vec<&str> = description.files.iter().map(|(name, _)| name.as_str()).collect();
    let wanted = [
        "case.toml",
        "files/1_table.csv",
        "files/2_rails_profile.slcs",
        "files/3_rails_section.prr",
        "files/4_rails_section.prr",
        "files/5_wheels_profile.prw",
    ];
    assert_eq!(names, wanted);

    let other = tempfile::tempdir().unwrap();
    std::fs::create_dir(other.path().join("files")).unwrap();
    for (name, bytes) in &description.files {
        std::fs::write(other.path().join(name), bytes).unwrap();
    }
    std::fs::write(other.path().join("model.txt"), description.model.name()).unwrap();
    drop(folder);
    let again = Description::new(&resources::read(other.path()).unwrap()).unwrap();
    assert_eq!(again.files, description.files);
    for version in [Version::Two, Version::Three] {
        let token = description.token(version);
        assert_eq!(again.token(version), token);
        let interface = Interface::CoSimulation;
        let instance = Instance::new("other", &token, other.path(), version, interface);
        let mut part = Part {
            instance: instance.unwrap(),
            description: again.clone(),
            interval: INTERVAL,
        };
        part.begin();
        let force = part.get("leading_left_vertical_force");
        assert!(force > 5e4 && force < 9e4, "{force}");
    }
}
