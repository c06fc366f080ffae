//! The static table of a run's start on its page.

use std::iter;

use maud::{Markup, html};
use quantity::System as Units;
use study::statics::{COILS, StaticTable};

use super::in_unit;
use super::table::{self, Head};
use crate::figures::digits;

/// Returns the section about the start of a run.
pub(super) fn section(table: &StaticTable, units: Units) -> Markup {
    let names = COILS.map(|(name, kind)| format!("{name}, {}", kind.label(units)));
    let mut heads = vec![Head::Words("coils")];
    heads.extend(names.iter().map(|name| Head::Numbers(name)));
    let coils = table.coils().into_iter().map(|row| {
        let values = row.values.map(|value| value.map_or("–".to_owned(), digits));
        iter::once(row.name).chain(values)
    });
    let of_wheels = [Head::Words("wheel"), Head::Numbers("load")];
    let wheels = table.wheels.iter();
    let wheels = wheels.map(|(name, own)| [name.replace('_', " "), in_unit(own.value, &own.unit)]);
    html! {
        @if let Some(words) = table.words() { p { (words) } }
        (table::wide(&heads, coils))
        p {
            "Down: from free height. Left: to where the first coil of a group is solid; the load there. \
             Column: normal force of a wedge's column. Rise: of a wedge in its pocket, as a gauge shows it."
        }
        @if !table.wheels.is_empty() { (table::wide(&of_wheels, wheels)) }
    }
}
