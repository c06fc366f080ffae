//! Wedge rise as an input, `wedge.rise`: what an inspector's gauge shows, in place of the depths of wear of
//! both faces, which follow from it and from how they share the wear ([`Wear::of_rise`]). The same keys in
//! cases of a wedge, of a truck and of a car.

use quantity::{Kind, Quantity, SixDigits};
use wedge::parameters::Wear;

use super::field::Reach;
use super::page::WEAR;
use super::problem::Problem;
use super::section::Range;
use crate::geometry;
use crate::reader::{CaseReader, QuantityForm};

const INCH: f64 = 0.0254;
/// The keys of the depths, column and slope.
const DEPTHS: [&str; 2] = ["column_wear", "slope_wear"];
const RISE: &str = "rise";
const SHARE: &str = "rise_column_share";
const EXAMPLE: &str = "\"0.5 in\"";
const FORM: QuantityForm = (Kind::Length, Range::NotNegative, Reach::FromZero(0.0254));
const SHARES: Range = Range::UpTo(1.0, "from 0 to 1");
const OF_RISE: &str = "of the wedge by wear, as a gauge shows it, in place of both depths: (column_wear \
                       cos(angle) + slope_wear) / sin(angle) without toe";
const OF_SHARE: &str = "of the sum of both depths that rise makes, at the column: 0.5 is equal wear, a guess";
const OF_DEPTHS: [&str; 2] = [
    "what column and wedge have lost there, together: the column lies deeper by it",
    "the same at the slope; a worn wedge rises. Begin in equilibrium",
];

/// Wear of a wedge by its rise.
#[derive(Clone, Debug, PartialEq)]
pub struct RiseSection {
    /// The rise; nothing where depths are given.
    pub rise: Option<Quantity>,
    /// Share of the column in the sum of the depths.
    pub column_share: f64,
}

impl Default for RiseSection {
    fn default() -> Self {
        Self {
            rise: None,
            column_share: 0.5,
        }
    }
}

impl RiseSection {
    /// Returns the depths that the rise makes, m; `angles` are those of [`Wear::rise`]. Nothing without a
    /// rise.
    pub(crate) fn wear(&self, angles: [f64; 3]) -> Option<Wear> {
        let rise = self.rise.as_ref()?.to_si();
        Some(Wear::of_rise(rise, self.column_share, angles))
    }

    /// Reads the keys of rise and of both depths from the current section, and writes them. Depths that are
    /// given replace a rise of all wedges.
    pub(crate) fn read(&mut self, r: &mut CaseReader<'_>, wear: &mut Wear, angles: [f64; 3]) {
        let [rise, column, slope] = [RISE, DEPTHS[0], DEPTHS[1]].map(|key| r.gives(key));
        if rise {
            *wear = Wear::default();
        } else if let Some(depths) = self.wear(angles).filter(|_| column || slope) {
            (*wear, self.rise) = (depths, None);
        }
        let form = (Kind::Length, Range::NotNegative, Reach::FromZero(WEAR));
        let depths = [&mut wear.column, &mut wear.slope];
        let keys = DEPTHS.into_iter().zip(OF_DEPTHS).zip(depths);
        for (((key, comment), depth), given) in keys.zip([column, slope]) {
            // Beside a rise zero says nothing else, as in a complete case over which a rise is laid.
            let typed = (given || self.rise.is_none() && !rise)
                .then(|| r.quantity(key, form, depth, comment))
                .flatten();
            if let Some(typed) = typed.filter(|typed| rise && typed.to_si() != 0.0) {
                let path = r.path(key);
                r.problem_at(&path, both(&path, &typed));
            }
        }
        let mut own = self.rise.as_ref().map(Quantity::to_si);
        let typed = r.optional(RISE, FORM, &mut own, EXAMPLE, OF_RISE);
        self.rise = typed.or(self.rise.take());
        r.number(
            SHARE,
            SHARES,
            Reach::Between(0.0, 1.0),
            &mut self.column_share,
            OF_SHARE,
        );
    }

    /// Notes a rise beyond what the pocket holds, m.
    pub(crate) fn check_limit(&self, r: &mut CaseReader<'_>, limit: f64) {
        let Some(rise) = self.rise.as_ref().filter(|rise| rise.to_si() > limit) else {
            return;
        };
        let path = r.path(RISE);
        let problem = Problem::new(format!(
            "`{path}` is {rise}, but the pocket holds a rise of {} in (rise_limit)",
            SixDigits(limit / INCH)
        ));
        let help = "write a smaller rise, or the rise that your pocket holds as rise_limit";
        r.problem_at(&path, problem.label("out of its pocket").help(help));
    }
}

/// Notes wear by which nothing is left of a wedge of this height (m) and angle (rad).
pub(crate) fn check_thickness(r: &mut CaseReader<'_>, [height, angle]: [f64; 2], wear: &Wear) {
    if let Some(reason) = geometry::worn_away(height, angle, wear) {
        let key = [RISE, DEPTHS[0], DEPTHS[1]].into_iter().find(|key| r.gives(key));
        let path = r.path(key.unwrap_or("height"));
        let help = "look at the unit: wear is a fraction of an inch";
        r.problem_at(&path, Problem::new(reason).label("beyond the wedge").help(help));
    }
}

/// Returns the mistake of a depth beside a rise.
fn both(path: &str, depth: &Quantity) -> Problem {
    let section = path.rsplit_once('.').map_or("", |(section, _)| section);
    let problem = Problem::new(format!(
        "`{path}` is {depth}, but `{section}.{RISE}` is given too, which makes the depths"
    ));
    problem.label("one of two").help(format!(
        "leave out {RISE}, or both depths: {SHARE} says how they share it"
    ))
}
