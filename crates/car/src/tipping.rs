//! Cars that tip: the reason why there is no equilibrium, in numbers.

use std::cmp::Ordering;
use std::fmt;

use mechanics::orientation::fixed;
use mechanics::system::{NoEquilibrium, System};
use mechanics::vector::Matrix;
use quantity::INCH;

use crate::error::BuildError;
use crate::parameters::Parameters;

/// A search for rest whose body has turned over by more than this has tipped: the cosine of 20 deg, several
/// times the roll at which all coils of a side are solid.
const UPRIGHT: f64 = 0.94;

/// A car that tips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tipping {
    /// Center of gravity of body and lading: forward, to the left, above the top of rail, m.
    pub center: [f64; 3],
    /// The supports beyond which the center of gravity lies or comes.
    pub over: Support,
    /// Distance of these supports from the middle, m.
    pub distance: f64,
    /// Roll at which the coils of one side are solid and those of the other are free, rad: none if the car
    /// tips without leaning, or where coils do not go solid.
    pub lean: Option<f64>,
    /// How far the center of gravity, leaning so, lies outside of the supports, m: negative if inside.
    pub outside: f64,
}

/// What a body turns over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// Side bearings.
    SideBearings,
    /// The center plates of the trucks.
    Trucks,
}

impl Parameters {
    /// Returns the smallest distance of the side bearings from the middle, m.
    #[must_use]
    pub fn side_bearing_distance(&self) -> f64 {
        let bodies = self.trucks.iter().filter_map(|own| own.car_body.as_ref());
        let distances = bodies.map(|own| own.side_bearings.distance);
        distances.fold(f64::INFINITY, f64::min)
    }

    /// Returns how the car tips with its center of gravity outside of the trucks or of the side bearings;
    /// none if it lies between them.
    #[must_use]
    pub fn tips_over(&self) -> Option<Tipping> {
        let center = self.center_of_gravity();
        let [forward, left, _] = center;
        let ends = (Support::Trucks, forward.abs(), 0.5 * self.truck_distance);
        let sides = (Support::SideBearings, left.abs(), self.side_bearing_distance());
        let (over, place, distance) = [ends, sides]
            .into_iter()
            .find(|(_, place, distance)| place >= distance)?;
        Some(Tipping {
            center,
            over,
            distance,
            lean: None,
            outside: place - distance,
        })
    }

    /// Returns how a car with its center of gravity between the side bearings leans over them.
    pub(crate) fn leans_over(&self) -> Tipping {
        let center = self.center_of_gravity();
        let distance = self.side_bearing_distance();
        let lean = self.largest_lean();
        let pivot = self.trucks[0].bolster.body.height;
        let arm = (center[2] - pivot).max(0.0);
        let leaning = center[1].abs() + arm * libm::sin(lean.unwrap_or(0.0));
        Tipping {
            center,
            over: Support::SideBearings,
            distance,
            lean,
            outside: leaning - distance,
        }
    }

    /// Returns the roll at which the load coils of one side are solid and those of the other are free, rad.
    fn largest_lean(&self) -> Option<f64> {
        let of_truck = |own: &truck::Parameters| {
            let coils = || own.load_coils.iter().flatten();
            let solid = coils().filter_map(|coil| coil.spring.solid.map(|solid| solid[0]));
            let solid = solid.fold(f64::INFINITY, f64::min);
            let free = coils().map(|coil| coil.spring.preload / coil.spring.stiffness);
            let lean = libm::atan((solid + free.fold(0.0, f64::max)) / own.geometry.nest_distance);
            solid.is_finite().then_some(lean)
        };
        let leans = self.trucks.iter().filter_map(of_truck);
        leans.max_by(f64::total_cmp)
    }

    /// Returns why there is no equilibrium.
    pub(crate) fn no_equilibrium(
        &self,
        system: &mut System,
        body: usize,
        error: NoEquilibrium,
    ) -> BuildError {
        match has_tipped(system, body, &error.nearest) || has_tipped(system, body, &error.last) {
            true => BuildError::Tips(self.leans_over()),
            false => BuildError::Equilibrium(error),
        }
    }
}

/// Returns whether the body of a car with this number has turned over in a state.
pub(crate) fn has_tipped(system: &mut System, body: usize, x: &[f64]) -> bool {
    let seen = system.observe(0.0, x);
    let nominal: Matrix<f64> = fixed(system.bodies()[body].frame.orientation);
    let rotation: Matrix<f64> = seen.bodies[body].rotation.times(nominal.transpose());
    // A direction that is no number is not upright either.
    rotation.column(2).0[2].total_cmp(&UPRIGHT) != Ordering::Greater
}

/// A length, m and in.
struct Length(f64);

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3} m ({:.1} in)", self.0, self.0 / INCH)
    }
}

impl fmt::Display for Tipping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [forward, left, up] = self.center;
        let side = if left >= 0.0 { "left" } else { "right" };
        let end = if forward >= 0.0 { "front" } else { "rear" };
        let outside = Length(self.outside.abs());
        let (distance, height) = (Length(self.distance), Length(up));
        if self.over == Support::Trucks {
            return write!(
                f,
                "the car tips over its {end} truck: the center of gravity of body and lading lies {outside} \
                 outside the truck centers, which are {distance} from the middle; move the lading between \
                 the trucks"
            );
        }
        let Some(lean) = self.lean else {
            return write!(
                f,
                "the car tips to the {side}: the center of gravity of body and lading, {height} above the \
                 rails, lies {outside} outside the side bearings, which are {distance} from the middle; move \
                 the lading towards the middle, or lower it"
            );
        };
        write!(
            f,
            "the car tips to the {side}: the center of gravity of body and lading is {} to the {side} of the \
             middle and {height} above the rails; leaning by {:.1} deg, where the coils of one side are \
             solid, it lies {outside} {} the side bearings, which are {distance} from the middle{}; lower \
             the lading, or move it towards the middle",
            Length(left.abs()),
            lean.to_degrees(),
            if self.outside >= 0.0 { "outside" } else { "inside" },
            if self.outside >= 0.0 {
                ""
            } else {
                ", too little for the give of rails, adapters and plates"
            }
        )
    }
}
