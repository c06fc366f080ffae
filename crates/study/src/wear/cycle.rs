//! The work of the last whole cycle of a wedge's run at each contact point: the integrals that wear it.
//!
//! Integrals are taken over the steps of the integrator, by Gauss's rule with two points on its dense output;
//! so they do not depend on the times of the output table. The energies of the points are checked against the
//! energy ledger, whose losses the integrator itself integrates ([`CycleWork::mismatch`]).

use std::ops::ControlFlow;

use mechanics::contact::PointContact;
use mechanics::system::Observation;
use mechanics::vector::Vector;
use wedge::WEDGE;
use wedge::outputs::FACES;

use super::counterface::{Laid, Lattice};
use super::{WearError, WearStop};
use crate::case::Case;
use crate::metrics::Cycle;
use crate::run::Run;
use crate::run::wedge_run::friction_losses;
use crate::summary::RunSummary;

/// The work of one cycle at a contact point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointWork {
    /// ∫ N |v| dt, J.
    pub load_times_path: f64,
    /// ∫ |v| dt while it is closed, m.
    pub path: f64,
    /// ∫ N dt, N·s.
    pub impulse: f64,
    /// Energy lost in friction, J.
    pub energy: f64,
}

impl PointWork {
    /// Adds a share of another.
    pub(super) fn add(&mut self, other: &Self, share: f64) {
        self.load_times_path += share * other.load_times_path;
        self.path += share * other.path;
        self.impulse += share * other.impulse;
        self.energy += share * other.energy;
    }
}

/// The work of one cycle on a wedge.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleWork {
    /// The points of each face, in the order of its grid.
    pub points: [Vec<PointWork>; FACES.len()],
    /// The work of the points on their counterfaces, by place; nothing where that is not asked for.
    pub counterfaces: Option<[Laid<PointWork>; FACES.len()]>,
    /// Energy lost in friction at each face by the ledger, J.
    pub losses: [f64; FACES.len()],
    /// Mean height of the wedge above its nominal position, m.
    pub height: f64,
    /// Length of the cycle, s.
    pub period: f64,
}

impl CycleWork {
    /// Returns the mean normal force of a face, N.
    #[must_use]
    pub fn mean_force(&self, face: usize) -> f64 {
        self.points[face].iter().map(|point| point.impulse).sum::<f64>() / self.period
    }

    /// Returns the difference of the points' energies from the losses of the ledger, relative to these.
    #[must_use]
    pub fn mismatch(&self) -> f64 {
        let points = self
            .points
            .iter()
            .flatten()
            .map(|point| point.energy)
            .sum::<f64>();
        let ledger: f64 = self.losses.iter().sum();
        if ledger > 0.0 {
            (points - ledger).abs() / ledger
        } else {
            0.0
        }
    }

    /// Runs a case and returns what its last whole cycle does, with lattices to the counterfaces too. `go_on`
    /// is asked after each step, with the time reached.
    ///
    /// # Errors
    /// The bolster has no whole cycle, or the run cannot begin, stops or fails.
    pub fn of(
        case: &Case,
        lattices: Option<&[Lattice; FACES.len()]>,
        go_on: &mut dyn FnMut(f64) -> ControlFlow<String>,
    ) -> Result<Self, WearStop> {
        let cycle = Cycle::of(&case.parameters).ok_or(WearError::NoCycle)?;
        let window = cycle.window(case.simulation.duration);
        let (_, end, _) = window.ok_or(WearError::NoCycle)?;
        let start = end - cycle.period();
        let mut run = Run::new(case).map_err(WearError::Run)?;
        let count = |face: usize| run.system.faces()[face].element.points.len();
        let mut work = Self {
            points: [0, 1].map(|face| vec![PointWork::default(); count(face)]),
            counterfaces: lattices.map(|own| own.each_ref().map(Lattice::empty)),
            losses: [0.0; 2],
            height: 0.0,
            period: end - start,
        };
        let mut x = vec![0.0; run.integrator.x().len()];
        while !run.is_finished() {
            run.advance().map_err(WearError::Run)?;
            let (before, after) = (run.integrator.previous_time(), run.integrator.time());
            for (time, sign) in [(start, -1.0), (end, 1.0)] {
                if before < time && time <= after {
                    run.integrator.interpolate(time, &mut x);
                    let losses = friction_losses(&run.system, &x);
                    for (sum, loss) in work.losses.iter_mut().zip(losses) {
                        *sum += sign * loss;
                    }
                }
            }
            let (from, to) = (before.max(start), after.min(end));
            if from < to {
                // By place a step may be long: it must not leap over nodes of the lattices.
                let count = match lattices {
                    Some(_) => (PIECES * (to - from) / work.period).ceil(),
                    None => 1.0,
                };
                let piece = (to - from) / count;
                for number in 0..count as usize {
                    for place in GAUSS {
                        let time = from + (number as f64 + place) * piece;
                        run.integrator.interpolate(time, &mut x);
                        let seen = run.system.observe(time, &x);
                        work.add(&seen, 0.5 * piece);
                        if let Some(lattices) = lattices {
                            work.lay(&seen, lattices, 0.5 * piece);
                        }
                    }
                }
            }
            if let ControlFlow::Break(reason) = go_on(after) {
                return Err(WearStop::Interrupted(reason));
            }
        }
        let summary = run.result(None).summary;
        if let Some(reason) = summary.failed() {
            return Err(WearError::Failed(reason.to_owned()).into());
        }
        Ok(work)
    }

    /// Adds what happens at an instant over a time (s).
    fn add(&mut self, seen: &Observation, duration: f64) {
        self.height += seen.bodies[WEDGE].coordinates[2] * duration / self.period;
        for (points, face) in self.points.iter_mut().zip(&seen.faces) {
            for (work, point) in points.iter_mut().zip(&face.points) {
                work.add(&of_point(point), duration);
            }
        }
    }

    /// Lays what happens at an instant over a time (s) down on the counterfaces.
    fn lay(&mut self, seen: &Observation, lattices: &[Lattice; FACES.len()], duration: f64) {
        let Some(counterfaces) = &mut self.counterfaces else {
            return;
        };
        for (number, laid) in counterfaces.iter_mut().enumerate() {
            let (lattice, points) = (&lattices[number], &seen.faces[number].points);
            for (place, ([up, side], point)) in lattice.places().iter().zip(points).enumerate() {
                if point.normal <= 0.0 {
                    continue;
                }
                let Vector([_, across, along]) = point.position;
                let moved = [UPWARDS[number] * along - up, across - side];
                let mut work = PointWork::default();
                work.add(&of_point(point), duration);
                lattice.lay(laid, place, moved, |own, share| own.add(&work, share));
            }
        }
    }
}

/// The sign of the marker's axis z up each face: that of the slope points down.
const UPWARDS: [f64; FACES.len()] = [1.0, -1.0];

/// Returns the work of a point in a time of 1 s.
fn of_point(point: &PointContact<f64>) -> PointWork {
    let [a, b] = point.slip;
    let speed = (a * a + b * b).sqrt();
    PointWork {
        load_times_path: point.normal * speed,
        path: if point.normal > 0.0 { speed } else { 0.0 },
        impulse: point.normal,
        energy: point.friction.loss,
    }
}

/// Pieces of a cycle at least, where it matters what happens at which place.
const PIECES: f64 = 400.0;

/// The places of Gauss's rule with two points in an interval of length 1.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
