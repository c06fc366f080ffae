//! The words of predicates: quantities, and times at which they are evaluated.
//!
//! All times are after the first half period of the bolster's motion, in which the wedge settles, unless a
//! word says otherwise. They are known by the bolster's phase: its displacement over its amplitude, its speed
//! over its peak.

#![allow(non_upper_case_globals)] // They are written as words in predicates.

use quantity::Kind;
use wedge::outputs::CORNERS;

use super::evidence::ClaimView;

/// A column, or what is made of columns, row by row, SI.
#[derive(Clone, Copy)]
pub(super) struct ClaimQuantity {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) series: fn(ClaimView<'_>) -> Vec<f64>,
}

/// Times at which something is so.
#[derive(Clone, Copy)]
pub(super) struct When {
    pub(super) name: &'static str,
    pub(super) rows: fn(ClaimView<'_>) -> Vec<bool>,
}

/// One cycle per second, rad/s.
pub(super) const hertz: f64 = 2.0 * std::f64::consts::PI;

const fn column(name: &'static str, kind: Kind, series: fn(ClaimView<'_>) -> Vec<f64>) -> ClaimQuantity {
    ClaimQuantity { name, kind, series }
}

const fn when(name: &'static str, rows: fn(ClaimView<'_>) -> Vec<bool>) -> When {
    When { name, rows }
}

/// Column friction as it acts on the side frame; chapter 6 draws it.
pub(super) const vertical_force: ClaimQuantity = column("vertical wedge force", Kind::Force, |run| {
    run.column("vertical_wedge_force").to_vec()
});
/// The same less the coil's force on the side frame; chapter 5 draws it.
pub(super) const side_frame_force: ClaimQuantity =
    column("vertical force on the side frame", Kind::Force, |run| {
        run.column("vertical_force_on_side_frame").to_vec()
    });
pub(super) const longitudinal_force: ClaimQuantity = column("longitudinal wedge force", Kind::Force, |run| {
    run.column("longitudinal_wedge_force").to_vec()
});
pub(super) const lateral_force: ClaimQuantity = column("lateral force on the bolster", Kind::Force, |run| {
    run.column("net_force_on_bolster_y").to_vec()
});
pub(super) const dissipation: ClaimQuantity = column("dissipation at the side frame", Kind::Power, |run| {
    run.column("side_frame_dissipation").to_vec()
});
/// The power of the column's friction, which types 6.8 and 6.9 have too: negative where energy is lost.
pub(super) const friction_power: ClaimQuantity =
    column("friction power at the side frame", Kind::Power, |run| {
        run.column("side_frame_friction_power").to_vec()
    });
pub(super) const roll_moment: ClaimQuantity = column("roll moment", Kind::Moment, |run| {
    run.column("side_frame_roll_moment").to_vec()
});
pub(super) const pitch_moment: ClaimQuantity = column("pitch moment", Kind::Moment, |run| {
    run.column("side_frame_pitch_moment").to_vec()
});
pub(super) const yaw_moment: ClaimQuantity = column("yaw moment", Kind::Moment, |run| {
    run.column("side_frame_yaw_moment").to_vec()
});
pub(super) const coil_force: ClaimQuantity =
    column("coil force", Kind::Force, |run| run.column("coil_force").to_vec());
pub(super) const wedge_x: ClaimQuantity = column("longitudinal wedge displacement", Kind::Length, |run| {
    run.column("wedge_x").to_vec()
});
pub(super) const wedge_y: ClaimQuantity = column("lateral wedge displacement", Kind::Length, |run| {
    run.column("wedge_y").to_vec()
});
pub(super) const wedge_z: ClaimQuantity = column("vertical wedge displacement", Kind::Length, |run| {
    run.column("wedge_z").to_vec()
});
pub(super) const wedge_roll: ClaimQuantity = column("roll of the wedge", Kind::Angle, |run| {
    run.column("wedge_roll").to_vec()
});
pub(super) const wedge_pitch: ClaimQuantity = column("pitch of the wedge", Kind::Angle, |run| {
    run.column("wedge_pitch").to_vec()
});
pub(super) const wedge_yaw: ClaimQuantity = column("yaw of the wedge", Kind::Angle, |run| {
    run.column("wedge_yaw").to_vec()
});
pub(super) const bolster_z: ClaimQuantity = column("bolster displacement", Kind::Length, |run| {
    run.column("bolster_vertical").to_vec()
});
pub(super) const bolster_speed: ClaimQuantity = column("vertical bolster speed", Kind::Speed, |run| {
    run.column("bolster_vertical_rate").to_vec()
});
pub(super) const bolster_yaw: ClaimQuantity = column("yaw of the bolster", Kind::Angle, |run| {
    run.column("bolster_yaw").to_vec()
});
/// Distance of a lower and of an upper corner from the column, where positive: those of the side that yaw
/// lifts off.
pub(super) const lower_gap: ClaimQuantity = column(
    "gap at the lower right corner of the column",
    Kind::Length,
    |run| gap(run, "column_lower_right_gap"),
);
pub(super) const upper_gap: ClaimQuantity = column(
    "gap at the upper right corner of the column",
    Kind::Length,
    |run| gap(run, "column_upper_right_gap"),
);
/// Number of the four column corners that touch.
pub(super) const corners_touching: ClaimQuantity =
    column("column corners that touch", Kind::Dimensionless, |run| {
        corners(run, "column", |open, _, _| (CORNERS.len() - open) as f64)
    });
/// The upper corners' share of the column's normal force, less one half; zero where nothing touches.
pub(super) const unevenness: ClaimQuantity = column(
    "upper corners' share of the normal force less one half",
    Kind::Dimensionless,
    |run| {
        let normal = |corner: &str| run.column(&format!("column_{corner}_normal_force"));
        let [a, b, c, d] = CORNERS.map(normal);
        let rows = a.len().min(b.len()).min(c.len()).min(d.len());
        (0..rows)
            .map(|row| {
                let (lower, upper) = (a[row] + b[row], c[row] + d[row]);
                if lower + upper > 0.0 {
                    upper / (lower + upper) - 0.5
                } else {
                    0.0
                }
            })
            .collect()
    },
);

fn gap(run: ClaimView<'_>, name: &str) -> Vec<f64> {
    run.column(name).iter().map(|gap| gap.max(0.0)).collect()
}

/// Returns a function of the numbers of a face's corners that are open, stick and slip.
fn corners<T>(run: ClaimView<'_>, face: &str, make: fn(usize, usize, usize) -> T) -> Vec<T> {
    let states = CORNERS.map(|corner| run.column(&format!("{face}_{corner}_state")));
    let rows = states.iter().map(|states| states.len()).min().unwrap_or(0);
    (0..rows)
        .map(|row| {
            let count = |state: f64| states.iter().filter(|states| states[row] == state).count();
            make(count(0.0), count(1.0), count(2.0))
        })
        .collect()
}

/// Rows at which the bolster's displacement (over its amplitude) and speed (over its peak) are so, after the
/// start.
fn phase(run: ClaimView<'_>, holds: fn(f64, f64) -> bool) -> Vec<bool> {
    timed(run, |time, z, speed| time > 0.5 && holds(z, speed))
}

/// As [`phase`], with the time (over the period) and from the start.
fn timed(run: ClaimView<'_>, holds: impl Fn(f64, f64, f64) -> bool) -> Vec<bool> {
    let cycle = run.cycle();
    let positions = run.column("bolster_vertical");
    let speeds = run.column("bolster_vertical_rate");
    run.column("time")
        .iter()
        .zip(positions.iter().zip(speeds))
        .map(|(time, (position, speed))| {
            holds(
                time / cycle.period(),
                (position - cycle.middle) / cycle.amplitude,
                speed / cycle.peak_speed,
            )
        })
        .collect()
}

fn branch(run: ClaimView<'_>, up: bool) -> Vec<bool> {
    let cycle = run.cycle();
    let damping = run.case().parameters.damping;
    let positions = run.column("bolster_vertical");
    let speeds = run.column("bolster_vertical_rate");
    run.column("time")
        .iter()
        .zip(positions.iter().zip(speeds))
        .map(|(time, (position, speed))| cycle.branch(damping, *time, *position, *speed) == Some(up))
        .collect()
}

fn both(mut one: Vec<bool>, other: &[bool]) -> Vec<bool> {
    for (one, other) in one.iter_mut().zip(other) {
        *one &= other;
    }
    one
}

/// After the first half period.
pub(super) const settled: When = when("after the first half period", |run| phase(run, |_, _| true));
/// The first half period without its first 0.1 s, which the thesis's figures leave out: the bolster rises and
/// returns.
pub(super) const beginning: When = when("in the first half period", |run| {
    let skip = 0.1 / run.cycle().period();
    timed(run, move |time, _, _| time > skip && time < 0.5)
});
/// The branches of the averages.
pub(super) const going_up: When = when("going up (branch)", |run| branch(run, true));
pub(super) const going_down: When = when("going down (branch)", |run| branch(run, false));
pub(super) const upwards: When = when("upwards", |run| phase(run, |_, speed| speed > 0.0));
pub(super) const downwards: When = when("downwards", |run| phase(run, |_, speed| speed < 0.0));
/// The bolster below its middle: 1.6 to 2.4 s down, 2.4 to 3.1 s up, and so on.
pub(super) const pressing_down: When = when("bolster below its middle, going down", |run| {
    phase(run, |z, speed| z < 0.0 && speed < 0.0)
});
pub(super) const returning_up: When = when("bolster below its middle, going up", |run| {
    phase(run, |z, speed| z < 0.0 && speed > 0.0)
});
pub(super) const pressed: When = when("bolster below its middle", |run| phase(run, |z, _| z < 0.0));
/// The bolster above 0.15 of its amplitude: 3.2 to 4.6 s and so on, the lift-off of variable damping.
pub(super) const lift_off: When = when("in lift-off (bolster above 0.15 A)", |run| {
    phase(run, |z, _| z > 0.15)
});
pub(super) const early_lift_off: When = when("in lift-off, bolster rising", |run| {
    phase(run, |z, speed| z > 0.15 && speed > 0.0)
});
/// Two parts of the bolster's rise in lift-off: 0.2 s from its beginning, and the last 0.35 s.
pub(super) const first_ringing: When = when("in lift-off, bolster rising from 0.15 A to 0.5 A", |run| {
    phase(run, |z, speed| z > 0.15 && z < 0.5 && speed > 0.0)
});
pub(super) const last_ringing: When = when("in lift-off, bolster rising above 0.75 A", |run| {
    phase(run, |z, speed| z > 0.75 && speed > 0.0)
});
/// 0.1 s about a reversal: the bolster moves by 0.5 % of its amplitude.
pub(super) const at_bottom: When = when("at the bottom reversal (bolster below -0.995 A)", |run| {
    phase(run, |z, _| z < -0.995)
});
pub(super) const at_top: When = when("at the top reversal (bolster above 0.995 A)", |run| {
    phase(run, |z, _| z > 0.995)
});
pub(super) const at_reversals: When = when("at the reversals (bolster beyond 0.9999 A)", |run| {
    phase(run, |z, _| z.abs() > 0.9999)
});
/// The first fortieth of a stroke: 0.16 s.
pub(super) const starting_up: When = when("starting up (bolster below -0.95 A)", |run| {
    phase(run, |z, speed| z < -0.95 && speed > 0.0)
});
pub(super) const starting_down: When = when("starting down (bolster above 0.95 A)", |run| {
    phase(run, |z, speed| z > 0.95 && speed < 0.0)
});
/// The first 1/400 of a stroke: 0.05 s.
pub(super) const first_of_up: When = when(
    "in the first 0.05 s of the way up (bolster below -0.995 A)",
    |run| phase(run, |z, speed| z < -0.995 && speed > 0.0),
);
pub(super) const first_of_down: When = when(
    "in the first 0.05 s of the way down (bolster above 0.995 A)",
    |run| phase(run, |z, speed| z > 0.995 && speed < 0.0),
);

/// No corner of the column slips, one at least sticks.
pub(super) const column_sticks: When = when("while the column sticks", |run| {
    both(
        corners(run, "column", |_, stick, slip| stick > 0 && slip == 0),
        &phase(run, |_, _| true),
    )
});
/// A corner of the column slips.
pub(super) const column_slips: When = when("while the column slips", |run| {
    both(
        corners(run, "column", |_, _, slip| slip > 0),
        &phase(run, |_, _| true),
    )
});
pub(super) const slope_sticks: When = when("while the slope sticks", |run| {
    both(
        corners(run, "slope", |_, stick, slip| stick > 0 && slip == 0),
        &phase(run, |_, _| true),
    )
});
pub(super) const slope_slips: When = when("while the slope slips", |run| {
    both(
        corners(run, "slope", |_, _, slip| slip > 0),
        &phase(run, |_, _| true),
    )
});
/// No corner of the slope touches: the bolster is off the wedge.
pub(super) const bolster_off: When = when("while the bolster is off the wedge", |run| {
    both(
        corners(run, "slope", |open, _, _| open == CORNERS.len()),
        &phase(run, |_, _| true),
    )
});
/// No corner of the column touches.
pub(super) const column_open: When = when("while the column does not touch", |run| {
    both(
        corners(run, "column", |open, _, _| open == CORNERS.len()),
        &phase(run, |_, _| true),
    )
});
pub(super) const sliding_down: When = when("while the wedge slides down", |run| {
    both((column_slips.rows)(run), &wedge_moves(run, -1.0))
});
pub(super) const rising: When = when("while the wedge rises", |run| wedge_moves(run, 1.0));
/// The column dissipates less than 0.02 % of what it does at most.
pub(super) const not_dissipating: When = when("while hardly anything is dissipated", |run| {
    quiet(run, "side_frame_dissipation", 2e-4)
});

/// The power of the column's friction, which types 6.8 and 6.9 have too, is below 1 % of its greatest.
pub(super) const powerless: When = when("while the friction has hardly any power", |run| {
    quiet(run, "side_frame_friction_power", 0.01)
});

fn quiet(run: ClaimView<'_>, name: &str, share: f64) -> Vec<bool> {
    let values = run.column(name);
    let most = values
        .iter()
        .zip(phase(run, |_, _| true))
        .filter(|(_, counts)| *counts)
        .fold(0.0, |most: f64, (value, _)| most.max(value.abs()));
    let quiet: Vec<bool> = values.iter().map(|value| value.abs() < share * most).collect();
    both(quiet, &phase(run, |_, _| true))
}

fn wedge_moves(run: ClaimView<'_>, sign: f64) -> Vec<bool> {
    let moves: Vec<bool> = run
        .column("wedge_z_rate")
        .iter()
        .map(|rate| sign * rate > 0.0)
        .collect();
    both(moves, &phase(run, |_, _| true))
}
