//! Regimes of freight cars: their files, their tracks, what comes out beside the field.
#![allow(clippy::unwrap_used)]

mod assessments;
mod files;
mod limits;
mod orders;
mod rise;
mod tracks;

use study::car::CarCase;
use study::car::regime::Regime;

/// Returns the built-in car of this lading in a regime at a speed.
fn case(regime: &str, lading: &str, speed: &str, overrides: &[&str]) -> CarCase {
    let regime = Regime::named(regime).unwrap();
    let speed = quantity::Quantity::parse(speed).unwrap();
    let mut settings = regime.settings(&speed).unwrap();
    settings.extend(overrides.iter().map(|own| (*own).to_owned()));
    let text = format!("model = \"car\"\nlading.kind = \"{lading}\"\n");
    match CarCase::parse("car.toml", &text, study::case::Tables::nowhere(), &settings) {
        Ok(case) => case,
        Err(error) => panic!("{} at {speed}: {:?}", regime.name, error.problems()),
    }
}
