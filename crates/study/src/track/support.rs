//! What the rails lie on: rigid, or sprung under each wheelset.

use quantity::{Kind, Quantity};

use super::irregularity::named;
use crate::case::problem::Problems;
use crate::case::section::{Range, Section};

/// A mass on a spring and a damper under each rail of a wheelset, in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
    /// Mass, kg.
    pub mass: f64,
}

/// What the rails lie on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Support {
    /// Rails do not give way.
    Rigid,
    /// Springs under each rail.
    Sprung {
        /// Up and down.
        vertical: Spring,
        /// To the left and to the right.
        lateral: Spring,
    },
}

impl Support {
    /// The default: 80 MN/m, 140 kN·s/m, 345 kg a rail vertically, a third of it laterally. The values are
    /// guesses.
    pub const USUAL: Self = {
        const VERTICAL: Spring = Spring {
            stiffness: 80e6,
            damping: 140e3,
            mass: 345.0,
        };
        Self::Sprung {
            vertical: VERTICAL,
            lateral: Spring {
                stiffness: VERTICAL.stiffness / 3.0,
                damping: VERTICAL.damping / 3.0,
                mass: VERTICAL.mass / 3.0,
            },
        }
    };
}

/// The section `[support]`.
pub(super) fn support(section: &Section<'_>, problems: &mut Problems) -> Option<Support> {
    let kind = named(section, "kind", &["sprung", "rigid"], problems)?;
    if kind == "rigid" {
        section.allow_in(&["kind"], &[], "a track", problems);
        return Some(Support::Rigid);
    }
    let keys = [
        "kind",
        "vertical_stiffness",
        "vertical_damping",
        "vertical_mass",
        "lateral_stiffness",
        "lateral_damping",
        "lateral_mass",
    ];
    section.allow_in(&keys, &[], "a track", problems);
    let Support::Sprung { vertical, lateral } = Support::USUAL else {
        return None;
    };
    let mut spring = |usual: Spring, [stiffness, damping, mass]: [&str; 3]| {
        let mut value = |key: &str, kind: Kind, range: Range, usual: f64| match section.table.get(key) {
            Some(_) => section
                .quantity(key, kind, range, problems)
                .map(|own: Quantity| own.to_si()),
            None => Some(usual),
        };
        let own = [
            value(
                stiffness,
                Kind::Stiffness,
                Range::Between(1e3, 1e12, "positive"),
                usual.stiffness,
            ),
            value(
                damping,
                Kind::Damping,
                Range::Between(0.0, 1e9, "zero or positive"),
                usual.damping,
            ),
            value(
                mass,
                Kind::Mass,
                Range::Between(1e-3, 1e6, "positive"),
                usual.mass,
            ),
        ];
        Some(Spring {
            stiffness: own[0]?,
            damping: own[1]?,
            mass: own[2]?,
        })
    };
    let vertical = spring(
        vertical,
        ["vertical_stiffness", "vertical_damping", "vertical_mass"],
    );
    let lateral = spring(lateral, ["lateral_stiffness", "lateral_damping", "lateral_mass"]);
    Some(Support::Sprung {
        vertical: vertical?,
        lateral: lateral?,
    })
}
