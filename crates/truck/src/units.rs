//! Inch-pound units in SI, for the default values.

/// in, in m.
pub const INCH: f64 = 0.0254;
/// lbf, in N.
pub const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Mass that weighs one lbf, in kg.
pub const POUND: f64 = 0.453_592_37;
/// lbf/in, in N/m; lbf·s/in, in N·s/m.
pub const POUND_PER_INCH: f64 = POUND_FORCE / INCH;
/// lbf·in·s², in kg·m².
pub const POUND_INCH: f64 = POUND_FORCE * INCH;

/// Returns lengths in inches in m.
pub fn inches<const N: usize>(lengths: [f64; N]) -> [f64; N] {
    lengths.map(|length| length * INCH)
}
