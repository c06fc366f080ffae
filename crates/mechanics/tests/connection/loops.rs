//! Loops of a wedge alone against their closed forms.

use std::f64::consts::PI;

use integrate::Method;
use mechanics::connection::{Accumulator, ColumnFace, Law, Options, Wedge};
use mechanics::motion::Motion;
use mechanics::system::EnergyTermKind;

use crate::analytic::{close, plain};
use crate::half_truck::{INCH, LBF_INCH, LBF_PER_INCH, straight, wedge};
use crate::models::{observation, prescribed, run, wedge_at};

/// Returns the energy of one cycle of an inch up and down, the element alone: work of the motion, and the
/// column's share, lbf·in.
fn loop_energy(law: Wedge, tolerance: f64) -> [f64; 2] {
    let omega = 2.0;
    let motion = Motion::Sine {
        amplitude: INCH,
        angular_frequency: omega,
        phase: 0.0,
    };
    let system = prescribed(Law::Wedge(law), motion);
    let x = system.initial_state();
    let period = 2.0 * PI / omega;
    let at = |time: f64| {
        let done = run(&system, Method::Rodas5P, tolerance, &x, time);
        let column = done
            .problem()
            .energy_terms()
            .iter()
            .position(|own| own.kind == EnergyTermKind::ColumnFriction)
            .unwrap();
        let observation = observation(&done);
        let stored = observation.energies.total();
        [
            observation.quadratures[0] - stored,
            observation.quadratures[column],
        ]
    };
    let (a, b) = (at(0.5 * period), at(1.5 * period));
    [0, 1].map(|k| (b[k] - a[k]) / LBF_INCH)
}

/// Returns a wedge whose accumulator hardly deflects and hardly damps.
fn rigid(constant: bool, column: ColumnFace) -> Wedge {
    let mut law = wedge(constant, column);
    law.accumulator = Accumulator::Bristle {
        stiffness: 1e9 * LBF_PER_INCH,
        damping: 1e4 * LBF_PER_INCH,
    };
    law
}

/// Loops of the element alone without a toe angle: 1656 lbf·in with the coil on the side frame, 6655 lbf·in
/// with the coil in the bolster. Sum of both branches' friction: μ Σ N/F_s = μ · 2 cot θ/(1 + μ²).
#[test]
fn loops_without_an_angle() {
    let ratio = |angle: f64| 0.4 * 2.0 / f64::to_radians(angle).tan() / 1.16;
    let variable = 0.5 * 3000.0 * ratio(32.0);
    let constant = 2.0 * 3702.2 * ratio(37.5);
    close(variable, 1656.0, 0.6);
    close(constant, 6655.0, 0.6);
    for (fixed, expected) in [(false, variable), (true, constant)] {
        let [work, column] = loop_energy(rigid(fixed, plain(true)), 1e-8);
        close(column, expected, 2e-5 * expected);
        close(work, expected, 2e-5 * expected);
    }
}

/// An accumulator of K_a = 1e6 lbf/in takes the elastic part away: (F_d + F_u)(2A - (F_d + F_u)/K_a).
#[test]
fn an_elastic_accumulator_narrows_the_loop() {
    let mut law = wedge(true, plain(true));
    law.accumulator = Accumulator::Bristle {
        stiffness: 1e6 * LBF_PER_INCH,
        damping: LBF_PER_INCH,
    };
    let sum = 0.4 * 3702.2 * 2.0 / f64::to_radians(37.5).tan() / 1.16;
    let expected = sum * (2.0 - sum / 1e6);
    let [work, column] = loop_energy(law, 1e-8);
    close(work, expected, 2e-5 * expected);
    close(column, expected, 2e-5 * expected);
}

/// Loops at 0.2 degrees toe out: both branches' normal forces fall by sin θ / sin(θ+φ), to 1646 and 6625
/// lbf·in if the coil follows the bolster's travel alone. The wedge's rise takes the fraction tan φ / tan θ
/// away from the coil on the side frame; with the coil in the bolster it cancels over a whole cycle of the
/// extension.
#[test]
fn loops_with_a_toe_angle() {
    let angles = |angle: f64| (f64::to_radians(angle), f64::to_radians(0.2));
    let ratio = |angle: f64| {
        let (t, p) = angles(angle);
        0.4 * 2.0 * t.cos() / (1.16 * (t + p).sin())
    };
    let (t, p) = angles(32.0);
    let variable = 0.5 * 3000.0 * ratio(32.0);
    close(variable, 1646.0, 0.6);
    let constant = 2.0 * 3702.2 * ratio(37.5);
    close(constant, 6626.0, 1.5);
    for (fixed, expected) in [(false, variable * (1.0 - p.tan() / t.tan())), (true, constant)] {
        let [_, column] = loop_energy(rigid(fixed, straight(0.2, 1.0)), 1e-8);
        close(column, expected, 3e-5 * expected);
    }
    // as the option of the plain wedge, where nothing rises
    let options = Options {
        plain_toe_angle: p,
        ..Options::default()
    };
    let state = wedge_at(&wedge(false, plain(true)), &options, -INCH, -1.0);
    close(state.column_normal / state.coil_force, 1.0290, 5e-5);
    let state = wedge_at(&wedge(true, plain(false)), &options, -INCH, 1.0);
    close(state.column_normal / state.coil_force, 0.4800, 5e-5);
}
