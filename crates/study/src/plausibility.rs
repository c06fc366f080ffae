//! Findings of implausible values in a run, in words: the same for runs of wedges, trucks, cars, half-trucks
//! and wheelsets, studies and fits.
//!
//! The checks and their limits are those of [`mechanics::plausibility`].

use mechanics::plausibility::{FindingKind, Location, PlausibilityFinding};
use mechanics::system::{EnergyTermKind, System};
use quantity::System as Units;
use wedge::outputs::{CORNERS, FACES, PointNames};

/// The beginning of warnings about what is implausible.
const BEGINNING: &str = "implausible: ";

/// The warning about a case file that gives no values.
pub const NOTHING_GIVEN: &str = "the case file gives no values of wedge, coil, contact, friction and \
                                 motions: all are defaults, the thesis's with variable damping; write your \
                                 own (`wedgelab case` shows all keys)";

/// The advice where the slopes of massless wedges create energy.
const OF_MASSLESS_WEDGES: &str = "the law of the massless wedge gives the friction of its slope the \
                                  direction of the column's, not of its own slip, so that a bolster that \
                                  swings along feeds energy: do not use losses and damping of this run, or \
                                  compare with wedges that are bodies (--option wedges=bodies)";

/// Returns those of a run's warnings that are about something implausible.
pub fn among(warnings: &[String]) -> impl Iterator<Item = &str> {
    let own = warnings.iter().map(String::as_str);
    own.filter(|warning| warning.starts_with(BEGINNING))
}

/// Returns the warning about a fitted parameter that ends at a bound; `path` is its key, `value` the bound
/// with its unit.
#[must_use]
pub fn at_bound(path: &str, value: &str) -> String {
    format!(
        "{BEGINNING}the fitted {path} ends at its bound, {value}, so that the best value lies beyond or the \
                 data do not determine it; widen its bounds, or do not fit it"
    )
}

/// Returns a finding in a half-truck with the numbers that its files give to bodies and connections.
pub(crate) fn in_truck(
    system: &System,
    finding: &PlausibilityFinding,
    numbers: [&[u32]; 2],
    units: Units,
) -> String {
    let [bodies, connections] = numbers;
    let numbered = match finding.location {
        Location::Body(body) => bodies
            .get(body)
            .map(|number| format!("body {number} ({})", system.bodies()[body].name)),
        Location::Connection(place) => connections
            .get(place)
            .map(|number| format!("connection {number} ({})", system.connections()[place].name)),
        _ => None,
    };
    let place = numbered.unwrap_or_else(|| finding.location.describe(system));
    let sentence = finding.words(&place, units);
    let advice = match finding.location {
        Location::EnergyTerm(term) if system.energy_terms()[term].kind == EnergyTermKind::SlopeFriction => {
            OF_MASSLESS_WEDGES
        }
        _ => finding.kind.advice(),
    };
    format!("{BEGINNING}{sentence}; {advice}")
}

/// Returns a finding in a wedge with the names and keys of its case.
pub(crate) fn in_wedge(
    system: &System,
    points: &PointNames,
    finding: &PlausibilityFinding,
    units: Units,
) -> String {
    let face_name = |face: usize| FACES.get(face).copied().unwrap_or("face");
    let place = match finding.location {
        Location::Face { face, point: None } => format!("the {}", face_name(face)),
        Location::Face {
            face,
            point: Some(point),
        } => {
            let name = points
                .of(face)
                .get(point)
                .map_or("", String::as_str)
                .replace('_', " ");
            let kind = if point < CORNERS.len() { " corner" } else { "" };
            format!("the {name}{kind} of the {}", face_name(face))
        }
        Location::Coil(_) => "the control coil".to_owned(),
        other => other.describe(system),
    };
    let advice = match finding.kind {
        FindingKind::Penetration => {
            "raise contact.stiffness, or lower the coil's load or the motion that presses the wedge in"
        }
        FindingKind::StoredAtStart => "start with simulation.start = \"touching\" or \"equilibrium\"",
        FindingKind::Lifted { pulls: true } => {
            "set control_coil.pulls = false, and lower the motion that stretches the coil"
        }
        FindingKind::CoarseOutput { .. } => {
            "shorten simulation.output_interval, or use averages, not single values, extremes or spectra"
        }
        FindingKind::Separation | FindingKind::SlidOff | FindingKind::Tilt => {
            "do not use what follows; look at weight, angle, friction, coil and the motions of bolster and \
             side frame for a value out of all proportion"
        }
        kind => kind.advice(),
    };
    format!("{BEGINNING}{}; {advice}", finding.words(&place, units))
}
