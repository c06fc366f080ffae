//! input, limits: friction of wheel on rail by zone, rail, distance, slip.

use std::path::Path;

use car::Wheels;
use study::assessment::conditions::Condition;
use study::car::CarCase;
use study::case::Tables;
use study::run::Run;
use wheelrail::contact::{ContactLaw, CreepLaw};
use wheelrail::friction::DRY;

use crate::problems::in_words;

fn case(lines: &str, set: &[String]) -> CarCase {
    let text = format!("model = \"car\"\n{lines}\n");
    CarCase::parse("case.toml", &text, Tables::nowhere(), set)
        .unwrap_or_else(|error| panic!("{}", in_words(error.problems())))
}

fn laws(case: &CarCase) -> &[ContactLaw; 2] {
    match &case.parameters.wheels {
        Wheels::OnRails(own) => &own.laws,
        Wheels::Linear { .. } => panic!("profiles are expected"),
    }
}

/// What is said of a rail goes before what is said of both; the case written and read again is the same.
#[test]
fn input_friction_of_zones_and_rails() {
    let text = "[wheels]\nfriction = 0.45\n[friction]\ngauge_face = 0.2\nratio = 0.4\nslip_factor = 0.4\n\
                over_distance = [{ from = \"500 ft\", tread = 0.3 }, \
                { from = \"200 m\", tread = 0.45, gauge_face = 0.45 }]\n\
                [friction.right]\ntread = 0.15\nover_distance = []";
    let one = case(text, &[]);
    let again = CarCase::parse("again.toml", one.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
    for own in [&one, &again] {
        let [left, right] = laws(own);
        assert_eq!(
            [left.friction.zones.tread, left.friction.zones.gauge_face],
            [0.45, 0.2]
        );
        assert_eq!(
            [right.friction.zones.tread, right.friction.zones.gauge_face],
            [0.15, 0.2]
        );
        assert_eq!(left.friction.falling, Some(DRY));
        assert!(right.friction.over.is_none());
        let over = left.friction.over.as_ref().unwrap();
        let places: Vec<f64> = over.iter().map(|(place, _)| *place).collect();
        for (place, expected) in places.iter().zip([152.4, 153.4, 200.0, 201.0]) {
            assert!((place - expected).abs() < 1e-9);
        }
        assert_eq!(
            [over[1].1.tread, over[1].1.gauge_face, over[3].1.gauge_face],
            [0.3, 0.2, 0.45]
        );
        assert!(matches!(left.creep, CreepLaw::Polach(own) if own.slip == 0.4 && own.adhesion == 1.0));
    }
    let plain = case("", &[]);
    assert_eq!(laws(&plain)[0], laws(&plain)[1]);
    let spelled = case("[friction]\ngauge_face = 0.4", &[]);
    assert_eq!(laws(&spelled), laws(&plain));
}

/// The built-in conditions of friction set what they say. In a left curve friction raises L/V of the leading
/// outer wheel, and oil on its rail alone changes it.
#[test]
fn limits_conditions_of_friction() {
    let of = |name: &str| Condition::chosen(&[name.to_owned()], true).unwrap().remove(0).set;
    let zones = |name: &str| {
        let own = case("", &of(name));
        laws(&own)
            .each_ref()
            .map(|law| [law.friction.zones.tread, law.friction.zones.gauge_face])
    };
    assert_eq!(zones("dry_rail"), [[0.5; 2]; 2]);
    assert_eq!(zones("top_of_rail"), [[0.35; 2]; 2]);
    assert_eq!(zones("gauge_face_lubricated"), [[0.4, 0.15]; 2]);
    assert_eq!(zones("left_dry_right_oiled"), [[0.5; 2], [0.15; 2]]);
    let curve = "[track]\nsegments = [{ tangent = \"100 ft\" }, { spiral = \"100 ft\" }, \
                 { curve = \"400 ft\", degree = \"7.5 deg\", superelevation = \"3 in\", \
                 direction = \"left\" }]\n\
                 [speed]\nvalue = \"25 mph\"\n[simulation]\n\
                 duration = \"10 s\"";
    let ratio = |set: &[String]| {
        let own = case(curve, set);
        let result = Run::new(&own).unwrap().finish(|_| ());
        assert!(result.summary.complete, "{:?}", result.summary.stopped);
        let place = result
            .columns
            .iter()
            .position(|own| own.name == "axle_1_right_l_over_v")
            .unwrap();
        *result.values[place].last().unwrap()
    };
    let (usual, dry) = (ratio(&[]), ratio(&of("dry_rail")));
    let oiled = ratio(&of("left_dry_right_oiled"));
    assert!(dry > 1.02 * usual, "{usual} {dry}");
    assert!((oiled / dry - 1.0).abs() > 0.01, "{oiled} {dry}");
}

#[test]
fn input_friction_that_is_wrong_is_told() {
    for (lines, expected) in [
        ("[friction]\ngauge_face = -0.1", "gauge_face"),
        ("[friction]\ntread = 0.3", "there is no key `tread` in `friction`"),
        ("[friction]\nratio = 1.5", "between 0 and 1"),
        ("[friction]\nover_distance = [{ tread = 0.2 }]", "from"),
        (
            "[friction]\nover_distance = [{ from = \"1 ft\", tread = -1 }]",
            "tread",
        ),
        (
            "[friction]\nover_distance = [{ from = \"9 m\", tread = 0.2 }, \
             { from = \"9.5 m\", tread = 0.3 }]",
            "places must rise by more than 1 m",
        ),
        (
            "[friction]\nslip_factor = 0.4\n[wheels]\ncreep = \"fastsim\"",
            "of Polach's creep law alone",
        ),
        ("[friction.middle]\ntread = 0.3", "middle"),
    ] {
        let text = format!("model = \"car\"\n{lines}\n");
        let error = CarCase::parse("case.toml", &text, Path::new(""), &[]);
        let Err(error) = error else { panic!("{lines}") };
        let words = in_words(error.problems());
        assert!(words.contains(expected), "{lines}\n{words}");
    }
}
