//! Tables of a nest: their runs against closed forms, interpolation, requests that are refused.

use std::ops::ControlFlow;

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use study::run::Run;
use study::tables::grid::{Direction, Grid};
use study::tables::rig::{self, Branches, Test, Wanted, carried, height, positions};
use study::tables::{Lists, NestTables, Table, TablesError, TablesRequest};
use study::truck::TruckCase;
use study::truck::builtin::case_with;
use study::truck::warp::WarpCurve;
use truck::ControlCoil;

const INCH: f64 = 0.0254;
const TAU: f64 = std::f64::consts::TAU;

fn truck(name: &str, set: &[&str]) -> TruckCase {
    let set: Vec<String> = set.iter().map(|own| (*own).to_owned()).collect();
    case_with(name, &set).unwrap()
}

fn loop_of(case: &TruckCase, wanted: &Wanted) -> Branches {
    rig::run(case, wanted, &|| ControlFlow::Continue(())).unwrap().0
}

/// Without friction both branches are the springs: with constant damping the load coils alone, a straight
/// line by their stiffness; with variable damping the control coils too, whose wedges stand higher by what
/// their contacts give way. With the coil's force F and the weight W of a wedge the normal forces are
/// `N_s = (F - W) / sin θ` and `N_c = N_s cos θ`, on four corners each, and the depths lift the wedge as wear
/// does: 2.5e-3 of the force at most. That the wedge pitches is left out of the closed form.
#[test]
fn analytic_a_nest_without_friction_is_its_springs() {
    for (name, tolerance) in [
        ("truck_vertical_constant", 1e-9),
        ("truck_vertical_variable", 2e-4),
    ] {
        let case = truck(name, &[]);
        let nominal = carried(&case.parameters, 0.0, 0.0);
        let wanted = Wanted {
            test: Test::Nest,
            at: [0.8 * nominal, 0.25 * INCH, 0.0, TAU],
            amplitude: 0.4 * INCH,
        };
        let found = loop_of(&case, &wanted);
        let [load, rise, ..] = wanted.at;
        let own = height(&case.parameters, load, rise).unwrap();
        let wedge = &case.parameters.wedges[0];
        let ControlCoil::Shear(coil) = &wedge.control_coil else {
            panic!("a coil with a linear law is expected")
        };
        let (sin, cos) = (libm::sin(wedge.angle), libm::cos(wedge.angle));
        let gives_way = (1.0 + cos * cos) / (4.0 * wedge.contact.stiffness * sin * sin);
        for (k, stroke) in positions(wanted.amplitude).into_iter().enumerate() {
            let expected = if name == "truck_vertical_constant" {
                load + 0.5 * case.parameters.load_stiffness() * stroke
            } else {
                let rigid = coil.preload - coil.stiffness * (own - stroke + rise);
                let weight = wedge.mass * case.parameters.gravity;
                let lifted = gives_way * (rigid - weight) / (1.0 + coil.stiffness * gives_way);
                carried(&case.parameters, own - stroke, rise) - 2.0 * coil.stiffness * lifted
            };
            for force in [found.rising[k], found.falling[k]] {
                assert!(
                    (force / expected - 1.0).abs() < tolerance,
                    "{name} at {stroke}: {force} for {expected}"
                );
            }
        }
    }
}

/// The width of the loop at zero stroke is that of Coulomb's friction on two massless wedges that slide on
/// both faces, within 2 %: stiff contacts, and half a degree of toe, so that slopes slide. The wedge's body
/// lies flat on one face alone, which is 3 % for a degree of toe.
#[test]
fn cross_code_the_width_of_a_loop_is_coulombs() {
    let set = [
        "side_frame.toe=0.5 deg out",
        "contact.stiffness=2500000 lbf/in",
        "friction.bristle_stiffness=10000000 lbf/in",
    ];
    let case = truck("truck_vertical_variable", &set);
    let wanted = Wanted {
        test: Test::Nest,
        at: [carried(&case.parameters, 0.0, 0.0), 0.0, 0.3, 0.5 * TAU],
        amplitude: 0.5 * INCH,
    };
    let found = loop_of(&case, &wanted);
    let middle = positions(wanted.amplitude).len() / 2;
    let half = 0.5 * (found.rising[middle] - found.falling[middle]);
    let wedge = &case.parameters.wedges[0];
    let massless = QuasiStaticWedge {
        angle: wedge.angle,
        toe: wedge.toe,
        column_friction: 0.3,
        slope_friction: 0.3,
    };
    let coil = wedge.control_coil.preload() - wedge.mass * case.parameters.gravity;
    let column = |direction: SlidingDirection| {
        let slide = massless
            .slide(direction, massless.branch(direction), coil)
            .unwrap();
        direction.sign() * slide.column_friction * libm::cos(wedge.toe)
            - slide.column_normal * libm::sin(wedge.toe)
    };
    // Two wedges, and half of the difference.
    let expected = column(SlidingDirection::Down) - column(SlidingDirection::Up);
    assert!((half / expected - 1.0).abs() < 0.02, "{half} for {expected}");
}

/// Twice the loop of a nest loses as much as the truck's in a warp test of `wedgelab warp`, within 3 %: that
/// is a triangle, not a sine, and has more rows.
#[test]
fn energy_a_warp_loop_loses_what_a_warp_test_loses() {
    let case = truck("truck_crowned_warp_nest_variable", &[]);
    let result = Run::new(&case).unwrap().finish(|_| ());
    let expected = WarpCurve::of(&case, &result).unwrap().loop_area.unwrap();
    let nominal = carried(&case.parameters, 0.0, 0.0);
    assert!(height(&case.parameters, nominal, 0.0).unwrap().abs() < 1e-12);
    let wanted = Wanted {
        test: Test::Warp,
        at: [nominal, 0.0, 0.4, 0.1 * TAU],
        amplitude: 0.020,
    };
    let found = loop_of(&case, &wanted);
    let places = positions(wanted.amplitude);
    let inner = 1..places.len() - 1;
    assert!(
        inner.clone().all(|k| found.rising[k] > found.falling[k]),
        "{found:?}"
    );
    // The branches meet at both ends.
    let step = places[1] - places[0];
    let area: f64 = inner.map(|k| step * (found.rising[k] - found.falling[k])).sum();
    let last = places.len() - 1;
    let end = 0.5 * step * (found.rising[last] - found.falling[last]);
    let both = 2.0 * (area + end);
    assert!((both / expected - 1.0).abs() < 0.03, "{both} for {expected}");
}

/// A table whose forces are a product of linear functions of all directions and the position.
fn product() -> (NestTables, impl Fn([f64; 4], f64) -> f64) {
    let value = |at: [f64; 4], position: f64| {
        let factors = at.iter().zip([3.0, 5.0, 7.0, 11.0]);
        factors.map(|(own, more)| own + more).product::<f64>() * (position + 2.0)
    };
    let grid = Grid {
        values: [
            vec![1.0, 2.0, 4.0],
            vec![0.0, 0.3],
            vec![0.1, 0.5],
            vec![1.0, 3.0],
        ],
    };
    let table = |test: Test| {
        let all = positions(0.5);
        let branch = |at: [f64; 4], more: f64| all.iter().map(|own| value(at, *own) + more).collect();
        Table {
            test,
            amplitude: 0.5,
            positions: all.clone(),
            branches: grid
                .nodes()
                .map(|at| Branches {
                    rising: branch(at, 1.0),
                    falling: branch(at, -1.0),
                })
                .collect(),
            checks: Vec::new(),
        }
    };
    let tables = NestTables {
        case: "product".to_owned(),
        title: String::new(),
        tables: [table(Test::Nest), table(Test::Warp)],
        grid,
    };
    (tables, value)
}

/// A node gives its own bits; between nodes a product of linear functions comes back; outside is an error
/// that names the direction, and a constant direction has its value alone.
#[test]
fn analytic_interpolation_is_exact_at_nodes_and_multilinear_between() {
    let (tables, value) = product();
    let (grid, table) = (&tables.grid, &tables.tables[0]);
    tables.validate().unwrap();
    for (number, at) in grid.nodes().enumerate() {
        for (k, position) in table.positions.iter().enumerate() {
            let own = &table.branches[number];
            assert_eq!(
                table.at(grid, at, *position).unwrap(),
                [own.rising[k], own.falling[k]]
            );
        }
    }
    for (at, position) in [([1.7, 0.1, 0.2, 1.1], 0.03), ([3.9, 0.29, 0.5, 3.0], -0.5)] {
        let [rising, falling] = table.at(grid, at, position).unwrap();
        let expected = value(at, position);
        assert!((rising - expected - 1.0).abs() < 1e-9 * expected, "{rising}");
        assert!((falling - expected + 1.0).abs() < 1e-9 * expected, "{falling}");
        let [mean, half] = table.mean_and_half(grid, at, position).unwrap();
        assert!((mean - expected).abs() < 1e-9 * expected && (half - 1.0).abs() < 1e-9 * expected);
    }
    let outside = table.at(grid, [1.0, 0.0, 0.6, 1.0], 0.0).unwrap_err();
    assert_eq!(outside.direction, Direction::Friction);
    assert!(outside.to_string().contains("friction 0.6"), "{outside}");
    let constant = Grid {
        values: [vec![1.0], vec![0.0], vec![0.1, 0.5], vec![1.0]],
    };
    assert_eq!(constant.varied().collect::<Vec<_>>(), [Direction::Friction]);
    assert_eq!(constant.weights([1.0, 0.0, 0.5, 1.0]).unwrap(), [(1, 1.0)]);
    assert!(constant.weights([1.1, 0.0, 0.5, 1.0]).is_err());
    assert_eq!(constant.clamped([9.0, 9.0, 0.2, 9.0]), [1.0, 0.0, 0.2, 1.0]);
}

#[test]
fn input_lists_say_what_is_wrong() {
    let case = truck("truck_crowned_vertical_variable", &[]);
    let refused = |place: usize, texts: &[&str]| {
        let mut lists = Lists::default();
        lists.directions[place] = texts.iter().map(|own| (*own).to_owned()).collect();
        let error = TablesRequest::new(&case, &lists).unwrap_err();
        (error.to_string(), error.help())
    };
    for (place, texts, part) in [
        (0, &["10 kip", "20"][..], "value 2 of --load, `20`"),
        (0, &["20 kip", "10 kip"], "does not exceed `20 kip`"),
        (0, &["-1 kip"], "a force above zero is expected"),
        (0, &["1 in"], "value 1 of --load, `1 in`"),
        (0, &["900000 kip"], "at no height"),
        (
            1,
            &["0 in", "2 in"],
            "value 2 of --rise is 2 in, and the pockets hold 1.5 in",
        ),
        (2, &["0.3", "0.3"], "does not exceed `0.3`"),
        (2, &["0.3 in"], "a number without unit is expected"),
        (3, &["0 Hz"], "a frequency from 0.001 to 50 Hz is expected"),
        (3, &["NaN Hz"], "value 1 of --rate"),
    ] {
        let (message, help) = refused(place, texts);
        assert!(message.contains(part), "{message}");
        assert!(!help.is_empty(), "{message}");
    }
    let massless = truck("truck_warp_axles_constant_rising", &["wedge.kind=massless"]);
    let error = TablesRequest::new(&massless, &Lists::default()).unwrap_err();
    assert!(matches!(error, TablesError::Massless(_)), "{error}");
}
