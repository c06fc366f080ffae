//! Recordings as measuring cars write them: their own titles, mileposts, station equations, both directions.

use std::f64::consts::{PI, TAU};

use wheelrail::track::{
    CenterLine, ColumnKind, Direction, Form, MeasuredTable, NamedColumn, RailPlace, Rails, Reading, Running,
    Segment, StationEquation, Track,
};

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;
const MILE: f64 = 5280.0 * FOOT;

fn named(quantity: &str, title: &str, unit: &str) -> NamedColumn {
    let unit = Some(unit).filter(|unit| !unit.is_empty());
    NamedColumn::new(quantity, title, unit, None, ColumnKind::Unstated).unwrap()
}

fn read(text: &str, reading: &Reading) -> MeasuredTable {
    MeasuredTable::parse("car.csv", text, reading).unwrap()
}

fn refused(text: &str, reading: &Reading) -> String {
    let error = MeasuredTable::parse("car.csv", text, reading).unwrap_err();
    format!("{error}; {}", error.remedy())
}

fn rails(table: &MeasuredTable, form: Form, length: f64) -> Track {
    Track {
        center_line: CenterLine::new(&[Segment::Tangent(length)], 59.5 * INCH, &[]).unwrap(),
        irregularities: table.irregularities(form, 0.0, 30.0).unwrap(),
    }
}

/// Titles of a US measuring car, mileposts with six decimals, 62-ft offsets of 0.3 in of a wave of 50 ft: the
/// space curve has an amplitude of 0.3/(1 - cos(62 π/50)) = 0.1735 in.
#[test]
fn analytic_us_titles_and_mileposts() {
    let mut text =
        "Milepost,Gage,Crosslevel,Left Prof 62,Right Prof 62,Left Align 62,Right Align 62\n".to_owned();
    for k in 0..1500 {
        let offset = 0.3 * (TAU * f64::from(k) / 50.0).sin();
        text += &format!(
            "{:.6},56.5,0.0,{offset:.4},{offset:.4},0,0\n",
            100.0 + f64::from(k) / 5280.0
        );
    }
    let reading = Reading {
        columns: vec![
            named("milepost", "Milepost", ""),
            named("left_profile", "Left Prof 62", "in"),
            named("right_profile", "right prof 62", "in"),
            named("gauge", "Gage", "in"),
        ],
        ..Reading::default()
    };
    let table = read(&text, &reading);
    assert!((table.range()[0]).abs() < 1e-12 && (table.range()[1] / FOOT - 1499.0).abs() < 0.01);
    assert_eq!(table.filled(), None);
    let form = Form::MidChord {
        chord: 62.0 * FOOT,
        wavelengths: [35.0 * FOOT, 370.0 * FOOT],
    };
    let track = rails(&table, form, 1499.0 * FOOT);
    let expected = 0.3 / (1.0 - (62.0 * PI / 50.0).cos());
    assert!((expected - 0.1735).abs() < 1e-4);
    for crest in [512.5, 712.5, 912.5] {
        for rail in track.rails(crest * FOOT) {
            let found = rail.vertical[0] / INCH;
            assert!(
                (found / expected - 1.0).abs() < 0.01,
                "{crest}: {found} {expected}"
            );
            assert!(rail.lateral[0].abs() < 1e-12);
        }
    }
}

/// Readings that rise by the foot over a mile of 5341 ft and one of 5100 ft: with both station equations the
/// rows are 1 ft apart everywhere, in both directions; without them both places are told with what to write.
#[test]
fn analytic_station_equations_join_miles_of_any_length() {
    let place = |k: u32| match k {
        0..=340 => (100, 5000 + k),
        341..=5440 => (101, k - 341),
        _ => (102, k - 5441),
    };
    let rows = |order: &mut dyn Iterator<Item = u32>| {
        let rows: String = order
            .map(|k| {
                let (post, beyond) = place(k);
                format!("{post};{beyond};{}\n", 0.001 * f64::from(k))
            })
            .collect();
        format!("MP;ft;Surface\n{rows}")
    };
    let feet = |post: f64, beyond: f64| post * MILE + beyond * FOOT;
    let mut reading = Reading {
        columns: vec![
            named("milepost", "MP", ""),
            named("milepost_offset", "ft", "ft"),
            named("profile", "Surface", "in"),
        ],
        equations: vec![
            StationEquation {
                back: feet(101.0, 5100.0),
                ahead: feet(102.0, 0.0),
            },
            StationEquation {
                back: feet(100.0, 5341.0),
                ahead: feet(101.0, 0.0),
            },
        ],
        ..Reading::default()
    };
    let text = rows(&mut (0..6000));
    let table = read(&text, &reading);
    assert!((table.range()[1] / FOOT - 5999.0).abs() < 1e-6);
    assert_eq!(table.filled(), None, "no rows are missing");
    let track = rails(&table, Form::SpaceCurve, 5999.0 * FOOT);
    for k in [300, 341, 3000, 5440, 5441, 5800] {
        let found = track.rails(f64::from(k) * FOOT)[0].vertical[0] / INCH;
        assert!((found - 0.001 * f64::from(k)).abs() < 1e-9, "{k}: {found}");
    }
    reading.running = Running::Falling;
    let back = read(&rows(&mut (0..6000).rev()), &reading);
    let backward = rails(&back, Form::SpaceCurve, 5999.0 * FOOT);
    for k in [300, 341, 3000, 5440, 5441, 5800] {
        let found = backward.rails(f64::from(5999 - k) * FOOT)[0].vertical[0] / INCH;
        assert!((found - 0.001 * f64::from(k)).abs() < 1e-9, "{k}: {found}");
    }
    reading.running = Running::Rising;
    reading.equations.remove(0);
    let gap = read(&text, &reading)
        .irregularities(Form::SpaceCurve, 0.0, 5.0)
        .unwrap_err();
    let gap = format!("{gap}; {}", gap.remedy());
    assert!(
        gap.contains("lines 5442 and 5443") && gap.contains("station equation"),
        "{gap}"
    );
    reading.equations.clear();
    let message = refused(&text, &reading);
    assert!(
        message.contains("car.csv:343: the milepost MP 101 + 0.0 ft follows MP 101 + 60.0 ft")
            && message.contains("[[station_equations]]"),
        "{message}"
    );
}

/// A track run toward falling readings is the same track from the other end: places, left and right, and all
/// signs. `FallingOwnSides` keeps left and right.
#[test]
fn analytic_falling_recordings_are_the_track_from_its_other_end() {
    let titles = "distance [m],left_profile [mm],right_profile [mm],left_alignment [mm],right_alignment \
                  [mm],curvature [1/m],superelevation [mm],grade\n";
    let row = |k: u32| {
        let s = f64::from(k);
        let wave = |length: f64| (TAU * s / length).sin();
        format!(
            "{k},{},{},{},{},{},{},{}\n",
            5.0 * wave(40.0),
            3.0 * wave(25.0),
            4.0 * wave(31.0),
            2.0 * wave(53.0),
            1e-4 * s / 400.0,
            0.1 * s,
            0.005 * wave(300.0)
        )
    };
    let of = |rows: &mut dyn Iterator<Item = u32>| titles.to_owned() + &rows.map(row).collect::<String>();
    let (rising, falling) = (of(&mut (0..=400)), of(&mut (0..=400).rev()));
    let with = |text: &str, running| {
        let reading = Reading {
            signs_known: true,
            running,
            ..Reading::default()
        };
        let table = read(text, &reading);
        Track {
            center_line: table.center_line(1.5).unwrap(),
            irregularities: table.irregularities(Form::SpaceCurve, 0.0, 30.0).unwrap(),
        }
    };
    let ahead = with(&rising, Running::Rising);
    let sides = |rail: &RailPlace| [rail.vertical[0], rail.lateral[0]];
    for (text, running) in [
        (&falling, Running::Falling),
        (&rising, Running::Falling),
        (&falling, Running::FallingOwnSides),
    ] {
        let back = with(text, running);
        for s in [41.0, 150.5, 203.25, 371.0] {
            let (here, there) = (ahead.center_line.at(s), back.center_line.at(400.0 - s));
            let turned = if running == Running::Falling { -1.0 } else { 1.0 };
            let pairs = [
                (here.curvature[0], turned * there.curvature[0]),
                (here.superelevation[0], turned * there.superelevation[0]),
                (here.grade, turned * there.grade),
            ];
            for (one, other) in pairs {
                assert!((one - other).abs() < 1e-12, "{s}: {one} {other}");
            }
            let [left, right] = ahead.rails(s);
            let [other_left, other_right] = back.rails(400.0 - s);
            let expected = match running {
                Running::Falling => [
                    [right.vertical[0], -right.lateral[0]],
                    [left.vertical[0], -left.lateral[0]],
                ],
                _ => [sides(&left), sides(&right)],
            };
            for (found, expected) in [sides(&other_left), sides(&other_right)].iter().zip(expected) {
                for (found, expected) in found.iter().zip(expected) {
                    assert!((found - expected).abs() < 1e-12, "{s}: {found} {expected}");
                }
            }
        }
        // The same curve in space: from one end to the other, the same distance and the same turn.
        let span = |track: &Track| {
            let end = track.center_line.at(400.0);
            (end.position[0].hypot(end.position[1]), end.heading.abs())
        };
        let ((one, turn), (other, turn_back)) = (span(&ahead), span(&back));
        assert!((one - other).abs() < 1e-9 && (turn - turn_back).abs() < 1e-12);
    }
    let reading = Reading {
        signs_known: true,
        ..Reading::default()
    };
    let message = refused(&falling, &reading);
    assert!(
        message.contains("car.csv:3") && message.contains("direction = \"falling\""),
        "{message}"
    );
}

/// Cross level and gauge turn with the sides: a right rail that is high is a left one for who comes back.
#[test]
fn analytic_falling_cross_level_and_gauge() {
    let rows: String = (0..200).rev().map(|k| format!("{k},4,57.0\n")).collect();
    let text = format!("distance_m,cross_level_mm,gauge_in\n{rows}");
    let reading = Reading {
        signs_known: true,
        running: Running::Falling,
        ..Reading::default()
    };
    let [left, right] = rails(&read(&text, &reading), Form::SpaceCurve, 199.0).rails(100.0);
    assert!((left.vertical[0] - right.vertical[0] - 0.004).abs() < 1e-12);
    assert!((left.lateral[0] - right.lateral[0] - 0.5 * INCH).abs() < 1e-12);
}

/// Offsets at rows of which some are not there: inverted as if they were.
#[test]
fn analytic_offsets_with_missing_rows_are_inverted() {
    let offset = |k: u32| 10.0 * (TAU * f64::from(k) / 20.0).sin();
    let rows = |absent: &dyn Fn(u32) -> bool| {
        let rows: String = (0..1200)
            .filter(|k| !absent(*k))
            .map(|k| format!("{},{}\n", 0.5 * f64::from(k), offset(k)))
            .collect();
        format!("distance_m,profile_mm\n{rows}")
    };
    let form = Form::MidChord {
        chord: 62.0 * FOOT,
        wavelengths: [11.0, 110.0],
    };
    let reading = Reading {
        signs_known: true,
        ..Reading::default()
    };
    let at = |text: &str| {
        let track = rails(&read(text, &reading), form, 590.0);
        [300.3, 303.0, 310.0].map(|s| track.rails(s)[0].vertical[0])
    };
    let whole = at(&rows(&|_| false));
    let some = at(&rows(&|k| k == 601 || k == 900));
    for (one, other) in whole.iter().zip(some) {
        assert!((one - other).abs() < 1e-4, "{one} {other}");
    }
}

#[test]
fn input_columns_are_named_with_what_is_wrong() {
    let text = "Milepost,Gage [mm],Left Prof,Left Prof D2\n100,1435,1,2\n100.001,1435,1,2\n";
    for (columns, parts) in [
        (
            vec![named("milepost", "MP", "")],
            &["no column MP for milepost", "titles are milepost"][..],
        ),
        (
            vec![
                named("milepost", "Milepost", ""),
                named("left_profile", "Left Prof", ""),
            ],
            &["Left Prof has no unit"],
        ),
        (
            vec![named("milepost", "Milepost", ""), named("gauge", "Gage", "in")],
            &["Gage [mm] is in mm, not in in"],
        ),
        (
            vec![
                named("distance", "Milepost", "mi"),
                named("milepost", "Milepost", ""),
            ],
            &["both a distance and a milepost"],
        ),
        (
            vec![named("left_profile", "Left Prof", "in")],
            &["no column distance"],
        ),
    ] {
        let reading = Reading {
            columns,
            ..Reading::default()
        };
        let message = refused(text, &reading);
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
    for (quantity, unit, sign, kind, part) in [
        (
            "left_prof",
            None,
            None,
            ColumnKind::Unstated,
            "did you mean `left_profile`",
        ),
        ("gauge", Some("lbf"), None, ColumnKind::Unstated, "force"),
        (
            "gauge",
            Some("in"),
            Some("up"),
            ColumnKind::Unstated,
            "wide or tight",
        ),
        ("gauge", Some("in"), None, ColumnKind::MidChord(18.9), "no kind"),
        (
            "milepost",
            None,
            Some("nothing"),
            ColumnKind::Unstated,
            "no positive direction",
        ),
    ] {
        let [found, help] = NamedColumn::new(quantity, "x", unit, sign, kind).unwrap_err();
        assert!(format!("{found}; {help}").contains(part), "{found}; {help}");
    }
    // One mile after the other, rounded until they are the same.
    let coarse = "Milepost,Left\n100.00,1\n100.00,1\n";
    let reading = Reading {
        columns: vec![
            named("milepost", "Milepost", ""),
            named("left_profile", "Left", "in"),
        ],
        ..Reading::default()
    };
    assert!(refused(coarse, &reading).contains("more decimals"));
}

/// A column of a stated kind is taken by that form alone, and a rail that has another form alone is refused
/// instead of being perfect.
#[test]
fn input_kinds_of_columns_decide_their_form() {
    let rows: String = (0..300).map(|k| format!("{k},1,2\n")).collect();
    let text = format!("m,L,L62\n{rows}");
    let column = |kind| NamedColumn::new("left_profile", "L", Some("mm"), Some("down"), kind).unwrap();
    let reading = |columns: Vec<NamedColumn>| Reading {
        columns: [vec![named("distance", "m", "m")], columns].concat(),
        ..Reading::default()
    };
    let chord = Form::MidChord {
        chord: 62.0 * FOOT,
        wavelengths: [11.0, 110.0],
    };
    let curve = read(&text, &reading(vec![column(ColumnKind::SpaceCurve)]));
    let placed = curve.irregularities(Form::SpaceCurve, 0.0, 5.0).unwrap();
    assert_eq!(placed.len(), 1);
    assert_eq!(
        (placed[0].rails, placed[0].direction),
        (Rails::Left, Direction::Vertical)
    );
    let [left, _] = rails(&curve, Form::SpaceCurve, 290.0).rails(100.0);
    assert!((left.vertical[0] + 0.001).abs() < 1e-12, "down is positive");
    let error = curve.irregularities(chord, 0.0, 5.0).unwrap_err();
    assert!(
        error.to_string().contains("left_profile holds a space curve"),
        "{error}"
    );
    let offsets = read(&text, &reading(vec![column(ColumnKind::MidChord(31.0 * FOOT))]));
    let error = offsets.irregularities(chord, 0.0, 5.0).unwrap_err();
    assert!(
        error.to_string().contains("left_profile holds offsets of 31 ft"),
        "{error}"
    );
    let error = offsets.irregularities(Form::SpaceCurve, 0.0, 5.0).unwrap_err();
    assert!(error.to_string().contains("mid-chord offsets"), "{error}");
}
