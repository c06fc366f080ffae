//! The variants of a study, against the methods' papers and the programs of others.

use study::design::{DIMENSIONS, LatinHypercube, Sobol, Value};
use study::models::AnyCase;

use super::common::{HEAD, study};

/// SciPy 1.17, `scipy.stats.qmc.Sobol(21, scramble=False, bits=52)`: dimensions 0, 1, 2, 5, 12, 20 of some
/// points.
const SCIPY: [(u64, [f64; 6]); 7] = [
    (1, [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]),
    (2, [0.75, 0.25, 0.25, 0.75, 0.25, 0.25]),
    (3, [0.25, 0.75, 0.75, 0.25, 0.75, 0.75]),
    (4, [0.375, 0.375, 0.625, 0.125, 0.375, 0.125]),
    (5, [0.875, 0.875, 0.125, 0.625, 0.875, 0.625]),
    (
        100,
        [0.4140625, 0.2578125, 0.7734375, 0.7421875, 0.4765625, 0.7578125],
    ),
    (
        1000,
        [
            0.2197265625,
            0.0966796875,
            0.5185546875,
            0.9072265625,
            0.1611328125,
            0.5224609375,
        ],
    ),
];

/// The same program: for each dimension the sum of `number * coordinate` over the first 1024 points.
const SCIPY_SUMS: [f64; DIMENSIONS] = [
    261_760.25, 262_016.25, 261_888.25, 261_760.25, 262_016.25, 261_760.25, 262_016.25, 261_760.25,
    261_760.25, 262_016.25, 262_016.25, 261_760.25, 261_888.25, 261_760.25, 261_888.25, 262_016.25,
    261_760.25, 261_760.25, 262_016.25, 262_016.25, 262_016.25,
];

#[test]
fn cross_code_sobol_points_are_those_of_scipy() {
    let sobol = Sobol::new(DIMENSIONS, None);
    for (number, expected) in SCIPY {
        let found = [0, 1, 2, 5, 12, 20].map(|dimension| sobol.coordinate(number, dimension));
        assert_eq!(found, expected, "point {number}");
    }
    for (dimension, expected) in SCIPY_SUMS.into_iter().enumerate() {
        let sum: f64 = (0..1024)
            .map(|number| number as f64 * sobol.coordinate(number, dimension))
            .sum();
        assert_eq!(sum, expected, "dimension {dimension}");
    }
}

/// Joe and Kuo's property A: of the first 2^d points each of the 2^d octants has one, for d up to their
/// dimensions that have it; and every dimension alone is evenly filled, shifted or not.
#[test]
fn analytic_sobol_points_fill_evenly() {
    for seed in [None, Some(7)] {
        let sobol = Sobol::new(DIMENSIONS, seed);
        for dimension in 0..DIMENSIONS {
            let mut parts: Vec<u64> = (0..256)
                .map(|number| (sobol.coordinate(number, dimension) * 256.0) as u64)
                .collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..256).collect::<Vec<u64>>(), "dimension {dimension}");
        }
        let mut octants: Vec<usize> = (0..8)
            .map(|number| {
                (0..3)
                    .map(|d| usize::from(sobol.coordinate(number, d) >= 0.5) << d)
                    .sum()
            })
            .collect();
        octants.sort_unstable();
        assert_eq!(octants, [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}

#[test]
fn analytic_a_latin_hypercube_has_each_part_once_in_each_dimension() {
    for runs in [1, 2, 3, 10, 97, 1000] {
        let hypercube = LatinHypercube::new(runs, 3);
        for dimension in 0..4 {
            let mut strata: Vec<u64> = (0..runs)
                .map(|number| {
                    let coordinate = hypercube.coordinate(number, dimension);
                    assert!((0.0..1.0).contains(&coordinate));
                    let stratum = (coordinate * runs as f64) as u64;
                    assert_eq!(stratum, hypercube.stratum(number, dimension));
                    stratum
                })
                .collect();
            strata.sort_unstable();
            assert_eq!(strata, (0..runs).collect::<Vec<u64>>());
        }
    }
}

/// The correlation of two dimensions of n points has a standard deviation of 1/√(n-1) if they are
/// independent.
#[test]
fn analytic_dimensions_of_a_latin_hypercube_are_not_correlated() {
    const RUNS: u64 = 2000;
    for seed in 0..5 {
        let hypercube = LatinHypercube::new(RUNS, seed);
        let centred = |number, dimension| hypercube.coordinate(number, dimension) - 0.5;
        let mean: f64 = (0..RUNS).map(|n| centred(n, 0) * centred(n, 1)).sum::<f64>() / RUNS as f64;
        let correlation = mean * 12.0;
        assert!(correlation.abs() < 4.0 / (RUNS as f64).sqrt(), "{correlation}");
        assert!(
            (0..RUNS).any(|n| hypercube.stratum(n, 0) != LatinHypercube::new(RUNS, seed + 1).stratum(n, 0))
        );
    }
}

/// Keys of a truck's single wedges are varied as those of all; their toes too go through zero.
#[test]
fn analytic_a_toe_of_one_wedge_is_varied_through_zero() {
    let study = study(
        "case = \"truck_vertical_variable\"\nsampling = \"full_factorial\"\n[vary]\n\
         wedge.trailing_right.toe = { from = \"0.3 deg in\", to = \"0.3 deg out\", count = 3 }\n\
         wedge.leading_left.friction.column = [0.2, 0.3]\n",
    );
    let toes = [0, 2, 4].map(|number| study.overrides(number)[0].clone());
    assert_eq!(
        toes,
        ["0.3 deg in", "0 deg", "0.3 deg out"].map(|toe| format!("wedge.trailing_right.toe=\"{toe}\""))
    );
    let AnyCase::Truck(case) = study.case(5).unwrap() else {
        unreachable!("a truck's study")
    };
    let wedges = &case.parameters.wedges;
    assert!((wedges[3].toe - 0.3_f64.to_radians()).abs() < 1e-15);
    assert_eq!(
        [
            wedges[0].column_friction.coefficient,
            wedges[1].column_friction.coefficient
        ],
        [0.3, 0.4]
    );
    assert_eq!(wedges[0].toe, 0.0);
}

/// Wedge rise is an axis of studies of wedges, trucks and cars, and what a run measures at its start.
#[test]
fn analytic_wedge_rise_is_varied_and_measured() {
    let of = |case: &str, key: &str| {
        study(&format!(
            "case = \"{case}\"\nsampling = \"full_factorial\"\n[vary]\n{key} = {{ from = \"0 in\", to = \
             \"0.8 in\", \
             count = 3 }}\n"
        ))
    };
    let trucks = of("truck_crowned_vertical_constant", "wedge.rise");
    let measured: Vec<f64> = (0..trucks.count())
        .map(|number| {
            let judged = trucks.case(number).unwrap().judge().unwrap();
            let found = trucks.measures().get(&judged.measures, "largest_rise_at_start");
            found.unwrap() / 0.0254
        })
        .collect();
    for (rise, found) in [0.0, 0.4, 0.8].into_iter().zip(&measured) {
        assert!(
            (found - measured[0] - rise).abs() < 0.03 * rise + 1e-12,
            "{measured:?}"
        );
    }
    let AnyCase::Car(car) = of("car_twist_and_roll_loaded", "truck.wedge.rise")
        .case(2)
        .unwrap()
    else {
        unreachable!("a car's study")
    };
    for wedge in car.parameters.trucks.iter().flat_map(|own| &own.wedges) {
        assert!((wedge.wear.rise(wedge.rise_angles()) / 0.0254 - 0.8).abs() < 1e-9);
    }
    let AnyCase::Wedge(wedge) = of("vdrun_toe_0_psi_0", "wedge.rise").case(1).unwrap() else {
        unreachable!("a wedge's study")
    };
    assert!((wedge.parameters.wedge_rise() / 0.0254 - 0.4).abs() < 1e-9);
}

#[test]
fn analytic_a_full_factorial_counts_like_a_clock() {
    let study = study(&format!(
        "{HEAD}sampling = \"full_factorial\"\n[vary]\nfriction.column = [0.3, 0.4]\n\
         wedge.angle = {{ from = \"30 deg\", to = \"36 deg\", count = 3 }}\n\
         side_frame.toe = [\"0.2 deg in\", \"0 deg\"]\n"
    ));
    assert_eq!(study.count(), 12);
    let sets: Vec<Vec<String>> = (0..12).map(|number| study.overrides(number)).collect();
    assert_eq!(
        sets[0],
        [
            "friction.column=0.3",
            "wedge.angle=\"30 deg\"",
            "side_frame.toe=\"0.2 deg in\""
        ]
    );
    assert_eq!(sets[1][2], "side_frame.toe=\"0 deg\"");
    assert_eq!(sets[5][1], "wedge.angle=\"36 deg\"");
    assert_eq!(
        sets[8],
        [
            "friction.column=0.4",
            "wedge.angle=\"33 deg\"",
            "side_frame.toe=\"0.2 deg in\""
        ]
    );
    let mut sorted = sets.clone();
    sorted.sort();
    sorted.dedup();
    assert_eq!(sorted.len(), 12, "no variant stands twice");
    // As in a case file.
    let case = study.case(8).unwrap();
    let case = case.wedge().unwrap();
    assert_eq!(case.parameters.wedge.angle, 33_f64 * std::f64::consts::PI / 180.0);
    assert!(case.parameters.toe < 0.0);
    assert_eq!(case.parameters.column_friction.coefficient, 0.4);
}

#[test]
fn analytic_ranges_scales_and_companions() {
    let study = study(&format!(
        "{HEAD}sampling = \"sobol\"\nruns = 8\n[vary]\n\
         contact.stiffness = {{ from = \"1e5 lbf/in\", to = \"1e7 lbf/in\", scale = \"logarithmic\" }}\n\
         friction.column = {{ from = 0.2, to = 0.6, also = [\"friction.slope\"] }}\n\
         bolster.vertical.amplitude = {{ from = \"0.5 in\", to = \"25.4 mm\" }}\n"
    ));
    // The second point of the sequence is the middle of everything.
    let values = study.values(1);
    let number = |value: &Option<Value>| match value {
        Some(Value::Number { value, unit }) => (*value, unit.clone()),
        other => panic!("{other:?}"),
    };
    assert!((number(&values[0]).0 - 1e6).abs() < 1e-6);
    assert!((number(&values[1]).0 - 0.4).abs() < 1e-15);
    assert!((number(&values[2]).0 - 0.75).abs() < 1e-12);
    assert_eq!(number(&values[2]).1, "in");
    let case = study.case(1).unwrap();
    let case = case.wedge().unwrap();
    assert_eq!(
        case.parameters.column_friction.coefficient,
        case.parameters.slope_friction.coefficient
    );
}

#[test]
fn analytic_a_list_is_what_is_written() {
    let study = study(&format!(
        "{HEAD}sampling = \"list\"\n[[variants]]\nfriction.column = 0.3\n[[variants]]\n\
         wedge.angle = \"36 deg\"\n\
         bolster.vertical = {{ shape = \"triangle\", amplitude = \"1 in\", frequency = \"0.5 Hz\" }}\n"
    ));
    assert_eq!(study.count(), 2);
    assert_eq!(study.overrides(0), ["friction.column=0.3"]);
    assert_eq!(study.values(0), [study.values(0)[0].clone(), None, None]);
    assert_eq!(study.overrides(1).len(), 2);
    let angle = |number| {
        study
            .case(number)
            .unwrap()
            .wedge()
            .unwrap()
            .parameters
            .wedge
            .angle
    };
    assert_eq!(angle(0), study.base.wedge().unwrap().parameters.wedge.angle);
    assert!((angle(1) - 36_f64.to_radians()).abs() < 1e-15);
}

#[test]
fn issue_036_ranges_descend() {
    let runs = |range: &str| {
        let vary = format!("[vary]\nwedge.angle = {{ {range} }}\n");
        let study = study(&format!("{HEAD}sampling = \"full_factorial\"\n{vary}"));
        let value = |number| study.values(number)[0].as_ref().unwrap().in_unit("deg").unwrap();
        (0..study.count()).map(value).collect::<Vec<f64>>()
    };
    assert_eq!(
        runs("from = \"40 deg\", to = \"30 deg\", count = 3"),
        [40.0, 35.0, 30.0]
    );
    let shares = runs("from = \"40 deg\", to = \"10 deg\", count = 3, scale = \"logarithmic\"");
    assert_eq!([shares[0], shares[2]], [40.0, 10.0]);
    assert!((shares[1] - 20.0).abs() < 1e-12, "{shares:?}");
}
