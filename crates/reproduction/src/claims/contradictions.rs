//! Where the thesis contradicts itself, and what the cases take.

/// Two places of the thesis that do not go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// Where they stand.
    pub places: &'static str,
    /// What they say.
    pub says: &'static str,
    /// What is taken here, or what follows.
    pub here: &'static str,
}

const fn contradiction(places: &'static str, says: &'static str, here: &'static str) -> Contradiction {
    Contradiction { places, says, here }
}

/// All that is known, in the order of the thesis.
pub const CONTRADICTIONS: [Contradiction; 12] = [
    contradiction(
        "section 1.2, figure 2-1; SYS files of appendix A",
        "The car is of 100 tons; the figure says 50.",
        "The springs and loads are those of the files: 100 tons.",
    ),
    contradiction(
        "table 3-2",
        "The constantly damped wedge has 37.5\u{b0} and 6.125 in, and the bottom's length of the other, \
         3.827 in.",
        "The bottom follows from angle and height: 4.700 in.",
    ),
    contradiction(
        "tables 3-3 and 3-4",
        "A force of 12,500 lbf is \u{201c}used to calculate the static position\u{201d}.",
        "It fits the zero of neither model, and is not used; the start is a choice.",
    ),
    contradiction(
        "eq. 5-1; table 4-1 and the names of the runs",
        "Toe out is positive; toe out is -0.2\u{b0}.",
        "Cases say the direction in words.",
    ),
    contradiction(
        "eqs. 5-1 and 5-3",
        "F_z is the force on the side frame; F_z is the column's friction alone.",
        "Chapter 5 is read as the first, chapter 6 as the second, as their figures draw them.",
    ),
    contradiction(
        "sections 5.1 and 5.2; section 6.2",
        "Moments are \u{201c}small\u{201d}; moments are \u{201c}significant\u{201d}: no number tells one \
         from the other.",
        "Undecidable.",
    ),
    contradiction(
        "figures 5-7, 5-15, 6-7; scripts D.1",
        "What the scripts draw as the comparison program's rate of dissipation is its whole vertical force, \
         coil and friction, times the size of the speed: 9,060 lbf\u{b7}in in the 10 s of our run of \
         type 6.9 (variable damping, toe out).",
        "Its friction loses 5,740 lbf\u{b7}in in that time. The figures' quantity is no loss: the coil gives \
         back what it takes. Statements are decided from the friction.",
    ),
    contradiction(
        "figure 6-11; script D.2.2",
        "The figure is called that of the yawed run; the script loads cdrun_toe_-0.2_psi_0 before it draws, \
         and draws the unyawed force, sign reversed, over the yawed displacement.",
        "Its four statements are decided from the yawed run, as the text says.",
    ),
    contradiction(
        "sections 6.1 and 6.2; script E.2",
        "Toe in lets the wedge travel most going up and least going down; what goes up in a cycle comes \
         down.",
        "The script draws the displacement from the nominal position, and toe shifts the loop: orders of \
         travel are read as orders of its ends. They hold with toe about the coil's seat, and not about the \
         face's middle.",
    ),
    contradiction(
        "section 7.1; eqs. 3-8, 3-10 and 3-15",
        "Lateral forces are zero for the inputs looked at, yaw among them; her equations have one tangent a \
         face.",
        "Friction against the slip has a lateral part with yaw; with friction.directions = \"one\" there is \
         next to none.",
    ),
    contradiction(
        "appendix A.1.4",
        "The second run file has the name of the first.",
        "Runs are known by what they set.",
    ),
    contradiction(
        "appendix A; table 4-1",
        "The comment of an input file says 0.0031645 rad of yaw; the table says 0.012.",
        "The number of the table and of the file's rows: 0.012 rad.",
    ),
];
