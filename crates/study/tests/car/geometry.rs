//! Keys of geometry and of coils in cars and trucks: what they set, and what is told of doubtful ones.

use study::car::CarCase;
use study::case::Tables;
use study::run::Run;
use study::truck::TruckCase;

use crate::problems::in_words;

const INCH: f64 = 0.0254;

fn read(set: &[&str]) -> Result<CarCase, study::case::CaseError> {
    let set: Vec<String> = set.iter().map(|own| (*own).to_owned()).collect();
    CarCase::parse("case.toml", "model = \"car\"\n", Tables::nowhere(), &set)
}

/// Keys reach the trucks of cars and single trucks alike, and are written into the complete case.
#[test]
fn input_places_of_a_truck() {
    let keys = [
        ("wheelbase", "72 in"),
        ("nest_distance", "78 in"),
        ("journal_distance", "80 in"),
        ("axle_height", "19 in"),
        ("wedge.center_height", "18.5 in"),
        ("side_frame.column_distance", "20.5 in"),
        ("load_springs.seat_height", "12 in"),
        ("load_springs.half_length", "4 in"),
        ("load_springs.half_width", "5 in"),
        ("gib.height", "17 in"),
        ("lands.height", "17.5 in"),
        ("lands.half_width", "6.5 in"),
        ("lands.half_height", "2.5 in"),
        ("adapter.height", "23.5 in"),
        ("adapter.point_distance", "2.5 in"),
        ("adapter.stop_distance", "1.5 in"),
    ];
    let of_car: Vec<String> = keys
        .iter()
        .map(|(key, value)| format!("truck.{key}={value}"))
        .collect();
    let car = CarCase::parse("case.toml", "model = \"car\"\n", Tables::nowhere(), &of_car).unwrap();
    let of_truck: Vec<String> = keys
        .iter()
        .map(|(key, value)| match key.contains('.') {
            true => format!("{key}={value}"),
            false => format!("truck.{key}={value}"),
        })
        .collect();
    let truck = TruckCase::parse("case.toml", "model = \"truck\"\n", Tables::nowhere(), &of_truck).unwrap();
    for own in [&car.parameters.trucks[1], &truck.parameters] {
        let at = &own.geometry;
        let third = 6.125 * (32.0_f64).to_radians().tan() / 3.0;
        let expected = [
            (at.wheelbase, 72.0),
            (at.nest_distance, 78.0),
            (at.journal_distance, 80.0),
            (at.axle_height, 19.0),
            (at.wedge_height, 18.5),
            (at.wedge_distance, 10.25 - third),
            (at.seat_height, 12.0),
            (at.gib_height, 17.0),
            (at.land_height, 17.5),
            (at.lands[0], 6.5),
            (at.lands[1], 2.5),
            (at.adapter_height, 23.5),
            (at.adapter[0], 2.5),
            (at.adapter[1], 1.5),
            (own.load_coils[1][3].place[0], -4.0),
            (own.load_coils[1][3].place[1], -5.0),
        ];
        for (found, inches) in expected {
            assert!((found - inches * INCH).abs() < 1e-12, "{found} {inches}");
        }
    }
    let again = CarCase::parse("case.toml", car.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters.trucks, car.parameters.trucks);
    assert!(Run::new(&car).is_ok());
}

/// What cannot be is refused, with what to look at.
#[test]
fn input_geometry_that_cannot_be_is_refused() {
    for (set, expected, advice) in [
        (
            "car.truck_distance=60 in",
            "the trucks overlap",
            "car.truck_distance",
        ),
        (
            "truck.wheelbase=30 in",
            "wheels of a truck overlap",
            "66 to 72 in",
        ),
        (
            "truck.wedge.column_wear=5 in",
            "more than there is of the wedge",
            "unit",
        ),
        ("truck.side_frame.column_distance=2 in", "leave no room", "20 in"),
        ("rails.gauge=66 in", "do not reach both rails", "gauge"),
        (
            "lading.center_of_gravity=8 in",
            "below the rails",
            "above the top of rail",
        ),
        (
            "truck.load_springs.kind=D9",
            "there are no coils \"D9\"",
            "[coils]",
        ),
        (
            "truck.control_coil.kind=B353",
            "there are no coils \"B353\"",
            "B-353",
        ),
        ("truck.load_springs.outer=8", "seven places", "up to 7"),
        (
            "truck.load_springs.outer=6.5",
            "`truck.load_springs.outer` is 6.5",
            "whole number",
        ),
        (
            "truck.load_springs={ kind = \"D7\", height = \"11 in\" }",
            "loose in the nominal layout",
            "height",
        ),
        (
            "truck.load_springs={ kind = \"D7\", height = \"6 in\" }",
            "solid in the nominal layout",
            "height",
        ),
        (
            "truck.load_springs={ kind = \"D5\", stiffness = \"1 lbf/in\" }",
            "a key of groups",
            "truck.load_springs.nest",
        ),
        (
            "truck.load_springs={ kind = \"D5\", preload = \"12 kip\", height = \"8 in\" }",
            "say the same",
            "preload",
        ),
        (
            "coils.own=[{ name = \"x\" }]",
            "neither outer nor inner",
            "free_height",
        ),
        (
            "coils.own=[{ name = \"shear\", outer = { free_height = \"2 in\", solid_height = \"1 in\", \
             stiffness = \"1 \
             lbf/in\" } }]",
            "cannot have a kind named \"shear\"",
            "of its own",
        ),
        (
            "coils.own=[{ name = \"x\", outer = { free_height = \"1 in\", solid_height = \"2 in\", \
             stiffness = \"1 \
             lbf/in\" } }]",
            "is not above its solid height",
            "exchanged",
        ),
    ] {
        let error = read(&[set]).unwrap_err();
        let words = in_words(error.problems());
        assert!(words.contains(expected), "{set}: {words}");
        assert!(words.contains(advice), "{set}: {words}");
    }
    let both = [
        "truck.wedge.distance=8 in",
        "truck.side_frame.column_distance=20 in",
    ];
    let words = in_words(read(&both).unwrap_err().problems());
    assert!(words.contains("say the same"), "{words}");
}

/// What nobody builds is told with what to do; a usual car is told nothing.
#[test]
fn input_doubtful_geometry_is_told() {
    assert_eq!(read(&[]).unwrap().doubts, Vec::<String>::new());
    for (set, expected) in [
        ("car.height=8 in", "below the center plates at 30.0 in"),
        (
            "lading={ kind = \"empty\", center_of_gravity = \"98 in\" }",
            "the car carries nothing",
        ),
        ("truck.nest_distance=79 cm", "truck.nest_distance is 31.10 in"),
        ("truck.axle_height=14 in", "it stands 4.00 in higher"),
        ("wheels.radius=14 in", "it stands 4.00 in lower"),
        ("truck.wedge.distance=60 in", "beyond the axles"),
        ("truck.wedge.distance=1 in", "wedges overlap"),
        ("truck.adapter.height=15 in", "below the axles"),
        (
            "lading={ kind = \"masses\", masses = [{ name = \"tank\", weight = \"100 kip\", place = \
             [\"0 in\", \"0 in\", \"8 \
             in\"], inertia = [\"1e6 lbf in s^2\", \"1e7 lbf in s^2\", \"1e7 lbf in s^2\"] }] }",
            "the lading \"tank\" is 8.0 in above the top of rail",
        ),
        ("car.torsion_stiffness=1e4 lbf in", "softer than any car's"),
        ("car.torsion_stiffness=5e10 lbf in", "as good as rigid"),
        (
            "truck.side_bearing={ kind = \"constant_contact\", hysteresis = \"4000 lbf\" }",
            "is 67 % of its preload",
        ),
        (
            "truck.side_bearing={ kind = \"constant_contact\", hysteresis = \"600 lbf\", \
             hysteresis_stiffness = \"3000 lbf/in\" }",
            "slips only after 0.200 in of its travel of 0.625 in",
        ),
        (
            "truck.side_bearing={ kind = \"constant_contact\", hysteresis = \"600 lbf\", \
             hysteresis_damping = \"3000 lbf s/in\" }",
            "lags by 0.100 s",
        ),
    ] {
        let doubts = read(&[set]).unwrap().doubts;
        assert!(
            doubts.iter().any(|own| own.contains(expected)),
            "{set}: {doubts:?}"
        );
    }
    let bearing = "truck.side_bearing={ kind = \"constant_contact\", hysteresis = \"600 lbf\" }";
    for set in [bearing, "car.torsion_stiffness=1e8 lbf in"] {
        assert_eq!(read(&[set]).unwrap().doubts, Vec::<String>::new());
    }
}

/// Wedge angles that no truck has are told of cars and of single wedges.
#[test]
fn input_wedge_angles_that_none_have_are_told() {
    let short = "simulation.duration=0.02 s";
    let own = read(&["truck.wedge.angle=10 deg", short]).unwrap();
    let summary = Run::new(&own).unwrap().finish(|_| ()).summary;
    let told = |all: &[String]| {
        all.iter()
            .filter(|own| own.contains("none that trucks have"))
            .count()
    };
    assert_eq!(told(&summary.warnings), 1, "{:?}", summary.warnings);
    let wedge = study::case::Case::parse(
        "case.toml",
        "[wedge]\nangle = \"5 deg\"\n[simulation]\nduration = \"0.1 s\"\n",
        Tables::nowhere(),
        &[],
    )
    .unwrap();
    let summary = Run::new(&wedge).unwrap().finish(|_| ()).summary;
    assert_eq!(told(&summary.warnings), 1, "{:?}", summary.warnings);
}

/// Coils by their names, in nests and under wedges, one wedge with others: the complete case reads back.
#[test]
fn input_coils_by_name_read_back() {
    let text = "model = \"car\"\n[[coils.own]]\nname = \"soft\"\nsource = \"drawing 12\"\n\
                outer = { free_height = \"10.5 in\", solid_height = \"6.5 in\", stiffness = \"3000 \
                lbf/in\" }\n\
                [truck]\nload_springs = { kind = \"soft\", outer = 6 }\n\
                [truck.control_coil]\nkind = \"B-432\"\n\
                [truck.wedge.leading_left.control_coil]\nkind = \"B-353\"\ninner = 0\n";
    let own = CarCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap();
    let [front, _] = &own.parameters.trucks;
    let total: f64 = front.load_coils[0].iter().map(|coil| coil.spring.stiffness).sum();
    let stiffness = 4.448_221_615_260_5 / INCH;
    assert!((total / (18_000.0 * stiffness) - 1.0).abs() < 1e-12);
    let rates = [0, 1].map(|wedge: usize| match &front.wedges[wedge].control_coil {
        truck::ControlCoil::Shear(spring) => spring.stiffness / stiffness,
        other => panic!("{other:?}"),
    });
    assert!(
        (rates[0] - 1358.4).abs() < 1e-9 && (rates[1] - 1489.6).abs() < 1e-9,
        "{rates:?}"
    );
    let again = CarCase::parse("case.toml", own.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters.trucks, own.parameters.trucks);
    assert!(own.to_toml().contains("drawing 12"));
}

/// The picture in the documents is that of the default values, and names keys that there are.
#[test]
fn reproduction_the_picture_of_the_layout_is_up_to_date() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/figures/truck_layout.svg");
    let drawn = std::fs::read_to_string(path).unwrap();
    assert_eq!(
        drawn,
        crate::layout::picture(),
        "cargo run --release -p study --example truck_layout writes it"
    );
    let text = read(&[]).unwrap().to_toml().to_owned();
    for key in [
        "wheelbase",
        "nest_distance",
        "journal_distance",
        "axle_height",
        "seat_height",
        "half_length",
        "point_distance",
        "coupler_distance",
    ] {
        assert!(drawn.contains(key) && text.contains(key), "{key}");
    }
}
