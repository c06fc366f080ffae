//! `[couplers]`: what the keys set, and what is told of doubtful ones.

use car::{Course, Direction};
use mechanics::motion::Motion;
use study::car::CarCase;
use study::case::Tables;

use crate::problems::in_words;

const POUND_FORCE: f64 = 4.448_221_615_260_5;

fn read(set: &[&str]) -> Result<CarCase, study::case::CaseError> {
    let set: Vec<String> = set.iter().map(|own| (*own).to_owned()).collect();
    CarCase::parse("case.toml", "model = \"car\"\n", Tables::nowhere(), &set)
}

/// Keys of both ends, and over them those of one; the complete case reads back to the same.
#[test]
fn input_keys_of_couplers() {
    let own = read(&[
        "couplers.force=50 kip",
        "couplers.trailing.over_distance=[[\"100 ft\", \"0 lbf\"], [\"200 ft\", \"-20 kip\"]]",
        "couplers.trailing.direction=angle",
        "couplers.trailing.angle=-2 deg",
        "couplers.length=30 in",
    ])
    .unwrap();
    let [leading, trailing] = &own.parameters.couplers.ends;
    let force = 50e3 * POUND_FORCE;
    assert!(
        matches!(leading.course, Course::Time(Motion::Constant(own)) if (own / force - 1.0).abs() < 1e-12)
    );
    assert_eq!(leading.direction, Direction::LikeNeighbor);
    let Course::Distance(curve) = &trailing.course else {
        panic!("{trailing:?}");
    };
    for (feet, kip) in [(0.0, 0.0), (150.0, -10.0), (200.0, -20.0), (900.0, -20.0)] {
        let found = curve.evaluate(feet * 0.3048);
        assert!(
            (found - kip * 1e3 * POUND_FORCE).abs() < 1e-6 * force,
            "{feet} ft: {found} N"
        );
    }
    let Direction::Angle(angle) = trailing.direction else {
        panic!("{trailing:?}");
    };
    assert!((angle.to_degrees() + 2.0).abs() < 1e-9);
    assert!((own.parameters.couplers.pivot() - (318.5 - 30.0) * 0.0254).abs() < 1e-12);
    let again = CarCase::parse("again.toml", own.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.to_toml(), own.to_toml());
    assert_eq!(again.parameters.couplers, own.parameters.couplers);
    assert!(read(&[]).unwrap().doubts.is_empty());
}

#[test]
fn input_mistakes_of_couplers_are_named() {
    for (set, words) in [
        (
            vec![
                "couplers.force=5 kip",
                "couplers.over_distance=[[\"0 ft\", \"0 lbf\"], [\"9 ft\", \"1 lbf\"]]",
            ],
            "a coupler has a force or one over distance",
        ),
        (
            vec!["couplers.angle=3 deg"],
            "has no effect: the coupler points to a neighbor",
        ),
        (
            vec!["couplers.force=5 kip", "couplers.length=330 in"],
            "do not fit a car of 637.0 in",
        ),
        (vec!["couplers.force=5 in"], "couplers.force"),
        (vec!["couplers.swing=0 deg"], "couplers.swing"),
    ] {
        let told = in_words(read(&set).unwrap_err().problems());
        assert!(told.contains(words), "{set:?}: {told}");
    }
}

#[test]
fn limits_doubtful_couplers_are_told() {
    let curve = "track.segments=[{ tangent = \"300 ft\" }, { spiral = \"100 ft\" }, \
                 { curve = \"900 ft\", degree = \"30 deg\", direction = \"left\" }]";
    for (set, words) in [
        (
            vec!["couplers.force=1.2e6 lbf"],
            "1200000 lbf of buff, more than the 1000000 lbf",
        ),
        (
            vec!["couplers.force=-7e5 lbf"],
            "700000 lbf of draft, more than the 630000 lbf",
        ),
        (
            vec!["couplers.force=1 kip", "couplers.length=90 in"],
            "within the truck centers at 243.0 in",
        ),
        (
            vec![
                "couplers.force=1 kip",
                "couplers.direction=angle",
                "couplers.angle=15 deg",
            ],
            "stands at 15.0 deg to the body, more than the 13.0 deg",
        ),
        (
            vec!["couplers.leading.force=90 kip"],
            "the speed can be off by 9.0 mph",
        ),
        (
            vec![
                "couplers.force=1 kip",
                "wheels.geometry=linear",
                "track={ segments = [{ tangent = \"1500 ft\" }], support = { kind = \"rigid\" } }",
            ],
            "linear wheels, which have no flanges",
        ),
        (
            vec!["couplers.force=1 kip", "couplers.swing=5 deg", curve],
            "stands at 7.9 deg to the body",
        ),
    ] {
        let own = read(&set).unwrap_or_else(|error| panic!("{set:?}: {}", in_words(error.problems())));
        assert!(
            own.doubts.iter().any(|doubt| doubt.contains(words)),
            "{set:?}: {:?}",
            own.doubts
        );
    }
    // The same force at both ends is balanced, and 10 deg are within the swing.
    let quiet = read(&["couplers.force=200 kip"]).unwrap();
    assert!(quiet.doubts.is_empty(), "{:?}", quiet.doubts);
}
