//! Tables that a case names, where those who name them may not read every file.

use std::fs;
use std::path::Path;

use study::case::{Case, CaseError, Tables};

const SECRET: &str = "hunter2";
const TABLE: &str = "time [s], travel [in]\n0, 0\n3, 1\n6, 0\n1000, 0\n";

/// Returns a folder with a case's folder in it, and files in both.
fn folders() -> tempfile::TempDir {
    let root = tempfile::tempdir().unwrap();
    let case = root.path().join("case");
    fs::create_dir_all(case.join("deeper")).unwrap();
    fs::write(root.path().join("secret.csv"), format!("{SECRET}\n{TABLE}")).unwrap();
    fs::write(root.path().join("outside.csv"), TABLE).unwrap();
    fs::write(case.join("good.csv"), TABLE).unwrap();
    fs::write(case.join("deeper/good.csv"), TABLE).unwrap();
    root
}

/// Returns the case with the bolster's vertical motion from this file.
fn with_file(tables: Tables<'_>, file: &str) -> Result<Case, CaseError> {
    let file = file.replace('\\', "/");
    let set = format!("bolster.vertical={{ shape = \"table\", file = \"{file}\" }}");
    Case::parse("case.toml", "", tables, &[set])
}

fn message(tables: Tables<'_>, file: &str) -> String {
    let error = with_file(tables, file).unwrap_err();
    assert_eq!(error.problems().len(), 1, "{error:?}");
    error.problems()[0].message().to_owned()
}

#[test]
fn issue_029_tables_are_read_below_the_folder_only() {
    let root = folders();
    let case = root.path().join("case");
    let below = Tables::below(&case);
    let inside = fs::canonicalize(&case).unwrap().join("good.csv");
    for file in [
        "good.csv",
        "./good.csv",
        "deeper/good.csv",
        "deeper/../good.csv",
        inside.to_str().unwrap(),
    ] {
        with_file(below, file).unwrap_or_else(|error| panic!("{file}: {error}"));
    }
    let outside = root.path().join("outside.csv");
    with_file(Tables::anywhere(&case), outside.to_str().unwrap()).unwrap();
    // Whether a file exists outside is not told.
    for file in [
        "../outside.csv",
        "../no.csv",
        "deeper/../../outside.csv",
        outside.to_str().unwrap(),
        "/etc/passwd",
        "/no/such/file",
        "/dev/zero",
    ] {
        let expected = format!(
            "`bolster.vertical.file`: {file} is not read: it does not lie in the folder of the case file"
        );
        assert_eq!(message(below, file), expected);
    }
    assert!(message(below, "no.csv").ends_with("no.csv does not exist"));
    for folder in ["", "deeper"] {
        assert!(
            message(below, folder).ends_with("is not a regular file"),
            "{folder}"
        );
    }
    for file in ["good.csv", inside.to_str().unwrap(), "/etc/passwd", "no.csv"] {
        assert!(message(Tables::nowhere(), file).contains("tables in files are not read here"));
    }
}

#[cfg(unix)]
#[test]
fn issue_029_links_that_leave_the_folder_are_not_followed() {
    use std::os::unix::fs::symlink;
    let root = folders();
    let case = root.path().join("case");
    symlink("../outside.csv", case.join("link.csv")).unwrap();
    symlink("..", case.join("up")).unwrap();
    symlink("good.csv", case.join("own.csv")).unwrap();
    let status = std::process::Command::new("mkfifo")
        .arg(case.join("pipe"))
        .status();
    assert!(status.unwrap().success());
    let below = Tables::below(&case);
    with_file(below, "own.csv").unwrap();
    for file in ["link.csv", "up/outside.csv"] {
        assert!(
            message(below, file).contains("does not lie in the folder"),
            "{file}"
        );
    }
    // Opening a pipe would wait for ever.
    assert!(message(below, "pipe").ends_with("is not a regular file"));
}

#[test]
fn issue_029_messages_do_not_quote_files() {
    let root = folders();
    let case = root.path().join("case");
    let head = "time [s], travel [in]\n";
    let long = format!("7.{}", "7".repeat(50));
    for (text, refused) in [
        (format!("{SECRET}\n"), "line 1, column 1: name [unit] is expected"),
        (
            format!("root:x:0:0:{SECRET}:/root:/bin/bash"),
            "line 1, column 1: name [unit] is expected",
        ),
        (
            format!("time [s], {SECRET} [{SECRET}]\n0, 0\n"),
            "line 1, column 11: unknown unit",
        ),
        (
            format!("time [s], {SECRET} [lbf]\n0, 0\n"),
            "line 1, column 11: not a length",
        ),
        (format!("{SECRET} [s]\n0\n"), "line 1, column 1: one column only"),
        (
            format!("time [s], x [in], {SECRET}\n"),
            "line 1, column 19: name [unit] is expected",
        ),
        (
            format!("{head}0, 0\n1, {SECRET}\n"),
            "line 3, column 4: a number is expected",
        ),
        (
            format!("{head}0, 0\n1, 2, {SECRET}\n"),
            "line 3, column 1: two numbers",
        ),
        (format!("{head}0, {long}\n"), "line 2, column 1: too short"),
        (
            format!("{head}0, 0\n{long}, 1\n2, 1\n3, 1\n"),
            "line 4, column 1: out of order",
        ),
        (String::new(), "line 1, column 1: empty"),
        (
            format!("{head}0, 0\n1, 1\n2, 1\n7.77e-7, 1\n"),
            "line 5, column 1: out of order",
        ),
        (
            format!("{head}-7.77, 0\n1, 1\n2, 1\n3, 1\n"),
            "secret.csv does not last from 0 to 10 s",
        ),
    ] {
        fs::write(case.join("secret.csv"), &text).unwrap();
        let error = with_file(Tables::below(&case), "secret.csv").unwrap_err();
        let problem = &error.problems()[0];
        assert_eq!(error.problems().len(), 1, "{error:?}");
        let message = problem.message();
        assert!(message.contains(refused), "{text:?}: {message}");
        assert!(message.contains("`bolster.vertical"), "{message}");
        let all = format!("{message} {:?} {:?}", problem.advice(), problem.marked_text());
        for secret in [SECRET, "root", "777", "7.77"] {
            assert!(!all.contains(secret), "{secret} is shown: {all}");
        }
        // Who may read every file is told what is in it.
        let refused = with_file(Tables::anywhere(&case), "secret.csv").unwrap_err();
        assert!(!refused.problems()[0].message().contains("line 1,"), "{refused}");
    }
}

#[test]
fn issue_029_a_folder_alone_reads_everywhere() {
    let root = folders();
    let outside = root
        .path()
        .join("outside.csv")
        .to_str()
        .unwrap()
        .replace('\\', "/");
    let text = format!("[bolster]\nvertical = {{ shape = \"table\", file = \"{outside}\" }}\n");
    Case::parse("case.toml", &text, Path::new(""), &[]).unwrap();
    let restricted = Case::parse("case.toml", &text, Tables::below(Path::new("")), &[]);
    assert!(
        restricted.unwrap_err().problems()[0]
            .message()
            .contains("does not lie")
    );
}
