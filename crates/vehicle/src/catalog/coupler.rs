//! Couplers with a given force at the end of a car on a track: see [`car::Coupler`].
//!
//! Where a vehicle comes to rest before its start they do not act.

use std::sync::Arc;

use car::{Coupler as Law, CouplerForce, CouplerPlace, Course};
use mechanics::element::Placement;
use mechanics::link::Marker;
use mechanics::motion::Motion;
use mechanics::vector::Vector;
use quantity::Kind;

use super::{CatalogElement, Place};
use crate::drawing::Drawn;

/// A coupler with a given force on body A.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupler {
    /// Force and direction.
    pub force: CouplerForce,
    /// From the pivot to the pulling face, m.
    pub length: f64,
    /// From one truck center of the car to the other, m.
    pub truck_distance: f64,
    /// The middle between the truck centers along the nominal layout, m.
    pub middle: f64,
    /// True where the vehicle comes to rest.
    pub resting: bool,
}

impl CatalogElement for Coupler {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let Some(lines) = place.lines.cloned() else {
            return Err("couplers with given forces are for vehicles on a track; take a force".to_owned());
        };
        let [x, _, height] = place.ends[0].1;
        if x == self.middle {
            return Err("its pivot is in the middle of the car: give the place of the pivot".to_owned());
        }
        if self.resting {
            return Ok(());
        }
        let (course, factor) = match &self.force.course {
            Course::Time(factor) => (None, factor.clone()),
            Course::Distance(course) => (Some(course.clone()), Motion::Constant(1.0)),
        };
        let law = Law {
            name: place.name.to_owned(),
            lines,
            place: CouplerPlace {
                pivot: x - self.middle,
                height,
                length: self.length,
                truck_distance: self.truck_distance,
            },
            direction: self.force.direction,
            course,
        };
        let ends = [place.marker(0, [0.0; 3]), (0, Marker::new([0.0; 3], [0.0; 3]))];
        let number = place.model.elements.len();
        let own = law.clone();
        place.channel(
            "force",
            Kind::Force,
            "along its line, positive in buff",
            move |view| {
                let line = own.line::<f64>(&view.relative(ends[0], ends[1]));
                -view.seen.elements[number].force.dot::<f64, f64>(line.toward)
            },
        );
        let text = "on end A, to the left of its body";
        place.channel("lateral_force", Kind::Force, text, move |view| {
            let left: Vector<f64> = view.relative(ends[0], ends[1]).rotation.column(1);
            view.seen.elements[number].force.dot(left)
        });
        let own = law.clone();
        let text = "to its body, positive where it points to the left of the car";
        place.channel("angle", Kind::Angle, text, move |view| {
            let motion = view.relative(ends[0], ends[1]);
            let toward = own.line::<f64>(&motion).toward;
            let [forward, left] = [0, 1].map(|k| motion.rotation.column(k).dot::<f64, f64>(toward));
            libm::atan2(left, forward * own.place.pivot.signum())
        });
        let placed = Placement::new(law, ends[0], ends[1]).over_time(factor);
        place.model.elements.push(placed);
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
