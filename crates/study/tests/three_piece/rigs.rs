//! The rigs: energy ledgers, symmetry, and what is known of each.
#![allow(clippy::unwrap_used)]

use study::run::Run;
use study::truck::loop_curve::{LoopCurve, LoopKind};
use study::truck::warp::WarpCurve;
use study::truck::{WEDGE_NAMES, builtin};

use super::common::{INCH, KIP_INCH, POUND_FORCE, at, case, column, run};

/// The energy ledger of every built-in truck over its first seconds closes below 1e-5, and no run but those
/// at extreme loads has anything to warn of but contacts that are pressed in where a nest locks.
#[test]
fn energy_of_every_rig_is_accounted_for() {
    assert_eq!(builtin::names().count(), 62);
    let extreme = |name: &str| {
        let mut groups = builtin::groups()
            .iter()
            .filter(|group| group.name == "truck_extreme");
        groups.any(|group| group.cases.iter().any(|case| case.name == name))
    };
    let is_accounted_for = |name: &str| {
        let duration = if name.contains("warp") || name.contains("lands") {
            4.6
        } else {
            2.0
        };
        let result = run(name, &[&format!("simulation.duration={duration} s")]);
        let residual = result.summary.ledger.largest_relative_residual;
        assert!(residual < 1e-5, "{name}: residual {residual}");
        for warning in &result.summary.warnings {
            assert!(
                extreme(name) || warning.contains("penetrates its surface too deep"),
                "{name}: {warning}"
            );
        }
    };
    std::thread::scope(|scope| {
        for half in [0, 1] {
            let own = builtin::names().skip(half).step_by(2);
            scope.spawn(move || own.for_each(is_accounted_for));
        }
    });
}

/// Bolster, side frames and wheelsets are prescribed in every coordinate, one side frame beside a free one
/// too.
#[test]
fn energy_of_prescribed_motions_in_every_coordinate_is_accounted_for() {
    for key in ["longitudinal", "lateral", "vertical", "roll", "pitch", "yaw"] {
        let amplitude = match key {
            "roll" | "pitch" | "yaw" => "0.001 rad",
            _ => "0.01 in",
        };
        for body in ["bolster", "side_frame", "left_side_frame", "trailing_wheelset"] {
            let motion = format!(
                "{body}.{key}={{ shape = \"sine\", amplitude = \"{amplitude}\", frequency = \"2 Hz\" }}"
            );
            let held = format!("{body}.free_coordinates=[]");
            let mut set = vec!["bolster.vertical=0 in", "simulation.duration=0.2 s", &motion];
            if body.ends_with("side_frame") {
                set.push(&held);
            }
            let result = run("truck_vertical_variable", &set);
            let residual = result.summary.ledger.largest_relative_residual;
            assert!(residual < 1e-5, "{body}.{key}: residual {residual}");
            let work = result.summary.ledger.entries["motion_work"].value;
            assert!(work != 0.0, "{body}.{key} does nothing");
        }
    }
}

/// The parts of the warp moment add up to it at every angle that is told, with wedges that have mass and
/// without.
#[test]
fn analytic_parts_of_the_warp_moment_add_up() {
    for set in [
        &[][..],
        &["wedge.trailing_left.kind=massless", "warp_spring.kind=worn"],
    ] {
        let set = [&["simulation.duration=4.6 s"], set].concat();
        let name = "truck_warp_nest_variable_rising";
        let curve = WarpCurve::of(&case(name, &set), &run(name, &set)).unwrap();
        assert_eq!(curve.stiffness.len(), 6);
        for ((angle, stiffness), parts) in curve.stiffness.iter().zip(&curve.parts) {
            let (moment, sum) = (angle * stiffness, parts.iter().sum::<f64>());
            assert!(
                (moment - sum).abs() < 1e-9 * moment,
                "{angle} rad: {sum} of {moment} N·m"
            );
        }
    }
}

/// A vertical motion is symmetric: left and right, leading and trailing wedges carry the same.
#[test]
fn limits_a_symmetric_rig_has_symmetric_loads() {
    let result = run("truck_vertical_variable", &["simulation.duration=4 s"]);
    let [left, right] = ["left", "right"].map(|side| column(&result, &format!("{side}_nest_vertical_force")));
    let largest = left.iter().fold(0.0, |most: f64, load| most.max(load.abs()));
    for (left, right) in left.iter().zip(right) {
        assert!((left - right).abs() < 1e-6 * largest);
    }
    for face in ["column", "slope"] {
        let [first, others @ ..] =
            WEDGE_NAMES.map(|wedge| column(&result, &format!("{wedge}_{face}_normal")));
        for other in others {
            for (first, other) in first.iter().zip(other) {
                assert!((first - other).abs() < 1e-6 * largest);
            }
        }
    }
    assert!(
        column(&result, "warp_angle")
            .iter()
            .all(|angle| angle.abs() < 1e-9)
    );
}

/// Constant damping without toe: the slope sticks, the wedges go with the bolster, and the columns keep the
/// normal force that the start locked in: about 3,400 lbf with 25 lbf·s/in a corner.
#[test]
fn reproduction_the_start_locks_in_the_normal_force_with_constant_damping() {
    let result = run("truck_vertical_constant", &["simulation.duration=4 s"]);
    for time in [1.0, 2.0, 3.0, 4.0] {
        let normal = at(&result, "leading_left_column_normal", time) / POUND_FORCE;
        assert!((3200.0..3600.0).contains(&normal), "{time} s: {normal} lbf");
    }
}

/// A wedge whose roll is free rolls by ψ cot θ when its side frame yaws by ψ, and stays flush on both faces.
/// Without friction warp meets almost no moment but that of the coils' shear, 0.5006e6 lbf·in/rad a nest.
#[test]
fn analytic_wedges_roll_by_the_yaw_times_the_cotangent_of_the_angle() {
    let set = [
        "friction.column=0",
        "friction.slope=0",
        "simulation.duration=4.5 s",
    ];
    let result = run("truck_warp_nest_constant_rising", &set);
    let warp = at(&result, "warp_angle", 4.5);
    assert!((warp - 0.020).abs() < 1e-9, "{warp}");
    let cotangent = 1.0 / 37.5_f64.to_radians().tan();
    // In truck axes wedges at the leading end lean one way, those at the trailing end the other.
    for (wedge, end) in WEDGE_NAMES.into_iter().zip([1.0, 1.0, -1.0, -1.0]) {
        for (angle, expected) in [("roll", -end * 0.020 * cotangent), ("pitch", 0.0), ("yaw", 0.020)] {
            let found = at(&result, &format!("{wedge}_{angle}"), 4.5);
            assert!((found - expected).abs() < 5e-5, "{wedge} {angle}: {found}");
        }
    }
    let shear = at(&result, "warp_moment_load_coils", 4.5) / 0.020 / (1e3 * KIP_INCH);
    assert!((shear / 1.0012 - 1.0).abs() < 2e-3, "{shear}e6 lbf·in/rad");
}

/// At low friction the warp moment has a plateau, about 225 kip·in; at 0.4 the nest locks: moment and normal
/// force go on growing, to 20 to 30 kip. (Both from a calculation in another program.)
#[test]
fn reproduction_warp_has_a_plateau_when_worn_and_locks_when_new() {
    // Warp moment (kip·in) and largest normal force on a column (lbf) at 10 and at 20 mrad, the first time
    // and on the way to the other side.
    let run_with = |condition: &str| {
        let set = [
            format!("truck.condition={condition}"),
            "simulation.relative_tolerance=1e-5".to_owned(),
        ];
        let result = run(
            "truck_warp_nest_constant_rising",
            &set.each_ref().map(String::as_str),
        );
        [3.25, 4.5, 8.25, 9.5].map(|time| {
            let normals = WEDGE_NAMES.map(|wedge| at(&result, &format!("{wedge}_column_normal"), time));
            let normal = normals.into_iter().fold(0.0, f64::max);
            [at(&result, "warp_moment", time) / KIP_INCH, normal / POUND_FORCE]
        })
    };
    let (worn, new) = (run_with("worn"), run_with("new"));
    for [moment, _] in [worn[1], worn[3]] {
        assert!(
            (moment.abs() / 225.0 - 1.0).abs() < 0.05,
            "plateau at {moment} kip·in"
        );
    }
    let growth = |before: f64, after: f64| after / before - 1.0;
    assert!(growth(worn[0][0], worn[1][0]) < 0.15, "no plateau: {worn:?}");
    assert!(growth(new[0][0], new[1][0]) > 0.5, "no lock-up: {new:?}");
    for [_, normal] in [new[2], new[3]] {
        assert!((20_000.0..30_000.0).contains(&normal), "{new:?}");
    }
}

/// Friction at the adapters adds 0.18 to 0.21e6 lbf·in to the inter-axle shear moment at 20 mrad, beyond the
/// moment that warps the nests.
#[test]
fn reproduction_adapter_friction_adds_to_the_inter_axle_shear_moment() {
    let result = run("truck_warp_axles_constant_rising", &["simulation.duration=4.6 s"]);
    let shear = at(&result, "interaxle_shear_moment", 4.5).abs() / KIP_INCH;
    let warp = at(&result, "warp_moment", 4.5).abs() / KIP_INCH;
    let added = shear - warp;
    assert!(
        (150.0..240.0).contains(&added),
        "{added} kip·in: {shear} less {warp}"
    );
}

/// The limits act: lands take a part of the warp moment, gibs meet, coils go solid, wedges reach the pockets'
/// sides.
#[test]
fn limits_rigs_reach_their_stops() {
    let lands = run("truck_lands_constant", &["simulation.duration=4.6 s"]);
    let [before, after] = [4.0, 4.5].map(|time| at(&lands, "warp_moment_lands", time) / KIP_INCH);
    assert!(
        before.abs() < 1e-9 && after.abs() > 10.0,
        "lands: {before} and {after} kip·in"
    );
    let solid = run("truck_solid_variable", &["simulation.duration=0.5 s"]);
    let lowest = column(&solid, "bolster_z")
        .iter()
        .fold(0.0, |least: f64, z| least.min(*z))
        / INCH;
    assert!(lowest < -1.406, "the bolster falls to {lowest} in only");
    let pocket = run("truck_pocket_sides_constant", &["simulation.duration=2 s"]);
    let apart = column(&pocket, "bolster_y")
        .iter()
        .zip(column(&pocket, "leading_left_y"));
    let most = apart.fold(0.0, |most: f64, (bolster, wedge)| {
        most.max((bolster - wedge).abs())
    });
    assert!(most > 0.25 * INCH, "{} in between pocket and wedge", most / INCH);
}

/// An empty half car stands higher by what coils and adapters are relieved of. With constant damping the
/// wedges' forces are internal to bolster and wedges. With variable damping the control coils carry a share,
/// and the faces, which give by 0.0058 in under the loaded car, give in proportion to the coils' force.
#[test]
fn analytic_an_empty_half_car_rests_at_its_height() {
    let lighter = 123_030.0 - 22_830.0;
    let adapters = lighter / (8.0 * 5e5);
    let variable = lighter / (8.0 * 5369.5 + 4.0 * 1937.0);
    let give = 0.0058 * (1.0 - variable * 1937.0 / 6303.0);
    let heights = [
        ("constant", lighter / (8.0 * 6468.7) + adapters),
        ("variable", variable + adapters - give),
    ];
    for (damping, expected) in heights {
        let set = [
            "start.lift=0 in",
            "start.kind=equilibrium",
            "simulation.duration=0.02 s",
        ];
        let result = run(&format!("truck_drop_{damping}_empty"), &set);
        let z = at(&result, "bolster_z", 0.0) / INCH;
        assert!(
            (z - expected).abs() < 1e-4,
            "{damping}: {z} in, {expected} in expected"
        );
    }
}

/// A worn wedge between a side frame and a bolster that are held sits higher: by (w_c cos θ + w_s)/sin θ,
/// whatever presses it in alike; the others stay where they are.
#[test]
fn analytic_a_worn_wedge_rises() {
    let set = |more: &[&'static str]| -> Vec<&'static str> {
        let common = [
            "start.kind=equilibrium",
            "simulation.duration=0.02 s",
            "side_frame.yaw=0 rad",
        ];
        [&common, more].concat()
    };
    let wear = [
        "wedge.leading_left.column_wear=0.1 in",
        "wedge.leading_left.slope_wear=0.05 in",
    ];
    let [sound, worn] = [&[][..], &wear].map(|more| run("truck_warp_nest_constant_rising", &set(more)));
    let rise = |wedge: &str| {
        let name = format!("{wedge}_z");
        (at(&worn, &name, 0.0) - at(&sound, &name, 0.0)) / INCH
    };
    let angle = 37.5_f64.to_radians();
    let expected = (0.1 * angle.cos() + 0.05) / angle.sin();
    // The coil is longer by that and presses less: a ninth of the contacts' give of some 0.02 in.
    assert!(
        (rise("leading_left") - expected).abs() < 3e-3,
        "{} in, {expected} in",
        rise("leading_left")
    );
    for other in ["leading_right", "trailing_left", "trailing_right"] {
        assert!(rise(other).abs() < 1e-6, "{other}: {} in", rise(other));
    }
}

/// Without friction the loops are lines: coils, control coils and adapters in series; in roll, the coils'
/// levers and their shear about the bolster's center of gravity, less what the side frames give.
#[test]
fn analytic_loops_without_friction_have_the_stiffness_of_the_coils() {
    let curve = |name: &str| {
        let case = case(name, &["friction.column=0", "friction.slope=0"]);
        let result = study::run::Run::new(&case).unwrap().finish(|_| ());
        LoopCurve::of(&case, &result).unwrap()
    };
    let vertical = curve("truck_vertical_constant");
    assert_eq!(vertical.kind, LoopKind::Vertical);
    let (coils, adapters) = (8.0 * 6468.7, 8.0 * 5e5);
    let expected = coils * adapters / (coils + adapters);
    let found = vertical.stiffness * INCH / POUND_FORCE;
    assert!(
        (found / expected - 1.0).abs() < 2e-3,
        "{found}, {expected} lbf/in expected"
    );
    assert!((vertical.amplitude / INCH - 0.5).abs() < 1e-4);
    assert!(vertical.loss_ratio.abs() < 2e-3, "{}", vertical.loss_ratio);
    let roll = curve("truck_roll_constant");
    assert_eq!(roll.kind, LoopKind::Roll);
    let levers = coils * (39.5_f64.powi(2) + 3.75_f64.powi(2));
    let found = roll.stiffness / (INCH * POUND_FORCE);
    // Shear 9 in below the center of gravity adds 8 x 4450 x 81, and side frames on their adapters give.
    let shear = 8.0 * 4450.0 * 81.0;
    assert!(
        (0.95 * levers..levers + shear).contains(&found),
        "{found:e}, {levers:e} lbf in/rad from levers"
    );
}

/// With friction the vertical loop of variable damping has the area that wedges and coils lose in a cycle.
#[test]
fn energy_of_the_loop_is_what_is_lost() {
    let case = case("truck_vertical_variable", &["simulation.output_interval=0.002 s"]);
    let result = study::run::Run::new(&case).unwrap().finish(|_| ());
    let curve = LoopCurve::of(&case, &result).unwrap();
    let lost: f64 = result.summary.cycles.losses.values().map(|loss| loss.value).sum();
    let lost = lost * POUND_FORCE * INCH;
    assert!(
        (curve.energy / lost - 1.0).abs() < 0.02,
        "{} and {lost} J",
        curve.energy
    );
}

/// The rule for runs that hardly progress holds before a run, too.
#[test]
fn limits_a_truck_that_hardly_settles_stops_by_the_rule() {
    let set = [
        "contact.stiffness=5e12 lbf/in",
        "simulation.relative_tolerance=1e-12",
        "start.settle=1 s",
    ];
    let error = Run::new(&case("truck_vertical_constant", &set)).err().unwrap();
    let text = error.to_string();
    for part in [
        "while the truck settles: the run hardly progresses at 0.",
        "150000 are admissible for 0.1 s",
    ] {
        assert!(text.contains(part), "{text}");
    }
}
