//! The report on the three-piece truck: closed forms hold, differences are stated, stiffnesses change
//! results.

use std::sync::OnceLock;

use reproduction::page::truck::{TruckContents, render};
use reproduction::three_piece::{Basis, Rigs, TruckFindings, shown, variants};
use study::run::Run;
use study::truck::builtin;

/// Returns the runs that the report needs, once.
fn rigs() -> &'static Rigs {
    static RIGS: OnceLock<Rigs> = OnceLock::new();
    RIGS.get_or_init(|| {
        let mut rigs = Rigs::default();
        for name in shown() {
            let case = builtin::case_with(name, &[]).unwrap();
            let result = Run::new(&case).unwrap().finish(|_| ());
            rigs.add(name, case, result);
        }
        for variant in variants().unwrap() {
            let result = Run::new(&variant.case).unwrap().finish(|_| ());
            rigs.add(&variant.key, variant.case, result);
        }
        rigs
    })
}

fn findings() -> &'static TruckFindings {
    static FINDINGS: OnceLock<TruckFindings> = OnceLock::new();
    FINDINGS.get_or_init(|| TruckFindings::of(rigs()))
}

#[test]
fn analytic_all_closed_forms_and_the_independent_calculation_agree() {
    for basis in [Basis::ClosedForm, Basis::IndependentCalculation] {
        let own: Vec<_> = findings()
            .checks
            .iter()
            .filter(|check| check.basis == basis)
            .collect();
        assert!(own.len() >= 6, "{basis:?}: {}", own.len());
        for check in own {
            assert!(check.agrees, "{check:?}");
            assert!(!check.remark.is_empty());
        }
    }
}

/// With much toe slopes slide and the massless wedge's branches are reached; with little toe, and without,
/// they are not, and the page says so.
#[test]
fn limits_the_massless_wedge_is_reported_where_it_agrees_and_where_not() {
    let of = |what: &str| {
        let found = findings().checks.iter().find(|check| check.what == what);
        found.unwrap_or_else(|| panic!("no check `{what}`"))
    };
    for damping in ["constant", "variable"] {
        for way in ["up", "down"] {
            let differences = ["toe out 2°", "toe out 0.2°"].map(|toe| {
                let check = of(&format!(
                    "normal force of a column going {way}, {damping} damping, {toe}"
                ));
                println!("{check:?}");
                check.difference.abs()
            });
            // Half a stroke is not quite enough to reach them all.
            assert!(
                differences[0] < 0.5 * differences[1],
                "{damping}, {way}: {differences:?}"
            );
            assert!(differences[1] > 0.1, "{damping}, {way}: {differences:?}");
        }
    }
    let stuck = of("normal force of a column going down, constant damping, no toe");
    assert!(!stuck.agrees && stuck.remark.contains("sticks"), "{stuck:?}");
}

/// Where a nest locks the contacts' stiffness sets the moment; where there is a plateau it hardly matters.
#[test]
fn limits_stiffness_moves_what_locks() {
    let moved = |rig: &str, answer: &str| {
        let found = findings().sensitivities.iter();
        found
            .clone()
            .find(|own| own.rig == rig && own.answer == answer)
            .unwrap_or_else(|| panic!("{rig}, {answer}"))
    };
    let [new, worn] = ["warp, new", "warp, mu 0.25"].map(|rig| moved(rig, "warp moment at 20 mrad"));
    assert!(new.contacts > 20.0 && new.contacts < 80.0, "{new:?}");
    assert!(worn.contacts.abs() < 0.5 * new.contacts, "{worn:?} {new:?}");
    assert_eq!(findings().sensitivities.len(), 10);
}

/// A run that is missing, or was stopped, is not told of; a wrong number is told as one.
#[test]
fn input_what_is_wrong_or_missing_is_reported() {
    assert!(
        TruckFindings::of(&Rigs::default())
            .checks
            .iter()
            .all(|check| check.what.contains("bounce"))
    );
    let mut rigs = rigs().clone();
    let (case, result) = rigs.get("frictionless warp").unwrap();
    let (case, mut result) = (case.clone(), result.clone());
    let place = result
        .columns
        .iter()
        .position(|column| column.name == "trailing_left_roll")
        .unwrap();
    for roll in &mut result.values[place] {
        *roll *= 1.02;
    }
    rigs.add("frictionless warp", case.clone(), result.clone());
    let wrong = TruckFindings::of(&rigs);
    let check = wrong
        .checks
        .iter()
        .find(|check| check.what.starts_with("roll of a wedge"))
        .unwrap();
    assert!(
        !check.agrees && (check.difference - 0.02).abs() < 5e-3,
        "{check:?}"
    );
    result.summary.complete = false;
    rigs.add("frictionless warp", case, result);
    let less = TruckFindings::of(&rigs);
    assert!(
        !less
            .checks
            .iter()
            .any(|check| check.what.starts_with("roll of a wedge"))
    );
}

#[test]
fn the_page_has_every_number_with_its_remark_and_every_rig() {
    let results: Vec<_> = shown()
        .into_iter()
        .map(|name| rigs().get(name).unwrap().1.clone())
        .collect();
    let page = render(&TruckContents {
        rigs: &results,
        findings: findings(),
        figures: &[],
        view: "{}",
    });
    for check in &findings().checks {
        assert!(
            page.contains(&check.remark.replace('&', "&amp;")),
            "{}",
            check.what
        );
    }
    for name in shown() {
        assert!(page.contains(&format!("id=\"run-{name}\"")), "{name}");
    }
    assert_eq!(shown().len(), 32);
    let (shown, scripts) = page.split_once("<script>").unwrap();
    assert!(!shown.contains("NaN") && scripts.contains("id=\"wedgelab-view\""));
    let mut json = Vec::new();
    findings().write(&mut json).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(json["schema"], "wedgelab.truck_checks/1");
    assert_eq!(json["checks"].as_array().unwrap().len(), findings().checks.len());
}

/// The table as it stands, for those who look.
#[test]
fn every_number_is_finite() {
    for check in &findings().checks {
        println!(
            "{:?} | {} | {:.6} | {:?} | {} | {:+.4} | {}",
            check.basis, check.what, check.found, check.expected, check.unit, check.difference, check.agrees
        );
        assert!(
            check.found.is_finite() && check.difference.is_finite(),
            "{check:?}"
        );
    }
    for own in &findings().sensitivities {
        println!(
            "{} | {} | {:.1} {} | k {:+.2} % | K_a {:+.2} %",
            own.rig, own.answer, own.value, own.unit, own.contacts, own.bristles
        );
        assert!(own.value > 0.0 && own.contacts.is_finite() && own.bristles.is_finite());
    }
}
