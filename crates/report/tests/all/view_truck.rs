//! A truck's run as the page shows it: a scene that moves as the mechanics does, with the forces of its
//! corners.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use mechanics::vector::{Matrix, Vector};
use nucars::truck::{Choices, Wedges};
use quantity::System as Units;
use report::figures::truck::{TruckRun, exhibits};
use report::page::{half_truck_run, truck_run};
use report::view::View;
use report::view::run::{Detail, Recording};
use report::view::scene::{Scene, SceneBody};
use study::half_truck::catalog;
use study::run::Run;
use study::truck::{WEDGE_NAMES, builtin};

fn ran(name: &str, set: &[&str]) -> TruckRun {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &set).unwrap();
    let run = Run::with_contacts(&case).unwrap();
    let (result, contacts) = run.finish_with_contacts(|_| ControlFlow::Continue(()));
    assert!(result.summary.complete, "{:?}", result.summary.stopped);
    TruckRun {
        case,
        result,
        contacts,
    }
}

/// Returns all columns, of the table and of the corners.
fn columns(run: &TruckRun) -> BTreeMap<&str, &[f64]> {
    let contacts = run.contacts.as_ref().unwrap();
    let own = run.result.columns.iter().zip(&run.result.values);
    let corners = contacts.columns.iter().zip(&contacts.values);
    own.chain(corners)
        .map(|(column, values)| (column.name.as_str(), values.as_slice()))
        .collect()
}

/// Place and rotation of a body in a row.
fn pose(columns: &BTreeMap<&str, &[f64]>, body: &SceneBody, row: usize) -> (Vector<f64>, Matrix<f64>) {
    let at = |k: usize| {
        body.coordinates[k]
            .as_ref()
            .map_or(0.0, |name| columns[name.as_str()][row])
    };
    let place: [f64; 3] = std::array::from_fn(|k| body.position[k] + at(k));
    let turn = |axis: usize, angle: f64| {
        let (s, c) = angle.sin_cos();
        Matrix(match axis {
            0 => [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]],
            1 => [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]],
            _ => [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
        })
    };
    let yawed: Matrix<f64> = turn(1, at(4)).times(turn(2, at(5)));
    (Vector(place), yawed.times(turn(0, at(3))))
}

fn scene_of(run: &TruckRun) -> Scene {
    report::view::truck::scene(&run.case).unwrap()
}

/// Bodies placed by their columns, solids by their mounts, corners by their points: together they give the
/// gaps that the mechanics computed, also with toe, a worn column, half a car that drops, and side frames
/// that roll.
#[test]
fn the_scene_has_the_gaps_of_the_run() {
    for (name, set) in [
        (
            "truck_warp_nest_constant_rising",
            &["simulation.duration=4.5 s"][..],
        ),
        (
            "truck_vertical_variable",
            &[
                "side_frame.toe=0.4 deg out",
                "wedge.leading_left.column_wear=0.1 in",
                "start.kind=equilibrium",
                "simulation.duration=1 s",
            ],
        ),
        ("truck_drop_constant", &["simulation.duration=0.5 s"]),
        ("truck_roll_variable", &["simulation.duration=1 s"]),
    ] {
        let run = ran(name, set);
        check_gaps(name, &scene_of(&run), &columns(&run));
    }
}

/// Checks the gaps of all corners of four wedges.
fn check_gaps(name: &str, scene: &Scene, columns: &BTreeMap<&str, &[f64]>) {
    assert_eq!(
        scene.contacts.len(),
        32,
        "four corners at two faces of four wedges"
    );
    let body = |id: &str| scene.bodies.iter().find(|body| body.id == id).unwrap();
    let mut closed = 0;
    for contact in &scene.contacts {
        let gaps = columns[format!("{}_gap", contact.id).as_str()];
        let solid = scene.solids.iter().find(|solid| solid.id == contact.on).unwrap();
        let turn = |pitch: f64| {
            let (s, c) = pitch.sin_cos();
            Matrix([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
        };
        let mount = turn(solid.mount.angles[1]);
        // The solid lies behind its surface.
        let normal = Vector(contact.normal);
        let surface = solid
            .vertices
            .iter()
            .map(|vertex| normal.dot::<f64, f64>(Vector(*vertex)))
            .fold(f64::NEG_INFINITY, f64::max);
        for row in (0..gaps.len()).step_by(9) {
            let (place, rotation) = pose(columns, body(&contact.body), row);
            let arm: Vector<f64> = rotation.apply(Vector(contact.point));
            let point = place + arm;
            let (under, rotation) = pose(columns, body(&solid.body), row);
            let from_mount: Vector<f64> = rotation.apply_transposed(point - under);
            let local: Vector<f64> = mount.apply_transposed(from_mount - Vector(solid.mount.position));
            let gap = normal.dot::<f64, f64>(local) - surface;
            // Solids are rounded to a micrometer.
            assert!(
                (gap - gaps[row]).abs() < 2e-6,
                "{name}, {}, row {row}: {gap} m is not {} m",
                contact.id,
                gaps[row]
            );
            closed += usize::from(gaps[row] < 0.0);
        }
    }
    assert!(closed > 100, "{name}: {closed} corners in contact only");
}

/// A half-truck's wedges that are bodies are drawn as a truck's: where their corners are, and with their
/// forces.
#[test]
fn a_half_trucks_wedge_bodies_have_the_gaps_and_forces_of_the_run() {
    for name in ["nucars_69_variable_toe_out", "nucars_69_constant_toe_out"] {
        let choices = Choices {
            wedges: Wedges::Bodies,
            ..Choices::default()
        };
        let case = catalog::entry(name).unwrap().case(&choices, 3.0).unwrap();
        let run = Run::with_contacts(&case).unwrap();
        let (result, contacts) = run.finish_with_contacts(|_| ControlFlow::Continue(()));
        let contacts = contacts.unwrap();
        let own = result.columns.iter().zip(&result.values);
        let corners = contacts.columns.iter().zip(&contacts.values);
        let columns: BTreeMap<&str, &[f64]> = own
            .chain(corners)
            .map(|(column, values)| (column.name.as_str(), values.as_slice()))
            .collect();
        let scene = report::view::half_truck::scene(&case).unwrap();
        check_gaps(name, &scene, &columns);
        // Eight springs and four control coils; connections that only measure are not drawn.
        assert_eq!(scene.coils.len(), 12, "{name}");
        // With variable damping the file's coils push only while the bolster is down.
        for row in [200, 250, 290] {
            let sum = |stem: &str, what: &str| -> f64 {
                let own = scene.contacts.iter().filter(|own| own.id.starts_with(stem));
                own.map(|own| columns[format!("{}_{what}", own.id).as_str()][row])
                    .sum()
            };
            for wedge in ["wedge_127", "wedge_130"] {
                let result = |what: &str| columns[format!("{wedge}_{what}").as_str()][row];
                for (corners, table) in [
                    (
                        sum(&format!("{wedge}_column"), "normal_force"),
                        result("column_normal_force"),
                    ),
                    (
                        sum(&format!("{wedge}_slope"), "normal_force"),
                        result("slope_normal_force"),
                    ),
                    (
                        -sum(&format!("{wedge}_column"), "friction_force_z"),
                        result("column_friction"),
                    ),
                ] {
                    assert!(
                        (corners - table).abs() < 1e-6 * (1.0 + table.abs()),
                        "{name}: {corners} N, {table} N"
                    );
                }
            }
        }
        let page = half_truck_run::render(&case, &result, Some(&contacts)).unwrap();
        let page = format!("{page}{}", report::view::kept::data_in(&page).unwrap());
        for text in [
            "with wedges that are bodies",
            "Wedges as bodies",
            "wedge_127_column_lower_left_normal_force",
            "the wedges&#39; masses",
        ] {
            assert!(
                page.contains(text) || page.contains(&text.replace("&#39;", "'")),
                "{text}"
            );
        }
        let without = Run::new(&case).unwrap().finish(|_| ());
        assert_eq!(without.values, result.values, "corners change nothing of a run");
    }
}

/// The forces of a wedge's corners add up to what the table says of its faces; a corner that is open has
/// none, and friction stays within its limit.
#[test]
fn the_corners_add_up_to_the_faces() {
    let run = ran("truck_warp_nest_variable_rising", &["simulation.duration=4.5 s"]);
    let columns = columns(&run);
    let scene = scene_of(&run);
    let rows = run.result.rows();
    let largest = columns["leading_left_column_normal"]
        .iter()
        .fold(0.0, |most: f64, force| most.max(*force));
    assert!(largest > 1e4, "{largest} N");
    for wedge in WEDGE_NAMES {
        for face in ["column", "slope"] {
            let stem = format!("{wedge}_{face}_");
            let corners: Vec<_> = scene
                .contacts
                .iter()
                .filter(|own| own.id.starts_with(&stem))
                .collect();
            assert_eq!(corners.len(), 4);
            for row in 0..rows {
                let sum = |what: &dyn Fn(&report::view::scene::SceneContact) -> String| -> f64 {
                    corners.iter().map(|own| columns[what(own).as_str()][row]).sum()
                };
                let normal = sum(&|own| own.normal_force.clone());
                let result = columns[format!("{wedge}_{face}_normal").as_str()][row];
                assert!((normal - result).abs() < 1e-9 * largest, "{stem} row {row}");
                if face == "column" {
                    let friction = sum(&|own| own.friction[2].clone());
                    let result = columns[format!("{wedge}_column_friction_z").as_str()][row];
                    assert!((friction + result).abs() < 1e-9 * largest, "{stem} row {row}");
                }
            }
            for corner in corners {
                for row in 0..rows {
                    let normal = columns[corner.normal_force.as_str()][row];
                    let friction = corner.friction.each_ref().map(|name| columns[name.as_str()][row]);
                    let friction = friction.iter().map(|part| part * part).sum::<f64>().sqrt();
                    // A bristle's damping may add to the limit while it grows.
                    assert!(
                        friction <= 0.4 * normal * 1.05 + 1e-6 * largest,
                        "{} row {row}: {friction} of {normal} N",
                        corner.id
                    );
                    let state = columns[corner.state.as_str()][row];
                    assert!([0.0, 1.0, 2.0].contains(&state));
                    assert!(
                        state != 0.0 || normal < 0.02 * largest,
                        "{} row {row}: open with {normal} N",
                        corner.id
                    );
                }
            }
        }
    }
}

/// A run that takes its corners along has the same bits as one that does not.
#[test]
fn corners_change_nothing_of_a_run() {
    let with = ran("truck_vertical_variable", &["simulation.duration=1 s"]);
    let without = Run::new(&with.case).unwrap().finish(|_| ());
    assert_eq!(with.result.values, without.values);
    let contacts = with.contacts.as_ref().unwrap();
    assert!(
        contacts
            .values
            .iter()
            .all(|values| values.len() == without.rows())
    );
}

/// The page's data have every column that scene and plots name, and the scene shows what there is.
#[test]
fn the_view_has_bodies_and_columns_of_each_kind_of_truck() {
    for (name, set, bodies, solids) in [
        ("truck_warp_nest_constant_rising", &[][..], 7, &["bolster"][..]),
        (
            "truck_vertical_variable",
            &[],
            9,
            &["leading_wheelset", "bolster"],
        ),
        ("truck_drop_variable", &[], 9, &["trailing_wheelset", "floor"]),
        (
            "truck_roll_constant",
            &["load.kind=car_body", "bolster.roll=0 rad"],
            10,
            &["floor", "leading_wheelset"],
        ),
    ] {
        let set = [&["simulation.duration=0.2 s"], set].concat();
        let run = ran(name, &set);
        let scene = scene_of(&run);
        assert_eq!(scene.bodies.len(), bodies, "{name}");
        for id in solids {
            assert!(scene.solids.iter().any(|solid| solid.id == *id), "{name}: {id}");
        }
        let recording =
            Recording::of_three_piece_truck(&run.case, &run.result, run.contacts.as_ref(), Detail::Thinned);
        let view = View::new(Units::Us, [recording], []);
        let view = &view.runs[0];
        let named = view.plots.iter().flat_map(|plot| &plot.curves);
        let seen = scene.columns().chain(named.map(|(name, _)| name));
        for column in seen {
            assert!(view.columns.contains_key(column), "{name} lacks {column}");
        }
    }
}

#[test]
fn the_page_of_a_run_tells_loops_wedges_and_doubts() {
    let mut run = ran("truck_vertical_constant", &["simulation.duration=7 s"]);
    let names: Vec<String> = exhibits(&run).into_iter().map(|exhibit| exhibit.name).collect();
    for what in ["loop", "wedges", "contact_states", "energy_ledger"] {
        let name = format!("truck_vertical_constant_{what}");
        assert!(names.contains(&name), "{names:?}");
    }
    run.result.summary.warnings.push("something <odd>".to_owned());
    let page = truck_run::render(&run).unwrap();
    for part in [
        "something &lt;odd&gt;",
        "data-run=\"truck_vertical_constant\" open",
        "trailing right",
        "Constant damping, bolster up and down",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.contains("wedgelab-view") && page.contains("<svg"));
    let warp = ran("truck_warp_nest_constant_rising", &["simulation.duration=4 s"]);
    assert!(
        exhibits(&warp)
            .iter()
            .any(|exhibit| exhibit.name.ends_with("_warp"))
    );
}
