//! What statistics are taken of: wheels, axles, trucks and bodies of a vehicle, and the names of their
//! columns.

use serde::{Deserialize, Serialize};

use super::SIDES;

/// What a statistic is taken of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Of {
    /// A wheel.
    Wheel,
    /// An axle.
    Axle,
    /// A truck, its side or one of its parts.
    Truck,
    /// A body.
    #[default]
    Body,
}

/// An axle.
#[derive(Clone, Debug, PartialEq)]
pub struct AxlePart {
    /// The beginning of the names of its columns: `axle_1`.
    pub name: String,
    /// Static loads of its wheels, left and right, N; zero: not known.
    pub loads: [f64; 2],
    /// Its place before that of the column of the distance, m.
    pub place: f64,
}

/// A truck.
#[derive(Clone, Debug, PartialEq)]
pub struct TruckPart {
    /// Its name: `truck_1`.
    pub name: String,
    /// Its axles, from 0.
    pub axles: Vec<usize>,
}

/// A place with accelerometers, or a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacePart {
    /// The beginning of the names of its columns: `body_at_truck_1`.
    pub name: String,
    /// In words.
    pub words: String,
}

/// The parts of a vehicle that statistics are taken of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// The column of the distance along the track.
    pub distance: String,
    /// The column of the speed along the track.
    pub speed: String,
    /// What ends the names of the columns of vertical and lateral forces of wheels: nothing, or `_force`.
    pub force: &'static str,
    /// The axles.
    pub axles: Vec<AxlePart>,
    /// The trucks.
    pub trucks: Vec<TruckPart>,
    /// The bodies whose roll counts.
    pub bodies: Vec<PlacePart>,
    /// Accelerometers on bodies, lateral and vertical.
    pub on_bodies: Vec<PlacePart>,
    /// Accelerometers on parts of trucks, lateral.
    pub on_trucks: Vec<PlacePart>,
}

/// Directions of accelerometers on bodies, in columns.
const DIRECTIONS: [&str; 2] = ["lateral", "vertical"];

/// Returns a name in words: `axle_1` is axle 1.
#[must_use]
pub(crate) fn in_words(name: &str) -> String {
    name.replace('_', " ")
}

impl PlacePart {
    /// Returns the part of this name, whose words it makes.
    #[must_use]
    pub fn named(name: impl Into<String>) -> Self {
        let name = name.into();
        Self {
            words: in_words(&name),
            name,
        }
    }
}

impl Parts {
    /// Returns the columns of a force of a wheel: `vertical` or `lateral`.
    pub(crate) fn force_of(&self, axle: usize, side: usize, what: &str) -> String {
        let name = self.axles.get(axle).map_or("", |own| &own.name);
        format!("{name}_{}_{what}{}", SIDES[side], self.force)
    }

    /// The forces of wheels on rails.
    pub(crate) fn wheel_forces(&self) -> Vec<String> {
        let wheels = (0..self.axles.len()).flat_map(|axle| [(axle, 0), (axle, 1)]);
        let forces = wheels.flat_map(|wheel| ["vertical", "lateral"].map(|what| (wheel, what)));
        forces
            .map(|((axle, side), what)| self.force_of(axle, side, what))
            .collect()
    }

    /// The accelerations of bodies.
    pub(crate) fn accelerations(&self) -> Vec<String> {
        let all = self.on_bodies.iter();
        let each =
            all.flat_map(|own| DIRECTIONS.map(|direction| format!("{}_{direction}_acceleration", own.name)));
        each.collect()
    }

    /// Returns whether statistics need all rows of a column.
    #[must_use]
    pub fn need(&self, name: &str) -> bool {
        let of = |own: &str, endings: &[String]| {
            let rest = name.strip_prefix(own).and_then(|rest| rest.strip_prefix('_'));
            rest.is_some_and(|rest| endings.iter().any(|ending| ending == rest))
        };
        let sides = |what: &str| SIDES.map(|side| format!("{side}_{what}"));
        let of_wheels = [
            sides(&format!("vertical{}", self.force)),
            sides(&format!("lateral{}", self.force)),
            sides("lift"),
            sides("rail_roll"),
        ];
        let of_axles = [
            of_wheels.concat(),
            ["yaw", "gauge_widening"].map(str::to_owned).to_vec(),
        ]
        .concat();
        let accelerations = DIRECTIONS.map(|direction| format!("{direction}_acceleration"));
        name == self.distance
            || name == self.speed
            || self.axles.iter().any(|own| of(&own.name, &of_axles))
            || self.bodies.iter().any(|own| of(&own.name, &["roll".to_owned()]))
            || self.on_bodies.iter().any(|own| of(&own.name, &accelerations))
            || self
                .on_trucks
                .iter()
                .any(|own| of(&own.name, &accelerations[..1]))
    }
}
