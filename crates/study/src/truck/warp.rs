//! The result of a warp test: warp moment over warp angle, its parts, its stiffness, whether the nest locks.

use super::TruckCase;
pub use super::columns::PARTS;
use super::loop_curve::{last_cycle, work};
use super::run::{TruckResult, period};
use super::summary::{self, WARP_ANGLES, warp_stiffness};

/// NUCARS's empirical warp stiffnesses of a truck (both nests), N·m/rad: worn and new. In its input files
/// they stand for the missing effects of wedging action.
pub const NUCARS_STIFFNESS: [(&str, f64); 2] = [
    ("NUCARS, worn (empirical)", 3.5 * PER_MRAD),
    ("NUCARS, new (empirical)", 17.0 * PER_MRAD),
];

/// kip·in/mrad, in N·m/rad.
const PER_MRAD: f64 = 112_984.829_027_616_7;

/// The course of the moment where warp grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Growth {
    /// It stays at a plateau: it grows by less than 15 % from 10 to 20 mrad; the moment there, N·m.
    Plateau(f64),
    /// The nest locks: it grows by more than half.
    LockUp,
    /// Between both.
    Rising,
    /// Warp does not reach 20 mrad.
    Unknown,
}

impl Growth {
    /// Returns it in a word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Plateau(_) => "plateau",
            Self::LockUp => "lock-up",
            Self::Rising => "rising",
            Self::Unknown => "not reached",
        }
    }
}

/// A warp test.
#[derive(Clone, Debug)]
pub struct WarpCurve {
    /// Warp moment over warp angle where an angle is reached first: angle (rad), secant stiffness (N·m/rad).
    pub stiffness: Vec<(f64, f64)>,
    /// The parts of the moment at these angles, N·m, in the order of [`PARTS`].
    pub parts: Vec<[f64; PARTS.len()]>,
    /// The course of the moment.
    pub growth: Growth,
    /// Energy that a loop takes, J: the area of the moment over the angle, over the last whole cycle.
    pub loop_area: Option<f64>,
    /// The rows of the last whole cycle, or of the whole run.
    pub rows: std::ops::Range<usize>,
}

impl WarpCurve {
    /// Returns the warp stiffness of a case's run. `None` if the warp angle stays below 0.5 mrad.
    #[must_use]
    pub fn of(case: &TruckCase, result: &TruckResult) -> Option<Self> {
        let period = period(&case.parameters);
        let column = |name: &str| result.column(name).unwrap_or_default();
        let (angles, moments, times) = (column("warp_angle"), column("warp_moment"), column("time"));
        let stiffness: Vec<(f64, f64)> = WARP_ANGLES
            .into_iter()
            .filter_map(|angle| Some((1e-3 * angle, warp_stiffness(angles, moments, 1e-3 * angle)?)))
            .collect();
        if stiffness.is_empty() {
            return None;
        }
        let parts = PARTS.map(|(name, ..)| column(&format!("warp_moment_{name}")));
        let parts = stiffness
            .iter()
            .map(|(angle, _)| parts.map(|part| summary::growth(angles, part, *angle).unwrap_or_default()))
            .collect();
        let moment_at = |wanted: f64| {
            let found = stiffness.iter().find(|(angle, _)| *angle == wanted);
            found.map(|(angle, stiffness)| angle * stiffness)
        };
        let growth = match (moment_at(0.010), moment_at(0.020)) {
            (Some(before), Some(after)) if after < 1.15 * before => Growth::Plateau(after),
            (Some(before), Some(after)) if after > 1.5 * before => Growth::LockUp,
            (Some(_), Some(_)) => Growth::Rising,
            _ => Growth::Unknown,
        };
        let cycle = period.and_then(|period| last_cycle(times, period));
        let rows = cycle.clone().unwrap_or(0..times.len());
        let loop_area = cycle.map(|rows| work(&moments[rows.clone()], &angles[rows]).abs());
        Some(Self {
            stiffness,
            parts,
            growth,
            loop_area,
            rows,
        })
    }
}
