//! A force over distance on a body.
//!
//! `F = f(s)` along one axis at end A, piecewise linear, constant beyond the ends of its table. On a track s
//! is the distance of end A along the center line, in plan, and the axis is that of the track there: forward,
//! to the left, up; elsewhere s is the way of end A along the fixed x axis from the nominal layout, and the
//! axis is a fixed one. What it does to the body is work from outside, in the ledger's element work. Units:
//! N, m.
//!
//! Where a vehicle on a track comes to rest before its start it does not act: it begins at the start, where
//! its table should be zero. Limits: the end turns with the body, so that a long arm changes the moment.

use std::sync::Arc;

use mechanics::curve::Curve;
use mechanics::element::{Element as Law, Wrench};
use mechanics::link::{Marker, RelativeMotion};
use mechanics::vector::Vector;
use numerics::scalar::Real;
use quantity::Kind;
use wheelrail::track::{Line, RailLines};

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A force over the distance of end A.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceOverDistance {
    /// The axis along which it acts: 0 forward, 1 to the left, 2 up.
    pub axis: usize,
    /// Force (N) over distance (m).
    pub course: Curve,
    /// True where the vehicle comes to rest.
    resting: bool,
}

impl ForceOverDistance {
    /// Returns a force along an axis (0 forward, 1 to the left, 2 up) by points of distance (m, rising) and
    /// force (N), constant before and behind them.
    #[must_use]
    pub fn new(axis: usize, points: &[[f64; 2]]) -> Option<Self> {
        let (&[from, first], &[to, last]) = (points.first()?, points.last()?);
        let mut all = vec![[from - 1.0, first]];
        all.extend(points);
        all.push([to + 1.0, last]);
        Some(Self {
            axis,
            course: Curve::new(all).ok()?,
            resting: false,
        })
    }
}

/// The force as an element between end A and the origin of the fixed axes.
#[derive(Clone, Debug)]
struct Pushed {
    name: String,
    axis: usize,
    course: Curve,
    lines: Option<Arc<RailLines>>,
    /// Place of end A along x in the nominal layout, m.
    from: f64,
}

impl Pushed {
    /// Returns the force, and its direction.
    fn force<S: Real>(&self, motion: &RelativeMotion<S>) -> (S, [S; 3]) {
        let mut along = [S::zero(); 3];
        along[self.axis] = S::from(1.0);
        match &self.lines {
            None => (self.course.evaluate(motion.position.0[0] - self.from), along),
            Some(lines) => {
                let section = lines.section(Line::Center, motion.position.0);
                (self.course.evaluate(section.distance), section.fixed(along))
            }
        }
    }
}

impl Law for Pushed {
    fn name(&self) -> &str {
        &self.name
    }

    fn does_work(&self) -> bool {
        true
    }

    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let (force, along) = self.force(motion);
        let force = Vector(along.map(|own| own * force));
        Wrench {
            force,
            moment: Vector::zero(),
            powers: [S::zero(), force.dot(motion.velocity)],
        }
    }

    fn energy(&self, _: &RelativeMotion<f64>) -> f64 {
        0.0
    }
}

impl CatalogElement for ForceOverDistance {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let ends = [place.marker(0, [0.0; 3]), (0, Marker::new([0.0; 3], [0.0; 3]))];
        let law = Pushed {
            name: place.name.to_owned(),
            axis: self.axis,
            course: self.course.clone(),
            lines: place.lines.cloned(),
            from: place.ends[0].1[0],
        };
        let seen = law.clone();
        let text = "force on end A, positive forward, to the left, up";
        place.channel("force", Kind::Force, text, move |view| {
            seen.force::<f64>(&view.relative(ends[0], ends[1])).0
        });
        if !(self.resting && place.lines.is_some()) {
            place.element(law, ends[0], ends[1]);
        }
        Ok(())
    }

    fn at_rest(&self) -> Option<Arc<dyn CatalogElement>> {
        Some(Arc::new(Self {
            resting: true,
            ..self.clone()
        }))
    }

    fn drawn(&self) -> Drawn {
        Drawn::Nothing
    }
}
