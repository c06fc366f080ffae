//! `wedgelab nucars`, as a user calls it.

use std::fs;
use std::path::Path;
use std::process::Command;

use nucars::builtin;
use tempfile::TempDir;

struct Output {
    code: Option<i32>,
    out: String,
    err: String,
}

fn wedgelab(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    let output = command
        .current_dir(folder)
        .arg("nucars")
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    let output = Output {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(
        !output.err.contains("panicked") && !output.err.contains('\u{1b}'),
        "{}",
        output.err
    );
    output
}

/// Returns a folder with the printed files, some of them changed.
fn folder(changes: &[(&str, &str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in builtin::names() {
        let mut text = builtin::text(name).unwrap().to_owned();
        for (file, old, new) in changes {
            if *file == name {
                assert!(text.contains(old), "{old:?}");
                text = text.replacen(old, new, 1);
            }
        }
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

#[track_caller]
fn contains(text: &str, pieces: &[&str]) {
    for piece in pieces {
        assert!(text.contains(piece), "{piece:?} is not in:\n{text}");
    }
}

const CONSTANT: &str = "Bolst_wedge_sf_68_constant.sys";
const YAW_RUN: &str = "Bolst_wedge_sf_bolst-vert-displ-w-yaw_68_constant.run";

#[test]
fn a_system_with_doubts_only_is_no_failure() {
    let folder = folder(&[]);
    let output = wedgelab(folder.path(), &["check", CONSTANT]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.out,
        &["Bolst_wedge_sf_68_constant.sys: system file, 0 errors, 4 warnings, 0 notes"],
    );
    // File, line and column, the text, what is wrong and what to do.
    contains(
        &output.err,
        &[
            "[Bolst_wedge_sf_68_constant.sys:92:60]",
            "216 'Cntr Yaw Disp  '    1  1  8   -35.0     0.0    18.0   6 21",
            "connection 216 cannot yaw body 1",
            "help: of a commanded yaw only one part in",
        ],
    );
}

#[test]
fn a_run_is_checked_with_the_files_it_names() {
    let folder = folder(&[]);
    // Neither its data file nor its input file is spelt as the files are.
    let output = wedgelab(folder.path(), &["check", YAW_RUN]);
    assert_eq!(output.code, Some(2));
    contains(
        &output.err,
        &[
            "the data file is missing: there is no file `sngl_trk.DAT`",
            "did you mean 'sngl_trk_68.dat'? There are also sngl_trk_69.dat.",
            "the input file is missing: there is no file `bolst_displ_input_36.INP`",
            "did you mean 'bolst_displ_input36.inp'?",
            "--input takes another file",
        ],
    );
    contains(
        &output.out,
        &[
            "run file, 2 errors",
            "Bolst_wedge_sf_68_constant.sys: system file, 0 errors",
        ],
    );

    let options = [
        "--data",
        "sngl_trk_68.dat",
        "--input",
        "bolst_displ_input36.inp",
        "--no-notes",
    ];
    let output = wedgelab(folder.path(), &[&["check", YAW_RUN], &options[..]].concat());
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.err,
        &["history 6 asks for a yaw of 0.012 rad, of which 3.844e-6 rad arrive at body 1"],
    );
    contains(
        &output.err,
        &[
            "the count of sums is 2, but 6 stand here",
            "the comment before history 3 says null",
        ],
    );
    assert!(!output.err.contains("switched off"), "{}", output.err);
    assert_eq!(output.out.lines().count(), 4, "{}", output.out);

    // The data file of the other system asks for components that are not there.
    let options = ["--data", "sngl_trk_69.dat", "--input", "bolst_displ_input36.inp"];
    let output = wedgelab(folder.path(), &[&["check", YAW_RUN], &options[..]].concat());
    assert_eq!(output.code, Some(2));
    contains(
        &output.err,
        &["connection 127 has 2 components, not 3", "switched off"],
    );
}

#[test]
fn the_only_files_of_their_kinds_belong_together() {
    let folder = folder(&[]);
    let output = wedgelab(folder.path(), &["check", "sngl_trk_69.dat", "--system", CONSTANT]);
    assert_eq!(output.code, Some(2));
    contains(&output.err, &["connection 127 has 2 components, not 3"]);
    let output = wedgelab(
        folder.path(),
        &[
            "check",
            "sngl_trk_69.dat",
            "bolst_wedge_sf_69_const.sys",
            "bolst_displ_input36.inp",
        ],
    );
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.err,
        &["127.2 in x to 119.1 in y", "of which 3.844e-6 rad arrive"],
    );
}

#[test]
fn all_mistakes_are_reported_at_once() {
    let changes = [
        (CONSTANT, "319.175", "heavy"),
        (CONSTANT, "\n50\n", "\n51\n"),
        (
            CONSTANT,
            "0.0        0.042        1.042",
            "0.0        1.042        0.042",
        ),
        (CONSTANT, "   8   11   12", "   8   77   12"),
    ];
    let folder = folder(&changes);
    let output = wedgelab(folder.path(), &["check", CONSTANT]);
    assert_eq!(output.code, Some(2));
    contains(
        &output.err,
        &[
            "`heavy` is not a number",
            "expected the mass (lb·s²/in) of body 1",
            "the count is 51, but 50 connections follow",
            "0.042 comes after 1.042",
            "characteristic 8 refers to function 77",
        ],
    );
    contains(&output.out, &["system file, 4 errors"]);
}

#[test]
fn a_system_is_shown_as_tables() {
    let folder = folder(&[]);
    let output = wedgelab(folder.path(), &["show", "BOLST_WEDGE_SF_69_VAR.SYS"]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.out,
        &[
            "type 6.9\n",
            "lb·s²/in",
            "Half Car+Bolst",
            "stick-slip wedge, 3 directions   1 - 3   z, x, y",
            "variable        leading",
            "Functions (linear between the points and on beyond them)",
            "lb over in/s",
            "in over in",
            "-0.0034907",
        ],
    );
    let rows = output
        .out
        .lines()
        .filter(|line| line.contains(" 1 - ") || line.contains(" 3 - ") || line.contains(" 4 - "));
    assert_eq!(rows.count(), 50);
}

#[test]
fn wrong_calls_are_refused() {
    let folder = folder(&[(CONSTANT, "319.175", "heavy")]);
    fs::write(folder.path().join("notes.txt"), "nothing\n").unwrap();
    let cases: [(&[&str], &[&str]); 6] = [
        (&["check"], &["<FILE>"]),
        (
            &["check", "Bolst_wedge_sf_68_const.sys"],
            &["there is no file", "did you mean"],
        ),
        (
            &["check", "notes.txt"],
            &["notes.txt is no file of NUCARS", "\\BODY DATA"],
        ),
        (&["check", "."], &["is a folder"]),
        (
            &["show", "sngl_trk_68.dat"],
            &["not a system file, but a data file"],
        ),
        (&["show", CONSTANT], &["`heavy` is not a number"]),
    ];
    for (arguments, texts) in cases {
        let output = wedgelab(folder.path(), arguments);
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        contains(&output.err, texts);
    }
}

/// A run of the constantly damped truck with other capitals than its files have, four seconds long.
const SHORT: [(&str, &str, &str); 1] = [(
    "Bolst_wedge_sf_bolst-vert-displ_68_constant.run",
    "0.01 20.0 0.1",
    "0.01 4.0 0.1",
)];
const SHORT_RUN: &str = "Bolst_wedge_sf_bolst-vert-displ_68_constant.run";

fn json(folder: &Path, name: &str) -> serde_json::Value {
    let text = fs::read_to_string(folder.join(name).join("summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn a_run_file_is_run() {
    let folder = folder(&SHORT);
    fs::rename(
        folder.path().join("sngl_trk_68.dat"),
        folder.path().join("SNGL_trk.dat"),
    )
    .unwrap();
    let output = wedgelab(folder.path(), &["run", SHORT_RUN]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    let name = "Bolst_wedge_sf_bolst-vert-displ_68_constant";
    contains(
        &output.out,
        &[
            "energy per cycle",
            "130",
            &format!(
                "Written into {name}: result.csv, result.mat, summary.json, loops.svg, loops.png, index.html"
            ),
        ],
    );
    contains(
        &output.err,
        &[
            "warnings about the files; `wedgelab nucars check Bolst",
            "1 of 1 runs",
        ],
    );
    // Rows each 0.01 s to the end that the run file says.
    let table = fs::read_to_string(folder.path().join(name).join("result.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 402);
    assert!(lines[401].starts_with("4,"), "{}", lines[401]);
    for column in [
        "time_s,input_vertical_in,",
        "wedge_127_column_friction_lbf",
        "force_119_2_lbf",
        "stroke_127_2_in",
        "velocity_130_2_in_per_s",
        "sum_2_lbf",
        "ledger_residual_lbf_in",
    ] {
        assert!(lines[0].contains(column), "{column} is not in {}", lines[0]);
    }
    assert!(!lines[0].contains("body_1_z_rate"));
    let summary = json(folder.path(), name);
    assert_eq!(summary["schema"], "wedgelab.truck/2");
    assert_eq!(summary["complete"], true);
    let assumptions = summary["assumptions"].to_string();
    contains(
        &assumptions,
        &[
            "0.01 4 0.1 s",
            "a row each 0.01 s",
            "branch follows the direction",
            "warnings of `wedgelab nucars check`",
        ],
    );
    assert!(summary["largest_relative_residual"].as_f64().unwrap() < 1e-5);
    let matrix = fs::read(folder.path().join(name).join("result.mat")).unwrap();
    let holds = |text: &[u8]| matrix.windows(text.len()).any(|part| part == text);
    assert!(holds(b"const_vrt_68_out") && holds(b"wedge_127_stroke_in"));
    // What is there is not overwritten, unless it may be.
    let again = wedgelab(folder.path(), &["run", SHORT_RUN]);
    assert_eq!(again.code, Some(2), "{}", again.err);
    contains(&again.err, &["there are results already", "--force"]);
    let forced = [
        "run",
        SHORT_RUN,
        "--force",
        "--quiet",
        "--units",
        "si",
        "--interval",
        "20 ms",
        "--all-outputs",
        "--option",
        "branch=0.1 in/s",
        "--equilibrium",
    ];
    let forced = wedgelab(folder.path(), &forced);
    assert_eq!(forced.code, Some(0), "{}", forced.err);
    assert!(!forced.err.contains("1 of 1 runs"));
    let table = fs::read_to_string(folder.path().join(name).join("result.csv")).unwrap();
    assert_eq!(table.lines().count(), 202);
    contains(
        table.lines().next().unwrap(),
        &["wedge_127_stroke_m", "body_1_z_rate_m_per_s"],
    );
    contains(
        &json(folder.path(), name)["assumptions"].to_string(),
        &[
            "branch follows the vertical velocity over 0.00254 m/s",
            "start: at rest in static equilibrium",
        ],
    );
}

#[test]
fn a_yaw_that_is_not_reached_is_reported_and_can_be_reached() {
    let folder = folder(&[(YAW_RUN, "0.01 20.0 0.1", "0.01 2.0 0.1")]);
    let files = [
        "--data",
        "SNGL_TRK_68.DAT",
        "--input",
        "bolst_displ_input36.inp",
        "-q",
    ];
    let run = |more: &[&str]| {
        let arguments = [&["run", YAW_RUN], &files[..], more].concat();
        wedgelab(folder.path(), &arguments)
    };
    let output = run(&[]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.err,
        &[
            "body 1 is commanded to yaw by 0.0120 rad and reaches 2.",
            "e-6 rad",
            "--yaw drop",
        ],
    );
    let name = YAW_RUN.trim_end_matches(".run");
    contains(
        &json(folder.path(), name)["assumptions"].to_string(),
        &["the yaw input is taken as printed"],
    );
    let intended = format!("{name}_yaw_as_intended");
    for how in ["drop", "drive"] {
        let output = run(&["--yaw", how, "--force"]);
        assert_eq!(output.code, Some(0), "{}", output.err);
        assert!(!output.err.contains("commanded"), "{}", output.err);
        let summary = json(folder.path(), &intended);
        let reached = summary["yaw"]["reached"]["value"].as_f64().unwrap();
        assert!((reached - 0.012).abs() < 0.001, "{how}: {reached}");
        let left_out = summary["assumptions"]
            .to_string()
            .contains("left out for the intended yaw: 201, 221");
        assert_eq!(left_out, how == "drop");
    }
}

#[test]
fn built_in_runs_are_listed_and_run() {
    let folder = tempfile::tempdir().unwrap();
    let list = wedgelab(folder.path(), &["run", "--list"]);
    assert_eq!(list.code, Some(0), "{}", list.err);
    let names: Vec<&str> = list
        .out
        .lines()
        .skip(1)
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(names.len(), 28);
    assert!(names.contains(&"nucars_69_constant_toe_out_yaw"));
    let name = "nucars_69_variable_toe_in";
    let output = wedgelab(folder.path(), &["run", name, "--out", "deep/in"]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(&output.err, &["jammed wedges"]);
    contains(&output.out, &["Written into deep/in"]);
    assert_eq!(json(folder.path(), "deep/in")["name"], name);
}

#[test]
fn issue_036_a_run_draws_its_figure() {
    let folder = tempfile::tempdir().unwrap();
    let short = ["--set", "simulation.duration=\"1 s\"", "--quiet", "--out", "own"];
    let output = wedgelab(
        folder.path(),
        &[&["run", "nucars_69_constant_toe_out"], &short[..]].concat(),
    );
    assert_eq!(output.code, Some(0), "{}", output.err);
    let read = |name: &str| fs::read(folder.path().join("own").join(name)).unwrap();
    let drawing = String::from_utf8(read("loops.svg")).unwrap();
    contains(
        &drawing,
        &["nucars_69_constant_toe_out: forces of the columns", "wedge 130"],
    );
    assert!(read("loops.png").starts_with(b"\x89PNG"));
    // The page shows the same drawing: lines begin at the same places, and go on from point to point.
    let curve = drawing.split(" d=\"").max_by_key(|part| part.len()).unwrap();
    let curve = curve.split('"').next().unwrap();
    assert!(curve.len() > 200, "{curve}");
    let start = curve.split(" L").next().unwrap().replacen("M ", "M", 1);
    contains(
        &String::from_utf8(read("index.html")).unwrap(),
        &[&format!(" d=\"{start}l")],
    );
}

#[test]
fn wrong_runs_are_refused() {
    let folder = folder(&[(SHORT_RUN, "\\STEPPING CONSTANTS", "$\\STEPPING CONSTANTS")]);
    let cases: [(&[&str], &[&str]); 13] = [
        (&["run"], &["<FILE>"]),
        (&["run", "bolst.run"], &["there is no file bolst.run"]),
        (&["run", CONSTANT], &["not a run file, but a system file"]),
        (
            &["run", YAW_RUN],
            &[
                "did you mean 'sngl_trk_68.dat'?",
                "cannot be run",
                "`wedgelab nucars check Bolst",
            ],
        ),
        (
            &["run", SHORT_RUN, "--data", "sngl_trk_68.dat"],
            &["STEPPING CONSTANTS"],
        ),
        (
            &[
                "run",
                "bolst_wedge_sf_bolst-vert-displ_69_var.run",
                "--data",
                "sngl_trk_69.dat",
                "--yaw",
                "drop",
            ],
            &["no input body that drives a body yaws"],
        ),
        (
            &["run", "nucars_69_constant_toe_uot"],
            &["did you mean nucars_69_constant_toe_out?"],
        ),
        (
            &["run", "nucars_69_constant_toe_out", "--yaw", "drop"],
            &["--yaw does not fit", "end with _yaw"],
        ),
        (
            &["run", "nucars_69_constant_toe_out", "--system", CONSTANT],
            &["has its own files, and --system Bolst"],
        ),
        (
            &["run", "nucars_69_constant_toe_out", "--option", "bent=linear"],
            &["did you mean bend?"],
        ),
        (
            &[
                "run",
                "nucars_69_constant_toe_out",
                "--option",
                "plain_toe_angle=40 deg",
            ],
            &["cannot begin", "plain_toe_angle"],
        ),
        (
            &["run", "nucars_69_constant_toe_out", "--interval", "0 s"],
            &["it must be positive"],
        ),
        (
            &["run", "nucars_69_constant_toe_out", "--interval", "0.001 ms"],
            &["at most 400000"],
        ),
    ];
    for (arguments, texts) in cases {
        let output = wedgelab(folder.path(), arguments);
        assert_eq!(
            output.code,
            Some(2),
            "{arguments:?}: {}{}",
            output.out,
            output.err
        );
        contains(&output.err, texts);
    }
    let left: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().path().is_dir())
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn natural_vibrations_are_printed() {
    let folder = folder(&[]);
    let output = wedgelab(
        folder.path(),
        &["modes", "bolst_wedge_sf_69_const.sys", "--stick", "surfaces"],
    );
    assert_eq!(output.code, Some(0), "{}", output.err);
    contains(
        &output.out,
        &[
            "about the drawn layout; closed surfaces stick, wedges slide",
            "1 Half Car+Bolst",
            "   3.1224   ",
            "yaw +100",
            "  15.5593   ",
            "z +100",
            " 302.3657   ",
        ],
    );
    let rows = output
        .out
        .lines()
        .filter(|line| line.contains('%') || line.contains(" +"));
    assert!(rows.count() >= 18);
    let rest = [
        "modes",
        "bolst_wedge_sf_69_var.sys",
        "--equilibrium",
        "--stick",
        "surfaces",
    ];
    let rest = wedgelab(folder.path(), &rest);
    assert_eq!(rest.code, Some(0), "{}", rest.err);
    contains(&rest.out, &["about static equilibrium", "  15.52"]);
    for (arguments, text) in [
        (
            &["modes", "sngl_trk_68.dat"][..],
            "not a system file, but a data file",
        ),
        (&["modes", CONSTANT, "--stick", "glue"][..], "glue"),
        (&["modes", "nothing.sys"][..], "there is no file"),
    ] {
        let output = wedgelab(folder.path(), arguments);
        assert_eq!(output.code, Some(2));
        contains(&output.err, &[text]);
    }
}

#[test]
fn help_shows_examples() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, text) in [
        (
            ["check", "--help"],
            "wedgelab nucars check yaw.run --data results.dat",
        ),
        (["show", "--help"], "wedgelab nucars show half_truck.sys"),
        (
            ["run", "--help"],
            "wedgelab nucars run nucars_69_constant_toe_out_yaw",
        ),
        (
            ["modes", "--help"],
            "wedgelab nucars modes half_truck.sys --equilibrium",
        ),
    ] {
        let output = wedgelab(folder.path(), &arguments);
        assert_eq!(output.code, Some(0));
        contains(&output.out, &[text]);
    }
}
