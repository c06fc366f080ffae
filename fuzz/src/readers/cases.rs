//! Cases: files, values as Python gives them, and overrides of a built-in case.

use study::case::{Case, CaseError, builtin};

use super::{ReadOutcome, Reader, corpus, nowhere, refused_as_written};

/// Case files.
pub const CASES: Reader = Reader {
    name: "cases",
    about: "case files",
    corpus: case_corpus,
    dictionary: DICTIONARY,
    read: case_file,
};

/// Values that a program lays over a case.
pub const VALUES: Reader = Reader {
    name: "values",
    about: "values of a case as Python gives them",
    corpus: corpus!("values": "friction.toml", "motions.toml", "sections.toml"),
    dictionary: DICTIONARY,
    read: values,
};

/// The overrides of `--set`, one a line.
pub const OVERRIDES: Reader = Reader {
    name: "overrides",
    about: "--set over a built-in case, one a line",
    corpus: corpus!("overrides": "motions.txt", "numbers.txt", "quantities.txt"),
    dictionary: DICTIONARY,
    read: overrides,
};

/// The case that is varied: yawed, so that it has most keys.
const BASE: &str = "vdrun_toe_out_0.2_psi_0.012";

const DICTIONARY: &[&[u8]] = &[
    b"[wedge]",
    b"[control_coil]",
    b"[contact]",
    b"[friction]",
    b"[side_frame]",
    b"[bolster]",
    b"[environment]",
    b"[simulation]",
    b"damping = \"constant\"",
    b"damping = \"variable\"",
    b"free_coordinates = [\"vertical\", \"pitch\"]",
    b"table = [[\"0 in\", \"0 lbf\"], [\"1 in\", \"2 lbf\"]]",
    b"toe = \"0.2 deg out\"",
    b"column_law = \"bristle\"",
    b"method = \"tr-bdf2\"",
    b"output_units = \"si\"",
    b"start = \"equilibrium\"",
    b"duration = \"1 s\"",
    b"{ shape = \"sine\", amplitude = \"1 in\", frequency = \"2 rad/s\" }",
    b"{ shape = \"ramp\", amplitude = \"1 in\", duration = \"1 s\", profile = \"smooth\" }",
    b"{ shape = \"triangle\", amplitude = \"1 in\", frequency = \"1 Hz\" }",
    b"{ shape = \"swept_sine\", amplitude = \"1 in\", start_frequency = \"1 Hz\", end_frequency = \"2 Hz\", \
      duration = \"1 s\" }",
    b"{ shape = \"table\", points = [[\"0 s\", \"0 in\"], [\"1 s\", \"1 in\"], [\"2 s\", \"0 in\"], [\"3 \
      s\", \"1 in\"]] }",
    b"{ shape = \"table\", file = \"table.csv\" }",
    b"bolster.vertical.",
    b"lbf/in",
    b"lbf s/in",
    b"deg",
    b" out\"",
    b"1979-05-27T07:32:00Z",
    b"0x7fffffffffffffff",
    b"\\u0000",
    b"\\U0010FFFF",
];

/// Cases that differ in their keys, not only in their numbers.
fn case_corpus() -> Vec<Vec<u8>> {
    let every = builtin::names().filter_map(|name| builtin::text(name).ok());
    let thesis = builtin::thesis_names().count();
    // The thesis's differ in numbers alone; of the others each has something of its own.
    let some = every
        .enumerate()
        .filter(|(place, _)| *place == 0 || place % 6 == 5 || *place == thesis);
    some.map(|(_, text)| text.as_bytes().to_vec()).collect()
}

/// Returns the outcome of reading a case.
pub(super) fn outcome(read: Result<Case, CaseError>) -> ReadOutcome {
    match read {
        Ok(case) => {
            check_written(&case);
            ReadOutcome::ACCEPTED
        }
        Err(error) => refused(&error),
    }
}

/// Checks the places of mistakes, and how they are shown.
pub(super) fn refused(error: &CaseError) -> ReadOutcome {
    assert!(!error.problems().is_empty(), "no mistake: {error}");
    for problem in error.problems() {
        let placed = problem.source_name().is_none() || problem.line_and_column().is_some();
        assert!(placed, "place outside: {problem}");
    }
    ReadOutcome::refused(error)
}

/// The case as written is read as the same case.
fn check_written(case: &Case) {
    let text = case.to_toml_embedded();
    let again = match Case::parse("case.toml", text, nowhere(), &[]) {
        Ok(again) => again,
        Err(error) => refused_as_written(&messages(&error)),
    };
    assert!(
        again.parameters == case.parameters,
        "other parameters: {}",
        case.name
    );
    assert!(
        again.simulation == case.simulation,
        "another simulation: {}",
        case.name
    );
    assert!(again.to_toml() == text, "another text: {}", case.name);
}

/// Returns all messages of an error.
pub(super) fn messages(error: &CaseError) -> String {
    let messages: Vec<&str> = error.problems().iter().map(|problem| problem.message()).collect();
    messages.join("; ")
}

fn case_file(input: &[u8]) -> ReadOutcome {
    match std::str::from_utf8(input) {
        Ok(text) => outcome(Case::parse("case.toml", text, nowhere(), &[])),
        Err(_) => ReadOutcome::NO_TEXT,
    }
}

fn values(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let over = |base: &str| outcome(Case::of_values("base.toml", base, Some(text), nowhere()));
    let over_case = over(builtin::text(BASE).unwrap_or_default());
    let over_thesis = over("");
    over_case.or(over_thesis)
}

fn overrides(input: &[u8]) -> ReadOutcome {
    match std::str::from_utf8(input) {
        Ok(text) => {
            let set: Vec<String> = text.lines().map(str::to_owned).collect();
            outcome(builtin::case_with(BASE, &set))
        }
        Err(_) => ReadOutcome::NO_TEXT,
    }
}
