//! FASTSIM (Kalker 1982): the simplified theory on strips of the contact ellipse.
//!
//! Along each strip from its leading edge the tangential stress grows with the rigid slip over the
//! flexibilities `L1 = 8a / (3 C11 G)`, `L2 = 8a / (3 C22 G)`, `L3 = π a √(a/b) / (4 C23 G)`, and is cut off
//! at μ times the parabolic pressure `2N/(π a b) (1 - (x/a)² - (y/b)²)` (Kalker's choice; the elliptic one is
//! worse with spin). Forces and moment are sums over cells.
//!
//! Defects: piecewise smooth only, where cells change from sticking to slipping; without slip the midpoint
//! rule over strips gives the linear force times `1 + (2/n)²/8` for n strips.

use std::f64::consts::PI;

use numerics::scalar::Real;

use super::{CreepForces, Creepage, Patch};

/// Cells along the rolling direction, and strips across it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StripGrid {
    /// Cells of a strip, at least 1.
    pub cells: usize,
    /// Strips, at least 1.
    pub strips: usize,
}

/// Returns the creep forces.
pub fn forces<S: Real>(patch: &Patch<S>, creepage: &Creepage<S>, grid: StripGrid) -> CreepForces<S> {
    let [a, b] = patch.axes;
    let c = &patch.coefficients;
    let flexibility = a * (8.0 / (3.0 * patch.shear_modulus));
    let spin_flexibility = a * (a / b).sqrt() * (PI / (4.0 * patch.shear_modulus)) / c.c23;
    let rates = [
        creepage.longitudinal * c.c11 / flexibility,
        creepage.lateral * c.c22 / flexibility,
    ];
    let spin = creepage.spin / spin_flexibility;
    let greatest = patch.limit() * 2.0 / (a * b * PI);
    let (cells, strips) = (grid.cells.max(1) as f64, grid.strips.max(1) as f64);
    let width = b * (2.0 / strips);
    let mut sum = [S::zero(); 3];
    for strip in 0..grid.strips.max(1) {
        // All places are shares of the semi-axes.
        let across = -1.0 + (2.0 * strip as f64 + 1.0) / strips;
        let edge = (1.0 - across * across).sqrt();
        let (y, step) = (b * across, a * (2.0 * edge / cells));
        let mut stress = [S::zero(); 2];
        for cell in 0..grid.cells.max(1) {
            let along = edge * (1.0 - (2.0 * cell as f64 + 1.0) / cells);
            // The first step leads to the center of the first cell.
            let (length, middle) = match cell {
                0 => (step * 0.5, 0.5 * (edge + along)),
                _ => (step, along + edge / cells),
            };
            stress[0] -= (rates[0] - spin * y) * length;
            stress[1] -= (rates[1] + spin * a * middle) * length;
            let bound = greatest * (1.0 - along * along - across * across);
            let square = stress[0] * stress[0] + stress[1] * stress[1];
            if square.value() > bound.value() * bound.value() {
                let factor = bound / square.sqrt();
                stress = stress.map(|part| part * factor);
            }
            let area = step * width;
            sum[0] += stress[0] * area;
            sum[1] += stress[1] * area;
            sum[2] += (a * along * stress[1] - y * stress[0]) * area;
        }
    }
    let [x, y, spin_moment] = sum;
    CreepForces { x, y, spin_moment }
}
