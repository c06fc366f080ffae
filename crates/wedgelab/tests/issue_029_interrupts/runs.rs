//! `run`, `nucars run` and `fit`, which compute for long.

use std::fs;

use nucars::builtin;
use tempfile::tempdir;

use crate::common::{ENDLESS, SIGNALS, contains, done, hidden, names, start, start_by_shell, whole_run};

#[test]
fn issue_029_a_run_that_is_interrupted_writes_what_was_computed() {
    for (signal, code) in SIGNALS {
        let folder = tempdir().unwrap();
        let path = folder.path();
        let call = ["run", "vdrun_toe_0_psi_0", "--out", "a"];
        let mut running = start(path, &[&call[..], &ENDLESS].concat());
        running.wait_for_work();
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(
            &ended.err,
            &[
                "stopping: what was computed is written",
                "is incomplete: interrupted",
                "is in a, marked as incomplete",
                "--force",
            ],
        );
        assert!(hidden(path).is_empty());
        assert_eq!(names(path), ["a"]);
        let summary = whole_run(&path.join("a"));
        assert_eq!(summary["complete"], false);
        assert_eq!(summary["stopped"]["reason"], "interrupted");
        assert!(summary["stopped"]["time"].as_f64().unwrap() > 0.0);
        // The way to go on that was told; the incomplete result is not overwritten by accident.
        let short = ["--set", "simulation.duration=0.05 s"];
        let again = start(path, &[&call[..], &short].concat()).ended();
        assert_eq!(again.code, Some(2), "{}", again.err);
        done(path, &[&call[..], &short, &["--force"]].concat());
        assert_eq!(whole_run(&path.join("a"))["complete"], true);
    }
}

#[test]
fn issue_029_a_half_truck_that_is_interrupted_is_written() {
    const RUN: &str = "Bolst_wedge_sf_bolst-vert-displ_68_constant.run";
    for (signal, code) in SIGNALS {
        let folder = tempdir().unwrap();
        let path = folder.path();
        for name in builtin::names() {
            let text = builtin::text(name).unwrap();
            let longer = text.replace("0.01 20.0 0.1", "0.01 3000.0 0.1");
            assert!(name != RUN || text != longer);
            fs::write(path.join(name), longer).unwrap();
        }
        let mut running = start(
            path,
            &[
                "nucars",
                "run",
                RUN,
                "--data",
                "sngl_trk_68.dat",
                "--out",
                "deep/a",
            ],
        );
        running.wait_for_work();
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(
            &ended.err,
            &["is incomplete: interrupted", "is in deep/a, marked as incomplete"],
        );
        assert!(hidden(path).is_empty());
        let summary = whole_run(&path.join("deep/a"));
        assert_eq!(summary["complete"], false);
        assert_eq!(summary["stopped"]["reason"], "interrupted");
    }
}

#[test]
fn issue_029_an_interrupted_fit_writes_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    done(
        path,
        &[
            "run",
            "cdrun_toe_out_0.2_psi_0.012",
            "--out",
            "measured",
            "--set",
            "simulation.duration=60 s",
        ],
    );
    for (signal, code) in SIGNALS {
        let mut running = start(
            path,
            &[
                "fit",
                "measured",
                "cdrun_toe_out_0.2_psi_0.012",
                "--free",
                "friction.column=0.2..0.6",
                "friction.slope=0.2..0.6",
            ],
        );
        running.wait_for_work();
        running.send(signal);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        contains(&ended.err, &["interrupted: nothing was written"]);
        assert!(hidden(path).is_empty());
        assert_eq!(names(path), ["measured"]);
    }
}

/// A command started in the background of a shell or by `nohup` ignores signals, and goes on ignoring them.
#[test]
fn issue_029_signals_that_are_ignored_from_the_start_stay_so() {
    for (line, ignored, other, code) in [
        ("exec nohup \"$0\" run", "HUP", "INT", 130),
        ("trap '' INT; exec \"$0\" run", "INT", "TERM", 143),
    ] {
        let folder = tempdir().unwrap();
        let path = folder.path();
        let line = format!(
            "{line} vdrun_toe_0_psi_0 --out a {} '{}' {} '{}'",
            ENDLESS[0], ENDLESS[1], ENDLESS[2], ENDLESS[3]
        );
        let mut running = start_by_shell(path, &line);
        running.wait_for_work();
        running.send(ignored);
        // Long enough for a program that does not ignore it.
        std::thread::sleep(std::time::Duration::from_millis(300));
        assert!(running.is_working());
        running.send(other);
        let ended = running.ended();
        assert_eq!(ended.code, Some(code), "{}", ended.err);
        assert_eq!(whole_run(&path.join("a"))["complete"], false);
    }
}
