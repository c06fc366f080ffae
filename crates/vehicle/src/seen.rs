//! What is seen of the bodies of a vehicle: by its fixed axes or, on a track, by those of the track.

use std::borrow::Cow;
use std::sync::Arc;

use car::{ClimbLimits, TRUCK_PARTS, WheelLoads, ratio};
use mechanics::body::Body;
use mechanics::orientation::fixed;
use mechanics::output::Column;
use mechanics::vector::{Matrix, Vector};
use quantity::Kind;
use truck::{MountedTruck, TruckFrame, WEDGE_NAMES};
use wheelrail::track::{Line, RailLines, TrackSection};

use crate::assemble::nominal_center;
use crate::body::RigidBody;
use crate::channel::{Channels, View, column};
use crate::on_track::{Accelerometer, Axle, AxleState, SIDES, section};

/// Names of coordinates in columns, with what they measure.
const COORDINATES: [(&str, &str); 6] = [
    ("x", "forward"),
    ("y", "to the left"),
    ("z", "up"),
    ("roll", "roll"),
    ("pitch", "pitch"),
    ("yaw", "yaw"),
];

/// Returns what is seen of a body: displacements of its center of gravity and rotations from the nominal
/// layout, their rates, accelerations.
pub(crate) fn body_channels(number: usize, body: &RigidBody) -> Vec<Channels> {
    let moves = std::array::from_fn(|k| body.moves(k));
    channels_of(number, &body.name, body.place, moves, !body.is_prescribed())
}

/// Returns the same of a body of an element's own.
pub(crate) fn own_channels(number: usize, body: &Body) -> Vec<Channels> {
    channels_of(number, &body.name, nominal_center(body), body.free, false)
}

fn channels_of(number: usize, name: &str, place: [f64; 3], moves: [bool; 6], is_free: bool) -> Vec<Channels> {
    let mut all = Vec::new();
    let mut add = |suffix: &str, kind: Kind, text: String, read: Read| {
        let mut column = column(format!("{name}_{suffix}"), kind, format!("{name}: {text}"));
        column.reference = Cow::Borrowed("center of gravity");
        all.push(Channels::single(column, read));
    };
    for (k, (suffix, along)) in COORDINATES.into_iter().enumerate().filter(|(k, _)| moves[*k]) {
        let (kind, text) = match k {
            0..3 => (
                Kind::Length,
                format!("displacement of the center of gravity {along}"),
            ),
            _ => (Kind::Angle, format!("{along} from the nominal layout")),
        };
        add(suffix, kind, text, displacement(number, k, place));
    }
    for (k, (suffix, along)) in COORDINATES.into_iter().enumerate().filter(|(k, _)| moves[*k]) {
        let (kind, text) = match k {
            0..3 => (Kind::Speed, format!("velocity of the center of gravity {along}")),
            _ => (
                Kind::AngularSpeed,
                format!("angular velocity about the axis of {along}"),
            ),
        };
        add(&format!("{suffix}_rate"), kind, text, rate(number, k));
    }
    let accelerated = COORDINATES.into_iter().enumerate().take(3);
    for (k, (suffix, along)) in accelerated.filter(|(k, _)| moves[*k] && is_free) {
        let text = format!("acceleration {along}");
        add(
            &format!("{suffix}_acceleration"),
            Kind::RideAcceleration,
            text,
            Box::new(move |view| view.acceleration(number, k)),
        );
    }
    all
}

type Read = Box<dyn Fn(&View<'_>) -> f64 + Send + Sync>;

fn displacement(number: usize, k: usize, place: [f64; 3]) -> Read {
    match k {
        0..3 => Box::new(move |view| view.seen.bodies[number].center_of_gravity.0[k] - place[k]),
        _ => Box::new(move |view| {
            let own = &view.seen.bodies[number];
            match view.system.bodies()[number].is_prescribed() {
                true => angle(&own.rotation, k),
                false => own.coordinates[k],
            }
        }),
    }
}

/// Returns roll, pitch or yaw (3, 4, 5) of a rotation `Ry(pitch) Rz(yaw) Rx(roll)`, rad; yaw beyond a quarter
/// turn where it is the only one.
fn angle(rotation: &Matrix<f64>, k: usize) -> f64 {
    let Matrix(r) = rotation;
    match k {
        3 => libm::atan2(-r[1][2], r[1][1]),
        4 => libm::atan2(-r[2][0], r[0][0]),
        _ if r[2][2] == 1.0 => libm::atan2(r[1][0], r[0][0]),
        _ => libm::asin(r[1][0].clamp(-1.0, 1.0)),
    }
}

fn rate(number: usize, k: usize) -> Read {
    match k {
        0..3 => Box::new(move |view| {
            let own = &view.seen.bodies[number];
            let arm = own.center_of_gravity - own.origin;
            let swing: Vector<f64> = own.angular_velocity.cross(arm);
            (own.velocity + swing).0[k]
        }),
        _ => Box::new(move |view| view.seen.bodies[number].angular_velocity.0[k - 3]),
    }
}

/// Columns of a body on a track.
const ON_TRACK: [(&str, Kind, &str); 10] = [
    (
        "distance",
        Kind::Distance,
        "distance of the center of gravity along the track",
    ),
    (
        "speed",
        Kind::TravelSpeed,
        "speed of the center of gravity along the track",
    ),
    (
        "y",
        Kind::Length,
        "center of gravity to the left of the center line",
    ),
    (
        "z",
        Kind::Length,
        "center of gravity above its nominal height, square to the plane of the track",
    ),
    ("roll", Kind::Angle, "roll to the track, left side up"),
    ("pitch", Kind::Angle, "pitch to the track, nose down"),
    ("yaw", Kind::Angle, "yaw to the track, to the left"),
    (
        "x_acceleration",
        Kind::RideAcceleration,
        "acceleration of the center of gravity along the track",
    ),
    (
        "y_acceleration",
        Kind::RideAcceleration,
        "acceleration of the center of gravity to the left",
    ),
    (
        "z_acceleration",
        Kind::RideAcceleration,
        "acceleration of the center of gravity up",
    ),
];

/// Returns what is seen of a body on a track; `place` is its center of gravity in the nominal layout, m.
pub(crate) fn on_track(number: usize, name: &str, place: [f64; 3], lines: &Arc<RailLines>) -> Channels {
    let columns = ON_TRACK.into_iter().map(|(ending, kind, text)| Column {
        frame: Cow::Borrowed("track: along, to the left, up, at the body"),
        reference: Cow::Borrowed("center of gravity"),
        ..column(format!("{name}_{ending}"), kind, format!("{name}: {text}"))
    });
    let (height, lines) = (place[2], lines.clone());
    Channels::new(columns.collect(), move |view, row| {
        row.extend(seen_on_track(view, number, height, &lines));
    })
}

/// Returns the values of [`ON_TRACK`].
fn seen_on_track(view: &View<'_>, number: usize, height: f64, lines: &RailLines) -> [f64; 10] {
    let own = &view.seen.bodies[number];
    let at = section(lines, own);
    let of = |vector: Vector<f64>| at.of(vector.0);
    let [_, y, z] = of(own.center_of_gravity - Vector(at.origin));
    let frame = fixed(view.system.bodies()[number].frame.orientation);
    let turned: Matrix<f64> = own.rotation.times(frame.transpose());
    let axes = [0, 1, 2].map(|axis| of(turned.column(axis)));
    let along_frame = [0, 1, 2].map(|axis| view.acceleration(number, axis));
    let acceleration = of(frame.apply(Vector(along_frame)));
    [
        at.distance,
        of(own.velocity)[0],
        y,
        z - height,
        libm::atan2(axes[1][2], axes[2][2]),
        libm::asin((-axes[0][2]).clamp(-1.0, 1.0)),
        libm::atan2(axes[0][1], axes[0][0]),
        acceleration[0],
        acceleration[1],
        acceleration[2],
    ]
}

/// How a channel of a wheelset is read.
type ReadAxle = fn(&AxleState) -> f64;

const VERTICAL: &str = "vertical force of the wheel on its rail, square to the track, down";
const LATERAL: &str = "lateral force of the wheel on its rail, positive where it spreads the gauge";
const OVER: &str = "lateral over vertical force; zero below a hundredth of the static load, or where it \
                    carries nothing";
const NADAL: &str = "L/V over Nadal's limit for the angle of the wheel's own flange and the friction of its \
                     rail there, where nothing slips";
const WEINSTOCK: &str = "sizes of both wheels' L/V over Weinstock's limit: Nadal's for the flange that \
                         bears, and the friction of the other tread";
const ANGLE: &str = "angle of the contact that carries most, against the track's plane, positive where it \
                     rises to the field side; zero without contact";
const LIFT: &str = "how far the wheel must be lowered until it bears on its rail; zero while it bears";
const RAIL_ROLL: &str = "roll of the rail under the wheel about its base, outwards";
const WIDENING: &str = "how far the heads of both rails have moved apart under the wheelset";
const WEAR: &str = "energy that creep takes by the distance: creep forces times creepages";

/// Columns of a wheelset, the wheels' after these.
const OF_AXLE: [(&str, Kind, &str, ReadAxle); 7] = [
    ("distance", Kind::Distance, "distance along the track", |own| {
        own.distance
    }),
    ("y", Kind::Length, "to the left of the center line", |own| {
        own.lateral
    }),
    ("z", Kind::Length, "center above the nominal radius", |own| {
        own.vertical_place
    }),
    (
        "roll",
        Kind::Angle,
        "roll of the axle to the plane of the track, left side up",
        |own| own.roll,
    ),
    ("spin", Kind::Angle, "angle of the spin", |own| own.spin),
    ("yaw", Kind::Angle, "yaw to the track, to the left", |own| own.yaw),
    (
        "lateral_force",
        Kind::Force,
        "force of both wheels on the track along its plane, positive to the left",
        |own| own.wheels[0].lateral - own.wheels[1].lateral,
    ),
];

/// How a channel of a wheel is read.
type ReadWheel = fn(&WheelLoads) -> f64;

/// Columns of a wheel.
const OF_WHEEL: [(&str, Kind, &str, ReadWheel); 5] = [
    ("vertical_force", Kind::Force, VERTICAL, |own| own.vertical),
    ("lateral_force", Kind::Force, LATERAL, |own| own.lateral),
    ("contact_angle", Kind::Angle, ANGLE, |own| own.contact_angle),
    ("lift", Kind::Length, LIFT, |own| own.lift),
    ("wear_number", Kind::Force, WEAR, |own| own.wear_number),
];

/// Returns what is seen of a wheelset of a number, whose wheels have these static loads (N; zero: not known)
/// and flanges.
pub(crate) fn of_axle(
    (axle, number): (&Axle, usize),
    loads: [f64; 2],
    limits: &Arc<ClimbLimits>,
) -> Channels {
    let own = |ending: &str, kind: Kind, text: &str| Column {
        frame: Cow::Borrowed("track: along, to the left, up, at the wheelset"),
        ..column(
            format!("{}_{ending}", axle.name),
            kind,
            format!("{}: {text}", axle.name),
        )
    };
    let mut columns: Vec<Column> = OF_AXLE
        .iter()
        .map(|(ending, kind, text, _)| own(ending, *kind, text))
        .collect();
    for side in SIDES {
        let of_wheel = OF_WHEEL.iter();
        columns.extend(of_wheel.map(|(ending, kind, text, _)| own(&format!("{side}_{ending}"), *kind, text)));
        columns.push(own(&format!("{side}_l_over_v"), Kind::Dimensionless, OVER));
        columns.push(own(&format!("{side}_nadal_share"), Kind::Dimensionless, NADAL));
    }
    columns.push(own("weinstock_share", Kind::Dimensionless, WEINSTOCK));
    let on_beams = axle.is_on_beams();
    if on_beams {
        let of_sides = SIDES.map(|side| own(&format!("{side}_rail_roll"), Kind::Angle, RAIL_ROLL));
        columns.extend(of_sides);
        columns.push(own("gauge_widening", Kind::Length, WIDENING));
    }
    let (axle, limits) = (axle.clone(), limits.clone());
    Channels::new(columns, move |view, row| {
        let state = axle.state(view.seen);
        row.extend(OF_AXLE.map(|(.., read)| read(&state)));
        let limits = limits.at(number, state.distance);
        let ratios = [0, 1].map(|side| {
            let wheel = &state.wheels[side];
            ratio(wheel.lateral, wheel.vertical, loads[side])
        });
        for (side, wheel) in state.wheels.iter().enumerate() {
            row.extend(OF_WHEEL.map(|(.., read)| read(wheel)));
            row.extend([ratios[side], ratios[side] / limits.nadal[side]]);
        }
        row.push(limits.weinstock_share(ratios));
        if on_beams {
            row.extend(state.wheels.map(|wheel| wheel.rail_roll));
            row.push(state.gauge_widening);
        }
    })
}

/// Returns the ratios of the sides of a truck, whose wheels have these static loads (N; zero: not known).
pub(crate) fn of_sides(name: &str, axles: [&Axle; 2], loads: [[f64; 2]; 2]) -> Channels {
    let columns = SIDES.map(|side| {
        let text = format!(
            "{name}: lateral over vertical forces of both wheels of the side; zero below a hundredth of the \
             static load"
        );
        column(format!("{name}_{side}_side_l_over_v"), Kind::Dimensionless, text)
    });
    let axles = axles.map(Clone::clone);
    Channels::new(columns.to_vec(), move |view, row| {
        let states = axles.each_ref().map(|axle| axle.state(view.seen).wheels);
        row.extend([0, 1].map(|side| {
            let sum = |force: fn(&WheelLoads) -> f64| force(&states[0][side]) + force(&states[1][side]);
            let load = loads[0][side] + loads[1][side];
            ratio(sum(|own| own.lateral), sum(|own| own.vertical), load)
        }));
    })
}

/// Returns what an accelerometer shows, on a body with this center of gravity in the nominal layout (m).
pub(crate) fn of_accelerometer(own: &Accelerometer, center: [f64; 3], gravity: f64) -> Channels {
    let felt = "as an accelerometer shows it along the body's";
    let columns = [
        ("lateral", "left: with gravity's part by roll and superelevation"),
        ("vertical", "up, less gravity"),
    ]
    .map(|(direction, text)| Column {
        frame: Cow::Borrowed("body: left, up"),
        ..column(
            format!("{}_{direction}_acceleration", own.name),
            Kind::RideAcceleration,
            format!("{}: {felt} {text}", own.name),
        )
    });
    let arm = [0, 1, 2].map(|k| own.at[k] - center[k]);
    let number = own.body;
    Channels::new(columns.to_vec(), move |view, row| {
        let [_, left, up] = felt_at(view, number, arm, gravity);
        row.extend([left, up - gravity]);
    })
}

/// Returns what a body shows at an arm from its center of gravity (nominal layout, m), along its own axes
/// forward, left, up, m/s².
fn felt_at(view: &View<'_>, number: usize, arm: [f64; 3], gravity: f64) -> [f64; 3] {
    let own = &view.seen.bodies[number];
    let nominal = fixed(view.system.bodies()[number].frame.orientation);
    let turned: Matrix<f64> = own.rotation.times(nominal.transpose());
    let way: Vector<f64> = turned.apply(Vector(arm));
    let from_origin = own.center_of_gravity + way - own.origin;
    let shown = car::accelerometer((view.system, gravity), (number, own), from_origin, view.rates);
    [0, 1, 2].map(|k| turned.column(k).dot::<f64, f64>(shown))
}

/// Returns the lateral accelerations of bolster and side frames of a truck, by their numbers.
pub(crate) fn of_truck_parts(name: &str, parts: [usize; 3], gravity: f64) -> Channels {
    let columns = TRUCK_PARTS.map(|part| {
        column(
            format!("{name}_{part}_lateral_acceleration"),
            Kind::RideAcceleration,
            format!(
                "{name}_{part}: at its center of gravity, as an accelerometer shows it along its left: with \
                 gravity's part by roll and superelevation"
            ),
        )
    });
    Channels::new(columns.to_vec(), move |view, row| {
        row.extend(parts.map(|number| felt_at(view, number, [0.0; 3], gravity)[1]));
    })
}

/// Returns what is seen of a truck, whose bolster has this number.
pub(crate) fn of_truck(
    name: &str,
    bolster: usize,
    mounted: &MountedTruck,
    lines: &Arc<RailLines>,
) -> Channels {
    let own = |ending: &str, kind: Kind, text: &str| {
        column(format!("{name}_{ending}"), kind, format!("{name}: {text}"))
    };
    let mut columns = vec![own(
        "warp_angle",
        Kind::Angle,
        "mean yaw of the side frames less that of the bolster",
    )];
    columns.extend(["left", "right"].map(|side| {
        let ending = format!("{side}_nest_vertical_force");
        own(&ending, Kind::Force, "load of a nest with its wedges")
    }));
    columns.extend(WEDGE_NAMES.map(|wedge| {
        let text = format!("normal force of the column, {} wedge", wedge.replace('_', " "));
        own(&format!("{wedge}_column_normal"), Kind::Force, &text)
    }));
    let (mounted, lines) = (mounted.clone(), lines.clone());
    Channels::new(columns, move |view, row| {
        let place = view.seen.bodies[bolster].center_of_gravity;
        let at: TrackSection<f64> = lines.section(Line::Center, place.0);
        let frame = TruckFrame {
            origin: Vector(at.origin),
            axes: Matrix(at.axes).transpose(),
        };
        let loads = mounted.loads(view.seen, &frame);
        row.push(loads.warp_angle);
        row.extend(loads.nest_vertical);
        row.extend((0..WEDGE_NAMES.len()).map(|i| loads.wedges[i].column_normal));
    })
}
