//! Findings of implausible values: what, where, when, by how much, and the advice.

use std::fmt;

use quantity::{Kind, Number, System as Units};

use super::{
    LARGEST_COMPRESSION_SHARE, LARGEST_SMALL_ANGLE, LARGEST_TILT, LIFTED_SHARE, PENETRATION_SHARE,
    RELEASED_SHARE, ROWS_A_PERIOD,
};
use crate::body::COORDINATES;
use crate::system::System;

/// The place of a finding in a system; numbers are those of [`System`]'s lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// A body.
    Body(usize),
    /// A contact face, and a point of it where one is meant.
    Face {
        /// Its number.
        face: usize,
        /// The point's number in the face.
        point: Option<usize>,
    },
    /// A coil.
    Coil(usize),
    /// A force element of another kind.
    Element(usize),
    /// A connection.
    Connection(usize),
    /// An energy term, of [`System::energy_terms`]: what loses the energy may be an element that is no other
    /// place, or all connections.
    EnergyTerm(usize),
}

impl Location {
    /// Returns the place in words, such as "point 2 of the column of the wedge".
    #[must_use]
    pub fn describe(self, system: &System) -> String {
        let body = |number: usize| system.bodies()[number].name.replace('_', " ");
        match self {
            Self::Body(number) => format!("the {}", body(number)),
            Self::Face { face, point } => {
                let mounted = &system.faces()[face];
                let name = mounted.element.name.replace('_', " ");
                let point = point.map_or(String::new(), |point| format!("point {} of ", point + 1));
                format!("{point}the {name} face of the {}", body(mounted.body))
            }
            Self::Coil(number) => format!("coil {} of the {}", number + 1, body(system.coils()[number].body)),
            Self::Element(number) => format!("the element {}", system.element_name(number)),
            Self::Connection(number) => format!("the connection {}", system.connections()[number].name),
            Self::EnergyTerm(number) => format!("`{}`", system.energy_terms()[number].name()),
        }
    }
}

/// The kinds of implausible values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FindingKind {
    /// All points of a face are farther from its surface than the face is long. The value is the least gap,
    /// m.
    Separation,
    /// A face has slid along its surface by its own extent. The value is the way, m.
    SlidOff,
    /// A point of a face penetrates its surface too deep. The value is the depth, m.
    Penetration,
    /// A face is tilted against its surface. The value is the angle since the start, rad.
    Tilt,
    /// A body with linearized kinematics turns too far about an axis (3 to 5: roll, pitch, yaw). The value
    /// is the angle, rad.
    LargeAngle(usize),
    /// A body or element moved by more than the system measures. The value is the displacement, m.
    Displacement,
    /// A coil is compressed beyond any solid height. The value is the compression, m.
    Solid,
    /// A coil is compressed beyond the last point of its table. The value is the compression, m.
    BeyondTable,
    /// A coil is longer than its free length. The value is by how much, m.
    Lifted {
        /// True if the coil pulls then; false if it is off its seat.
        pulls: bool,
    },
    /// A face overlaps its surface at the start more than later. The value is the energy that is released, J.
    StoredAtStart,
    /// The coefficient of friction is out of proportion. The value is the coefficient.
    Friction,
    /// A loss is below zero: an element creates energy. The value is the energy, J.
    EnergyCreated,
    /// The normal force of a face scatters from output time to output time. The value is the output
    /// interval, s.
    CoarseOutput {
        /// Estimated frequency of the vibration, Hz.
        frequency: f64,
        /// The scatter, a pure number ([`super::LARGEST_SCATTER`]).
        scatter: f64,
    },
}

impl FindingKind {
    /// Returns whether results are meaningless from then on; else they are doubtful.
    #[must_use]
    pub fn is_nonsense(self) -> bool {
        match self {
            Self::Separation
            | Self::SlidOff
            | Self::Penetration
            | Self::Tilt
            | Self::LargeAngle(_)
            | Self::Displacement
            | Self::Solid => true,
            Self::BeyondTable
            | Self::Lifted { .. }
            | Self::StoredAtStart
            | Self::Friction
            | Self::EnergyCreated
            | Self::CoarseOutput { .. } => false,
        }
    }

    /// Returns the kind of quantity of value and limit.
    #[must_use]
    pub fn quantity(self) -> Kind {
        match self {
            Self::Tilt | Self::LargeAngle(_) => Kind::Angle,
            Self::StoredAtStart | Self::EnergyCreated => Kind::Energy,
            Self::Friction => Kind::Count,
            Self::CoarseOutput { .. } => Kind::Time,
            _ => Kind::Length,
        }
    }

    /// Returns the advice, in terms that hold for any model.
    #[must_use]
    pub fn advice(self) -> &'static str {
        match self {
            Self::Separation | Self::SlidOff | Self::Displacement => {
                "do not use what follows; look for a mass, a stiffness, a friction or a \
                 motion out of proportion"
            }
            Self::Penetration => {
                "raise the contact stiffness, or lower the load or the motion that presses the face in"
            }
            Self::Tilt => {
                "do not use what follows: edges and sides touch that the model does not have; look for a \
                 motion, a friction or a position of the center of gravity out of proportion"
            }
            Self::LargeAngle(_) => "lower the motion, or model the body with finite rotations",
            Self::Solid => {
                "lower the load or the motion, or give the coil a table that stiffens at its solid height"
            }
            Self::BeyondTable => "extend the table, or lower the load or the motion",
            Self::Lifted { pulls: true } => {
                "do not let the coil pull, and lower the motion that stretches it"
            }
            Self::Lifted { pulls: false } => {
                "raise the preload, or lower the motion that lifts the body off the coil"
            }
            Self::StoredAtStart => "start from equilibrium or with faces that just touch",
            Self::Friction => "check the value for a slip of the pen",
            Self::EnergyCreated => {
                "the ledger closes with it, but no machine does that: do not use losses, damping and \
                 stability of this run; look for a friction, a stiffness or a motion out of proportion at \
                 this element, or take another law for it"
            }
            Self::CoarseOutput { .. } => {
                "shorten the output interval, or use averages, not single values, extremes or spectra"
            }
        }
    }
}

/// Something implausible in a run. Values are SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlausibilityFinding {
    /// Its kind.
    pub kind: FindingKind,
    /// The place.
    pub location: Location,
    /// The time of the worst value, s; `None` if it does not depend on time.
    pub time: Option<f64>,
    /// The first output time at which the limit was exceeded, s.
    pub since: Option<f64>,
    /// The worst value.
    pub value: f64,
    /// The limit that it exceeds.
    pub limit: f64,
}

impl PlausibilityFinding {
    /// Returns the finding as one sentence in these units, without advice; `place` is its location in words.
    #[must_use]
    pub fn words(&self, place: &str, units: Units) -> String {
        let measure = |value: f64| with_unit(value, self.kind.quantity(), units);
        let (value, limit) = (measure(self.value), measure(self.limit));
        let percent = |share: f64| Number(rounded(100.0 * share));
        let (what, quantity, reason) = match self.kind {
            FindingKind::Separation => (
                "has left its surface",
                format!("the gap is {value}"),
                "the smallest extent of the face".to_owned(),
            ),
            FindingKind::SlidOff => (
                "has slid off its surface",
                format!("it has moved along it by {value}"),
                "the extent of the face in that direction".to_owned(),
            ),
            FindingKind::Penetration => (
                "penetrates its surface too deep",
                format!("the depth is {value}"),
                format!(
                    "{} % of the smallest extent of the face",
                    percent(PENETRATION_SHARE)
                ),
            ),
            FindingKind::Tilt => (
                "is tilted too far for a flat face with corners",
                format!("the tilt since the start is {value}"),
                format!("a fixed bound, {} degrees", rounded(LARGEST_TILT.to_degrees())),
            ),
            FindingKind::LargeAngle(coordinate) => (
                "rotates too far for small angles",
                format!(
                    "its {} is {value}, where linearized levers err by {} %",
                    COORDINATES.get(coordinate).unwrap_or(&"rotation"),
                    percent(0.5 * self.value * self.value)
                ),
                format!(
                    "where they err by {} %",
                    percent(0.5 * LARGEST_SMALL_ANGLE * LARGEST_SMALL_ANGLE)
                ),
            ),
            FindingKind::Displacement => (
                "has left its surroundings",
                format!("the displacement is {value}"),
                "the size of the system".to_owned(),
            ),
            FindingKind::Solid => (
                "is compressed beyond any solid height",
                format!("the compression is {value}"),
                format!("{} % of the free length", percent(LARGEST_COMPRESSION_SHARE)),
            ),
            FindingKind::BeyondTable => (
                "is compressed beyond its table, which is extrapolated",
                format!("the compression is {value}"),
                "the last point of the table".to_owned(),
            ),
            FindingKind::Lifted { pulls } => (
                if pulls { "pulls" } else { "is lifted off its seat" },
                format!("it is longer than its free length by {value}"),
                format!("{} % of the free length", percent(LIFTED_SHARE)),
            ),
            FindingKind::StoredAtStart => (
                "overlaps its surface at the start",
                format!("contact energy of {value} is released"),
                format!(
                    "{} % of the largest of work, losses, stored energy at the start and its change",
                    percent(RELEASED_SHARE)
                ),
            ),
            FindingKind::Friction => {
                return format!(
                    "{place} has a coefficient of friction of {}, above {}",
                    Number(self.value),
                    Number(self.limit)
                );
            }
            FindingKind::EnergyCreated => (
                "is a loss below zero: energy comes from nowhere",
                format!("it has put in {value}"),
                "the largest residual of the energy ledger, and a millionth of its turnover".to_owned(),
            ),
            FindingKind::CoarseOutput { frequency, scatter } => {
                return format!(
                    "the normal force at {place} scatters by {} % of its mean (or of the body's weight) \
                     from output time to output time: the contact vibrates at about {} Hz, which the output \
                     interval of {value} does not resolve (at most {limit}, a {}th of the period)",
                    percent(scatter),
                    rounded(frequency),
                    ROWS_A_PERIOD
                );
            }
        };
        let when = self
            .time
            .map_or(String::new(), |time| format!(" at {} s", Number(tidy(time))));
        let since = match self.since {
            Some(since) if Some(since) != self.time => {
                format!(", exceeded from {} s on", Number(tidy(since)))
            }
            _ => String::new(),
        };
        format!("{place} {what}: {quantity}{when}; the limit is {limit} ({reason}){since}")
    }
}

/// A finding in SI units, without names.
impl fmt::Display for PlausibilityFinding {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = match self.location {
            Location::Body(number) => format!("body {number}"),
            Location::Face { face, point: None } => format!("face {face}"),
            Location::Face {
                face,
                point: Some(point),
            } => format!("point {point} of face {face}"),
            Location::Coil(number) => format!("coil {number}"),
            Location::Element(number) => format!("element {number}"),
            Location::Connection(number) => format!("connection {number}"),
            Location::EnergyTerm(number) => format!("energy term {number}"),
        };
        write!(out, "{}; {}", self.words(&place, Units::Si), self.kind.advice())
    }
}

fn with_unit(value: f64, kind: Kind, units: Units) -> String {
    let number = Number(rounded(value * kind.from_si(units)));
    format!("{number} {}", kind.unit(units)).trim_end().to_owned()
}

/// Returns a number rounded to four significant digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Returns an output time without the rounding of a product.
fn tidy(time: f64) -> f64 {
    (time * 1e9).round() / 1e9
}
