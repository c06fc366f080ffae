//! Kernels for small dense blocks, stored row by row.

/// Inverts a block of at most 6×6 in place; returns false if it is singular.
#[inline(always)]
pub(crate) fn invert(n: usize, a: &mut [f64]) -> bool {
    match n {
        0 => true,
        1 => invert_fixed::<1>(a),
        2 => invert_fixed::<2>(a),
        3 => invert_fixed::<3>(a),
        4 => invert_fixed::<4>(a),
        5 => invert_fixed::<5>(a),
        6 => invert_fixed::<6>(a),
        _ => unreachable!("larger blocks are not inverted"),
    }
}

/// Gauss-Jordan elimination with row exchange.
#[inline]
fn invert_fixed<const N: usize>(values: &mut [f64]) -> bool {
    let (rows, _) = values.as_chunks_mut::<N>();
    let Ok(a) = <&mut [[f64; N]; N]>::try_from(rows) else {
        return false;
    };
    let mut m = *a;
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    let mut exchanged = false;
    // written out, so that the matrix stays in registers
    let regular = (N == 0 || eliminate_column::<N>(0, &mut m, &mut order, &mut exchanged))
        && (N < 2 || eliminate_column::<N>(1, &mut m, &mut order, &mut exchanged))
        && (N < 3 || eliminate_column::<N>(2, &mut m, &mut order, &mut exchanged))
        && (N < 4 || eliminate_column::<N>(3, &mut m, &mut order, &mut exchanged))
        && (N < 5 || eliminate_column::<N>(4, &mut m, &mut order, &mut exchanged))
        && (N < 6 || eliminate_column::<N>(5, &mut m, &mut order, &mut exchanged));
    if exchanged {
        for (target, row) in a.iter_mut().zip(&m) {
            for k in 0..N {
                target[order[k] % N] = row[k];
            }
        }
    } else {
        *a = m;
    }
    regular
}

#[inline(always)]
fn eliminate_column<const N: usize>(
    k: usize,
    m: &mut [[f64; N]; N],
    order: &mut [usize; N],
    exchanged: &mut bool,
) -> bool {
    for i in k + 1..N {
        if m[i][k].abs() > m[k][k].abs() {
            m.swap(i, k);
            order.swap(i, k);
            *exchanged = true;
        }
    }
    let size = m[k][k].abs();
    if !(size > 0.0 && size < f64::INFINITY) {
        return false;
    }
    let inverse = 1.0 / m[k][k];
    let mut row = m[k];
    row[k] = 1.0;
    for value in &mut row {
        *value *= inverse;
    }
    for i in 0..N {
        if i != k {
            let factor = m[i][k];
            m[i][k] = 0.0;
            for j in 0..N {
                m[i][j] -= factor * row[j];
            }
        }
    }
    m[k] = row;
    true
}

/// Writes `b = a·b` for a block of at most 6×6.
#[inline(always)]
pub(crate) fn multiply(n: usize, a: &[f64], b: &mut [f64]) {
    match n {
        0 => {}
        1 => multiply_fixed::<1>(a, b),
        2 => multiply_fixed::<2>(a, b),
        3 => multiply_fixed::<3>(a, b),
        4 => multiply_fixed::<4>(a, b),
        5 => multiply_fixed::<5>(a, b),
        6 => multiply_fixed::<6>(a, b),
        _ => unreachable!("larger blocks are not inverted"),
    }
}

#[inline(always)]
fn multiply_fixed<const N: usize>(a: &[f64], b: &mut [f64]) {
    let (rows, _) = a.as_chunks::<N>();
    if let (Ok(rows), Ok(b)) = (<&[[f64; N]; N]>::try_from(rows), <&mut [f64; N]>::try_from(b)) {
        let old = *b;
        for (value, row) in b.iter_mut().zip(rows) {
            *value = dot(row, &old);
        }
    }
}

#[inline(always)]
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum += a[i] * b[i];
    }
    sum
}

/// Subtracts `a·b` from `c`, with `a` of m×k, `b` of k×n.
#[inline]
pub(crate) fn subtract_product(m: usize, k: usize, n: usize, a: &[f64], b: &[f64], c: &mut [f64]) {
    if m == n && n == k {
        match n {
            1 => return subtract_product_fixed::<1>(a, b, c),
            2 => return subtract_product_fixed::<2>(a, b, c),
            3 => return subtract_product_fixed::<3>(a, b, c),
            4 => return subtract_product_fixed::<4>(a, b, c),
            5 => return subtract_product_fixed::<5>(a, b, c),
            6 => return subtract_product_fixed::<6>(a, b, c),
            _ => {}
        }
    }
    if k == 0 || n == 0 {
        return;
    }
    for (line, target) in a.chunks_exact(k).zip(c.chunks_exact_mut(n)) {
        for (factor, row) in line.iter().zip(b.chunks_exact(n)) {
            for (value, r) in target.iter_mut().zip(row) {
                *value -= factor * r;
            }
        }
    }
}

#[inline]
fn subtract_product_fixed<const N: usize>(a: &[f64], b: &[f64], c: &mut [f64]) {
    let (a, b, c) = (
        a.as_chunks::<N>().0,
        b.as_chunks::<N>().0,
        c.as_chunks_mut::<N>().0,
    );
    let Ok(b) = <&[[f64; N]; N]>::try_from(b) else {
        return;
    };
    for (line, target) in a.iter().zip(c) {
        let mut sum = *target;
        for i in 0..N {
            for j in 0..N {
                sum[j] -= line[i] * b[i][j];
            }
        }
        *target = sum;
    }
}

/// Subtracts `a · b[from..][..columns]` from `b[to..]`.
#[inline]
pub(crate) fn subtract_row_product(a: &[f64], columns: usize, b: &mut [f64], from: usize, to: usize) {
    if columns == 0 {
        return;
    }
    let (source, target) = if from < to {
        let (low, high) = b.split_at_mut(to);
        (&low[from..][..columns], high)
    } else {
        let (low, high) = b.split_at_mut(from);
        (&high[..columns], &mut low[to..])
    };
    for (line, value) in a.chunks_exact(columns).zip(target) {
        let mut sum = 0.0;
        for (x, y) in line.iter().zip(source) {
            sum += x * y;
        }
        *value -= sum;
    }
}

/// LU decomposition with row exchange, in place; the diagonal holds the reciprocals of the pivots.
pub(crate) fn eliminate(n: usize, a: &mut [f64], exchanges: &mut [usize]) -> bool {
    for k in 0..n {
        let mut best = k;
        let mut size = a[k * n + k].abs();
        for i in k + 1..n {
            if a[i * n + k].abs() > size {
                best = i;
                size = a[i * n + k].abs();
            }
        }
        if !(size > 0.0 && size < f64::INFINITY) {
            return false;
        }
        exchanges[k] = best;
        if best != k {
            let (head, tail) = a.split_at_mut(best * n);
            head[k * n..][..n].swap_with_slice(&mut tail[..n]);
        }
        let inverse = 1.0 / a[k * n + k];
        a[k * n + k] = inverse;
        let (head, tail) = a.split_at_mut((k + 1) * n);
        let row = &head[k * n + k + 1..];
        for line in tail.chunks_exact_mut(n) {
            let factor = line[k] * inverse;
            line[k] = factor;
            if factor != 0.0 {
                for (value, r) in line[k + 1..].iter_mut().zip(row) {
                    *value -= factor * r;
                }
            }
        }
    }
    true
}

/// Solves `A x = b` in place after [`eliminate`].
pub(crate) fn solve(n: usize, a: &[f64], exchanges: &[usize], b: &mut [f64]) {
    for (k, &best) in exchanges.iter().enumerate() {
        b.swap(k, best);
    }
    for (i, line) in a.chunks_exact(n).enumerate() {
        let sum: f64 = line[..i].iter().zip(&b[..i]).map(|(x, y)| x * y).sum();
        b[i] -= sum;
    }
    for (i, line) in a.chunks_exact(n).enumerate().rev() {
        let sum: f64 = line[i + 1..].iter().zip(&b[i + 1..]).map(|(x, y)| x * y).sum();
        b[i] = (b[i] - sum) * line[i];
    }
}

/// Solves `x A = b` in place after [`eliminate`].
pub(crate) fn solve_transposed(n: usize, a: &[f64], exchanges: &[usize], b: &mut [f64]) {
    for (i, line) in a.chunks_exact(n).enumerate() {
        b[i] *= line[i];
        let factor = b[i];
        for (value, u) in b[i + 1..].iter_mut().zip(&line[i + 1..]) {
            *value -= factor * u;
        }
    }
    for (i, line) in a.chunks_exact(n).enumerate().rev() {
        let factor = b[i];
        for (value, l) in b[..i].iter_mut().zip(&line[..i]) {
            *value -= factor * l;
        }
    }
    for (k, &best) in exchanges.iter().enumerate().rev() {
        b.swap(k, best);
    }
}

/// Returns the dot product of two vectors.
#[inline(always)]
pub(crate) fn dot_of(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Adds `factor · A x` to `y`, for a square block.
#[inline(always)]
pub(crate) fn multiply_add(n: usize, a: &[f64], x: &[f64], factor: f64, y: &mut [f64]) {
    match n {
        1 => fixed_multiply_add::<1>(a, x, factor, y),
        2 => fixed_multiply_add::<2>(a, x, factor, y),
        3 => fixed_multiply_add::<3>(a, x, factor, y),
        4 => fixed_multiply_add::<4>(a, x, factor, y),
        5 => fixed_multiply_add::<5>(a, x, factor, y),
        6 => fixed_multiply_add::<6>(a, x, factor, y),
        _ => rectangle_add(&a[..n * n], x, factor, y),
    }
}

#[inline(always)]
fn fixed_multiply_add<const N: usize>(a: &[f64], x: &[f64], factor: f64, y: &mut [f64]) {
    let (x, y) = (&x[..N], &mut y[..N]);
    for (row, y) in a[..N * N].chunks_exact(N).zip(y) {
        let mut sum = 0.0;
        for j in 0..N {
            sum += row[j] * x[j];
        }
        *y += factor * sum;
    }
}

/// Adds `factor · A x` to `y`, for a block of any shape.
#[inline(always)]
pub(crate) fn rectangle_add(a: &[f64], x: &[f64], factor: f64, y: &mut [f64]) {
    for (row, y) in a.chunks_exact(x.len()).zip(y) {
        *y += factor * dot_of(row, x);
    }
}
