//! Vectors and matrices of three.

/// A vector.
pub type V = [f64; 3];
/// A matrix, by rows.
pub type M = [V; 3];

/// Returns the sum.
#[inline(always)]
pub fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns the difference.
#[inline(always)]
pub fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the cross product.
#[inline(always)]
pub fn cross(a: V, b: V) -> V {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Returns the inner product.
#[inline(always)]
pub fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns m v.
#[inline(always)]
pub fn times(m: &M, v: V) -> V {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// Returns mᵀ v.
#[inline(always)]
pub fn back(m: &M, v: V) -> V {
    std::array::from_fn(|k| m[0][k] * v[0] + m[1][k] * v[1] + m[2][k] * v[2])
}

/// Returns a b.
#[inline(always)]
pub fn product(a: &M, b: &M) -> M {
    a.map(|row| back(b, row))
}

/// Returns aᵀ b.
#[inline(always)]
pub fn back_product(a: &M, b: &M) -> M {
    std::array::from_fn(|i| back(b, [a[0][i], a[1][i], a[2][i]]))
}

/// Returns the matrix of a rotation from its unit quaternion.
#[inline(always)]
pub fn rotation([w, x, y, z]: [f64; 4]) -> M {
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// Returns the rate of the unit quaternion of a body that turns at `rate` (rad/s, in its own axes).
#[inline(always)]
pub fn quaternion_rate([w, x, y, z]: [f64; 4], [p, q, r]: V) -> [f64; 4] {
    [
        0.5 * (-x * p - y * q - z * r),
        0.5 * (w * p + y * r - z * q),
        0.5 * (w * q + z * p - x * r),
        0.5 * (w * r + x * q - y * p),
    ]
}
