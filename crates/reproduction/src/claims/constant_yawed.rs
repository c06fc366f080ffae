//! Section 6.2: constant damping, bolster yawed.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "6.2-yaw-changes-results",
        group: ConstantYawed,
        place: "section 6.2, page 65",
        says: "The bolster's constant yaw makes the vertical forces come out differently.",
        test: "the mean vertical wedge force with yaw differs from that without by more than 1 %, going up \
               or going down, for each toe",
        runs: [cd_out_yaw, cd_out, cd_none_yaw, cd_none, cd_in_yaw, cd_in],
        holds: every([(cd_out_yaw, cd_out), (cd_none_yaw, cd_none), (cd_in_yaw, cd_in)], |(yawed, not)| !all([
            within(0.01, [yawed, not].map(|run| mean(run, vertical_force, going_up))),
            within(0.01, [yawed, not].map(|run| mean(run, vertical_force, going_down))),
        ])),
    },
    claim! {
        id: "6.2-sticks-then-slips-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-10, page 66",
        says: "As the bolster goes down, the wedge sticks until a break-out force is reached, then it slips \
               (toe out).",
        test: "the column sticks at some time in the first 0.05 s of the way down, and slips for more than \
               90 % of the branch",
        runs: [cd_out_yaw],
        holds: all([
            share(cd_out_yaw, column_sticks, first_of_down) > 0.0,
            share(cd_out_yaw, column_slips, going_down) > 0.9,
        ]),
    },
    claim! {
        id: "6.2-sticks-then-slips-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-10, page 66",
        says: "As the bolster goes up, the wedge sticks until a break-out force is reached, then it slips \
               (toe out).",
        test: "the column sticks at some time in the first 0.05 s of the way up, and slips for more than 90 \
               % of the branch",
        runs: [cd_out_yaw],
        holds: all([
            share(cd_out_yaw, column_sticks, first_of_up) > 0.0,
            share(cd_out_yaw, column_slips, going_up) > 0.9,
        ]),
    },
    claim! {
        id: "6.2-force-without-motion-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-11, page 66",
        says: "Section (1): the way up starts with a large force and no motion of the wedge (toe out).",
        test: "in the 0.1 s about the bottom reversal the column sticks at some time, the vertical wedge \
               force goes through more than half its range in the run, and the wedge through less than 1 % \
               of its own; decided from \
               the yawed run, where figure 6-11 draws the unyawed force, sign reversed, over the yawed \
               displacement (script D.2.2)",
        runs: [cd_out_yaw],
        holds: all([
            share(cd_out_yaw, column_sticks, at_bottom) > 0.0,
            range(cd_out_yaw, vertical_force, at_bottom) > 0.5 * range(cd_out_yaw, vertical_force, settled),
            range(cd_out_yaw, wedge_z, at_bottom) < 0.01 * range(cd_out_yaw, wedge_z, settled),
        ]),
    },
    claim! {
        id: "6.2-slips-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-11, page 66",
        says: "Section (2): beyond the break-out force the wedge slips and moves up with the bolster (toe \
               out).",
        test: "the wedge rises, and the column slips, for more than 90 % of the branch going up; decided \
               from the yawed run, where figure 6-11 draws the unyawed force, sign reversed, over the yawed \
               displacement (script D.2.2)",
        runs: [cd_out_yaw],
        holds: all([
            share(cd_out_yaw, rising, going_up) > 0.9,
            share(cd_out_yaw, column_slips, going_up) > 0.9,
        ]),
    },
    claim! {
        id: "6.2-force-without-motion-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-11, page 66",
        says: "Section (3): the way down starts with the force of static friction (toe out).",
        test: "in the 0.1 s about the top reversal the column sticks at some time, the vertical wedge force \
               goes through more than half its range in the run, and the wedge through less than 1 % of its \
               own; decided from \
               the yawed run, where figure 6-11 draws the unyawed force, sign reversed, over the yawed \
               displacement (script D.2.2)",
        runs: [cd_out_yaw],
        holds: all([
            share(cd_out_yaw, column_sticks, at_top) > 0.0,
            range(cd_out_yaw, vertical_force, at_top) > 0.5 * range(cd_out_yaw, vertical_force, settled),
            range(cd_out_yaw, wedge_z, at_top) < 0.01 * range(cd_out_yaw, wedge_z, settled),
        ]),
    },
    claim! {
        id: "6.2-slips-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-11, page 66",
        says: "Section (4): beyond the break-out force the wedge slips and moves down (toe out).",
        test: "the wedge slides down for more than 90 % of the branch going down; decided from \
               the yawed run, where figure 6-11 draws the unyawed force, sign reversed, over the yawed \
               displacement (script D.2.2)",
        runs: [cd_out_yaw],
        holds: share(cd_out_yaw, sliding_down, going_down) > 0.9,
    },
    claim! {
        id: "6.2-break-out-differs-little",
        group: ConstantYawed,
        place: "section 6.2, figure 6-12, page 67",
        says: "At the start of the way up the vertical forces of the toe cases differ little.",
        test: "peak vertical wedge force while the bolster starts up (below -0.95 A), of the three toe \
               cases: within 10 %",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: within(
            0.1,
            [cd_out_yaw, cd_none_yaw, cd_in_yaw].map(|run| peak(run, vertical_force, starting_up)),
        ),
        but: "The wedge breaks out at the friction limit, and the normal force there depends on how far it \
              was wedged in on the way down: least with toe out, where the gap opens downwards, most with \
              toe in.",
    },
    claim! {
        id: "6.2-break-out-up-toe-out",
        group: ConstantYawed,
        place: "section 6.2, figure 6-12, page 67",
        says: "Toe out has a larger break-out force on the way up than toe in.",
        test: "peak vertical wedge force while the bolster starts up (below -0.95 A): toe out > toe in",
        runs: [cd_out_yaw, cd_in_yaw],
        holds: peak(cd_out_yaw, vertical_force, starting_up) > peak(cd_in_yaw, vertical_force, starting_up),
        but: "At the bottom the wedge is wedged in deepest with toe in, and breaks out at the highest \
              force; toe out overtakes it only later in the stroke, as its gap narrows upwards, and is \
              larger in the branch's mean.",
    },
    claim! {
        id: "6.2-break-out-down-toe-in",
        group: ConstantYawed,
        place: "section 6.2, figure 6-12, page 67",
        says: "Toe in has the largest break-out force on the way down.",
        test: "peak vertical wedge force while the bolster starts down (above 0.95 A): toe in > toe out, \
               toe in > no toe",
        runs: [cd_in_yaw, cd_out_yaw, cd_none_yaw],
        holds: all([
            peak(cd_in_yaw, vertical_force, starting_down) > peak(cd_out_yaw, vertical_force, starting_down),
            peak(cd_in_yaw, vertical_force, starting_down) > peak(cd_none_yaw, vertical_force, starting_down),
        ]),
        but: "At the top the wedge is wedged in deepest with toe out, whose gap is narrowest there, and \
              breaks out at the highest force; toe in overtakes it only later on the way down.",
    },
    undecidable! {
        id: "6.2-accurate-motion",
        group: ConstantYawed,
        place: "section 6.2, figure 6-12, page 67",
        says: "The differences between the toe cases show that the model captures the wedge's actual motion \
               accurately.",
        reason: "No motion was measured: the runs cannot say whether the model's differences are those of a \
                 real wedge.",
    },
    claim! {
        id: "6.2-toe-order-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-13, page 68",
        says: "Going up, toe in has the least force and toe out the greatest, with no toe between.",
        test: "mean vertical wedge force going up: toe out > no toe > toe in",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: descending(
            [cd_out_yaw, cd_none_yaw, cd_in_yaw].map(|run| mean(run, vertical_force, going_up)),
        ),
        but: "No toe comes out slightly above toe out: it has its full force from the reversal on, while \
              toe out begins low and reaches its higher limit only in the last part of the stroke. Toe in \
              is lowest, as claimed.",
    },
    claim! {
        id: "6.2-travel-order-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-13, page 68",
        says: "Going up, toe in lets the wedge move most, and toe out least.",
        test: "greatest vertical displacement of the wedge, from its nominal position, as script E.2 draws \
               it: toe in > no toe > toe out, each by more than 1 %",
        runs: [cd_in_yaw, cd_none_yaw, cd_out_yaw],
        holds: descending_by(
            0.01,
            [cd_in_yaw, cd_none_yaw, cd_out_yaw].map(|run| greatest(run, wedge_z, settled)),
        ),
        but: "The wedge follows the bolster to within the contacts' give, whatever the toe, and what goes up \
              in a cycle comes down: only the place of the loop can differ. It does where toe turns the \
              column about the coil's seat (side_frame.toe_pivot), which the thesis does not say: then toe \
              in lifts the wedge and toe out lowers it, and this order holds; with toe about the middle of \
              the face there is none.",
    },
    claim! {
        id: "6.2-toe-order-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-13, page 68",
        says: "Going down, toe in has the largest force and toe out the least, with no toe between.",
        test: "size of the mean vertical wedge force going down: toe in > no toe > toe out",
        runs: [cd_in_yaw, cd_none_yaw, cd_out_yaw],
        holds: descending(
            [cd_in_yaw, cd_none_yaw, cd_out_yaw].map(|run| size(run, vertical_force, going_down)),
        ),
        but: "No toe comes out slightly above toe in: toe in begins low at the top and builds up its force \
              only as its gap narrows, and with yaw it does so less in later cycles. Toe out is lowest, as \
              claimed.",
    },
    claim! {
        id: "6.2-travel-order-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-13, page 68",
        says: "Going down, toe in lets the wedge move least, and toe out most.",
        test: "greatest displacement of the wedge downwards, from its nominal position, as script E.2 draws \
               it: toe out > no toe > toe in, each by more than 1 %",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: descending_by(
            0.01,
            [cd_out_yaw, cd_none_yaw, cd_in_yaw].map(|run| -least(run, wedge_z, settled)),
        ),
        but: "The wedge follows the bolster to within the contacts' give, whatever the toe, and what goes up \
              in a cycle comes down: only the place of the loop can differ. It does where toe turns the \
              column about the coil's seat (side_frame.toe_pivot), which the thesis does not say: then toe \
              in lifts the wedge and toe out lowers it, and this order holds; with toe about the middle of \
              the face there is none.",
    },
    claim! {
        id: "6.2-longitudinal-less-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-14, page 69",
        says: "Going down, the longitudinal force is less with yaw than without (toe out).",
        test: "mean longitudinal force going down: with yaw < without",
        runs: [cd_out_yaw, cd_out],
        holds: mean(cd_out_yaw, longitudinal_force, going_down)
            < mean(cd_out, longitudinal_force, going_down),
        but: "Yaw turns one side of the pocket towards the column, which presses the wedge deeper against \
              its coil: the coil carries some three percent more, and both faces carry more, going down as \
              well as going up.",
    },
    claim! {
        id: "6.2-longitudinal-more-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-14, page 69",
        says: "Going up, the longitudinal force is greater with yaw than without (toe out).",
        test: "mean longitudinal force going up: with yaw > without",
        runs: [cd_out_yaw, cd_out],
        holds: mean(cd_out_yaw, longitudinal_force, going_up) > mean(cd_out, longitudinal_force, going_up),
    },
    claim! {
        id: "6.2-yaw-holds-wedge",
        group: ConstantYawed,
        place: "section 6.2, figure 6-14, page 69",
        says: "Yaw prevents some of the wedge's longitudinal motion as the bolster goes down (toe out).",
        test: "range of the wedge's longitudinal displacement while the bolster goes down: with yaw < \
               without",
        runs: [cd_out_yaw, cd_out],
        holds: range(cd_out_yaw, wedge_x, downwards) < range(cd_out, wedge_x, downwards),
        but: "All that moves the wedge longitudinally here is the contacts' give, some thousandths of an \
              inch; with yaw fewer corners carry the force, so that they give more.",
    },
    claim! {
        id: "6.2-longitudinal-toe-out-at-bottom",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "With toe out the longitudinal force is largest where the bolster is lowest.",
        test: "at the peak of the longitudinal force the bolster is below -0.9 of its amplitude",
        runs: [cd_out_yaw],
        holds: at_peak(cd_out_yaw, longitudinal_force, settled, bolster_z) < -0.9 * amplitude(cd_out_yaw),
        but: "With toe out the gap is narrowest at the top: the normal force grows on the way up, and is \
              largest near the top.",
    },
    claim! {
        id: "6.2-longitudinal-toe-out-largest",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "Toe out has the largest longitudinal peaks at the bottom of the toe cases.",
        test: "peak longitudinal force at the bottom reversal (bolster below -0.995 A): toe out > no toe, \
               toe out > toe in",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: all([
            peak(cd_out_yaw, longitudinal_force, at_bottom)
                > peak(cd_none_yaw, longitudinal_force, at_bottom),
            peak(cd_out_yaw, longitudinal_force, at_bottom) > peak(cd_in_yaw, longitudinal_force, at_bottom),
        ]),
        but: "At the bottom toe out has the widest gap and the lowest force, and toe in, wedged in, the \
              highest; toe out has its largest forces at the top.",
    },
    claim! {
        id: "6.2-gap-below-toe-out",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "With toe out the wedge is farthest from the lower part of the column when the bolster is \
               lowest.",
        test: "the gap at the wedge's lower right corner is open, and its mean at the bottom reversal \
               (bolster below -0.995 A) is within 10 % of the greatest in the run",
        runs: [cd_out_yaw],
        holds: all([
            greatest(cd_out_yaw, lower_gap, settled) > 0.0,
            mean(cd_out_yaw, lower_gap, at_bottom) > 0.9 * greatest(cd_out_yaw, lower_gap, settled),
        ]),
    },
    claim! {
        id: "6.2-longitudinal-toe-in-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "With toe in the longitudinal force is largest while the bolster goes up.",
        test: "at the peak of the longitudinal force the bolster goes up, with more than 10 % of its peak \
               speed",
        runs: [cd_in_yaw],
        holds: at_peak(cd_in_yaw, longitudinal_force, settled, bolster_speed)
            > 0.1 * peak(cd_in_yaw, bolster_speed, settled),
        but: "With toe in the wedge is wedged in deepest at the lower reversal; the force has its peak in \
              the jolt with which it breaks out there, and falls on the way up.",
    },
    claim! {
        id: "6.2-gap-above-toe-in",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "With toe in the gap between wedge and the upper part of the column is greatest as the \
               bolster goes up.",
        test: "mean gap at the wedge's upper right corner: bolster going up > going down, and the greatest \
               gap occurs as it goes up",
        runs: [cd_in_yaw],
        holds: all([
            mean(cd_in_yaw, upper_gap, upwards) > mean(cd_in_yaw, upper_gap, downwards),
            greatest(cd_in_yaw, upper_gap, upwards) > greatest(cd_in_yaw, upper_gap, downwards),
        ]),
        but: "With toe in the wedge stands on its lower edge and its upper edge stands off by its pitch, \
              which is greatest just after the upper reversal, when the column's friction tilts it the \
              other way: on the way down.",
    },
    claim! {
        id: "6.2-longitudinal-none-between",
        group: ConstantYawed,
        place: "section 6.2, figure 6-15, page 70",
        says: "The longitudinal forces without toe lie between toe in and toe out.",
        test: "mean longitudinal force: going up, toe out > no toe > toe in; going down, toe in > no toe > \
               toe out",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: all([
            descending(
                [cd_out_yaw, cd_none_yaw, cd_in_yaw].map(|run| mean(run, longitudinal_force, going_up)),
            ),
            descending(
                [cd_in_yaw, cd_none_yaw, cd_out_yaw].map(|run| mean(run, longitudinal_force, going_down)),
            ),
        ]),
        but: "The longitudinal force is the vertical one over the coefficient of friction: with yaw no toe \
              comes out slightly above toe out going up, and above toe in going down, because it has its \
              full force from the reversal on.",
    },
    claim! {
        id: "6.2-no-dissipation-only-sticking",
        group: ConstantYawed,
        place: "section 6.2, figure 6-16, page 71",
        says: "Dissipation at the side frame is zero only while the wedge sticks (toe out).",
        test: "where less than 0.02 % of the greatest rate is dissipated (a corner begins to stick at 0.001 \
               in/s, 0.05 % of the greatest speed), the column sticks at all times",
        runs: [cd_out_yaw],
        holds: share(cd_out_yaw, column_sticks, not_dissipating) == 1.0,
    },
    claim! {
        id: "6.2-dissipation-order-up",
        group: ConstantYawed,
        place: "section 6.2, figure 6-17, page 72",
        says: "Going up, toe out dissipates most and toe in least, with no toe between.",
        test: "size of the mean dissipation at the side frame going up: toe out > no toe > toe in",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: descending([cd_out_yaw, cd_none_yaw, cd_in_yaw].map(|run| size(run, dissipation, going_up))),
        but: "Dissipation is the vertical force times the same speed: going up, no toe comes out slightly \
              above toe out, which reaches its higher limit only in the last part of the stroke. Toe in is \
              lowest, as claimed.",
    },
    claim! {
        id: "6.2-dissipation-order-down",
        group: ConstantYawed,
        place: "section 6.2, figure 6-17, page 72",
        says: "Going down, toe in dissipates most and toe out least, with no toe between.",
        test: "size of the mean dissipation at the side frame going down: toe in > no toe > toe out",
        runs: [cd_in_yaw, cd_none_yaw, cd_out_yaw],
        holds: descending([cd_in_yaw, cd_none_yaw, cd_out_yaw].map(|run| size(run, dissipation, going_down))),
        but: "Dissipation is the vertical force times the same speed: going down, no toe comes out slightly \
              above toe in, which builds up its force only as its gap narrows. Toe out is lowest, as \
              claimed.",
    },
    claim! {
        id: "6.2-surface-in-contact",
        group: ConstantYawed,
        place: "section 6.2, figure 6-17, page 72",
        says: "With toe out more of the wedge's face touches the column than with toe in, as the wedge goes \
               up.",
        test: "mean number of column corners that touch going up: toe out > toe in by more than 10 %",
        runs: [cd_out_yaw, cd_in_yaw],
        holds: mean(cd_out_yaw, corners_touching, going_up)
            > 1.1 * mean(cd_in_yaw, corners_touching, going_up),
        but: "Two corners touch either way: a flat face between surfaces that toe and yaw turn against it \
              rests on an edge.",
    },
    undecidable! {
        id: "6.2-significant-moments",
        group: ConstantYawed,
        place: "section 6.2, figures 6-18 and 6-19, page 72",
        says: "The pitch and yaw moments are significant.",
        reason: "No number says what a significant moment is, and what chapter 5 calls small is of the same \
                 size: by one and the same threshold one of the statements must fail.",
    },
    claim! {
        id: "6.2-moments-by-sticking",
        group: ConstantYawed,
        place: "section 6.2, figures 6-18 and 6-19, pages 72 and 73",
        says: "The moments come from the wedge's sticking.",
        test: "the mean size of the pitch moment, and of the yaw moment, is greater while the column sticks \
               than while it slips, for each toe",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: every([cd_out_yaw, cd_none_yaw, cd_in_yaw], |run| all([
            mean_size(run, pitch_moment, column_sticks) > mean_size(run, pitch_moment, column_slips),
            mean_size(run, yaw_moment, column_sticks) > mean_size(run, yaw_moment, column_slips),
        ])),
        but: "The moments come from where the faces touch, on one side and one edge, and are much the same \
              while the column slides (all but a hundredth of the time) as while it sticks.",
    },
    claim! {
        id: "6.2-uneven-forces",
        group: ConstantYawed,
        place: "section 6.2, figures 6-18 and 6-19, page 73",
        says: "The forces on the wedge are unevenly distributed, which causes the moments.",
        test: "the upper corners' share of the column's normal force is on average more than 0.1 away from \
               one half, for each toe",
        runs: [cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: every([cd_out_yaw, cd_none_yaw, cd_in_yaw], |run| mean_size(run, unevenness, settled) > 0.1),
        but: "Between top and bottom they are uneven with toe only: without toe the upper and lower corners \
              share the force almost evenly (between left and right yaw makes them as uneven as can be, for \
              every toe).",
    },
];
