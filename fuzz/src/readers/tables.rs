//! Tables: results of other programs, and motions and coils in CSV files beside a case.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use report::comparison::{ComparedResult, Comparison};
use report::table::ResultTable;
use study::case::Case;

use super::cases::outcome;
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

/// What names such a table in a case: as motions of a length and of an angle, and as a coil.
const NAMES: [&str; 3] = [
    "bolster.vertical={ shape = \"table\", file = \"table.csv\" }",
    "bolster.yaw={ shape = \"table\", file = \"table.csv\" }",
    "control_coil.table=\"table.csv\"",
];

fn table(input: &[u8]) -> ReadOutcome {
    let written = tempfile::tempdir().and_then(|folder| {
        fs::write(folder.path().join("table.csv"), input)?;
        Ok(folder)
    });
    let folder = match written {
        Ok(folder) => folder,
        Err(error) => panic!("no table beside the case: {error}"),
    };
    let base = "[wedge]\ndamping = \"variable\"\n[simulation]\nduration = \"0.1 s\"\n";
    NAMES.into_iter().fold(ReadOutcome::NO_TEXT, |all, name| {
        let case = Case::parse("case.toml", base, folder.path(), &[name.to_owned()]);
        all.or(outcome(case))
    })
}
