//! The static table of a car against closed forms.

use study::car::columns::CarTable;
use study::car::static_table::static_table;
use study::car::{CarCase, builtin};
use study::case::Tables;
use study::statics::StaticTable;

use quantity::System as Units;

fn case(lines: &str) -> CarCase {
    let text = format!("model = \"car\"\n{lines}");
    CarCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

fn table(case: &CarCase) -> StaticTable {
    let own = CarTable::new(&case.parameters).unwrap();
    static_table(&own, &case.parameters, Units::Us).unwrap()
}

/// Asserts that a value is near what is expected of it, relative.
fn near(found: f64, expected: f64, within: f64, what: &str) {
    assert!(
        (found / expected - 1.0).abs() < within,
        "{what}: {found}, {expected} expected"
    );
}

const HEAVY: &str = "lading.kind = \"masses\"\nlading.masses = [{ weight = \"200400 lbf\", place = \
[\"30 in\", \"0 in\", \
                     \"87.8 in\"], inertia = [\"1.387e6 lbf in s^2\", \"1.258e7 lbf in s^2\", \"1.263e7 \
                     lbf in s^2\"] }]\n";

/// Weight and wheel loads are those of the masses; load and control coils together carry what stands on their
/// nest, less the wedges, whose weight their coils carry too; each group is down by its load over its
/// stiffness, and has the rest of its travel left.
#[test]
fn analytic_weights_loads_and_coils() {
    let coils = "truck.load_springs = { kind = \"D5\", outer = 7, inner = 7 }\n\
                 truck.control_coil.kind = \"B-353\"\n";
    // Stiffness and travel of a nest, lbf/in and in; whether control coils are of the catalog.
    let groups = (4.0 * 5369.5, 12_252.1 / 5369.5 + 1.406, false);
    let seven = (7.0 * (2234.0 + 1153.0), 3.6875, true);
    let off = format!("{HEAVY}{coils}");
    for (text, carried, forward, (stiffness, travel, named)) in [
        ("", 243_460.0, 0.0, groups),
        ("lading.kind = \"empty\"\n", 43_060.0, 0.0, groups),
        (coils, 243_460.0, 0.0, seven),
        (off.as_str(), 243_460.0, 200_400.0 / 243_460.0 * 30.0, seven),
    ] {
        let own = table(&case(text));
        let weight = carried + 2.0 * (1300.0 + 2.0 * 1150.5 + 200.0) + 4.0 * 2984.5;
        near(own.weight_on_rail.as_ref().unwrap().value, weight, 1e-6, "weight");
        assert!(!own.disturbed);
        for (truck, end) in [(1, 1.0), (2, -1.0)] {
            let share = 0.5 + end * forward / 486.0;
            let on_bolster = share * carried + 1300.0;
            let wheel = (on_bolster + 2.0 * 1150.5 + 200.0) / 4.0 + 0.5 * 2984.5;
            // A body that pitches presses one axle of a truck more than the other.
            for side in ["left", "right"] {
                let own =
                    [2 * truck - 1, 2 * truck].map(|axle| own.wheels[&format!("axle_{axle}_{side}")].value);
                near(0.5 * (own[0] + own[1]), wheel, 1e-3, text);
                near(own[0], own[1], 0.01, text);
            }
            for side in ["left", "right"] {
                let nest = &own.nests[&format!("truck_{truck}_{side}")];
                let wedges =
                    ["leading", "trailing"].map(|end| &own.wedges[&format!("truck_{truck}_{end}_{side}")]);
                let control = wedges.map(|own| own.control_coils.as_ref().unwrap());
                let sum = nest.load.value + control.iter().map(|own| own.load.value - 50.0).sum::<f64>();
                near(sum, 0.5 * on_bolster, 1e-3, text);
                let value = |own: &Option<study::summary::SummaryValue>| own.as_ref().unwrap().value;
                let down = nest.load.value / stiffness;
                near(value(&nest.deflection), down, 1e-3, "deflection");
                // A bolster that pitches leaves less at one end.
                let within = if forward == 0.0 { 1e-3 } else { 0.02 };
                near(value(&nest.reserve), travel - down, within, "reserve");
                near(
                    value(&nest.solid_load),
                    stiffness * travel,
                    within,
                    "load when solid",
                );
                for own in control {
                    let left = value(&own.reserve);
                    let (load, solid, down) = match named {
                        true => {
                            let height = left + 6.5625;
                            let load = 1358.4 * (11.1875 - height) + 577.6 * (11.5 - height);
                            (load, 6283.0 + 2852.0, load / (1358.4 + 577.6))
                        }
                        false => {
                            let free = 6303.0 / 1937.0 + 1.4085;
                            (1937.0 * (free - left), 1937.0 * free, free - left)
                        }
                    };
                    near(own.load.value, load, 1e-3, "control coil");
                    near(value(&own.solid_load), solid, 1e-3, "control coil, solid");
                    near(value(&own.deflection), down, 1e-3, "control coil, down");
                }
                assert!(
                    wedges
                        .iter()
                        .all(|own| own.column.value > 1000.0 && own.rise.value > 0.0)
                );
            }
        }
    }
}

/// The body sinks and pitches with its nests: couplers and center of gravity too.
#[test]
fn analytic_heights_follow_the_nests() {
    let (middle, off) = (table(&case("")), table(&case(HEAVY)));
    let height = |own: &StaticTable, name: &str| own.heights[name].value;
    let down = |own: &StaticTable, truck: usize| {
        own.nests[&format!("truck_{truck}_left")]
            .deflection
            .as_ref()
            .unwrap()
            .value
    };
    for own in [&middle, &off] {
        let nominal = 12_252.1 / 5369.5;
        let sunk = 0.5 * (down(own, 1) + down(own, 2)) - nominal;
        let mean = 0.5 * (height(own, "front_coupler") + height(own, "rear_coupler"));
        // Center plates, adapters and rails give besides, by some hundredths.
        let more = 32.5 - sunk - mean;
        assert!((0.0..0.12).contains(&more), "{more}");
        let lowered = 83.75 - height(own, "body_center_of_gravity");
        assert!((lowered - sunk - more).abs() < 0.02, "{lowered} {sunk} {more}");
    }
    let pitch = (height(&off, "rear_coupler") - height(&off, "front_coupler")) / 637.0;
    let nests = (down(&off, 1) - down(&off, 2)) / 486.0;
    assert!((pitch / nests - 1.0).abs() < 0.1, "{pitch} {nests}");
    assert!(height(&middle, "front_coupler") - height(&middle, "rear_coupler") < 1e-3);
}

/// The built-in car of 286,000 lbf says so, and stands within 0.05 in of the nominal height of its coils.
#[test]
fn reproduction_the_car_of_286_000_lbf() {
    let own = table(&builtin::case_with("car_286k_loaded", &[]).unwrap());
    let words = own.words().unwrap();
    assert!(words.contains("286000 lbf on rail, 35750 a wheel;"), "{words}");
    let rows = own.coils();
    let [nests, wedges] = rows.as_slice() else {
        panic!("{rows:?}");
    };
    let down = nests.values[1].unwrap();
    assert!((10.25 - down - 7.9685).abs() < 0.05, "{down}");
    assert!(wedges.values.iter().all(Option::is_some));
    assert!(nests.name.contains("each nest") && wedges.name.contains("each wedge"));
}

/// Groups that differ have rows of their own: those of one truck together where they are alike.
#[test]
fn limits_rows_of_groups_that_differ() {
    let names = |lines: &str| -> Vec<String> {
        table(&case(lines))
            .coils()
            .into_iter()
            .map(|own| own.name)
            .collect()
    };
    let along = names(HEAVY);
    assert_eq!(along.len(), 2 + 8, "{along:?}");
    assert!(along[0].ends_with("each nest, front truck"), "{along:?}");
    let broken =
        names("start.kind = \"nominal\"\nfront_truck.wedge.leading_left.control_coil.kind = \"nothing\"\n");
    assert_eq!(broken.len(), 1 + 4 + 1, "{broken:?}");
    assert!(
        broken
            .iter()
            .any(|own| own == "control coils of wedge leading left, front truck"),
        "{broken:?}"
    );
}

/// What irregularities and shifts do at the start is no part of the table; the nominal layout says that it is
/// not at rest.
#[test]
fn limits_the_table_is_that_of_straight_perfect_track() {
    let rough = table(&builtin::case_with("car_tangent_loaded", &[]).unwrap());
    let smooth = table(&case(""));
    for (name, own) in &smooth.wheels {
        near(rough.wheels[name].value, own.value, 1e-6, name);
    }
    let nominal = table(&case("start.kind = \"nominal\"\nlading.kind = \"empty\"\n"));
    assert!(nominal.disturbed);
    let words = nominal.words().unwrap();
    assert!(words.contains("7825 a wheel at rest"), "{words}");
}

/// The lading is raised until the whole car's center of gravity is where it shall be.
#[test]
fn analytic_a_center_of_gravity_of_98_inches() {
    let own = case("lading.center_of_gravity = \"98 in\"\n");
    let parameters = &own.parameters;
    let trucks = 2.0 * (1300.0 * 22.0 + (2.0 * 1150.5 + 200.0 + 2.0 * 2984.5) * 18.0);
    let lading = parameters.lading[0].place[2] / 0.0254;
    let center = (200_400.0 * lading + 43_060.0 * 65.0 + trucks) / 263_000.0;
    near(center, 98.0, 1e-9, "center of gravity");
    let again = CarCase::parse("case.toml", own.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters.lading, parameters.lading);
}
