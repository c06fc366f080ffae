//! `wedgelab nucars run --wedges bodies`, as a user calls it.

use std::fs;
use std::path::Path;
use std::process::Command;

struct Output {
    code: Option<i32>,
    out: String,
    err: String,
}

fn wedgelab(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    let command = command.current_dir(folder).arg("nucars").args(arguments);
    let output = command.env_remove("FORCE_COLOR").output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let (code, out, err) = (output.status.code(), text(output.stdout), text(output.stderr));
    assert!(!err.contains("panicked"), "{err}");
    Output { code, out, err }
}

#[track_caller]
fn contains(text: &str, pieces: &[&str]) {
    for piece in pieces {
        assert!(text.contains(piece), "{piece:?} is not in:\n{text}");
    }
}

fn json(folder: &Path, name: &str) -> serde_json::Value {
    let text = fs::read_to_string(folder.join(name).join("summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Wedges become bodies where that is asked for: what is added is told, the summary has it, and columns are
/// those of massless wedges and more.
#[test]
fn wedges_become_bodies() {
    let folder = tempfile::tempdir().unwrap();
    let run = |more: &[&str]| {
        let short = ["--set", "simulation.duration=\"5 s\"", "-q"];
        let output = wedgelab(
            folder.path(),
            &[&["run", "nucars_69_constant_toe_out"], &short[..], more].concat(),
        );
        assert_eq!(output.code, Some(0), "{}", output.err);
        output.out
    };
    let massless = run(&["--wedges", "massless", "--out", "massless"]);
    assert!(!massless.contains("Wedges as bodies"), "{massless}");
    let stdout = run(&["--wedges", "bodies", "--out", "bodies"]);
    contains(
        &stdout,
        &[
            "Wedges as bodies:",
            "wedges of connections 127, 128, 129, 130: from the files: 37.5 deg, a column inclined by 0.2 \
             deg, toe out",
            "added: mass 50 lb",
            "200 lb, are taken from body 1",
        ],
    );
    let by_option = [
        "--option",
        "wedges=bodies",
        "--option",
        "wedge_mass=40 lb",
        "--out",
        "lighter",
    ];
    contains(&run(&by_option), &["added: mass 40 lb"]);
    let summary = json(folder.path(), "bodies");
    let text = summary["assumptions"].to_string();
    contains(&text, &["added: mass 50 lb", "four corners a face"]);
    assert!(!text.contains("quasi-static balance"), "{text}");
    assert!(summary["largest_relative_residual"].as_f64().unwrap() < 1e-5);
    assert!(summary["largest_displacements"]["wedge_127_roll"]["value"].is_number());
    let header = |name: &str| {
        let table = fs::read_to_string(folder.path().join(name).join("result.csv")).unwrap();
        let names = table.lines().next().unwrap().split(',').map(str::to_owned);
        names.collect::<Vec<String>>()
    };
    let (massless, bodies) = (header("massless"), header("bodies"));
    let missing: Vec<&String> = massless.iter().filter(|name| !bodies.contains(name)).collect();
    let only_massless =
        |name: &str| name.ends_with("jammed") || name.starts_with("wedge_") && name.ends_with("_lbf_in");
    assert!(missing.iter().all(|name| only_massless(name)), "{missing:?}");
    for name in [
        "wedge_127_z_in",
        "wedge_130_column_moment_yaw_lbf_in",
        "contact_energy_lbf_in",
        "sum_2_lbf",
    ] {
        assert!(bodies.iter().any(|own| own == name), "{name}: {bodies:?}");
    }
    for (arguments, texts) in [
        (
            &["--wedges", "heavy"][..],
            &["[possible values: massless, bodies]"][..],
        ),
        (&["--option", "wedge_mass=0 lb"], &["a mass, such as \"50 lb\""]),
        (
            &["--wedges", "bodies", "--option", "plain_toe_angle=60 deg"],
            &["connection 127 is 97.5; for a wedge body it must lie between 0 and 90"],
        ),
    ] {
        let output = wedgelab(
            folder.path(),
            &[
                &["run", "nucars_68_constant_toe_out", "--out", "wrong"],
                arguments,
            ]
            .concat(),
        );
        assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
        contains(&output.err, texts);
    }
}
