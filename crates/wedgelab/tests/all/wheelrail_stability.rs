//! input, limits: `wedgelab wheelrail stability`, as its user meets it.

use std::path::Path;
use std::process::Command;

fn command(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder)
        .args(["wheelrail", "stability"])
        .args(arguments)
        .env_remove("FORCE_COLOR")
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// The sentence, the table of the terminal and that of the file say the same: growth changes its sign at the
/// critical speed.
#[test]
fn limits_table_and_sentence_agree() {
    let folder = tempfile::tempdir().unwrap();
    let soft = [
        "aar_1b",
        "136re",
        "--load",
        "70 kN",
        "--lateral-stiffness",
        "150 kN/m",
        "--yaw-stiffness",
        "800 kN m/rad",
        "--lateral-damping",
        "0 N s/m",
        "--yaw-damping",
        "0 N m s/rad",
        "--speeds",
        "40 m/s..100 m/s",
        "--steps",
        "4",
        "--units",
        "si",
        "-q",
    ];
    let (code, out, err) = command(folder.path(), &soft);
    assert_eq!(code, Some(0), "{err}");
    let words: Vec<&str> = out.split_whitespace().collect();
    let place = words.iter().position(|own| *own == "hunts,").unwrap();
    let critical: f64 = words[place - 4].parse().unwrap_or_else(|_| panic!("{out}"));
    assert_eq!(words[place - 3], "m/s");
    let table = std::fs::read_to_string(folder.path().join("wheelset_stability/stability.csv")).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 4);
    for row in &rows {
        assert_eq!(row[1] > 0.0, row[0] > critical, "{critical}: {row:?}");
        assert_eq!(row[3] < 0.0, row[1] > 0.0);
    }
    for name in ["stability.svg", "stability.png"] {
        assert!(folder.path().join("wheelset_stability").join(name).exists());
    }
    let (code, _, err) = command(folder.path(), &soft);
    assert_eq!(code, Some(2));
    assert!(err.contains("--force"), "{err}");
}

/// What makes no wheelset is refused with what to do.
#[test]
fn input_refusals_say_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, expected) in [
        (&["--load", "1 kip"][..], "axle load"),
        (&["--speeds", "30 mph"], "30 mph"),
        (&["--friction", "3"], "between 0 and 2"),
        (&["--steps", "1"], "1"),
        (&["--gauge", "70 in"], "gauge"),
    ] {
        let all = [&["aar_1b", "136re", "-q"], arguments].concat();
        let (code, _, err) = command(folder.path(), &all);
        assert_eq!(code, Some(2), "{arguments:?}: {err}");
        assert!(err.contains(expected), "{arguments:?}: {err}");
        assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
    }
}
