//! `study` and `study --series`.

use std::fs;
use std::path::Path;

use report::study_folder::StudyFolder;
use study::design::Study;
use study::measures::{Measures, of_wedges};
use study::records::{Record, Status};
use tempfile::tempdir;

use crate::common::{SIGNALS, contains, done, hidden, names, start, start_by_shell, whole_run};

/// Three hundred runs of some milliseconds.
const SHORT: &str = "\
case = \"cdrun_toe_out_0.2_psi_0.012\"
sampling = \"full_factorial\"
[set]
simulation.duration = \"0.12 s\"
[vary]
friction.column = { from = 0.2, to = 0.6, count = 20 }
control_coil.stiffness = { from = \"1500 lbf/in\", to = \"2500 lbf/in\", count = 15 }
";
/// Files in the folder of a study that is done.
const WHOLE: [&str; 6] = [
    ".lock",
    "index.html",
    "parts",
    "study.json",
    "table.csv",
    "table.parquet",
];

/// Bytes of records that are there.
fn kept(folder: &Path) -> u64 {
    let parts = folder.join("parts");
    let sizes = names(&parts)
        .into_iter()
        .map(|name| fs::metadata(parts.join(name)).unwrap().len());
    sizes.sum()
}

#[test]
fn issue_029_a_study_goes_on_after_each_signal() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("short.toml"), SHORT).unwrap();
    done(path, &["study", "short.toml", "--out", "undisturbed", "--quiet"]);
    let mut before = 0;
    for (signal, code) in SIGNALS {
        let mut running = start(path, &["study", "short.toml", "--out", "a", "--jobs", "1"]);
        running.wait_until(|| kept(&path.join("a")) > before);
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(
            &ended.err,
            &[
                "stopping: the runs under way are finished and kept",
                "of 300 runs are kept in a",
                "the same command goes on from there",
            ],
        );
        assert!(hidden(path).is_empty() && !path.join("a/table.parquet").exists());
        assert!(kept(&path.join("a")) > before);
        before = kept(&path.join("a"));
    }
    let said = done(path, &["study", "short.toml", "--out", "a"]);
    contains(&said.out, &["were there before"]);
    assert_eq!(names(&path.join("a")), WHOLE);
    let table = |name: &str| fs::read(path.join(name).join("table.parquet")).unwrap();
    assert!(table("a") == table("undisturbed"));
}

/// The second signal does not wait for runs that take long.
#[test]
fn issue_029_a_second_signal_ends_a_study_at_once() {
    for (signal, code) in SIGNALS {
        let folder = tempdir().unwrap();
        let path = folder.path();
        fs::write(
            path.join("long.toml"),
            SHORT.replace("0.12 s\"", "100000 s\"\nsimulation.output_interval = \"0.5 s\""),
        )
        .unwrap();
        let mut running = start(path, &["study", "long.toml", "--out", "a", "--jobs", "1"]);
        running.wait_for_work();
        running.send(signal);
        running.wait_until_it_says("stopping: the runs under way are finished and kept");
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(
            &ended.err,
            &[
                "stopping: the runs under way are finished",
                "interrupted: the runs that ended are kept in a. The same command goes on",
            ],
        );
        assert!(hidden(path).is_empty());
    }
}

/// All runs are there, made up, and the table is being written.
#[test]
fn issue_029_a_study_that_is_interrupted_in_its_table_leaves_none() {
    const RUNS: u64 = 20_000;
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = format!(
        "case = \"cdrun_toe_out_0.2_psi_0.012\"\nsampling = \"sobol\"\nruns = {RUNS}\n[vary]\n\
         friction.column = {{ from = 0.2, to = 0.6 }}\nfriction.slope = {{ from = 0.2, to = 0.6 }}\n"
    );
    fs::write(path.join("large.toml"), text).unwrap();
    let study = Study::read(&path.join("large.toml")).unwrap();
    let mut bytes = Vec::new();
    for number in 0..RUNS {
        let mut measures = Measures(vec![f64::NAN; of_wedges().len()]);
        for (place, value) in measures.0.iter_mut().enumerate() {
            *value = (number as f64 + place as f64).sin();
        }
        let record = Record {
            number,
            status: Status::Complete,
            reason: String::new(),
            measures,
        };
        record.write(study.fingerprint(), &mut bytes);
    }
    let own = StudyFolder::open(&path.join("a"), &study).unwrap();
    assert_eq!(own.keep_all(&bytes).unwrap(), RUNS);
    drop(own);
    for (signal, code) in SIGNALS {
        let mut running = start(path, &["study", "large.toml", "--out", "a", "--quiet"]);
        running.wait_until(|| {
            let hidden = hidden(&path.join("a"));
            hidden
                .iter()
                .any(|path| path.join("result/table.parquet").exists())
        });
        running.send(signal);
        let ended = running.ended();
        assert!(hidden(path).is_empty());
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(&ended.err, &["interrupted: 20000 of 20000 runs are kept in a"]);
        if !path.join("a/table.parquet").exists() {
            assert_eq!(names(&path.join("a")), [".lock", "parts", "study.json"]);
        }
    }
    let said = done(path, &["study", "large.toml", "--out", "a"]);
    contains(&said.out, &["20000 were there before"]);
    assert_eq!(names(&path.join("a")), WHOLE);
}

#[test]
fn issue_029_series_that_are_interrupted_are_whole_or_not_there() {
    for (signal, code) in SIGNALS {
        let folder = tempdir().unwrap();
        let path = folder.path();
        let text = "case = \"cdrun_toe_out_0.2_psi_0.012\"\nsampling = \"full_factorial\"\n[vary]\n\
             simulation.duration = [\"0.05 s\", \"3000 s\"]\n";
        fs::write(path.join("two.toml"), text.replace("0.05", "0.06")).unwrap();
        let mut running = start(path, &["study", "two.toml", "--out", "a", "--series", "0", "1"]);
        running.wait_for_work();
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(
            &ended.err,
            &[
                "1 of 2 runs are written, and whole",
                "--series 1 computes those that are missing",
            ],
        );
        assert!(hidden(path).is_empty());
        assert_eq!(names(&path.join("a/series")), ["0"]);
        assert_eq!(whole_run(&path.join("a/series/0"))["complete"], true);
    }
}

/// The terminal hangs up on a study that was started with `nohup`.
#[test]
fn issue_029_a_study_under_nohup_survives_a_hangup() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("short.toml"), SHORT).unwrap();
    let mut running = start_by_shell(path, "exec nohup \"$0\" study short.toml --out a --jobs 1");
    running.wait_until(|| kept(&path.join("a")) > 0);
    running.send("HUP");
    let ended = running.ended();
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert_eq!(names(&path.join("a")), WHOLE);
}
