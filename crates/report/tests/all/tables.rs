//! The files of tables, of made-up tables without runs.

use nucars::read::read_system;
use nucars::source::SourceText;
use quantity::System as Units;
use report::tables_files::{functions, write_csv, write_pwl};
use study::tables::check::{Check, places};
use study::tables::grid::Grid;
use study::tables::rig::{Branches, Test, positions};
use study::tables::{NestTables, Table};

const INCH: f64 = 0.0254;
const POUND: f64 = 4.448_221_615_260_5;

/// A nest of 1 lbf more friction and 10 lbf/in at each node, and a warp moment alike.
fn tables() -> NestTables {
    let grid = Grid {
        values: [
            vec![100.0 * POUND, 300.0 * POUND],
            vec![0.0],
            vec![0.25, 0.5],
            vec![std::f64::consts::TAU],
        ],
    };
    let table = |test: Test, amplitude: f64, unit: [f64; 2]| {
        let all = positions(amplitude);
        let branches = grid.nodes().enumerate().map(|(node, at)| {
            let load = if test == Test::Nest { at[0] } else { 0.0 };
            let branch = |sign: f64| {
                let force = |own: &f64| {
                    let friction = sign * (1.0 + node as f64) * unit[1];
                    load + 10.0 * unit[1] / unit[0] * own + friction
                };
                all.iter().map(force).collect()
            };
            Branches {
                rising: branch(1.0),
                falling: branch(-1.0),
            }
        });
        let mut table = Table {
            test,
            amplitude,
            positions: all.clone(),
            branches: branches.collect(),
            checks: Vec::new(),
        };
        let checks = places(&grid).into_iter();
        table.checks = checks
            .map(|place| Check::of(&grid, &table, &place, &table.branches[1]))
            .collect();
        table
    };
    NestTables {
        case: "made_up".to_owned(),
        title: String::new(),
        tables: [
            table(Test::Nest, 0.5 * INCH, [INCH, POUND]),
            table(Test::Warp, 0.02, [1.0, POUND * INCH]),
        ],
        grid,
    }
}

/// What is written is read back by the reader of NUCARS's files as the same functions; those of a nest have
/// extension and tension positive, and the load in them.
#[test]
fn cross_code_functions_of_nucars_are_read_back_equal() {
    let tables = tables();
    for number in 0..2 {
        let mut text = Vec::new();
        write_pwl(&tables, number, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        for part in [
            "! Units: ",
            "! Error against whole runs",
            "friction between two nodes, 0.375: ",
            "! The rise has one value and is a constant: 0 in.",
            "! load 300 lbf, rise 0 in, friction 0.5, rate 1 Hz",
        ] {
            assert!(text.contains(part), "{text}");
        }
        assert!(text.lines().all(|line| line.len() <= 132), "{text}");
        let source = SourceText::from_text("tables.sys", text).unwrap();
        let read = read_system(&source).tree.piecewise_linear;
        assert_eq!(read, functions(&tables.tables[number]));
        assert_eq!(read.len(), 2 * tables.grid.count());
    }
    let nest = functions(&tables.tables[0]);
    let [mean, half] = [&nest[2], &nest[3]];
    assert_eq!([*mean.id, *half.id], [1003, 1004]);
    for (extension, force) in [(0.0, -100.0), (-0.5, -105.0), (0.25, -97.5)] {
        assert!((mean.value(extension) - force).abs() < 1e-9, "{extension}");
        assert!((half.value(extension) - 2.0).abs() < 1e-9, "{extension}");
    }
    let warp = functions(&tables.tables[1]);
    assert!((warp[0].value(0.01) - 0.1).abs() < 1e-9 && (warp[1].value(0.01) - 1.0).abs() < 1e-9);
    assert!(!warp[0].is_mirrored());
}

#[test]
fn analytic_tables_have_a_row_for_each_node_and_position() {
    let tables = tables();
    let csv = |number: usize, units: Units| {
        let mut text = Vec::new();
        write_csv(&tables, number, units, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    };
    let text = csv(0, Units::Us);
    let mut lines = text.lines();
    assert_eq!(
        lines.next().unwrap(),
        "load_lbf,rise_in,friction,rate_Hz,stroke_in,force_loading_lbf,force_unloading_lbf,force_mean_lbf,\
         force_half_width_lbf,function"
    );
    assert_eq!(lines.count(), 4 * 21);
    assert!(
        csv(1, Units::Si).starts_with(
            "load_N,rise_m,friction,rate_Hz,warp_angle_rad,moment_rising_N_m,moment_falling_N_m,"
        )
    );
}
