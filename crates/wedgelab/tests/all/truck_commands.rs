//! The commands with three-piece trucks and with profiles, as a user calls them.

use crate::common;
use std::fs;

use common::{done, wedgelab};

/// The columns that other programs may count on, by name and order.
#[test]
fn input_column_names_of_a_run_are_fixed() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    done(
        at,
        &[
            "run",
            "truck_drop_variable",
            "--set",
            "simulation.duration=0.02 s",
            "-q",
        ],
    );
    let csv = fs::read_to_string(at.join("truck_drop_variable/result.csv")).unwrap();
    let header: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let mut expected = vec![
        "time_s".to_owned(),
        "bolster_z_in".to_owned(),
        "warp_angle_rad".to_owned(),
        "warp_moment_lbf_in".to_owned(),
        "interaxle_shear_moment_lbf_in".to_owned(),
        "left_nest_vertical_force_lbf".to_owned(),
        "right_nest_vertical_force_lbf".to_owned(),
    ];
    for wedge in ["leading_left", "leading_right", "trailing_left", "trailing_right"] {
        let own = [
            "column_normal_lbf",
            "column_friction_z_lbf",
            "slope_normal_lbf",
            "x_in",
            "y_in",
            "z_in",
            "roll_rad",
            "pitch_rad",
            "yaw_rad",
        ];
        expected.extend(own.map(|name| format!("{wedge}_{name}")));
    }
    assert_eq!(header[..expected.len()], expected);
    // Half a car rises and falls from 0.5 in.
    let first: f64 = csv
        .lines()
        .nth(1)
        .unwrap()
        .split(',')
        .nth(1)
        .unwrap()
        .parse()
        .unwrap();
    assert!((first - 0.5).abs() < 1e-9, "{first}");
}

#[test]
fn a_printed_truck_runs_and_is_refused_where_it_exists() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let text = done(at, &["case", "truck_roll_constant"]);
    fs::write(at.join("mine.toml"), text.replace("truck_roll_constant", "mine")).unwrap();
    let run = ["run", "mine.toml", "--set", "simulation.duration=0.05 s", "-q"];
    let out = done(at, &run);
    assert!(
        out.contains("leading left") && out.contains("mine: result.csv"),
        "{out}"
    );
    let page = fs::read_to_string(at.join("mine/index.html")).unwrap();
    assert!(page.contains("leading left") && page.contains("<svg"));
    // The page alone is in the way too.
    for file in ["result.csv", "result.mat", "case.toml", "summary.json"] {
        fs::remove_file(at.join("mine").join(file)).unwrap();
    }
    let again = wedgelab(at, &run);
    assert_eq!(again.code, Some(2), "{}", again.err);
    assert!(again.err.contains("index.html"), "{}", again.err);
    done(at, &[&run[..], &["--force"]].concat());
    let again = wedgelab(at, &run);
    assert_eq!(again.code, Some(2), "{}", again.err);
    assert!(again.err.contains("--force"), "{}", again.err);
    let plot = done(
        at,
        &["plot", "mine", "--x", "time", "--y", "bolster_roll", "warp_angle"],
    );
    assert!(plot.contains(".svg"), "{plot}");
}

/// Without a case a truck with crowned wedges, new and worn, with nothing to warn of.
#[test]
fn warp_compares_a_new_and_a_worn_truck() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let made = wedgelab(at, &["warp", "--out", "w", "-q"]);
    assert_eq!(made.code, Some(0), "{}", made.err);
    assert!(made.err.is_empty(), "{}", made.err);
    let out = made.out;
    for part in [
        "new ",
        "worn: friction 0.25, rise 0.75 in",
        "NUCARS, worn",
        "the faces decide",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    let pwl = fs::read_to_string(at.join("w/warp.pwl")).unwrap();
    assert!(
        pwl.contains("! new") && pwl.contains("! worn: friction 0.25"),
        "{pwl}"
    );
    for refused in [
        &["warp", "--worn", "--friction", "0.3"][..],
        &[
            "warp",
            "truck_crowned_warp_nest_constant",
            "--rise",
            "0.5 in",
            "--wear",
            "0.1 in",
        ],
    ] {
        let refused = wedgelab(at, refused);
        assert_eq!(refused.code, Some(2), "{}", refused.err);
        assert!(refused.err.contains("cannot be used with"), "{}", refused.err);
    }
}

#[test]
fn warp_writes_what_industry_programs_take() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let arguments = [
        "warp",
        "truck_warp_nest_constant_rising",
        "--friction",
        "0.25",
        "0.4",
        "--out",
        "w",
        "-q",
    ];
    let out = done(at, &arguments);
    assert!(
        out.contains("plateau at 22") && out.contains("lock-up") && out.contains("NUCARS, worn"),
        "{out}"
    );
    let pwl = fs::read_to_string(at.join("w/warp.pwl")).unwrap();
    let record = pwl
        .lines()
        .find(|line| line.trim_start().starts_with("14"))
        .unwrap();
    let numbers: Vec<f64> = record
        .split_whitespace()
        .map(|text| text.parse().unwrap())
        .collect();
    // Number, points, then half of the plateau of 225 kip·in at the last point.
    assert_eq!(numbers[1] as usize, numbers.len() - 2);
    assert!((numbers.last().unwrap() / 112.5e3 - 1.0).abs() < 0.05, "{record}");
    for file in ["warp.csv", "warp_loops.csv", "warp.svg", "warp.png"] {
        assert!(at.join("w").join(file).metadata().unwrap().len() > 500, "{file}");
    }
    for (arguments, text) in [
        (&["warp", "truck_vertical_variable"][..], "stays below 0.5 mrad"),
        (&["warp", "vdrun_toe_0_psi_0"], "the case of a single wedge"),
        (&["curves", "truck_warp_nest_variable_rising"], "no whole cycle"),
    ] {
        let refused = wedgelab(at, arguments);
        assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.err);
        assert!(refused.err.contains(text), "{arguments:?}: {}", refused.err);
    }
}

#[test]
fn curves_tell_stiffness_and_friction() {
    let folder = tempfile::tempdir().unwrap();
    let out = done(
        folder.path(),
        &[
            "curves",
            "truck_vertical_variable",
            "--friction",
            "0",
            "0.4",
            "--out",
            "c",
            "-q",
        ],
    );
    assert!(out.contains("friction 0.4"), "{out}");
    let csv = fs::read_to_string(folder.path().join("c/curves.csv")).unwrap();
    assert!(
        csv.starts_with("test,bolster_z_in,resisting_force_lbf\nfriction 0,"),
        "{}",
        &csv[..80]
    );
}

#[test]
fn a_study_varies_single_wedges() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let study = "case = \"truck_vertical_variable\"\nsampling = \"full_factorial\"\n[set]\n\
                 simulation.duration = \"7 s\"\n[vary]\nwedge.leading_left.friction.column = [0.2, 0.4]\n\
                 wedge.leading_left.toe = [\"0 deg\", \"0.2 deg out\"]\n";
    fs::write(at.join("study.toml"), study).unwrap();
    let out = done(at, &["study", "study.toml", "-q"]);
    assert!(out.contains("4 runs: 4 complete"), "{out}");
    assert!(at.join("study/table.parquet").is_file());
    let out = done(at, &["study", "study.toml", "--series", "1", "-q"]);
    assert!(out.contains("result.csv"), "{out}");
}

/// Friction of both faces is found again from the warp loop that it made.
#[test]
fn fit_finds_friction_from_a_measured_warp_loop() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let name = "truck_warp_nest_constant_rising";
    let set = [
        "friction.column=0.3",
        "friction.slope=0.3",
        "simulation.output_interval=0.1 s",
    ];
    let mut arguments = vec!["run", name, "--out", "measured", "-q"];
    arguments.extend(set.iter().flat_map(|set| ["--set", set]));
    done(at, &arguments);
    let out = done(
        at,
        &[
            "fit",
            "measured",
            name,
            "--set",
            "friction.slope=0.3",
            "--free",
            "friction.column=0.2..0.6",
            "--out",
            "fitted",
        ],
    );
    let line = out
        .lines()
        .find(|line| line.starts_with("friction.column"))
        .unwrap();
    let value: f64 = line.split_whitespace().nth(1).unwrap().parse().unwrap();
    assert!((value - 0.3).abs() < 1e-4, "{line}");
    let case = fs::read_to_string(at.join("fitted/case.toml")).unwrap();
    let column = case.lines().find(|line| line.starts_with("column = ")).unwrap();
    let written: f64 = column.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert!(
        case.contains("model = \"truck\"") && (written - value).abs() < 1e-6,
        "{column}"
    );
}

/// Nominal profiles: cones of 1:20 until the flange, a conicity of 0.05, and refusals that help.
#[test]
fn wheelrail_checks_profiles_and_tells_conicity() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let out = done(at, &["wheelrail", "plot", "aar_1b", "136re", "--out", "wr"]);
    assert!(out.contains("from memory"), "{out}");
    let row = out.lines().find(|line| line.starts_with("0.100")).unwrap();
    let conicity: f64 = row.split_whitespace().last().unwrap().parse().unwrap();
    assert!((conicity - 0.05).abs() < 0.002, "{row}");
    let csv = fs::read_to_string(at.join("wr/wheelrail.csv")).unwrap();
    assert!(csv.starts_with("shift_in,rolling_radius_difference_in") && csv.lines().count() > 200);
    assert!(at.join("wr/wheelrail.png").metadata().unwrap().len() > 5000);
    fs::write(at.join("bad.csv"), "y,z\n0,0\n1,1\n").unwrap();
    for (arguments, text) in [
        (
            &["wheelrail", "check", "aar_1b", "136rex"][..],
            "nominal rail `136rex`",
        ),
        (
            &["wheelrail", "check", "aar_1b", "136re", "--gauge", "50 in"],
            "flanges",
        ),
        (&["wheelrail", "check", "bad.csv", "136re"], "bad.csv"),
        (&["wheelrail", "check", "cone_a", "136re"], "cone_1:20"),
        (
            &["wheelrail", "check", "aar_1b", "136re", "--gauge", "56.5 lbf"],
            "length",
        ),
    ] {
        let refused = wedgelab(at, arguments);
        assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.err);
        assert!(refused.err.contains(text), "{arguments:?}: {}", refused.err);
    }
}

/// A sine of 62 ft has twice its amplitude as offset of a chord of 62 ft, none of 124 ft, and a curve is
/// told.
#[test]
fn track_show_tells_chord_offsets() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let track = "[[segments]]\ntangent = \"1000 ft\"\n[[segments]]\nspiral = \"100 ft\"\n[[segments]]\n\
                 curve = \"300 ft\"\ndegree = \"5 deg\"\n[[irregularities]]\nshape = \"sine\"\n\
                 direction = \"vertical\"\namplitude = \"0.5 in\"\nwavelength = \"62 ft\"\ncycles = 10\n\
                 start = \"200 ft\"\n";
    fs::write(at.join("sine.toml"), track).unwrap();
    let out = done(at, &["track", "show", "sine.toml", "--interval", "0.5 ft"]);
    assert!(
        out.contains("5.00 deg to the left") && out.contains("Written into sine"),
        "{out}"
    );
    let row = out.lines().find(|line| line.starts_with("left profile")).unwrap();
    let offsets: Vec<f64> = row
        .split_whitespace()
        .skip(2)
        .step_by(2)
        .map(|text| text.parse().unwrap())
        .collect();
    assert!((offsets[1].abs() - 1.0).abs() < 1e-3, "{row}");
    // 1 - cos(pi 31/62) = 1 times the amplitude.
    assert!((offsets[0].abs() - 0.5).abs() < 2e-3, "{row}");
    let csv = fs::read_to_string(at.join("sine/track.csv")).unwrap();
    assert!(csv.starts_with("distance_ft,") && csv.lines().count() == 2802);
    let refused = wedgelab(at, &["track", "show", "none.toml"]);
    assert_eq!(refused.code, Some(2), "{}", refused.err);
}

/// Offsets of 1.9 in keep class 4 of 49 CFR 213, which is told with the place, beside a stated class; the
/// standard deviation of the wave is in its band.
#[test]
fn analytic_track_show_tells_the_class() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let track = "class = 5\n[[segments]]\ntangent = \"3000 ft\"\n[[irregularities]]\nshape = \"sine\"\n\
                 direction = \"vertical\"\namplitude = \"0.95 in\"\nwavelength = \"62 ft\"\ncycles = 40\n\
                 start = \"200 ft\"\n";
    fs::write(at.join("wave.toml"), track).unwrap();
    let out = done(at, &["track", "show", "wave.toml", "--interval", "0.5 ft"]);
    let line = |begin: &str| {
        out.lines()
            .find(|line| line.starts_with(begin))
            .unwrap_or_default()
    };
    for (begin, parts) in [
        ("worst value, in", &["limit of class 5", "keeps class"][..]),
        ("profile 62 ft (213.63)", &["1.900", "1.25", " 4 ", "read"]),
        (
            "alinement 31 ft (213.327)",
            &["0.5 (class 6)", " 9 ", "remembered"],
        ),
        (
            "The geometry is that of class 4",
            &[
                "up to 60 mph",
                "profile 62 ft is above the limit of class 5",
                "said to be class 5 (80 mph)",
            ],
        ),
    ] {
        let line = line(begin);
        assert!(
            parts.iter().all(|part| line.contains(part)),
            "{begin}: {line}\n{out}"
        );
    }
    // 0.95/√2 in within 200 m, by the gain of D1 at 62 ft.
    let gain = 1.0 / (1.0 + (2.0_f64.sqrt() - 1.0) * (62.0 * 0.3048 / 25.0_f64).powi(4));
    let deviations = out.split("standard deviation, in").nth(1).unwrap();
    let row = deviations
        .lines()
        .find(|line| line.starts_with("left profile"))
        .unwrap();
    let worst: f64 = row.split_whitespace().nth(3).unwrap().parse().unwrap();
    let expected = 0.95 / 2.0_f64.sqrt() * gain;
    assert!((worst / expected - 1.0).abs() < 0.02, "{row}: {expected}");
    let wrong = track.replace("class = 5", "class = 7");
    fs::write(at.join("wrong.toml"), wrong).unwrap();
    let refused = wedgelab(at, &["track", "show", "wrong.toml"]);
    assert!(
        refused.code == Some(2) && refused.err.contains("from 1 to 5"),
        "{}",
        refused.err
    );
}

/// A run that is saved on its way and goes on has the rows of the whole run, digit by digit; a state of
/// another case is refused.
#[test]
fn reproducible_a_run_goes_on_from_its_saved_state() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let base = [
        "truck_vertical_variable",
        "-q",
        "--set",
        "simulation.duration=1 s",
    ];
    let run = |more: &[&str]| wedgelab(at, &[&["run"], &base[..], more].concat());
    assert_eq!(run(&["--out", "whole"]).code, Some(0));
    let first = run(&[
        "--out",
        "first",
        "--save",
        "states/half.json",
        "--until",
        "0.42 s",
    ]);
    assert_eq!(first.code, Some(0), "{}", first.err);
    assert!(first.err.contains("--continue states/half.json"), "{}", first.err);
    let second = run(&["--out", "second", "--continue", "states/half.json"]);
    assert_eq!(second.code, Some(0), "{}", second.err);
    let table = |name: &str| fs::read_to_string(at.join(name).join("result.csv")).unwrap();
    let (whole, first, second) = (table("whole"), table("first"), table("second"));
    let (head, rows) = second.split_once('\n').unwrap();
    assert!(first.starts_with(head) && first.lines().count() > 40 && rows.lines().count() > 50);
    assert_eq!(first + rows, whole);
    let summary = |name: &str| -> serde_json::Value {
        let text = fs::read_to_string(at.join(name).join("summary.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    assert_eq!(summary("first")["complete"], false);
    for member in ["complete", "ledger", "statistics", "energy", "cycles"] {
        assert_eq!(summary("second")[member], summary("whole")[member], "{member}");
    }
    // What does not fit is said, and nothing is written.
    let other = run(&[
        "--out",
        "x",
        "--continue",
        "states/half.json",
        "--set",
        "friction.column=0.3",
    ]);
    assert_eq!(other.code, Some(2));
    assert!(
        other.err.contains("the state of another case") && other.err.contains("column = 0.3"),
        "{}",
        other.err
    );
    let late = run(&["--out", "x", "--save", "late.json", "--until", "2 s"]);
    assert!(
        late.code == Some(2) && late.err.contains("the run ends at 1 s"),
        "{}",
        late.err
    );
    fs::write(at.join("broken.json"), "{\"schema\": \"wedgelab.run_state/1\"").unwrap();
    let broken = run(&["--out", "x", "--continue", "broken.json"]);
    assert!(
        broken.code == Some(2) && broken.err.contains("is no saved state"),
        "{}",
        broken.err
    );
    let again = run(&["--out", "first", "--force", "--continue", "gone.json"]);
    assert!(
        again.code == Some(2) && again.err.contains("there is no saved state gone.json"),
        "{}",
        again.err
    );
    assert!(!at.join("x").exists() && !at.join("late.json").exists());
}
