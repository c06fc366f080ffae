//! Derivatives of a connection between markers by the coordinates of its two bodies.
//!
//! A law gives derivatives by extensions s, their rates and its deflections ([`Local`]). With the levers `J =
//! ∂s/∂q`, the same for the rates by the rates of coordinates, and `∂s˙/∂q` a quantity p changes by `∂p/∂q =
//! p_s J + p_s˙ ∂s˙/∂q` and `∂p/∂q˙ = p_s˙ J`. The forces on the coordinates are `Q = -Jᵀ f`, so that `∂Q/∂q
//! = -Jᵀ ∂f/∂q - Σ f ∂²s/∂q∂q`, the last the geometric stiffness.

use super::between::{Between, Both, Change};
use super::jacobian::{JacobianInputs, Local, Partial};
use super::site::Site;

/// The internal states of a connection: the number of their pair, and the rows of its powers by them.
pub(super) type Internal<'s> = (usize, &'s [Option<usize>; 4]);

impl<const D: usize> Change<D> {
    /// Returns the derivatives of a quantity by coordinates and by their rates.
    #[inline(always)]
    fn of(&self, partial: &Partial) -> [Both; 2] {
        let mut by = [[0.0; 12]; 2];
        for c in 0..D {
            let (stiffness, damping) = (partial.extensions[c], partial.rates[c]);
            for k in 0..12 {
                by[0][k] += stiffness * self.levers[c][k] + damping * self.lever_rates[c][k];
                by[1][k] += damping * self.levers[c][k];
            }
        }
        by
    }
}

impl JacobianInputs<'_> {
    /// Adds the derivatives of an element between markers.
    pub(super) fn between<const D: usize, const P: usize>(
        &mut self,
        site: &Site<D, P>,
        between: &Between<D>,
        local: &Local,
        internal: Option<Internal<'_>>,
    ) {
        let change = between.change(self.positions, self.rates, &local.force);
        let forces: [[Both; 2]; D] = std::array::from_fn(|c| change.of(&local.forces[c]));
        for (i, row_end) in site.ends.iter().enumerate() {
            for (j, column_end) in site.ends.iter().enumerate() {
                if row_end.free.is_none() || column_end.free.is_none() {
                    continue;
                }
                let (k, d) = self.jacobian.blocks_mut(site.pairs[i][j]);
                for (row, at) in free(&site.slots[i]) {
                    for (column, by) in free(&site.slots[j]) {
                        let (row, column) = (6 * i + row, 6 * j + column);
                        let entry = at * column_end.size + by;
                        k[entry] -= change.stiffness[row][column];
                        for (lever, force) in change.levers.iter().zip(&forces) {
                            k[entry] -= lever[row] * force[0][column];
                            d[entry] -= lever[row] * force[1][column];
                        }
                    }
                }
            }
        }
        let powers = local.powers.each_ref().map(|power| change.of(power));
        for (i, quadratures) in site.quadratures.iter().enumerate() {
            for (row, power) in quadratures.iter().zip(&powers) {
                let Some(row) = row else { continue };
                let (by_position, by_speed) = self.jacobian.row_mut(*row);
                for (coordinate, at) in free(&site.slots[i]) {
                    by_position[at] += power[0][6 * i + coordinate];
                    by_speed[at] += power[1][6 * i + coordinate];
                }
            }
        }
        let Some((group, rows)) = internal else { return };
        for (row, power) in rows.iter().zip(&local.powers) {
            if let Some(row) = row {
                *self.jacobian.internal_row_mut(*row) = power.deflection;
            }
        }
        let [first, second] = local.deflection_rates.each_ref().map(|rate| rate.deflection);
        *self.jacobian.internal_mut(group) = [first[0], first[1], second[0], second[1]];
        let rates = local.deflection_rates.each_ref().map(|rate| change.of(rate));
        let ends = site.ends.iter().enumerate().filter(|(_, end)| end.free.is_some());
        for (side, (i, end)) in ends.enumerate() {
            let [by_position, by_speed, force] = self.jacobian.side_mut(group, side);
            for (coordinate, at) in free(&site.slots[i]) {
                for (e, rate) in rates.iter().enumerate() {
                    let entry = e * end.size + at;
                    by_position[entry] += rate[0][6 * i + coordinate];
                    by_speed[entry] += rate[1][6 * i + coordinate];
                    for (lever, own) in change.levers.iter().zip(&local.forces) {
                        force[entry] -= lever[6 * i + coordinate] * own.deflection[e];
                    }
                }
            }
        }
    }
}

/// Returns the free coordinates of a body and their numbers among these.
#[inline(always)]
fn free(slots: &[Option<usize>; 6]) -> impl Iterator<Item = (usize, usize)> {
    slots
        .iter()
        .enumerate()
        .filter_map(|(coordinate, slot)| slot.map(|at| (coordinate, at)))
}
