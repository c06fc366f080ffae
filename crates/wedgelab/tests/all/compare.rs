//! `wedgelab compare` and `wedgelab plot`, as a user calls them.

use crate::common;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use tempfile::TempDir;

use common::{done, wedgelab};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The call is refused with exit code 2 and all of these texts, without a trace of it.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str], texts: &[&str]) {
    let before = names(folder);
    let output = wedgelab(folder, arguments);
    assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
    for text in texts {
        assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
    }
    assert!(!output.err.contains("panicked"), "{}", output.err);
    assert_eq!(names(folder), before);
}

fn temporary() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Returns a CSV file's columns, as texts.
fn columns(file: &Path) -> BTreeMap<String, Vec<String>> {
    let text = fs::read_to_string(file).unwrap();
    let mut lines = text
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let mut columns = vec![Vec::new(); head.len()];
    for line in lines {
        assert_eq!(line.len(), head.len());
        for (column, cell) in columns.iter_mut().zip(line) {
            column.push(cell);
        }
    }
    head.into_iter().zip(columns).collect()
}

fn numbers(file: &Path, name: &str) -> Vec<f64> {
    columns(file)[name]
        .iter()
        .map(|cell| cell.parse().unwrap())
        .collect()
}

/// Returns a number in the table of differences.
fn difference(folder: &Path, column: &str, result: &str, what: &str) -> f64 {
    let table = columns(&folder.join("differences.csv"));
    let row = (0..table["column"].len())
        .find(|row| table["column"][*row] == column && table["result"][*row] == result)
        .unwrap_or_else(|| panic!("{column} {result}"));
    table[what][row].parse().unwrap()
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs(),
        "{found} {expected}"
    );
}

/// The table of differences is computed here once more, from the results' own files.
#[test]
fn two_runs() {
    let folder = temporary();
    let path = folder.path();
    let (a, b) = ("cdrun_toe_0_psi_0.012", "cdrun_toe_in_0.2_psi_0.012");
    done(path, &["reproduce", "--quiet", "--only", a, b]);
    let runs = path.join("reproduction/runs");
    let [first, second] = [a, b].map(|name| format!("reproduction/runs/{name}"));
    let out = done(path, &["compare", &first, &second]);
    for text in [
        "Differences from cdrun_toe_0_psi_0.012, in its units, at its 1001 times from 0 s to 10 s",
        "vertical_wedge_force",
        "friction energy per cycle",
        "Written into comparison: differences.csv, vertical_wedge_force.svg",
    ] {
        assert!(out.contains(text), "{text}: {out}");
    }
    assert!(
        !out.contains("interpolated") && !out.contains("converted"),
        "{out}"
    );

    let comparison = path.join("comparison");
    for (name, unit) in [
        ("vertical_wedge_force", "lbf"),
        ("side_frame_yaw_moment", "lbf_in"),
        ("wedge_z", "in"),
    ] {
        let [own, other] =
            [a, b].map(|run| numbers(&runs.join(run).join("result.csv"), &format!("{name}_{unit}")));
        let times = numbers(&runs.join(a).join("result.csv"), "time_s");
        let apart: Vec<f64> = own.iter().zip(&other).map(|(own, other)| other - own).collect();
        let most = (0..apart.len())
            .max_by(|i, j| apart[*i].abs().total_cmp(&apart[*j].abs()).then(j.cmp(i)))
            .unwrap();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / 1001.0;
        let squares: Vec<f64> = apart.iter().map(|apart| apart * apart).collect();
        let greatest = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = own.iter().copied().fold(f64::INFINITY, f64::min);
        for (what, expected) in [
            ("largest_difference", apart[most]),
            ("time_s", times[most]),
            ("largest_relative", apart[most].abs() / (greatest - least)),
            ("rms_difference", mean(&squares).sqrt()),
            ("range", greatest - least),
            ("mean", mean(&other)),
            ("mean_of_compared_with", mean(&own)),
        ] {
            near(difference(&comparison, name, b, what), expected);
        }
    }
    let energy = |run: &str| {
        let text = fs::read_to_string(runs.join(run).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
        summary["averages"]["energy_per_cycle"]["side_frame"]["value"]
            .as_f64()
            .unwrap()
    };
    let name = "energy_per_cycle_side_frame";
    near(difference(&comparison, name, b, "mean"), energy(b));
    near(
        difference(&comparison, name, b, "largest_difference"),
        energy(b) - energy(a),
    );

    let figures = names(&comparison);
    assert_eq!(figures.len(), 17, "{figures:?}");
    let svg = fs::read_to_string(comparison.join("hysteresis.svg")).unwrap();
    for text in ["bolster vertical (in)", "vertical wedge force (lbf)", a, b] {
        assert!(svg.contains(text), "{text}");
    }

    // Results are kept unless --force is given.
    refused(
        path,
        &["compare", &first, &second],
        &["comparison/differences.csv", "--force"],
    );
    done(path, &["compare", &first, &second, "--force"]);
}

/// The same run in both systems of units differs by nothing.
#[test]
fn units_are_converted() {
    let folder = temporary();
    let path = folder.path();
    let case = "cdrun_toe_in_0.2_psi_0.012";
    done(path, &["run", case, "--quiet", "--out", "us"]);
    done(
        path,
        &[
            "run",
            case,
            "--quiet",
            "--out",
            "si",
            "--set",
            "simulation.output_units=si",
        ],
    );
    for (first, second) in [("us", "si"), ("si", "us")] {
        let out = done(path, &["compare", first, second, "--out", "both", "--force"]);
        assert!(
            out.contains(&format!("{second} is in")) && out.contains("converted"),
            "{out}"
        );
        assert!(!out.contains("interpolated"), "{out}");
        let table = columns(&path.join("both/differences.csv"));
        let unit = if first == "us" { "lbf" } else { "N" };
        assert!(table["unit"].iter().any(|cell| cell == unit));
        let mut compared = 0;
        for (relative, name) in table["largest_relative"].iter().zip(&table["column"]) {
            if let Ok(relative) = relative.parse::<f64>() {
                assert!(relative < 1e-14, "{name}: {relative}");
                compared += 1;
            }
        }
        assert!(compared >= 14, "{compared}");
        let energy = "energy_per_cycle_bolster";
        let both = path.join("both");
        near(
            difference(&both, energy, second, "mean"),
            difference(&both, energy, second, "mean_of_compared_with"),
        );
    }
}

/// t² on coarse times, read between them along chords, lies (h/2)² too high in the middle of each.
#[test]
fn other_times_are_interpolated() {
    let folder = temporary();
    let path = folder.path();
    let write = |name: &str, unit: &str, factor: f64, step: f64, count: u32| {
        let mut text = format!("time_s,wedge_z_{unit},column_upper_left_state\n");
        for k in 0..count {
            let t = f64::from(k) * step;
            text.push_str(&format!("{t},{},{}\n", t * t * factor, k % 3));
        }
        fs::write(path.join(name), text).unwrap();
    };
    write("fine.csv", "in", 1.0, 0.125, 17);
    write("coarse.csv", "m", 0.0254, 0.25, 7);
    let out = done(path, &["compare", "fine.csv", "coarse.csv", "--out", "a"]);
    for text in [
        "at its 13 times from 0 s to 1.5 s",
        "Compared from 0 s to 1.5 s",
        "coarse is in SI units; its numbers are converted to those of fine, US customary.",
        "coarse has 7 rows in this span, fine has 13: it is interpolated linearly",
    ] {
        assert!(out.contains(text), "{text}: {out}");
    }
    let a = path.join("a");
    let high = 0.125_f64.powi(2);
    assert!((difference(&a, "wedge_z", "coarse", "largest_difference") - high).abs() < 1e-12);
    let middle = difference(&a, "wedge_z", "coarse", "time_s") / 0.125;
    assert_eq!(middle % 2.0, 1.0);
    let rms = (6.0 / 13.0_f64).sqrt() * high;
    assert!((difference(&a, "wedge_z", "coarse", "rms_difference") - rms).abs() < 1e-12);
    assert_eq!(names(&a), ["differences.csv", "wedge_z.svg"]);

    // Contact states are not interpolated: between 0 and 1 there is nothing.
    done(
        path,
        &[
            "compare",
            "fine.csv",
            "coarse.csv",
            "--columns",
            "column_upper_left_state",
            "--out",
            "b",
        ],
    );
    let fine = [0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0];
    let held = [0, 0, 1, 1, 2, 2, 0, 0, 1, 1, 2, 2, 0];
    let squares: i32 = fine.iter().zip(held).map(|(a, b)| (a - b) * (a - b)).sum();
    let rms = (f64::from(squares) / 13.0).sqrt();
    near(
        difference(
            &path.join("b"),
            "column_upper_left_state",
            "coarse",
            "rms_difference",
        ),
        rms,
    );

    fs::write(path.join("later.csv"), "time_s,wedge_z_in\n2,0\n3,0\n").unwrap();
    refused(
        path,
        &["compare", "fine.csv", "later.csv", "--out", "c"],
        &[
            "no span of time in common",
            "fine goes from 0 s to 2 s, later goes from 2 s to 3 s",
        ],
    );
}

#[test]
fn results_that_do_not_fit() {
    let folder = temporary();
    let path = folder.path();
    let set = ["--quiet", "--set", "simulation.duration=0.05 s"];
    done(
        path,
        &[&["run", "vdrun_toe_0_psi_0", "--out", "run"], &set[..]].concat(),
    );
    fs::write(
        path.join("rig.csv"),
        "time_s,vertical_wedge_fource_N,stroke_m\n0,1,1\n1,1,1\n",
    )
    .unwrap();
    fs::write(path.join("odd.csv"), "time_s,stroke_rad\n0,1\n1,1\n").unwrap();
    fs::write(path.join("cut.csv"), "time_s,wedge_x_in\n0,1\n0.1\n").unwrap();
    for (arguments, texts) in [
        (&["run"][..], &["RESULT", "2"][..]),
        (&["run", "run"], &["`run` is named twice"]),
        (
            &["run", "rum"],
            &["there is no result `rum`", "did you mean run?"],
        ),
        (
            &["run", "run/summary.json"],
            &["run/summary.json", "is a JSON file", "takes the folder"],
        ),
        (&["run", "run/case.toml"], &["run/case.toml", "help"]),
        (&["run", "run/result.mat"], &["is a MAT-file"]),
        (&["run", "cut.csv"], &["`cut.csv`, line 3", "cut off"]),
        (
            &["run", "rig.csv"],
            &[
                "no column in common",
                "`vertical_wedge_force` and `vertical_wedge_fource`",
            ],
        ),
        (
            &["run", "rig.csv", "--columns", "vertical_wedge_force"],
            &[
                "`rig.csv` has no column `vertical_wedge_force`",
                "did you mean vertical_wedge_fource?",
            ],
        ),
        (
            &["run", "rig.csv", "--columns", "wegde_x"],
            &["run/result.csv", "`wegde_x`", "did you mean wedge_x?"],
        ),
        (
            &["run", "rig.csv", "--columns", "time"],
            &["the time itself cannot be compared"],
        ),
        (
            &["rig.csv", "odd.csv", "--columns", "stroke"],
            &["`stroke` is a length in `rig.csv` and an angle in `odd.csv`"],
        ),
        (&["run", "rig.csv", "--out", "rig.csv"], &["no column in common"]),
    ] {
        refused(path, &[&["compare"], arguments].concat(), texts);
    }
    // Results of one name are told apart by their places.
    fs::create_dir_all(path.join("deep/run")).unwrap();
    fs::copy(path.join("run/result.csv"), path.join("deep/run/result.csv")).unwrap();
    let out = done(path, &["compare", "run", "deep/run", "--out", "same"]);
    assert!(
        out.contains("Differences from run,") && out.contains("deep/run"),
        "{out}"
    );
    near(
        difference(&path.join("same"), "wedge_x", "deep/run", "largest_difference"),
        0.0,
    );
    // One of them has no summary.
    assert!(!out.contains("energy per cycle"), "{out}");
}

/// Runs of a wedge, a truck, a half-truck, a car and a wheelset are not compared by names that happen to be
/// the same; chosen columns are. Columns of one of them alone are named.
#[test]
fn issue_047_runs_of_different_models_are_not_compared_by_name() {
    let folder = temporary();
    let path = folder.path();
    for (case, duration, out) in [
        ("vdrun_toe_0_psi_0", "0.05 s", "wedge"),
        ("vdrun_toe_0_psi_0.012", "0.05 s", "yawed"),
        ("truck_drop_constant", "0.02 s", "truck"),
    ] {
        let duration = format!("simulation.duration={duration}");
        done(path, &["run", case, "--quiet", "--set", &duration, "--out", out]);
    }
    let model = |model: &str, schema: &str, columns: &str| {
        fs::create_dir(path.join(model)).unwrap();
        let width = columns.split(',').count();
        let rows = [0.0, 0.02].map(|time| format!("{time}{}\n", ",1".repeat(width)));
        let text = format!("time_s,{columns}\n{}", rows.concat());
        fs::write(path.join(model).join("result.csv"), text).unwrap();
        let summary = format!("{{ \"schema\": \"{schema}\" }}");
        fs::write(path.join(model).join("summary.json"), summary).unwrap();
    };
    let shared = "bolster_roll_rad,stored_energy_change_lbf_in,ledger_residual_lbf_in";
    model("half_truck", "wedgelab.truck/2", shared);
    model("car", "wedgelab.car/1", shared);
    model("wheelset", "wedgelab.wheelset/1", shared);
    for (first, own) in [("wedge", "a wedge"), ("truck", "a truck")] {
        for (second, other) in [
            ("wedge", "a wedge"),
            ("truck", "a truck"),
            ("half_truck", "a half-truck"),
            ("car", "a car"),
            ("wheelset", "a wheelset"),
        ] {
            if first == second {
                continue;
            }
            for (first, own, second, other) in [(first, own, second, other), (second, other, first, own)] {
                let texts = [
                    &*format!("`{first}/result.csv` is a run of {own}"),
                    &*format!("`{second}/result.csv` one of {other}"),
                    "choose by --columns",
                    "--map NAME=OTHER",
                    "both have bolster_roll",
                ];
                refused(path, &["compare", first, second], &texts);
            }
        }
    }
    let chosen = [
        "compare",
        "wedge",
        "truck",
        "--columns",
        "bolster_roll",
        "--out",
        "roll",
    ];
    let out = done(path, &chosen);
    assert!(
        out.contains("bolster_roll") && !out.contains("ledger_residual"),
        "{out}"
    );
    // Summaries of trucks have no averages, which is no fault of theirs.
    assert!(!out.contains("cannot be read"), "{out}");

    let out = done(path, &["compare", "wedge", "yawed", "--out", "two"]);
    assert!(!out.contains(" has not: "), "{out}");
    fs::write(
        path.join("rig.csv"),
        "time_s,wedge_z_in,stroke_in,load_lbf\n0,0,1,2\n0.05,0.1,2,3\n",
    )
    .unwrap();
    let out = done(path, &["compare", "wedge", "rig.csv", "--out", "rig"]);
    assert!(out.contains("rig has, and wedge has not: stroke, load."), "{out}");
    assert!(
        out.contains("wedge has, and rig has not: bolster_vertical, ") && out.contains(" more."),
        "{out}"
    );
}

/// A column without unit is named with what to write; where nothing is left, nothing is compared.
#[test]
fn issue_047_columns_without_units_are_named() {
    let folder = temporary();
    let path = folder.path();
    let write = |name: &str, header: &str| {
        let cells = header.split(',').count();
        let row = |time: f64, value: &str| format!("{time}{}\n", format!(",{value}").repeat(cells - 1));
        fs::write(
            path.join(name),
            format!("{header}\n{}{}", row(0.0, "1"), row(1.0, "2")),
        )
        .unwrap();
    };
    write("car.csv", "time_s,speed_mph,bolster_z_in,axle_1_1_vertical_lbf");
    write("bare.csv", "time_s,speed,bolster_z");
    write("half.csv", "time_s,speed_mph,bolster_z");
    write("odd.csv", "time_s,axle_1_1_vertical_stone");
    write("timeless.csv", "time,speed_mph");
    for (first, second) in [("car.csv", "bare.csv"), ("bare.csv", "car.csv")] {
        refused(
            path,
            &["compare", first, second],
            &[
                "can be compared: `speed` has no unit in `bare.csv`, and is a speed in `car.csv`; ",
                "`bolster_z` has no unit",
                "write speed_",
                "bolster_z_in or bolster_z_m",
            ],
        );
    }
    refused(
        path,
        &["compare", "car.csv", "bare.csv", "--columns", "bolster_z"],
        &[
            "`bolster_z` has no unit in `bare.csv`, and is a length in `car.csv`",
            "write bolster_z_in or bolster_z_m",
        ],
    );
    let out = done(path, &["compare", "car.csv", "half.csv", "--out", "half"]);
    assert!(
        out.contains("`bolster_z` has no unit in `half.csv`")
            && out.contains("left out: write bolster_z_in or"),
        "{out}"
    );
    assert!(
        out.contains("car has, and half has not: axle_1_1_vertical."),
        "{out}"
    );
    near(
        difference(&path.join("half"), "speed", "half", "largest_difference"),
        0.0,
    );
    refused(
        path,
        &["compare", "car.csv", "odd.csv"],
        &[
            "no column in common",
            "the unit `stone` of `axle_1_1_vertical_stone` is not known",
            "write axle_1_1_vertical_lbf or axle_1_1_vertical_N",
        ],
    );
    let output = wedgelab(path, &["compare", "car.csv", "timeless.csv"]);
    assert!(
        output.code == Some(2) && output.err.contains("write time_s"),
        "{}",
        output.err
    );
    assert!(!output.err.contains("time_s or time_s"), "{}", output.err);
}

/// A first result that hardly moves has no percentages of its range in the table.
#[test]
fn issue_047_percentages_beyond_all_measure_are_not_printed() {
    let folder = temporary();
    let path = folder.path();
    fs::write(path.join("still.csv"), "time_s,stroke_in\n0,0\n1,1e-6\n").unwrap();
    fs::write(path.join("moving.csv"), "time_s,stroke_in\n0,0\n1,2\n").unwrap();
    let out = done(path, &["compare", "still.csv", "moving.csv"]);
    assert!(out.contains("> 10000") && !out.contains("199999900"), "{out}");
}

/// Names of others may hold what no file is to be named.
#[test]
fn odd_names_stay_in_the_folder() {
    let folder = temporary();
    let path = folder.path();
    let text = "time_s,../up_m,.._up_m,\"a,b_m\",hysteresis_m\n0,1,2,3,4\n1,2,3,4,5\n";
    fs::write(path.join("a.csv"), text).unwrap();
    fs::write(path.join("b.csv"), text).unwrap();
    done(path, &["compare", "a.csv", "b.csv"]);
    assert_eq!(names(path), ["a.csv", "b.csv", "comparison"]);
    assert_eq!(
        names(&path.join("comparison")),
        [
            "____up.svg",
            "___up.svg",
            "_hysteresis.svg",
            "a_b.svg",
            "differences.csv"
        ]
    );
    let table = fs::read_to_string(path.join("comparison/differences.csv")).unwrap();
    assert!(table.contains("\n\"a,b\",m,b,a,0,"), "{table}");
    done(path, &["plot", "a.csv", "--x", "../up", "--y", "a,b"]);
    assert!(path.join("a_b_over____up.svg").exists());
}

#[test]
fn plots() {
    let folder = temporary();
    let path = folder.path();
    let set = ["--quiet", "--set", "simulation.duration=0.05 s"];
    done(
        path,
        &[&["run", "vdrun_toe_0_psi_0", "--out", "run"], &set[..]].concat(),
    );
    let out = done(path, &["plot", "run", "--x", "time", "--y", "wedge_z_in"]);
    assert!(out.contains("wedge_z_over_time.svg"), "{out}");
    let svg = fs::read_to_string(path.join("wedge_z_over_time.svg")).unwrap();
    assert!(svg.contains("time (s)") && svg.contains("wedge z (in)"));

    let call = |file: &'static str| {
        [
            "plot",
            "run/result.csv",
            "--x",
            "bolster_vertical",
            "--y",
            "coil_force",
            "coil_length",
            "--out",
            file,
        ]
    };
    done(path, &call("new/both.svg"));
    let svg = fs::read_to_string(path.join("new/both.svg")).unwrap();
    for text in [
        "bolster vertical (in)",
        "coil force (lbf)",
        "coil length (in)",
        "coil force, coil length of the result run over bolster vertical, all 6 rows",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    refused(path, &call("new/both.svg"), &["new/both.svg", "--force"]);
    done(path, &[&call("new/both.svg")[..], &["--force"]].concat());

    refused(path, &call("both.pdf"), &["`both.pdf`", "--out both.svg"]);
    done(path, &call("both.png"));
    assert!(fs::read(path.join("both.png")).unwrap().starts_with(b"\x89PNG"));
    refused(path, &call("both"), &["--out both.svg"]);
    for (x, y, texts) in [
        ("tme", "wedge_z", ["no column `tme`", "did you mean time?"]),
        (
            "time",
            "wegde_z",
            ["no column `wegde_z`", "did you mean wedge_z?"],
        ),
        (
            "time",
            "yaw_moment",
            ["no column `yaw_moment`", "side_frame_yaw_moment"],
        ),
    ] {
        refused(path, &["plot", "run", "--x", x, "--y", y], &texts);
    }
    refused(path, &["plot", "run", "--x", "time"], &["--y"]);
    refused(
        path,
        &["plot", "rum", "--x", "time", "--y", "wedge_z"],
        &["did you mean run?"],
    );
}
