//! Lines of equal height over a grid, by marching squares.

/// A grid of heights: `heights[i * y.len() + j]` stands at `(x[i], y[j])`; heights that are not finite are
/// holes.
#[derive(Clone, Copy, Debug)]
pub struct HeightGrid<'g> {
    /// Abscissae, increasing.
    pub x: &'g [f64],
    /// Ordinates, increasing.
    pub y: &'g [f64],
    /// Heights.
    pub heights: &'g [f64],
}

type Point = (f64, f64);

/// Returns the lines at this height, straight between the edges of cells.
#[must_use]
pub fn lines(grid: &HeightGrid<'_>, level: f64) -> Vec<Vec<Point>> {
    let columns = grid.y.len();
    let at = |i: usize, j: usize| (grid.x[i], grid.y[j], grid.heights[i * columns + j]);
    let mut pieces: Vec<[Point; 2]> = Vec::new();
    for i in 1..grid.x.len() {
        for j in 1..columns {
            let corners = [at(i - 1, j - 1), at(i, j - 1), at(i, j), at(i - 1, j)];
            if corners.iter().any(|corner| !corner.2.is_finite()) {
                continue;
            }
            let crossings: Vec<Point> = (0..4)
                .filter_map(|k| crossing(corners[k], corners[(k + 1) % 4], level))
                .collect();
            match crossings.as_slice() {
                [a, b] => pieces.push([*a, *b]),
                // A saddle: what the middle says decides which corners belong together.
                [a, b, c, d] => {
                    let middle = corners.iter().map(|corner| corner.2).sum::<f64>() / 4.0;
                    if (middle >= level) == (corners[0].2 >= level) {
                        pieces.extend([[*a, *b], [*c, *d]]);
                    } else {
                        pieces.extend([[*d, *a], [*b, *c]]);
                    }
                }
                _ => {}
            }
        }
    }
    joined(pieces)
}

/// Returns the point where the height passes the level between two corners; the same bits whichever comes
/// first.
fn crossing(a: (f64, f64, f64), b: (f64, f64, f64), level: f64) -> Option<Point> {
    if (a.2 >= level) == (b.2 >= level) {
        return None;
    }
    let (a, b) = if (a.0, a.1) <= (b.0, b.1) { (a, b) } else { (b, a) };
    let share = (level - a.2) / (b.2 - a.2);
    Some((a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)))
}

/// Joins pieces at their common ends.
fn joined(mut pieces: Vec<[Point; 2]>) -> Vec<Vec<Point>> {
    let mut lines = Vec::new();
    while let Some([a, b]) = pieces.pop() {
        let mut line = std::collections::VecDeque::from([a, b]);
        loop {
            let (first, last) = (line[0], line[line.len() - 1]);
            let found = pieces
                .iter()
                .position(|[a, b]| [*a, *b].iter().any(|end| *end == first || *end == last));
            let Some(place) = found else { break };
            let [a, b] = pieces.swap_remove(place);
            match (a, b) {
                (a, b) if a == last => line.push_back(b),
                (a, b) if b == last => line.push_back(a),
                (a, b) if a == first => line.push_front(b),
                (a, _) => line.push_front(a),
            }
        }
        lines.push(line.into());
    }
    lines
}

/// About so many round heights between the least and the greatest.
#[must_use]
pub fn round_levels(heights: &[f64], about: usize) -> Vec<f64> {
    let finite = heights.iter().copied().filter(|height| height.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), height| {
        (low.min(height), high.max(height))
    });
    // Rounding is no height.
    let size = low.abs().max(high.abs());
    if high.is_nan() || high - low <= 1e-9 * size || !(high - low).is_finite() {
        return Vec::new();
    }
    let least = (high - low) / about as f64;
    let power = libm::pow(10.0, libm::log10(least).floor());
    let factors = [1.0, 2.0, 2.5, 5.0, 10.0];
    let step = factors
        .iter()
        .map(|factor| factor * power)
        .find(|step| *step >= least)
        .unwrap_or(10.0 * power);
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|number| number as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_lines_of_a_plane_are_straight() {
        let x = [0.0, 1.0, 3.0];
        let y = [0.0, 2.0];
        // z = x + 10 y
        let heights: Vec<f64> = x.iter().flat_map(|x| y.map(|y| x + 10.0 * y)).collect();
        let grid = HeightGrid {
            x: &x,
            y: &y,
            heights: &heights,
        };
        let found = lines(&grid, 12.0);
        assert_eq!(found.len(), 1);
        for (x, y) in &found[0] {
            assert!((x + 10.0 * y - 12.0).abs() < 1e-12);
        }
        assert_eq!(found[0].len(), 3);
        assert!(lines(&grid, 30.0).is_empty());
        assert_eq!(round_levels(&heights, 5), [0.0, 5.0, 10.0, 15.0, 20.0]);
    }

    #[test]
    fn limits_holes_and_flat_ground_have_no_lines() {
        let (x, y) = ([0.0, 1.0], [0.0, 1.0]);
        let grid = |heights| HeightGrid {
            x: &x,
            y: &y,
            heights,
        };
        assert!(lines(&grid(&[0.0, 1.0, f64::NAN, 1.0]), 0.5).is_empty());
        assert!(lines(&grid(&[1.0; 4]), 1.0).is_empty());
        assert!(round_levels(&[1.0; 4], 6).is_empty() && round_levels(&[f64::NAN], 6).is_empty());
        // A saddle gives two lines.
        assert_eq!(lines(&grid(&[1.0, 0.0, 0.0, 1.0]), 0.4).len(), 2);
    }
}
