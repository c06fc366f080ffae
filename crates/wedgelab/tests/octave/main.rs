//! Cross-code: Octave and SciPy read `result.mat` to the bit, and the plotting scripts draw our curves in
//! Octave.
//!
//! The expected values come from `result.csv` and from the thesis's appendices D and E, written anew: which
//! column over which, which rows, which limits.

#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use runs::{Csv, NAMES, octave, python, runs};
use wanted::wanted;

mod runs;
mod wanted;
/// Writes `variable NAME ROWS COLUMNS CLASS` and the rows for every variable of a MAT-file.
const OCTAVE_DUMP: &str = "\
arguments = argv ();
run = load (arguments{end-1});
file = fopen (arguments{end}, 'w');
for [value, name] = run
  kind = class (value);
  fprintf (file, 'variable %s %d %d %s\\n', name, rows (value), columns (value), kind);
  if (ischar (value))
    fprintf (file, '%s\\n', strrep (value, \"\\n\", ' '));
  else
    form = [repmat('%.17g ', 1, columns (value)) \"\\n\"];
    fprintf (file, form, value.');
  end
end
fclose (file);
";

const SCIPY_DUMP: &str = "\
import sys
import scipy.io
names = {'float64': 'double'}
run = scipy.io.loadmat(sys.argv[1])
with open(sys.argv[2], 'w', encoding='utf-8') as file:
    for name, value in run.items():
        if name.startswith('__'):
            continue
        text = value.dtype.kind == 'U'
        shape = (1, len(value[0])) if text else value.shape
        kind = 'char' if text else names.get(value.dtype.name, value.dtype.name)
        file.write(f'variable {name} {shape[0]} {shape[1]} {kind}\\n')
        if text:
            file.write(value[0].replace('\\n', ' ') + '\\n')
        else:
            for row in value:
                file.write(' '.join(repr(float(cell)) for cell in row) + '\\n')
";

/// Data that a program has read: class and columns of each variable.
struct Read {
    variables: BTreeMap<String, (String, Vec<Vec<f64>>)>,
    about: String,
}

impl Read {
    fn of(text: &str) -> Self {
        let mut variables = BTreeMap::new();
        let mut about = String::new();
        let mut lines = text.lines();
        while let Some(head) = lines.next() {
            let words: Vec<&str> = head.split(' ').collect();
            assert_eq!((words.len(), words[0]), (5, "variable"), "{head}");
            let (rows, columns) = (words[2].parse::<usize>().unwrap(), words[3].parse().unwrap());
            if words[4] == "char" {
                about = lines.next().unwrap().to_owned();
                continue;
            }
            let mut values = vec![Vec::new(); columns];
            for _ in 0..rows {
                let line = lines.next().unwrap();
                let cells: Vec<f64> = line
                    .split_whitespace()
                    .map(|cell| cell.parse().unwrap())
                    .collect();
                assert_eq!(cells.len(), columns, "{head}");
                for (column, cell) in values.iter_mut().zip(cells) {
                    column.push(cell);
                }
            }
            variables.insert(words[1].to_owned(), (words[4].to_owned(), values));
        }
        Self { variables, about }
    }
}

const CORNERS: [&str; 4] = ["lower_right", "lower_left", "upper_right", "upper_left"];

/// Returns the expected variables, from the table of results.
fn expected_variables(run: &str) -> BTreeMap<&'static str, Vec<Vec<f64>>> {
    let csv = Csv::of(run);
    let corners = |face: &str, what: &str| -> Vec<Vec<f64>> {
        CORNERS
            .iter()
            .map(|corner| csv.get(&format!("{face}_{corner}_{what}")))
            .collect()
    };
    let sizes = CORNERS
        .iter()
        .map(|corner| {
            let part = |axis: &str| csv.get(&format!("column_{corner}_friction_force_{axis}_lbf"));
            let (x, y, z) = (part("x"), part("y"), part("z"));
            (0..x.len()).map(|k| x[k].hypot(y[k]).hypot(z[k])).collect()
        })
        .collect();
    let variable = run.starts_with("vd");
    let rates = [
        "x_rate_in_per_s",
        "z_rate_in_per_s",
        "pitch_rate_rad_per_s",
        "yaw_rate_rad_per_s",
    ];
    let mut y = vec![
        csv.get("wedge_x_in"),
        csv.moved("wedge_z_in", 1.0, if variable { 10.25 } else { 9.95 }),
        csv.get("wedge_pitch_rad"),
        csv.get("wedge_yaw_rad"),
        csv.get("bolster_vertical_in"),
    ];
    y.extend(rates.map(|rate| csv.get(&format!("wedge_{rate}"))));
    let one = |name: &str| vec![csv.get(name)];
    let (fz, power) = if variable {
        (
            vec![csv.moved("vertical_force_on_side_frame_lbf", -1.0, 0.0)],
            "EsideframeT",
        )
    } else {
        (one("vertical_wedge_force_lbf"), "Esideframe")
    };
    BTreeMap::from([
        ("t", one("time_s")),
        ("y", y),
        ("Fx", one("longitudinal_wedge_force_lbf")),
        ("Fz", fz),
        (power, one("side_frame_friction_power_lbf_in_per_s")),
        ("FsideframeNormal", corners("column", "normal_force_lbf")),
        ("FsideframeTangent", sizes),
        ("FbolsterNormal", corners("slope", "normal_force_lbf")),
        ("Fspring2", one("coil_force_lbf")),
        ("vector", one("coil_length_in")),
        ("Momentsideframex", one("side_frame_roll_moment_lbf_in")),
        ("Momentsideframey", one("side_frame_pitch_moment_lbf_in")),
        ("Momentsideframez", one("side_frame_yaw_moment_lbf_in")),
    ])
}

/// Equal within 1e-12 of the largest value.
#[track_caller]
fn same(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let largest = expected.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    for (row, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs();
        assert!(off <= 1e-12 * largest, "{what}, row {row}: {found} {expected}");
    }
}

fn reads(dump: impl Fn(&Path, &Path)) {
    let folder = tempfile::tempdir().unwrap();
    for run in NAMES {
        let text = folder.path().join(run);
        dump(&runs().join(run).join("result.mat"), &text);
        let read = Read::of(&fs::read_to_string(text).unwrap());
        let expected = expected_variables(run);
        let names: Vec<&str> = read.variables.keys().map(String::as_str).collect();
        let wanted: Vec<&str> = expected.keys().copied().collect();
        assert_eq!(names, wanted, "{run}");
        for (name, columns) in &expected {
            let (class, found) = &read.variables[*name];
            assert_eq!(
                (class.as_str(), found.len()),
                ("double", columns.len()),
                "{run} {name}"
            );
            for (k, (found, expected)) in found.iter().zip(columns).enumerate() {
                assert_eq!(found.len(), 1001);
                same(found, expected, &format!("{run} {name} column {k}"));
                if !matches!((*name, k), ("y", 1) | ("FsideframeTangent", _)) {
                    // Nothing is computed with these on the way.
                    let bits =
                        |values: &[f64]| values.iter().map(|v| (v + 0.0).to_bits()).collect::<Vec<_>>();
                    assert!(bits(found) == bits(expected), "{run} {name} column {k}");
                }
            }
        }
        assert!(read.about.starts_with(&format!("{run}: ")), "{}", read.about);
        assert!(read.about.contains("Fx (lbf)"), "{}", read.about);
    }
}

#[test]
#[ignore = "needs Octave; cargo xtask test runs it"]
fn octave_reads_the_files() {
    reads(|file, text| octave(OCTAVE_DUMP, &[file, text]));
}

#[test]
#[ignore = "needs SciPy; cargo xtask test runs it"]
fn scipy_reads_the_files() {
    reads(|file, text| python(SCIPY_DUMP, &[file, text]));
}

/// Draws everything unseen and writes what the axes then hold: limits, and each line with its points.
const DRAW: &str = "\
arguments = argv ();
set (0, 'defaultfigurevisible', 'off');
addpath (arguments{end-2});
figures = thesis_figures (arguments{end-1});
file = fopen (arguments{end}, 'w');
for k = 1:numel (figures)
  here = figures(k).axes;
  x = xlim (here);
  y = ylim (here);
  fprintf (file, 'figure %s %.17g %.17g %.17g %.17g\\n', figures(k).name, x, y);
  lines = flipud (findobj (get (here, 'children'), 'flat', 'type', 'line'));
  for line = lines.'
    points = [get(line, 'xdata')(:), get(line, 'ydata')(:)];
    fprintf (file, 'line %d %s\\n', rows (points), get (line, 'displayname'));
    fprintf (file, '%.17g %.17g\\n', points.');
  end
end
fclose (file);
close all
";

/// A line of a figure: its name in the legend and its points.
type Drawn = (String, Vec<f64>, Vec<f64>);

struct Axes {
    limits: [f64; 4],
    lines: Vec<Drawn>,
}

fn drawn() -> BTreeMap<String, Axes> {
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("drawn");
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scripts/octave");
    octave(DRAW, &[&scripts, &runs(), &text]);
    let text = fs::read_to_string(text).unwrap();
    let mut figures: BTreeMap<String, Axes> = BTreeMap::new();
    let mut name = String::new();
    let mut lines = text.lines();
    while let Some(head) = lines.next() {
        let words: Vec<&str> = head.splitn(3, ' ').collect();
        if words[0] == "figure" {
            name = words[1].to_owned();
            let limits: Vec<f64> = words[2].split(' ').map(|word| word.parse().unwrap()).collect();
            let axes = Axes {
                limits: limits.try_into().unwrap(),
                lines: Vec::new(),
            };
            assert!(figures.insert(name.clone(), axes).is_none(), "{name} twice");
            continue;
        }
        assert_eq!(words[0], "line");
        let count: usize = words[1].parse().unwrap();
        let (x, y) = (0..count)
            .map(|_| {
                let (x, y) = lines.next().unwrap().split_once(' ').unwrap();
                (x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap())
            })
            .unzip();
        figures
            .get_mut(&name)
            .unwrap()
            .lines
            .push((words[2].to_owned(), x, y));
    }
    figures
}

#[test]
#[ignore = "needs Octave; cargo xtask test runs it"]
fn the_scripts_draw_our_curves() {
    let (drawn, wanted) = (drawn(), wanted());
    let names = |figures: Vec<&String>| figures.into_iter().cloned().collect::<Vec<String>>();
    assert_eq!(names(drawn.keys().collect()), names(wanted.keys().collect()));
    for (name, wanted) in &wanted {
        let axes = &drawn[name];
        let limits = [axes.limits[..2].to_vec(), axes.limits[2..].to_vec()];
        for (found, wanted) in limits.iter().zip([wanted.x_limits, wanted.y_limits]) {
            assert!(
                wanted.is_none_or(|wanted| found[..] == wanted),
                "{name}: {found:?}"
            );
        }
        assert_eq!(axes.lines.len(), wanted.runs.len(), "{name}");
        for (k, (label, x, y)) in axes.lines.iter().enumerate() {
            assert_eq!(label, wanted.labels[k], "{name}");
            let csv = Csv::of(&wanted.runs[k]);
            let (first, last) = wanted.rows;
            let rows = first - 1..last;
            let expected = &csv.moved(wanted.x.0, 1.0, wanted.x.1)[rows.clone()];
            same(x, expected, &format!("{name}, x of {label}"));
            same(y, &csv.get(wanted.y)[rows], &format!("{name}, y of {label}"));
        }
    }
}
