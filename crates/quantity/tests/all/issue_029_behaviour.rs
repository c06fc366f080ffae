//! Issue 29: what ended the program, or filled the screen, when it was typed as a unit.

use quantity::{Kind, Number, Quantity, Unit, nearest};

/// The parser called itself at each bracket: 50,000 pairs ended the program.
#[test]
fn issue_029_brackets_in_units_are_read_to_a_stated_depth() {
    let nested = |depth: usize| format!("32 {}deg{}", "(".repeat(depth), ")".repeat(depth));
    assert!(Quantity::parse_as(&nested(16), Kind::Angle).is_ok());
    let deep = Quantity::parse_as(&nested(17), Kind::Angle).unwrap_err();
    assert!(
        deep.to_string().contains("brackets are nested more than 16 deep"),
        "{deep}"
    );
    // At the bracket that is one too many.
    assert_eq!(deep.span(), 19..20);
    for depth in [1000, 50_000, 1_000_000] {
        let text = nested(depth);
        assert!(Quantity::parse(&text).is_err());
        assert!(Unit::parse(&text[3..]).is_err());
    }
}

/// The messages repeated what was typed.
#[test]
fn issue_029_messages_are_short_whatever_was_typed() {
    let long = "x".repeat(5_000_000);
    for text in [
        long.clone(),
        format!("1 {long}"),
        format!("{} in", "9".repeat(1_000_000)),
        format!("1{}", "x".repeat(200)),
        format!("1 {}", "x".repeat(200)),
        "1".repeat(250),
        "\u{1b}[31m".repeat(40),
    ] {
        let error = Quantity::parse_as(&text, Kind::Length).unwrap_err();
        let said = format!("{error} {}", error.help());
        assert!(
            said.len() < 1000 && !said.contains('\u{1b}'),
            "{} bytes",
            said.len()
        );
        assert!(error.span().end <= text.len());
    }
    assert_eq!(nearest(&long, ["lbf", "kip"]), None);
}

/// A number beyond 1e16 was written with up to 308 digits.
#[test]
fn issue_029_numbers_are_written_in_short_and_read_back() {
    for value in [
        0.0,
        -0.0,
        1.0,
        0.1 + 0.2,
        1e300,
        -1e-300,
        5e-324,
        f64::MAX,
        12345.678,
    ] {
        let text = Number(value).to_string();
        assert!(text.len() < 25, "{text}");
        assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
    }
}

/// A blank is written between number and unit: what had none, and was as long as may be, was refused then.
#[test]
fn issue_048_the_longest_quantities_are_read_as_written() {
    let most = input::limits::QUANTITY;
    for length in [most - 1, most] {
        let text = format!("1979(lbf/in{})", " ".repeat(length - 12));
        assert_eq!(text.len(), length);
        match Quantity::parse(&text) {
            Ok(quantity) => assert!(Quantity::parse(&quantity.to_string()).is_ok(), "{length}"),
            Err(error) => assert!(length == most && error.to_string().contains("256"), "{error}"),
        }
    }
}
