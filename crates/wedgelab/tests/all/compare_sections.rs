//! `wedgelab compare --sections`, as a user calls it.

use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::{done, wedgelab};

/// Writes a result of 260 m at a speed: a force that goes up and down once in each 20 m, about a mean that
/// `mean` gives for each 20 m, in kN.
fn write(folder: &Path, name: &str, [speed, step]: [f64; 2], us: bool, mean: impl Fn(usize) -> f64) {
    let (distance, force, feet, pounds) = match us {
        true => ("distance_ft", "side_force_lbf", 0.3048, 4.448_221_615_260_5),
        false => ("distance_m", "side_force_N", 1.0, 1.0),
    };
    let mut text = format!("time_s,{distance},{force}\n");
    let rows = (260.0 / step).round() as usize;
    for row in 0..=rows {
        let place = row as f64 * step;
        let phase = (place / 20.0).fract();
        // A triangle: 1 kN at a quarter, -1 kN at three quarters.
        let triangle = 1.0 - 4.0 * ((phase + 0.25).fract() - 0.5).abs();
        let own = 1000.0 * (mean((place / 20.0) as usize) - triangle);
        text.push_str(&format!("{},{},{}\n", place / speed, place / feet, own / pounds));
    }
    fs::write(folder.join(name), text).unwrap();
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn rows(folder: &Path, name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join(name)).unwrap();
    let lines = text.lines();
    lines
        .map(|line| line.split(',').map(str::to_owned).collect())
        .collect()
}

fn answer(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&done(folder, arguments)).unwrap()
}

fn near(found: &Value, expected: f64, tolerance: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - expected).abs() <= tolerance, "{found} {expected}");
}

/// A model in other units, at another speed and other rows, with 0.25 kN more in each second section and 0.25
/// kN less in the others, has a mean difference of 0.25/13 kN and the deviation of a turning offset.
#[test]
fn analytic_a_model_with_turning_offsets_has_their_mean_and_deviation() {
    let folder = folder();
    let path = folder.path();
    let turn = |own: usize| if own.is_multiple_of(2) { 0.25 } else { -0.25 };
    // Steps lie on the ends of the sections and on the peaks; the jump between two sections takes one step.
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    write(path, "model.csv", [25.0, 0.25], true, |own| 10.0 + turn(own));
    let out = done(
        path,
        &[
            "compare",
            "measured.csv",
            "model.csv",
            "--sections",
            "20 m",
            "--out",
            "a",
        ],
    );
    for text in [
        "Differences from measured in 13 sections over distance, from 0 m to 260 m",
        "side_force   N      model    mean",
        "model is in US customary units; its numbers are converted",
        "Written into a: section_statistics.csv, sections.csv, sections_side_force.svg",
    ] {
        assert!(out.contains(text), "{text}: {out}");
    }
    assert!(!out.contains("< 12"), "{out}");
    let found = answer(
        path,
        &[
            "compare",
            "measured.csv",
            "model.csv",
            "--sections",
            "13",
            "--out",
            "b",
            "--json",
        ],
    );
    assert_eq!(found["along"], "distance");
    let [mean, most, rms] = [0, 1, 2].map(|row| &found["rows"][row]);
    // The last of 80 steps of a section goes over into the next offset: half of 0.5 kN over 1/80 of it.
    let offsets: Vec<f64> = (0..13)
        .map(|own| 1000.0 * turn(own) * (1.0 - 1.0 / 80.0))
        .collect();
    let middle = offsets.iter().sum::<f64>() / 13.0;
    let squares: f64 = offsets.iter().map(|own| (own - middle).powi(2)).sum();
    near(&mean["mean"], middle, 1e-6);
    near(&mean["standard_deviation"], (squares / 12.0).sqrt(), 1e-6);
    near(&mean["mean_size_of_first"], 10_000.0, 1e-6);
    near(&mean["mean_percent"], middle / 100.0, 1e-9);
    // The triangle's 99.85 % lie 0.15 % below its height of 2 kN.
    near(&most["values_of_first"][3], 11_000.0 - 0.0015 * 2000.0, 1e-6);
    near(&rms["values_of_first"][3], 1000.0 / 3.0_f64.sqrt(), 1e-6);
    assert_eq!(rms["quantity"], "rms");
    assert_eq!(mean["verdict"], Value::Null);

    let table = rows(&path.join("a"), "sections.csv");
    assert_eq!(table.len(), 1 + 3 * 13);
    assert_eq!(
        table[0].join(","),
        "column,unit,quantity,result,compared_with,section,from_m,to_m,value_of_compared_with,value,\
         difference"
    );
    assert_eq!(
        table[2][..8].join(","),
        "side_force,N,mean,model,measured,2,20,40"
    );
    let statistics = rows(&path.join("a"), "section_statistics.csv");
    let cell: f64 = statistics[1][8].parse().unwrap();
    assert_eq!((statistics[0][8].as_str(), statistics.len()), ("mean_percent", 4));
    assert!((cell - middle / 100.0).abs() < 1e-9, "{cell}");
    let svg = fs::read_to_string(path.join("a/sections_side_force.svg")).unwrap();
    for text in ["measured (N)", "equal", "rms"] {
        assert!(svg.contains(text), "{text}");
    }
}

/// Fewer than 12 sections are told on the standard error, in the table and in the document.
#[test]
fn few_sections_and_few_rows_are_told() {
    let folder = folder();
    let path = folder.path();
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    write(path, "model.csv", [20.0, 4.0], false, |_| 12.0);
    let arguments = ["compare", "measured.csv", "model.csv", "--sections", "60 m"];
    let output = wedgelab(path, &arguments);
    assert_eq!(output.code, Some(0), "{}", output.err);
    for text in [
        "warning: 4 sections are fewer than 12",
        "sections of 21.6667 m would give 12",
        "warning: model has 16 rows in section 1 (0 m to 60 m)",
    ] {
        assert!(output.err.contains(text), "{text}: {}", output.err);
    }
    assert!(output.out.contains("4 (< 12)"), "{}", output.out);
    assert!(
        output.out.contains("The last 20 m are shorter than a section"),
        "{}",
        output.out
    );
    let found = answer(path, &[&arguments[..], &["--force", "--json"]].concat());
    assert_eq!(found["fewer_than_12"], true);
    assert_eq!(found["warnings"].as_array().unwrap().len(), 2);
    // A constant offset in the same rows of both leaves no deviation of the means.
    near(&found["rows"][0]["mean"], 2000.0, 20.0);
}

/// Without a distance in both, or by times, sections are cut over the time; a file's sections beyond a result
/// are left out and named.
#[test]
fn sections_are_over_time_where_no_distance_is_and_by_files() {
    let folder = folder();
    let path = folder.path();
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    let text = fs::read_to_string(path.join("measured.csv")).unwrap();
    let without: String = text
        .lines()
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            format!("{},{}\n", cells[0], cells[2])
        })
        .collect();
    fs::write(path.join("timed.csv"), without).unwrap();
    let compare = |sections: &str, out: &str| {
        answer(
            path,
            &[
                "compare",
                "measured.csv",
                "timed.csv",
                "--sections",
                sections,
                "--out",
                out,
                "--json",
            ],
        )
    };
    let found = compare("13", "a");
    assert_eq!(
        (&found["along"], &found["sections"]["unit"]),
        (&"time".into(), &"s".into())
    );
    near(&found["rows"][0]["standard_deviation"], 0.0, 1e-9);
    assert_eq!(compare("0.5 s", "b")["sections"]["to"][25], 13.0);
    let mut listed = "from [s], to [s]\n".to_owned();
    (0..13).for_each(|own| listed.push_str(&format!("{own},{}\n", own + 1)));
    listed.push_str("13,14\n14,15\n");
    fs::write(path.join("own.csv"), listed).unwrap();
    let found = compare("own.csv", "c");
    assert_eq!(found["sections"]["from"].as_array().unwrap().len(), 13);
    let notes = found["notes"].to_string();
    assert!(
        notes.contains("2 sections of the file") && notes.contains("number 14, 15"),
        "{notes}"
    );
}

#[test]
fn differences_are_accepted_by_the_users_limits() {
    let folder = folder();
    let path = folder.path();
    let turn = |own: usize| if own.is_multiple_of(2) { 1.0 } else { -1.0 };
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    write(path, "model.csv", [20.0, 0.5], false, |own| 10.5 + turn(own));
    let accept = |limits: &str, out: &'static str| {
        let text = format!("source = \"letter of March\"\n[accept.side_force]\n{limits}");
        fs::write(path.join("limits.toml"), text).unwrap();
        let out = ["--accept", "limits.toml", "--out", out];
        [
            &["compare", "measured.csv", "model.csv", "--sections", "13"],
            &out[..],
        ]
        .concat()
    };
    // Mean differences are 0.58 kN on average, with a deviation of 1.0 kN.
    for (out, limits, verdict) in [
        ("a", "mean = \"1.1 kN\"\n", "accepted"),
        ("b", "mean = \"0.9 kN\"\n", "deviation too large"),
        ("c", "mean = \"0.8 kN\"\n", "mean and deviation too large"),
    ] {
        let found = answer(path, &[&accept(limits, out)[..], &["--json"]].concat());
        assert_eq!(found["rows"][0]["verdict"], verdict);
        assert_eq!(found["rows"][1]["verdict"], Value::Null);
    }
    let out = done(path, &accept("mean = \"1.1 kN\"\nrms = \"300 lbf\"\n", "d"));
    for text in [
        "verdict",
        "1100   accepted",
        "no limit",
        "Limits: letter of March.",
        "two thirds",
    ] {
        assert!(out.contains(text), "{text}: {out}");
    }
}

/// Two curves to different sides: what cancels is told.
#[test]
fn measured_means_of_both_signs_are_told() {
    let folder = folder();
    let path = folder.path();
    let side = |own: usize| if own < 6 { 10.0 } else { -10.0 };
    write(path, "measured.csv", [20.0, 0.5], false, side);
    write(path, "model.csv", [20.0, 0.5], false, |own| 0.9 * side(own));
    let out = done(
        path,
        &["compare", "measured.csv", "model.csv", "--sections", "13"],
    );
    assert!(out.contains("Measured means of both signs: side_force"), "{out}");
    write(path, "model.csv", [20.0, 0.5], false, |_| 9.0);
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    let out = done(
        path,
        &[
            "compare",
            "measured.csv",
            "model.csv",
            "--sections",
            "13",
            "--force",
        ],
    );
    assert!(!out.contains("both signs"), "{out}");
}

#[test]
fn input_what_cannot_be_cut_is_refused_without_a_trace() {
    let folder = folder();
    let path = folder.path();
    write(path, "measured.csv", [20.0, 0.5], false, |_| 10.0);
    write(path, "coarse.csv", [20.0, 13.0], false, |_| 10.0);
    fs::write(
        path.join("back.csv"),
        "time_s,distance_m,side_force_N\n0,0,1\n1,9,1\n2,8,1\n3,20,1\n",
    )
    .unwrap();
    fs::write(
        path.join("late.csv"),
        "time_s,distance_m,side_force_N\n0,900,1\n1,990,1\n",
    )
    .unwrap();
    fs::write(
        path.join("timed.csv"),
        "time_s,distanc_m,side_force_N\n0,900,1\n1,990,1\n",
    )
    .unwrap();
    fs::write(
        path.join("bare.csv"),
        "time_s,distance,side_force_N\n0,900,1\n1,990,1\n",
    )
    .unwrap();
    let huge = (0..27).map(|row| format!("{row},{},{}1e200\n", 10 * row, if row < 13 { "" } else { "-" }));
    let huge = format!("time_s,distance_m,side_force_N\n{}", huge.collect::<String>());
    fs::write(path.join("huge.csv"), huge).unwrap();
    fs::write(
        path.join("wrong.toml"),
        "source = \"x\"\n[accept.side_forse]\nmean = \"1 N\"\n",
    )
    .unwrap();
    fs::write(
        path.join("unit.toml"),
        "source = \"x\"\n[accept.side_force]\nmean = \"1 m\"\n",
    )
    .unwrap();
    fs::write(path.join("table.toml"), "time_s,distance_m,side_force_N\n0,0,1\n").unwrap();
    let before = fs::read_dir(path).unwrap().count();
    let refused = |other: &str, rest: &[&str], texts: &[&str]| {
        let output = wedgelab(path, &[&["compare", "measured.csv", other], rest].concat());
        assert_eq!(output.code, Some(2), "{rest:?}: {}", output.err);
        for text in texts {
            assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
        }
        assert_eq!(fs::read_dir(path).unwrap().count(), before, "{rest:?}");
    };
    refused("coarse.csv", &["--sections", "1"], &["from 2 to 10000"]);
    refused(
        "coarse.csv",
        &["--sections", "200 m"],
        &["1 section in common", "sections of 21.6667 m"],
    );
    refused(
        "coarse.csv",
        &["--sections", "5 m"],
        &["0 rows in section", "longer sections"],
    );
    refused(
        "back.csv",
        &["--sections", "12"],
        &["falls from 9 m to 8 m at its row 3", "\"2 s\""],
    );
    refused(
        "late.csv",
        &["--sections", "12"],
        &["late goes from 900 m to 990 m"],
    );
    refused(
        "timed.csv",
        &["--sections", "9 m"],
        &["no column `distance`", "--map distance=distanc"],
    );
    refused(
        "bare.csv",
        &["--sections", "9 m"],
        &["no column `distance` with a unit", "distance_ft or distance_m"],
    );
    refused("huge.csv", &["--sections", "2"], &["is not finite", "side_force"]);
    refused(
        "coarse.csv",
        &["--sections", "2", "--columns", "distance"],
        &["cut along `distance`"],
    );
    refused("coarse.csv", &["--sections", "none.csv"], &["none.csv"]);
    refused(
        "coarse.csv",
        &["--sections", "4 lbf"],
        &["no length or time", "--sections 12"],
    );
    refused("coarse.csv", &["--accept", "unit.toml"], &["--sections"]);
    refused(
        "coarse.csv",
        &["--sections", "2", "--accept", "wrong.toml"],
        &["side_forse", "did you mean `side_force`"],
    );
    refused(
        "coarse.csv",
        &["--sections", "2", "--accept", "unit.toml"],
        &["unit.toml", "a force"],
    );
    refused(
        "coarse.csv",
        &["--sections", "2", "--accept", "table.toml"],
        &["is a table of results"],
    );
    refused(
        "coarse.csv",
        &["--sections", "2", "--accept", "none.toml"],
        &["none.toml"],
    );
}
