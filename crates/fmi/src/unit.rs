//! Units of variables: SI, with a US customary display unit where people use one.

use quantity::{Dimension, Kind, System};

/// The unit of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// That of a kind of quantity.
    Of(Kind),
    /// An angular acceleration.
    AngularAcceleration,
}

/// Another unit that a variable is shown in: `shown = factor · value`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// Its name.
    pub name: &'static str,
    /// The factor.
    pub factor: f64,
}

impl Unit {
    /// Every unit that a variable may have, in the order of the descriptions.
    pub const ALL: [Unit; 17] = [
        Unit::Of(Kind::Time),
        Unit::Of(Kind::Length),
        Unit::Of(Kind::Angle),
        Unit::Of(Kind::Speed),
        Unit::Of(Kind::AngularSpeed),
        Unit::Of(Kind::Acceleration),
        Unit::AngularAcceleration,
        Unit::Of(Kind::Force),
        Unit::Of(Kind::Moment),
        Unit::Of(Kind::Energy),
        Unit::Of(Kind::Power),
        Unit::Of(Kind::Stiffness),
        Unit::Of(Kind::Damping),
        Unit::Of(Kind::RotationalDamping),
        Unit::Of(Kind::Mass),
        Unit::Of(Kind::Inertia),
        Unit::Of(Kind::Dimensionless),
    ];

    /// Returns its name; a pure number has none.
    #[must_use]
    pub fn name(self) -> Option<&'static str> {
        let Unit::Of(kind) = self else {
            return Some("rad/s2");
        };
        Some(match kind {
            Kind::Time => "s",
            Kind::Length | Kind::Distance => "m",
            Kind::Angle => "rad",
            Kind::Speed | Kind::TravelSpeed => "m/s",
            Kind::AngularSpeed | Kind::Frequency => "rad/s",
            Kind::Acceleration | Kind::RideAcceleration => "m/s2",
            Kind::Force => "N",
            Kind::Moment => "N.m",
            Kind::Energy => "J",
            Kind::Power => "W",
            Kind::Stiffness => "N/m",
            Kind::Damping => "N.s/m",
            Kind::RotationalDamping => "N.m.s/rad",
            Kind::Mass => "kg",
            Kind::Inertia => "kg.m2",
            Kind::Pressure => "Pa",
            Kind::Dimensionless | Kind::Count => return None,
        })
    }

    /// Returns its exponents of base units.
    #[must_use]
    pub fn dimension(self) -> Dimension {
        match self {
            Unit::Of(kind) => kind.dimension(),
            Unit::AngularAcceleration => Dimension::new(0, 0, -2, 1),
        }
    }

    /// Returns its exponents of base units that are not zero, as descriptions name them.
    #[must_use]
    pub fn base(self) -> Vec<(&'static str, String)> {
        let dimension = self.dimension();
        let exponents = [
            ("kg", dimension.mass),
            ("m", dimension.length),
            ("s", dimension.time),
            ("rad", dimension.angle),
        ];
        exponents
            .into_iter()
            .filter(|(_, exponent)| *exponent != 0)
            .map(|(name, exponent)| (name, exponent.to_string()))
            .collect()
    }

    /// Returns the unit in which values are displayed, if that is another one.
    #[must_use]
    pub fn display(self) -> Option<Display> {
        let Unit::Of(kind) = self else { return None };
        let name = match kind {
            Kind::Length => "in",
            Kind::Angle => {
                return Some(Display {
                    name: "deg",
                    factor: 180.0 / std::f64::consts::PI,
                });
            }
            Kind::Speed => "in/s",
            Kind::Acceleration => "in/s2",
            Kind::Force => "lbf",
            Kind::Moment | Kind::Energy => "lbf.in",
            Kind::Power => "lbf.in/s",
            Kind::Stiffness => "lbf/in",
            Kind::Damping => "lbf.s/in",
            Kind::Mass => "lb",
            Kind::Inertia => "lb.in2",
            _ => return None,
        };
        Some(Display {
            name,
            factor: kind.from_si(System::Us),
        })
    }

    /// Returns the unit of the rate of a state in this unit.
    #[must_use]
    pub fn rate(self) -> Self {
        match self {
            Unit::Of(Kind::Length) => Unit::Of(Kind::Speed),
            Unit::Of(Kind::Angle) => Unit::Of(Kind::AngularSpeed),
            Unit::Of(Kind::Speed) => Unit::Of(Kind::Acceleration),
            Unit::Of(Kind::AngularSpeed) => Unit::AngularAcceleration,
            Unit::Of(Kind::Energy) => Unit::Of(Kind::Power),
            other => other,
        }
    }
}
