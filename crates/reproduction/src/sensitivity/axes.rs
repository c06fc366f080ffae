//! The axes of the thesis's figures: its curves stay within them.
//!
//! Limits of axes stand in the scripts of appendix D, for toe out only; those of the friction power are
//! commented out there, and appendix E has none. For constant damping the text of figure 6-6 gives toe in and
//! no toe the same limit: toe out has the largest longitudinal force. The figures begin at 0.1 to 0.5 s;
//! looked at is what comes after 0.5 s.

use quantity::{Kind, System as Units};
use study::case::Case;
use study::result::RunResult;

use crate::claims::{RunId, SlopeShape, Toe};

/// The time before which nothing is shown, s.
const FROM: f64 = 0.5;

/// An axis.
#[derive(Clone, Copy, Debug)]
pub struct FigureAxis {
    /// The description.
    pub name: &'static str,
    /// The column that is drawn.
    column: &'static str,
    kind: Kind,
    /// Its ends, lbf.
    ends: [f64; 2],
    /// The condition for drawing a run.
    draws: fn(RunId) -> bool,
}

/// The axes that could be passed.
pub const AXES: [FigureAxis; 3] = [
    FigureAxis {
        name: "vertical wedge force within -2100 to 2600 lbf (constant damping, toe out)",
        column: "vertical_wedge_force",
        kind: Kind::Force,
        ends: [-2100.0, 2600.0],
        draws: |run| run.constant && run.toe == Toe::Out,
    },
    FigureAxis {
        name: "longitudinal wedge force within 0 to 8000 lbf (constant damping; with toe in and without by \
               the text of figure 6-6: toe out has the largest)",
        column: "longitudinal_wedge_force",
        kind: Kind::Force,
        ends: [0.0, 8000.0],
        draws: |run| run.constant,
    },
    FigureAxis {
        name: "longitudinal wedge force within 0 to 6000 lbf (variable damping, toe out, yawed)",
        column: "longitudinal_wedge_force",
        kind: Kind::Force,
        ends: [0.0, 6000.0],
        draws: |run| !run.constant && run.yawed && run.toe == Toe::Out,
    },
];

impl FigureAxis {
    /// Returns whether the runs that it draws stay within it; `false` if one of them is missing or not
    /// complete.
    fn holds(&self, runs: &[(Case, RunResult)]) -> bool {
        let toes = [Toe::Out, Toe::None, Toe::In].into_iter();
        let all = toes.flat_map(|toe| {
            let kinds = [(false, false), (false, true), (true, false), (true, true)];
            kinds.map(|(constant, yawed)| RunId {
                constant,
                toe,
                yawed,
                slope: SlopeShape::Flat,
            })
        });
        all.filter(|id| (self.draws)(*id)).all(|id| {
            let run = runs.iter().find(|(case, _)| RunId::of(case) == id);
            run.is_some_and(|(_, result)| self.is_within(result))
        })
    }

    fn is_within(&self, result: &RunResult) -> bool {
        let unit = self.kind.from_si(Units::Us);
        let (Some(times), Some(values)) = (result.column("time"), result.column(self.column)) else {
            return false;
        };
        let [low, high] = self.ends;
        let mut shown = times.iter().zip(values).filter(|(time, _)| **time > FROM);
        result.summary.complete && shown.all(|(_, value)| (low..=high).contains(&(value * unit)))
    }
}

/// Returns whether these runs stay within each of the axes.
pub(super) fn within(runs: &[(Case, RunResult)]) -> Vec<bool> {
    AXES.iter().map(|axis| axis.holds(runs)).collect()
}
