//! Mistakes in files of limits.

use study::car::limits::LimitSet;

/// The text has one mistake: in its message, in its help.
#[track_caller]
fn refused(text: &str, message: &str, help: &str) {
    let error = LimitSet::parse("ours.toml", text)
        .err()
        .unwrap_or_else(|| panic!("it is accepted:\n{text}"));
    let [problem] = error.problems() else {
        panic!("{:#?}", error.problems())
    };
    assert!(problem.message().contains(message), "{}", problem.message());
    assert!(
        problem.advice().unwrap_or("").contains(help),
        "{:?}",
        problem.advice()
    );
}

#[test]
fn input_limits_that_are_missing_or_contradict_each_other() {
    let head = "title = \"ours\"\nsource = \"a letter\"\n";
    let one = "[[limits]]\nname = \"a\"\nquantity = \"roll\"\nmeasure = \"body_roll_peak_to_peak\"\nregimes \
               = \"all\"\n";
    let good = format!("{head}{one}at_most = \"6 deg\"\n");
    assert_eq!(LimitSet::parse("ours.toml", &good).unwrap().limits.len(), 1);
    refused(head, "`limits` is missing", "[[limits]]");
    refused(&format!("{head}limits = []\n"), "no list of limits", "[[limits]]");
    refused(
        &format!("{head}{one}"),
        "neither of `at_most` and `at_least`",
        "at_most = 0.8",
    );
    refused(
        &format!("{good}at_least = \"1 deg\"\n"),
        "both of `at_most` and `at_least`",
        "two [[limits]]",
    );
    refused(&good.replace("\"6 deg\"", "6"), "at_most", "deg");
    refused(&good.replace("\"6 deg\"", "\"6 in\""), "at_most", "");
    refused(
        &good.replace("body_roll_peak_to_peak", "body_rol_peak_to_peak"),
        "no measure",
        "did you mean \"body_roll_peak_to_peak\"",
    );
    let second = one.replace("\"a\"", "\"b\"");
    refused(
        &format!("{good}{second}at_most = \"5 deg\"\n"),
        "on the same side",
        "the stricter one",
    );
    refused(
        &format!("{good}{second}at_least = \"7 deg\"\n"),
        "wants at least 7 deg",
        "correct one of them",
    );
    refused(
        &format!("{good}{one}at_most = \"5 deg\"\n"),
        "two limits `a`",
        "name of its own",
    );
    let load = good
        .replace("body_roll_peak_to_peak", "least_load_time")
        .replace("at_most = \"6 deg\"", "at_least = \"10\"");
    refused(&load, "a share in % is expected", "10 %");
}

/// Mistakes in files of limits are told at their places, with what is right.
#[test]
fn input_mistakes_in_files_of_limits() {
    let file = |limit: &str, rest: &str| {
        format!(
            "title = \"t\"\nsource = \"s\"\n{rest}[[limits]]\nname = \"a\"\nquantity = \"b\"\n\
             regimes = \"all\"\n{limit}"
        )
    };
    let ratio = "measure = \"l_over_v_time\"\n";
    let force = "measure = \"axle_lateral_force_mean\"\n";
    let share = "measure = \"least_load_time\"\n";
    for (text, expected) in [
        (
            file(&format!("{ratio}at_most = {{ formula = \"nadl\" }}"), ""),
            "nadl",
        ),
        (
            file(&format!("{ratio}at_most = {{ friction = 0.5 }}"), ""),
            "formula",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"nadal\", base = 1 }}"),
                "",
            ),
            "base",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"nadal\", friction = 3 }}"),
                "",
            ),
            "between 0 and 2",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"prudhomme\", share = 1, base = \"10 kN\" }}"),
                "",
            ),
            "gives no limit of l_over_v_time",
        ),
        (
            file(
                &format!("{force}at_most = {{ formula = \"prudhomme\", share = 1, base = \"10 m\" }}"),
                "",
            ),
            "a force is expected",
        ),
        (
            file(&format!("{force}at_most = {{ formula = \"nadal\" }}"), ""),
            "gives no limit",
        ),
        (
            file(&format!("{share}at_least = {{ formula = \"nadal\" }}"), ""),
            "gives no limit",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"net_axle\", base = 0.4 }}"),
                "",
            ),
            "load",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"table\", by = \"speed\", points = [] }}"),
                "",
            ),
            "there is no measure",
        ),
        (
            file(
                &format!("{ratio}at_most = {{ formula = \"table\", by = \"l_over_v_time\", points = [] }}"),
                "",
            ),
            "no list of 1 to",
        ),
        (
            file(
                &format!(
                    "{ratio}at_most = {{ formula = \"table\", by = \"l_over_v_time\", points = [[1, 2], \
                     [1, 3]] }}"
                ),
                "",
            ),
            "does not lie beyond",
        ),
        (
            file(
                &format!(
                    "{ratio}at_most = {{ formula = \"table\", by = \"l_over_v_time\", points = [[1, 2, 3]] }}"
                ),
                "",
            ),
            "has 3 entries",
        ),
        (file(&format!("{ratio}at_most = 1\nmark = \"sure\""), ""), "sure"),
        (
            file(&format!("{ratio}at_most = 1"), "not_covered = [7]\n"),
            "not_covered",
        ),
        (
            file(
                &format!("{ratio}at_most = 1"),
                "not_covered = [{ whut = \"a\" }]\n",
            ),
            "whut",
        ),
        (file(&format!("{ratio}at_most = 1"), "output = 3\n"), "output"),
    ] {
        let error = LimitSet::parse("ours.toml", &text).unwrap_err();
        let told: String = error.problems().iter().map(|own| format!("{own}; ")).collect();
        assert!(told.contains(expected), "{expected}: {told}");
        assert!(
            error.problems().iter().all(|own| own.advice().is_some()),
            "{told}"
        );
        assert!(
            error.problems().iter().all(|own| own.line_and_column().is_some()),
            "{told}"
        );
    }
    // Windows that no car takes are shown in the file.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ours.toml");
    std::fs::write(
        &path,
        file(
            &format!("{ratio}at_most = 1"),
            "output = { wheel_filtr = \"25 Hz\" }\n",
        ),
    )
    .unwrap();
    let error = LimitSet::read(&path).unwrap_err();
    let problem = &error.problems()[0];
    assert!(problem.to_string().contains("wheel_filtr"), "{problem}");
    assert_eq!(problem.source_name(), Some(path.to_str().unwrap()));
}
