//! The summary page of a study.

use std::path::Path;

use maud::{Markup, PreEscaped, html};
use study::design::{Accuracy, Levels, Sampling, Study};

use super::{anchor, document, inline};
use crate::figures::study::exhibits;
use crate::figures::{Exhibit, digits};
use crate::overlay::words;
use crate::study_digest::Digest;
use crate::study_folder::{TABLE_FILE, factor_column, table};
use drawing::Figure;
use staging::{FileError, Folder};

/// The page's file name.
pub const FILE_NAME: &str = "index.html";

/// Writes the page into a study's folder, whole or not at all.
///
/// # Errors
/// It cannot be written.
pub fn write(study: &Study, digest: &Digest, folder: &Path) -> Result<(), FileError> {
    let page = render(study, digest);
    Folder::check(folder, &[FILE_NAME], true)?
        .write(|files| files.add(FILE_NAME, |out| out.write_all(page.as_bytes())))
}

/// Returns the page as HTML; it needs nothing else to be shown.
#[must_use]
pub fn render(study: &Study, digest: &Digest) -> String {
    let heading = if study.title.is_empty() {
        &study.name
    } else {
        &study.title
    };
    let exhibits = exhibits(study, digest);
    let main = html! {
        (factors(study))
        (failures(digest))
        (ranges(study, digest))
        @if exhibits.is_empty() { p { "No figure can be drawn: no run has \
                                       measures." } } @else { (contents(&exhibits)) }
        @for exhibit in &exhibits {
            @let id = anchor(&exhibit.name);
            figure id=(id) {
                (PreEscaped(inline(&Figure::named(&exhibit.figure.to_svg(), &id), &exhibit.figure.title)))
                figcaption { (exhibit.figure.caption) }
            }
        }
        (files(study))
    };
    document(
        &format!("Study: {heading}"),
        &lead(study, digest),
        None,
        &main,
        None,
    )
}

/// Links to the figures.
fn contents(exhibits: &[Exhibit]) -> Markup {
    html! {
        h2 { "Figures" }
        ul {
            @for exhibit in exhibits {
                li { a href={ "#" (anchor(&exhibit.name)) } { (exhibit.figure.title) } }
            }
        }
    }
}

fn lead(study: &Study, digest: &Digest) -> String {
    let how = match &study.sampling {
        Sampling::FullFactorial => "every value of each parameter with every other".to_owned(),
        Sampling::LatinHypercube { seed, .. } => format!("a Latin hypercube (seed {seed})"),
        Sampling::Sobol { seed: None, .. } => "points of the Sobol' sequence".to_owned(),
        Sampling::Sobol { seed: Some(seed), .. } => {
            format!("points of the Sobol' sequence, shifted by seed {seed}")
        }
        Sampling::List => "a list".to_owned(),
    };
    let accuracy = match study.accuracy {
        Accuracy::Case => "the case's accuracy",
        Accuracy::Engineering => {
            "engineering accuracy (tr-bdf2, which damps the vibrations of contacts: wedges that rattle for \
             long may have forces some 10 % off)"
        }
    };
    let [complete, refused, stopped, failed, derailed] = digest.ended;
    let derailed = match derailed {
        0 => String::new(),
        count => format!(", {count} derailed"),
    };
    format!(
        "{} runs of the case {}: {how}, at {accuracy}. {complete} are complete, {refused} were refused, \
         {stopped} stopped on their way, {failed} failed{derailed}.",
        study.count(),
        study.base.name()
    )
}

fn factors(study: &Study) -> Markup {
    html! {
        h2 { "What is varied" }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "parameter" }
                        th scope="col" { "values" }
                        th scope="col" { "column" }
                    }
                }
                tbody {
                    @for factor in &study.factors {
                        tr {
                            th scope="row" { (factor.paths.join(", ")) }
                            td { (values(&factor.levels)) }
                            td { code { (factor_column(factor)) } }
                        }
                    }
                }
            }
        }
        @if !study.set.is_empty() {
            p { "The same for all runs: " @for (number, set) in study.set.iter().enumerate() {
                @if number > 0 { ", " } code { (set) }
            } "." }
        }
    }
}

fn values(levels: &Levels) -> String {
    const MOST: usize = 12;
    match levels {
        Levels::Values(values) => {
            let mut texts: Vec<String> = values
                .iter()
                .take(MOST)
                .map(|value| value.shown().into_owned())
                .collect();
            if values.len() > MOST {
                texts.push(format!("and {} more", values.len() - MOST));
            }
            texts.join(", ")
        }
        Levels::Range {
            from,
            to,
            unit,
            logarithmic,
            count,
        } => {
            let scale = if *logarithmic { ", logarithmic" } else { "" };
            let count = if *count > 0 {
                format!(", {count} values")
            } else {
                String::new()
            };
            format!("{from} to {to} {unit}{count}{scale}")
        }
    }
}

fn failures(digest: &Digest) -> Markup {
    let failed: u64 = digest.ended[1..].iter().sum();
    html! {
        @if failed > 0 {
            div.warning {
                p {
                    (failed) " runs are left out of all figures: they have no measures, or derailed on \
                              their way (figures of `derailed` alone count those), or have failed: their \
                              energy ledger does not close, or their bodies left the range in which the \
                              model means something. The first ones:"
                }
                ul { @for (number, reason) in &digest.reasons { li { "run " (number) ": " (reason) } } }
            }
        }
        @if let Some(warning) = digest.warning() { p.warning { (warning) } }
    }
}

fn ranges(study: &Study, digest: &Digest) -> Markup {
    let units = study.units();
    html! {
        h2 { "What came out" }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "measure" }
                        th scope="col" { "unit" }
                        th.number scope="col" { "least" }
                        th.number scope="col" { "mean" }
                        th.number scope="col" { "greatest" }
                        th.number scope="col" { "runs that have it" }
                    }
                }
                tbody {
                    @for (measure, found) in study.measures().iter().zip(&digest.all) {
                        @let factor = measure.kind.from_si(units);
                        tr {
                            th scope="row" { (words(&measure.name)) }
                            td.unit { (measure.kind.label(units)) }
                            @if found.count > 0 {
                                td.number { (digits(found.least * factor)) }
                                td.number { (digits(found.mean() * factor)) }
                                td.number { (digits(found.most * factor)) }
                            } @else {
                                td.number { "–" } td.number { "–" } td.number { "–" }
                            }
                            td.number { (found.count) }
                        }
                    }
                }
            }
        }
    }
}

fn files(study: &Study) -> Markup {
    html! {
        h2 { "The table" }
        p {
            a href=(TABLE_FILE) { (TABLE_FILE) } " has a row for each run and these columns; their units \
                stand in its metadata under "
            code { (crate::parquet::COLUMNS_KEY) } "."
        }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "column" }
                        th scope="col" { "unit" }
                        th scope="col" { "what it is" }
                    }
                }
                tbody {
                    @for column in table(study).descriptions() {
                        tr {
                            th scope="row" { code { (column.name) } }
                            td.unit { (column.unit) }
                            td { (column.text) }
                        }
                    }
                }
            }
        }
    }
}
