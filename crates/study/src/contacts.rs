//! What happens at each corner of the wedges that are bodies in a run: taken along only where it is asked for, since a
//! table of all corners has twice as many columns as the result.

use std::ops::{ControlFlow, Range};

use mechanics::output::Column;
use mechanics::system::{Observation, System};
use quantity::Kind;

use crate::run::{Recorder, Run, RunCase, RunError};

/// A corner of a wedge at a face.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// Its name, as in columns: `leading_left_column_lower_right`. Left and right are those of the truck.
    pub name: String,
    /// The number of the face among those of the system.
    pub face: usize,
    /// The number of its point there.
    pub point: usize,
    /// The place of the point among all contact points.
    place: usize,
}

/// The corners of a run, row by row as the result has them; SI.
#[derive(Clone, Debug)]
pub struct ContactTable {
    /// The columns: of each corner `gap`, `normal_force`, `friction_force_x` to `_z` and `state`.
    pub columns: Vec<Column>,
    /// Their values, one vector a column.
    pub values: Vec<Vec<f64>>,
    corners: Vec<Corner>,
}

/// Columns of a corner.
const OF_CORNER: usize = 6;

/// A recorder that can take the corners of wedges along.
pub trait TakesCorners: Recorder {
    /// Returns the numbers of the wedges' bodies.
    fn wedges(&self) -> Range<usize>;
    /// Returns the table that they are taken into, if it is wanted.
    fn corners(&mut self) -> &mut Option<ContactTable>;
}

/// Returns the corners of all faces of the bodies with these numbers.
#[must_use]
pub fn corners(system: &System, wedges: Range<usize>) -> Vec<Corner> {
    let mut all = Vec::new();
    let mut place = 0;
    for (number, mounted) in system.faces().iter().enumerate() {
        let points = &mounted.element.points;
        if wedges.contains(&mounted.body) {
            let count = points.len() as f64;
            let mean = |k: usize| points.iter().map(|point| point.position.0[k]).sum::<f64>() / count;
            let middle = [mean(1), mean(2)];
            for (i, point) in points.iter().enumerate() {
                let [_, y, z] = point.position.0;
                let height = if z < middle[1] { "lower" } else { "upper" };
                let side = if y > middle[0] { "left" } else { "right" };
                all.push(Corner {
                    name: format!("{}_{height}_{side}", mounted.element.name),
                    face: number,
                    point: i,
                    place: place + i,
                });
            }
        }
        place += points.len();
    }
    all
}

impl ContactTable {
    /// Returns an empty table.
    fn new(system: &System, wedges: Range<usize>) -> Self {
        let corners = corners(system, wedges);
        let mut columns = Vec::new();
        for corner in &corners {
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
        }
        Self {
            values: vec![Vec::new(); columns.len()],
            columns,
            corners,
        }
    }

    /// Appends a row.
    pub(crate) fn take(&mut self, observation: &Observation, contact_states: &[u8]) {
        let columns = self.values.chunks_exact_mut(OF_CORNER);
        for (corner, columns) in self.corners.iter().zip(columns) {
            let face = &observation.faces[corner.face];
            let point = &face.points[corner.point];
            let [x, y, z] = face.friction_forces[corner.point].0;
            let state = f64::from(contact_states[corner.place]);
            let row: [f64; OF_CORNER] = [point.gap, point.normal, x, y, z, state];
            for (column, value) in columns.iter_mut().zip(row) {
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
        let mut table = ContactTable::new(&run.system, run.recorder.wedges());
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
