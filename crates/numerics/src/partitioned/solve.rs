//! Solution of the partitioned system with the factors of the last factorization.

use super::{CouplingBlock, Partitioned};
use crate::dense_block::{dot_of, multiply_add, rectangle_add};

impl Partitioned {
    /// Solves `(shift · I - J) y = b` in place.
    pub fn solve(&mut self, b: &mut [f64]) {
        // Loops of a known length are unrolled.
        match self.uniform {
            1 => self.solve_sized::<1>(b),
            2 => self.solve_sized::<2>(b),
            3 => self.solve_sized::<3>(b),
            4 => self.solve_sized::<4>(b),
            5 => self.solve_sized::<5>(b),
            6 => self.solve_sized::<6>(b),
            _ => self.solve_sized::<0>(b),
        }
    }

    /// As [`Partitioned::solve`], if all bodies have `N` coordinates; `N = 0` stands for any numbers.
    #[inline(always)]
    fn solve_sized<const N: usize>(&mut self, b: &mut [f64]) {
        let size = |n: usize| if N > 0 { N } else { n };
        let layout = self.layout();
        let [q, u, s, w] = layout.split_mut(b);
        let inverse = 1.0 / self.shift;
        let work = &mut self.work[..];
        // Right side of the speed rows: M r_u + K r_q/σ + F Z (r_s + G_q r_q/σ).
        work.fill(0.0);
        for (body, &n) in self.sizes.iter().enumerate() {
            let n = size(n);
            let at = self.offsets[body];
            multiply_add(
                n,
                &self.mass[self.mass_starts[body]..],
                &u[at..at + n],
                1.0,
                &mut work[at..at + n],
            );
        }
        for &CouplingBlock {
            row, column, start, ..
        } in &self.pairs
        {
            let (i, j) = (self.offsets[row], self.offsets[column]);
            let (m, n) = (size(self.sizes[row]), size(self.sizes[column]));
            if m == n {
                multiply_add(
                    n,
                    &self.stiffness[start..],
                    &q[j..j + n],
                    inverse,
                    &mut work[i..i + m],
                );
            } else {
                rectangle_add(
                    &self.stiffness[start..start + m * n],
                    &q[j..j + n],
                    inverse,
                    &mut work[i..i + m],
                );
            }
        }
        match self.internal_uniform {
            6 => self.eliminated::<6>(q, s),
            _ => self.eliminated::<0>(q, s),
        }
        let work = &mut self.work[..];
        self.lu.solve(work);
        // Back: speeds, positions, internal states, quadratures. The internal right sides hold G_q r_q/σ
        // already.
        for ((q, u), k) in q.iter_mut().zip(u.iter_mut()).zip(work.iter()) {
            *u = *k;
            *q = (*q + *k) * inverse;
        }
        match self.internal_uniform {
            6 => self.substituted::<6>(u, s),
            _ => self.substituted::<0>(u, s),
        }
        for row in &self.quadratures_of_bodies {
            let (at, n) = (self.offsets[row.body], size(self.sizes[row.body]));
            let (p_q, p_u) = self.row_data[row.start..row.start + 2 * n].split_at(n);
            w[row.quadrature] += dot_of(p_q, &q[at..at + n]) + dot_of(p_u, &u[at..at + n]);
        }
        for row in &self.quadratures_of_pairs {
            w[row.quadrature] += dot_of(&row.values, &s[2 * row.group..2 * row.group + 2]);
        }
        for k in w.iter_mut() {
            *k *= inverse;
        }
    }

    /// Adds to the right side of the speed rows what the internal states bring there, and to theirs what the
    /// positions bring.
    #[inline(always)]
    fn eliminated<const N: usize>(&mut self, q: &[f64], s: &mut [f64]) {
        let size = |n: usize| if N > 0 { N } else { n };
        let (inverse, work) = (1.0 / self.shift, &mut self.work[..]);
        let groups = self.internal_pairs.iter().zip(s.chunks_exact_mut(2));
        for (group, r) in groups.filter(|(group, _)| group.coupled) {
            let sides = &self.internal_couplings[group.first..group.first + group.count];
            for side in sides {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let g_q = &self.coupling_data[side.start..][..2 * n];
                for (target, g) in r.iter_mut().zip(g_q.chunks_exact(n)) {
                    *target += inverse * dot_of(g, &q[at..at + n]);
                }
            }
            let z = &group.inverse;
            let zr = [z[0] * r[0] + z[1] * r[1], z[2] * r[0] + z[3] * r[1]];
            for side in sides {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let f_t = &self.coupling_data[side.start + 4 * n..][..2 * n];
                for (i, target) in work[at..at + n].iter_mut().enumerate() {
                    *target += f_t[i] * zr[0] + f_t[n + i] * zr[1];
                }
            }
        }
    }

    /// Returns the internal states by the speeds `u`; their right sides hold what positions bring already.
    #[inline(always)]
    fn substituted<const N: usize>(&mut self, u: &[f64], s: &mut [f64]) {
        let size = |n: usize| if N > 0 { N } else { n };
        let inverse = 1.0 / self.shift;
        for (group, r) in self.internal_pairs.iter().zip(s.chunks_exact_mut(2)) {
            let sides = &self.internal_couplings[group.first..group.first + group.count];
            for side in sides.iter().filter(|_| group.coupled) {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let (g_q, g_u) = self.coupling_data[side.start..side.start + 4 * n].split_at(2 * n);
                for row in 0..2 {
                    let (g_q, g_u) = (&g_q[row * n..][..n], &g_u[row * n..][..n]);
                    let speeds = &u[at..at + n];
                    r[row] += dot_of(g_u, speeds) + inverse * dot_of(g_q, speeds);
                }
            }
            let z = &group.inverse;
            let k = [z[0] * r[0] + z[1] * r[1], z[2] * r[0] + z[3] * r[1]];
            r.copy_from_slice(&k);
        }
    }
}
