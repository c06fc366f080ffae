//! Recordings in track files: `[columns]`, mileposts, directions, gaps, decimal commas, bands.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use study::track::TrackFile;
use wheelrail::track::chord;

use crate::problems::in_words;

const FOOT: f64 = 0.3048;
const INCH: f64 = 0.0254;

fn read(track: &str, table: &str) -> Result<TrackFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("car.csv"), table).unwrap();
    let file = folder.path().join("track.toml");
    std::fs::write(&file, track).unwrap();
    TrackFile::read(&file).map_err(|error| in_words(error.problems()))
}

fn refused(track: &str, table: &str, parts: &[&str]) {
    let message = read(track, table).unwrap_err();
    assert!(
        parts.iter().all(|part| message.contains(part)),
        "{track}: {message}"
    );
}

/// Returns the largest 62-ft offset of the left rail's profile, in.
fn largest_offset(file: &TrackFile, from: f64, to: f64) -> f64 {
    let profile = |s: f64| file.track.rails(s)[0].vertical[0];
    let steps = ((to - from) / 0.1) as u32;
    let offsets = (0..steps).map(|k| chord::offset(profile, from + 0.1 * f64::from(k), 62.0 * FOOT).abs());
    offsets.fold(0.0, f64::max) / INCH
}

/// Titles of a US car with mileposts: mapped in the track file, the recording as it is.
#[test]
fn analytic_a_us_recording_is_read_by_its_own_titles() {
    let mut table =
        "Milepost,Gage,Crosslevel,Left Prof 62,Right Prof 62,Left Align 62,Right Align 62\n".to_owned();
    for k in 0..1500 {
        let offset = 0.3 * (TAU * f64::from(k) / 50.0).sin();
        let milepost = 100.0 + f64::from(k) / 5280.0;
        writeln!(table, "{milepost:.6},56.5,0.0,{offset:.4},{offset:.4},0,0").unwrap();
    }
    let track = r#"
title = "m"
[[segments]]
tangent = "1400 ft"
[[irregularities]]
table = "car.csv"
form = "mid_chord"
chord = "62 ft"
shortest = "35 ft"
longest = "370 ft"
[columns]
milepost = { name = "Milepost" }
gauge = { name = "Gage", unit = "in" }
cross_level = { name = "Crosslevel", unit = "in", sign = "right_high" }
left_profile = { name = "Left Prof 62", unit = "in", sign = "up", kind = "mid_chord", chord = "62 ft" }
right_profile = { name = "Right Prof 62", unit = "in" }
left_alignment = { name = "Left Align 62", unit = "in" }
right_alignment = { name = "Right Align 62", unit = "in" }
"#;
    let file = read(track, &table).unwrap();
    let crest = file.track.rails(712.5 * FOOT)[0].vertical[0] / INCH;
    let expected = 0.3 / (1.0 - (62.0 * PI / 50.0).cos());
    assert!((crest / expected - 1.0).abs() < 0.01, "{crest} {expected}");
    let offset = largest_offset(&file, 600.0 * FOOT, 900.0 * FOOT);
    assert!((offset - 0.3).abs() < 0.003, "{offset}");
    assert_eq!(file.doubts, Vec::<String>::new());
    // A section's own columns go before those of the file.
    let (body, shared) = track.split_once("[columns]").unwrap();
    let own = format!("{body}[irregularities.columns]{shared}");
    assert_eq!(read(&own, &table).unwrap().track, file.track);
    let wrong = track.replace("\"Gage\"", "\"Gauge\"");
    refused(
        &wrong,
        &table,
        &[
            "no column Gauge for gauge",
            "near it is gage",
            "irregularities[0].table",
        ],
    );
    let message = read(
        &track.replace("[columns]", "[[segments]]\ntangent = \"1 ft\"\n[colums]"),
        &table,
    );
    assert!(message.unwrap_err().contains("columns"));
}

/// A wave of 25 m and 5 mm with four empty rows (one metre), and the same with semicolons and decimal commas:
/// 62-ft offsets of 5 (1 - cos(π 18.898/25)) = 8.60 mm = 0.339 in.
#[test]
fn analytic_gaps_and_decimal_commas_keep_the_offsets() {
    let mut table = "distance [m]; left_profile [mm]; right_profile [mm]\n ; up; up\n".to_owned();
    for k in 0..1700 {
        let value = 5.0 * (TAU * 0.25 * f64::from(k) / 25.0).sin();
        match k {
            800..804 => writeln!(table, "{};;", 0.25 * f64::from(k)).unwrap(),
            _ => writeln!(table, "{};{value:.3};{value:.3}", 0.25 * f64::from(k)).unwrap(),
        }
    }
    let track = "[[segments]]\ntangent = \"400 m\"\n[[irregularities]]\ntable = \"car.csv\"\n\
                 form = \"space_curve\"\n";
    let expected = 5.0 * (1.0 - (PI * 62.0 * FOOT / 25.0).cos()) / 25.4;
    assert!((expected - 0.339).abs() < 1e-3);
    for text in [
        table.clone(),
        table.replace('.', ","),
        table.replace(';', ","),
        table.replace(';', "\t"),
    ] {
        let file = read(track, &text).unwrap();
        let offset = largest_offset(&file, 190.0, 215.0);
        assert!((offset / expected - 1.0).abs() < 0.01, "{offset}");
        assert!(file.doubts[0].contains("fills 2 gaps"), "{:?}", file.doubts);
        assert!(
            file.doubts[0].contains("(lines 802 and 807)"),
            "{:?}",
            file.doubts
        );
    }
    let short = format!("{track}gaps = \"0.5 m\"\n");
    refused(
        &short,
        &table,
        &["4 rows without left_profile between 199.75 m and 201 m (lines 802 and 807)"],
    );
}

/// Falling mileposts: distance from the first row, left and right exchanged unless the sides are the car's;
/// the center line and the rails of one recording share the keys of the file.
#[test]
fn analytic_falling_mileposts() {
    let mut table = "MP,ft,L,curv\n".to_owned();
    for k in (0..2000).rev() {
        writeln!(
            table,
            "{},{},{},0.0002",
            7 + k / 1000,
            k % 1000,
            f64::from(k) / 1000.0
        )
        .unwrap();
    }
    let track = r#"
direction = "falling"
[[station_equations]]
back = "MP 7 + 1000 ft"
ahead = "MP 8"
[columns]
milepost = { name = "MP" }
milepost_offset = { name = "ft", unit = "ft" }
left_alignment = { name = "L", unit = "in", sign = "right" }
curvature = { name = "curv", unit = "1/ft", sign = "left" }
[center_line]
table = "car.csv"
[[irregularities]]
table = "car.csv"
form = "space_curve"
"#;
    let file = read(track, &table).unwrap();
    assert!((file.track.center_line.length() / FOOT - 1999.0).abs() < 1e-6);
    assert!((file.track.center_line.at(300.0).curvature[0] * FOOT + 0.0002).abs() < 1e-12);
    // 1500 ft from the first row, MP 7 + 499 ft: 0.499 in to the right of the left rail becomes 0.499 in to
    // the left of the right one.
    let [left, right] = file.track.rails(1500.0 * FOOT);
    assert!(
        (right.lateral[0] / INCH - 0.499).abs() < 1e-6 && left.lateral[0] == 0.0,
        "{right:?}"
    );
    let own = track.replacen("direction", "sides = \"running\"\ndirection", 1);
    let file = read(&own, &table).unwrap();
    let [left, right] = file.track.rails(1500.0 * FOOT);
    assert!((left.lateral[0] / INCH + 0.499).abs() < 1e-6 && right.lateral[0] == 0.0);
    assert!((file.track.center_line.at(300.0).curvature[0] * FOOT - 0.0002).abs() < 1e-12);
    let rising = track.replace("direction = \"falling\"", "");
    refused(
        &rising,
        &table,
        &[
            "car.csv:3",
            "MP 8 + 998.0 ft follows MP 8 + 999.0 ft",
            "direction",
        ],
    );
    let none = track.replace("MP 8\"", "MP\"");
    refused(&none, &table, &["station_equations[0].ahead", "cannot be \"MP\""]);
    let unused = "direction = \"falling\"\n[[segments]]\ntangent = \"100 ft\"\n";
    refused(unused, &table, &["direction", "reads no table"]);
}

/// A space curve that was filtered to D1 is read with its band said; one that is said to be D1 and holds long
/// waves is doubted.
#[test]
fn input_bands_are_said_and_examined() {
    let table = |wavelength: f64| {
        let row = |k: u32| {
            (
                0.25 * f64::from(k),
                5.0 * (TAU * 0.25 * f64::from(k) / wavelength).sin(),
            )
        };
        let rows: String = (0..4000).map(row).map(|(s, z)| format!("{s},{z:.4}\n")).collect();
        format!("distance_m,profile_mm\n{rows}")
    };
    let track = |keys: &str| {
        format!(
            "[[segments]]\ntangent = \"900 m\"\n[[irregularities]]\ntable = \"car.csv\"\n\
             form = \"space_curve\"\nsigns = \"usual\"\n{keys}\n"
        )
    };
    let file = read(&track("band = \"D1\""), &table(12.0)).unwrap();
    assert_eq!(file.doubts.len(), 1);
    assert!(file.doubts[0].contains("D1, 3 m to 25 m") && file.doubts[0].contains("1.1 times a second"));
    let file = read(&track("band = [\"3 m\", \"25 m\"]"), &table(150.0)).unwrap();
    assert!(
        file.doubts[1].contains("waves longer than 75 m"),
        "{:?}",
        file.doubts
    );
    refused(
        &track("band = \"D4\""),
        &table(12.0),
        &["band` cannot be \"D4\"", "D2"],
    );
    refused(
        &track("band = [\"25 m\", \"3 m\"]"),
        &table(12.0),
        &["is no band"],
    );
    let chord = track("band = \"D1\"\nchord = \"62 ft\"\nshortest = \"11 m\"\nlongest = \"100 m\"");
    refused(
        &chord.replace("space_curve", "mid_chord"),
        &table(12.0),
        &["band` is of space curves"],
    );
}

/// An alignment of LandXML is the track of the same segments: lengths, curvature, cant, places; in feet too.
#[test]
fn analytic_an_alignment_of_landxml_is_its_segments() {
    let xml = r#"<?xml version="1.0"?>
<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" version="1.2">
 <Units><Metric areaUnit="squareMeter" linearUnit="meter"/></Units>
 <Alignments>
  <Alignment name="Side" staStart="0"><CoordGeom><Line length="10"/></CoordGeom></Alignment>
  <Alignment name="Main" length="430" staStart="1000">
   <CoordGeom>
    <Line><Start>500 200</Start><End>500 250</End></Line>
    <Spiral length="60" radiusStart="INF" radiusEnd="400" rot="cw" spiType="bloss"/>
    <Curve radius="400" length="120" rot="cw"><Start>0 0</Start><Center>1 1</Center><End>0 0</End></Curve>
    <Spiral length="80" radiusStart="400" radiusEnd="INF" rot="cw" spiType="clothoid"/>
    <Line length="120"/>
   </CoordGeom>
   <Cant name="c" gauge="1.435" rotationPoint="insideRail">
    <CantStation station="1050" appliedCant="0"/>
    <CantStation station="1110" appliedCant="80" curvature="cw"/>
    <CantStation station="1230" appliedCant="80" curvature="cw"/>
    <CantStation station="1310" appliedCant="0"/>
   </Cant>
  </Alignment>
 </Alignments>
</LandXML>"#;
    let segments = r#"
[[segments]]
tangent = "50 m"
[[segments]]
spiral = "60 m"
form = "bloss"
[[segments]]
curve = "120 m"
radius = "400 m"
direction = "right"
superelevation = "80 mm"
[[segments]]
spiral = "80 m"
[[segments]]
tangent = "120 m"
"#;
    let line = "[center_line]\ntable = \"car.XML\"\nalignment = \"Main\"\ncant_unit = \"mm\"\n";
    let read = |track: &str, xml: &str| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("car.XML"), xml).unwrap();
        let file = folder.path().join("track.toml");
        std::fs::write(&file, track).unwrap();
        TrackFile::read(&file).map_err(|error| in_words(error.problems()))
    };
    let expected = TrackFile::parse("track.toml", segments)
        .unwrap()
        .track
        .center_line;
    let found = read(line, xml).unwrap();
    assert_eq!(found.doubts, Vec::<String>::new());
    assert_eq!(found.track.center_line, expected);
    let feet = |text: &str| {
        let mut out = xml.replace("Metric", "Imperial").replace("\"meter\"", "\"foot\"");
        for (from, to) in [
            ("radius=\"400\"", "radius=\"1312.33595800525\""),
            ("\"400\"", "\"1312.33595800525\""),
        ] {
            out = out.replace(from, to);
        }
        for length in ["60", "120", "80"] {
            let own = format!("length=\"{length}\"");
            out = out.replace(
                &own,
                &format!("length=\"{}\"", length.parse::<f64>().unwrap() / FOOT),
            );
        }
        out.replace("<Start>500 200</Start><End>500 250</End>", text)
    };
    let stations = feet("<Start>0 0</Start><End>0 164.041994750656</End>");
    let level = stations.replace("appliedCant=\"80\"", "appliedCant=\"0\"");
    let imperial = read(&line.replace("cant_unit = \"mm\"\n", ""), &level)
        .unwrap()
        .track
        .center_line;
    assert!((imperial.length() - 430.0).abs() < 1e-9);
    assert!((imperial.at(170.0).position[1] - expected.at(170.0).position[1]).abs() < 1e-6);

    let refused = |track: &str, xml: &str, parts: &[&str]| {
        let message = read(track, xml).unwrap_err();
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    };
    refused(
        &line.replace("alignment = \"Main\"\n", ""),
        xml,
        &["2 alignments: Side, Main", "alignment ="],
    );
    refused(&line.replace("Main", "Mian"), xml, &["no alignment Mian"]);
    refused(
        &line.replace("cant_unit = \"mm\"\n", ""),
        xml,
        &["car.XML:15", "unit of the cant", "cant_unit"],
    );
    refused(
        line,
        &xml.replace("bloss", "radioid"),
        &["car.XML:9", "radioid", "sinusoid"],
    );
    refused(
        line,
        &xml.replace("radiusEnd=\"400\"", "radiusEnd=\"450\""),
        &["car.XML:9", "450 m to the right"],
    );
    refused(
        line,
        &xml.replace("1110", "1140"),
        &["car.XML:10", "changes within a curve"],
    );
    refused(
        line,
        &xml.replace("rot=\"cw\" spiType=\"cl", "rot=\"ccw\" spiType=\"cl"),
        &["car.XML:11", "beside"],
    );
    refused(
        line,
        &xml.replace("<Line length", "<Chain length"),
        &["Chain is no line"],
    );
    refused(line, &xml.replace("</CoordGeom>", "</Coord>"), &["no XML"]);
    refused(
        line,
        &xml.replace("linearUnit=\"meter\"", ""),
        &["car.XML:3", "unit of lengths"],
    );
    refused(
        line,
        &xml.replace("length=\"80\"", "length=\"8e8\""),
        &["car.XML:11", "longer than 1000 km"],
    );
    refused(line, "<LandXML/>", &["no alignment with geometry"]);
    refused(&format!("{line}signs = \"usual\"\n"), xml, &["signs"]);
    // Ends by coordinates that the track does not reach are doubted.
    let ends = xml.replace(
        "<Line length=\"120\"/>",
        "<Line length=\"120\"><End>500 600</End></Line>",
    );
    let found = read(line, &ends).unwrap();
    assert!(
        found.doubts[0].contains("by coordinates 400 m"),
        "{:?}",
        found.doubts
    );
}
