//! `--set`, good and bad, and names of built-in cases.

use crate::common::only;
use study::case::{Case, CaseError, builtin};
use study::models::AnyCase;

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
    assert!(case.to_toml().contains("angle = \"30 deg\""));
    assert_eq!(case.parameters.column_friction.coefficient, 0.3);
    assert_eq!(case.parameters.slope_friction.coefficient, 0.4);
    assert!(case.parameters.toe < 0.0);
    assert_eq!(case.name, "other");
    let vertical = case.to_toml();
    assert!(
        vertical.contains("amplitude = \"2 in\", frequency = \"2 rad/s\""),
        "{vertical}"
    );
}

/// Parts of a sum and points of a table by their numbers, from 0.
#[test]
fn items_of_lists_are_set_by_their_numbers() {
    let sum = "bolster.vertical=[{shape=\"sine\", amplitude=\"1 in\", frequency=\"2 rad/s\"}, \"0.1 in\"]";
    let case = set(&[
        sum,
        "bolster.vertical.0.amplitude=2 in",
        "bolster.vertical.1=0.3 in",
    ])
    .unwrap();
    let text = case.to_toml();
    assert!(
        text.contains("amplitude = \"2 in\", frequency = \"2 rad/s\""),
        "{text}"
    );
    assert!(text.contains("\"0.3 in\",\n]"), "{text}");
    let table = "control_coil.table=[[\"0 in\", \"0 lbf\"], [\"1 in\", \"3000 lbf\"]]";
    let case = set(&[table, "control_coil.table.1.1=2000 lbf"]).unwrap();
    assert!(case.to_toml().contains("[\"1 in\", \"2000 lbf\"]"));

    for (text, message) in [
        (
            "bolster.vertical.2.amplitude=2 in",
            "`vertical` is a list of 2; it has no `2`",
        ),
        (
            "bolster.vertical.first=2 in",
            "`vertical` is a list of 2; it has no `first`",
        ),
    ] {
        let error = set(&[sum, text]).unwrap_err();
        assert_eq!(only(&error).message(), message);
    }
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
fn issue_036_behaviour_names_of_the_thesis_are_read() {
    for name in builtin::thesis_names() {
        let signed = name.replace("toe_out_", "toe_-").replace("toe_in_", "toe_");
        assert_eq!(builtin::case(&signed).unwrap(), builtin::case(name).unwrap());
        let any = AnyCase::built_in(&signed, &[]).unwrap().unwrap();
        assert_eq!(any.name(), name);
    }
    let case = builtin::case("cdrun_toe_-0.2_psi_0.012").unwrap();
    assert!(case.parameters.toe > 0.0, "toe out is positive in the equations");
    assert_eq!(case.name, "cdrun_toe_out_0.2_psi_0.012");
}

#[test]
fn unknown_built_in_cases() {
    let error = builtin::case("vdrun_toe_out_0.2_psi_0.12").unwrap_err();
    assert!(error.to_string().contains("no built-in case"));
    assert_eq!(
        only(&error).advice(),
        Some("did you mean vdrun_toe_out_0.2_psi_0.012?")
    );
    let error = builtin::case("nothing").unwrap_err();
    assert!(only(&error).advice().unwrap().contains("cdrun_toe_0_psi_0.012"));
}
