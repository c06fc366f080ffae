//! Issue 29: what ended the program, took it seconds or was called a success.

use std::fs;
use std::path::Path;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use study::case::builtin::case_with;
use study::case::{Case, CaseError};
use study::design::Study;
use study::records;
use study::run::Run;

const NAME: &str = "vdrun_toe_0_psi_0";

fn wrong(text: &str) -> CaseError {
    Case::parse("some.toml", text, Path::new(""), &[]).unwrap_err()
}

fn set(path: &str) -> Result<Case, CaseError> {
    case_with(NAME, &["simulation.duration=0.05 s".to_owned(), path.to_owned()])
}

/// Returns it as the program shows it.
fn shown(error: &dyn Diagnostic) -> String {
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_context_lines(1);
    handler.render_report(&mut text, error).unwrap();
    text
}

#[test]
fn issue_029_brackets_in_an_angle() {
    for pairs in [17, 1000, 100_000] {
        let text = format!(
            "[wedge]\nangle = \"32 {}deg{}\"\n",
            "(".repeat(pairs),
            ")".repeat(pairs)
        );
        let error = wrong(&text);
        assert!(error.to_string().starts_with("`wedge.angle`"), "{error}");
        assert!(shown(&error).len() < 4000);
    }
}

/// TOML with 30,000 nested braces took 28 s.
#[test]
fn issue_029_nested_braces_brackets_and_keys() {
    for nested in [
        format!("a = {}", "{a = ".repeat(30_000)),
        format!("a = {}", "[".repeat(1_000_000)),
        format!("{}a = 1", "a.".repeat(1_000_000)),
        format!("[{}a]", "a.".repeat(1_000_000)),
        "a={[]]\n".repeat(100_000),
        "r={f]\nd=[1]\n".repeat(100_000),
    ] {
        let error = wrong(&nested);
        assert!(error.to_string().contains("nested more than 16 deep"), "{error}");
        let line_and_column = error.problems()[0].line_and_column().unwrap();
        assert!(
            line_and_column.0 < 40 && line_and_column.1 < 100,
            "{line_and_column:?}"
        );
        assert!(shown(&error).len() < 4000);
        assert!(case_with(NAME, std::slice::from_ref(&nested)).is_err());
        assert!(Study::parse("some.toml", &nested, Path::new("")).is_err());
    }
}

/// The printer of messages panicked at places beyond column 65,535.
#[test]
fn issue_029_a_mistake_far_right_in_its_line() {
    for before in [100, 65_535, 100_000, 1_000_000] {
        let text = format!(
            "wedge = {{ angle = \"32 deg\",{} heigth = \"6 in\" }}",
            " ".repeat(before)
        );
        let error = wrong(&text);
        assert!(error.to_string().contains("heigth"), "{error}");
        let text = shown(&error);
        assert!(
            text.contains("heigth = \"6 in\"") && text.contains("did you mean `height`?"),
            "{text}"
        );
        let column = error.problems()[0].line_and_column().unwrap().1;
        assert!(
            text.contains(&format!(":1:{column}]")) && text.len() < 2000,
            "{text}"
        );
    }
}

/// Messages reached 5.2 MB.
#[test]
fn issue_029_at_most_20_mistakes_are_reported_and_the_others_counted() {
    let many: String = (0..5000).map(|number| format!("key_{number} = 1\n")).collect();
    let error = wrong(&many);
    assert_eq!((error.problems().len(), error.more()), (20, 4980));
    assert_eq!(error.to_string(), "the case has 5000 mistakes; the first 20 are");
    let text = shown(&error);
    assert!(text.contains("`key_0`") && text.contains("`key_19`") && !text.contains("`key_20`"));
    let syntax = wrong(&"= =\n".repeat(5000));
    assert!(syntax.problems().len() == 20 && syntax.more() > 0);
    let study = Study::parse("some.toml", &many, Path::new("")).unwrap_err();
    assert_eq!(study.problems().len(), 20);
    assert!(study.to_string().starts_with("the study has 50"), "{study}");
}

#[test]
fn issue_029_messages_are_short_whatever_was_written() {
    let long = "x".repeat(1_000_000);
    for text in [
        format!("{long} = 1"),
        format!("title = 1\n{long} = 1\n[wedge]\nangle = \"{long}\"\n"),
        format!("[friction]\ncolumn = 1{}", "0".repeat(400)),
        format!("[side_frame]\ntoe = \"{long}\""),
        format!("[bolster]\nvertical = {{ shape = \"{long}\" }}"),
        format!("[bolster]\nvertical = {{ shape = \"table\", file = \"{long}\" }}"),
        format!("name = \"{long}\""),
        format!("[wedge]\nangle = {long}"),
        format!("[simulation]\nmethod = \"{long}\""),
    ] {
        let error = wrong(&text);
        let text = shown(&error);
        assert!(text.len() < 10_000, "{} bytes: {}", text.len(), &text[..2000]);
    }
}

#[test]
fn issue_029_files_of_another_kind_are_recognized() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    let page = format!("<!DOCTYPE html>\n<html>{}", "x".repeat(1 << 27));
    for (content, what, advice) in [
        (page.as_str(), "is a web page", "open it in a browser"),
        (
            "\\BODY DATA\n 1 'a'\n",
            "is a file of NUCARS",
            "wedgelab nucars check",
        ),
        (
            "time_s,wedge_x_in\n0,1\n",
            "is a table of results",
            "wedgelab compare",
        ),
        ("{\"schema\": 1}", "is a JSON file", "summary.json"),
        ("PK\x03\x04", "is a ZIP archive", "fmu export"),
    ] {
        fs::write(&file, content).unwrap();
        for error in [
            Case::read(&file, &[]).unwrap_err(),
            Study::read(&file).unwrap_err(),
        ] {
            let help = error.problems()[0].advice().unwrap().to_owned();
            assert!(error.to_string().contains(what), "{error}");
            assert!(help.contains(advice), "{help}");
        }
    }
    fs::write(&file, "case = \"vdrun_toe_0_psi_0\"\nsampling = \"list\"\n").unwrap();
    let error = Case::read(&file, &[]).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("is a study file; a case file is expected"),
        "{error}"
    );
    assert!(error.problems()[0].advice().unwrap().contains("wedgelab study "));
    fs::write(&file, "[wedge]\nangle = \"32 deg\"\n").unwrap();
    let error = Study::read(&file).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("is a case file; a study file is expected"),
        "{error}"
    );
    assert!(error.problems()[0].advice().unwrap().contains("wedgelab run "));
}

/// `/dev/zero` and files of 100 MB were read to their end.
#[cfg(unix)]
#[test]
fn issue_029_devices_and_large_files_are_not_read_to_their_end() {
    let folder = tempfile::tempdir().unwrap();
    let large = folder.path().join("large.toml");
    fs::write(&large, "# remark\n".repeat(2_000_000)).unwrap();
    assert!(
        Case::read(&large, &[])
            .unwrap_err()
            .to_string()
            .contains("larger than 16 MB")
    );
    let zero = Path::new("/dev/zero");
    assert!(
        Case::read(zero, &[])
            .unwrap_err()
            .to_string()
            .ends_with("is not text")
    );
    assert!(
        Study::read(zero)
            .unwrap_err()
            .to_string()
            .ends_with("is not text")
    );
    let table = set("bolster.vertical={ shape = \"table\", file = \"/dev/zero\" }").unwrap_err();
    assert!(table.to_string().ends_with("is not text"), "{table}");
}

#[test]
fn issue_029_tables_have_at_most_100000_rows() {
    let folder = tempfile::tempdir().unwrap();
    let write = |rows: usize| {
        let rows: String = (0..rows).map(|row| format!("{row},0\n")).collect();
        fs::write(
            folder.path().join("table.csv"),
            format!("time [s], value [in]\n{rows}"),
        )
        .unwrap();
        let text = "[bolster]\nvertical = { shape = \"table\", file = \"table.csv\" }\n";
        Case::parse("some.toml", text, folder.path(), &[])
    };
    let full = write(100_000).unwrap();
    let error = write(100_001).unwrap_err();
    assert!(
        error.to_string().contains("100001 rows; at most 100000"),
        "{error}"
    );
    assert_eq!(error.problems()[0].line_and_column(), Some((100_002, 1)));
    // The largest table is read again from the case that holds it.
    let embedded = full.to_toml_embedded();
    assert!(Case::parse("case.toml", embedded, Path::new(""), &[]).is_ok());
}

#[test]
fn issue_029_outputs_are_bounded_before_memory_is_taken() {
    let error = set("simulation.output_interval=1e-8 s").unwrap_err();
    assert!(
        error.to_string().contains("more than 400000 output times"),
        "{error}"
    );
    let advice = error.problems()[0].advice().unwrap().to_owned();
    let proposed = advice.split('"').nth(1).unwrap();
    assert!(
        set(&format!("simulation.output_interval={proposed}")).is_ok(),
        "{advice}"
    );
}

/// `bolster.vertical = "1e308 in"` gave 51 `inf`, as a success.
#[test]
fn issue_029_values_have_upper_bounds() {
    for (path, bound) in [
        ("bolster.vertical=1e308 in", "at most 1e3 m"),
        ("bolster.vertical=-40000 in", "at most 1e3 m"),
        ("bolster.yaw=1e4 rad", "at most 1e3 rad"),
        ("wedge.weight=1e200 lbf", "at most 1e10 N"),
        ("contact.stiffness=1e300 N/m", "at most 1e15 N/m"),
        ("simulation.duration=1e9 s", "at most 1e6 s"),
        ("friction.column=11", "between 0 and 10"),
        ("simulation.relative_tolerance=1e-20", "between 1e-15 and 1"),
    ] {
        let error = set(path).unwrap_err();
        assert!(error.to_string().contains(bound), "{path}: {error}");
    }
    let points = "[[\"0 s\", \"0 in\"], [\"1 s\", \"1e307 in\"], [\"2 s\", \"0 in\"], [\"3 s\", \"0 in\"]]";
    let table = set(&format!(
        "bolster.vertical={{ shape = \"table\", points = {points} }}"
    ))
    .unwrap_err();
    assert!(table.to_string().contains("at most 1e3 m"), "{table}");
}

/// A run whose averages overflow is no success: an amplitude of 1e-200 m gives an equivalent damping of
/// infinity.
#[test]
fn issue_029_averages_that_are_not_finite_are_no_success() {
    let settings = [
        "bolster.vertical.amplitude=1e-170 m",
        "simulation.duration=8 s",
        "simulation.relative_tolerance=1e-3",
    ];
    let case = case_with(NAME, &settings.map(str::to_owned)).unwrap();
    let summary = Run::new(&case).unwrap().finish(|_| ()).summary;
    assert!(!summary.complete);
    let reason = summary.stopped.unwrap().reason;
    assert!(reason.contains("is not a finite number"), "{reason}");
}

/// Damage full of beginnings of records took time with the square of its length: 1 MB took minutes.
#[test]
fn issue_029_damaged_records_are_passed_over_in_linear_time() {
    let mut bytes = Vec::new();
    for length in 0_u32..200_000 {
        bytes.extend(b"WLR1");
        bytes.extend((u32::MAX - length).to_le_bytes());
        bytes.extend([0; 4]);
        bytes.extend(b"WLR1");
        bytes.extend(1_000_000_u32.to_le_bytes());
        bytes.extend([0; 4]);
    }
    let found = records::read(1, &bytes);
    assert_eq!((found.records.len(), found.lost), (0, bytes.len()));
}
