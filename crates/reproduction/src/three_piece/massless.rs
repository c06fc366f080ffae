//! The rigs against a massless wedge: its closed form, and trucks with massless wedges.

use std::f64::consts::PI;

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use study::truck::WEDGE_NAMES;
use study::truck::run::TruckResult;
use truck::ControlCoil;
use wedge::parameters::Damping;

use super::check::{Found, exactly};
use super::rigs::{INCH, KIP_INCH, POUND, Rigs, at, coil_and_weight};

/// Returns the values of a column where the bolster passes its middle height in the last cycle: going up,
/// going down (SI).
fn in_the_middle(result: &TruckResult, name: &str, period: f64) -> Option<[f64; 2]> {
    let (times, z, values) = (
        result.column("time")?,
        result.column("bolster_z")?,
        result.column(name)?,
    );
    let last = times.last()?;
    let first = times.partition_point(|time| *time < last - period - 1e-9);
    let (mut up, mut down) = (None, None);
    for row in first..times.len().saturating_sub(1) {
        if (z[row] <= 0.0) != (z[row + 1] <= 0.0) {
            let share = z[row] / (z[row] - z[row + 1]);
            let value = values[row] + share * (values[row + 1] - values[row]);
            *(if z[row + 1] > z[row] { &mut up } else { &mut down }) = Some(value);
        }
    }
    up.zip(down).map(|(up, down)| [up, down])
}

/// The vertical rigs at the middle of the stroke against steady sliding of a massless wedge.
pub(super) fn massless(found: &mut Found, rigs: &Rigs) {
    const WAYS: [(&str, SlidingDirection); 2] =
        [("up", SlidingDirection::Up), ("down", SlidingDirection::Down)];
    for (rig, damping, toe) in [
        ("much toe, constant", "constant", "toe out 2°"),
        ("much toe, variable", "variable", "toe out 2°"),
        ("truck_vertical_constant_toe_out", "constant", "toe out 0.2°"),
        ("truck_vertical_variable_toe_out", "variable", "toe out 0.2°"),
        ("truck_vertical_constant", "constant", "no toe"),
        ("truck_vertical_variable", "variable", "no toe"),
    ] {
        let Some((case, result)) = rigs.get(rig) else {
            continue;
        };
        let own = &case.parameters.wedges[0];
        let wedge = QuasiStaticWedge {
            angle: own.angle,
            toe: own.toe,
            column_friction: own.column_friction.coefficient,
            slope_friction: own.slope_friction.coefficient,
        };
        let [coil, weight] = coil_and_weight(case);
        let stroke = case.parameters.bolster.motion.coordinates[2].evaluate(0.25 * PI, 0.0)[0];
        // How far the wedge slides along the slope from the middle of the stroke to its end, and what corners
        // give.
        let slide = stroke.abs() * libm::sin(own.toe) / libm::sin(own.angle + own.toe);
        let give = coil / (4.0 * own.contact.stiffness);
        let remark = if own.toe == 0.0 {
            "The slope sticks and the wedge goes with the bolster: its normal force is not that of a \
             branch, which lets the slope slide."
                .to_owned()
        } else {
            format!(
                "Toe makes the wedge slide on the slope by {:.4} in in half a stroke, where the faces give \
                 by about {:.4} in{}.",
                slide / INCH,
                give / INCH,
                if slide > 4.0 * give {
                    ": enough to come to the branches"
                } else {
                    ": too little to reach the branches"
                }
            )
        };
        let stiffness = match &own.control_coil {
            ControlCoil::Shear(spring) => spring.stiffness,
            _ => continue,
        };
        let seat = match case.parameters.damping {
            Damping::Constant => "bolster_z",
            Damping::Variable => "left_side_frame_z",
        };
        let [wedge_z, seat_z] = ["leading_left_z", seat].map(|name| in_the_middle(result, name, PI));
        let lift = wedge_z
            .zip(seat_z)
            .map(|(wedge, seat)| [wedge[0] - seat[0], wedge[1] - seat[1]]);
        // sin(2 rad/s t)
        let normals = in_the_middle(result, "leading_left_column_normal", PI);
        let frictions = in_the_middle(result, "leading_left_column_friction_z", PI);
        for (k, (way, direction)) in WAYS.into_iter().enumerate() {
            // The coil is as long as the run says: a wedge between faces that lean by the toe rides on edges,
            // and rises.
            let load = lift.map(|both| coil - stiffness * both[k] - weight);
            let sliding = load.and_then(|load| wedge.slide(direction, wedge.branch(direction), load));
            found.add(
                format!("normal force of a column going {way}, {damping} damping, {toe}"),
                normals.map(|both| both[k] / POUND),
                sliding.map(|sliding| exactly(sliding.column_normal / POUND)),
                ("lbf", 0.05),
                remark.clone(),
            );
            found.add(
                format!("friction of a column going {way}, {damping} damping, {toe}"),
                frictions.map(|both| both[k].abs() / POUND),
                sliding.map(|sliding| exactly(sliding.column_friction * libm::cos(own.toe) / POUND)),
                ("lbf", 0.05),
                "μ times the normal force, since the column slides.",
            );
        }
    }
}

/// The same rigs with massless wedges in the truck, and with the industry's empirical warp springs in place
/// of what they leave out.
pub(super) fn massless_trucks(found: &mut Found, rigs: &Rigs) {
    for damping in ["constant", "variable"] {
        let loss = |key: &str| {
            let (_, result) = rigs.get(key)?;
            result.summary.cycles.loss_of_wedges(&WEDGE_NAMES[..1])
        };
        found.add(
            format!(
                "loss of a wedge in a cycle, {damping} damping, toe out 0.2°, against massless wedges \
                     in the truck"
            ),
            loss(&format!("truck_vertical_{damping}_toe_out")),
            loss(&format!("massless, {damping}")).map(exactly),
            ("lbf·in", 0.05),
            "A massless wedge turns its slope's friction over at once; a body's faces give way first, and \
             it slides less.",
        );
    }
    for (condition, remark) in [
        (
            "new",
            "NUCARS's empirical stiffness grows in proportion to warp; wedges of a friction of 0.4 lock, \
             and resist far more at small angles.",
        ),
        (
            "worn",
            "NUCARS's empirical stiffness of worn trucks is a third of what wedges of a friction of 0.25 \
             hold on their plateau, and less still at small angles.",
        ),
    ] {
        let moment = |key: &str| {
            let (_, result) = rigs.get(&format!("{key}, {condition}"))?;
            Some(at(result, "warp_moment", 4.5)?.abs() / KIP_INCH)
        };
        found.add(
            format!(
                "warp moment, {condition}, axles apart by 20 mrad, against massless wedges with \
                     empirical warp springs"
            ),
            moment("axles"),
            moment("massless axles").map(exactly),
            ("kip·in", 0.05),
            remark,
        );
    }
}
