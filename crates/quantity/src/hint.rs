//! Hints at the unit in which a number of metres may have been meant.

use crate::Number;
use crate::units::INCH;

/// Returns the hint at a length (m) outside of a range (m) that would lie inside it if it were in inches or
/// in millimetres; none if it would not.
#[must_use]
pub fn length_hint(value: f64, [low, high]: [f64; 2]) -> Option<String> {
    let inside = |factor: f64| (low..=high).contains(&(value * factor));
    if !value.is_finite() || value == 0.0 || inside(1.0) {
        return None;
    }
    let meant: Vec<String> = [("inches", "in", INCH), ("millimeters", "mm", 1e-3)]
        .into_iter()
        .filter(|(.., factor)| inside(*factor))
        .map(|(words, unit, _)| format!("{words} (\"{} {unit}\")", Number(value)))
        .collect();
    (!meant.is_empty()).then(|| {
        format!(
            "did you give {}? A number without unit is in m",
            meant.join(" or ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_lengths_in_another_unit_are_hinted_at() {
        let gauge = [0.1, 10.0];
        let hint = length_hint(56.5, gauge).unwrap();
        assert!(hint.starts_with("did you give inches (\"56.5 in\")?"), "{hint}");
        let hint = length_hint(1435.0, gauge).unwrap();
        assert!(hint.contains("millimeters (\"1435 mm\")"), "{hint}");
        assert!(
            length_hint(200.0, gauge)
                .unwrap()
                .contains("inches (\"200 in\") or millimeters")
        );
        for value in [1.435, 0.0, f64::NAN, 1e9] {
            assert_eq!(length_hint(value, gauge), None);
        }
    }
}
