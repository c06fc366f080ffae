//! Tables of a nest as an FMU: the table's values come out, rates of positions are found, what is packed is
//! read back.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::resources;
use fmi::source::Source;
use fmi::tables::TablesOrigin;
use study::tables::grid::Grid;
use study::tables::rig::{Branches, Test, positions};
use study::tables::{NestTables, Table};
use study::truck::builtin::case_with;

use crate::part::Part;

const AMPLITUDE: f64 = 0.01;

/// Forces of 1000 N and 100 kN/m with 50 N of friction, twice as much at twice the friction.
fn source() -> Source {
    let grid = Grid {
        values: [vec![1000.0], vec![0.0], vec![0.25, 0.5], vec![1.0, 2.0]],
    };
    let table = |test: Test| {
        let branches = grid.nodes().map(|at| {
            let branch = |sign: f64| {
                let all = positions(AMPLITUDE).into_iter();
                all.map(|own| 1000.0 + 1e5 * own + sign * 200.0 * at[2]).collect()
            };
            Branches {
                rising: branch(1.0),
                falling: branch(-1.0),
            }
        });
        Table {
            test,
            amplitude: AMPLITUDE,
            positions: positions(AMPLITUDE),
            branches: branches.collect(),
            checks: Vec::new(),
        }
    };
    let tables = NestTables {
        case: "made_up".to_owned(),
        title: String::new(),
        tables: [table(Test::Nest), table(Test::Warp)],
        grid,
    };
    let case = case_with("truck_crowned_vertical_variable", &[]).unwrap();
    Source::NestTables(Box::new(TablesOrigin::new(&case, &tables)))
}

#[test]
fn analytic_tables_give_their_branches() {
    for (version, interface) in [
        (Version::Two, Interface::CoSimulation),
        (Version::Three, Interface::ModelExchange),
    ] {
        let mut part = Part::new(source(), version, interface, 0.01);
        part.set("friction", 0.5);
        part.begin();
        let near = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 1e-3, "{found} for {expected}");
        };
        near(part.get("force"), 1000.0);
        if interface == Interface::CoSimulation {
            // Its rate is found from its position: 0.1 m/s, a hundred times the scale and more.
            for step in 1..=5 {
                part.set("stroke", 1e-3 * f64::from(step));
                part.set("friction", 0.3);
                part.step();
            }
            let scale = part.get("stroke_rate_scale");
            let sign = 0.1 / (0.01_f64 + scale * scale).sqrt();
            near(part.get("force"), 1000.0 + 1e5 * 6e-3 + 60.0 * sign);
            assert_eq!(part.get("outside"), 0.0);
            part.set("friction", 0.9);
            part.step();
            assert_eq!(part.get("outside"), 1.0);
        }
    }
}

/// An FMU's files make the same description again; a file that is damaged is refused in words.
#[test]
fn input_packed_tables_are_read_back() {
    let source = source();
    let description = Description::new(&source).unwrap();
    for version in [Version::Two, Version::Three] {
        let xml = description.xml(version).unwrap();
        assert!(!xml.contains("<Derivatives"), "an empty list is not allowed");
        assert!(xml.contains("stroke_rate_scale"));
    }
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write("model.txt", b"NestTables\n");
    let [(name, bytes)] = &description.files[..] else {
        panic!("one file is expected")
    };
    write(name, bytes);
    let again = Description::new(&resources::read(folder.path()).unwrap()).unwrap();
    assert_eq!(again.token(Version::Two), description.token(Version::Two));
    let text = std::str::from_utf8(bytes).unwrap();
    for (from, to, part) in [
        ("[0.25,0.5]", "[0.5,0.25]", "do not increase"),
        ("[0.25,0.5]", "[0.25]", "branches at each node"),
        ("{\"case\"", "{\"chase\"", "tables.json is damaged"),
    ] {
        assert!(text.contains(from), "{text}");
        write(name, text.replacen(from, to, 1).as_bytes());
        let error = resources::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}
