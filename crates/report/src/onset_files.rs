//! The files of the onset of hunting: measures of a car at held speeds on perfect track and on track of FRA
//! class 4, as CSV, JSON and figure, and the speeds of onset in words.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use serde::Serialize;
use study::car::onset::{MEASURES, Measure, OnTrack, Onset, OnsetSpeed, OnsetTrack};

use crate::csv::rounded;
use crate::figures::axis;
use crate::output_table::OutputTable;
use crate::summary::write_json;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The table.
pub const TABLE: &str = "onset.csv";
/// Speeds of onset.
pub const NUMBERS: &str = "onset.json";
/// The figure.
pub const FIGURE: &str = "onset.svg";
/// The same as a picture.
pub const PICTURE: &str = "onset.png";
/// All of them.
pub const NAMES: [&str; 4] = [TABLE, NUMBERS, FIGURE, PICTURE];
/// The schema of [`NUMBERS`].
pub const SCHEMA: &str = "wedgelab.car_onset/1";

/// Writes the measures: track, speed, each measure, the body's rms over 2 s, and how the run ended.
///
/// # Errors
/// The writer's.
pub fn write_table(found: &Onset, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let tracks = found.tracks.iter();
    let points = tracks.flat_map(|own| own.points.iter().map(|point| (own.track, point)));
    let mut table = OutputTable::new(points, units);
    table.text("track", |(track, _)| track.name());
    table.rounded("speed", Kind::TravelSpeed, |(_, point)| point.speed);
    for measure in MEASURES {
        table.number(measure.name(), measure.kind(), move |(_, point)| {
            point.raw(measure)
        });
    }
    table.number("body_rms", Kind::RideAcceleration, |(_, point)| point.body_rms);
    table.text("outcome", |(_, point)| point.outcome.word());
    table.write_csv(out)
}

#[derive(Serialize)]
struct Document<'d> {
    schema: &'static str,
    name: &'d str,
    complete: bool,
    speed_unit: &'static str,
    speeds: Vec<f64>,
    measures: Vec<MeasureDocument>,
    warnings: Vec<String>,
    about: &'static str,
}

#[derive(Serialize)]
struct MeasureDocument {
    measure: &'static str,
    text: &'static str,
    unit: &'static str,
    limit: f64,
    onsets: Vec<OnsetDocument>,
}

#[derive(Serialize)]
struct OnsetDocument {
    track: &'static str,
    /// `from`, `all_from` (above the limit at all speeds tried), `none_up_to`; none where nothing was run.
    onset: Option<&'static str>,
    speed: Option<f64>,
    /// The largest value of the runs that came to their ends.
    largest: Option<f64>,
}

fn onset_document(own: &OnTrack, measure: Measure, units: Units) -> OnsetDocument {
    let (onset, speed) = match own.onset(measure) {
        None => (None, None),
        Some(OnsetSpeed::From(speed)) => (Some("from"), Some(speed)),
        Some(OnsetSpeed::AllFrom(speed)) => (Some("all_from"), Some(speed)),
        Some(OnsetSpeed::NoneUpTo(speed)) => (Some("none_up_to"), Some(speed)),
    };
    let values = own.points.iter().filter_map(|point| point.value(measure));
    OnsetDocument {
        track: own.track.name(),
        onset,
        speed: speed.map(|si| rounded(si * Kind::TravelSpeed.from_si(units))),
        largest: values
            .reduce(f64::max)
            .map(|si| si * measure.kind().from_si(units)),
    }
}

/// Writes the speeds of onset by each measure on each track.
///
/// # Errors
/// The writer's.
pub fn write_numbers(case: &str, found: &Onset, units: Units, out: &mut dyn Write) -> io::Result<()> {
    let measures = MEASURES.map(|measure| MeasureDocument {
        measure: measure.name(),
        text: measure.words(),
        unit: measure.kind().label(units),
        limit: rounded(measure.limit() * measure.kind().from_si(units)),
        onsets: found
            .tracks
            .iter()
            .map(|own| onset_document(own, measure, units))
            .collect(),
    });
    let speeds = found.speeds.iter();
    let document = Document {
        schema: SCHEMA,
        name: case,
        complete: found.complete,
        speed_unit: Kind::TravelSpeed.label(units),
        speeds: speeds
            .map(|si| rounded(si * Kind::TravelSpeed.from_si(units)))
            .collect(),
        measures: measures.into(),
        warnings: warnings(found, units),
        about: "Held speeds, straight track, 600 ft to settle and 2,000 ft of statistics. Perfect track: all \
                axles start 0.4 in to the left. fra_class_4: irregularities by the spectra and seeds of the \
                regime of this name. The onset is the lowest speed tried from which on the measure is above \
                its limit, by linear interpolation from the speed before it.",
    };
    write_json(&document, out)
}

/// Returns the warnings of all runs, each with its track and speed.
#[must_use]
pub fn warnings(found: &Onset, units: Units) -> Vec<String> {
    let of_track = |own: &OnTrack| -> Vec<String> {
        let points = own.points.iter().flat_map(|point| {
            let place = format!("{} at {}", own.track.words(), speed(point.speed, units));
            let all = point.warnings.iter();
            all.map(move |warning| format!("{place}: {warning}"))
        });
        points.collect()
    };
    found.tracks.iter().flat_map(of_track).collect()
}

/// Returns a speed (m/s) in words.
fn speed(si: f64, units: Units) -> String {
    let factor = Kind::TravelSpeed.from_si(units);
    format!("{:.1} {}", si * factor, Kind::TravelSpeed.label(units))
}

/// Returns the speeds of onset in words, a sentence for each measure: "Hunting by the body's standard
/// deviation over 2,000 ft, limit 0.13 g: it passes it at 58.0 mph on perfect track, and ..."
#[must_use]
pub fn sentences(found: &Onset, units: Units) -> Vec<String> {
    MEASURES
        .map(|measure| {
            let kind = measure.kind();
            let limit = rounded(measure.limit() * kind.from_si(units));
            let tracks = found.tracks.each_ref().map(|own| {
                let place = own.track.words();
                let fast = |si| speed(si, units);
                match own.onset(measure) {
                    None => format!("is unknown on {place}"),
                    Some(OnsetSpeed::From(si)) => {
                        format!("passes it at {} on {place}", fast(si))
                    }
                    Some(OnsetSpeed::AllFrom(si)) => {
                        format!(
                            "is above it from {}, the lowest speed run, on {place}",
                            speed(si, units)
                        )
                    }
                    Some(OnsetSpeed::NoneUpTo(si)) => {
                        format!("stays below it up to {} on {place}", fast(si))
                    }
                }
            });
            format!(
                "Hunting by {}, limit {limit} {}: it {}.",
                measure.words(),
                kind.label(units),
                tracks.join(", and ")
            )
        })
        .into()
}

/// Returns the curve of a measure on a track.
fn curve(own: &OnTrack, measure: Measure, units: Units) -> PlotCurve {
    let (colour, line) = match own.track {
        OnsetTrack::Perfect => (Colour::Blue, Line::Solid),
        OnsetTrack::Class4 => (Colour::Vermillion, Line::Dashed),
    };
    let points = own.points.iter().map(|point| {
        let speed = point.speed * Kind::TravelSpeed.from_si(units);
        (speed, point.raw(measure) * measure.kind().from_si(units))
    });
    PlotCurve::new(own.track.words(), (colour, line), points)
}

/// Returns the figure: each measure over the speed on both tracks, with its limit.
#[must_use]
pub fn figure(case: &str, found: &Onset, units: Units) -> Figure {
    let ends = [found.speeds.first(), found.speeds.last()];
    let ends = ends.map(|si| si.copied().unwrap_or_default() * Kind::TravelSpeed.from_si(units));
    let panel = |title: &str, name: &str, measure: Measure| {
        let kind = measure.kind();
        let mut curves: Vec<PlotCurve> = found
            .tracks
            .iter()
            .map(|own| curve(own, measure, units))
            .collect();
        let limit = measure.limit() * kind.from_si(units);
        curves.push(PlotCurve::new(
            "limit",
            (Colour::Grey, Line::Dotted),
            ends.map(|speed| (speed, limit)),
        ));
        Panel::new(
            title,
            axis("speed", Kind::TravelSpeed, units),
            axis(name, kind, units),
            curves,
        )
    };
    Figure::new(
        format!("{case}: onset of hunting"),
        "Held speeds, 2,000 ft of statistics. Perfect track: all axles start 0.4 in to the left. \
                  Class 4 track: irregularities by spectra. Limits: 0.13 g (AAR M-1001, chapter XI), 0.30 g \
                  (49 CFR 213.333), both remembered, and 0.38 in, a guess.",
        [
            panel(
                "(a) body, over 2,000 ft",
                "standard deviation",
                Measure::Deviation,
            ),
            panel("(b) truck, over 2 s", "rms", Measure::TruckRms),
            panel(
                "(c) wheelsets between the rails",
                "lateral amplitude",
                Measure::Amplitude,
            ),
        ],
    )
}
