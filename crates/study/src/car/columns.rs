//! The columns of a car's results.

use std::sync::Arc;

use car::{BuildError, Car, ClimbLimits, Derailment, Loads, Parameters, TRUCK_PARTS, Wheels};
use mechanics::channel::{Channels, Seen, WithLoads};
use mechanics::output::Column;
use mechanics::system::{EnergyTermKind, Observation, System};
use quantity::Kind;
use truck::{WEDGE_NAMES, WedgeLoads};
use wheelrail::profile::SlicedProfile;
use wheelrail::track::Track;

use super::couplers::ENDS;
use super::derailment;
use super::statistics::{AxlePart, Parts, PlacePart, SIDES, TruckPart, in_words, ratio};
use crate::truck::channels::{FACES, FRICTION, TruckChannels, losses_at, names_of_face, places_of};

/// The table of a car's results, for any observation of its system.
pub struct CarTable {
    car: Car,
    columns: Channels<WithLoads<Loads>>,
    fixed: usize,
    static_loads: [[f64; 2]; 4],
    track: Track,
    /// Rails whose sections change along the track.
    over: [Option<Arc<SlicedProfile>>; 2],
    /// What flanges climb at; none with linear wheels.
    climb: Option<Arc<ClimbLimits>>,
    /// What statistics are taken of.
    parts: Parts,
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
        let climb = ClimbLimits::of(parameters).map(Arc::new);
        let parts = parts_of(parameters, static_loads);
        let Table { columns, fixed } = Table::new(&car, &parameters.trucks, static_loads, climb.clone());
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
            climb,
            parts,
            columns,
            fixed,
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
        self.fixed
    }

    /// Returns the static loads of the wheels by axle, left and right, N.
    #[must_use]
    pub fn static_loads(&self) -> [[f64; 2]; 4] {
        self.static_loads
    }

    /// Returns what statistics are taken of.
    #[must_use]
    pub fn parts(&self) -> &Parts {
        &self.parts
    }

    /// Returns what the flanges climb at; none with linear wheels.
    #[must_use]
    pub fn climb(&self) -> Option<&ClimbLimits> {
        self.climb.as_deref()
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
        self.columns.read(&seen, out);
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

/// Returns what statistics of a car are taken of; static loads of the wheels are by axle, left and right, N.
#[must_use]
pub fn parts_of(parameters: &Parameters, static_loads: [[f64; 2]; 4]) -> Parts {
    let [forward, ..] = parameters.center_of_gravity();
    let half = 0.5 * parameters.truck_distance;
    let axles = (0..4).map(|axle: usize| {
        let base = parameters.trucks[axle / 2].geometry.axle();
        AxlePart {
            name: format!("axle_{}", axle + 1),
            loads: static_loads[axle],
            place: [half, -half][axle / 2] + [base, -base][axle % 2] - forward,
        }
    });
    let trucks = [1, 2].map(|truck: usize| TruckPart {
        name: format!("truck_{truck}"),
        axles: vec![2 * truck - 2, 2 * truck - 1],
    });
    let on_bodies = [1, 2].map(|truck| PlacePart {
        name: format!("body_at_truck_{truck}"),
        words: format!("body over truck {truck}"),
    });
    Parts {
        distance: "distance".to_owned(),
        speed: "speed".to_owned(),
        force: "",
        axles: axles.collect(),
        on_trucks: trucks.iter().flat_map(|own| on_truck(&own.name)).collect(),
        trucks: trucks.to_vec(),
        bodies: vec![PlacePart::named("body")],
        on_bodies: on_bodies.to_vec(),
    }
}

/// Returns the places of accelerometers on a truck.
pub(crate) fn on_truck(name: &str) -> [PlacePart; 3] {
    TRUCK_PARTS.map(|part| PlacePart {
        name: format!("{name}_{part}"),
        words: format!("{}, {}", in_words(name), in_words(part)),
    })
}

/// Axes that signs refer to, by what a column is about.
const TRACK: &str = "of the track: forward, left, up";
const BODY: &str = "of the car body: left, up";
const TRUCK: &str = "of the truck: x forward, y left, z up";

/// The columns on their way.
#[derive(Default)]
struct Table {
    columns: Channels<WithLoads<Loads>>,
    /// Number of columns at the beginning with fixed names.
    fixed: usize,
}

impl Table {
    /// Returns the columns of a car on these trucks; static loads of the wheels are by axle, left and right,
    /// N.
    fn new(
        car: &Car,
        trucks: &[truck::Parameters; 2],
        static_loads: [[f64; 2]; 4],
        climb: Option<Arc<ClimbLimits>>,
    ) -> Self {
        let mut own = Self::default();
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
            own.truck(truck).warp_angle();
        }
        for truck in 0..2 {
            own.truck(truck).nests();
            own.truck(truck).wedges();
        }
        own.couplers(car);
        own.fixed = own.columns.columns.len();
        for (truck, parameters) in trucks.iter().enumerate() {
            let mut own = own.truck(truck);
            own.warp_moment();
            own.center_plate();
            own.side_bearings(parameters);
            own.rises();
            own.halves(parameters);
        }
        own.wear();
        if car.has_beams() {
            own.rails(static_loads);
        }
        if let Some(limits) = climb {
            own.climb(static_loads, &limits);
        }
        own.forces();
        if car.numbers.rear_half.is_some() {
            let text = "roll of the front half of the car body against the rear half";
            own.add("body_twist", Kind::Angle, BODY, text, |seen| {
                seen.loads.body_twist
            });
        }
        own.truck_accelerations();
        for truck in 1..=2 {
            for wedge in WEDGE_NAMES {
                let places = losses_of_wedge(&car.system, truck, wedge);
                let name = format!("truck_{truck}_{wedge}_friction_loss");
                let text = "energy lost in its friction at column, slope and between halves since the start";
                own.columns.add_energy(name, "", text, places);
            }
        }
        own.energies(&car.system);
        own
    }

    fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        frame: &'static str,
        text: &str,
        value: impl Fn(&Seen<'_, Loads>) -> f64 + Send + Sync + 'static,
    ) {
        self.columns.add(name, kind, frame, text, value);
    }

    /// Returns what adds the columns that a truck of its own has, too.
    fn truck(&mut self, truck: usize) -> TruckChannels<'_, Loads> {
        TruckChannels {
            table: &mut self.columns,
            prefix: format!("truck_{}_", truck + 1),
            frame: TRUCK,
            of: (|own, truck| &own.trucks[truck], truck),
        }
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

    /// The couplers, where forces act or can act.
    fn couplers(&mut self, car: &Car) {
        for (end, name) in ENDS
            .into_iter()
            .enumerate()
            .filter(|(end, _)| car.is_coupled(*end))
        {
            let stem = format!("coupler_{name}");
            let at = move |seen: &Seen<'_, Loads>| seen.loads.couplers[end].unwrap_or_default();
            let text = "force of the coupler along its line, positive in buff";
            self.add(format!("{stem}_force"), Kind::Force, BODY, text, move |seen| {
                at(seen).force
            });
            let text = "force of the coupler on the car body to its left";
            self.add(
                format!("{stem}_lateral_force"),
                Kind::Force,
                BODY,
                text,
                move |seen| at(seen).lateral,
            );
            let text = "of the coupler to the car body, positive where it points to the left of the car";
            self.add(format!("{stem}_angle"), Kind::Angle, BODY, text, move |seen| {
                at(seen).angle
            });
            let text = "of the pivot of the coupler along the track, in plan";
            self.add(
                format!("{stem}_distance"),
                Kind::Distance,
                TRACK,
                text,
                move |seen| at(seen).distance,
            );
            let text = "of the pivot of the coupler along the track";
            self.add(
                format!("{stem}_speed"),
                Kind::TravelSpeed,
                TRACK,
                text,
                move |seen| at(seen).speed,
            );
        }
    }

    /// How rails give way that are beams.
    fn rails(&mut self, static_loads: [[f64; 2]; 4]) {
        for axle in 0..4 {
            for (side, name) in SIDES.into_iter().enumerate() {
                let name = format!("axle_{}_{name}_rail_roll", axle + 1);
                let text = "roll of the rail under the wheel about its base, outwards";
                self.add(name, Kind::Angle, TRACK, text, move |seen| {
                    seen.loads.wheels[axle][side].rail_roll
                });
            }
            let name = format!("axle_{}_gauge_widening", axle + 1);
            let text = "how far the heads of both rails have moved apart under the axle";
            self.add(name, Kind::Length, TRACK, text, move |seen| {
                seen.loads.axles[axle].gauge_widening
            });
        }
        for truck in 0..2 {
            for (side, name) in SIDES.into_iter().enumerate() {
                let name = format!("truck_{}_{name}_side_l_over_v", truck + 1);
                let text = "lateral over vertical forces of both wheels of the side; zero below a \
                            hundredth of the static load";
                let axles = [2 * truck, 2 * truck + 1];
                let load = axles.map(|axle| static_loads[axle][side]).iter().sum();
                self.add(name, Kind::Dimensionless, TRACK, text, move |seen| {
                    let of = |force: fn(&car::WheelLoads) -> f64| -> f64 {
                        axles
                            .map(|axle| force(&seen.loads.wheels[axle][side]))
                            .iter()
                            .sum()
                    };
                    ratio(of(|own| own.lateral), of(|own| own.vertical), load)
                });
            }
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

    /// How near wheels are to climbing.
    fn climb(&mut self, static_loads: [[f64; 2]; 4], limits: &Arc<ClimbLimits>) {
        let ratio_of = move |seen: &Seen<'_, Loads>, axle: usize, side: usize| {
            let wheel = &seen.loads.wheels[axle][side];
            ratio(wheel.lateral, wheel.vertical, static_loads[axle][side])
        };
        let at = |axle: usize| {
            let limits = Arc::clone(limits);
            move |seen: &Seen<'_, Loads>| limits.at(axle, seen.loads.axles[axle].distance)
        };
        for axle in 0..4 {
            for (side, name) in SIDES.into_iter().enumerate() {
                let stem = format!("axle_{}_{name}", axle + 1);
                let text = "angle of the contact that carries most, against the track's plane, positive \
                            where it rises to the field side; zero without contact";
                let name = format!("{stem}_contact_angle");
                self.add(name, Kind::Angle, TRACK, text, move |seen| {
                    seen.loads.wheels[axle][side].contact_angle
                });
                let text = "L/V over Nadal's limit for the angle of the wheel's own flange and the friction \
                            of its rail there, where nothing slips";
                let name = format!("{stem}_nadal_share");
                let limits = at(axle);
                self.add(name, Kind::Dimensionless, TRACK, text, move |seen| {
                    ratio_of(seen, axle, side) / limits(seen).nadal[side]
                });
                let text =
                    "how far the wheel must be lowered until it bears on its rail; zero while it bears";
                let name = format!("{stem}_lift");
                self.add(name, Kind::Length, TRACK, text, move |seen| {
                    seen.loads.wheels[axle][side].lift
                });
            }
            let text = "sizes of both wheels' L/V over Weinstock's limit: Nadal's for the flange that bears, \
                        and the friction of the other tread";
            let name = format!("axle_{}_weinstock_share", axle + 1);
            let limits = at(axle);
            self.add(name, Kind::Dimensionless, TRACK, text, move |seen| {
                limits(seen).weinstock_share([0, 1].map(|side| ratio_of(seen, axle, side)))
            });
        }
    }

    fn forces(&mut self) {
        for axle in 0..4 {
            let text = "force of both wheels on the track along its plane, positive to the left";
            let name = format!("axle_{}_lateral_force", axle + 1);
            self.add(name, Kind::Force, TRACK, text, move |seen| {
                let [left, right] = &seen.loads.wheels[axle];
                left.lateral - right.lateral
            });
        }
    }

    fn truck_accelerations(&mut self) {
        for truck in 0..2 {
            for (part, name) in TRUCK_PARTS.into_iter().enumerate() {
                let name = format!("truck_{}_{name}_lateral_acceleration", truck + 1);
                let text = "at its center of gravity, as an accelerometer shows it along its left: with \
                            gravity's part by roll and superelevation";
                self.add(name, Kind::RideAcceleration, TRUCK, text, move |seen| {
                    seen.loads.truck_accelerations[truck][part]
                });
            }
        }
    }

    fn energies(&mut self, system: &System) {
        let is_wheel = |element: &str| element.starts_with("wheel_") || element.starts_with("linear_wheel");
        let entries: [(&str, &str, Vec<usize>); 6] = [
            (
                "drive_work",
                "work of what holds the speed, and of motions and loads, since the start",
                places_of(system, |kind, element| kind.is_work() && !is_wheel(element)),
            ),
            (
                "contact_work",
                "work of the contacts of wheels and rails that is not stored and not lost in creep and \
                 damping: it comes from forces that no energy belongs to",
                places_of(system, |kind, element| kind.is_work() && is_wheel(element)),
            ),
            (
                "creep_loss",
                "energy lost in creep and in the damping of the contacts of wheels and rails since the start",
                places_of(system, |kind, element| {
                    kind == EnergyTermKind::ElementLoss && is_wheel(element)
                }),
            ),
            (
                "friction_loss",
                "energy lost in the friction of wedges, adapters, center plates and side bearings, with \
                 hysteresis, since the start",
                places_of(system, |kind, _| FRICTION.contains(&kind)),
            ),
            (
                "contact_damping_loss",
                "energy lost in the damping of faces since the start",
                places_of(system, |kind, _| kind == EnergyTermKind::ContactDampingLoss),
            ),
            (
                "element_loss",
                "energy lost in coils, stops, rails' supports and the twist of the body since the start",
                places_of(system, |kind, element| {
                    !kind.is_work()
                        && !is_wheel(element)
                        && !FRICTION.contains(&kind)
                        && kind != EnergyTermKind::ContactDampingLoss
                }),
            ),
        ];
        for (name, text, places) in entries {
            self.columns.add_energy(name, "", text, places);
        }
        self.columns.add_stored("");
        self.columns.add_residual("");
    }
}

/// Returns the places among the contact states of the points of a wedge's faces, by the wedge's name; none of
/// a massless wedge.
pub(super) fn points_of_wedges(system: &System) -> Vec<(String, Vec<usize>)> {
    let names = (1..=2).flat_map(|truck| WEDGE_NAMES.map(|wedge| format!("truck_{truck}_{wedge}")));
    let points = names.map(|stem| {
        let faces = FACES.map(|face| names_of_face(&stem, face)).concat();
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
    losses_at(system, &format!("truck_{truck}_{wedge}"), &FACES)
}
