//! The truck of the benchmark is the truck that it is said to be.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use benchmarks::truck::{BolsterMotion, POUND_FORCE, RIGS};
use integrate::{Integrator, Method, Options, Problem};

/// A side frame weighs 1,150.5 lbf, carries a nest of 61,615 lbf, and stands on four points of 15,691 lbf.
#[test]
fn analytic_side_frames_carry_their_nests() {
    // Columns with toe out press from the start.
    for rig in RIGS.iter().filter(|rig| rig.toe == 0.0) {
        let mut system = rig.system().unwrap();
        let x = system.initial_state();
        let mut dx = vec![0.0; x.len()];
        system.next_time_discontinuity(0.0);
        system.derivative(0.0, &x, &mut dx);
        let speeds = system.layout().speeds;
        assert_eq!(speeds, 36);
        for side_frame in [2, 3] {
            let acceleration = |k: usize| dx[speeds + system.position_of(side_frame, k).unwrap()];
            let unbalanced = 1150.5 * 0.453_592_37 * acceleration(2) / POUND_FORCE;
            // The preloads are rounded to 0.1 lbf a coil.
            assert!(unbalanced.abs() < 3.0, "{}: {unbalanced} lbf", rig.name);
            for angle in 3..6 {
                assert!(acceleration(angle).abs() < 1e-9, "{} {angle}", rig.name);
            }
        }
    }
}

/// Left and right, leading and trailing do the same where the bolster goes up and down.
#[test]
fn limits_a_symmetric_truck_moves_symmetrically() {
    for rig in RIGS.iter().filter(|rig| rig.motion == BolsterMotion::Vertical) {
        let system = rig.system().unwrap();
        let x = system.initial_state();
        let options = Options {
            relative_tolerance: 1e-5,
            ..Options::of(Method::TrBdf2)
        };
        let mut integrator = Integrator::new(system.clone(), options, 0.0, &x).unwrap();
        while integrator.time() < 0.1 {
            integrator.step_to(0.1).unwrap();
        }
        let x = integrator.x();
        let at = |body: usize, k: usize| x[system.position_of(body, k).unwrap()];
        let mut largest = 0.0_f64;
        for (one, other, turned) in [(4, 5, 1.0), (6, 7, 1.0), (4, 6, -1.0), (2, 3, 1.0)] {
            assert!(
                (at(one, 2) - at(other, 2)).abs() < 1e-9,
                "{} {one} {other} {}",
                rig.name,
                at(one, 2) - at(other, 2)
            );
            assert!((at(one, 0) - turned * at(other, 0)).abs() < 1e-9, "{}", rig.name);
            assert!((at(one, 4) - turned * at(other, 4)).abs() < 1e-8, "{}", rig.name);
            largest = largest.max(at(one, 2).abs());
        }
        assert!(largest > 1e-3, "{}: the wedges go along", rig.name);
    }
}
