//! Contact at each corner, or each point of a grid, of the wedges that are bodies in a run: taken along only
//! where it is asked for, since a table of all corners has twice as many columns as the result.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use mechanics::contact::ContactPoint;
use mechanics::output::Column;
use mechanics::system::{ContactState, Observation, System};
use quantity::Kind;
use wedge::face::Grid;
use wedge::outputs::CORNERS;

use crate::run::{Recorder, Run, RunCase, RunError};

/// Returns of each face how many of its points are open, stick and slip.
pub(crate) fn in_words(system: &System, contact_states: &[u8]) -> BTreeMap<String, String> {
    let mut states = contact_states
        .iter()
        .map(|state| ContactState::from_number(*state));
    let faces = system.faces().iter();
    faces
        .map(|mounted| {
            let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
            for state in states.by_ref().take(mounted.element.points.len()) {
                *counts.entry(state.name()).or_default() += 1;
            }
            let words: Vec<String> = counts
                .iter()
                .map(|(name, count)| format!("{count} {name}"))
                .collect();
            (mounted.element.name.clone(), words.join(", "))
        })
        .collect()
}

/// A corner of a wedge at a face, or another point of its grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Its name, as in columns: `leading_left_column_lower_right`, `leading_left_slope_point_3_2`. Left and
    /// right are those of the truck.
    pub name: String,
    /// The number of the face among those of the system.
    pub face: usize,
    /// The number of its point there.
    pub point: usize,
    /// The place of the point among all contact points.
    pub(crate) place: usize,
    /// Its share of the face, if the face has more points than its corners.
    weight: Option<f64>,
}

/// The corners of a run, row by row as the result has them; SI.
#[derive(Clone, Debug)]
pub struct ContactTable {
    /// The columns: of each corner `gap`, `normal_force`, `friction_force_x` to `_z` and `state`, of
    /// points of a grid `pressure` too.
    pub columns: Vec<Column>,
    /// Their values, one vector a column.
    pub values: Vec<Vec<f64>>,
    corners: Vec<Corner>,
    /// The part of the face that each point of a grid stands for, m².
    areas: Vec<Option<f64>>,
}

/// The corners of the inner side of a half of a split wedge.
const SPLIT: [&str; 3] = ["lower_column", "lower_toe", "upper"];

/// A recorder that can take the corners of wedges along.
pub trait TakesCorners: Recorder {
    /// Returns the numbers of the wedges' bodies.
    fn wedges(&self) -> Vec<usize>;
    /// Returns the areas of column and slope of each, m²; empty: their faces have four corners alone.
    fn face_areas(&self) -> Vec<[f64; 2]> {
        Vec::new()
    }
    /// Returns the table that they are taken into, if it is wanted.
    fn corners(&mut self) -> &mut Option<ContactTable>;
}

/// Returns the corners and other points of all faces of the bodies with these numbers.
#[must_use]
pub fn corners(system: &System, wedges: &[usize]) -> Vec<Corner> {
    let mut all = Vec::new();
    let mut place = 0;
    for (number, mounted) in system.faces().iter().enumerate() {
        let points = &mounted.element.points;
        if wedges.contains(&mounted.body) {
            let name = &mounted.element.name;
            let own = match points.len() {
                3 => SPLIT.map(|point| (point.to_owned(), None)).to_vec(),
                _ => point_names(points),
            };
            let own = own.into_iter().enumerate();
            all.extend(own.map(|(i, (point, weight))| Corner {
                name: format!("{name}_{point}"),
                face: number,
                point: i,
                place: place + i,
                weight,
            }));
        }
        place += points.len();
    }
    all
}

/// Returns the names of the points of a wedge's face, left and right as in the truck, and what share of the
/// face the points of a grid have.
fn point_names(points: &[ContactPoint]) -> Vec<(String, Option<f64>)> {
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|point| point.position.0[k]).sum::<f64>() / count;
    let middle = [mean(1), mean(2)];
    let mut lateral: Vec<f64> = points.iter().map(|point| point.position.0[1]).collect();
    let turned = lateral[0] > lateral[1];
    lateral.sort_by(f64::total_cmp);
    lateral.dedup();
    let across = lateral.len();
    let grid = Grid {
        up: points.len() / across,
        across,
    };
    let places = grid.points();
    let name = |i: usize, point: &ContactPoint| {
        let [_, y, z] = point.position.0;
        if i < CORNERS.len() {
            let height = if z < middle[1] { "lower" } else { "upper" };
            let side = if y > middle[0] { "left" } else { "right" };
            return format!("{height}_{side}");
        }
        let mut place = places[i];
        if turned {
            place.column = across - 1 - place.column;
        }
        place.number()
    };
    let weight = |i: usize| (grid != Grid::default()).then(|| places[i].weight);
    points
        .iter()
        .enumerate()
        .map(|(i, point)| (name(i, point), weight(i)))
        .collect()
}

impl ContactTable {
    /// Returns an empty table.
    fn new(system: &System, wedges: &[usize], areas: &[[f64; 2]]) -> Self {
        let corners = corners(system, wedges);
        let area = |corner: &Corner| {
            let mounted = &system.faces()[corner.face];
            let place = wedges.iter().position(|wedge| *wedge == mounted.body)?;
            let [column, slope] = areas.get(place)?;
            let face = if mounted.element.name.ends_with("column") {
                column
            } else {
                slope
            };
            Some(face * corner.weight?)
        };
        let areas: Vec<Option<f64>> = corners.iter().map(area).collect();
        let mut columns = Vec::new();
        for (corner, area) in corners.iter().zip(&areas) {
            let mut add = |what: &str, kind: Kind, text: &str| {
                columns.push(Column {
                    name: format!("{}_{what}", corner.name),
                    kind,
                    frame: "x forward, y left, z up".into(),
                    reference: "".into(),
                    text: text.to_owned(),
                });
            };
            add(
                "gap",
                Kind::Length,
                "distance from the surface, negative in contact",
            );
            add("normal_force", Kind::Force, "normal force on the wedge");
            for axis in ["x", "y", "z"] {
                let name = format!("friction_force_{axis}");
                add(
                    &name,
                    Kind::Force,
                    &format!("friction force on the wedge along {axis}"),
                );
            }
            add("state", Kind::Count, "0 open, 1 stick, 2 slip");
            if area.is_some() {
                let text = "normal force over the part of the face that the point stands for";
                add("pressure", Kind::Pressure, text);
            }
        }
        Self {
            values: vec![Vec::new(); columns.len()],
            columns,
            corners,
            areas,
        }
    }

    /// Appends a row.
    pub(crate) fn take(&mut self, observation: &Observation, contact_states: &[u8]) {
        let mut columns = self.values.iter_mut();
        for (corner, area) in self.corners.iter().zip(&self.areas) {
            let face = &observation.faces[corner.face];
            let point = &face.points[corner.point];
            let [x, y, z] = face.friction_forces[corner.point].0;
            let state = f64::from(contact_states[corner.place]);
            let pressure = area.map(|area| point.normal / area);
            let row = [point.gap, point.normal, x, y, z, state]
                .into_iter()
                .chain(pressure);
            for (value, column) in row.zip(columns.by_ref()) {
                column.push(value);
            }
        }
    }

    /// Returns the values (SI) of the column with this name.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.columns.iter().position(|column| column.name == name)?;
        Some(&self.values[index])
    }
}

impl<C: RunCase> Run<C>
where
    C::Recorder: TakesCorners,
{
    /// Returns a run at its start that takes the corners of its wedges along.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn with_contacts(case: &C) -> Result<Self, RunError> {
        let mut run = Self::new(case)?;
        let (wedges, areas) = (run.recorder.wedges(), run.recorder.face_areas());
        let mut table = ContactTable::new(&run.system, &wedges, &areas);
        let observation = run.system.observe(run.integrator.time(), run.integrator.x());
        table.take(&observation, run.integrator.discrete_states());
        *run.recorder.corners() = Some(table);
        Ok(run)
    }

    /// As [`Run::finish_while`], with the corners if the run takes them along.
    #[must_use]
    pub fn finish_with_contacts(
        mut self,
        progress: impl FnMut(f64) -> ControlFlow<String>,
    ) -> (C::Output, Option<ContactTable>) {
        let stopped = self.go_on_while(progress);
        let contacts = self.recorder.corners().take();
        (self.result(stopped), contacts)
    }
}
