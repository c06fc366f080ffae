//! A truck in a model, with what its loads need.

use mechanics::curve::Curve;
use mechanics::orientation::fixed;
use mechanics::system::{BodyState, Observation};
use mechanics::vector::{Matrix, Vector};
use wedge::parameters::Damping;

use crate::PLACES;
use crate::assemble::{BOLSTER, NUMBERS};
use crate::elements::{Added, Mount};
use crate::parameters::{Parameters, Wedge};

/// A truck in a model: which elements there are its own.
#[derive(Clone, Debug)]
pub struct MountedTruck {
    pub(crate) mount: Mount,
    pub(crate) added: Added,
    /// From the axes of the truck to those of each body in its nominal place.
    pub(crate) axes: [Matrix<f64>; NUMBERS],
    /// Height of the center plate, m.
    pub(crate) plate_height: f64,
    /// The moment of each nest's empirical warp spring, N·m by rad.
    pub(crate) warp_spring: Option<Curve>,
    pub(crate) axle: f64,
    /// Nominal places of the wedges' centers of gravity from the truck's center, m.
    pub(crate) wedge_places: [Vector<f64>; 4],
    /// Distances of the centers of gravity of their halves outboard and inboard of them, m.
    pub(crate) half_shifts: [f64; 4],
    /// Those of the bolster, the left and the right side frame.
    pub(crate) part_places: [Vector<f64>; 3],
    /// Toe of the wedges' columns, rad.
    pub(crate) toes: [f64; 4],
    /// Angles of the wedges, rad.
    pub(crate) angles: [f64; 4],
    /// The place of the control coils.
    pub(crate) damping: Damping,
}

/// The axes in which the loads of a truck are given: origin (m) at the truck's center at the top
/// of rail, and the rotation from axes forward, left, up to fixed axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruckFrame {
    /// Origin, m.
    pub origin: Vector<f64>,
    /// Axes forward, left, up, as columns.
    pub axes: Matrix<f64>,
}

impl MountedTruck {
    pub(crate) fn new(
        parameters: &Parameters,
        mount: Mount,
        added: Added,
        axes: [Matrix<f64>; NUMBERS],
    ) -> Self {
        let car = parameters.car_body.as_ref();
        Self {
            mount,
            added,
            axes,
            plate_height: car.map_or(0.0, |car| car.center_plate.height),
            warp_spring: parameters.warp_spring.clone(),
            axle: parameters.geometry.axle(),
            half_shifts: parameters.wedges.each_ref().map(Wedge::half_shift),
            toes: parameters.wedges.each_ref().map(|wedge| wedge.toe),
            angles: parameters.wedges.each_ref().map(|wedge| wedge.angle),
            damping: parameters.damping,
            part_places: {
                let side = parameters.geometry.nest();
                let [left, right] = parameters.side_frames.each_ref().map(|own| own.body.height);
                let bolster = parameters.bolster.body.height;
                [[0.0, 0.0, bolster], [0.0, side, left], [0.0, -side, right]].map(Vector)
            },
            wedge_places: PLACES.map(|place| Vector(parameters.geometry.wedge(place))),
        }
    }

    /// Returns a truck that stands alone, at the origin.
    pub(crate) fn alone(parameters: &Parameters, mount: Mount, added: Added) -> Self {
        Self::new(parameters, mount, added, [fixed([0.0; 3]); NUMBERS])
    }
}

/// An observation in the axes of a truck.
pub(crate) struct TruckView<'o> {
    pub seen: &'o Observation,
    truck: &'o MountedTruck,
    frame: Option<TruckFrame>,
}

impl<'o> TruckView<'o> {
    pub fn new(truck: &'o MountedTruck, seen: &'o Observation, frame: Option<TruckFrame>) -> Self {
        Self { seen, truck, frame }
    }

    /// Returns the state of a body by its number in the truck.
    pub fn body(&self, number: usize) -> &BodyState {
        &self.seen.bodies[self.truck.mount.bodies[number]]
    }

    /// Returns a vector in the truck's axes.
    pub fn vector(&self, vector: Vector<f64>) -> Vector<f64> {
        match &self.frame {
            None => vector,
            Some(frame) => frame.axes.apply_transposed(vector),
        }
    }

    /// Returns a place in the truck's axes, from its center.
    pub fn place(&self, place: Vector<f64>) -> Vector<f64> {
        match &self.frame {
            None => place,
            Some(frame) => frame.axes.apply_transposed(place - frame.origin),
        }
    }

    /// Returns the rotation of a body from its nominal place, in the truck's axes.
    pub fn rotation(&self, number: usize) -> Matrix<f64> {
        let rotation = self.body(number).rotation;
        match &self.frame {
            None => rotation,
            Some(frame) => {
                let turned: Matrix<f64> = frame.axes.transpose().times(rotation);
                turned.times(self.truck.axes[number].transpose())
            }
        }
    }

    /// Returns the displacement of a point that is fixed to the bolster or to a side frame (by its number)
    /// from its nominal place (from the truck's center, m), in the truck's axes, m.
    pub fn carried(&self, number: usize, place: Vector<f64>) -> Vector<f64> {
        let nominal = self.truck.part_places[number - BOLSTER];
        let turned: Vector<f64> = self.rotation(number).apply(place - nominal);
        self.place(self.body(number).center_of_gravity) + turned - place
    }

    /// Returns the yaw of a body, rad.
    pub fn yaw(&self, number: usize) -> f64 {
        let Matrix(r) = self.rotation(number);
        libm::atan2(r[1][0], r[0][0])
    }

    /// Returns roll, pitch, yaw of a body, rad.
    pub fn angles(&self, number: usize) -> [f64; 3] {
        match &self.frame {
            None => [3, 4, 5].map(|k| self.body(number).coordinates[k]),
            Some(_) => {
                let Matrix(r) = self.rotation(number);
                [
                    libm::atan2(-r[1][2], r[1][1]),
                    libm::atan2(-r[2][0], r[0][0]),
                    libm::asin(r[1][0]),
                ]
            }
        }
    }
}
