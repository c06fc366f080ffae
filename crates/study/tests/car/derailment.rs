//! Columns and statistics of derailment in runs.

use study::car::CarCase;
use study::car::figures::CarFigures;
use study::car::run::CarResult;
use study::car::worst::{WORST, Worst};
use study::case::Tables;
use study::models::StudyCase;
use study::run::Run;

fn case(lines: &str) -> CarCase {
    CarCase::parse(
        "case.toml",
        &format!("model = \"car\"\n{lines}"),
        Tables::nowhere(),
        &[],
    )
    .unwrap()
}

fn column<'r>(result: &'r CarResult, name: &str) -> &'r [f64] {
    result.column(name).unwrap_or_else(|| panic!("{name}"))
}

/// A car whose rails jump to the side climbs: columns hold together row by row, and the statistics say what
/// the columns do.
#[test]
fn analytic_columns_of_a_car_that_climbs() {
    let case = case(
        "start.settle = \"0 s\"\nlading.kind = \"empty\"\nspeed.value = \"60 mph\"\nwheels.friction = 0.9\n\
         [friction.right]\ngauge_face = 0.8\n\
         [[track.segments]]\ntangent = \"600 ft\"\n[[track.irregularities]]\nshape = \"jog\"\n\
         rails = \"both\"\ndirection = \"lateral\"\noffset = \"5 in\"\nlength = \"3 ft\"\nstart = \"50 ft\"\n\
         [simulation]\nduration = \"0.4 s\"\noutput_interval = \"1 ms\"\n",
    );
    let result = Run::new(&case).unwrap().finish(|_| ());
    assert!(result.summary.derailed.is_some());
    let limits = car::ClimbLimits::of(&case.parameters).unwrap();
    let rows = result.rows();
    let mut climbed = 0.0_f64;
    let mut lifted = 0;
    for axle in 1..=4 {
        let sides = ["left", "right"];
        let of = |side: usize, what: &str| column(&result, &format!("axle_{axle}_{}_{what}", sides[side]));
        let own = limits.at(axle - 1, 0.0);
        // 75 degrees, and the friction of the flange of each side.
        let nadal = [0.9_f64, 0.8].map(|friction| (75_f64.to_radians() - friction.atan()).tan());
        assert!((own.nadal[0] - nadal[0]).abs() < 1e-9 && (own.nadal[1] - nadal[1]).abs() < 1e-9);
        for row in 0..rows {
            let [l, r] = [0, 1].map(|side| of(side, "l_over_v")[row]);
            let net = of(0, "lateral")[row] - of(1, "lateral")[row];
            let force = column(&result, &format!("axle_{axle}_lateral_force"))[row];
            assert!((net - force).abs() < 1e-6);
            let shares = [l / nadal[0], r / nadal[1]];
            for (side, share) in shares.into_iter().enumerate() {
                assert!((of(side, "nadal_share")[row] - share).abs() < 1e-9);
                let [angle, lift] = ["contact_angle", "lift"].map(|what| of(side, what)[row]);
                assert!(lift >= 0.0 && angle < 1.4, "{angle} {lift}");
                if of(side, "vertical")[row].abs() > 1.0 {
                    assert!(lift == 0.0 && angle > 0.0, "{angle} {lift}");
                }
                lifted += usize::from(lift > 1e-3);
                climbed = climbed.max(share);
            }
            let other = 0.9;
            let limit = if shares[1] > shares[0] { nadal[1] } else { nadal[0] } + other;
            let share = column(&result, &format!("axle_{axle}_weinstock_share"))[row];
            assert!(
                (share - (l.abs() + r.abs()) / limit).abs() < 1e-9,
                "{row}: {share}"
            );
        }
    }
    assert!(climbed > 1.0 && lifted > 0, "{climbed} {lifted}");
    let statistics = &result.summary.statistics;
    let of = |name: &str| Worst::named(name).unwrap().of(statistics).unwrap();
    // The peak is too short for the filter of wheel forces to let it exceed the limit.
    let climbs = statistics
        .iter()
        .filter(|(name, _)| name.ends_with("_climb_distance"));
    let raw = climbs.map(|(_, own)| own.raw.as_ref().unwrap());
    let longest = raw.max_by(|a, b| a.value.total_cmp(&b.value)).unwrap();
    assert!(longest.value > 0.0 && longest.unit == "ft", "{longest:?}");
    let lift = of("wheel_lift");
    let columns = (1..=4).flat_map(|axle| ["left", "right"].map(|side| format!("axle_{axle}_{side}_lift")));
    let most = columns
        .flat_map(|name| column(&result, &name).to_vec())
        .fold(0.0, f64::max);
    assert!((lift.value.value * 0.0254 - most).abs() < 1e-12);
}

/// Measures are those of the summary, all of which a run in a curve has, and figures of the car are there
/// always; linear wheels have no flanges and no columns of them.
#[test]
fn analytic_a_run_in_a_curve_has_all_measures() {
    let case = case(
        "start.settle = \"1 s\"\nspeed.value = \"40 mph\"\noutput.section_length = \"10 m\"\n\
         [[track.segments]]\ntangent = \"100 ft\"\n[[track.segments]]\nspiral = \"40 ft\"\n\
         [[track.segments]]\ncurve = \"60 ft\"\ndegree = \"5 deg\"\nsuperelevation = \"2 in\"\n\
         [[track.segments]]\nspiral = \"40 ft\"\n[[track.segments]]\ntangent = \"200 ft\"\n\
         [simulation]\nduration = \"3.5 s\"\n",
    );
    let result = Run::new(&case).unwrap().finish(|_| ());
    for own in &WORST {
        let found = own.of(&result.summary.statistics);
        assert!(
            found.is_some_and(|found| found.value.value.is_finite()),
            "{}",
            own.name
        );
    }
    let judged = case.judge().unwrap();
    let definitions = case.definitions();
    let figures = CarFigures::of(&case.parameters);
    for (name, value) in CarFigures::NAMES.into_iter().zip(figures.values()) {
        assert_eq!(definitions.get(&judged.measures, name), Some(value), "{name}");
    }
    assert!((figures.least_flange_angle.to_degrees() - 75.0).abs() < 1e-6);
    assert!(figures.least_static_axle_load > 1.9 * figures.least_static_wheel_load);
    let weight = case.parameters.weight();
    assert!((figures.greatest_static_axle_load - 0.25 * weight).abs() < 0.01 * weight);
    let linear = "wheels.geometry = \"linear\"\ntrack.support.kind = \"rigid\"\n\
                  simulation.duration = \"0.1 s\"\n[[track.segments]]\ntangent = \"200 ft\"\n";
    let linear = self::case(linear);
    let result = Run::new(&linear).unwrap().finish(|_| ());
    assert!(result.column("axle_1_left_nadal_share").is_none());
    assert!(result.column("axle_1_lateral_force").is_some());
    assert!(CarFigures::of(&linear.parameters).least_flange_angle.is_nan());
}
