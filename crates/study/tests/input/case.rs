//! Cases: the thesis's values, round trips, and every motion.

use mechanics::coil::{CoilLaw, CoilLine};
use mechanics::friction::FrictionLaw;
use mechanics::motion::{Motion, RampProfile};
use quantity::System;
use std::f64::consts::PI;
use std::path::Path;
use study::case::{Case, builtin};
use wedge::parameters::Damping;
use wedge::parameters::{Parameters, Start};

const LBF: f64 = 4.4482216152605;
const INCH: f64 = 0.0254;

fn parse(text: &str) -> Case {
    Case::parse("case.toml", text, Path::new(""), &[]).unwrap()
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * b.abs(), "{a} is not {b}");
}

#[test]
fn an_empty_case_is_the_thesis_with_variable_damping() {
    let case = parse("");
    assert_eq!(case.name, "case");
    let p = &case.parameters;
    close(p.wedge.angle, 32.0 * PI / 180.0);
    close(p.wedge.height, 6.125 * INCH);
    close(p.wedge.width, 10.5 * INCH);
    close(p.wedge.mass, 50.0 * 0.45359237);
    close(p.wedge.inertia[2], 100.0 * 0.45359237 * INCH * INCH);
    close(p.wedge.center_of_gravity[0], -1.0734 * INCH);
    assert_eq!(p.wedge.free, [true, false, true, false, true, true]);
    let CoilLaw::Linear { stiffness } = p.coil.law else {
        panic!()
    };
    close(stiffness, 3000.0 * LBF / INCH);
    close(p.coil.nominal_length, 10.25 * INCH);
    close(p.coil.damping, LBF / INCH);
    close(p.coil.rotational_damping, LBF * INCH);
    assert_eq!(p.coil.acts_at, CoilLine::CenterOfGravity);
    assert!(p.coil.pulls);
    close(p.contact.stiffness, 2.5e5 * LBF / INCH);
    assert_eq!(p.contact.damping, 0.0);
    assert_eq!(p.column_friction.coefficient, 0.4);
    assert_eq!(
        p.column_friction.law,
        FrictionLaw::Tanh {
            reference_speed: 0.001 * INCH
        }
    );
    assert_eq!(p.toe, 0.0);
    assert_eq!(p.gravity, 9.80665);
    assert_eq!(p.start, Start::Rest);
    let sine = Motion::Sine {
        amplitude: INCH,
        angular_frequency: 2.0,
        phase: 0.0,
    };
    assert_eq!(p.bolster.coordinates[2], sine);
    let s = &case.simulation;
    assert_eq!(
        (s.duration, s.output_interval, s.relative_tolerance),
        (10.0, 0.01, 1e-6)
    );
    assert_eq!(
        (s.output_units, s.method),
        (System::Us, integrate::Method::default())
    );
}

#[test]
fn constant_damping_has_its_own_values() {
    let p = parse("[wedge]\ndamping = \"constant\"\n").parameters;
    close(p.wedge.angle, 37.5 * PI / 180.0);
    let CoilLaw::Linear { stiffness } = p.coil.law else {
        panic!()
    };
    close(
        stiffness * (p.coil.free_length - p.coil.nominal_length),
        3702.2 * LBF,
    );
}

#[test]
fn built_in_cases_are_the_defaults_with_toe_and_yaw() {
    assert_eq!(builtin::thesis_names().len(), 12);
    for name in builtin::thesis_names() {
        let case = builtin::case(name).unwrap();
        assert_eq!(case.name, name);
        let damping = if name.starts_with("vd") {
            Damping::Variable
        } else {
            Damping::Constant
        };
        assert_eq!(case.parameters.damping, damping);
        let mut parameters = parse(&format!("[wedge]\ndamping = \"{}\"\n", damping.name())).parameters;
        // Toe out is positive inside.
        parameters.toe = match name.split('_').nth(2).unwrap() {
            "out" => 0.2 * (PI / 180.0),
            "in" => -0.2 * (PI / 180.0),
            _ => 0.0,
        };
        let yaw = if name.ends_with("0.012") { 0.012 } else { 0.0 };
        parameters.bolster.coordinates[5] = Motion::Constant(yaw);
        assert_eq!(case.parameters, parameters, "{name}");
    }
}

#[test]
fn the_groups_of_built_in_cases() {
    let names: Vec<&str> = builtin::names().collect();
    let mut once = names.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), names.len(), "names are given once");
    let groups: Vec<&str> = builtin::groups().iter().map(|group| group.name).collect();
    assert_eq!(
        groups,
        [
            "thesis",
            "warp",
            "rig",
            "sweep",
            "twist_and_roll",
            "yaw_and_sway",
            "load",
            "wear",
            "lock_up",
            "overturned_toe"
        ]
    );
    assert_eq!(builtin::group("sweep").unwrap().cases.len(), 2 * 3 * 3);
    assert_eq!(builtin::group("wear").unwrap().cases.len(), 2 * 4);
    assert!(builtin::group("nothing").is_none() && builtin::group_of("nothing").is_none());
    for group in builtin::groups() {
        // Two sentences: what to look at.
        let sentences = group.look_at.split_inclusive(". ").count();
        assert!(
            group.look_at.ends_with('.') && sentences == 2,
            "{}: {}",
            group.name,
            group.look_at
        );
        for built_in in &group.cases {
            assert_eq!(builtin::group_of(&built_in.name).unwrap().name, group.name);
            let case = builtin::case(&built_in.name).unwrap();
            assert_eq!((&case.name, &case.title), (&built_in.name, &built_in.title));
            // Results of all cases can stand side by side, and on every system.
            assert_eq!(case.simulation.output_units, System::Us);
            assert_eq!(case.name, case.name.to_lowercase());
        }
    }
    let (_, title) = builtin::list().find(|(name, _)| *name == "rig_constant").unwrap();
    assert_eq!(title, builtin::case("rig_constant").unwrap().title);
}

#[test]
fn wear_is_read() {
    let case = parse("[wedge]\ncolumn_wear = \"0.1 in\"\nslope_wear = \"5 mm\"\n");
    close(case.parameters.wear.column, 0.1 * INCH);
    close(case.parameters.wear.slope, 0.005);
    round_trip(&case);
}

/// Every number in the parameters, in the order of their fields.
fn numbers(parameters: &Parameters) -> Vec<f64> {
    let text = format!("{parameters:?}");
    text.split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c)))
        .filter_map(|n| n.parse().ok())
        .collect()
}

#[test]
fn the_wedge_crate_knows_the_same_thesis() {
    for (name, damping) in [
        (
            "vdrun_toe_out_0.2_psi_0.012",
            wedge::parameters::Damping::Variable,
        ),
        (
            "cdrun_toe_out_0.2_psi_0.012",
            wedge::parameters::Damping::Constant,
        ),
    ] {
        let ours = builtin::case(name).unwrap().parameters;
        let theirs = wedge::thesis::parameters(damping, 0.2 * PI / 180.0, 0.012);
        let (ours, theirs) = (numbers(&ours), numbers(&theirs));
        assert!(ours.len() > 25, "{}", ours.len());
        assert_eq!(ours.len(), theirs.len());
        for (a, b) in ours.into_iter().zip(theirs) {
            close(a, b);
        }
    }
}

/// Prints a case, reads it back, and compares to the last bit.
fn round_trip(case: &Case) {
    let text = case.to_toml();
    let again = Case::parse("again.toml", text, Path::new(""), &[]).unwrap_or_else(|error| {
        panic!("{:#?}\n{text}", error.problems());
    });
    assert_eq!(again, *case, "{text}");
    // Debug prints floats so that they read back, and tells -0 from 0.
    assert_eq!(
        format!("{:?}", again.parameters),
        format!("{:?}", case.parameters)
    );
    assert_eq!(again.to_toml(), text);
}

#[test]
fn printed_built_in_cases_read_back_to_the_same_bits() {
    for name in builtin::names() {
        round_trip(&builtin::case(name).unwrap());
    }
}

#[test]
fn a_printed_case_has_every_key_and_comments() {
    let case = builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap();
    let text = case.to_toml();
    for piece in [
        "damping = \"constant\"",
        "toe = \"0.2 deg out\"",
        "yaw = \"0.012 rad\"",
        "nominal_length = \"5.379257200606367 in\"",
        "a preload of 3702.2 lbf",
        "rotational_damping = \"1 lbf s in\"",
        "bristle_stiffness",
        "gravity",
        "method",
        "pulls = true",
    ] {
        assert!(text.contains(piece), "{piece} is not in\n{text}");
    }
}

#[test]
fn a_case_of_everything_reads_back() {
    let case = parse(
        r#"
        name = "every thing"
        title = "with \"quotes\", a \\ and\na second line"
        [wedge]
        free_coordinates = ["yaw", "x"]
        angle = "558.505 mrad"
        [control_coil]
        table = [["0 in", "0 lbf"], ["1 in", "3 kip"], ["30 mm", "20 kN"]]
        damping = "175.126835 N s/m"
        acts_at = "seat"
        pulls = false
        [friction]
        law = { column = "bristle", slope = "tanh" }
        column = 0
        [side_frame]
        toe = " 0.1 deg  in "
        center = ["1 in", "2 in", "3 mm"]
        vertical.shape = "swept_sine"
        vertical.amplitude = "1 mm"
        vertical.start_frequency = "0 Hz"
        vertical.end_frequency = "600 rpm"
        vertical.duration = "4 s"
        [bolster]
        longitudinal = { shape = "triangle", amplitude = "0.1 in", frequency = "1 Hz" }
        vertical = [
            { shape = "sine", amplitude = "1 in", frequency = "2 rad/s", phase = "90 deg" },
            { shape = "constant", value = "-1 in" },
            { shape = "table", points = [
                ["-1 s", "0 in"], ["1 s", "1 in"], ["3 s", "-1 mm"], ["30 s", "0 in"],
            ] },
            "0.5 in",
        ]
        yaw.shape = "ramp"
        yaw.amplitude = "12 mrad"
        yaw.start = "1 s"
        yaw.duration = "500 ms"
        yaw.profile = "linear"
        roll = { shape = "ramp", amplitude = "1 deg", duration = "1 s" }
        [environment]
        gravity = "0 m/s^2"
        [simulation]
        start = "touching"
        output_units = "si"
        method = "rodas5p"
        "#,
    );
    round_trip(&case);
    let p = &case.parameters;
    assert!(matches!(&p.coil.law, CoilLaw::Table(table) if table.points().len() == 3));
    close(p.toe, -0.1 * PI / 180.0);
    assert!((p.coil.rotational_damping - LBF * INCH).abs() < 1e-7);
    assert!(matches!(p.column_friction.law, FrictionLaw::Bristle { .. }));
    assert!(matches!(p.slope_friction.law, FrictionLaw::Tanh { .. }));
    assert_eq!(p.side_frame.center, Some([INCH, 2.0 * INCH, 0.003]));
    let Motion::Ramp {
        profile, duration, ..
    } = &p.bolster.coordinates[5]
    else {
        panic!()
    };
    assert_eq!((*profile, *duration), (RampProfile::Linear, 0.5));
    let Motion::Ramp { profile, start, .. } = &p.bolster.coordinates[3] else {
        panic!()
    };
    assert_eq!((*profile, *start), (RampProfile::Smooth, 0.0));
    let Motion::SweptSine { start, end, .. } = &p.side_frame.coordinates[2] else {
        panic!()
    };
    assert_eq!(*start, 0.0);
    close(*end, 20.0 * PI);
    let Motion::Sum(parts) = &p.bolster.coordinates[2] else {
        panic!()
    };
    assert_eq!(parts.len(), 4);
}

#[test]
fn left_out_keys_of_the_vertical_motion_are_the_thesis_s() {
    let p = parse("[bolster]\nvertical = { amplitude = \"0.5 in\" }\n").parameters;
    let sine = Motion::Sine {
        amplitude: 0.5 * INCH,
        angular_frequency: 2.0,
        phase: 0.0,
    };
    assert_eq!(p.bolster.coordinates[2], sine);
}

#[test]
fn the_rotational_damping_follows_the_damping() {
    let case = parse("[control_coil]\ndamping = \"2.5 lbf s/in\"\n");
    assert!(case.to_toml().contains("rotational_damping = \"2.5 lbf s in\""));
    close(case.parameters.coil.rotational_damping, 2.5 * LBF * INCH);
}

mod random {
    use super::*;
    use proptest::prelude::*;

    fn quantity(low: f64, high: f64, units: &'static [&'static str]) -> impl Strategy<Value = String> {
        (low..high, 0..units.len()).prop_map(move |(value, unit)| format!("\"{value} {}\"", units[unit]))
    }

    const LENGTHS: &[&str] = &["in", "mm", "ft"];

    fn motion(units: &'static [&'static str]) -> impl Strategy<Value = String> {
        let single = prop_oneof![
            quantity(-2.0, 2.0, units),
            (
                quantity(-2.0, 2.0, units),
                quantity(0.1, 50.0, &["Hz", "rad/s", "rpm"]),
                any::<bool>()
            )
                .prop_map(|(a, f, sine)| {
                    let shape = if sine { "sine" } else { "triangle" };
                    format!("{{ shape = \"{shape}\", amplitude = {a}, frequency = {f} }}")
                }),
            (
                quantity(-2.0, 2.0, units),
                quantity(0.1, 5.0, &["s", "ms", "min"])
            )
                .prop_map(|(a, d)| format!(
                    "{{ shape = \"ramp\", amplitude = {a}, duration = {d}, start = \"0.25 s\" }}"
                )),
            prop::collection::vec(quantity(-2.0, 2.0, units), 4..9).prop_map(|values| {
                let rows: Vec<String> = values
                    .iter()
                    .enumerate()
                    .map(|(i, v)| format!("[\"{} s\", {v}]", i * 10))
                    .collect();
                format!("{{ shape = \"table\", points = [{}] }}", rows.join(", "))
            }),
        ];
        prop::collection::vec(single, 1..4).prop_map(|mut parts| {
            if parts.len() == 1 {
                parts.remove(0)
            } else {
                format!("[{}]", parts.join(", "))
            }
        })
    }

    prop_compose! {
        fn case()(
            damping in prop_oneof![Just("variable"), Just("constant")],
            angle in quantity(1.0, 89.0, &["deg", "°"]),
            weight in quantity(0.1, 1e3, &["lbf", "N", "kip"]),
            height in quantity(0.1, 20.0, LENGTHS),
            stiffness in quantity(1.0, 1e7, &["lbf/in", "N/mm", "kN/m", "lbf/ft"]),
            coil_damping in quantity(0.0, 1e3, &["lbf s/in", "N s/m", "kN s/m"]),
            friction in (0.0..2.0f64, 0.0..2.0f64),
            toe in (0.0..20.0f64, any::<bool>()),
            vertical in motion(LENGTHS),
            yaw in motion(&["deg", "rad", "mrad"]),
            duration in quantity(1.0, 29.0, &["s"]),
            tolerance in 1e-12..0.99f64,
            free in prop::sample::subsequence(vec!["x", "y", "z", "roll", "pitch", "yaw"], 1..=6),
        ) -> String {
            let direction = if toe.1 { "in" } else { "out" };
            format!(
                "[wedge]\ndamping = \"{damping}\"\nangle = {angle}\nweight = {weight}\nheight = {height}\n\
                 free_coordinates = {free:?}\n[control_coil]\nstiffness = {stiffness}\n\
                 damping = {coil_damping}\n[friction]\ncolumn = {}\nslope = {}\n[side_frame]\n\
                 toe = \"{} deg {direction}\"\n[bolster]\nvertical = {vertical}\nyaw = {yaw}\n\
                 [simulation]\nduration = {duration}\nrelative_tolerance = {tolerance}\n",
                friction.0, friction.1, toe.0
            )
        }
    }

    proptest! {
        #[test]
        fn valid_cases_read_back_to_the_same_bits(text in case()) {
            let case = parse(&text);
            round_trip(&case);
            let lighter = ["wedge.weight=-1 lbf".to_owned()];
            prop_assert!(Case::parse("case.toml", case.to_toml(), Path::new(""), &lighter).is_err());
        }

        #[test]
        fn no_text_breaks_the_reader(text in "(\\[wedge\\]|bolster|angle| |=|\"32 deg\"|\\{|\\}|\n\
                                              |[ -~]){0,30}") {
            let _ = Case::parse("case.toml", &text, Path::new(""), &[]);
        }

        #[test]
        fn no_override_breaks_the_reader(text in "(wedge|bolster|angle|yaw|\\.|=|\"32 deg\"|\\{|\\}|[ \
            -~]){0,12}") {
            let _ = Case::parse("case.toml", "", Path::new(""), &[text]);
        }
    }
}
