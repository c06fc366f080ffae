//! The rise at which a limit is reached, from runs at several rises: brackets, and where to look next.
//!
//! Rises are whole sixteenths of an inch, the finest step of a gauge in an inspector's hand. A limit is
//! reached between the highest rise that is kept below the lowest one that is not. What is kept again above
//! is told, and not believed: a resonance that a rise has moved to another speed returns at that one.

/// Sixteenths of an inch.
pub type Rise = u32;

/// A sixteenth of an inch, m.
pub const SIXTEENTH: f64 = 0.0254 / 16.0;

/// A run at a rise: its margin in parts of the limit, minus infinity where a wheel left its rail.
pub type Point = (Rise, f64);

/// Between which rises a limit is reached.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bracket {
    /// The highest rise below `exceeded` at which the limit is kept.
    pub kept: Option<Rise>,
    /// The lowest rise at which it is not kept.
    pub exceeded: Option<Rise>,
    /// True if it is kept again at a higher rise.
    pub again: bool,
}

impl Bracket {
    /// Returns it of the runs at one speed, in any order.
    #[must_use]
    pub fn of(points: &[Point]) -> Self {
        let kept = |own: &&Point| own.1 >= 0.0;
        let exceeded = points.iter().filter(|own| !kept(own)).map(|own| own.0).min();
        let below = |own: &Rise| exceeded.is_none_or(|least| *own < least);
        let kept = points.iter().filter(kept).map(|own| own.0).filter(below).max();
        Self {
            kept,
            exceeded,
            again: exceeded.is_some_and(|least| points.iter().any(|own| own.0 > least && own.1 >= 0.0)),
        }
    }

    /// Returns the width of what is not known between both rises, in steps beyond one.
    #[must_use]
    pub fn is_open(&self, finest: Rise) -> bool {
        match (self.kept, self.exceeded) {
            (Some(kept), Some(exceeded)) => exceeded - kept > finest,
            (None, Some(exceeded)) => exceeded > 0,
            _ => false,
        }
    }

    /// Returns the rise, in sixteenths, at which the margin is zero if it falls straight between both rises.
    #[must_use]
    pub fn straight(&self, points: &[Point]) -> Option<f64> {
        let margin = |rise: Rise| points.iter().find(|own| own.0 == rise).map(|own| own.1);
        let (kept, exceeded) = (self.kept?, self.exceeded?);
        let (above, below) = (margin(kept)?, margin(exceeded)?);
        below
            .is_finite()
            .then(|| f64::from(kept) + f64::from(exceeded - kept) * above / (above - below))
    }
}

/// Returns the next rise to look at, so that the bracket is no wider than `finest`; a multiple of `finest`.
/// None if there is nothing more to look at.
#[must_use]
pub fn between(bracket: &Bracket, finest: Rise) -> Option<Rise> {
    if !bracket.is_open(finest) {
        return None;
    }
    let exceeded = bracket.exceeded?;
    let Some(kept) = bracket.kept else {
        return Some(0);
    };
    let steps = (exceeded - kept) / (2 * finest);
    Some(kept + steps.max(1) * finest)
}

/// Returns the next rise of a search that begins at `from` and walks by `coarse` steps, downwards over rises
/// that are not kept, upwards over kept ones, within 0 to `top`, and then halves down to `finest`.
#[must_use]
pub fn search(points: &[Point], from: Rise, [coarse, finest]: [Rise; 2], top: Rise) -> Option<Rise> {
    if points.is_empty() {
        return Some(from.min(top));
    }
    let bracket = Bracket::of(points);
    match (bracket.kept, bracket.exceeded) {
        (Some(kept), None) if kept < top => Some((kept + coarse).min(top)),
        (None, Some(exceeded)) if exceeded > 0 => Some(exceeded.saturating_sub(coarse)),
        (Some(_), Some(_)) => between(&bracket, finest),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Walks a search against a cliff at a rise; returns the bracket and the number of looks.
    fn found(cliff: f64, from: Rise, steps: [Rise; 2], top: Rise) -> (Bracket, usize) {
        let mut points: Vec<Point> = Vec::new();
        while let Some(rise) = search(&points, from, steps, top) {
            assert!(
                !points.iter().any(|own| own.0 == rise),
                "{rise} is looked at twice"
            );
            assert!(rise <= top);
            points.push((rise, cliff - f64::from(rise)));
        }
        (Bracket::of(&points), points.len())
    }

    #[test]
    fn analytic_a_search_brackets_a_cliff_wherever_it_is() {
        for top in [16, 18, 20] {
            for from in 0..=20 {
                for tenths in -5..=210 {
                    let cliff = f64::from(tenths) / 10.0 + 0.05;
                    let (bracket, looks) = found(cliff, from, [4, 2], top);
                    let high = bracket.exceeded.map_or(f64::from(top), f64::from);
                    match bracket.kept {
                        None => assert!(cliff < 0.0 && bracket.exceeded == Some(0)),
                        Some(kept) => {
                            assert!(f64::from(kept) <= cliff);
                            assert!(bracket.exceeded.is_none() || cliff < high);
                            assert!(bracket.exceeded.is_none_or(|own| own - kept <= 2), "{bracket:?}");
                        }
                    }
                    assert!(looks <= 9, "{looks}");
                }
            }
        }
    }

    #[test]
    fn analytic_brackets_and_the_straight_line_between() {
        let points = [(0, 0.5), (8, 0.1), (12, -0.3), (16, 0.2)];
        let own = Bracket::of(&points);
        assert_eq!((own.kept, own.exceeded, own.again), (Some(8), Some(12), true));
        assert!((own.straight(&points).unwrap() - 9.0).abs() < 1e-12);
        assert_eq!(between(&own, 1), Some(10));
        assert_eq!(Bracket::of(&[(0, -0.1)]).kept, None);
        assert_eq!(Bracket::of(&[(4, 0.1)]).exceeded, None);
        // Behind a derailment there is no line.
        let points = [(0, 0.5), (8, f64::NEG_INFINITY)];
        assert_eq!(Bracket::of(&points).straight(&points), None);
    }
}
