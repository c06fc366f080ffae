//! A run's columns for the plots and the scene.

use std::collections::{BTreeMap, BTreeSet};

use mechanics::output::Column;
use serde::Serialize;
use study::car::CarCase;
use study::car::mode_shape::ModeRecording;
use study::car::motions::MotionTable;
use study::car::run::CarResult;
use study::contacts::ContactTable;
use study::half_truck::{HalfTruckCase, HalfTruckResult};
use study::truck::run::TruckResult;
use study::truck::{TruckCase, WEDGE_NAMES};
use wedge::outputs::{CORNERS, FACES};

use super::data::{Data, Precision};
use super::scene::Scene;
use super::stand_alone;
use super::{car, half_truck, kind_name, mode_shape, truck};
use crate::figures::CaseOutcome;
use crate::overlay::moves;

/// The most rows of a thinned run.
const ROWS: usize = 1251;

/// A run.
#[derive(Clone, Debug, Serialize)]
pub struct RunView {
    /// Its name.
    pub name: String,
    /// The description, one line.
    pub title: String,
    /// The output times: a place in `data`.
    pub time: usize,
    /// Its columns by name (without unit).
    pub columns: BTreeMap<String, ViewColumn>,
    /// Columns that belong in one plot; the first ones are shown first.
    pub plots: Vec<Plot>,
    /// Loops: one column over another, the first one shown first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub loops: Vec<Loop>,
    /// The view of it; missing if it cannot be built.
    pub scene: Option<Scene>,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewColumn {
    /// The description, a few words; left out of thinned runs.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub text: String,
    /// Its kind, a key of `quantities`.
    pub quantity: String,
    /// Its values at the output times: a place in `data`; missing if they are all equal to `value`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<usize>,
    /// The only value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
}

/// Columns in one plot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Plot {
    /// Its title.
    pub title: String,
    /// Columns with the names of their curves.
    pub curves: Vec<(String, String)>,
}

/// Loops in one plot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Loop {
    /// Its title.
    pub title: String,
    /// Columns along both axes, with the names of the curves.
    pub curves: Vec<[String; 3]>,
}

/// The detail of a run that is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Every row, to seven digits.
    Full,
    /// Every row, or every n-th one so that there are at most 1251; rounded to half of 1/2¹⁴ of each column's
    /// largest value or less.
    Thinned,
}

/// A run's view with its lists: made as soon as the run is over, so that its table need not be kept.
#[derive(Clone, Debug)]
pub struct Recording {
    view: RunView,
    data: Data,
}

/// A table: descriptions of columns with their values, SI.
pub(super) type Table<'t> = Vec<(&'t Column, &'t [f64])>;

impl Recording {
    /// Makes the view of a stand-alone wedge.
    #[must_use]
    pub fn of_wedge((case, result): &CaseOutcome, detail: Detail) -> Self {
        let table = table(&result.columns, &result.values);
        let scene = stand_alone::scene(&case.parameters, result);
        Self::new((&case.name, &case.title), &table, plots(), scene, detail)
    }

    /// Makes the view of a three-piece truck, with the corners of its wedges if the run took them along.
    #[must_use]
    pub fn of_three_piece_truck(
        case: &TruckCase,
        result: &TruckResult,
        contacts: Option<&ContactTable>,
        detail: Detail,
    ) -> Self {
        let mut all = table(&result.columns, &result.values);
        let mut scene = truck::scene(case);
        match (contacts, &mut scene) {
            (Some(contacts), _) => all.extend(table(&contacts.columns, &contacts.values)),
            (None, Some(scene)) => scene.clear_contacts(),
            (None, None) => {}
        }
        let plots = truck::plots(result);
        Self::new((&case.name, &case.title), &all, plots, scene, detail)
    }

    /// Makes the view of a car on track, with the motions of its bodies if the run took them along; without
    /// them it has no scene.
    #[must_use]
    pub fn of_car(case: &CarCase, result: &CarResult, motions: Option<&MotionTable>, detail: Detail) -> Self {
        let mut all = table(&result.columns, &result.values);
        all.extend(motions.iter().flat_map(|own| table(&own.columns, &own.values)));
        let scene = motions.and_then(|_| car::scene(case, result));
        Self::new((&case.name, &case.title), &all, car::plots(result), scene, detail)
    }

    /// Makes the view of a motion about a car's steady running, exaggerated by a factor at first.
    #[must_use]
    pub fn of_mode_shape(own: &ModeRecording, factor: f64) -> Self {
        let (columns, values) = mode_shape::at_rest(own);
        let mut all = table(&own.result.columns, &own.result.values);
        all.extend(table(&columns, &values));
        let (scene, plots) = (mode_shape::scene(own, factor), mode_shape::plots(own));
        let named = (own.case.name.as_str(), own.case.title.as_str());
        Self::new(named, &all, plots, scene, Detail::Full)
    }

    /// Makes the view of a half-truck, with the corners of its wedges if they are bodies and the run took
    /// them along.
    #[must_use]
    pub fn of_truck(
        case: &HalfTruckCase,
        result: &HalfTruckResult,
        contacts: Option<&ContactTable>,
        detail: Detail,
    ) -> Self {
        let (columns, values) = half_truck::drawn(case, result);
        let mut all = table(&result.columns, &result.values);
        all.extend(table(&columns, &values));
        let mut scene = half_truck::scene(case);
        match (contacts, &mut scene) {
            (Some(contacts), _) => all.extend(table(&contacts.columns, &contacts.values)),
            // Corners have no columns then.
            (None, Some(scene)) if !case.wedge_bodies.is_empty() => scene.clear_contacts(),
            (None, _) => {}
        }
        let plots = half_truck::plots(case, result);
        Self::new((&case.name, &case.title), &all, plots, scene, detail)
    }

    /// Makes a view from a table with its plots and its scene.
    pub(super) fn new(
        (name, title): (&str, &str),
        table: &Table<'_>,
        plots: Vec<Plot>,
        mut scene: Option<Scene>,
        detail: Detail,
    ) -> Self {
        let mut data = Data::default();
        let find = |name: &str| table.iter().find(|(column, _)| column.name == name).copied();
        let times = find("time").map_or(&[][..], |(_, values)| values);
        let (stride, precision) = match detail {
            Detail::Full => (1, Precision::Exact),
            Detail::Thinned => (
                times.len().saturating_sub(1).div_ceil(ROWS - 1).max(1),
                Precision::Rounded,
            ),
        };
        let rows = |values: &[f64]| -> Vec<f64> { values.iter().step_by(stride).copied().collect() };
        let mut columns = BTreeMap::new();
        let has = |name: &str| find(name).is_some_and(|(own, values)| moves(own.kind, values));
        let loops = loops(plots.iter().flat_map(|plot| &plot.curves), has);
        let of_loops = loops.iter().flat_map(|own| &own.curves);
        let of_loops = of_loops.flat_map(|[x, y, _]| [x, y]);
        let named = plots.iter().flat_map(|plot| &plot.curves).map(|(name, _)| name);
        let named = named.chain(of_loops);
        let seen = scene.iter().flat_map(Scene::columns);
        let exact: BTreeSet<&String> = scene.iter().flat_map(Scene::exact_columns).collect();
        for name in named.chain(seen) {
            if columns.contains_key(name) {
                continue;
            }
            let precision = if exact.contains(name) {
                Precision::Exact
            } else {
                precision
            };
            if let Some((own, values)) = find(name) {
                columns.insert(name.clone(), column(own, &rows(values), precision, &mut data));
            }
        }
        drop(exact);
        for track in scene.iter_mut().filter_map(|scene| scene.track.as_mut()) {
            for (name, values) in std::mem::take(&mut track.lists) {
                track.samples.insert(name, data.keep(&values, Precision::Exact));
            }
        }
        let view = RunView {
            name: name.to_owned(),
            title: title.to_owned(),
            // Times are exact: rows are found by them.
            time: data.keep(&rows(times), Precision::Exact),
            columns,
            plots,
            loops,
            scene,
        };
        Self { view, data }
    }

    /// Returns the same under another name.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.view.name);
        self
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.view.name
    }

    /// Returns its title.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.view.title
    }

    /// Returns whether it has a 3D view.
    #[must_use]
    pub fn has_scene(&self) -> bool {
        self.view.scene.is_some()
    }

    /// Returns the view, its lists put to the others.
    pub(super) fn into_view(self, data: &mut Data) -> RunView {
        let Self { mut view, data: own } = self;
        let places = data.absorb(own);
        view.time = places[view.time];
        for column in view.columns.values_mut() {
            column.data = column.data.map(|place| places[place]);
        }
        for track in view.scene.iter_mut().filter_map(|scene| scene.track.as_mut()) {
            for place in track.samples.values_mut() {
                *place = places[*place];
            }
        }
        view
    }
}

/// Returns the columns of a table with their values.
pub(super) fn table<'t>(columns: &'t [Column], values: &'t [Vec<f64>]) -> Table<'t> {
    let values = values.iter().map(Vec::as_slice);
    columns.iter().zip(values).collect()
}

/// Returns the loops that a run has: of pairs of columns that hold force over travel or moment over angle, of
/// all models, those that both move. `plotted` are the columns of its plots, which tell the names of wedges.
fn loops<'p>(plotted: impl Iterator<Item = &'p (String, String)>, moves: impl Fn(&str) -> bool) -> Vec<Loop> {
    let made = |title: &str, curves: Vec<[&str; 3]>| Loop {
        title: title.to_owned(),
        curves: curves
            .into_iter()
            .filter(|[x, y, _]| moves(x) && moves(y))
            .map(|own| own.map(str::to_owned))
            .collect(),
    };
    let strokes: Vec<Loop> = plotted
        .filter_map(|(name, label)| {
            let stem = name.strip_suffix("_column_friction")?;
            let [x, y] = ["stroke", "column_friction"].map(|what| format!("{stem}_{what}"));
            let own = made("", vec![[&x, &y, label]]);
            (!own.curves.is_empty()).then_some(own)
        })
        .collect();
    let strokes = Loop {
        title: "Column friction over stroke".to_owned(),
        curves: strokes.into_iter().flat_map(|own| own.curves).collect(),
    };
    let friction = |side: &str| {
        ["leading", "trailing"]
            .map(|end| (format!("{end}_{side}_column_friction_z"), format!("{end} {side}")))
    };
    let wedges: Vec<(String, String)> = ["left", "right"].into_iter().flat_map(friction).collect();
    let wedges = wedges.iter().map(|(name, label)| ["bolster_z", name, label]);
    let in_car = |truck: usize| {
        let of = |wedge: &str| {
            let stem = format!("truck_{truck}_{wedge}");
            [
                format!("{stem}_z"),
                format!("{stem}_column_friction_z"),
                wedge.replace('_', " "),
            ]
        };
        WEDGE_NAMES.map(of)
    };
    let cars = [1, 2].map(in_car);
    let rise = |truck: usize| {
        cars[truck]
            .each_ref()
            .map(|own| own.each_ref().map(String::as_str))
    };
    let mut loops = vec![
        made(
            "Vertical wedge force over travel",
            vec![["bolster_vertical", "vertical_wedge_force", "wedge"]],
        ),
        made(
            "Nest loads over travel",
            vec![
                ["bolster_z", "left_nest_vertical_force", "left"],
                ["bolster_z", "right_nest_vertical_force", "right"],
            ],
        ),
        made("Column friction over travel", wedges.collect()),
        made(
            "Warp moment over warp angle",
            vec![
                ["warp_angle", "warp_moment", "truck"],
                ["truck_1_warp_angle", "truck_1_warp_moment", "front truck"],
                ["truck_2_warp_angle", "truck_2_warp_moment", "rear truck"],
            ],
        ),
        strokes,
        made(
            "Column friction over the wedge's rise, front truck",
            rise(0).to_vec(),
        ),
        made(
            "Column friction over the wedge's rise, rear truck",
            rise(1).to_vec(),
        ),
    ];
    loops.retain(|own| !own.curves.is_empty());
    loops
}

fn column(column: &Column, values: &[f64], precision: Precision, data: &mut Data) -> ViewColumn {
    let first = values.first().copied().unwrap_or(0.0);
    let constant = values.iter().all(|value| *value == first);
    ViewColumn {
        text: match precision {
            Precision::Exact => column.text.clone(),
            Precision::Rounded => String::new(),
        },
        quantity: kind_name(column.kind),
        data: (!constant).then(|| data.keep(values, precision)),
        value: constant.then_some(first),
    }
}

impl Plot {
    /// Makes the axes of these columns with the names of their curves.
    pub(super) fn new<'p>(title: &str, curves: impl IntoIterator<Item = (&'p str, &'p str)>) -> Self {
        Self {
            title: title.to_owned(),
            curves: curves
                .into_iter()
                .map(|(name, label)| (name.to_owned(), label.to_owned()))
                .collect(),
        }
    }
}

fn plots() -> Vec<Plot> {
    let plot = |title: &str, curves: &[(&str, &str)]| Plot::new(title, curves.iter().copied());
    let mut plots = vec![
        plot(
            "Vertical force",
            &[
                ("vertical_wedge_force", "column friction on the side frame"),
                (
                    "vertical_force_on_side_frame",
                    "with the coil, where it stands there",
                ),
            ],
        ),
        plot(
            "Longitudinal force",
            &[("longitudinal_wedge_force", "normal forces of the column")],
        ),
        plot(
            "Moments of the side frame on the wedge",
            &[
                ("side_frame_roll_moment", "roll"),
                ("side_frame_pitch_moment", "pitch"),
                ("side_frame_yaw_moment", "yaw"),
            ],
        ),
    ];
    for (what, title) in [
        ("normal_force", "normal forces at the corners"),
        ("gap", "gaps at the corners"),
    ] {
        for face in FACES {
            plots.push(Plot {
                title: format!("{}: {title}", crate::figures::capital(face)),
                curves: CORNERS
                    .iter()
                    .map(|corner| (format!("{face}_{corner}_{what}"), corner.replace('_', " ")))
                    .collect(),
            });
        }
    }
    plots.extend([
        plot(
            "Moments of the bolster on the wedge",
            &[
                ("bolster_roll_moment", "roll"),
                ("bolster_pitch_moment", "pitch"),
                ("bolster_yaw_moment", "yaw"),
            ],
        ),
        plot(
            "Travel",
            &[("bolster_vertical", "bolster"), ("wedge_z", "wedge, vertical")],
        ),
        plot("Wedge, longitudinal", &[("wedge_x", "longitudinal")]),
        plot("Wedge, angles", &[("wedge_pitch", "pitch"), ("wedge_yaw", "yaw")]),
        plot("Coil force", &[("coil_force", "spring force")]),
        plot("Coil length", &[("coil_length", "length")]),
        plot(
            "Friction losses",
            &[
                ("side_frame_dissipation", "at the side frame"),
                ("bolster_dissipation", "at the bolster"),
            ],
        ),
    ]);
    plots
}
