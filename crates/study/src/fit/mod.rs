//! Identification: parameters of a case whose run comes nearest to a measured course of a force.
//!
//! The measured values are compared with a column of the run at the same times (between rows linearly). The
//! sum of squared differences is made least over the free parameters between their bounds
//! ([`least_squares`]). With independent errors of one size, the intervals hold the true values with the
//! probability stated, as far as the model is straight over them; errors that hang together (a model that is
//! wrong, a sensor that drifts) make them too narrow, which [`Fit::durbin_watson`] tells.

pub mod least_squares;
pub(crate) mod student;

use input::bounded;
use quantity::Quantity;
use thiserror::Error;

use crate::case::CaseError;
use crate::design::Value;
use crate::energy;
use crate::models::AnyCase;
use crate::plausibility::{self, at_bound};
use least_squares::{Evaluate, SearchSettings, minimize};

pub use student::two_sided;

/// A parameter that is free between bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Free {
    /// Its path, as `--set` takes it.
    pub path: String,
    /// Its least value, in its unit.
    pub low: f64,
    /// Its greatest value.
    pub high: f64,
    /// Its unit as typed; empty for pure numbers.
    pub unit: String,
}

/// A text that names no free parameter.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{problem}")]
pub struct FreeError {
    /// The mistake.
    pub problem: String,
    /// The advice.
    pub advice: String,
}

impl Free {
    /// Reads `friction.column=0.2..0.6`, `control_coil.stiffness=1500 lbf/in..2500 lbf/in`.
    ///
    /// # Errors
    /// It is not of this form, or its bounds contradict each other.
    pub fn parse(text: &str) -> Result<Self, FreeError> {
        let error = |problem: String| FreeError {
            problem: bounded(problem),
            advice: "write for example --free friction.column=0.2..0.6 --free 'control_coil.stiffness=1500 \
                     lbf/in..2500 lbf/in'"
                .to_owned(),
        };
        let parts = text.split_once('=').and_then(|(path, range)| {
            let (low, high) = range.split_once("..")?;
            Some([path, low, high].map(|part| part.trim().trim_matches('"')))
        });
        let Some([path, low, high]) = parts.filter(|parts| parts.iter().all(|part| !part.is_empty())) else {
            return Err(error(format!(
                "`{text}` frees nothing: PATH=LOW..HIGH is expected"
            )));
        };
        let number = |text: &str| match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Value::Number {
                value,
                unit: String::new(),
            }),
            _ => match Value::of_text(path, text) {
                Value::Toml(_) => {
                    let why = Quantity::parse(text)
                        .err()
                        .map_or(String::new(), |why| format!(": {why}"));
                    Err(error(format!("`{path}`: {text} is no bound{why}")))
                }
                number => Ok(number),
            },
        };
        let (low, high) = (number(low)?, number(high)?);
        let Value::Number { value, unit } = &low else {
            return Err(error(format!("`{path}`: a number is expected")));
        };
        let Some(last) = high.in_unit(unit) else {
            let message = format!(
                "`{path}`: {} and {} do not measure the same",
                low.shown(),
                high.shown()
            );
            return Err(error(message));
        };
        if *value == last {
            let message = format!(
                "`{path}` is to lie between {} and {}: nothing does",
                low.shown(),
                high.shown()
            );
            return Err(error(message));
        }
        Ok(Self {
            path: path.to_owned(),
            low: value.min(last),
            high: value.max(last),
            unit: unit.clone(),
        })
    }

    /// Returns the value at a scaled parameter, in its unit.
    #[must_use]
    pub fn at(&self, scaled: f64) -> f64 {
        self.low + (self.high - self.low) * scaled
    }

    /// Returns a value as `--set` takes it.
    #[must_use]
    pub fn set(&self, value: f64) -> String {
        let unit = self.unit.clone();
        let value = Value::Number { value, unit };
        format!("{}={}", self.path, value.to_toml(&self.path))
    }
}

/// The measured data.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Times, s, increasing.
    pub times: Vec<f64>,
    /// Values, SI.
    pub values: Vec<f64>,
    /// The column of runs that they are compared with, without unit.
    pub column: String,
}

/// Reasons why nothing can be fitted.
#[derive(Debug, Error)]
pub enum FitError {
    /// The case does not go with a free parameter.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// There are fewer values than parameters.
    #[error("{values} measured values cannot determine {parameters} parameters")]
    TooFew {
        /// Values in the time compared.
        values: usize,
        /// Free parameters.
        parameters: usize,
    },
    /// The sum of squared differences overflows.
    #[error(
        "the differences between run and measured values are too large to compute with: their squares are \
         not finite"
    )]
    NotFinite,
    /// The run does not give what is to be compared.
    #[error("{0}")]
    Model(String),
}

/// A parameter found.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedParameter {
    /// The free parameter.
    pub free: Free,
    /// Its value, in its unit.
    pub value: f64,
    /// Half the confidence interval; `None` at a bound, or where the data do not determine it.
    pub half_interval: Option<f64>,
    /// True if it ends at a bound.
    pub at_bound: bool,
}

/// The findings.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters.
    pub parameters: Vec<FittedParameter>,
    /// Correlations of the parameters; `None` where the data do not determine them.
    pub correlations: Option<Vec<Vec<f64>>>,
    /// Values of the model at the measured times, SI.
    pub values: Vec<f64>,
    /// Root of the mean square of the differences, with the degrees of freedom, SI.
    pub standard_error: f64,
    /// Durbin-Watson statistic of the differences: near 2 where they are independent, near 0 where they hang
    /// together.
    pub durbin_watson: f64,
    /// Rounds.
    pub rounds: u32,
    /// True if it converged.
    pub settled: bool,
    /// The relative residual of the energy ledger of the run with the parameters found.
    pub largest_relative_residual: f64,
    /// The warnings about that ledger, about what is implausible in that run, and about parameters at a
    /// bound.
    pub warnings: Vec<String>,
    /// The reason if the fit has failed: that ledger does not close to 1e-2.
    pub failed: Option<String>,
}

/// Returns the column of a case's run at these times (between rows linearly), SI.
///
/// # Errors
/// The run cannot begin or stops, ends before the last time, or has no such column.
pub fn course(case: &AnyCase, column: &str, times: &[f64]) -> Result<Vec<f64>, String> {
    let result = case.run().map_err(|error| error.to_string())?;
    let outcome = result.summary.shared().outcome();
    if let (Some(_), Some(told)) = (outcome.end(), outcome.told()) {
        return Err(format!("the run {told}"));
    }
    let (Some(rows), Some(values)) = (result.column("time"), result.column(column)) else {
        return Err(format!("runs have no column `{column}`"));
    };
    let last = rows.last().copied().unwrap_or(0.0);
    let end = times.last().copied().unwrap_or(0.0);
    if end > last * (1.0 + 1e-9) {
        return Err(format!(
            "the run ends at {last} s, the measured values at {end} s"
        ));
    }
    let mut row = 1;
    Ok(times
        .iter()
        .map(|time| {
            while row + 1 < rows.len() && rows[row] < *time {
                row += 1;
            }
            let (from, to) = (rows[row - 1], rows[row]);
            let share = ((time - from) / (to - from)).clamp(0.0, 1.0);
            values[row - 1] + share * (values[row] - values[row - 1])
        })
        .collect())
}

/// The model of this number, of several.
pub type FitModel<'m> = &'m (dyn Fn(usize) -> Result<Vec<f64>, String> + Sync);
/// Computes so many models, side by side if it can, and gives them in order.
pub type Each<'e> = &'e dyn Fn(usize, FitModel<'_>) -> Vec<Result<Vec<f64>, String>>;

/// Finds the free parameters of a case; `case` gives it with values set, `each` computes several models at a
/// time.
///
/// # Errors
/// The case has no such parameters, or no values beside its start.
pub fn fit(
    case: &(dyn Fn(&[String]) -> Result<AnyCase, CaseError> + Sync),
    measured: &Measured,
    free: &[Free],
    confidence: f64,
    each: Each<'_>,
) -> Result<Fit, FitError> {
    if measured.values.len() <= free.len() {
        return Err(FitError::TooFew {
            values: measured.values.len(),
            parameters: free.len(),
        });
    }
    let set = |scaled: &[f64]| -> Vec<String> {
        let pairs = free.iter().zip(scaled);
        pairs.map(|(free, scaled)| free.set(free.at(*scaled))).collect()
    };
    // Both ends of each range must make a case: the message is about what was typed.
    for number in 0..free.len() {
        for end in [0.0, 1.0] {
            let mut scaled = vec![0.5; free.len()];
            scaled[number] = end;
            case(&set(&scaled))?;
        }
    }
    let evaluate = |places: &[Vec<f64>]| {
        each(places.len(), &|number| {
            let case = case(&set(&places[number])).map_err(|error| error.to_string())?;
            course(&case, &measured.column, &measured.times)
        })
    };
    let start = start(&case(&[])?, free);
    let fit = finish(&evaluate, measured, free, &start, confidence)?;
    // The one run that all the numbers are about is judged as any other.
    let values: Vec<String> = (fit.parameters.iter())
        .map(|found| found.free.set(found.value))
        .collect();
    let result = case(&values)?
        .run()
        .map_err(|error| FitError::Model(error.to_string()))?;
    let warnings = result.summary.shared().warnings();
    let of_run = energy::among(warnings).chain(plausibility::among(warnings));
    let at_bound = fit.parameters.iter().filter(|found| found.at_bound);
    Ok(Fit {
        largest_relative_residual: result.summary.shared().largest_relative_residual(),
        warnings: of_run
            .map(str::to_owned)
            .chain(at_bound.map(bound_warning))
            .collect(),
        failed: result.summary.shared().failed().map(str::to_owned),
        ..fit
    })
}

fn bound_warning(found: &FittedParameter) -> String {
    let value = Value::Number {
        value: found.value,
        unit: found.free.unit.clone(),
    };
    at_bound(&found.free.path, &value.shown())
}

/// Returns the values of the case, as far as they lie well within the bounds; the middle otherwise.
fn start(case: &AnyCase, free: &[Free]) -> Vec<f64> {
    let sections = case.fields();
    free.iter()
        .map(|free| {
            let mut fields = sections.iter().flat_map(|section| &section.fields);
            let own = fields.find(|field| field.path == free.path);
            let number = own.and_then(|field| Value::of_number(&free.path, &field.text).in_unit(&free.unit));
            let scaled = number.map(|value| (value - free.low) / (free.high - free.low));
            scaled
                .filter(|scaled| (0.05..=0.95).contains(scaled))
                .unwrap_or(0.5)
        })
        .collect()
}

/// Returns the least squares and what they say.
fn finish(
    evaluate: Evaluate<'_>,
    measured: &Measured,
    free: &[Free],
    start: &[f64],
    confidence: f64,
) -> Result<Fit, FitError> {
    let found =
        minimize(evaluate, &measured.values, start, &SearchSettings::default()).map_err(FitError::Model)?;
    if !found.sum.is_finite() {
        return Err(FitError::NotFinite);
    }
    let freedom = (measured.values.len() - free.len()).max(1) as f64;
    let width = two_sided(confidence, freedom);
    let deviation = |k: usize| {
        found
            .covariance
            .as_ref()
            .map(|covariance| covariance[k][k].sqrt())
    };
    let parameters = free.iter().enumerate().map(|(k, free)| FittedParameter {
        value: free.at(found.place[k]),
        half_interval: deviation(k)
            .filter(|_| !found.at_bound[k])
            .map(|deviation| width * deviation * (free.high - free.low)),
        at_bound: found.at_bound[k],
        free: free.clone(),
    });
    let correlations = found.covariance.as_ref().map(|covariance| {
        let entry = |i: usize, j: usize| {
            let size = (covariance[i][i] * covariance[j][j]).sqrt();
            if size > 0.0 { covariance[i][j] / size } else { 0.0 }
        };
        (0..free.len())
            .map(|i| (0..free.len()).map(|j| entry(i, j)).collect())
            .collect()
    });
    let residuals: Vec<f64> = measured
        .values
        .iter()
        .zip(&found.values)
        .map(|(a, b)| a - b)
        .collect();
    let changes: f64 = residuals.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    Ok(Fit {
        parameters: parameters.collect(),
        correlations,
        standard_error: (found.sum / freedom).sqrt(),
        durbin_watson: changes / found.sum,
        values: found.values,
        rounds: found.rounds,
        settled: found.settled,
        largest_relative_residual: 0.0,
        warnings: Vec::new(),
        failed: None,
    })
}
