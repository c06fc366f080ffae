//! Critical speeds over the amplitude by equivalent linearization, beside ramps of the speed.

use std::ops::ControlFlow;

use study::car::builtin;
use study::car::stability::stability;

use crate::shared::{Failure, INCH, MPH, each};

/// Returns the section.
pub(crate) fn critical_speeds() -> Result<String, Failure> {
    let mut out = "## Critical speed over amplitude\n\n\
         The empty car on roller side bearings, by equivalent linearization (`wedgelab stability`): the \
         speed above which a motion \
         grows whose wheelset with the largest motion has this lateral\namplitude; 0.39 in is where \
         flanges bear. Wedges have the \
         normal forces that the start locks in.\n\n\
         | tread | start | 0.10 in, mph | 0.20 in, mph | 0.39 in, mph | its frequency, Hz \
         |\n|---|---|---|---|---|---|\n"
        .to_owned();
    let rows = [
        ("aar_1b", "equilibrium"),
        ("aar_1b", "shaken"),
        ("aar_1b_1:10", "equilibrium"),
        ("aar_1b_1:10", "shaken"),
    ];
    let lines = each(&rows, |(tread, start)| {
        let set = [format!("wheels.profile={tread}"), format!("start.kind={start}")];
        let case = builtin::case_with("car_hunting_roller_empty", &set)?;
        let speeds = [30.0, 55.0, 80.0].map(|own| own * MPH);
        let found = stability(&case, &speeds, |_| ControlFlow::Continue(()))?;
        let at = |amplitude: f64| {
            let apart = |own: f64| (own / INCH - amplitude).abs();
            found
                .curve
                .iter()
                .min_by(|a, b| apart(a.amplitude).total_cmp(&apart(b.amplitude)))
        };
        let speed = |amplitude: f64| match at(amplitude) {
            Some(own) => match (&own.critical, own.unsolved) {
                (Some(own), _) => format!("{:.0}", own.speed / MPH),
                (None, false) => "above 120".to_owned(),
                (None, true) => "not found".to_owned(),
            },
            None => "-".to_owned(),
        };
        let frequency = at(0.39)
            .and_then(|own| own.critical.as_ref())
            .map_or("-".to_owned(), |own| format!("{:.2}", own.frequency));
        let name = match *tread {
            "aar_1b" => "1:20",
            other => other.trim_start_matches("aar_1b_"),
        };
        Ok(format!(
            "| {name} | {start} | {} | {} | {} | {frequency} |\n",
            speed(0.10),
            speed(0.20),
            speed(0.39)
        ))
    })?;
    out.extend(lines);
    out += "\nThe ramps above run from flange to flange with 1:20 down to 68 mph, with 1:10 down to 49 \
            mph, and come to rest at 61 and 38 mph. With 1:20\nthe curve from the equilibrium does not \
            reach these motions, that from the shaken start ends there: within a hundredth of an inch \
            beyond 0.39 in the\nflanges bear, and harmonic linearization makes steep cones of them that let \
            the critical speed fall by 40 %, while a flange slides.\n";
    Ok(out)
}
