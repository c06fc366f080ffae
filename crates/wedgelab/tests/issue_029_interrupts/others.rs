//! `warp`, `curves`, `energy` and `lock-up`: what they say of what they keep is so.

use std::fs;

use tempfile::tempdir;

use crate::common::{ENDLESS, contains, hidden, names, start};

#[test]
fn issue_036_an_interrupted_first_test_is_not_said_to_be_written() {
    for (command, case) in [
        ("warp", "truck_warp_nest_constant_rising"),
        ("curves", "truck_vertical_variable"),
        ("energy", "vdrun_toe_0_psi_0"),
    ] {
        let folder = tempdir().unwrap();
        let path = folder.path();
        let mut running = start(path, &[&[command, case, "--out", "a"], &ENDLESS[..]].concat());
        running.wait_for_work();
        running.send("INT");
        let ended = running.ended();
        assert_eq!(ended.code, Some(130), "{command}: {}", ended.err);
        contains(&ended.err, &["interrupted", "nothing is written"]);
        for claim in ["is in a", "Written into", "try a softer"] {
            assert!(
                !ended.err.contains(claim) && !ended.out.contains(claim),
                "{command}: {}",
                ended.err
            );
        }
        assert!(
            names(path).is_empty() && hidden(path).is_empty(),
            "{command}: {:?}",
            names(path)
        );
    }
}

#[test]
fn issue_036_an_interrupted_lock_up_map_keeps_its_rigs() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let mut running = start(path, &["lock-up", "--points", "150", "--jobs", "1", "--out", "a"]);
    running.wait_for_work();
    running.send("INT");
    let ended = running.ended();
    assert_eq!(ended.code, Some(130), "{}", ended.err);
    contains(
        &ended.err,
        &[
            "the rigs that have ended are written",
            "of 22500 rigs were not run",
        ],
    );
    let table = fs::read_to_string(path.join("a/lock_up.csv")).unwrap();
    let count = |word: &str| table.lines().filter(|line| line.contains(word)).count();
    assert_eq!(table.lines().count(), 22501);
    assert!(count(",locks,") + count(",slides,") >= 1, "nothing was kept");
    assert!(count("interrupted") > 20000, "{}", count("interrupted"));
    let left: usize = ended
        .err
        .split("interrupted: ")
        .nth(1)
        .unwrap()
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert_eq!(left, count("interrupted"));
}
