//! Exact factors from the files' units to SI.

/// Metres in an inch.
pub(crate) const INCH: f64 = 0.0254;
/// Metres in a foot.
pub(crate) const FOOT: f64 = 12.0 * INCH;
/// Newtons in a pound-force.
pub(crate) const POUND: f64 = 4.448_221_615_260_5;
/// Kilograms in a lb s²/in.
pub(crate) const MASS: f64 = POUND / INCH;
/// Kilogram square metres in an in lb s².
pub(crate) const INERTIA: f64 = POUND * INCH;
/// Newton metres in an in-lb.
pub(crate) const MOMENT: f64 = POUND * INCH;
/// Radians in a degree.
pub(crate) const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Factors of stroke and force in a coordinate (0 to 5): in and lb of translations, rad and in-lb of
/// rotations.
pub(crate) fn factors(coordinate: usize) -> (f64, f64) {
    if coordinate < 3 {
        (INCH, POUND)
    } else {
        (1.0, MOMENT)
    }
}
