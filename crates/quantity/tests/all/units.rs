//! Units against their exact definitions, the messages of bad texts, and round trips.

use proptest::prelude::*;
use quantity::{Dimension, Kind, Quantity, System, UnitError};
use std::f64::consts::PI;

const LBF: f64 = 4.4482216152605;

fn si(text: &str) -> f64 {
    Quantity::parse(text).unwrap().to_si()
}

/// Equal but for the last two bits.
fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 2.0 * f64::EPSILON * a.abs().max(b.abs())
}

#[test]
fn named_units_are_exact() {
    for (text, exact) in [
        ("1 in", 0.0254),
        ("1 ft", 0.3048),
        ("1 yd", 0.9144),
        ("1 mi", 1609.344),
        ("1 mm", 0.001),
        ("1 lbf", LBF),
        ("1 kip", 4448.2216152605),
        ("1 lb", 0.45359237),
        ("1 slug", LBF / 0.3048),
        ("1 t", 1000.0),
        ("1 mph", 0.44704),
        ("1 g0", 9.80665),
        ("1 psi", LBF / (0.0254 * 0.0254)),
        ("1 hp", 550.0 * 0.3048 * LBF),
        ("180 deg", PI),
        ("180 °", PI),
        ("1 rev", 2.0 * PI),
        ("60 rpm", 2.0 * PI),
        ("1 min", 60.0),
    ] {
        assert!(close(si(text), exact), "{text}: {} is not {exact}", si(text));
    }
}

#[test]
fn compounds_are_exact() {
    for (text, exact) in [
        ("1 lb in^2", 0.45359237 * 0.0254 * 0.0254),
        ("1 lb in²", 0.45359237 * 0.0254 * 0.0254),
        ("1 lbf s/in", LBF / 0.0254),
        ("1 lbf*s/in", LBF / 0.0254),
        ("1 lbf·s / in", LBF / 0.0254),
        ("1 lbf/in", LBF / 0.0254),
        ("1 lbf in", LBF * 0.0254),
        ("1 in-lbf", LBF * 0.0254),
        ("1 in/s", 0.0254),
        ("1 km/h", 1.0 / 3.6),
        ("1 N s/m", 1.0),
        ("1 kN/mm", 1e6),
        ("1 lbf s^2/in", LBF / 0.0254),
        ("1 ft/s/s", 0.3048),
        ("1 in s^-2", 0.0254),
        ("1 lbf/(in s)", LBF / 0.0254),
        ("1 1/s", 1.0),
        ("-2.5e-1lbf", -0.25 * LBF),
        ("  +.5 in ", 0.0127),
    ] {
        assert!(close(si(text), exact), "{text}: {} is not {exact}", si(text));
    }
}

#[test]
fn frequencies_are_angular_inside() {
    let hertz = Quantity::parse_as("0.75 Hz", Kind::Frequency).unwrap();
    assert!(close(hertz.to_si(), 0.75 * 2.0 * PI));
    assert_eq!(
        Quantity::parse_as("2 rad/s", Kind::Frequency).unwrap().to_si(),
        2.0
    );
    assert!(Quantity::parse_as("19.1 rpm", Kind::Frequency).is_ok());
    let error = Quantity::parse_as("2 1/s", Kind::Frequency).unwrap_err();
    assert!(error.help().contains("radians or cycles"), "{}", error.help());
}

#[test]
fn rotational_damping_may_name_the_radian() {
    for text in ["1 lbf s in", "1 lbf in s/rad"] {
        assert!(
            Quantity::parse_as(text, Kind::RotationalDamping).is_ok(),
            "{text}"
        );
    }
}

fn check(text: &str, kind: Kind, message: &str, help: &str, place: &str) {
    let error = Quantity::parse_as(text, kind).unwrap_err();
    assert_eq!(error.to_string(), message, "{text}");
    assert!(error.help().contains(help), "{text}: {}", error.help());
    assert_eq!(&text[error.span()], place, "{text}");
}

#[test]
fn messages_say_what_and_where() {
    use Kind::*;
    check(
        "0.2 deg",
        Length,
        "this is an angle (deg); a length is expected",
        "\"0.2 in\"",
        "deg",
    );
    check(
        "50 lb",
        Force,
        "this is a mass (lb); a force is expected",
        "lb is a mass, lbf",
        "lb",
    );
    check(
        "10.25 in",
        Force,
        "this is a length (in); a force is expected",
        "\"10.25 lbf\"",
        "in",
    );
    check(
        "1.5",
        Force,
        "the unit is missing; a force is expected",
        "\"1.5 lbf\"",
        "1.5",
    );
    check(
        "3 lbff",
        Force,
        "there is no unit \"lbff\"",
        "did you mean lbf?",
        "lbff",
    );
    check(
        "3 lb in2",
        Inertia,
        "there is no unit \"in2\"",
        "did you mean in^2?",
        "in2",
    );
    check(
        "3 inches",
        Length,
        "there is no unit \"inches\"",
        "did you mean in?",
        "inches",
    );
    check("3 lbs", Force, "there is no unit \"lbs\"", "lbf (force)", "lbs");
    check(
        "nan in",
        Length,
        "\"nan\" is not a finite number",
        "finite",
        "nan",
    );
    check(
        "-inf in",
        Length,
        "\"-inf\" is not a finite number",
        "finite",
        "-inf",
    );
    check(
        "1e999 in",
        Length,
        "\"1e999\" is not a finite number",
        "finite",
        "1e999",
    );
    let thousands = "\"1,000\" is not a number: write a decimal point, and no separators of thousands";
    check("1,000 lbf", Force, thousands, "lbf", "1,000");
    check(
        "1_000 lbf",
        Force,
        "\"1_000\" is not a number: write the digits without underscores",
        "",
        "1_000",
    );
    check(
        "a lot",
        Force,
        "\"a\" is not a number: a quantity begins with a number",
        "lbf",
        "a",
    );
    check("", Force, "a number with a unit is missing", "\"1 lbf\"", "");
    check(
        "3 lbf/",
        Force,
        "this unit cannot be read: a unit is missing here",
        "\"lbf s/in\"",
        "",
    );
    check(
        "3 (lbf",
        Force,
        "this unit cannot be read: this bracket is not closed",
        "",
        "(",
    );
    check(
        "3 lbf^x",
        Force,
        "this unit cannot be read: a power is a whole number such as ^2",
        "",
        "^",
    );
    let ambiguous = Quantity::parse("1 lbf/in s").unwrap_err();
    assert!(matches!(ambiguous, UnitError::BadExpression { .. }));
    assert_eq!(ambiguous.span(), 9..10);
    // Places count in bytes, also behind letters of two bytes.
    check("1 lb·inn", Inertia, "there is no unit \"inn\"", "in", "inn");
}

#[test]
fn every_kind_reads_its_own_unit_and_inverts_its_factor() {
    for kind in Kind::ALL {
        for system in [System::Us, System::Si] {
            if kind.dimension() == Dimension::NONE {
                assert_eq!(kind.suffix(system), "");
                continue;
            }
            let one = Quantity::new(1.0, kind.unit(system)).unwrap();
            one.check(kind).unwrap();
            // Angles are written in degrees and come out in radians.
            if kind != Kind::Angle {
                assert!(
                    close(one.to_si() * kind.from_si(system), 1.0),
                    "{kind:?} {system:?}"
                );
            }
        }
    }
    assert_eq!(Kind::Power.suffix(System::Us), "lbf_in_per_s");
    assert_eq!(Kind::Power.label(System::Us), "lbf·in/s");
    assert_eq!(Kind::Power.suffix(System::Si), "W");
}

const TEXTS: [&str; 12] = [
    "in",
    "ft",
    "mm",
    "lbf",
    "kip",
    "N",
    "lb in^2",
    "lbf s/in",
    "kN/mm",
    "rad/s",
    "Hz",
    "lbf/(in s)",
];

proptest! {
    #[test]
    fn printing_and_reading_gives_the_same_bits(
        value in -1e12..1e12f64,
        exponent in -20..20i32,
        unit in 0..TEXTS.len(),
    ) {
        let value = value * 10f64.powi(exponent);
        let quantity = Quantity::new(value, TEXTS[unit]).unwrap();
        prop_assert_eq!(quantity.value().to_bits(), value.to_bits());
        let again = Quantity::parse(&quantity.to_string()).unwrap();
        prop_assert_eq!(again.to_si().to_bits(), quantity.to_si().to_bits());
        prop_assert_eq!(again, quantity);
    }

    #[test]
    fn conversion_there_and_back_is_exact_to_the_last_bits(
        value in -1e9..1e9f64,
        kind in 0..Kind::ALL.len(),
    ) {
        let kind = Kind::ALL[kind];
        prop_assume!(kind.dimension() != Dimension::NONE && kind != Kind::Angle);
        let quantity = Quantity::new(value, kind.unit(System::Us)).unwrap();
        prop_assert!(close(quantity.to_si() * kind.from_si(System::Us), value));
    }

    #[test]
    fn no_text_breaks_the_reader(text in "\\PC{0,24}") {
        if let Err(error) = Quantity::parse(&text) {
            prop_assert!(text.get(error.span()).is_some());
        }
    }

    #[test]
    fn no_text_of_unit_letters_breaks_the_reader(text in "[-+0-9.e ]{0,6} ?[a-z0-9^²/*·() -]{0,12}") {
        if let Err(error) = Quantity::parse(&text) {
            prop_assert!(text.get(error.span()).is_some());
        }
    }
}

#[test]
fn issue_036_numbers_in_messages_have_six_digits() {
    for (value, text) in [
        (1.5784466453250605, "1.57845"),
        (0.30000000000000004, "0.3"),
        (1234567.0, "1234570"),
        (2.0, "2"),
        (-0.0, "-0"),
        (1.23456789e-9, "1.23457e-9"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        assert_eq!(quantity::SixDigits(value).to_string(), text);
    }
}

#[test]
fn issue_036_the_beginning_of_a_name_is_understood() {
    let names = ["vdrun_toe_0_psi_0.012", "vdrun_toe_0_psi_0", "rig"];
    assert_eq!(quantity::nearest("vdrun_to", names), Some("vdrun_toe_0_psi_0"));
    assert_eq!(
        quantity::nearest("vdrun_toe_0_psi_1", names),
        Some("vdrun_toe_0_psi_0")
    );
    assert_eq!(quantity::nearest("Rig", names), Some("rig"));
    assert_eq!(quantity::nearest("vd", names), None);
    assert_eq!(quantity::nearest("toe", names), None);
}
