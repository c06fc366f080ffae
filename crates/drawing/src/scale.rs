//! Ranges of axes and their ticks.

use std::sync::Arc;

use kuva::prelude::TickFormat;

const TICKS: f64 = 6.0;

/// The range of an axis and the distance of its ticks, which stand at round numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    pub low: f64,
    pub high: f64,
    pub step: f64,
}

impl Scale {
    /// Returns the range that holds these values with a little air.
    pub fn around(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        let (mut low, mut high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        if low == high {
            let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
            (low, high) = (low - half, high + half);
        }
        let air = 0.05 * (high - low);
        Self {
            low: low - air,
            high: high + air,
            step: round_step((high - low) / TICKS),
        }
    }

    /// Just this range, as a time window has it.
    pub fn exactly((low, high): (f64, f64)) -> Self {
        Self {
            low,
            high,
            step: round_step((high - low) / TICKS),
        }
    }

    /// Makes one row for each of `count` names, the first one on top.
    pub fn of_names(count: usize) -> Self {
        Self {
            low: -0.5,
            high: count as f64 - 0.5,
            step: 1.0,
        }
    }

    /// Returns a number with as many decimals as the step needs, with a true minus sign.
    pub fn format(&self) -> TickFormat {
        let most = self.low.abs().max(self.high.abs());
        if !(1e-3..1e6).contains(&most) {
            return TickFormat::Custom(Arc::new(scientific));
        }
        let mut decimals = 0;
        let mut step = self.step;
        while (step - step.round()).abs() > 1e-6 * step && decimals < 9 {
            step *= 10.0;
            decimals += 1;
        }
        TickFormat::Custom(Arc::new(move |value| {
            format!("{value:.decimals$}").replace('-', "\u{2212}")
        }))
    }
}

/// Returns a number with an exponent and at most six digits: a tick is a multiple of its step, and has the
/// errors of this product.
fn scientific(value: f64) -> String {
    let text = format!("{value:.5e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    match digits {
        "0" | "-0" => "0".to_owned(),
        digits => format!("{digits}e{exponent}").replace('-', "\u{2212}"),
    }
}

/// Returns the smallest of 1, 2, 2.5, 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 2.5, 5.0, 10.0]
        .into_iter()
        .map(|factor| factor * power)
        .find(|step| *step >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_ticks_are_round() {
        let scale = Scale::around([-1.0, 1.0].into_iter());
        assert_eq!((scale.low, scale.high, scale.step), (-1.1, 1.1, 0.5));
        assert_eq!(scale.format().format(-0.5), "\u{2212}0.5");
        let scale = Scale::around([-1743.0, 2310.0].into_iter());
        assert_eq!(scale.step, 1000.0);
        assert_eq!(scale.format().format(1000.0), "1000");
        for odd in [vec![], vec![0.0], vec![7.0, 7.0], vec![f64::NAN, 1.0]] {
            let scale = Scale::around(odd.into_iter());
            assert!(scale.low < scale.high && scale.step > 0.0);
        }
        let scale = Scale::around([0.0, 8e-4].into_iter());
        let ticks = [0.0, 3.0, -3.0].map(|k| scale.format().format(k * 2e-4));
        assert_eq!(ticks, ["0", "6e\u{2212}4", "\u{2212}6e\u{2212}4"]);
        assert_eq!(round_step(0.3), 0.5);
        assert_eq!(round_step(2.1), 2.5);
        assert_eq!(round_step(100.0), 100.0);
    }
}
