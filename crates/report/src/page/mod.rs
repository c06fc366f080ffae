//! `index.html`: the report as one page that needs nothing else to be shown.

pub mod assessment;
mod by_rules;
pub mod car_run;
mod contents;
mod damage;
pub mod explorer;
pub mod half_truck_run;
pub mod packed;
mod paths;
pub mod rise;
pub mod side_by_side;
pub mod stability;
mod statics;
pub mod study;
mod table;
pub mod truck_run;
pub mod vehicle_run;
mod viewer;
pub mod wedge_run;
pub mod wheelset;

use std::borrow::Cow;

use ::study::summary::RunSummary;
use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

use crate::figures::{Exhibit, capital, digits};
use crate::view::View;
use crate::view::data::Precision;
use crate::view::kept::DATA;
use crate::view::run::Recording;
use drawing::Figure;

/// The page's file name.
pub const FILE_NAME: &str = "index.html";

const STYLE: &str = concat!(include_str!("colours.css"), include_str!("style.css"));
/// The script of pages without the viewer.
const SCRIPT: &str = include_str!("page.js");
/// The script that unpacks data and viewer, and starts the viewer.
const UNPACK: &str = include_str!("unpack.js");

/// Returns a figure; `folder` is where its files are, if it has any.
#[must_use]
pub fn shown_in(exhibit: &Exhibit, svg: &str, folder: Option<&str>) -> Markup {
    let name = exhibit.name.as_str();
    html! {
        figure id=(anchor(name)) data-figure=(name) {
            (PreEscaped(inline(&Figure::named(svg, &anchor(name)), &exhibit.figure.title)))
            figcaption {
                @if !exhibit.thesis.is_empty() { strong { "Thesis, " (exhibit.thesis) ". " } }
                (exhibit.figure.caption)
                @if let Some(folder) = folder {
                    " "
                    a href={ (folder) "/" (name) ".svg" } { "SVG" } ", "
                    a href={ (folder) "/" (name) ".png" } { "PNG" }
                }
            }
        }
    }
}

/// The text on a run that has failed, after its name.
pub const FAILED: &str = " has failed: do not use its numbers";

/// Returns the list of what a run lacks to be complete and of what makes its numbers doubtful.
#[must_use]
pub fn doubts(summary: &impl RunSummary) -> Markup {
    doubts_about(summary.name(), summary)
}

/// Returns the same of a run that is called `name`.
fn doubts_about(name: &str, summary: &dyn RunSummary) -> Markup {
    let outcome = summary.outcome();
    html! {
        @if let (Some(_), Some(told), Some(numbers)) = (outcome.end(), outcome.told(), outcome.numbers()) {
            p.warning { (name) " " (told) ". " (numbers) }
        }
        @for warning in summary.warnings() { p.warning { (name) ": " (warning) } }
        @if summary.failed().is_some() { p.warning { (name) (FAILED) } }
    }
}

/// Returns the page of one run, headed by its title or its name: what makes its numbers doubtful, the run
/// moving, these sections, its assumptions. `what` is run.
///
/// # Errors
/// Errors of the JSON writer.
fn run_page(
    summary: &impl RunSummary,
    title: &str,
    what: &str,
    (recording, exhibits): (Recording, &[Exhibit]),
    sections: &Markup,
) -> Result<String, serde_json::Error> {
    let data = View::with(summary.units(), [recording], exhibits, Precision::Rounded).to_json()?;
    let (name, program) = (summary.name(), summary.program());
    let heading = capital(if title.is_empty() { name } else { title });
    let lead = format!("The run {name} of {what}. Computed by {program}.");
    let main = html! {
        (doubts(summary))
        (moving(name))
        (sections)
        section { h2 { "Assumptions" } (list(summary.assumptions())) }
    };
    Ok(document(&heading, &lead, None, &main, Some(&data)))
}

/// Returns texts as a list.
fn list(texts: &[String]) -> Markup {
    html! { ul { @for text in texts { li { (text) } } } }
}

/// Returns a number in a unit, if it has one.
pub(crate) fn in_unit(value: f64, unit: &str) -> String {
    match unit {
        "" => digits(value),
        unit => format!("{} {unit}", digits(value)),
    }
}

/// Returns the section with these figures.
fn figures(exhibits: &[Exhibit]) -> Markup {
    html! {
        section {
            h2 { "Figures" }
            @for exhibit in exhibits { (shown_in(exhibit, &exhibit.figure.to_svg(), None)) }
        }
    }
}

/// A sentence on the energy ledger of a run: its relative residual, and the steps of the integrator.
fn ledger_note(summary: &impl RunSummary) -> Markup {
    let (residual, (steps, _)) = (summary.largest_relative_residual(), summary.solver());
    html! {
        p {
            "Energy ledger: its largest residual at any output time is " (format!("{residual:.1e}"))
            " of the largest of work, losses and change of stored energy. " (steps) " steps."
        }
    }
}

/// Returns the part of the page of one run in which it is seen moving.
fn moving(name: &str) -> Markup {
    html! {
        section { h2 id="moving" { "Moving" } (moving_as(name, name, true)) }
    }
}

/// Returns the fold in which a run is seen moving, open or not.
fn moving_as(name: &str, title: &str, open: bool) -> Markup {
    html! {
        details id={ "run-" (anchor(name)) } data-run=(name) open[open] { summary { (title) } }
    }
}

/// Returns a page with its heading, what stands below it, a list of links to its parts (none: to its
/// headings), and the data of its interactive part if it has one.
#[must_use]
pub fn document(
    heading: &str,
    lead: &impl Render,
    nav: Option<&Markup>,
    main: &Markup,
    view: Option<&str>,
) -> String {
    let (main, found) = match nav {
        Some(_) => (Cow::Borrowed(main.0.as_str()), None),
        None => {
            let (main, found) = contents::of(&main.0);
            (Cow::Owned(main), found)
        }
    };
    let nav = nav.or(found.as_ref());
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (heading) }
                style { (PreEscaped(STYLE)) }
                @if view.is_some() { style { (PreEscaped(viewer::STYLE)) } }
            }
            body.sided[nav.is_some()] {
                a.skip href="#main" { "Skip to the content" }
                header { h1 { (heading) } p.lead { (lead) } }
                @if let Some(nav) = nav {
                    nav aria-label="Contents" { details open { summary { "Contents" } (nav) } }
                }
                main id="main" { (PreEscaped(main)) }
                script { (PreEscaped(SCRIPT)) }
                @if let Some(data) = view {
                    script type="text/plain" id=(DATA) { (PreEscaped(packed::pack(data))) }
                    script type="text/plain" id="wedgelab-viewer" { (PreEscaped(viewer::packed())) }
                    script { (PreEscaped(UNPACK)) }
                }
            }
        }
    };
    page.into_string()
}

/// Returns a name as the target of links: letters, digits and `-`, all else is `_`.
#[must_use]
pub fn anchor(name: &str) -> String {
    let plain = |sign: char| sign.is_ascii_alphanumeric() || sign == '-';
    let signs = name.chars();
    signs.map(|sign| if plain(sign) { sign } else { '_' }).collect()
}

/// Returns a drawing as part of the page: a picture with a name, scaled to the page's width. Its description
/// stands in the caption, so that it is not said twice.
fn inline(svg: &str, title: &str) -> String {
    let attribute = |name: &str| {
        let start = svg.find(&format!(" {name}=\""))? + name.len() + 3;
        let end = start + svg[start..].find('"')?;
        svg.get(start..end)
    };
    let (width, height) = (
        attribute("width").unwrap_or("960"),
        attribute("height").unwrap_or("400"),
    );
    let label = html! { (title) }.into_string();
    let own = format!(
        "<svg role=\"img\" aria-label=\"{}\" viewBox=\"0 0 {width} {height}\"",
        label.replace('"', "&quot;")
    );
    let svg = svg.replacen("<svg xmlns=\"http://www.w3.org/2000/svg\"", &own, 1);
    let svg = without(&svg, "<title>", "</title>\n");
    let svg = without(&svg, "<desc>", "</desc>\n");
    paths::shortened(&without(&svg, "<!--", "-->\n"))
}

/// Returns the text without the first piece from `start` to `end`.
fn without(text: &str, start: &str, end: &str) -> String {
    let Some(from) = text.find(start) else {
        return text.to_owned();
    };
    match text[from..].find(end) {
        Some(length) => format!("{}{}", &text[..from], &text[from + length + end.len()..]),
        None => text.to_owned(),
    }
}
