//! Issue 36: the right command is named to the wrong one, spectra, windows of mean forces.

use crate::common;
use std::fs;
use std::path::Path;

use common::{done, wedgelab};

const STUDY: &str = "case = \"vdrun_toe_0_psi_0\"\nsampling = \"full_factorial\"\n[set]\nsimulation.duration \
                     = \"0.1 s\"\n\
                     [vary]\nfriction.column = { from = 0.4, to = 0.2, count = 3 }\n";

/// Returns a folder with a case, a study, a track, a run file, a result and a study's folder.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let case = done(path, &["case", "vdrun_toe_0_psi_0"]);
    fs::write(path.join("case.toml"), case).unwrap();
    fs::write(path.join("study.toml"), STUDY).unwrap();
    fs::write(path.join("track.toml"), "[[segments]]\ntangent = \"500 ft\"\n").unwrap();
    fs::write(path.join("half.run"), "\\RUN DATA\n").unwrap();
    let short = [
        "--set",
        "simulation.duration='0.1 s'",
        "--quiet",
        "--out",
        "result",
    ];
    done(path, &[&["run", "case.toml"], &short[..]].concat());
    done(path, &["study", "study.toml", "--quiet"]);
    folder
}

#[track_caller]
fn refused(folder: &Path, arguments: &[&str], texts: &[&str]) {
    let output = wedgelab(folder, arguments);
    assert_eq!(
        output.code,
        Some(2),
        "{arguments:?}: {}{}",
        output.out,
        output.err
    );
    for text in texts {
        assert!(
            output.err.contains(text),
            "{arguments:?}: {text:?} is not in: {}",
            output.err
        );
    }
    assert!(!output.err.contains("panicked"), "{}", output.err);
}

#[test]
fn issue_036_the_wrong_command_names_the_right_one() {
    let folder = folder();
    let half = "nucars_69_constant_toe_out";
    let run_half = format!("`wedgelab nucars run {half}` runs it");
    let run_case = "`wedgelab run vdrun_toe_0_psi_0` runs it";
    for (arguments, texts) in [
        (&["run", half][..], [run_half.as_str(), "built-in half-truck"]),
        (&["energy", half], [&run_half, "built-in half-truck"]),
        (&["case", half], [&run_half, "half-truck"]),
        (&["study", half], [&run_half, "half-truck"]),
        (
            &["plot", half, "--x", "time", "--y", "z"],
            [&run_half, "half-truck"],
        ),
        (&["study", "vdrun_toe_0_psi_0"], [run_case, "built-in case"]),
        (
            &["nucars", "run", "vdrun_toe_0_psi_0"],
            [run_case, "not a half-truck"],
        ),
        (
            &["plot", "vdrun_toe_0_psi_0", "--psd", "wedge_z"],
            [run_case, "built-in case"],
        ),
        (
            &["compare", "vdrun_toe_0_psi_0", "result"],
            [run_case, "built-in case"],
        ),
        (
            &["run", "half.run"],
            ["`wedgelab nucars run half.run` runs it", "file of NUCARS"],
        ),
        (
            &["run", "track.toml"],
            [
                "`wedgelab track show track.toml` shows it",
                "only a track has this",
            ],
        ),
        (
            &["track", "show", "case.toml"],
            ["is no track file", "[[segments]]"],
        ),
        (
            &["track", "show", "study.toml"],
            ["is no track file", "no track has this"],
        ),
        (
            &["run", "study.toml"],
            ["`wedgelab study study.toml` runs it", "study file"],
        ),
        (
            &["study", "case.toml"],
            ["`wedgelab run case.toml` runs it", "case file"],
        ),
        (&["study", "result"], ["`wedgelab plot`", "result/case.toml"]),
        (&["study", "study"], ["the folder of a study", "study file"]),
        (
            &["run", "result/result.csv"],
            ["`wedgelab compare`", "table of results"],
        ),
        (&["run", "study/table.parquet"], ["Parquet", "case file"]),
        (
            &["plot", "study/table.csv", "--x", "a", "--y", "b"],
            ["the table of a study", "index.html"],
        ),
        (&["run", "vdrun_toe"], ["did you mean", "vdrun_toe_0_psi_0"]),
        (
            &["run", "result"],
            ["is a folder", "name the case file in it: result/case.toml"],
        ),
        (
            &["regime", "car_hunting_empty", "hunting"],
            [
                "the regime is named before it",
                "`wedgelab regime hunting car_hunting_empty`",
            ],
        ),
        (
            &["regime", "car_hunting_empty"],
            ["is a case", "`wedgelab regime REGIME car_hunting_empty`"],
        ),
        (
            &["nucars", "run", "nucars_69"],
            ["did you mean nucars_69_", "--list"],
        ),
    ] {
        refused(folder.path(), arguments, &texts);
    }
    // Also where the half-truck's results lie beside.
    fs::create_dir(folder.path().join(half)).unwrap();
    for command in ["run", "explore", "energy"] {
        refused(
            folder.path(),
            &[command, half],
            &[&run_half, "built-in half-truck"],
        );
    }
    let keys = wedgelab(
        folder.path(),
        &["run", "truck_vertical_variable", "--set", "qqqqq=1"],
    );
    assert_eq!(keys.err.matches(" bolster,").count(), 1, "{}", keys.err);
}

#[test]
fn issue_036_spans_of_time_are_numbers_or_times_with_units() {
    let folder = folder();
    let path = folder.path();
    let drawn = |from: &str, to: &str| {
        let out = ["--from", from, "--to", to, "--out", "z.svg", "--force"];
        done(
            path,
            &[&["plot", "result", "--x", "time", "--y", "wedge_z"], &out[..]].concat(),
        );
        fs::read_to_string(path.join("z.svg")).unwrap()
    };
    let plain = drawn("0.02", "0.06");
    assert_eq!(drawn("20 ms", "0.06 s"), plain);
    assert_ne!(drawn("0", "0.06"), plain);
    for (from, text) in [
        ("2 in", "a time is expected"),
        ("nan", "a time is expected"),
        ("soon", "not a number"),
    ] {
        refused(
            path,
            &["compare", "result", "result", "--from", from],
            &[text, "--from"],
        );
    }
}

/// A sine of 2 in at 5 Hz on a mean of 7 in, with its columns in inches.
fn sine(path: &Path) {
    let mut text = "time_s,lift_in\n".to_owned();
    for row in 0..4096 {
        let time = f64::from(row) * 0.01;
        let value = 7.0 + 2.0 * (2.0 * std::f64::consts::PI * 5.0 * time).sin();
        text.push_str(&format!("{time},{value}\n"));
    }
    fs::write(path.join("sine.csv"), text).unwrap();
}

#[test]
fn issue_036_a_column_s_power_spectral_density() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    sine(path);
    let said = done(path, &["plot", "sine.csv", "--psd", "lift", "--out", "psd.csv"]);
    assert!(said.contains("in²/Hz"), "{said}");
    let text = fs::read_to_string(path.join("psd.csv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("frequency_Hz,lift_psd_in_squared_per_Hz"));
    let rows: Vec<[f64; 2]> = lines
        .map(|line| {
            let (frequency, density) = line.split_once(',').unwrap();
            [frequency, density].map(|cell| cell.parse().unwrap())
        })
        .collect();
    assert_eq!(rows.last().unwrap()[0], 50.0);
    // The integral is the variance, A²/2 = 2 in²; most of it lies at the sine's frequency.
    let variance = rows.iter().map(|row| row[1]).sum::<f64>() * rows[1][0];
    assert!((variance - 2.0).abs() < 0.01, "{variance}");
    let peak = rows.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    assert!((peak[0] - 5.0).abs() <= rows[1][0], "{peak:?}");
    assert!(said.contains("Root mean square about the mean: 1.41"), "{said}");
    // The figures, and a finer resolution on demand.
    let said = done(
        path,
        &["plot", "sine.csv", "--psd", "lift", "--resolution", "0.05 Hz"],
    );
    assert!(said.contains("lines 0.0488281 Hz apart"), "{said}");
    let svg = fs::read_to_string(path.join("lift_psd.svg")).unwrap();
    assert!(
        svg.contains("dB re 1 in²/Hz") && svg.contains("Welch"),
        "{}",
        svg.len()
    );
    done(path, &["plot", "sine.csv", "--psd", "lift", "--out", "psd.png"]);
    assert!(fs::read(path.join("psd.png")).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn input_issue_036_spectra_refuse_what_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    sine(path);
    fs::write(
        path.join("uneven.csv"),
        "time_s,z_in\n0,1\n1,2\n2,3\n3,1\n4,2\n5,3\n6,1\n7.5,2\n9,1\n",
    )
    .unwrap();
    fs::write(path.join("short.csv"), "time_s,z_in\n0,1\n1,2\n2,3\n").unwrap();
    let psd = |file: &'static str, more: &[&'static str]| [&["plot", file, "--psd"], more].concat();
    for (arguments, texts) in [
        (psd("sine.csv", &["lfit"]), ["did you mean lift?", "no column"]),
        (
            psd("sine.csv", &["lift", "--out", "a.pdf"]),
            ["densities are CSV", "--out a.svg"],
        ),
        (
            psd("sine.csv", &["lift", "--resolution", "0.5"]),
            ["0.5 Hz", "--resolution"],
        ),
        (
            psd("sine.csv", &["lift", "--resolution", "0.5 in"]),
            ["0.5 Hz", "length"],
        ),
        (
            psd("sine.csv", &["lift", "--resolution", "-1 Hz"]),
            ["-1 Hz is not possible", "0.5 Hz"],
        ),
        (
            psd("sine.csv", &["lift", "--resolution", "0 Hz"]),
            ["not possible", "at most 12.5 Hz"],
        ),
        (
            psd("sine.csv", &["lift", "--resolution", "1e-9 Hz"]),
            ["too few", "coarser --resolution"],
        ),
        (
            psd("sine.csv", &["lift", "--from", "40.9"]),
            ["too few", "8 rows"],
        ),
        (
            psd("sine.csv", &["lift", "--x", "time"]),
            ["cannot be used with", "--psd"],
        ),
        (psd("uneven.csv", &["z"]), ["not evenly apart", "1.5 s"]),
        (psd("short.csv", &["z"]), ["3 rows are too few", "longer span"]),
        (vec!["plot", "sine.csv", "--y", "lift"], ["--x", "required"]),
        (
            [
                &["plot", "sine.csv", "--x", "time", "--y", "lift"][..],
                &["--resolution", "1 Hz"],
            ]
            .concat(),
            ["--resolution is for --psd", "leave --resolution out"],
        ),
        (
            vec!["plot", "sine.csv", "--x", "time", "--y", "lift", "--out", "a.csv"],
            ["SVG or PNG", "--out a.svg"],
        ),
    ] {
        refused(path, &arguments, &texts);
    }
}

#[test]
fn issue_036_mean_forces_say_their_window() {
    let folder = tempfile::tempdir().unwrap();
    for (case, window) in [
        ("vdrun_toe_0_psi_0", "lower stroke"),
        ("cdrun_toe_0_psi_0", "mid stroke"),
    ] {
        let said = done(
            folder.path(),
            &["run", case, "--set", "simulation.duration='6 s'", "--quiet"],
        );
        let row = said.lines().find(|line| line.starts_with(case)).unwrap();
        assert!(row.contains(window), "{said}");
        for defined in [
            "0.9 of its peak",
            "faster than 0.25 of it",
            "after the first half period",
        ] {
            assert!(said.contains(defined), "{defined}: {said}");
        }
        let summary = fs::read_to_string(folder.path().join(case).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert_eq!(summary["averages"]["window"], window);
    }
}

#[test]
fn input_issue_036_truncated_files_point_at_their_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    for (text, line) in [
        ("[wedge]\ndamping = \"vari", ":2:"),
        ("[wedge]\ndamping ", ":2:"),
        ("[wedge]\ndamping = \"variable\"\n[bolst", ":3:"),
        (
            "[bolster]\nvertical = { shape = \"table\", points = [[\"0 s\", \"0 in\"],",
            ":2:",
        ),
    ] {
        fs::write(path.join("cut.toml"), text).unwrap();
        refused(
            path,
            &["run", "cut.toml"],
            &["the file ends here", "was cut off", &format!("cut.toml{line}")],
        );
    }
    // Said once, also where the parser expects several things.
    fs::write(
        path.join("study.toml"),
        "case = \"vdrun_toe_0_psi_0\"\n[vary]\nfriction.column = { fro",
    )
    .unwrap();
    let output = wedgelab(path, &["study", "study.toml"]);
    assert_eq!(output.code, Some(2), "{}", output.err);
    assert_eq!(
        output.err.matches("the file ends here").count(),
        1,
        "{}",
        output.err
    );
    let short = ["--set", "simulation.duration='0.1 s'", "--quiet", "--out", "cut"];
    done(path, &[&["run", "vdrun_toe_0_psi_0"], &short[..]].concat());
    let summary = fs::read_to_string(path.join("cut/summary.json")).unwrap();
    fs::write(path.join("cut/summary.json"), &summary[..500]).unwrap();
    let last = format!("line {}", summary[..500].lines().count());
    refused(path, &["report", "cut"], &["the file ends here", &last]);
    // A mistake before the end is not taken for one.
    fs::write(path.join("wrong.toml"), "[wedge]\ndamping = variable\n").unwrap();
    let output = wedgelab(path, &["run", "wrong.toml"]);
    assert!(!output.err.contains("the file ends here"), "{}", output.err);
    let whole = nucars::builtin::text("Bolst_wedge_sf_68_constant.sys").unwrap();
    let cut = whole.split("\\PWL DATA").next().unwrap();
    fs::write(path.join("cut.sys"), cut).unwrap();
    let output = wedgelab(path, &["nucars", "check", "cut.sys"]);
    let said = format!("{}{}", output.out, output.err);
    let last = cut.trim_end().lines().count();
    let missing = said.split("no section `\\PWL DATA`").nth(1).unwrap();
    let place = missing
        .split("cut.sys:")
        .nth(1)
        .unwrap()
        .split(':')
        .next()
        .unwrap();
    assert!(
        place.parse::<usize>().unwrap() >= last,
        "{place} is not at the end, line {last}"
    );
    assert!(missing.contains("it was cut off here"), "{said}");
}

/// A file in a wrong place is called by what it is, and the command that takes it is named.
#[test]
fn issue_048_files_in_wrong_places_are_recognized() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let rows: String = (0..1300).map(|at| format!("{at},0.1\n")).collect();
    fs::write(
        path.join("car.csv"),
        format!("distance [ft],profile [in]\n,up\n{rows}"),
    )
    .unwrap();
    fs::write(path.join("wheel.csv"), "y [mm],z [mm]\n0,0\n1,0\n").unwrap();
    fs::write(
        path.join("assessment.json"),
        "{\"schema\": \"wedgelab.assessment/1\"}",
    )
    .unwrap();
    for (name, file) in [
        ("hunting", "regime.toml"),
        ("aar_chapter_xi", "limits.toml"),
        ("conditions", "conditions.toml"),
    ] {
        fs::write(path.join(file), done(path, &["regime", "--show", name])).unwrap();
    }
    fs::write(path.join("track.toml"), "[[segments]]\ntangent = \"500 ft\"\n").unwrap();
    let files = [
        ("car.csv", "a measured track", "[[irregularities]]"),
        (
            "wheel.csv",
            "a profile of a wheel or a rail",
            "wedgelab wheelrail check",
        ),
        ("assessment.json", "an assessment", "assess CAR --against DIR"),
        (
            "regime.toml",
            "a regime's file",
            "wedgelab regime regime.toml CAR",
        ),
        ("limits.toml", "a file of limits", "--limits limits.toml"),
        (
            "conditions.toml",
            "a file of conditions",
            "--conditions conditions.toml",
        ),
        ("track.toml", "a track file", "wedgelab track show track.toml"),
    ];
    let car = "car_tangent_empty";
    let doors: [(&str, &[&str], &[&str]); 8] = [
        ("", &["run"], &[]),
        ("", &["study"], &[]),
        ("track.toml", &["track", "show"], &[]),
        ("regime.toml", &["regime"], &[car]),
        ("limits.toml", &["assess", car, "--limits"], &[]),
        ("conditions.toml", &["assess", car, "--conditions"], &[]),
        ("wheel.csv", &["wheelrail", "check"], &["136re"]),
        ("", &["plot"], &["--x", "time", "--y", "distance"]),
    ];
    for (own, before, after) in doors {
        for (file, what, advice) in files.iter().filter(|(file, ..)| *file != own) {
            let arguments = [before, &[*file][..], after].concat();
            refused(path, &arguments, &[file, &format!("is {what}"), advice]);
        }
    }
}
