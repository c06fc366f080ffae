//! The runs, their tables, and the programs that read them.

use std::collections::BTreeMap;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

pub const NAMES: [&str; 12] = [
    "vdrun_toe_out_0.2_psi_0",
    "vdrun_toe_0_psi_0",
    "vdrun_toe_in_0.2_psi_0",
    "vdrun_toe_out_0.2_psi_0.012",
    "vdrun_toe_0_psi_0.012",
    "vdrun_toe_in_0.2_psi_0.012",
    "cdrun_toe_out_0.2_psi_0",
    "cdrun_toe_0_psi_0",
    "cdrun_toe_in_0.2_psi_0",
    "cdrun_toe_out_0.2_psi_0.012",
    "cdrun_toe_0_psi_0.012",
    "cdrun_toe_in_0.2_psi_0.012",
];

/// Returns the twelve runs, computed once.
pub fn runs() -> PathBuf {
    static RUNS: OnceLock<PathBuf> = OnceLock::new();
    let made = || {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("octave");
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .args(["reproduce", "--quiet", "--force", "--out"])
            .arg(&folder)
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
        folder.join("runs")
    };
    RUNS.get_or_init(made).clone()
}

/// A run's `result.csv` by column.
pub struct Csv(BTreeMap<String, Vec<f64>>);

impl Csv {
    pub fn of(run: &str) -> Self {
        let text = fs::read_to_string(runs().join(run).join("result.csv")).unwrap();
        let mut lines = text.lines();
        let names: Vec<&str> = lines.next().unwrap().split(',').collect();
        let mut columns = vec![Vec::new(); names.len()];
        for line in lines {
            for (column, cell) in columns.iter_mut().zip(line.split(',')) {
                column.push(cell.parse::<f64>().unwrap());
            }
        }
        Self(names.into_iter().map(str::to_owned).zip(columns).collect())
    }

    pub fn get(&self, name: &str) -> Vec<f64> {
        self.0.get(name).unwrap_or_else(|| panic!("{name}")).clone()
    }

    /// Returns a column with a factor and an offset.
    pub fn moved(&self, name: &str, factor: f64, offset: f64) -> Vec<f64> {
        self.get(name)
            .iter()
            .map(|value| factor * value + offset)
            .collect()
    }
}

pub fn octave(script: &str, arguments: &[&Path]) {
    let program = env::var("WEDGELAB_OCTAVE").unwrap_or_else(|_| "octave-cli".into());
    call(&program, &["--no-init-file", "--quiet"], script, "m", arguments);
}

pub fn python(script: &str, arguments: &[&Path]) {
    let program = env::var("WEDGELAB_PYTHON").unwrap_or_else(|_| "python3".into());
    call(&program, &[], script, "py", arguments);
}

fn call(program: &str, options: &[&str], script: &str, ending: &str, arguments: &[&Path]) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(format!("script.{ending}"));
    fs::write(&file, script).unwrap();
    let output = Command::new(program)
        .args(options)
        .arg(&file)
        .args(arguments)
        .output()
        .unwrap_or_else(|error| {
            panic!("{program} does not start: {error}; `cargo xtask test --only octave` installs it")
        });
    assert!(
        output.status.success(),
        "{program}: {}\n{}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
}
