//! `wedgelab nucars`, as a user calls it.

#![allow(clippy::unwrap_used)]

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

/// A folder with the printed files, some of them changed.
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
fn all_mistakes_are_told_at_once() {
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

#[test]
fn help_shows_examples() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, text) in [
        (
            ["check", "--help"],
            "wedgelab nucars check yaw.run --data results.dat",
        ),
        (["show", "--help"], "wedgelab nucars show half_truck.sys"),
    ] {
        let output = wedgelab(folder.path(), &arguments);
        assert_eq!(output.code, Some(0));
        contains(&output.out, &[text]);
    }
}
