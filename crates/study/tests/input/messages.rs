//! Bad input: every message says what was found and expected, marks the place, and helps.

use crate::common::{check, errors, only};
use std::path::Path;
use study::case::Case;

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
        r#"column_wear = "-0.1 in""#,
        "`wedge.column_wear` is -0.1 in; it must be zero or greater",
        "\"-0.1 in\"",
        "in",
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
        "`friction.slope` is -0.1; it must be between 0 and 10",
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
        check("simulation", &line, "between 1e-15 and 1", tolerance, "1e-6");
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
        "more than 400000 output times",
        "\"1e-9 s\"",
        "5.0e-5 s",
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
    for name in ["vdrun_toe_out_0.2_psi_0", "Keil 3", "com", "com10", "conical"] {
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
