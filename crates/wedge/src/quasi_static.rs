//! The quasi-static wedge between neighbors that a caller moves: forces from displacements and rates, without
//! mass, moments or elasticity.
//!
//! The faces lie flat on each other, so that the wedge's height over the side frame follows from both
//! neighbors, `w = (z sin θ + x cos θ) cos φ / sin(θ+φ)` with the bolster's displacements x and z relative to
//! the side frame, plus the rise by wear; the coil's force follows from w. Friction is mobilized by
//! `tanh(w˙/v0)`, v0 the reference speed of the column's tanh law (with a bristle law 0.001 in/s): it creeps
//! under a held load as that law does. Where the weight exceeds the coil's force nothing is carried. Units
//! SI; x longitudinal, z up, as in [`crate::inputs`].

use mechanics::friction::FrictionLaw;
use mechanics::quasi_static::QuasiStaticWedge;
use numerics::scalar::Real;
use thiserror::Error;

use crate::inputs::CoilInput;
use crate::parameters::{Damping, Parameters};

/// The reference speed where the column's law has none, m/s: 0.001 in/s.
const REFERENCE_SPEED: f64 = 0.001 * 0.0254;

/// The wedge cannot slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the quasi-static wedge jams with these angles and coefficients of friction: there is no steady \
     sliding; choose a larger wedge angle, more toe out, or less friction"
)]
pub struct Jams;

/// Displacements and rates of a neighbor: x, z (m), and their rates (m/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePlace<S> {
    /// x and z.
    pub position: [S; 2],
    /// Their rates.
    pub rate: [S; 2],
}

/// Forces and powers of the wedge.
#[derive(Clone, Copy, Debug)]
pub struct PlaneReading<S> {
    /// Force on the bolster, x and z, N.
    pub on_bolster: [S; 2],
    /// Force on the side frame, x and z, N.
    pub on_side_frame: [S; 2],
    /// Compression of the coil, m.
    pub coil_compression: S,
    /// Spring force of the coil, N: positive pushes.
    pub coil_force: S,
    /// Normal forces of column and slope, N.
    pub normal_forces: [S; 2],
    /// Power lost in friction at column and slope, W.
    pub friction_losses: [S; 2],
    /// Power that the neighbors deliver, W.
    pub motion_power: S,
}

/// Returns the massless wedge of these parameters.
#[must_use]
pub fn massless(parameters: &Parameters) -> QuasiStaticWedge {
    QuasiStaticWedge {
        angle: parameters.wedge.angle,
        toe: parameters.toe,
        column_friction: parameters.column_friction.coefficient,
        slope_friction: parameters.slope_friction.coefficient,
    }
}

/// Returns the forces at these displacements and rates; `coil_change` is added to the spring's force (zero,
/// with a derivative if the law changes).
///
/// # Errors
/// The wedge jams.
pub fn read<S: Real>(
    parameters: &Parameters,
    bolster: &PlanePlace<S>,
    side_frame: &PlanePlace<S>,
    coil: &CoilInput,
    coil_change: S,
) -> Result<PlaneReading<S>, Jams> {
    let wedge = massless(parameters);
    let (sin, cos) = libm::sincos(wedge.angle);
    let (sin_toe, cos_toe) = libm::sincos(wedge.toe);
    let factor = cos_toe / libm::sin(wedge.angle + wedge.toe);
    let relative = |a: [S; 2], b: [S; 2]| [a[0] - b[0], a[1] - b[1]];
    let [x, z] = relative(bolster.position, side_frame.position);
    let [x_rate, z_rate] = relative(bolster.rate, side_frame.rate);
    let height = (z * sin + x * cos) * factor + parameters.wedge_rise();
    let height_rate = (z_rate * sin + x_rate * cos) * factor;

    let on_bolster = parameters.damping == Damping::Constant;
    let travel = if on_bolster { height - z } else { height };
    let compression = -travel + (parameters.coil.free_length - parameters.coil.nominal_length);
    let mut force = coil.law(parameters).force(compression) + coil_change;
    if !parameters.coil.pulls && force.value() <= 0.0 {
        force = S::zero();
    }
    let mut load = force - parameters.wedge.mass * parameters.gravity;
    if load.value() <= 0.0 {
        load = S::zero();
    }

    let speed = match parameters.column_friction.law {
        FrictionLaw::Tanh { reference_speed } => reference_speed,
        FrictionLaw::Bristle { .. } => REFERENCE_SPEED,
    };
    let mobilized = -(height_rate * (1.0 / speed)).tanh();
    let normal_forces = wedge.normal_forces(mobilized, load).ok_or(Jams)?;
    let [column, slope] = normal_forces;
    let [column_friction, slope_friction] = {
        let [c, s] = wedge.mobilize(mobilized);
        [c * column, s * slope]
    };
    // The column's force on the wedge: along (cos φ, -sin φ), and along (sin φ, cos φ).
    let push = [
        column * cos_toe + column_friction * sin_toe,
        column_friction * cos_toe - column * sin_toe,
    ];
    let mut to_bolster = [push[0], push[1] + load];
    let mut to_side_frame = [-push[0], -push[1]];
    if on_bolster {
        to_bolster[1] -= force;
    } else {
        to_side_frame[1] -= force;
    }
    // Sliding speeds of the wedge: up the column, and up the slope (-sin θ, cos θ).
    let up_column = height_rate * (1.0 / cos_toe);
    let [along_x, along_z] = [height_rate * (sin_toe / cos_toe) - x_rate, height_rate - z_rate];
    let up_slope = along_z * cos - along_x * sin;
    let power = |force: [S; 2], rate: [S; 2]| force[0] * rate[0] + force[1] * rate[1];
    Ok(PlaneReading {
        on_bolster: to_bolster,
        on_side_frame: to_side_frame,
        coil_compression: compression,
        coil_force: force,
        normal_forces,
        friction_losses: [-(column_friction * up_column), -(slope_friction * up_slope)],
        motion_power: -(power(to_bolster, bolster.rate) + power(to_side_frame, side_frame.rate)),
    })
}
