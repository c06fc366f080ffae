//! What pages about cars have in common, here and in other crates: runs in regimes, several at a time.

use std::sync::Mutex;
use std::thread;

use quantity::Quantity;
use study::car::CarCase;
use study::car::hunting::Boundary;
use study::car::regime::Regime;
use study::car::run::CarResult;
use study::case::Tables;
use study::run::Run;

pub type Failure = Box<dyn std::error::Error + Send + Sync>;

pub const MPH: f64 = 0.447_04;

/// Returns a car of this lading in a regime.
pub fn in_regime(name: &str, lading: &str, speed: f64, overrides: &[&str]) -> Result<CarCase, Failure> {
    let regime = Regime::named(name).ok_or_else(|| format!("there is no regime {name}"))?;
    let mut settings = regime.settings(&Quantity::parse(&format!("{speed} mph"))?)?;
    settings.extend(set(overrides));
    let text = format!("model = \"car\"\nlading.kind = \"{lading}\"\n");
    Ok(CarCase::parse("car.toml", &text, Tables::nowhere(), &settings)?)
}

/// Runs one.
pub fn run_in(name: &str, lading: &str, speed: f64, overrides: &[&str]) -> Result<CarResult, Failure> {
    let case = in_regime(name, lading, speed, overrides)?;
    let result = Run::new(&case)?.finish(|_| ());
    match &result.summary.stopped {
        Some(stopped) => Err(format!("{name} at {speed} mph stopped: {}", stopped.reason).into()),
        None => Ok(result),
    }
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

/// Returns the speed at which hunting ends or begins, mph.
pub fn words(boundary: Boundary) -> String {
    match boundary {
        Boundary::At(speed) => format!("{:.0}", speed / MPH),
        Boundary::Everywhere => "all speeds".to_owned(),
        Boundary::Nowhere => "no speed".to_owned(),
        Boundary::Derails(speed) => format!("derails at {:.0}", speed / MPH),
    }
}
