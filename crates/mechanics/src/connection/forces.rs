//! The forces of connections, rates of their accumulators, powers.

use integrate::scalar::Real;

use super::accumulator::{AxisForce, Grip, SpatialForce};
use super::gap::Gap;
use super::spring::Spring;
use super::surface::Surface;
use super::wedge::WedgeLaw;
use super::{Axis, Connections, Spatial};

/// A law on one coordinate.
pub(super) trait AxisLaw {
    fn act<S: Real>(&self, stroke: S, rate: S) -> AxisForce<S>;
}

/// A law on three coordinates with two deflections.
pub(super) trait SpatialLaw {
    /// Whether forces depend on the second and third stroke.
    fn uses_all_strokes(&self) -> bool;
    fn act<S: Real>(&self, strokes: [S; 3], rates: [S; 3], deflection: [S; 2], grip: Grip)
    -> SpatialForce<S>;
}

impl AxisLaw for Spring {
    #[inline(always)]
    fn act<S: Real>(&self, stroke: S, rate: S) -> AxisForce<S> {
        self.evaluate(stroke, rate)
    }
}

impl AxisLaw for Gap {
    #[inline(always)]
    fn act<S: Real>(&self, stroke: S, rate: S) -> AxisForce<S> {
        self.evaluate(stroke, rate)
    }
}

impl SpatialLaw for Surface {
    #[inline(always)]
    fn uses_all_strokes(&self) -> bool {
        false
    }
    #[inline(always)]
    fn act<S: Real>(
        &self,
        strokes: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        grip: Grip,
    ) -> SpatialForce<S> {
        self.evaluate(strokes, rates, deflection, grip)
    }
}

impl SpatialLaw for WedgeLaw {
    #[inline(always)]
    fn uses_all_strokes(&self) -> bool {
        self.is_spatial()
    }
    #[inline(always)]
    fn act<S: Real>(
        &self,
        strokes: [S; 3],
        rates: [S; 3],
        deflection: [S; 2],
        grip: Grip,
    ) -> SpatialForce<S> {
        self.evaluate(strokes, rates, deflection, grip)
    }
}

/// The deflections of an element among the internal states.
#[inline(always)]
pub(super) fn deflection_at(internal: Option<usize>, states: &[f64]) -> [f64; 2] {
    match internal.and_then(|at| states.get(at..at + 2)) {
        Some(e) => [e[0], e[1]],
        None => [0.0; 2],
    }
}

/// Coordinates and rates of all bodies.
pub(crate) type Places<'s> = (&'s [[f64; 6]], &'s [[f64; 6]]);

impl Connections {
    /// Adds the loads on all bodies and the powers, and writes the rates of the accumulators.
    pub fn forces(
        &self,
        places: Places<'_>,
        internal: &[f64],
        d_internal: &mut [f64],
        loads: &mut [[f64; 6]],
        powers: &mut [f64],
    ) {
        for spring in &self.springs {
            push_axis(spring, places, loads, powers);
        }
        for gap in &self.gaps {
            push_axis(gap, places, loads, powers);
        }
        for surface in &self.surfaces {
            let grip = self.grips.surfaces;
            push_spatial(surface, places, grip, internal, d_internal, loads, powers);
        }
        for wedge in &self.wedges {
            let grip = self.grips.wedges;
            push_spatial(wedge, places, grip, internal, d_internal, loads, powers);
        }
    }
}

#[inline(always)]
fn push_axis<L: AxisLaw>(
    axis: &Axis<L>,
    (positions, rates): Places<'_>,
    loads: &mut [[f64; 6]],
    powers: &mut [f64],
) {
    let site = &axis.site;
    let ([stroke], [rate]) = (site.strokes(positions), site.strokes(rates));
    let done = axis.law.act(stroke, rate);
    site.push([done.force], loads);
    if let Some(channel) = site.channels[0] {
        powers[channel] += done.loss;
    }
    if site.driven {
        powers[0] += done.force * site.drive(rates)[0];
    }
}

#[inline(always)]
fn push_spatial<L: SpatialLaw>(
    element: &Spatial<L>,
    (positions, rates): Places<'_>,
    grip: Grip,
    internal: &[f64],
    d_internal: &mut [f64],
    loads: &mut [[f64; 6]],
    powers: &mut [f64],
) {
    let site = &element.site;
    let (strokes, stroke_rates) = (site.strokes(positions), site.strokes(rates));
    let deflection = deflection_at(element.internal, internal);
    let done = element.law.act(strokes, stroke_rates, deflection, grip);
    site.push(done.force, loads);
    if let Some(at) = element.internal {
        d_internal[at..at + 2].copy_from_slice(&done.rate);
    }
    for (channel, power) in site.channels.iter().zip(done.powers) {
        if let Some(channel) = channel {
            powers[*channel] += power;
        }
    }
    if site.driven {
        let drive = site.drive(rates);
        powers[0] += done.force[0] * drive[0] + done.force[1] * drive[1] + done.force[2] * drive[2];
    }
}
