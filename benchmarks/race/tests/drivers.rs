//! CVODE's driver in C, through the C interface, agrees with our own integrator. `cargo xtask test --only
//! race` compiles the driver, with the library compiled for all processors, and names it in `RACE_CVODE`;
//! where valgrind is installed it looks for wrong accesses too.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use std::process::Command;

use integrate::Method;
use race::measure::Judge;
use race::outcome::{Outcome, read_states};
use race::own;

const CASE: &str = "cdrun_toe_out_0.2_psi_0.012";

/// Returns the driver's report and states of the first rows.
fn cvode(command: &mut Command, tolerance: &str, rows: usize) -> (Outcome, Vec<f64>) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("states.f64");
    let output = command
        // Cargo leads to the library for this processor; the driver knows the one that it was linked to.
        .env_remove("LD_LIBRARY_PATH")
        .args([CASE, tolerance, "60"])
        .arg(&file)
        .arg(rows.to_string())
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    let outcome = serde_json::from_slice(&output.stdout).unwrap();
    (outcome, read_states(&file).unwrap())
}

fn driver() -> std::ffi::OsString {
    std::env::var_os("RACE_CVODE")
        .expect("RACE_CVODE names the driver; `cargo xtask test --only race` compiles it")
}

#[test]
#[ignore = "needs the compiled driver: cargo xtask test --only race"]
fn cross_code_cvode_agrees_on_a_yawed_case() {
    let rows = 51;
    let (outcome, states) = cvode(&mut Command::new(driver()), "1e-8", rows);
    assert_eq!((outcome.failure.as_str(), outcome.rows), ("", rows));
    assert!(outcome.steps > 0 && outcome.jacobians > 0 && outcome.cpu > 0.0);
    let mut judge = Judge::new(CASE).unwrap();
    let theirs = judge.quantities(&states, rows).unwrap();
    let mut error = |tolerance: f64| {
        let (_, states) = own::run(CASE, Method::Rodas5P, false, tolerance, 60.0, rows).unwrap();
        judge.quantities(&states, rows).unwrap().error(&theirs)
    };
    let (fine, coarse) = (error(1e-8), error(1e-4));
    println!("ours at 1e-8 {fine:e}, at 1e-4 {coarse:e}");
    assert!(fine < 1e-4 && fine < coarse, "{fine:e} {coarse:e}");
}

#[test]
#[ignore = "needs the compiled driver: cargo xtask test --only race"]
fn limits_no_wrong_access_across_the_c_interface() {
    let valgrind = Command::new("valgrind").arg("--version").output();
    if valgrind.is_err() {
        println!("valgrind is not installed: nothing is checked");
        return;
    }
    let mut command = Command::new("valgrind");
    command
        .args([
            "--quiet",
            "--error-exitcode=9",
            "--leak-check=full",
            "--errors-for-leak-kinds=definite",
        ])
        .arg(driver());
    let (outcome, _) = cvode(&mut command, "1e-4", 2);
    assert_eq!(outcome.rows, 2);
}
