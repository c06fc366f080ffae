//! The parts of the car: dimensions, weights, stiffnesses in inches and pounds, from the built-in cars of
//! 263,000 lbf with variable damping (docs/car.md, docs/truck.md).

use super::law::Law;
use super::vector::{V, back, cross, sub};
use super::wheel::{Hertz, RADIUS, Wave};
use super::{BODIES, Body, Car, INCH, Link, POUND_FORCE, POUND_PER_INCH, Point, STATES, WHEELSETS};

/// Mass that weighs one lbf, kg.
const POUND: f64 = 0.453_592_37;
/// Angle of the wedges' slopes to the vertical, rad.
const ANGLE: f64 = 32.0 * std::f64::consts::PI / 180.0;
/// Height and width of a wedge, in.
const WEDGE: [f64; 2] = [6.125, 10.5];
/// Half of the lateral distance of nests and journals, in.
const NEST: f64 = 39.5;
/// Half of the distance of the trucks, in.
const TRUCK: f64 = 243.0;

/// The car's load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lading {
    Loaded,
    Empty,
}

/// What losses there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Losses {
    /// Friction and dampers, as in the built-in cars.
    All,
    /// None: energy stays.
    Nothing,
}

/// The points of a wedge's face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Faces {
    /// Both flat, at the corners.
    Corners,
    /// Two rows of nine across, the slope crowned by 240 in, as in the built-in cars.
    Crowned,
}

/// Links and points as they are added.
struct Parts {
    faces: Faces,
    bodies: Vec<Body>,
    links: Vec<Link>,
    points: Vec<Point>,
    sliders: usize,
    /// Factor of dampings and friction.
    losses: f64,
}

impl Parts {
    /// Weight lbf, inertia lbf·in·s², center in; returns its number.
    fn body(&mut self, weight: f64, inertia: V, center: V) -> usize {
        self.bodies.push(Body {
            mass: weight * POUND,
            inertia: inertia.map(|own| own * POUND_FORCE * INCH),
            center: center.map(|own| own * INCH),
        });
        self.bodies.len() - 1
    }

    /// Adds points (places in in) of body `a` that see body `b`; z of the laws is along `normal`, which has
    /// no part across the track.
    fn link(&mut self, a: usize, b: usize, normal: V, points: impl IntoIterator<Item = (V, Law)>) {
        let across = [0.0, 1.0, 0.0];
        let columns = [cross(across, normal), across, normal];
        let turn = std::array::from_fn(|row| columns.map(|column| column[row]));
        let first = self.points.len();
        for (place, law) in points {
            let place = place.map(|own| own * INCH);
            self.points.push(Point {
                at: sub(place, self.bodies[a].center),
                rest: back(&turn, sub(place, self.bodies[b].center)),
                law,
            });
        }
        let points = first..self.points.len();
        self.links.push(Link { a, b, turn, points });
    }

    /// Preload lbf, stiffness along and across lbf/in, damping lbf·s/in, travel in.
    fn coil(&self, [preload, along, across, damping, travel]: [f64; 5]) -> Law {
        Law::Coil {
            preload: preload * POUND_FORCE,
            along: along * POUND_PER_INCH,
            across: across * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH * self.losses,
            travel: travel * INCH,
        }
    }

    /// Stiffness lbf/in, damping lbf·s/in, gap in; coefficient of friction, the slider's stiffness and
    /// damping.
    fn face(&mut self, [stiffness, damping, gap]: [f64; 3], slider: [f64; 3]) -> Law {
        self.sliders += 1;
        Law::Face {
            stiffness: stiffness * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH * self.losses,
            gap: gap * INCH,
            friction: slider[0] * self.losses,
            slider_stiffness: slider[1] * POUND_PER_INCH,
            slider_damping: slider[2] * POUND_PER_INCH * self.losses,
            slider: self.sliders - 1,
        }
    }

    /// Clearance in, stiffness lbf/in, damping lbf·s/in of a stop along x (0) or across (1).
    fn stop(&self, axis: usize, [clearance, stiffness, damping]: [f64; 3]) -> Law {
        Law::Stop {
            axis,
            clearance: clearance * INCH,
            stiffness: stiffness * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH * self.losses,
        }
    }

    /// A wedge at a nest: column, slope, pocket sides, control coil. `end` is +1 where its column lies ahead.
    fn wedge(&mut self, [wedge, bolster, frame]: [usize; 3], [x, y, end]: [f64; 3]) {
        let [height, width] = WEDGE;
        let (length, z) = (height * ANGLE.tan(), 18.0);
        let (center, column) = (x + 8.5 * end, x + end * (8.5 + length / 3.0));
        let middle = z + height / 6.0;
        let count = match self.faces {
            Faces::Corners => 2,
            Faces::Crowned => 9,
        };
        let share = 2.0 / count as f64;
        let mut faces = |half: [f64; 2], middle: V, crown: f64| {
            let mut points = Vec::with_capacity(2 * count);
            for (up, number) in [1.0, -1.0]
                .map(|up| (0..count).map(move |number| (up, number)))
                .into_iter()
                .flatten()
            {
                let left = width * (number as f64 / (count - 1) as f64 - 0.5);
                let place = [
                    middle[0] + end * up * half[0],
                    middle[1] + left,
                    middle[2] + up * half[1],
                ];
                let gap = 0.5 * crown * left * left;
                points.push((
                    place,
                    self.face(
                        [share * 2.5e5, share * 25.0, gap],
                        [0.4, share * 2.5e5, share * 250.0],
                    ),
                ));
            }
            points
        };
        let crown = if count > 2 { 1.0 / 240.0 } else { 0.0 };
        let on_column = faces([0.0, 0.5 * height], [column, y, middle], 0.0);
        let on_slope = faces(
            [0.5 * length, 0.5 * height],
            [column - 0.5 * end * length, y, middle],
            crown,
        );
        let sides = ([center, y, z], self.stop(1, [0.25, 1e6, 100.0]));
        let coil = self.coil([6303.0, 1937.0, 1317.0, 1.0, 1.4085]);
        self.link(wedge, frame, [-end, 0.0, 0.0], on_column);
        let normal = [end * ANGLE.cos(), 0.0, -ANGLE.sin()];
        self.link(wedge, bolster, normal, on_slope.into_iter().chain([sides]));
        let bottom = [center, y, z - height / 3.0];
        self.link(wedge, frame, [0.0, 0.0, 1.0], [(bottom, coil)]);
    }

    /// A nest: load coils, gib, lands.
    fn nest(&mut self, bolster: usize, frame: usize, [x, y]: [f64; 2]) {
        let coil = self.coil([12_252.1, 5369.5, 3616.0, 0.0, 1.406]);
        let gib = self.stop(1, [0.5, 4e6, 1000.0]);
        let land = self.stop(0, [0.21, 5e5, 50.0]);
        let mut points = vec![([x, y, 18.0], gib)];
        for [fore, left] in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            points.push(([x + 3.75 * fore, y + 3.75 * left, 13.0], coil));
            points.push(([x, y + 7.0 * left, 18.0 + 3.0 * fore], land));
        }
        self.link(bolster, frame, [0.0, 0.0, 1.0], points);
    }

    /// An adapter: its points at the height of the axle, so that bearings pass no moment on.
    fn adapter(&mut self, frame: usize, wheelset: usize, [x, y]: [f64; 2]) {
        let mut points = vec![([x, y, 18.0], self.stop(1, [0.25, 1e6, 100.0]))];
        for across in [3.0, -3.0] {
            let place = [x, y + across, 18.0];
            points.push((place, self.face([1e6, 1000.0, 0.0], [0.5, 1e6, 1e3])));
            points.push((place, self.stop(0, [0.0468, 5e5, 50.0])));
        }
        self.link(frame, wheelset, [0.0, 0.0, 1.0], points);
    }

    /// A center plate with its rim, and two side bearings.
    fn plate(&mut self, bolster: usize, x: f64, lading: Lading) {
        let mut points = Vec::new();
        for radius in [7.0, 7.0 / 3.0] {
            for [fore, left] in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
                let place = [x + radius * fore, radius * left, 30.0];
                points.push((place, self.face([6e6, 1000.0, 0.0], [0.2, 2e6, 2e3])));
            }
        }
        let rim = Law::Rim {
            clearance: 0.1875 * INCH,
            stiffness: 1e6 * POUND_PER_INCH,
            damping: 500.0 * POUND_PER_INCH * self.losses,
        };
        points.push(([x, 0.0, 30.0], rim));
        for left in [25.0, -25.0] {
            let place = [x, left, 30.0];
            match lading {
                Lading::Loaded => {
                    points.push((place, self.face([1e6, 500.0, 0.25], [0.0, 1e5, 0.0])));
                }
                Lading::Empty => {
                    // 6,000 lbf in the nominal place, then solid.
                    points.push((place, self.face([6000.0, 0.0, -1.0], [0.3, 1e5, 100.0])));
                    points.push((place, self.face([1e6, 500.0, 0.625], [0.0, 1e5, 0.0])));
                }
            }
        }
        self.link(0, bolster, [0.0, 0.0, 1.0], points);
    }
}

impl Car {
    /// Returns a car in its nominal place, that of the loaded one, at a speed (m/s).
    pub fn new(lading: Lading, losses: Losses, faces: Faces, speed: f64, waves: Vec<Wave>) -> Self {
        let mut parts = Parts {
            faces,
            bodies: Vec::with_capacity(BODIES),
            links: Vec::new(),
            points: Vec::new(),
            sliders: 0,
            losses: if losses == Losses::All { 1.0 } else { 0.0 },
        };
        match lading {
            Lading::Loaded => parts.body(243_460.0, [1.81e6, 1.624e7, 1.624e7], [0.0, 0.0, 83.75]),
            Lading::Empty => parts.body(43_060.0, [3.75e5, 3.61e6, 3.61e6], [0.0, 0.0, 65.0]),
        };
        let (ends, sides) = ([1.0, -1.0], [1.0, -1.0]);
        for truck in ends {
            parts.body(1300.0, [2915.0, 142.0, 2930.0], [TRUCK * truck, 0.0, 22.0]);
        }
        for (truck, side) in ends.map(|truck| sides.map(|side| (truck, side))).concat() {
            parts.body(
                1150.5,
                [900.0, 1370.0, 1370.0],
                [TRUCK * truck, NEST * side, 18.0],
            );
        }
        for truck in ends {
            for (side, end) in sides.map(|side| ends.map(|end| (side, end))).concat() {
                let place = [TRUCK * truck + 8.5 * end, NEST * side, 18.0];
                parts.body(50.0, [1.461, 0.3756, 1.295], place);
            }
        }
        for (truck, end) in ends.map(|truck| ends.map(|end| (truck, end))).concat() {
            let place = [TRUCK * truck + 35.0 * end, 0.0, 18.0];
            parts.body(2984.5, [6870.0, 1018.0, 6870.0], place);
        }
        for (truck, middle) in [TRUCK, -TRUCK].into_iter().enumerate() {
            let bolster = 1 + truck;
            parts.plate(bolster, middle, lading);
            for (side, left) in sides.into_iter().enumerate() {
                let (frame, y) = (3 + 2 * truck + side, NEST * left);
                parts.nest(bolster, frame, [middle, y]);
                for (number, end) in ends.into_iter().enumerate() {
                    let wedge = 7 + 4 * truck + 2 * side + number;
                    parts.wedge([wedge, bolster, frame], [middle, y, end]);
                    let wheelset = WHEELSETS + 2 * truck + number;
                    parts.adapter(frame, wheelset, [middle + 35.0 * end, y]);
                }
            }
        }
        let mut state = vec![0.0; STATES * BODIES + 2 * parts.sliders];
        for (number, body) in parts.bodies.iter().enumerate() {
            let own = &mut state[STATES * number..STATES * (number + 1)];
            own[..3].copy_from_slice(&body.center);
            own[3] = 1.0;
            own[11] = if number >= WHEELSETS { speed / RADIUS } else { 0.0 };
        }
        let bodies = std::array::from_fn(|number| parts.bodies[number]);
        Self {
            bodies,
            links: parts.links,
            points: parts.points,
            wheels: [0.4 * parts.losses, parts.losses],
            hertz: Hertz::steel(),
            waves,
            speed,
            time: 0.0,
            loads: [[0.0; 2]; 4],
            acceleration: [0.0; 3],
            normals: vec![0.0; parts.sliders],
            poses: Default::default(),
            stages: [0; 3].map(|_| vec![0.0; state.len()]),
            state,
        }
    }

    /// Returns the weight of the car, N.
    pub fn weight(&self) -> f64 {
        self.bodies.iter().map(|own| own.mass).sum::<f64>() * super::GRAVITY
    }
}

/// Returns waves as of a rough track: twist, bounce, alignment and short dips, their sizes a guess.
#[must_use]
pub fn rough() -> Vec<Wave> {
    let wave = |length: f64, size: [f64; 2], against: bool| Wave {
        start: 60.0 * 0.3048 + TRUCK * INCH,
        length: length * 0.3048,
        size: size.map(|own| own * INCH),
        against,
    };
    vec![
        wave(39.0, [0.4, 0.0], true),
        wave(60.0, [0.6, 0.0], false),
        wave(45.0, [0.0, 0.4], false),
        wave(19.5, [0.2, 0.1], false),
    ]
}
