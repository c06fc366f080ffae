//! Derivatives: every law once, with numbers that carry its own few derivatives, and the constant rows around
//! them.
//!
//! An element gives derivatives by its extensions, their rates and its deflections (2, 6 or 8 of them); with
//! the rows J of its displacements they become `-Jᵀ (∂f/∂s) J` in the blocks of the two bodies.

use numerics::partitioned::Partitioned;
use numerics::scalar::Dual;

use super::accumulator::FrictionRule;
use super::forces::{AxisLaw, SpatialLaw, deflection_at};
use super::site::Site;
use super::{Axis, Connections, Spatial};

/// Everything that derivatives are taken at, and where derivatives by time are gathered.
pub(crate) struct JacobianInputs<'s> {
    pub positions: &'s [[f64; 6]],
    pub rates: &'s [[f64; 6]],
    pub accelerations: &'s [[f64; 6]],
    pub internal: &'s [f64],
    pub jacobian: &'s mut Partitioned,
    pub loads: &'s mut [[f64; 6]],
    pub d_internal: &'s mut [f64],
    pub d_quadratures: &'s mut [f64],
}

/// Derivatives of one quantity by extensions, rates and deflections.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Partial {
    pub extensions: [f64; 3],
    pub rates: [f64; 3],
    pub deflection: [f64; 2],
}

impl Partial {
    /// Returns the derivatives of a number whose seeds are `N - 5` extensions, three rates, two deflections.
    #[inline(always)]
    fn of<const N: usize>(number: &Dual<N>) -> Self {
        let d = &number.derivative;
        let first = N - 5;
        let mut partial = Self::default();
        partial.extensions[..first].copy_from_slice(&d[..first]);
        partial.rates.copy_from_slice(&d[first..first + 3]);
        partial.deflection.copy_from_slice(&d[first + 3..]);
        partial
    }

    /// Returns the derivative by time, extensions and rates changing at these rates.
    #[inline(always)]
    fn in_time(&self, prescribed_rate: &[f64; 3], prescribed_acceleration: &[f64; 3]) -> f64 {
        let mut sum = 0.0;
        for k in 0..3 {
            sum += self.extensions[k] * prescribed_rate[k] + self.rates[k] * prescribed_acceleration[k];
        }
        sum
    }
}

/// Derivatives of all that an element does.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Local {
    pub force: [f64; 3],
    pub forces: [Partial; 3],
    pub deflection_rates: [Partial; 2],
    pub powers: [Partial; 3],
}

impl Connections {
    /// Adds the derivatives of all connections.
    pub fn differentiate(&self, inputs: &mut JacobianInputs<'_>) {
        for spring in &self.springs {
            inputs.axis(spring);
        }
        for gap in &self.gaps {
            inputs.axis(gap);
        }
        for surface in &self.surfaces {
            inputs.spatial(surface, self.friction_rules.surfaces);
        }
        for wedge in &self.wedges {
            inputs.spatial(wedge, self.friction_rules.wedges);
        }
    }
}

impl JacobianInputs<'_> {
    #[inline(always)]
    fn axis<L: AxisLaw>(&mut self, axis: &Axis<L>) {
        let site = &axis.site;
        let motion = site.motion((self.positions, self.rates));
        let ([extension], [rate]) = (motion.extensions, motion.rates);
        let done = axis
            .law
            .force_at(Dual::<2>::variable(extension, 0), Dual::<2>::variable(rate, 1));
        let [stiffness, damping] = done.force.derivative;
        if let Some(between) = &site.between {
            let partial = |[by_extension, by_rate]: [f64; 2]| Partial {
                extensions: [by_extension, 0.0, 0.0],
                rates: [by_rate, 0.0, 0.0],
                ..Partial::default()
            };
            let mut local = Local::default();
            local.force[0] = done.force.value;
            local.forces[0] = partial(done.force.derivative);
            local.powers[0] = partial(done.loss.derivative);
            self.between(site, between, &local, None);
            return;
        }
        for (i, row_end) in site.ends.iter().enumerate() {
            for (j, column_end) in site.ends.iter().enumerate() {
                if row_end.free.is_none() || column_end.free.is_none() {
                    continue;
                }
                let sign = -row_end.sign * column_end.sign;
                let (row, column) = (&site.rows[i][0], &site.rows[j][0]);
                let (k, d) = self.jacobian.blocks_mut(site.pairs[i][j]);
                if stiffness != 0.0 {
                    row.add_product(column, sign * stiffness, column_end.size, k);
                }
                if damping != 0.0 {
                    row.add_product(column, sign * damping, column_end.size, d);
                }
            }
        }
        let prescribed_rate = if site.prescribed {
            site.prescribed_rates(self.rates)[0]
        } else {
            0.0
        };
        for (j, end) in site.ends.iter().enumerate() {
            let rows = [
                (site.quadratures[j][0], done.loss.derivative),
                (
                    site.works[j],
                    done.force
                        .derivative
                        .map(|derivative| derivative * prescribed_rate),
                ),
            ];
            for (row, [by_extension, by_rate]) in rows {
                if let Some(row) = row {
                    let (p_q, p_u) = self.jacobian.row_mut(row);
                    site.rows[j][0].add(end.sign * by_extension, p_q);
                    site.rows[j][0].add(end.sign * by_rate, p_u);
                }
            }
        }
        if site.prescribed {
            let [prescribed_acceleration] = site.prescribed_rates(self.accelerations);
            let in_time = |[by_extension, by_rate]: [f64; 2]| {
                by_extension * prescribed_rate + by_rate * prescribed_acceleration
            };
            let force_rate = in_time(done.force.derivative);
            site.push_along_axes([force_rate], self.loads);
            self.d_quadratures[0] +=
                force_rate * prescribed_rate + done.force.value * prescribed_acceleration;
            if let Some(energy_term) = site.energy_terms[0] {
                self.d_quadratures[energy_term] += in_time(done.loss.derivative);
            }
        }
    }

    #[inline(always)]
    fn spatial<L: SpatialLaw>(&mut self, element: &Spatial<L>, rule: FrictionRule) {
        let local = if element.law.uses_all_extensions() {
            self.local::<L, 8>(element, rule)
        } else {
            self.local::<L, 6>(element, rule)
        };
        if let Some(between) = &element.site.between {
            let internal = element.internal.map(|at| (at / 2, &element.internal_rows));
            self.between(&element.site, between, &local, internal);
            return;
        }
        self.add_forces(&element.site, &local);
        self.add_powers(element, &local);
        if let Some(internal) = element.internal {
            self.add_deflections(element, internal / 2, &local);
        }
        if element.site.prescribed {
            self.add_time(element, &local);
        }
    }

    /// Returns the law with its derivatives.
    #[inline(always)]
    fn local<L: SpatialLaw, const N: usize>(&self, element: &Spatial<L>, rule: FrictionRule) -> Local {
        let motion = element.site.motion((self.positions, self.rates));
        let (extensions, rates) = (motion.extensions, motion.rates);
        let deflection = deflection_at(element.internal, self.internal);
        let first = N - 5;
        let seed = |values: [f64; 3], from: usize, count: usize| -> [Dual<N>; 3] {
            let number = |k: usize| match k < count {
                true => Dual::variable(values[k], from + k),
                false => Dual::from(values[k]),
            };
            [number(0), number(1), number(2)]
        };
        let done = element.law.force_at(
            seed(extensions, 0, first),
            seed(rates, first, 3),
            [
                Dual::variable(deflection[0], first + 3),
                Dual::variable(deflection[1], first + 4),
            ],
            rule,
        );
        Local {
            force: done.force.map(|force| force.value),
            forces: done.force.map(|force| Partial::of(&force)),
            deflection_rates: done.rate.map(|rate| Partial::of(&rate)),
            powers: done.powers.map(|power| Partial::of(&power)),
        }
    }

    /// K and D of both bodies.
    fn add_forces(&mut self, site: &Site<3, 3>, local: &Local) {
        for (i, row_end) in site.ends.iter().enumerate() {
            for (j, column_end) in site.ends.iter().enumerate() {
                if row_end.free.is_none() || column_end.free.is_none() {
                    continue;
                }
                let sign = -row_end.sign * column_end.sign;
                let width = column_end.size;
                let (k, d) = self.jacobian.blocks_mut(site.pairs[i][j]);
                for (partial, row) in local.forces.iter().zip(&site.rows[i]) {
                    for (b, column) in site.rows[j].iter().enumerate() {
                        let (by_extension, by_rate) = (partial.extensions[b], partial.rates[b]);
                        if by_extension != 0.0 {
                            row.add_product(column, sign * by_extension, width, k);
                        }
                        if by_rate != 0.0 {
                            row.add_product(column, sign * by_rate, width, d);
                        }
                    }
                }
            }
        }
    }

    /// Rows of the quadratures.
    fn add_powers<L>(&mut self, element: &Spatial<L>, local: &Local) {
        let site = &element.site;
        let work = self.work(site, local);
        for (j, end) in site.ends.iter().enumerate() {
            let energy_terms = site.quadratures[j].iter().zip(&local.powers);
            for (row, power) in energy_terms.chain([(&site.works[j], &work)]) {
                let Some(row) = row else { continue };
                let (p_q, p_u) = self.jacobian.row_mut(*row);
                for (b, column) in site.rows[j].iter().enumerate() {
                    column.add(end.sign * power.extensions[b], p_q);
                    column.add(end.sign * power.rates[b], p_u);
                }
            }
        }
        let powers = local.powers.iter().chain([&work]);
        for (row, power) in element.internal_rows.iter().zip(powers) {
            if let Some(row) = row {
                *self.jacobian.internal_row_mut(*row) = power.deflection;
            }
        }
    }

    /// Returns the derivatives of the power of the prescribed motions.
    #[inline(always)]
    fn work(&self, site: &Site<3, 3>, local: &Local) -> Partial {
        let mut work = Partial::default();
        if site.prescribed {
            let prescribed_rate = site.prescribed_rates(self.rates);
            for (force, prescribed_rate) in local.forces.iter().zip(prescribed_rate) {
                for k in 0..3 {
                    work.extensions[k] += prescribed_rate * force.extensions[k];
                    work.rates[k] += prescribed_rate * force.rates[k];
                }
                for e in 0..2 {
                    work.deflection[e] += prescribed_rate * force.deflection[e];
                }
            }
        }
        work
    }

    /// The pair of internal states: by itself, by the bodies, and forces by it.
    fn add_deflections<L>(&mut self, element: &Spatial<L>, group: usize, local: &Local) {
        let site = &element.site;
        let [first, second] = local.deflection_rates.map(|rate| rate.deflection);
        *self.jacobian.internal_mut(group) = [first[0], first[1], second[0], second[1]];
        let mut side = 0;
        for (j, end) in site.ends.iter().enumerate() {
            if end.free.is_none() {
                continue;
            }
            let n = end.size;
            let [g_q, g_u, f_t] = self.jacobian.side_mut(group, side);
            side += 1;
            for (b, column) in site.rows[j].iter().enumerate() {
                for (e, rate) in local.deflection_rates.iter().enumerate() {
                    column.add(end.sign * rate.extensions[b], &mut g_q[e * n..][..n]);
                    column.add(end.sign * rate.rates[b], &mut g_u[e * n..][..n]);
                }
                for e in 0..2 {
                    let by_deflection = local.forces[b].deflection[e];
                    column.add(-end.sign * by_deflection, &mut f_t[e * n..][..n]);
                }
            }
        }
    }

    /// Derivatives by time.
    fn add_time<L>(&mut self, element: &Spatial<L>, local: &Local) {
        let site = &element.site;
        let (prescribed_rate, prescribed_acceleration) = (
            site.prescribed_rates(self.rates),
            site.prescribed_rates(self.accelerations),
        );
        let rates = local
            .forces
            .map(|force| force.in_time(&prescribed_rate, &prescribed_acceleration));
        site.push_along_axes(rates, self.loads);
        for k in 0..3 {
            self.d_quadratures[0] +=
                rates[k] * prescribed_rate[k] + local.force[k] * prescribed_acceleration[k];
        }
        for (energy_term, power) in site.energy_terms.iter().zip(&local.powers) {
            if let Some(energy_term) = energy_term {
                self.d_quadratures[*energy_term] += power.in_time(&prescribed_rate, &prescribed_acceleration);
            }
        }
        if let Some(at) = element.internal {
            for (e, rate) in local.deflection_rates.iter().enumerate() {
                self.d_internal[at + e] = rate.in_time(&prescribed_rate, &prescribed_acceleration);
            }
        }
    }
}
