//! Natural vibrations about a state: undamped frequencies and shapes.
//!
//! `M q¨ + K q = 0` with K the derivative of all forces by the coordinates; which friction elements stick
//! (their accumulators then are springs) is a choice ([`Held`]). At a corner of a curve the piece of larger
//! abscissae is taken. K is symmetric but for the wedges, whose friction ties forces to normal forces: then
//! eigenvalues may be complex in principle (flutter), and are taken from the general matrix.

use integrate::Problem;
use nalgebra::{Complex, DMatrix, DVector};

use super::System;
use crate::connection::{FrictionRule, FrictionRules};
use crate::linear::NoVibration;

/// The closed connections with friction that stick in a vibration; the others have no friction. Contact
/// points follow their law and state: bristles at rest stick, tanh has no stiffness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Held {
    /// All: small vibrations about a state of rest.
    #[default]
    All,
    /// Surfaces, not wedges: vibrations while the wedges slide.
    Surfaces,
    /// None.
    Nothing,
}

impl Held {
    fn friction_rules(self) -> FrictionRules {
        let rule = |sticks: bool| {
            if sticks {
                FrictionRule::Stuck
            } else {
                FrictionRule::Free
            }
        };
        FrictionRules {
            surfaces: rule(self != Self::Nothing),
            wedges: rule(self == Self::All),
        }
    }
}

/// One natural vibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibration {
    /// Frequency, Hz; zero where the eigenvalue is not positive.
    pub frequency: f64,
    /// The eigenvalue λ of M⁻¹K, 1/s²: ω² of a vibration, negative where the state is unstable; real and
    /// imaginary part.
    pub eigenvalue: [f64; 2],
    /// Its shape q in all free coordinates, in the order of the positions in the state vector (m, rad; real
    /// part), the largest entry of `Lᵀ q` being 1, with the mass matrix `M = L Lᵀ`.
    pub shape: Vec<f64>,
}

/// All natural vibrations.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibrations {
    /// By rising real part of the eigenvalue.
    pub modes: Vec<Vibration>,
    /// The largest entry of the antisymmetric part of `L⁻¹ K L⁻ᵀ`, relative to its largest entry.
    pub asymmetry: f64,
}

/// Below this asymmetry the stiffness counts as symmetric.
const SYMMETRIC: f64 = 1e-9;

impl System {
    /// Returns the stiffness matrix `-∂Q/∂q`, N/m and so on, row-major in the order of the positions.
    #[must_use]
    pub fn stiffness_matrix(&mut self, time: f64, x: &[f64], held: Held) -> Vec<f64> {
        let [_, stiffness] = self.mass_and_stiffness(time, x, held);
        stiffness.transpose().iter().copied().collect()
    }

    /// Returns the mass matrix and that of the stiffness.
    fn mass_and_stiffness(&mut self, time: f64, x: &[f64], held: Held) -> [DMatrix<f64>; 2] {
        let friction_rules = std::mem::replace(&mut self.connections.friction_rules, held.friction_rules());
        let mut dx = vec![0.0; x.len()];
        let mut df_dt = vec![0.0; x.len()];
        self.derivative(time, x, &mut dx);
        self.linearize(time, x, &dx, &mut df_dt);
        self.connections.friction_rules = friction_rules;
        let matrices = self.matrices();
        let mut stiffness = -matrices.stiffness;
        // A bristle that sticks follows the bodies: e = G_u q, so that F e is a stiffness.
        let of_elements = self.pairs_of_elements();
        for (group, ends) in self.internal_ends.iter().enumerate() {
            if of_elements.contains(&group) {
                continue;
            }
            for (row_side, &i) in ends.iter().enumerate() {
                for (column_side, &j) in ends.iter().enumerate() {
                    let (m, w) = (self.free[i].free.len(), self.free[j].free.len());
                    let f_t = self.jacobian.side_mut(group, row_side)[2].to_vec();
                    let [_, g_u, _] = self.jacobian.side_mut(group, column_side);
                    for (r, c) in (0..m).flat_map(|r| (0..w).map(move |c| (r, c))) {
                        let value = f_t[r] * g_u[c] + f_t[m + r] * g_u[w + c];
                        stiffness[(self.free[i].offset + r, self.free[j].offset + c)] -= value;
                    }
                }
            }
        }
        [matrices.mass, stiffness]
    }

    /// Returns the natural vibrations about a state, by rising frequency.
    ///
    /// # Errors
    /// The eigenvalues are not found.
    pub fn vibrations(&mut self, time: f64, x: &[f64], held: Held) -> Result<Vibrations, NoVibration> {
        let [mass, stiffness] = self.mass_and_stiffness(time, x, held);
        // M = L Lᵀ
        let root = mass.cholesky().ok_or(NoVibration)?.l();
        let half = root.solve_lower_triangular(&stiffness).ok_or(NoVibration)?;
        let matrix = root
            .solve_lower_triangular(&half.transpose())
            .ok_or(NoVibration)?
            .transpose();
        let largest = matrix.amax();
        if !largest.is_finite() {
            return Err(NoVibration);
        }
        let asymmetry = (&matrix - matrix.transpose()).amax() * 0.5 / largest.max(f64::MIN_POSITIVE);
        let pairs = if asymmetry < SYMMETRIC {
            symmetric(&matrix)
        } else {
            general(&matrix).ok_or(NoVibration)?
        };
        let upper = root.transpose();
        let vibration = |(value, shape): (Complex<f64>, DVector<f64>)| {
            let scaled = upper.solve_upper_triangular(&(&shape / shape.amax()))?;
            Some(Vibration {
                frequency: frequency(value),
                eigenvalue: [value.re, value.im],
                shape: scaled.iter().copied().collect(),
            })
        };
        let modes: Option<Vec<Vibration>> = pairs.into_iter().map(vibration).collect();
        let mut modes = modes.ok_or(NoVibration)?;
        modes.sort_by(|a, b| a.eigenvalue[0].total_cmp(&b.eigenvalue[0]));
        Ok(Vibrations { modes, asymmetry })
    }
}

/// Returns the frequency of an eigenvalue, Hz.
fn frequency(value: Complex<f64>) -> f64 {
    if value.im == 0.0 {
        return value.re.max(0.0).sqrt() / (2.0 * std::f64::consts::PI);
    }
    let size = (value.re * value.re + value.im * value.im).sqrt();
    (0.5 * (size + value.re)).max(0.0).sqrt() / (2.0 * std::f64::consts::PI)
}

fn symmetric(matrix: &DMatrix<f64>) -> Vec<(Complex<f64>, DVector<f64>)> {
    let even = (matrix + matrix.transpose()) * 0.5;
    let solved = even.symmetric_eigen();
    let columns = solved.eigenvectors.column_iter();
    solved
        .eigenvalues
        .iter()
        .zip(columns)
        .map(|(value, column)| (Complex::new(*value, 0.0), column.into_owned()))
        .collect()
}

/// Returns the eigenvalues (by the real Schur form) with their vectors (by inverse iteration).
fn general(matrix: &DMatrix<f64>) -> Option<Vec<(Complex<f64>, DVector<f64>)>> {
    let n = matrix.nrows();
    let schur = nalgebra::linalg::Schur::try_new(matrix.clone(), f64::EPSILON, 10_000)?;
    let values = schur.complex_eigenvalues();
    let largest = matrix.amax();
    let mut found = Vec::with_capacity(n);
    for (number, value) in values.iter().enumerate() {
        let shifted = value + Complex::new(largest * 1e-13, 0.0);
        let system = DMatrix::from_fn(n, n, |i, j| {
            let own = Complex::new(matrix[(i, j)], 0.0);
            if i == j { own - shifted } else { own }
        });
        let factors = system.lu();
        // Start vectors differ, so that a repeated eigenvalue gives different shapes.
        let mut vector = DVector::from_fn(n, |i, _| {
            Complex::new(libm::cos((1 + i * (number + 2)) as f64), 0.0)
        });
        for _ in 0..4 {
            vector = factors.solve(&vector)?;
            let size = vector.iter().map(|v| v.norm()).fold(0.0, f64::max);
            vector /= Complex::new(size, 0.0);
        }
        // turned so that its largest entry is real
        let head = *vector.iter().max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let turn = head.conj() / Complex::new(head.norm(), 0.0);
        found.push((*value, vector.map(|v| (v * turn).re)));
    }
    Some(found)
}
