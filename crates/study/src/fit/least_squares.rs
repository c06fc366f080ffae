//! Nonlinear least squares between bounds: the method of Levenberg (1944) and Marquardt (1963) with a
//! projection onto the bounds.
//!
//! Parameters are scaled to their ranges, so that 0 and 1 are the bounds. Derivatives are central differences
//! (one-sided at a bound), because the model is a simulation; over the parameters' standard deviations in the
//! end, because simulations with contacts are jagged in the small. A parameter that stands at a bound and
//! would leave it is held in that round; one that ends there has no interval.

/// Values of a model at many points, for several sets of scaled parameters at a time; why it has none.
pub type Evaluate<'e> = &'e dyn Fn(&[Vec<f64>]) -> Vec<Result<Vec<f64>, String>>;

/// Settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchSettings {
    /// Half the distance of central differences, of the range, at first; later it is the parameter's own
    /// standard deviation, if that is more.
    pub difference: f64,
    /// Rounds at most, with differences of one distance.
    pub most_rounds: u32,
    /// It ends where no parameter moves by more than this part of its range.
    pub least_move: f64,
}

impl Default for SearchSettings {
    fn default() -> Self {
        Self {
            difference: 2e-3,
            most_rounds: 50,
            least_move: 1e-5,
        }
    }
}

/// The findings.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// Scaled parameters.
    pub place: Vec<f64>,
    /// Values of the model there.
    pub values: Vec<f64>,
    /// Sum of squared residuals.
    pub sum: f64,
    /// True for each parameter that ends at a bound.
    pub at_bound: Vec<bool>,
    /// Covariance of the scaled parameters, row by row: s² (JᵀJ)⁻¹ of those that are at no bound, zero for
    /// others; `None` where the data do not determine them.
    pub covariance: Option<Vec<Vec<f64>>>,
    /// Rounds.
    pub rounds: u32,
    /// True if it converged within the rounds allowed.
    pub settled: bool,
}

/// Finds the parameters between 0 and 1 whose values are nearest to the data.
///
/// # Errors
/// The model has no values at the start or beside it, or they are not finite.
pub fn minimize(
    evaluate: Evaluate<'_>,
    data: &[f64],
    start: &[f64],
    settings: &SearchSettings,
) -> Result<Minimum, String> {
    let count = start.len();
    let place = start.to_vec();
    let values = first(evaluate(std::slice::from_ref(&place)))?;
    let distances = vec![settings.difference; count];
    let mut state = State {
        sum: squares(data, &values)?,
        slopes: jacobian(evaluate, &place, &distances)?,
        place,
        values,
        distances,
        rounds: 0,
    };
    let mut settled = state.descend(evaluate, data, settings)?;
    // Runs are jagged in the small: events come and go. What counts is how they change over the parameters'
    // own uncertainty, so once that is known, differences are taken over it, and the search goes on with
    // them.
    for _ in 0..WIDENINGS {
        let Some(covariance) = state.covariance(data.len()) else {
            break;
        };
        let before = state.sum;
        for (k, distance) in state.distances.iter_mut().enumerate() {
            *distance = covariance[k][k].sqrt().clamp(settings.difference, WIDEST);
        }
        state.slopes = jacobian(evaluate, &state.place, &state.distances)?;
        settled = state.descend(evaluate, data, settings)?;
        if state.sum > before * (1.0 - SETTLED) {
            break;
        }
    }
    Ok(Minimum {
        covariance: state.covariance(data.len()),
        at_bound: state.at_bound(),
        place: state.place,
        values: state.values,
        sum: state.sum,
        rounds: state.rounds,
        settled,
    })
}

/// Largest number of times that differences are taken anew over the uncertainty found.
const WIDENINGS: usize = 4;
/// Half the distance of central differences is never more than this part of the range.
const WIDEST: f64 = 0.05;
/// The search is over when differences taken anew lower the sum by less than this part.
const SETTLED: f64 = 1e-3;

/// The state of the search.
struct State {
    place: Vec<f64>,
    values: Vec<f64>,
    sum: f64,
    slopes: Vec<Vec<f64>>,
    /// Half the distances of the differences that gave the slopes.
    distances: Vec<f64>,
    rounds: u32,
}

impl State {
    fn at_bound(&self) -> Vec<bool> {
        self.place
            .iter()
            .map(|value| *value <= 0.0 || *value >= 1.0)
            .collect()
    }

    fn covariance(&self, values: usize) -> Option<Vec<Vec<f64>>> {
        let at_bound = self.at_bound();
        let count = self.place.len();
        let free: Vec<usize> = (0..count).filter(|k| !at_bound[*k]).collect();
        let freedom = values.saturating_sub(free.len()).max(1);
        covariance(&self.slopes, &free, self.sum / freedom as f64, count)
    }

    /// Goes down until nothing helps; whether that was within the rounds allowed.
    fn descend(
        &mut self,
        evaluate: Evaluate<'_>,
        data: &[f64],
        settings: &SearchSettings,
    ) -> Result<bool, String> {
        let mut damping = 1e-3;
        for _ in 0..settings.most_rounds {
            self.rounds += 1;
            if !self.step(evaluate, data, settings, &mut damping)? {
                return Ok(true);
            }
            self.slopes = jacobian(evaluate, &self.place, &self.distances)?;
        }
        Ok(false)
    }

    /// Makes one step down; whether another is worth while.
    fn step(
        &mut self,
        evaluate: Evaluate<'_>,
        data: &[f64],
        settings: &SearchSettings,
        damping: &mut f64,
    ) -> Result<bool, String> {
        let residuals: Vec<f64> = data
            .iter()
            .zip(&self.values)
            .map(|(data, value)| data - value)
            .collect();
        let gradient: Vec<f64> = self.slopes.iter().map(|slope| dot(slope, &residuals)).collect();
        let held = |k: &usize| {
            let (place, gradient) = (self.place[*k], gradient[*k]);
            place <= 0.0 && gradient < 0.0 || place >= 1.0 && gradient > 0.0
        };
        let free: Vec<usize> = (0..self.place.len()).filter(|k| !held(k)).collect();
        if free.is_empty() {
            return Ok(false);
        }
        for _ in 0..20 {
            let mut matrix = normal(&self.slopes, &free);
            for (k, row) in matrix.iter_mut().enumerate() {
                row[k] *= 1.0 + *damping;
                row[k] += f64::MIN_POSITIVE;
            }
            let right: Vec<f64> = free.iter().map(|k| gradient[*k]).collect();
            let Some(step) = solve(matrix, right) else {
                *damping *= 10.0;
                continue;
            };
            let mut next = self.place.clone();
            for (k, step) in free.iter().zip(&step) {
                next[*k] = (next[*k] + step).clamp(0.0, 1.0);
            }
            let moved = next
                .iter()
                .zip(&self.place)
                .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            // A move too small to count is made if it helps, and is the last one.
            let last = moved <= settings.least_move;
            // A place where the model has no values is too far.
            let tried = first(evaluate(std::slice::from_ref(&next))).and_then(|values| {
                let sum = squares(data, &values)?;
                Ok((values, sum))
            });
            match tried {
                Ok((values, sum)) if sum < self.sum => {
                    (self.place, self.values, self.sum) = (next, values, sum);
                    *damping = (*damping / 10.0).max(1e-12);
                    return Ok(!last);
                }
                _ if last => return Ok(false),
                _ => *damping *= 10.0,
            }
        }
        Ok(false)
    }
}

fn first(mut found: Vec<Result<Vec<f64>, String>>) -> Result<Vec<f64>, String> {
    found
        .pop()
        .unwrap_or_else(|| Err("the model gave nothing".to_owned()))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn squares(data: &[f64], values: &[f64]) -> Result<f64, String> {
    if data.len() != values.len() {
        return Err(format!(
            "the model gives {} values for {} data",
            values.len(),
            data.len()
        ));
    }
    let sum: f64 = data.iter().zip(values).map(|(a, b)| (a - b) * (a - b)).sum();
    if sum.is_finite() {
        Ok(sum)
    } else {
        Err("the model's values are not finite".to_owned())
    }
}

/// Derivatives of the values by each parameter.
fn jacobian(evaluate: Evaluate<'_>, place: &[f64], distances: &[f64]) -> Result<Vec<Vec<f64>>, String> {
    let mut places = Vec::with_capacity(2 * place.len());
    for (k, distance) in distances.iter().enumerate() {
        for side in [-distance, *distance] {
            let mut beside = place.to_vec();
            beside[k] = (beside[k] + side).clamp(0.0, 1.0);
            places.push(beside);
        }
    }
    let found = evaluate(&places).into_iter().collect::<Result<Vec<_>, _>>()?;
    let slopes = (0..place.len()).map(|k| {
        let distance = places[2 * k + 1][k] - places[2 * k][k];
        let pairs = found[2 * k].iter().zip(&found[2 * k + 1]);
        pairs.map(|(low, high)| (high - low) / distance).collect()
    });
    Ok(slopes.collect())
}

fn normal(slopes: &[Vec<f64>], free: &[usize]) -> Vec<Vec<f64>> {
    free.iter()
        .map(|a| free.iter().map(|b| dot(&slopes[*a], &slopes[*b])).collect())
        .collect()
}

/// Solves a small system with a symmetric positive definite matrix (Cholesky); `None` if it is singular to
/// rounding.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    // Scaled to a unit diagonal, so that rounding is seen whatever the sizes.
    let scales: Vec<f64> = (0..n).map(|k| 1.0 / matrix[k][k].sqrt()).collect();
    for i in 0..n {
        right[i] *= scales[i];
        for j in 0..n {
            matrix[i][j] *= scales[i] * scales[j];
        }
    }
    for j in 0..n {
        for k in 0..j {
            for i in j..n {
                matrix[i][j] -= matrix[i][k] * matrix[j][k];
            }
        }
        let pivot = matrix[j][j];
        if pivot.is_nan() || pivot <= 1e-12 {
            return None;
        }
        for i in j..n {
            matrix[i][j] /= pivot.sqrt();
        }
    }
    for i in 0..n {
        for k in 0..i {
            right[i] -= matrix[i][k] * right[k];
        }
        right[i] /= matrix[i][i];
    }
    for i in (0..n).rev() {
        for k in i + 1..n {
            right[i] -= matrix[k][i] * right[k];
        }
        right[i] /= matrix[i][i];
    }
    Some(
        right
            .iter()
            .zip(&scales)
            .map(|(value, scale)| value * scale)
            .collect(),
    )
}

fn covariance(slopes: &[Vec<f64>], free: &[usize], variance: f64, count: usize) -> Option<Vec<Vec<f64>>> {
    let matrix = normal(slopes, free);
    let mut all = vec![vec![0.0; count]; count];
    for (column, k) in free.iter().enumerate() {
        let mut unit = vec![0.0; free.len()];
        unit[column] = 1.0;
        let inverse = solve(matrix.clone(), unit)?;
        for (row, i) in free.iter().enumerate() {
            all[*i][*k] = variance * inverse[row];
        }
    }
    Some(all)
}
