//! `wedgelab route`, as a user calls it.

use crate::common;
use std::fs;

use common::{done, wedgelab};

const ROUTE: &str = r#"case = "car_tangent_loaded"
miles = 2000
steps = 2
[set]
simulation.duration = "0.4 s"
start.settle = "0 s"
[wedges]
[tracks.slow]
share = 0.5
set = { speed.value = "30 mph" }
[tracks.fast]
share = 0.5
"#;

/// A route that goes on where it was stopped writes the same files, with any number of jobs, and runs only
/// what is missing.
#[test]
fn limits_a_route_goes_on_with_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("two.toml"), ROUTE).unwrap();
    let stdout = done(at, &["route", "two.toml", "--quiet", "--jobs", "2"]);
    assert!(stdout.contains("from 1000 mi to 2000 mi"), "{stdout}");
    assert!(stdout.contains("K = 1e-4 on a hardness of 2450 MPa"), "{stdout}");
    let read = |name: &str| fs::read(at.join("two_route").join(name)).unwrap();
    let names = [
        "route.json",
        "route.csv",
        "route.svg",
        "route.txt",
        "worn/step_2/wheels.csv",
    ];
    let first = names.map(read);
    let map = read("worn/step_2/truck_2_trailing_left_column_counterface.csv");
    assert!(map.starts_with(b"up [mm], across [mm], depth [mm]\n"));
    fs::remove_dir_all(at.join("two_route/runs/step_2/fast")).unwrap();
    fs::remove_dir_all(at.join("two_route/worn")).unwrap();
    fs::remove_file(at.join("two_route/route.json")).unwrap();
    let kept = at.join("two_route/runs/step_1/slow/summary.json");
    let written = fs::metadata(&kept).unwrap().modified().unwrap();
    done(at, &["route", "two.toml", "--quiet", "--jobs", "1"]);
    assert_eq!(first, names.map(read));
    assert_eq!(written, fs::metadata(&kept).unwrap().modified().unwrap());
    // Straight between the ends of steps, beyond the route at the last pace.
    let told = done(at, &["route", "two.toml", "--quiet", "--rise", "1 in"]);
    assert!(
        told.contains("Wedges stand higher by 1 in:") && told.contains("beyond the route"),
        "{told}"
    );
}

#[test]
fn input_routes_say_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(
        at.join("two.toml"),
        ROUTE.replacen("share = 0.5", "share = 0.4", 1),
    )
    .unwrap();
    fs::write(
        at.join("wedge.toml"),
        ROUTE.replace("car_tangent_loaded", "vdrun_toe_0_psi_0"),
    )
    .unwrap();
    for (file, expected) in [
        ("two.toml", "sum to 0.9"),
        ("wedge.toml", "a route is one of a car"),
        ("none.toml", "docs/route.md"),
    ] {
        let output = wedgelab(at, &["route", file]);
        let words = output.err;
        assert!(
            output.code != Some(0) && words.contains(expected),
            "{file}: {words}"
        );
    }
}
