//! The linear algebra of second-order systems: positions, speeds, internal states and quadratures.
//!
//! The state is `x = (q, u, s, w)` with
//!
//! ```text
//! q˙ = u,   M u˙ = f(t, q, u, s),   s˙ = g(t, q, u, s),   w˙ = p(t, q, u, s),
//! ```
//!
//! blocks of q and u by body, M block diagonal, the internal states in pairs, each pair coupled to itself and to at
//! most two bodies. A linearly implicit step solves `(σ I - J) k = r` many times. Here
//!
//! - positions are eliminated: `k_q = (r_q + k_u)/σ`;
//! - internal pairs are eliminated: `k_s = Z (r_s + G_q k_q + G_u k_u)`, `Z = (σ I - A)⁻¹`, 2 × 2;
//! - quadratures are substituted forward: `k_w = (r_w + P_q k_q + P_u k_u + P_s k_s)/σ`;
//!
//! and what is factored is one block row a body,
//! `W = σ M - D - K/σ - F Z (G_u + G_q/σ)`, with `K = ∂(f - M u˙)/∂q`, `D = ∂f/∂u`, `F = ∂f/∂s`, `A = ∂g/∂s`.

pub use crate::layout::{Layout, Structure};

mod single;

use self::single::{Single, Source};
use crate::block_lu::BlockLu;
use crate::dense_block::{dot_of, multiply_add, rectangle_add};
use crate::error::Singular;

/// The structured Jacobian of a second-order system, and its factors.
#[derive(Clone, Debug)]
pub struct Partitioned {
    sizes: Vec<usize>,
    offsets: Vec<usize>,
    mass_starts: Vec<usize>,
    speeds: usize,
    internals: usize,
    quadratures: usize,
    pairs: Vec<Pair>,
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    groups: Vec<Group>,
    sides: Vec<Side>,
    side_data: Vec<f64>,
    rows: Vec<Row>,
    row_data: Vec<f64>,
    internal_rows: Vec<InternalRow>,
    lu: BlockLu,
    /// Number of coordinates of every body, 0 where they differ.
    uniform: usize,
    /// What stands in for all of the factors where there is one small body and no internal state.
    single: Option<Single>,
    shift: f64,
    work: Vec<f64>,
}

/// A coupling block `(row, column)` of K and D.
#[derive(Clone, Copy, Debug)]
struct Pair {
    row: usize,
    column: usize,
    start: usize,
    slot: usize,
}

/// A pair of internal states.
#[derive(Clone, Copy, Debug, Default)]
struct Group {
    /// `∂g/∂s`, row-major.
    own: [f64; 4],
    /// `(σ I - A)⁻¹`.
    inverse: [f64; 4],
    /// First side and number of sides.
    first: usize,
    count: usize,
}

/// The coupling of a pair of internal states to one body: `G_q` (2 × n), `G_u` (2 × n), `Fᵀ` (2 × n).
#[derive(Clone, Copy, Debug)]
struct Side {
    body: usize,
    start: usize,
}

/// The derivative of one quadrature by one body's positions (n) and speeds (n).
#[derive(Clone, Copy, Debug)]
struct Row {
    quadrature: usize,
    body: usize,
    start: usize,
}

/// The derivative of one quadrature by a pair of internal states.
#[derive(Clone, Copy, Debug)]
struct InternalRow {
    quadrature: usize,
    group: usize,
    values: [f64; 2],
}

impl Partitioned {
    /// An empty Jacobian of this structure.
    #[must_use]
    pub fn new(structure: &Structure) -> Self {
        let sizes = structure.bodies.clone();
        let starts = |part: &dyn Fn(usize) -> usize| -> Vec<usize> {
            sizes
                .iter()
                .scan(0, |at, n| {
                    let start = *at;
                    *at += part(*n);
                    Some(start)
                })
                .collect()
        };
        let offsets = starts(&|n| n);
        let mass_starts = starts(&|n| n * n);
        let speeds: usize = sizes.iter().sum();
        let mut couplings: Vec<(usize, usize)> = (0..sizes.len()).map(|i| (i, i)).collect();
        let mut couple = |i: usize, j: usize| {
            for pair in [(i, j), (j, i)] {
                if !couplings.contains(&pair) {
                    couplings.push(pair);
                }
            }
        };
        for &(i, j) in &structure.couplings {
            couple(i, j);
        }
        for bodies in &structure.internal_pairs {
            for &i in bodies {
                for &j in bodies {
                    couple(i, j);
                }
            }
        }
        let lu = BlockLu::new(&sizes, &couplings);
        let mut entries = 0;
        let mut pairs = Vec::new();
        for &(row, column) in &couplings {
            pairs.push(Pair {
                row,
                column,
                start: entries,
                slot: lu.slot(row, column),
            });
            entries += sizes[row] * sizes[column];
        }
        let (mut groups, mut sides, mut side_entries) = (Vec::new(), Vec::new(), 0);
        for bodies in &structure.internal_pairs {
            groups.push(Group {
                first: sides.len(),
                count: bodies.len(),
                ..Group::default()
            });
            for &body in bodies {
                sides.push(Side {
                    body,
                    start: side_entries,
                });
                side_entries += 6 * sizes[body];
            }
        }
        let (mut rows, mut row_entries) = (Vec::new(), 0);
        for &(quadrature, body) in &structure.quadrature_bodies {
            rows.push(Row {
                quadrature,
                body,
                start: row_entries,
            });
            row_entries += 2 * sizes[body];
        }
        let internal_rows = structure
            .quadrature_pairs
            .iter()
            .map(|&(quadrature, group)| InternalRow {
                quadrature,
                group,
                values: [0.0; 2],
            })
            .collect();
        Self {
            mass: vec![0.0; sizes.iter().map(|n| n * n).sum()],
            stiffness: vec![0.0; entries],
            damping: vec![0.0; entries],
            side_data: vec![0.0; side_entries],
            row_data: vec![0.0; row_entries],
            single: match sizes[..] {
                [size] if groups.is_empty() => Single::new(size, structure.quadratures),
                _ => None,
            },
            internals: 2 * groups.len(),
            quadratures: structure.quadratures,
            work: vec![0.0; speeds],
            uniform: sizes
                .iter()
                .copied()
                .reduce(|a, b| if a == b { a } else { 0 })
                .unwrap_or(0),
            sizes,
            offsets,
            mass_starts,
            speeds,
            pairs,
            groups,
            sides,
            rows,
            internal_rows,
            lu,
            shift: 0.0,
        }
    }

    /// The parts of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        Layout {
            speeds: self.speeds,
            internals: self.internals,
            quadratures: self.quadratures,
        }
    }

    /// The place of the coupling block of two bodies, for [`Partitioned::blocks_mut`].
    ///
    /// # Panics
    /// If the structure does not couple them.
    #[must_use]
    pub fn pair(&self, row: usize, column: usize) -> usize {
        match self
            .pairs
            .iter()
            .position(|pair| (pair.row, pair.column) == (row, column))
        {
            Some(index) => index,
            None => panic!("bodies {row} and {column} are not coupled"),
        }
    }

    /// The same, or none where the structure does not couple them.
    #[must_use]
    pub fn find_pair(&self, row: usize, column: usize) -> Option<usize> {
        let same = |pair: &Pair| (pair.row, pair.column) == (row, column);
        self.pairs.iter().position(same)
    }

    /// Sets all derivatives to zero.
    pub fn clear(&mut self) {
        self.stiffness.fill(0.0);
        self.damping.fill(0.0);
        self.side_data.fill(0.0);
        self.row_data.fill(0.0);
        for group in &mut self.groups {
            group.own = [0.0; 4];
        }
        for row in &mut self.internal_rows {
            row.values = [0.0; 2];
        }
    }

    /// The mass matrix of a body, row-major.
    #[inline(always)]
    pub fn mass_mut(&mut self, body: usize) -> &mut [f64] {
        let n = self.sizes[body];
        &mut self.mass[self.mass_starts[body]..][..n * n]
    }

    /// The blocks of K and D with this index (see [`Partitioned::pair`]), row-major.
    #[inline(always)]
    pub fn blocks_mut(&mut self, pair: usize) -> (&mut [f64], &mut [f64]) {
        let Pair {
            row, column, start, ..
        } = self.pairs[pair];
        let length = self.sizes[row] * self.sizes[column];
        (
            &mut self.stiffness[start..][..length],
            &mut self.damping[start..][..length],
        )
    }

    /// `∂g/∂s` of a pair of internal states, row-major 2 × 2.
    #[inline(always)]
    pub fn internal_mut(&mut self, group: usize) -> &mut [f64; 4] {
        &mut self.groups[group].own
    }

    /// `G_q`, `G_u` and `Fᵀ` (each 2 × n, row-major) of a pair of internal states and its side number `side`.
    #[inline(always)]
    pub fn side_mut(&mut self, group: usize, side: usize) -> [&mut [f64]; 3] {
        let Side { body, start } = self.sides[self.groups[group].first + side];
        let n = 2 * self.sizes[body];
        let (g_q, rest) = self.side_data[start..start + 3 * n].split_at_mut(n);
        let (g_u, f_t) = rest.split_at_mut(n);
        [g_q, g_u, f_t]
    }

    /// The derivative of a quadrature by a body's positions and speeds; `row` counts the structure's
    /// `quadrature_bodies`.
    #[inline(always)]
    pub fn row_mut(&mut self, row: usize) -> (&mut [f64], &mut [f64]) {
        let Row { body, start, .. } = self.rows[row];
        let n = self.sizes[body];
        self.row_data[start..start + 2 * n].split_at_mut(n)
    }

    /// The derivative of a quadrature by a pair of internal states; `row` counts `quadrature_pairs`.
    #[inline(always)]
    pub fn internal_row_mut(&mut self, row: usize) -> &mut [f64; 2] {
        &mut self.internal_rows[row].values
    }

    /// Factors `shift · I - J`.
    ///
    /// # Errors
    /// The matrix is singular.
    pub fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.shift = shift;
        if let Some((single, source)) = self.single() {
            let regular = single.factor(shift, source);
            return regular.then_some(()).ok_or(Singular { block: 0 });
        }
        let inverse = 1.0 / shift;
        self.lu.clear();
        for &Pair {
            row,
            column,
            start,
            slot,
        } in &self.pairs
        {
            let n = self.sizes[row] * self.sizes[column];
            let block = self.lu.at_mut(slot);
            let (k, d) = (&self.stiffness[start..][..n], &self.damping[start..][..n]);
            if row == column {
                let m = &self.mass[self.mass_starts[row]..][..n];
                for (((w, m), k), d) in block.iter_mut().zip(m).zip(k).zip(d) {
                    *w = shift * m - d - inverse * k;
                }
            } else {
                for ((w, k), d) in block.iter_mut().zip(k).zip(d) {
                    *w = -d - inverse * k;
                }
            }
        }
        for index in 0..self.groups.len() {
            self.eliminate(index, shift, inverse)?;
        }
        self.lu.factor()
    }

    /// Eliminates a pair of internal states from the speed rows.
    fn eliminate(&mut self, index: usize, shift: f64, inverse: f64) -> Result<(), Singular> {
        let group = &mut self.groups[index];
        let [a, b, c, d] = [
            shift - group.own[0],
            -group.own[1],
            -group.own[2],
            shift - group.own[3],
        ];
        let determinant = a * d - b * c;
        if determinant == 0.0 || !determinant.is_finite() {
            return Err(Singular { block: index });
        }
        let z = [d, -b, -c, a].map(|entry| entry / determinant);
        group.inverse = z;
        let sides = &self.sides[group.first..group.first + group.count];
        for column in sides {
            let n = self.sizes[column.body];
            let data = &self.side_data[column.start..][..4 * n];
            let g = |row: usize, j: usize| data[2 * n + row * n + j] + inverse * data[row * n + j];
            for row in sides {
                let m = self.sizes[row.body];
                let f_t = &self.side_data[row.start + 4 * m..][..2 * m];
                let block = self.lu.at_mut(self.lu.slot(row.body, column.body));
                for j in 0..n {
                    let (g0, g1) = (g(0, j), g(1, j));
                    let (z0, z1) = (z[0] * g0 + z[1] * g1, z[2] * g0 + z[3] * g1);
                    for i in 0..m {
                        block[i * n + j] -= f_t[i] * z0 + f_t[m + i] * z1;
                    }
                }
            }
        }
        Ok(())
    }

    /// What stands in where there is one small body, and what it factors.
    fn single(&mut self) -> Option<(&mut Single, Source<'_>)> {
        let source = Source {
            mass: &self.mass,
            stiffness: &self.stiffness,
            damping: &self.damping,
            rows: &self.rows,
            row_data: &self.row_data,
        };
        self.single.as_mut().map(|single| (single, source))
    }

    /// Solves `(shift · I - J) y = b` in place.
    #[inline]
    pub fn solve(&mut self, b: &mut [f64]) {
        if let Some(single) = &self.single {
            single.solve(b);
            return;
        }
        self.solve_any(b);
    }

    fn solve_any(&mut self, b: &mut [f64]) {
        // Loops of a known length are unrolled: where all bodies have the same number of coordinates.
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

    /// The same, where all bodies have `N` coordinates; `N = 0` stands for any numbers.
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
        for &Pair {
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
        for (index, group) in self.groups.iter().enumerate() {
            let sides = &self.sides[group.first..group.first + group.count];
            let r = &mut s[2 * index..2 * index + 2];
            for side in sides {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let g_q = &self.side_data[side.start..][..2 * n];
                for (target, g) in r.iter_mut().zip(g_q.chunks_exact(n)) {
                    *target += inverse * dot_of(g, &q[at..at + n]);
                }
            }
            let z = &group.inverse;
            let zr = [z[0] * r[0] + z[1] * r[1], z[2] * r[0] + z[3] * r[1]];
            for side in sides {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let f_t = &self.side_data[side.start + 4 * n..][..2 * n];
                for (i, target) in work[at..at + n].iter_mut().enumerate() {
                    *target += f_t[i] * zr[0] + f_t[n + i] * zr[1];
                }
            }
        }
        self.lu.solve(work);
        // Back: speeds, positions, internal states, quadratures. The internal right sides hold G_q r_q/σ already.
        for ((q, u), k) in q.iter_mut().zip(u.iter_mut()).zip(work.iter()) {
            *u = *k;
            *q = (*q + *k) * inverse;
        }
        for (index, group) in self.groups.iter().enumerate() {
            let r = &mut s[2 * index..2 * index + 2];
            for side in &self.sides[group.first..group.first + group.count] {
                let (at, n) = (self.offsets[side.body], size(self.sizes[side.body]));
                let (g_q, g_u) = self.side_data[side.start..side.start + 4 * n].split_at(2 * n);
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
        for row in &self.rows {
            let (at, n) = (self.offsets[row.body], size(self.sizes[row.body]));
            let (p_q, p_u) = self.row_data[row.start..row.start + 2 * n].split_at(n);
            w[row.quadrature] += dot_of(p_q, &q[at..at + n]) + dot_of(p_u, &u[at..at + n]);
        }
        for row in &self.internal_rows {
            w[row.quadrature] += dot_of(&row.values, &s[2 * row.group..2 * row.group + 2]);
        }
        for k in w.iter_mut() {
            *k *= inverse;
        }
    }
}
