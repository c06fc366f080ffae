//! input, limits: cars on rails that the wheels of a truck share as beams.

use study::car::CarCase;
use study::case::Tables;
use study::run::Run;

use crate::problems::in_words;

fn parse(support: &str) -> Result<CarCase, String> {
    let text = format!(
        "model = \"car\"\n[track]\nsegments = [{{ tangent = \"200 ft\" }}]\nsupport = {{ {support} }}\n\
         [speed]\nvalue = \"5 m/s\"\n[start]\nsettle = \"0.1 s\"\n[simulation]\nduration = \"0.5 s\"\n\
         output_interval = \"10 ms\""
    );
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).map_err(|error| in_words(error.problems()))
}

/// Columns and statistics of rails that give way come with beams alone; what is read is written and read
/// again.
#[test]
fn limits_columns_of_rails_come_with_beams() {
    let columns = [
        "axle_2_right_rail_roll",
        "axle_3_gauge_widening",
        "truck_1_left_side_l_over_v",
    ];
    let statistics = ["axle_2_right_rail_roll_largest", "axle_3_gauge_widening_largest"];
    for (kind, has) in [("sprung", false), ("shared_beams", true)] {
        let case = parse(&format!("kind = \"{kind}\"")).unwrap();
        let again = CarCase::parse("case.toml", case.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
        assert_eq!(case.parameters.support, again.parameters.support);
        let result = Run::new(&case).unwrap().finish(|_| ());
        assert!(result.summary.complete, "{:?}", result.summary.stopped);
        for name in columns {
            assert_eq!(result.column(name).is_some(), has, "{kind} {name}");
        }
        for name in statistics {
            let found = result.summary.statistics.get(name);
            assert_eq!(found.is_some(), has, "{kind} {name}");
        }
        if has {
            // At rest coned wheels spread their rails; rolling, spin creep pulls them together.
            let widening = result.column("axle_3_gauge_widening").unwrap();
            assert!(widening[0] > 1e-5 && widening[50] < widening[0], "{widening:?}");
            assert!(widening.iter().all(|own| own.abs() < 1e-3), "{widening:?}");
        }
    }
}

#[test]
fn input_numbers_of_beams() {
    let support = "kind = \"shared_beams\", vertical_bending = 6.4e6, lateral_bending = 1e6, torsion = \
                   1.7e5, roll_stiffness = 2e6, height = \"172 mm\", base = \"4 mm\", vertical_stiffness = \
                   \"60 MN/m\"";
    let case = parse(support).unwrap();
    let own = case.parameters.support.as_ref().unwrap();
    let beam = own.beam.as_ref().unwrap();
    assert_eq!(beam.bending, [1e6, 6.4e6]);
    assert_eq!(
        [beam.torsion, beam.roll_stiffness, own.stiffness[1]],
        [1.7e5, 2e6, 6e7]
    );
    for (support, expected) in [
        ("kind = \"beams\"", "shared_beams"),
        ("kind = \"shared_beams\", torsion = 0", "positive"),
        (
            "kind = \"shared_beams\", height = \"2 m\"",
            "between 10 mm and 1 m",
        ),
        ("kind = \"sprung\", torsion = 1e5", "torsion"),
    ] {
        let words = parse(support).unwrap_err();
        assert!(words.contains(expected), "{support}\n{words}");
    }
}
