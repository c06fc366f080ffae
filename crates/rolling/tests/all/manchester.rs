//! reproduction: vehicle 1 of the Manchester benchmarks through the elements on the core, against its
//! matrices by themselves.

use crate::common;
use common::manchester::{bounce, critical, least_by_itself, least_on_the_core, natural};

/// Eighteen natural frequencies on wheelsets that are held.
#[test]
fn reproduction_natural_frequencies_of_manchester_vehicle_1() {
    let found = natural();
    assert_eq!(found.len(), 18);
    for own in &found {
        println!("{}: {} Hz, {} expected", own.name, own.found, own.expected);
        assert!(
            (own.found / own.expected - 1.0).abs() < 1e-5,
            "{}: {} Hz, {} expected",
            own.name,
            own.found,
            own.expected
        );
    }
    let body = found.iter().find(|own| own.name == "body bounce").unwrap();
    assert!(
        (body.found / bounce() - 1.0).abs() < 1e-6,
        "{} and {} Hz",
        body.found,
        bounce()
    );
}

/// Growth and frequency of the least damped vibration over speed and conicity, and critical speeds.
#[test]
fn reproduction_hunting_of_manchester_vehicle_1() {
    for (conicity, speed) in [(0.1, 30.0), (0.2, 60.0), (0.4, 90.0)] {
        let (found, expected) = (
            least_on_the_core(conicity, speed),
            least_by_itself(conicity, speed),
        );
        println!("{conicity} {speed} {found:?} {expected:?}");
        assert!(
            (found[0] - expected[0]).abs() < 1e-4 * expected[1],
            "{found:?} {expected:?}"
        );
        assert!(
            (found[1] / expected[1] - 1.0).abs() < 1e-4,
            "{found:?} {expected:?}"
        );
    }
    let [[found, hertz], [expected, other]] = critical(0.3);
    println!("{found} m/s {hertz} Hz {expected} {other}");
    assert!(
        (found / expected - 1.0).abs() < 1e-4,
        "{found} and {expected} m/s"
    );
    assert!((hertz / other - 1.0).abs() < 1e-3, "{hertz} and {other} Hz");
}
