//! The sections of the wedge's faces: read, written, refused; the same in trucks.

use mechanics::surface::SurfaceProfile;
use study::case::{Case, CaseError, Tables};
use study::run::Run;
use study::truck::TruckCase;
use wedge::face::{FaceDirection, Grid};

const FACES: &str = r#"
[column_face]
grid = [5, 3]
counterface = { shape = "table", direction = "up", points = [
    ["-4 in", "0.03 in"], ["-1 in", "0.001 in"], ["1 in", "0 in"], ["4 in", "0.02 in"],
] }
sliding_friction = 0.3
stribeck_speed = "0.05 in/s"
wedge_wear = [
    ["-9 in", "-9 in", "0 in"], ["-9 in", "9 in", "0.01 in"],
    ["9 in", "-9 in", "0.02 in"], ["9 in", "9 in", "0.04 in"],
]

[slope_face]
grid = [9, 2]
wedge_surface = { shape = "crown", radius = "90 in", direction = "up" }
counterface = { shape = "hollow", radius = "200 in", direction = "across" }
friction_half_load = "30000 lbf"
friction_map = [[1.0, 1.0], [0.5, 0.75]]
pad.stiffness = "4e5 lbf/in"
pad.damping = "50 lbf s/in"
pad.hardening = "0.02 in"
pad.friction = 0.6
pad.shear_stiffness = "1e5 lbf/in"
pad.shear_damping = "100 lbf s/in"
"#;

fn read(text: &str) -> Result<Case, CaseError> {
    let text = format!("name = \"faces\"\n[wedge]\ndamping = \"constant\"\n{text}");
    Case::parse("case.toml", &text, Tables::nowhere(), &[])
}

fn read_truck(text: &str) -> Result<TruckCase, CaseError> {
    let text = format!("model = \"truck\"\nname = \"faces\"\n{text}");
    TruckCase::parse("case.toml", &text, Tables::nowhere(), &[])
}

#[test]
fn input_faces_are_read_and_written_back() {
    let case = read(FACES).unwrap();
    let p = &case.parameters;
    assert_eq!(p.column_face.grid, Grid { up: 5, across: 3 });
    assert!(matches!(
        p.column_face.counterface.profile,
        SurfaceProfile::Table(_)
    ));
    assert_eq!(p.column_face.sliding_friction, Some(0.3));
    let map = p.column_face.wedge_wear.as_ref().unwrap();
    assert!((map.depth(0.0, 0.0) - 0.0175 * 0.0254).abs() < 1e-16);
    assert!((p.column_face.stribeck_speed - 0.05 * 0.0254).abs() < 1e-18);
    let arc = |profile: &SurfaceProfile| match profile {
        SurfaceProfile::Arc { curvature } => *curvature,
        _ => f64::NAN,
    };
    assert!((arc(&p.slope_face.wedge_surface.profile) * 90.0 * 0.0254 - 1.0).abs() < 1e-14);
    assert!((arc(&p.slope_face.counterface.profile) * 200.0 * 0.0254 + 1.0).abs() < 1e-14);
    assert_eq!(p.slope_face.counterface.direction, FaceDirection::Across);
    assert_eq!(p.slope_face.friction_map, [[1.0, 1.0], [0.5, 0.75]]);
    let pad = p.slope_face.pad.unwrap();
    assert_eq!(pad.friction, 0.6);
    assert!(pad.hardening.is_some() && pad.shear.is_some());
    // What is written reads back to the same bits.
    let text = case.to_toml();
    let again = Case::parse("again.toml", text, Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters, case.parameters);
    // Left out, all is plain, and the keys stand there as comments.
    let plain = read("").unwrap();
    assert_eq!(plain.parameters.column_face.grid, Grid::default());
    assert!(plain.to_toml().contains("# sliding_friction = 0.3"));
    assert!(plain.to_toml().contains("wedge_surface = \"flat\""));
}

#[test]
fn input_faces_of_trucks_are_the_same() {
    let [wedge, truck] = [
        read(FACES).unwrap().parameters.slope_face,
        read_truck(FACES).unwrap().parameters.wedges[2].slope_face.clone(),
    ];
    assert_eq!(wedge, truck);
    let one = read_truck("[wedge.leading_left.slope_face]\ngrid = [4, 4]").unwrap();
    let grids = one
        .parameters
        .wedges
        .each_ref()
        .map(|wedge| wedge.slope_face.grid.up);
    assert_eq!(grids, [4, 2, 2, 2]);
    let again = TruckCase::parse("again.toml", one.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters.wedges, one.parameters.wedges);
}

#[test]
fn input_mistakes_in_faces_are_reported() {
    for (text, expected) in [
        ("[column_face]\ngrid = [1, 5]", "two whole numbers from 2 to 100"),
        ("[column_face]\ngrid = 5", "two whole numbers from 2 to 100"),
        (
            "[column_face]\ngird = [5, 5]",
            "there is no key `gird` in `column_face`",
        ),
        ("[slope_face]\nwedge_surface = \"round\"", "cannot be \"round\""),
        (
            "[slope_face]\nwedge_surface = { shape = \"crown\", direction = \"up\" }",
            "`slope_face.wedge_surface.radius` is missing",
        ),
        (
            "[slope_face]\nwedge_surface = { shape = \"crown\", radius = \"3 in\", direction = \"across\" }",
            "more than half of the face",
        ),
        (
            "[slope_face]\n\
             counterface = { shape = \"table\", direction = \"up\", points = [[\"0 in\", \"0 in\"], [\"1 \
             in\", \"0 in\"], [\"2 in\", \"0 in\"], [\"3 in\", \"0 in\"]] }",
            "from edge to edge of the face",
        ),
        (
            "[column_face]\nwedge_wear = 3",
            "`column_face.wedge_wear` is a number; a table is expected",
        ),
        (
            "[column_face]\nwedge_waer = \"map.csv\"",
            "there is no key `wedge_waer` in `column_face`",
        ),
        (
            "[column_face]\nwedge_wear = [[\"1 in\", \"1 in\"]]",
            "is not a triple of up, across and depth",
        ),
        (
            "[column_face]\n\
             wedge_wear = [[\"-9 in\", \"-9 in\", \"0 s\"], [\"-9 in\", \"9 in\", \"0 in\"], [\"9 in\", \
             \"-9 in\", \"0 in\"], [\"9 in\", \"9 in\", \"0 in\"]]",
            "this is a time (s); a length is expected",
        ),
        (
            "[column_face]\n\
             wedge_wear = [[\"-9 in\", \"-9 in\", \"0 in\"], [\"-9 in\", \"9 in\", \"0 in\"], [\"9 in\", \
             \"-9 in\", \"0 in\"], [\"9 in\", \"8 in\", \"0 in\"]]",
            "make no rectangle of 2 places up the face by 3 across it",
        ),
        (
            "[slope_face]\n\
             wedge_wear = [[\"0 in\", \"-9 in\", \"0 in\"], [\"0 in\", \"9 in\", \"0 in\"], [\"9 in\", \
             \"-9 in\", \"0 in\"], [\"9 in\", \"9 in\", \"0 in\"]]",
            "a map from edge to edge of the face",
        ),
        (
            "[slope_face]\n\
             counterface_wear = [[\"-9 in\", \"-9 in\", \"0 in\"], [\"-9 in\", \"9 in\", \"0 in\"], [\"9 \
             in\", \"-9 in\", \"0 in\"], [\"9 in\", \"9 in\", \"0 in\"]]",
            "four places up and four across",
        ),
        ("[column_face]\nsliding_friction = 11", "between 0 and 10"),
        ("[column_face]\nstribeck_speed = \"3 in\"", "speed"),
        (
            "[column_face]\nfriction_map = [[1.0], [1.0, 2.0]]",
            "rows of equally many factors",
        ),
        (
            "[slope_face]\npad = { stiffness = \"1e5 lbf/in\", friction = 0.5 }",
            "`slope_face.pad.damping` is missing",
        ),
        (
            "[slope_face]\n\
             pad = { stiffness = \"1e5 lbf/in\", damping = \"0 lbf s/in\", friction = 0.5, shear_damping \
             = \"1 lbf s/in\" }",
            "has shear_damping but no shear_stiffness",
        ),
    ] {
        for (model, error) in [
            ("wedge", read(text).unwrap_err().to_string()),
            ("truck", read_truck(text).unwrap_err().to_string()),
        ] {
            assert!(error.contains(expected), "{model}, {text}: {error}");
        }
    }
    let massless = "[wedge]\nkind = \"massless\"\n[slope_face]\ngrid = [3, 3]";
    let error = read_truck(massless).unwrap_err().to_string();
    assert!(error.contains("a massless wedge has no faces"), "{error}");
}

/// Maps of wear from files: read, named again, embedded; mistakes in them have their place.
#[test]
fn input_maps_of_wear_come_from_files() {
    let folder = tempfile::tempdir().unwrap();
    let read = |csv: &str| {
        std::fs::write(folder.path().join("map.csv"), csv).unwrap();
        let text = "name = \"worn\"\n[slope_face]\nwedge_wear = \"map.csv\"\n";
        Case::parse("case.toml", text, folder.path(), &[])
    };
    let good = "up [in], across [in], depth [mm]\n-9, -9, 0\n-9, 9, 1\n9, -9, 2\n9, 9, 3\n";
    let case = read(good).unwrap();
    let map = case.parameters.slope_face.wedge_wear.clone().unwrap();
    assert!((map.depth(0.0, 0.0) - 0.0015).abs() < 1e-16);
    assert!(case.to_toml().contains("wedge_wear = \"map.csv\""));
    let embedded = case.to_toml_embedded();
    let again = Case::parse("again.toml", embedded, Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters, case.parameters);
    for (csv, expected) in [
        (good.replace("2\n", "nan\n"), "not a finite number"),
        (good.replace("[mm]", "[s]"), "[s]"),
        (good.replace(", depth [mm]", ""), "three columns are expected"),
        (
            good.replace("9, 9, 3\n", "9, 9\n"),
            "2 values in this line; three are expected",
        ),
        (good.replace("9, 9, 3\n", ""), "has 3 rows; at least 4"),
        (good.replace("9, 9, 3\n", "8, 9, 3\n"), "make no rectangle"),
    ] {
        let error = read(&csv).unwrap_err().to_string();
        assert!(error.contains(expected), "{csv}: {error}");
    }
}

#[test]
fn analytic_a_run_with_refined_faces_has_their_pressures() {
    let text = format!("{FACES}\n[simulation]\nduration = \"0.2 s\"\nstart = \"equilibrium\"");
    let case = read(&text).unwrap();
    let whole = Run::new(&case).unwrap().finish(|_| ());
    assert!(whole.summary.complete, "{:?}", whole.summary.stopped);
    assert!(whole.summary.failed.is_none());
    let pressure = whole.column("slope_point_5_1_pressure").unwrap();
    assert!(pressure.iter().any(|value| *value > 1e5));
    // Pressures of a face, each on its part of it, are its normal force.
    let face = &case.parameters.slope_face;
    let areas = face.areas(&case.parameters.rectangles()[1]);
    let row = pressure.len() / 2;
    let total: f64 = face
        .grid
        .points()
        .iter()
        .zip(areas)
        .map(|(point, area)| {
            whole
                .column(&format!("slope_{}_pressure", point.number()))
                .unwrap()[row]
                * area
        })
        .sum();
    assert!(total > 1000.0);
    assert!(
        whole
            .summary
            .assumptions
            .iter()
            .any(|line| line.contains("9 x 2 points"))
    );
}

/// Curved faces with too few points where they are pressed are told, with a grid that has enough.
#[test]
fn limits_too_few_points_on_a_curved_face_are_reported() {
    let warned = |grid: &str, surface: &str| -> Vec<String> {
        let text = format!(
            "[slope_face]\ngrid = {grid}\nwedge_surface = {surface}\n[simulation]\nduration = \"0.3 \
             s\"\nstart = \"equilibrium\"\n"
        );
        let whole = Run::new(&read(&text).unwrap()).unwrap().finish(|_| ());
        let warnings = whole.summary.warnings.into_iter();
        warnings
            .filter(|line| line.contains("face is") || line.contains("curved"))
            .collect()
    };
    let crown = "{ shape = \"crown\", radius = \"300 in\", direction = \"up\" }";
    let few = warned("[9, 2]", crown);
    assert_eq!(few.len(), 1, "{few:?}");
    assert!(few[0].contains("the curved slope face is pressed at"), "{few:?}");
    // With the grid that it names the warning is gone.
    let grid = few[0].rsplit_once("slope_face.grid = ").unwrap().1;
    assert_eq!(warned(grid, crown), Vec::<String>::new());
    let corners = warned("[2, 2]", crown);
    assert!(corners[0].contains("has 2 points there"), "{corners:?}");
    assert_eq!(warned("[9, 2]", "\"flat\""), Vec::<String>::new());
}
