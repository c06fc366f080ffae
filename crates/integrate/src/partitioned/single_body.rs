//! One body of at most six coordinates and no internal states, such as one wedge: the matrices are stored
//! column by column, in pairs of rows, so that a solution takes a few dozen products of pairs.

use wide::f64x2;

use super::structure::QuadratureOfBody;
use crate::dense_block::invert;

/// The largest number of coordinates.
const MAXIMUM_SIZE: usize = 6;

/// Calls a function with the number of coordinates as a constant `N`, so that its loops are unrolled.
macro_rules! sized {
    (@ $n:literal, $call:expr) => {{
        const N: usize = $n;
        $call
    }};
    ($size:expr, $call:expr) => {
        match $size {
            1 => sized!(@ 1, $call),
            2 => sized!(@ 2, $call),
            3 => sized!(@ 3, $call),
            4 => sized!(@ 4, $call),
            5 => sized!(@ 5, $call),
            _ => sized!(@ 6, $call),
        }
    };
}

/// The matrices that a factorization reads, row by row.
pub(super) struct Blocks<'a> {
    pub mass: &'a [f64],
    pub stiffness: &'a [f64],
    pub damping: &'a [f64],
    /// Derivatives of the quadratures.
    pub rows: &'a [QuadratureOfBody],
    pub row_data: &'a [f64],
}

/// Matrices of one body. Those that a vector is multiplied with are cut into pairs of rows (the last one
/// padded with zeros), and are stored pair by pair, column by column.
#[derive(Clone, Debug)]
pub(super) struct SingleBody {
    size: usize,
    /// 1/σ.
    reciprocal: f64,
    mass: Vec<[f64; 2]>,
    stiffness: Vec<[f64; 2]>,
    /// The inverse of W.
    inverse: Vec<[f64; 2]>,
    /// W and its inverse, row by row.
    square: Vec<f64>,
    /// The derivatives of the quadratures by positions and speeds.
    rows: Vec<[f64; 2]>,
}

impl SingleBody {
    /// Returns zero matrices for a body of so many coordinates; none if there are too many.
    pub fn new(size: usize, quadratures: usize) -> Option<Self> {
        let zero = || vec![[0.0; 2]; size * size.div_ceil(2)];
        (1..=MAXIMUM_SIZE).contains(&size).then(|| Self {
            size,
            reciprocal: 1.0,
            mass: zero(),
            stiffness: zero(),
            inverse: zero(),
            square: vec![0.0; size * size],
            rows: vec![[0.0; 2]; 2 * size * quadratures.div_ceil(2)],
        })
    }

    /// Factors; returns false if the matrix is singular.
    pub fn factor(&mut self, shift: f64, source: Blocks<'_>) -> bool {
        sized!(self.size, self.factor_sized::<N>(shift, source))
    }

    #[inline(always)]
    fn factor_sized<const N: usize>(&mut self, shift: f64, source: Blocks<'_>) -> bool {
        let Blocks {
            mass,
            stiffness,
            damping,
            rows,
            row_data,
        } = source;
        let reciprocal = 1.0 / shift;
        self.reciprocal = reciprocal;
        let entries = mass.iter().zip(damping).zip(stiffness);
        for (w, ((m, d), k)) in self.square.iter_mut().zip(entries) {
            *w = shift * m - d - reciprocal * k;
        }
        if !invert(N, &mut self.square) {
            return false;
        }
        to_pairs::<N>(mass, &mut self.mass);
        to_pairs::<N>(stiffness, &mut self.stiffness);
        to_pairs::<N>(&self.square, &mut self.inverse);
        self.rows.fill([0.0; 2]);
        let pairs = self.rows.as_chunks_mut::<N>().0.as_chunks_mut::<2>().0;
        for row in rows {
            let derivatives = row_data[row.start..].as_chunks::<N>().0;
            let (Some(pair), Some([by_position, by_speed])) =
                (pairs.get_mut(row.quadrature / 2), derivatives.first_chunk::<2>())
            else {
                continue;
            };
            for j in 0..N {
                pair[0][j][row.quadrature % 2] += by_position[j];
                pair[1][j][row.quadrature % 2] += by_speed[j];
            }
        }
        true
    }

    /// Solves with the shift of the last factorization.
    #[inline(always)]
    pub fn solve(&self, b: &mut [f64]) {
        sized!(self.size, self.solve_sized::<N, { N.div_ceil(2) }>(b));
    }

    /// As [`SingleBody::solve`], for `N` coordinates in `P` pairs.
    #[inline(always)]
    fn solve_sized<const N: usize, const P: usize>(&self, b: &mut [f64]) {
        let reciprocal = f64x2::splat(self.reciprocal);
        let (Some((q, rest)), true) = (b.split_first_chunk_mut::<N>(), self.size == N) else {
            return;
        };
        let Some((u, w)) = rest.split_first_chunk_mut::<N>() else {
            return;
        };
        let (positions, speeds) = (q.map(f64x2::splat), u.map(f64x2::splat));
        let mut right = [[0.0; 2]; P];
        let matrices = self
            .mass
            .as_chunks::<N>()
            .0
            .iter()
            .zip(self.stiffness.as_chunks::<N>().0);
        for (right, (mass, stiffness)) in right.iter_mut().zip(matrices) {
            *right = (product(mass, &speeds) + reciprocal * product(stiffness, &positions)).to_array();
        }
        let right: [f64x2; N] = std::array::from_fn(|j| f64x2::splat(right[j / 2][j % 2]));
        let mut solution = [[0.0; 2]; P];
        for (solution, inverse) in solution.iter_mut().zip(self.inverse.as_chunks::<N>().0) {
            *solution = product(inverse, &right).to_array();
        }
        for j in 0..N {
            u[j] = solution[j / 2][j % 2];
            q[j] = (q[j] + u[j]) * self.reciprocal;
        }
        let (positions, speeds) = (q.map(f64x2::splat), u.map(f64x2::splat));
        let (by_pair, last) = w.as_chunks_mut::<2>();
        let pairs = self.rows.as_chunks::<N>().0.as_chunks::<2>().0;
        let rate = |[by_position, by_speed]: &[[[f64; 2]; N]; 2], w: [f64; 2]| {
            let change = product(by_position, &positions) + product(by_speed, &speeds);
            ((f64x2::new(w) + change) * reciprocal).to_array()
        };
        for (w, pair) in by_pair.iter_mut().zip(pairs) {
            *w = rate(pair, *w);
        }
        if let ([w], Some(pair)) = (last, pairs.last()) {
            [*w, _] = rate(pair, [*w, 0.0]);
        }
    }
}

/// A pair of rows times a vector.
#[inline(always)]
fn product<const N: usize>(rows: &[[f64; 2]; N], vector: &[f64x2; N]) -> f64x2 {
    let mut sum = f64x2::new(rows[0]) * vector[0];
    for j in 1..N {
        sum += f64x2::new(rows[j]) * vector[j];
    }
    sum
}

/// Cuts a matrix into pairs of rows.
#[inline(always)]
fn to_pairs<const N: usize>(matrix: &[f64], pairs: &mut [[f64; 2]]) {
    let rows = matrix.as_chunks::<N>().0;
    for (rows, target) in rows.chunks(2).zip(pairs.as_chunks_mut::<N>().0) {
        for j in 0..N {
            target[j] = [rows[0][j], rows.get(1).map_or(0.0, |row| row[j])];
        }
    }
}
