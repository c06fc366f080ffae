//! The linear benchmark of the industry's textbooks, posed with a car of one's own: side frames pinned to the
//! axles, the body on plates that turn freely and do nothing else, no friction and no damping in the
//! suspension, and a warp stiffness.
//!
//! Wedges carry nothing; load coils keep their stiffness, all in the middle of their nest, so that the nest
//! gives the bolster no stiffness against turning but the warp stiffness. The coils' shear along the track,
//! which holds the bolster square to the axles, is in series with it: what is asked for is the stiffness of
//! both. Wheels are those of the car: `wheels.geometry = "linear"` for a conicity of one's own.

use thiserror::Error;
use truck::{Adapter, AdapterPad, ControlCoil, NestCoil, SideBearing, Spring, WedgeKind, empirical_warp};
use wedge::parameters::{Contact, Damping};

use crate::parameters::Parameters;

/// Stiffness of what is tied, N/m.
const TIED: f64 = 1e9;
/// Half the distance of the points of an adapter that turns freely about the vertical, m.
const PIN: f64 = 0.003;
/// Clearance of gibs and lands that never meet, m.
const FREE: f64 = 1.0;
/// Warp angle at which the empirical warp springs have their moment, rad.
const WARP: f64 = 0.030;

/// The warp stiffness cannot be had.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "a warp stiffness of {warp:.4e} N·m/rad a truck cannot be had: the shear of the load coils along \
     the track, which is in series with it, gives {shear:.4e} N·m/rad"
)]
pub struct NoWarp {
    /// What is asked for, N·m/rad.
    pub warp: f64,
    /// What the coils give, N·m/rad.
    pub shear: f64,
}

impl Parameters {
    /// Returns the same car as the linear benchmark has it, with a warp stiffness a truck (N·m/rad).
    ///
    /// # Errors
    /// The load coils give less.
    pub fn tied(&self, warp: f64) -> Result<Self, NoWarp> {
        let mut own = self.clone();
        let carried = self.carried_mass() * self.gravity;
        for truck in &mut own.trucks {
            truck.damping = Damping::Constant;
            for wedge in &mut truck.wedges {
                wedge.kind = WedgeKind::Massless;
                wedge.column_friction.coefficient = 0.0;
                wedge.slope_friction.coefficient = 0.0;
                wedge.split.friction.coefficient = 0.0;
                // As good as nothing.
                wedge.control_coil = ControlCoil::Shear(Spring {
                    preload: 10.0,
                    stiffness: 1.0,
                    ..Spring::default()
                });
            }
            for coil in truck.load_coils.iter_mut().flatten() {
                coil.place = [0.0; 2];
                coil.spring.damping = 0.0;
                coil.spring.solid = None;
            }
            if let Some(wheelsets) = &mut truck.wheelsets {
                wheelsets.adapter = Adapter::Pad(AdapterPad {
                    preload: carried / 8.0,
                    stiffness: 1e4 * TIED,
                    shear_stiffness: TIED,
                    half_distance: PIN,
                    damping: 0.0,
                });
            }
            if let Some(body) = &mut truck.car_body {
                // A pivot that holds, and stiff side bearings without friction.
                body.center_plate.rings = vec![1e-3];
                body.center_plate.friction.coefficient = 10.0;
                let stiff = Contact {
                    stiffness: TIED,
                    damping: 0.0,
                };
                let mut friction = body.center_plate.friction;
                friction.coefficient = 0.0;
                body.side_bearings.kind = SideBearing::ConstantContact {
                    preload: carried / 12.0,
                    contact: stiff,
                    travel: FREE,
                    solid: stiff,
                    friction,
                    hysteresis: None,
                };
            }
            truck.gib.clearance = FREE;
            truck.lands.clearance = FREE;
            let nest = |coils: &[NestCoil]| coils.iter().map(|own| own.spring.shear_stiffness).sum::<f64>();
            let shear: f64 = truck.load_coils.iter().map(|own| nest(own)).sum();
            let square = shear * truck.geometry.nest() * truck.geometry.nest();
            if !(warp > 0.0 && warp < square) {
                return Err(NoWarp { warp, shear: square });
            }
            let of_a_nest = 0.5 / (1.0 / warp - 1.0 / square);
            let spring = empirical_warp(WARP * of_a_nest);
            truck.warp_spring = Some(spring.map_err(|_| NoWarp { warp, shear: square })?);
        }
        Ok(own)
    }
}
