//! `compare`, `plot` and `fmu`, which write for a moment: whenever a signal comes, all is there or nothing.
//!
//! Only where the system tells when a program has begun to listen.

#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::time::Duration;

use tempfile::tempdir;

use crate::common::{SIGNALS, done, hidden, names, start};

/// Sends signals to a command at many moments. It leaves `made` as a whole (as `whole` says) or nothing, and
/// is caught before its end at least once.
fn at_all_moments(path: &Path, arguments: &[&str], made: &str, whole: impl Fn(&Path)) {
    let before = names(path);
    let made = path.join(made);
    let mut caught = 0;
    for round in 0..12 {
        let (signal, code) = SIGNALS[round % SIGNALS.len()];
        let mut running = start(path, arguments);
        running.wait_until_it_listens(code as u32 - 128);
        // Until it begins to write, in every other round, and a bit longer each time.
        if round % 2 == 0 {
            running.wait_until(|| !hidden(path).is_empty());
        }
        std::thread::sleep(Duration::from_millis(round as u64));
        running.send(signal);
        let ended = running.ended();
        assert!(hidden(path).is_empty(), "{arguments:?}");
        match ended.code {
            Some(0) => assert!(made.exists()),
            other => {
                assert_eq!(other, Some(code), "{}", ended.err);
                caught += 1;
                let says_nothing = ended.err.contains("interrupted: nothing was written");
                assert_eq!(says_nothing, !made.exists(), "{}", ended.err);
            }
        }
        if made.is_dir() {
            whole(&made);
            fs::remove_dir_all(&made).unwrap();
        } else if made.exists() {
            whole(&made);
            fs::remove_file(&made).unwrap();
        }
        assert_eq!(names(path), before);
    }
    assert!(caught > 0, "{arguments:?} was always over before the signal came");
}

#[test]
fn issue_029_comparisons_and_figures_are_whole_or_not_there() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    for (name, friction) in [("one", "0.3"), ("two", "0.4")] {
        let set = format!("friction.column={friction}");
        done(path, &["run", "vdrun_toe_0_psi_0", "--out", name, "--set", &set]);
    }
    done(path, &["compare", "one", "two", "--out", "undisturbed"]);
    let wanted = names(&path.join("undisturbed"));
    at_all_moments(
        path,
        &["compare", "one", "two", "--out", "new"],
        "new",
        |folder| {
            assert_eq!(names(folder), wanted);
            for name in &wanted {
                let read = |folder: &Path| fs::read(folder.join(name)).unwrap();
                assert!(read(folder) == read(&path.join("undisturbed")), "{name}");
            }
        },
    );
    let plot = ["plot", "one", "--x", "time", "--y", "wedge_z", "--out"];
    for (name, undisturbed) in [("a.svg", "b.svg"), ("a.png", "b.png")] {
        done(path, &[&plot[..], &[undisturbed]].concat());
        at_all_moments(path, &[&plot[..], &[name]].concat(), name, |file| {
            assert!(fs::read(file).unwrap() == fs::read(path.join(undisturbed)).unwrap());
        });
    }
}

#[test]
fn issue_029_fmus_are_whole_or_not_there() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    // As large as a real library, and packed no faster.
    let noise = (0..3_000_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8);
    let library: Vec<u8> = b"\x7fELF".iter().copied().chain(noise).collect();
    fs::write(path.join("library"), library).unwrap();
    let case = "vdrun_toe_0_psi_0";
    let export = ["fmu", "export", case, "--library", "library", "-o"];
    done(path, &[&export[..], &["undisturbed.fmu"]].concat());
    let same = |other: &'static str| {
        move |file: &Path| {
            let read = |file: &Path| fs::read(file).unwrap();
            assert!(read(file) == read(&file.with_file_name(other)));
        }
    };
    at_all_moments(
        path,
        &[&export[..], &["a.fmu"]].concat(),
        "a.fmu",
        same("undisturbed.fmu"),
    );
    let ssp = ["fmu", "ssp", case, "--library", "library", "-o"];
    done(path, &[&ssp[..], &["undisturbed.ssp"]].concat());
    at_all_moments(
        path,
        &[&ssp[..], &["a.ssp"]].concat(),
        "a.ssp",
        same("undisturbed.ssp"),
    );
    let merge = ["fmu", "merge", "undisturbed.fmu", "undisturbed.fmu", "-o"];
    done(path, &[&merge[..], &["merged.fmu"]].concat());
    at_all_moments(
        path,
        &[&merge[..], &["b.fmu"]].concat(),
        "b.fmu",
        same("merged.fmu"),
    );
}
