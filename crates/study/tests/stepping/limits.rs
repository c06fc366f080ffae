//! Limiting cases of driven wedges.

use study::stepping::{Neighbours, SteppedWedge};

use crate::common::{YAWED, at, case, value};

#[test]
fn a_wedge_in_equilibrium_stays_where_it_is() {
    let case = case("cdrun_toe_0_psi_0", &["simulation.start=\"equilibrium\""]);
    let still = Neighbours::default();
    let mut wedge = SteppedWedge::starting(&case, &still).unwrap();
    let start = wedge.states().to_vec();
    for _ in 0..50 {
        wedge.step(&still, 0.02).unwrap();
    }
    let speeds = wedge.system().layout().speeds;
    for k in 0..speeds {
        let drift = wedge.states()[k] - start[k];
        assert!(drift.abs() < 1e-9, "coordinate {k}: {drift}");
    }
}

/// One motion, cut into steps of other lengths, gives the same: cubics are not the sine, but nearly.
#[test]
fn the_length_of_the_steps_hardly_matters() {
    let case = case(YAWED, &[]);
    let loss = |step: f64| value(&mut at(&case, 3.0, step), "side_frame_friction_loss");
    let fine = loss(5e-4);
    for step in [1e-3, 5e-3, 2e-2] {
        let found = loss(step);
        assert!(
            (found - fine).abs() < 1e-4 * fine,
            "{step}: {found} against {fine}"
        );
    }
}

/// Moving everything together moves the wedge along, and changes no force.
#[test]
fn a_motion_of_both_neighbours_is_a_ride() {
    let case = case(
        "cdrun_toe_out_0.2_psi_0.012",
        &[
            "simulation.start=\"equilibrium\"",
            "environment.gravity=\"0 m/s^2\"",
        ],
    );
    let mut still = Neighbours::of(&case.parameters, 0.0);
    still.bolster.rate = [0.0; 6];
    let mut wedge = SteppedWedge::starting(&case, &still).unwrap();
    let before = wedge.reading().unwrap().on_bolster.force.0;
    let mut along = still;
    for place in [&mut along.side_frame, &mut along.bolster] {
        place.position[0] += 1.0;
        place.position[2] += 2.0;
    }
    // So slowly, and smoothly, that inertia does not matter.
    for _ in 0..2 {
        wedge.step(&along, 1000.0).unwrap();
    }
    let after = wedge.reading().unwrap().on_bolster.force.0;
    for k in 0..3 {
        assert!(
            (after[k] - before[k]).abs() < 0.01 * before[0].abs(),
            "{before:?} {after:?}"
        );
    }
    let x = value(&mut wedge, "wedge_x");
    assert!((x - 1.0).abs() < 1e-3, "{x}");
}
