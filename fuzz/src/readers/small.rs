//! Short texts: units, `--free` of `wedgelab fit`, `--option` of `wedgelab nucars run`.

use nucars::truck::Choices;
use quantity::{Kind, Quantity, Unit, UnitError};
use study::case::builtin;
use study::fit::Free;
use study::half_truck::options;

use super::cases::outcome;
use super::{ReadOutcome, Reader, refused_as_written};

/// Quantities and units.
pub const UNITS: Reader = Reader {
    name: "units",
    about: "quantities of every kind, and units alone",
    corpus: || lines(include_bytes!("../../corpus/units/quantities.txt")),
    dictionary: &[
        b"in",
        b"mm",
        b"lbf",
        b"kip",
        b"lb",
        b"kg",
        b"deg",
        b"rad",
        b"Hz",
        b"rpm",
        b"lbf/in",
        b"lbf s/in",
        b"N/mm",
        b"lb in^2",
        b"^-1",
        b"^2",
        b"^127",
        b"^-128",
        b"*",
        b"\xc2\xb7",
        b"/",
        b"(",
        b")",
        b"e308",
        b"1e-320",
    ],
    read: units,
};

/// Free parameters.
pub const FREE: Reader = Reader {
    name: "free",
    about: "--free of `wedgelab fit`",
    corpus: || lines(include_bytes!("../../corpus/free/parameters.txt")),
    dictionary: &[
        b"..",
        b"=",
        b"friction.column",
        b"control_coil.stiffness",
        b"side_frame.toe",
        b" lbf/in",
        b" deg out",
        b" in",
        b"1e308",
        b"\"",
    ],
    read: free,
};

/// Choices for the elements of NUCARS.
pub const OPTIONS: Reader = Reader {
    name: "options",
    about: "--option of `wedgelab nucars run`",
    corpus: || lines(include_bytes!("../../corpus/options/choices.txt")),
    dictionary: &[
        b"bend=",
        b"speed=",
        b"plain_toe_angle=",
        b"branch=",
        b"rise_in_slip=",
        b"negative_rise=",
        b"accumulator_damping=",
        b"gap_tension=",
        b"linear",
        b"true",
        b" mph",
        b" deg",
    ],
    read: option,
};

/// Returns one entry a line.
fn lines(text: &[u8]) -> Vec<Vec<u8>> {
    let lines = text.split(|byte| *byte == b'\n');
    lines
        .filter(|line| !line.is_empty())
        .map(<[u8]>::to_vec)
        .collect()
}

fn units(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let mut all = match Quantity::parse(text) {
        Ok(quantity) => {
            check_quantity(&quantity);
            ReadOutcome::ACCEPTED
        }
        Err(error) => unit_refused(&error, text),
    };
    for kind in Kind::ALL {
        match Quantity::parse_as(text, kind) {
            Ok(quantity) => assert!(kind.accepts(quantity.dimension()), "another kind: {kind:?}"),
            Err(error) => all = all.or(unit_refused(&error, text)),
        }
    }
    match Unit::parse(text) {
        Ok(unit) => assert!(
            unit.factor().is_finite() && unit.factor() > 0.0,
            "no factor: {}",
            unit.factor()
        ),
        Err(error) => all = all.or(unit_refused(&error, text)),
    }
    all
}

fn check_quantity(quantity: &Quantity) {
    let si = quantity.to_si();
    assert!(si.is_finite(), "not finite: {si}");
    match Quantity::new(quantity.value(), quantity.unit_text()) {
        Ok(again) => assert!(
            again.to_si().to_bits() == si.to_bits(),
            "another value: {} instead of {si}",
            again.to_si()
        ),
        Err(error) => refused_as_written(&error),
    }
    let json = serde_json::to_string(quantity).unwrap_or_default();
    assert!(
        serde_json::from_str::<Quantity>(&json).is_ok_and(|again| again == *quantity),
        "another quantity: by way of JSON"
    );
}

fn unit_refused(error: &UnitError, text: &str) -> ReadOutcome {
    let span = error.span();
    assert!(text.get(span.clone()).is_some(), "place outside: {span:?}");
    ReadOutcome::refused_with(&format!("{error}\n{}", error.help()))
}

fn free(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    match Free::parse(text) {
        Ok(free) => {
            assert!(free.low < free.high, "no range: {} to {}", free.low, free.high);
            let set = [0.0, 0.5].map(|share| free.set(free.at(share)));
            let cases = set.map(|set| outcome(builtin::case_with("cdrun_toe_0_psi_0", &[set])));
            ReadOutcome::ACCEPTED.or(cases[0]).or(cases[1])
        }
        Err(error) => ReadOutcome::refused_with(&format!("{}\n{}", error.problem, error.advice)),
    }
}

fn option(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let mut choices = Choices::default();
    match options::set(&mut choices, text) {
        Ok(()) => {
            assert!(!choices.describe().is_empty(), "nothing said: {choices:?}");
            ReadOutcome::ACCEPTED
        }
        Err(error) => ReadOutcome::refused_with(&error.to_string()),
    }
}
