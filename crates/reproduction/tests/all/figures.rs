//! Figures show what the table holds, say what they cut, and are found on the page.

use std::collections::{BTreeSet, HashMap};
use std::sync::OnceLock;

use report::csv;
use report::figures::{CaseOutcome, Exhibit};
use reproduction::sections;
use study::case::builtin;
use study::run::Run;

/// Six runs, toe out and toe in, to the end: the figures' windows need it.
fn outcomes() -> &'static [CaseOutcome] {
    static OUTCOMES: OnceLock<Vec<CaseOutcome>> = OnceLock::new();
    OUTCOMES.get_or_init(|| {
        [
            "vdrun_toe_out_0.2_psi_0",
            "vdrun_toe_in_0.2_psi_0.012",
            "cdrun_toe_out_0.2_psi_0",
            "cdrun_toe_0_psi_0",
            "cdrun_toe_out_0.2_psi_0.012",
            "cdrun_toe_in_0.2_psi_0.012",
        ]
        .into_iter()
        .map(|name| {
            let case = builtin::case(name).unwrap();
            let result = Run::new(&case).unwrap().finish(|_| ());
            (case, result)
        })
        .collect()
    })
}

fn exhibits() -> Vec<Exhibit> {
    let plans = sections::thesis(outcomes());
    plans.into_iter().flat_map(|plan| plan.exhibits).collect()
}

fn exhibit(name: &str) -> Exhibit {
    exhibits()
        .into_iter()
        .find(|exhibit| exhibit.name == name)
        .unwrap()
}

/// Returns the columns of a run's CSV file, read back without our own code.
fn table(outcome: &CaseOutcome) -> HashMap<String, Vec<f64>> {
    let mut bytes = Vec::new();
    csv::write(&outcome.1, &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let mut columns: HashMap<String, Vec<f64>> = names
        .iter()
        .map(|name| ((*name).to_owned(), Vec::new()))
        .collect();
    for line in lines {
        for (name, cell) in names.iter().zip(line.split(',')) {
            columns.get_mut(*name).unwrap().push(cell.parse().unwrap());
        }
    }
    columns
}

#[test]
fn curves_are_the_columns_of_the_table() {
    let figure = exhibit("constant_longitudinal_wedge_force").figure;
    let table = table(&outcomes()[2]);
    let curve = &figure.panels[0].curves[0];
    assert_eq!(curve.label, "toe out 0.2°");
    let expected: Vec<(f64, f64)> = table["time_s"]
        .iter()
        .copied()
        .zip(table["longitudinal_wedge_force_lbf"].iter().copied())
        .collect();
    assert_eq!(curve.points, expected);
    assert_eq!(figure.panels[0].y_label, "longitudinal wedge force (lbf)");
}

#[test]
fn loops_are_the_rows_of_the_thesis() {
    let figure = exhibit("constant_vertical_wedge_force_loop").figure;
    let table = table(&outcomes()[2]);
    let rows: Vec<usize> = (0..table["time_s"].len())
        .filter(|row| (3.5..=7.5).contains(&table["time_s"][*row]))
        .collect();
    for (panel, x) in figure.panels.iter().zip(["wedge_z_in", "bolster_vertical_in"]) {
        let expected: Vec<(f64, f64)> = rows
            .iter()
            .map(|row| (table[x][*row], table["vertical_wedge_force_lbf"][*row]))
            .collect();
        assert_eq!(panel.curves[0].points, expected);
        assert_eq!(panel.marks.len(), 4);
    }
}

#[test]
fn sizes_of_friction_forces_come_from_their_parts() {
    let figure = exhibit("cdrun_toe_0_psi_0_corner_forces").figure;
    let table = table(&outcomes()[3]);
    let curve = &figure.panels[2].curves[1];
    assert_eq!(curve.label, "lower left");
    let part = |axis: &str, row: usize| table[&format!("column_lower_left_friction_force_{axis}_lbf")][row];
    for (row, point) in curve.points.iter().enumerate() {
        let size = ["x", "y", "z"]
            .map(|axis| part(axis, row).powi(2))
            .iter()
            .sum::<f64>()
            .sqrt();
        assert!((point.1 - size).abs() <= 1e-12 * size.max(1.0));
    }
    assert!(curve.points.iter().any(|point| point.1 > 100.0));
}

#[test]
fn strips_show_every_state_for_its_time() {
    let figure = exhibit("vdrun_toe_out_0.2_psi_0_contact_states").figure;
    let table = table(&outcomes()[0]);
    let states = &table["column_upper_left_state"];
    let panel = &figure.panels[0];
    let row = panel
        .y_names
        .iter()
        .position(|name| name == "column, upper left")
        .unwrap() as f64;
    for (number, name) in ["open", "stick", "slip"].into_iter().enumerate() {
        let rows = states[..states.len() - 1]
            .iter()
            .filter(|state| **state == number as f64)
            .count();
        let drawn: f64 = panel
            .curves
            .iter()
            .filter(|curve| curve.label == name)
            .flat_map(|curve| curve.points.chunks(3))
            .filter(|piece| piece[0].1 == row)
            .map(|piece| piece[1].0 - piece[0].0)
            .sum();
        assert!(
            (drawn - 0.01 * rows as f64).abs() < 1e-9,
            "{name}: {drawn} s, {rows} rows"
        );
    }
}

#[test]
fn stick_and_wear_follow_from_the_table() {
    let outcome = &outcomes()[0];
    let table = table(outcome);
    let figure = exhibit("vdrun_toe_out_0.2_psi_0_stick_and_wear").figure;
    // The second cycle: from pi to 2 pi seconds.
    let (start, end) = (std::f64::consts::PI, 2.0 * std::f64::consts::PI);
    let rows = || {
        let times = table["time_s"].iter().enumerate();
        times
            .filter(|(_, time)| **time >= start && **time < end)
            .map(|(row, _)| row)
    };
    let (mut touching, mut sticking) = (0, 0);
    for corner in ["lower_right", "lower_left", "upper_right", "upper_left"] {
        let states = &table[&format!("slope_{corner}_state")];
        touching += rows().filter(|row| states[*row] > 0.0).count();
        sticking += rows().filter(|row| states[*row] == 1.0).count();
    }
    assert!(sticking > 0 && sticking < touching);
    let share = 100.0 * f64::from(sticking as u32) / f64::from(touching as u32);
    let stick = &figure.panels[0].curves[1].points;
    assert!((stick[2].1 - share).abs() < 1e-9, "{} {share}", stick[2].1);
    // The power, from the rate of dissipation by the trapezoidal rule.
    let (times, rate) = (&table["time_s"], &table["side_frame_dissipation_lbf_in_per_s"]);
    let energy: f64 = rows()
        .map(|row| -0.5 * (rate[row] + rate[row + 1]) * (times[row + 1] - times[row]))
        .sum();
    let power = energy / (end - start);
    let drawn = figure.panels[1].curves[0].points[2].1;
    assert!((drawn / power - 1.0).abs() < 0.02, "{drawn} {power}");
}

#[test]
fn captions_say_what_is_cut() {
    let figure = exhibit("constant_longitudinal_wedge_force").figure;
    assert_eq!(figure.panels[0].x_window, Some((0.5, 10.0)));
    assert!(
        figure.caption.contains("The first 0.5 s are cut"),
        "{}",
        figure.caption
    );
    let table = table(&outcomes()[2]);
    let peak = table["longitudinal_wedge_force_lbf"][..50]
        .iter()
        .fold(0.0, |most: f64, force| most.max(*force));
    assert!(peak > 1000.0);
    let other = &outcomes()[3].1;
    let other = other.column("longitudinal_wedge_force").unwrap()[..50]
        .iter()
        .fold(0.0, |most: f64, force| most.max(*force));
    let most = peak.max(other / 4.448_221_615_260_5);
    assert!(
        figure.caption.contains(&format!("{most:.0} lbf")),
        "{most} in {}",
        figure.caption
    );
    // The thesis's curves of variable damping without yaw begin at 0: nothing is cut.
    assert!(
        !exhibit("variable_longitudinal_wedge_force")
            .figure
            .caption
            .contains("cut")
    );
}

#[test]
fn names_are_unique_and_texts_are_there() {
    let exhibits = exhibits();
    let names: BTreeSet<&str> = exhibits.iter().map(|exhibit| exhibit.name.as_str()).collect();
    assert_eq!(names.len(), exhibits.len());
    for Exhibit { name, figure, .. } in &exhibits {
        assert!(figure.title.len() > 10 && figure.caption.ends_with('.'), "{name}");
        for panel in &figure.panels {
            assert!(!panel.x_label.is_empty(), "{name}");
            assert!(!panel.y_label.is_empty() || !panel.y_names.is_empty(), "{name}");
            assert!(!panel.curves.is_empty(), "{name}");
            assert!(panel.curves.iter().all(|curve| curve.points.len() > 1), "{name}");
        }
    }
    // The thesis's numbers, as far as these runs have them.
    let numbers: BTreeSet<&str> = exhibits.iter().map(|exhibit| exhibit.thesis.as_str()).collect();
    for number in [
        "figure 3-9",
        "figures 4-1 and 4-2",
        "figure 2-3",
        "figure 2-4",
        "figure 5-3",
        "figure 5-4",
        "figure 5-6",
        "figure 5-8",
        "figure 5-11",
        "figure 5-12",
        "figure 5-14",
        "figure 5-16",
        "figure 5-17",
        "figure 5-18",
        "figure 6-3",
        "figure 6-4",
        "figure 6-6",
        "figure 6-8",
        "figure 6-9",
        "figure 6-12",
        "figure 6-13",
        "figure 6-14",
        "figure 6-15",
        "figure 6-17",
        "figure 6-18",
        "figure 6-19",
    ] {
        assert!(numbers.contains(number), "{number} is missing");
    }
}

/// The inflow of a node equals its throughput and, but for flows too thin to be drawn and the ledger's
/// residual, its outflow; the numbers are those of the summary.
#[test]
fn energy_bands_of_the_power_flow_balance() {
    let figure = exhibit("vdrun_toe_in_0.2_psi_0.012_power_flow").figure;
    let chart = figure.flow.unwrap();
    let sum = |own: fn(&drawing::flow::Band) -> usize, number: usize| -> f64 {
        let bands = chart.bands.iter().filter(|band| own(band) == number);
        bands.map(|band| band.value).sum()
    };
    let through = chart.nodes.iter().find(|node| node.column == 1).unwrap().value;
    for (number, node) in chart.nodes.iter().enumerate() {
        let (into, out) = (sum(|band| band.to, number), sum(|band| band.from, number));
        match node.column {
            0 => assert!((out - node.value).abs() < 1e-12 * through),
            1 => assert!((into - out).abs() < 2e-3 * through && (into - through).abs() < 1e-3 * through),
            2 => assert!((into - node.value).abs() < 1e-12 * through && out <= into * (1.0 + 1e-12)),
            _ => assert!((into - node.value).abs() < 1e-12 * through && out == 0.0),
        }
    }
    let energy = &outcomes()[1].1.summary.energy;
    let column = energy.losses["column_friction_loss"].total.as_ref().unwrap();
    let drawn = chart
        .nodes
        .iter()
        .find(|node| node.label.starts_with("column friction\n"));
    assert!((drawn.unwrap().value - column.value).abs() < 1e-12 * through);
    assert!(figure.caption.contains(&column.unit) && figure.title.contains(&column.unit));
}
