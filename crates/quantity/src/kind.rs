//! Kinds of quantities, and their names and units in each system of units.

use crate::Dimension;
use crate::units::{FOOT, INCH, MILE_PER_HOUR, POUND, POUND_FORCE, STANDARD_GRAVITY};
use serde::{Deserialize, Serialize};

/// The system of units results are written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum System {
    /// US customary: inch, pound-force, second, radian.
    #[default]
    Us,
    /// SI: metre, newton, second, radian.
    Si,
}

impl System {
    /// Returns the name in case files: `us` or `si`.
    pub const fn name(self) -> &'static str {
        match self {
            System::Us => "us",
            System::Si => "si",
        }
    }
}

/// The kind of quantity that a number stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A time.
    Time,
    /// A length.
    Length,
    /// A distance along a track.
    Distance,
    /// An angle.
    Angle,
    /// A speed.
    Speed,
    /// The speed of a car.
    TravelSpeed,
    /// An angular speed.
    AngularSpeed,
    /// A frequency; inside always an angular one, in rad/s.
    Frequency,
    /// An acceleration.
    Acceleration,
    /// An acceleration of people and ladings, given in parts of gravity's.
    RideAcceleration,
    /// A force.
    Force,
    /// A moment.
    Moment,
    /// An energy.
    Energy,
    /// A power.
    Power,
    /// A stiffness, force per length.
    Stiffness,
    /// A viscous damping, force per speed.
    Damping,
    /// A viscous damping against rotation, moment per angular speed.
    RotationalDamping,
    /// A mass.
    Mass,
    /// A moment of inertia.
    Inertia,
    /// A pressure.
    Pressure,
    /// A pure number.
    Dimensionless,
    /// A counted number, or the number of a mode.
    Count,
}

/// Everything there is to know of a kind.
struct Facts {
    dimension: Dimension,
    name: &'static str,
    /// The unit an example is written with, per system.
    unit: [&'static str; 2],
    suffix: [&'static str; 2],
    label: [&'static str; 2],
    us_from_si: f64,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Kind; 22] = [
        Kind::Time,
        Kind::Length,
        Kind::Angle,
        Kind::Speed,
        Kind::AngularSpeed,
        Kind::Frequency,
        Kind::Acceleration,
        Kind::Force,
        Kind::Moment,
        Kind::Energy,
        Kind::Power,
        Kind::Stiffness,
        Kind::Damping,
        Kind::RotationalDamping,
        Kind::Mass,
        Kind::Inertia,
        Kind::Pressure,
        Kind::Dimensionless,
        Kind::Count,
        Kind::Distance,
        Kind::TravelSpeed,
        Kind::RideAcceleration,
    ];

    /// Returns the quantity that a unit of this dimension measures, in words with an article: `a length`.
    pub(crate) fn describe(dimension: Dimension) -> String {
        match dimension {
            d if d == Kind::Moment.dimension() => "a moment or an energy".into(),
            d if d == Dimension::new(0, 0, -1, 0) => "a rate without an angle".into(),
            d => match Kind::ALL.into_iter().find(|kind| kind.dimension() == d) {
                Some(kind) => kind.name().into(),
                None => format!("a quantity in {d}"),
            },
        }
    }

    /// Returns its dimension.
    pub fn dimension(self) -> Dimension {
        self.facts().dimension
    }

    /// Returns whether a quantity of this dimension can stand for it. Rotational damping may be written
    /// per radian or not: `lbf in s`, `lbf in s/rad`.
    pub fn accepts(self, dimension: Dimension) -> bool {
        let own = self.dimension();
        dimension == own
            || (self == Kind::RotationalDamping && dimension.angle == -1 && dimension.without_angle() == own)
    }

    /// Returns its name in words, with an article: `a force`.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns a unit it is usually written in, as text a [`crate::Quantity`] reads: `lbf`; empty for
    /// pure numbers.
    pub fn unit(self, system: System) -> &'static str {
        self.facts().unit[system as usize]
    }

    /// Returns the ending of a column's name: `lbf_in`, `N_m`; empty for pure numbers.
    pub fn suffix(self, system: System) -> &'static str {
        self.facts().suffix[system as usize]
    }

    /// Returns the unit as an axis shows it: `lbf·in/s`, `W`; empty for pure numbers.
    pub fn label(self, system: System) -> &'static str {
        self.facts().label[system as usize]
    }

    /// Returns the factor that makes a value of this system from an SI value.
    pub fn from_si(self, system: System) -> f64 {
        match system {
            System::Si => 1.0,
            System::Us => self.facts().us_from_si,
        }
    }

    fn facts(self) -> Facts {
        let facts = |exponents: [i8; 4], name, unit, suffix, label, us_from_si| Facts {
            dimension: Dimension::new(exponents[0], exponents[1], exponents[2], exponents[3]),
            name,
            unit,
            suffix,
            label,
            us_from_si,
        };
        match self {
            Kind::Time => facts([0, 0, 1, 0], "a time", ["s"; 2], ["s"; 2], ["s"; 2], 1.0),
            Kind::Length => {
                let names = ["in", "m"];
                facts([0, 1, 0, 0], "a length", names, names, names, 1.0 / INCH)
            }
            Kind::Distance => {
                let names = ["ft", "m"];
                facts([0, 1, 0, 0], "a distance", names, names, names, 1.0 / FOOT)
            }
            Kind::Angle => {
                let unit = ["deg", "rad"];
                facts([0, 0, 0, 1], "an angle", unit, ["rad"; 2], ["rad"; 2], 1.0)
            }
            Kind::Speed => {
                let names = ["in/s", "m/s"];
                let suffix = ["in_per_s", "m_per_s"];
                facts([0, 1, -1, 0], "a speed", names, suffix, names, 1.0 / INCH)
            }
            Kind::TravelSpeed => {
                let (names, suffix) = (["mph", "m/s"], ["mph", "m_per_s"]);
                facts(
                    [0, 1, -1, 0],
                    "a speed",
                    names,
                    suffix,
                    names,
                    1.0 / MILE_PER_HOUR,
                )
            }
            Kind::AngularSpeed | Kind::Frequency => {
                let name = if self == Kind::Frequency {
                    "a frequency"
                } else {
                    "an angular speed"
                };
                facts(
                    [0, 0, -1, 1],
                    name,
                    ["rad/s"; 2],
                    ["rad_per_s"; 2],
                    ["rad/s"; 2],
                    1.0,
                )
            }
            Kind::Acceleration => {
                let suffix = ["in_per_s2", "m_per_s2"];
                let unit = ["in/s^2", "m/s^2"];
                facts(
                    [0, 1, -2, 0],
                    "an acceleration",
                    unit,
                    suffix,
                    ["in/s²", "m/s²"],
                    1.0 / INCH,
                )
            }
            Kind::RideAcceleration => facts(
                [0, 1, -2, 0],
                "an acceleration",
                ["g0", "m/s^2"],
                ["g", "m_per_s2"],
                ["g", "m/s²"],
                1.0 / STANDARD_GRAVITY,
            ),
            Kind::Force => {
                let names = ["lbf", "N"];
                facts([1, 1, -2, 0], "a force", names, names, names, 1.0 / POUND_FORCE)
            }
            Kind::Moment => {
                let suffix = ["lbf_in", "N_m"];
                let factor = 1.0 / (POUND_FORCE * INCH);
                let label = ["lbf·in", "N·m"];
                facts(
                    [1, 2, -2, 0],
                    "a moment",
                    ["lbf in", "N m"],
                    suffix,
                    label,
                    factor,
                )
            }
            Kind::Energy => {
                let suffix = ["lbf_in", "J"];
                let factor = 1.0 / (POUND_FORCE * INCH);
                facts(
                    [1, 2, -2, 0],
                    "an energy",
                    ["lbf in", "J"],
                    suffix,
                    ["lbf·in", "J"],
                    factor,
                )
            }
            Kind::Power => {
                let suffix = ["lbf_in_per_s", "W"];
                let factor = 1.0 / (POUND_FORCE * INCH);
                let label = ["lbf·in/s", "W"];
                facts([1, 2, -3, 0], "a power", ["lbf in/s", "W"], suffix, label, factor)
            }
            Kind::Stiffness => {
                let names = ["lbf/in", "N/m"];
                let suffix = ["lbf_per_in", "N_per_m"];
                facts(
                    [1, 0, -2, 0],
                    "a stiffness",
                    names,
                    suffix,
                    names,
                    INCH / POUND_FORCE,
                )
            }
            Kind::Damping => {
                let suffix = ["lbf_s_per_in", "N_s_per_m"];
                let label = ["lbf·s/in", "N·s/m"];
                let unit = ["lbf s/in", "N s/m"];
                facts(
                    [1, 0, -1, 0],
                    "a damping",
                    unit,
                    suffix,
                    label,
                    INCH / POUND_FORCE,
                )
            }
            Kind::RotationalDamping => {
                let suffix = ["lbf_s_in", "N_s_m"];
                let label = ["lbf·s·in", "N·s·m"];
                let factor = 1.0 / (POUND_FORCE * INCH);
                let unit = ["lbf s in", "N s m"];
                facts([1, 2, -1, 0], "a rotational damping", unit, suffix, label, factor)
            }
            Kind::Mass => {
                let names = ["lb", "kg"];
                facts([1, 0, 0, 0], "a mass", names, names, names, 1.0 / POUND)
            }
            Kind::Inertia => {
                let suffix = ["lb_in2", "kg_m2"];
                let label = ["lb·in²", "kg·m²"];
                let factor = 1.0 / (POUND * INCH * INCH);
                let unit = ["lb in^2", "kg m^2"];
                facts([1, 2, 0, 0], "a moment of inertia", unit, suffix, label, factor)
            }
            Kind::Pressure => {
                let names = ["psi", "Pa"];
                let factor = INCH * INCH / POUND_FORCE;
                facts([1, -1, -2, 0], "a pressure", names, names, names, factor)
            }
            Kind::Dimensionless => facts([0; 4], "a pure number", [""; 2], [""; 2], [""; 2], 1.0),
            Kind::Count => facts([0; 4], "a count", [""; 2], [""; 2], [""; 2], 1.0),
        }
    }
}
