//! A study ends in the same table, however it was ended in between and however many work at it.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use tempfile::tempdir;

use crate::common::{SMALL, command, done, names, output, refused, table, wedgelab};

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

/// Bytes of records that are there.
fn kept(folder: &Path) -> u64 {
    let parts = folder.join("parts");
    names(&parts)
        .iter()
        .map(|name| fs::metadata(parts.join(name)).unwrap().len())
        .sum()
}

/// Kills until it has been killed at work so often, each time at another moment, and never loses what was there.
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
    fs::write(path.join("small.toml"), SMALL).unwrap();
    done(path, &["study", "small.toml", "--out", "undisturbed", "--quiet"]);
    let killed = kill_often(path, "small.toml", "killed", 10, 5, 120);
    assert!(killed > 0, "every run was over before it could be killed");
    done(path, &["study", "small.toml", "--out", "killed", "--quiet"]);
    assert!(table(&path.join("undisturbed")) == table(&path.join("killed")));
    // Killed while the table is written: all runs are there, and it is written each time.
    kill_often(path, "small.toml", "killed", 10, 1, 40);
    let again = done(path, &["study", "small.toml", "--out", "killed"]);
    assert!(again.out.contains("120 were there before"), "{}", again.out);
    assert!(table(&path.join("undisturbed")) == table(&path.join("killed")));
    assert_eq!(
        names(&path.join("killed")),
        [".lock", "index.html", "parts", "study.json", "table.parquet"],
        "nothing is left over"
    );
}

/// Ten thousand runs and ten kills: some minutes. Run it with `--ignored`.
#[test]
#[ignore = "some minutes"]
fn limits_ten_thousand_runs_survive_ten_kills() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = SMALL
        .replace("count = 12", "count = 100")
        .replace("count = 10", "count = 100")
        .replace("0.12 s", "0.02 s");
    fs::write(path.join("large.toml"), text).unwrap();
    assert_eq!(kill_often(path, "large.toml", "killed", 10, 200, 4000), 10);
    done(path, &["study", "large.toml", "--out", "killed", "--quiet"]);
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
    fs::write(path.join("long.toml"), SMALL.replace("0.12 s", "2 s")).unwrap();
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
    assert_eq!(ended.status.code(), Some(1), "{err}");
    assert!(err.contains("of 120 runs are kept in a"), "{err}");
    assert!(kept(&path.join("a")) > 0 && !path.join("a/table.parquet").exists());
}

#[test]
#[cfg(unix)]
fn input_a_full_disk_loses_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    // Begun, without a run.
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    fs::remove_dir_all(path.join("a/parts")).unwrap();
    fs::remove_file(path.join("a/table.parquet")).unwrap();
    // No file may grow beyond 4 KiB: as a full disk it refuses to be written to.
    let limited = format!(
        "trap '' XFSZ; ulimit -f 8; exec '{}' study small.toml --out a --quiet",
        env!("CARGO_BIN_EXE_wedgelab")
    );
    let full = output(Command::new("sh").arg("-c").arg(limited).current_dir(path));
    assert_eq!(full.code, Some(1), "{}", full.err);
    for text in [
        "cannot write into",
        "all runs that were written before are kept",
        "goes on",
    ] {
        assert!(full.err.contains(text), "{text:?}: {}", full.err);
    }
    assert!(kept(&path.join("a")) > 2000 && !path.join("a/table.parquet").exists());
    let again = done(path, &["study", "small.toml", "--out", "a"]);
    assert!(again.out.contains("were there before"), "{}", again.out);
    done(path, &["study", "small.toml", "--out", "b", "--quiet"]);
    assert!(table(&path.join("a")) == table(&path.join("b")));
}

#[test]
fn input_damaged_parts_are_computed_again_and_foreign_ones_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    let whole = table(&path.join("a"));
    let part = path.join("a/parts/part-000001");
    let mut bytes = fs::read(&part).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    bytes.truncate(bytes.len() - 3);
    fs::write(&part, &bytes).unwrap();
    let again = wedgelab(path, &["study", "small.toml", "--out", "a"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    assert!(again.err.contains("cut off or damaged") && again.out.contains("118 were there before"));
    assert!(table(&path.join("a")) == whole);
    // A part of another study.
    fs::write(path.join("other.toml"), SMALL.replace("0.6,", "0.5,")).unwrap();
    done(path, &["study", "other.toml", "--out", "b", "--quiet"]);
    fs::copy(path.join("b/parts/part-000001"), &part).unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        1,
        &["part-000001", "another study", "move this file away"],
    );
    fs::remove_file(&part).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    assert!(table(&path.join("a")) == whole);
}

#[test]
fn input_a_folder_in_use_is_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    fs::create_dir(path.join("a")).unwrap();
    let lock = fs::File::create(path.join("a/.lock")).unwrap();
    lock.lock().unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        2,
        &["another program works in"],
    );
    drop(lock);
    fs::File::create(path.join("a/mine.txt"))
        .unwrap()
        .write_all(b"mine")
        .unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        2,
        &["holds no study", "mine.txt"],
    );
}
