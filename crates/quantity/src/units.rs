//! The table of units. Every factor is exact by definition, or the exact rational number
//! rounded once to the nearest `f64`.

use crate::{Dimension, System};
use std::f64::consts::PI;

/// The international inch, m (exact).
pub const INCH: f64 = 0.0254;
/// The international foot, m (exact).
pub(crate) const FOOT: f64 = 0.304_8;
/// The international mile per hour, m/s (exact).
pub(crate) const MILE_PER_HOUR: f64 = 0.447_04;
/// The avoirdupois pound, kg (exact).
pub const POUND: f64 = 0.453_592_37;
/// Standard gravity, m/s² (exact).
pub const STANDARD_GRAVITY: f64 = 9.806_65;
/// The pound-force, N (exact: pound times standard gravity).
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// A unit with a name of its own.
pub(crate) struct NamedUnit {
    pub name: &'static str,
    /// One of these, in SI.
    pub factor: f64,
    pub dimension: Dimension,
    /// The system of units that it belongs to; none for those of both.
    pub system: Option<System>,
}

const LENGTH: Dimension = Dimension::new(0, 1, 0, 0);
const TIME: Dimension = Dimension::new(0, 0, 1, 0);
const MASS: Dimension = Dimension::new(1, 0, 0, 0);
const ANGLE: Dimension = Dimension::new(0, 0, 0, 1);
const RATE: Dimension = Dimension::new(0, 0, -1, 1);
const SPEED: Dimension = Dimension::new(0, 1, -1, 0);
const ACCELERATION: Dimension = Dimension::new(0, 1, -2, 0);
const FORCE: Dimension = Dimension::new(1, 1, -2, 0);
const PRESSURE: Dimension = Dimension::new(1, -1, -2, 0);
const ENERGY: Dimension = Dimension::new(1, 2, -2, 0);
const POWER: Dimension = Dimension::new(1, 2, -3, 0);

const fn unit(name: &'static str, factor: f64, dimension: Dimension, system: Option<System>) -> NamedUnit {
    NamedUnit {
        name,
        factor,
        dimension,
        system,
    }
}

const fn us(name: &'static str, factor: f64, dimension: Dimension) -> NamedUnit {
    unit(name, factor, dimension, Some(System::Us))
}

const fn si(name: &'static str, factor: f64, dimension: Dimension) -> NamedUnit {
    unit(name, factor, dimension, Some(System::Si))
}

const fn both(name: &'static str, factor: f64, dimension: Dimension) -> NamedUnit {
    unit(name, factor, dimension, None)
}

/// Every unit with a name. `lb` alone is a mass, `lbf` the force; a frequency in `Hz` or `rpm`
/// counts cycles, so that one of them is 2π rad.
pub(crate) static UNITS: &[NamedUnit] = &[
    us("in", INCH, LENGTH),
    us("ft", FOOT, LENGTH),
    us("yd", 0.9144, LENGTH),
    us("mi", 1609.344, LENGTH),
    si("um", 1e-6, LENGTH),
    si("mm", 1e-3, LENGTH),
    si("cm", 1e-2, LENGTH),
    si("m", 1.0, LENGTH),
    si("km", 1e3, LENGTH),
    both("s", 1.0, TIME),
    both("ms", 1e-3, TIME),
    both("min", 60.0, TIME),
    both("h", 3600.0, TIME),
    us("lb", POUND, MASS),
    // lbf s²/ft
    us("slug", 14.593_902_937_206_364, MASS),
    si("kg", 1.0, MASS),
    si("t", 1e3, MASS),
    both("rad", 1.0, ANGLE),
    both("mrad", 1e-3, ANGLE),
    both("deg", PI / 180.0, ANGLE),
    both("°", PI / 180.0, ANGLE),
    both("rev", 2.0 * PI, ANGLE),
    both("Hz", 2.0 * PI, RATE),
    both("rpm", 2.0 * PI / 60.0, RATE),
    us("mph", MILE_PER_HOUR, SPEED),
    both("g0", STANDARD_GRAVITY, ACCELERATION),
    us("lbf", POUND_FORCE, FORCE),
    us("kip", 4_448.221_615_260_5, FORCE),
    si("N", 1.0, FORCE),
    si("kN", 1e3, FORCE),
    si("MN", 1e6, FORCE),
    us("psi", 6_894.757_293_168_362, PRESSURE),
    us("ksi", 6_894_757.293_168_362, PRESSURE),
    si("Pa", 1.0, PRESSURE),
    si("kPa", 1e3, PRESSURE),
    si("MPa", 1e6, PRESSURE),
    si("J", 1.0, ENERGY),
    si("kJ", 1e3, ENERGY),
    si("W", 1.0, POWER),
    si("kW", 1e3, POWER),
    // 550 ft lbf/s
    us("hp", 745.699_871_582_270_2, POWER),
];

/// Names people write, and what they are called here.
pub(crate) static SYNONYMS: &[(&str, &str)] = &[
    ("inch", "in"),
    ("inches", "in"),
    ("\"", "in"),
    ("feet", "ft"),
    ("foot", "ft"),
    ("meter", "m"),
    ("metre", "m"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("hr", "h"),
    ("lbm", "lb"),
    ("lbs", "lbf (force) or lb (mass)"),
    ("pound", "lbf (force) or lb (mass)"),
    ("pounds", "lbf (force) or lb (mass)"),
    ("ton", "lbf (2000 lbf) or lb (2000 lb)"),
    ("tons", "lbf (2000 lbf) or lb (2000 lb)"),
    ("kips", "kip"),
    ("g", "g0 (standard gravity) or kg (mass)"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("cps", "Hz"),
    ("Nm", "N m"),
    ("kNm", "kN m"),
    ("pli", "lbf/in"),
];

/// Returns the unit of this name.
pub(crate) fn find(name: &str) -> Option<&'static NamedUnit> {
    UNITS.iter().find(|unit| unit.name == name)
}

/// Returns the system that a named unit belongs to; none if it belongs to both, such as seconds and degrees.
pub(crate) fn system_of(name: &str) -> Option<System> {
    match name {
        "in" | "ft" | "yd" | "mi" | "lb" | "slug" | "mph" | "lbf" | "kip" | "psi" | "ksi" | "hp" => {
            Some(System::Us)
        }
        "s" | "ms" | "min" | "h" | "rad" | "mrad" | "deg" | "°" | "rev" | "Hz" | "rpm" | "g0" => None,
        _ => find(name).map(|_| System::Si),
    }
}
