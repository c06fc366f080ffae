//! The jam maps of studies, from made-up runs.

use std::path::Path;

use drawing::PlotCurve;
use report::figures::Exhibit;
use report::figures::jam::maps;
use report::study_digest::Digest;
use study::design::Study;
use study::measures::{Measures, of_wedges};
use study::records::{Record, Status};

const STUDY: &str = "case = \"cdrun_toe_out_0.2_psi_0.012\"\nsampling = \"full_factorial\"\n[vary]\n\
    wedge.angle = { from = \"24 deg\", to = \"48 deg\", count = 9 }\n\
    friction.column = { from = 0.1, to = 0.6, count = 6, also = [\"friction.slope\"] }\n\
    side_frame.toe = [\"0.2 deg in\", \"0.2 deg out\"]\n";

/// Returns the maps of a study whose runs have this ratio of forces while the bolster falls.
fn maps_of(text: &str, ratio: impl Fn(u64) -> f64) -> Vec<Exhibit> {
    let study = Study::parse("some.toml", text, Path::new("")).unwrap();
    let mut digest = Digest::new(&study);
    let place = of_wedges().place("column_force_ratio_down");
    for number in 0..study.count() {
        let mut measures = Measures(vec![f64::NAN; of_wedges().len()]);
        measures.0[place.unwrap()] = ratio(number);
        let record = Record {
            number,
            status: Status::Complete,
            reason: String::new(),
            measures,
        };
        digest.add(&study, &study.values(number), &record);
    }
    maps(&study, &digest)
}

fn curves<'e>(exhibit: &'e Exhibit, panel: usize, label: &str) -> Vec<&'e PlotCurve> {
    let curves = exhibit.figure.panels[panel].curves.iter();
    curves.filter(|curve| curve.label == label).collect()
}

const LINE: &str = "massless wedge jams left of this";

/// With equal frictions and toe in the massless wedge jams, while the bolster falls, where θ + φ = 2 atan μ;
/// never while it rises, nor with toe out.
#[test]
fn analytic_the_jam_line_is_where_the_margin_ends() {
    let maps = maps_of(STUDY, |_| 1.0);
    assert_eq!(
        maps.iter().map(|map| map.name.as_str()).collect::<Vec<_>>(),
        ["jam_map_toe_in", "jam_map_toe_out"]
    );
    let lines = curves(&maps[0], 0, LINE);
    assert_eq!(lines.len(), 1);
    assert!(lines[0].points.len() > 50);
    for (angle, friction) in &lines[0].points {
        assert!((angle - 0.2 - 2.0 * friction.atan().to_degrees()).abs() < 1e-9);
    }
    for (map, panel) in [(0, 1), (1, 0), (1, 1)] {
        assert!(curves(&maps[map], panel, LINE).is_empty());
    }
}

/// The massless wedge's lines lie where its force says so: with μ = 0 it would be cos θ / sin(θ + φ) of the
/// load at any angle; with friction, cos ψ cos(θ - ψ) / sin(θ + φ - 2ψ).
#[test]
fn analytic_the_lines_of_the_massless_wedge_are_its_force() {
    let maps = maps_of(STUDY, |_| 1.0);
    let lines = curves(&maps[0], 0, "massless wedge");
    assert_eq!(lines.len(), maps[0].figure.panels[0].marks.len());
    let toe = -(0.2_f64.to_radians());
    let mut seen = 0;
    for (line, mark) in lines.iter().zip(&maps[0].figure.panels[0].marks) {
        let level: f64 = mark.text.trim_matches(['(', ')']).parse().unwrap();
        for (angle, friction) in line.points.iter().filter(|point| point.0.is_finite()) {
            let (theta, psi) = (angle.to_radians(), friction.atan());
            let force = psi.cos() * (theta - psi).cos() / (theta + toe - 2.0 * psi).sin() * toe.cos();
            // Lines are straight between points of a grid; the force grows without bound towards the jam.
            assert!(
                (1.0 / force - 1.0 / level).abs() < 2e-3,
                "{angle} {friction}: {force} at {level}"
            );
            seen += 1;
        }
    }
    assert!(seen > 500);
}

/// Runs with toe in and toe out do not mix: each map has its own heights.
#[test]
fn limits_maps_hold_the_runs_of_their_toe() {
    // Even numbers have toe in (the last parameter changes fastest): their force grows with the angle,
    // through 1.
    let maps = maps_of(STUDY, |number| match number % 2 {
        0 => 0.6 + 0.1 * (number / 12) as f64,
        _ => 7.0,
    });
    assert!(curves(&maps[1], 0, "computed").is_empty());
    let lines = curves(&maps[0], 0, "computed");
    assert_eq!(lines.len(), 1);
    // 24 deg and 3 deg for each tenth.
    for (angle, _) in lines[0].points.iter().filter(|point| point.0.is_finite()) {
        assert!((angle - 36.0).abs() < 1e-9, "{angle}");
    }
    // Without a toe that is varied there is the map of the case's only.
    let one = STUDY.replace("side_frame.toe = [\"0.2 deg in\", \"0.2 deg out\"]\n", "");
    let maps = maps_of(&one, |_| 1.0);
    assert_eq!(maps.len(), 1);
    assert_eq!(maps[0].name, "jam_map_toe_out");
    assert!(
        maps_of(
            &STUDY
                .replace("wedge.angle", "wedge.height")
                .replace("deg\", to", "mm\", to")
                .replace("48 deg", "48 mm")
                .replace("24 deg", "24 mm"),
            |_| 1.0
        )
        .is_empty()
    );
}
