//! Short runs of the built-in cars at their own settings: their ledgers close.

use study::car::builtin;
use study::car::run::CarResult;
use study::energy;
use study::run::Run;

pub fn run(name: &str, settings: &[&str]) -> CarResult {
    // From the equilibrium: shaking a car takes longer than a short run.
    let settings = settings.iter().chain(&["start.kind=equilibrium"]);
    let settings: Vec<String> = settings.map(|own| (*own).to_owned()).collect();
    let case = builtin::case_with(name, &settings).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

fn check<'n>(names: impl Iterator<Item = &'n str>, duration: f64) {
    for name in names {
        let result = run(name, &[&format!("simulation.duration=\"{duration} s\"")]);
        let (summary, ledger) = (&result.summary, &result.summary.ledger);
        println!("{name}, {duration} s: {:.1e}", ledger.largest_relative_residual);
        assert!(summary.complete, "{name}: {:?}", summary.stopped);
        assert_eq!(summary.failed, None, "{name}");
        let warnings: Vec<&str> = energy::among(&summary.warnings).collect();
        assert!(warnings.is_empty(), "{name}: {warnings:?}");
        let created = summary.warnings.iter().find(|own| own.contains("below zero"));
        assert_eq!(created, None, "{name}");
        // The floor is what the tolerance admits.
        let admissible = ledger.admissible_residual.as_ref().unwrap().value;
        let least = 1e-3 * ledger.largest_residual.value / admissible;
        assert!(
            ledger.largest_relative_residual <= least * (1.0 + 1e-12),
            "{name}"
        );
    }
}

#[test]
fn issue_047_ledgers_of_short_runs_of_all_built_in_cars_close() {
    check(builtin::names(), 0.4);
}

#[test]
fn issue_047_ledgers_of_runs_of_a_second_close() {
    let blows = [
        "car_fra_class_1_empty",
        "car_hunting_roller_empty",
        "car_tangent_empty",
    ];
    check(blows.into_iter(), 1.0);
}

#[test]
#[ignore = "takes minutes"]
fn issue_047_ledgers_of_all_built_in_cars_close() {
    for duration in [1.0, 3.0] {
        check(builtin::names(), duration);
    }
}
