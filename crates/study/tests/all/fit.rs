//! Identification: parameters that are known are found again, within the intervals stated as often as stated.

use std::path::Path;

use study::case::{Case, CaseError};
use study::fit::least_squares::{SearchSettings, minimize};
use study::fit::{Free, Measured, course, fit, two_sided};
use study::models::{AnyCase, CaseSource};

/// Normally distributed numbers (Box and Muller), of a linear congruential generator.
struct Noise(u64);

impl Noise {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (self.unit(), self.unit());
        (-2.0 * a.ln()).sqrt() * (2.0 * std::f64::consts::PI * b).cos()
    }
}

/// Returns a load that a spring makes, and friction on it, elastic at the reversals: a loop over one cycle as
/// wedges have it, in closed form. The mean of the branches tells the load, their distance the friction.
fn loop_of(friction: f64, stiffness: f64, preload: f64) -> Vec<f64> {
    (0..200)
        .map(|row| {
            let angle = f64::from(row) * std::f64::consts::PI / 100.0;
            let (z, v) = (angle.sin(), angle.cos());
            let load = preload + 200.0 * stiffness * (1.0 - z);
            load * (0.5 + friction * (8.0 * v).tanh())
        })
        .collect()
}

/// 400 loops with noise, three parameters each: of the 1200 intervals 95 % hold, give or take what chance
/// allows (the intervals of one loop are not independent, so four standard deviations of 400).
#[test]
fn convergence_intervals_hold_as_often_as_they_say() {
    let truth = [0.4, 0.3, 0.6];
    let values = |scaled: &[f64]| loop_of(0.2 + 0.4 * scaled[0], 0.5 + scaled[1], 500.0 + 1000.0 * scaled[2]);
    let exact = values(&truth);
    let mut held = [0; 3];
    const LOOPS: u64 = 400;
    let width = two_sided(0.95, 197.0);
    for seed in 0..LOOPS {
        let mut noise = Noise(seed);
        let data: Vec<f64> = exact.iter().map(|value| value + 20.0 * noise.normal()).collect();
        let evaluate = |places: &[Vec<f64>]| places.iter().map(|place| Ok(values(place))).collect();
        let found = minimize(&evaluate, &data, &[0.5; 3], &SearchSettings::default()).unwrap();
        assert!(found.settled);
        let covariance = found.covariance.unwrap();
        for k in 0..3 {
            let half = width * covariance[k][k].sqrt();
            held[k] += u64::from((found.place[k] - truth[k]).abs() <= half);
        }
    }
    let expected = 0.95 * LOOPS as f64;
    let spread = 4.0 * (0.95_f64 * 0.05 * LOOPS as f64).sqrt();
    for held in held {
        assert!((held as f64 - expected).abs() < spread, "{held} of {LOOPS}");
    }
}

/// A straight line: the textbook's intercept, slope and their standard errors.
#[test]
fn analytic_a_straight_line_is_the_textbooks() {
    let x = [1.0, 2.0, 3.0, 4.0, 5.0];
    let y = [2.2, 4.1, 6.0, 8.3, 9.9];
    let evaluate = |places: &[Vec<f64>]| {
        places
            .iter()
            .map(|place| Ok(x.iter().map(|x| 10.0 * place[0] + 10.0 * place[1] * x).collect()))
            .collect()
    };
    let found = minimize(&evaluate, &y, &[0.5, 0.5], &SearchSettings::default()).unwrap();
    // Sums: x 15, y 30.5, xy 111.1, xx 55; slope (5·111.1 - 15·30.5)/(5·55 - 225) = 1.96, intercept 0.22.
    assert!((10.0 * found.place[1] - 1.96).abs() < 1e-6);
    assert!((10.0 * found.place[0] - 0.22).abs() < 1e-6);
    // s² = Σr²/3 = 0.084/3 and variance of the slope s²/10.
    let residuals: f64 = found.sum;
    assert!((residuals - 0.084).abs() < 1e-9, "{residuals}");
    let slope = 100.0 * found.covariance.unwrap()[1][1];
    assert!((slope - 0.084 / 3.0 / 10.0).abs() < 1e-9, "{slope}");
}

#[test]
fn limits_bounds_hold_and_what_is_not_determined_is_said() {
    let evaluate = |places: &[Vec<f64>]| -> Vec<Result<Vec<f64>, String>> {
        places.iter().map(|place| Ok(vec![place[0]; 4])).collect()
    };
    let found = minimize(
        &evaluate,
        &[1.5, 1.6, 1.4, 1.5],
        &[0.5],
        &SearchSettings::default(),
    )
    .unwrap();
    assert_eq!(found.place, [1.0]);
    assert!(found.at_bound[0] && found.settled);
    let found = minimize(
        &evaluate,
        &[0.4, 0.6, 0.5, 0.45],
        &[0.2, 0.5],
        &SearchSettings::default(),
    );
    assert!(found.unwrap().covariance.is_none());
    let failing = |places: &[Vec<f64>]| places.iter().map(|_| Err("no".to_owned())).collect();
    assert_eq!(
        minimize(&failing, &[1.0], &[0.5], &SearchSettings::default()).unwrap_err(),
        "no"
    );
}

/// Cheap: planar, the bolster yawed, half a second at a loose tolerance.
const CASE: &str = "[wedge]\ndamping = \"constant\"\n[side_frame]\ntoe = \"0.2 deg out\"\n[bolster]\n\
                    yaw = \"0.012 rad\"\n\
                    vertical = { shape = \"sine\", amplitude = \"1 in\", frequency = \"20 rad/s\" }\n\
                    [simulation]\nduration = \"0.4 s\"\noutput_interval = \"0.004 s\"\n";

fn case(set: &[String]) -> Result<AnyCase, CaseError> {
    let case = Case::parse("fit.toml", CASE, Path::new(""), set)?;
    Ok(case.into())
}

/// The wedge itself: column friction and coil stiffness from loops with noise of 2 % of the force. Of 24
/// intervals each, those at 95 % and at 50 % hold as often as they say, give or take four standard
/// deviations.
#[test]
fn convergence_a_wedges_parameters_are_found_again() {
    let free = [
        Free::parse("friction.column=0.3..0.5").unwrap(),
        Free::parse("control_coil.stiffness=1500 lbf/in..2500 lbf/in").unwrap(),
    ];
    let truth = [0.37, 1800.0];
    let set: Vec<String> = free
        .iter()
        .zip(truth)
        .map(|(free, value)| free.set(value))
        .collect();
    let times: Vec<f64> = (20..=100).map(|row| 0.004 * f64::from(row)).collect();
    let exact = course(&case(&set).unwrap(), "vertical_wedge_force", &times).unwrap();
    let size = exact.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    const LOOPS: u64 = 24;
    // How far a value found lies from the true one, in half intervals at 95 %.
    let away = |seed: u64| -> [f64; 2] {
        let mut noise = Noise(1000 + seed);
        let measured = Measured {
            values: exact
                .iter()
                .map(|value| value + 0.02 * size * noise.normal())
                .collect(),
            times: times.clone(),
            column: "vertical_wedge_force".to_owned(),
        };
        let found = fit(&case, &measured, &free, 0.95, &|count, one| {
            (0..count).map(one).collect()
        })
        .unwrap();
        assert!(found.settled && found.durbin_watson > 1.2);
        [0, 1].map(|k| {
            let parameter = &found.parameters[k];
            let half = parameter.half_interval.unwrap();
            assert!(half < 0.1 * truth[k], "{parameter:?}");
            (parameter.value - truth[k]).abs() / half
        })
    };
    let away = &away;
    let all: Vec<[f64; 2]> = std::thread::scope(|scope| {
        let halves =
            [0, 1].map(|first| scope.spawn(move || (first..LOOPS).step_by(2).map(away).collect::<Vec<_>>()));
        halves.into_iter().flat_map(|half| half.join().unwrap()).collect()
    });
    let freedom = times.len() as f64 - 2.0;
    for k in [0, 1] {
        for confidence in [0.95, 0.5] {
            let width = two_sided(confidence, freedom) / two_sided(0.95, freedom);
            let held = all.iter().filter(|away| away[k] <= width).count() as f64;
            let expected = confidence * LOOPS as f64;
            let spread = 4.0 * (confidence * (1.0 - confidence) * LOOPS as f64).sqrt();
            assert!(
                (held - expected).abs() < spread,
                "{}: {held} of {LOOPS} at {confidence}",
                free[k].path
            );
        }
    }
}

/// Variably damped, the coil is compressed by the motion itself, so that stiffness and preload do different
/// things to the loop: all three kinds of parameters at once, each within two 95 % intervals (four standard
/// deviations) of the true value.
#[test]
fn convergence_friction_stiffness_and_preload_are_told_apart() {
    let free = [
        Free::parse("friction.column=0.3..0.5").unwrap(),
        Free::parse("control_coil.stiffness=1500 lbf/in..2500 lbf/in").unwrap(),
        Free::parse("control_coil.nominal_length=5.2 in..5.8 in").unwrap(),
    ];
    let truth = [0.43, 1850.0, 5.4];
    let variable = |set: &[String]| {
        let mut all = vec!["wedge.damping=\"variable\"".to_owned()];
        all.extend_from_slice(set);
        case(&all)
    };
    let set: Vec<String> = free
        .iter()
        .zip(truth)
        .map(|(free, value)| free.set(value))
        .collect();
    let times: Vec<f64> = (40..=200).map(|row| 0.002 * f64::from(row)).collect();
    let exact = course(&variable(&set).unwrap(), "vertical_wedge_force", &times).unwrap();
    let size = exact.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    for seed in 0..3 {
        let mut noise = Noise(2000 + seed);
        let measured = Measured {
            values: exact
                .iter()
                .map(|value| value + 0.01 * size * noise.normal())
                .collect(),
            times: times.clone(),
            column: "vertical_wedge_force".to_owned(),
        };
        let found = fit(&variable, &measured, &free, 0.95, &|count, one| {
            (0..count).map(one).collect()
        })
        .unwrap();
        for (parameter, truth) in found.parameters.iter().zip(truth) {
            let half = parameter.half_interval.unwrap();
            assert!(half < 0.1 * truth, "{parameter:?}");
            assert!(
                (parameter.value - truth).abs() < 2.0 * half,
                "{truth}: {parameter:?}"
            );
        }
    }
}

#[test]
fn input_free_parameters() {
    for (text, problem) in [
        ("friction.column", "frees nothing"),
        ("friction.column=0.2", "frees nothing"),
        ("friction.column=0.6..0.6", "nothing does"),
        ("friction.column=a..0.2", "is no bound"),
        ("wedge.angle=30 deg..1 in", "do not measure the same"),
        ("wedge.angle=30 dg..31 deg", "dg"),
    ] {
        let error = Free::parse(text).unwrap_err();
        assert!(error.problem.contains(problem), "{}", error.problem);
        assert!(error.advice.contains("--free"));
    }
    // Either end may come first.
    let down = Free::parse("wedge.angle=35 deg..30 deg").unwrap();
    assert_eq!((down.low, down.high), (30.0, 35.0));
    let measured = Measured {
        times: vec![0.1, 0.2, 0.3],
        values: vec![0.0; 3],
        column: "vertical_wedge_force".to_owned(),
    };
    let one = [Free::parse("friction.colum=0.2..0.3").unwrap()];
    let error = fit(&case, &measured, &one, 0.95, &|_, _| Vec::new()).unwrap_err();
    assert!(error.to_string().contains("no key `colum`"), "{error}");
    let few = [Free::parse("friction.column=0.2..0.3").unwrap()];
    let short = Measured {
        times: vec![0.1],
        values: vec![0.0],
        ..measured
    };
    assert!(fit(&case, &short, &few, 0.95, &|_, _| Vec::new()).is_err());
}

/// A half-truck's friction from a loop of one of its wedges without noise: the true value, for all wedges.
#[test]
fn convergence_a_half_trucks_friction_is_found_again() {
    let source = CaseSource::half_truck(Path::new(""), Path::new("nucars_68_constant_toe_out"));
    let source = source.unwrap().unwrap();
    let case = |set: &[String]| {
        let head = [
            "simulation.duration=1.6 s".to_owned(),
            "history.3.frequency=1 Hz".to_owned(),
        ];
        source.case(&[&head, set].concat())
    };
    let free = [Free::parse("wedges.column_friction=0.3..0.5").unwrap()];
    let truth = 0.37;
    let times: Vec<f64> = (50..=150).map(|row| 0.01 * f64::from(row)).collect();
    let column = "wedge_127_column_friction";
    let exact = course(&case(&[free[0].set(truth)]).unwrap(), column, &times).unwrap();
    let measured = Measured {
        values: exact,
        times,
        column: column.to_owned(),
    };
    let found = fit(&case, &measured, &free, 0.95, &|count, one| {
        (0..count).map(one).collect()
    })
    .unwrap();
    let value = found.parameters[0].value;
    assert!((value - truth).abs() < 1e-4 && found.settled, "{value}");
    assert_eq!(found.failed, None);
}

/// The friction that made the course lies beyond the range: the fit ends at the bound, and says so.
#[test]
fn limits_a_parameter_at_its_bound_is_a_warning() {
    let times: Vec<f64> = (20..=60).map(|row| 0.004 * f64::from(row)).collect();
    let beyond = case(&["friction.column=0.45".to_owned()]).unwrap();
    let measured = Measured {
        values: course(&beyond, "vertical_wedge_force", &times).unwrap(),
        times,
        column: "vertical_wedge_force".to_owned(),
    };
    let warned = |range: &str| {
        let free = [Free::parse(&format!("friction.column={range}")).unwrap()];
        let found = fit(&case, &measured, &free, 0.95, &|count, one| {
            (0..count).map(one).collect()
        });
        found.unwrap().warnings
    };
    let text = "the fitted friction.column ends at its bound, 0.4,";
    let at_bound = warned("0.3..0.4");
    assert!(
        at_bound.iter().any(|warning| warning.contains(text)),
        "{at_bound:?}"
    );
    let inside = warned("0.3..0.6");
    assert!(
        !inside.iter().any(|warning| warning.contains("bound")),
        "{inside:?}"
    );
}
