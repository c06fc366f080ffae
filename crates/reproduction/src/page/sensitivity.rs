//! The thesis's statements over what the thesis leaves open.

use maud::{Markup, html};
use report::figures::capital;

use crate::claims::{ClaimGroup, REQUIRED};
use crate::sensitivity::{AXES, Extent, Mean, PairShown, Sensitivity, Side, Split, Statement, Tally};

/// Returns a share in per cent; what is not all is never shown as all.
fn percent(share: f64) -> String {
    let rounded = (100.0 * share).round();
    let least = if share > 0.0 { 1.0 } else { 0.0 };
    let most = if share < 1.0 { 99.0 } else { 100.0 };
    format!("{} %", rounded.clamp(least, most))
}

/// Returns the extent in which a statement holds, in a few words.
pub(super) fn extent(statement: &Statement) -> Markup {
    words(statement.extent, statement.tally, statement.decides.as_ref())
}

fn words(extent: Extent, tally: Tally, split: Option<&Split>) -> Markup {
    let is_between = matches!(extent, Extent::Mostly | Extent::Seldom);
    html! {
        @if extent != Extent::CannotBeDecided {
            strong { (capital(extent.words())) }
            @if is_between { " (" (percent(tally.share())) ")" }
            @if let Some(split) = split { "; " (decides(split)) }
            @else if is_between { "; no single parameter decides" }
        }
    }
}

/// Returns the cut that decides: `contact stiffness decides: above 7.9e5 lbf/in 98 %, below 7.9e5 lbf/in 20
/// %`.
fn decides(split: &Split) -> String {
    let side = |side: &Side| format!("{} {}", side.name, percent(side.share));
    let [one, other] = &split.sides;
    format!("{} decides: {}, {}", split.parameter, side(one), side(other))
}

/// Returns the paragraph about the method.
fn about(found: &Sensitivity) -> String {
    format!(
        "The thesis does not say how stiff the contacts are, where the coil's force acts, and more. The \
         twelve runs were made at {points} points of the space of these parameters (Sobol' sequence), and \
         every statement was decided at each. Always and never: at all and at none of the points that \
         decide it; mostly and seldom: at half or more, and at fewer. Where {points} points show no \
         exception, a share of {missed:.1} % of exceptions would be missed once in twenty times. The \
         half-truck has nothing of what is open.",
        points = found.points,
        missed = 300.0 / found.points as f64
    )
}

/// The definition of a parameter that decides.
const DECIDES: &str = "A parameter decides if one cut of it (a range at a quarter, half or three quarters; \
                       a choice against the others) tells best where the statement holds, and better than \
                       chance would: the cut whose \u{3c6}\u{b2} is largest, the square of the correlation \
                       of two yes-or-no quantities, if the number of points times \u{3c6}\u{b2} is above 12.";

/// The text about the axes.
const AXES_OF_FIGURES: &str = "The scripts of appendix D limit the axes of some figures, for toe out only, \
                               and the curves stay within them; figures begin at 0.1 to 0.5 s. Where these \
                               runs do, after 0.5 s:";

/// The text about runs with the other frictions.
const FRICTION: &str = "The same points once more with bristles in place of tanh, and with friction along \
                        one tangent a face, as in eqs. 3-8, 3-10 and 3-15: how many statements hold at a \
                        point, on average, and how many hold at half of the points with one friction and \
                        not with the other.";

/// Returns the rule for the stiffness.
fn rule(found: &Sensitivity) -> String {
    format!(
        "Required are {} statements (orders by toe without yaw, lift-off and its silence, stick at the \
         reversal, no lateral force) and the {} axes: {} in all. The stiffness is the middle of that fifth \
         of the range in which most of them hold over all else that is open, and of fifths that do not \
         differ in that, most of all statements. Means differ if they do by more than two standard errors; \
         without such a difference the middle fifth stays, whose middle is the stiffness of the comparison \
         program's wedge.",
        REQUIRED.len(),
        AXES.len(),
        found.stiffness.of_required
    )
}

/// Returns the section; the verdicts stand with the statements.
pub(super) fn section(found: &Sensitivity) -> Markup {
    html! {
        section {
            h2 id="open" { "What the thesis leaves open" }
            p { (about(found)) }
            p { (DECIDES) }
            (parameters(found))
            (groups(found))
            (pairs(found))
            (axes(found))
            (frictions(found))
            (stiffness(found))
            @if !found.unsound.is_empty() {
                p.warning {
                    (found.unsound.values().map(Vec::len).sum::<usize>()) " runs at " (found.unsound.len())
                    " points failed or stopped; statements that need them are not decided there."
                }
            }
        }
    }
}

fn parameters(found: &Sensitivity) -> Markup {
    html! {
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "open" }
                        th scope="col" { "values" }
                        th scope="col" { "as decided" }
                        th.number scope="col" { "decides, statements" }
                        th scope="col" { "why it is open" }
                    }
                }
                tbody {
                    @for parameter in &found.parameters {
                        tr {
                            th scope="row" { (parameter.name) }
                            td { (parameter.range) br; code { (parameter.key) } }
                            td { (parameter.decided) }
                            td.number { (parameter.statements) }
                            td { (parameter.reason) }
                        }
                    }
                }
            }
        }
    }
}

fn groups(found: &Sensitivity) -> Markup {
    let counts = |own: &dyn Fn(&Statement) -> bool| {
        Extent::ALL.map(|extent| {
            let statements = found.statements.iter();
            statements.filter(|one| own(one) && one.extent == extent).count()
        })
    };
    html! {
        h3 { "How many statements hold where" }
        div.wide {
            table {
                thead {
                    tr {
                        th scope="col" { "statements" }
                        @for extent in Extent::ALL { th.number scope="col" { (extent.words()) } }
                    }
                }
                tbody {
                    @for group in ClaimGroup::ALL {
                        tr {
                            th scope="row" { (group.title()) }
                            @for count in counts(&|one| one.group == group) { td.number { (count) } }
                        }
                    }
                    tr {
                        th scope="row" { "all" }
                        @for count in counts(&|_| true) { td.number { (count) } }
                    }
                }
            }
        }
    }
}

/// The definition of a pair that decides.
const PAIRS: &str = "Two parameters decide together where a cut of each tells better than any single cut, \
                     and than chance would: where the number of points times \u{3b7}\u{b2} - \u{3c6}\u{b2} \
                     is above 24, with \u{3b7}\u{b2} the share of the variance between the four quarters. \
                     Shown is the statement that each pair tells best.";

/// Returns the pairs of parameters.
fn pairs(found: &Sensitivity) -> Markup {
    let quarters = |own: &PairShown| {
        let [one, other] = &own.best.sides;
        let of = |first: usize, second: usize| {
            let share = own.best.shares[first][second];
            let share = if share.is_nan() {
                "no point".to_owned()
            } else {
                percent(share)
            };
            format!("{}, {}: {share}", one[first], other[second])
        };
        [of(0, 0), of(0, 1), of(1, 0), of(1, 1)]
    };
    html! {
        @if !found.pairs.is_empty() {
            h3 { "Parameters that decide together" }
            p { (PAIRS) }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "pair" }
                            th.number scope="col" { "decides, statements" }
                            th scope="col" { "told best" }
                            th scope="col" { "where it holds" }
                            th.number scope="col" { "\u{3c6}\u{b2} alone" }
                            th.number scope="col" { "\u{3b7}\u{b2}" }
                        }
                    }
                    tbody {
                        @for own in &found.pairs {
                            tr {
                                th scope="row" { (own.parameters.join(" and ")) }
                                td.number { (own.statements.len()) }
                                td { code { (own.statements[0]) } }
                                td { @for quarter in quarters(own) { (quarter) br; } }
                                td.number { (format!("{:.2}", own.best.alone)) }
                                td.number { (format!("{:.2}", own.best.explains)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the axes of the thesis's figures.
fn axes(found: &Sensitivity) -> Markup {
    html! {
        h3 { "The axes of the thesis's figures" }
        p { (AXES_OF_FIGURES) }
        div.wide {
            table {
                tbody {
                    @for axis in &found.axes {
                        tr {
                            th scope="row" { (axis.axis) }
                            td { (words(axis.extent, axis.tally, axis.decides.as_ref())) }
                        }
                    }
                }
            }
        }
    }
}

/// Another law and other directions of friction, apart from the space.
fn frictions(found: &Sensitivity) -> Markup {
    let rows = found.frictions();
    html! {
        @if !rows.is_empty() {
            h3 { "Other friction" }
            p { (FRICTION) }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "friction" }
                            th.number scope="col" { "points" }
                            th.number scope="col" { "hold, mean" }
                            th.number scope="col" { "as decided (0.001 in/s)" }
                            th.number scope="col" { "only with it" }
                            th.number scope="col" { "only without it" }
                        }
                    }
                    tbody {
                        @for row in rows {
                            tr {
                                th scope="row" { (row.friction) }
                                td.number { (row.points) }
                                td.number { (format!("{:.1}", row.mean[0])) }
                                td.number { (format!("{:.1}", row.mean[1])) }
                                td.number { (row.only_with) }
                                td.number { (row.only_without) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn mean(mean: Mean, decimals: usize) -> String {
    format!("{:.decimals$} \u{b1} {:.decimals$}", mean.mean, mean.error)
}

fn stiffness(found: &Sensitivity) -> Markup {
    let stiffness = &found.stiffness;
    html! {
        @if !stiffness.parts.is_empty() {
            h3 { "The contact stiffness, by rule" }
            p { (rule(found)) }
            div.wide {
                table {
                    thead {
                        tr {
                            th scope="col" { "stiffness of a corner" br; span.unit { "lbf/in" } }
                            th.number scope="col" { "points" }
                            th.number scope="col" { "required that hold" }
                            th.number scope="col" { "all that hold" }
                            th scope="col" { "" }
                        }
                    }
                    tbody {
                        @for (number, part) in stiffness.parts.iter().enumerate() {
                            tr {
                                @let [from, to] = part.stiffness.map(|stiffness| format!("{stiffness:.1e}"));
                                th scope="row" { (from) " to " (to) }
                                td.number { (part.points) }
                                td.number { (mean(part.required, 2)) }
                                td.number { (mean(part.holds, 1)) }
                                td { @if stiffness.chosen == Some(number) { "chosen" } }
                            }
                        }
                    }
                }
            }
        }
    }
}
