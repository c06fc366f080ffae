//! A run's columns for the plots and the scene.

use std::collections::BTreeMap;

use mechanics::output::Column;
use serde::Serialize;
use wedge::outputs::{CORNERS, FACES};

use super::data::Data;
use super::kind_name;
use super::scene::{self, Scene};
use crate::figures::Outcome;

/// A run.
#[derive(Clone, Debug, Serialize)]
pub struct RunView {
    /// Its name.
    pub name: String,
    /// What it is, in one line.
    pub title: String,
    /// The output times: a place in `data`.
    pub time: usize,
    /// Its columns by name (without unit).
    pub columns: BTreeMap<String, ViewColumn>,
    /// Columns that belong in one plot; the first ones are shown first.
    pub plots: Vec<Plot>,
    /// What it looks like; missing if it cannot be built.
    pub scene: Option<Scene>,
}

/// A column.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ViewColumn {
    /// What it is, in a few words.
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

impl RunView {
    /// The run's columns, plots and scene.
    #[must_use]
    pub fn new((case, result): &Outcome, data: &mut Data) -> Self {
        let scene = scene::stand_alone(&case.parameters, result);
        let plots = plots();
        let mut columns = BTreeMap::new();
        let named = plots.iter().flat_map(|plot| &plot.curves).map(|(name, _)| name);
        let seen = scene.iter().flat_map(Scene::columns);
        for name in named.chain(seen) {
            if columns.contains_key(name) {
                continue;
            }
            let found = result.columns.iter().position(|column| column.name == *name);
            if let Some(index) = found {
                let column = column(&result.columns[index], &result.values[index], data);
                columns.insert(name.clone(), column);
            }
        }
        Self {
            name: case.name.clone(),
            title: case.title.clone(),
            time: data.keep(result.column("time").unwrap_or_default().iter().copied()),
            columns,
            plots,
            scene,
        }
    }
}

fn column(column: &Column, values: &[f64], data: &mut Data) -> ViewColumn {
    let first = values.first().copied().unwrap_or(0.0);
    let constant = values.iter().all(|value| *value == first);
    ViewColumn {
        text: column.text.clone(),
        quantity: kind_name(column.kind),
        data: (!constant).then(|| data.keep(values.iter().copied())),
        value: constant.then_some(first),
    }
}

fn plots() -> Vec<Plot> {
    let plot = |title: &str, curves: &[(&str, &str)]| Plot {
        title: title.to_owned(),
        curves: curves
            .iter()
            .map(|(name, label)| ((*name).to_owned(), (*label).to_owned()))
            .collect(),
    };
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
