//! Where the parts of a truck are: keys of the sections of these parts.

use truck::{Geometry, Wedge};

use super::HEIGHT;
use crate::case::problem::Problem;
use crate::reader::{CaseReader, LENGTH};

const INCH: f64 = 0.0254;

/// Keys of the truck itself.
pub(crate) fn truck_places(r: &mut CaseReader<'_>, own: &mut Geometry) {
    let mut length = |key, value: &mut f64, comment: &str| r.quantity(key, LENGTH, value, comment);
    length("wheelbase", &mut own.wheelbase, "from axle to axle");
    let comment = "from nest to nest across, where side frames, wedges and gibs are";
    length("nest_distance", &mut own.nest_distance, comment);
    let comment = "from journal to journal across, where adapters are";
    length("journal_distance", &mut own.journal_distance, comment);
    let comment = "in the nominal layout: radius of the wheels that it is made for; smaller ones let it sink";
    r.quantity("axle_height", HEIGHT, &mut own.axle_height, comment);
}

/// Keys of the wedges.
pub(crate) fn wedge_places(r: &mut CaseReader<'_>, own: &mut Geometry) {
    let comment = "from the truck's center along the track to the center of gravity, and to the lands";
    if r.has("side_frame.column_distance") && !r.has("wedge.distance") {
        r.expect("wedge", &["distance"]);
    } else {
        r.quantity("distance", LENGTH, &mut own.wedge_distance, comment);
    }
    let comment = "of the center of gravity above the top of rail";
    r.quantity("center_height", HEIGHT, &mut own.wedge_height, comment);
}

/// The key of side frames that says where their columns are, in place of the wedges' distance.
pub(crate) fn columns(r: &mut CaseReader<'_>, own: &mut Geometry, wedge: &Wedge) {
    let third = wedge.height * libm::tan(wedge.angle) / 3.0;
    let mut distance = None;
    let comment = "from the face of a wedge's column to that of the other, in place of wedge.distance: \
                   wedges are then a third of their length from them";
    r.optional("column_distance", LENGTH, &mut distance, "\"19.55 in\"", comment);
    let Some(distance) = distance else { return };
    let wrong = |message: String, help: &str| Problem::new(message).label("columns").help(help);
    if r.has("wedge.distance") {
        let message = "`side_frame.column_distance` and `wedge.distance` say the same".to_owned();
        r.problem(
            "side_frame.column_distance",
            wrong(message, "leave one of them out"),
        );
    } else if 0.5 * distance <= third {
        let message = format!(
            "columns {:.2} in apart leave no room for a wedge that is {:.2} in long",
            distance / INCH,
            3.0 * third / INCH
        );
        r.problem(
            "side_frame.column_distance",
            wrong(message, "about 20 in is usual"),
        );
    } else {
        own.wedge_distance = 0.5 * distance - third;
    }
}

pub(super) fn seat(r: &mut CaseReader<'_>, own: &mut Geometry) {
    let comment = "at which the coils hold sideways, above the top of rail";
    r.quantity("seat_height", HEIGHT, &mut own.seat_height, comment);
}

pub(super) fn gib(r: &mut CaseReader<'_>, own: &mut Geometry) {
    let comment = "of the gibs above the top of rail";
    r.quantity("height", HEIGHT, &mut own.gib_height, comment);
}

pub(super) fn lands(r: &mut CaseReader<'_>, own: &mut Geometry) {
    let comment = "of their middle above the top of rail";
    r.quantity("height", HEIGHT, &mut own.land_height, comment);
    let [aside, high] = &mut own.lands;
    r.quantity(
        "half_width",
        LENGTH,
        aside,
        "from the middle of a nest to a land across",
    );
    r.quantity("half_height", LENGTH, high, "from their middle up and down");
}

/// Keys of adapters; steel ones have points and stops.
pub(super) fn adapter(r: &mut CaseReader<'_>, own: &mut Geometry, steel: bool) {
    let comment = "at which it carries, above the top of rail";
    r.quantity("height", HEIGHT, &mut own.adapter_height, comment);
    if steel {
        let [points, stops] = &mut own.adapter;
        r.quantity(
            "point_distance",
            LENGTH,
            points,
            "from its middle across to each of the two points",
        );
        r.quantity(
            "stop_distance",
            LENGTH,
            stops,
            "from its middle across to each of the two stops",
        );
    }
}
