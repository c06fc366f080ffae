//! Figures of the cases beyond the thesis show what the runs say.

use drawing::{Figure, Panel};
use report::figures::CaseOutcome;
use reproduction::figures::groups::{self, GROUPS};
use study::case::builtin;
use study::run::Run;

fn ran(group: &str) -> Vec<CaseOutcome> {
    let cases = builtin::group(group).unwrap().cases.iter();
    cases
        .map(|built_in| {
            let case = builtin::case(&built_in.name).unwrap();
            let result = Run::new(&case).unwrap().finish(|_| ());
            (case, result)
        })
        .collect()
}

fn figure(group: &str) -> Figure {
    let figure = groups::figure(group, &ran(group)).unwrap();
    let about = builtin::group(group).unwrap();
    assert_eq!(
        (figure.title.as_str(), figure.caption.as_str()),
        (about.title, about.look_at)
    );
    for panel in &figure.panels {
        assert!(
            !panel.x_label.contains("()") && !panel.y_label.contains("()"),
            "{panel:?}"
        );
        for curve in &panel.curves {
            assert!(
                curve.points.len() >= 2,
                "{group}: {} in {}",
                curve.label,
                panel.title
            );
            assert!(curve.points.iter().all(|(x, y)| x.is_finite() && y.is_finite()));
        }
    }
    assert!(figure.to_svg().contains("<desc>"));
    figure
}

fn points<'p>(panel: &'p Panel, label: &str) -> &'p [(f64, f64)] {
    &panel
        .curves
        .iter()
        .find(|curve| curve.label == label)
        .unwrap()
        .points
}

#[test]
fn every_group_beyond_the_thesis_has_a_figure() {
    let groups: Vec<&str> = builtin::groups().iter().skip(1).map(|group| group.name).collect();
    assert_eq!(groups, GROUPS);
    for (group, panels) in GROUPS.into_iter().zip([3, 2, 4, 2, 2, 2, 2, 2, 2]) {
        assert_eq!(figure(group).panels.len(), panels, "{group}");
    }
    assert!(groups::figure("warp", &[]).is_none());
    assert!(groups::figure("thesis", &ran("rig")).is_none());
}

#[test]
fn the_warp_moment_lies_within_its_limit() {
    for panel in figure("warp").panels {
        let most = |label: &str| {
            let curves = panel.curves.iter().filter(|curve| curve.label == label);
            let points = curves.flat_map(|curve| &curve.points);
            points.fold(0.0_f64, |most, (_, y)| most.max(y.abs()))
        };
        assert!(most("moment") > 2e4, "{}", panel.title);
        assert!(most("moment") < 1.005 * most("limit N_c h3/2"), "{}", panel.title);
    }
}

/// The sweep's damping lies near the quasi-static one: W/(π ω A²) with the forces of the table in theory.md.
#[test]
fn the_sweep_lies_near_the_quasi_static_wedge() {
    let figure = figure("sweep");
    for panel in &figure.panels[..2] {
        for amplitude in ["0.25 in", "0.5 in", "1 in"] {
            let found = points(panel, amplitude);
            let expected = points(panel, &format!("{amplitude}, quasi-static"));
            for ((f, c), (g, e)) in found.iter().zip(expected) {
                assert_eq!(f, g);
                assert!(
                    (c / e - 1.0).abs() < 0.2,
                    "{} {amplitude} {f} Hz: {c} {e}",
                    panel.title
                );
            }
        }
    }
    let one = points(&figure.panels[0], "1 in, quasi-static")[1];
    // On the bolster the toe's share of the normal forces, 5411.3 and 2869.7 lbf, acts too.
    let between = 2164.5 + 1147.9 + (5411.3 - 2869.7) * 0.2_f64.to_radians().sin();
    let pi = std::f64::consts::PI;
    let by_hand = 2.0 * between * (3652.2 / 3702.2) / (pi * 2.0 * pi);
    assert!(
        (one.0 - 1.0).abs() < 1e-3 && (one.1 / by_hand - 1.0).abs() < 1e-3,
        "{one:?} {by_hand}"
    );
}

#[test]
fn the_rise_lies_near_the_closed_form() {
    let figure = figure("wear");
    for damping in ["constant damping", "variable damping"] {
        let found = points(&figure.panels[0], damping);
        let expected = points(&figure.panels[0], &format!("{damping}, closed form"));
        assert_eq!((found[0], expected[0]), ((0.0, 0.0), (0.0, 0.0)));
        for ((depth, rise), (_, closed)) in found.iter().zip(expected).skip(1) {
            assert!(
                (0.93..1.0).contains(&(rise / closed)),
                "{damping} {depth}: {rise} {closed}"
            );
        }
        // Every depth of wear costs damping.
        let energy = points(&figure.panels[1], damping);
        assert!(energy.windows(2).all(|pair| pair[1].1 < pair[0].1), "{energy:?}");
    }
}
