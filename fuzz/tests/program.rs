//! The program sees every way in which a reader may break.

#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

fn fuzz(arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_fuzz"));
    let Output {
        status,
        stdout,
        stderr,
    } = command.args(arguments).output().unwrap();
    let text = [stdout, stderr].map(|text| String::from_utf8_lossy(&text).into_owned());
    (status.code(), text.concat())
}

#[test]
fn whatever_breaks_is_found_and_found_again() {
    let saved = tempfile::tempdir().unwrap();
    let folder = saved.path().to_str().unwrap();
    let call = [
        "--reader",
        "broken",
        "--executions",
        "7",
        "--patience",
        "6",
        "--save",
        folder,
    ];
    let (code, text) = fuzz(&call);
    assert_eq!(code, Some(1), "{text}");
    for (number, what) in [
        (1, "promise broken"),
        (2, "abort: overflowed its stack"),
        (3, "abort: memory allocation of"),
        (4, "too slow"),
        (5, "hangs"),
        (6, "message too long"),
    ] {
        assert!(
            text.contains(&format!("broken: {what}, 1 times")),
            "{what}: {text}"
        );
        let address = format!("broken:1:{number}");
        assert!(
            text.contains(&format!("--repeat {address}\n")),
            "{address}: {text}"
        );
        assert!(saved.path().join(format!("broken-1-{number}.input")).is_file());
    }
    // Six were done, and the first of them was accepted.
    let row = text.lines().find(|line| line.starts_with("broken  ")).unwrap();
    let cells: Vec<&str> = row.split_whitespace().collect();
    assert_eq!(cells[1..3], ["7", "2"], "{text}");
    for (number, what) in [
        (1, "promise broken"),
        (2, "overflowed its stack"),
        (6, "message too long"),
    ] {
        let (code, text) = fuzz(&["--repeat", &format!("broken:1:{number}")]);
        assert_eq!(code, Some(1), "{text}");
        assert!(text.contains(what), "{text}");
    }
}

#[test]
fn what_is_sound_is_called_sound() {
    let (code, text) = fuzz(&["--repeat", "broken:1:0"]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("accepted"), "{text}");
    let (code, text) = fuzz(&["--reader", "free", "--executions", "5"]);
    assert_eq!(code, Some(0), "{text}");
}

#[test]
fn wrong_calls_are_refused() {
    for call in [
        &["--reader", "none"][..],
        &["--seconds", "-1"],
        &["--seconds", "1", "--executions", "1"],
        &["--repeat", "units:1"],
        &["--repeat", "none:1:1"],
    ] {
        let (code, text) = fuzz(call);
        assert_eq!(code, Some(2), "{text}");
        assert!(text.len() > 20, "{text}");
    }
}
