//! Mistakes in a study are reported where they were written.

use std::path::Path;

use study::design::Study;

use super::common::{HEAD, SHORT, parse};

/// The study has one mistake: in its message, marked, in its help.
#[track_caller]
fn refused(text: &str, message: &str, marked: &str, help: &str) {
    let error = parse(text)
        .err()
        .unwrap_or_else(|| panic!("it is accepted:\n{text}"));
    let [problem] = error.problems() else {
        panic!("{:#?}", error.problems())
    };
    assert!(problem.message().contains(message), "{}", problem.message());
    if !marked.is_empty() {
        assert_eq!(problem.marked_text(), Some(marked), "{}", problem.message());
        assert_eq!(problem.source_name(), Some("some.toml"));
    }
    let advice = problem.advice().unwrap_or("");
    assert!(advice.contains(help), "{advice}");
}

fn vary(line: &str) -> String {
    format!("{HEAD}sampling = \"full_factorial\"\n[vary]\n{line}\n")
}

#[test]
fn input_contradictory_ranges() {
    for (line, message, marked, help) in [
        (
            "friction.column = { from = 0.2, to = 0.2, count = 3 }",
            "to the same",
            "0.2",
            "[set]",
        ),
        (
            "wedge.angle = { from = \"30 deg\", to = \"1 in\", count = 3 }",
            "do not measure the same",
            "\"1 in\"",
            "one kind",
        ),
        (
            "friction.column = { from = 0.0, to = 0.2, count = 3, scale = \"logarithmic\" }",
            "lead nowhere",
            "0.0",
            "linear",
        ),
        (
            "friction.column = { from = 0.2, to = 0.0, count = 3, scale = \"logarithmic\" }",
            "lead nowhere",
            "0.0",
            "linear",
        ),
        (
            "friction.column = { from = 0.1, to = 0.2, count = 1 }",
            "count` is 1",
            "1",
            "two ends",
        ),
        (
            "friction.column = { from = 0.1, to = 0.2, count = 1e12 }",
            "count` is 1e12",
            "1e12",
            "at most a billion",
        ),
        (
            "side_frame.toe = { from = \"-0.2 deg\", to = \"0.2 deg out\", count = 3 }",
            "is no number",
            "\"-0.2 deg\"",
            "0.2 deg in",
        ),
        (
            "friction.column = { from = 0.1, to = 0.2 }",
            "count` is missing",
            "column",
            "count = 5",
        ),
        (
            "friction.column = { from = 0.1, values = [1] }",
            "both `values` and `from`",
            "from",
            "",
        ),
        ("friction.column = []", "no values", "[]", ""),
        ("friction.column = [0.3, 0.30]", "twice", "0.30", "take it out"),
        ("friction.column = 0.3", "does not vary", "0.3", "[set]"),
        (
            "friction.column = { from = 0.1, too = 0.2, count = 2, to = 0.2 }",
            "no key `too`",
            "too",
            "`to`",
        ),
    ] {
        refused(&vary(line), message, marked, help);
    }
}

#[test]
fn input_values_that_no_case_takes() {
    for (line, message, marked, help) in [
        ("friction.colum = [0.3]", "no key `colum`", "colum", "`column`"),
        ("wege.angle = [\"30 deg\"]", "no key `wege`", "angle", "`wedge`"),
        (
            "wedge.angle = [\"30 deg\", \"95 deg\"]",
            "95 deg",
            "\"95 deg\"",
            "",
        ),
        ("wedge.angle = [30]", "", "30", ""),
        (
            "wedge.angle = { from = \"30 dg\", to = \"31 deg\", count = 2 }",
            "no number",
            "\"30 dg\"",
            "",
        ),
        (
            "wedge.damping = [\"constant\", \"varable\"]",
            "varable",
            "\"varable\"",
            "variable",
        ),
        (
            "simulation.output_units = [\"si\"]",
            "units of the output",
            "output_units",
            "[set]",
        ),
    ] {
        refused(&vary(line), message, marked, help);
    }
    let twice = format!(
        "{HEAD}sampling = \"full_factorial\"\n[set]\nfriction.column = 0.2\n[vary]\nfriction.column = [0.3]\n"
    );
    refused(&twice, "varied and set as well", "column", "[set]");
    let set = format!(
        "{HEAD}sampling = \"full_factorial\"\n[set]\nfriction.column = -0.2\n[vary]\nfriction.slope = [0.3]\n"
    );
    refused(&set, "friction.column", "-0.2", "");
}

#[test]
fn input_the_document() {
    for (text, message, marked, help) in [
        (
            "sampling = \"list\"\n[[variants]]\nfriction.column = 0.3\n",
            "`case` is missing",
            "",
            "vdrun",
        ),
        (
            "case = \"vdrun_toe_0_psi_1\"\nsampling = \"sobol\"\nruns = 3\n[vary]\n\
             friction.column = { from = 0.1, to = 0.2 }\n",
            "neither a case file",
            "\"vdrun_toe_0_psi_1\"",
            "vdrun_toe_0_psi_0",
        ),
        (
            &format!("{HEAD}sampling = \"sobbol\"\n[vary]\nfriction.column = [0.3]\n"),
            "cannot be \"sobbol\"",
            "\"sobbol\"",
            "\"sobol\"",
        ),
        (
            &format!("{HEAD}sampling = \"sobol\"\n[vary]\nfriction.column = [0.3]\n"),
            "`runs` is missing",
            "",
            "runs = 256",
        ),
        (
            &format!("{HEAD}sampling = \"sobol\"\nruns = 2.5\n[vary]\nfriction.column = [0.3]\n"),
            "whole number",
            "2.5",
            "256",
        ),
        (
            &format!("{HEAD}sampling = \"full_factorial\"\nruns = 5\n[vary]\nfriction.column = [0.3]\n"),
            "no `runs`",
            "runs",
            "follows",
        ),
        (
            &format!(
                "{HEAD}sampling = \"sobol\"\nruns = 5\n[vary]\n\
                 friction.column = {{ from = 0.1, to = 0.2, count = 4 }}\n"
            ),
            "takes all values",
            "count",
            "runs",
        ),
        (
            &format!("{HEAD}sampling = \"full_factorial\"\n{SHORT}"),
            "nothing is varied",
            "",
            "[vary]",
        ),
        (
            &format!("{HEAD}sampling = \"list\"\n"),
            "no [[variants]]",
            "",
            "[[variants]]",
        ),
        (
            &format!("{HEAD}sample = \"list\"\nsampling = \"list\"\n[[variants]]\nfriction.column = 0.3"),
            "in a study",
            "sample",
            "sampling",
        ),
        ("case = ", "not TOML", "", ""),
    ] {
        refused(text, message, marked, help);
    }
}

#[test]
fn input_more_runs_than_can_be_counted() {
    let many = "{ from = 0.1, to = 0.2, count = 1000000000 }";
    let text = vary(&format!("friction.column = {many}\nfriction.slope = {many}"));
    refused(&text, "more runs than can be counted", "", "sobol");
}

/// The study files of the documentation are read, and have the runs that they promise.
#[test]
fn input_studies_of_the_documentation_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/studies");
    let mut runs: Vec<(String, u64)> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            let study = Study::read(&path).unwrap_or_else(|error| panic!("{:#?}", error.problems()));
            (
                path.file_stem().unwrap().to_str().unwrap().to_owned(),
                study.count(),
            )
        })
        .collect();
    runs.sort();
    let runs: Vec<(&str, u64)> = runs.iter().map(|(name, runs)| (name.as_str(), *runs)).collect();
    let expected = [
        ("bounce_of_a_truck", 36),
        ("loss_over_amplitude_and_frequency", 32),
        ("loss_over_load_and_toe", 35),
    ];
    assert_eq!(runs, expected);
}
