//! Single values laid over files: each path sets its value, and what is wrong is told with what would do.

use nucars::read::{read_input, read_system};
use nucars::set::set;
use nucars::tree::{InputFile, Law, SystemFile, Toe};
use nucars::{builtin, source::SourceText};
use std::sync::Arc;

fn source(name: &str) -> Arc<SourceText> {
    builtin::source(name).unwrap()
}

fn system() -> SystemFile {
    read_system(&source("Bolst_wedge_sf_68_constant.sys"))
        .strict()
        .unwrap()
}

fn input() -> InputFile {
    read_input(&source("bolst_displ_input3.inp")).strict().unwrap()
}

/// Returns the system after the values have been set.
fn after(values: &[(&str, &str)]) -> SystemFile {
    let (mut system, mut input) = (system(), input());
    for (path, value) in values {
        set(&mut system, Some(&mut input), path, value).unwrap();
    }
    system
}

#[test]
fn input_a_value_that_is_set_is_the_value_of_an_edited_file() {
    let name = "Bolst_wedge_sf_68_constant.sys";
    let text = source(name).text().to_owned();
    let line = "  14    0    0   37.5  3.7022E3  1.0E6  1.0E3  0.40  0.40  .T.  1.0D5";
    assert!(text.contains(line));
    let edited = text.replace(
        line,
        "  14    0    0   35.0  3000.0  2.0E6  1.0E3  0.40  0.25  .F.  9.0D4",
    );
    let edited = read_system(&SourceText::from_text(name, edited).unwrap())
        .strict()
        .unwrap();
    let values = [
        ("characteristic.14.wedge_angle", "35 deg"),
        ("wedges.coil_force", "\"3000 lbf\""),
        ("wedges.stiffness", "2e6 lbf/in"),
        ("characteristic.14.column_friction", "0.25"),
        ("wedges.toe", "in"),
        ("characteristic.14.normal_limit", "90 kip"),
    ];
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    let [own, other] = [after(&values), edited].map(|file| file.characteristic(14).unwrap().law.clone());
    let numbers = |law: &Law| match law {
        Law::StickSlipWedge {
            angle,
            force,
            stiffness,
            bristle_damping,
            slope_friction,
            column_friction,
            toe,
            normal_limit,
            ..
        } => {
            assert_eq!(toe.value, Toe::In);
            let all = [
                angle,
                force,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                normal_limit,
            ];
            all.map(|value| value.value).to_vec()
        }
        _ => Vec::new(),
    };
    let [own, other] = [numbers(&own), numbers(&other)];
    assert_eq!(own.len(), 7);
    assert!(
        own.iter().zip(&other).all(|(a, b)| close(*a, *b)),
        "{own:?} {other:?}"
    );
}

#[test]
fn input_units_become_those_of_the_files() {
    let (before, after) = (
        system(),
        after(&[
            ("body.1.mass", "1000 kg"),
            ("body.1.yaw_inertia", "2000 kg*m^2"),
            ("body.1.z", "0.254 m"),
            ("connection.127.x", "-1 ft"),
        ]),
    );
    let (pound, inch) = (4.448_221_615_260_5, 0.0254);
    let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} {b}");
    let body = after.body(1).unwrap();
    // lb s^2/in and lb in s^2 by their definitions.
    close(*body.mass, 1000.0 * inch / pound);
    close(*body.inertia[2], 2000.0 / (pound * inch));
    close(*body.position[2], 10.0);
    close(*after.connection(127).unwrap().position[0], -12.0);
    assert_eq!(body.inertia[0], before.body(1).unwrap().inertia[0]);
}

#[test]
fn input_factors_multiply_functions_and_histories() {
    let (mut changed, mut histories) = (system(), input());
    for (path, value) in [
        ("function.16.factor", "1.5"),
        ("history.3.factor", "0.5"),
        ("history.3.frequency", "2 rad/s"),
    ] {
        set(&mut changed, Some(&mut histories), path, value).unwrap();
    }
    for at in [-0.5, -1.0, -3.0] {
        let (before, after) = (
            system().function(16).unwrap().value(at),
            changed.function(16).unwrap().value(at),
        );
        assert!(before != 0.0 && (after - 1.5 * before).abs() <= 1e-12 * before.abs());
    }
    let segment = &histories.history(3).unwrap().segments[0];
    assert_eq!(*segment.amplitude, 0.5);
    for frequency in &segment.coefficients {
        assert!((**frequency - 2.0 / (2.0 * std::f64::consts::PI)).abs() < 1e-15);
    }
}

#[test]
fn input_mistakes_say_what_would_do() {
    let cases = [
        ("wedges.column_fricton", "0.3", "did you mean column_friction?"),
        ("wedges.zzzzzzzz", "0.3", "wedge_angle, coil_force"),
        ("weges.friction", "0.3", "did you mean wedges?"),
        ("wedges", "0.3", "write for example"),
        (
            "characteristic.99.friction",
            "0.3",
            "there is no characteristic 99; there are: 8, 9",
        ),
        (
            "characteristic.fourteen.friction",
            "0.3",
            "is no number of a characteristic",
        ),
        ("history.3.phase", "0", "history 3 has factor, frequency"),
        ("function.16.value", "0", "function 16 has factor"),
        ("wedges.column_friction", "-0.1", "a number from zero on"),
        ("wedges.column_friction", "inf", "a number from zero on"),
        ("wedges.wedge_angle", "35", "an angle, such as"),
        ("wedges.wedge_angle", "35 lbf", "an angle, such as"),
        ("wedges.toe", "inwards", "\"out\" or \"in\""),
        ("body.1.mass", "0 kg", "a positive mass"),
        ("body.1.mass", "2000", "a positive mass"),
        ("function.16.factor", "much", "a number, such as 1.2"),
        ("", "1", "paths begin with"),
    ];
    for (path, value, expected) in cases {
        let (mut changed, mut histories) = (system(), input());
        let error = set(&mut changed, Some(&mut histories), path, value)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{path}={value}: {error}");
        assert_eq!(changed, system(), "{path}={value}");
        assert_eq!(histories, input(), "{path}={value}");
    }
    let without = set(&mut system(), None, "history.3.factor", "2")
        .unwrap_err()
        .to_string();
    assert!(without.contains("there is no history 3"), "{without}");
}
