//! A driven wedge against a run of the same case, whose motions are functions of time.

use study::metrics::Cycle;
use study::run::Run;
use study::stepping::SteppedWedge;

use crate::common::{YAWED, case, place};

/// Energy per cycle and branch means of the vertical wedge force (up, down), from rows of (time, bolster,
/// rate, force, loss).
fn averages(case: &study::case::Case, rows: &[[f64; 5]]) -> [f64; 3] {
    let cycle = Cycle::of(&case.parameters).unwrap();
    let (start, end, cycles) = cycle.window(case.simulation.duration).unwrap();
    let loss = |time: f64| {
        let next = rows.partition_point(|row| row[0] < time).max(1);
        let [a, b] = [rows[next - 1], rows[next]];
        a[4] + (b[4] - a[4]) * (time - a[0]) / (b[0] - a[0])
    };
    let mut sums = [[0.0; 2]; 2];
    for [time, position, rate, force, _] in rows {
        if let Some(up) = cycle.branch(case.parameters.damping, *time, *position, *rate) {
            let sum = &mut sums[usize::from(up)];
            *sum = [sum[0] + force, sum[1] + 1.0];
        }
    }
    [
        (loss(end) - loss(start)) / f64::from(cycles),
        sums[1][0] / sums[1][1],
        sums[0][0] / sums[0][1],
    ]
}

fn rows_of_run(case: &study::case::Case) -> Vec<[f64; 5]> {
    let result = Run::new(case).unwrap().finish(|_| {});
    let columns = [
        "time",
        "bolster_vertical",
        "bolster_vertical_rate",
        "vertical_wedge_force",
        "side_frame_friction_loss",
    ]
    .map(|name| result.column(name).unwrap().to_vec());
    (0..result.rows())
        .map(|row| std::array::from_fn(|k| columns[k][row]))
        .collect()
}

fn rows_of_steps(case: &study::case::Case, step: f64, rates: bool) -> Vec<[f64; 5]> {
    let mut wedge = SteppedWedge::new(case).unwrap();
    let mut rows = Vec::new();
    let steps = (case.simulation.duration / step).round() as u64;
    let every = (case.simulation.output_interval / step).round() as u64;
    for number in 0..=steps {
        let time = number as f64 * step;
        if number > 0 {
            let mut end = place(case, time);
            if !rates {
                let from = *wedge.neighbours();
                end = from.reached(end.side_frame.position, end.bolster.position, step);
            }
            wedge.step_to(&end, time).unwrap();
        }
        if number % every == 0 {
            let bolster = wedge.neighbours().bolster;
            let evaluation = wedge.evaluation();
            // Column friction as it acts on the side frame: with no toe t2 is vertical; with toe it is the
            // row's column.
            let _ = evaluation;
            let row = wedge.row();
            let columns = wedge.columns();
            let value = |name: &str| row[columns.iter().position(|c| c.name == name).unwrap()];
            rows.push([
                time,
                bolster.position[2],
                bolster.rate[2],
                value("vertical_wedge_force"),
                value("side_frame_friction_loss"),
            ]);
        }
    }
    rows
}

fn agree(name: &str, overrides: &[&str], rates: bool, admissible: f64) {
    let case = case(name, overrides);
    let expected = averages(&case, &rows_of_run(&case));
    let found = averages(&case, &rows_of_steps(&case, 1e-3, rates));
    for (found, expected) in found.iter().zip(expected) {
        let error = (found - expected).abs() / expected.abs();
        println!("{name}: {found} {expected} {error:.1e}");
        assert!(error < admissible, "{name}: {found} against {expected}");
    }
}

#[test]
fn steps_of_a_millisecond_give_the_averages_of_a_run() {
    agree(YAWED, &[], true, 1e-4);
    agree("vdrun_toe_out_0.2_psi_0.012", &[], true, 1e-4);
    agree(YAWED, &["friction.law=\"bristle\""], true, 1e-4);
}

#[test]
fn rates_from_differences_of_positions_are_good_enough() {
    agree(YAWED, &[], false, 5e-3);
}
