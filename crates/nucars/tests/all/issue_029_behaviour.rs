//! Issue 29: long lines, many mistakes and files of another kind.

use std::fs;

use miette::{GraphicalReportHandler, GraphicalTheme};
use nucars::file_sets::load;
use nucars::read::read_system;
use nucars::source::SourceText;
use nucars::{Finding, Severity};

fn shown(finding: &Finding) -> String {
    let mut text = String::new();
    let handler = GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor()).with_context_lines(1);
    handler.render_report(&mut text, finding).unwrap();
    text
}

/// The printer of messages panicked at places beyond column 65,535.
#[test]
fn issue_029_a_mistake_far_right_in_its_line() {
    for before in [100, 65_535, 1_000_000] {
        let text = format!("\\BODY DATA\n1\n1 'a' {}wrong 0 0\n", " ".repeat(before));
        let read = read_system(&SourceText::from_text("some.sys", text).unwrap());
        let far = read
            .findings
            .list()
            .iter()
            .find(|finding| finding.message().contains("wrong"));
        let far = far.expect("a mistake at the word");
        let text = shown(far);
        let (line, column) = far.place().line_and_column();
        assert!(line == 3 && column > before, "{line}:{column}");
        assert!(
            text.contains("wrong 0 0") && text.contains(&format!(":{line}:{column}]")),
            "{text}"
        );
        assert!(text.len() < 3000, "{} bytes", text.len());
    }
}

#[test]
fn issue_029_at_most_20_mistakes_are_reported_and_the_others_counted() {
    let lines: String = (1..=500)
        .map(|number| format!(" {number} 'body' x y z\n"))
        .collect();
    let text = format!("\\BODY DATA\n500\n{lines}");
    let findings = read_system(&SourceText::from_text("some.sys", text).unwrap()).findings;
    let errors = findings
        .list()
        .iter()
        .filter(|one| one.severity() == Severity::Error);
    assert_eq!(errors.count(), 20);
    assert!(
        findings.count(Severity::Error) > 400,
        "{}",
        findings.count(Severity::Error)
    );
    assert_eq!(findings.not_kept()[2], findings.count(Severity::Error) - 20);
}

#[test]
fn issue_029_messages_are_short_whatever_was_written() {
    let long = "x".repeat(1_000_000);
    for text in [
        format!("\\BODY DATA\n{long}\n"),
        format!("\\BODY DATA\n1\n 1 '{long}' {long}\n"),
        format!("\\{long}\n"),
        format!("\\BODY DATA\n 1 '{long}"),
    ] {
        for finding in read_system(&SourceText::from_text("some.sys", text).unwrap())
            .findings
            .list()
        {
            let text = shown(finding);
            assert!(text.len() < 5000, "{} bytes: {}", text.len(), &text[..1000]);
        }
    }
}

#[test]
fn issue_029_files_of_another_kind_are_recognized() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file.sys");
    for (content, what, advice) in [
        (
            "[wedge]\nangle = \"32 deg\"\n",
            "is a case file; a file of NUCARS is expected",
            "wedgelab run",
        ),
        ("[vary]\nwedge.angle = []\n", "is a study file", "wedgelab study"),
        ("<!DOCTYPE html>", "is a web page", "browser"),
        ("time_s,wedge_x_in\n", "is a table of results", "wedgelab plot"),
        ("\0\0\0", "is not text", "text file"),
    ] {
        fs::write(&file, content).unwrap();
        let error = load(&file).unwrap_err();
        assert!(error.message.contains(what), "{error}");
        assert!(error.advice.contains(advice), "{}", error.advice);
    }
    let long = "x".repeat(5 << 20);
    let error = SourceText::from_text("some.sys", format!("\\BODY DATA\n{long}")).unwrap_err();
    assert!(error.to_string().contains("this line has"), "{error}");
}

/// A keyword kept a `=` before white space that is none of ASCII, and lost it when it was written and read
/// again.
#[test]
fn issue_029_keywords_are_read_as_written() {
    for keyword in ["=\u{2028}\u{2028}", "A -\u{a0}", "B :\t="] {
        let source = SourceText::from_text("some.run", format!("\\{keyword}\n1\n")).unwrap();
        let read = nucars::read::read_run(&source);
        let written = nucars::write::write_run(&read.tree);
        let again = nucars::read::read_run(&SourceText::from_text("some.run", written).unwrap());
        assert!(again.tree == read.tree, "{keyword:?}");
    }
}
