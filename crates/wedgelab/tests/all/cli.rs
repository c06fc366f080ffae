//! The commands, as a user calls them.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

const SHORT: [&str; 2] = ["--set", "simulation.duration=0.05 s"];

struct Output {
    code: Option<i32>,
    out: String,
    err: String,
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    command
        .current_dir(folder)
        .args(arguments)
        .env_remove("FORCE_COLOR");
    command
}

fn wedgelab(folder: &Path, arguments: &[&str]) -> Output {
    let output = command(folder, arguments).output().unwrap();
    Output {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    }
}

fn temporary() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The call is refused with this exit code and all of these texts, without a trace of it.
#[track_caller]
fn refused(folder: &Path, arguments: &[&str], code: i32, texts: &[&str]) {
    let before = names(folder);
    let output = wedgelab(folder, arguments);
    assert_eq!(output.code, Some(code), "{arguments:?}: {}", output.err);
    for text in texts {
        assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
    }
    assert!(
        !output.err.contains("panicked") && !output.err.contains('\u{1b}'),
        "{}",
        output.err
    );
    assert_eq!(names(folder), before);
}

/// The help of tracks says where joints lie, and that of contact what is answered by default.
#[test]
fn issue_048_help_says_where_joints_lie_and_what_contact_answers() {
    let folder = temporary();
    for (arguments, parts) in [
        (
            &["track", "show", "--help"][..],
            &["first joint's lowest point", "half a spacing"][..],
        ),
        (
            &["wheelrail", "contact", "--help"],
            &["that of free rolling", "Answers are in the units of the question"],
        ),
    ] {
        let help = wedgelab(folder.path(), arguments).out;
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            parts.iter().all(|part| words.contains(part)),
            "{arguments:?}: {help}"
        );
    }
}

#[test]
fn help_shows_examples() {
    let folder = temporary();
    for (arguments, text) in [
        (vec!["--help"], "wedgelab run my.toml"),
        (vec!["reproduce", "--help"], "Examples:"),
        (vec!["run", "--help"], "--set friction.column=0.3"),
        (vec!["case", "--help"], "> a.toml"),
        (vec!["compare", "--help"], "other_program.csv"),
        (vec!["explore", "--help"], "--port 8080"),
        (vec!["plot", "--help"], "--out loop.svg"),
        (vec!["report", "--help"], "softer --out both"),
        (vec!["quasi-static", "--help"], "0.2 deg out"),
        (vec!["--version"], env!("CARGO_PKG_VERSION")),
    ] {
        let output = wedgelab(folder.path(), &arguments);
        assert_eq!(output.code, Some(0), "{arguments:?}");
        assert!(output.out.contains(text), "{}", output.out);
    }
    refused(folder.path(), &[], 2, &["Usage"]);
    refused(folder.path(), &["repeat"], 2, &["repeat"]);
}

#[test]
fn the_list_of_cases() {
    let folder = temporary();
    let output = wedgelab(folder.path(), &["case"]);
    assert_eq!(output.code, Some(0));
    assert!(
        output
            .out
            .contains("cdrun_toe_out_0.2_psi_0.012   constant damping, toe out, yawed"),
        "{}",
        output.out
    );
    // In groups, each with what to look at.
    for text in [
        "thesis: The twelve runs of the thesis (table 4-1)\n",
        "\n\nwarp: Warp test",
        "\n  warp_friction_0.2 ",
        "\n  sweep_variable_0.25in_0.5hz   variable damping, toe out, 0.25 in at 0.5 Hz\n",
        "\n  The wedge rises by (w_c cos θ + w_s cos φ)/sin(θ + φ)",
    ] {
        assert!(output.out.contains(text), "{text}\n{}", output.out);
    }
    let printed = wedgelab(folder.path(), &["case", "rig_c"]);
    assert_eq!(printed.code, Some(0));
    assert!(
        printed.out.starts_with("#:schema ") && printed.out.contains("\nname = \"rig_constant\""),
        "{}",
        printed.out
    );
    refused(
        folder.path(),
        &["case", "vdrun_toe_0_psi_1"],
        2,
        &[
            "there is no built-in case `vdrun_toe_0_psi_1`",
            "did you mean vdrun_toe_0_psi_0?",
        ],
    );
}

#[test]
fn a_printed_case_runs_as_the_built_in_one() {
    let folder = temporary();
    let path = folder.path();
    for name in ["vdrun_toe_out_0.2_psi_0.012", "cdrun_toe_in_0.2_psi_0"] {
        let printed = wedgelab(path, &["case", name]);
        assert_eq!(printed.code, Some(0));
        fs::write(path.join("a.toml"), &printed.out).unwrap();
        let run = |case: &str, out: &str| {
            let output = wedgelab(path, &[&["run", case, "--out", out], &SHORT[..]].concat());
            assert_eq!(output.code, Some(0), "{}", output.err);
            assert!(output.out.contains(name), "{}", output.out);
            ["result.csv", "case.toml", "summary.json"]
                .map(|file| fs::read_to_string(path.join(out).join(file)).unwrap())
        };
        let own = run("a.toml", &format!("{name}/own"));
        assert_eq!(own, run(name, &format!("{name}/builtin")));
        assert!(own[1].contains("\"0.05 s\""));
    }
}

#[test]
fn set_changes_a_value() {
    let folder = temporary();
    let path = folder.path();
    let call = ["run", "vdrun_toe_0_psi_0", "--set", "simulation.output_units=si"];
    let output = wedgelab(path, &[&call[..], &SHORT].concat());
    assert_eq!(output.code, Some(0), "{}", output.err);
    let csv = fs::read_to_string(path.join("vdrun_toe_0_psi_0/result.csv")).unwrap();
    assert!(csv.starts_with("time_s,bolster_vertical_m,"));
    refused(
        path,
        &[
            "run",
            "vdrun_toe_0_psi_0",
            "--out",
            "x",
            "--set",
            "friction.colum=0.3",
        ],
        2,
        &["--set", "friction.colum", "column"],
    );
    refused(
        path,
        &["run", "vdrun_toe_0_psi_0", "--out", "x", "--set", "friction"],
        2,
        &["path.key=value"],
    );
}

#[test]
fn results_are_overwritten_only_by_force() {
    let folder = temporary();
    let path = folder.path();
    let call = [&["run", "vdrun_toe_0_psi_0", "--out", "x"], &SHORT[..]].concat();
    assert_eq!(wedgelab(path, &call).code, Some(0));
    fs::write(path.join("x/result.csv"), "mine").unwrap();
    refused(path, &call, 2, &["x/result.csv", "--force", "--out"]);
    assert_eq!(fs::read_to_string(path.join("x/result.csv")).unwrap(), "mine");
    let forced = wedgelab(path, &[&call[..], &["--force"]].concat());
    assert_eq!(forced.code, Some(0), "{}", forced.err);
    assert_ne!(fs::read_to_string(path.join("x/result.csv")).unwrap(), "mine");
    assert_eq!(
        names(&path.join("x")),
        [
            "case.toml",
            "index.html",
            "result.csv",
            "result.mat",
            "summary.json"
        ]
    );

    // Found before anything is computed.
    fs::create_dir_all(path.join("r/runs/cdrun_toe_0_psi_0")).unwrap();
    fs::write(path.join("r/runs/cdrun_toe_0_psi_0/summary.json"), "").unwrap();
    refused(
        path,
        &["reproduce", "--out", "r"],
        2,
        &["r/runs/cdrun_toe_0_psi_0/summary.json", "--force"],
    );
    assert_eq!(names(&path.join("r/runs")), ["cdrun_toe_0_psi_0"]);
}

#[test]
fn folders_that_cannot_be() {
    let folder = temporary();
    let path = folder.path();
    fs::write(path.join("file"), "").unwrap();
    for out in ["file", "file/below", "file/far/below"] {
        refused(
            path,
            &["run", "vdrun_toe_0_psi_0", "--out", out],
            2,
            &["`file` is not a folder", "--out"],
        );
        refused(
            path,
            &["reproduce", "--out", out],
            2,
            &["`file` is not a folder", "--out"],
        );
    }
}

/// Everything that the input of a case may have wrong: the message names file, line and column, shows the
/// text and says what is expected.
#[test]
fn bad_cases() {
    let folder = temporary();
    let path = folder.path();
    fs::write(path.join("short.csv"), "time [s], value [in]\n0, 0\n").unwrap();
    fs::write(
        path.join("unsorted.csv"),
        "time [s], value [in]\n0, 0\n2, 1\n1, 0\n3, 1\n",
    )
    .unwrap();
    let table = |name: &str| format!("vertical = {{ shape = \"table\", file = \"{name}\" }}");
    for (section, line, place, texts) in [
        (
            "control_coil",
            "stiffness = \"3000 lbf\"",
            "bad.toml:3:19",
            ["a force (lbf)", "a stiffness is expected"],
        ),
        (
            "control_coil",
            "stiffness = \"3000 lfb/in\"",
            "bad.toml:3:19",
            ["no unit \"lfb\"", "did you mean"],
        ),
        (
            "control_coil",
            "stiffness = 3000",
            "bad.toml:3:13",
            ["the unit is missing", "3000 lbf/in"],
        ),
        (
            "control_coil",
            "stifness = \"3000 lbf/in\"",
            "bad.toml:3:1",
            ["no key `stifness`", "did you mean `stiffness`"],
        ),
        (
            "control_coil",
            "stiffness = \"0 lbf/in\"",
            "bad.toml:3:13",
            ["control_coil.stiffness", "greater than zero"],
        ),
        (
            "wedge",
            "weight = \"-50 lbf\"",
            "bad.toml:3:10",
            ["wedge.weight", "greater than zero"],
        ),
        (
            "wedge",
            "height = \"0 in\"",
            "bad.toml:3:10",
            ["wedge.height", "greater than zero"],
        ),
        (
            "wedge",
            "angle = \"90 deg\"",
            "bad.toml:3:9",
            ["wedge.angle", "between 0 deg and 90 deg"],
        ),
        (
            "wedge",
            "angle = \"nan deg\"",
            "bad.toml:3:10",
            ["wedge.angle", "not a finite number"],
        ),
        (
            "friction",
            "column = -0.1",
            "bad.toml:3:10",
            ["friction.column", "between 0 and 10"],
        ),
        (
            "friction",
            "column = nan",
            "bad.toml:3:10",
            ["friction.column", "between 0 and 10"],
        ),
        (
            "simulation",
            "output_interval = \"11 s\"",
            "bad.toml:3:19",
            ["longer than the duration", "0.01 s"],
        ),
        (
            "simulation",
            "relative_tolerance = 1.0",
            "bad.toml:3:22",
            ["between 1e-15 and 1", "1e-6"],
        ),
        (
            "bolster",
            &table("none.csv"),
            "bad.toml:3:38",
            ["there is no file none.csv", "check the name"],
        ),
        (
            "bolster",
            &table("short.csv"),
            "short.csv:",
            ["short.csv", "help:"],
        ),
        (
            "bolster",
            &table("unsorted.csv"),
            "unsorted.csv:4:1",
            ["1, 0", "help:"],
        ),
    ] {
        fs::write(path.join("bad.toml"), format!("# a case\n[{section}]\n{line}\n")).unwrap();
        let mut all = vec![place];
        all.extend(texts);
        if place.starts_with("bad.toml") {
            all.push(line);
        }
        refused(path, &["run", "bad.toml"], 2, &all);
    }
    fs::write(path.join("bad.toml"), "# a case\n[wedge\n").unwrap();
    refused(path, &["run", "bad.toml"], 2, &["bad.toml:2:"]);
    refused(
        path,
        &["run", "none.toml"],
        2,
        &["there is no case file none.toml", "wedgelab case"],
    );
    refused(
        path,
        &["run", "vdrun_toe_0_psi"],
        2,
        &["vdrun_toe_0_psi", "did you mean"],
    );
    refused(
        path,
        &["reproduce", "--only", "vdrun_toe_1_psi_0"],
        2,
        &["did you mean"],
    );
    refused(
        path,
        &["reproduce", "--only", "vdrun"],
        2,
        &["beginning of 6 names", "'vdrun*'"],
    );
    refused(path, &["reproduce", "--jobs", "0"], 2, &["--jobs"]);
}

#[test]
fn quasi_static_wedges() {
    let folder = temporary();
    let path = folder.path();
    let output = wedgelab(path, &["quasi-static", "--toe", "0.2 deg out"]);
    assert_eq!(output.code, Some(0), "{}", output.err);
    assert!(
        output.out.contains("jams") && output.out.contains("lbf") && output.out.contains("0.2886"),
        "{}",
        output.out
    );
    let output = wedgelab(
        path,
        &[
            "quasi-static",
            "--units",
            "si",
            "--mu-column",
            "0",
            "--mu-slope",
            "0",
        ],
    );
    // Without friction N_c = F_s / tan(angle).
    let force = 3000.0 * 4.448_221_615_260_5 / 32f64.to_radians().tan();
    assert!(
        output.out.contains(&format!("{force:.1}")) && !output.out.contains("jams   "),
        "{}",
        output.out
    );
    for (arguments, text) in [
        (["--angle", "90 deg"], "between 0 deg and 90 deg"),
        (["--angle", "32"], "the unit is missing; an angle is expected"),
        (["--angle", "-5 deg"], "between 0 deg and 90 deg"),
        (["--toe", "0.2 deg"], "the direction is missing"),
        (["--toe", "-0.2 deg out"], "not negative"),
        (["--toe", "30 deg in"], "below 22.5 deg"),
        (["--mu-column", "-0.1"], "from 0 to 10"),
        (["--mu-slope", "nan"], "from 0 to 10"),
        (["--coil-force", "3000 lb"], "lb is a mass, lbf the force"),
        (["--coil-force", "0 lbf"], "positive"),
        (["--units", "metric"], "possible values: us, si"),
    ] {
        refused(
            path,
            &[&["quasi-static"], &arguments[..]].concat(),
            2,
            &[text, arguments[0]],
        );
    }
}

#[test]
fn a_run_that_cannot_finish_keeps_what_it_has() {
    let folder = temporary();
    let path = folder.path();
    let mut call = vec!["run", "vdrun_toe_0_psi_0", "--out", "x"];
    for set in HOPELESS {
        call.extend(["--set", set]);
    }
    let output = wedgelab(path, &call);
    assert_eq!(output.code, Some(1), "{}{}", output.out, output.err);
    for text in [
        "is incomplete",
        "at time",
        "column_lower_left",
        "relative_tolerance",
    ] {
        assert!(output.err.contains(text), "{text}: {}", output.err);
    }
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(path.join("x/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["complete"], false);
    assert!(summary["stopped"]["time"].as_f64().unwrap() < 10.0);
    assert!(!summary["stopped"]["reason"].as_str().unwrap().is_empty());
    let rows = fs::read_to_string(path.join("x/result.csv"))
        .unwrap()
        .lines()
        .count()
        - 1;
    assert_eq!(summary["rows"], rows);
    assert!(rows >= 1);
}

const HOPELESS: [&str; 2] = [
    r#"wedge.inertia=["1e-300 lb in^2", "1e-300 lb in^2", "1e-300 lb in^2"]"#,
    "simulation.duration=0.05 s",
];

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = temporary();
    let mut child = command(folder.path(), &["case", "vdrun_toe_0_psi_0"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
}
