//! Tables: results of other programs, and motions and coils in CSV files beside a case.

use std::path::Path;
use std::sync::LazyLock;

use quantity::Kind;
use report::comparison::{ComparedResult, Comparison};
use report::table::ResultTable;
use study::case::{Case, CaseMotion, CoilForce, QuantityTable, builtin};

use super::cases::{outcome, refused};
use super::{ReadOutcome, Reader, corpus};
use crate::limits::FINITE_COMPARISONS;

/// Results to be compared.
pub const RESULTS: Reader = Reader {
    name: "results",
    about: "results as CSV files, and comparing them with another one",
    corpus: corpus!("results": "foreign.csv", "run_si.csv", "run_us.csv"),
    dictionary: &[
        b"time_s",
        b"wedge_z_in",
        b"wedge_z_m",
        b"vertical_wedge_force_lbf",
        b"vertical_wedge_force_n",
        b"coil_force_lbf",
        b"bolster_vertical_in",
        b"side_frame_yaw_moment_lbf_in",
        b"\"\"",
        b"\"a,b\"",
        b"#",
        b",",
        b";",
        b"MATLAB 5.0 MAT-file",
        b"{",
        b"<html>",
    ],
    read: result,
};

/// Tables beside a case.
pub const TABLES: Reader = Reader {
    name: "tables",
    about: "motions and coils in CSV files beside a case",
    corpus: corpus!("tables": "coil.csv", "motion.csv", "yaw.csv"),
    dictionary: &[
        b"time [s]",
        b"time [ms]",
        b"value [in]",
        b"value [deg]",
        b"compression [in]",
        b"force [lbf]",
        b"[",
        b"]",
        b",",
        b"#",
    ],
    read: table,
};

/// The result that others are compared with.
static OWN: LazyLock<Option<ComparedResult>> = LazyLock::new(|| {
    let text = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/corpus/results/run_us.csv"));
    entry("own", text).ok()
});

fn entry(name: &str, bytes: &[u8]) -> Result<ComparedResult, report::table::TableError> {
    let table = ResultTable::parse(Path::new(&format!("no-such-folder/{name}.csv")), bytes)?;
    Ok(ComparedResult {
        label: name.to_owned(),
        table,
    })
}

fn result(input: &[u8]) -> ReadOutcome {
    let foreign = match entry("foreign", input) {
        Ok(foreign) => foreign,
        Err(error) => return ReadOutcome::refused(&error),
    };
    let Some(own) = OWN.as_ref() else {
        return ReadOutcome::NO_TEXT;
    };
    let rows = foreign.table.times().len();
    for column in foreign.table.columns() {
        assert!(column.written.len() == rows, "ragged table: {}", column.name);
        assert!(
            foreign.table.find(&column.name).is_some(),
            "column lost: {}",
            column.name
        );
    }
    let pairs = [[own.clone(), foreign.clone()], [foreign, own.clone()]];
    let outcomes = pairs.map(|pair| compare(&pair));
    ReadOutcome::ACCEPTED.or(outcomes[0]).or(outcomes[1])
}

fn compare(entries: &[ComparedResult]) -> ReadOutcome {
    let comparison = match Comparison::of(entries, &[]) {
        Ok(comparison) => comparison,
        Err(error) => return ReadOutcome::refused(&error),
    };
    for difference in &comparison.differences {
        let finite = difference.largest.is_finite() && difference.root_mean_square.is_finite();
        assert!(finite || !FINITE_COMPARISONS, "not finite: {}", difference.column);
    }
    let mut bytes = Vec::new();
    assert!(
        comparison.write(entries, &mut bytes).is_ok() && !bytes.is_empty(),
        "nothing written"
    );
    ReadOutcome::ACCEPTED
}

/// A case with such tables.
static BASE: LazyLock<Option<Case>> = LazyLock::new(|| {
    let set = ["simulation.duration=0.1 s".to_owned()];
    builtin::case_with("vdrun_toe_out_0.2_psi_0.012", &set).ok()
});

fn table(input: &[u8]) -> ReadOutcome {
    let (Ok(text), Some(base)) = (std::str::from_utf8(input), BASE.as_ref()) else {
        return ReadOutcome::NO_TEXT;
    };
    let [_, _, vertical, _, _, yaw] = [0, 1, 2, 3, 4, 5];
    let motion = |kind: Kind, coordinate: usize| {
        let table = match QuantityTable::parse_motion("table.csv", text, kind) {
            Ok(table) => table,
            Err(error) => return refused(&error),
        };
        let mut document = base.document.clone();
        document.bolster.coordinates[coordinate] = CaseMotion::Table(table);
        outcome(Case::from_document(&document))
    };
    let all = motion(Kind::Length, vertical).or(motion(Kind::Angle, yaw));
    match QuantityTable::parse_coil("table.csv", text) {
        Ok(table) => {
            let mut document = base.document.clone();
            document.control_coil.force = CoilForce::Table(table);
            all.or(outcome(Case::from_document(&document)))
        }
        Err(error) => all.or(refused(&error)),
    }
}
