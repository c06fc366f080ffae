//! The energy ledger of all runs closes.

use mechanics::system::EnergyTermKind;
use study::half_truck::catalog::{CatalogEntry, ToeCase, YawCase};

use crate::common::run_all;

#[test]
fn all_runs_close_their_ledgers() {
    // Jammed wedges that flutter, in tens of thousands of steps a second: a shorter run.
    let flutters = |entry: &CatalogEntry| entry.name() == "nucars_69_variable_toe_in_yaw";
    let mut results = run_all(7.0, |entry| !flutters(entry));
    results.extend(run_all(3.5, flutters));
    assert_eq!(results.len(), 28);
    for (entry, result) in results {
        let (name, summary) = (entry.name(), &result.summary);
        assert!(summary.complete, "{name}: {:?}", summary.stopped);
        println!("{name}: {:.1e}", summary.largest_relative_residual);
        assert!(
            summary.largest_relative_residual < 1e-5,
            "{name}: {:e}",
            summary.largest_relative_residual
        );
        for (column, values) in result.columns.iter().zip(&result.values) {
            assert!(
                values.iter().all(|value| value.is_finite()),
                "{name}: {}",
                column.name
            );
        }
        let work = result.column("input_work").unwrap_or_default();
        let work = work.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        // What can only be lost never comes back.
        for energy_term in [
            EnergyTermKind::SpringDamping,
            EnergyTermKind::GapDamping,
            EnergyTermKind::SurfaceFriction,
            EnergyTermKind::ColumnFriction,
        ] {
            let lost = result.column(energy_term.name()).unwrap_or_default();
            let drop = lost
                .windows(2)
                .fold(0.0, |drop: f64, pair| drop.max(pair[0] - pair[1]));
            assert!(
                drop <= 1e-7 * work,
                "{name}: {} falls by {drop} J",
                energy_term.name()
            );
        }
        let jammed = summary.wedges.values().any(|wedge| wedge.jammed > 0.0);
        assert_eq!(jammed, entry.toe == ToeCase::In, "{name}");
        assert_eq!(summary.yaw.is_some(), entry.yaw != YawCase::Straight, "{name}");
    }
}
