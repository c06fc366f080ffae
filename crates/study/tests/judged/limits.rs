//! Limits of plausibility of all built-in systems: none of a length is rounding.

use mechanics::plausibility::{LEAST_LENGTH_SHARE, Plausibility};
use quantity::Kind;
use study::car::builtin as cars;
use study::case::builtin as wedges;
use study::run::RunCase;
use study::truck::builtin as trucks;

/// Checks a case; returns the number of limits.
fn check<C: RunCase>(case: &C) -> usize {
    let mut beginning = case.begin().unwrap();
    let x = beginning.x.clone();
    let observer = Plausibility::new(&mut beginning.system, 0.0, &x);
    let mut scale: f64 = 0.0;
    for body in beginning
        .system
        .bodies()
        .iter()
        .filter(|body| !body.is_prescribed())
    {
        let inertia = body.inertia.iter().fold(0.0, |most: f64, own| most.max(*own));
        scale = scale.max(2.0 * (inertia / body.mass).sqrt());
    }
    let mut limits = 0;
    for (kind, location, limit) in observer.limits() {
        if kind.quantity() == Kind::Length {
            limits += usize::from(limit.is_finite());
            let place = location.describe(&beginning.system);
            assert!(
                limit >= LEAST_LENGTH_SHARE * scale,
                "{}: {kind:?} of {place}: {limit} m",
                case.name()
            );
        }
    }
    limits
}

#[test]
fn issue_047_no_limit_of_a_built_in_system_is_rounding() {
    let mut limits = 0;
    for name in wedges::names() {
        if let Ok(case) = wedges::case(name) {
            limits += check(&case);
        }
    }
    for name in trucks::names() {
        limits += check(&trucks::case_with(name, &[]).unwrap());
    }
    for settings in [
        &[][..],
        &["car.weight=\"5e6 lbf\""],
        &["wheels.radius=\"36 in\"", "truck.wheelbase=\"84 in\""],
        &["truck.adapter.kind=pad"],
    ] {
        let settings: Vec<String> = settings.iter().map(|own: &&str| (*own).to_owned()).collect();
        limits += check(&cars::case_with("car_tangent_loaded", &settings).unwrap());
    }
    assert!(limits > 1000, "{limits}");
}
