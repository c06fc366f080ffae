//! Results by need: formats, columns and sizes of a run's files, and who reads them.

use crate::common;
use std::fs;
use std::path::Path;

use common::wedgelab;
use parquet::file::reader::{FileReader, SerializedFileReader};
use report::table::ResultTable;

/// A short run from the equilibrium: shaking a car takes ten times as long as the rest.
const CAR: [&str; 6] = [
    "--set",
    "simulation.duration=0.5 s",
    "--set",
    "start.settle=0 s",
    "--set",
    "start.kind=equilibrium",
];

/// Runs a car into a folder with these arguments besides; returns what it printed.
#[track_caller]
fn run(at: &Path, out: &str, more: &[&str]) -> String {
    let own = ["run", "car_pitch_and_bounce_loaded", "-q", "--out", out];
    let done = wedgelab(at, &[&own[..], &CAR, more].concat());
    assert_eq!(done.code, Some(0), "{}", done.err);
    done.out
}

fn columns(file: &Path) -> usize {
    ResultTable::read(file).unwrap().columns().len()
}

/// All is in the Parquet file, a few columns in the CSV file; the last line says how large they are.
#[test]
fn issue_048_a_car_is_written_as_parquet_and_a_short_csv() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let out = run(at, "a", &[]);
    for part in [
        "result.parquet (",
        "result.csv (",
        " kB)",
        " in all; open index.html",
    ] {
        assert!(out.contains(part), "{part}: {out}");
    }
    let head = fs::read_to_string(at.join("a/result.csv")).unwrap();
    assert_eq!(
        head.lines().next(),
        Some("time_s,distance_ft,speed_mph,body_roll_rad")
    );
    assert!(!at.join("a/result.mat").exists());
    let file = fs::File::open(at.join("a/result.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    assert_eq!(reader.metadata().file_metadata().num_rows(), 101);
    // The same numbers as a CSV file of all columns, to the bit, and the same bytes again.
    run(at, "b", &["--tables", "csv,mat,parquet", "--csv-columns", "*"]);
    let [parquet, csv] = ["result.parquet", "result.csv"].map(|name| at.join("b").join(name));
    assert_eq!(
        fs::read(&parquet).unwrap(),
        fs::read(at.join("a/result.parquet")).unwrap()
    );
    let [parquet, csv] = [parquet, csv].map(|file| ResultTable::read(&file).unwrap());
    assert!(parquet.columns().len() > 170);
    assert_eq!(parquet.columns(), csv.columns());
    for (one, other) in parquet.columns().iter().zip(csv.columns()) {
        let bits = |values: &[f64]| values.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&one.written), bits(&other.written), "{}", one.name);
    }
    assert!(at.join("b/result.mat").is_file());
}

/// A folder's other readers take the Parquet file, which has all columns.
#[test]
fn issue_048_who_reads_a_folder_reads_its_parquet() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, "a", &[]);
    run(at, "b", &["--set", "speed.value=50 mph"]);
    for arguments in [
        &["compare", "a", "b", "--columns", "axle_1_left_vertical"][..],
        &[
            "compare",
            "a",
            "b/result.parquet",
            "--columns",
            "truck_1_warp_angle",
            "--force",
        ],
        &["plot", "a", "--x", "distance", "--y", "axle_1_left_vertical"],
        &["report", "a", "b", "--out", "both"],
    ] {
        let done = wedgelab(at, arguments);
        assert_eq!(done.code, Some(0), "{arguments:?}: {}", done.err);
    }
    let page = fs::read_to_string(at.join("both/index.html")).unwrap();
    assert!(page.contains("result.parquet"));
    // Without a Parquet file the CSV file has all, and is read.
    run(at, "c", &["--tables", "csv"]);
    assert!(!at.join("c/result.parquet").exists());
    assert_eq!(columns(&at.join("c")), columns(&at.join("a")));
    // A damaged file is no result.
    let file = at.join("a/result.parquet");
    let whole = fs::read(&file).unwrap();
    for bytes in [
        &whole[..whole.len() / 2],
        &[&whole[..2000], &whole[2100..]].concat(),
        b"PAR1PAR1",
    ] {
        fs::write(&file, bytes).unwrap();
        let done = wedgelab(
            at,
            &["plot", "a", "--x", "distance", "--y", "body_roll", "--force"],
        );
        assert_eq!(done.code, Some(2), "{}", done.err);
        assert!(done.err.contains("result.parquet"), "{}", done.err);
    }
}

/// Columns are chosen by name or pattern, in the case and by option; what fits nothing is refused before the
/// run.
#[test]
fn issue_048_columns_are_chosen_by_pattern() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, "a", &["--columns", "axle_1_*_vertical", "body_roll_rad"]);
    let table = ResultTable::read(&at.join("a")).unwrap();
    let names: Vec<&str> = table.columns().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "time",
            "axle_1_left_vertical",
            "axle_1_right_vertical",
            "body_roll"
        ]
    );
    let csv = fs::read_to_string(at.join("a/result.csv")).unwrap();
    assert_eq!(csv.lines().next(), Some("time_s,body_roll_rad"));
    let key = "output.columns=[\"*_acceleration_filtered\"]";
    run(at, "b", &["--set", key]);
    assert_eq!(columns(&at.join("b")), 5);
    let case = fs::read_to_string(at.join("b/case.toml")).unwrap();
    assert!(case.contains("columns = [\"*_acceleration_filtered\"]"), "{case}");
    for (pattern, advice) in [
        ("axle_1_left_vertial", "did you mean axle_1_left_vertical?"),
        ("axle_9_*", "columns are axle_1_left_vertical"),
    ] {
        let own = [
            "run",
            "car_pitch_and_bounce_loaded",
            "--out",
            "c",
            "--columns",
            pattern,
        ];
        let done = wedgelab(at, &own);
        assert_eq!(done.code, Some(2), "{}", done.err);
        assert!(
            done.err.contains(&format!("fits `{pattern}`")) && done.err.contains(advice),
            "{}",
            done.err
        );
        assert!(!at.join("c").exists());
    }
    let own = ["run", "car_pitch_and_bounce_loaded", "--tables", "parket"];
    let done = wedgelab(at, &own);
    assert!(
        done.code == Some(2) && done.err.contains("did you mean parquet?"),
        "{}",
        done.err
    );
}

/// A table that an earlier run left is not beside the tables of another one.
#[test]
fn issue_048_tables_of_an_earlier_run_do_not_stay() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let wedge = [
        "run",
        "vdrun_toe_0_psi_0",
        "-q",
        "--out",
        "a",
        "--set",
        "simulation.duration=0.1 s",
    ];
    let run = |more: &[&str]| wedgelab(at, &[&wedge[..], more].concat());
    assert_eq!(run(&[]).code, Some(0));
    assert!(at.join("a/result.csv").is_file() && at.join("a/result.mat").is_file());
    let refused = run(&["--tables", "parquet"]);
    assert!(
        refused.code == Some(2) && refused.err.contains("--force"),
        "{}",
        refused.err
    );
    assert_eq!(run(&["--tables", "parquet", "--force"]).code, Some(0));
    assert!(!at.join("a/result.csv").exists() && !at.join("a/result.mat").exists());
    assert_eq!(columns(&at.join("a")), 133);
}

/// Parts of a run are the whole run, row by row.
#[test]
fn issue_048_parts_of_a_run_join_in_parquet() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, "whole", &[]);
    run(at, "first", &["--save", "state.json", "--until", "0.2 s"]);
    run(at, "second", &["--continue", "state.json"]);
    let [whole, first, second] =
        ["whole", "first", "second"].map(|own| ResultTable::read(&at.join(own)).unwrap());
    for ((whole, first), second) in whole.columns().iter().zip(first.columns()).zip(second.columns()) {
        let joined = [&first.written[..], &second.written].concat();
        assert_eq!(joined.len(), whole.written.len());
        let same = joined
            .iter()
            .zip(&whole.written)
            .all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{}", whole.name);
    }
}

/// The built-in car of 27 s. On its way 19 MB would be its columns as CSV alone.
#[test]
#[ignore = "takes a minute; run by name"]
fn issue_048_a_car_of_27_s_takes_less_than_8_mb() {
    let folder = tempfile::tempdir().unwrap();
    let done = wedgelab(
        folder.path(),
        &["run", "car_twist_and_roll_loaded", "-q", "--out", "a"],
    );
    assert_eq!(done.code, Some(0), "{}", done.err);
    let files = fs::read_dir(folder.path().join("a")).unwrap();
    let bytes: u64 = files.map(|file| file.unwrap().metadata().unwrap().len()).sum();
    assert!(bytes < 8_000_000, "{bytes}");
}

/// `quasi-static` writes its numbers into a folder.
#[test]
fn issue_048_quasi_static_writes_its_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let done = wedgelab(at, &["quasi-static", "--out", "a"]);
    assert!(
        done.code == Some(0) && done.out.contains("Written into a: quasi_static.json."),
        "{}",
        done.out
    );
    let printed = wedgelab(at, &["quasi-static", "--json", "--out", "b"]);
    let [a, b] = ["a", "b"].map(|own| fs::read_to_string(at.join(own).join("quasi_static.json")).unwrap());
    assert_eq!((a.as_str(), printed.out.as_str()), (b.as_str(), b.as_str()));
    let again = wedgelab(at, &["quasi-static", "--out", "a"]);
    assert!(
        again.code == Some(2) && again.err.contains("--force"),
        "{}",
        again.err
    );
    assert_eq!(
        wedgelab(at, &["quasi-static", "--out", "a", "--force"]).code,
        Some(0)
    );
}

/// A pattern makes files of their own, or is refused.
#[test]
fn issue_048_several_cases_are_several_files() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let refused = wedgelab(at, &["case", "cdr*"]);
    assert!(
        refused.code == Some(2) && refused.out.is_empty(),
        "{}",
        refused.out
    );
    assert!(
        refused.err.contains("6 cases fit `cdr*`") && refused.err.contains("--out"),
        "{}",
        refused.err
    );
    assert_eq!(wedgelab(at, &["case", "cdr*", "--out", "cases"]).code, Some(0));
    assert_eq!(fs::read_dir(at.join("cases")).unwrap().count(), 6);
}

/// Rows that are too far apart for the filter have no margins; one row has no statistics, and why.
#[test]
fn issue_048_rows_too_far_apart_have_no_margins() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let car = [
        "run",
        "car_tangent_loaded",
        "-q",
        "--set",
        "simulation.output_interval=1 s",
    ];
    let own = [
        "--set",
        "simulation.duration=3 s",
        "--set",
        "start.settle=0 s",
        "--out",
        "a",
    ];
    let done = wedgelab(at, &[&car[..], &own].concat());
    assert!(
        done.out.contains("Values without margin are raw"),
        "{} {}",
        done.out,
        done.err
    );
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(at.join("a/summary.json")).unwrap()).unwrap();
    let limits = summary["limits"].as_array().unwrap();
    let unfiltered = |limit: &&serde_json::Value| limit["unfiltered"] == true;
    assert_eq!(
        limits.iter().filter(unfiltered).count() + 1,
        limits.len(),
        "all but the roll"
    );
    let own = [
        "--set",
        "simulation.duration=1 s",
        "--set",
        "start.settle=1 s",
        "--out",
        "b",
    ];
    let done = wedgelab(at, &[&car[..], &own].concat());
    assert!(
        done.out
            .contains("No statistics: from the settling time of 1 s on the run has one row"),
        "{}",
        done.out
    );
    let own = [
        "--set",
        "simulation.duration=1 s",
        "--set",
        "start.settle=2 s",
        "--out",
        "c",
    ];
    let done = wedgelab(at, &[&car[..], &own].concat());
    let why = "No statistics: the run does not reach beyond the settling time of 2 s";
    assert!(done.out.contains(why), "{} {}", done.out, done.err);
}

/// Stability is that on straight track, and says so where the case has another one.
#[test]
fn issue_048_stability_says_that_curves_do_not_count() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let own = "--speeds\t30 mph..50 mph\t--steps\t2\t-q\t--set\tstart.kind=equilibrium";
    let own: Vec<&str> = own.split('\t').collect();
    for (case, words) in [
        (
            "car_constant_curve_loaded",
            Some("the curves of its track do not count"),
        ),
        ("car_hunting_empty", None),
    ] {
        let done = wedgelab(at, &[&["stability", case, "--out", case], &own[..]].concat());
        assert_eq!(done.code, Some(0), "{}", done.err);
        assert_eq!(done.out.contains("do not count"), words.is_some(), "{}", done.out);
        let numbers = fs::read_to_string(at.join(case).join("stability.json")).unwrap();
        let numbers: serde_json::Value = serde_json::from_str(&numbers).unwrap();
        assert_eq!(numbers["left_out"].as_str(), words);
    }
}
