//! Figures keep their peaks and their styles.

use drawing::{Figure, Panel, PlotCurve};
use report::figures;

#[test]
fn a_hundred_thousand_points_keep_their_peaks_and_become_small() {
    let mut points: Vec<(f64, f64)> = (0..100_000)
        .map(|i| (f64::from(i) * 1e-4, (f64::from(i) * 0.01).sin()))
        .collect();
    points[43_210].1 = 9.5;
    points[78_901].1 = -8.5;
    let figure = Figure {
        title: "peaks".to_owned(),
        panels: vec![Panel {
            x_label: "time (s)".to_owned(),
            y_label: "force (lbf)".to_owned(),
            curves: vec![PlotCurve {
                label: "curve".to_owned(),
                points,
                ..Default::default()
            }],
            ..Default::default()
        }],
        ..Figure::default()
    };
    let svg = figure.to_svg();
    assert!(svg.len() < 100_000, "{} bytes", svg.len());
    let curve = svg.split(" d=\"M").nth(1).unwrap().split('"').next().unwrap();
    let heights: Vec<f64> = curve
        .split('L')
        .map(|point| point.split_whitespace().nth(1).unwrap().parse().unwrap())
        .collect();
    // The axis reaches 5 % of the range beyond the extremes, so that the peaks lie at 1/22 and 21/22 of its
    // height.
    let top = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let bottom = heights.iter().copied().fold(0.0, f64::max);
    let middle = heights[0];
    let share = (middle - top) / (bottom - top);
    assert!((share - 9.5 / 18.0).abs() < 0.003, "{share}");
}

#[test]
fn styles_of_toe_are_the_same_everywhere() {
    let (out, none, inward) = (
        figures::toe_style(0.2_f64.to_radians()),
        figures::toe_style(0.0),
        figures::toe_style(-(0.2_f64.to_radians())),
    );
    assert_eq!(
        [out.0.as_str(), none.0.as_str(), inward.0.as_str()],
        ["toe out 0.2°", "no toe", "toe in 0.2°"]
    );
    assert!(out.1 != none.1 && none.1 != inward.1 && out.2 != none.2 && none.2 != inward.2);
}
