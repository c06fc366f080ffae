//! Wedge rise as an input, as a result, and where it ends.
#![allow(clippy::unwrap_used)]

use study::case::{Case, Tables};
use study::run::Run;
use study::truck::TruckCase;

use crate::common::{INCH, POUND_FORCE, case, column, read_back, run};
use crate::problems::in_words;

fn parsed(lines: &str) -> TruckCase {
    let text = format!("model = \"truck\"\n{lines}");
    TruckCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

fn refused(lines: &str) -> String {
    let text = format!("model = \"truck\"\n{lines}");
    let error = TruckCase::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap_err();
    in_words(error.problems())
}

/// (c cos θ + s)/sin θ: 0.25 in on both faces at 32° are 0.872 in, 0.3 in are 1.046 in.
#[test]
fn analytic_a_rise_makes_the_depths_of_its_formula() {
    for (rise, depth) in [(0.8716, 0.25), (1.0459, 0.3)] {
        let own = parsed(&format!("wedge.rise = \"{rise} in\"\n"));
        for wedge in &own.parameters.wedges {
            assert!(
                (wedge.wear.column / INCH - depth).abs() < 1e-4,
                "{:?}",
                wedge.wear
            );
            assert!((wedge.wear.slope / INCH - depth).abs() < 1e-4, "{:?}", wedge.wear);
        }
    }
    // All of it at the column: s = 0.
    let own = parsed("[wedge]\nrise = \"0.5 in\"\nrise_column_share = 1.0\n");
    let wear = own.parameters.wedges[0].wear;
    assert_eq!(wear.slope, 0.0);
    assert!((wear.column / INCH - 0.5 * 32f64.to_radians().tan()).abs() < 1e-12);
    // The same in a case of a single wedge, whose angle is 37.5° with constant damping.
    let text = "[wedge]\ndamping = \"constant\"\nrise = \"0.5 in\"\n";
    let single = Case::parse("case.toml", text, Tables::nowhere(), &[]).unwrap();
    assert!((single.parameters.wedge_rise() / INCH - 0.5).abs() < 1e-12);
    assert_eq!(single.parameters.wear.column, single.parameters.wear.slope);
    let again = Case::parse("again.toml", single.to_toml(), Tables::nowhere(), &[]).unwrap();
    assert_eq!(again.parameters, single.parameters);
}

/// Under half a car the wedges stand higher by as much as they are said to, less what they are pressed in
/// less, since their coils have become longer: 1 % at the default stiffness. With the stiffness k of a face
/// along the vertical, `1/k = (cot² θ + 1/sin² θ)/K`, and the coils' k_c, that is `k_c/k` of the coils'
/// extension: all of the rise where they stand on the bolster; where they stand on the side frames the
/// bolster sinks by their part of the nest.
#[test]
fn analytic_wedges_rise_as_said_under_load() {
    let nests = 1.0 / (1.0 / (8.0 * 5369.5) + 1.0 / (8.0 * 5e5));
    for (damping, angle, coil, extension) in [
        ("constant", 37.5_f64, 1979.0, 1.0),
        ("variable", 32.0, 1937.0, nests / (nests + 4.0 * 1937.0)),
    ] {
        let name = format!("truck_drop_{damping}");
        let start = |rise: f64| {
            let rise = format!("wedge.rise={rise} in");
            let set = [
                "start.kind=equilibrium",
                "start.lift=0 in",
                "simulation.duration=0.1 s",
                &rise,
            ];
            let result = run(&name, &set);
            let own = column(&result, "leading_left_rise")[0];
            let summary = &result.summary.wedge_rise["leading_left"];
            assert!((summary.at_start.value - own / INCH).abs() < 1e-9);
            assert!(result.summary.warnings.iter().all(|own| !own.contains("pocket")));
            own
        };
        let (sine, cosine) = angle.to_radians().sin_cos();
        let vertical = 4.0 * 2.5e5 * sine * sine / (1.0 + cosine * cosine);
        let share = 1.0 / (1.0 + coil / vertical * extension);
        assert!(share > 0.985);
        let new = start(0.0);
        for rise in [0.25, 0.5, 1.0] {
            let found = (start(rise) - new) / INCH;
            assert!(
                (found / (rise * share) - 1.0).abs() < 2e-3,
                "{damping}: {found}, {}",
                rise * share
            );
        }
    }
}

/// The coil of constant damping is 3702.2/1979 = 1.871 in shorter than free in the nominal layout: 0.025 in
/// before that it carries the wedge's 50 lbf alone.
#[test]
fn limits_coils_without_load_and_wedges_out_of_their_pockets_are_told() {
    let name = "truck_crowned_vertical_constant";
    let result = run(name, &["wedge.rise=0.5 in"]);
    let own = &result.summary.wedge_rise["trailing_right"];
    let limit = own.coil_without_load.as_ref().unwrap();
    assert_eq!(limit.unit, "in");
    assert!((limit.value - (3702.2 - 50.0) / 1979.0).abs() < 0.01, "{limit:?}");
    assert!((own.pocket.value - 1.5).abs() < 1e-9);
    let loose = run(
        name,
        &[
            "wedge.rise=1.95 in",
            "wedge.rise_limit=2 in",
            "simulation.duration=1 s",
        ],
    );
    let told = loose.summary.warnings.join("\n");
    assert!(
        told.contains("control coils carry no more than their wedges"),
        "{told}"
    );
    assert!(told.contains("from a rise of 1.84"), "{told}");
    // Depths have no limit as they are read.
    let high = run(
        name,
        &[
            "wedge.column_wear=0.6 in",
            "wedge.slope_wear=0.6 in",
            "simulation.duration=1 s",
        ],
    );
    let told = high.summary.warnings.join("\n");
    assert!(
        told.contains("higher at the start than their pockets hold"),
        "{told}"
    );
    // At rest in the nominal layout a worn wedge does not stand where its wear lifts it.
    let still = run(
        "truck_vertical_constant",
        &["wedge.rise=0.5 in", "simulation.duration=0.1 s"],
    );
    let told = still.summary.warnings.join("\n");
    assert!(told.contains("start.kind = \"equilibrium\""), "{told}");
}

/// At rest without friction a worn wedge is in balance: its coil, longer by the rise, carries it on the
/// slope, and leans to the column that has receded.
#[test]
fn analytic_a_worn_wedge_presses_less_and_its_coil_leans() {
    let name = "truck_crowned_vertical_constant";
    let (sine, cosine) = 37.5f64.to_radians().sin_cos();
    let mut columns = Vec::new();
    for rise in ["wedge.rise=0 in", "wedge.rise=0.75 in"] {
        let still = "bolster.vertical=0 in";
        let result = run(name, &["simulation.duration=0.1 s", still, rise]);
        let at = |what: &str| column(&result, &format!("leading_left_{what}"))[0];
        let [x, z] = ["x", "z"].map(|own| at(own) / INCH);
        let [on_column, on_slope] = ["column_normal", "slope_normal"].map(|own| at(own) / POUND_FORCE);
        // A coil of 3702.2 lbf, 1979 lbf/in, 1346 lbf/in across; a wedge of 50 lbf.
        assert!(
            (on_slope * sine - (3702.2 - 1979.0 * z - 50.0)).abs() < 2.0,
            "{on_slope} {z}"
        );
        assert!(
            (on_slope * cosine - 1346.0 * x - on_column).abs() < 2.0,
            "{on_column} {x}"
        );
        columns.push(on_column);
    }
    assert!(columns[1] < 0.55 * columns[0], "{columns:?}");
}

#[test]
fn input_rises_and_depths_are_refused_together_and_beyond_the_pocket() {
    for (lines, parts) in [
        (
            "[wedge]\nrise = \"0.5 in\"\ncolumn_wear = \"0.1 in\"",
            &[
                "`wedge.column_wear` is 0.1 in",
                "`wedge.rise` is given too",
                "leave out rise",
            ][..],
        ),
        (
            "[wedge]\nrise = \"1.6 in\"",
            &[
                "`wedge.rise` is 1.6 in",
                "the pocket holds a rise of 1.5 in",
                "rise_limit",
            ],
        ),
        (
            "[wedge]\nrise = \"-0.1 in\"",
            &["`wedge.rise` is -0.1 in", "zero or greater"],
        ),
        (
            "[wedge]\nrise = \"0.5 deg\"",
            &["this is an angle", "a length is expected"],
        ),
        (
            "[wedge]\nrise_column_share = 1.5",
            &["`wedge.rise_column_share` is 1.5", "from 0 to 1"],
        ),
        (
            "[wedge.leading_left]\nrise = \"2 in\"",
            &["`wedge.leading_left.rise` is 2 in", "the pocket holds"],
        ),
        (
            "[slope_face]\nwedge_surface = { shape = \"crown\", radius = \"5 in\", direction = \"across\" }",
            &["a radius of more than half of the face"],
        ),
        (
            "[slope_face]\nwedge_surface = { shape = \"crown\", radius = \"240 in\", direction = \"across\", \
             worn_flat = \"0.1 in\" }",
            &["worn flat by less than its depth at the edges"],
        ),
        (
            "[slope_face]\ncounterface = { shape = \"crown\", radius = \"240 in\", direction = \"across\", \
             worn_flat = \"0.01 in\" }",
            &["there is no key `worn_flat`"],
        ),
    ] {
        let found = refused(lines);
        for part in parts {
            assert!(found.contains(part), "{lines}: {part}\n{found}");
        }
    }
    let text = "[wedge]\nrise = \"0.5 in\"\nslope_wear = \"0.1 in\"\n";
    let error = Case::parse("case.toml", text, Tables::nowhere(), &[]).unwrap_err();
    let found = in_words(error.problems());
    assert!(found.contains("`wedge.rise` is given too"), "{found}");
}

/// A rise laid over a complete case, whose depths are zero, and single wedges over all four.
#[test]
fn input_rises_of_all_and_of_single_wedges() {
    let complete = case("truck_crowned_vertical_variable", &[]).to_toml().to_owned();
    let over = ["wedge.rise=0.5 in".to_owned()];
    let own = TruckCase::parse("case.toml", &complete, Tables::nowhere(), &over).unwrap();
    let rise = |case: &TruckCase, number: usize| {
        let wedge = &case.parameters.wedges[number];
        wedge.wear.rise(wedge.rise_angles()) / INCH
    };
    assert!((rise(&own, 3) - 0.5).abs() < 1e-12);
    assert_eq!(read_back(&own).parameters, own.parameters);
    let own = parsed(
        "[wedge]\nrise = \"0.5 in\"\n[wedge.leading_left]\nrise = \"0.25 in\"\n\
         [wedge.leading_right]\ncolumn_wear = \"0 in\"\n[side_frame]\ntoe = \"1 deg out\"\n",
    );
    assert!((rise(&own, 0) - 0.25).abs() < 1e-12);
    assert!((rise(&own, 2) - 0.5).abs() < 1e-12);
    // Its column is not worn, its slope is as that of all.
    let [_, right, other, _] = &own.parameters.wedges;
    assert_eq!(right.wear.column, 0.0);
    assert!((right.wear.slope / other.wear.slope - 1.0).abs() < 1e-9);
    let again = read_back(&own);
    for (own, again) in own.parameters.wedges.iter().zip(&again.parameters.wedges) {
        assert!((own.wear.slope / again.wear.slope - 1.0).abs() < 1e-12);
    }
    assert!(Run::new(&own).is_ok());
}

/// The older name of a friction of 0.25 is read, and written by its new one.
#[test]
fn input_the_condition_worn_is_mu_0_25() {
    let old = parsed("truck.condition = \"worn\"\n");
    let new = parsed("truck.condition = \"mu_0.25\"\n");
    assert_eq!(old.parameters, new.parameters);
    assert_eq!(old.parameters.wedges[0].column_friction.coefficient, 0.25);
    assert!(old.to_toml().contains("condition = \"mu_0.25\""));
}

#[test]
fn input_the_center_plate_has_a_diameter_or_its_older_radius() {
    let rings = |lines: &str| {
        let own = parsed(&format!("load.kind = \"car_body\"\n{lines}"));
        own.parameters.car_body.unwrap().center_plate.rings
    };
    let wide = rings("center_plate.diameter = \"16 in\"\n");
    assert_eq!(wide, rings("center_plate.radius = \"8 in\"\n"));
    assert!((wide[0] / INCH - 8.0).abs() < 1e-12 && (wide[1] / wide[0] - 1.0 / 3.0).abs() < 1e-12);
    let both = "load.kind = \"car_body\"\n[center_plate]\ndiameter = \"16 in\"\nradius = \"8 in\"\n";
    let found = refused(both);
    assert!(found.contains("one of two") || found.contains("too"), "{found}");
}
