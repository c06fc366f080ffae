//! Crowned faces of wedges in service: what is default, warp with other radii, and points that are too few.
#![allow(clippy::unwrap_used)]

use mechanics::surface::SurfaceProfile;
use study::case::Tables;
use study::run::Run;
use study::truck::TruckCase;
use study::truck::warp::WarpCurve;
use truck::{CROWN_RADIUS, SERVICE_GRID};
use wedge::face::FaceDirection;

use crate::common::{KIP_INCH, case, read_back, run};

const CONSTANT: &str = "truck_warp_nest_constant_rising";
const VARIABLE: &str = "truck_warp_nest_variable_rising";
const ANGLES: [f64; 6] = [0.5e-3, 1e-3, 2e-3, 5e-3, 10e-3, 20e-3];

fn crown(face: &str, radius: f64, direction: &str, grid: [usize; 2]) -> Vec<String> {
    vec![
        format!("{face}_face.wedge_surface={{shape='crown',radius='{radius} in',direction='{direction}'}}"),
        format!("{face}_face.grid={grid:?}"),
    ]
}

/// Returns the warp stiffness at the angles, kip·in/mrad, and what is implausible or warned of.
fn warp(name: &str, set: &[String]) -> ([f64; 6], Vec<String>) {
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let (case, result) = (case(name, &set), run(name, &set));
    let curve = WarpCurve::of(&case, &result).unwrap();
    let at = |angle: f64| {
        let found = curve.stiffness.iter().find(|(own, _)| *own == angle);
        1e-3 * found.unwrap().1 / KIP_INCH
    };
    (ANGLES.map(at), result.summary.warnings)
}

/// Stiffness of the truck with flat and crowned faces, kip·in/mrad, as measured with this program before
/// crowned faces became its default: no other program has such faces.
#[test]
fn reproduction_warp_with_crowned_faces() {
    let fine = [2, 41];
    let both = [
        crown("slope", 240.0, "across", [2, 9]),
        vec!["column_face.grid=[2, 9]".to_owned()],
    ]
    .concat();
    let rows: [(&str, Vec<String>, [f64; 6]); 10] = [
        (CONSTANT, Vec::new(), [143.0, 93.0, 66.0, 45.0, 37.5, 31.5]),
        (
            CONSTANT,
            crown("slope", 240.0, "across", [2, 9]),
            [70.0, 54.0, 34.0, 18.0, 15.0, 13.5],
        ),
        (
            CONSTANT,
            crown("slope", 120.0, "across", [2, 9]),
            [64.0, 48.0, 30.0, 15.5, 11.0, 9.5],
        ),
        (
            CONSTANT,
            crown("slope", 60.0, "across", fine),
            [53.0, 42.7, 27.9, 13.6, 8.6, 6.5],
        ),
        (
            CONSTANT,
            crown("column", 240.0, "across", [2, 9]),
            [84.9, 56.8, 34.2, 19.0, 16.5, 14.1],
        ),
        (
            CONSTANT,
            crown("slope", 240.0, "up", [9, 2]),
            [118.0, 88.0, 59.0, 40.0, 32.5, 27.3],
        ),
        (CONSTANT, both, [69.4, 53.9, 34.2, 18.3, 13.9, 11.4]),
        (VARIABLE, Vec::new(), [189.0, 144.0, 94.0, 60.0, 48.0, 41.5]),
        (
            VARIABLE,
            crown("slope", 240.0, "across", [2, 9]),
            [101.0, 84.0, 59.0, 34.0, 25.0, 20.8],
        ),
        (
            VARIABLE,
            crown("slope", 60.0, "across", fine),
            [69.0, 61.0, 48.0, 25.0, 15.4, 10.9],
        ),
    ];
    for (name, set, expected) in rows {
        let (found, _) = warp(name, &set);
        for ((angle, found), expected) in ANGLES.iter().zip(found).zip(expected) {
            // The measured values have two or three digits.
            assert!(
                (found / expected - 1.0).abs() < 0.03,
                "{name} {set:?} at {angle}: {found}, {expected}"
            );
        }
    }
}

/// Twice the points move the default's warp by less than 3 %, and the crown takes the influence of the
/// contacts' stiffness.
#[test]
fn convergence_of_crowned_faces() {
    let name = "truck_crowned_warp_nest_constant";
    let (own, warnings) = warp(name, &[]);
    assert!(warnings.is_empty(), "{warnings:?}");
    let (fine, _) = warp(name, &["slope_face.grid=[2, 41]".to_owned()]);
    for (own, fine) in own.iter().zip(fine) {
        assert!((own / fine - 1.0).abs() < 0.03, "{own} {fine}");
    }
    let stiff = "contact.stiffness=2.5e6 lbf/in".to_owned();
    let ratio = |set: &[String]| {
        let stiffer = [set, std::slice::from_ref(&stiff)].concat();
        warp(CONSTANT, &stiffer).0[5] / warp(CONSTANT, set).0[5]
    };
    let (flat, crowned) = (ratio(&[]), ratio(&crown("slope", 240.0, "across", [2, 9])));
    assert!(flat > 4.0 && crowned < 2.5, "{flat} {crowned}");
}

#[test]
fn trucks_have_crowned_faces_unless_they_say_otherwise() {
    let text = "model = \"truck\"\n";
    let case = TruckCase::parse("case.toml", text, Tables::nowhere(), &[]).unwrap();
    for wedge in &case.parameters.wedges {
        assert_eq!([wedge.column_face.grid, wedge.slope_face.grid], [SERVICE_GRID; 2]);
        assert!(wedge.column_face.wedge_surface.profile.is_flat());
        let own = &wedge.slope_face.wedge_surface;
        assert_eq!(own.direction, FaceDirection::Across);
        let SurfaceProfile::Arc { curvature } = own.profile else {
            unreachable!("{own:?}");
        };
        assert!((curvature * CROWN_RADIUS - 1.0).abs() < 1e-12);
    }
    // The complete case says so, and reads back.
    assert!(
        case.to_toml().contains("radius = \"240 in\""),
        "{}",
        case.to_toml()
    );
    assert_eq!(read_back(&case).parameters, case.parameters);
    let massless = ["wedge.kind=massless".to_owned()];
    let own = TruckCase::parse("case.toml", text, Tables::nowhere(), &massless).unwrap();
    assert_eq!(read_back(&own).parameters, own.parameters);
}

#[test]
fn limits_a_crown_that_too_few_points_carry_is_told_with_the_number_it_needs() {
    let name = "truck_crowned_vertical_constant";
    let coarse = "slope_face.wedge_surface={shape='crown',radius='20 in',direction='across'}";
    let warned = |set: &[&str]| -> Vec<String> { run(name, set).summary.warnings };
    let warnings = warned(&[coarse]);
    let [only] = warnings.as_slice() else {
        unreachable!("{warnings:?}");
    };
    for part in [
        "crowned across by 20 in",
        "9 points",
        "3 more wedges",
        "Take grid = [2, 14]",
    ] {
        assert!(only.contains(part), "{part}: {only}");
    }
    let fine = warned(&[coarse, "slope_face.grid=[2, 14]"]);
    assert!(fine.is_empty(), "{fine:?}");
    assert!(warned(&[]).is_empty());
}

/// A crown worn flat bears on its flat: with a flat that leaves nothing of the crown in the middle of its
/// points the truck is as stiff in warp as with a flat face of the same points, to a few percent.
#[test]
fn limits_a_crown_worn_flat_lies_between_crowned_and_flat() {
    let name = "truck_crowned_warp_nest_constant";
    let surface = |more: &str| {
        vec![format!(
            "slope_face.wedge_surface={{shape='crown',radius='240 in',direction='across'{more}}}"
        )]
    };
    let flat = warp(name, &["slope_face.wedge_surface=flat".to_owned()]).0;
    let crowned = warp(name, &[]).0;
    let half = warp(name, &surface(",worn_flat='0.02 in'")).0;
    let nearly = warp(name, &surface(",worn_flat='0.0573 in'")).0;
    for angle in 1..6 {
        assert!(
            crowned[angle] < half[angle] && half[angle] < flat[angle],
            "{crowned:?} {half:?} {flat:?}"
        );
        assert!(
            (nearly[angle] / flat[angle] - 1.0).abs() < 0.03,
            "{nearly:?} {flat:?}"
        );
    }
}

#[test]
fn trucks_run_on_from_a_complete_case() {
    let own = case("truck_crowned_vertical_variable", &[]);
    let again = read_back(&own);
    assert_eq!(again.parameters, own.parameters);
    assert!(Run::new(&again).is_ok());
}
