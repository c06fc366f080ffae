//! The closed form of the quasi-static massless wedge for a case: reference lines for figures and tests.
//!
//! The wedge follows the bolster in rigid contact, lifted by its wear, with the frictions of the branch that
//! rigid kinematics choose (see [`mechanics::quasi_static`]). The coil carries the wedge's weight. Left out:
//! inertia, the elasticity of the contacts, the reversal of the frictions, moments, the lean of the coil,
//! every motion but the vertical one. Units: SI.

use std::f64::consts::PI;

use mechanics::coil::CoilLaw;
use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use wedge::parameters::{Damping, Parameters};

use crate::metrics::{Cycle, FirstHarmonic};

/// Returns the quasi-static wedge of these parameters.
#[must_use]
pub fn wedge(parameters: &Parameters) -> QuasiStaticWedge {
    QuasiStaticWedge {
        angle: parameters.wedge.angle,
        toe: parameters.toe,
        column_friction: parameters
            .column_face
            .friction(&parameters.column_friction)
            .coefficient,
        slope_friction: parameters
            .slope_face
            .friction(&parameters.slope_friction)
            .coefficient,
    }
}

/// Returns the bolster's yaw against the side frame at time zero, rad.
#[must_use]
pub fn yaw(parameters: &Parameters) -> f64 {
    let [bolster, side_frame] = [&parameters.bolster, &parameters.side_frame]
        .map(|neighbor| neighbor.coordinates[5].evaluate(0.0, 0.0)[0]);
    bolster - side_frame
}

/// Returns the coil's force less the wedge's weight, N, with the bolster at this height (m from nominal): the
/// wedge moves by `z sin θ / sin(θ + φ)` along z, and its wear lifts it. Zero where a coil that cannot pull
/// hangs free, or the weight exceeds it: the bolster has lifted off.
#[must_use]
pub fn load(parameters: &Parameters, bolster: f64) -> f64 {
    let coil = &parameters.coil;
    let angle = parameters.wedge.angle;
    let follows = bolster * libm::sin(angle) / libm::sin(angle + parameters.toe) + parameters.wedge_rise();
    let seat = match parameters.damping {
        Damping::Variable => 0.0,
        Damping::Constant => bolster,
    };
    let compression = coil.free_length - (coil.nominal_length + follows - seat);
    let force = match &coil.law {
        CoilLaw::Linear { stiffness } => stiffness * compression,
        CoilLaw::Table(table) => table.evaluate(compression),
        CoilLaw::Given { force } => *force,
    };
    (force - parameters.wedge.mass * parameters.gravity).max(0.0)
}

/// Returns the vertical wedge force, N: the column's friction on the side frame, positive up, with the
/// bolster at this height (m) and moving this way; `None` where the wedge jams.
#[must_use]
pub fn vertical_wedge_force(
    parameters: &Parameters,
    bolster: f64,
    direction: SlidingDirection,
) -> Option<f64> {
    let wedge = wedge(parameters);
    let slide = wedge.slide(direction, wedge.branch(direction), load(parameters, bolster))?;
    Some(-direction.sign() * slide.column_friction * libm::cos(parameters.toe))
}

/// Returns the vertical force of wedge and coil on the bolster, N, positive up; `None` where the wedge jams.
#[must_use]
pub fn force_on_bolster(parameters: &Parameters, bolster: f64, direction: SlidingDirection) -> Option<f64> {
    let wedge = wedge(parameters);
    let load = load(parameters, bolster);
    let slide = wedge.slide(direction, wedge.branch(direction), load)?;
    // The column's normal force leans by the toe.
    let vertical = -direction.sign() * slide.column_friction * libm::cos(parameters.toe)
        + slide.column_normal * libm::sin(parameters.toe);
    let weight = parameters.wedge.mass * parameters.gravity;
    Some(match parameters.damping {
        Damping::Variable => load - vertical,
        Damping::Constant => -weight - vertical,
    })
}

/// Equivalent stiffness and damping on the bolster over its vertical cycle, a sine, while the wedge stays
/// loaded: the branches are straight lines then, so that the stiffness is the slope of their mean and the
/// damping `W/(π ω A²)` with the work W between them. `None` without a cycle, where the wedge jams or the
/// bolster lifts off, or with a coil by table.
#[must_use]
pub fn first_harmonic(parameters: &Parameters) -> Option<FirstHarmonic> {
    let cycle = Cycle::of(parameters)?;
    let CoilLaw::Linear { .. } = parameters.coil.law else {
        return None;
    };
    let force = |z: f64, direction| {
        (load(parameters, z) > 0.0)
            .then(|| force_on_bolster(parameters, z, direction))
            .flatten()
    };
    let mean = |z: f64| Some(0.5 * (force(z, SlidingDirection::Up)? + force(z, SlidingDirection::Down)?));
    let (low, high) = (cycle.middle - cycle.amplitude, cycle.middle + cycle.amplitude);
    let stiffness = -(mean(high)? - mean(low)?) / (high - low);
    let between = force(cycle.middle, SlidingDirection::Down)? - force(cycle.middle, SlidingDirection::Up)?;
    let work = 2.0 * cycle.amplitude * between;
    Some(FirstHarmonic {
        stiffness,
        damping: work / (PI * cycle.angular_frequency * cycle.amplitude * cycle.amplitude),
    })
}

/// Energy lost a cycle in friction at the side frame, J, under the conditions of [`first_harmonic`].
#[must_use]
pub fn energy_per_cycle(parameters: &Parameters) -> Option<f64> {
    let cycle = Cycle::of(parameters)?;
    first_harmonic(parameters)?;
    let force = |direction| vertical_wedge_force(parameters, cycle.middle, direction);
    Some(2.0 * cycle.amplitude * (force(SlidingDirection::Up)? - force(SlidingDirection::Down)?))
}

/// Returns the largest restoring moment of one wedge in warp, N·m, under this normal force at the column (N):
/// it bears on one edge, half the wedge's width from its middle, `N_c h3/2`. A nest of two wedges has `N_c
/// h3`.
#[must_use]
pub fn edge_loading_limit(parameters: &Parameters, column_normal: f64) -> f64 {
    0.5 * parameters.wedge.width * column_normal
}
