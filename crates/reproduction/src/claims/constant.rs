//! Section 6.1: constant damping, bolster not yawed.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "6.1-coil-force-constant",
        group: Constant,
        place: "section 6.1, page 56",
        says: "The control coil moves a little, but its force changes very little.",
        test: "the coil force's range after the first half period is below 5 % of its mean, for each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every(
            [cd_out, cd_none, cd_in],
            |run| range(run, coil_force, settled) < 0.05 * mean(run, coil_force, settled),
        ),
    },
    claim! {
        id: "6.1-sticks-then-slips-down",
        group: Constant,
        place: "section 6.1, figure 6-1, page 56",
        says: "As the bolster goes down, the wedge sticks until a break-out force is reached, then it slips \
               (toe out).",
        test: "the column sticks at some time in the first 0.05 s of the way down, and slips for more than \
               90 % of the branch",
        runs: [cd_out],
        holds: all([
            share(cd_out, column_sticks, first_of_down) > 0.0,
            share(cd_out, column_slips, going_down) > 0.9,
        ]),
    },
    claim! {
        id: "6.1-sticks-then-slips-up",
        group: Constant,
        place: "section 6.1, figure 6-1, page 56",
        says: "As the bolster goes up, the wedge sticks until a break-out force is reached, then it slips \
               (toe out).",
        test: "the column sticks at some time in the first 0.05 s of the way up, and slips for more than 90 \
               % of the branch",
        runs: [cd_out],
        holds: all([
            share(cd_out, column_sticks, first_of_up) > 0.0,
            share(cd_out, column_slips, going_up) > 0.9,
        ]),
    },
    claim! {
        id: "6.1-force-without-motion-up",
        group: Constant,
        place: "section 6.1, figure 6-2, page 58",
        says: "Section (1): the way up starts with a large force and no motion of the wedge (toe out).",
        test: "in the 0.1 s about the bottom reversal the column sticks at some time, the vertical wedge \
               force goes through more than half its range in the run, and the wedge through less than 1 % \
               of its own",
        runs: [cd_out],
        holds: all([
            share(cd_out, column_sticks, at_bottom) > 0.0,
            range(cd_out, vertical_force, at_bottom) > 0.5 * range(cd_out, vertical_force, settled),
            range(cd_out, wedge_z, at_bottom) < 0.01 * range(cd_out, wedge_z, settled),
        ]),
    },
    claim! {
        id: "6.1-slips-up",
        group: Constant,
        place: "section 6.1, figure 6-2, page 58",
        says: "Section (2): beyond the break-out force the wedge slips and moves up with the bolster (toe \
               out).",
        test: "the wedge rises, and the column slips, for more than 90 % of the branch going up",
        runs: [cd_out],
        holds: all([
            share(cd_out, rising, going_up) > 0.9,
            share(cd_out, column_slips, going_up) > 0.9,
        ]),
    },
    claim! {
        id: "6.1-force-without-motion-down",
        group: Constant,
        place: "section 6.1, figure 6-2, page 58",
        says: "Section (3): the way down starts with the force of static friction (toe out).",
        test: "in the 0.1 s about the top reversal the column sticks at some time, the vertical wedge force \
               goes through more than half its range in the run, and the wedge through less than 1 % of its \
               own",
        runs: [cd_out],
        holds: all([
            share(cd_out, column_sticks, at_top) > 0.0,
            range(cd_out, vertical_force, at_top) > 0.5 * range(cd_out, vertical_force, settled),
            range(cd_out, wedge_z, at_top) < 0.01 * range(cd_out, wedge_z, settled),
        ]),
    },
    claim! {
        id: "6.1-slips-down",
        group: Constant,
        place: "section 6.1, figure 6-2, page 58",
        says: "Section (4): beyond the break-out force the wedge slips and moves down (toe out).",
        test: "the wedge slides down for more than 90 % of the branch going down",
        runs: [cd_out],
        holds: share(cd_out, sliding_down, going_down) > 0.9,
    },
    claim! {
        id: "6.1-break-out-differs-little",
        group: Constant,
        place: "section 6.1, figure 6-3, pages 58 and 59",
        says: "At the start of the way up the vertical forces of the toe cases differ little.",
        test: "peak vertical wedge force while the bolster starts up (below -0.95 A), of the three toe \
               cases: within 10 %",
        runs: [cd_out, cd_none, cd_in],
        holds: within(0.1, [cd_out, cd_none, cd_in].map(|run| peak(run, vertical_force, starting_up))),
        but: "The wedge breaks out at the friction limit, and the normal force there depends on how far it \
              was wedged in on the way down: least with toe out, where the gap opens downwards, most with \
              toe in.",
    },
    claim! {
        id: "6.1-break-out-up-toe-out",
        group: Constant,
        place: "section 6.1, figure 6-3, pages 58 and 59",
        says: "Toe out has a larger break-out force on the way up than toe in.",
        test: "peak vertical wedge force while the bolster starts up (below -0.95 A): toe out > toe in",
        runs: [cd_out, cd_in],
        holds: peak(cd_out, vertical_force, starting_up) > peak(cd_in, vertical_force, starting_up),
        but: "At the bottom the wedge is wedged in deepest with toe in, and breaks out at the highest \
              force; toe out overtakes it only later in the stroke, as its gap narrows upwards, and is \
              larger in the branch's mean.",
    },
    claim! {
        id: "6.1-toe-in-largest-down",
        group: Constant,
        place: "section 6.1, figure 6-3, pages 58 and 59",
        says: "Going down, toe in has the largest vertical forces.",
        test: "size of the mean vertical wedge force going down: toe in > toe out, toe in > no toe",
        runs: [cd_in, cd_out, cd_none],
        holds: all([
            size(cd_in, vertical_force, going_down) > size(cd_out, vertical_force, going_down),
            size(cd_in, vertical_force, going_down) > size(cd_none, vertical_force, going_down),
        ]),
    },
    undecidable! {
        id: "6.1-accurate-motion",
        group: Constant,
        place: "section 6.1, figure 6-3, page 59",
        says: "The differences between the toe cases show that the model captures the wedge's motion.",
        reason: "No motion was measured: the runs cannot say whether the model's differences are those of a \
                 real wedge.",
    },
    claim! {
        id: "6.1-toe-order-up",
        group: Constant,
        place: "section 6.1, figure 6-4, page 59",
        says: "Going up, toe in has the least force and toe out the greatest.",
        test: "mean vertical wedge force going up: toe out > no toe > toe in",
        runs: [cd_out, cd_none, cd_in],
        holds: descending([cd_out, cd_none, cd_in].map(|run| mean(run, vertical_force, going_up))),
    },
    claim! {
        id: "6.1-travel-order-up",
        group: Constant,
        place: "section 6.1, figure 6-4, page 59",
        says: "Going up, toe in lets the wedge move most, and toe out least.",
        test: "greatest vertical displacement of the wedge, from its nominal position, as script E.2 draws \
               it: toe in > no toe > toe out, each by more than 1 %",
        runs: [cd_in, cd_none, cd_out],
        holds: descending_by(0.01, [cd_in, cd_none, cd_out].map(|run| greatest(run, wedge_z, settled))),
        but: "The wedge follows the bolster to within the contacts' give, whatever the toe, and what goes up \
              in a cycle comes down: only the place of the loop can differ. It does where toe turns the \
              column about the coil's seat (side_frame.toe_pivot), which the thesis does not say: then toe \
              in lifts the wedge and toe out lowers it, and this order holds; with toe about the middle of \
              the face there is none.",
    },
    claim! {
        id: "6.1-toe-order-down",
        group: Constant,
        place: "section 6.1, figure 6-4, page 59",
        says: "Going down, toe in has the largest force and toe out the least.",
        test: "size of the mean vertical wedge force going down: toe in > no toe > toe out",
        runs: [cd_in, cd_none, cd_out],
        holds: descending([cd_in, cd_none, cd_out].map(|run| size(run, vertical_force, going_down))),
    },
    claim! {
        id: "6.1-travel-order-down",
        group: Constant,
        place: "section 6.1, figure 6-4, page 59",
        says: "Going down, toe in lets the wedge move least, and toe out most.",
        test: "greatest displacement of the wedge downwards, from its nominal position, as script E.2 draws \
               it: toe out > no toe > toe in, each by more than 1 %",
        runs: [cd_out, cd_none, cd_in],
        holds: descending_by(0.01, [cd_out, cd_none, cd_in].map(|run| -least(run, wedge_z, settled))),
        but: "The wedge follows the bolster to within the contacts' give, whatever the toe, and what goes up \
              in a cycle comes down: only the place of the loop can differ. It does where toe turns the \
              column about the coil's seat (side_frame.toe_pivot), which the thesis does not say: then toe \
              in lifts the wedge and toe out lowers it, and this order holds; with toe about the middle of \
              the face there is none.",
    },
    claim! {
        id: "6.1-longitudinal-ringing",
        group: Constant,
        place: "section 6.1, figure 6-5, page 60",
        says: "The longitudinal force shows the wedge ringing between bolster and side frame (toe out).",
        test: "the longitudinal force has more than 10 peaks (followed by falls of more than 2 % of its \
               greatest value) in the time after the first half period: some four a cycle",
        runs: [cd_out],
        holds: peaks(cd_out, longitudinal_force, settled) > 10.0,
        but: "The preloaded coil keeps the faces closed and the wedge slides steadily between reversals: \
              nothing excites the contacts, and the force has one peak a cycle.",
    },
    claim! {
        id: "6.1-longitudinal-periodic",
        group: Constant,
        place: "section 6.1, figure 6-5, page 60",
        says: "The longitudinal force stays fairly periodic (toe out).",
        test: "from one cycle to the next the longitudinal force changes by less than 20 % (root mean \
               square, relative)",
        runs: [cd_out],
        holds: change_between_cycles(cd_out, longitudinal_force) < 0.2,
    },
    claim! {
        id: "6.1-longitudinal-toe-out-at-bottom",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "With toe out the longitudinal force is largest where the bolster is lowest.",
        test: "at the peak of the longitudinal force the bolster is below -0.9 of its amplitude",
        runs: [cd_out],
        holds: at_peak(cd_out, longitudinal_force, settled, bolster_z) < -0.9 * amplitude(cd_out),
        but: "With toe out the gap is narrowest at the top: the normal force grows on the way up, and is \
              largest near the top.",
    },
    claim! {
        id: "6.1-longitudinal-toe-out-largest",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "Toe out has the largest longitudinal peaks of the toe cases.",
        test: "peak longitudinal force after the first half period: toe out > no toe, toe out > toe in",
        runs: [cd_out, cd_none, cd_in],
        holds: all([
            peak(cd_out, longitudinal_force, settled) > peak(cd_none, longitudinal_force, settled),
            peak(cd_out, longitudinal_force, settled) > peak(cd_in, longitudinal_force, settled),
        ]),
        but: "Toe in reaches the largest force, slightly above toe out: wedged in at the bottom it is what \
              toe out is at the top. No toe has the lowest.",
    },
    claim! {
        id: "6.1-gap-below-toe-out",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "With toe out the wedge is farthest from the lower part of the column when the bolster is \
               lowest.",
        test: "the gap at the wedge's lower right corner is open, and its mean at the bottom reversal \
               (bolster below -0.995 A) is within 10 % of the greatest in the run",
        runs: [cd_out],
        holds: all([
            greatest(cd_out, lower_gap, settled) > 0.0,
            mean(cd_out, lower_gap, at_bottom) > 0.9 * greatest(cd_out, lower_gap, settled),
        ]),
    },
    claim! {
        id: "6.1-longitudinal-toe-in-up",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "With toe in the longitudinal force is largest while the bolster goes up.",
        test: "at the peak of the longitudinal force the bolster goes up, with more than 10 % of its peak \
               speed",
        runs: [cd_in],
        holds: at_peak(cd_in, longitudinal_force, settled, bolster_speed)
            > 0.1 * peak(cd_in, bolster_speed, settled),
        but: "With toe in the wedge is wedged in deepest at the lower reversal, and the force has its peak \
              there; on the way up it falls.",
    },
    claim! {
        id: "6.1-gap-above-toe-in",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "With toe in the gap between wedge and the upper part of the column is greatest as the \
               bolster goes up.",
        test: "mean gap at the wedge's upper right corner: bolster going up > going down, and the greatest \
               gap occurs as it goes up",
        runs: [cd_in],
        holds: all([
            mean(cd_in, upper_gap, upwards) > mean(cd_in, upper_gap, downwards),
            greatest(cd_in, upper_gap, upwards) > greatest(cd_in, upper_gap, downwards),
        ]),
        but: "With toe in the wedge stands on its lower edge and its upper edge stands off by its pitch, \
              which is greatest just after the upper reversal, when the column's friction tilts it the \
              other way: on the way down.",
    },
    claim! {
        id: "6.1-longitudinal-none-between",
        group: Constant,
        place: "section 6.1, figure 6-6, page 61",
        says: "The longitudinal forces without toe lie between toe in and toe out.",
        test: "mean longitudinal force: going up, toe out > no toe > toe in; going down, toe in > no toe > \
               toe out",
        runs: [cd_out, cd_none, cd_in],
        holds: all([
            descending([cd_out, cd_none, cd_in].map(|run| mean(run, longitudinal_force, going_up))),
            descending([cd_in, cd_none, cd_out].map(|run| mean(run, longitudinal_force, going_down))),
        ]),
    },
    claim! {
        id: "6.1-no-dissipation-only-sticking",
        group: Constant,
        place: "section 6.1, figure 6-7, page 62",
        says: "Dissipation at the side frame is zero only while the wedge sticks (toe out).",
        test: "where less than 0.02 % of the greatest rate is dissipated (a corner begins to stick at 0.001 \
               in/s, 0.05 % of the greatest speed), the column sticks at all times",
        runs: [cd_out],
        holds: share(cd_out, column_sticks, not_dissipating) == 1.0,
    },
    claim! {
        id: "6.1-never-lifts-off",
        group: Constant,
        place: "section 6.1, figure 6-7, page 62",
        says: "With constant damping the bolster never lifts off, whatever the toe.",
        test: "the time in which all corners of the slope, or all of the column, are open: none, for each \
               toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every([cd_out, cd_none, cd_in], |run| all([
            share(run, bolster_off, settled) == 0.0,
            share(run, column_open, settled) == 0.0,
        ])),
    },
    claim! {
        id: "6.1-dissipation-order-up",
        group: Constant,
        place: "section 6.1, figure 6-8, page 63",
        says: "Going up, toe out dissipates most and toe in least, with no toe between.",
        test: "size of the mean dissipation at the side frame going up: toe out > no toe > toe in",
        runs: [cd_out, cd_none, cd_in],
        holds: descending([cd_out, cd_none, cd_in].map(|run| size(run, dissipation, going_up))),
    },
    claim! {
        id: "6.1-dissipation-zero-at-peaks",
        group: Constant,
        place: "section 6.1, figure 6-8, page 63",
        says: "The dissipation is zero at the peaks of the input, whatever the toe.",
        test: "the dissipation at the reversals (bolster beyond 0.9999 A) is below 2 % of the run's \
               greatest, for each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every(
            [cd_out, cd_none, cd_in],
            |run| peak(run, dissipation, at_reversals) < 0.02 * peak(run, dissipation, settled),
        ),
    },
    claim! {
        id: "6.1-dissipation-order-down",
        group: Constant,
        place: "section 6.1, figure 6-8, page 63",
        says: "Going down, toe in dissipates most and toe out least, with no toe between.",
        test: "size of the mean dissipation at the side frame going down: toe in > no toe > toe out",
        runs: [cd_in, cd_none, cd_out],
        holds: descending([cd_in, cd_none, cd_out].map(|run| size(run, dissipation, going_down))),
    },
    claim! {
        id: "6.1-yaw-moment-negligible",
        group: Constant,
        place: "section 6.1, page 64",
        says: "The yaw moment is negligible.",
        test: "the peak yaw moment is below 1 % of the peak longitudinal force times half the face's width, \
               for each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every([cd_out, cd_none, cd_in], |run| peak(run, yaw_moment, settled) < 0.01 * yaw_limit(run)),
    },
    claim! {
        id: "6.1-pitch-moment-larger",
        group: Constant,
        place: "section 6.1, figure 6-9, page 64",
        says: "The pitch moment is larger.",
        test: "peak pitch moment > peak yaw moment, for each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every(
            [cd_out, cd_none, cd_in],
            |run| peak(run, pitch_moment, settled) > peak(run, yaw_moment, settled),
        ),
    },
    claim! {
        id: "6.1-uneven-forces",
        group: Constant,
        place: "section 6.1, figure 6-9, page 64",
        says: "The forces on the column face are uneven, which makes the wedge pitch.",
        test: "the upper corners' share of the column's normal force is on average more than 0.1 away from \
               one half, for each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every([cd_out, cd_none, cd_in], |run| mean_size(run, unevenness, settled) > 0.1),
        but: "With toe, in or out, one edge carries everything; without toe the face lies flat and upper \
              and lower corners share the force almost evenly.",
    },
    claim! {
        id: "6.1-uneven-by-stick-slip",
        group: Constant,
        place: "section 6.1, figure 6-9, page 64",
        says: "It is stick-slip that makes the pitch moment.",
        test: "the pitch moment's mean size is greater while the column sticks than while it slips, for \
               each toe",
        runs: [cd_out, cd_none, cd_in],
        holds: every([cd_out, cd_none, cd_in], |run| {
            mean_size(run, pitch_moment, column_sticks) > mean_size(run, pitch_moment, column_slips)
        }),
        but: "The pitch moment is that of a face that rests on one edge because of toe; it is there while \
              the column slides (all but a hundredth of the time) as while it sticks.",
    },
];
