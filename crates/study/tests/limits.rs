//! Cases at their limits: what a warped wedge can bear.
#![allow(clippy::unwrap_used, clippy::expect_used)]

#[path = "common/runs.rs"]
mod runs;

use mechanics::quasi_static::{Direction, QuasiStaticWedge, SlopeFriction};
use runs::{LBF, LBF_IN, column};
use study::case::builtin;
use study::result::RunResult;
use study::run::Run;

fn run(name: &str) -> RunResult {
    let result = Run::new(&builtin::case(name).unwrap()).unwrap().finish(|_| {});
    assert!(result.summary.complete);
    result
}

/// The moment about the column's middle over the edge-loading limit N_c h3/2 of the same instant.
fn shares(result: &RunResult) -> Vec<f64> {
    let moment = column(result, "net_moment_on_side_frame_z", LBF_IN);
    let normal = column(result, "longitudinal_wedge_force", LBF);
    moment
        .iter()
        .zip(&normal)
        .map(|(moment, normal)| moment.abs() / (0.5 * 10.5 * normal))
        .collect()
}

#[test]
fn the_warp_moment_reaches_the_edge_loading_limit_and_stays_below() {
    for (name, least) in [("warp_friction_0.2", 0.99), ("warp_friction_0.4", 0.97)] {
        let most = shares(&run(name)).into_iter().fold(0.0, f64::max);
        assert!(most > least && most < 1.005, "{name}: {most}");
    }
}

#[test]
fn a_wedge_that_may_roll_stays_well_below_the_limit() {
    let most = shares(&run("warp_friction_0.2_rolling"))
        .into_iter()
        .fold(0.0, f64::max);
    assert!(most > 0.6 && most < 0.9, "{most}");
}

/// Squeezed down between both faces, with both frictions up (a = b = +1), the wedge of friction 0.2 slides under the
/// quasi-static force; the wedge of friction 0.4 has none: it jams, and its force is many times that of the coil.
#[test]
fn squeezed_down_it_slides_or_jams() {
    // At 25 s the yaw turns, at 24 s it still grows; rows are 0.02 s apart.
    let row = 1200;
    for (name, friction) in [("warp_friction_0.2", 0.2), ("warp_friction_0.4", 0.4)] {
        let result = run(name);
        let normal = column(&result, "longitudinal_wedge_force", LBF)[row];
        let coil = column(&result, "coil_force", LBF)[row] - 50.0;
        let angle = 37.5_f64.to_radians();
        let wedge = QuasiStaticWedge {
            angle,
            toe: 0.0,
            column_friction: friction,
            slope_friction: friction,
        };
        match wedge.slide(Direction::Down, SlopeFriction::UpSlope, coil) {
            Some(slide) => {
                // Sliding across takes a part of the friction, the twisted wedge some of its angle.
                assert!(
                    (normal / slide.column_normal - 1.0).abs() < 0.04,
                    "{normal} {slide:?}"
                );
                assert!(friction < wedge.critical_friction());
            }
            None => {
                assert!(friction > wedge.critical_friction());
                assert!(normal > 5.0 * coil, "{normal} {coil}");
            }
        }
    }
}

/// Two loops: the second repeats the first, and a loop loses energy.
#[test]
fn the_warp_loop_closes() {
    let result = run("warp_friction_0.2");
    let moment = column(&result, "net_moment_on_side_frame_z", LBF_IN);
    let yaw = column(&result, "bolster_yaw", 1.0);
    let most = moment.iter().fold(0.0_f64, |most, moment| most.max(moment.abs()));
    // Rows of one period, 20 s.
    for row in 500..1500 {
        assert!((moment[row + 1000] - moment[row]).abs() < 0.01 * most, "{row}");
    }
    let work: f64 = (500..1500)
        .map(|row| 0.5 * (moment[row] + moment[row + 1]) * (yaw[row + 1] - yaw[row]))
        .sum();
    // On the side frame the moment follows the bolster's yaw: it takes work from the bolster.
    assert!(work > 0.2 * most * 0.04, "{work} lbf in");
    assert!(work < most * 0.04 * 2.0, "{work} lbf in");
}
