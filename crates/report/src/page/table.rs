//! Tables of pages.

use maud::{Markup, Render, html};

/// The head of a column.
pub(super) enum Head<'h> {
    /// Words.
    Words(&'h str),
    /// Numbers.
    Numbers(&'h str),
    /// Numbers in a unit, which stands below.
    InUnit(&'h str, &'h str),
}

impl Head<'_> {
    fn is_of_numbers(&self) -> bool {
        !matches!(self, Self::Words(_))
    }
}

impl Render for Head<'_> {
    fn render(&self) -> Markup {
        match self {
            Self::Words(name) => html! { th scope="col" { (name) } },
            Self::Numbers(name) => html! { th.number scope="col" { (name) } },
            Self::InUnit(name, unit) => html! {
                th.number scope="col" { (name) br; span.unit { (unit) } }
            },
        }
    }
}

/// Returns a table that scrolls where it is wider than the page; the first cell of a row names it.
pub(super) fn wide<R, C>(heads: &[Head<'_>], rows: R) -> Markup
where
    R: IntoIterator,
    R::Item: IntoIterator<Item = C>,
    C: Render,
{
    html! { div.wide { (narrow(heads, rows)) } }
}

/// Returns the same of few columns.
pub(super) fn narrow<R, C>(heads: &[Head<'_>], rows: R) -> Markup
where
    R: IntoIterator,
    R::Item: IntoIterator<Item = C>,
    C: Render,
{
    html! {
        table {
            thead { tr { @for head in heads { (head) } } }
            tbody {
                @for row in rows {
                    tr {
                        @for (place, (cell, head)) in row.into_iter().zip(heads).enumerate() {
                            @if place == 0 && head.is_of_numbers() { th.number scope="row" { (cell) } }
                            @else if place == 0 { th scope="row" { (cell) } }
                            @else if head.is_of_numbers() { td.number { (cell) } }
                            @else { td { (cell) } }
                        }
                    }
                }
            }
        }
    }
}
