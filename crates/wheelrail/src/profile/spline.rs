//! Cubic splines along points of a profile: through them, or smoothed by a stated deviation.
//!
//! y and z are natural cubic smoothing splines (Reinsch 1967) of the chord length: among all curves, the one
//! with the least `∫ (y''² + z''²) dt + Σ |fit - point|² / λ`. λ is the largest one at which no point lies
//! farther from its fit than the stated deviation. A deviation of zero gives the spline through the points.

use super::curve::{CurveForm, Piece, ProfileCurve};

/// Distances of a curve from the points it was made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Largest distance of a point from its fit, m.
    pub largest: f64,
    /// Root of the mean square, m.
    pub rms: f64,
    /// Number of points.
    pub points: usize,
}

/// Steps of the bisection for the weight λ, on its logarithm.
const BISECTIONS: usize = 50;

/// Returns the spline along different points (m, at least three) and how far it lies from them: at most
/// `deviation` (m).
pub(super) fn fit(points: &[[f64; 2]], deviation: f64) -> (ProfileCurve, Deviation) {
    let mut parameters = Vec::with_capacity(points.len());
    let mut length = 0.0;
    for (i, point) in points.iter().enumerate() {
        if i > 0 {
            length += libm::hypot(point[0] - points[i - 1][0], point[1] - points[i - 1][1]);
        }
        parameters.push(length);
    }
    let system = Reinsch::new(&parameters, points);
    let mut fitted = system.solve(0.0);
    if deviation > 0.0 {
        // Curvatures scale as 1/length, so that λ has the dimension of length³.
        let scale = length * length * length;
        let (mut low, mut high) = (libm::log(scale) - 60.0, libm::log(scale) + 10.0);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let trial = system.solve(libm::exp(middle));
            if trial.deviation.largest <= deviation {
                (low, fitted) = (middle, trial);
            } else {
                high = middle;
            }
        }
    }
    (fitted.curve(&parameters), fitted.deviation)
}

/// Second derivatives and values at the points.
struct Fitted {
    seconds: Vec<[f64; 2]>,
    values: Vec<[f64; 2]>,
    deviation: Deviation,
}

impl Fitted {
    fn curve(&self, parameters: &[f64]) -> ProfileCurve {
        let pieces = parameters.windows(2).enumerate().map(|(i, ends)| {
            let h = ends[1] - ends[0];
            let coefficients = [0, 1].map(|axis| {
                let (from, to) = (self.values[i][axis], self.values[i + 1][axis]);
                let (s, t) = (self.seconds[i][axis], self.seconds[i + 1][axis]);
                [
                    from,
                    (to - from) / h - h * (2.0 * s + t) / 6.0,
                    0.5 * s,
                    (t - s) / (6.0 * h),
                ]
            });
            Piece {
                start: ends[0],
                form: CurveForm::Cubic(coefficients),
            }
        });
        ProfileCurve::new(pieces.collect(), parameters[parameters.len() - 1])
    }
}

/// The equations `(R + λ QᵀQ) γ = Qᵀ y` of the inner second derivatives γ; the fit is `y - λ Q γ`.
struct Reinsch<'a> {
    points: &'a [[f64; 2]],
    /// Interval lengths.
    steps: Vec<f64>,
    /// Qᵀ of the points: second differences.
    right: Vec<[f64; 2]>,
}

impl<'a> Reinsch<'a> {
    fn new(parameters: &[f64], points: &'a [[f64; 2]]) -> Self {
        let steps: Vec<f64> = parameters.windows(2).map(|ends| ends[1] - ends[0]).collect();
        let right = (1..points.len() - 1).map(|i| {
            [0, 1].map(|axis| {
                (points[i + 1][axis] - points[i][axis]) / steps[i]
                    - (points[i][axis] - points[i - 1][axis]) / steps[i - 1]
            })
        });
        Self {
            points,
            right: right.collect(),
            steps,
        }
    }

    /// Returns column `j` of Q: its rows j, j + 1, j + 2.
    fn column(&self, j: usize) -> [f64; 3] {
        let (a, b) = (1.0 / self.steps[j], 1.0 / self.steps[j + 1]);
        [a, -a - b, b]
    }

    /// Solves by a factorization L D Lᵀ with two bands.
    fn solve(&self, weight: f64) -> Fitted {
        let count = self.right.len();
        let mut pivots = vec![0.0; count];
        let (mut first, mut second) = (vec![0.0; count], vec![0.0; count]);
        let mut seconds = self.right.clone();
        for j in 0..count {
            let own = self.column(j);
            let mut diagonal = (self.steps[j] + self.steps[j + 1]) / 3.0
                + weight * own.iter().map(|entry| entry * entry).sum::<f64>();
            let mut next = 0.0;
            if j + 1 < count {
                let other = self.column(j + 1);
                next = self.steps[j + 1] / 6.0 + weight * (own[1] * other[0] + own[2] * other[1]);
            }
            let far = match j + 2 < count {
                true => weight * own[2] * self.column(j + 2)[0],
                false => 0.0,
            };
            if j >= 1 {
                diagonal -= first[j - 1] * first[j - 1] * pivots[j - 1];
                next -= first[j - 1] * pivots[j - 1] * second[j - 1];
            }
            if j >= 2 {
                diagonal -= second[j - 2] * second[j - 2] * pivots[j - 2];
            }
            pivots[j] = diagonal;
            first[j] = next / diagonal;
            second[j] = far / diagonal;
            for axis in 0..2 {
                if j >= 1 {
                    seconds[j][axis] -= first[j - 1] * seconds[j - 1][axis];
                }
                if j >= 2 {
                    seconds[j][axis] -= second[j - 2] * seconds[j - 2][axis];
                }
            }
        }
        for j in (0..count).rev() {
            for axis in 0..2 {
                let mut value = seconds[j][axis] / pivots[j];
                if j + 1 < count {
                    value -= first[j] * seconds[j + 1][axis];
                }
                if j + 2 < count {
                    value -= second[j] * seconds[j + 2][axis];
                }
                seconds[j][axis] = value;
            }
        }
        self.finish(weight, seconds)
    }

    fn finish(&self, weight: f64, inner: Vec<[f64; 2]>) -> Fitted {
        let mut values = self.points.to_vec();
        for (j, second) in inner.iter().enumerate() {
            let column = self.column(j);
            for (row, entry) in column.iter().enumerate() {
                for axis in 0..2 {
                    values[j + row][axis] -= weight * entry * second[axis];
                }
            }
        }
        let mut deviation = Deviation {
            points: values.len(),
            ..Deviation::default()
        };
        for (value, point) in values.iter().zip(self.points) {
            let distance = libm::hypot(value[0] - point[0], value[1] - point[1]);
            deviation.largest = deviation.largest.max(distance);
            deviation.rms += distance * distance;
        }
        deviation.rms = (deviation.rms / values.len() as f64).sqrt();
        let mut seconds = vec![[0.0; 2]];
        seconds.extend(inner);
        seconds.push([0.0; 2]);
        Fitted {
            seconds,
            values,
            deviation,
        }
    }
}
