//! Section 5.1: variable damping, bolster not yawed.

use super::measures::*;
use super::words::*;
use super::{Claim, claim, undecidable};

pub(super) static CLAIMS: &[Claim] = &[
    claim! {
        id: "5.1-rings-about-zero",
        group: Variable,
        place: "section 5.1, figure 5-1, page 42",
        says: "With the bolster off the wedge the vertical force oscillates close to zero (toe out).",
        test: "in lift-off the vertical force on the side frame stays below 5 % of its peak in the run, and \
               crosses its mean (which is the weight that the coil carries) time and again, with the bolster \
               rising at more than 5 Hz",
        runs: [vd_out],
        holds: all([
            peak(vd_out, side_frame_force, lift_off) < 0.05 * peak(vd_out, side_frame_force, settled),
            ringing_frequency(vd_out, side_frame_force, early_lift_off) > 5.0 * hertz,
        ]),
    },
    claim! {
        id: "5.1-sticks-and-slips-down",
        group: Variable,
        place: "section 5.1, figure 5-1, page 42",
        says: "While the bolster presses down (1.5 to 2.4 s), the wedge sticks and slips along the column \
               (toe out).",
        test: "while the bolster is below its middle and goes down, the column sticks for more than 5 % of \
               the time, and slips for more than 5 %",
        runs: [vd_out],
        holds: all([
            share(vd_out, column_sticks, pressing_down) > 0.05,
            share(vd_out, column_slips, pressing_down) > 0.05,
        ]),
        but: "With toe out the wedge slides steadily all the way down: with one coefficient for rest and \
              sliding, and a bolster that moves as prescribed, it sticks only for some hundredths of a \
              second at the reversal.",
    },
    claim! {
        id: "5.1-smoother-up",
        group: Variable,
        place: "section 5.1, figure 5-1, page 42",
        says: "As the bolster goes up again (2.4 to 3.2 s), the wedge slides more smoothly than on its way \
               down (toe out).",
        test: "the side-frame dissipation is less rough (mean size of its second difference from row to \
               row) going up than going down, by more than 10 %, over the branches (without the reversal)",
        runs: [vd_out],
        holds: roughness(vd_out, dissipation, going_up) < 0.9 * roughness(vd_out, dissipation, going_down),
        but: "At the default tolerance a few strikes on the way down decide: over tolerances from 1e-5 to \
              5e-7 the way up is 0.9 to 1.4 times as rough as the way down. It settles below 3e-7, where \
              the way up is smoother by a fifth.",
    },
    claim! {
        id: "5.1-moves-up-together",
        group: Variable,
        place: "section 5.1, figures 5-2 and 5-4, pages 43 and 44",
        says: "Section (1) of the loop: wedge and bolster both move up, whatever the toe.",
        test: "the wedge rises for more than 90 % of the time in which the bolster is below its middle and \
               goes up",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| share(run, rising, returning_up) > 0.9),
    },
    claim! {
        id: "5.1-lifts-off-completely",
        group: Variable,
        place: "section 5.1, figures 5-2 and 5-4, pages 43 and 44",
        says: "Section (2): the bolster is lifted off the wedge completely, whatever the toe.",
        test: "no corner of the slope touches for more than 95 % of lift-off",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| share(run, bolster_off, lift_off) > 0.95),
    },
    claim! {
        id: "5.1-slides-down",
        group: Variable,
        place: "section 5.1, figures 5-2 and 5-4, pages 43 and 44",
        says: "Section (3): the bolster presses the wedge down, which slips along the column, whatever the \
               toe.",
        test: "the wedge slides down for more than 50 % of the time in which the bolster is below its \
               middle and goes down",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| share(run, sliding_down, pressing_down) > 0.5),
    },
    claim! {
        id: "5.1-stick-gives-largest-force",
        group: Variable,
        place: "section 5.1, figures 5-2 and 5-4, pages 43 and 45",
        says: "Section (4): still in the downward phase the wedge sticks to the column, with a large force \
               and no motion.",
        test: "in the 0.1 s about the bottom reversal the column sticks at some time, the force on the side \
               frame goes through more than half its range in the run, and the wedge through less than 1 % \
               of its own, for each toe",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| all([
            share(run, column_sticks, at_bottom) > 0.0,
            range(run, side_frame_force, at_bottom) > 0.5 * range(run, side_frame_force, settled),
            range(run, wedge_z, at_bottom) < 0.01 * range(run, wedge_z, settled),
        ])),
    },
    claim! {
        id: "5.1-toe-matters-little",
        group: Variable,
        place: "section 5.1, figure 5-3, page 43",
        says: "The toe angles are so small that the vertical forces of the three toe cases differ very \
               little.",
        test: "the mean forces on the side frame (lower stroke) of the three toe cases differ by no more \
               than 10 % going down, and by no more than 10 % going up",
        runs: [vd_out, vd_none, vd_in],
        holds: all([
            within(0.1, [vd_out, vd_none, vd_in].map(|run| size(run, side_frame_force, going_down))),
            within(0.1, [vd_out, vd_none, vd_in].map(|run| size(run, side_frame_force, going_up))),
        ]),
        but: "Going down they do, but going up the force on the side frame is what is left of the coil's \
              force after the friction, a small difference, and with toe in the friction is lower as the \
              gap opens again.",
    },
    undecidable! {
        id: "5.1-accurate-motion",
        group: Variable,
        place: "section 5.1, figure 5-3, page 43",
        says: "The small differences between the toe cases show that the model captures the wedge's actual \
               motion accurately.",
        reason: "No motion was measured. That three runs of one model differ little says nothing about a \
                 real wedge.",
    },
    claim! {
        id: "5.1-toe-order-down",
        group: Variable,
        place: "section 5.1, figures 5-3 and 5-4, page 44",
        says: "Toe out gives the lowest vertical forces, toe in the highest: going down.",
        test: "size of the mean vertical wedge force going down: toe in > no toe > toe out; and the same of \
               the force on the side frame",
        runs: [vd_out, vd_none, vd_in],
        holds: all([
            descending([vd_in, vd_none, vd_out].map(|run| size(run, vertical_force, going_down))),
            descending([vd_in, vd_none, vd_out].map(|run| size(run, side_frame_force, going_down))),
        ]),
    },
    claim! {
        id: "5.1-toe-order-up",
        group: Variable,
        place: "section 5.1, figures 5-3 and 5-4, page 44",
        says: "Toe out gives the lowest vertical forces, toe in the highest: going up.",
        test: "size of the mean vertical wedge force going up: toe in > no toe > toe out",
        runs: [vd_out, vd_none, vd_in],
        holds: descending([vd_in, vd_none, vd_out].map(|run| size(run, vertical_force, going_up))),
        but: "Going up, with the gap opening for it, a wedge with toe in sticks to the slope most of the \
              way: the slope's friction stays well below the limit that it holds with toe out, and so does \
              the column's normal force, which makes toe in the lowest.",
    },
    claim! {
        id: "5.1-smoother-contact-toe-out",
        group: Variable,
        place: "section 5.1, figures 5-3 and 5-4, page 44",
        says: "The contact between wedge and column is smoother with toe out than with toe in.",
        test: "while the bolster is below its middle, the longitudinal force is less rough (mean size of its \
               second difference from row to row) with toe out than with toe in",
        runs: [vd_out, vd_in],
        holds: roughness(vd_out, longitudinal_force, pressed) < roughness(vd_in, longitudinal_force, pressed),
    },
    claim! {
        id: "5.1-lift-off-after-3-s",
        group: Variable,
        place: "section 5.1, figure 5-3, page 44",
        says: "Lift-off happens slightly after 3 s, whatever the toe.",
        test: "after the bolster's first way down, the slope's corners are first all open, with the bolster \
               going up, between 3.0 and 3.3 s",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| {
            let time = first_time(run, bolster_off, upwards);
            time > 3.0 && time < 3.3
        }),
    },
    claim! {
        id: "5.1-rings-about-zero-any-toe",
        group: Variable,
        place: "section 5.1, figures 5-3 and 5-4, pages 44 and 45",
        says: "During lift-off the vertical force oscillates about zero, whatever the toe.",
        test: "in lift-off the vertical force on the side frame stays below 5 % of its peak in the run, and \
               crosses its mean (which is the weight that the coil carries) at more than 5 Hz with the \
               bolster rising, for each toe",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| all([
            peak(run, side_frame_force, lift_off) < 0.05 * peak(run, side_frame_force, settled),
            ringing_frequency(run, side_frame_force, early_lift_off) > 5.0 * hertz,
        ])),
    },
    claim! {
        id: "5.1-mass-on-coil",
        group: Variable,
        place: "section 5.1, figures 5-1 and 5-3, pages 42 and 44",
        says: "The ringing in lift-off is that of the wedge's mass on the control coil.",
        test: "in lift-off, with the bolster rising, the force on the side frame crosses its mean with the \
               wedge's natural frequency on its coil, within 10 %, for each toe",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| {
            within(0.1, [ringing_frequency(run, side_frame_force, early_lift_off), natural_frequency(run)])
        }),
    },
    claim! {
        id: "5.1-loops-alike",
        group: Variable,
        place: "section 5.1, figure 5-4, page 44",
        says: "The hysteresis loops of the three toe cases differ little.",
        test: "the energies per cycle at the side frame (the areas of the loops of the column friction) of \
               the three toe cases differ by no more than 10 %",
        runs: [vd_out, vd_none, vd_in],
        holds: within(0.1, [energy_per_cycle(vd_out), energy_per_cycle(vd_none), energy_per_cycle(vd_in)]),
    },
    claim! {
        id: "5.1-longitudinal-ringing",
        group: Variable,
        place: "section 5.1, figure 5-5, page 45",
        says: "The longitudinal force shows the wedge ringing between bolster and side frame (toe out).",
        test: "the longitudinal force has more than 10 peaks (followed by falls of more than 2 % of its \
               greatest value) in the time after the first half period: some four a cycle",
        runs: [vd_out],
        holds: peaks(vd_out, longitudinal_force, settled) > 10.0,
        but: "With toe out the wedge slides steadily on both faces; the contacts ring only as the bolster \
              lands on it and where it turns, in bursts too short for rows a hundredth of a second apart, \
              as the thesis has them (rows 2 ms apart show some 17 peaks).",
    },
    claim! {
        id: "5.1-longitudinal-periodic",
        group: Variable,
        place: "section 5.1, figure 5-5, page 45",
        says: "The longitudinal force stays fairly periodic (toe out).",
        test: "from one cycle to the next the longitudinal force changes by less than 20 % (root mean \
               square, relative)",
        runs: [vd_out],
        holds: change_between_cycles(vd_out, longitudinal_force) < 0.2,
    },
    claim! {
        id: "5.1-fewer-peaks-toe-out",
        group: Variable,
        place: "section 5.1, figure 5-6, page 45",
        says: "The longitudinal force has fewer peaks with toe out than without toe.",
        test: "number of peaks (followed by falls of more than 2 % of the greatest value): toe out < no toe",
        runs: [vd_out, vd_none],
        holds: peaks(vd_out, longitudinal_force, settled) < peaks(vd_none, longitudinal_force, settled),
    },
    claim! {
        id: "5.1-fewer-peaks-toe-in",
        group: Variable,
        place: "section 5.1, figure 5-6, page 45",
        says: "The longitudinal force has fewer peaks with toe in than without toe.",
        test: "number of peaks (followed by falls of more than 2 % of the greatest value): toe in < no toe",
        runs: [vd_in, vd_none],
        holds: peaks(vd_in, longitudinal_force, settled) < peaks(vd_none, longitudinal_force, settled),
        but: "That is so in rows a hundredth of a second apart, as the thesis has them, which are too \
              coarse for ringing above 100 Hz; in rows 2 ms apart no toe has more peaks than toe in (some \
              220 against 150), as claimed.",
    },
    claim! {
        id: "5.1-toe-constrains",
        group: Variable,
        place: "section 5.1, figure 5-6, page 45",
        says: "With toe, in or out, bolster and side frame constrain the wedge's movement more than without.",
        test: "range of the wedge's longitudinal displacement after the first half period: toe out < no \
               toe, toe in < no toe",
        runs: [vd_out, vd_none, vd_in],
        holds: all([
            range(vd_out, wedge_x, settled) < range(vd_none, wedge_x, settled),
            range(vd_in, wedge_x, settled) < range(vd_none, wedge_x, settled),
        ]),
        but: "Most of the movement happens in lift-off, where nothing constrains the wedge: it stands on \
              its coil as on an inverted pendulum, and toe, which lets it go off its middle, makes it drift \
              farther before the bolster returns.",
    },
    claim! {
        id: "5.1-no-dissipation-in-lift-off",
        group: Variable,
        place: "section 5.1, figure 5-7, page 46",
        says: "During lift-off nothing is dissipated at the side frame (toe out).",
        test: "the greatest rate of dissipation in lift-off is below 1 % of the run's greatest",
        runs: [vd_out],
        holds: peak(vd_out, dissipation, lift_off) < 0.01 * peak(vd_out, dissipation, settled),
    },
    claim! {
        id: "5.1-ringing-conserves-energy",
        group: Variable,
        place: "section 5.1, figure 5-7, page 46",
        says: "The wedge on its coil conserves its energy while it oscillates in lift-off (toe out).",
        test: "the range of the force on the side frame while the bolster rises above 0.75 A is not more \
               than 10 % below that at the beginning of lift-off (bolster rising from 0.15 A to 0.5 A)",
        runs: [vd_out],
        holds: range(vd_out, side_frame_force, last_ringing)
            > 0.9 * range(vd_out, side_frame_force, first_ringing),
        but: "The coil's damping (1 lbf·s/in) takes the ringing away with a time constant of a quarter of a \
              second, several times within one lift-off; only the friction at the side frame dissipates \
              nothing.",
    },
    claim! {
        id: "5.1-energy-least-toe-out",
        group: Variable,
        place: "section 5.1, figure 5-8, page 46",
        says: "The least energy is dissipated with toe out.",
        test: "energy per cycle at the side frame: toe out < no toe, toe out < toe in",
        runs: [vd_out, vd_none, vd_in],
        holds: all([
            energy_per_cycle(vd_out) < energy_per_cycle(vd_none),
            energy_per_cycle(vd_out) < energy_per_cycle(vd_in),
        ]),
        but: "Toe out dissipates least going down, but toe in dissipates least going up, where its normal \
              force falls; over the cycle toe in comes out slightly below toe out.",
    },
    claim! {
        id: "5.1-energy-most-toe-in",
        group: Variable,
        place: "section 5.1, figure 5-8, page 47",
        says: "The most energy is dissipated with toe in.",
        test: "energy per cycle at the side frame: toe in > no toe, toe in > toe out",
        runs: [vd_out, vd_none, vd_in],
        holds: all([
            energy_per_cycle(vd_in) > energy_per_cycle(vd_none),
            energy_per_cycle(vd_in) > energy_per_cycle(vd_out),
        ]),
        but: "What toe in dissipates more going down it dissipates less going up, as the gap opens for it: \
              over the cycle no toe dissipates most.",
    },
    claim! {
        id: "5.1-energy-none-between",
        group: Variable,
        place: "section 5.1, figure 5-8, page 47",
        says: "The energy dissipated without toe lies between toe in and toe out.",
        test: "energy per cycle at the side frame: toe in > no toe > toe out",
        runs: [vd_out, vd_none, vd_in],
        holds: descending([energy_per_cycle(vd_in), energy_per_cycle(vd_none), energy_per_cycle(vd_out)]),
        but: "Without toe the force is nearly as high as with toe in going down, and as high as with toe \
              out going up: over the cycle no toe lies above both.",
    },
    claim! {
        id: "5.1-surface-in-contact",
        group: Variable,
        place: "section 5.1, figure 5-8, pages 46 and 47",
        says: "With toe in more of the wedge's face touches the column than with toe out.",
        test: "mean number of column corners that touch, while the bolster is below its middle: toe in > \
               toe out by more than 10 %",
        runs: [vd_in, vd_out],
        holds: mean(vd_in, corners_touching, pressed) > 1.1 * mean(vd_out, corners_touching, pressed),
        but: "A flat face between surfaces at an angle rests on an edge: two corners touch with toe in (the \
              lower ones) as with toe out (the upper ones).",
    },
    claim! {
        id: "5.1-forces-on-wedge",
        group: Variable,
        place: "section 5.1, figure 5-8, pages 46 and 47",
        says: "With toe in greater forces act on the wedge than with toe out.",
        test: "mean longitudinal force while the bolster is below its middle: toe in > no toe > toe out",
        runs: [vd_in, vd_none, vd_out],
        holds: descending([vd_in, vd_none, vd_out].map(|run| mean(run, longitudinal_force, pressed))),
        but: "Going down they are, but going up the normal force with toe in falls as the gap opens, and \
              the mean of both is lowest with toe in.",
    },
    undecidable! {
        id: "5.1-small-pitch-moment",
        group: Variable,
        place: "section 5.1, page 48",
        says: "The input is so simple that the moments are small: pitch.",
        reason: "No number says what a small moment is, and what section 6.2 calls significant is of the \
                 same size: by one and the same threshold one of the two statements must fail.",
    },
    claim! {
        id: "5.1-small-yaw-moment",
        group: Variable,
        place: "section 5.1, page 48",
        says: "The input is so simple that the moments are small: yaw and roll.",
        test: "the peak yaw and roll moments are below 1 % of the peak longitudinal force times half the \
               face's width, for each toe",
        runs: [vd_out, vd_none, vd_in],
        holds: every([vd_out, vd_none, vd_in], |run| all([
            peak(run, yaw_moment, settled) < 0.01 * yaw_limit(run),
            peak(run, roll_moment, settled) < 0.01 * yaw_limit(run),
        ])),
    },
    undecidable! {
        id: "5.1-other-inputs",
        group: Variable,
        place: "section 5.1, page 48",
        says: "With more complicated inputs (twist and roll, yaw and sway) the model gives the moments on \
               bolster and side frame.",
        reason: "None of the twelve runs has such an input.",
    },
];
