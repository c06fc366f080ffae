//! Bad motions and tables, in the case and in files beside it.

use crate::common::{check, errors, only};
use study::case::{Case, CaseError, Tables};

#[test]
fn motions() {
    check(
        "bolster",
        r#"yaw = { shape = "sin", amplitude = "1 deg" }"#,
        "no motion of shape \"sin\"",
        "\"sin\"",
        "did you mean \"sine\"?",
    );
    check(
        "bolster",
        r#"yaw = { amplitude = "1 deg" }"#,
        "`bolster.yaw.shape` is missing",
        r#"{ amplitude = "1 deg" }"#,
        "sine",
    );
    check(
        "bolster",
        r#"yaw = { shape = "triangle", amplitude = "1 deg" }"#,
        "`bolster.yaw.frequency` is missing",
        r#"{ shape = "triangle", amplitude = "1 deg" }"#,
        "rad/s",
    );
    check(
        "bolster",
        r#"vertical = "1 deg""#,
        "this is an angle (deg); a length is expected",
        "deg",
        "in",
    );
    check("bolster", "vertical = []", "empty sum", "[]", "sine");
    check(
        "bolster",
        r#"pitch = { shape = "sine", amplitude = "1 deg", frequency = "0 Hz" }"#,
        "greater than zero",
        "\"0 Hz\"",
        "rad/s",
    );
    check(
        "bolster",
        r#"pitch = { shape = "sine", amplitude = "1 deg", frequency = "2 1/s" }"#,
        "a rate without an angle",
        "1/s",
        "radians or cycles",
    );
}

#[test]
fn tables_in_the_case() {
    let motion = |points: &str| format!("vertical = {{ shape = \"table\", points = {points} }}");
    let short = motion(r#"[["0 s", "0 in"], ["5 s", "1 in"], ["10 s", "0 in"]]"#);
    check(
        "bolster",
        &short,
        "has 3 rows; at least 4",
        r#"["0 s", "0 in"]"#,
        "add rows",
    );
    let unsorted = motion(r#"[["0 s", "0 in"], ["5 s", "1 in"], ["4 s", "2 in"], ["10 s", "0 in"]]"#);
    check(
        "bolster",
        &unsorted,
        "the time 4 s does not come after 5 s",
        r#"["4 s", "2 in"]"#,
        "sort the rows",
    );
    let early = motion(r#"[["0 s", "0 in"], ["1 s", "1 in"], ["2 s", "2 in"], ["3 s", "0 in"]]"#);
    check(
        "bolster",
        &early,
        "from 0 s to 3 s, but the run lasts from 0 to 10 s",
        "vertical",
        "simulation.duration",
    );
    let single = motion(r#"[["0 s"]]"#);
    check(
        "bolster",
        &single,
        "not a pair of time and value",
        r#"["0 s"]"#,
        "[[\"0 s\", \"0 in\"]",
    );
    let falls = r#"table = [["0 in", "0 lbf"], ["1 in", "10 lbf"], ["2 in", "9 lbf"]]"#;
    check(
        "control_coil",
        falls,
        "falls from 10 lbf to 9 lbf",
        r#"["2 in", "9 lbf"]"#,
        "must not fall",
    );
    let flat = r#"table = [["0 in", "5 lbf"], ["1 in", "5 lbf"]]"#;
    check(
        "control_coil",
        flat,
        "never rises",
        r#"["1 in", "5 lbf"]"#,
        "must grow",
    );
    let error = errors(
        "[control_coil]\nstiffness = \"1 N/m\"\ntable = [[\"0 in\", \"0 lbf\"], [\"1 in\", \"1 lbf\"]]\n",
    );
    assert_eq!(
        only(&error).message(),
        "`control_coil` has both `stiffness` and `table`"
    );
}

/// Returns a case with a table in a CSV file of this text.
fn with_csv(csv: &str) -> Result<Case, CaseError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("motion.csv"), csv).unwrap();
    let path = folder.path().join("driven.toml");
    std::fs::write(
        &path,
        "[bolster]\nvertical = { shape = \"table\", file = \"motion.csv\" }\n",
    )
    .unwrap();
    Case::read(&path, &[])
}

#[test]
fn tables_in_files() {
    let good = "\u{feff}# measured\r\ntime [s], travel [mm]\r\n0, 0\r\n3,1e1\r\n6, -2.5\r\n\r\n10, 0\r\n";
    let case = with_csv(good).unwrap();
    assert_eq!(case.name, "driven");
    let again = Case::parse("case.toml", case.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters, case.parameters);
    assert!(case.to_toml().contains("file = \"motion.csv\""));

    for (csv, message, place, marked) in [
        ("", "the table is empty", (1, 1), ""),
        ("0, 0\n1, 1\n", "`0` has no unit", (1, 1), "0"),
        (
            "time [s], v [lbf]\n0,0\n",
            "`v [lbf]`: this is a force (lbf); a length",
            (1, 11),
            "v [lbf]",
        ),
        (
            "time [s], v [in], w [in]\n",
            "`w [in]` is one column too many",
            (1, 19),
            "w [in]",
        ),
        ("time [s]\n", "two columns", (1, 1), "time [s]"),
        (
            "time [s], v [in]\n0, 0\n1; 1\n",
            "1 values in this line",
            (3, 1),
            "1; 1",
        ),
        (
            "time [s], v [in]\n0, 0\n1, one\n",
            "\"one\" is not a number",
            (3, 4),
            "one",
        ),
        (
            "time [s], v [in]\n0, 0\n1, nan\n",
            "\"nan\" is not a finite number",
            (3, 4),
            "nan",
        ),
        (
            "time [s], v [in]\n0,0\n2,0\n1,0\n10,0\n",
            "the time 1 s does not come after 2 s",
            (4, 1),
            "1,0",
        ),
        (
            "time [s], v [in]\n0,0\n2,0\n",
            "has 2 rows; at least 4",
            (2, 1),
            "0,0",
        ),
    ] {
        let error = with_csv(csv).unwrap_err();
        let problem = only(&error);
        assert!(
            problem.message().contains(message),
            "{csv:?}: {}",
            problem.message()
        );
        assert_eq!(
            problem.line_and_column(),
            Some(place),
            "{csv:?}: {}",
            problem.message()
        );
        assert_eq!(problem.marked_text(), Some(marked));
        assert!(problem.source_name().unwrap().ends_with("motion.csv"));
        assert!(problem.advice().is_some());
    }
    check(
        "control_coil",
        r#"table = "none.csv""#,
        "there is no file none.csv",
        "\"none.csv\"",
        "folder of the case",
    );
}
