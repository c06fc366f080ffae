//! Onset of hunting at held speeds by measures.

use std::ops::ControlFlow;

use quantity::{Kind, Quantity};
use study::car::CarCase;
use study::car::builtin;
use study::car::onset::{
    MEASURES, Measure, OnTrack, Onset, OnsetError, OnsetPoint, OnsetSettings, OnsetSpeed, OnsetTrack, onset,
    onset_with,
};
use study::car::regime::Regime;
use study::case::Tables;
use study::outcome::{Outcome, RunEnd};
use study::run::Run;

const MPH: f64 = 0.447_04;
const FOOT: f64 = 0.3048;

/// The onset lies where a straight line between two neighbors passes the limit, above the last speed that
/// keeps it; a car that derails is above all limits, and halfway to it lies its onset.
#[test]
fn analytic_onset_between_speeds() {
    let of = |points: &[(f64, Option<f64>)]| OnsetSpeed::of(points, 0.5);
    let rising = [(10.0, Some(0.1)), (20.0, Some(0.3)), (30.0, Some(1.1))];
    assert_eq!(of(&rising), Some(OnsetSpeed::From(22.5)));
    // Above it at 20 m/s, and below it again at 30 m/s: it counts from the last one on.
    let twice = [
        (10.0, Some(0.1)),
        (20.0, Some(0.9)),
        (30.0, Some(0.25)),
        (40.0, Some(0.75)),
    ];
    assert_eq!(of(&twice), Some(OnsetSpeed::From(35.0)));
    let derails = [(10.0, Some(0.1)), (20.0, None), (30.0, None)];
    assert_eq!(of(&derails), Some(OnsetSpeed::From(15.0)));
    assert_eq!(
        of(&[(10.0, Some(0.6)), (20.0, Some(0.7))]),
        Some(OnsetSpeed::AllFrom(10.0))
    );
    assert_eq!(
        of(&[(10.0, Some(0.1)), (20.0, Some(0.5))]),
        Some(OnsetSpeed::NoneUpTo(20.0))
    );
    assert_eq!(
        of(&[(10.0, Some(0.9)), (20.0, Some(0.4))]),
        Some(OnsetSpeed::NoneUpTo(20.0))
    );
    assert_eq!(of(&[]), None);
}

/// Every measure has the limit of its source, and a derailed car has no value that could keep one.
#[test]
fn analytic_each_measure_has_its_limit() {
    let point = |speed: f64, share: f64, outcome: Outcome| OnsetPoint {
        speed,
        deviation: share * 0.13 * 9.806_65,
        body_rms: 0.0,
        truck_rms: share * 0.30 * 9.806_65,
        amplitude: share * 0.38 * 0.0254,
        outcome,
        warnings: Vec::new(),
    };
    let mut track = OnTrack {
        track: OnsetTrack::Class4,
        points: vec![
            point(10.0, 0.5, Outcome::Complete),
            point(20.0, 1.5, Outcome::Complete),
        ],
    };
    for measure in MEASURES {
        let Some(OnsetSpeed::From(speed)) = track.onset(measure) else {
            panic!("{measure:?} has no onset");
        };
        assert!((speed - 15.0).abs() < 1e-12, "{measure:?} {speed}");
    }
    let end = RunEnd {
        time: 1.0,
        reason: "a wheel has left its rail".to_owned(),
        distance: None,
    };
    track.points[1] = point(20.0, 0.6, Outcome::Derailed(end));
    assert_eq!(track.onset(Measure::Deviation), Some(OnsetSpeed::From(15.0)));
    assert_eq!(track.points[1].value(Measure::Deviation), None);
}

/// Without hunting nothing is left of the start on perfect track, while irregularities shake the car more the
/// faster it runs; and the deviation is that of the same run, asked for by regime, in two passes.
#[test]
fn cross_code_measures_are_those_of_a_run_in_the_regime() {
    let overrides = [
        "speed.kind=held",
        "speed.value=40 mph",
        "simulation.relative_tolerance=1e-3",
    ];
    let case = builtin::case_with("car_tangent_empty", &overrides.map(str::to_owned)).unwrap();
    let settings = OnsetSettings {
        distance: 150.0 * FOOT,
        settle: 70.0 * FOOT,
        threads: 2,
    };
    let speeds = [30.0 * MPH, 60.0 * MPH];
    let found = onset_with(&case, &speeds, settings, |_| ControlFlow::Continue(())).unwrap();
    assert!(found.complete && found.failed().is_none());
    let [perfect, rough] = &found.tracks;
    for measure in MEASURES {
        let [still, shaken] = [perfect, rough].map(|own| own.points.iter().map(|own| own.raw(measure)));
        for (still, shaken) in still.zip(shaken.clone()) {
            assert!(still < 0.1 * shaken, "{measure:?}: {still} against {shaken}");
        }
        let [slow, fast] = shaken.collect::<Vec<_>>()[..] else {
            panic!("two speeds were run");
        };
        if measure != Measure::Amplitude {
            assert!(fast > slow, "{measure:?}: {slow} to {fast}");
        }
    }

    let regime = Regime::named("fra_class_4").unwrap();
    let mut settings = regime.settings(&Quantity::parse("60 mph").unwrap()).unwrap();
    settings.extend([
        "simulation.duration=1.75 s".to_owned(),
        format!("start.settle={} s", 70.0 * FOOT / speeds[1]),
        "simulation.relative_tolerance=1e-3".to_owned(),
        "start.kind=equilibrium".to_owned(),
    ]);
    let text = "model = \"car\"\nlading.kind = \"empty\"\n";
    let own = CarCase::parse("car.toml", text, Tables::nowhere(), &settings).unwrap();
    let result = Run::new(&own).unwrap().finish(|_| ());
    let times = result.column("time").unwrap();
    let deviations = [1, 2].map(|truck| {
        let name = format!("body_at_truck_{truck}_lateral_acceleration_filtered");
        let rows = times.iter().zip(result.column(&name).unwrap());
        let settle = 70.0 * FOOT / speeds[1];
        let values: Vec<f64> = rows.filter(|(t, _)| **t >= settle).map(|(_, own)| *own).collect();
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares = values.iter().map(|own| (own - mean) * (own - mean));
        (squares.sum::<f64>() / values.len() as f64).sqrt()
    });
    let own = deviations[0].max(deviations[1]);
    let there = rough.points[1].deviation;
    assert!((own / there - 1.0).abs() < 1e-9, "{own} against {there}");
    assert!(
        own * Kind::RideAcceleration.from_si(quantity::System::Us) > 0.01,
        "{own}"
    );
}

fn short(threads: usize) -> OnsetSettings {
    OnsetSettings {
        distance: 6.0,
        settle: 1.0,
        threads,
    }
}

/// A user who stops it gets the runs that came to their ends, marked as incomplete.
#[test]
fn limits_what_is_stopped_is_incomplete() {
    let case = builtin::case_with("car_hunting_roller_empty", &[]).unwrap();
    let found = onset_with(&case, &[10.0, 20.0], short(1), |share| match share > 0.5 {
        true => ControlFlow::Break("stopped".to_owned()),
        false => ControlFlow::Continue(()),
    });
    let found = found.unwrap();
    let counts = found.tracks.each_ref().map(|own| own.points.len());
    assert_eq!((found.complete, counts), (false, [2, 0]));
    assert_eq!(found.tracks[1].onset(Measure::Deviation), None);
    let at_once = onset_with(&case, &[10.0], short(3), |_| {
        ControlFlow::Break("stopped".to_owned())
    });
    assert!(!at_once.unwrap().complete);
}

/// Threads share the runs, not their numbers.
#[test]
fn limits_any_number_of_threads_has_the_same_bits() {
    let case = builtin::case_with("car_hunting_roller_empty", &[]).unwrap();
    let numbers = |found: Onset| -> Vec<[u64; 4]> {
        let points = found.tracks.iter().flat_map(|own| &own.points);
        points
            .map(|own| [own.deviation, own.body_rms, own.truck_rms, own.amplitude].map(f64::to_bits))
            .collect()
    };
    let all = [1, 3].map(|threads| {
        let found = onset_with(
            &case,
            &[15.0, 20.0],
            short(threads),
            |_| ControlFlow::Continue(()),
        );
        numbers(found.unwrap())
    });
    assert_eq!(all[0].len(), 4);
    assert_eq!(all[0], all[1]);
}

/// Linear wheels, and speeds or distances that make no runs, are refused before anything runs.
#[test]
fn input_what_makes_no_runs_is_refused() {
    let go_on = |_| ControlFlow::Break("must not run".to_owned());
    let case = builtin::case_with("car_hunting_empty", &[]).unwrap();
    for speeds in [
        &[][..],
        &[0.0],
        &[-1.0, 2.0],
        &[20.0, 10.0],
        &[10.0, 10.0],
        &[f64::NAN],
    ] {
        let refused = onset(&case, speeds, go_on).unwrap_err();
        assert!(matches!(refused, OnsetError::Speeds { .. }), "{refused}");
        assert!(refused.to_string().contains("rising"), "{refused}");
    }
    let none = OnsetSettings {
        settle: 6.0,
        ..short(1)
    };
    let refused = onset_with(&case, &[10.0], none, go_on).unwrap_err();
    assert!(matches!(refused, OnsetError::Distances { .. }), "{refused}");
    let linear = ["wheels.geometry=linear", "track.support.kind=rigid"].map(str::to_owned);
    let case = builtin::case_with("car_hunting_empty", &linear).unwrap();
    let refused = onset(&case, &[10.0], go_on).unwrap_err();
    assert!(matches!(refused, OnsetError::LinearWheels), "{refused}");
}
