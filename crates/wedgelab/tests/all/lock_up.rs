//! `wedgelab lock-up`, as a user calls it.

use crate::common;
use std::fs;

use common::{done, wedgelab};

#[test]
fn limits_a_map_has_its_table_and_figures() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let map = ["lock-up", "--points", "4", "--out", "map", "-q"];
    let out = done(at, &map);
    assert!(out.starts_with("16 points: "), "{out}");
    let csv = fs::read_to_string(at.join("map/lock_up.csv")).unwrap();
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].starts_with("angle_deg,friction,closing_angle_deg,lock_up_margin_deg,found,"));
    assert_eq!(lines.len(), 17);
    // 20 deg and 0.1: 20 - 2 atan 0.1.
    let first: Vec<&str> = lines[1].split(',').collect();
    let number = |place: usize| first[place].parse::<f64>().unwrap();
    assert!((number(0) - 20.0).abs() < 1e-9 && (number(3) - 8.5788).abs() < 1e-3);
    assert_eq!(first[4], "slides");
    assert!(lines[4].contains(",locks,"), "{}", lines[4]);
    let svg = fs::read_to_string(at.join("map/lock_up.svg")).unwrap();
    assert!(svg.contains("margin zero: locks up beyond") && svg.contains("rig locks up"));
    let again = done(at, &[&map[..], &["--force", "--jobs", "1"]].concat());
    assert_eq!(fs::read_to_string(at.join("map/lock_up.csv")).unwrap(), csv);
    assert_eq!(again, out);
    // Other axes, shown in their units.
    let over = ["--over", "toe=3 deg in..3 deg out", "crown=50 in..200 in"];
    done(
        at,
        &[&["lock-up", "--points", "2", "--out", "two", "-q"], &over[..]].concat(),
    );
    let csv = fs::read_to_string(at.join("two/lock_up.csv")).unwrap();
    assert!(csv.starts_with("toe_out_deg,crown_in,"), "{csv}");
    assert!(csv.contains("\n-3") && csv.lines().count() == 5, "{csv}");
}

#[test]
fn input_maps_that_make_no_sense_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let over = |first: &'static str, second: &'static str| vec!["--over", first, second];
    let friction = "friction=0.1..0.5";
    for (arguments, parts) in [
        (
            over("angle=20 deg..30 deg", "angle=30 deg..40 deg"),
            ["both axes are the angle", "two different ones"],
        ),
        (
            over("angle=0 deg..30 deg", friction),
            ["angle is 0 deg", "both excluded"],
        ),
        (
            over("angle=20 deg..90 deg", friction),
            ["angle is 90 deg", "both excluded"],
        ),
        (
            over("angle=32 deg..32 deg", friction),
            ["one point only", "give two different values"],
        ),
        (
            over("speed=1..2", friction),
            ["no axis `speed`", "angle, friction, toe, crown, yaw"],
        ),
        (over("crown=1 in..9 in", friction), ["wedge_surface", "radius"]),
        (vec!["--over", friction], ["two axes", "has 1"]),
        (vec!["--points", "1"], ["one point along an axis", "2 to 200"]),
        (vec!["truck_bottomed_constant"], ["is a truck", "a single wedge"]),
        (vec!["car_hunting_empty"], ["is a car", "a single wedge"]),
        (
            vec!["lock_up_friction_0.5"],
            ["neither a case file", "lock_up_friction_0."],
        ),
    ] {
        let output = wedgelab(folder.path(), &[&["lock-up", "-q"], &arguments[..]].concat());
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        for part in parts {
            assert!(
                output.err.contains(part),
                "{arguments:?} without {part}: {}",
                output.err
            );
        }
    }
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        0,
        "nothing was written"
    );
}
