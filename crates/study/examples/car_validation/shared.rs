//! What pages about cars have in common, here and in other crates: runs in regimes and on ramps of the speed,
//! several at a time.

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::thread;

use quantity::Quantity;
use study::car::hunting::{Boundary, Hunting, HuntingSettings, Point, hunting};
use study::car::regime::Regime;
use study::car::run::CarResult;
use study::car::{CarCase, builtin};
use study::case::Tables;
use study::run::Run;

pub type Failure = Box<dyn std::error::Error + Send + Sync>;

pub const MPH: f64 = 0.447_04;
pub const INCH: f64 = 0.0254;
/// Amplitude of a wheelset from which on a motion is hunting, and from which on it runs from flange to
/// flange, m.
const HUNTS: f64 = 0.05 * INCH;
const FLANGES: f64 = 0.38 * INCH;

/// Returns a car of this lading in a regime, from its equilibrium: nothing is locked in by its friction.
pub fn in_regime(name: &str, lading: &str, speed: f64, overrides: &[&str]) -> Result<CarCase, Failure> {
    let regime = Regime::named(name).ok_or_else(|| format!("there is no regime {name}"))?;
    let mut settings = regime.settings(&Quantity::parse(&format!("{speed} mph"))?)?;
    settings.push("start.kind=equilibrium".to_owned());
    settings.extend(set(overrides));
    let text = format!("model = \"car\"\nlading.kind = \"{lading}\"\n");
    Ok(CarCase::parse("car.toml", &text, Tables::nowhere(), &settings)?)
}

/// Runs one.
pub fn run_in(name: &str, lading: &str, speed: f64, overrides: &[&str]) -> Result<CarResult, Failure> {
    let case = in_regime(name, lading, speed, overrides)?;
    finished(&case, &format!("{name} at {speed} mph"))
}

/// Runs a case to its end; `what` names it in errors.
pub fn finished(case: &CarCase, what: &str) -> Result<CarResult, Failure> {
    let result = Run::new(case)?.finish(|_| ());
    match &result.summary.stopped {
        Some(stopped) => Err(format!("{what} stopped: {}", stopped.reason).into()),
        None => Ok(result),
    }
}

pub fn column<'r>(result: &'r CarResult, name: &str) -> Result<&'r [f64], Failure> {
    result
        .column(name)
        .ok_or_else(|| format!("there is no column {name}").into())
}

/// Returns the mean of a column over its last rows.
pub fn late(result: &CarResult, name: &str, rows: usize) -> Result<f64, Failure> {
    let values = column(result, name)?;
    let own = &values[values.len().saturating_sub(rows)..];
    Ok(own.iter().sum::<f64>() / own.len() as f64)
}

/// Returns a statistic, filtered if it is: an acceleration in g, a load in percent.
pub fn statistic(result: &CarResult, name: &str) -> Result<f64, Failure> {
    let own = result.summary.statistics.get(name);
    let own = own.and_then(|own| own.filtered.as_ref().or(own.raw.as_ref()));
    Ok(own.ok_or_else(|| format!("there is no statistic {name}"))?.value)
}

pub fn set(values: &[&str]) -> Vec<String> {
    values.iter().map(|own| (*own).to_owned()).collect()
}

/// Computes a value for each item, four at a time, in the order of the items.
pub fn each<T: Sync, O: Send>(
    items: &[T],
    of: impl Fn(&T) -> Result<O, Failure> + Sync,
) -> Result<Vec<O>, Failure> {
    let next = Mutex::new(0..items.len());
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                while let Some(number) = next.lock().ok().and_then(|mut own| own.next()) {
                    let found = of(&items[number]);
                    if let Ok(mut done) = done.lock() {
                        done.push((number, found));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().map_err(|_| "a thread panicked")?;
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, found)| found).collect()
}

/// Runs the empty car of the built-in case, or another one by `overrides`, on a falling and a rising ramp of
/// the speed (mph) within a time (s), after a start of all axles by 0.4 in to the left.
pub fn hunt(speeds: [f64; 2], ramp: f64, overrides: &[String]) -> Result<Hunting, Failure> {
    let overrides = [overrides, &set(&["start.axle_shift=0.4 in"])].concat();
    let case = builtin::case_with("car_hunting_empty", &overrides)?;
    let settings = HuntingSettings {
        speeds: speeds.map(|own| own * MPH),
        ramp,
        threshold: HUNTS,
    };
    Ok(hunting(&case, settings, |_| ControlFlow::Continue(()))?)
}

/// Returns cells of a table: falling, the speed down to which wheelsets run from flange to flange, and where
/// hunting dies, mph; rising, where it begins, mph; the largest amplitude of a wheelset on the falling ramp,
/// in.
pub fn cells(found: &Hunting) -> [String; 4] {
    let points = &found.falling.points;
    let flanges = points.iter().rfind(|own| own.amplitude() >= FLANGES);
    let flanges = flanges.map_or("-".to_owned(), |own| format!("{:.0}", own.speed / MPH));
    let rising = found.rising.as_ref();
    let rising = rising.map_or("-".to_owned(), |own| words(own.boundary));
    let largest = points.iter().map(Point::amplitude).fold(0.0, f64::max);
    [
        flanges,
        words(found.falling.boundary),
        rising,
        format!("{:.2}", largest / INCH),
    ]
}

/// Returns the speed at which hunting ends or begins, mph.
fn words(boundary: Boundary) -> String {
    match boundary {
        Boundary::At(speed) => format!("{:.0}", speed / MPH),
        Boundary::Everywhere => "all speeds".to_owned(),
        Boundary::Nowhere => "no speed".to_owned(),
        Boundary::Derails(speed) => format!("derails at {:.0}", speed / MPH),
    }
}
