//! Onset of hunting of the empty car by measures, on perfect track and on track of FRA class 4, with new and
//! worn treads. A second argument has speeds (mph): `car_validation 2 40,50,60`.

use std::fmt::Write;
use std::ops::ControlFlow;

use car::Wheels;
use study::car::CarCase;
use study::car::builtin;
use study::car::onset::{MEASURES, Measure, OnTrack, OnsetSpeed, onset};
use wheelrail::conicity::RollingRadiusDifference;

use crate::INCH;
use crate::shared::{Failure, MPH};

const GRAVITY: f64 = 9.806_65;
/// Returns the empty car on roller side bearings with a profile.
fn car(profile: &str) -> Result<CarCase, Failure> {
    let overrides = [
        "truck.side_bearing.kind=roller".to_owned(),
        format!("wheels.profile={profile}"),
        "lading.kind=empty".to_owned(),
    ];
    Ok(builtin::case_with("car_hunting_empty", &overrides)?)
}

/// Returns the difference of the rolling radii of its wheelsets and their equivalent conicity at an amplitude
/// of 3 mm.
pub fn rolling(case: &CarCase) -> Result<(RollingRadiusDifference, f64), Failure> {
    let Wheels::OnRails(wheels) = &case.parameters.wheels else {
        return Err("its wheels have no profiles".into());
    };
    let table = RollingRadiusDifference::of_positions(&wheels.geometry[0].sweep(11e-3, 220, true))?;
    let found = table.equivalent_conicity(3e-3, 18.0 * INCH, wheels.tape_distance)?;
    Ok((table, found.by_wavelength))
}

/// Returns a speed of onset in a table, mph.
fn cell(own: &OnTrack, measure: Measure) -> String {
    match own.onset(measure) {
        None => "-".to_owned(),
        Some(OnsetSpeed::From(speed)) => format!("{:.0}", speed / MPH),
        Some(OnsetSpeed::AllFrom(speed)) => format!("{:.0} or less", speed / MPH),
        Some(OnsetSpeed::NoneUpTo(speed)) => format!("above {:.0}", speed / MPH),
    }
}

/// The section.
pub fn of_treads() -> Result<String, Failure> {
    let mut out = format!(
        "## Onset of hunting by measures\n\n\
         The empty car on roller side bearings, held at speeds on straight track over 2,620 ft: on perfect \
         track after a start of all axles 0.4 in\nto the left, and on track of FRA class 4 by the spectra \
         and seeds of the regime `fra_class_4` (one sample; freight trains may run at 60 mph\nthere). \
         Largest over both trucks or all axles: standard deviation of the body's lateral acceleration over \
         2,000 ft (limit {:.2} g, AAR M-1001,\nchapter XI, remembered), rms about the mean over 2 s of the \
         lateral acceleration of a truck's axles (0.30 g, 49 CFR 213.333, remembered), \
         amplitude\nof an axle between the rails, median of windows of 1.5 s (0.38 in, a guess: the \
         flanges have 0.41 in). Conicity: equivalent, at 3 mm.\n\n\
         | tread | conicity | track | speed, mph | deviation, g | truck's rms, g | amplitude, in \
         |\n|---|---|---|---|---|---|---|\n",
        Measure::Deviation.limit() / GRAVITY
    );
    let treads: [(&str, &str, &[f64]); 3] = [
        ("1:20", "aar_1b", &[55.0, 70.0]),
        ("1:10", "aar_1b_1:10", &[45.0, 60.0]),
        ("hollow 2 mm", "hollow_2mm", &[45.0]),
    ];
    let mut onsets = String::new();
    for (name, profile, speeds) in treads {
        let speeds = match std::env::args().nth(2) {
            Some(text) => text.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?,
            None => speeds.to_vec(),
        };
        let case = car(profile)?;
        let (_, conicity) = rolling(&case)?;
        let speeds: Vec<f64> = speeds.iter().map(|own| own * MPH).collect();
        let found = onset(&case, &speeds, |_| ControlFlow::Continue(()))?;
        if let Some((track, speed, reason)) = found.failed() {
            return Err(format!("{name}, {track:?} at {speed} m/s: {reason}").into());
        }
        for own in &found.tracks {
            for point in &own.points {
                let _ = writeln!(
                    out,
                    "| {name} | {conicity:.3} | {} | {:.0} | {:.3} | {:.3} | {:.2}{} |",
                    own.track.words(),
                    point.speed / MPH,
                    point.deviation / GRAVITY,
                    point.truck_rms / GRAVITY,
                    point.amplitude / INCH,
                    if point.value(Measure::Deviation).is_none() {
                        " (derails)"
                    } else {
                        ""
                    }
                );
            }
            let cells = MEASURES.map(|measure| cell(own, measure));
            let _ = writeln!(
                onsets,
                "| {name} | {} | {} |",
                own.track.words(),
                cells.join(" | ")
            );
        }
    }
    out += "\nOnset: the speed from which on the measure is above its limit, mph, between the speeds tried; \
            the ramps of the same cars are in the first\ntable of this page.\n\n| tread | track | by the \
            body's deviation | by the truck's rms | by the amplitude |\n|---|---|---|---|---|\n";
    out += &onsets;
    out += "\nOn track of class 4 the body's deviation passes its limit at lower speeds than on perfect \
            track, and axles run from flange to flange at all speeds\nof the table, also where a start dies \
            away on perfect track: there the amplitude tells no hunting.\n";
    Ok(out)
}
