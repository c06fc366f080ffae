//! The linear algebra of second-order systems: positions, speeds, internal states and quadratures.
//!
//! The state is `x = (q, u, s, w)` with
//!
//! ```text
//! q˙ = u,   M u˙ = f(t, q, u, s),   s˙ = g(t, q, u, s),   w˙ = p(t, q, u, s),
//! ```
//!
//! blocks of q and u by body, M block diagonal, the internal states in pairs, each pair coupled to itself and
//! to at most two bodies. A linearly implicit step solves `(σ I - J) k = r` many times. Here
//!
//! - positions are eliminated: `k_q = (r_q + k_u)/σ`;
//! - internal pairs are eliminated: `k_s = Z (r_s + G_q k_q + G_u k_u)`, `Z = (σ I - A)⁻¹`, 2 × 2;
//! - quadratures are substituted forward: `k_w = (r_w + P_q k_q + P_u k_u + P_s k_s)/σ`;
//!
//! and what is factored is one block row a body,
//! `W = σ M - D - K/σ - F Z (G_u + G_q/σ)`, with `K = ∂(f - M u˙)/∂q`, `D = ∂f/∂u`, `F = ∂f/∂s`, `A = ∂g/∂s`.

mod solve;
mod structure;

pub use structure::{Layout, Structure};

use structure::QuadratureOfBody;

use crate::block_lu::BlockLu;
use crate::block_lu::Singular;

/// The structured Jacobian of a second-order system, and its factors.
#[derive(Clone, Debug)]
pub struct Partitioned {
    sizes: Vec<usize>,
    offsets: Vec<usize>,
    mass_starts: Vec<usize>,
    speeds: usize,
    internals: usize,
    quadratures: usize,
    pairs: Vec<CouplingBlock>,
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    internal_pairs: Vec<InternalPair>,
    internal_couplings: Vec<InternalCoupling>,
    coupling_data: Vec<f64>,
    quadratures_of_bodies: Vec<QuadratureOfBody>,
    row_data: Vec<f64>,
    quadratures_of_pairs: Vec<QuadratureOfPair>,
    lu: BlockLu,
    /// Number of coordinates of every body; 0: they differ.
    uniform: usize,
    /// Number of coordinates of every body that a pair of internal states is coupled to; 0: they differ.
    internal_uniform: usize,
    shift: f64,
    work: Vec<f64>,
}

/// A coupling block `(row, column)` of K and D.
#[derive(Clone, Copy, Debug)]
struct CouplingBlock {
    row: usize,
    column: usize,
    start: usize,
    slot: usize,
}

/// A pair of internal states.
#[derive(Clone, Copy, Debug, Default)]
struct InternalPair {
    /// `∂g/∂s`, row-major.
    own: [f64; 4],
    /// `(σ I - A)⁻¹`.
    inverse: [f64; 4],
    /// First coupling and number of couplings.
    first: usize,
    count: usize,
    /// False if all couplings are zero, as those of a contact point that does not touch.
    coupled: bool,
}

/// The coupling of a pair of internal states to one body: `G_q` (2 × n), `G_u` (2 × n), `Fᵀ` (2 × n).
#[derive(Clone, Copy, Debug)]
struct InternalCoupling {
    body: usize,
    start: usize,
}

/// The derivative of one quadrature by a pair of internal states.
#[derive(Clone, Copy, Debug)]
struct QuadratureOfPair {
    quadrature: usize,
    group: usize,
    values: [f64; 2],
}

/// Returns the number that all are, else 0.
fn same(numbers: &mut dyn Iterator<Item = usize>) -> usize {
    numbers.reduce(|a, b| if a == b { a } else { 0 }).unwrap_or(0)
}

impl Partitioned {
    /// Returns a zero Jacobian of this structure.
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
            pairs.push(CouplingBlock {
                row,
                column,
                start: entries,
                slot: lu.slot(row, column),
            });
            entries += sizes[row] * sizes[column];
        }
        let (mut groups, mut sides, mut side_entries) = (Vec::new(), Vec::new(), 0);
        for bodies in &structure.internal_pairs {
            groups.push(InternalPair {
                first: sides.len(),
                count: bodies.len(),
                ..InternalPair::default()
            });
            for &body in bodies {
                sides.push(InternalCoupling {
                    body,
                    start: side_entries,
                });
                side_entries += 6 * sizes[body];
            }
        }
        let (mut rows, mut row_entries) = (Vec::new(), 0);
        for &(quadrature, body) in &structure.quadrature_bodies {
            rows.push(QuadratureOfBody {
                quadrature,
                body,
                start: row_entries,
            });
            row_entries += 2 * sizes[body];
        }
        let internal_rows = structure
            .quadrature_pairs
            .iter()
            .map(|&(quadrature, group)| QuadratureOfPair {
                quadrature,
                group,
                values: [0.0; 2],
            })
            .collect();
        Self {
            mass: vec![0.0; sizes.iter().map(|n| n * n).sum()],
            stiffness: vec![0.0; entries],
            damping: vec![0.0; entries],
            coupling_data: vec![0.0; side_entries],
            row_data: vec![0.0; row_entries],
            internals: 2 * groups.len(),
            quadratures: structure.quadratures,
            work: vec![0.0; speeds],
            uniform: same(&mut sizes.iter().copied()),
            internal_uniform: same(&mut sides.iter().map(|side: &InternalCoupling| sizes[side.body])),
            sizes,
            offsets,
            mass_starts,
            speeds,
            pairs,
            internal_pairs: groups,
            internal_couplings: sides,
            quadratures_of_bodies: rows,
            quadratures_of_pairs: internal_rows,
            lu,
            shift: 0.0,
        }
    }

    /// Returns the parts of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        Layout {
            speeds: self.speeds,
            internals: self.internals,
            quadratures: self.quadratures,
        }
    }

    /// Returns the index of the coupling block of two bodies, for [`Partitioned::blocks_mut`].
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

    /// As [`Partitioned::pair`]; none if the structure does not couple them.
    #[must_use]
    pub fn find_pair(&self, row: usize, column: usize) -> Option<usize> {
        let same = |pair: &CouplingBlock| (pair.row, pair.column) == (row, column);
        self.pairs.iter().position(same)
    }

    /// Sets all derivatives to zero.
    pub fn clear(&mut self) {
        self.stiffness.fill(0.0);
        self.damping.fill(0.0);
        self.coupling_data.fill(0.0);
        self.row_data.fill(0.0);
        for group in &mut self.internal_pairs {
            group.own = [0.0; 4];
        }
        for row in &mut self.quadratures_of_pairs {
            row.values = [0.0; 2];
        }
    }

    /// Returns the mass matrix of a body, row-major.
    #[inline(always)]
    pub fn mass_mut(&mut self, body: usize) -> &mut [f64] {
        let n = self.sizes[body];
        &mut self.mass[self.mass_starts[body]..][..n * n]
    }

    /// Returns the blocks of K and D with this index (see [`Partitioned::pair`]), row-major.
    #[inline(always)]
    pub fn blocks_mut(&mut self, pair: usize) -> (&mut [f64], &mut [f64]) {
        let CouplingBlock {
            row, column, start, ..
        } = self.pairs[pair];
        let length = self.sizes[row] * self.sizes[column];
        (
            &mut self.stiffness[start..][..length],
            &mut self.damping[start..][..length],
        )
    }

    /// Returns `∂g/∂s` of a pair of internal states, row-major 2 × 2.
    #[inline(always)]
    pub fn internal_mut(&mut self, group: usize) -> &mut [f64; 4] {
        &mut self.internal_pairs[group].own
    }

    /// Returns `G_q`, `G_u` and `Fᵀ` (each 2 × n, row-major) of a pair of internal states and its body number
    /// `side`.
    #[inline(always)]
    pub fn side_mut(&mut self, group: usize, side: usize) -> [&mut [f64]; 3] {
        let InternalCoupling { body, start } =
            self.internal_couplings[self.internal_pairs[group].first + side];
        let n = 2 * self.sizes[body];
        let (g_q, rest) = self.coupling_data[start..start + 3 * n].split_at_mut(n);
        let (g_u, f_t) = rest.split_at_mut(n);
        [g_q, g_u, f_t]
    }

    /// Returns the derivatives of a quadrature by a body's positions and by its speeds; `row` is an index
    /// into the structure's `quadrature_bodies`.
    #[inline(always)]
    pub fn row_mut(&mut self, row: usize) -> (&mut [f64], &mut [f64]) {
        let QuadratureOfBody { body, start, .. } = self.quadratures_of_bodies[row];
        let n = self.sizes[body];
        self.row_data[start..start + 2 * n].split_at_mut(n)
    }

    /// Returns the derivative of a quadrature by a pair of internal states; `row` is an index into
    /// `quadrature_pairs`.
    #[inline(always)]
    pub fn internal_row_mut(&mut self, row: usize) -> &mut [f64; 2] {
        &mut self.quadratures_of_pairs[row].values
    }

    /// Returns whether a pair of internal states was coupled to a body in the last factorization.
    #[must_use]
    pub fn is_coupled(&self, group: usize) -> bool {
        self.internal_pairs[group].coupled
    }

    /// Factors `shift · I - J`.
    ///
    /// # Errors
    /// If the matrix is singular.
    pub fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.shift = shift;
        let inverse = 1.0 / shift;
        self.lu.clear();
        for &CouplingBlock {
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
        for index in 0..self.internal_pairs.len() {
            match self.internal_uniform {
                6 => self.eliminate::<6>(index, shift, inverse),
                _ => self.eliminate::<0>(index, shift, inverse),
            }?;
        }
        self.lu.factor()
    }

    /// Eliminates a pair of internal states from the speed rows. Its bodies have `N` coordinates; `N = 0`
    /// stands for any numbers.
    #[inline(always)]
    fn eliminate<const N: usize>(&mut self, index: usize, shift: f64, inverse: f64) -> Result<(), Singular> {
        let size = |n: usize| if N > 0 { N } else { n };
        let group = &mut self.internal_pairs[index];
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
        let sides = &self.internal_couplings[group.first..group.first + group.count];
        group.coupled = sides.iter().any(|side| {
            let n = size(self.sizes[side.body]);
            self.coupling_data[side.start..][..6 * n]
                .iter()
                .any(|own| *own != 0.0)
        });
        if !group.coupled {
            return Ok(());
        }
        for column in sides {
            let n = size(self.sizes[column.body]);
            let (g_q, g_u) = self.coupling_data[column.start..][..4 * n].split_at(2 * n);
            // Z (G_u + G_q/σ), row by row; bodies have six coordinates at most.
            let mut zg = [[0.0; 6]; 2];
            for k in 0..n {
                let (g0, g1) = (g_u[k] + inverse * g_q[k], g_u[n + k] + inverse * g_q[n + k]);
                (zg[0][k], zg[1][k]) = (z[0] * g0 + z[1] * g1, z[2] * g0 + z[3] * g1);
            }
            for row in sides {
                let m = size(self.sizes[row.body]);
                let f_t = &self.coupling_data[row.start + 4 * m..][..2 * m];
                let block = &mut self.lu.at_mut(self.lu.slot(row.body, column.body))[..m * n];
                for (i, line) in block.chunks_exact_mut(n).enumerate() {
                    for ((entry, first), second) in line.iter_mut().zip(&zg[0]).zip(&zg[1]) {
                        *entry -= f_t[i] * first + f_t[m + i] * second;
                    }
                }
            }
        }
        Ok(())
    }
}
