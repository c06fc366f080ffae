//! Chapter 7: what is concluded.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "7.1-four-coordinates",
        group: Conclusions,
        place: "section 7.1, page 74",
        says: "The model moves longitudinally and vertically, and turns in pitch and yaw; nothing else.",
        test: "with yaw, the wedge's longitudinal and vertical displacement, pitch and yaw have a range; its \
               lateral displacement and roll are zero",
        runs: [vd_out_yaw, cd_out_yaw],
        holds: every([vd_out_yaw, cd_out_yaw], |run| all([
            range(run, wedge_x, settled) > 0.0,
            range(run, wedge_z, settled) > 0.0,
            range(run, wedge_pitch, settled) > 0.0,
            range(run, wedge_yaw, settled) > 0.0,
            peak(run, wedge_y, settled) == 0.0,
            peak(run, wedge_roll, settled) == 0.0,
        ])),
    },
    claim! {
        id: "7.1-no-lateral-force",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "Lateral forces are zero for the inputs looked at: without yaw.",
        test: "the peak lateral force on the bolster is below 1e-6 of the peak longitudinal force, for each \
               run without yaw",
        runs: [vd_out, vd_none, vd_in, cd_out, cd_none, cd_in],
        holds: every([vd_out, vd_none, vd_in, cd_out, cd_none, cd_in], |run| {
            peak(run, lateral_force, settled) < 1e-6 * peak(run, longitudinal_force, settled)
        }),
    },
    claim! {
        id: "7.1-no-lateral-force-yawed",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "Lateral forces are zero for the inputs looked at: with yaw.",
        test: "the peak lateral force on the bolster is below 1 % of the peak longitudinal force, for each \
               run with yaw",
        runs: [vd_out_yaw, vd_none_yaw, vd_in_yaw, cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: every([vd_out_yaw, vd_none_yaw, vd_in_yaw, cd_out_yaw, cd_none_yaw, cd_in_yaw], |run| {
            peak(run, lateral_force, settled) < 0.01 * peak(run, longitudinal_force, settled)
        }),
        but: "With yaw the slope's friction has a large lateral part, and its normal force a small one; the \
              model holds the wedge's lateral coordinate, and that restraint carries what the column's \
              friction does not.",
    },
    undecidable! {
        id: "7.1-moments-not-validated",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "The yaw and pitch moments cannot be validated yet.",
        reason: "Validation needs measurements, and the thesis has none: twelve runs of one model can only \
                 be checked for consistency.",
    },
    claim! {
        id: "7.1-moments-calculated",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "The yaw and pitch moments can be calculated.",
        test: "with yaw, both have a range above zero, with either damping",
        runs: [vd_out_yaw, cd_out_yaw],
        holds: every([vd_out_yaw, cd_out_yaw], |run| all([
            range(run, pitch_moment, settled) > 0.0,
            range(run, yaw_moment, settled) > 0.0,
        ])),
    },
    claim! {
        id: "7.1-no-dissipation-in-lift-off",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "With variable damping no energy is dissipated during lift-off: whatever toe and yaw.",
        test: "the greatest rate of dissipation at the side frame in lift-off is below 1 % of the run's \
               greatest, for each run with variable damping",
        runs: [vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| {
            peak(run, dissipation, lift_off) < 0.01 * peak(run, dissipation, settled)
        }),
    },
    undecidable! {
        id: "7.1-model-accurate",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "That nothing is dissipated in lift-off helps to prove the model accurate.",
        reason: "It follows from the equations (no contact, no friction); a right and a wrong model both \
                 show it. Accuracy needs measurements.",
    },
    claim! {
        id: "7.1-energy-toe-in-most",
        group: Conclusions,
        place: "section 7.1, page 75",
        says: "With variable damping more energy is dissipated with toe in than with toe out.",
        test: "energy per cycle at the side frame: toe in > toe out, without and with yaw",
        runs: [vd_in, vd_out, vd_in_yaw, vd_out_yaw],
        holds: all([
            energy_per_cycle(vd_in) > energy_per_cycle(vd_out),
            energy_per_cycle(vd_in_yaw) > energy_per_cycle(vd_out_yaw),
        ]),
        but: "What toe in dissipates more going down it dissipates less going up, as the gap opens for it: \
              over the cycle it comes out slightly below toe out, without yaw as with it.",
    },
    claim! {
        id: "7.1-surface-in-contact",
        group: Conclusions,
        place: "section 7.1, pages 75 and 76",
        says: "That is because a larger surface is in contact with toe in.",
        test: "mean number of column corners that touch, bolster below its middle: toe in > toe out by more \
               than 10 %, without and with yaw",
        runs: [vd_in, vd_out, vd_in_yaw, vd_out_yaw],
        holds: all([
            mean(vd_in, corners_touching, pressed) > 1.1 * mean(vd_out, corners_touching, pressed),
            mean(vd_in_yaw, corners_touching, pressed) > 1.1 * mean(vd_out_yaw, corners_touching, pressed),
        ]),
        but: "A flat face between surfaces at an angle rests on an edge: about two corners touch with toe \
              in (the lower ones) as with toe out (the upper ones).",
    },
    claim! {
        id: "7.1-energy-conserved-constant",
        group: Conclusions,
        place: "section 7.1, page 76",
        says: "With constant damping, too, energy is conserved.",
        test: "read as: nothing is lost that is not accounted for. The relative residual of the energy \
               ledger is below 0.1 %, for each run with constant damping",
        runs: [cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: every(
            [cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw],
            |run| ledger_residual(run) < 1e-3,
        ),
    },
    claim! {
        id: "7.1-stick-slip-captured",
        group: Conclusions,
        place: "section 7.1, page 76",
        says: "The model captures stick-slip at the side frame.",
        test: "after the first half period the column sticks at some time, and slips at some time, in each \
               of the twelve runs",
        runs: [
            vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw,
            cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw,
        ],
        holds: every(
            [
                vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw,
                cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw,
            ],
            |run| all([
                share(run, column_sticks, settled) > 0.0,
                share(run, column_slips, settled) > 0.0,
            ])
        ),
    },
    claim! {
        id: "7.1-stick-slip-at-bolster",
        group: Conclusions,
        place: "section 7.1, page 76",
        says: "The wedge sticks to the bolster too, and slides against it.",
        test: "after the first half period the slope sticks at some time, and slips at some time, in each \
               of the twelve runs",
        runs: [
            vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw,
            cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw,
        ],
        holds: every(
            [
                vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw,
                cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw,
            ],
            |run| all([
                share(run, slope_sticks, settled) > 0.0,
                share(run, slope_slips, settled) > 0.0,
            ])
        ),
        but: "Eleven runs do both; with constant damping and neither toe nor yaw, the slope sticks all the \
              time: the wedge goes up and down with the bolster as one body.",
    },
    claim! {
        id: "7.1-largest-forces-stuck-variable",
        group: Conclusions,
        place: "section 7.1, page 76",
        says: "In the hysteresis plots the largest forces come with the wedge stuck to the side frame: \
               variable damping.",
        test: "the column sticks where the force on the side frame has its peak, for each run with variable \
               damping",
        runs: [vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw],
        holds: every([vd_out, vd_none, vd_in, vd_out_yaw, vd_none_yaw, vd_in_yaw], |run| {
            so_at_peak(run, side_frame_force, settled, column_sticks)
        }),
        but: "With one coefficient for rest and sliding, friction has no break-out peak: a stuck face never \
              carries more than a sliding one, and the force has its peak while the wedge still slides, \
              slowly, just before the reversal.",
    },
    claim! {
        id: "7.1-largest-forces-stuck-constant",
        group: Conclusions,
        place: "section 7.1, page 76",
        says: "In the hysteresis plots the largest forces come with the wedge stuck to the side frame: \
               constant damping.",
        test: "the column sticks where the vertical wedge force has its peak, for each run with constant \
               damping",
        runs: [cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw],
        holds: every([cd_out, cd_none, cd_in, cd_out_yaw, cd_none_yaw, cd_in_yaw], |run| {
            so_at_peak(run, vertical_force, settled, column_sticks)
        }),
        but: "With one coefficient for rest and sliding, friction has no break-out peak: the force has its \
              peak while the wedge slides, near the end of the stroke where it is wedged in deepest.",
    },
    claim! {
        id: "7.2-curved-slope",
        group: Conclusions,
        place: "section 7.2, page 76",
        says: "A curved slope, as real wedges have, would not change the motion for simple inputs.",
        test: "with a slope face crowned by 60 in, along the slope and across it (41 points), toe out \
               without yaw: the range of the wedge's vertical displacement and the energy per cycle at the \
               side frame are within 10 % of those with a flat slope, with either damping; how far the \
               wedge drifts along the track in lift-off, where nothing holds it, is not asked",
        runs: [vd_out, vd_out_up, vd_out_across, cd_out, cd_out_up, cd_out_across],
        holds: all([
            within(0.1, [vd_out, vd_out_up, vd_out_across].map(|run| range(run, wedge_z, settled))),
            within(0.1, [cd_out, cd_out_up, cd_out_across].map(|run| range(run, wedge_z, settled))),
            within(0.1, [vd_out, vd_out_up, vd_out_across].map(energy_per_cycle)),
            within(0.1, [cd_out, cd_out_up, cd_out_across].map(energy_per_cycle)),
        ]),
    },
];
