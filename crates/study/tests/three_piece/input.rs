//! Bad input: every message says what was found and expected, and helps.
#![allow(clippy::unwrap_used)]

use crate::problems::in_words;
use study::case::{Case, Tables};
use study::models::AnyCase;
use study::run::Run;
use study::truck::{TruckCase, builtin};

/// Returns the messages of a case with `model = "truck"` and these lines, with their help.
fn refused(lines: &str) -> String {
    let text = format!("model = \"truck\"\n{lines}");
    let error = TruckCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap_err();
    in_words(error.problems())
}

#[test]
fn input_messages_say_what_is_wrong_and_what_to_write() {
    for (lines, parts) in [
        (
            "[wedge.leading_lft]\nangle = \"30 deg\"",
            &["there is no key `leading_lft` in `wedge`", "leading_left"][..],
        ),
        (
            "[truck]\ndamping = \"both\"",
            &["`truck.damping` cannot be \"both\"", "variable"],
        ),
        (
            "[wedge]\ndamping = \"constant\"",
            &["no key `damping` in `wedge`"],
        ),
        (
            "[wedge]\nangle = \"95 deg\"",
            &["`wedge.angle` is 95 deg", "between 0 deg and 90 deg"],
        ),
        (
            "[gib]\nclearance = \"-0.1 in\"",
            &["`gib.clearance` is -0.1 in", "zero or greater"],
        ),
        (
            "[gib]\nclearance = \"0.1 lbf\"",
            &["this is a force", "a length is expected"],
        ),
        (
            "[bolster]\nweight = \"0 lbf\"",
            &["`bolster.weight`", "greater than zero"],
        ),
        (
            "[wedge]\nfree_coordinates = []",
            &["`wedge.free_coordinates` is empty", "the wedge could not move"],
        ),
        (
            "[control_coil]\nfree_length = \"10 in\"",
            &[
                "`control_coil.free_length` is a key of the coil of kind \"thesis\"",
                "leave it out",
            ],
        ),
        (
            "[side_frame]\nyaw = \"0.01 rad\"",
            &[
                "`side_frame.yaw` moves a body that has free coordinates",
                "free_coordinates = []",
            ],
        ),
        (
            "[adapter]\nkind = \"nothing\"",
            &["has nothing to stand on", "free_coordinates = []"],
        ),
        (
            "[center_plate]\nfriction = 0.3",
            &["[center_plate] has no effect", "load.kind = \"car_body\""],
        ),
        (
            "[start]\nlift = \"1 in\"",
            &["`start.lift` raises a free bolster", "half_car"],
        ),
        (
            "[start]\nkind = \"rest\"\n[simulation]\nstart = \"rest\"",
            &["`simulation.start` and `start.kind` say the same"],
        ),
        (
            "[load_springs]\nnest = \"single_coils\"\nmissing_left = [\"inner_leading_middle\"]",
            &["this nest has no coil"],
        ),
        (
            "[load_springs]\nsolid_travel = \"0 in\"",
            &["`load_springs.solid_travel` is 0 in", "greater than zero"],
        ),
        ("bolster = 3", &["`bolster` is a number", "[bolster]"]),
        (
            "[wedge]\nkind = \"weightless\"",
            &["`wedge.kind` cannot be \"weightless\"", "massless"],
        ),
        (
            "[wedge]\nkind = \"massless\"\n[side_frame]\nfree_coordinates = []\n[adapter]\n\
             kind = \"nothing\"",
            &["nothing can move", "no wedge has mass", "drive the wheelsets"],
        ),
        (
            "[wedge]\nslope_across = \"40 deg\"",
            &[
                "`wedge.slope_across` is 40.0000 deg",
                "runs out to an edge at 31.7 deg",
                "narrower",
            ],
        ),
        (
            "[wedge.trailing_left]\nwidth = \"20 in\"\nslope_across = \"-20 deg\"",
            &[
                "`wedge.trailing_left.slope_across` is -20.0000 deg",
                "an edge at 18.0 deg",
            ],
        ),
        ("[wedge]\nslope_across = \"8\"", &["`wedge.slope_across`", "unit"]),
        (
            "[wedge]\nslope_across = \"8 lbf\"",
            &["this is a force", "an angle is expected"],
        ),
        (
            "[wedge]\nslope_acros = \"8 deg\"",
            &["no key `slope_acros` in `wedge`", "did you mean `slope_across`?"],
        ),
        (
            "[wedge]\nkind = \"massless\"\nslope_across = \"8 deg\"",
            &["`wedge.slope_across` is of no effect", "massless wedge", "body"],
        ),
        (
            "[wedge]\nkind = \"splitt\"",
            &["`wedge.kind` cannot be \"splitt\"", "split"],
        ),
        (
            "[split]\nangle = \"5 deg\"",
            &[
                "`split` is of no effect: this wedge has no halves",
                "wedge.kind = \"split\"",
            ],
        ),
        (
            "[wedge.leading_left.split]\ngap = \"0.1 in\"",
            &[
                "`wedge.leading_left.split` is of no effect",
                "wedge.leading_left.kind = \"split\"",
            ],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\nangel = \"5 deg\"",
            &["no key `angel` in `split`", "did you mean `angle`?"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\nangle = \"60 deg\"",
            &["`split.angle` is 60.0000 deg", "an edge at 59.7 deg"],
        ),
        (
            "[wedge]\nkind = \"split\"\nslope_across = \"-40 deg\"\n[split]\nangle = \"45 deg\"",
            &["presses together", "climb on such a plane"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\ngap = \"-0.1 in\"",
            &["`split.gap` is -0.1 in", "zero or greater"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\nfriction = 20",
            &["`split.friction` is 20", "between 0 and 10"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\noutboard_share = 1.0",
            &["`split.outboard_share` is 1", "between 0 and 1, both excluded"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\ncoil_distance = \"6 in\"",
            &["`split.coil_distance` is more than half of the wedge's width"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[split]\ncoil_distance = \"6 lbf\"",
            &["this is a force", "a length is expected"],
        ),
        (
            "[wedge]\nkind = \"split\"\ninertia = \"0.259 lbf in s^2\"",
            &["`wedge.inertia`"],
        ),
        (
            "[wedge]\nkind = \"split\"\ninertia = [\"0.259 lbf in s^2\", \"0.259 lbf in s^2\", \
             \"0.259 lbf in s^2\"]",
            &["`wedge.inertia` is too small for two halves", "squared over 16"],
        ),
        (
            "[wedge]\nkind = \"split\"\n[control_coil]\nkind = \"thesis\"",
            &["a split wedge cannot stand on the thesis's coil", "shear"],
        ),
        (
            "[wedge.leading_left]\nkind = \"split\"\n[wedge.leading_left.control_coil]\nkind = \"thesis\"",
            &["a split wedge cannot stand on the thesis's coil"],
        ),
        (
            "[bolster.load]\nvertical = \"10 lbf\"",
            &[
                "`bolster.load.vertical` loads a coordinate that is not free",
                "add \"z\" to bolster.free_coordinates",
            ],
        ),
        (
            "[left_side_frame.load]\nroll = \"10 lbf\"",
            &["this is a force", "moment"],
        ),
        (
            "[side_frame.load]\nupwards = \"10 lbf\"",
            &["no key `upwards` in `side_frame.load`"],
        ),
        (
            "[warp_spring]\nkind = \"worn\"\nmoment = \"0 lbf in\"",
            &["`warp_spring.moment` is 0 lbf in", "greater than zero"],
        ),
        (
            "[simulation]\noutput_interval = \"20 s\"",
            &["is longer than the duration"],
        ),
        (
            "[friction]\nlaw = \"coulomb\"",
            &["`friction.law` cannot be \"coulomb\""],
        ),
        (
            "[load]\nkind = \"car_body\"\n[side_bearing]\nkind = \"constant_contact\"\n\
             preload = \"90000 lbf\"",
            &["more than the body's weight"],
        ),
    ] {
        let message = refused(lines);
        for part in parts {
            assert!(message.contains(part), "{lines}\n{message}\ndoes not say {part}");
        }
    }
}

#[test]
fn input_each_model_says_so_when_the_other_is_meant() {
    let wedge =
        TruckCase::parse("w.toml", "[wedge]\nangle = \"30 deg\"", Tables::nowhere(), &[]).unwrap_err();
    assert!(wedge.to_string().contains("single wedge"), "{wedge}");
    let truck = Case::parse("t.toml", "model = \"truck\"", Tables::nowhere(), &[]).unwrap_err();
    assert!(truck.to_string().contains("truck"), "{truck}");
    let any = AnyCase::parse("t.toml", "model = \"truck\"", Tables::nowhere(), &[]).unwrap();
    assert!(matches!(any, AnyCase::Truck(_)));
    let any = AnyCase::parse("t.toml", "model = \"wedge\"", Tables::nowhere(), &[]).unwrap();
    assert!(matches!(any, AnyCase::Wedge(_)));
}

/// Keys that a single wedge has no use for are told apart from mistyped ones.
#[test]
fn input_a_single_wedge_is_not_of_the_kinds_of_trucks() {
    for (line, parts) in [
        (
            "kind = \"split\"",
            ["`wedge.kind` is a key of trucks and cars", "one rigid body"],
        ),
        (
            "kind = \"massless\"",
            ["`wedge.kind` is a key of trucks and cars", "quasi-static"],
        ),
        (
            "slope_across = \"8 deg\"",
            [
                "`wedge.slope_across` is a key of trucks and cars",
                "side of its pocket",
            ],
        ),
    ] {
        let text = match line.strip_prefix("split") {
            Some(_) => line.to_owned(),
            None => format!("[wedge]\n{line}"),
        };
        let error = Case::parse("w.toml", &text, Tables::nowhere(), &[]).unwrap_err();
        assert_eq!(error.problems().len(), 1);
        for part in parts {
            assert!(error.to_string().contains(part), "{error}");
        }
    }
}

/// A case is read with its condition, and what it says itself wins over it.
#[test]
fn input_conditions_are_defaults() {
    let read = |lines: &str| {
        let text = format!("model = \"truck\"\n{lines}");
        TruckCase::parse("case.toml", &text, Tables::nowhere(), &[])
            .unwrap()
            .parameters
    };
    let worn = read("[truck]\ncondition = \"worn\"");
    assert_eq!(worn.wedges[2].column_friction.coefficient, 0.25);
    let mixed = read(
        "[truck]\ncondition = \"worn\"\n[friction]\nslope = 0.3\n[wedge.trailing_left]\ntoe = \"0.5 deg in\"",
    );
    assert_eq!(mixed.wedges[2].slope_friction.coefficient, 0.3);
    assert!((mixed.wedges[2].toe.to_degrees() + 0.5).abs() < 1e-12);
    assert_eq!(mixed.wedges[0].toe, 0.0);
}

/// Preloads that do not carry the load are told by how much; a motion that tears the truck apart stops the
/// run.
#[test]
fn input_what_only_a_run_can_tell() {
    let set = [
        "load_springs.preload=10000 lbf",
        "start.lift=0 in",
        "simulation.duration=0.1 s",
    ]
    .map(str::to_owned);
    let light = builtin::case_with("truck_drop_constant", &set).unwrap();
    let result = Run::new(&light).unwrap().finish(|_| ());
    let warnings = result.summary.warnings.concat();
    assert!(
        warnings.contains("lbf less than stands on them") && warnings.contains("sinks by about"),
        "{warnings}"
    );
    let set = [
        "side_frame.longitudinal={ shape = \"ramp\", amplitude = \"60 in\", duration = \"1 s\" }".to_owned(),
        "wheelset.longitudinal=0 in".to_owned(),
    ];
    let torn = builtin::case_with("truck_warp_nest_constant_rising", &set).unwrap();
    let result = Run::new(&torn).unwrap().finish(|_| ());
    let stopped = result.summary.stopped.unwrap();
    assert!(
        stopped.reason.contains("taken for a truck torn apart") && stopped.reason.contains("lbf"),
        "{}",
        stopped.reason
    );
    assert!(stopped.time > 0.0 && !result.values[0].is_empty());
}

/// A stop tears the truck apart as a face does, also between two bodies that are prescribed; the run is kept
/// until then.
#[test]
fn input_a_gib_that_is_pressed_too_hard_stops_the_run() {
    let set = [
        "bolster.lateral={ shape = \"ramp\", amplitude = \"2 in\", duration = \"1 s\" }".to_owned(),
        "simulation.duration=2 s".to_owned(),
    ];
    let torn = builtin::case_with("truck_warp_nest_constant_rising", &set).unwrap();
    let result = Run::new(&torn).unwrap().finish(|_| ());
    let stopped = result.summary.stopped.unwrap();
    assert!(
        stopped.reason.contains("_gib`") && stopped.reason.contains("5.0e6 lbf"),
        "{}",
        stopped.reason
    );
    assert!(stopped.time > 0.0 && !result.values[0].is_empty());
}

/// Parts that start closed, loose or too low are reported; sound rigs are not warned about.
#[test]
fn input_what_is_doubtful_at_the_start_is_reported() {
    let warnings = |name: &str, set: &[&str]| {
        let mut set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
        set.push("simulation.duration=0.02 s".to_owned());
        let case = builtin::case_with(name, &set).unwrap();
        Run::new(&case).unwrap().finish(|_| ()).summary.warnings.concat()
    };
    let vertical = "truck_vertical_variable";
    for (name, set, expected) in [
        (vertical, &["lands.clearance=0 in"][..], "closed at the start"),
        (vertical, &["bolster.lateral=0.6 in"], "left_gib (0.100 in)"),
        (
            vertical,
            &["wedge.leading_left.control_coil.preload=0 lbf"],
            "no coil presses the wedges leading_left in",
        ),
        (
            vertical,
            &["wedge.trailing_right.control_coil.kind=nothing"],
            "no coil presses the wedges trailing_right in",
        ),
        (
            "truck_drop_variable",
            &["load_springs.preload=1000 lbf"],
            "where its load coils are solid",
        ),
    ] {
        let found = warnings(name, set);
        assert!(found.contains(expected), "{set:?}: {found}");
    }
    for name in [
        "truck_lateral_variable_empty",
        "truck_drop_variable_empty",
        "truck_solid_constant",
    ] {
        assert_eq!(warnings(name, &[]), "", "{name}");
    }
}
