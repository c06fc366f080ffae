//! The files of `wedgelab wear`: the course of wear as a table, depths and pressures over the faces, the worn
//! case, figures, and what it comes to in words.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use study::wear::{LIMIT, WearHistory, WearLaw, WearPlan, WearState, maps};
use wedge::face::{DepthMap, FaceProperties};
use wedge::outputs::FACES;

use crate::csv::converted;
use crate::figures::{axis, capital, digits, over_face};
use crate::output_table::OutputTable;
use drawing::{Colour, Figure, Line, Panel, PlotCurve};

/// The course of wear over the cycles.
pub const COURSE: &str = "wear.csv";
/// Depths and mean pressures of all points at every step.
pub const POINTS: &str = "wear_points.csv";
/// The depths of both faces at the end, as `wedge_wear` takes them.
pub const DEPTHS: [&str; 2] = ["column_wear.csv", "slope_wear.csv"];
/// The depths of both counterfaces at the end, as `counterface_wear` takes them; where these are worn.
pub const COUNTERFACES: [&str; 2] = ["column_counterface_wear.csv", "slope_counterface_wear.csv"];
/// The case with the depths of the end.
pub const CASE: &str = "worn.toml";
/// The figure.
pub const FIGURE: &str = "wear.svg";
/// The same as a picture.
pub const PICTURE: &str = "wear.png";
/// The result in words.
pub const WORDS: &str = "wear.txt";
/// All of them, but for those of counterfaces.
pub const NAMES: [&str; 8] = [COURSE, POINTS, DEPTHS[0], DEPTHS[1], CASE, FIGURE, PICTURE, WORDS];

/// The numbers of the law that the user gave; the others are guesses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Given {
    /// The coefficient.
    pub coefficient: bool,
    /// The hardness.
    pub hardness: bool,
}

/// Returns a volume in shown units, and their name.
#[must_use]
pub fn volume(si: f64, units: Units) -> (f64, &'static str) {
    let length = Kind::Length.from_si(units);
    let name = match units {
        Units::Us => "in3",
        Units::Si => "m3",
    };
    (si * length * length * length, name)
}

/// Returns the largest depth of a counterface, m; zero where it is not worn.
fn deepest_of_counterface(state: &WearState, face: usize) -> f64 {
    let map = state.counterfaces.as_ref().and_then(|own| own[face].map.as_ref());
    let depths = map.into_iter().flat_map(DepthMap::points);
    depths.map(|[.., depth]| depth).fold(0.0, f64::max)
}

/// Writes the course of wear: a row a state.
///
/// # Errors
/// The writer's.
pub fn write_course(history: &WearHistory, out: &mut dyn Write) -> io::Result<()> {
    let units = history.case.simulation.output_units;
    let worn = history.states.iter().any(|state| state.counterfaces.is_some());
    let mut table = OutputTable::new(&history.states, units);
    table.rounded("cycles", Kind::Count, |state| state.cycles);
    for (face, name) in FACES.into_iter().enumerate() {
        add_volume(&mut table, &format!("{name}_volume"), units, move |s| {
            s.faces[face].volume
        });
        let rate = move |s: &WearState| s.faces[face].volume_per_cycle;
        add_volume(&mut table, &format!("{name}_volume_per_cycle"), units, rate);
        table.number(&format!("{name}_deepest"), Kind::Length, move |s| {
            let depths = s.faces[face].depths.iter().copied();
            depths.fold(f64::NEG_INFINITY, f64::max)
        });
        table.number(
            &format!("{name}_greatest_mean_pressure"),
            Kind::Pressure,
            move |s| s.faces[face].pressures.iter().copied().fold(0.0, f64::max),
        );
        let force = format!("{name}_mean_normal_force");
        table.number(&force, Kind::Force, move |s| s.faces[face].mean_force);
        table.number(&format!("{name}_loss_per_cycle"), Kind::Energy, move |s| {
            s.faces[face].loss
        });
        if worn {
            add_volume(
                &mut table,
                &format!("{name}_counterface_volume"),
                units,
                move |s| s.counterfaces.as_ref().map_or(0.0, |own| own[face].volume),
            );
            let deepest = format!("{name}_counterface_deepest");
            table.number(&deepest, Kind::Length, move |s| deepest_of_counterface(s, face));
        }
    }
    table.number("wedge_rise", Kind::Length, |state| state.rise);
    table.number("equivalent_damping", Kind::Damping, |state| state.damping);
    table.write_csv(out)
}

/// Adds a column of volumes.
fn add_volume<'t>(
    table: &mut OutputTable<'t, &'t WearState>,
    name: &str,
    units: Units,
    of: impl Fn(&WearState) -> f64 + 't,
) {
    let name = format!("{name}_{}", volume(0.0, units).1);
    table.number(&name, Kind::Count, move |state| volume(of(state), units).0);
}

fn faces(history: &WearHistory) -> [&FaceProperties; 2] {
    let parameters = &history.case.parameters;
    [&parameters.column_face, &parameters.slope_face]
}

/// Writes depth and mean pressure of each point at every step.
///
/// # Errors
/// The writer's.
pub fn write_points(history: &WearHistory, out: &mut dyn Write) -> io::Result<()> {
    let units = history.case.simulation.output_units;
    let rectangles = history.case.parameters.rectangles();
    let mut rows = Vec::new();
    for state in &history.states {
        for (number, face) in faces(history).into_iter().enumerate() {
            let own = &state.faces[number];
            let mut points: Vec<_> = face.grid.points().into_iter().enumerate().collect();
            points.sort_by_key(|(_, point)| (point.row, point.column));
            rows.extend(points.into_iter().map(|(i, point)| {
                let (up, across) = rectangles[number].distances(&point);
                let place = (state.cycles, FACES[number], point.number());
                (place, [up, across, own.depths[i]], own.pressures[i])
            }));
        }
    }
    let mut table = OutputTable::new(rows, units);
    table.rounded("cycles", Kind::Count, |((cycles, ..), ..)| *cycles);
    table.text("face", |((_, face, _), ..)| face);
    table.text("point", |((.., point), ..)| point);
    for (place, name) in ["up", "across", "depth"].into_iter().enumerate() {
        table.rounded(name, Kind::Length, move |(_, lengths, _)| lengths[place]);
    }
    table.number("mean_pressure", Kind::Pressure, |(.., pressure)| *pressure);
    table.write_csv(out)
}

/// Writes the depths of a face at the end, as `wedge_wear` takes them.
///
/// # Errors
/// The writer's.
pub fn write_depths(history: &WearHistory, face: usize, out: &mut dyn Write) -> io::Result<()> {
    let depths = history.states.last().map(|last| {
        let depths = [0, 1].map(|face: usize| last.faces[face].depths.clone());
        maps(&history.case, &depths)
    });
    write_map(history, depths.iter().filter_map(|maps| maps[face].as_ref()), out)
}

/// Writes the depths of a counterface at the end, as `counterface_wear` takes them.
///
/// # Errors
/// The writer's.
pub fn write_counterface(history: &WearHistory, face: usize, out: &mut dyn Write) -> io::Result<()> {
    let last = history.states.last();
    let worn = last.and_then(|last| last.counterfaces.as_ref()?[face].map.as_ref());
    write_map(history, worn.into_iter(), out)
}

fn write_map<'m>(
    history: &WearHistory,
    map: impl Iterator<Item = &'m DepthMap>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let units = history.case.simulation.output_units;
    let (unit, factor) = (Kind::Length.label(units), Kind::Length.from_si(units));
    let mut table = OutputTable::new(map.flat_map(DepthMap::points), units);
    for (place, name) in ["up", " across", " depth"].into_iter().enumerate() {
        let name = format!("{name} [{unit}]");
        table.rounded(&name, Kind::Count, move |point| point[place] * factor);
    }
    table.write_csv(out)
}

/// Returns the figure: depths over both faces at the end, volumes and damping over the cycles.
#[must_use]
pub fn figure(history: &WearHistory) -> Figure {
    let units = history.case.simulation.output_units;
    let Some(last) = history.states.last() else {
        return Figure::default();
    };
    let rectangles = history.case.parameters.rectangles();
    let mut panels = Vec::new();
    for (number, face) in faces(history).into_iter().enumerate() {
        let mut points: Vec<_> = face.grid.points().into_iter().enumerate().collect();
        points.sort_by_key(|(_, point)| (point.column, point.row));
        let depths = points.iter().map(|(i, _)| last.faces[number].depths[*i]);
        // Thousandths: depths of wear are small lengths.
        let heights: Vec<f64> = depths
            .map(|depth| 1e3 * converted(depth, Kind::Length, units))
            .collect();
        let deepest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let unit = match units {
            Units::Us => "0.001 in",
            Units::Si => "mm",
        };
        let title = format!(
            "{}: depth in {unit}, deepest {}",
            capital(FACES[number]),
            digits(deepest)
        );
        panels.push(over_face(title, face, &rectangles[number], &heights, units));
    }
    let course = |label: &str, colour: Colour, line: Line, of: &dyn Fn(&WearState) -> f64| {
        PlotCurve::new(
            label,
            (colour, line),
            history.states.iter().map(|state| (state.cycles, of(state))),
        )
    };
    let (_, cubed) = volume(0.0, units);
    let volumes = [0, 1].map(|face: usize| {
        let (colour, line) = [(Colour::Blue, Line::Solid), (Colour::Vermillion, Line::DashDot)][face];
        course(FACES[face], colour, line, &|state| {
            volume(state.faces[face].volume, units).0
        })
    });
    panels.push(Panel::new(
        "",
        "cycles",
        format!("volume worn ({cubed})"),
        volumes.to_vec(),
    ));
    let damping = course("", Colour::Black, Line::Solid, &|state| {
        converted(state.damping, Kind::Damping, units)
    });
    panels.push(Panel::new(
        "",
        "cycles",
        axis("equivalent damping", Kind::Damping, units),
        [damping],
    ));
    Figure {
        columns: 2,
        ..Figure::new(
            format!("{}: wear after {} cycles", history.case.name, digits(last.cycles)),
            "Above: lines of equal depth over the wedge's faces, seen from the counterface; left (+y) is \
                  the wedge's left side. Below: the volume worn, and the viscous damping that would take as \
                  much energy as the column's friction.",
            panels,
        )
    }
}

/// Returns the result of wear in words.
#[must_use]
pub fn words(history: &WearHistory, plan: &WearPlan, given: Given) -> String {
    let units = history.case.simulation.output_units;
    let (Some(first), Some(last)) = (history.states.first(), history.states.last()) else {
        return String::new();
    };
    let guess = |given: bool| if given { "given" } else { "a guess" };
    let law = match plan.law {
        WearLaw::Archard(law) => format!(
            "Law: Archard, V = K * integral of N |v| dt / H, with K = {:e} ({}) and H = {:e} Pa ({}).",
            law.coefficient,
            guess(given.coefficient),
            law.hardness,
            guess(given.hardness)
        ),
        WearLaw::Energy(law) => format!(
            "Law: energy, V = a * energy lost in friction, with a = {:e} m3/J ({}).",
            law.coefficient,
            guess(given.coefficient)
        ),
    };
    let mut text = format!(
        "Wear of {} after {} of {} cycles, in {} steps.\n{law}\n",
        history.case.name,
        last.cycles,
        plan.cycles,
        history.states.len() - 1
    );
    let guessed = !given.coefficient || (!given.hardness && matches!(plan.law, WearLaw::Archard(_)));
    if guessed {
        text.push_str(
            "Guessed numbers are known to an order of magnitude at best: volumes and numbers of cycles are \
             as uncertain.\nMeasure the wear of your pair, and give --coefficient and --hardness.\n",
        );
    }
    let shown = |value: f64, kind: Kind| {
        let number = converted(value, kind, units);
        format!("{} {}", digits(number), kind.label(units))
    };
    for (face, name) in FACES.into_iter().enumerate() {
        let own = &last.faces[face];
        let (worn, unit) = volume(own.volume, units);
        let deepest = own.depths.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let shallowest = own.depths.iter().copied().fold(f64::INFINITY, f64::min);
        text.push_str(&format!(
            "{}: {} {unit} worn, depth from {} to {}; {} {unit} a cycle at first, {} at the end.\n",
            capital(name),
            digits(worn),
            shown(shallowest, Kind::Length),
            shown(deepest, Kind::Length),
            digits(volume(first.faces[face].volume_per_cycle, units).0),
            digits(volume(own.volume_per_cycle, units).0),
        ));
        text.push_str(&format!(
            "  Mean normal force over the cycle from {} to {}, friction takes {} a cycle, then {}.\n",
            shown(first.faces[face].mean_force, Kind::Force),
            shown(own.mean_force, Kind::Force),
            shown(first.faces[face].loss, Kind::Energy),
            shown(own.loss, Kind::Energy),
        ));
    }
    text.push_str(&format!(
        "The wedge stands {} higher than at the start. Equivalent damping from {} to {}.\n",
        shown(last.rise, Kind::Length),
        shown(first.damping, Kind::Damping),
        shown(last.damping, Kind::Damping),
    ));
    if let Some(worn) = &last.counterfaces {
        for (face, name) in FACES.into_iter().enumerate() {
            let (volume, unit) = volume(worn[face].volume, units);
            text.push_str(&format!(
                "Counterface of the {name}: {} {unit} worn, {} of the wedge's; depth to {}.\n",
                digits(volume),
                plan.counterface,
                shown(deepest_of_counterface(last, face), Kind::Length),
            ));
        }
    }
    let mismatch = history
        .states
        .iter()
        .map(|state| state.mismatch)
        .fold(0.0, f64::max);
    text.push_str(&format!(
        "No step wears a point by more than {LIMIT} of its penetration. Energies of all points are within \
         {mismatch:.1e} of the ledger's losses.\n"
    ));
    if last.counterfaces.is_none() {
        text.push_str(
            "The wedge's faces are worn, column and pocket are not: with --counterface they are, by a ratio \
             of the wedge's wear.\n",
        );
    }
    text
}
