//! A car body that twists: two rigid halves on a torsion spring about the longitudinal axis.
//!
//! Body and lading of mass m, with center of gravity c and principal moments of inertia I about axes e_k
//! (forward, left, up), are divided across e_1. Each half has m/2 at `c ± a e_1` and the moments
//!
//! ```text
//! I_1/2,   I_2/2 - m a²/2,   I_3/2 - m a²/2,     a² = ¾ min(I_2, I_3)/m
//! ```
//!
//! so that both together have mass, center and inertia of the whole; a is that of a uniform bar, a quarter
//! of its length. Between them at c is a bushing: about the axis forward the torsion spring K with its
//! damping; along all axes and about the other two a joint, of which the halves against each other have 100
//! Hz (a choice: a loaded half on its center plate has 60 Hz, adapters more). It carries the bending moment
//! of the nominal layout without giving way. The halves twist against each other at
//!
//! ```text
//! ω² = K (1/J + 1/J) = 4 K/I_1
//! ```
//!
//! Units: N·m/rad, kg·m². Defects: of bending the 100 Hz of the joint, not that of a body; the twist of half
//! the body's length stands for the whole, so that each truck sees the stiffness K from end to end, and
//! bodies beyond the truck centers twist with them; the axis is at the center of gravity, not at the center
//! of shear.

use std::f64::consts::TAU;

use mechanics::elements::Bushing;

use crate::body::Carried;
use crate::parameters::Torsion;

/// Frequency of the halves against each other in the joint, Hz, and its share of critical damping.
pub(crate) const JOINT: f64 = 100.0;
const JOINT_DAMPING: f64 = 0.2;
/// Share of the distance of the halves' centers that leaves them the inertia of bars.
const OF_BARS: f64 = 0.75;

/// Returns the distance of the center of gravity of each half from that of the whole, m.
fn arm(whole: &Carried) -> f64 {
    let [_, left, up] = whole.inertia;
    (OF_BARS * left.min(up) / whole.mass).sqrt()
}

/// Returns the halves of a body: front and rear.
pub(crate) fn halves(whole: &Carried) -> [Carried; 2] {
    let arm = arm(whole);
    let axis = whole.axes.column(0);
    let moved = 0.5 * whole.mass * arm * arm;
    let [roll, pitch, yaw] = whole.inertia;
    [1.0, -1.0].map(|end| Carried {
        mass: 0.5 * whole.mass,
        center: std::array::from_fn(|k| whole.center[k] + end * arm * axis.0[k]),
        inertia: [0.5 * roll, 0.5 * pitch - moved, 0.5 * yaw - moved],
        axes: whole.axes,
    })
}

/// Returns the joint of the halves of a body on trucks of this distance (m), with markers at its center of
/// gravity along the axes of the nominal layout; A is on the front half.
pub(crate) fn joint(whole: &Carried, torsion: &Torsion, truck_distance: f64, gravity: f64) -> Bushing {
    let [front, _] = halves(whole);
    let square = (TAU * JOINT) * (TAU * JOINT);
    let damping = |stiffness: f64| 2.0 * JOINT_DAMPING * stiffness / (TAU * JOINT);
    // Of two masses m/2 against each other, and of two bars on a hinge.
    let along = 0.25 * whole.mass * square;
    let [_, pitch, yaw] = front.inertia.map(|own| 0.5 * own * square);
    // What half of the weight on a plate and the weight of a half make about the middle: positive bends it
    // down in the middle.
    let bending = 0.5 * whole.mass * gravity * (0.5 * truck_distance - arm(whole));
    Bushing {
        name: "car_body_torsion".to_owned(),
        load: [0.0; 3],
        stiffness: [along; 3],
        damping: [damping(along); 3],
        rotational_load: [0.0, bending, 0.0],
        rotational_stiffness: [torsion.stiffness, pitch, yaw],
        rotational_damping: [torsion.damping_of(whole.inertia[0]), damping(pitch), damping(yaw)],
    }
}

impl Torsion {
    /// Returns the frequency of a body with this moment of inertia about the axis forward (kg·m²), Hz.
    #[must_use]
    pub fn frequency(&self, inertia: f64) -> f64 {
        (4.0 * self.stiffness / inertia).sqrt() / TAU
    }

    /// Returns its damping, N·m·s/rad.
    fn damping_of(&self, inertia: f64) -> f64 {
        2.0 * self.damping * self.stiffness / (TAU * self.frequency(inertia))
    }
}
