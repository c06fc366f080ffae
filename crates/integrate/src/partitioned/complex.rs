//! One body with a complex shift: as [`Single`], whose matrices it uses.

use num_complex::Complex64;
use wide::f64x2;

use super::single::{Single, Source, product};

/// The inverse of W for one complex shift.
#[derive(Clone, Debug)]
pub(super) struct ComplexFactor {
    /// 1/σ.
    reciprocal: Complex64,
    /// The inverse of W, row by row, real and imaginary part.
    inverse: Vec<[f64; 2]>,
}

impl ComplexFactor {
    pub fn new(size: usize) -> Self {
        Self {
            reciprocal: Complex64::ZERO,
            inverse: vec![[0.0; 2]; size * size],
        }
    }

    /// Factors; false: the matrix is singular.
    #[inline(always)]
    pub fn factor<const N: usize>(&mut self, [re, im]: [f64; 2], source: Source<'_>) -> bool {
        let shift = Complex64::new(re, im);
        self.reciprocal = shift.inv();
        let mut w = [[Complex64::ZERO; N]; N];
        let entries = source.mass.iter().zip(source.damping).zip(source.stiffness);
        for (w, ((m, d), k)) in w.as_flattened_mut().iter_mut().zip(entries) {
            *w = shift * m - d - self.reciprocal * k;
        }
        let regular = invert(&mut w);
        for (target, value) in self.inverse.iter_mut().zip(w.as_flattened()) {
            *target = [value.re, value.im];
        }
        regular
    }

    /// Solves for the real and the imaginary part of a right side.
    #[inline(always)]
    pub fn solve<const N: usize>(&self, body: &Single, re: &mut [f64], im: &mut [f64]) {
        let numbers = |re: &[f64], im: &[f64], first: usize| -> [f64x2; N] {
            std::array::from_fn(|j| f64x2::new([re[first + j], im[first + j]]))
        };
        let scaled: [f64x2; N] = std::array::from_fn(|j| {
            let position = self.reciprocal * Complex64::new(re[j], im[j]);
            f64x2::new([position.re, position.im])
        });
        let speeds = numbers(re, im, N);
        let (mass, stiffness) = (body.mass.as_chunks::<N>().0, body.stiffness.as_chunks::<N>().0);
        let right: [f64x2; N] = std::array::from_fn(|i| {
            let mut sum = f64x2::ZERO;
            for j in 0..N {
                sum += f64x2::splat(mass[i / 2][j][i % 2]) * speeds[j];
                sum += f64x2::splat(stiffness[i / 2][j][i % 2]) * scaled[j];
            }
            sum
        });
        // times i
        let turned = right.map(|value| {
            let [re, im] = value.to_array();
            f64x2::new([-im, re])
        });
        for (i, row) in self.inverse.as_chunks::<N>().0.iter().enumerate() {
            let mut sum = f64x2::ZERO;
            for j in 0..N {
                let [a, b] = row[j];
                sum += f64x2::splat(a) * right[j] + f64x2::splat(b) * turned[j];
            }
            let [a, b] = sum.to_array();
            let position = self.reciprocal * Complex64::new(re[i] + a, im[i] + b);
            (re[i], im[i]) = (position.re, position.im);
            (re[N + i], im[N + i]) = (a, b);
        }
        self.solve_quadratures::<N>(&body.rows, re, im);
    }

    /// The quadratures, two at a time, when positions and speeds are there.
    #[inline(always)]
    fn solve_quadratures<const N: usize>(&self, rows: &[[f64; 2]], re: &mut [f64], im: &mut [f64]) {
        let (own_re, w_re) = re.split_at_mut(2 * N);
        let (own_im, w_im) = im.split_at_mut(2 * N);
        let spread = |own: &[f64], first: usize| -> [f64x2; N] {
            std::array::from_fn(|j| f64x2::splat(own[first + j]))
        };
        let (q_re, u_re) = (spread(own_re, 0), spread(own_re, N));
        let (q_im, u_im) = (spread(own_im, 0), spread(own_im, N));
        let (a, b) = (f64x2::splat(self.reciprocal.re), f64x2::splat(self.reciprocal.im));
        let pairs = rows.as_chunks::<N>().0.as_chunks::<2>().0;
        let targets = w_re.chunks_mut(2).zip(w_im.chunks_mut(2));
        for ([by_position, by_speed], (w_re, w_im)) in pairs.iter().zip(targets) {
            let pair = |w: &[f64]| f64x2::new([w[0], w.get(1).copied().unwrap_or(0.0)]);
            let x = pair(w_re) + product(by_position, &q_re) + product(by_speed, &u_re);
            let y = pair(w_im) + product(by_position, &q_im) + product(by_speed, &u_im);
            let (new_re, new_im) = ((a * x - b * y).to_array(), (a * y + b * x).to_array());
            w_re.copy_from_slice(&new_re[..w_re.len()]);
            w_im.copy_from_slice(&new_im[..w_im.len()]);
        }
    }
}

/// Gauss-Jordan elimination with row exchange; false: singular.
#[inline(always)]
fn invert<const N: usize>(m: &mut [[Complex64; N]; N]) -> bool {
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    for k in 0..N {
        for i in k + 1..N {
            if m[i][k].norm_sqr() > m[k][k].norm_sqr() {
                m.swap(i, k);
                order.swap(i, k);
            }
        }
        let size = m[k][k].norm_sqr();
        if !(size > 0.0 && size < f64::INFINITY) {
            return false;
        }
        let inverse = m[k][k].inv();
        let mut row = m[k];
        row[k] = Complex64::ONE;
        for value in &mut row {
            *value *= inverse;
        }
        for i in 0..N {
            if i != k {
                let factor = std::mem::replace(&mut m[i][k], Complex64::ZERO);
                for j in 0..N {
                    m[i][j] -= factor * row[j];
                }
            }
        }
        m[k] = row;
    }
    let eliminated = *m;
    for (target, row) in m.iter_mut().zip(&eliminated) {
        for k in 0..N {
            target[order[k] % N] = row[k];
        }
    }
    true
}
