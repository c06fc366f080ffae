//! Statistics, limits and assessments of vehicles on a track.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use study::assessment::{Assessment, Request};
use study::car::CarCase;
use study::car::stability::stability;
use study::models::{AnyCase, StudyCase, built_in};
use study::run::Run;
use study::vehicle::VehicleCase;
use study::vehicle::run::VehicleResult;
use study::vehicle::stability::over_speed;

use crate::vehicle::written_out;

const FOOT: f64 = 0.3048;

fn case(text: &str, set: &[&str]) -> VehicleCase {
    let set: Vec<String> = set.iter().map(|own| (*own).to_owned()).collect();
    VehicleCase::parse("own.toml", text, Path::new(""), &set)
        .unwrap_or_else(|error| panic!("{:?}", miette::Report::new(error)))
}

fn run(case: &VehicleCase) -> VehicleResult {
    Run::new(case).unwrap().finish(|_| ())
}

/// Every statistic of the built-in car, whose parts have names of their own in the vehicle that is the same
/// car. Static loads of the car are those of a balance, of the vehicle those of its rest: wheels at rest are
/// up to 0.01 % from the balance.
#[test]
fn cross_code_statistics_of_a_car_written_out_are_those_of_the_car() {
    let set = [
        "track.segments=[{tangent=\"400 ft\"}]",
        "track.irregularities=[{shape=\"dip\",start=\"60 ft\",length=\"20 ft\",depth=\"0.6 \
         in\",rails=\"left\",direction=\"vertical\"}]",
        "simulation.duration=2 s",
        "start.settle=0.2 s",
        "simulation.output_units=\"si\"",
    ]
    .map(str::to_owned);
    let text = built_in("car_tangent_empty").unwrap().text();
    let car = CarCase::parse("car.toml", text, Path::new(""), &set)
        .unwrap_or_else(|error| panic!("{:?}", miette::Report::new(error)));
    let own = case(&written_out(car.to_toml()), &["start.settle=0.2 s"]);
    let (built_in, own) = (Run::new(&car).unwrap().finish(|_| ()), run(&own));
    let named = |name: &str| {
        [
            ("axle_1", "front_wheelset_1"),
            ("axle_2", "front_wheelset_2"),
            ("axle_3", "rear_wheelset_1"),
            ("axle_4", "rear_wheelset_2"),
            ("body_at_truck_1", "car_body_at_front"),
            ("body_at_truck_2", "car_body_at_rear"),
            ("truck_1", "front"),
            ("truck_2", "rear"),
            ("body", "car_body"),
        ]
        .into_iter()
        .find_map(|(of_car, own)| Some(format!("{own}{}", name.strip_prefix(of_car)?)))
        .unwrap_or_else(|| panic!("{name}"))
    };
    let statistics = &own.summary.statistics;
    assert_eq!(statistics.len(), built_in.summary.statistics.len());
    for (name, theirs) in &built_in.summary.statistics {
        let ours = &statistics[&named(name)];
        assert_eq!(ours.of, theirs.of, "{name}");
        assert_eq!(ours.remark, theirs.remark, "{name}");
        // Of static loads; elsewhere by the rounding of rows alone.
        let of_loads = name.contains("_load") || name.contains("net_l_over_v");
        let within = if of_loads { 2e-4 } else { 1e-6 };
        for (a, b) in [(&theirs.raw, &ours.raw), (&theirs.filtered, &ours.filtered)] {
            let (Some(a), Some(b)) = (a, b) else {
                assert!(a.is_none() && b.is_none(), "{name}");
                continue;
            };
            let scale = a.value.abs().max(1e-3);
            assert!(
                (a.value - b.value).abs() <= within * scale,
                "{name}: {} {}",
                a.value,
                b.value
            );
            assert_eq!(a.unit, b.unit, "{name}");
        }
    }
    for (name, load) in &built_in.summary.static_loads {
        let ours = &own.summary.static_loads[&named(name)];
        assert!(
            (ours.value / load.value - 1.0).abs() < 1e-4,
            "{name}: {} {}",
            ours.value,
            load.value
        );
    }
    let columns = |of: &[mechanics::output::Column]| {
        let own = of.iter().filter(|own| own.name.ends_with("_filtered"));
        own.count()
    };
    assert_eq!(columns(&own.columns), columns(&built_in.columns));
    assert_eq!(own.summary.limits.len(), built_in.summary.limits.len());
    for (ours, theirs) in own.summary.limits.iter().zip(&built_in.summary.limits) {
        assert_eq!(ours.name, theirs.name);
        assert!((ours.margin - theirs.margin).abs() < 2e-4, "{}", ours.name);
        assert!(
            ours.statistic.starts_with(&named(&theirs.statistic)[..4]),
            "{}",
            ours.statistic
        );
    }
    let at = own
        .summary
        .limits
        .iter()
        .find(|own| own.name.contains("wheel_l_over_v"));
    let at = at.map_or_else(|| own.summary.limits[0].worst_at(), |own| own.worst_at());
    assert!(at.contains("wheelset"), "{at}");
}

/// A wagon on two axles that are one truck for its sides, with an accelerometer over each axle, and one that
/// counts as that of a truck's frame.
fn wagon(more: &str) -> String {
    let text = built_in("vehicle_two_axles").unwrap().text();
    let text = text
        .replace(
            "[wheelsets.leading]",
            "[wheelsets.leading]\ntruck = \"running_gear\"",
        )
        .replace(
            "[wheelsets.trailing]",
            "[wheelsets.trailing]\ntruck = \"running_gear\"",
        );
    let frame =
        "[accelerometers.frame]\non = \"body\"\nat = [\"0 in\", \"0 in\", \"40 in\"]\nof = \"truck\"\n";
    format!("{text}\n{frame}{more}")
}

/// What a user's accelerometers show is the acceleration of the body there: that of its center with its turn,
/// from the columns of the body. Sides of a truck are those of the wheelsets that name it.
#[test]
fn analytic_accelerometers_and_sides_of_ones_own() {
    let set = [
        "simulation.duration=3 s",
        "simulation.output_units=\"si\"",
        "start.settle=1 s",
    ];
    let result = run(&case(&wagon(""), &set));
    let column = |name: &str| result.column(name).unwrap_or_else(|| panic!("{name}")).to_vec();
    let statistics = &result.summary.statistics;
    for name in [
        "over_leading_lateral_acceleration_rms",
        "over_trailing_vertical_acceleration_range",
        "frame_lateral_acceleration_rmst",
        "running_gear_left_side_l_over_v",
        "running_gear_right_least_side_load",
        "leading_left_nadal_share_time",
        "trailing_net_l_over_v",
        "body_roll_peak_to_peak",
    ] {
        assert!(statistics.contains_key(name), "{name}");
    }
    // Both vertical accelerations differ by that of pitch; their mean is that of the center (its speed is
    // steady and small angles leave 1e-3 of g).
    let [front, rear] =
        ["over_leading", "over_trailing"].map(|own| column(&format!("{own}_vertical_acceleration")));
    let center = column("body_z_acceleration");
    let most = center.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    for row in 0..center.len() {
        let mean = 0.5 * (front[row] + rear[row]);
        assert!(
            (mean - center[row]).abs() < 0.01 * most,
            "{row}: {mean} {}",
            center[row]
        );
    }
    assert!(most > 0.05, "{most}");
    // A side's L/V is no larger than the larger of its wheels'.
    let value = |name: &str| statistics[name].raw.as_ref().unwrap().value;
    let wheels = ["leading", "trailing"].map(|own| {
        let ratios = column(&format!("{own}_left_l_over_v"));
        ratios.into_iter().fold(f64::NEG_INFINITY, f64::max)
    });
    let side = value("running_gear_left_side_l_over_v");
    assert!(
        side > 0.0 && side <= wheels[0].max(wheels[1]),
        "{side} {wheels:?}"
    );
    let place = &statistics["running_gear_left_side_l_over_v"].place;
    assert_eq!(place, "running gear, left side");
    assert_eq!(statistics["frame_lateral_acceleration_rms"].place, "frame");
}

/// A study keeps the measures of limits of a vehicle on a track, and figures of its wheels.
#[test]
fn analytic_a_vehicle_has_the_measures_of_limits() {
    let case = case(&wagon(""), &["simulation.duration=2.5 s"]);
    let (judged, definitions) = (case.judge().unwrap(), case.definitions());
    let value = |name: &str| {
        definitions
            .get(&judged.measures, name)
            .unwrap_or_else(|| panic!("{name}"))
    };
    for name in [
        "l_over_v_time",
        "wheel_lift",
        "body_roll_peak_to_peak",
        "truck_lateral_acceleration_rms",
    ] {
        assert!(value(name).is_finite(), "{name}");
    }
    let weight = (60_000.0 + 2.0 * 3135.0) * 4.448_221_615_260_5;
    for name in ["least_static_axle_load", "greatest_static_axle_load"] {
        assert!(
            (value(name) / (0.5 * weight) - 1.0).abs() < 0.02,
            "{name}: {}",
            value(name)
        );
    }
    assert!((value("least_flange_angle").to_degrees() - 75.0).abs() < 1e-6);
    assert_eq!(value("derailed"), 0.0);
}

/// A regime for cars of either lading that sets nothing of a car alone.
fn request(car: &str, set: &[&str]) -> Request {
    Request {
        car: PathBuf::from(car),
        set: set.iter().map(|own| (*own).to_owned()).collect(),
        regimes: vec!["lean".to_owned()],
        speeds: vec![quantity::Quantity::parse("33 mph").unwrap()],
        conditions: Vec::new(),
        limits: "aar_chapter_xi".to_owned(),
        refine: false,
        frictions: Vec::new(),
    }
}

/// The empty car and the same car written out run in a regime from the same start, on the same track and as
/// far: the same worst values.
#[test]
fn cross_code_a_vehicle_in_a_regime_has_the_values_of_the_car() {
    let worst = |car: &str, set: &[&str]| {
        let assessment = Assessment::new(&request(car, set)).unwrap();
        let case = assessment.study.case(0).unwrap();
        let judged = case.judge().unwrap();
        [
            "side_l_over_v",
            "l_over_v_time",
            "least_load_time",
            "end_distance",
        ]
        .map(|name| case.definitions().get(&judged.measures, name).unwrap())
    };
    let car = worst("car_tangent_empty", &["start.kind=\"equilibrium\""]);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("own.toml");
    let text = CarCase::parse(
        "car.toml",
        built_in("car_tangent_empty").unwrap().text(),
        Path::new(""),
        &[],
    );
    std::fs::write(&file, written_out(text.unwrap().to_toml())).unwrap();
    let own = worst(file.to_str().unwrap(), &[]);
    for (k, (a, b)) in car.into_iter().zip(own).enumerate() {
        // The distance is that of the body's middle, or of the leading wheelset.
        let within = if k == 3 { 30.0 * FOOT } else { 1e-3 * a.abs() };
        assert!((a - b).abs() < within, "{k}: {a} {b}");
    }
}

/// The vibrations of the empty car that grow most, friction stuck, are those of the same car written out,
/// whose equations are linearized as a whole.
#[test]
fn cross_code_vibrations_over_speed_are_those_of_the_car() {
    let text = built_in("car_hunting_empty").unwrap().text();
    let start = ["start.kind=\"equilibrium\"".to_owned()];
    let car = CarCase::parse("car.toml", text, Path::new(""), &start).unwrap();
    let own = case(&written_out(car.to_toml()), &[]);
    let speeds = [20.0, 35.0];
    let go_on = |_: f64| std::ops::ControlFlow::Continue(());
    let ours = over_speed(&own, &speeds, go_on).unwrap();
    let theirs = stability(&car, &speeds, |share| match share < 0.1 {
        true => std::ops::ControlFlow::Continue(()),
        false => std::ops::ControlFlow::Break(()),
    })
    .unwrap();
    let stuck = &theirs.branches[0];
    for (ours, theirs) in ours.vibrations.iter().zip(&stuck.modes) {
        for (ours, theirs) in ours.iter().zip(theirs).take(8) {
            let frequency = ours.frequency / TAU;
            let size = (theirs.growth.powi(2) + (TAU * theirs.frequency).powi(2)).sqrt();
            let apart = (ours.growth - theirs.growth).hypot(TAU * (frequency - theirs.frequency));
            assert!(apart < 1e-3 * size, "{ours:?} {theirs:?}");
        }
    }
    assert!(stuck.critical.is_none() && ours.critical.is_none());
}

/// What cannot be assessed, and keys that have no effect, are told with what to do.
#[test]
fn input_mistakes_of_rules_have_a_remedy() {
    let error = Assessment::new(&request("vehicle_two_masses", &[])).unwrap_err();
    let problem = &error.problems()[0];
    assert!(
        problem.message().contains("no case of a car on a track"),
        "{problem}"
    );
    assert!(problem.advice().unwrap().contains("wheelsets"));
    let refused = |text: &str, words: &str| {
        let error = VehicleCase::parse("own.toml", text, Path::new(""), &[]).unwrap_err();
        let all: Vec<String> = error.problems().iter().map(ToString::to_string).collect();
        assert!(all.iter().any(|own| own.contains(words)), "{words}: {all:?}");
        assert!(
            error.problems().iter().all(|own| own.advice().is_some()),
            "{all:?}"
        );
    };
    let on = "on = \"body\"\nat = [\"0 in\", \"0 in\", \"40 in\"]\n";
    refused(
        &wagon("[accelerometers.more]\non = \"chassis\"\nat = [\"0 in\", \"0 in\", \"0 in\"]\n"),
        "chassis",
    );
    refused(
        &wagon(&format!("[accelerometers.more]\n{on}of = \"bogie\"\n")),
        "bogie",
    );
    refused(
        &built_in("vehicle_two_axles").unwrap().text().replace(
            "[wheelsets.leading]",
            "[wheelsets.leading]\ntruck = \"front truck\"",
        ),
        "is no name",
    );
    let masses = built_in("vehicle_two_masses").unwrap().text();
    refused(&format!("{masses}\n[accelerometers.one]\n{on}"), "no effect");
    refused(&format!("{masses}\n[start]\nsettle = \"1 s\"\n"), "no effect");
}

/// A summary of an earlier version, whose counters of the solver were named `statistics`, is read.
#[test]
fn input_summaries_of_earlier_versions_are_read() {
    let own = run(&case(
        built_in("vehicle_two_masses").unwrap().text(),
        &["simulation.duration=0.1 s"],
    ));
    let mut json = serde_json::to_value(&own.summary).unwrap();
    let fields = json.as_object_mut().unwrap();
    let counters = fields.remove("solver").unwrap();
    fields.insert("statistics".to_owned(), counters);
    let read: study::vehicle::summary::VehicleSummary = serde_json::from_value(json).unwrap();
    assert_eq!(read.solver, own.summary.solver);
    assert!(read.statistics.is_empty() && read.limits.is_empty());
}

/// Vehicles without a track have no measures of limits.
#[test]
fn input_a_vehicle_without_a_track_has_no_rules() {
    let masses = AnyCase::built_in("vehicle_two_masses", &[]).unwrap().unwrap();
    let judged = masses.judge().unwrap();
    assert_eq!(masses.definitions().get(&judged.measures, "l_over_v_time"), None);
}
