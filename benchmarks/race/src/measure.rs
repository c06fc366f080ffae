//! Quantities of the states of a run, computed by one program for all solvers, and the differences of two
//! runs.

use study::metrics::{Cycle, mean};
use wedge::outputs::Outputs;

use crate::equations::Equations;
use crate::problem::{Judged, RaceProblem};

/// The quantities by which a run is judged, SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Quantities {
    /// Time series: vertical and longitudinal wedge force, or the position.
    Series(Vec<Vec<f64>>),
    /// Mean vertical wedge force of the upward and the downward branch, N, and friction energy per cycle at
    /// the side frame, J.
    Means([f64; 3]),
}

/// Observes the states of a problem.
pub struct Judge {
    problem: RaceProblem,
    equations: Equations,
    outputs: Option<(Outputs, [usize; 4])>,
}

impl Judge {
    /// For the problem of this name.
    ///
    /// # Errors
    /// There is no such problem.
    pub fn new(name: &str) -> Result<Self, String> {
        let problem = RaceProblem::named(name).map_err(|error| error.to_string())?;
        let equations = Equations::new(problem.system.clone(), &problem.start);
        let outputs = problem
            .parameters
            .as_ref()
            .map(|parameters| {
                let outputs = Outputs::new(parameters);
                let place = |name: &str| {
                    let mut columns = outputs.columns().iter();
                    columns
                        .position(|column| column.name == name)
                        .ok_or_else(|| format!("the results have no column {name}"))
                };
                let places = [
                    place("vertical_wedge_force")?,
                    place("longitudinal_wedge_force")?,
                    place("bolster_vertical")?,
                    place("bolster_vertical_rate")?,
                ];
                Ok::<_, String>((outputs, places))
            })
            .transpose()?;
        Ok(Self {
            problem,
            equations,
            outputs,
        })
    }

    /// Returns the problem.
    #[must_use]
    pub fn problem(&self) -> &RaceProblem {
        &self.problem
    }

    /// Returns the quantities of the states of the first rows; none if means are asked of a part of the run.
    #[must_use]
    pub fn quantities(&mut self, states: &[f64], rows: usize) -> Option<Quantities> {
        let n = self.equations.dimension();
        let rows = rows.min(states.len() / n);
        let Some((outputs, places)) = &self.outputs else {
            let position = states.chunks_exact(n).take(rows).map(|z| z[0]).collect();
            return Some(Quantities::Series(vec![position]));
        };
        let contact_states = vec![0; self.equations.system().point_count()];
        let mut columns = vec![Vec::with_capacity(rows); places.len()];
        let mut values = Vec::new();
        for (row, z) in states.chunks_exact(n).take(rows).enumerate() {
            let x = self.equations.complete(z);
            let observation = self.equations.system().observe(self.problem.time(row), &x);
            values.clear();
            outputs.values(
                self.equations.system(),
                &observation,
                &contact_states,
                0.0,
                &mut values,
            );
            for (column, place) in columns.iter_mut().zip(places) {
                column.push(values[*place]);
            }
        }
        if self.problem.judged != Judged::Means || rows < self.problem.rows() {
            columns.truncate(2);
            return (self.problem.judged == Judged::Series || rows < self.problem.rows())
                .then_some(Quantities::Series(columns));
        }
        let parameters = self.problem.parameters.as_ref()?;
        let cycle = Cycle::of(parameters)?;
        let mut branches = [Vec::new(), Vec::new()];
        for row in 0..rows {
            let (position, speed) = (columns[2][row], columns[3][row]);
            if let Some(up) = cycle.branch(parameters.damping, self.problem.time(row), position, speed) {
                branches[usize::from(up)].push(row);
            }
        }
        let (start, end, cycles) = cycle.window(self.problem.duration)?;
        let loss = |time: f64| {
            let place = time / self.problem.interval;
            let row = (place.floor() as usize).min(rows - 2);
            let value = |row: usize| states[row * n + n - 1];
            // Straight between rows, 0.01 s apart, for every solver alike.
            value(row) + (place - row as f64) * (value(row + 1) - value(row))
        };
        Some(Quantities::Means([
            mean(&columns[0], &branches[1])?,
            mean(&columns[0], &branches[0])?,
            (loss(end) - loss(start)) / f64::from(cycles),
        ]))
    }
}

impl Quantities {
    /// Returns the error of these quantities, relative to those of a reference.
    ///
    /// Series: root mean square of the difference over that of the reference, the greatest of the series.
    /// Means: the greatest of the differences of the branch means over the larger branch mean, and of the
    /// energies over the energy. Infinite if they cannot be compared.
    #[must_use]
    pub fn error(&self, reference: &Self) -> f64 {
        match (self, reference) {
            (Self::Series(found), Self::Series(exact)) => {
                let each = found.iter().zip(exact).map(|(found, exact)| {
                    if found.len() > exact.len() || found.is_empty() {
                        return f64::INFINITY;
                    }
                    let square = |sum: f64, value: f64| sum + value * value;
                    let difference = found.iter().zip(exact).map(|(a, b)| a - b).fold(0.0, square);
                    let size = exact[..found.len()].iter().copied().fold(0.0, square);
                    // A wedge that hangs free has no force at all.
                    if size == 0.0 && difference == 0.0 {
                        return 0.0;
                    }
                    (difference / size).sqrt()
                });
                each.fold(0.0, worse)
            }
            (Self::Means(found), Self::Means(exact)) => {
                let branch = exact[0].abs().max(exact[1].abs());
                let scales = [branch, branch, exact[2].abs()];
                let each = (0..3).map(|k| (found[k] - exact[k]).abs() / scales[k]);
                each.fold(0.0, worse)
            }
            _ => f64::INFINITY,
        }
    }
}

/// Returns the greater of two errors; what is not a number is infinite.
fn worse(a: f64, b: f64) -> f64 {
    if b.is_finite() { a.max(b) } else { f64::INFINITY }
}
