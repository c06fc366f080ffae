//! Dimensions: the exponents of mass, length, time and angle.

use std::fmt;

/// The dimension of a quantity, as exponents of mass, length, time and angle.
///
/// An angle counts as a dimension of its own here, although the radian is a pure number:
/// `"0.2 deg"` where a length is expected must be an error, and `"2 1/s"` does not say whether
/// radians or revolutions are meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of mass (kg).
    pub mass: i8,
    /// Exponent of length (m).
    pub length: i8,
    /// Exponent of time (s).
    pub time: i8,
    /// Exponent of angle (rad).
    pub angle: i8,
}

impl Dimension {
    /// No dimension at all: a pure number.
    pub const NONE: Dimension = Dimension::new(0, 0, 0, 0);

    /// Returns the dimension with these exponents of mass, length, time and angle.
    pub const fn new(mass: i8, length: i8, time: i8, angle: i8) -> Self {
        Dimension {
            mass,
            length,
            time,
            angle,
        }
    }

    /// This dimension times another one raised to `power`; `None` if an exponent leaves the
    /// range of an `i8`.
    pub fn times(self, other: Dimension, power: i8) -> Option<Self> {
        let add = |a: i8, b: i8| a.checked_add(b.checked_mul(power)?);
        Some(Dimension {
            mass: add(self.mass, other.mass)?,
            length: add(self.length, other.length)?,
            time: add(self.time, other.time)?,
            angle: add(self.angle, other.angle)?,
        })
    }

    /// Returns the same dimension without its angle.
    pub const fn without_angle(self) -> Self {
        Dimension::new(self.mass, self.length, self.time, 0)
    }
}

impl fmt::Display for Dimension {
    /// In SI base units, for example `kg m^2 s^-2`; `1` for a pure number.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.mass, "kg"),
            (self.length, "m"),
            (self.time, "s"),
            (self.angle, "rad"),
        ];
        let mut space = "";
        for (exponent, unit) in parts.into_iter().filter(|(exponent, _)| *exponent != 0) {
            out.write_str(space)?;
            match exponent {
                1 => out.write_str(unit)?,
                n => write!(out, "{unit}^{n}")?,
            }
            space = " ";
        }
        if space.is_empty() {
            out.write_str("1")
        } else {
            Ok(())
        }
    }
}
