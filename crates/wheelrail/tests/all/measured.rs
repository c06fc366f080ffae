//! Measured track: splines through tables, signs, inverted chord offsets, center lines by tables, cubic
//! spirals.

use std::f64::consts::{PI, TAU};

use wheelrail::track::chord::{self, ChordError};
use wheelrail::track::{
    CenterLine, CurveElements, Form, Irregularity, MeasuredError, MeasuredTable, RailPlace, Reading, Samples,
    Segment, SpiralForm, Track,
};

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
fn signs_known() -> Reading {
    Reading {
        signs_known: true,
        ..Reading::default()
    }
}

fn line(length: f64) -> CenterLine {
    CenterLine::new(&[Segment::Tangent(length)], 59.5 * INCH, &[]).unwrap()
}

fn rails(table: &MeasuredTable, form: Form, at: f64) -> [RailPlace; 2] {
    let irregularities = table.irregularities(form, 0.0, 30.0).unwrap();
    let track = Track {
        center_line: line(1000.0),
        irregularities,
    };
    track.rails(at)
}

/// A sine sampled foot by foot: value, slope and second derivative between the rows; zero and without jump at
/// the ends; derivatives of the tapered part against differences.
#[test]
fn analytic_a_spline_through_a_sine() {
    let (amplitude, wavelength) = (0.5 * INCH, 39.0 * FOOT);
    let distances: Vec<f64> = (0..=1000).map(|k| f64::from(k) * FOOT).collect();
    let values = distances
        .iter()
        .map(|s| amplitude * (TAU * s / wavelength).sin())
        .collect();
    let samples = Samples::new(distances, values, 20.0).unwrap();
    let rate = TAU / wavelength;
    for at in [60.1, 100.03, 200.2] {
        let [value, slope, second] = samples.at(at);
        assert!((value - amplitude * (rate * at).sin()).abs() < 1e-5 * amplitude);
        assert!((slope - amplitude * rate * (rate * at).cos()).abs() < 1e-3 * amplitude * rate);
        assert!(
            (second + amplitude * rate * rate * (rate * at).sin()).abs() < 0.01 * amplitude * rate * rate
        );
    }
    let [first, last] = samples.range();
    for at in [first - 1.0, first, last, last + 1.0] {
        assert_eq!(samples.at(at), [0.0; 3]);
    }
    for at in [first + 3.0, first + 19.0, last - 3.0, last - 15.5] {
        let h = 1e-4;
        let [up, own, down] = [at + h, at, at - h].map(|at| samples.at(at));
        assert!(
            (own[1] - (up[0] - down[0]) / (2.0 * h)).abs() < 1e-6 * amplitude * rate,
            "{at}"
        );
        assert!(
            (own[2] - (up[1] - down[1]) / (2.0 * h)).abs() < 1e-4 * amplitude * rate * rate,
            "{at}"
        );
    }
}

/// The sign row turns each column to up, left, right high, wide; units are those of the header.
#[test]
fn analytic_sign_row_and_units() {
    let mut text = "# a car\ndistance [ft]; left_profile [mm]; right_profile (in); alignment_in; gauge \
                    [in]; speed [mph]\n; down; up; right; wide; \n"
        .to_owned();
    for k in 0..400 {
        text += &format!("{k}; 10; 0.5; 0.25; 57; 40\n");
    }
    let table = MeasuredTable::parse("car.csv", &text, &Reading::default()).unwrap();
    assert!((table.range()[1] - 399.0 * FOOT).abs() < 1e-9);
    let [left, right] = rails(&table, Form::SpaceCurve, 60.0);
    assert!((left.vertical[0] + 0.01).abs() < 1e-12 && (right.vertical[0] - 0.5 * INCH).abs() < 1e-12);
    // Mean to the right by 1/4 in, gauge wide by 1/2 in.
    assert!(
        (left.lateral[0] - (-0.25 + 0.25) * INCH).abs() < 1e-12,
        "{left:?}"
    );
    assert!(
        (right.lateral[0] - (-0.25 - 0.25) * INCH).abs() < 1e-12,
        "{right:?}"
    );
}

/// A cross level of the measured kind is taken less the superelevation of the design, on both rails with
/// opposite signs.
#[test]
fn analytic_cross_level_less_superelevation() {
    let mut text = "distance_ft,profile_in,cross_level_in,superelevation_in\n".to_owned();
    for k in 0..400 {
        text += &format!("{k},0.1,4.2,4\n");
    }
    let table = MeasuredTable::parse("car.csv", &text, &signs_known()).unwrap();
    let [left, right] = rails(&table, Form::SpaceCurve, 60.0);
    assert!((right.vertical[0] - left.vertical[0] - 0.2 * INCH).abs() < 1e-12);
    assert!((0.5 * (right.vertical[0] + left.vertical[0]) - 0.1 * INCH).abs() < 1e-12);
}

/// Two waves of 45 and 120 ft, their exact offsets of a chord of 62 ft: inverted over 40 to 200 ft they are
/// the space curve again in the middle, within a hundredth; a wave of 31 ft, which the chord does not see, is
/// refused.
#[test]
fn analytic_chord_offsets_are_inverted() {
    let (chord, spacing) = (62.0 * FOOT, FOOT);
    let curve =
        |s: f64| 0.5 * INCH * (TAU * s / (45.0 * FOOT)).sin() + 0.8 * INCH * (TAU * s / (120.0 * FOOT)).cos();
    let offsets: Vec<f64> = (0..3600)
        .map(|k| chord::offset(curve, f64::from(k) * spacing, chord))
        .collect();
    let inverted = chord::invert(&offsets, spacing, chord, [40.0 * FOOT, 200.0 * FOOT], 60.0).unwrap();
    for k in (1200..2400).step_by(7) {
        let expected = curve(k as f64 * spacing);
        assert!(
            (inverted[k] - expected).abs() < 0.013 * INCH,
            "{k}: {} {expected}",
            inverted[k]
        );
    }
    let blind = chord::invert(&offsets, spacing, chord, [20.0 * FOOT, 200.0 * FOOT], 60.0).unwrap_err();
    assert!(
        matches!(blind, ChordError::Insensitive { factor, .. } if factor < 0.1),
        "{blind}"
    );
    assert!(blind.to_string().contains("cannot be inverted"), "{blind}");
    // At 39 ft the factor is 1 - cos(62π/39).
    assert!((chord::transfer(39.0, 62.0) - (1.0 - (62.0 * PI / 39.0).cos())).abs() < 1e-15);
    assert!((chord::transfer(39.0, 62.0) - 0.72).abs() < 5e-3);
    let long = chord::invert(&offsets, spacing, chord, [40.0 * FOOT, 4000.0 * FOOT], 60.0).unwrap_err();
    assert!(matches!(long, ChordError::Range { .. }), "{long}");
}

/// A wave of 25 m and 5 mm at rows every 0.25 m.
fn wave(rows: impl Iterator<Item = u32>, cell: impl Fn(u32, f64) -> String) -> String {
    let row = |k| {
        let value = 5.0 * (TAU * 0.25 * f64::from(k) / 25.0).sin();
        format!("{};{}\n", 0.25 * f64::from(k), cell(k, value))
    };
    let rows: String = rows.map(row).collect();
    format!("distance [m];profile [mm]\n{rows}")
}

/// Four rows without a number, or not there at all, are those of the wave to a thousandth of its amplitude,
/// and are told; the same table with decimal commas is the same to the last bit.
#[test]
fn issue_048_gaps_are_filled_by_the_spline_and_counted() {
    let whole = wave(0..1600, |_, value| value.to_string());
    let empty = wave(0..1600, |k, value| match k {
        300..304 => String::new(),
        700 => "NaN".to_owned(),
        _ => value.to_string(),
    });
    let absent = wave((0..1600).filter(|k| !(300..304).contains(k)), |_, value| {
        value.to_string()
    });
    let told = |text: &str| {
        let table = MeasuredTable::parse("car.csv", text, &signs_known()).unwrap();
        let places = [75.0, 75.25, 75.4, 75.9, 175.0, 210.0].map(|at| rails(&table, Form::SpaceCurve, at));
        (table.filled(), places)
    };
    let (none, places) = told(&whole);
    assert_eq!(none, None);
    assert_eq!(told(&whole.replace('.', ",")), (none, places));
    for (text, part) in [
        (
            &empty,
            "fills 2 gaps, the longest of them 4 rows without profile between 74.75 m and 76 m",
        ),
        (
            &absent,
            "fills 1 gap, the longest of them 4 rows not there between 74.75 m and 76 m",
        ),
    ] {
        let (told, own) = told(text);
        assert!(told.as_ref().is_some_and(|told| told.contains(part)), "{told:?}");
        for (own, place) in own.iter().zip(&places) {
            let difference = own[0].vertical[0] - place[0].vertical[0];
            assert!(difference.abs() < 5e-6, "{difference}");
        }
    }
}

/// A gap that is longer than stated, and rows without a number at an end of the table, are refused where the
/// column is used; a table of unequal distances has no missing rows.
#[test]
fn issue_048_long_gaps_and_open_ends_are_refused() {
    let text = wave(0..400, |k, value| match k {
        200..210 => String::new(),
        _ => value.to_string(),
    });
    let refused = |text: &str| {
        let table = MeasuredTable::parse("car.csv", text, &signs_known()).unwrap();
        let error = table.irregularities(Form::SpaceCurve, 0.0, 10.0).unwrap_err();
        (error.to_string(), error.remedy())
    };
    let (message, help) = refused(&text);
    assert!(
        message.contains("10 rows without profile between 49.75 m and 52.5 m"),
        "{message}"
    );
    assert!(
        message.contains("2.75 m; up to 1.524 m") && help.contains("gaps ="),
        "{message} {help}"
    );
    let reading = Reading {
        longest_gap: 3.0,
        ..signs_known()
    };
    let table = MeasuredTable::parse("car.csv", &text, &reading).unwrap();
    assert!(table.irregularities(Form::SpaceCurve, 0.0, 10.0).is_ok());
    assert!(table.filled().is_some());

    let open = wave(
        0..400,
        |k, value| if k < 398 { value.to_string() } else { String::new() },
    );
    let (message, help) = refused(&open);
    assert!(
        message.contains("no number in 2 rows at 99.75 m") && help.contains("leave these rows out"),
        "{message}"
    );

    let uneven: String = [0, 1, 3, 10, 11, 30, 31, 90]
        .map(|at| format!("{at},0.1\n"))
        .concat();
    let table = MeasuredTable::parse(
        "car.csv",
        &format!("distance_m,profile_in\n{uneven}"),
        &signs_known(),
    )
    .unwrap();
    assert!(table.irregularities(Form::SpaceCurve, 0.0, 10.0).is_ok());
    assert_eq!(table.filled(), None);
}

/// Offsets are taken from their own columns where the chord is stated, and refused where they are given as
/// profiles.
#[test]
fn input_mid_chord_offsets_are_no_profiles() {
    let mut text = "distance_ft,left_profile_offset_62_ft_in,right_profile_mco_62 [in]\n".to_owned();
    let wave = |s: f64| (TAU * s / 62.0).sin();
    for k in 0..2000 {
        text += &format!("{k},{},{}\n", 2.0 * wave(f64::from(k)), -2.0 * wave(f64::from(k)));
    }
    let table = MeasuredTable::parse("car.csv", &text, &signs_known()).unwrap();
    let error = table.irregularities(Form::SpaceCurve, 0.0, 30.0).unwrap_err();
    assert!(matches!(error, MeasuredError::MidChord { .. }), "{error}");
    assert!(
        error.to_string().contains("left_profile_offset_62_ft")
            && error.remedy().contains("form = \"mid_chord\"")
    );
    let form = Form::MidChord {
        chord: 62.0 * FOOT,
        wavelengths: [40.0 * FOOT, 300.0 * FOOT],
    };
    let at = 62.0 * 15.25 * FOOT;
    let [left, right] = rails(&table, form, at);
    assert!(
        (left.vertical[0] / INCH - 1.0).abs() < 0.02,
        "{}",
        left.vertical[0] / INCH
    );
    assert!(
        (right.vertical[0] / INCH + 1.0).abs() < 0.02,
        "{}",
        right.vertical[0] / INCH
    );
}

/// Rows of a clothoid and a curve give the center line that their segments give.
#[test]
fn analytic_a_center_line_by_a_table_is_that_of_its_segments() {
    let elements = CurveElements::of_degree(6f64.to_radians(), 3.0 * INCH);
    let segments = [
        Segment::Tangent(100.0 * FOOT),
        Segment::Spiral(200.0 * FOOT, SpiralForm::Clothoid),
        Segment::Curve(300.0 * FOOT, elements),
    ];
    let expected = CenterLine::new(&segments, 59.5 * INCH, &[[0.0, 0.0], [50.0, 0.01]]).unwrap();
    let mut text = "distance_ft,degree_of_curve,superelevation_in,grade\n".to_owned();
    for k in 0..=600 {
        let at = expected.at(f64::from(k) * FOOT);
        let degree = (2.0 * (0.5 * at.curvature[0] * 30.48).asin()).to_degrees();
        text += &format!("{k},{degree},{},{}\n", at.superelevation[0] / INCH, at.grade);
    }
    let found = MeasuredTable::parse("line.csv", &text, &signs_known())
        .unwrap()
        .center_line(59.5 * INCH)
        .unwrap();
    assert!((found.length() - expected.length()).abs() < 1e-9);
    for at in [20.0, 61.3, 120.0, 182.0] {
        let (found, expected) = (found.at(at), expected.at(at));
        assert!((found.curvature[0] - expected.curvature[0]).abs() < 1e-10);
        assert!((found.heading - expected.heading).abs() < 1e-6);
        assert!((found.roll - expected.roll).abs() < 1e-9);
        assert!((found.grade - expected.grade).abs() < 1e-5);
        for (found, expected) in found.position.iter().zip(expected.position) {
            assert!((found - expected).abs() < 1e-4, "{found} {expected}");
        }
    }
}

/// In a cubic spiral curvature and its rate are continuous, its heading is half the curvature times the
/// length, and the position is the integral of the heading (against a fine midpoint rule).
#[test]
fn analytic_cubic_spirals() {
    let (length, elements) = (61.0, CurveElements::of_degree(8f64.to_radians(), 4.0 * INCH));
    let segments = [
        Segment::Tangent(30.0),
        Segment::Spiral(length, SpiralForm::Bloss),
        Segment::Curve(90.0, elements),
    ];
    let line = CenterLine::new(&segments, 59.5 * INCH, &[]).unwrap();
    let end = line.at(30.0 + length);
    assert!((end.heading - 0.5 * elements.curvature * length).abs() < 1e-12);
    for seam in [30.0, 30.0 + length] {
        let [before, after] = [seam - 1e-9, seam + 1e-9].map(|at| line.at(at));
        for (a, b, scale) in [
            (before.curvature[0], after.curvature[0], elements.curvature),
            (
                before.curvature[1],
                after.curvature[1],
                elements.curvature / length,
            ),
            (
                before.superelevation[1],
                after.superelevation[1],
                4.0 * INCH / length,
            ),
        ] {
            assert!((a - b).abs() < 1e-7 * scale, "{seam}: {a} {b}");
        }
    }
    let quarter = line.at(30.0 + 0.25 * length);
    assert!((quarter.curvature[0] / elements.curvature - 0.156_25).abs() < 1e-12);
    assert!((quarter.superelevation[0] / (4.0 * INCH) - 0.156_25).abs() < 1e-12);
    let (steps, mut place) = (20_000, [30.0, 0.0]);
    for k in 0..steps {
        let step = length / f64::from(steps);
        let heading = line.at(30.0 + (f64::from(k) + 0.5) * step).heading;
        place[0] += step * heading.cos();
        place[1] += step * heading.sin();
    }
    assert!((place[0] - end.position[0]).abs() < 1e-8 && (place[1] - end.position[1]).abs() < 1e-8);
}

#[test]
fn input_tables_that_are_wrong_are_refused_with_places() {
    let rows = "0,0.1\n1,0.1\n2,0.1\n3,0.1\n";
    for (text, signs_known, parts) in [
        (
            "distance_ft,left_profile_in\n0,0,1,5\n".to_owned(),
            true,
            &["t.csv:2", "4 cells under 2 titles", "points"][..],
        ),
        (
            "distance_ft;left_profile_in\n0,5;1\n1.5;1\n".to_owned(),
            true,
            &["t.csv:3", "1.5 has a decimal point", "decimal commas"],
        ),
        (
            "distance_ft,left_profile_in\n0,1\n,2\n".to_owned(),
            true,
            &["t.csv:3", "a number is missing, under distance"],
        ),
        (String::new(), true, &["t.csv:1", "no header"]),
        (
            format!("distance_ft,left_profile\n{rows}"),
            true,
            &["left_profile has no unit"],
        ),
        (
            format!("distance_ft,left_profile [lbf]\n{rows}"),
            true,
            &["t.csv:1", "force"],
        ),
        (
            format!("left_profile [in],x\n{rows}"),
            true,
            &["no column distance"],
        ),
        (
            format!("distance_ft,left_profile_in\n{rows}"),
            false,
            &["t.csv:2", "sign row", "forward"],
        ),
        (
            format!("distance_ft,left_profile_in\n,left\n{rows}"),
            false,
            &["left under left_profile", "up or down is expected"],
        ),
        (
            "distance_ft,left_profile_in\n0,a\n".to_owned(),
            true,
            &["t.csv:2", "a is no number, under left_profile"],
        ),
        (
            "distance_ft,left_profile_in\n0,1\n0,2\n".to_owned(),
            true,
            &["t.csv:3", "follows"],
        ),
        (format!("distance_ft,curvature [ft]\n{rows}"), true, &["1/ft"]),
    ] {
        let reading = Reading {
            signs_known,
            ..Reading::default()
        };
        let message = MeasuredTable::parse("t.csv", &text, &reading)
            .unwrap_err()
            .to_string();
        assert!(
            parts.iter().all(|part| message.contains(part)),
            "{text}: {message}"
        );
    }
    let table = MeasuredTable::parse("t.csv", &format!("distance_ft,speed\n{rows}"), &signs_known()).unwrap();
    let error = table.irregularities(Form::SpaceCurve, 0.0, 0.1).unwrap_err();
    assert!(error.to_string().contains("left_profile"), "{error}");
    assert!(
        table
            .center_line(1.5)
            .unwrap_err()
            .to_string()
            .contains("curvature")
    );
    let table = MeasuredTable::parse(
        "t.csv",
        &format!("distance_ft,left_profile_in\n{rows}"),
        &signs_known(),
    )
    .unwrap();
    let error = table.irregularities(Form::SpaceCurve, 0.0, 30.0).unwrap_err();
    assert!(error.to_string().contains("taper"), "{error}");
    let placed = table.irregularities(Form::SpaceCurve, 0.0, 0.2).unwrap();
    assert!(matches!(placed[0].irregularity, Irregularity::Samples(_)));
    let late = "distance_ft,curvature [1/ft]\n5,0\n6,0\n";
    let error = MeasuredTable::parse("t.csv", late, &signs_known())
        .unwrap()
        .center_line(1.5)
        .unwrap_err();
    assert!(error.to_string().contains("begin at 0"), "{error}");
}
