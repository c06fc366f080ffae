//! The static table of a run's start on its page.

use maud::{Markup, html};
use quantity::System as Units;
use study::statics::{COILS, StaticTable};

use crate::figures::digits;

/// Returns the section about the start of a run.
pub(super) fn section(table: &StaticTable, units: Units) -> Markup {
    html! {
        @if let Some(words) = table.words() { p { (words) } }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "coils" }
                        @for (name, kind) in COILS {
                            th.number scope="col" { (name) ", " (kind.label(units)) }
                        }
                    }
                }
                tbody {
                    @for row in table.coils() {
                        tr {
                            th scope="row" { (row.name) }
                            @for value in row.values { td.number { (value.map_or("–".to_owned(), digits)) } }
                        }
                    }
                }
            }
        }
        p {
            "Down: from free height. Left: to where the first coil of a group is solid; the load there. \
             Column: normal force of a wedge's column. Rise: of a wedge in its pocket, as a gauge shows it."
        }
        @if !table.wheels.is_empty() {
            div.wide {
                table {
                    thead { tr { th scope="col" { "wheel" } th.number scope="col" { "load" } } }
                    tbody {
                        @for (name, own) in &table.wheels {
                            tr {
                                th scope="row" { (name.replace('_', " ")) }
                                td.number { (digits(own.value)) " " (own.unit) }
                            }
                        }
                    }
                }
            }
        }
    }
}
