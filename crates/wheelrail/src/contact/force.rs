//! Forces of a contact: normal force with damping, creepages, creep forces.
//!
//! **Normal force** (Hunt and Crossley 1975): `N = k d^1.5 (1 + 1.5 α ḋ)`, not less than zero, with the
//! approach d and its rate ḋ, the velocity of the wheel's material against the normal: the rail is at rest. α
//! is 0.3 s/m on sprung track and 2 s/m on rigid track by default of models above; the values are guesses.
//!
//! **Creepages.** The velocity of the wheel's material at the patch over the reference speed
//! `V = √(v² + v_min²)` with the wheel's forward speed v, so that starting from rest is defined. At 1 m/s and
//! v_min = 0.1 m/s creepages come out 0.5 % too small. Spin is the angular velocity about the normal over V.
//!
//! Forces act on the wheel. Gravitational stiffness comes out of the geometry; none is added.

use std::f64::consts::PI;

use numerics::scalar::{Dual, Real};

use super::patch::ContactPatch;
use super::pose::{Side, WheelPose};
use super::search::FindPatches;
use super::strips::StripLoads;
use crate::creep::fastsim::StripGrid;
use crate::creep::polach::Reduction;
use crate::creep::{
    Coefficients, CreepForces, Creepage, Patch, fastsim, linear, polach, shen_hedrick_elkins,
    strips as on_strips,
};
use crate::friction::Friction;
use crate::vector::{cross, dot};

/// A creep law with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CreepLaw {
    /// No tangential forces.
    Frictionless,
    /// Kalker's linear theory, without saturation.
    Linear,
    /// Shen, Hedrick and Elkins.
    ShenHedrickElkins,
    /// Polach.
    Polach(Reduction),
    /// FASTSIM with a grid.
    Fastsim(StripGrid),
}

/// The laws of a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactLaw {
    /// Friction.
    pub friction: Friction,
    /// α of Hunt and Crossley, s/m.
    pub damping: f64,
    /// The creep law.
    pub creep: CreepLaw,
    /// Smallest reference speed v_min, m/s.
    pub slowest: f64,
}

/// Velocities of a wheel relative to the track, in axes x forward, y to the left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelMotion<S> {
    /// Velocity of the wheel's center, m/s.
    pub velocity: [S; 3],
    /// Angular velocity, rad/s: about +y if the wheel rolls forward.
    pub angular_velocity: [S; 3],
}

/// Forces at a patch, in the axes of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchForces<S> {
    /// Normal force, N, before its share.
    pub normal: S,
    /// Its elastic part `k d^1.5`, N.
    pub elastic: S,
    /// Rate of the approach, m/s: the velocity of the wheel's material against the normal.
    pub rate: S,
    /// Semi-axes of the ellipse along and across the rolling direction, m.
    pub axes: [S; 2],
    /// Creepages.
    pub creepage: Creepage<S>,
    /// Creep forces, before their share.
    pub creep: CreepForces<S>,
}

impl PatchForces<f64> {
    /// Returns the greatest pressure, Pa: that of Hertz's ellipse, or of the strips, whose lengths and
    /// pressures grow with the cube root of the load as damping adds to it.
    #[must_use]
    pub fn greatest_pressure(&self, strips: Option<&StripLoads<f64>>) -> f64 {
        let [a, b] = self.axes;
        match strips {
            None => 1.5 * self.normal / (PI * a * b),
            Some(strips) => strips.greatest_pressure() * libm::cbrt(self.normal / self.elastic),
        }
    }
}

/// Forces on a wheel, in axes x forward, y to the left, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelForces<S> {
    /// Force, N.
    pub force: [S; 3],
    /// Moment about the wheel's center, N·m.
    pub moment: [S; 3],
    /// Power that creep forces dissipate, W.
    pub creep_power: S,
    /// Power that damping of the normal force dissipates, W: never negative.
    pub damping_power: S,
    /// Power of the elastic normal forces, W, positive while they store energy.
    pub elastic_power: S,
}

impl ContactLaw {
    /// Returns the forces at a patch; `motion` is in the axes of the contact.
    #[inline(always)]
    pub fn at_patch<S: Real>(
        &self,
        pair: &impl FindPatches,
        pose: &WheelPose<S>,
        (patch, strips): (&ContactPatch<S>, Option<&StripLoads<S>>),
        motion: &WheelMotion<S>,
    ) -> PatchForces<S> {
        let arm = arm(pose, patch);
        let velocity = add(motion.velocity, cross(motion.angular_velocity, arm));
        let normal = patch.normal();
        let rate = -dot(velocity, normal);
        let elastic = patch.approach * patch.approach.sqrt() * patch.ellipse.stiffness;
        let load = elastic * (rate * (1.5 * self.damping) + 1.0);
        let forward = motion.velocity[0];
        let reference = (forward * forward + self.slowest * self.slowest).sqrt();
        let slip = [
            match patch.climb {
                None => velocity[0],
                Some(_) => dot(velocity, patch.along()),
            },
            dot(velocity, patch.across()),
        ];
        let creepage = Creepage {
            longitudinal: slip[0] / reference,
            lateral: slip[1] / reference,
            spin: dot(motion.angular_velocity, normal) / reference,
        };
        if load.value() <= 0.0 {
            return PatchForces {
                normal: S::zero(),
                elastic,
                rate,
                axes: [S::zero(); 2],
                creepage,
                creep: CreepForces::none(),
            };
        }
        let root = cube_root(load);
        let axes = patch.ellipse.axes.map(|axis| axis * root);
        let material = pair.material();
        let loaded = || Patch {
            axes,
            load,
            friction: self.friction.at(patch.slope, pose.along, slip),
            shear_modulus: material.shear_modulus(),
            coefficients: Coefficients::of(axes[0] / axes[1], material.poisson),
        };
        // Creep laws are those of a wheel that rolls forward; one that rolls backward is its mirror image.
        let sense = rolling_sense(forward, self.slowest);
        let ahead = Creepage {
            spin: creepage.spin * sense,
            ..creepage
        };
        let mut creep = match self.creep {
            CreepLaw::Frictionless => CreepForces::none(),
            CreepLaw::Linear => linear::forces(&loaded(), &ahead),
            CreepLaw::ShenHedrickElkins => shen_hedrick_elkins::forces(&loaded(), &ahead),
            CreepLaw::Polach(reduction) => polach::forces(&loaded(), &ahead, reduction),
            CreepLaw::Fastsim(grid) => match strips {
                None => fastsim::forces(&loaded(), &ahead, grid),
                Some(strips) => {
                    let scale = root / cube_root(elastic);
                    on_strips::forces(&loaded(), &ahead, strips, scale, grid.cells)
                }
            },
        };
        creep.spin_moment = creep.spin_moment * sense;
        PatchForces {
            normal: load,
            elastic,
            rate,
            axes,
            creepage,
            creep,
        }
    }

    /// Returns the forces on the wheel at a side; each patch with its forces, in the axes of the contact,
    /// goes to `see`.
    #[inline(always)]
    pub fn on_wheel<S: Real>(
        &self,
        pair: &impl FindPatches,
        side: Side,
        pose: &WheelPose<S>,
        motion: &WheelMotion<S>,
        mut see: impl FnMut(&ContactPatch<S>, &PatchForces<S>),
    ) -> WheelForces<S> {
        self.on_wheel_by_strips(pair, side, pose, motion, |patch, forces, _| see(patch, forces))
    }

    /// Returns the same; `see` also gets the loads on the strips of a patch that is no ellipse.
    #[inline(always)]
    pub fn on_wheel_by_strips<S: Real>(
        &self,
        pair: &impl FindPatches,
        side: Side,
        pose: &WheelPose<S>,
        motion: &WheelMotion<S>,
        see: impl FnMut(&ContactPatch<S>, &PatchForces<S>, Option<&StripLoads<S>>),
    ) -> WheelForces<S> {
        self.of_patches(pair, side, (pose, motion), |take| pair.find(pose, take), see)
    }

    /// Returns the forces on the wheel, and the rate at which the energy in its contacts grows (W) while the
    /// pose changes as `moving` says by its derivative.
    ///
    /// The energy at a pose is `Σ 2/5 k d^2.5` ([`stored_energy`]). Its rate is not the power of the elastic
    /// forces ([`WheelForces::elastic_power`]): k changes with the place of the patch, and the normal of a
    /// section is not quite that of the rail. The difference does not come back.
    #[inline(always)]
    pub fn on_moving_wheel<S: Real>(
        &self,
        pair: &impl FindPatches,
        side: Side,
        (pose, motion): (&WheelPose<S>, &WheelMotion<S>),
        moving: &WheelPose<Dual<1>>,
    ) -> (WheelForces<S>, f64) {
        let mut rate = 0.0;
        let forces = self.of_patches(
            pair,
            side,
            (pose, motion),
            |take| match size_of::<S>() == size_of::<f64>() {
                // Without derivatives the patches that move serve alone.
                true => pair.find(moving, |patch, strips| {
                    rate += energy(&patch).derivative[0];
                    take(patch.lifted(), strips.map(StripLoads::lifted).as_ref());
                }),
                false => pair.find_both(pose, moving, take, |patch| rate += energy(&patch).derivative[0]),
            },
            |_, _, _| (),
        );
        (forces, rate)
    }

    #[inline(always)]
    fn of_patches<S: Real>(
        &self,
        pair: &impl FindPatches,
        side: Side,
        (pose, motion): (&WheelPose<S>, &WheelMotion<S>),
        search: impl FnOnce(&mut dyn FnMut(ContactPatch<S>, Option<&StripLoads<S>>)),
        mut see: impl FnMut(&ContactPatch<S>, &PatchForces<S>, Option<&StripLoads<S>>),
    ) -> WheelForces<S> {
        let motion = WheelMotion {
            velocity: side.mirrored(motion.velocity),
            angular_velocity: side.mirrored_axial(motion.angular_velocity),
        };
        let zero = S::zero();
        let (mut force, mut moment, mut power) = ([zero; 3], [zero; 3], zero);
        let (mut damping, mut stored) = (zero, zero);
        search(&mut |patch: ContactPatch<S>, strips: Option<&StripLoads<S>>| {
            let found = self.at_patch(pair, pose, (&patch, strips), &motion);
            let (normal, across) = (patch.normal(), patch.across());
            let [x, y, spin] = [found.creep.x, found.creep.y, found.creep.spin_moment];
            let rolling = patch.climb.map(|_| patch.along());
            let own: [S; 3] = std::array::from_fn(|i| {
                let along = match rolling {
                    None if i == 0 => x,
                    None => zero,
                    Some(rolling) => rolling[i] * x,
                };
                (normal[i] * found.normal + across[i] * y + along) * patch.share
            });
            let about: [S; 3] = std::array::from_fn(|i| normal[i] * spin * patch.share);
            moment = add(moment, add(cross(arm(pose, &patch), own), about));
            force = add(force, own);
            let forward = motion.velocity[0];
            let reference = (forward * forward + self.slowest * self.slowest).sqrt();
            let Creepage {
                longitudinal,
                lateral,
                spin: turning,
            } = found.creepage;
            power += (longitudinal * x + lateral * y + turning * spin) * reference * patch.share * -1.0;
            damping += (found.normal - found.elastic) * found.rate * patch.share;
            stored += found.elastic * found.rate * patch.share;
            see(&patch, &found, strips);
        });
        WheelForces {
            force: side.mirrored(force),
            moment: side.mirrored_axial(moment),
            creep_power: power,
            damping_power: damping,
            elastic_power: stored,
        }
    }
}

/// Returns the sense in which a wheel rolls at a forward speed (m/s): 1 forward, -1 backward, between them
/// linear below the smallest reference speed (m/s).
#[inline(always)]
#[must_use]
pub fn rolling_sense<S: Real>(forward: S, slowest: f64) -> S {
    let speed = forward.value();
    if speed.abs() < slowest {
        forward * (1.0 / slowest)
    } else {
        S::from(speed.signum())
    }
}

/// Returns the energy of the elastic contacts at a pose, J: that of Hertz's law at the curvatures of the
/// pose.
#[must_use]
pub fn stored_energy(pair: &impl FindPatches, pose: &WheelPose<f64>) -> f64 {
    let mut sum = 0.0;
    pair.search(pose, |patch| sum += energy(&patch));
    sum
}

/// Energy of a patch, with its share.
#[inline(always)]
fn energy<S: Real>(patch: &ContactPatch<S>) -> S {
    let d = patch.approach;
    d * d * d.sqrt() * patch.ellipse.stiffness * patch.share * 0.4
}

/// Cube root of a positive number.
#[inline(always)]
pub(super) fn cube_root<S: Real>(of: S) -> S {
    let root = libm::cbrt(of.value());
    of.chain(root, root / (3.0 * of.value()))
}

/// Returns the vector from the wheel's center to a patch.
#[inline(always)]
fn arm<S: Real>(pose: &WheelPose<S>, patch: &ContactPatch<S>) -> [S; 3] {
    let [x, y, z] = patch.place;
    [x, y - pose.center[0], z - pose.center[1]]
}

#[inline(always)]
fn add<S: Real>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
