//! Damage of wheels and rails on the page of a car's run.

use maud::{Markup, html};
use study::damage::DamageSummary;

use super::by_rules::shown;
use super::table::{self, Head};
use crate::figures::digits;

/// Returns the section.
pub(super) fn section(damage: &DamageSummary) -> Markup {
    let heads = |what: &'static str, worn: &'static str| {
        [
            Head::Words(what),
            Head::Numbers("mean wear number"),
            Head::Numbers(worn),
            Head::Numbers("largest depth"),
            Head::Numbers("at"),
            Head::Numbers("fatigue"),
        ]
    };
    let wheels = damage.wheels.iter().map(|(name, own)| {
        [
            name.replace('_', " "),
            shown(Some(&own.wear_number)),
            shown(Some(&own.worn_mass)),
            shown(Some(&own.largest_depth)),
            shown(Some(&own.place)),
            digits(own.fatigue),
        ]
    });
    let rails = damage.rails.iter().map(|(name, own)| {
        [
            format!("{name} rail"),
            shown(Some(&own.wear_number)),
            shown(Some(&own.worn_over_an_inch)),
            shown(Some(&own.largest_depth)),
            shown(Some(&own.place)),
            digits(own.fatigue),
        ]
    });
    html! {
        p {
            "What creep takes by the distance, all wheels: " (shown(Some(&damage.creep_resistance)))
            ". Wheels over 100,000 miles and rails over 1,000,000 gross tons of this run again and again, \
             their profiles as they are: a depth of more than a few millimeters says how fast it goes, for \
             the profile would change long before. Fatigue: 1e-5 of the life to a visible crack, where it is \
             largest. Dry coefficients from memory: they rank cars and tracks; a life they do not give."
        }
        (table::wide(&heads("wheel", "worn steel"), wheels))
        (table::wide(&heads("rail", "worn area over an inch"), rails))
    }
}
