//! Nests of single coils against the four groups that stand for them.

use crate::common;
use common::{INCH, POUND_FORCE};
use mechanics::system::StaticFriction;
use truck::coils::catalog;
use truck::nest::{self, PITCH, Ring, Standing, nest, usual_counts};
use truck::{BOLSTER, Bolster, Lading, NestCoil, Parameters, Truck};
use wedge::parameters::Damping;

/// Load of the load coils of a nest and their number (outer, inner).
const NESTS: [(Damping, f64, f64, [usize; 2]); 2] = [
    (Damping::Constant, 4.0 * 15_403.8, 0.688, [9, 5]),
    (Damping::Variable, 4.0 * 12_252.1, 0.674, [6, 7]),
];

/// The D5 coils of a whole nest that carries a load (N).
fn springs(damping: Damping, load: f64, shear_ratio: f64) -> Vec<NestCoil> {
    let kind = &catalog()[0];
    assert_eq!(kind.name, "D5");
    let coils = nest(damping, usual_counts(damping)).unwrap();
    let standing = Standing {
        height: nest::height(&coils, kind, load).unwrap(),
        shear_ratio,
        pitch: PITCH,
    };
    let springs = nest::springs(&coils, kind, standing);
    springs.into_iter().map(|(_, coil)| coil).collect()
}

/// Coils of a nest stand the same on both sides of its middle lines, each place once.
#[test]
fn limits_coils_stand_on_both_sides_alike() {
    for (damping, most) in [(Damping::Constant, 9), (Damping::Variable, 7)] {
        for outer in 0..=most {
            for inner in 0..=most {
                let coils = nest(damping, [outer, inner]).unwrap();
                assert_eq!(coils.len(), outer + inner);
                for (ring, [x, y]) in &coils {
                    for mirrored in [[-x, *y], [*x, -y]] {
                        let count = coils.iter().filter(|own| **own == (*ring, mirrored)).count();
                        assert_eq!(count, 1, "{damping:?} {outer} {inner}: {mirrored:?}");
                    }
                }
            }
        }
        assert!(nest(damping, [most + 1, 0]).is_none());
    }
}

/// Loads at solid height are stiffness times travel; the remembered coils have those of their tables, and the
/// sum of a pair of control coils is that of input files of NUCARS.
#[test]
fn reproduction_loads_of_the_catalog() {
    let solid = [
        ("D7", [8643.0, 4107.0]),
        ("B-353", [6283.0, 2852.0]),
        ("B-355", [5690.0, 3368.0]),
        ("B-432", [4637.0, 2210.0]),
    ];
    for (name, loads) in solid {
        let kind = catalog().into_iter().find(|own| own.name == name).unwrap();
        for (coil, expected) in [kind.outer.unwrap(), kind.inner.unwrap()].into_iter().zip(loads) {
            let load = coil.load(coil.solid_height) / POUND_FORCE;
            assert!((load - expected).abs() < 0.6, "{name}: {load} {expected}");
            let spring = coil.spring(coil.free_height - 0.02, 0.5, 1e7);
            assert!((spring.preload - 0.02 * coil.stiffness).abs() < 1e-6);
            let travel = coil.free_height - 0.02 - coil.solid_height;
            assert!((spring.solid.unwrap()[0] - travel).abs() < 1e-12);
        }
    }
    let pair = catalog().into_iter().find(|own| own.name == "B-353").unwrap();
    let sum = (pair.outer.unwrap().stiffness + pair.inner.unwrap().stiffness) / (POUND_FORCE / INCH);
    assert!((sum / 1937.0 - 1.0).abs() < 1e-3, "{sum}");
}

#[test]
fn reproduction_single_coils_make_the_stiffness_and_solid_height_of_the_groups() {
    for (damping, load, ratio, counts) in NESTS {
        let coils = nest(damping, usual_counts(damping)).unwrap();
        let count = |kind| coils.iter().filter(|(coil, _)| *coil == kind).count();
        assert_eq!([count(Ring::Outer), count(Ring::Inner)], counts);
        let nest = springs(damping, load * POUND_FORCE, ratio);
        let groups = &Parameters::new(damping).load_coils[0];
        let sum = |nest: &[truck::NestCoil], value: fn(&truck::Spring) -> f64| -> f64 {
            nest.iter().map(|coil| value(&coil.spring)).sum()
        };
        for value in [
            |s: &truck::Spring| s.stiffness,
            |s: &truck::Spring| s.shear_stiffness,
        ] {
            let (found, expected) = (sum(&nest, value), sum(groups, value));
            assert!((found / expected - 1.0).abs() < 2e-3, "{found} {expected}");
        }
        let (found, expected) = (sum(&nest, |s| s.preload), sum(groups, |s| s.preload));
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        let [travel, expected] = [&nest, groups].map(|nest| nest[0].spring.solid.unwrap()[0] / INCH);
        assert!((travel - expected).abs() < 2e-3, "{travel} {expected} in");
        // The nest's load is centered.
        for k in 0..2 {
            let moment: f64 = nest.iter().map(|coil| coil.spring.preload * coil.place[k]).sum();
            assert!(moment.abs() < 1e-9 * load);
        }
    }
}

/// A half car on a nest without the coils at one corner settles by the share of stiffness that is missing.
#[test]
fn limits_missing_coils_let_the_car_settle() {
    let (damping, load, ratio, _) = NESTS[0];
    let parameters = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..Parameters::new(damping).with_wedge_friction(0.0)
    };
    let whole = springs(damping, load * POUND_FORCE, ratio);
    let rest_with = |left: Vec<truck::NestCoil>| {
        let mut parameters = parameters.clone();
        parameters.load_coils = [left, whole.clone()];
        let mut truck = Truck::new(&parameters).unwrap();
        let x = truck.system.initial_state();
        let rest = truck
            .system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .unwrap();
        rest[truck.system.position_of(BOLSTER, 2).unwrap()] / INCH
    };
    let z = rest_with(whole.clone());
    assert!(z.abs() < 1e-3, "{z} in");
    let left = whole
        .iter()
        .filter(|coil| coil.place != whole[0].place)
        .copied()
        .collect::<Vec<_>>();
    let missing: f64 = whole.iter().map(|coil| coil.spring.stiffness).sum::<f64>()
        - left.iter().map(|coil| coil.spring.stiffness).sum::<f64>();
    let lost = missing / whole.iter().map(|coil| coil.spring.stiffness).sum::<f64>();
    let z = rest_with(left);
    // The bolster cannot roll on this rig: both nests give way alike, and one has lost that share of its
    // load.
    let expected = -lost * load / (2.0 - lost) / (load / 2.3816);
    assert!(
        (z / expected - 1.0).abs() < 0.02,
        "{z} in, {expected} in expected"
    );
}
