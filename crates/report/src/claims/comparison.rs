//! What chapters 5 to 7 say of the stand-alone wedge against types 6.8 and 6.9 of the comparison program.
//!
//! Decided from *our reading* of these types in the half-truck of the printed files, toe out, wedge 127: with yaw, the yaw that
//! the files intend. Where a statement speaks of that program's output, a verdict here says what our reading of it shows.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "5.1-types-magnitudes",
        group: Comparison,
        place: "section 5.1, figure 5-1, page 41",
        says: "The vertical forces of all models are similar in magnitude (variable damping, toe out).",
        test: "the peak forces on the side frame of the stand-alone model, type 6.8 and type 6.9 differ by no more than 10 %, \
               and so do their means going down",
        runs: [vd_out, vd_out_68, vd_out_69],
        holds: all([
            within(0.1, [vd_out, vd_out_68, vd_out_69].map(|run| peak(run, side_frame_force, settled))),
            within(0.1, [vd_out, vd_out_68, vd_out_69].map(|run| size(run, side_frame_force, going_down))),
        ]),
    },
    claim! {
        id: "5.1-types-magnitudes-up",
        group: Comparison,
        place: "section 5.1, figure 5-1, page 41",
        says: "They are similar too as the bolster goes up again.",
        test: "the mean column friction of the three going up differs by no more than 10 %",
        runs: [vd_out, vd_out_68, vd_out_69],
        holds: within(0.1, [vd_out, vd_out_68, vd_out_69].map(|run| size(run, vertical_force, going_up))),
    },
    claim! {
        id: "5.1-types-stick-slip",
        group: Comparison,
        place: "section 5.1, figure 5-1, page 41",
        says: "The stand-alone model is significantly better at capturing stick-slip.",
        test: "while the bolster presses down, its force on the side frame is rougher (mean size of its second difference from \
               row to row) than either type's by more than 10 %, and it sticks for a larger share of the time",
        runs: [vd_out, vd_out_68, vd_out_69],
        holds: every([vd_out_68, vd_out_69], |run| all([
            roughness(vd_out, side_frame_force, pressing_down) > 1.1 * roughness(run, side_frame_force, pressing_down),
            share(vd_out, column_sticks, pressing_down) > share(run, column_sticks, pressing_down),
        ])),
    },
    claim! {
        id: "5.1-types-lift-off",
        group: Comparison,
        place: "section 5.1, figure 5-1, page 41",
        says: "The stand-alone model is significantly better at capturing lift-off: its force oscillates about zero there, as \
               its wedge has a mass.",
        test: "in lift-off, with the bolster rising, its force on the side frame rings at more than 5 Hz, and those of the types do \
               not change at all (range below 1e-6 of its peak)",
        runs: [vd_out, vd_out_68, vd_out_69],
        holds: all([
            ringing_frequency(vd_out, side_frame_force, early_lift_off) > 5.0 * hertz,
            range(vd_out_68, side_frame_force, early_lift_off) < 1e-6 * peak(vd_out_68, side_frame_force, settled),
            range(vd_out_69, side_frame_force, early_lift_off) < 1e-6 * peak(vd_out_69, side_frame_force, settled),
        ]),
    },
    claim! {
        id: "5.1-longitudinal-on-par",
        group: Comparison,
        place: "section 5.1, figure 5-5, page 45",
        says: "In calculating longitudinal forces the stand-alone model is on par with type 6.9 (variable damping).",
        test: "their mean longitudinal forces differ by no more than 10 %, going up and going down",
        runs: [vd_out, vd_out_69],
        holds: all([
            within(0.1, [vd_out, vd_out_69].map(|run| size(run, longitudinal_force, going_down))),
            within(0.1, [vd_out, vd_out_69].map(|run| size(run, longitudinal_force, going_up))),
        ]),
    },
    claim! {
        id: "5.1-type-6.8-plane",
        group: Comparison,
        place: "section 5.1, page 45",
        says: "Type 6.8 cannot calculate longitudinal forces.",
        test: "its table has no longitudinal force, that of type 6.9 has one, with either damping",
        runs: [vd_out_68, cd_out_68, vd_out_69, cd_out_69],
        holds: all([
            lacks(vd_out_68, "longitudinal_wedge_force"),
            lacks(cd_out_68, "longitudinal_wedge_force"),
            !lacks(vd_out_69, "longitudinal_wedge_force"),
            !lacks(cd_out_69, "longitudinal_wedge_force"),
        ]),
    },
    claim! {
        id: "5.1-longitudinal-periodic-6.9",
        group: Comparison,
        place: "section 5.1, figure 5-5, page 45",
        says: "The longitudinal forces stay relatively periodic, as the input is: type 6.9, variable damping.",
        test: "from one cycle to the next the longitudinal force of type 6.9 changes by less than 10 % of its size (root mean \
               squares)",
        runs: [vd_out_69],
        holds: change_between_cycles(vd_out_69, longitudinal_force) < 0.1,
    },
    claim! {
        id: "5.1-types-no-dissipation-in-lift-off",
        group: Comparison,
        place: "section 5.1, figure 5-7, page 46",
        says: "No energy is dissipated during lift-off, in any of the models.",
        test: "the largest friction power in lift-off is below 1 % of the run's largest, for each of the three",
        runs: [vd_out, vd_out_68, vd_out_69],
        holds: every([vd_out, vd_out_68, vd_out_69], |run| {
            peak(run, friction_power, lift_off) < 0.01 * peak(run, friction_power, settled)
        }),
    },
    claim! {
        id: "5.2-longitudinal-lower-6.9",
        group: Comparison,
        place: "section 5.2, figure 5-13, page 52",
        says: "With yaw the longitudinal forces are lower than without: type 6.9.",
        test: "the mean longitudinal force of type 6.9 with the bolster below its middle, and its peak, are lower with yaw than \
               without",
        runs: [vd_out_69, vd_out_yaw_69],
        holds: all([
            mean(vd_out_yaw_69, longitudinal_force, pressed) < mean(vd_out_69, longitudinal_force, pressed),
            peak(vd_out_yaw_69, longitudinal_force, settled) < peak(vd_out_69, longitudinal_force, settled),
        ]),
    },
    claim! {
        id: "5.2-dissipation-close-to-6.9",
        group: Comparison,
        place: "section 5.2, figure 5-15, page 53",
        says: "With yaw the rate of dissipation of the stand-alone model correlates closely with that of type 6.9.",
        test: "the correlation of their friction powers is above 0.9, and their energies per cycle differ by no more than 10 %",
        runs: [vd_out_yaw, vd_out_yaw_69],
        holds: all([
            correlation(vd_out_yaw, vd_out_yaw_69, friction_power, settled) > 0.9,
            within(0.1, [vd_out_yaw, vd_out_yaw_69].map(energy_per_cycle)),
        ]),
    },
    claim! {
        id: "5.2-dissipation-closer-to-6.9",
        group: Comparison,
        place: "section 5.2, figure 5-15, page 53",
        says: "It correlates especially with type 6.9: more closely than with type 6.8.",
        test: "the correlation of the friction powers is greater with type 6.9 than with type 6.8",
        runs: [vd_out_yaw, vd_out_yaw_68, vd_out_yaw_69],
        holds: correlation(vd_out_yaw, vd_out_yaw_69, friction_power, settled)
            > correlation(vd_out_yaw, vd_out_yaw_68, friction_power, settled),
    },
    claim! {
        id: "5.2-dissipation-comparable-to-6.8",
        group: Comparison,
        place: "section 5.2, figure 5-15, page 53",
        says: "It is comparable to that of type 6.8.",
        test: "the energies per cycle of the stand-alone model and of type 6.8 differ by no more than 25 %",
        runs: [vd_out_yaw, vd_out_yaw_68],
        holds: within(0.25, [vd_out_yaw, vd_out_yaw_68].map(energy_per_cycle)),
    },
    claim! {
        id: "6.1-coil-force-constant-6.9",
        group: Comparison,
        place: "section 6.1, page 57",
        says: "With constant damping the coil moves slightly, but its force changes very little: type 6.9.",
        test: "the range of the coil force of type 6.9 is below 5 % of its mean",
        runs: [cd_out_69],
        holds: range(cd_out_69, coil_force, settled) < 0.05 * mean(cd_out_69, coil_force, settled),
    },
    claim! {
        id: "6.1-types-magnitudes",
        group: Comparison,
        place: "section 6.1, figure 6-1, page 58",
        says: "The vertical forces of both types and of the stand-alone model are similar in magnitude (constant damping).",
        test: "the mean column friction of the three differs by no more than 10 %, going up and going down",
        runs: [cd_out, cd_out_68, cd_out_69],
        holds: all([
            within(0.1, [cd_out, cd_out_68, cd_out_69].map(|run| size(run, vertical_force, going_up))),
            within(0.1, [cd_out, cd_out_68, cd_out_69].map(|run| size(run, vertical_force, going_down))),
        ]),
    },
    claim! {
        id: "6.1-types-stick-slip",
        group: Comparison,
        place: "section 6.1, figure 6-1, page 58",
        says: "The stand-alone model is significantly better at capturing the oscillation of stick-slip: the wedge sticks up to a \
               break-out point, and then slips.",
        test: "within a branch of its motion the force of the stand-alone model has more peaks in all than either type's, and \
               it sticks for a larger share of the time",
        runs: [cd_out, cd_out_68, cd_out_69],
        holds: every([cd_out_68, cd_out_69], |run| all([
            peaks(cd_out, vertical_force, settled) > peaks(run, vertical_force, settled),
            share(cd_out, column_sticks, settled) > share(run, column_sticks, settled),
        ])),
    },
    claim! {
        id: "6.1-longitudinal-similar",
        group: Comparison,
        place: "section 6.1, figure 6-5, page 62",
        says: "The longitudinal forces of the stand-alone model are similar to those of type 6.9 (constant damping).",
        test: "their mean longitudinal forces differ by no more than 10 %, going up and going down",
        runs: [cd_out, cd_out_69],
        holds: all([
            within(0.1, [cd_out, cd_out_69].map(|run| size(run, longitudinal_force, going_up))),
            within(0.1, [cd_out, cd_out_69].map(|run| size(run, longitudinal_force, going_down))),
        ]),
    },
    claim! {
        id: "6.1-longitudinal-periodic-6.9",
        group: Comparison,
        place: "section 6.1, figure 6-5, page 62",
        says: "The longitudinal forces stay relatively periodic, as the input is: type 6.9, constant damping.",
        test: "from one cycle to the next the longitudinal force of type 6.9 changes by less than 10 % of its size (root mean \
               squares)",
        runs: [cd_out_69],
        holds: change_between_cycles(cd_out_69, longitudinal_force) < 0.1,
    },
    claim! {
        id: "6.1-types-zero-only-stuck",
        group: Comparison,
        place: "section 6.1, figure 6-7, page 64",
        says: "With constant damping the rate of dissipation is zero only while the wedge sticks: both types.",
        test: "while the friction power of a type is below 0.02 % of its greatest, its friction sticks for more than 95 % of \
               the time",
        runs: [cd_out_68, cd_out_69],
        holds: every([cd_out_68, cd_out_69], |run| share(run, column_sticks, powerless) > 0.95),
    },
    claim! {
        id: "6.1-types-never-lift-off",
        group: Comparison,
        place: "section 6.1, figure 6-7, page 64",
        says: "There is never lift-off with constant damping: both types.",
        test: "the column is never open, in either type's run",
        runs: [cd_out_68, cd_out_69],
        holds: every([cd_out_68, cd_out_69], |run| share(run, column_open, settled) == 0.0),
    },
    claim! {
        id: "6.2-types-magnitudes",
        group: Comparison,
        place: "section 6.2, figure 6-10, page 67",
        says: "With yaw the vertical forces of both types and of the stand-alone model are similar in magnitude.",
        test: "the mean column friction of the three differs by no more than 10 %, going up and going down",
        runs: [cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69],
        holds: all([
            within(0.1, [cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69].map(|run| size(run, vertical_force, going_up))),
            within(0.1, [cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69].map(|run| size(run, vertical_force, going_down))),
        ]),
    },
    claim! {
        id: "6.2-types-stick-slip",
        group: Comparison,
        place: "section 6.2, figure 6-10, page 68",
        says: "With yaw too the stand-alone model is significantly better at capturing the oscillation of stick-slip.",
        test: "the force of the stand-alone model has more peaks than either type's, and it sticks for a larger share of the \
               time",
        runs: [cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69],
        holds: every([cd_out_yaw_68, cd_out_yaw_69], |run| all([
            peaks(cd_out_yaw, vertical_force, settled) > peaks(run, vertical_force, settled),
            share(cd_out_yaw, column_sticks, settled) > share(run, column_sticks, settled),
        ])),
    },
    claim! {
        id: "6.2-longitudinal-same-magnitude",
        group: Comparison,
        place: "section 6.2, page 70",
        says: "The longitudinal forces of the stand-alone model are of the same magnitude as those of type 6.9, for both inputs.",
        test: "their mean longitudinal forces over the whole cycles differ by no more than 10 %, without and with yaw",
        runs: [cd_out, cd_out_69, cd_out_yaw, cd_out_yaw_69],
        holds: all([
            within(0.1, [cd_out, cd_out_69].map(|run| mean(run, longitudinal_force, settled))),
            within(0.1, [cd_out_yaw, cd_out_yaw_69].map(|run| mean(run, longitudinal_force, settled))),
        ]),
    },
    claim! {
        id: "7.1-forces-correlate",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "Longitudinal and vertical wedge forces of the stand-alone model correlate closely with those of both types: \
               without yaw.",
        test: "the correlation of the column friction with that of each type, and of the longitudinal force with that of type \
               6.9, is above 0.9, with either damping",
        runs: [vd_out, vd_out_68, vd_out_69, cd_out, cd_out_68, cd_out_69],
        holds: all([
            correlation(vd_out, vd_out_68, vertical_force, settled) > 0.9,
            correlation(vd_out, vd_out_69, vertical_force, settled) > 0.9,
            correlation(vd_out, vd_out_69, longitudinal_force, settled) > 0.9,
            correlation(cd_out, cd_out_68, vertical_force, settled) > 0.9,
            correlation(cd_out, cd_out_69, vertical_force, settled) > 0.9,
            correlation(cd_out, cd_out_69, longitudinal_force, settled) > 0.9,
        ]),
    },
    claim! {
        id: "7.1-forces-correlate-yawed",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "Longitudinal and vertical wedge forces of the stand-alone model correlate closely with those of both types: with \
               yaw.",
        test: "the correlation of the column friction with that of each type, and of the longitudinal force with that of type \
               6.9, is above 0.9, with either damping",
        runs: [vd_out_yaw, vd_out_yaw_68, vd_out_yaw_69, cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69],
        holds: all([
            correlation(vd_out_yaw, vd_out_yaw_68, vertical_force, settled) > 0.9,
            correlation(vd_out_yaw, vd_out_yaw_69, vertical_force, settled) > 0.9,
            correlation(vd_out_yaw, vd_out_yaw_69, longitudinal_force, settled) > 0.9,
            correlation(cd_out_yaw, cd_out_yaw_68, vertical_force, settled) > 0.9,
            correlation(cd_out_yaw, cd_out_yaw_69, vertical_force, settled) > 0.9,
            correlation(cd_out_yaw, cd_out_yaw_69, longitudinal_force, settled) > 0.9,
        ]),
    },
    undecidable! {
        id: "7.1-updated-type-6.9",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "After the comparison type 6.9 was updated; the updated one is very similar to the stand-alone model, above all in \
               the longitudinal forces.",
        reason: "What was changed in type 6.9 is not told, and no output of it is at hand, before or after.",
    },
    undecidable! {
        id: "7.1-proven-models",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "The stand-alone model was evaluated against proven models, for lack of measurements.",
        reason: "That these models are proven is not shown in the thesis; and what is compared here is our reading of them. \
                 Agreement of models is no measurement.",
    },
    claim! {
        id: "7.1-no-lateral-force-types",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "The lateral forces are zero in all models: without yaw.",
        test: "the peak lateral force is below 1e-6 of the peak column friction, for all three models and both dampings",
        runs: [vd_out, vd_out_68, vd_out_69, cd_out, cd_out_68, cd_out_69],
        holds: every([vd_out, vd_out_68, vd_out_69, cd_out, cd_out_68, cd_out_69], |run| {
            peak(run, lateral_force, settled) < 1e-6 * peak(run, vertical_force, settled)
        }),
    },
    claim! {
        id: "7.1-no-lateral-force-types-yawed",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "The lateral forces are zero in all models: with yaw.",
        test: "the peak lateral force is below 1 % of the peak column friction, for both types and both dampings",
        runs: [vd_out_yaw_68, vd_out_yaw_69, cd_out_yaw_68, cd_out_yaw_69],
        holds: every([vd_out_yaw_68, vd_out_yaw_69, cd_out_yaw_68, cd_out_yaw_69], |run| {
            peak(run, lateral_force, settled) < 0.01 * peak(run, vertical_force, settled)
        }),
    },
    claim! {
        id: "7.1-dissipation-magnitude-types",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "The rate of energy dissipation is similar in magnitude in all models.",
        test: "the energies per cycle of the three differ by no more than 10 %, with either damping, without and with yaw",
        runs: [
            vd_out, vd_out_68, vd_out_69, vd_out_yaw, vd_out_yaw_68, vd_out_yaw_69,
            cd_out, cd_out_68, cd_out_69, cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69,
        ],
        holds: all([
            within(0.1, [vd_out, vd_out_68, vd_out_69].map(energy_per_cycle)),
            within(0.1, [vd_out_yaw, vd_out_yaw_68, vd_out_yaw_69].map(energy_per_cycle)),
            within(0.1, [cd_out, cd_out_68, cd_out_69].map(energy_per_cycle)),
            within(0.1, [cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69].map(energy_per_cycle)),
        ]),
    },
    claim! {
        id: "7.1-dissipation-shape-types",
        group: Comparison,
        place: "section 7.1, page 75",
        says: "The rate of energy dissipation is similar in shape in all models.",
        test: "the correlation of the friction power of the stand-alone model with that of each type is above 0.9, with either \
               damping, without and with yaw",
        runs: [
            vd_out, vd_out_68, vd_out_69, vd_out_yaw, vd_out_yaw_68, vd_out_yaw_69,
            cd_out, cd_out_68, cd_out_69, cd_out_yaw, cd_out_yaw_68, cd_out_yaw_69,
        ],
        holds: all([
            correlation(vd_out, vd_out_68, friction_power, settled) > 0.9,
            correlation(vd_out, vd_out_69, friction_power, settled) > 0.9,
            correlation(vd_out_yaw, vd_out_yaw_68, friction_power, settled) > 0.9,
            correlation(vd_out_yaw, vd_out_yaw_69, friction_power, settled) > 0.9,
            correlation(cd_out, cd_out_68, friction_power, settled) > 0.9,
            correlation(cd_out, cd_out_69, friction_power, settled) > 0.9,
            correlation(cd_out_yaw, cd_out_yaw_68, friction_power, settled) > 0.9,
            correlation(cd_out_yaw, cd_out_yaw_69, friction_power, settled) > 0.9,
        ]),
    },
];
