//! Solvers of others agree with ours on the same equations, and the stick test with its closed form.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use integrate::Method;
use race::measure::Judge;
use race::problem::STICK_REST;
use race::{diffsol, own};

/// The release and the first sliding of a yawed case.
#[test]
fn diffsol_agrees_on_a_yawed_case() {
    let (name, rows) = ("cdrun_toe_out_0.2_psi_0.012", 51);
    let mut judge = Judge::new(name).unwrap();
    let mut quantities = |(outcome, states): (race::outcome::Outcome, Vec<f64>)| {
        assert_eq!(outcome.failure, "");
        assert!(outcome.steps > 0 && outcome.derivatives > outcome.jacobians && outcome.jacobians > 0);
        assert_eq!(outcome.rows, rows);
        judge.quantities(&states, rows).unwrap()
    };
    let ours = quantities(own::run(name, Method::Rodas5P, false, 1e-9, 60.0, rows).unwrap());
    let coarse = quantities(own::run(name, Method::TrBdf2, false, 1e-4, 60.0, rows).unwrap());
    for method in [diffsol::Method::Bdf, diffsol::Method::Esdirk34] {
        let mut other =
            |tolerance| quantities(diffsol::run(name, method, false, tolerance, 60.0, rows).unwrap());
        let (fine, finer) = (other(1e-8), other(1e-9));
        // Where both go as their tolerances fall: ours lies within what diffsol still changes.
        let (band, error) = (fine.error(&finer), ours.error(&finer));
        println!(
            "{method:?}: band {band:e}, ours {error:e}, ours that damps, at 1e-4 {:e}",
            coarse.error(&finer)
        );
        assert!(error < band, "{method:?}: {error:e} is not within {band:e}");
        assert!(
            coarse.error(&finer) > 10.0 * band,
            "there is something to tell apart"
        );
    }
}

/// Two solvers hold the mass where the closed form stops it, but for what the bristle gives.
#[test]
fn the_mass_stops_where_it_must() {
    let name = "stick_bristle";
    let (_, ours) = own::run(name, Method::Rodas5P, false, 1e-6, 60.0, usize::MAX).unwrap();
    let (_, other) = diffsol::run(name, diffsol::Method::Bdf, false, 1e-6, 60.0, usize::MAX).unwrap();
    for states in [ours, other] {
        let last = &states[states.len() - 5..];
        // The bristle of 1e7 N/m gives way by μmg/K = 3e-6 m each time it is turned over, in 14 half cycles.
        assert!(
            (last[0] - STICK_REST).abs() < 14.0 * 2.0 * 29.43 / 1e7,
            "{}",
            last[0]
        );
    }
}
