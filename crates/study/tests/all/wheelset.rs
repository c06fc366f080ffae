//! Runs of a wheelset: rows against the balance of forces, derailments, refusals.

use std::ops::ControlFlow;

use crate::wheelsets::wheelset;
use study::run::Run;
use study::summary::RunSummary;
use study::wheelset::run::WheelsetResult;
use study::wheelset::stability::stability;
use study::wheelset::{Wheelset, WheelsetCase};

const INCH: f64 = 0.0254;
const GRAVITY: f64 = 9.806_65;

fn run(wheelset: Wheelset) -> WheelsetResult {
    let case = WheelsetCase::new(wheelset).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

const CURVE: &str = "[[segments]]\ntangent = \"20 m\"\n[[segments]]\nspiral = \"40 m\"\n[[segments]]\n\
                     curve = \"120 m\"\nradius = \"400 m\"\nsuperelevation = \"80 mm\"\n";

/// In steady curving the wheels' forces carry the load and turn the wheelset: with the springs and the load
/// of the carriage they are the mass times the centripetal acceleration, less gravity, in the plane of the
/// track. The patches of each wheel sum up to its forces.
#[test]
fn analytic_rows_of_a_curve_balance() {
    for rigid in [true, false] {
        let kind = if rigid { "rigid" } else { "sprung" };
        let result = run(wheelset(&format!("{CURVE}[support]\nkind = \"{kind}\"\n"), 15.0));
        let summary = &result.summary;
        assert!(
            summary.complete && summary.warnings.is_empty(),
            "{:?}",
            summary.warnings
        );
        assert!(summary.ledger.largest_relative_residual < 1e-4);
        let last = result.rows() - 1;
        let at = |name: &str| result.column(name).unwrap_or_else(|| panic!("{name}"))[last];
        let roll = (80e-3_f64 / (59.5 * INCH)).asin();
        let (speed, lateral) = (at("speed"), at("lateral"));
        let centripetal = speed * speed / (400.0 - lateral * roll.cos());
        let (sine, cosine) = roll.sin_cos();
        // To the left, towards the center: of the wheels on the wheelset, and the carriage's spring.
        let wheels = at("right_lateral_force") - at("left_lateral_force");
        let sideways = wheels - 2e6 * lateral;
        let expected = 1250.0 * (centripetal * cosine - GRAVITY * sine);
        assert!(
            (sideways - expected).abs() < 30.0,
            "{kind}: {sideways} {expected}"
        );
        let load = at("left_vertical_force") + at("right_vertical_force");
        let carried = 290e3 - 1250.0 * GRAVITY + 1250.0 * (GRAVITY * cosine + centripetal * sine);
        assert!((load / carried - 1.0).abs() < 1e-3, "{kind}: {load} {carried}");
        // The outer wheel leads: a curve to the left presses the right wheel.
        assert!(at("lateral") < -1e-3);
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            let (mut vertical, mut outward) = (0.0, 0.0);
            for patch in 1..=3 {
                let own = |what: &str| at(&format!("{side}_patch_{patch}_{what}"));
                let (sine, cosine) = own("angle").sin_cos();
                // Up, and to the field side, on the wheel.
                let across = sign * own("creep_y");
                vertical += own("normal_force") * cosine + across * sine;
                outward += -own("normal_force") * sine + across * cosine;
            }
            let total = at(&format!("{side}_vertical_force"));
            assert!(
                (vertical / total - 1.0).abs() < 2e-3,
                "{kind} {side}: {vertical} {total}"
            );
            let lateral = at(&format!("{side}_lateral_force"));
            assert!(
                (-outward - lateral).abs() < 2e-3 * total,
                "{kind} {side}: {outward} {lateral}"
            );
            let patch = at(&format!("{side}_patch_1_y"));
            assert!((sign * patch - 0.75).abs() < 0.06, "{side}: {patch}");
        }
        assert!(at("left_wear_number") > 0.0 && at("right_wear_number") > 0.0);
        let hunting = summary.hunting.expect("a vibration");
        assert!(hunting.frequency_hz > 0.1 && hunting.damping_ratio.abs() < 1.0);
    }
}

/// Where a wheelset on springs begins to hunt: runs in time steps from 0.1 mm neither grow nor die at 69.8
/// m/s (`docs/validation-rolling.md`). Without springs it hunts at any speed; the speed of its own run and
/// its track do not count.
#[test]
fn cross_code_critical_speed_of_a_suspended_wheelset() {
    let mut own = wheelset(
        "[[segments]]\ntangent = \"20 m\"\n[support]\nkind = \"rigid\"\n",
        5.0,
    );
    (own.stiffness, own.damping) = ([1.5e5, 8e5], [0.0; 2]);
    own.axle_load = 58e3 + 1250.0 * GRAVITY;
    let speeds = [40.0, 60.0, 80.0, 100.0];
    let found = stability(&own, &speeds, |_| ControlFlow::Continue(())).unwrap();
    assert!(found.complete && !found.grows_at_once());
    let (speed, hunting) = found.critical.unwrap();
    assert!((speed / 69.8 - 1.0).abs() < 0.01, "{speed}");
    assert!((hunting.frequency_hz - 4.27).abs() < 0.03, "{hunting:?}");
    let growth = found
        .vibrations
        .iter()
        .map(|own| own.unwrap().growth_per_s)
        .collect::<Vec<_>>();
    assert!(growth[1] < 0.0 && growth[2] > 0.0, "{growth:?}");

    own.stiffness = [0.0; 2];
    let found = stability(&own, &speeds, |_| ControlFlow::Continue(())).unwrap();
    assert!(found.grows_at_once(), "{:?}", found.critical);
    let stopped = stability(&own, &speeds, |_| ControlFlow::Break(())).unwrap();
    assert!(!stopped.complete && stopped.speeds.len() == 1);
}

/// A wheelset is checked before anything is computed.
#[test]
fn input_a_wheelset_that_its_rails_do_not_carry_has_no_stability() {
    let mut own = wheelset("[[segments]]\ntangent = \"20 m\"\n", 5.0);
    own.axle_load = 100.0;
    let error = stability(&own, &[10.0], |_| ControlFlow::Continue(())).unwrap_err();
    assert!(error.to_string().contains("axle load"), "{error}");
}

/// A wheelset that is steered into its rail climbs, and the run ends there with place and time.
#[test]
fn issue_047_a_derailment_is_told_with_place_and_time() {
    let mut steered = wheelset(
        "[[segments]]\ntangent = \"200 m\"\n[support]\nkind = \"rigid\"\n",
        5.0,
    );
    // Free to leave, hardly loaded, and held at an angle of attack by what it begins with.
    steered.stiffness = [0.0, 0.0];
    steered.damping = [0.0, 1e9];
    steered.start.yaw = 0.08;
    steered.axle_load = 60e3;
    steered.friction = wheelrail::friction::Friction::constant(0.6);
    let result = run(steered);
    let summary = &result.summary;
    let derailment = summary.derailment.as_ref().expect("it derails");
    assert!(summary.stopped.is_none() && !summary.complete);
    assert_eq!(derailment.wheel, "left");
    assert!(["flange_tip", "off_rail", "rim_edge"].contains(&derailment.seat.as_str()));
    let last = result.rows() - 1;
    assert_eq!(result.column("time").unwrap()[last], derailment.time);
    assert_eq!(
        result.column("distance").unwrap()[last],
        derailment.distance.value
    );
    assert!(derailment.words().contains("left wheel") && derailment.distance.unit == "m");
    let outcome = summary.outcome();
    assert_eq!(outcome.word(), "derailed");
    let end = outcome.end().unwrap();
    assert_eq!(
        (end.time, end.distance.as_ref()),
        (derailment.time, Some(&derailment.distance))
    );
    assert!(
        outcome.told().unwrap().contains("is incomplete: the left wheel"),
        "{outcome:?}"
    );
    // It went up the flange.
    assert!(
        result
            .column("left_lateral_over_vertical")
            .unwrap()
            .iter()
            .any(|ratio| *ratio > 0.5)
    );
}

/// A case that cannot be run is refused with a remedy.
#[test]
fn input_what_cannot_be_run_is_refused() {
    let straight = "[[segments]]\ntangent = \"100 m\"\n";
    type Change = fn(&mut Wheelset);
    let changes: [(Change, &str, &str); 6] = [
        (|own| own.duration = Some(60.0), "is 100.0 m long", "lengthen"),
        (|own| own.speed = 0.0, "never reaches", "duration"),
        (|own| own.axle_load = 1e3, "axle load", "range"),
        (|own| own.stiffness[1] = -1.0, "yaw stiffness", "range"),
        (|own| own.start.lateral = 0.3, "do not carry", "start"),
        (|own| own.layout.gauge = 1.3, "gauge", "gauge"),
    ];
    for (change, message, remedy) in changes {
        let mut own = wheelset(straight, 10.0);
        change(&mut own);
        let error = WheelsetCase::new(own).unwrap_err();
        assert!(error.to_string().contains(message), "{error}");
        assert!(error.remedy().contains(remedy), "{}", error.remedy());
    }
}

/// Cones of unlike radii without springs stay where the rolling radii are equal, at (r2 - r1)/(2 γ) to the
/// left, and swing about that place from elsewhere, with the wavelength of their conicity.
#[test]
fn analytic_unlike_radii_roll_beside_the_middle() {
    let slope = 0.05;
    let cone = wheelrail::profile::nominal::cone(slope, 0.05).unwrap();
    let radii = [0.4572, 0.4570];
    let offset = (radii[1] - radii[0]) / (2.0 * slope);
    let run_from = |lateral: f64| {
        let mut own = wheelset(
            "[[segments]]\ntangent = \"60 m\"\n[support]\nkind = \"rigid\"\n",
            3.0,
        );
        own.wheels = [cone.clone(), cone.clone()];
        own.radii = radii;
        own.stiffness = [0.0; 2];
        own.damping = [0.0; 2];
        own.start.lateral = lateral;
        own.duration = Some(17.0);
        run(own).column("lateral").unwrap().to_vec()
    };
    let still = run_from(offset);
    let largest = still.iter().map(|y| (y - offset).abs()).fold(0.0, f64::max);
    assert!(largest < 0.01 * offset.abs(), "{largest} of {offset}");
    let swinging = run_from(0.0);
    let [low, high] = swinging
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| {
            [low.min(*y), high.max(*y)]
        });
    let middle = 0.5 * (low + high);
    assert!(
        (middle / offset - 1.0).abs() < 0.03,
        "{low} to {high}, about {offset}"
    );
}
