//! FASTSIM on the strips of a patch that is no ellipse (Kalker 1982; Kik and Piotrowski 1996).
//!
//! Along each strip from its leading edge the tangential stress grows as in the ellipse of the patch: the
//! flexibilities are those of [`fastsim`](super::fastsim) with the semi-axes and Kalker's coefficients of the
//! ellipse that has the load and the variance of the load across the rolling direction in common with the
//! strips. It is cut off at μ times the pressure `κ (a_j² - x²)` of a strip of the half length a_j, with the
//! κ that gives the whole load: on an ellipse the parabolic pressure of FASTSIM, and its forces.
//!
//! Defects: those of FASTSIM; the ellipse's flexibilities for all strips; one coefficient of friction and one
//! creepage for a patch, though its strips may be inclined differently.

use std::f64::consts::PI;

use numerics::scalar::Real;

use super::{CreepForces, Creepage, Patch};
use crate::contact::{STRIPS, StripLoads};

/// Returns the creep forces; lengths of the strips count `scale` times; a strip has `cells` cells.
pub fn forces<S: Real>(
    patch: &Patch<S>,
    creepage: &Creepage<S>,
    strips: &StripLoads<S>,
    scale: S,
    cells: usize,
) -> CreepForces<S> {
    let [a, b] = patch.axes;
    let c = &patch.coefficients;
    let flexibility = a * (8.0 / (3.0 * patch.shear_modulus));
    let spin_flexibility = a * (a / b).sqrt() * (PI / (4.0 * patch.shear_modulus)) / c.c23;
    let rates = [
        creepage.longitudinal * c.c11 / flexibility,
        creepage.lateral * c.c22 / flexibility,
    ];
    let spin = creepage.spin / spin_flexibility;
    let width = strips.width * scale;
    let mut capacity = S::zero();
    for half in strips.half_length.iter().filter(|half| half.value() > 0.0) {
        let half = *half * scale;
        capacity += half * half * half;
    }
    if capacity.value() <= 0.0 {
        return CreepForces::none();
    }
    let greatest = patch.limit() / (capacity * width) * 0.75;
    let cells = cells.max(1);
    let mut sum = [S::zero(); 3];
    for j in 0..STRIPS {
        if strips.half_length[j].value() <= 0.0 {
            continue;
        }
        let half = strips.half_length[j] * scale;
        let (y, middle) = (strips.across[j] * scale, strips.along[j] * scale);
        let step = half * (2.0 / cells as f64);
        let bound_of_strip = greatest * half * half;
        let rate = [rates[0] - spin * y, rates[1] + spin * middle];
        let mut stress = [S::zero(); 2];
        let mut own = [S::zero(); 3];
        for cell in 0..cells {
            // Places along the strip are shares of its half length. The first step leads to the center of the
            // first cell.
            let at = 1.0 - (2.0 * cell as f64 + 1.0) / cells as f64;
            let (length, between) = match cell {
                0 => (step * 0.5, 0.5 * (1.0 + at)),
                _ => (step, at + 1.0 / cells as f64),
            };
            stress[0] -= rate[0] * length;
            stress[1] -= (rate[1] + spin * half * between) * length;
            let bound = bound_of_strip * (1.0 - at * at);
            let square = stress[0] * stress[0] + stress[1] * stress[1];
            if square.value() > bound.value() * bound.value() {
                let factor = bound / square.sqrt();
                stress = stress.map(|part| part * factor);
            }
            own[0] += stress[0];
            own[1] += stress[1];
            own[2] += stress[1] * at;
        }
        let area = step * width;
        let [x, across, turning] = own.map(|part| part * area);
        sum[0] += x;
        sum[1] += across;
        sum[2] += turning * half + across * middle - x * y;
    }
    let [x, y, spin_moment] = sum;
    CreepForces { x, y, spin_moment }
}
