//! The report of a solver on one run: the line of JSON that every driver prints, and the file of its states.

use std::io::{self, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

/// The output of a driver.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// CPU time of the integration, s: the least of the repetitions. Without starting the program, without
    /// files.
    pub cpu: f64,
    /// Wall time of the same repetition, s.
    pub wall: f64,
    /// The number of its runs.
    pub repeats: u32,
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried in vain, for any reason.
    pub rejected: u64,
    /// Evaluations of the right-hand side.
    pub derivatives: u64,
    /// Evaluations of the Jacobian matrix.
    pub jacobians: u64,
    /// Factorizations; 0 where the solver does not tell.
    pub factorizations: u64,
    /// Rows reached, the start included.
    pub rows: usize,
    /// The reason if it did not come to the end, else empty.
    pub failure: String,
}

impl Outcome {
    /// Returns the mean of times and counts over this run and others of the same solver.
    #[must_use]
    pub fn mean_with(&self, others: &[&Self]) -> Self {
        let number = others.len() as u64 + 1;
        let time =
            |of: fn(&Self) -> f64| (of(self) + others.iter().map(|one| of(one)).sum::<f64>()) / number as f64;
        let count = |of: fn(&Self) -> u64| {
            let sum = of(self) + others.iter().map(|one| of(one)).sum::<u64>();
            (sum + number / 2) / number
        };
        Self {
            cpu: time(|one| one.cpu),
            wall: time(|one| one.wall),
            repeats: self.repeats,
            steps: count(|one| one.steps),
            rejected: count(|one| one.rejected),
            derivatives: count(|one| one.derivatives),
            jacobians: count(|one| one.jacobians),
            factorizations: count(|one| one.factorizations),
            rows: self.rows,
            failure: self.failure.clone(),
        }
    }
}

/// Repeats short runs, and keeps the quickest.
///
/// # Errors
/// The message of a run that cannot be set up.
pub fn repeated(
    mut run: impl FnMut() -> Result<(Outcome, Vec<f64>), String>,
) -> Result<(Outcome, Vec<f64>), String> {
    let (mut best, mut states) = run()?;
    let (mut spent, mut repeats) = (best.cpu, 1);
    while best.failure.is_empty() && spent < 0.5 && repeats < 5 {
        let (outcome, again) = run()?;
        spent += outcome.cpu;
        repeats += 1;
        if outcome.cpu < best.cpu {
            (best, states) = (outcome, again);
        }
    }
    best.repeats = repeats;
    Ok((best, states))
}

/// Writes states as the drivers in other languages do: numbers of 8 bytes, row by row.
///
/// # Errors
/// The file cannot be written.
pub fn write_states(file: &Path, states: &[f64]) -> io::Result<()> {
    let mut file = io::BufWriter::new(std::fs::File::create(file)?);
    for value in states {
        file.write_all(&value.to_ne_bytes())?;
    }
    file.flush()
}

/// Reads states.
///
/// # Errors
/// The file cannot be read.
pub fn read_states(file: &Path) -> io::Result<Vec<f64>> {
    let bytes = std::fs::read(file)?;
    let (numbers, _) = bytes.as_chunks::<8>();
    Ok(numbers.iter().map(|number| f64::from_ne_bytes(*number)).collect())
}
