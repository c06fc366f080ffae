//! The forces of connections, rates of their accumulators, powers.

use numerics::scalar::Real;

use super::accumulator::{AxisForce, FrictionRule, SpatialForce};
use super::gap::Gap;
use super::spring::Spring;
use super::surface::Surface;
use super::wedge::WedgeLaw;
use super::{Axis, Connections, Spatial};

/// A law on one coordinate.
pub(super) trait AxisLaw {
    fn force_at<S: Real>(&self, extension: S, rate: S) -> AxisForce<S>;
}

/// A law on three coordinates with two deflections.
pub(super) trait SpatialLaw {
    /// Returns whether forces depend on the second and third extension.
    fn uses_all_extensions(&self) -> bool;
    fn force_at<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> SpatialForce<S>;
}

impl AxisLaw for Spring {
    #[inline(always)]
    fn force_at<S: Real>(&self, extension: S, rate: S) -> AxisForce<S> {
        self.evaluate(extension, rate)
    }
}

impl AxisLaw for Gap {
    #[inline(always)]
    fn force_at<S: Real>(&self, extension: S, rate: S) -> AxisForce<S> {
        self.evaluate(extension, rate)
    }
}

impl SpatialLaw for Surface {
    #[inline(always)]
    fn uses_all_extensions(&self) -> bool {
        false
    }
    #[inline(always)]
    fn force_at<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> SpatialForce<S> {
        self.evaluate(extensions, rates, deflection, rule)
    }
}

impl SpatialLaw for WedgeLaw {
    #[inline(always)]
    fn uses_all_extensions(&self) -> bool {
        self.is_spatial()
    }
    #[inline(always)]
    fn force_at<S: Real>(
        &self,
        extensions: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        rule: FrictionRule,
    ) -> SpatialForce<S> {
        self.evaluate(extensions, rates, deflection, rule)
    }
}

/// Returns the deflections of an element among the internal states.
#[inline(always)]
pub(super) fn deflection_at(internal: Option<usize>, states: &[f64]) -> [f64; 2] {
    match internal.and_then(|at| states.get(at..at + 2)) {
        Some(e) => [e[0], e[1]],
        None => [0.0; 2],
    }
}

/// Coordinates and rates of all bodies.
pub(crate) type CoordinatesAndRates<'s> = (&'s [[f64; 6]], &'s [[f64; 6]]);

impl Connections {
    /// Adds the loads on all bodies and the powers, and writes the rates of the accumulators.
    pub fn forces(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        d_internal: &mut [f64],
        loads: &mut [[f64; 6]],
        powers: &mut [f64],
    ) {
        for spring in &self.springs {
            push_axis(spring, coordinates, loads, powers);
        }
        for gap in &self.gaps {
            push_axis(gap, coordinates, loads, powers);
        }
        for surface in &self.surfaces {
            let rule = self.friction_rules.surfaces;
            push_spatial(surface, coordinates, rule, internal, d_internal, loads, powers);
        }
        for wedge in &self.wedges {
            let rule = self.friction_rules.wedges;
            push_spatial(wedge, coordinates, rule, internal, d_internal, loads, powers);
        }
    }
}

#[inline(always)]
fn push_axis<L: AxisLaw>(
    axis: &Axis<L>,
    coordinates: CoordinatesAndRates<'_>,
    loads: &mut [[f64; 6]],
    powers: &mut [f64],
) {
    let site = &axis.site;
    let motion = site.motion(coordinates);
    let done = axis.law.force_at(motion.extensions[0], motion.rates[0]);
    site.push([done.force], &motion, loads);
    if let Some(energy_term) = site.energy_terms[0] {
        powers[energy_term] += done.loss;
    }
    if site.prescribed {
        powers[0] += done.force * site.prescribed_rates(coordinates.1)[0];
    }
}

#[inline(always)]
fn push_spatial<L: SpatialLaw>(
    element: &Spatial<L>,
    coordinates: CoordinatesAndRates<'_>,
    rule: FrictionRule,
    internal: &[f64],
    d_internal: &mut [f64],
    loads: &mut [[f64; 6]],
    powers: &mut [f64],
) {
    let site = &element.site;
    let motion = site.motion(coordinates);
    let deflection = deflection_at(element.internal, internal);
    let done = element
        .law
        .force_at(motion.extensions, motion.rates, deflection, rule);
    site.push(done.force, &motion, loads);
    if let Some(at) = element.internal {
        d_internal[at..at + 2].copy_from_slice(&done.rate);
    }
    for (energy_term, power) in site.energy_terms.iter().zip(done.powers) {
        if let Some(energy_term) = energy_term {
            powers[*energy_term] += power;
        }
    }
    if site.prescribed {
        let prescribed_rate = site.prescribed_rates(coordinates.1);
        powers[0] += done.force[0] * prescribed_rate[0]
            + done.force[1] * prescribed_rate[1]
            + done.force[2] * prescribed_rate[2];
    }
}
