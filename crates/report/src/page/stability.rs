//! The page of a car's stability: its critical speeds over the amplitude, its root locus, and its motions in
//! 3D.

use std::io::{self, Write};

use maud::{Markup, html};
use quantity::{Kind, System as Units};
use study::car::CarCase;
use study::car::mode_shape::{MotionOf, ShownMotion, motions, record};
use study::car::stability::{AtAmplitude, BEYOND, Branch, Stability, left_out};

use super::table::{self, Head};
use super::{document, moving_as, shown_in};
use crate::figures::{Exhibit, capital};
use crate::stability_files::figure;
use crate::view::View;
use crate::view::data::Precision;
use crate::view::mode_shape::factor;
use crate::view::run::Recording;

/// Writes the page as HTML; it needs nothing else to be shown.
///
/// # Errors
/// The writer's, and those of motions that cannot be recorded.
pub fn write(case: &CarCase, found: &Stability, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let mut recordings = Vec::new();
    let mut views = Vec::new();
    for (number, motion) in motions(found).into_iter().enumerate() {
        let own = record(case, &found.steady, &motion).map_err(io::Error::other)?;
        let (name, factor) = (format!("motion {}", number + 1), factor(&own));
        recordings.push(Recording::of_mode_shape(&own, factor).named(&name));
        views.push((name, motion, factor));
    }
    let exhibit = Exhibit::new("stability", figure(&case.name, found, units));
    let svg = exhibit.figure.to_svg();
    let data = View::with(units, recordings, [&exhibit], Precision::Rounded).to_json()?;
    let main = html! {
        section {
            h2 { "Findings" }
            @if found.complete { p { (found.verdict(units)) } }
            @else { p.warning { "Interrupted: what was computed until then is here." } }
            @if let Some(what) = left_out(case) {
                p { "On straight track without irregularities: " (what) "." }
            }
            (branches(found, units))
        }
        @if !found.curve.is_empty() {
            section { h2 { "Critical speed over amplitude" } (over_amplitude(found, units)) }
        }
        @if !views.is_empty() { section { h2 id="moving" { "Motions" } (moving(&views, units)) } }
        section { h2 { "Figure" } (shown_in(&exhibit, &svg, None)) }
    };
    let heading = format!("Stability of {}", capital(title(case)));
    let lead = format!(
        "The car {} about steady running on straight track. Computed by wedgelab {}.",
        case.name,
        env!("CARGO_PKG_VERSION")
    );
    out.write_all(document(&heading, &lead, None, &main, Some(&data)).as_bytes())
}

fn title(case: &CarCase) -> &str {
    if case.title.is_empty() {
        &case.name
    } else {
        &case.title
    }
}

fn speed(si: f64, units: Units) -> String {
    let kind = Kind::TravelSpeed;
    format!("{:.1} {}", si * kind.from_si(units), kind.label(units))
}

fn length(si: f64, units: Units) -> String {
    let own = si * Kind::Length.from_si(units);
    format!("{own:.3} {}", Kind::Length.label(units))
}

/// Returns the critical speeds of the branches.
fn branches(found: &Stability, units: Units) -> Markup {
    let row = |own: &Branch| {
        let kind = own.kind.words().to_owned();
        let Some(critical) = &own.critical else {
            let none = "none at these speeds".to_owned();
            return [kind, none, "–".to_owned(), "–".to_owned()];
        };
        let before = if critical.at_lowest { "below " } else { "" };
        let at = speed(critical.speed, units);
        let frequency = format!("{:.2}", critical.frequency);
        [kind, format!("{before}{at}"), frequency, critical.name.clone()]
    };
    let heads = [
        Head::Words("smallest motions"),
        Head::Numbers("grow from"),
        Head::Numbers("frequency (Hz)"),
        Head::Words("motion"),
    ];
    table::wide(&heads, found.branches.iter().map(row))
}

/// Returns the critical speed of each amplitude, from small to large.
fn over_amplitude(found: &Stability, units: Units) -> Markup {
    let fastest = found.speeds.iter().fold(0.0_f64, |most, own| most.max(*own));
    let heads = [
        Head::Numbers("amplitude"),
        Head::Numbers("critical speed"),
        Head::Numbers("frequency (Hz)"),
        Head::Words("motion"),
    ];
    let row = |own: &AtAmplitude| {
        let amplitude = length(own.amplitude, units);
        let Some(critical) = &own.critical else {
            let none = match own.unsolved {
                true => "not found".to_owned(),
                false => format!("above {}", speed(BEYOND * fastest, units)),
            };
            return [amplitude, none, "–".to_owned(), "–".to_owned()];
        };
        let frequency = format!("{:.2}", critical.frequency);
        [
            amplitude,
            speed(critical.speed, units),
            frequency,
            critical.name.clone(),
        ]
    };
    html! {
        p {
            "The speed beyond which a motion of this lateral amplitude of the wheelset that moves most \
             grows, by equivalent linearization of friction, conicity and creep."
        }
        (table::wide(&heads, found.curve.iter().rev().map(row)))
    }
}

/// Returns the motions in 3D, the first one open.
fn moving(views: &[(String, ShownMotion, f64)], units: Units) -> Markup {
    html! {
        p {
            "Shapes of motions that neither grow nor die away, over two periods; the car stands still along \
             the track. What is drawn is the steady car plus the displacements of the motion, exaggerated so \
             that they are seen: then wheels are drawn beside their rails. Plots have the true sizes, but \
             those of motions with friction stuck or absent have none: they are drawn with the largest \
             amplitude that is looked at. There are no forces: the motion is that of a linear car."
        }
        div.without-forces {
            @for (number, (name, motion, factor)) in views.iter().enumerate() {
                (moving_as(name, &words(motion, *factor, units), number == 0))
            }
        }
    }
}

/// Returns what a motion is, in words.
fn words(motion: &ShownMotion, factor: f64, units: Units) -> String {
    let what = match motion.of {
        MotionOf::Amplitude(amplitude) => format!("amplitude {}", length(amplitude, units)),
        MotionOf::Branch(kind, false) => kind.words().to_owned(),
        MotionOf::Branch(kind, true) => {
            format!(
                "{}, which grows at this speed already, drawn without growth",
                kind.words()
            )
        }
    };
    let (name, frequency) = (capital(&motion.name), motion.frequency);
    let at = speed(motion.speed, units);
    format!("{name}: {frequency:.2} Hz at {at} ({what}); drawn {factor:.0} times as large")
}
