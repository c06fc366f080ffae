//! Files of the onset of hunting, of made measures.

use std::ops::RangeInclusive;

use quantity::{Kind, System as Units};
use report::onset_files::{figure, sentences, write_numbers, write_table};
use study::car::onset::{OnTrack, Onset, OnsetPoint, TRACKS};
use study::outcome::Outcome;

/// A car whose deviation passes 0.13 g at 55 mph on track of class 4 alone.
fn made() -> Onset {
    let mph = 1.0 / Kind::TravelSpeed.from_si(Units::Us);
    let gravity = 1.0 / Kind::RideAcceleration.from_si(Units::Us);
    let point = |number: i32, deviation: f64| OnsetPoint {
        speed: (40.0 + 10.0 * f64::from(number)) * mph,
        deviation: deviation * gravity,
        body_rms: 0.2 * gravity,
        truck_rms: 0.4 * gravity,
        amplitude: 0.001,
        outcome: Outcome::Complete,
        warnings: vec!["a warning".to_owned()],
    };
    let points = |all: RangeInclusive<i32>, rate: f64| -> Vec<OnsetPoint> {
        all.map(|own| point(own, 0.10 + rate * f64::from(own - 1)))
            .collect()
    };
    let [perfect, class_4] = TRACKS;
    Onset {
        speeds: [50.0, 60.0].map(|own| own * mph).into(),
        tracks: [
            OnTrack {
                track: perfect,
                points: points(1..=2, 0.0),
            },
            OnTrack {
                track: class_4,
                points: points(1..=2, 0.06),
            },
        ],
        complete: true,
    }
}

#[test]
fn analytic_sentences_name_speeds_and_limits() {
    let found = sentences(&made(), Units::Us);
    assert_eq!(
        found[0],
        "Hunting by the body's standard deviation over 2,000 ft, limit 0.13 g: it stays below it up to \
         60.0 mph on perfect track, and passes it at 55.0 mph on class 4 track."
    );
    assert!(found[1].contains("above it from 50.0 mph, the lowest speed run, on perfect track"));
    assert!(found[2].contains("limit 0.38 in"), "{}", found[2]);
    let mut none = made();
    none.tracks[1].points.clear();
    assert!(sentences(&none, Units::Us)[0].ends_with("and is unknown on class 4 track."));
}

#[test]
fn input_files_have_tracks_measures_and_limits() {
    let found = made();
    let mut table = Vec::new();
    write_table(&found, Units::Us, &mut table).unwrap();
    let table = String::from_utf8(table).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines[0],
        "track,speed_mph,body_deviation_g,truck_rms_g,axle_amplitude_in,body_rms_g,outcome"
    );
    assert!(
        lines.len() == 5 && lines[4].starts_with("fra_class_4,60"),
        "{table}"
    );
    let mut numbers = Vec::new();
    write_numbers("car", &found, Units::Us, &mut numbers).unwrap();
    let numbers: serde_json::Value = serde_json::from_slice(&numbers).unwrap();
    let deviation = &numbers["measures"][0];
    assert_eq!(
        (&deviation["unit"], &deviation["limit"]),
        (&"g".into(), &0.13.into())
    );
    assert_eq!(deviation["onsets"][0]["onset"], "none_up_to");
    assert_eq!(deviation["onsets"][1]["speed"], 55.0);
    assert_eq!(numbers["warnings"][0], "perfect track at 50.0 mph: a warning");
    let figure = figure("car", &found, Units::Us);
    let limits = figure.panels.iter().map(|own| own.curves[2].points[0].1);
    let wanted = [0.13, 0.30, 0.38];
    assert!(
        limits
            .zip(wanted)
            .all(|(own, wanted)| (own - wanted).abs() < 1e-12)
    );
}
