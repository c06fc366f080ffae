//! Extreme loads of wedges and trucks against closed forms: lock-up and release, an overturned toe, bottomed
//! nests, impact of a lifted car, ten times the load. Each ends with a closed ledger.

#[path = "../three_piece/common.rs"]
mod trucks;

use crate::runs::{INCH, LBF, column};
use mechanics::quasi_static::{SlidingDirection, SlopeFriction};
use study::case::builtin;
use study::closed_form;
use study::jam::{JamMargins, statement};
use study::result::RunResult;
use study::run::Run;
use study::truck::{self, WEDGE_NAMES};

const GRAVITY: f64 = 386.0886;

fn run(name: &str, set: &[&str]) -> RunResult {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &set).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| {});
    assert!(result.summary.complete, "{name}: {:?}", result.summary.stopped);
    let residual = result.summary.ledger.largest_relative_residual;
    assert!(residual < 1e-5, "{name}: residual {residual}");
    result
}

/// Returns the value of a column at a time, in a unit; rows are 0.01 s apart.
fn at(result: &RunResult, name: &str, unit: f64, time: f64) -> f64 {
    column(result, name, unit)[(time / 0.01).round() as usize]
}

/// Pressed by 0.03 in, the wedge of friction 0.2 slides under the force of the quasi-static wedge on which
/// the faces close.
#[test]
fn a_pressed_wedge_with_a_positive_margin_slides_under_the_quasi_static_force() {
    let case = builtin::case("lock_up_friction_0.2").unwrap();
    let wedge = closed_form::wedge(&case.parameters);
    assert!((wedge.lock_up_margin(0.0).to_degrees() - 14.880).abs() < 1e-3);
    let result = run("lock_up_friction_0.2", &[]);
    for time in [1.4, 2.0, 2.9] {
        let load = at(&result, "coil_force", LBF, time) - 50.0;
        let slide = wedge
            .slide(SlidingDirection::Down, SlopeFriction::UpSlope, load)
            .unwrap();
        let normal = at(&result, "longitudinal_wedge_force", LBF, time);
        assert!(
            (normal / slide.column_normal - 1.0).abs() < 0.005,
            "{time} s: {normal} lbf, {}",
            slide.column_normal
        );
    }
}

/// With friction 0.4 it locks. Both faces hold first: the force grows by K/2 times the way. Then the slope
/// slips: by K cos θ cos(θ-ψ)/(2 cos ψ). With the pitch held this is exact; a wedge that may pitch gives 2 %
/// more way.
#[test]
fn a_locked_wedge_grows_against_the_stiffness_of_its_contacts() {
    let (angle, friction) = (37.5_f64.to_radians(), 0.4_f64.atan());
    let slope_slips = 0.5e6 * angle.cos() * (angle - friction).cos() / friction.cos();
    let set = "wedge.free_coordinates=[\"x\", \"z\"]";
    for (set, tolerance) in [(vec![set], 0.003), (vec![], 0.03)] {
        let result = run("lock_up_friction_0.4", &set);
        let growth = |from: f64, to: f64| {
            let [normal, pressed] = [("longitudinal_wedge_force", LBF), ("bolster_longitudinal", INCH)]
                .map(|(name, unit)| at(&result, name, unit, to) - at(&result, name, unit, from));
            -normal / pressed
        };
        let stuck = growth(0.3, 0.45);
        assert!((stuck / 0.5e6 - 1.0).abs() < tolerance, "{stuck} lbf/in");
        let slips = growth(0.8, 1.0);
        assert!(
            (slips / slope_slips - 1.0).abs() < tolerance,
            "{slips} lbf/in, {slope_slips}"
        );
    }
}

/// Forced down, the locked bolster moves under μ N_c, no sooner; raised by about d/tan θ it is free, and
/// slides under the force of the quasi-static wedge going up.
#[test]
fn a_locked_wedge_is_freed_by_the_force_of_its_friction_and_by_raising_the_bolster() {
    let result = run("lock_up_friction_0.4", &[]);
    let normal = at(&result, "longitudinal_wedge_force", LBF, 2.0);
    let vertical = at(&result, "net_force_on_bolster_z", LBF, 2.0);
    assert!(normal > 18_000.0, "{normal}");
    assert!(
        (vertical - (0.4 * normal - 50.0)).abs() < 1e-3 * normal,
        "{vertical} lbf"
    );
    // Before, the wedge does not move along the column but for its bristles.
    let before = at(&result, "wedge_z", INCH, 1.5) - at(&result, "wedge_z", INCH, 0.0);
    assert!(before.abs() < 0.005, "{before} in");
    // Raised from -0.2 in: first column and slope turn over under the locked force (K/2), then the slope
    // slips and the force falls, then the column turns over the other way, and the wedge goes up with the
    // bolster.
    let (angle, friction) = (37.5_f64.to_radians(), 0.4_f64.atan());
    let case = builtin::case("lock_up_friction_0.4").unwrap();
    let wedge = closed_form::wedge(&case.parameters);
    let load = at(&result, "coil_force", LBF, 3.6) - 50.0;
    let up = wedge
        .slide(SlidingDirection::Up, SlopeFriction::UpSlope, load)
        .unwrap()
        .column_normal;
    let after = at(&result, "longitudinal_wedge_force", LBF, 3.6);
    assert!((after / up - 1.0).abs() < 0.02, "{after} lbf, {up}");
    let lean = (angle - friction).tan();
    let slope_slips = 0.5e6 * angle.cos() * (angle - friction).cos() / friction.cos();
    let expected = normal * (0.4 - lean) / 0.5e6
        + (normal - up) / (slope_slips * angle.tan())
        + up * (0.4 + lean) / 0.5e6;
    let rise = column(&result, "bolster_vertical", INCH);
    let forces = column(&result, "longitudinal_wedge_force", LBF);
    let freed = (300..forces.len()).find(|row| forces[*row] < 1.02 * up).unwrap();
    let found = rise[freed] + 0.2;
    assert!(
        (0.9..1.15).contains(&(found / expected)),
        "{found} in, {expected} in"
    );
}

/// Between faces that open upwards nothing holds the wedge: it flies, and what the coil had stored is in its
/// height and speed, less what friction took. The run says so before all else.
#[test]
fn a_wedge_under_an_overturned_toe_is_pushed_out() {
    let result = run("overturned_toe", &[]);
    let warnings = &result.summary.warnings;
    for part in [
        "do not close upwards",
        "18.00 deg and the toe of 20.00 deg in",
        "-2.00 deg",
    ] {
        assert!(
            warnings.iter().any(|warning| warning.contains(part)),
            "{part}: {warnings:?}"
        );
    }
    assert!(
        warnings
            .iter()
            .any(|warning| warning.contains("has slid off its surface"))
    );
    let height = column(&result, "wedge_z", INCH);
    let coil = column(&result, "coil_force", LBF);
    let row = height.iter().position(|z| *z > 10.0).unwrap();
    assert!(coil[row].abs() < 1e-9, "the coil is free");
    let [x_rate, z_rate] = ["wedge_x_rate", "wedge_z_rate"].map(|name| column(&result, name, INCH)[row]);
    let stored = 0.5 * 3702.2_f64.powi(2) / 1979.0;
    let found = 50.0 * height[row] + 0.5 * 50.0 / GRAVITY * (x_rate * x_rate + z_rate * z_rate);
    assert!(
        (0.5..1.0).contains(&(found / stored)),
        "{found} of {stored} lbf in"
    );
    // It flies: from row to row its speed falls by g.
    let rates = column(&result, "wedge_z_rate", INCH);
    let columns = column(&result, "longitudinal_wedge_force", LBF);
    let free = (row..height.len() - 1)
        .find(|row| columns[*row] == 0.0 && columns[*row + 1] == 0.0)
        .unwrap();
    let fall = (rates[free] - rates[free + 1]) / 0.001;
    assert!((fall / GRAVITY - 1.0).abs() < 1e-3, "{fall} in/s²");
}

#[test]
fn margins_say_in_words_what_they_are() {
    let summary = |name: &str| run(name, &["simulation.duration=0.1 s"]).summary.jam.unwrap();
    let locks = summary("lock_up_friction_0.4");
    let near = |found: &study::summary::SummaryValue, degrees: f64| {
        assert_eq!(found.unit, "rad");
        assert!(
            (found.value.to_degrees() - degrees).abs() < 1e-3,
            "{found:?}, {degrees} deg"
        );
    };
    near(&locks.closing_angle, 37.5);
    near(&locks.lock_up, -6.103);
    near(&locks.down, 37.5);
    near(&locks.up, 37.5);
    assert!(locks.statement.contains("6.10 deg too much") && locks.statement.contains("below 0.339"));
    let slides = summary("lock_up_friction_0.2");
    assert!(slides.statement.contains("14.88 deg are left") && slides.statement.contains("0.339 on"));
    // A pad has a friction of its own.
    let padded = run(
        "lock_up_friction_0.4",
        &[
            "column_face.pad={ stiffness = \"2e6 lbf/in\", damping = \"100 lbf s/in\", friction = 0.1 }",
            "simulation.duration=0.02 s",
        ],
    );
    near(
        &padded.summary.jam.unwrap().lock_up,
        37.5 - 0.4_f64.atan().to_degrees() - 0.1_f64.atan().to_degrees(),
    );
    // Each wedge of a truck.
    let truck = trucks::run("truck_vertical_constant_toe_out", &["simulation.duration=0.02 s"]);
    for wedge in WEDGE_NAMES {
        near(
            &truck.summary.jam[wedge].lock_up,
            37.7 - 2.0 * 0.4_f64.atan().to_degrees(),
        );
    }
    let wedge = closed_form::wedge(&builtin::case("overturned_toe").unwrap().parameters);
    assert!(statement(&wedge, 0.0).contains("nothing holds the wedge"));
    let back: JamMargins = serde_json::from_str(&serde_json::to_string(&locks).unwrap()).unwrap();
    assert_eq!(back, locks);
}

// Trucks

fn truck(name: &str, set: &[&str]) -> truck::run::TruckResult {
    let result = trucks::run(name, set);
    let residual = result.summary.ledger.largest_relative_residual;
    assert!(residual < 1e-5, "{name}: residual {residual}");
    result
}

fn inches(result: &truck::run::TruckResult, name: &str) -> Vec<f64> {
    trucks::column(result, name)
        .iter()
        .map(|value| value / INCH)
        .collect()
}

type Nest = (&'static str, [f64; 3], Option<[f64; 3]>);
/// Of each damping: preload, stiffness and solid travel of a load coil; the same of a control coil that
/// stands on the side frame.
const DAMPINGS: [Nest; 2] = [
    ("constant", [15_403.8, 6468.7, 1.306], None),
    (
        "variable",
        [12_252.1, 5369.5, 1.406],
        Some([6303.0, 1937.0, 1.4085]),
    ),
];

/// Returns the force of a coil pressed by `travel` from the nominal layout, lbf: 250,000 lbf/in beyond its
/// solid travel.
fn coil_force([preload, stiffness, solid]: [f64; 3], travel: f64) -> f64 {
    preload + stiffness * travel + 250_000.0 * (travel - solid).max(0.0)
}

/// A pressed nest carries the force of its coils, beyond solid height 250,000 lbf more for each inch of each
/// of them, and the friction of its columns.
#[test]
fn a_bottomed_nest_carries_what_is_beyond_its_solid_height() {
    for (damping, load_coil, control_coil) in DAMPINGS {
        let result = truck(&format!("truck_bottomed_{damping}"), &[]);
        let force = |name: &str, row: usize| trucks::column(&result, name)[row] / LBF;
        let [bolster, side_frame, leading, trailing] = [
            "bolster_z",
            "left_side_frame_z",
            "leading_left_z",
            "trailing_left_z",
        ]
        .map(|name| inches(&result, name));
        let (mut bottomed, mut largest) = (0, 0.0_f64);
        for row in 0..bolster.len() {
            let travel = side_frame[row] - bolster[row];
            bottomed += usize::from(travel > load_coil[2] + 0.1);
            let found = force("left_nest_vertical_force", row);
            largest = largest.max(found);
            let columns =
                force("leading_left_column_friction_z", row) + force("trailing_left_column_friction_z", row);
            let control = control_coil.map_or(0.0, |coil| {
                [&leading, &trailing]
                    .map(|wedge| coil_force(coil, side_frame[row] - wedge[row]))
                    .iter()
                    .sum()
            });
            let expected = 4.0 * coil_force(load_coil, travel) + control - columns;
            assert!(
                (found - expected).abs() < 1e-3 * expected,
                "{damping} {row}: {found}, {expected}"
            );
        }
        assert!(
            bottomed > 40 && largest > 2.5e5,
            "{damping}: {bottomed} rows, {largest} lbf"
        );
    }
}

/// Without friction the lifted car falls freely onto its coils and strikes them at √(2gh); with it no faster.
#[test]
fn a_lifted_car_strikes_its_coils_at_the_speed_of_its_fall() {
    for (damping, [preload, stiffness, _], control) in DAMPINGS {
        let height = 4.0 - preload / stiffness;
        // Control coils that stand on the side frames meet the wedges before, and take a part of the energy.
        let before = control.map_or(0.0, |[force, rate, _]| {
            0.5 * 4.0 * rate * (force / rate - preload / stiffness).powi(2)
        });
        let expected = (2.0 * GRAVITY * (height - before / 123_230.0)).sqrt();
        let time = (2.0 * height / GRAVITY).sqrt();
        let speed = |more: &[&str]| {
            let fine = [
                "simulation.duration=0.12 s",
                "simulation.output_interval=0.0005 s",
            ];
            let result = trucks::run(&format!("truck_impact_{damping}"), &[&fine, more].concat());
            // A fall only turns stored energy into stored energy: its residual is told of the fall's energy.
            let residual = &result.summary.ledger.largest_residual;
            assert!(
                residual.unit == "lbf·in" && residual.value < 1e-4 * 123_030.0 * height,
                "{residual:?}"
            );
            let z = inches(&result, "bolster_z");
            let row = z.iter().position(|z| *z < 4.0 - height).unwrap();
            (0.0005 * row as f64, (z[row - 2] - z[row - 1]) / 0.0005)
        };
        let (found, fall) = speed(&["friction.column=0", "friction.slope=0"]);
        assert!((found - time).abs() < 0.001, "{damping}: {found} s, {time} s");
        // The speed is that of the middle between two rows, half a row to one and a half before.
        assert!(
            (expected - fall - GRAVITY * 0.0005).abs() < 0.6 * GRAVITY * 0.0005,
            "{damping}: {fall}, {expected} in/s"
        );
        let (_, slower) = speed(&[]);
        assert!(slower < fall + GRAVITY * 0.0005, "{damping}: {slower} in/s");
        let whole = truck(&format!("truck_impact_{damping}"), &[]);
        let lowest = inches(&whole, "bolster_z").into_iter().fold(0.0, f64::min);
        assert!((-2.5..-1.5).contains(&lowest), "{damping}: {lowest} in");
    }
}

/// Ten times the load rests where solid coils, adapters and, with variable damping, pressed wedges carry it:
/// in equilibrium at the closed form; a released car comes to rest about it.
#[test]
fn ten_times_the_load_rests_on_solid_coils() {
    const SOLID: f64 = 250_000.0;
    // A wedge of 32 deg without friction gives by (N_c cos θ + N_s)/(K sin θ).
    let (sine, cosine) = 32.0_f64.to_radians().sin_cos();
    let wedge = 1e6 * sine / ((cosine / sine) * cosine + 1.0 / sine);
    for (damping, [preload, stiffness, solid], control) in DAMPINGS {
        let name = format!("truck_ten_times_{damping}");
        let (weight, more) = (1_230_300.0, 1_230_300.0 - 123_030.0);
        // A load coil carries P + k t + K (t - s); a control coil the same with t less the wedge's give.
        let [mut constant, mut slope] = [8.0 * (preload - SOLID * solid), 8.0 * (stiffness + SOLID)];
        match control {
            Some([preload, stiffness, solid]) => {
                let series = 1.0 / (1.0 + (stiffness + SOLID) / wedge);
                constant += 4.0 * ((preload - SOLID * solid) * series - 50.0);
                slope += 4.0 * (stiffness + SOLID) * series;
            }
            None => constant -= 4.0 * 50.0,
        }
        let travel = (weight - constant) / slope;
        let expected = -travel - more / (8.0 * 5e5);
        let set = ["start.kind=equilibrium", "simulation.duration=0.02 s"];
        let still = truck(&name, &set);
        let found = inches(&still, "bolster_z")[0];
        assert!(
            (found - expected).abs() < 0.002,
            "{damping}: {found} in, {expected} in"
        );
        let released = truck(&name, &[]);
        let warnings = &released.summary.warnings;
        assert!(
            warnings
                .iter()
                .any(|warning| warning.contains("the truck sinks by about"))
        );
        let z = inches(&released, "bolster_z");
        let late = &z[200..];
        let mean = late.iter().sum::<f64>() / late.len() as f64;
        assert!(
            (mean / expected - 1.0).abs() < 0.1,
            "{damping}: {mean} in, {expected} in"
        );
    }
}

/// Nests that warp has locked hold half a car against a growing load, and let it go where the friction of the
/// columns is used up: it carries μ N then, straight up.
#[test]
fn a_locked_nest_holds_until_its_friction_is_used_up() {
    for (damping, held, freed, least) in [("constant", 2.6, 3.2, 0.5), ("variable", 3.0, 3.6, 0.3)] {
        let result = truck(&format!("truck_lock_up_{damping}"), &[]);
        let z = |time: f64| trucks::at(&result, "bolster_z", time) / INCH;
        assert!((z(held) - z(2.0)).abs() < 0.025, "{damping}: held");
        assert!(
            z(2.0) - z(4.0) > least,
            "{damping}: freed by {} in",
            z(2.0) - z(4.0)
        );
        for wedge in WEDGE_NAMES {
            let part = |time: f64| {
                let [friction, normal] = ["friction_z", "normal"]
                    .map(|what| trucks::at(&result, &format!("{wedge}_column_{what}"), time));
                -friction / normal
            };
            assert!(
                (part(freed) - 0.4).abs() < 1e-3,
                "{damping} {wedge}: {}",
                part(freed)
            );
            assert!(part(held) < 0.35, "{damping} {wedge}: {}", part(held));
        }
    }
}
