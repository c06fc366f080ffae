//! Quantities that systems have in common.

use mechanics::body::COORDINATES;
use mechanics::system::{System, scales};
use quantity::Kind;

use super::ports::coordinates;
use crate::element::Entry;
use crate::unit::Unit;

/// Returns the unit of a kind.
#[expect(clippy::unnecessary_wraps, reason = "as entries have it")]
pub(crate) fn unit(kind: Kind) -> Option<Unit> {
    Some(Unit::Of(kind))
}

/// Returns the kinds of a coordinate and of its rate.
pub(crate) fn kinds(coordinate: usize) -> (Kind, Kind) {
    if coordinate < 3 {
        (Kind::Length, Kind::Speed)
    } else {
        (Kind::Angle, Kind::AngularSpeed)
    }
}

/// Returns the input that loads a coordinate of a body, such as `force_on_body_x` or `moment_on_body_roll`.
pub(crate) fn load(prefix: &str, on: &str, coordinate: usize, text: &str) -> Entry {
    let axis = ["x", "y", "z"][coordinate % 3];
    let (load, kind) = if coordinate < 3 {
        ("force", Kind::Force)
    } else {
        ("moment", Kind::Moment)
    };
    Entry::real(
        format!("{prefix}{load}_on_{on}_{}", COORDINATES[coordinate]),
        unit(kind),
        Some(0.0),
        format!("{load} on {text}, {axis} axis"),
    )
}

/// Returns the positions of all free bodies, then their rates, each with the name of its body and coordinate.
pub(crate) fn motions(system: &System, name: impl Fn(usize) -> String) -> Vec<Entry> {
    let mut states = Vec::new();
    for rate in [false, true] {
        for (body, k) in coordinates(system) {
            let name = format!("{}_{}", name(body), COORDINATES[k]);
            let (kind, nominal, name) = match (rate, k < 3) {
                (false, true) => (kinds(k).0, scales::DISPLACEMENT, name),
                (false, false) => (kinds(k).0, scales::ANGLE, name),
                (true, true) => (kinds(k).1, scales::VELOCITY, format!("{name}_rate")),
                (true, false) => (kinds(k).1, scales::ANGULAR_VELOCITY, format!("{name}_rate")),
            };
            let text = if rate {
                "rate of the position of the same name".to_owned()
            } else {
                "displacement of the center of gravity, or angle, from the drawn position, in the truck's \
                 axes"
                    .to_owned()
            };
            states.push(with_nominal(Entry::real(name, unit(kind), None, text), nominal));
        }
    }
    states
}

/// Returns the deflection of a bristle.
pub(crate) fn deflection(name: String, text: &str) -> Entry {
    with_nominal(
        Entry::real(name, unit(Kind::Length), None, text),
        scales::DEFLECTION,
    )
}

/// Returns work or a loss that is accumulated.
pub(crate) fn accumulated(name: &str, text: &str) -> Entry {
    with_nominal(Entry::real(name, unit(Kind::Energy), None, text), scales::ENERGY)
}

fn with_nominal(mut entry: Entry, nominal: f64) -> Entry {
    entry.nominal = Some(nominal);
    entry
}

/// Returns the three columns of the energy ledger.
pub(crate) fn ledger(residual: &str) -> Vec<Entry> {
    [
        (
            "stored_energy_change",
            "kinetic, elastic and gravity energy since the start",
        ),
        ("ledger_residual", residual),
    ]
    .map(|(name, text)| Entry::real(name, unit(Kind::Energy), None, text))
    .into_iter()
    .chain([crate::wedge::entries::relative_residual()])
    .collect()
}
