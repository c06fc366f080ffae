//! The table of a wheelset's run: where it is on the track, its wheels' forces, their patches.

use std::borrow::Cow;

use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::Observation;
use quantity::Kind;
use rolling::rig::{RAILS, Rig, Setup, WHEELSET};
use rolling::wheelset::coordinate;
use wheelrail::contact::Side;
use wheelrail::track::Line;

use crate::patches::{self, Patches, unspun};

/// Names of the sides in columns.
pub const SIDES: [&str; 2] = ["left", "right"];
/// Columns of the wheelset: name, kind, what it is.
const WHOLE: [(&str, Kind, &str); 8] = [
    ("time", Kind::Time, "time"),
    ("distance", Kind::Length, "distance along the track, in plan"),
    ("speed", Kind::Speed, "speed along the track"),
    (
        "lateral",
        Kind::Length,
        "center of the wheelset from the center line, to the left",
    ),
    (
        "vertical",
        Kind::Length,
        "center of the wheelset above the nominal radius, up",
    ),
    (
        "roll",
        Kind::Angle,
        "roll of the axle to the plane of the track, left side up",
    ),
    (
        "yaw",
        Kind::Angle,
        "yaw to the track, to the left: the angle of attack",
    ),
    ("spin", Kind::Angle, "angle of the spin about the axle"),
];
/// Columns of a wheel, after its side.
const WHEEL: [(&str, Kind, &str); 8] = [
    (
        "vertical_force",
        Kind::Force,
        "force of the wheel on the rail, square to the track, down",
    ),
    (
        "lateral_force",
        Kind::Force,
        "force of the wheel on the rail in the plane of the track, positive where it spreads the gauge",
    ),
    (
        "longitudinal_force",
        Kind::Force,
        "force of the rail on the wheel along the track",
    ),
    (
        "lateral_over_vertical",
        Kind::Dimensionless,
        "lateral over vertical force (L/V); 0 where the wheel does not press",
    ),
    (
        "wear_number",
        Kind::Force,
        "creep forces and spin moments times creepages: energy lost by distance",
    ),
    ("patches", Kind::Count, "number of contact patches"),
    (
        "rail_lateral",
        Kind::Length,
        "lateral irregularity of the rail under the wheel, to the left",
    ),
    (
        "rail_vertical",
        Kind::Length,
        "vertical irregularity of the rail under the wheel, up",
    ),
];
/// Columns of the ledger.
const LEDGER: [(&str, Kind, &str); 4] = [
    (
        "work",
        Kind::Energy,
        "work of the drive, the load and the part of contacts that does not come back, since the start",
    ),
    (
        "losses",
        Kind::Energy,
        "lost in creep and damping since the start",
    ),
    (
        "stored_energy_change",
        Kind::Energy,
        "energy stored since the start",
    ),
    (
        "energy_residual",
        Kind::Energy,
        "work less losses less stored energy",
    ),
];

/// Returns the columns, in their order.
#[must_use]
pub fn columns() -> Vec<Column> {
    let column = |name: String, kind: Kind, text: &str| Column {
        name,
        kind,
        frame: Cow::Borrowed("track: x along, y to the left, z up, at the wheelset"),
        reference: Cow::Borrowed("center of the wheelset"),
        text: text.to_owned(),
    };
    let whole = WHOLE
        .iter()
        .map(|(name, kind, text)| column((*name).to_owned(), *kind, text));
    let mut all: Vec<Column> = whole.collect();
    for side in SIDES {
        for (name, kind, text) in WHEEL {
            all.push(column(
                format!("{side}_{name}"),
                kind,
                &format!("{side} wheel: {text}"),
            ));
        }
    }
    for side in SIDES {
        patches::columns(side, |name, kind, text| all.push(column(name, kind, &text)));
    }
    let ledger = LEDGER
        .iter()
        .map(|(name, kind, text)| column((*name).to_owned(), *kind, text));
    all.extend(ledger);
    all
}

/// Reads the rows of a rig.
#[derive(Clone, Debug)]
pub struct RigReader {
    rig: Rig,
    setup: Setup,
    radius: f64,
    /// Numbers of the wheels among the elements.
    elements: [usize; 2],
}

impl RigReader {
    /// Returns the reader of a rig, whose wheels have a nominal radius (m).
    #[must_use]
    pub fn new(rig: Rig, setup: Setup, radius: f64) -> Self {
        // The carriage comes first, then each wheel after its sprung rail.
        let elements = if setup.support.is_some() { [2, 4] } else { [1, 2] };
        Self {
            rig,
            setup,
            radius,
            elements,
        }
    }

    /// Returns the rig.
    #[must_use]
    pub fn rig(&self) -> &Rig {
        &self.rig
    }

    /// Appends the values of a row.
    pub fn read(&self, seen: &Observation, entries: &Entries, row: &mut Vec<f64>) {
        let lines = &self.setup.lines;
        let [distance, lateral, height, yaw, roll] = self.rig.relative(lines, seen);
        let body = &seen.bodies[WHEELSET];
        let section = lines.section(Line::Center, body.origin.0);
        let speed = section.of(body.velocity.0)[0];
        let spin = body.coordinates[coordinate::SPIN];
        row.extend([
            seen.time,
            distance,
            speed,
            lateral,
            height - self.radius,
            roll,
            yaw,
            spin,
        ]);
        let axes = unspun(body.rotation.column(0), &section);
        let mut wheels = [Patches::default(), Patches::default()];
        self.rig.patches(seen, |side, patch| {
            let index = usize::from(side == Side::Right);
            // Places are counted from the rail, which gives way.
            let rail = self
                .setup
                .support
                .is_some()
                .then(|| seen.bodies[RAILS[index]].origin);
            let center = rail.map_or(body.origin, |rail| body.origin - rail);
            wheels[index].take(&patch, side, axes, center);
        });
        for (index, wheel) in wheels.iter_mut().enumerate() {
            let sign = [1.0, -1.0][index];
            let force = seen.elements[self.elements[index]].force;
            let [longitudinal, left, vertical] = section.of(force.0);
            let spreading = -sign * left;
            let ratio = if vertical > 0.0 { spreading / vertical } else { 0.0 };
            wheel.merge();
            let rail = self.setup.lines.irregularities(distance)[index];
            row.extend([
                vertical,
                spreading,
                longitudinal,
                ratio,
                wheel.wear,
                wheel.count() as f64,
                rail[0],
                rail[1],
            ]);
        }
        for wheel in &wheels {
            row.extend(wheel.values());
        }
        row.extend([
            entries.work,
            entries.losses,
            entries.stored_change,
            entries.residual,
        ]);
    }
}
