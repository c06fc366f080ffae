//! Plausibility of geometry: wedges, trucks and cars as nobody builds them, which are runs all the same.
//!
//! What makes no model is refused where it is read; here are warnings, each with what to do. The usual ranges
//! are wider than all in the sources at hand: wedge angles of 28 to 37.5 deg, wheelbases of 66 to 72 in.

use car::Wheels;
use truck::Geometry;
use wedge::parameters::Wear;

use crate::truck::sections::doubts_of_bearing;

const INCH: f64 = 0.0254;
/// Angles of wedges, rad: 15 and 60 deg.
const ANGLES: [f64; 2] = [
    15.0 * std::f64::consts::PI / 180.0,
    60.0 * std::f64::consts::PI / 180.0,
];
/// Difference of the wheels' radius and the truck's axle height that wear makes, m: 1.5 in.
const WORN_RADIUS: f64 = 1.5 * INCH;
/// Width of a tread beyond its tape circle, m: 3 in, with the flange 2.5 in on the other side (remembered).
const TREAD: f64 = 3.0 * INCH;

/// Returns the warning about a wedge's angle (rad).
pub(crate) fn of_angle(angle: f64) -> Option<String> {
    let [low, high] = ANGLES;
    (!(low..=high).contains(&angle)).then(|| {
        format!(
            "a wedge angle of {:.4} deg is none that trucks have: 28 to 45 deg are usual, between slope and \
             vertical; look whether it was counted from the horizontal, or is in another unit",
            angle.to_degrees()
        )
    })
}

/// Returns the warnings about a truck, with wheels of a radius (m) whose tape circles have a distance (m).
pub(crate) fn of_truck(own: &truck::Parameters, wheels: Option<[f64; 2]>) -> Vec<String> {
    let mut found = Vec::new();
    let at = &own.geometry;
    let inch = |value: f64| format!("{:.2} in", value / INCH);
    let [wedge, ..] = &own.wedges;
    let length = wedge.height * libm::tan(wedge.angle);
    let [inner, outer] = [
        at.wedge_distance - 2.0 / 3.0 * length,
        at.wedge_distance + length / 3.0,
    ];
    if inner < 0.0 {
        found.push(format!(
            "leading and trailing wedges overlap by {}: they are {} long, and their centers of gravity {} \
             from the truck's center; give wedge.distance or side_frame.column_distance",
            inch(-2.0 * inner),
            inch(length),
            inch(at.wedge_distance)
        ));
    }
    if outer > at.axle() {
        found.push(format!(
            "columns are {} from the truck's center, beyond the axles at {}; look at wedge.distance and \
             truck.wheelbase",
            inch(outer),
            inch(at.axle())
        ));
    }
    if at.adapter_height < at.axle_height {
        found.push(format!(
            "adapters carry at {}, below the axles at {}; heights are above the top of rail: look at \
             adapter.height and truck.axle_height",
            inch(at.adapter_height),
            inch(at.axle_height)
        ));
    }
    if let Some(wheels) = wheels {
        found.extend(beside_wheels(at, wheels));
    }
    found.extend(
        own.car_body
            .iter()
            .flat_map(|car| doubts_of_bearing(&car.side_bearings.kind)),
    );
    found
}

/// Returns the warnings about a truck beside its wheels.
fn beside_wheels(at: &Geometry, [radius, tape_distance]: [f64; 2]) -> Vec<String> {
    let inch = |value: f64| format!("{:.2} in", value / INCH);
    let mut found = Vec::new();
    let lower = at.axle_height - radius;
    if lower.abs() > WORN_RADIUS {
        found.push(format!(
            "wheels have a radius of {}, but the truck is made for axles at {}: it stands {} {}, with all on \
             it; give truck.axle_height and the other heights of a truck for these wheels",
            inch(radius),
            inch(at.axle_height),
            inch(lower.abs()),
            if lower > 0.0 { "lower" } else { "higher" }
        ));
    }
    let outside = tape_distance + 2.0 * TREAD;
    for (key, distance) in [
        ("journal_distance", at.journal_distance),
        ("nest_distance", at.nest_distance),
    ] {
        if distance < outside {
            found.push(format!(
                "truck.{key} is {}, but the outer sides of the wheels are {} apart: journals and side frames \
                 of a three-piece truck are outside of its wheels; look at the unit",
                inch(distance),
                inch(outside)
            ));
        }
    }
    found
}

/// Returns the warnings about a car.
pub(crate) fn of_car(own: &car::Parameters) -> Vec<String> {
    let tape_distance = match &own.wheels {
        Wheels::OnRails(wheels) => wheels.tape_distance,
        Wheels::Linear { wheelset, .. } => 2.0 * wheelset.geometry.half_distance,
    };
    let wheels = Some([own.wheel_radius(), tape_distance]);
    let [mut once, rear] = own.trucks.each_ref().map(|truck| of_truck(truck, wheels));
    // Both trucks are mostly alike.
    once.extend(
        rear.into_iter()
            .filter(|words| !once.contains(words))
            .collect::<Vec<_>>(),
    );
    let plate = own.plate_heights().into_iter().fold(f64::INFINITY, f64::min);
    let mut low = |what: String, height: f64, key: &str| {
        if height < plate {
            once.push(format!(
                "the center of gravity of {what} is {:.1} in above the top of rail, below the center \
                 plates at {:.1} in: heights are counted from the rail, not from the body's floor; look at \
                 {key}",
                height / INCH,
                plate / INCH
            ));
        }
    };
    low("the car body".to_owned(), own.body.height, "car.height");
    for mass in &own.lading {
        low(
            format!("the lading \"{}\"", mass.name),
            mass.place[2],
            "its place in lading.masses",
        );
    }
    once
}

/// Returns the reason why a wedge of a height (m) and an angle (rad) is worn away: nothing of it would be
/// left.
pub(crate) fn worn_away(height: f64, angle: f64, wear: &Wear) -> Option<String> {
    let (length, across) = (height * libm::tan(angle), height * libm::sin(angle));
    let inch = |value: f64| format!("{:.3} in", value / INCH);
    let of = |what: &str, depth: f64, most: f64| {
        (depth >= most).then(|| {
            format!(
                "wear of {} at the {what} is more than there is of the wedge: it is {} thick there",
                inch(depth),
                inch(most)
            )
        })
    };
    of("column", wear.column, length).or_else(|| of("slope", wear.slope, across))
}
