//! Contents of the table and of the page.

use std::fs;
use std::fs::File;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use tempfile::tempdir;

use crate::common::{done, names};

/// Returns a table: for each row its cells by name.
fn rows(folder: &Path) -> Vec<Vec<(String, Field)>> {
    let reader = SerializedFileReader::new(File::open(folder.join("table.parquet")).unwrap()).unwrap();
    reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| {
            let row = row.unwrap();
            row.get_column_iter()
                .map(|(name, field)| (name.clone(), field.clone()))
                .collect()
        })
        .collect()
}

fn cell<'r>(row: &'r [(String, Field)], name: &str) -> &'r Field {
    let found = row.iter().find(|(own, _)| own == name);
    &found.unwrap_or_else(|| panic!("no column {name}")).1
}

fn number(row: &[(String, Field)], name: &str) -> f64 {
    match cell(row, name) {
        Field::Double(value) => *value,
        other => panic!("{name}: {other:?}"),
    }
}

const MIXED: &str = "\
case = \"cdrun_toe_out_0.2_psi_0.012\"
sampling = \"list\"
[set]
simulation.duration = \"5 s\"
simulation.relative_tolerance = 1e-5
[[variants]]
friction.column = 0.3
[[variants]]
side_frame.toe = \"0.2 deg in\"
friction.column = 0.35
[[variants]]
wedge.inertia = [\"1e-300 lb in^2\", \"1e-300 lb in^2\", \"1e-300 lb in^2\"]
[[variants]]
wedge.damping = \"variable\"
";

#[test]
fn limits_a_row_is_the_summary_of_the_same_run() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("mixed.toml"), MIXED).unwrap();
    let said = done(path, &["study", "mixed.toml", "--quiet"]);
    assert!(said.out.contains("4 runs: 3 complete, "), "{}", said.out);
    let rows = rows(&path.join("mixed"));
    assert_eq!(rows.len(), 4);
    assert_eq!(number(&rows[1], "friction.column"), 0.35);
    assert_eq!(number(&rows[1], "side_frame.toe_out_deg"), -0.2);
    assert_eq!(*cell(&rows[0], "side_frame.toe_out_deg"), Field::Null);
    assert_eq!(*cell(&rows[3], "wedge.damping"), Field::Str("variable".into()));
    // The failed one says why, and the others are there.
    assert_eq!(*cell(&rows[2], "energy_per_cycle_side_frame_lbf_in"), Field::Null);
    assert!(matches!(cell(&rows[2], "reason"), Field::Str(reason) if !reason.is_empty()));
    assert_ne!(*cell(&rows[2], "status"), Field::Str("complete".into()));
    // Its time series, on demand, are of the same run.
    done(path, &["study", "mixed.toml", "--series", "1", "3", "--quiet"]);
    assert_eq!(names(&path.join("mixed/series")), ["1", "3"]);
    for number_of_run in [1, 3] {
        let file = path.join(format!("mixed/series/{number_of_run}/summary.json"));
        let summary: serde_json::Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
        let row = &rows[number_of_run];
        for (column, value) in [
            (
                "energy_per_cycle_side_frame_lbf_in",
                &summary["averages"]["energy_per_cycle"]["side_frame"],
            ),
            (
                "mean_vertical_wedge_force_up_lbf",
                &summary["averages"]["up"]["vertical_wedge_force"],
            ),
            (
                "equivalent_stiffness_lbf_per_in",
                &summary["averages"]["equivalent_stiffness"],
            ),
        ] {
            let (own, other) = (number(row, column), value["value"].as_f64().unwrap());
            assert!(
                (own - other).abs() <= 1e-12 * other.abs(),
                "{column}: {own} {other}"
            );
        }
        assert_eq!(
            number(row, "steps") as u64,
            summary["solver"]["statistics"]["steps"].as_u64().unwrap()
        );
    }
}

/// Returns the cells of a line of CSV, without quotation marks.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for sign in line.chars() {
        match sign {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            sign => cells.last_mut().unwrap().push(sign),
        }
    }
    cells
}

#[test]
fn issue_036_the_table_as_csv_is_the_parquet_table() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("mixed.toml"), MIXED.replace("\"5 s\"", "\"2 s\"")).unwrap();
    done(path, &["study", "mixed.toml", "--quiet"]);
    let text = fs::read_to_string(path.join("mixed/table.csv")).unwrap();
    let mut lines = text.lines();
    let header = cells(lines.next().unwrap());
    let rows = rows(&path.join("mixed"));
    assert_eq!(lines.clone().count(), rows.len());
    assert!(
        header.contains(&"energy_per_cycle_side_frame_lbf_in".to_owned()),
        "{header:?}"
    );
    assert!(
        header.contains(&"side_frame.toe_out_deg".to_owned()),
        "{header:?}"
    );
    let mut numbers = 0;
    for (line, row) in lines.zip(&rows) {
        let line = cells(line);
        assert_eq!((line.len(), header.len()), (row.len(), row.len()));
        for ((text, name), (own, field)) in line.iter().zip(&header).zip(row) {
            assert_eq!(name, own);
            match field {
                Field::Null => assert_eq!(text, "", "{name}"),
                Field::Double(value) => {
                    assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{name}");
                    numbers += 1;
                }
                Field::Long(value) => assert_eq!(text.parse::<i64>().unwrap(), *value, "{name}"),
                Field::Str(value) => assert_eq!(text, &value.replace('"', ""), "{name}"),
                other => panic!("{name}: {other:?}"),
            }
        }
    }
    assert!(numbers > 60, "{numbers}");
}

#[test]
fn limits_units_stand_in_the_metadata() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = MIXED.replace("\"5 s\"", "\"0.02 s\"\nsimulation.output_units = \"si\"");
    fs::write(path.join("mixed.toml"), text).unwrap();
    done(path, &["study", "mixed.toml", "--quiet"]);
    let file = File::open(path.join("mixed/table.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let metadata = reader.metadata().file_metadata();
    let value = |key: &str| {
        let pairs = metadata.key_value_metadata().unwrap();
        let found = pairs.iter().find(|pair| pair.key == key).unwrap();
        serde_json::from_str::<serde_json::Value>(found.value.as_ref().unwrap()).unwrap()
    };
    let columns = value("wedgelab.columns");
    let unit = |name: &str| {
        let columns = columns.as_array().unwrap();
        let found = columns.iter().find(|column| column["name"] == name).unwrap();
        found["unit"].as_str().unwrap().to_owned()
    };
    assert_eq!(unit("energy_per_cycle_side_frame_J"), "J");
    assert_eq!(unit("equivalent_stiffness_N_per_m"), "N/m");
    assert_eq!(unit("side_frame.toe_out_deg"), "deg");
    assert_eq!(unit("jam_margin_rad"), "rad");
    assert_eq!(
        columns.as_array().unwrap().len(),
        metadata.schema_descr().num_columns()
    );
    assert_eq!(value("wedgelab.study")["runs"], 4);
}

#[test]
fn limits_the_page_has_effects_contours_and_the_jam_map() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let text = "case = \"cdrun_toe_in_0.2_psi_0.012\"\nsampling = \"sobol\"\nruns = 128\nname = \"map\"\n\
                [set]\nbolster.vertical.frequency = \"40 rad/s\"\nsimulation.duration = \"0.25 s\"\n\
                simulation.relative_tolerance = 1e-5\n[vary]\n\
                wedge.angle = { from = \"25 deg\", to = \"45 deg\" }\n\
                friction.column = { from = 0.1, to = 0.6, also = [\"friction.slope\"] }\n";
    fs::write(path.join("a.toml"), text).unwrap();
    done(path, &["study", "a.toml", "--quiet"]);
    let page = fs::read_to_string(path.join("map/index.html")).unwrap();
    for text in [
        "Main effects: energy per cycle side frame",
        "Contours over wedge.angle and friction.column",
        "id=\"jam_map_toe_in\"",
        "massless wedge jams left of this",
        "points of the Sobol",
    ] {
        assert!(page.contains(text), "{text}");
    }
    assert!(!page.contains("NaN") && !page.contains("jam_map_toe_out"));
}
