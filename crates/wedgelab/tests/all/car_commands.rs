//! The commands with freight cars, as a user calls them.

use crate::common;
use std::fs;

use common::wedgelab;

/// A run writes its files, and what it prints and writes says the same; `compare` reads its table.
#[test]
fn input_a_run_of_a_car_writes_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    for out in ["a", "b"] {
        let speed = if out == "a" {
            "speed.value=30 mph"
        } else {
            "speed.value=40 mph"
        };
        let settings = [
            "simulation.duration=0.1 s",
            "start.settle=0 s",
            "start.kind=equilibrium",
            speed,
        ];
        let set = settings.iter().flat_map(|own| ["--set", own]);
        let arguments: Vec<&str> = ["run", "car_pitch_and_bounce_loaded", "-q", "--out", out]
            .into_iter()
            .chain(set)
            .collect();
        let done = wedgelab(at, &arguments);
        assert_eq!(done.code, Some(0), "{}", done.err);
        assert!(
            done.out.contains("least wheel load") && done.out.contains("from memory"),
            "{}",
            done.out
        );
        for file in [
            "result.parquet",
            "result.csv",
            "case.toml",
            "summary.json",
            "index.html",
        ] {
            assert!(at.join(out).join(file).is_file(), "{file}");
        }
    }
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(at.join("a/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["schema"], "wedgelab.car/1");
    assert_eq!(summary["complete"], true);
    assert!(
        summary["assumptions"][0]
            .as_str()
            .unwrap()
            .contains("flexible bodies, braking. No coupler forces act")
    );
    let csv = fs::read_to_string(at.join("a/result.csv")).unwrap();
    assert!(csv.starts_with("time_s,distance_ft,speed_mph,body_roll_rad\n"));
    let page = fs::read_to_string(at.join("a/index.html")).unwrap();
    assert!(page.contains("check against your edition") && page.contains("<svg"));
    // The written case runs again to the same table.
    let again = wedgelab(at, &["run", "a/case.toml", "-q", "--out", "c"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    for table in ["result.csv", "result.parquet"] {
        let [again, first] = ["c", "a"].map(|folder| fs::read(at.join(folder).join(table)).unwrap());
        assert_eq!(again, first, "{table}");
    }
    let compared = wedgelab(at, &["compare", "a", "b"]);
    assert_eq!(compared.code, Some(0), "{}", compared.err);
}

/// Wrong use of commands: what is wrong and what to do.
#[test]
fn input_commands_say_what_they_take() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, parts) in [
        (
            &["stability", "truck_drop_variable"][..],
            &["is no car", "car_hunting_empty"][..],
        ),
        (
            &["stability", "car_hunting_empty", "--speeds", "30 mph"],
            &["\"30 mph\"..\"80 mph\""],
        ),
        (
            &["stability", "car_hunting_empty", "--speeds", "60 mph..60 mph"],
            &["this is one speed only"],
        ),
        (
            &[
                "stability",
                "car_hunting_empty",
                "--nonlinear",
                "--set",
                "wheels.geometry=linear",
                "--set",
                "track.support.kind=rigid",
            ],
            &["neither flanges nor saturation", "leave out --nonlinear"],
        ),
        (
            &["stability", "car_hunting_empty", "--ramp-time", "60 s"],
            &["--nonlinear"],
        ),
        (
            &[
                "stability",
                "car_hunting_empty",
                "--nonlinear",
                "--ramp-time",
                "1 s",
            ],
            &["the ramp must take 5 s to 10000 s"],
        ),
        (
            &[
                "stability",
                "car_hunting_empty",
                "--nonlinear",
                "--threshold",
                "2 s",
            ],
            &["a length is expected"],
        ),
        (
            &["warp", "car_tangent_empty"],
            &["is the case of a car", "a truck's is expected"],
        ),
        (
            &["run", "car_tangent_emty"],
            &["did you mean the built-in case car_tangent_empty"],
        ),
        (
            &["run", "car_tangent_empty", "--set", "speed.value=0 mph"],
            &["speed.value", "coasting"],
        ),
    ] {
        let output = wedgelab(folder.path(), arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        for part in parts {
            assert!(
                output.err.contains(part),
                "{arguments:?} lacks {part}: {}",
                output.err
            );
        }
    }
}

/// The empty car on rollers hunts at 70 mph once its axles start 0.4 in off the middle: files and words say
/// so.
#[test]
fn limits_a_car_on_rollers_hunts_once_disturbed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let arguments = "stability car_hunting_roller_empty -q --nonlinear --steps 2 --ramp-time 5s --out h";
    let mut arguments: Vec<&str> = arguments.split(' ').collect();
    arguments.extend(["--speeds", "70 mph..75 mph"]);
    let done = wedgelab(at, &arguments);
    assert_eq!(done.code, Some(0), "{}", done.err);
    assert!(
        done.out
            .contains("Speed falls: it hunts down to the lowest speed.")
            && done.out.contains("Speed rises: "),
        "{}",
        done.out
    );
    for file in ["stability.csv", "hunting.csv", "hunting.svg", "hunting.png"] {
        assert!(at.join("h").join(file).is_file(), "{file}");
    }
    let numbers: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(at.join("h/hunting.json")).unwrap()).unwrap();
    assert_eq!(numbers["schema"], "wedgelab.car_hunting/1");
    assert_eq!(numbers["complete"], true);
    assert_eq!(numbers["falling"]["hunting"], "everywhere");
    assert!(
        numbers["falling"]["largest_amplitude"].as_f64().unwrap() > 0.2,
        "{numbers}"
    );
    let table = fs::read_to_string(at.join("h/hunting.csv")).unwrap();
    assert!(table.starts_with("ramp,time_s,speed_mph,axle_1_lateral_amplitude_in,"));
    assert!(table.contains("\nfalling,") && table.contains("\nrising,"));
}

/// Sources and sinks of a run's energy: printed, as JSON, and written with its figure.
#[test]
fn energy_of_a_run_is_reported_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let settings = ["simulation.duration=0.5 s", "start.settle=0 s"];
    let set: Vec<&str> = settings.iter().flat_map(|own| ["--set", own]).collect();
    let energy = |more: &[&str]| {
        let arguments = [&["energy", "car_tangent_loaded", "--quiet"], &set[..], more].concat();
        let done = wedgelab(at, &arguments);
        assert_eq!(done.code, Some(0), "{}", done.err);
        done.out
    };
    let stdout = energy(&["--out", "told"]);
    for part in [
        "Energy of a run: the whole run, 0.000 s to 0.500 s",
        "drive work",
        "resistance",
        "wheel 1 left",
        "energy.json, power_flow.svg, power_flow.png",
    ] {
        assert!(stdout.contains(part), "{stdout} without {part}");
    }
    let printed: serde_json::Value = serde_json::from_str(&energy(&["--json"])).unwrap();
    let written = fs::read_to_string(at.join("told/energy.json")).unwrap();
    assert_eq!(
        printed,
        serde_json::from_str::<serde_json::Value>(&written).unwrap()
    );
    assert_eq!(
        printed["losses"]["wheel_loss"]["by_point"]
            .as_object()
            .unwrap()
            .len(),
        8
    );
    let svg = fs::read_to_string(at.join("told/power_flow.svg")).unwrap();
    assert!(svg.contains("Energy of a run"));
}
