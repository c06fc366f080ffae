//! Depth maps of a wedge's face and its counterface that grow over many runs.
//!
//! A run says how fast every point wears, and the wedge runs again when it has worn by much more than its
//! faces are pressed in: then the run's pressures have long evened out. A step therefore takes them as those
//! of a bed of springs (Winkler) under a constant load and slip: what a point is worn deeper than the mean
//! takes load from it. With the mean depth m that both partners lose in the step, and the penetration δ of
//! the face under its mean load, the wear of a point by the pace g at the beginning and its mean ḡ is
//!
//! `d = ḡ + (g - ḡ) φ(m/δ)`, `φ(x) = (1 - exp(-x))/x`,
//!
//! the exact solution of `d' = c N`, `N' = -k (d' - mean of d')` over all points. Short steps wear each point
//! by its own pace, long ones all alike; no step makes high places of low ones. Volumes stay as they are. The
//! counterface is laid down by where the points are, and evened by the same factor over what is touched.
//!
//! Units: m, m², N. Limits: one φ a face; every point slides as far as the others.

use wedge::face::{DepthMap, FaceProperties};
use wedge::outputs::FACES;

use super::WedgeLaw;
use crate::wear::counterface::{Laid, Lattice};
use truck::{Wedge, WedgeKind};

/// A face of a wedge as far as its wear needs it; of a split wedge that of a half.
#[derive(Clone, Debug)]
pub struct FacePlan {
    /// The part of the face that each point stands for; they sum to 1.
    pub(super) weights: Vec<f64>,
    area: f64,
    /// Of all points together, N/m.
    stiffness: f64,
    /// Coefficient of friction at rest.
    friction: f64,
    /// Number of such faces that wear by their mean.
    count: f64,
    face: FaceProperties,
    lattice: Lattice,
}

/// How a face grows in a step by its pace at the beginning.
#[derive(Clone, Debug)]
pub struct FaceGrowth {
    /// Depths of the wedge's points, m.
    depths: Vec<f64>,
    /// Volumes of the counterface, m³.
    laid: Laid<f64>,
    /// Normal force times depth, N·m.
    force: f64,
}

/// Depths of a face and its counterface after some steps.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceMaps {
    /// Mean depth of the wedge's face, m.
    pub face: f64,
    /// Mean depth of the counterface over what the wedge has touched, m.
    pub counterface: f64,
    depths: Vec<f64>,
    /// Of the counterface, without what is even, m³, and its mean depth, m.
    laid: Laid<f64>,
    uneven: f64,
}

impl FacePlan {
    /// Returns those of a wedge, column and slope.
    #[must_use]
    pub fn of(wedge: &Wedge) -> [Self; FACES.len()] {
        let (part, count) = match wedge.kind {
            WedgeKind::Split => (wedge.halves()[0].clone(), 2.0),
            WedgeKind::Body | WedgeKind::Massless => (wedge.clone(), 1.0),
        };
        let (rectangles, areas) = (part.rectangles(), part.face_areas());
        let frictions = [part.column_friction, part.slope_friction];
        [0, 1].map(|number| {
            let face = [&part.column_face, &part.slope_face][number].clone();
            let rectangle = &rectangles[number];
            let points = face.points(rectangle, &part.contact);
            Self {
                weights: face.grid.points().iter().map(|own| own.weight).collect(),
                area: areas[number],
                stiffness: points.iter().map(|own| own.stiffness).sum(),
                friction: face.friction(&frictions[number]).coefficient,
                count,
                lattice: Lattice::new(&face, rectangle),
                face,
            }
        })
    }

    /// Returns the places of its points on the wedge, up and across, m.
    pub(super) fn places(&self) -> &[[f64; 2]] {
        self.lattice.places()
    }

    /// Returns the mean depth (m) of the face by an energy (J) lost at all such faces.
    #[must_use]
    pub fn depth(&self, law: &WedgeLaw, energy: f64) -> f64 {
        law.volume(energy, self.friction) / (self.area * self.count)
    }

    /// Returns the depths (m) at the points, by their mean and the points' shares of the energy.
    fn depths<'p>(&'p self, mean: f64, shares: &'p [f64]) -> impl Iterator<Item = f64> + 'p {
        shares
            .iter()
            .zip(&self.weights)
            .map(move |(share, weight)| mean * share / weight)
    }

    /// Returns a growth of nothing.
    #[must_use]
    pub fn growth(&self) -> FaceGrowth {
        FaceGrowth {
            depths: vec![0.0; self.weights.len()],
            laid: self.lattice.empty(),
            force: 0.0,
        }
    }

    /// Returns faces that have lost nothing.
    #[must_use]
    pub fn unworn(&self) -> FaceMaps {
        FaceMaps {
            face: 0.0,
            counterface: 0.0,
            uneven: 0.0,
            depths: vec![0.0; self.weights.len()],
            laid: self.lattice.empty(),
        }
    }
}

/// What a run says of a face: where it wears, and how fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePace<'r> {
    /// Mean depth of the wedge's face, m.
    pub mean: f64,
    /// Mean normal force where it slides, N.
    pub force: f64,
    /// The points' shares of the energy.
    pub shares: &'r [f64],
    /// Displacements over the counterface up and across (m), with their shares.
    pub moved: &'r [[f64; 3]],
}

impl FaceGrowth {
    /// Adds what a run says; a counterface wears by a ratio of the face. Returns false, and adds nothing, if
    /// its points are others.
    #[must_use]
    pub fn add(&mut self, plan: &FacePlan, pace: &FacePace<'_>, ratio: f64) -> bool {
        if pace.shares.len() != self.depths.len() {
            return false;
        }
        self.force += pace.force * pace.mean;
        for (sum, own) in self.depths.iter_mut().zip(plan.depths(pace.mean, pace.shares)) {
            *sum += own;
        }
        if ratio > 0.0 {
            let volume = ratio * pace.mean * plan.area;
            for [up, across, weight] in pace.moved {
                for (point, share) in pace.shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
                    plan.lattice
                        .lay(&mut self.laid, point, [*up, *across], |own: &mut f64, part| {
                            *own += volume * weight * share * part;
                        });
                }
            }
        }
        true
    }

    fn mean(&self, plan: &FacePlan) -> f64 {
        self.depths
            .iter()
            .zip(&plan.weights)
            .map(|(own, weight)| own * weight)
            .sum()
    }
}

/// Returns `(1 - exp(-x))/x`.
fn evened(x: f64) -> f64 {
    if x < 1e-8 { 1.0 } else { -libm::expm1(-x) / x }
}

impl FaceMaps {
    /// Wears a face and its counterface by a step.
    pub fn grow(&mut self, plan: &FacePlan, step: &FaceGrowth) {
        let mean = step.mean(plan);
        if mean <= 0.0 {
            return;
        }
        let counterface = step.laid.total() / plan.lattice.area(&step.laid);
        let penetration = step.force / mean / plan.stiffness;
        let factor = evened((mean + counterface) / penetration);
        for (own, pace) in self.depths.iter_mut().zip(&step.depths) {
            *own += mean + factor * (pace - mean);
        }
        self.laid.add(&step.laid, |own| factor * own);
        self.uneven += factor * counterface;
        self.face += mean;
        self.counterface += counterface;
    }

    /// Returns the depth (m) that both partners have lost together in the mean.
    #[must_use]
    pub fn both(&self) -> f64 {
        self.face + self.counterface
    }

    /// Returns what the wedge's face and its counterface have lost beyond their means, over the maps that a
    /// case has: negative where they lost less.
    #[must_use]
    pub fn beyond(&self, plan: &FacePlan) -> [Option<DepthMap>; 2] {
        let before = plan.face.wedge_wear.as_ref();
        let points = plan.places().iter().zip(&self.depths).map(|([up, across], own)| {
            let before = before.map_or(0.0, |map| map.depth(*up, *across));
            [*up, *across, before + own - self.face]
        });
        let face = DepthMap::new(&points.collect::<Vec<_>>()).ok();
        let before = plan.face.counterface_wear.as_ref();
        let counterface = (self.counterface > 0.0)
            .then(|| plan.lattice.map(&self.laid, before))
            .flatten();
        let counterface = counterface.and_then(|map| {
            let points = map
                .points()
                .map(|[up, across, own]| [up, across, own - self.uneven]);
            DepthMap::new(&points.collect::<Vec<_>>()).ok()
        });
        [face, counterface]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use truck::Parameters;
    use wedge::parameters::Damping;

    /// A wedge's face with a made-up pace: shares that rise across.
    fn plan() -> (FacePlan, Vec<f64>) {
        let plan = FacePlan::of(&Parameters::new(Damping::Variable).wedges[0])[0].clone();
        let raw: Vec<f64> = plan
            .places()
            .iter()
            .map(|[up, across]| 1.0 + 4.0 * across + 2.0 * up)
            .collect();
        let weighed: Vec<f64> = raw
            .iter()
            .zip(&plan.weights)
            .map(|(own, weight)| own * weight)
            .collect();
        let sum: f64 = weighed.iter().sum();
        (plan, weighed.iter().map(|own| own / sum).collect())
    }

    fn step(
        plan: &FacePlan,
        shares: &[f64],
        (mean, force): (f64, f64),
        ratio: f64,
        moved: &[[f64; 3]],
    ) -> FaceGrowth {
        let mut growth = plan.growth();
        let pace = FacePace {
            mean,
            force,
            shares,
            moved,
        };
        assert!(growth.add(plan, &pace, ratio));
        growth
    }

    /// The closed form is the wear of points on springs that share a constant load, step by small step.
    #[test]
    fn analytic_a_step_is_the_wear_of_a_bed_of_springs() {
        let (plan, shares) = plan();
        let (mean, force) = (0.4e-3, 2e4);
        let mut maps = plan.unworn();
        maps.grow(&plan, &step(&plan, &shares, (mean, force), 0.0, &[]));
        // Loads of the points; each wears as its load by its area, and loses load as it is worn deeper than
        // the mean of all.
        let start: Vec<f64> = shares.iter().map(|own| own * force).collect();
        let count = 20_000;
        let mut depths = vec![0.0; shares.len()];
        for _ in 0..count {
            let deeper: f64 = depths
                .iter()
                .zip(&plan.weights)
                .map(|(own, weight)| own * weight)
                .sum();
            for (number, weight) in plan.weights.iter().enumerate() {
                let load = start[number] - plan.stiffness * weight * (depths[number] - deeper);
                depths[number] += mean / f64::from(count) * load / (force * weight);
            }
        }
        for (found, expected) in maps.depths.iter().zip(&depths) {
            assert!(
                (found - expected).abs() < 1e-4 * mean,
                "{:?} {depths:?}",
                maps.depths
            );
        }
    }

    /// Volumes of both partners are those that the laws give, short steps wear by the pace, long ones evenly.
    #[test]
    fn limits_volumes_stay_and_long_steps_are_even() {
        let (plan, shares) = plan();
        let moved = [[0.01, 0.0, 0.25], [-0.02, 0.001, 0.75]];
        for mean in [1e-9, 1e-4, 0.1] {
            let mut maps = plan.unworn();
            for _ in 0..3 {
                maps.grow(&plan, &step(&plan, &shares, (mean, 2e4), 0.5, &moved));
            }
            let sum = |of: &[f64]| {
                of.iter()
                    .zip(&plan.weights)
                    .map(|(own, weight)| own * weight)
                    .sum::<f64>()
            };
            assert!((sum(&maps.depths) / (3.0 * mean) - 1.0).abs() < 1e-12);
            let even = (maps.counterface - maps.uneven) * plan.lattice.area(&maps.laid);
            let volume = maps.laid.total() + even;
            assert!((volume / (1.5 * mean * plan.area) - 1.0).abs() < 1e-9, "{volume}");
            let first = maps.depths[0] / (3.0 * mean);
            let pace = shares[0] / plan.weights[0];
            let expected = if mean < 1e-6 { pace } else { 1.0 };
            let met = (first - expected).abs() < 1e-2;
            assert!(met || mean == 1e-4, "{mean} {first} {expected}");
            let [face, counterface] = maps.beyond(&plan);
            let depths = |map: DepthMap| map.points().map(|own| own[2].abs()).fold(0.0, f64::max);
            let (face, counterface) = (depths(face.unwrap()), depths(counterface.unwrap()));
            // However long the steps, no place stands out by much more than what the faces are pressed in.
            let pressed = 2e4 / plan.stiffness;
            assert!(
                face < 3.0 * pressed && counterface < 3.0 * pressed,
                "{face} {counterface} {pressed}"
            );
        }
    }

    /// Points of another grid are refused.
    #[test]
    fn input_other_points_are_not_added() {
        let (plan, _) = plan();
        let pace = FacePace {
            mean: 1e-4,
            force: 1e4,
            shares: &[1.0],
            moved: &[],
        };
        assert!(!plan.growth().add(&plan, &pace, 1.0));
    }
}
