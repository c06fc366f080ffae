//! Factorization of block-sparse matrices with a symmetric block pattern.

use std::collections::BTreeSet;

use crate::dense_block::{eliminate, invert, multiply, subtract_product, subtract_row_product};

/// The matrix of a linear system is singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is singular in its diagonal block {block}")]
pub struct Singular {
    /// Index of the diagonal block without a usable pivot, in the caller's numbering.
    pub block: usize,
}

/// One elimination: a diagonal block and the later blocks to which it is coupled when it is eliminated.
#[derive(Clone, Debug)]
struct Pivot {
    /// Index of the block in the caller's numbering.
    block: usize,
    size: usize,
    /// First index of the block's part of a vector.
    row: usize,
    /// First index of the diagonal block in the storage.
    at: usize,
    /// First index of the row exchanges of a large block.
    exchange: usize,
    /// Range of its edges in `edges`.
    edges: (usize, usize),
    /// Range of its updates in `updates`.
    updates: (usize, usize),
}

/// A later block to which a pivot is coupled.
#[derive(Clone, Copy, Debug)]
struct Edge {
    size: usize,
    row: usize,
    /// First index of block (neighbour, pivot) in the storage.
    lower: usize,
    /// First index of block (pivot, neighbour) in the storage.
    upper: usize,
}

/// The update `target -= lower · upper`.
#[derive(Clone, Copy, Debug)]
struct Update {
    rows: usize,
    columns: usize,
    lower: usize,
    upper: usize,
    target: usize,
}

/// A block-sparse matrix with a symmetric block pattern and its LU factors.
///
/// The matrix is kept when it is factored. Blocks are eliminated in an order of minimum degree, found once;
/// rows are exchanged inside the diagonal blocks only, never between blocks. That suits matrices `shift·I -
/// J` whose diagonal blocks dominate for the shifts in use. Diagonal blocks up to 6×6 are inverted
/// (Gauss-Jordan with row exchange, whose forward error is that of Gaussian elimination: N. J. Higham,
/// *Accuracy and Stability of Numerical Algorithms*, section 14.4): a solution is then a product.
///
/// ```
/// use numerics::BlockLu;
/// let mut matrix = BlockLu::new(&[1, 2], &[(0, 1)]);
/// matrix.block_mut(0, 0).unwrap().copy_from_slice(&[2.0]);
/// matrix.block_mut(0, 1).unwrap().copy_from_slice(&[1.0, 0.0]);
/// matrix.block_mut(1, 0).unwrap().copy_from_slice(&[1.0, 0.0]);
/// matrix.block_mut(1, 1).unwrap().copy_from_slice(&[3.0, 0.0, 0.0, 4.0]);
/// matrix.factor().unwrap();
/// let mut b = [4.0, 7.0, 8.0];
/// matrix.solve(&mut b);
/// for (value, exact) in b.iter().zip([1.0, 2.0, 2.0]) {
///     assert!((value - exact).abs() < 1e-15);
/// }
/// ```
#[derive(Clone, Debug)]
pub struct BlockLu {
    dimension: usize,
    matrix: Vec<f64>,
    factors: Vec<f64>,
    exchanges: Vec<usize>,
    /// Indices of the diagonal elements in the storage.
    diagonal: Vec<usize>,
    /// First index and number of values of each block.
    slots: Vec<(usize, usize)>,
    /// For each block row, its blocks by column: (column, slot, allocated by fill only).
    rows: Vec<Vec<(usize, usize, bool)>>,
    pivots: Vec<Pivot>,
    edges: Vec<Edge>,
    updates: Vec<Update>,
}

impl BlockLu {
    /// Returns a zero matrix of diagonal blocks of the given sizes, coupled as in `couplings` (each coupling
    /// stands for both blocks `(i, j)` and `(j, i)`; repetitions and `(i, i)` are allowed).
    ///
    /// # Panics
    /// If a coupling names a block that does not exist.
    #[must_use]
    pub fn new(sizes: &[usize], couplings: &[(usize, usize)]) -> Self {
        let count = sizes.len();
        let mut starts = Vec::with_capacity(count);
        let mut dimension = 0;
        for &size in sizes {
            starts.push(dimension);
            dimension += size;
        }
        let mut neighbours: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); count];
        for &(i, j) in couplings {
            assert!(i < count && j < count, "coupling ({i}, {j}) of {count} blocks");
            if i != j {
                neighbours[i].insert(j);
                neighbours[j].insert(i);
            }
        }
        let original = neighbours.clone();

        let mut this = Self {
            dimension,
            matrix: Vec::new(),
            factors: Vec::new(),
            exchanges: Vec::new(),
            diagonal: Vec::with_capacity(dimension),
            slots: Vec::new(),
            rows: vec![Vec::new(); count],
            pivots: Vec::with_capacity(count),
            edges: Vec::new(),
            updates: Vec::new(),
        };
        // The order of elimination, the fill, and the storage, pivot by pivot.
        let mut remaining: BTreeSet<usize> = (0..count).collect();
        let mut used = 0;
        let mut eliminations = Vec::with_capacity(count);
        while let Some(pivot) = remaining
            .iter()
            .copied()
            .min_by_key(|&i| neighbours[i].iter().map(|&j| sizes[j]).sum::<usize>())
        {
            remaining.remove(&pivot);
            let later = std::mem::take(&mut neighbours[pivot]);
            for &i in &later {
                neighbours[i].remove(&pivot);
                for &j in &later {
                    if i != j {
                        neighbours[i].insert(j);
                    }
                }
            }
            let mut store = |i: usize, j: usize, fill| {
                this.rows[i].push((j, this.slots.len(), fill));
                this.slots.push((used, sizes[i] * sizes[j]));
                used += sizes[i] * sizes[j];
            };
            store(pivot, pivot, false);
            for &i in &later {
                let fill = !original[pivot].contains(&i);
                store(i, pivot, fill);
                store(pivot, i, fill);
            }
            eliminations.push((pivot, later));
        }
        for row in &mut this.rows {
            row.sort_unstable_by_key(|entry| entry.0);
        }
        this.matrix = vec![0.0; used];
        this.factors = vec![0.0; used];

        // The program of the numerical phases.
        for (pivot, later) in eliminations {
            let (edges, updates) = (this.edges.len(), this.updates.len());
            for &i in &later {
                let (lower, upper) = (this.place(i, pivot), this.place(pivot, i));
                this.edges.push(Edge {
                    size: sizes[i],
                    row: starts[i],
                    lower,
                    upper,
                });
                for &j in &later {
                    let (upper, target) = (this.place(pivot, j), this.place(i, j));
                    this.updates.push(Update {
                        rows: sizes[i],
                        columns: sizes[j],
                        lower,
                        upper,
                        target,
                    });
                }
            }
            let at = this.place(pivot, pivot);
            this.pivots.push(Pivot {
                block: pivot,
                size: sizes[pivot],
                row: starts[pivot],
                at,
                exchange: this.exchanges.len(),
                edges: (edges, this.edges.len()),
                updates: (updates, this.updates.len()),
            });
            this.diagonal
                .extend((0..sizes[pivot]).map(|k| at + k * (sizes[pivot] + 1)));
            if sizes[pivot] > 6 {
                this.exchanges.resize(this.exchanges.len() + sizes[pivot], 0);
            }
        }
        this
    }

    /// Returns the slot of a block of the pattern, fill included.
    fn place(&self, i: usize, j: usize) -> usize {
        match self.rows[i].binary_search_by_key(&j, |entry| entry.0) {
            Ok(k) => self.slots[self.rows[i][k].1].0,
            Err(_) => unreachable!("the symbolic phase allocates all fill"),
        }
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// Returns the number of stored values, fill included.
    #[must_use]
    pub fn stored(&self) -> usize {
        self.matrix.len()
    }

    /// Returns the slot of block `(i, j)` for [`BlockLu::at_mut`], valid as long as the matrix lives; none
    /// outside the pattern.
    #[must_use]
    pub fn find(&self, i: usize, j: usize) -> Option<usize> {
        let row = self.rows.get(i)?;
        let &(_, slot, fill) = &row[row.binary_search_by_key(&j, |entry| entry.0).ok()?];
        (!fill).then_some(slot)
    }

    /// As [`BlockLu::find`], for a block in the pattern.
    ///
    /// # Panics
    /// Outside the pattern.
    #[must_use]
    pub fn slot(&self, i: usize, j: usize) -> usize {
        self.find(i, j)
            .unwrap_or_else(|| panic!("block ({i}, {j}) is not in the pattern"))
    }

    /// Returns the block in a slot, row by row.
    #[inline]
    pub fn at_mut(&mut self, slot: usize) -> &mut [f64] {
        let (start, length) = self.slots[slot];
        &mut self.matrix[start..][..length]
    }

    /// Returns block `(i, j)` of the matrix, row by row, in the caller's numbering; none outside the pattern.
    #[must_use]
    pub fn block_mut(&mut self, i: usize, j: usize) -> Option<&mut [f64]> {
        self.find(i, j).map(|slot| self.at_mut(slot))
    }

    /// Sets the matrix to zero.
    pub fn clear(&mut self) {
        self.matrix.fill(0.0);
    }

    /// Factors the matrix.
    ///
    /// # Errors
    /// If a diagonal block is singular (or not finite) when it is eliminated.
    pub fn factor(&mut self) -> Result<(), Singular> {
        self.factors.copy_from_slice(&self.matrix);
        self.decompose()
    }

    /// Factors `shift·I - matrix`.
    ///
    /// # Errors
    /// If a diagonal block is singular (or not finite) when it is eliminated.
    #[inline]
    pub fn factor_shifted(&mut self, shift: f64) -> Result<(), Singular> {
        for (factor, value) in self.factors.iter_mut().zip(&self.matrix) {
            *factor = -value;
        }
        for &at in &self.diagonal {
            self.factors[at] += shift;
        }
        self.decompose()
    }

    fn decompose(&mut self) -> Result<(), Singular> {
        let factors = &mut self.factors[..];
        for pivot in &self.pivots {
            let n = pivot.size;
            let regular = if n <= 6 {
                invert(n, &mut factors[pivot.at..][..n * n])
            } else {
                eliminate(
                    n,
                    &mut factors[pivot.at..][..n * n],
                    &mut self.exchanges[pivot.exchange..][..n],
                )
            };
            if !regular {
                return Err(Singular { block: pivot.block });
            }
            for edge in &self.edges[pivot.edges.0..pivot.edges.1] {
                // the blocks of a pivot follow its diagonal block
                let (diagonal, rest) = factors[pivot.at..].split_at_mut(n * n);
                let lower = &mut rest[edge.lower - pivot.at - n * n..][..edge.size * n];
                if n <= 6 {
                    for row in lower.chunks_exact_mut(n) {
                        multiply_row(n, row, diagonal);
                    }
                } else {
                    let exchanges = &self.exchanges[pivot.exchange..][..n];
                    for row in lower.chunks_exact_mut(n) {
                        crate::dense_block::solve_transposed(n, diagonal, exchanges, row);
                    }
                }
            }
            for update in &self.updates[pivot.updates.0..pivot.updates.1] {
                // Targets belong to later pivots, which are stored after this one.
                let (done, later) = factors.split_at_mut(update.target);
                subtract_product(
                    update.rows,
                    n,
                    update.columns,
                    &done[update.lower..][..update.rows * n],
                    &done[update.upper..][..n * update.columns],
                    &mut later[..update.rows * update.columns],
                );
            }
        }
        Ok(())
    }

    /// Solves in place with the factors of the last successful factorization; `b` is in the caller's order.
    ///
    /// # Panics
    /// If `b` has not as many elements as the matrix has rows.
    #[inline]
    pub fn solve(&self, b: &mut [f64]) {
        assert_eq!(b.len(), self.dimension, "length of the right-hand side");
        if let [only] = &self.pivots[..] {
            self.solve_diagonal(only, b);
            return;
        }
        for pivot in &self.pivots {
            for edge in &self.edges[pivot.edges.0..pivot.edges.1] {
                let lower = &self.factors[edge.lower..][..edge.size * pivot.size];
                subtract_row_product(lower, pivot.size, b, pivot.row, edge.row);
            }
        }
        for pivot in self.pivots.iter().rev() {
            for edge in &self.edges[pivot.edges.0..pivot.edges.1] {
                let upper = &self.factors[edge.upper..][..edge.size * pivot.size];
                subtract_row_product(upper, edge.size, b, edge.row, pivot.row);
            }
            self.solve_diagonal(pivot, &mut b[pivot.row..][..pivot.size]);
        }
    }

    #[inline(always)]
    fn solve_diagonal(&self, pivot: &Pivot, b: &mut [f64]) {
        let n = pivot.size;
        let diagonal = &self.factors[pivot.at..][..n * n];
        if n <= 6 {
            multiply(n, diagonal, b);
        } else {
            crate::dense_block::solve(n, diagonal, &self.exchanges[pivot.exchange..][..n], b);
        }
    }
}

/// `row = row · matrix`, at most 6 columns.
#[inline(always)]
fn multiply_row(n: usize, row: &mut [f64], matrix: &[f64]) {
    let mut old = [0.0; 6];
    old[..n].copy_from_slice(row);
    row.fill(0.0);
    for (value, line) in old.iter().zip(matrix.chunks_exact(n)) {
        for (target, m) in row.iter_mut().zip(line) {
            *target += value * m;
        }
    }
}
