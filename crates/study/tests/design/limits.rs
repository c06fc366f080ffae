//! Measures against the summary of the whole run.

use std::collections::BTreeMap;

use study::case::builtin;
use study::measures::{measure, of_wedges};
use study::metrics::Cycle;
use study::run::Run;
use study::summary::SummaryValue;

/// Every measure that the summary has too, in SI: the same to rounding, whatever moves.
#[test]
fn limits_measures_are_those_of_the_summary() {
    let set: Vec<String> = [
        "simulation.output_units=si",
        "simulation.output_interval=1 ms",
        "simulation.duration=8 s",
    ]
    .map(str::to_owned)
    .to_vec();
    for name in [
        "vdrun_toe_out_0.2_psi_0.012",
        "cdrun_toe_in_0.2_psi_0.012",
        "rig_constant",
        "warp_friction_0.2",
        "sweep_variable_0.25in_0.5hz",
    ] {
        let mut set = set.clone();
        if name.starts_with("warp") {
            // Its motions end with their tables or ramps.
            set.truncate(2);
        }
        let case = builtin::case_with(name, &set).unwrap();
        let found = measure(&case).unwrap();
        let result = Run::new(&case).unwrap().finish(|_| ());
        let summary = &result.summary;
        let averages = &summary.averages;
        let same = |measure: &str, other: Option<f64>| {
            let (own, other) = (of_wedges().get(&found, measure), other);
            match (own, other) {
                (None, None) => {}
                (Some(a), Some(b)) => {
                    assert!((a - b).abs() <= 1e-12 * b.abs(), "{name} {measure}: {a} {b}");
                }
                _ => panic!("{name} {measure}: {own:?} {other:?}"),
            }
        };
        let of =
            |means: &BTreeMap<String, SummaryValue>, key: &str| means.get(key).map(|measure| measure.value);
        for (side, means) in [("up", &averages.up), ("down", &averages.down)] {
            for column in [
                "vertical_wedge_force",
                "vertical_force_on_side_frame",
                "longitudinal_wedge_force",
            ] {
                same(&format!("mean_{column}_{side}"), of(means, column));
            }
        }
        for side in ["side_frame", "bolster"] {
            same(
                &format!("energy_per_cycle_{side}"),
                of(&averages.energy_per_cycle, side),
            );
        }
        let value = |measure: &Option<SummaryValue>| measure.as_ref().map(|measure| measure.value);
        same("equivalent_damping", value(&averages.equivalent_damping));
        same("equivalent_stiffness", value(&averages.equivalent_stiffness));
        same(
            "equivalent_damping_on_bolster",
            value(&averages.equivalent_damping_on_bolster),
        );
        same("ledger_residual", Some(summary.ledger.largest_relative_residual));
        same("contact_events", Some(summary.events.total as f64));
        same("steps", Some(summary.solver.statistics.steps as f64));
        let cycle = Cycle::of(&case.parameters);
        let window = cycle.and_then(|cycle| cycle.window(case.simulation.duration));
        let from = window.map_or(0.0, |(start, ..)| start);
        for side in ["side_frame", "bolster"] {
            for axis in ["roll", "pitch", "yaw"] {
                let column = result.column(&format!("{side}_{axis}_moment")).unwrap();
                let times = result.column("time").unwrap().iter();
                let counted = times.zip(column).filter(|(time, _)| **time >= from);
                let peak = counted.fold(0.0, |most: f64, (_, value)| most.max(value.abs()));
                same(&format!("peak_{side}_{axis}_moment"), Some(peak));
            }
        }
        // Shares and times by the rows of the table: a wedge that hangs free rattles with 400 Hz, so that
        // rows each 0.01 s would see contacts too seldom.
        for face in ["column", "slope"] {
            let states: Vec<&[f64]> = ["lower_right", "lower_left", "upper_right", "upper_left"]
                .map(|corner| result.column(&format!("{face}_{corner}_state")).unwrap())
                .to_vec();
            let rows = result.rows();
            let open = (0..rows)
                .filter(|row| states.iter().all(|state| state[*row] == 0.0))
                .count();
            let off = of_wedges().get(&found, &format!("lift_off_time_{face}")).unwrap();
            let end = case.simulation.duration;
            assert!(
                (off - open as f64 / rows as f64 * end).abs() < 0.005 * end,
                "{name} {off} {open}"
            );
        }
        let losses = ["side_frame", "bolster"]
            .map(|side| of_wedges().get(&found, &format!("energy_per_cycle_{side}")));
        if let [Some(column), Some(slope)] = losses {
            let period = column / of_wedges().get(&found, "wear_power_column").unwrap();
            assert!(
                (slope / of_wedges().get(&found, "wear_power_slope").unwrap() - period).abs() < 1e-9 * period
            );
        }
    }
}
