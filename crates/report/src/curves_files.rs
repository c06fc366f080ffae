//! The files of `wedgelab curves`: the vertical or roll loop of a truck, as CSV and figure.

use std::io::{self, Write};

use quantity::System as Units;
use study::truck::loop_curve::{LoopCurve, LoopKind};

use crate::csv::converted;
use crate::figures::axis;
use crate::output_table::OutputTable;
use drawing::{Figure, Panel, PlotCurve, distinct};

/// The table of loops.
pub const LOOPS: &str = "curves.csv";
/// The figure.
pub const FIGURE: &str = "curves.svg";
/// The same as a picture.
pub const PICTURE: &str = "curves.png";
/// All of them.
pub const NAMES: [&str; 3] = [LOOPS, FIGURE, PICTURE];

/// A loop with what sets it apart from the others; empty if there is one only.
pub type LabeledLoop = (String, LoopCurve);

/// Returns the names of the columns of what moves and of what resists.
fn names(kind: LoopKind) -> [&'static str; 2] {
    match kind {
        LoopKind::Vertical => ["bolster_z", "resisting_force"],
        LoopKind::Roll => ["bolster_roll", "resisting_moment"],
    }
}

/// Writes the points of all loops.
///
/// # Errors
/// The writer's.
pub fn write(loops: &[LabeledLoop], out: &mut dyn Write) -> io::Result<()> {
    let Some((_, first)) = loops.first() else {
        return Ok(());
    };
    let points = loops.iter().flat_map(|(label, own)| {
        let pairs = own.motion.iter().zip(&own.resistance);
        pairs.map(move |(motion, resistance)| (label, [*motion, *resistance]))
    });
    let mut table = OutputTable::new(points, Units::Us);
    table.text("test", |(label, _)| label);
    for (place, name) in names(first.kind).into_iter().enumerate() {
        table.number(name, first.kind.kinds()[place], move |(_, values)| values[place]);
    }
    table.write_csv(out)
}

/// Returns the figure of the loops.
#[must_use]
pub fn figure(loops: &[LabeledLoop]) -> Figure {
    let Some((_, first)) = loops.first() else {
        return Figure::default();
    };
    let [a, b] = first.kind.kinds();
    let [motion, resistance] = match first.kind {
        LoopKind::Vertical => ["bolster from nominal, up", "force on the bolster, down"],
        LoopKind::Roll => ["bolster's roll", "moment against it"],
    };
    let curves = loops.iter().enumerate().map(|(number, (label, own))| {
        let points = own.motion.iter().zip(&own.resistance);
        PlotCurve::new(
            if label.is_empty() {
                "truck".to_owned()
            } else {
                label.clone()
            },
            distinct(number),
            points.map(|(x, y)| (converted(*x, a, Units::Us), converted(*y, b, Units::Us))),
        )
    });
    Figure::new(
        "Suspension of a three-piece truck",
        "What both nests with their wedges resist over the bolster's motion, in the last whole \
                  cycle. The slope of the loop is the stiffness, its height in the middle twice what \
                  friction holds, its area the energy lost.",
        [Panel::new(
            "",
            axis(motion, a, Units::Us),
            axis(resistance, b, Units::Us),
            curves,
        )],
    )
}
