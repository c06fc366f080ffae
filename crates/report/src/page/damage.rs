//! Damage of wheels, rails and wedges on the page of a run.

use maud::{Markup, html};
use study::damage::DamageSummary;
use study::wear::mounted::WedgesWorn;

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

/// Returns the section of the wear of wedges, with its heading; nothing where none wear.
pub(super) fn of_wedges(worn: Option<&WedgesWorn>) -> Markup {
    let Some(worn) = worn else { return html! {} };
    let over = format!("{:.0} {}", worn.over.value, worn.over.unit);
    let heads = [
        Head::Words("wedge"),
        Head::Numbers("depth at the column"),
        Head::Numbers("largest over mean"),
        Head::Numbers("depth at the slope"),
        Head::Numbers("largest over mean"),
        Head::Numbers("rise by both"),
    ];
    let rows = worn.wedges.iter().map(|(name, own)| {
        [
            name.replace('_', " "),
            shown(Some(&own.column.mean_depth)),
            digits(own.column.unevenness),
            shown(Some(&own.slope.mean_depth)),
            digits(own.slope.unevenness),
            shown(Some(&own.rise)),
        ]
    });
    html! {
        section {
            h2 { "Wear of wedges" }
            p {
                "What the wedge's faces lose in the mean over " (over) " of this run again and again, and \
                 how much a wedge rises by that and by what column and pocket lose. By Archard's law with \
                 the coefficients of [damage], which are guesses, known to an order of magnitude: they say \
                 which wedge and which face wears how much faster than another one."
            }
            (table::wide(&heads, rows))
        }
    }
}
