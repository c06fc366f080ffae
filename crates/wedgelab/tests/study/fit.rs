//! `wedgelab fit`.

use std::fs;

use tempfile::tempdir;

use crate::common::{done, names, refused};

const CASE: &str = "[wedge]\ndamping = \"constant\"\n[side_frame]\ntoe = \"0.2 deg out\"\n[bolster]\n\
                    yaw = \"0.012 rad\"\n\
                    vertical = { shape = \"sine\", amplitude = \"1 in\", frequency = \"20 rad/s\" }\n\
                    [simulation]\nduration = \"0.4 s\"\noutput_interval = \"0.004 s\"\n";

#[test]
fn convergence_the_friction_of_a_run_is_found_again() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("case.toml"), CASE).unwrap();
    done(
        path,
        &[
            "run",
            "case.toml",
            "--out",
            "true",
            "--set",
            "friction.column=0.33",
        ],
    );
    let said = done(
        path,
        &[
            "fit",
            "true/result.csv",
            "case.toml",
            "--free",
            "friction.column=0.2..0.6",
        ],
    );
    // How near it comes, the numbers below tell.
    assert!(said.out.contains("friction.column   0.3"), "{}", said.out);
    assert_eq!(
        names(&path.join("fit")),
        ["case.toml", "fit.json", "residuals.png", "residuals.svg"]
    );
    let numbers: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(path.join("fit/fit.json")).unwrap()).unwrap();
    let value = numbers["parameters"][0]["value"].as_f64().unwrap();
    assert!((value - 0.33).abs() < 1e-4, "{value}");
    // The case found runs.
    done(path, &["run", "fit/case.toml", "--out", "again"]);
    refused(
        path,
        &["fit", "true", "case.toml", "--free", "friction.column=0.2..0.6"],
        2,
        &["there are results already", "--force"],
    );
}

#[test]
fn input_what_cannot_be_fitted() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("case.toml"), CASE).unwrap();
    fs::write(path.join("none.csv"), "time_s,speed_in_per_s\n0,1\n0.1,2\n").unwrap();
    fs::write(path.join("few.csv"), "time_s,vertical_wedge_force_lbf\n0.2,1\n").unwrap();
    for (arguments, texts) in [
        (
            ["none.csv", "case.toml", "friction.column=0.2..0.6"],
            ["no force", "--column"],
        ),
        (
            ["few.csv", "case.toml", "friction.column=0.2..0.6"],
            ["cannot determine", "fewer"],
        ),
        (
            ["few.csv", "case.toml", "friction.column=0.6..0.6"],
            ["nothing does", "--free"],
        ),
        (
            ["few.csv", "case.toml", "friction.colum=0.2..0.3"],
            ["no key `colum`", "did you mean"],
        ),
        (
            ["gone.csv", "case.toml", "friction.column=0.2..0.6"],
            ["no result", "gone.csv"],
        ),
    ] {
        let [measured, case, free] = arguments;
        let call = ["fit", measured, case, "--free", free, "--from", "0"];
        if measured == "few.csv" && free.starts_with("friction.colum=") {
            fs::write(
                path.join("few.csv"),
                "time_s,vertical_wedge_force_lbf\n0.1,1\n0.2,1\n0.3,2\n",
            )
            .unwrap();
        }
        refused(path, &call, 2, &texts);
    }
    assert!(!path.join("fit").exists());
}
