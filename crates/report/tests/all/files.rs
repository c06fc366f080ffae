//! Files of results: whole, faithful, and never by accident overwritten.

use std::fs;
use std::io;
use std::path::Path;

use quantity::System as Units;
use report::output_table::Cell;
use report::run_files::{self, RunFiles};
use report::{csv, curves_files, lock_up_files, mat};
use staging::{FileError, Folder, check_all};
use study::case::{Case, builtin};
use study::lock_up::{LockUpMap, MapAxis, MapPoint, MapRange, RigOutcome};
use study::result::RunResult;
use study::run::Run;
use study::truck::loop_curve::{LoopCurve, LoopKind};

const FIXED: &str = "time_s,bolster_vertical_in,wedge_x_in,wedge_z_in,wedge_pitch_rad,wedge_yaw_rad,\
                     longitudinal_wedge_force_lbf,vertical_wedge_force_lbf,vertical_force_on_side_frame_lbf,\
                     side_frame_friction_power_lbf_in_per_s,bolster_friction_power_lbf_in_per_s,\
                     side_frame_dissipation_lbf_in_per_s,bolster_dissipation_lbf_in_per_s,\
                     side_frame_roll_moment_lbf_in,side_frame_pitch_moment_lbf_in,\
                     side_frame_yaw_moment_lbf_in,coil_force_lbf,coil_length_in";

fn short(units: &str) -> (Case, RunResult) {
    let set = [
        "simulation.duration=0.05 s".to_owned(),
        format!("simulation.output_units={units}"),
    ];
    let case = builtin::case_with("vdrun_toe_in_0.2_psi_0.012", &set).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    (case, result)
}

fn text(result: &RunResult) -> String {
    let mut bytes = Vec::new();
    csv::write(result, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// Names in a folder and below, hidden ones too.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_table_begins_with_the_fixed_columns() {
    let (_, result) = short("us");
    let text = text(&result);
    let header = text.lines().next().unwrap();
    assert!(header.starts_with(&format!("{FIXED},")), "{header}");
    assert!(!text.contains('\r') && text.ends_with('\n'));
    let (_, result) = short("si");
    let si = FIXED
        .replace("lbf_in_per_s", "W")
        .replace("_in_per_s", "_m_per_s")
        .replace("moment_lbf_in", "moment_N_m")
        .replace("_lbf", "_N")
        .replace("_in,", "_m,");
    let si = si.strip_suffix("_in").map(|start| format!("{start}_m")).unwrap();
    assert!(self::text(&result).starts_with(&format!("{si},")), "{si}");
}

#[test]
fn the_table_reads_back_to_the_same_bits() {
    let (_, mut result) = short("us");
    // Values that are hard to write.
    for (column, value) in [(1, 0.1 + 0.2), (2, 5e-324), (3, f64::MAX), (4, -0.0), (5, 1e-7)] {
        result.values[column][1] = value;
    }
    let text = text(&result);
    let mut rows = 0;
    for (row, line) in text.lines().skip(1).enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), result.columns.len());
        for ((cell, column), values) in cells.iter().zip(&result.columns).zip(&result.values) {
            let read: f64 = cell.parse().unwrap();
            let value = values[row] * column.kind.from_si(Units::Us);
            assert_eq!(read.to_bits(), value.to_bits(), "{} {cell} {value}", column.name);
            if column.name.ends_with("_state") {
                assert!(["0", "1", "2"].contains(cell), "{cell}");
            }
        }
        rows += 1;
    }
    assert_eq!(rows, result.rows());
    assert_eq!(rows, 6);
}

/// The MAT-file is in the thesis's units whatever the case's, and carries no date.
#[test]
fn the_mat_file_depends_on_the_run_alone() {
    let [us, si] = ["us", "si"].map(|units| {
        let (case, result) = short(units);
        let mut bytes = Vec::new();
        mat::write(&case, &result, &mut bytes).unwrap();
        bytes
    });
    assert!(us == si);
    assert!(us.starts_with(b"MATLAB 5.0 MAT-file, wedgelab "));
    // Thirteen matrices of six rows, and a text.
    let mut names = Vec::new();
    let mut place = 128;
    while place < us.len() {
        let word = |at: usize| u32::from_le_bytes(us[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((word(place), place % 8), (14, 0));
        let length = word(place + 44);
        names.push(String::from_utf8(us[place + 48..place + 48 + length].to_vec()).unwrap());
        if names.last().is_some_and(|name| name != "about") {
            assert_eq!(word(place + 32), 6, "{names:?}");
        }
        place += 8 + word(place + 4);
    }
    assert_eq!(place, us.len());
    assert_eq!(
        (names.len(), names[1].as_str(), names[13].as_str()),
        (14, "y", "about")
    );
}

#[test]
fn a_run_is_written_once() {
    let (case, result) = short("us");
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path().join("new/deep/run");
    let folder = Folder::check(&path, &run_files::NAMES, false).unwrap();
    assert!(names(temporary.path()).is_empty(), "checking leaves nothing");
    RunFiles::write(&case, &folder, &result).unwrap();
    assert_eq!(
        names(&path),
        ["case.toml", "result.csv", "result.mat", "summary.json"]
    );
    assert_eq!(names(path.parent().unwrap()), ["run"]);

    let again = Folder::check(&path, &run_files::NAMES, false).unwrap_err();
    assert!(again.to_string().contains("result.csv"), "{again}");
    // One that was checked before the files appeared.
    let late = RunFiles::write(&case, &folder, &result).unwrap_err();
    assert!(matches!(late, FileError::Exists { .. }), "{late}");

    fs::write(path.join("notes.txt"), "mine").unwrap();
    fs::write(path.join("result.csv"), "old").unwrap();
    let folder = Folder::check(&path, &run_files::NAMES, true).unwrap();
    RunFiles::write(&case, &folder, &result).unwrap();
    assert_eq!(
        names(&path),
        [
            "case.toml",
            "notes.txt",
            "result.csv",
            "result.mat",
            "summary.json"
        ]
    );
    assert_eq!(
        fs::read_to_string(path.join("result.csv")).unwrap(),
        text(&result)
    );
}

#[test]
fn a_failure_in_the_middle_leaves_nothing() {
    let temporary = tempfile::tempdir().unwrap();
    let fail = |folder: &Folder| {
        folder.write(|files| {
            files.add("first", |out| out.write_all(b"whole"))?;
            files.add("second", |out| {
                out.write_all(&[b'x'; 100_000])?;
                Err(io::Error::other("no space left"))
            })
        })
    };
    let path = temporary.path().join("a/b");
    let folder = Folder::check(&path, &["first", "second"], false).unwrap();
    let error = fail(&folder).unwrap_err();
    assert!(error.to_string().contains("second") && error.to_string().contains("no space left"));
    assert!(names(temporary.path()).is_empty());

    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("first"), "old").unwrap();
    let folder = Folder::check(&path, &["first", "second"], true).unwrap();
    fail(&folder).unwrap_err();
    assert_eq!(names(&path), ["first"]);
    assert_eq!(fs::read_to_string(path.join("first")).unwrap(), "old");
}

#[test]
fn what_is_in_the_way_is_named() {
    let temporary = tempfile::tempdir().unwrap();
    let file = temporary.path().join("file");
    fs::write(&file, "").unwrap();
    for path in [file.clone(), file.join("below/it")] {
        let error = Folder::check(&path, &["x"], true).unwrap_err();
        assert!(
            matches!(&error, FileError::NotAFolder { path, .. } if *path == file),
            "{error}"
        );
    }
    let error = Folder::check(temporary.path(), &["file"], false).unwrap_err();
    assert!(
        matches!(&error, FileError::Exists { files } if *files == [file.clone()]),
        "{error}"
    );
    fs::create_dir(temporary.path().join("folder")).unwrap();
    let error = Folder::check(temporary.path(), &["folder"], true).unwrap_err();
    assert!(matches!(error, FileError::NotAFile { .. }), "{error}");

    let names = ["1", "2", "3"];
    for name in names {
        fs::write(temporary.path().join(name), "").unwrap();
    }
    let all = [
        (temporary.path().to_owned(), &names[..]),
        (temporary.path().to_owned(), &["file"][..]),
    ];
    let error = check_all(all, false).unwrap_err().to_string();
    assert!(error.ends_with("and 1 more"), "{error}");
}

/// Texts in tables are read back as they were written, whatever is in them.
#[test]
fn issue_047_texts_in_tables_read_back_the_same() {
    const REASONS: [&str; 6] = [
        "the wedge lifts off, slides",
        "\"quoted\" at the beginning, and \"\"twice",
        "two\nlines\r\nor three",
        ",",
        "\"",
        "plain; with a semicolon",
    ];
    let read = |bytes: &[u8]| -> Vec<Vec<String>> {
        let mut reader = ::csv::ReaderBuilder::new().has_headers(false).from_reader(bytes);
        let records = reader.records().map(Result::unwrap);
        records
            .map(|record| record.iter().map(str::to_owned).collect())
            .collect()
    };
    let span = |axis| MapRange {
        axis,
        ends: [0.1, 0.2],
    };
    let map = LockUpMap {
        spans: [span(MapAxis::Angle), span(MapAxis::Friction)],
        values: [vec![0.1], vec![0.1; REASONS.len()]],
        cells: REASONS
            .iter()
            .map(|reason| MapPoint {
                found: RigOutcome::Unknown((*reason).to_owned()),
                closing_angle: 0.1,
                margin: 0.1,
                holding: [f64::NAN, 0.5],
                ratio: f64::INFINITY,
                expected_ratio: None,
            })
            .collect(),
        interrupted: None,
    };
    let mut bytes = Vec::new();
    lock_up_files::write_table(&map, Units::Us, &mut bytes).unwrap();
    let rows = read(&bytes);
    assert_eq!(rows.len(), 1 + REASONS.len());
    for (row, reason) in rows[1..].iter().zip(REASONS) {
        assert_eq!(row[9], reason);
        // What is no number is an empty cell.
        assert_eq!(row[5..9], ["", "0.5", "", ""]);
    }
    let mut loops: Vec<curves_files::LabeledLoop> = Vec::new();
    for reason in REASONS {
        let own = LoopCurve {
            kind: LoopKind::Roll,
            rows: 0..1,
            motion: vec![0.5],
            resistance: vec![0.0],
            amplitude: 0.0,
            stiffness: 0.0,
            friction: 0.0,
            energy: 0.0,
            loss_ratio: 0.0,
        };
        loops.push((reason.to_owned(), own));
    }
    let mut bytes = Vec::new();
    curves_files::write(&loops, &mut bytes).unwrap();
    let rows = read(&bytes);
    assert_eq!(rows.len(), 1 + REASONS.len());
    for (row, reason) in rows[1..].iter().zip(REASONS) {
        assert_eq!(row[..], [reason, "0.5", "0"]);
    }
    // The writer itself: first cells may be empty.
    let mut bytes = Vec::new();
    let mut lines = csv::Lines::new(&[], &mut bytes).unwrap();
    let text = Cell::from("a,b");
    lines
        .row([
            Cell::Missing,
            text,
            Cell::Number(1e-7),
            Cell::Decimal(1e-7),
            Cell::Decimal(f64::NAN),
        ])
        .unwrap();
    lines.row([Cell::from("")]).unwrap();
    assert_eq!(
        String::from_utf8(bytes).unwrap(),
        "\n,\"a,b\",1e-7,0.0000001,\n\n"
    );
}
