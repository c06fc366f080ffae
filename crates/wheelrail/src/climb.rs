//! Lateral over vertical force of a wheel at which its flange begins to climb its rail.
//!
//! **One wheel** (M. J. Nadal, Annales des Mines, 1896). A flange bears on the rail under the angle δ and
//! slides down it, so that friction μ holds it up as much as it can. With the normal force N and friction μN
//! up the face, `L = N (sin δ - μ cos δ)` and `V = N (cos δ + μ sin δ)`:
//!
//! `(L/V)_N = (tan δ - μ) / (1 + μ tan δ)`.
//!
//! **Both wheels** (H. Weinstock, ASME 84-WA/RT-1, 1984; remembered). The other wheel of the axle stands on
//! its tread, and its rail can push it across with μ' V' at most, with the friction μ' of its own tread. The
//! axle climbs where the flange does, and then the sizes add up to no more than
//!
//! `|L/V| + |L'/V'| = (tan δ - μ) / (1 + μ tan δ) + μ'`.
//!
//! Each friction is that of its own contact: μ of the flange on its rail at the angle δ, μ' of the other rail
//! at a level contact. With one friction for all it is Weinstock's own sum. The slope of the tread is left
//! out: of 1:20 it adds 0.05 to μ'.
//!
//! Limits: both are on the safe side at small angles of attack, where friction has a part along the rail;
//! neither says how far the wheel climbs. With friction that is no less than tan δ a flange climbs by itself:
//! the limit is then [`LEAST`], so that a share of it stays a number.

/// The least limit, for flanges that friction alone lets climb.
pub const LEAST: f64 = 0.01;

/// Returns Nadal's limit of L/V for a flange at an angle (rad) with a friction.
///
/// ```
/// let own = wheelrail::climb::nadal(75_f64.to_radians(), 0.5);
/// assert!((own - 1.13).abs() < 5e-3);
/// ```
#[must_use]
pub fn nadal(angle: f64, friction: f64) -> f64 {
    // tan(δ - arctan μ), without a pole where the flange is upright.
    let (sine, cosine) = libm::sincos(angle);
    let (across, up) = (sine - friction * cosine, cosine + friction * sine);
    match up > 0.0 {
        true => (across / up).max(LEAST),
        false => LEAST,
    }
}

/// Returns Weinstock's limit of the sum of |L/V| of both wheels of an axle: `nadal` is the limit of the
/// wheel whose flange bears, `tread` the friction of the other one on its tread.
#[must_use]
pub fn weinstock(nadal: f64, tread: f64) -> f64 {
    nadal + tread
}
