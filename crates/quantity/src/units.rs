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

const fn unit(name: &'static str, factor: f64, dimension: Dimension) -> NamedUnit {
    NamedUnit {
        name,
        factor,
        dimension,
    }
}

/// Every unit with a name. `lb` alone is a mass, `lbf` the force; a frequency in `Hz` or `rpm`
/// counts cycles, so that one of them is 2π rad.
pub(crate) static UNITS: &[NamedUnit] = &[
    unit("in", INCH, LENGTH),
    unit("ft", FOOT, LENGTH),
    unit("yd", 0.9144, LENGTH),
    unit("mi", 1609.344, LENGTH),
    unit("um", 1e-6, LENGTH),
    unit("mm", 1e-3, LENGTH),
    unit("cm", 1e-2, LENGTH),
    unit("m", 1.0, LENGTH),
    unit("km", 1e3, LENGTH),
    unit("s", 1.0, TIME),
    unit("ms", 1e-3, TIME),
    unit("min", 60.0, TIME),
    unit("h", 3600.0, TIME),
    unit("lb", POUND, MASS),
    // lbf s²/ft
    unit("slug", 14.593_902_937_206_364, MASS),
    unit("kg", 1.0, MASS),
    unit("t", 1e3, MASS),
    unit("rad", 1.0, ANGLE),
    unit("mrad", 1e-3, ANGLE),
    unit("deg", PI / 180.0, ANGLE),
    unit("°", PI / 180.0, ANGLE),
    unit("rev", 2.0 * PI, ANGLE),
    unit("Hz", 2.0 * PI, RATE),
    unit("rpm", 2.0 * PI / 60.0, RATE),
    unit("mph", MILE_PER_HOUR, SPEED),
    unit("g0", STANDARD_GRAVITY, ACCELERATION),
    unit("lbf", POUND_FORCE, FORCE),
    unit("kip", 4_448.221_615_260_5, FORCE),
    unit("N", 1.0, FORCE),
    unit("kN", 1e3, FORCE),
    unit("MN", 1e6, FORCE),
    unit("psi", 6_894.757_293_168_362, PRESSURE),
    unit("ksi", 6_894_757.293_168_362, PRESSURE),
    unit("Pa", 1.0, PRESSURE),
    unit("kPa", 1e3, PRESSURE),
    unit("MPa", 1e6, PRESSURE),
    unit("J", 1.0, ENERGY),
    unit("kJ", 1e3, ENERGY),
    unit("W", 1.0, POWER),
    unit("kW", 1e3, POWER),
    // 550 ft lbf/s
    unit("hp", 745.699_871_582_270_2, POWER),
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
