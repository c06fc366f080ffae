//! Contact patches of wheels as tables of runs have them: places in the axes of the wheelset that do not
//! spin, forces, ellipses.

use mechanics::vector::Vector;
use quantity::Kind;
use rolling::wheel::PatchState;
use wheelrail::contact::Side;
use wheelrail::track::TrackSection;

/// Patches of a wheel that have columns, from the field side to the gauge side.
pub const PATCHES: usize = 3;
/// A patch with a smaller share is shown as a part of its neighbor.
const HALF: f64 = 0.5;

/// Columns of a patch, after its side and number.
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

/// The patches of a wheel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Patches {
    shown: Vec<Shown>,
    /// Creep forces and spin moments times creepages: the wear number, N.
    pub wear: f64,
}

/// Returns the axes of a wheelset that do not spin: forward, along the axle to the left, up.
pub(crate) fn unspun(axle: Vector<f64>, section: &TrackSection<f64>) -> [Vector<f64>; 3] {
    let up = Vector(section.axes[2]);
    let share: f64 = up.dot::<f64, f64>(axle);
    let up = up - axle.scale(share);
    let length: f64 = up.dot::<f64, f64>(up);
    let up: Vector<f64> = up.scale(1.0 / length.sqrt());
    [axle.cross::<f64, f64>(up), axle, up]
}

/// Gives the columns of the patches of a wheel, whose names begin with its `side`, to `add`.
pub(crate) fn columns(side: &str, mut add: impl FnMut(String, Kind, String)) {
    let word = side.rsplit('_').next().unwrap_or(side);
    for number in 1..=PATCHES {
        for (name, kind, text) in PATCH {
            let text = format!("{word} wheel, patch {number} from the field side: {text}");
            add(format!("{side}_patch_{number}_{name}"), kind, text);
        }
    }
}

impl Patches {
    /// Takes a patch of the wheel on a side; `axes` are those of the wheelset, `center` its center counted
    /// from the rail.
    pub fn take(&mut self, seen: &PatchState, side: Side, axes: [Vector<f64>; 3], center: Vector<f64>) {
        let sign = match side {
            Side::Left => 1.0,
            Side::Right => -1.0,
        };
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
        self.shown.push(Shown {
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
    pub fn merge(&mut self) {
        let (mut kept, parts): (Vec<Shown>, Vec<Shown>) =
            self.shown.iter().partition(|patch| patch.share >= HALF);
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
        self.shown = kept;
    }

    /// Returns their number.
    pub fn count(&self) -> usize {
        self.shown.len()
    }

    /// Returns the values of the columns; zero where there is no patch.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        (0..PATCHES).flat_map(|number| {
            let own = self.shown.get(number).copied().unwrap_or_default();
            let ([x, y, z], [creep_x, creep_y], [a, b]) = (own.place, own.creep, own.axes);
            [x, y, z, own.angle, own.normal, creep_x, creep_y, a, b]
        })
    }
}
