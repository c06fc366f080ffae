//! The files of `wedgelab route`: its summary, a table, figures, and what it comes to in words.

use std::fmt::Write as _;
use std::io::{self, Write};

use quantity::Kind;
use study::damage::PlaceDamage;
use study::route::{RouteStep, RouteSummary};
use study::summary::SummaryValue;

use crate::figures::{axis, digits};
use drawing::{Figure, Panel, PlotCurve, distinct};

/// The summary.
pub const SUMMARY: &str = "route.json";
/// Its numbers as a table: one number a row.
pub const TABLE: &str = "route.csv";
/// The figure.
pub const FIGURE: &str = "route.svg";
/// The same as a picture.
pub const PICTURE: &str = "route.png";
/// The result in words.
pub const WORDS: &str = "route.txt";
/// All of them.
pub const NAMES: [&str; 5] = [SUMMARY, TABLE, FIGURE, PICTURE, WORDS];

/// Writes the summary.
///
/// # Errors
/// The writer's.
pub fn write_summary(route: &RouteSummary, out: &mut dyn Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, route)?;
    out.write_all(b"\n")
}

/// Writes the table: step, service at its end, what, its name, quantity, value, unit.
///
/// # Errors
/// The writer's.
pub fn write_table(route: &RouteSummary, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "step,service,service_unit,kind,name,quantity,value,unit")?;
    for (number, step) in (1..).zip(&route.steps) {
        let [_, end] = &step.service;
        let mut row = |kind: &str, name: &str, quantity: &str, own: &SummaryValue| {
            writeln!(
                out,
                "{number},{},{},{kind},{name},{quantity},{},{}",
                end.value, end.unit, own.value, own.unit
            )
        };
        row("car", "", "creep_resistance", &step.creep_resistance)?;
        for (name, own) in &step.wheels {
            row("wheel", name, "wear_number", &own.wear_number)?;
            row("wheel", name, "worn_mass_in_100000_miles", &own.worn_mass)?;
            row("wheel", name, "largest_depth_in_100000_miles", &own.largest_depth)?;
            row("wheel", name, "fatigue_in_100000_miles", &plain(own.fatigue))?;
        }
        for (name, own) in &step.rails {
            row("rail", name, "wear_number", &own.wear_number)?;
            row(
                "rail",
                name,
                "worn_over_an_inch_in_1000000_tons",
                &own.worn_over_an_inch,
            )?;
            row("rail", name, "largest_depth_in_1000000_tons", &own.largest_depth)?;
            row("rail", name, "fatigue_in_1000000_tons", &plain(own.fatigue))?;
        }
        for (name, own) in &step.wedges {
            row("wedge", name, "column_depth", &own.column)?;
            row("wedge", name, "slope_depth", &own.slope)?;
            row("wedge", name, "rise", &own.rise)?;
        }
        for own in &step.runs {
            row("run", &own.name, "share", &plain(own.share))?;
            row("run", &own.name, "creep_resistance", &own.creep_resistance)?;
            row(
                "run",
                &own.name,
                "largest_depth_in_100000_miles",
                &own.largest_depth,
            )?;
        }
    }
    Ok(())
}

fn plain(value: f64) -> SummaryValue {
    SummaryValue {
        value,
        unit: String::new(),
    }
}

/// Returns the figure: the pace of wear over the service, the rise of wedges, and depths over the profiles
/// in the last step.
#[must_use]
pub fn figure(route: &RouteSummary) -> Figure {
    let units = route.units;
    let over = |read: &dyn Fn(&RouteStep) -> Option<f64>, end: usize| -> Vec<(f64, f64)> {
        let steps = route.steps.iter();
        steps
            .filter_map(|step| Some((step.service[end].value, read(step)?)))
            .collect()
    };
    let names = |of: &dyn Fn(&RouteStep) -> Vec<String>| route.steps.last().map(of).unwrap_or_default();
    let wheels = names(&|step| step.wheels.keys().cloned().collect());
    let pace = wheels.iter().enumerate().map(|(number, name)| {
        let read = |step: &RouteStep| step.wheels.get(name).map(|own| own.largest_depth.value);
        PlotCurve::new(name.replace('_', " "), distinct(number), over(&read, 0))
    });
    let wedges = names(&|step| step.wedges.keys().cloned().collect());
    let rises = wedges.iter().enumerate().map(|(number, name)| {
        let read = |step: &RouteStep| step.wedges.get(name).map(|own| own.rise.value);
        let mut points = vec![(0.0, 0.0)];
        points.extend(over(&read, 1));
        PlotCurve::new(name.replace('_', " "), distinct(number), points)
    });
    let depths = |places: &[PlaceDamage]| -> Vec<(f64, f64)> {
        places.iter().map(|place| (place.y, place.depth)).collect()
    };
    let last = route.steps.last();
    let on_wheels = last.into_iter().flat_map(|step| &step.wheels).enumerate();
    let on_wheels = on_wheels.map(|(number, (name, own))| {
        PlotCurve::new(name.replace('_', " "), distinct(number), depths(&own.profile))
    });
    let on_rails = last.into_iter().flat_map(|step| &step.rails).enumerate();
    let on_rails = on_rails.map(|(number, (name, own))| {
        PlotCurve::new(format!("{name} rail"), distinct(number), depths(&own.profile))
    });
    let service = format!("service ({})", route.service.unit);
    let depth = axis("depth", Kind::Length, units);
    let place = axis("to the field side", Kind::Length, units);
    let mut panels = vec![
        Panel::new("(a) deepest place in 100,000 miles", &service, &depth, pace),
        Panel::new("(b) wheels, last step, 100,000 miles", &place, &depth, on_wheels),
        Panel::new("(c) rails, last step, 1,000,000 tons", &place, &depth, on_rails),
    ];
    let rises: Vec<PlotCurve> = rises.collect();
    if !rises.is_empty() {
        let rise = axis("rise", Kind::Length, units);
        panels.push(Panel::new("(d) rise of wedges", &service, rise, rises));
    }
    let caption = "Wear of wheels, rails and wedges along the route, by the mean of its runs.";
    Figure::new(format!("{}: wear along the route", route.name), caption, panels).in_columns(2)
}

/// When a wedge stands higher by some rise.
#[derive(Clone, Debug, PartialEq)]
pub struct RiseReached {
    /// The wedge.
    pub wedge: String,
    /// The service at which it does, in the unit of the route's.
    pub service: f64,
    /// True if that is beyond the route, at the pace of its last step.
    pub beyond: bool,
}

/// Returns when each wedge stands higher by a rise (in the unit of the route's rises), straight between
/// the ends of steps; wedges that do not rise are left out.
#[must_use]
pub fn rise_reached(route: &RouteSummary, rise: f64) -> Vec<RiseReached> {
    let names = route.steps.last().map(|step| step.wedges.keys());
    let of = |name: &String| {
        let ends = route
            .steps
            .iter()
            .filter_map(|step| Some([step.service[1].value, step.wedges.get(name)?.rise.value]));
        let points: Vec<[f64; 2]> = std::iter::once([0.0, 0.0]).chain(ends).collect();
        let within = points.windows(2).find(|pair| pair[1][1] >= rise);
        let pair = within.or(points.windows(2).last())?;
        let [[from, before], [to, after]] = [pair[0], pair[1]];
        let pace = (after - before) / (to - from);
        (pace > 0.0).then(|| RiseReached {
            wedge: name.clone(),
            service: from + (rise - before) / pace,
            beyond: within.is_none(),
        })
    };
    let mut found: Vec<RiseReached> = names.into_iter().flatten().filter_map(of).collect();
    found.sort_by(|a, b| a.service.total_cmp(&b.service));
    found
}

/// Returns the result in words.
#[must_use]
pub fn words(route: &RouteSummary) -> String {
    let mut text = String::new();
    let title = match route.title.is_empty() {
        true => &route.name,
        false => &route.title,
    };
    let shown = |own: &SummaryValue| format!("{} {}", digits(own.value), own.unit);
    // Writing into a string does not fail.
    let _ = writeln!(
        text,
        "{title}: {} of service in {} steps",
        shown(&route.service),
        route.steps.len()
    );
    for step in &route.steps {
        let [from, to] = &step.service;
        let _ = writeln!(text, "\nfrom {} to {}", shown(from), shown(to));
        let _ = writeln!(
            text,
            "  creep takes {} (all wheels)",
            shown(&step.creep_resistance)
        );
        let deepest = step
            .wheels
            .iter()
            .max_by(|a, b| a.1.largest_depth.value.total_cmp(&b.1.largest_depth.value));
        if let Some((name, own)) = deepest {
            let _ = writeln!(
                text,
                "  deepest wear of a wheel in 100,000 miles: {} at {} of {}; {} of steel",
                shown(&own.largest_depth),
                shown(&own.place),
                name.replace('_', " "),
                shown(&own.worn_mass)
            );
        }
        for (side, own) in &step.rails {
            let _ = writeln!(
                text,
                "  {side} rail in 1,000,000 tons: {} at {}; fatigue {}",
                shown(&own.largest_depth),
                shown(&own.place),
                digits(own.fatigue)
            );
        }
        let highest = step
            .wedges
            .iter()
            .max_by(|a, b| a.1.rise.value.total_cmp(&b.1.rise.value));
        if let Some((name, own)) = highest {
            let _ = writeln!(
                text,
                "  highest wedge: {} by {}",
                name.replace('_', " "),
                shown(&own.rise)
            );
        }
        for own in &step.runs {
            let _ = writeln!(
                text,
                "  {} ({} of the way): creep takes {}, {} of {} in 100,000 miles{}",
                own.name,
                digits(own.share),
                shown(&own.creep_resistance),
                shown(&own.largest_depth),
                own.wheel.replace('_', " "),
                if own.outcome == "complete" {
                    String::new()
                } else {
                    format!("; {}", own.outcome)
                }
            );
        }
    }
    for warning in &route.warnings {
        let _ = writeln!(text, "\nwarning: {warning}");
    }
    let _ = writeln!(text, "\nAssumptions");
    for own in &route.assumptions {
        let _ = writeln!(text, "  {own}");
    }
    text
}
