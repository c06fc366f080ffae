//! The columns of a car's results.

use std::sync::Arc;

use car::{BuildError, Car, Derailment, Loads, Parameters, Wheels};
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, Observation, System};
use quantity::Kind;
use truck::{HALVES, WEDGE_NAMES, WedgeKind, WedgeLoads};
use wheelrail::profile::SlicedProfile;
use wheelrail::track::Track;

use super::derailment;
use super::statistics::{SIDES, ratio};
use crate::truck::columns::{RISE, of_halves};

/// The table of a car's results, for any observation of its system.
pub struct CarTable {
    car: Car,
    columns: Columns,
    static_loads: [[f64; 2]; 4],
    track: Track,
    /// Rails whose sections change along the track.
    over: [Option<Arc<SlicedProfile>>; 2],
    /// Heights of the axles at the start, m.
    heights: [f64; 4],
    wedges_at_start: [[WedgeLoads; 4]; 2],
}

impl CarTable {
    /// Returns the table of a car with these parameters.
    ///
    /// # Errors
    /// They make no car, or there is no equilibrium to start from.
    pub fn new(parameters: &Parameters) -> Result<Self, BuildError> {
        let car = Car::new(parameters)?;
        let static_loads = derailment::static_loads(parameters);
        let columns = Columns::new(&car, &parameters.trucks, static_loads);
        let x = &car.initial_state;
        let seen = car.system.clone().observe(0.0, x);
        let loads = car.loads(&seen, &vec![0.0; x.len()]);
        Ok(Self {
            heights: loads.axles.map(|axle| axle.height),
            wedges_at_start: loads.trucks.map(|truck| truck.wedges),
            track: parameters.track.clone(),
            over: match &parameters.wheels {
                Wheels::OnRails(own) => own.rails_over.clone(),
                Wheels::Linear { .. } => [None, None],
            },
            car,
            columns,
            static_loads,
        })
    }

    /// Returns the car.
    #[must_use]
    pub fn car(&self) -> &Car {
        &self.car
    }

    /// Returns the wedges of both trucks at the start.
    #[must_use]
    pub fn wedges_at_start(&self) -> &[[WedgeLoads; 4]; 2] {
        &self.wedges_at_start
    }

    /// Returns the columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns.columns
    }

    /// Returns the number of columns at the beginning with fixed names: all up to the wedges.
    #[must_use]
    pub fn fixed(&self) -> usize {
        self.columns.fixed
    }

    /// Returns the static loads of the wheels by axle, left and right, N.
    #[must_use]
    pub fn static_loads(&self) -> [[f64; 2]; 4] {
        self.static_loads
    }

    /// Appends the values of all columns (SI) at an observation, of whose state these are the rates;
    /// `start_energy` (J) is the stored energy at the start. Returns the loads.
    pub fn read(
        &self,
        observation: &Observation,
        rates: &[f64],
        start_energy: f64,
        out: &mut Vec<f64>,
    ) -> Loads {
        let loads = self.car.loads(observation, rates);
        let seen = Seen {
            observation,
            loads: &loads,
            start_energy,
        };
        out.extend(self.columns.values.iter().map(|value| value(&seen)));
        loads
    }
}

impl CarTable {
    /// Returns the first wheel from the front that has left its rail.
    pub(super) fn left(&self, loads: &Loads) -> Option<Derailment> {
        let over = self.over.each_ref().map(Option::as_deref);
        Derailment::of(loads, &self.track, over, self.heights)
    }

    /// Returns in words which wheel has left its rail at an observation, if one has.
    #[must_use]
    pub fn derailed(&self, observation: &Observation) -> Option<String> {
        // Places of axles need no rates.
        let rates = vec![0.0; self.car.initial_state.len()];
        let left = self.left(&self.car.loads(observation, &rates))?;
        Some(left.words(&format!("{:.1} m", left.distance)))
    }
}

/// The source of values: an observation, its loads, and the stored energy at the start, J.
struct Seen<'s> {
    observation: &'s Observation,
    loads: &'s Loads,
    start_energy: f64,
}

type Value = Box<dyn Fn(&Seen<'_>) -> f64 + Send + Sync>;

/// The table: what its columns are, and how their values are taken.
struct Columns {
    columns: Vec<Column>,
    /// Number of columns at the beginning with fixed names.
    fixed: usize,
    values: Vec<Value>,
}

/// Axes that signs refer to, by what a column is about.
const TRACK: &str = "of the track: forward, left, up";
const BODY: &str = "of the car body: left, up";
const TRUCK: &str = "of the truck: x forward, y left, z up";

impl Columns {
    /// Returns the columns of a car on these trucks; static loads of the wheels are by axle, left and right,
    /// N.
    fn new(car: &Car, trucks: &[truck::Parameters; 2], static_loads: [[f64; 2]; 4]) -> Self {
        let mut own = Self {
            columns: Vec::new(),
            fixed: 0,
            values: Vec::new(),
        };
        own.add("time", Kind::Time, "", "time", |seen| seen.observation.time);
        let text = "of the center of gravity of body and lading along the track, in plan";
        own.add("distance", Kind::Distance, TRACK, text, |seen| {
            seen.loads.distance
        });
        own.add(
            "speed",
            Kind::TravelSpeed,
            TRACK,
            "of the car body along the track",
            |seen| seen.loads.speed,
        );
        own.axles(static_loads);
        own.add(
            "body_roll",
            Kind::Angle,
            TRACK,
            "of the car body against the track, left side up",
            |seen| seen.loads.body_angles[0],
        );
        for end in 0..2 {
            for (k, direction) in ["lateral", "vertical"].into_iter().enumerate() {
                let name = format!("body_at_truck_{}_{direction}_acceleration", end + 1);
                let text = [
                    "of the car body over the truck's center, at car.accelerometer_height (that of the \
                     center plate, about 30 in above the rails, if left out), as an accelerometer shows it \
                     along the body's left: with gravity's part by roll and superelevation",
                    "of the car body over the truck's center, at car.accelerometer_height (that of the \
                     center plate, about 30 in above the rails, if left out), as an accelerometer shows it \
                     along the body's up, less gravity",
                ][k];
                own.add(name, Kind::RideAcceleration, BODY, text, move |seen| {
                    let own = &seen.loads.ends[end];
                    [own.lateral_acceleration, own.vertical_acceleration][k]
                });
            }
        }
        for truck in 0..2 {
            let text = "mean yaw of the side frames less that of the bolster";
            own.add(
                format!("truck_{}_warp_angle", truck + 1),
                Kind::Angle,
                TRUCK,
                text,
                move |seen| seen.loads.trucks[truck].warp_angle,
            );
        }
        for truck in 0..2 {
            own.truck(truck);
        }
        own.fixed = own.columns.len();
        for (truck, parameters) in trucks.iter().enumerate() {
            own.more_of_truck(truck);
            for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
                let name = format!("truck_{}_{name}_rise", truck + 1);
                own.add(name, Kind::Length, TRUCK, RISE, move |seen| {
                    seen.loads.trucks[truck].wedges[number].rise
                });
            }
            for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
                if parameters.wedges[number].kind == WedgeKind::Split {
                    own.halves(truck, number, name);
                }
            }
        }
        own.wear();
        own.losses_of_wedges(&car.system);
        own.energies(&car.system);
        own
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        frame: &'static str,
        text: &str,
        value: impl Fn(&Seen<'_>) -> f64 + Send + Sync + 'static,
    ) {
        self.columns.push(Column {
            name: name.into(),
            kind,
            frame: frame.into(),
            reference: "".into(),
            text: text.to_owned(),
        });
        self.values.push(Box::new(value));
    }

    fn axles(&mut self, static_loads: [[f64; 2]; 4]) {
        for (axle, loads) in static_loads.into_iter().enumerate() {
            for (side, name) in SIDES.into_iter().enumerate() {
                let stem = format!("axle_{}_{name}", axle + 1);
                let text = "force of the wheel on its rail, normal to the track's plane, positive down";
                self.add(
                    format!("{stem}_vertical"),
                    Kind::Force,
                    TRACK,
                    text,
                    move |seen| seen.loads.wheels[axle][side].vertical,
                );
                let text = "force of the wheel on its rail along the track's plane, positive where it \
                            spreads the gauge";
                self.add(format!("{stem}_lateral"), Kind::Force, TRACK, text, move |seen| {
                    seen.loads.wheels[axle][side].lateral
                });
                let text = "lateral over vertical force; zero below a hundredth of the static load";
                let name = format!("{stem}_l_over_v");
                self.add(name, Kind::Dimensionless, TRACK, text, move |seen| {
                    let wheel = &seen.loads.wheels[axle][side];
                    ratio(wheel.lateral, wheel.vertical, loads[side])
                });
            }
            let stem = format!("axle_{}", axle + 1);
            let text = "place of the axle's middle from the track's center line, left";
            self.add(
                format!("{stem}_lateral"),
                Kind::Length,
                TRACK,
                text,
                move |seen| seen.loads.axles[axle].lateral,
            );
            let text = "yaw of the axle against the track, left";
            self.add(format!("{stem}_yaw"), Kind::Angle, TRACK, text, move |seen| {
                seen.loads.axles[axle].yaw
            });
        }
    }

    /// Nests and wedges of a truck.
    fn truck(&mut self, truck: usize) {
        let stem = format!("truck_{}", truck + 1);
        for (side, name) in SIDES.into_iter().enumerate() {
            let text = "load on the side frame from all that bolster, wedges and coils exert, positive down";
            let name = format!("{stem}_{name}_nest_vertical_force");
            self.add(name, Kind::Force, TRUCK, text, move |seen| {
                seen.loads.trucks[truck].nest_vertical[side]
            });
        }
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            let stem = format!("{stem}_{name}");
            let text = "normal force of the column";
            self.add(
                format!("{stem}_column_normal"),
                Kind::Force,
                TRUCK,
                text,
                move |seen| seen.loads.trucks[truck].wedges[number].column_normal,
            );
            let text = "friction of the column alone on the side frame, along z, positive up";
            self.add(
                format!("{stem}_column_friction_z"),
                Kind::Force,
                TRUCK,
                text,
                move |seen| seen.loads.trucks[truck].wedges[number].column_friction_z,
            );
            let text = "normal force of the slope";
            self.add(
                format!("{stem}_slope_normal"),
                Kind::Force,
                TRUCK,
                text,
                move |seen| seen.loads.trucks[truck].wedges[number].slope_normal,
            );
            for (k, coordinate) in ["x", "y", "z", "roll", "pitch", "yaw"].into_iter().enumerate() {
                let name = format!("{stem}_{coordinate}");
                if k < 3 {
                    let text = "displacement of its center of gravity from its nominal place in the truck";
                    self.add(name, Kind::Length, TRUCK, text, move |seen| {
                        seen.loads.trucks[truck].wedges[number].displacement[k]
                    });
                } else {
                    self.add(name, Kind::Angle, TRUCK, "its angle in truck axes", move |seen| {
                        seen.loads.trucks[truck].wedges[number].angles[k - 3]
                    });
                }
            }
        }
    }

    /// Adds the columns outside the fixed names: warp moment, center plate.
    fn more_of_truck(&mut self, truck: usize) {
        let stem = format!("truck_{}", truck + 1);
        let text = "moment about the truck's z axis that all elements exert on the bolster";
        self.add(
            format!("{stem}_warp_moment"),
            Kind::Moment,
            TRUCK,
            text,
            move |seen| seen.loads.trucks[truck].warp_moment.total(),
        );
        let text = "normal force of the center plate";
        self.add(
            format!("{stem}_center_plate_load"),
            Kind::Force,
            TRUCK,
            text,
            move |seen| seen.loads.trucks[truck].center_plate.load,
        );
        for (k, name) in ["roll", "pitch", "turning"].into_iter().enumerate() {
            let text =
                "moment of the center plate on the bolster about the truck's axes, at the plate's height";
            let name = format!("{stem}_center_plate_{name}_moment");
            self.add(name, Kind::Moment, TRUCK, text, move |seen| {
                seen.loads.trucks[truck].center_plate.moment[k]
            });
        }
    }

    /// The halves of a split wedge.
    fn halves(&mut self, truck: usize, number: usize, name: &str) {
        for own in of_halves() {
            let name = format!("truck_{}_{name}_{}", truck + 1, own.name);
            self.add(name, own.kind, TRUCK, own.text, move |seen| {
                (own.value)(&seen.loads.trucks[truck].wedges[number])
            });
        }
    }

    fn wear(&mut self) {
        for axle in 0..4 {
            for (side, name) in SIDES.into_iter().enumerate() {
                let name = format!("axle_{}_{name}_wear_number", axle + 1);
                let text = "energy that creep takes by the distance: creep forces times creepages";
                self.add(name, Kind::Force, TRACK, text, move |seen| {
                    seen.loads.wheels[axle][side].wear_number
                });
            }
        }
    }

    fn losses_of_wedges(&mut self, system: &System) {
        for truck in 1..=2 {
            for wedge in WEDGE_NAMES {
                let places = losses_of_wedge(system, truck, wedge);
                let name = format!("truck_{truck}_{wedge}_friction_loss");
                let text = "energy lost in its friction at column, slope and between halves since the start";
                self.sum(&name, text, places);
            }
        }
    }

    fn energies(&mut self, system: &System) {
        let of = |wanted: &dyn Fn(EnergyTermKind, &str) -> bool| -> Vec<usize> {
            let terms = system.energy_terms().iter().enumerate();
            terms
                .filter(|(_, term)| wanted(term.kind, &term.element))
                .map(|(place, _)| place)
                .collect()
        };
        let is_wheel = |element: &str| element.starts_with("wheel_") || element.starts_with("linear_wheel");
        let entries: [(&str, &str, Vec<usize>); 6] = [
            (
                "drive_work",
                "work of what holds the speed, and of motions and loads, since the start",
                of(&|kind, element| kind.is_work() && !is_wheel(element)),
            ),
            (
                "contact_work",
                "work of the contacts of wheels and rails that is not stored and not lost in creep and \
                 damping: it comes from forces that no energy belongs to",
                of(&|kind, element| kind.is_work() && is_wheel(element)),
            ),
            (
                "creep_loss",
                "energy lost in creep and in the damping of the contacts of wheels and rails since the start",
                of(&|kind, element| kind == EnergyTermKind::ElementLoss && is_wheel(element)),
            ),
            (
                "friction_loss",
                "energy lost in the friction of wedges, adapters, center plates and side bearings since the \
                 start",
                of(&|kind, _| {
                    matches!(
                        kind,
                        EnergyTermKind::FrictionLoss
                            | EnergyTermKind::ColumnFriction
                            | EnergyTermKind::SlopeFriction
                            | EnergyTermKind::WedgeKinematics
                    )
                }),
            ),
            (
                "contact_damping_loss",
                "energy lost in the damping of faces since the start",
                of(&|kind, _| kind == EnergyTermKind::ContactDampingLoss),
            ),
            (
                "element_loss",
                "energy lost in coils, stops and rails' supports since the start",
                of(&|kind, element| {
                    !kind.is_work()
                        && !is_wheel(element)
                        && !matches!(
                            kind,
                            EnergyTermKind::FrictionLoss
                                | EnergyTermKind::ColumnFriction
                                | EnergyTermKind::SlopeFriction
                                | EnergyTermKind::WedgeKinematics
                                | EnergyTermKind::ContactDampingLoss
                        )
                }),
            ),
        ];
        for (name, text, places) in entries {
            self.sum(name, text, places);
        }
        let text = "energy stored, less that at the start";
        self.add("stored_energy_change", Kind::Energy, "", text, |seen| {
            seen.observation.energies.total() - seen.start_energy
        });
        let text = "work less stored energy and losses";
        self.add("ledger_residual", Kind::Energy, "", text, |seen| {
            -seen.observation.residual(seen.start_energy)
        });
    }

    /// A sum of quadratures.
    fn sum(&mut self, name: &str, text: &str, places: Vec<usize>) {
        self.add(name, Kind::Energy, "", text, move |seen| {
            places
                .iter()
                .map(|place| seen.observation.quadratures[*place])
                .sum()
        });
    }
}

/// Returns the names that the faces of a wedge (`truck_1_leading_left`) may have.
fn faces_of_wedge(stem: &str) -> Vec<String> {
    let whole = ["column", "slope", "split"].map(|face| format!("{stem}_{face}"));
    let halves = HALVES.map(|half| ["column", "slope"].map(|face| format!("{stem}_{half}_{face}")));
    whole.into_iter().chain(halves.into_iter().flatten()).collect()
}

/// Returns the places among the contact states of the points of a wedge's faces, by the wedge's name; none of
/// a massless wedge.
pub(super) fn points_of_wedges(system: &System) -> Vec<(String, Vec<usize>)> {
    let names = (1..=2).flat_map(|truck| WEDGE_NAMES.map(|wedge| format!("truck_{truck}_{wedge}")));
    let points = names.map(|stem| {
        let faces = faces_of_wedge(&stem);
        let mut from = 0;
        let mut own = Vec::new();
        for mounted in system.faces() {
            let to = from + mounted.element.points.len();
            if faces.contains(&mounted.element.name) {
                own.extend(from..to);
            }
            from = to;
        }
        (stem, own)
    });
    points.filter(|(_, own)| !own.is_empty()).collect()
}

/// Returns the places among the energy terms of what a wedge of a truck (1 front, 2 rear) loses in friction.
pub(super) fn losses_of_wedge(system: &System, truck: usize, wedge: &str) -> Vec<usize> {
    let stem = format!("truck_{truck}_{wedge}");
    let faces = faces_of_wedge(&stem);
    let terms = system.energy_terms().iter().enumerate();
    terms
        .filter(|(_, term)| match term.kind {
            EnergyTermKind::FrictionLoss => faces.contains(&term.element),
            EnergyTermKind::ColumnFriction | EnergyTermKind::SlopeFriction => term.element == stem,
            _ => false,
        })
        .map(|(place, _)| place)
        .collect()
}
