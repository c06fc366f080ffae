//! A car's run as the page shows it: bodies where the mechanics has them, patches that carry the wheels'
//! forces, wedges in balance.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::LazyLock;

use report::figures::car::CarRun;
use report::page::car_run;
use report::view::car::scene;
use study::car::CarCase;
use study::case::Tables;
use study::run::Run;

/// In a curve to the left of 7.5 deg with 4 in of superelevation.
const CURVE: &str = "model = \"car\"\nstart.settle = \"0 s\"\nspeed.value = \"28 mph\"\n\
                     simulation.duration = \"4.5 s\"\nsimulation.output_interval = \"0.02 s\"\n\
                     [[track.segments]]\ntangent = \"60 ft\"\n\
                     [[track.segments]]\nspiral = \"80 ft\"\n\
                     [[track.segments]]\ncurve = \"500 ft\"\ndegree = \"7.5 deg\"\ndirection = \"left\"\n\
                     superelevation = \"4 in\"\n";

/// Returns the run, made once.
fn ran() -> &'static CarRun {
    static RUN: LazyLock<CarRun> = LazyLock::new(|| {
        let case = CarCase::parse("curve.toml", CURVE, Tables::nowhere(), &[]).unwrap();
        let run = Run::with_motions(&case).unwrap();
        let (result, motions) = run.finish_with_motions(|_| ControlFlow::Continue(()));
        assert!(result.summary.complete, "{:?}", result.summary.stopped);
        CarRun {
            case,
            result,
            motions,
        }
    });
    &RUN
}

/// Returns all columns, of the table and of the motions.
fn columns(run: &CarRun) -> BTreeMap<&str, &[f64]> {
    let motions = run.motions.as_ref().unwrap();
    let own = run.result.columns.iter().zip(&run.result.values);
    let all = own.chain(motions.columns.iter().zip(&motions.values));
    all.map(|(column, values)| (column.name.as_str(), values.as_slice()))
        .collect()
}

/// The scene names no column that there is not, all have a value for every row, and no two columns of table
/// and motions have one name.
#[test]
fn input_the_scene_names_columns_that_there_are() {
    let run = ran();
    let columns = columns(run);
    let motions = run.motions.as_ref().unwrap();
    assert_eq!(columns.len(), run.result.columns.len() + motions.columns.len());
    let rows = run.result.rows();
    let scene = scene(&run.case, &run.result).unwrap();
    for name in scene.columns() {
        assert_eq!(columns[name.as_str()].len(), rows, "{name}");
    }
    // Body, two trucks of seven bodies in axes of their own, four wheelsets that spin in theirs.
    assert_eq!(scene.bodies.len(), 1 + 2 * 8 + 4 * 2);
    assert_eq!((scene.contacts.len(), scene.patches.len()), (16, 24));
    let track = scene.track.unwrap();
    assert!(track.lists["x"].len() > 100 && track.lists.contains_key("roll"));
}

/// Patches carry what the wheels carry, and are where wheels and rails touch.
#[test]
fn analytic_patches_sum_up_to_the_forces_of_the_wheels() {
    let run = ran();
    let columns = columns(run);
    for row in [0, run.result.rows() / 2, run.result.rows() - 1] {
        for axle in 1..=4 {
            for (side, sign) in [("left", 1.0), ("right", -1.0)] {
                let at = |name: String| columns[name.as_str()][row];
                let stem = format!("axle_{axle}_{side}");
                let mut vertical = 0.0;
                for patch in 1..=3 {
                    let own = |what: &str| at(format!("{stem}_patch_{patch}_{what}"));
                    let (normal, angle) = (own("normal_force"), own("angle"));
                    // Up on the wheel, square to the axle.
                    vertical += normal * angle.cos() + sign * own("creep_y") * angle.sin();
                    if normal > 0.0 {
                        let [y, z] = ["y", "z"].map(own);
                        assert!((sign * y - 0.75).abs() < 0.06, "{stem}: {y} m");
                        assert!((-0.49..-0.44).contains(&z), "{stem}: {z} m");
                    }
                }
                let wanted = at(format!("{stem}_vertical"));
                assert!(
                    (vertical / wanted - 1.0).abs() < 0.01,
                    "{stem}: {vertical} N of {wanted} N"
                );
            }
        }
    }
}

/// In a curve the body lies inside of the arc of its trucks by the chord, `c²/(8 R)`, the wheelsets turn by
/// the distance over the radius of the wheels, and what is drawn of a wedge is in balance along the truck.
#[test]
fn analytic_body_wheels_and_wedges_are_where_they_must_be() {
    let run = ran();
    let columns = columns(run);
    let last = run.result.rows() - 1;
    let own = &run.case.parameters;
    let radius = 50.0 * 0.3048 / (3.75_f64).to_radians().sin();
    // Rails are 59 in apart where 4 in of superelevation tilt the plane in which it lies.
    let chord = own.truck_distance.powi(2) / (8.0 * radius) * (4.0_f64 / 59.0).asin().cos();
    let found = columns["chord_lateral"][last];
    assert!((found / chord - 1.0).abs() < 1e-3, "{found} m, {chord} m");
    let body = columns["body_lateral"][last];
    assert!((body - chord).abs() < 0.04, "{body} m");
    for axle in 1..=4 {
        let at = |what: &str, row: usize| columns[format!("axle_{axle}_{what}").as_str()][row];
        let way = at("distance", last) - at("distance", 0);
        let turned = at("spin", last) - at("spin", 0);
        assert!(
            (turned * own.wheel_radius() / way - 1.0).abs() < 5e-3,
            "{way} m, {turned} rad"
        );
    }
    let scene = scene(&run.case, &run.result).unwrap();
    for pair in scene.contacts.chunks(2) {
        let mut sum = 0.0;
        let mut most: f64 = 0.0;
        for contact in pair {
            let solid = scene.solids.iter().find(|own| own.id == contact.on).unwrap();
            let (sine, cosine) = solid.mount.angles[1].sin_cos();
            let [x, _, z] = contact.normal;
            let normal = columns[contact.normal_force.as_str()][last];
            sum += normal * (x * cosine + z * sine) + columns[contact.friction[0].as_str()][last];
            most = most.max(normal);
        }
        assert!(
            most > 1e3 && sum.abs() < 0.02 * most,
            "{}: {sum} N of {most} N",
            pair[0].id
        );
    }
}

/// Halves of split wedges are drawn beside each other, each with its own faces, whose forces sum to those of
/// the wedge; the other truck's wedges are in one piece.
#[test]
fn analytic_halves_of_split_wedges_are_bodies_of_their_own() {
    let text = "model = \"car\"\nstart.settle = \"0 s\"\nspeed.value = \"28 mph\"\n\
                simulation.duration = \"0.1 s\"\nrear_truck.wedge.kind = \"split\"\n\
                rear_truck.wedge.slope_across = \"-8 deg\"\n";
    let case = CarCase::parse("split.toml", text, Tables::nowhere(), &[]).unwrap();
    let run = Run::with_motions(&case).unwrap();
    let (result, motions) = run.finish_with_motions(|_| ControlFlow::Continue(()));
    let run = CarRun {
        case,
        result,
        motions,
    };
    let columns = columns(&run);
    let scene = scene(&run.case, &run.result).unwrap();
    for name in scene.columns() {
        assert_eq!(columns[name.as_str()].len(), run.result.rows(), "{name}");
    }
    assert_eq!(scene.bodies.len(), 1 + 8 + 12 + 4 * 2);
    assert_eq!(scene.contacts.len(), 8 + 16);
    let last = run.result.rows() - 1;
    let at = |name: &str| columns[format!("truck_2_{name}").as_str()][last];
    for wedge in ["leading_left", "leading_right", "trailing_left", "trailing_right"] {
        for face in ["column", "slope"] {
            let own = |part: &str| at(&format!("{wedge}{part}_{face}_normal"));
            let [outboard, inboard, whole] = [own("_outboard"), own("_inboard"), own("")];
            assert!(outboard > 0.2 * whole && (outboard + inboard - whole).abs() < 1e-9 * whole);
        }
        assert!(at(&format!("{wedge}_split_normal")) > 0.0);
        let place = |part: &str| {
            let id = format!("truck_2_{wedge}_{part}_wedge");
            scene.bodies.iter().find(|own| own.id == id).unwrap().position[1]
        };
        let width = run.case.parameters.trucks[1].wedges[0].width;
        let apart = (place("outboard") - place("inboard")).abs();
        assert!(
            (apart / (0.5 * width) - 1.0).abs() < 1e-4,
            "{apart} m of {width} m"
        );
    }
    assert!(!columns.contains_key("truck_1_leading_left_outboard_column_normal"));
}

/// The page holds the run, and is not too large.
#[test]
fn input_the_page_moves() {
    let run = ran();
    let page = car_run::render(run).unwrap();
    assert!(page.contains("data-run=\"curve\"") && page.contains("wedgelab-view"));
}
