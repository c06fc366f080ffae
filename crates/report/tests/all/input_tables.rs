//! Tables read back: what we write to the same bits, and every way in which a table can be wrong.

use std::fs;
use std::path::Path;

use miette::Diagnostic;
use quantity::{Kind, System as Units};
use report::csv;
use report::output_table::{Cell, Content, Description};
use report::parquet::{Storage, TableWriter};
use report::table::{ResultTable, TableError};
use study::case::builtin;
use study::result::RunResult;
use study::run::Run;

fn short(units: &str) -> RunResult {
    let set = [
        "simulation.duration=0.05 s".to_owned(),
        format!("simulation.output_units={units}"),
    ];
    let case = builtin::case_with("cdrun_toe_in_0.2_psi_0.012", &set).unwrap();
    Run::new(&case).unwrap().finish(|_| ())
}

fn written(result: &RunResult) -> Vec<u8> {
    let mut bytes = Vec::new();
    csv::write(result, &mut bytes).unwrap();
    bytes
}

fn parse(text: &str) -> Result<ResultTable, TableError> {
    ResultTable::parse(Path::new("a.csv"), text.as_bytes())
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Returns the message and the advice.
#[track_caller]
fn refused(text: &str) -> (TableError, String) {
    let error = parse(text).unwrap_err();
    let help = error.help().map(|help| help.to_string()).unwrap_or_default();
    let all = format!("{error}\n{help}");
    assert!(all.contains("a.csv") && !help.is_empty(), "{all}");
    (error, all)
}

#[track_caller]
fn says(text: &str, parts: &[&str]) {
    let (_, all) = refused(text);
    for part in parts {
        assert!(all.contains(part), "{part:?} is not in: {all}");
    }
}

#[test]
fn what_is_written_is_read_to_the_same_bits() {
    for (name, units) in [("us", Units::Us), ("si", Units::Si)] {
        let mut result = short(name);
        for (column, value) in [(1, 0.1 + 0.2), (2, 5e-324), (3, 1e300), (4, -0.0), (5, 1e-7)] {
            result.values[column][1] = value;
        }
        let table = ResultTable::parse(Path::new("result.csv"), &written(&result)).unwrap();
        assert_eq!(
            (table.units, table.columns().len()),
            (units, result.columns.len())
        );
        assert_eq!(bits(table.times()), bits(result.column("time").unwrap()));
        for ((read, column), values) in table.columns().iter().zip(&result.columns).zip(&result.values) {
            assert_eq!((&read.name, read.kind), (&column.name, column.kind));
            let inside: Vec<f64> = values
                .iter()
                .map(|v| csv::converted(*v, column.kind, units))
                .collect();
            assert_eq!(bits(&read.written), bits(&inside), "{}", column.name);
            assert_eq!(bits(&read.in_units(units)), bits(&inside));
            for (si, value) in read.si().iter().zip(values) {
                // One rounding when it was written, one when it is read.
                assert!(
                    (si - value).abs() <= 2.3e-16 * value.abs(),
                    "{}: {si} {value}",
                    column.name
                );
            }
            if units == Units::Si {
                assert_eq!(bits(&read.si()), bits(values), "{}", column.name);
            }
        }
    }
}

#[test]
fn the_same_run_in_both_units_is_the_same() {
    let [us, si] = ["us", "si"]
        .map(|units| ResultTable::parse(Path::new("result.csv"), &written(&short(units))).unwrap());
    for (a, b) in us.columns().iter().zip(si.columns()) {
        for (x, y) in a.in_units(Units::Si).iter().zip(&b.written) {
            assert!((x - y).abs() <= 5e-16 * y.abs(), "{}: {x} {y}", a.name);
        }
        for (x, y) in a.written.iter().zip(&b.in_units(Units::Us)) {
            assert!((x - y).abs() <= 5e-16 * y.abs(), "{}: {x} {y}", a.name);
        }
    }
}

#[test]
fn tables_of_others_are_read() {
    let text = "\u{feff}# from a test rig\r\n\
                wedge_z_m, time_s ,clearance_m,ratio,column_upper_left_state,pull_N,twist_N_m\r\n\
                0.1,0,1,0.5,2,10,20\r\n\r\n# a remark\r\n0.2,0.5,2,.5,1,1e1,-2E1";
    let table = parse(text).unwrap();
    assert_eq!((table.units, table.times()), (Units::Si, &[0.0, 0.5][..]));
    for (name, kind) in [
        ("wedge_z", Kind::Length),
        ("clearance", Kind::Length),
        ("ratio", Kind::Dimensionless),
        ("column_upper_left_state", Kind::Count),
        ("pull", Kind::Force),
        ("twist", Kind::Moment),
    ] {
        assert_eq!(table.column(name).unwrap().kind, kind, "{name}");
    }
    assert_eq!(table.column("wedge_z_m").unwrap().name, "wedge_z");
    // Asked for in the other unit, it is still the same column.
    assert_eq!(table.column("wedge_z_in").unwrap().name, "wedge_z");
    let inches = table.column("clearance").unwrap().in_units(Units::Us);
    assert!((inches[1] - 2.0 / 0.0254).abs() < 1e-12);
    // Neither seconds nor radians belong to a system.
    let neutral = parse("time_s,wedge_yaw_rad,wedge_yaw_rate_rad_per_s\n0,1,2\n").unwrap();
    assert_eq!(neutral.column("wedge_yaw_rate").unwrap().kind, Kind::AngularSpeed);
    // Moments and energies are written alike; ours are known by name.
    let us = parse("time_s,coil_energy_lbf_in,side_frame_yaw_moment_lbf_in\n0,1,1\n").unwrap();
    let kinds: Vec<Kind> = us.columns().iter().map(|column| column.kind).collect();
    assert_eq!(kinds, [Kind::Time, Kind::Energy, Kind::Moment]);
}

#[test]
fn files_that_are_no_tables() {
    for (bytes, text) in [
        (&b""[..], "empty"),
        (b"\n \n# nothing\n", "empty"),
        (b"{\"schema\": \"wedgelab.summary/1\"}", "JSON"),
        (b"[wedge]\ndamping = \"constant\"\n", "a case file"),
        (b"[other]\nkey = 1\n", "TOML"),
        (b"<svg></svg>", "a figure"),
        (b"<other/>", "drawing"),
        (b"MATLAB 5.0 MAT-file, Wedgelab\0\0", "a MAT-file"),
        (b"\x89PNG\r\n\x1a\n\0\0", "a figure"),
        (b"time_s,a\n0,\0\n", "not text"),
        (b"time_s,a\n0,\xe4\n", "no text"),
    ] {
        let error = ResultTable::parse(Path::new("x"), bytes).unwrap_err();
        assert!(matches!(error, TableError::Foreign { .. }), "{error}");
        assert!(error.to_string().contains(text), "{error}");
    }
    says("0,1\n1,2\n", &["line 1", "numbers stand where the names"]);
    says("time_s;wedge_x_in\n0;1\n", &["`;` stands between"]);
    says("time_s\twedge_x_in\n0\t1\n", &["a tab stands between"]);
}

#[test]
fn names_that_are_wrong() {
    says(
        "wedge_x_in,coil_length_in\n0,1\n",
        &["line 1", "no column `time_s`", "in seconds"],
    );
    says(
        "# rig\nTime_s,wedge_x_in\n0,1\n",
        &["line 2", "is `Time_s` the time?"],
    );
    says("times,wedge_x_in\n0,1\n", &["is `times` the time?"]);
    says(
        "time,wedge_x_in\n0,1\n",
        &[
            "column 1 (`time`) has no unit",
            "a time is expected",
            "write time_s",
        ],
    );
    says(
        "time_s,wedge_x\n0,1\n",
        &[
            "column 2 (`wedge_x`) has no unit",
            "a length",
            "wedge_x_in or wedge_x_m",
        ],
    );
    says(
        "time_s,wedge_x_N\n0,1\n",
        &[
            "column 2 (`wedge_x_N`) is a force; a length is expected",
            "wedge_x_in",
        ],
    );
    says("time_s,,wedge_x_in\n0,1,2\n", &["column 2 has no name"]);
    let (error, all) = refused("time_s,wedge_x_in,coil_force_lbf,wedge_x_in\n0,1,2,3\n");
    assert!(
        matches!(
            error,
            TableError::Duplicate {
                first: 2,
                second: 4,
                ..
            }
        ),
        "{all}"
    );
    let (error, all) = refused("time_s,wedge_x_in,coil_force_N\n0,1,2\n");
    assert!(matches!(error, TableError::Mixed { .. }), "{all}");
    assert!(
        all.contains("`wedge_x_in` is in US") && all.contains("`coil_force_N` in SI"),
        "{all}"
    );
    let (error, _) = refused("time_s,wedge_x_in,wedge_x_m\n0,1,2\n");
    assert!(matches!(error, TableError::Mixed { .. }));
}

#[test]
fn numbers_that_are_wrong() {
    let head = "# rig\ntime_s,wedge_x_in,coil_force_lbf\n";
    let (error, _) = refused(head);
    assert!(matches!(error, TableError::NoRows { .. }));
    // Cut off in the middle of the last line, or before it.
    for end in ["0.2,3", "0.2,3\n", "0.2"] {
        let (error, all) = refused(&format!("{head}0,1,2\n0.1,2,3\n{end}"));
        assert!(
            matches!(
                error,
                TableError::Truncated {
                    line: 5,
                    expected: 3,
                    ..
                }
            ),
            "{all}"
        );
    }
    let (error, all) = refused(&format!("{head}0,1\n0.1,2,3\n"));
    assert!(
        matches!(
            error,
            TableError::Ragged {
                line: 3,
                found: 2,
                expected: 3,
                ..
            }
        ),
        "{all}"
    );
    let (error, all) = refused(&format!("{head}0,1,2,3\n"));
    assert!(
        matches!(
            error,
            TableError::Ragged {
                line: 3,
                found: 4,
                ..
            }
        ),
        "{all}"
    );
    // Remarks and empty lines count as lines.
    let (error, all) = refused(&format!("{head}0,1,2\n\n# a remark\r\n\r\n   \n0.1,2,x\n"));
    assert!(
        matches!(
            error,
            TableError::NotANumber {
                line: 8,
                column: 3,
                ..
            }
        ),
        "{all}"
    );
    for cell in ["1.5 in", "", "NaN", "inf", "1,5", "0x1", "--"] {
        let (error, all) = refused(&format!("{head}0,1,2\n0.1,\"{cell}\",3\n"));
        assert!(
            matches!(
                error,
                TableError::NotANumber {
                    line: 4,
                    column: 2,
                    ..
                }
            ),
            "{all}"
        );
        assert!(
            all.contains(&format!("\"{cell}\"")) && all.contains("`wedge_x_in`"),
            "{all}"
        );
    }
    for time in ["0.1", "0.05", "-1"] {
        let (error, all) = refused(&format!("{head}0,1,2\n0.1,2,3\n{time},2,3\n"));
        assert!(
            matches!(
                error,
                TableError::NotIncreasing {
                    line: 5,
                    column: 1,
                    ..
                }
            ),
            "{all}"
        );
        assert!(all.contains(&format!("the time {time} s follows 0.1 s")), "{all}");
    }
}

/// A file that was cut anywhere is read as far as it goes or refused, and never panics.
#[test]
fn files_cut_anywhere() {
    let text = "time_s,wedge_x_in,\"odd, \u{e4}_lbf\"\n0,1.25,-2\n0.1,2.5,3e-7\n";
    for cut in 0..text.len() {
        match ResultTable::parse(Path::new("a.csv"), &text.as_bytes()[..cut]) {
            Ok(table) => assert!(table.times().len() <= 2 && table.columns().len() == 3, "{cut}"),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
        let mut changed = text.as_bytes().to_vec();
        for byte in [b',', b'"', b'\n', 0, 0xff] {
            changed[cut] = byte;
            let _ = ResultTable::parse(Path::new("a.csv"), &changed);
        }
    }
}

#[test]
fn results_that_are_not_there() {
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path();
    fs::create_dir_all(path.join("reproduction/runs/soft")).unwrap();
    fs::write(
        path.join("reproduction/runs/soft/result.csv"),
        written(&short("si")),
    )
    .unwrap();
    assert!(ResultTable::read(&path.join("reproduction/runs/soft")).is_ok());
    assert!(ResultTable::read(&path.join("reproduction/runs/soft/result.csv")).is_ok());
    let advice = |name: &str| {
        ResultTable::read(&path.join(name))
            .unwrap_err()
            .help()
            .unwrap()
            .to_string()
    };
    assert!(advice("reproduction").contains("there are results in"));
    assert!(advice("reproduction").contains("soft"));
    assert!(advice("reproduktion").contains("did you mean"));
    assert!(advice("reproduction/runs/sotf").contains("soft?"));
    assert!(advice("elsewhere/entirely").contains("wedgelab run"));
}

#[test]
fn columns_that_are_not_there_are_guessed() {
    let table = ResultTable::parse(Path::new("result.csv"), &written(&short("us"))).unwrap();
    let advice = |name: &str| {
        let error = table.column(name).unwrap_err();
        assert!(matches!(&error, TableError::NoColumn { name: wanted, .. } if wanted == name));
        error.help().unwrap().to_string()
    };
    assert_eq!(
        advice("vertical_wedge_fource"),
        "did you mean vertical_wedge_force?"
    );
    assert!(advice("yaw_moment").starts_with("columns with these words are "));
    assert!(advice("yaw_moment").contains("side_frame_yaw_moment"));
    assert!(advice("q").contains("its columns are time, bolster_vertical"));
    assert!(advice("q").ends_with("and 127 more"), "{}", advice("q"));
}

/// All units of the table of units, at the end of a name or in brackets, in one system of units.
#[test]
fn issue_048_tables_of_others_in_any_unit() {
    let text = "time_ms,wedge_z_mm,vertical_wedge_force [kN],wedge_pitch_deg,speed \
                [km/h],rate_kN_per_mm,least_min\n\
                0,1.5,2,180,36,0.5,7\n500,2.5,3,90,72,0.25,8\n";
    let table = parse(text).unwrap();
    assert_eq!((table.units, table.times()), (Units::Si, &[0.0, 0.5][..]));
    for (name, kind, first) in [
        ("wedge_z", Kind::Length, 1.5e-3),
        ("vertical_wedge_force", Kind::Force, 2000.0),
        ("wedge_pitch", Kind::Angle, std::f64::consts::PI),
        ("speed", Kind::Speed, 10.0),
        ("rate", Kind::Stiffness, 5e5),
        ("least_min", Kind::Dimensionless, 7.0),
    ] {
        let column = table.column(name).unwrap();
        assert_eq!(column.kind, kind, "{name}");
        assert!(
            (column.si()[0] / first - 1.0).abs() < 1e-15,
            "{name}: {}",
            column.si()[0]
        );
    }

    let us = parse("time_s,vertical_wedge_force_kip,speed_mph,force_in_lbf\n0,1.5,60,3\n1,2,60,3\n").unwrap();
    assert_eq!(us.units, Units::Us);
    assert_eq!(
        us.column("vertical_wedge_force").unwrap().written,
        [1500.0, 2000.0]
    );
    assert_eq!(us.column("force_in").unwrap().kind, Kind::Force);

    says("time_s,wedge_z_kN\n0,1\n", &["a force; a length is expected"]);
    says(
        "time_s,wedge_z_mm,pull_kip\n0,1,1\n",
        &["wedge_z_mm", "SI", "pull_kip"],
    );
    says("time_s,level [kN^5]\n0,1\n", &["a quantity that no column has"]);
}

/// Columns of a Parquet file in other units are converted as those of a CSV file are.
#[test]
fn issue_048_parquet_tables_of_others_in_any_unit() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("other.parquet");
    let column = |name: &str| Description {
        name: name.to_owned(),
        unit: String::new(),
        kind: Kind::Count,
        text: String::new(),
        content: Content::Number,
    };
    let columns = ["time_ms", "wedge_z_mm", "pull [kN]"].map(column).to_vec();
    let mut table =
        TableWriter::new(fs::File::create(&file).unwrap(), columns, Storage::Values, &[]).unwrap();
    for row in [[0.0, 1.5, 2.0], [500.0, 2.5, 3.0]] {
        table.row(row.into_iter().map(Cell::Number)).unwrap();
    }
    table.finish().unwrap();
    let table = ResultTable::read(&file).unwrap();
    assert_eq!((table.units, table.times()), (Units::Si, &[0.0, 0.5][..]));
    assert_eq!(table.column("wedge_z").unwrap().si(), [1.5e-3, 2.5e-3]);
    assert_eq!(table.column("pull").unwrap().si(), [2000.0, 3000.0]);
}
