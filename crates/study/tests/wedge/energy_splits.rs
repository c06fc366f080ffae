//! Division of the energy of a cycle: divisions sum to the ledger and are integrals of powers; what flows in
//! flows out; a face left out is noticed; what has no cycle says why.

use std::collections::BTreeMap;

use mechanics::energy_balance::{FAILED, relative_residual};
use study::case::{Case, builtin};
use study::losses::flow::PowerFlow;
use study::losses::stroke::PARTS;
use study::losses::{EnergySummary, STATES};
use study::metrics::Cycle;
use study::result::RunResult;
use study::run::Run;
use study::summary::SummaryValue;
use study::truck;

/// A wedge that yaws, so that its corners carry and slip differently.
const YAWED: &str = "vdrun_toe_in_0.2_psi_0.012";
const SHORT: [&str; 3] = ["simulation.duration=1.5 s", "simulation.output_units=si", FAST];
/// Short cycles.
const FAST: &str =
    "bolster.vertical={ shape = \"sine\", amplitude = \"0.5 in\", frequency = \"2 Hz\", phase = \"30 deg\" }";

fn case(name: &str, set: &[&str]) -> Case {
    let set: Vec<String> = SHORT.iter().chain(set).map(|text| (*text).to_owned()).collect();
    builtin::case_with(name, &set).unwrap()
}

fn run(name: &str, set: &[&str]) -> RunResult {
    let result = Run::new(&case(name, set)).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.stopped);
    result
}

fn truck(name: &str, set: &[&str]) -> truck::run::TruckResult {
    let set: Vec<String> = [FAST].iter().chain(set).map(|text| (*text).to_owned()).collect();
    let case = truck::builtin::case_with(name, &set).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

fn sum(values: &BTreeMap<String, SummaryValue>) -> f64 {
    values.values().map(|own| own.value).sum()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{what}: {found}, {expected} expected"
    );
}

/// Every division of every loss has its total, and all losses have the sum of the parts of the stroke.
fn check_sums(energy: &EnergySummary, faces: usize) {
    let loss = energy.loss.as_ref().unwrap().value;
    let rounding = 1e-12 * loss;
    assert!(loss > 0.0);
    let mut all = 0.0;
    for (name, own) in &energy.losses {
        let total = own.total.as_ref().unwrap().value;
        all += total;
        near(sum(&own.by_stroke), total, rounding, name);
        if own.by_point.is_empty() {
            assert!(own.by_state.is_empty(), "{name}");
            continue;
        }
        near(sum(&own.by_point), total, rounding, name);
        near(sum(&own.by_state), total, rounding, name);
        assert!(STATES.iter().all(|state| own.by_state.contains_key(*state)));
        assert!(PARTS.iter().all(|part| own.by_stroke.contains_key(*part)));
    }
    near(all, loss, rounding, "all losses");
    near(sum(&energy.by_stroke), loss, rounding, "by stroke");
    near(
        energy.balance(),
        energy.residual.as_ref().unwrap().value,
        rounding,
        "balance",
    );
    let of_faces = energy.losses.values().filter(|own| own.kind == "friction_loss");
    assert_eq!(of_faces.count(), faces);
    assert!(
        energy.largest_correction < 2e-3,
        "correction {}",
        energy.largest_correction
    );
    let flow = PowerFlow::of(energy).unwrap();
    near(
        flow.inflow() - flow.outflow(),
        flow.residual,
        10.0 * rounding,
        "flow",
    );
    assert!(flow.residual.abs() < 1e-4 * flow.inflow(), "{flow:?}");
}

#[test]
fn energy_divisions_of_wedges_sum_to_the_ledger() {
    for set in [
        &[][..],
        &["friction.law=bristle"],
        &["contact.damping=20 lbf*s/in", "control_coil.damping=5 lbf*s/in"],
        &["column_face.grid=[3, 3]"],
    ] {
        let summary = run(YAWED, set).summary;
        check_sums(&summary.energy, 2);
        // The same as the averages, which are taken from the ledger on their own.
        for (side, term) in [
            ("side_frame", "column_friction_loss"),
            ("bolster", "slope_friction_loss"),
        ] {
            let expected = summary.averages.energy_per_cycle[side].value;
            let found = summary.energy.losses[term].total.as_ref().unwrap().value;
            near(found, expected, 1e-12 * expected, term);
        }
        assert_eq!(summary.energy.cycles, summary.averages.cycles);
    }
}

/// The divisions of a truck's losses, with wedges that have mass and with massless ones, are those of its
/// cycles.
#[test]
fn energy_divisions_of_trucks_sum_to_the_ledger() {
    for (set, faces) in [(&[][..], 12), (&["wedge.kind=massless"], 4)] {
        let set = [&["simulation.duration=1.1 s"], set].concat();
        let summary = truck("truck_vertical_variable", &set).summary;
        assert!(summary.complete, "{set:?}: {:?}", summary.stopped);
        // The same as in the cycles, which are taken from the ledger on their own; what is left out is zero.
        let loss = summary.energy.loss.as_ref().unwrap().value;
        for (name, expected) in &summary.cycles.losses {
            let own = summary.energy.losses.get(name).and_then(|own| own.total.as_ref());
            near(
                own.map_or(0.0, |own| own.value),
                expected.value,
                1e-12 * loss,
                name,
            );
        }
        check_sums(&summary.energy, faces);
    }
}

/// Friction force times slip speed of each corner, from a table with dense rows, by the trapezoidal rule: by
/// corner, by state and by part of the stroke.
#[test]
fn cross_code_divisions_are_integrals_of_powers_from_the_table() {
    let case = case(YAWED, &["simulation.output_interval=0.0001 s"]);
    let result = Run::new(&case).unwrap().finish(|_| ());
    let cycle = Cycle::of(&case.parameters).unwrap();
    let (start, end, cycles) = cycle.window(case.simulation.duration).unwrap();
    let column = |name: &str| result.column(name).unwrap();
    let (time, z, rate) = (
        column("time"),
        column("bolster_vertical"),
        column("bolster_vertical_rate"),
    );
    for face in ["column", "slope"] {
        let own = &result.summary.energy.losses[&format!("{face}_friction_loss")];
        let (mut by_state, mut by_stroke) = (BTreeMap::new(), BTreeMap::new());
        for corner in ["lower_right", "lower_left", "upper_right", "upper_left"] {
            let stem = format!("{face}_{corner}");
            let force = ["x", "y", "z"].map(|axis| column(&format!("{stem}_friction_force_{axis}")));
            let (speed, states) = (
                column(&format!("{stem}_slip_speed")),
                column(&format!("{stem}_state")),
            );
            let power = |row: usize| {
                let square: f64 = force.iter().map(|force| force[row] * force[row]).sum();
                square.sqrt() * speed[row]
            };
            let mut total = 0.0;
            for row in 1..time.len() {
                let (from, to) = (time[row - 1], time[row]);
                if from < start - 1e-9 || to > end + 1e-9 {
                    continue;
                }
                let work = 0.5 * (power(row - 1) + power(row)) * (to - from) / f64::from(cycles);
                total += work;
                for row in [row - 1, row] {
                    let own = 0.5 * power(row) * (to - from) / f64::from(cycles);
                    *by_state.entry(STATES[states[row] as usize]).or_insert(0.0) += own;
                }
                let middle = 0.5 * (z[row] + z[row - 1]);
                let way = if rate[row] + rate[row - 1] > 0.0 {
                    "rising"
                } else {
                    "falling"
                };
                let half = if middle > 0.0 { "upper" } else { "lower" };
                *by_stroke.entry(format!("{way}_{half}")).or_insert(0.0) += work;
            }
            let found = own.by_point[&stem].value;
            near(found, total, 2e-3 * own.total.as_ref().unwrap().value, &stem);
        }
        let all = own.total.as_ref().unwrap().value;
        for (state, expected) in by_state {
            near(own.by_state[state].value, expected, 3e-3 * all, state);
        }
        for (part, expected) in by_stroke {
            near(own.by_stroke[&part].value, expected, 3e-3 * all, &part);
        }
    }
}

/// A ledger without one of the faces does not close: its residual is far above the limit of a failed run.
#[test]
fn energy_a_face_left_out_is_noticed() {
    let energy = run(YAWED, &["contact.damping=20 lbf*s/in"]).summary.energy;
    let loss = energy.loss.as_ref().unwrap().value;
    assert!(relative_residual(energy.balance(), 0.0, loss, 0.0) < 1e-5);
    let mut noticed = 0;
    for face in ["column_friction_loss", "slope_friction_loss"] {
        let mut without = energy.clone();
        without.losses.remove(face).unwrap();
        let residual = relative_residual(without.balance(), 0.0, loss, 0.0);
        assert!(residual > FAILED, "{face}: {residual:e}");
        // What is missing in the figure is what the face lost.
        let flow = PowerFlow::of(&without).unwrap();
        assert!((flow.inflow() - flow.outflow()).abs() > FAILED * loss);
        noticed += 1;
    }
    assert_eq!(noticed, 2);
}

#[test]
fn input_what_has_no_cycle_says_why() {
    for (set, why) in [
        (&["bolster.vertical=0 in"][..], "does not move up and down"),
        (
            &[
                "bolster.vertical={ shape = \"ramp\", amplitude = \"0.1 in\", start = \"0 s\", \
                 duration = \"1 s\" }",
            ],
            "not one sine or triangle",
        ),
        (&["simulation.duration=0.6 s"], "no whole cycle"),
    ] {
        let energy = run(YAWED, set).summary.energy;
        assert!(energy.missing.contains(why), "{}", energy.missing);
        assert!(energy.losses.is_empty() && !energy.is_some() && PowerFlow::of(&energy).is_none());
    }
    for (set, why) in [
        (&["bolster.vertical=0 in"][..], "no motion or load"),
        (&["simulation.duration=0.9 s"], "no whole cycle"),
    ] {
        let energy = truck("truck_vertical_variable", set).summary.energy;
        assert!(energy.missing.contains(why), "{}", energy.missing);
    }
    // A run that was stopped in its cycles.
    let stopped = Run::new(&case(YAWED, &[])).unwrap().finish_while(|time| {
        if time > 0.6 {
            std::ops::ControlFlow::Break("enough".to_owned())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    });
    assert!(stopped.summary.energy.missing.contains("stopped before"));
}

/// A run that is saved amid its cycles and goes on has the same divisions, bit for bit.
#[test]
fn reproduction_a_continued_run_has_the_same_divisions() {
    let case = case(YAWED, &["friction.law=bristle"]);
    let whole = Run::new(&case).unwrap().finish(|_| ()).summary.energy;
    let mut run = Run::new(&case).unwrap();
    while run.time() < 0.7 {
        run.advance().unwrap();
    }
    let state = run.state();
    let continued = Run::resume(&case, state.clone()).unwrap().finish(|_| ()).summary;
    assert_eq!(continued.energy.losses, whole.losses);
    assert_eq!(continued.energy.stored_change, whole.stored_change);
    // A state without them is no state of this run.
    let mut damaged = state;
    damaged.counts.losses = study::losses::LossCounts::default();
    let error = Run::resume(&case, damaged).err().unwrap().to_string();
    assert!(error.contains("counts.losses"), "{error}");
}
