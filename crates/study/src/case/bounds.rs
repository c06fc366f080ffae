//! Upper bounds of the values of a case: far beyond any wedge, truck or track, and far below what overflows.
//!
//! Within them a case may still be nonsense, which its run tells; beyond them it is a slip of the pen or of a
//! unit.

use quantity::{Kind, System};

/// Largest coefficient of friction. Dry metals have 0.1 to 1, rubber up to 4.
pub const FRICTION: f64 = 10.0;

/// Returns the largest size of a quantity of this kind, SI, either sign.
#[must_use]
pub fn largest(kind: Kind) -> f64 {
    match kind {
        // Eleven days of simulated time.
        Kind::Time => 1e6,
        Kind::Length => 1e3,
        // The longest track.
        Kind::Distance => 1e6,
        // 160 turns.
        Kind::Angle => 1e3,
        Kind::Speed | Kind::AngularSpeed | Kind::Acceleration => 1e4,
        Kind::TravelSpeed | Kind::RideAcceleration => 1e4,
        // 160 kHz, far above every vibration of contacts.
        Kind::Frequency => 1e6,
        // A million tons.
        Kind::Force | Kind::Moment => 1e10,
        Kind::Energy | Kind::Power => 1e12,
        // A cube of steel with edges of a kilometer.
        Kind::Stiffness => 1e15,
        Kind::Damping | Kind::RotationalDamping => 1e12,
        Kind::Mass => 1e9,
        Kind::Inertia => 1e12,
        // A million megapascals.
        Kind::Pressure => 1e12,
        Kind::Dimensionless | Kind::Count => f64::MAX,
    }
}

/// Returns the bound in words: `at most 1000 m`.
#[must_use]
pub fn words(kind: Kind) -> String {
    format!("at most {:e} {}", largest(kind), kind.label(System::Si))
}
