//! The half-truck without its wedges: half a car on a bolster, two side frames, and the forces that wedges put on them.
//!
//! Bodies, springs, bearing adapters and stops are those of the built-in system file of the constantly damped half-truck
//! ([`FILE`]), with small displacements ([`mechanics::connection`]); its friction wedges and the springs that drive its bolster are left
//! out. Loads from outside are constant within a step. With the generalized forces Q of all loads, `M u˙ = f(q, u, s) + Q`, and
//! the work that comes in is `Q · Δq`, exactly.
//!
//! Where wedges are: a wedge has x from the column towards the bolster. Trailing wedges (columns behind the bolster) have the truck's
//! axes; leading ones are turned by 180° about z: x, y, roll and pitch change their signs, z and yaw do not. The points that the wedge's
//! neighbours turn about lie half the wedge's length apart, as in the wedge itself, around the point of the file's connection.

use mechanics::connection::Law;
use mechanics::system::System;
use nucars::read::read_system;
use nucars::truck::{Choices, Truck};
use wedge::Parameters;

use crate::Error;

/// The file that the truck is made of.
pub const FILE: &str = "Bolst_wedge_sf_68_constant.sys";

/// Names of the wedges; the first is at the left of the leading side.
pub const WEDGES: [&str; 4] = ["leading_left", "leading_right", "trailing_left", "trailing_right"];
/// Numbers of their connections in the file.
const CONNECTIONS: [u32; 4] = [127, 128, 129, 130];

/// The point of a body that a wedge's neighbour turns about.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    body: usize,
    /// From the centre of gravity, m.
    lever: [f64; 3],
    /// The sign of x, y, roll and pitch: -1 for a wedge that is turned.
    sign: f64,
}

/// Values of x, y, z, roll, pitch, yaw.
pub type Six = [f64; 6];

impl Point {
    /// From the truck's axes to the wedge's, or back.
    fn turned(&self, values: Six) -> Six {
        let s = self.sign;
        let signs = [s, s, 1.0, s, s, 1.0];
        std::array::from_fn(|k| signs[k] * values[k])
    }

    /// The displacement (or its rate) of the point by those of the centre of gravity, in the wedge's axes.
    fn displacement(&self, body: Six) -> Six {
        let [x, y, z, roll, pitch, yaw] = body;
        let [lx, ly, lz] = self.lever;
        self.turned([
            x + pitch * lz - yaw * ly,
            y - roll * lz + yaw * lx,
            z + roll * ly - pitch * lx,
            roll,
            pitch,
            yaw,
        ])
    }

    /// Force and moment (in the wedge's axes, about the point) as force and moment on the centre of gravity: the transposed.
    fn load(&self, load: Six) -> Six {
        let [x, y, z, roll, pitch, yaw] = self.turned(load);
        let [lx, ly, lz] = self.lever;
        [
            x,
            y,
            z,
            roll - lz * y + ly * z,
            pitch + lz * x - lx * z,
            yaw - ly * x + lx * y,
        ]
    }
}

/// The truck under loads.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Its equations.
    pub system: System,
    /// For each wedge the points of bolster and side frame.
    points: [[Point; 2]; 4],
    /// Body and coordinate of each position.
    places: Vec<(usize, usize)>,
    /// The loads on each body.
    loads: Vec<Six>,
}

/// The body that carries the load, among the system's bodies.
pub const BODY: usize = 1;

impl Loaded {
    /// The truck with room for these wedges.
    ///
    /// # Errors
    /// Never, with the built-in file.
    pub fn new(wedge: &Parameters) -> Result<Self, Error> {
        let failed = |error: &dyn std::fmt::Display| Error::new(format!("the truck's file {FILE}: {error}"));
        let source = nucars::builtin::source(FILE).ok_or_else(|| failed(&"it is missing"))?;
        let file = read_system(&source).strict().map_err(|error| failed(&error))?;
        let truck = Truck::new(&file, None, &Choices::default()).map_err(|error| failed(&error))?;
        let half = 0.25 * wedge.bottom_length();
        let mut points = Vec::with_capacity(4);
        for number in CONNECTIONS {
            let connection = truck
                .connection(number)
                .and_then(|place| truck.model.connections.get(place))
                .ok_or_else(|| failed(&"a wedge is missing"))?;
            let (a, b) = (connection.a, connection.b);
            let center = |body: usize| truck.model.bodies[body].frame.origin;
            // The column lies on the other side of the wedge than the bolster.
            let sign = if connection.point[0] > center(a)[0] {
                -1.0
            } else {
                1.0
            };
            points.push([(a, half), (b, -half)].map(|(body, ahead)| {
                let center = center(body);
                let mut lever: [f64; 3] = std::array::from_fn(|k| connection.point[k] - center[k]);
                lever[0] += sign * ahead;
                Point { body, lever, sign }
            }));
        }
        let points = points.try_into().map_err(|_| failed(&"it has not four wedges"))?;
        let mut model = truck.model.clone();
        let inputs: Vec<usize> = (0..model.bodies.len())
            .filter(|body| {
                file.input_bodies
                    .iter()
                    .any(|input| *input.id == truck.bodies[*body])
            })
            .collect();
        model.connections.retain(|own| {
            !matches!(own.law, Law::Wedge(_)) && !inputs.contains(&own.a) && !inputs.contains(&own.b)
        });
        let system = System::new(model).map_err(|error| failed(&error))?;
        let places = places(&system);
        Ok(Self {
            loads: vec![[0.0; 6]; system.bodies().len()],
            system,
            points,
            places,
        })
    }

    /// Body and coordinate of each position.
    pub fn coordinates(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.places.iter().copied()
    }

    /// Sets the loads from outside: for each wedge those on the bolster and on the side frame, in the wedge's axes; and one on the body's
    /// centre of gravity.
    ///
    /// # Errors
    /// Never, with the built-in file.
    pub fn set_loads(&mut self, wedges: &[[Six; 2]; 4], on_body: Six) -> Result<(), Error> {
        self.loads.fill([0.0; 6]);
        let mut add = |body: usize, load: Six| {
            for (sum, load) in self.loads[body].iter_mut().zip(load) {
                *sum += load;
            }
        };
        add(BODY, on_body);
        for (points, loads) in self.points.iter().zip(wedges) {
            for (point, load) in points.iter().zip(loads) {
                add(point.body, point.load(*load));
            }
        }
        put(&self.loads, &mut self.system)
    }

    /// Sets the same loads on another copy of the system.
    ///
    /// # Errors
    /// Never, with the built-in file.
    pub fn put_loads(&self, system: &mut System) -> Result<(), Error> {
        put(&self.loads, system)
    }

    /// What the loads do with these displacements or speeds: work or power.
    pub fn work(&self, along: impl Iterator<Item = f64>) -> f64 {
        self.places
            .iter()
            .zip(along)
            .map(|((body, coordinate), way)| self.loads[*body][*coordinate] * way)
            .sum()
    }

    /// Displacements (or their rates) of the point that a wedge's neighbour turns about; `values` are the positions (or speeds).
    #[must_use]
    pub fn neighbour(&self, wedge: usize, neighbour: usize, values: &[f64]) -> Six {
        let Some(point) = self.points.get(wedge).and_then(|points| points.get(neighbour)) else {
            return [0.0; 6];
        };
        let mut body = [0.0; 6];
        for ((own, coordinate), value) in self.places.iter().zip(values) {
            if *own == point.body {
                body[*coordinate] = *value;
            }
        }
        point.displacement(body)
    }
}

/// Sets the loads of all bodies.
fn put(loads: &[Six], system: &mut System) -> Result<(), Error> {
    for (body, load) in loads.iter().enumerate() {
        system
            .set_load(body, *load)
            .map_err(|error| Error::new(error.to_string()))?;
    }
    Ok(())
}

fn places(system: &System) -> Vec<(usize, usize)> {
    let mut places = vec![(0, 0); system.layout().speeds];
    for body in 0..system.bodies().len() {
        for coordinate in 0..6 {
            if let Some(place) = system.position_of(body, coordinate) {
                places[place] = (body, coordinate);
            }
        }
    }
    places
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use integrate::Problem;

    use super::*;

    fn truck() -> Loaded {
        Loaded::new(&wedge::thesis::parameters(
            wedge::parameters::Damping::Constant,
            0.0,
            0.0,
        ))
        .unwrap()
    }

    #[test]
    fn energy_loads_at_wedges_do_the_work_of_their_points() {
        let mut truck = truck();
        // Numbers without pattern.
        let number = |k: usize| f64::from(((k * 7919 + 13) % 101) as u32) - 50.0;
        let loads = std::array::from_fn(|w| {
            std::array::from_fn(|n| std::array::from_fn(|k| number(12 * w + 6 * n + k)))
        });
        let speeds: Vec<f64> = (0..truck.system.layout().speeds)
            .map(|k| number(k + 61))
            .collect();
        truck.set_loads(&loads, [0.0; 6]).unwrap();
        let of_points: f64 = (0..4)
            .flat_map(|w| (0..2).map(move |n| (w, n)))
            .map(|(w, n)| {
                let rates = truck.neighbour(w, n, &speeds);
                let load: &Six = &loads[w][n];
                load.iter()
                    .zip(rates)
                    .map(|(load, rate)| load * rate)
                    .sum::<f64>()
            })
            .sum();
        let of_bodies = truck.work(speeds.iter().copied());
        assert!(
            (of_points - of_bodies).abs() < 1e-12 * of_points.abs(),
            "{of_points} {of_bodies}"
        );
    }

    #[test]
    fn analytic_the_springs_carry_the_truck_where_it_is_drawn() {
        let truck = truck();
        let mut system = truck.system.clone();
        let start = system.initial_state();
        let rest = system
            .equilibrium(0.0, &start, mechanics::system::StaticFriction::Without)
            .unwrap();
        let height = rest[system.position_of(BODY, 2).unwrap()];
        // 319.175 lb s²/in · 386.09 in/s² on springs of about 51,000 lb/in, preloaded by eight times 15,403.78 lb.
        assert!(height.abs() < 0.5e-3, "{height} m");
    }

    #[test]
    fn limits_a_load_from_outside_moves_the_body_alone() {
        let mut truck = truck();
        let x = truck.system.initial_state();
        let mut without = vec![0.0; x.len()];
        truck.system.next_time_discontinuity(0.0);
        truck.system.derivative(0.0, &x, &mut without);
        let load = [0.0, 0.0, 1000.0, 0.0, 0.0, 0.0];
        truck.set_loads(&[[[0.0; 6]; 2]; 4], load).unwrap();
        let mut with = vec![0.0; x.len()];
        truck.system.derivative(0.0, &x, &mut with);
        let speeds = truck.system.layout().speeds;
        let place = speeds + truck.system.position_of(BODY, 2).unwrap();
        // 319.175 lb s²/in in kg.
        let mass = 319.175 * 0.453_592_37 * 9.806_65 / 0.0254;
        assert!(((with[place] - without[place]) * mass / 1000.0 - 1.0).abs() < 1e-9);
        for k in (0..x.len()).filter(|k| *k != place) {
            assert_eq!(with[k].to_bits(), without[k].to_bits());
        }
    }
}
