//! Statistics of wheels and axles on their rails.
//!
//! | statistic | how |
//! |---|---|
//! | wheel L/V | lateral force on the rail, positive where it spreads the gauge, over the vertical force; the largest that lasts for the hold time, and over the hold distance |
//! | share of Nadal's limit | L/V over the limit of the wheel's own flange, with the friction of its rail there ([`wheelrail::climb`]); the largest that lasts for the hold time |
//! | climb | the longest distance over which L/V exceeds that limit, and the mean size of the axle's yaw against the track on it; both zero where it never does |
//! | lift | the largest distance of a wheel from its rail |
//! | rail roll, gauge widening | the largest, where rails are beams that wheels share |
//! | axle sum L/V | sum of the sizes of both wheels' L/V; the largest that lasts for the hold time |
//! | share of Weinstock's limit | the same over the limit of the flange that bears and the other wheel's tread |
//! | net axle L/V | size of the axle's lateral force on the track over its static load; the largest that lasts over the hold distance |
//! | axle's lateral force | size of the sliding mean over the mean distance: the largest; and in a band about its dominant frequency the largest rms over a section's length ([`crate::signal::Instability`]) |
//! | truck side L/V | lateral over vertical forces of all wheels of a side; the largest that lasts over the side distance |
//! | least side load | share of their static load; the least that lasts over the side distance |
//! | least wheel load | share of the static one; the least, and what is not exceeded for the hold time, over the hold distance |
//!
//! The lateral force of an axle is that of the left wheel less that of the right one: positive to the left.

use ::car::AxleLimits;
use quantity::Kind;

use super::of_parts::in_words;
use super::{AxlePart, In, Of, Pair, SIDES, Taker, ratio, timed};
use crate::signal::{Instability, Stretch, WindowValue, largest_mean, sustained};

/// Lateral and vertical force of a wheel.
struct Wheel {
    lateral: Pair,
    vertical: Pair,
}

impl Taker<'_, '_> {
    pub(super) fn wheels(&mut self) {
        let parts = self.histories.parts;
        let mut axles: Vec<[Wheel; 2]> = Vec::new();
        for axle in 0..parts.axles.len() {
            let wheels = [0, 1].map(|side| {
                let [lateral, vertical] =
                    ["lateral", "vertical"].map(|what| self.pair(&parts.force_of(axle, side, what)));
                Wheel { lateral, vertical }
            });
            self.axle(axle, &wheels);
            axles.push(wheels);
        }
        for own in &parts.trucks {
            for (side, name) in SIDES.into_iter().enumerate() {
                let wheels: Vec<&Wheel> = own.axles.iter().map(|axle| &axles[*axle][side]).collect();
                let load = own.axles.iter().map(|axle| parts.axles[*axle].loads[side]).sum();
                self.at = (Of::Truck, format!("{}, {name} side", in_words(&own.name)));
                self.side(&format!("{}_{name}", own.name), &wheels, load);
            }
        }
    }

    fn axle(&mut self, axle: usize, wheels: &[Wheel; 2]) {
        let (rows, rules) = (self.rows, self.rules);
        let AxlePart {
            name: stem, loads, ..
        } = &self.histories.parts.axles[axle];
        let limits = self.limits(axle);
        let number = Kind::Dimensionless;
        let ratios = [0, 1].map(|side| {
            let Wheel { lateral, vertical } = &wheels[side];
            Pair::of([lateral, vertical], |[l, v]| ratio(l, v, loads[side]))
        });
        let words = in_words(stem);
        for (side, name) in SIDES.into_iter().enumerate() {
            self.at = (Of::Wheel, format!("{words}, {name} wheel"));
            let stem = format!("{stem}_{name}");
            let (own, vertical) = (&ratios[side], &wheels[side].vertical);
            self.held(&format!("{stem}_l_over_v"), own);
            self.in_curves(&format!("{stem}_l_over_v"), own);
            self.least_load(&stem, vertical, loads[side]);
            self.forces_in_curves(&stem, &wheels[side].lateral, vertical, loads[side]);
            self.of_means(&format!("{stem}_l_over_v"), own, number);
            self.of_rows(&format!("{stem}_vertical_force"), vertical, Kind::Force);
            if let Some(limits) = &limits {
                self.climb(axle, side, own, limits);
            }
            self.largest(&format!("{stem}_lift"), Kind::Length);
            self.largest(&format!("{stem}_rail_roll"), Kind::Angle);
        }
        self.at = (Of::Axle, words);
        self.largest(&format!("{stem}_gauge_widening"), Kind::Length);
        let [left, right] = &ratios;
        let sum = Pair::of([left, right], |[l, r]| l.abs() + r.abs());
        let name = format!("{stem}_sum_l_over_v");
        let lasting = |values: &[f64]| sustained(rows.time, values, rules.hold_time);
        self.set(&format!("{name}_time"), &sum, number, lasting);
        self.in_curves(&name, &sum);
        if let Some(limits) = &limits {
            let share = Pair::by_row([left, right], |row, [l, r]| limits[row].weinstock_share([l, r]));
            self.set(&format!("{stem}_weinstock_share_time"), &share, number, lasting);
        }
        let [left, right] = wheels;
        let net = Pair::of([&left.lateral, &right.lateral], |[l, r]| l - r);
        self.axle_force(stem, &net, loads[0] + loads[1]);
    }

    /// Takes the largest value of a column, if there is one.
    fn largest(&mut self, column: &str, kind: Kind) {
        let Some(raw) = self.column(column).map(<[f64]>::to_vec) else {
            return;
        };
        let rows = self.rows;
        let own = Pair { raw, filtered: None };
        let largest = |values: &[f64]| sustained(rows.time, values, 0.0);
        self.set(&format!("{column}_largest"), &own, kind, largest);
    }

    /// What flanges of an axle climb at, at each row.
    fn limits(&self, axle: usize) -> Option<Vec<AxleLimits>> {
        let climb = self.histories.climb?;
        let place = self.histories.parts.axles[axle].place;
        let distances = self.rows.distance;
        Some(match climb.vary() {
            true => distances.iter().map(|own| climb.at(axle, own + place)).collect(),
            false => vec![climb.at(axle, 0.0); distances.len()],
        })
    }

    /// Shares of Nadal's limit, and the longest climb.
    fn climb(&mut self, axle: usize, side: usize, own: &Pair, limits: &[AxleLimits]) {
        let (rows, rules) = (self.rows, self.rules);
        let axle = &self.histories.parts.axles[axle].name;
        let stem = format!("{axle}_{}", SIDES[side]);
        let limit = |row: usize| limits[row].nadal[side];
        let share = Pair::by_row([own], |row, [own]| own / limit(row));
        let name = format!("{stem}_nadal_share_time");
        self.set(&name, &share, Kind::Dimensionless, |values| {
            sustained(rows.time, values, rules.hold_time)
        });
        let yaw = self.column(&format!("{axle}_yaw"));
        let sizes: Vec<f64> = yaw.unwrap_or_default().iter().map(|own| own.abs()).collect();
        // Where wheels have no flange, nothing is exceeded.
        let levels: Vec<f64> = (0..rows.time.len()).map(|row| limit(row).min(f64::MAX)).collect();
        let stretches = own.each().map(|values| {
            let found = Stretch::longest_above(rows.distance, values?, &levels)?;
            Some(found).filter(|_| rows.go_forward())
        });
        let value = |found: Stretch, value: f64| {
            let start = found.start;
            let length = found.length;
            timed(rows, WindowValue { value, start, length })
        };
        let lengths = stretches.map(|own| own.map(|own| value(own, own.length)));
        let unit = In::Unit(Kind::Distance, 1.0);
        self.keep(&format!("{stem}_climb_distance"), lengths, unit);
        let angles = stretches.map(|own| {
            let own = own?;
            let mean = match own.length > 0.0 {
                true => own.mean(rows.distance, &sizes)?,
                false => 0.0,
            };
            Some(value(own, mean))
        });
        let unit = In::Unit(Kind::Angle, 1.0);
        self.keep(&format!("{stem}_climb_angle_of_attack"), angles, unit);
    }

    /// Wheel L/V that lasts, over time and distance.
    fn held(&mut self, name: &str, ratio: &Pair) {
        let (rows, rules) = (self.rows, self.rules);
        self.set(&format!("{name}_time"), ratio, Kind::Dimensionless, |values| {
            sustained(rows.time, values, rules.hold_time)
        });
        let unit = In::Unit(Kind::Dimensionless, 1.0);
        self.over_distance(&format!("{name}_distance"), ratio, unit, |places, values| {
            sustained(places, values, rules.hold_distance)
        });
    }

    /// The least load of a wheel, and those that are not exceeded for the hold time and over the hold
    /// distance, in % of the static one.
    fn least_load(&mut self, stem: &str, vertical: &Pair, load: f64) {
        let (rows, rules) = (self.rows, self.rules);
        if load <= 0.0 {
            return;
        }
        let relief = Pair::of([vertical], |[own]| -own);
        let unit = In::PercentOf(-load);
        for (name, hold) in [("least_load", 0.0), ("least_load_time", rules.hold_time)] {
            let found = relief.each().map(|values| sustained(rows.time, values?, hold));
            self.keep(&format!("{stem}_{name}"), found, unit);
        }
        let name = format!("{stem}_least_load_distance");
        self.over_distance(&name, &relief, unit, |places, values| {
            sustained(places, values, rules.hold_distance)
        });
    }

    /// The lateral force of an axle (N, to the left); its static load, N.
    fn axle_force(&mut self, stem: &str, net: &Pair, load: f64) {
        let rules = self.rules;
        if load > 0.0 {
            let share = Pair::of([net], |[own]| own.abs() / load);
            let unit = In::Unit(Kind::Dimensionless, 1.0);
            self.over_distance(&format!("{stem}_net_l_over_v"), &share, unit, |places, values| {
                sustained(places, values, rules.hold_distance)
            });
        }
        let name = format!("{stem}_lateral_force");
        let unit = In::Unit(Kind::Force, 1.0);
        self.over_distance(&format!("{name}_mean"), net, unit, |places, values| {
            largest_mean(places, values, rules.mean_distance)
        });
        self.of_means(&name, net, Kind::Force);
        self.instability(&format!("{name}_instability"), &net.raw);
    }

    /// What of an axle's lateral force (N) is hunting.
    fn instability(&mut self, name: &str, force: &[f64]) {
        let (rows, rules) = (self.rows, self.rules);
        let found = match rows.go_forward() {
            true => Instability::of(rows.time, rows.distance, force, rules.section_length)
                .map_err(|own| own.to_string()),
            false => Err("the car stands or goes back".to_owned()),
        };
        let (value, remark) = match found {
            Ok(own) => {
                let mut remark = format!("about {:.2} Hz", own.frequency);
                if own.rms.length < rules.section_length {
                    let lengths = [own.rms.length, rules.section_length];
                    remark += &format!(
                        ", over the {:.0} m of the run, not over {:.0} m",
                        lengths[0], lengths[1]
                    );
                }
                (Some(timed(rows, own.rms)), remark)
            }
            Err(reason) => (None, reason),
        };
        self.keep(name, [None, value], In::Unit(Kind::Force, 1.0));
        self.remark(name, remark);
    }

    /// Wheels of a side of a truck; their static load, N.
    fn side(&mut self, stem: &str, wheels: &[&Wheel], load: f64) {
        let rules = self.rules;
        let (lateral, vertical) = (
            Pair::sum(wheels.iter().map(|own| &own.lateral)),
            Pair::sum(wheels.iter().map(|own| &own.vertical)),
        );
        let own = Pair::of([&lateral, &vertical], |[l, v]| ratio(l, v, load));
        let lasting = |places: &[f64], values: &[f64]| sustained(places, values, rules.side_distance);
        let unit = In::Unit(Kind::Dimensionless, 1.0);
        self.over_distance(&format!("{stem}_side_l_over_v"), &own, unit, lasting);
        if load > 0.0 {
            let relief = Pair::of([&vertical], |[own]| -own);
            let unit = In::PercentOf(-load);
            self.over_distance(&format!("{stem}_least_side_load"), &relief, unit, lasting);
        }
    }
}
