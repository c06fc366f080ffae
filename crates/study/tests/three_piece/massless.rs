//! Wedges without mass, empirical warp springs, and loads in place of motions, as cases.
#![allow(clippy::unwrap_used)]

use study::run::{Run, RunState};
use study::truck::run::TruckCounts;

use super::common::{INCH, KIP_INCH, POUND_FORCE, at, case, column, run};

/// Every rig runs with massless wedges, all or one, and its ledger closes. (Where bolster and side frames are
/// prescribed one wedge has mass, so that something can move.)
#[test]
fn energy_of_rigs_with_massless_wedges_is_accounted_for() {
    for name in [
        "truck_vertical_constant_toe_out",
        "truck_vertical_variable",
        "truck_warp_axles_variable_rising",
        "truck_drop_constant",
        "truck_drop_variable_empty",
        "truck_roll_constant",
        "truck_lateral_variable",
    ] {
        let result = run(
            name,
            &["wedge.kind=massless", "simulation.relative_tolerance=1e-6"],
        );
        let residual = result.summary.ledger.largest_relative_residual;
        assert!(residual < 1e-5, "{name}: {residual:e}");
        let one = run(
            name,
            &["wedge.leading_left.kind=massless", "simulation.duration=4 s"],
        );
        let residual = one.summary.ledger.largest_relative_residual;
        assert!(residual < 1e-5, "{name}, one wedge: {residual:e}");
    }
    let set = ["wedge.kind=massless", "wedge.trailing_right.kind=body"];
    let result = run("truck_warp_nest_variable_rising", &set);
    let residual = result.summary.ledger.largest_relative_residual;
    assert!(residual < 1e-5, "{residual:e}");
}

/// The loss of each massless wedge stands under its name, and is the area of its loop: on the column, and on
/// the slope, whose friction toe out makes it rub too.
#[test]
fn energy_of_a_massless_wedge_stands_under_its_name() {
    let result = run("truck_vertical_constant_toe_out", &["wedge.kind=massless"]);
    let losses = &result.summary.cycles.losses;
    for wedge in study::truck::WEDGE_NAMES {
        let column_loss = losses[&format!("{wedge}_wedge_column_loss")].value;
        let slope_loss = losses[&format!("{wedge}_wedge_slope_loss")].value;
        let [z, force] =
            ["bolster_z", &format!("{wedge}_column_friction_z")].map(|name| column(&result, name));
        let (_, side) = wedge.split_once('_').unwrap();
        let seat = column(&result, &format!("{side}_side_frame_z"));
        let z: Vec<f64> = z.iter().zip(seat).map(|(z, seat)| z - seat).collect();
        let rows = (std::f64::consts::PI / 0.01) as usize..(2.0 * std::f64::consts::PI / 0.01) as usize;
        let area: f64 = rows
            .map(|i| 0.5 * (force[i] + force[i + 1]) * (z[i + 1] - z[i]))
            .sum();
        let area = area.abs() / (POUND_FORCE * INCH);
        assert!((column_loss / area - 1.0).abs() < 5e-3, "{column_loss} {area}");
        assert!(
            slope_loss > 0.0 && slope_loss < 0.05 * column_loss,
            "{slope_loss}"
        );
        assert!(
            column(&result, &format!("{wedge}_column_friction_loss"))
                .last()
                .unwrap()
                > &1.0
        );
    }
}

/// NUCARS's worn truck: 105 kip·in of the truck at 30 mrad, besides the shear of the coils; the inter-axle
/// shear moment that turns it has the adapters' friction beside.
#[test]
fn reproduction_an_empirical_warp_spring_has_its_stiffness() {
    let set = ["wedge.kind=massless", "warp_spring.kind=worn"];
    let result = run("truck_warp_axles_constant_rising", &set);
    let (angle, spring) = (
        column(&result, "warp_angle"),
        column(&result, "warp_moment_warp_springs"),
    );
    let most = angle.iter().fold(0.0, |most: f64, angle| most.max(angle.abs()));
    assert!(most > 0.015, "{most}");
    for (angle, spring) in angle.iter().zip(spring) {
        let expected = 3.5 * KIP_INCH * angle / 1e-3;
        assert!((spring - expected).abs() < 1e-4 * KIP_INCH, "{spring} {expected}");
    }
}

/// A load in place of a motion: the half car without friction rises by it over the stiffness of its springs.
#[test]
fn analytic_a_load_lifts_the_half_car() {
    let load = "bolster.load.vertical={ shape = \"ramp\", amplitude = \"20000 lbf\", duration = \"2 s\", \
                profile = \"half_cosine\" }";
    let set = [
        load,
        "start.lift=0 in",
        "wedge.kind=massless",
        "friction.column=0",
        "friction.slope=0",
        "load_springs.damping=200 lbf s/in",
        "simulation.duration=12 s",
    ];
    let result = run("truck_drop_constant", &set);
    // 8 coils of 6468.7 lbf/in in series with 8 adapter points of 5e5.
    let expected = 20_000.0 * (1.0 / (8.0 * 6468.7) + 1.0 / (8.0 * 5e5)) * INCH;
    let rise = at(&result, "bolster_z", 11.9) - at(&result, "bolster_z", 0.0);
    assert!((rise / expected - 1.0).abs() < 2e-3, "{rise} {expected}");
    // Its work stands with that of motions.
    let work = column(&result, "motion_work").last().unwrap();
    assert!(*work > 0.4 * 20_000.0 * POUND_FORCE * expected, "{work}");
}

#[test]
fn reproducible_massless_wedges_save_and_continue() {
    let set = ["wedge.kind=massless", "simulation.duration=3 s"];
    let name = "truck_vertical_variable_toe_out";
    let straight = run(name, &set);
    let case = case(name, &set);
    let mut first = Run::new(&case).unwrap();
    while first.time() < 1.7 {
        first.advance().unwrap();
    }
    let text = serde_json::to_string(&first.state()).unwrap();
    let head = first.result(None);
    let state: RunState<TruckCounts> = serde_json::from_str(&text).unwrap();
    let tail = Run::resume(&case, state).unwrap().finish(|_| ());
    for ((straight, head), tail) in straight.values.iter().zip(&head.values).zip(&tail.values) {
        let both = head.iter().chain(tail);
        assert!(straight.iter().map(|v| v.to_bits()).eq(both.map(|v| v.to_bits())));
    }
}

/// All ways to start, with massless wedges.
#[test]
fn limits_massless_wedges_start_everywhere() {
    for kind in ["rest", "touching", "equilibrium"] {
        let start = format!("start.kind={kind}");
        let set = [start.as_str(), "wedge.kind=massless", "simulation.duration=0.5 s"];
        let result = run("truck_drop_variable", &set);
        assert!(result.summary.ledger.largest_relative_residual < 1e-5);
    }
}
