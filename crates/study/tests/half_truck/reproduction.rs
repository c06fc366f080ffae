//! Energies and forces of the wedges in the runs against those of the element alone.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use study::half_truck::HalfTruckResult;
use study::half_truck::run::run;

use crate::common::{INCH, POUND_INCH, case};

/// Cycles of the input, from the first loading on: energy at the column (lbf in), lowest and highest stroke
/// (in).
fn cycles(result: &HalfTruckResult, number: u32) -> Vec<[f64; 3]> {
    let column = |what: &str| result.column(&format!("wedge_{number}_{what}")).unwrap();
    let (friction, stroke) = (column("column_friction"), column("stroke"));
    let times = result.column("time").unwrap();
    let at = |time: f64| times.partition_point(|own| *own < time);
    (0..)
        .map(|cycle| {
            (
                at(0.5 * PI + PI * f64::from(cycle)),
                0.5 * PI + PI * f64::from(cycle + 1),
            )
        })
        .take_while(|(_, end)| *end < 20.0)
        .map(|(start, end)| {
            let rows = start..at(end);
            let mut found = [0.0, f64::INFINITY, f64::NEG_INFINITY];
            for row in rows {
                let step = stroke[row + 1] - stroke[row];
                found[0] += 0.5 * (friction[row + 1] + friction[row]) * step / POUND_INCH;
                found[1] = found[1].min(stroke[row] / INCH);
                found[2] = found[2].max(stroke[row] / INCH);
            }
            found
        })
        .collect()
}

fn fine(name: &str) -> HalfTruckResult {
    let mut case = case(name, 20.0);
    case.interval = 0.001;
    run(&case, |_| ()).unwrap()
}

/// μ 2 cos θ / ((1 + μ²) sin(θ + φ)): friction down and up together, over the coil's force.
fn both(angle: f64, toe: f64) -> f64 {
    let (theta, phi) = (angle.to_radians(), toe.to_radians());
    0.4 * 2.0 * theta.cos() / (1.16 * (theta + phi).sin())
}

/// Wedges in the truck turn out the energy of the element alone under their own stroke.
///
/// The driven bolster moves by 1 in; input springs (3e6 lb/in), suspension and bearings (4e6 lb/in) change
/// the stroke between bolster and side frames: constant damping 1.935 in instead of 2 in, variable damping
/// down to -1.049 in instead of -1 in, because the bolster hangs 0.0402 in low and the side frames stand
/// 0.0302 in high. So a cycle takes 6428 (6.8) and 6399 lbf in (6.9) instead of 6655 and 6626, and 1817 and
/// 1797 instead of 1656 and 1646. In the first cycle the input springs still ring from the start, and with
/// variable damping that takes 9 % more.
#[test]
fn energy_a_cycle_is_that_of_the_element_under_the_actual_stroke() {
    for (name, angle, toe, constant) in [
        ("nucars_68_variable_toe_out", 32.0, 0.0, false),
        ("nucars_69_variable_toe_out", 32.0, 0.2, false),
        ("nucars_68_constant_toe_out", 37.5, 0.0, true),
        ("nucars_69_constant_toe_out", 37.5, 0.2, true),
    ] {
        let result = fine(name);
        let cycles = cycles(&result, 127);
        assert_eq!(cycles.len(), 5);
        for (number, [energy, low, high]) in cycles.iter().copied().enumerate() {
            let closed = if constant {
                // Friction F_d + F_u over the stroke, narrowed by the accumulator's 1e6 lb/in.
                let force = both(angle, toe) * 3702.2;
                force * (high - low - force / 1e6)
            } else {
                // Half of friction over the loaded stroke, less the corner that the accumulator cuts; with a
                // toe the rise of the wedge takes tan φ / tan θ from the coil's stroke.
                let (theta, phi) = (f64::to_radians(angle), f64::to_radians(toe));
                let force = both(angle, toe) * 3000.0 * -low * (1.0 - phi.tan() / theta.tan());
                0.5 * force * -low - 0.5 * force * force / 1e6
            };
            let ratio = energy / closed;
            println!("{name}: {energy:.1} lbf in, {low:.5} to {high:.5} in, by hand {closed:.1}: {ratio:.5}");
            if number > 0 || constant {
                assert!(
                    (ratio - 1.0).abs() < 5e-4,
                    "{name}, cycle {number}: {energy} {closed}"
                );
            } else {
                assert!(
                    (1.08..1.10).contains(&ratio),
                    "{name}, first cycle: {energy} {closed}"
                );
            }
        }
        let mean = cycles.iter().map(|[energy, ..]| energy / 5.0).sum::<f64>();
        let summary = result.summary.wedges["127"].energy_per_cycle.as_ref().unwrap();
        let summary = summary.value;
        assert!((summary - mean).abs() < 5e-4 * mean, "{name}: {summary} {mean}");
    }
}

/// The summary's energy does not depend on how often rows are written.
#[test]
fn energy_a_cycle_does_not_depend_on_the_rows() {
    let at = |interval: f64| {
        let mut case = case("nucars_69_variable_toe_out", 6.0);
        case.interval = interval;
        let summary = run(&case, |_| ()).unwrap().summary;
        let energy = summary.wedges["129"].energy_per_cycle.as_ref();
        energy.unwrap().value
    };
    let (coarse, fine) = (at(0.1), at(0.002));
    assert!((coarse - fine).abs() < 1e-9 * fine, "{coarse} {fine}");
}

/// Friction while the bolster goes through its middle, constant damping, against the balance of the massless
/// wedge.
#[test]
fn forces_of_constant_damping_are_those_of_the_element() {
    let normal = |phi: f64, down: f64| {
        // N = F (cos θ + b μ sin θ) / (...), b = -a for toe out
        let (theta, mu) = (37.5_f64.to_radians(), 0.4);
        let slope = theta.cos() - down * mu * theta.sin();
        let column = theta.sin() + down * mu * theta.cos();
        let along = phi.cos() + down * mu * phi.sin();
        3702.2 * slope / (column * along + (phi.sin() - down * mu * phi.cos()) * slope)
    };
    for (name, phi) in [
        ("nucars_69_constant_toe_out", 0.2_f64.to_radians()),
        ("nucars_68_constant_toe_out", 0.0),
    ] {
        let [up, down] = [-1.0, 1.0].map(|down| -down * 0.4 * normal(phi, down));
        let summary = crate::common::result(name, 10.0).summary;
        for wedge in summary.wedges.values() {
            let found = [&wedge.up, &wedge.down].map(|measure| measure.as_ref().unwrap().value);
            println!("{name}: {found:?}, by hand {up} {down}");
            assert!(
                (found[0] - up).abs() < 1.0 && (found[1] - down).abs() < 1.0,
                "{name}: {found:?}"
            );
        }
    }
}
