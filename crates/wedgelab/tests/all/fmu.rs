//! `wedgelab fmu export` of half-trucks, as a user calls it.

use std::fs;
use std::path::Path;
use std::process::Command;

use nucars::builtin;
use tempfile::TempDir;

/// Exit code and everything that is said.
fn export(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder)
        .args([
            "fmu",
            "export",
            "-o",
            "half.fmu",
            "--library",
            "library.so",
            "--force",
        ])
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    let said = [output.stdout, output.stderr].concat();
    // Messages are broken into lines.
    let said = String::from_utf8(said).unwrap();
    (
        output.status.code(),
        said.split_whitespace().collect::<Vec<_>>().join(" "),
    )
}

/// Returns a folder with the printed files, and something that begins as a library.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in builtin::names() {
        fs::write(folder.path().join(name), builtin::text(name).unwrap()).unwrap();
    }
    fs::write(
        folder.path().join("sngl_trk.dat"),
        builtin::text("sngl_trk_69.dat").unwrap(),
    )
    .unwrap();
    fs::write(folder.path().join("library.so"), b"\x7fELF").unwrap();
    folder
}

const RUN: &str = "bolst_wedge_sf_bolst-vert-displ_69_const.run";

#[test]
#[cfg(target_os = "linux")]
fn run_files_and_built_in_runs_become_fmus() {
    let folder = folder();
    let made = |arguments: &[&str]| {
        let (code, said) = export(folder.path(), arguments);
        assert_eq!(code, Some(0), "{said}");
        (said, fs::read(folder.path().join("half.fmu")).unwrap())
    };
    let (said, of_file) = made(&[RUN]);
    assert!(
        said.contains("HalfTruck of the run bolst_wedge_sf_bolst-vert-displ_69_const, FMI 2.0"),
        "{said}"
    );
    assert_eq!(made(&[RUN]).1, of_file, "the same bytes again");
    let (said, built_in) = made(&["nucars_69_constant_toe_out", "--fmi", "3"]);
    assert!(
        said.contains("HalfTruck of the run nucars_69_constant_toe_out, FMI 3.0"),
        "{said}"
    );
    assert_ne!(built_in, of_file);
    made(&[
        "nucars_68_variable_toe_in_yaw",
        "--yaw",
        "drive",
        "--option",
        "bend=linear",
    ]);
}

#[test]
fn what_makes_no_half_truck_is_refused_with_the_reason() {
    let folder = folder();
    fs::write(folder.path().join("broken.run"), "\\RUN TITLE\nbroken\n").unwrap();
    for (arguments, reason) in [
        (
            &["nucars_69_constant_toe_up"][..],
            "did you mean nucars_69_constant_toe",
        ),
        (
            &[RUN, "--set", "wedges.toe=0.1 deg"],
            "have wedge_angle, stiffness, damping, slope_friction, column_friction, normal_limit help",
        ),
        (&[RUN, "--quasi-static"], "--quasi-static is for wedges"),
        (
            &["nucars_69_constant_toe_out", "--truck"],
            "--truck is for wedges",
        ),
        (
            &["cdrun_toe_0_psi_0", "--yaw", "drop"],
            "--yaw is for half-trucks",
        ),
        (
            &["nucars_69_constant_toe_out", "--system", "other.sys"],
            "has its own files",
        ),
        (
            &["nucars_69_constant_toe_out", "--yaw", "drop"],
            "--yaw does not fit",
        ),
        (&[RUN, "--option", "bent=linear"], "did you mean bend?"),
        (&["bolst_wedge_sf_69_const.sys"], "is not a run file"),
        (&["missing.run"], "there is no file missing.run"),
        (&["broken.run"], "cannot be run"),
    ] {
        let (code, said) = export(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        assert!(said.contains(reason), "{arguments:?}: {said}");
        assert!(!folder.path().join("half.fmu").exists(), "{arguments:?}");
    }
}

/// The program alone in a folder, as `cargo install` leaves it.
#[test]
fn issue_036_the_program_alone_exports_fmus() {
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("wedgelab");
    // A link: a copy that another test's new process still holds open for writing could not be started.
    let own = env!("CARGO_BIN_EXE_wedgelab");
    fs::hard_link(own, &program)
        .or_else(|_| fs::copy(own, &program).map(drop))
        .unwrap();
    let call = |arguments: &[&str]| {
        let output = Command::new(&program)
            .current_dir(folder.path())
            .args(["fmu", "export", "cdrun_toe_0_psi_0", "-o", "wedge.fmu", "--force"])
            .args(arguments)
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        fs::read(folder.path().join("wedge.fmu")).unwrap()
    };
    for version in ["2", "3"] {
        let fmu = call(&["--fmi", version]);
        // Packed, the library is some megabytes: a page and a case alone would not be one.
        assert!(
            fmu.starts_with(b"PK") && fmu.len() > 500_000,
            "{} bytes",
            fmu.len()
        );
    }
    // Another library goes in when it is named.
    fs::write(folder.path().join("own"), b"\x7fELF").unwrap();
    if cfg!(target_os = "linux") {
        assert!(call(&["--library", "own"]).len() < 500_000);
    }
}
