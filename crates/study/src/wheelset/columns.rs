//! The table of a wheelset's run: where it is on the track, its wheels' forces, their patches.

use std::borrow::Cow;

use mechanics::energy_balance::Entries;
use mechanics::output::Column;
use mechanics::system::Observation;
use mechanics::vector::Vector;
use quantity::Kind;
use rolling::rig::{Rig, Setup, WHEELSET};
use rolling::wheel::PatchState;
use rolling::wheelset::coordinate;
use wheelrail::contact::Side;
use wheelrail::track::{Line, Section};

/// Names of the sides in columns.
pub const SIDES: [&str; 2] = ["left", "right"];
/// Patches of a wheel that have columns, from the field side to the gauge side.
pub const PATCHES: usize = 3;
/// A patch with a smaller share is shown as a part of its neighbor.
const HALF: f64 = 0.5;

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
/// Columns of a wheel, behind its side.
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
/// Columns of a patch, behind its side and number.
const PATCH: [(&str, Kind, &str); 9] = [
    ("x", Kind::Length, "place from the wheelset's center, forward"),
    (
        "y",
        Kind::Length,
        "place from the wheelset's center, along the axle to the left",
    ),
    ("z", Kind::Length, "place from the wheelset's center, up"),
    (
        "angle",
        Kind::Angle,
        "contact angle, positive where the plane of contact rises to the field side",
    ),
    ("normal_force", Kind::Force, "normal force"),
    ("creep_x", Kind::Force, "creep force on the wheel, forward"),
    (
        "creep_y",
        Kind::Force,
        "creep force on the wheel in the plane of contact, to the left",
    ),
    ("a", Kind::Length, "semi-axis of the ellipse along the rail"),
    ("b", Kind::Length, "semi-axis of the ellipse across the rail"),
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
        for number in 1..=PATCHES {
            for (name, kind, text) in PATCH {
                let text = format!("{side} wheel, patch {number} from the field side: {text}");
                all.push(column(format!("{side}_patch_{number}_{name}"), kind, &text));
            }
        }
    }
    let ledger = LEDGER
        .iter()
        .map(|(name, kind, text)| column((*name).to_owned(), *kind, text));
    all.extend(ledger);
    all
}

/// A patch as rows have it: place, angle, forces with their shares, semi-axes.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    share: f64,
    place: [f64; 3],
    angle: f64,
    normal: f64,
    creep: [f64; 2],
    axes: [f64; 2],
}

/// What a wheel's patches sum up to.
#[derive(Clone, Debug, Default)]
struct Wheel {
    patches: Vec<Shown>,
    wear: f64,
}

/// Reads the rows of a rig.
#[derive(Clone, Debug)]
pub struct Reader {
    rig: Rig,
    setup: Setup,
    radius: f64,
    /// Numbers of the wheels among the elements.
    elements: [usize; 2],
}

impl Reader {
    /// Returns the reader of a rig, whose wheels have a nominal radius (m).
    #[must_use]
    pub fn new(rig: Rig, setup: Setup, radius: f64) -> Self {
        // The carriage comes first, then each wheel behind its sprung rail.
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
        let axes = axes(body.rotation.column(0), &section);
        let mut wheels = [Wheel::default(), Wheel::default()];
        self.rig.patches(seen, |side, patch| {
            let (index, sign) = match side {
                Side::Left => (0, 1.0),
                Side::Right => (1, -1.0),
            };
            wheels[index].take(&patch, sign, axes, body.origin);
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
                wheel.patches.len() as f64,
                rail[0],
                rail[1],
            ]);
        }
        for wheel in &wheels {
            for number in 0..PATCHES {
                let own = wheel.patches.get(number).copied().unwrap_or_default();
                let ([x, y, z], [creep_x, creep_y], [a, b]) = (own.place, own.creep, own.axes);
                row.extend([x, y, z, own.angle, own.normal, creep_x, creep_y, a, b]);
            }
        }
        row.extend([
            entries.work,
            entries.losses,
            entries.stored_change,
            entries.residual,
        ]);
    }
}

/// Axes of the wheelset that do not spin: forward, along the axle to the left, up.
fn axes(axle: Vector<f64>, section: &Section<f64>) -> [Vector<f64>; 3] {
    let up = Vector(section.axes[2]);
    let share: f64 = up.dot::<f64, f64>(axle);
    let up = up - axle.scale(share);
    let length: f64 = up.dot::<f64, f64>(up);
    let up: Vector<f64> = up.scale(1.0 / length.sqrt());
    [axle.cross::<f64, f64>(up), axle, up]
}

impl Wheel {
    fn take(&mut self, seen: &PatchState, sign: f64, axes: [Vector<f64>; 3], center: Vector<f64>) {
        let (patch, forces) = (&seen.patch, &seen.forces);
        let normal = patch.share * forces.normal;
        if normal <= 0.0 {
            return;
        }
        let (creep, creepage) = (&forces.creep, &forces.creepage);
        let power =
            creep.x * creepage.longitudinal + creep.y * creepage.lateral + creep.spin_moment * creepage.spin;
        self.wear -= patch.share * power;
        let arm = seen.place - center;
        self.patches.push(Shown {
            share: patch.share,
            place: axes.map(|axis| axis.dot::<f64, f64>(arm)),
            angle: patch.angle(),
            normal,
            creep: [patch.share * creep.x, sign * patch.share * creep.y],
            axes: forces.axes,
        });
    }

    /// Makes one patch of those of one area: where two areas grow together they come as one with a share and
    /// as two with the rest. Then keeps the largest ones, from the field side to the gauge side.
    fn merge(&mut self) {
        let (mut kept, parts): (Vec<Shown>, Vec<Shown>) =
            self.patches.iter().partition(|patch| patch.share >= HALF);
        for part in parts {
            let away = |own: &Shown| (own.place[1] - part.place[1]).abs();
            let near = kept
                .iter_mut()
                .min_by(|one, other| away(one).total_cmp(&away(other)));
            match near {
                Some(near) => {
                    near.normal += part.normal;
                    near.creep[0] += part.creep[0];
                    near.creep[1] += part.creep[1];
                }
                None => kept.push(part),
            }
        }
        kept.sort_by(|one, other| other.normal.total_cmp(&one.normal));
        kept.truncate(PATCHES);
        kept.sort_by(|one, other| other.place[1].abs().total_cmp(&one.place[1].abs()));
        self.patches = kept;
    }
}
