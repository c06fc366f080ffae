//! The right-hand side: forces, accelerations, rates of the accumulators, powers.

use integrate::scalar::Real;

use super::law::gap::Gap;
use super::law::spring::Spring;
use super::law::surface::Surface;
use super::law::wedge::WedgeLaw;
use super::law::{AxisForce, Grip, SpatialForce};
use super::{Axis, Spatial, System};

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
type Places<'s> = (&'s [[f64; 6]], &'s [[f64; 6]]);

impl System {
    /// Rates of all states at the state that [`System::place`] was called with.
    pub(super) fn forces(&mut self, x: &[f64], dx: &mut [f64]) {
        let [_, speeds, internal, _] = self.layout.split(x);
        let [d_positions, d_speeds, d_internal, powers] = self.layout.split_mut(dx);
        d_positions.copy_from_slice(speeds);
        powers.fill(0.0);
        for free in &self.free {
            self.loads[free.body] = [0.0; 6];
        }
        let (places, loads) = ((&self.positions[..], &self.rates[..]), &mut self.loads[..]);
        for spring in &self.springs {
            push_axis(spring, places, loads, powers);
        }
        for gap in &self.gaps {
            push_axis(gap, places, loads, powers);
        }
        for surface in &self.surfaces {
            push_spatial(
                surface,
                places,
                self.grips.surfaces,
                internal,
                d_internal,
                loads,
                powers,
            );
        }
        for wedge in &self.wedges {
            push_spatial(
                wedge,
                places,
                self.grips.wedges,
                internal,
                d_internal,
                loads,
                powers,
            );
        }
        for free in &self.free {
            let load = &self.loads[free.body];
            let target = &mut d_speeds[free.offset..free.offset + free.free.len()];
            for (j, target) in target.iter_mut().enumerate() {
                *target = (load[free.free[j]] + free.weight[j]) / free.inertia[j];
            }
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
