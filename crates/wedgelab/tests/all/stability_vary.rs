//! `wedgelab stability --vary`: files, words, refusals.

use crate::common;
use std::fs;

use common::wedgelab;

/// Linear wheels over their conicity: the table has both states of friction at all values, and the terminal
/// the vibration that grows most.
#[test]
fn limits_a_locus_is_written_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let arguments = "stability car_hunting_empty -q --set wheels.geometry=linear \
                     --set track.support.kind=rigid --vary wheels.conicity=0.05..0.2 --vary-steps 4 \
                     --vary-speed 60mph --out l";
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    let output = wedgelab(at, &arguments);
    assert_eq!(output.code, Some(0), "{}", output.err);
    for part in ["wheels.conicity", "0.15", "at 60.0 mph", "locus.csv"] {
        assert!(output.out.contains(part), "lacks {part}: {}", output.out);
    }
    let table = fs::read_to_string(at.join("l/locus.csv")).unwrap();
    let head = "parameter,value,unit,friction,growth_per_s,frequency_hz,damping_ratio,motion";
    assert_eq!(table.lines().next(), Some(head));
    for value in ["0.05", "0.1", "0.15", "0.2"] {
        for friction in ["stuck", "absent"] {
            let begin = format!("wheels.conicity,{value},,{friction},");
            assert!(table.lines().any(|line| line.starts_with(&begin)), "{begin}");
        }
    }
    assert!(fs::read(at.join("l/locus.png")).unwrap().starts_with(b"\x89PNG"));
    assert!(
        fs::read_to_string(at.join("l/locus.svg"))
            .unwrap()
            .contains("wheels.conicity")
    );
    // Results are not overwritten unasked.
    assert_eq!(wedgelab(at, &arguments).code, Some(2));
}

/// What makes no locus is refused in words, and nothing is written.
#[test]
fn input_ranges_and_values_that_make_no_locus_say_so() {
    let folder = tempfile::tempdir().unwrap();
    for (vary, parts) in [
        ("wheels.geometry=1..2", &["wheels.geometry is no number"][..]),
        (
            "speed.value=30 mph",
            &["there is no `..`", "truck.center_plate.friction"],
        ),
        (
            "speed.value=30 mph..40 m/s",
            &["the units differ", "the same unit"],
        ),
        (
            "truck.center_plate.friction=0.1..-1",
            &["truck.center_plate.friction = -1 makes no car"],
        ),
    ] {
        let output = wedgelab(
            folder.path(),
            &[
                "stability",
                "car_hunting_empty",
                "--vary",
                vary,
                "--vary-steps",
                "2",
            ],
        );
        assert_eq!(output.code, Some(2), "{vary}: {}", output.err);
        // Messages are broken into lines.
        let words: Vec<&str> = output
            .err
            .split(|c: char| c.is_whitespace() || c == '│')
            .collect();
        let words = words
            .into_iter()
            .filter(|own| !own.is_empty())
            .collect::<Vec<_>>()
            .join(" ");
        for part in parts {
            assert!(words.contains(part), "{vary} lacks {part}: {words}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let both = [
        "stability",
        "car_hunting_empty",
        "--vary",
        "a.b=1..2",
        "--nonlinear",
    ];
    assert_eq!(wedgelab(folder.path(), &both).code, Some(2));
}
