//! reproduction: impact forces P1 and P2 at a dipped joint, against closed forms and a second derivation.
//!
//! Two ramps of the slope α meet at a joint of the total dip angle 2α: a wheel that runs over it at the speed
//! v has the velocity 2αv against the rail at once. Jenkins, Stephenson, Clayton, Morland and Lyon (1974)
//! estimate the two peaks of the load that follow, of the contact's vibration (P1) and of the unsprung mass
//! on the track (P2):
//!
//! ```text
//! P1 = P0 + 2αv √(k_H m_e / (1 + m_e/m_u))
//! P2 = P0 + 2αv √(m_u/(m_u + m_t)) (1 - π c_t / (4 √(k_t (m_u + m_t)))) √(k_t m_u)
//! ```
//!
//! They leave out that both vibrations overlap, and the closed form of P2 that its damping is not small: the
//! same two masses, integrated by themselves, are the sharper reference.

use crate::common;
use common::impact::{LOAD, closed_forms, joint, meeting};

/// The example of the closed form: 228.9 kN of P2 at 26.8 m/s and 2α = 0.02.
#[test]
fn reproduction_the_closed_form_of_p2_has_its_number() {
    let [_, second] = closed_forms(0.02 * 26.8, 1.0);
    assert!(((LOAD + second) * 1e-3 - 228.9).abs() < 0.05, "{second}");
}

/// A wheel that meets its rail at 2αv: both peaks of its load, by the elements and by two masses; P1 and P2
/// of the closed forms. The velocity is small, so that Hertz's spring is a linear one; P2 with a damped
/// contact.
#[test]
fn reproduction_impact_of_a_wheel_on_its_rail() {
    let [found, expected, closed] = meeting(0.01);
    for i in 0..2 {
        assert!(
            (found[i] / expected[i] - 1.0).abs() < 0.02,
            "{found:?} {expected:?} {closed:?}"
        );
        assert!(
            (found[i] / closed[i] - 1.0).abs() < 0.15,
            "{found:?} {expected:?} {closed:?}"
        );
    }
}

/// A dipped joint of a track: the load's second peak is P2. Rails are kept at points 1/8 m apart and round a
/// joint over that length, so that P1, whose vibration a wheel passes within a few centimeters, is not shown
/// by a track's joint.
#[test]
fn reproduction_a_dipped_joint_has_the_load_p2() {
    let (speed, angle) = (40.0, 1e-3);
    let found = joint(angle, speed);
    let [_, closed] = closed_forms(2.0 * angle * speed, 1.0);
    assert!((found / closed - 1.0).abs() < 0.1, "{found} {closed}");
}
