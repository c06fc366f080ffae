//! A study ends in the same table, however it was ended in between and however many work at it.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use report::study_folder::StudyFolder;
use study::design::Study;
use study::measures::{Measures, of_wedges};
use study::records::{Record, Status};
use tempfile::tempdir;

use crate::common::{SMALL, WHOLE, command, done, kept, names, recorded, table};

/// Kills the command after these milliseconds; whether it was still at work.
fn kill_after(folder: &Path, arguments: &[&str], milliseconds: u64) -> bool {
    let mut child = command(folder, arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(milliseconds));
    let working = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    working
}

/// Kills until it has been killed at work so often, each time at another moment, and never loses what was
/// there.
fn kill_often(folder: &Path, study: &str, out: &str, often: u32, least: u64, span: u64) -> u32 {
    let (mut killed, mut random, mut before) = (0, 0x2545_f491_4f6c_dd1d_u64, 0);
    for _ in 0..often {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        killed += u32::from(kill_after(
            folder,
            &["study", study, "--out", out, "--quiet"],
            least + random % span,
        ));
        if folder.join(out).join("parts").exists() {
            let now = kept(&folder.join(out));
            assert!(now >= before, "records were lost: {before} and then {now} bytes");
            before = now;
        }
    }
    killed
}

#[test]
fn limits_killed_ten_times_it_has_the_table_of_an_undisturbed_study() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = SMALL
        .replace("count = 12", "count = 20")
        .replace("count = 10", "count = 15");
    fs::write(path.join("small.toml"), text).unwrap();
    done(path, &["study", "small.toml", "--out", "undisturbed", "--quiet"]);
    let killed = kill_often(path, "small.toml", "killed", 10, 5, 120);
    assert!(killed > 0, "every run was over before it could be killed");
    done(path, &["study", "small.toml", "--out", "killed", "--quiet"]);
    assert!(table(&path.join("undisturbed")) == table(&path.join("killed")));
    let numbers = recorded(path, "small.toml", "killed");
    assert!(
        numbers.iter().copied().eq(0..300),
        "each run is kept once: {numbers:?}"
    );
    let again = done(path, &["study", "small.toml", "--out", "killed"]);
    assert!(again.out.contains("300 were there before"), "{}", again.out);
    assert_eq!(names(&path.join("killed")), WHOLE, "nothing is left over");
}

/// The same of cars, whose runs take longer.
#[test]
fn limits_a_killed_study_of_cars_has_the_table_of_an_undisturbed_one() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let car = "model = \"car\"\nstart.settle = \"0 s\"\nsimulation.duration = \"0.1 s\"\n\
               [[track.segments]]\ntangent = \"500 ft\"\n";
    fs::write(path.join("car.toml"), car).unwrap();
    let text = "case = \"car.toml\"\nsampling = \"full_factorial\"\n[vary]\n\
                truck.friction.column = { from = 0.2, to = 0.5, count = 8 }\n";
    fs::write(path.join("cars.toml"), text).unwrap();
    done(path, &["study", "cars.toml", "--out", "undisturbed", "--quiet"]);
    let killed = kill_often(path, "cars.toml", "killed", 4, 20, 400);
    assert!(killed > 0, "every run was over before it could be killed");
    done(path, &["study", "cars.toml", "--out", "killed", "--quiet"]);
    assert!(table(&path.join("undisturbed")) == table(&path.join("killed")));
    assert!(recorded(path, "cars.toml", "killed").into_iter().eq(0..8));
}

/// Killed while Parquet is written, seen by the file that grows: twenty thousand rows, made up, so that it
/// takes a while.
#[test]
fn limits_killed_while_the_table_is_written_it_writes_it_again() {
    const RUNS: u64 = 20_000;
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = format!(
        "case = \"cdrun_toe_out_0.2_psi_0.012\"\nsampling = \"sobol\"\nruns = {RUNS}\n[vary]\n\
         friction.column = {{ from = 0.2, to = 0.6 }}\nfriction.slope = {{ from = 0.2, to = 0.6 }}\n"
    );
    fs::write(path.join("large.toml"), text).unwrap();
    make_up(path, "large.toml", "killed", RUNS);
    let killed = path.join("killed");
    let mut torn = 0;
    for pause in [0, 0, 1, 2, 5, 10, 20] {
        let mut child = command(path, &["study", "large.toml", "--out", "killed", "--quiet"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        while !being_written(&killed) && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        std::thread::sleep(Duration::from_millis(pause));
        child.kill().unwrap();
        child.wait().unwrap();
        torn += u32::from(being_written(&killed));
    }
    assert!(torn > 0, "it was never killed while the table was written");
    assert!(recorded(path, "large.toml", "killed").into_iter().eq(0..RUNS));
    let said = done(path, &["study", "large.toml", "--out", "killed"]);
    assert!(said.out.contains("20000 were there before"), "{}", said.out);
    assert_eq!(names(&killed), WHOLE, "nothing is left over");
    make_up(path, "large.toml", "undisturbed", RUNS);
    done(path, &["study", "large.toml", "--out", "undisturbed", "--quiet"]);
    assert!(table(&killed) == table(&path.join("undisturbed")));
}

/// Keeps made-up records of all runs.
fn make_up(path: &Path, study: &str, out: &str, runs: u64) {
    let study = Study::read(&path.join(study)).unwrap();
    let mut bytes = Vec::new();
    for number in 0..runs {
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
    let folder = StudyFolder::open(&path.join(out), &study).unwrap();
    assert_eq!(folder.keep_all(&bytes).unwrap(), runs);
}

/// Returns whether a table that is not whole lies there.
fn being_written(folder: &Path) -> bool {
    let mut entries = fs::read_dir(folder).unwrap().flatten();
    entries.any(|entry| entry.path().join("result/table.parquet").exists())
}

/// Ten thousand runs and ten kills: some minutes. Run it with `--ignored`.
#[test]
#[ignore = "some minutes"]
fn limits_ten_thousand_runs_survive_ten_kills() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = SMALL
        .replace("count = 10", "count = 100")
        .replace("count = 12", "count = 100")
        .replace("0.12 s", "0.02 s");
    fs::write(path.join("large.toml"), text).unwrap();
    assert_eq!(kill_often(path, "large.toml", "killed", 10, 100, 1500), 10);
    done(path, &["study", "large.toml", "--out", "killed", "--quiet"]);
    assert!(recorded(path, "large.toml", "killed").into_iter().eq(0..10_000));
    done(
        path,
        &[
            "study",
            "large.toml",
            "--out",
            "undisturbed",
            "--quiet",
            "--jobs",
            "1",
        ],
    );
    assert!(table(&path.join("undisturbed")) == table(&path.join("killed")));
}

#[test]
fn limits_the_number_of_jobs_changes_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    let of = |jobs: &str| {
        done(
            path,
            &["study", "small.toml", "--out", jobs, "--jobs", jobs, "--quiet"],
        );
        let page = fs::read(path.join(jobs).join("index.html")).unwrap();
        (table(&path.join(jobs)), page)
    };
    let one = of("1");
    assert!(one == of("2") && one == of("5"));
}

#[test]
#[cfg(unix)]
fn limits_interrupted_it_says_so_and_goes_on() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("long.toml"), SMALL.replace("0.12 s", "6 s")).unwrap();
    let child = command(path, &["study", "long.toml", "--out", "a", "--jobs", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let parts = path.join("a/parts");
    for _ in 0..3000 {
        if parts.exists() && kept(&path.join("a")) > 0 {
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let interrupt = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(interrupt.unwrap().success());
    let ended = child.wait_with_output().unwrap();
    let err = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(130), "{err}");
    assert!(err.contains("of 120 runs are kept in a"), "{err}");
    assert!(kept(&path.join("a")) > 0 && !path.join("a/table.parquet").exists());
}
