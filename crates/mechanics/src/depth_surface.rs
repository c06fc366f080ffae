//! A surface of depths over two coordinates, with continuous curvature: the tensor product of cubic splines.
//!
//! It goes through the depths at the nodes of a rectangle. In each cell it is the bicubic Hermite polynomial
//! of depth, slopes and twist at its corners (de Boor 1962); these come from not-a-knot splines along the
//! lines of nodes, so that second derivatives are continuous. Beyond its edges it goes on straight.

use serde::{Deserialize, Serialize};

use crate::spline::{Spline, SplineError};

/// Depths over the tangents y and z of a surface, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DepthSurface {
    y: Vec<f64>,
    z: Vec<f64>,
    /// Depth, its derivatives by y and by z and by both, at each node: row by row along y, row after row
    /// along z.
    nodes: Vec<[f64; 4]>,
}

/// Depth and derivatives at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth, m.
    pub value: f64,
    /// Derivatives by y and z.
    pub slope: [f64; 2],
    /// Second derivatives by y twice, by both, by z twice, 1/m.
    pub second: [f64; 3],
}

impl DepthSurface {
    /// Returns the surface through `depths` at the places `y` and `z`: row by row along y, row after row
    /// along z.
    ///
    /// # Errors
    /// Fewer than four places along a coordinate, places that do not increase, too few depths, values that
    /// are not finite.
    pub fn new(y: Vec<f64>, z: Vec<f64>, depths: &[f64]) -> Result<Self, SplineError> {
        let (width, height) = (y.len(), z.len());
        if depths.len() != width * height {
            return Err(SplineError::Unequal {
                abscissae: width * height,
                ordinates: depths.len(),
            });
        }
        let slopes = |places: &[f64], values: Vec<f64>| -> Result<Vec<f64>, SplineError> {
            let spline = Spline::new(places.to_vec(), values)?;
            Ok(places.iter().map(|place| spline.evaluate(*place)[1]).collect())
        };
        let mut nodes: Vec<[f64; 4]> = depths.iter().map(|depth| [*depth, 0.0, 0.0, 0.0]).collect();
        for row in nodes.chunks_mut(width.max(1)) {
            let own = slopes(&y, row.iter().map(|node| node[0]).collect())?;
            for (node, slope) in row.iter_mut().zip(own) {
                node[1] = slope;
            }
        }
        for column in 0..width {
            for (from, to) in [(0, 2), (1, 3)] {
                let along = (0..height).map(|row| nodes[row * width + column][from]);
                for (row, slope) in slopes(&z, along.collect())?.into_iter().enumerate() {
                    nodes[row * width + column][to] = slope;
                }
            }
        }
        Ok(Self { y, z, nodes })
    }

    /// Returns depth and derivatives at a place.
    #[must_use]
    pub fn evaluate(&self, y: f64, z: f64) -> Depth {
        let ((i, along_y), (j, along_z)) = (basis(&self.y, y), basis(&self.z, z));
        let width = self.y.len();
        let mut sums = [[0.0; 3]; 3];
        for (row, by_z) in [(j, [0, 1]), (j + 1, [2, 3])] {
            for (column, by_y) in [(i, [0, 1]), (i + 1, [2, 3])] {
                let [f, fy, fz, fyz] = self.nodes[row * width + column];
                for (a, sums) in sums.iter_mut().enumerate() {
                    let [p, dp] = by_y.map(|k| along_y[a][k]);
                    for (b, sum) in sums.iter_mut().enumerate() {
                        let [q, dq] = by_z.map(|k| along_z[b][k]);
                        *sum += q * (p * f + dp * fy) + dq * (p * fz + dp * fyz);
                    }
                }
            }
        }
        Depth {
            value: sums[0][0],
            slope: [sums[1][0], sums[0][1]],
            second: [sums[2][0], sums[1][1], sums[0][2]],
        }
    }
}

/// Returns the interval of a place and the Hermite polynomials there, of value and slope at its beginning and
/// its end: their values, first and second derivatives. Beyond the ends they are straight.
fn basis(places: &[f64], place: f64) -> (usize, [[f64; 4]; 3]) {
    let last = places.len() - 2;
    let inside = place.clamp(places[0], places[last + 1]);
    let i = places
        .partition_point(|own| *own <= inside)
        .saturating_sub(1)
        .min(last);
    let h = places[i + 1] - places[i];
    let t = (inside - places[i]) / h;
    let (square, cube) = (t * t, t * t * t);
    let mut rows = [
        [
            1.0 - 3.0 * square + 2.0 * cube,
            h * (t - 2.0 * square + cube),
            3.0 * square - 2.0 * cube,
            h * (cube - square),
        ],
        [
            6.0 * (square - t) / h,
            1.0 - 4.0 * t + 3.0 * square,
            6.0 * (t - square) / h,
            3.0 * square - 2.0 * t,
        ],
        [
            (12.0 * t - 6.0) / (h * h),
            (6.0 * t - 4.0) / h,
            (6.0 - 12.0 * t) / (h * h),
            (6.0 * t - 2.0) / h,
        ],
    ];
    if inside != place {
        let [value, slope, second] = &mut rows;
        for (value, slope) in value.iter_mut().zip(slope) {
            *value += (place - inside) * *slope;
        }
        *second = [0.0; 4];
    }
    (i, rows)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64, f64) -> f64) -> DepthSurface {
        let (y, z) = (vec![-2.0, -1.2, 0.1, 0.9, 2.0], vec![-1.0, -0.2, 0.3, 1.0]);
        let depths: Vec<f64> = z.iter().flat_map(|z| y.iter().map(|y| f(*y, *z))).collect();
        DepthSurface::new(y, z, &depths).unwrap()
    }

    #[test]
    fn analytic_a_bicubic_is_met_with_all_its_derivatives() {
        let f =
            |y: f64, z: f64| 0.3 + 0.2 * y - z + y * y * (0.5 + z * z * z) - y * y * y * z + 0.4 * y * z * z;
        let surface = sampled(f);
        for (y, z) in [(-1.7, -0.9), (-0.3, 0.1), (0.1, 0.3), (1.9, 0.99)] {
            let Depth { value, slope, second } = surface.evaluate(y, z);
            assert!((value - f(y, z)).abs() < 1e-13);
            let by_y = 0.2 + 2.0 * y * (0.5 + z * z * z) - 3.0 * y * y * z + 0.4 * z * z;
            let by_z = -1.0 + 3.0 * y * y * z * z - y * y * y + 0.8 * y * z;
            assert!((slope[0] - by_y).abs() < 1e-12 && (slope[1] - by_z).abs() < 1e-12);
            let wanted = [
                2.0 * (0.5 + z * z * z) - 6.0 * y * z,
                6.0 * y * z * z - 3.0 * y * y + 0.8 * z,
                6.0 * y * y * z + 0.8 * y,
            ];
            for (second, wanted) in second.into_iter().zip(wanted) {
                assert!((second - wanted).abs() < 1e-11, "{second} {wanted}");
            }
        }
    }

    #[test]
    fn limits_it_is_smooth_at_nodes_and_straight_beyond_its_edges() {
        let surface = sampled(|y, z| libm::sin(2.0 * y) * libm::cos(3.0 * z));
        let near = |a: &Depth, b: &Depth| {
            let all = |d: &Depth| {
                [
                    d.value,
                    d.slope[0],
                    d.slope[1],
                    d.second[0],
                    d.second[1],
                    d.second[2],
                ]
            };
            all(a).iter().zip(all(b)).all(|(a, b)| (a - b).abs() < 1e-5)
        };
        for (y, z) in [(0.1, 0.3), (-1.2, -0.2), (0.9, 0.5)] {
            let [one, other] = [1e-9, -1e-9].map(|d| surface.evaluate(y + d, z + d));
            assert!(near(&one, &other), "{one:?} {other:?}");
        }
        let (edge, beyond) = (surface.evaluate(2.0, 0.4), surface.evaluate(2.5, 0.4));
        assert!((beyond.value - edge.value - 0.5 * edge.slope[0]).abs() < 1e-14);
        assert_eq!((beyond.slope[0], beyond.second[0]), (edge.slope[0], 0.0));
    }

    #[test]
    fn input_depths_that_make_no_surface_are_refused() {
        let four = vec![0.0, 1.0, 2.0, 3.0];
        assert!(DepthSurface::new(four.clone(), four.clone(), &[0.0; 16]).is_ok());
        assert!(DepthSurface::new(four.clone(), four.clone(), &[0.0; 15]).is_err());
        assert!(DepthSurface::new(four.clone(), vec![0.0, 1.0], &[0.0; 8]).is_err());
        assert!(DepthSurface::new(four, Vec::new(), &[]).is_err());
    }
}
