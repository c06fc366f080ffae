//! Bad input: every message says what was found and expected, marks the place, and helps.

#![allow(clippy::unwrap_used)]

use std::path::Path;
use study::case::{Case, CaseError, Problem, builtin};

fn errors(text: &str) -> CaseError {
    Case::parse("case.toml", text, Path::new(""), &[]).unwrap_err()
}

/// The only mistake in a text.
fn only(error: &CaseError) -> &Problem {
    let [problem] = error.problems() else {
        panic!("{:#?}", error.problems())
    };
    problem
}

/// A case of one bad line in one section: message, marked text, help; the place is always right.
#[track_caller]
fn check(section: &str, line: &str, message: &str, marked: &str, help: &str) {
    let text = format!("# a case\n[{section}]\n{line}\n");
    let error = errors(&text);
    let problem = only(&error);
    assert!(
        problem.message().contains(message),
        "message: {}",
        problem.message()
    );
    assert_eq!(problem.marked_text(), Some(marked), "{}", problem.message());
    let column = line.find(marked).unwrap() + 1;
    assert_eq!(
        problem.line_and_column(),
        Some((3, column)),
        "{}",
        problem.message()
    );
    assert_eq!(problem.source_name(), Some("case.toml"));
    assert!(
        problem.advice().unwrap_or("").contains(help),
        "help: {:?}",
        problem.advice()
    );
}

#[test]
fn wrong_units() {
    check(
        "wedge",
        r#"angle = "32 in""#,
        "`wedge.angle`: this is a length (in); an angle is expected",
        "in",
        "\"32 deg\"",
    );
    check(
        "wedge",
        r#"weight = "50 lb""#,
        "this is a mass (lb); a force is expected",
        "lb",
        "lb is a mass, lbf the force",
    );
    check(
        "wedge",
        r#"height = "6.125 inn""#,
        "there is no unit \"inn\"",
        "inn",
        "did you mean in?",
    );
    check(
        "wedge",
        "height = 6.125",
        "the unit is missing; a length is expected",
        "6.125",
        "\"6.125 in\"",
    );
    check(
        "wedge",
        r#"width = "10.5""#,
        "the unit is missing",
        "10.5",
        "\"10.5 in\"",
    );
    check(
        "wedge",
        r#"width = """#,
        "a number with a unit is missing",
        "\"\"",
        "\"1 in\"",
    );
    check(
        "wedge",
        r#"width = "1,000 in""#,
        "\"1,000\" is not a number",
        "1,000",
        "in",
    );
    check(
        "contact",
        r#"stiffness = "2.5e5 lbf""#,
        "a force (lbf); a stiffness is expected",
        "lbf",
        "\"2.5e5 lbf/in\"",
    );
    check(
        "friction",
        r#"column = "0.4""#,
        "`friction.column` is text; a number",
        "\"0.4\"",
        "column = 0.4",
    );
    check(
        "simulation",
        r#"duration = true"#,
        "a time is expected",
        "true",
        "\"1 s\"",
    );
    let inertia = r#"inertia = ["1 lb in^2", "1 N", "1 lb in^2"]"#;
    check(
        "wedge",
        inertia,
        "`wedge.inertia[1]`: this is a force (N)",
        "N",
        "\"1 lb in^2\"",
    );
}

#[test]
fn unknown_keys() {
    check(
        "control_coil",
        r#"stifness = "3000 lbf/in""#,
        "there is no key `stifness` in `control_coil`",
        "stifness",
        "did you mean `stiffness`?",
    );
    check(
        "wedge",
        r#"gravity = "1 g0""#,
        "no key `gravity`",
        "gravity",
        "belongs below [environment]",
    );
    check(
        "wedge",
        "colour = 1",
        "no key `colour`",
        "colour",
        "known here: damping, angle",
    );
    check(
        "bolster",
        r#"yaw = { shape = "constant", valeu = "1 deg", value = "1 deg" }"#,
        "no key `valeu`",
        "valeu",
        "`value`",
    );
    let error = errors("[wegde]\nangle = \"32 deg\"\n");
    assert_eq!(only(&error).message(), "there is no key `wegde` in a case");
    assert_eq!(only(&error).advice(), Some("did you mean `wedge`?"));
}

#[test]
fn values_out_of_range() {
    check(
        "control_coil",
        r#"stiffness = "0 lbf/in""#,
        "must be greater than zero",
        "\"0 lbf/in\"",
        "\"3000 lbf/in\"",
    );
    check(
        "contact",
        r#"stiffness = "-1 N/m""#,
        "must be greater than zero",
        "\"-1 N/m\"",
        "lbf/in",
    );
    check(
        "wedge",
        r#"weight = "0 lbf""#,
        "`wedge.weight` is 0 lbf; it must be greater than zero",
        "\"0 lbf\"",
        "lbf",
    );
    check(
        "wedge",
        r#"height = "-6 in""#,
        "must be greater than zero",
        "\"-6 in\"",
        "in",
    );
    check(
        "wedge",
        r#"angle = "0 deg""#,
        "between 0 deg and 90 deg",
        "\"0 deg\"",
        "30 deg",
    );
    check(
        "wedge",
        r#"angle = "90 deg""#,
        "between 0 deg and 90 deg",
        "\"90 deg\"",
        "30 deg",
    );
    check(
        "control_coil",
        r#"nominal_length = "0 in""#,
        "must be greater than zero",
        "\"0 in\"",
        "in",
    );
    check(
        "control_coil",
        r#"damping = "-1 lbf s/in""#,
        "must be zero or greater",
        "\"-1 lbf s/in\"",
        "lbf s/in",
    );
    check(
        "friction",
        "slope = -0.1",
        "`friction.slope` is -0.1; it must be zero or greater",
        "-0.1",
        "0.4",
    );
    check(
        "friction",
        "column = nan",
        "`friction.column` is nan",
        "nan",
        "0.4",
    );
    check(
        "friction",
        "column = inf",
        "`friction.column` is inf",
        "inf",
        "0.4",
    );
    check(
        "wedge",
        r#"angle = "nan deg""#,
        "\"nan\" is not a finite number",
        "nan",
        "finite",
    );
    check(
        "wedge",
        "angle = nan",
        "\"nan\" is not a finite number",
        "nan",
        "finite",
    );
    for tolerance in ["0", "1", "1.5", "-1e-6"] {
        let line = format!("relative_tolerance = {tolerance}");
        check("simulation", &line, "between 0 and 1", tolerance, "1e-6");
    }
    check(
        "simulation",
        r#"output_interval = "11 s""#,
        "longer than the duration (10 s)",
        "\"11 s\"",
        "0.01 s",
    );
    check(
        "simulation",
        r#"output_interval = "1e-9 s""#,
        "ten million",
        "\"1e-9 s\"",
        "0.01 s",
    );
    check(
        "simulation",
        r#"output_interval = "0 s""#,
        "greater than zero",
        "\"0 s\"",
        "s",
    );
}

#[test]
fn a_default_is_never_blamed() {
    check(
        "simulation",
        r#"duration = "5 ms""#,
        "is longer than the duration (5 ms)",
        "\"5 ms\"",
        "longer duration",
    );
}

#[test]
fn choices() {
    check(
        "wedge",
        r#"damping = "konstant""#,
        "cannot be \"konstant\"",
        "\"konstant\"",
        "did you mean \"constant\"?",
    );
    check(
        "simulation",
        r#"start = "sideways""#,
        "cannot be",
        "\"sideways\"",
        "\"rest\", \"touching\", \"equilibrium\"",
    );
    check(
        "friction",
        r#"law = { column = "bristel", slope = "tanh" }"#,
        "`friction.law.column`",
        "\"bristel\"",
        "bristle",
    );
    check(
        "friction",
        r#"law = { column = "bristle" }"#,
        "`friction.law.slope` is missing",
        "law",
        "tanh",
    );
    check("wedge", "free_coordinates = []", "is empty", "[]", "\"x\"");
    check(
        "wedge",
        r#"free_coordinates = ["x", "z", 'x']"#,
        "names \"x\" twice",
        "'x'",
        "once",
    );
    check(
        "wedge",
        r#"free_coordinates = ["x", "zz"]"#,
        "cannot be \"zz\"",
        "\"zz\"",
        "\"z\"",
    );
    check(
        "control_coil",
        r#"pulls = "no""#,
        "true or false is expected",
        "\"no\"",
        "pulls = false",
    );
}

#[test]
fn toes() {
    check(
        "side_frame",
        r#"toe = "0.2 deg""#,
        "does not say in or out",
        "\"0.2 deg\"",
        "0.2 deg out",
    );
    check(
        "side_frame",
        r#"toe = "-0.2 deg out""#,
        "is negative",
        "\"-0.2 deg out\"",
        "0.2 deg in",
    );
    check(
        "side_frame",
        r#"toe = "0.2 in""#,
        "the unit is missing; an angle is expected",
        "0.2",
        "0.2 deg in",
    );
    check(
        "side_frame",
        r#"toe = "0.2 mm out""#,
        "this is a length (mm)",
        "mm",
        "0.2 deg out",
    );
    check(
        "side_frame",
        r#"toe = "30 deg out""#,
        "below 22.5 deg",
        "\"30 deg out\"",
        "0.2 deg out",
    );
    check(
        "side_frame",
        "toe = 0.2",
        "`side_frame.toe` is a number",
        "0.2",
        "0.2 deg out",
    );
}

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

/// A case with a table in a CSV file of this text.
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
    let embedded = case.document.clone().with_tables_embedded();
    let again = Case::from_document(&embedded).unwrap();
    assert_eq!(again.parameters, case.parameters);
    assert!(case.document.to_toml().contains("file = \"motion.csv\""));

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

#[test]
fn files_and_syntax() {
    let error = Case::read(Path::new("no/such/case.toml"), &[]).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("there is no case file no/such/case.toml")
    );
    assert!(only(&error).advice().unwrap().contains("wedgelab case"));

    let error = errors("[wedge]\nangle = 32 deg\n");
    let problem = &error.problems()[0];
    assert!(
        problem.message().starts_with("this is not TOML"),
        "{}",
        problem.message()
    );
    assert_eq!(problem.line_and_column().unwrap().0, 2);
    assert!(problem.advice().unwrap().contains("quotes"));

    let error = errors("wedge = 3\n");
    assert!(only(&error).message().contains("a table is expected"));
    assert!(only(&error).advice().unwrap().contains("[wedge]"));
}

#[test]
fn names_that_are_no_folders() {
    for name in [
        "", " ", ".", "..", "a/b", "a\\\\b", "c:d", "con", "NUL.txt", "Lpt1", "end.", " x", "a?",
    ] {
        let error = errors(&format!("name = \"{name}\"\n"));
        let problem = only(&error);
        assert!(
            problem.message().starts_with("the name"),
            "{name}: {}",
            problem.message()
        );
        assert_eq!(problem.line_and_column(), Some((1, 8)));
        assert!(problem.advice().unwrap().contains("my_wedge"));
    }
    for name in ["vdrun_toe_-0.2_psi_0", "Keil 3", "com", "com10", "conical"] {
        assert!(
            Case::parse("x.toml", &format!("name = \"{name}\"\n"), Path::new(""), &[]).is_ok(),
            "{name}"
        );
    }
}

#[test]
fn several_mistakes_are_reported_together() {
    let error = errors("[wedge]\nangle = \"32 in\"\nheigth = \"6 in\"\n[friction]\ncolumn = -1\n");
    let lines: Vec<_> = error
        .problems()
        .iter()
        .map(|p| p.line_and_column().unwrap().0)
        .collect();
    assert_eq!(lines, [2, 3, 5]);
    assert_eq!(error.to_string(), "the case has 3 mistakes");
    let mut shown = String::new();
    let theme = miette::GraphicalTheme::unicode_nocolor();
    miette::GraphicalReportHandler::new_themed(theme)
        .render_report(&mut shown, &error)
        .unwrap();
    for piece in [
        "case.toml:2:13",
        "case.toml:3:1",
        "case.toml:5:10",
        "angle = \"32 in\"",
        "did you mean `height`?",
    ] {
        assert!(shown.contains(piece), "{piece} is not in\n{shown}");
    }
}

fn set(overrides: &[&str]) -> Result<Case, CaseError> {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_string()).collect();
    builtin::case_with("vdrun_toe_0_psi_0", &overrides)
}

#[test]
fn overrides() {
    let case = set(&[
        "wedge.angle=\"30 deg\"",
        "friction.column = 0.3",
        "bolster.vertical.amplitude=2 in",
        "side_frame.toe=0.1 deg in",
        "name=other",
        "bolster.yaw={shape=\"ramp\", amplitude=\"1 deg\", duration=\"1 s\"}",
    ])
    .unwrap();
    assert_eq!(case.document.wedge.angle.text(), "30 deg");
    assert_eq!(case.parameters.column_friction.coefficient, 0.3);
    assert_eq!(case.parameters.slope_friction.coefficient, 0.4);
    assert!(case.parameters.toe < 0.0);
    assert_eq!(case.name, "other");
    let vertical = case.document.to_toml();
    assert!(
        vertical.contains("amplitude = \"2 in\", frequency = \"2 rad/s\""),
        "{vertical}"
    );
}

#[test]
fn bad_overrides_show_what_was_set() {
    for (text, message, marked, help) in [
        (
            "wedge.angle=\"30 in\"",
            "`wedge.angle`: this is a length (in)",
            "in",
            "\"30 deg\"",
        ),
        (
            "wedge.angel=\"30 deg\"",
            "there is no key `angel` in `wedge`",
            "angel",
            "did you mean `angle`?",
        ),
        (
            "weged.angle=\"30 deg\"",
            "there is no key `weged`",
            "weged",
            "did you mean `wedge`?",
        ),
        (
            "friction.column",
            "there is no =",
            "friction.column",
            "--set friction.column=0.3",
        ),
        (
            "friction.column=",
            "the value is missing",
            "friction.column=",
            "--set",
        ),
        ("friction.column=-1", "`friction.column` is -1", "-1", "0.4"),
        (
            "friction.column.deep=1",
            "`friction.column` is a table",
            "column",
            "column = 0.4",
        ),
    ] {
        let error = set(&[text]).unwrap_err();
        let problem = &error.problems()[0];
        assert!(
            problem.message().contains(message),
            "{text}: {}",
            problem.message()
        );
        assert_eq!(problem.source_name(), Some("--set"), "{text}");
        assert_eq!(problem.marked_text(), Some(marked), "{text}");
        assert!(
            problem.advice().unwrap().contains(help),
            "{text}: {:?}",
            problem.advice()
        );
    }
    let error = set(&["side_frame.toe.angle=1"]).unwrap_err();
    assert!(
        only(&error).message().contains("`toe` is text in this case"),
        "{error}"
    );
    let error = set(&["friction.column=0.1\nfriction.slope=0.1"]).unwrap_err();
    assert_eq!(only(&error).message(), "one --set sets one value");
}

#[test]
fn unknown_built_in_cases() {
    let error = builtin::case("vdrun_toe_-0.2_psi_0.12").unwrap_err();
    assert!(error.to_string().contains("no built-in case"));
    assert_eq!(
        only(&error).advice(),
        Some("did you mean vdrun_toe_-0.2_psi_0.012?")
    );
    let error = builtin::case("nothing").unwrap_err();
    assert!(only(&error).advice().unwrap().contains("cdrun_toe_0_psi_0.012"));
}
