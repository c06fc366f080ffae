//! Runs over each other: loops, time histories, and of what rolls histories over the distance.
//!
//! Every run is drawn at its own rows, in the units of the first one. A run that lacks a column is left out
//! of its panel, and the caption says so.

use ::study::truck::WEDGE_NAMES;
use quantity::{Kind, System as Units};

use super::{Exhibit, axis};
use crate::overlay::{self, words};
use crate::run_folder::RunFolder;
use crate::table::TableColumn;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use study::models::AnySummary;

/// A figure that a model has: panels of one column over another.
struct Wanted {
    name: String,
    title: String,
    /// The caption without the runs.
    caption: String,
    /// Columns along both axes, and the panel's title.
    panels: Vec<[String; 3]>,
    /// True if it is drawn only where something moves along both axes.
    loops: bool,
}

impl Wanted {
    fn new(name: &str, title: &str, caption: &str, x: &str, columns: &[(&str, &str)]) -> Self {
        let panels = columns
            .iter()
            .map(|(y, title)| [x, *y, *title].map(str::to_owned));
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            caption: caption.to_owned(),
            panels: panels.collect(),
            loops: false,
        }
    }

    fn looped(self) -> Self {
        Self { loops: true, ..self }
    }
}

/// Returns the figures of these runs over each other, in the units of the first.
#[must_use]
pub fn exhibits(runs: &[RunFolder]) -> Vec<Exhibit> {
    let Some(units) = runs.first().map(RunFolder::units) else {
        return Vec::new();
    };
    let mut wanted: Vec<Wanted> = Vec::new();
    for run in runs {
        for own in of_model(run) {
            if wanted.iter().all(|other| other.name != own.name) {
                wanted.push(own);
            }
        }
    }
    let drawn = wanted.iter().filter_map(|own| exhibit(own, runs, units));
    drawn.collect()
}

/// Returns the figure; `None` where no run has anything of it.
fn exhibit(wanted: &Wanted, runs: &[RunFolder], units: Units) -> Option<Exhibit> {
    let mut panels = Vec::new();
    let mut drawn = vec![false; runs.len()];
    for [x, y, title] in &wanted.panels {
        let mut panel = Panel::default();
        for (number, run) in runs.iter().enumerate() {
            let (Some(abscissa), Some(ordinate)) = (best(run, x), best(run, y)) else {
                continue;
            };
            let moves = |own: &TableColumn| overlay::moves(own.kind, &own.si());
            if wanted.loops && !(moves(abscissa) && moves(ordinate)) {
                continue;
            }
            if panel.curves.is_empty() {
                panel.x_label = axis(&words(x), abscissa.kind, units);
                panel.y_label = axis(&words(y), ordinate.kind, units);
            }
            drawn[number] = true;
            let points = abscissa.in_units(units).into_iter().zip(ordinate.in_units(units));
            panel
                .curves
                .push(PlotCurve::new(run.label.clone(), look(number), points));
        }
        if !panel.curves.is_empty() {
            panel.title.clone_from(title);
            panels.push(panel);
        }
    }
    if panels.is_empty() {
        return None;
    }
    let missing = runs.iter().zip(&drawn).filter(|(_, drawn)| !**drawn);
    let missing: Vec<&str> = missing.map(|(run, _)| run.label.as_str()).collect();
    let mut caption = format!("{} Each run at its own output times.", wanted.caption);
    if !missing.is_empty() {
        caption.push_str(&format!(" Not in {}.", missing.join(", ")));
    }
    let columns = if panels.len() > 1 { 2 } else { 0 };
    Some(Exhibit::new(
        format!("overlay_{}", wanted.name),
        Figure::new(wanted.title.clone(), caption, panels).in_columns(columns),
    ))
}

/// Colour and line of a run: the same in every figure.
fn look(number: usize) -> (Colour, Line) {
    match number {
        // Two runs are told apart best by black, solid, under vermillion, dashed.
        0 => (Colour::Black, Line::Solid),
        1 => (Colour::Vermillion, Line::Dashed),
        number => distinct(number),
    }
}

/// Returns the filtered column if there is one, else the raw one.
fn best<'r>(run: &'r RunFolder, name: &str) -> Option<&'r TableColumn> {
    let filtered = format!("{name}_filtered");
    let columns = run.table.columns();
    let find = |name: &str| columns.iter().find(|own| own.name == name);
    find(&filtered).or_else(|| find(name))
}

fn of_model(run: &RunFolder) -> Vec<Wanted> {
    match &run.summary {
        AnySummary::Wedge(_) => of_wedge(),
        AnySummary::Truck(_) => of_truck(),
        AnySummary::Car(_) => of_car(),
        AnySummary::HalfTruck(own) => of_half_truck(own.wedges.keys().map(String::as_str)),
        AnySummary::Vehicle(_) => of_vehicle(run),
        AnySummary::Wheelset(_) => of_wheelset(),
    }
}

/// The displacements of a vehicle's bodies, and the forces of its elements.
fn of_vehicle(run: &RunFolder) -> Vec<Wanted> {
    let of = |kind: Kind, ending: &str| -> Vec<(String, String)> {
        let own = run.table.columns().iter();
        let own = own.filter(|column| column.kind == kind && column.name.ends_with(ending));
        own.map(|column| (column.name.clone(), words(&column.name)))
            .take(6)
            .collect()
    };
    let wanted = |name: &str, title: &str, caption: &str, own: Vec<(String, String)>| {
        let own: Vec<(&str, &str)> = own.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
        Wanted::new(name, title, caption, "time", &own)
    };
    vec![
        wanted(
            "vehicle_motion",
            "Vertical motion over time",
            "Displacements of bodies upwards, the first six.",
            of(Kind::Length, "_z"),
        ),
        wanted(
            "vehicle_forces",
            "Forces over time",
            "Forces of elements, the first six.",
            of(Kind::Force, "_force"),
        ),
    ]
}

fn of_wedge() -> Vec<Wanted> {
    vec![
        Wanted::new(
            "wedge_loop",
            "Force over travel",
            "Vertical wedge force (friction of the column on the side frame, positive up) over the bolster's \
             vertical displacement, positive up.",
            "bolster_vertical",
            &[("vertical_wedge_force", "")],
        )
        .looped(),
        Wanted::new(
            "wedge_forces",
            "Forces over time",
            "Forces of wedge and coil.",
            "time",
            &[
                ("vertical_wedge_force", "(a) vertical wedge force"),
                (
                    "vertical_force_on_side_frame",
                    "(b) with the coil, where it stands there",
                ),
                ("longitudinal_wedge_force", "(c) longitudinal wedge force"),
                ("coil_force", "(d) coil"),
            ],
        ),
        Wanted::new(
            "wedge_motion",
            "Motion over time",
            "Displacements of bolster and wedge.",
            "time",
            &[
                ("bolster_vertical", "(a) bolster, vertical"),
                ("wedge_z", "(b) wedge, vertical"),
                ("wedge_x", "(c) wedge, longitudinal"),
                ("wedge_yaw", "(d) wedge, yaw"),
            ],
        ),
    ]
}

fn of_truck() -> Vec<Wanted> {
    let of_wedges = |what: &str| -> Vec<(String, String)> {
        let letters = ["(a)", "(b)", "(c)", "(d)"].into_iter();
        let wedges = WEDGE_NAMES.into_iter().zip(letters);
        wedges
            .map(|(wedge, letter)| (format!("{wedge}_{what}"), format!("{letter} {}", words(wedge))))
            .collect()
    };
    let wedges = |name: &str, title: &str, caption: &str, x: &str, what: &str| {
        let own = of_wedges(what);
        let own: Vec<(&str, &str)> = own
            .iter()
            .map(|(name, title)| (name.as_str(), title.as_str()))
            .collect();
        Wanted::new(name, title, caption, x, &own)
    };
    vec![
        Wanted::new(
            "nest_loops",
            "Nest force over travel",
            "Load of each nest with its wedges over the bolster's vertical displacement, positive up.",
            "bolster_z",
            &[
                ("left_nest_vertical_force", "(a) left nest"),
                ("right_nest_vertical_force", "(b) right nest"),
            ],
        )
        .looped(),
        Wanted::new(
            "warp_loop",
            "Warp moment over warp angle",
            "Warp moment on the bolster over the warp angle.",
            "warp_angle",
            &[("warp_moment", "")],
        )
        .looped(),
        wedges(
            "column_friction",
            "Column friction of the wedges",
            "Friction of each column on the side frame, positive up.",
            "time",
            "column_friction_z",
        ),
        wedges(
            "column_normals",
            "Normal forces of the columns",
            "Normal force of each wedge at its column.",
            "time",
            "column_normal",
        ),
        Wanted::new(
            "truck_motion",
            "Motion over time",
            "The bolster's displacement and roll, and the warp angle.",
            "time",
            &[
                ("bolster_z", "(a) bolster, vertical"),
                ("bolster_roll", "(b) bolster, roll"),
                ("warp_angle", "(c) warp angle"),
                ("warp_moment", "(d) warp moment"),
            ],
        ),
    ]
}

fn of_car() -> Vec<Wanted> {
    let wheels = |name: &str, title: &str, caption: &str, what: &str| {
        let places = [
            (1, "left", "(a) axle 1, left"),
            (1, "right", "(b) axle 1, right"),
            (3, "left", "(c) axle 3, left"),
            (3, "right", "(d) axle 3, right"),
        ];
        let own = places.map(|(axle, side, title)| (format!("axle_{axle}_{side}_{what}"), title));
        let own: Vec<(&str, &str)> = own.iter().map(|(name, title)| (name.as_str(), *title)).collect();
        Wanted::new(name, title, caption, "distance", &own)
    };
    vec![
        wheels(
            "wheel_loads",
            "Vertical wheel forces, leading axles",
            "Vertical force on the rail, filtered where the run filters.",
            "vertical",
        ),
        wheels(
            "lateral_forces",
            "Lateral wheel forces, leading axles",
            "Lateral force on the rail, positive where it spreads the gauge, filtered where the run filters.",
            "lateral",
        ),
        wheels(
            "l_over_v",
            "L/V, leading axles",
            "Lateral over vertical force, filtered where the run filters.",
            "l_over_v",
        ),
        Wanted::new(
            "car_body",
            "Car body",
            "Roll against the track, accelerations at the front truck center, speed.",
            "distance",
            &[
                ("body_roll", "(a) roll"),
                ("body_at_truck_1_lateral_acceleration", "(b) lateral acceleration"),
                (
                    "body_at_truck_1_vertical_acceleration",
                    "(c) vertical acceleration",
                ),
                ("speed", "(d) speed"),
            ],
        ),
        Wanted::new(
            "car_trucks",
            "Trucks",
            "Warp angles, and the normal force of the leading left column of each truck.",
            "distance",
            &[
                ("truck_1_warp_angle", "(a) warp, front truck"),
                ("truck_2_warp_angle", "(b) warp, rear truck"),
                ("truck_1_leading_left_column_normal", "(c) column, front truck"),
                ("truck_2_leading_left_column_normal", "(d) column, rear truck"),
            ],
        ),
        Wanted::new(
            "car_warp_loops",
            "Warp moment over warp angle",
            "Warp moment on each bolster over the warp angle of its truck.",
            "",
            &[],
        )
        .with([1, 2].map(|truck| {
            [
                format!("truck_{truck}_warp_angle"),
                format!("truck_{truck}_warp_moment"),
                ["(a) front truck", "(b) rear truck"][truck - 1].to_owned(),
            ]
        })),
    ]
}

impl Wanted {
    /// With these panels instead, as loops.
    fn with(self, panels: impl IntoIterator<Item = [String; 3]>) -> Self {
        Self {
            panels: panels.into_iter().collect(),
            loops: true,
            ..self
        }
    }
}

fn of_half_truck<'w>(wedges: impl Iterator<Item = &'w str>) -> Vec<Wanted> {
    let numbers: Vec<&str> = wedges.collect();
    let panels = |x: &dyn Fn(&str) -> String, what: &str| -> Vec<[String; 3]> {
        let of = |number: &&str| {
            [
                x(number),
                format!("wedge_{number}_{what}"),
                format!("wedge {number}"),
            ]
        };
        numbers.iter().map(of).collect()
    };
    let stroke = |number: &str| format!("wedge_{number}_stroke");
    let named = |name: &str, title: &str, caption: &str, panels: Vec<[String; 3]>, loops: bool| Wanted {
        panels,
        loops,
        ..Wanted::new(name, title, caption, "", &[])
    };
    vec![
        named(
            "half_truck_loops",
            "Column friction over stroke",
            "Friction of each column on the side frame, positive up, over the vertical stroke of the bolster \
             against the side frame.",
            panels(&stroke, "column_friction"),
            true,
        ),
        named(
            "half_truck_normals",
            "Normal forces of the columns",
            "Normal force of each wedge at its column.",
            panels(&|_| "time".to_owned(), "column_normal_force"),
            false,
        ),
    ]
}

fn of_wheelset() -> Vec<Wanted> {
    let columns = [
        ("lateral", "(a) lateral"),
        ("yaw", "(b) yaw"),
        ("left_vertical", "(c) left wheel, vertical force"),
        ("right_vertical", "(d) right wheel, vertical force"),
    ];
    vec![Wanted::new(
        "wheelset",
        "Wheelset over distance",
        "Place and yaw of the wheelset on the track, and its wheel forces.",
        "distance",
        &columns,
    )]
}
