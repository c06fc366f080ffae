//! analytic, limits, input: wear of the wedges of a truck.
#![allow(clippy::unwrap_used)]

use study::case::Tables;
use study::run::Run;
use study::truck::TruckCase;
use study::truck::summary::TruckSummary;

use crate::problems::in_words;

fn parse(more: &str) -> Result<TruckCase, String> {
    let text = format!(
        "model = \"truck\"\n[bolster]\nfree_coordinates = []\nvertical = {{ shape = \"sine\", amplitude = \
         \"0.3 in\", frequency = \"2 Hz\" }}\n[simulation]\nduration = \"2 s\"\noutput_interval = \
         \"2 ms\"\n{more}"
    );
    TruckCase::parse("case.toml", &text, Tables::nowhere(), &[]).map_err(|error| in_words(error.problems()))
}

fn run(more: &str) -> TruckSummary {
    let summary = Run::new(&parse(more).unwrap()).unwrap().finish(|_| ()).summary;
    assert!(summary.complete, "{:?} {:?}", summary.stopped, summary.failed);
    summary
}

/// A face loses K E / (μ H A) in a million cycles, with the energy of a cycle that the ledger has for it; its
/// points have the shares that the integrator's steps give them.
#[test]
fn analytic_faces_lose_what_the_ledger_says() {
    let summary = run("[damage]\nwedge_coefficient = 2e-5\nwedge_hardness = \"2000 MPa\"");
    let wear = summary.wedge_wear.as_ref().unwrap();
    assert_eq!((wear.over.value, wear.over.unit.as_str()), (1e6, "cycles"));
    assert_eq!(wear.wedges.len(), 4);
    let own = &wear.wedges["leading_left"];
    let split = &summary.energy.losses["leading_left_column_friction_loss"];
    let joule = split.total.as_ref().unwrap().value * 0.112_984_829;
    let wedge = &parse("").unwrap().parameters.wedges[0];
    let depth = 1e6 * 2e-5 * joule / (0.4 * 2e9 * wedge.width * wedge.height);
    let found = own.column.mean_depth.value * 0.0254;
    assert!((found / depth - 1.0).abs() < 1e-6, "{found} {depth}");
    // Both partners wear alike: (2 c cos θ + 2 s) / sin θ.
    let (sine, cosine) = wedge.angle.sin_cos();
    let rise = 2.0 * (own.column.mean_depth.value * cosine + own.slope.mean_depth.value) / sine;
    assert!(
        (own.rise.value / rise - 1.0).abs() < 1e-3,
        "{} {rise}",
        own.rise.value
    );
    let all = split.total.as_ref().unwrap().value;
    let by_point: Vec<f64> = split.by_point.values().map(|own| own.value / all).collect();
    let mut shares = own.column.shares.clone();
    assert_eq!(shares.len(), by_point.len());
    let mut by_point = by_point;
    shares.sort_by(f64::total_cmp);
    by_point.sort_by(f64::total_cmp);
    for (rows, steps) in shares.iter().zip(&by_point) {
        assert!((rows - steps).abs() < 2e-3, "{shares:?} {by_point:?}");
    }
    // The column passes the wedge by the bolster's amplitude.
    let moved: Vec<f64> = own.column.moved.iter().map(|own| own[0]).collect();
    let (low, high) = (
        moved.iter().copied().fold(f64::INFINITY, f64::min),
        moved.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
    // Squares are 0.079 in wide; the wedge sits higher than in the nominal layout by what its faces give.
    let (half, middle) = (0.5 * (high - low), 0.5 * (high + low));
    assert!(
        (half - 0.3).abs() < 0.04 && (0.0..0.06).contains(&middle),
        "{low} {high}"
    );
    let sum: f64 = own.column.moved.iter().map(|own| own[2]).sum();
    assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    // The pocket moves with the bolster: next to nothing there.
    assert!(
        own.slope.moved.iter().all(|own| own[0].abs() < 0.1),
        "{:?}",
        own.slope.moved
    );
}

/// Massless wedges have no faces.
#[test]
fn limits_massless_wedges_have_no_faces_that_wear() {
    let summary = run("[wedge]\nkind = \"massless\"");
    assert_eq!(summary.wedge_wear, None);
}

#[test]
fn input_laws_of_wear() {
    for (more, expected) in [
        ("[damage]\nwedge_coefficient = -1", "wedge_coefficient"),
        ("[damage]\nwedge_hardness = \"2000\"", "wedge_hardness"),
        ("[damage]\nwear_slow = 1e-4", "wear_slow"),
    ] {
        let words = parse(more).unwrap_err();
        assert!(words.contains(expected), "{more}: {words}");
    }
}
