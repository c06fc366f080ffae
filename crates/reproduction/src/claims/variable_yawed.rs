//! Section 5.2: variable damping, bolster yawed.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "5.2-yaw-held",
        group: VariableYawed,
        place: "section 5.2, page 48",
        says: "The bolster is yawed by 0.012 rad and held there, with the same vertical displacement as \
               before.",
        test: "the bolster's yaw is 0.012 rad to 1e-6 rad at all times, and its displacement has the same \
               range as without yaw, to 1e-6 of it",
        runs: [vd_out_yaw, vd_out],
        holds: all([
            (least(vd_out_yaw, bolster_yaw, settled) - 0.012).abs() < 1e-6,
            (greatest(vd_out_yaw, bolster_yaw, settled) - 0.012).abs() < 1e-6,
            within(1e-6, [range(vd_out_yaw, bolster_z, settled), range(vd_out, bolster_z, settled)]),
        ]),
    },
    claim! {
        id: "5.2-moves-up-until-lift-off",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "Section (1): the wedge moves up with the bolster until that lifts off, whatever the toe.",
        test: "the wedge rises for more than 90 % of the time in which the bolster is below its middle and \
               goes up",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| share(run, rising, returning_up) > 0.9),
    },
    claim! {
        id: "5.2-yaw-makes-noise",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "Yaw makes the force noisy while the wedge moves up (section (1)).",
        test: "the force on the side frame is rougher with yaw than without (mean size of its second \
               difference from row to row, bolster below its middle and going up), for each toe",
        runs: [vd_out_yaw, vd_out, vd_none_yaw, vd_none, vd_in_yaw, vd_in],
        holds: every([(vd_out_yaw, vd_out), (vd_none_yaw, vd_none), (vd_in_yaw, vd_in)], |(yawed, not)| {
            roughness(yawed, side_frame_force, returning_up) > roughness(not, side_frame_force, returning_up)
        }),
        but: "Yaw makes the force smoother: pressed against one side, the wedge rests on few corners that \
              stay closed, and the ringing that the runs without yaw have dies out.",
    },
    claim! {
        id: "5.2-lifts-off-completely",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "Section (2): the bolster lifts off the wedge completely, whatever the toe.",
        test: "no corner of the slope touches for more than 95 % of lift-off",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| share(run, bolster_off, lift_off) > 0.95),
        but: "The yawed pocket lets the wedge go off its middle; free on its coil it drifts until it leans \
              against the pocket, long before the bolster has come down again.",
    },
    claim! {
        id: "5.2-rings-about-zero",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "After lift-off the wedge oscillates about zero force, on a stiff coil with a small mass.",
        test: "in lift-off the vertical force on the side frame stays below 5 % of its peak in the run, and \
               crosses its mean (the weight that the coil carries) with the wedge's natural frequency on \
               its coil, within 10 %, bolster rising, for each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            peak(run, side_frame_force, lift_off) < 0.05 * peak(run, side_frame_force, settled),
            within(0.1, [ringing_frequency(run, side_frame_force, early_lift_off), natural_frequency(run)]),
        ])),
    },
    claim! {
        id: "5.2-slides-down",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "Section (3): the wedge slips down the column as the bolster goes down, whatever the toe.",
        test: "the wedge slides down for more than 50 % of the time in which the bolster is below its \
               middle and goes down",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every(
            [vd_out_yaw, vd_none_yaw, vd_in_yaw],
            |run| share(run, sliding_down, pressing_down) > 0.5,
        ),
    },
    claim! {
        id: "5.2-stick-before-going-up",
        group: VariableYawed,
        place: "section 5.2, figures 5-10 and 5-12, pages 49 and 50",
        says: "Section (4): just before it moves up the wedge sticks to the column: large force, no \
               displacement.",
        test: "in the 0.1 s about the bottom reversal the column sticks at some time, the force on the side \
               frame goes through more than half its range in the run, and the wedge through less than 1 % \
               of its own, for each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            share(run, column_sticks, at_bottom) > 0.0,
            range(run, side_frame_force, at_bottom) > 0.5 * range(run, side_frame_force, settled),
            range(run, wedge_z, at_bottom) < 0.01 * range(run, wedge_z, settled),
        ])),
    },
    claim! {
        id: "5.2-toe-matters-much",
        group: VariableYawed,
        place: "section 5.2, figure 5-11, pages 49 and 50",
        says: "With yaw the vertical forces of the toe cases differ by much.",
        test: "the mean forces on the side frame (lower stroke) of the three toe cases differ by more than \
               10 %, going down or going up",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: !all([
            within(
                0.1,
                [vd_out_yaw, vd_none_yaw, vd_in_yaw].map(|run| size(run, side_frame_force, going_down)),
            ),
            within(
                0.1,
                [vd_out_yaw, vd_none_yaw, vd_in_yaw].map(|run| size(run, side_frame_force, going_up)),
            ),
        ]),
    },
    claim! {
        id: "5.2-yaw-lowers-longitudinal",
        group: VariableYawed,
        place: "section 5.2, figure 5-13, page 51",
        says: "The longitudinal force is lower with yaw than without (toe out).",
        test: "mean longitudinal force while the bolster is below its middle: with yaw < without, and so \
               its peak",
        runs: [vd_out_yaw, vd_out],
        holds: all([
            mean(vd_out_yaw, longitudinal_force, pressed) < mean(vd_out, longitudinal_force, pressed),
            peak(vd_out_yaw, longitudinal_force, settled) < peak(vd_out, longitudinal_force, settled),
        ]),
        but: "Yaw turns one side of the pocket towards the column, which presses the wedge lower by some \
              hundredths of an inch; the coil then carries more, and so do the faces.",
    },
    claim! {
        id: "5.2-yaw-holds-wedge",
        group: VariableYawed,
        place: "section 5.2, figure 5-13, page 51",
        says: "Yaw keeps the wedge from moving as much between bolster and side frame (toe out).",
        test: "range of the wedge's longitudinal displacement after the first half period: with yaw < \
               without",
        runs: [vd_out_yaw, vd_out],
        holds: range(vd_out_yaw, wedge_x, settled) < range(vd_out, wedge_x, settled),
        but: "In lift-off, where it moves most, the wedge drifts farther with yaw, because the yawed pocket \
              lets it go farther off its middle.",
    },
    claim! {
        id: "5.2-toe-in-begins-lower",
        group: VariableYawed,
        place: "section 5.2, figure 5-14, page 52",
        says: "Toe in begins with lower longitudinal forces than toe out and no toe.",
        test: "peak longitudinal force from 0.1 s to the end of the first half period: toe in < toe out, \
               toe in < no toe",
        runs: [vd_in_yaw, vd_out_yaw, vd_none_yaw],
        holds: all([
            peak(vd_in_yaw, longitudinal_force, beginning) < peak(vd_out_yaw, longitudinal_force, beginning),
            peak(vd_in_yaw, longitudinal_force, beginning) < peak(vd_none_yaw, longitudinal_force, beginning),
        ]),
        but: "The release from the start is over within 0.1 s and the free wedge touches nothing until the \
              bolster returns at 1.5 s; the force that it then takes up, still in this window, is slightly \
              higher with toe in.",
    },
    claim! {
        id: "5.2-toe-in-constrains",
        group: VariableYawed,
        place: "section 5.2, figure 5-14, page 52",
        says: "Toe in constrains the wedge more than the others while the bolster is off it.",
        test: "range of the wedge's longitudinal displacement in lift-off: toe in < toe out, toe in < no toe",
        runs: [vd_in_yaw, vd_out_yaw, vd_none_yaw],
        holds: all([
            range(vd_in_yaw, wedge_x, lift_off) < range(vd_out_yaw, wedge_x, lift_off),
            range(vd_in_yaw, wedge_x, lift_off) < range(vd_none_yaw, wedge_x, lift_off),
        ]),
    },
    claim! {
        id: "5.2-toe-in-largest-longitudinal-down",
        group: VariableYawed,
        place: "section 5.2, figure 5-14, page 52",
        says: "Going down, toe in has the largest longitudinal force.",
        test: "mean longitudinal force going down: toe in > toe out, toe in > no toe",
        runs: [vd_in_yaw, vd_out_yaw, vd_none_yaw],
        holds: all([
            mean(vd_in_yaw, longitudinal_force, going_down)
                > mean(vd_out_yaw, longitudinal_force, going_down),
            mean(vd_in_yaw, longitudinal_force, going_down)
                > mean(vd_none_yaw, longitudinal_force, going_down),
        ]),
    },
    claim! {
        id: "5.2-toe-in-largest-vertical-down",
        group: VariableYawed,
        place: "section 5.2, figures 5-11 and 5-14, page 52",
        says: "Going down, toe in has the largest vertical force.",
        test: "size of the mean force on the side frame (lower stroke) going down: toe in > toe out, toe in \
               > no toe",
        runs: [vd_in_yaw, vd_out_yaw, vd_none_yaw],
        holds: all([
            size(vd_in_yaw, side_frame_force, going_down) > size(vd_out_yaw, side_frame_force, going_down),
            size(vd_in_yaw, side_frame_force, going_down) > size(vd_none_yaw, side_frame_force, going_down),
        ]),
    },
    claim! {
        id: "5.2-energy-as-without-yaw",
        group: VariableYawed,
        place: "section 5.2, figure 5-16, page 53",
        says: "The dissipation with yaw is very close to that without, whatever the toe.",
        test: "energy per cycle at the side frame with and without yaw: within 10 % for each toe",
        runs: [vd_out_yaw, vd_out, vd_none_yaw, vd_none, vd_in_yaw, vd_in],
        holds: all([
            within(0.1, [energy_per_cycle(vd_out_yaw), energy_per_cycle(vd_out)]),
            within(0.1, [energy_per_cycle(vd_none_yaw), energy_per_cycle(vd_none)]),
            within(0.1, [energy_per_cycle(vd_in_yaw), energy_per_cycle(vd_in)]),
        ]),
        but: "The yawed pocket presses the wedge lower, so that the coil's force and the friction are \
              higher over the whole stroke; only without toe, whose energy was highest, is the difference \
              within a tenth.",
    },
    claim! {
        id: "5.2-force-as-without-yaw",
        group: VariableYawed,
        place: "section 5.2, figure 5-16, page 53",
        says: "The vertical forces with yaw are very close to those without.",
        test: "peak vertical force on the side frame with and without yaw: within 10 % for each toe",
        runs: [vd_out_yaw, vd_out, vd_none_yaw, vd_none, vd_in_yaw, vd_in],
        holds: all([
            within(0.1, [vd_out_yaw, vd_out].map(|run| peak(run, side_frame_force, settled))),
            within(0.1, [vd_none_yaw, vd_none].map(|run| peak(run, side_frame_force, settled))),
            within(0.1, [vd_in_yaw, vd_in].map(|run| peak(run, side_frame_force, settled))),
        ]),
    },
    claim! {
        id: "5.2-sticks-and-slips-down",
        group: VariableYawed,
        place: "section 5.2, figure 5-16, page 53",
        says: "From about 1.5 to 2.5 s the dissipation shows the wedge sticking and slipping down the \
               column.",
        test: "while the bolster is below its middle and goes down, the column sticks for more than 5 % of \
               the time, and slips for more than 5 %, for each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            share(run, column_sticks, pressing_down) > 0.05,
            share(run, column_slips, pressing_down) > 0.05,
        ])),
        but: "With yaw the wedge slides steadily down whatever the toe; it sticks only for some hundredths \
              of a second at the reversal.",
    },
    undecidable! {
        id: "5.2-small-moments",
        group: VariableYawed,
        place: "section 5.2, figures 5-17 and 5-18, page 54",
        says: "The pitch and yaw moments are small.",
        reason: "No number says what a small moment is, and what section 6.2 calls significant is of the \
                 same size: by one and the same threshold one of the two statements must fail.",
    },
    claim! {
        id: "5.2-moments-by-sticking",
        group: VariableYawed,
        place: "section 5.2, figures 5-17 and 5-18, page 54",
        says: "The pitch and yaw moments come from sticking.",
        test: "while the bolster is below its middle, the peaks of the pitch and of the yaw moment fall \
               into times at which the column sticks, for each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            so_at_peak(run, pitch_moment, pressed, column_sticks),
            so_at_peak(run, yaw_moment, pressed, column_sticks),
        ])),
        but: "The moments come from where the faces touch, on one side and one edge, sliding or not; their \
              peaks fall into the sliding on the way up, or beside the reversal.",
    },
    claim! {
        id: "5.2-pitch-largest-down",
        group: VariableYawed,
        place: "section 5.2, figure 5-17, page 54",
        says: "The largest pitch moments occur as the wedge moves down, and they decrease as it returns.",
        test: "peak and mean size of the pitch moment, bolster below its middle: going down > going up, for \
               each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            peak(run, pitch_moment, pressing_down) > peak(run, pitch_moment, returning_up),
            mean_size(run, pitch_moment, pressing_down) > mean_size(run, pitch_moment, returning_up),
        ])),
        but: "The pitch moment follows the normal force times its distance from the middle, and with toe \
              both are about as large, or larger, on the way up, when friction presses the wedge into the \
              taper.",
    },
    claim! {
        id: "5.2-yaw-moment-largest-down",
        group: VariableYawed,
        place: "section 5.2, figure 5-18, pages 54 and 55",
        says: "The largest yaw moments occur as the wedge moves down, and they decrease as it returns.",
        test: "peak and mean size of the yaw moment, bolster below its middle: going down > going up, for \
               each toe",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| all([
            peak(run, yaw_moment, pressing_down) > peak(run, yaw_moment, returning_up),
            mean_size(run, yaw_moment, pressing_down) > mean_size(run, yaw_moment, returning_up),
        ])),
        but: "The yaw moment is half the face's width times the normal force, which is larger on the way \
              up, when the column's friction presses the wedge into the taper.",
    },
];
