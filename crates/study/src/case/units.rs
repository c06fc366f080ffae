//! Quantities in the units of the other system.

use quantity::{Kind, Quantity, System};

/// Names of US customary units.
const CUSTOMARY: [&str; 12] = [
    "in", "ft", "yd", "mi", "lb", "slug", "mph", "lbf", "kip", "psi", "ksi", "hp",
];
/// Names of units of both systems.
const COMMON: [&str; 11] = [
    "s", "ms", "min", "h", "rad", "mrad", "deg", "°", "rev", "Hz", "rpm",
];

/// Returns whether every unit in an expression belongs to a system: those of time and angle belong to both.
fn belongs(expression: &str, system: System) -> bool {
    expression
        .split(|letter: char| !letter.is_alphabetic() && letter != '°')
        .filter(|name| !name.is_empty() && !COMMON.contains(name))
        .all(|name| CUSTOMARY.contains(&name) == (system == System::Us))
}

/// Returns the same value in a unit of a system: itself if its unit belongs to that system or to both, else
/// in the unit that `kind` is usually written in there, with the fewest digits that give the same SI value.
/// If no number of that unit gives it, the nearest one.
pub(super) fn in_system(quantity: &Quantity, kind: Kind, system: System) -> Quantity {
    if belongs(quantity.unit_text(), system) {
        return quantity.clone();
    }
    let unit = kind.unit(system);
    let Ok(one) = Quantity::new(1.0, unit).map(|one| one.to_si()) else {
        return quantity.clone();
    };
    let si = quantity.to_si();
    let exact = si / one;
    let rounded = (0..17).filter_map(|decimals| format!("{exact:.decimals$e}").parse::<f64>().ok());
    let near = [exact, exact.next_up(), exact.next_down()];
    let same = |value: &f64| (value * one).to_bits() == si.to_bits();
    let value = rounded.chain(near).find(same).unwrap_or(exact);
    Quantity::new(value, unit).unwrap_or_else(|_| quantity.clone())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn other_units_keep_the_value() {
        for (typed, kind, system, wanted) in [
            ("9 in", Kind::Length, System::Si, "0.2286 m"),
            ("9 in", Kind::Length, System::Us, "9 in"),
            ("25.4 mm", Kind::Length, System::Us, "1 in"),
            ("32 deg", Kind::Angle, System::Si, "32 deg"),
            ("50 lbf", Kind::Force, System::Si, "222.41108076302498 N"),
            ("-0.5 ft", Kind::Length, System::Si, "-0.1524 m"),
            ("0 lbf/in", Kind::Stiffness, System::Si, "0 N/m"),
        ] {
            let quantity = Quantity::parse_as(typed, kind).unwrap();
            let other = in_system(&quantity, kind, system);
            assert_eq!(other.text(), wanted);
            assert_eq!(other.to_si(), quantity.to_si(), "{typed}");
        }
    }

    #[test]
    fn every_kind_comes_back_to_its_si_value_or_the_next_one() {
        for kind in Kind::ALL {
            for value in [1.0, 0.3, 3000.0, 1.234_567_890_123, -7e-5] {
                for system in [System::Us, System::Si] {
                    let Ok(typed) = Quantity::new(value, kind.unit(system)) else {
                        continue;
                    };
                    let there = if system == System::Us {
                        System::Si
                    } else {
                        System::Us
                    };
                    let (other, si) = (in_system(&typed, kind, there), typed.to_si());
                    let apart = (other.to_si() - si).abs();
                    assert!(apart <= 2.3e-16 * si.abs(), "{typed} is not {other}");
                }
            }
        }
    }
}
