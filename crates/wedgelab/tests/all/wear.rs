//! `wedgelab wear`, as a user calls it.

use crate::common;
use std::fs;
use std::path::Path;

use common::{done, wedgelab};

const SHORT: [&str; 6] = [
    "--set",
    "simulation.duration=4.72 s",
    "--set",
    "column_face.grid=[3, 3]",
    "--quiet",
    "--force",
];

fn wear<'a>(case: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["wear", case], SHORT.as_slice(), more].concat()
}

/// Returns the rows of a CSV file by the names of their columns.
fn column(path: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let at = lines
        .next()
        .unwrap()
        .split(',')
        .position(|own| own.trim() == name);
    let at = at.unwrap_or_else(|| panic!("no column {name} in {}", path.display()));
    lines
        .map(|line| line.split(',').nth(at).unwrap().trim().parse().unwrap())
        .collect()
}

#[test]
fn input_wear_writes_its_course_and_a_case_to_go_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let more = ["--cycles", "4000", "--steps", "2", "--out", "first"];
    let stdout = done(at, &wear("cdrun_toe_0_psi_0", &more));
    assert!(stdout.contains("K = 1e-4 (a guess)"), "{stdout}");
    assert!(stdout.contains("order of magnitude"), "{stdout}");
    let course = at.join("first/wear.csv");
    assert_eq!(column(&course, "cycles"), [0.0, 2000.0, 4000.0]);
    let volumes = column(&course, "column_volume_in3");
    assert_eq!(volumes[0], 0.0);
    // Two even steps by the volumes of a cycle.
    let rates = column(&course, "column_volume_per_cycle_in3");
    let wanted = 2000.0 * (rates[0] + rates[1]);
    assert!((volumes[2] - wanted).abs() < 1e-9 * wanted);
    // The map holds that volume: nine points of 6.125 in by 10.5 in.
    let depths = column(&at.join("first/column_wear.csv"), "depth [in]");
    let weights = [1.0, 2.0, 1.0, 2.0, 4.0, 2.0, 1.0, 2.0, 1.0].map(|weight| weight / 16.0);
    let held: f64 = depths
        .iter()
        .zip(weights)
        .map(|(depth, weight)| depth * weight)
        .sum();
    let held = held * 6.125 * 10.5;
    assert!((held - volumes[2]).abs() < 1e-6 * held, "{held} {}", volumes[2]);
    for name in [
        "wear_points.csv",
        "slope_wear.csv",
        "wear.svg",
        "wear.png",
        "wear.txt",
    ] {
        assert!(at.join("first").join(name).exists(), "{name}");
    }
    // The worn case runs, and wears on from its depths.
    let more = [
        "--cycles",
        "1",
        "--out",
        "second",
        "--coefficient",
        "1e-4",
        "--hardness",
        "2000 MPa",
    ];
    let stdout = done(at, &wear("first/worn.toml", &more));
    assert!(
        stdout.contains("(given)") && !stdout.contains("guess"),
        "{stdout}"
    );
    let deepest = |path: &str| column(&at.join(path), "column_deepest_in");
    let (before, after) = (deepest("first/wear.csv"), deepest("second/wear.csv"));
    assert!((after[0] - before[2]).abs() < 1e-9 * before[2]);
    // So does a case that names the written map.
    let map = format!(
        "column_face.wedge_wear={:?}",
        at.join("first/column_wear.csv").display().to_string()
    );
    let more = ["--cycles", "1", "--out", "third", "--set", map.as_str()];
    done(at, &wear("cdrun_toe_0_psi_0", &more));
    assert!((deepest("third/wear.csv")[0] - before[2]).abs() < 1e-6 * before[2]);
}

#[test]
fn input_mistakes_with_wear_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |case: &str, more: &[&str], expected: &str| {
        let output = wedgelab(folder.path(), &wear(case, more));
        assert_eq!(output.code, Some(2), "{more:?}: {}", output.err);
        let err: String = output.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(err.contains(expected), "{more:?}: {err}");
    };
    let case = "cdrun_toe_0_psi_0";
    refused(case, &[], "--cycles");
    refused(case, &["--cycles", "0"], "from 1 to 1e12");
    refused(case, &["--cycles", "many"], "from 1 to 1e12");
    refused(
        case,
        &["--cycles", "10", "--coefficient", "-1"],
        "above 0 up to 1",
    );
    refused(case, &["--cycles", "10", "--coefficient", "2"], "above 0 up to 1");
    refused(case, &["--cycles", "10", "--hardness", "250"], "unit");
    refused(case, &["--cycles", "10", "--hardness", "3 Pa"], "from 1 MPa");
    refused(
        case,
        &["--cycles", "10", "--law", "energy", "--hardness", "3000 MPa"],
        "no effect",
    );
    refused(case, &["--cycles", "1e9"], "steps are needed");
    refused(
        case,
        &["--cycles", "10", "--set", "simulation.duration=3 s"],
        "no whole cycle",
    );
    refused(
        "truck_warp_nest_constant_rising",
        &["--cycles", "10"],
        "a single wedge",
    );
}

/// The coefficient that a measured depth means wears that depth; mass and depth agree; mistakes are said.
#[test]
fn analytic_a_coupon_tells_the_coefficient_of_its_wear() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let told = |arguments: &[&str]| -> serde_json::Value {
        let text = common::done(at, &[&["coupon", "--json"], arguments].concat());
        serde_json::from_str(&text).unwrap()
    };
    let by_depth = told(&["--area", "4 in^2", "--worn-depth", "0.02 in"]);
    let found = by_depth["coefficient_of_worn"].as_f64().unwrap();
    // V H / (N 4 A n), by hand: 4 in2 of 0.02 in, 2450 MPa, 750 lbf over 200,000 in.
    let by_hand = 4.0 * 0.02 * 0.0254_f64.powi(3) * 2.45e9 / (750.0 * 4.448_221_615 * 2e5 * 0.0254);
    assert!((found / by_hand - 1.0).abs() < 1e-8, "{found} {by_hand}");
    let last = by_depth["rows"].as_array().unwrap().last().unwrap();
    assert!((last["depth_m"].as_f64().unwrap() / (0.02 * 0.0254) - 1.0).abs() < 1e-12);
    let mass = format!("{} kg", last["mass_kg"].as_f64().unwrap());
    let by_mass = told(&["--worn-mass", &mass])["coefficient_of_worn"]
        .as_f64()
        .unwrap();
    assert!((by_mass / found - 1.0).abs() < 1e-9);
    for (arguments, part) in [
        (&["--worn-depth", "0.02 in"][..], "--area"),
        (&["--area", "4 in"], "4 in^2"),
        (&["--clamp", "0 lbf"], "above 0"),
    ] {
        let output = common::wedgelab(at, &[&["coupon"], arguments].concat());
        assert_eq!(output.code, Some(2));
        assert!(output.err.contains(part), "{}", output.err);
    }
    let odd = common::done(at, &["coupon", "--worn-mass", "40 kg"]);
    assert!(odd.contains("warning: dry steel is worn by"), "{odd}");
}
