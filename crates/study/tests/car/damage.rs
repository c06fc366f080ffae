//! analytic, input: damage of wheels and rails over a car's run.

use study::car::CarCase;
use study::case::Tables;
use study::run::Run;

use crate::problems::in_words;

fn parse(more: &str) -> Result<CarCase, String> {
    let text = format!(
        "model = \"car\"\n[track]\nsegments = [{{ tangent = \"60 ft\" }}, {{ spiral = \"150 ft\" }}, {{ \
         curve = \"400 ft\", degree = \"8 deg\", superelevation = \"3 in\" }}]\n[speed]\nvalue = \"25 \
         mph\"\n[start]\nsettle = \"0 s\"\n[simulation]\nduration = \"8 s\"\noutput_interval = \"5 \
         ms\"\nrelative_tolerance = 1e-4\n{more}"
    );
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).map_err(|error| in_words(error.problems()))
}

/// With one coefficient everywhere the worn volume is k/H ∫ N |v| dt, with the energy that the ledger says
/// creep took, over the friction; a curve wears the flange of the leading outer wheel most.
#[test]
fn analytic_worn_volume_is_that_of_the_ledger() {
    let alike = "[damage]\nwear_slow = 2e-3\nwear_middling = 2e-3\nwear_fast = 2e-3\nwear_pressed = 2e-3";
    let case = parse(alike).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.stopped);
    let damage = result.summary.damage.as_ref().unwrap();
    let speed = result.column("speed").unwrap();
    let way = damage.distance.value * 0.3048;
    let expected: f64 = speed[1..].iter().map(|speed| 5e-3 * speed).sum();
    assert!((way / expected - 1.0).abs() < 1e-6, "{way} {expected}");
    let entries = &result.summary.ledger.entries;
    for (axle, side) in [(1, "left"), (1, "right"), (4, "right")] {
        // Contact damping, which the ledger's loss has too, takes next to nothing on perfect track.
        let element = format!("wheel_{axle}_{side}");
        let mut of_wheel = entries
            .iter()
            .filter(|(name, _)| name.contains(&element) && name.contains("loss"));
        let (_, loss) = of_wheel.next().unwrap();
        let energy = loss.value * 0.112_984_829;
        let mass = 7850.0 * 2e-3 * energy / (0.4 * 3e9);
        let expected = mass * 1e5 * 1609.344 / way;
        let own = &damage.wheels[&format!("axle_{axle}_{side}")];
        let found = own.worn_mass.value * 0.453_592_37;
        assert!(
            (found / expected - 1.0).abs() < 1e-3,
            "{axle} {side}: {found} {expected}"
        );
        // The same by depths along the normals over the profile, each on a place that is longer than it is
        // wide.
        let depths: f64 = own.profile.iter().map(|place| place.depth * 0.0254).sum();
        let by_depth = 7850.0 * depths * place_width(&own.profile) * std::f64::consts::TAU * 18.0 * 0.0254;
        let share = by_depth / expected;
        assert!((0.2..1.001).contains(&share), "{by_depth} {expected}");
    }
    // Rails lose what wheels do: over 1,000,000 tons, as a depth over an inch.
    let on_left: f64 = (1..=4)
        .map(|axle| damage.wheels[&format!("axle_{axle}_left")].worn_mass.value)
        .sum();
    let area = on_left * 0.453_592_37 / (7850.0 * 1e5 * 1609.344);
    let tons = 1e6 * 2000.0 * 4.448_221_615_260_5 / case.parameters.weight();
    let found = damage.rails["left"].worn_over_an_inch.value * 0.0254 * 0.0254;
    assert!(
        (found / (area * tons) - 1.0).abs() < 1e-9,
        "{found} {}",
        area * tons
    );
    // The curve is to the left: the outer leading wheel wears on its flange, which is on the gauge side.
    let worn = |name: &str| damage.wheels[name].worn_mass.value;
    assert!(
        worn("axle_1_right") > 2.0 * worn("axle_2_right"),
        "{}",
        worn("axle_1_right")
    );
    assert!(
        damage.wheels["axle_1_right"].place.value < -0.8,
        "{:?}",
        damage.wheels["axle_1_right"].place
    );
    assert!(damage.rails["right"].largest_depth.value > damage.rails["left"].largest_depth.value);
    assert!(
        damage.creep_resistance.value > 100.0,
        "{:?}",
        damage.creep_resistance
    );
}

fn place_width(places: &[study::damage::PlaceDamage]) -> f64 {
    let steps = places.windows(2).map(|pair| (pair[1].y - pair[0].y) * 0.0254);
    steps.fold(f64::INFINITY, f64::min)
}

#[test]
fn input_keys_of_damage() {
    let case =
        parse("[damage]\nhardness = \"3500 MPa\"\nfatigue_from = \"20 N\"\nfatigue_end = \"200 N\"").unwrap();
    assert_eq!(case.damage.wear.hardness, 3.5e9);
    for (found, expected) in case
        .damage
        .fatigue
        .points
        .iter()
        .zip([[20.0, 0.0], [65.0, 1.0], [200.0, 0.0]])
    {
        assert!(
            (found[0] - expected[0]).abs() < 1e-9 && found[1] == expected[1],
            "{found:?}"
        );
    }
    let again = CarCase::parse("case.toml", case.to_toml_embedded(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(case.damage, again.damage);
    for (section, expected) in [
        ("[damage]\nhardness = \"0 MPa\"", "greater than zero"),
        ("[damage]\nhardness = 3e9", "unit"),
        ("[damage]\nwear_slow = -1", "zero"),
        ("[damage]\nmiddling_from = \"0.9 m/s\"", "end before they begin"),
        ("[damage]\nfatigue_from = \"70 N\"", "do not rise"),
        ("[damage]\nwear = 1", "wear"),
    ] {
        let words = parse(section).unwrap_err();
        assert!(words.contains(expected), "{section}\n{words}");
    }
}
