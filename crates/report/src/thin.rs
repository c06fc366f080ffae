//! Curves made small before they are drawn, without losing peaks.

/// Thins a curve that will be drawn over `columns` columns of width.
///
/// Of all points that follow each other within one column, the first, the lowest, the highest and the last are kept, in
/// their order: within the width of one column nothing can be seen to change. Curves may turn back, as loops do.
/// Points that are not finite are kept, since they interrupt the line.
#[must_use]
pub fn thin(points: &[(f64, f64)], columns: u32) -> Vec<(f64, f64)> {
    let finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
    let (left, right) = points
        .iter()
        .filter(|point| finite(point))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(left, right), (x, _)| {
            (left.min(*x), right.max(*x))
        });
    let width = (right - left) / f64::from(columns);
    let column = |point: &(f64, f64)| {
        if !finite(point) {
            None
        } else if width > 0.0 {
            Some(((point.0 - left) / width).floor())
        } else {
            Some(0.0)
        }
    };
    let mut kept = Vec::new();
    let mut start = 0;
    while start < points.len() {
        let own = column(&points[start]);
        let mut end = start + 1;
        let (mut lowest, mut highest) = (start, start);
        while end < points.len() && own.is_some() && column(&points[end]) == own {
            if points[end].1 < points[lowest].1 {
                lowest = end;
            }
            if points[end].1 > points[highest].1 {
                highest = end;
            }
            end += 1;
        }
        let mut of_column = [start, lowest, highest, end - 1];
        of_column.sort_unstable();
        for (place, index) in of_column.into_iter().enumerate() {
            if place == 0 || of_column[place - 1] != index {
                kept.push(points[index]);
            }
        }
        start = end;
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::thin;

    #[test]
    fn peaks_and_ends_stay() {
        let mut points: Vec<(f64, f64)> = (0..100_000)
            .map(|i| (f64::from(i), (f64::from(i) * 0.37).sin()))
            .collect();
        points[31_415].1 = 17.0;
        points[77_777].1 = -23.0;
        let thinned = thin(&points, 800);
        assert!(thinned.len() <= 4 * 801, "{}", thinned.len());
        assert!(thinned.contains(&points[31_415]) && thinned.contains(&points[77_777]));
        assert_eq!((thinned.first(), thinned.last()), (points.first(), points.last()));
        assert!(thinned.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn every_column_keeps_its_lowest_and_highest() {
        let points: Vec<(f64, f64)> = (0..10_000)
            .map(|i| (f64::from(i), f64::from((i * 7919) % 10_007)))
            .collect();
        let thinned = thin(&points, 100);
        for column in 0..100 {
            let (left, right) = (f64::from(column) * 99.99, f64::from(column + 1) * 99.99);
            let of = |points: &[(f64, f64)]| {
                let inside = points.iter().filter(|p| p.0 >= left && p.0 < right).map(|p| p.1);
                inside.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
                    (low.min(y), high.max(y))
                })
            };
            assert_eq!(of(&points), of(&thinned), "column {column}");
        }
    }

    #[test]
    fn loops_keep_both_branches() {
        let points: Vec<(f64, f64)> = (0..=200_000)
            .map(|i| {
                let t = f64::from(i) * 1e-4;
                (t.sin(), t.cos())
            })
            .collect();
        let thinned = thin(&points, 500);
        assert!(thinned.len() < 20_000);
        // At every x in the middle there are points high and low.
        for k in -9..=9 {
            let x = f64::from(k) * 0.1;
            let near = |sign: f64| thinned.iter().any(|p| (p.0 - x).abs() < 0.01 && p.1 * sign > 0.4);
            assert!(near(1.0) && near(-1.0), "{x}");
        }
    }

    #[test]
    fn odd_curves_survive() {
        assert!(thin(&[], 10).is_empty());
        assert_eq!(thin(&[(1.0, 2.0)], 10), [(1.0, 2.0)]);
        let vertical = [(1.0, 0.0), (1.0, 5.0), (1.0, -5.0), (1.0, 1.0), (1.0, 2.0)];
        assert_eq!(
            thin(&vertical, 10),
            [(1.0, 0.0), (1.0, 5.0), (1.0, -5.0), (1.0, 2.0)]
        );
        let gap = [(0.0, 0.0), (f64::NAN, 1.0), (1.0, 1.0)];
        assert_eq!(thin(&gap, 10).len(), 3);
    }
}
