//! The support of the rails: rigid, or sprung under each wheel.

use quantity::{Kind, Quantity, STANDARD_GRAVITY};
use rolling::beam::RailBeam;
use rolling::track::RailSupport;

use super::irregularity::named;
use crate::case::problem::Problems;
use crate::case::section::{CaseSection, Range};

/// The support of the rails.
#[derive(Clone, Debug, PartialEq)]
pub enum Support {
    /// Rails do not give way.
    Rigid,
    /// A mass on springs and dampers under each wheel, named `rail`.
    Sprung(RailSupport),
}

impl Support {
    /// Returns the default: 80 MN/m, 140 kN·s/m, 345 kg a rail vertically, a third of the first two sideways.
    /// The values are guesses.
    #[must_use]
    pub fn usual() -> Self {
        Self::Sprung(RailSupport::default_support("rail", STANDARD_GRAVITY))
    }

    /// Returns springs, dampers and mass under each wheel; none of rigid rails.
    #[must_use]
    pub fn rail(&self) -> Option<&RailSupport> {
        match self {
            Self::Rigid => None,
            Self::Sprung(rail) => Some(rail),
        }
    }
}

/// Returns the section `[support]`.
pub(super) fn support(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Support> {
    let kind = named(section, "kind", &["sprung", "shared_beams", "rigid"], problems)?;
    if kind == "rigid" {
        section.allow_in(&["kind"], &[], "a track", problems);
        return Some(Support::Rigid);
    }
    let keys = [
        "kind",
        "mass",
        "vertical_stiffness",
        "vertical_damping",
        "lateral_stiffness",
        "lateral_damping",
    ];
    let of_beams = [
        "vertical_bending",
        "lateral_bending",
        "torsion",
        "roll_stiffness",
        "height",
        "base",
    ];
    let shared = kind == "shared_beams";
    let all: Vec<&str> = keys
        .into_iter()
        .chain(of_beams.into_iter().filter(|_| shared))
        .collect();
    section.allow_in(&all, &[], "a track", problems);
    let beam = match shared {
        true => Some(beam(section, problems)?),
        false => None,
    };
    let usual = RailSupport::default_support("rail", STANDARD_GRAVITY);
    let mut value = |key: &str, kind: Kind, range: Range, usual: f64| match section.table.get(key) {
        Some(_) => section
            .quantity(key, kind, range, problems)
            .map(|own: Quantity| own.to_si()),
        None => Some(usual),
    };
    let mass = value(
        "mass",
        Kind::Mass,
        Range::Between(1e-3, 1e6, "positive"),
        usual.mass,
    );
    let mut both =
        |[lateral, vertical]: [&str; 2], kind: Kind, low: f64, words: &'static str, usual: [f64; 2]| {
            let mut of = |key, usual| value(key, kind, Range::Between(low, 1e12, words), usual);
            let found = [of(lateral, usual[0]), of(vertical, usual[1])];
            Some([found[0]?, found[1]?])
        };
    let stiffness = both(
        ["lateral_stiffness", "vertical_stiffness"],
        Kind::Stiffness,
        1e3,
        "positive",
        usual.stiffness,
    );
    let damping = both(
        ["lateral_damping", "vertical_damping"],
        Kind::Damping,
        0.0,
        "zero or positive",
        usual.damping,
    );
    let mass = mass?;
    Some(Support::Sprung(RailSupport {
        mass,
        stiffness: stiffness?,
        damping: damping?,
        preload: mass * STANDARD_GRAVITY,
        beam,
        ..usual
    }))
}

/// Returns the rail as a beam: stiffnesses are numbers in SI units.
fn beam(section: &CaseSection<'_>, problems: &mut Problems) -> Option<RailBeam> {
    let mut own = RailBeam::rail_136re();
    let positive = Range::Between(1.0, 1e12, "positive");
    let [lateral, vertical] = &mut own.bending;
    for (key, value) in [
        ("vertical_bending", vertical),
        ("lateral_bending", lateral),
        ("torsion", &mut own.torsion),
        ("roll_stiffness", &mut own.roll_stiffness),
    ] {
        if section.table.get(key).is_some() {
            *value = section.number(key, positive, "1e6", problems)?;
        }
    }
    for (key, value, range) in [
        (
            "height",
            &mut own.height,
            Range::Between(1e-2, 1.0, "between 10 mm and 1 m"),
        ),
        (
            "base",
            &mut own.base,
            Range::Between(-0.1, 0.1, "less than 100 mm"),
        ),
    ] {
        if section.table.get(key).is_some() {
            *value = section.quantity(key, Kind::Length, range, problems)?.to_si();
        }
    }
    Some(own)
}
