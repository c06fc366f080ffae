//! Issue 29: tables of another kind or size, and comparisons that overflow.

use std::fs;
use std::path::Path;

use report::comparison::{ComparedResult, Comparison, ComparisonError};
use report::table::{ResultTable, TableError};

fn wrong(text: &[u8]) -> TableError {
    ResultTable::parse(Path::new("some.csv"), text).unwrap_err()
}

#[test]
fn issue_029_messages_are_short_whatever_was_written() {
    let long = "x".repeat(1_000_000);
    let columns: String = (0..10_000).map(|number| format!(",column_{number}")).collect();
    for (text, said) in [
        (
            format!("time_s,{long}\n0,1\n"),
            "the name of column 2 has 1000000 characters",
        ),
        (format!("time_s,wedge_x_in\n0,{long}\n"), "is not a finite number"),
        (
            format!("time_s{columns}\n0,1\n"),
            "10001 columns; at most 5000 are read",
        ),
        (
            format!("time_s,wedge_x_in\n0,1\n{}", ",".repeat(5 << 20)),
            "line 3: the line has more than",
        ),
    ] {
        let error = wrong(text.as_bytes()).to_string();
        assert!(
            error.contains(said) && error.len() < 1500,
            "{} bytes",
            error.len()
        );
    }
}

#[test]
fn issue_029_files_of_another_kind_are_recognized() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("result.csv");
    for (content, what, advice) in [
        (
            "[wedge]\nangle = \"32 deg\"\n",
            "is a case file; a table is expected",
            "`wedgelab run ",
        ),
        ("case = \"x\"\n", "is a study file", "`wedgelab study "),
        ("\\BODY DATA\n", "is a file of NUCARS", "`wedgelab nucars check "),
        ("PAR1", "the Parquet table", "write or copy it again"),
    ] {
        fs::write(&file, content).unwrap();
        let error = ResultTable::read(&file).unwrap_err();
        let help = miette::Diagnostic::help(&error).unwrap().to_string();
        assert!(
            error.to_string().contains(what) && help.contains(advice),
            "{error}: {help}"
        );
    }
}

#[cfg(unix)]
#[test]
fn issue_029_devices_are_not_read_to_their_end() {
    let error = ResultTable::read(Path::new("/dev/zero")).unwrap_err();
    assert!(error.to_string().contains("is not text"), "{error}");
}

/// Differences and means of numbers near the largest that there are were infinite, and called a comparison.
#[test]
fn issue_029_comparisons_that_overflow_are_refused() {
    let entry = |label: &str, value: &str| ComparedResult {
        label: label.to_owned(),
        table: ResultTable::parse(
            Path::new("some.csv"),
            format!("time_s,wedge_x_in\n0,{value}\n1,{value}\n").as_bytes(),
        )
        .unwrap(),
    };
    for (first, second) in [("1e308", "-1e308"), ("1e200", "-1e200"), ("1.7e308", "1.7e308")] {
        let error = Comparison::of(&[entry("a", first), entry("b", second)], &[]).unwrap_err();
        assert!(matches!(error, ComparisonError::NotFinite { .. }), "{error}");
    }
    assert!(Comparison::of(&[entry("a", "1e100"), entry("b", "-1e100")], &[]).is_ok());
}

/// A name that moves the cursor of a terminal was repeated in messages.
#[test]
fn issue_029_names_with_control_characters_are_refused() {
    for name in ["a\u{1b}[31m", "a\u{202e}b", "a\u{7f}"] {
        let error = wrong(format!("time_s,{name}\n0,x\n").as_bytes()).to_string();
        assert!(
            error.contains("the name of column 2 holds a control character"),
            "{error}"
        );
    }
}
