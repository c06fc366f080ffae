//! The list of fields: it holds the whole case, and what it says can be set.

use std::path::Path;

use study::case::{Case, Field, Input, builtin};

fn fields(case: &Case) -> Vec<Field> {
    let sections = case.fields().iter();
    sections.flat_map(|section| section.fields.clone()).collect()
}

/// Returns it as the explorer writes it.
fn set(field: &Field) -> String {
    match &field.input {
        Input::Text => format!("{}={:?}", field.path, field.text),
        _ => format!("{}={}", field.path, field.text),
    }
}

/// Setting every field to what it says gives the same case, of every built-in one.
#[test]
fn every_field_can_be_set_to_what_it_says() {
    for name in builtin::names() {
        let case = builtin::case(name).unwrap();
        let overrides: Vec<String> = fields(&case)
            .iter()
            .filter(|field| !field.text.is_empty() || matches!(field.input, Input::Text))
            .map(set)
            .collect();
        let again = builtin::case_with(name, &overrides).unwrap();
        assert_eq!(again, case, "{name}");
    }
}

/// Every key of the commented case file is a field, in the same order.
#[test]
fn every_key_of_the_case_file_is_a_field() {
    let case = builtin::case("vdrun_toe_0_psi_0").unwrap();
    let mut section = String::new();
    let mut keys = Vec::new();
    for line in case.to_toml().lines() {
        if let Some(name) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
            section = format!("{name}.");
        } else if let Some((key, _)) = line.split_once(" = ").filter(|(key, _)| !key.contains('#')) {
            keys.push(format!("{section}{key}"));
        }
    }
    // Parts of values, and keys that are left out.
    let parts = [
        "amplitude",
        "frequency",
        "phase",
        "center",
        "sliding_friction",
        "stribeck_speed",
        "friction_half_load",
        "friction_map",
        "wedge_wear",
        "counterface_wear",
        "pad",
        "rise",
    ];
    let listed: Vec<String> = fields(&case)
        .into_iter()
        .map(|field| field.path)
        .filter(|path| !parts.iter().any(|part| path.ends_with(&format!(".{part}"))))
        .collect();
    assert_eq!(listed, keys);
}

/// Suggested ranges hold the value, and toe carries its sign in words.
#[test]
fn ranges_hold_their_values() {
    for name in builtin::names() {
        for field in fields(&builtin::case(name).unwrap()) {
            let numbers = match &field.input {
                Input::Number(number) => vec![number.clone()],
                Input::Triple { numbers } => numbers.to_vec(),
                _ => continue,
            };
            for number in numbers {
                assert!(
                    number.low <= number.value && number.value <= number.high && number.low < number.high,
                    "{name} {}: {number:?}",
                    field.path
                );
                assert!(!number.logarithmic || number.low > 0.0);
            }
        }
    }
    let text = "[wedge]\ndamping = \"variable\"\n[side_frame]\ntoe = \"0.2 deg in\"\n";
    let case = Case::parse("a.toml", text, Path::new(""), &[]).unwrap();
    let toe = fields(&case)
        .into_iter()
        .find(|field| field.path == "side_frame.toe")
        .unwrap();
    let Input::Number(number) = toe.input else {
        panic!("toe is a number")
    };
    assert_eq!((number.value, number.signs), (-0.2, Some(["in", "out"])));
    assert_eq!(toe.text, "0.2 deg in");
}

/// A mistake in an override knows the path that was set.
#[test]
fn mistakes_name_the_path_that_was_set() {
    for (set, path) in [
        ("wedge.angle=32 in", "wedge.angle"),
        ("friction.column=-1", "friction.column"),
        ("bolster.vertical.frequency=0 Hz", "bolster.vertical.frequency"),
        ("wedge.colour=red", "wedge.colour"),
        ("wedge.angle=", "wedge.angle"),
    ] {
        let error = builtin::case_with("vdrun_toe_0_psi_0", &[set.to_owned()]).unwrap_err();
        assert_eq!(error.problems()[0].set_path(), Some(path), "{set}");
    }
    let error = Case::parse("a.toml", "[wedge]\ndamping = 3\n", Path::new(""), &[]).unwrap_err();
    assert_eq!(error.problems()[0].set_path(), None);
}

/// Every part of a sum and every point of a short table has a field; quantities stand in them in both systems
/// of units.
#[test]
fn sums_and_tables_have_fields_and_fields_have_both_units() {
    let overrides = [
        "bolster.vertical=[{shape=\"sine\", amplitude=\"1 in\", frequency=\"2 rad/s\"}, {shape=\"ramp\", \
         amplitude=\"0.5 in\", duration=\"1 s\"}, \"0.1 in\"]",
        "bolster.yaw={shape=\"table\", points=[[\"0 s\", \"0 rad\"], [\"1 s\", \"0.01 rad\"], [\"2 s\", \"0 \
         rad\"], [\"10 s\", \"0.01 rad\"]]}",
    ];
    let case = builtin::case_with("vdrun_toe_0_psi_0", &overrides.map(str::to_owned)).unwrap();
    let fields = fields(&case);
    let find = |path: &str| {
        fields
            .iter()
            .find(|field| field.path == path)
            .unwrap_or_else(|| panic!("{path}"))
    };
    for path in [
        "bolster.vertical.0.amplitude",
        "bolster.vertical.0.frequency",
        "bolster.vertical.0.phase",
        "bolster.vertical.1.amplitude",
        "bolster.vertical.1.start",
        "bolster.vertical.1.duration",
        "bolster.vertical.1.profile",
        "bolster.vertical.2",
        "bolster.yaw.points.1.1",
        "bolster.yaw.points.3.1",
    ] {
        find(path);
    }
    let Input::Number(number) = &find("bolster.vertical.1.amplitude").input else {
        panic!()
    };
    assert_eq!(number.in_us, None);
    let si = number.in_si.as_ref().unwrap();
    assert_eq!(
        (si.text.as_str(), si.unit.as_str(), si.value),
        ("0.0127 m", "m", 0.0127)
    );
    assert!((si.high - 0.0254).abs() < 1e-15 && (si.low + 0.0254).abs() < 1e-15);
    let Input::Toml { us, si } = &find("bolster.vertical").input else {
        panic!()
    };
    assert_eq!(*us, None);
    assert!(
        si.as_ref()
            .unwrap()
            .contains("amplitude = \"0.0254 m\", frequency = \"2 rad/s\""),
        "{si:?}"
    );
    let Input::Number(angle) = &find("wedge.angle").input else {
        panic!()
    };
    assert_eq!((&angle.in_us, &angle.in_si), (&None, &None), "degrees serve both");
    // As they say, typed in the other units: the same case in SI.
    let all: Vec<String> = overrides
        .iter()
        .map(|text| (*text).to_owned())
        .chain(fields.iter().filter_map(|field| {
            let Input::Number(number) = &field.input else {
                return None;
            };
            let other = number.in_si.as_ref()?;
            let word = number
                .signs
                .filter(|_| number.value != 0.0)
                .map_or("", |signs| signs[usize::from(number.value > 0.0)]);
            Some(format!("{}={} {word}", field.path, other.text))
        }))
        .collect();
    let again = builtin::case_with("vdrun_toe_0_psi_0", &all).unwrap();
    let near = |a: f64, b: f64| (a - b).abs() <= 2.3e-16 * b.abs();
    assert!(near(again.parameters.wedge.height, case.parameters.wedge.height));
    assert!(near(
        again.parameters.coil.free_length,
        case.parameters.coil.free_length
    ));
    assert!(near(again.parameters.wedge.mass, case.parameters.wedge.mass));
}
