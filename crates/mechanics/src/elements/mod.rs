//! Force elements of suspensions, one law a file. Each implements [`Element`](crate::element::Element).

mod bushing;
mod draft_gear;
mod radial_stop;
mod raised;
mod shear_spring;
mod stop;
mod strut;
mod table_spring;

pub use bushing::Bushing;
pub use draft_gear::DraftGear;
pub use radial_stop::RadialStop;
pub use raised::Raised;
pub use shear_spring::{ShearSpring, Solid};
pub use stop::Stop;
pub use strut::Strut;
pub use table_spring::TableSpring;

use numerics::scalar::Real;

/// Returns the load (N) of a unilateral spring and damper at a penetration (m) and its rate (m/s), and the
/// power that is lost (W): `max(0, k p + c ṗ)` while `p > 0`, else 0.
///
/// The damper is cut off where it would pull; what the spring gives back then is lost.
#[inline(always)]
fn unilateral<S: Real>([stiffness, damping]: [f64; 2], penetration: S, rate: S) -> [S; 2] {
    if penetration.value() <= 0.0 {
        return [S::zero(); 2];
    }
    let elastic = penetration * stiffness;
    let damped = elastic + rate * damping;
    let load = if damped.value() > 0.0 { damped } else { S::zero() };
    [load, (load - elastic) * rate]
}

/// Returns the energy (J) of a unilateral spring at a penetration (m).
fn unilateral_energy(stiffness: f64, penetration: f64) -> f64 {
    let pressed = penetration.max(0.0);
    0.5 * stiffness * pressed * pressed
}
