//! Speeds of an assessment as they are typed: several, or from one to another.

use quantity::{Kind, Quantity};

use crate::case::CaseError;
use crate::case::problem::Problem;

const HELP: &str =
    "write --speeds \"10 mph..70 mph\" --steps 6, or several speeds: --speeds \"30 mph\" \"50 mph\"";
/// Speeds are below, m/s.
const FASTEST: f64 = 1e3;

/// Reads speeds: each text is one, or `FROM..TO`, which gives `steps` speeds, the ends among them. They come
/// in rising order, each once.
///
/// # Errors
/// A text is no speed, or one beyond what runs.
pub fn parse(texts: &[String], steps: u32) -> Result<Vec<Quantity>, CaseError> {
    let mut found = Vec::new();
    for text in texts {
        let Some((from, to)) = text.split_once("..") else {
            found.push(speed(text)?);
            continue;
        };
        let (from, to) = (speed(from)?, speed(to)?);
        let unit = from.unit_text();
        let last = to.to_si() / from.to_si() * from.value();
        for step in 0..steps {
            let share = f64::from(step) / f64::from(steps.max(2) - 1);
            let value = from.value() + (last - from.value()) * share;
            // Six digits are more than a speed has.
            let value: f64 = format!("{value:.6e}").parse().unwrap_or(value);
            found.push(speed(&format!("{value} {unit}"))?);
        }
    }
    found.sort_by(|a, b| a.to_si().total_cmp(&b.to_si()));
    found.dedup_by(|a, b| a.to_si() == b.to_si());
    Ok(found)
}

fn speed(text: &str) -> Result<Quantity, CaseError> {
    let text = text.trim();
    let refused = |message: String| CaseError::from(Problem::new(message).help(HELP));
    let quantity = Quantity::parse_as(text, Kind::TravelSpeed).map_err(|error| {
        let typed = input::shortened(text);
        refused(format!("the speed \"{typed}\": {error}"))
    })?;
    match quantity.to_si() > 0.0 && quantity.to_si() < FASTEST {
        true => Ok(quantity),
        false => Err(refused(format!(
            "the speed {quantity} is not positive and below 1000 m/s"
        ))),
    }
}
