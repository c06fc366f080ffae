//! Curves made small before they are drawn, without losing peaks.

/// Thins a curve that will be drawn over `columns` columns of width.
///
/// Of all points that follow each other within one column, the first, the lowest, the highest and the last
/// are kept, in their order: within the width of one column nothing can be seen to change. Curves may turn
/// back, as loops do. Points that are not finite are kept, since they interrupt the line.
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

/// Returns the part of a curve whose abscissae lie in a window; where it crosses the window's edges it is cut
/// by a straight line, and where it leaves the window it is interrupted.
#[must_use]
pub fn window(points: &[(f64, f64)], (left, right): (f64, f64)) -> Vec<(f64, f64)> {
    const GAP: (f64, f64) = (f64::NAN, f64::NAN);
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let inside = |x: f64| x >= left && x <= right;
    for (index, point) in points.iter().enumerate() {
        let Some(before) = index.checked_sub(1).map(|index| points[index]) else {
            if inside(point.0) {
                kept.push(*point);
            }
            continue;
        };
        if !(before.0.is_finite() && point.0.is_finite()) {
            kept.push(if inside(point.0) { *point } else { GAP });
            continue;
        }
        let at = |x: f64| {
            let share = (x - before.0) / (point.0 - before.0);
            (x, before.1 + share * (point.1 - before.1))
        };
        let (low, high) = (left.max(before.0.min(point.0)), right.min(before.0.max(point.0)));
        if low <= high {
            let rising = before.0 <= point.0;
            let (enter, leave) = if rising { (low, high) } else { (high, low) };
            if !inside(before.0) && enter != point.0 {
                kept.push(at(enter));
            }
            if inside(point.0) {
                kept.push(*point);
            } else if leave != before.0 {
                kept.push(at(leave));
            }
        }
        if !inside(point.0) && inside(before.0) {
            kept.push(GAP);
        }
    }
    while kept.last().is_some_and(|point| point.0.is_nan()) {
        kept.pop();
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::{thin, window};

    #[test]
    fn a_window_cuts_at_its_edges() {
        let line: Vec<(f64, f64)> = (0..=10).map(|i| (f64::from(i), 2.0 * f64::from(i))).collect();
        assert_eq!(
            window(&line, (2.5, 5.0)),
            [(2.5, 5.0), (3.0, 6.0), (4.0, 8.0), (5.0, 10.0)]
        );
        assert_eq!(window(&line, (2.25, 2.75)), [(2.25, 4.5), (2.75, 5.5)]);
        assert!(window(&line, (20.0, 30.0)).is_empty());
        let there_and_back = [(0.0, 0.0), (4.0, 4.0), (0.0, 8.0)];
        let cut = window(&there_and_back, (0.0, 2.0));
        assert_eq!((cut[0], cut[1]), ((0.0, 0.0), (2.0, 2.0)));
        assert!(cut[2].0.is_nan());
        assert_eq!((cut[3], cut[4]), ((2.0, 6.0), (0.0, 8.0)));
    }

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
